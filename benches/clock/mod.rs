//! The clock of `fastphong bench` as criterion's: the thread's own processor time, which stands
//! still while other programs run; on several threads the time that passed.

use criterion::Criterion;
use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use fastphong_cli::compare::timing::{Clock, End, Moment};

/// Times of work on a number of threads, in nanoseconds.
pub struct OwnTime(Clock);

impl Measurement for OwnTime {
    type Intermediate = Moment;
    type Value = f64;

    fn start(&self) -> Moment {
        self.0.read(End::First)
    }

    fn end(&self, first: Moment) -> f64 {
        self.0.time(first, self.0.read(End::Last))
    }

    fn add(&self, a: &f64, b: &f64) -> f64 {
        a + b
    }

    fn zero(&self) -> f64 {
        0.0
    }

    fn to_f64(&self, ns: &f64) -> f64 {
        *ns
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        WallTime.formatter()
    }
}

/// Returns a benchmark manager for work on this many threads.
pub fn criterion(threads: usize) -> Criterion<OwnTime> {
    Criterion::default().with_measurement(OwnTime(Clock::new(threads)))
}
