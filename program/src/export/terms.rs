//! The light at a point, term by term, with all vectors on the way (L21 2.1), in `f64`.

use alloc::vec::Vec;
use fastphong::mesh::Material;
use fastphong::picture::Rgb;
use fastphong::scene::{Falloff, Light, Place, Scene, SpecularGate, SpecularModel};
use glam::DVec3;

/// The light of one source at a point.
pub struct LightAt {
    /// The unit vector toward the light.
    pub l: DVec3,
    /// R, the reflected ray; or H, halfway between the rays to light and eye.
    pub r: DVec3,
    pub l_n: f64,
    /// R·V or N·H, not clamped.
    pub cosine: f64,
    pub diffuse: DVec3,
    pub specular: DVec3,
}

/// The light of all sources at a point.
pub struct Terms {
    /// The unit vector toward the eye.
    pub v: DVec3,
    pub ambient: DVec3,
    pub lights: Vec<LightAt>,
    /// The sum of all terms, not clamped.
    pub sum: DVec3,
}

/// Converts a colour or coefficient to double precision.
fn wide(c: Rgb) -> DVec3 {
    DVec3::from_array(c.map(f64::from))
}

/// Returns the unit vector along `vector`, or zero if it has no direction.
pub fn unit(vector: DVec3) -> DVec3 {
    // Scaling keeps squares in range.
    let size = vector.abs().max_element();
    if size > 0.0 {
        (vector / size).normalize_or_zero()
    } else {
        DVec3::ZERO
    }
}

/// Returns the exponent of a material for the scene's own model of highlights.
pub fn exponent(scene: &Scene, material: &Material) -> f32 {
    scene
        .specular
        .exponent(material.shininess, scene.shininess_for)
}

impl Terms {
    /// Computes the light at `p` with the unit normal `n` and the vertex colour `c`:
    /// ```text
    /// I = I_a k_a c + Σ (I_p k_d c (L·N) + I_p k_s (R·V)ⁿ)      (L21 2.1)
    /// ```
    pub fn new(scene: &Scene, material: &Material, p: DVec3, n: DVec3, c: DVec3) -> Terms {
        let v = if scene.local_viewer {
            unit(scene.camera.eye - p)
        } else {
            scene.camera.view()
        };
        let of_light = |light: &Light| light_at(scene, material, light, [p, n, c, v]);
        let lights: Vec<LightAt> = scene.lights.iter().map(of_light).collect();
        let ambient = wide(scene.ambient) * wide(material.ambient) * c;
        let sum = lights
            .iter()
            .fold(ambient, |sum, light| sum + light.diffuse + light.specular);
        Terms {
            v,
            ambient,
            lights,
            sum,
        }
    }
}

fn light_at(
    scene: &Scene,
    material: &Material,
    light: &Light,
    [p, n, c, v]: [DVec3; 4],
) -> LightAt {
    let (l, strength) = match light.place {
        Place::Infinite(l) => (unit(l), 1.0),
        Place::Local(position) => {
            let distance = (position - p).length().max(1e-15);
            (unit(position - p), strength(light.falloff, distance))
        }
    };
    let l_n = l.dot(n);
    let (r, cosine) = match scene.specular {
        SpecularModel::Phong => {
            let r = 2.0 * l_n * n - l;
            (r, r.dot(v))
        }
        SpecularModel::Blinn => {
            let sum = l + v;
            let least = f64::from(SpecularModel::LEAST_SUM);
            let h = if sum.length_squared() > least {
                unit(sum)
            } else {
                DVec3::ZERO
            };
            (h, h.dot(n))
        }
    };
    let power = libm::pow(cosine.max(0.0), exponent(scene, material).into());
    let gate = match scene.gate {
        SpecularGate::Gated => f64::from(u8::from(l_n > 0.0)),
        SpecularGate::Ungated => 1.0,
        SpecularGate::Weighted => l_n.max(0.0),
    };
    let colour = wide(light.colour) * strength;
    LightAt {
        l,
        r,
        l_n,
        cosine,
        diffuse: colour * wide(material.diffuse) * c * l_n.max(0.0),
        specular: colour * wide(material.specular) * gate * power,
    }
}

/// Returns the strength of a light at the distance `r`.
fn strength(falloff: Falloff, r: f64) -> f64 {
    match falloff {
        Falloff::None => 1.0,
        Falloff::Attenuation(k) => 1.0 / (1.0 + f64::from(k) * r * r),
        Falloff::InverseSquare => 1.0 / (r * r),
        Falloff::Inverse => 1.0 / r,
    }
}
