//! Axes broken on purpose, in every place where they can be: the certificate must see each.

use crate::boundary::Pocket;
use crate::geom::{ArcSpline, Vector, point};
use crate::mat::bvh::Bvh;
use crate::mat::check::Doubt;
use crate::mat::frame::Frame;
use crate::mat::lamination::Lamination;
use crate::mat::shot::{Field, Shot};
use crate::mat::sites::Sites;
use crate::mat::stages::Stages;
use crate::mat::touch::Contact;
use crate::mat::{Mat, NONE, Site};
use crate::tolerance::Tolerance;

/// What is done to an axis, relative to the size.
const HARM: f64 = 1e-6;

fn circle(x: f64, y: f64, radius: f64) -> ArcSpline {
    ArcSpline::circle(point(x, y), radius)
}

fn polygon(corners: &[(f64, f64)]) -> ArcSpline {
    ArcSpline::closed(corners.iter().map(|&(x, y)| (x, y, 0.0)))
}

/// Pockets with all there is: lines, arcs, reflex corners, islands, ties, corridors.
fn pockets() -> Vec<(&'static str, Pocket)> {
    let plate = polygon(&[(0.0, 0.0), (90.0, 0.0), (90.0, 50.0), (0.0, 50.0)]);
    let diamond = polygon(&[(70.0, 10.0), (80.0, 20.0), (70.0, 30.0), (60.0, 20.0)]);
    let slot = ArcSpline::closed([(0.0, -5.0, 0.0), (30.0, -5.0, 1.0), (30.0, 5.0, 0.0), (0.0, 5.0, 1.0)]);
    let square = polygon(&[(-10.0, -10.0), (10.0, -10.0), (10.0, 10.0), (-10.0, 10.0)]);
    let stairs = [
        (0.0, 0.0),
        (31.0, 0.0),
        (30.0, 7.0),
        (18.0, 8.0),
        (19.0, 16.0),
        (9.0, 15.0),
        (8.0, 25.0),
        (0.0, 24.0),
    ];
    let waves = (0..24).map(|i| {
        let v = Vector::from_angle(0.2618 * f64::from(i)) * (20.0 + f64::from(i * i % 7));
        (v.x, v.y, if i % 3 == 0 { 0.0 } else { 0.1 - 0.2 * f64::from(i % 2) })
    });
    let drawings = [
        ("plate with islands", vec![plate, circle(20.0, 20.0, 8.0), circle(41.0, 31.0, 5.0), diamond]),
        ("slot", vec![slot]),
        ("square in a square", vec![square.clone(), square.mapped(false, |p| point(0.4 * p.x, 0.4 * p.y))]),
        ("stairs", vec![polygon(&stairs)]),
        ("waves", vec![ArcSpline::closed(waves)]),
        ("annulus", vec![circle(0.0, 0.0, 10.0), circle(3.1, 1.3, 4.0)]),
    ];
    drawings
        .into_iter()
        .map(|(name, loops)| (name, Pocket::from_loops(loops, Tolerance::MM).unwrap()))
        .collect()
}

/// The axis of a pocket whose sites and shots were meddled with; `None` if the lamination refuses.
fn built(pocket: &Pocket, meddle: impl FnOnce(&mut Sites, &mut [Shot])) -> Option<Mat> {
    let frame = Frame::around(&pocket.bounds());
    let mut all = Sites::of(pocket, &frame, Vector::from_angle(2.4));
    let bvh = Bvh::sorted(&all.sites.iter().map(Site::bounds).collect::<Vec<_>>());
    let mut shots = Field::new(&all.sites, &bvh, all.blur).shoot_all(0.0);
    meddle(&mut all, &mut shots);
    let map = Lamination::of(&all, &shots, Doubt::of(frame.noise, all.blur))?;
    Some(Mat::build(frame, all, bvh, (map, None), Stages::default()))
}

/// Breaks the axis of every pocket in as many ways as there are, and demands that each is seen.
fn each_is_seen(ways: impl Fn(&Mat) -> usize, harm: impl Fn(&mut Mat, usize) -> bool) {
    let mut count = 0;
    for (name, pocket) in pockets() {
        let whole = built(&pocket, |_, _| {}).expect("a lamination");
        whole.check().unwrap_or_else(|e| panic!("{name}: {e}"));
        for way in 0..ways(&whole) {
            let mut broken = whole.clone();
            if harm(&mut broken, way) {
                assert!(broken.check().is_err(), "{name}: way {way} is not seen");
                count += 1;
            }
        }
    }
    assert!(count > 20, "only {count} ways");
}

fn size(mat: &Mat) -> f64 {
    let places = mat.sites.iter().map(|s| s.start.point);
    crate::geom::Bounds::around(places).diagonal()
}

#[test]
fn a_disk_moved_by_a_millionth_of_the_size_is_seen() {
    const DIRECTIONS: usize = 16;
    each_is_seen(
        |mat| DIRECTIONS * mat.graph.disks.len(),
        |mat, way| {
            let by = Vector::from_angle(0.1 + way as f64 * std::f64::consts::TAU / DIRECTIONS as f64);
            let step = by * (HARM * size(mat));
            let disk = &mut mat.graph.disks[way / DIRECTIONS];
            disk.center += step;
            true
        },
    );
}

#[test]
fn a_disk_larger_or_smaller_by_a_millionth_of_the_size_is_seen() {
    each_is_seen(
        |mat| 2 * mat.graph.disks.len(),
        |mat, way| {
            let step = HARM * size(mat);
            mat.graph.disks[way / 2].radius += if way % 2 == 0 { step } else { -step };
            true
        },
    );
}

#[test]
fn what_is_off_by_less_than_the_wish_is_right() {
    for (name, pocket) in pockets() {
        let mut mat = pocket.medial_axis().unwrap();
        let step = HARM * size(&mat);
        mat.graph.disks[0].radius += step;
        let in_job_units = mat.frame.length_out(step);
        assert!(mat.check_within(0.5 * in_job_units).is_err(), "{name}");
        assert!(mat.check_within(2.0 * in_job_units).is_ok(), "{name}");
    }
}

#[test]
fn a_foot_moved_along_the_boundary_is_seen() {
    each_is_seen(
        |mat| mat.graph.feet.len(),
        |mat, way| {
            let step = HARM * size(mat);
            let foot = &mut mat.graph.feet[way];
            foot.point += foot.normal.right() * step;
            let piece = mat.graph.pieces.iter().find(|p| p.foot == way as u32);
            piece.is_some_and(|p| p.next != NONE && !mat.sites[p.site as usize].is_vertex)
        },
    );
}

#[test]
fn two_contacts_swapped_are_seen() {
    let mut count = 0;
    for (name, pocket) in pockets() {
        let whole = built(&pocket, |_, _| {}).expect("a lamination");
        let n = whole.sites.len();
        for (i, j) in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let mut wrong = false;
            let broken = built(&pocket, |all, shots| {
                let (a, b) = (shots[i], shots[j]);
                (shots[i].site, shots[i].contact) = (b.site, b.contact);
                (shots[j].site, shots[j].contact) = (a.site, a.contact);
                wrong = [(i, a, b), (j, b, a)].iter().all(|(joint, own, other)| {
                    is_tangent(own) && is_tangent(other) && misses(all, *joint, own.radius, other.site)
                });
            });
            if wrong {
                assert!(broken.is_none_or(|m| m.check().is_err()), "{name}: shots {i} and {j} are not seen");
                count += 1;
            }
        }
    }
    assert!(count > 100, "only {count} swaps");
}

/// Whether a shot met another site, and did not just fill the arc it began at.
fn is_tangent(shot: &Shot) -> bool {
    shot.site != NONE && shot.contact != Contact::Whole
}

/// Whether the disk of a joint is far from touching a site.
fn misses(all: &Sites, joint: usize, radius: f64, site: u32) -> bool {
    let end = &all.sites[joint].end;
    let gap = all.sites[site as usize].distance(end.point + end.normal * radius) - radius;
    gap.abs() > HARM
}

#[test]
fn a_dropped_link_of_an_island_is_seen() {
    for (name, pocket) in pockets() {
        for hole in 0..pocket.islands().len() {
            let broken = built(&pocket, |all, _| {
                let ring = all.rings.iter_mut().filter(|r| r.link.is_some()).nth(hole);
                ring.expect("a hole").link = None;
            });
            assert!(broken.is_none_or(|m| m.check().is_err()), "{name}: island {hole}");
        }
    }
}

#[test]
fn a_dropped_edge_is_seen_even_if_its_leaf_goes_with_it() {
    each_is_seen(
        |mat| mat.graph.edges.len(),
        |mat, way| {
            let edge = mat.graph.edges[way];
            let degree =
                |disk: u32| mat.graph.edges.iter().flat_map(|e| e.disks).filter(|&d| d == disk).count();
            let leaf = edge.disks.into_iter().find(|&d| degree(d) == 1);
            drop_edge(mat, way);
            if let Some(leaf) = leaf {
                unite(mat, leaf, edge.disks[0] + edge.disks[1] - leaf);
            }
            true
        },
    );
}

#[test]
fn two_disks_that_are_no_tie_made_one_are_seen() {
    each_is_seen(
        |mat| mat.graph.edges.len(),
        |mat, way| {
            let [a, b] = mat.graph.edges[way].disks;
            drop_edge(mat, way);
            a != b && {
                unite(mat, b, a);
                true
            }
        },
    );
}

#[test]
fn an_edge_between_the_wrong_sites_is_seen() {
    each_is_seen(
        |mat| mat.graph.edges.len(),
        |mat, way| {
            mat.graph.edges[way].pieces.reverse();
            true
        },
    );
    each_is_seen(
        |mat| mat.graph.edges.len(),
        |mat, way| {
            let other = (way + 1) % mat.graph.edges.len();
            let (a, b) = (mat.graph.edges[way].pieces[0], mat.graph.edges[other].pieces[0]);
            (mat.graph.edges[way].pieces[0], mat.graph.edges[other].pieces[0]) = (b, a);
            other != way
        },
    );
}

#[test]
fn an_edge_turned_round_is_seen() {
    each_is_seen(
        |mat| mat.graph.edges.len(),
        |mat, way| {
            let [a, b] = mat.graph.edges[way].disks;
            mat.graph.edges[way].disks = [b, a];
            a != b
        },
    );
}

#[test]
fn a_piece_of_the_boundary_left_out_is_seen() {
    each_is_seen(
        |mat| mat.graph.pieces.len(),
        |mat, way| {
            let (id, next) = (way as u32, mat.graph.pieces[way].next);
            let before = mat.graph.pieces.iter().position(|p| p.next == id);
            if let Some(before) = before {
                mat.graph.pieces[before].next = next;
            }
            // Ties leave pieces of no extent, which are nothing to leave out.
            let piece = mat.graph.piece(&mat.sites, way as u32);
            before.is_some() && next != NONE && piece.from != piece.to
        },
    );
}

/// Takes an edge away, and leaves its pieces without one.
fn drop_edge(mat: &mut Mat, edge: usize) {
    let last = mat.graph.edges.len() - 1;
    for p in mat.graph.edges.swap_remove(edge).pieces {
        mat.graph.pieces[p as usize].edge = NONE;
    }
    for piece in mat.graph.pieces.iter_mut().filter(|p| p.edge == last as u32) {
        piece.edge = edge as u32;
    }
}

/// Makes two disks one, with the place of the second.
fn unite(mat: &mut Mat, gone: u32, kept: u32) {
    let last = mat.graph.disks.len() as u32 - 1;
    mat.graph.disks.swap_remove(gone as usize);
    for disk in mat.graph.edges.iter_mut().flat_map(|e| &mut e.disks) {
        *disk = if *disk == gone { kept } else { *disk };
        *disk = if *disk == last { gone } else { *disk };
    }
}
