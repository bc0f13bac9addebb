//! A span between two normals, its pieces, and its set-up for each method.

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

/// A span: the normal at its first pixel, and that at the pixel after its last.
///
/// Each method shades a line of any length between the two, set-up included: some 200 instructions for each
/// [`Span::MAX`] pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    pub(super) first: Bits,
    pub(super) end: Bits,
}

impl Span {
    /// The most pixels that are stepped at once. A longer line is cut into pieces, each between its own two normals, for some 100
    /// instructions a piece.
    ///
    /// Second differences drift by n² 2⁻³⁰: over 256 pixels that is 2⁻¹⁴ of D, an eighth of what its table of roots has room for.
    pub const MAX: usize = 256;

    /// Makes a span from its normals: those of its pixels lie on the line between them. Only the ratio of their lengths counts.
    ///
    /// Where a normal on this line is shorter than half of the longer end, as between unit normals that are more than 120° apart, colours
    /// are too dark.
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
        // Normals shorter than ½ are not in the table of roots: both are made longer if that helps.
        if (a < least || b < least || square_middle < least) && longest < 1 << 30 {
            let [first, end] = stretched([first, end], longest);
            return Self { first, end };
        }
        span
    }

    /// Shades a line by naive Phong shading: see [`naive`] for the errors.
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

    /// Shades a line by fast Phong shading: see [`fast`] for the errors.
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

    /// Shades a line by parabolas through both ends and the middle: see [`quadratic`] for the errors.
    ///
    /// Each piece of a long line has its own parabolas.
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

    /// Calls `shade` for a line, or for pieces of it if it is too long for the formats. `between` returns the normal at a part of
    /// the span, which has 16 fractional bits.
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

    /// Calls `shade` for the pieces of a long line.
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

    /// Returns the normal at a part of the span, on the line between its ends.
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
        // N_1·ΔN = N_1·N_2 − N_1·N_1, of which 15 fractional bits are 14 of its double. It is −2 or
        // more: halves do not overflow.
        let slope = ((both >> 1) - (first >> 1) + (1 << 13)) >> 14;
        // ΔN·ΔN = N_1·N_1 + N_2·N_2 − 2 N_1·N_2, at most 4: quarters do not.
        let curve = ((first >> 2) + (end >> 2) - (both >> 1) + (1 << 13)) >> 14;
        Quadratic::polynomial(first, slope, curve, n)
    }
}
