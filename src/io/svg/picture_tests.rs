use super::*;
use crate::geom::point;
use crate::toolpath::Point3;

fn plate() -> Pocket {
    let island = ArcSpline::circle(point(20.0, 15.0), 6.0).reversed();
    let outer = ArcSpline::closed([
        (5.0, 0.0, 0.0),
        (55.0, 0.0, 0.41421356),
        (60.0, 5.0, 0.0),
        (60.0, 30.0, 0.0),
        (0.0, 30.0, 0.0),
        (0.0, 5.0, 0.41421356),
    ]);
    Pocket::from_checked(outer, vec![island])
}

fn level(distance: f64) -> Level {
    let d = distance;
    let outer =
        ArcSpline::closed([(d, d, 0.0), (60.0 - d, d, 0.0), (60.0 - d, 30.0 - d, 0.0), (d, 30.0 - d, 0.0)]);
    let inner = ArcSpline::circle(point(20.0, 15.0), 6.0 + d).reversed();
    Level { distance, loops: vec![outer, inner], ridges: vec![] }
}

fn moves() -> Moves {
    let to = |x, y, z| Point3 { x, y, z };
    vec![
        Move::Rapid { to: to(3.0, 3.0, 5.0) },
        Move::Feed { to: to(3.0, 3.0, -1.0), rate: 1.0 },
        Move::Feed { to: to(40.0, 3.0, -1.0), rate: 1.0 },
        Move::Arc { to: to(40.0, 27.0, -1.0), center: point(40.0, 15.0), ccw: true, rate: 1.0 },
        Move::Rapid { to: to(40.0, 27.0, 5.0) },
        Move::Rapid { to: to(3.0, 3.0, 5.0) },
        Move::Feed { to: to(3.0, 3.0, -2.0), rate: 1.0 },
        Move::Feed { to: to(40.0, 3.0, -2.0), rate: 1.0 },
    ]
    .into()
}

#[test]
fn every_layer_is_in_the_legend() {
    let (pocket, levels, moves) = (plate(), [level(2.0), level(4.0)], moves());
    let svg = Picture::new(Units::Mm).title("a & b").pockets([&pocket]).levels(&levels).path(&moves).to_svg();
    for label in ["boundary", "level sets", "cut", "entry", "rapid", "a &amp; b", "10 mm"] {
        assert!(svg.contains(&format!(">{label}<")), "{label}");
    }
    assert!(!svg.contains(">medial axis<") && !svg.contains("NaN"));
}

#[test]
fn a_cut_at_two_heights_is_drawn_once() {
    let svg = Picture::new(Units::Inch).path(&moves()).to_svg();
    assert_eq!(svg.matches("<path class=\"cut\" d=\"M3 3L40 3A12 12 0 0 1 40 27\"/>").count(), 1);
    assert_eq!(svg.matches("<circle class=\"entry\"").count(), 1);
}

#[test]
fn marks_say_what_they_are() {
    let marks = [(point(1.0, 2.0), "open <here>".to_string()), (point(f64::NAN, 0.0), "no".to_string())];
    let svg = Picture::new(Units::Mm).marks(marks).to_svg();
    assert!(svg.contains("<title>open &lt;here&gt;</title>") && !svg.contains(">no<"));
}

#[test]
fn an_empty_picture_is_a_picture() {
    let svg = Picture::new(Units::Mm).to_svg();
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n") && !svg.contains("NaN"));
}
