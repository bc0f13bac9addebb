//! A judgement of a picture: how many pixels are over a threshold, the histogram of errors, and the
//! largest connected region of pixels over the threshold.
//!
//! # The error of a pixel
//! Without a radius, it is the largest difference of a channel, as everywhere in
//! [`metrics`](super). With a radius R, a pixel may match any pixel whose column and row are at
//! most R away. This goes both ways: the error is the larger of
//!
//! - the least difference of the *reference's* pixel from the other picture's pixels within R, and
//! - the least difference of the *other picture's* pixel from the reference's pixels within R.
//!
//! So the error is symmetric. An edge that moved by R pixels has no error. A line that one picture
//! lacks keeps its whole error, however thin it is, because its pixels match nothing there. A
//! radius only hides a mark if there is another one like it within R: of two lines a pixel apart,
//! one may be missing.
//!
//! Pixels that neither picture covers are not compared. Pixels that are left out are not judged,
//! but others may match them.

mod error_rows;
mod histogram;
mod judged_map;
mod largest_region;
mod selection;
mod share;

use super::SizeMismatch;
use crate::picture::LevelRows;
pub use error_rows::MAX_RADIUS;
use error_rows::for_each_error_row;
pub use histogram::{Bin, Histogram};
pub use judged_map::{draw_frame, draw_left_out, judged_map};
pub use largest_region::LargestRegion;
use largest_region::Regions;
pub use selection::{Area, Mask, Selection};
pub use share::{Allowance, share_text};

/// The rule for a pixel to pass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rule {
    /// The largest error that passes, in grey levels. With 0, every difference counts.
    pub threshold: f64,
    /// How many columns and rows away a pixel may match, at most [`MAX_RADIUS`].
    pub radius: usize,
}

impl Rule {
    /// True if a pixel with this error, in grey levels, is over the threshold. An infinite error,
    /// of a pixel that is finite in only one picture, is over any threshold, even an infinite one.
    fn is_broken_by(self, error: f64) -> bool {
        error > self.threshold || error == f64::INFINITY
    }
}

/// The result of [`judge`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judgement {
    /// The number of judged pixels: selected ones that at least one picture covers.
    pub compared: usize,
    /// The number of pixels that the selection leaves out.
    pub left_out: usize,
    /// The number of judged pixels over the threshold.
    pub over: usize,
    /// The largest error in grey levels. It is infinite if a pixel is finite in only one picture.
    pub largest: f64,
    /// The column and row of the first pixel, in reading order, with the largest error; `None` if
    /// there is no error.
    pub worst: Option<[usize; 2]>,
    /// The histogram of errors.
    pub histogram: Histogram,
    /// The largest connected region of pixels over the threshold.
    pub region: Option<LargestRegion>,
}

/// Judges `actual` by its reference. The time is proportional to the number of pixels, and for
/// pixels that differ also to the square of the radius. It needs memory for a few rows.
///
/// # Errors
/// If the sizes differ.
pub fn judge(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    rule: Rule,
    selection: &Selection<'_>,
) -> Result<Judgement, SizeMismatch> {
    SizeMismatch::check(reference.size(), actual.size())?;
    debug_assert_eq!(reference.size(), selection.size());
    let mut found = Judgement {
        left_out: selection.left_out(),
        ..Judgement::default()
    };
    let mut regions = Regions::default();
    for_each_error_row(reference, actual, rule.radius, selection, |y, errors| {
        for (x, error) in errors.iter().enumerate() {
            let Some(error) = *error else { continue };
            found.compared += 1;
            found.over += usize::from(rule.is_broken_by(error));
            found.histogram.add(error);
            if error > found.largest {
                (found.largest, found.worst) = (error, Some([x, y]));
            }
        }
        regions.add_row(errors, |error| rule.is_broken_by(error));
    });
    found.region = regions.finish();
    Ok(found)
}

#[cfg(test)]
mod tests;
