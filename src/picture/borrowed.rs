//! A picture that the caller owns, borrowed for drawing.

use super::{LinearPicture, Picture8};

/// A mutable view of a picture that the caller owns, for
/// [`Variant::draw`](crate::shading::Variant::draw): rows of pixels from the top, in one of four
/// formats. Any [`Picture8`] or [`LinearPicture`] becomes one by `(&mut picture).into()`.
///
/// Alpha is straight, and 0 where nothing was drawn. `draw` checks the sizes; the constructors here
/// do not.
///
/// Rows need not be adjacent in memory ([`PictureMut::stride`]). A *viewport* is a part of a
/// picture ([`PictureMut::part`]), and nothing outside it is written.
#[derive(Debug)]
pub struct PictureMut<'a> {
    pub(crate) pixels: PixelsMut<'a>,
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) stride: usize,
}

/// The pixels, in one of the formats.
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

    /// Borrows four bytes per pixel: red, green, blue, alpha. `bytes.as_chunks_mut().0` turns a
    /// slice of bytes into pixels.
    pub fn rgba8(pixels: &'a mut [[u8; 4]], width: usize, height: usize) -> Self {
        PictureMut::new(PixelsMut::Rgba8(pixels), width, height)
    }

    /// Borrows four bytes per pixel: blue, green, red, alpha.
    pub fn bgra8(pixels: &'a mut [[u8; 4]], width: usize, height: usize) -> Self {
        PictureMut::new(PixelsMut::Bgra8(pixels), width, height)
    }

    /// Borrows one `u32` per pixel: `0xAARRGGBB` in the machine's byte order, as window libraries
    /// (`softbuffer`, `minifb`) expect it.
    pub fn argb(pixels: &'a mut [u32], width: usize, height: usize) -> Self {
        PictureMut::new(PixelsMut::Argb(pixels), width, height)
    }

    /// Borrows four floats per pixel: linear red, green, blue and alpha, clamped to 0..=1 and not
    /// rounded.
    pub fn linear(pixels: &'a mut [[f32; 4]], width: usize, height: usize) -> Self {
        PictureMut::new(PixelsMut::Linear(pixels), width, height)
    }

    /// Sets the distance from one row to the next, in pixels. By default it is the width. Pixels
    /// between two rows are never written.
    #[must_use]
    pub fn stride(self, stride: usize) -> Self {
        PictureMut { stride, ..self }
    }

    /// Returns a part of the picture, as the viewport of a frame: `width` × `height` pixels from
    /// column `x` and row `y` on. A part that reaches beyond the picture is cut off at its edge. A
    /// frame of the intended size then no longer fits, and drawing fails with
    /// [`DrawError::Size`](crate::raster::DrawError::Size).
    ///
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::picture::{Picture8, PictureMut};
    /// use fastphong::raster::DrawOptions;
    /// use fastphong::scene::Scene;
    /// use fastphong::shading::methods;
    ///
    /// // Two views side by side, with a margin of 8 pixels.
    /// let mut picture = Picture8::new(152, 64, [9; 4]);
    /// let mut scene = Scene::of_mesh(builtin("teapot?res=4")?);
    /// (scene.width, scene.height) = (64, 48);
    /// let frame = scene.frame()?;
    /// for (x, method) in [(8, methods::GOURAUD), (80, methods::PHONG_RSQRT)] {
    ///     let part = PictureMut::from(&mut picture).part([x, 8], [64, 48]);
    ///     method.variant().draw(&frame, part, DrawOptions::default())?;
    /// }
    /// assert_eq!([picture.get(7, 30), picture.get(75, 30)], [[9; 4]; 2], "the margin");
    /// assert_eq!([picture.get(40, 32)[3], picture.get(112, 32)[3]], [255; 2]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn part(self, [x, y]: [usize; 2], [width, height]: [usize; 2]) -> Self {
        let PictureMut { pixels, stride, .. } = self;
        let (x, y) = (x.min(self.width), y.min(self.height));
        let (width, height) = (width.min(self.width - x), height.min(self.height - y));
        let first = y.saturating_mul(stride).saturating_add(x);
        PictureMut {
            pixels: match pixels {
                PixelsMut::Rgba8(pixels) => PixelsMut::Rgba8(from(pixels, first)),
                PixelsMut::Bgra8(pixels) => PixelsMut::Bgra8(from(pixels, first)),
                PixelsMut::Argb(pixels) => PixelsMut::Argb(from(pixels, first)),
                PixelsMut::Linear(pixels) => PixelsMut::Linear(from(pixels, first)),
            },
            width,
            height,
            stride,
        }
    }

    /// Returns how many pixels the slice holds.
    pub(crate) fn len(&self) -> usize {
        match &self.pixels {
            PixelsMut::Rgba8(pixels) | PixelsMut::Bgra8(pixels) => pixels.len(),
            PixelsMut::Argb(pixels) => pixels.len(),
            PixelsMut::Linear(pixels) => pixels.len(),
        }
    }
}

/// Returns the pixels from index `first` on, or none if the slice is shorter.
fn from<P>(pixels: &mut [P], first: usize) -> &mut [P] {
    pixels.get_mut(first..).unwrap_or_default()
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
