//! Figures of the illumination model.

use super::{agreement, made, value};
use fastphong_cli::lectures::Agreement;

#[test]
fn illumination_adds_its_terms_and_obeys_the_cosine() {
    let content = made("illumination");
    // Each of the four pictures is within the bound of naive Phong shading, some 10⁻⁵ of 1: far
    // below 0.01 levels.
    assert!(value(&content, "sum") < 0.01);
    // The turned face's normal is rounded to f32 once, and its product with the light a few times.
    assert!((value(&content, "cube") - 0.5).abs() < 4.0 * f64::from(f32::EPSILON));
    assert!(
        value(&content, "cosine") < 4.0 * f64::from(f32::EPSILON) && value(&content, "kd") < 1e-6
    );
}

#[test]
fn exponents_narrow_the_highlight() {
    let content = made("exponents");
    assert_eq!(agreement(&content, "narrows"), Agreement::Confirms);
    // cos^p is a half at cos⁻¹(2^(−1/p)).
    let half = |p: f64| (0.5f64.powf(1.0 / p)).acos().to_degrees();
    assert!((value(&content, "narrows") - half(1.0) / half(512.0)).abs() < 1e-9);
    // The text of the notes contradicts their Figure 7.
    assert_eq!(agreement(&content, "shiny"), Agreement::Contradicts);
    // Light and eye are along z, so R turns by twice the normal's angle and H stays. R·V falls to a
    // half at half(20) / 2, N·H at half(p). A pixel is a quarter of a degree wide in the middle,
    // and the value is interpolated between two pixels.
    assert!((value(&content, "half-width") - half(20.0) / 2.0).abs() < 0.05);
    assert!((value(&content, "same-exponent") - 2.0).abs() < 0.02);
    assert!((value(&content, "converted") - 2.0 * half(80.0) / half(20.0)).abs() < 0.01);
    assert_eq!(agreement(&content, "same-exponent"), Agreement::Contradicts);
}

#[test]
fn attenuation_clips_and_blackens_as_predicted() {
    let content = made("attenuation");
    // h / r³ ≥ 1 with r² = h² + ρ² holds in a disc of area π ρ² of 16. Half of the pixels on its
    // rim may count either way.
    let (h, pi) = (0.3f64, std::f64::consts::PI);
    let disc = |r: f64| (r * r - h * h, (r * r - h * h).sqrt());
    let rim = |radius: f64| 100.0 * pi * radius * (4.0 / 96.0) / 16.0;
    let (square, radius) = disc(h.cbrt());
    assert!((value(&content, "clipped") - 100.0 * pi * square / 16.0).abs() <= rim(radius));
    assert_eq!(value(&content, "clipped-notes"), 0.0);
    // h³ / r³ < 1/255 outside a disc.
    let (square, radius) = disc(h * 255.0f64.cbrt());
    assert!((value(&content, "dark") - 100.0 * (1.0 - pi * square / 16.0)).abs() <= rim(radius));
}

#[test]
fn constant_vectors_are_less_exact_than_six_products() {
    let content = made("constant-vectors");
    assert!(
        value(&content, "coarse") > 1.0 && agreement(&content, "coarse") == Agreement::Contradicts
    );
    // The vectors are off by at most half a polygon. This error is of first order in the polygon's
    // size, and on a smooth surface errors do not cancel in the mean square.
    let order = value(&content, "order");
    assert!((0.7..1.6).contains(&order), "{order}");
    assert!(value(&content, "duff-naive") < 0.1);
    assert_eq!(value(&content, "additions"), 14.0);
}

#[test]
fn gates_keep_light_from_behind_out() {
    let content = made("gates");
    assert!(value(&content, "behind") > 1.0 && value(&content, "behind-gated") == 0.0);
    assert_eq!(agreement(&content, "behind"), Agreement::Contradicts);
    // A highlight of up to 0.8 · 255 levels ends abruptly where it is still over a tenth of its
    // height.
    assert!(value(&content, "line") > 20.0);
    assert!(value(&content, "clamped") > 1.0);
}
