//! Transfer functions: from computed intensities to stored grey levels, and back.

use super::{LinearPicture, Picture, Picture8};

/// How linear intensities are stored in eight bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
#[cfg_attr(feature = "io", serde(rename_all = "lowercase"))]
pub enum Encoding {
    /// No transfer function: round(255 c).
    #[default]
    Linear,
    /// The sRGB transfer function (IEC 61966-2-1), then rounding.
    Srgb,
}

impl Encoding {
    /// Every encoding.
    pub const ALL: [Encoding; 2] = [Encoding::Linear, Encoding::Srgb];

    /// Returns the name on the command line and in data.
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

    /// Returns the linear intensity of a stored value, both in 0..=1: the inverse of
    /// [`Encoding::encode`].
    pub fn decode(self, stored: f64) -> f64 {
        match self {
            Encoding::Linear => stored,
            Encoding::Srgb => srgb_decode(stored),
        }
    }
}

/// Returns the stored grey level of intensity `c`: 255 c, rounded to the nearest integer.
///
/// `c` is first clamped to 0..=1; NaN becomes 0. The only `f32` for which 255 c is exactly a half
/// is ½, and it returns 128. The product is rounded in `f32`, so values within 2⁻¹⁷ of a half may
/// fall on either side of it. That is far less than the error of shading in `f32`.
///
/// The conversion avoids `as`, because its saturation keeps the compiler from vectorising the loop.
#[inline(always)]
pub fn quantise(c: f32) -> u8 {
    quantise_level(255.0 * c)
}

/// Returns the integer nearest to `level`, clamped to 0..=255. NaN becomes 0, and a half is rounded
/// to the even neighbour.
#[inline(always)]
pub(crate) fn quantise_level(level: f32) -> u8 {
    /// 2²³: floats from here on are integers. Adding it therefore rounds, and leaves the result in
    /// the lowest bits.
    const INTEGERS: f32 = 8_388_608.0;
    // NaN fails the first comparison and becomes 0. Swapping the two lines would make it 255.
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
/// Values below 0 stay on the straight line, and values above 1 on the curve. NaN stays NaN.
pub fn srgb_encode(c: f32) -> f32 {
    if c <= 0.003_130_8 {
        return 12.92 * c;
    }
    // Computed in f64, so that 1 becomes 1 and not the float just below it.
    (1.055 * libm::pow(f64::from(c), 1.0 / 2.4) - 0.055) as f32
}

/// Returns the sRGB value of linear intensity `c`, as [`srgb_encode`] does, without rounding to
/// `f32`.
pub(crate) fn srgb_encode_f64(c: f64) -> f64 {
    if c <= 0.003_130_8 {
        12.92 * c
    } else if c == 1.0 {
        // The formula gives the number just below it, and white would differ from white.
        1.0
    } else {
        1.055 * libm::pow(c, 1.0 / 2.4) - 0.055
    }
}

/// Returns the linear intensity of the sRGB value `encoded`, both in 0..=1. This inverts
/// [`srgb_encode`].
pub(crate) fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 {
        return encoded / 12.92;
    }
    libm::pow((encoded + 0.055) / 1.055, 2.4)
}

/// A fast and exact encoder of linear pixels: two table look-ups return the very level that the
/// transfer function does.
///
/// The upper bits of an intensity, as a float, select an entry of a table of guesses. A guess is
/// either right or one level too low, and a comparison with the least intensity of the next level
/// decides.
#[derive(Debug)]
pub struct Encoder {
    /// The least intensity that is stored as each level. One more entry at the end, which no
    /// intensity reaches, stops the comparison at level 255.
    least: [f32; 257],
    /// The level of the lowest intensity in each part. A part holds the floats that share their
    /// upper bits.
    guess: [u8; Encoder::PARTS + 1],
}

impl Encoder {
    /// How many low bits of a float do not select the part. 7 bits of the mantissa do, so that an
    /// octave has 128 parts. The function is steepest, for its octave, just below 1. A part there
    /// is 2⁻⁸ wide and spans 0.7 levels, so no part holds the starts of two levels.
    const BITS: u32 = 16;
    /// Intensities below 2⁻¹³ are stored as 0, because level 1 begins at 0.5 / 255 / 12.92, which
    /// is above 2⁻¹³.
    const DARK: f32 = 1.0 / 8192.0;
    const PARTS: usize = 13 << (23 - Encoder::BITS);

    /// Returns the encoder of the sRGB transfer function. Its table is compiled into the program.
    pub fn srgb() -> &'static Self {
        static SRGB: Encoder = Encoder::of(&LEAST);
        &SRGB
    }

    /// Makes an encoder from the bits of the least intensity of each level from 1 to 255.
    const fn of(bits: &[u32; 255]) -> Self {
        let mut least = [f32::INFINITY; 257];
        least[0] = f32::NEG_INFINITY;
        let mut level = 1;
        while level < 256 {
            least[level] = f32::from_bits(bits[level - 1]);
            level += 1;
        }
        let mut guess = [0; Self::PARTS + 1];
        let (mut part, mut level) = (0, 0);
        while part <= Self::PARTS {
            while level < 255 && least[level + 1] <= Self::first_of(part) {
                level += 1;
            }
            guess[part] = level as u8;
            part += 1;
        }
        Encoder { least, guess }
    }

    /// Returns the lowest intensity in a part.
    const fn first_of(part: usize) -> f32 {
        f32::from_bits(Self::DARK.to_bits() + ((part as u32) << Self::BITS))
    }

    /// Returns the stored level of intensity `c`, equal to `quantise(srgb_encode(c))`.
    #[inline(always)]
    pub fn level(&self, c: f32) -> u8 {
        // NaN fails the first comparison and is stored as 0.
        let c = if c > Self::DARK { c } else { Self::DARK };
        let c = if c < 1.0 { c } else { 1.0 };
        // `c` is positive, and the bits of positive floats are ordered as the floats are.
        let part = (c.to_bits() - Self::DARK.to_bits()) >> Self::BITS;
        let level = self.guess[part as usize];
        level + u8::from(c >= self.least[usize::from(level) + 1])
    }

    /// Returns a linear pixel as it is stored. Alpha has no transfer function.
    #[inline(always)]
    pub fn store(&self, [r, g, b, alpha]: [f32; 4]) -> [u8; 4] {
        [self.level(r), self.level(g), self.level(b), quantise(alpha)]
    }
}

/// The bits of the least intensity that the sRGB transfer function stores as each level above 0.
/// The test `the_least_intensities_are_those_of_the_function` searches for them and compares.
/// Computing them at start-up would take 2,000 powers.
#[rustfmt::skip]
const LEAST: [u32; 255] = [
    0x391f_22b5, 0x39ee_b40e, 0x3a46_eb62, 0x3a8b_3e5d, 0x3ab3_070c, 0x3ada_cfb7, 0x3b01_4c33, 0x3b15_3089,
    0x3b29_14e1, 0x3b3c_f936, 0x3b50_f2d2, 0x3b65_fb9a, 0x3b7c_3404, 0x3b89_d05f, 0x3b96_2334, 0x3ba3_14bd,
    0x3bb0_a732, 0x3bbe_dcb7, 0x3bcd_b76f, 0x3bdd_3967, 0x3bed_64b1, 0x3bfe_3b46, 0x3c07_df92, 0x3c10_f91a,
    0x3c1a_6b33, 0x3c24_36c7, 0x3c2e_5cc8, 0x3c38_de19, 0x3c43_bba5, 0x3c4e_f647, 0x3c5a_8ee5, 0x3c66_8653,
    0x3c72_dd74, 0x3c7f_950f, 0x3c86_5704, 0x3c8d_148f, 0x3c94_0397, 0x3c9b_247c, 0x3ca2_77a8, 0x3ca9_fd77,
    0x3cb1_b654, 0x3cb9_a298, 0x3cc1_c2aa, 0x3cca_16e2, 0x3cd2_9fa6, 0x3cdb_5d4a, 0x3ce4_5034, 0x3ced_78b4,
    0x3cf6_d730, 0x3d00_35fb, 0x3d05_1bb5, 0x3d0a_1cec, 0x3d0f_39d1, 0x3d14_728a, 0x3d19_c746, 0x3d1f_382b,
    0x3d24_c568, 0x3d2a_6f21, 0x3d30_3585, 0x3d36_18b7, 0x3d3c_18e5, 0x3d42_3631, 0x3d48_70ca, 0x3d4e_c8d1,
    0x3d55_3e76, 0x3d5b_d1d3, 0x3d62_831c, 0x3d69_526a, 0x3d70_3ff2, 0x3d77_4bca, 0x3d7e_7627, 0x3d82_df90,
    0x3d86_9374, 0x3d8a_56cb, 0x3d8e_29ad, 0x3d92_0c27, 0x3d95_fe51, 0x3d9a_0035, 0x3d9e_11ee, 0x3da2_3384,
    0x3da6_6512, 0x3daa_a6a0, 0x3dae_f849, 0x3db3_5a15, 0x3db7_cc1d, 0x3dbc_4e6a, 0x3dc0_e116, 0x3dc5_8428,
    0x3dca_37bb, 0x3dce_fbd5, 0x3dd3_d091, 0x3dd8_b5f5, 0x3ddd_ac1b, 0x3de2_b309, 0x3de7_cadb, 0x3dec_f395,
    0x3df2_2d52, 0x3df7_7817, 0x3dfc_d3fe, 0x3e01_2087, 0x3e03_dfaf, 0x3e06_a77b, 0x3e09_77f7, 0x3e0c_5126,
    0x3e0f_3315, 0x3e12_1dc5, 0x3e15_1144, 0x3e18_0d95, 0x3e1b_12c3, 0x3e1e_20d1, 0x3e21_37cc, 0x3e24_57b5,
    0x3e27_809a, 0x3e2a_b27c, 0x3e2d_ed69, 0x3e31_3160, 0x3e34_7e71, 0x3e37_d49b, 0x3e3b_33ed, 0x3e3e_9c66,
    0x3e42_0e15, 0x3e45_88fa, 0x3e49_0d23, 0x3e4c_9a8f, 0x3e50_314d, 0x3e53_d15c, 0x3e57_7acb, 0x3e5b_2d99,
    0x3e5e_e9d6, 0x3e62_af7c, 0x3e66_7ea1, 0x3e6a_573c, 0x3e6e_3964, 0x3e72_250f, 0x3e76_1a54, 0x3e7a_192a,
    0x3e7e_21a6, 0x3e81_19e1, 0x3e83_27c8, 0x3e85_3a85, 0x3e87_5223, 0x3e89_6e9c, 0x3e8b_8ffd, 0x3e8d_b640,
    0x3e8f_e171, 0x3e92_118a, 0x3e94_4697, 0x3e96_8093, 0x3e98_bf8a, 0x3e9b_0376, 0x3e9d_4c62, 0x3e9f_9a4a,
    0x3ea1_ed39, 0x3ea4_4529, 0x3ea6_a227, 0x3ea9_042c, 0x3eab_6b45, 0x3ead_d76b, 0x3eb0_48ab, 0x3eb2_beff,
    0x3eb5_3a72, 0x3eb7_baff, 0x3eba_40b2, 0x3ebc_cb84, 0x3ebf_5b82, 0x3ec1_f0a5, 0x3ec4_8afa, 0x3ec7_2a7b,
    0x3ec9_cf33, 0x3ecc_791c, 0x3ecf_2843, 0x3ed1_dca0, 0x3ed4_9642, 0x3ed7_551f, 0x3eda_1947, 0x3edc_e2b0,
    0x3edf_b168, 0x3ee2_8569, 0x3ee5_5ebe, 0x3ee8_3d61, 0x3eeb_215e, 0x3eee_0aae, 0x3ef0_f960, 0x3ef3_ed69,
    0x3ef6_e6d8, 0x3ef9_e5a6, 0x3efc_e9df, 0x3eff_f37c, 0x3f01_8145, 0x3f03_0b81, 0x3f04_9878, 0x3f06_2826,
    0x3f07_ba92, 0x3f09_4fb8, 0x3f0a_e79f, 0x3f0c_8243, 0x3f0e_1fab, 0x3f0f_bfd1, 0x3f11_62be, 0x3f13_086d,
    0x3f14_b0e5, 0x3f16_5c21, 0x3f18_0a29, 0x3f19_baf8, 0x3f1b_6e96, 0x3f1d_24fd, 0x3f1e_de36, 0x3f20_9a3b,
    0x3f22_5913, 0x3f24_1aba, 0x3f25_df38, 0x3f27_a687, 0x3f29_70af, 0x3f2b_3dab, 0x3f2d_0d83, 0x3f2e_e031,
    0x3f30_b5bd, 0x3f32_8e22, 0x3f34_6969, 0x3f36_478a, 0x3f38_288f, 0x3f3a_0c71, 0x3f3b_f33a, 0x3f3d_dce3,
    0x3f3f_c975, 0x3f41_b8e9, 0x3f43_ab48, 0x3f45_a08d, 0x3f47_98bf, 0x3f49_93d9, 0x3f4b_91e3, 0x3f4d_92d7,
    0x3f4f_96bd, 0x3f51_9d90, 0x3f53_a758, 0x3f55_b40f, 0x3f57_c3be, 0x3f59_d65d, 0x3f5b_ebf7, 0x3f5e_0484,
    0x3f60_200e, 0x3f62_3e8e, 0x3f64_600c, 0x3f66_8483, 0x3f68_abfb, 0x3f6a_d66e, 0x3f6d_03e5, 0x3f6f_3458,
    0x3f71_67d2, 0x3f73_9e4b, 0x3f75_d7cc, 0x3f78_144f, 0x3f7a_53dd, 0x3f7c_966f, 0x3f7e_dc10,
];

/// Stores a line of linear colours, as [`SpanShader`](crate::shading::SpanShader) returns them,
/// with alpha 255. Colours are clamped, then stored through `encoder`, or linearly if there is
/// none.
pub fn store_line(colours: &[[f32; 3]], encoder: Option<&Encoder>, to: &mut [[u8; 4]]) {
    for (pixel, &[r, g, b]) in to.iter_mut().zip(colours) {
        *pixel = match encoder {
            None => [quantise(r), quantise(g), quantise(b), 255],
            Some(encoder) => encoder.store([r, g, b, 1.0]),
        };
    }
}

/// Returns a linear picture as it is stored in this encoding.
pub fn store(picture: &LinearPicture, encoding: Encoding) -> Picture8 {
    match encoding {
        Encoding::Linear => picture.map(|pixel| pixel.map(quantise)),
        Encoding::Srgb => {
            let encoder = Encoder::srgb();
            picture.map(|pixel| encoder.store(pixel))
        }
    }
}

/// Returns a linear picture in `f64` as it is stored in this encoding.
pub fn store_f64(picture: &Picture<[f64; 4]>, encoding: Encoding) -> Picture8 {
    match encoding {
        Encoding::Linear => picture.map(|pixel| pixel.map(|c| libm::round(255.0 * c) as u8)),
        Encoding::Srgb => store(&picture.map(|pixel| pixel.map(|c| c as f32)), encoding),
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
        assert_eq!(srgb_encode_f64(1.0), 1.0);
        // Each value is in 0.03..1, where floats are at most 2^-24 = 6e-8 apart. The input's own
        // rounding, at most half of that, is stretched by the slope, at most 12.92 (at the join).
        // Together: 4e-7.
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

    /// Searches for each least intensity, to the very float, starting at the inverse of the
    /// function.
    #[test]
    fn the_least_intensities_are_those_of_the_function() {
        let level = |c: f32| usize::from(quantise(srgb_encode(c)));
        for (k, bits) in (1..).zip(LEAST) {
            let mut c = srgb_decode((k as f64 - 0.5) / 255.0) as f32;
            while level(c) >= k {
                c = c.next_down();
            }
            while level(c) < k {
                c = c.next_up();
            }
            assert_eq!(bits, c.to_bits(), "level {k}: {c}");
        }
    }

    /// No part holds the starts of two levels.
    #[test]
    fn a_guess_is_off_by_one_level_at_most() {
        let encoder = Encoder::srgb();
        for part in 0..Encoder::PARTS {
            let last = Encoder::first_of(part + 1).next_down();
            let [first, last] = [Encoder::first_of(part), last].map(|c| quantise(srgb_encode(c)));
            assert_eq!(encoder.guess[part], first, "part {part}");
            assert!(last <= first.saturating_add(1), "part {part}");
        }
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
