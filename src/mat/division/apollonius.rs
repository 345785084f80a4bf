//! The problem of Apollonius: the disk tangent to three given sites.
//!
//! With an approximate disk `(c0, r0)` and the unknown step `(d, e)` to the true one, an arc that
//! passes through `A` with normal `n` and curvature `k`, `w = c0 - A`, says
//!
//! ```text
//! k q + 2 (k w - n).d + 2 (1 - k r0) e + (r0 - s) (2 - k (r0 + s)) = 0,   q = |d|^2 - e^2
//! ```
//!
//! where `s` is the distance of `c0` from the arc's carrier; a vertex says the same divided by a `k`
//! that grows beyond all bounds. Three such equations give `(d, e)` as a linear function of `q`, and
//! its definition makes that a quadratic equation. Orientation is part of the equations, so of the
//! eight circles of Apollonius two are left, and the step to the right one is the small one.

use super::super::piece::UnitDisk;
use super::super::site::Site;
use crate::geom::Vector;

/// One equation `normal . d + grow e + bend q + rest = 0`.
struct Row {
    normal: Vector,
    grow: f64,
    bend: f64,
    rest: f64,
}

/// The disk tangent to the carriers of three sites that is near to a given one; that one itself where
/// round-off leaves nothing to gain.
pub(super) fn tangent_to_three(sites: [&Site; 3], near: UnitDisk) -> UnitDisk {
    let (mut disk, mut error) = (near, worst_gap(sites, &near));
    while error > f64::EPSILON * disk.radius {
        let Some(next) = solve(sites.map(|s| row(s, &disk)), &disk) else { break };
        let after = worst_gap(sites, &next);
        // The formula is exact: where a step does not halve the gap it has met round-off. NaN fails too.
        if !(after < 0.5 * error && next.radius > 0.0) {
            break;
        }
        (disk, error) = (next, after);
    }
    disk
}

fn worst_gap(sites: [&Site; 3], disk: &UnitDisk) -> f64 {
    let gap = |s: &Site| (s.carrier_distance(disk.center).0 - disk.radius).abs();
    sites.iter().fold(0.0, |worst, s| gap(s).max(worst))
}

fn row(site: &Site, disk: &UnitDisk) -> Row {
    let (r, (s, _)) = (disk.radius, site.carrier_distance(disk.center));
    if site.is_vertex {
        let w = disk.center - site.start.point;
        return Row { normal: w, grow: -r, bend: 0.5, rest: 0.5 * (s - r) * (s + r) };
    }
    let k = site.curvature;
    let foot = site.nearer_end(disk.center);
    let normal = (disk.center - foot.point) * k - foot.normal;
    Row { normal, grow: 1.0 - k * r, bend: 0.5 * k, rest: (r - s) * (1.0 - 0.5 * k * (r + s)) }
}

fn solve(rows: [Row; 3], disk: &UnitDisk) -> Option<UnitDisk> {
    let (d0, e0) = linear(&rows, |r| -r.rest)?;
    let (d1, e1) = linear(&rows, |r| -r.bend)?;
    // q = a q^2 + (1 - b) q + c, its smaller root.
    let a = d1.length_squared() - e1 * e1;
    let b = 1.0 - 2.0 * (d0.dot(d1) - e0 * e1);
    let c = d0.length_squared() - e0 * e0;
    let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
    let q = 2.0 * c / (b + root.copysign(b));
    let (d, e) = (d0 + d1 * q, e0 + e1 * q);
    let next = UnitDisk { center: disk.center + d, radius: disk.radius + e };
    (next.center.is_finite() && next.radius.is_finite()).then_some(next)
}

/// Solution of `normal . d + grow e = right` for three rows, by Cramer's rule.
fn linear(rows: &[Row; 3], right: impl Fn(&Row) -> f64) -> Option<(Vector, f64)> {
    let [a, b, c] = rows;
    let [x, y, z] = [b.normal.cross(c.normal), c.normal.cross(a.normal), a.normal.cross(b.normal)];
    let det = a.grow * x + b.grow * y + c.grow * z;
    let [ra, rb, rc] = [right(a), right(b), right(c)];
    let e = (ra * x + rb * y + rc * z) / det;
    let minor = |u: &Row, v: &Row, ru: f64, rv: f64| u.grow * rv - v.grow * ru;
    let d = a.normal.right() * minor(b, c, rb, rc)
        + b.normal.right() * minor(c, a, rc, ra)
        + c.normal.right() * minor(a, b, ra, rb);
    let d = d / det;
    (d.x.is_finite() && d.y.is_finite() && e.is_finite()).then_some((d, e))
}

#[cfg(test)]
mod tests {
    use super::super::super::site::{Foot, Joint, NONE};
    use super::super::super::{SiteKind, SiteRef};
    use super::*;
    use crate::geom::{Point, point};
    use std::f64::consts::PI;

    /// A part of a circle around `center` whose inside is the pocket's if `radius` is positive.
    fn arc(center: Point, radius: f64, angle: f64) -> Site {
        let foot = |angle: f64| {
            let out = Vector::from_angle(angle);
            Foot { point: center + out * radius.abs(), normal: -out * radius.signum() }
        };
        let turn = 0.2 * radius.signum();
        site(foot(angle - turn), foot(angle + turn), radius.recip(), false)
    }

    fn site(start: Foot, end: Foot, curvature: f64, is_vertex: bool) -> Site {
        let source = SiteRef { loop_index: 0, element: 0, kind: SiteKind::Arc };
        let (joint, vertices) = (Joint::Convex, [NONE; 2]);
        let error = f64::EPSILON;
        Site { start, end, curvature, error, is_vertex, joint, prev: NONE, next: NONE, vertices, source }
    }

    #[test]
    fn a_planted_disk_is_found_from_afar() {
        // Tangent to all three: center (0.1, -0.2), radius 0.3.
        let disk = UnitDisk { center: point(0.1, -0.2), radius: 0.3 };
        let around = |angle: f64, radius: f64| {
            // A site of that signed radius that touches the disk under that angle.
            arc(disk.center + Vector::from_angle(angle) * (disk.radius - radius), radius, angle)
        };
        let at = |angle: f64| disk.center + Vector::from_angle(angle) * disk.radius;
        let normal = |angle: f64| -Vector::from_angle(angle);
        let vertex = |a: f64| {
            site(
                Foot { point: at(a), normal: normal(a) },
                Foot { point: at(a), normal: normal(a) },
                0.0,
                true,
            )
        };
        let segment = |a: f64| {
            let along = normal(a).right() * 0.1;
            let foot = |point| Foot { point, normal: normal(a) };
            site(foot(at(a) - along), foot(at(a) + along), 0.0, false)
        };
        let far = UnitDisk { center: point(0.13, -0.26), radius: 0.25 };
        let concave = around(0.3, 0.9);
        // Met from outside: its near side looks back at the disk.
        let island = arc(disk.center + Vector::from_angle(4.5) * 0.7, -0.4, 4.5 - PI);
        for sites in [
            [concave, segment(2.2), vertex(4.5)],
            [vertex(0.3), vertex(2.2), vertex(4.5)],
            [segment(0.3), segment(2.2), segment(4.5)],
            [concave, around(2.2, 5.0), island],
        ] {
            let found = tangent_to_three([&sites[0], &sites[1], &sites[2]], far);
            assert!(found.center.distance(disk.center) < 1e-15, "{found:?}");
            assert!((found.radius - disk.radius).abs() < 1e-15, "{found:?}");
        }
    }
}
