//! The binary `pocket`: a drawing in, a program out.

mod args;
mod check;
mod exit;
mod failure;
mod inspect;
mod length;
mod notice;
mod outputs;
mod plan;
mod progress;
mod reading;
mod report;
mod second;
mod settings;
mod timings;
mod verdict;

use crate::args::{Args, ReportArg};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::notice::Notice;
use crate::outputs::{Outputs, print_out};
use crate::plan::Plan;
use crate::progress::Progress;
use crate::report::Report;
use crate::timings::{Timings, timed};
use crate::verdict::Verdict;
use clap::Parser;
use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    match run() {
        Ok(exit) => exit.into(),
        Err(failure) => {
            failure.print();
            failure.exit.into()
        }
    }
}

fn run() -> Result<Exit, Failure> {
    match std::env::args_os().nth(1).as_ref().and_then(|name| name.to_str()) {
        Some("inspect") => inspect::run(),
        Some("check") => check::run(),
        _ => machine(),
    }
}

/// The main job: a program for the pockets of a drawing.
fn machine() -> Result<Exit, Failure> {
    // Help and version end the program here.
    let args = Args::parse();
    let outputs = Outputs::new(&args)?;
    args.check()?;
    set_threads(&args)?;
    let mut timings = Timings::default();
    let progress = Progress::new(args.quiet);
    let mut plan = Plan::new(&args, &outputs, &progress, &mut timings)?;
    let setup = args.setup(&plan.job, &plan.source)?;
    progress.stage("judging");
    let verdict = args.verify.then(|| Verdict::of(&plan));
    progress.stage("writing");
    let written = timed(&mut timings.write, || outputs.write(&plan, &setup))?;
    if let Some((stats, at)) = written.and_then(|s| s.dropped_arc_at.map(|at| (s.dropped_arcs, at))) {
        plan.notices.push(Notice::arcs_dropped(stats, at));
    }
    drop(progress);
    let report = Report::new(&plan, verdict.as_ref(), args.timings.then_some(timings));
    tell(&args, &plan, &report)?;
    let exit = exit(&args, &plan, verdict.as_ref());
    // The system takes back millions of moves at once.
    std::mem::forget(plan);
    Ok(exit)
}

fn set_threads(args: &Args) -> Result<(), Failure> {
    let Some(jobs) = args.jobs else { return Ok(()) };
    rayon::ThreadPoolBuilder::new().num_threads(jobs.into()).build_global().map_err(|e| {
        let message = format!("cannot start {jobs} threads: {e}");
        Failure { exit: Exit::Cannot, message, at: None, help: Some("take fewer: --jobs 1".into()) }
    })
}

/// Warnings to standard error, the report to where it belongs.
fn tell(args: &Args, plan: &Plan, report: &Report) -> Result<(), Failure> {
    if !args.quiet {
        Notice::print_all(&plan.notices);
    }
    match args.report {
        ReportArg::Json => print_out(&report.json()),
        ReportArg::Text if args.quiet => Ok(()),
        ReportArg::Text => {
            // Nobody is left to tell when standard error is gone.
            let _ = std::io::stderr().lock().write_all(report.text().as_bytes());
            Ok(())
        }
    }
}

fn exit(args: &Args, plan: &Plan, verdict: Option<&Verdict>) -> Exit {
    let refused = verdict.is_some_and(|v| !v.is_right());
    let left_out = args.strict && plan.notices.iter().any(|n| n.leaves_out);
    if refused || left_out { Exit::Refused } else { Exit::Done }
}
