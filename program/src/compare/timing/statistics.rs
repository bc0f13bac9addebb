//! Statistics of samples: quantiles, and ratios of speeds with their intervals.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// The quantile of its samples that stands for a candidate. Noise only adds time. Of few samples
/// this is about the mean of the least two, and of many it does not hang on the luckiest.
pub const TYPICAL: f64 = 0.1;

/// The time of one call: samples and their statistics, in nanoseconds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Timing {
    /// The lowest tenth of the samples, after the cost of an interruption is taken off those that
    /// were interrupted: what the call takes by itself.
    pub typical_ns: f64,
    /// The lower end of the 95 % interval of that.
    pub low_ns: f64,
    /// The upper end.
    pub high_ns: f64,
    /// The median.
    pub median_ns: f64,
    /// The least time.
    pub min_ns: f64,
    /// The lower quartile.
    pub p25_ns: f64,
    /// The upper quartile.
    pub p75_ns: f64,
    /// All samples in the order of the rounds. Each is the mean of `calls_per_sample` calls.
    pub samples_ns: Vec<f64>,
    /// The number of samples in each round: 1 or 2.
    pub samples_per_round: usize,
    /// The number of samples in which other programs had the processor.
    pub interrupted: usize,
    /// The number of calls per sample: more than one if a single call is too short for the clock.
    pub calls_per_sample: u32,
}

impl Timing {
    /// Returns the statistics of `samples_ns`, one of each round and none interrupted, without an
    /// interval. Returns `None` if there are no samples, or one is negative or not finite.
    pub fn of(samples_ns: Vec<f64>, calls_per_sample: u32) -> Option<Timing> {
        if samples_ns.is_empty() || !samples_ns.iter().all(|s| s.is_finite() && *s >= 0.0) {
            return None;
        }
        let mut order = samples_ns.clone();
        let [typical_ns, min_ns, p25_ns, median_ns, p75_ns] =
            [TYPICAL, 0.0, 0.25, 0.5, 0.75].map(|p| quantile(&mut order, p));
        Some(Timing {
            typical_ns,
            low_ns: typical_ns,
            high_ns: typical_ns,
            median_ns,
            min_ns,
            p25_ns,
            p75_ns,
            samples_ns,
            samples_per_round: 1,
            interrupted: 0,
            calls_per_sample,
        })
    }

    /// Returns half the interval of the typical time, as a part of it; 0 if no time was seen.
    pub fn doubt(&self) -> f64 {
        if self.typical_ns > 0.0 {
            (self.high_ns - self.low_ns) / 2.0 / self.typical_ns
        } else {
            0.0
        }
    }
}

/// Returns the quantile `p`, 0..=1, of `values`, with linear interpolation (type 7 of Hyndman & Fan
/// 1996, the default of R and NumPy), or 0 if there are none. Changes their order.
pub fn quantile(values: &mut [f64], p: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let place = p * (values.len() - 1) as f64;
    let (_, below, above) = values.select_nth_unstable_by(place as usize, f64::total_cmp);
    let below = *below;
    let above = above.iter().copied().fold(f64::INFINITY, f64::min);
    match place.fract() {
        0.0 => below,
        part => below + part * (above - below),
    }
}

/// The ratio of a candidate's speed to a baseline's, with its 95 % interval.
///
/// Over 1 means faster than the baseline, under 1 slower.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct Ratio {
    /// The baseline's typical time divided by the candidate's.
    pub typical: f64,
    /// The lower end of the interval.
    pub low: f64,
    /// The upper end of the interval.
    pub high: f64,
    /// True if the samples do not show which of the two is faster: see [`Ratio::SURE`].
    pub tie: bool,
}

impl Ratio {
    /// How many times as wide as the 95 % interval the one is that must not contain 1 where one of
    /// two is called faster. Of a thousand comparisons of equals at most two may be wrong, one to
    /// each side, which are 3.09 standard deviations in place of 1.96.
    pub const SURE: f64 = 3.09 / 1.96;

    /// Makes a ratio from its interval and typical value, which are positive.
    pub fn new(low: f64, typical: f64, high: f64) -> Ratio {
        let wider = |end: f64| typical * libm::pow(end / typical, Ratio::SURE);
        Ratio {
            typical,
            low,
            high,
            tie: wider(low) <= 1.0 && 1.0 <= wider(high),
        }
    }

    /// Returns the geometric means of ratios and of the ends of their intervals. There is at least
    /// one.
    pub fn mean(ratios: &[Ratio]) -> Ratio {
        if let [one] = ratios {
            return *one;
        }
        let mean = |value: fn(&Ratio) -> f64| {
            let sum: f64 = ratios.iter().map(|ratio| libm::log(value(ratio))).sum();
            libm::exp(sum / ratios.len() as f64)
        };
        Ratio::new(mean(|r| r.low), mean(|r| r.typical), mean(|r| r.high))
    }

    /// Says whether the candidate is `faster` or `slower` than the baseline; `tie` if the samples
    /// do not show it.
    pub fn word(&self) -> &'static str {
        match self {
            Ratio { tie: true, .. } => "tie",
            Ratio { typical, .. } if *typical > 1.0 => "faster",
            _ => "slower",
        }
    }

    /// Returns half the interval, as a part of the ratio.
    pub fn doubt(&self) -> f64 {
        (self.high - self.low) / 2.0 / self.typical
    }

    /// Returns the ratio and its interval for a table. A `=` before them says that it is a tie.
    pub fn cell(&self) -> String {
        let Ratio { low, high, tie, .. } = *self;
        let known = self.known().unwrap_or_else(|| "–".to_string());
        // The baseline against itself has no interval.
        if low == high {
            return known;
        }
        let tie = if tie { "= " } else { "" };
        format!("{tie}{known} ({low:.2}–{high:.2})")
    }

    /// Writes the ratio with the digits that are known: as few decimals, at most two, as move it by
    /// no more than half its interval. Writes `about` before it if half the interval
    /// is over 5 % of the ratio, and nothing, `None`, if it is over 30 %.
    pub fn known(&self) -> Option<String> {
        let half = (self.high - self.low) / 2.0;
        let digits = match half {
            half if half >= 0.5 => 0,
            half if half >= 0.05 => 1,
            _ => 2,
        };
        let text = format!("{:.digits$}", self.typical);
        match self.doubt() {
            doubt if doubt > 0.3 => None,
            doubt if doubt > 0.05 => Some(format!("about {text}")),
            _ => Some(text),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    #[test]
    fn quantiles_are_those_of_numpy() {
        // numpy.percentile([40, 10, 30, 20], [10, 25, 50, 75]) = [13, 17.5, 25, 32.5]
        let timing = Timing::of(vec![40.0, 10.0, 30.0, 20.0], 1).unwrap();
        assert_eq!((timing.min_ns, timing.typical_ns), (10.0, 13.0));
        let quartiles = (timing.p25_ns, timing.median_ns, timing.p75_ns);
        assert_eq!(quartiles, (17.5, 25.0, 32.5));
        let order = [40.0, 10.0, 30.0, 20.0];
        assert_eq!(timing.samples_ns, order, "in the order of their rounds");
        let one = Timing::of(vec![7.0], 3).unwrap();
        assert_eq!((one.min_ns, one.typical_ns, one.p75_ns), (7.0, 7.0, 7.0));
    }

    #[test]
    fn a_sample_that_is_not_a_time_gives_no_timing() {
        for samples in [vec![], vec![1.0, f64::NAN], vec![f64::INFINITY], vec![-1.0]] {
            assert_eq!(Timing::of(samples, 1), None);
        }
    }

    #[test]
    fn faster_is_said_only_of_more_than_the_interval_separates() {
        assert!(!Ratio::new(1.1, 1.15, 1.2).tie && !Ratio::new(0.8, 0.85, 0.9).tie);
        assert!(Ratio::new(0.99, 1.01, 1.03).tie);
        // The interval ends 2 % from 1.05, and the wider one 3.2 %.
        assert!(!Ratio::new(1.03, 1.05, 1.07).tie);
        assert!(
            Ratio::new(1.01, 1.03, 1.05).tie,
            "1.03 / 1.01 to the power of 1.58 is 1.031"
        );
        assert!(Ratio::new(1.0, 1.0, 1.0).tie);
    }

    #[test]
    fn a_ratio_prints_the_digits_that_are_known() {
        let text = |low, typical, high| Ratio::new(low, typical, high).known();
        assert_eq!(text(0.29, 0.301, 0.31).as_deref(), Some("0.30"));
        assert_eq!(text(1.03, 1.05, 1.07).as_deref(), Some("1.05"));
        assert_eq!(text(1.37, 1.41, 1.45).as_deref(), Some("1.41"));
        assert_eq!(text(3.11, 3.2, 3.29).as_deref(), Some("3.2"));
        assert_eq!(text(12.0, 12.5, 13.0).as_deref(), Some("12"));
        assert_eq!(text(0.9, 1.1, 1.3).as_deref(), Some("about 1.1"));
        assert_eq!(text(2.01, 18.79, 41.44), None);
    }
}
