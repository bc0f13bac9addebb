//! Polygons into a band, run by run: what a walk gives is written wherever it is nearer than what was drawn before.

use super::band::{Cells, MOST_PLANES};
use super::batch::{Batch, Kind, each_bit};
use super::facets::Facet;
use crate::frame::Frame;
use crate::number::{Lanes, Planes, Scalar, each, get_each, put_each};
use crate::raster::depth::SampleDepth;
use crate::raster::setup::SetUp;
use crate::shader::{Shader, Span};
use crate::walk::{Attribute, Walk};
use core::ops::Range;

/// The span of a shader's attribute in plain numbers.
pub(super) type SpanIn<S> = <<S as Shader>::Attribute<f32> as Attribute<f32>>::Span;

/// How many planes a shader's pixels take; `None` where they cannot be stored as planes, or are too many.
pub(super) const fn planes<S: Shader, M: Lanes>() -> Option<usize> {
    match <S::Pixel<M::F> as Planes<M::F>>::COUNT {
        Some(count) if count <= MOST_PLANES => Some(count),
        _ => None,
    }
}

/// What draws polygons into a band whose pixels are given what a walk gives.
pub(super) struct Painter<'a, S: Shader> {
    pub frame: &'a Frame,
    pub setup: &'a SetUp<S, Scalar>,
    /// How depth is compared and kept.
    pub depth: SampleDepth,
}

impl<S: Shader> Painter<'_, S> {
    /// Draws those triangles of a batch whose bits `drawn` has on the band that begins with row `top`, in order; depth and attribute
    /// are linear over them.
    #[inline(always)]
    pub fn batch<M: Lanes>(
        &self,
        m: M,
        (batch, drawn): (&Batch, u32),
        top: usize,
        cells: &mut Cells<'_, M, S::Pixel<M::F>>,
    ) {
        each_bit(
            drawn,
            #[inline(always)]
            |k| {
                let (polygon, depth) = (batch.polygon(k), Facet::of(&batch.facets, 0, k));
                if batch.kind(k) == Kind::Small as i32 {
                    let small = batch.small(k);
                    let Some(walked) = self.walked(batch.corners(k), &depth, small.growth()) else {
                        return;
                    };
                    small.runs(
                        m,
                        top,
                        #[inline(always)]
                        |row, pixels, weights| {
                            self.walked_run(m, (top, row), pixels, polygon, &walked, weights, cells)
                        },
                    );
                } else if let Some(triangle) = batch.large(k) {
                    let Some(walked) = self.walked(batch.corners(k), &depth, triangle.across())
                    else {
                        return;
                    };
                    triangle.runs(
                        top,
                        #[inline(always)]
                        |row, pixels, weights| {
                            self.walked_run(m, (top, row), pixels, polygon, &walked, weights, cells)
                        },
                    );
                }
            },
        );
    }

    #[inline(always)]
    fn walked(&self, corners: [usize; 3], depth: &Facet, across: [f32; 2]) -> Option<Walked<S>> {
        let all = &self.setup.attributes;
        let corners: [_; 3] = each(
            #[inline(always)]
            |i| all[corners[i]],
        );
        let plane = S::Attribute::plane(corners, across)?;
        Some(Walked {
            plane,
            depth: *depth,
            depth_step: depth.to[0] * across[0] + depth.to[1] * across[1],
        })
    }

    #[inline(always)]
    #[allow(clippy::too_many_arguments)] // place, pixels, and what is drawn there
    fn walked_run<M: Lanes>(
        &self,
        m: M,
        place: (usize, usize),
        pixels: Range<usize>,
        polygon: (u32, u32),
        walked: &Walked<S>,
        weights: [f32; 2],
        cells: &mut Cells<'_, M, S::Pixel<M::F>>,
    ) {
        let attribute = S::Attribute::on_row(&walked.plane, weights);
        let depth = [walked.depth.one(weights), walked.depth_step];
        self.run(m, place, pixels, polygon, depth, attribute, cells);
    }

    #[inline(always)]
    fn walk<M: Lanes>(
        &self,
        m: M,
        number: u32,
        material: u32,
        start: &Span<f32, SpanIn<S>>,
    ) -> S::Walk<M> {
        S::walk(
            m,
            &self.setup.consts[material as usize],
            &self.setup.polygons[number as usize],
            start,
        )
    }

    /// Draws a run of pixels of polygon (number, material) on a row of the band that begins with row `top`; `depth` is that at
    /// its first pixel and its growth.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)] // place, pixels, and what is drawn there
    pub fn run<M: Lanes>(
        &self,
        m: M,
        (top, row): (usize, usize),
        pixels: Range<usize>,
        (number, material): (u32, u32),
        depth: [f32; 2],
        attribute: SpanIn<S>,
        cells: &mut Cells<'_, M, S::Pixel<M::F>>,
    ) {
        // Groups begin at certain pixels, before the run: so does the walk where it can.
        let (first, before) = (pixels.start / M::WIDTH, pixels.start % M::WIDTH);
        let is_one = pixels.len() == 1;
        let earlier = S::Attribute::earlier(&attribute, before as f32, is_one);
        let (x, attribute) = match earlier {
            Some(attribute) => (first * M::WIDTH, attribute),
            None => (pixels.start, attribute),
        };
        let start = Span {
            x: x as f32 + 0.5,
            y: (top + row) as f32 + 0.5,
            attribute,
        };
        let mut walk = self.walk(m, number, material, &start);
        let mut later = Later::new(before);
        let step = if is_one { 0.0 } else { depth[1] };
        let (mut z, stride) = (
            m.ramp(depth[0] - before as f32 * step, step),
            m.stride(step),
        );
        let mut group = first;
        cells.each(
            row,
            first..pixels.end.div_ceil(M::WIDTH),
            #[inline(always)]
            |cell| {
                let mut pixel = walk.next();
                if earlier.is_none() {
                    pixel = later.next(m, pixel);
                }
                cell.put(m, outside(m, group, &pixels), z, pixel, material);
                z = z + stride;
                group += 1;
            },
        );
    }
}

/// Groups of pixels that are given some pixels later than they come: of two that follow one another the last pixels of the
/// first and the first ones of the second make one.
struct Later {
    pixels: usize,
    /// Of each plane the group before and this one.
    line: [f32; MOST_PLANES * 2 * 8],
}

impl Later {
    /// By so many pixels, less than a group has.
    #[inline(always)]
    fn new(pixels: usize) -> Self {
        Later {
            pixels,
            line: [0.0; MOST_PLANES * 2 * 8],
        }
    }

    #[inline(always)]
    fn next<M: Lanes, P: Planes<M::F>>(&mut self, m: M, pixel: P) -> P {
        self.keep(m, pixel, M::WIDTH);
        let mut at = M::WIDTH - self.pixels;
        let given = get_each(
            #[inline(always)]
            || {
                at += 2 * M::WIDTH;
                m.load(&self.line[at - 2 * M::WIDTH..])
            },
        );
        self.keep(m, pixel, 0);
        given
    }

    /// Stores each plane, from `at` on: as the group before, or as this one.
    #[inline(always)]
    fn keep<M: Lanes, P: Planes<M::F>>(&mut self, m: M, pixel: P, mut at: usize) {
        put_each(
            pixel,
            #[inline(always)]
            |x| {
                m.store(x, &mut self.line[at..]);
                at += 2 * M::WIDTH;
            },
        );
    }
}

/// A triangle whose pixels are given what a walk gives.
struct Walked<S: Shader> {
    plane: <S::Attribute<f32> as Attribute<f32>>::Plane,
    depth: Facet,
    depth_step: f32,
}

/// Below 0 at those pixels of group `group` that a run does not have.
#[inline(always)]
pub(super) fn outside<M: Lanes>(m: M, group: usize, pixels: &Range<usize>) -> M::I {
    let (first, k) = ((group * M::WIDTH) as i32, m.counted());
    (k - m.int(pixels.start as i32 - first)) | (m.int(pixels.end as i32 - 1 - first) - k)
}
