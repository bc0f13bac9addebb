//! The `fastphong` command-line tool: sub-commands, report, lectures' figures, diagnosis, window.
//!
//! The crate `fastphong` draws. Nothing here is a stable interface.

extern crate alloc;

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
pub mod compare;
#[cfg(feature = "cli")]
pub mod diagnose;
pub mod lectures;
#[cfg(feature = "cli")]
pub mod report;
// Its tests need no display, so they run with all others. Without the window nothing else calls it.
#[cfg(any(feature = "view", all(test, feature = "cli")))]
#[cfg_attr(not(feature = "view"), allow(dead_code, unused_imports))]
mod view;
