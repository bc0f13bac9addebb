//! `[[light]]`, and the words of the illumination model: as they are written, and what they mean.

use super::check::Check;
use super::diagnostics::SceneError;
use super::value::{Choice, Located, OneOrThree, Origin};
use crate::scene::{Falloff, Light, Place, SpecularGate, SpecularModel};
use glam::DVec3;
use serde::de::{Deserialize, Deserializer};
use serde::ser::{Serialize, Serializer};
use std::format;

/// `[[light]]`: a light at infinity (`direction`) or at a place (`position`).
#[derive(Clone, Debug, Default, PartialEq, serde::Deserialize, serde::Serialize)]
#[serde(deny_unknown_fields, remote = "Self")]
pub struct LightSection {
    /// The table itself: where its header stands.
    #[serde(skip)]
    pub table: Located<()>,
    /// Toward the light, in world space; any length but 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<Located<[f64; 3]>>,
    /// Instead of `direction`: where the light is, in world space; not at a vertex.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<Located<[f64; 3]>>,
    /// Intensity of each channel, 0 or more: one number or red, green, blue. Default: 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<Located<OneOrThree>>,
    /// A factor on the colour, 0 or more. Default: 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub intensity: Option<Located<f64>>,
    /// With `position`: k of the attenuation 1 / (1 + k d²), 0 or more (CS171 2). Default: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub attenuation: Option<Located<f64>>,
    /// Instead of `attenuation`: `"none"` (default), `"inverse-square"` (1/r²) or `"inverse"` (1/r) (L5).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub falloff: Option<Located<FalloffChoice>>,
}

impl<'de> Deserialize<'de> for LightSection {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Keys(LightSection);
        impl<'de> Deserialize<'de> for Keys {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                LightSection::deserialize(deserializer).map(Keys)
            }
        }
        let table = toml::Spanned::<Keys>::deserialize(deserializer)?;
        let origin = Origin::File(table.span());
        Ok(LightSection {
            table: Located { value: (), origin },
            ..table.into_inner().0
        })
    }
}

impl Serialize for LightSection {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        LightSection::serialize(self, serializer)
    }
}

impl LightSection {
    /// A white light of intensity 1 at infinity.
    pub fn toward(direction: impl Into<Located<[f64; 3]>>) -> Self {
        LightSection {
            direction: Some(direction.into()),
            ..LightSection::default()
        }
    }

    /// A white light of intensity 1 at a place.
    pub fn at(position: impl Into<Located<[f64; 3]>>) -> Self {
        LightSection {
            position: Some(position.into()),
            ..LightSection::default()
        }
    }

    /// The light that this describes, light number `number` of the scene, from 1.
    pub(super) fn resolve(&self, number: usize, check: &Check) -> Result<Light, SceneError> {
        let place = match (&self.direction, &self.position) {
            (Some(direction), None) => {
                Place::Infinite(check.direction(direction, "light.direction")?)
            }
            (None, Some(position)) => Place::Local(check.point(position, "light.position")?),
            (Some(direction), Some(position)) => {
                let why = "expected one of them: a light is at infinity or at a place";
                let (at, other) = (&position.origin, &direction.origin);
                return Err(check.conflict("light.position", at, "light.direction", other, why));
            }
            (None, None) => {
                let problem =
                    format!("light number {number} has neither `direction` nor `position`");
                return Err(check.error_at(
                    &self.table.origin,
                    &problem,
                    "expected one of them in every [[light]]",
                ));
            }
        };
        Ok(Light {
            place,
            colour: self.resolve_colour(check)?,
            falloff: self.resolve_falloff(check)?,
        })
    }

    fn resolve_colour(&self, check: &Check) -> Result<[f32; 3], SceneError> {
        let colour = match &self.colour {
            Some(given) => check.channels(given, "light.colour", f64::INFINITY)?,
            None => [1.0; 3],
        };
        let intensity = match &self.intensity {
            Some(given) => check.not_negative(given, "light.intensity")?,
            None => 1.0,
        };
        let colour = colour.map(|channel| (f64::from(channel) * intensity) as f32);
        match &self.intensity {
            Some(given) if !colour.iter().all(|channel| channel.is_finite()) => {
                let expected = "expected a finite product with the colour";
                Err(check.error(
                    &given.origin,
                    "light.intensity",
                    &format!("is {intensity}"),
                    expected,
                ))
            }
            _ => Ok(colour),
        }
    }

    fn resolve_falloff(&self, check: &Check) -> Result<Falloff, SceneError> {
        let given = self
            .attenuation
            .as_ref()
            .map(|k| ("light.attenuation", &k.origin));
        let given = given.or(self.falloff.as_ref().map(|f| ("light.falloff", &f.origin)));
        if let (Some((key, at)), Some(_)) = (given, &self.direction) {
            let expected = "expected it beside `position`: a light at infinity has no distance";
            return Err(check.error(at, key, "is given for a light with a `direction`", expected));
        }
        match (&self.attenuation, &self.falloff) {
            (Some(k), Some(falloff)) => {
                let why = "expected one of them: `attenuation` is a falloff too";
                Err(check.conflict(
                    "light.attenuation",
                    &k.origin,
                    "light.falloff",
                    &falloff.origin,
                    why,
                ))
            }
            (Some(k), None) => Ok(Falloff::Attenuation(
                check.not_negative(k, "light.attenuation")? as f32,
            )),
            (None, Some(falloff)) => Ok(falloff.value.0),
            (None, None) => Ok(Falloff::None),
        }
    }

    /// An error if the light stands at one of `points`, where the direction toward it is undefined.
    pub(super) fn check_distance(&self, points: &[DVec3], check: &Check) -> Result<(), SceneError> {
        let Some(position) = &self.position else {
            return Ok(());
        };
        let light = DVec3::from_array(position.value);
        // Closer than the rounding of positions in `f32` is the same place.
        let is_here = |p: &DVec3| {
            (*p - light).length() <= f64::from(f32::EPSILON) * p.length().max(light.length())
        };
        match points.iter().find(|p| is_here(p)) {
            Some(p) => {
                let problem = format!("is at a vertex, ({}, {}, {})", p.x, p.y, p.z);
                let expected = "expected a place off the vertices: there the direction toward the light is undefined";
                Err(check.error(&position.origin, "light.position", &problem, expected))
            }
            None => Ok(()),
        }
    }
}

/// A falloff that has a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FalloffChoice(pub Falloff);

impl Choice for FalloffChoice {
    const WORDS: &'static [&'static str] = &["none", "inverse-square", "inverse"];
    const MEANINGS: &'static [Self] = &[
        FalloffChoice(Falloff::None),
        FalloffChoice(Falloff::InverseSquare),
        FalloffChoice(Falloff::Inverse),
    ];
}

/// Where the eye is for the highlights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ViewerChoice {
    /// At infinity along the line of sight (L21 1).
    #[default]
    Infinite,
    /// Where the camera is (CS171 2).
    Local,
}

impl Choice for ViewerChoice {
    const WORDS: &'static [&'static str] = &["infinite", "local"];
    const MEANINGS: &'static [Self] = &[ViewerChoice::Infinite, ViewerChoice::Local];
}

impl Choice for SpecularModel {
    const WORDS: &'static [&'static str] = &["phong", "blinn"];
    const MEANINGS: &'static [Self] = &[SpecularModel::Phong, SpecularModel::Blinn];
}

impl Choice for SpecularGate {
    const WORDS: &'static [&'static str] = &["gated", "ungated", "weighted"];
    const MEANINGS: &'static [Self] = &[
        SpecularGate::Gated,
        SpecularGate::Ungated,
        SpecularGate::Weighted,
    ];
}
