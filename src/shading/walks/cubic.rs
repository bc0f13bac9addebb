//! A cubic in three additions per pixel.

use super::Walk;
use crate::number::Num;
use crate::shading::walks::values::{Values, each, scaled, sum};

/// A cubic along a span, by forward differences.
///
/// ```text
/// F(k) = a + b k + c k² + d k³
/// F_next = F + ΔF,   ΔF_next = ΔF + ΔΔF,   ΔΔF_next = ΔΔF + 6 d,      ΔF_0 = b + c + d,   ΔΔF_0 = 2 c + 6 d
/// ```
///
/// In `f32` each sum is rounded. After k steps F has an error of at most
/// `(k |F| + k²/2 |ΔF| + k³/6 |ΔΔF|) 2⁻²⁴`, with the largest values of each. Over n pixels ΔF is
/// about the slope S over n, and ΔΔF the curvature C over n², so the error is at most
/// `(|F| + S/2 + C/6) k 2⁻²⁴`.
///
/// The values of a group step together, as in [`Linear`](super::Linear), so that additions of
/// several cubics share SIMD registers.
#[derive(Clone, Copy, Debug)]
pub struct Cubic<V> {
    at: V,
    first: V,
    second: V,
    third: V,
}

impl<V> Cubic<V> {
    /// Makes `a + b k + c k² + d k³` at step k.
    #[inline(always)]
    pub fn new<F: Num>([a, b, c, d]: [V; 4]) -> Self
    where
        V: Values<F>,
    {
        let third = each(d, |_, d: &mut F| *d = *d * 6.0);
        Cubic {
            at: a,
            first: sum([b, sum([c, d])]),
            second: sum([c, c, third]),
            third,
        }
    }

    /// Makes the product of `a + b k` and `p + q k + r k²`.
    #[inline(always)]
    pub fn product<F: Num>([a, b]: [V; 2], [p, q, r]: [F; 3]) -> Self
    where
        V: Values<F>,
    {
        Self::new([
            scaled(a, p),
            sum([scaled(a, q), scaled(b, p)]),
            sum([scaled(a, r), scaled(b, q)]),
            scaled(b, r),
        ])
    }
}

impl<F: Num, V: Values<F>> Walk<F> for Cubic<V> {
    type Pixel = V;
    const REMEMBERS: bool = false;

    #[inline(always)]
    fn next(&mut self) -> V {
        let here = self.at;
        // From the lowest difference up: each takes the next one's value at this pixel.
        self.at = sum([here, self.first]);
        self.first = sum([self.first, self.second]);
        self.second = sum([self.second, self.third]);
        here
    }
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        each(self.first, |_, value: &mut F| see("first", *value));
        each(self.second, |_, value: &mut F| see("second", *value));
        each(self.third, |_, value: &mut F| see("third", *value));
    }
}
