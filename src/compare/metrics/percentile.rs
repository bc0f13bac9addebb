//! The percentile of values that are too many to be kept.

use alloc::vec;
use alloc::vec::Vec;

/// Values that are kept at most, to be sorted: 8 MB.
const KEPT: u64 = 1 << 20;
/// Bits of a value that are told apart in one pass.
const DIGIT: u32 = 16;

/// Finds the value that a share of all values does not exceed (nearest rank), exactly: values are counted by the leading bits of
/// their representation, which order floats from 0 on, and then the few that share the bits of the result are sorted.
pub(super) struct Percentile {
    share: f64,
    /// Number of values by their first digit.
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

    /// Takes values, 0 or more each.
    pub fn extend(&mut self, values: impl IntoIterator<Item = f64>) {
        for value in values {
            debug_assert!(value >= 0.0, "{value} has a place in the order of bits");
            self.counts[(value.to_bits() >> (64 - DIGIT)) as usize] += 1;
            self.all += 1;
        }
    }

    /// Returns the percentile, 0 of no values. `again` is called with a visitor, to which it gives all values once more, in any
    /// order: once, or up to three times if more than a million of them are nearly the same.
    pub fn find(mut self, again: impl Fn(&mut dyn FnMut(f64))) -> f64 {
        let rank = libm::ceil(self.share * self.all as f64) as u64;
        let Some(mut before) = rank.checked_sub(1) else {
            return 0.0;
        };
        // The leading bits of the result, and how many bits are still open.
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

    /// Finds the percentile of values that can be visited any number of times.
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
    fn values_come_again_only_once_unless_too_many_share_their_leading_bits() {
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
        // Neighbouring floats: they differ in their last 22 bits alone, so that every pass is needed.
        let count = 3 * KEPT as usize + 7;
        let value = |i: usize| f64::from_bits(1.5f64.to_bits() + i as u64);
        for share in [0.5, 0.99, 1.0] {
            let rank = (share * count as f64).ceil() as usize;
            assert_eq!(percentile(share, count, value), value(rank - 1), "{share}");
        }
        // All the same.
        assert_eq!(percentile(0.99, count, |_| 0.1), 0.1);
        assert_eq!(percentile(0.99, count, |_| 0.0), 0.0);
    }
}
