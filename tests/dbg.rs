use medial::*;
#[test]
fn dbg() {
    let t = |p: Point| {
        let (s, c) = 37f64.to_radians().sin_cos();
        point(p.x * c - p.y * s - 1e6, p.x * s + p.y * c + 1e6)
    };
    let l = vec![
        ArcSpline::closed([
            (-20., -20., 0.),
            (20., -20., 0.),
            (20., 0., 0.),
            (20., 20., 0.),
            (-20., 20., 0.),
        ]),
        ArcSpline::circle(point(16., 0.), 4.).reversed(),
    ];
    for l in [l.clone(), l.iter().map(|s| s.mapped(false, t)).collect::<Vec<_>>()] {
        let m = medial::boundary::checked(l.clone()).medial_axis().unwrap();
        println!("{:?} {:?}", m.counts(), m.check());
        for v in m.vertices() {
            let c = v.disk.center;
            println!(
                "  {:?} r {} dist {}",
                c,
                v.disk.radius,
                l.iter().map(|b| b.distance(c)).fold(99., f64::min)
            );
        }
        for e in m.edges() {
            println!(" edge {} {} {:?}", e.from, e.to, e.sites);
        }
    }
}
