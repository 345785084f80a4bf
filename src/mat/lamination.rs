//! The contact lamination: maximal disks at all joints cut the pocket into faces.
//!
//! Every joint disk is a chord from the joint to its contact. One chord per hole, at its extreme
//! place, is a *link*: the boundary is walked as if the pocket were cut open along the links, and so
//! becomes one closed row of *visits* for each component. All other chords connect visits of that row.
//!
//! Chords of different maximal disks never cross, so chords that do cross in the row belong to one
//! disk with more than two contacts, whose ties round-off has broken: they are united. That is the
//! non-crossing closure of the partition of visits into chords, found with one stack in linear time,
//! and no tolerance decides it. Where the disks of chords to be united differ by more than round-off,
//! it was the order of visits that round-off has changed, and the map is made again with contacts
//! that are [set apart](super::apart). The result is a planar map by construction: its faces are simply
//! connected, every piece of the boundary lies in exactly one of them, and V - E = 1 - holes holds
//! for whatever is built in the faces. What round-off can still spoil are residuals, and those
//! `Mat::check` measures.
//!
//! Source: the division by maximal disks of Aichholzer et al., *Medial axis computation for planar
//! free-form shapes* (CAD 41, 2009), section 3, with all disks chosen up front.

use super::apart::set_apart;
use super::check::Doubt;
use super::contacts::{ContactItem, Contacts, Order};
use super::face::Slot;
use super::graph::BoundaryPiece;
use super::piece::UnitDisk;
use super::shot::Shot;
use super::site::{Foot, NONE, Site};
use super::sites::Sites;
use super::union::Sets;
use crate::geom::Point;
use std::collections::HashMap;

/// Times that crossing chords are set apart, at most: doing so may make others cross.
const ROUNDS: usize = 8;

/// A stop on the walk around the cut pocket: a joint or a contact, and the piece that ends there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Visit {
    /// Joint (below the number of sites) or contact.
    item: u32,
    /// Whether the walk came here across a link, and no piece ends here.
    pub crossed: bool,
    /// The visit before in the same disk, counted along the row: over there a face goes on.
    pub partner: u32,
    /// The disk, an index into [`Lamination::disks`].
    pub disk: u32,
}

/// The planar map of pieces and chords.
pub(super) struct Lamination {
    pub visits: Vec<Visit>,
    /// Rows of visits, one for each connected component of the cut pocket.
    pub rows: Vec<std::ops::Range<u32>>,
    pub disks: Vec<UnitDisk>,
    contacts: Contacts,
    /// Greatest distance of disks that were united, and the center of one of the two.
    pub widest_union: (f64, Point),
}

impl Lamination {
    /// The map of the shots; `None` when the links do not reach every ring.
    pub fn of(all: &Sites, shots: &[Shot], doubt: Doubt) -> Option<Lamination> {
        let contacts = Contacts::of(&all.sites, shots);
        let (mut map, mut crossings) = Lamination::with(all, shots, contacts, doubt)?;
        let mut contacts = if crossings.is_empty() { Contacts::default() } else { map.contacts.clone() };
        for _ in 0..ROUNDS {
            if !set_apart((&all.sites, shots), &mut contacts, &crossings, doubt.feet) {
                break;
            }
            let Some((other, rest)) = Lamination::with(all, shots, contacts.clone(), doubt) else { break };
            crossings = rest;
            if other.widest_union.0 < map.widest_union.0 {
                map = other;
            }
        }
        Some(map)
    }

    /// The map of some contacts, and the joints of chords that cross though their disks differ.
    fn with(
        all: &Sites,
        shots: &[Shot],
        contacts: Contacts,
        doubt: Doubt,
    ) -> Option<(Lamination, Vec<[u32; 2]>)> {
        let (visits, rows) = walk(all, &Order::of(&all.sites, &contacts.items), &contacts.items)?;
        let disks = Vec::new();
        let mut map = Lamination { visits, rows, disks, contacts, widest_union: (0.0, Point::default()) };
        let crossings = map.close(all, shots, doubt.disks)?;
        Some((map, crossings))
    }
}

fn joint_of(contacts: &[ContactItem], item: u32, sites: u32) -> u32 {
    if item < sites { item } else { contacts[(item - sites) as usize].joint }
}

type Rows = (Vec<Visit>, Vec<std::ops::Range<u32>>);

/// Walks around every component of the pocket cut open along the links.
fn walk(all: &Sites, order: &Order, contacts: &[ContactItem]) -> Option<Rows> {
    let n = all.sites.len() as u32;
    let links: Vec<u32> = all.rings.iter().filter_map(|r| r.link).collect();
    let mut mate = vec![NONE; order.items.len()];
    // Contacts stand in the order of their joints.
    for &joint in &links {
        let at = contacts.partition_point(|c| c.joint < joint);
        contacts.get(at).filter(|c| c.joint == joint)?;
        mate[joint as usize] = n + at as u32;
        mate[n as usize + at] = joint;
    }
    let total = order.items.len() + 2 * links.len();
    let mut visits = Vec::with_capacity(total);
    let mut rows = Vec::new();
    let visit = |item, crossed| Visit { item, crossed, partner: NONE, disk: NONE };
    for ring in all.rings.iter().filter(|r| r.link.is_none()) {
        let start = order.first[ring.sites.start as usize];
        let (begin, mut at) = (visits.len() as u32, start);
        loop {
            let mut item = order.items[at as usize];
            visits.push(visit(item, false));
            let over = mate[item as usize];
            if over != NONE {
                let (here, there) = (visits.len() as u32 - 1, visits.len() as u32);
                visits.push(visit(over, true));
                visits[here as usize].partner = there;
                visits[there as usize].partner = here;
                item = over;
            }
            at = order.after(item, &all.sites);
            if at == start {
                break;
            }
            if visits.len() > total {
                return None;
            }
        }
        rows.push(begin..visits.len() as u32);
    }
    (visits.len() == total).then_some((visits, rows))
}

/// Disks as sets of chords.
struct Blocks {
    parent: Vec<u32>,
    /// Visits of the block that the walk has not met.
    ahead: Vec<u32>,
    open: Vec<bool>,
    /// The joint whose disk stands for the block: the smallest, as it is the emptiest.
    joint: Vec<u32>,
}

impl Blocks {
    fn root(&mut self, mut b: u32) -> u32 {
        while self.parent[b as usize] != b {
            let up = self.parent[self.parent[b as usize] as usize];
            self.parent[b as usize] = up;
            b = up;
        }
        b
    }
}

impl Lamination {
    /// Unites crossing chords, and makes disks and partners of what results; `None` when a chord leads
    /// to another row, which only a missing link can do. Answers the joints of united chords whose disks differ
    /// by more than `doubt`.
    fn close(&mut self, all: &Sites, shots: &[Shot], doubt: f64) -> Option<Vec<[u32; 2]>> {
        let n = all.sites.len() as u32;
        let disk_at = |joint: u32| {
            let (end, radius) = (&all.sites[joint as usize].end, shots[joint as usize].radius);
            UnitDisk { center: end.point + end.normal * radius, radius }
        };
        let mut blocks = Blocks {
            parent: (0..n).collect(),
            ahead: vec![0; n as usize],
            open: vec![false; n as usize],
            joint: (0..n).collect(),
        };
        let joints: Vec<u32> =
            self.visits.iter().map(|v| joint_of(&self.contacts.items, v.item, n)).collect();
        for (v, &joint) in self.visits.iter().zip(&joints) {
            blocks.ahead[joint as usize] += u32::from(v.partner == NONE);
        }
        let mut crossings = Vec::new();
        for row in self.rows.clone() {
            let mut stack: Vec<u32> = Vec::new();
            for i in row.clone() {
                if self.visits[i as usize].partner != NONE {
                    continue;
                }
                let mut block = blocks.root(joints[i as usize]);
                if !blocks.open[block as usize] {
                    blocks.open[block as usize] = true;
                    stack.push(block);
                }
                while let Some(&top) = stack.last() {
                    if top == block {
                        break;
                    }
                    stack.pop();
                    let pair = [top, block].map(|b| blocks.joint[b as usize]);
                    if self.note_union(pair.map(disk_at)) > doubt {
                        crossings.push([top, joints[i as usize]]);
                    }
                    unite(&mut blocks, top, block, shots);
                    block = blocks.root(block);
                }
                blocks.ahead[block as usize] -= 1;
                if blocks.ahead[block as usize] == 0 {
                    stack.pop();
                }
            }
            if !stack.is_empty() {
                return None;
            }
        }
        self.number_disks(all, &joints, &mut blocks, disk_at);
        Some(crossings)
    }

    /// Notes how far apart two disks are that become one.
    fn note_union(&mut self, [a, b]: [UnitDisk; 2]) -> f64 {
        let apart = a.apart(&b);
        if apart > self.widest_union.0 {
            self.widest_union = (apart, a.center);
        }
        apart
    }

    /// Gives every block its disk and links its visits to rings.
    fn number_disks(
        &mut self,
        all: &Sites,
        joints: &[u32],
        blocks: &mut Blocks,
        disk_at: impl Fn(u32) -> UnitDisk,
    ) {
        let mut number = vec![NONE; joints.len().max(all.sites.len())];
        let mut last = vec![NONE; all.sites.len()];
        let mut first = vec![NONE; all.sites.len()];
        let mut joint_of_disk = Vec::new();
        for (i, &joint) in joints.iter().enumerate().take(self.visits.len()) {
            let root = blocks.root(joint);
            let key = all.touching.get(&root).copied().unwrap_or(root) as usize;
            if number[key] == NONE {
                number[key] = joint_of_disk.len() as u32;
                joint_of_disk.push(blocks.joint[root as usize]);
            }
            self.visits[i].disk = number[key];
            if self.visits[i].partner != NONE {
                continue;
            }
            let root = root as usize;
            self.visits[i].partner = last[root];
            last[root] = i as u32;
            if first[root] == NONE {
                first[root] = i as u32;
            }
        }
        for (f, l) in first.into_iter().zip(last).filter(|(f, _)| *f != NONE) {
            self.visits[f as usize].partner = l;
        }
        // Joints lie apart in memory; fetched in one row, they are not waited for one by one.
        self.disks = joint_of_disk.into_iter().map(disk_at).collect();
    }

    /// The pieces that end at the visits.
    pub fn pieces(&self, sites: &[Site]) -> Vec<BoundaryPiece> {
        let leaves = self.leaves(sites);
        let mut pieces = Vec::with_capacity(self.visits.len());
        for row in &self.rows {
            for i in row.clone() {
                let before = if i == row.start { row.end - 1 } else { i - 1 };
                let Visit { item, crossed, .. } = self.visits[i as usize];
                let next = if crossed { NONE } else { leaves[item as usize] };
                pieces.push(BoundaryPiece { next, ..self.piece(sites, item, before) });
            }
        }
        pieces
    }

    /// Shows the faces: the piece and the disk at each visit that ends one, then nothing at the end of the face.
    pub fn each_slot(&self, mut show: impl FnMut(Option<Slot>)) {
        let mut seen = vec![false; self.visits.len()];
        for row in &self.rows {
            for first in row.clone() {
                let mut at = first;
                if seen[at as usize] {
                    continue;
                }
                while !seen[at as usize] {
                    seen[at as usize] = true;
                    let visit = &self.visits[at as usize];
                    if !visit.crossed {
                        show(Some(Slot { piece: at, disk: visit.disk }));
                    }
                    at = if visit.partner + 1 == row.end { row.start } else { visit.partner + 1 };
                }
                show(None);
            }
        }
    }

    /// The joint in which the piece of a visit ends, unless it ends in a contact.
    pub fn joint_at(&self, visit: u32, sites: &[Site]) -> Option<u32> {
        Some(self.visits[visit as usize].item).filter(|&item| (item as usize) < sites.len())
    }

    /// The site of the piece that ends at a visit.
    pub fn site_at(&self, visit: u32, sites: &[Site]) -> u32 {
        self.site_of(self.visits[visit as usize].item, sites)
    }

    /// The site that an item lies on.
    fn site_of(&self, item: u32, sites: &[Site]) -> u32 {
        item.checked_sub(sites.len() as u32).map_or(item, |c| self.contacts.items[c as usize].site)
    }

    /// Hands over the feet of all contacts, and gives back what only pieces are made of.
    pub fn take_feet(&mut self) -> Vec<Foot> {
        std::mem::take(&mut self.contacts).feet
    }

    /// The piece that ends at an item and begins at the visit before, with none that follows.
    fn piece(&self, sites: &[Site], item: u32, before: u32) -> BoundaryPiece {
        let n = sites.len() as u32;
        let site = self.site_of(item, sites);
        let foot = self.visits[before as usize].item.checked_sub(n).unwrap_or(NONE);
        BoundaryPiece { foot, site, next: NONE, edge: NONE, left_out: false }
    }

    /// For every item, the visit whose piece follows on the boundary.
    fn leaves(&self, sites: &[Site]) -> Vec<u32> {
        // A piece leaves an item at the visit after which the row goes on along the boundary: the
        // last of the item's visits that is not followed by a crossing.
        let mut leaves = vec![NONE; sites.len() + self.contacts.items.len()];
        for row in &self.rows {
            for i in row.clone() {
                let after = if i + 1 == row.end { row.start } else { i + 1 };
                if !self.visits[after as usize].crossed {
                    leaves[self.visits[i as usize].item as usize] = after;
                }
            }
        }
        leaves
    }

    /// How many parts the axis has: one for each component of the pocket, but that the axis goes on from
    /// one to the other through a place where corners of both touch.
    pub fn parts(&self, all: &Sites) -> usize {
        let mut sets = Sets::singles(self.rows.len());
        let (mut parts, mut row_at) = (self.rows.len(), HashMap::new());
        let walks = (0u32..).zip(&self.rows).filter(|_| self.rows.len() > 1);
        for (row, visits) in walks {
            for visit in &self.visits[visits.start as usize..visits.end as usize] {
                if let Some(&place) = all.touching.get(&visit.item) {
                    parts -= usize::from(sets.unite(row, *row_at.entry(place).or_insert(row)));
                }
            }
        }
        parts
    }
}

/// Unites two blocks; `into` stays a root.
fn unite(blocks: &mut Blocks, block: u32, into: u32, shots: &[Shot]) {
    blocks.parent[block as usize] = into;
    blocks.ahead[into as usize] += blocks.ahead[block as usize];
    let (a, b) = (blocks.joint[block as usize], blocks.joint[into as usize]);
    if shots[a as usize].radius < shots[b as usize].radius {
        blocks.joint[into as usize] = a;
    }
}
