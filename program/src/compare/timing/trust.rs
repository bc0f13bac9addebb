//! How far to trust the times of a run.

use super::clock::Clock;
use alloc::format;
use alloc::string::String;
use serde::Serialize;

/// How far to trust a table of times, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Trust {
    /// Next to no other program ran, and ratios are known.
    Quiet,
    /// Other programs ran, and ratios are known all the same.
    Busy,
    /// Ratios are not known, because of other programs or of something else.
    TooBusy,
}

/// The noise of a run: what disturbed it, and how far its ratios are known.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Noise {
    /// One word.
    pub trust: Trust,
    /// `thread`: times are the thread's own processor time. `passed`: times passed.
    pub clock: &'static str,
    /// The part of the samples, 0..=1, in which other programs had the processor.
    pub interrupted: f64,
    /// The number of rounds.
    pub rounds: usize,
    /// The cost of an interruption, in ns: it is taken off the samples that were interrupted.
    pub cost_ns: f64,
    /// Half the interval of a ratio as a part of it: the median over all ratios.
    pub doubt: f64,
    /// All of this in a sentence, without its full stop.
    pub sentence: String,
}

/// The largest median doubt with which a table says something.
const MOST_DOUBT: f64 = 0.05;

/// The largest part of interrupted samples on a quiet machine.
const QUIET_INTERRUPTED: f64 = 0.05;

/// The largest part of interrupted samples of times that passed. The lowest tenth must lie among
/// those that were not interrupted, with more than twice as many to choose from.
const MOST_INTERRUPTED: f64 = 0.75;

impl Noise {
    /// Judges a run by the part of its samples that was interrupted, and by the median doubt of its
    /// ratios.
    pub fn new(clock: Clock, interrupted: f64, rounds: usize, cost_ns: f64, doubt: f64) -> Noise {
        let is_lost = !clock.is_own() && interrupted > MOST_INTERRUPTED;
        let is_undisturbed = interrupted <= QUIET_INTERRUPTED;
        let is_seen = clock.sees_interruptions();
        let trust = if doubt > MOST_DOUBT || is_lost {
            Trust::TooBusy
        } else if is_undisturbed && is_seen {
            Trust::Quiet
        } else {
            Trust::Busy
        };
        let share = if is_seen {
            format!("{} of the samples were interrupted", percent(interrupted))
        } else {
            "interruptions are not known here".into()
        };
        let ratios = format!("ratios ± {}", percent(doubt));
        let threads = clock.threads();
        let sentence = match trust {
            Trust::Quiet => format!("quiet: {share}; {ratios}"),
            Trust::Busy if !is_seen => format!("{share}; {ratios}"),
            Trust::Busy if clock.is_own() => {
                format!("busy: {share}; times are the thread’s own, {ratios}")
            }
            Trust::Busy => format!("busy: {share}; {ratios}"),
            Trust::TooBusy => {
                let word = if is_undisturbed { "noisy" } else { "busy" };
                let (place, cure) = if threads > 1 {
                    (format!(" on {threads} threads"), "--threads 1 can")
                } else {
                    let cure = "run again with five times the --time-budget, or on an idle machine";
                    (String::new(), cure)
                };
                format!("too {word} to tell{place}: {share}, {ratios}; {cure}")
            }
        };
        Noise {
            trust,
            clock: clock.name(),
            interrupted,
            rounds,
            cost_ns,
            doubt,
            sentence,
        }
    }
}

/// Writes a part as a percentage of two digits, or of one below 1 %.
fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    if percent < 9.95 {
        format!("{percent:.1} %")
    } else {
        format!("{percent:.0} %")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_says_what_can_be_trusted() {
        let said = |threads, interrupted, doubt| {
            let noise = Noise::new(Clock::new(threads), interrupted, 20, 0.0, doubt);
            (noise.trust, noise.sentence)
        };
        for threads in [1, 2] {
            if !Clock::new(threads).sees_interruptions() {
                let (trust, text) = said(threads, 0.0, 0.018);
                assert_eq!(trust, Trust::Busy);
                assert_eq!(text, "interruptions are not known here; ratios ± 1.8 %");
                return;
            }
        }
        let (quiet, text) = said(2, 0.004, 0.018);
        assert_eq!(quiet, Trust::Quiet);
        assert_eq!(
            text,
            "quiet: 0.4 % of the samples were interrupted; ratios ± 1.8 %"
        );
        let (busy, text) = said(2, 0.42, 0.026);
        assert_eq!(busy, Trust::Busy);
        assert_eq!(
            text,
            "busy: 42 % of the samples were interrupted; ratios ± 2.6 %"
        );
        let (lost, text) = said(2, 0.97, 0.026);
        assert_eq!(lost, Trust::TooBusy, "the lowest tenth may be interrupted");
        assert!(text.starts_with("too busy to tell on 2 threads: 97 % of the samples"));
        for (interrupted, word) in [(0.0, "noisy"), (0.5, "busy")] {
            let (trust, text) = said(1, interrupted, 0.12);
            assert_eq!(trust, Trust::TooBusy);
            assert!(text.starts_with(&format!("too {word} to tell: ")), "{text}");
            assert!(text.contains("ratios ± 12 %; run again with five times"));
        }
        if Clock::HAS_OWN {
            let (busy, text) = said(1, 0.97, 0.026);
            assert_eq!(busy, Trust::Busy);
            assert!(
                text.contains("times are the thread’s own, ratios ± 2.6 %"),
                "{text}"
            );
        }
    }

    #[test]
    fn percentages_have_two_digits() {
        let texts = [0.0, 0.004, 0.0994, 0.0995, 0.5, 1.0].map(percent);
        assert_eq!(texts, ["0.0 %", "0.4 %", "9.9 %", "10 %", "50 %", "100 %"]);
    }
}
