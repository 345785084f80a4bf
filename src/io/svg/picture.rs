//! The layers of a picture.

use super::frame::{Frame, escape};
use super::free;
use super::label::{self, Mark};
use super::shape;
use super::style::{self, Look};
use crate::boundary::{FreeCurve, Pocket};
use crate::geom::{ArcSpline, Bounds, Element, Point};
use crate::mat::AxisEdge;
use crate::offset::Level;
use crate::tolerance::Units;
use crate::toolpath::{Move, Moves};
use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::fmt::Write;

/// A picture that grows by layers; each is optional and drawn over those that are named before it
/// in this type.
#[derive(Clone, Debug, Default)]
pub struct Picture<'a> {
    title: String,
    units: Units,
    pockets: Vec<&'a Pocket>,
    curves: Vec<&'a ArcSpline>,
    unused: Vec<&'a ArcSpline>,
    free: Vec<Vec<Point>>,
    levels: Vec<&'a Level>,
    axes: Vec<&'a AxisEdge>,
    moves: Vec<&'a Moves>,
    marks: Vec<(Point, String)>,
    numbered: Vec<(Point, usize, String)>,
    captions: Vec<(Point, f64, String)>,
}

impl<'a> Picture<'a> {
    /// An empty picture of a job in this unit.
    pub fn new(units: Units) -> Picture<'a> {
        Picture { units, ..Picture::default() }
    }

    /// The title, such as the name of the drawing.
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Pockets, their islands left standing.
    pub fn pockets(mut self, pockets: impl IntoIterator<Item = &'a Pocket>) -> Self {
        self.pockets.extend(pockets);
        self
    }

    /// Curves that bound nothing.
    pub fn curves(mut self, curves: impl IntoIterator<Item = &'a ArcSpline>) -> Self {
        self.curves.extend(curves);
        self
    }

    /// Curves that could have been boundary; where a pocket has them, its boundary covers them.
    pub fn unused(mut self, curves: impl IntoIterator<Item = &'a ArcSpline>) -> Self {
        self.unused.extend(curves);
        self
    }

    /// Ellipses and splines, drawn dashed and not exactly.
    pub fn free(mut self, curves: impl IntoIterator<Item = &'a FreeCurve>) -> Self {
        self.free.extend(curves.into_iter().map(free::samples));
        self
    }

    /// Level sets.
    pub fn levels(mut self, levels: impl IntoIterator<Item = &'a Level>) -> Self {
        self.levels.extend(levels);
        self
    }

    /// Edges of a medial axis.
    pub fn axis(mut self, edges: impl IntoIterator<Item = &'a AxisEdge>) -> Self {
        self.axes.extend(edges);
        self
    }

    /// A tool path. What is cut again at another height is drawn once.
    pub fn path(mut self, moves: &'a Moves) -> Self {
        self.moves.push(moves);
        self
    }

    /// Places to look at, such as defects, each with what is to be said about it.
    pub fn marks(mut self, marks: impl IntoIterator<Item = (Point, String)>) -> Self {
        self.marks.extend(marks.into_iter().filter(|m| m.0.is_finite()));
        self
    }

    /// Places to look at, each with a number beside it and what it stands for. Places near each other
    /// share a label; several places may have one number.
    pub fn numbered(mut self, marks: impl IntoIterator<Item = (Point, usize, String)>) -> Self {
        self.numbered.extend(marks.into_iter().filter(|m| m.0.is_finite()));
        self
    }

    /// Texts in the middle of disks; of long ones the last word where there is no room for more, and left out where they would be too small to read.
    pub fn captions(mut self, captions: impl IntoIterator<Item = (Point, f64, String)>) -> Self {
        self.captions.extend(captions.into_iter().filter(|c| c.0.is_finite() && c.1.is_finite()));
        self
    }

    /// The picture as text.
    pub fn to_svg(&self) -> String {
        let frame = Frame::new(self.bounds());
        let mut legend = Vec::new();
        let mut body = String::new();
        self.draw_pockets(&frame, &mut body, &mut legend);
        self.draw_levels(&frame, &mut body, &mut legend);
        self.draw_axis(&frame, &mut body, &mut legend);
        self.draw_moves(&frame, &mut body, &mut legend);
        self.draw_marks(&frame, &mut body, &mut legend);
        self.page(&frame, &body, &legend)
    }

    /// Box around everything but the rapids, which may come from anywhere.
    fn bounds(&self) -> Bounds {
        let loops = self.pockets.iter().flat_map(|p| p.loops());
        let levels = self.levels.iter().flat_map(|l| l.loops.iter().chain(&l.ridges));
        let splines =
            loops.chain(self.curves.iter().copied()).chain(self.unused.iter().copied()).chain(levels);
        let shapes = splines.map(ArcSpline::bounds).fold(Bounds::EMPTY, Bounds::union);
        let axes = self.axes.iter().flat_map(|e| e.points).filter(|p| p.is_finite());
        let cuts = self.moves.iter().flat_map(|m| m.iter()).filter(|m| m.rate().is_some());
        let ends = cuts.map(|m| m.to().xy()).filter(|p| p.is_finite());
        let marks = self.marks.iter().map(|m| m.0).chain(self.numbered.iter().map(|m| m.0));
        let places = axes.chain(ends).chain(marks).chain(self.free.iter().flatten().copied());
        shapes.union(Bounds::around(places))
    }

    fn draw_pockets(&self, frame: &Frame, body: &mut String, legend: &mut Legend) {
        let curves: String = self.curves.iter().map(|c| shape::spline(frame, c)).collect();
        for pocket in &self.pockets {
            let d: String = pocket.loops().map(|l| shape::spline(frame, l)).collect();
            let _ = writeln!(body, "<path class=\"floor\" d=\"{d}\"/>");
        }
        layer(body, legend, style::CURVE, &curves);
        let unused: String = self.unused.iter().map(|c| shape::spline(frame, c)).collect();
        layer(body, legend, style::UNUSED, &unused);
        let free: String = self.free.iter().map(|places| shape::chain(frame, places)).collect();
        layer(body, legend, style::FREE, &free);
        let walls: String =
            self.pockets.iter().flat_map(|p| p.loops()).map(|l| shape::spline(frame, l)).collect();
        layer(body, legend, style::WALL, &walls);
    }

    /// Level sets: of one color under a path, otherwise from color to color, wall to center.
    fn draw_levels(&self, frame: &Frame, body: &mut String, legend: &mut Legend) {
        let data = |l: &Level| -> String {
            l.loops.iter().chain(&l.ridges).map(|s| shape::spline(frame, s)).collect()
        };
        if self.moves.iter().any(|m| !m.is_empty()) {
            let all: String = self.levels.iter().map(|l| data(l)).collect();
            return layer(body, legend, style::LEVEL, &all);
        }
        let mut distances: Vec<f64> = self.levels.iter().map(|l| l.distance).collect();
        distances.sort_by(f64::total_cmp);
        distances.dedup();
        let color = |i| style::level_color(i, distances.len());
        for level in &self.levels {
            let d = data(level);
            let i = distances.partition_point(|d| *d < level.distance);
            if !d.is_empty() {
                let color = color(i);
                let _ = writeln!(body, "<path class=\"level\" style=\"stroke:{color}\" d=\"{d}\"/>");
            }
        }
        if !distances.is_empty() {
            legend.push((style::LEVEL, Some(color(distances.len() / 2))));
        }
    }

    fn draw_axis(&self, frame: &Frame, body: &mut String, legend: &mut Legend) {
        let d: String = self.axes.iter().map(|e| shape::conic(frame, e)).collect();
        layer(body, legend, style::AXIS, &d);
    }

    fn draw_moves(&self, frame: &Frame, body: &mut String, legend: &mut Legend) {
        let mut strokes = Strokes::default();
        for moves in &self.moves {
            for [from, to] in moves.pairs() {
                strokes.add(frame, &from, &to);
            }
        }
        layer(body, legend, style::RAPID, &strokes.rapids);
        layer(body, legend, style::CUT, &strokes.cuts);
        layer(body, legend, style::ENTRY, &strokes.entries);
        if strokes.entries.is_empty() && !strokes.holes.is_empty() {
            legend.push((style::ENTRY, None));
        }
        for p in strokes.holes {
            dot(frame, body, style::ENTRY, p, 3.5, "");
        }
    }

    fn draw_marks(&self, frame: &Frame, body: &mut String, legend: &mut Legend) {
        for (p, text) in &self.marks {
            dot(frame, body, style::MARK, *p, 9.0, text);
        }
        // Marks that cannot be told apart are one.
        let mut drawn = BTreeSet::new();
        for (p, ..) in &self.numbered {
            let (x, y) = frame.on_page(*p);
            if drawn.insert(((0.5 * x) as i64, (0.5 * y) as i64)) {
                dot(frame, body, style::MARK, *p, 5.0, "");
            }
        }
        if !(self.marks.is_empty() && self.numbered.is_empty()) {
            legend.push((style::MARK, None));
        }
    }

    /// The texts in disks.
    fn caption_texts(&self, frame: &Frame) -> String {
        let mut texts = String::new();
        for (center, radius, text) in &self.captions {
            let room_of = |text: &str| 1.8 * radius * frame.scale / Frame::width_of(text);
            let last_word = text.rsplit(' ').next().unwrap_or(text);
            let text = if room_of(text) < WELL { last_word } else { text };
            let room = room_of(text);
            if room >= SMALLEST {
                let (x, y) = frame.on_page(*center);
                let size = frame.letter() * room.min(1.0);
                let _ = writeln!(
                    texts,
                    "<text class=\"caption\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"{size:.1}\">{}</text>",
                    y + 0.36 * size,
                    escape(text)
                );
            }
        }
        texts
    }

    /// The numbers beside the marks.
    fn labels(&self, frame: &Frame) -> String {
        let marks: Vec<Mark> = self
            .numbered
            .iter()
            .map(|(p, number, text)| {
                let (x, y) = frame.on_page(*p);
                Mark { x, y, number: *number, text }
            })
            .collect();
        let labels =
            label::labels(&marks, [frame.width(), frame.height()], 40.0 + Frame::width_of(&self.title));
        if labels.is_empty() { labels } else { format!("<g class=\"key\">\n{labels}</g>\n") }
    }

    /// The whole page: drawing above, legend and scale bar below.
    fn page(&self, frame: &Frame, body: &str, legend: &Legend) -> String {
        let head = if self.title.is_empty() { 0.0 } else { 2.0 * frame.letter() };
        let (key, height) = frame.legend(legend, frame.height());
        let foot = frame.height() + height + 1.2 * frame.letter();
        let (width, total) = (frame.width(), head + foot + frame.letter());
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{}\" viewBox=\"0 {:.0} {width:.0} {total:.0}\" \
             font-size=\"{}\">\n",
            style::PICTURE,
            0.0 - head,
            frame.letter()
        );
        if !self.title.is_empty() {
            let _ = writeln!(svg, "<title>{}</title>", escape(&self.title));
        }
        if frame.shift.length_squared() > 0.0 {
            let _ = writeln!(svg, "<desc>moved by {} {}</desc>", -frame.shift.x, -frame.shift.y);
        }
        let is_used = |look: &Look| legend.iter().any(|(l, _)| l.class == look.class);
        let more: Vec<Look> = [style::UNUSED, style::FREE].into_iter().filter(is_used).collect();
        let _ = write!(
            svg,
            "<style>\n{}</style>\n",
            style::sheet(frame.pixel(), &more, !self.numbered.is_empty())
        );
        let _ = writeln!(
            svg,
            "<rect class=\"stock\" x=\"-1\" y=\"{:.0}\" width=\"{:.0}\" height=\"{:.0}\"/>",
            -head - 1.0,
            width + 2.0,
            total + 2.0
        );
        if !self.title.is_empty() {
            let _ =
                writeln!(svg, "<text x=\"40\" y=\"12\" font-weight=\"600\">{}</text>", escape(&self.title));
        }
        let _ = write!(svg, "<g transform=\"{}\">\n{body}</g>\n", frame.transform());
        svg += &self.caption_texts(frame);
        svg += &self.labels(frame);
        let _ = write!(svg, "<g class=\"key\">\n{key}{}</g>\n</svg>\n", frame.scale_bar(self.units, foot));
        svg
    }
}

/// Captions are not written in letters smaller than this part of the usual ones.
const SMALLEST: f64 = 0.5;

/// In letters of this part of the usual size, a caption is easy to read.
const WELL: f64 = 0.75;

/// What the legend explains, with the color where the style sheet does not say it.
type Legend = Vec<(Look, Option<String>)>;

/// One path of one look, if there is anything in it.
fn layer(body: &mut String, legend: &mut Legend, look: Look, d: &str) {
    if !d.is_empty() {
        let _ = writeln!(body, "<path class=\"{}\" d=\"{d}\"/>", look.class);
        legend.push((look, None));
    }
}

/// A small circle with something to say.
fn dot(frame: &Frame, body: &mut String, look: Look, p: Point, pixels: f64, text: &str) {
    let (p, r) = (p - frame.shift, frame.number(pixels * frame.pixel()));
    let (x, y) = (frame.number(p.x), frame.number(p.y));
    let title = if text.is_empty() { String::new() } else { format!("<title>{}</title>", escape(text)) };
    let _ =
        writeln!(body, "<circle class=\"{}\" cx=\"{x}\" cy=\"{y}\" r=\"{r}\">{title}</circle>", look.class);
}

/// Path data of moves by kind.
#[derive(Default)]
struct Strokes {
    cuts: String,
    entries: String,
    rapids: String,
    /// Where the tool goes down on the spot.
    holes: Vec<Point>,
    drawn: BTreeSet<String>,
    /// Kind and end of what was drawn last, to go on from there.
    last: Option<(u8, Point)>,
}

impl Strokes {
    /// Adds the move `to`, which begins where `from` ended.
    fn add(&mut self, frame: &Frame, from: &Move, to: &Move) {
        let (a, b) = (from.to(), to.to());
        if !(a.xy().is_finite() && b.xy().is_finite()) {
            return;
        }
        let d = match *to {
            Move::Arc { center, ccw, .. } => shape::element(frame, &arc(a.xy(), b.xy(), center, ccw)),
            _ => format!("L{}", frame.place(b.xy())),
        };
        let is_rapid = matches!(to, Move::Rapid { .. });
        let kind = if is_rapid { 0 } else { 1 + u8::from(b.z < a.z) };
        let start = frame.place(a.xy());
        if start == frame.place(b.xy()) {
            if kind == 2 && self.drawn.insert(start) {
                self.holes.push(b.xy());
            }
            return;
        }
        if !self.drawn.insert(format!("{kind}{start}{d}")) {
            self.last = None;
            return;
        }
        let data = [&mut self.rapids, &mut self.cuts, &mut self.entries];
        let data = data.into_iter().nth(usize::from(kind)).expect("three kinds");
        if self.last != Some((kind, a.xy())) {
            let _ = write!(data, "M{start}");
        }
        data.push_str(&d);
        self.last = Some((kind, b.xy()));
    }
}

/// The arc of a move.
fn arc(from: Point, to: Point, center: Point, ccw: bool) -> Element {
    let turn = (from - center).angle_to(to - center);
    let sweep = if ccw { turn.rem_euclid(2.0 * PI) } else { -(-turn).rem_euclid(2.0 * PI) };
    // At most half a circle: a nearly full one is a tiny one that round-off turned over.
    let sweep = if sweep.abs() > 1.5 * PI { 0.0 } else { sweep };
    Element::arc(from, to, (0.25 * sweep).tan())
}

#[cfg(test)]
#[path = "picture_tests.rs"]
mod tests;
