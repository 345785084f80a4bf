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

use super::course::{Course, Place, turns};
use super::plan::{Ground, Planner};
use crate::geom::{Element, Point, Vector};

/// How far ahead a link meets the next pass, in distances between the two. More would be a longer way, less
/// would turn nearly by a right angle.
const AHEAD: f64 = 1.5;

/// Elements of a pass for which it is worth to know a link again.
const LONG: usize = 1 << 10;

/// Two arcs, and the place of the next pass that they lead to.
type Bend = ([Element; 2], Place);

/// What there is from the end of a pass to another: the pass, and the elements that it begins and ends with.
pub(super) type KnownBend = ((usize, [Element; 2]), Option<Bend>);

/// The pass in whose end the tool stands.
pub(super) struct Last {
    pub pass: usize,
    pub course: Course,
}

impl Planner<'_> {
    /// On from the end of the last pass, where that is a neighbor.
    pub fn link(&mut self, ground: &mut Ground, pass: usize, course: &Course) -> Option<Course> {
        let last = ground.last.as_ref()?.pass;
        let doors = ground.nest.inner[pass].iter().chain(&ground.nest.outer[pass]);
        doors.into_iter().find(|d| d.pass == last)?;
        let planned = ground.begin[pass];
        if planned.is_none()
            && let Some((arcs, place)) = ground.bend(pass, course)
        {
            arcs.iter().for_each(|arc| self.cut_link(arc));
            // Turned outward as far as that, the tool is as good as full from half its width on.
            if ground.apart(pass, last) > self.job.radius() {
                self.amounts.full_width_length += arcs.iter().map(Element::length).sum::<f64>();
            }
            return Some(course.begun_at(place, ground.slack));
        }
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
    /// A link that bends outward from the last pass to the next one, if there is one: as it was found at a height
    /// before, where the last pass was begun at the same place.
    fn bend(&mut self, pass: usize, course: &Course) -> Option<Bend> {
        let last = self.last.as_ref()?;
        let ends = [*last.course.elements.first()?, *last.course.elements.last()?];
        let known = self.bends.get(&pass).filter(|known| known.0 == (last.pass, ends));
        let bend = known.map_or_else(|| self.new_bend(last, pass, course), |known| known.1);
        if course.elements.len() >= LONG {
            self.bends.insert(pass, ((last.pass, ends), bend));
        }
        bend
    }

    /// A link that bends outward from a closed pass to the next one, and where it meets that.
    fn new_bend(&self, last: &Last, pass: usize, course: &Course) -> Option<Bend> {
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
