//! The base cases: subdomains whose axis is known without another search.
//!
//! | here | paper | non-artificial arcs | axis |
//! |---|---|---|---|
//! | [`ContactArc`] | footnote 3 | one, or two joined smoothly: all on the dividing disk | none |
//! | [`Edge`] | (b), (h), (i), (m) | two between two disks | one edge |
//! | [`Joint`] | (a), (g) | two joined smoothly, and a single one | two edges, joined at the disk of the joint |
//! | [`Branch`] | (c), (j), (k), (l), (e), (f) | three between three disks | three edges and a branch |
//! | [`Leaf`] | (d) | three joined smoothly | an edge to the center of the middle one |
//!
//! Single arcs may be reflex vertices, and one of the disks between two arcs may be that of a convex
//! vertex, of radius 0: both are the same to us, so 13 cases are five.
//!
//! [`ContactArc`]: BaseCase::ContactArc
//! [`Edge`]: BaseCase::Edge
//! [`Joint`]: BaseCase::Joint
//! [`Branch`]: BaseCase::Branch
//! [`Leaf`]: BaseCase::Leaf

use super::subdomain::{Link, Slot};

/// A base case, with the places in the row that tell it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BaseCase {
    ContactArc,
    Edge,
    /// The place after which the smooth joint lies.
    Joint(usize),
    Branch,
    /// The place of the middle arc.
    Leaf(usize),
}

impl BaseCase {
    /// Which base case a subdomain is, if one.
    pub fn of(domain: &[Slot]) -> Option<BaseCase> {
        let closed = domain.iter().filter(|s| s.link.disk().is_some()).count();
        let smooth = |i: usize| domain[i % domain.len()].link == Link::Smooth;
        let convex = domain.iter().filter(|s| matches!(s.link, Link::Convex(_))).count();
        match (domain.len(), closed) {
            (0 | 1, _) | (2, 0 | 1) => Some(BaseCase::ContactArc),
            (2, _) => Some(BaseCase::Edge),
            (3, 2) if convex == 0 => (0..3).find(|&i| smooth(i)).map(BaseCase::Joint),
            // Three consecutive arcs with a convex vertex are divided further.
            (3, 3) if convex < 2 => Some(BaseCase::Branch),
            (3, 1) if convex == 0 => (0..3).find(|&i| smooth(i + 2) && smooth(i)).map(BaseCase::Leaf),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(links: &[Link]) -> Option<BaseCase> {
        let slots: Vec<Slot> = links.iter().map(|&link| Slot { piece: 0, link }).collect();
        BaseCase::of(&slots)
    }

    #[test]
    fn the_cases_of_the_figures_are_told_by_their_links() {
        use Link::{Artificial, Convex, Reflex, Smooth};
        let (a, v) = (Artificial(7), Convex(3));
        assert_eq!(case(&[Smooth, a]), Some(BaseCase::ContactArc));
        for edge in [[a, a], [v, a]] {
            assert_eq!(case(&edge), Some(BaseCase::Edge));
        }
        assert_eq!(case(&[a, Smooth, a]), Some(BaseCase::Joint(1)));
        for branch in [[a, a, a], [a, v, a]] {
            assert_eq!(case(&branch), Some(BaseCase::Branch));
        }
        assert_eq!(case(&[Smooth, a, Smooth]), Some(BaseCase::Leaf(0)));
        assert_eq!(case(&[a, Reflex, a]), None, "a reflex vertex is divided further");
        assert_eq!(case(&[Smooth, v, a]), None, "three consecutive arcs with a convex vertex are divided");
        assert_eq!(case(&[v, v, a]), None, "three consecutive arcs with convex vertices are divided");
        assert_eq!(case(&[a, a, a, a]), None);
    }
}
