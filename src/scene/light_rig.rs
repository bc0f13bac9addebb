//! The light rig for a mesh without a scene: lights, material and background that show it well.
//!
//! The lights stand to the left and the right of the camera, so they are made once the camera is
//! known. Everything is written into the scene as a scene file would state it, and what a user sets
//! replaces it.

use super::file::SceneFile;
use super::file::diagnostics::Origin;
use super::file::value::{Data, SceneTable};
use super::{Camera, Scene};
use glam::DVec3;
use std::vec::Vec;

/// Soft clay on a dark grey background. The materials of a mesh file override this one.
const STUDIO: &str = "
ambient = [0.16, 0.17, 0.2]
image = { background = [0.045, 0.047, 0.05], encoding = 'srgb', alpha = 'opaque' }
material = { ka = [0.6, 0.53, 0.47], kd = [0.73, 0.61, 0.5], ks = 0.2, shininess = 30 }
";

/// A warm key light from the upper left front and a weak, cool fill light from the right. Each is a
/// direction (right, up, toward the eye) and a colour.
const LIGHTS: [([f64; 3], [f64; 3]); 2] = [
    ([-0.8, 0.9, 0.8], [1.1, 1.05, 0.97]),
    ([1.0, -0.15, 0.55], [0.1, 0.14, 0.2]),
];

/// The largest product of polygons and pixels that is drawn with 2 × 2 samples per pixel: 220,000
/// polygons on 640 × 480 pixels.
const SMOOTH: u64 = 1 << 36;

impl SceneFile {
    /// Takes the material and the background of the rig, and leaves the lights to
    /// [`SceneFile::take_rig`], unless they are the mesh file's.
    pub(super) fn take_studio(&mut self) {
        let studio = SceneTable::parse(STUDIO).expect("a scene in which all is right");
        if !self.has_lights_of_mesh_file() {
            self.drop_lights();
        }
        self.overlay(studio);
    }

    /// Takes the lights of the rig for this camera, unless there are any, and smooth edges if they
    /// cost little and nothing else is stated.
    pub(super) fn take_rig(&mut self, camera: &Camera, size: [u32; 2], polygons: usize) {
        let mut over = SceneTable::default();
        if self.table().get("light").is_none() {
            over.set("light", lights(camera), Origin::Program);
        }
        let image = self.table().table("image");
        let is_open = image.is_none_or(|image| image.get("samples").is_none());
        if is_open && is_quick(size, polygons) {
            let image = over.table_mut("image");
            image.set("samples", Data::Whole(2), Origin::Program);
        }
        self.overlay(over);
    }
}

/// Returns the lights of the rig for `camera`, as a scene file lists them.
fn lights(camera: &Camera) -> Data {
    let toward = (camera.eye - camera.target).normalize();
    let right = camera.up.cross(toward).normalize();
    let up = toward.cross(right);
    let light = |([x, y, z], colour): ([f64; 3], [f64; 3])| {
        let direction: DVec3 = x * right + y * up + z * toward;
        // Three digits keep a printed scene readable.
        let direction = ((1e3 * direction).round() / 1e3).to_array();
        let mut light = SceneTable::default();
        light.set("direction", Data::Triple(direction), Origin::Program);
        light.set("colour", Data::Triple(colour), Origin::Program);
        light
    };
    Data::Tables(Vec::from(LIGHTS.map(light)))
}

/// True if four samples per pixel are drawn quickly and stay within the largest picture size.
fn is_quick([width, height]: [u32; 2], polygons: usize) -> bool {
    let pixels = u64::from(width) * u64::from(height);
    let fits = width.max(height) <= Scene::MAX_SIDE / 2;
    fits && pixels.saturating_mul(polygons as u64) <= SMOOTH
}
