//! From samples to pixels: a box filter in linear light.

use super::target::{Target, Texel, linear_samples};
use crate::frame::Frame;
use crate::picture::Picture;
use alloc::vec;
use alloc::vec::Vec;

/// Takes the samples of a frame and stores the mean of each pixel's n × n, where the background stands for those that
/// nothing covers; alpha is the share of those that something does.
///
/// Sums are exact: an f64 holds any 64 numbers of 24 bits each and of one magnitude, so that what is constant stays so.
struct BoxFilter<'a, T> {
    picture: &'a mut Picture<T>,
    samples: usize,
    background: [f32; 3],
    /// The row of pixels that is being collected; those before it are finished.
    row: usize,
    /// Sum of the colours and number of the covered samples, by pixel.
    sums: Vec<([f64; 3], u32)>,
}

impl<'a, T: Texel> BoxFilter<'a, T> {
    fn new(frame: &Frame, picture: &'a mut Picture<T>) -> Self {
        let sums = vec![([0.0; 3], 0); picture.width()];
        let background = frame.background();
        BoxFilter {
            picture,
            samples: frame.samples(),
            background,
            row: 0,
            sums,
        }
    }

    /// Stores the row that was being collected.
    fn flush(&mut self) {
        for (texel, (sum, covered)) in self
            .picture
            .row_mut(self.row)
            .iter_mut()
            .zip(&mut self.sums)
        {
            if *covered == 0 {
                continue;
            }
            *texel = mean(&(*sum, *covered), self.samples, self.background);
            (*sum, *covered) = ([0.0; 3], 0);
        }
    }
}

/// The texel of a pixel from the sum of its covered samples and their number, of `samples` × `samples` in all.
pub(super) fn mean<T: Texel>(
    (sum, covered): &([f64; 3], u32),
    samples: usize,
    background: [f32; 3],
) -> T {
    if *covered == 0 {
        return T::background(background);
    }
    let (all, share) = ((samples * samples) as f64, f64::from(*covered));
    let mean = |c: usize| ((sum[c] + (all - share) * f64::from(background[c])) / all) as f32;
    T::mixed([mean(0), mean(1), mean(2), (share / all) as f32])
}

impl<T: Texel> Target for BoxFilter<'_, T> {
    /// Rows must come in order.
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
}

/// Draws into `picture`, which has the size of the frame's picture, what `draw` gives sample by sample, row by row.
pub(crate) fn draw_rows<T: Texel>(
    frame: &Frame,
    picture: &mut Picture<T>,
    draw: impl FnOnce(&mut dyn Target),
) {
    if frame.samples() == 1 {
        return draw(picture);
    }
    let mut filter = BoxFilter::new(frame, picture);
    draw(&mut filter);
    filter.flush();
}

/// The same for a `draw` that comes back to what it drew: all samples are kept until it is done.
pub(crate) fn draw_anyhow<T: Texel>(
    frame: &Frame,
    picture: &mut Picture<T>,
    draw: impl FnOnce(&mut dyn Target),
) {
    if frame.samples() == 1 {
        return draw(picture);
    }
    let mut samples = linear_samples(frame);
    draw(&mut samples);
    draw_rows(frame, picture, |target| {
        for row in 0..samples.height() {
            for (x, [r, g, b, alpha]) in samples.row(row).iter().copied().enumerate() {
                if alpha > 0.0 {
                    target.store(x, row, &[[r, g, b]]);
                }
            }
        }
    });
}
