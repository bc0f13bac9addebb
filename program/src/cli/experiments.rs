//! `fastphong report --studies`: runs the experiments of a report.

use super::CliError;
use super::engines::ThreadFlags;
use super::measured::TimingFlags;
use crate::compare::experiments::{Scaling, ScalingOptions, SpeedupOptions, Speedups};
use fastphong::number::suggest::unknown;

/// Which experiments to run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Experiments {
    speedups: bool,
    scaling: bool,
}

/// The names of all experiments.
pub const NAMES: [&str; 2] = ["speedups", "scaling"];

/// Reads experiments separated by commas, `all` or `none`.
pub fn experiments(text: &str) -> Result<Experiments, String> {
    let names = match text {
        "all" => NAMES.to_vec(),
        "none" => Vec::new(),
        names => names.split(',').map(str::trim).collect(),
    };
    let [speedups, scaling] = NAMES.map(|name| names.contains(&name));
    match names.iter().find(|name| !NAMES.contains(name)) {
        None => Ok(Experiments { speedups, scaling }),
        Some(name) => Err(unknown("study", name, NAMES)),
    }
}

impl Experiments {
    /// Returns their duration, in units of an average scene of the report.
    pub fn scenes(self) -> f32 {
        3.0 * f32::from(self.speedups) + 6.0 * f32::from(self.scaling)
    }

    /// Runs them on one thread, with time budgets derived from `--time-budget`. Calls `progress`
    /// with the part that is done and the name of the next step, never while a time is measured.
    ///
    /// # Errors
    /// If no thread can be started, or there is no memory for a picture of that size.
    pub fn make(
        self,
        timing: &TimingFlags,
        progress: &(dyn Fn(f32, &str) + Sync),
    ) -> Result<(Option<Speedups>, Option<Scaling>), CliError> {
        let (methods, all) = (&timing.methods, self.scenes());
        let (mut speedups, mut scaling) = (SpeedupOptions::default(), ScalingOptions::default());
        speedups.limits.time_budget = timing.time_budget.saturating_mul(2);
        scaling.limits.time_budget = timing.time_budget / 12;
        let speedups = || {
            let mut hear =
                |part, next: &str| progress(3.0 * part / all, &format!("speedups: {next}"));
            Speedups::measure(methods, &speedups, &mut hear)
        };
        let scaling = || {
            let part = |part| 1.0 - 6.0 / all * (1.0 - part);
            let mut hear = |done, next: &str| progress(part(done), &format!("scaling: {next}"));
            Scaling::measure(methods, &scaling, &mut hear)
        };
        ThreadFlags { threads: Some(1) }.install(|| {
            let speedups = self.speedups.then(speedups).transpose()?;
            let scaling = self.scaling.then(scaling).transpose()?;
            Ok((speedups, scaling))
        })?
    }
}
