//! The illumination model (L21 2.1) with a switch for each mistake, in `f64`.
//!
//! It shares no arithmetic with the methods, nor with the reference. A test compares it with the
//! reference when no switch is set.

use super::recipe::{
    AmbientUse, Axes, Cap, Cosine, DiffuseUse, Exponent, Facing, FalloffUse, Halfway, Highlight,
    Length, LightColour, LightPlace, LightUse, Reflected, Shading, Sign, Space, SpecularUse, Sum,
    Viewer,
};
use alloc::vec::Vec;
use fastphong::mesh::Material;
use fastphong::picture::Rgb;
use fastphong::scene::{Camera, Falloff, Place, Scene, SpecularGate, SpecularModel};
use glam::{DMat3, DVec3};

/// A light of a recipe. Positions are relative to the frame's origin.
#[derive(Clone, Copy)]
struct Source {
    place: Place<DVec3>,
    /// The length of a direction.
    length: f64,
    colour: DVec3,
    falloff: Strength,
}

/// The strength of a light at the distance r.
#[derive(Clone, Copy)]
enum Strength {
    Constant,
    /// 1/(1 + k r²).
    Quadratic(f64),
    /// 1/(1 + k r).
    Linear(f64),
    /// 1 + k r².
    Growing(f64),
    InverseSquare,
    Inverse,
}

/// The lights, the viewer and the switches of a recipe.
pub struct Illumination {
    switches: Shading,
    sources: Vec<Source>,
    ambient: DVec3,
    /// Right, up and toward the viewer.
    axes: DMat3,
    /// The viewer's position, or the direction to it.
    viewer: Place<DVec3>,
    model: SpecularModel,
    /// The factor of the materials' exponents.
    exponent: f64,
    gate: SpecularGate,
    /// The divisor of the sum of all lights.
    shares: f64,
}

/// Converts a colour or coefficient to double precision.
fn wide(c: Rgb) -> DVec3 {
    DVec3::from_array(c.map(f64::from))
}

/// The terms of a colour before clamping: ambient, diffuse, specular.
pub type Terms = [DVec3; 3];

impl Illumination {
    /// Reads the lights of `scene` with the mistakes of `switches`. `lengths` are the lengths of
    /// light directions in the file.
    pub fn new(scene: &Scene, lengths: &[f64], origin: DVec3, switches: Shading) -> Illumination {
        let camera = &scene.camera;
        let count = scene.lights.len();
        let is_local = scene.local_viewer != (switches.viewer == Viewer::Other);
        let viewer = match switches.viewer {
            Viewer::EyeAsDirection => Place::Infinite(camera.eye.normalize_or_zero()),
            Viewer::AlongZ => Place::Infinite(DVec3::Z),
            Viewer::AtOrigin => Place::Local(-origin),
            _ if is_local => Place::Local(camera.eye - origin),
            _ => Place::Infinite(camera.view()),
        };
        let (model, exponent) = highlight_model(scene, &switches);
        Illumination {
            ambient: match switches.ambient {
                AmbientUse::Missing => DVec3::ZERO,
                AmbientUse::PerLight => wide(scene.ambient) * count as f64,
                AmbientUse::WithoutLight => DVec3::ONE,
                _ => wide(scene.ambient),
            },
            shares: match switches.lights {
                LightUse::Mean => count.max(1) as f64,
                _ => 1.0,
            },
            gate: switches.gate.unwrap_or(scene.gate),
            exponent,
            sources: sources(scene, lengths, origin, &switches),
            axes: axes(camera),
            switches,
            viewer,
            model,
        }
    }

    /// Returns the same lights with another factor of all exponents.
    pub fn with_exponents(mut self, factor: f64) -> Illumination {
        self.exponent *= factor;
        self
    }

    /// Returns the terms of the colour of a surface with the normal `n` at `p`:
    /// ```text
    /// I = I_a k_a + Σ (I_p k_d (L·N) + I_p k_s (R·V)ⁿ)      (L21 2.1)
    /// ```
    /// `at` is the point where L and V are computed: `p`, unless L and V are constant.
    pub fn terms(&self, material: &Material, n: DVec3, p: DVec3, at: DVec3) -> Terms {
        let switches = &self.switches;
        let (kd, ks) = (wide(material.diffuse), wide(material.specular));
        let v = self.toward_viewer(at);
        let raw = n;
        let n = self.normal(raw, p);
        let shiny = match switches.highlight_normal {
            Length::Unit => n,
            Length::Raw => raw,
        };
        let ambient = match switches.ambient {
            AmbientUse::WithoutMaterial => self.ambient,
            AmbientUse::TimesDiffuse => self.ambient * wide(material.ambient) * kd,
            AmbientUse::DiffuseColour => self.ambient * kd,
            AmbientUse::WithFalloff => {
                let strengths = self
                    .sources
                    .iter()
                    .map(|source| self.toward_light(source, at).1);
                self.ambient * wide(material.ambient) * strengths.sum::<f64>()
            }
            _ => self.ambient * wide(material.ambient),
        };
        let specular = match switches.specular {
            SpecularUse::Stated => ks,
            SpecularUse::Missing => DVec3::ZERO,
            SpecularUse::TimesDiffuse => ks * kd,
            SpecularUse::DiffuseColour => kd,
            SpecularUse::WithoutMaterial | SpecularUse::InsidePower => DVec3::ONE,
        };
        let diffuse = match switches.diffuse {
            DiffuseUse::Stated => kd,
            DiffuseUse::Missing => DVec3::ZERO,
        };
        let mut terms = [ambient, DVec3::ZERO, DVec3::ZERO];
        for source in &self.sources {
            let (l, strength) = self.toward_light(source, at);
            let l_n = l.dot(n);
            let light = source.colour * strength;
            let is_near = switches.falloff == FalloffUse::DiffuseOnly;
            let strength = if is_near { 1.0 } else { strength };
            let of_highlight = match switches.light_colour {
                LightColour::WhiteHighlights => DVec3::splat(strength),
                _ => source.colour * strength,
            };
            let d = light * diffuse * self.diffuse_cosine(l_n);
            let highlight = match switches.specular {
                SpecularUse::InsidePower => ks
                    .to_array()
                    .map(|ks| self.highlight(material, shiny, l, v, ks))
                    .into(),
                _ => DVec3::splat(self.highlight(material, shiny, l, v, 1.0)),
            };
            let s = of_highlight * specular * highlight;
            match switches.sum {
                Sum::Clamped => {
                    terms[1] += d;
                    terms[2] += s;
                }
                // Each light's sum is clamped, and the highlight loses what the clamp cuts off.
                Sum::ClampedPerLight => {
                    let sum = (d + s).clamp(DVec3::ZERO, DVec3::ONE);
                    terms[1] += d.min(sum);
                    terms[2] += sum - d.min(sum);
                }
            }
        }
        [terms[0], terms[1] / self.shares, terms[2] / self.shares]
    }

    fn toward_viewer(&self, at: DVec3) -> DVec3 {
        let v = match (self.viewer, self.switches.view_length) {
            (Place::Infinite(v), _) => v,
            (Place::Local(eye), Length::Unit) => (eye - at).normalize_or_zero(),
            (Place::Local(eye), Length::Raw) => eye - at,
        };
        signed(v, self.switches.view_sign)
    }

    fn normal(&self, n: DVec3, p: DVec3) -> DVec3 {
        let n = match self.switches.normal_length {
            Length::Unit => n.normalize_or_zero(),
            Length::Raw => n,
        };
        let n = signed(n, self.switches.normal_sign);
        let n = match self.switches.normal_space {
            Space::World => n,
            Space::Camera => self.axes.transpose() * n,
        };
        let seen_along = match self.viewer {
            Place::Infinite(v) => v,
            Place::Local(eye) => eye - p,
        };
        match self.switches.facing {
            Facing::TowardViewer if n.dot(seen_along) < 0.0 => -n,
            _ => n,
        }
    }

    /// Returns the vector from a point toward a light, and the light's strength there.
    fn toward_light(&self, source: &Source, at: DVec3) -> (DVec3, f64) {
        let (l, strength) = match source.place {
            Place::Infinite(l) => (l * source.length, 1.0),
            Place::Local(position) => {
                let l = position - at;
                let r = l.length().max(1e-15);
                let unit = match self.switches.light_length {
                    Length::Unit => l / r,
                    Length::Raw => l,
                };
                (unit, source.falloff.at(r))
            }
        };
        (signed(l, self.switches.light_sign), strength)
    }

    fn diffuse_cosine(&self, l_n: f64) -> f64 {
        match self.switches.cosine {
            Cosine::Clamped => l_n.max(0.0),
            Cosine::Absolute => l_n.abs(),
            Cosine::Signed => l_n,
            Cosine::Half => 0.5 * l_n + 0.5,
        }
    }

    /// Returns (k R·V)ⁿ or (k N·H)ⁿ.
    fn highlight(&self, material: &Material, n: DVec3, l: DVec3, v: DVec3, k: f64) -> f64 {
        let l_n = l.dot(n);
        let cosine = k * self.highlight_cosine(n, l, v);
        let exponent = match self.switches.exponent {
            Exponent::One | Exponent::Factor => 1.0,
            _ => f64::from(material.shininess) * self.exponent,
        };
        let power = match self.switches.cap {
            Cap::Clamped => libm::pow(cosine.max(0.0), exponent),
            Cap::Unclamped => {
                let power = libm::pow(cosine, exponent);
                if power.is_nan() { 0.0 } else { power }
            }
        };
        let power = match self.switches.exponent {
            Exponent::Factor => power * f64::from(material.shininess) * self.exponent,
            _ => power,
        };
        match self.gate {
            SpecularGate::Gated if l_n > 0.0 => power,
            SpecularGate::Gated => 0.0,
            SpecularGate::Ungated => power,
            SpecularGate::Weighted => power * l_n.max(0.0),
        }
    }

    fn highlight_cosine(&self, n: DVec3, l: DVec3, v: DVec3) -> f64 {
        let l_n = l.dot(n);
        match self.switches.highlight {
            Highlight::NormalView => return n.dot(v),
            Highlight::NormalLight => return l_n,
            _ => {}
        }
        match self.model {
            SpecularModel::Phong => {
                let r = match self.switches.reflected {
                    Reflected::Right => 2.0 * l_n * n - l, // R = 2 (L·N) N − L
                    Reflected::Negated => l - 2.0 * l_n * n,
                    Reflected::WithoutTwo => l_n * n - l,
                    Reflected::Plus => 2.0 * l_n * n + l,
                    Reflected::OfView => 2.0 * n.dot(v) * n - l,
                };
                r.dot(v)
            }
            SpecularModel::Blinn => {
                let sum = l + v;
                let h = match self.switches.halfway {
                    Halfway::Unit
                        if sum.length_squared() <= f64::from(SpecularModel::LEAST_SUM) =>
                    {
                        DVec3::ZERO
                    }
                    Halfway::Unit => sum.normalize_or_zero(),
                    Halfway::Sum => sum,
                    Halfway::Mean => 0.5 * sum,
                    Halfway::Difference => (l - v).normalize_or_zero(),
                };
                let sign = match self.switches.reflected {
                    Reflected::Negated => -1.0,
                    _ => 1.0,
                };
                sign * n.dot(h)
            }
        }
    }
}

/// Returns the lights that are used.
fn sources(scene: &Scene, lengths: &[f64], origin: DVec3, switches: &Shading) -> Vec<Source> {
    let axes = axes(&scene.camera);
    let lengths = lengths.iter().copied().chain(core::iter::repeat(1.0));
    let all = scene
        .lights
        .iter()
        .zip(lengths)
        .map(|(light, length)| Source {
            place: light_place(light.place, origin, scene.camera.eye, axes, switches),
            length: match switches.light_length {
                Length::Unit => 1.0,
                Length::Raw => length,
            },
            colour: match switches.light_colour {
                LightColour::White => DVec3::ONE,
                LightColour::WhiteOfStrength => DVec3::splat(wide(light.colour).max_element()),
                LightColour::OfFirst => wide(scene.lights[0].colour),
                LightColour::Stated | LightColour::WhiteHighlights => wide(light.colour),
            },
            falloff: Strength::new(light.falloff, switches.falloff),
        });
    match switches.lights {
        LightUse::None => Vec::new(),
        LightUse::First => all.take(1).collect(),
        LightUse::Last => all.skip(scene.lights.len().saturating_sub(1)).collect(),
        LightUse::All | LightUse::Mean => all.collect(),
    }
}

/// Returns the highlights' cosine (R·V or N·H), and the factor of the materials' exponents.
fn highlight_model(scene: &Scene, switches: &Shading) -> (SpecularModel, f64) {
    let stated = scene.specular;
    let other = match stated {
        SpecularModel::Phong => SpecularModel::Blinn,
        SpecularModel::Blinn => SpecularModel::Phong,
    };
    let of_file = f64::from(stated.exponent(1.0, scene.shininess_for));
    let (model, ratio) = match switches.highlight {
        Highlight::Stated | Highlight::NormalView | Highlight::NormalLight => (stated, 1.0),
        Highlight::Other => (other, 1.0),
        Highlight::OtherConverted => (other, f64::from(other.exponent(1.0, stated))),
    };
    let factor = match switches.exponent {
        Exponent::Stated | Exponent::One | Exponent::Factor => 1.0,
        Exponent::Times128 => 128.0,
        Exponent::Half => 0.5,
        Exponent::Double => 2.0,
        Exponent::Quarter => 0.25,
        Exponent::Fourfold => 4.0,
    };
    (model, of_file * ratio * factor)
}

fn signed(v: DVec3, sign: Sign) -> DVec3 {
    match sign {
        Sign::Right => v,
        Sign::Negated => -v,
    }
}

impl Strength {
    /// Returns the strength for a scene's falloff and a recipe's mistake in it.
    fn new(stated: Falloff, taken: FalloffUse) -> Strength {
        match (taken, stated) {
            (FalloffUse::Missing, _) | (FalloffUse::Stated, Falloff::None) => Strength::Constant,
            (FalloffUse::Stated, Falloff::Attenuation(k)) => Strength::Quadratic(k.into()),
            (FalloffUse::Multiplied, Falloff::Attenuation(k)) => Strength::Growing(k.into()),
            (FalloffUse::Multiplied | FalloffUse::DiffuseOnly, _) => {
                Strength::new(stated, FalloffUse::Stated)
            }
            (FalloffUse::Linear, Falloff::Attenuation(k)) => Strength::Linear(k.into()),
            (FalloffUse::Linear, Falloff::None) => Strength::Constant,
            (FalloffUse::Stated, Falloff::InverseSquare) | (FalloffUse::InverseSquare, _) => {
                Strength::InverseSquare
            }
            (FalloffUse::Stated | FalloffUse::Linear | FalloffUse::Inverse, _) => Strength::Inverse,
        }
    }

    fn at(self, r: f64) -> f64 {
        match self {
            Strength::Constant => 1.0,
            Strength::Quadratic(k) => 1.0 / (1.0 + k * r * r),
            Strength::Linear(k) => 1.0 / (1.0 + k * r),
            Strength::Growing(k) => 1.0 + k * r * r,
            Strength::InverseSquare => 1.0 / (r * r),
            Strength::Inverse => 1.0 / r,
        }
    }
}

/// Returns right, up and toward the viewer: the axes of the camera's space.
fn axes(camera: &Camera) -> DMat3 {
    let [right, up, forward] = camera.axes();
    DMat3::from_cols(right, up, -forward)
}

/// Returns the place of a light with a recipe's mistakes, relative to the frame's origin.
fn light_place(
    stated: Place<DVec3>,
    origin: DVec3,
    eye: DVec3,
    axes: DMat3,
    switches: &Shading,
) -> Place<DVec3> {
    let turned = |v: DVec3| match switches.light_axes {
        Axes::Stated => v,
        Axes::NegatedX => v * DVec3::new(-1.0, 1.0, 1.0),
        Axes::NegatedY => v * DVec3::new(1.0, -1.0, 1.0),
        Axes::NegatedZ => v * DVec3::new(1.0, 1.0, -1.0),
        Axes::ZUp => DVec3::new(v.x, v.z, v.y),
    };
    let place = match (stated.map(turned), switches.light_place) {
        (Place::Local(p), LightPlace::PositionsAreDirections) => {
            Place::Infinite(p.normalize_or_zero())
        }
        (Place::Infinite(d), LightPlace::DirectionsArePositions) => {
            Place::Local(d.normalize_or_zero())
        }
        (place, _) => place,
    };
    match (place, switches.light_space) {
        (Place::Infinite(d), Space::World) => Place::Infinite(d.normalize_or_zero()),
        (Place::Local(p), Space::World) => Place::Local(p - origin),
        (Place::Infinite(d), Space::Camera) => Place::Infinite((axes * d).normalize_or_zero()),
        (Place::Local(p), Space::Camera) => Place::Local(axes * p + eye - origin),
    }
}
