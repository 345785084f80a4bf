//! Colors and widths.

use std::fmt::Write;

/// How lines of one kind look.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    /// Name of the class.
    pub class: &'static str,
    /// What the legend says.
    pub label: &'static str,
    /// Color on light ground.
    light: &'static str,
    /// Color on dark ground.
    dark: &'static str,
    /// Width of the line in pixels.
    width: f64,
    /// Lengths of dashes in pixels.
    dashes: &'static [f64],
}

const fn look(
    class: &'static str,
    label: &'static str,
    colors: [&'static str; 2],
    width: f64,
    dashes: &'static [f64],
) -> Look {
    Look { class, label, light: colors[0], dark: colors[1], width, dashes }
}

/// The outlines of pockets and islands.
pub(super) const WALL: Look = look("wall", "boundary", ["#1f2a37", "#e8edf4"], 1.8, &[]);
/// The medial axis.
pub(super) const AXIS: Look = look("axis", "medial axis", ["#b0308f", "#f08bd6"], 1.2, &[]);
/// Level sets.
pub(super) const LEVEL: Look = look("level", "level sets", ["#17808a", "#4cc4c4"], 1.1, &[]);
/// Cuts at depth.
pub(super) const CUT: Look = look("cut", "cut", ["#2463c8", "#7fb2ff"], 1.2, &[]);
/// Ways down into the stock.
pub(super) const ENTRY: Look = look("entry", "entry", ["#d9600a", "#ff9d4d"], 1.8, &[]);
/// Rapids.
pub(super) const RAPID: Look = look("rapid", "rapid", ["#8a6d1a", "#d8bd5c"], 0.8, &[5.0, 4.0]);
/// Curves of the drawing that bound nothing.
pub(super) const CURVE: Look = look("curve", "drawn", ["#6b7684", "#98a3b1"], 1.0, &[]);
/// Defects.
pub(super) const MARK: Look = look("mark", "defect", ["#cc1f2f", "#ff6b76"], 2.0, &[]);

/// Curves of the drawing that could have been boundary and are not.
pub(super) const UNUSED: Look = look("unused", "drawn, in no pocket", ["#d9600a", "#ff9d4d"], 1.4, &[]);
/// Ellipses and splines.
pub(super) const FREE: Look =
    look("free", "ellipse or spline, not fitted", ["#7a3fc4", "#b995f5"], 1.4, &[7.0, 4.0]);

const ALL: [Look; 8] = [WALL, AXIS, LEVEL, CUT, ENTRY, RAPID, CURVE, MARK];

/// Color of level `i` of `n`: from the wall inward through hues of a middling lightness, which
/// reads on light and dark ground.
pub(super) fn level_color(i: usize, n: usize) -> String {
    const STOPS: [[f64; 3]; 5] = [
        [70.0, 116.0, 216.0],
        [12.0, 130.0, 178.0],
        [0.0, 146.0, 132.0],
        [72.0, 152.0, 68.0],
        [158.0, 142.0, 24.0],
    ];
    let at = if n < 2 { 0.0 } else { i as f64 / (n - 1) as f64 * (STOPS.len() - 1) as f64 };
    let low = (at.floor() as usize).min(STOPS.len() - 2);
    let mix = |c: usize| STOPS[low][c] + (STOPS[low + 1][c] - STOPS[low][c]) * (at - low as f64);
    format!("#{:02x}{:02x}{:02x}", mix(0).round() as u8, mix(1).round() as u8, mix(2).round() as u8)
}

/// Class of the whole picture. Every rule of the style sheet asks for it, so that a picture can stand
/// in a page and leave the rest of the page alone.
pub(super) const PICTURE: &str = "pocket-picture";

/// Rules for the labels of marks.
const TAGS: [&str; 2] = [
    "@.tag{fill:#cc1f2f;stroke:#fdfdfb;stroke-width:1}@.number{fill:#fff;font-weight:600}@.caption{fill:#8a94a3}\n",
    "@.tag{fill:#ff6b76;stroke:#15181d}@.number{fill:#15181d}\n",
];

/// The style sheet; with the rules for `more` looks than those of every picture, and for labels if
/// there are any. `pixel` is the size of a pixel in job units: programs that do not know widths
/// that stay when the picture is enlarged draw with that.
pub(super) fn sheet(pixel: f64, more: &[Look], labels: bool) -> String {
    let looks: Vec<&Look> = ALL.iter().chain(more).collect();
    let [tags, dark_tags] = if labels { TAGS } else { [""; 2] };
    let within = format!(".{PICTURE} ");
    let scoped = |css: &str| css.replace('@', &within);
    let mut css = scoped(
        "@text{font-family:system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif;\
         fill:#3a4554}\n\
         @path,@circle{fill:none;stroke-linejoin:round;stroke-linecap:round}\n\
         @.stock{fill:#e9e4da}@.floor{fill:#fdfdfb;stroke:none;fill-rule:evenodd}\n\
         @.scale{stroke:#3a4554;stroke-width:1.6}\n",
    );
    css += &scoped(tags);
    for l in &looks {
        let _ = writeln!(css, "{within}.{}{{stroke:{};{}}}", l.class, l.light, pen(l, pixel, ""));
        let _ = writeln!(css, "{within}.key .{}{{{}}}", l.class, pen(l, 1.0, ""));
    }
    css += "@supports (vector-effect:non-scaling-stroke){\n";
    css += &scoped("@path,@circle{vector-effect:non-scaling-stroke}\n");
    for l in &looks {
        let _ = writeln!(css, "{within}.{}{{{}}}", l.class, pen(l, 1.0, "px"));
    }
    css += "}\n@media (prefers-color-scheme:dark){\n";
    css += &scoped("@text{fill:#c3ccd8}@.scale{stroke:#c3ccd8}@.stock{fill:#15181d}@.floor{fill:#252b34}\n");
    css += &scoped(dark_tags);
    for l in &looks {
        let _ = writeln!(css, "{within}.{}{{stroke:{}}}", l.class, l.dark);
    }
    css + "}\n@media print{" + &scoped("@.stock{fill:#f1eee8}") + "}\n"
}

/// Width and dashes.
fn pen(look: &Look, scale: f64, unit: &str) -> String {
    let mut css = format!("stroke-width:{}{unit}", digits(look.width * scale));
    if !look.dashes.is_empty() {
        let dashes: Vec<_> = look.dashes.iter().map(|d| format!("{}{unit}", digits(d * scale))).collect();
        let _ = write!(css, ";stroke-dasharray:{}", dashes.join(" "));
    }
    css
}

/// Four digits that matter.
fn digits(value: f64) -> String {
    let decimals = (3.0 - value.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_go_from_blue_to_gold() {
        assert_eq!(level_color(0, 3), "#4674d8");
        assert_eq!(level_color(1, 3), "#009284");
        assert_eq!(level_color(2, 3), "#9e8e18");
        assert_eq!(level_color(0, 1), "#4674d8");
    }

    #[test]
    fn widths_are_written_with_the_digits_that_matter() {
        assert_eq!(
            (digits(0.001234567), digits(1234.5), digits(2.0)),
            ("0.001235".into(), "1234".into(), "2".into())
        );
    }
}
