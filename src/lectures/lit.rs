//! What the figures of the illumination model are drawn on: one surface before a camera that looks along -z.

use super::{FigureError, Shown, stage::stored};
use crate::mesh::{Material, PolygonMesh};
use crate::picture::LinearPicture;
use crate::scene::{Camera, Light, Projection, Scene};
use crate::shading::Variant;
use alloc::format;
use alloc::vec;
use glam::DVec3;

/// A material that reflects all channels alike.
pub(super) fn grey(ambient: f32, diffuse: f32, specular: f32, shininess: f32) -> Material {
    Material {
        ambient: [ambient; 3],
        diffuse: [diffuse; 3],
        specular: [specular; 3],
        shininess,
    }
}

/// `mesh` around the origin, seen from +z, `half_height` of space above the middle of the picture; one white light along
/// `light`.
pub(super) fn scene(
    mesh: PolygonMesh,
    material: Material,
    light: DVec3,
    half_height: f64,
    [width, height]: [u32; 2],
) -> Scene {
    let camera = Camera {
        eye: DVec3::new(0.0, 0.0, 5.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        projection: Projection::Orthographic { half_height },
        near: 1.0,
        far: 9.0,
    };
    let mut scene = Scene::of_mesh(mesh);
    (scene.width, scene.height, scene.camera) = (width, height, camera);
    scene.lights = vec![Light::directional(light.normalize(), [1.0; 3])];
    scene
        .objects
        .iter_mut()
        .for_each(|object| object.material = Some(material));
    scene
}

/// `scene` by `method`.
pub(super) fn drawn(scene: &Scene, method: &str) -> Result<LinearPicture, FigureError> {
    Ok(Variant::parse(method)?.render_linear(&scene.frame()?))
}

/// A picture whose caption says the same as what it shows, with `what` before it for who cannot see it.
pub(super) fn shown(what: &str, caption: &str, picture: &LinearPicture) -> Shown {
    Shown::new(caption, format!("{what}, {caption}."), stored(picture))
}

/// The share of the drawn pixels for which `is` holds, 0..=1.
pub(super) fn share(picture: &LinearPicture, is: impl Fn([f32; 4]) -> bool) -> f64 {
    let covered = || picture.texels().iter().filter(|texel| texel[3] > 0.0);
    covered().filter(|texel| is(**texel)).count() as f64 / covered().count().max(1) as f64
}

/// The largest difference of two pictures in grey levels, over the pixels that both cover.
pub(super) fn levels(a: &LinearPicture, b: &LinearPicture) -> f64 {
    let both = a
        .texels()
        .iter()
        .zip(b.texels())
        .filter(|(a, b)| a[3] > 0.0 && b[3] > 0.0);
    both.flat_map(|(a, b)| (0..3).map(|c| 255.0 * f64::from((a[c] - b[c]).abs())))
        .fold(0.0, f64::max)
}
