//! Memory: estimates what meshes, a frame and a picture need, and checks it before each stage.
//!
//! Without the check, a system that runs out of memory kills the program without a message, and an
//! allocation that fails aborts it.

mod free;

use crate::drawing::Drawing;
use crate::frame::Frame;
use crate::mesh::builtin::polygon_count;
use crate::number::counted::grouped;
use crate::scene::Scene;
use crate::scene::input::is_mesh_file;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use core::hint::black_box;
use free::free_memory;
use std::collections::HashSet;

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

/// The error of work that needs more memory than there is: how much, and what to do.
#[derive(Clone, Debug)]
pub struct TooLittleMemory(String);

impl fmt::Display for TooLittleMemory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for TooLittleMemory {}

/// Checks that there is enough memory for meshes, before they are read or made. `file_size` returns
/// the size of a mesh file in bytes, 0 if it is unknown.
///
/// # Errors
/// If there is not.
pub fn check_meshes<'a>(
    names: impl Iterator<Item = &'a str>,
    file_size: impl Fn(&str) -> u64,
) -> Result<(), TooLittleMemory> {
    let names: HashSet<&str> = names.collect();
    let of_mesh = |name: &&str| match name.strip_prefix("builtin:") {
        Some(spec) => polygon_count(spec).map_or(0, |count| count.saturating_mul(BUILTIN_POLYGON)),
        None if is_mesh_file(name) => file_size(name).saturating_mul(MESH_FILE_BYTE),
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
pub fn check_frame(scene: &Scene) -> Result<(), TooLittleMemory> {
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

/// Checks that there is enough memory to draw a frame into a stored picture, with `beside` more
/// bytes for each pixel.
///
/// # Errors
/// If there is not.
pub fn check_stored(frame: &Frame, drawing: &Drawing, beside: u64) -> Result<(), TooLittleMemory> {
    let size = [frame.picture_width(), frame.picture_height()];
    let needed = of_engine(frame).saturating_add(drawing.memory_needed(frame));
    check_size(size, &drawing.to_string(), needed + beside * pixels(size))
}

/// Checks that there is enough memory for something about a picture of this size.
///
/// # Errors
/// If there is not.
pub fn check_size(
    [width, height]: [usize; 2],
    name: &str,
    needed: u64,
) -> Result<(), TooLittleMemory> {
    let needs = format!("{width}x{height}: {name} needs about {}", bytes(needed));
    check_free(needed, &needs, "fewer pixels or samples")
}

/// Returns how many pixels a picture of this size has.
pub fn pixels([width, height]: [usize; 2]) -> u64 {
    width as u64 * height as u64
}

/// Estimates the bytes that an engine needs beside the picture and the frame.
pub fn of_engine(frame: &Frame) -> u64 {
    let polygons = frame.polygons().len() as u64;
    let [own, a_light] = LIT_POLYGON;
    let lit = if frame.is_local() {
        own + a_light * frame.light_count() as u64
    } else {
        0
    };
    polygons.saturating_mul(DRAWN_POLYGON + lit)
}

/// Checks that `needed` bytes of memory are free. `needs` begins the message, `expected` ends it.
///
/// # Errors
/// If there are not.
pub fn check_free(needed: u64, needs: &str, expected: &str) -> Result<(), TooLittleMemory> {
    if let Some(free) = free_memory()
        && free < needed
    {
        let free = bytes(free);
        let problem = format!("{needs} of memory, but {free} are free");
        return Err(TooLittleMemory(format!("{problem}: expected {expected}")));
    }
    // The system may have a limit that it does not report. Reserving all the memory at once shows
    // it. `black_box` keeps the compiler from removing the unused list.
    let mut all: Vec<u8> = Vec::new();
    let is_there = usize::try_from(needed).is_ok_and(|size| all.try_reserve_exact(size).is_ok());
    black_box(&mut all);
    if is_there {
        Ok(())
    } else {
        let problem = format!("{needs} of memory, but there is less");
        Err(TooLittleMemory(format!("{problem}: expected {expected}")))
    }
}

/// Writes a number of bytes in MB or GB.
pub fn bytes(bytes: u64) -> String {
    match bytes {
        1_000_000_000.. => format!("{:.1} GB", bytes as f64 / 1e9),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}
