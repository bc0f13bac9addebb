//! The power function of highlights: data that methods and reference compute by, each in its own arithmetic.

use crate::number::NameError;
use crate::number::suggest::{one_of, unknown};
use alloc::format;
use core::fmt;

/// The function that raises the cosine of a highlight, t in 0..=1, to the exponent n. It is `power=` of every method, as in
/// `duff-phong:power=lyon:k=3`.
///
/// All of them are tⁿ itself where n is below 1: an approximation of a peak is none of a root.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Power {
    /// tⁿ by repeated squaring, or by a power function where n is no whole number.
    #[default]
    Squaring,
    /// `e^(−n (1 − t))`, the tangent of `n ln t` at t = 1.
    Exp,
    /// A table of tⁿ in `size` steps from the least cosine that has a highlight to 1, linear between its entries (Bishop,
    /// Weimer 1986: "one memory reference").
    Table {
        /// The steps.
        size: u32,
    },
    /// `max(0, 1 − (1 − t) n/2ᵏ)^(2ᵏ)`: a product and k squarings (Lyon 1993).
    Lyon {
        /// The squarings.
        k: u32,
    },
    /// `t / (n − n t + t)`: one division, and a longer tail (Schlick 1994).
    Schlick,
}

impl Power {
    /// All functions, with the default values of their parameters, the default first.
    pub const ALL: [Power; 5] = [
        Power::Squaring,
        Power::Exp,
        Power::Table { size: 1024 },
        Power::Lyon { k: 3 },
        Power::Schlick,
    ];
    /// The steps that a table may have.
    pub const SIZES: [u32; 2] = [2, 65_536];
    /// The squarings that Lyon's function may have.
    pub const SQUARINGS: [u32; 2] = [1, 7];

    /// Returns the name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Power::Squaring => "squaring",
            Power::Exp => "exp",
            Power::Table { .. } => "table",
            Power::Lyon { .. } => "lyon",
            Power::Schlick => "schlick",
        }
    }

    /// Returns the formula and the parameter, in one line.
    pub fn meaning(self) -> &'static str {
        match self {
            Power::Squaring => "t^n by repeated squaring (the default)",
            Power::Exp => "e^(-n (1 - t))",
            Power::Table { .. } => "t^n from a table of size=2..65536 steps (1024), linear between",
            Power::Lyon { .. } => "max(0, 1 - (1 - t) n/2^k)^(2^k), k=1..7 (3)",
            Power::Schlick => "t / (n - n t + t)",
        }
    }

    /// Returns a bound of the largest difference from tⁿ, t in 0..=1, for an exponent of 0 or more.
    ///
    /// All functions but the table depend on s = n (1 − t) and n, are between 0 and e⁻ˢ or 1/(1 + s (1 − 1/n)), and are never steeper
    /// than 1 in s: so the largest difference at steps of 1/256 up to s = 16, and half a step more, is a bound; beyond, both functions
    /// are below their values there. A table with steps of h is off by h²/8 of the second derivative, n (n − 1) tⁿ⁻².
    pub fn error(self, n: f64) -> f64 {
        const STEPS: u32 = 256;
        if n < 1.0 || self == Power::Squaring {
            return 0.0;
        }
        if let Power::Table { size } = self {
            // Where n is below 2 the second derivative grows toward 0: a table begins where tⁿ is 2⁻²⁴ or more.
            let steepest = match n < 2.0 {
                true => libm::pow(2.0, 24.0 * (2.0 - n) / n),
                false => 1.0,
            };
            let h = 1.0 / f64::from(size);
            return f64::min(1.0, n * (n - 1.0) * steepest * h * h / 8.0);
        }
        let value = |s: f64| {
            let t = 1.0 - s / n;
            match self {
                Power::Exp => libm::exp(-s),
                Power::Lyon { k } => {
                    let m = f64::from(1u32 << k);
                    libm::pow((1.0 - s / m).max(0.0), m)
                }
                Power::Schlick => t / (n - n * t + t),
                Power::Squaring | Power::Table { .. } => libm::pow(t, n),
            }
        };
        let end = f64::min(n, 16.0);
        let steps = libm::ceil(end * f64::from(STEPS)) as u32;
        let places = (0..=steps).map(|i| f64::min(f64::from(i) / f64::from(STEPS), end));
        let differences = places.map(|s| (value(s) - libm::pow(1.0 - s / n, n)).abs());
        let beyond = f64::max(value(end), libm::pow(1.0 - end / n, n));
        let beyond = if end < n { beyond } else { 0.0 };
        differences.fold(beyond, f64::max) + 0.5 / f64::from(STEPS)
    }

    /// Reads a name.
    ///
    /// # Errors
    /// [`NameError`] when no function has it.
    pub fn named(name: &str) -> Result<Power, NameError> {
        let named = Power::ALL.into_iter().find(|power| power.name() == name);
        let names = Power::ALL.into_iter().map(Power::name);
        named.ok_or_else(|| NameError(unknown("power", name, names)))
    }

    /// Returns the name and the range of its parameter, if it has one.
    pub fn parameter(self) -> Option<(&'static str, [u32; 2])> {
        match self {
            Power::Table { .. } => Some(("size", Power::SIZES)),
            Power::Lyon { .. } => Some(("k", Power::SQUARINGS)),
            _ => None,
        }
    }

    /// Returns the function with another value of its parameter.
    ///
    /// # Errors
    /// [`NameError`] when it has no parameter called `key`, or `value` is outside its range.
    pub fn with(self, key: &str, value: &str) -> Result<Power, NameError> {
        let (name, [least, most]) = match self.parameter() {
            Some(parameter) if parameter.0 == key => parameter,
            parameter => {
                let name = self.name();
                let expected = one_of(parameter.into_iter().map(|(name, _)| name));
                return Err(NameError(format!(
                    "power `{name}` has no parameter `{key}`: {expected}"
                )));
            }
        };
        match (self, value.parse()) {
            (Power::Table { .. }, Ok(size)) if (least..=most).contains(&size) => {
                Ok(Power::Table { size })
            }
            (Power::Lyon { .. }, Ok(k)) if (least..=most).contains(&k) => Ok(Power::Lyon { k }),
            _ => Err(NameError(format!(
                "`{name}={value}`: expected a whole number from {least} to {most}"
            ))),
        }
    }
}

impl fmt::Display for Power {
    /// Writes the name, and a parameter that differs from its default.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        match self {
            _ if Power::ALL.contains(self) => Ok(()),
            Power::Table { size } => write!(f, ":size={size}"),
            Power::Lyon { k } => write!(f, ":k={k}"),
            Power::Squaring | Power::Exp | Power::Schlick => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn names_come_back_as_they_were_written() {
        let others = [Power::Table { size: 2 }, Power::Lyon { k: 7 }];
        for power in Power::ALL.into_iter().chain(others) {
            let text = power.to_string();
            let mut parts = text.split(':');
            let mut read = Power::named(parts.next().unwrap()).unwrap();
            for part in parts {
                let (key, value) = part.split_once('=').unwrap();
                read = read.with(key, value).unwrap();
            }
            assert_eq!(read, power, "{text}");
        }
        for (power, key, value) in [
            (Power::Exp, "k", "2"),
            (Power::Lyon { k: 3 }, "size", "2"),
            (Power::Lyon { k: 3 }, "k", "8"),
            (Power::Lyon { k: 3 }, "k", "2.5"),
            (Power::Table { size: 2 }, "size", "1"),
        ] {
            assert!(power.with(key, value).is_err(), "{power} {key}={value}");
        }
    }

    /// The largest errors of the literature, found anew: of e^(−n (1 − t)), Lyon's function with 8 and Schlick's.
    #[test]
    fn errors_are_those_of_the_literature() {
        let found = |power: Power, n| power.error(n);
        for (power, n, truth) in [
            (Power::Exp, 5.0, 0.058),
            (Power::Exp, 40.0, 0.0068),
            (Power::Lyon { k: 3 }, 20.0, 0.022),
            (Power::Lyon { k: 3 }, 320.0, 0.035),
            (Power::Lyon { k: 2 }, 80.0, 0.070),
            (Power::Schlick, 10.0, 0.179),
            (Power::Schlick, 320.0, 0.203),
        ] {
            // Half a step of 1/256 more, and the last digit of the table.
            let error = found(power, n);
            assert!(
                (truth - 0.0005..truth + 0.0025).contains(&error),
                "{power} {n}: {error}"
            );
        }
        assert_eq!(found(Power::Squaring, 50.0), 0.0);
        assert_eq!(found(Power::Schlick, 0.5), 0.0);
    }
}
