//! Polygons into a band: what a walk gives is written wherever it is nearer than what was drawn before.

use super::band::{Cells, MOST_PLANES};
use super::batch::{Batch, Kind, Numbers, each_bit};
use super::facets::Facets;
use super::small::SmallTriangle;
use super::tiny::Fragments;
use super::triangle::{Starts, Triangle};
use crate::frame::Frame;
use crate::number::{Lanes, Num, Planes, Scalar, each, get_each, put_each};
use crate::raster::setup::SetUp;
use crate::shader::{Given, Shader, Span};
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

/// A number over one triangle: see [`Facets`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Facet {
    at: f32,
    to: [f32; 2],
}

impl Facet {
    /// That of number `number` over triangle `k`.
    #[inline(always)]
    pub fn of(facets: &Facets, number: usize, k: usize) -> Facet {
        let [at, to @ ..] = facets.number(number, k);
        Facet { at, to }
    }

    /// At a group of pixels with these coordinates.
    #[inline(always)]
    pub fn lanes<M: Lanes>(&self, m: M, [b, c]: [M::F; 2]) -> M::F {
        m.splat(self.to[1]).mul_add(c, m.splat(self.to[0]).mul_add(b, m.splat(self.at)))
    }

    /// At one pixel.
    #[inline(always)]
    fn one(&self, [b, c]: [f32; 2]) -> f32 {
        self.at + b * self.to[0] + c * self.to[1]
    }
}

/// How many facets triangles have: that of depth, and those of the attribute where it is what pixels are given.
pub(super) const fn facets<S: Shader, M: Lanes>() -> usize {
    match (S::GIVEN, planes::<S, M>()) {
        (Given::Attribute, Some(count)) => 1 + count,
        _ => 1,
    }
}

/// What draws polygons into a band.
pub(super) struct Painter<'a, S: Shader> {
    pub frame: &'a Frame,
    pub setup: &'a SetUp<S, Scalar>,
    /// Where the numbers that the pixels of triangles are given come from, where no walk gives them.
    pub numbers: Numbers<'a, S::Attribute<f32>>,
    /// Whether nearer polygons hide farther ones.
    pub hides: bool,
    /// Whether pixels have different materials.
    pub has_materials: bool,
}

impl<S: Shader> Painter<'_, S> {
    /// Draws those triangles of a batch whose bits `drawn` has on the band that begins with row `top`, in order; depth and attribute
    /// are linear over them. `fragments` are the pixels of its tiny ones.
    #[inline(always)]
    pub fn batch<M: Lanes>(
        &self,
        m: M,
        (batch, drawn): (&Batch, u32),
        (fragments, starts): (&Fragments, &mut Starts),
        top: usize,
        cells: &mut Cells<'_, M, S::Pixel<M::F>>,
    ) {
        let others = batch.others();
        each_bit(
            drawn,
            #[inline(always)]
            |k| {
                if S::GIVEN == Given::Attribute && others >> k & 1 == 0 {
                    let material = batch.material(k);
                    fragments.each(
                        m,
                        (batch, facets::<S, M>()),
                        k,
                        #[inline(always)]
                        |place, numbers| cells.put_one(place, numbers, material),
                    );
                } else if batch.kind(k) == Kind::Small as i32 {
                    self.small(m, (batch, k), starts, top, cells);
                } else if let Some(triangle) = batch.large(k) {
                    self.large(m, batch, k, &triangle, top, cells);
                }
            },
        );
    }

    #[inline(always)]
    fn small<M: Lanes>(
        &self,
        m: M,
        (batch, k): (&Batch, usize),
        starts: &mut Starts,
        top: usize,
        cells: &mut Cells<'_, M, S::Pixel<M::F>>,
    ) {
        if S::GIVEN == Given::Walked {
            let (small, polygon) = (batch.small(k), batch.polygon(k));
            let depth = Facet::of(&batch.facets, 0, k);
            let Some(walked) = self.walked(batch.corners(k), &depth, small.growth()) else { return };
            return small.runs(
                m,
                top,
                #[inline(always)]
                |row, pixels, weights| self.walked_run(m, (top, row), pixels, polygon, &walked, weights, cells),
            );
        }
        let (flat, material) = (self.flat(m, batch, k), batch.polygon(k).1);
        let triangle = SmallTriangle::<S, M>::new(m, batch.small(k), (&batch.facets, k), &flat, material);
        if self.has_materials {
            triangle.draw::<true>(m, starts, top, cells);
        } else {
            triangle.draw::<false>(m, starts, top, cells);
        }
    }

    #[inline(always)]
    fn large<M: Lanes>(
        &self,
        m: M,
        batch: &Batch,
        k: usize,
        triangle: &Triangle,
        top: usize,
        cells: &mut Cells<'_, M, S::Pixel<M::F>>,
    ) {
        let polygon = batch.polygon(k);
        let depth = Facet::of(&batch.facets, 0, k);
        let across = triangle.across();
        if S::GIVEN == Given::Walked {
            let Some(walked) = self.walked(batch.corners(k), &depth, across) else { return };
            return triangle.runs(
                top,
                #[inline(always)]
                |row, pixels, weights| self.walked_run(m, (top, row), pixels, polygon, &walked, weights, cells),
            );
        }
        let flat = self.flat(m, batch, k);
        let across = [m.splat(across[0]), m.splat(across[1])];
        triangle.runs(
            top,
            #[inline(always)]
            |row, pixels, weights| {
                let mut group = pixels.start / M::WIDTH;
                // Columns from the first pixel on, which is exact; before it, nothing is drawn.
                let (mut k, next) = (m.ramp(-((pixels.start % M::WIDTH) as f32), 1.0), m.stride(1.0));
                cells.each(
                    row,
                    group..pixels.end.div_ceil(M::WIDTH),
                    #[inline(always)]
                    |cell| {
                        let weights =
                            [across[0].mul_add(k, m.splat(weights[0])), across[1].mul_add(k, m.splat(weights[1]))];
                        cell.put(
                            m,
                            outside(m, group, &pixels),
                            depth.lanes(m, weights),
                            flat.at(m, weights),
                            polygon.1,
                        );
                        k = k + next;
                        group += 1;
                    },
                );
            },
        );
    }

    #[inline(always)]
    fn attributes(&self, corners: [usize; 3]) -> [S::Attribute<f32>; 3] {
        let all = &self.setup.attributes;
        each(
            #[inline(always)]
            |i| all[corners[i]],
        )
    }

    /// What the pixels of triangle `k` are given where it is no walk that gives it.
    #[inline(always)]
    fn flat<M: Lanes>(&self, m: M, batch: &Batch, k: usize) -> Flat<S, M> {
        if S::GIVEN == Given::Attribute {
            let mut flat = [Facet::default(); MOST_PLANES];
            let mut i = 1;
            while i < facets::<S, M>() {
                flat[i - 1] = Facet::of(&batch.facets, i, k);
                i += 1;
            }
            return Flat::Interpolated(flat);
        }
        match S::Attribute::plane(self.attributes(batch.corners(k)), [0.0; 2]) {
            Some(plane) => {
                let (number, material) = batch.polygon(k);
                let start = Span { x: 0.5, y: 0.5, attribute: S::Attribute::on_row(&plane, [0.0; 2]) };
                Flat::Constant(self.walk(m, number, material, &start).next())
            }
            None => unreachable!("asked for triangles over which the attribute is linear"),
        }
    }

    #[inline(always)]
    fn walked(&self, corners: [usize; 3], depth: &Facet, across: [f32; 2]) -> Option<Walked<S>> {
        let plane = S::Attribute::plane(self.attributes(corners), across)?;
        Some(Walked { plane, depth: *depth, depth_step: depth.to[0] * across[0] + depth.to[1] * across[1] })
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
    fn walk<M: Lanes>(&self, m: M, number: u32, material: u32, start: &Span<f32, SpanIn<S>>) -> S::Walk<M> {
        S::walk(m, &self.setup.consts[material as usize], &self.setup.polygons[number as usize], start)
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
        let start = Span { x: x as f32 + 0.5, y: (top + row) as f32 + 0.5, attribute };
        let mut walk = self.walk(m, number, material, &start);
        let mut later = Later::new(before);
        let step = if is_one { 0.0 } else { depth[1] };
        let (mut z, stride) = (m.ramp(depth[0] - before as f32 * step, step), m.stride(step));
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
        Later { pixels, line: [0.0; MOST_PLANES * 2 * 8] }
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

/// What the pixels of a triangle are given.
pub(super) enum Flat<S: Shader, M: Lanes> {
    /// The attribute's numbers.
    Interpolated([Facet; MOST_PLANES]),
    /// The same everywhere.
    Constant(S::Pixel<M::F>),
}

impl<S: Shader, M: Lanes> Flat<S, M> {
    #[inline(always)]
    fn at(&self, m: M, weights: [M::F; 2]) -> S::Pixel<M::F> {
        match self {
            Flat::Interpolated(facets) => {
                let mut i = 0;
                get_each(
                    #[inline(always)]
                    || {
                        i += 1;
                        facets[i - 1].lanes(m, weights)
                    },
                )
            }
            Flat::Constant(pixel) => *pixel,
        }
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
fn outside<M: Lanes>(m: M, group: usize, pixels: &Range<usize>) -> M::I {
    let (first, k) = ((group * M::WIDTH) as i32, m.counted());
    (k - m.int(pixels.start as i32 - first)) | (m.int(pixels.end as i32 - 1 - first) - k)
}
