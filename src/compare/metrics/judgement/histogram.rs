//! The histogram of errors.

/// The upper ends of the bins in grey levels. The last bin has none. They double, because the step
/// from 1 level to 2 says as much as the one from 32 to 64.
const ENDS: [f64; 10] = [0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0];

/// How many pixels have which errors.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Histogram {
    /// The counts of the bins: up to each end of [`ENDS`], then over the last end. The first bin
    /// holds pixels without error.
    counts: [usize; ENDS.len() + 1],
    /// The number of pixels that are finite in only one picture.
    pub not_finite: usize,
}

/// A range of errors, with its count of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bin {
    /// The lower end in grey levels, exclusive; `None` for the bin without errors.
    pub over: Option<f64>,
    /// The upper end in grey levels, inclusive; `None` for the last bin.
    pub up_to: Option<f64>,
    /// The number of pixels in the bin.
    pub pixels: usize,
}

impl Histogram {
    /// Counts a pixel with an error in grey levels.
    pub(super) fn add(&mut self, error: f64) {
        if error.is_finite() {
            self.counts[ENDS.partition_point(|end| *end < error)] += 1;
        } else {
            self.not_finite += 1;
        }
    }

    /// Returns all bins, smallest errors first.
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
