//! How far a recipe is from a picture, in grey levels.

use super::hits::Hits;
use alloc::rc::Rc;
use alloc::vec::Vec;
use std::collections::{HashMap, HashSet};

/// The most that a difference counts, in levels: where another polygon is visible, a pixel is
/// wrong, not very wrong.
pub const MOST: f64 = 48.0;

/// The fewest pixels to decide from.
const FEWEST: usize = 30;

/// Two recipes differ at a pixel if a channel differs by at least this many levels.
const DIFFERENT: f32 = 2.0;

/// The fewest pixels for a vote.
const FEWEST_VOTES: usize = 20;

/// The fewest wrong pixels that make a part of a picture wrong.
const FEWEST_WRONG: usize = 6;

/// A picture of fewer colours than this is like those of many sets of mistakes.
const FEW_COLOURS: usize = 30;

/// The largest share of pixels that may be wrong here and there, beside edges that another
/// rasterizer has elsewhere.
const MOST_WRONG: f64 = 0.03;

/// Returns the side of square parts of a picture that have at least about eight compared pixels
/// each, and that are not too small to be seen: a 32nd of the width.
fn part_side(pixels: &[[usize; 2]]) -> usize {
    let first = pixels.first().copied().unwrap_or_default();
    let (low, high) = pixels.iter().fold((first, first), |(low, high), p| {
        let low = [low[0].min(p[0]), low[1].min(p[1])];
        (low, [high[0].max(p[0]), high[1].max(p[1])])
    });
    let area = (high[0] - low[0] + 1) * (high[1] - low[1] + 1);
    let each = 8.0 * area as f64 / pixels.len().max(1) as f64;
    (libm::sqrt(each) as usize).max((high[0] - low[0]) / 32 + 1)
}

/// A recipe at the sampled pixels.
pub struct Drawn {
    /// The levels, 0..=255.
    pub levels: Vec<[f32; 3]>,
    pub hits: Rc<Hits>,
}

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
    /// The share of pixels with a channel that is off by more than two levels.
    pub off: f64,
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

/// True if a channel of two colours differs by more than two levels, which a person may see.
pub fn is_off(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).any(|(a, b)| (a - b).abs() > 2.0)
}

impl Target {
    /// Returns the distance of a recipe, or `None` if too few pixels can be compared.
    pub fn residual(&self, drawn: &Drawn) -> Option<Residual> {
        let (mut sum, mut beyond, mut off, mut compared, mut left_out) = (0.0, 0.0, 0, 0, 0);
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
            off += usize::from(is_off(own, other));
        }
        (compared >= FEWEST).then(|| Residual {
            levels: sum / compared as f64,
            beyond: beyond / compared as f64,
            off: off as f64 / compared as f64,
            compared,
            left_out,
        })
    }

    /// True if the picture shows less than a 50th of the pixels that a recipe covers.
    pub fn is_empty(&self, drawn: &Drawn) -> bool {
        let covered = (0..self.levels.len()).filter(|i| drawn.hits.is_covered(*i));
        let (mut all, mut there) = (0usize, 0usize);
        for i in covered {
            all += 1;
            there += usize::from(self.is_drawn[i]);
        }
        50 * there < all
    }

    /// True if the picture has few colours, so that several mistakes must explain it exactly.
    pub fn has_few_colours(&self) -> bool {
        let drawn = self.levels.iter().zip(&self.is_drawn);
        let drawn = drawn.filter(|(_, is_drawn)| **is_drawn);
        let colours: HashSet<[u32; 3]> =
            drawn.map(|(levels, _)| levels.map(f32::to_bits)).collect();
        colours.len() < FEW_COLOURS
    }

    /// Returns the mean distance of a recipe, of which no pixel counts more than `most` levels, or
    /// `None` if too few pixels can be compared.
    pub fn bounded(&self, drawn: &Drawn, most: f32) -> Option<f64> {
        let (mut sum, mut compared) = (0.0, 0usize);
        for i in 0..self.levels.len() {
            let is_seen = drawn.hits.is_covered(i) || self.is_drawn[i];
            if is_seen && !drawn.hits.edges[i] {
                sum += f64::from(distance(drawn.levels[i], self.levels[i]).min(most));
                compared += 1;
            }
        }
        (compared >= FEWEST).then(|| sum / compared as f64)
    }

    /// True if a recipe differs from the picture in a part that a person would see: in at least
    /// half of a part's pixels, or in too many pixels of the whole.
    pub fn shows(&self, drawn: &Drawn, pixels: &[[usize; 2]]) -> bool {
        let mut parts: HashMap<[usize; 2], [usize; 2]> = HashMap::new();
        let (mut all, mut wrong) = (0usize, 0usize);
        let side = part_side(pixels);
        for (i, [x, y]) in pixels.iter().enumerate() {
            let is_seen = drawn.hits.is_covered(i) || self.is_drawn[i];
            if !is_seen || drawn.hits.edges[i] {
                continue;
            }
            let off = usize::from(is_off(drawn.levels[i], self.levels[i]));
            let part = parts.entry([x / side, y / side]).or_default();
            *part = [part[0] + 1, part[1] + off];
            all += 1;
            wrong += off;
        }
        let is_visible = |[all, wrong]: &[usize; 2]| *wrong >= FEWEST_WRONG && 2 * wrong >= *all;
        wrong as f64 > MOST_WRONG * all as f64 || parts.values().any(is_visible)
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
