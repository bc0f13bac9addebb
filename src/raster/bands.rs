//! A picture as bands of scanlines, which are drawn apart from one another.

use super::rows::{Band, Batch, Fragments, Starts};
use super::sink::{Filtered, RowSink, Stored};
use super::target::Texel;
use crate::frame::Frame;
use crate::parallel::{for_each_chunk, threads};
use crate::picture::Picture;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// Memory that a thread keeps from band to band.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    pub band: Band,
    pub batch: Batch,
    pub fragments: Fragments,
    pub starts: Starts,
    /// The depths of a row and its colours, by channel.
    pub line: [Vec<f32>; 4],
}

/// Draws one band: its number, its scanlines, memory, and where its rows go.
pub(crate) type DrawBand<'a> =
    dyn Fn(usize, Range<usize>, &mut Scratch, &mut dyn RowSink) + Sync + 'a;

/// A picture that takes bands, whatever its texels are: engines are compiled once for all kinds.
pub(crate) trait Bands {
    /// Draws every band of `height` scanlines of samples, in any order, on as many threads as the current pool has.
    fn each(&mut self, height: usize, draw: &DrawBand<'_>);
}

/// The picture of a frame.
pub(crate) struct PictureBands<'a, T> {
    pub frame: &'a Frame,
    pub picture: &'a mut Picture<T>,
}

impl<T: Texel> Bands for PictureBands<'_, T> {
    fn each(&mut self, height: usize, draw: &DrawBand<'_>) {
        draw_bands(self.frame, (height, 0), self.picture.texels_mut(), draw);
    }
}

/// Bands that are drawn before they are given away, for each thread: some are done sooner than others.
const BANDS_A_THREAD: usize = 4;

/// A picture of bytes that is never there as a whole: its texels are given away from the top, some bands at a time.
pub(crate) struct StreamedBands<'a> {
    pub frame: &'a Frame,
    /// Takes the next texels; whether it wants more.
    pub take: &'a mut dyn FnMut(&[[u8; 4]]) -> bool,
}

impl Bands for StreamedBands<'_> {
    fn each(&mut self, height: usize, draw: &DrawBand<'_>) {
        let frame = self.frame;
        let (texels_a_band, all) = (
            height / frame.samples() * frame.picture_width(),
            frame.picture_width() * frame.picture_height(),
        );
        let bands = BANDS_A_THREAD * threads();
        let mut window = vec![[0; 4]; (bands * texels_a_band).min(all)];
        for first in (0..all.div_ceil(texels_a_band)).step_by(bands) {
            let end = window.len().min(all - first * texels_a_band);
            draw_bands(frame, (height, first), &mut window[..end], draw);
            if !(self.take)(&window[..end]) {
                return;
            }
        }
    }
}

/// Draws bands of `height` scanlines of samples from the `first` on: as many as `texels` has.
fn draw_bands<T: Texel>(
    frame: &Frame,
    (height, first): (usize, usize),
    texels: &mut [T],
    draw: &DrawBand<'_>,
) {
    let (width, samples) = (frame.picture_width(), frame.samples());
    assert!(height.is_multiple_of(samples));
    let background = T::background(frame.background());
    let texels_a_band = height / samples * width;
    for_each_chunk(texels, texels_a_band, &|start, texels: &mut [T]| {
        let number = first + start / texels_a_band;
        let rows = number * height..((number + 1) * height).min(frame.height());
        with_scratch(|scratch| match samples {
            1 => draw(
                number,
                rows,
                scratch,
                &mut Stored {
                    texels,
                    width,
                    background,
                },
            ),
            _ => draw(number, rows, scratch, &mut Filtered::new(frame, texels)),
        });
    });
}

/// Gives `work` what this thread keeps from band to band.
#[cfg(feature = "std")]
fn with_scratch(work: impl FnOnce(&mut Scratch)) {
    std::thread_local! {
        static KEPT: core::cell::RefCell<Scratch> = core::cell::RefCell::default();
    }
    KEPT.with_borrow_mut(work);
}

/// Without the standard library nothing is kept.
#[cfg(not(feature = "std"))]
fn with_scratch(work: impl FnOnce(&mut Scratch)) {
    work(&mut Scratch::default());
}
