//! Materials: tables of colours, which the compiler computes.

use super::pixel::{Pixel, fields, half};
use core::marker::PhantomData;
use fixed::types::U16F16;

/// The scale of unit light directions, 255/256 in Q15. With it no cosine reaches 1, where its index
/// of 8 bits would wrap.
pub(super) const SCALE: i32 = 32640;

/// The cosine at the top of the table of highlights, in Q15. It leaves room above [`SCALE`] for the
/// error of 1/√D, with which R·V exceeds 1 by 2⁻⁸ at D = ¼.
pub(super) const TOP: i32 = SCALE + 160;

/// How many entries a table of highlights has. With 256, half a step at shininess 32 would be 4
/// levels of k_s.
const HIGHLIGHTS: usize = 512;

/// A material in the colour of one light: tables of 512 colours by L·N and 512 by R·V or N·H, 4 KB
/// in all.
///
/// Make it a `static`: then the compiler computes the tables, and they stay in read-only memory.
#[derive(Clone, Debug)]
pub struct Material<P> {
    /// Ambient and diffuse colour by L·N, in steps of 1/255, with the ½ that rounds. The index has
    /// 9 bits, so negative L·N wrap to the second half: there is only ambient colour.
    pub(super) diffuse: [u32; 512],
    /// Highlight by ([`TOP`] − cosine) >> `shift`.
    pub(super) highlight: [u32; HIGHLIGHTS],
    pub(super) shift: u32,
    /// How many entries `highlight` has up to the last one that is not black.
    pub(super) seen: usize,
    format: PhantomData<P>,
}

impl<P: Pixel> Material<P> {
    /// Makes the tables of I_a k_a + I_p k_d (L·N) and I_p k_s (R·V)ⁿ (L21 2.1) for red, green and
    /// blue.
    ///
    /// Each argument is a product of light and material, like I_a k_a, and 1 is the brightest
    /// colour of a pixel. Sums above 1 are clamped. Of several lights, pass the ambient colour to
    /// one only. Shininess n is 1 to about 1,000.
    ///
    /// The highlight's table covers the cosines whose power is at least 2⁻⁹, in up to 512 steps. It
    /// leaves out smaller ones.
    ///
    /// It computes in 64-bit integers, so call it in a `static` or `const`, not at run time.
    pub const fn new(
        ambient: [U16F16; 3],
        diffuse: [U16F16; 3],
        highlight: [U16F16; 3],
        shininess: u32,
    ) -> Self {
        let mut made = Self {
            diffuse: [0; 512],
            highlight: [0; HIGHLIGHTS],
            shift: shift_for(shininess),
            seen: 0,
            format: PhantomData,
        };
        // Each entry holds the colour in the middle of its step, which halves the largest error.
        let mut i = 0;
        while i < 512 {
            let lit = if i < 256 { 2 * i as u64 + 1 } else { 0 };
            let mut sum = [0; 3];
            let mut c = 0;
            while c < 3 {
                sum[c] = ambient[c].to_bits() as u64 + diffuse[c].to_bits() as u64 * lit / 510;
                c += 1;
            }
            made.diffuse[i] = fields::<P>(sum) + half::<P>();
            i += 1;
        }
        let mut i = 0;
        while i < HIGHLIGHTS {
            let middle = ((i as i32) << made.shift) + (1 << made.shift >> 1);
            let power = power(TOP - middle, shininess);
            let mut shine = [0; 3];
            let mut c = 0;
            while c < 3 {
                shine[c] = (highlight[c].to_bits() as u64 * power) >> 30;
                c += 1;
            }
            made.highlight[i] = fields::<P>(shine);
            if made.highlight[i] != 0 {
                made.seen = i + 1;
            }
            i += 1;
        }
        made
    }
}

/// Returns the finest step with which a table of highlights reaches down to a power of 2⁻⁹, as a
/// shift of Q15 cosines.
pub(super) const fn shift_for(shininess: u32) -> u32 {
    let mut shift = 0;
    while shift < 6 && power(TOP - ((HIGHLIGHTS as i32) << shift), shininess) > 1 << 21 {
        shift += 1;
    }
    shift
}

/// Returns (cosine / [`SCALE`])ⁿ in Q30, clamped to 0–1.
const fn power(cosine: i32, n: u32) -> u64 {
    if cosine <= 0 {
        return 0;
    }
    let cosine = if cosine < SCALE { cosine } else { SCALE } as u64;
    let (mut base, mut result, mut left) = ((cosine << 30) / SCALE as u64, 1 << 30, n);
    while left > 0 {
        if left & 1 == 1 {
            result = (result * base) >> 30;
        }
        base = (base * base) >> 30;
        left >>= 1;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::super::pixel::Rgb888;
    use super::*;

    #[test]
    fn powers_are_exact_to_their_cuts() {
        for n in [1, 2, 5, 32, 100, 1000] {
            for cosine in [1, 1000, 20000, 30000, 32000, SCALE - 1, SCALE, TOP] {
                let exact = f64::from(cosine.min(SCALE)) / f64::from(SCALE);
                let error = power(cosine, n) as f64 / f64::from(1 << 30) - exact.powi(n as i32);
                // Each of 20 products and the quotient cuts a unit, and the power multiplies its
                // error by n.
                assert!(
                    error.abs() < 4e-9 * f64::from(n) + 2e-8,
                    "{n} {cosine}: {error}"
                );
            }
        }
    }

    #[test]
    fn tables_cover_what_can_be_seen() {
        let white = [U16F16::ONE; 3];
        for (n, shift) in [(1, 6), (4, 6), (8, 6), (16, 5), (32, 4), (128, 2), (800, 0)] {
            let material = Material::<Rgb888>::new([U16F16::ZERO; 3], white, white, n);
            assert_eq!(material.shift, shift, "shininess {n}");
            assert_eq!(
                Rgb888::from_fields(material.highlight[0] + half::<Rgb888>()).0,
                [255; 3]
            );
            assert!(Rgb888::from_fields(material.highlight[HIGHLIGHTS - 1]).0[0] <= 1);
        }
    }

    /// Sums above 1 are clamped, and exponents of any size have a table.
    #[test]
    fn materials_of_any_numbers_keep_their_fields() {
        let ends = [U16F16::ZERO, U16F16::ONE, U16F16::MAX];
        for shininess in [0, 1, 1000, u32::MAX] {
            for a in ends {
                for b in ends {
                    let material = Material::<Rgb888>::new([a; 3], [b; 3], [b; 3], shininess);
                    let all = (material.diffuse.iter()).chain(&material.highlight);
                    let others = 1 << 31 | 1 << 20 | 1 << 10 | 1 << 9;
                    assert!(all.clone().all(|fields| fields & others == 0));
                }
            }
        }
    }
}
