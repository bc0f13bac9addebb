//! Amounts: a picture in linear light is a sum of ambient, diffuse and specular light. Least
//! squares tell how much of each it contains.

use super::drawer::Drawer;
use super::recipe::{Curve, Recipe, Rounding};
use super::residual::Target;
use alloc::vec::Vec;
use fastphong::picture::Encoding;
use glam::{DMat3, DVec3};

/// The factors of the exponent to try.
const EXPONENTS: [f64; 11] = [1.0, 0.25, 0.5, 0.67, 0.8, 1.25, 1.5, 2.0, 3.0, 4.0, 8.0];

/// From this share of the range on, channels may have been clamped.
const BRIGHT: f64 = 0.99;

/// The fewest channels to decide from.
const FEWEST: usize = 90;

/// The factors of the light terms that come closest to a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Amounts {
    /// The factor of ambient light; 1 if the scene has none.
    pub ambient: f64,
    /// The factor of diffuse light.
    pub diffuse: f64,
    /// The factor of highlights.
    pub specular: f64,
    /// The factor of exponents.
    pub exponent: f64,
    /// The mean difference that is left, in levels.
    pub residual: f64,
    /// The mean of the differences beyond one level.
    pub beyond: f64,
}

impl Amounts {
    /// Finds the amounts of a picture that is right in all else. Returns `None` if too few pixels
    /// can tell.
    pub fn find(
        drawer: &mut Drawer<'_>,
        base: &Recipe,
        target: &Target,
        encoding: Encoding,
    ) -> Option<Amounts> {
        if base.storage.rounding != Rounding::Nearest || base.storage.curve != Curve::Stated {
            return None;
        }
        let hits = drawer.hits(base.geometry, base.place)?;
        let mut best: Option<Amounts> = None;
        for exponent in EXPONENTS {
            let terms = drawer.terms(base, exponent)?;
            let rows: Vec<([f64; 3], f64)> = (0..terms.len())
                .filter(|&i| hits.is_covered(i) && !hits.edges[i])
                .flat_map(|i| {
                    let [a, d, s] = terms[i];
                    (0..3).map(move |c| ([a[c], d[c], s[c]], f64::from(target.levels[i][c])))
                })
                .map(|(terms, level)| (terms, encoding.decode(level / 255.0)))
                .filter(|(_, light)| *light < BRIGHT)
                .collect();
            if rows.len() < FEWEST {
                return best;
            }
            let [ambient, diffuse, specular] = least_squares(&rows);
            let left = |(terms, light): &([f64; 3], f64)| {
                let sum = ambient * terms[0] + diffuse * terms[1] + specular * terms[2];
                let level = |c: f64| libm::rint(255.0 * encoding.encode(c.clamp(0.0, 1.0)));
                (level(sum) - level(*light)).abs().min(48.0)
            };
            let mean = |of: &dyn Fn(f64) -> f64| {
                rows.iter().map(|row| of(left(row))).sum::<f64>() / rows.len() as f64
            };
            let residual = mean(&|left| left);
            let beyond = mean(&|left| (left - 1.0).max(0.0));
            // Another exponent must be clearly better.
            if best.is_none_or(|best| residual < 0.9 * best.residual) {
                best = Some(Amounts {
                    ambient,
                    diffuse,
                    specular,
                    exponent,
                    residual,
                    beyond,
                });
            }
        }
        best
    }

    /// True if no factor is negative, and some are wrong.
    pub fn is_possible(&self) -> bool {
        let least = self.ambient.min(self.diffuse).min(self.specular);
        least > -0.03 && !self.wrong().is_empty()
    }

    /// Returns the names and factors of the amounts that are wrong by more than 3 %.
    pub fn wrong(&self) -> Vec<(&'static str, f64)> {
        let all = [
            ("ambient", self.ambient),
            ("diffuse", self.diffuse),
            ("specular", self.specular),
            ("exponent", self.exponent),
        ];
        let is_wrong = |(_, factor): &(&str, f64)| (factor - 1.0).abs() > 0.03;
        all.into_iter().filter(is_wrong).collect()
    }
}

/// Solves the normal equations for three factors. A term that is 0 everywhere has the factor 1.
fn least_squares(rows: &[([f64; 3], f64)]) -> [f64; 3] {
    let mut matrix = DMat3::ZERO;
    let mut right = DVec3::ZERO;
    for (terms, light) in rows {
        let terms = DVec3::from_array(*terms);
        matrix += DMat3::from_cols(terms * terms.x, terms * terms.y, terms * terms.z);
        right += terms * *light;
    }
    // A faint pull toward 1 keeps the matrix regular: a term that is missing, or that depends on
    // the others, keeps its factor.
    let pull = 1e-9 * (matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z).max(1e-12);
    matrix += DMat3::from_diagonal(DVec3::splat(pull));
    right += DVec3::splat(pull);
    (matrix.inverse() * right).to_array()
}

/// A tone curve: the levels of the picture are a function of the reference's levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tone {
    /// The exponent of this function on 0..=1. 0.45 brightens like 1/2.2.
    pub gamma: f64,
    /// The mean distance of levels from their median, among pixels with the same level of the
    /// reference.
    pub scatter: f64,
}

impl Tone {
    /// Finds the tone curve from pairs of levels: the reference's and the picture's. It sorts the
    /// pairs.
    pub fn find(pairs: &mut [(f32, f32)]) -> Option<Tone> {
        // Levels of the reference are grouped in steps of 4.
        const STEP: f32 = 4.0;
        let step = |level: f32| (level / STEP) as i32;
        pairs.sort_by(|a, b| step(a.0).cmp(&step(b.0)).then(a.1.total_cmp(&b.1)));
        let mut scatter = 0.0;
        for same in pairs.chunk_by(|a, b| step(a.0) == step(b.0)) {
            let median = same[same.len() / 2].1;
            let off = same.iter().map(|(_, t)| f64::from((t - median).abs()));
            scatter += off.sum::<f64>();
        }
        scatter /= pairs.len().max(1) as f64;
        let middle = |level: f32| (4.0..=250.0).contains(&level);
        let inner = pairs.iter().filter(|(r, t)| middle(*r) && middle(*t));
        let log = |level: f32| libm::log(f64::from(level) / 255.0);
        let mut gammas: Vec<f64> = inner.map(|(r, t)| log(*t) / log(*r)).collect();
        gammas.sort_by(f64::total_cmp);
        let gamma = *gammas.get(gammas.len() / 2)?;
        (gammas.len() >= FEWEST).then_some(Tone { gamma, scatter })
    }
}
