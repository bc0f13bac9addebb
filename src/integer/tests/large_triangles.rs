//! Triangles of any size that fits, even thin ones, with any normals: nothing overflows, and every
//! pixel is close to the exact colour of its normal.

use super::super::*;
use super::closed_form::*;
use fixed::types::{I17F15, I24F8};
use std::{vec, vec::Vec};

/// Corners in sub-pixels.
type Places = [[i32; 2]; 3];

fn doubled_area(t: Places) -> i64 {
    let [a, b, c] = t.map(|p| p.map(i64::from));
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

/// Sizes of pictures: long rows, long columns, and a square.
const SIZES: [[usize; 2]; 4] = [[1024, 4], [64, 64], [4, 1024], [300, 10]];

/// Returns a triangle near a picture that faces the eye, from the size of a pixel to the largest
/// that fits.
fn any_places(random: &Random, [width, height]: [usize; 2]) -> Places {
    let reach = 2f64.powf(11.0 * random.next());
    let centre = [width, height].map(|side| random.next() * side as f64);
    let mut t = [(); 3].map(|()| {
        [0, 1].map(|i| {
            let at = centre[i] + (random.next() - 0.5) * reach;
            (at.clamp(-1024.0, 1024.0) * 256.0) as i32
        })
    });
    match (random.next() * 10.0) as usize {
        // Thin: a corner lies beside the side between both others.
        0 | 1 => {
            let along = random.next();
            let aside = || (random.next() * 9.0) as i32 - 4;
            let between = |i: usize| t[0][i] + (f64::from(t[1][i] - t[0][i]) * along) as i32;
            t[2] = [between(0) + aside(), between(1) + aside()];
            t[2] = t[2].map(|x| x.clamp(-262_144, 262_144));
        }
        // Corners as far out as is allowed.
        2 => {
            for p in &mut t {
                let end = |x: i32| {
                    if random.next() < 0.5 {
                        x.signum() * 262_144
                    } else {
                        x
                    }
                };
                *p = p.map(end);
            }
        }
        _ => {}
    }
    if doubled_area(t) < 0 {
        t.swap(1, 2);
    }
    t
}

fn vertices(places: Places, normals: [Vector; 3], depths: [u16; 3]) -> [Vertex; 3] {
    [0, 1, 2].map(|i| Vertex {
        x: I24F8::from_bits(places[i][0]),
        y: I24F8::from_bits(places[i][1]),
        depth: depths[i],
        normal: normals[i],
    })
}

type Draw = fn(&mut Canvas<'_, Uncut>, &[Vertex; 3], &[Light<'_, Uncut>; 1], [u32; 3]);

const METHODS: [Draw; 6] = [
    |c, t, l, _| _ = c.naive::<Reflection, false, 1>(t, l),
    |c, t, l, _| _ = c.fast::<Reflection, false, 1>(t, l),
    |c, t, l, _| _ = c.naive::<Halfway, true, 1>(t, l),
    |c, t, l, _| _ = c.fast::<Halfway, true, 1>(t, l),
    |c, t, l, _| _ = c.quadratic::<Reflection, 1>(t, l),
    |c, t, _, k| _ = c.gouraud(&[(t[0], k[0]), (t[1], k[1]), (t[2], k[2])]),
];

/// The channels of a colour in fields: their lowest bits and widths.
const CHANNELS: [(u32, u32); 3] = [(11, 9), (21, 10), (0, 9)];

fn channels(fields: u32) -> [i32; 3] {
    CHANNELS.map(|(at, width)| (fields >> at & ((1 << width) - 1)) as i32)
}

#[test]
fn triangles_of_any_size_with_any_normals_do_not_overflow() {
    let random = Random::new(77);
    let mut seen = 0;
    for round in 0..12_000 {
        let size = SIZES[round % 4];
        let places = any_places(&random, size);
        let first = match (random.next() * 4.0) as usize {
            0 => [0.0, 0.0, 1.0],
            1 => [1.0, 0.0, 0.0],
            _ => random.unit(),
        };
        let angle = [5.0, 40.0, 90.0, 180.0][(random.next() * 4.0) as usize];
        let length = [1.0, 1.0003, 0.1, 70_000.0 * random.next()][(random.next() * 4.0) as usize];
        let made =
            |v: V| Vector::new(v.map(|x| I17F15::from_bits((x * length * 32768.0).round() as i32)));
        let normals = [
            made(first),
            made(random.aside(first, angle * random.next())),
            made(random.aside(first, angle * random.next())),
        ];
        let depths = [(); 3].map(|()| (random.next() * 65_536.0) as u16);
        let t = vertices(places, normals, depths);
        let toward = random.aside(first, 60.0 * random.next());
        let lights = [Light::new(made(toward), made(random.unit()), &UNCUT)];
        // Any bits, because guards and unused bits are ignored.
        let colours = [(); 3].map(|()| match (random.next() * 3.0) as usize {
            0 => 0,
            1 => u32::MAX,
            _ => (random.next() * 4_294_967_296.0) as u32,
        });
        let (mut pixels, mut depth) = (Vec::new(), Vec::new());
        for draw in METHODS {
            pixels.clear();
            pixels.resize(size[0] * size[1], Uncut(0));
            depth.clear();
            depth.resize(size[0] * size[1], 65_535);
            let depth = (round % 3 == 0).then_some(&mut depth[..]);
            let mut canvas = Canvas::new(&mut pixels, depth, size[0], size[1]).expect("it fits");
            draw(&mut canvas, &t, &lights, colours);
            seen += pixels.iter().filter(|p| **p != Uncut(0)).count();
        }
        // The last method was Gouraud shading. No channel leaves the range of its corners by more
        // than planes round, so none carries into its neighbour.
        for pixel in pixels.iter().filter(|p| **p != Uncut(0)) {
            let [corners, found] = [colours.map(channels), [channels(pixel.0); 3]];
            for c in 0..3 {
                let [a, b, d] = corners.map(|corner| corner[c]);
                let inside = a.min(b).min(d) - 3..=a.max(b).max(d) + 3;
                assert!(
                    inside.contains(&found[0][c]),
                    "{t:?} {colours:x?}: {pixel:x?}"
                );
            }
        }
    }
    assert!(seen > 1_000_000, "{seen}");
}

/// The rounding of ΔN adds up over 128 pixels. Without the scale of 255/256, D would exceed the
/// room in its table of roots here.
#[test]
fn d_stays_in_its_table_over_long_rows_of_large_triangles() {
    let places = [[72_805, 50_806], [-26_933, -35_253], [93_619, 5_019]];
    let normals = [
        [-29_836, -12_974, 3_901],
        [-29_795, -13_070, 3_893],
        [-29_766, -13_116, 3_963],
    ];
    let normals = normals.map(|n| Vector::new(n.map(I17F15::from_bits)));
    let light = [Light::new(normals[0], normals[0], &UNCUT)];
    let mut pixels = vec![Uncut(0); 1024 * 240];
    let mut canvas = Canvas::new(&mut pixels, None, 1024, 240).expect("it fits");
    canvas.fast::<Reflection, false, 1>(&vertices(places, normals, [0; 3]), &light);
    // Normals are within half a degree of the light and the eye.
    let drawn = pixels.iter().filter(|p| **p != Uncut(0));
    assert!(drawn.clone().count() > 10_000);
    let least = drawn.map(|pixel| pixel.red()).fold(255.0, f64::min);
    assert!(least > 245.0, "{least}");
}

#[cfg(feature = "alloc")]
#[test]
fn triangles_of_any_size_are_within_their_bounds() {
    let random = Random::new(79);
    let bound = ErrorBound {
        diffuse: DIFFUSE,
        highlight: HIGHLIGHT,
        shininess: SHININESS,
        angle: 90f64.to_radians(),
        pixels: 1024,
        is_refined: false,
        is_parabola: false,
        is_halfway: false,
        is_slerp: false,
    };
    let (limit, _) = bound.parts::<Uncut>();
    let (mut worst, mut seen) = ([0.0f64; 2], 0);
    for round in 0..6000 {
        let size = SIZES[round % 4];
        let places = any_places(&random, size);
        let first = random.unit();
        let second = || vector(random.aside(first, 45.0 * random.next()));
        let normals = [vector(first), second(), second()];
        let t = vertices(places, normals, [0; 3]);
        let eye = random.unit();
        let toward = random.aside(eye, 60.0 * random.next());
        let lights = [Light::new(vector(toward), vector(eye), &UNCUT)];
        let area = doubled_area(places) as f64;
        for (method, draw) in METHODS[..2].iter().enumerate() {
            let mut pixels = vec![Uncut(0); size[0] * size[1]];
            let mut canvas = Canvas::new(&mut pixels, None, size[0], size[1]).expect("it fits");
            draw(&mut canvas, &t, &lights, [0; 3]);
            for (i, pixel) in pixels.iter().enumerate().filter(|(_, p)| **p != Uncut(0)) {
                let at = [i % size[0], i / size[0]].map(|x| 256 * x as i32 + 128);
                let [a, b, c] = places;
                let w = [[at, b, c], [a, at, c], [a, b, at]].map(|t| doubled_area(t) as f64 / area);
                let n = [0, 1, 2].map(|k| (0..3).map(|i| w[i] * float(normals[i])[k]).sum::<f64>());
                let n = normalized(n);
                if dot(toward, n).abs() < 0.01 {
                    continue;
                }
                seen += 1;
                let error = (pixel.red() - lit(n, &[(toward, eye)], Kind::Reflection)).abs();
                worst[method] = worst[method].max(error);
            }
        }
    }
    assert!(
        worst.iter().all(|worst| *worst < limit),
        "{worst:?}, not {limit}"
    );
    assert!(seen > 1_000_000, "{seen}");
}
