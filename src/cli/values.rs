//! Values of flags: numbers in their ranges.

/// Grey levels of a threshold: 0 or more.
pub fn grey_levels(text: &str) -> Result<f64, String> {
    let levels = text.parse().ok().filter(|levels: &f64| *levels >= 0.0);
    levels.ok_or_else(|| "expected grey levels: a number, 0 or more".to_owned())
}

/// A scale of grey levels: more than 0.
pub fn scale(text: &str) -> Result<f32, String> {
    let scale = text
        .parse()
        .ok()
        .filter(|scale: &f32| *scale > 0.0 && scale.is_finite());
    scale.ok_or_else(|| "expected grey levels: a number over 0".to_owned())
}

/// A length in world units: more than 0.
pub fn length(text: &str) -> Result<f64, String> {
    let length = text
        .parse()
        .ok()
        .filter(|length: &f64| *length > 0.0 && length.is_finite());
    length.ok_or_else(|| "expected a length in world units: a number over 0".to_owned())
}
