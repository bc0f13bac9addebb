//! The light rig for a mesh without a scene: lights, material and background that show it well.
//!
//! The lights stand to the left and the right of the camera, so they are made once the camera is
//! known. Everything is written into the scene as a scene file would state it: `--print-scene`
//! shows it, and flags override it.

use super::CliError;
use super::files;
use super::scene_flags::SceneFlags;
use fastphong::scene::file::Resolved;
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::value::{Data, SceneTable};
use fastphong::scene::{Camera, Scene};
use glam::DVec3;

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

impl SceneFlags {
    /// Loads the scene that `input` names, as [`SceneFlags::load`] does. A mesh without a scene
    /// gets the material and background of the rig.
    ///
    /// # Errors
    /// If there is no such input.
    pub fn load_to_show(&self, input: &str) -> Result<SceneFile, CliError> {
        let mut file = self.read(input)?;
        if is_mesh_alone(&file) {
            file.overlay(SceneTable::parse(STUDIO)?);
        }
        Ok(self.over(file))
    }

    /// Returns the scene that `file` describes, as [`files::resolve`] does. A mesh without a scene
    /// gets the lights of the rig, unless the mesh file or a flag sets lights, and smooth edges if
    /// they cost little.
    ///
    /// # Errors
    /// As [`files::resolve`].
    pub fn resolve_to_show(&self, file: &mut SceneFile) -> Result<Resolved, CliError> {
        let mut resolved = files::resolve(file)?;
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
        resolved.scene = lit.scene;
        Ok(resolved)
    }
}

/// True if the input is a mesh without a scene file.
fn is_mesh_alone(file: &SceneFile) -> bool {
    file.path().is_none()
}

/// Returns the lights of the rig for `camera`, as a scene file lists them.
fn lights(camera: &Camera) -> Data {
    let toward = (camera.eye - camera.target).normalize();
    let right = camera.up.cross(toward).normalize();
    let up = toward.cross(right);
    let light = |([x, y, z], colour): ([f64; 3], [f64; 3])| {
        let direction: DVec3 = x * right + y * up + z * toward;
        // Three digits keep the output of `--print-scene` readable.
        let direction = ((1e3 * direction).round() / 1e3).to_array();
        let mut light = SceneTable::default();
        light.set("direction", Data::Triple(direction), Origin::Program);
        light.set("colour", Data::Triple(colour), Origin::Program);
        light
    };
    Data::Tables(LIGHTS.map(light).to_vec())
}

/// True if four samples per pixel are drawn quickly and stay within the largest picture size.
fn is_quick(scene: &Scene) -> bool {
    let polygons: usize = scene.objects.iter().map(|o| o.mesh.polygon_count()).sum();
    let pixels = u64::from(scene.width) * u64::from(scene.height);
    let fits = scene.width.max(scene.height) <= Scene::MAX_SIDE / 2;
    fits && pixels.saturating_mul(polygons as u64) <= SMOOTH
}
