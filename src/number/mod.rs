//! Arithmetic backends. A shading method is written once, over [`Num`], and compiled for each
//! backend.
//!
//! | backend | a value is | used by |
//! |---|---|---|
//! | scalar | one `f32` | the span engine, the barycentric renderer, set-up |
//! | SIMD (feature `simd`) | a block of 8 or 16 neighbouring pixels | the row engine, for vertices and pixels |
//! | counting | an `f32` that counts every operation on it | `fastphong explain`, `tests/conformance/counts.rs` |
//!
//! A constant is a plain `f32` on the right-hand side: `n * 2.0`, `x.max(0.0)`.
//!
//! ```
//! use fastphong::number::{Num, Vec3, vec3};
//!
//! /// Returns N·L, clamped at 0: for one pixel or for a block of them.
//! fn diffuse<F: Num>(normal: Vec3<F>, light: [f32; 3]) -> F {
//!     normal.dot(vec3(light).broadcast(normal.x)).max(0.0)
//! }
//! assert_eq!(diffuse(vec3([0.0, 0.6, 0.8]), [0.0, 0.0, 1.0]), 0.8);
//! ```
//!
//! Every operation is `#[inline(always)]`. A function that is not inlined into a pixel loop is not
//! compiled for the loop's instruction set.

#[doc(hidden)]
pub mod counted;
mod counting;
#[cfg(feature = "simd")]
pub(crate) mod lanes;
mod name_error;
pub(crate) mod parallel;
#[cfg(feature = "simd")]
mod powf;
mod scalar;
#[cfg(feature = "simd")]
pub(crate) mod simd;
mod simd_level;
pub(crate) mod split_mix;
#[doc(hidden)]
pub mod suggest;
#[cfg(test)]
pub(crate) mod test_random;
mod vec3;
pub(crate) mod vectorized;
mod written;

pub use counting::{Counted, Counter, Counts};
pub use name_error::NameError;
pub use simd_level::SimdLevel;
pub use vec3::{Vec3, vec3};
pub(crate) use vectorized::vectorized;
pub(crate) use written::Written;

use core::ops::{Add, Div, Mul, Neg, Sub};

/// How many pixels a block of the G-buffer holds.
pub(crate) const BLOCK: usize = 8;

/// Multiplication followed by addition.
pub trait MulAdd: Sized + Mul<Output = Self> + Add<Output = Self> {
    /// Returns `self · factor + summand`. It is rounded once if the backend has an instruction for
    /// it, else twice.
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        self * factor + summand
    }
}

/// A value in an arithmetic backend: of one pixel, or of each pixel in a block.
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
    /// How many pixels a value holds.
    const WIDTH: usize;
    /// The value of one pixel.
    type One: Real;

    /// Returns `x` as the value of one pixel.
    fn one(self, x: f32) -> Self::One;
    /// Returns `of(k)` for each pixel k of the block.
    fn of_each(self, of: impl FnMut(usize) -> Self::One) -> Self;
    /// Returns `x` for every pixel of the block.
    fn broadcast(self, x: f32) -> Self;
    /// Returns the square root.
    fn sqrt(self) -> Self;
    /// Returns 1/√x for x > 0, by a root and a division. Both round alike on all processors, unlike
    /// the instructions that estimate 1/√x.
    #[inline(always)]
    fn rsqrt(self) -> Self {
        self.broadcast(1.0) / self.sqrt()
    }
    /// Returns `self` to the power `exponent`, for `self` of 0 or more.
    fn powf(self, exponent: f32) -> Self;
    /// Returns 2 to the power `self`, for `self` in −126..=127.
    fn exp2(self) -> Self;
    /// Returns the table's entry at `self`, interpolated linearly, for `self` in
    /// 0..=`table.len() − 1`.
    fn lookup(self, table: &[f32]) -> Self;
    /// Returns the larger of `self` and `least`, and `least` where `self` is NaN.
    fn max(self, least: f32) -> Self;
    /// Returns `self` where `condition > least`, and 0 elsewhere, also where `condition` is NaN.
    fn gate(self, condition: Self, least: f32) -> Self;
    /// True if any pixel of the block is above `least`.
    fn any_over(self, least: f32) -> bool;
}

/// A value of one pixel, used to set up edges and runs. It has the functions that are too dear for
/// pixels.
pub trait Real: Num<One = Self> {
    /// Returns sine and cosine of the angle `self`, in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Returns the angle of the point (`x`, `self`), in radians.
    fn atan2(self, x: Self) -> Self;
    /// Returns the plain `f32`, for decisions.
    fn value(self) -> f32;
}
