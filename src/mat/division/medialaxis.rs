//! Algorithm 4, `medialaxis`: divides until everything is a base case.

use super::super::Mat;
use super::super::bvh::Bvh;
use super::super::frame::Frame;
use super::super::graph::{BoundaryPiece, DISK_ROUNDINGS, Graph};
use super::super::piece::{Piece, UnitDisk};
use super::super::site::{Joint, NONE, Site};
use super::super::sites::Sites;
use super::base_case::BaseCase;
use super::subdomain::{DividingDisk, Link, Slot, Subdomain};
use crate::boundary::Pocket;
use crate::error::Error;
use crate::geom::{Point, Vector};
use std::collections::HashMap;

/// Random arcs that are tried before a subdomain is given up. But for round-off
/// one is enough wherever a disk or a convex vertex bounds the subdomain: `maximaldisk*` reduces it.
const ATTEMPTS: usize = 64;

impl Pocket {
    /// The medial axis transform by the recursion of Aichholzer et al., *Medial axis computation for
    /// planar free-form shapes* (Computer-Aided Design 41, 2009), section 3.
    ///
    /// This is the judge of [`medial_axis`](Pocket::medial_axis): it decides by other disks, in another
    /// order, what is connected with what, at a cost per disk that is linear in the part it divides.
    ///
    /// # Errors
    /// [`Error::Islands`] when the pocket has islands that do not touch its wall, and
    /// [`Error::Internal`] when the loops do not bound a pocket after all.
    pub fn medial_axis_by_division(&self) -> Result<Mat, Error> {
        let frame = Frame::around(&self.bounds());
        let all = Sites::of(self, &frame, Vector::from_angle(0.0));
        let islands = all.rings.iter().filter(|r| r.link.is_some()).count();
        if islands > 0 {
            return Err(Error::Islands { count: islands });
        }
        let error = DISK_ROUNDINGS * frame.noise;
        let mut division = Division::of(&all, error);
        division.medialaxis().map_err(|at| Error::Internal {
            what: "no maximal disk divides a part of the pocket".into(),
            at: frame.leave(at),
        })?;
        let graph = division.conquer();
        let bvh = Bvh::sorted(&all.sites.iter().map(Site::bounds).collect::<Vec<_>>());
        Ok(Mat::of_graph(frame, all, bvh, graph, 1))
    }
}

/// A pocket being divided.
pub(super) struct Division<'a> {
    pub sites: &'a [Site],
    pub graph: Graph,
    random: Random,
    open: Vec<Subdomain>,
}

impl<'a> Division<'a> {
    /// The undivided pocket: a subdomain for each ring of its boundary.
    fn of(all: &'a Sites, error: f64) -> Division<'a> {
        let mut graph = Graph { error, ..Graph::default() };
        for (id, site) in (0u32..).zip(&all.sites) {
            let whole = BoundaryPiece { foot: NONE, site: id, next: site.next, edge: NONE, left_out: false };
            graph.pieces.push(whole);
        }
        let mut corners = HashMap::new();
        let mut corner = |id: u32| {
            // Convex vertices of loops that touch are one vertex of the axis.
            let key = all.touching.get(&id).copied().unwrap_or(id);
            *corners.entry(key).or_insert_with(|| {
                graph.add_disk(UnitDisk { center: all.sites[id as usize].end.point, radius: 0.0 })
            })
        };
        let mut slot = |id: u32| {
            let link = match all.sites[id as usize].joint {
                Joint::Convex => Link::Convex(corner(id)),
                Joint::Smooth { .. } => Link::Smooth,
                Joint::Cone => Link::Reflex,
            };
            Slot { piece: id, link }
        };
        let open = all.rings.iter().map(|ring| ring.sites.clone().map(&mut slot).collect()).collect();
        Division { sites: &all.sites, graph, random: Random(SEED), open }
    }

    /// The piece in a place of a subdomain.
    pub fn piece(&self, domain: &[Slot], i: usize) -> Piece {
        self.graph.piece(self.sites, domain[i].piece)
    }

    /// Divides all that is open until it is a base case; a place of what no disk divides otherwise.
    fn medialaxis(&mut self) -> Result<(), Point> {
        while let Some(domain) = self.open.pop() {
            let base_case = BaseCase::of(&domain);
            match base_case {
                Some(BaseCase::ContactArc) => continue,
                Some(BaseCase::Edge) => {
                    self.add_edge(&domain);
                    continue;
                }
                _ => {}
            }
            let disk = match base_case {
                Some(BaseCase::Joint(joint)) => self.disk_at_joint(&domain, joint),
                Some(BaseCase::Leaf(middle)) => self.osculating_disk(&domain, middle),
                Some(BaseCase::Branch) => self.maximal_disk_star(&domain, 0),
                _ => None,
            };
            let disk = disk.filter(DividingDisk::is_reducing).or_else(|| self.divide(&domain));
            let disk = disk.ok_or_else(|| self.piece(&domain, 0).from.point)?;
            self.open.extend(disk.split(self.sites, &mut self.graph, &domain));
        }
        Ok(())
    }

    /// A disk that divides a subdomain into smaller ones: random at first.
    fn divide(&mut self, domain: &[Slot]) -> Option<DividingDisk> {
        for _ in 0..ATTEMPTS {
            let a = self.random.below(domain.len());
            let disk = self.maximal_disk(domain, a);
            if disk.as_ref().is_some_and(DividingDisk::is_reducing) {
                return disk;
            }
            let star =
                begin_of_edge(domain, a, disk.as_ref()).and_then(|i| self.maximal_disk_star(domain, i));
            if star.as_ref().is_some_and(DividingDisk::is_reducing) {
                return star;
            }
        }
        None
    }

    /// The edge between the two arcs of a base case.
    fn add_edge(&mut self, domain: &[Slot]) {
        if let [a, b] = domain
            && let (Some(at_a), Some(at_b)) = (a.link.disk(), b.link.disk())
        {
            self.graph.add_edge([a.piece, b.piece], [at_b, at_a]);
        }
    }
}

/// The disk where the edge between arc `a` and the arc `a'` begins that a non-reducing disk found; any
/// other one that closes the subdomain where that disk found no neighbor.
fn begin_of_edge(domain: &[Slot], a: usize, disk: Option<&DividingDisk>) -> Option<usize> {
    let n = domain.len();
    let closed = |i: &usize| domain[*i].link.disk().is_some();
    let touched: Vec<usize> = disk.map(|d| d.touched().collect()).unwrap_or_default();
    let neighbor = |i: &usize| touched.contains(i) && touched.contains(&((i + 1) % n));
    let around = [a, (a + n - 1) % n];
    around.into_iter().filter(closed).find(neighbor).or_else(|| (0..n).map(|i| (a + i) % n).find(closed))
}

/// Where the random choices begin.
const SEED: u64 = 0x9E37_79B9_7F4A_7C15;

/// Random numbers (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % n as u64) as usize
    }
}
