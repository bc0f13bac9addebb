//! Shading: turns a row of the G-buffer into colours, by one call of the method's kernel for each
//! stretch of one material. The loop over the pixels is `shade_blocks` in `shading/kernels/mod.rs`.

use super::tile::Tile;
use super::{Buffers, RowEngine, with_level};
use crate::number::lanes::Lanes;
use crate::number::simd::{BLOCK, Token, vectorize};
use crate::raster::target::Target;
use crate::shading::{CellLayout, RowColours, ShadeRow, UniformsIndex};
use alloc::vec::Vec;
use core::ops::Range;
use fearless_simd::{SimdBase, SimdMask, i32x8};

/// How many pixels kernels take at a time, at most. Rows are shaded in multiples of it, from a
/// multiple of it on.
const STEP: usize = 2 * BLOCK;

/// Buffers for the colours of a row that cannot go straight into the picture.
#[derive(Debug, Default)]
pub(crate) struct RowBuffers {
    bytes: Vec<[u8; 4]>,
    channels: [Vec<f32>; 3],
    run: Vec<[f32; 3]>,
    /// The stretches of a row, with their uniforms.
    stretches: Vec<(UniformsIndex, Range<usize>)>,
}

impl RowEngine<'_> {
    /// Shades row `row` of a tile into `target`, and empties the row.
    pub(super) fn shade(&self, row: usize, buffers: &mut Buffers, target: &mut dyn Target) {
        let Buffers {
            tile, depths, line, ..
        } = buffers;
        let width = self.setup.frame.width();
        if let Some(stored) = target.depth(row) {
            if self.depths.is_some() {
                tile.take_depths(row, depths);
            }
            tile.hide_behind(row, stored);
        }
        let (blocks, background) = (tile.drawn(), self.background);
        let drawn = (blocks.start * BLOCK).min(width)..(blocks.end * BLOCK).min(width);
        if let Some(to) = target.levels(row) {
            to[..drawn.start].fill(background);
            to[drawn.end..].fill(background);
        }
        match self.only {
            _ if drawn.is_empty() => (),
            _ if self.is_packed => {
                let levels = target.levels(row);
                let to = &mut levels.expect("colours are packed for levels")[drawn];
                with_level!(self.level, S => self.show::<S>(tile, row, to));
            }
            Some(only) => self.shade_stretch(tile, row, drawn, only, line, target),
            None => {
                let mut stretches = core::mem::take(&mut line.stretches);
                with_level!(self.level, S => {
                    self.find_stretches::<S>(tile, row, drawn, &mut stretches);
                });
                for (uniforms, pixels) in stretches.drain(..) {
                    self.shade_stretch(tile, row, pixels, uniforms, line, target);
                }
                line.stretches = stretches;
            }
        }
        target.finish(row);
        tile.clear_row(row);
    }

    /// Shades pixels of row `row` of a tile that share their uniforms.
    #[inline(always)]
    fn shade_stretch(
        &self,
        tile: &Tile,
        row: usize,
        pixels: Range<usize>,
        uniforms: UniformsIndex,
        line: &mut RowBuffers,
        target: &mut dyn Target,
    ) {
        // Kernels shade whole steps. Pixels of a step that belong to another stretch are shaded in
        // vain and not copied.
        let steps = pixels.start / STEP * STEP..pixels.end.next_multiple_of(STEP);
        let cells = tile.row(row, steps.start / BLOCK..steps.end / BLOCK);
        let job = ShadeRow {
            parameters: self.setup.parameters,
            uniforms: &self.setup.uniforms[uniforms.0 as usize],
            extras: self.setup.extras,
            cell: self.cell,
        };
        let part = pixels.start - steps.start..pixels.end - steps.start;
        if let Some(to) = target.levels(row) {
            if pixels == steps {
                let mut out = RowColours::Bytes(&mut to[pixels], self.background);
                return (self.kernels.shade)(&job, cells, &mut out);
            }
            line.bytes.resize(steps.len(), self.background);
            let mut out = RowColours::Bytes(&mut line.bytes, self.background);
            (self.kernels.shade)(&job, cells, &mut out);
            to[pixels].copy_from_slice(&line.bytes[part]);
            return;
        }
        let channels = line.channels.each_mut().map(|channel| {
            channel.resize(steps.len(), 0.0);
            &mut channel[..]
        });
        (self.kernels.shade)(&job, cells, &mut RowColours::Linear(channels));
        let depths = BLOCK * CellLayout::DEPTH;
        let is_drawn =
            |x: usize| cells[x / BLOCK * tile.stride() + depths + x % BLOCK] < f32::INFINITY;
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

    /// Splits the pixels `drawn` of a row into stretches, and finds for each the uniforms that all
    /// of its visible pixels have.
    ///
    /// It tests a block at a time. Most blocks only have pixels with the same uniforms as the
    /// pixels before.
    pub(super) fn find_stretches<S: Token>(
        &self,
        tile: &Tile,
        row: usize,
        drawn: Range<usize>,
        to: &mut Vec<(UniformsIndex, Range<usize>)>,
    ) {
        let m = Lanes(S::get());
        let cells = tile.row(row, drawn.start / BLOCK..drawn.end.div_ceil(BLOCK));
        vectorize(
            m.0,
            #[inline(always)]
            || {
                let (mut from, mut same) = (drawn.start, None);
                let starts = drawn.clone().step_by(BLOCK);
                for (start, block) in starts.zip(cells.chunks_exact(tile.stride())) {
                    let depth = m.load(&block[BLOCK * CellLayout::DEPTH..]);
                    let all = &block[BLOCK * self.cell.uniforms()..][..BLOCK];
                    let (indices, mut later) = (m.load(all), u32::MAX);
                    let is_empty: i32x8<S> = depth.simd_ge(m.splat(f32::INFINITY)).to_vector();
                    loop {
                        // Indices are 0 or more, so −1 equals none of them and the first visible
                        // pixel starts a stretch.
                        let is_same = indices.simd_eq(m.splat(same.unwrap_or(-1.0)));
                        // Lanes that are visible and have other uniforms, from the lane after the
                        // last change on. An empty pixel joins any stretch.
                        let others = m.bits_not_negative(is_same.to_vector() | is_empty) & later;
                        let k = others.trailing_zeros() as usize;
                        // The last block may end beyond the picture.
                        if k >= BLOCK || start + k >= drawn.end {
                            break;
                        }
                        if let Some(same) = same {
                            to.push((CellLayout::uniforms_of(same), from..start + k));
                            from = start + k;
                        }
                        (same, later) = (Some(all[k]), u32::MAX << k);
                    }
                }
                // A row without visible pixels becomes background with any uniforms.
                let first = || self.setup.uniforms_of_material(0);
                to.push((
                    same.map_or_else(first, CellLayout::uniforms_of),
                    from..drawn.end,
                ));
            },
        );
    }
}
