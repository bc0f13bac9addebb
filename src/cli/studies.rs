//! What `fastphong report` measures beside its scenes.

use super::Failure;
use super::engines::ThreadFlags;
use super::measured::TimingFlags;
use fastphong::compare::experiments::{
    Scaling, ScalingOptions, SpeedupOptions, Speedups, StudyError,
};
use fastphong::compare::timing::Limits;
use fastphong::number::suggest::nearest;

/// The studies to make.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Chosen {
    speedups: bool,
    scaling: bool,
}

/// Studies between commas, `all` or `none`.
pub fn studies(text: &str) -> Result<Chosen, String> {
    const NAMES: [&str; 2] = ["speedups", "scaling"];
    let mut chosen = Chosen::default();
    match text {
        "all" => return Ok(Chosen::ALL),
        "none" => return Ok(chosen),
        _ => {}
    }
    for name in text.split(',').map(str::trim) {
        match name {
            "speedups" => chosen.speedups = true,
            "scaling" => chosen.scaling = true,
            _ => {
                return Err(match nearest(name, NAMES) {
                    Some(near) => format!("unknown study `{name}`: did you mean `{near}`?"),
                    None => format!("unknown study `{name}`: expected `speedups` or `scaling`"),
                });
            }
        }
    }
    Ok(chosen)
}

impl Chosen {
    /// Both.
    pub const ALL: Chosen = Chosen {
        speedups: true,
        scaling: true,
    };

    /// About how long they take, in scenes.
    pub fn scenes(self) -> f32 {
        [(self.speedups, 3.0), (self.scaling, 6.0)]
            .iter()
            .filter(|(is, _)| *is)
            .map(|(_, scenes)| scenes)
            .sum()
    }

    /// Makes them on one thread, with times of the length that scenes have; `told` hears which part is done and what comes
    /// next, while no time is taken.
    ///
    /// # Errors
    /// When there is no thread, or no memory for a picture of that size.
    pub fn make(
        self,
        timing: &TimingFlags,
        told: &(dyn Fn(f32, &str) + Sync),
    ) -> Result<(Option<Speedups>, Option<Scaling>), Failure> {
        let all = self.scenes();
        let one = ThreadFlags { threads: Some(1) };
        let made = one.install(|| -> Result<_, StudyError> {
            let (methods, mut studies) = (&timing.methods.0, (None, None));
            if self.speedups {
                let usual = SpeedupOptions::default();
                let limits = Limits {
                    time_budget: timing.time_budget.saturating_mul(3),
                    ..usual.limits
                };
                let told = &mut |part: f32, what: &str| {
                    told(3.0 * part / all, &format!("speedups: {what}"))
                };
                studies.0 = Some(Speedups::measure(
                    methods,
                    &SpeedupOptions { limits, ..usual },
                    told,
                )?);
            }
            if self.scaling {
                let usual = ScalingOptions::default();
                let limits = Limits {
                    time_budget: timing.time_budget / 8,
                    ..usual.limits
                };
                let told = &mut |part: f32, what: &str| {
                    told(1.0 - 6.0 / all * (1.0 - part), &format!("scaling: {what}"))
                };
                studies.1 = Some(Scaling::measure(
                    methods,
                    &ScalingOptions { limits, ..usual },
                    told,
                )?);
            }
            Ok(studies)
        })?;
        made.map_err(|error| error.to_string().into())
    }
}
