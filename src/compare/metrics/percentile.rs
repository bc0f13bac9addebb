//! The percentile of more values than memory should hold.

use alloc::vec;
use alloc::vec::Vec;

/// The largest number of values to keep and select from: 8 MB.
const KEPT: u64 = 1 << 20;
/// How many bits of the values one pass distinguishes.
const DIGIT: u32 = 16;

/// Finds the value that a share of all values does not exceed (nearest rank), exactly.
///
/// This is a radix selection: each pass counts the values by the next 16 bits of their
/// representation, which orders floats from 0 on as integers. Once few enough values share the
/// leading bits of the result, they are collected and the result is selected from them.
pub(super) struct Percentile {
    share: f64,
    /// How many values have which leading digit.
    counts: Vec<u64>,
    all: u64,
}

impl Percentile {
    pub fn new(share: f64) -> Percentile {
        Percentile {
            share,
            counts: vec![0; 1 << DIGIT],
            all: 0,
        }
    }

    /// Counts values, each 0 or more.
    pub fn extend(&mut self, values: impl IntoIterator<Item = f64>) {
        for value in values {
            debug_assert!(
                value >= 0.0,
                "{value} is negative or NaN: bits do not order it"
            );
            self.counts[(value.to_bits() >> (64 - DIGIT)) as usize] += 1;
            self.all += 1;
        }
    }

    /// Returns the percentile, or 0 if there are no values. Calls `again` with a visitor, to which
    /// it must pass all values again in any order. This happens once, or up to three times if more
    /// than a million values are nearly equal.
    pub fn find(mut self, again: impl Fn(&mut dyn FnMut(f64))) -> f64 {
        let rank = libm::ceil(self.share * self.all as f64) as u64;
        let Some(mut before) = rank.checked_sub(1) else {
            return 0.0;
        };
        // `before` is how many of the values with the same leading bits are below the result.
        // `leading` are the known leading bits of the result, and `open` is how many bits are still
        // unknown.
        let (mut leading, mut open) = (0, 64 - DIGIT);
        loop {
            let mut digit = 0;
            while before >= self.counts[digit] {
                before -= self.counts[digit];
                digit += 1;
            }
            leading = leading << DIGIT | digit as u64;
            if open == 0 {
                return f64::from_bits(leading);
            }
            let shares = |value: f64| value.to_bits() >> open == leading;
            if self.counts[digit] <= KEPT {
                let mut values = Vec::with_capacity(self.counts[digit] as usize);
                again(&mut |value| {
                    if shares(value) {
                        values.push(value);
                    }
                });
                return *values
                    .select_nth_unstable_by(before as usize, f64::total_cmp)
                    .1;
            }
            self.counts.fill(0);
            again(&mut |value| {
                if shares(value) {
                    let digit = value.to_bits() >> (open - DIGIT) & ((1 << DIGIT) - 1);
                    self.counts[digit as usize] += 1;
                }
            });
            open -= DIGIT;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::cell::Cell;

    /// Returns the percentile of `count` values, which are computed as often as needed.
    fn percentile(share: f64, count: usize, value: impl Fn(usize) -> f64) -> f64 {
        let mut percentile = Percentile::new(share);
        percentile.extend((0..count).map(&value));
        percentile.find(|visit| (0..count).for_each(|i| visit(value(i))))
    }

    #[test]
    fn percentile_is_the_nearest_rank() {
        let falling = |count: usize| percentile(0.99, count, |i| (count - 1 - i) as f64);
        // Of 100, the 99th smallest. Of 101, rank ceil(99.99) = 100.
        assert_eq!(falling(100), 98.0);
        assert_eq!(falling(101), 99.0);
        assert_eq!((falling(1), falling(0)), (0.0, 0.0));
        assert_eq!(
            percentile(1.0, 3, |i| [0.25, f64::MAX, 1e-300][i]),
            f64::MAX
        );
    }

    #[test]
    fn values_are_visited_once_more_unless_too_many_share_their_leading_bits() {
        for (count, expected) in [(KEPT as usize, 1), (KEPT as usize + 1, 3)] {
            let mut percentile = Percentile::new(0.99);
            percentile.extend((0..count).map(|_| 0.1));
            let times = Cell::new(0);
            percentile.find(|visit| {
                times.set(times.get() + 1);
                (0..count).for_each(|_| visit(0.1));
            });
            assert_eq!(times.get(), expected, "{count}");
        }
    }

    #[test]
    fn more_values_than_are_kept_are_found_to_the_last_bit() {
        // Neighbouring floats differ only in their last 22 bits, so every pass is needed.
        let count = 3 * KEPT as usize + 7;
        let value = |i: usize| f64::from_bits(1.5f64.to_bits() + i as u64);
        for share in [0.5, 0.99, 1.0] {
            let rank = (share * count as f64).ceil() as usize;
            assert_eq!(percentile(share, count, value), value(rank - 1), "{share}");
        }
        // All values are equal.
        assert_eq!(percentile(0.99, count, |_| 0.1), 0.1);
        assert_eq!(percentile(0.99, count, |_| 0.0), 0.0);
    }
}
