//! A square root that is followed from pixel to pixel by Newton's method.

use super::{Linear, Walk};
use crate::number::{Machine, Num, Real, dot, each};

/// A normal that is stepped along a span, its squared length, and its length by Newton's method from the previous
/// pixel's.
///
/// ```text
/// N_next = N_current + ΔN                          (L21 4.2)
/// d_next = √(N_next · N_next)                      (L21 4.4)
/// x_{n+1} = x_n − (x_n² − d_next²) / (2 x_n),      x_0 = d_current
/// ```
///
/// A step whose guess is off by the relative error e leaves e² / (2 (1 + e)): always from above, and always converging
/// from a guess over 0. Three additions for N, three multiplications and two additions for N · N; then each step takes
/// one multiplication, three additions and one division. The first pixel of a span has a true root.
///
/// *Fails when* d grows by a large factor from one pixel to the next, as it does near normals that cancel: the steps
/// then overshoot (x ≈ d²/2x_0) and the span darkens until they have come down again.
///
/// In groups of pixels the guess is the previous group's, a whole group away, and fails the sooner: where the steps could
/// leave more than [`Newton::LARGEST_ERROR`], the span has true roots. One pixel at a time nothing is guarded, as in the
/// lecture.
#[derive(Clone, Copy, Debug)]
pub struct Newton<F> {
    normal: [Linear<F>; 3],
    length: F,
    steps: u32,
}

impl<F: Num> Newton<F> {
    /// The largest relative error of a length that a group may be left with: of a cosine it is a quarter of a grey level.
    pub const LARGEST_ERROR: f32 = 1e-3;

    /// Follows the normal that starts as `n` and grows by `dn` a pixel, by `steps` steps a pixel.
    #[inline(always)]
    pub fn new<M: Machine<F = F>>(m: M, n: [M::One; 3], dn: [M::One; 3], steps: u32) -> Self {
        let normal = each(
            #[inline(always)]
            |i| Linear::new(m, n[i], dn[i]), // 4.2
        );
        if M::WIDTH == 1 {
            return Newton {
                normal,
                length: m.splat(dot(n, n).sqrt()),
                steps,
            };
        }
        let mut ahead = normal;
        let first = ahead.next();
        let is_safe = Self::error_of_groups::<M>(n, dn, steps) <= Self::LARGEST_ERROR;
        Newton {
            normal,
            length: dot(first, first).sqrt(),
            steps: if is_safe { steps } else { 0 },
        }
    }

    /// The relative error that `steps` steps leave at most, from a guess that is a group away and has itself the error
    /// E = [`Newton::LARGEST_ERROR`] at most: where no more than E is left, no group is left with more.
    ///
    /// ```text
    /// |N + k ΔN|² ≥ D_min = N·N − min(0, N·ΔN)² / ΔN·ΔN,    δ = w |ΔN| / √D_min
    /// e_0 ≤ δ + E (1 + δ),    e ← e² / (2 (1 − e))
    /// ```
    /// δ is how far the true length is from that of the group before, which is up to 1 + δ times as long. The guess may be too
    /// small by e, which leaves the most.
    fn error_of_groups<M: Machine<F = F>>(n: [M::One; 3], dn: [M::One; 3], steps: u32) -> f32 {
        let (square, along, step) = (
            dot(n, n).value(),
            dot(n, dn).value().min(0.0),
            dot(dn, dn).value(),
        );
        if step == 0.0 {
            return 0.0;
        }
        let width = M::WIDTH as f32;
        let change = Num::sqrt(width * width * step / (square - along * along / step).max(0.0));
        let mut e = change + Self::LARGEST_ERROR * (1.0 + change);
        for _ in 0..steps {
            if e >= 1.0 {
                return 1.0;
            }
            e = e * e / (2.0 * (1.0 - e));
        }
        e
    }
}

impl<F: Num> Walk for Newton<F> {
    /// (d, D): the length, and the squared length itself, which the specular term uses.
    type Out = (F, F);

    #[inline(always)]
    fn next(&mut self) -> (F, F) {
        let n = self.normal.next(); // 4.2
        let squared = dot(n, n); // D = N · N
        if self.steps == 0 {
            return (squared.sqrt(), squared);
        }
        let mut x = self.length;
        for _ in 0..self.steps {
            x = x - (x * x - squared) / (x + x); // 4.4 by Newton's method
        }
        self.length = x;
        (x, squared)
    }
}
