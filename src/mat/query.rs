//! Questions to a finished axis.

use super::bvh::SearchDisk;
use super::site::Site;
use super::{Disk, Mat};
use crate::geom::{Element, Point};

impl Mat {
    /// A largest disk in the pocket.
    pub fn largest_disk(&self) -> Disk {
        let largest = self.graph.disks.iter().max_by(|a, b| a.radius.total_cmp(&b.radius));
        self.disk_out(largest.expect("an axis has a vertex"))
    }

    /// The narrowest neck: the smallest disk where the radius has an interior minimum.
    pub fn narrowest_neck(&self) -> Option<Disk> {
        let necks = (0..self.graph.disks.len()).filter(|&i| self.kinds.on_neck[i]);
        let narrowest = necks.map(|i| &self.graph.disks[i]).min_by(|a, b| a.radius.total_cmp(&b.radius));
        narrowest.map(|d| self.disk_out(d))
    }

    /// Distance of a place to the boundary of the pocket, in job units, from either side.
    pub fn distance(&self, p: Point) -> f64 {
        let c = self.frame.enter(p);
        // Outside of the unit frame the nearest box may be any distance away.
        let far = 2.0 + c.to_vector().length();
        self.frame.length_out(self.unit_distance(c, far))
    }

    /// A site nearest to a place of the unit frame; where several are, any of them.
    pub(crate) fn nearest_site(&self, c: Point) -> u32 {
        let mut nearest = (f64::INFINITY, 0);
        let everything = SearchDisk { center: c, radius: 2.0 + c.to_vector().length() };
        self.bvh.search(everything, |i| {
            let d = self.sites[i as usize].distance(c);
            (d < nearest.0).then(|| {
                nearest = (d, i);
                SearchDisk { center: c, radius: d }
            })
        });
        nearest.1
    }

    /// Whether a disk of this radius can be moved along a path (that begins inside) without leaving
    /// the pocket by more than round-off.
    pub fn is_clear(&self, path: &Element, radius: f64) -> bool {
        let inside = Element {
            start: self.frame.enter(path.start),
            end: self.frame.enter(path.end),
            bulge: path.bulge,
        };
        let needed = self.frame.length_in(radius) - self.graph.error;
        let reach = 0.5 * inside.length() + needed.max(0.0) + self.residual_error();
        let mut clear = true;
        let around = SearchDisk { center: inside.point_at(0.5), radius: reach };
        let beads = Beads::new(&inside, needed.max(0.0) + self.residual_error());
        self.bvh.search(around, |i| {
            let site = &self.sites[i as usize];
            // In a pocket that is nearly round many boxes are in reach, and few sites.
            let is_out_of_reach = site.distance(around.center) > reach || beads.are_off(site);
            clear &= is_out_of_reach || gap(&inside, site) >= needed;
            // Once something is in the way there is nothing left to search.
            (!clear).then_some(SearchDisk { center: around.center, radius: 0.0 })
        });
        clear
    }
}

/// A path as a string of pieces, each within half its length of its middle.
struct Beads {
    middles: [Point; Beads::COUNT],
    half: f64,
    room: f64,
}

impl Beads {
    const COUNT: usize = 16;

    /// The pieces of a path that wants so much room around it.
    fn new(path: &Element, room: f64) -> Beads {
        let middle = |i: usize| path.point_at((i as f64 + 0.5) / Beads::COUNT as f64);
        let half = 0.5 * path.length() / Beads::COUNT as f64;
        Beads { middles: std::array::from_fn(middle), half, room }
    }

    /// Whether a site leaves all pieces their room for sure. Where it is far from one, it is not near to the next.
    fn are_off(&self, site: &Site) -> bool {
        let mut i = 0;
        while let Some(&middle) = self.middles.get(i) {
            let beyond = site.distance(middle) - self.room - self.half;
            if beyond.is_nan() || beyond <= 0.0 {
                return false;
            }
            i = i.saturating_add((0.5 * beyond / self.half) as usize).saturating_add(1);
        }
        true
    }
}

/// Distance between a path and a site; 0 where they cross.
///
/// The nearest places of two curves are an end of one of them, or lie on the common normal through
/// their centers (or across a straight one).
fn gap(path: &Element, site: &Site) -> f64 {
    if crosses(path, site) {
        return 0.0;
    }
    let mut best = site.distance(path.start).min(site.distance(path.end));
    best = best.min(path.distance(site.start.point)).min(path.distance(site.end.point));
    let mut common_normal = |p: Point| {
        let t = path.parameter(p);
        if t > 0.0 && t < 1.0 {
            best = best.min(site.distance(path.point_at(t)));
        }
    };
    let center = site.center();
    match path.center() {
        None => {
            if let Some(c) = center {
                common_normal(c);
            }
        }
        Some((own, radius)) => {
            let across = match center {
                Some(c) => (c - own).unit(),
                None => site.start.normal,
            };
            common_normal(own + across * radius);
            common_normal(own - across * radius);
        }
    }
    best
}

/// Whether the path changes the side of the site between its ends.
fn crosses(path: &Element, site: &Site) -> bool {
    if site.is_vertex {
        return false;
    }
    let sides = |e: &Element| {
        let (a, b) = (site.carrier_distance(e.start).0, site.carrier_distance(e.end).0);
        (a, b)
    };
    // Cut so that each part meets the carrier once at most: at the places nearest to its center.
    let mut cuts = vec![0.0, 1.0];
    let mut cut_at = |p: Point| {
        let t = path.parameter(p);
        if t > 0.0 && t < 1.0 {
            cuts.push(t);
        }
    };
    let center = site.center();
    match (path.center(), center) {
        (None, Some(c)) => cut_at(c),
        (Some((own, radius)), c) => {
            let across = c.map_or(site.start.normal, |c| (c - own).unit());
            cut_at(own + across * radius);
            cut_at(own - across * radius);
        }
        (None, None) => {}
    }
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2).any(|w| {
        let part = path.part(w[0], w[1]);
        let (a, b) = sides(&part);
        if (a < 0.0) == (b < 0.0) {
            return false;
        }
        // Bisection for the place on the carrier; 60 halvings of a part of the unit frame.
        const HALVINGS: usize = 60;
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let t = 0.5 * (low + high);
            if (site.carrier_distance(part.point_at(t)).0 < 0.0) == (a < 0.0) { low = t } else { high = t }
        }
        site.spans(part.point_at(low))
    })
}
