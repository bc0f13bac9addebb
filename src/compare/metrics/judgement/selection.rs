//! The selection of judged pixels: an area, without the pixels that a mask leaves out.

use crate::picture::{LevelRows, Levels};
use alloc::vec;
use alloc::vec::Vec;

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// The column and row of its upper left pixel.
    pub corner: [usize; 2],
    /// The width and height in pixels.
    pub size: [usize; 2],
}

impl Area {
    /// True if the area lies within a picture of this size.
    pub fn is_within(&self, size: [usize; 2]) -> bool {
        (0..2).all(|i| {
            let end = self.corner[i].checked_add(self.size[i]);
            end.is_some_and(|end| end <= size[i])
        })
    }
}

/// A mask of the pixels to leave out: those that are black or transparent in a picture. It takes a
/// bit per pixel.
#[derive(Clone, Debug)]
pub struct Mask {
    size: [usize; 2],
    /// A bit for each pixel, row by row: 1 for pixels to leave out.
    left_out: Vec<u64>,
}

impl Mask {
    /// Makes the mask of a picture.
    pub fn of(picture: &dyn LevelRows) -> Mask {
        let [width, height] = picture.size();
        let mut left_out = vec![0; (width * height).div_ceil(64)];
        let mut row = vec![Levels([0.0; 4]); width];
        for y in 0..height {
            picture.level_row(y, &mut row);
            for (x, pixel) in row.iter().enumerate() {
                let is_left_out = pixel.alpha() == 0.0 || pixel.rgb() == [0.0; 3];
                let index = y * width + x;
                left_out[index / 64] |= u64::from(is_left_out) << (index % 64);
            }
        }
        let size = picture.size();
        Mask { size, left_out }
    }

    /// Returns the width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    fn includes(&self, x: usize, y: usize) -> bool {
        let index = y * self.size[0] + x;
        self.left_out[index / 64] >> (index % 64) & 1 == 0
    }
}

/// The pixels of a picture that are judged.
#[derive(Clone, Copy, Debug)]
pub struct Selection<'a> {
    size: [usize; 2],
    area: Area,
    mask: Option<&'a Mask>,
}

impl<'a> Selection<'a> {
    /// Selects all pixels of a picture of this size.
    pub fn whole(size: [usize; 2]) -> Selection<'a> {
        let corner = [0, 0];
        Selection {
            size,
            area: Area { corner, size },
            mask: None,
        }
    }

    /// Selects the pixels of `area`, or of a whole picture of this size, that `mask` does not leave
    /// out. Returns `None` if the area reaches beyond the picture, or the mask has another size.
    pub fn new(size: [usize; 2], area: Option<Area>, mask: Option<&'a Mask>) -> Option<Self> {
        let whole = Selection::whole(size);
        let area = area.unwrap_or(whole.area);
        let fits = area.is_within(size) && mask.is_none_or(|mask| mask.size == size);
        fits.then_some(Selection {
            area,
            mask,
            ..whole
        })
    }

    /// Returns the width and height of the picture in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// True if the pixel at column `x` and row `y` is judged.
    pub fn includes(&self, x: usize, y: usize) -> bool {
        let Area { corner, size } = self.area;
        // A pixel left of or above the area wraps around to a huge offset.
        let is_in_area = x.wrapping_sub(corner[0]) < size[0] && y.wrapping_sub(corner[1]) < size[1];
        is_in_area && self.mask.is_none_or(|mask| mask.includes(x, y))
    }

    /// Returns how many pixels are left out.
    pub fn left_out(&self) -> usize {
        let [width, height] = self.size;
        let Area { corner, size } = self.area;
        let outside = width * height - size[0] * size[1];
        let masked = |mask: &Mask| {
            let rows = corner[1]..corner[1] + size[1];
            rows.map(|y| {
                let columns = corner[0]..corner[0] + size[0];
                columns.filter(|x| !mask.includes(*x, y)).count()
            })
            .sum()
        };
        outside + self.mask.map_or(0, masked)
    }

    /// Returns `actual` with the left-out pixels replaced by those of `reference`, so that metrics
    /// of neighbourhoods count them as equal.
    pub fn selected<'b>(
        &'b self,
        reference: &'b dyn LevelRows,
        actual: &'b dyn LevelRows,
    ) -> Selected<'b> {
        Selected {
            reference,
            actual,
            selection: self,
        }
    }
}

/// A picture that equals its reference at the pixels that are left out.
#[derive(Clone, Copy)]
pub struct Selected<'a> {
    reference: &'a dyn LevelRows,
    actual: &'a dyn LevelRows,
    selection: &'a Selection<'a>,
}

impl LevelRows for Selected<'_> {
    fn size(&self) -> [usize; 2] {
        self.actual.size()
    }

    fn level_row(&self, y: usize, levels: &mut [Levels]) {
        self.reference.level_row(y, levels);
        let mut actual = vec![Levels([0.0; 4]); levels.len()];
        self.actual.level_row(y, &mut actual);
        for (x, (level, actual)) in levels.iter_mut().zip(actual).enumerate() {
            if self.selection.includes(x, y) {
                *level = actual;
            }
        }
    }
}
