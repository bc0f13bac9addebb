//! The colours that cosines are multiplied by, and the sum (L21 2.1), with a switch for each
//! mistake.

use super::light::Ray;
use super::recipe::{AmbientUse, DiffuseUse, LightColour, LightUse, Mixing, SpecularUse, Sum};
use alloc::vec::Vec;
use core::f64::consts::PI;
use fastphong::mesh::Material;
use fastphong::picture::Rgb;
use fastphong::scene::Scene;
use glam::DVec3;

/// The colours of a recipe's lights, for diffuse and for specular light.
struct Colours {
    diffuse: DVec3,
    highlight: DVec3,
}

/// The material of a point, with the exponent that its highlights were raised to.
pub struct Matter<'a> {
    pub material: &'a Material,
    pub exponent: f64,
    /// The vertex colour, by which some materials are multiplied.
    pub colour: Option<DVec3>,
}

/// Mixes colours from rays.
pub struct Mixer {
    switches: Mixing,
    ambient: DVec3,
    lights: Vec<Colours>,
    /// The divisor of the sum of all lights.
    shares: f64,
}

/// Converts a colour or coefficient to double precision.
fn wide(c: Rgb) -> DVec3 {
    DVec3::from_array(c.map(f64::from))
}

impl Mixer {
    /// Makes the mixer of a scene with the mistakes of `switches`.
    pub fn new(scene: &Scene, switches: Mixing) -> Mixer {
        let lights = scene.lights.iter().map(|light| {
            let own = wide(light.colour);
            let diffuse = match switches.light_colour {
                LightColour::White => DVec3::ONE,
                LightColour::WhiteOfStrength => DVec3::splat(own.max_element()),
                LightColour::OfFirst => wide(scene.lights[0].colour),
                LightColour::Stated | LightColour::WhiteHighlights => own,
            };
            let highlight = match switches.light_colour {
                LightColour::WhiteHighlights => DVec3::ONE,
                _ => diffuse,
            };
            Colours { diffuse, highlight }
        });
        let count = scene.lights.len();
        Mixer {
            switches,
            ambient: match switches.ambient {
                AmbientUse::Missing => DVec3::ZERO,
                AmbientUse::PerLight => wide(scene.ambient) * count as f64,
                AmbientUse::WithoutLight => DVec3::ONE,
                _ => wide(scene.ambient),
            },
            lights: lights.collect(),
            shares: match switches.lights {
                LightUse::Mean => count.max(1) as f64,
                _ => 1.0,
            },
        }
    }

    /// Returns the colour of a point, not clamped. It has a ray for each light.
    pub fn colour(&self, matter: &Matter<'_>, rays: &[Ray]) -> DVec3 {
        let material = matter.material;
        let tint = |c: DVec3| matter.colour.map_or(c, |colour| c * colour);
        let (kd, ks) = (wide(material.diffuse), wide(material.specular));
        let ambient = tint(self.ambient(material, rays));
        let diffuse = tint(match self.switches.diffuse {
            DiffuseUse::Stated => kd,
            DiffuseUse::Missing => DVec3::ZERO,
            DiffuseUse::OverPi => kd / PI,
            DiffuseUse::TimesRest => kd * (DVec3::ONE - ks),
        });
        let specular = match self.switches.specular {
            SpecularUse::Stated => ks,
            SpecularUse::Missing => DVec3::ZERO,
            SpecularUse::TimesDiffuse => ks * kd,
            SpecularUse::DiffuseColour => kd,
            SpecularUse::WithoutMaterial => DVec3::ONE,
            // (k R·V)ⁿ = kⁿ (R·V)ⁿ
            SpecularUse::InsidePower => ks.powf(matter.exponent),
            SpecularUse::Tinted => ks * kd / kd.max_element().max(1e-9),
            SpecularUse::NormalisedForHalfway => ks * ((matter.exponent + 8.0) / (8.0 * PI)),
            SpecularUse::Normalised => ks * ((matter.exponent + 2.0) / (2.0 * PI)),
        };
        let last = rays.len().saturating_sub(1);
        let used = match self.switches.lights {
            LightUse::All | LightUse::Mean => 0..rays.len(),
            LightUse::First => 0..rays.len().min(1),
            LightUse::Last => last..rays.len(),
            LightUse::None => 0..0,
        };
        let mut lit = DVec3::ZERO;
        for i in used {
            let (ray, colours) = (&rays[i], &self.lights[i]);
            let d = colours.diffuse * diffuse * ray.diffuse;
            let s = colours.highlight * specular * ray.highlight;
            lit += match self.switches.sum {
                Sum::Clamped | Sum::AmbientAsFloor => d + s,
                Sum::ClampedPerLight => (d + s).clamp(DVec3::ZERO, DVec3::ONE),
                Sum::Mixed => d * (DVec3::ONE - specular * ray.highlight) + s,
                Sum::LargerTerm => d.max(s),
            };
        }
        lit /= self.shares;
        match self.switches.sum {
            Sum::AmbientAsFloor => lit.max(ambient),
            _ => ambient + lit,
        }
    }

    /// Returns the factors of a material's ambient light, and of each light's diffuse and specular
    /// cosine, if terms are added without a clamp.
    pub fn factors(&self, matter: &Matter<'_>) -> (DVec3, Vec<[DVec3; 2]>) {
        let mut rays = alloc::vec![Ray::default(); self.lights.len()];
        let ambient = self.colour(matter, &rays);
        let mut of_lights = Vec::with_capacity(rays.len());
        for i in 0..rays.len() {
            rays[i].diffuse = 1.0;
            let diffuse = self.colour(matter, &rays) - ambient;
            rays[i] = Ray {
                highlight: 1.0,
                ..Ray::default()
            };
            let specular = self.colour(matter, &rays) - ambient;
            rays[i] = Ray::default();
            of_lights.push([diffuse, specular]);
        }
        (ambient, of_lights)
    }

    fn ambient(&self, material: &Material, rays: &[Ray]) -> DVec3 {
        let (ka, kd) = (wide(material.ambient), wide(material.diffuse));
        match self.switches.ambient {
            AmbientUse::WithoutMaterial => self.ambient,
            AmbientUse::TimesDiffuse => self.ambient * ka * kd,
            AmbientUse::DiffuseColour => self.ambient * kd,
            AmbientUse::WithFalloff => {
                self.ambient * ka * rays.iter().map(|ray| ray.strength).sum::<f64>()
            }
            _ => self.ambient * ka,
        }
    }
}
