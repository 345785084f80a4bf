//! From job units to the page: where things are, legend, scale bar.

use super::style::Look;
use crate::geom::{Bounds, Point, Vector, vector};
use crate::tolerance::Units;
use std::fmt::Write;

/// Length of the longer side of the drawing on the page, in pixels.
const SIDE: f64 = 1000.0;

/// Room round the drawing.
const MARGIN: f64 = 40.0;

/// Size of letters.
const LETTER: f64 = 17.0;

/// Mean width of a letter, relative to its size; errs on the wide side.
const WIDTH_OF_LETTER: f64 = 0.56;

/// Height of a line of the legend.
const LINE: f64 = 26.0;

/// Length of the sample line in the legend.
const SAMPLE: f64 = 34.0;

/// Beyond this many times its own size from the origin a drawing is moved to it: many programs
/// calculate with single precision.
const FAR: f64 = 100.0;

/// Where the drawing is and how it is put on the page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    bounds: Bounds,
    /// What is taken from every coordinate.
    pub shift: Vector,
    /// Pixels per job unit.
    pub scale: f64,
    /// Decimals of coordinates.
    decimals: usize,
}

impl Frame {
    /// The frame round a drawing; a place of size 1 at the origin round nothing.
    pub fn new(bounds: Bounds) -> Frame {
        let usable = !bounds.is_empty() && bounds.min.is_finite() && bounds.max.is_finite();
        let bounds = if usable { bounds } else { Bounds::around([Point::default()]) };
        let extent = bounds.extent();
        let side = extent.x.max(extent.y);
        let side = if side > 0.0 && side.is_finite() { side } else { 1.0 };
        let far = bounds.magnitude() > FAR * side;
        let shift = if far { bounds.min.to_vector() } else { vector(0.0, 0.0) };
        // A thousandth of a pixel.
        let decimals = (6.0 - side.log10().floor()).clamp(0.0, 12.0) as usize;
        Frame { bounds, shift, scale: SIDE / side, decimals }
    }

    /// Size of a pixel in job units.
    pub fn pixel(&self) -> f64 {
        1.0 / self.scale
    }

    /// Width of the page in pixels.
    pub fn width(&self) -> f64 {
        (self.bounds.extent().x * self.scale).max(0.45 * SIDE) + 2.0 * MARGIN
    }

    /// Height of the part of the page that holds the drawing.
    pub fn height(&self) -> f64 {
        self.bounds.extent().y * self.scale + 2.0 * MARGIN
    }

    /// Puts shapes in job units on the page.
    pub fn transform(&self) -> String {
        let corner = self.bounds.min - self.shift;
        let left = 0.5 * (self.width() - self.bounds.extent().x * self.scale);
        let x = left - corner.x * self.scale;
        let y = self.height() - MARGIN + corner.y * self.scale;
        format!("matrix({0} 0 0 -{0} {x:.4} {y:.4})", self.scale)
    }

    /// A place on the page, in pixels from its upper left corner.
    pub fn on_page(&self, p: Point) -> (f64, f64) {
        let left = 0.5 * (self.width() - self.bounds.extent().x * self.scale);
        let p = p - self.bounds.min;
        (left + p.x * self.scale, self.height() - MARGIN - p.y * self.scale)
    }

    /// A length or a shifted coordinate, as short as can be.
    pub fn number(&self, value: f64) -> String {
        let text = format!("{value:.*}", self.decimals);
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        if text == "-0" { "0".into() } else { text.into() }
    }

    /// A place.
    pub fn place(&self, p: Point) -> String {
        let p = p - self.shift;
        format!("{} {}", self.number(p.x), self.number(p.y))
    }

    /// A bar of a round length.
    pub fn scale_bar(&self, units: Units, y: f64) -> String {
        let wanted = 0.2 * SIDE / self.scale;
        let power = 10f64.powf(wanted.log10().floor());
        let length = [5.0, 2.0, 1.0].into_iter().map(|f| f * power).find(|l| *l <= wanted).unwrap_or(power);
        let unit = if units == Units::Mm { "mm" } else { "in" };
        let (x0, x1) = (MARGIN, MARGIN + length * self.scale);
        format!(
            "<path class=\"scale\" d=\"M{x0} {:.1}V{:.1}H{x1:.2}V{:.1}\"/><text x=\"{:.2}\" y=\"{:.1}\">{length} {unit}</text>\n",
            y - 6.0,
            y,
            y - 6.0,
            x1 + 8.0,
            y + 3.0
        )
    }

    /// The legend under the drawing; answers the text and its height.
    pub fn legend(&self, entries: &[(Look, Option<String>)], top: f64) -> (String, f64) {
        let (mut text, mut x, mut y) = (String::new(), MARGIN, top + 0.6 * LINE);
        for (look, color) in entries {
            let width = SAMPLE + 8.0 + WIDTH_OF_LETTER * LETTER * look.label.len() as f64 + 22.0;
            if x > MARGIN && x + width > self.width() {
                (x, y) = (MARGIN, y + LINE);
            }
            let color = color.as_ref().map(|c| format!(" style=\"stroke:{c}\"")).unwrap_or_default();
            let _ = writeln!(
                text,
                "<path class=\"{}\"{color} d=\"M{x:.1} {:.1}h{SAMPLE}\"/><text x=\"{:.1}\" y=\"{y:.1}\">{}</text>",
                look.class,
                y - 0.33 * LETTER,
                x + SAMPLE + 8.0,
                look.label
            );
            x += width;
        }
        let height = if entries.is_empty() { 0.0 } else { y + 0.6 * LINE - top };
        (text, height)
    }

    /// Width of a text, rather too wide.
    pub fn width_of(text: &str) -> f64 {
        1.2 * WIDTH_OF_LETTER * LETTER * text.chars().count() as f64
    }

    /// Size of letters in pixels.
    pub fn letter(&self) -> f64 {
        LETTER
    }
}

/// Text that cannot be taken for markup.
pub(super) fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            c if c.is_control() || ('\u{fffe}'..='\u{ffff}').contains(&c) => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::point;

    #[test]
    fn numbers_are_short_and_fine_enough() {
        let frame = Frame::new(Bounds::around([point(0.0, 0.0), point(80.0, 50.0)]));
        assert_eq!(
            (frame.number(-0.0), frame.number(12.5), frame.number(1.0 / 3.0)),
            ("0".into(), "12.5".into(), "0.33333".into())
        );
        let tiny = Frame::new(Bounds::around([point(0.0, 0.0), point(1e-3, 1e-3)]));
        assert_eq!(tiny.number(1e-4 / 3.0), "0.000033333");
    }

    #[test]
    fn a_drawing_far_away_is_moved_to_the_origin() {
        let frame = Frame::new(Bounds::around([point(1e6, -2e6), point(1e6 + 10.0, -2e6 + 5.0)]));
        assert_eq!(frame.place(point(1e6 + 2.5, -2e6 + 5.0)), "2.5 5");
    }

    #[test]
    fn nothing_and_infinity_have_a_frame() {
        let endless = Bounds { min: point(0.0, 0.0), max: point(f64::INFINITY, 1.0) };
        for bounds in [Bounds::EMPTY, endless, Bounds::around([point(3.0, 3.0)])] {
            assert!(Frame::new(bounds).width().is_finite() && Frame::new(bounds).height() > 0.0);
        }
    }
}
