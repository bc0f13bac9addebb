//! The vectors N, L and V at a point and their cosines (L21 2.1), with a switch for each mistake,
//! in `f64`.
//!
//! It shares no arithmetic with the methods, nor with the reference. A test compares it with the
//! reference when no switch is set.

use super::recipe::{
    Axes, Cap, Cosine, Exponent, Facing, FalloffUse, Fresnel, Halfway, Highlight, Length,
    LightPlace, LightSpace, NormalW, Reflected, Shading, Sign, Space, Viewer,
};
use alloc::vec::Vec;
use core::f64::consts::FRAC_PI_2;
use fastphong::mesh::Material;
use fastphong::scene::{Camera, Falloff, Place, Scene, SpecularGate, SpecularModel};
use glam::{DMat3, DVec3};

/// What a light gives to a point before it is multiplied by colours.
#[derive(Clone, Copy, Default)]
pub struct Ray {
    /// L·N times the light's strength.
    pub diffuse: f64,
    /// (R·V)ⁿ times the light's strength.
    pub highlight: f64,
    /// The light's strength at the point: 1 unless it falls off.
    pub strength: f64,
}

/// A point of a surface, ready to be lit. Positions are relative to the frame's origin.
#[derive(Clone, Copy, Default)]
pub struct Point {
    pub normal: DVec3,
    pub position: DVec3,
    /// The point where L and V are computed: `position`, unless they are constant.
    pub at: DVec3,
    /// V, if it is interpolated between vertices.
    pub view: Option<DVec3>,
}

/// A light of a recipe. Positions are relative to the frame's origin.
#[derive(Clone, Copy)]
struct Source {
    place: Place<DVec3>,
    /// The length of a direction.
    length: f64,
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
    /// Right, up and toward the viewer.
    axes: DMat3,
    /// The viewer's position, or the direction to it.
    viewer: Place<DVec3>,
    /// The eye and the target in the world, and the frame's origin.
    eye: DVec3,
    target: DVec3,
    origin: DVec3,
    model: SpecularModel,
    /// The factor of the materials' exponents.
    exponent: f64,
    gate: SpecularGate,
}

impl Illumination {
    /// Reads the lights of `scene` with the mistakes of `switches`. `lengths` are the lengths of
    /// light directions in the file.
    pub fn new(scene: &Scene, lengths: &[f64], origin: DVec3, switches: Shading) -> Illumination {
        let camera = &scene.camera;
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
            gate: switches.gate.unwrap_or(scene.gate),
            exponent,
            sources: sources(scene, lengths, origin, &switches),
            axes: axes(camera),
            switches,
            viewer,
            eye: camera.eye,
            target: camera.target,
            origin,
            model,
        }
    }

    /// Returns the same lights with other directions and positions, and with all exponents
    /// multiplied by `factor`. Positions are in the world.
    pub fn fitted(mut self, places: &[Place<DVec3>], factor: f64) -> Illumination {
        for (source, place) in self.sources.iter_mut().zip(places) {
            source.place = match *place {
                Place::Infinite(direction) => Place::Infinite(direction.normalize_or_zero()),
                Place::Local(position) => Place::Local(position - self.origin),
            };
        }
        self.exponent *= factor;
        self
    }

    /// Returns how many lights there are.
    pub fn len(&self) -> usize {
        self.sources.len()
    }

    /// Returns the exponent to which a material's cosines are raised.
    pub fn exponent(&self, material: &Material) -> f64 {
        match self.switches.exponent {
            Exponent::One | Exponent::Factor => 1.0,
            _ => f64::from(material.shininess) * self.exponent,
        }
    }

    /// Adds the ray of each light at a point: the cosines of
    /// ```text
    /// I = I_a k_a + Σ (I_p k_d (L·N) + I_p k_s (R·V)ⁿ)      (L21 2.1)
    /// ```
    pub fn rays(&self, material: &Material, point: &Point, rays: &mut Vec<Ray>) {
        let switches = &self.switches;
        let at = match switches.position_space {
            Space::World => point.at,
            Space::Camera => {
                self.axes.transpose() * (point.at + self.origin - self.eye) - self.origin
            }
        };
        let away = self.toward_viewer(at, point.at);
        let v = match (point.view, switches.view_length) {
            (Some(v), _) => v.normalize_or_zero(),
            (None, Length::Unit) if self.is_viewer_local() => away.normalize_or_zero(),
            (None, _) => away,
        };
        let [v, raw_v] = [v, away].map(|v| signed(v, switches.view_sign));
        let n = self.normal(point.normal, point.position);
        let shiny = match switches.highlight_normal {
            Length::Unit => n,
            Length::Raw => point.normal,
        };
        for source in &self.sources {
            let (l, raw_l, strength) = self.toward_light(source, at);
            let vectors = Vectors {
                n: shiny,
                l,
                v,
                raw_l,
                raw_v,
            };
            let is_near = switches.falloff == FalloffUse::DiffuseOnly;
            let of_highlight = if is_near { 1.0 } else { strength };
            rays.push(Ray {
                diffuse: self.diffuse_cosine(l.dot(n)) * strength,
                highlight: self.highlight(material, &vectors) * of_highlight,
                strength,
            });
        }
    }

    /// True if V depends on the point.
    fn is_viewer_local(&self) -> bool {
        let is_difference = matches!(self.switches.viewer, Viewer::OfUnits | Viewer::OfTwoSpaces);
        is_difference || matches!(self.viewer, Place::Local(_))
    }

    /// Returns V at a point, as long as its distance if the viewer is at a position. `own` is the
    /// point in the world, where `at` may be in the camera's space.
    fn toward_viewer(&self, at: DVec3, own: DVec3) -> DVec3 {
        match (self.switches.viewer, self.viewer) {
            (Viewer::OfUnits, _) => {
                self.eye.normalize_or_zero() - (at + self.origin).normalize_or_zero()
            }
            (Viewer::OfTwoSpaces, _) => {
                self.eye - self.axes.transpose() * (own + self.origin - self.eye)
            }
            (_, Place::Infinite(v)) => v,
            (_, Place::Local(eye)) => eye - at,
        }
    }

    /// Returns the unit vector from a vertex to the viewer.
    pub fn view_of_vertex(&self, p: DVec3) -> DVec3 {
        self.toward_viewer(p, p).normalize_or_zero()
    }

    fn normal(&self, n: DVec3, p: DVec3) -> DVec3 {
        let switches = &self.switches;
        let n = match switches.normal_length {
            Length::Unit => n.normalize_or_zero(),
            Length::Raw => n,
        };
        let n = turned(n, switches.normal_axes);
        let w = match switches.normal_w {
            NormalW::Missing => 0.0,
            NormalW::OfTarget => n.dot(self.target),
            NormalW::OfEye => n.dot(self.eye),
        };
        let n = n / libm::sqrt(1.0 + w * w);
        let n = signed(n, switches.normal_sign);
        let n = match switches.normal_space {
            Space::World => n,
            Space::Camera => self.axes.transpose() * n,
        };
        let seen_along = match self.viewer {
            Place::Infinite(v) => v,
            Place::Local(eye) => eye - p,
        };
        match switches.facing {
            Facing::TowardViewer if n.dot(seen_along) < 0.0 => -n,
            _ => n,
        }
    }

    /// Returns the vector from a point toward a light, this vector as long as the distance, and the
    /// light's strength there.
    fn toward_light(&self, source: &Source, at: DVec3) -> (DVec3, DVec3, f64) {
        let (l, raw, strength) = match source.place {
            Place::Infinite(l) => {
                let l = l * source.length;
                (l, l, 1.0)
            }
            Place::Local(position) => {
                let l = position - at;
                let r = l.length().max(1e-15);
                let unit = match self.switches.light_length {
                    Length::Unit => l / r,
                    Length::Raw => l,
                };
                (unit, l, source.falloff.at(r))
            }
        };
        let sign = self.switches.light_sign;
        (signed(l, sign), signed(raw, sign), strength)
    }

    fn diffuse_cosine(&self, l_n: f64) -> f64 {
        match self.switches.cosine {
            Cosine::Clamped => l_n.max(0.0),
            Cosine::Absolute => l_n.abs(),
            Cosine::Signed => l_n,
            Cosine::Half => 0.5 * l_n + 0.5,
            Cosine::Wrapped => ((l_n + 0.5) / 1.5).max(0.0),
            Cosine::Squared => l_n.max(0.0) * l_n.max(0.0),
            Cosine::Angle => (1.0 - libm::acos(l_n.clamp(-1.0, 1.0)) / FRAC_PI_2).max(0.0),
            Cosine::StepsUp => libm::ceil(4.0 * l_n.max(0.0)) / 4.0,
            Cosine::StepsDown => libm::floor(4.0 * l_n.max(0.0)) / 4.0,
        }
    }

    /// Returns (R·V)ⁿ or (N·H)ⁿ.
    fn highlight(&self, material: &Material, vectors: &Vectors) -> f64 {
        let l_n = vectors.l.dot(vectors.n);
        let cosine = self.highlight_cosine(vectors);
        let exponent = self.exponent(material);
        let power = match self.switches.cap {
            Cap::Clamped => power(cosine.max(0.0), exponent),
            Cap::Unclamped => {
                let power = power(cosine, exponent);
                if power.is_nan() { 0.0 } else { power }
            }
        };
        let power = match self.switches.exponent {
            Exponent::Factor => power * f64::from(material.shininess) * self.exponent,
            _ => power,
        };
        let power = match self.switches.fresnel {
            Fresnel::Missing => power,
            Fresnel::OneMinusCosine => power * (1.0 - vectors.n.dot(vectors.v).max(0.0)),
        };
        match self.gate {
            SpecularGate::Gated if l_n > 0.0 => power,
            SpecularGate::Gated => 0.0,
            SpecularGate::Ungated => power,
            SpecularGate::Weighted => power * l_n.max(0.0),
        }
    }

    fn highlight_cosine(
        &self,
        &Vectors {
            n,
            l,
            v,
            raw_l,
            raw_v,
        }: &Vectors,
    ) -> f64 {
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
                    Reflected::Normalised => (2.0 * l_n * n - l).normalize_or_zero(),
                    Reflected::TimesCosine => (2.0 * l_n * (n - l)).normalize_or_zero(),
                };
                r.dot(v)
            }
            SpecularModel::Blinn => {
                let sum = l + v;
                let is_nothing = sum.length_squared() <= f64::from(SpecularModel::LEAST_SUM);
                let h = match self.switches.halfway {
                    Halfway::Unit if is_nothing => DVec3::ZERO,
                    Halfway::Unit => sum.normalize_or_zero(),
                    Halfway::Sum => sum,
                    Halfway::Mean => 0.5 * sum,
                    Halfway::Difference => (l - v).normalize_or_zero(),
                    Halfway::OfDistances => (raw_l + raw_v).normalize_or_zero(),
                    Halfway::Constant => (l + self.eye.normalize_or_zero()).normalize_or_zero(),
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

/// Returns xⁿ. Whole exponents are common, and multiplying is quicker.
fn power(x: f64, n: f64) -> f64 {
    const MOST: f64 = 1024.0;
    if !(0.0..=MOST).contains(&n) || n.fract() != 0.0 {
        return libm::pow(x, n);
    }
    let (mut bits, mut square, mut product) = (n as u32, x, 1.0);
    while bits > 0 {
        if bits & 1 == 1 {
            product *= square;
        }
        square *= square;
        bits >>= 1;
    }
    product
}

/// The vectors of a highlight. `raw_l` and `raw_v` are as long as their distances.
struct Vectors {
    n: DVec3,
    l: DVec3,
    v: DVec3,
    raw_l: DVec3,
    raw_v: DVec3,
}

/// Returns the lights.
fn sources(scene: &Scene, lengths: &[f64], origin: DVec3, switches: &Shading) -> Vec<Source> {
    let axes = axes(&scene.camera);
    let lengths = lengths.iter().copied().chain(core::iter::repeat(1.0));
    let all = scene.lights.iter().zip(lengths);
    all.map(|(light, length)| Source {
        place: light_place(light.place, origin, &scene.camera, axes, switches),
        length: match switches.light_length {
            Length::Unit => 1.0,
            Length::Raw => length,
        },
        falloff: Strength::new(light.falloff, switches.falloff),
    })
    .collect()
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
    camera: &Camera,
    axes: DMat3,
    switches: &Shading,
) -> Place<DVec3> {
    let eye = camera.eye;
    let moved =
        |d: DVec3, by: DVec3| Place::Infinite((d.normalize_or_zero() - by).normalize_or_zero());
    let place = match (
        stated.map(|v| turned(v, switches.light_axes)),
        switches.light_place,
    ) {
        (Place::Local(p), LightPlace::PositionsAreDirections) => {
            Place::Infinite(p.normalize_or_zero())
        }
        (Place::Infinite(d), LightPlace::DirectionsArePositions) => {
            Place::Local(d.normalize_or_zero())
        }
        (Place::Infinite(d), LightPlace::DirectionsMinusEye) => moved(d, eye),
        (Place::Infinite(d), LightPlace::DirectionsMinusTarget) => moved(d, camera.target),
        (place, _) => place,
    };
    let back = axes.transpose();
    match (place, switches.light_space) {
        (Place::Infinite(d), LightSpace::World) => Place::Infinite(d.normalize_or_zero()),
        (Place::Local(p), LightSpace::World) => Place::Local(p - origin),
        (Place::Infinite(d), LightSpace::Camera) => Place::Infinite((axes * d).normalize_or_zero()),
        (Place::Local(p), LightSpace::Camera) => Place::Local(axes * p + eye - origin),
        (Place::Infinite(d), LightSpace::Turned) => Place::Infinite(d.normalize_or_zero()),
        (Place::Local(p), LightSpace::Turned) => Place::Local(axes * p - origin),
        (Place::Infinite(d), LightSpace::Moved) => Place::Infinite((back * d).normalize_or_zero()),
        (Place::Local(p), LightSpace::Moved) => Place::Local(back * (p - eye) - origin),
        (Place::Infinite(d), LightSpace::Inverse) => {
            Place::Infinite((axes * (axes * d)).normalize_or_zero())
        }
        (Place::Local(p), LightSpace::Inverse) => {
            Place::Local(axes * (axes * (p - eye)) + eye - origin)
        }
    }
}

/// Returns a vector in other axes.
fn turned(v: DVec3, axes: Axes) -> DVec3 {
    match axes {
        Axes::Stated => v,
        Axes::NegatedX => v * DVec3::new(-1.0, 1.0, 1.0),
        Axes::NegatedY => v * DVec3::new(1.0, -1.0, 1.0),
        Axes::NegatedZ => v * DVec3::new(1.0, 1.0, -1.0),
        Axes::ZUp => DVec3::new(v.x, v.z, v.y),
        Axes::ExchangedXy => DVec3::new(v.y, v.x, v.z),
        Axes::ExchangedXz => DVec3::new(v.z, v.y, v.x),
    }
}
