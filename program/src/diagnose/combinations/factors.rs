//! Amounts of light, found by their factors: several mistakes at once, though each alone leaves
//! much.

use super::beam::Beam;
use super::{Combinations, ENOUGH, Kind, Measure, Set, WIDTH, shape_of};
use crate::diagnose::amounts::Amounts;
use crate::diagnose::levels::Levels;
use crate::diagnose::mixing::{Matter, Mixer};
use crate::diagnose::recipe::{LevelRange, MaterialUse, Recipe};
use crate::diagnose::stage::Stage;
use alloc::vec;
use alloc::vec::Vec;
use fastphong::mesh::Material;

/// Two shapes whose light differs by less than this with free amounts, in levels, are one.
const SAME_SHAPE: f64 = 0.02;

/// How many sets of each length with different light are kept, and how many with the same.
const VALUES: usize = 8;
const TWINS: usize = 6;

/// For how many shapes amounts are looked for by their factors, and how many sets are kept
/// meanwhile.
const SHAPES_WITH_FACTORS: usize = 24;
const FIRST_BY_FACTORS: usize = 24;

/// What a mistake must take away from the distance of factors, in levels.
const FACTOR_PRICE: f64 = 0.1;

impl Combinations<'_, '_> {
    /// Returns the mistakes that free amounts cannot show: those in amounts, colours and rounding,
    /// and others that change no more than a factor of the best set's light.
    pub(super) fn amounts(&mut self) -> Vec<usize> {
        let mut names = self.names(&[Kind::Curve, Kind::Amount]);
        let Some((best, left)) = self.shapes.first().cloned() else {
            return names;
        };
        let exact = self.left(&best);
        for m in self.names(&[Kind::Shape]) {
            let mut with = [&best[..], &[m]].concat();
            with.sort_unstable();
            if best.contains(&m) {
                continue;
            }
            let is_factor = self
                .measured(&with, Measure::FreeAmounts)
                .is_some_and(|with| (with - left).abs() <= SAME_SHAPE);
            if is_factor && (self.left(&with) - exact).abs() > 1e-6 {
                names.push(m);
            }
        }
        names
    }

    /// Adds mistakes in amounts, colours and rounding to the best sets.
    pub(super) fn sets(&mut self, roots: &[Set]) -> Vec<(Set, f64)> {
        let names = self.amounts();
        let start = self.best_shapes(roots);
        self.beam(&Beam {
            start: &start,
            starts: start.len(),
            names: &names,
            tuples: &[],
            by: Measure::Levels,
            depth: 3,
            price: 0.002,
            enough: ENOUGH,
        })
    }

    /// Returns the sets from which amounts are looked for: the best with free amounts, one of each
    /// value, and the best cameras.
    pub(super) fn best_shapes(&mut self, roots: &[Set]) -> Vec<Set> {
        let best = self.shapes.first().map_or(0.0, |(_, left)| *left);
        let mut sets: Vec<Set> = Vec::new();
        // Twins have the same light with free amounts. Their amounts tell them apart.
        let mut twins: Vec<(f64, usize, usize)> = Vec::new();
        for (set, left) in &self.shapes {
            if *left > 1.3 * best + 0.15 {
                continue;
            }
            // Many long sets come near anything.
            let as_long = twins.iter().filter(|twin| twin.2 == set.len());
            let is_full = as_long.count() == VALUES;
            let known = twins
                .iter_mut()
                .find(|(value, ..)| (*value - left).abs() <= 1e-5);
            match known {
                Some((_, count, shortest)) if *count < TWINS && set.len() == *shortest => {
                    *count += 1;
                }
                None if !is_full => twins.push((*left, 1, set.len())),
                _ => continue,
            }
            sets.push(set.clone());
        }
        let mut others: Vec<Set> = roots.iter().take(3).chain(self.singles).cloned().collect();
        // Single mistakes, and the best camera with them.
        for single in self.singles {
            let mut set = [&single[..], roots.first().map_or(&[][..], Vec::as_slice)].concat();
            set.sort_unstable();
            set.dedup();
            others.push(set);
        }
        for set in others {
            if !sets.contains(&set) && self.recipe(&set).is_some() {
                sets.push(set);
            }
        }
        let shapes: Vec<Set> = sets.iter().take(SHAPES_WITH_FACTORS).cloned().collect();
        let mut found: Vec<(Set, f64)> = Vec::new();
        for shape in &shapes {
            found.extend(self.by_factors(shape));
        }
        found.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        for (set, _) in found.into_iter().take(2 * WIDTH) {
            if !sets.contains(&set) {
                sets.push(set);
            }
        }
        sets
    }

    /// Returns the sets of mistakes in amounts whose factors are those that were fitted, with the
    /// distance of factors, the best first, together with the mistakes of `shape`. Several mistakes
    /// are found at once, though each alone leaves much.
    pub(super) fn by_factors(&mut self, shape: &Set) -> Vec<(Set, f64)> {
        let Some(recipe) = self.recipe(shape) else {
            return Vec::new();
        };
        let Some((fit, _)) = self.fit(&shape_of(&recipe), None) else {
            return Vec::new();
        };
        let mut found: Vec<(Set, f64)> = Vec::new();
        let own = distance(&fit, self.stage, &recipe);
        found.push((shape.clone(), own));
        // One choice after another, each with all choices before it.
        let mut choices: Vec<Vec<usize>> = Vec::new();
        for m in self.names(&[Kind::Amount]) {
            let excludes = |choice: &Vec<usize>| {
                let mut both = vec![choice[0], m];
                both.sort_unstable();
                self.recipe(&both).is_none()
            };
            match choices.iter().position(excludes) {
                Some(k) => choices[k].push(m),
                None => choices.push(vec![m]),
            }
        }
        for choice in &choices {
            let mut longer = Vec::new();
            for (set, _) in &found {
                for m in choice {
                    let mut with = [&set[..], &[*m]].concat();
                    with.sort_unstable();
                    let Some(recipe) = self.recipe(&with) else {
                        continue;
                    };
                    if recipe.mixing.sum != self.base.mixing.sum {
                        continue;
                    }
                    longer.push((with, distance(&fit, self.stage, &recipe)));
                }
            }
            found.extend(longer);
            // Factors that were fitted to rounded levels are not exact.
            let price = |(set, left): &(Set, f64)| left + FACTOR_PRICE * set.len() as f64;
            found.sort_by(|a, b| price(a).total_cmp(&price(b)).then(a.0.cmp(&b.0)));
            found.truncate(FIRST_BY_FACTORS);
        }
        found.truncate(WIDTH / 2);
        for (set, left) in &mut found {
            *left += FACTOR_PRICE * set.len() as f64;
        }
        found
    }
}

/// Returns how far the factors of a recipe are from the fitted ones, in levels.
fn distance(amounts: &Amounts, stage: &Stage<'_>, recipe: &Recipe) -> f64 {
    let mixer = Mixer::new(stage.scene, recipe.mixing);
    let order = Levels::exchanged_of(recipe.storage, [0, 1, 2]);
    let (mut sum, mut pixels) = (0.0, 0);
    let mut scale = Scale::default();
    let is_stretched = recipe.storage.range == LevelRange::Stretched;
    for is_first in [true, false] {
        if is_first && !is_stretched {
            continue;
        }
        for of_channels in amounts.factors.chunks(3) {
            let first = &of_channels[0];
            let default = Material::default();
            let own = match recipe.shading.materials {
                MaterialUse::Own => first.material,
                MaterialUse::First => 0,
                MaterialUse::Default => u32::MAX,
            };
            let materials = stage.prepared.materials();
            let matter = Matter {
                material: materials.get(own as usize).unwrap_or(&default),
                exponent: first.exponent,
                colour: None,
            };
            let (ambient, lights) = mixer.factors(&matter);
            for fitted in of_channels {
                let c = order[fitted.channel];
                let mut terms = vec![(ambient[c], fitted.ambient, fitted.means[0])];
                for (k, (d, s)) in fitted.diffuse.iter().zip(&fitted.specular).enumerate() {
                    let Some([diffuse, specular]) = lights.get(k) else {
                        continue;
                    };
                    terms.push((diffuse[c], *d, fitted.means[1 + 2 * k]));
                    terms.push((specular[c], *s, fitted.means[2 + 2 * k]));
                }
                for (own, fitted_to, mean) in terms {
                    if is_first {
                        scale.add(own * mean, fitted_to * mean);
                        continue;
                    }
                    let off = (own * scale.factor() - fitted_to).abs() * mean;
                    sum += 255.0 * off * fitted.pixels as f64;
                }
                pixels += if is_first { 0 } else { fitted.pixels };
            }
        }
    }
    sum / pixels.max(1) as f64
}

/// The factor by which one list of numbers is larger than another, 1 before there are any.
#[derive(Default)]
struct Scale {
    both: f64,
    own: f64,
}

impl Scale {
    fn add(&mut self, own: f64, other: f64) {
        self.both += own * other;
        self.own += own * own;
    }

    fn factor(&self) -> f64 {
        if self.own > 0.0 {
            self.both / self.own
        } else {
            1.0
        }
    }
}
