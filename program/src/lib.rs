//! The `fastphong` command-line tool: sub-commands, report, lectures' figures, diagnosis, window.
//!
//! The crate `fastphong` draws. Nothing here is a stable interface.

extern crate alloc;

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
pub mod compare;
#[cfg(feature = "cli")]
pub mod diagnose;
pub mod export;
pub mod lectures;
#[cfg(feature = "cli")]
pub mod report;
// Its tests need no display, so they run with all others. Without the window nothing else calls it.
#[cfg(any(feature = "view", all(test, feature = "cli")))]
#[cfg_attr(not(feature = "view"), allow(dead_code, unused_imports))]
mod view;

/// A copy of the library's private generator.
mod split_mix {
    /// SplitMix64: Steele, Lea, Flood, *Fast splittable pseudorandom number generators*, OOPSLA
    /// 2014. The field is its seed, and then its state.
    pub(crate) struct SplitMix(pub u64);

    impl SplitMix {
        pub fn next(&mut self) -> u64 {
            self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            z ^ (z >> 31)
        }

        /// Returns an index below `n`: multiplies 64 random bits, and keeps the high bits.
        #[cfg(feature = "cli")]
        pub fn below(&mut self, n: usize) -> usize {
            ((u128::from(self.next()) * n as u128) >> 64) as usize
        }

        /// Puts a list into random order (Fisher and Yates).
        #[cfg(feature = "cli")]
        pub fn shuffle<T>(&mut self, list: &mut [T]) {
            for i in (1..list.len()).rev() {
                list.swap(i, self.below(i + 1));
            }
        }
    }

    /// The first value for seed 0 of the authors' reference implementation.
    #[test]
    fn random_numbers_are_those_of_the_paper() {
        assert_eq!(SplitMix(0).next(), 0xE220_A839_7B1D_CDAF);
    }
}
