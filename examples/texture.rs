//! A texture: texture coordinates as attributes of vertices, and your own shader that looks up a
//! picture at each pixel.
//!
//! ```text
//! cargo run --release --example texture > texture.ppm
//! ```
//!
//! `Textured` carries (u, v) beside the normal. Engines interpolate both, also in perspective and
//! to corners that clipping made, and pass them to `shade`: for one pixel at a time in scalar code,
//! for 8 or 16 with SIMD. The floor reaches behind the eye, so that it is clipped.

use fastphong::glam::{DVec3, Vec3 as Vector};
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::mesh::{GivenNormals, Material, MeshBuilder, PolygonMesh};
use fastphong::number::{Num, Vec3, vec3};
use fastphong::picture::PictureMut;
use fastphong::raster::{DrawOptions, Renderer};
use fastphong::scene::{Camera, Interpolation, Light, Projection, Scene};
use fastphong::shading::{
    Carried, Carries, Info, LightAt, Linear, MethodRow, Needs, Perspective, Shader, Span,
};
use std::error::Error;
use std::io::Write;
use std::sync::LazyLock;

/// Columns and rows of the picture.
const SIDE: usize = 64;

/// Red, green and blue of the picture, row by row. Each row ends with a copy of its first column,
/// and copies of the first two rows follow the last, so that interpolation needs no case for the
/// border.
pub static BRICKS: LazyLock<[Vec<f32>; 3]> = LazyLock::new(|| {
    let places = (0..SIDE + 2).flat_map(|v| (0..=SIDE).map(move |u| [u % SIDE, v % SIDE]));
    let colour = |[u, v]: [usize; 2]| {
        let row = v / 16;
        let (along, brick) = ((u + 16 * (row % 2)) % 32, (u + 16 * (row % 2)) / 32 % 2);
        if along < 2 || v % 16 < 2 {
            [0.75, 0.72, 0.66]
        } else {
            [0.5 + 0.06 * ((row + brick) % 3) as f32, 0.17, 0.1]
        }
    };
    let colours: Vec<[f32; 3]> = places.map(colour).collect();
    [0, 1, 2].map(|channel| colours.iter().map(|colour| colour[channel]).collect())
});

/// Phong shading whose ambient and diffuse light is multiplied by the picture's colour.
#[derive(Clone, Copy, Default)]
struct Textured;

static TEXTURED: MethodRow = MethodRow::of::<Textured>();

impl Shader for Textured {
    const INFO: Info = Info {
        name: "textured",
        title: "normals and texture coordinates, interpolated",
        ..Info::OF_PIXELS
    };
    // Under perspective engines interpolate all values times a weight, 1/w. A normal does not mind,
    // because it is normalised, but coordinates do. `Divides` tells engines to divide by the weight
    // at each pixel.
    const NEEDS: Needs = Needs {
        perspective: Perspective::Divides,
        // Ambient and diffuse light times the picture's colour, plus highlights.
        sums_lights: true,
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = Linear<(Vec3<F>, [F; 2])>;

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, (n, [u, v]): (Vec3<F>, [F; 2])) -> Vec3<F> {
        let (dull, bright) = lit.shade_apart(n.unit());
        let [r, g, b] = looked_up(&BRICKS, u, v);
        vec3([dull.x * r, dull.y * g, dull.z * b]) + bright
    }
}

impl Carries for Textured {
    const FROM: Carried = Carried::Attributes;
    type Varying<F: Num> = (Vec3<F>, [F; 2]); // N and (u, v)

    #[inline(always)]
    fn vertex<F: Num>(lit: &LightAt<'_, F>, n: Vec3<F>) -> (Vec3<F>, [F; 2]) {
        let [u, v, ..] = lit.attributes();
        (n, [u, v])
    }
}

/// Returns the colour at (u, v), interpolated linearly between the four pixels around it. The
/// picture covers 0 to 1 and repeats.
#[inline(always)]
fn looked_up<F: Num>(picture: &[Vec<f32>; 3], u: F, v: F) -> [F; 3] {
    let (u, v) = ((u - floor(u)) * SIDE as f32, (v - floor(v)) * SIDE as f32);
    let row = floor(v);
    let below = v - row;
    let place = row * (SIDE + 1) as f32 + u;
    // `Num::lookup` interpolates linearly between two entries of a table, which are neighbouring
    // columns here. The table that starts one row later has the row below.
    let channel = |all: &[f32]| {
        let (upper, lower) = (place.lookup(all), place.lookup(&all[SIDE + 1..]));
        upper + below * (lower - upper)
    };
    let [r, g, b] = picture;
    [channel(r), channel(g), channel(b)]
}

/// Returns the largest whole number up to `x`, or perhaps the one below if `x` is whole. Holds for
/// |x| < 2²²: adding 1.5 · 2²³ leaves no bits for a fraction, so the sum is rounded to a whole
/// number.
#[inline(always)]
fn floor<F: Num>(x: F) -> F {
    const WHOLE: f32 = 12_582_912.0;
    (x - 0.5 + WHOLE) - WHOLE
}

/// Returns a floor with a box on it. No two sides share a corner, because their normals and
/// coordinates differ.
fn room() -> Result<PolygonMesh, Box<dyn Error>> {
    let (mut positions, mut normals, mut attributes) = (Vec::new(), Vec::new(), Vec::new());
    let mut side = |middle: Vector, across: Vector, up: Vector, repeats: f32| {
        for [a, b] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
            positions.push(middle + a * across + b * up);
            normals.push(across.cross(up).normalize());
            attributes.push([repeats * a, repeats * b, 0.0, 0.0]);
        }
    };
    side(Vector::ZERO, 12.0 * Vector::X, -12.0 * Vector::Z, 6.0);
    let middle = Vector::new(0.0, 1.0, 0.0);
    for (out, across) in [
        (Vector::X, -Vector::Z),
        (-Vector::X, Vector::Z),
        (Vector::Z, Vector::X),
        (-Vector::Z, -Vector::X),
    ] {
        side(middle + out, across, Vector::Y, 0.5);
    }
    side(middle + Vector::Y, Vector::X, -Vector::Z, 0.5);
    let mut builder = MeshBuilder::new(positions);
    for first in (0..24).step_by(4) {
        builder.polygon(&[first, first + 1, first + 2, first + 3]);
    }
    builder
        .attributes(attributes)
        .normals(GivenNormals::by_vertex(normals));
    Ok(builder.finish()?)
}

/// Returns a scene of the room, seen in perspective.
pub fn scene() -> Result<Scene, Box<dyn Error>> {
    let mut scene = Scene::of_mesh(room()?);
    (scene.width, scene.height) = (320, 240);
    let (eye, target) = (DVec3::new(2.2, 2.6, 4.2), DVec3::new(0.0, 0.8, 0.0));
    scene.camera = Camera::looking_at(eye, target, Projection::Perspective { fovy: 50.0 });
    (scene.camera.near, scene.camera.far) = (0.1, 40.0);
    scene.interpolation = Interpolation::Perspective;
    scene.objects[0].normals = NormalSource::Given.into();
    scene.objects[0].material = Some(Material {
        ambient: [0.35; 3],
        diffuse: [1.0; 3],
        specular: [0.15; 3],
        shininess: 20.0,
    });
    scene.background = [0.3, 0.45, 0.65];
    scene.lights = vec![Light::directional(DVec3::new(0.5, 0.8, 0.6), [0.9; 3])];
    Ok(scene)
}

/// Draws the scene into 320 × 240 pixels.
pub fn picture(renderer: Renderer) -> Result<Vec<[u8; 4]>, Box<dyn Error>> {
    let frame = scene()?.frame()?;
    let mut pixels = vec![[0; 4]; 320 * 240];
    let picture = PictureMut::rgba8(&mut pixels, 320, 240);
    let options = DrawOptions::by(renderer);
    TEXTURED.variant().draw(&frame, picture, options)?;
    Ok(pixels)
}

fn main() -> Result<(), Box<dyn Error>> {
    let pixels = picture(Renderer::fastest())?;
    let mut file = b"P6\n320 240\n255\n".to_vec();
    file.extend(pixels.iter().flat_map(|[r, g, b, _]| [r, g, b]));
    Ok(std::io::stdout().write_all(&file)?)
}
