//! Fast Phong's root: a square root that follows the normal's length from pixel to pixel by
//! Newton's method.
//!
//! [`Newton::new`] starts a span from a true root and chooses the count of steps; `Newton::root` is
//! the iteration.

use super::{Linear, Walk};
use crate::number::{Num, Vec3};

/// How many steps of Newton's method a pixel takes, or a rule that chooses the count for each span.
#[derive(Clone, Copy, Debug, Default)]
pub struct NewtonSteps {
    /// The count that the user asked for; 0 (`auto`) takes as few as suffice.
    steps: u32,
    /// `within[s]`: up to this δ², s steps leave no more than the largest error.
    pub(super) within: [f32; Self::MOST as usize + 1],
}

impl NewtonSteps {
    /// The most steps that a user can ask for.
    pub const MOST: u32 = 8;
    /// The most steps that `auto` takes before it takes true roots, because more steps cost as much
    /// as a root.
    pub const MOST_OF_AUTO: u32 = 3;
    /// The largest relative error of a length: in a diffuse cosine it is a quarter of a grey level.
    pub const LARGEST_ERROR: f32 = 1e-3;

    /// Makes the rule for `steps` steps, or 0 for `auto`, that leave a relative error of at most
    /// `largest_error`.
    ///
    /// A step whose guess has the relative error e leaves e² / (2 (1 + e)) if the guess is too
    /// large, and e² / (2 (1 − e)) if it is too small. δ is the distance of the true length from
    /// the one of the previous pixel, relative to the least length along the span. The guess itself
    /// has an error of up to E:
    ///
    /// ```text
    /// |N + k ΔN|² ≥ D_min = N·N − min(0, N·ΔN)² / ΔN·ΔN,    δ² = ΔN·ΔN / D_min
    /// e_0 ≤ δ + E (1 + δ),    e ← e² / (2 (1 − e))
    /// ```
    /// Solved backwards from E: the step before may have left e = −E + √(E² + 2E).
    pub fn new(steps: u32, largest_error: f32) -> Self {
        let mut within = [0.0; Self::MOST as usize + 1];
        let mut e = largest_error;
        for within in &mut within[1..=steps.max(Self::MOST_OF_AUTO) as usize] {
            e = Num::sqrt(e * e + 2.0 * e) - e;
            let change = (e - largest_error) / (1.0 + largest_error);
            *within = change * change;
        }
        NewtonSteps { steps, within }
    }

    /// True if the rule chooses the count.
    #[inline(always)]
    pub fn is_auto(&self) -> bool {
        self.steps == 0
    }

    /// Chooses the count of steps for a span whose normal starts as `n` and grows by `dn` per step,
    /// with `square` = N·N. A count of 0 means a true root.
    ///
    /// One pixel at a time, a count that the user asked for is used without a check, as in the
    /// lecture. In blocks the guess is a whole block away and fails sooner, so there the count
    /// gives way to true roots. `auto` always takes true roots in blocks, because eight roots take
    /// no longer than the eight divisions of one step.
    #[inline(always)]
    fn of_span<F: Num>(&self, n: Vec3<F>, dn: Vec3<F>, square: F) -> u32 {
        let counts = match (self.steps, F::WIDTH) {
            (0, 1) => 1..=Self::MOST_OF_AUTO,
            (steps, 1) | (steps @ 0, _) => return steps,
            (steps, _) => steps..=steps,
        };
        let (along, step) = (n.dot(dn), dn.dot(dn));
        // δ² ≤ T means ΔN·ΔN ≤ T D_min. Both sides are multiplied by ΔN·ΔN, so that a span of
        // constant normals divides by nothing. The length shrinks only where N·ΔN < 0; otherwise
        // the least length is the first one, and nothing is subtracted.
        let room = square * step - (along * along).gate(-along, 0.0);
        let growth = step * step;
        for count in counts {
            // `any_over` asks all lanes: a block takes as many steps as its worst pixel needs.
            if !(growth - room * self.within[count as usize]).any_over(0.0) {
                return count;
            }
        }
        0
    }
}

/// A normal that is stepped along a span, its squared length, and its length by Newton's method
/// from the previous pixel's length.
///
/// ```text
/// N_next = N_current + ΔN                          (L21 4.2)
/// d_next = √(N_next · N_next)                      (L21 4.4)
/// x_{n+1} = x_n − (x_n² − d_next²) / (2 x_n),      x_0 = d_current
/// ```
///
/// Three additions step N; three multiplications and two additions make N · N; then each of
/// Newton's steps takes one multiplication, three additions and one division. The first pixel of a
/// span starts from a true root.
///
/// *It fails where* d grows by a large factor from one pixel to the next, as near normals that
/// cancel. The steps then overshoot (x ≈ d²/2x_0), and the span stays dark until they have come
/// down again. [`NewtonSteps`] prevents that.
#[derive(Clone, Copy, Debug)]
pub struct Newton<F> {
    normal: Linear<Vec3<F>>,
    length: F,
    steps: u32,
}

impl<F: Num> Newton<F> {
    /// Follows the normal that starts as `n` and grows by `dn` per step.
    #[inline(always)]
    pub fn new(n: Vec3<F>, dn: Vec3<F>, steps: &NewtonSteps) -> Self {
        let square = n.dot(n);
        Newton {
            normal: Linear { at: n, step: dn }, // 4.2
            length: square.sqrt(),
            steps: steps.of_span(n, dn, square),
        }
    }

    /// Returns the root of `square`, starting from the previous pixel's length. Calls `see` with
    /// the guess and the result of each step.
    #[inline(always)]
    fn root(&self, square: F, mut see: impl FnMut(F)) -> F {
        let mut x = self.length;
        see(x);
        for _ in 0..self.steps {
            // Written as a correction, which is small, as are its roundings; (x + D/x)/2 would
            // round the whole length.
            x = x - (x * x - square) / (x + x); // 4.4 by Newton's method
            see(x);
        }
        x
    }
}

impl<F: Num> Walk<F> for Newton<F> {
    /// (d, D): the length, and the squared length, which the specular term uses.
    type Pixel = (F, F);

    #[inline(always)]
    fn next(&mut self) -> (F, F) {
        let n = self.normal.next(); // 4.2
        let square = n.dot(n); // D = N · N
        if self.steps == 0 {
            // No step is safe on this span: take true roots. The branch goes the same way for the
            // whole span.
            return (square.sqrt(), square);
        }
        self.length = self.root(square, |_| ());
        (self.length, square)
    }
    /// Reports the guesses, the last of which is d; none if roots are true.
    fn inside(&self, see: &mut dyn FnMut(&'static str, F)) {
        if self.steps > 0 {
            let n = self.normal.at;
            self.root(n.dot(n), |x| see("guess", x));
        }
    }
}
