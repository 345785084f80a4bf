//! The words of a program.

use super::arc::{Fit, with_center, with_radius};
use super::comment::{self, MAX_LINE};
use super::number::{Grid, short};
use super::setup::{ArcWords, Coolant, Setup};
use crate::error::Error;
use crate::geom::{Element, Point};
use crate::tolerance::Units;
use crate::toolpath::{Move, Point3};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Most lines of a program; no controller holds as many.
const MAX_LINES: usize = 50_000_000;

/// Line numbers go up by this and begin again after `LAST_NUMBER`.
const NUMBER_STEP: usize = 10;

/// LinuxCNC and Fanuc read five digits.
const LAST_NUMBER: usize = 99_990;

/// A program as text.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Written {
    /// The text, with a line feed after each line.
    pub text: String,
    /// What is in it.
    pub stats: Stats,
}

/// What a program holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stats {
    /// Lines of text.
    pub text_lines: usize,
    /// Rapids (G0).
    pub rapids: usize,
    /// Straight feeds (G1).
    pub lines: usize,
    /// Arcs (G2, G3).
    pub arcs: usize,
    /// Straight feeds left out because their rounded ends coincide.
    pub dropped_lines: usize,
    /// Arcs left out because their rounded ends coincide.
    pub dropped_arcs: usize,
    /// Where the first of those arcs is.
    pub dropped_arc_at: Option<Point>,
    /// Length of the text.
    pub bytes: usize,
}

/// Writes a program.
///
/// # Errors
/// When a setting or a coordinate is out of its range, when a feed comes before the first rapid to
/// a place in the plane, or when the program would be too long.
pub fn write(moves: &[Move], setup: &Setup) -> Result<Written, Error> {
    setup.check()?;
    let mut writer = Writer::new(setup);
    writer.header()?;
    for m in moves {
        match *m {
            Move::Rapid { to } => writer.rapid(to)?,
            Move::Feed { to, rate } => writer.feed(to, rate)?,
            Move::Arc { to, center, ccw, rate } => writer.arc(to, center, ccw, rate)?,
        }
        writer.exact = Some(m.to());
    }
    writer.footer()?;
    writer.out.stats.bytes = writer.out.text.len();
    Ok(writer.out)
}

/// The state of the controller and the text so far.
struct Writer<'a> {
    setup: &'a Setup,
    grid: Grid,
    out: Written,
    /// Where the tool is, before rounding.
    exact: Option<Point3>,
    xy: Option<[i64; 2]>,
    z: Option<i64>,
    rate: Option<String>,
}

impl<'a> Writer<'a> {
    fn new(setup: &'a Setup) -> Writer<'a> {
        let grid = Grid::new(setup.decimals);
        Writer { setup, grid, out: Written::default(), exact: None, xy: None, z: None, rate: None }
    }

    fn header(&mut self) -> Result<(), Error> {
        let setup = self.setup;
        for line in setup.comments.iter().flat_map(|c| comment::lines(c)) {
            self.line(&line)?;
        }
        self.line(if setup.units == Units::Mm { "G21" } else { "G20" })?;
        for word in ["G90", "G17", "G94"] {
            self.line(word)?;
        }
        self.line(&format!("G{}", setup.wcs))?;
        self.line(&format!("T{}", setup.tool_number))?;
        self.line(&format!("S{:.0} M3", setup.spindle))?;
        if setup.dwell > 0.0 {
            self.line(&format!("G4 P{}", short(setup.dwell)))?;
        }
        match setup.coolant {
            Coolant::Off => {}
            Coolant::Mist => self.line("M7")?,
            Coolant::Flood => self.line("M8")?,
        }
        self.rapid_z(self.grid.round("clearance", setup.top + setup.clearance)?)
    }

    fn footer(&mut self) -> Result<(), Error> {
        let clear = self.grid.round("clearance", self.setup.top + self.setup.clearance)?;
        if self.z.is_some_and(|z| z < clear) {
            self.rapid_z(clear)?;
        }
        self.line("M5")?;
        if self.setup.coolant != Coolant::Off {
            self.line("M9")?;
        }
        self.line("M30")
    }

    /// A rapid that changes height and place goes up first, or down last: controllers differ in
    /// the way they take between two places.
    fn rapid(&mut self, to: Point3) -> Result<(), Error> {
        let (xy, z) = (self.grid.round_point(to.xy())?, self.grid.round("z", to.z)?);
        if self.z.is_none_or(|now| z > now) {
            self.rapid_z(z)?;
        }
        let words = self.plane_words(xy);
        if !words.is_empty() {
            self.line(&format!("G0{words}"))?;
            self.out.stats.rapids += 1;
            self.xy = Some(xy);
        }
        self.rapid_z(z)
    }

    fn rapid_z(&mut self, z: i64) -> Result<(), Error> {
        let word = self.z_word(z);
        if word.is_empty() {
            return Ok(());
        }
        self.z = Some(z);
        self.out.stats.rapids += 1;
        self.line(&format!("G0{word}"))
    }

    fn feed(&mut self, to: Point3, rate: f64) -> Result<(), Error> {
        if self.exact.is_none() {
            return Err(begins_with_feed(to));
        }
        let (xy, z) = (self.grid.round_point(to.xy())?, self.grid.round("z", to.z)?);
        self.straight(xy, z, rate)
    }

    /// A straight feed between rounded places.
    fn straight(&mut self, xy: [i64; 2], z: i64, rate: f64) -> Result<(), Error> {
        let words = self.plane_words(xy) + &self.z_word(z);
        if words.is_empty() {
            self.out.stats.dropped_lines += 1;
            return Ok(());
        }
        (self.xy, self.z) = (Some(xy), Some(z));
        self.out.stats.lines += 1;
        self.cut(&format!("G1{words}"), rate)
    }

    fn arc(&mut self, to: Point3, center: Point, ccw: bool, rate: f64) -> Result<(), Error> {
        let (Some(from), Some(_)) = (self.exact, self.xy) else { return Err(begins_with_feed(to)) };
        // Everything must be a number that can be written before it is divided.
        self.grid.round_point(to.xy())?;
        self.grid.round("z", to.z)?;
        let drawn = drawn_arc(from.xy(), to.xy(), center, ccw);
        let mut parts = vec![(drawn, from.z, to.z)];
        while let Some((part, z0, z1)) = parts.pop() {
            let (start, end) = (self.xy.unwrap_or_default(), self.grid.round_point(part.end)?);
            let fit = self.fit(&part, start, end);
            let z = self.grid.round("z", z1)?;
            match fit {
                Fit::Nothing => self.vanished(z, part == drawn, &part, rate)?,
                Fit::Line => self.straight(end, z, rate)?,
                Fit::Center([i, j]) => {
                    let center = format!(" I{} J{}", self.grid.text(i), self.grid.text(j));
                    self.curved(part.bulge > 0.0, end, z, &center, rate)?;
                }
                Fit::Radius(r) => {
                    self.curved(part.bulge > 0.0, end, z, &format!(" R{}", self.grid.text(r)), rate)?;
                }
                Fit::Halves => {
                    let (a, b) = part.split(0.5);
                    let middle = 0.5 * (z0 + z1);
                    parts.push((b, middle, z1));
                    parts.push((a, z0, middle));
                }
            }
        }
        Ok(())
    }

    /// How an arc between two rounded ends is written.
    fn fit(&self, part: &Element, start: [i64; 2], end: [i64; 2]) -> Fit {
        match self.setup.arcs {
            ArcWords::Ijk => with_center(part, start, end, self.grid.steps(self.setup.radius_error())),
            ArcWords::R => with_radius(part, start, end),
            ArcWords::Off => self.flat(part, start, end),
        }
    }

    /// A line where the chord is near enough, else halves.
    fn flat(&self, part: &Element, start: [i64; 2], end: [i64; 2]) -> Fit {
        let sagitta = 0.5 * part.bulge.abs() * part.chord().length();
        let unwritten = 0.5 * self.grid.step();
        match (start == end, sagitta <= self.setup.tolerance.max(unwritten)) {
            (_, false) => Fit::Halves,
            (true, true) => Fit::Nothing,
            (false, true) => Fit::Line,
        }
    }

    /// An arc, or a part of one, whose rounded ends coincide; a helix still changes its height.
    fn vanished(&mut self, z: i64, is_whole: bool, arc: &Element, rate: f64) -> Result<(), Error> {
        if self.z != Some(z) {
            return self.straight(self.xy.unwrap_or_default(), z, rate);
        }
        if is_whole {
            self.out.stats.dropped_arcs += 1;
            self.out.stats.dropped_arc_at.get_or_insert(arc.end);
        }
        Ok(())
    }

    /// An arc: X and Y are always written.
    fn curved(&mut self, ccw: bool, xy: [i64; 2], z: i64, center: &str, rate: f64) -> Result<(), Error> {
        let g = if ccw { "G3" } else { "G2" };
        let (x, y) = (self.grid.text(xy[0]), self.grid.text(xy[1]));
        let words = format!("{g} X{x} Y{y}{}{center}", self.z_word(z));
        (self.xy, self.z) = (Some(xy), Some(z));
        self.out.stats.arcs += 1;
        self.cut(&words, rate)
    }

    /// A motion with its feed rate where that changes.
    fn cut(&mut self, words: &str, rate: f64) -> Result<(), Error> {
        let text = short(rate);
        if !(rate > 0.0 && rate.is_finite()) || text == "0" {
            return Err(Error::Parameter { name: "feed", value: rate, range: "at least 0.001 per minute" });
        }
        if self.rate.as_ref() == Some(&text) {
            return self.line(words);
        }
        let whole = format!("{words} F{text}");
        if whole.len() + self.number().len() > MAX_LINE {
            self.line(&format!("F{text}"))?;
            self.line(words)?;
        } else {
            self.line(&whole)?;
        }
        self.rate = Some(text);
        Ok(())
    }

    /// X and Y where they differ from where the tool is.
    fn plane_words(&self, xy: [i64; 2]) -> String {
        let mut words = String::new();
        for (axis, letter) in [" X", " Y"].into_iter().enumerate() {
            if self.xy.is_none_or(|now| now[axis] != xy[axis]) {
                words += letter;
                words += &self.grid.text(xy[axis]);
            }
        }
        words
    }

    fn z_word(&self, z: i64) -> String {
        if self.z == Some(z) { String::new() } else { format!(" Z{}", self.grid.text(z)) }
    }

    /// The number of the next line, where lines have one.
    fn number(&self) -> String {
        if !self.setup.line_numbers {
            return String::new();
        }
        let n = self.out.stats.text_lines * NUMBER_STEP % LAST_NUMBER + NUMBER_STEP;
        format!("N{n} ")
    }

    fn line(&mut self, words: &str) -> Result<(), Error> {
        if self.out.stats.text_lines >= MAX_LINES {
            let needed = MAX_LINES as u64 + 1;
            return Err(Error::Effort { what: "the program", needed, limit: MAX_LINES as u64 });
        }
        let number = if words.starts_with('(') { String::new() } else { self.number() };
        let text = &mut self.out.text;
        text.push_str(&number);
        if number.len() + words.len() > MAX_LINE && !words.starts_with('(') {
            text.extend(words.chars().filter(|c| *c != ' '));
        } else {
            text.push_str(words);
        }
        text.push('\n');
        self.out.stats.text_lines += 1;
        Ok(())
    }
}

/// The arc of a move as chord and bulge.
fn drawn_arc(from: Point, to: Point, center: Point, ccw: bool) -> Element {
    let turn = (from - center).angle_to(to - center);
    let sweep = if ccw { turn.rem_euclid(2.0 * PI) } else { -(-turn).rem_euclid(2.0 * PI) };
    // An arc is at most half a circle: what seems nearly a full one is a tiny one that round-off
    // turned over.
    let sweep = if sweep.abs() > 1.5 * PI || !sweep.is_finite() { 0.0 } else { sweep };
    Element::arc(from, to, (0.25 * sweep).tan())
}

/// There is no place in the plane where a feed could begin.
fn begins_with_feed(to: Point3) -> Error {
    Error::Internal { what: "a program begins with a feed".into(), at: to.xy() }
}

#[cfg(test)]
#[path = "write_tests.rs"]
mod tests;
