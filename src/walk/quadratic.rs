//! A quadratic by two additions a pixel.

use super::Walk;
use crate::number::{Machine, Num, dot};

/// The dot product of two vectors that grow linearly along a span, by forward differences (Duff 1979).
///
/// ```text
/// Q(k) = (A + k ΔA) · (B + k ΔB) = q + p k + s k²,     q = A·B,   p = A·ΔB + ΔA·B,   s = ΔA·ΔB
/// Q_next = Q + ΔQ,   ΔQ_next = ΔQ + 2 s,               ΔQ_0 = p + s
/// ```
///
/// Two additions a pixel and no multiplication. In `f32` ΔQ is off by at most k · 2⁻²⁴ · max|ΔQ| after k steps, and Q by
/// the sum of these: where Q runs from end to end of its range in n steps, max|ΔQ| is about 4 max|Q| / n, so that Q is off
/// by at most about (1 + 2) k · 2⁻²⁴ · max|Q|.
#[derive(Clone, Copy, Debug)]
pub struct Quadratic<F> {
    at: F,
    step: F,
    second: F,
}

impl<F: Num> Quadratic<F> {
    /// The dot product of `a` and `b`, which grow by `da` and `db` a pixel.
    #[inline(always)]
    pub fn product<M: Machine<F = F>>(
        m: M,
        a: [M::One; 3],
        da: [M::One; 3],
        b: [M::One; 3],
        db: [M::One; 3],
    ) -> Self {
        Self::new(m, dot(a, b), dot(a, db) + dot(da, b), dot(da, db))
    }

    /// The squared length of `a`, which grows by `da` a pixel.
    #[inline(always)]
    pub fn square<M: Machine<F = F>>(m: M, a: [M::One; 3], da: [M::One; 3]) -> Self {
        let half = dot(a, da);
        Self::new(m, dot(a, a), half + half, dot(da, da))
    }

    /// `q + p k + s k²` at pixel k.
    #[inline(always)]
    pub fn new<M: Machine<F = F>>(m: M, q: M::One, p: M::One, s: M::One) -> Self {
        if M::WIDTH == 1 {
            return Quadratic {
                at: m.splat(q),
                step: m.splat(p + s),
                second: m.splat(s + s),
            };
        }
        // Q(k + w) − Q(k) = (p w + s w²) + 2 s w k for groups of w pixels: linear in k, and 2 s w² more each group.
        let w = m.one(M::WIDTH as f32);
        let (group, second) = (p * w + s * w * w, (s + s) * w);
        let mut k = m.one(0.0);
        let at = m.take(|| {
            let here = q + (p + s * k) * k;
            k = k + m.one(1.0);
            here
        });
        Quadratic {
            at,
            step: m.ramp(group, second),
            second: m.splat(second * w),
        }
    }
}

impl<F: Num> Walk for Quadratic<F> {
    type Out = F;

    #[inline(always)]
    fn next(&mut self) -> F {
        let here = self.at;
        self.at = here + self.step;
        self.step = self.step + self.second;
        here
    }
}
