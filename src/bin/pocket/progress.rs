//! A sign of life on a terminal, after one second.

use indicatif::{ProgressBar, ProgressDrawTarget};
use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// How long a user waits without wondering.
const PATIENCE: Duration = Duration::from_secs(1);

/// Time between two pictures of the spinner.
const TICK: Duration = Duration::from_millis(100);

/// A spinner that names the stage; shown only on a terminal.
pub struct Progress {
    bar: ProgressBar,
    waiting: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Begins to wait.
    pub fn new(quiet: bool) -> Progress {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if quiet || !std::io::stderr().is_terminal() {
            return Progress { bar, waiting: None };
        }
        let (stop, stopped) = channel();
        let shown = bar.clone();
        let thread = std::thread::spawn(move || {
            if stopped.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(TICK);
            }
        });
        Progress { bar, waiting: Some((stop, thread)) }
    }

    /// Names the stage at hand.
    pub fn stage(&self, name: &'static str) {
        self.bar.set_message(name);
    }

    /// Leaves nothing on the screen, for what is printed next.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Drop for Progress {
    /// Leaves nothing on the screen.
    fn drop(&mut self) {
        if let Some((stop, thread)) = self.waiting.take() {
            // The thread may be done already; then nobody listens, and that is fine.
            let _ = stop.send(());
            let _ = thread.join();
        }
        self.clear();
    }
}
