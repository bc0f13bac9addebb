//! Parallel loops over parts of arrays, on the threads of rayon's current pool. Without the feature
//! `threads`, the parts run one after the other.
//!
//! Results never depend on how many threads there are: arrays are cut by size only, and each part
//! writes only its own elements.

use alloc::vec;
use alloc::vec::Vec;
#[cfg(feature = "threads")]
use core::cell::Cell;

/// A slice, or several slices of one length, that can be split in two at an index.
pub trait Parts: Sized + Send {
    /// Returns how many elements there are.
    fn len(&self) -> usize;
    /// Splits off the first `at` elements.
    fn split(self, at: usize) -> (Self, Self);
}

impl<T: Sync> Parts for &[T] {
    fn len(&self) -> usize {
        <[T]>::len(self)
    }
    fn split(self, at: usize) -> (Self, Self) {
        self.split_at(at)
    }
}

impl<T: Send> Parts for &mut [T] {
    fn len(&self) -> usize {
        <[T]>::len(self)
    }
    fn split(self, at: usize) -> (Self, Self) {
        self.split_at_mut(at)
    }
}

impl<A: Parts, B: Parts> Parts for (A, B) {
    fn len(&self) -> usize {
        self.0.len()
    }
    fn split(self, at: usize) -> (Self, Self) {
        let (a, b) = (self.0.split(at), self.1.split(at));
        ((a.0, b.0), (a.1, b.1))
    }
}

#[cfg(feature = "threads")]
std::thread_local! {
    /// True while this thread works on a part.
    static IS_AT_WORK: Cell<bool> = const { Cell::new(false) };
}

/// Work on a part, until it is dropped, by a panic too. Holds if the thread was at work before.
#[cfg(feature = "threads")]
struct AtWork(bool);

#[cfg(feature = "threads")]
impl Drop for AtWork {
    fn drop(&mut self) {
        IS_AT_WORK.set(self.0);
    }
}

/// Runs both closures, in parallel if there is a second thread.
///
/// Within a part they run one after the other. A thread that waits for the other one takes up any
/// work meanwhile: were a shader to draw its texture in a `LazyLock`, this could be another part of
/// the picture that needs the texture.
pub(crate) fn join<A: Send, B: Send>(
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "threads")]
    if !IS_AT_WORK.get() {
        return rayon::join(a, b);
    }
    (a(), b())
}

/// Returns how many threads [`join`] may use.
pub(crate) fn threads() -> usize {
    #[cfg(feature = "threads")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "threads"))]
    1
}

/// Calls `work` for each run of `size` elements, and for the shorter rest, with the index of the
/// first element.
///
/// `work` is a trait object so that this recursion is compiled once for each kind of parts, and not
/// again for each shader.
pub(crate) fn for_each_chunk<P: Parts>(all: P, size: usize, work: &(dyn Fn(usize, P) + Sync)) {
    from(0, all, size, work);
}

/// Returns `of(0)`, `of(1)` … `of(count − 1)`, computed in runs of `chunk` elements.
pub fn collect<T: Clone + Default + Send>(
    count: usize,
    chunk: usize,
    of: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let mut all = vec![T::default(); count];
    for_each_chunk(&mut all[..], chunk, &|first, part: &mut [T]| {
        part.iter_mut()
            .enumerate()
            .for_each(|(i, value)| *value = of(first + i));
    });
    all
}

fn from<P: Parts>(first: usize, all: P, size: usize, work: &(dyn Fn(usize, P) + Sync)) {
    let chunks = all.len().div_ceil(size);
    if chunks <= 1 {
        if chunks == 1 {
            #[cfg(feature = "threads")]
            let _at_work = AtWork(IS_AT_WORK.replace(true));
            work(first, all);
        }
        return;
    }
    // Cut between two chunks, so that chunks are the same however the recursion splits them.
    let middle = chunks / 2 * size;
    let (left, right) = all.split(middle);
    join(
        || from(first, left, size, work),
        || from(first + middle, right, size, work),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_element_is_met_once_in_chunks_of_the_size() {
        for len in [0, 1, 6, 7, 8, 49, 50, 1000] {
            let (mut firsts, mut sizes) = (vec![usize::MAX; len], vec![0u8; len]);
            for_each_chunk(
                (&mut firsts[..], &mut sizes[..]),
                7,
                &|first, (firsts, sizes)| {
                    let size = firsts.len() as u8;
                    firsts.iter_mut().for_each(|f| *f = first);
                    sizes.iter_mut().for_each(|s| *s += size);
                },
            );
            let expected: Vec<_> = (0..len)
                .map(|i| (i / 7 * 7, (len - i / 7 * 7).min(7) as u8))
                .collect();
            assert_eq!(firsts.into_iter().zip(sizes).collect::<Vec<_>>(), expected);
        }
    }
}
