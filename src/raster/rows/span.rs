//! Runs of pixels into a row: what a walk gives is written into the planes wherever it is nearer than what was drawn before.

use super::band::Row;
use super::cover::{Covered, Run};
use crate::frame::Frame;
use crate::number::{Lanes, Planes, Scalar};
use crate::raster::setup::SetUp;
use crate::shader::{Shader, Span};
use crate::walk::{Attribute, Walk};
use alloc::vec::Vec;

/// The span of a shader's attribute in plain numbers.
pub(super) type SpanIn<S> = <<S as Shader>::Attribute<f32> as Attribute<f32>>::Span;

type PlaneOf<S> = <<S as Shader>::Attribute<f32> as Attribute<f32>>::Plane;

/// What the runs of a band belong to.
pub(super) struct Sources<S: Shader> {
    triangles: Vec<Triangle<S>>,
    /// Runs of other polygons: polygon and material, depth at the first pixel and its growth, attribute.
    pub spans: Vec<([u32; 2], [f32; 2], SpanIn<S>)>,
}

/// A triangle over which depth and attribute are linear.
struct Triangle<S: Shader> {
    /// Its number, and its material: not to be looked up, run by run, where it is far.
    polygon: [u32; 2],
    depth: f32,
    depth_to: [f32; 2],
    depth_step: f32,
    plane: PlaneOf<S>,
}

impl<S: Shader> Default for Sources<S> {
    fn default() -> Self {
        Sources { triangles: Vec::new(), spans: Vec::new() }
    }
}

impl<S: Shader> Sources<S> {
    /// Adds triangles, whose attributes are linear.
    pub fn add(&mut self, frame: &Frame, setup: &SetUp<S, Scalar>, triangles: &[Covered]) {
        let vertices = frame.vertices();
        self.triangles.reserve(triangles.len());
        for triangle in triangles {
            let corners = triangle.corners.map(|v| v as usize);
            let [b, c] = triangle.across;
            let Some(plane) = S::Attribute::plane(corners.map(|v| setup.attributes[v]), [b, c]) else { continue };
            let [depth, to_b, to_c] = corners.map(|v| vertices[v].depth);
            let depth_to = [to_b - depth, to_c - depth];
            let depth_step = depth_to[0] * b + depth_to[1] * c;
            let polygon = [triangle.number, triangle.material];
            self.triangles.push(Triangle { polygon, depth, depth_to, depth_step, plane });
        }
    }
}

/// What draws the runs of a scanline.
pub(super) struct Painter<'a, S: Shader> {
    pub setup: &'a SetUp<S, Scalar>,
    pub sources: &'a Sources<S>,
    /// Whether nearer polygons hide farther ones.
    pub hides: bool,
    /// Whether each pixel's material is noted, in a plane after the shader's.
    pub notes_material: bool,
}

impl<S: Shader> Painter<'_, S> {
    /// Draws the runs of scanline `y`.
    #[inline(always)]
    pub fn runs<M: Lanes>(&self, m: M, y: usize, runs: &[Run], row: &mut Row) {
        for run in runs {
            let (polygon, depth, attribute) = if run.source & Run::SPAN == 0 {
                let triangle = &self.sources.triangles[run.source as usize];
                let [b, c] = run.weights;
                let depth = triangle.depth + b * triangle.depth_to[0] + c * triangle.depth_to[1];
                let attribute = S::Attribute::on_row(&triangle.plane, run.weights);
                (triangle.polygon, [depth, triangle.depth_step], attribute)
            } else {
                self.sources.spans[(run.source ^ Run::SPAN) as usize]
            };
            self.run(m, y, (run, polygon), depth, attribute, row);
        }
    }

    /// Draws one run; `depth` is that at its first pixel and its growth.
    #[inline(always)]
    fn run<M: Lanes>(
        &self,
        m: M,
        y: usize,
        (run, [number, material]): (&Run, [u32; 2]),
        depth: [f32; 2],
        attribute: SpanIn<S>,
        row: &mut Row,
    ) {
        let (consts, polygon) = (&self.setup.consts[material as usize], &self.setup.polygons[number as usize]);
        let start = Span { x: f32::from(run.start) + 0.5, y: y as f32 + 0.5, attribute };
        let mut walk = S::walk(m, consts, polygon, &start);
        let (mut z, step) = (m.ramp(depth[0], depth[1]), m.stride(depth[1]));
        let (mut x, end) = (usize::from(run.start), usize::from(run.end));
        row.note(x, end);
        while x < end {
            let pixel = walk.next();
            let mut mask = m.first_lanes(end - x);
            if self.hides {
                mask = m.and(mask, m.less(z, m.load(row.depth(x))));
            }
            // Written anyway: which groups are seen, and which of them wholly, cannot be predicted where runs are short.
            row.put(m, x, mask, z, pixel);
            if self.notes_material {
                row.put_material(m, x, mask, material);
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

/// With more planes than this a row is no longer near.
const MOST_PLANES: usize = 16;
