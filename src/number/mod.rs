//! Numbers, and the machines that make them.
//!
//! The methods are written once, over [`Num`]; which arithmetic they run on is decided by a [`Machine`]: [`Scalar`]
//! makes plain `f32`, `wide::Wide` (feature `simd`) makes groups of eight, [`Counting`] makes numbers that count every
//! operation. A machine has two kinds of numbers:
//! `One` for set-up (vertices, polygons, edges, span starts) and `F` for the pixel loop, which on a wide machine holds
//! [`Machine::WIDTH`] neighbouring pixels.
//!
//! Everything here is `#[inline(always)]`: a helper that is not inlined into the pixel loop costs a call a pixel.

mod counting;
mod lanes;
mod level;
mod pair;
mod planes;
#[cfg(feature = "simd")]
mod power;
mod scalar;
#[cfg(feature = "simd")]
pub mod wide;

pub use counting::{Counted, Counter, Counting, Counts};
pub use lanes::{Int, Lanes};
pub(crate) use lanes::{LanesJob, on_level, on_wide_level};
pub use level::{Level, LevelError};
pub(crate) use pair::Pair;
pub use planes::Planes;
pub(crate) use planes::{get_each, put_each};
pub use scalar::Scalar;

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number: one pixel's or a group's. Carries no knowledge of how to be made.
pub trait Num:
    Copy
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The square root.
    fn sqrt(self) -> Self;
    /// 1 / √ of itself, over 0: by the processor's estimate and one step of Newton's where it has one (off by less than
    /// 2⁻²¹ of the value, see [`wide`]), else by a root and a division.
    fn over_sqrt(self) -> Self;
    /// `self · factor + summand`, rounded once where the machine has one instruction for it, else twice.
    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        self * factor + summand
    }
    /// `self · factor − subtrahend`, rounded likewise.
    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        self * factor - subtrahend
    }
    /// The larger of both; where this one is NaN, `other`, which is none.
    fn max(self, other: Self) -> Self;
    /// The smaller of both; where this one is NaN, `other`, which is none.
    fn min(self, other: Self) -> Self;
    /// Itself where `condition` > 0, else 0 (also where `condition` is NaN).
    fn gate(self, condition: Self) -> Self;
    /// Whether it, which is not NaN, is over `least` at any pixel of a group; `least` is the same at all of them.
    fn is_over(self, least: Self) -> bool;
    /// Itself, 0 or more, to the power `exponent`.
    fn powf(self, exponent: f32) -> Self;
}

/// A number of the set-up, where decisions and trigonometric functions are affordable.
pub trait Real: Num {
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// The angle in radians of the point (`x`, self).
    fn atan2(self, x: Self) -> Self;
    /// Its value, to decide by.
    fn value(self) -> f32;
}

/// An arithmetic: makes its numbers.
pub trait Machine: Copy + Send + Sync {
    /// Numbers of the set-up.
    type One: Real;
    /// Numbers of the pixel loop.
    type F: Num;
    /// How many pixels one `F` holds.
    const WIDTH: usize;

    /// A number of the set-up.
    fn one(self, x: f32) -> Self::One;
    /// Three numbers of the set-up.
    #[inline(always)]
    fn three(self, v: [f32; 3]) -> [Self::One; 3] {
        [self.one(v[0]), self.one(v[1]), self.one(v[2])]
    }
    /// The same number for every pixel.
    fn splat(self, x: Self::One) -> Self::F;
    /// Three such numbers.
    #[inline(always)]
    fn splat3(self, v: [Self::One; 3]) -> [Self::F; 3] {
        [self.splat(v[0]), self.splat(v[1]), self.splat(v[2])]
    }
    /// `at + k step` for pixel k of the group.
    fn ramp(self, at: Self::One, step: Self::One) -> Self::F;
    /// `WIDTH step`: from one group to the next.
    fn stride(self, step: Self::One) -> Self::F;
    /// `WIDTH` values of a recurrence, in order.
    fn take(self, next: impl FnMut() -> Self::One) -> Self::F;
    /// The first value of a group.
    fn first(self, x: Self::F) -> f32;
}

/// `[f(0), f(1), …]`.
///
/// Not `core::array::from_fn`: on wide numbers that leaves a call inside the pixel loop (measured by the prototypes:
/// ten times slower), as it is not inlined into functions with target features.
#[inline(always)]
pub fn each<T: Copy, const L: usize>(mut f: impl FnMut(usize) -> T) -> [T; L] {
    // As a constant: what is not taken is not compiled, for any of the thousands of types that this is used with.
    if const { L == 0 } {
        return core::array::from_fn(f);
    }
    let mut all = [f(0); L];
    let mut i = 1;
    while i < L {
        all[i] = f(i);
        i += 1;
    }
    all
}

/// The dot product.
#[inline(always)]
pub fn dot<N: Num>(a: [N; 3], b: [N; 3]) -> N {
    a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
}
