//! Polygons of geo_types: arc splines flattened to a tolerance, and polygons as loops of segments.
//!
//! A tolerance here is the largest distance, in job units, between an arc and the chords that stand
//! for it. Vertices lie on the arcs, so that a polygon loses up to the tolerance where its boundary
//! is convex and gains up to it where it is concave; ends of elements are kept to the last bit. From
//! polygons nothing is lost, but that the closing vertex is not repeated.

use super::flatten::flatten;
use super::nest::regions;
use crate::boundary::{Curve, Pocket, Pockets};
use crate::error::Error;
use crate::geom::{ArcSpline, Point, Vertex, point};
use crate::tolerance::Tolerance;
use geo_types::{Coord, LineString, MultiPolygon, Polygon};

impl From<Point> for Coord<f64> {
    fn from(p: Point) -> Coord<f64> {
        Coord { x: p.x, y: p.y }
    }
}

impl From<Coord<f64>> for Point {
    fn from(c: Coord<f64>) -> Point {
        point(c.x, c.y)
    }
}

/// Closed when the first vertex is repeated at the end, which is then dropped.
impl From<&LineString<f64>> for ArcSpline {
    fn from(line: &LineString<f64>) -> ArcSpline {
        let closed = line.0.len() > 1 && line.0.first() == line.0.last();
        let kept = &line.0[..line.0.len() - usize::from(closed)];
        let vertices = kept.iter().map(|&c| Vertex { point: c.into(), bulge: 0.0 }).collect();
        ArcSpline { vertices, closed }
    }
}

/// An arc spline within a tolerance; closed by a repeated vertex if it is closed.
///
/// # Errors
/// [`Error::Parameter`] when the tolerance is no positive number, [`Error::Defects`] when a
/// coordinate is none, [`Error::Effort`] when it would take more than ten million vertices.
pub fn line_string(spline: &ArcSpline, tolerance: f64) -> Result<LineString<f64>, Error> {
    let mut line = flatten([spline].into_iter(), tolerance)?.into_iter().map(ring).next();
    if let Some(line) = line.as_mut().filter(|_| spline.closed) {
        line.close();
    }
    Ok(line.unwrap_or_else(|| LineString(Vec::new())))
}

/// A pocket within a tolerance: its outer loop, counter-clockwise, and its islands as holes,
/// clockwise.
///
/// # Errors
/// As [`line_string`].
pub fn polygon(pocket: &Pocket, tolerance: f64) -> Result<Polygon<f64>, Error> {
    let mut rings = flatten(pocket.loops(), tolerance)?.into_iter().map(ring);
    let outer = rings.next().expect("a pocket has an outer loop");
    Ok(Polygon::new(outer, rings.collect()))
}

/// The region on the left of closed loops, as those of a level set, within a tolerance:
/// counter-clockwise loops are outer rings, clockwise loops holes in the smallest around them.
///
/// # Errors
/// As [`line_string`], and [`Error::Defects`] when a loop is open, encloses nothing, or is a hole in
/// nothing.
pub fn multi_polygon(loops: &[ArcSpline], tolerance: f64) -> Result<MultiPolygon<f64>, Error> {
    let mut rings: Vec<LineString<f64>> = flatten(loops.iter(), tolerance)?.into_iter().map(ring).collect();
    let mut take = |i: usize| std::mem::replace(&mut rings[i], LineString(Vec::new()));
    let regions = regions(loops)?.into_iter();
    let polygons =
        regions.map(|r| Polygon::new(take(r.outer), r.holes.iter().map(|&hole| take(hole)).collect()));
    Ok(MultiPolygon(polygons.collect()))
}

/// The rings of a polygon, the outer one first, oriented as they are.
pub fn loops(polygon: &Polygon<f64>) -> Vec<ArcSpline> {
    let rings = std::iter::once(polygon.exterior()).chain(polygon.interiors());
    rings.filter(|ring| !ring.0.is_empty()).map(ArcSpline::from).collect()
}

/// The pocket that a polygon bounds.
///
/// # Errors
/// [`Error::Defects`] with every reason why its rings do not bound exactly one pocket.
pub fn pocket(polygon: &Polygon<f64>, tolerance: Tolerance) -> Result<Pocket, Error> {
    Pocket::from_loops(loops(polygon), tolerance)
}

/// The pockets that polygons bound, by the nesting of their rings, and what is wrong with them.
///
/// # Errors
/// As [`Pockets::from_curves`].
pub fn pockets(polygons: &MultiPolygon<f64>, tolerance: Tolerance) -> Result<Pockets, Error> {
    let curves: Vec<Curve> = polygons.iter().flat_map(loops).map(Curve::from).collect();
    Pockets::from_curves(&curves, tolerance)
}

fn ring(points: Vec<Point>) -> LineString<f64> {
    LineString(points.into_iter().map(Coord::from).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plate() -> Pocket {
        let plate =
            ArcSpline::closed([(0.0, 0.0, 0.0), (60.0, 0.0, 1.0), (60.0, 40.0, 0.0), (0.0, 40.0, 0.0)]);
        let boss = ArcSpline::circle(point(22.0, 20.0), 8.0);
        Pocket::from_loops(vec![plate, boss], Tolerance::MM).unwrap()
    }

    /// Area of a ring, counter-clockwise positive.
    fn area(ring: &LineString<f64>) -> f64 {
        ArcSpline::from(ring).area()
    }

    #[test]
    fn a_pocket_is_a_polygon_with_holes_and_nearly_its_area() {
        let (pocket, tolerance) = (plate(), 1e-4);
        let polygon = polygon(&pocket, tolerance).unwrap();
        assert!(area(polygon.exterior()) > 0.0 && area(&polygon.interiors()[0]) < 0.0);
        let flat: f64 = loops(&polygon).iter().map(ArcSpline::area).sum();
        let length: f64 = pocket.loops().map(ArcSpline::length).sum();
        assert!((flat - pocket.area()).abs() < tolerance * length && flat != pocket.area());
        assert!(polygon.exterior().is_closed() && polygon.interiors()[0].is_closed());
    }

    #[test]
    fn a_pocket_of_segments_comes_back_as_it_was() {
        let square = |a: f64, b: f64| ArcSpline::closed([(a, a, 0.0), (b, a, 0.0), (b, b, 0.0), (a, b, 0.0)]);
        let loops = vec![square(0.1, 9.7), square(1.0 / 3.0, 5.0).reversed()];
        let original = Pocket::from_loops(loops, Tolerance::MM).unwrap();
        let polygon = polygon(&original, 0.01).unwrap();
        assert_eq!(polygon.exterior().0.len(), 5);
        assert_eq!(pocket(&polygon, Tolerance::MM).unwrap(), original);
    }

    #[test]
    fn levels_become_polygons_and_polygons_pockets() {
        let ring = |x: f64, r: f64| ArcSpline::circle(point(x, 0.0), r);
        let level = [
            ring(0.0, 5.0),
            ring(0.0, 4.0).reversed(),
            ring(20.0, 3.0),
            ring(0.0, 2.0),
            ring(0.0, 1.0).reversed(),
        ];
        let polygons = multi_polygon(&level, 1e-3).unwrap();
        let holes: Vec<usize> = polygons.iter().map(|p| p.interiors().len()).collect();
        assert_eq!(holes, [1, 0, 1]);
        let pockets = pockets(&polygons, Tolerance::MM).unwrap();
        assert!(pockets.defects.is_empty());
        assert_eq!(pockets.pockets.iter().map(|p| p.islands().len()).collect::<Vec<_>>(), [1, 0, 1]);
    }

    #[test]
    fn lines_are_closed_where_they_return_to_their_first_vertex() {
        let spline = |c: &[(f64, f64)]| ArcSpline::from(&LineString::from(c.to_vec()));
        let open = spline(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)]);
        assert!(!open.closed && open.vertices.len() == 3);
        let closed = spline(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 0.0)]);
        assert!(closed.closed && closed.vertices.len() == 3);
        assert_eq!(line_string(&closed, 1.0).unwrap().0.len(), 4);
        assert_eq!(line_string(&open, 1.0).unwrap().0.len(), 3);
        assert_eq!(line_string(&spline(&[]), 1.0).unwrap().0.len(), 0);
        assert_eq!(spline(&[(2.0, 3.0)]).vertices.len(), 1);
        let nothing = Polygon::new(LineString(vec![]), vec![]);
        assert!(loops(&nothing).is_empty() && pocket(&nothing, Tolerance::MM).is_err());
    }

    proptest! {
        #[test]
        fn rings_of_segments_return_to_the_last_bit(
            corners in prop::collection::vec((-1e6..1e6f64, -1e6..1e6f64), 1..40),
        ) {
            let spline = ArcSpline::closed(corners.into_iter().map(|(x, y)| (x, y, 0.0)));
            let line = line_string(&spline, 1e-3).unwrap();
            prop_assert_eq!(ArcSpline::from(&line).vertices, spline.vertices);
        }

        #[test]
        fn chords_keep_within_the_tolerance(bulge in -4.0..4.0f64, length in 1e-3..1e3f64, share in 1e-6..1.0f64) {
            let arc = ArcSpline::open([(0.3, -0.7, bulge), (0.3 + length, -0.7, 0.0)]);
            let tolerance = share * length;
            let line = line_string(&arc, tolerance).unwrap();
            for chord in line.0.windows(2) {
                let middle = Point::from(chord[0]).midpoint(chord[1].into());
                // Round-off of a distance to the arc, in proportion to its size.
                prop_assert!(arc.distance(middle) <= tolerance + 1e-13 * (1.0 + length));
            }
        }
    }
}
