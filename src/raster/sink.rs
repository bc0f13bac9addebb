//! Where the finished rows of a band go: stored texels, linear ones, or the mean of several.

use super::target::Texel;
use crate::frame::Frame;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// Takes the rows of one band, in order, each once.
pub(crate) trait RowSink {
    /// Takes row `row` of the band. `drawn` are the pixels between which anything was drawn; `depth` and `rgb` begin with the
    /// first of them: a pixel was drawn where its depth is finite. They have a group of values more than there are pixels.
    fn row(&mut self, row: usize, drawn: Range<usize>, depth: &[f32], rgb: [&[f32]; 3]);

    /// Where rows are stored as bytes, the texels of row `row` and the background: then they may be stored here, all of
    /// them, in place of giving them to [`RowSink::row`].
    fn bytes(&mut self, row: usize) -> Option<(&mut [[u8; 4]], [u8; 4])> {
        let _ = row;
        None
    }
}

/// Texels of a band that are stored as they are drawn.
pub(super) struct Stored<'a, T> {
    pub texels: &'a mut [T],
    pub width: usize,
    pub background: T,
}

impl<T: Texel> RowSink for Stored<'_, T> {
    fn row(&mut self, row: usize, drawn: Range<usize>, depth: &[f32], rgb: [&[f32]; 3]) {
        let texels = &mut self.texels[row * self.width..][..self.width];
        texels[..drawn.start].fill(self.background);
        texels[drawn.end..].fill(self.background);
        let [r, g, b] = rgb;
        for (i, texel) in texels[drawn].iter_mut().enumerate() {
            *texel = if depth[i] < f32::INFINITY {
                T::drawn([r[i], g[i], b[i]])
            } else {
                self.background
            };
        }
    }

    fn bytes(&mut self, row: usize) -> Option<(&mut [[u8; 4]], [u8; 4])> {
        T::bytes(
            &mut self.texels[row * self.width..][..self.width],
            self.background,
        )
    }
}

/// A box filter in linear light: the mean of each pixel's n × n samples, where the background stands for those that nothing
/// covers; alpha is the share of those that something does.
///
/// Sums are exact: an f64 holds any 64 numbers of 24 bits each and of one magnitude, so that what is constant stays so.
pub(super) struct Filtered<'a, T> {
    pub texels: &'a mut [T],
    pub width: usize,
    pub samples: usize,
    pub background: [f32; 3],
    /// Sum of the colours and number of the covered samples, by pixel.
    pub sums: Vec<([f64; 3], u32)>,
}

impl<'a, T: Texel> Filtered<'a, T> {
    pub fn new(frame: &Frame, texels: &'a mut [T]) -> Self {
        let width = frame.picture_width();
        let sums = vec![([0.0; 3], 0); width];
        Filtered {
            texels,
            width,
            samples: frame.samples(),
            background: frame.background(),
            sums,
        }
    }
}

impl<T: Texel> RowSink for Filtered<'_, T> {
    fn row(&mut self, row: usize, drawn: Range<usize>, depth: &[f32], rgb: [&[f32]; 3]) {
        for (i, column) in drawn.enumerate() {
            if depth[i] < f32::INFINITY {
                let (sum, covered) = &mut self.sums[column / self.samples];
                for (sum, channel) in sum.iter_mut().zip(rgb) {
                    *sum += f64::from(channel[i].clamp(0.0, 1.0));
                }
                *covered += 1;
            }
        }
        if (row + 1).is_multiple_of(self.samples) {
            let texels = &mut self.texels[row / self.samples * self.width..][..self.width];
            for (texel, sum) in texels.iter_mut().zip(&mut self.sums) {
                *texel = super::supersampling::mean(sum, self.samples, self.background);
                *sum = ([0.0; 3], 0);
            }
        }
    }
}
