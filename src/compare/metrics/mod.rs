//! A picture against a picture: the error of a method in numbers and as a map.
//!
//! Values are compared as stored: linear pictures in linear light, encoded ones in their encoding. Compare only pictures
//! that are stored the same way.
//!
//! Errors are kept in 0..=1, as colours are; [`METRICS`] states them in grey levels (1/255), as people do.
//!
//! # Which pixels count
//! A pixel that neither picture covers, and that has the same colour in both, is *background*: it is left out of every
//! mean, as more of it would flatter every method. All others are *compared*, with the colours that the two pictures
//! store; a pixel that only one of them covers is counted as a coverage mismatch as well. Only PSNR, SSIM,
//! ꟻLIP and `frame_rms` are taken over the whole frame, so that they equal what other tools report.

use alloc::vec::Vec;
use core::fmt;

use crate::picture::Picture;

mod flip;
mod list;
mod map;
mod ssim;

use crate::picture::{Levels, Pixel};
pub use flip::{Perceived, flip_colours, mean_flip};
pub use list::{Better, METRICS, MetricInfo};
pub use map::{BEYOND, BEYOND_DARKER, COVERAGE, EQUAL, difference_map, signed_difference_map};

/// Share of the compared pixels whose error does not exceed [`Difference::p99`].
const PERCENTILE: f64 = 0.99;

/// The difference between two pictures, in numbers.
///
/// A pixel's error is the largest absolute difference of its three channels, in 0..=1 for values in 0..=1. A channel
/// that is not finite in one of the pictures counts as an error of 1.
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
    /// Compared pixels whose colour is not the same to the last bit.
    pub differing: usize,
    /// Compared pixels with an error of more than half a grey level, 0.5/255: those that may be stored differently.
    pub over_half_level: usize,
    /// Compared pixels with an error of more than one grey level, 1/255.
    pub over_one_level: usize,
    /// Pixels whose alpha differs: only one of the pictures covers them.
    pub coverage_mismatches: usize,
    /// Compared pixels with a channel that is infinite or not a number in either picture.
    pub not_finite: usize,
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
    /// K1 = 0.01, K2 = 0.03, L = 1), 1 for equal pictures; `None` if the frame is smaller than the window.
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
    fn check<A: Copy, B: Copy>(
        reference: &Picture<A>,
        actual: &Picture<B>,
    ) -> Result<(), SizeMismatch> {
        let sizes = SizeMismatch {
            reference: [reference.width(), reference.height()],
            actual: [actual.width(), actual.height()],
        };
        match sizes.reference == sizes.actual {
            true => Ok(()),
            false => Err(sizes),
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
pub fn compare<A: Pixel, B: Pixel>(
    reference: &Picture<A>,
    actual: &Picture<B>,
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
pub fn compare_where<A: Pixel, B: Pixel>(
    reference: &Picture<A>,
    actual: &Picture<B>,
    included: impl Fn(usize, usize) -> bool,
) -> Result<Difference, SizeMismatch> {
    SizeMismatch::check(reference, actual)?;
    let (width, height) = (reference.width(), reference.height());
    let mut sums = ErrorSums::default();
    let mut luminance = [(); 2].map(|()| Vec::with_capacity(width * height));
    for y in 0..height {
        for (x, (r, a)) in reference.row(y).iter().zip(actual.row(y)).enumerate() {
            let (r, a) = (r.levels(), a.levels());
            let included = included(x, y);
            if included {
                sums.add([x, y], r, a);
            } else {
                sums.counts.excluded += 1;
            }
            luminance[0].push(r.luminance() / 255.0);
            luminance[1].push(if included { a } else { r }.luminance() / 255.0);
        }
    }
    let [reference, actual] = &luminance;
    Ok(sums.finish(ssim::mean_ssim(reference, actual, width)))
}

/// Sums over pixels, in grey levels.
#[derive(Default)]
struct ErrorSums {
    /// The counts, and the largest error.
    counts: Difference,
    absolute: f64,
    squares: f64,
    signed: f64,
    /// The error of each compared pixel.
    errors: Vec<f64>,
}

impl ErrorSums {
    fn add(&mut self, at: [usize; 2], reference: Levels, actual: Levels) {
        let counts = &mut self.counts;
        counts.frame += 1;
        let differs = reference.rgb() != actual.rgb();
        counts.coverage_mismatches += usize::from(reference.alpha() != actual.alpha());
        if !differs && reference.alpha() == 0.0 && actual.alpha() == 0.0 {
            return;
        }
        let (errors, are_finite) = channel_errors(reference, actual);
        let error = errors.into_iter().fold(0.0, f64::max);
        counts.differing += usize::from(differs);
        counts.not_finite += usize::from(!are_finite);
        counts.over_half_level += usize::from(error > 0.5);
        counts.over_one_level += usize::from(error > 1.0);
        if error > counts.max {
            (counts.max, counts.worst) = (error, Some(at));
        }
        self.absolute += errors.iter().sum::<f64>();
        self.squares += errors.iter().map(|e| e * e).sum::<f64>();
        self.signed += actual.luminance() - reference.luminance();
        self.errors.push(error);
    }

    fn finish(mut self, ssim: Option<f64>) -> Difference {
        let (counts, compared) = (self.counts, self.errors.len());
        let mean = |sum: f64, pixels: usize| match pixels {
            0 => 0.0,
            pixels => sum / pixels as f64,
        };
        let frame_rms = libm::sqrt(mean(self.squares, 3 * counts.frame)) / 255.0;
        Difference {
            equal: counts.differing == 0 && counts.coverage_mismatches == 0,
            compared,
            max: counts.max / 255.0,
            p99: percentile(&mut self.errors) / 255.0,
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

/// Returns the absolute differences of the channels of one pixel, in grey levels, and true if all are finite. One that is
/// not is the full range, so that no mean is lost or hides it.
fn channel_errors(reference: Levels, actual: Levels) -> ([f64; 3], bool) {
    let (r, a) = (reference.rgb(), actual.rgb());
    let errors = [0, 1, 2].map(|i| (a[i] - r[i]).abs());
    let are_finite = errors.iter().all(|error| error.is_finite());
    let finite = |error: f64| if error.is_finite() { error } else { 255.0 };
    (errors.map(finite), are_finite)
}

/// Returns the smallest error that [`PERCENTILE`] of all do not exceed (nearest rank); 0 of none. Reorders the errors.
fn percentile(errors: &mut [f64]) -> f64 {
    let rank = libm::ceil(PERCENTILE * errors.len() as f64) as usize;
    match rank.checked_sub(1) {
        Some(index) => *errors.select_nth_unstable_by(index, f64::total_cmp).1,
        None => 0.0,
    }
}

#[cfg(test)]
mod tests;
