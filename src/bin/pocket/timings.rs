//! How long each stage takes.

use serde::Serialize;
use std::time::Instant;

/// Milliseconds of each stage and the amounts they are for.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Timings {
    pub read: f64,
    pub fit: f64,
    pub chain: f64,
    pub axis: f64,
    pub offsets: f64,
    pub path: f64,
    pub write: f64,
    pub sites: usize,
    pub vertices: usize,
    pub edges: usize,
    pub loops: usize,
}

/// Runs a stage and notes its time.
pub fn timed<T>(milliseconds: &mut f64, stage: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = stage();
    *milliseconds += start.elapsed().as_secs_f64() * 1e3;
    result
}

impl Timings {
    /// Notes apart what reading took to fit curves.
    pub fn take_fit(&mut self, fit: std::time::Duration) {
        self.fit = fit.as_secs_f64() * 1e3;
        self.read -= self.fit;
    }

    /// As lines of the text report.
    pub fn text(&self) -> String {
        let stages = [
            ("read", self.read),
            ("fit", self.fit),
            ("chain", self.chain),
            ("axis", self.axis),
            ("offsets", self.offsets),
            ("path", self.path),
            ("write", self.write),
        ];
        let times: Vec<String> = stages.iter().map(|(name, ms)| format!("{name} {ms:.1}")).collect();
        let per_site = if self.sites > 0 { 1e3 * self.axis / self.sites as f64 } else { 0.0 };
        format!(
            "timings (ms): {}\namounts: {} sites, {} axis vertices, {} axis edges, {} loops; axis {per_site:.2} us per site\n",
            times.join(", "),
            self.sites,
            self.vertices,
            self.edges,
            self.loops
        )
    }
}
