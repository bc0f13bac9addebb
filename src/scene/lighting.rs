//! Lights, and the light on a material: the data of the illumination model (L21 2.1).
//!
//! What is computed from them, and with which clamps, stands once in [`crate::shading::lighting`].

use crate::mesh::Material;
use crate::picture::Rgb;
use alloc::vec::Vec;
use glam::DVec3;

/// The place of a light or of the viewer, as a surface sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place<V> {
    /// At infinity, as the lecture assumes (L21 1): the unit vector toward it, the same everywhere.
    Infinite(V),
    /// At a position: the vector toward it differs from point to point (CS171 2).
    Local(V),
}

impl<V: Copy> Place<V> {
    /// Returns the place with its vector in another form.
    pub fn map<W>(self, of: impl FnOnce(V) -> W) -> Place<W> {
        match self {
            Place::Infinite(v) => Place::Infinite(of(v)),
            Place::Local(v) => Place::Local(of(v)),
        }
    }

    /// True if it is at a position.
    pub fn is_local(self) -> bool {
        matches!(self, Place::Local(_))
    }
}

/// The falloff of a light at a position with the distance r.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Falloff {
    /// Not at all.
    #[default]
    None,
    /// 1 / (1 + k r²), k 0 or more: full strength at the light itself (CS171 2, Attenuation).
    Attenuation(f32),
    /// 1 / r²: what light does (L5, Light Falloff). Unbounded near the light.
    InverseSquare,
    /// 1 / r: the compromise of L5.
    Inverse,
}

/// The cosine that is raised to the exponent for the highlight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpecularModel {
    /// R·V: the reflected ray and the ray to the eye (L21 2.1; Phong 1975).
    #[default]
    Phong,
    /// N·H: the normal and the vector halfway between the rays to light and eye (CS171 2, L5; Blinn 1977).
    Blinn,
}

impl SpecularModel {
    /// By how much an exponent for R·V must be multiplied for N·H: the angle between N and H is half of that between R
    /// and V (in one plane), and `cos^n φ ≈ cos^4n (φ/2)`, as both fall by n φ²/2 (Fisher & Woo 1994).
    pub const EXPONENT_RATIO: f32 = 4.0;

    /// The least |L + V|²: where it is less, light and eye are opposite and H has no direction: no highlight. L·V is rounded four times
    /// by up to 2⁻²⁵ in `f32`, so that |L + V|² = 2 + 2 L·V of this size, 2⁻²⁰, is a quarter rounding.
    pub const LEAST_SUM: f32 = 1.0 / (1 << 20) as f32;

    /// Returns the exponent for this model that gives the highlight which `exponent` gives for the model `of`.
    pub fn exponent(self, exponent: f32, of: SpecularModel) -> f32 {
        match (of, self) {
            (SpecularModel::Phong, SpecularModel::Blinn) => exponent * Self::EXPONENT_RATIO,
            (SpecularModel::Blinn, SpecularModel::Phong) => exponent / Self::EXPONENT_RATIO,
            _ => exponent,
        }
    }
}

/// The treatment of a highlight where the light is behind the surface, L·N ≤ 0, which no lecture settles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SpecularGate {
    /// None there: the highlight ends in a hard line where L·N = 0.
    #[default]
    Gated,
    /// It stays, as CS171 and L5 print it: light from behind shines through.
    Ungated,
    /// It is multiplied by L·N, clamped at 0: no light from behind, and no line.
    Weighted,
}

/// A light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Unit vector from the model toward the light, or its position, in world space.
    pub place: Place<DVec3>,
    /// Intensity `I_p` of each channel, 0 or more; where there is a falloff, that of a light of strength 1.
    pub colour: Rgb,
    /// The falloff; a light at infinity has none.
    pub falloff: Falloff,
}

impl Light {
    /// Makes a light at infinity: a unit vector toward it (L21 1).
    pub fn directional(direction: DVec3, colour: Rgb) -> Self {
        Light {
            place: Place::Infinite(direction),
            colour,
            falloff: Falloff::None,
        }
    }

    /// Makes a light at a position that does not grow weaker.
    pub fn positional(position: DVec3, colour: Rgb) -> Self {
        Light {
            place: Place::Local(position),
            colour,
            falloff: Falloff::None,
        }
    }
}

/// One light on one material: where it is, and the two products that the illumination model needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightTerm {
    /// Unit vector `L` toward the light, or its position as [`crate::frame::Frame::position`] gives positions.
    pub place: Place<[f32; 3]>,
    /// `I_p k_d` of each channel.
    pub diffuse: Rgb,
    /// `I_p k_s` of each channel.
    pub specular: Rgb,
    /// The falloff with the distance.
    pub falloff: Falloff,
}

/// All light that falls on one material: what a method needs to know of lights and materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Lighting {
    /// `I_a k_a` of each channel.
    pub ambient: Rgb,
    /// One entry per light, in the order of the scene.
    pub lights: Vec<LightTerm>,
    /// Unit vector `V` toward the eye, one for the whole scene (L21 1: the eye is at infinity), or where the eye is.
    pub view: Place<[f32; 3]>,
    /// The exponent `n`.
    pub shininess: f32,
    /// The cosine that is raised to it.
    pub specular: SpecularModel,
    /// The treatment of highlights from behind.
    pub gate: SpecularGate,
    /// True if `k_a` and `k_d` are multiplied by the colours of vertices ([`Frame::colour`](crate::frame::Frame::colour)), which are
    /// interpolated as normals are. Methods that light polygons take the mean of the corners' colours.
    pub vertex_colours: bool,
}

impl Lighting {
    /// Returns the light on `material` from `lights` and from the ambient intensity `ambient`, seen from far away along `view`;
    /// Phong's highlights, gated. Positions stay as they are.
    pub fn new(material: &Material, ambient: Rgb, lights: &[Light], view: DVec3) -> Self {
        let times = |a: Rgb, b: Rgb| [a[0] * b[0], a[1] * b[1], a[2] * b[2]];
        let three = |v: DVec3| v.as_vec3().to_array();
        Lighting {
            ambient: times(ambient, material.ambient),
            lights: lights
                .iter()
                .map(|light| LightTerm {
                    place: light.place.map(three),
                    diffuse: times(light.colour, material.diffuse),
                    specular: times(light.colour, material.specular),
                    falloff: light.falloff,
                })
                .collect(),
            view: Place::Infinite(three(view)),
            shininess: material.shininess,
            specular: SpecularModel::Phong,
            gate: SpecularGate::Gated,
            vertex_colours: false,
        }
    }

    /// True if the vectors toward a light or toward the eye differ from point to point.
    pub fn is_local(&self) -> bool {
        self.view.is_local() || self.lights.iter().any(|light| light.place.is_local())
    }

    /// True if a light grows weaker with its distance.
    pub fn is_attenuated(&self) -> bool {
        self.lights
            .iter()
            .any(|light| light.place.is_local() && light.falloff != Falloff::None)
    }
}
