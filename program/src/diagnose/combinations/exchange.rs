//! Mistakes of the best sets are added, left out and exchanged for others.

use super::kinds::is_of_a_space;
use super::{Combinations, ENOUGH, Kind, Measure, Set};
use crate::diagnose::mistakes::MISTAKES;
use crate::diagnose::residual::MOST;
use alloc::collections::BTreeSet;
use alloc::vec::Vec;

/// What a further mistake must take away, in levels, so that it is named.
const WORTH_NAMING: f64 = 0.003;

/// After so many recipes no more mistakes are exchanged: nothing explains such a picture.
const MOST_DRAWN: usize = 9000;

/// How many sets are improved besides single mistakes.
const FIRSTS: usize = 3;

/// How many other cameras are tried with the best sets.
const CAMERAS_EXCHANGED: usize = 24;

impl Combinations<'_, '_> {
    /// Adds, leaves out and exchanges mistakes of the best sets as long as that comes closer to the
    /// picture. Returns the results and the other sets, the best first.
    pub(super) fn improved(&mut self, sets: &[(Set, f64)]) -> Vec<Set> {
        let pool = self.names(&[Kind::Shape, Kind::Curve, Kind::Amount]);
        let price = |set: &Set, left: f64| left + WORTH_NAMING * set.len() as f64;
        let mut found: Vec<(Set, f64)> = Vec::new();
        let mut firsts = sets.to_vec();
        firsts.dedup_by(|a, b| (a.1 - b.1).abs() < 1e-6);
        firsts.truncate(FIRSTS);
        // Where much is clamped, free amounts tell nothing.
        for single in self.singles {
            let left = self.left(single);
            if !firsts.iter().any(|(set, _)| set == single) {
                firsts.push((single.clone(), left));
            }
        }
        for (set, left) in &firsts {
            let (mut set, mut left) = (set.clone(), *left);
            for round in 0..4 {
                if left < ENOUGH || self.by_levels.len() > MOST_DRAWN {
                    break;
                }
                let mut others = BTreeSet::new();
                if round == 0 {
                    let rest: Set = (set.iter().copied())
                        .filter(|m| !self.is_camera(*m))
                        .collect();
                    for (camera, _) in self.cameras.iter().take(CAMERAS_EXCHANGED) {
                        let mut other = [&rest[..], camera].concat();
                        other.sort_unstable();
                        other.dedup();
                        others.insert(other);
                    }
                    others.remove(&set);
                }
                let mut offer = |mut other: Set| {
                    other.sort_unstable();
                    others.insert(other);
                };
                for &m in pool.iter().filter(|m| !set.contains(m)) {
                    offer([&set[..], &[m]].concat());
                }
                for own in &set {
                    let rest: Set = set.iter().copied().filter(|m| m != own).collect();
                    for &m in pool.iter().filter(|m| !set.contains(m)) {
                        if self.kind(m) == self.kind(*own) {
                            offer([&rest[..], &[m]].concat());
                        }
                    }
                    offer(rest);
                }
                let mut best: Option<(Set, f64)> = None;
                for other in others {
                    let Some(value) = self.measured(&other, Measure::Levels) else {
                        continue;
                    };
                    let is_best = best
                        .as_ref()
                        .is_none_or(|(set, left)| price(&other, value) < price(set, *left));
                    if is_best {
                        best = Some((other, value));
                    }
                }
                match best {
                    Some((other, value)) if price(&other, value) < price(&set, left) - 0.004 => {
                        (set, left) = (other, value);
                    }
                    _ => break,
                }
            }
            found.push((set, left));
            if left < ENOUGH {
                break;
            }
        }
        found.extend(sets.iter().take(40).cloned());
        let rounded = |set: &Set, left: f64| (price(set, left) * 1e3).round();
        found.sort_by(|a, b| {
            rounded(&a.0, a.1)
                .total_cmp(&rounded(&b.0, b.1))
                .then(a.0.cmp(&b.0))
        });
        found.dedup_by(|a, b| a.0 == b.0);
        let best = found.first().map_or(0.0, |(_, left)| *left);
        let longest = found.first().map_or(0, |(set, _)| set.len()) + 1;
        let near = found.iter().enumerate().filter(|(place, (set, left))| {
            set.len() <= longest && (*place < 6 || *left <= best + 0.004)
        });
        near.map(|(_, (set, _))| set.clone()).collect()
    }

    /// Leaves out mistakes that take nothing away.
    pub(super) fn pruned(&mut self, sets: Vec<Set>) -> Vec<Set> {
        let mut found: Vec<Set> = Vec::new();
        for mut set in sets {
            let mut left = self.with_any_cut(&set).unwrap_or(MOST);
            loop {
                let mut best: Option<(Set, f64)> = None;
                for k in 0..set.len() {
                    let mut rest = set.clone();
                    rest.remove(k);
                    if self.kind(set[k]) == Kind::Camera && self.changes_outline(&set, &rest) {
                        continue;
                    }
                    if let Some(value) = self.with_any_cut(&rest)
                        && best.as_ref().is_none_or(|(_, left)| value < *left)
                    {
                        best = Some((rest, value));
                    }
                }
                match best {
                    Some((rest, value)) if value <= left + ENOUGH.max(0.08 * left) => {
                        (set, left) = (rest, value.min(left));
                    }
                    _ => break,
                }
            }
            if !found.contains(&set) {
                found.push(set);
            }
        }
        found
    }

    /// Returns sets that draw the same picture as `set`: other cameras with the same outline, and
    /// single mistakes exchanged for others.
    pub fn alternatives(&mut self, set: &Set) -> Vec<Set> {
        let left = self.left(set);
        let near = 1.05 * left + 0.004;
        let mut found: Vec<Set> = Vec::new();
        let of_kind = |this: &Self, camera: bool| -> Set {
            let own = set.iter().copied();
            own.filter(|m| (this.kind(*m) == Kind::Camera) == camera)
                .collect()
        };
        let (camera, rest) = (of_kind(self, true), of_kind(self, false));
        let outline = self
            .cameras
            .iter()
            .find(|(own, _)| *own == camera)
            .map(|(_, e)| *e);
        let others: Vec<Set> = (self.cameras.iter().take(60))
            .filter(|(other, error)| {
                outline.is_some_and(|own| (own - error).abs() < 1e-9)
                    && other.len() <= camera.len()
                    && *other != camera
            })
            .map(|(other, _)| other.clone())
            .collect();
        let mut offered = others
            .into_iter()
            .map(|other| [&rest[..], &other[..]].concat())
            .collect::<Vec<_>>();
        let pool: Vec<usize> = (0..MISTAKES.len())
            .filter(|m| !matches!(self.kind(*m), Kind::Camera | Kind::None))
            .filter(|m| !self.unseen.contains(m))
            .collect();
        for own in &rest {
            let others: Set = set.iter().copied().filter(|m| m != own).collect();
            offered.extend(
                pool.iter()
                    .filter(|m| !set.contains(m))
                    .map(|m| [&others[..], &[*m]].concat()),
            );
        }
        // The same light in another space.
        let shapes: Vec<Set> = self
            .shapes
            .iter()
            .take(80)
            .map(|(set, _)| set.clone())
            .collect();
        let amounts: Set = rest
            .iter()
            .copied()
            .filter(|m| self.kind(*m) == Kind::Amount)
            .collect();
        offered.extend(
            shapes
                .into_iter()
                .map(|shape| [&shape[..], &amounts[..]].concat()),
        );
        offered.extend(self.other_spaces(set));
        for mut other in offered {
            other.sort_unstable();
            other.dedup();
            let is_new = other.len() <= set.len() && other != *set && !found.contains(&other);
            if is_new
                && let Some(value) = self.measured(&other, Measure::Levels)
                && value <= near
            {
                found.push(other);
            }
        }
        found
    }

    /// Returns sets with other choices of the spaces of N, P, L and V, which often are one picture.
    pub(super) fn other_spaces(&self, set: &Set) -> Vec<Set> {
        let is_space = |m: &usize| is_of_a_space(*m);
        let rest: Set = set.iter().copied().filter(|m| !is_space(m)).collect();
        let most = set.len() - rest.len();
        if most == 0 {
            return Vec::new();
        }
        let spaces: Vec<usize> = (0..MISTAKES.len()).filter(is_space).collect();
        let mut found = Vec::new();
        for bits in 1_u32..1 << spaces.len() {
            if bits.count_ones() as usize <= most {
                let chosen = spaces
                    .iter()
                    .enumerate()
                    .filter(|(k, _)| bits >> k & 1 == 1);
                found.push(
                    rest.iter()
                        .copied()
                        .chain(chosen.map(|(_, m)| *m))
                        .collect(),
                );
            }
        }
        found
    }

    pub(super) fn with_any_cut(&mut self, set: &[usize]) -> Option<f64> {
        let recipe = self.recipe(set)?;
        Some(self.of_any_cut(&recipe, Measure::Levels))
    }
}
