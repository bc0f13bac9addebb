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
    /// Stores the colours of two groups that begin with pixel `x` where their depth is finite, and the background elsewhere.
    #[inline(always)]
    fn store<M: Lanes>(&mut self, m: M, x: usize, depth: Pair<M::F>, rgb: [Pair<M::F>; 3]) {
        match self {
            Colours::Packed(texels, background) => {
                pack(m, depth, rgb, *background, &mut texels[x..x + 2 * M::WIDTH]);
            }
            Colours::Linear(channels) => {
                for (channel, value) in channels.iter_mut().zip([depth, rgb[0], rgb[1], rgb[2]]) {
                    let (first, second) = channel[x..x + 2 * M::WIDTH].split_at_mut(M::WIDTH);
                    m.store(value.0, first);
                    m.store(value.1, second);
                }
            }
        }
    }

    /// Stores two groups that begin with pixel `x`, which were stored aside: the pixels `pixels` only, as far as there are any.
    #[cold]
    #[inline(never)]
    fn store_part(&mut self, from: &Aside, x: usize, pixels: Range<usize>) {
        let own = pixels.start.max(x)..pixels.end.min(x + MOST);
        let part = own.start - x..own.end - x;
        match self {
            Colours::Packed(texels, _) => texels[own].copy_from_slice(&from.texels[part]),
            Colours::Linear(channels) => {
                for (channel, from) in channels.iter_mut().zip(&from.channels) {
                    channel[own.clone()].copy_from_slice(&from[part.clone()]);
                }
            }
        }
    }

    /// How many pixels there is room for.
    #[inline(always)]
    fn end(&self) -> usize {
        match self {
            Colours::Packed(texels, _) => texels.len(),
            Colours::Linear([depth, ..]) => depth.len(),
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

/// Two groups whose pixels do not all go where they lie.
struct Aside {
    texels: [[u8; 4]; MOST],
    channels: [[f32; MOST]; 4],
}

impl Aside {
    /// As they go into `colours`.
    #[inline(always)]
    fn new<M: Lanes>(m: M, colours: &Colours<'_>, depth: Pair<M::F>, rgb: [Pair<M::F>; 3]) -> Self {
        let mut aside = Aside { texels: [[0; 4]; MOST], channels: [[0.0; MOST]; 4] };
        match colours {
            Colours::Packed(_, background) => pack(m, depth, rgb, *background, &mut aside.texels[..2 * M::WIDTH]),
            Colours::Linear(_) => {
                for (channel, value) in aside.channels.iter_mut().zip([depth, rgb[0], rgb[1], rgb[2]]) {
                    m.store(value.0, channel);
                    m.store(value.1, &mut channel[M::WIDTH..]);
                }
            }
        }
        aside
    }
}

/// Packs two groups into texels.
#[inline(always)]
fn pack<M: Lanes>(m: M, depth: Pair<M::F>, [r, g, b]: [Pair<M::F>; 3], background: [u8; 4], texels: &mut [[u8; 4]]) {
    let infinite = m.splat(f32::INFINITY);
    let (first, second) = texels.split_at_mut(M::WIDTH);
    m.pack([r.0, g.0, b.0], m.less(depth.0, infinite), background, first);
    m.pack([r.1, g.1, b.1], m.less(depth.1, infinite), background, second);
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
        // Where two groups lie wholly in these pixels, if they begin there.
        let whole = from..(end + 1).saturating_sub(2 * M::WIDTH);
        for groups in band.row::<M, S::Pixel<M::F>>(row, x / M::WIDTH..to.div_ceil(2 * M::WIDTH) * 2) {
            let (depth, pixels) = Band::pixels::<M, S::Pixel<Pair<M::F>>>(m, groups);
            if m.any(m.less(depth.0.min(depth.1), infinite)) {
                let rgb = S::shade(&consts, pixels);
                if whole.contains(&x) {
                    colours.store(m, x, depth, rgb);
                } else {
                    let aside = Aside::new(m, colours, depth, rgb);
                    colours.store_part(&aside, x, from..end.min(x + 2 * M::WIDTH));
                }
            } else {
                colours.skip(m, x);
            }
            x += 2 * M::WIDTH;
        }
        from = to;
    }
    band.empty_row::<M, S::Pixel<M::F>>(m, row);
}
