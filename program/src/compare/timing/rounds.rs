//! The timing loop: samples the candidates in rounds, in a different order each round.

use super::statistics::Timing;
use alloc::boxed::Box;
use alloc::vec::Vec;
use std::time::{Duration, Instant};

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
    /// The smallest number of rounds, whatever the limits. Quartiles of fewer samples say little.
    pub const LEAST_ROUNDS: usize = 5;
}

impl Default for TimeLimits {
    /// Returns limits of up to 101 rounds within 5 seconds, after two rounds of warm-up.
    fn default() -> Self {
        TimeLimits {
            time_budget: Duration::from_secs(5),
            rounds: 101,
            warm_up_rounds: 2,
        }
    }
}

/// The shortest sample, in ns: thousands of times the resolution of any clock and the cost of
/// reading it.
const LEAST_SAMPLE_NS: u64 = 200_000;

/// The largest number of calls per sample. A call that would need more is as short as the loop
/// around it.
const MOST_CALLS: u64 = 10_000;

/// Times all candidates in rounds, until one of the limits is reached, but for at least
/// [`TimeLimits::LEAST_ROUNDS`] rounds. Returns the timings in the order of the candidates.
///
/// Every round samples each candidate once. Rounds come in pairs, and the second round of a pair
/// runs in the reverse order of the first (A B C, C B A), so that a drift during a pair cancels
/// out. Each pair starts with another candidate, so that no candidate always has the same
/// neighbours or the same place. A candidate too short for the clock is called several times per
/// sample.
///
/// Calls `progress` between rounds with the used part of the limits, 0..=1. The time that it takes
/// does not count.
pub fn time_interleaved(
    candidates: &mut [Candidate<'_>],
    limits: TimeLimits,
    progress: impl FnMut(f32),
) -> Vec<Timing> {
    let start = Instant::now();
    // 584 years of nanoseconds fit.
    let now = || start.elapsed().as_nanos() as u64;
    run(candidates, limits, now, progress)
}

/// Does the work of [`time_interleaved`] with a clock that returns nanoseconds.
fn run(
    candidates: &mut [Candidate<'_>],
    limits: TimeLimits,
    mut now: impl FnMut() -> u64,
    mut progress: impl FnMut(f32),
) -> Vec<Timing> {
    let mut sample = |candidate: &mut Candidate<'_>, calls: u64| {
        let start = now();
        for _ in 0..calls {
            candidate();
        }
        now() - start
    };
    // Each warm-up round sets the number of calls per sample. The last one counts, because it is
    // the least disturbed.
    let mut calls: Vec<u64> = candidates.iter().map(|_| 1).collect();
    for _ in 0..limits.warm_up_rounds.max(1) {
        for (candidate, calls) in candidates.iter_mut().zip(&mut calls) {
            *calls = LEAST_SAMPLE_NS
                .div_ceil(sample(candidate, 1).max(1))
                .clamp(1, MOST_CALLS);
        }
    }
    let mut samples: Vec<Vec<f64>> = candidates.iter().map(|_| Vec::new()).collect();
    let most = limits.rounds.max(TimeLimits::LEAST_ROUNDS);
    let budget = limits.time_budget.as_nanos() as f64;
    // Only the time in samples counts, not the time in `progress`.
    let mut spent = 0.0;
    for round in 0..most {
        let part = (spent / budget).max(round as f64 / most as f64);
        progress(part.min(1.0) as f32);
        if round >= TimeLimits::LEAST_ROUNDS && spent >= budget {
            break;
        }
        for i in order(candidates.len(), round) {
            let ns = sample(&mut candidates[i], calls[i]);
            samples[i].push(ns as f64 / calls[i] as f64);
            spent += ns as f64;
        }
    }
    progress(1.0);
    let timing = |(samples, calls)| Timing::of(samples, calls as u32);
    let timings = samples.into_iter().zip(calls).map(timing);
    timings
        .collect::<Option<_>>()
        .expect("finite times of five rounds")
}

/// Returns the order of the candidates in a round. Each pair of rounds is rotated by one more
/// place, and its second round reversed.
fn order(candidates: usize, round: usize) -> impl Iterator<Item = usize> {
    let (turn, is_forth) = (round / 2, round.is_multiple_of(2));
    let place = move |i| if is_forth { i } else { candidates - 1 - i };
    (0..candidates).map(move |i| (place(i) + turn) % candidates)
}

#[cfg(test)]
mod tests {
    use super::*;
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
    struct Stage {
        clock: Rc<Cell<u64>>,
        log: Rc<RefCell<String>>,
    }

    impl Stage {
        fn new() -> Self {
            Stage {
                clock: Rc::default(),
                log: Rc::default(),
            }
        }

        fn candidate(
            &self,
            letter: char,
            mut ns: impl FnMut() -> u64 + 'static,
        ) -> Candidate<'static> {
            let (clock, log) = (self.clock.clone(), self.log.clone());
            Box::new(move || {
                clock.set(clock.get() + ns());
                log.borrow_mut().push(letter);
            })
        }

        fn run(&self, candidates: &mut [Candidate<'_>], limits: TimeLimits) -> Vec<Timing> {
            run(
                candidates,
                limits,
                || self.clock.get(),
                |_| self.log.borrow_mut().push(' '),
            )
        }
    }

    #[test]
    fn rounds_run_forth_and_back_and_begin_with_each_in_turn() {
        let stage = Stage::new();
        let mut candidates =
            ['A', 'B', 'C'].map(|letter| stage.candidate(letter, || LEAST_SAMPLE_NS));
        let timings = stage.run(&mut candidates, FOREVER);
        assert_eq!(
            *stage.log.borrow(),
            "ABC ABC CBA BCA ACB CAB BAC ",
            "warm-up, then six rounds"
        );
        assert!(timings.iter().all(|t| t.samples_ns.len() == 6));
    }

    #[test]
    fn samples_are_the_candidates_own_and_in_order() {
        let stage = Stage::new();
        let mut time = 300_000;
        let growing = stage.candidate('G', move || {
            time += 1;
            time
        });
        let timings = stage.run(&mut [stage.candidate('S', || 500_000), growing], FOREVER);
        assert_eq!(timings[0].samples_ns, [500_000.0; 6]);
        // The first call was the warm-up.
        assert_eq!(
            timings[1].samples_ns,
            [
                300_002.0, 300_003.0, 300_004.0, 300_005.0, 300_006.0, 300_007.0
            ]
        );
        assert_eq!(timings[1].calls_per_sample, 1);
    }

    #[test]
    fn short_calls_are_repeated_and_stated_each() {
        let stage = Stage::new();
        let timings = stage.run(
            &mut [stage.candidate('a', || 60_000), stage.candidate('b', || 0)],
            FOREVER,
        );
        assert_eq!(
            (timings[0].calls_per_sample, timings[0].median_ns),
            (4, 60_000.0),
            "4 · 60 µs ≥ 200 µs"
        );
        assert_eq!(
            (u64::from(timings[1].calls_per_sample), timings[1].median_ns),
            (MOST_CALLS, 0.0)
        );
    }

    #[test]
    fn the_budget_ends_it_but_not_before_the_fifth_round() {
        let rounds = |budget_ms| {
            let stage = Stage::new();
            let limits = TimeLimits {
                time_budget: Duration::from_millis(budget_ms),
                rounds: 100,
                warm_up_rounds: 3,
            };
            stage.run(&mut [stage.candidate('x', || 1_000_000)], limits)[0]
                .samples_ns
                .len()
        };
        assert_eq!(rounds(0), TimeLimits::LEAST_ROUNDS);
        assert_eq!(rounds(8), 8, "warm-up takes nothing from it");
        assert_eq!(rounds(1000), 100);
    }

    #[test]
    fn progress_climbs_to_one() {
        let stage = Stage::new();
        let mut told = vec![];
        let limits = TimeLimits {
            time_budget: Duration::from_millis(6),
            rounds: 100,
            warm_up_rounds: 1,
        };
        run(
            &mut [stage.candidate('x', || 1_000_000)],
            limits,
            || stage.clock.get(),
            |part| told.push(part),
        );
        assert_eq!((told[0], told[3], told.last()), (0.0, 0.5, Some(&1.0)));
        assert!(told.is_sorted());
        let mut none = vec![];
        let limits = TimeLimits {
            time_budget: Duration::ZERO,
            rounds: 0,
            warm_up_rounds: 0,
        };
        run(
            &mut [stage.candidate('x', || 1)],
            limits,
            || stage.clock.get(),
            |part| none.push(part),
        );
        assert!(
            none.iter().all(|part| (0.0..=1.0).contains(part)),
            "{none:?}"
        );
    }

    #[test]
    fn nothing_to_time_takes_no_time() {
        assert!(Stage::new().run(&mut [], FOREVER).is_empty());
    }
}
