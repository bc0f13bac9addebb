//! The typical time of work that is repeated.

use std::time::Duration;
use std::vec::Vec;

/// The last times of one kind of work.
#[derive(Clone, Debug, Default)]
pub struct Times {
    last: Vec<Duration>,
    next: usize,
}

/// How many times are kept.
const KEPT: usize = 24;

/// How many times are needed for a result. The first ones are slow, with cold caches and sleeping
/// threads.
const FEWEST: usize = 6;

impl Times {
    /// Adds a time. Replaces the oldest one if there are 24.
    pub fn add(&mut self, time: Duration) {
        match self.last.get_mut(self.next) {
            Some(oldest) => *oldest = time,
            None => self.last.push(time),
        }
        self.next = (self.next + 1) % KEPT;
    }

    /// Forgets all times.
    pub fn clear(&mut self) {
        *self = Times::default();
    }

    /// True if there are too few times for a result.
    pub fn are_few(&self) -> bool {
        self.last.len() < FEWEST
    }

    /// Returns the mean of the faster half, in milliseconds, or `None` if there are too few. Other
    /// programs disturb the slower half.
    pub fn milliseconds(&self) -> Option<f64> {
        if self.are_few() {
            return None;
        }
        let mut sorted = self.last.clone();
        sorted.sort_unstable();
        let half = sorted.len().div_ceil(2);
        let sum: Duration = sorted[..half].iter().sum();
        Some(1e3 * sum.as_secs_f64() / half as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lower_half_of_the_last_ones_counts() {
        let mut times = Times::default();
        let mut add = |milliseconds: &[u64]| {
            for ms in milliseconds {
                times.add(Duration::from_millis(*ms));
            }
            times.milliseconds()
        };
        assert_eq!(add(&[9, 1, 2, 3, 90]), None);
        assert_eq!(add(&[80]), Some(2.0));
        // 24 later none of these is left.
        assert_eq!(add(&[4; KEPT]), Some(4.0));
        assert_eq!(add(&[1; KEPT / 2]), Some(1.0));
        times.clear();
        assert!(times.are_few());
    }
}
