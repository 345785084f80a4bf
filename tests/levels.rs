//! Level sets of many shapes at many distances, held against the exact judge.

#[path = "support/shapes.rs"]
mod shapes;
use medial::*;
fn judge(name: &str, loops: Vec<ArcSpline>, ds: &[f64]) {
    let p = medial::Pocket::from_loops(loops.clone(), medial::Tolerance::MM).unwrap();
    let m = p.medial_axis().unwrap();
    if let Err(e) = m.check() {
        println!("{name} CHECK {e}");
    }
    let big = m.largest_disk().radius;
    for &f in ds {
        let d = f * big;
        let level = m.level(d);
        let mut offs = level.loops.clone();
        let rep = medial::verify::level(loops.iter(), d, &offs);
        let ua = m.unreachable_area(d);
        if !rep.is_right() {
            println!("{name} d={d} loops {} ridges {}: {:?}", offs.len(), level.ridges.len(), rep);
        }
        let _ = (&mut offs, ua);
    }
}
#[test]
fn scratch() {
    let seeds: u64 = std::env::var("SEEDS").map_or(11, |s| s.parse().unwrap());
    for kind in shapes::KINDS {
        let t = std::time::Instant::now();
        for seed in 1..seeds {
            let l = shapes::make(kind, 300, seed);
            judge(&format!("{kind} {seed}"), l, &[0.01, 0.1, 0.3, 0.5, 0.77, 0.95]);
        }
        println!("{kind} {:?}", t.elapsed());
    }
}
