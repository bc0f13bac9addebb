//! Computes the errors of pixels row by row, with or without a radius.

use super::super::PixelDifference;
use super::Selection;
use crate::picture::{LevelRows, Levels};
use alloc::vec;
use alloc::vec::Vec;

/// The largest radius. A pixel then has 288 neighbours; with more, a match would say little.
pub const MAX_RADIUS: usize = 8;

/// Calls `visit` with the index of each row, from the top, and the errors of its pixels in grey
/// levels. The error is `None` for pixels that are left out or that neither picture covers.
pub(super) fn for_each_error_row(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    radius: usize,
    selection: &Selection<'_>,
    mut visit: impl FnMut(usize, &[Option<f64>]),
) {
    debug_assert_eq!(reference.size(), actual.size());
    let [width, height] = reference.size();
    let mut windows = [reference, actual].map(|picture| Window::new(picture, radius));
    let mut errors = vec![None; width];
    for y in 0..height {
        let [of_reference, of_actual] = &mut windows;
        // Both pictures keep the rows around y, because a pixel of either may match any of the
        // other's.
        of_reference.move_to(y);
        of_actual.move_to(y);
        for (x, error) in errors.iter_mut().enumerate() {
            *error = if selection.includes(x, y) {
                error_at(of_reference, of_actual, [x, y])
            } else {
                None
            };
        }
        visit(y, &errors);
    }
}

/// Returns the error at a pixel, or `None` if neither picture covers it.
fn error_at(reference: &Window<'_>, actual: &Window<'_>, [x, y]: [usize; 2]) -> Option<f64> {
    let (r, a) = (reference.row(y)[x], actual.row(y)[x]);
    let error = error_between(r, a)?;
    if error == 0.0 || reference.radius == 0 {
        return Some(error);
    }
    let of_reference = actual.least_error(r, [x, y], error);
    let of_actual = reference.least_error(a, [x, y], error);
    Some(of_reference.max(of_actual))
}

/// Returns the error between two pixels, or `None` if neither is covered.
fn error_between(a: Levels, b: Levels) -> Option<f64> {
    // A fast path for covered, finite pixels, which nearly all are: with a radius, this runs
    // hundreds of times per pixel. An infinity or NaN in any channel makes the sum infinite or NaN.
    let errors: [f64; 4] = core::array::from_fn(|c| (a.0[c] - b.0[c]).abs());
    let is_covered = a.alpha() != 0.0 && b.alpha() != 0.0;
    if is_covered && errors.iter().sum::<f64>().is_finite() {
        return Some(errors.into_iter().fold(0.0, f64::max));
    }
    let difference = PixelDifference::new(a, b)?;
    Some(if difference.is_not_finite_differing {
        f64::INFINITY
    } else {
        difference.largest()
    })
}

/// The rows of a picture around the current one.
struct Window<'a> {
    picture: &'a dyn LevelRows,
    radius: usize,
    /// A ring buffer: row y is at index y modulo the number of rows, 2 `radius` + 1.
    rows: Vec<Vec<Levels>>,
    /// The first row that was not read yet.
    next: usize,
}

impl<'a> Window<'a> {
    fn new(picture: &'a dyn LevelRows, radius: usize) -> Window<'a> {
        let [width, height] = picture.size();
        // A picture may have fewer rows than that.
        let rows = (2 * radius + 1).min(height.max(1));
        Window {
            picture,
            radius,
            rows: vec![vec![Levels([0.0; 4]); width]; rows],
            next: 0,
        }
    }

    /// Reads the rows around row `y`. `y` must grow by 1 from call to call.
    fn move_to(&mut self, y: usize) {
        let end = (y + self.radius + 1).min(self.picture.size()[1]);
        while self.next < end {
            let slot = self.next % self.rows.len();
            self.picture.level_row(self.next, &mut self.rows[slot]);
            self.next += 1;
        }
    }

    /// Returns row `y`, which must be within the radius of the current one.
    fn row(&self, y: usize) -> &[Levels] {
        debug_assert!(y < self.next && y + self.rows.len() >= self.next);
        &self.rows[y % self.rows.len()]
    }

    /// Returns the smallest error of `pixel` against the pixels around (`x`, `y`). `most` is its
    /// error against the pixel at (`x`, `y`) itself. Searches rings of growing distance, because
    /// most matches are near.
    fn least_error(&self, pixel: Levels, [x, y]: [usize; 2], most: f64) -> f64 {
        let [width, height] = self.picture.size();
        let mut least = most;
        // Two uncovered pixels match.
        let error = |other: &Levels| error_between(pixel, *other).unwrap_or(0.0);
        for distance in 1..=self.radius {
            let (left, right) = (x.saturating_sub(distance), (x + distance).min(width - 1));
            let (top, bottom) = (y.saturating_sub(distance), (y + distance).min(height - 1));
            for y_near in top..=bottom {
                let row = self.row(y_near);
                if y_near.abs_diff(y) == distance {
                    least = row[left..=right].iter().map(error).fold(least, f64::min);
                } else {
                    // Between its top and bottom row, a ring has two pixels in a row, or fewer at
                    // the border of the picture.
                    let ends = [left, right]
                        .into_iter()
                        .filter(|end| end.abs_diff(x) == distance);
                    least = ends.map(|end| error(&row[end])).fold(least, f64::min);
                }
            }
            if least == 0.0 {
                break;
            }
        }
        least
    }
}
