//! Scene files: the meaning of each key, errors and their texts, and the shipped scenes.

mod errors;
mod expect;
mod light_errors;
mod meaning;
mod reading;
mod round_trip;
mod shipped;

use super::resolve::MeshResult;
use crate::mesh::{MeshBuilder, PolygonMesh};
use glam::Vec3;
use std::path::Path;
use std::string::String;
use std::sync::Arc;

/// Returns the cube −1..=1 as six quads, counter-clockwise from outside.
fn cube() -> PolygonMesh {
    let sign = |bit: u32| if bit == 0 { -1.0 } else { 1.0 };
    let corner = |i: u32| Vec3::new(sign(i & 1), sign(i & 2), sign(i & 4));
    let mut mesh = MeshBuilder::new((0..8).map(corner).collect());
    for face in [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ] {
        mesh.polygon(&face);
    }
    mesh.finish().expect("a cube is a valid mesh")
}

/// Loads a cube for every mesh.
fn cubes(_: &str, _: &Path) -> MeshResult {
    Ok((Arc::new(cube()), Default::default()))
}

/// Resolves the scene of `text`, with cubes for all meshes.
fn resolve(text: &str) -> crate::scene::file::Resolved {
    let file = crate::scene::file::SceneFile::parse(text, "scene.toml")
        .unwrap_or_else(|error| panic!("{error}"));
    file.resolve(cubes)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Appends an object to `text`.
fn with_object(text: &str) -> String {
    std::format!("{text}\n[[object]]\nmesh = \"builtin:cube\"\n")
}
