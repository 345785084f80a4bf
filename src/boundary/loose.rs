//! Open chains that divide contours.
//!
//! **Needs** what the chaining left open. **Guarantees** curves of which each end lies on a contour
//! or on the end of another such curve. **Does not** take curves that stick out beyond what they
//! end on: a center line across a circle divides nothing.

use super::arrange::filed;
use super::chain::{Contour, OpenChain};
use super::clean::clean;
use super::cluster::cluster;
use super::grain::Grain;
use super::index::Index;
use super::tee::settle_on;
use crate::geom::{ArcSpline, Element, Point};

/// The curves of open chains: those that may divide contours, and the others.
pub(super) fn dividers(
    open: Vec<OpenChain>,
    contours: &[Contour],
    join: f64,
    grain: Grain,
) -> (Vec<ArcSpline>, Vec<ArcSpline>) {
    let mut curves: Vec<ArcSpline> = open.into_iter().flat_map(|chain| chain.curves).collect();
    if curves.is_empty() {
        return (curves, Vec::new());
    }
    settle_on(&mut curves, contours, join, grain);
    let curves = curves.into_iter().map(|path| clean(&path, grain));
    let curves: Vec<ArcSpline> = curves.filter(|path| !path.is_empty()).collect();
    if curves.is_empty() {
        return (curves, Vec::new());
    }
    let places: Vec<Point> =
        curves.iter().flat_map(|p| [p.vertices[0].point, p.vertices[p.len()].point]).collect();
    let on_contour = lie_on(&places, contours, grain);
    let (node_of, nodes) = cluster(&places, grain);
    let mut ends: Vec<Vec<usize>> = vec![Vec::new(); nodes.len()];
    node_of.iter().enumerate().for_each(|(end, &node)| ends[node as usize].push(end));
    let mut kept = vec![true; curves.len()];
    let mut open: Vec<usize> = (0..nodes.len()).collect();
    while let Some(node) = open.pop() {
        let mut held = ends[node].iter().copied().filter(|&end| kept[end / 2]);
        if let (Some(end), None) = (held.next(), held.next())
            && !on_contour[end]
        {
            kept[end / 2] = false;
            open.push(node_of[end ^ 1] as usize);
        }
    }
    let mut kept = kept.into_iter();
    curves.into_iter().partition(|_| kept.next().unwrap_or_default())
}

/// For each place whether it lies on a contour to round-off.
fn lie_on(places: &[Point], contours: &[Contour], grain: Grain) -> Vec<bool> {
    let elements: Vec<Element> = contours.iter().flat_map(|c| c.path.elements()).collect();
    let (boxes, owners) = filed(elements.iter().copied(), grain.same);
    let tree = Index::new(&boxes);
    let lies_on = |p: &Point| {
        let mut found = false;
        tree.meeting(&grain.around(*p), |piece| {
            found = found || elements[owners[piece as usize] as usize].distance(*p) <= grain.same;
        });
        found
    };
    places.iter().map(lies_on).collect()
}
