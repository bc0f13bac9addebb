//! Memory: what a comparison or a reference picture needs, said and checked before it begins.
//!
//! A system that has too little ends a program without a word, at any time.

use super::drawing::RenderJob;
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
    let [width, height] = [frame.picture_width(), frame.picture_height()];
    let needs = format!(
        "{width}x{height}: comparing needs about {}",
        gigabytes(needed)
    );
    check_free(needed, &needs, "fewer pixels or samples, or fewer methods")?;
    if width * height > MAX_PERCEIVED {
        let left_out = format!("over {MAX_PERCEIVED} pixels SSIM and FLIP are left out");
        log.note(&format!("{needs} of memory; {left_out}"));
    }
    Ok(())
}

/// Checks that there is memory for a picture in `f64`.
///
/// # Errors
/// When there is not.
pub fn check_picture(job: &RenderJob) -> Result<(), CliError> {
    let (needed, [width, height]) = (job.memory_needed(), job.size());
    let needs = format!(
        "{width}x{height}: {} needs about {}",
        job.name,
        gigabytes(needed)
    );
    check_free(needed, &needs, "fewer pixels or samples")
}

fn check_free(needed: u64, needs: &str, expected: &str) -> Result<(), CliError> {
    match Machine::free_memory() {
        Some(free) if free < needed => {
            let free = gigabytes(free);
            Err(format!("{needs} of memory, and {free} are free: expected {expected}").into())
        }
        _ => Ok(()),
    }
}

fn gigabytes(bytes: u64) -> String {
    format!("{:.1} GB", bytes as f64 / 1e9)
}
