//! The loops in `f32`, for comparison. A machine without a floating-point unit emulates these.

use crate::{Case, Lights, Shade};
use fastphong::integer::{Rgb565, Vector};

type V = [f32; 3];

const L: V = [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0];
const EYE: V = [0.0, 0.0, 1.0];
const L_V: f32 = 6.0 / 7.0;
const AMBIENT: V = [0.1, 0.06, 0.04];
const DIFFUSE: V = [0.5, 0.3, 0.2];

pub const METHODS: [(&str, Shade<Rgb565>); 3] = [
    ("soft-gouraud", gouraud),
    ("soft-naive", naive),
    ("soft-fast-as-printed", fast_as_printed),
];

fn vector(v: Vector) -> V {
    v.to_array().map(|x| x.to_bits() as f32 / 32768.0)
}
fn dot(a: V, b: V) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A quantity that is stepped by one addition per pixel.
#[derive(Clone, Copy)]
struct Ramp {
    at: f32,
    step: f32,
}

impl Ramp {
    fn new(from: f32, to: f32, part: f32) -> Self {
        Self {
            at: from,
            step: (to - from) * part,
        }
    }
    fn next(&mut self) -> f32 {
        let at = self.at;
        self.at += self.step;
        at
    }
}

/// Returns the pixel of L·N and R·V, with R·V to the power of 32 by five squarings.
fn finish(j: f32, s: f32) -> Rgb565 {
    let j = if j > 0.0 { j } else { 0.0 };
    let mut sum = [0, 1, 2].map(|i| AMBIENT[i] + DIFFUSE[i] * j);
    // Below it the power is under 2⁻⁹, as in the tables.
    if s > 0.823 && j > 0.0 {
        let mut power = s;
        for _ in 0..5 {
            power *= power;
        }
        sum = sum.map(|x| x + 0.4 * power);
    }
    pack(sum)
}
fn pack(colour: V) -> Rgb565 {
    let level = |x: f32, top: f32| (x * top + 0.5) as i32;
    let (r, g, b) = (
        level(colour[0], 31.0),
        level(colour[1], 63.0),
        level(colour[2], 31.0),
    );
    Rgb565((r << 11 | g << 5 | b) as u16)
}

#[inline(never)]
fn gouraud(case: Case, line: &mut [Rgb565], _: &Lights<Rgb565>) {
    let part = 1.0 / line.len() as f32;
    let (a, b) = (vector(case.normals[0]), vector(case.normals[1]));
    let mut channels = [0, 1, 2].map(|i| Ramp::new(a[i].abs(), b[i].abs(), part));
    for pixel in line {
        let [r, g, b] = &mut channels;
        *pixel = pack([r.next(), g.next(), b.next()]);
    }
}

#[inline(never)]
fn naive(case: Case, line: &mut [Rgb565], _: &Lights<Rgb565>) {
    let part = 1.0 / line.len() as f32;
    let (a, b) = (vector(case.normals[0]), vector(case.normals[1]));
    let mut normal = [0, 1, 2].map(|i| Ramp::new(a[i], b[i], part));
    for pixel in line {
        let [x, y, z] = &mut normal;
        let n = [x.next(), y.next(), z.next()];
        let r = 1.0 / libm::sqrtf(dot(n, n));
        let (j, k) = (dot(L, n) * r, dot(EYE, n) * r);
        *pixel = finish(j, 2.0 * j * k - L_V);
    }
}

#[inline(never)]
fn fast_as_printed(case: Case, line: &mut [Rgb565], _: &Lights<Rgb565>) {
    let part = 1.0 / line.len() as f32;
    let (a, b) = (vector(case.normals[0]), vector(case.normals[1]));
    let mut normal = [0, 1, 2].map(|i| Ramp::new(a[i], b[i], part));
    let mut j = Ramp::new(dot(L, a), dot(L, b), part);
    let mut k = Ramp::new(dot(EYE, a), dot(EYE, b), part);
    let mut length = libm::sqrtf(dot(a, a));
    for pixel in line {
        let [x, y, z] = &mut normal;
        let n = [x.next(), y.next(), z.next()];
        let d = dot(n, n);
        length = 0.5 * (length + d / length);
        let (j, k) = (j.next(), k.next());
        *pixel = finish(j / length, 2.0 * j * k / d - L_V);
    }
}
