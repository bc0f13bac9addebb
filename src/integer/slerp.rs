//! Phong shading with normals on great circles: a recurrence steps J and K, without a root.

use super::light::{Highlight, Light, shade};
use super::pixel::Pixel;
use super::reciprocal::Reciprocal;
use super::span::Span;
use super::vector::{Bits, dot, narrowed, unit_bits, wide_direction, widened};

impl Span {
    /// Shades a line with normals that turn at a uniform rate (L21 4.7, 4.8). The lengths of the
    /// normals do not matter.
    ///
    /// J(t) = L·slerp(N_1, N_2, t) is a sine wave, so J_next = J + ΔJ and ΔJ_next = ΔJ − α J_next
    /// with α = 2 (1 − cos φ), where φ is the angle per pixel. These are equations 4.9–4.12 in
    /// difference form, with one product instead of the lecture's eight. J and K are cosines of
    /// unit normals, so there is no root to compute.
    ///
    /// # Error
    ///
    /// The error is that of [`Span::fast`], with the drift of the recurrence in place of the root's
    /// error: 2⁻¹² up to 45° and 2⁻¹¹ up to 60°. It comes mostly from the cut of α. Beyond 60° the
    /// series of θ² leaves out more, and beyond 90° colours are wrong.
    #[inline(always)]
    pub fn slerp<P: Pixel, H: Highlight>(self, line: &mut [P], light: &Light<'_, P>) {
        let span = Self {
            first: unit_bits(self.first),
            end: unit_bits(self.end),
        };
        span.in_pieces(
            line,
            Self::on_circle,
            #[inline(always)]
            |span, line| {
                span.waves::<P, H>(line, light);
            },
        );
    }

    /// Returns the unit normal at a part of the span, on the great circle between its ends. It
    /// halves the arc 16 times: the middle between two unit vectors has the direction of their sum.
    fn on_circle(self, part: i64) -> Bits {
        // In Q30.
        let [mut a, mut b] = [self.first, self.end].map(|n| widened(n).map(|x| x << 15));
        let mut bit = 1 << 15;
        while bit > 0 {
            let middle = wide_direction([a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
            if part & bit == 0 {
                b = middle;
            } else {
                a = middle;
            }
            bit >>= 1;
        }
        narrowed(a)
    }

    /// Shades a line of at most [`Span::MAX`] pixels between unit normals.
    #[inline(always)]
    fn waves<P: Pixel, H: Highlight>(self, line: &mut [P], light: &Light<'_, P>) {
        let wave = Wave::new(self, line.len());
        let (mut j, mut j_step) = wave.start(self, light.toward);
        let (mut k, mut k_step) = wave.start(self, H::k_of(light));
        let lights = &[*light];
        for pixel in line {
            // J from Q30 to the Q31 of `shade`, and both to Q15 for the highlight.
            let cosines = (j << 1, H::below(light, j >> 15, k >> 15));
            *pixel = P::from_fields(shade::<P, H, 1>(lights, |_| cosines));
            (j, j_step) = wave.next(j, j_step);
            if H::IS_SEEN {
                (k, k_step) = wave.next(k, k_step);
            }
        }
    }
}

/// The constants that all sine waves of a span share. θ is the angle between its normals, and φ =
/// θ/n.
struct Wave {
    /// α = 2 (1 − cos φ) is `alpha` · 2^−(15 + `shift`).
    alpha: i32,
    shift: u32,
    n: Reciprocal,
    /// cos θ in Q15.
    cosine: i32,
    /// n sin φ / sin θ in Q14.
    gain: i32,
}

impl Wave {
    #[inline(always)]
    fn new(span: Span, pixels: usize) -> Self {
        // A span of one pixel shows only its first value, so the steps for two do no harm.
        let n = Reciprocal::of(pixels.max(2));
        // α needs a shift of at least 2. For n = 2 the shift is 1 and the mantissa 2¹⁴, which has
        // room for one more bit.
        let (mantissa, shift) = if n.shift < 2 {
            (2 * n.mantissa as u32, n.shift + 1)
        } else {
            (n.mantissa as u32, n.shift)
        };
        let cosine = dot(span.first, span.end);
        // x = 1 − cos θ in Q15, clamped at 90°.
        let x = (((1 << 30) - cosine.clamp(0, 1 << 30)) >> 15) as u32;
        // θ² = 2x (1 + x/6 + 2x²/45 + x³/70 + …) in Q15, below 2.5.
        let tail = 5461 + ((x * (1456 + ((x * 468) >> 15))) >> 15);
        let square = 2 * ((x * (32768 + ((x * tail) >> 15))) >> 15);
        // θ / sin θ = 1 + θ²/6 + 7θ⁴/360 + 31θ⁶/15120 + … in Q14.
        let over_sine =
            16384 + ((square * (2731 + ((square * (319 + ((square * 34) >> 15))) >> 15))) >> 15);
        // φ² = `turn` 2^−(15 + 2 shift): below 2^18.3, both products below 2³².
        let turn = (((square * mantissa) >> 15) * mantissa) >> 13;
        // φ² itself, in Q15.
        let small = turn >> (2 * shift);
        // α = φ² (1 − φ²/12 + …) and sin φ / φ = 1 − φ²/6 + …
        let alpha = (turn - (((turn >> 2) * small) >> 13) / 12) >> 3;
        let gain = over_sine - ((over_sine * small) >> 15) / 6;
        Self {
            alpha: alpha as i32,
            shift: 2 * shift - 3,
            n,
            cosine: cosine >> 15,
            gain: gain as i32,
        }
    }

    /// Returns v·N_1 and its first difference along the great circle, in Q30.
    #[inline(always)]
    fn start(&self, span: Span, v: [i32; 3]) -> (i32, i32) {
        let (first, end) = (dot(v, span.first) >> 15, dot(v, span.end) >> 15);
        // f(φ) − f(0) = (f_2 − f_1 cos θ) sin φ / sin θ − f_1 (1 − cos φ), where 1 − cos φ = α/2:
        // hence the extra shift by 1.
        let aside = end - ((first * self.cosine) >> 15); // below 2¹⁶, the gain below 2^14.7
        let rise = self.n.times((aside * self.gain) >> 15); // 4.8
        let fall = (first * self.alpha) >> self.shift >> 1;
        (first << 15, rise.wrapping_sub(fall))
    }

    /// Returns the next value and difference. α is below 2^15.4, so the product is below 2³¹.
    ///
    /// The difference uses the new value, not the old one: that makes the recurrence exact, where
    /// the old one would let the wave grow.
    #[inline(always)]
    fn next(&self, at: i32, step: i32) -> (i32, i32) {
        let next = at.wrapping_add(step);
        (
            next,
            step.wrapping_sub((next >> 15).wrapping_mul(self.alpha) >> self.shift),
        ) // 4.9–4.12
    }
}
