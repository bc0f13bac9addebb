//! Where finished runs of pixels go: a stored picture or a linear one.

use crate::encoding::quantise;
use crate::frame::Frame;
use crate::picture::{LinearPicture, Picture, Picture8};

/// A colour as it is stored.
pub(crate) trait Texel: Copy + Send + Sync {
    /// A drawn colour: clamped to 0..=1, opaque.
    fn drawn(rgb: [f32; 3]) -> Self;
    /// A pixel that is partly covered: colour and alpha, all in 0..=1.
    fn mixed(texel: [f32; 4]) -> Self;
    /// The background: clamped to 0..=1, transparent.
    fn background(rgb: [f32; 3]) -> Self;
    /// Texels and background as bytes, if that is what they are.
    fn bytes(texels: &mut [Self], background: Self) -> Option<(&mut [[u8; 4]], [u8; 4])> {
        let _ = (texels, background);
        None
    }
}

impl Texel for [u8; 4] {
    #[inline(always)]
    fn drawn([r, g, b]: [f32; 3]) -> Self {
        [quantise(r), quantise(g), quantise(b), 255]
    }
    fn mixed(texel: [f32; 4]) -> Self {
        texel.map(quantise)
    }
    fn background(rgb: [f32; 3]) -> Self {
        let [r, g, b, _] = Self::drawn(rgb);
        [r, g, b, 0]
    }
    fn bytes(texels: &mut [Self], background: Self) -> Option<(&mut [[u8; 4]], [u8; 4])> {
        Some((texels, background))
    }
}

impl Texel for [f32; 4] {
    #[inline(always)]
    fn drawn([r, g, b]: [f32; 3]) -> Self {
        let clamp = |c: f32| c.clamp(0.0, 1.0);
        [clamp(r), clamp(g), clamp(b), 1.0]
    }
    fn mixed(texel: [f32; 4]) -> Self {
        texel
    }
    fn background(rgb: [f32; 3]) -> Self {
        let [r, g, b, _] = Self::drawn(rgb);
        [r, g, b, 0.0]
    }
}

/// A picture that takes finished runs, whatever its texels are: one indirect call a run, so that the engines are
/// compiled once for both kinds.
pub(crate) trait Target {
    /// Stores a run of pixels from (`x`, `row`) on.
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]);
}

impl<T: Texel> Target for Picture<T> {
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]) {
        for (texel, colour) in self.row_mut(row)[x..].iter_mut().zip(colours) {
            *texel = T::drawn(*colour);
        }
    }
}

/// An empty stored picture for `frame`: its background, alpha 0.
pub(crate) fn picture8(frame: &Frame) -> Picture8 {
    Picture::new(
        frame.picture_width(),
        frame.picture_height(),
        Texel::background(frame.background()),
    )
}

/// An empty linear picture for `frame`: its background, alpha 0.
pub(crate) fn linear_picture(frame: &Frame) -> LinearPicture {
    Picture::new(
        frame.picture_width(),
        frame.picture_height(),
        Texel::background(frame.background()),
    )
}

/// As [`linear_picture`], with a texel for each sample.
pub(crate) fn linear_samples(frame: &Frame) -> LinearPicture {
    Picture::new(
        frame.width(),
        frame.height(),
        Texel::background(frame.background()),
    )
}

/// Empties a stored picture of the size of the frame's picture.
pub(crate) fn clear(frame: &Frame, picture: &mut Picture8) {
    picture
        .texels_mut()
        .fill(Texel::background(frame.background()));
}
