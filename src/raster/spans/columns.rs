//! A set of columns, one bit for each: which pixels of a scanline spans cover.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// How many columns a word holds.
const WORD: usize = u64::BITS as usize;

/// A set of columns of a picture.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    words: Vec<u64>,
}

impl Columns {
    /// Makes an empty set for a picture of `width` columns.
    pub fn new(width: usize) -> Self {
        Columns {
            words: vec![0; width.div_ceil(WORD)],
        }
    }

    /// Removes all columns.
    pub fn clear(&mut self) {
        self.words.fill(0);
    }

    /// Adds columns; at least one. Returns true if none of them was in the set.
    #[inline(always)]
    pub fn add(&mut self, columns: Range<usize>) -> bool {
        let (first, last) = (columns.start, columns.end - 1);
        let (mut taken, mut bits) = (0, u64::MAX << (first % WORD));
        for word in &mut self.words[first / WORD..last / WORD] {
            taken |= *word & bits;
            *word |= bits;
            bits = u64::MAX;
        }
        bits &= u64::MAX >> (WORD - 1 - last % WORD);
        let word = &mut self.words[last / WORD];
        taken |= *word & bits;
        *word |= bits;
        taken == 0
    }

    /// Calls `visit` with each stretch of neighbouring columns, from left to right.
    pub fn for_each_stretch(&self, mut visit: impl FnMut(Range<usize>)) {
        let mut end = 0;
        while let Some(start) = self.next(end, |word| word) {
            end = self
                .next(start, |word| !word)
                .unwrap_or(self.words.len() * WORD);
            visit(start..end);
        }
    }

    /// Returns the first column from `from` on whose bit is set in the words that `of` returns.
    fn next(&self, from: usize, of: impl Fn(u64) -> u64) -> Option<usize> {
        let mut mask = u64::MAX << (from % WORD);
        for (index, word) in self.words.iter().enumerate().skip(from / WORD) {
            match of(*word) & mask {
                0 => mask = u64::MAX,
                bits => return Some(index * WORD + bits.trailing_zeros() as usize),
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;

    /// Compares with a list of booleans, around the borders of words.
    #[test]
    fn a_set_is_a_list_of_booleans() {
        let mut random = Random::new(7);
        for width in [1, 63, 64, 65, 128, 200] {
            for _ in 0..200 {
                let (mut set, mut list) = (Columns::new(width), vec![false; width]);
                for _ in 0..random.below(6) {
                    let start = random.below(width as u64) as usize;
                    let end = start + 1 + random.below((width - start) as u64) as usize;
                    let is_new = !list[start..end].contains(&true);
                    assert_eq!(set.add(start..end), is_new, "{start}..{end} of {width}");
                    list[start..end].fill(true);
                }
                let mut found = vec![false; width];
                let mut before = None;
                set.for_each_stretch(|columns| {
                    assert!(before < Some(columns.start), "stretches do not touch");
                    before = Some(columns.end);
                    found[columns].fill(true);
                });
                assert_eq!(found, list, "{width} columns");
                set.clear();
                set.for_each_stretch(|columns| panic!("{columns:?} of an empty set"));
            }
        }
    }
}
