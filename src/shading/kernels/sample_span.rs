//! A single span, on which operations are counted and kernels are timed.

use crate::mesh::Material;
use crate::number::{Num, vec3};
use crate::scene::{Falloff, Interpolation, Light, Lighting, Place, Power};
use crate::shading::kernels::bench_polygon::BenchPolygon;
use crate::shading::light::Uniforms;
use crate::shading::methods::integers;
use crate::shading::walks::GreatCircle;
use crate::shading::{Carried, Corner, Extras, Local, On, OperationCounts, Variant, ramp};
use alloc::vec::Vec;
use glam::DVec3;

/// A span between two unit normals, with its lights.
#[derive(Clone, Debug)]
pub struct SpanBench {
    pub(crate) lighting: Lighting,
    /// The uniforms of most methods, and those of methods that turn normals into the eye's frame.
    uniforms: [Uniforms; 2],
    /// The unit normals and positions of a triangle whose first two corners are the ends of the
    /// span.
    pub(crate) normals: [[f32; 3]; 3],
    pub(crate) points: [[f32; 3]; 3],
    perspective: bool,
}

const COLOUR: [f32; 3] = [0.9, 0.8, 0.7];

impl SpanBench {
    /// The unit normal of the triangle.
    pub(crate) const FACE: [f32; 3] = [0.0, 0.0, 1.0];
    /// The width and height of the triangle in the picture, in pixels.
    pub(crate) const LENGTH: f32 = 50.0;
    /// t₀ and Δt of its edges, which go down from the first scanline; the centres of that line lie
    /// at 0.5 pixels.
    pub(crate) const EDGE: [f32; 2] = [0.5 / SpanBench::LENGTH, 1.0 / SpanBench::LENGTH];
    /// t₀ and Δt of the span on the first scanline, which is 49.5 pixels long.
    pub(crate) const SPAN: [f32; 2] = [0.5 * (1.0 / 49.5), 1.0 / 49.5];

    /// How many pixels the span has: those with their centre left of 49.5.
    pub(crate) const PIXELS: u32 = 49;

    /// Returns the varyings at both ends of the span, which `vertex` computes at the corners. If
    /// `on_circles`, they are unit normals and edges carry them along great circles.
    pub(crate) fn ends_of_span(
        &self,
        on_circles: bool,
        vertex: impl Fn([f32; 3]) -> [f32; 3],
    ) -> [[f32; 3]; 2] {
        let [a, b, c] = self.normals.map(vertex).map(vec3);
        let [t0, dt] = SpanBench::EDGE;
        [a, b].map(|from| {
            if on_circles {
                GreatCircle::new(vec3(SpanBench::FACE), [from, c], t0, dt)
                    .normal()
                    .array()
            } else {
                [0, 1, 2].map(|i| ramp(from.array()[i], c.array()[i], t0, dt)[0])
            }
        })
    }

    /// Makes the triangle, `length` pixels wide and high. `value` converts its values.
    pub(crate) fn polygon<F: Num>(&self, length: f32, value: impl Fn(f32) -> F) -> BenchPolygon<F> {
        let three = |v: [f32; 3]| vec3(v.map(&value));
        let normals = self.normals.map(three);
        BenchPolygon {
            corners: [0, 1, 2].map(|i| Corner {
                normal: normals[i],
                place: [0, 1].map(|axis| value(self.points[i][axis] * length)),
                weight: value(1.0),
                position: three(self.points[i]),
            }),
            normals,
            face: three(SpanBench::FACE),
        }
    }

    /// Makes a span whose end normals enclose `degrees`, facing the viewer, with the default
    /// material and one light in front of it (`lights` ≤ 1) or four.
    pub fn new(degrees: f32, lights: usize) -> Self {
        SpanBench::lit(degrees, if lights <= 1 { 1 } else { 4 }, None, false)
    }

    /// Makes a span with one light (`lights` ≤ 1) or two, and the eye, at positions a few span
    /// lengths away. Lights fall off by `falloff`. Varyings are linear on the screen or, with only
    /// one light, in space.
    pub fn local(
        degrees: f32,
        lights: usize,
        falloff: Falloff,
        interpolation: Interpolation,
    ) -> Self {
        let perspective = interpolation == Interpolation::Perspective;
        let count = if perspective { 1 } else { lights.clamp(1, 2) };
        SpanBench::lit(degrees, count, Some(falloff), perspective)
    }

    /// Makes a span with this many lights. With `local`, lights and eye are at positions, and
    /// lights fall off by it.
    fn lit(degrees: f32, lights: usize, local: Option<Falloff>, perspective: bool) -> Self {
        let light = |i: usize| {
            let (sin, cos) = (libm::sin(i as f64), libm::cos(i as f64));
            let Some(falloff) = local else {
                let direction = DVec3::new(0.5 * cos, 0.5 * sin, 1.0);
                return Light::directional(direction.normalize(), COLOUR);
            };
            Light {
                falloff,
                ..Light::positional(DVec3::new(2.0 * cos, 2.0 * sin, 5.0), COLOUR)
            }
        };
        let lights: Vec<Light> = (0..lights).map(light).collect();
        let mut lighting = Lighting::new(&Material::default(), [1.0; 3], &lights, DVec3::Z);
        if local.is_some() {
            lighting.view = Place::Local([0.0, 0.0, 8.0]);
        }
        let (sin, cos) = libm::sincosf(degrees.to_radians() / 2.0);
        let mut uniforms = Uniforms::new(&lighting, Power::default(), 1.0);
        uniforms.materials = integers::materials(&lighting);
        SpanBench {
            uniforms: [uniforms.clone(), uniforms.turned()],
            lighting,
            normals: [[-sin, 0.0, cos], [sin, 0.0, cos], [0.0, sin, cos]],
            points: [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            perspective,
        }
    }

    /// Returns the reason why a method refuses the light of this span, or `None`.
    pub fn refuses(&self, variant: &Variant) -> Option<&'static str> {
        let interpolation = if self.perspective {
            Interpolation::Perspective
        } else {
            Interpolation::Screen
        };
        (variant.row()).refuses(On::Spans(&self.lighting, interpolation))
    }

    /// Returns the uniforms of a method with its default power function, at scale 1. They were made
    /// with the span, because a timing repeats what happens once per span, not once per material.
    pub(crate) fn prepared(&self, variant: &Variant) -> &Uniforms {
        let carries = variant.row().kernels(1, false).carries;
        &self.uniforms[usize::from(carries == Carried::Turned)]
    }

    /// Returns the uniforms of a method at `scale`.
    pub(crate) fn uniforms(&self, variant: &Variant, scale: f32) -> Uniforms {
        let uniforms = variant.uniforms(&self.lighting, scale);
        match variant.row().needs.local {
            Local::PerPolygon if self.is_local() => uniforms.seen_from([1.0 / 3.0, 1.0 / 3.0, 0.0]),
            _ => uniforms,
        }
    }

    /// True if a light or the eye is at a position.
    pub(crate) fn is_local(&self) -> bool {
        self.lighting.is_local()
    }

    /// Returns the varyings that kernels add to a method's own.
    pub(crate) fn extras(&self, variant: &Variant) -> Extras {
        let row = variant.row();
        row.extras(self.is_local(), self.perspective, false)
    }
}

impl Variant {
    /// Returns the operations that the method takes at each rate with one light (`lights` ≤ 1) or
    /// four. They are counted by running the method on values that count, or, for integer methods,
    /// listed by hand: what their loops do per span and per pixel.
    pub fn operations(&self, lights: usize) -> OperationCounts {
        self.operations_on(&SpanBench::new(20.0, lights))
    }

    /// Returns the operations that the method takes at each rate on a span.
    pub fn operations_on(&self, bench: &SpanBench) -> OperationCounts {
        self.row().count(bench, self).operations
    }
}
