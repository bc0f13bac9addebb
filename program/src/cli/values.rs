//! Reads the values of flags: numbers within their ranges.

use std::str::FromStr;

/// Reads a number for which `is_valid` holds. The error says what was `expected`.
pub fn number<T: FromStr>(
    text: &str,
    expected: impl std::fmt::Display,
    is_valid: impl Fn(&T) -> bool,
) -> Result<T, String> {
    let number = text.parse().ok().filter(is_valid);
    number.ok_or_else(|| format!("expected {expected}"))
}

/// Reads a threshold in grey levels: 0 or more.
pub fn grey_levels(text: &str) -> Result<f64, String> {
    let is_valid = |levels: &f64| *levels >= 0.0;
    number(text, "grey levels: a number, 0 or more", is_valid)
}

/// Reads the scale of a map in grey levels: more than 0.
pub fn scale(text: &str) -> Result<f32, String> {
    let is_valid = |scale: &f32| (1e-6..=1e6).contains(scale);
    let expected = "grey levels: a number over 0 (1e-6 to 1e6)";
    number(text, expected, is_valid)
}

/// Reads a length in world units. Both the length and its reciprocal must be within the range of
/// coordinates.
pub fn length(text: &str) -> Result<f64, String> {
    let is_valid = |length: &f64| (1e-15..=1e15).contains(length);
    let expected = "a length in world units: a number over 0 (1e-15 to 1e15)";
    number(text, expected, is_valid)
}
