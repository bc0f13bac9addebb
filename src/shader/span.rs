//! One span on its own: what benches measure to tell set-up from pixels.

use super::dispatch::{Job, dispatch_span};
use super::{Corner, Corners, Method, Shader, Span};
use crate::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use crate::lighting::{Falloff, Light, Lighting, Material, Place};
use crate::number::{Lanes, LanesJob, Level, Machine, Scalar, each, on_level};
use crate::scene::Interpolation;
use crate::walk::{Attribute, Walk};
use core::marker::PhantomData;
use glam::DVec3;

/// A span between two unit normals, lit by some lights.
#[derive(Clone, Debug)]
pub struct SpanBench {
    frame: Frame,
}

impl SpanBench {
    /// A span whose end normals enclose `degrees`, facing the viewer, with one light in front of it (`lights` ≤ 1)
    /// or four, and the default material.
    pub fn new(degrees: f32, lights: usize) -> Self {
        let view = DVec3::Z;
        let lights: alloc::vec::Vec<Light> = (0..if lights <= 1 { 1 } else { 4 })
            .map(|i| {
                let angle = i as f64;
                let direction =
                    DVec3::new(0.5 * libm::cos(angle), 0.5 * libm::sin(angle), 1.0).normalize();
                Light::directional(direction, [0.9, 0.8, 0.7])
            })
            .collect();
        let lighting = Lighting::new(&Material::default(), [1.0; 3], &lights, view);
        SpanBench {
            frame: span(degrees, lighting)
                .finish()
                .expect("one triangle, in range"),
        }
    }

    /// The same span with one light (`lights` ≤ 1) or two, and the eye, at positions a few of its lengths away; lights
    /// grow weaker by `falloff`, and the attributes vary on the screen or, for one light, in space.
    pub fn local(
        degrees: f32,
        lights: usize,
        falloff: Falloff,
        interpolation: Interpolation,
    ) -> Self {
        let count = if interpolation == Interpolation::Perspective {
            1
        } else {
            lights.clamp(1, 2)
        };
        let light = |i: usize| {
            let angle = i as f64;
            let position = DVec3::new(2.0 * libm::cos(angle), 2.0 * libm::sin(angle), 5.0);
            Light {
                falloff,
                ..Light::positional(position, [0.9, 0.8, 0.7])
            }
        };
        let lights: alloc::vec::Vec<Light> = (0..count).map(light).collect();
        let lighting = Lighting::new(&Material::default(), [1.0; 3], &lights, DVec3::Z);
        let mut builder = span(
            degrees,
            Lighting {
                view: Place::Local([0.0, 0.0, 8.0]),
                ..lighting
            },
        );
        for (vertex, x, y) in [(0, 0.0, 0.0), (1, 1.0, 0.0), (2, 0.0, 1.0)] {
            builder.position(vertex, [x, y, 0.0]);
        }
        builder.interpolation(interpolation);
        SpanBench {
            frame: builder.finish().expect("one triangle, in range"),
        }
    }

    pub(super) fn frame(&self) -> &Frame {
        &self.frame
    }
}

/// A triangle whose first two corners are the ends of the span.
fn span(degrees: f32, lighting: Lighting) -> FrameBuilder {
    let half = degrees.to_radians() / 2.0;
    let (sin, cos) = libm::sincosf(half);
    let mut builder = FrameBuilder::new(1, 1);
    let material = builder.lighting(lighting);
    for (x, y, normal) in [
        (0, 0, [-sin, 0.0, cos]),
        (1, 0, [sin, 0.0, cos]),
        (0, 1, [0.0, sin, cos]),
    ] {
        let (x, y) = (SubPixel::from_num(x), SubPixel::from_num(y));
        builder.vertex(Vertex {
            x,
            y,
            depth: 0.5,
            inv_w: 1.0,
            normal,
            material,
        });
    }
    builder.polygon(&[0, 1, 2], [0.0, 0.0, 1.0], 0);
    builder
}

/// Shades the span into `out`: vertices and span set-up as the engine does them, then every pixel.
pub(super) fn shade<D: Method>(parameters: &[u32], bench: &SpanBench, out: &mut [[f32; 3]]) {
    struct Shade<'a>(&'a [u32], &'a Frame, &'a mut [[f32; 3]]);
    impl Job for Shade<'_> {
        type Out = ();
        fn run<S: Shader>(self) {
            run::<S, Scalar>(Scalar, self.0, self.1, self.2);
        }
    }
    dispatch_span::<D, _>(&bench.frame, Shade(parameters, &bench.frame, out));
}

/// Likewise on an instruction set, into one slice a channel.
pub(super) fn shade_on<D: Method>(
    parameters: &[u32],
    bench: &SpanBench,
    level: Level,
    out: [&mut [f32]; 3],
) {
    struct Shade<'a>(&'a [u32], &'a Frame, Level, [&'a mut [f32]; 3]);
    impl Job for Shade<'_> {
        type Out = ();
        fn run<S: Shader>(self) {
            let Shade(parameters, frame, level, out) = self;
            on_level(
                level,
                OnLevel::<S> {
                    parameters,
                    frame,
                    out,
                    shader: PhantomData,
                },
            );
        }
    }
    dispatch_span::<D, _>(&bench.frame, Shade(parameters, &bench.frame, level, out));
}

struct OnLevel<'a, S> {
    parameters: &'a [u32],
    frame: &'a Frame,
    out: [&'a mut [f32]; 3],
    shader: PhantomData<S>,
}

impl<S: Shader> LanesJob for OnLevel<'_, S> {
    type Out = ();

    fn run<M: Lanes>(self, m: M) {
        m.vectorize(
            #[inline(always)]
            || {
                let [red, green, blue] = self.out;
                let (mut walk, consts) = start::<S, M>(m, self.parameters, self.frame, red.len());
                let groups = red
                    .chunks_exact_mut(M::WIDTH)
                    .zip(green.chunks_exact_mut(M::WIDTH));
                for ((red, green), blue) in groups.zip(blue.chunks_exact_mut(M::WIDTH)) {
                    let [r, g, b] = S::shade(&consts, walk.next());
                    m.store(r, red);
                    m.store(g, green);
                    m.store(b, blue);
                }
            },
        );
    }
}

#[inline(always)]
fn run<S: Shader, M: Machine>(m: M, parameters: &[u32], frame: &Frame, out: &mut [[f32; 3]]) {
    let (mut walk, wide) = start::<S, M>(m, parameters, frame, out.len());
    for colour in out {
        let rgb = S::shade(&wide, walk.next());
        *colour = each(|i| m.first(rgb[i]));
    }
}

/// The walk along a span of `length` pixels, and the constants of its pixels.
#[inline(always)]
fn start<S: Shader, M: Machine>(
    m: M,
    parameters: &[u32],
    frame: &Frame,
    length: usize,
) -> (S::Walk<M>, S::Consts<M::F>) {
    let one = |x: f32| m.one(x);
    let lighting = &frame.lightings()[0];
    let consts = S::consts(lighting, parameters, &one);
    let wide = S::consts(lighting, parameters, &|x| m.splat(m.one(x)));
    let polygon = &frame.polygons()[0];
    let corner: [_; 3] = each(|i| {
        S::vertex(
            &consts,
            &Corner {
                machine: m,
                frame,
                vertex: i as u32,
            },
        )
    });
    let corners = Corners {
        machine: m,
        frame,
        polygon,
        attributes: &corner,
    };
    let over_polygon = S::polygon(&consts, &corners);
    let dt = 1.0 / length as f32;
    let face = m.three(frame.polygon_normal(polygon));
    let attribute = S::Attribute::span(m, face, corner[0], corner[1], m.one(0.5 * dt), m.one(dt));
    let start = Span {
        x: m.one(0.5),
        y: m.one(0.5),
        attribute,
    };
    (S::walk(m, &consts, &over_polygon, &start), wide)
}
