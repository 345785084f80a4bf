//! Parts of loops that are not at the distance: as long as they go on, each is one fault.

use super::level::{Finding, Judge};
use super::report::{Fault, FaultKind};
use crate::geom::{ArcSpline, Element, Point};

/// Most places looked at along one element for the one that is farthest off.
const EFFORT: usize = 200;

/// The largest deviation is known when nothing is larger by more than this share.
const SHARE: f64 = 1.0 / 4096.0;

/// Places at which an element with a wrong place is looked at to tell how much of it is wrong.
const STEPS: u32 = 16;

/// Halvings for the place between two of them where it becomes wrong.
const HALVINGS: u32 = 12;

/// The wrong parts of a loop, by what was found along its elements.
pub(super) fn parts(judge: &Judge, spline: &ArcSpline, findings: &[Finding]) -> Vec<Fault> {
    let n = findings.len();
    let is_wrong = |i: usize| findings[i].deviation > judge.within;
    if (0..n).all(is_wrong) {
        let area = if spline.closed { spline.area().abs() } else { 0.0 };
        let all: Vec<usize> = (0..n).collect();
        return part(judge, spline, findings, &all).map(|p| Fault { area, ..p }).into_iter().collect();
    }
    // Begin after a right element of a closed loop, so that no part is cut in two.
    let first = if spline.closed { (0..n).find(|&i| !is_wrong(i)).unwrap_or(0) } else { 0 };
    let turned: Vec<usize> = (0..n).map(|i| (first + i) % n).collect();
    let stretches = turned.chunk_by(|&a, &b| is_wrong(a) == is_wrong(b));
    stretches.filter(|s| is_wrong(s[0])).filter_map(|s| part(judge, spline, findings, s)).collect()
}

/// The part that some elements in a row make.
fn part(judge: &Judge, spline: &ArcSpline, findings: &[Finding], elements: &[usize]) -> Option<Fault> {
    let known = elements.iter().map(|&i| &findings[i]).max_by(|a, b| a.deviation.total_cmp(&b.deviation))?;
    let mut worst = (known.deviation, known.at);
    for &i in elements {
        worst = farthest(judge, &spline.element(i), findings[i].deviation, worst);
    }
    let (by, at) = worst;
    let length = elements.iter().map(|&i| wrong_length(judge, &spline.element(i))).sum();
    Some(Fault { by, length, ..Fault::at(FaultKind::Distance, at) })
}

/// The place of an element that is farthest from being at the distance, if it is farther than the worst.
///
/// The distance changes no faster than the place moves, so no place of a stretch is off by more than its
/// middle and half of its length: the stretch that promises most is halved next. Of the element, ends and
/// quarters are known.
fn farthest(judge: &Judge, e: &Element, known: f64, worst: (f64, Point)) -> (f64, Point) {
    let length = e.length();
    let mut best = worst;
    let mut stretches = vec![(known + 0.125 * length, 0.0, 1.0)];
    for _ in 0..EFFORT {
        let Some(most) = (0..stretches.len()).max_by(|&a, &b| stretches[a].0.total_cmp(&stretches[b].0))
        else {
            break;
        };
        let (promise, from, to) = stretches.swap_remove(most);
        if promise <= best.0 * (1.0 + SHARE) || !length.is_finite() {
            break;
        }
        let middle = 0.5 * (from + to);
        let at = e.point_at(middle);
        let deviation = judge.deviation(at);
        if deviation > best.0 {
            best = (deviation, at);
        }
        let promise = deviation + 0.5 * length * (to - from);
        stretches.extend([(promise, from, middle), (promise, middle, to)]);
    }
    best
}

/// Length of an element over which it is not at the distance.
fn wrong_length(judge: &Judge, e: &Element) -> f64 {
    let is_wrong = |t: f64| judge.deviation(e.point_at(t)) > judge.within;
    let mut share = 0.0;
    let mut before = is_wrong(0.0);
    for step in 0..STEPS {
        let [from, to] = [step, step + 1].map(|s| f64::from(s) / f64::from(STEPS));
        let after = is_wrong(to);
        let change = if before == after { to } else { change(from, to, |t| is_wrong(t) == before) };
        share += if before { change - from } else { to - change };
        before = after;
    }
    share * e.length()
}

/// Where between two parameters a condition ends that holds at the first and not at the second.
pub(super) fn change(from: f64, to: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut holding, mut not) = (from, to);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (holding + not);
        if holds(middle) { holding = middle } else { not = middle }
    }
    holding
}
