//! Pictures in memory, as grey levels, and in files. A picture is a rectangle of pixels with row 0
//! at the top.
//!
//! A method draws a [`Picture8`] or a [`LinearPicture`], or draws into any memory through a
//! [`PictureMut`]. [`encoding`] converts linear intensities to stored grey levels. With the feature
//! `io`, `image_file` reads and writes files.
//!
//! ```
//! use fastphong::picture::encoding::store;
//! use fastphong::picture::{Encoding, LinearPicture};
//!
//! let grey = LinearPicture::new(2, 1, [0.5, 0.5, 0.5, 1.0]);
//! assert_eq!(store(&grey, Encoding::Linear).get(0, 0), [128, 128, 128, 255]);
//! assert_eq!(store(&grey, Encoding::Srgb).get(0, 0), [188, 188, 188, 255]);
//! ```

mod alpha;
mod borrowed;
pub mod encoding;
#[cfg(feature = "io")]
pub mod image_file;
mod pixel;

pub use alpha::{Alpha, over};
pub use borrowed::PictureMut;
pub(crate) use borrowed::PixelsMut;
pub use encoding::Encoding;
pub use pixel::{LevelRows, Levels, Pixel};

use alloc::vec;
use alloc::vec::Vec;

/// A colour, or a coefficient per channel: red, green, blue; linear, usually in 0..=1.
pub type Rgb = [f32; 3];

/// A rectangle of pixels, stored row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture<T> {
    width: usize,
    height: usize,
    pixels: Vec<T>,
}

/// A picture in eight bits: red, green, blue, alpha in 0..=255. Alpha is 255 in fully covered
/// pixels, 0 where nothing was drawn, and the covered share in between. It is straight unless the
/// frame asks for the other kind of [`Alpha`].
pub type Picture8 = Picture<[u8; 4]>;

/// A picture before rounding: linear red, green, blue in 0..=1. Alpha is 1 in fully covered pixels,
/// 0 where nothing was drawn, and the covered share in between. It is straight unless the frame
/// asks for the other kind of [`Alpha`].
pub type LinearPicture = Picture<[f32; 4]>;

impl<T: Copy> Picture<T> {
    /// Makes a picture of `width` × `height` pixels, each set to `fill`.
    ///
    /// # Panics
    /// If the pixels do not fit into memory.
    pub fn new(width: usize, height: usize, fill: T) -> Self {
        Picture {
            width,
            height,
            // A product that overflows saturates, and `vec!` then panics.
            pixels: vec![fill; width.saturating_mul(height)],
        }
    }

    /// Makes a picture from `pixels`, row by row from the top. Returns `None` unless there are
    /// `width` × `height` of them.
    pub fn from_pixels(width: usize, height: usize, pixels: Vec<T>) -> Option<Self> {
        (width.checked_mul(height) == Some(pixels.len())).then_some(Picture {
            width,
            height,
            pixels,
        })
    }

    /// Returns how many pixels a row has.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Returns how many rows there are.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Returns all pixels, row by row from the top.
    pub fn pixels(&self) -> &[T] {
        &self.pixels
    }

    /// Returns all pixels for writing.
    pub fn pixels_mut(&mut self) -> &mut [T] {
        &mut self.pixels
    }

    /// Returns all pixels as a vector, without a copy.
    pub fn into_pixels(self) -> Vec<T> {
        self.pixels
    }

    /// Returns all rows, from the top.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[T]> {
        (0..self.height).map(|y| self.row(y))
    }

    /// Returns one row of pixels.
    pub fn row(&self, y: usize) -> &[T] {
        &self.pixels[y * self.width..][..self.width]
    }

    /// Returns one row of pixels for writing.
    pub fn row_mut(&mut self, y: usize) -> &mut [T] {
        &mut self.pixels[y * self.width..][..self.width]
    }

    /// Returns the pixel in column `x` of row `y`.
    pub fn get(&self, x: usize, y: usize) -> T {
        self.row(y)[x]
    }

    /// Returns the picture with every pixel passed through `f`.
    pub fn map<U: Copy>(&self, f: impl Fn(T) -> U) -> Picture<U> {
        Picture {
            width: self.width,
            height: self.height,
            pixels: self.pixels.iter().map(|&t| f(t)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_whose_product_overflows_are_no_picture() {
        let side = 1usize << (usize::BITS / 2);
        // The product is 0, apart from the bits that overflow.
        assert_eq!(Picture::<u8>::from_pixels(side, side, Vec::new()), None);
        assert_eq!(Picture::from_pixels(2, 2, vec![0u8; 3]), None);
        assert!(Picture::from_pixels(2, 2, vec![0u8; 4]).is_some());
        assert!(Picture::<u8>::from_pixels(0, 3, Vec::new()).is_some());
    }

    #[test]
    #[should_panic(expected = "capacity overflow")]
    fn a_picture_of_more_pixels_than_can_be_counted_is_not_a_small_one() {
        let side = 1usize << (usize::BITS / 2);
        Picture::new(side, side, 0u8);
    }
}
