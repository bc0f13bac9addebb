//! Lights, and the light on a material: the data of the illumination model (L21 2.1).
//!
//! [`crate::shading::light`] computes with them, and sets the clamps.

use crate::mesh::Material;
use crate::picture::Rgb;
use alloc::vec::Vec;
use glam::DVec3;

/// Where a light or the viewer is, as seen from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place<V> {
    /// At infinity, as the lecture assumes (L21 1): the unit vector toward it, which is the same
    /// everywhere.
    Infinite(V),
    /// At a position. The vector toward it differs from point to point (CS171 2).
    Local(V),
}

impl<V: Copy> Place<V> {
    /// Converts the vector with `of`.
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

/// How a light at a position weakens with its distance r.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Falloff {
    /// It does not weaken.
    #[default]
    None,
    /// 1 / (1 + k r²), with k of 0 or more. Full strength at the light itself (CS171 2,
    /// Attenuation).
    Attenuation(f32),
    /// 1 / r², as light behaves in nature (L5, Light Falloff). Unbounded near the light.
    InverseSquare,
    /// 1 / r: the compromise of L5.
    Inverse,
}

/// Which cosine is raised to the exponent for the highlight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpecularModel {
    /// R·V: the reflected ray and the ray to the eye (L21 2.1; Phong 1975).
    #[default]
    Phong,
    /// N·H: the normal and the vector halfway between the rays to light and eye (CS171 2, L5; Blinn
    /// 1977).
    Blinn,
}

impl SpecularModel {
    /// The factor from an exponent for R·V to the one for N·H. The angle between N and H is half of
    /// the angle between R and V (in one plane), and `cos^n φ ≈ cos^4n (φ/2)`, because both fall by
    /// n φ²/2 (Fisher & Woo 1994).
    pub const EXPONENT_RATIO: f32 = 4.0;

    /// The least |L + V|² that has a highlight. Below it, light and eye are opposite, and H has no
    /// direction. In `f32`, L·V is rounded four times by up to 2⁻²⁵, so that a quarter of a |L +
    /// V|² = 2 + 2 L·V of this size, 2⁻²⁰, is rounding.
    pub const LEAST_SUM: f32 = 1.0 / (1 << 20) as f32;

    /// Converts an exponent meant for the model `of` to the one with the same highlight in this
    /// model.
    pub fn exponent(self, exponent: f32, of: SpecularModel) -> f32 {
        match (of, self) {
            (SpecularModel::Phong, SpecularModel::Blinn) => exponent * Self::EXPONENT_RATIO,
            (SpecularModel::Blinn, SpecularModel::Phong) => exponent / Self::EXPONENT_RATIO,
            _ => exponent,
        }
    }
}

/// What happens to a highlight where the light is behind the surface, L·N ≤ 0. No lecture settles
/// this.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SpecularGate {
    /// No highlight there. It ends in a hard line where L·N = 0.
    #[default]
    Gated,
    /// The highlight stays, as CS171 and L5 print it. Light from behind shines through.
    Ungated,
    /// The highlight is multiplied by L·N, clamped at 0: no light from behind, and no hard line.
    Weighted,
}

/// A light source.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Light {
    /// The unit vector from the model toward the light, or the light's position, in world space.
    pub place: Place<DVec3>,
    /// The intensity `I_p` of each channel, 0 or more. With a falloff, it is the intensity where
    /// the falloff is 1.
    pub colour: Rgb,
    /// The falloff. A light at infinity has none.
    pub falloff: Falloff,
}

impl Light {
    /// Makes a light at infinity. `direction` is the unit vector toward it (L21 1).
    pub fn directional(direction: DVec3, colour: Rgb) -> Self {
        Light {
            place: Place::Infinite(direction),
            colour,
            falloff: Falloff::None,
        }
    }

    /// Makes a light at `position`, without falloff.
    pub fn positional(position: DVec3, colour: Rgb) -> Self {
        Light {
            place: Place::Local(position),
            colour,
            falloff: Falloff::None,
        }
    }

    /// Returns the light with this falloff, which only a light at a position has.
    #[must_use]
    pub fn with_falloff(self, falloff: Falloff) -> Self {
        Light { falloff, ..self }
    }
}

/// One light on one material: where it is, and the two products that the illumination model needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightTerm {
    /// The unit vector `L` toward the light, or its position in the space of
    /// [`crate::frame::Frame::position`].
    pub place: Place<[f32; 3]>,
    /// The product `I_p k_d` of each channel.
    pub diffuse: Rgb,
    /// The product `I_p k_s` of each channel.
    pub specular: Rgb,
    /// How the light weakens with its distance.
    pub falloff: Falloff,
}

/// All light on one material: everything that a method needs to know about lights and materials.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Lighting {
    /// The product `I_a k_a` of each channel.
    pub ambient: Rgb,
    /// One entry per light, in the order of the scene.
    pub lights: Vec<LightTerm>,
    /// The unit vector `V` toward the eye, the same for the whole scene (L21 1: the eye is at
    /// infinity), or the eye's position.
    pub view: Place<[f32; 3]>,
    /// The exponent `n`.
    pub shininess: f32,
    /// Which cosine is raised to the exponent.
    pub specular: SpecularModel,
    /// What happens to highlights from behind.
    pub gate: SpecularGate,
    /// True if the colours of vertices ([`Frame::colour`](crate::frame::Frame::colour)) multiply
    /// `k_a` and `k_d`. Colours are interpolated as normals are. Methods that light whole polygons
    /// use the mean of the corners' colours.
    pub vertex_colours: bool,
}

impl Lighting {
    /// Returns the light on `material` from `lights` and from the ambient intensity `ambient`, seen
    /// from infinity along `view`, with Phong's gated highlights. Positions are converted to `f32`
    /// and not moved.
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

    /// True if the vector toward a light or toward the eye differs from point to point.
    pub fn is_local(&self) -> bool {
        self.view.is_local() || self.lights.iter().any(|light| light.place.is_local())
    }

    /// True if a light weakens with its distance.
    pub fn is_attenuated(&self) -> bool {
        self.lights
            .iter()
            .any(|light| light.place.is_local() && light.falloff != Falloff::None)
    }
}
