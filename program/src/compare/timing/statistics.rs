//! Statistics of samples: medians, quartiles, and confidence intervals of ratios.

use crate::split_mix::SplitMix;
use alloc::vec::Vec;
use serde::Serialize;

/// The confidence level of the interval of a [`Ratio`].
pub const CONFIDENCE: f64 = 0.95;

/// The number of resamples of a bootstrap. 2,000 leave 50 beyond each end of a 95 % interval; Efron
/// & Tibshirani (1993, 12.3) ask for at least 1,000.
const RESAMPLES: usize = 2000;

/// The seed of every bootstrap, so that equal samples have equal intervals.
const SEED: u64 = 0x4C32_3153_6861_6465;

/// The time of one call: samples and their statistics, in nanoseconds.
///
/// Noise only adds time, rarely but a lot. How much does not affect medians and quartiles.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Timing {
    /// The median.
    pub median_ns: f64,
    /// The least time: what an undisturbed machine can do.
    pub min_ns: f64,
    /// The lower quartile.
    pub p25_ns: f64,
    /// The upper quartile.
    pub p75_ns: f64,
    /// The interquartile range divided by the median; 0 if the median is 0.
    pub spread: f64,
    /// All samples in the order of the rounds. Each is the mean of `calls_per_sample` calls.
    pub samples_ns: Vec<f64>,
    /// The number of calls per sample: more than one if a single call is too short for the clock.
    pub calls_per_sample: u32,
}

impl Timing {
    /// Returns the statistics of `samples_ns`, or `None` if there are no samples, or one is
    /// negative or not finite.
    pub fn of(samples_ns: Vec<f64>, calls_per_sample: u32) -> Option<Timing> {
        if samples_ns.is_empty() || !samples_ns.iter().all(|s| s.is_finite() && *s >= 0.0) {
            return None;
        }
        let mut sorted = samples_ns.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        let [p25_ns, median_ns, p75_ns] = [0.25, 0.5, 0.75].map(|p| quantile(&sorted, p));
        let spread = match median_ns {
            0.0 => 0.0,
            median => (p75_ns - p25_ns) / median,
        };
        Some(Timing {
            median_ns,
            min_ns: sorted[0],
            p25_ns,
            p75_ns,
            spread,
            samples_ns,
            calls_per_sample,
        })
    }
}

/// Returns the quantile `p`, 0..=1, of ascending values, with linear interpolation (type 7 of
/// Hyndman & Fan 1996, the default of R and NumPy).
fn quantile(sorted: &[f64], p: f64) -> f64 {
    let place = p * (sorted.len() - 1) as f64;
    let below = place as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

/// The ratio of a candidate's speed to a baseline's, with an interval at the level [`CONFIDENCE`].
///
/// Over 1 means faster than the baseline, under 1 slower.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ratio {
    /// The median over the rounds of the baseline's time divided by the candidate's.
    pub median: f64,
    /// The lower end of the interval.
    pub low: f64,
    /// The upper end of the interval.
    pub high: f64,
    /// True if the interval contains 1, so that the samples do not show which of the two is faster.
    pub tie: bool,
}

impl Ratio {
    /// Makes a ratio from its interval and median.
    pub fn new(low: f64, median: f64, high: f64) -> Ratio {
        Ratio {
            median,
            low,
            high,
            tie: low <= 1.0 && 1.0 <= high,
        }
    }

    /// Returns the ratio of the candidate's speed to the baseline's. The slices hold the times;
    /// samples of one round have the same index.
    ///
    /// The interval is a percentile bootstrap of the median over whole rounds, with a fixed seed.
    /// Leaves out rounds without a partner and rounds in which a time is not positive. Returns
    /// `None` if no round is left.
    pub fn paired(baseline: &[f64], candidate: &[f64]) -> Option<Ratio> {
        let rounds = baseline.iter().zip(candidate).map(|(b, c)| b / c);
        let is_ratio = |ratio: &f64| ratio.is_finite() && *ratio > 0.0;
        let mut ratios: Vec<f64> = rounds.filter(is_ratio).collect();
        if ratios.is_empty() {
            return None;
        }
        let mut random = SplitMix(SEED);
        let mut resample = ratios.clone();
        // Maps 64 random bits to an index, by multiplying and keeping the high bits.
        let mut any = || ((u128::from(random.next()) * ratios.len() as u128) >> 64) as usize;
        let resampled = |_| {
            resample.fill_with(|| ratios[any()]);
            median(&mut resample)
        };
        let mut medians: Vec<f64> = (0..RESAMPLES).map(resampled).collect();
        medians.sort_unstable_by(f64::total_cmp);
        let tail = (1.0 - CONFIDENCE) / 2.0;
        let (low, high) = (quantile(&medians, tail), quantile(&medians, 1.0 - tail));
        Some(Ratio::new(low, median(&mut ratios), high))
    }
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    quantile(values, 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    #[test]
    fn medians_and_quartiles_are_those_of_numpy() {
        // numpy.percentile([40, 10, 30, 20], [25, 50, 75]) = [17.5, 25, 32.5]
        let timing = Timing::of(vec![40.0, 10.0, 30.0, 20.0], 1).unwrap();
        assert_eq!(
            (
                timing.min_ns,
                timing.p25_ns,
                timing.median_ns,
                timing.p75_ns
            ),
            (10.0, 17.5, 25.0, 32.5)
        );
        assert_eq!(timing.spread, 15.0 / 25.0);
        assert_eq!(
            timing.samples_ns,
            [40.0, 10.0, 30.0, 20.0],
            "in the order of their rounds"
        );
        let one = Timing::of(vec![7.0], 3).unwrap();
        assert_eq!(
            (
                one.min_ns,
                one.p25_ns,
                one.median_ns,
                one.p75_ns,
                one.spread
            ),
            (7.0, 7.0, 7.0, 7.0, 0.0)
        );
        assert_eq!(
            Timing::of(vec![0.0, 0.0], 1).unwrap().spread,
            0.0,
            "not 0/0"
        );
    }

    #[test]
    fn a_sample_that_is_not_a_time_gives_no_timing() {
        for samples in [vec![], vec![1.0, f64::NAN], vec![f64::INFINITY], vec![-1.0]] {
            assert_eq!(Timing::of(samples, 1), None);
        }
    }

    #[test]
    fn one_disturbed_sample_moves_no_median() {
        let calm = Timing::of(vec![10.0, 11.0, 12.0, 13.0, 14.0], 1).unwrap();
        let disturbed = Timing::of(vec![10.0, 11.0, 12.0, 13.0, 9000.0], 1).unwrap();
        assert_eq!(
            (calm.median_ns, calm.p75_ns),
            (disturbed.median_ns, disturbed.p75_ns)
        );
    }

    #[test]
    fn over_one_is_faster_than_the_baseline() {
        let baseline = [300.0, 330.0, 310.0, 290.0, 305.0, 320.0];
        let candidate = [100.0, 111.0, 102.0, 98.0, 103.0, 106.0];
        let faster = Ratio::paired(&baseline, &candidate).unwrap();
        assert!(
            faster.median > 2.9 && faster.low > 2.9 && faster.high < 3.1,
            "{faster:?}"
        );
        assert!(!faster.tie);
        let slower = Ratio::paired(&candidate, &baseline).unwrap();
        assert!(slower.high < 0.35 && !slower.tie, "{slower:?}");
    }

    #[test]
    fn rounds_that_slow_both_down_do_not_move_the_ratio() {
        let baseline = [200.0, 204.0, 400.0, 410.0, 800.0, 202.0];
        let candidate = [100.0, 102.0, 200.0, 205.0, 400.0, 101.0];
        let ratio = Ratio::paired(&baseline, &candidate).unwrap();
        assert_eq!((ratio.low, ratio.median, ratio.high), (2.0, 2.0, 2.0));
    }

    #[test]
    fn rounds_that_disagree_are_a_tie() {
        let baseline = [100.0; 8];
        let candidate = [90.0, 111.0, 95.0, 106.0, 93.0, 108.0, 97.0, 103.0];
        let ratio = Ratio::paired(&baseline, &candidate).unwrap();
        assert!(
            ratio.low < 1.0 && ratio.high > 1.0 && ratio.tie,
            "{ratio:?}"
        );
        assert!(ratio.low <= ratio.median && ratio.median <= ratio.high);
        assert_eq!(
            Ratio::paired(&baseline, &candidate),
            Some(ratio),
            "the seed is fixed"
        );
    }

    #[test]
    fn the_ratio_of_something_to_itself_is_one() {
        let samples = [100.0, 170.0, 90.0, 400.0, 110.0];
        let ratio = Ratio::paired(&samples, &samples).unwrap();
        assert_eq!(
            (ratio.low, ratio.median, ratio.high, ratio.tie),
            (1.0, 1.0, 1.0, true)
        );
    }

    #[test]
    fn with_few_rounds_the_interval_reaches_from_end_to_end() {
        // In 5.8 % of all resamples, at least three of the five rounds are the lowest one. That is
        // over 2.5 %, so the 2.5 % quantile of the medians is the lowest ratio itself. The same
        // holds for the highest.
        let candidate = [100.0, 200.0, 50.0, 80.0, 125.0];
        let ratio = Ratio::paired(&[100.0; 5], &candidate).unwrap();
        assert_eq!((ratio.low, ratio.median, ratio.high), (0.5, 1.0, 2.0));
    }

    #[test]
    fn rounds_without_a_time_are_left_out() {
        assert_eq!(Ratio::paired(&[], &[1.0]), None);
        assert_eq!(Ratio::paired(&[0.0, 1.0], &[1.0, 0.0]), None);
        let ratio = Ratio::paired(&[0.0, 6.0, 5.0], &[1.0, 3.0]).unwrap();
        assert_eq!((ratio.low, ratio.median, ratio.high), (2.0, 2.0, 2.0));
    }
}
