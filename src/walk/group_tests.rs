//! Walks on groups of eight pixels, on every instruction set that this machine has, against their closed forms and against
//! the same walks one pixel at a time.

use super::*;
use crate::number::{Lanes, LanesJob, Level, on_level};
use crate::test_random::Random;
use std::vec;
use std::vec::Vec;

/// Half a unit in the last place of a number near 1.
const HALF_ULP: f64 = 1.0 / (1u64 << 24) as f64;

/// A walk that a machine can make.
trait Made: Copy {
    /// The planes of what it gives.
    const PLANES: usize;
    fn walk<M: Lanes>(self, m: M, out: &mut [Vec<f32>]);
}

/// So many pixels of a walk, plane by plane.
struct Pixels<W>(W, usize);

impl<W: Made> LanesJob for Pixels<W> {
    type Out = Vec<Vec<f32>>;

    fn run<M: Lanes>(self, m: M) -> Vec<Vec<f32>> {
        let mut planes = vec![vec![0.0; self.1.next_multiple_of(8)]; W::PLANES];
        m.vectorize(|| self.0.walk(m, &mut planes));
        planes.iter_mut().for_each(|plane| plane.truncate(self.1));
        planes
    }
}

/// A walk on a level and one pixel at a time.
fn both<W: Made>(
    walk: W,
    count: usize,
) -> impl Iterator<Item = (Level, Vec<Vec<f32>>, Vec<Vec<f32>>)> {
    let one = on_level(Level::Scalar, Pixels(walk, count));
    Level::available()
        .skip(1)
        .map(move |level| (level, on_level(level, Pixels(walk, count)), one.clone()))
}

/// Stores what a walk gives, one plane for each of `values`.
fn store<M: Lanes, W: Walk, const P: usize>(
    m: M,
    mut walk: W,
    out: &mut [Vec<f32>],
    values: impl Fn(W::Out) -> [M::F; P],
) {
    for x in (0..out[0].len()).step_by(M::WIDTH) {
        for (plane, value) in out.iter_mut().zip(values(walk.next())) {
            m.store(value, &mut plane[x..]);
        }
    }
}

#[derive(Clone, Copy)]
struct Line(f32, f32);

impl Made for Line {
    const PLANES: usize = 1;
    fn walk<M: Lanes>(self, m: M, out: &mut [Vec<f32>]) {
        store(m, Linear::new(m, self.0, self.1), out, |x| [x]);
    }
}

#[derive(Clone, Copy)]
struct Square([f32; 3], [f32; 3]);

impl Made for Square {
    const PLANES: usize = 1;
    fn walk<M: Lanes>(self, m: M, out: &mut [Vec<f32>]) {
        store(m, Quadratic::square(m, self.0, self.1), out, |x| [x]);
    }
}

#[derive(Clone, Copy)]
struct Circle(f32, f32, f32);

impl Made for Circle {
    const PLANES: usize = 2;
    fn walk<M: Lanes>(self, m: M, out: &mut [Vec<f32>]) {
        store(m, Sines::new(m, self.0, self.1, self.2), out, |(a, b)| {
            [a, b]
        });
    }
}

#[derive(Clone, Copy)]
struct Length([f32; 3], [f32; 3], Steps<f32>);

impl Made for Length {
    const PLANES: usize = 2;
    fn walk<M: Lanes>(self, m: M, out: &mut [Vec<f32>]) {
        store(
            m,
            Newton::new(m, self.0, self.1, self.2),
            out,
            |(d, square)| [d, square],
        );
    }
}

#[test]
fn linear_steps_by_groups() {
    let mut random = Random::new(37);
    for _ in 0..50 {
        let (at, step) = (random.signed(), random.signed() / 512.0);
        let most = f64::from(at.abs()).max(f64::from(at + 512.0 * step).abs());
        for (level, group, one) in both(Line(at, step), 512) {
            for (k, (group, one)) in group[0].iter().zip(&one[0]).enumerate() {
                let truth = f64::from(at) + k as f64 * f64::from(step);
                // One addition every eight pixels, and two roundings of the start; one pixel at a time one addition each.
                let bound = |steps: f64| (steps + 2.0) * HALF_ULP * most.max(1e-30);
                let error = (f64::from(*group) - truth).abs();
                assert!(
                    error <= bound((k / 8) as f64),
                    "{level}: {at} {step} at {k}: {error:.1e}"
                );
                assert!((f64::from(*one) - truth).abs() <= bound(k as f64));
            }
        }
    }
}

#[test]
fn quadratic_steps_by_groups() {
    let mut random = Random::new(41);
    for _ in 0..50 {
        let (a, b) = (random.unit(), random.unit());
        let step: [f32; 3] = core::array::from_fn(|i| (b[i] - a[i]) / 512.0);
        let long = |v: [f32; 3]| v.map(f64::from);
        let (a64, step64) = (long(a), long(step));
        for (level, group, one) in both(Square(a, step), 512) {
            for (k, (group, one)) in group[0].iter().zip(&one[0]).enumerate() {
                let truth = (0..3)
                    .map(|i| (a64[i] + k as f64 * step64[i]).powi(2))
                    .sum::<f64>();
                // As documented: three roundings a step, beside those of the start, ΔQ · 4 / n by four roundings k times,
                // and 2 s = 8 / n² by four roundings k² / 2 times. A group takes a step for eight pixels, of eight times ΔQ.
                let bound = |steps: f64, k: f64| {
                    let n = 512.0;
                    HALF_ULP * (3.0 * steps + 8.0 + 16.0 * k / n + 16.0 * (k / n) * (k / n))
                };
                let k64 = k as f64;
                let error = (f64::from(*group) - truth).abs();
                assert!(
                    error <= bound(k64 / 8.0, k64),
                    "{level}: {a:?} {b:?} at {k}: {error:.1e}"
                );
                assert!((f64::from(*one) - truth).abs() <= bound(k64, k64));
            }
        }
    }
}

#[test]
fn sines_step_by_groups() {
    for degrees in [1.0f32, 30.0, 120.0, 178.0] {
        let phi = degrees.to_radians();
        let (t0, dt) = (0.4 / 512.0, 1.0 / 512.0);
        for (level, group, one) in both(Circle(phi, t0, dt), 512) {
            for k in 0..512 {
                let t = f64::from(t0) + k as f64 * f64::from(dt);
                let truth = [
                    ((1.0 - t) * f64::from(phi)).sin(),
                    (t * f64::from(phi)).sin(),
                ];
                // As one pixel at a time, 7.5 half units a step: up to seven steps to the lane, then one for each group.
                let bound = |steps: f64| (7.5 * steps + 12.0) * HALF_ULP;
                for i in 0..2 {
                    let error = (f64::from(group[i][k]) - truth[i]).abs();
                    assert!(
                        error <= bound((k / 8 + k % 8) as f64),
                        "{level}: {degrees} at {k}: {error:.1e}"
                    );
                    assert!((f64::from(one[i][k]) - truth[i]).abs() <= bound(k as f64));
                }
            }
        }
    }
}

/// A normal that turns by an angle over so many pixels, and its length at each, in f64.
fn turning(degrees: f32, pixels: usize) -> ([f32; 3], [f32; 3], Vec<f64>) {
    let (sin, cos) = (degrees / 2.0).to_radians().sin_cos();
    let (n, step) = ([-sin, 0.0, cos], [2.0 * sin / pixels as f32, 0.0, 0.0]);
    let at = |k: usize| {
        let x = f64::from(n[0]) + k as f64 * f64::from(step[0]);
        (x * x + f64::from(n[2]).powi(2)).sqrt()
    };
    (n, step, (0..pixels).map(at).collect())
}

/// The largest relative error of a length.
fn worst(lengths: &[f32], truth: &[f64]) -> f64 {
    lengths
        .iter()
        .zip(truth)
        .map(|(d, truth)| (f64::from(*d) / truth - 1.0).abs())
        .fold(0.0, f64::max)
}

/// Whatever the angle and however few the pixels, groups stay within what their guard allows. A true root is one rounding
/// from N·N, whose roundings it halves, and N's own are added.
#[test]
fn guarded_lengths_are_never_far_off() {
    let allowed = f64::from(Newton::<f32>::LARGEST_ERROR);
    let mut most = 0.0f64;
    let fewest = Steps::within(Newton::<f32>::LARGEST_ERROR, &|x| x);
    for steps in (1..=3).map(Steps::Fixed).chain([fewest]) {
        for degrees in [1.0f32, 10.0, 30.0, 60.0, 90.0, 120.0, 150.0, 170.0, 179.0] {
            for pixels in [8, 9, 16, 24, 40, 64, 200, 1000] {
                let (n, step, truth) = turning(degrees, pixels);
                for (level, group, _) in both(Length(n, step, steps), pixels) {
                    let error = worst(&group[0], &truth);
                    // N is off by a rounding for each group and two for the start; it is as short as cos(φ/2).
                    let shortest = truth.iter().copied().fold(1.0, f64::min);
                    let rounding = HALF_ULP * (6.0 + 2.0 * (pixels as f64 / 8.0 + 2.0) / shortest);
                    assert!(
                        error <= allowed + rounding,
                        "{level}: {steps:?}, {degrees} over {pixels}: {error:.1e}"
                    );
                    most = most.max(error);
                }
            }
        }
    }
    assert!(
        most > allowed / 100.0,
        "some span comes near the guard: {most:.1e}"
    );
}

/// 120° over 16 pixels: one pixel at a time the lecture's method is off by far more than a group may be, which has true
/// roots there; 15° over 64 pixels is safe, and groups follow Newton's method, from above.
#[test]
fn where_groups_would_be_off_they_have_true_roots() {
    let (n, step, truth) = turning(120.0, 16);
    for (level, group, one) in both(Length(n, step, Steps::Fixed(1)), 16) {
        let (group, one) = (worst(&group[0], &truth), worst(&one[0], &truth));
        assert!(group < 12.0 * HALF_ULP, "{level}: {group:.1e}");
        assert!(
            one > 1e-3,
            "one pixel at a time nothing is guarded: {one:.1e}"
        );
    }
    let (n, step, truth) = turning(15.0, 64);
    for (level, group, _) in both(Length(n, step, Steps::Fixed(1)), 64) {
        // At the ends the length changes by sin 7.5° |ΔN| a pixel, |ΔN| = 2 sin 7.5° / 64, and a group is eight pixels away:
        // e = 4.3e-3, of which a step leaves e²/2 = 9.1e-6, far above rounding; half a group inside of the end it is less.
        let error = worst(&group[0], &truth);
        assert!((4e-6..9.3e-6).contains(&error), "{level}: {error:.1e}");
    }
}

/// A normal that vanishes inside of a span has length 0 there, by roots; nothing else is no number.
#[test]
fn a_normal_that_vanishes_is_guarded() {
    let (n, step) = ([-1.0f32, 0.0, 0.0], [1.0 / 8.0, 0.0, 0.0]);
    for (level, group, _) in both(Length(n, step, Steps::Fixed(2)), 17) {
        let expected: Vec<f32> = (0..17).map(|k| (k as f32 / 8.0 - 1.0).abs()).collect();
        assert_eq!(group[0], expected, "{level}");
    }
    for (level, group, _) in both(Length([0.0, 0.6, 0.8], [0.0; 3], Steps::Fixed(2)), 24) {
        assert!(
            group[0]
                .iter()
                .all(|d| (d - 1.0).abs() <= 2.0 * f32::EPSILON),
            "{level}: a normal that stays"
        );
    }
}
