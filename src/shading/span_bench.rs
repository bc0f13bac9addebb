//! One span on its own: what benchmarks measure to tell set-up from pixels.

use super::kernels::start_len;
use super::lighting::Uniforms;
use super::{Extras, Local, OperationCounts, Perspective, Pixels, Run, Variant, Vertices, ramp};
use crate::mesh::Material;
use crate::scene::{Falloff, Interpolation, Light, Lighting, Place};
use alloc::vec::Vec;
use glam::DVec3;

/// A span between two unit normals, lit by some lights.
#[derive(Clone, Debug)]
pub struct SpanBench {
    pub(super) lighting: Lighting,
    pub(super) uniforms: Uniforms,
    /// The unit normals of a triangle whose first two corners are the ends of the span, and their positions.
    pub(super) normals: [[f32; 3]; 3],
    pub(super) points: [[f32; 3]; 3],
    pub(super) perspective: bool,
}

/// The unit normal of the triangle.
pub(super) const FACE: [f32; 3] = [0.0, 0.0, 1.0];

/// The most numbers that a span of four lights starts from.
const MOST: usize = 40;

impl SpanBench {
    /// Makes a span whose end normals enclose `degrees`, facing the viewer, with one light in front of it (`lights` ≤ 1) or four,
    /// and the default material.
    pub fn new(degrees: f32, lights: usize) -> Self {
        let lights: Vec<Light> = (0..if lights <= 1 { 1 } else { 4 })
            .map(|i| {
                let angle = i as f64;
                let direction =
                    DVec3::new(0.5 * libm::cos(angle), 0.5 * libm::sin(angle), 1.0).normalize();
                Light::directional(direction, [0.9, 0.8, 0.7])
            })
            .collect();
        let lighting = Lighting::new(&Material::default(), [1.0; 3], &lights, DVec3::Z);
        SpanBench::lit(degrees, lighting, false)
    }

    /// Makes the same span with one light (`lights` ≤ 1) or two, and the eye, at positions a few of its lengths away; lights grow
    /// weaker by `falloff`, and varyings are linear on the screen or, with one light, in space.
    pub fn local(
        degrees: f32,
        lights: usize,
        falloff: Falloff,
        interpolation: Interpolation,
    ) -> Self {
        let perspective = interpolation == Interpolation::Perspective;
        let count = if perspective { 1 } else { lights.clamp(1, 2) };
        let light = |i: usize| {
            let angle = i as f64;
            let position = DVec3::new(2.0 * libm::cos(angle), 2.0 * libm::sin(angle), 5.0);
            Light {
                falloff,
                ..Light::positional(position, [0.9, 0.8, 0.7])
            }
        };
        let lights: Vec<Light> = (0..count).map(light).collect();
        let lighting = Lighting {
            view: Place::Local([0.0, 0.0, 8.0]),
            ..Lighting::new(&Material::default(), [1.0; 3], &lights, DVec3::Z)
        };
        SpanBench::lit(degrees, lighting, perspective)
    }

    fn lit(degrees: f32, lighting: Lighting, perspective: bool) -> Self {
        let (sin, cos) = libm::sincosf(degrees.to_radians() / 2.0);
        SpanBench {
            uniforms: Uniforms::new(&lighting, 1.0),
            lighting,
            normals: [[-sin, 0.0, cos], [sin, 0.0, cos], [0.0, sin, cos]],
            points: [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            perspective,
        }
    }

    /// Returns the uniforms at `scale` for a method that sees lights from `local`.
    pub(super) fn uniforms(&self, local: Local, scale: f32) -> Uniforms {
        let uniforms = Uniforms::new(&self.lighting, scale);
        match local {
            Local::PerPolygon if self.lighting.is_local() => {
                uniforms.seen_from([1.0 / 3.0, 1.0 / 3.0, 0.0])
            }
            _ => uniforms,
        }
    }

    /// True if a light or the eye is at a position.
    pub(super) fn is_near(&self) -> bool {
        self.lighting.is_local()
    }

    pub(super) fn extras(&self, variant: &Variant) -> Extras {
        variant
            .entry()
            .extras(self.lighting.is_local(), self.perspective)
    }
}

impl Variant {
    /// Returns how many operations of each kind the method takes with one light (`lights` ≤ 1) or four, counted by running it on
    /// numbers that count.
    pub fn operations(&self, lights: usize) -> OperationCounts {
        self.operations_on(&SpanBench::new(20.0, lights))
    }

    /// Returns how many operations of each kind the method takes on a span.
    pub fn operations_on(&self, bench: &SpanBench) -> OperationCounts {
        self.entry().count(bench, self)
    }

    /// Shades one span into `out`, one pixel at a time: its two vertices, its set-up, and as many pixels as `out` has.
    pub fn shade_span(&self, bench: &SpanBench, out: &mut [[f32; 3]]) {
        self.span(bench, &bench.uniforms, out.len(), |kernels, job| {
            (kernels.pixels)(job, out)
        });
    }

    fn span(
        &self,
        bench: &SpanBench,
        uniforms: &Uniforms,
        pixels: usize,
        shade: impl FnOnce(&super::Kernels, &Pixels<'_>),
    ) {
        let near = bench.lighting.is_local();
        let kernels = self.entry().kernels(uniforms.lights.len(), near);
        let extras = bench.extras(self);
        let [own, _] = (kernels.counts)(uniforms.lights.len());
        let varyings = own + extras.count();
        let mut ends = [[0.0; MOST / 2]; 2];
        for (end, values) in ends.iter_mut().enumerate() {
            let vertices = Vertices {
                parameters: self.parameters(),
                uniforms,
                normals: &bench.normals[end..=end],
                points: &bench.points[end..=end],
                stride: own,
            };
            (kernels.vertices)(&vertices, &mut values[..own]);
            if extras.point {
                values[own..own + 3].copy_from_slice(&bench.points[end]);
            }
            if extras.weight {
                values[varyings - 1] = 1.0;
            }
        }
        let (mut start, dt) = ([0.0; MOST], 1.0 / pixels as f32);
        if kernels.great_circle {
            start[..3].copy_from_slice(&ends[0][..3]);
            start[3..6].copy_from_slice(&ends[1][..3]);
            (start[6], start[7]) = (0.5 * dt, dt);
            start[8..11].copy_from_slice(&FACE);
        } else {
            for i in 0..varyings {
                [start[i], start[varyings + i]] = ramp(ends[0][i], ends[1][i], 0.5 * dt, dt);
            }
        }
        let run = Run {
            uniforms: 0,
            x: 0,
            pixels: pixels as u32,
        };
        let job = Pixels {
            parameters: self.parameters(),
            uniforms: core::slice::from_ref(uniforms),
            extras,
            runs: &[run],
            starts: &start[..start_len(kernels.great_circle, varyings)],
        };
        shade(kernels, &job);
    }
}

#[cfg(feature = "simd")]
mod simd {
    use super::*;
    use crate::number::simd::BLOCK;
    use crate::shading::{RowColours, ShadeRow};

    /// A span that an instruction set shades again and again: the memory of a row of the G-buffer.
    #[derive(Clone, Debug)]
    pub struct SpanRow {
        uniforms: Uniforms,
        walked: Vec<f32>,
        cells: Vec<f32>,
        bytes: Vec<[u8; 4]>,
    }

    impl SpanRow {
        /// Makes room for `pixels` pixels, a multiple of 16.
        pub fn new(variant: &Variant, bench: &SpanBench, pixels: usize) -> SpanRow {
            assert!(
                pixels.is_multiple_of(2 * BLOCK),
                "whole blocks of any instruction set"
            );
            let uniforms = bench.uniforms(variant.info().local, 255.0);
            let lights = uniforms.lights.len();
            let kernels = variant.entry().kernels(lights, bench.lighting.is_local());
            let [_, planes] = (kernels.counts)(lights);
            let planes = planes + bench.extras(variant).count();
            SpanRow {
                uniforms,
                walked: alloc::vec![0.0; planes * pixels],
                cells: alloc::vec![0.0; (1 + planes) * pixels],
                bytes: alloc::vec![[0; 4]; pixels],
            }
        }

        /// Returns the colours that were shaded last.
        pub fn bytes(&self) -> &[[u8; 4]] {
            &self.bytes
        }
    }

    impl Variant {
        /// Shades one span by the kernels of an instruction set, as the row engine calls them: the walk into a row of the G-buffer,
        /// then the row to bytes. Scalar code shades nothing here.
        pub fn shade_span_on(
            &self,
            level: crate::number::Level,
            bench: &SpanBench,
            row: &mut SpanRow,
        ) {
            let SpanRow {
                uniforms,
                walked,
                cells,
                bytes,
            } = row;
            let extras = bench.extras(self);
            self.span(bench, uniforms, bytes.len(), |kernels, job| {
                let Some(simd) = kernels.on(level) else {
                    return;
                };
                let numbers = walked.len() / bytes.len();
                if let Some(walk) = simd.walk {
                    walk(job, walked);
                }
                for (block, cell) in cells.chunks_exact_mut(BLOCK * (1 + numbers)).enumerate() {
                    for (plane, to) in cell[BLOCK..]
                        .as_chunks_mut::<BLOCK>()
                        .0
                        .iter_mut()
                        .enumerate()
                    {
                        let first = block * BLOCK;
                        if simd.walk.is_some() {
                            to.copy_from_slice(&walked[plane * bytes.len() + first..][..BLOCK]);
                            continue;
                        }
                        let (at, step) = (job.starts[plane], job.starts[numbers + plane]);
                        for (k, to) in to.iter_mut().enumerate() {
                            *to = at + (first + k) as f32 * step;
                        }
                    }
                }
                let job = ShadeRow {
                    parameters: self.parameters(),
                    uniforms,
                    extras,
                    numbers: 1 + numbers,
                };
                (simd.shade)(&job, cells, &mut RowColours::Bytes(bytes, [0; 4]));
            });
        }
    }
}
#[cfg(feature = "simd")]
pub use simd::SpanRow;

#[allow(unused_imports)] // named by the documentation
use Perspective as _;
