//! A reciprocal square root that follows a quadratic from pixel to pixel by Newton's method.

use super::{Quadratic, Walk};
use crate::number::Num;

/// 1/√D of a quadratic D, from the previous pixel's value: no root and no division.
///
/// ```text
/// r ← r (3/2 − (D/2) r²),      e ← −(3/2) e² − e³/2        with e the relative error
/// ```
/// A step is Newton's method for 1/r² − D = 0. Unlike the step for the root ([`super::Newton`]) it
/// has no division, and it diverges where D grows threefold at once. [`WarmSteps`] prevents that.
#[derive(Clone, Copy, Debug)]
pub struct WarmRsqrt<F> {
    square: Quadratic<F>,
    root: F,
    steps: u32,
}

/// The most steps that are taken: three would cost more than a root and a division.
const MOST: u32 = 2;

impl<F: Num> WarmRsqrt<F> {
    /// Follows 1/√D of the quadratic `square`, whose first value is `first`, by `steps` steps per
    /// pixel; 0 takes true roots.
    #[inline(always)]
    pub fn new(square: Quadratic<F>, first: F, steps: u32) -> Self {
        WarmRsqrt {
            square,
            root: first.broadcast(1.0) / first.sqrt(),
            steps,
        }
    }
}

/// The rule that chooses how many steps a span takes: one, two, or true roots.
#[derive(Clone, Copy, Debug, Default)]
pub struct WarmSteps {
    /// `within[s]`: up to this δ², s + 1 steps leave no more than the largest error.
    within: [f32; MOST as usize],
}

impl WarmSteps {
    /// Makes the rule for a relative error of at most `largest_error`, E.
    ///
    /// δ is the largest distance of a length from the one of the previous pixel, relative to the
    /// least length along the span. The guess has an error of `e_0 ≤ δ + E (1 + δ)`, and a step
    /// leaves at most 2 e² of an e of up to 1. So backwards from E: `e ← √(e/2)`.
    pub fn new(largest_error: f32) -> Self {
        let mut within = [0.0; MOST as usize];
        let mut e = largest_error;
        for within in &mut within {
            e = Num::sqrt(0.5 * e);
            let change = Num::max((e - largest_error) / (1.0 + largest_error), 0.0);
            *within = change * change;
        }
        WarmSteps { within }
    }

    /// Chooses the count of steps for a span that starts with the squared length D = `square`,
    /// where `growth` = ΔN·ΔN and `along` = N·ΔN; 0 is a true root and a division.
    ///
    /// ```text
    /// D_min = D − min(0, N·ΔN)² / ΔN·ΔN,      δ² = ΔN·ΔN / D_min ≤ T      times ΔN·ΔN
    /// ```
    #[inline(always)]
    pub fn of_span<F: Num>(&self, square: F, along: F, growth: F) -> u32 {
        // The length shrinks only where N·ΔN < 0; otherwise the least length is the first one.
        let room = square * growth - (along * along).gate(-along, 0.0);
        let growth = growth * growth;
        for (steps, within) in (1..).zip(self.within) {
            if !(growth - room * within).any_over(0.0) {
                return steps;
            }
        }
        0
    }
}

impl<F: Num> WarmRsqrt<F> {
    /// Returns 1/√`square`, starting from the previous pixel's value. Calls `see` with the guess
    /// and the result of each step.
    #[inline(always)]
    fn next_root(&self, square: F, mut see: impl FnMut(F)) -> F {
        let half = square * 0.5;
        let mut root = self.root;
        see(root);
        for _ in 0..self.steps {
            root = root * (-(half * root * root) + 1.5);
            see(root);
        }
        root
    }
}

impl<F: Num> Walk<F> for WarmRsqrt<F> {
    type Pixel = F;

    #[inline(always)]
    fn next(&mut self) -> F {
        let square = self.square.next();
        if self.steps == 0 {
            return square.broadcast(1.0) / square.sqrt();
        }
        self.root = self.next_root(square, |_| ());
        self.root
    }
    /// Reports the guesses, the last of which is 1/d; none if roots are true.
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        if self.steps > 0 {
            let mut square = self.square;
            self.next_root(square.next(), |root| see("guess", root));
        }
    }
}
