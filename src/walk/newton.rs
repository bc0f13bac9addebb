//! A square root that is followed from pixel to pixel by Newton's method.

use super::Walk;
use crate::number::{Machine, Num, dot};

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
#[derive(Clone, Copy, Debug)]
pub struct Newton<W, F> {
    normal: W,
    length: F,
    steps: u32,
}

impl<W: Walk<Out = [F; 3]>, F: Num> Newton<W, F> {
    /// Follows `normal`, whose value on the first pixel is `start`, by `steps` steps a pixel.
    #[inline(always)]
    pub fn new<M: Machine<F = F>>(m: M, normal: W, start: [M::One; 3], steps: u32) -> Self {
        Newton { normal, length: m.splat(dot(start, start).sqrt()), steps }
    }
}

impl<W: Walk<Out = [F; 3]>, F: Num> Walk for Newton<W, F> {
    /// (d, D): the length, and the squared length itself, which the specular term uses.
    type Out = (F, F);

    #[inline(always)]
    fn next(&mut self) -> (F, F) {
        let n = self.normal.next(); // 4.2
        let squared = dot(n, n); // D = N · N
        let mut x = self.length;
        for _ in 0..self.steps {
            x = x - (x * x - squared) / (x + x); // 4.4 by Newton's method
        }
        self.length = x;
        (x, squared)
    }
}
