//! Your own shading method, outside the crate: cel shading, drawn next to naive Phong shading.
//!
//! ```text
//! cargo run --release --example own_shader > own_shader.ppm
//! ```
//!
//! `Toon` defines what a vertex carries, how this is stepped along a span, and how a pixel is
//! shaded, once for all arithmetic backends. `TOON` compiles it, and every engine and instruction
//! set then draws it like a built-in method.
//!
//! Every function of a shader is `#[inline(always)]`. Without it a function costs a call per pixel.

use fastphong::number::{Num, Vec3};
use fastphong::scene::input;
use fastphong::shading::{
    Info, LightAt, LightModel, Linear, MethodParameter, MethodRow, Needs, Normal, Shader, Span,
    Value,
};
use std::io::Write;

/// Cel shading: the diffuse term in a few bands, and a highlight with a hard edge.
///
/// ```text
/// I = I_a k_a + Σ I_p k_d b/bands + Σ I_p k_s [R·V > 0.9 and L·N > 0]
/// R·V = 2 (L·N)(V·N) − L·V,   b = how many of (i − ½) / bands, i = 1, 2, …, are below L·N
/// ```
#[derive(Clone, Copy, Default)]
struct Toon {
    bands: u32,
}

static TOON: MethodRow = MethodRow::of::<Toon>();

impl Shader for Toon {
    const INFO: Info = Info {
        name: "toon",
        title: "bands of light, and a highlight with a hard edge",
        // Three bands by default, at least 1 and at most 8.
        parameters: &[MethodParameter::whole("bands", "bands of light", 3, [1, 8])],
        ..Info::OF_PIXELS
    };
    // Each term below has a light as its factor, so engines may multiply the lights by 255 where
    // pictures store bytes. Leave this out if your colours are not sums of lights.
    const NEEDS: Needs = Needs {
        sums_lights: true,
        ..Needs::PIXELS
    };
    // A vertex carries only its normal, so engines need not call the method for vertices.
    type Constants<F: Num> = (); // nothing is set up per polygon
    type Carries = Normal;
    type Walk<F: Num> = Linear<Vec3<F>>; // three additions per pixel

    #[inline(always)]
    fn new(parameters: &[Value], _: &LightModel) -> Self {
        Toon {
            bands: parameters[0].whole().unwrap_or(3),
        }
    }
    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<Vec3<F>> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
        let (n, width) = (n.unit(), 1.0 / self.bands as f32);
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let l_n = n.dot(light.to);
            let mut diffuse = l_n.broadcast(0.0);
            for band in 0..self.bands {
                // `x.gate(y, limit)` is x where y is above the limit, and 0 elsewhere. With SIMD
                // there can be no branch here, because the pixels of a block may differ.
                diffuse = diffuse + l_n.broadcast(width).gate(l_n, (band as f32 + 0.5) * width);
            }
            let highlight = lit.highlight(&light, l_n, n.dot(lit.view())).gate(l_n, 0.0);
            let specular = l_n.broadcast(1.0).gate(highlight, 0.9);
            colour = lit.plus(colour, &light, diffuse, specular);
        }
        colour
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = input::resolve(&input::load("builtin:torus")?)?.scene;
    (scene.width, scene.height) = (320, 240);
    let frame = scene.frame()?;
    let built_in = MethodRow::named("naive-phong").ok_or("no such method")?;
    let draw = |entry: &'static MethodRow| {
        let (variant, counts) = (entry.variant(), entry.variant().operations(1).shade);
        eprintln!("{variant} shades a pixel by {counts:?}");
        variant.render(&frame)
    };
    let [toon, naive] = [draw(&TOON)?, draw(built_in)?];
    let mut file = b"P6\n640 240\n255\n".to_vec();
    for (left, right) in toon.rows().zip(naive.rows()) {
        let pixels = left.iter().chain(right);
        file.extend(pixels.flat_map(|pixel| &pixel[..3]));
    }
    Ok(std::io::stdout().write_all(&file)?)
}
