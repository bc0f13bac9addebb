//! A progress bar, on a terminal and for work that takes longer than a second.

use super::Log;
use super::log::is_dumb;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::thread;
use std::time::Duration;

/// The time for which nothing is shown.
const PATIENCE: Duration = Duration::from_secs(1);
/// The steps of the bar.
const STEPS: u64 = 1000;

/// A progress bar that is gone when this is dropped.
pub struct Progress {
    bar: ProgressBar,
    allowed: bool,
}

impl Progress {
    /// Makes a bar that is shown when work takes long, also if it is not moved until then.
    pub fn watched(log: Log) -> Progress {
        let progress = Progress::silent_between_moves(log);
        if progress.allowed {
            let bar = progress.bar.clone();
            thread::spawn(move || {
                thread::sleep(PATIENCE);
                if !bar.is_finished() {
                    bar.set_draw_target(ProgressDrawTarget::stderr());
                    bar.enable_steady_tick(Duration::from_millis(100));
                }
            });
        }
        progress
    }

    /// Makes a bar that is drawn only when it is moved: it disturbs no measurement between two moves.
    pub fn silent_between_moves(log: Log) -> Progress {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::hidden());
        let style =
            ProgressStyle::with_template("{spinner} [{bar:30}] {elapsed}, {eta} left: {msg}");
        bar.set_style(style.expect("a template").progress_chars("=> "));
        let allowed = log != Log::Quiet && std::io::stderr().is_terminal() && !is_dumb();
        Progress { bar, allowed }
    }

    /// Moves the bar to `share` (0 to 1) of the work, of which `stage` comes next.
    pub fn at(&self, share: f32, stage: &str) {
        if self.allowed && self.bar.is_hidden() && self.bar.elapsed() > PATIENCE {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        let position = share.clamp(0.0, 1.0) * STEPS as f32;
        self.bar.set_position(position as u64);
        self.bar.set_message(stage.to_owned());
    }

    /// Runs `work`, which may print, with the bar out of its way.
    pub fn aside<T>(&self, work: impl FnOnce() -> T) -> T {
        let (mut work, mut result) = (Some(work), None);
        // One type of closure: the library compiles half a thousand instructions for each.
        let once: &mut dyn FnMut() = &mut || result = work.take().map(|work| work());
        self.bar.suspend(once);
        result.expect("suspend runs it once")
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
