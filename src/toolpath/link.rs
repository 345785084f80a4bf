//! From the end of a pass to its neighbor at depth: along two arcs that leave the one and meet the other
//! in its direction, else straight across.
//!
//! **Needs** a pass that was cut just now, and the way that its neighbor takes.
//! **Guarantees** that a link keeps as far from the wall as the outer one of both passes, and cuts no fresh
//! material wider than they lie apart. **Does not** bend where a corner is near.
//!
//! **Method.** Outward, as the other way round the next pass has its place already. Where both passes
//! run on smoothly, the strip between them is made of spokes from the one to the other: none of its
//! places is farther from the pass that is cut than the two lie apart. The link is the biarc with equal
//! tangents from the end of the one to a place of the other somewhat farther ahead than aside. Its first
//! arc stays nearer to its start than the passes are to each other, so it does not come beyond the second.

use super::course::{Course, LONG, Place, turns};
use super::plan::{Ground, Planner};
use crate::geom::{Element, Point, Vector};

/// How far ahead a link meets the next pass, in distances between the two. More would be a longer way, less
/// would turn nearly by a right angle.
const AHEAD: f64 = 1.5;

/// Two arcs, and the next pass, begun where they lead to.
#[derive(Clone)]
pub(super) struct Bend {
    arcs: [Element; 2],
    pub begun: Course,
}

/// What there is from the end of a pass to another: the pass, and the elements that it begins and ends with.
pub(super) type KnownBend = ((usize, [Element; 2]), Option<Bend>);

/// The pass in whose end the tool stands.
pub(super) struct Last {
    pub pass: usize,
    pub course: Course,
}

impl Last {
    /// Pass and elements that tell its end from others.
    fn end(&self) -> Option<(usize, [Element; 2])> {
        Some((self.pass, [*self.course.elements.first()?, *self.course.elements.last()?]))
    }
}

impl Planner<'_> {
    /// On from the end of the last pass, where that is a neighbor.
    pub fn link(&mut self, ground: &mut Ground, pass: usize, course: Course) -> Result<Course, Course> {
        let Some(last) = ground.last.as_ref().map(|last| last.pass) else { return Err(course) };
        let mut doors = ground.nest.inner[pass].iter().chain(&ground.nest.outer[pass]);
        if doors.all(|d| d.pass != last) {
            return Err(course);
        }
        if ground.begin[pass].is_some() {
            return self.straight_link(ground, (pass, last), &course).ok_or(course);
        }
        match ground.bend(pass, course) {
            Ok(bend) => Ok(self.along_bend(ground, pass, bend)),
            Err(course) => self.straight_link(ground, (pass, last), &course).ok_or(course),
        }
    }

    /// Straight to a pass from the last one, where that is short and free.
    fn straight_link(
        &mut self,
        ground: &Ground,
        (pass, last): (usize, usize),
        course: &Course,
    ) -> Option<Course> {
        let planned = ground.begin[pass];
        let here = self.cutter.at()?;
        [planned, Some(here)].into_iter().flatten().find_map(|place| {
            let begun = course.begun_at(course.nearest(place), ground.slack);
            let link = Element::segment(here, begun.start);
            self.may_link(ground, &link, pass, last).then(|| {
                // Straight across into what the next pass is to cut.
                self.amounts.full_width_length += link.length();
                self.cut_link(&link);
                begun
            })
        })
    }

    /// Along a link that bends, to the pass that begins there.
    pub fn along_bend(&mut self, ground: &Ground, pass: usize, Bend { arcs, begun }: Bend) -> Course {
        arcs.iter().for_each(|arc| self.cut_link(arc));
        // Turned outward as far as that, the tool is as good as full from half its width on.
        if ground.last.as_ref().is_some_and(|last| ground.apart(pass, last.pass) > self.job.radius()) {
            self.amounts.full_width_length += arcs.iter().map(Element::length).sum::<f64>();
        }
        begun
    }

    /// Along a link, which is counted.
    pub fn cut_link(&mut self, link: &Element) {
        self.amounts.link_length += link.length();
        self.cutter.cut(link);
    }

    /// Whether a straight link between neighbors is short and free.
    pub fn may_link(&self, ground: &Ground, link: &Element, a: usize, b: usize) -> bool {
        link.length() <= ground.apart(a, b) + ground.slack
            && (ground.is_clear)(link, self.job.wall_distance())
    }
}

impl Ground<'_> {
    /// The link that bends to a pass, if it is known from the height before, where the last pass was begun at the
    /// same place.
    pub fn bend_again(&self, pass: usize) -> Option<Bend> {
        if self.begin[pass].is_some() { None } else { self.known_bend(pass)?.clone() }
    }

    fn known_bend(&self, pass: usize) -> Option<&Option<Bend>> {
        let from = self.last.as_ref()?.end()?;
        self.bends.get(&pass).filter(|known| known.0 == from).map(|known| &known.1)
    }

    /// A link that bends outward from the last pass to the next one, if there is one.
    fn bend(&mut self, pass: usize, course: Course) -> Result<Bend, Course> {
        if let Some(known) = self.known_bend(pass) {
            return known.clone().ok_or(course);
        }
        let Some((last, end)) = self.last.as_ref().and_then(|last| Some((last, last.end()?))) else {
            return Err(course);
        };
        let is_long = course.elements.len() >= LONG;
        let bend = match self.new_bend(last, pass, &course) {
            Some((arcs, place)) => Ok(Bend { arcs, begun: course.begin_at(place, self.slack) }),
            None => Err(course),
        };
        if is_long {
            bend.as_ref().ok().and_then(|bend| bend.begun.tally());
            self.bends.insert(pass, (end, bend.as_ref().ok().cloned()));
        }
        bend
    }

    /// A link that bends outward from a closed pass to the next one, and where it meets that.
    fn new_bend(&self, last: &Last, pass: usize, course: &Course) -> Option<([Element; 2], Place)> {
        let is_outward = self.nest.outer[last.pass].iter().any(|door| door.pass == pass);
        if !(is_outward && last.course.closed && course.closed) {
            return None;
        }
        let from = last.course.end();
        let leaving = last.course.elements.last()?.tangents().1;
        let (apart, foot) = (self.apart(last.pass, pass), course.nearest(from));
        let distance = self.distance(pass) - self.slack;
        let onto = course.ahead_of(foot, AHEAD * apart)?;
        let arriving = course.elements[onto.element].tangent_at(onto.point);
        let arcs = biarc((from, leaving), (onto.point, arriving))?;
        let is_free = last.course.begins_beside(onto.point, apart + self.slack)
            && arcs[0].chord().length() <= apart
            && (self.is_clear)(&arcs[1], distance);
        is_free.then_some((arcs, onto))
    }
}

impl Course {
    /// The place of a closed course that follows another at a length, if there is no corner between.
    fn ahead_of(&self, place: Place, length: f64) -> Option<Place> {
        let n = self.elements.len();
        let on = &self.elements[place.element];
        let mut left = length + on.parameter(place.point).clamp(0.0, 1.0) * on.length();
        for i in 0..n {
            let element = (place.element + i) % n;
            let (e, next) = (&self.elements[element], &self.elements[(element + 1) % n]);
            if left < e.length() {
                return Some(Place { element, point: e.point_at(left / e.length()), distance: 0.0 });
            }
            if turns(e, next) {
                return None;
            }
            left -= e.length();
        }
        None
    }

    /// Whether a place is near a closed course before it comes to its first corner.
    fn begins_beside(&self, place: Point, within: f64) -> bool {
        let (elements, n) = (&self.elements, self.elements.len());
        let smooth = (0..n).take_while(|&i| !turns(&elements[(i + n - 1) % n], &elements[i]));
        let mut gone = 0.0;
        for i in smooth {
            if elements[i].distance(place) <= within {
                return true;
            }
            gone += elements[i].length();
            // What comes back to the place after that is another part of the pocket.
            if gone > self.start.distance(place) + 2.0 * within {
                break;
            }
        }
        false
    }
}

impl Element {
    /// Direction of travel at a place of the element.
    fn tangent_at(&self, place: Point) -> Vector {
        self.split(self.parameter(place)).0.tangents().1
    }
}

/// Two arcs from a place and a direction to another, touching each other between; none where they would
/// have to turn by more than a right angle.
fn biarc((from, leaving): (Point, Vector), (to, arriving): (Point, Vector)) -> Option<[Element; 2]> {
    let way = to - from;
    let (ahead, turn) = (way.dot(leaving + arriving), 2.0 * (1.0 - leaving.dot(arriving)));
    // Length of the tangents: the root of turn t^2 + 2 ahead t = |way|^2.
    let tangent = way.length_squared() / (ahead + (ahead * ahead + turn * way.length_squared()).sqrt());
    let joint = from.midpoint(to) + (leaving - arriving) * (0.5 * tangent);
    let first = (joint - from).unit();
    let second = (to - joint).unit();
    let (cos_first, cos_second) = (leaving.dot(first), second.dot(arriving));
    let bulges = [leaving.cross(first) / (1.0 + cos_first), second.cross(arriving) / (1.0 + cos_second)];
    let is_gentle = ahead > 0.0 && cos_first > std::f64::consts::FRAC_1_SQRT_2;
    let arcs = [Element::arc(from, joint, bulges[0]), Element::arc(joint, to, bulges[1])];
    (is_gentle && arcs.iter().all(Element::is_finite)).then_some(arcs)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ArcSpline, point, vector};

    #[test]
    fn a_link_touches_both_directions_and_itself() {
        for (to, arriving) in [
            (point(4.0, 1.0), vector(1.0, 0.0)),
            (point(4.0, -1.0), vector(0.8, 0.6)),
            (point(3.0, 2.0), vector(0.6, -0.8)),
        ] {
            let leaving = vector(1.0, 0.0);
            let [a, b] = biarc((point(0.0, 0.0), leaving), (to, arriving)).unwrap();
            assert_eq!((a.end, b.end), (b.start, to));
            for (one, other) in
                [(a.tangents().0, leaving), (a.tangents().1, b.tangents().0), (b.tangents().1, arriving)]
            {
                assert!((one - other).length() < 1e-14, "{one:?} {other:?}");
            }
        }
        assert!(biarc((point(0.0, 0.0), vector(1.0, 0.0)), (point(0.0, 1.0), vector(1.0, 0.0))).is_none());
    }

    #[test]
    fn a_place_ahead_is_found_over_smooth_joints_and_not_over_corners() {
        let slot = ArcSpline::closed([(0.0, 0.0, 0.0), (9.0, 0.0, 1.0), (9.0, 4.0, 0.0), (0.0, 4.0, 1.0)]);
        let course = Course::along(&slot, false).unwrap();
        let foot = course.nearest(point(8.0, -1.0));
        let quarter = 1.0 + std::f64::consts::PI;
        let place = course.ahead_of(foot, quarter).unwrap();
        assert!(place.point.distance(point(11.0, 2.0)) < 1e-12 && place.element == 1);
        assert!(course.ahead_of(foot, 1e3).is_none());
        let square = ArcSpline::closed([(0.0, 0.0, 0.0), (9.0, 0.0, 0.0), (9.0, 9.0, 0.0), (0.0, 9.0, 0.0)]);
        let course = Course::along(&square, false).unwrap();
        let foot = course.nearest(point(8.0, -1.0));
        assert!(course.ahead_of(foot, 0.5).is_some() && course.ahead_of(foot, 1.5).is_none());
    }
}
