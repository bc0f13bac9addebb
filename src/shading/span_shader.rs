//! Shading for your own rasterizer: a line of pixels from its two ends, by any method.

use super::kernels::gbuffer_cell::CellLayout;
use super::kernels::{RowColours, ShadeRow, SimdKernels, WalkKernel};
use super::light::Uniforms;
use super::{
    Corners, Extras, Kernels, Local, On, Pixels, PolygonConstants, Run, RunList, RunValues,
    SpanPlace, UniformsIndex, Variant, Vertices,
};
use crate::frame::{FrameError, guard};
use crate::number::{BLOCK, SimdLevel};
use crate::scene::{Interpolation, Lighting};
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

/// A vertex for [`SpanShader::vertex`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpanVertex {
    /// The normal, in the space of the lights' directions; for flat shading the polygon's own. A
    /// normal of another length than 1 is normalised. A normal without a direction is lit by
    /// ambient light only.
    pub normal: [f32; 3],
    /// The position, in the space of the positions of lights and eye; any value if there are none.
    pub position: [f32; 3],
    /// Four values of your own, for methods that read them:
    /// [`LightAt::attributes`](super::LightAt::attributes).
    pub attributes: [f32; 4],
    /// near/w, the weight of perspective; 1 without perspective.
    pub inv_w: f32,
}

impl SpanVertex {
    /// Makes a vertex with a unit normal, for lights at infinity and without perspective.
    pub fn of_normal(normal: [f32; 3]) -> Self {
        SpanVertex {
            normal,
            position: [0.0; 3],
            attributes: [1.0; 4],
            inv_w: 1.0,
        }
    }
}

/// The reason why a [`SpanShader`] could not be made.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SpanShaderError {
    /// The method refuses the material, with the reason: see [`Shader::on`](super::Shader::on).
    Refused(&'static str),
    /// There are too many lights, or a value is outside its range. The error names material 0.
    Lighting(FrameError),
}

impl fmt::Display for SpanShaderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SpanShaderError::Refused(reason) => {
                write!(f, "the method is not for this material: {reason}")
            }
            SpanShaderError::Lighting(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for SpanShaderError {}

/// A method on a material with its lights, for your own rasterizer, which does edges, pixels and
/// hidden surfaces itself.
///
/// [`SpanShader::vertex`] turns a vertex into a few values, its *varyings*: a colour for Gouraud
/// shading, the normal for naive Phong shading, products of the normal for fast Phong shading.
/// Interpolate them along edges as you interpolate depth, linearly. [`SpanShader::shade`] takes the
/// varyings at both ends of a line and writes the colours of its pixels.
/// `examples/own_rasterizer.rs` is a whole rasterizer.
///
/// A shader reuses its memory: [`SpanShader::vertex_into`], [`SpanShader::polygon`] and
/// [`SpanShader::shade`] allocate nothing once the longest line has been shaded. It is scalar, and
/// returns the same bits on every machine, until [`SpanShader::with_simd`] chooses an instruction
/// set.
///
/// It always runs the method that you name, even where whole frames are drawn by another one in its
/// place: `adaptive-phong` plans each polygon, however small.
///
/// ```
/// use fastphong::glam::DVec3;
/// use fastphong::mesh::Material;
/// use fastphong::picture::encoding::store_line;
/// use fastphong::scene::{Interpolation, Light, Lighting};
/// use fastphong::shading::{SpanShader, SpanVertex, methods};
///
/// let light = Light::directional(DVec3::Z, [1.0; 3]);
/// let lighting = Lighting::new(&Material::default(), [1.0; 3], &[light], DVec3::Z);
/// let variant = methods::PHONG_RSQRT.variant();
/// let mut shader = SpanShader::new(&variant, &lighting, Interpolation::Screen)?;
/// let ends = [[-0.6, 0.0, 0.8], [0.6, 0.0, 0.8]].map(|n| shader.vertex(SpanVertex::of_normal(n)));
///
/// // The line from column 10.25 to column 26.25 covers the centres of pixels 10 to 25.
/// let mut colours = [[0.0; 3]; 16];
/// shader.shade([(10.25, &ends[0]), (26.25, &ends[1])], [10, 0], &mut colours);
/// let mut bytes = [[0; 4]; 16];
/// store_line(&colours, None, &mut bytes);
/// assert!(bytes[8][0] > bytes[0][0], "the highlight is in the middle");
/// # Ok::<(), fastphong::shading::SpanShaderError>(())
/// ```
#[derive(Clone, Debug)]
pub struct SpanShader {
    variant: Variant,
    kernels: &'static Kernels,
    extras: Extras,
    is_weighted: bool,
    /// How many values a vertex has: the method's, then position and weight.
    varyings: usize,
    /// The light as seen from anywhere, and as seen from the current polygon.
    uniforms: [Uniforms; 2],
    constants: PolygonConstants,
    /// True until a polygon is set up, if the method needs one.
    wants_polygon: bool,
    is_by_polygon: bool,
    list: RunList,
    simd: Option<SimdSpans>,
}

/// The pixel loops of an instruction set, and the memory for a line.
#[derive(Clone, Debug)]
struct SimdSpans {
    level: SimdLevel,
    kernels: &'static SimdKernels,
    /// True if the method remembers the pixel before: its walk then runs first.
    is_walked: bool,
    cell: CellLayout,
    /// The pixels of the walk, and the extras: all first values, then all second ones, and so on.
    walked: Vec<f32>,
    /// The line in the layout of a row of the G-buffer.
    cells: Vec<f32>,
    channels: [Vec<f32>; 3],
}

/// How many pixels a kernel takes at a time, at most.
const STEP: usize = 2 * BLOCK;

impl SpanShader {
    /// Prepares a method for a material with its lights. You interpolate the varyings linearly on
    /// the screen; in perspective they are already multiplied by the weight of their vertex.
    ///
    /// Directions of any length become unit vectors.
    ///
    /// # Errors
    /// [`SpanShaderError`] if the method refuses the material, as integer methods refuse lights at
    /// positions; if there are too many lights; or if a value of the material or its lights is
    /// outside its range.
    pub fn new(
        variant: &Variant,
        lighting: &Lighting,
        interpolation: Interpolation,
    ) -> Result<Self, SpanShaderError> {
        let lighting = &guard::lit(lighting, 0).map_err(SpanShaderError::Lighting)?;
        if let Some(reason) = variant.row().refuses(On::Spans(lighting, interpolation)) {
            return Err(SpanShaderError::Refused(reason));
        }
        let (row, lights) = (variant.row(), lighting.lights.len());
        let (is_local, is_perspective) = (
            lighting.is_local(),
            interpolation == Interpolation::Perspective,
        );
        let kernels = row.kernels(lights, is_local);
        let extras = row.extras(is_local, is_perspective, lighting.vertex_colours);
        let [own, _, constants] = (kernels.counts)(lights);
        let uniforms = variant.uniforms(lighting, 1.0);
        let is_by_polygon = is_local && row.needs.local == Local::PerPolygon;
        Ok(SpanShader {
            is_weighted: is_perspective && row.needs.perspective.is_weighted(),
            varyings: own + extras.count(),
            uniforms: [uniforms.clone(), uniforms],
            constants: PolygonConstants {
                kinds: vec![0],
                values: vec![0.0; constants],
            },
            wants_polygon: constants > 0 || !kernels.kinds.is_empty() || is_by_polygon,
            is_by_polygon,
            list: RunList::new(own + extras.count()),
            variant: variant.clone(),
            kernels,
            extras,
            simd: None,
        })
    }

    /// Chooses an instruction set for pixels, which are then shaded up to 16 at a time. Use
    /// [`SimdLevel::best`] for long lines. The shader stays scalar if the machine lacks that set or
    /// the method has no loops for it; [`SpanShader::level`] returns the choice.
    ///
    /// Colours then come from the row engine's loops, and differ from scalar ones by roundings,
    /// because varyings are computed at each pixel where scalar code adds their growth from pixel
    /// to pixel. Both are within [`Variant::bound`] of the closed form, so they differ by at most
    /// twice the bound.
    pub fn with_simd(mut self, level: SimdLevel) -> Self {
        let model = &self.uniforms[0].model;
        let is_scalar = !level.is_available() || self.variant.row().scalar_only().is_some();
        let kernels = (self.kernels.simd)(level).filter(|_| !is_scalar);
        let is_walked = (self.kernels.walks_along_runs)(self.variant.parameters(), model);
        let [_, pixel, _] = (self.kernels.counts)(self.uniforms[0].lights.len());
        let extras = self.extras.count();
        let varyings = if is_walked {
            pixel
        } else {
            self.varyings - extras
        };
        self.simd = kernels.map(|kernels| SimdSpans {
            level,
            kernels,
            is_walked,
            cell: CellLayout {
                varyings,
                extras,
                has_uniforms: false,
            },
            walked: Vec::new(),
            cells: Vec::new(),
            channels: Default::default(),
        });
        self
    }

    /// Returns the instruction set that shades pixels: [`SimdLevel::Scalar`] unless
    /// [`SpanShader::with_simd`] chose another.
    pub fn level(&self) -> SimdLevel {
        self.simd
            .as_ref()
            .map_or(SimdLevel::Scalar, |simd| simd.level)
    }

    /// Returns how many varyings a vertex has.
    pub fn varyings(&self) -> usize {
        self.varyings
    }

    /// True if you must call [`SpanShader::polygon`] for each polygon before its vertices. Slerp
    /// methods, `six-point` and `adaptive-phong` need it; so do methods that light a polygon from
    /// its mean, if a light or the eye has a position.
    pub fn wants_polygons(&self) -> bool {
        self.is_by_polygon || !self.constants.values.is_empty() || !self.kernels.kinds.is_empty()
    }

    /// Sets up a polygon for methods that need it; does nothing for other methods.
    pub fn polygon(&mut self, corners: &Corners<'_, f32>) {
        if self.is_by_polygon {
            let mut mean = [0.0; 3];
            for corner in corners.all {
                for (mean, c) in mean.iter_mut().zip(corner.position.array()) {
                    *mean += c / corners.all.len() as f32;
                }
            }
            let [anywhere, seen] = &mut self.uniforms;
            *seen = anywhere.seen_from_in(mean, core::mem::take(&mut seen.lights));
        }
        let (parameters, values) = (self.variant.parameters(), &mut self.constants.values);
        let kind = (self.kernels.polygon)(parameters, &self.uniforms[1], corners, values);
        self.constants.kinds[0] = kind;
        self.wants_polygon = false;
    }

    /// Returns the varyings of a vertex. Methods that are lit at vertices light it here.
    pub fn vertex(&self, vertex: SpanVertex) -> Vec<f32> {
        let mut to = vec![0.0; self.varyings];
        self.vertex_into(vertex, &mut to);
        to
    }

    /// Writes the varyings of a vertex to `to`, as [`SpanShader::vertex`] returns them.
    ///
    /// # Panics
    /// If `to` has not as many places as [`SpanShader::varyings`] returns.
    pub fn vertex_into(&self, vertex: SpanVertex, to: &mut [f32]) {
        assert_eq!(to.len(), self.varyings, "one place for each varying");
        let normal = if vertex.normal.iter().all(|n| n.is_finite()) {
            guard::unit(vertex.normal)
        } else {
            [0.0; 3]
        };
        let own = self.varyings - self.extras.count();
        let job = Vertices {
            uniforms: &self.uniforms[1],
            normals: &[normal],
            points: &[vertex.position],
            attributes: &[vertex.attributes],
        };
        (self.kernels.vertices)(&job, &mut to[..own]);
        let [r, g, b, _] = vertex.attributes;
        self.extras
            .write(&mut to[own..], vertex.position, [r, g, b]);
        if self.is_weighted {
            to.iter_mut().for_each(|value| *value *= vertex.inv_w);
        }
    }

    /// Shades pixels of a line, from column `first` of scanline `row` on: linear and not clamped.
    ///
    /// `ends` are the columns where the line's edges cross the centre of its scanline, in pixels,
    /// and the varyings there. Pixel `i` has its centre at column i + ½. To shade only the visible
    /// part of a line, pass the ends of the whole line and the visible pixels.
    ///
    /// # Panics
    /// If an end has not as many varyings as [`SpanShader::varyings`] returns, or if a polygon is
    /// needed and was not set up.
    pub fn shade(
        &mut self,
        ends: [(f32, &[f32]); 2],
        [first, row]: [u32; 2],
        colours: &mut [[f32; 3]],
    ) {
        assert!(
            !self.wants_polygon,
            "`{}` sets up each polygon: call `SpanShader::polygon` before its vertices",
            self.variant
        );
        let [(x1, left), (x2, right)] = ends;
        assert!(
            left.len() == self.varyings && right.len() == self.varyings,
            "an end has {} varyings",
            self.varyings
        );
        if colours.is_empty() {
            return;
        }
        // Sums of columns must not overflow. An `f32` does not tell so large ones apart.
        let pixels = colours.len() as u32;
        let first = first.min((u32::MAX - STEP as u32).saturating_sub(pixels));
        // A line without width has the varyings of its left end.
        let dt = if x2 > x1 { 1.0 / (x2 - x1) } else { 0.0 };
        // The parameter at the centre of the first pixel.
        let t0 = (first as f32 + 0.5 - x1) * dt;
        self.list.clear();
        // Returns the first column whose centre is not left of `x`. The requested pixels lie
        // between both ends.
        let centre = |x: f32| libm::ceilf(x - 0.5).max(0.0) as u32;
        let (last, start) = (first + pixels, centre(x1).min(first));
        let run = Run {
            uniforms: UniformsIndex(0),
            polygon: 0,
            x: first,
            pixels,
            to: 0,
        };
        let place = SpanPlace {
            y: row,
            t0,
            dt,
            start,
            pixels: centre(x2).max(last) - start,
        };
        self.list.add(self.kernels.needs, run, [left, right], place);
        let job = Pixels {
            parameters: self.variant.parameters(),
            uniforms: core::slice::from_ref(&self.uniforms[1]),
            extras: self.extras,
            constants: &self.constants,
            list: &self.list,
        };
        match &mut self.simd {
            Some(simd) => simd.shade(&job, colours),
            None => (self.kernels.pixels)(&job, colours),
        }
    }
}

impl SimdSpans {
    /// Shades the only run of `job`, as a row of the G-buffer.
    fn shade(&mut self, job: &Pixels<'_>, colours: &mut [[f32; 3]]) {
        let length = colours.len().next_multiple_of(STEP);
        // Depths stay 0, which counts as drawn.
        self.cells.resize(length * self.cell.count(), 0.0);
        match self.kernels.walk.filter(|_| self.is_walked) {
            Some(walk) => self.walk(walk, job, colours.len().next_multiple_of(BLOCK)),
            None => self.interpolate(job.list.starts.of(0)),
        }
        let row = ShadeRow {
            parameters: job.parameters,
            uniforms: &job.uniforms[0],
            extras: job.extras,
            cell: self.cell,
        };
        let channels = self.channels.each_mut().map(|channel| {
            channel.resize(length, 0.0);
            &mut channel[..]
        });
        (self.kernels.shade)(&row, &self.cells, &mut RowColours::Linear(channels));
        let [r, g, b] = &self.channels;
        for (((to, r), g), b) in colours.iter_mut().zip(r).zip(g).zip(b) {
            *to = [*r, *g, *b];
        }
    }

    /// Writes the varyings at each pixel, from the value at the first pixel and the growth per
    /// pixel.
    fn interpolate(&mut self, values: RunValues<'_, f32>) {
        let count = self.cell.varyings + self.cell.extras;
        let blocks = self.cells.chunks_exact_mut(self.cell.stride());
        for (index, block) in blocks.enumerate() {
            let x = (index * BLOCK) as f32;
            let varyings = block[BLOCK * CellLayout::varying(0)..].as_chunks_mut().0;
            for (to, varying) in varyings.iter_mut().zip(0..count) {
                let [at, step] = values.of(varying);
                let to: &mut [f32; BLOCK] = to;
                for (k, to) in to.iter_mut().enumerate() {
                    // Each pixel starts from the first one, so that errors do not add up along the
                    // line.
                    *to = at + (x + k as f32) * step;
                }
            }
        }
    }

    /// Walks along the run, and copies its pixels into the layout of the G-buffer.
    fn walk(&mut self, walk: WalkKernel, job: &Pixels<'_>, length: usize) {
        let count = self.cell.varyings + self.cell.extras;
        self.walked.resize(count * length, 0.0);
        walk(job, &mut self.walked);
        let blocks = self.cells.chunks_exact_mut(self.cell.stride());
        for (index, block) in blocks.take(length / BLOCK).enumerate() {
            for i in 0..count {
                let from = &self.walked[i * length + index * BLOCK..][..BLOCK];
                block[BLOCK * CellLayout::varying(i)..][..BLOCK].copy_from_slice(from);
            }
        }
    }
}
