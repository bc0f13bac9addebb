//! A picture as bands of scanlines, which are drawn apart from one another.

use super::target::{Stored, Target, draw_rows};
use crate::frame::Frame;
use crate::number::parallel::{for_each_chunk, threads};
use alloc::vec;
use core::ops::Range;

/// Draws one band: its number, its scanlines, and where its rows go, which count from its first.
pub(super) type DrawBand<'a> = dyn Fn(usize, Range<usize>, &mut dyn Target) + Sync + 'a;

/// A picture that takes bands, whatever its pixels are: engines are compiled once for all kinds.
pub(super) trait Bands {
    /// Draws every band of `height` scanlines of samples, in any order, on as many threads as the current pool has.
    fn each(&mut self, height: usize, draw: &DrawBand<'_>);
}

/// The pixels of the picture of a frame.
pub(super) struct PictureBands<'a, T> {
    pub frame: &'a Frame,
    pub pixels: &'a mut [T],
}

impl<T: Stored> Bands for PictureBands<'_, T> {
    fn each(&mut self, height: usize, draw: &DrawBand<'_>) {
        draw_bands(self.frame, (height, 0), self.pixels, draw);
    }
}

/// Bands that are drawn before they are given away, for each thread: some are done sooner than others.
const BANDS_A_THREAD: usize = 4;

/// A picture of bytes that is never there as a whole: its pixels are given away from the top, some bands at a time.
pub(super) struct StreamedBands<'a> {
    pub frame: &'a Frame,
    /// Takes the next pixels; whether it wants more.
    pub take: &'a mut dyn FnMut(&[[u8; 4]]) -> bool,
}

impl Bands for StreamedBands<'_> {
    fn each(&mut self, height: usize, draw: &DrawBand<'_>) {
        let frame = self.frame;
        let a_band = height / frame.samples() * frame.picture_width();
        let all = frame.picture_width() * frame.picture_height();
        let bands = BANDS_A_THREAD * threads();
        let mut window = vec![[0; 4]; (bands * a_band).min(all)];
        for first in (0..all.div_ceil(a_band)).step_by(bands) {
            let end = window.len().min(all - first * a_band);
            draw_bands(frame, (height, first), &mut window[..end], draw);
            if !(self.take)(&window[..end]) {
                return;
            }
        }
    }
}

/// Draws bands of `height` scanlines of samples from the `first` on: as many as `pixels` has.
fn draw_bands<T: Stored>(
    frame: &Frame,
    (height, first): (usize, usize),
    pixels: &mut [T],
    draw: &DrawBand<'_>,
) {
    assert!(
        height.is_multiple_of(frame.samples()),
        "bands hold whole pixels"
    );
    let a_band = height / frame.samples() * frame.picture_width();
    let background = T::background(frame.background());
    for_each_chunk(pixels, a_band, &|start, pixels: &mut [T]| {
        let number = first + start / a_band;
        let rows = number * height..((number + 1) * height).min(frame.height());
        if frame.samples() > 1 || T::bytes(&mut [], background).is_none() {
            pixels.fill(background); // where it is bytes, rows are stored as a whole
        }
        draw_rows(frame, pixels, |target| {
            draw(number, rows, target);
        });
    });
}
