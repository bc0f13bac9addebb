//! From computed intensities to stored grey levels.

use super::{LevelRows, Levels, LinearPicture, Picture8};

/// A way to store linear values in eight bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
#[cfg_attr(feature = "io", serde(rename_all = "lowercase"))]
pub enum Encoding {
    /// round(255 c): no transfer function.
    #[default]
    Linear,
    /// The sRGB transfer function (IEC 61966-2-1), then rounded.
    Srgb,
}

impl Encoding {
    /// Every encoding.
    pub const ALL: [Encoding; 2] = [Encoding::Linear, Encoding::Srgb];

    /// Returns its name on the command line and in data.
    pub fn name(self) -> &'static str {
        match self {
            Encoding::Linear => "linear",
            Encoding::Srgb => "srgb",
        }
    }

    /// Returns the stored value of linear intensity `c`, both in 0..=1.
    pub fn encode(self, c: f64) -> f64 {
        match self {
            Encoding::Linear => c,
            Encoding::Srgb => srgb_encode_f64(c),
        }
    }

    /// Returns the linear intensity of a stored value, both in 0..=1: the inverse of [`Encoding::encode`].
    pub fn decode(self, stored: f64) -> f64 {
        match self {
            Encoding::Linear => stored,
            Encoding::Srgb => srgb_decode(stored),
        }
    }
}

/// Returns the stored grey level of intensity `c`: 255 c, rounded to the nearest integer.
///
/// `c` is clamped to 0..=1 first; NaN becomes 0. The only `f32` for which 255 c is a half is ½ itself; it gives 128. In
/// `f32` the product is rounded too, so that values within 2⁻¹⁷ of a half may fall on either side of it: far less than
/// shading in `f32` is off by.
///
/// Tried and dropped: exact in `f64`, and a conversion by `as`, whose saturation keeps the loop from being vectorised:
/// both took 4 ns per pixel, a quarter of a flat-shaded frame.
#[inline(always)]
pub fn quantise(c: f32) -> u8 {
    quantise_level(255.0 * c)
}

/// Returns the integer nearest to `level`, which is clamped to 0..=255 first; NaN becomes 0, a half the even one of its neighbours.
#[inline(always)]
pub(crate) fn quantise_level(level: f32) -> u8 {
    /// 2²³: from here on floats are integers, so that adding it rounds, and its lowest bits are the result.
    const INTEGERS: f32 = 8_388_608.0;
    // The comparisons in this order make NaN 0.
    let level = if level > 0.0 { level } else { 0.0 };
    let level = if level < 255.0 { level } else { 255.0 };
    (level + INTEGERS).to_bits() as u8
}

/// Returns the sRGB value of linear intensity `c`, both in 0..=1 (IEC 61966-2-1:1999, 5.2).
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

/// Returns the sRGB value of linear intensity `c` as [`srgb_encode`] does, without rounding to `f32`.
pub fn srgb_encode_f64(c: f64) -> f64 {
    match c <= 0.003_130_8 {
        true => 12.92 * c,
        false => 1.055 * libm::pow(c, 1.0 / 2.4) - 0.055,
    }
}

/// Returns the linear intensity of sRGB value `encoded`, both in 0..=1: the inverse of [`srgb_encode`].
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        return encoded / 12.92;
    }
    libm::pow((encoded + 0.055) / 1.055, 2.4)
}

/// Stores linear pixels with a transfer function, as fast as two table look-ups and as exactly as the function itself.
#[derive(Debug)]
pub struct Encoder {
    /// The least intensity that is stored as each level; one that no intensity reaches at the end.
    least: [f32; 257],
    /// The level of the lowest intensity in each part: parts are the floats of the same upper bits.
    guess: [u8; Encoder::PARTS + 1],
}

impl Encoder {
    /// Bits of a float below those that tell its part: 7 bits of its mantissa are left, 128 parts an octave. The function is steepest for
    /// its octave below 1, where a part of 2⁻⁸ holds 0.7 levels: so no part holds the beginnings of two.
    const BITS: u32 = 16;
    /// Intensities below this, 2⁻¹³, are stored as 0: level 1 begins at 0.5 / 255 / 12.92, above 2⁻¹³.
    const DARK: f32 = 1.0 / 8192.0;
    const PARTS: usize = 13 << (23 - Encoder::BITS);

    /// Makes the encoder of the sRGB transfer function.
    pub fn srgb() -> Self {
        let level = |c: f32| quantise(srgb_encode(c));
        let mut least = [f32::INFINITY; 257];
        least[0] = f32::NEG_INFINITY;
        for (k, c) in least.iter_mut().enumerate().take(256).skip(1) {
            // The inverse of the function at the lower end of the level, then to the very float.
            *c = srgb_decode((k as f64 - 0.5) / 255.0) as f32;
            while level(*c) as usize >= k {
                *c = c.next_down();
            }
            while (level(*c) as usize) < k {
                *c = c.next_up();
            }
        }
        let mut guess = [0; Self::PARTS + 1];
        for (part, guess) in guess.iter_mut().enumerate() {
            *guess = level(Self::first_of(part));
        }
        let encoder = Encoder { least, guess };
        debug_assert!(
            (0..Self::PARTS).all(|part| {
                let last = Self::first_of(part + 1).next_down();
                level(last) <= encoder.guess[part].saturating_add(1)
            }),
            "no part holds the beginnings of two levels"
        );
        encoder
    }

    /// Returns the lowest intensity in a part.
    fn first_of(part: usize) -> f32 {
        f32::from_bits(Self::DARK.to_bits() + ((part as u32) << Self::BITS))
    }

    /// Returns the stored level of intensity `c`: that of [`srgb_encode`] and [`quantise`].
    #[inline(always)]
    pub fn level(&self, c: f32) -> u8 {
        // In this order NaN is stored as 0.
        let c = if c > Self::DARK { c } else { Self::DARK };
        let c = if c < 1.0 { c } else { 1.0 };
        let part = (c.to_bits() - Self::DARK.to_bits()) >> Self::BITS;
        let level = self.guess[part as usize];
        level + u8::from(c >= self.least[usize::from(level) + 1])
    }

    /// Returns a linear pixel as it is stored; alpha has no transfer function.
    #[inline(always)]
    pub fn store(&self, [r, g, b, alpha]: [f32; 4]) -> [u8; 4] {
        [self.level(r), self.level(g), self.level(b), quantise(alpha)]
    }
}

/// Stores a line of linear colours, as [`SpanShader`](crate::shading::SpanShader) shades it, with alpha 255: clamped, and with the transfer
/// function of an encoder, which is made once a program, or linear without one.
pub fn store_line(colours: &[[f32; 3]], encoder: Option<&Encoder>, to: &mut [[u8; 4]]) {
    for (pixel, &[r, g, b]) in to.iter_mut().zip(colours) {
        *pixel = match encoder {
            None => [quantise(r), quantise(g), quantise(b), 255],
            Some(encoder) => encoder.store([r, g, b, 1.0]),
        };
    }
}

/// Returns a linear picture as it is stored.
pub fn store(picture: &LinearPicture, encoding: Encoding) -> Picture8 {
    match encoding {
        Encoding::Linear => picture.map(|pixel| pixel.map(quantise)),
        Encoding::Srgb => {
            let encoder = Encoder::srgb();
            picture.map(|pixel| encoder.store(pixel))
        }
    }
}

/// A stored picture as a screen shows it: in levels of sRGB, not rounded anew; alpha plays no part.
#[derive(Clone, Copy, Debug)]
pub struct Displayed<'a> {
    /// The picture.
    pub picture: &'a Picture8,
    /// Its encoding.
    pub encoding: Encoding,
}

impl LevelRows for Displayed<'_> {
    fn size(&self) -> [usize; 2] {
        [self.picture.width(), self.picture.height()]
    }

    fn level_row(&self, y: usize, levels: &mut [Levels]) {
        let shown: [f64; 256] = core::array::from_fn(|level| match self.encoding {
            Encoding::Srgb => level as f64,
            Encoding::Linear => 255.0 * srgb_encode_f64(level as f64 / 255.0),
        });
        for (levels, [r, g, b, _]) in levels.iter_mut().zip(self.picture.row(y)) {
            let [r, g, b] = [r, g, b].map(|level| shown[usize::from(*level)]);
            *levels = Levels([r, g, b, 255.0]);
        }
    }
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
        assert_eq!(
            quantise(f32::from_bits(0.5f32.to_bits() - 1)),
            127,
            "just below the half"
        );
        assert_eq!(
            [-1.0, -0.0, 1.0, 1.5, f32::INFINITY, f32::NEG_INFINITY].map(quantise),
            [0, 0, 255, 255, 255, 0]
        );
        assert_eq!(quantise(f32::NAN), 0);
    }

    #[test]
    fn srgb_encode_meets_known_values() {
        assert_eq!(srgb_encode(0.0), 0.0);
        assert_eq!(srgb_encode(1.0), 1.0);
        // Each value is in 0.03..1, where a float is spaced by at most 2^-24 = 6e-8; the input's own rounding, at most
        // half of that, is stretched by the slope, at most 12.92 (at the join): 4e-7 in all.
        let known = [
            (0.003_130_8, 0.040_449_936),
            (0.01, 0.099_852_82),
            (0.18, 0.461_356_13),
            (0.5, 0.735_357),
        ];
        for (linear, encoded) in known {
            let got = srgb_encode(linear);
            assert!(
                (got - encoded).abs() <= 4e-7,
                "{linear} became {got}, not {encoded}"
            );
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
    fn the_table_is_the_function() {
        let encoder = Encoder::srgb();
        let same = |c: f32| assert_eq!(encoder.level(c), quantise(srgb_encode(c)), "{c}");
        for step in 0..=100_000 {
            same(step as f32 / 100_000.0);
        }
        for c in &encoder.least[1..256] {
            same(*c);
            same(c.next_down());
        }
        for c in [f32::NAN, -1.0, 2.0, f32::INFINITY, 1.0, 0.0] {
            same(c);
        }
    }
}
