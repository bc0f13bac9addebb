//! The state of a span: what grows by one addition, or by two.

use super::reciprocal::Reciprocal;
use fixed::types::I2F30;

/// A linear quantity along a span: f_next = f + Δf (L21 3.6).
///
/// Its value at every pixel is to be within ±1 and 2⁻¹². The sum after the last pixel may wrap, and is not
/// read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ramp {
    /// The value at the first pixel.
    pub at: I2F30,
    /// The growth to the next pixel.
    pub step: I2F30,
}

/// A quadratic quantity along a span, by second differences: f_next = f + Δf, Δf_next = Δf + Δ²f.
///
/// Its value at every pixel is to be within ±2. Over n pixels it drifts by at most n² 2⁻³⁰.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Quadratic {
    /// The value at the first pixel.
    pub at: I2F30,
    /// The growth to the second pixel.
    pub step: I2F30,
    /// The growth of the growth.
    pub bend: I2F30,
}

impl Ramp {
    /// Makes a ramp from its bits.
    #[inline(always)]
    pub(super) const fn from_bits(at: i32, step: i32) -> Self {
        Self {
            at: I2F30::from_bits(at),
            step: I2F30::from_bits(step),
        }
    }

    /// Makes a ramp from `first` at pixel 0 to `end` at pixel n, both of 30 fractional bits.
    #[inline(always)]
    pub(super) fn between(first: i32, end: i32, n: Reciprocal) -> Self {
        // Half of each: the whole difference may need 33 bits.
        let difference = ((end >> 1) - (first >> 1) + (1 << 14)) >> 15;
        Self::from_bits(first, n.times(difference))
    }

    /// Returns the bits of the value, 30 of them fractional, and goes to the next pixel.
    #[inline(always)]
    pub(super) fn next(&mut self) -> i32 {
        let at = self.at.to_bits();
        self.at = self.at.wrapping_add(self.step);
        at
    }
}

impl Quadratic {
    /// Makes a + b t + c t², t = i/n, from a of 30 fractional bits, b and c of 14.
    #[inline(always)]
    pub(super) fn polynomial(a: i32, b: i32, c: i32, n: Reciprocal) -> Self {
        let square = n.times_squared(c);
        Self::from_bits(a, n.times(b).wrapping_add(square), square << 1)
    }

    /// Makes the parabola through three values of 15 fractional bits, at pixels 0, n/2 and n.
    ///
    /// 4 m − 3 a − b is at most 8 in magnitude, halved 4: what [`Reciprocal::times`] takes.
    #[inline(always)]
    pub(super) fn through([a, m, b]: [i32; 3], n: Reciprocal) -> Self {
        Self::polynomial(a << 15, (4 * m - 3 * a - b) >> 1, a + b - 2 * m, n)
    }

    /// Makes it from its bits.
    #[inline(always)]
    pub(super) const fn from_bits(at: i32, step: i32, bend: i32) -> Self {
        let [at, step, bend] = [
            I2F30::from_bits(at),
            I2F30::from_bits(step),
            I2F30::from_bits(bend),
        ];
        Self { at, step, bend }
    }

    /// Returns the bits of the value, 30 of them fractional, and goes to the next pixel.
    #[inline(always)]
    pub(super) fn next(&mut self) -> i32 {
        let at = self.at.to_bits();
        self.at = self.at.wrapping_add(self.step);
        self.step = self.step.wrapping_add(self.bend);
        at
    }
}
