//! Shared by the tests: reproducible random values, the shipped scenes, and frames of random
//! shapes.

pub mod cases;
pub mod differences;
pub mod drawings;
pub mod renderers;
#[allow(dead_code, reason = "the crate's own tests need more of it")]
#[path = "../../../src/number/test_random.rs"]
mod test_random;

use cases::Size;
use fastphong::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::Material;
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::read::load_mesh;
use fastphong::picture::LinearPicture;
use fastphong::raster::{Plan, Renderer};
use fastphong::scene::file::{SceneFile, UnusableMesh};
use fastphong::scene::{HiddenSurfaces, Light, Lighting, Scene};
use fastphong::shading::{METHODS, MethodRow};
use glam::DVec3;
use std::path::{Path, PathBuf};
use std::sync::Arc;
pub(crate) use test_random::Random;

/// Returns the methods that compute in floats. Methods in integers have errors by design.
pub fn floats() -> &'static [MethodRow] {
    let all = METHODS.iter().position(|entry| entry.is_integer);
    &METHODS[..all.unwrap_or(METHODS.len())]
}

/// Returns the float methods that can draw a frame.
pub fn floats_on(frame: &Frame) -> impl Iterator<Item = &'static MethodRow> + use<'_> {
    let is_for = move |entry: &&'static MethodRow| {
        let plan = entry.variant().plan(frame, Renderer::LECTURE);
        !matches!(plan, Plan::Refused(_))
    };
    floats().iter().filter(is_for)
}

/// Returns the float methods whose errors by design on a frame are below a grey level, so that
/// their bounds hide no fault.
pub fn exact_on(frame: &Frame) -> impl Iterator<Item = &'static MethodRow> + use<'_> {
    floats_on(frame).filter(|entry| entry.variant().approximation(frame) < 1.0 / 255.0)
}

/// Draws a frame by the span engine, with default parameters.
pub fn linear(entry: &'static MethodRow, frame: &Frame) -> LinearPicture {
    let picture = entry.variant().render_linear(frame);
    picture.expect("a method for the frame")
}

/// Returns the names of all shipped scenes.
pub fn shipped() -> Vec<String> {
    let files = std::fs::read_dir(scenes()).expect("the folder of shipped scenes");
    let mut names: Vec<String> = files
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .map(|path| {
            let stem = path.file_stem().expect("a name");
            stem.to_string_lossy().into_owned()
        })
        .collect();
    names.sort();
    assert!(names.len() >= 8, "at least eight scenes are shipped");
    names
}

/// Returns the folder of shipped scenes.
fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

/// Loads a shipped scene at its own size, or at `size`.
pub fn scene(name: &str, size: Size) -> Scene {
    let path = scenes().join(format!("{name}.toml"));
    let mut file = SceneFile::load(path).unwrap_or_else(|e| panic!("{e}"));
    if let Some((width, height)) = size {
        let sides = format!("[image]\nwidth = {width}\nheight = {height}");
        let sides = SceneFile::parse(&sides, "size").unwrap_or_else(|e| panic!("{e}"));
        file.overlay(sides.table().clone());
    }
    let load = |spec: &str, folder: &Path| match spec.strip_prefix("builtin:") {
        Some(spec) => builtin(spec)
            .map(|mesh| (Arc::new(mesh), Default::default()))
            .map_err(|e| UnusableMesh::new(e.to_string())),
        None => load_mesh(&folder.join(spec))
            .map(|l| (Arc::new(l.mesh), l.notes))
            .map_err(|e| UnusableMesh::new(e.to_string())),
    };
    file.resolve(load).unwrap_or_else(|e| panic!("{e}")).scene
}

/// Returns a lighting with one light from straight ahead. The colour of a normal (√(1−i²), 0, i) is
/// i.
pub fn plain_lighting() -> Lighting {
    let material = Material {
        ambient: [0.0; 3],
        diffuse: [1.0; 3],
        specular: [0.0; 3],
        shininess: 1.0,
    };
    Lighting::new(
        &material,
        [0.0; 3],
        &[Light::directional(DVec3::Z, [1.0; 3])],
        DVec3::Z,
    )
}

/// Returns a normal whose colour under [`plain_lighting`] is `intensity`.
pub fn normal_of(intensity: f32) -> [f32; 3] {
    [
        (1.0 - intensity * intensity).max(0.0).sqrt(),
        0.0,
        intensity,
    ]
}

/// Returns a corner at sub-pixel (x, y) with a depth and an intensity under [`plain_lighting`].
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    pub x: i32,
    pub y: i32,
    pub depth: f32,
    pub intensity: f32,
}

/// Adds a polygon with these corners.
pub fn add(builder: &mut FrameBuilder, material: u32, source: u32, corners: &[Corner]) {
    let vertices: Vec<u32> = corners
        .iter()
        .map(|c| {
            builder.vertex(Vertex {
                x: SubPixel::from_bits(c.x),
                y: SubPixel::from_bits(c.y),
                depth: c.depth.into(),
                inv_w: 1.0,
                normal: normal_of(c.intensity),
                material,
            })
        })
        .collect();
    builder.polygon(&vertices, [0.0, 0.0, 1.0], source);
}

/// Builds a frame of polygons, each a list of its corners.
pub fn frame(width: u32, height: u32, depth_test: bool, polygons: &[Vec<Corner>]) -> Frame {
    let mut builder = FrameBuilder::new(width, height);
    builder.hidden_surfaces(if depth_test {
        HiddenSurfaces::default()
    } else {
        HiddenSurfaces::DrawOrder
    });
    let material = builder.lighting(plain_lighting());
    for (number, corners) in polygons.iter().enumerate() {
        add(&mut builder, material, number as u32, corners);
    }
    builder.finish().expect("corners inside the guard band")
}

/// Returns a polygon of random corners, which mostly crosses itself. One polygon in three has its
/// corners on the grid of pixel centres, where ties are common.
pub fn random_polygon(random: &mut Random, width: i32, height: i32, corners: usize) -> Vec<Corner> {
    let grid = random.below(3) == 0;
    let reach = [40, 200, 2000][random.below(3) as usize];
    let (cx, cy) = (
        random.below(width as u64 * 256) as i32,
        random.below(height as u64 * 256) as i32,
    );
    let mut coordinate = |middle: i32| {
        let at = middle + (random.below(2 * reach * 16) as i32 - reach as i32 * 16);
        if grid { at / 128 * 128 } else { at }
    };
    let places: Vec<(i32, i32)> = (0..corners)
        .map(|_| (coordinate(cx), coordinate(cy)))
        .collect();
    places
        .into_iter()
        .map(|(x, y)| Corner {
            x,
            y,
            depth: random.share(),
            intensity: random.share(),
        })
        .collect()
}
