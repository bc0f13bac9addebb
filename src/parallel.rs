//! Work that is cut into pieces: on as many threads as the current pool has, or one after the other.

#[cfg(feature = "threads")]
std::thread_local! {
    /// What a thread keeps between pieces of work.
    static KEPT: core::cell::RefCell<crate::raster::Scratch> = core::cell::RefCell::default();
}

/// Does `work` on each chunk of `size` elements with its number.
pub(crate) fn each_chunk<T: Send>(
    all: &mut [T],
    size: usize,
    work: impl Fn(usize, &mut [T], &mut crate::raster::Scratch) + Sync,
) {
    #[cfg(feature = "threads")]
    {
        use rayon::prelude::*;
        all.par_chunks_mut(size).enumerate().for_each(|(number, chunk)| {
            KEPT.with_borrow_mut(|kept| work(number, chunk, kept));
        });
    }
    #[cfg(not(feature = "threads"))]
    {
        let mut kept = crate::raster::Scratch::default();
        for (number, chunk) in all.chunks_mut(size).enumerate() {
            work(number, chunk, &mut kept);
        }
    }
}
