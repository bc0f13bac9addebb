//! The power of the specular term.

use crate::number::{Num, each};

/// The exponent `n` of the specular term, as it is best computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Power {
    /// A whole number: by repeated squaring, at most 2 log₂ n multiplications.
    Integer(u32),
    /// Any other: by the library's power function.
    Fractional(f32),
}

impl Power {
    /// The power for a shininess of 0 or more.
    pub fn new(shininess: f32) -> Self {
        let whole = shininess as u32;
        if whole as f32 == shininess {
            Power::Integer(whole)
        } else {
            Power::Fractional(shininess)
        }
    }

    /// How many squarings give it, if up to 7 do.
    #[inline(always)]
    pub(super) fn squarings(self) -> Option<u32> {
        match self {
            Power::Integer(n) if n.is_power_of_two() && n <= 128 => Some(n.trailing_zeros()),
            _ => None,
        }
    }

    /// `base` to this power; `base` is 0 or more, and anything to the power 0 is 1. The one power function of all
    /// methods, so that none is faster by a cheaper one.
    #[inline(always)]
    pub fn of<F: Num>(self, base: F, one: F) -> F {
        self.of_each([base], one)[0]
    }

    /// The same of several numbers: what is to be done is decided once for all of them.
    #[inline(always)]
    pub fn of_each<F: Num, const L: usize>(self, base: [F; L], one: F) -> [F; L] {
        let mut n = match self {
            Power::Integer(0) => return [one; L],
            Power::Integer(n) => n,
            Power::Fractional(n) => {
                return each(
                    #[inline(always)]
                    |i| base[i].powf(n),
                );
            }
        };
        let zeros = n.trailing_zeros();
        let mut square = squared_up_to_7(base, zeros % 8);
        for _ in 0..zeros / 8 * 8 {
            square = squared(square);
        }
        let mut power = square;
        n >>= zeros;
        n >>= 1;
        while n != 0 {
            square = squared(square);
            if n & 1 == 1 {
                power = each(
                    #[inline(always)]
                    |i| power[i] * square[i],
                );
            }
            n >>= 1;
        }
        power
    }
}

/// Each squared `times` times, of 7 at most. Without a loop: those of 16, 32 and 64 are most of what is done for a highlight.
#[inline(always)]
pub(super) fn squared_up_to_7<F: Num, const L: usize>(mut x: [F; L], times: u32) -> [F; L] {
    if times & 4 != 0 {
        x = squared(squared(squared(squared(x))));
    }
    if times & 2 != 0 {
        x = squared(squared(x));
    }
    if times & 1 != 0 {
        x = squared(x);
    }
    x
}

/// The square of each.
#[inline(always)]
fn squared<F: Num, const L: usize>(x: [F; L]) -> [F; L] {
    each(
        #[inline(always)]
        |i| x[i] * x[i],
    )
}

#[cfg(test)]
mod tests {
    use super::{Power, squared_up_to_7};

    /// Each multiplication rounds the factor once: n of them, however they are put together, are off by at most n · 2⁻²⁴ of the value,
    /// and a factor 1.1 covers the products of roundings.
    #[test]
    fn whole_powers_are_products() {
        for n in (0..=70).chain([
            96, 127, 128, 129, 255, 256, 300, 512, 1000, 1024, 4096, 65_536,
        ]) {
            let base = 1.0 - 1.0 / (n as f32 + 3.0);
            let truth = f64::from(base).powi(n);
            let power = Power::new(n as f32);
            let by_squaring = power
                .squarings()
                .map(|times| squared_up_to_7([base], times)[0]);
            for found in [Some(power.of(base, 1.0)), by_squaring]
                .into_iter()
                .flatten()
            {
                let bound = 1.1 * f64::from(n) * f64::powi(2.0, -24) * truth;
                assert!(
                    (f64::from(found) - truth).abs() <= bound,
                    "{power:?}: {found}, expected {truth}"
                );
            }
        }
        assert_eq!(
            [24.0, 256.0, 0.0, 0.5].map(|n| Power::new(n).squarings()),
            [None; 4]
        );
        assert_eq!(
            [1.0, 32.0, 128.0].map(|n| Power::new(n).squarings()),
            [Some(0), Some(5), Some(7)]
        );
    }
}
