//! Interruptions: samples in which other programs had the processor, and what that costs.
//!
//! The thread's clock stands still meanwhile, but afterwards the caches hold the data of others.
//! This costs all candidates the same, because they use the same memory. A long candidate pays it
//! more often.

use super::statistics::quantile;

/// Some calls of a candidate, timed together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// The round.
    pub round: usize,
    /// The time that counts, in ns: see [`super::Clock`].
    pub ns: f64,
    /// The time of processors, in ns: the work of all threads.
    pub work_ns: f64,
    /// True if other programs had the processor meanwhile.
    pub is_interrupted: bool,
}

/// Longer samples, in ns, are interrupted several times on a busy machine: time slices of Linux are
/// 3 to 4 ms.
pub const LONG_NS: f64 = 4_000_000.0;

/// The number of pairs from which on a cost is known.
const LEAST_PAIRS: usize = 8;

/// The largest cost, in ns. Of one candidate the longer samples are interrupted more often, so that
/// few samples show too large a cost.
const MOST_COST_NS: f64 = 100_000.0;

/// The cost of an interruption.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// The cost in ns.
    pub ns: f64,
    /// The part of it, 0..=1, by which it may be wrong.
    pub doubt: f64,
}

/// Returns the cost of an interruption: the median difference between an interrupted sample and one
/// of the same candidate that was not. That may be wrong by half;
/// if too few samples show it, it is anything up to the largest one.
pub fn cost(candidates: &[Vec<Sample>]) -> Cost {
    let mut differences = Vec::new();
    for samples in candidates {
        let is_short = |sample: &&Sample| sample.is_interrupted && sample.ns < LONG_NS;
        for interrupted in samples.iter().filter(is_short) {
            let others = samples.iter().filter(|other| !other.is_interrupted);
            differences.extend(others.map(|other| interrupted.ns - other.ns));
        }
    }
    if differences.len() < LEAST_PAIRS {
        return Cost {
            ns: MOST_COST_NS / 2.0,
            doubt: 1.0,
        };
    }
    Cost {
        ns: quantile(&mut differences, 0.5).clamp(0.0, MOST_COST_NS),
        doubt: 0.5,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cost_is_found_within_candidates() {
        let sample = |base: f64, is_interrupted: bool| Sample {
            ns: base + if is_interrupted { 70e3 } else { 0.0 },
            is_interrupted,
            ..Sample::default()
        };
        let short = [false, false, false, true, true].map(|i| sample(1e6, i));
        let long = [true, true, true, true, false].map(|i| sample(3e6, i));
        let found = Cost {
            ns: 70e3,
            doubt: 0.5,
        };
        assert_eq!(cost(&[short.to_vec(), long.to_vec()]), found);
        assert_eq!(
            cost(&[vec![sample(1e6, true); 9]]).doubt,
            1.0,
            "nothing shows it"
        );
    }

    #[test]
    fn no_cost_is_larger_than_caches_explain() {
        let sample = |ns: f64, is_interrupted| Sample {
            ns,
            is_interrupted,
            ..Sample::default()
        };
        let of = |ns| {
            [vec![sample(1e6, false); 9], vec![]].map(|mut list| {
                list.push(sample(ns, true));
                list
            })
        };
        assert_eq!(cost(&of(1.9e6)).ns, MOST_COST_NS);
        assert_eq!(cost(&of(0.9e6)).ns, 0.0, "nothing becomes faster by it");
    }
}
