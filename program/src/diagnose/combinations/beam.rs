//! The beam: the best few sets, to which one more mistake is added at a time.

use super::{Combinations, Kind, Measure, Set, WIDTH};
use crate::diagnose::recipe::Geometry;
use crate::diagnose::residual::MOST;
use alloc::vec::Vec;
use std::collections::HashMap;

/// A set with free amounts whose levels are this close needs no more mistakes.
const ENOUGH_WITH_FREE_AMOUNTS: f64 = 0.02;

/// With free amounts, a shape that leaves more than this, in levels, is not the right one.
pub const WRONG_SHAPE: f64 = 0.3;

/// From how many sets a beam with free amounts starts.
const STARTS: usize = 8;

/// A search that adds mistakes to sets.
pub struct Beam<'s> {
    pub start: &'s [Set],
    /// To how many of these mistakes are added.
    pub starts: usize,
    pub names: &'s [usize],
    /// Sets that are added as a whole.
    pub tuples: &'s [Set],
    pub by: Measure,
    pub depth: usize,
    /// What a mistake costs, in levels.
    pub price: f64,
    /// The distance at which it ends.
    pub enough: f64,
}

impl Combinations<'_, '_> {
    /// Looks for sets of mistakes with free amounts.
    pub(super) fn shapes(&mut self, roots: &[Set]) -> Vec<(Set, f64)> {
        let names = self.names(&[Kind::Shape, Kind::Curve]);
        let tuples = self.tuples();
        let beam = |start, depth| Beam {
            start,
            starts: STARTS,
            names: &names,
            tuples: &tuples,
            by: Measure::FreeAmounts,
            depth,
            price: 0.01,
            enough: ENOUGH_WITH_FREE_AMOUNTS,
        };
        let ones = self.beam(&beam(roots, 1));
        let (mut start, mut depth) = (roots.to_vec(), 4);
        if ones.first().is_none_or(|(_, left)| *left > WRONG_SHAPE) {
            (start, depth) = (self.pairs(roots), 2);
            start.extend(ones.iter().take(WIDTH).map(|(set, _)| set.clone()));
        }
        let mut all = self.beam(&beam(&start, depth));
        all.extend(ones);
        sorted_by_price(&mut all, 0.01);
        all
    }

    /// Adds up to `depth` mistakes to each set of `start`, and keeps the best sets at each step.
    /// Returns all sets that were among the best, the best first.
    pub(super) fn beam(&mut self, beam: &Beam<'_>) -> Vec<(Set, f64)> {
        let mut known: HashMap<Set, f64> = HashMap::new();
        for set in beam.start {
            if let Some(left) = self.measured(set, beam.by) {
                known.insert(set.clone(), left);
            }
        }
        let mut front: Vec<(Set, f64)> = known.iter().map(|(s, v)| (s.clone(), *v)).collect();
        sorted_by_price(&mut front, beam.price);
        let mut all = front.clone();
        front.truncate(beam.starts);
        let mut best_before = front.first().map_or(MOST, |(_, left)| *left);
        for step in 0..beam.depth {
            let mut added: Vec<(Set, f64)> = Vec::new();
            for (set, _) in &front {
                let tuples = beam.tuples.iter().filter(|_| step < 2).map(Vec::as_slice);
                let names = beam.names.iter().map(core::slice::from_ref);
                for more in names.chain(tuples) {
                    if more.iter().any(|m| set.contains(m)) {
                        continue;
                    }
                    let mut longer = [&set[..], more].concat();
                    longer.sort_unstable();
                    if known.contains_key(&longer) {
                        continue;
                    }
                    if let Some(left) = self.measured(&longer, beam.by) {
                        known.insert(longer.clone(), left);
                        added.push((longer, left));
                    }
                }
            }
            let rounded = |left: f64| (left * 1e4).round();
            added.sort_by(|a, b| {
                let by_left = rounded(a.1).total_cmp(&rounded(b.1));
                by_left.then(a.0.len().cmp(&b.0.len())).then(a.0.cmp(&b.0))
            });
            all.extend(added.iter().take(4 * WIDTH).cloned());
            // Equal pictures would fill the beam.
            added.dedup_by(|a, b| (a.1 - b.1).abs() < 1e-5);
            front = self.widest(added, step);
            let Some((_, best)) = front.first() else {
                break;
            };
            if *best > best_before - (0.02 * best_before).max(0.004) || *best < beam.enough {
                break;
            }
            best_before = *best;
        }
        sorted_by_price(&mut all, beam.price);
        all
    }

    /// Keeps the best sets of a sorted list. Besides them it keeps the best of those that show
    /// other polygons, because their light cannot be compared before it is right, and of those to
    /// which several mistakes were added at once.
    pub(super) fn widest(&self, sorted: Vec<(Set, f64)>, step: usize) -> Vec<(Set, f64)> {
        let mut kept: Vec<(Set, f64)> = Vec::new();
        let mut shown: Vec<Geometry> = Vec::new();
        let (mut usual, mut others, mut leaps) = (0, 0, 0);
        let shortest = sorted.iter().map(|(set, _)| set.len()).min().unwrap_or(0);
        for (set, left) in sorted {
            let Some(recipe) = self.recipe(&set) else {
                continue;
            };
            let is_leap = step == 0 && set.len() > shortest + 1;
            let is_new = !shown.contains(&recipe.geometry);
            if is_leap && leaps < WIDTH / 2 {
                leaps += 1;
            } else if !is_leap && usual < WIDTH {
                usual += 1;
            } else if is_new && others < WIDTH / 2 {
                others += 1;
            } else {
                continue;
            }
            shown.push(recipe.geometry);
            kept.push((set, left));
        }
        kept
    }
}

/// Sorts sets by what they leave, with a price for each mistake, and leaves out those that are
/// there twice.
fn sorted_by_price(sets: &mut Vec<(Set, f64)>, price: f64) {
    let price = |set: &Set, left: f64| left + price * set.len() as f64;
    sets.sort_by(|a, b| {
        price(&a.0, a.1)
            .total_cmp(&price(&b.0, b.1))
            .then(a.0.cmp(&b.0))
    });
    sets.dedup();
}
