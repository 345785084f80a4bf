//! From and to the types of other libraries, each behind its feature.
//!
//! With the feature `cavalier-contours` arc splines become polylines of cavalier_contours and back,
//! bit for bit. With the feature `geo-types` they become polygons, flattened to a tolerance, and
//! polygons become loops of segments.

#[cfg(feature = "cavalier-contours")]
pub mod cavalier_contours;
#[cfg(feature = "geo-types")]
mod flatten;
#[cfg(feature = "geo-types")]
pub mod geo_types;
#[cfg(feature = "geo-types")]
mod nest;
