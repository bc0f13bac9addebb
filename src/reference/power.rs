//! The power functions of highlights, as their formulas are written.

use crate::scene::Power;

/// Highlights up to this strength count as none: half a unit in the last place of a colour of ½ in
/// single precision.
const FAINT: f64 = 1.0 / (1u64 << 24) as f64;

/// Returns the function of the cosine `t`, 0..=1, for the exponent n:
/// ```text
/// tⁿ,   e^(−n (1 − t)),   max(0, 1 − (1 − t) n/m)^m with m = 2ᵏ,   t / (n − n t + t)
/// ```
/// or interpolates between two entries of a table of tⁿ, which begins where the strongest highlight
/// becomes faint. For n below 1 all of them are tⁿ.
pub(crate) fn powered(power: Power, n: f64, t: f64, strongest: impl FnOnce() -> f64) -> f64 {
    match power {
        _ if n < 1.0 => libm::pow(t, n),
        Power::Squaring => libm::pow(t, n),
        Power::Exp => libm::exp(-n * (1.0 - t)),
        Power::Lyon { k } => {
            let m = f64::from(1u32 << k);
            libm::pow((1.0 - (1.0 - t) * n / m).max(0.0), m)
        }
        Power::Schlick => t / (n - n * t + t),
        Power::Table { size } => {
            let from = faintest(strongest(), n);
            if t <= from {
                return 0.0;
            }
            let entry = |i: f64| libm::pow(from + (1.0 - from) * i / f64::from(size), n);
            let place = (t - from) / (1.0 - from) * f64::from(size);
            let below = libm::floor(place).min(f64::from(size) - 1.0);
            let share = place - below;
            (1.0 - share) * entry(below) + share * entry(below + 1.0)
        }
    }
}

/// Returns the cosine whose nth power makes the strongest highlight faint: (2⁻²⁴ / k_s)^(1/n).
fn faintest(strongest: f64, n: f64) -> f64 {
    let share = FAINT / strongest.max(FAINT);
    libm::pow(share.max(2.0 * f64::from(f32::MIN_POSITIVE)), 1.0 / n)
}
