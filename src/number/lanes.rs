//! What the engines need of a machine beyond its numbers: groups of neighbouring pixels in memory, and masks over them.

use super::{Level, Machine, Scalar};
use core::ops::{Add, BitAnd, BitOr, BitXor, Mul, Sub};

/// A machine whose groups of pixels can be loaded, compared, masked and stored.
///
/// Its set-up runs on plain `f32`. A mask says of each of the [`Machine::WIDTH`] pixels of a group whether it is meant.
pub trait Lanes: Machine<One = f32> {
    /// A choice among the pixels of a group.
    type Mask: Copy;
    /// A whole number for each of them.
    type I: Int;
    /// Whether a group lies in one register. Where it does not, loops that are compiled apart for what is usual gain little, as
    /// registers run out, and would be a good part of what there is to compile.
    const IS_ONE_REGISTER: bool;

    /// Does `work` with the instructions of this machine: what is inlined into it is compiled for them.
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T;

    /// The group that `from` begins with; it has `WIDTH` values or more.
    fn load(self, from: &[f32]) -> Self::F;
    /// Stores a group over the first `WIDTH` values of `to`.
    fn store(self, x: Self::F, to: &mut [f32]);

    /// The pixels from number `from` on, before number `to`.
    fn lanes(self, from: usize, to: usize) -> Self::Mask;
    /// Where `a` < `b`.
    fn less(self, a: Self::F, b: Self::F) -> Self::Mask;
    /// Whether any pixel is meant.
    fn any(self, mask: Self::Mask) -> bool;
    /// `new` where `mask` says so, else `old`.
    fn blend(self, mask: Self::Mask, new: Self::F, old: Self::F) -> Self::F;

    /// Which pixels keep what they have: all bits where `outside` is below 0 or `new` is not less than `old`, else none;
    /// both are numbers.
    fn kept(self, outside: Self::I, new: Self::F, old: Self::F) -> Self::I;
    /// `old` where `kept` has all bits, `new` where it has none.
    fn keep(self, kept: Self::I, old: Self::F, new: Self::F) -> Self::F;

    /// Bit k: whether pixel k is meant.
    fn bits(self, mask: Self::Mask) -> u32;

    /// The same whole number everywhere.
    fn int(self, x: i32) -> Self::I;
    /// 0, 1, 2 and so on.
    fn counted(self) -> Self::I;
    /// The group that `from` begins with; it has `WIDTH` numbers or more.
    fn load_int(self, from: &[i32]) -> Self::I;
    /// Stores a group over the first `WIDTH` numbers of `to`.
    fn store_int(self, x: Self::I, to: &mut [i32]);
    /// Whole numbers as numbers, rounded once.
    fn number(self, x: Self::I) -> Self::F;
    /// Numbers whose magnitude is below 2³¹ as whole numbers, toward 0.
    fn truncated(self, x: Self::F) -> Self::I;
    /// Where a whole number is 0 or more.
    fn not_negative(self, x: Self::I) -> Self::Mask;

    /// Stores the colours of a group as [`quantise`](crate::encoding::quantise) does, opaque where `covered`, and
    /// `background` elsewhere, over the first `WIDTH` texels of `to`.
    fn pack(self, rgb: [Self::F; 3], covered: Self::Mask, background: [u8; 4], to: &mut [[u8; 4]]);
    /// The same of colours in levels, 255 for 1, whose magnitudes are below 2³¹; NaN becomes 0.
    fn pack_levels(
        self,
        levels: [Self::F; 3],
        covered: Self::Mask,
        background: [u8; 4],
        to: &mut [[u8; 4]],
    );
}

/// Whole numbers of 32 bits, of which no result may need more.
pub trait Int:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
{
    /// The smaller of both.
    fn min(self, other: Self) -> Self;
    /// The larger of both.
    fn max(self, other: Self) -> Self;
    /// Divided by 256, rounded down: from sub-pixels to pixels.
    fn whole_pixels(self) -> Self;
    /// −1 (all bits) where it is less than `other`, else 0.
    fn less(self, other: Self) -> Self;
    /// `a` where `mask` has all bits, `b` where it has none.
    #[inline(always)]
    fn choose(mask: Self, a: Self, b: Self) -> Self {
        b ^ ((a ^ b) & mask)
    }
}

/// Something to be done on an instruction set.
pub(crate) trait LanesJob {
    /// What it gives.
    type Out;
    /// Does it.
    fn run<M: Lanes>(self, m: M) -> Self::Out;
}

/// Does `job` on `level`, or one pixel at a time where this machine does not have it.
pub(crate) fn on_level<J: LanesJob>(level: Level, job: J) -> J::Out {
    match on_wide_level(level, job) {
        Ok(out) => out,
        Err(job) => job.run(Scalar),
    }
}

/// Does `job` on `level`, several pixels at a time, or gives it back where `level` has one pixel or this machine does not
/// have it. For jobs that are never done one pixel at a time: they are not compiled for that.
pub(crate) fn on_wide_level<J: LanesJob>(level: Level, job: J) -> Result<J::Out, J> {
    #[cfg(feature = "simd")]
    {
        use super::wide::Wide;
        let here = fearless_simd::Level::new();
        match level {
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => {
                if let Some(token) = here.as_avx2() {
                    return Ok(job.run(Wide(token)));
                }
            }
            #[cfg(target_arch = "aarch64")]
            Level::Neon => {
                if let Some(token) = here.as_neon() {
                    return Ok(job.run(Wide(token)));
                }
            }
            _ => {}
        }
    }
    let _ = level;
    Err(job)
}
