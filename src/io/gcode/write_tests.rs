use super::*;
use crate::geom::point;
use proptest::prelude::*;

fn at(x: f64, y: f64, z: f64) -> Point3 {
    Point3 { x, y, z }
}

fn rapid(x: f64, y: f64, z: f64) -> Move {
    Move::Rapid { to: at(x, y, z) }
}

fn line(x: f64, y: f64, z: f64) -> Move {
    Move::Feed { to: at(x, y, z), rate: 600.0 }
}

/// A disk of radius 2 cut once round, entered by a helix.
fn disk() -> Vec<Move> {
    let half = |x, z, ccw| Move::Arc { to: at(x, 0.0, z), center: point(0.0, 0.0), ccw, rate: 600.0 };
    vec![
        rapid(2.0, 0.0, 5.0),
        rapid(2.0, 0.0, 1.0),
        Move::Feed { to: at(2.0, 0.0, 0.0), rate: 200.0 },
        half(-2.0, -0.5, true),
        half(2.0, -1.0, true),
        half(-2.0, -1.0, true),
        half(2.0, -1.0, true),
        line(1.0, 0.5, -1.0),
        rapid(1.0, 0.5, 5.0),
    ]
}

/// What a strict reader finds in a program: motions as (kind, start, end, center).
type Motion = (u8, [f64; 3], [f64; 3], Option<[f64; 2]>);

/// Reads a program as a controller does and refuses whatever any controller might.
fn read(text: &str, units: Units) -> Vec<Motion> {
    let mm = if units == Units::Mm { 1.0 } else { 25.4 };
    let (mut motions, mut now, mut feed, mut ended) = (Vec::new(), [f64::NAN; 3], false, false);
    for text in text.lines() {
        assert!(text.len() <= 80 && text.is_ascii() && !ended, "{text}");
        if text.starts_with('(') {
            assert!(text.ends_with(')') && text.matches(['(', ')']).count() == 2, "{text}");
            continue;
        }
        let text: String = text.chars().filter(|c| *c != ' ').collect();
        let starts: Vec<_> = text.char_indices().filter(|c| c.1.is_ascii_uppercase()).map(|c| c.0).collect();
        let (mut to, mut center, mut radius, mut motion) = (now, [None; 2], None, None);
        for (i, &start) in starts.iter().enumerate() {
            let number = &text[start + 1..starts.get(i + 1).copied().unwrap_or(text.len())];
            assert!(number.bytes().all(|b| b.is_ascii_digit() || b == b'.' || b == b'-'), "{text}");
            let value: f64 = number.parse().unwrap();
            assert!(value != 0.0 || !number.starts_with('-'), "{text}");
            match (&text[start..start + 1], number) {
                ("X", _) => to[0] = value,
                ("Y", _) => to[1] = value,
                ("Z", _) => to[2] = value,
                ("I", _) => center[0] = Some(value),
                ("J", _) => center[1] = Some(value),
                ("R", _) => radius = Some(value),
                ("F", _) => feed = value > 0.0,
                ("G", "0" | "1" | "2" | "3") => motion = Some(number.parse::<u8>().unwrap()),
                ("M", "30") => ended = true,
                ("G" | "M" | "S" | "T" | "N" | "P", _) => {}
                _ => panic!("unknown word in {text}"),
            }
        }
        let Some(motion) = motion else { continue };
        if now[2].is_nan() {
            assert!(motion == 0 && to[0].is_nan() && to[1].is_nan(), "{text}");
        } else {
            assert!(motion == 0 || feed && to.iter().all(|c| !c.is_nan()), "{text}");
        }
        let mut about = None;
        if motion > 1 {
            let chord = (to[0] - now[0]).hypot(to[1] - now[1]);
            assert!(chord > 0.0, "full circle: {text}");
            if let [Some(i), Some(j)] = center {
                let (r0, r1) = (i.hypot(j), (to[0] - now[0] - i).hypot(to[1] - now[1] - j));
                assert!((r0 - r1).abs() * mm <= 0.002 + 1e-9, "{text}: {r0} {r1}");
                about = Some([now[0] + i, now[1] + j]);
            } else {
                assert!(2.0 * radius.expect("an arc has a center or a radius") >= chord, "{text}");
            }
        }
        motions.push((motion, now, to, about));
        now = to;
    }
    assert!(ended);
    motions
}

#[test]
fn a_program_in_millimeters() {
    let setup = Setup { comments: vec!["disk.dxf".into()], ..Setup::default() };
    let written = write(&disk().into(), &setup).unwrap();
    read(&written.text, Units::Mm);
    insta::assert_snapshot!(written.text, @r"
    (disk.dxf)
    G21
    G90
    G17
    G94
    G54
    T1
    S12000 M3
    G0 Z5.0000
    G0 X2.0000 Y0.0000
    G0 Z1.0000
    G1 Z0.0000 F200
    G3 X-2.0000 Y0.0000 Z-0.5000 I-2.0000 J0.0000 F600
    G3 X2.0000 Y0.0000 Z-1.0000 I2.0000 J0.0000
    G3 X-2.0000 Y0.0000 I-2.0000 J0.0000
    G3 X2.0000 Y0.0000 I2.0000 J0.0000
    G1 X1.0000 Y0.5000
    G0 Z5.0000
    M5
    M30
    ");
    let stats = written.stats;
    assert_eq!((stats.arcs, stats.lines, stats.rapids), (4, 2, 4));
    assert_eq!((stats.text_lines, stats.bytes), (written.text.lines().count(), written.text.len()));
}

#[test]
fn a_program_in_inches_with_everything() {
    let setup = Setup {
        line_numbers: true,
        coolant: Coolant::Flood,
        dwell: 2.5,
        wcs: 55,
        tool_number: 7,
        spindle: 9999.7,
        arcs: ArcWords::R,
        ..Setup::new(Units::Inch)
    };
    let written = write(&disk()[..4].to_vec().into(), &setup).unwrap();
    read(&written.text, Units::Inch);
    insta::assert_snapshot!(written.text, @r"
    N10 G20
    N20 G90
    N30 G17
    N40 G94
    N50 G55
    N60 T7
    N70 S10000 M3
    N80 G4 P2.5
    N90 M8
    N100 G0 Z0.20000
    N110 G0 Z5.00000
    N120 G0 X2.00000 Y0.00000
    N130 G0 Z1.00000
    N140 G1 Z0.00000 F200
    N150 G3 X0.00000 Y2.00000 Z-0.25000 R2.00000 F600
    N160 G3 X-2.00000 Y0.00000 Z-0.50000 R2.00000
    N170 G0 Z0.20000
    N180 M5
    N190 M9
    N200 M30
    ");
}

#[test]
fn arcs_become_lines_within_the_tolerance() {
    let setup = Setup { arcs: ArcWords::Off, tolerance: 0.01, ..Setup::default() };
    let written = write(&disk().into(), &setup).unwrap();
    let motions = read(&written.text, Units::Mm);
    assert!(written.stats.arcs == 0 && motions.iter().all(|m| m.0 < 2));
    for (_, a, b, _) in motions.iter().filter(|m| m.0 == 1 && m.2[2] == -1.0).take(20) {
        let middle = (0.5 * (a[0] + b[0])).hypot(0.5 * (a[1] + b[1]));
        assert!((1.9899..=2.0001).contains(&middle), "{middle}");
    }
}

#[test]
fn a_rapid_goes_up_before_and_down_after_it_travels() {
    let moves = [rapid(1.0, 1.0, 3.0), rapid(2.0, 2.0, 9.0), rapid(3.0, 3.0, 1.0)];
    let written = write(&moves.into(), &Setup::default()).unwrap();
    let rapids: Vec<_> = written.text.lines().filter(|l| l.starts_with("G0")).collect();
    let expected = ["Z5.0000", "X1.0000 Y1.0000", "Z3.0000", "Z9.0000", "X2.0000 Y2.0000", "X3.0000 Y3.0000"];
    assert_eq!(rapids.iter().map(|l| &l[3..]).collect::<Vec<_>>()[..6], expected);
    assert_eq!(rapids[6..], ["G0 Z1.0000", "G0 Z5.0000"]);
}

#[test]
fn motions_that_round_to_nothing_are_dropped_and_counted() {
    let tiny = Move::Arc { to: at(2e-5, 0.0, 0.0), center: point(1e-5, 0.0), ccw: true, rate: 600.0 };
    let moves = [rapid(0.0, 0.0, 1.0), line(0.0, 0.0, 0.0), line(-1e-5, 0.0, 0.0), line(0.0, 0.0, 0.0), tiny];
    let written = write(&moves.into(), &Setup::default()).unwrap();
    let stats = written.stats;
    assert_eq!((stats.lines, stats.dropped_lines, stats.dropped_arcs, stats.arcs), (1, 2, 1, 0));
    assert_eq!(stats.dropped_arc_at, Some(point(2e-5, 0.0)));
    read(&written.text, Units::Mm);
}

#[test]
fn bad_numbers_are_refused() {
    let setup = Setup::default();
    assert!(write(&[line(1.0, 0.0, 0.0)].into(), &setup).is_err());
    assert!(write(&[rapid(f64::NAN, 0.0, 1.0)].into(), &setup).is_err());
    let arc = Move::Arc { to: at(1.0, f64::INFINITY, 0.0), center: point(0.0, 0.0), ccw: true, rate: 1.0 };
    assert!(write(&[rapid(0.0, 0.0, 1.0), arc].into(), &setup).is_err());
    for rate in [0.0, -1.0, f64::NAN, 1e-9] {
        let feed = Move::Feed { to: at(1.0, 0.0, 0.0), rate };
        assert!(write(&[rapid(0.0, 0.0, 1.0), feed].into(), &setup).is_err());
    }
    for setup in [
        Setup { decimals: 1, ..Setup::default() },
        Setup { wcs: 60, ..Setup::default() },
        Setup { spindle: 0.4, ..Setup::default() },
        Setup { tolerance: f64::NAN, ..Setup::default() },
        Setup { clearance: f64::NAN, ..Setup::default() },
        Setup { dwell: -1.0, ..Setup::default() },
    ] {
        assert!(write(&Moves::default(), &setup).is_err(), "{setup:?}");
    }
}

/// Farthest that places along the written arcs lie from the drawn one, and the written sweep.
fn deviation(motions: &[Motion], drawn: &Element) -> (f64, f64) {
    let (mut worst, mut sweep) = (0f64, 0.0);
    for (kind, a, b, about) in motions {
        let (start, end) = (point(a[0], a[1]), point(b[0], b[1]));
        let written = match about {
            Some([x, y]) => {
                let c = point(*x, *y);
                let turn = (start - c).angle_to(end - c).rem_euclid(2.0 * PI);
                let turn = if *kind == 3 { turn } else { turn - 2.0 * PI };
                sweep += turn;
                Element::arc(start, end, (0.25 * turn).tan())
            }
            None => Element::segment(start, end),
        };
        for i in 0..=8 {
            worst = worst.max(drawn.distance(written.point_at(f64::from(i) / 8.0)));
        }
    }
    (worst, sweep)
}

proptest! {
    #[test]
    fn written_arcs_stay_within_rounding_of_the_drawn_ones(
        x in -100.0..100.0f64,
        y in -100.0..100.0f64,
        log_radius in -4.0..3.0f64,
        angle in -3.2..3.2f64,
        log_sweep in -4.0..0.497f64,
        ccw: bool,
        decimals in 2u32..=6,
        inch: bool,
    ) {
        let units = if inch { Units::Inch } else { Units::Mm };
        let (radius, sweep) = (10f64.powf(log_radius), 10f64.powf(log_sweep).min(PI));
        let sweep = if ccw { sweep } else { -sweep };
        let center = point(x, y);
        let from = center + crate::geom::Vector::from_angle(angle) * radius;
        let to = center + crate::geom::Vector::from_angle(angle + sweep) * radius;
        let arc = Move::Arc { to: at(to.x, to.y, -1.0), center, ccw, rate: 100.0 };
        let moves = [rapid(from.x, from.y, 1.0), line(from.x, from.y, -1.0), arc];
        let setup = Setup { decimals, ..Setup::new(units) };
        let written = write(&moves.into(), &setup).unwrap();
        let motions = read(&written.text, units);
        let cut: Vec<_> = motions.into_iter().filter(|m| m.0 > 0 && m.1[..2] != m.2[..2]).collect();
        let drawn = Element::arc(from, to, (0.25 * sweep).tan());
        let (worst, turned) = deviation(&cut, &drawn);
        // Ends, center and what passes for straight are off by a step in all, and the radii differ.
        let bound = 2.0 * 0.1f64.powi(decimals as i32) + if decimals < 4 { setup.radius_error() } else { 0.0 };
        prop_assert!(worst <= bound, "{} > {}\n{}", worst, bound, written.text);
        prop_assert!(turned.abs() <= sweep.abs() + PI / 2.0);
    }
}
