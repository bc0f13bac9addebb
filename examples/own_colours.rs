//! Attributes of your own: the vertex colours of an OBJ file (`v x y z r g b`), lit by Phong shading.
//!
//! ```text
//! cargo run --release --example own_colours > own_colours.ppm
//! cargo run --release --example own_colours FILE.obj > own_colours.ppm
//! ```
//!
//! A vertex may carry four numbers: the colour of an OBJ file and 1, or whatever `MeshBuilder::attributes` or
//! `FrameBuilder::attributes` set. `Coloured` reads them at each vertex, and engines interpolate what it returns, in perspective
//! and through corners that clipping made.

use fastphong::glam::DVec3;
use fastphong::mesh::obj::{load_obj, parse_obj};
use fastphong::number::{Num, Vec3, vec3};
use fastphong::raster::{DrawOptions, Renderer};
use fastphong::scene::{Interpolation, Projection, Scene};
use fastphong::shading::{
    Carried, Carries, Info, Linear, Lit, MethodRow, Needs, Perspective, Shader, Span,
};
use std::error::Error;
use std::io::Write;

/// Phong shading whose ambient and diffuse light has the colour of the surface at each pixel.
///
/// ```text
/// I = C (I_a k_a + Σ I_p k_d L·N) + Σ I_p k_s (R·V)^n
/// ```
#[derive(Clone, Copy, Default)]
struct Coloured;

static COLOURED: MethodRow = MethodRow::of::<Coloured>();

impl Shader for Coloured {
    const INFO: Info = Info {
        name: "coloured",
        title: "normals and colours, interpolated",
        ..Info::OF_PIXELS
    };
    // A normal may be too long: it is made a unit vector. A colour may not: in perspective it is divided by its weight.
    const NEEDS: Needs = Needs {
        perspective: Perspective::Divides,
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = Linear<(Vec3<F>, Vec3<F>)>;

    #[inline(always)]
    fn walk<F: Num>(self, _: &Lit<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &Lit<'_, F>, (n, c): (Vec3<F>, Vec3<F>)) -> Vec3<F> {
        let (dull, bright) = lit.shade_apart(n.unit());
        vec3([dull.x * c.x, dull.y * c.y, dull.z * c.z]) + bright
    }
}

impl Carries for Coloured {
    const FROM: Carried = Carried::Attributes;
    type Varying<F: Num> = (Vec3<F>, Vec3<F>); // N and C

    #[inline(always)]
    fn vertex<F: Num>(lit: &Lit<'_, F>, n: Vec3<F>) -> (Vec3<F>, Vec3<F>) {
        let [r, g, b, _] = lit.attributes();
        (n, vec3([r, g, b]))
    }
}

/// A cube whose corners have the colours of their places.
const CUBE: &str = "
v -1 -1 -1 0 0 0\nv 1 -1 -1 1 0 0\nv 1 1 -1 1 1 0\nv -1 1 -1 0 1 0
v -1 -1 1 0 0 1\nv 1 -1 1 1 0 1\nv 1 1 1 1 1 1\nv -1 1 1 0 1 1
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
";

fn main() -> Result<(), Box<dyn Error>> {
    let loaded = match std::env::args_os().nth(1) {
        Some(path) => load_obj(path.as_ref())?,
        None => parse_obj("cube", CUBE.as_bytes(), |_| {
            Err(std::io::ErrorKind::NotFound.into())
        })?,
    };
    if loaded.mesh.colours().is_empty() {
        eprintln!("the file has no vertex colours: all are white");
    }
    let mut scene = Scene::of_mesh(loaded.mesh);
    (scene.width, scene.height) = (320, 240);
    // Near enough for perspective to show.
    let camera = &mut scene.camera;
    let Projection::Orthographic { half_height } = camera.projection else {
        return Err("a scene of a mesh is orthographic".into());
    };
    let toward_eye: DVec3 = camera.view();
    camera.eye = camera.target + toward_eye * 4.0 * half_height;
    (camera.near, camera.far) = (half_height, 8.0 * half_height);
    camera.projection = Projection::Perspective { fovy: 30.0 };
    scene.interpolation = Interpolation::Perspective;

    let frame = scene.frame()?;
    let mut pixels = vec![[0; 4]; 320 * 240];
    let picture = fastphong::picture::PictureMut::rgba8(&mut pixels, 320, 240);
    COLOURED
        .variant()
        .draw(&frame, picture, DrawOptions::by(Renderer::fastest()))?;

    let mut file = b"P6\n320 240\n255\n".to_vec();
    file.extend(pixels.iter().flat_map(|[r, g, b, _]| [r, g, b]));
    Ok(std::io::stdout().write_all(&file)?)
}
