//! How far a recipe is from a picture, in grey levels.

use super::drawer::Drawn;
use alloc::vec::Vec;

/// The most that a difference counts, in levels: where another polygon is visible, a pixel is
/// wrong, not very wrong.
pub const MOST: f64 = 48.0;

/// The fewest pixels to decide from.
const FEWEST: usize = 30;

/// Two recipes differ at a pixel if a channel differs by at least this many levels.
const DIFFERENT: f32 = 2.0;

/// The fewest pixels for a vote.
const FEWEST_VOTES: usize = 20;

/// The sampled pixels of the picture that is diagnosed.
pub struct Target {
    /// The levels, 0..=255.
    pub levels: Vec<[f32; 3]>,
    /// True where the pixel does not have the background's colour.
    pub is_drawn: Vec<bool>,
}

/// A recipe's distance from the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// The mean of [`distance`] over pixels, in levels.
    pub levels: f64,
    /// The mean of the differences beyond one level, which ignores noise of a level and other
    /// rounding.
    pub beyond: f64,
    /// How many pixels were compared.
    pub compared: usize,
    /// How many pixels beside edges were left out.
    pub left_out: usize,
}

/// Returns the mean difference of the channels of two colours, in levels, at most [`MOST`].
pub fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    let sum: f32 = a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum();
    (sum / 3.0).min(MOST as f32)
}

impl Target {
    /// Returns the distance of a recipe, or `None` if too few pixels can be compared.
    pub fn residual(&self, drawn: &Drawn) -> Option<Residual> {
        let (mut sum, mut beyond, mut compared, mut left_out) = (0.0, 0.0, 0, 0);
        for i in 0..self.levels.len() {
            if !(drawn.hits.is_covered(i) || self.is_drawn[i]) {
                continue;
            }
            if drawn.hits.edges[i] {
                left_out += 1;
                continue;
            }
            compared += 1;
            let (own, other) = (drawn.levels[i], self.levels[i]);
            sum += f64::from(distance(own, other));
            let over: f32 = own
                .iter()
                .zip(other)
                .map(|(a, b)| ((a - b).abs() - 1.0).max(0.0))
                .sum();
            beyond += f64::from((over / 3.0).min(MOST as f32));
        }
        (compared >= FEWEST).then(|| Residual {
            levels: sum / compared as f64,
            beyond: beyond / compared as f64,
            compared,
            left_out,
        })
    }

    /// Lets the pixels where two recipes differ vote for the recipe that they are closer to.
    pub fn votes(&self, reference: &Drawn, other: &Drawn) -> Votes {
        let (mut voters, mut nearer, mut before, mut after) = (0, 0, 0.0, 0.0);
        for i in 0..self.levels.len() {
            let (a, b) = (reference.levels[i], other.levels[i]);
            let differ = a.iter().zip(b).any(|(a, b)| (a - b).abs() >= DIFFERENT);
            if !differ || reference.hits.edges[i] || other.hits.edges[i] {
                continue;
            }
            let [to_a, to_b] = [a, b].map(|levels| distance(levels, self.levels[i]));
            voters += 1;
            nearer += usize::from(to_b < to_a);
            before += f64::from(to_a);
            after += f64::from(to_b);
        }
        let is_enough = voters >= FEWEST_VOTES && before > 0.0;
        let share = |part: f64, whole: f64| if is_enough { part / whole } else { 0.0 };
        Votes {
            voters,
            nearer: share(nearer as f64, voters as f64),
            explained: share(before - after, before),
        }
    }
}

/// The votes of the pixels where two recipes differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Votes {
    /// How many pixels vote.
    pub voters: usize,
    /// The share of pixels that are closer to the second recipe.
    pub nearer: f64,
    /// The share of their distance from the first recipe that the second one removes.
    pub explained: f64,
}

impl Votes {
    /// True if the votes elect the second recipe.
    pub fn elect(&self) -> bool {
        self.nearer >= 0.9 && self.explained >= 0.6
    }
}

/// Returns the mean difference of two recipes in levels, without the edges of either.
pub fn apart(a: &Drawn, b: &Drawn) -> f64 {
    let (mut sum, mut compared) = (0.0, 0usize);
    for i in 0..a.levels.len() {
        let is_seen = a.hits.is_covered(i) || b.hits.is_covered(i);
        if is_seen && !a.hits.edges[i] && !b.hits.edges[i] {
            compared += 1;
            sum += f64::from(distance(a.levels[i], b.levels[i]));
        }
    }
    sum / compared.max(1) as f64
}
