//! Cameras, turns and shifts, ranked by outlines alone.

use super::{Combinations, Kind, Set};
use crate::diagnose::mistakes::MISTAKES;
use crate::diagnose::outline::{Mask, RIGHT_OUTLINE, TURNS};
use crate::diagnose::recipe::{Place, Recipe, Turn};
use alloc::collections::BTreeSet;
use alloc::vec;
use alloc::vec::Vec;

/// How many cameras are tried.
const ROOTS: usize = 12;

/// The most cameras with two mistakes that are tried.
const PAIRS_OF_CAMERAS: usize = 4;

impl Combinations<'_, '_> {
    /// Returns the sets of camera mistakes that cover the picture best.
    pub(super) fn roots(&self) -> Vec<Set> {
        let Some((_, best)) = self.cameras.first() else {
            return vec![Vec::new()];
        };
        let near = 1.25 * best + 0.0012;
        let all = self.cameras.iter().take_while(|(_, error)| *error <= near);
        let mut roots: Vec<Set> = all.take(ROOTS).map(|(set, _)| set.clone()).collect();
        let base = self.cameras.iter().find(|(set, _)| set.is_empty());
        let is_near = base.is_some_and(|(_, error)| *error <= 1.5 * best + 0.003);
        if is_near && !roots.iter().any(Set::is_empty) {
            roots.push(Vec::new());
        }
        roots
    }

    /// Ranks cameras, turns and shifts by their outlines.
    pub(super) fn cameras(&self) -> Vec<(Set, f64)> {
        let all = 0..MISTAKES.len();
        let own = Mask::of_geometry(self.stage, self.base.geometry);
        // Mistakes that show other polygons may cover other pixels, too.
        let covers_others = |m: usize| {
            let geometry = self.moves(m).geometry;
            let is_open = geometry != self.base.geometry && !self.unseen.contains(&m);
            is_open && self.kind(m) == Kind::Shape && Mask::of_geometry(self.stage, geometry) != own
        };
        let is_camera =
            |m: usize| self.kind(m) == Kind::Camera && self.moves(m).place == self.base.place;
        let cameras: Vec<usize> = all
            .clone()
            .filter(|&m| is_camera(m) || covers_others(m))
            .collect();
        let of_place = |place: Place| -> Option<Set> {
            let parts = [
                Place {
                    turn: place.turn,
                    moved: [0, 0],
                },
                Place {
                    turn: Turn::Stated,
                    moved: place.moved,
                },
            ];
            let mut set = Set::new();
            for part in parts.into_iter().filter(|part| *part != Place::default()) {
                set.push(
                    all.clone()
                        .find(|&m| self.kind(m) == Kind::Camera && self.moves(m).place == part)?,
                );
            }
            Some(set)
        };
        let mut found: Vec<(Set, f64)> = Vec::new();
        let add = |camera: &[usize], turns: &[Turn], found: &mut Vec<(Set, f64)>| {
            let Some(recipe) = self.recipe(camera) else {
                return;
            };
            let Some(covered) = Mask::of_geometry(self.stage, recipe.geometry) else {
                return;
            };
            for placed in self.outline.places(&covered, turns) {
                let Some(place) = of_place(placed.place) else {
                    continue;
                };
                let mut set = [camera, &place[..]].concat();
                set.sort_unstable();
                if self.recipe(&set).is_some() {
                    found.push((set, placed.error));
                }
            }
        };
        add(&[], &TURNS, &mut found);
        rank(&mut found);
        // Other cameras are tried with the turns that suit the right one best.
        let turn_of = |set: &Set| self.recipe(set).map_or(Turn::Stated, |r| r.place.turn);
        let mut best_turns = vec![Turn::Stated];
        for (set, _) in &found {
            let turn = turn_of(set);
            if best_turns.len() < 3 && !best_turns.contains(&turn) {
                best_turns.push(turn);
            }
        }
        for camera in &cameras {
            add(&[*camera], &best_turns, &mut found);
        }
        rank(&mut found);
        let is_other = |set: &Set| set.iter().any(|m| cameras.contains(m));
        if (found.first()).is_some_and(|(set, error)| *error > RIGHT_OUTLINE || is_other(set)) {
            let mut firsts: Vec<Set> = Vec::new();
            for (set, _) in &found {
                let own: Set = set
                    .iter()
                    .copied()
                    .filter(|m| cameras.contains(m))
                    .collect();
                if firsts.len() < PAIRS_OF_CAMERAS && !own.is_empty() && !firsts.contains(&own) {
                    firsts.push(own);
                }
            }
            let mut pairs = BTreeSet::new();
            for first in &firsts {
                for another in cameras.iter().filter(|another| !first.contains(another)) {
                    let mut pair = [&first[..], &[*another]].concat();
                    pair.sort_unstable();
                    pairs.insert(pair);
                }
            }
            for pair in pairs {
                add(&pair, &best_turns, &mut found);
            }
            rank(&mut found);
        }
        found
    }

    /// Returns the shortest camera mistakes whose outlines are nearest, and their error.
    pub fn best_cameras(&self) -> (Vec<Set>, f64) {
        let all = self.cameras();
        let Some((best, error)) = all.first() else {
            return (Vec::new(), 1.0);
        };
        let is_best =
            |(set, other): &&(Set, f64)| (other - error).abs() < 1e-9 && set.len() == best.len();
        let sets = all.iter().filter(is_best).map(|(set, _)| set.clone());
        (sets.collect(), *error)
    }

    /// Returns the recipe of one mistake.
    pub(super) fn moves(&self, mistake: usize) -> Recipe {
        let mut recipe = self.base;
        MISTAKES[mistake].set(&mut recipe);
        recipe.of_scene(self.stage.scene)
    }

    /// True if a set without one of its camera mistakes has clearly another outline.
    pub(super) fn changes_outline(&self, set: &[usize], rest: &[usize]) -> bool {
        let error = |set: &[usize]| {
            let cameras: Set = set.iter().copied().filter(|m| self.is_camera(*m)).collect();
            self.outline_error(&cameras)
        };
        matches!((error(set), error(rest)), (Some(own), Some(other)) if other > own + RIGHT_OUTLINE)
    }

    /// Returns the error of the outline of some camera mistakes.
    pub fn outline_error(&self, cameras: &[usize]) -> Option<f64> {
        let known = self.cameras.iter().find(|(set, _)| set == cameras);
        known.map(|(_, error)| *error)
    }
}

fn rank(found: &mut Vec<(Set, f64)>) {
    let rounded = |error: f64| (error * 1e5).round();
    found.sort_by(|a, b| {
        let by_error = rounded(a.1).total_cmp(&rounded(b.1));
        by_error.then(a.0.len().cmp(&b.0.len())).then(a.0.cmp(&b.0))
    });
    found.dedup_by(|a, b| a.0 == b.0);
}
