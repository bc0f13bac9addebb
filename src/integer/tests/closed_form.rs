//! The exact picture of a span in `f64`, which uses none of the module's arithmetic.

use super::super::*;
use core::cell::Cell;
use fixed::types::{I17F15, U16F16};

pub(super) type V = [f64; 3];

pub(super) fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
pub(super) fn normalized(v: V) -> V {
    v.map(|x| x / dot(v, v).sqrt())
}
/// Returns the nearest [`Vector`].
pub(super) fn vector(v: V) -> Vector {
    Vector::new(v.map(|x| I17F15::from_bits((x * 32768.0).round() as i32)))
}
pub(super) fn float(v: Vector) -> V {
    v.to_array().map(f64::from)
}

/// A pixel that keeps its fields, from which RGB565 would be cut.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Uncut(pub(super) u32);
impl Pixel for Uncut {
    const BITS: [u32; 3] = [5, 6, 5];
    fn from_fields(fields: u32) -> Self {
        assert_eq!(
            fields & (1 << 31 | 1 << 20 | 1 << 10 | 1 << 9),
            0,
            "guards are clear"
        );
        Self(fields)
    }
}
impl Uncut {
    /// Returns red in grey levels, without the ½ that rounds.
    pub(super) fn red(self) -> f64 {
        ((f64::from(self.0 >> 11 & 511) - 8.0) / (31.0 * 16.0)).min(1.0) * 255.0
    }
}

/// The material of all tests, in all three channels.
pub(super) const AMBIENT: f64 = 0.1;
pub(super) const DIFFUSE: f64 = 0.5;
pub(super) const HIGHLIGHT: f64 = 0.4;
pub(super) const SHININESS: u32 = 32;

const fn channels(x: &str) -> [U16F16; 3] {
    [U16F16::lit(x); 3]
}
pub(super) static UNCUT: Material<Uncut> =
    Material::new(channels("0.1"), channels("0.5"), channels("0.4"), SHININESS);
pub(super) static FULL: Material<Rgb888> =
    Material::new(channels("0.1"), channels("0.5"), channels("0.4"), SHININESS);
pub(super) static SHORT: Material<Rgb565> =
    Material::new(channels("0.1"), channels("0.5"), channels("0.4"), SHININESS);
/// The material of lights after the first: `UNCUT` without ambient colour.
pub(super) static NEXT: Material<Uncut> =
    Material::new(channels("0"), channels("0.5"), channels("0.4"), SHININESS);

/// The highlight of a unit normal: R·V or N·H, or none.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    Reflection,
    Halfway,
    None,
}

/// Returns red in grey levels for a unit normal, summed over lights and clamped.
pub(super) fn lit(n: V, lights: &[(V, V)], kind: Kind) -> f64 {
    let mut sum = AMBIENT;
    for &(l, v) in lights {
        let (j, k) = (dot(l, n), dot(v, n));
        if j <= 0.0 {
            continue;
        }
        let cosine = match kind {
            Kind::Reflection => 2.0 * j * k - dot(l, v),
            Kind::Halfway => dot(normalized([l[0] + v[0], l[1] + v[1], l[2] + v[2]]), n),
            Kind::None => 0.0,
        };
        sum = (sum + DIFFUSE * j).min(1.0);
        sum = (sum + HIGHLIGHT * cosine.max(0.0).powi(SHININESS as i32)).min(1.0);
    }
    255.0 * sum
}

/// Returns N(t) = (1 − t) N_1 + t N_2.
pub(super) fn between(a: V, b: V, t: f64) -> V {
    [0, 1, 2].map(|i| (1.0 - t) * a[i] + t * b[i])
}

/// Returns slerp(N_1, N_2, t) (L21 4.7).
pub(super) fn slerp(a: V, b: V, t: f64) -> V {
    let angle = dot(a, b).min(1.0).acos();
    if angle < 1e-6 {
        return a;
    }
    let (s, e) = (
        ((1.0 - t) * angle).sin() / angle.sin(),
        (t * angle).sin() / angle.sin(),
    );
    [0, 1, 2].map(|i| s * a[i] + e * b[i])
}

/// A pseudorandom sequence of values in 0–1, which depends only on its seed.
pub(in super::super) struct Random(Cell<u64>);
impl Random {
    pub(in super::super) fn new(seed: u64) -> Self {
        Self(Cell::new(seed))
    }
    pub(in super::super) fn next(&self) -> f64 {
        let state = self.0.get().wrapping_mul(6364136223846793005);
        self.0.set(state.wrapping_add(1442695040888963407));
        (self.0.get() >> 11) as f64 / (1u64 << 53) as f64
    }
    pub(super) fn unit(&self) -> V {
        loop {
            let v = [0; 3].map(|_| 2.0 * self.next() - 1.0);
            if (0.01..1.0).contains(&dot(v, v)) {
                return normalized(v);
            }
        }
    }
    /// Returns a unit vector at an angle in degrees from another.
    pub(super) fn aside(&self, v: V, degrees: f64) -> V {
        let other = self.unit();
        let along = dot(v, other);
        let across = [0, 1, 2].map(|i| other[i] - along * v[i]);
        if dot(across, across) < 1e-4 {
            return self.aside(v, degrees);
        }
        let across = normalized(across);
        let (sin, cos) = degrees.to_radians().sin_cos();
        [0, 1, 2].map(|i| cos * v[i] + sin * across[i])
    }
}
