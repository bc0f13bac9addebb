//! A picture as bands of scanlines, which are drawn apart from one another.

use super::rows::{Band, Batch};
use super::sink::{Filtered, RowSink, Stored};
use super::target::Texel;
use crate::frame::Frame;
use crate::number::Level;
use crate::picture::Picture;
use alloc::vec::Vec;
use core::ops::Range;

/// Memory that a thread keeps from band to band.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    pub band: Band,
    pub batch: Batch,
    /// The colours of a row, by channel.
    pub line: [Vec<f32>; 3],
}

/// Draws one band: its number, its scanlines, memory, and where its rows go.
pub(crate) type DrawBand<'a> = dyn Fn(usize, Range<usize>, &mut Scratch, &mut dyn RowSink) + Sync + 'a;

/// A picture that takes bands, whatever its texels are: engines are compiled once for all kinds.
pub(crate) trait Bands {
    /// Draws every band of `height` scanlines of samples, in any order, on as many threads as the current pool has.
    fn each(&mut self, height: usize, draw: &DrawBand<'_>);
}

/// The picture of a frame, to be drawn on an instruction set.
pub(crate) struct PictureBands<'a, T> {
    pub frame: &'a Frame,
    pub level: Level,
    pub picture: &'a mut Picture<T>,
}

impl<T: Texel> Bands for PictureBands<'_, T> {
    fn each(&mut self, height: usize, draw: &DrawBand<'_>) {
        let (frame, level) = (self.frame, self.level);
        let (width, samples) = (frame.picture_width(), frame.samples());
        debug_assert!(height.is_multiple_of(samples));
        let background = T::background(frame.background());
        let band = |number: usize, texels: &mut [T], scratch: &mut Scratch| {
            let rows = number * height..((number + 1) * height).min(frame.height());
            match samples {
                1 => draw(number, rows, scratch, &mut Stored { texels, width, background, level }),
                _ => draw(number, rows, scratch, &mut Filtered::new(frame, texels)),
            }
        };
        crate::parallel::each_chunk(self.picture.texels_mut(), height / samples * width, band);
    }
}
