//! The binary `pocket`.

fn main() {}
