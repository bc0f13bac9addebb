//! A picture as bands of scanlines, which several threads draw independently.

use super::depth::DepthTest;
use super::target::{Format, Rows, Surface, Target};
use crate::number::parallel::{for_each_chunk, threads};
use alloc::vec;
use core::ops::Range;

/// A function that draws one band. It receives the band's index, its scanlines, and the target of
/// its rows, where row 0 is the band's first.
pub(super) type DrawBand<'a> = dyn Fn(usize, Range<usize>, &mut dyn Target) + Sync + 'a;

/// A function that runs a [`DrawBand`] on every band of a picture in any pixel format. It receives
/// the height of a band in scanlines of samples. Bands are drawn in any order, on as many threads
/// as the current pool has.
pub(super) type EachBand<'a> = dyn FnMut(usize, &DrawBand<'_>) + 'a;

/// How many bands per thread are drawn before their pixels are handed on. Some bands finish sooner
/// than others, and more bands keep every thread busy.
const BANDS_A_THREAD: usize = 4;

/// Draws a picture that is never in memory as a whole. Passes its pixels to `take` from the top,
/// some bands at a time, until `take` returns false.
pub(super) fn stream_bands<F: Format<Pixel = [u8; 4]>>(
    surface: Surface<'_, F>,
    height: usize,
    take: &mut dyn FnMut(&[[u8; 4]]) -> bool,
    draw: &DrawBand<'_>,
) {
    let frame = surface.frame;
    let (width, all) = (frame.picture_width(), frame.picture_height());
    let a_band = height / frame.samples();
    let a_window = BANDS_A_THREAD * threads() * a_band;
    let mut window = vec![[0; 4]; a_window.min(all) * width];
    for first in (0..all).step_by(a_window) {
        let count = a_window.min(all - first);
        let pixels = &mut window[..count * width];
        let rows = Rows {
            pixels,
            stride: width,
            count,
            depth: None,
            test: DepthTest::Less,
            samples: frame.width() * frame.samples(),
        };
        draw_bands(surface, height, first / a_band, rows, draw);
        if !take(&window[..count * width]) {
            return;
        }
    }
}

/// Draws bands of `height` scanlines of samples, from band `first` on, until all rows are drawn.
pub(super) fn draw_bands<F: Format>(
    surface: Surface<'_, F>,
    height: usize,
    first: usize,
    rows: Rows<'_, F::Pixel>,
    draw: &DrawBand<'_>,
) {
    let frame = surface.frame;
    assert!(height.is_multiple_of(frame.samples()), "whole pixels");
    let a_band = height / frame.samples();
    for_each_chunk(rows, a_band, &|start, mut rows: Rows<'_, F::Pixel>| {
        let index = first + start / a_band;
        let scanlines = index * height..((index + 1) * height).min(frame.height());
        if frame.samples() > 1 || !surface.format.is_levels() {
            surface.clear(&mut rows); // levels are stored in whole rows
        }
        surface.draw_rows(rows, |target| {
            draw(index, scanlines, target);
        });
    });
}
