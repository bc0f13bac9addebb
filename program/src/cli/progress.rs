//! Shows the progress of long work: a bar on a terminal, a line now and then elsewhere.

use super::Log;
use super::log::{is_dumb, to_stderr};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How long nothing is shown.
const PATIENCE: Duration = Duration::from_secs(1);
/// The time before the first line and between lines if there is no terminal. Short work stays
/// silent, because its output is often kept as a log.
const BETWEEN_LINES: Duration = Duration::from_secs(10);
/// How many steps the bar has.
const STEPS: u64 = 1000;

/// A progress bar, which disappears when this is dropped.
pub struct Progress {
    bar: ProgressBar,
    allowed: bool,
    /// The time of the last line, or of the start; `None` on a terminal and with `--quiet`.
    last_line: Option<Mutex<Instant>>,
}

impl Progress {
    /// Makes a bar that appears after a second, even if it has not been moved.
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

    /// Makes a bar that is drawn only when it is moved, so that it does not disturb a measurement.
    pub fn silent_between_moves(log: Log) -> Progress {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::hidden());
        let style =
            ProgressStyle::with_template("{spinner} [{bar:30}] {elapsed}, {eta} left: {msg}");
        bar.set_style(style.expect("a template").progress_chars("=> "));
        let is_terminal = std::io::stderr().is_terminal() && !is_dumb();
        let is_told = log != Log::Quiet;
        Progress {
            bar,
            allowed: is_told && is_terminal,
            last_line: (is_told && !is_terminal).then(|| Mutex::new(Instant::now())),
        }
    }

    /// Moves the bar to `share` of the work, 0 to 1. `stage` is the name of the next step.
    pub fn at(&self, share: f32, stage: &str) {
        if self.allowed && self.bar.is_hidden() && self.bar.elapsed() > PATIENCE {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        if let Some(last) = &self.last_line {
            let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
            if last.elapsed() >= BETWEEN_LINES {
                *last = Instant::now();
                to_stderr(&format!(
                    "{:.0} %: {stage}\n",
                    100.0 * share.clamp(0.0, 1.0)
                ));
            }
        }
        let position = share.clamp(0.0, 1.0) * STEPS as f32;
        self.bar.set_position(position as u64);
        self.bar.set_message(stage.to_owned());
    }

    /// Runs `work` with the bar hidden, so that it can print.
    pub fn aside<T>(&self, work: impl FnOnce() -> T) -> T {
        let (mut work, mut result) = (Some(work), None);
        // `suspend` is generic. Passing one type of closure compiles it once instead of once per
        // caller.
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
