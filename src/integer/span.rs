//! A span between two normals, and its set-up for each method.

use super::fast::fast;
use super::light::{Highlight, Light};
use super::material::TOP;
use super::naive::naive;
use super::pixel::Pixel;
use super::quadratic::{NARROW, quadratic, run};
use super::ramp::{Quadratic, Ramp};
use super::reciprocal::Reciprocal;
use super::reciprocal_root::refined_root;
use super::vector::{Bits, Vector, bits, dot};

/// A span: the normal at its first pixel, and that at the pixel after its last.
///
/// Each method shades a line of up to 1,024 pixels between the two, set-up included: some 200
/// instructions, above 256 pixels with a division. Second differences drift by n² 2⁻³⁰: up to 256
/// pixels that is nothing, at 1,024 it is 2⁻¹⁰ of D.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    pub(super) first: Bits,
    pub(super) end: Bits,
}

impl Span {
    /// Makes a span from its normals, of length ½ to 1.
    #[inline(always)]
    pub const fn new(first: Vector, end: Vector) -> Self {
        Self {
            first: bits(first),
            end: bits(end),
        }
    }

    /// Shades a line by naive Phong shading: see [`naive`] for the errors.
    #[inline(always)]
    pub fn naive<P: Pixel, H: Highlight, const REFINED: bool, const L: usize>(
        self,
        line: &mut [P],
        lights: &[Light<'_, P>; L],
    ) {
        let n = Reciprocal::of(line.len());
        naive::<P, H, REFINED, L>(line, self.normals(n), lights);
    }

    /// Shades a line by fast Phong shading: see [`fast`] for the errors.
    #[inline(always)]
    pub fn fast<P: Pixel, H: Highlight, const REFINED: bool, const L: usize>(
        self,
        line: &mut [P],
        lights: &[Light<'_, P>; L],
    ) {
        let n = Reciprocal::of(line.len());
        let (j, k) = self.products::<P, H, L>(lights, n);
        fast::<P, H, REFINED, L>(line, j, k, self.square(n), lights);
    }

    /// Shades a line by parabolas through both ends and the middle: see [`quadratic`] for the errors.
    #[inline(always)]
    pub fn quadratic<P: Pixel, H: Highlight, const L: usize>(
        self,
        line: &mut [P],
        lights: &[Light<'_, P>; L],
    ) {
        let n = Reciprocal::of(line.len());
        let (square_first, square_end, both) = self.dots();
        // |(a + b)/2|² from the three products.
        let square_middle = (square_first >> 2) + (square_end >> 2) + (both >> 1);
        let r = [square_first, square_middle, square_end].map(refined_root);
        let unit = |v: Bits| {
            let (a, b) = (dot(v, self.first) >> 15, dot(v, self.end) >> 15);
            [
                (a * r[0]) >> 15,
                (((a + b) >> 1) * r[1]) >> 15,
                (b * r[2]) >> 15,
            ]
        };
        let shared = if H::IS_SEEN {
            unit(H::k_of(&lights[0]))
        } else {
            [0; 3]
        };
        let mut l_n = [Quadratic::default(); L];
        let mut cosine = l_n;
        let mut i = 0;
        while i < L {
            let j = unit(lights[i].toward);
            l_n[i] = Quadratic::through(j, n);
            if H::IS_SEEN {
                let k = if i == 0 || H::SHARES_K {
                    shared
                } else {
                    unit(H::k_of(&lights[i]))
                };
                let s = |at: usize| TOP - H::below(&lights[i], j[at], k[at]);
                cosine[i] = Quadratic::through([s(0), s(1), s(2)], n);
            }
            i += 1;
        }
        if both >= NARROW {
            run::<P, H, false, L>(line, l_n, cosine, lights);
        } else {
            quadratic::<P, H, L>(line, l_n, cosine, lights);
        }
    }

    /// Returns the normal along the span (L21 4.1).
    #[inline(always)]
    pub(super) fn normals(self, n: Reciprocal) -> [Ramp; 3] {
        let (a, b): (Bits, Bits) = (self.first, self.end);
        // Half of the difference has the 14 fractional bits that the reciprocal takes.
        let ramp = |i: usize| Ramp::from_bits(a[i] << 15, n.times((b[i] - a[i]) >> 1)); // 4.1
        [ramp(0), ramp(1), ramp(2)]
    }

    /// Returns J and K of each light along the span (L21 4.3).
    #[inline(always)]
    pub(super) fn products<P, H: Highlight, const L: usize>(
        self,
        lights: &[Light<'_, P>; L],
        n: Reciprocal,
    ) -> ([Ramp; L], [Ramp; L]) {
        let along = |v: Bits| Ramp::between(dot(v, self.first), dot(v, self.end), n);
        let (mut j, mut k) = ([Ramp::default(); L], [Ramp::default(); L]);
        let mut i = 0;
        while i < L {
            j[i] = along(lights[i].toward); // 4.3
            if H::IS_SEEN && (i == 0 || !H::SHARES_K) {
                k[i] = along(H::k_of(&lights[i]));
            }
            i += 1;
        }
        (j, k)
    }

    /// Returns N_1·N_1, N_2·N_2 and N_1·N_2 with 30 fractional bits.
    #[inline(always)]
    pub(super) fn dots(self) -> (i32, i32, i32) {
        (
            dot(self.first, self.first),
            dot(self.end, self.end),
            dot(self.first, self.end),
        )
    }

    /// Returns D = N·N along the span: with t = i/n and ΔN = N_2 − N_1,
    /// D(t) = N_1·N_1 + 2 t N_1·ΔN + t² ΔN·ΔN.
    #[inline(always)]
    pub(super) fn square(self, n: Reciprocal) -> Quadratic {
        let (first, end, both) = self.dots();
        // N_1·ΔN = N_1·N_2 − N_1·N_1, of which 15 fractional bits are 14 of its double. It is −2 or
        // more: halves do not overflow.
        let slope = ((both >> 1) - (first >> 1) + (1 << 13)) >> 14;
        // ΔN·ΔN = N_1·N_1 + N_2·N_2 − 2 N_1·N_2, at most 4: quarters do not.
        let curve = ((first >> 2) + (end >> 2) - (both >> 1) + (1 << 13)) >> 14;
        Quadratic::polynomial(first, slope, curve, n)
    }
}
