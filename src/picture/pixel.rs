//! Pixels of any kind, read as grey levels.

use super::Picture;

/// Weights of red, green and blue in luminance (ITU-R BT.709-6, item 3.2).
const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Red, green, blue, alpha in grey levels: 0 is black, 255 is full. These are the units of a stored
/// picture, with fractions.
///
/// An 8-bit pixel and the difference of two of them are exact in this unit, so that a threshold of
/// a whole level is exact. Multiples of `1.0 / 255.0` are not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levels(pub [f64; 4]);

impl Levels {
    /// Returns red, green, blue.
    pub fn rgb(self) -> [f64; 3] {
        [self.0[0], self.0[1], self.0[2]]
    }

    /// Returns alpha, the covered share: 255 where the whole pixel was drawn.
    pub fn alpha(self) -> f64 {
        self.0[3]
    }

    /// Returns the luminance in grey levels: the Rec. 709 weights, applied to the stored values. A
    /// channel that is not finite counts as 0.
    pub fn luminance(self) -> f64 {
        LUMINANCE
            .iter()
            .zip(self.rgb())
            .map(|(weight, c)| if c.is_finite() { weight * c } else { 0.0 })
            .sum()
    }
}

/// A pixel that can be compared, because it can be converted to grey levels.
pub trait Pixel: Copy {
    /// Returns this pixel in grey levels.
    fn levels(self) -> Levels;
}

impl Pixel for [u8; 4] {
    fn levels(self) -> Levels {
        Levels(self.map(f64::from))
    }
}

impl Pixel for [f32; 4] {
    fn levels(self) -> Levels {
        Levels(self.map(|c| 255.0 * f64::from(c)))
    }
}

impl Pixel for Levels {
    fn levels(self) -> Levels {
        self
    }
}

/// A picture that is read in grey levels, one row at a time, so that comparing large pictures needs
/// little memory.
pub trait LevelRows {
    /// Returns width and height in pixels.
    fn size(&self) -> [usize; 2];

    /// Writes row `y` into `levels`, which has one entry per column.
    fn level_row(&self, y: usize, levels: &mut [Levels]);
}

impl<P: Pixel> LevelRows for Picture<P> {
    fn size(&self) -> [usize; 2] {
        [self.width(), self.height()]
    }

    fn level_row(&self, y: usize, levels: &mut [Levels]) {
        for (levels, pixel) in levels.iter_mut().zip(self.row(y)) {
            *levels = pixel.levels();
        }
    }
}
