//! The first picture of a mesh that comes without a scene: light, material and background that flatter it.
//!
//! Lights stand to the left and right of the camera, wherever that is, so that they are made once it is known. All of it
//! is written into the scene, as a file would say it: `--print-scene` shows it, and flags stand over it.

use super::CliError;
use super::files;
use super::scene_flags::SceneFlags;
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::resolve::Resolved;
use fastphong::scene::file::value::{Data, SceneTable};
use fastphong::scene::{Camera, Scene};
use glam::DVec3;

/// Soft clay before a quiet grey. Materials that come with the mesh stand over this one.
const STUDIO: &str = "
ambient = [0.16, 0.17, 0.2]
image = { background = [0.045, 0.047, 0.05], encoding = 'srgb', alpha = 'opaque' }
material = { ka = [0.6, 0.53, 0.47], kd = [0.73, 0.61, 0.5], ks = 0.2, shininess = 30 }
";

/// A warm key light from the upper left front and a weak, cool fill light from the right: how far to the right, upward and
/// toward the eye, and the colour.
const LIGHTS: [([f64; 3], [f64; 3]); 2] = [
    ([-0.8, 0.9, 0.8], [1.1, 1.05, 0.97]),
    ([1.0, -0.15, 0.55], [0.1, 0.14, 0.2]),
];

/// The most polygons times pixels that are drawn with 2 × 2 samples per pixel: 220,000 polygons on 640 × 480 pixels.
const SMOOTH: u64 = 1 << 36;

impl SceneFlags {
    /// Loads the scene that `input` names as [`SceneFlags::load`] does; a mesh alone gets the light rig.
    ///
    /// # Errors
    /// When there is no such input.
    pub fn load_to_show(&self, input: &str) -> Result<SceneFile, CliError> {
        let mut file = self.read(input)?;
        if is_mesh_alone(&file) {
            file.overlay(SceneTable::parse(STUDIO)?);
        }
        Ok(self.over(file))
    }

    /// Returns the scene that `file` describes, as [`files::resolve`] does. If it is a mesh alone, adds the lights of the
    /// rig, unless the mesh file has some or flags gave others, and smooth edges where they cost little.
    ///
    /// # Errors
    /// As [`files::resolve`].
    pub fn resolve_to_show(&self, file: &mut SceneFile) -> Result<Resolved, CliError> {
        let resolved = files::resolve(file)?;
        file.overlay(resolved.chosen.clone());
        if !is_mesh_alone(file) {
            return Ok(resolved);
        }
        let scene = &resolved.scene;
        let mut over = SceneTable::default();
        if !self.gives(None, "light") && !file.has_lights_of_mesh_file() {
            over.set("light", lights(&scene.camera), Origin::Program);
        }
        if !self.gives(Some("image"), "samples") && is_quick(scene) {
            let image = over.table_mut("image");
            image.set("samples", Data::Whole(2), Origin::Program);
        }
        file.overlay(over);
        let mesh = &scene.objects[0].mesh;
        let lit = file.resolve(|_, _| Ok((mesh.clone(), Vec::new())))?;
        Ok(Resolved {
            scene: lit.scene,
            ..resolved
        })
    }
}

/// True if the program made the scene around a mesh: no file says what it looks like.
fn is_mesh_alone(file: &SceneFile) -> bool {
    file.path().is_none()
}

/// Returns the lights of the rig around `camera`, as a scene file lists them.
fn lights(camera: &Camera) -> Data {
    let toward = (camera.eye - camera.target).normalize();
    let right = camera.up.cross(toward).normalize();
    let up = toward.cross(right);
    let light = |([x, y, z], colour): ([f64; 3], [f64; 3])| {
        let direction: DVec3 = x * right + y * up + z * toward;
        // Three digits, for who reads the printed scene.
        let direction = ((1e3 * direction).round() / 1e3).to_array();
        let mut light = SceneTable::default();
        light.set("direction", Data::Triple(direction), Origin::Program);
        light.set("colour", Data::Triple(colour), Origin::Program);
        light
    };
    Data::Tables(LIGHTS.map(light).to_vec())
}

/// True if four samples per pixel are drawn in no time, and fit into the largest picture.
fn is_quick(scene: &Scene) -> bool {
    let polygons: usize = scene.objects.iter().map(|o| o.mesh.polygon_count()).sum();
    let pixels = u64::from(scene.width) * u64::from(scene.height);
    let fits = scene.width.max(scene.height) <= Scene::MAX_SIDE / 2;
    fits && pixels.saturating_mul(polygons as u64) <= SMOOTH
}
