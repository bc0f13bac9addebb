//! Memory: what a comparison needs, said and checked before it begins.
//!
//! A system that has too little ends a program without a word, at any time.

use super::{CliError, Log};
use fastphong::compare::comparison::memory_needed;
use fastphong::compare::metrics::MAX_PERCEIVED;
use fastphong::compare::timing::Machine;
use fastphong::frame::Frame;
use fastphong::shading::Variant;

/// Notes what the comparison of a large picture needs, `at_once` of them side by side, and what is left out.
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
            if width * height > MAX_PERCEIVED {
                let left_out = format!("over {MAX_PERCEIVED} pixels SSIM and FLIP are left out");
                log.note(&format!("{needs} of memory; {left_out}"));
            }
            Ok(())
        }
    }
}
