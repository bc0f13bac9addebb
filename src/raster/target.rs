//! The targets that engines draw into: rows of pixels in any format, stored directly or through a
//! box filter over several samples.

#![cfg_attr(not(feature = "simd"), allow(dead_code))] // only the row engine draws levels

use super::depth::{CallersDepth, CallersTest, DepthTest};
use crate::frame::Frame;
use crate::number::parallel::Parts;
use crate::picture::encoding::{Encoder, quantise};
use crate::picture::{Alpha, Encoding, LinearPicture, Picture};
use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;

/// A pixel format.
pub(super) trait Format: Copy + Sync {
    /// A pixel in memory.
    type Pixel: Copy + Send + Sync;
    /// Converts a linear colour and alpha, clamped to 0..=1, to a pixel.
    fn of(self, rgba: [f32; 4]) -> Self::Pixel;
    /// Stores a run of linear colours of covered pixels.
    #[inline(always)]
    fn store(self, pixels: &mut [Self::Pixel], colours: &[[f32; 3]]) {
        for (pixel, &[r, g, b]) in pixels.iter_mut().zip(colours) {
            *pixel = self.of([r, g, b, 1.0]);
        }
    }
    /// Returns the linear colour and alpha of a pixel.
    fn linear(self, pixel: Self::Pixel) -> [f32; 4];
    /// True if pixels are levels of linear intensity, which kernels can compute themselves.
    fn is_levels(self) -> bool;
    /// Converts levels of red, green, blue and alpha to a pixel.
    fn of_levels(self, rgba: [u8; 4]) -> Self::Pixel;
    /// Returns the pixels as levels, if memory holds them in this order.
    fn levels(_pixels: &mut [Self::Pixel]) -> Option<&mut [[u8; 4]]> {
        None
    }
}

/// Linear floats.
#[derive(Clone, Copy)]
pub(super) struct Floats;

impl Format for Floats {
    type Pixel = [f32; 4];
    #[inline(always)]
    fn of(self, rgba: [f32; 4]) -> [f32; 4] {
        rgba.map(|c| c.clamp(0.0, 1.0))
    }
    fn linear(self, pixel: [f32; 4]) -> [f32; 4] {
        pixel
    }
    fn is_levels(self) -> bool {
        false
    }
    fn of_levels(self, rgba: [u8; 4]) -> [f32; 4] {
        rgba.map(|level| f32::from(level) / 255.0)
    }
}

/// An order of a pixel's four channels.
pub(super) trait Order: Copy + Sync {
    type Pixel: Copy + Send + Sync;
    fn pack(rgba: [u8; 4]) -> Self::Pixel;
    fn unpack(pixel: Self::Pixel) -> [u8; 4];
    fn levels(_pixels: &mut [Self::Pixel]) -> Option<&mut [[u8; 4]]> {
        None
    }
}

#[derive(Clone, Copy)]
pub(super) struct Rgba;

impl Order for Rgba {
    type Pixel = [u8; 4];
    #[inline(always)]
    fn pack(rgba: [u8; 4]) -> [u8; 4] {
        rgba
    }
    fn unpack(pixel: [u8; 4]) -> [u8; 4] {
        pixel
    }
    fn levels(pixels: &mut [[u8; 4]]) -> Option<&mut [[u8; 4]]> {
        Some(pixels)
    }
}

#[derive(Clone, Copy)]
pub(super) struct Bgra;

impl Order for Bgra {
    type Pixel = [u8; 4];
    #[inline(always)]
    fn pack([r, g, b, alpha]: [u8; 4]) -> [u8; 4] {
        [b, g, r, alpha]
    }
    fn unpack([b, g, r, alpha]: [u8; 4]) -> [u8; 4] {
        [r, g, b, alpha]
    }
}

/// `0xAARRGGBB`.
#[derive(Clone, Copy)]
pub(super) struct Argb;

impl Order for Argb {
    type Pixel = u32;
    #[inline(always)]
    fn pack([r, g, b, alpha]: [u8; 4]) -> u32 {
        u32::from_be_bytes([alpha, r, g, b])
    }
    fn unpack(pixel: u32) -> [u8; 4] {
        let [alpha, r, g, b] = pixel.to_be_bytes();
        [r, g, b, alpha]
    }
}

/// Eight bits per channel.
#[derive(Clone, Copy)]
pub(super) struct Eight<'a, O> {
    /// The transfer function that intensities are stored with; `None` stores linear levels.
    encoder: Option<&'a Encoder>,
    order: PhantomData<O>,
}

impl<'a, O: Order> Eight<'a, O> {
    pub fn new(encoder: Option<&'a Encoder>) -> Self {
        Eight {
            encoder,
            order: PhantomData,
        }
    }
}

impl<O: Order> Format for Eight<'_, O> {
    type Pixel = O::Pixel;
    #[inline(always)]
    fn of(self, rgba: [f32; 4]) -> O::Pixel {
        O::pack(match self.encoder {
            None => rgba.map(quantise),
            Some(encoder) => encoder.store(rgba),
        })
    }
    #[inline(always)]
    fn store(self, pixels: &mut [O::Pixel], colours: &[[f32; 3]]) {
        let pixels = pixels.iter_mut().zip(colours);
        // The choice is made once, before the loop.
        match self.encoder {
            None => pixels.for_each(|(pixel, &[r, g, b])| {
                *pixel = O::pack([quantise(r), quantise(g), quantise(b), 255]);
            }),
            Some(encoder) => pixels.for_each(|(pixel, &[r, g, b])| {
                *pixel = O::pack(encoder.store([r, g, b, 1.0]));
            }),
        }
    }
    fn linear(self, pixel: O::Pixel) -> [f32; 4] {
        let encoding = self.encoder.map_or(Encoding::Linear, |_| Encoding::Srgb);
        let [r, g, b, alpha] = O::unpack(pixel).map(|level| f64::from(level) / 255.0);
        let [r, g, b] = [r, g, b].map(|c| encoding.decode(c));
        [r, g, b, alpha].map(|c| c as f32)
    }
    fn is_levels(self) -> bool {
        self.encoder.is_none()
    }
    #[inline(always)]
    fn of_levels(self, rgba: [u8; 4]) -> O::Pixel {
        O::pack(rgba)
    }
    fn levels(pixels: &mut [O::Pixel]) -> Option<&mut [[u8; 4]]> {
        O::levels(pixels)
    }
}

/// Rows of pixels from the top, and the caller's depth of their samples.
pub(super) struct Rows<'a, P> {
    pub pixels: &'a mut [P],
    /// The distance from one row to the next; the last row may be shorter.
    pub stride: usize,
    /// How many rows there are.
    pub count: usize,
    /// The caller's depth buffer, if there is one: all samples of the first row of pixels, then
    /// those of the next.
    pub depth: Option<&'a mut [f32]>,
    /// The test against the caller's depth.
    pub test: DepthTest,
    /// How many samples a row of pixels has.
    pub samples: usize,
}

impl<P: Send> Parts for Rows<'_, P> {
    fn len(&self) -> usize {
        self.count
    }
    fn split(self, at: usize) -> (Self, Self) {
        let Rows {
            stride,
            samples,
            test,
            ..
        } = self;
        let (above, below) = self.pixels.split_at_mut(at * stride);
        let depth = self.depth.map(|depth| depth.split_at_mut(at * samples));
        let (depth_above, depth_below) = depth.unzip();
        let part = |pixels, count, depth| Rows {
            pixels,
            stride,
            count,
            depth,
            test,
            samples,
        };
        (
            part(above, at, depth_above),
            part(below, self.count - at, depth_below),
        )
    }
}

/// Rows of samples that receive finished runs in any format. Engines draw through this trait, so
/// they are compiled once for all formats.
pub(super) trait Target {
    /// Stores a run of pixels from (`x`, `row`) on, linear and not clamped.
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]);
    /// Returns memory for row `row` as levels of linear intensity, if the picture stores them. The
    /// caller then writes the whole row, with alpha 0 where nothing is drawn, and calls
    /// [`Target::finish`].
    #[cfg(feature = "simd")]
    fn levels(&mut self, _row: usize) -> Option<&mut [[u8; 4]]> {
        None
    }
    /// Stores the levels of a row.
    #[cfg(feature = "simd")]
    fn finish(&mut self, _row: usize) {}
    /// Returns the caller's depth for the samples of row `row`.
    fn depth(&mut self, row: usize) -> Option<CallersDepth<'_>>;
}

/// A frame's picture in some format, into whose rows engines draw.
#[derive(Clone, Copy)]
pub(super) struct Surface<'a, F> {
    pub frame: &'a Frame,
    pub format: F,
    /// True if pixels that no polygon covers keep their colour.
    pub keeps_background: bool,
}

/// Rows of pixels that are stored as they are drawn, one sample per pixel.
struct Direct<'a, F: Format> {
    surface: Surface<'a, F>,
    rows: Rows<'a, F::Pixel>,
    /// The levels of a row that are still to be converted; unused where kernels write them in
    /// place.
    line: Vec<[u8; 4]>,
}

impl<F: Format> Direct<'_, F> {
    fn row(&mut self, row: usize) -> &mut [F::Pixel] {
        &mut self.rows.pixels[row * self.rows.stride..][..self.surface.frame.width()]
    }
}

impl<F: Format> Target for Direct<'_, F> {
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]) {
        let format = self.surface.format;
        format.store(&mut self.row(row)[x..], colours);
    }
    #[cfg(feature = "simd")]
    fn levels(&mut self, row: usize) -> Option<&mut [[u8; 4]]> {
        if !self.surface.format.is_levels() {
            return None;
        }
        // The empty slice only asks if pixels have the layout of levels.
        let is_in_place = !self.surface.keeps_background && F::levels(&mut []).is_some();
        if is_in_place {
            return F::levels(self.row(row));
        }
        self.line.resize(self.surface.frame.width(), [0; 4]);
        Some(&mut self.line)
    }
    #[cfg(feature = "simd")]
    fn finish(&mut self, row: usize) {
        let line = core::mem::take(&mut self.line);
        let Surface {
            format,
            keeps_background,
            ..
        } = self.surface;
        // If kernels wrote in place, `line` is empty and nothing is left to convert.
        for (pixel, &levels) in self.row(row).iter_mut().zip(&line) {
            if levels[3] > 0 || !keeps_background {
                *pixel = format.of_levels(levels);
            }
        }
        self.line = line;
    }
    fn depth(&mut self, row: usize) -> Option<CallersDepth<'_>> {
        depth_row(&mut self.rows, self.surface.frame, row)
    }
}

/// Returns the depth of a row of samples.
fn depth_row<'r, P>(
    rows: &'r mut Rows<'_, P>,
    frame: &Frame,
    row: usize,
) -> Option<CallersDepth<'r>> {
    let (width, test) = (frame.width(), CallersTest::new(frame, rows.test));
    let stored = &mut rows.depth.as_deref_mut()?[row * width..][..width];
    Some(CallersDepth { stored, test })
}

/// A box filter in linear light. A pixel's colour is the mean of its covered samples, or of all n ×
/// n samples, where the background fills in for uncovered ones: [`Alpha`] chooses. Alpha is the
/// covered share. Over a background that is kept, the covered share of a pixel is blended over the
/// old colour.
///
/// Sums are exact, so a constant colour stays constant: an f64 holds the sum of 64 values of 24
/// bits and one magnitude.
struct BoxFilter<'a, F: Format> {
    surface: Surface<'a, F>,
    rows: Rows<'a, F::Pixel>,
    /// The row of pixels that is being collected. The rows before it are finished.
    row: usize,
    /// The sum of colours and the count of covered samples, for each pixel.
    sums: Vec<([f64; 3], u32)>,
}

impl<F: Format> BoxFilter<'_, F> {
    /// Stores the row that was being collected.
    fn flush(&mut self) {
        let Surface {
            frame,
            format,
            keeps_background,
        } = self.surface;
        let all = frame.samples().pow(2) as f64;
        let [r, g, b] = frame.background().map(f64::from);
        let row = self.rows.pixels[self.row * self.rows.stride..].iter_mut();
        for (pixel, (sum, covered)) in row.zip(&mut self.sums) {
            if *covered > 0 {
                let share = f64::from(*covered);
                let below = if keeps_background {
                    format.linear(*pixel).map(f64::from)
                } else {
                    [r, g, b, 0.0]
                };
                // How much the uncovered samples weigh: nothing over the frame's own background,
                // whose alpha is 0 here.
                let rest = (all - share) * below[3];
                let mean = |c: usize| match frame.alpha() {
                    Alpha::Straight => ((sum[c] + rest * below[c]) / (share + rest)) as f32,
                    Alpha::Flattened => ((sum[c] + (all - share) * below[c]) / all) as f32,
                };
                *pixel = format.of([mean(0), mean(1), mean(2), ((share + rest) / all) as f32]);
                (*sum, *covered) = ([0.0; 3], 0);
            }
        }
    }
}

impl<F: Format> Target for BoxFilter<'_, F> {
    /// Expects rows in order.
    fn store(&mut self, x: usize, row: usize, colours: &[[f32; 3]]) {
        let samples = self.surface.frame.samples();
        if row / samples != self.row {
            self.flush();
            self.row = row / samples;
        }
        for (column, colour) in (x..).zip(colours) {
            let (sum, covered) = &mut self.sums[column / samples];
            for (sum, channel) in sum.iter_mut().zip(colour) {
                // Samples are clamped before they are averaged, as if each were a pixel.
                *sum += f64::from(channel.clamp(0.0, 1.0));
            }
            *covered += 1;
        }
    }
    fn depth(&mut self, row: usize) -> Option<CallersDepth<'_>> {
        depth_row(&mut self.rows, self.surface.frame, row)
    }
}

impl<'a, F: Format> Surface<'a, F> {
    /// Returns a surface on which the background is drawn.
    pub fn new(frame: &'a Frame, format: F) -> Self {
        Surface {
            frame,
            format,
            keeps_background: false,
        }
    }

    /// Fills rows with the background, unless it is kept.
    pub fn clear(&self, rows: &mut Rows<'_, F::Pixel>) {
        if !self.keeps_background {
            let [r, g, b] = self.frame.background();
            let background = self.format.of([r, g, b, 0.0]);
            for row in rows.pixels.chunks_mut(rows.stride).take(rows.count) {
                row[..self.frame.picture_width()].fill(background);
            }
        }
    }

    /// Lets `draw` draw samples, row by row, into rows that already hold the background. Row 0 is
    /// the first of `rows`.
    pub fn draw_rows(self, rows: Rows<'_, F::Pixel>, draw: impl FnOnce(&mut dyn Target)) {
        if self.frame.samples() == 1 {
            return draw(&mut Direct {
                surface: self,
                rows,
                line: Vec::new(),
            });
        }
        let mut filter = BoxFilter {
            surface: self,
            rows,
            row: 0,
            sums: vec![([0.0; 3], 0); self.frame.picture_width()],
        };
        draw(&mut filter);
        filter.flush();
    }

    /// Lets `draw` draw samples in any order into `rows`. Keeps all samples until it is done.
    pub fn draw_anyhow(self, rows: Rows<'_, F::Pixel>, draw: impl FnOnce(&mut dyn Target)) {
        let frame = self.frame;
        if frame.samples() == 1 {
            return self.draw_rows(rows, draw);
        }
        let mut samples = linear_samples(frame);
        draw(&mut Direct {
            surface: Surface::new(frame, Floats),
            rows: rows_of(frame, &mut samples),
            line: Vec::new(),
        });
        self.draw_rows(rows, |target| {
            for row in 0..samples.height() {
                for (x, &[r, g, b, alpha]) in samples.row(row).iter().enumerate() {
                    if alpha > 0.0 {
                        target.store(x, row, &[[r, g, b]]);
                    }
                }
            }
        });
    }
}

/// Returns a linear picture of `frame` into which `draw` draws samples, row by row.
pub(super) fn drawn(frame: &Frame, draw: impl FnOnce(&mut dyn Target)) -> LinearPicture {
    let mut picture = empty(frame);
    Surface::new(frame, Floats).draw_rows(rows_of(frame, &mut picture), draw);
    picture
}

/// Returns a linear picture of `frame` into which `draw` draws samples, in any order.
pub(super) fn drawn_anyhow(frame: &Frame, draw: impl FnOnce(&mut dyn Target)) -> LinearPicture {
    let mut picture = empty(frame);
    Surface::new(frame, Floats).draw_anyhow(rows_of(frame, &mut picture), draw);
    picture
}

/// Returns all rows of a picture, without a depth buffer.
pub(super) fn rows_of<'a, P: Copy>(frame: &Frame, picture: &'a mut Picture<P>) -> Rows<'a, P> {
    Rows {
        stride: picture.width(),
        count: picture.height(),
        pixels: picture.pixels_mut(),
        depth: None,
        test: DepthTest::Less,
        samples: frame.width() * frame.samples(),
    }
}

/// Returns an empty linear picture for `frame`: its background, with alpha 0.
fn empty(frame: &Frame) -> LinearPicture {
    let [r, g, b] = frame.background();
    let (width, height) = (frame.picture_width(), frame.picture_height());
    Picture::new(width, height, Floats.of([r, g, b, 0.0]))
}

/// Returns an empty linear picture with one pixel per sample.
pub(super) fn linear_samples(frame: &Frame) -> LinearPicture {
    let [r, g, b] = frame.background();
    Picture::new(frame.width(), frame.height(), Floats.of([r, g, b, 0.0]))
}
