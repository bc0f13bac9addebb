//! A tone curve: the levels of the picture are a function of the reference's levels.

use alloc::vec::Vec;

/// The fewest channels to decide from.
const FEWEST: usize = 90;

/// Levels vary by at least this many times their scatter.
const LEAST_VARIETY: f64 = 8.0;

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
        let mean =
            pairs.iter().map(|(_, t)| f64::from(*t)).sum::<f64>() / pairs.len().max(1) as f64;
        let off = pairs
            .iter()
            .map(|(_, t)| (f64::from(*t) - mean).abs())
            .sum::<f64>();
        // Any curve fits a picture of one colour.
        if off < LEAST_VARIETY * scatter * pairs.len() as f64 {
            return None;
        }
        let middle = |level: f32| (4.0..=250.0).contains(&level);
        let inner = pairs.iter().filter(|(r, t)| middle(*r) && middle(*t));
        let log = |level: f32| libm::log(f64::from(level) / 255.0);
        let mut gammas: Vec<f64> = inner.map(|(r, t)| log(*t) / log(*r)).collect();
        gammas.sort_by(f64::total_cmp);
        let gamma = *gammas.get(gammas.len() / 2)?;
        (gammas.len() >= FEWEST).then_some(Tone { gamma, scatter })
    }
}
