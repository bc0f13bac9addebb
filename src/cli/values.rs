//! Values of flags: numbers in their ranges.

use std::str::FromStr;

/// Reads a number for which `is_valid` holds, or says what was `expected`.
pub fn number<T: FromStr>(
    text: &str,
    expected: impl std::fmt::Display,
    is_valid: impl Fn(&T) -> bool,
) -> Result<T, String> {
    let number = text.parse().ok().filter(is_valid);
    number.ok_or_else(|| format!("expected {expected}"))
}

/// Reads grey levels of a threshold: 0 or more.
pub fn grey_levels(text: &str) -> Result<f64, String> {
    let is_valid = |levels: &f64| *levels >= 0.0;
    number(text, "grey levels: a number, 0 or more", is_valid)
}

/// Reads a scale of grey levels: more than 0.
pub fn scale(text: &str) -> Result<f32, String> {
    let is_valid = |scale: &f32| *scale > 0.0 && scale.is_finite();
    number(text, "grey levels: a number over 0", is_valid)
}

/// Reads a length in world units: more than 0, also as `f32`.
pub fn length(text: &str) -> Result<f64, String> {
    let is_valid = |length: &f64| (*length as f32) > 0.0 && (*length as f32).is_finite();
    number(text, "a length in world units: a number over 0", is_valid)
}
