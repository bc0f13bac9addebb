//! One row of a band, from planes to colours: two groups at a time, as shading one of them waits for its own results.

use super::Consts;
use super::band::Band;
use crate::number::{Lanes, Num, Pair};
use crate::shader::Shader;
use alloc::vec::Vec;
use core::ops::Range;

/// Where the colours of a row go: into texels as they are stored, or into depth and three channels.
pub(super) enum Colours<'a> {
    /// The texels of the row, and the background.
    Packed(&'a mut [[u8; 4]], [u8; 4]),
    /// Depth, red, green and blue, linear and not yet clamped, with room for two groups beyond the row.
    Linear(&'a mut [Vec<f32>; 4]),
}

/// The most pixels of two groups.
const MOST: usize = 16;

impl Colours<'_> {
    /// Stores the colours of two groups that begin with pixel `x` where their depth is finite, and the background elsewhere: all of
    /// them if `is_whole`, else of the pixels `pixels` only, as far as there are any.
    #[inline(always)]
    fn store<M: Lanes>(
        &mut self,
        m: M,
        (x, is_whole): (usize, bool),
        pixels: &Range<usize>,
        depth: Pair<M::F>,
        [r, g, b]: [Pair<M::F>; 3],
    ) {
        let infinite = m.splat(f32::INFINITY);
        match self {
            Colours::Packed(texels, background) => {
                // Not into the row where it has other texels there: the colours themselves need not leave their registers then.
                let mut aside = [[0; 4]; MOST];
                let place = if is_whole { &mut texels[x..x + 2 * M::WIDTH] } else { &mut aside[..2 * M::WIDTH] };
                let (first, second) = place.split_at_mut(M::WIDTH);
                m.pack([r.0, g.0, b.0], m.less(depth.0, infinite), *background, first);
                m.pack([r.1, g.1, b.1], m.less(depth.1, infinite), *background, second);
                if !is_whole {
                    copy_part(&aside[..2 * M::WIDTH], x, pixels, texels);
                }
            }
            Colours::Linear(channels) => {
                let values = [depth, r, g, b];
                let mut i = 0;
                while i < 4 {
                    let value = values[i];
                    let places = [(x, value.0), (x + M::WIDTH, value.1)];
                    let mut group = 0;
                    while group < 2 {
                        let (x, value) = places[group];
                        let own = m.lanes(pixels.start.saturating_sub(x), pixels.end.saturating_sub(x));
                        let place = &mut channels[i][x..];
                        m.store(m.blend(own, value, m.load(place)), place);
                        group += 1;
                    }
                    i += 1;
                }
            }
        }
    }

    /// How many texels there are.
    #[inline(always)]
    fn end(&self) -> usize {
        match self {
            Colours::Packed(texels, _) => texels.len(),
            Colours::Linear(_) => 0,
        }
    }

    /// Nothing was drawn in the two groups that begin with pixel `x`.
    #[inline(always)]
    fn skip<M: Lanes>(&mut self, m: M, x: usize) {
        match self {
            Colours::Packed(texels, background) => {
                let end = texels.len().min(x + 2 * M::WIDTH);
                texels[x..end].fill(*background);
            }
            Colours::Linear([depth, ..]) => {
                m.store(m.splat(f32::INFINITY), &mut depth[x..]);
                m.store(m.splat(f32::INFINITY), &mut depth[x + M::WIDTH..]);
            }
        }
    }
}

/// Copies the texels of the pixels `pixels`, as far as there are any, from those that begin with pixel `x`.
#[cold]
#[inline(never)]
fn copy_part(from: &[[u8; 4]], x: usize, pixels: &Range<usize>, texels: &mut [[u8; 4]]) {
    let own = pixels.start.max(x)..pixels.end.min(x + from.len()).min(texels.len());
    if own.start < own.end {
        texels[own.clone()].copy_from_slice(&from[own.start - x..own.end - x]);
    }
}

/// Shades what was drawn of a row and empties it. All of it has material `only`, or the band knows each pixel's.
#[inline(always)]
pub(super) fn row<S: Shader, M: Lanes>(
    m: M,
    (all, only): (&[Consts<S, M>], u32),
    row: usize,
    band: &mut Band,
    colours: &mut Colours<'_>,
) {
    let infinite = m.splat(f32::INFINITY);
    let drawn = band.drawn();
    let (mut from, end) = (drawn.start * M::WIDTH, drawn.end * M::WIDTH);
    while from < end {
        let (to, material) = band.same_material::<M, S::Pixel<M::F>>(row, from..end, only);
        // A copy that nothing else refers to: loads from it can leave the loop.
        let consts = all[material as usize];
        let mut x = from / (2 * M::WIDTH) * 2 * M::WIDTH;
        let end = to.min(colours.end());
        for groups in band.row::<M, S::Pixel<M::F>>(row, x / M::WIDTH..to.div_ceil(2 * M::WIDTH) * 2) {
            let (depth, pixels) = Band::pixels::<M, S::Pixel<Pair<M::F>>>(m, groups);
            if m.any(m.less(depth.0.min(depth.1), infinite)) {
                let is_whole = from <= x && x + 2 * M::WIDTH <= end;
                colours.store(m, (x, is_whole), &(from..to), depth, S::shade(&consts, pixels));
            } else {
                colours.skip(m, x);
            }
            x += 2 * M::WIDTH;
        }
        from = to;
    }
    band.empty_row::<M, S::Pixel<M::F>>(m, row);
}
