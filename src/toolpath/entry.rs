//! Down into full stock: by a helix, along the pass, or straight.
//!
//! A **helix** runs on the circle that touches the pass from inside where the pass begins: it ends
//! there in the direction of the pass. It stays as far from the wall as the tool must, and its radius is
//! at most 0.45 of the tool, so that no core is left standing in it. It goes round in whole turns, no steeper than asked,
//! and as narrow as that they are no longer than need be:
//! so it begins, too, where the pass does, and at every height but the first that place is cut already.

use super::course::{Course, Place};
use super::plan::{Ground, Height, Planner};
use super::roads::bisect;
use super::{Entry, Job};
use crate::error::Error;
use crate::geom::{Element, Point, Vector};
use std::f64::consts::PI;

/// Radius of the path of a helix, in tool diameters: with more a core would stand, with less it is a
/// drill.
const WIDEST: f64 = 0.45;
const NARROWEST: f64 = 0.1;

/// A circle inside of a pass that touches it where the pass begins.
struct Helix {
    begun: Course,
    center: Point,
    radius: f64,
}

impl Helix {
    /// As narrow, down to half of it, that whole turns are no longer than the run; and their number.
    fn fitted(self, run: f64, narrowest: f64) -> (Helix, f64) {
        let turns = (run / (2.0 * PI * self.radius)).ceil().max(1.0);
        let radius = (run / (2.0 * PI * turns)).max(0.5 * self.radius).max(narrowest).min(self.radius);
        let center = self.begun.start + (self.center - self.begun.start) * (radius / self.radius);
        (Helix { center, radius, ..self }, turns)
    }
}

impl Planner<'_> {
    /// Down into full stock and onto a pass, if possible at a place of it; at that place if it was
    /// planned, as links depend on it.
    pub fn enter(
        &mut self,
        ground: &Ground,
        course: Course,
        (place, is_planned): (Place, bool),
        height: Height,
    ) -> Result<Course, Error> {
        if self.job.entry == Entry::Helix
            && let Some(helix) = ground.helix(self.job, &course, (place, is_planned))
        {
            return self.helix(helix, height);
        }
        self.ramp(course.begun_at(place, ground.slack), height)
    }

    fn helix(&mut self, helix: Helix, height: Height) -> Result<Course, Error> {
        let slope = self.job.ramp_angle.to_radians();
        let run = (height.surface - height.z) / slope.tan();
        let (Helix { begun, center, .. }, turns) = helix.fitted(run, NARROWEST * self.job.tool);
        let halves = 2.0 * turns;
        self.afford(halves as u64)?;
        let ahead = begun.elements.first().map_or(Vector::default(), |e| e.normals().0);
        let sense = (center - begun.start).dot(ahead).signum();
        let opposite = center + (center - begun.start);
        let rate = self.job.feed.min(self.job.plunge_feed / slope.sin());
        self.cutter.over(begun.start, height.surface);
        self.cutter.plunge(height.surface);
        let mut at = [begun.start, opposite];
        let before = self.cutter.totals.cut_length;
        for i in 1..=halves as u64 {
            let z = height.surface + (height.z - height.surface) * (i as f64 / halves);
            let z = if i as f64 == halves { height.z } else { z };
            self.cutter.follow(&Element::arc(at[0], at[1], sense), z, rate);
            at.reverse();
        }
        self.entered(self.cutter.totals.cut_length - before);
        Ok(begun)
    }

    /// Along the pass where it is long enough, else straight.
    fn ramp(&mut self, course: Course, height: Height) -> Result<Course, Error> {
        let length = course.length();
        if self.job.entry == Entry::Plunge || length <= self.job.radius() {
            self.fell_back(Entry::Plunge, course.start);
            self.cutter.over(course.start, height.surface);
            self.cutter.plunge(height.z);
            self.entered(height.surface - height.z);
            return Ok(course);
        }
        self.fell_back(Entry::Ramp, course.start);
        let slope = self.job.ramp_angle.to_radians();
        let run = (height.surface - height.z) / slope.tan();
        self.afford(((run / length).ceil() as u64).saturating_mul(course.elements.len() as u64))?;
        let ramp = if course.closed { course.tail(run) } else { to_and_fro(&course, run) };
        let rate = self.job.feed.min(self.job.plunge_feed / slope.sin());
        self.cutter.over(ramp.first().map_or(course.start, |e| e.start), height.surface);
        self.cutter.plunge(height.surface);
        let whole: f64 = ramp.iter().map(Element::length).sum();
        let mut gone = 0.0;
        let before = self.cutter.totals.cut_length;
        for (i, e) in ramp.iter().enumerate() {
            gone += e.length();
            let z = height.surface + (height.z - height.surface) * (gone / whole).min(1.0);
            self.cutter.follow(e, if i + 1 == ramp.len() { height.z } else { z }, rate);
        }
        self.entered(self.cutter.totals.cut_length - before);
        Ok(course)
    }

    /// Minutes that the way down into stock takes at least.
    pub fn minutes_down(&self, height: Height) -> f64 {
        let depth = height.surface - height.z;
        if self.job.entry == Entry::Plunge {
            return depth / self.job.plunge_feed;
        }
        let slope = self.job.ramp_angle.to_radians().sin();
        depth / slope / self.job.feed.min(self.job.plunge_feed / slope)
    }

    /// Counts a way down into stock.
    fn entered(&mut self, length: f64) {
        self.amounts.entry_length += length;
        self.amounts.full_width_length += length;
    }

    fn fell_back(&mut self, to: Entry, place: Point) {
        if to == self.job.entry {
            return;
        }
        let (ramps, plunges, first) = self.fallbacks.get_or_insert((0, 0, None));
        if to == Entry::Plunge {
            *plunges += 1;
            first.get_or_insert(place);
        } else {
            *ramps += 1;
        }
    }
}

impl Ground<'_> {
    /// The helix at a place of a pass; where there is not all the room that it may take, and the place
    /// not planned, at the place below the peak that the axis climbs to, if that is better. `None` if
    /// there is none worth it.
    fn helix(&self, job: &Job, course: &Course, (place, is_planned): (Place, bool)) -> Option<Helix> {
        let roads = self.roads.as_ref()?;
        let (spot, side) = roads.foot(place.point)?;
        let center = roads.place(spot);
        let depth = roads.radius(spot) - center.distance(place.point);
        let here = self.touching(job, course, roads.spoke(spot.edge, side, center), place.point);
        let is_worth_it = |h: &Helix| h.radius >= NARROWEST * job.tool;
        if is_planned || here.as_ref().is_some_and(|h| h.radius >= WIDEST * job.tool) {
            return here.filter(is_worth_it);
        }
        let (edge, peak) = roads.climb(spot);
        let there = [side, 1 - side].into_iter().find_map(|side| {
            let below = roads.on_spoke(edge, side, peak, depth);
            self.touching(job, course, roads.spoke(edge, side, peak), below)
        });
        let radius = |h: &Option<Helix>| h.as_ref().map_or(0.0, |h| h.radius);
        let best = if radius(&there) > radius(&here) { there } else { here };
        best.filter(is_worth_it)
    }

    /// The widest circle that touches a pass at a place and keeps off the wall.
    fn touching(&self, job: &Job, course: &Course, inward: Vector, place: Point) -> Option<Helix> {
        let found = course.nearest(place);
        if !course.closed || found.distance > self.slack {
            return None;
        }
        let begun = course.begun_at(found, self.slack);
        let fits = |radius: f64| {
            let center = begun.start + inward * radius;
            (self.is_clear)(&Element::segment(center, center), job.wall_distance() + radius)
        };
        let widest = WIDEST * job.tool;
        let radius = if fits(widest) { widest } else { widest * bisect(|share| fits(share * widest)) };
        Some(Helix { center: begun.start + inward * radius, begun, radius })
    }
}

/// An open course run to and fro, at least as long as `run`, so that it ends where the course
/// begins.
fn to_and_fro(course: &Course, run: f64) -> Vec<Element> {
    let times = (run / course.length()).ceil().max(1.0) as usize;
    let back = || course.elements.iter().rev().map(Element::reversed);
    let mut ramp = Vec::with_capacity(times * course.elements.len());
    for i in (0..times).rev() {
        if i % 2 == 0 {
            ramp.extend(back());
        } else {
            ramp.extend_from_slice(&course.elements);
        }
    }
    ramp
}
