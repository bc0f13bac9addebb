//! Looks for several mistakes that together explain a picture.
//!
//! Each of them alone may make the picture no better, so they are looked for in the order in which
//! they can be told apart:
//!
//! 1. the camera, the turn and the shift of the picture, by outlines alone ([`Outline`]);
//! 2. directions, normals, exponents and visible polygons, with free amounts of light
//!    ([`Amounts`]): all pairs, and a beam of the best few sets, to which one more mistake is added
//!    at a time;
//! 3. amounts, colours and rounding, by exact levels;
//! 4. mistakes of the best sets are added, left out and exchanged, again by exact levels.

mod beam;
mod cameras;
mod exchange;
mod factors;
mod fits;
mod kinds;
mod pairs;

pub use fits::Fit;
pub use kinds::{is_of_a_space, is_of_the_camera};

use super::amounts::Amounts;
use super::drawer::{Drawer, Fitted};
use super::mistakes::{MISTAKES, Mistake};
use super::outline::Outline;
use super::recipe::{CUTS, LevelRange, Rate, Recipe, Storage};
use super::residual::{MOST, Target};
use super::stage::Stage;
use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use beam::WRONG_SHAPE;
use kinds::{Kind, kind};
use std::collections::HashMap;

/// Mistakes, as indices into [`MISTAKES`], in ascending order.
pub type Set = Vec<usize>;

/// How many sets a beam keeps.
const WIDTH: usize = 8;

/// A set whose levels are this close to the picture needs no more mistakes.
const ENOUGH: f64 = 0.012;

/// The most that a pixel counts with free amounts, in levels: it may be wrong in another way, as
/// where levels wrapped around.
const MOST_WITH_FREE_AMOUNTS: f32 = 16.0;

/// A search for sets of mistakes.
pub struct Combinations<'a, 't> {
    stage: &'a Stage<'a>,
    drawer: Drawer<'a>,
    target: Target,
    outline: &'t Outline,
    singles: &'t [Set],
    /// The right recipe, with the cut of polygons that comes closest.
    pub base: Recipe,
    /// True if polygons have more than three sides.
    has_cuts: bool,
    kinds: Vec<Kind>,
    /// Mistakes that concern visible polygons and change nothing on their own.
    unseen: BTreeSet<usize>,
    by_shape: HashMap<Recipe, f64>,
    by_levels: HashMap<Recipe, f64>,
    /// The sets of camera mistakes that were tried, with the errors of their outlines, the best
    /// first.
    pub cameras: Vec<(Set, f64)>,
    /// The sets with free amounts, the best first.
    pub shapes: Vec<(Set, f64)>,
}

/// The measure of a set of mistakes.
#[derive(Clone, Copy)]
enum Measure {
    FreeAmounts,
    Levels,
}

impl<'a, 't> Combinations<'a, 't> {
    /// Begins a search at the pixels of `drawer`, which `target` has in the picture. `singles`
    /// are the mistakes that come nearest on their own.
    pub fn new(
        stage: &'a Stage<'a>,
        drawer: Drawer<'a>,
        target: Target,
        outline: &'t Outline,
        base: Recipe,
        singles: &'t [Set],
    ) -> Combinations<'a, 't> {
        let kinds = MISTAKES.iter().map(|m| kind(m, &base, stage)).collect();
        let mut polygons = 0..stage.prepared.polygon_count();
        Combinations {
            has_cuts: polygons.any(|polygon| stage.prepared.corners(polygon).len() > 3),
            unseen: BTreeSet::new(),
            stage,
            drawer,
            target,
            outline,
            singles,
            base,
            kinds,
            by_shape: HashMap::new(),
            by_levels: HashMap::new(),
            cameras: Vec::new(),
            shapes: Vec::new(),
        }
    }

    /// Returns the recipe of a set, or `None` if its mistakes exclude each other.
    pub fn recipe(&self, set: &[usize]) -> Option<Recipe> {
        let made: Vec<&Mistake> = set
            .iter()
            .map(|&m| MISTAKES.get(m))
            .collect::<Option<_>>()?;
        Mistake::all(&made, self.base, self.stage.scene)
    }

    /// Returns the distance of a set from the picture in levels, or [`MOST`] if it cannot be drawn.
    pub fn left(&mut self, set: &[usize]) -> f64 {
        self.measured(set, Measure::Levels).unwrap_or(MOST)
    }

    /// Returns the distance of a set from the picture with free amounts, or [`MOST`] if it cannot
    /// be drawn.
    pub fn left_with_free_amounts(&mut self, set: &[usize]) -> f64 {
        self.measured(set, Measure::FreeAmounts).unwrap_or(MOST)
    }

    /// Returns the distance of a set from the picture, or `None` if it cannot be drawn.
    fn measured(&mut self, set: &[usize], by: Measure) -> Option<f64> {
        let recipe = self.recipe(set)?;
        if recipe.depends_on_cut() {
            Some(self.of_any_cut(&recipe, by))
        } else {
            Some(self.of_recipe(&recipe, by))
        }
    }

    /// Returns the distance of a recipe with the cut of polygons that comes closest: any is right.
    fn of_any_cut(&mut self, recipe: &Recipe, by: Measure) -> f64 {
        if !self.has_cuts || !CUTS.contains(&recipe.geometry.cut) {
            return self.of_recipe(recipe, by);
        }
        let mut best = MOST;
        for cut in CUTS {
            let mut recipe = *recipe;
            recipe.geometry.cut = cut;
            best = best.min(self.of_recipe(&recipe, by));
        }
        best
    }

    fn of_recipe(&mut self, recipe: &Recipe, by: Measure) -> f64 {
        match by {
            Measure::Levels => {
                if let Some(known) = self.by_levels.get(recipe) {
                    return *known;
                }
                let drawn = self.drawer.draw(recipe);
                let found = drawn.and_then(|drawn| self.target.residual(&drawn));
                let left = found.map_or(MOST, |found| found.levels);
                self.by_levels.insert(*recipe, left);
                left
            }
            Measure::FreeAmounts => {
                let shape = shape_of(recipe);
                if let Some(known) = self.by_shape.get(&shape) {
                    return *known;
                }
                let left = self.fit(&shape, None).map_or(MOST, |(_, left)| left);
                self.by_shape.insert(shape, left);
                left
            }
        }
    }

    /// Fits the amounts of a recipe. Returns them, and the distance that they leave.
    fn fit(&mut self, recipe: &Recipe, fitted: Option<&Fitted>) -> Option<(Amounts, f64)> {
        let fit = self.drawer.fit(recipe, fitted, &self.target)?;
        let left = self.target.bounded(&fit.drawn, MOST_WITH_FREE_AMOUNTS)?;
        Some((fit.amounts, left))
    }

    /// Looks for cameras and, with free amounts, for the shape of light. Returns true if a shape
    /// may be right. `progress` is called with the share of the work that is done, 0 to 1.
    pub fn find_shapes(&mut self, progress: &mut dyn FnMut(f32)) -> bool {
        self.leave_out_unseen();
        self.cameras = self.cameras();
        progress(0.2);
        let roots = self.roots();
        self.shapes = self.shapes(&roots);
        let best = self.shapes.first().cloned();
        if best.is_some_and(|(set, left)| self.chooses_cut(&set, left, Measure::FreeAmounts)) {
            self.shapes = self.shapes(&roots);
        }
        progress(0.5);
        self.shapes
            .first()
            .is_some_and(|(_, left)| *left <= WRONG_SHAPE)
    }

    /// Looks for sets of mistakes with the shapes that were found. Returns the best ones without
    /// mistakes that take nothing away, the best first.
    pub fn find_sets(&mut self, progress: &mut dyn FnMut(f32)) -> Vec<Set> {
        let roots = self.roots();
        let mut sets = self.sets(&roots);
        let best = sets.first().cloned();
        if best.is_some_and(|(set, left)| self.chooses_cut(&set, left, Measure::Levels)) {
            sets = self.sets(&roots);
        }
        progress(0.8);
        let best = self.improved(&sets);
        progress(0.95);
        self.pruned(best)
    }

    /// Chooses the cut of polygons, which is no mistake, for a set that leaves `left`. Returns true
    /// if another one than before is clearly closer.
    fn chooses_cut(&mut self, set: &Set, left: f64, by: Measure) -> bool {
        if !self.has_cuts {
            return false;
        }
        let own = self.base.geometry.cut;
        let mut best = (own, 0.99 * left - 1e-3);
        for cut in CUTS.into_iter().filter(|cut| *cut != own) {
            self.base.geometry.cut = cut;
            if let Some(left) = self.measured(set, by)
                && left < best.1
            {
                best = (cut, left);
            }
        }
        self.base.geometry.cut = best.0;
        best.0 != own
    }

    fn kind(&self, mistake: usize) -> Kind {
        self.kinds.get(mistake).copied().unwrap_or(Kind::None)
    }

    /// True for a mistake of the camera, or in the turn or shift of the picture.
    pub fn is_camera(&self, mistake: usize) -> bool {
        self.kind(mistake) == Kind::Camera
    }

    /// True for a mistake in amounts, colours or rounding.
    pub fn is_amount(&self, mistake: usize) -> bool {
        self.kind(mistake) == Kind::Amount
    }
}

/// Returns the recipe that free amounts are found for: without amounts, and with the curve alone.
pub fn shape_of(recipe: &Recipe) -> Recipe {
    let mut shape = *recipe;
    shape.mixing = Default::default();
    shape.storage = Storage {
        curve: recipe.storage.curve,
        range: match recipe.storage.range {
            LevelRange::ToneMapped => LevelRange::ToneMapped,
            _ => LevelRange::Clamped,
        },
        ..Storage::default()
    };
    if shape.shading.rate == Rate::Vertex {
        shape.shading.rate = Rate::VertexUnclamped;
    }
    shape
}
