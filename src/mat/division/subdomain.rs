//! Subdomains, and how a disk divides one.

use super::super::graph::Graph;
use super::super::piece::UnitDisk;
use super::super::site::{Foot, Site};

/// How the boundary of a subdomain goes on from a piece to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Link {
    /// Smoothly, in a vertex of the drawing.
    Smooth,
    /// Between an element and the normal cone of a reflex vertex, which is an arc of length zero.
    Reflex,
    /// In a convex vertex, where the maximal disk has the radius 0.
    Convex(u32),
    /// Along an artificial arc: a part of the circle of this disk.
    Artificial(u32),
}

impl Link {
    /// The disk in which the piece before and the piece after both end.
    pub fn disk(self) -> Option<u32> {
        match self {
            Link::Convex(disk) | Link::Artificial(disk) => Some(disk),
            Link::Smooth | Link::Reflex => None,
        }
    }
}

/// A non-artificial arc of a subdomain, and what follows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    pub piece: u32,
    pub link: Link,
}

/// The closed row of arcs around a part of the pocket, counter-clockwise.
pub(super) type Subdomain = Vec<Slot>;

/// Where a disk touches a piece: at its ends, or between them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Touch {
    pub start: bool,
    pub inside: Option<Foot>,
    pub end: bool,
}

impl Touch {
    pub fn is_any(&self) -> bool {
        self.start || self.inside.is_some() || self.end
    }
}

/// A maximal disk of a subdomain with its tangent points.
#[derive(Clone, Debug)]
pub(super) struct DividingDisk {
    pub disk: UnitDisk,
    /// Where the pieces are cut.
    touches: Vec<Touch>,
    /// Whether the disk touches where the piece goes over to the next.
    joints: Vec<bool>,
}

impl DividingDisk {
    /// From what the disk touches of each piece. A joint belongs to two pieces and the whole cone of a
    /// reflex vertex lies in one place, so what touches a piece in its end may be tangent elsewhere.
    pub fn new(domain: &[Slot], disk: UnitDisk, mut touches: Vec<Touch>) -> DividingDisk {
        let found = touches.clone();
        let n = domain.len();
        let mut joints = vec![false; n];
        for (i, slot) in domain.iter().enumerate() {
            let j = (i + 1) % n;
            if slot.link.disk().is_some() {
                continue;
            }
            joints[i] = found[i].end && found[j].start;
            touches[i].end = false;
            touches[j].start = false;
        }
        DividingDisk { disk, touches, joints }
    }

    /// Number of arcs in each subdomain that the disk makes.
    fn parts(&self) -> Vec<usize> {
        let (mut parts, mut count) = (Vec::new(), 0);
        for (touch, &joint) in self.touches.iter().zip(&self.joints) {
            let cuts =
                usize::from(touch.start) + usize::from(touch.inside.is_some()) + usize::from(touch.end);
            count += 1;
            for _ in 0..cuts {
                parts.push(std::mem::replace(&mut count, 1));
            }
            if joint {
                parts.push(std::mem::replace(&mut count, 0));
            }
        }
        match parts.first_mut() {
            Some(first) => *first += count,
            None => parts.push(count),
        }
        parts
    }

    /// Whether every subdomain has less arcs than the whole.
    pub fn is_reducing(&self) -> bool {
        self.parts().iter().all(|&count| count < self.touches.len())
    }

    /// Which pieces it touches, in order.
    pub fn touched(&self) -> impl Iterator<Item = usize> + '_ {
        let touches = self.touches.iter().zip(&self.joints);
        touches.enumerate().filter(|(_, (t, joint))| t.is_any() || **joint).map(|(i, _)| i)
    }

    /// Splits the subdomain, cutting the pieces that it touches between their ends.
    pub fn split(&self, sites: &[Site], graph: &mut Graph, domain: &[Slot]) -> Vec<Subdomain> {
        let disk = graph.add_disk(self.disk);
        let artificial = Link::Artificial(disk);
        let (mut parts, mut row) = (Vec::new(), Subdomain::new());
        for ((slot, touch), &joint) in domain.iter().zip(&self.touches).zip(&self.joints) {
            let piece = graph.piece(sites, slot.piece);
            let start = touch.start.then_some(piece.from);
            let end = touch.end.then_some(piece.to);
            let mut rest = slot.piece;
            for foot in [start, touch.inside, end].into_iter().flatten() {
                row.push(Slot { piece: rest, link: artificial });
                rest = graph.cut(rest, foot);
                parts.push(std::mem::take(&mut row));
            }
            row.push(Slot { piece: rest, link: if joint { artificial } else { slot.link } });
            if joint {
                parts.push(std::mem::take(&mut row));
            }
        }
        // What follows the last tangent point goes on with what comes before the first.
        match parts.first_mut() {
            Some(first) => {
                row.append(first);
                *first = row;
            }
            None => parts.push(row),
        }
        parts
    }
}
