//! `maximaldisk*`: the disk in which the edge between two neighboring arcs ends.
//!
//! Two arcs that are joined by an artificial arc, or by a convex vertex, bound an edge of the axis that
//! begins in that disk. A disk tangent to both moves away from there; the first other arc that it meets
//! makes it a branching disk, with three tangent points or more. As in the paper each arc in turn is
//! tested against the disk at hand, and where it overlaps, the disk tangent to the two and to that arc
//! takes its place. Where one of the two goes over smoothly into another arc the edge ends in the disk
//! at that joint.

use super::super::falling_root;
use super::super::piece::{Piece, UnitDisk};
use super::super::shot::probe_at;
use super::super::site::{Foot, Site};
use super::super::touch::foot_of;
use super::super::track::Track;
use super::apollonius::tangent_to_three;
use super::disk::Tangent;
use super::medialaxis::Division;
use super::subdomain::{DividingDisk, Slot};

/// A disk tangent to the two arcs.
struct Candidate {
    /// Its place on the first of them.
    t: f64,
    /// None where no disk at that place touches the second.
    disk: Option<UnitDisk>,
    /// What else it touches.
    third: Tangent,
}

/// The two arcs `a` and `b` and the arcs around them.
struct Pair<'a> {
    domain: &'a [Slot],
    before: usize,
    a: usize,
    b: usize,
    track: Track<'a>,
}

impl Division<'_> {
    /// The disk in which the edge ends that begins in the disk after place `a` of the subdomain.
    pub fn maximal_disk_star(&self, domain: &[Slot], a: usize) -> Option<DividingDisk> {
        let begin = domain[a].link.disk()?;
        let n = domain.len();
        let (before, b) = ((a + n - 1) % n, (a + 1) % n);
        let piece = self.piece(domain, a);
        let pair = Pair { domain, before, a, b, track: Track::of(self.sites, &piece) };
        let mut candidate = self.at_start(&pair);
        // An arc in the way may be passed over on the way back, so all are tested against the last disk.
        let others = || (0..n).filter(|&x| x != a && x != b);
        let mut settled = false;
        while !settled {
            settled = true;
            if let Some(nearer) = self.at_joint(&pair, &candidate) {
                (candidate, settled) = (nearer, false);
            }
            for x in others() {
                if self.overlaps(&pair, &candidate, x)
                    && let Some(nearer) = self.branching(&pair, &candidate, x)
                {
                    (candidate, settled) = (nearer, false);
                }
            }
        }
        // Only round-off can leave no disk at all, and then the edge has no length.
        let disk = candidate.disk.unwrap_or(self.graph.disks[begin as usize]);
        let tangents = match candidate.third {
            Tangent::Joint(i) if i == b => [Tangent::Piece(a), candidate.third, candidate.third],
            Tangent::Joint(_) => [Tangent::Piece(b), candidate.third, candidate.third],
            third => [Tangent::Piece(a), Tangent::Piece(b), third],
        };
        Some(self.best_defined(domain, self.dividing_disk(domain, disk, &tangents)))
    }

    /// The disk where the first arc begins.
    fn at_start(&self, pair: &Pair<'_>) -> Candidate {
        let probe = pair.track.at(0.0);
        let radius = self.reach(&self.piece(pair.domain, pair.b), &probe);
        let disk = radius.is_finite().then(|| UnitDisk { center: probe.center(radius), radius });
        let closed = pair.domain[pair.before].link.disk().is_some();
        let third = if closed { Tangent::Piece(pair.before) } else { Tangent::Joint(pair.before) };
        Candidate { t: 0.0, disk, third }
    }

    /// The disk where the second arc goes over smoothly to the next, if the candidate is tangent to it
    /// beyond that end only.
    fn at_joint(&self, pair: &Pair<'_>, candidate: &Candidate) -> Option<Candidate> {
        let [a, b] = [pair.a, pair.b].map(|i| self.piece(pair.domain, i));
        let [site, site_b] = [a, b].map(|p| &self.sites[p.site as usize]);
        let beyond = |d: UnitDisk| foot_of(site_b, d.center, &b.from, &b.to) == b.to;
        if pair.domain[pair.b].link.disk().is_some() || !candidate.disk.is_none_or(beyond) {
            return None;
        }
        let probe = probe_at(site_b);
        let radius = self.reach(&a, &probe);
        let disk = UnitDisk { center: probe.center(radius), radius };
        let t = parameter(site, &a, &foot_of(site, disk.center, &a.from, &a.to));
        let nearer = t > candidate.t || candidate.disk.is_none();
        (radius.is_finite() && nearer).then_some(Candidate {
            t,
            disk: Some(disk),
            third: Tangent::Joint(pair.b),
        })
    }

    /// Whether an arc reaches into the disk.
    fn overlaps(&self, pair: &Pair<'_>, candidate: &Candidate, x: usize) -> bool {
        let x = self.piece(pair.domain, x);
        match candidate.disk {
            Some(disk) => self.distance(&x, disk.center) < disk.radius - self.graph.error,
            None => {
                let probe = pair.track.at(candidate.t);
                self.reach(&x, &probe) < self.reach(&self.piece(pair.domain, pair.b), &probe)
            }
        }
    }

    /// The disk tangent to the two arcs and to another one that overlaps a candidate, nearer to where
    /// the edge begins.
    fn branching(&self, pair: &Pair<'_>, candidate: &Candidate, x: usize) -> Option<Candidate> {
        let [a, b, c] = [pair.a, pair.b, x].map(|i| self.piece(pair.domain, i));
        let t = falling_root(candidate.t, 1.0, |t| {
            let probe = pair.track.at(t);
            let (to_b, to_c) = (self.reach(&b, &probe), self.reach(&c, &probe));
            match (to_b.is_finite(), to_c.is_finite()) {
                (true, true) => (to_b - to_c) / (to_b + to_c),
                (true, false) => -1.0,
                (false, _) => 1.0,
            }
        });
        let probe = pair.track.at(t);
        let radius = self.reach(&b, &probe).min(self.reach(&c, &probe));
        if t <= candidate.t {
            return None;
        }
        if !radius.is_finite() {
            // The second arc comes into reach here; others are nearer then.
            return Some(Candidate { t, disk: None, third: Tangent::Piece(x) });
        }
        let near = UnitDisk { center: probe.center(radius), radius };
        let disk = tangent_to_three([a, b, c].map(|p| &self.sites[p.site as usize]), near);
        // The carriers may meet elsewhere than the arcs.
        let on_arcs = [a, b, c].iter().all(|p| {
            let gap = |d: &UnitDisk| (self.distance(p, d.center) - d.radius).abs();
            gap(&disk) <= gap(&near).max(self.graph.error)
        });
        let disk = Some(if on_arcs { disk } else { near });
        Some(Candidate { t, disk, third: Tangent::Piece(x) })
    }
}

/// Parameter on the track of a piece that leads to a foot: on a rational quadratic arc it divides as the
/// distances to the ends do, in a cone as the sines to the normals there.
fn parameter(site: &Site, piece: &Piece, foot: &Foot) -> f64 {
    let apart = |a: &Foot, b: &Foot| {
        if site.is_vertex { a.normal.cross(b.normal).abs() } else { a.point.distance(b.point) }
    };
    let (before, after) = (apart(&piece.from, foot), apart(foot, &piece.to));
    if before > 0.0 { before / (before + after) } else { 0.0 }
}
