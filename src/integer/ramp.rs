//! The quantities that a span steps: linear ones by one addition, quadratic ones by two.

use super::reciprocal::Reciprocal;
use fixed::types::I2F30;

/// A linear quantity along a span: f_next = f + Δf (L21 3.6).
///
/// Its value at every pixel lies within ±(1 + 2⁻¹²). The sum after the last pixel may wrap, because
/// nobody reads it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Ramp {
    /// The value at the first pixel.
    pub at: I2F30,
    /// The growth to the next pixel.
    pub step: I2F30,
}

/// A quadratic quantity along a span, by second differences: f_next = f + Δf, Δf_next = Δf + Δ²f.
///
/// Its value at every pixel lies within ±2. Over n pixels it drifts by at most n² 2⁻³⁰.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Quadratic {
    /// The value at the first pixel.
    pub at: I2F30,
    /// The growth to the second pixel.
    pub step: I2F30,
    /// The growth of the growth.
    pub bend: I2F30,
}

impl Ramp {
    /// Makes a ramp from Q30 bits.
    #[inline(always)]
    pub(super) const fn from_bits(at: i32, step: i32) -> Self {
        Self {
            at: I2F30::from_bits(at),
            step: I2F30::from_bits(step),
        }
    }

    /// Makes a ramp from `first` at pixel 0 to `end` at pixel n, both in Q30.
    #[inline(always)]
    pub(super) fn between(first: i32, end: i32, n: Reciprocal) -> Self {
        // Halve first: the whole difference may need 33 bits. The result is in Q14.
        let difference = ((end >> 1) - (first >> 1) + (1 << 14)) >> 15;
        Self::from_bits(first, n.times(difference))
    }

    /// Returns the value in Q30 and steps to the next pixel.
    #[inline(always)]
    pub(super) fn next(&mut self) -> i32 {
        let at = self.at.to_bits();
        self.at = self.at.wrapping_add(self.step);
        at
    }
}

impl Quadratic {
    /// Makes a + b t + c t² with t = i/n, from a in Q30 and b and c in Q14.
    #[inline(always)]
    pub(super) fn polynomial(a: i32, b: i32, c: i32, n: Reciprocal) -> Self {
        let square = n.times_squared(c);
        // The first difference of b t + c t² is b/n + c/n², the second one 2 c/n².
        Self::from_bits(a, n.times(b).wrapping_add(square), square << 1)
    }

    /// Makes the parabola through three Q15 values, at pixels 0, n/2 and n.
    ///
    /// 4 m − 3 a − b is at most 8 in magnitude. Halved it is at most 4, which [`Reciprocal::times`]
    /// allows.
    #[inline(always)]
    pub(super) fn through([a, m, b]: [i32; 3], n: Reciprocal) -> Self {
        Self::polynomial(a << 15, (4 * m - 3 * a - b) >> 1, a + b - 2 * m, n)
    }

    /// Makes a quadratic quantity from Q30 bits.
    #[inline(always)]
    pub(super) const fn from_bits(at: i32, step: i32, bend: i32) -> Self {
        let [at, step, bend] = [
            I2F30::from_bits(at),
            I2F30::from_bits(step),
            I2F30::from_bits(bend),
        ];
        Self { at, step, bend }
    }

    /// Returns the value in Q30 and steps to the next pixel.
    #[inline(always)]
    pub(super) fn next(&mut self) -> i32 {
        let at = self.at.to_bits();
        self.at = self.at.wrapping_add(self.step);
        self.step = self.step.wrapping_add(self.bend);
        at
    }
}
