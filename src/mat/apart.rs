//! Contacts that change places, so that chords of different disks do not cross.
//!
//! Chords cross where the order of two stops on the boundary is hidden by round-off. As a rule both belong to one
//! disk. Where they do not, one of the two stops is a contact that may as well stand on the other side:
//!
//! * A disk that osculates an arc touches all of it, and which place stands for it is a choice.
//! * Where a disk nearly osculates what it touches, its contact is known to the root of round-off only, and a
//!   joint or the contact of another disk may lie within that.

use super::contacts::{ContactItem, Contacts};
use super::shot::Shot;
use super::site::{Foot, Site};
use super::touch::Contact;
use std::collections::HashMap;

/// Another place for a contact, and how far that is from the first: less than nothing where either is a choice.
struct Move {
    contact: usize,
    to: (u32, f64, Foot),
    distance: f64,
}

/// Moves the contacts of disks that osculate whole arcs to where other disks touch these, on the side where their
/// joint is, and for each pair of joints whose chords cross one of their contacts past the other chord, if one is
/// within `reach` of that; answers whether there was any.
pub(super) fn set_apart(
    (sites, shots): (&[Site], &[Shot]),
    contacts: &mut Contacts,
    crossings: &[[u32; 2]],
    reach: f64,
) -> bool {
    let mut any = !crossings.is_empty() && whole_aside(contacts, shots);
    for &[a, b] in crossings {
        let moves =
            moves(sites, shots, contacts, [a, b]).into_iter().chain(moves(sites, shots, contacts, [b, a]));
        let nearest = moves.min_by(|m, n| m.distance.total_cmp(&n.distance));
        if let Some(Move { contact, to: (site, position, foot), .. }) =
            nearest.filter(|m| m.distance <= reach)
        {
            contacts.items[contact] = ContactItem { position, site, ..contacts.items[contact] };
            contacts.feet[contact] = foot;
            any = true;
        }
    }
    any
}

/// Moves the contacts of osculating disks from the far ends of their arcs to where another disk touches these first,
/// seen from their joint; answers whether there was any.
fn whole_aside(contacts: &mut Contacts, shots: &[Shot]) -> bool {
    let is_whole = |c: &ContactItem| shots[c.joint as usize].contact == Contact::Whole;
    let mut others: HashMap<u32, [(f64, Foot); 2]> = HashMap::new();
    for (c, &foot) in contacts.items.iter().zip(&contacts.feet).filter(|(c, _)| !is_whole(c)) {
        let [first, last] = others.entry(c.site).or_insert([(c.position, foot); 2]);
        if c.position < first.0 {
            *first = (c.position, foot);
        }
        if c.position > last.0 {
            *last = (c.position, foot);
        }
    }
    let mut any = false;
    for (c, own) in contacts.items.iter_mut().zip(&mut contacts.feet).filter(|(c, _)| is_whole(c)) {
        let to = match (others.get(&c.site), c.position) {
            (Some(&[(position, foot), _]), 1.0) => (position.next_down(), foot),
            (Some(&[_, (position, foot)]), 0.0) => (position.next_up(), foot),
            _ => continue,
        };
        (c.position, *own) = to;
        any = true;
    }
    any
}

/// Where the contacts of joint `a` may go to pass an end of the chord of joint `b`.
fn moves(sites: &[Site], shots: &[Shot], contacts: &Contacts, [a, b]: [u32; 2]) -> Vec<Move> {
    let mut found = Vec::new();
    let is_whole = shots[a as usize].contact == Contact::Whole;
    let (before, after) = (b, sites[b as usize].next);
    for (contact, here) in of_joint(contacts, a) {
        let foot = contacts.feet[contact];
        let distance = foot.point.distance(sites[b as usize].end.point);
        if here.site == before {
            let to = (after, 0f64.next_down(), sites[after as usize].start);
            found.push(Move { contact, to, distance });
        } else if here.site == after {
            let to = (before, 1f64.next_up(), sites[before as usize].end);
            found.push(Move { contact, to, distance });
        }
        for (other, there) in of_joint(contacts, b).filter(|(_, there)| there.site == here.site) {
            let is_before = here.position < there.position || here.position == there.position && a > b;
            let position = if is_before { there.position.next_up() } else { there.position.next_down() };
            let to = contacts.feet[other];
            let distance = if is_whole { f64::NEG_INFINITY } else { foot.point.distance(to.point) };
            found.push(Move { contact, to: (here.site, position, to), distance });
        }
    }
    found
}

/// The contacts of the disk at a joint; they stand in the order of their joints.
fn of_joint(contacts: &Contacts, joint: u32) -> impl Iterator<Item = (usize, &ContactItem)> {
    let first = contacts.items.partition_point(|c| c.joint < joint);
    contacts.items.iter().enumerate().skip(first).take_while(move |(_, c)| c.joint == joint)
}
