//! `fastphong report --studies`: the experiments that it makes beside its scenes.

use super::CliError;
use super::engines::ThreadFlags;
use super::measured::TimingFlags;
use fastphong::compare::experiments::{
    ExperimentError, Scaling, ScalingOptions, SpeedupOptions, Speedups,
};
use fastphong::compare::timing::TimeLimits;
use fastphong::number::suggest::nearest;

/// The experiments to make.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Experiments {
    speedups: bool,
    scaling: bool,
}

/// Reads experiments between commas, `all` or `none`.
pub fn experiments(text: &str) -> Result<Experiments, String> {
    let mut experiments = Experiments::default();
    for name in text.split(',').map(str::trim) {
        match name {
            "speedups" => experiments.speedups = true,
            "scaling" => experiments.scaling = true,
            "all" if text == "all" => return Ok(Experiments::ALL),
            "none" if text == "none" => {}
            _ => {
                let expected = match nearest(name, ["speedups", "scaling"]) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => "expected `speedups` or `scaling`".to_owned(),
                };
                return Err(format!("unknown study `{name}`: {expected}"));
            }
        }
    }
    Ok(experiments)
}

impl Experiments {
    /// Both.
    pub const ALL: Experiments = Experiments {
        speedups: true,
        scaling: true,
    };

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
        let (methods, all) = (&timing.methods.0, self.scenes());
        let speedups = || {
            let defaults = SpeedupOptions::default();
            let limits = TimeLimits {
                time_budget: timing.time_budget.saturating_mul(3),
                ..defaults.limits
            };
            Speedups::measure(
                methods,
                &SpeedupOptions { limits, ..defaults },
                &mut |part, next| progress(3.0 * part / all, &format!("speedups: {next}")),
            )
        };
        let scaling = || {
            let defaults = ScalingOptions::default();
            let limits = TimeLimits {
                time_budget: timing.time_budget / 8,
                ..defaults.limits
            };
            Scaling::measure(
                methods,
                &ScalingOptions { limits, ..defaults },
                &mut |part, next| {
                    progress(1.0 - 6.0 / all * (1.0 - part), &format!("scaling: {next}"))
                },
            )
        };
        let made = ThreadFlags { threads: Some(1) }.install(|| {
            let speedups = self.speedups.then(speedups).transpose()?;
            let scaling = self.scaling.then(scaling).transpose()?;
            Ok::<_, ExperimentError>((speedups, scaling))
        })?;
        made.map_err(|error| error.to_string().into())
    }
}
