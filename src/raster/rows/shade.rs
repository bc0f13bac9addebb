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
    /// How many pixels there is room for.
    #[inline(always)]
    fn end(&self) -> usize {
        match self {
            Colours::Packed(texels, _) => texels.len(),
            Colours::Linear([depth, ..]) => depth.len(),
        }
    }
}

/// Two groups whose pixels do not all go where they lie.
struct Aside {
    texels: [[u8; 4]; MOST],
    channels: [[f32; MOST]; 4],
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
    let mut aside = Aside { texels: [[0; 4]; MOST], channels: [[0.0; MOST]; 4] };
    let drawn = band.drawn();
    let (mut from, end) = (drawn.start * M::WIDTH, drawn.end * M::WIDTH);
    while from < end {
        let (to, material) = band.same_material::<M, S::Pixel<M::F>>(row, from..end, only);
        let consts = &all[material as usize];
        let part = Part { row, pixels: from..to.min(colours.end()), aside: &mut aside };
        match colours {
            Colours::Packed(texels, background) => {
                let scale = m.splat(LEVELS);
                match S::usual(consts, Pair(scale, scale)) {
                    Some(consts) => part.packed::<S, M, true>(m, &consts, band, (texels, *background)),
                    None => part.packed::<S, M, false>(m, consts, band, (texels, *background)),
                }
            }
            Colours::Linear(channels) => part.linear::<S, M>(m, consts, band, channels),
        }
        from = to;
    }
    band.empty_row::<M, S::Pixel<M::F>>(m, row);
}

/// A colour of 1 as a level of a texel.
const LEVELS: f32 = 255.0;

/// Pixels of a row that have one material.
struct Part<'a> {
    row: usize,
    pixels: Range<usize>,
    aside: &'a mut Aside,
}

impl Part<'_> {
    /// Gives `visit` the pixels from a number on, as many groups as go where they lie, or two that do not; and whether they do.
    #[inline(always)]
    fn each<M: Lanes>(pixels: Range<usize>, mut visit: impl FnMut(Range<usize>, bool)) {
        let two = 2 * M::WIDTH;
        let mut x = pixels.start / two * two;
        while x < pixels.end {
            let is_here = pixels.start <= x && x + two <= pixels.end;
            let count = if is_here { (pixels.end - x) / two * two } else { two };
            visit(x..x + count, is_here);
            x += count;
        }
    }

    /// Shades them with the constants of their material into the texels of their row, and the background where nothing was drawn;
    /// `USUAL` are [`Shader::usual`] constants, of levels.
    #[inline(always)]
    fn packed<S: Shader, M: Lanes, const USUAL: bool>(
        self,
        m: M,
        consts: &Consts<S, M>,
        band: &Band,
        (texels, background): (&mut [[u8; 4]], [u8; 4]),
    ) {
        let Part { row, pixels, aside } = self;
        // A copy that nothing else refers to: loads from it can leave the loop.
        let consts = *consts;
        let (infinite, scale) = (m.splat(f32::INFINITY), m.splat(LEVELS));
        Self::each::<M>(
            pixels.clone(),
            #[inline(always)]
            |groups, is_here| {
                let count = groups.len();
                let places = if is_here { &mut texels[groups.clone()] } else { &mut aside.texels[..count] };
                let cells = band.row::<M, S::Pixel<M::F>>(row, groups.start / M::WIDTH..groups.end / M::WIDTH);
                // Not `zip`, which is not inlined into this.
                let mut places = places.chunks_exact_mut(2 * M::WIDTH);
                for cells in cells {
                    let Some(place) = places.next() else { return };
                    let (depth, planes) = Band::pixels::<M, S::Pixel<Pair<M::F>>>(m, cells);
                    if !m.any(m.less(depth.0.min(depth.1), infinite)) {
                        place.fill(background);
                        continue;
                    }
                    let (first, second) = place.split_at_mut(M::WIDTH);
                    let covered = (m.less(depth.0, infinite), m.less(depth.1, infinite));
                    if USUAL {
                        let [r, g, b] = S::scaled(&consts, planes, Pair(scale, scale));
                        m.pack_levels([r.0, g.0, b.0], covered.0, background, first);
                        m.pack_levels([r.1, g.1, b.1], covered.1, background, second);
                    } else {
                        let [r, g, b] = S::shade(&consts, planes);
                        m.pack([r.0, g.0, b.0], covered.0, background, first);
                        m.pack([r.1, g.1, b.1], covered.1, background, second);
                    }
                }
                if !is_here {
                    let part = pixels.start.max(groups.start)..pixels.end.min(groups.end);
                    let from = part.start - groups.start..part.end - groups.start;
                    texels[part].copy_from_slice(&aside.texels[from]);
                }
            },
        );
    }

    /// Shades them with the constants of their material into depth and three channels.
    #[inline(always)]
    fn linear<S: Shader, M: Lanes>(self, m: M, consts: &Consts<S, M>, band: &Band, channels: &mut [Vec<f32>; 4]) {
        let Part { row, pixels, aside } = self;
        let consts = *consts;
        let infinite = m.splat(f32::INFINITY);
        Self::each::<M>(
            pixels.clone(),
            #[inline(always)]
            |groups, is_here| {
                let cells = band.row::<M, S::Pixel<M::F>>(row, groups.start / M::WIDTH..groups.end / M::WIDTH);
                for (i, cells) in cells.enumerate() {
                    let (depth, planes) = Band::pixels::<M, S::Pixel<Pair<M::F>>>(m, cells);
                    let [r, g, b] = match m.any(m.less(depth.0.min(depth.1), infinite)) {
                        true => S::shade(&consts, planes),
                        false => [Pair(m.splat(0.0), m.splat(0.0)); 3],
                    };
                    let at = if is_here { groups.start + 2 * M::WIDTH * i } else { 0 };
                    for (k, value) in [depth, r, g, b].into_iter().enumerate() {
                        let place = if is_here { &mut channels[k][at..] } else { &mut aside.channels[k][at..] };
                        m.store(value.0, place);
                        m.store(value.1, &mut place[M::WIDTH..]);
                    }
                }
                if !is_here {
                    let part = pixels.start.max(groups.start)..pixels.end.min(groups.end);
                    let from = part.start - groups.start..part.end - groups.start;
                    for (channel, aside) in channels.iter_mut().zip(&aside.channels) {
                        channel[part.clone()].copy_from_slice(&aside[from.clone()]);
                    }
                }
            },
        );
    }
}
