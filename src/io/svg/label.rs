//! Numbers beside the places that they mark.
//!
//! **Needs** places on the page, in pixels. **Guarantees** that no two labels cover each other as long
//! as the page has room. **Does not** move a label farther away than its line can be followed.
//!
//! **Method.** Marks nearer to each other than a label is high become a group with one label; if there
//! are too many groups, groups grow. Each label takes the first free of some places around its group.

use super::frame::escape;
use std::collections::HashMap;
use std::fmt::Write;

/// Size of the letters of a label, in pixels.
const LETTER: f64 = 15.0;

/// Width of a letter, relative to its size.
const WIDTH_OF_LETTER: f64 = 0.62;

/// Height of a label.
const HEIGHT: f64 = 21.0;

/// Marks within this distance have one label, if that leaves few enough.
const NEAR: f64 = 26.0;

/// A label has so much of the page for itself, in square pixels, so that its line is short.
const ROOM: f64 = 6000.0;

/// As many labels are on the smallest page.
const MIN_LABELS: usize = 16;

/// Height of the line of the title that lies on the page.
const TITLE: f64 = 18.0;

/// Runs of numbers on one label.
const MAX_RUNS: usize = 3;

/// Explanations that a pointer on a label shows.
const MAX_TEXTS: usize = 12;

/// Distances of a label from its mark that are tried.
const RINGS: [f64; 5] = [20.0, 34.0, 52.0, 76.0, 104.0];

/// Directions that are tried, the readiest first.
const DIRECTIONS: [(f64, f64); 8] =
    [(1.0, -1.0), (1.0, 0.0), (-1.0, -1.0), (0.0, -1.0), (1.0, 1.0), (-1.0, 0.0), (0.0, 1.0), (-1.0, 1.0)];

/// A place on the page with its number.
#[derive(Clone, Debug)]
pub(super) struct Mark<'a> {
    pub x: f64,
    pub y: f64,
    pub number: usize,
    pub text: &'a str,
}

/// Marks with one label.
#[derive(Debug)]
struct Group {
    x: f64,
    y: f64,
    marks: Vec<usize>,
}

/// A rectangle on the page.
#[derive(Clone, Copy, Debug)]
struct Area {
    x: f64,
    y: f64,
    width: f64,
    height: f64,
}

impl Area {
    fn meets(&self, other: &Area) -> bool {
        self.x < other.x + other.width
            && other.x < self.x + self.width
            && self.y < other.y + other.height
            && other.y < self.y + self.height
    }

    fn is_within(&self, width: f64, height: f64) -> bool {
        self.x >= 0.0 && self.y >= 0.0 && self.x + self.width <= width && self.y + self.height <= height
    }
}

/// All labels of a page of that size, as SVG; `title` is the width of what stands in its upper left
/// corner.
pub(super) fn labels(marks: &[Mark], [width, height]: [f64; 2], title: f64) -> String {
    let groups = groups(marks, MIN_LABELS.max((width * height / ROOM) as usize));
    let mut taken = vec![Area { x: 0.0, y: 0.0, width: title, height: TITLE }];
    let dots: Vec<Area> = groups.iter().map(|g| around(g.x, g.y, 12.0, 12.0)).collect();
    let (mut lines, mut tags) = (String::new(), String::new());
    for (i, group) in groups.iter().enumerate() {
        let text = numbers(group.marks.iter().map(|&m| marks[m].number).collect());
        let size = (12.0 + WIDTH_OF_LETTER * LETTER * text.chars().count() as f64, HEIGHT);
        let is_free = |area: &Area| {
            area.is_within(width, height)
                && !taken.iter().any(|t| t.meets(area))
                && !dots.iter().enumerate().any(|(j, dot)| j != i && dot.meets(area))
        };
        let places =
            || RINGS.into_iter().flat_map(|ring| DIRECTIONS.map(|way| beside(group, size, ring, way)));
        // On a crowded page a label covers a mark rather than another label.
        let only_labels = |area: &Area| area.is_within(width, height) && !taken.iter().any(|t| t.meets(area));
        let area = places().find(is_free).or_else(|| places().find(only_labels));
        let area = area.unwrap_or_else(|| beside(group, size, RINGS[0], DIRECTIONS[0]));
        taken.push(area);
        let (x, y) = (area.x + 0.5 * area.width, area.y + 0.5 * area.height);
        let _ = writeln!(lines, "<path class=\"mark\" d=\"M{:.1} {:.1}L{x:.1} {y:.1}\"/>", group.x, group.y);
        let _ = writeln!(
            tags,
            "<g><title>{}</title><rect class=\"tag\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" rx=\"5\"/>\
             <text class=\"number\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"{LETTER}\">{}</text></g>",
            escape(&explanation(group, marks)),
            area.x,
            area.y,
            area.width,
            area.height,
            y + 0.36 * LETTER,
            text,
        );
    }
    lines + &tags
}

fn around(x: f64, y: f64, width: f64, height: f64) -> Area {
    Area { x: x - 0.5 * width, y: y - 0.5 * height, width, height }
}

/// Where a label lies that is `ring` away in some direction.
fn beside(group: &Group, (width, height): (f64, f64), ring: f64, (dx, dy): (f64, f64)) -> Area {
    let aside = if dx == 0.0 { 0.0 } else { ring.max(14.0) * 0.6 + 0.5 * width };
    around(group.x + dx * aside, group.y + dy * ring, width, height)
}

/// Marks in groups, in the order of their first marks.
fn groups(marks: &[Mark], max: usize) -> Vec<Group> {
    let mut near = NEAR;
    loop {
        let groups = groups_within(marks, near);
        if groups.len() <= max {
            return groups;
        }
        near *= 1.25;
    }
}

/// Each mark joins the first group that begins within a distance of it.
fn groups_within(marks: &[Mark], near: f64) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut cells: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    for (i, mark) in marks.iter().enumerate() {
        let (cx, cy) = ((mark.x / near).floor() as i64, (mark.y / near).floor() as i64);
        let cells_around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (cx + dx, cy + dy)));
        let found = cells_around
            .filter_map(|cell| cells.get(&cell))
            .flatten()
            .copied()
            .filter(|&g| (groups[g].x - mark.x).hypot(groups[g].y - mark.y) <= near)
            .min();
        match found {
            Some(group) => groups[group].marks.push(i),
            None => {
                cells.entry((cx, cy)).or_default().push(groups.len());
                groups.push(Group { x: mark.x, y: mark.y, marks: vec![i] });
            }
        }
    }
    groups
}

/// Numbers as runs: `2, 5-7 +3` is 2, 5, 6, 7 and three more.
fn numbers(mut all: Vec<usize>) -> String {
    all.sort_unstable();
    all.dedup();
    let runs: Vec<&[usize]> = all.chunk_by(|a, b| a + 1 == *b).collect();
    let run = |r: &&[usize]| match r {
        [one] => one.to_string(),
        [a, b] => format!("{a}, {b}"),
        [first, .., last] => format!("{first}\u{2013}{last}"),
        [] => String::new(),
    };
    let shown: Vec<String> = runs.iter().take(MAX_RUNS).map(run).collect();
    let more: usize = runs.iter().skip(MAX_RUNS).map(|r| r.len()).sum();
    let more = if more > 0 { format!(" +{more}") } else { String::new() };
    shown.join(", ") + &more
}

fn explanation(group: &Group, marks: &[Mark]) -> String {
    let mut texts: Vec<(usize, &str)> =
        group.marks.iter().map(|&m| (marks[m].number, marks[m].text)).collect();
    texts.sort_unstable();
    texts.dedup();
    let more = texts.len().saturating_sub(MAX_TEXTS);
    let mut lines: Vec<String> =
        texts.iter().take(MAX_TEXTS).map(|(n, text)| format!("{n}: {text}")).collect();
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    lines.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marks(places: &[(f64, f64)]) -> Vec<Mark<'static>> {
        let mark = |(i, &(x, y)): (usize, &(f64, f64))| Mark { x, y, number: i + 1, text: "gap" };
        places.iter().enumerate().map(mark).collect()
    }

    fn areas(svg: &str) -> Vec<Area> {
        let value = |tag: &str, name: &str| -> f64 {
            tag.split_once(&format!(" {name}=\"")).unwrap().1.split('"').next().unwrap().parse().unwrap()
        };
        svg.split("<rect")
            .skip(1)
            .map(|r| Area {
                x: value(r, "x"),
                y: value(r, "y"),
                width: value(r, "width"),
                height: value(r, "height"),
            })
            .collect()
    }

    #[test]
    fn numbers_are_told_in_runs() {
        assert_eq!(numbers(vec![7, 5, 6, 2, 2]), "2, 5\u{2013}7");
        assert_eq!(numbers(vec![1, 3, 5, 7, 8]), "1, 3, 5 +2");
        assert_eq!(numbers(vec![4, 3]), "3, 4");
    }

    #[test]
    fn marks_in_one_place_have_one_label() {
        let svg = labels(&marks(&[(100.0, 100.0), (104.0, 99.0), (400.0, 100.0)]), [1000.0, 600.0], 0.0);
        assert!(svg.contains(">1, 2</text>") && svg.contains(">3</text>"), "{svg}");
        assert!(svg.contains("<title>1: gap; 2: gap</title>"));
    }

    #[test]
    fn labels_do_not_cover_each_other_and_stay_on_the_page() {
        let row: Vec<(f64, f64)> = (0..25).map(|i| (2.0 + 39.0 * f64::from(i), 23.0)).collect();
        let areas = areas(&labels(&marks(&row), [980.0, 300.0], 0.0));
        assert_eq!(areas.len(), 25);
        for (i, a) in areas.iter().enumerate() {
            assert!(a.is_within(980.0, 300.0) && !areas[..i].iter().any(|b| a.meets(b)), "{a:?}");
        }
    }

    #[test]
    fn a_crowd_has_few_labels() {
        let crowd: Vec<(f64, f64)> =
            (0..10_000).map(|i| (f64::from(i % 100) * 10.0, f64::from(i / 100) * 10.0)).collect();
        let count = areas(&labels(&marks(&crowd), [1080.0, 1080.0], 0.0)).len();
        assert!((20..=1080 * 1080 / 6000).contains(&count), "{count}");
    }
}
