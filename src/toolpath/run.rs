//! Along a pass, with excursions to the crests beside it.
//!
//! A crest is run when the tool has come by it for the last time: behind it all is cut then, and what
//! the tool meets is what the passes on its sides left.

use super::Job;
use super::course::Course;
use super::crest::Gate;
use super::pace::Pace;
use super::plan::{Ground, Planner};
use crate::error::Error;
use crate::geom::{Element, Point};

/// Where a pass is left for a crest.
#[derive(Clone, Copy)]
struct Stop {
    /// Index of the element.
    element: usize,
    /// Parameter on the element.
    t: f64,
    crest: usize,
    gate: Gate,
}

impl Planner<'_> {
    /// Cuts a pass and the crests that are its own.
    pub fn run(&mut self, ground: &Ground, pass: usize, course: &Course) -> Result<(), Error> {
        let mut stops = ground.stops(pass, course).into_iter().peekable();
        let pace = ground.pace(self.job, pass, course);
        if pace.is_even() && stops.peek().is_none() {
            self.cutter.cut_all(course);
            return Ok(());
        }
        let mut start = 0.0;
        for (i, e) in course.elements.iter().enumerate() {
            let mut gone = 0.0;
            while let Some(stop) = stops.next_if(|s| s.element == i) {
                let part = e.part(gone, stop.t);
                if part.length() > ground.slack {
                    self.cut_paced((&pace, start), e, [gone, stop.t], ground.slack);
                    gone = stop.t;
                }
                self.leave_for(ground, stop, if gone > 0.0 { e.point_at(gone) } else { e.start })?;
            }
            if gone < 1.0 {
                self.cut_paced((&pace, start), e, [gone, 1.0], ground.slack);
            }
            start += if pace.is_even() { 0.0 } else { e.length() };
        }
        Ok(())
    }

    /// Cuts a part of an element that starts at this length along its course.
    fn cut_paced(&mut self, (pace, start): (&Pace, f64), e: &Element, [from, to]: [f64; 2], slack: f64) {
        if pace.is_even() {
            self.cutter.cut(&if [from, to] == [0.0, 1.0] { *e } else { e.part(from, to) });
            return;
        }
        let length = e.length();
        let ends = [start + from * length, start + to * length];
        // The ends stay as they are, to the last bit.
        let parameter = |s: f64| match s {
            s if s == ends[0] => from,
            s if s == ends[1] => to,
            s => (s - start) / length,
        };
        for ([a, b], is_slow) in pace.parts(ends[0], ends[1], slack) {
            let part = e.part(parameter(a), parameter(b));
            self.cutter.cut_at(&part, if is_slow { self.job.slow } else { 1.0 });
        }
    }

    fn leave_for(&mut self, ground: &Ground, stop: Stop, from: Point) -> Result<(), Error> {
        let way = ground.crests[stop.crest].excursion(stop.gate, from);
        self.afford(way.len() as u64)?;
        self.amounts.crests += 1;
        for e in &way {
            self.amounts.crest_length += e.length();
            self.cutter.cut(e);
        }
        Ok(())
    }
}

impl Ground<'_> {
    /// Where a pass is slow.
    fn pace(&self, job: &Job, pass: usize, course: &Course) -> Pace {
        if job.slow == 1.0 {
            return Pace::default();
        }
        match self.fresh.get(pass) {
            Some(None) => Pace::slow(),
            Some(Some(stretches)) => Pace::new(course, stretches, job.radius(), self.slack),
            None => Pace::default(),
        }
    }

    /// The last places of a course beside each of its crests, in order.
    fn stops(&self, pass: usize, course: &Course) -> Vec<Stop> {
        let last = |crest: &usize| {
            let gates = self.crests[*crest].gates.iter();
            let stops = gates.filter_map(|&gate| self.stop(course, *crest, gate));
            stops.max_by(|a, b| a.element.cmp(&b.element).then(a.t.total_cmp(&b.t)))
        };
        let mut stops: Vec<Stop> = self.crests_of[pass].iter().filter_map(last).collect();
        stops.sort_by(|a, b| a.element.cmp(&b.element).then(a.t.total_cmp(&b.t)).then(a.crest.cmp(&b.crest)));
        stops
    }

    fn stop(&self, course: &Course, crest: usize, gate: Gate) -> Option<Stop> {
        let distances = course.elements.iter().map(|e| e.distance(gate.at));
        let (element, _) = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let e: &Element = &course.elements[element];
        let t = e.parameter(gate.at).clamp(0.0, 1.0);
        // A place next to a vertex is the vertex: no element of round-off length.
        let t = if e.length() * (1.0 - t) <= self.slack { 1.0 } else { t };
        Some(Stop { element, t, crest, gate })
    }
}
