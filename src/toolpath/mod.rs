//! From level sets to the moves of a tool.
#![doc = ""]
#![doc = include_str!("../../docs/path.svg")]
#![doc = ""]
//! *The path of a tool of 5 mm from the inside out, round an island.*
//!
//! **Needs** the medial axes of the pockets and a [`Job`]: a tool and what it shall do.
//! **Guarantees** that the tool stays in the pocket, that all it can reach is cut at every height,
//! and that rapids never meet stock. Pockets follow one another by short ways (`route`).
//!
//! **Method.** Levels lie at tool radius + stock and on from there in equal steps, until nothing is
//! left. Loops of neighboring levels are paired (`nest`) and cut in chains, from the inside out or
//! from the wall inward, at every height. Neighbors are joined by straight links at depth, others by
//! links along the axis (`detour`) over what is cut already, where that takes less time than going
//! up, across, and down into a neighbor (`approach`); what has no neighbor that is cut is entered by
//! a helix or a ramp into the stock (`entry`). What stands between levels more than the tool radius
//! apart is cut along the axis (`crest`, `trim`), when the tool comes by for the last time (`run`).
//! Finishing passes are met and left on arcs (`lead`). How wide is cut is known from the axis (`width`),
//! and where it is more than the step the feed may be less (`pace`). What is cut alike at every height is held
//! once (`stretch`).

mod amounts;
mod approach;
mod ascent;
mod course;
mod crest;
mod cutter;
mod detour;
mod entry;
mod flow;
mod foot;
mod indexed;
mod job;
mod lead;
mod link;
mod moves;
mod nest;
mod pace;
mod path;
mod plan;
mod ready;
mod rest;
mod roads;
mod route;
mod run;
mod stretch;
mod tally;
#[cfg(test)]
mod tests;
mod time;
mod tour;
mod trim;
mod warning;
mod width;

pub use amounts::Amounts;
pub use cutter::Totals;
pub use job::{Direction, Entry, Job, Order, Start, Strategy};
pub use moves::{Move, Point3};
pub use path::{Path, PocketPath};
pub use rest::Rest;
pub use stretch::Moves;
pub use warning::Warning;
