//! The words of a program.

use super::arc::{Fit, surely_straight, with_center, with_radius};
use super::comment::{self, MAX_LINE};
use super::line::Line;
use super::number::{Grid, short};
use super::parts::{USUAL_PART, in_parts};
use super::program::{Part, Stats, Written};
use super::setup::{ArcWords, Coolant, Setup};
use crate::error::Error;
use crate::geom::{Element, Point};
use crate::tolerance::Units;
use crate::toolpath::{Move, Moves, Point3};
use std::f64::consts::PI;

/// Line numbers go up by this and begin again after `LAST_NUMBER`.
const NUMBER_STEP: usize = 10;

/// LinuxCNC and Fanuc read five digits.
const LAST_NUMBER: usize = 99_990;

/// About how many bytes a line takes.
const USUAL_LINE: usize = 24;

/// Writes a program.
///
/// # Errors
/// When a setting or a coordinate is out of its range, when a feed comes before the first rapid to
/// a place in the plane, or when the program would be too long.
pub fn write(moves: &Moves, setup: &Setup) -> Result<Written, Error> {
    let mut text = Vec::with_capacity(moves.len() * USUAL_LINE);
    let stats = write_to(moves, setup, |part| {
        text.extend_from_slice(part);
        Ok(())
    })?;
    Ok(Written { text: String::from_utf8(text).expect("all words are ASCII"), stats })
}

/// Writes a program stretch by stretch: each is handed over in its turn while the next ones are made.
/// What was handed over before an error is no program.
///
/// # Errors
/// As for [`write()`], and those of `put`.
pub fn write_to(
    moves: &Moves,
    setup: &Setup,
    put: impl FnMut(&[u8]) -> Result<(), Error> + Send,
) -> Result<Stats, Error> {
    setup.check()?;
    // Numbered lines depend on all before them.
    let least = if setup.line_numbers { usize::MAX } else { USUAL_PART };
    in_parts(moves, setup, least, put)
}

/// The state of the controller and the text so far.
pub(super) struct Writer<'a> {
    setup: &'a Setup,
    grid: Grid,
    pub out: Part,
    /// Where the tool is, before rounding.
    exact: Option<Point3>,
    xy: Option<[i64; 2]>,
    z: Option<i64>,
    rate: Option<(f64, String)>,
    /// The line at hand.
    words: Line,
}

impl<'a> Writer<'a> {
    pub fn new(setup: &'a Setup, out: Part) -> Writer<'a> {
        let grid = Grid::new(setup.decimals);
        let (exact, xy, z, rate) = (None, None, None, None);
        Writer { setup, grid, out, exact, xy, z, rate, words: Line::new() }
    }

    /// The writer of the moves from one on, before which a move cuts.
    pub fn resumed(setup: &'a Setup, out: Part, moves: &Moves, begin: usize) -> Result<Writer<'a>, Error> {
        let mut writer = Writer::new(setup, out);
        let Some(last) = begin.checked_sub(1).and_then(|last| moves.get(last)) else { return Ok(writer) };
        let at = last.to();
        writer.exact = Some(at);
        writer.xy = Some(writer.grid.round_point(at.xy())?);
        writer.z = Some(writer.grid.round("z", at.z)?);
        writer.rate = last.rate().map(|rate| (rate, short(rate)));
        Ok(writer)
    }

    pub fn moves(&mut self, mut moves: impl Iterator<Item = Move>) -> Result<(), Error> {
        moves.try_for_each(|m| {
            match m {
                Move::Rapid { to } => self.rapid(to)?,
                Move::Feed { to, rate } => self.feed(to, rate)?,
                Move::Arc { to, center, ccw, rate } => self.arc(to, center, ccw, rate)?,
            }
            self.exact = Some(m.to());
            Ok(())
        })
    }

    pub fn header(&mut self) -> Result<(), Error> {
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

    pub fn footer(&mut self) -> Result<(), Error> {
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
        if self.xy != Some(xy) {
            self.words.begin("G0");
            self.plane_words(xy);
            self.end()?;
            self.out.stats.rapids += 1;
            self.xy = Some(xy);
        }
        self.rapid_z(z)
    }

    fn rapid_z(&mut self, z: i64) -> Result<(), Error> {
        if self.z == Some(z) {
            return Ok(());
        }
        self.words.begin("G0");
        self.z_word(z);
        self.z = Some(z);
        self.out.stats.rapids += 1;
        self.end()
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
        if (self.xy, self.z) == (Some(xy), Some(z)) {
            self.out.stats.dropped_lines += 1;
            return Ok(());
        }
        self.words.begin("G1");
        self.plane_words(xy);
        self.z_word(z);
        (self.xy, self.z) = (Some(xy), Some(z));
        self.out.stats.lines += 1;
        self.cut(rate)
    }

    fn arc(&mut self, to: Point3, center: Point, ccw: bool, rate: f64) -> Result<(), Error> {
        let (Some(from), Some(start)) = (self.exact, self.xy) else { return Err(begins_with_feed(to)) };
        // Everything must be a number that can be written before it is divided.
        let (end, z) = (self.grid.round_point(to.xy())?, self.grid.round("z", to.z)?);
        let spokes = [from.xy() - center, to.xy() - center];
        if self.setup.arcs != ArcWords::Off && surely_straight(spokes, start, end) {
            return if start == end { self.vanished(z, true, to, rate) } else { self.straight(end, z, rate) };
        }
        let drawn = drawn_arc(from.xy(), to.xy(), center, ccw);
        let (mut next, mut parts) = (Some((drawn, from.z, to.z)), Vec::new());
        while let Some((part, z0, z1)) = next.or_else(|| parts.pop()) {
            next = None;
            let (start, end) = (self.xy.unwrap_or_default(), self.grid.round_point(part.end)?);
            let fit = self.fit(&part, start, end);
            let z = self.grid.round("z", z1)?;
            match fit {
                Fit::Nothing => self.vanished(z, part == drawn, to, rate)?,
                Fit::Line => self.straight(end, z, rate)?,
                Fit::Center([i, j]) => {
                    self.curved(part.bulge > 0.0, end, z, &[(b'I', i), (b'J', j)], rate)?;
                }
                Fit::Radius(r) => self.curved(part.bulge > 0.0, end, z, &[(b'R', r)], rate)?,
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
    fn vanished(&mut self, z: i64, is_whole: bool, to: Point3, rate: f64) -> Result<(), Error> {
        if self.z != Some(z) {
            return self.straight(self.xy.unwrap_or_default(), z, rate);
        }
        if is_whole {
            self.out.stats.dropped_arcs += 1;
            self.out.stats.dropped_arc_at.get_or_insert(to.xy());
        }
        Ok(())
    }

    /// An arc: X and Y are always written.
    fn curved(
        &mut self,
        ccw: bool,
        xy: [i64; 2],
        z: i64,
        center: &[(u8, i64)],
        rate: f64,
    ) -> Result<(), Error> {
        self.words.begin(if ccw { "G3" } else { "G2" });
        self.word(b'X', xy[0]);
        self.word(b'Y', xy[1]);
        self.z_word(z);
        center.iter().for_each(|&(letter, steps)| self.word(letter, steps));
        (self.xy, self.z) = (Some(xy), Some(z));
        self.out.stats.arcs += 1;
        self.cut(rate)
    }

    /// A motion with its feed rate where that changes.
    fn cut(&mut self, rate: f64) -> Result<(), Error> {
        if self.rate.as_ref().is_some_and(|(known, _)| *known == rate) {
            return self.end();
        }
        let text = short(rate);
        if !(rate > 0.0 && rate.is_finite()) || text == "0" {
            return Err(Error::Parameter { name: "feed", value: rate, range: "at least 0.001 per minute" });
        }
        if self.rate.as_ref().is_some_and(|(_, known)| *known == text) {
            return self.end();
        }
        let whole = [self.words.text(), b" F", text.as_bytes()].concat();
        if whole.len() + self.number().len() > MAX_LINE {
            self.line(&format!("F{text}"))?;
            self.end()?;
        } else {
            self.out.line(&self.number(), &whole)?;
        }
        self.rate = Some((rate, text));
        Ok(())
    }

    fn word(&mut self, letter: u8, steps: i64) {
        self.words.word(letter, steps, self.setup.decimals);
    }

    /// X and Y where they differ from where the tool is.
    fn plane_words(&mut self, xy: [i64; 2]) {
        for (axis, letter) in [b'X', b'Y'].into_iter().enumerate() {
            if self.xy.is_none_or(|now| now[axis] != xy[axis]) {
                self.word(letter, xy[axis]);
            }
        }
    }

    fn z_word(&mut self, z: i64) {
        if self.z != Some(z) {
            self.word(b'Z', z);
        }
    }

    /// The number of the next line, where lines have one.
    fn number(&self) -> String {
        if !self.setup.line_numbers {
            return String::new();
        }
        let n = self.out.stats.text_lines * NUMBER_STEP % LAST_NUMBER + NUMBER_STEP;
        format!("N{n} ")
    }

    /// Writes the line at hand.
    fn end(&mut self) -> Result<(), Error> {
        self.out.line(&self.number(), self.words.text())
    }

    /// Writes a line of its own.
    fn line(&mut self, words: &str) -> Result<(), Error> {
        self.out.line(&self.number(), words.as_bytes())
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
