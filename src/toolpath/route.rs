//! The order of pockets: a short way from each to the next.
//!
//! **Method.** From the first pocket always on to the nearest one that is left, then exchanges of two
//! ways for two shorter ones as long as there are any (2-opt; Croes 1958). The way is open: it begins
//! with the first pocket and ends anywhere.

use crate::geom::Point;
use rstar::RTree;
use rstar::primitives::GeomWithData;

/// Most pairs of ways that are compared for an exchange; with more pockets the order found by then is
/// taken.
const MAX_PAIRS: usize = 20_000_000;

/// An order of places, beginning with the first.
pub(super) fn route(places: &[Point]) -> Vec<usize> {
    let mut order = by_nearest(places);
    let n = order.len();
    let way = |a: usize, b: usize| places[a].distance(places[b]);
    let mut pairs = 0;
    let mut improved = true;
    while improved && pairs + n * n / 2 <= MAX_PAIRS {
        improved = false;
        pairs += n * n / 2;
        for i in 1..n {
            for j in i + 1..n {
                let (before, first, last) = (order[i - 1], order[i], order[j]);
                let after = order.get(j + 1);
                let old = way(before, first) + after.map_or(0.0, |&a| way(last, a));
                let new = way(before, last) + after.map_or(0.0, |&a| way(first, a));
                // Equal but for round-off is no gain, or the exchange could go on forever.
                if new < old * (1.0 - 8.0 * f64::EPSILON) {
                    order[i..=j].reverse();
                    improved = true;
                }
            }
        }
    }
    order
}

fn by_nearest(places: &[Point]) -> Vec<usize> {
    let entry = |i: usize| GeomWithData::new([places[i].x, places[i].y], i);
    let mut left = RTree::bulk_load((1..places.len()).map(entry).collect());
    let mut order: Vec<usize> = (0..places.len().min(1)).collect();
    while let Some(&last) = order.last()
        && let Some(next) = left.pop_nearest_neighbor(&[places[last].x, places[last].y])
    {
        order.push(next.data);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    fn length(places: &[Point], order: &[usize]) -> f64 {
        order.windows(2).map(|w| places[w[0]].distance(places[w[1]])).sum()
    }

    #[test]
    fn a_grid_drawn_row_by_row_is_run_to_and_fro() {
        let places: Vec<Point> =
            (0..100).map(|i| point(f64::from(i % 10) * 7.0, f64::from(i / 10) * 10.0)).collect();
        let order = route(&places);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..100).collect::<Vec<_>>());
        assert_eq!(order[0], 0);
        // The shortest way runs along the rows: 90 steps of 7 and 9 of 10.
        assert!(length(&places, &order) <= 1.1 * 720.0, "{}", length(&places, &order));
        assert!(length(&places, &(0..100).collect::<Vec<_>>()) > 1200.0);
    }

    #[test]
    fn ways_that_cross_are_exchanged() {
        // The nearest one first leads to and fro along the line and back over all of it.
        let places = [0.0, 1.0, -1.5, 3.0, -5.0, 8.0].map(|x| point(x, 0.0));
        let greedy = by_nearest(&places);
        assert!(length(&places, &route(&places)) < length(&places, &greedy));
    }

    #[test]
    fn few_places_and_equal_ones_have_an_order_too() {
        assert_eq!(route(&[]), [0usize; 0]);
        assert_eq!(route(&[point(1.0, 1.0)]), [0]);
        assert_eq!(route(&[point(1.0, 1.0); 4]).len(), 4);
    }
}
