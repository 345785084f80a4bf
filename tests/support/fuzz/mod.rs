//! Mutated drawings through the whole pipeline.
#![allow(dead_code)]

pub mod chance;
pub mod drawing;
pub mod mutate;
pub mod seeds;
pub mod shrink;
pub mod trial;
