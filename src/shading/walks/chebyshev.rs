//! Sines and cosines by Chebyshev's recurrence, in difference form.

use super::{GreatCircle, Walk};
use crate::number::{Num, Vec3};
use crate::shading::walks::values::{Values, each};

/// A value that varies as sines and cosines do, `F(k) = P cos kδ + Q sin kδ`: two additions and a
/// multiplication per step.
///
/// ```text
/// F_(k+1) = 2 cos δ F_k − F_(k−1)                                   (Chebyshev)
/// F_next = F + ΔF,   ΔF_next = ΔF − α F_next,   α = 4 sin² δ/2      (in differences)
/// ```
/// For small steps 2 cos δ is near 2, and its last bits are lost. Over 1,024 steps that turn by 30°
/// in all, the first line has an error of 10⁻², the second one of 10⁻⁶.
///
/// In `f32` F is rounded at each step. ΔF is at most δ and is rounded relative to its own size, and
/// the steps add up its roundings. After k steps, over the angle kδ, F has an error of at most k
/// (½ + ½ kδ) 2⁻²⁴, and 3 kδ 2⁻²⁴ more for the roundings of α and the first ΔF.
#[derive(Clone, Copy, Debug)]
pub struct Chebyshev<F, V> {
    at: V,
    step: V,
    alpha: F,
}

impl<F: Num, V: Values<F>> Chebyshev<F, V> {
    /// Follows `of(N)` along a great circle of unit normals N. `of` must be linear.
    ///
    /// ```text
    /// sin(x + δ) − sin x = sin δ cos x − h sin x,    h = 1 − cos δ = sin² δ / (1 + cos δ)
    /// ```
    #[inline(always)]
    pub fn along(circle: GreatCircle<F>, of: impl Fn(Vec3<F>) -> V) -> Self {
        let sines = circle.sines;
        let ((sin_t, cos_t), (sin_rest, cos_rest)) = (sines.t, sines.rest);
        let (sin_step, cos_step) = sines.step;
        // 1 − cos δ itself would lose the digits of a small angle.
        let h = sin_step * sin_step / (cos_step + 1.0);
        let grown = circle.to * (sin_step * cos_t - h * sin_t);
        // sin(x − δ) − sin x = −(sin δ cos x + h sin x): the weight of the first end falls.
        let fallen = circle.from * (sin_step * cos_rest + h * sin_rest);
        Chebyshev {
            at: of(circle.normal()),
            step: of(grown - fallen),
            // α = 4 sin² δ/2 = 2 (1 − cos δ)
            alpha: h + h,
        }
    }
}

impl<F: Num, V: Values<F>> Walk<F> for Chebyshev<F, V> {
    type Pixel = V;

    #[inline(always)]
    fn next(&mut self) -> V {
        let here = self.at;
        // ΔF_next uses F at the next pixel, so F steps first.
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
