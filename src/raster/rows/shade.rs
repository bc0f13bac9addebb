//! One row of a band, from planes to colours.

use super::band::Band;
use crate::number::Lanes;
use crate::shader::Shader;
use alloc::vec::Vec;
use core::ops::Range;

/// Where the colours of a row go: into texels as they are stored, or into depth and three channels.
pub(super) enum Colours<'a> {
    /// The texels of the row, and the background.
    Packed(&'a mut [[u8; 4]], [u8; 4]),
    /// Depth, red, green and blue, linear and not yet clamped.
    Linear(&'a mut [Vec<f32>; 4]),
}

impl Colours<'_> {
    /// Stores the colours of a group that begins with pixel `x`, where its depth is finite, and the background elsewhere.
    #[inline(always)]
    fn store<M: Lanes>(&mut self, m: M, x: usize, depth: M::F, rgb: [M::F; 3]) {
        match self {
            Colours::Packed(texels, background) => {
                let covered = m.less(depth, m.splat(f32::INFINITY));
                match texels.get_mut(x..x + M::WIDTH) {
                    Some(texels) => m.pack(rgb, covered, *background, texels),
                    None => self.store_part(m, x, x..x + M::WIDTH, depth, rgb),
                }
            }
            Colours::Linear(channels) => {
                let mut i = 0;
                while i < 4 {
                    let value = if i == 0 { depth } else { rgb[i - 1] };
                    m.store(value, &mut channels[i][x..]);
                    i += 1;
                }
            }
        }
    }

    /// The same of the pixels `pixels` only, as far as there are any.
    #[cold]
    fn store_part<M: Lanes>(&mut self, m: M, x: usize, pixels: Range<usize>, depth: M::F, rgb: [M::F; 3]) {
        // Not inlined where rows are shaded, it has to ask for its instructions itself.
        m.vectorize(
            #[inline(always)]
            || match self {
                Colours::Packed(texels, background) => {
                    let mut all = [[0; 4]; 8];
                    m.pack(rgb, m.less(depth, m.splat(f32::INFINITY)), *background, &mut all);
                    let own = pixels.start.max(x)..pixels.end.min(x + M::WIDTH).min(texels.len());
                    if let Some(texels) = texels.get_mut(own.clone()) {
                        texels.copy_from_slice(&all[own.start - x..own.end - x]);
                    }
                }
                Colours::Linear(channels) => {
                    let own = m.lanes(pixels.start.saturating_sub(x), pixels.end - x);
                    let mut i = 0;
                    while i < 4 {
                        let value = if i == 0 { depth } else { rgb[i - 1] };
                        let place = &mut channels[i][x..];
                        m.store(m.blend(own, value, m.load(place)), place);
                        i += 1;
                    }
                }
            },
        );
    }

    /// Nothing was drawn in the group that begins with pixel `x`.
    #[inline(always)]
    fn skip<M: Lanes>(&mut self, m: M, x: usize) {
        match self {
            Colours::Packed(texels, background) => {
                let end = texels.len().min(x + M::WIDTH);
                texels[x..end].fill(*background);
            }
            Colours::Linear([depth, ..]) => m.store(m.splat(f32::INFINITY), &mut depth[x..]),
        }
    }
}

/// Shades what was drawn of a row and empties it. All of it has material `only`, or the band knows each pixel's.
#[inline(always)]
pub(super) fn row<S: Shader, M: Lanes>(
    m: M,
    (all, only): (&[S::Consts<M::F>], u32),
    row: usize,
    band: &mut Band,
    colours: &mut Colours<'_>,
) {
    let nothing = m.splat(f32::INFINITY);
    let (mut from, end) = (band.drawn.start * M::WIDTH, band.drawn.end * M::WIDTH);
    while from < end {
        let (to, material) = band.same_material::<M, S::Pixel<M::F>>(row, from..end, only);
        // A copy that nothing else refers to: loads from it can leave the loop.
        let consts = all[material as usize];
        let mut x = from / M::WIDTH * M::WIDTH;
        for cell in band.row::<M, S::Pixel<M::F>>(row, x / M::WIDTH..to.div_ceil(M::WIDTH)) {
            let depth = m.load(cell);
            if m.any(m.less(depth, nothing)) {
                let rgb = S::shade(&consts, Band::pixel(m, cell));
                if from <= x && x + M::WIDTH <= to {
                    colours.store(m, x, depth, rgb);
                } else {
                    colours.store_part(m, x, from..to, depth, rgb);
                }
            } else {
                colours.skip(m, x);
            }
            x += M::WIDTH;
        }
        from = to;
    }
    band.empty_row::<M, S::Pixel<M::F>>(m, row);
}
