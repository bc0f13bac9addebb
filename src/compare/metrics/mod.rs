//! The difference between two pictures, as metrics and as maps.
//!
//! [`compare()`] returns a [`Difference`] with all metrics, and [`METRICS`] lists them with names
//! and units. [`difference_map`] and [`signed_difference_map`] draw the difference. [`flip_map`]
//! computes ꟻLIP, the difference that a viewer sees.
//!
//! Values are compared as stored: linear pictures in linear light, encoded ones in their encoding.
//! Compare only pictures that are stored the same way; `image_file::Pair` converts two files for
//! that. Errors are in 0..=1, as colours are, and [`METRICS`] converts them to grey levels (1/255).
//!
//! # Which pixels count
//! A pixel with alpha 0 in both pictures is *background*. Its colours do not count, and it is left
//! out of every mean, because more background would flatter every method. All other pixels are
//! *compared*. Alpha is a channel like the colours, and the error of a colour is at least the error
//! of alpha. If only one picture covers a pixel, there is no colour to compare: the error is the
//! error of alpha, and the pixel also counts as a coverage mismatch. PSNR, SSIM, ꟻLIP and
//! `frame_rms` are taken over the whole frame, so that they equal the results of other tools.
//!
//! # Memory
//! Pictures are read row by row, as often as needed. Beside the pictures, the metrics need a few
//! rows and at most 10 MB. ꟻLIP needs 110 MB, and its map 4 bytes per pixel.

use alloc::vec::Vec;
use core::fmt;

mod flip;
#[doc(hidden)]
pub mod judgement;
mod list;
mod map;
mod percentile;
mod rows;
mod ssim;

use crate::picture::{LevelRows, Levels};
pub use flip::{Perceived, flip_colours, flip_map, mean_flip};
pub use list::{Better, METRICS, MetricInfo};
pub use map::{difference_map, signed_difference_map};
use percentile::Percentile;
use rows::for_each_row;
use ssim::MeanSsim;
pub use ssim::{ssim, ssim_where};

/// The share of the compared pixels whose error does not exceed [`Difference::p99`].
const PERCENTILE: f64 = 0.99;

/// The largest picture, in pixels, for which SSIM and ꟻLIP are computed: 8192 × 8192. Larger ones
/// would take minutes.
pub const MAX_PERCEIVED: usize = 1 << 26;

/// The difference between two pictures: the result of [`compare()`].
///
/// The error of a pixel is the largest absolute difference of its channels, including alpha: 0..=1
/// for values in 0..=1. A channel that is infinite or not a number is equal if it is the same in
/// both pictures, and an error of 1 otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Difference {
    /// True if the pictures have the same colour and coverage at every pixel that is not excluded.
    /// If no pixel is compared, true only if all samples of both pictures are the same, also the
    /// excluded ones and colours under alpha 0: nothing is equal because nobody looked.
    pub equal: bool,
    /// The number of pixels of the frame, without excluded ones.
    pub frame: usize,
    /// The number of pixels that the caller excluded.
    pub excluded: usize,
    /// The number of pixels that the means are taken over: the frame without its background.
    pub compared: usize,
    /// The number of compared pixels whose colour or alpha differs, even by one bit.
    pub differing: usize,
    /// The number of compared pixels with an error of more than half a grey level, 0.5/255, which
    /// may be stored differently.
    pub over_half_level: usize,
    /// The number of compared pixels with an error of more than one grey level, 1/255.
    pub over_one_level: usize,
    /// The number of pixels that only one picture covers: alpha is 0 in one and not in the other.
    pub coverage_mismatches: usize,
    /// The number of compared pixels with a channel that is infinite or not a number in either
    /// picture.
    pub not_finite: usize,
    /// The number of those pixels whose channel differs between the pictures. No number of levels
    /// can state their error, so a test with any threshold fails.
    // Methods draw finite pictures, so the JSON of comparisons has no such pixels.
    #[cfg_attr(feature = "io", serde(skip))]
    pub not_finite_differing: usize,
    /// The largest error of a pixel.
    pub max: f64,
    /// The column and row of the first pixel, in reading order, with the largest error; `None` if
    /// no colour differs.
    pub worst: Option<[usize; 2]>,
    /// The error that 99 % of the compared pixels do not exceed.
    pub p99: f64,
    /// The mean absolute error over the channels of the compared pixels.
    pub mae: f64,
    /// The root of the mean squared error over the channels of the compared pixels.
    pub rms: f64,
    /// The root of the mean squared error over the whole frame.
    pub frame_rms: f64,
    /// The mean difference of luminance, actual − reference, over the compared pixels: positive if
    /// the picture is too bright.
    pub signed_mean: f64,
    /// The peak signal-to-noise ratio over the whole frame, −20 log₁₀ `frame_rms`, in dB; infinite
    /// if no colour differs (`null` in JSON).
    pub psnr: f64,
    /// The mean structural similarity of luminance over the whole frame (Wang et al. 2004: 11×11
    /// Gaussian window, σ = 1.5, K1 = 0.01, K2 = 0.03, L = 1), 1 for equal pictures; `None` if the
    /// frame is smaller than the window, or has more than 2²⁶ pixels.
    ///
    /// Excluded pixels count as equal.
    pub ssim: Option<f64>,
    /// The mean ꟻLIP over the whole frame of the stored pictures: 0 for equal pictures, at most 1.
    /// [`compare()`] leaves it `None`, because it takes twice as long as all other metrics
    /// together: compute it by [`flip_map`] and [`mean_flip`].
    pub flip: Option<f64>,
}

impl Difference {
    /// Returns `count` as a share of the compared pixels, in 0..=1; 0 if no pixel was compared.
    pub fn share(&self, count: usize) -> f64 {
        match self.compared {
            0 => 0.0,
            compared => count as f64 / compared as f64,
        }
    }
}

/// The error of comparing two pictures of different sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SizeMismatch {
    /// The width and height of the reference in pixels.
    pub reference: [usize; 2],
    /// The width and height of the other picture in pixels.
    pub actual: [usize; 2],
}

impl SizeMismatch {
    fn check(reference: [usize; 2], actual: [usize; 2]) -> Result<(), SizeMismatch> {
        if reference == actual {
            Ok(())
        } else {
            Err(SizeMismatch { reference, actual })
        }
    }
}

impl fmt::Display for SizeMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([rw, rh], [aw, ah]) = (self.reference, self.actual);
        write!(
            f,
            "the reference is {rw}×{rh} pixels, the other picture {aw}×{ah}: expected the same size"
        )
    }
}

impl core::error::Error for SizeMismatch {}

/// Compares `actual` with `reference` over all pixels.
///
/// ```
/// use fastphong::compare::metrics::{METRICS, compare};
/// use fastphong::picture::LinearPicture;
///
/// let reference = LinearPicture::new(16, 16, [0.5, 0.5, 0.5, 1.0]);
/// let actual = LinearPicture::new(16, 16, [0.5, 0.75, 0.5, 1.0]);
/// let difference = compare(&reference, &actual)?;
/// assert_eq!(difference.max, 0.25);
/// for metric in METRICS {
///     println!("{}: {:?} {}", metric.name, (metric.value)(&difference), metric.unit);
/// }
/// # Ok::<(), fastphong::compare::metrics::SizeMismatch>(())
/// ```
///
/// # Errors
/// If the sizes differ.
pub fn compare(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
) -> Result<Difference, SizeMismatch> {
    compare_where(reference, actual, |_, _| true)
}

/// Compares `actual` with `reference` over the pixels for which `included(column, row)` is true.
///
/// Exclude pixels that differ for a known reason, for example because two renderers show different
/// polygons. They are counted in [`Difference::excluded`] and affect nothing else.
///
/// # Errors
/// If the sizes differ.
pub fn compare_where(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    included: impl Fn(usize, usize) -> bool,
) -> Result<Difference, SizeMismatch> {
    compare_selected(reference, actual, &included)
}

/// Compares like [`compare_where`]. Its loops over pixels are compiled in this crate, and once.
fn compare_selected(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    included: &dyn Fn(usize, usize) -> bool,
) -> Result<Difference, SizeMismatch> {
    SizeMismatch::check(reference.size(), actual.size())?;
    let mut sums = ErrorSums::default();
    let mut percentile = Percentile::new(PERCENTILE);
    let mut ssim = MeanSsim::new(reference.size());
    let mut luminance = [(); 2].map(|()| Vec::new());
    let mut is_same = true;
    for_each_row(reference, actual, |y, r_row, a_row| {
        luminance.iter_mut().for_each(Vec::clear);
        is_same = is_same && r_row.iter().zip(a_row).all(|(&r, &a)| is_one_sample(r, a));
        for (x, (&r, &a)) in r_row.iter().zip(a_row).enumerate() {
            let difference = PixelDifference::new(r, a);
            let included = included(x, y);
            if included {
                sums.add([x, y], difference.as_ref());
                percentile.extend(difference.as_ref().map(PixelDifference::largest));
            } else {
                sums.counts.excluded += 1;
            }
            // SSIM compares neighbourhoods, so it needs every pixel. Excluded pixels and background
            // take the reference's luminance in both pictures, which makes them equal.
            if ssim.is_some() {
                let is_shown = included && difference.is_some();
                luminance[0].push(r.luminance() / 255.0);
                luminance[1].push(if is_shown { a } else { r }.luminance() / 255.0);
            }
        }
        if let Some(ssim) = &mut ssim {
            ssim.add(&luminance[0], &luminance[1]);
        }
    });
    // The percentile needs the errors once more. Computing them again takes less memory than
    // keeping them.
    let p99 = percentile.find(|visit| {
        for_each_row(reference, actual, |y, r_row, a_row| {
            for (x, (&r, &a)) in r_row.iter().zip(a_row).enumerate() {
                if let (Some(difference), true) = (PixelDifference::new(r, a), included(x, y)) {
                    visit(difference.largest());
                }
            }
        });
    });
    let found = sums.finish(p99, ssim.map(MeanSsim::finish));
    Ok(Difference {
        equal: found.equal && (found.compared > 0 || is_same),
        ..found
    })
}

/// True if two pixels have the same channels, whatever their alpha. NaN is the same as NaN.
fn is_one_sample(reference: Levels, actual: Levels) -> bool {
    reference == actual || channel_errors(reference, actual) == [0.0; 4]
}

/// The difference at a pixel that at least one picture covers.
struct PixelDifference {
    /// The errors of red, green and blue in grey levels, each at least the error of alpha.
    errors: [f64; 3],
    /// True if a channel differs.
    differs: bool,
    /// True if only one of the pictures covers the pixel.
    is_mismatch: bool,
    /// True if a channel is infinite or not a number in either picture.
    is_not_finite: bool,
    /// True if such a channel differs.
    is_not_finite_differing: bool,
    /// The difference of luminance, actual − reference, in grey levels; 0 at a coverage mismatch.
    luminance: f64,
}

impl PixelDifference {
    /// The difference of a finite pixel from itself.
    const EQUAL: PixelDifference = PixelDifference {
        errors: [0.0; 3],
        differs: false,
        is_mismatch: false,
        is_not_finite: false,
        is_not_finite_differing: false,
        luminance: 0.0,
    };

    /// Returns the difference between two pixels, or `None` if neither picture covers them.
    fn new(reference: Levels, actual: Levels) -> Option<PixelDifference> {
        let covered = [reference, actual].map(|pixel| pixel.alpha() != 0.0);
        if covered == [false, false] {
            return None;
        }
        // A fast path, because most pixels are equal. NaN is not equal to itself, so it takes the
        // slow path.
        if reference == actual && reference.0.iter().all(|level| level.is_finite()) {
            return Some(PixelDifference::EQUAL);
        }
        let is_mismatch = covered[0] != covered[1];
        let [mut errors @ .., alpha] = channel_errors(reference, actual);
        let finite = |pixel: Levels| pixel.0.iter().all(|level| level.is_finite());
        let is_not_finite = !(finite(reference) && finite(actual));
        let lost =
            |c: usize| errors[c] != 0.0 && !(reference.0[c].is_finite() && actual.0[c].is_finite());
        let is_not_finite_differing = !is_mismatch && (0..3).any(lost);
        if is_mismatch {
            errors = [0.0; 3];
        }
        let luminance = if is_mismatch {
            0.0
        } else {
            actual.luminance() - reference.luminance()
        };
        Some(PixelDifference {
            errors: errors.map(|error| error.max(alpha)),
            differs: alpha != 0.0 || errors != [0.0; 3],
            is_mismatch,
            is_not_finite,
            is_not_finite_differing,
            luminance,
        })
    }

    /// Returns the largest error of a channel, in grey levels.
    fn largest(&self) -> f64 {
        self.errors.into_iter().fold(0.0, f64::max)
    }
}

/// Returns the absolute differences of red, green, blue and alpha, in grey levels. A channel that
/// is not finite and differs counts as an error of the full range, so that means stay finite but
/// show it.
fn channel_errors(reference: Levels, actual: Levels) -> [f64; 4] {
    core::array::from_fn(|c| {
        let (r, a) = (reference.0[c], actual.0[c]);
        let error = (a - r).abs();
        if error.is_finite() {
            error
        } else if r == a || (r.is_nan() && a.is_nan()) {
            0.0
        } else {
            255.0
        }
    })
}

/// Sums of errors over pixels, in grey levels.
#[derive(Default)]
struct ErrorSums {
    /// The counts and the largest error.
    counts: Difference,
    absolute: f64,
    squares: f64,
    signed: f64,
}

impl ErrorSums {
    fn add(&mut self, at: [usize; 2], difference: Option<&PixelDifference>) {
        let counts = &mut self.counts;
        counts.frame += 1;
        let Some(difference) = difference else {
            return;
        };
        let error = difference.largest();
        counts.compared += 1;
        counts.differing += usize::from(difference.differs);
        counts.coverage_mismatches += usize::from(difference.is_mismatch);
        counts.not_finite += usize::from(difference.is_not_finite);
        counts.not_finite_differing += usize::from(difference.is_not_finite_differing);
        counts.over_half_level += usize::from(error > 0.5);
        counts.over_one_level += usize::from(error > 1.0);
        // `>` keeps the first of several pixels with the same error.
        if error > counts.max {
            (counts.max, counts.worst) = (error, Some(at));
        }
        self.absolute += difference.errors.iter().sum::<f64>();
        self.squares += difference.errors.iter().map(|e| e * e).sum::<f64>();
        self.signed += difference.luminance;
    }

    fn finish(self, p99: f64, ssim: Option<f64>) -> Difference {
        let (counts, compared) = (self.counts, self.counts.compared);
        let mean = |sum: f64, pixels: usize| match pixels {
            0 => 0.0,
            pixels => sum / pixels as f64,
        };
        let frame_rms = libm::sqrt(mean(self.squares, 3 * counts.frame)) / 255.0;
        Difference {
            equal: counts.differing == 0,
            max: counts.max / 255.0,
            p99: p99 / 255.0,
            mae: mean(self.absolute, 3 * compared) / 255.0,
            rms: libm::sqrt(mean(self.squares, 3 * compared)) / 255.0,
            frame_rms,
            signed_mean: mean(self.signed, compared) / 255.0,
            psnr: -20.0 * libm::log10(frame_rms),
            ssim,
            ..counts
        }
    }
}

#[cfg(test)]
mod tests;
