//! Shading: one row of the G-buffer to colours, by one call of the method's kernel for each stretch of one material. The loop over
//! its pixels is `shade_blocks` in `shading/kernels.rs`.

use super::tile::Tile;
use super::{Buffers, RowEngine};
use crate::number::simd::BLOCK;
use crate::raster::target::Target;
use crate::shading::{RowColours, ShadeRow, UniformsIndex};
use alloc::vec::Vec;
use core::ops::Range;

/// Pixels that kernels take at a time, at most: rows are shaded from a multiple of this on.
const STEP: usize = 2 * BLOCK;

/// The colours of a row, where they do not go straight into the picture.
#[derive(Debug, Default)]
pub(crate) struct RowBuffers {
    bytes: Vec<[u8; 4]>,
    channels: [Vec<f32>; 3],
    run: Vec<[f32; 3]>,
}

impl RowEngine<'_> {
    /// Shades row `row` of a tile into `target`, and empties it.
    pub(super) fn shade(&self, row: usize, buffers: &mut Buffers, target: &mut dyn Target) {
        let Buffers { tile, line, .. } = buffers;
        let width = self.setup.frame.width();
        if let Some(stored) = target.depth(row) {
            tile.hide_behind(row, stored);
        }
        let (blocks, background) = (tile.drawn(), self.background);
        let drawn = (blocks.start * BLOCK).min(width)..(blocks.end * BLOCK).min(width);
        if let Some(to) = target.levels(row) {
            to[..drawn.start].fill(background);
            to[drawn.end..].fill(background);
        }
        self.each_uniforms(tile, row, drawn, |uniforms, pixels| {
            let steps = pixels.start / STEP * STEP..pixels.end.next_multiple_of(STEP);
            let cells = tile.row(row, steps.start / BLOCK..steps.end / BLOCK);
            let job = ShadeRow {
                parameters: self.setup.parameters,
                uniforms: &self.setup.uniforms[uniforms.0 as usize],
                extras: self.setup.extras,
                numbers: self.numbers,
            };
            let part = pixels.start - steps.start..pixels.end - steps.start;
            if let Some(to) = target.levels(row) {
                if pixels == steps {
                    let mut out = RowColours::Bytes(&mut to[pixels], background);
                    return (self.kernels.shade)(&job, cells, &mut out);
                }
                line.bytes.resize(steps.len(), background);
                let mut out = RowColours::Bytes(&mut line.bytes, background);
                (self.kernels.shade)(&job, cells, &mut out);
                to[pixels].copy_from_slice(&line.bytes[part]);
            } else {
                let channels = line.channels.each_mut().map(|channel| {
                    channel.resize(steps.len(), 0.0);
                    &mut channel[..]
                });
                (self.kernels.shade)(&job, cells, &mut RowColours::Linear(channels));
                let is_drawn =
                    |x: usize| cells[x / BLOCK * tile.stride() + x % BLOCK] < f32::INFINITY;
                let [r, g, b] = &line.channels;
                let mut x = part.start;
                while x < part.end {
                    let start = x;
                    while x < part.end && is_drawn(x) {
                        line.run.push([r[x], g[x], b[x]]);
                        x += 1;
                    }
                    if !line.run.is_empty() {
                        target.store(steps.start + start, row, &line.run);
                        line.run.clear();
                    }
                    x += 1;
                }
            }
        });
        target.finish(row);
        buffers.tile.clear_row(row);
    }

    /// Calls `visit` with the number of some uniforms and pixels of which all that are drawn have these.
    fn each_uniforms(
        &self,
        tile: &Tile,
        row: usize,
        drawn: Range<usize>,
        mut visit: impl FnMut(UniformsIndex, Range<usize>),
    ) {
        if drawn.is_empty() {
            return;
        }
        if let Some(only) = self.only {
            return visit(only, drawn);
        }
        let first = drawn.start / BLOCK;
        let cells = tile.row(row, first..drawn.end.div_ceil(BLOCK));
        let at = |x: usize, number: usize| {
            cells[(x / BLOCK - first) * tile.stride() + number * BLOCK + x % BLOCK]
        };
        let (mut from, mut same) = (drawn.start, None);
        for x in drawn.clone() {
            if at(x, 0) < f32::INFINITY {
                let uniforms = UniformsIndex(at(x, self.numbers - 1) as u32);
                if let Some(same) = same.filter(|same| *same != uniforms) {
                    visit(same, from..x);
                    from = x;
                }
                same = Some(uniforms);
            }
        }
        // A row that shows nothing is background whatever it is shaded with.
        let first = self.setup.uniforms_of_material(0);
        visit(same.unwrap_or(first), from..drawn.end);
    }
}
