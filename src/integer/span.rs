//! Spans between two normals: how long lines are cut, and what each method sets up.

use super::fast::fast;
use super::light::{Highlight, Light};
use super::material::TOP;
use super::naive::naive;
use super::pixel::Pixel;
use super::quadratic::{NARROW, quadratic, run};
use super::ramp::{Quadratic, Ramp};
use super::reciprocal::{Reciprocal, part};
use super::reciprocal_root::refined_root;
use super::vector::{Bits, Vector, dot, stretched};

/// A span of pixels between two normals: the normal at its first pixel, and the normal at the pixel
/// after its last.
///
/// Its methods shade a line of any length, which may be empty. Each sets up the span first, which
/// takes some 200 instructions for every [`Span::MAX`] pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    pub(super) first: Bits,
    pub(super) end: Bits,
}

impl Span {
    /// The most pixels that are stepped at once. A longer line is cut into pieces, each between its
    /// own two normals, which costs some 100 instructions per piece.
    ///
    /// Second differences drift by n² 2⁻³⁰. Over 256 pixels that is 2⁻¹⁴ of D, an eighth of the
    /// room in its table of roots.
    pub const MAX: usize = 256;

    /// Makes a span from the normals at its first pixel and at the pixel after its last. The
    /// normals between lie on the straight line from one to the other, so only the ratio of their
    /// lengths counts.
    ///
    /// Colours are too dark where a normal on this line is shorter than half the longer end, for
    /// example between unit normals that are more than 120° apart.
    #[inline(always)]
    pub const fn new(first: Vector, end: Vector) -> Self {
        Self::of([first.bits(), end.bits()])
    }

    /// Makes a span from the bits of its normals.
    #[inline(always)]
    const fn of([first, end]: [Bits; 2]) -> Self {
        let span = Self { first, end };
        let (square_first, square_end, both) = span.dots();
        let square_middle = (square_first >> 2) + (square_end >> 2) + (both >> 1);
        let [a, b, least] = [square_first, square_end, 1 << 28];
        let longest = if a > b { a } else { b };
        // The table of roots does not have normals shorter than ½: stretch both, if the longer one
        // is not a unit vector already.
        if (a < least || b < least || square_middle < least) && longest < 1 << 30 {
            let [first, end] = stretched([first, end], longest);
            return Self { first, end };
        }
        span
    }

    /// Shades a line by naive Phong shading.
    ///
    /// Three additions step N (L21 4.2). Each pixel computes J = L·N, K = V·N and D = N·N, reads
    /// 1/√D from a table, and computes R·V = 2 (J/√D)(K/√D) − L·V. `REFINED` adds a step of
    /// Newton's method to the table's root. Its errors are those of [`Span::fast`], to 2⁻¹³ of a
    /// cosine.
    #[inline(always)]
    pub fn naive<P: Pixel, H: Highlight, const REFINED: bool, const L: usize>(
        self,
        line: &mut [P],
        lights: &[Light<'_, P>; L],
    ) {
        self.in_pieces(
            line,
            Self::between,
            #[inline(always)]
            |span, line| {
                let n = Reciprocal::of(line.len());
                naive::<P, H, REFINED, L>(line, span.normals(n), lights);
            },
        );
    }

    /// Shades a line by fast Phong shading (L21 4.2, 4.3, 4.6).
    ///
    /// J and K take one addition each, D two. A table holds 1/√D, which `REFINED` refines by a step
    /// of Newton's method. A pixel takes three products and no division.
    ///
    /// # Error
    ///
    /// The errors below are in grey levels. k_d is the diffuse reflectance, k_s the highlight's, n
    /// its shininess, and d the least D, which is cos² of half the angle between the normals.
    ///
    /// - Diffuse light: k_d (½ + 255 · (2⁻¹³/d + 2⁻¹³)), for half a step of its table, the root,
    ///   and the cuts of J and D.
    /// - Highlight: 255 k_s n (half a step of its table + 2⁻¹¹/d + 2⁻¹⁰), where 2⁻¹¹/d comes from
    ///   the root. Half a step is at most 1/(80 n), which is 3.2 levels of k_s.
    /// - Rounding: ½ a level for the fields, and the rounding of the pixel's format.
    ///
    /// With `REFINED` the root's 2⁻¹³/d becomes 2⁻¹⁴, and 2⁻¹¹/d becomes 2⁻¹².
    #[inline(always)]
    pub fn fast<P: Pixel, H: Highlight, const REFINED: bool, const L: usize>(
        self,
        line: &mut [P],
        lights: &[Light<'_, P>; L],
    ) {
        self.in_pieces(
            line,
            Self::between,
            #[inline(always)]
            |span, line| {
                let n = Reciprocal::of(line.len());
                let (j, k) = span.products::<P, H, L>(lights, n);
                fast::<P, H, REFINED, L>(line, j, k, span.square(n), lights);
            },
        );
    }

    /// Shades a line by parabolas of L·N and of the highlight's cosine, through both ends and the
    /// middle.
    ///
    /// Each takes two additions per pixel and no product. A long line has new parabolas in each
    /// piece.
    ///
    /// # Error
    ///
    /// The error is that of [`Span::fast`] with `REFINED`, plus the part that parabolas leave out.
    /// Over an angle θ between the ends this is at most 0.0241 θ³ of L·N and N·H and 0.0963 θ³ of
    /// R·V, which the highlight multiplies by 255 k_s n. With k_d ½, k_s 0.4 and n = 32 the whole
    /// error is 2.3 grey levels up to 15°, 7 at 30° and 56 at 60°.
    #[inline(always)]
    pub fn quadratic<P: Pixel, H: Highlight, const L: usize>(
        self,
        line: &mut [P],
        lights: &[Light<'_, P>; L],
    ) {
        self.in_pieces(
            line,
            Self::between,
            #[inline(always)]
            |span, line| {
                span.parabolas::<P, H, L>(line, lights);
            },
        );
    }

    /// Calls `shade` for a line, or for its pieces if it is too long for the number formats.
    /// `between` returns the normal at a part of the span, a fraction with 16 bits.
    #[inline(always)]
    pub(super) fn in_pieces<P>(
        self,
        line: &mut [P],
        between: impl Fn(Self, i64) -> Bits,
        mut shade: impl FnMut(Self, &mut [P]),
    ) {
        if line.len() <= Self::MAX {
            shade(self, line);
        } else {
            self.cut(line, between, shade);
        }
    }

    /// Calls `shade` for each piece of a long line. It is a function of its own, never inlined, so
    /// that short lines do not carry its code.
    #[cold]
    #[inline(never)]
    fn cut<P>(
        self,
        line: &mut [P],
        between: impl Fn(Self, i64) -> Bits,
        mut shade: impl FnMut(Self, &mut [P]),
    ) {
        let (pixels, mut first, mut done) = (line.len(), self.first, 0);
        for piece in line.chunks_mut(Self::MAX) {
            done += piece.len();
            let end = if done < pixels {
                between(self, part(done, pixels))
            } else {
                self.end
            };
            shade(Self::of([first, end]), piece);
            first = end;
        }
    }

    /// Returns the normal at a part of the span, on the straight line between its ends.
    pub(super) fn between(self, part: i64) -> Bits {
        let at = |i: usize| {
            let (a, b) = (i64::from(self.first[i]), i64::from(self.end[i]));
            (a + (((b - a) * part + (1 << 15)) >> 16)) as i32
        };
        [at(0), at(1), at(2)]
    }

    /// Shades a line of at most [`Span::MAX`] pixels by parabolas.
    #[inline(always)]
    fn parabolas<P: Pixel, H: Highlight, const L: usize>(
        self,
        line: &mut [P],
        lights: &[Light<'_, P>; L],
    ) {
        let n = Reciprocal::of(line.len());
        let (square_first, square_end, both) = self.dots();
        // |(a + b)/2|² from the three products. Shifting first keeps the sum within 32 bits.
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
        // Between nearly parallel normals parabolas cannot leave their tables, so skip the clamps.
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
        // Half the Q15 difference is the difference in Q14, which `times` expects.
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

    /// Returns N_1·N_1, N_2·N_2 and N_1·N_2 in Q30.
    #[inline(always)]
    pub(super) const fn dots(self) -> (i32, i32, i32) {
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
        // N_1·ΔN = N_1·N_2 − N_1·N_1 is −2 or more, so its half does not overflow. Its Q15 bits are
        // the Q14 bits of 2 N_1·ΔN.
        let slope = ((both >> 1) - (first >> 1) + (1 << 13)) >> 14;
        // ΔN·ΔN = N_1·N_1 + N_2·N_2 − 2 N_1·N_2 is at most 4, so its quarter does not overflow.
        let curve = ((first >> 2) + (end >> 2) - (both >> 1) + (1 << 13)) >> 14;
        Quadratic::polynomial(first, slope, curve, n)
    }
}
