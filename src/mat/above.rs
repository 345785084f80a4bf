//! The axis from a radius up: what a tool of that radius needs of it, and little more.
//!
//! **Needs** a pocket and a radius, the *floor*. **Guarantees** every edge and vertex that the whole axis has where
//! the radius is at least that. **Does not** end where the radius is that: edges are left whole.
//!
//! **Method.** Shots stop as soon as they come below the floor. Joints beside free sites are shot to the end, as
//! those are that hold islands; the others, among low sites (`low`), are *left out*, and the faces of the map at
//! these grow together. A face without a free site is left out too. In one with free sites some joints may be left
//! out: of each row of them those at both ends are shot then, more and more of them until chords have cut off the
//! rest. What is left out stays a part of the boundary: it holds back disks, and has no edge.

use super::check::Doubt;
use super::lamination::Lamination;
use super::low::{Floor, free_sites};
use super::shot::{Field, Shot};
use super::site::{Joint, NONE, Site};
use super::sites::Sites;

/// Joints that are shot to tell whether it pays.
const SAMPLES: usize = 64;

/// Disks of more than this part of the radius are nearly as large: proofs that they are not take longer than shots.
const NEARLY: f64 = 0.7;

/// Joints at either end of a row that are shot first.
const FIRST: usize = 4;

/// What of a pocket is asked for.
pub(super) struct Above {
    /// Whether a disk that is not below the floor may touch each site.
    pub free: Vec<bool>,
    shots: Vec<Shot>,
    /// The sites that hold back the disks of joints which were left out.
    near: Vec<u32>,
}

impl Above {
    /// Whether most disks are a good deal smaller than the floor, so that there is something to gain.
    pub fn pays(field: &Field, floor: Floor) -> bool {
        let step = (field.sites.len() / SAMPLES).max(1);
        let is_sampled = |joint: &u32| field.sites[*joint as usize].joint != Joint::Convex;
        let samples =
            (0..field.sites.len() as u32).step_by(step).filter(is_sampled).map(|joint| (joint, joint));
        let shots = field.shoot_some(&samples.collect::<Vec<_>>());
        let large = shots.iter().filter(|shot| shot.radius > NEARLY * floor.radius).count();
        2 * large <= shots.len()
    }

    /// The choice of joints, `None` if nothing is asked for; the joint of a shot into nothing otherwise.
    pub fn of(all: &Sites, field: &Field, floor: Floor) -> Result<Option<Above>, u32> {
        let shots = field.shoot_all(floor.radius);
        if let Some(joint) = first_lost(&all.sites, &shots) {
            return Err(joint);
        }
        let free = free_sites(field, &shots, floor);
        if !free.contains(&true) {
            return Ok(None);
        }
        let near = vec![NONE; shots.len()];
        let mut above = Above { free, shots, near };
        above.leave_out(all, floor.radius);
        let links: Vec<u32> = all.rings.iter().filter_map(|ring| ring.link).collect();
        let beside = |joint: &u32| {
            let sites = [*joint, all.sites[*joint as usize].next];
            sites.into_iter().any(|site| above.free[site as usize])
        };
        let mut wanted: Vec<u32> = (0..all.sites.len() as u32).filter(beside).chain(links).collect();
        above.shoot(field, &mut wanted);
        Ok(Some(above))
    }

    /// The map of all that is asked for; `None` when the links do not reach every ring.
    pub fn map(&mut self, all: &Sites, field: &Field, doubt: Doubt) -> Option<Lamination> {
        let mut reach = FIRST;
        loop {
            let map = Lamination::of(all, &self.shots, doubt)?;
            let mut wanted = self.wanted(&all.sites, &map, reach);
            if wanted.is_empty() {
                return Some(map);
            }
            self.shoot(field, &mut wanted);
            reach *= 2;
        }
    }

    /// Leaves out all joints whose shots came below the floor.
    fn leave_out(&mut self, all: &Sites, floor: f64) {
        for ((shot, near), site) in self.shots.iter_mut().zip(&mut self.near).zip(&all.sites) {
            if site.joint != Joint::Convex && shot.radius < floor {
                *near = std::mem::replace(shot, Shot::NONE).site;
            }
        }
    }

    /// Shoots those of some joints that were left out.
    fn shoot(&mut self, field: &Field, joints: &mut Vec<u32>) {
        joints.retain(|&joint| self.near[joint as usize] != NONE);
        joints.sort_unstable();
        joints.dedup();
        let near: Vec<(u32, u32)> = joints.iter().map(|&joint| (joint, self.near[joint as usize])).collect();
        for (&joint, shot) in joints.iter().zip(field.shoot_some(&near)) {
            self.shots[joint as usize] = shot;
            self.near[joint as usize] = NONE;
        }
    }

    /// Joints that were left out, in faces with free sites: so many at either end of each row.
    fn wanted(&self, sites: &[Site], map: &Lamination, reach: usize) -> Vec<u32> {
        let is_left_out = |joint: &u32| self.near[*joint as usize] != NONE;
        let (mut wanted, mut face, mut has_free) = (Vec::new(), Vec::new(), false);
        map.each_slot(|slot| match slot {
            Some(slot) => {
                has_free |= self.free[map.site_at(slot.piece, sites) as usize];
                face.push(map.joint_at(slot.piece, sites).filter(is_left_out));
            }
            None => {
                // A free site ends in a disk: rows do not go all around.
                let begin = face.iter().position(Option::is_none).filter(|_| has_free);
                face.rotate_left(begin.unwrap_or(0));
                for row in face.split(Option::is_none).filter(|_| begin.is_some()) {
                    let ends = row.iter().take(reach).chain(row.iter().rev().take(reach));
                    wanted.extend(ends.flatten());
                }
                face.clear();
                has_free = false;
            }
        });
        wanted
    }
}

/// The first joint whose disk goes on into nothing.
pub(super) fn first_lost(sites: &[Site], shots: &[Shot]) -> Option<u32> {
    let is_lost = |i: &u32| shots[*i as usize].site == NONE && sites[*i as usize].joint != Joint::Convex;
    (0..sites.len() as u32).find(is_lost)
}
