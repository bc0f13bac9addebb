//! The stage at which each mistake is looked for, and mistakes that only show together.

use super::{Combinations, Set};
use crate::diagnose::mistakes::{MISTAKES, Mistake};
use crate::diagnose::recipe::{Cut, Geometry, LevelRange, Rate, Recipe, Storage};
use crate::diagnose::stage::Stage;
use alloc::vec::Vec;

/// The stage of the search at which a mistake is looked for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Camera,
    /// It changes cosines, or which polygon is visible.
    Shape,
    /// It changes the curve of levels, without which free amounts cannot be found.
    Curve,
    Amount,
    /// It is none in this scene.
    None,
}

/// Returns the stage of a mistake where `base` is right.
pub fn kind(mistake: &Mistake, base: &Recipe, stage: &Stage<'_>) -> Kind {
    let Some(recipe) = Mistake::all(&[mistake], *base, stage.scene) else {
        return Kind::None;
    };
    let camera = |geometry: Geometry| Geometry {
        eye: geometry.eye,
        lens: geometry.lens,
        aspect: geometry.aspect,
        halves: geometry.halves,
        corners: geometry.corners,
        ..Geometry::default()
    };
    let curve = |storage: Storage| (storage.curve, storage.range == LevelRange::ToneMapped);
    if matches!(recipe.shading.rate, Rate::Method(_)) {
        Kind::None
    } else if recipe.place != base.place || camera(recipe.geometry) != camera(base.geometry) {
        Kind::Camera
    } else if recipe.geometry != base.geometry || recipe.shading != base.shading {
        Kind::Shape
    } else if curve(recipe.storage) != curve(base.storage) {
        Kind::Curve
    } else {
        Kind::Amount
    }
}

/// True for a mistake of the camera, or in the turn or shift of the picture.
pub fn is_of_the_camera(mistake: &Mistake, base: &Recipe, stage: &Stage<'_>) -> bool {
    kind(mistake, base, stage) == Kind::Camera
}

/// Mistakes with which others show.
const SHOWING_OTHERS: [&str; 4] = [
    "other-highlight",
    "light-reversed",
    "view-along-z",
    "direction-as-position",
];

/// The mistakes in the spaces of N, P, L and V.
pub const SPACES: [&str; 9] = [
    "light-in-view-space",
    "lights-moved-to-view-space",
    "lights-by-inverse-rotation",
    "normals-in-view-space",
    "positions-in-view-space",
    "viewer-distance",
    "view-along-z",
    "view-toward-origin",
    "view-of-two-spaces",
];

/// True for a mistake in the space of N, P, L or V. Others often draw the same.
pub fn is_of_a_space(mistake: usize) -> bool {
    MISTAKES
        .get(mistake)
        .is_some_and(|mistake| SPACES.contains(&&*mistake.id))
}

impl Combinations<'_, '_> {
    /// Leaves out mistakes that change nothing, neither on their own nor with one that often makes
    /// others show, and fans of concave polygons where a fan draws the same as ears.
    pub(super) fn leave_out_unseen(&mut self) {
        let index = |id: &str| MISTAKES.iter().position(|mistake| mistake.id == id);
        let with: Vec<usize> = SHOWING_OTHERS.iter().filter_map(|id| index(id)).collect();
        for m in self.names(&[Kind::Shape, Kind::Amount]) {
            let is_seen =
                self.changes(&[], m) || with.iter().any(|other| self.changes(&[*other], m));
            if !is_seen {
                self.unseen.insert(m);
            }
        }
    }

    /// True if a mistake changes the picture of a set.
    pub(super) fn changes(&mut self, set: &[usize], mistake: usize) -> bool {
        let mut with = [set, &[mistake]].concat();
        with.sort_unstable();
        let (Some(mut right), Some(wrong)) = (self.recipe(set), self.recipe(&with)) else {
            return false;
        };
        let moves_polygons = right.geometry != wrong.geometry;
        if moves_polygons && !set.is_empty() {
            return false;
        }
        let is_fan = wrong.geometry.cut == Cut::FanOfConcave;
        if is_fan {
            right.geometry.cut = Cut::Fan;
        }
        let (Some(right), Some(wrong)) = (self.drawer.draw(&right), self.drawer.draw(&wrong))
        else {
            return false;
        };
        right.levels != wrong.levels
            || moves_polygons && !is_fan && right.hits.edges != wrong.hits.edges
    }

    /// Returns the mistakes of some kinds.
    pub(super) fn names(&self, kinds: &[Kind]) -> Vec<usize> {
        let all = 0..MISTAKES.len();
        all.filter(|m| kinds.contains(&self.kind(*m)) && !self.unseen.contains(m))
            .collect()
    }

    /// Returns sets of mistakes that make a picture worse one by one.
    pub(super) fn tuples(&self) -> Vec<Set> {
        let named = |ids: &[&str]| -> Option<Set> {
            let index = |id: &&str| MISTAKES.iter().position(|mistake| mistake.id == *id);
            let mut set: Set = ids.iter().map(index).collect::<Option<_>>()?;
            set.sort_unstable();
            Some(set)
        };
        let tuples: &[&[&str]] = &[
            &["cull-none", "depth-reversed"],
            &["cull-none", "depth-first"],
            &["cull-front", "depth-reversed"],
            &["cull-front", "depth-first"],
            &["normals-in-view-space", "positions-in-view-space"],
            &["normals-in-view-space", "light-in-view-space"],
            &["normals-in-view-space", "lights-moved-to-view-space"],
            &["normals-in-view-space", "lights-by-inverse-rotation"],
            &["normals-in-view-space", "view-toward-origin"],
            &["normals-in-view-space", "view-along-z"],
            &[
                "normals-in-view-space",
                "positions-in-view-space",
                "view-toward-origin",
            ],
            &[
                "normals-in-view-space",
                "light-in-view-space",
                "view-along-z",
            ],
        ];
        tuples.iter().filter_map(|ids| named(ids)).collect()
    }
}
