//! Memory: estimates what a command needs, and checks it before each stage: meshes, frame,
//! pictures.
//!
//! Without the check, a system that runs out of memory kills the program without a message, and an
//! allocation that fails aborts it.

use super::drawing::RenderJob;
use super::input_name::path_behind;
use super::text::grouped;
use super::{CliError, Log};
use crate::compare::comparison::memory_needed;
use crate::compare::timing::free_memory;
use fastphong::compare::metrics::MAX_PERCEIVED;
use fastphong::frame::Frame;
use fastphong::mesh::builtin::polygon_count;
use fastphong::picture::image_file::{Format, Pair};
use fastphong::scene::Scene;
use fastphong::scene::file::SceneFile;
use fastphong::scene::input::is_mesh_file;
use fastphong::shading::Variant;
use std::collections::HashSet;
use std::hint::black_box;
use std::path::Path;

/// Bytes per polygon while a built-in mesh is made. A finished sphere of a million polygons
/// takes 110.
const BUILTIN_POLYGON: u64 = 200;

/// Bytes of memory per byte of a mesh file while it is read: for the file, its values in `f64`, and
/// the mesh. Quads take 5.4 without normals and 4.6 with them.
const MESH_FILE_BYTE: u64 = 6;

/// Bytes per polygon of a frame, with its share of the vertices.
const FRAME_POLYGON: u64 = 100;

/// Bytes per polygon while an engine draws: its edges, its entry in the drawing order, its share of
/// the vertex data.
const DRAWN_POLYGON: u64 = 200;

/// Bytes per polygon, and per light on it, if light differs between polygons: lights or eye are at
/// positions.
const LIT_POLYGON: [u64; 2] = [256, 96];

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
    let names: HashSet<&str> = file.meshes().collect();
    let of_mesh = |name: &&str| match name.strip_prefix("builtin:") {
        Some(spec) => polygon_count(spec).map_or(0, |count| count.saturating_mul(BUILTIN_POLYGON)),
        None if is_mesh_file(name) => {
            let found = std::fs::metadata(path_behind(&folder.join(name)));
            let size = found.map_or(0, |file| file.len());
            size.saturating_mul(MESH_FILE_BYTE)
        }
        None => 0,
    };
    let needed = names.iter().map(of_mesh).fold(0, u64::saturating_add);
    let needs = format!("its meshes need about {}", bytes(needed));
    check_free(needed, &needs, "a smaller mesh")
}

/// Checks that there is enough memory for the frame of a scene.
///
/// # Errors
/// If there is not.
pub fn check_frame(scene: &Scene) -> Result<(), CliError> {
    let objects = scene.objects.iter();
    let polygons: usize = objects.map(|object| object.mesh.polygon_count()).sum();
    let needed = (polygons as u64).saturating_mul(FRAME_POLYGON);
    let needs = format!(
        "{} polygons: projecting needs about {}",
        grouped(polygons),
        bytes(needed)
    );
    check_free(needed, &needs, "fewer polygons")
}

/// Checks that there is enough memory to compare methods on a frame, `at_once` frames in parallel.
/// Notes the metrics that are left out of a large picture.
///
/// # Errors
/// If there is not enough memory.
pub fn check(frame: &Frame, methods: &[Variant], at_once: usize, log: Log) -> Result<(), CliError> {
    let one = memory_needed(frame, methods).saturating_add(drawing(frame));
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
    let needed = writing.max(comparing).saturating_add(drawing(job.frame()));
    check_size(job.size(), &job.name, needed)
}

/// Checks that there is enough memory to draw a frame into a stored picture.
///
/// # Errors
/// If there is not.
pub fn check_stored(frame: &Frame, name: &str) -> Result<(), CliError> {
    let size = [frame.picture_width(), frame.picture_height()];
    let needed = drawing(frame).saturating_add(4 * pixels(size));
    check_size(size, name, needed)
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
    check_size(size, "comparing", flip + 4 * pixels)
}

/// Checks that there is enough memory to hold a file of `length` bytes.
///
/// # Errors
/// If there is not.
pub fn check_file(path: &Path, length: u64) -> Result<(), CliError> {
    let needs = format!("{}: it needs about {}", path.display(), bytes(length));
    check_free(length, &needs, "a smaller file")
}

/// Checks that there is enough memory for the rows that `--radius` keeps around each pixel.
///
/// # Errors
/// If there is not.
pub fn check_rows(size: [usize; 2], radius: usize) -> Result<(), CliError> {
    // Rows of both pictures, with four values per pixel.
    let rows = 2 * (2 * radius as u64 + 1);
    let needed = rows * size[0] as u64 * size_of::<[f64; 4]>() as u64;
    check_size(size, "comparing within a radius", needed)
}

fn check_size([width, height]: [usize; 2], name: &str, needed: u64) -> Result<(), CliError> {
    let needs = format!("{width}x{height}: {name} needs about {}", bytes(needed));
    check_free(needed, &needs, "fewer pixels or samples")
}

fn pixels([width, height]: [usize; 2]) -> u64 {
    width as u64 * height as u64
}

/// Estimates the bytes that an engine needs beside the picture and the frame.
fn drawing(frame: &Frame) -> u64 {
    let polygons = frame.polygons().len() as u64;
    let [own, a_light] = LIT_POLYGON;
    let lit = if frame.is_local() {
        own + a_light * frame.light_count() as u64
    } else {
        0
    };
    polygons.saturating_mul(DRAWN_POLYGON + lit)
}

fn check_free(needed: u64, needs: &str, expected: &str) -> Result<(), CliError> {
    if let Some(free) = free_memory()
        && free < needed
    {
        let free = bytes(free);
        return Err(format!("{needs} of memory, but {free} are free: expected {expected}").into());
    }
    // The system may have a limit that it does not report. Reserving all the memory at once shows
    // it. `black_box` keeps the compiler from removing the unused list.
    let mut all: Vec<u8> = Vec::new();
    let is_there = usize::try_from(needed).is_ok_and(|size| all.try_reserve_exact(size).is_ok());
    black_box(&mut all);
    if is_there {
        Ok(())
    } else {
        Err(format!("{needs} of memory, but there is less: expected {expected}").into())
    }
}

/// Writes a number of bytes in MB or GB.
fn bytes(bytes: u64) -> String {
    match bytes {
        1_000_000_000.. => format!("{:.1} GB", bytes as f64 / 1e9),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}
