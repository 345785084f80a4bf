//! `pocket inspect`: what a drawing holds, and every defect with its place and its cure.

mod args;
mod content;
mod contours;
mod finding;
mod inspection;
mod run;
mod text;

pub use run::run;
