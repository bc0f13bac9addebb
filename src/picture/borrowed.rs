//! A picture in memory that the caller owns, borrowed to be drawn into.

use super::{LinearPicture, Picture8};

/// A picture that the caller owns, as [`Variant::draw`](crate::shading::Variant::draw) takes it: rows of pixels from the top, in one
/// of four formats. Any [`Picture8`] and [`LinearPicture`] is one: `(&mut picture).into()`.
///
/// Alpha is straight, 0 where nothing was drawn. Sizes are compared where it is drawn into, not here.
#[derive(Debug)]
pub struct PictureMut<'a> {
    pub(crate) pixels: PixelsMut<'a>,
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) stride: usize,
}

/// Pixels in one of the formats.
#[derive(Debug)]
pub(crate) enum PixelsMut<'a> {
    Rgba8(&'a mut [[u8; 4]]),
    Bgra8(&'a mut [[u8; 4]]),
    Argb(&'a mut [u32]),
    Linear(&'a mut [[f32; 4]]),
}

impl<'a> PictureMut<'a> {
    fn new(pixels: PixelsMut<'a>, width: usize, height: usize) -> Self {
        PictureMut {
            pixels,
            width,
            height,
            stride: width,
        }
    }

    /// Borrows bytes: red, green, blue, alpha. `bytes.as_chunks_mut().0` makes pixels of a slice of bytes.
    pub fn rgba8(pixels: &'a mut [[u8; 4]], width: usize, height: usize) -> Self {
        PictureMut::new(PixelsMut::Rgba8(pixels), width, height)
    }

    /// Borrows bytes: blue, green, red, alpha.
    pub fn bgra8(pixels: &'a mut [[u8; 4]], width: usize, height: usize) -> Self {
        PictureMut::new(PixelsMut::Bgra8(pixels), width, height)
    }

    /// Borrows numbers: `0xAARRGGBB`, in the byte order of the machine, as windows (`softbuffer`, `minifb`) take them.
    pub fn argb(pixels: &'a mut [u32], width: usize, height: usize) -> Self {
        PictureMut::new(PixelsMut::Argb(pixels), width, height)
    }

    /// Borrows floats: linear red, green, blue and alpha, stored in 0..=1 and not rounded.
    pub fn linear(pixels: &'a mut [[f32; 4]], width: usize, height: usize) -> Self {
        PictureMut::new(PixelsMut::Linear(pixels), width, height)
    }

    /// Sets the distance from one row to the next, in pixels; without it rows touch. What lies between two rows is never written.
    #[must_use]
    pub fn stride(self, stride: usize) -> Self {
        PictureMut { stride, ..self }
    }

    /// Returns the number of pixels that it was given.
    pub(crate) fn len(&self) -> usize {
        match &self.pixels {
            PixelsMut::Rgba8(pixels) | PixelsMut::Bgra8(pixels) => pixels.len(),
            PixelsMut::Argb(pixels) => pixels.len(),
            PixelsMut::Linear(pixels) => pixels.len(),
        }
    }
}

impl<'a> From<&'a mut Picture8> for PictureMut<'a> {
    fn from(picture: &'a mut Picture8) -> Self {
        let (width, height) = (picture.width(), picture.height());
        PictureMut::rgba8(picture.pixels_mut(), width, height)
    }
}

impl<'a> From<&'a mut LinearPicture> for PictureMut<'a> {
    fn from(picture: &'a mut LinearPicture) -> Self {
        let (width, height) = (picture.width(), picture.height());
        PictureMut::linear(picture.pixels_mut(), width, height)
    }
}
