//! Memory: checks what a command needs before each stage, beside what the library estimates:
//! comparisons, files.

use super::drawing::RenderJob;
use super::input_name::path_behind;
use super::{CliError, Log};
use crate::compare::comparison::memory_needed;
use fastphong::compare::metrics::MAX_PERCEIVED;
use fastphong::frame::Frame;
use fastphong::memory::{bytes, check_free, check_size, of_engine, pixels};
pub use fastphong::memory::{check_frame, check_stored};
use fastphong::picture::image_file::{Format, Pair};
use fastphong::scene::file::SceneFile;
use fastphong::shading::Variant;
use std::path::Path;

/// Bytes per pixel while FLIP is computed (docs/pictures.md).
const FLIP_PIXEL: u64 = 110;
/// How many pixels FLIP filters at a time.
const FLIP_PIXELS: u64 = 1 << 20;

/// Checks that there is enough memory for the meshes of a scene, before they are read or made.
///
/// # Errors
/// If there is not.
pub fn check_meshes(file: &SceneFile) -> Result<(), CliError> {
    let folder = file.path().and_then(Path::parent).unwrap_or(Path::new(""));
    let size = |name: &str| std::fs::metadata(path_behind(&folder.join(name)));
    let size = |name: &str| size(name).map_or(0, |file| file.len());
    Ok(fastphong::memory::check_meshes(file.meshes(), size)?)
}

/// Checks that there is enough memory to compare methods on a frame, `at_once` frames in parallel.
/// Notes the metrics that are left out of a large picture.
///
/// # Errors
/// If there is not enough memory.
pub fn check(frame: &Frame, methods: &[Variant], at_once: usize, log: Log) -> Result<(), CliError> {
    let one = memory_needed(frame, methods).saturating_add(of_engine(frame));
    let needed = one.saturating_mul(at_once as u64);
    let [width, height] = [frame.picture_width(), frame.picture_height()];
    let needs = format!("{width}x{height}: comparing needs about {}", bytes(needed));
    check_free(needed, &needs, "fewer pixels or samples, or fewer methods")?;
    if width * height > MAX_PERCEIVED {
        let left_out = format!("over {MAX_PERCEIVED} pixels SSIM and FLIP are left out");
        log.note(&format!("{needs} of memory; {left_out}"));
    }
    Ok(())
}

/// Checks that there is enough memory for the picture of a job: first to write it as a file of the
/// format `written`, then to compare it with a file of the format `compared`.
///
/// # Errors
/// If there is not.
pub fn check_picture(
    job: &RenderJob,
    written: Option<Format>,
    compared: Option<Format>,
) -> Result<(), CliError> {
    let pixels = pixels(job.size());
    let writing = written.map_or(0, |format| job.memory_needed(format));
    // Beside the picture there are the reference, of at most 16 bytes per pixel, and the map.
    let comparing = compared.map_or(0, |format| {
        job.memory_needed(format).saturating_add((16 + 4) * pixels)
    });
    let needed = writing
        .max(comparing)
        .saturating_add(of_engine(job.frame()));
    Ok(check_size(job.size(), &job.name, needed)?)
}

/// Checks that there is enough memory to compare two picture files and draw a map.
///
/// # Errors
/// If there is not.
pub fn check_pair(pair: &Pair<'_>) -> Result<(), CliError> {
    let size = pair.common_size();
    let pixels = pixels(size);
    let flip = if pixels <= MAX_PERCEIVED as u64 {
        FLIP_PIXEL * pixels.min(FLIP_PIXELS) + 4 * pixels
    } else {
        0
    };
    Ok(check_size(size, "comparing", flip + 4 * pixels)?)
}

/// Checks that there is enough memory to pack a pair of pictures of `size` for a page, which shows
/// them in the size `shown`.
///
/// # Errors
/// If there is not.
pub fn check_packing(size: [usize; 2], shown: [usize; 2]) -> Result<(), CliError> {
    // The map; then a smaller picture, the files of three, and the space in which a list grows.
    let needed = 4 * pixels(size) + (4 + 3 * 4 + 2 * 4) * pixels(shown);
    Ok(check_size(size, "the page", needed)?)
}

/// Checks that there is enough memory to write a page of `length` bytes.
///
/// # Errors
/// If there is not.
pub fn check_page(length: u64) -> Result<(), CliError> {
    // Its pairs and the page, each a text that grows, and the pair that is being written.
    let needed = length.saturating_mul(2 + 2 + 1);
    let needs = format!("a page of {} needs about {}", bytes(length), bytes(needed));
    Ok(check_free(needed, &needs, "fewer or smaller pictures")?)
}

/// Checks that there is enough memory to hold a file of `length` bytes.
///
/// # Errors
/// If there is not.
pub fn check_file(path: &Path, length: u64) -> Result<(), CliError> {
    let needs = format!("{}: it needs about {}", path.display(), bytes(length));
    Ok(check_free(length, &needs, "a smaller file")?)
}

/// Checks that there is enough memory for the rows that `--radius` keeps around each pixel.
///
/// # Errors
/// If there is not.
pub fn check_rows(size: [usize; 2], radius: usize) -> Result<(), CliError> {
    // Rows of both pictures, with four values per pixel.
    let rows = 2 * (2 * radius as u64 + 1);
    let needed = rows * size[0] as u64 * size_of::<[f64; 4]>() as u64;
    Ok(check_size(size, "comparing within a radius", needed)?)
}
