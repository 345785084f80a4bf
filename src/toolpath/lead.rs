//! Onto a finishing pass and off it again, on quarter circles that touch it from inside.
//!
//! **Needs** a closed pass along the wall, and all cut that is farther from the wall by the finishing
//! stock.
//! **Guarantees** that both arcs keep as far from the wall as the pass itself, that they begin and end
//! where all is cut already, and that the pass is met on a long smooth piece of it, away from corners.
//! **Does not** lead onto passes that are open.
//!
//! **Method.** Corners divide the pass into smooth runs. On each of the long ones the place nearest to
//! the tool is tried, as far from corners as the lead is wide: the arcs lie on the circle that touches
//! the pass there, and the disk that it bounds must keep off the wall. Where it does not, the widest
//! smaller one does, down to the width of the finishing stock, as a smaller one would begin in stock.

use super::course::{Course, Place, turns};
use super::plan::{Ground, Height, Planner};
use super::roads::bisect;
use super::{Job, Warning};
use crate::error::Error;
use crate::geom::{Element, Point, Vector};

/// A run is long from this share of the longest one on.
const LONG: f64 = 0.5;

/// Most places that are tried on a pass.
const MAX_PLACES: usize = 32;

/// Bulge of a quarter circle.
const QUARTER: f64 = std::f64::consts::SQRT_2 - 1.0;

/// A circle inside of a pass that touches it where the pass begins.
struct Lead {
    begun: Course,
    ahead: Vector,
    center: Point,
    radius: f64,
}

/// How often there was less room for leads than they are to have.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ShortLeads {
    smaller: usize,
    none: usize,
    /// The first place with none, else with less.
    at: Option<Point>,
}

impl Planner<'_> {
    /// Runs a finishing pass between its leads; false, and nothing done, where there are none.
    pub fn finish_wall(&mut self, ground: &mut Ground, pass: usize, height: Height) -> Result<bool, Error> {
        let is_backwards = self.is_backwards(ground, pass);
        let Some(course) = Course::along(ground.spline(pass), is_backwards) else { return Ok(true) };
        let wanted = self.job.lead_radius();
        if wanted == 0.0 || !course.closed || course.elements.is_empty() {
            return Ok(false);
        }
        let here = self.cutter.at().unwrap_or(course.start);
        let Some(lead) = ground.lead(self.job, course, here, is_backwards) else {
            self.leads.none += 1;
            self.leads.at.get_or_insert(here);
            return Ok(false);
        };
        if lead.radius < wanted {
            self.leads.smaller += 1;
            self.leads.at.get_or_insert(lead.begun.start);
        }
        self.afford(lead.begun.elements.len() as u64)?;
        let onto = lead.arc(true);
        self.come_to(ground, pass, onto.start, height);
        self.cut_link(&onto);
        self.run(ground, pass, &lead.begun)?;
        let off = lead.arc(false);
        self.spring(&lead.begun)?;
        self.cut_link(&off);
        ground.done[pass] = true;
        ground.last = None;
        Ok(true)
    }

    /// To a place beside a pass where all is cut, through what is cut: straight at depth, or over it
    /// and down onto a neighbor if that is faster.
    fn come_to(&mut self, ground: &Ground, pass: usize, place: Point, height: Height) {
        let room = self.job.wall_distance() + self.job.finish;
        if let Some(here) = self.cutter.at()
            && self.cutter.height() == Some(height.z)
        {
            let link = Element::segment(here, place);
            let is_faster = link.length() <= self.cutter.minutes_over(place, height.z) * self.job.feed;
            if is_faster && (ground.is_clear)(&link, room) {
                self.cut_link(&link);
                return;
            }
        }
        let down = ground.cut_beside(pass, place).map(|from| Element::segment(from, place));
        if let Some(link) = down.filter(|link| (ground.is_clear)(link, room)) {
            self.cutter.over(link.start, height.z);
            self.cutter.plunge(height.z);
            self.cut_link(&link);
        } else {
            self.cutter.over(place, height.surface);
            self.cutter.plunge(height.z);
        }
    }

    /// What there was no room for.
    pub fn short_leads(&self) -> Option<Warning> {
        let ShortLeads { smaller, none, at } = self.leads;
        (smaller + none > 0).then(|| Warning::LeadFallback {
            asked: self.job.lead_radius(),
            smaller,
            none,
            at,
        })
    }
}

impl Job {
    /// Radius of leads: that asked for, and no less than the finishing stock is wide.
    fn lead_radius(&self) -> f64 {
        let asked = self.lead.unwrap_or(self.radius());
        if asked > 0.0 { asked.max(self.finish) } else { 0.0 }
    }
}

impl Lead {
    /// The arc onto the pass, or that off it.
    fn arc(&self, onto: bool) -> Element {
        let aside = self.ahead * self.radius;
        let sense = self.ahead.cross(self.center - self.begun.start).signum();
        if onto {
            Element::arc(self.center - aside, self.begun.start, sense * QUARTER)
        } else {
            Element::arc(self.begun.end(), self.center + aside, sense * QUARTER)
        }
    }
}

impl Ground<'_> {
    /// The nearest place of the inner neighbors of a pass that are cut.
    fn cut_beside(&self, pass: usize, place: Point) -> Option<Point> {
        let cut = self.nest.inner[pass].iter().filter(|door| self.done[door.pass]);
        let elements = cut.flat_map(|door| self.spline(door.pass).elements());
        let nearest = elements.map(|e| e.nearest(place));
        nearest.min_by(|a, b| a.distance.total_cmp(&b.distance)).map(|n| n.point)
    }

    /// The widest lead, of equal ones that which is reached straight from `here`, then the nearest.
    fn lead(&self, job: &Job, course: Course, here: Point, is_backwards: bool) -> Option<Lead> {
        let wanted = job.lead_radius();
        let (course, places) = places(course, here, wanted);
        let mut best: Option<(f64, bool, Lead)> = None;
        for place in places.into_iter().take(MAX_PLACES) {
            let e = &course.elements[place.element];
            let left = e.normal_at(e.parameter(place.point).clamp(0.0, 1.0));
            let inward = if is_backwards { left * -1.0 } else { left };
            let touching = Touching { at: place.point, inward, ahead: left.right() };
            let Some(radius) = self.widest(job, &touching, wanted) else { continue };
            let center = place.point + inward * radius;
            let link = Element::segment(here, center - touching.ahead * radius);
            let is_straight = (self.is_clear)(&link, job.wall_distance() + job.finish);
            if best.as_ref().is_none_or(|(r, s, _)| (radius, is_straight) > (*r, *s)) {
                let begun = course.begun_at(place, self.slack);
                best = Some((radius, is_straight, Lead { begun, ahead: touching.ahead, center, radius }));
            }
            if radius == wanted && is_straight {
                break;
            }
        }
        best.map(|(.., lead)| lead)
    }

    /// Radius of the widest circle at a place that keeps off the wall and crosses to what is cut.
    fn widest(&self, job: &Job, touching: &Touching, wanted: f64) -> Option<f64> {
        let free = |p: Point, room: f64| (self.is_clear)(&Element::segment(p, p), room);
        let center = |radius: f64| touching.at + touching.inward * radius;
        let fits = |radius: f64| free(center(radius), job.wall_distance() + radius);
        let mut radius = if fits(wanted) { wanted } else { wanted * bisect(|share| fits(share * wanted)) };
        // In a round pocket a smaller circle may reach farther from the wall.
        while radius >= job.finish && radius > 0.0 {
            let ends = [radius, -radius].map(|r| center(radius) + touching.ahead * r);
            if ends.into_iter().all(|p| free(p, job.wall_distance() + job.finish)) {
                return Some(radius);
            }
            radius *= 0.5;
        }
        None
    }
}

/// A place of a pass and the directions there.
struct Touching {
    at: Point,
    inward: Vector,
    ahead: Vector,
}

/// The course begun at a corner of it, if there is one, and a place on each of its long smooth runs:
/// nearest to `here`, and by `margin` away from corners where the run is that long.
fn places(course: Course, here: Point, margin: f64) -> (Course, Vec<Place>) {
    let n = course.elements.len();
    let corner = (0..n).find(|&i| turns(&course.elements[(i + n - 1) % n], &course.elements[i]));
    let course = course.rotated(corner.unwrap_or(0));
    let margin = if corner.is_some() { margin } else { 0.0 };
    let runs: Vec<&[Element]> = course.elements.chunk_by(|a, b| !turns(a, b)).collect();
    let lengths: Vec<f64> = runs.iter().map(|run| run.iter().map(Element::length).sum()).collect();
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    let (mut places, mut first) = (Vec::new(), 0);
    for (run, length) in runs.into_iter().zip(lengths) {
        if length >= LONG * longest {
            let (element, point) = on_run(run, length, here, margin);
            places.push(Place { element: first + element, point, distance: point.distance(here) });
        }
        first += run.len();
    }
    places.sort_by(|a, b| a.distance.total_cmp(&b.distance));
    (course, places)
}

/// The place of a run nearest to `here` that is a margin away from its ends, or its middle; and the
/// element on which it lies.
fn on_run(run: &[Element], length: f64, here: Point, margin: f64) -> (usize, Point) {
    let mut gone = 0.0;
    let mut best = (f64::INFINITY, 0.0);
    for e in run {
        let near = e.nearest(here);
        if near.distance < best.0 {
            best = (near.distance, gone + e.length() * e.parameter(near.point).clamp(0.0, 1.0));
        }
        gone += e.length();
    }
    let margin = margin.min(0.5 * length);
    let mut left = best.1.clamp(margin, length - margin);
    for (i, e) in run.iter().enumerate() {
        if left <= e.length() || i + 1 == run.len() {
            return (i, e.point_at(left / e.length()));
        }
        left -= e.length();
    }
    (0, run[0].start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point};

    fn course(spline: &ArcSpline) -> Course {
        Course::along(spline, false).unwrap()
    }

    #[test]
    fn a_pass_is_met_away_from_its_corners_on_a_long_side() {
        let flat = ArcSpline::closed([(0.0, 0.0, 0.0), (20.0, 0.0, 0.0), (20.0, 4.0, 0.0), (0.0, 4.0, 0.0)]);
        let (begun, found) = places(course(&flat), point(21.0, 3.0), 3.0);
        let points: Vec<Point> = found.iter().map(|p| p.point).collect();
        assert_eq!(points, [point(17.0, 4.0), point(17.0, 0.0)]);
        assert!(found.iter().all(|p| begun.elements[p.element].distance(p.point) == 0.0));
        // The middle, where the margins do not fit.
        let (_, found) = places(course(&flat), point(21.0, 3.0), 30.0);
        assert!(found.iter().all(|p| p.point.x == 10.0));
    }

    #[test]
    fn a_joint_without_an_angle_is_no_corner() {
        let slot = ArcSpline::closed([(0.0, 0.0, 0.0), (9.0, 0.0, 1.0), (9.0, 4.0, 0.0), (0.0, 4.0, 1.0)]);
        let (_, found) = places(course(&slot), point(9.0, 1.0), 3.0);
        assert_eq!(found.len(), 1);
        assert!(found[0].point.distance(point(9.0, 0.0)) < 2.0);
    }

    #[test]
    fn leads_touch_the_pass_and_turn_with_it() {
        let square = ArcSpline::closed([(0.0, 0.0, 0.0), (8.0, 0.0, 0.0), (8.0, 8.0, 0.0), (0.0, 8.0, 0.0)]);
        let begun = course(&square).begun_at(course(&square).nearest(point(4.0, 0.0)), 1e-12);
        let lead = Lead { ahead: Vector { x: 1.0, y: 0.0 }, center: point(4.0, 2.0), radius: 2.0, begun };
        let (onto, off) = (lead.arc(true), lead.arc(false));
        assert_eq!([onto.start, onto.end], [point(2.0, 2.0), point(4.0, 0.0)]);
        assert_eq!([off.start, off.end], [point(4.0, 0.0), point(6.0, 2.0)]);
        for tangent in [onto.tangents().1, off.tangents().0] {
            assert!(tangent.cross(lead.ahead).abs() < 1e-15 && tangent.dot(lead.ahead) > 0.0);
        }
    }
}
