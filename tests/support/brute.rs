//! Maximal disks by brute force: every element of the boundary is asked, and nothing of the axis.
//!
//! A disk that is tangent to the boundary at a place grows along the normal there; all the disks it
//! has been lie inside of it, so the largest one that holds no boundary is found by bisection. Its
//! center must lie on the axis, and its radius must be the radius there. Conversely the disks of the
//! axis must keep the distance that all elements together allow.
#![allow(dead_code)]

use crate::shapes::Random;
use medial::{ArcSpline, AxisEdge, Disk, Element, Mat, Pocket, Point, SiteKind, SiteRef, Vector, point};

/// Round-off of a distance between a place and an element, relative to the size.
const DISTANCE_ERROR: f64 = 8.0 * f64::EPSILON;

/// Elements shorter than this part of the size have normals too uncertain for [`WITHIN`].
const SHORT: f64 = 1e-6;

/// Distance from the axis, relative to the size, within which a brute-force disk lies on it.
pub const WITHIN: f64 = 1e-9;

/// A boundary to be asked element by element.
pub struct Brute {
    loops: Vec<ArcSpline>,
    elements: Vec<(u32, u32, Element)>,
    size: f64,
}

/// A place of the boundary with its inward normal, and the element that is tangent there.
struct Start {
    place: Point,
    normal: Vector,
    own: Option<(u32, u32)>,
}

impl Brute {
    pub fn new(pocket: &Pocket) -> Brute {
        let loops: Vec<ArcSpline> = pocket.loops().cloned().collect();
        let elements = (0u32..)
            .zip(&loops)
            .flat_map(|(l, spline)| (0u32..).zip(spline.elements()).map(move |(i, element)| (l, i, element)));
        Brute { elements: elements.collect(), size: pocket.bounds().diagonal(), loops }
    }

    /// Distance of a place to the boundary.
    pub fn distance(&self, p: Point) -> f64 {
        self.elements.iter().map(|(_, _, e)| e.distance(p)).fold(f64::INFINITY, f64::min)
    }

    /// Distance of a place to one site.
    fn to_site(&self, p: Point, site: SiteRef) -> f64 {
        let (spline, i) = (&self.loops[site.loop_index as usize], site.element as usize);
        match site.kind {
            SiteKind::Vertex => spline.vertices[i].point.distance(p),
            _ => spline.element(i).distance(p),
        }
    }

    /// A random place inside an element, or a reflex vertex and a normal of its cone.
    fn start(&self, random: &mut Random) -> Option<Start> {
        let (l, i, element) = self.elements[(random.next() % self.elements.len() as u64) as usize];
        let spline = &self.loops[l as usize];
        let before = spline.element((i as usize + spline.len() - 1) % spline.len());
        let (n0, n1) = (before.normals().1, element.normals().0);
        let t = random.between(0.02, 0.98);
        let is_long = |e: &Element| e.length() > SHORT * self.size;
        if random.unit() < 0.3 && n0.cross(n1) < -SHORT && is_long(&before) && is_long(&element) {
            let turn = n0.angle_to(n1) * t;
            return Some(Start {
                place: element.start,
                normal: n0.rotated(turn.cos(), turn.sin()),
                own: None,
            });
        }
        is_long(&element).then(|| Start {
            place: element.point_at(t),
            normal: element.normal_at(t),
            own: Some((l, i)),
        })
    }

    /// The maximal disk at a start, and how far apart the normals of its two contacts are.
    fn shot(&self, start: &Start) -> (Disk, f64) {
        let error = DISTANCE_ERROR * self.size;
        let center = |radius: f64| start.place + start.normal * radius;
        let (mut radius, mut spread) = (self.size, 2.0);
        for (l, i, element) in &self.elements {
            if start.own == Some((*l, *i)) {
                // The circle itself is the largest disk that is tangent to it from inside.
                let k = element.curvature();
                if k > 0.0 && 1.0 / k < radius {
                    (radius, spread) = (1.0 / k, 2.0);
                }
                continue;
            }
            let holds = |radius: f64| element.distance(center(radius)) < radius - error;
            if !holds(radius) {
                continue;
            }
            let (mut low, mut high) = (0.0, radius);
            loop {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if holds(middle) { high = middle } else { low = middle }
            }
            radius = low;
            let contact = element.nearest(center(radius)).point;
            spread = ((center(radius) - contact).unit() - start.normal).length();
        }
        (Disk { center: center(radius), radius }, spread)
    }

    /// Largest deviation, relative to the size, of some random maximal disks from the axis and of
    /// some disks of the axis from maximal ones; or the first that deviates by too much.
    pub fn deviation(&self, mat: &Mat, seed: u64, count: usize) -> Result<f64, String> {
        let mut random = Random::new(seed);
        let axis = Axis::of(mat);
        let mut worst = 0.0f64;
        for start in (0..count).filter_map(|_| self.start(&mut random)).collect::<Vec<_>>() {
            let (disk, spread) = self.shot(&start);
            let off = self.off_axis(&axis, &disk) / self.size;
            // Along the axis, round-off of the distances is divided by the sine between the normals.
            if off.is_nan() || off > WITHIN + 2.0 * DISTANCE_ERROR / spread {
                let Start { place, normal, .. } = start;
                return Err(format!("the maximal disk {disk:?} at {place:?}, {normal:?} is off by {off:e}"));
            }
            worst = worst.max(off);
        }
        for _ in 0..count {
            let (disk, off) = self.disk_of_axis(&axis, &mut random);
            if off.is_nan() || off > WITHIN {
                return Err(format!("{disk:?} of the axis is off by {off:e}"));
            }
            worst = worst.max(off);
        }
        Ok(worst)
    }

    /// Distance of a disk from the axis, in center and radius.
    fn off_axis(&self, axis: &Axis, disk: &Disk) -> f64 {
        let near =
            axis.vertices.iter().map(|v| v.center.distance(disk.center) + (v.radius - disk.radius).abs());
        let mut best = near.fold(f64::INFINITY, f64::min);
        for edge in axis.edges_near(disk.center, best.min(SHORT * self.size)) {
            let (distance, place) = nearest(edge, disk.center);
            if distance < best {
                let radii = edge.sites.map(|site| self.to_site(place, site));
                let off = radii.map(|r| (r - disk.radius).abs());
                best = best.min(distance.max(off[0]).max(off[1]));
            }
        }
        best
    }

    /// A random disk of the axis and its deviation, relative to the size: of its radius from the
    /// distance of its center to the whole boundary, and of both its sites from that.
    fn disk_of_axis(&self, axis: &Axis, random: &mut Random) -> (Disk, f64) {
        let pick = |count: usize, random: &mut Random| (random.next() % count as u64) as usize;
        if axis.edges.is_empty() || random.unit() < 0.3 {
            let disk = axis.vertices[pick(axis.vertices.len(), random)];
            return (disk, (self.distance(disk.center) - disk.radius).abs() / self.size);
        }
        let edge = &axis.edges[pick(axis.edges.len(), random)];
        let center = at(edge, random.unit());
        let radius = self.distance(center);
        let off = edge.sites.map(|site| (self.to_site(center, site) - radius).abs());
        (Disk { center, radius }, off[0].max(off[1]) / self.size)
    }
}

/// The axis as curves.
struct Axis {
    edges: Vec<AxisEdge>,
    vertices: Vec<Disk>,
}

impl Axis {
    fn of(mat: &Mat) -> Axis {
        Axis { edges: mat.edges(), vertices: mat.vertices().iter().map(|v| v.disk).collect() }
    }

    /// Edges whose control points lie around a place.
    fn edges_near(&self, p: Point, margin: f64) -> impl Iterator<Item = &AxisEdge> {
        self.edges.iter().filter(move |e| medial::Bounds::around(e.points).grown(margin).contains(p))
    }
}

/// The place of an edge at a parameter of its Bezier curve.
pub fn at(edge: &AxisEdge, t: f64) -> Point {
    let s = 1.0 - t;
    let middle = 2.0 * s * t * edge.weight;
    // From the nearer end, so that round-off is that of the edge and not of its place.
    let base = if t <= 0.5 { edge.points[0] } else { edge.points[2] };
    let [a, b, c] = edge.points.map(|p| p - base);
    base + (a * (s * s) + b * middle + c * (t * t)) / (s * s + middle + t * t)
}

/// Distance of a place from an edge, and the nearest place of it: the best of a row of samples, and
/// from there by golden sections.
fn nearest(edge: &AxisEdge, p: Point) -> (f64, Point) {
    const SAMPLES: usize = 32;
    const SECTIONS: usize = 80;
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let off = |t: f64| (at(edge, t) - p).length_squared();
    let row: Vec<f64> = (0..=SAMPLES).map(|i| off(i as f64 / SAMPLES as f64)).collect();
    let lowest = |i: &usize| {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(SAMPLES));
        row[*i] <= row[before] && row[*i] <= row[after]
    };
    let mut best = (f64::INFINITY, point(f64::NAN, f64::NAN));
    for i in (0..=SAMPLES).filter(lowest) {
        let (mut low, mut high) = (i.saturating_sub(1) as f64, (i + 1).min(SAMPLES) as f64);
        (low, high) = (low / SAMPLES as f64, high / SAMPLES as f64);
        for _ in 0..SECTIONS {
            let (a, b) = (high - golden * (high - low), low + golden * (high - low));
            if off(a) <= off(b) { high = b } else { low = a }
        }
        for t in [i as f64 / SAMPLES as f64, low, high] {
            let place = at(edge, t);
            let distance = place.distance(p);
            if distance < best.0 {
                best = (distance, place);
            }
        }
    }
    best
}
