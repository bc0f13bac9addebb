//! Where colours go: bytes, linear floats, or the mean of several samples.

use crate::frame::Frame;
use crate::picture::encoding::quantise;
use crate::picture::{LinearPicture, Picture, Picture8};
use alloc::vec;
use alloc::vec::Vec;

/// A colour as a picture stores it.
pub(super) trait Stored: Copy + Send + Sync {
    /// Stores a drawn colour: clamped to 0..=1, opaque.
    fn drawn(rgb: [f32; 3]) -> Self;
    /// Stores a pixel that is partly covered: colour and alpha, all in 0..=1.
    fn mixed(rgba: [f32; 4]) -> Self;
    /// Stores the background: clamped to 0..=1, transparent.
    fn background(rgb: [f32; 3]) -> Self;
    /// Returns pixels and background as bytes, if that is what they are.
    #[cfg(feature = "simd")]
    fn bytes(pixels: &mut [Self], background: Self) -> Option<(&mut [[u8; 4]], [u8; 4])>;
}

impl Stored for [u8; 4] {
    #[inline(always)]
    fn drawn([r, g, b]: [f32; 3]) -> Self {
        [quantise(r), quantise(g), quantise(b), 255]
    }
    fn mixed(rgba: [f32; 4]) -> Self {
        rgba.map(quantise)
    }
    fn background(rgb: [f32; 3]) -> Self {
        let [r, g, b, _] = Self::drawn(rgb);
        [r, g, b, 0]
    }
    #[cfg(feature = "simd")]
    fn bytes(pixels: &mut [Self], background: Self) -> Option<(&mut [[u8; 4]], [u8; 4])> {
        Some((pixels, background))
    }
}

impl Stored for [f32; 4] {
    #[inline(always)]
    fn drawn(rgb: [f32; 3]) -> Self {
        let [r, g, b] = rgb.map(|c| c.clamp(0.0, 1.0));
        [r, g, b, 1.0]
    }
    fn mixed(rgba: [f32; 4]) -> Self {
        rgba
    }
    fn background(rgb: [f32; 3]) -> Self {
        let [r, g, b, _] = Self::drawn(rgb);
        [r, g, b, 0.0]
    }
    #[cfg(feature = "simd")]
    fn bytes(_: &mut [Self], _: Self) -> Option<(&mut [[u8; 4]], [u8; 4])> {
        None
    }
}

/// A picture, or some rows of one, that takes finished runs, whatever it stores: engines are compiled once for all kinds.
pub(super) trait Target {
    /// Stores a run of pixels from (`x`, `row`) on, linear and not clamped.
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]);
    /// Returns the pixels of row `row` and the background, where they are stored as bytes: then all of them may be stored
    /// there.
    #[cfg(feature = "simd")]
    fn bytes(&mut self, row: usize) -> Option<(&mut [[u8; 4]], [u8; 4])>;
}

/// Pixels that are stored as they are drawn.
struct Rows<'a, T> {
    pixels: &'a mut [T],
    width: usize,
    #[cfg_attr(not(feature = "simd"), expect(dead_code))]
    background: T,
}

impl<T: Stored> Target for Rows<'_, T> {
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]) {
        let row = &mut self.pixels[row * self.width..][..self.width];
        for (pixel, colour) in row[x..].iter_mut().zip(colours) {
            *pixel = T::drawn(*colour);
        }
    }
    #[cfg(feature = "simd")]
    fn bytes(&mut self, row: usize) -> Option<(&mut [[u8; 4]], [u8; 4])> {
        T::bytes(
            &mut self.pixels[row * self.width..][..self.width],
            self.background,
        )
    }
}

/// A box filter in linear light: the mean of each pixel's n × n samples, where the background stands for those that nothing
/// covers; alpha is the share of those that something does.
///
/// Sums are exact: an f64 holds any 64 numbers of 24 bits each and of one magnitude, so that what is constant stays so.
struct BoxFilter<'a, T> {
    pixels: &'a mut [T],
    width: usize,
    samples: usize,
    background: [f32; 3],
    /// The row of pixels that is being collected; those before it are finished.
    row: usize,
    /// Sum of the colours and number of the covered samples, by pixel.
    sums: Vec<([f64; 3], u32)>,
}

impl<T: Stored> BoxFilter<'_, T> {
    /// Stores the row that was being collected.
    fn flush(&mut self) {
        let all = (self.samples * self.samples) as f64;
        let row = &mut self.pixels[self.row * self.width..][..self.width];
        for (pixel, (sum, covered)) in row.iter_mut().zip(&mut self.sums) {
            if *covered > 0 {
                let share = f64::from(*covered);
                let mean = |c: usize| {
                    ((sum[c] + (all - share) * f64::from(self.background[c])) / all) as f32
                };
                *pixel = T::mixed([mean(0), mean(1), mean(2), (share / all) as f32]);
                (*sum, *covered) = ([0.0; 3], 0);
            }
        }
    }
}

impl<T: Stored> Target for BoxFilter<'_, T> {
    /// Takes rows in order.
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]) {
        if row / self.samples != self.row {
            self.flush();
            self.row = row / self.samples;
        }
        for (column, colour) in (x..).zip(colours) {
            let (sum, covered) = &mut self.sums[column / self.samples];
            for (sum, channel) in sum.iter_mut().zip(colour) {
                *sum += f64::from(channel.clamp(0.0, 1.0));
            }
            *covered += 1;
        }
    }
    #[cfg(feature = "simd")]
    fn bytes(&mut self, _: usize) -> Option<(&mut [[u8; 4]], [u8; 4])> {
        None
    }
}

/// Draws into `pixels`, whole rows of the frame's picture that hold its background, what `draw` gives sample by sample, row by
/// row; row 0 is the first one of them.
pub(super) fn draw_rows<T: Stored>(
    frame: &Frame,
    pixels: &mut [T],
    draw: impl FnOnce(&mut dyn Target),
) {
    let (width, samples) = (frame.picture_width(), frame.samples());
    if samples == 1 {
        let background = T::background(frame.background());
        return draw(&mut Rows {
            pixels,
            width,
            background,
        });
    }
    let mut filter = BoxFilter {
        pixels,
        width,
        samples,
        background: frame.background(),
        row: 0,
        sums: vec![([0.0; 3], 0); width],
    };
    draw(&mut filter);
    filter.flush();
}

/// Does the same for a `draw` that comes back to what it drew: all samples are kept until it is done.
pub(super) fn draw_anyhow<T: Stored>(
    frame: &Frame,
    pixels: &mut [T],
    draw: impl FnOnce(&mut dyn Target),
) {
    if frame.samples() == 1 {
        return draw_rows(frame, pixels, draw);
    }
    let mut samples = linear_samples(frame);
    draw(&mut Rows {
        width: frame.width(),
        background: [0.0; 4],
        pixels: samples.texels_mut(),
    });
    draw_rows(frame, pixels, |target| {
        for row in 0..samples.height() {
            for (x, [r, g, b, alpha]) in samples.row(row).iter().copied().enumerate() {
                if alpha > 0.0 {
                    target.store(x, row, &[[r, g, b]]);
                }
            }
        }
    });
}

/// Returns an empty picture of bytes for `frame`: its background, alpha 0.
pub(super) fn picture8(frame: &Frame) -> Picture8 {
    empty(frame)
}

/// Returns an empty linear picture for `frame`: its background, alpha 0.
pub(super) fn linear_picture(frame: &Frame) -> LinearPicture {
    empty(frame)
}

fn empty<T: Stored>(frame: &Frame) -> Picture<T> {
    let background = T::background(frame.background());
    Picture::new(frame.picture_width(), frame.picture_height(), background)
}

/// Returns an empty linear picture with a pixel for each sample.
pub(super) fn linear_samples(frame: &Frame) -> LinearPicture {
    let background = Stored::background(frame.background());
    Picture::new(frame.width(), frame.height(), background)
}
