//! Values of flags: numbers in their ranges.

/// Reads grey levels of a threshold: 0 or more.
pub fn grey_levels(text: &str) -> Result<f64, String> {
    let levels = text.parse().ok().filter(|levels: &f64| *levels >= 0.0);
    levels.ok_or_else(|| "expected grey levels: a number, 0 or more".to_owned())
}

fn positive(text: &str, what: &str) -> Result<f64, String> {
    let number = text.parse().ok();
    let number =
        number.filter(|number: &f64| (*number as f32) > 0.0 && (*number as f32).is_finite());
    number.ok_or_else(|| format!("expected {what}: a number over 0"))
}

/// Reads a scale of grey levels: more than 0.
pub fn scale(text: &str) -> Result<f32, String> {
    positive(text, "grey levels").map(|scale| scale as f32)
}

/// Reads a length in world units: more than 0.
pub fn length(text: &str) -> Result<f64, String> {
    positive(text, "a length in world units")
}
