//! Pockets with their islands, as they are nested.

use medial::{ArcSpline, Bounds, Disk, Pocket, Pockets};
use serde::Serialize;

/// As many elements the medial axes may have in all: a few seconds of work.
const MAX_ELEMENTS: usize = 400_000;

/// A pocket.
#[derive(Clone, Debug, Serialize)]
pub struct PocketReport {
    /// From 1; the picture shows it.
    pub number: usize,
    /// Number of the pocket in an island of which it lies.
    pub inside: Option<usize>,
    /// Number of contours around it.
    pub depth: usize,
    /// Area to clear.
    pub area: f64,
    /// Segments and arcs of the boundary, islands included.
    pub elements: usize,
    pub bounds: Bounds,
    pub islands: Vec<Island>,
    /// Diameter of the largest tool that fits; not known beyond a limit of effort.
    pub largest_tool: Option<f64>,
    pub narrowest_neck: Option<f64>,
    /// Where the largest tool fits.
    pub largest_disk: Option<Disk>,
}

/// An island of a pocket.
#[derive(Clone, Debug, Serialize)]
pub struct Island {
    pub area: f64,
    pub elements: usize,
    pub bounds: Bounds,
}

/// All pockets, parents before what lies in them.
pub fn contours(found: &Pockets, from_depth: usize) -> Vec<PocketReport> {
    let parents = found.parents();
    let mut inner: Vec<Vec<usize>> = vec![Vec::new(); found.pockets.len()];
    let mut next: Vec<(usize, usize)> = Vec::new();
    for (pocket, parent) in parents.iter().enumerate().rev() {
        match parent {
            Some(parent) => inner[*parent].push(pocket),
            None => next.push((pocket, from_depth)),
        }
    }
    let elements: usize = found.pockets.iter().flat_map(Pocket::loops).map(ArcSpline::len).sum();
    let mut numbers = vec![0; found.pockets.len()];
    let mut reports: Vec<PocketReport> = Vec::new();
    while let Some((pocket, depth)) = next.pop() {
        numbers[pocket] = reports.len() + 1;
        next.extend(inner[pocket].iter().map(|&i| (i, depth + 2)));
        let inside = parents[pocket].map(|p| numbers[p]);
        let with_axis = elements <= MAX_ELEMENTS;
        let report =
            PocketReport { number: numbers[pocket], inside, depth, ..of(&found.pockets[pocket], with_axis) };
        reports.push(report);
    }
    reports
}

fn of(pocket: &Pocket, with_axis: bool) -> PocketReport {
    let mat = if with_axis { pocket.medial_axis().ok() } else { None };
    let largest_disk = mat.as_ref().map(|m| m.largest_disk());
    let island = |i: &ArcSpline| Island { area: i.area().abs(), elements: i.len(), bounds: i.bounds() };
    PocketReport {
        number: 0,
        inside: None,
        depth: 0,
        area: pocket.area(),
        elements: pocket.loops().map(ArcSpline::len).sum(),
        bounds: pocket.bounds(),
        islands: pocket.islands().iter().map(island).collect(),
        largest_disk,
        largest_tool: largest_disk.map(|d| 2.0 * d.radius),
        narrowest_neck: mat.as_ref().and_then(|m| m.narrowest_neck()).map(|n| 2.0 * n.radius),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::{Curve, Tolerance, point};

    #[test]
    fn rings_in_rings_are_told_from_the_outside_in() {
        let rings = [1.0, 2.0, 5.0, 8.0].map(|r| Curve::from(ArcSpline::circle(point(0.0, 0.0), r)));
        let found = Pockets::from_curves(&rings, Tolerance::MM).unwrap();
        let contours = contours(&found, 0);
        let told: Vec<_> = contours.iter().map(|c| (c.number, c.inside, c.depth, c.islands.len())).collect();
        assert_eq!(told, [(1, None, 0, 1), (2, Some(1), 2, 1)]);
        assert!((contours[0].largest_tool.unwrap() - 3.0).abs() < 1e-12);
    }
}
