//! Shaders from outside the crate: colours that are no sums of lights, panics, and drawing inside.

use crate::support::renderers::{name, on_threads, renderers};
use fastphong::frame::Frame;
use fastphong::mesh::Material;
use fastphong::mesh::builtin::builtin;
use fastphong::number::{Num, Real, Vec3, vec3};
use fastphong::picture::{Encoding, Picture8, PictureMut};
use fastphong::raster::{DrawError, DrawOptions, Renderer};
use fastphong::scene::{Interpolation, Light, Scene, SpecularModel};
use fastphong::shading::{
    Carries, Constant, Corners, Info, LightAt, Linear, MethodRow, Needs, Normal, Pixel,
    ProductsAndNormal, Shader, ShadingRate, Span, SpanShader, SpanShaderError, SpanVertex, Varying,
    methods,
};
use glam::DVec3;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// Makes a shader that interpolates normals and whose `shade` is an expression.
macro_rules! shader {
    ($name:ident, $row:ident, |$lit:ident, $n:ident| $colour:expr) => {
        #[derive(Clone, Copy, Default)]
        struct $name;

        static $row: MethodRow = MethodRow::of::<$name>();

        impl Shader for $name {
            const INFO: Info = Info {
                name: stringify!($name),
                ..Info::OF_PIXELS
            };
            type Constants<F: Num> = ();
            type Carries = Normal;
            type Walk<F: Num> = Linear<Vec3<F>>;

            #[inline(always)]
            fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
                span.linear()
            }
            #[inline(always)]
            fn shade<F: Num>(self, $lit: &LightAt<'_, F>, $n: Vec3<F>) -> Vec3<F> {
                $colour
            }
        }
    };
}

/// Returns the same value in each channel.
fn grey<F: Num>(value: F) -> Vec3<F> {
    vec3([value; 3])
}

shader!(Normals, NORMALS, |_lit, n| n.unit() * n.x.broadcast(0.5)
    + grey(n.x.broadcast(0.5)));
shader!(Constants, CONSTANTS, |_lit, n| vec3([
    n.x.broadcast(0.25),
    n.x.broadcast(2.0),
    n.x.broadcast(-1.0)
]));
shader!(Glow, GLOW, |lit, n| lit.shade(n.unit())
    * n.x.broadcast(0.5)
    + grey(n.x.broadcast(0.3)));
// Reinhard's tone curve c / (1 + c).
shader!(Tones, TONES, |lit, n| {
    let one = n.x.broadcast(1.0);
    let Vec3 { x, y, z } = lit.shade(n.unit());
    vec3([x / (x + one), y / (y + one), z / (z + one)])
});
shader!(Square, SQUARE, |lit, n| {
    let Vec3 { x, y, z } = lit.shade(n.unit());
    vec3([x * x, y * y, z * z])
});
// Beyond what an `i32` holds, and no number at all.
shader!(Blinding, BLINDING, |_lit, n| vec3([
    n.x.broadcast(1e30),
    n.x.broadcast(f32::INFINITY),
    n.x.broadcast(f32::NAN)
]));
shader!(Summing, SUMMING, |lit, n| lit.shade(n.unit()));

/// Normals as colours, computed once per vertex or once per polygon.
#[derive(Clone, Copy, Default)]
struct Early<const BY_POLYGON: bool>;

static BY_VERTEX: MethodRow = MethodRow::of::<Early<false>>();
static BY_POLYGON: MethodRow = MethodRow::of::<Early<true>>();

impl<const BY_POLYGON: bool> Shader for Early<BY_POLYGON> {
    const INFO: Info = Info {
        name: "early",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        shading_rate: if BY_POLYGON {
            ShadingRate::Polygon
        } else {
            ShadingRate::Vertex
        },
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = Linear<Vec3<F>>;

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, colour: Pixel<Self, F>) -> Vec3<F> {
        colour
    }
}

impl<const BY_POLYGON: bool> Carries for Early<BY_POLYGON> {
    type Varying<F: Num> = Vec3<F>;

    #[inline(always)]
    fn vertex<F: Num>(_: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
        n * n.x.broadcast(0.5) + grey(n.x.broadcast(0.5))
    }
}

/// Builds a ball of quadrangles and triangles, 64 × 48 pixels, after a change of its scene.
fn ball(change: impl FnOnce(&mut Scene)) -> Frame {
    let mut scene = Scene::of_mesh(builtin("sphere?rings=8&segments=12").expect("a mesh"));
    (scene.width, scene.height) = (64, 48);
    change(&mut scene);
    scene.frame().expect("a frame")
}

/// Where pictures store bytes, the row engine draws what `shade` returns, as the span engine does,
/// also if colours are not sums of lights.
#[test]
fn colours_that_are_no_sums_of_lights_are_equal_in_all_engines() {
    let frames = [
        ("plain", ball(|_| ())),
        (
            "N·H",
            ball(|scene| {
                scene.objects[0].material = Some(Material {
                    shininess: 7.5,
                    ..Material::default()
                });
                scene.specular = SpecularModel::Blinn;
            }),
        ),
        (
            "near light",
            ball(|scene| {
                let place = scene.camera.eye + DVec3::new(2.0, 1.5, 0.5);
                scene.lights = vec![Light::positional(place, [0.8; 3])];
            }),
        ),
        ("supersampled", ball(|scene| scene.samples = 2)),
        ("sRGB", ball(|scene| scene.encoding = Encoding::Srgb)),
        ("dark", ball(|scene| scene.lights.clear())),
    ];
    let mut seen = 0;
    for (kind, frame) in &frames {
        for row in [
            &NORMALS,
            &CONSTANTS,
            &GLOW,
            &TONES,
            &SQUARE,
            &BLINDING,
            &SUMMING,
            &BY_POLYGON,
            &BY_VERTEX,
        ] {
            let variant = row.variant();
            let expected = variant.render(frame).expect("any frame");
            for renderer in renderers() {
                let found = variant.render_with(frame, renderer).expect("any frame");
                for (i, (found, expected)) in
                    found.pixels().iter().zip(expected.pixels()).enumerate()
                {
                    // Engines round varyings and sums otherwise, by far less than a level, which
                    // may decide a level that is rounded.
                    let off = (0..4).map(|c| found[c].abs_diff(expected[c])).max();
                    assert!(
                        off <= Some(1),
                        "{variant}, {kind}, {} at {i}: {found:?}, not {expected:?}",
                        name(renderer)
                    );
                    seen += usize::from(found[3] == 255);
                }
            }
        }
    }
    assert!(seen > 10_000);
}

/// Built-in methods that SIMD draws say that they sum lights, so that their bytes cost nothing
/// more.
#[test]
fn built_in_methods_of_the_row_engine_sum_lights() {
    for row in fastphong::shading::METHODS {
        let info = row.info.name;
        assert!(
            row.needs.sums_lights || row.scalar_only().is_some(),
            "{info}"
        );
    }
}

static PANICS: AtomicBool = AtomicBool::new(false);

shader!(Panicking, PANICKING, |lit, n| {
    assert!(!PANICS.load(Ordering::Relaxed), "a shader's own panic");
    lit.shade(n.unit())
});

/// Draws a frame over a picture and depths that are empty.
fn drawn(row: &'static MethodRow, frame: &Frame, renderer: Renderer) -> (Picture8, Vec<f32>) {
    let (width, height) = (frame.picture_width(), frame.picture_height());
    let mut picture = Picture8::new(width, height, [9; 4]);
    let mut depth = vec![f32::INFINITY; frame.width() * frame.height()];
    let options = DrawOptions::by(renderer).depth(&mut depth);
    let variant = row.variant();
    variant
        .draw(frame, PictureMut::from(&mut picture), options)
        .expect("any frame");
    (picture, depth)
}

/// A panic in a shader leaves nothing behind: the next frames on its thread are drawn as if it had
/// not been.
#[test]
fn the_frame_after_a_panic_is_the_right_one() {
    let one = ball(|_| ());
    // A thin ring in front of which the ball would stand.
    let other = ball(|scene| {
        let ring = builtin("torus?major=0.7&minor=0.1").expect("a mesh");
        scene.objects[0].mesh = ring.into();
    });
    for renderer in renderers() {
        on_threads(1, || {
            let all = || [&PANICKING, methods::GOURAUD].map(|row| drawn(row, &other, renderer));
            let expected = all();
            PANICS.store(true, Ordering::Relaxed);
            let failed = catch_unwind(AssertUnwindSafe(|| drawn(&PANICKING, &one, renderer)));
            PANICS.store(false, Ordering::Relaxed);
            assert!(failed.is_err(), "the shader panics");
            for _ in 0..2 {
                assert!(all() == expected, "{}", name(renderer));
            }
        });
    }
}

static TEXTURE: LazyLock<Picture8> = LazyLock::new(|| {
    let frame = ball(|_| ());
    let texture = methods::PHONG_RSQRT.variant();
    texture
        .render_with(&frame, Renderer::fastest())
        .expect("any frame")
});

shader!(Drawing, DRAWING, |lit, n| {
    let middle = TEXTURE.get(32, 24)[0];
    lit.shade(n.unit()) * n.x.broadcast(f32::from(middle) / 255.0)
});

/// A shader may draw with the library inside, while its own frame is drawn.
#[test]
fn a_shader_may_draw_inside() {
    let frame = ball(|_| ());
    // The last renderer is the first to draw, and so it draws the texture.
    let pictures: Vec<Picture8> = renderers()
        .into_iter()
        .rev()
        .map(|renderer| {
            let drawn = DRAWING.variant().render_with(&frame, renderer);
            drawn.expect("any frame")
        })
        .collect();
    for picture in &pictures {
        let pixels = picture.pixels().iter().zip(pictures[0].pixels());
        assert!(pixels.into_iter().all(|(a, b)| a[0].abs_diff(b[0]) <= 1));
    }
    assert!(pictures[0].get(32, 24)[0] > 0);
}

/// A method with one value per light, compiled for up to `L` lights.
#[derive(Clone, Copy, Default)]
struct Narrow<const L: usize>;

static NARROW: [MethodRow; 2] = [MethodRow::of::<Narrow<2>>(), MethodRow::of::<Narrow<8>>()];

impl<const L: usize> Shader for Narrow<L> {
    const INFO: Info = Info {
        name: "narrow",
        ..Info::OF_PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = ProductsAndNormal<L>;
    type Walk<F: Num> = Linear<Varying<Self, F>>;

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, ((j, _), _): Pixel<Self, F>) -> Vec3<F> {
        lit.lights().fold(lit.ambient(), |colour, light| {
            lit.add_diffuse(colour, &light, j.values[light.index].max(0.0))
        })
    }
}

/// A method refuses frames and spans with more lights than it has values for.
#[test]
fn a_method_refuses_more_lights_than_it_was_compiled_for() {
    let why = "it has values for fewer lights";
    for (row, most) in NARROW.iter().zip([2, 8]) {
        for lights in [0, 1, most, most + 1, 64] {
            let frame = ball(|scene| scene.lights = vec![scene.lights[0]; lights]);
            let expected = (lights > most).then_some(why);
            for renderer in renderers() {
                let drawn = row.variant().render_with(&frame, renderer).err();
                assert_eq!(drawn, expected.map(DrawError::Refused), "{lights} lights");
            }
            let shader =
                SpanShader::new(&row.variant(), &frame.lightings()[0], Interpolation::Screen);
            assert_eq!(shader.err(), expected.map(SpanShaderError::Refused));
        }
    }
}

/// A method with a constant per polygon that says nothing about its spans.
#[derive(Clone, Copy, Default)]
struct ByPolygon;

static CONSTANT: MethodRow = MethodRow::of::<ByPolygon>();

impl Shader for ByPolygon {
    const INFO: Info = Info {
        name: "by-polygon",
        ..Info::OF_PIXELS
    };
    type Constants<F: Num> = Vec3<F>;
    type Carries = Normal;
    type Walk<F: Num> = Constant<Vec3<F>>;

    #[inline(always)]
    fn polygon<R: Real>(self, _: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Vec3<R> {
        polygon.face
    }
    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let Vec3 { x, y, z } = span.constants();
        let zero = lit.zero();
        Constant(vec3([x, y, z].map(|c| zero.of_each(|_| c))))
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, face: Vec3<F>) -> Vec3<F> {
        lit.shade(face)
    }
}

/// The row engine leaves a method to the span engine if its blocks would lack what it reads.
#[test]
fn a_method_with_constants_of_polygons_is_drawn_by_every_renderer() {
    let frame = ball(|_| ());
    let variant = CONSTANT.variant();
    for renderer in renderers() {
        let picture = variant.render_with(&frame, renderer);
        assert_eq!(picture, variant.render(&frame));
        let mut shader = SpanShader::new(&variant, &frame.lightings()[0], Interpolation::Screen)
            .expect("any light")
            .with_simd(renderer.level());
        let end = shader.vertex(SpanVertex::of_normal([0.0, 0.0, 1.0]));
        shader.polygon(&Corners {
            all: &[],
            face: vec3([0.0, 0.0, 1.0]),
            is_whole: true,
            whole: &[],
            mean: vec3([0.0, 0.0, 1.0]),
        });
        let mut colours = [[0.0; 3]; 9];
        shader.shade([(0.0, &end), (9.0, &end)], [0, 0], &mut colours);
        assert!(
            colours
                .iter()
                .all(|colour| *colour == colours[0] && colour[0] > 0.0)
        );
    }
}
