//! How many pixels have which errors.

/// Upper ends of the bins in grey levels; the last bin has none. They double, since 1 level against
/// 2 says as much as 32 against 64.
const ENDS: [f64; 10] = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0];

/// Counts of pixels by their errors.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Histogram {
    /// No error, then up to each end of [`ENDS`], then over the last.
    counts: [usize; ENDS.len() + 1],
    /// Pixels that have a number in one of the pictures only.
    pub not_finite: usize,
}

/// A range of errors, and its pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bin {
    /// Errors are larger than this, in grey levels; `None`: there is no error.
    pub over: Option<f64>,
    /// Errors are at most this; `None`: any.
    pub up_to: Option<f64>,
    /// The pixels with such an error.
    pub pixels: usize,
}

impl Histogram {
    /// Counts a pixel with an error in grey levels.
    pub(super) fn add(&mut self, error: f64) {
        match error.is_finite() {
            true => self.counts[ENDS.partition_point(|end| *end < error)] += 1,
            false => self.not_finite += 1,
        }
    }

    /// Returns all bins, the smallest errors first.
    pub fn bins(&self) -> impl Iterator<Item = Bin> {
        self.counts.iter().enumerate().map(|(i, &pixels)| Bin {
            over: i.checked_sub(1).map(|i| ENDS[i]),
            up_to: ENDS.get(i).copied(),
            pixels,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    #[test]
    fn an_error_at_the_end_of_a_bin_is_in_it() {
        let mut histogram = Histogram::default();
        for error in [0.0, 1e-300, 0.5, 0.51, 1.0, 128.0, 128.1, 1e300] {
            histogram.add(error);
        }
        histogram.add(f64::INFINITY);
        let bins: Vec<Bin> = histogram.bins().collect();
        let counts: Vec<usize> = bins.iter().map(|bin| bin.pixels).collect();
        assert_eq!(counts, [1, 2, 2, 0, 0, 0, 0, 0, 0, 1, 2]);
        assert_eq!(histogram.not_finite, 1);
        assert_eq!((bins[0].over, bins[0].up_to), (None, Some(0.0)));
        assert_eq!((bins[1].over, bins[1].up_to), (Some(0.0), Some(0.5)));
        assert_eq!((bins[10].over, bins[10].up_to), (Some(128.0), None));
    }
}
