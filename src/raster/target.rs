//! The targets of engines: pictures of bytes or linear floats, directly or through a box filter over several samples.

use crate::frame::Frame;
use crate::picture::encoding::quantise;
use crate::picture::{Alpha, LinearPicture, Picture};
use alloc::vec;
use alloc::vec::Vec;

/// A pixel as a picture stores it.
pub(super) trait Stored: Copy + Send + Sync {
    /// Stores a linear colour and alpha, clamped to 0..=1.
    fn of(rgba: [f32; 4]) -> Self;
    /// Returns pixels as bytes, if they are stored so.
    #[cfg(feature = "simd")]
    fn bytes(_pixels: &mut [Self]) -> Option<&mut [[u8; 4]]> {
        None
    }

    /// Stores the background: transparent.
    fn background(frame: &Frame) -> Self {
        let [r, g, b] = frame.background();
        Self::of([r, g, b, 0.0])
    }
}

impl Stored for [u8; 4] {
    #[inline(always)]
    fn of([r, g, b, alpha]: [f32; 4]) -> Self {
        [quantise(r), quantise(g), quantise(b), quantise(alpha)]
    }
    #[cfg(feature = "simd")]
    fn bytes(pixels: &mut [Self]) -> Option<&mut [[u8; 4]]> {
        Some(pixels)
    }
}

impl Stored for [f32; 4] {
    #[inline(always)]
    fn of(rgba: [f32; 4]) -> Self {
        rgba.map(|c| c.clamp(0.0, 1.0))
    }
}

/// A picture, or some rows of one, that takes finished runs, whatever it stores: engines are compiled once for all kinds.
pub(super) trait Target {
    /// Stores a run of pixels from (`x`, `row`) on, linear and not clamped.
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]);
    /// Returns the pixels of row `row` if they are stored as bytes: the caller may then write all of them there.
    #[cfg(feature = "simd")]
    fn bytes(&mut self, _row: usize) -> Option<&mut [[u8; 4]]> {
        None
    }
}

/// Rows of pixels that are stored as they are drawn.
struct Direct<'a, T> {
    pixels: &'a mut [T],
    width: usize,
}

impl<T: Stored> Target for Direct<'_, T> {
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]) {
        let row = &mut self.pixels[row * self.width..][..self.width];
        for (pixel, &[r, g, b]) in row[x..].iter_mut().zip(colours) {
            *pixel = T::of([r, g, b, 1.0]);
        }
    }
    #[cfg(feature = "simd")]
    fn bytes(&mut self, row: usize) -> Option<&mut [[u8; 4]]> {
        T::bytes(&mut self.pixels[row * self.width..][..self.width])
    }
}

/// A box filter in linear light: the mean of each pixel's covered samples, or of all n × n, where the background stands for
/// samples that nothing covers, as [`Alpha`] says; alpha is the covered share.
///
/// Sums are exact: an f64 holds any 64 numbers of 24 bits each and of one magnitude, so that a constant colour stays constant.
struct BoxFilter<'a, T> {
    pixels: &'a mut [T],
    frame: &'a Frame,
    /// The row of pixels that is being collected; those before it are finished.
    row: usize,
    /// Sum of the colours and number of the covered samples, by pixel.
    sums: Vec<([f64; 3], u32)>,
}

impl<T: Stored> BoxFilter<'_, T> {
    /// Stores the row that was being collected.
    fn flush(&mut self) {
        let all = self.frame.samples().pow(2) as f64;
        let background = self.frame.background().map(f64::from);
        let row = self.pixels[self.row * self.sums.len()..].iter_mut();
        for (pixel, (sum, covered)) in row.zip(&mut self.sums) {
            if *covered > 0 {
                let share = f64::from(*covered);
                let mean = |c: usize| match self.frame.alpha() {
                    Alpha::Straight => (sum[c] / share) as f32,
                    Alpha::Flattened => ((sum[c] + (all - share) * background[c]) / all) as f32,
                };
                *pixel = T::of([mean(0), mean(1), mean(2), (share / all) as f32]);
                (*sum, *covered) = ([0.0; 3], 0);
            }
        }
    }
}

impl<T: Stored> Target for BoxFilter<'_, T> {
    /// Takes rows in order.
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]) {
        let samples = self.frame.samples();
        if row / samples != self.row {
            self.flush();
            self.row = row / samples;
        }
        for (column, colour) in (x..).zip(colours) {
            let (sum, covered) = &mut self.sums[column / samples];
            for (sum, channel) in sum.iter_mut().zip(colour) {
                *sum += f64::from(channel.clamp(0.0, 1.0));
            }
            *covered += 1;
        }
    }
}

/// Has `draw` draw samples, row by row, into `pixels`: whole rows of the frame's picture that hold its background. Row 0 is
/// the first of them.
pub(super) fn draw_rows<T: Stored>(
    frame: &Frame,
    pixels: &mut [T],
    draw: impl FnOnce(&mut dyn Target),
) {
    let width = frame.picture_width();
    if frame.samples() == 1 {
        return draw(&mut Direct { pixels, width });
    }
    let mut filter = BoxFilter {
        pixels,
        frame,
        row: 0,
        sums: vec![([0.0; 3], 0); width],
    };
    draw(&mut filter);
    filter.flush();
}

/// Has `draw` draw samples in any order into `pixels`, as [`draw_rows`] does: all samples are kept until it is done.
pub(super) fn draw_anyhow<T: Stored>(
    frame: &Frame,
    pixels: &mut [T],
    draw: impl FnOnce(&mut dyn Target),
) {
    if frame.samples() == 1 {
        return draw_rows(frame, pixels, draw);
    }
    let mut samples = linear_samples(frame);
    draw(&mut Direct {
        width: frame.width(),
        pixels: samples.pixels_mut(),
    });
    draw_rows(frame, pixels, |target| {
        for row in 0..samples.height() {
            for (x, &[r, g, b, alpha]) in samples.row(row).iter().enumerate() {
                if alpha > 0.0 {
                    target.store(x, row, &[[r, g, b]]);
                }
            }
        }
    });
}

/// Returns an empty picture for `frame`: its background, alpha 0.
pub(super) fn empty<T: Stored>(frame: &Frame) -> Picture<T> {
    let (width, height) = (frame.picture_width(), frame.picture_height());
    Picture::new(width, height, T::background(frame))
}

/// Returns an empty linear picture with a pixel for each sample.
pub(super) fn linear_samples(frame: &Frame) -> LinearPicture {
    Picture::new(frame.width(), frame.height(), Stored::background(frame))
}
