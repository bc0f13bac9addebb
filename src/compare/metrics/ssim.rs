//! SSIM: the structural similarity of two pictures.

use super::MAX_PERCEIVED;
use super::{SizeMismatch, for_each_row};
use crate::picture::LevelRows;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::{AddAssign, Mul};

/// The side of the window in pixels.
const WINDOW: usize = 11;
/// The standard deviation of the window's weights, in pixels.
const SIGMA: f64 = 1.5;
/// (K1 L)², K1 = 0.01, for values in 0..=1 (L = 1).
const C1: f64 = 0.01 * 0.01;
/// (K2 L)², K2 = 0.03.
const C2: f64 = 0.03 * 0.03;

/// The number of means per window: x, y, x² + y² and x y. The formula needs only the sum of the
/// variances, so x² and y² are added.
const MOMENTS: usize = 4;

/// Returns the weights of a row of the window, which sum to 1.
fn weights() -> [f64; WINDOW] {
    let mut weights = [0.0; WINDOW];
    let centre = (WINDOW / 2) as f64;
    for (i, weight) in weights.iter_mut().enumerate() {
        let distance = (i as f64 - centre) / SIGMA;
        *weight = libm::exp(-0.5 * distance * distance);
    }
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

/// Returns the mean structural similarity of two pictures' luminance, as in
/// [`Difference::ssim`](super::Difference::ssim).
///
/// # Errors
/// If the sizes differ.
pub fn ssim(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
) -> Result<Option<f64>, SizeMismatch> {
    ssim_where(reference, actual, |_, _| true)
}

/// Returns the mean structural similarity as [`ssim`] does, but treats pixels as equal if
/// `included(column, row)` is false.
///
/// # Errors
/// If the sizes differ.
pub fn ssim_where(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    included: impl Fn(usize, usize) -> bool,
) -> Result<Option<f64>, SizeMismatch> {
    ssim_selected(reference, actual, &included)
}

/// Computes like [`ssim_where`]. Its loops over pixels are compiled in this crate, and once.
fn ssim_selected(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    included: &dyn Fn(usize, usize) -> bool,
) -> Result<Option<f64>, SizeMismatch> {
    SizeMismatch::check(reference.size(), actual.size())?;
    let [width, height] = reference.size();
    let Some(mut ssim) = MeanSsim::new([width, height]) else {
        return Ok(None);
    };
    let mut luminance = [(); 2].map(|()| vec![0.0; width]);
    for_each_row(reference, actual, |y, r_row, a_row| {
        for x in 0..width {
            let other = if included(x, y) { a_row } else { r_row };
            luminance[0][x] = r_row[x].luminance() / 255.0;
            luminance[1][x] = other[x].luminance() / 255.0;
        }
        ssim.add(&luminance[0], &luminance[1]);
    });
    Ok(Some(ssim.finish()))
}

/// The mean structural similarity of two rasters of values in 0..=1, computed row by row.
///
/// ```text
/// SSIM = (2 μx μy + C1)(2 σxy + C2) / ((μx² + μy² + C1)(σx² + σy² + C2))
/// ```
///
/// with an 11×11 Gaussian window of σ = 1.5, averaged over all positions of the window inside the
/// raster (Wang, Bovik, Sheikh, Simoncelli: *Image quality assessment*, IEEE TIP 13(4), 2004,
/// equation 13 and section III C).
///
/// The Gaussian is separable: each row is filtered horizontally when it is added, and the last
/// eleven filtered rows are kept in a ring buffer for the vertical pass.
pub(super) struct MeanSsim {
    /// How many positions the window has in a row.
    places: usize,
    weights: [f64; WINDOW],
    /// The last eleven filtered rows: a ring buffer.
    filtered: Vec<f64>,
    moments: Vec<f64>,
    products: [Vec<f64>; MOMENTS],
    sum: f64,
    /// How many rows were added so far.
    rows: usize,
}

impl MeanSsim {
    /// Starts with rasters of this width and height. Returns `None` if the window does not fit, or
    /// for more than [`MAX_PERCEIVED`] values.
    pub fn new([width, height]: [usize; 2]) -> Option<MeanSsim> {
        if width < WINDOW || height < WINDOW || width * height > MAX_PERCEIVED {
            return None;
        }
        let places = width + 1 - WINDOW;
        Some(MeanSsim {
            places,
            weights: weights(),
            filtered: vec![0.0; WINDOW * MOMENTS * places],
            moments: vec![0.0; MOMENTS * places],
            products: core::array::from_fn(|_| vec![0.0; width]),
            sum: 0.0,
            rows: 0,
        })
    }

    /// Adds the next row of both rasters.
    pub fn add(&mut self, x_row: &[f64], y_row: &[f64]) {
        let (y, size) = (self.rows, MOMENTS * self.places);
        multiply(x_row, y_row, &mut self.products);
        let slot = &mut self.filtered[y % WINDOW * size..][..size];
        for (product, out) in self.products.iter().zip(slot.chunks_exact_mut(self.places)) {
            weigh(&self.weights, |k| &product[k..], out);
        }
        if y + 1 >= WINDOW {
            // The slot after the newest row holds the oldest one.
            let row = |k| &self.filtered[(y + 1 + k) % WINDOW * size..];
            weigh(&self.weights, row, &mut self.moments);
            self.sum += row_sum(&self.moments, self.places);
        }
        self.rows += 1;
    }

    /// Returns the mean, after all rows were added.
    pub fn finish(self) -> f64 {
        self.sum / (self.places * (self.rows + 1 - WINDOW)) as f64
    }
}

/// Computes x, y, x² + y² and x y for one row.
fn multiply(x_row: &[f64], y_row: &[f64], [xs, ys, squares, crosses]: &mut [Vec<f64>; MOMENTS]) {
    xs.copy_from_slice(x_row);
    ys.copy_from_slice(y_row);
    for ((square, cross), (x, y)) in squares.iter_mut().zip(crosses).zip(x_row.iter().zip(y_row)) {
        *square = x * x + y * y;
        *cross = x * y;
    }
}

/// Adds up weighted slices, one for each weight, element by element. The loop over weights is
/// outside, so that the inner one is a plain multiply-add over contiguous memory, which the
/// compiler turns into SIMD code.
#[inline(always)]
pub(super) fn weigh<'a, T: Copy + Default + AddAssign + Mul<Output = T> + 'a>(
    weights: &[T],
    slice: impl Fn(usize) -> &'a [T],
    out: &mut [T],
) {
    out.fill(T::default());
    for (k, weight) in weights.iter().enumerate() {
        for (sum, value) in out.iter_mut().zip(slice(k)) {
            *sum += *weight * *value;
        }
    }
}

/// Returns the sum of SSIM over a row of windows.
fn row_sum(moments: &[f64], places: usize) -> f64 {
    let (means, seconds) = moments.split_at(2 * places);
    let (mean_x, mean_y) = means.split_at(places);
    let (square, cross) = seconds.split_at(places);
    let mut sum = 0.0;
    // σx² + σy² = E(x² + y²) − μx² − μy², and σxy = E(x y) − μx μy.
    for i in 0..places {
        let (mx, my) = (mean_x[i], mean_y[i]);
        let variances = square[i] - mx * mx - my * my;
        let covariance = cross[i] - mx * my;
        sum += (2.0 * mx * my + C1) * (2.0 * covariance + C2)
            / ((mx * mx + my * my + C1) * (variances + C2));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_a_normalised_bell() {
        let weights = weights();
        assert_eq!(
            weights
                .iter()
                .zip(weights.iter().rev())
                .find(|(a, b)| a != b),
            None,
            "symmetric"
        );
        // Eleven quotients of at most 2^-2, each rounded by half a unit in the last place, and ten
        // sums: below 21 * 2^-53.
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 21.0 * f64::EPSILON / 2.0);
        // exp(-1/(2 * 1.5²)): the ratio of neighbours at the top.
        assert!(
            (weights[4] / weights[5] - 0.800_737_402_916_808_1).abs() < 4.0 * f64::EPSILON,
            "four roundings"
        );
    }

    #[test]
    fn needs_room_for_one_window() {
        let of_equal = |width: usize, height: usize| {
            let mut ssim = MeanSsim::new([width, height])?;
            (0..height).for_each(|_| ssim.add(&vec![0.5; width], &vec![0.5; width]));
            Some(ssim.finish())
        };
        assert_eq!(of_equal(0, 0), None);
        assert_eq!(of_equal(10, 11), None);
        assert_eq!(of_equal(11, 10), None);
        assert_eq!(of_equal(11, 11), Some(1.0));
    }

    #[test]
    fn the_largest_pictures_that_have_it_are_those_of_max_perceived_pixels() {
        assert!(MeanSsim::new([8192, 8192]).is_some());
        assert!(MeanSsim::new([8192, 8193]).is_none());
    }
}
