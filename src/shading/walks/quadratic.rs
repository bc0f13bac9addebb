//! A quadratic in two additions per pixel.

use super::Walk;
use crate::number::{Num, Vec3};

/// The dot product of two vectors that grow linearly along a span, by forward differences (Duff
/// 1979).
///
/// ```text
/// Q(k) = (A + k ΔA) · (B + k ΔB) = q + p k + s k²,     q = A·B,   p = A·ΔB + ΔA·B,   s = ΔA·ΔB
/// Q_next = Q + ΔQ,   ΔQ_next = ΔQ + 2 s,               ΔQ_0 = p + s
/// ```
///
/// It takes two additions per pixel and no multiplication. In `f32` ΔQ has an error of at most k ·
/// 2⁻²⁴ · max|ΔQ| after k steps, and Q the sum of these errors. Where Q crosses its range in n
/// steps, max|ΔQ| is about 4 max|Q| / n, so the error of Q is at most about (1 + 2) k · 2⁻²⁴ ·
/// max|Q|.
#[derive(Clone, Copy, Debug)]
pub struct Quadratic<F> {
    at: F,
    step: F,
    second: F,
}

impl<F: Num> Quadratic<F> {
    /// Makes the dot product of `a` and `b`, which grow by `da` and `db` per step.
    #[inline(always)]
    pub fn product(a: Vec3<F>, da: Vec3<F>, b: Vec3<F>, db: Vec3<F>) -> Self {
        Self::new(a.dot(b), a.dot(db) + da.dot(b), da.dot(db))
    }

    /// Makes the squared length of `a`, which grows by `da` per step.
    #[inline(always)]
    pub fn square(a: Vec3<F>, da: Vec3<F>) -> Self {
        let half = a.dot(da);
        Self::new(a.dot(a), half + half, da.dot(da))
    }

    /// Makes the quadratic that is 0 everywhere.
    #[inline(always)]
    pub fn zero(like: F) -> Self {
        let zero = like.broadcast(0.0);
        Quadratic {
            at: zero,
            step: zero,
            second: zero,
        }
    }

    /// Makes `q + p k + s k²` at step k.
    #[inline(always)]
    pub fn new(q: F, p: F, s: F) -> Self {
        Quadratic {
            at: q,
            step: p + s,
            second: s + s,
        }
    }
}

impl<F: Num> Walk<F> for Quadratic<F> {
    type Pixel = F;
    const REMEMBERS: bool = false;

    #[inline(always)]
    fn next(&mut self) -> F {
        let here = self.at;
        // Q first: it takes the difference of this pixel, before that becomes the next one's.
        self.at = here + self.step;
        self.step = self.step + self.second;
        here
    }
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        see("first", self.step);
        see("second", self.second);
    }
}
