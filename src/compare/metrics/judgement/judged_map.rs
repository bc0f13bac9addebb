//! Maps with the marks of a judgement: radius, left-out pixels, and the frame of a region.

use super::super::map::{BEYOND, COVERAGE, EQUAL, absolute_colour, difference_map};
use super::error_rows::for_each_error_row;
use super::{LargestRegion, Selection};
use crate::compare::metrics::SizeMismatch;
use crate::picture::{LevelRows, Picture8};

/// The colour of pixels that are left out: dark grey.
pub const LEFT_OUT: [u8; 4] = [48, 48, 48, 255];
/// The colour of the frame around the largest region: cyan.
pub const FRAME: [u8; 4] = [0, 255, 255, 255];

/// Paints the pixels that are left out in grey.
pub fn draw_left_out(map: &mut Picture8, selection: &Selection<'_>) {
    for y in 0..map.height() {
        for (x, pixel) in map.row_mut(y).iter_mut().enumerate() {
            if !selection.includes(x, y) {
                *pixel = LEFT_OUT;
            }
        }
    }
}

/// Draws the absolute difference between two pictures as [`difference_map`] does, but lets pixels
/// match others within `radius`. Pixels that match are black, the others have the colour of their
/// error. Pixels that are left out are grey.
///
/// # Errors
/// If the sizes differ.
pub fn judged_map(
    reference: &dyn LevelRows,
    actual: &dyn LevelRows,
    scale: f32,
    radius: usize,
    selection: &Selection<'_>,
) -> Result<Picture8, SizeMismatch> {
    let mut map = difference_map(reference, actual, scale)?;
    if radius > 0 {
        for_each_error_row(reference, actual, radius, selection, |y, errors| {
            for (pixel, error) in map.row_mut(y).iter_mut().zip(errors) {
                *pixel = match *error {
                    None | Some(0.0) => EQUAL,
                    Some(_) if *pixel == COVERAGE => COVERAGE,
                    Some(f64::INFINITY) => BEYOND,
                    Some(error) => absolute_colour(error, f64::from(scale)),
                };
            }
        });
    }
    draw_left_out(&mut map, selection);
    Ok(map)
}

/// Draws a frame one pixel outside the rectangle of a region, and clips it to the map.
pub fn draw_frame(map: &mut Picture8, region: &LargestRegion) {
    let (size, [x, y]) = ([map.width(), map.height()], region.corner);
    let [right, bottom] = [x + region.size[0], y + region.size[1]];
    let mut set = |x: Option<usize>, y: Option<usize>| {
        if let (Some(x), Some(y)) = (x, y)
            && x < size[0]
            && y < size[1]
        {
            map.row_mut(y)[x] = FRAME;
        }
    };
    let (left, top) = (x.checked_sub(1), y.checked_sub(1));
    for x in left.unwrap_or(0)..=right {
        set(Some(x), top);
        set(Some(x), Some(bottom));
    }
    for y in y..bottom {
        set(left, Some(y));
        set(Some(right), Some(y));
    }
}
