//! Compares the lecture's formulas, evaluated in `f64` at the pixel centres of one span, with the
//! methods' pictures. Also tests its statements about triangles, squares and edges.

use crate::support::{floats_on, linear};
use fastphong::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::Material;
use fastphong::picture::LinearPicture;
use fastphong::scene::{Light, Lighting};
use fastphong::shading::{MethodRow, Variant};
use glam::{DVec3, Vec3};

/// The width of the pictures in this module.
pub const WIDTH: u32 = 64;

/// The exponent n of the specular term.
pub const SHININESS: i32 = 20;

pub const LIGHT: DVec3 = DVec3::new(0.36, 0.48, 0.8);
pub const VIEW: DVec3 = DVec3::Z;
pub const AMBIENT: f64 = 0.1;
pub const DIFFUSE: f64 = 0.4;
pub const SPECULAR: f64 = 0.5;

/// The largest difference between a method in `f32` and its formula on a span of [`WIDTH`] pixels
/// and a few rows.
///
/// Each addition of a walk is off by at most 2⁻²⁴. After 64 pixels and 4 rows J, K and each
/// coordinate of N are off by e = 68 · 2⁻²⁴ = 4.1e-6. In 2JK/D, with D over ½ here, J and K
/// contribute 2 · 2e each and D contributes 2 · 2 · √3 e, together less than 15 e. The power
/// multiplies this by n k_s = 10, and the diffuse term adds less than e: 151 e.
pub const TOLERANCE: f64 = 151.0 * 68.0 / (1 << 24) as f64;

pub fn lighting() -> Lighting {
    let material = Material {
        ambient: [AMBIENT as f32; 3],
        diffuse: [DIFFUSE as f32; 3],
        specular: [SPECULAR as f32; 3],
        shininess: SHININESS as f32,
    };
    Lighting::new(
        &material,
        [1.0; 3],
        &[Light::directional(LIGHT, [1.0; 3])],
        VIEW,
    )
}

pub fn frame_of(polygons: &[&[((f64, f64), DVec3)]]) -> Frame {
    frame_lit(lighting(), polygons)
}

pub fn frame_lit(lighting: Lighting, polygons: &[&[((f64, f64), DVec3)]]) -> Frame {
    let mut builder = FrameBuilder::new(WIDTH, WIDTH);
    let material = builder.lighting(lighting);
    for (number, corners) in polygons.iter().enumerate() {
        let vertex = |&((x, y), normal): &((f64, f64), DVec3)| Vertex {
            x: SubPixel::from_num(x),
            y: SubPixel::from_num(y),
            depth: 0.5,
            inv_w: 1.0,
            normal: normal.as_vec3().to_array(),
            material,
        };
        let numbers: Vec<u32> = corners
            .iter()
            .map(|corner| builder.vertex(vertex(corner)))
            .collect();
        builder.polygon(&numbers, Vec3::Z.to_array(), number as u32);
    }
    builder.finish().expect("all corners are on the picture")
}

/// Returns the unit normal that leans `right` degrees to the right and `up` degrees upward.
pub fn leaning(right: f64, up: f64) -> DVec3 {
    let (x, y) = (right.to_radians().tan(), up.to_radians().tan());
    DVec3::new(x, y, 1.0).normalize()
}

/// Builds four rows as wide as the picture, with one normal on the left and one on the right: t =
/// (column + ½) / WIDTH.
pub fn strip(left: DVec3, right: DVec3) -> Frame {
    strip_lit(lighting(), left, right)
}

pub fn strip_lit(lighting: Lighting, left: DVec3, right: DVec3) -> Frame {
    let w = f64::from(WIDTH);
    let corners = [
        ((0.0, 0.0), left),
        ((w, 0.0), right),
        ((w, 4.0), right),
        ((0.0, 4.0), left),
    ];
    frame_lit(lighting, &[&corners])
}

/// Evaluates (2.1) with the clamps, from L·N and R·V.
pub fn intensity(l_n: f64, r_v: f64) -> f64 {
    let specular = if l_n > 0.0 {
        SPECULAR * r_v.max(0.0).powi(SHININESS)
    } else {
        0.0
    };
    AMBIENT + DIFFUSE * l_n.max(0.0) + specular
}

/// Evaluates (2.1) as printed, from a unit normal.
fn lit(n: DVec3) -> f64 {
    let r = 2.0 * LIGHT.dot(n) * n - LIGHT;
    intensity(LIGHT.dot(n), r.dot(VIEW))
}

/// Evaluates (4.7) as printed.
fn slerp(n1: DVec3, n2: DVec3, t: f64) -> DVec3 {
    let phi = n1.dot(n2).acos();
    ((1.0 - t) * phi).sin() / phi.sin() * n1 + (t * phi).sin() / phi.sin() * n2
}

/// Returns pairs of normals for strips, up to 65 degrees apart.
pub fn pairs() -> [(DVec3, DVec3); 3] {
    [
        (leaning(-20.0, 10.0), leaning(35.0, -5.0)),
        (leaning(0.0, 0.0), leaning(3.0, 40.0)),
        (leaning(-60.0, 10.0), leaning(5.0, 20.0)),
    ]
}

#[track_caller]
fn check(variant: &str, formula: impl Fn(DVec3, DVec3, f64) -> f64) {
    for (n1, n2) in pairs() {
        let picture = Variant::parse(variant)
            .unwrap()
            .render_linear(&strip(n1, n2))
            .expect("a method for the frame");
        for row in 0..4 {
            for column in 0..WIDTH as usize {
                let t = (column as f64 + 0.5) / f64::from(WIDTH);
                let (found, expected) = (
                    f64::from(picture.get(column, row)[0]),
                    formula(n1, n2, t).min(1.0),
                );
                assert!(
                    (found - expected).abs() < TOLERANCE,
                    "{variant} at {column}, {row}: {found} instead of {expected}"
                );
            }
        }
    }
}

/// Gouraud follows (3.5), (3.6): intensities by (2.1) at the ends, and linear between them.
#[test]
fn gouraud_interpolates_intensities() {
    check("gouraud", |n1, n2, t| {
        (1.0 - t) * lit(n1).min(1.0) + t * lit(n2).min(1.0)
    });
}

/// Naive Phong follows (4.1), (4.2): linear normals, renormalised, and (2.1) at every pixel.
#[test]
fn naive_phong_interpolates_normals() {
    check("naive-phong", |n1, n2, t| {
        lit(((1.0 - t) * n1 + t * n2).normalize())
    });
}

/// Fast Phong follows (4.3), (4.4), (4.6): J and K linear, d = |N|, D = N · N. Three steps of
/// Newton's method leave less than rounding: d changes by less than 3 % per pixel, and e → e²/2
/// twice gives 1e-7.
#[test]
fn fast_phong_is_equation_4_6() {
    check("fast-phong:steps=3", |n1, n2, t| {
        let linear = |from: f64, to: f64| (1.0 - t) * from + t * to;
        let j = linear(LIGHT.dot(n1), LIGHT.dot(n2));
        let k = linear(VIEW.dot(n1), VIEW.dot(n2));
        let d_squared = ((1.0 - t) * n1 + t * n2).length_squared();
        intensity(
            j / d_squared.sqrt(),
            2.0 * j * k / d_squared - LIGHT.dot(VIEW),
        )
    });
}

/// Slerp Phong follows (4.7), (4.8), then (4.5): J and K along the great circle.
#[test]
fn slerp_phong_is_equation_4_5_along_the_great_circle() {
    check("slerp-phong", |n1, n2, t| {
        let n = slerp(n1, n2, t);
        let (j, k) = (LIGHT.dot(n), VIEW.dot(n));
        intensity(j, 2.0 * j * k - LIGHT.dot(VIEW))
    });
}

/// The vector form follows (4.7), (4.8), then (2.1) without renormalising: steps i–iv of section
/// 4.4.
#[test]
fn slerp_phong_vector_is_equation_2_1_along_the_great_circle() {
    check("slerp-phong-vector", |n1, n2, t| lit(slerp(n1, n2, t)));
}

/// Naive Phong must not follow the lecture's summary, which feeds the unit normal back into the
/// sum. Over the 65° of the third pair above the summary is 48 grey levels off at the right end.
#[test]
fn the_summary_of_naive_phong_is_not_section_4_1() {
    let (n1, n2) = (leaning(-60.0, 10.0), leaning(5.0, 20.0));
    let step = (n2 - n1) / f64::from(WIDTH);
    let mut n = (n1 + 0.5 * step).normalize();
    for _ in 1..WIDTH {
        n = (n + step).normalize();
    }
    let t = 1.0 - 0.5 / f64::from(WIDTH);
    let section = ((1.0 - t) * n1 + t * n2).normalize();
    assert!(
        (lit(n) - lit(section)).abs() > 100.0 * TOLERANCE,
        "a test of nothing: {} {}",
        lit(n),
        lit(section)
    );
    let picture = Variant::parse("naive-phong")
        .unwrap()
        .render_linear(&strip(n1, n2))
        .expect("a method for the frame");
    let last = f64::from(picture.get(WIDTH as usize - 1, 0)[0]);
    assert!((last - lit(section)).abs() < TOLERANCE);
}

/// Returns a square that stands on one corner, turned clockwise by `turns` quarter turns, with
/// normals for top, right, bottom and left. No pixel centre lies on its edges or diagonals.
fn square(turns: usize, normals: [DVec3; 4]) -> [((f64, f64), DVec3); 4] {
    let (middle, reach) = (f64::from(WIDTH) / 2.0, 24.25);
    let (low, high) = (middle - reach, middle + reach);
    let places = [(middle, low), (high, middle), (middle, high), (low, middle)];
    std::array::from_fn(|i| (places[(i + turns) % 4], normals[i]))
}

/// Turns the picture back by a quarter turn: the top row becomes the left column, upward.
fn turned_back(picture: &LinearPicture) -> LinearPicture {
    let n = picture.width();
    let pixels = (0..n * n)
        .map(|i| picture.get(n - 1 - i / n, i % n))
        .collect();
    LinearPicture::from_pixels(n, n, pixels).expect("as many pixels as before")
}

fn largest_difference(a: &LinearPicture, b: &LinearPicture) -> f64 {
    let difference = |(x, y): (&[f32; 4], &[f32; 4])| f64::from((x[0] - y[0]).abs());
    a.pixels()
        .iter()
        .zip(b.pixels())
        .map(difference)
        .fold(0.0, f64::max)
}

/// L21 3, Figure 5: turning a square with one different corner by 90° changes its shading. Cut into
/// triangles, the square keeps its shading, because interpolation on triangles is barycentric
/// (Figure 6). Slerp is not affine, so even its triangles change.
#[test]
fn figure_5_turns_the_shading_of_squares_and_not_of_triangles() {
    let normals = [
        leaning(0.0, 0.0),
        leaning(-50.0, 0.0),
        leaning(0.0, 30.0),
        leaning(20.0, -20.0),
    ];
    let turned_difference = |entry: &'static MethodRow, triangles: bool| {
        let picture = |turns: usize| {
            let [a, b, c, d] = square(turns, normals);
            let frame = if triangles {
                frame_of(&[&[a, b, c], &[a, c, d]])
            } else {
                frame_of(&[&[a, b, c, d]])
            };
            linear(entry, &frame)
        };
        largest_difference(&picture(0), &turned_back(&picture(1)))
    };
    for entry in floats_on(&frame_of(&[])) {
        let (square, triangles) = (
            turned_difference(entry, false),
            turned_difference(entry, true),
        );
        match entry.info.name {
            "flat" | "flat-average" => assert_eq!((square, triangles), (0.0, 0.0)),
            "slerp-phong" | "slerp-phong-vector" | "slerp-chebyshev" | "quadratic-normals"
            | "half-reflection" => {
                assert!(square > 0.01 && triangles > 0.001, "{square} {triangles}")
            }
            name => {
                assert!(square > 0.01, "{name}: {square}");
                // Both pictures are within the tolerance of the same formula. The default count of
                // Newton steps leaves e²/2 = 3e-4 of a first step of 2.5 %, and then 5e-8.
                assert!(triangles < 2.0 * TOLERANCE, "{name}: {triangles}");
            }
        }
    }
}

/// L21 3: the picture of a square depends on how it is cut into triangles.
#[test]
fn the_picture_depends_on_the_diagonal() {
    let normals = [
        leaning(0.0, 0.0),
        leaning(-50.0, 0.0),
        leaning(0.0, 30.0),
        leaning(20.0, -20.0),
    ];
    let [a, b, c, d] = square(0, normals);
    let one = frame_of(&[&[a, b, c], &[a, c, d]]);
    let other = frame_of(&[&[a, b, d], &[b, c, d]]);
    for entry in floats_on(&one).filter(|entry| entry.info.name != "flat") {
        let draw = |frame: &Frame| linear(entry, frame);
        assert!(
            largest_difference(&draw(&one), &draw(&other)) > 0.01,
            "{}",
            entry.info.name
        );
    }
}
