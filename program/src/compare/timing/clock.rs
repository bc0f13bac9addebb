//! The clocks of a sample: the time that passed, and the time that the work had processors.

use std::time::Instant;

/// A moment on all clocks, in nanoseconds since some start of each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Moment {
    /// The time that passed.
    pub passed: u64,
    /// The time that the thread had a processor, or all threads of the process together; the time
    /// that passed, where the system does not say.
    pub own: u64,
    /// The time that several threads together waited for a processor. `None` where the system does
    /// not say, and for one thread, whose waiting is `passed` less `own`.
    pub waited: Option<u64>,
}

/// The end of a sample at which clocks are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Its beginning.
    First,
    /// Its last moment.
    Last,
}

/// A wait of more ns than this is an interruption. Readings of clocks, interrupts of the system and
/// a host's housekeeping take less, and time slices of other programs take longer: see
/// docs/reliability.md.
const LEAST_WAIT_NS: u64 = 100_000;

/// The clocks for work on one thread or on several.
///
/// On one thread a time is the thread's own processor time, which stands still while other programs
/// have the processor. On several threads it is the time that passed: processor time is the work of
/// all threads, and says nothing about how soon it was done.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    started: Instant,
    threads: usize,
}

impl Clock {
    /// True if the system has a fine clock for the time of a thread. (Windows has one of 15.6 ms.)
    pub const HAS_OWN: bool = cfg!(any(
        target_os = "linux",
        target_os = "android",
        target_os = "macos",
        target_os = "freebsd"
    ));

    /// Starts the clocks for work of the calling thread, if `threads` is 1, or of the whole
    /// process.
    pub fn new(threads: usize) -> Clock {
        Clock {
            started: Instant::now(),
            threads,
        }
    }

    /// Returns the number of threads of the work.
    pub fn threads(&self) -> usize {
        self.threads
    }

    /// True if a time is the thread's own.
    pub fn is_own(&self) -> bool {
        Clock::HAS_OWN && self.threads == 1
    }

    /// Returns the name of the clock that counts: `thread` or `passed`.
    pub fn name(&self) -> &'static str {
        if self.is_own() { "thread" } else { "passed" }
    }

    /// Returns the time between two moments that counts, in ns.
    pub fn time(&self, first: Moment, last: Moment) -> f64 {
        if self.is_own() {
            (last.own - first.own) as f64
        } else {
            (last.passed - first.passed) as f64
        }
    }

    /// Returns true if other programs had the processor between two moments for so long that it was
    /// an interruption.
    pub fn is_interrupted(&self, first: Moment, last: Moment) -> bool {
        let waited = if self.is_own() {
            (last.passed - first.passed).saturating_sub(last.own - first.own)
        } else {
            let both = last.waited.zip(first.waited);
            both.map_or(0, |(last, first)| last.saturating_sub(first))
        };
        waited > LEAST_WAIT_NS
    }

    /// True if this clock sees interruptions.
    pub fn sees_interruptions(&self) -> bool {
        self.is_own() || self.waited().is_some()
    }

    /// Reads all clocks at an end of a sample: the one that counts innermost, so that a switch to
    /// another program between two readings is no part of it.
    pub fn read(&self, end: End) -> Moment {
        let mut moment = Moment::default();
        if end == End::First {
            moment.waited = self.waited();
        }
        if self.is_own() == (end == End::First) {
            moment.passed = self.passed();
            moment.own = processor_time(self.threads).unwrap_or(moment.passed);
        } else {
            let own = processor_time(self.threads);
            moment.passed = self.passed();
            moment.own = own.unwrap_or(moment.passed);
        }
        if end == End::Last {
            moment.waited = self.waited();
        }
        moment
    }

    fn passed(&self) -> u64 {
        // 584 years of nanoseconds fit.
        self.started.elapsed().as_nanos() as u64
    }

    /// Reads how long threads waited for a processor. More threads than processors wait for each
    /// other, which says nothing about other programs.
    fn waited(&self) -> Option<u64> {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        let have_one_each = (2..=processors).contains(&self.threads);
        have_one_each.then(waited_for_processors).flatten()
    }
}

#[cfg(any(
    target_os = "linux",
    target_os = "android",
    target_os = "macos",
    target_os = "freebsd"
))]
fn processor_time(threads: usize) -> Option<u64> {
    use rustix::time::{ClockId, clock_gettime};
    let time = clock_gettime(match threads {
        1 => ClockId::ThreadCPUTime,
        _ => ClockId::ProcessCPUTime,
    });
    Some(time.tv_sec as u64 * 1_000_000_000 + time.tv_nsec as u64)
}

#[cfg(not(any(
    target_os = "linux",
    target_os = "android",
    target_os = "macos",
    target_os = "freebsd"
)))]
fn processor_time(_: usize) -> Option<u64> {
    None
}

/// Returns the time that the threads of this process could have run, but other programs had the
/// processors, summed over threads: the second number of `/proc/self/task/*/schedstat`.
#[cfg(any(target_os = "linux", target_os = "android"))]
fn waited_for_processors() -> Option<u64> {
    let mut sum = 0;
    for task in std::fs::read_dir("/proc/self/task").ok()?.flatten() {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        sum += text.split_whitespace().nth(1)?.parse::<u64>().ok()?;
    }
    Some(sum)
}

#[cfg(not(any(target_os = "linux", target_os = "android")))]
fn waited_for_processors() -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::hint::black_box;

    #[test]
    fn the_own_time_stands_still_in_sleep() {
        let clock = Clock::new(1);
        let first = clock.read(End::First);
        std::thread::sleep(std::time::Duration::from_millis(20));
        let last = clock.read(End::Last);
        assert!(last.passed - first.passed >= 20_000_000);
        // Falling asleep and waking up take some microseconds.
        let own = last.own - first.own;
        assert!(own < 10_000_000 || !clock.is_own(), "{own}");
    }

    #[test]
    fn a_time_slice_is_an_interruption_and_an_interrupt_is_none() {
        let moment = |passed, own, waited| Moment {
            passed,
            own,
            waited: Some(waited),
        };
        let first = moment(10, 20, 30);
        let (one, several) = (Clock::new(1), Clock::new(2));
        let after =
            |passed: u64, own: u64| one.is_interrupted(first, moment(10 + passed, 20 + own, 30));
        assert!(!after(500_000, 498_000));
        assert_eq!(after(4_500_000, 500_000), one.is_own());
        // The clocks have different resolutions, so own time may be longer.
        assert!(!after(500_000, 501_000));
        let after = |ns: u64| several.is_interrupted(first, moment(4_500_010, 500_020, 30 + ns));
        assert!(!after(2_000) && after(4_000_000));
        assert_eq!(several.time(first, moment(510, 920, 30)), 500.0);
    }

    #[test]
    fn work_moves_every_clock() {
        for threads in [1, 2] {
            let clock = Clock::new(threads);
            let first = clock.read(End::First);
            let mut last = first;
            let mut sum = 0u64;
            while last.own == first.own {
                (0..100_000).for_each(|i| sum = black_box(sum + i));
                last = clock.read(End::Last);
            }
            assert!(last.passed > first.passed && last.waited >= first.waited);
        }
    }
}
