//! The files to write: their forms, known before any work, and all of them staged before the first
//! is replaced.

use crate::args::{Args, ReportArg};
use crate::failure::Failure;
use crate::plan::Plan;
use medial::Error;
use medial::io::atomic::{self, Draft};
use medial::io::gcode::{self, Setup, Stats};
use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The form of an output file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Gcode,
    Dxf,
    Svg,
    Json,
}

/// The outputs asked for.
#[derive(Debug, Default)]
pub struct Outputs {
    files: Vec<(PathBuf, Form)>,
    standard_output: bool,
}

impl Form {
    fn of(path: &Path) -> Result<Form, Failure> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
        match extension.as_str() {
            "nc" | "ngc" | "gcode" | "tap" | "cnc" => Ok(Form::Gcode),
            "dxf" => Ok(Form::Dxf),
            "svg" => Ok(Form::Svg),
            "json" => Ok(Form::Json),
            _ => Err(Failure::usage(
                format!("the form of {} is not known", path.display()),
                "end its name in .nc .ngc .gcode .tap .cnc (G-code), .dxf (drawing), .svg (picture) or .json (document)",
            )),
        }
    }
}

impl Outputs {
    /// Reads the forms off the names.
    pub fn new(args: &Args) -> Result<Outputs, Failure> {
        let mut outputs = Outputs::default();
        let mut seen = BTreeSet::new();
        for path in &args.outputs {
            if !seen.insert(path) {
                return Err(Failure::usage(
                    format!("{} is to be written twice", path.display()),
                    "give each -o its own name",
                ));
            }
            if path == Path::new("-") {
                outputs.standard_output = true;
            } else {
                outputs.files.push((path.clone(), Form::of(path)?));
            }
        }
        outputs.check(args)?;
        Ok(outputs)
    }

    fn check(&self, args: &Args) -> Result<(), Failure> {
        if self.standard_output && args.report == ReportArg::Json {
            return Err(Failure::usage(
                "-o - and --report json both want standard output",
                "write the program to a file: -o part.nc",
            ));
        }
        let no_tool = args.tool.is_some_and(|l| l.to(medial::Units::Mm) == 0.0);
        if no_tool && self.has_program() {
            return Err(Failure::usage(
                "--tool 0 asks for level sets alone, a program needs a tool",
                "give the diameter of the tool, or write -o part.json, -o part.dxf or -o part.svg",
            ));
        }
        if let Some((path, _)) = self.files.iter().find(|(p, _)| same_file(p, &args.drawing)) {
            return Err(Failure::usage(
                format!("{} is the drawing itself", path.display()),
                "give the output another name",
            ));
        }
        Ok(())
    }

    /// Whether nothing is asked for but programs, so that nobody will know of what the tool does not reach.
    pub fn is_program_alone(&self, args: &Args) -> bool {
        let is_told = !args.quiet || args.report == ReportArg::Json || args.strict || args.verify;
        !is_told && self.has_program() && self.files.iter().all(|(_, form)| *form == Form::Gcode)
    }

    fn has_program(&self) -> bool {
        self.standard_output || self.files.iter().any(|(_, form)| *form == Form::Gcode)
    }

    /// Writes everything, or nothing. Answers what the program holds, if there is one.
    pub fn write(&self, plan: &Plan, setup: &Setup) -> Result<Option<Stats>, Failure> {
        let moves = &plan.path.moves;
        let program = if self.standard_output { Some(gcode::write(moves, setup)?) } else { None };
        let mut stats = program.as_ref().map(|p| p.stats.clone());
        let mut drafts = Vec::with_capacity(self.files.len());
        for (path, form) in &self.files {
            let mut draft = Draft::new(path)?;
            match (form, &program) {
                (Form::Gcode, Some(known)) => draft.write(known.text.as_bytes())?,
                (Form::Gcode, None) => stats = Some(gcode::write_to(moves, setup, |part| draft.write(part))?),
                (Form::Dxf, _) => draft.write(&plan.drawing().map_err(|cause| cannot_write(path, cause))?)?,
                (Form::Svg, _) => draft.write(plan.picture().as_bytes())?,
                (Form::Json, _) => draft.write(plan.document().to_json().as_bytes())?,
            }
            draft.finish()?;
            drafts.push(draft);
        }
        atomic::put_in_place(drafts)?;
        if let Some(program) = program {
            print_out(&program.text)?;
        }
        Ok(stats)
    }
}

/// Writes to standard output; a reader that went away is no fault.
pub fn print_out(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::standard_output(&e)),
        _ => Ok(()),
    }
}

pub fn cannot_write(path: &Path, cause: std::io::Error) -> Error {
    Error::File { action: "write", path: path.display().to_string(), cause }
}

pub fn same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a == b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    fn outputs(more: &[&str]) -> Result<Outputs, Failure> {
        let args = ["pocket", "a.dxf", "--step", "0.5"].iter().chain(more);
        Outputs::new(&Args::try_parse_from(args).unwrap())
    }

    #[test]
    fn the_extension_chooses_the_form() {
        for name in ["a.nc", "a.NGC", "b/a.gcode", "a.tap", "a.x.cnc"] {
            assert_eq!(outputs(&["-o", name]).unwrap().files[0].1, Form::Gcode);
        }
        assert_eq!(outputs(&["-o", "a.svg", "-o", "a.json"]).unwrap().files[1].1, Form::Json);
        assert_eq!(outputs(&["-o", "b.DXF"]).unwrap().files[0].1, Form::Dxf);
    }

    #[test]
    fn forms_that_are_not_known_are_refused() {
        for name in ["a", "a.txt", "nc", ".nc", "a.nc.bak"] {
            assert!(outputs(&["-o", name]).is_err(), "{name}");
        }
    }

    #[test]
    fn standard_output_holds_one_thing() {
        assert!(outputs(&["-o", "-"]).unwrap().standard_output);
        assert!(outputs(&["-o", "-", "--report", "json"]).is_err());
        assert!(outputs(&["-o", "a.nc", "-o", "a.nc"]).is_err());
        assert!(outputs(&["-o", "a.nc", "--tool", "0"]).is_err());
    }
}
