//! A cubic by three additions per pixel.

use super::Walk;
use crate::number::Num;

/// A cubic along a span, by forward differences.
///
/// ```text
/// F(k) = a + b k + c k² + d k³
/// F_next = F + ΔF,   ΔF_next = ΔF + ΔΔF,   ΔΔF_next = ΔΔF + 6 d,      ΔF_0 = b + c + d,   ΔΔF_0 = 2 c + 6 d
/// ```
///
/// In `f32` each sum is rounded: after k steps F is off by at most `(k |F| + k²/2 |ΔF| + k³/6 |ΔΔF|) 2⁻²⁴`, with the largest values of each.
/// Over n pixels ΔF is about the slope S over n, and ΔΔF the curvature C over n², so that this is at most `(|F| + S/2 + C/6) k 2⁻²⁴`.
#[derive(Clone, Copy, Debug)]
pub struct Cubic<F> {
    at: F,
    first: F,
    second: F,
    third: F,
}

impl<F: Num> Cubic<F> {
    /// Makes `a + b k + c k² + d k³` at step k.
    #[inline(always)]
    pub fn new([a, b, c, d]: [F; 4]) -> Self {
        let third = d * 6.0;
        Cubic {
            at: a,
            first: b + (c + d),
            second: c + c + third,
            third,
        }
    }

    /// Makes 0.
    #[inline(always)]
    pub fn zero(like: F) -> Self {
        let zero = like.broadcast(0.0);
        Cubic {
            at: zero,
            first: zero,
            second: zero,
            third: zero,
        }
    }

    /// Makes the product of `a + b k` and `p + q k + r k²`.
    #[inline(always)]
    pub fn product([a, b]: [F; 2], [p, q, r]: [F; 3]) -> Self {
        Self::new([a * p, a * q + b * p, a * r + b * q, b * r])
    }
}

impl<F: Num> Walk<F> for Cubic<F> {
    type Pixel = F;
    const REMEMBERS: bool = false;

    #[inline(always)]
    fn next(&mut self) -> F {
        let here = self.at;
        self.at = here + self.first;
        self.first = self.first + self.second;
        self.second = self.second + self.third;
        here
    }
}
