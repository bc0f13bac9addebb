//! The times of all candidates of a run, and the ratios between them with their intervals.

use super::clock::Clock;
use super::interruptions::{Cost, Sample, cost};
use super::statistics::{Ratio, TYPICAL, Timing, quantile};
use super::trust::Noise;
use crate::split_mix::SplitMix;
use alloc::vec;
use alloc::vec::Vec;
use core::cell::OnceCell;

/// The number of resamples of the bootstrap of finished times. 2,000 leave 50 beyond each end of a
/// 95 % interval; Efron & Tibshirani (1993, 12.3) ask for at least 1,000.
pub const RESAMPLES: usize = 2_000;

/// The number of resamples that decide if a run goes on.
pub const FEW_RESAMPLES: usize = 200;

/// The number of samples from which on a candidate's own spread is used alone: then its relative
/// error is about 1/√24, a fifth. See docs/reliability.md.
const LEAST_SAMPLES: usize = 24;

/// The limits of a sample's deviation, in spreads. A candidate whose samples happen to be almost
/// equal has next to no spread, and a single other sample of it would be thousands of spreads away
/// in the pool of all. The lowest tenth seldom reaches either limit.
const NEAREST: f64 = -1.0;
const FARTHEST: f64 = 10.0;

/// The seed of every bootstrap, so that equal samples have equal intervals.
const SEED: u64 = 0x4C32_3153_6861_6465;

/// What no run can see of itself, such as a neighbour on the machine that was there all the time.
/// Each end of an interval is farther out by this part: see docs/reliability.md.
const UNSEEN: f64 = 0.015;

/// The times of all candidates of a run.
#[derive(Clone, Debug)]
pub struct Times {
    clock: Clock,
    samples: Vec<Vec<Sample>>,
    /// The calls in a sample of each candidate.
    calls: Vec<u64>,
    rounds: usize,
    cost: Cost,
    /// The typical time of a sample of each candidate, in ns.
    typical: Vec<f64>,
    /// How far each of these may be wrong because the cost of an interruption is, as a part of it.
    by_cost: Vec<f64>,
    /// How far a candidate's samples are over its typical time, as a logarithm: the median.
    spread: Vec<f64>,
    /// How far the samples of each round are over their candidates' typical times, as multiples of
    /// their candidates' spread.
    deviations: Vec<Vec<f64>>,
    /// The number of resamples of the bootstrap.
    resamples: usize,
    /// The resamples of each candidate that was asked for.
    resampled: Vec<OnceCell<Vec<f64>>>,
}

impl Times {
    /// Takes the samples of all candidates, and the number of calls in a sample of each.
    pub(super) fn new(
        samples: Vec<Vec<Sample>>,
        calls: Vec<u64>,
        clock: Clock,
        resamples: usize,
    ) -> Times {
        let rounds = samples.iter().flatten().map(|sample| sample.round + 1);
        let rounds = rounds.max().unwrap_or(0);
        // Nothing can be taken off the time that passed: it has the whole wait in it.
        let cost = if clock.is_own() {
            cost(&samples)
        } else {
            Cost::default()
        };
        let (mut typical, mut by_cost) = (Vec::new(), Vec::new());
        let (mut spread, mut deviations) = (Vec::new(), vec![Vec::new(); rounds]);
        for list in &samples {
            let undisturbed = |sample: &Sample| {
                let cost = if sample.is_interrupted { cost.ns } else { 0.0 };
                // Samples of calls that take next to no time may be shorter than the cost.
                (sample.ns - cost).max(sample.ns / 2.0)
            };
            let lowest = |ns: &dyn Fn(&Sample) -> f64| {
                quantile(&mut list.iter().map(ns).collect::<Vec<_>>(), TYPICAL)
            };
            let (least, with_cost) = (lowest(&undisturbed), lowest(&|sample| sample.ns));
            typical.push(least);
            by_cost.push(if least > 0.0 {
                cost.doubt * (with_cost / least - 1.0)
            } else {
                0.0
            });
            let over = |sample: &Sample| libm::log(undisturbed(sample) / least);
            let median = if least > 0.0 {
                quantile(&mut list.iter().map(over).collect::<Vec<_>>(), 0.5)
            } else {
                0.0
            };
            spread.push(median);
            for sample in list.iter().filter(|_| median > 0.0) {
                let deviation = over(sample) / median;
                deviations[sample.round].push(deviation.clamp(NEAREST, FARTHEST));
            }
        }
        Times {
            clock,
            resampled: vec![OnceCell::new(); samples.len()],
            samples,
            calls,
            rounds,
            cost,
            typical,
            by_cost,
            spread,
            deviations,
            resamples,
        }
    }

    /// Returns the time of a call of each candidate.
    pub fn timings(&self) -> impl Iterator<Item = Timing> {
        (0..self.samples.len()).map(|candidate| self.timing(candidate))
    }

    /// Returns the clock that took the times.
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// Returns the time of a call of a candidate.
    pub fn timing(&self, candidate: usize) -> Timing {
        let calls = self.calls[candidate] as f64;
        let list = &self.samples[candidate];
        let [low, high] = match self.resampled(candidate) {
            [] => [self.typical[candidate]; 2],
            times => interval(times.to_vec(), self.by_cost[candidate]),
        };
        let samples_ns = list.iter().map(|sample| sample.ns / calls).collect();
        Timing::of(samples_ns, self.calls[candidate] as u32)
            .map(|timing| Timing {
                typical_ns: self.typical[candidate] / calls,
                low_ns: low / calls,
                high_ns: high / calls,
                samples_per_round: list.len() / self.rounds,
                interrupted: list.iter().filter(|sample| sample.is_interrupted).count(),
                ..timing
            })
            .expect("finite times of three rounds")
    }

    /// Returns the ratio of a candidate's speed to a baseline's. `None` if the clock was too coarse
    /// to show any time.
    pub fn ratio(&self, baseline: usize, candidate: usize) -> Option<Ratio> {
        if baseline == candidate {
            return Some(Ratio::new(1.0, 1.0, 1.0));
        }
        let calls = self.calls[candidate] as f64 / self.calls[baseline] as f64;
        let of_samples = self.typical[baseline] / self.typical[candidate];
        if !of_samples.is_finite() || of_samples <= 0.0 {
            return None;
        }
        let resampled = self
            .resampled(baseline)
            .iter()
            .zip(self.resampled(candidate));
        let ratios = resampled.map(|(baseline, candidate)| calls * baseline / candidate);
        // An error in the cost of an interruption changes both times the same way.
        let by_cost = (self.by_cost[baseline] - self.by_cost[candidate]).abs();
        let [low, high] = interval(ratios.collect(), by_cost);
        Some(Ratio::new(low, calls * of_samples, high))
    }

    /// True if half the interval of each of `ratios` is at most `part` of it. Each is a pair of a
    /// baseline and a candidate.
    pub(super) fn know(&self, ratios: &[(usize, usize)], part: f64) -> bool {
        let is_known = |ratio: Ratio| ratio.doubt() <= part;
        let mut ratios = ratios.iter().map(|(b, c)| self.ratio(*b, *c));
        ratios.all(|ratio| ratio.is_none_or(is_known))
    }

    /// Returns the times that processors worked, all threads together, in place of times that
    /// passed.
    pub fn of_work(&self) -> Times {
        let work = |sample: &Sample| Sample {
            ns: sample.work_ns,
            ..*sample
        };
        let samples = self
            .samples
            .iter()
            .map(|list| list.iter().map(work).collect());
        Times::new(
            samples.collect(),
            self.calls.clone(),
            self.clock,
            self.resamples,
        )
    }

    /// Says how far these ratios, pairs of a baseline and a candidate, can be trusted; all times,
    /// if there are no ratios.
    pub fn noise(&self, ratios: &[(usize, usize)]) -> Noise {
        let others = ratios
            .iter()
            .filter(|(baseline, candidate)| baseline != candidate);
        let of_ratios = others.filter_map(|(b, c)| Some(self.ratio(*b, *c)?.doubt()));
        let mut doubts: Vec<f64> = of_ratios.collect();
        if doubts.is_empty() {
            doubts = self.timings().map(|timing| timing.doubt()).collect();
        }
        let all = self.samples.iter().flatten();
        let interrupted = all.clone().filter(|sample| sample.is_interrupted).count();
        Noise::new(
            self.clock,
            interrupted as f64 / all.count().max(1) as f64,
            self.rounds,
            self.cost.ns,
            quantile(&mut doubts, 0.5),
        )
    }

    /// Returns the typical time of a sample of a candidate in each resample. A resample takes the
    /// same rounds for all candidates, and from each round the deviations of any of them, because a
    /// candidate alone has too few samples. It has the candidate's own spread; with few samples,
    /// which may be alike by chance, at least the median candidate's.
    fn resampled(&self, candidate: usize) -> &[f64] {
        self.resampled[candidate].get_or_init(|| self.resample(candidate))
    }

    fn resample(&self, candidate: usize) -> Vec<f64> {
        if self.deviations.iter().any(Vec::is_empty) {
            return Vec::new();
        }
        let each = self.samples[candidate].len() / self.rounds;
        let mut spread = self.spread[candidate];
        if self.samples[candidate].len() < LEAST_SAMPLES {
            spread = spread.max(quantile(&mut self.spread.clone(), 0.5));
        }
        let (mut rounds, mut places) = (SplitMix(SEED), SplitMix(SEED + 1 + candidate as u64));
        let mut drawn = Vec::new();
        let time = |_| {
            drawn.clear();
            for _ in 0..self.rounds {
                let round = &self.deviations[rounds.below(self.rounds)];
                drawn.extend((0..each).map(|_| round[places.below(round.len())]));
            }
            self.typical[candidate] * libm::exp(spread * quantile(&mut drawn, TYPICAL))
        };
        (0..self.resamples).map(time).collect()
    }
}

/// Returns the ends of the 95 % interval of resampled values, each farther out by [`UNSEEN`] and by
/// another part of it.
fn interval(mut values: Vec<f64>, part: f64) -> [f64; 2] {
    let part = UNSEEN + part;
    let low = quantile(&mut values, 0.025) / (1.0 + part);
    [low, quantile(&mut values, 0.975) * (1.0 + part)]
}
