//! Numbers in messages, as short as a person would type them.

use core::fmt;

/// A number in a message: in plain digits, or with an exponent if there would be many digits.
///
/// A message about `--far 1e300` shows 1e300, and not a one and 300 zeros.
#[derive(Clone, Copy, Debug)]
pub struct Written(pub f64);

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Written(value) = *self;
        let size = value.abs();
        // Whole numbers below 1e16 have up to 16 digits, all of which an `f64` can tell apart.
        let is_plain = size == 0.0 || !size.is_finite() || (1e-5..1e16).contains(&size);
        if is_plain {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn numbers_of_many_digits_are_written_with_an_exponent() {
        for (value, text) in [
            (1e300, "1e300"),
            (-2.5e-7, "-2.5e-7"),
            (1e15, "1000000000000000"),
            (0.25, "0.25"),
            (0.0, "0"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(Written(value).to_string(), text);
        }
    }
}
