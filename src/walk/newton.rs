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
/// [`Steps`] says how many steps a pixel takes, and where a span has true roots instead.
#[derive(Clone, Copy, Debug)]
pub struct Newton<F> {
    normal: [Linear<F>; 3],
    length: F,
    steps: u32,
}

/// How many steps of Newton's method a pixel takes along a span.
#[derive(Clone, Copy, Debug)]
pub enum Steps<N> {
    /// The same number on every span.
    ///
    /// One pixel at a time nothing is guarded, as the lecture prints it. In groups of pixels the guess is the previous
    /// group's, a whole group away: where the steps could leave more than [`Newton::LARGEST_ERROR`], the span has true roots.
    Fixed(u32),
    /// The fewest that stay within an error, of 1 to [`MOST_STEPS`]; true roots where those do not suffice. Made by
    /// [`Steps::within`]: threshold s, from 0 on, is the largest δ² for which s + 1 steps suffice.
    Fewest([N; MOST_STEPS]),
}

/// Where this many steps do not suffice, a root is cheaper than more of them.
pub const MOST_STEPS: usize = 3;

impl<N: Num> Steps<N> {
    /// The fewest steps that leave a relative error of `error` at most, with thresholds made by `of`.
    ///
    /// ```text
    /// e_0 = E,    e_s = −e_{s−1} + √(e_{s−1}² + 2 e_{s−1})        the inverse of e²/(2 (1 − e))
    /// δ_s = (e_s − E) / (1 + E)                                   the inverse of e_s = δ + E (1 + δ)
    /// ```
    /// e_s is the error of a guess of which s steps leave E, and δ_s the change of the length from one pixel, or group, to the
    /// next that gives such a guess: `Newton::error_of_groups` derives both.
    pub fn within(error: f32, of: &dyn Fn(f32) -> N) -> Self {
        let mut e = error;
        Steps::Fewest(each(|_| {
            e = libm::sqrtf(e * e + 2.0 * e) - e;
            let change = (e - error) / (1.0 + error);
            of(change * change)
        }))
    }
}

impl<F: Num> Newton<F> {
    /// The largest relative error of a length that is allowed where spans are guarded: of a cosine it is a quarter of a grey
    /// level.
    pub const LARGEST_ERROR: f32 = 1e-3;

    /// Follows the normal that starts as `n` and grows by `dn` a pixel, by `steps` steps a pixel.
    #[inline(always)]
    pub fn new<M: Machine<F = F>>(
        m: M,
        n: [M::One; 3],
        dn: [M::One; 3],
        steps: Steps<M::One>,
    ) -> Self {
        let normal = each(
            #[inline(always)]
            |i| Linear::new(m, n[i], dn[i]), // 4.2
        );
        let square = dot(n, n);
        let steps = match steps {
            Steps::Fixed(steps) if M::WIDTH == 1 => steps,
            Steps::Fixed(steps) => {
                let error = Self::error_of_groups::<M>(n, dn, steps);
                if error <= Self::LARGEST_ERROR {
                    steps
                } else {
                    0
                }
            }
            Steps::Fewest(thresholds) => Self::fewest(m, square, n, dn, thresholds),
        };
        if M::WIDTH == 1 {
            return Newton {
                normal,
                length: m.splat(square.sqrt()),
                steps,
            };
        }
        let mut ahead = normal;
        let first = ahead.next();
        Newton {
            normal,
            length: dot(first, first).sqrt(),
            steps,
        }
    }

    /// The fewest steps for which `thresholds` allow the change of the length on this span; 0 where none do.
    ///
    /// ```text
    /// δ² = w² ΔN·ΔN / D_min,    D_min = N·N − min(0, N·ΔN)² / ΔN·ΔN        as in `error_of_groups`
    /// δ² ≤ T    where    (w² ΔN·ΔN)² ≤ T (N·N (w² ΔN·ΔN) − (w min(0, N·ΔN))²)
    /// ```
    /// Without a division. A normal that stays has 0 ≤ 0, and takes a step.
    #[inline(always)]
    fn fewest<M: Machine<F = F>>(
        m: M,
        square: M::One,
        n: [M::One; 3],
        dn: [M::One; 3],
        thresholds: [M::One; MOST_STEPS],
    ) -> u32 {
        let (mut along, mut step) = (dot(n, dn).min(m.one(0.0)), dot(dn, dn));
        if M::WIDTH > 1 {
            let width = m.one(M::WIDTH as f32);
            (along, step) = (along * width, step * (width * width));
        }
        let (step_squared, room) = (step * step, square * step - along * along);
        let mut i = 0;
        while i < MOST_STEPS {
            if step_squared.value() <= (thresholds[i] * room).value() {
                return i as u32 + 1;
            }
            i += 1;
        }
        0
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
