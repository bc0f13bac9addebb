//! Polygons into a band: what a walk gives is written wherever it is nearer than what was drawn before.

use super::band::{Band, MOST_PLANES};
use super::batch::{Batch, Small};
use super::triangle::{Groups, Triangle};
use crate::frame::Frame;
use crate::number::{Lanes, Num, Planes, Scalar, get_each, put_each};
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

/// A number over a triangle: at its first corner, and how far the other two are from it.
///
/// ```text
/// A = A_a + β (A_b − A_a) + γ (A_c − A_a)
/// ```
/// β and γ come from exact integers and are in 0..=1 inside, so that nothing cancels, however thin the triangle is.
#[derive(Clone, Copy, Debug, Default)]
struct Facet {
    at: f32,
    to: [f32; 2],
}

impl Facet {
    /// From its values at the corners.
    #[inline(always)]
    fn new([a, b, c]: [f32; 3]) -> Facet {
        Facet { at: a, to: [b - a, c - a] }
    }

    /// At a group of pixels with these coordinates.
    #[inline(always)]
    fn lanes<M: Lanes>(&self, m: M, [b, c]: [M::F; 2]) -> M::F {
        m.splat(self.to[1]).mul_add(c, m.splat(self.to[0]).mul_add(b, m.splat(self.at)))
    }

    /// At one pixel.
    #[inline(always)]
    fn one(&self, [b, c]: [f32; 2]) -> f32 {
        self.at + b * self.to[0] + c * self.to[1]
    }
}

/// What draws polygons into a band.
pub(super) struct Painter<'a, S: Shader> {
    pub frame: &'a Frame,
    pub setup: &'a SetUp<S, Scalar>,
    /// Whether nearer polygons hide farther ones.
    pub hides: bool,
}

impl<S: Shader> Painter<'_, S> {
    /// Draws what a batch of triangles covers of the band that begins with row `top`; depth and attribute are linear over them.
    #[inline(always)]
    pub fn batch<M: Lanes>(&self, m: M, batch: &Batch, top: usize, band: &mut Band) {
        let mut places = Batch::PLACES;
        let count = batch.drawn(&mut places);
        for &k in &places[..count] {
            let k = usize::from(k);
            if batch.is_small(k) {
                self.small(m, (batch.polygon(k), batch.corners(k)), &batch.small(k), top, band);
            } else if let Some(triangle) = batch.large(k) {
                self.large(m, batch.polygon(k), &triangle, top, band);
            }
        }
    }

    #[inline(always)]
    fn small<M: Lanes>(
        &self,
        m: M,
        (polygon, corners): ((u32, u32), [usize; 3]),
        small: &Small<'_>,
        top: usize,
        band: &mut Band,
    ) {
        let depth = self.depth(corners);
        if S::GIVEN == Given::Walked {
            let Some(walked) = self.walked(corners, &depth, small.growth()) else { return };
            return small.runs(
                m,
                top,
                #[inline(always)]
                |row, pixels, weights| self.walked_run(m, (top, row), pixels, polygon, &walked, weights, band),
            );
        }
        let flat = self.flat(m, corners, polygon);
        let mut groups = Groups::new(m, small);
        let [first, end] = groups.groups;
        let mut cells = band.cells::<M, S::Pixel<M::F>>(m, first..end, self.hides);
        for row in small.rows(top) {
            let mut here = groups.next_row();
            cells.each(
                row,
                #[inline(always)]
                |cell| {
                    let inside = Groups::inside(m, here);
                    // Whether a group has any pixel of a wide triangle is like the row before, of a narrow one it is not.
                    if end - first == 1 || m.any(inside) {
                        let weights = groups.weights(m, here);
                        cell.put(m, inside, depth.lanes(m, weights), flat.at(m, weights), polygon.1);
                    }
                    here = groups.beside(here);
                },
            );
        }
    }

    #[inline(always)]
    fn large<M: Lanes>(&self, m: M, polygon: (u32, u32), triangle: &Triangle, top: usize, band: &mut Band) {
        let depth = self.depth(triangle.corners);
        let across = triangle.across();
        if S::GIVEN == Given::Walked {
            let Some(walked) = self.walked(triangle.corners, &depth, across) else { return };
            return triangle.runs(
                top,
                #[inline(always)]
                |row, pixels, weights| self.walked_run(m, (top, row), pixels, polygon, &walked, weights, band),
            );
        }
        let flat = self.flat(m, triangle.corners, polygon);
        let across = [m.splat(across[0]), m.splat(across[1])];
        triangle.runs(
            top,
            #[inline(always)]
            |row, pixels, weights| {
                let mut group = pixels.start / M::WIDTH;
                // Columns from the first pixel on, which is exact; before it, nothing is drawn.
                let (mut k, next) = (m.ramp(-((pixels.start % M::WIDTH) as f32), 1.0), m.stride(1.0));
                let mut cells = band.cells::<M, S::Pixel<M::F>>(m, group..pixels.end.div_ceil(M::WIDTH), self.hides);
                cells.each(
                    row,
                    #[inline(always)]
                    |cell| {
                        let weights =
                            [across[0].mul_add(k, m.splat(weights[0])), across[1].mul_add(k, m.splat(weights[1]))];
                        let inside = lanes(m, group, &pixels);
                        cell.put(m, inside, depth.lanes(m, weights), flat.at(m, weights), polygon.1);
                        k = k + next;
                        group += 1;
                    },
                );
            },
        );
    }

    #[inline(always)]
    fn depth(&self, [a, b, c]: [usize; 3]) -> Facet {
        let vertices = self.frame.vertices();
        Facet::new([vertices[a].depth, vertices[b].depth, vertices[c].depth])
    }

    #[inline(always)]
    fn attributes(&self, [a, b, c]: [usize; 3]) -> [S::Attribute<f32>; 3] {
        let all = &self.setup.attributes;
        [all[a], all[b], all[c]]
    }

    /// What pixels are given where it is no walk that gives it.
    #[inline(always)]
    fn flat<M: Lanes>(&self, m: M, corners: [usize; 3], (number, material): (u32, u32)) -> Flat<S, M> {
        let attributes = self.attributes(corners);
        if S::GIVEN == Given::Attribute {
            return Flat::Interpolated(facets::<S>(attributes));
        }
        match S::Attribute::plane(attributes, [0.0; 2]) {
            Some(plane) => {
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
        band: &mut Band,
    ) {
        let attribute = S::Attribute::on_row(&walked.plane, weights);
        let depth = [walked.depth.one(weights), walked.depth_step];
        self.run(m, place, pixels, polygon, depth, attribute, band);
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
        band: &mut Band,
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
        let mut cells = band.cells::<M, S::Pixel<M::F>>(m, first..pixels.end.div_ceil(M::WIDTH), self.hides);
        cells.each(
            row,
            #[inline(always)]
            |cell| {
                let mut pixel = walk.next();
                if earlier.is_none() {
                    pixel = later.next(m, pixel);
                }
                cell.put(m, lanes(m, group, &pixels), z, pixel, material);
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
        let mut at = M::WIDTH;
        put_each(
            pixel,
            #[inline(always)]
            |x| {
                m.store(x, &mut self.line[at..]);
                at += 2 * M::WIDTH;
            },
        );
        at = M::WIDTH - self.pixels;
        let given = get_each(
            #[inline(always)]
            || {
                at += 2 * M::WIDTH;
                m.load(&self.line[at - 2 * M::WIDTH..])
            },
        );
        at = 0;
        put_each(
            pixel,
            #[inline(always)]
            |x| {
                m.store(x, &mut self.line[at..]);
                at += 2 * M::WIDTH;
            },
        );
        given
    }
}

/// What the pixels of a triangle are given.
enum Flat<S: Shader, M: Lanes> {
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

/// The facets of an attribute's numbers; the rest is not looked at.
#[inline(always)]
fn facets<S: Shader>([a, b, c]: [S::Attribute<f32>; 3]) -> [Facet; MOST_PLANES] {
    let mut facets = [Facet::default(); MOST_PLANES];
    let mut i = 0;
    each_number::<S>(
        a,
        #[inline(always)]
        |x| {
            facets[i].at = x;
            i += 1;
        },
    );
    let mut corner = 0;
    while corner < 2 {
        let mut i = 0;
        each_number::<S>(
            if corner == 0 { b } else { c },
            #[inline(always)]
            |x| {
                facets[i].to[corner] = x - facets[i].at;
                i += 1;
            },
        );
        corner += 1;
    }
    facets
}

/// Gives the numbers of an attribute, to what must be inlined.
#[inline(always)]
fn each_number<S: Shader>(attribute: S::Attribute<f32>, mut to: impl FnMut(f32)) {
    attribute.numbers(&mut to);
}

/// Which pixels of group `group` a run has.
#[inline(always)]
fn lanes<M: Lanes>(m: M, group: usize, pixels: &Range<usize>) -> M::Mask {
    let first = group * M::WIDTH;
    m.lanes(pixels.start.saturating_sub(first), pixels.end - first)
}
