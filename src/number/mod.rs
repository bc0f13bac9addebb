//! Arithmetic backends: a shading method is written once, over [`Num`], and compiled for each of them.
//!
//! | backend | a number is | used by |
//! |---|---|---|
//! | scalar | one `f32` | the span engine, the barycentric renderer, set-up |
//! | SIMD (feature `simd`) | a block of 8 or 16 neighbouring pixels | the row engine, for vertices and pixels |
//! | counting | an `f32` that counts every operation on it | `fastphong explain`, `tests/conformance/counts.rs` |
//!
//! Constants are plain `f32` on the right-hand side: `n * 2.0`, `x.max(0.0)`. Every operation is `#[inline(always)]`: a
//! function that is not inlined into a pixel loop loses the instruction set that the loop is compiled for.
//!
//! `level.rs` names the instruction sets; `simd.rs` chooses the width of a block for each; `lanes.rs` has the integers and masks of the
//! row engine. `parallel.rs` spreads loops over threads, `vectorized.rs` over registers. `suggest.rs` words errors about names,
//! `written.rs` numbers in messages.

mod counting;
#[cfg(feature = "simd")]
pub(crate) mod lanes;
mod level;
mod name_error;
pub(crate) mod parallel;
#[cfg(feature = "simd")]
mod powf;
mod scalar;
#[cfg(feature = "simd")]
#[doc(hidden)]
pub mod simd;
pub(crate) mod split_mix;
#[doc(hidden)]
pub mod suggest;
#[cfg(test)]
pub(crate) mod test_random;
mod vec3;
pub(crate) mod vectorized;
mod written;

pub use counting::{Counted, Counter, Counts};
pub use level::Level;
pub use name_error::NameError;
pub use vec3::{Vec3, vec3};
pub(crate) use vectorized::vectorized;
pub(crate) use written::Written;

use core::ops::{Add, Div, Mul, Neg, Sub};

/// Pixels of a block of the G-buffer.
pub const BLOCK: usize = 8;

/// Multiplication followed by an addition.
pub trait MulAdd: Sized + Mul<Output = Self> + Add<Output = Self> {
    /// Returns `self · factor + summand`, rounded once where the backend has one instruction for it, else twice.
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        self * factor + summand
    }
}

/// A number of an arithmetic backend: one pixel's value, or those of a block of pixels.
pub trait Num:
    Copy
    + Neg<Output = Self>
    + Sub<Output = Self>
    + Div<Output = Self>
    + Add<f32, Output = Self>
    + Sub<f32, Output = Self>
    + Mul<f32, Output = Self>
    + MulAdd
{
    /// Pixels that one number holds.
    const WIDTH: usize;
    /// A number of one pixel.
    type One: Real;

    /// Returns `x` as a number of one pixel.
    fn one(self, x: f32) -> Self::One;
    /// Returns the numbers that `of` gives for each pixel.
    fn of_each(self, of: impl FnMut(usize) -> Self::One) -> Self;
    /// Returns `x` as a number of this backend.
    fn broadcast(self, x: f32) -> Self;
    /// Returns the square root.
    fn sqrt(self) -> Self;
    /// Returns 1/√x for x > 0 by a root and a division, which round alike on all processors. Their estimates of 1/√x do not.
    #[inline(always)]
    fn rsqrt(self) -> Self {
        self.broadcast(1.0) / self.sqrt()
    }
    /// Returns `self`, 0 or more, to the power `exponent`.
    fn powf(self, exponent: f32) -> Self;
    /// Returns 2 to the power `self`, of −126..127.
    fn exp2(self) -> Self;
    /// Returns the entry of a table at `self`, 0 ≤ `self` ≤ `table.len() − 1`, linear between entries.
    fn lookup(self, table: &[f32]) -> Self;
    /// Returns the larger of `self` and `least`; `least` where `self` is NaN.
    fn max(self, least: f32) -> Self;
    /// Returns `self` where `condition > least`, else 0 (also where `condition` is NaN).
    fn gate(self, condition: Self, least: f32) -> Self;
    /// True if any pixel of the block is over `least`.
    fn any_over(self, least: f32) -> bool;
}

/// A number of the set-up of edges and runs, where angles are affordable.
pub trait Real: Num<One = Self> {
    /// Returns sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Returns the angle in radians of the point (`x`, self).
    fn atan2(self, x: Self) -> Self;
    /// Returns the plain value, to decide by.
    fn value(self) -> f32;
}
