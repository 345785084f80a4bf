//! Pockets that are a tie, or a cusp, or a circle, but for the last digits: smallest forms of what the
//! fuzzer and the long runs have found.

use medial::{ArcSpline, Pocket, Tolerance, verify};

type Loop<'a> = &'a [(f64, f64, f64)];

/// Levels per pocket, as shares of the largest radius.
const LEVELS: [f64; 5] = [0.03, 0.25, 0.5, 0.75, 0.97];

/// What the certificate or the judge of levels says against a pocket.
fn fault(loops: &[Loop<'_>]) -> Option<String> {
    let loops = loops.iter().map(|l| ArcSpline::closed(l.iter().copied())).collect();
    let pocket = match Pocket::from_loops(loops, Tolerance::MM) {
        Ok(pocket) => pocket,
        Err(e) => return Some(e.to_string()),
    };
    let mat = match pocket.medial_axis() {
        Ok(mat) => mat,
        Err(e) => return Some(e.to_string()),
    };
    if let Err(e) = mat.check() {
        return Some(e.to_string());
    }
    LEVELS.iter().find_map(|share| {
        let d = share * mat.largest_disk().radius;
        let level = mat.level(d);
        let all: Vec<ArcSpline> = level.loops.into_iter().chain(level.ridges).collect();
        let report = verify::level(pocket.loops(), d, &all);
        (!report.is_right()).then(|| format!("level {d}: {report:?}"))
    })
}

fn assert_right(cases: &[(&str, &[Loop<'_>])]) {
    let faults: Vec<String> =
        cases.iter().filter_map(|(name, loops)| Some(format!("{name}: {}", fault(loops)?))).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A wall that turns back on itself and overlaps by some ten roundings is a corner of no angle. Taken for a
/// reflex one, its disks touched nothing.
#[test]
fn a_cusp_that_overlaps_by_round_off_is_a_corner() {
    assert_right(&[
        (
            "half circle and segment",
            &[&[(952.201365, 51.0, -1.0), (952.2014, 102.9407, 0.0), (592.0, 102.9407, 1.0)]],
        ),
        (
            "two arcs far away",
            &[&[
                (950682.009808, 950682.009797, -0.4),
                (950682.009792, 950682.009781, 1.0),
                (950682.009781, 950682.01, 0.0),
            ]],
        ),
    ]);
}

/// A wedge between two straight walls that some ten roundings part at its open end. Its angle is round-off,
/// and it was taken for a wall that the pocket goes around.
#[test]
fn a_corner_is_one_however_thin_the_wedge_in_it_is() {
    assert_right(&[
        (
            "wedge at the end of a triangle",
            &[&[(-5.0, -8.99, 0.0), (5.0, -9.01, 0.0), (5.0, 9.01, 0.0), (4.999999999999936, -8.99, 0.0)]],
        ),
        (
            "wall as thin as that wedge",
            &[&[
                (-5.0, -9.0, 0.0),
                (5.0, -9.0, 0.0),
                (5.0, 9.0, 0.0),
                (5.000000000000064, -9.0, 0.0),
                (15.0, -9.0, 0.0),
                (15.0, 12.0, 0.0),
                (-5.0, 12.0, 0.0),
            ]],
        ),
    ]);
}

/// Two hollow arcs of nearly the same circle: a disk as large as they are touches them nearly everywhere,
/// and its radius came with half of its digits.
#[test]
fn disks_nearly_as_large_as_an_arc_have_all_their_digits() {
    assert_right(&[
        ("two half circles", &[&[(3.0, 0.0, 0.99999998), (-3.0, 0.0, 0.99999998)]]),
        (
            "half circle and less than one",
            &[&[
                (60.0, 22.0, 1.0417e-4),
                (59.99999895833329, 22.004999999995903, 0.9995834201),
                (36.00000104166671, 22.004999999995903, 1.0417e-4),
                (36.0, 22.0, 1.0),
            ]],
        ),
        ("three arcs", &[&[(6.0, 0.0, 0.0), (54.0, -0.01, 1.0), (54.0, 12.0, 1.0)]]),
        (
            "slot with a long and a short wall",
            &[&[(47.0, 36.0, 0.0), (33.0, 36.0, 0.0), (33.0, 14.0, 1.0), (47.0, 14.005, 0.0)]],
        ),
        (
            "circle with a short arc",
            &[&[
                (7.736474369757218e-4, -2.578824789907e-4, 0.4142135136621),
                (2.578825647674e-4, 2.578824789942686e-4, 4.157743024e-8),
                (2.578824789907e-4, 2.57882478994275e-4, 0.414213562373095),
                (-2.57882478994e-4, -2.578824789907e-4, 1.0),
            ]],
        ),
    ]);
}

/// Two short arcs where a circle was mended: their direction is known to half of the digits, and the disk of
/// the circle, turned by that, was held back by the rest of the circle.
#[test]
fn a_short_arc_does_not_turn_the_disk_of_its_circle() {
    assert_right(&[
        (
            "a millionth of the circle",
            &[&[
                (10.0, 0.0, 0.9999990513434442),
                (9.000800105241069e-12, 9.486570056616017e-6, 4.7432850280327475e-7),
                (0.0, 0.0, 4.742784694314758e-7),
                (9.00346464050017e-12, -9.485569388623105e-6, 0.9999990514435111),
            ]],
        ),
        (
            "a thousandth of a circle moved from afar",
            &[&[
                (-817.9431750050428, 3.458661693143995, 0.0004228505206247063),
                (-817.9460999993607, 0.0, 0.0004228505206335821),
                (-817.9431750050435, -3.458661693216527, 0.9991546564127087),
                (3271.753899999894, 0.0, 0.9991546564127265),
            ]],
        ),
    ]);
}

/// A round island in a round pocket, which overlap by twenty roundings: at the place where they touch, their
/// directions differ by more than those of arcs drawn through it.
#[test]
fn an_island_that_touches_within_round_off_is_part_of_the_wall() {
    assert_right(&[(
        "circle in a circle",
        &[
            &[
                (20.0, 10.0, 1.0),
                (0.0, 10.0, 0.4142136064901367),
                (10.00000150625, 1.3685815850032606e-13, 0.4142135182560547),
            ],
            &[
                (12.000001205, 2.0, -0.4142135182560547),
                (10.00000150625, 1.3685815850032606e-13, -0.4142136064901367),
                (8.000001205, 2.0, -1.0),
            ],
        ],
    )]);
}

/// An island as large as the pocket but for 1e-11, in which it touches along a stretch that no vertex marks:
/// there a disk has no room at all.
#[test]
fn an_axis_passes_a_place_without_room() {
    let outer = [
        (0.012072908679256075, 0.0075455679244509554, 1.0),
        (-0.0030182271699149303, 0.0075455679244509554, 1.0),
    ];
    let island = [
        (0.012072908679121528, 0.007545567924585503, -1.0),
        (-0.0030182271697803825, 0.007545567924585503, -1.0),
    ];
    let loops = [outer, island].map(ArcSpline::closed).to_vec();
    let mat = Pocket::from_loops(loops, Tolerance::MM).unwrap().medial_axis().unwrap();
    assert!(mat.check().is_ok(), "{:?}", mat.check());
}

/// Where loops touch, a corner of the one sector and a straight wall of the other are at the same place: a
/// disk that touches there touches the wall.
#[test]
fn a_disk_touches_the_sector_that_it_lies_in() {
    assert_right(&[(
        "half circle between a corner and a straight wall",
        &[
            &[
                (4.0, 2.0, 0.4),
                (4.0, 4.0, 1.0),
                (2.0, 3.0, 0.0),
                (0.0, 4.0, 0.0),
                (1.0, 2.0, 0.0),
                (0.0, 0.0, 0.0),
            ],
            &[(4.0, 2.0, 0.0), (2.0, 3.0, -1.0)],
        ],
    )]);
}

/// An island that divides the pocket, and touches in places that are no corner on one side: the axis has two
/// parts. One of them may be a single disk.
#[test]
fn a_pocket_that_is_divided_at_straight_walls_has_an_axis_in_parts() {
    assert_right(&[
        (
            "arch on a rectangle",
            &[
                &[
                    (0.0, 0.0, 0.0),
                    (4.0, 0.0, 0.0),
                    (4.0, 2.0, 0.0),
                    (3.0, 2.0, 0.0),
                    (4.0, 5.0, 0.0),
                    (0.0, 5.0, 0.0),
                    (1.0, 2.0, 0.0),
                    (0.0, 2.0, 0.0),
                ],
                &[(3.0, 2.0, 0.0), (1.0, 2.0, 0.0), (1.5, 4.0, 0.0), (2.5, 4.0, 0.0)],
            ],
        ),
        (
            "circle beside a crescent",
            &[
                &[
                    (2.0811391430054162, 1.2071067811865475, 1.0),
                    (0.08113914300541625, 2.2071067811865475, 0.414214),
                    (1.0811391430054162, 0.20710678118654746, 1.0),
                ],
                &[
                    (2.0811391430054162, 1.2071067811865475, 1.0),
                    (1.0811391430054162, 0.20710678118654746, 0.0),
                    (0.08113914300541625, 1.2071067811865475, 0.0),
                    (1.0811391430054162, 2.2071067811865475, 0.0),
                ],
            ],
        ),
    ]);
}

/// Between a segment and an arc that is nearly one: its center lies so far away that places beside it are
/// not to be told from there.
#[test]
fn levels_in_a_hair_thin_lens_are_right() {
    assert_right(&[
        ("below an arc", &[&[(12.0, 6.0, 6e-9), (4.0, 6.0, 0.0)]]),
        (
            "above a segment",
            &[&[(-3.0, -4.154727601938028, 0.0), (0.0, -4.154727601938028, 3.1225881624571956e-7)]],
        ),
    ]);
}

/// Islands a few units apart in a pocket of 2e9: levels far from them are circles that hardly cross.
#[test]
fn levels_of_circles_that_hardly_cross_are_right() {
    let island = |y: f64| [(999999958.0, y, -1.0), (999999962.0, y, 0.0)];
    assert_right(&[(
        "three islands",
        &[
            &[(2e9, 1e9, 1.0), (0.0, 1e9, 1.0)],
            &island(999999988.0),
            &island(999999997.0),
            &island(1000000006.0),
        ],
    )]);
}

/// A flat corner and two walls at one distance: three of the four hardly tell where the disk is.
#[test]
fn a_tie_at_a_flat_corner_is_told_by_the_walls() {
    let bulge = -0.41421356237354656;
    assert_right(&[(
        "round island between walls",
        &[
            &[(7.5, -2.0, 0.0), (7.5, 10.0, 0.0), (-17.5, 10.0, 0.0), (-17.5, -2.0, 0.0)],
            &[(1.5, 4.0, bulge), (-1.5000000000046256, 1.0, bulge), (-4.5, 4.000000000004626, -1.0)],
        ],
    )]);
}

/// The tip of a hair-thin ellipse: its arcs, as short as round-off, take their direction from one of the
/// walls, and must not hand it on to the other.
#[test]
fn a_lent_direction_is_not_handed_on() {
    let tip = [
        (3.676997749590135e-17, -1.2999999999986999e-5, 0.2265387889055347),
        (8.450335485956494e-17, -1.2999999999887052e-5, 1.1378888926236482e-6),
        (2.3379678676139025e-11, -5.687500000010777e-6, 4.607158371614955e-7),
        (2.3379678676139035e-11, 5.687500000010763e-6, 1.1378888926083516e-6),
        (8.450357855489344e-17, 1.299999999988705e-5, 0.22654075540630195),
        (3.676985131516466e-17, 1.2999999999986999e-5, 0.35355702849010895),
        (-3.676997749271728e-17, 1.2999999999986999e-5, 0.22653729052244723),
        (-8.450370473472277e-17, 1.2999999999887052e-5, 1.137888892599725e-6),
        (-2.3379678676139025e-11, 5.687500000010776e-6, 4.60715837161496e-7),
        (-2.3379678676139025e-11, -5.6875000000107744e-6, 1.137888892608353e-6),
        (-8.450357855166226e-17, -1.299999999988705e-5, 0.2265407554065034),
        (-3.676985131198058e-17, -1.2999999999986999e-5, 0.35355702849010906),
    ];
    assert_right(&[("ellipse", &[&tip])]);
}

/// Two vertices across a neck of 1e-8 of the size, seen from afar: where a level passes between them is
/// known to half of the digits only, if it is looked for along the two circles around them.
#[test]
fn levels_behind_a_hair_thin_neck_are_right() {
    assert_right(&[(
        "two round chambers",
        &[&[
            (-866.0254537844287, -499.9999133974634, 0.9999999974999999),
            (-35507.0438104107, -20500.00092270023, 0.9999999974999999),
            (-866.0253537844222, -500.0000866025586, 0.0),
            (866.0254537844105, 499.9999133974917, 0.9999999974999999),
            (35507.04010421988, 20499.98793966362, 0.9999999974999999),
            (866.025353784469, 500.0000866025684, 0.0),
        ]],
    )]);
}
