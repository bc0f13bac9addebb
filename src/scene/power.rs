//! The power function of highlights. Methods and the reference each compute it in their own
//! arithmetic.

use crate::number::NameError;
use alloc::borrow::ToOwned;
use alloc::format;
use core::fmt;

/// The function that raises the cosine of a highlight, t in 0..=1, to the exponent n. Every method
/// has it as the parameter `power=`, as in `duff-phong:power=lyon:k=3`.
///
/// For n below 1, every function is tⁿ itself, because the approximations approximate a peak and
/// not a root.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Power {
    /// tⁿ by repeated squaring. If n is not a whole number, a power function computes it.
    #[default]
    Squaring,
    /// `e^(−n (1 − t))`, which replaces `n ln t` by its tangent at t = 1.
    Exp,
    /// A table of tⁿ in `size` steps, from the least cosine with a visible highlight to 1. Values
    /// between entries are interpolated linearly (Bishop, Weimer 1986: "one memory reference").
    Table {
        /// How many steps the table has.
        size: u32,
    },
    /// `max(0, 1 − (1 − t) n/2ᵏ)^(2ᵏ)`: one multiplication and k squarings (Lyon 1993).
    Lyon {
        /// How many times to square.
        k: u32,
    },
    /// `t / (n − n t + t)`: one division, with a longer tail (Schlick 1994).
    Schlick,
}

impl Power {
    /// All functions with the default values of their parameters. The first one is the default.
    pub const ALL: [Power; 5] = [
        Power::Squaring,
        Power::Exp,
        Power::Table { size: 1024 },
        Power::Lyon { k: 3 },
        Power::Schlick,
    ];
    /// The range of steps of a table.
    pub const SIZES: [u32; 2] = [2, 65_536];
    /// The range of squarings in Lyon's function.
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

    /// Returns the formula and the parameter in one line.
    pub fn meaning(self) -> &'static str {
        match self {
            Power::Squaring => "t^n by repeated squaring (the default)",
            Power::Exp => "e^(-n (1 - t))",
            Power::Table { .. } => "t^n from a table of size=2..65536 steps (1024), linear between",
            Power::Lyon { .. } => "max(0, 1 - (1 - t) n/2^k)^(2^k), k=1..7 (3)",
            Power::Schlick => "t / (n - n t + t)",
        }
    }

    /// Returns a bound of the largest difference from tⁿ over t in 0..=1, for an exponent `n` of 0
    /// or more.
    ///
    /// All functions but the table depend on s = n (1 − t) and n. They lie between 0 and e⁻ˢ or
    /// 1/(1 + s (1 − 1/n)), and their slope in s is at most 1. So the largest difference at steps
    /// of 1/256 up to s = 16, plus half a step, is a bound. Beyond s = 16 both functions are below
    /// their values there. A table with steps of h is off by h²/8 times the second derivative, n (n
    /// − 1) tⁿ⁻².
    pub fn error(self, n: f64) -> f64 {
        const STEPS: u32 = 256;
        if n < 1.0 || self == Power::Squaring {
            return 0.0;
        }
        if let Power::Table { size } = self {
            // For n below 2 the second derivative grows toward t = 0. The table begins where tⁿ is
            // 2⁻²⁴ or more, which bounds it.
            let steepest = if n < 2.0 {
                libm::pow(2.0, 24.0 * (2.0 - n) / n)
            } else {
                1.0
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
        let samples = (0..=steps).map(|i| f64::min(f64::from(i) / f64::from(STEPS), end));
        let differences = samples.map(|s| (value(s) - libm::pow(1.0 - s / n, n)).abs());
        let beyond = f64::max(value(end), libm::pow(1.0 - end / n, n));
        let beyond = if end < n { beyond } else { 0.0 };
        differences.fold(beyond, f64::max) + 0.5 / f64::from(STEPS)
    }

    /// Returns the function called `name`, with the default value of its parameter.
    ///
    /// # Errors
    /// [`NameError`] if no function has this name.
    pub fn named(name: &str) -> Result<Power, NameError> {
        let named = Power::ALL.into_iter().find(|power| power.name() == name);
        let names = Power::ALL.into_iter().map(Power::name);
        named.ok_or_else(|| NameError::Unknown {
            kind: "power",
            name: name.to_owned(),
            known: names.collect(),
        })
    }

    /// Returns the name and the range of the parameter, if there is one.
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
    /// [`NameError`] if there is no parameter called `key`, or `value` is outside its range.
    pub fn with(self, key: &str, value: &str) -> Result<Power, NameError> {
        let (name, [least, most]) = match self.parameter() {
            Some(parameter) if parameter.0 == key => parameter,
            parameter => {
                return Err(NameError::UnknownParameter {
                    kind: "power",
                    owner: self.name(),
                    name: key.to_owned(),
                    known: parameter.into_iter().map(|(name, _)| name).collect(),
                });
            }
        };
        match (self, value.parse()) {
            (Power::Table { .. }, Ok(size)) if (least..=most).contains(&size) => {
                Ok(Power::Table { size })
            }
            (Power::Lyon { .. }, Ok(k)) if (least..=most).contains(&k) => Ok(Power::Lyon { k }),
            _ => Err(NameError::Value {
                parameter: name,
                value: value.to_owned(),
                expected: format!("expected a whole number from {least} to {most}"),
            }),
        }
    }
}

impl fmt::Display for Power {
    /// Writes the name, and the parameter if it differs from its default.
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

    /// The largest errors in the literature, computed again: of e^(−n (1 − t)), of Lyon's function
    /// with 8, and of Schlick's.
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
            // The bound adds half a step of 1/256, and the literature rounds its last digit.
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
