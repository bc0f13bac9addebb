//! The timing loop: samples the candidates in rounds, in random order.

use super::clock::{Clock, End, Moment};
use super::interruptions::{LONG_NS, Sample};
use super::times::{FEW_RESAMPLES, RESAMPLES, Times};
use crate::split_mix::SplitMix;
use alloc::boxed::Box;
use alloc::vec::Vec;
use std::time::Duration;

/// A function to time. It should pass its results through [`core::hint::black_box`], or the
/// compiler may remove the work.
pub type Candidate<'a> = Box<dyn FnMut() + 'a>;

/// The limits of a timing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeLimits {
    /// No round starts after this much time. Warm-up does not count.
    pub time_budget: Duration,
    /// The largest number of rounds.
    pub rounds: usize,
    /// The number of rounds before the first that counts, in which caches, branch predictors and
    /// the clock frequency settle.
    pub warm_up_rounds: usize,
}

impl TimeLimits {
    /// The smallest number of rounds, whatever the limits. Most candidates have two samples in
    /// each.
    pub const LEAST_ROUNDS: usize = 3;
}

impl Default for TimeLimits {
    /// Returns limits of 5 seconds, after two rounds of warm-up.
    fn default() -> Self {
        TimeLimits {
            time_budget: Duration::from_secs(5),
            rounds: usize::MAX,
            warm_up_rounds: 2,
        }
    }
}

/// The shortest sample, in ns: hundreds of times the cost of reading the clocks.
const LEAST_SAMPLE_NS: u64 = 200_000;

/// The largest number of calls per sample. A call that would need more is as short as the loop
/// around it.
const MOST_CALLS: u64 = 10_000;

/// A candidate runs for about this long, in ns, before its first sample, because it finds the
/// caches and the branch predictor full of what ran before: see docs/performance.md.
const SETTLING_NS: f64 = LONG_NS;

/// After this many samples a candidate is within 5 % of its steady time, however short: most are
/// within 1 %, and candidates of one kind are off the same way.
const MOST_SETTLING: f64 = 3.0;

/// How a candidate takes its turn in a round.
struct Turn {
    /// The calls in a sample.
    calls: u64,
    /// The samples that do not count, until it has settled.
    settling: usize,
    /// The samples that count.
    samples: usize,
}

impl Turn {
    /// Returns the turn of a candidate that takes `ns`.
    fn of(ns: f64) -> Turn {
        let calls = LEAST_SAMPLE_NS
            .div_ceil((ns as u64).max(1))
            .clamp(1, MOST_CALLS);
        let sample_ns = ns * calls as f64;
        // Long ones settle within themselves.
        let is_long = sample_ns >= LONG_NS;
        let settling = libm::round(SETTLING_NS / sample_ns).clamp(1.0, MOST_SETTLING) as usize;
        Turn {
            calls,
            settling: if is_long { 0 } else { settling },
            samples: if is_long { 1 } else { 2 },
        }
    }
}

/// A ratio counts as known, and needs no more samples, when half its interval is at most this part
/// of it.
const KNOWN: f64 = 0.025;

/// Times all candidates in rounds, for at least [`TimeLimits::LEAST_ROUNDS`] of them, until one of
/// the limits is reached or all `ratios` are known: pairs of a baseline and a candidate.
///
/// Every round takes the candidates in another random order. (A fixed order falls into step with
/// the system's time slices, and always the same candidate is interrupted.) In its turn a candidate
/// first settles, then it is sampled twice; a long one does not settle, and is sampled once. One
/// too short for the clock is called several times per sample.
///
/// Calls `progress` between rounds with the used part of the limits, 0..=1. The time that it takes
/// does not count.
pub fn time_interleaved(
    clock: Clock,
    candidates: &mut [Candidate<'_>],
    ratios: &[(usize, usize)],
    limits: TimeLimits,
    progress: impl FnMut(f32),
) -> Times {
    let read = |end| clock.read(end);
    run(clock, read, candidates, ratios, limits, progress)
}

/// Does the work of [`time_interleaved`] with readings of a clock.
fn run(
    clock: Clock,
    mut read: impl FnMut(End) -> Moment,
    candidates: &mut [Candidate<'_>],
    ratios: &[(usize, usize)],
    limits: TimeLimits,
    mut progress: impl FnMut(f32),
) -> Times {
    let mut sample = |candidate: &mut Candidate<'_>, calls: u64| {
        let first = read(End::First);
        for _ in 0..calls {
            candidate();
        }
        let last = read(End::Last);
        let sample = Sample {
            ns: clock.time(first, last),
            work_ns: (last.own - first.own) as f64,
            is_interrupted: clock.is_interrupted(first, last),
            ..Sample::default()
        };
        (sample, (last.passed - first.passed) as f64)
    };
    // The least time of the warm-up rounds sets the turns.
    let mut least: Vec<f64> = candidates.iter().map(|_| f64::INFINITY).collect();
    for _ in 0..limits.warm_up_rounds.max(1) {
        for (candidate, least) in candidates.iter_mut().zip(&mut least) {
            *least = least.min(sample(candidate, 1).0.ns);
        }
    }
    let turns: Vec<Turn> = least.into_iter().map(Turn::of).collect();
    let calls: Vec<u64> = turns.iter().map(|turn| turn.calls).collect();
    let mut samples: Vec<Vec<Sample>> = candidates.iter().map(|_| Vec::new()).collect();
    let most = limits.rounds.max(TimeLimits::LEAST_ROUNDS);
    let budget = limits.time_budget.as_nanos() as f64;
    let mut random = SplitMix(ORDER_SEED);
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    // Only the time in samples counts, not the time in `progress`.
    let mut spent = 0.0;
    let mut next_look = TimeLimits::LEAST_ROUNDS;
    for round in 0..most {
        let part = (spent / budget).max(round as f64 / most as f64);
        progress(part.min(1.0) as f32);
        if round >= TimeLimits::LEAST_ROUNDS && spent >= budget {
            break;
        }
        if round == next_look && !ratios.is_empty() {
            let times = Times::new(samples.clone(), calls.clone(), clock, FEW_RESAMPLES);
            if times.know(ratios, KNOWN) {
                break;
            }
            // Looking takes time, too, and a few rounds more change little.
            next_look += next_look.div_ceil(2);
        }
        random.shuffle(&mut order);
        for &i in &order {
            let turn = &turns[i];
            for _ in 0..turn.settling {
                spent += sample(&mut candidates[i], turn.calls).1;
            }
            for _ in 0..turn.samples {
                let (taken, passed) = sample(&mut candidates[i], turn.calls);
                spent += passed;
                samples[i].push(Sample { round, ..taken });
            }
        }
    }
    progress(1.0);
    Times::new(samples, calls, clock, RESAMPLES)
}

/// The seed of the order, so that every run has the same.
const ORDER_SEED: u64 = 0x4F72_6465_7273;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::timing::Trust;
    use alloc::rc::Rc;
    use alloc::string::String;
    use alloc::vec;
    use core::cell::{Cell, RefCell};

    const FOREVER: TimeLimits = TimeLimits {
        time_budget: Duration::MAX,
        rounds: 6,
        warm_up_rounds: 1,
    };

    /// A clock that only candidates advance, and a log of the letters of the candidates that ran.
    #[derive(Default)]
    struct Stage {
        own: Rc<Cell<u64>>,
        waited: Rc<Cell<u64>>,
        log: Rc<RefCell<String>>,
        told: Vec<f32>,
    }

    impl Stage {
        fn candidate(
            &self,
            letter: char,
            mut ns: impl FnMut() -> u64 + 'static,
        ) -> Candidate<'static> {
            let (own, log) = (self.own.clone(), self.log.clone());
            Box::new(move || {
                own.set(own.get() + ns());
                log.borrow_mut().push(letter);
            })
        }

        /// Returns a candidate of this time. Other programs interrupt it for 4 ms now and then, by
        /// the part `interrupted` of the calls, and then it takes `cost_ns` longer.
        fn interrupted(&self, ns: u64, interrupted: f64, cost_ns: u64) -> Candidate<'static> {
            let mut random = SplitMix(ns);
            let waited = self.waited.clone();
            self.candidate('i', move || {
                // Like a real time, none is equal to another.
                let part = |random: &mut SplitMix| random.below(1_000) as f64 / 1_000.0;
                let time = ns as f64 * (1.0 + 0.01 * part(&mut random));
                let mut time = time as u64;
                if part(&mut random) < interrupted {
                    waited.set(waited.get() + 4_000_000);
                    time += cost_ns;
                }
                time
            })
        }

        fn run(
            &mut self,
            candidates: &mut [Candidate<'_>],
            ratios: &[(usize, usize)],
            limits: TimeLimits,
        ) -> Times {
            let read = |_| Moment {
                passed: self.own.get() + self.waited.get(),
                own: self.own.get(),
                waited: None,
            };
            let hear = |part| {
                self.told.push(part);
                self.log.borrow_mut().push(' ');
            };
            run(Clock::new(1), read, candidates, ratios, limits, hear)
        }
    }

    #[test]
    fn in_a_round_everyone_settles_and_is_sampled_twice_in_random_order() {
        let mut stage = Stage::default();
        let mut candidates =
            ['A', 'B', 'C'].map(|letter| stage.candidate(letter, || LEAST_SAMPLE_NS));
        let limits = TimeLimits {
            rounds: 60,
            ..FOREVER
        };
        let times = stage.run(&mut candidates, &[], limits);
        let log = stage.log.borrow();
        let rounds: Vec<&str> = log.split_whitespace().skip(1).collect();
        assert_eq!(rounds.len(), 60);
        for order in ["ABC", "ACB", "BAC", "BCA", "CAB", "CBA"] {
            let turns: String = order.chars().flat_map(|letter| [letter; 3 + 2]).collect();
            let count = rounds.iter().filter(|round| **round == turns).count();
            // Ten are expected, with a deviation of 2.9.
            assert!((2..=20).contains(&count), "{order} {count} times");
        }
        let timing = times.timing(1);
        assert_eq!(
            (timing.samples_ns.len(), timing.samples_per_round),
            (120, 2)
        );
    }

    #[test]
    fn short_candidates_settle_and_have_two_samples_in_a_round() {
        let each = |ns| {
            let mut stage = Stage::default();
            let times = stage.run(&mut [stage.candidate('x', move || ns)], &[], FOREVER);
            let calls = stage.log.borrow().matches('x').count();
            // One call of warm-up, and six rounds.
            ((calls - 1) / 6, times.timing(0).samples_per_round)
        };
        let long = LONG_NS as u64;
        assert_eq!(each(long / 4), (3 + 2, 2));
        assert_eq!(each(long / 2), (2 + 2, 2));
        assert_eq!(each(long - 1), (1 + 2, 2));
        assert_eq!(each(long), (1, 1));
    }

    #[test]
    fn short_calls_are_repeated_and_stated_each() {
        let mut stage = Stage::default();
        let mut candidates = [stage.candidate('a', || 60_000), stage.candidate('b', || 0)];
        let times = stage.run(&mut candidates, &[(0, 1)], FOREVER);
        let (a, b) = (times.timing(0), times.timing(1));
        assert_eq!(
            (a.calls_per_sample, a.typical_ns),
            (4, 60_000.0),
            "4 · 60 µs ≥ 200 µs"
        );
        assert_eq!(
            (u64::from(b.calls_per_sample), b.typical_ns),
            (MOST_CALLS, 0.0)
        );
        assert_eq!(times.ratio(0, 1), None, "no time was seen");
        assert_eq!(times.ratio(1, 0), None);
    }

    #[test]
    fn the_budget_ends_it_but_not_before_the_third_round() {
        let rounds = |budget_ms| {
            let mut stage = Stage::default();
            let limits = TimeLimits {
                time_budget: Duration::from_millis(budget_ms),
                rounds: 100,
                warm_up_rounds: 3,
            };
            let times = stage.run(&mut [stage.candidate('x', || 1_000_000)], &[], limits);
            times.noise(&[]).rounds
        };
        assert_eq!(rounds(0), TimeLimits::LEAST_ROUNDS);
        assert_eq!(
            rounds(40),
            8,
            "five calls a round, and warm-up takes nothing from it"
        );
        assert_eq!(rounds(1000), 100);
    }

    #[test]
    fn it_ends_when_all_ratios_are_known() {
        let rounds = |noise: u64| {
            let mut stage = Stage::default();
            let mut random = SplitMix(noise);
            let mut a = [
                stage.candidate('a', || 1_000_000),
                stage.candidate('b', move || 2_000_000 + noise * random.below(1_000) as u64),
            ];
            let limits = TimeLimits {
                rounds: 100,
                ..FOREVER
            };
            let times = stage.run(&mut a, &[(0, 1)], limits);
            assert!(times.know(&[(0, 1)], KNOWN) || times.noise(&[]).rounds == 100);
            times.noise(&[]).rounds
        };
        assert_eq!(rounds(0), TimeLimits::LEAST_ROUNDS, "nothing is uncertain");
        assert!(rounds(2_000) > TimeLimits::LEAST_ROUNDS);
    }

    /// The time of a candidate is found although other programs interrupt nine samples in ten, each
    /// of which then takes 60 µs longer.
    #[test]
    fn interruptions_move_no_ratio() {
        let limits = TimeLimits {
            rounds: 40,
            ..FOREVER
        };
        for part in [0.0, 0.3, 0.6, 0.9] {
            let mut stage = Stage::default();
            let mut candidates = [
                stage.interrupted(1_000_000, part, 60_000),
                stage.interrupted(3_000_000, part, 60_000),
                stage.interrupted(2_000_000, part, 60_000),
            ];
            let ratios = [(0, 1), (0, 2)];
            let times = stage.run(&mut candidates, &[], limits);
            for (candidate, truth) in [(1, 1.0 / 3.0), (2, 0.5)] {
                let ratio = times.ratio(0, candidate).unwrap();
                assert!(
                    ratio.low <= truth && truth <= ratio.high,
                    "{part}: {ratio:?}"
                );
                // Times differ by up to 1 %.
                assert!(
                    (ratio.typical / truth - 1.0).abs() < 0.01,
                    "{part}: {ratio:?}"
                );
                assert!(!ratio.tie, "{part}: {ratio:?}");
            }
            let noise = times.noise(&ratios);
            // Three standard deviations of 240 samples.
            assert!((noise.interrupted - part).abs() < 0.1, "{noise:?}");
            assert_eq!(noise.trust == Trust::Quiet, noise.interrupted < 0.05);
            assert!(noise.trust != Trust::TooBusy, "{noise:?}");
        }
    }

    /// A candidate has the interval of its own spread, not that of the many that are steady.
    #[test]
    fn a_noisy_candidate_has_a_wide_interval() {
        let mut stage = Stage::default();
        let spread = |by: usize| {
            let mut random = SplitMix(by as u64);
            move || 1_000_000 + random.below(by) as u64
        };
        let steady = ['a', 'b', 'c', 'd', 'e'].map(|letter| stage.candidate(letter, spread(5_000)));
        let mut candidates: Vec<Candidate<'_>> = steady.into();
        candidates.push(stage.candidate('n', spread(400_000)));
        let limits = TimeLimits {
            rounds: 30,
            ..FOREVER
        };
        let times = stage.run(&mut candidates, &[], limits);
        let doubt = |candidate| times.ratio(0, candidate).unwrap().doubt();
        // The lowest tenth of 60 values in 0 to 0.4 lies at 0.04, with a deviation of 0.4 √(0.1 ·
        // 0.9 / 60) = 0.015.
        assert!(doubt(5) > 0.03, "{}", doubt(5));
        assert!(doubt(1) < 0.02, "{}", doubt(1));
    }

    #[test]
    fn progress_climbs_to_one() {
        let mut stage = Stage::default();
        let limits = TimeLimits {
            time_budget: Duration::from_millis(30),
            rounds: 100,
            warm_up_rounds: 1,
        };
        stage.run(&mut [stage.candidate('x', || 1_000_000)], &[], limits);
        let told = &stage.told;
        assert_eq!((told[0], told[3], told.last()), (0.0, 0.5, Some(&1.0)));
        assert!(told.is_sorted());
        let mut stage = Stage::default();
        let none = TimeLimits {
            time_budget: Duration::ZERO,
            ..limits
        };
        stage.run(&mut [stage.candidate('x', || 1)], &[], none);
        let told = vec![stage.told];
        assert!(
            told[0].iter().all(|part| (0.0..=1.0).contains(part)),
            "{told:?}"
        );
    }

    #[test]
    fn nothing_to_time_takes_no_time() {
        let times = Stage::default().run(&mut [], &[], FOREVER);
        assert_eq!(times.timings().count(), 0);
    }
}
