//! All pairs of mistakes in the shape of light, at few pixels.
//!
//! Each of two mistakes may leave as much as many others, so that a beam loses both.

use super::{Combinations, Kind, MOST_WITH_FREE_AMOUNTS, Set, shape_of};
use crate::diagnose::drawer::Drawer;
use crate::diagnose::residual::{MOST, Target};
use alloc::vec::Vec;

/// At how many pixels pairs are compared.
const PIXELS: usize = 160;

/// How many pairs are kept, how many with the same light, and from how many cameras they are looked
/// for.
const KEPT: usize = 48;
const TWINS: usize = 4;
const CAMERAS: usize = 2;

impl<'a> Combinations<'a, '_> {
    /// Returns the pairs that come nearest to the picture with free amounts, together with the
    /// first of `roots` and with others of the same outline.
    pub(super) fn pairs(&mut self, roots: &[Set]) -> Vec<Set> {
        let (mut drawer, target) = self.at_few_pixels();
        let names = self.names(&[Kind::Shape, Kind::Curve]);
        let moves = |m: &usize| self.moves(*m).geometry != self.base.geometry;
        let moves: Vec<bool> = names.iter().map(moves).collect();
        let error = |root: &Set| self.outline_error(root);
        let first = roots.first().and_then(error);
        let is_first = |root: &&Set| error(root) == first;
        let mut found: Vec<(Set, f64)> = Vec::new();
        for root in roots.iter().filter(is_first).take(CAMERAS) {
            for (k, a) in names.iter().enumerate() {
                for (l, b) in names.iter().enumerate().skip(k + 1) {
                    // Each pair of moves would be another frame to draw.
                    if moves[k] && moves[l] {
                        continue;
                    }
                    let mut set = [&root[..], &[*a, *b]].concat();
                    set.sort_unstable();
                    let Some(recipe) = self.recipe(&set) else {
                        continue;
                    };
                    let fit = drawer.fit(&shape_of(&recipe), None, &target);
                    let left =
                        fit.and_then(|fit| target.bounded(&fit.drawn, MOST_WITH_FREE_AMOUNTS));
                    found.push((set, left.unwrap_or(MOST)));
                }
            }
        }
        let rounded = |left: f64| (left * 1e4).round();
        found.sort_by(|a, b| rounded(a.1).total_cmp(&rounded(b.1)).then(a.0.cmp(&b.0)));
        let equal = found.chunk_by(|a, b| rounded(a.1) == rounded(b.1));
        let kept = equal.flat_map(|equal| equal.iter().take(TWINS)).take(KEPT);
        kept.map(|(set, _)| set.clone()).collect()
    }

    /// Returns a drawer of every few pixels, and the picture there.
    fn at_few_pixels(&self) -> (Drawer<'a>, Target) {
        let count = self.drawer.pixels.len();
        let chosen: Vec<usize> = (0..PIXELS.min(count))
            .map(|k| k * count / PIXELS.min(count))
            .collect();
        let pixels = chosen.iter().map(|i| self.drawer.pixels[*i]).collect();
        let mut drawer = Drawer::new(self.stage, pixels, true);
        drawer.background = self.drawer.background;
        let target = Target {
            levels: chosen.iter().map(|i| self.target.levels[*i]).collect(),
            is_drawn: chosen.iter().map(|i| self.target.is_drawn[*i]).collect(),
        };
        drawer.target = target.levels.clone();
        (drawer, target)
    }
}
