//! The light on a point of a surface (L21 2.1).

use crate::camera::{Camera, unit};
use crate::options::{
    Ambient, Coefficients, DiffuseCosine, DiffuseTerm, Exponent, Falloff, Fresnel, Gate,
    HalfVector, HighlightCosine, LightAxes, LightColour, LightDirection, LightLength, LightSpace,
    Lights, NormalSpace, NormalW, Options, PixelNormal, PositionSpace, Reflection, SpecularClamp,
    SpecularColour, SpecularTerm, Terms, View, ViewLength,
};
use fastphong::mesh;
use fastphong::scene::{self, Place, Scene, SpecularGate, SpecularModel};
use glam::{DAffine3, DVec3};
use std::f64::consts::PI;

/// A point on a surface.
#[derive(Clone, Copy)]
pub struct Point {
    /// Its position in world space.
    pub position: DVec3,
    /// Its normal in world space.
    pub normal: DVec3,
    /// The length of the normal before it was normalised.
    pub length: f64,
    /// V, interpolated from corners, if the student computes it there.
    pub view: Option<DVec3>,
}

impl Point {
    /// Makes a point with a unit normal.
    pub fn new(position: DVec3, normal: DVec3) -> Point {
        Point {
            position,
            normal,
            length: 1.0,
            view: None,
        }
    }
}

/// The coefficients of a material.
struct Material {
    ka: DVec3,
    kd: DVec3,
    ks: DVec3,
    n: f64,
}

/// A light of the scene, in the space where the student lights the object.
struct Light {
    place: Place<DVec3>,
    colour: DVec3,
    falloff: scene::Falloff,
}

/// All light on one material of one object.
pub struct Lighting<'a> {
    options: &'a Options,
    scene: &'a Scene,
    camera: &'a Camera,
    eye: DVec3,
    /// The unit vector to an eye far away.
    far_eye: DVec3,
    ambient: DVec3,
    material: Material,
    lights: Vec<Light>,
    object_origin: DVec3,
}

fn wide(colour: [f32; 3]) -> DVec3 {
    DVec3::from_array(colour.map(f64::from))
}

impl<'a> Lighting<'a> {
    /// Makes the light on `material` of an object. `transform` maps the object to world space.
    pub fn new(
        scene: &'a Scene,
        camera: &'a Camera,
        options: &'a Options,
        material: &mesh::Material,
        transform: &DAffine3,
    ) -> Lighting<'a> {
        let moved = |place: Place<DVec3>| match (options.light_space, place) {
            (LightSpace::World, place) => place,
            (LightSpace::Object, Place::Infinite(l)) => {
                Place::Infinite(unit(transform.matrix3 * l))
            }
            (LightSpace::Object, Place::Local(p)) => Place::Local(transform.transform_point3(p)),
            (LightSpace::Eye, place) => place.map(|v| camera.turned_back(v)),
            (LightSpace::MovedToEye, Place::Infinite(l)) => Place::Infinite(camera.turned(l)),
            (LightSpace::MovedToEye, Place::Local(p)) => Place::Local(camera.moved(p)),
            // Seen from world space, the student turns lights back twice: once by mistake, and once
            // because normals and points are turned.
            (LightSpace::EyeTurnedBackTwice, Place::Infinite(l)) => {
                Place::Infinite(camera.turned_back(camera.turned_back(l)))
            }
            (LightSpace::EyeTurnedBackTwice, Place::Local(p)) => {
                Place::Local(scene.camera.eye + camera.turned_back(camera.turned_back(p)))
            }
        };
        let read = |v: DVec3| match options.light_axes {
            LightAxes::AsGiven => v,
            LightAxes::XyExchanged => DVec3::new(v.y, v.x, v.z),
            LightAxes::XzExchanged => DVec3::new(v.z, v.y, v.x),
        };
        let first = scene.lights.first().map_or([1.0; 3], |light| light.colour);
        let lights = scene.lights.iter().map(|light| Light {
            place: moved(
                light
                    .place
                    .map(|v| if light.place.is_local() { v } else { unit(v) })
                    .map(read),
            ),
            colour: match options.light_colour {
                LightColour::Own => wide(light.colour),
                LightColour::White => DVec3::ONE,
                LightColour::OfFirstLight => wide(first),
            },
            falloff: light.falloff,
        });
        Lighting {
            options,
            scene,
            camera,
            eye: scene.camera.eye,
            far_eye: unit(scene.camera.eye - scene.camera.target),
            ambient: wide(scene.ambient),
            material: coefficients(scene, options, material),
            lights: lights.collect(),
            object_origin: transform.translation,
        }
    }

    /// Returns the colour of a point, not clamped.
    pub fn colour(&self, point: &Point) -> DVec3 {
        let v = self.to_eye(point);
        let point = &self.shortened(point);
        let ambient = self.ambient(point);
        let mut sum = match self.options.terms {
            Terms::AmbientIsLeast => DVec3::ZERO,
            _ => ambient,
        };
        let last = self.lights.len().saturating_sub(1);
        for (number, light) in self.lights.iter().enumerate() {
            let share = match self.options.lights {
                Lights::Sum => 1.0,
                Lights::Mean => 1.0 / self.lights.len() as f64,
                Lights::First => f64::from(u8::from(number == 0)),
                Lights::Last => f64::from(u8::from(number == last)),
            };
            if share > 0.0 {
                sum += share * self.of_light(light, point, v);
            }
        }
        match self.options.terms {
            Terms::AmbientIsLeast => sum.max(ambient),
            _ => sum,
        }
    }

    /// Returns the point with the normal that is left of four components of length 1.
    fn shortened(&self, point: &Point) -> Point {
        let beside = match self.options.normal_w {
            NormalW::Dropped => return *point,
            NormalW::OfTarget => self.scene.camera.target,
            NormalW::OfEye => self.eye,
        };
        let beside = match self.options.normal_space {
            NormalSpace::World => beside,
            NormalSpace::Eye => self.camera.turned(beside),
        };
        let w = unit(point.normal).dot(beside);
        Point {
            normal: point.normal / (1.0 + w * w).sqrt(),
            ..*point
        }
    }

    /// Returns the position of a point as the student uses it.
    fn place(&self, point: &Point) -> DVec3 {
        match self.options.position_space {
            PositionSpace::World => point.position,
            PositionSpace::Eye => self.camera.moved(point.position),
        }
    }

    fn ambient(&self, point: &Point) -> DVec3 {
        let ka = self.material.ka;
        match self.options.ambient {
            Ambient::Right => self.ambient * ka,
            Ambient::Missing => DVec3::ZERO,
            Ambient::PerLight => self.ambient * ka * self.lights.len() as f64,
            Ambient::WithoutKa => self.ambient,
            Ambient::WithoutIa => ka,
            Ambient::TimesKd => self.ambient * self.material.kd,
            Ambient::Attenuated => {
                let of_light = |light| self.strength(light, self.to_light(light, point).1);
                self.ambient * ka * self.lights.iter().map(of_light).sum::<f64>()
            }
        }
    }

    /// Returns V.
    pub fn to_eye(&self, point: &Point) -> DVec3 {
        let place = self.place(point);
        let measured = |vector| match self.options.view_length {
            ViewLength::Unit => unit(vector),
            ViewLength::NotNormalised => vector,
        };
        let from_point = || measured(self.eye - place);
        let of_scene = || {
            if self.scene.local_viewer {
                from_point()
            } else {
                self.far_eye
            }
        };
        match self.options.view {
            View::OfScene => of_scene(),
            View::Negated => -of_scene(),
            View::AlongZ => DVec3::Z,
            View::AlwaysAtEye => from_point(),
            View::AlwaysFarAway => self.far_eye,
            View::TowardOrigin => unit(-place),
            // These students have one V where the scene has one.
            View::OfTwoSpaces | View::DifferenceOfUnits if !self.scene.local_viewer => of_scene(),
            View::OfTwoSpaces => measured(self.eye - self.camera.moved(point.position)),
            View::DifferenceOfUnits => measured(unit(self.eye) - unit(place)),
            View::AtVertices => point.view.map_or_else(of_scene, measured),
        }
    }

    /// Returns L, and the distance of the light.
    fn to_light(&self, light: &Light, point: &Point) -> (DVec3, f64) {
        let from = match self.options.light_direction {
            LightDirection::FromObjectOrigin => self.object_origin,
            _ => self.place(point),
        };
        let (l, distance) = match light.place {
            Place::Infinite(l) => (l, f64::INFINITY),
            Place::Local(p) => {
                let vector = match self.options.light_direction {
                    LightDirection::PositionAlone => p,
                    _ => p - from,
                };
                let distance = (p - self.place(point)).length();
                match self.options.light_length {
                    LightLength::Unit => (unit(vector), distance),
                    LightLength::NotNormalised => (vector, distance),
                }
            }
        };
        match self.options.light_direction {
            LightDirection::FromLight => (-l, distance),
            _ => (l, distance),
        }
    }

    /// Returns the factor by which a light weakens over `distance`.
    fn strength(&self, light: &Light, distance: f64) -> f64 {
        if !light.place.is_local() {
            return 1.0;
        }
        let square = distance * distance;
        match (self.options.falloff, light.falloff) {
            (Falloff::Missing, _) | (_, scene::Falloff::None) => 1.0,
            (Falloff::InverseSquare, _) => 1.0 / square,
            (Falloff::NotSquared, scene::Falloff::Attenuation(k)) => {
                1.0 / (1.0 + f64::from(k) * distance)
            }
            (Falloff::Multiplied, scene::Falloff::Attenuation(k)) => 1.0 + f64::from(k) * square,
            (_, scene::Falloff::Attenuation(k)) => 1.0 / (1.0 + f64::from(k) * square),
            (_, scene::Falloff::InverseSquare) => 1.0 / square,
            (_, scene::Falloff::Inverse) => 1.0 / distance,
        }
    }

    /// Returns the contribution of one light.
    fn of_light(&self, light: &Light, point: &Point, v: DVec3) -> DVec3 {
        let (l, distance) = self.to_light(light, point);
        let l_n = l.dot(point.normal);
        let cosine = match self.options.diffuse_cosine {
            DiffuseCosine::Clamped => l_n.max(0.0),
            DiffuseCosine::NotClamped => l_n,
            DiffuseCosine::Absolute => l_n.abs(),
            DiffuseCosine::Half => l_n / 2.0 + 0.5,
            DiffuseCosine::NormalView => v.dot(point.normal).max(0.0),
            DiffuseCosine::Wrapped => ((l_n + 0.5) / 1.5).max(0.0),
            DiffuseCosine::Squared => l_n.max(0.0) * l_n.max(0.0),
            DiffuseCosine::OfAngle => (1.0 - l_n.clamp(-1.0, 1.0).acos() / (PI / 2.0)).max(0.0),
            DiffuseCosine::FourSteps => (4.0 * l_n.max(0.0)).floor() / 4.0,
        };
        let Material { kd, ks, .. } = self.material;
        let diffuse = match self.options.diffuse_term {
            DiffuseTerm::Whole => light.colour * kd * cosine,
            DiffuseTerm::Missing => DVec3::ZERO,
            DiffuseTerm::OverPi => light.colour * kd * cosine / PI,
            DiffuseTerm::WithoutShine => light.colour * kd * (DVec3::ONE - ks) * cosine,
        };
        let colour = match self.options.specular_colour {
            SpecularColour::LightTimesKs => light.colour * ks,
            SpecularColour::LightTimesKd => light.colour * kd,
            SpecularColour::KsAlone => ks,
            SpecularColour::HueOfKd => light.colour * ks * kd / kd.max_element().max(1e-9),
        };
        let halfway = self.halfway(light, point, l, v);
        let highlight = |colour| {
            let whole = self.highlight(colour, point, [l, v, halfway]);
            let n = self.material.n;
            let highlight = match self.options.specular_term {
                SpecularTerm::Missing => DVec3::ZERO,
                SpecularTerm::Whole => whole,
                SpecularTerm::EnergyConserving => whole * (n + 8.0) / (8.0 * PI),
                SpecularTerm::EnergyConservingLobe => whole * (n + 2.0) / (2.0 * PI),
            };
            match self.options.fresnel {
                Fresnel::Without => highlight,
                Fresnel::OneMinusCosine => highlight * (1.0 - point.normal.dot(v)),
            }
        };
        let specular = highlight(colour);
        let strength = self.strength(light, distance);
        match self.options.falloff {
            Falloff::DiffuseOnly => self.both(diffuse * strength, specular, highlight),
            _ => self.both(diffuse, specular, highlight) * strength,
        }
    }

    /// Returns the light of two terms. `highlight` computes the specular term of another colour.
    fn both(&self, diffuse: DVec3, specular: DVec3, highlight: impl Fn(DVec3) -> DVec3) -> DVec3 {
        let over = |share: DVec3| diffuse * (DVec3::ONE - share) + specular;
        match self.options.terms {
            Terms::Added | Terms::AmbientIsLeast => diffuse + specular,
            Terms::Mixed => over(highlight(DVec3::ONE)),
            Terms::MixedWithLight => over(highlight(self.material.ks)),
            Terms::LargerOfTwo => diffuse.max(specular),
        }
    }

    /// Returns the vector along H, of any length.
    fn halfway(&self, light: &Light, point: &Point, l: DVec3, v: DVec3) -> DVec3 {
        match self.options.half_vector {
            HalfVector::Unit | HalfVector::NotNormalised | HalfVector::Mean => l + v,
            HalfVector::Difference => l - v,
            // A vector to infinity has no length to forget.
            HalfVector::OfDistances => {
                let place = self.place(point);
                let long_l = match light.place {
                    Place::Infinite(_) => l,
                    Place::Local(p) => unit(l) * (p - place).length(),
                };
                if self.scene.local_viewer {
                    long_l + unit(v) * (self.eye - place).length()
                } else {
                    long_l + v
                }
            }
            HalfVector::Constant => {
                let toward_light = match light.place {
                    Place::Infinite(l) => l,
                    Place::Local(p) => unit(p),
                };
                toward_light + unit(self.eye)
            }
        }
    }

    /// Returns the highlight of one light. `colour` is the light's colour times the material's, and
    /// the vectors are L, V and one along H.
    fn highlight(&self, colour: DVec3, point: &Point, [l, v, halfway]: [DVec3; 3]) -> DVec3 {
        let n = point.normal;
        let l_n = l.dot(n);
        let gate = match (self.options.gate, self.scene.gate) {
            (Gate::OfScene, SpecularGate::Gated) => f64::from(u8::from(l_n > 0.0)),
            (Gate::OfScene, SpecularGate::Ungated) | (Gate::Missing, _) => 1.0,
            (Gate::OfScene, SpecularGate::Weighted) | (Gate::TimesDiffuse, _) => l_n.max(0.0),
        };
        if gate == 0.0 {
            return DVec3::ZERO;
        }
        let cosine = self.highlight_cosine(point, l, v, halfway);
        let cosine = match self.options.specular_clamp {
            SpecularClamp::Clamped => cosine.max(0.0),
            SpecularClamp::NotClamped => cosine,
        };
        let exponent = self.material.n;
        // A negative number to the power of a fraction is a NaN, which is stored as black.
        let power = |x: f64| match x.powf(exponent) {
            power if power.is_nan() => 0.0,
            power => power,
        };
        gate * match self.options.exponent {
            Exponent::Factor => colour * cosine * exponent,
            Exponent::OfProduct => DVec3::from_array((colour * cosine).to_array().map(power)),
            _ => colour * power(cosine),
        }
    }

    fn highlight_cosine(&self, point: &Point, l: DVec3, v: DVec3, halfway: DVec3) -> f64 {
        // R·V contains the normal twice, so (4.6) of L21 divides by N·N.
        let n = match (self.options.pixel_normal, self.scene.specular) {
            (PixelNormal::NotInHighlights, _) => point.normal * point.length,
            (PixelNormal::RootInHighlights, SpecularModel::Phong) => {
                point.normal * point.length.sqrt()
            }
            _ => point.normal,
        };
        let model = match (self.options.highlight_cosine, self.scene.specular) {
            (HighlightCosine::NormalView, _) => return n.dot(v),
            (HighlightCosine::NormalLight, _) => return n.dot(l),
            (HighlightCosine::OfScene, model) => model,
            (HighlightCosine::OtherModel, SpecularModel::Phong) => SpecularModel::Blinn,
            (HighlightCosine::OtherModel, SpecularModel::Blinn) => SpecularModel::Phong,
        };
        match model {
            SpecularModel::Phong => match self.options.reflection {
                Reflection::Right if self.options.pixel_normal == PixelNormal::ReflectionAlone => {
                    (2.0 * n.dot(l) * n - l).normalize_or_zero()
                }
                Reflection::Right => 2.0 * n.dot(l) * n - l,
                Reflection::Negated => l - 2.0 * n.dot(l) * n,
                Reflection::WithoutTwo => n.dot(l) * n - l,
                Reflection::OfView => 2.0 * n.dot(v) * n - l,
                Reflection::BracketedDifference => 2.0 * n.dot(l) * (n - l),
                Reflection::UnitBracketedDifference => {
                    (2.0 * n.dot(l) * (n - l)).normalize_or_zero()
                }
            }
            .dot(v),
            SpecularModel::Blinn => {
                let length = halfway.length();
                if length < 1e-3 {
                    return 0.0;
                }
                n.dot(match self.options.half_vector {
                    HalfVector::NotNormalised => halfway,
                    HalfVector::Mean => halfway / 2.0,
                    HalfVector::Unit
                    | HalfVector::Difference
                    | HalfVector::OfDistances
                    | HalfVector::Constant => halfway / length,
                })
            }
        }
    }
}

/// Returns the coefficients that the student uses for a material.
fn coefficients(scene: &Scene, options: &Options, material: &mesh::Material) -> Material {
    let [ka, kd, ks] = [material.ambient, material.diffuse, material.specular].map(wide);
    let decoded = |k: DVec3| DVec3::from_array(k.to_array().map(|c| c.powf(2.2)));
    let [ka, kd, ks] = match options.coefficients {
        Coefficients::Right => [ka, kd, ks],
        Coefficients::Swapped => [ka, ks, kd],
        Coefficients::Decoded => [ka, kd, ks].map(decoded),
    };
    let n = exponent(scene, options, material.shininess.into());
    Material { ka, kd, ks, n }
}

/// Returns the exponent that the student uses for a material.
fn exponent(scene: &Scene, options: &Options, shininess: f64) -> f64 {
    let is_other_model = options.highlight_cosine == HighlightCosine::OtherModel;
    let ratio = match (scene.shininess_for, scene.specular) {
        // A student who uses the other model does not convert its exponent either.
        _ if is_other_model => 1.0,
        (SpecularModel::Phong, SpecularModel::Blinn) => 4.0,
        (SpecularModel::Blinn, SpecularModel::Phong) => 0.25,
        _ => 1.0,
    };
    match options.exponent {
        Exponent::Right | Exponent::Factor | Exponent::OfProduct => shininess * ratio,
        Exponent::Missing => 1.0,
        Exponent::Times128 => shininess * 128.0,
        Exponent::NotConverted => shininess,
        Exponent::DividedByFour => shininess / ratio,
    }
}
