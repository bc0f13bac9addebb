//! The frame of the eye and the first light, for methods that turn normals into it.
//!
//! Its z points toward the eye, and the first light lies in the plane of x and z. K = V·N is then
//! the z of a normal, and J = L·N of the first light needs one product less.

use crate::number::{Num, Vec3, vec3};
use crate::scene::Place;
use crate::shading::light::{LightAt, SeenLight, Uniforms, vector};
use crate::shading::{Carried, Carries};
use glam::DVec3;

/// The rows of a rotation: three unit vectors at right angles.
pub(crate) type EyeFrame = [Vec3<f32>; 3];

impl Uniforms {
    /// Turns the lights into the frame of the eye and the first light, and stores the frame, by
    /// which vertices are turned too. Lights or an eye at positions stay where they are:
    /// [`Uniforms::seen_from`] turns them as a polygon sees them.
    pub(crate) fn turned(mut self) -> Uniforms {
        let first = self.lights.first().map(|light| vector(light.place));
        let frame = frame_of(vector(self.model.eye), first);
        self.eye_frame = Some(frame);
        if !self.is_local() {
            for light in &mut self.lights {
                light.place = Place::Infinite(in_frame(frame, vector(light.place)));
            }
            self.model.eye = Place::Infinite(vec3([0.0, 0.0, 1.0]));
        }
        self
    }
}

/// Returns the varyings of a vertex with the unit normal `n`, which is turned into the eye's frame
/// if the method asks for it.
#[inline(always)]
pub(crate) fn carried<C: Carries, F: Num>(
    uniforms: &Uniforms,
    lit: &LightAt<'_, F>,
    n: Vec3<F>,
) -> C::Varying<F> {
    match C::FROM {
        Carried::Turned => {
            let frame = uniforms
                .eye_frame
                .expect("methods that turn normals turn their lights");
            C::vertex(lit, in_frame(frame, n))
        }
        _ => C::vertex(lit, n),
    }
}

/// Returns L·v of a light and a vector in the eye's frame, where the first light has no y.
#[inline(always)]
pub(crate) fn product<F: Num>(light: &SeenLight<'_, F>, v: Vec3<F>) -> F {
    let product = v.z.mul_add(light.to.z, v.x * light.to.x);
    match light.index {
        0 => product,
        _ => v.y.mul_add(light.to.y, product),
    }
}

/// Returns three unit vectors at right angles: the last is `view`, the second is also at right
/// angles to `light`. If light and eye are in one line, or there is no light, any second vector
/// will do.
fn frame_of(view: Vec3<f32>, light: Option<Vec3<f32>>) -> [Vec3<f32>; 3] {
    // In `f64`, because in `f32` a light nearly in line with the eye would lose its digits.
    let wide = |v: Vec3<f32>| DVec3::from_array(v.array().map(f64::from));
    let z = wide(view).normalize_or(DVec3::Z);
    let across = |v: DVec3| v - v.dot(z) * z;
    let toward = light.map_or(DVec3::ZERO, |light| across(wide(light)));
    let x = if toward.length() > 1e-9 {
        toward.normalize()
    } else {
        z.any_orthonormal_vector()
    };
    [x, z.cross(x), z].map(|v| vec3(v.to_array().map(|c| c as f32)))
}

/// Returns the coordinates of a vector in a frame.
#[inline(always)]
fn in_frame<F: Num>(frame: [Vec3<f32>; 3], v: Vec3<F>) -> Vec3<F> {
    let [x, y, z] = frame;
    vec3([
        v.dot(x.broadcast(v.x)),
        v.dot(y.broadcast(v.x)),
        v.dot(z.broadcast(v.x)),
    ])
}
