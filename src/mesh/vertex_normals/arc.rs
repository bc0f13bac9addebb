//! The angle between two directions, computed from values proportional to its sine and cosine.
//! Millions of corners need one each, so the code has few branches.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// The coefficients of a polynomial for `atan(x) / x` in powers of x², for x² up to (√2 − 1)². It
/// passes through the values at 12 Chebyshev nodes and is off by at most 4 · 10⁻¹⁸.
const ATAN: [f64; 12] = [
    1.0,
    -0.3333333333333312,
    0.19999999999940893,
    -0.14285714279250245,
    0.11111110744919656,
    -0.09090896809063952,
    0.07692045330900862,
    -0.06662951813613517,
    0.05846878297215434,
    -0.05035102456074966,
    0.037965257440323044,
    -0.017805397190410625,
];

/// Returns the angle from 0 to π whose sine and cosine are proportional to `sine` and `cosine`; 0
/// if both are 0. `sine` must not be negative.
///
/// Let `q` be the smaller of the two over the larger. The polynomial evaluates `atan q` for `q` up
/// to tan 22.5°, and larger ones go through `atan q = π/4 + atan((q − 1) / (q + 1))`. The result is
/// off by at most 2ε of the angle: one ε from the quotient and its square, and one from the
/// polynomial, all of whose terms but the first are small, and from the additions.
#[inline(always)]
pub(super) fn angle(sine: f64, cosine: f64) -> f64 {
    const TAN_OF_AN_EIGHTH: f64 = core::f64::consts::SQRT_2 - 1.0;
    let across = cosine.abs();
    let (small, large) = (sine.min(across), sine.max(across));
    // Factors of one and zero replace branches, which a processor would mispredict half of the
    // time.
    let one_if = |holds: bool| f64::from(u8::from(holds));
    // 1 if the quotient is reduced by an eighth of a turn.
    let turn = one_if(small > TAN_OF_AN_EIGHTH * large);
    let below = large + turn * small;
    if below == 0.0 {
        return 0.0;
    }
    let x = (small - turn * large) / below;
    let part = turn * FRAC_PI_4 + x * series(x * x);
    let (is_steep, is_obtuse) = (one_if(sine > across), one_if(cosine < 0.0));
    // Reflections: π/2 − part if the sine is the larger one, then π − acute if the cosine is
    // negative.
    let acute = is_steep * FRAC_PI_2 + (1.0 - 2.0 * is_steep) * part;
    is_obtuse * PI + (1.0 - 2.0 * is_obtuse) * acute
}

/// Evaluates the polynomial at `z` in pairs (Estrin's scheme), so that a processor can do several
/// steps at once.
#[inline(always)]
fn series(z: f64) -> f64 {
    let pair = |k: usize| ATAN[k] + ATAN[k + 1] * z;
    let square = z * z;
    let four = |k: usize| pair(k) + pair(k + 2) * square;
    let fourth = square * square;
    four(0) + (four(4) + four(8) * fourth) * fourth
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_agree_with_the_arc_tangent() {
        let mut most: f64 = 0.0;
        for k in 0..=200_000 {
            let (sine, cosine) = libm::sincos(PI * f64::from(k) / 200_000.0);
            let scale = libm::exp2(f64::from(k % 600 - 300));
            let (sine, cosine) = (sine.max(0.0) * scale, cosine * scale);
            let expected = libm::atan2(sine, cosine);
            most = most.max((angle(sine, cosine) - expected).abs() / expected.max(1e-300));
        }
        // `atan2` is off by one ε itself.
        assert!(most <= 3.0 * f64::EPSILON, "{most:e}");
    }

    #[test]
    fn right_straight_and_small_angles_are_exact() {
        assert_eq!(angle(3.0, 0.0), FRAC_PI_2);
        assert_eq!(angle(2.0, 2.0), FRAC_PI_4);
        assert_eq!(angle(0.0, 5.0), 0.0);
        assert_eq!(angle(0.0, -5.0), PI);
        assert_eq!(angle(1e-30, 1.0), 1e-30);
        assert_eq!(angle(0.0, 0.0), 0.0);
    }
}
