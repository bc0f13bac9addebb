//! 1/n for the lengths of spans, from a table, because a Cortex-M0 takes 200 instructions to
//! divide. Only the cuts of long lines are divided.

use core::num::NonZeroU32;

/// 1/n as a mantissa and a shift: 1/n = mantissa · 2^−(14 + shift), with 2¹⁴ ≤ mantissa < 2¹⁵.
#[derive(Clone, Copy)]
pub(super) struct Reciprocal {
    pub(super) mantissa: i32,
    pub(super) shift: u32,
}

/// 1/n for n of 1 to 255, as [`reciprocal`] packs it. Entry 0 is 1/256, so that 8 bits are an
/// index.
static RECIPROCALS: [u32; 256] = {
    let mut table = [0; 256];
    let mut i = 0;
    while i < 256 {
        table[i] = reciprocal(if i == 0 { 256 } else { i as u32 });
        i += 1;
    }
    table
};

/// Returns 1/n with its mantissa in the lower 16 bits and its shift in the upper 16.
const fn reciprocal(n: u32) -> u32 {
    // 2^shift is the least power of 2 that is not below n.
    let shift = 32 - (n - 1).leading_zeros();
    // One bit too many, plus 1, halved: the mantissa is rounded to the nearest.
    shift << 16 | ((1 << (15 + shift)) / n + 1) >> 1
}

/// Returns i/n with 16 fractional bits, for i below n. Its error is at most 2⁻¹⁶, and 2⁻¹⁵ from n =
/// 2¹⁶ on.
pub(super) fn part(i: usize, n: usize) -> i64 {
    let above = (usize::BITS - n.leading_zeros()).saturating_sub(16);
    // A divisor whose type says that it is not 0 needs no check.
    let n = NonZeroU32::new((n >> above) as u32).unwrap_or(NonZeroU32::MIN);
    i64::from((((i >> above) as u32) << 16) / n)
}

impl Reciprocal {
    /// Returns 1/n for n from 1 to 256.
    #[inline(always)]
    pub(super) fn of(n: usize) -> Self {
        debug_assert!(n <= 256, "{n} pixels at once");
        let entry = RECIPROCALS[n & 255];
        Self {
            mantissa: (entry & 0xFFFF) as i32,
            // Every shift is at most 8. The mask tells the compiler, which then checks no shift for
            // overflow.
            shift: entry >> 16 & 15,
        }
    }

    /// Returns x/n in Q30, for a Q14 x below 4 in magnitude.
    ///
    /// The product is below 2¹⁶ · 2¹⁵. Larger x wrap, which parabolas over 120° and more have.
    /// Steps above 2 wrap, too, but only for n = 1, where nobody adds them.
    #[inline(always)]
    pub(super) fn times(self, x: i32) -> i32 {
        (x.wrapping_mul(self.mantissa) >> self.shift) << 2
    }

    /// Returns x/n² in Q30, for a Q14 x below 4 in magnitude.
    ///
    /// Both products are below 2¹⁶ · 2¹⁵. Its error is 2⁻¹⁴/n² plus the mantissa's.
    #[inline(always)]
    pub(super) fn times_squared(self, x: i32) -> i32 {
        // Q(13 + shift), and then `twice` is Q(27 + 2 shift), which the last shift turns into Q30.
        let once = x.wrapping_mul(self.mantissa).wrapping_add(1 << 14) >> 15;
        let twice = once * self.mantissa;
        if self.shift >= 2 {
            twice >> (2 * self.shift - 3)
        } else {
            twice << (3 - 2 * self.shift)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reciprocals_are_right_to_half_a_unit() {
        for n in 1..=256 {
            let r = Reciprocal::of(n);
            assert!((1 << 14..1 << 15).contains(&r.mantissa), "{n}");
            let exact = f64::from(1 << (14 + r.shift)) / n as f64;
            assert!((f64::from(r.mantissa) - exact).abs() <= 0.5, "{n}");
        }
    }

    #[test]
    fn quotients_of_the_largest_differences_do_not_overflow() {
        for n in 2..=256 {
            for x in [-65535, -40000, -1, 0, 1, 12345, 65535] {
                let (r, exact) = (Reciprocal::of(n), f64::from(x) / 16384.0 / n as f64);
                let once = f64::from(r.times(x)) / f64::from(1 << 30);
                // Half a unit of the mantissa's 14 bits, and a cut at 2⁻²⁸.
                assert!((once - exact).abs() < exact.abs() / 32768.0 + 4e-9 || exact.abs() >= 2.0);
                let twice = f64::from(r.times_squared(x)) / f64::from(1 << 30);
                let exact = exact / n as f64;
                let error = exact.abs() / 16384.0 + 1.0 / 16384.0 / (n * n) as f64 + 1e-9;
                assert!(
                    (twice - exact).abs() < error || exact.abs() >= 2.0,
                    "{n} {x}"
                );
            }
        }
    }
}
