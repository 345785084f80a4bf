//! The way to a pass that no straight link leads to.
//!
//! Along the axis at depth, if that does not take much more time, and through stock where a slot is
//! asked for and nothing beside the pass is cut; else up, across, and down into a neighbor that is
//! cut already and straight over from there; else down into full stock.

use super::course::Course;
use super::detour::{Way, Wish};
use super::plan::{Ground, Height, Planner};
use crate::error::Error;
use crate::geom::{Element, Point};

/// Farthest that a link along the axis may leave it, in tool radii: nothing is shaped by such a link,
/// and its distance to the wall is judged for itself.
const LINK_FLATNESS: f64 = 1.0 / 64.0;

/// How many times longer than lifting the tool a link at depth may take: each time that the tool gets
/// down it leaves a mark, and machines lift more slowly than they say. With 3 some plates of the drawings
/// tried lifted it more often than they have peaks; staying down there takes a fortieth more time.
const STAY_DOWN: f64 = 12.0;

/// A way down beside a pass, into a neighbor that is cut already, and straight over from there.
struct Approach {
    link: Element,
    /// The pass, begun where the link ends.
    begun: Course,
}

/// Lengths of cut that take as long as what a link along the axis stands for.
#[derive(Clone, Copy)]
struct Limits {
    /// The way over to the pass.
    length: f64,
    /// Lifting the tool and coming down again.
    lift: f64,
}

impl Planner<'_> {
    /// To a pass that no straight link leads to: beside what is cut along the axis or over it, else
    /// down into full stock.
    pub fn approach(
        &mut self,
        ground: &mut Ground,
        (pass, rest): (usize, &[usize]),
        course: Course,
        height: Height,
    ) -> Result<Course, Error> {
        let planned = ground.begin[pass];
        let place = planned.or_else(|| ground.toward(pass, rest.first().copied()));
        let place = course.nearest(place.unwrap_or_else(|| course.calm_place()));
        let door = self.door(ground, pass, &course);
        let as_long = |p: Point, surface: f64| self.cutter.minutes_over(p, surface) * self.job.feed;
        let lift = self.cutter.at().map_or(0.0, |here| as_long(here, height.z));
        let length = match &door {
            Some(Approach { link, .. }) => as_long(link.start, height.z) + link.length(),
            None => as_long(place.point, height.surface) + self.minutes_down(height) * self.job.feed,
        };
        let limits = Limits { length: STAY_DOWN * length, lift };
        if let Some(detoured) = self.detour(ground, (pass, rest), &course, limits, false) {
            return Ok(detoured);
        }
        if door.is_none()
            && self.job.slot
            && let Some(detoured) = self.detour(ground, (pass, rest), &course, limits, true)
        {
            return Ok(detoured);
        }
        let Some(Approach { link, begun }) = door else {
            return self.enter(ground, course, (place, planned.is_some()), height);
        };
        self.cutter.over(link.start, height.z);
        self.cutter.plunge(height.z);
        self.amounts.full_width_length += link.length();
        self.cut_link(&link);
        Ok(begun)
    }

    /// Along the axis to the pass, if that takes not much more time than the way over; through stock, if
    /// it may be a slot.
    fn detour(
        &mut self,
        ground: &mut Ground,
        (pass, rest): (usize, &[usize]),
        course: &Course,
        limits: Limits,
        is_slot: bool,
    ) -> Option<Course> {
        let flat = LINK_FLATNESS * self.job.radius();
        let slot = is_slot.then_some(usize::from(self.job.finish > 0.0));
        let Way { places, slot_length } =
            ground.detour(self.cutter.at()?, pass, (limits.length, flat), slot)?;
        let end = *places.last()?;
        let begun = course.nearest(end);
        let begun = course.begun_at(begun, ground.slack);
        if begun.start.distance(end) > ground.slack {
            return None;
        }
        let links = chain(&places, begun.start, ground.slack);
        let length: f64 = links.iter().map(Element::length).sum();
        // Where the passes that follow would rather be lifted to, nothing is gained.
        let farther = ground.farther_on(begun.start, pass, rest, limits.lift);
        if farther >= limits.lift || length + farther >= limits.length {
            return None;
        }
        let clear = |link: &Element| (ground.is_clear)(link, self.job.wall_distance());
        if !links.iter().all(clear) || self.afford(links.len() as u64).is_err() {
            return None;
        }
        if slot_length > 0.0 {
            self.amounts.slots += 1;
            self.amounts.slot_length += slot_length;
            self.amounts.full_width_length += slot_length;
        }
        links.iter().for_each(|link| self.cut_link(link));
        Some(begun)
    }

    /// Where to get down beside the pass.
    fn door(&self, ground: &Ground, pass: usize, course: &Course) -> Option<Approach> {
        let here = self.cutter.at()?;
        let inner = ground.nest.inner[pass].iter().map(|d| (d, true));
        let outer = ground.nest.outer[pass].iter().map(|d| (d, false));
        let open = inner.chain(outer).filter(|(d, _)| ground.done[d.pass]);
        let (door, inside) =
            open.min_by(|(a, _), (b, _)| a.at.distance(here).total_cmp(&b.at.distance(here)))?;
        [ground.begin[pass], Some(door.at)].into_iter().flatten().find_map(|place| {
            let begun = course.begun_at(course.nearest(place), ground.slack);
            let from = if inside {
                door.at
            } else {
                Course::along(ground.spline(door.pass), false)?.nearest(begun.start).point
            };
            let link = Element::segment(from, begun.start);
            self.may_link(ground, &link, pass, door.pass).then_some(Approach { link, begun })
        })
    }
}

impl Ground<'_> {
    /// A link along the axis from the end of the last pass to another one.
    fn detour(
        &mut self,
        from: Point,
        to: usize,
        (shorter_than, flat): (f64, f64),
        slot: Option<usize>,
    ) -> Option<Way> {
        let (nest, done, last) = (&self.nest, &self.done[..], self.last.as_ref()?.pass);
        let roads = self.roads.as_ref()?;
        self.detours.as_mut()?.find(roads, &Wish { nest, done, from, last, to, shorter_than, flat, slot })
    }

    /// How much longer than the step, in all, the links of the chain inward from a pass become when it
    /// begins here and not where it was planned to; counted no farther than a limit.
    fn farther_on(&self, begin: Point, pass: usize, rest: &[usize], limit: f64) -> f64 {
        let inward = |from: usize, to: usize| self.nest.inner[from].iter().any(|d| d.pass == to);
        let Some(&next) = rest.first().filter(|&&next| inward(pass, next)) else { return 0.0 };
        let Some(course) = Course::along(self.spline(next), false) else { return 0.0 };
        let each = course.nearest(begin).distance - self.apart(pass, next);
        if each <= self.slack {
            return 0.0;
        }
        // Later links turn out about as long as the first, as all lead along the axis.
        let most = (limit / each).ceil() as usize;
        let chain = rest.windows(2).take(most).take_while(|w| inward(w[0], w[1])).count() + 1;
        each * chain as f64
    }
}

/// Segments through places, the last of them moved to `end`; none as short as round-off but the last.
fn chain(places: &[Point], end: Point, slack: f64) -> Vec<Element> {
    let Some((&first, rest)) = places.split_first() else { return Vec::new() };
    let mut links = Vec::with_capacity(rest.len());
    let mut at = first;
    for &p in rest.iter().take(rest.len().saturating_sub(1)) {
        if at.distance(p) > slack {
            links.push(Element::segment(at, p));
            at = p;
        }
    }
    links.push(Element::segment(at, end));
    links
}
