//! Sines and cosines by Chebyshev's recurrence, in difference form.

use super::{GreatCircle, Walk};
use crate::number::{Num, Vec3};
use crate::shading::walks::values::{Values, each};

/// Whatever grows as a sine and a cosine do, `F(k) = P cos kδ + Q sin kδ`: two additions and a multiplication a step.
///
/// ```text
/// F_(k+1) = 2 cos δ F_k − F_(k−1)                                   (Chebyshev)
/// F_next = F + ΔF,   ΔF_next = ΔF − α F_next,   α = 4 sin² δ/2      the same in differences
/// ```
/// 2 cos δ is near 2 where steps are small, and its last bits are lost: over 1,024 steps of 30° in all the first line is off by
/// 10⁻², the second by 10⁻⁶.
///
/// In `f32` F is rounded at each step, and ΔF by its own size, δ at most, whose roundings the steps add up: after k steps F
/// is off by at most k (½ + ½ kδ) 2⁻²⁴, with kδ the angle that was passed; and by 3 kδ 2⁻²⁴ for the roundings of α and of the first ΔF.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Chebyshev<F, V> {
    at: V,
    step: V,
    alpha: F,
}

impl<F: Num, V: Values<F>> Chebyshev<F, V> {
    /// Follows what is linear in the unit normals of a great circle: `of` gives it.
    ///
    /// ```text
    /// sin(x + δ) − sin x = sin δ cos x − h sin x,    h = 1 − cos δ = sin² δ / (1 + cos δ)
    /// ```
    #[inline(always)]
    pub fn along(circle: GreatCircle<F>, of: impl Fn(Vec3<F>) -> V) -> Self {
        let sines = circle.sines;
        let ((sin_t, cos_t), (sin_rest, cos_rest)) = (sines.t, sines.rest);
        let (sin_step, cos_step) = sines.step;
        let h = sin_step * sin_step / (cos_step + 1.0);
        let grown = circle.to * (sin_step * cos_t - h * sin_t);
        let fallen = circle.from * (sin_step * cos_rest + h * sin_rest);
        Chebyshev {
            at: of(circle.normal()),
            step: of(grown - fallen),
            alpha: h + h,
        }
    }
}

impl<F: Num, V: Values<F>> Walk<F> for Chebyshev<F, V> {
    type Pixel = V;

    #[inline(always)]
    fn next(&mut self) -> V {
        let here = self.at;
        self.at.zip(self.step, |at, step| at + step);
        let alpha = self.alpha;
        self.step.zip(self.at, |step, at| step - at * alpha);
        here
    }
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        each(self.step, |_, value| see("first", *value));
        see("alpha", self.alpha);
    }
}
