//! Scenes whose fields hold any number at all. The fields are public, so a caller may set them
//! without any check.

use super::renderers::distinct;
use super::scene;
use super::world::World;
use fastphong::raster;
use fastphong::reference::{self, Model};
use fastphong::scene::{Falloff, Place, Projection, Scene};
use fastphong::shading::METHODS;
use proptest::prelude::*;

/// Numbers that break arithmetic.
const WILD: [f64; 16] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    f32::MAX as f64,
    -(f32::MAX as f64),
    1e-45,
    1e-38,
    1e15,
    1e-15,
    16_384.5,
];

/// A replacement of one number of a scene: its index, modulo their count, and the new value.
pub type Change = (u16, f64);

/// Returns worlds and changes of some of their numbers.
#[allow(dead_code)] // a fuzzer makes its own changes
pub fn changed_worlds() -> BoxedStrategy<(World, Vec<Change>)> {
    (scene::worlds(), changes()).boxed()
}

/// Returns changes of some numbers of a scene.
pub fn changes() -> BoxedStrategy<Vec<Change>> {
    let change = (any::<u16>(), prop::sample::select(&WILD[..]));
    prop::collection::vec(change, 1..4).boxed()
}

/// Calls `visit` with every number of a scene except for the numbers of its meshes.
fn visit(scene: &mut Scene, visit: &mut dyn FnMut(&mut f64)) {
    let camera = &mut scene.camera;
    for vector in [&mut camera.eye, &mut camera.target, &mut camera.up] {
        vector.as_mut().iter_mut().for_each(&mut *visit);
    }
    match &mut camera.projection {
        Projection::Orthographic { half_height: size } | Projection::Perspective { fovy: size } => {
            visit(size)
        }
    }
    visit(&mut camera.near);
    visit(&mut camera.far);
    let narrow = |number: &mut f32, visit: &mut dyn FnMut(&mut f64)| {
        let mut wide = f64::from(*number);
        visit(&mut wide);
        *number = wide as f32;
    };
    for number in scene.background.iter_mut().chain(&mut scene.ambient) {
        narrow(number, visit);
    }
    for light in &mut scene.lights {
        match &mut light.place {
            Place::Infinite(v) | Place::Local(v) => v.as_mut().iter_mut().for_each(&mut *visit),
        }
        light.colour.iter_mut().for_each(|c| narrow(c, visit));
        if let Falloff::Attenuation(k) = &mut light.falloff {
            narrow(k, visit);
        }
    }
    for object in &mut scene.objects {
        let transform = &mut object.transform;
        let matrix = &mut transform.matrix3;
        for column in [&mut matrix.x_axis, &mut matrix.y_axis, &mut matrix.z_axis] {
            column.as_mut().iter_mut().for_each(&mut *visit);
        }
        transform
            .translation
            .as_mut()
            .iter_mut()
            .for_each(&mut *visit);
        if let Some(material) = &mut object.material {
            let channels = material
                .ambient
                .iter_mut()
                .chain(&mut material.diffuse)
                .chain(&mut material.specular);
            channels.for_each(|c| narrow(c, visit));
            narrow(&mut material.shininess, visit);
        }
    }
}

/// Returns a scene with some of its numbers replaced.
pub fn changed(mut scene: Scene, changes: &[Change]) -> Scene {
    let mut count = 0;
    visit(&mut scene, &mut |_| count += 1);
    for &(which, new) in changes {
        let mut number = 0;
        visit(&mut scene, &mut |value| {
            if number == usize::from(which) % count {
                *value = new;
            }
            number += 1;
        });
    }
    scene
}

/// Draws a scene with some of its numbers replaced, unless it is refused. Nothing may panic.
/// Returns true if it was drawn.
pub fn draw(scene: Scene, changes: &[Change]) -> bool {
    let Ok(frame) = changed(scene, changes).frame() else {
        return false;
    };
    for entry in METHODS {
        let variant = entry.variant();
        for renderer in distinct(&variant, &frame) {
            variant
                .render_with(&frame, renderer)
                .expect("a method for the frame");
            variant
                .render_linear_with(&frame, renderer)
                .expect("a method for the frame");
        }
        variant.bound(&frame);
    }
    raster::normals(&frame);
    raster::depth(&frame);
    reference::render(&frame, Model::Phong);
    true
}
