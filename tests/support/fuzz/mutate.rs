//! Changes that drawings go through: in their bytes, their groups, their geometry.

use super::chance::Chance;
use super::drawing::{Group, binary, is_measure, records, text};
use super::seeds;

/// Values that no program should have written, and some that are merely unusual.
const AWKWARD: [&str; 26] = [
    "nan",
    "inf",
    "-inf",
    "1e400",
    "-1e400",
    "-0",
    "0",
    "1e308",
    "1e-320",
    "1e15",
    "1e-15",
    "",
    "1,5",
    "0x10",
    "1e",
    "12abc",
    "2147483647",
    "-1",
    "70000",
    "99999999999999999999",
    "1.7e154",
    "EOF",
    "SECTION",
    "ENDSEC",
    "360",
    "1e9",
];

/// The file that belongs to a number.
pub fn file(seed: u64) -> Vec<u8> {
    let mut chance = Chance(seed);
    let chance = &mut chance;
    let mut groups = seeds::any(chance);
    let kind = chance.below(10);
    for _ in 0..chance.below(6) {
        match kind {
            0 | 1 => change_groups(&mut groups, chance),
            _ => change_geometry(&mut groups, chance),
        }
    }
    let mut bytes = if chance.once_in(10) { binary(&groups) } else { text(&groups).into_bytes() };
    if kind == 2 {
        (0..1 + chance.below(4)).for_each(|_| change_bytes(&mut bytes, chance));
    }
    bytes
}

/// A place in a list, and another one not far behind it.
fn stretch(length: usize, chance: &mut Chance) -> std::ops::Range<usize> {
    let start = chance.below(length);
    let most = chance.of(&[1, 2, 8, 64]);
    start..(start + 1 + chance.below(most)).min(length)
}

fn change_bytes(bytes: &mut Vec<u8>, chance: &mut Chance) {
    let range = stretch(bytes.len(), chance);
    if range.is_empty() {
        return;
    }
    match chance.below(8) {
        0 => bytes[range].iter_mut().for_each(|b| *b = chance.bits() as u8),
        1 => bytes[range.start] ^= 1 << chance.below(8),
        2 => drop(bytes.drain(range)),
        3 => {
            let copy = bytes[range].to_vec();
            let at = chance.below(bytes.len());
            drop(bytes.splice(at..at, copy));
        }
        4 => bytes.truncate(range.start),
        5 => bytes.insert(range.start, chance.of(b"\n\r\0 \x1A\xFF09")),
        6 => drop(bytes.splice(range, chance.of(&AWKWARD).bytes())),
        _ => bytes[range].fill(chance.of(b"\n\r\0 ")),
    }
}

fn change_groups(groups: &mut Vec<Group>, chance: &mut Chance) {
    let range = stretch(groups.len(), chance);
    if range.is_empty() {
        return;
    }
    match chance.below(9) {
        0 => drop(groups.drain(range)),
        1 => {
            let copy = groups[range].to_vec();
            let at = chance.below(groups.len());
            drop(groups.splice(at..at, copy));
        }
        2 => {
            let at = chance.below(groups.len());
            groups.swap(range.start, at);
        }
        3 => {
            groups[range.start].0 =
                [0, 2, 5, 8, 10, 41, 66, 70, 91, 230, 999, 5000][chance.below(12)].to_string()
        }
        4 => groups.truncate(range.start),
        5 => {
            let records = records(groups);
            if !records.is_empty() {
                drop(groups.drain(chance.of(&records)));
            }
        }
        6 => {
            // Blank lines shift what is a code and what a value.
            let half = groups[range.start].1.clone();
            groups[range.start].1 = format!("\n{half}");
        }
        _ => groups[range.start].1 = (chance.of(&AWKWARD)).into(),
    }
}

/// Changes measures or entities; what is left remains well written.
fn change_geometry(groups: &mut Vec<Group>, chance: &mut Chance) {
    let measures: Vec<usize> = (0..groups.len()).filter(|&i| is_measure(&groups[i])).collect();
    if measures.is_empty() {
        return;
    }
    let one = chance.of(&measures);
    let real = |g: &Group| g.1.parse::<f64>().unwrap_or_default();
    let value = real(&groups[one]);
    match chance.below(9) {
        0 => groups[one].1 = near(value, chance).to_string(),
        1 => {
            // Vertices move onto others where both coordinates do.
            let other = chance.of(&measures);
            groups[one].1 = groups[other].1.clone();
            if one + 1 < groups.len() && other + 1 < groups.len() && is_measure(&groups[one + 1]) {
                groups[one + 1].1 = groups[other + 1].1.clone();
            }
        }
        2 => groups[one].1 = (value + chance.below(5) as f64 - 2.0).to_string(),
        3 => groups[one].1 = (-value).to_string(),
        4 | 5 => copy_of_an_entity(groups, chance),
        6 => resize(groups, chance),
        7 => {
            let entities = entities(groups);
            if !entities.is_empty() {
                drop(groups.drain(chance.of(&entities)));
            }
        }
        _ => {
            let digits = chance.below(5);
            for i in measures {
                groups[i].1 = format!("{:.digits$}", real(&groups[i]));
            }
        }
    }
}

/// A number that likes to be almost, but not quite, `x`.
fn near(x: f64, chance: &mut Chance) -> f64 {
    match chance.below(4) {
        0 => x * (1.0 + (chance.below(65) as f64 - 32.0) * f64::EPSILON),
        1 => x + chance.spread(1e-13, 0.02) * chance.of(&[1.0, -1.0]),
        2 => x * 10.0 * chance.share(),
        _ => x + chance.of(&[0.01, -0.01, 0.005, 0.02, 0.0]),
    }
}

/// Where the entities lie.
fn entities(groups: &[Group]) -> Vec<std::ops::Range<usize>> {
    const KINDS: [&str; 9] =
        ["LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "INSERT", "HATCH", "SPLINE", "ELLIPSE"];
    records(groups).into_iter().filter(|r| KINDS.contains(&groups[r.start].1.as_str())).collect()
}

/// Draws an entity again: the same, almost, shifted by whole units, or less than ends are joined over.
fn copy_of_an_entity(groups: &mut Vec<Group>, chance: &mut Chance) {
    let all = entities(groups);
    if all.is_empty() {
        return;
    }
    let range = chance.of(&all);
    let mut copy = groups[range.clone()].to_vec();
    let shift = match chance.below(4) {
        0 => 0.0,
        1 => chance.spread(1e-15, 0.02),
        2 => chance.of(&[0.001, 0.01, 0.009_999_999, 0.005]),
        _ => 1.0 + chance.below(6) as f64,
    };
    let along = if chance.once_in(2) { "1" } else { "2" };
    for group in copy.iter_mut().filter(|g| is_measure(g) && g.0.starts_with(along)) {
        group.1 = (group.1.parse::<f64>().unwrap_or_default() + shift).to_string();
    }
    drop(groups.splice(range.end..range.end, copy));
}

/// Scales and moves all coordinates and lengths, which leaves angles and bulges alone.
fn resize(groups: &mut [Group], chance: &mut Chance) {
    let scale = if chance.once_in(2) { 1.0 } else { chance.spread(1e-6, 1e6) };
    let moved = if chance.once_in(2) { 0.0 } else { chance.spread(1.0, 1e7) };
    for group in groups.iter_mut().filter(|g| is_measure(g)) {
        let value: f64 = group.1.parse().unwrap_or_default();
        match group.0.as_str() {
            "40" => group.1 = (value * scale).to_string(),
            code if code.len() == 2 && !code.starts_with(['4', '5']) => {
                group.1 = (value * scale + moved).to_string();
            }
            _ => {}
        }
    }
}
