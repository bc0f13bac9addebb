//! Memory: what a comparison needs, said and checked before it begins.
//!
//! A system that has too little ends a program without a word, at any time.

use super::{CliError, Log};
use fastphong::compare::comparison::memory_needed;
use fastphong::compare::timing::Machine;
use fastphong::frame::Frame;
use fastphong::shading::Variant;

/// Pictures of more pixels than this are told what they need: it is over 10 GB with all methods.
const LARGE: usize = 1 << 26;

/// Notes what the comparison of a large picture needs, `at_once` of them side by side.
///
/// # Errors
/// When that is more than there is.
pub fn check(frame: &Frame, methods: &[Variant], at_once: usize, log: Log) -> Result<(), CliError> {
    let needed = memory_needed(frame, methods).saturating_mul(at_once as u64);
    let (width, height) = (frame.picture_width(), frame.picture_height());
    let gigabytes = |bytes: u64| format!("{:.1} GB", bytes as f64 / 1e9);
    let needs = format!(
        "{width}x{height}: comparing needs about {}",
        gigabytes(needed)
    );
    match Machine::free_memory() {
        Some(free) if free < needed => {
            let expected = "expected fewer pixels or samples, or fewer methods";
            Err(format!(
                "{needs} of memory, and {} are free: {expected}",
                gigabytes(free)
            )
            .into())
        }
        _ => {
            if width * height > LARGE {
                log.note(&format!("{needs} of memory"));
            }
            Ok(())
        }
    }
}
