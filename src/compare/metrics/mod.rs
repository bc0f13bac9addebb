//! A picture against a picture: the error of a method in numbers and as a map.
//!
//! Values are compared as stored: linear pictures in linear light, encoded ones in their encoding. Compare only pictures
//! that are stored the same way; `image_file::Pair` makes two files so.
//!
//! Errors are kept in 0..=1, as colours are; [`METRICS`] states them in grey levels (1/255), as people do.
//!
//! # Which pixels count
//! A pixel that neither picture covers, alpha 0 in both, is *background*: its colours do not count, and it is left out of every
//! mean, as more of it would flatter every method. All others are *compared*. Alpha is a channel like the colours: an error of a
//! colour counts for at least as much as that of alpha. Where only one picture covers a pixel there is no colour to compare, and
//! the error is that of alpha; such pixels are counted as coverage mismatches as well. Only PSNR, SSIM, ꟻLIP and `frame_rms` are
//! taken over the whole frame, so that they equal what other tools report.
//!
//! # Memory
//! Pictures are read by rows, each as often as it takes. Beside the pictures no metric needs more than some rows and 10 MB; ꟻLIP
//! needs 110 MB, and its map 4 bytes a pixel.

use alloc::vec::Vec;
use core::fmt;

mod flip;
#[cfg(feature = "cli")]
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
pub use map::{BEYOND, BEYOND_DARKER, COVERAGE, EQUAL, difference_map, signed_difference_map};
use percentile::Percentile;
use rows::for_each_row;
use ssim::MeanSsim;
pub use ssim::{ssim, ssim_where};

/// Share of the compared pixels whose error does not exceed [`Difference::p99`].
const PERCENTILE: f64 = 0.99;

/// Pixels of the largest picture for which SSIM and ꟻLIP are computed, 8192 × 8192: beyond that they take minutes.
pub const MAX_PERCEIVED: usize = 1 << 26;

/// The difference between two pictures, in numbers.
///
/// A pixel's error is the largest absolute difference of its channels, alpha among them, in 0..=1 for values in 0..=1. A channel
/// that is infinite or not a number counts as equal if it is the same in both pictures, and as an error of 1 otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
pub struct Difference {
    /// True if the pictures agree in the colour and coverage of every pixel, excluded ones aside.
    pub equal: bool,
    /// Pixels of the frame, without those excluded.
    pub frame: usize,
    /// Pixels left out on the caller's wish.
    pub excluded: usize,
    /// Pixels that the means are taken over: the frame without its background.
    pub compared: usize,
    /// Compared pixels whose colour and alpha are not the same to the last bit.
    pub differing: usize,
    /// Compared pixels with an error of more than half a grey level, 0.5/255: those that may be stored differently.
    pub over_half_level: usize,
    /// Compared pixels with an error of more than one grey level, 1/255.
    pub over_one_level: usize,
    /// Pixels that only one of the pictures covers: alpha is 0 in one and not in the other.
    pub coverage_mismatches: usize,
    /// Compared pixels with a channel that is infinite or not a number in either picture.
    pub not_finite: usize,
    /// Those of them whose channel is not the same in both pictures. No number of levels says how far they are off: a test
    /// with any threshold fails.
    // Pictures of methods are finite: results have no such pixels.
    #[cfg_attr(feature = "io", serde(skip))]
    pub not_finite_differing: usize,
    /// The largest error of a pixel.
    pub max: f64,
    /// Column and row of the first pixel, in reading order, with the largest error; `None` if no colour differs.
    pub worst: Option<[usize; 2]>,
    /// The error that 99 % of the compared pixels do not exceed.
    pub p99: f64,
    /// Mean absolute error over the channels of the compared pixels.
    pub mae: f64,
    /// Root of the mean squared error over the channels of the compared pixels.
    pub rms: f64,
    /// Root of the mean squared error over the whole frame.
    pub frame_rms: f64,
    /// Mean of the luminance of the actual picture minus the reference's, over the compared pixels: positive if it is too bright.
    pub signed_mean: f64,
    /// Peak signal-to-noise ratio over the whole frame, −20 log₁₀ `frame_rms`, in dB; infinite if no colour differs (JSON has `null` for that).
    pub psnr: f64,
    /// Mean structural similarity of luminance over the whole frame (Wang et al. 2004: 11×11 Gaussian window, σ = 1.5,
    /// K1 = 0.01, K2 = 0.03, L = 1), 1 for equal pictures; `None` if the frame is smaller than the window, or
    /// has more than [`MAX_PERCEIVED`] pixels.
    ///
    /// Excluded pixels count as equal.
    pub ssim: Option<f64>,
    /// Mean ꟻLIP over the whole frame, as both pictures are stored: 0 for equal pictures, at most 1; `None` unless it was
    /// asked for, as it takes twice as long as all others together ([`Perceived`]).
    pub flip: Option<f64>,
}

impl Difference {
    /// Returns the share of the compared pixels that `count` pixels are, in 0..=1; 0 if none was compared.
    pub fn share(&self, count: usize) -> f64 {
        match self.compared {
            0 => 0.0,
            compared => count as f64 / compared as f64,
        }
    }
}

/// Two pictures that cannot be compared: their sizes differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizeMismatch {
    /// Width and height of the reference.
    pub reference: [usize; 2],
    /// Width and height of the other picture.
    pub actual: [usize; 2],
}

impl SizeMismatch {
    fn check(reference: [usize; 2], actual: [usize; 2]) -> Result<(), SizeMismatch> {
        match reference == actual {
            true => Ok(()),
            false => Err(SizeMismatch { reference, actual }),
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

/// Returns the difference of `actual` from `reference`, over all pixels.
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

/// Returns the difference of `actual` from `reference`, over the pixels for whose column and row `included` holds.
///
/// Exclude pixels that differ for a known reason, such as those where two renderers show different polygons: they are
/// counted in [`Difference::excluded`] and enter nothing else.
///
/// # Errors
/// If the sizes differ.
pub fn compare_where(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    included: impl Fn(usize, usize) -> bool,
) -> Result<Difference, SizeMismatch> {
    SizeMismatch::check(reference.size(), actual.size())?;
    let mut sums = ErrorSums::default();
    let mut percentile = Percentile::new(PERCENTILE);
    let mut ssim = MeanSsim::new(reference.size());
    let mut luminance = [(); 2].map(|()| Vec::new());
    for_each_row(reference, actual, |y, r_row, a_row| {
        luminance.iter_mut().for_each(Vec::clear);
        for (x, (&r, &a)) in r_row.iter().zip(a_row).enumerate() {
            let difference = PixelDifference::new(r, a);
            let included = included(x, y);
            if included {
                sums.add([x, y], difference.as_ref());
                percentile.extend(difference.as_ref().map(PixelDifference::largest));
            } else {
                sums.counts.excluded += 1;
            }
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
    let p99 = percentile.find(|visit| {
        for_each_row(reference, actual, |y, r_row, a_row| {
            for (x, (&r, &a)) in r_row.iter().zip(a_row).enumerate() {
                if let (Some(difference), true) = (PixelDifference::new(r, a), included(x, y)) {
                    visit(difference.largest());
                }
            }
        });
    });
    Ok(sums.finish(p99, ssim.map(MeanSsim::finish)))
}

/// The difference of a pixel that one of the pictures covers, or both.
struct PixelDifference {
    /// Errors of red, green and blue in grey levels, each at least that of alpha.
    errors: [f64; 3],
    /// True if a channel is not the same.
    differs: bool,
    /// True if only one of the pictures covers the pixel.
    is_mismatch: bool,
    /// True if a channel is infinite or not a number in one of the pictures, or in both.
    is_not_finite: bool,
    /// True if such a channel is not the same.
    is_not_finite_differing: bool,
    /// Luminance of the actual picture minus the reference's, in grey levels; 0 at a mismatch.
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

    /// Returns the difference of two pixels, `None` if neither picture covers them.
    fn new(reference: Levels, actual: Levels) -> Option<PixelDifference> {
        let covered = [reference, actual].map(|pixel| pixel.alpha() != 0.0);
        if covered == [false, false] {
            return None;
        }
        // Most pixels of pictures that are compared are equal. One with NaN is not equal to itself here.
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
        let luminance = match is_mismatch {
            true => 0.0,
            false => actual.luminance() - reference.luminance(),
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

/// Returns the absolute differences of red, green, blue and alpha, in grey levels. A channel that is not finite in one of the
/// pictures, or otherwise in the other, is off by the full range, so that no mean is lost or hides it.
fn channel_errors(reference: Levels, actual: Levels) -> [f64; 4] {
    core::array::from_fn(|c| {
        let (r, a) = (reference.0[c], actual.0[c]);
        let error = (a - r).abs();
        match error.is_finite() {
            true => error,
            false if r == a || (r.is_nan() && a.is_nan()) => 0.0,
            false => 255.0,
        }
    })
}

/// Sums over pixels, in grey levels.
#[derive(Default)]
struct ErrorSums {
    /// The counts, and the largest error.
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
