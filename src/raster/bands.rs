//! A picture as bands of scanlines, which are drawn independently, on several threads.

use super::target::{Stored, Target, draw_rows};
use crate::frame::Frame;
use crate::number::parallel::{for_each_chunk, threads};
use alloc::vec;
use core::ops::Range;

/// A function that draws one band: takes its number, its scanlines, and the target of its rows, which count from its first.
pub(super) type DrawBand<'a> = dyn Fn(usize, Range<usize>, &mut dyn Target) + Sync + 'a;

/// A function that runs a [`DrawBand`] on every band of a picture, for any pixel format: takes the height of bands in scanlines
/// of samples. Bands are drawn in any order, on as many threads as the current pool has.
pub(super) type EachBand<'a> = dyn FnMut(usize, &DrawBand<'_>) + 'a;

/// Bands that are drawn before they are given away, for each thread: some are done sooner than others.
const BANDS_A_THREAD: usize = 4;

/// Draws a picture of bytes that is never in memory as a whole: gives its pixels to `take` from the top, some bands at a time,
/// until it returns false.
pub(super) fn stream_bands(
    frame: &Frame,
    height: usize,
    take: &mut dyn FnMut(&[[u8; 4]]) -> bool,
    draw: &DrawBand<'_>,
) {
    let a_band = height / frame.samples() * frame.picture_width();
    let all = frame.picture_width() * frame.picture_height();
    let bands = BANDS_A_THREAD * threads();
    let mut window = vec![[0; 4]; (bands * a_band).min(all)];
    for first in (0..all.div_ceil(a_band)).step_by(bands) {
        let end = window.len().min(all - first * a_band);
        draw_bands(frame, (height, first), &mut window[..end], draw);
        if !take(&window[..end]) {
            return;
        }
    }
}

/// Draws bands of `height` scanlines of samples from the `first` on: as many as `pixels` has.
pub(super) fn draw_bands<T: Stored>(
    frame: &Frame,
    (height, first): (usize, usize),
    pixels: &mut [T],
    draw: &DrawBand<'_>,
) {
    assert!(height.is_multiple_of(frame.samples()), "whole pixels");
    let a_band = height / frame.samples() * frame.picture_width();
    for_each_chunk(pixels, a_band, &|start, pixels: &mut [T]| {
        let number = first + start / a_band;
        let rows = number * height..((number + 1) * height).min(frame.height());
        if frame.samples() > 1 || T::bytes(&mut []).is_none() {
            pixels.fill(T::background(frame)); // bytes are stored in whole rows
        }
        draw_rows(frame, pixels, |target| {
            draw(number, rows, target);
        });
    });
}
