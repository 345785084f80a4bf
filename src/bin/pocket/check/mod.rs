//! `pocket check`: offsets that any other program made, judged by exact distance.

mod args;
mod json;
mod offsets;
mod run;
mod text;
mod verdict;

pub use run::run;
