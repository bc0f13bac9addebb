//! Numbers that explain a picture: fitted lights, exponents, fog and factors of light, in words
//! that help to find them in a program.

use super::amounts::Factors;
use super::drawer::Fitted;
use super::mistakes::Mistake;
use super::residual::Residual;
use super::stage::Stage;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use fastphong::mesh::Material;
use fastphong::scene::{Place, Scene};
use glam::DVec3;

/// A fit that explains the picture.
pub struct Explained {
    pub mistakes: Vec<Mistake>,
    pub fitted: Fitted,
    pub factors: Vec<Factors>,
    pub left: Residual,
}

/// Numbers that explain a picture, together with mistakes.
pub struct Numbers {
    /// The mistakes besides.
    pub mistakes: Vec<Mistake>,
    /// The lights that are elsewhere than in the scene.
    pub lights: Vec<FittedLight>,
    /// The factor of exponents.
    pub exponent: f64,
    /// The fog, if there is any.
    pub fog: Option<Fog>,
    /// The factors of light that are not 1.
    pub amounts: Vec<Amount>,
    /// The difference that is left, in levels.
    pub residual: f64,
}

/// A light that is elsewhere than in the scene.
pub struct FittedLight {
    /// Its index among the scene's lights.
    pub index: usize,
    /// True if it has a position, false for a direction.
    pub is_local: bool,
    /// The direction or position in the scene.
    pub stated: DVec3,
    /// The unit direction, or the position, in the picture.
    pub fitted: DVec3,
    /// How far it is off: degrees for a direction, units of the scene for a position.
    pub off: f64,
    /// A change of the scene's own numbers that leads to it: `x and y are exchanged`.
    pub name: Option<String>,
}

/// Fog, through which e^(−density · distance) of the light passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fog {
    /// The density, in 1 / units of the scene.
    pub density: f64,
    /// The share of light that it takes away at the distance of the target.
    pub share: f64,
    /// Its linear colour.
    pub colour: [f64; 3],
}

/// A factor of a term of the illumination model.
#[derive(Clone, Debug, PartialEq)]
pub struct Amount {
    /// `ambient`, `diffuse` or `specular`.
    pub term: &'static str,
    /// The light, if only this one has the factor.
    pub light: Option<usize>,
    /// The material, if only this one has the factor.
    pub material: Option<u32>,
    /// 0 for red, 1 for green, 2 for blue, if only this channel has the factor.
    pub channel: Option<usize>,
    /// The factor. If the scene has nothing of this term, it is the light itself.
    pub factor: f64,
    /// True if the scene has nothing of this term.
    pub is_added: bool,
    /// True if the term is also multiplied by the material's diffuse colour.
    pub has_diffuse_hue: bool,
}

/// Factors that differ by less than this share are equal.
const EQUAL: f64 = 0.03;

/// More numbers than this explain any picture, and tell nothing.
const MOST_NUMBERS: usize = 4;

/// Nobody multiplies light by less than this, but leaves it out.
const LEAST_FACTOR: f64 = 0.02;

/// The least share of light that fog takes away at the distance of the target.
const LEAST_FOG: f64 = 0.05;

/// A term that changes a picture by less than this, in levels, tells nothing.
const FAINT: f64 = 0.6;

impl Numbers {
    /// Describes a fit to a scene.
    pub(super) fn new(explained: Explained, stage: &Stage<'_>) -> Numbers {
        let (scene, lengths) = (stage.scene, stage.light_lengths);
        let fitted = &explained.fitted;
        let lights = scene.lights.iter().zip(&fitted.lights).enumerate();
        let lights = lights.filter_map(|(index, (light, fitted))| {
            let length = lengths.get(index).copied().unwrap_or(1.0);
            FittedLight::new(index, light.place, *fitted, length)
        });
        let distance = (scene.camera.target - scene.camera.eye).length();
        let fog = fitted.fog.map(|density| Fog {
            density,
            share: 1.0 - libm::exp(-density * distance),
            colour: fog_colour(&explained.factors),
        });
        Numbers {
            lights: lights.collect(),
            exponent: fitted.exponent,
            fog,
            amounts: amounts(&explained.factors, scene, stage.prepared.materials()),
            residual: explained.left.levels,
            mistakes: explained.mistakes,
        }
    }

    /// True if there are numbers, and few.
    pub(super) fn are_telling(&self) -> bool {
        let others = [self.has_other_exponent(), self.fog.is_some()];
        let others = others.into_iter().filter(|is| *is).count();
        let is_factor = |amount: &Amount| amount.factor == 0.0 || amount.factor >= LEAST_FACTOR;
        (1..=MOST_NUMBERS).contains(&(self.lights.len() + self.amounts.len() + others))
            && self.amounts.iter().all(is_factor)
            && self.fog.is_none_or(|fog| fog.share >= LEAST_FOG)
    }

    /// True if exponents differ from the scene's.
    pub fn has_other_exponent(&self) -> bool {
        (self.exponent - 1.0).abs() > EQUAL
    }
}

/// Returns the mean colour of fog over all materials.
fn fog_colour(factors: &[Factors]) -> [f64; 3] {
    [0, 1, 2].map(|channel| {
        let own = factors.iter().filter(|factors| factors.channel == channel);
        let (sum, count) = own.fold((0.0, 0), |(sum, count), own| {
            (
                sum + own.fog.unwrap_or(0.0) * own.pixels as f64,
                count + own.pixels,
            )
        });
        sum / count.max(1) as f64
    })
}

impl FittedLight {
    /// Describes a light, or returns `None` if it is where the scene has it.
    fn new(
        index: usize,
        stated: Place<DVec3>,
        fitted: Place<DVec3>,
        length: f64,
    ) -> Option<FittedLight> {
        let (stated, fitted, is_local) = match (stated, fitted) {
            (Place::Infinite(stated), Place::Infinite(fitted)) => (stated * length, fitted, false),
            (Place::Local(stated), Place::Local(fitted)) => (stated, fitted, true),
            _ => return None,
        };
        let apart = |place: DVec3| {
            if is_local {
                (place - fitted).length()
            } else {
                place.angle_between(fitted).to_degrees()
            }
        };
        let off = apart(stated);
        // What an exact fit is off by: the picture's levels are rounded.
        let least = if is_local {
            0.01 * stated.length()
        } else {
            0.3
        };
        if off < least {
            return None;
        }
        let near = (1.5 * least).min(0.5 * off);
        let name = changes(stated)
            .into_iter()
            .find(|(place, _)| apart(*place) < near)
            .map(|(_, name)| name);
        Some(FittedLight {
            index,
            is_local,
            stated,
            fitted,
            off,
            name,
        })
    }
}

/// Returns a light's numbers exchanged, negated, and with one of them changed, each with its name.
fn changes(stated: DVec3) -> Vec<(DVec3, String)> {
    let axes = ["x", "y", "z"];
    let mut found = Vec::new();
    for k in 0..3 {
        let mut negated = stated;
        negated[k] = -negated[k];
        found.push((negated, format!("{} is negated", axes[k])));
    }
    for [a, b] in [[0, 1], [0, 2], [1, 2]] {
        let mut exchanged = stated;
        (exchanged[a], exchanged[b]) = (stated[b], stated[a]);
        found.push((
            exchanged,
            format!("{} and {} are exchanged", axes[a], axes[b]),
        ));
    }
    found.push((
        DVec3::new(stated.y, stated.z, stated.x),
        "x, y, z are y, z, x".into(),
    ));
    found.push((
        DVec3::new(stated.z, stated.x, stated.y),
        "x, y, z are z, x, y".into(),
    ));
    for k in 0..3 {
        for tenths in -30..=30 {
            let mut changed = stated;
            changed[k] = f64::from(tenths) / 10.0;
            let own = stated[k];
            let name = format!("{} is {}, not {own:.3}", axes[k], changed[k]);
            found.push((changed, name));
        }
    }
    found
}

/// A factor that was fitted, and how much it says.
struct Ratio {
    light: Option<usize>,
    material: u32,
    channel: usize,
    /// The fitted factor and the scene's.
    own: f64,
    stated: f64,
    /// The weight of the term in the picture.
    weight: f64,
    /// The material's diffuse colour.
    hue: f64,
}

/// Returns the factors that differ from the scene's, summed up as far as they agree.
fn amounts(factors: &[Factors], scene: &Scene, materials: &[Material]) -> Vec<Amount> {
    // Fog is nearly as even as ambient light, so its factor would be noise.
    let has_fog = factors.iter().any(|own| own.fog.is_some());
    let terms = ["ambient", "diffuse", "specular"];
    let terms = &terms[usize::from(has_fog)..];
    let mut found = Vec::new();
    for &term in terms {
        let mut ratios: Vec<Ratio> = Vec::new();
        for own in factors {
            let Some(material) = materials.get(own.material as usize) else {
                continue;
            };
            let c = own.channel;
            let hue = f64::from(material.diffuse[c]);
            let mut add = |light: Option<usize>, fitted: f64, stated: f32, mean: f64| {
                let stated = f64::from(stated);
                ratios.push(Ratio {
                    light,
                    material: own.material,
                    channel: c,
                    own: fitted,
                    stated,
                    weight: 255.0 * mean * own.pixels as f64,
                    hue,
                });
            };
            if term == "ambient" {
                add(
                    None,
                    own.ambient,
                    scene.ambient[c] * material.ambient[c],
                    own.means[0],
                );
                continue;
            }
            for (light, stated) in scene.lights.iter().enumerate() {
                let (list, coefficient, at) = match term {
                    "diffuse" => (&own.diffuse, material.diffuse[c], 1 + 2 * light),
                    _ => (&own.specular, material.specular[c], 2 + 2 * light),
                };
                if let (Some(fitted), Some(mean)) = (list.get(light), own.means.get(at)) {
                    add(Some(light), *fitted, stated.colour[c] * coefficient, *mean);
                }
            }
        }
        let pixels: usize = factors.iter().map(|own| own.pixels).sum();
        let faint = FAINT * pixels as f64 / factors.len().max(1) as f64;
        // A term that hardly shows has no factor that can be told.
        ratios.retain(|ratio| ratio.weight * ratio.own.max(ratio.stated) > faint);
        found.extend(summed(term, &ratios));
    }
    found
}

/// A function that returns the same for all factors of a group.
type Key<'a> = &'a dyn Fn(&Ratio) -> [usize; 3];

/// Sums up the factors of a term: one for all, or one for each light, material or channel.
fn summed(term: &'static str, ratios: &[Ratio]) -> Vec<Amount> {
    let amount = |factor: f64| Amount {
        term,
        light: None,
        material: None,
        channel: None,
        factor,
        is_added: false,
        has_diffuse_hue: false,
    };
    let of_one = |ratio: &Ratio| ratio.own / ratio.stated;
    let of_hue = |ratio: &Ratio| ratio.own / (ratio.stated * ratio.hue);
    let all: Vec<&Ratio> = ratios.iter().collect();
    if all.iter().all(|ratio| ratio.stated == 0.0) {
        let added = equal(&all, &|ratio| ratio.own).filter(|own| *own > 0.0);
        return added
            .map(|own| Amount {
                is_added: true,
                ..amount(own)
            })
            .into_iter()
            .collect();
    }
    if let Some(factor) = equal(&all, &of_one) {
        let is_wrong = (factor - 1.0).abs() > EQUAL;
        return is_wrong.then(|| amount(factor)).into_iter().collect();
    }
    if term != "diffuse"
        && let Some(factor) = equal(&all, &of_hue)
    {
        return Vec::from([Amount {
            has_diffuse_hue: true,
            ..amount(factor)
        }]);
    }
    let groups: [Key<'_>; 4] = [
        &|ratio| [ratio.light.unwrap_or(0), 0, 0],
        &|ratio| [0, ratio.material as usize, 0],
        &|ratio| [0, 0, ratio.channel],
        &|ratio| {
            [
                ratio.light.unwrap_or(0),
                ratio.material as usize,
                ratio.channel,
            ]
        },
    ];
    for (kind, key) in groups.iter().enumerate() {
        let mut keys: Vec<[usize; 3]> = all.iter().map(|ratio| key(ratio)).collect();
        keys.sort_unstable();
        keys.dedup();
        let factors: Option<Vec<(&Ratio, f64)>> = keys
            .iter()
            .map(|own| {
                let group: Vec<&Ratio> = all
                    .iter()
                    .copied()
                    .filter(|ratio| key(ratio) == *own)
                    .collect();
                equal(&group, &of_one).map(|factor| (group[0], factor))
            })
            .collect();
        let Some(factors) = factors else { continue };
        let has = |kinds: &[usize]| kinds.contains(&kind);
        return factors
            .into_iter()
            .filter(|(_, factor)| (factor - 1.0).abs() > EQUAL)
            .map(|(ratio, factor)| Amount {
                light: ratio.light.filter(|_| has(&[0, 3])),
                material: has(&[1, 3]).then_some(ratio.material),
                channel: has(&[2, 3]).then_some(ratio.channel),
                ..amount(factor)
            })
            .collect();
    }
    Vec::new()
}

/// Returns the mean of some values, if they agree as well as the picture's levels can tell.
fn equal(ratios: &[&Ratio], value: &dyn Fn(&Ratio) -> f64) -> Option<f64> {
    let known: Vec<(f64, f64)> = ratios
        .iter()
        .map(|ratio| (value(ratio), ratio.weight * ratio.stated.max(ratio.own)))
        .filter(|(value, _)| value.is_finite())
        .collect();
    let weight: f64 = known.iter().map(|(_, weight)| weight).sum();
    let mean = known
        .iter()
        .map(|(value, weight)| value * weight)
        .sum::<f64>()
        / weight;
    let is_near = |(value, _): &(f64, f64)| (value - mean).abs() <= EQUAL * mean.abs().max(0.1);
    (!known.is_empty() && known.iter().all(is_near)).then_some(mean)
}
