//! `fastphong report --studies`: the experiments that it makes beside its scenes.

use super::CliError;
use super::engines::ThreadFlags;
use super::measured::TimingFlags;
use fastphong::compare::experiments::{Scaling, ScalingOptions, SpeedupOptions, Speedups};
use fastphong::number::suggest::unknown;

/// The experiments to make.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Experiments {
    speedups: bool,
    scaling: bool,
}

/// Reads experiments between commas, `all` or `none`.
pub fn experiments(text: &str) -> Result<Experiments, String> {
    const NAMES: [&str; 2] = ["speedups", "scaling"];
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
    /// Returns how many scenes take as long, about.
    pub fn scenes(self) -> f32 {
        3.0 * f32::from(self.speedups) + 6.0 * f32::from(self.scaling)
    }

    /// Makes them on one thread, with times of the length that scenes have; `progress` hears which part is done and what
    /// comes next, while no time is taken.
    ///
    /// # Errors
    /// When there is no thread, or no memory for a picture of that size.
    pub fn make(
        self,
        timing: &TimingFlags,
        progress: &(dyn Fn(f32, &str) + Sync),
    ) -> Result<(Option<Speedups>, Option<Scaling>), CliError> {
        let (methods, all) = (&timing.methods, self.scenes());
        let (mut speedups, mut scaling) = (SpeedupOptions::default(), ScalingOptions::default());
        speedups.limits.time_budget = timing.time_budget.saturating_mul(3);
        scaling.limits.time_budget = timing.time_budget / 8;
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
