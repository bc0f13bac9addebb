//! Whole frames of spheres, slivers included, compared with a closed form in `f64`.

use super::super::*;
use super::closed_form::*;
use fixed::types::I24F8;
use std::{format, println, string::String, vec, vec::Vec};

const SIZE: usize = 240;

/// A corner with its exact position and normal.
#[derive(Clone, Copy)]
struct Corner {
    at: [f64; 2],
    depth: f64,
    n: V,
}

/// Returns the triangles of a globe that face the eye, clockwise on the screen.
fn globe(around: usize, down: usize) -> Vec<[Corner; 3]> {
    let corner = |i: usize, j: usize| {
        let (a, b) = (
            core::f64::consts::TAU * (i % around) as f64 / around as f64,
            core::f64::consts::PI * j as f64 / down as f64,
        );
        // Tilted, so that no pole lies at the silhouette.
        let (x, y, z) = (b.sin() * a.cos(), b.cos(), b.sin() * a.sin());
        let (sin, cos) = 0.4f64.sin_cos();
        let n = [x, y * cos - z * sin, y * sin + z * cos];
        let snap = |v: f64| (v * 256.0).round() / 256.0;
        let at = [snap(120.0 + 110.0 * n[0]), snap(120.0 - 110.0 * n[1])];
        Corner {
            at,
            depth: (0.5 - 0.45 * n[2]) * 65535.0,
            n: float(vector(n)),
        }
    };
    let mut all = Vec::new();
    for j in 0..down {
        for i in 0..around {
            let quad = [
                corner(i, j),
                corner(i + 1, j),
                corner(i + 1, j + 1),
                corner(i, j + 1),
            ];
            for t in [[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]] {
                let t = [t[0], t[2], t[1]];
                if area(&t) > 0.0 {
                    all.push(t);
                }
            }
        }
    }
    all
}

fn area(t: &[Corner; 3]) -> f64 {
    let side = |i: usize| [t[i].at[0] - t[0].at[0], t[i].at[1] - t[0].at[1]];
    let (a, b) = (side(1), side(2));
    a[0] * b[1] - b[0] * a[1]
}

fn vertices(t: &[Corner; 3]) -> [Vertex; 3] {
    t.map(|c| Vertex {
        x: I24F8::from_num(c.at[0]),
        y: I24F8::from_num(c.at[1]),
        depth: c.depth as u16,
        normal: vector(c.n),
    })
}

/// Returns the exact weights of a pixel's centre, or `None` if the triangle does not cover it.
fn weights(t: &[Corner; 3], x: usize, y: usize) -> Option<V> {
    let (px, py) = (x as f64 + 0.5, y as f64 + 0.5);
    let edge = |a: &Corner, b: &Corner| {
        (b.at[0] - a.at[0]) * (py - a.at[1]) - (px - a.at[0]) * (b.at[1] - a.at[1])
    };
    // Coordinates are multiples of 2⁻⁸, so all of this is exact. Left and upper edges own their
    // pixels.
    let owns = |a: &Corner, b: &Corner, e: f64| {
        let (dx, dy) = (b.at[0] - a.at[0], b.at[1] - a.at[1]);
        e > 0.0 || e == 0.0 && (dy < 0.0 || dy == 0.0 && dx > 0.0)
    };
    let w = [edge(&t[1], &t[2]), edge(&t[2], &t[0]), edge(&t[0], &t[1])];
    let is_in = owns(&t[1], &t[2], w[0]) && owns(&t[2], &t[0], w[1]) && owns(&t[0], &t[1], w[2]);
    is_in.then(|| w.map(|w| w / area(t)))
}

type Draw = fn(&mut Canvas<'_, Uncut>, &[Vertex; 3], &[Light<'_, Uncut>; 1]) -> bool;

const METHODS: [(&str, Draw); 4] = [
    ("naive", |c, t, l| c.naive::<Reflection, false, 1>(t, l)),
    ("fast", |c, t, l| c.fast::<Reflection, false, 1>(t, l)),
    ("quadratic", |c, t, l| c.quadratic::<Reflection, 1>(t, l)),
    ("gouraud", |c, t, l| {
        c.gouraud(&t.map(|v| (v, colour::<_, Reflection, 1>(l, v.normal))))
    }),
];

/// Draws a globe by a method, and returns its largest and its root mean square error in red.
fn errors(mesh: &[[Corner; 3]], draw: Draw) -> (f64, f64) {
    let (toward, eye) = (float(unit([2, 3, 6])), [0.0, 0.0, 1.0]);
    let lights = [Light::new(vector(toward), unit([0, 0, 1]), &UNCUT)];
    let nothing = Uncut(0);
    let mut pixels = vec![nothing; SIZE * SIZE];
    let mut canvas = Canvas::new(&mut pixels, None, SIZE, SIZE).expect("it fits");
    for t in mesh {
        draw(&mut canvas, &vertices(t), &lights);
    }
    let (mut worst, mut sum, mut count) = (0.0f64, 0.0, 0);
    let mut owner = vec![false; SIZE * SIZE];
    for t in mesh {
        let bound = |i: usize, f: fn(f64, f64) -> f64| {
            (f(f(t[0].at[i], t[1].at[i]), t[2].at[i])).clamp(0.0, SIZE as f64) as usize
        };
        for y in bound(1, f64::min)..(bound(1, f64::max) + 1).min(SIZE) {
            for x in bound(0, f64::min)..(bound(0, f64::max) + 1).min(SIZE) {
                let Some(w) = weights(t, x, y) else {
                    continue;
                };
                assert!(!owner[y * SIZE + x], "pixel {x}, {y} has two owners");
                owner[y * SIZE + x] = true;
                let n = [0, 1, 2].map(|i| w[0] * t[0].n[i] + w[1] * t[1].n[i] + w[2] * t[2].n[i]);
                let exact = lit(normalized(n), &[(toward, eye)], Kind::Reflection);
                let error = (pixels[y * SIZE + x].red() - exact).abs();
                worst = worst.max(error);
                sum += error * error;
                count += 1;
            }
        }
    }
    for (is_owned, pixel) in owner.iter().zip(&pixels) {
        assert_eq!(*is_owned, *pixel != nothing, "coverage is exact");
    }
    (worst, (sum / f64::from(count)).sqrt())
}

#[test]
fn spheres_are_right_to_their_rim() {
    let mut table = String::new();
    let mut is_wrong = false;
    for (around, down, limits) in [
        (12, 8, [3.0, 3.2, 8.5, 110.0]),
        (24, 16, [3.0, 3.0, 3.0, 60.0]),
        (48, 32, [3.0, 3.0, 3.0, 30.0]),
    ] {
        let mesh = globe(around, down);
        assert!(
            mesh.len() > around * (down - 1) * 9 / 10,
            "wound the right way"
        );
        for ((name, draw), limit) in METHODS.into_iter().zip(limits) {
            let (worst, rms) = errors(&mesh, draw);
            // `examples/small/run` reads this line.
            table += &format!("\nframe-error {name} {} {worst:.2} {rms:.2}\n", mesh.len());
            is_wrong |= worst > limit;
        }
    }
    println!("{table}");
    assert!(!is_wrong, "{table}");
}

/// Gouraud shading interpolates the corners' colours, on wide triangles and on slivers.
#[test]
fn gouraud_interpolates_colours() {
    let lights = [Light::new(unit([2, 3, 6]), unit([0, 0, 1]), &UNCUT)];
    let mut worst = 0.0f64;
    for (around, down) in [(12, 8), (48, 32)] {
        for t in globe(around, down) {
            let mut pixels = vec![Uncut(0); SIZE * SIZE];
            let mut canvas = Canvas::new(&mut pixels, None, SIZE, SIZE).expect("it fits");
            let corners = vertices(&t).map(|v| (v, colour::<_, Reflection, 1>(&lights, v.normal)));
            canvas.gouraud(&corners);
            let [a, b, c] = corners.map(|(_, colour)| Uncut(colour).red());
            for (i, pixel) in pixels.iter().enumerate().filter(|(_, p)| **p != Uncut(0)) {
                let w = weights(&t, i % SIZE, i / SIZE).expect("it is covered");
                worst = worst.max((pixel.red() - (w[0] * a + w[1] * b + w[2] * c)).abs());
            }
        }
    }
    // The cut to a field of 9 bits is 0.51 levels. Steps are off by at most 64 units of 16 bits,
    // 0.25 levels.
    assert!((0.3..0.77).contains(&worst), "{worst}");
}

/// Triangles of any shape, even thin as hairs, with any normals: nothing overflows, and every pixel
/// is close to the exact colour of its normal.
#[test]
fn slivers_cannot_overflow() {
    let random = Random::new(21);
    let mut seen = 0;
    for round in 0..4000 {
        let a = [random.next() * 60.0, random.next() * 60.0];
        let far = [random.next() * 60.0, random.next() * 60.0];
        let width = [0.02, 0.2, 1.0, 20.0][round % 4];
        let along = random.next();
        let side = [0, 1].map(|i| a[i] + (far[i] - a[i]) * along + (random.next() - 0.5) * width);
        let corner = |at: [f64; 2], n: V| Corner {
            at: at.map(|x| (x * 256.0).round() / 256.0),
            depth: random.next() * 65535.0,
            n: float(vector(n)),
        };
        let first = random.unit();
        let t = [
            corner(a, first),
            corner(far, random.aside(first, 60.0 * random.next())),
            corner(side, random.aside(first, 60.0 * random.next())),
        ];
        let t = if area(&t) < 0.0 {
            [t[0], t[2], t[1]]
        } else {
            t
        };
        let (toward, eye) = (random.unit(), random.unit());
        let lights = [Light::new(vector(toward), vector(eye), &UNCUT)];
        for (method, (name, draw)) in METHODS.into_iter().enumerate() {
            let mut pixels = vec![Uncut(0); 64 * 64];
            let mut depth = vec![65535; 64 * 64];
            let mut canvas = Canvas::new(&mut pixels, Some(&mut depth), 64, 64).expect("it fits");
            draw(&mut canvas, &vertices(&t), &lights);
            if area(&t) <= 0.0 {
                assert!(pixels.iter().all(|p| *p == Uncut(0)));
                continue;
            }
            for y in 0..64 {
                for x in 0..64 {
                    let Some(w) = weights(&t, x, y) else {
                        assert_eq!(pixels[64 * y + x], Uncut(0));
                        continue;
                    };
                    seen += 1;
                    let z = w[0] * t[0].depth + w[1] * t[1].depth + w[2] * t[2].depth;
                    let error = (f64::from(depth[64 * y + x]) - z).abs();
                    assert!(error < 16.0, "{name}: depth {z} is off by {error}");
                    let n =
                        [0, 1, 2].map(|i| w[0] * t[0].n[i] + w[1] * t[1].n[i] + w[2] * t[2].n[i]);
                    let unit = normalized(n);
                    // Parabolas and Gouraud shading leave out more. At the horizon rounding decides
                    // on which side the light is.
                    if method >= 2 || dot(toward, unit).abs() < 0.01 {
                        continue;
                    }
                    let exact = lit(unit, &[(toward, eye)], Kind::Reflection);
                    let error = (pixels[64 * y + x].red() - exact).abs();
                    assert!(
                        error < 6.0,
                        "{name} {t:?} at {x}, {y}: {error}",
                        t = t.map(|c| (c.at, c.n))
                    );
                }
            }
        }
    }
    assert!(seen > 100_000, "{seen}");
}

#[test]
fn depth_hides_what_is_behind_in_any_order() {
    let light = [Light::new(unit([0, 0, 1]), unit([0, 0, 1]), &UNCUT)];
    let triangle = |depths: [u16; 3], normal: Vector| {
        let at = [[2.0, 2.0], [60.0, 10.0], [20.0, 58.0]];
        [0, 1, 2].map(|i| Vertex {
            x: I24F8::from_num(at[i][0]),
            y: I24F8::from_num(at[i][1]),
            depth: depths[i],
            normal,
        })
    };
    let (a, b) = (
        triangle([1000, 60000, 30000], unit([0, 0, 1])),
        triangle([60000, 1000, 31000], unit([1, 0, 1])),
    );
    let draw = |order: [&[Vertex; 3]; 2]| {
        let mut pixels = vec![Uncut(0); 64 * 64];
        let mut depth = vec![65535; 64 * 64];
        let mut canvas = Canvas::new(&mut pixels, Some(&mut depth), 64, 64).expect("it fits");
        for t in order {
            canvas.fast::<NoHighlight, false, 1>(t, &light);
        }
        pixels
    };
    let picture = draw([&a, &b]);
    assert_eq!(picture, draw([&b, &a]));
    let alone = draw([&a, &a]);
    let differing = picture.iter().zip(&alone).filter(|(p, q)| p != q).count();
    let covered = alone.iter().filter(|p| **p != Uncut(0)).count();
    assert!(
        (covered / 3..covered * 2 / 3).contains(&differing),
        "{differing} of {covered}"
    );
}

/// Convex polygons are drawn, wherever their corners begin. Polygons that triangles around the
/// first corner do not make up are refused.
#[test]
fn polygons_that_do_not_fit_are_refused() {
    let light = [Light::new(unit([0, 0, 1]), unit([0, 0, 1]), &UNCUT)];
    let draw = |places: &[[i32; 2]]| {
        let corners: Vec<Vertex> = (places.iter())
            .map(|&[x, y]| Vertex {
                x: I24F8::from_num(x),
                y: I24F8::from_num(y),
                depth: 0,
                normal: unit([0, 0, 1]),
            })
            .collect();
        let mut pixels = vec![Uncut(0); 64 * 64];
        let mut canvas = Canvas::new(&mut pixels, None, 64, 64).expect("it fits");
        let is_drawn = canvas.naive::<NoHighlight, false, 1>(&corners, &light);
        let covered = pixels.iter().filter(|pixel| **pixel != Uncut(0)).count();
        (is_drawn, covered)
    };
    let mut square = [[8, 8], [40, 8], [40, 40], [8, 40]];
    for _ in 0..4 {
        square.rotate_left(1);
        assert_eq!(draw(&square), (true, 32 * 32));
    }
    // One corner lies within a side, and one is there twice.
    let convex = [[8, 8], [20, 8], [40, 8], [40, 40], [40, 40], [8, 40]];
    assert_eq!(draw(&convex), (true, 32 * 32));
    square.reverse();
    assert_eq!(draw(&square), (true, 0), "it is seen from behind");
    let arrow = [[8, 8], [40, 24], [8, 40], [16, 24]];
    let bow = [[8, 8], [40, 8], [8, 40], [40, 40]];
    let star = [[32, 4], [50, 60], [4, 24], [60, 24], [14, 60]];
    let far = [[8, 8], [2000, 8], [8, 40]];
    let refused: [&[[i32; 2]]; 4] = [&arrow, &bow, &star, &far];
    for places in refused {
        assert_eq!(draw(places), (false, 0), "{places:?}");
    }
}

#[test]
fn canvases_that_do_not_fit_are_refused() {
    let mut pixels = [Rgb565(0); 12];
    assert!(Canvas::new(&mut pixels, None, 4, 3).is_some());
    assert!(Canvas::new(&mut pixels, None, 5, 3).is_none());
    assert!(Canvas::new(&mut pixels, None, 12, 0).is_none());
    assert!(Canvas::new(&mut pixels, Some(&mut [0; 11]), 4, 3).is_none());
}
