//! From computed intensities to stored grey levels.

use crate::scene::Encoding;

/// The stored grey level of intensity `c`: 255 c, rounded to the nearest integer.
///
/// `c` is clamped to 0..=1 first; NaN becomes 0. The only `f32` for which 255 c is a half is ½ itself; it gives 128. In
/// `f32` the product is rounded too, so that values within 2⁻¹⁷ of a half may fall on either side of it: far less than
/// shading in `f32` is off by.
///
/// Tried and dropped: exact in `f64`, and a conversion by `as`, whose saturation keeps the loop from being vectorised:
/// both took 4 ns a pixel, a quarter of a flat-shaded frame.
#[inline(always)]
pub fn quantise(c: f32) -> u8 {
    /// 2²³: from here on floats are integers, so that adding it rounds, and its lowest bits are the result.
    const INTEGERS: f32 = 8_388_608.0;
    // The comparisons in this order make NaN 0.
    let c = if c > 0.0 { c } else { 0.0 };
    let c = if c < 1.0 { c } else { 1.0 };
    (255.0 * c + INTEGERS).to_bits() as u8
}

/// The sRGB value of linear intensity `c`, both in 0..=1 (IEC 61966-2-1:1999, 5.2).
///
/// ```text
/// 12.92 c                  c ≤ 0.0031308
/// 1.055 c^(1/2.4) − 0.055  otherwise
/// ```
///
/// Values below 0 stay on the straight line, values above 1 on the curve; NaN stays NaN.
pub fn srgb_encode(c: f32) -> f32 {
    if c <= 0.003_130_8 {
        return 12.92 * c;
    }
    // In f64, so that 1 becomes 1 and not the float below it.
    (1.055 * libm::pow(f64::from(c), 1.0 / 2.4) - 0.055) as f32
}

/// A linear texel as it is stored; alpha has no transfer function.
pub fn store(texel: [f32; 4], encoding: Encoding) -> [u8; 4] {
    let [r, g, b, alpha] = texel;
    let encode = |c| match encoding {
        Encoding::Linear => quantise(c),
        Encoding::Srgb => quantise(srgb_encode(c)),
    };
    [encode(r), encode(g), encode(b), quantise(alpha)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stored_level_survives_decoding_and_quantising() {
        for level in 0..=255u8 {
            assert_eq!(quantise(f32::from(level) / 255.0), level);
        }
    }

    #[test]
    fn quantise_rounds_halves_up_and_clamps() {
        assert_eq!(quantise(0.5), 128, "127.5 is a half and goes up");
        assert_eq!(quantise(f32::from_bits(0.5f32.to_bits() - 1)), 127, "just below the half");
        assert_eq!([-1.0, -0.0, 1.0, 1.5, f32::INFINITY, f32::NEG_INFINITY].map(quantise), [0, 0, 255, 255, 255, 0]);
        assert_eq!(quantise(f32::NAN), 0);
    }

    #[test]
    fn srgb_encode_meets_known_values() {
        assert_eq!(srgb_encode(0.0), 0.0);
        assert_eq!(srgb_encode(1.0), 1.0);
        // Each value is in 0.03..1, where a float is spaced by at most 2^-24 = 6e-8; the input's own rounding, at most
        // half of that, is stretched by the slope, at most 12.92 (at the join): 4e-7 in all.
        let known = [(0.003_130_8, 0.040_449_936), (0.01, 0.099_852_82), (0.18, 0.461_356_13), (0.5, 0.735_357)];
        for (linear, encoded) in known {
            let got = srgb_encode(linear);
            assert!((got - encoded).abs() <= 4e-7, "{linear} became {got}, not {encoded}");
        }
    }

    #[test]
    fn srgb_encode_never_falls() {
        let mut last = srgb_encode(-0.1);
        for step in -1000..=11_000 {
            let here = srgb_encode(step as f32 / 10_000.0);
            assert!(here >= last, "fell at step {step}");
            last = here;
        }
        assert!(srgb_encode(f32::NAN).is_nan());
    }

    #[test]
    fn store_encodes_colours_and_not_alpha() {
        let texel = [0.5, 0.18, 0.0, 0.5];
        assert_eq!(store(texel, Encoding::Linear), [128, 46, 0, 128]);
        // 255 · 0.735357 = 187.5 (187.516), 255 · 0.461356 = 117.6.
        assert_eq!(store(texel, Encoding::Srgb), [188, 118, 0, 128]);
    }
}
