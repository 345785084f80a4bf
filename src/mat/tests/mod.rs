//! Tests that need the inside of the axis.

mod sabotage;
