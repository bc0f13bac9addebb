//! Spans for a rasterizer outside the crate: their colours are the span engine's.

use crate::support::renderers::renderers;
use crate::support::{floats, floats_on};
use fastphong::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::Material;
use fastphong::number::{SimdLevel, vec3};
use fastphong::raster::Renderer;
use fastphong::scene::{Interpolation, Light, Lighting};
use fastphong::shading::{
    Corner, Corners, METHODS, SpanShader, SpanShaderError, SpanVertex, Variant,
};
use glam::{DVec3, Vec3};
use std::panic::{AssertUnwindSafe, catch_unwind};

#[allow(dead_code)] // its `main`
#[path = "../../examples/own_rasterizer.rs"]
mod own_rasterizer;

const WIDTH: u32 = 64;

/// An upright rectangle from column 8 to column 56, with different normals on its left and right
/// side.
struct Rectangle {
    vertices: [Vertex; 4],
    positions: [[f32; 3]; 4],
    lighting: Lighting,
    interpolation: Interpolation,
}

const FACE: [f32; 3] = [0.0, 0.0, 1.0];

/// The colours of the vertices. They are equal along both sides.
const COLOURS: [[f32; 3]; 4] = [LEFT, LEFT, RIGHT, RIGHT];
const LEFT: [f32; 3] = [0.9, 0.2, 0.5];
const RIGHT: [f32; 3] = [0.1, 0.8, 0.5];

impl Rectangle {
    fn new(lights: &[Light], interpolation: Interpolation) -> Self {
        let lean = |x: f32| Vec3::new(x, 0.2, 0.9).normalize().to_array();
        let corner = |x: i32, y: i32| {
            let is_left = x == 8;
            Vertex {
                x: SubPixel::from_num(x),
                y: SubPixel::from_num(y),
                depth: 0.5,
                inv_w: match interpolation {
                    Interpolation::Screen => 1.0,
                    Interpolation::Perspective => [0.25, 1.0][usize::from(is_left)],
                },
                normal: lean(if is_left { -0.4 } else { 0.3 }),
                material: 0,
            }
        };
        let material = Material::default();
        Rectangle {
            vertices: [corner(8, 0), corner(8, 4), corner(56, 4), corner(56, 0)],
            positions: [
                [-1.0, 0.2, 0.0],
                [-1.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [1.0, 0.2, 0.0],
            ],
            lighting: Lighting::new(&material, [1.0; 3], lights, DVec3::Z),
            interpolation,
        }
    }

    fn frame(&self) -> Frame {
        let colours = self.lighting.vertex_colours.then_some(COLOURS);
        let mut builder = FrameBuilder::new(WIDTH, 4);
        builder.interpolation(self.interpolation);
        builder.lighting(self.lighting.clone());
        let numbers = self.vertices.map(|vertex| builder.vertex(vertex));
        for (number, position) in numbers.into_iter().zip(self.positions) {
            builder.position(number, position);
            if let Some(colours) = colours {
                builder.colour(number, colours[number as usize]);
            }
        }
        builder.polygon(&numbers, FACE, 0);
        builder.finish().expect("a frame")
    }

    /// Returns the methods that draw the frame and its spans: some leave vertex colours to others.
    fn variants(&self, frame: &Frame) -> Vec<Variant> {
        let all = floats_on(frame).map(|entry| entry.variant());
        let draws = |variant: &Variant| {
            !self.lighting.vertex_colours
                || SpanShader::new(variant, &self.lighting, self.interpolation).is_ok()
        };
        all.filter(draws).collect()
    }

    fn corners(&self) -> [Corner<f32>; 4] {
        [0, 1, 2, 3].map(|i| Corner {
            normal: vec3(self.vertices[i].normal),
            place: [self.vertices[i].x, self.vertices[i].y].map(|at| at.to_num()),
            weight: self.vertices[i].inv_w as f32,
            position: vec3(self.positions[i]),
        })
    }

    /// Shades row 2 from column `first` on, without an engine.
    fn shade(&self, variant: &Variant, first: u32, colours: &mut [[f32; 3]]) {
        let shader = SpanShader::new(variant, &self.lighting, self.interpolation);
        self.shade_by(
            &mut shader.expect("a method for any light"),
            variant,
            first,
            colours,
        );
    }

    /// Shades the same columns by any shader of the method.
    fn shade_by(
        &self,
        shader: &mut SpanShader,
        variant: &Variant,
        first: u32,
        colours: &mut [[f32; 3]],
    ) {
        let all = self.corners();
        let whole = all.map(|corner| corner.normal);
        let frame = self.frame();
        let mean = vec3(frame.mean(&frame.polygons()[0]).normal);
        if shader.wants_polygons() {
            shader.polygon(&Corners {
                all: &all,
                face: vec3(FACE),
                is_whole: true,
                whole: &whole,
                mean,
            });
        }
        // Positions differ from row to row. Here both ends are half-way between rows 0 and 4, up to
        // half a pixel.
        let t = 2.5 / 4.0;
        let ends = [[0, 1], [3, 2]].map(|sides: [usize; 2]| {
            let [upper, lower] = sides.map(|i| {
                let Vertex { normal, inv_w, .. } = self.vertices[i];
                let middle = [0, 1, 2].map(|c| 0.5 * (LEFT[c] + RIGHT[c]));
                let colour = match variant.info().name {
                    "flat" | "flat-average" => middle,
                    _ => COLOURS[i],
                };
                let normal = match variant.info().name {
                    "flat" => FACE,
                    "flat-average" => mean.unit().array(),
                    _ => normal,
                };
                shader.vertex(SpanVertex {
                    normal,
                    position: self.positions[i],
                    attributes: [colour[0], colour[1], colour[2], 1.0],
                    inv_w: inv_w as f32,
                })
            });
            let both = upper.iter().zip(&lower);
            both.map(|(a, b)| a + t * (b - a)).collect::<Vec<f32>>()
        });
        let ends = [(8.0, &ends[0][..]), (56.0, &ends[1][..])];
        shader.shade(ends, [first, 2], colours);
    }
}

#[test]
fn span_colours_equal_the_engines() {
    let directional = [
        Light::directional(DVec3::new(0.3, 0.4, 0.9).normalize(), [0.5; 3]),
        Light::directional(DVec3::new(-0.5, 0.1, 0.7).normalize(), [0.4; 3]),
    ];
    let near = [Light::positional(DVec3::new(0.3, 0.5, 2.0), [0.6; 3])];
    let all = [&directional[..1], &directional[..], &near[..]];
    let mut compared = 0;
    for (lights, coloured) in [false, true]
        .into_iter()
        .flat_map(|coloured| all.map(|lights| (lights, coloured)))
    {
        for interpolation in [Interpolation::Screen, Interpolation::Perspective] {
            let mut rectangle = Rectangle::new(lights, interpolation);
            rectangle.lighting.vertex_colours = coloured;
            let frame = rectangle.frame();
            for variant in rectangle.variants(&frame) {
                let picture = variant
                    .render_linear(&frame)
                    .expect("a method for the frame");
                let mut colours = [[0.0; 3]; 48];
                rectangle.shade(&variant, 8, &mut colours);
                let mut part = [[0.0; 3]; 20];
                rectangle.shade(&variant, 30, &mut part);
                for (i, colour) in colours.iter().enumerate() {
                    let [r, g, b, alpha] = picture.get(8 + i, 2);
                    let who = format!("{variant}, {interpolation:?}, {} lights", lights.len());
                    assert_eq!(alpha, 1.0, "{who}");
                    for (found, expected) in colour.iter().zip([r, g, b]) {
                        let off = (found.clamp(0.0, 1.0) - expected).abs();
                        // If lights are at infinity, both vertices of a side are equal, so its edge
                        // steps by 0. On great circles normals are rounded.
                        let is_circle = variant.info().name.starts_with("slerp");
                        let most = if rectangle.lighting.is_local() || is_circle {
                            variant.bound(&frame) as f32
                        } else {
                            0.0
                        };
                        assert!(off <= most, "{who}: {off:e} at {i}");
                    }
                    // A part of the line has the same colours as in the whole line.
                    if let Some(again) = i.checked_sub(22).and_then(|i| part.get(i)) {
                        for (found, whole) in again.iter().zip(colour) {
                            let off = (found - whole).abs();
                            assert!(off <= 2.0 * variant.bound(&frame) as f32, "{who}: {off:e}");
                        }
                    }
                    compared += 1;
                }
            }
        }
    }
    // All methods except the few that cannot draw these lights.
    assert!(compared >= 3 * 2 * (floats().len() - 8) * 48);
}

/// Apart from rounding, SIMD draws the colours of scalar code, for any count of pixels and after
/// any other line. The shader reports its instruction set, and it is the row engine's.
#[test]
fn simd_colours_equal_those_of_scalar_code() {
    let directional = [Light::directional(DVec3::new(0.3, 0.4, 0.9).normalize(), [0.5; 3]); 2];
    let near = [Light::positional(DVec3::new(0.3, 0.5, 2.0), [0.6; 3])];
    let levels = renderers().into_iter().map(|renderer| renderer.level());
    let (mut same, mut other, mut scalar) = (0, 0, 0);
    for level in levels {
        let all = [&directional[..1], &directional[..], &near[..]];
        for (lights, coloured) in [false, true]
            .into_iter()
            .flat_map(|coloured| all.map(|lights| (lights, coloured)))
        {
            for interpolation in [Interpolation::Screen, Interpolation::Perspective] {
                let mut rectangle = Rectangle::new(lights, interpolation);
                rectangle.lighting.vertex_colours = coloured;
                let frame = rectangle.frame();
                for variant in rectangle.variants(&frame) {
                    let mut shader = SpanShader::new(&variant, &rectangle.lighting, interpolation)
                        .expect("a method for any light")
                        .with_simd(level);
                    let plan = variant.plan(&frame, Renderer::on(level)).renderer();
                    assert_eq!(Some(Renderer::on(shader.level())), plan, "{variant}");
                    scalar += usize::from(shader.level() == SimdLevel::Scalar);
                    let most = 2.0 * variant.bound(&frame) as f32;
                    for (first, pixels) in [(30, 20), (8, 48), (8, 1), (9, 16), (11, 7)] {
                        let mut expected = vec![[0.0; 3]; pixels];
                        rectangle.shade(&variant, first, &mut expected);
                        let mut found = vec![[9.0; 3]; pixels];
                        rectangle.shade_by(&mut shader, &variant, first, &mut found);
                        for (x, (found, expected)) in found.iter().zip(&expected).enumerate() {
                            let off = (0..3)
                                .map(|c| (found[c] - expected[c]).abs())
                                .fold(0.0, f32::max);
                            let who = format!(
                                "{variant} on {level}, {interpolation:?}, coloured: {coloured}"
                            );
                            assert!(off <= most, "{who}: {off:e} at {x} from {first}");
                            *[&mut other, &mut same][usize::from(off == 0.0)] += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(scalar > 0 && same > 1000);
    assert!(other > 0 || renderers().len() == 1, "SIMD rounds elsewhere");
}

/// A shader that is used again allocates nothing, neither for vertices nor for polygons or lines,
/// by any method.
#[test]
fn a_reused_shader_allocates_nothing() {
    let near = [Light::positional(DVec3::new(0.3, 0.5, 2.0), [0.6; 3])];
    let far = [Light::directional(DVec3::Z, [0.6; 3])];
    for lights in [&near[..], &far[..]] {
        let rectangle = Rectangle::new(lights, Interpolation::Perspective);
        let frame = rectangle.frame();
        for variant in floats_on(&frame).map(|entry| entry.variant()) {
            for level in [SimdLevel::Scalar, SimdLevel::best()] {
                let mut shader =
                    SpanShader::new(&variant, &rectangle.lighting, Interpolation::Perspective)
                        .expect("a method for any light")
                        .with_simd(level);
                let mut ends = [[0.0; 96]; 2];
                let mut colours = [[0.0; 3]; 48];
                let mut line = || {
                    let all = rectangle.corners();
                    let whole = all.map(|corner| corner.normal);
                    if shader.wants_polygons() {
                        shader.polygon(&Corners {
                            all: &all,
                            face: vec3(FACE),
                            is_whole: true,
                            whole: &whole,
                            mean: vec3(FACE),
                        });
                    }
                    let count = shader.varyings();
                    for (end, x) in ends.iter_mut().zip([-0.4, 0.4]) {
                        let normal = Vec3::new(x, 0.2, 0.9).to_array();
                        shader.vertex_into(SpanVertex::of_normal(normal), &mut end[..count]);
                    }
                    let ends = [(8.0, &ends[0][..count]), (56.0, &ends[1][..count])];
                    shader.shade(ends, [8, 2], &mut colours);
                };
                line();
                let counted = allocation_counter::measure(line);
                assert_eq!(counted.count_total, 0, "{variant} on {level}");
            }
        }
    }
}

/// A method that needs polygons says which call is missing.
#[test]
fn a_shader_that_needs_polygons_panics_without_one() {
    let lighting = Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z);
    for name in ["slerp-phong", "six-point", "adaptive-phong"] {
        let variant = Variant::parse(name).expect("a method");
        let mut shader = SpanShader::new(&variant, &lighting, Interpolation::Screen)
            .expect("a method for any light");
        let end = shader.vertex(SpanVertex::of_normal(FACE));
        let shaded = catch_unwind(AssertUnwindSafe(|| {
            shader.shade([(0.0, &end), (1.0, &end)], [0, 0], &mut [[0.0; 3]]);
        }));
        let message = shaded.expect_err("no polygon");
        let expected = format!(
            "`{name}` sets up each polygon: call `SpanShader::polygon` before its vertices"
        );
        assert_eq!(message.downcast_ref::<String>(), Some(&expected));
    }
}

/// No method fails on a line without pixels, on a line that ends with the last column, or between
/// ends that are no numbers.
#[test]
fn a_line_may_be_empty_or_anywhere() {
    let lights = [Light::directional(DVec3::Z, [0.6; 3])];
    for coloured in [false, true] {
        let mut rectangle = Rectangle::new(&lights, Interpolation::Screen);
        rectangle.lighting.vertex_colours = coloured;
        for variant in METHODS.iter().map(|row| row.variant()) {
            let Ok(shader) = SpanShader::new(&variant, &rectangle.lighting, Interpolation::Screen)
            else {
                continue; // integer methods have no vertex colours
            };
            for level in SimdLevel::available() {
                let mut shader = shader.clone().with_simd(level);
                for pixels in [0, 1, 7, 8, 9] {
                    for first in [0, 8, u32::MAX - 9, u32::MAX - 3, u32::MAX] {
                        let mut colours = vec![[9.0; 3]; pixels];
                        rectangle.shade_by(&mut shader, &variant, first, &mut colours);
                        let is_shaded = |c: &[f32; 3]| c.iter().all(|c| *c != 9.0);
                        let who = format!("{variant} on {level}: {pixels} from {first}");
                        assert!(colours.iter().all(is_shaded), "{who}");
                    }
                    let ends = [8.0, 56.0].map(|_| vec![0.1; shader.varyings()]);
                    for [from, to] in [
                        [56.0, 8.0],
                        [f32::NAN, 8.0],
                        [f32::NEG_INFINITY, f32::INFINITY],
                        [1e30, -1e30],
                    ] {
                        let ends = [(from, &ends[0][..]), (to, &ends[1][..])];
                        shader.shade(ends, [8, 2], &mut vec![[9.0; 3]; pixels]);
                    }
                }
            }
        }
    }
}

/// A builder that is used again makes its second frame without a single allocation, from vertices
/// on the screen and in clip space.
#[test]
fn a_reused_builder_allocates_nothing() {
    let lighting = Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z);
    let mut builder = FrameBuilder::new(WIDTH, 48);
    builder.lighting(lighting);
    let mut fill = |shift: i32| {
        builder.clear();
        for k in 0..200 {
            let corner = |x: i32, y: i32| Vertex {
                x: SubPixel::from_num(x + k % 40 + shift),
                y: SubPixel::from_num(y),
                depth: 0.5,
                inv_w: 1.0,
                normal: FACE,
                material: 0,
            };
            let on_screen = [corner(0, 0), corner(8, 9), corner(4, 20)].map(|v| builder.vertex(v));
            let x = f64::from(k % 10) * 0.1;
            let in_clip_space = [[-0.5, 0.0], [0.0, 0.5], [0.0, 0.0]]
                .map(|[a, b]| builder.vertex_from_clip([x + a, b, 0.25, 1.0], FACE, 0));
            for corners in [on_screen, in_clip_space] {
                for corner in corners {
                    builder.position(corner, FACE).colour(corner, FACE);
                }
                builder.mean_of(&corners).polygon(&corners, FACE, 1);
            }
        }
        builder.frame().map(|frame| frame.polygons().len())
    };
    assert_eq!(fill(0), Ok(400));
    let mut again = Ok(0);
    let counted = allocation_counter::measure(|| again = fill(3));
    assert_eq!((again, counted.count_total), (Ok(400), 0));
}

/// A method that cannot draw a material says why, as for frames.
#[test]
fn a_material_that_a_method_cannot_draw_is_refused() {
    let near = [Light::positional(DVec3::Z, [1.0; 3])];
    let lighting = Lighting::new(&Material::default(), [1.0; 3], &near, DVec3::Z);
    let variant = Variant::parse("integer-fast").expect("a method");
    let refused = SpanShader::new(&variant, &lighting, Interpolation::Screen).err();
    let reason = "integer methods need lights and an eye at infinity";
    assert_eq!(refused, Some(SpanShaderError::Refused(reason)));
}

/// The example draws three balls without holes. Every row of a ball is one run of pixels.
#[test]
fn the_rasterizer_of_the_example_draws_three_balls() {
    let pixels = own_rasterizer::picture();
    let mut brightest = [0; 3];
    for (ball, brightest) in brightest.iter_mut().enumerate() {
        let (mut covered, mut runs) = (0, 0);
        for row in pixels.chunks_exact(480) {
            let row = &row[160 * ball..160 * (ball + 1)];
            let is_drawn: Vec<bool> = row.iter().map(|[r, g, b, _]| r | g | b > 0).collect();
            covered += is_drawn.iter().filter(|drawn| **drawn).count();
            runs += is_drawn.windows(2).filter(|two| !two[0] && two[1]).count();
            let most = row.iter().map(|[r, ..]| *r).max();
            *brightest = most.max(Some(*brightest)).unwrap_or_default();
        }
        // The outline is at most a 16-gon, which has over 0.97 of its circle's area. Rings cut a
        // little off it.
        let disc = std::f64::consts::PI * 70.0 * 70.0;
        assert!(
            (0.95 * disc..disc).contains(&(covered as f64)),
            "{covered} of {disc}"
        );
        assert_eq!(runs, 140, "one run in each of 140 rows");
    }
    let [gouraud, rsqrt, duff] = brightest;
    assert!(
        gouraud + 50 < rsqrt && rsqrt.abs_diff(duff) <= 1,
        "{brightest:?}"
    );
}
