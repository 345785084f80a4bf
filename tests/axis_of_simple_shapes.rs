use medial::{ArcSpline, Pocket, Tolerance};
fn loops(v: Vec<ArcSpline>) -> Pocket {
    medial::boundary::checked(v)
}
#[test]
fn shapes() {
    let sq = ArcSpline::closed([(0., 0., 0.), (1., 0., 0.), (1., 1., 0.), (0., 1., 0.)]);
    let circle = |x: f64, y: f64, r: f64| ArcSpline::circle(medial::point(x, y), r);
    let slot = ArcSpline::closed([(-1., -1., 0.), (1., -1., 1.0), (1., 1., 0.), (-1., 1., 1.0)]);
    let l = ArcSpline::closed([
        (0., 0., 0.),
        (2., 0., 0.),
        (2., 1., 0.),
        (1., 1., 0.),
        (1., 2., 0.),
        (0., 2., 0.),
    ]);
    let rect = ArcSpline::closed([
        (0., 0., 0.),
        (1., 0., 0.),
        (2., 0., 0.),
        (3., 0., 0.),
        (3., 2., 0.),
        (1., 2., 0.),
        (0., 2., 0.),
    ]);
    let frame_in = ArcSpline::closed([(1., 1., 0.), (1., 2., 0.), (3., 2., 0.), (3., 1., 0.)]);
    let frame_out = ArcSpline::closed([(0., 0., 0.), (4., 0., 0.), (4., 3., 0.), (0., 3., 0.)]);
    let big = ArcSpline::closed([(-10., -10., 0.), (10., -10., 0.), (10., 10., 0.), (-10., 10., 0.)]);
    for (name, v) in [
        ("square", vec![sq.clone()]),
        ("circle", vec![circle(0., 0., 1.)]),
        ("slot", vec![slot]),
        ("l", vec![l]),
        ("rect", vec![rect]),
        ("annulus", vec![circle(0., 0., 1.), circle(0., 0., 0.4).reversed()]),
        ("eccentric", vec![circle(0., 0., 1.), circle(0.31, 0.13, 0.4).reversed()]),
        ("frame", vec![frame_out, frame_in]),
        (
            "touching islands",
            vec![
                big.clone(),
                circle(-2., 0., 2.).reversed(),
                ArcSpline::closed([(0., 0., -1.), (4., 0., -1.)]),
            ],
        ),
        (
            "touching wall",
            vec![
                ArcSpline::closed([
                    (-10., -10., 0.),
                    (10., -10., 0.),
                    (10., 0., 0.),
                    (10., 10., 0.),
                    (-10., 10., 0.),
                ]),
                circle(8., 0., 2.).reversed(),
            ],
        ),
    ] {
        let p = loops(v);
        let m = p.medial_axis().unwrap();
        println!("{name}: {:?} {:?} largest {:?}", m.counts(), m.check(), m.largest_disk());
        for v in m.vertices() {
            println!("   {:?}", v);
        }
    }
}
