//! Polylines and shapes of cavalier_contours, bit for bit.
//!
//! Both libraries keep vertices with bulges. cavalier_contours knows no arc of more than a half
//! circle; such an arc is cut in its middle, and everything else is carried over as it is.

use crate::boundary::{Curve, Pocket, Pockets};
use crate::error::{Defect, Error};
use crate::geom::{ArcSpline, Element, Vertex, point};
use crate::tolerance::Tolerance;
use cavalier_contours::polyline::{PlineVertex, Polyline};
use cavalier_contours::shape_algorithms::Shape;

impl From<Vertex> for PlineVertex<f64> {
    fn from(v: Vertex) -> PlineVertex<f64> {
        PlineVertex::new(v.point.x, v.point.y, v.bulge)
    }
}

impl From<PlineVertex<f64>> for Vertex {
    fn from(v: PlineVertex<f64>) -> Vertex {
        Vertex { point: point(v.x, v.y), bulge: v.bulge }
    }
}

impl From<&ArcSpline> for Polyline<f64> {
    fn from(spline: &ArcSpline) -> Polyline<f64> {
        let mut vertex_data = Vec::with_capacity(spline.vertices.len());
        let mut add = |e: Element| vertex_data.push(PlineVertex::new(e.start.x, e.start.y, e.bulge));
        for e in spline.elements() {
            if e.bulge.abs() > 1.0 {
                let (first, second) = e.split(0.5);
                add(first);
                add(second);
            } else {
                add(e);
            }
        }
        vertex_data.extend(spline.vertices.last().filter(|_| !spline.closed).map(|v| PlineVertex::from(*v)));
        Polyline { vertex_data, is_closed: spline.closed, userdata: Vec::new() }
    }
}

/// User data of the polyline are not kept.
impl From<&Polyline<f64>> for ArcSpline {
    fn from(polyline: &Polyline<f64>) -> ArcSpline {
        let vertices = polyline.vertex_data.iter().map(|v| (*v).into()).collect();
        ArcSpline { vertices, closed: polyline.is_closed }
    }
}

impl From<&Pocket> for Shape<f64> {
    fn from(pocket: &Pocket) -> Shape<f64> {
        Shape::from_plines(pocket.loops().map(Polyline::from))
    }
}

/// The shape of loops with the inside on their left, such as those of a pocket or of a level set.
/// Splines of fewer than two vertices are left out, as cavalier_contours takes none.
///
/// # Errors
/// [`Error::Defects`] when a coordinate is not a number, which cavalier_contours does not stand.
pub fn shape(loops: &[ArcSpline]) -> Result<Shape<f64>, Error> {
    let mut vertices = loops.iter().flat_map(|l| &l.vertices);
    if let Some(v) = vertices.find(|v| !v.point.is_finite() || !v.bulge.is_finite()) {
        return Err(Error::Defects(vec![Defect::Coordinate { at: v.point }]));
    }
    Ok(Shape::from_plines(loops.iter().map(Polyline::from)))
}

/// The loops of a shape: counter-clockwise ones first, then clockwise ones.
pub fn loops(shape: &Shape<f64>) -> Vec<ArcSpline> {
    shape.ccw_plines.iter().chain(&shape.cw_plines).map(|p| ArcSpline::from(&p.polyline)).collect()
}

/// The pockets that the loops of a shape bound, by their nesting, and what is wrong with them.
///
/// # Errors
/// As [`Pockets::from_curves`].
pub fn pockets(shape: &Shape<f64>, tolerance: Tolerance) -> Result<Pockets, Error> {
    let curves: Vec<Curve> = loops(shape).into_iter().map(Curve::from).collect();
    Pockets::from_curves(&curves, tolerance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use cavalier_contours::polyline::PlineSource;
    use proptest::prelude::*;

    fn slot() -> ArcSpline {
        ArcSpline::closed([(0.0, -3.0, 0.0), (10.0, -3.0, 1.0), (10.0, 3.0, 0.0), (0.0, 3.0, 1.0)])
    }

    #[test]
    fn lengths_and_areas_are_those_of_the_other_library() {
        let polyline = Polyline::from(&slot());
        assert!((polyline.area() - slot().area()).abs() < 1e-12);
        assert!((polyline.path_length() - slot().length()).abs() < 1e-12);
    }

    #[test]
    fn an_arc_of_three_quarters_is_two_arcs_there() {
        let b = (3.0 * std::f64::consts::PI / 8.0).tan();
        let pie = ArcSpline::closed([(0.0, -1.0, b), (-1.0, 0.0, 0.0)]);
        let polyline = Polyline::from(&pie);
        assert_eq!(polyline.vertex_count(), 3);
        assert!((polyline.area() - pie.area()).abs() < 1e-14);
        assert!(polyline.vertex_data.iter().all(|v| v.bulge.abs() <= 1.0));
    }

    #[test]
    fn a_pocket_is_a_shape_and_a_shape_its_pockets() {
        let island = ArcSpline::circle(point(4.0, 0.5), 1.0);
        let pocket = Pocket::from_loops(vec![slot(), island], Tolerance::MM).unwrap();
        let shape = Shape::from(&pocket);
        assert_eq!((shape.ccw_plines.len(), shape.cw_plines.len()), (1, 1));
        let Pockets { pockets, defects } = pockets(&shape, Tolerance::MM).unwrap();
        assert!(defects.is_empty());
        assert_eq!(pockets, [pocket]);
    }

    #[test]
    fn an_offset_there_is_a_level_here() {
        let pocket = Pocket::from_loops(vec![slot()], Tolerance::MM).unwrap();
        let theirs: Vec<ArcSpline> =
            Polyline::from(pocket.outer()).parallel_offset(1.0).iter().map(ArcSpline::from).collect();
        assert_eq!(theirs.len(), 1);
        assert!((theirs[0].area() - (40.0 + 4.0 * std::f64::consts::PI)).abs() < 1e-12);
    }

    #[test]
    fn nothing_and_nonsense_are_carried_over_without_a_panic() {
        assert!(loops(&shape(&[]).unwrap()).is_empty());
        let lone = ArcSpline::closed([(1.0, 2.0, 0.0)]);
        assert!(loops(&shape(&[lone.clone(), ArcSpline::default()]).unwrap()).is_empty());
        assert_eq!(loops(&shape(&[slot(), lone.clone()]).unwrap()), [slot()]);
        assert_eq!(ArcSpline::from(&Polyline::from(&lone)).vertices.len(), 1);
        let broken = ArcSpline::closed([(f64::NAN, 0.0, 0.0), (1.0, f64::INFINITY, 0.5), (0.0, 1.0, 0.0)]);
        assert!(matches!(shape(&[slot(), broken]), Err(Error::Defects(_))));
    }

    proptest! {
        #[test]
        fn splines_return_to_the_last_bit(
            vertices in prop::collection::vec((-1e6..1e6f64, -1e6..1e6f64, -1.0..=1.0f64), 1..40),
            closed: bool,
        ) {
            let spline = ArcSpline { closed, ..ArcSpline::closed(vertices) };
            prop_assert_eq!(&ArcSpline::from(&Polyline::from(&spline)), &spline);
        }

        #[test]
        fn arcs_beyond_a_half_circle_keep_their_circle(bulge in 1.0..50.0f64, x in -9.0..9.0f64) {
            let arc = ArcSpline::open([(x, 1.0, bulge), (x + 2.0, 3.0, 0.0)]);
            let cut = ArcSpline::from(&Polyline::from(&arc));
            prop_assert!((cut.length() - arc.length()).abs() <= 1e-12 * arc.length());
            prop_assert!(cut.elements().all(|e| arc.distance(e.midpoint()) <= 1e-12 * arc.length()));
        }
    }
}
