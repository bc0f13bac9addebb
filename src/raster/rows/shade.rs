//! Shading: one row of the G-buffer to colours, by one call of the method for each material on it. The loop
//! over its pixels is the method's kernel: `shade_any` in `shading/kernels.rs`.

use super::tile::Tile;
use super::{Rows, Scratch};
use crate::number::simd::BLOCK;
use crate::raster::target::Target;
use crate::shading::{RowColours, ShadeRow};
use alloc::vec::Vec;
use core::ops::Range;

/// Pixels that kernels take at a time, at most: rows are shaded from a multiple of this on.
const STEP: usize = 2 * BLOCK;

/// The colours of a row, and of a step whose pixels do not all go where they lie.
#[derive(Debug, Default)]
pub(crate) struct Line {
    row: [Vec<f32>; 3],
    aside: [[f32; STEP]; 3],
    bytes: [[u8; 4]; STEP],
    run: Vec<[f32; 3]>,
}

impl Rows<'_> {
    /// Shades row `row` of a tile into `target`, and empties it.
    pub(super) fn shade(&self, row: usize, scratch: &mut Scratch, target: &mut dyn Target) {
        let Scratch { tile, line, .. } = scratch;
        let width = self.setup.frame.width();
        let blocks = tile.drawn();
        let drawn = (blocks.start * BLOCK).min(width)..(blocks.end * BLOCK).min(width);
        if let Some((to, background)) = target.bytes(row) {
            to[..drawn.start].fill(background);
            to[drawn.end..].fill(background);
            self.each_material(tile, row, drawn, |uniforms, pixels| {
                self.bytes(tile, row, uniforms, pixels, line, to, background);
            });
        } else {
            for channel in &mut line.row {
                channel.resize(channel.len().max(width + STEP), 0.0);
            }
            self.each_material(tile, row, drawn.clone(), |uniforms, pixels| {
                self.linear(tile, row, uniforms, pixels, line);
            });
            store(tile, row, drawn, line, target);
        }
        scratch.tile.clear_row(row);
    }

    /// Gives the pixels between which all that are drawn have the same material, and its uniforms.
    fn each_material(
        &self,
        tile: &Tile,
        row: usize,
        drawn: Range<usize>,
        mut visit: impl FnMut(u32, Range<usize>),
    ) {
        if drawn.is_empty() {
            return;
        }
        if !self.has_material {
            return visit(self.only, drawn);
        }
        let first = drawn.start / BLOCK;
        let cells = tile.row(row, first..drawn.end.div_ceil(BLOCK));
        let at = |x: usize, number: usize| {
            cells[(x / BLOCK - first) * tile.stride() + number * BLOCK + x % BLOCK]
        };
        let (mut from, mut same) = (drawn.start, None);
        for x in drawn.clone() {
            if at(x, 0) < f32::INFINITY {
                let material = at(x, tile.stride() / BLOCK - 1) as u32;
                if let Some(same) = same
                    && same != material
                {
                    visit(same, from..x);
                    from = x;
                }
                same = Some(material);
            }
        }
        visit(same.unwrap_or(0), from..drawn.end);
    }

    fn job(&self, uniforms: u32) -> ShadeRow<'_> {
        ShadeRow {
            parameters: self.setup.parameters,
            uniforms: &self.setup.uniforms[uniforms as usize],
            extras: self.setup.extras,
            numbers: self.numbers,
        }
    }

    #[expect(clippy::too_many_arguments)] // where from, what, and where to
    fn bytes(
        &self,
        tile: &Tile,
        row: usize,
        uniforms: u32,
        pixels: Range<usize>,
        line: &mut Line,
        to: &mut [[u8; 4]],
        background: [u8; 4],
    ) {
        let job = self.job(uniforms);
        each_step(&pixels, |steps, is_here| {
            let cells = tile.row(row, steps.start / BLOCK..steps.end / BLOCK);
            if is_here {
                let mut out = RowColours::Bytes(&mut to[steps], background);
                (self.kernels.shade)(&job, cells, &mut out);
                return;
            }
            let mut out = RowColours::Bytes(&mut line.bytes, background);
            (self.kernels.shade)(&job, cells, &mut out);
            let part = pixels.start.max(steps.start)..pixels.end.min(steps.end);
            let from = part.start - steps.start..part.end - steps.start;
            to[part].copy_from_slice(&line.bytes[from]);
        });
    }

    fn linear(
        &self,
        tile: &Tile,
        row: usize,
        uniforms: u32,
        pixels: Range<usize>,
        line: &mut Line,
    ) {
        let job = self.job(uniforms);
        each_step(&pixels, |steps, is_here| {
            let cells = tile.row(row, steps.start / BLOCK..steps.end / BLOCK);
            if is_here {
                let to = line
                    .row
                    .each_mut()
                    .map(|channel| &mut channel[steps.clone()]);
                return (self.kernels.shade)(&job, cells, &mut RowColours::Linear(to));
            }
            let to = line.aside.each_mut().map(|channel| &mut channel[..]);
            (self.kernels.shade)(&job, cells, &mut RowColours::Linear(to));
            let part = pixels.start.max(steps.start)..pixels.end.min(steps.end);
            let from = part.start - steps.start..part.end - steps.start;
            for (to, aside) in line.row.iter_mut().zip(&line.aside) {
                to[part.clone()].copy_from_slice(&aside[from.clone()]);
            }
        });
    }
}

/// Gives the steps that hold some pixels: as many as go where they lie (`true`), or one that does not.
fn each_step(pixels: &Range<usize>, mut visit: impl FnMut(Range<usize>, bool)) {
    let mut x = pixels.start / STEP * STEP;
    while x < pixels.end {
        let is_here = pixels.start <= x && x + STEP <= pixels.end;
        let count = if is_here {
            (pixels.end - x) / STEP * STEP
        } else {
            STEP
        };
        visit(x..x + count, is_here);
        x += count;
    }
}

/// Stores the pixels of a row that were drawn.
fn store(tile: &Tile, row: usize, drawn: Range<usize>, line: &mut Line, target: &mut dyn Target) {
    let first = drawn.start / BLOCK;
    let cells = tile.row(row, first..drawn.end.div_ceil(BLOCK));
    let is_drawn =
        |x: usize| cells[(x / BLOCK - first) * tile.stride() + x % BLOCK] < f32::INFINITY;
    let mut x = drawn.start;
    while x < drawn.end {
        line.run.clear();
        let start = x;
        while x < drawn.end && is_drawn(x) {
            line.run
                .push([line.row[0][x], line.row[1][x], line.row[2][x]]);
            x += 1;
        }
        if line.run.is_empty() {
            x += 1;
        } else {
            target.store(start, row, &line.run);
        }
    }
}
