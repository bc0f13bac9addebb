//! Gouraud shading in integers.

use crate::integer::{self, Halfway, Highlight, NoHighlight, Reflection, Rgb888, Vector};
use crate::number::{Num, Vec3, vec3};
use crate::reference::Model;
use crate::scene::SpecularModel;
use crate::shading::kernels::{Pixels, Vertices};
use crate::shading::methods::integers::{self, Lights, sum};
use crate::shading::{
    Approximation, Colour, Constant, Family, Fit, Info, Kernels, LightAt, Local, MethodRow, Needs,
    On, Perspective, Pixel, Shader, ShadingRate, Span, Spans, Tier,
};

/// Gouraud shading in integers: two additions per pixel step a colour, with red and blue in one
/// ([`crate::integer::gouraud`]). The loop of naive Phong shading lights the vertices.
#[derive(Clone, Copy, Debug, Default)]
struct Colours;

const INFO: Info = Info {
    name: "integer-gouraud",
    ids: &[],
    family: Family::Colours,
    tier: Tier::Asked,
    title: "vertex colours, interpolated in integers",
    formula: "I = table(L.N) + table(R.V) at vertices;  I_next = I + dI, red and blue in one sum",
    source: "L21 3, eq 3.5, 3.6 (Gouraud 1971)",
    claimed: "",
    model: Model::Gouraud,
    roundings: super::Roundings::new(4.0, 0.9, super::Stepped::Colours),
    derivation: integers::DERIVATION,
    approximation: |frame, polygon, _| {
        let lighting = &frame.lightings()[polygon.material as usize];
        let vertex = integers::error(lighting, 0.0, integers::Form::Refined);
        // Steps are cut by up to 2⁻¹⁶ each, 1/256 of a level over a piece of a span, and its ends
        // are rounded to fields of 9 bits.
        Approximation {
            colour: vertex.colour + 1.0 / 256.0 + 1.0 / 512.0,
            ..vertex
        }
    },
    fails: "highlights inside a polygon are lost, and its edges are visible, as with gouraud; lights and eye must be at infinity",
    has_power: false,
    parameters: &[],
};

static KERNELS: Kernels = Kernels {
    vertices,
    ..Kernels::of_functions::<Colours>(pixels, integers::WHY)
};

/// The row of the method table.
pub(crate) const ENTRY: MethodRow =
    MethodRow::integer_of::<Colours>(&INFO, &KERNELS, |bench, variant| {
        integers::counted::<Colours>(bench, variant, pixels, integers::LIGHTS, |_| {
            [
                sum([
                    (1, integers::RECIPROCAL),
                    (6, integers::ADDITION),
                    (3, integers::UNIT_COSINE),
                ]),
                sum([(2, integers::ADDITION)]),
                sum([]),
            ]
        })
    });

impl Shader for Colours {
    const INFO: Info = Info::OF_PIXELS;
    const NEEDS: Needs = Needs {
        shading_rate: ShadingRate::Vertex,
        local: Local::PerVertex,
        perspective: Perspective::ScreenOnly,
        spans: Spans::Ends,
        scalar_only: Some(integers::WHY),
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Colour;
    type Walk<F: Num> = Constant<Vec3<F>>;

    fn on(on: On<'_>) -> Fit {
        on.each(|lighting, how| integers::refuses(lighting, how, integers::LIGHTS))
    }
    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Constant<Vec3<F>> {
        Constant(span.linear().at)
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, colour: Pixel<Self, F>) -> Vec3<F> {
        colour
    }
}

/// The lowest bit and the count of fractional bits of red, green and blue in a colour of 8 bits per
/// channel: see [`integer::Pixel`].
const FIELDS: [(u32, u32); 3] = [(11, 1), (21, 2), (0, 1)];

/// Returns the channels of a colour in fields, without the ½ that the tables add.
fn channels(fields: u32) -> [f32; 3] {
    FIELDS.map(|(at, fraction)| {
        let one = 1 << fraction;
        // The mask keeps 8 bits and the fraction.
        let field = fields >> at & (256 * one - 1);
        (field as f32 - 0.5 * one as f32) / (255 * one) as f32
    })
}

/// Returns a colour in fields, rounded, with the ½ that the tables add.
fn fields(channels: Vec3<f32>) -> u32 {
    let channels = channels.array();
    (0..3).fold(0, |sum, c| {
        let (at, fraction) = FIELDS[c];
        let one = (1 << fraction) as f32;
        let field = libm::roundf(channels[c].clamp(0.0, 1.0) * 255.0 * one + 0.5 * one);
        sum | (field as u32) << at
    })
}

/// Lights vertices.
fn vertices(job: &Vertices<'_>, out: &mut [f32]) {
    let colour = match job.uniforms.model.specular {
        _ if integers::is_dull(job.uniforms) => colour::<NoHighlight>,
        SpecularModel::Phong => colour::<Reflection>,
        SpecularModel::Blinn => colour::<Halfway>,
    };
    let lights = Lights::new(job.uniforms);
    for (normal, out) in job.normals.iter().zip(out.chunks_exact_mut(3)) {
        out.copy_from_slice(&channels(colour(&lights, integers::vector(vec3(*normal)))));
    }
}

/// Returns the colour of a normal, in fields.
fn colour<H: Highlight>(lights: &Lights<'_>, normal: Vector) -> u32 {
    match lights.count {
        1 => integer::colour::<Rgb888, H, 1>(lights.first(), normal),
        2 => integer::colour::<Rgb888, H, 2>(lights.first(), normal),
        3 => integer::colour::<Rgb888, H, 3>(lights.first(), normal),
        _ => integer::colour::<Rgb888, H, 4>(lights.first(), normal),
    }
}

/// Shades runs, one pixel at a time.
fn pixels(job: &Pixels<'_>, out: &mut [[f32; 3]]) {
    for (index, run) in job.list.runs.iter().enumerate() {
        let [a, b] = integers::ends(job, index);
        integers::shade_run(
            job,
            index,
            run.of(out),
            |t| fields(a + (b - a) * t),
            integer::gouraud,
        );
    }
}
