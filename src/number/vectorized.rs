//! Loops over plain arrays, on the best instruction set of this machine.
//!
//! The compiler vectorises a loop over arrays by itself, but only for the instruction set that
//! every machine has. [`vectorized`] lets it use more. No result depends on the instruction set,
//! because the compiler neither reorders nor fuses floating-point operations.

/// Runs `work` on the best instruction set. Only inlined code is compiled for it: `work` itself
/// must be `#[inline(always)]`, and so must all functions and closures that it calls in its loops.
#[inline(always)]
pub(crate) fn vectorized<T>(work: impl FnOnce() -> T) -> T {
    #[cfg(all(feature = "simd", target_arch = "x86_64"))]
    if let Some(token) = fearless_simd::Level::new().as_avx2() {
        return super::simd::vectorize(token, work);
    }
    work()
}
