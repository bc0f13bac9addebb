//! The power functions of highlights, in the form in which pixel loops compute them.

use crate::number::Num;
use crate::scene::Power;
use alloc::vec::Vec;

/// The power function of a highlight, sorted by how it is computed fastest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exponent {
    /// tⁿ with n = 1, 2, 4, … 128: this many squarings.
    Squarings(u32),
    /// tⁿ with any other whole n: repeated squaring, at most 2 log₂ n multiplications.
    Whole(u32),
    /// tⁿ with any other n: the power function of the arithmetic.
    Fractional(f32),
    /// e^(−n (1 − t)) = 2^(r (t − 1)), with r = n log₂ e.
    Exp(f32),
    /// A table of tⁿ that starts at the cosine `from`.
    Table {
        /// The cosine of the first entry.
        from: f32,
        /// How many steps of the table a cosine of 1 takes.
        scale: f32,
    },
    /// Lyon's function: `1 − (1 − t) slope`, squared `squarings` times.
    Lyon {
        /// n / 2ᵏ.
        slope: f32,
        /// k.
        squarings: u32,
    },
    /// Schlick's function, with its exponent.
    Schlick(f32),
}

impl Exponent {
    /// Chooses the function for a shininess n of 0 or more, whose highlights begin at the cosine
    /// `faint`.
    pub fn new(power: Power, shininess: f32, faint: f32) -> Self {
        let n = shininess as u32;
        match power {
            // All functions but tⁿ are for exponents of 1 or more.
            Power::Exp if n > 0 => Exponent::Exp(shininess * core::f32::consts::LOG2_E),
            Power::Table { size } if n > 0 => Exponent::Table {
                from: faint,
                scale: size as f32 / (1.0 - faint),
            },
            Power::Lyon { k } if n > 0 => Exponent::Lyon {
                slope: shininess / (1 << k) as f32,
                squarings: k,
            },
            Power::Schlick if n > 0 => Exponent::Schlick(shininess),
            _ if n as f32 != shininess => Exponent::Fractional(shininess),
            _ if n.is_power_of_two() && n <= 128 => Exponent::Squarings(n.trailing_zeros()),
            _ => Exponent::Whole(n),
        }
    }

    /// Returns the entries of the table; `None` for other functions.
    pub(crate) fn table(self, shininess: f32, faint: f32) -> Option<Vec<f32>> {
        let Exponent::Table { scale, .. } = self else {
            return None;
        };
        let (from, n) = (f64::from(faint), f64::from(shininess));
        // The size that the user asked for: `scale` is rounded, and so is its product.
        let size = libm::round(f64::from(scale) * (1.0 - from)) as u32;
        let entry = |i: u32| from + (1.0 - from) * f64::from(i) / f64::from(size);
        let power = |i| libm::pow(entry(i), n) as f32;
        Some((0..=size).map(power).collect())
    }

    /// True for tⁿ with n over 0.
    pub(crate) fn is_power(self) -> bool {
        match self {
            Exponent::Whole(n) => n > 0,
            Exponent::Squarings(_) => true,
            Exponent::Fractional(n) => n > 0.0,
            _ => false,
        }
    }

    /// True if the function is not 0 at 0.
    pub(crate) fn is_lit_at_zero(self) -> bool {
        match self {
            Exponent::Whole(0) | Exponent::Exp(_) => true,
            Exponent::Lyon { slope, .. } => slope < 1.0,
            _ => false,
        }
    }

    /// Returns `base` to this power, read from `powers` if it is a table.
    #[inline(always)]
    pub(crate) fn of_or_read<F: Num>(self, base: F, powers: &[f32]) -> F {
        match self {
            Exponent::Table { from, scale } => ((base - from).max(0.0) * scale).lookup(powers),
            other => other.of(base),
        }
    }

    /// Returns `base`, 0 or more, to this power; anything to the power 0 is 1.
    ///
    /// All methods use this one function, so that none is faster by a cheaper one. `LightAt::power`
    /// calls its squarings directly.
    #[inline(always)]
    pub fn of<F: Num>(self, base: F) -> F {
        match self {
            Exponent::Squarings(times) => squared_up_to_7(base, times),
            Exponent::Whole(0) => base.broadcast(1.0),
            Exponent::Whole(n) => to_whole(base, n),
            Exponent::Fractional(n) => base.powf(n),
            Exponent::Exp(rate) => ((base.max(0.0) - 1.0) * rate).exp2(),
            Exponent::Lyon { slope, squarings } => {
                let linear = ((base.max(0.0) - 1.0) * slope + 1.0).max(0.0);
                squared_up_to_7(linear, squarings)
            }
            Exponent::Schlick(n) => {
                let t = -(-base).max(-1.0); // at most 1, because of the pole at n / (n − 1)
                t / (t * (1.0 - n) + n)
            }
            Exponent::Table { .. } => unreachable!("`LightAt::power` reads tables"),
        }
    }
}

/// Returns `x` to the power `n`, 1 or more, by repeated squaring.
#[inline(always)]
fn to_whole<F: Num>(x: F, n: u32) -> F {
    debug_assert!(n > 0);
    let (mut square, mut left) = (x, n);
    // The trailing zeros of n first, so that the product starts from a power of x and not from 1.
    while left & 1 == 0 {
        square = square * square;
        left >>= 1;
    }
    let mut power = square;
    while left > 1 {
        square = square * square;
        left >>= 1;
        if left & 1 == 1 {
            power = power * square;
        }
    }
    power
}

/// Calls [`Exponent::of_or_read`] without inlining it. Inlined in a scalar loop, compilers compute
/// all functions at each pixel and then choose; the results of those that are not chosen are often
/// subnormal, which takes a hundred times as long.
#[inline(never)]
pub(crate) fn power_by_call<F: Num>(exponent: Exponent, base: F, powers: &[f32]) -> F {
    match exponent {
        Exponent::Whole(n) if n > 0 => to_whole(base, n), // the most frequent one first
        _ => exponent.of_or_read(base, powers),
    }
}

/// Squares `x` `times` times, at most 7. It has no loop, because the powers 16, 32 and 64 are most
/// of what a highlight costs.
#[inline(always)]
pub(crate) fn squared_up_to_7<F: Num>(mut x: F, times: u32) -> F {
    // The bits of `times`, from 4 squarings down to 1.
    if times & 4 != 0 {
        x = x * x;
        x = x * x;
        x = x * x;
        x = x * x;
    }
    if times & 2 != 0 {
        x = x * x;
        x = x * x;
    }
    if times & 1 != 0 {
        x = x * x;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Approximate cosines may exceed 1 by x. No function then exceeds eⁿˣ, falls below its value
    /// at 1, or stops being finite, but for 16 roundings for each of n.
    #[test]
    fn powers_of_cosines_over_1_are_little_over_1() {
        let functions = [
            Power::Squaring,
            Power::Exp,
            Power::Table { size: 16 },
            Power::Lyon { k: 3 },
            Power::Schlick,
        ];
        for power in functions {
            for n in [1.0f32, 2.0, 7.5, 32.0, 100.0, 1e4, 1e6] {
                let exponent = Exponent::new(power, n, 0.0);
                let table = exponent.table(n, 0.0).unwrap_or_default();
                for x in [0.0f32, 1e-7, 1e-4, 0.005, 0.01, 0.1] {
                    let value = power_by_call(exponent, 1.0 + x, &table);
                    let rounding = 16.0 * (n + 1.0) * 2f32.powi(-24);
                    let most = libm::expf(n * (x + rounding));
                    assert!(
                        (1.0 - rounding..=most).contains(&value),
                        "{power:?}, n {n}, 1 + {x}: {value}"
                    );
                }
            }
        }
    }
}
