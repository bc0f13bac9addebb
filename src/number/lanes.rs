//! What the engines need of a machine beyond its numbers: groups of neighbouring pixels in memory, and masks over them.

use super::{Level, Machine, Scalar};

/// A machine whose groups of pixels can be loaded, compared, masked and stored.
///
/// Its set-up runs on plain `f32`. A mask says of each of the [`Machine::WIDTH`] pixels of a group whether it is meant.
pub trait Lanes: Machine<One = f32> {
    /// A choice among the pixels of a group.
    type Mask: Copy;
    /// Three integers at each of eight pixels.
    type Edges: Copy;

    /// Does `work` with the instructions of this machine: what is inlined into it is compiled for them.
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T;

    /// The group that `from` begins with; it has `WIDTH` values or more.
    fn load(self, from: &[f32]) -> Self::F;
    /// Stores a group over the first `WIDTH` values of `to`.
    fn store(self, x: Self::F, to: &mut [f32]);

    /// The first `n` pixels of a group, all of them if it has no more.
    fn first_lanes(self, n: usize) -> Self::Mask;
    /// Where `a` < `b`.
    fn less(self, a: Self::F, b: Self::F) -> Self::Mask;
    /// Where both are.
    fn and(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Whether any pixel is meant.
    fn any(self, mask: Self::Mask) -> bool;
    /// `new` where `mask` says so, else `old`.
    fn blend(self, mask: Self::Mask, new: Self::F, old: Self::F) -> Self::F;

    /// Three linear functions at eight pixels from a first one on, whatever the width: `at + k step`.
    fn edges(self, at: [i32; 3], step: [i32; 3]) -> Self::Edges;
    /// The same functions where each has grown.
    fn beside(self, edges: Self::Edges, growth: [i32; 3]) -> Self::Edges;
    /// Bit k: whether all three are 0 or more at pixel k.
    fn inside(self, edges: Self::Edges) -> u32;

    /// Stores the colours of a group as [`quantise`](crate::encoding::quantise) does, opaque where `covered`, and
    /// `background` elsewhere, over the first `WIDTH` texels of `to`.
    fn pack(self, rgb: [Self::F; 3], covered: Self::Mask, background: [u8; 4], to: &mut [[u8; 4]]);
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
            Level::Sse42 => {
                if let Some(token) = here.as_sse4_2() {
                    return Ok(job.run(Wide(token)));
                }
            }
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
