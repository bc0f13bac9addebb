//! Amounts: with free factors of ambient, diffuse and specular light, a picture tells the shape of
//! its light whatever is wrong with the amounts.
//!
//! A picture in linear light is a sum of cosines. Each cosine has a factor, the product of a
//! material's coefficient and a light's colour. Least squares find the factors of each material and
//! channel. So mistakes in directions, normals and exponents can be told one by one though others
//! concern coefficients, colours or rounding.

use super::hits::Hits;
use super::levels::Levels;
use super::lit::{Lit, Terms};
use super::recipe::{Channels, LevelRange, Storage};
use super::residual::Target;
use alloc::vec;
use alloc::vec::Vec;
use fastphong::picture::Encoding;
use glam::DVec3;

/// From this level on, a channel may have been clamped.
const BRIGHT: f32 = 253.5;

/// The fewest pixels from which factors are found.
const FEWEST: usize = 12;

/// The most lights with factors of their own. Those beyond share the factors of the last one.
const MOST_LIGHTS: usize = 8;

/// Pixels that are off by this many times the median count less.
const OUTLIER: f64 = 3.0;

/// How often negative factors are set to 0 and the others solved again.
const ROUNDS: usize = 4;

/// The factors of one material in one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Factors {
    /// The material of the scene.
    pub material: u32,
    /// 0 for red, 1 for green, 2 for blue.
    pub channel: usize,
    /// The ambient light.
    pub ambient: f64,
    /// The product of diffuse coefficient and light colour, for each light.
    pub diffuse: Vec<f64>,
    /// The product of specular coefficient and light colour, for each light.
    pub specular: Vec<f64>,
    /// The light of fog, if there is any.
    pub fog: Option<f64>,
    /// The mean of each term over the material's pixels: of ambient light, and of the diffuse and
    /// the specular cosine of each light.
    pub means: Vec<f64>,
    /// The exponent of the material's highlights.
    pub exponent: f64,
    /// How many pixels the material has.
    pub pixels: usize,
}

/// A picture with fitted amounts.
pub struct Amounts {
    pub factors: Vec<Factors>,
    /// The levels at each pixel. Pixels of materials that are hardly visible have the picture's own
    /// levels.
    pub levels: Vec<[f32; 3]>,
}

impl Amounts {
    /// Fits the amounts of `lit` points to a picture that was stored in the way of `storage`. Where
    /// fog is searched for, `clearness` is the share of light at each pixel that passes it.
    pub fn new(
        lit: &Lit,
        hits: &Hits,
        target: &Target,
        storage: Storage,
        encoding: Encoding,
        background: [f32; 3],
        clearness: Option<&[f64]>,
    ) -> Amounts {
        // Factors follow any order of channels.
        let levels = Levels::new(
            Storage {
                channels: Channels::Rgb,
                range: match storage.range {
                    LevelRange::ToneMapped => LevelRange::ToneMapped,
                    _ => LevelRange::Clamped,
                },
                ..storage
            },
            encoding,
        );
        let groups = Group::all(lit, hits, clearness);
        let mut fit = Amounts {
            factors: Vec::new(),
            levels: (0..hits.len())
                .map(|i| {
                    if hits.is_covered(i) {
                        target.levels[i]
                    } else {
                        background
                    }
                })
                .collect(),
        };
        for group in &groups {
            let found = [0, 1, 2].map(|channel| group.solve(channel, hits, target, &levels));
            if found.iter().any(Option::is_none) {
                continue;
            }
            let factors = found.map(Option::unwrap_or_default);
            for (place, &i) in group.pixels.iter().enumerate() {
                let colour = [0, 1, 2].map(|c| group.sum(place, c, &factors[c]));
                fit.levels[i] = levels.of(DVec3::from_array(colour));
            }
            let all = factors.iter().enumerate();
            fit.factors.extend(all.map(|(channel, factors)| {
                let of_lights = &factors[1..factors.len() - usize::from(group.has_fog)];
                Factors {
                    material: group.material,
                    channel,
                    ambient: factors[0],
                    diffuse: of_lights.iter().step_by(2).copied().collect(),
                    specular: of_lights.iter().skip(1).step_by(2).copied().collect(),
                    fog: group.has_fog.then(|| factors[group.width - 1]),
                    means: group.means(),
                    exponent: group.exponent,
                    pixels: group.pixels.len(),
                }
            }));
        }
        fit
    }
}

/// The pixels of one material.
struct Group {
    material: u32,
    pixels: Vec<usize>,
    /// The terms of each pixel: 1 for ambient light, then the diffuse and the specular cosine of
    /// each light.
    terms: Vec<f64>,
    width: usize,
    /// True if the last term is the light of fog.
    has_fog: bool,
    exponent: f64,
    /// The vertex colours, by which ambient and diffuse terms are multiplied, if any is not white.
    colours: Option<Vec<DVec3>>,
}

impl Group {
    fn all(lit: &Lit, hits: &Hits, clearness: Option<&[f64]>) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        lit.for_each_pixel(|i, terms| {
            let lights = terms.rays.len().min(MOST_LIGHTS);
            let known = groups
                .iter()
                .position(|group| group.material == terms.material);
            let place = known.unwrap_or_else(|| {
                groups.push(Group {
                    material: terms.material,
                    pixels: Vec::new(),
                    terms: Vec::new(),
                    width: 1 + 2 * lights + usize::from(clearness.is_some()),
                    has_fog: clearness.is_some(),
                    exponent: terms.exponent,
                    colours: None,
                });
                groups.len() - 1
            });
            let group = &mut groups[place];
            if hits.is_covered(i) {
                group.add(i, terms, clearness.map(|clearness| clearness[i]));
            }
        });
        groups
    }

    fn add(&mut self, i: usize, terms: &Terms<'_>, clearness: Option<f64>) {
        if terms.colour != DVec3::ONE && self.colours.is_none() {
            self.colours = Some(vec![DVec3::ONE; self.pixels.len()]);
        }
        if let Some(colours) = &mut self.colours {
            colours.push(terms.colour);
        }
        self.pixels.push(i);
        let first = self.terms.len();
        self.terms.resize(first + self.width, 0.0);
        let own = &mut self.terms[first..];
        own[0] = 1.0;
        for (light, ray) in terms.rays.iter().enumerate() {
            let light = light.min(MOST_LIGHTS - 1);
            own[1 + 2 * light] += ray.diffuse;
            own[2 + 2 * light] += ray.highlight;
        }
        if let Some(clearness) = clearness {
            own.iter_mut().for_each(|term| *term *= clearness);
            own[self.width - 1] = 1.0 - clearness;
        }
    }

    fn means(&self) -> Vec<f64> {
        let mut means = vec![0.0; self.width];
        for own in self.terms.chunks(self.width) {
            for (mean, term) in means.iter_mut().zip(own) {
                *mean += term.abs() / self.pixels.len() as f64;
            }
        }
        means
    }

    /// Returns the terms of the pixel at `place` in a channel.
    fn terms(&self, place: usize, channel: usize) -> impl Iterator<Item = f64> {
        let own = &self.terms[place * self.width..][..self.width];
        let colour = self
            .colours
            .as_ref()
            .map_or(1.0, |colours| colours[place][channel]);
        own.iter().enumerate().map(move |(k, term)| {
            let is_specular = k != 0 && k % 2 == 0;
            let is_fog = self.has_fog && k + 1 == self.width;
            if is_specular || is_fog {
                *term
            } else {
                *term * colour
            }
        })
    }

    fn sum(&self, place: usize, channel: usize, factors: &[f64]) -> f64 {
        let terms = self.terms(place, channel).zip(factors);
        terms.map(|(term, factor)| term * factor).sum()
    }

    /// Finds the factors that come closest to a channel of the picture. Negative ones are set to 0.
    /// Returns `None` if too few pixels can tell.
    fn solve(
        &self,
        channel: usize,
        hits: &Hits,
        target: &Target,
        levels: &Levels,
    ) -> Option<Vec<f64>> {
        let mut rows = Rows::default();
        for (place, &i) in self.pixels.iter().enumerate() {
            let level = target.levels[i][channel];
            if !hits.edges[i] && level < BRIGHT {
                // Differences of light are weighted so that they are differences of levels.
                let around = [-0.5, 0.0, 0.5]
                    .map(|by| levels.decoded((f64::from(level) + by).clamp(0.0, 255.0)));
                rows.places.push(place);
                rows.light.push(around[1]);
                rows.weights.push(1.0 / (around[2] - around[0]).max(1e-6));
            }
        }
        if rows.places.len() < FEWEST {
            return None;
        }
        let first = self.closest(channel, &rows);
        // A few pixels may be wrong in another way: cracks, shadows, levels that wrapped around.
        let mut off: Vec<f64> = (0..rows.places.len())
            .map(|k| {
                let own = self.sum(rows.places[k], channel, &first);
                (own - rows.light[k]).abs() * rows.weights[k]
            })
            .collect();
        let mut sorted = off.clone();
        sorted.sort_by(f64::total_cmp);
        let usual = sorted[sorted.len() / 2];
        let most = (OUTLIER * usual).max(1.0);
        if sorted[sorted.len() - 1] <= most {
            return Some(first);
        }
        for (weight, off) in rows.weights.iter_mut().zip(&mut off) {
            *weight *= (most / off.max(most)).min(1.0);
        }
        Some(self.closest(channel, &rows))
    }

    /// Solves the normal equations of some rows. Negative factors are set to 0.
    fn closest(&self, channel: usize, rows: &Rows) -> Vec<f64> {
        let width = self.width;
        let mut normal = vec![0.0; width * width];
        let mut right = vec![0.0; width];
        let mut row = vec![0.0; width];
        for ((&place, light), weight) in rows.places.iter().zip(&rows.light).zip(&rows.weights) {
            row.clear();
            row.extend(self.terms(place, channel).map(|term| term * weight));
            for j in 0..width {
                right[j] += row[j] * light * weight;
                for k in 0..=j {
                    normal[j * width + k] += row[j] * row[k];
                }
            }
        }
        let mut used: Vec<usize> = (0..width)
            .filter(|j| normal[j * width + j] > 1e-12 * normal[0])
            .collect();
        let mut factors = vec![0.0; width];
        for _ in 0..ROUNDS {
            factors.fill(0.0);
            for (&j, factor) in used.iter().zip(solved(&normal, &right, width, &used)) {
                factors[j] = factor;
            }
            let before = used.len();
            used.retain(|j| factors[*j] >= -1e-3);
            if used.len() == before {
                break;
            }
        }
        factors
    }
}

/// The pixels that factors are found from.
#[derive(Default)]
struct Rows {
    /// Their places in the group.
    places: Vec<usize>,
    /// The picture's linear light there.
    light: Vec<f64>,
    /// How many levels a change of the light by 1 makes.
    weights: Vec<f64>,
}

/// Solves the normal equations for the unknowns `used`, by Cholesky's decomposition.
fn solved(normal: &[f64], right: &[f64], width: usize, used: &[usize]) -> Vec<f64> {
    let n = used.len();
    let trace: f64 = used.iter().map(|j| normal[j * width + j]).sum();
    // Keeps the matrix regular where one term depends on others.
    let ridge = 1e-9 * trace + 1e-12;
    let mut l = vec![0.0; n * n];
    for j in 0..n {
        for k in 0..=j {
            let (a, b) = (used[j].max(used[k]), used[j].min(used[k]));
            let own = normal[a * width + b] + if j == k { ridge } else { 0.0 };
            let sum: f64 = (0..k).map(|m| l[j * n + m] * l[k * n + m]).sum();
            l[j * n + k] = if j == k {
                libm::sqrt((own - sum).max(1e-300))
            } else {
                (own - sum) / l[k * n + k]
            };
        }
    }
    let mut x: Vec<f64> = used.iter().map(|j| right[*j]).collect();
    for j in 0..n {
        let sum: f64 = (0..j).map(|m| l[j * n + m] * x[m]).sum();
        x[j] = (x[j] - sum) / l[j * n + j];
    }
    for j in (0..n).rev() {
        let sum: f64 = (j + 1..n).map(|m| l[m * n + j] * x[m]).sum();
        x[j] = (x[j] - sum) / l[j * n + j];
    }
    x
}
