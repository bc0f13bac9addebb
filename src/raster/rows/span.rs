//! Runs of pixels into a band: what a walk gives is written into the planes wherever it is nearer than what was drawn before.

use super::band::Band;
use super::cover::Batch;
use crate::frame::Frame;
use crate::number::{Lanes, Planes, Scalar};
use crate::raster::setup::SetUp;
use crate::shader::{Shader, Span};
use crate::walk::{Attribute, Walk};
use alloc::vec::Vec;
use core::ops::Range;

/// What draws runs into one band.
pub(super) struct Painter<'a, 'b, S: Shader, M: Lanes> {
    pub m: M,
    pub frame: &'a Frame,
    pub setup: &'a SetUp<S, Scalar>,
    pub band: &'b mut Band,
    /// The scanlines of the band.
    pub rows: Range<usize>,
    /// Whether nearer polygons hide farther ones.
    pub hides: bool,
    /// Whether each pixel's material is noted, in a plane after the shader's.
    pub notes_material: bool,
    /// Attributes and depths at the corners of a batch of triangles.
    pub fetched: Vec<([S::Attribute<f32>; 3], [f32; 3])>,
}

/// The span of a shader's attribute in plain numbers.
pub(super) type SpanIn<S> = <<S as Shader>::Attribute<f32> as Attribute<f32>>::Span;

impl<S: Shader, M: Lanes> Painter<'_, '_, S, M> {
    /// Draws the triangles of a batch, whose attributes are linear over each of them.
    #[inline(never)]
    pub fn triangles(&mut self, batch: &Batch) {
        self.m.vectorize(
            #[inline(always)]
            || {
                let vertices = self.frame.vertices();
                // Read in a loop of its own, as the batch was.
                self.fetched.clear();
                self.fetched.extend(batch.triangles.iter().map(|triangle| {
                    let corners = triangle.corners.map(|v| v as usize);
                    (corners.map(|v| self.setup.attributes[v]), corners.map(|v| vertices[v].depth))
                }));
                let mut runs = batch.runs();
                for (i, triangle) in batch.triangles.iter().enumerate() {
                    let (own, rest) = runs.split_at(triangle.runs as usize);
                    runs = rest;
                    let (attributes, [z, zb, zc]) = self.fetched[i];
                    let Some(plane) = S::Attribute::plane(attributes, triangle.across) else { continue };
                    let (to_b, to_c) = (zb - z, zc - z);
                    let depth_step = to_b * triangle.across[0] + to_c * triangle.across[1];
                    for run in own {
                        let depth = z + to_b * run.weights[0] + to_c * run.weights[1];
                        let attribute = S::Attribute::on_row(&plane, run.weights);
                        let pixels = run.start as usize..run.end as usize;
                        self.put(triangle.number, run.row as usize, pixels, [depth, depth_step], attribute);
                    }
                }
            },
        );
    }

    /// Draws the run over `pixels` of scanline `row`; `depth` is that at its first pixel and its growth.
    #[inline(never)]
    pub fn run(&mut self, number: u32, row: usize, pixels: Range<usize>, depth: [f32; 2], attribute: SpanIn<S>) {
        self.m.vectorize(
            #[inline(always)]
            || self.put(number, row, pixels, depth, attribute),
        );
    }

    #[inline(always)]
    fn put(&mut self, number: u32, row: usize, pixels: Range<usize>, depth: [f32; 2], attribute: SpanIn<S>) {
        let m = self.m;
        let material = self.frame.polygons()[number as usize].material;
        let (consts, polygon) = (&self.setup.consts[material as usize], &self.setup.polygons[number as usize]);
        let start = Span { x: pixels.start as f32 + 0.5, y: row as f32 + 0.5, attribute };
        let mut walk = S::walk(m, consts, polygon, &start);
        let (mut z, step) = (m.ramp(depth[0], depth[1]), m.stride(depth[1]));
        let mut line = self.band.row(row - self.rows.start);
        line.note(pixels.start, pixels.end);
        let mut x = pixels.start;
        while x < pixels.end {
            let pixel = walk.next();
            let mut mask = m.first_lanes(pixels.end - x);
            if self.hides {
                mask = m.and(mask, m.less(z, m.load(line.depth(x))));
            }
            if m.all(mask) {
                line.put_all(m, x, z, pixel);
                if self.notes_material {
                    line.put_material(m, x, mask, material);
                }
            } else if m.any(mask) {
                line.put(m, x, mask, z, pixel);
                if self.notes_material {
                    line.put_material(m, x, mask, material);
                }
            }
            z = z + step;
            x += M::WIDTH;
        }
    }
}

/// How many planes a shader's pixels take; `None` where they cannot be stored as planes, or are too many.
pub(super) const fn planes<S: Shader, M: Lanes>() -> Option<usize> {
    match <S::Pixel<M::F> as Planes<M::F>>::COUNT {
        Some(count) if count <= MOST_PLANES => Some(count),
        _ => None,
    }
}

/// More planes than this and a band of four scanlines is no longer near.
const MOST_PLANES: usize = 16;
