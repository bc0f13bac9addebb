//! Lights and materials: the data of the illumination model (L21 2.1).
//!
//! What is computed from them, and with which clamps, stands once in [`crate::shader::illumination`].

use alloc::vec::Vec;
use glam::DVec3;

/// A colour or a per-channel coefficient: red, green, blue, linear, usually in 0..=1.
pub type Rgb = [f32; 3];

/// A directional light: a point light at infinity, as the lecture assumes (L21 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Unit vector from the model toward the light, in world space.
    pub direction: DVec3,
    /// Intensity `I_p` of each channel, 0 or more.
    pub colour: Rgb,
}

/// How a surface reflects light: the coefficients of L21 2.1, each per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Ambient reflection `k_a`.
    pub ambient: Rgb,
    /// Diffuse reflection `k_d`.
    pub diffuse: Rgb,
    /// Specular reflection `k_s`.
    pub specular: Rgb,
    /// The exponent `n`, 0 or more. Large exponents give small, sharp highlights.
    pub shininess: f32,
}

impl Default for Material {
    /// A warm, slightly glossy surface: the one that a mesh without a material gets.
    fn default() -> Self {
        Material {
            ambient: [0.08, 0.07, 0.06],
            diffuse: [0.60, 0.45, 0.30],
            specular: [0.40, 0.40, 0.40],
            shininess: 32.0,
        }
    }
}

/// One light on one material: its direction and the two products that the illumination model needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightTerm {
    /// Unit vector `L` toward the light.
    pub direction: [f32; 3],
    /// `I_p k_d` of each channel.
    pub diffuse: Rgb,
    /// `I_p k_s` of each channel.
    pub specular: Rgb,
}

/// All light that falls on one material: what a method needs to know of lights and materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Lighting {
    /// `I_a k_a` of each channel.
    pub ambient: Rgb,
    /// One entry a light, in the order of the scene.
    pub lights: Vec<LightTerm>,
    /// Unit vector `V` toward the eye, one for the whole scene (L21 1: the eye is at infinity).
    pub view: [f32; 3],
    /// The exponent `n`.
    pub shininess: f32,
}

impl Lighting {
    /// What falls on `material` from `lights` and from the ambient intensity `ambient`, seen along `view`.
    pub fn new(material: &Material, ambient: Rgb, lights: &[Light], view: DVec3) -> Self {
        let times = |a: Rgb, b: Rgb| [a[0] * b[0], a[1] * b[1], a[2] * b[2]];
        Lighting {
            ambient: times(ambient, material.ambient),
            lights: lights
                .iter()
                .map(|light| LightTerm {
                    direction: light.direction.as_vec3().to_array(),
                    diffuse: times(light.colour, material.diffuse),
                    specular: times(light.colour, material.specular),
                })
                .collect(),
            view: view.as_vec3().to_array(),
            shininess: material.shininess,
        }
    }
}
