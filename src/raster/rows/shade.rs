//! One row of a band, from planes to colours: two groups at a time, as shading one of them waits for its own results.

use super::Consts;
use super::band::Band;
use crate::frame::Frame;
use crate::number::{Lanes, Num, Pair};
use crate::shader::Shader;
use alloc::vec::Vec;
use core::ops::Range;
use core::slice::ChunksExactMut;

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

    /// The places of `count` pixels from pixel `x` on; or, where they do not all go there, two groups aside.
    #[inline(always)]
    fn places<'a, M: Lanes>(
        &'a mut self,
        aside: &'a mut Aside,
        (x, count): (usize, usize),
        is_here: bool,
    ) -> Places<'a> {
        match self {
            Colours::Packed(texels, background) => {
                let texels = if is_here {
                    &mut texels[x..x + count]
                } else {
                    &mut aside.texels[..count]
                };
                Places::Packed(texels.chunks_exact_mut(2 * M::WIDTH), *background)
            }
            Colours::Linear(channels) => {
                let [depth, r, g, b] = channels;
                let [no_depth, no_r, no_g, no_b] = &mut aside.channels;
                let of = |here: &'a mut Vec<f32>, aside: &'a mut [f32; MOST]| {
                    let place = if is_here {
                        &mut here[x..x + count]
                    } else {
                        &mut aside[..count]
                    };
                    place.chunks_exact_mut(M::WIDTH)
                };
                Places::Linear([of(depth, no_depth), of(r, no_r), of(g, no_g), of(b, no_b)])
            }
        }
    }

    /// Copies the pixels `pixels` of two groups aside that begin with pixel `x`.
    fn copy(&mut self, from: &Aside, x: usize, pixels: Range<usize>) {
        if pixels.is_empty() {
            return;
        }
        let part = pixels.start - x..pixels.end - x;
        match self {
            Colours::Packed(texels, _) => texels[pixels].copy_from_slice(&from.texels[part]),
            Colours::Linear(channels) => {
                for (channel, from) in channels.iter_mut().zip(&from.channels) {
                    channel[pixels.clone()].copy_from_slice(&from[part.clone()]);
                }
            }
        }
    }
}

/// Two groups whose pixels do not all go where they lie.
struct Aside {
    texels: [[u8; 4]; MOST],
    channels: [[f32; MOST]; 4],
}

/// Where the colours of neighbouring groups go.
enum Places<'a> {
    /// Two groups at a time; and the background.
    Packed(ChunksExactMut<'a, [u8; 4]>, [u8; 4]),
    /// One at a time.
    Linear([ChunksExactMut<'a, f32>; 4]),
}

impl Places<'_> {
    /// Stores two groups, where their depth is finite, else the background.
    #[inline(always)]
    fn store<M: Lanes>(&mut self, m: M, depth: Pair<M::F>, [r, g, b]: [Pair<M::F>; 3]) {
        match self {
            Places::Packed(places, background) => {
                let Some(place) = places.next() else { return };
                let (first, second) = place.split_at_mut(M::WIDTH);
                let infinite = m.splat(f32::INFINITY);
                m.pack(
                    [r.0, g.0, b.0],
                    m.less(depth.0, infinite),
                    *background,
                    first,
                );
                m.pack(
                    [r.1, g.1, b.1],
                    m.less(depth.1, infinite),
                    *background,
                    second,
                );
            }
            Places::Linear(channels) => {
                for (places, value) in channels.iter_mut().zip([depth, r, g, b]) {
                    for value in [value.0, value.1] {
                        if let Some(place) = places.next() {
                            m.store(value, place);
                        }
                    }
                }
            }
        }
    }

    /// Nothing was drawn in the next two groups.
    #[inline(always)]
    fn skip<M: Lanes>(&mut self, m: M) {
        match self {
            Places::Packed(places, background) => {
                if let Some(place) = places.next() {
                    place.fill(*background);
                }
            }
            Places::Linear(_) => self.store(
                m,
                Pair(m.splat(f32::INFINITY), m.splat(f32::INFINITY)),
                [Pair(m.splat(0.0), m.splat(0.0)); 3],
            ),
        }
    }
}

/// Shades what was drawn of a row and empties it. All of it has material `only`, or the band knows each pixel's.
#[inline(always)]
pub(super) fn row<S: Shader, M: Lanes>(
    m: M,
    consts: &Constants<S, M>,
    row: usize,
    band: &mut Band,
    colours: &mut Colours<'_>,
) {
    let mut aside = Aside {
        texels: [[0; 4]; MOST],
        channels: [[0.0; MOST]; 4],
    };
    let drawn = band.drawn();
    let (mut from, end) = (drawn.start * M::WIDTH, drawn.end * M::WIDTH);
    while from < end {
        let (to, material) = band.same_material::<M, S::Pixel<M::F>>(row, from..end, consts.only);
        let material = material as usize;
        let part = Part {
            row,
            pixels: from..to.min(colours.end()),
            aside: &mut aside,
        };
        from = to;
        if M::IS_ONE_REGISTER
            && let Colours::Packed(texels, background) = colours
        {
            let (to, levels) = ((&mut **texels, *background), m.splat(LEVELS));
            if const { one_by_one::<S>() } {
                if let Some(c) = S::usual(&consts.single[material], levels) {
                    part.usual::<S, M>(
                        m,
                        #[inline(always)]
                        |groups| {
                            let (first, second) = groups.split_at(groups.len() / 2);
                            let levels = m.splat(LEVELS);
                            [
                                S::scaled(&c, Band::pixel::<M, S::Pixel<M::F>>(m, first), levels),
                                S::scaled(&c, Band::pixel::<M, S::Pixel<M::F>>(m, second), levels),
                            ]
                        },
                        band,
                        to,
                    );
                    continue;
                }
            } else if let Some(c) = S::usual(&consts.paired[material], Pair(levels, levels)) {
                part.usual::<S, M>(
                    m,
                    #[inline(always)]
                    |groups| {
                        let (_, pixels) = Band::pixels::<M, S::Pixel<Pair<M::F>>>(m, groups);
                        let levels = m.splat(LEVELS);
                        let [r, g, b] = S::scaled(&c, pixels, Pair(levels, levels));
                        [[r.0, g.0, b.0], [r.1, g.1, b.1]]
                    },
                    band,
                    to,
                );
                continue;
            }
        }
        part.any::<S, M>(m, &consts.paired[material], band, colours);
    }
    band.empty_row::<M, S::Pixel<M::F>>(m, row);
}

/// The constants of a shader for each material.
pub(super) struct Constants<S: Shader, M: Lanes> {
    /// For two groups at a time.
    paired: Vec<Consts<S, M>>,
    /// For one, where that is what is shaded.
    single: Vec<S::Consts<M::F>>,
    /// The number of the one material that all pixels have, or any.
    only: u32,
}

impl<S: Shader, M: Lanes> Constants<S, M> {
    pub fn new(m: M, frame: &Frame, parameters: &[u32], only: Option<u32>) -> Self {
        let (all, twice) = (frame.lightings().iter(), |x| Pair(m.splat(x), m.splat(x)));
        let paired = all
            .clone()
            .map(|l| S::consts(l, parameters, &twice))
            .collect();
        let single = match const { one_by_one::<S>() } && M::IS_ONE_REGISTER {
            true => all
                .map(|l| S::consts(l, parameters, &|x| m.splat(x)))
                .collect(),
            false => Vec::new(),
        };
        Constants {
            paired,
            single,
            only: only.unwrap_or(0),
        }
    }
}

/// Whether usual pixels are shaded a group at a time: with the constants of several lights two at a time run out of registers (20.0
/// against 19.5 million instructions a frame with four, of 5,040 triangles). An illumination model is as large as 27 numbers with one light,
/// as 63 with four.
const fn one_by_one<S: Shader>() -> bool {
    size_of::<S::Consts<f32>>() > 40 * size_of::<f32>()
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
        // None are left where another material begins beyond the picture.
        while x < pixels.end && !pixels.is_empty() {
            let is_here = pixels.start <= x && x + two <= pixels.end;
            let count = if is_here {
                (pixels.end - x) / two * two
            } else {
                two
            };
            visit(x..x + count, is_here);
            x += count;
        }
    }

    /// Shades them by `levels`, which gives those of the colours of two groups, into the texels of their row; the background where nothing
    /// was drawn.
    #[inline(always)]
    fn usual<S: Shader, M: Lanes>(
        self,
        m: M,
        levels: impl Fn(&[f32]) -> [[M::F; 3]; 2],
        band: &Band,
        (texels, background): (&mut [[u8; 4]], [u8; 4]),
    ) {
        let Part { row, pixels, aside } = self;
        let infinite = m.splat(f32::INFINITY);
        Self::each::<M>(
            pixels.clone(),
            #[inline(always)]
            |groups, is_here| {
                let count = groups.len();
                let places = if is_here {
                    &mut texels[groups.clone()]
                } else {
                    &mut aside.texels[..count]
                };
                // Not `zip`, which is not inlined into this.
                let mut places = places.chunks_exact_mut(2 * M::WIDTH);
                for cells in band
                    .row::<M, S::Pixel<M::F>>(row, groups.start / M::WIDTH..groups.end / M::WIDTH)
                {
                    let Some(place) = places.next() else { return };
                    let (depth, _) = Band::pixels::<M, S::Pixel<Pair<M::F>>>(m, cells);
                    if !m.any(m.less(depth.0.min(depth.1), infinite)) {
                        place.fill(background);
                        continue;
                    }
                    let (first, second) = place.split_at_mut(M::WIDTH);
                    let [one, two] = levels(cells);
                    m.pack_levels(one, m.less(depth.0, infinite), background, first);
                    m.pack_levels(two, m.less(depth.1, infinite), background, second);
                }
                if !is_here {
                    let part = pixels.start.max(groups.start)..pixels.end.min(groups.end);
                    let from = part.start - groups.start..part.end - groups.start;
                    texels[part].copy_from_slice(&aside.texels[from]);
                }
            },
        );
    }

    /// Shades them with any constants of their material.
    #[inline(always)]
    fn any<S: Shader, M: Lanes>(
        self,
        m: M,
        consts: &Consts<S, M>,
        band: &Band,
        colours: &mut Colours<'_>,
    ) {
        let Part { row, pixels, aside } = self;
        let consts = *consts;
        let infinite = m.splat(f32::INFINITY);
        Self::each::<M>(
            pixels.clone(),
            #[inline(always)]
            |groups, is_here| {
                let mut places = colours.places::<M>(aside, (groups.start, groups.len()), is_here);
                for cells in band
                    .row::<M, S::Pixel<M::F>>(row, groups.start / M::WIDTH..groups.end / M::WIDTH)
                {
                    let (depth, planes) = Band::pixels::<M, S::Pixel<Pair<M::F>>>(m, cells);
                    if m.any(m.less(depth.0.min(depth.1), infinite)) {
                        places.store(m, depth, S::shade(&consts, planes));
                    } else {
                        places.skip(m);
                    }
                }
                if !is_here {
                    colours.copy(
                        aside,
                        groups.start,
                        pixels.start.max(groups.start)..pixels.end.min(groups.end),
                    );
                }
            },
        );
    }
}
