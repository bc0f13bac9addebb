//! Every recurrence against its closed form, on the scalar machine and on one that is four pixels wide.

use super::*;
use crate::number::{Machine, Num, Scalar, dot};
use crate::test_random::Random;
use core::ops::{Add, Div, Mul, Neg, Sub};
use std::vec::Vec;

/// Half a unit in the last place of a number near 1.
const HALF_ULP: f64 = 1.0 / (1u64 << 24) as f64;

/// Four pixels at once in plain arrays: slow, but it shows that walks seed and stride their lanes rightly.
#[derive(Clone, Copy)]
struct Four([f32; 4]);
#[derive(Clone, Copy)]
struct FourWide;

macro_rules! operator {
    ($trait:ident, $name:ident) => {
        impl $trait for Four {
            type Output = Four;
            fn $name(self, o: Four) -> Four {
                Four(core::array::from_fn(|i| self.0[i].$name(o.0[i])))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for Four {
    type Output = Four;
    fn neg(self) -> Four {
        Four(self.0.map(|x| -x))
    }
}

impl Num for Four {
    fn over_sqrt(self) -> Self {
        Four(self.0.map(Num::over_sqrt))
    }
    fn sqrt(self) -> Four {
        Four(self.0.map(Num::sqrt))
    }
    fn max(self, o: Four) -> Four {
        Four(core::array::from_fn(|i| self.0[i].max(o.0[i])))
    }
    fn min(self, o: Four) -> Four {
        Four(core::array::from_fn(|i| self.0[i].min(o.0[i])))
    }
    fn is_over(self, least: Four) -> bool {
        self.0.iter().any(|&x| x > least.0[0])
    }
    fn gate(self, c: Four) -> Four {
        Four(core::array::from_fn(|i| self.0[i].gate(c.0[i])))
    }
    fn powf(self, e: f32) -> Four {
        Four(self.0.map(|x| Num::powf(x, e)))
    }
}

impl Machine for FourWide {
    type One = f32;
    type F = Four;
    const WIDTH: usize = 4;
    fn one(self, x: f32) -> f32 {
        x
    }
    fn splat(self, x: f32) -> Four {
        Four([x; 4])
    }
    fn ramp(self, at: f32, step: f32) -> Four {
        Four(core::array::from_fn(|k| at + k as f32 * step))
    }
    fn stride(self, step: f32) -> Four {
        Four([4.0 * step; 4])
    }
    fn take(self, mut next: impl FnMut() -> f32) -> Four {
        Four(core::array::from_fn(|_| next()))
    }
    fn first(self, x: Four) -> f32 {
        x.0[0]
    }
}

/// The first `count` values of a walk of single numbers, on both machines.
fn scalar(mut walk: impl Walk<Out = f32>, count: usize) -> Vec<f64> {
    (0..count).map(|_| f64::from(walk.next())).collect()
}

fn wide(mut walk: impl Walk<Out = Four>, count: usize) -> Vec<f64> {
    (0..count / 4)
        .flat_map(|_| walk.next().0)
        .map(f64::from)
        .collect()
}

const COUNT: usize = 2048;

#[test]
fn linear_follows_the_line() {
    for (at, step) in [
        (0.0f32, 0.0f32),
        (1.0, -1.0 / 2048.0),
        (-0.7, 0.001),
        (0.25, 3e-5),
    ] {
        let largest = f64::from(at.abs()).max(f64::from(at + 2048.0 * step).abs());
        for values in [
            scalar(Linear::new(Scalar, at, step), COUNT),
            wide(Linear::new(FourWide, at, step), COUNT),
        ] {
            for (k, value) in values.iter().enumerate() {
                let truth = f64::from(at) + k as f64 * f64::from(step);
                // Each addition rounds by half a unit in the last place of a number of at most `largest`;
                // the lanes of a group have two roundings more.
                let bound = (k as f64 + 2.0) * HALF_ULP * 2.0 * largest.max(1e-30);
                assert!(
                    (value - truth).abs() <= bound,
                    "{at} {step} at {k}: {value} is not {truth}"
                );
            }
        }
    }
}

/// A vector along a span: where it starts, and its step a pixel.
type Line = ([f32; 3], [f32; 3]);

/// The values of the dot product of `a` and `b` on both machines, what they should be, and what they may be off by.
fn products(a: Line, b: Line, pixels: usize) -> [Vec<(f64, f64, f64)>; 2] {
    let long = |v: [f32; 3]| v.map(f64::from);
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
    let length = |v: [f32; 3]| dot(long(v), long(v)).sqrt();
    let at = |line: Line, k: f64| -> [f64; 3] {
        core::array::from_fn(|i| long(line.0)[i] + k * long(line.1)[i])
    };
    let truth: Vec<f64> = (0..=pixels)
        .map(|k| dot(at(a, k as f64), at(b, k as f64)))
        .collect();
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most, v| f64::max(most, v.abs()));
    let most = largest(&mut truth.iter().copied());
    let most_step = largest(&mut truth.windows(2).map(|pair| pair[1] - pair[0]));
    let (cross, second) = (
        length(a.0) * length(b.1) + length(a.1) * length(b.0),
        2.0 * length(a.1) * length(b.1),
    );
    // In half units: a dot product of three terms has three roundings of at most the product of the lengths, the first
    // difference is two of them and at most three operations more, the second difference one. Each step then rounds the
    // difference once and Q once, and Q gathers what its differences are off by.
    let bound = |k: f64| {
        let starts = 4.0 * length(a.0) * length(b.0) + 8.0 * k * cross + k * k / 2.0 * 8.0 * second;
        HALF_ULP * (starts + (k + 2.0) * most + k * k / 2.0 * most_step)
    };
    let checked = |values: Vec<f64>| {
        values
            .into_iter()
            .zip(&truth)
            .enumerate()
            .map(|(k, (v, t))| (v, *t, bound(k as f64)))
            .collect()
    };
    [
        checked(scalar(
            Quadratic::product(Scalar, a.0, a.1, b.0, b.1),
            pixels,
        )),
        checked(wide(
            Quadratic::product(FourWide, a.0, a.1, b.0, b.1),
            pixels,
        )),
    ]
}

/// The line from `a` to `b` over `pixels` steps.
fn line(a: [f32; 3], b: [f32; 3], pixels: usize) -> Line {
    (a, core::array::from_fn(|i| (b[i] - a[i]) / pixels as f32))
}

/// Dot products of vectors that grow linearly, by additions only: normals, vectors to lights, both, over 1024 pixels.
#[test]
fn quadratic_follows_the_parabola() {
    const PIXELS: usize = 1024;
    let mut random = Random::new(11);
    let mut tightest = 0.0f64;
    for i in 0..100 {
        let mut vector = |length: f32| random.unit().map(|x| x * length);
        // Normals of length 1, vectors to a light some ten times as long, and one that stays as it is.
        let n = line(vector(1.0), vector(1.0), PIXELS);
        let l = line(vector(10.0), vector(13.0), PIXELS);
        let still = (vector(1.0), [0.0; 3]);
        for (a, b) in [(n, n), (l, l), (n, l), (n, still), (still, still)] {
            for values in products(a, b, PIXELS) {
                assert_eq!(values.len(), PIXELS);
                for (k, (value, truth, bound)) in values.into_iter().enumerate() {
                    let error = (value - truth).abs();
                    assert!(
                        error <= bound,
                        "{i} at {k}: {value} is not {truth} within {bound:.1e}"
                    );
                    tightest = tightest.max(error / bound);
                }
            }
        }
    }
    assert!(
        tightest > 0.05,
        "the bound is twenty times the largest error: {tightest}"
    );
}

/// What the documentation of [`Quadratic`] says of its drift: at most 3 k 2⁻²⁴ of its largest value, on normals that turn
/// by up to 150 degrees, beside the roundings of its start.
#[test]
fn quadratic_drifts_by_three_roundings_a_step() {
    for pixels in [64, 256, 1024] {
        for degrees in [5.0f32, 30.0, 90.0, 150.0] {
            let (sin, cos) = (degrees / 2.0).to_radians().sin_cos();
            let n = line([-sin, 0.0, cos], [sin, 0.0, cos], pixels);
            let values = products(n, n, pixels);
            for (k, &(value, truth, _)) in
                values.iter().flat_map(|values| values.iter().enumerate())
            {
                let k = k as f64;
                // The start: q by three roundings, and ΔQ by four of |ΔQ| ≤ 4 / n, k times.
                let bound = HALF_ULP * (3.0 * k + 4.0 + 4.0 * k * 4.0 / pixels as f64);
                assert!(
                    (value - truth).abs() <= bound,
                    "{degrees} over {pixels} at {k}: {value} is not {truth}"
                );
            }
        }
    }
}

/// A square is the product of a vector with itself; where that vanishes inside a span, it touches zero and returns.
#[test]
fn quadratic_of_a_normal_that_vanishes() {
    let (a, step) = ([-1.0f32, 0.0, 0.0], [1.0 / 32.0, 0.0, 0.0]);
    let square = scalar(Quadratic::square(Scalar, a, step), 65);
    assert_eq!((square[0], square[32], square[64]), (1.0, 0.0, 1.0));
    assert_eq!(
        square,
        scalar(Quadratic::product(Scalar, a, step, a, step), 65)
    );
    assert_eq!(wide(Quadratic::square(FourWide, a, step), 64), square[..64]);
}

#[test]
fn sines_follow_the_circle() {
    for degrees in [1.0f32, 10.0, 45.0, 90.0, 178.0] {
        let phi = degrees.to_radians();
        let (t0, dt) = (0.4 / 2048.0, 1.0 / 2048.0);
        let pairs = [
            {
                let mut walk = Sines::new(Scalar, phi, t0, dt);
                (0..COUNT)
                    .map(|_| walk.next())
                    .map(|(a, b)| (f64::from(a), f64::from(b)))
                    .collect::<Vec<_>>()
            },
            {
                let mut walk = Sines::new(FourWide, phi, t0, dt);
                let groups = (0..COUNT / 4).map(|_| walk.next());
                groups
                    .flat_map(|(a, b)| (0..4).map(move |i| (f64::from(a.0[i]), f64::from(b.0[i]))))
                    .collect()
            },
        ];
        for values in pairs {
            for (k, (rest, done)) in values.iter().enumerate() {
                let t = f64::from(t0) + k as f64 * f64::from(dt);
                let truth = (
                    ((1.0 - t) * f64::from(phi)).sin(),
                    (t * f64::from(phi)).sin(),
                );
                // A step: two products and a sum, three roundings of a vector of length 1, and the two rounded entries
                // of the rotation: under five half units. The angle itself, phi - t0 phi and k dt phi, adds three.
                let bound = (5.0 * k as f64 + 8.0) * HALF_ULP * 1.5;
                assert!(
                    (rest - truth.0).abs() <= bound && (done - truth.1).abs() <= bound,
                    "{degrees} at {k}"
                );
            }
        }
    }
}

#[test]
fn newton_follows_the_root() {
    // 30 degrees over 64 pixels: two steps leave nothing but rounding.
    let (a, b) = (
        [-0.258_819f32, 0.0, 0.965_925_8],
        [0.258_819f32, 0.0, 0.965_925_8],
    );
    let step: [f32; 3] = core::array::from_fn(|i| (b[i] - a[i]) / 64.0);
    let normal = || core::array::from_fn::<_, 3, _>(|i| Linear::new(Scalar, a[i], step[i]));
    let (mut walk, mut line) = (Newton::new(Scalar, a, step, Steps::Fixed(2)), normal());
    for k in 0..64 {
        let n = line.next();
        let truth = f64::from(dot(n, n)).sqrt();
        let (length, squared) = walk.next();
        assert_eq!(squared, dot(n, n));
        // Rounding of one step: four operations on numbers near 1, the correction itself being small: 2 half units.
        assert!(
            (f64::from(length) - truth).abs() <= 4.0 * HALF_ULP,
            "at {k}: {length} is not {truth}"
        );
    }
}

/// One step leaves e²/(2(1+e)) of a relative error e: shown on a length that jumps, not on one that creeps.
#[test]
fn newton_leaves_what_theory_says() {
    for steps in 1..=2 {
        let steps_a_pixel = Steps::Fixed(steps);
        let mut walk = Newton::new(Scalar, [1.0, 0.0, 0.0], [-0.3, 0.0, 0.0], steps_a_pixel);
        assert_eq!(walk.next().0, 1.0, "a true root at the start of a span");
        let (length, _) = walk.next();
        let mut error = 1.0 / 0.7 - 1.0;
        for _ in 0..steps {
            error = error * error / (2.0 * (1.0 + error));
        }
        assert!(
            (f64::from(length) - 0.7 * (1.0 + error)).abs() < 8.0 * HALF_ULP,
            "{steps} steps: {length}"
        );
    }
}

/// From an error at the edge of a threshold so many steps leave what is allowed, and one less leaves more.
#[test]
fn thresholds_are_where_steps_cease_to_suffice() {
    for allowed in [1e-3f32, 1e-4, 1e-5] {
        let Steps::Fewest(thresholds) = Steps::within(allowed, &|x| x) else {
            panic!("the fewest steps");
        };
        let allowed = f64::from(allowed);
        for (i, threshold) in thresholds.into_iter().enumerate() {
            let change = f64::from(threshold).sqrt();
            let mut e = change + allowed * (1.0 + change);
            for _ in 0..i {
                e = e * e / (2.0 * (1.0 - e));
            }
            assert!(
                e > 2.0 * allowed,
                "{i} steps leave {e:.1e} of {allowed:.0e}"
            );
            e = e * e / (2.0 * (1.0 - e));
            // The root is a difference of numbers up to 200 times as large, rounded to 2⁻²⁴, and a step back doubles it.
            assert!(
                (e / allowed - 1.0).abs() < 1e-3,
                "{} steps leave {e:.3e} of {allowed:.0e}",
                i + 1
            );
        }
    }
}

/// A normal that turns by an angle over so many pixels: where it starts, its step, and its lengths in f64.
fn turning(degrees: f32, pixels: usize) -> (Line, Vec<f64>) {
    let (sin, cos) = (degrees / 2.0).to_radians().sin_cos();
    let (n, step) = ([-sin, 0.0, cos], [2.0 * sin / pixels as f32, 0.0, 0.0]);
    let at = |k: usize| {
        let x = f64::from(n[0]) + k as f64 * f64::from(step[0]);
        (x * x + f64::from(cos).powi(2)).sqrt()
    };
    ((n, step), (0..pixels).map(at).collect())
}

fn lengths(line: Line, steps: Steps<f32>, pixels: usize) -> Vec<f32> {
    let mut walk = Newton::new(Scalar, line.0, line.1, steps);
    (0..pixels).map(|_| walk.next().0).collect()
}

/// Whatever the angle, the fewest steps leave at most what is allowed; and from fine spans to coarse ones they are one, two,
/// three, and at last a root.
#[test]
fn the_fewest_steps_suffice() {
    for allowed in [1e-3f32, 1e-3 / 32.0] {
        let fewest = Steps::within(allowed, &|x| x);
        let mut seen = [0; 4];
        for degrees in [
            1.0f32, 10.0, 30.0, 60.0, 90.0, 120.0, 150.0, 170.0, 179.0, 179.9,
        ] {
            for pixels in [1, 2, 3, 4, 6, 9, 16, 40, 200, 1000] {
                let (line, truth) = turning(degrees, pixels);
                let found = lengths(line, fewest, pixels);
                let shortest = truth.iter().copied().fold(1.0, f64::min);
                for (found, truth) in found.iter().zip(&truth) {
                    let error = (f64::from(*found) / truth - 1.0).abs();
                    // N is off by a rounding a pixel, and D, its root and a step by four more.
                    let rounding = HALF_ULP * (8.0 + 2.0 * pixels as f64 / shortest);
                    assert!(
                        error <= f64::from(allowed) + rounding,
                        "{degrees} over {pixels}: {error:.1e}"
                    );
                }
                let same = |steps| found == lengths(line, Steps::Fixed(steps), pixels);
                // Two numbers of steps may round to one result.
                match [1, 2, 3, 0].map(same) {
                    [true, ..] => seen[0] += 1,
                    [_, true, ..] => seen[1] += 1,
                    [_, _, true, _] => seen[2] += 1,
                    [.., true] => seen[3] += 1,
                    _ => panic!("{degrees} over {pixels}: no number of steps"),
                }
            }
        }
        assert!(seen.iter().all(|&count| count > 0), "{allowed}: {seen:?}");
    }
}

/// One step on a fine span and on a normal that stays; roots where the normal vanishes.
#[test]
fn fine_spans_take_one_step_and_cancelling_ones_roots() {
    let fewest = Steps::within(Newton::<f32>::LARGEST_ERROR, &|x| x);
    let (fine, _) = turning(30.0, 64);
    assert_eq!(
        lengths(fine, fewest, 64),
        lengths(fine, Steps::Fixed(1), 64)
    );
    assert_ne!(
        lengths(fine, fewest, 64),
        lengths(fine, Steps::Fixed(2), 64)
    );
    let still = ([0.0, 0.6, 0.8], [0.0; 3]);
    assert_eq!(
        lengths(still, fewest, 8),
        lengths(still, Steps::Fixed(1), 8)
    );
    // The length grows by as much as one step is allowed to follow: it leaves nearly all that is allowed. By more, it is two.
    let error = |growth: f32| {
        let found = lengths(([1.0, 0.0, 0.0], [growth, 0.0, 0.0]), fewest, 2)[1];
        f64::from(found) / (1.0 + f64::from(growth)) - 1.0
    };
    assert!((8e-4..1e-3).contains(&error(0.0426)), "{}", error(0.0426));
    assert!(error(0.0428) < 1e-6, "{}", error(0.0428));
    let vanishing = ([-1.0, 0.0, 0.0], [0.25, 0.0, 0.0]);
    assert_eq!(
        lengths(vanishing, fewest, 6),
        [1.0, 0.75, 0.5, 0.25, 0.0, 0.25]
    );
}

fn edge(a: [f32; 3], b: [f32; 3], rows: usize) -> Vec<[f32; 3]> {
    let face = [0.0, 0.0, 1.0];
    let (t0, dt) = (0.5 / rows as f32, 1.0 / rows as f32);
    let mut walk = UnitNormal::edge(Scalar, face, UnitNormal(a), UnitNormal(b), t0, dt);
    let step = |_| {
        let here = UnitNormal::at(&walk).0;
        <UnitNormal<f32> as Attribute<f32>>::advance(&mut walk);
        here
    };
    (0..rows).map(step).collect()
}

#[test]
fn normals_walk_great_circles_at_uniform_speed() {
    let mut random = Random::new(7);
    for _ in 0..200 {
        let (a, b) = (random.unit(), random.unit());
        let phi = f64::from(dot(a, b)).clamp(-1.0, 1.0).acos();
        if !(0.02..3.1).contains(&phi) {
            continue;
        }
        for (k, n) in edge(a, b, 64).into_iter().enumerate() {
            let t = (k as f64 + 0.5) / 64.0;
            let (wa, wb) = (
                ((1.0 - t) * phi).sin() / phi.sin(),
                (t * phi).sin() / phi.sin(),
            );
            for i in 0..3 {
                let truth = wa * f64::from(a[i]) + wb * f64::from(b[i]);
                // The weights are off by the drift of 64 steps (5 half units each) and by that of phi from rounded
                // unit vectors (8 half units), divided by sin phi; near 180 degrees acos in this test adds as much.
                let bound = (5.0 * 64.0 + 32.0) * HALF_ULP / phi.sin().powi(2);
                assert!(
                    (f64::from(n[i]) - truth).abs() <= bound,
                    "{a:?} {b:?} at {k}: {n:?}, {truth}"
                );
            }
        }
    }
}

#[test]
fn nearly_equal_normals_are_interpolated_linearly() {
    for angle in [0.0f32, 1e-8, 1e-5, 9e-4] {
        let (a, b) = ([0.0, 0.0, 1.0], [angle, 0.0, 1.0]);
        for (k, n) in edge(a, b, 16).into_iter().enumerate() {
            let truth = (k as f32 + 0.5) / 16.0 * angle;
            // The weights' difference from linear ones, 6e-8 of the angle, and 16 steps of rounding.
            assert!(
                (n[0] - truth).abs() <= 1e-5 * angle && (n[2] - 1.0).abs() < 1e-5,
                "{angle} at {k}: {n:?}"
            );
        }
    }
}

#[test]
fn opposite_normals_give_the_face_normal() {
    for b in [[-1.0f32, 0.0, 0.0], [-0.9999, 0.01414, 0.0]] {
        for n in edge([1.0, 0.0, 0.0], b, 16) {
            assert!(
                n[0].abs() + n[1].abs() < 1e-5 && (n[2] - 1.0).abs() < 1e-5,
                "{n:?}"
            );
        }
    }
}
