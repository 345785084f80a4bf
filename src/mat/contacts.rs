//! Where the disks at joints touch the boundary, and all joints and contacts in its order.

use super::shot::Shot;
use super::site::{Foot, Joint, NONE, Site};
use super::touch::{Contact, foot_of};
use crate::geom::Point;

/// Where a joint disk touches a site.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactItem {
    pub position: f64,
    pub site: u32,
    pub joint: u32,
}

/// The contacts of all joint disks, in the order of joints, and their feet beside them: those stay in the axis.
#[derive(Clone, Debug, Default)]
pub(super) struct Contacts {
    pub items: Vec<ContactItem>,
    pub feet: Vec<Foot>,
}

impl Contacts {
    pub fn of(sites: &[Site], shots: &[Shot]) -> Contacts {
        let (items, feet) = (Vec::with_capacity(sites.len()), Vec::with_capacity(sites.len()));
        let mut all = Contacts { items, feet };
        for (joint, shot) in (0u32..).zip(shots) {
            if shot.site == NONE {
                continue;
            }
            if shot.contact == Contact::Whole {
                whole_arc_contacts(sites, joint, shot).for_each(|contact| all.push(contact));
                continue;
            }
            let end = &sites[joint as usize].end;
            let center = end.point + end.normal * shot.radius;
            all.push(contact_at(sites, joint, shot, center));
        }
        all
    }

    fn push(&mut self, (item, foot): (ContactItem, Foot)) {
        self.items.push(item);
        self.feet.push(foot);
    }
}

/// A disk that osculates an arc touches it at the far end too: that end is its contact. At a joint
/// of two parts of one arc it touches both parts.
fn whole_arc_contacts(sites: &[Site], joint: u32, shot: &Shot) -> impl Iterator<Item = (ContactItem, Foot)> {
    let before = &sites[joint as usize];
    let both = before.joint == Joint::Smooth { same_circle: true };
    let at_start = ContactItem { position: 0.0, site: joint, joint };
    let far_start = (both || shot.site == joint).then_some((at_start, before.start));
    let after = &sites[before.next as usize];
    let at_end = ContactItem { position: 1.0, site: before.next, joint };
    let far_end = (both || shot.site != joint).then_some((at_end, after.end));
    far_start.into_iter().chain(far_end)
}

/// The contact of a disk with the site that its shot names, or with the reflex vertex there.
fn contact_at(sites: &[Site], joint: u32, shot: &Shot, center: Point) -> (ContactItem, Foot) {
    let mut id = shot.site;
    let mut site = &sites[id as usize];
    match shot.contact {
        Contact::Start if sites[site.prev as usize].is_vertex => id = site.prev,
        Contact::End if sites[site.next as usize].is_vertex => id = site.next,
        Contact::Start => return (ContactItem { position: 0.0, site: id, joint }, site.start),
        Contact::End => return (ContactItem { position: 1.0, site: id, joint }, site.end),
        Contact::Inside | Contact::Whole => {}
    }
    site = &sites[id as usize];
    if site.is_vertex {
        id = part_of_cone(sites, id, center);
        site = &sites[id as usize];
    }
    let foot = foot_of(site, center, &site.start, &site.end);
    (ContactItem { position: site.position(&foot), site: id, joint }, foot)
}

/// The part of a reflex vertex's cone that holds the normal to a center.
fn part_of_cone(sites: &[Site], mut id: u32, center: Point) -> u32 {
    let w = center - sites[id as usize].start.point;
    while sites[sites[id as usize].prev as usize].is_vertex && sites[id as usize].start.normal.cross(w) > 0.0
    {
        id = sites[id as usize].prev;
    }
    while sites[sites[id as usize].next as usize].is_vertex && w.cross(sites[id as usize].end.normal) > 0.0 {
        id = sites[id as usize].next;
    }
    id
}

/// All items in boundary order: the contacts of each site by position, then the joint at its end.
pub(super) struct Order {
    pub items: Vec<u32>,
    place: Vec<u32>,
    /// Where the items of a site begin.
    pub first: Vec<u32>,
}

impl Order {
    pub fn of(sites: &[Site], contacts: &[ContactItem]) -> Order {
        let n = sites.len();
        let mut first = vec![0u32; n + 1];
        for c in contacts {
            first[c.site as usize + 1] += 1;
        }
        for s in 0..n {
            first[s + 1] += first[s] + 1;
        }
        let mut items = vec![NONE; n + contacts.len()];
        let mut free = first.clone();
        for (i, c) in contacts.iter().enumerate() {
            items[free[c.site as usize] as usize] = (n + i) as u32;
            free[c.site as usize] += 1;
        }
        let contact = |item: &u32| &contacts[*item as usize - n];
        for s in 0..n {
            let end = first[s + 1] as usize - 1;
            items[end] = s as u32;
            let run = &mut items[first[s] as usize..end];
            if run.len() > 1 {
                // Chords do not cross: of contacts in one place, the one of the later joint is first.
                run.sort_unstable_by(|a, b| {
                    let (a, b) = (contact(a), contact(b));
                    a.position.total_cmp(&b.position).then(b.joint.cmp(&a.joint))
                });
            }
        }
        let mut place = vec![0; items.len()];
        for (at, &item) in items.iter().enumerate() {
            place[item as usize] = at as u32;
        }
        Order { items, place, first }
    }

    /// Where the boundary goes on after an item.
    pub fn after(&self, item: u32, sites: &[Site]) -> u32 {
        match sites.get(item as usize) {
            Some(joint) => self.first[joint.next as usize],
            None => self.place[item as usize] + 1,
        }
    }
}
