//! Checks each published method that is not in the lecture against its own formula, evaluated in
//! `f64` one pixel at a time.

use super::lecture::{
    AMBIENT, DIFFUSE, LIGHT, SHININESS, SPECULAR, TOLERANCE, VIEW, WIDTH, frame_of, intensity,
    leaning, lighting, pairs, strip_lit,
};
use fastphong::frame::{FrameBuilder, SubPixel, Vertex};
use fastphong::picture::LinearPicture;
use fastphong::scene::{Interpolation, Lighting, SpecularModel};
use fastphong::shading::Variant;
use glam::DVec3;

/// Draws strips by a method, and compares their pixels with a formula of both normals and t.
#[track_caller]
fn check(variant: &str, lighting: &Lighting, formula: impl Fn(DVec3, DVec3, f64) -> f64) {
    for (n1, n2) in pairs() {
        let frame = strip_lit(lighting.clone(), n1, n2);
        let picture = Variant::parse(variant)
            .unwrap()
            .render_linear(&frame)
            .expect("a method for the frame");
        compare(variant, &picture, |x, _| {
            Some(formula(n1, n2, x / f64::from(WIDTH)))
        });
    }
}

/// Compares the pixels of the first four rows, or all covered pixels, with a formula of column and
/// row.
#[track_caller]
fn compare(variant: &str, picture: &LinearPicture, formula: impl Fn(f64, f64) -> Option<f64>) {
    let mut compared = 0;
    for y in 0..picture.height() {
        for (x, pixel) in picture.row(y).iter().enumerate() {
            let Some(expected) = formula(x as f64 + 0.5, y as f64 + 0.5) else {
                continue;
            };
            if pixel[3] == 0.0 {
                continue;
            }
            compared += 1;
            let (found, expected) = (f64::from(pixel[0]), expected.clamp(0.0, 1.0));
            assert!(
                (found - expected).abs() < TOLERANCE,
                "{variant} at {x}, {y}: {found} instead of {expected}"
            );
        }
    }
    assert!(compared >= 4 * WIDTH, "{compared} pixels");
}

fn lerp(a: DVec3, b: DVec3, t: f64) -> DVec3 {
    (1.0 - t) * a + t * b
}

/// Returns the colour by (4.5) from J and K.
fn products(j: f64, k: f64) -> f64 {
    intensity(j, 2.0 * j * k - LIGHT.dot(VIEW))
}

/// Returns 1/√D by the polynomial of `order` for a strip of these normals: see
/// `src/shading/methods/hybrids/adaptive_plan.rs` (d).
fn polynomial(order: u32, n1: DVec3, n2: DVec3, d: f64) -> f64 {
    let low = 1.0 - (n1 - n2).length_squared() / 4.0;
    let (middle, x) = ((1.0 + low) / 2.0, (1.0 - low) / (1.0 + low));
    let y = d / middle - 1.0;
    let value = match order {
        1 => 1.0 + 3.0 / 16.0 * x * x - (0.5 + 15.0 / 64.0 * x * x) * y,
        _ => {
            let [a, b, c] = [
                1.0 - 35.0 / 1024.0 * x.powi(4),
                0.5 + 15.0 / 64.0 * x * x,
                0.375 + 35.0 / 128.0 * x * x,
            ];
            a - b * y + c * y * y
        }
    };
    value / middle.sqrt()
}

/// US patent 5,369,737: J and K are linear, and 1/√D is a polynomial of D.
#[test]
fn series_phong_is_its_polynomial() {
    for order in [1, 2] {
        check(
            &format!("series-phong:order={order}"),
            &lighting(),
            |n1, n2, t| {
                let n = lerp(n1, n2, t);
                let r = polynomial(order, n1, n2, n.length_squared());
                products(LIGHT.dot(n) * r, VIEW.dot(n) * r)
            },
        );
    }
}

/// The line for 1/√D, multiplied out.
#[test]
fn cubic_phong_is_the_line_times_j_and_k() {
    check("cubic-phong", &lighting(), |n1, n2, t| {
        let n = lerp(n1, n2, t);
        let r = polynomial(1, n1, n2, n.length_squared());
        products(LIGHT.dot(n) * r, VIEW.dot(n) * r)
    });
}

/// Hast 2002: the quadratic through the unit normals of both ends and the middle, lit without
/// normalising.
#[test]
fn quadratic_normals_are_the_quadratic_through_three() {
    check("quadratic-normals", &lighting(), |n1, n2, t| {
        let m = (n1 + n2).normalize();
        let n = n1 + (4.0 * m - 3.0 * n1 - n2) * t + 2.0 * (n1 + n2 - 2.0 * m) * t * t;
        products(LIGHT.dot(n), VIEW.dot(n))
    });
}

/// Lyon 1993: highlights from |N − H|² of normals that are not normalised, by his power function.
#[test]
fn difference_vector_is_the_squared_difference() {
    let mut halfway = lighting();
    halfway.specular = SpecularModel::Blinn;
    let h = (LIGHT + VIEW).normalize();
    check("difference-vector:power=lyon:k=3", &halfway, |n1, n2, t| {
        let n = lerp(n1, n2, t);
        let e = (n - h).length_squared();
        let highlight = (1.0 - f64::from(SHININESS) * e / 16.0).max(0.0).powi(8);
        AMBIENT + DIFFUSE * LIGHT.dot(n) + SPECULAR * highlight
    });
}

/// The H-test: diffuse light of vertices, highlights of unit normals. Here all strips have
/// highlights.
#[test]
fn h_test_is_gouraud_with_phongs_highlights() {
    check("h-test", &lighting(), |n1, n2, t| {
        let (j1, j2) = (LIGHT.dot(n1).max(0.0), LIGHT.dot(n2).max(0.0));
        let n = lerp(n1, n2, t).normalize();
        let (j, k) = (LIGHT.dot(n), VIEW.dot(n));
        let highlight = intensity(j, 2.0 * j * k - LIGHT.dot(VIEW)) - intensity(j, 0.0);
        AMBIENT + DIFFUSE * ((1.0 - t) * j1 + t * j2) + highlight
    });
}

/// The normals of triangles whose legs are the picture's left and upper edge, within 40 degrees.
const TURNS: [[(f64, f64); 3]; 2] = [
    [(-15.0, 10.0), (15.0, 12.0), (0.0, -20.0)],
    [(5.0, 0.0), (9.0, 0.0), (5.0, 6.0)],
];

/// Draws triangles by a method, and compares them with products F of the corners' normals and the
/// barycentric coordinates of the second and third corner, with L for J and V for K.
#[track_caller]
fn check_triangle(variant: &str, product: impl Fn(DVec3, [DVec3; 3], [f64; 2]) -> f64) {
    let w = f64::from(WIDTH);
    for turns in TURNS {
        let normals = turns.map(|(right, up)| leaning(right, up));
        let [a, b, c] = normals;
        let frame = frame_of(&[&[((0.0, 0.0), a), ((w, 0.0), b), ((0.0, w), c)]]);
        let picture = Variant::parse(variant)
            .unwrap()
            .render_linear(&frame)
            .expect("a method for the frame");
        compare(variant, &picture, |x, y| {
            let of = |to| product(to, normals, [x / w, y / w]);
            Some(products(of(LIGHT), of(VIEW)))
        });
    }
}

/// Seiler 1998: evaluates Lagrange's quadratic through the products of unit normals at corners and
/// half-way along edges.
fn six_points(
    to: DVec3,
    [a, b, c]: [DVec3; 3],
    [p, q]: [f64; 2],
    midway: fn(DVec3, DVec3) -> DVec3,
) -> f64 {
    let weights = [1.0 - p - q, p, q];
    let corners = [a, b, c]
        .into_iter()
        .zip(weights)
        .map(|(n, b)| to.dot(n) * b * (2.0 * b - 1.0));
    let edges = [(a, b, 0, 1), (b, c, 1, 2), (c, a, 2, 0)]
        .map(|(m, n, i, j)| 4.0 * weights[i] * weights[j] * to.dot(midway(m, n)));
    corners.sum::<f64>() + edges.iter().sum::<f64>()
}

#[test]
fn six_point_is_lagranges_quadratic() {
    check_triangle("six-point", |to, normals, place| {
        six_points(to, normals, place, |m, n| (m + n).normalize())
    });
    check_triangle("six-point:midpoints=barrera", |to, normals, place| {
        six_points(to, normals, place, |m, n| (m + n) * (5.0 - m.dot(n)) / 8.0)
    });
}

/// Bishop, Weimer 1986: Taylor's quadratic of J/|N| about the middle, computed here by second
/// differences of the function itself.
#[test]
fn bishop_weimer_is_taylors_quadratic() {
    check_triangle("bishop-weimer", |to, [a, b, c], [p, q]| {
        let f = |x: f64, y: f64| {
            let (p, q) = (1.0 / 3.0 + x, 1.0 / 3.0 + y);
            to.dot((a * (1.0 - p - q) + b * p + c * q).normalize())
        };
        let h = 1e-3; // off by h²/6 of the third derivative, and by 2⁻⁵³/h² for rounding
        let (x, y) = (p - 1.0 / 3.0, q - 1.0 / 3.0);
        let fx = (f(h, 0.0) - f(-h, 0.0)) / (2.0 * h);
        let fy = (f(0.0, h) - f(0.0, -h)) / (2.0 * h);
        let fxx = (f(h, 0.0) - 2.0 * f(0.0, 0.0) + f(-h, 0.0)) / (h * h);
        let fyy = (f(0.0, h) - 2.0 * f(0.0, 0.0) + f(0.0, -h)) / (h * h);
        let fxy = (f(h, h) - f(h, -h) - f(-h, h) + f(-h, -h)) / (4.0 * h * h);
        f(0.0, 0.0) + fx * x + fy * y + (fxx * x * x + fyy * y * y) / 2.0 + fxy * x * y
    });
}

/// van Overveld, Wyvill 1997: the normalised quadratic through unit normals at corners and
/// reflected normals half-way along edges. It is a quadratic in space, also where corners have
/// perspective weights.
#[test]
fn biquadratic_normals_are_reflected_half_way() {
    let w = f64::from(WIDTH);
    let normals = [
        leaning(-15.0, 10.0),
        leaning(15.0, 12.0),
        leaning(0.0, -20.0),
    ];
    let points = [
        DVec3::new(-1.0, 1.0, 0.3),
        DVec3::new(1.0, 1.0, -0.2),
        DVec3::new(-1.0, -1.0, 0.0),
    ];
    for weights in [[1.0f32; 3], [0.5, 1.0, 0.75]] {
        let mut builder = FrameBuilder::new(WIDTH, WIDTH);
        let material = builder.lighting(lighting());
        builder.interpolation(Interpolation::Perspective);
        let places = [(0.0, 0.0), (w, 0.0), (0.0, w)];
        let corners = [0, 1, 2].map(|i| {
            let [x, y] = [places[i].0, places[i].1].map(SubPixel::from_num);
            let corner = builder.vertex(Vertex {
                x,
                y,
                depth: 0.5,
                inv_w: weights[i].into(),
                normal: normals[i].as_vec3().to_array(),
                material,
            });
            builder.position(corner, points[i].as_vec3().to_array());
            corner
        });
        builder.polygon(&corners, DVec3::Z.as_vec3().to_array(), 0);
        let frame = builder.finish().expect("a frame");
        let variant = Variant::parse("biquadratic-normals").unwrap();
        let midway = |i: usize, j: usize| {
            let (sum, edge) = (normals[i] + normals[j], points[j] - points[i]);
            (sum - 2.0 * edge.dot(sum) / edge.length_squared() * edge).normalize()
        };
        compare(
            "biquadratic-normals",
            &variant
                .render_linear(&frame)
                .expect("a method for the frame"),
            |x, y| {
                let screen = [1.0 - (x + y) / w, x / w, y / w];
                let weighted = [0, 1, 2].map(|i| screen[i] * f64::from(weights[i]));
                let b = weighted.map(|part| part / weighted.iter().sum::<f64>());
                let mut n = DVec3::ZERO;
                for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                    n += normals[i] * b[i] * (2.0 * b[i] - 1.0) + 4.0 * midway(i, j) * b[i] * b[j];
                }
                let n = n.normalize();
                Some(products(LIGHT.dot(n), VIEW.dot(n)))
            },
        );
    }
}
