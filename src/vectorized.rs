//! Loops over plain arrays on the best instruction set that this machine has.
//!
//! The compiler makes vectors of a loop over arrays by itself, but of what every machine has, unless it is told otherwise. No
//! result depends on the instruction set: it neither orders operations anew nor joins them.

use crate::number::{Lanes, LanesJob, Level, on_level};

/// Does `work` on the best instruction set. Only what is inlined into it is compiled for that: `work` itself must be
/// `#[inline(always)]`, and so must all functions and closures that it calls in its loops.
#[inline(always)]
pub(crate) fn vectorized<T>(work: impl FnOnce() -> T) -> T {
    on_level(Level::best(), Work(work))
}

struct Work<F>(F);

impl<T, F: FnOnce() -> T> LanesJob for Work<F> {
    type Out = T;

    fn run<M: Lanes>(self, m: M) -> T {
        m.vectorize(self.0)
    }
}
