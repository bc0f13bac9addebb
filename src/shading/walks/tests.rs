//! Compares every recurrence with its closed form: pixel by pixel, and in blocks by the methods'
//! walk kernels.

use super::sines::Sines;
use super::*;
use crate::number::test_random::Random;
use crate::number::{Vec3, vec3};
use std::vec::Vec;

/// Half a unit in the last place of values near 1.
const HALF_ULP: f64 = 1.0 / (1u64 << 24) as f64;

fn values<T: Into<f64>>(mut walk: impl Walk<f32, Pixel = T>, count: usize) -> Vec<f64> {
    (0..count).map(|_| walk.next().into()).collect()
}

#[test]
fn linear_follows_the_line() {
    for (at, step) in [
        (0.0f32, 0.0f32),
        (1.0, -1.0 / 2048.0),
        (-0.7, 0.001),
        (0.25, 3e-5),
    ] {
        let most = f64::from(at.abs()).max(f64::from(at + 2048.0 * step).abs());
        for (k, value) in values(Linear { at, step }, 2048).into_iter().enumerate() {
            let truth = f64::from(at) + k as f64 * f64::from(step);
            // Each addition rounds by half a unit in the last place of a value of at most `most`.
            let bound = (k as f64 + 2.0) * HALF_ULP * 2.0 * most.max(1e-30);
            assert!(
                (value - truth).abs() <= bound,
                "{at} {step} at {k}: {value}, {truth}"
            );
        }
    }
}

#[test]
fn a_pair_remembers_if_either_of_its_walks_does() {
    fn remembers<W: Walk<f32>>() -> bool {
        W::REMEMBERS
    }
    type Plain = Linear<f32>;
    type Newtons = Newton<f32>;
    assert!(remembers::<(Plain, Newtons)>() && remembers::<(Newtons, Plain)>());
    assert!(!remembers::<(Plain, Plain)>());
}

/// A vector along a span: its start and its step per pixel.
type Line = (Vec3<f32>, Vec3<f32>);

/// Returns the line from `a` to `b` over `pixels` steps.
fn line(a: Vec3<f32>, b: Vec3<f32>, pixels: usize) -> Line {
    (a, (b - a) * (1.0 / pixels as f32))
}

fn dot([a, b]: [[f64; 3]; 2]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// Returns the point of a line after k steps, in `f64`.
fn at((from, step): Line, k: usize) -> [f64; 3] {
    let (from, step) = (from.array(), step.array());
    core::array::from_fn(|i| f64::from(from[i]) + k as f64 * f64::from(step[i]))
}

/// Returns the stepped dot products of `a` and `b`, each with its true value and its error bound.
fn products(a: Line, b: Line, pixels: usize) -> Vec<(f64, f64, f64)> {
    let length = |v: Vec3<f32>| dot([v.array().map(f64::from); 2]).sqrt();
    let truth: Vec<f64> = (0..=pixels).map(|k| dot([at(a, k), at(b, k)])).collect();
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most, v| f64::max(most, v.abs()));
    let most = largest(&mut truth.iter().copied());
    let most_step = largest(&mut truth.windows(2).map(|pair| pair[1] - pair[0]));
    let cross = length(a.0) * length(b.1) + length(a.1) * length(b.0);
    let second = 2.0 * length(a.1) * length(b.1);
    // In half units: a dot product of three terms has three roundings of at most the product of the
    // lengths. The first difference is two of them and at most three more operations, the second
    // difference is one. Each step then rounds the difference once and Q once, and Q accumulates
    // the errors of its differences.
    let bound = |k: f64| {
        let starts = 4.0 * length(a.0) * length(b.0) + 8.0 * k * cross + k * k / 2.0 * 8.0 * second;
        HALF_ULP * (starts + (k + 2.0) * most + k * k / 2.0 * most_step)
    };
    let found = values(Quadratic::product(a.0, a.1, b.0, b.1), pixels);
    let checked = found.into_iter().zip(truth).enumerate();
    checked
        .map(|(k, (found, truth))| (found, truth, bound(k as f64)))
        .collect()
}

/// Quadratics step dot products of linear vectors by additions only: normals, light vectors and
/// both, over 1024 pixels.
#[test]
fn quadratic_follows_the_parabola() {
    const PIXELS: usize = 1024;
    let mut random = Random::new(11);
    let mut tightest = 0.0f64;
    for i in 0..100 {
        let mut vector = |length: f32| vec3(random.unit()) * length;
        // Normals of length 1, light vectors some ten times as long, and a constant vector.
        let n = line(vector(1.0), vector(1.0), PIXELS);
        let l = line(vector(10.0), vector(13.0), PIXELS);
        let still = (vector(1.0), vec3([0.0; 3]));
        for (a, b) in [(n, n), (l, l), (n, l), (n, still), (still, still)] {
            for (k, (value, truth, bound)) in products(a, b, PIXELS).into_iter().enumerate() {
                let error = (value - truth).abs();
                assert!(
                    error <= bound,
                    "{i} at {k}: {value}, {truth} within {bound:.1e}"
                );
                tightest = tightest.max(error / bound);
            }
        }
    }
    assert!(
        tightest > 0.05,
        "the bound is twenty times the largest error: {tightest}"
    );
}

/// [`Quadratic`] drifts as documented: by at most 3 k 2⁻²⁴ of its largest value beside the
/// roundings of its start, on normals that turn by up to 150 degrees.
#[test]
fn quadratic_drifts_by_three_roundings_per_step() {
    for pixels in [64, 256, 1024] {
        for degrees in [5.0f32, 30.0, 90.0, 150.0] {
            let n = turning(degrees, pixels).0;
            for (k, (value, truth, _)) in products(n, n, pixels).into_iter().enumerate() {
                let k = k as f64;
                // The start contributes three roundings of q, and four of |ΔQ| ≤ 4 / n in ΔQ, k
                // times.
                let bound = HALF_ULP * (3.0 * k + 4.0 + 4.0 * k * 4.0 / pixels as f64);
                assert!(
                    (value - truth).abs() <= bound,
                    "{degrees} over {pixels} at {k}: {value}, {truth}"
                );
            }
        }
    }
}

/// [`Cubic`] is as far from the cubic as documented, beside the roundings of its coefficients, and
/// not much nearer.
#[test]
fn cubic_drifts_as_its_differences_do() {
    let mut random = Random::new(12);
    let mut tightest = 0.0f64;
    for pixels in [16u32, 64, 256, 1024] {
        for _ in 0..50 {
            let n = pixels as f32;
            let [a, b, c, d] = [1.0, n, n * n, n * n * n].map(|power| random.signed() / power);
            let found = values(Cubic::new([a, b, c, d]), pixels as usize);
            let [a, b, c, d] = [a, b, c, d].map(f64::from);
            let n = f64::from(pixels);
            // Largest values over the span, and of the differences.
            let (value, slope, curve) = (
                a.abs() + (b * n).abs() + (c * n * n).abs() + (d * n * n * n).abs(),
                (b * n).abs() + 2.0 * (c * n * n).abs() + 3.0 * (d * n * n * n).abs(),
                2.0 * (c * n * n).abs() + 6.0 * (d * n * n * n).abs(),
            );
            for (k, found) in found.into_iter().enumerate() {
                let k = k as f64;
                let truth = a + k * (b + k * (c + k * d));
                // A difference is made by three roundings.
                let starts = 3.0 * (slope + curve);
                let bound = HALF_ULP * ((k + 1.0) * (value + slope / 2.0 + curve / 6.0) + starts);
                let error = (found - truth).abs();
                assert!(error <= bound, "{pixels} at {k}: {found}, {truth}");
                tightest = tightest.max(error / bound);
            }
        }
    }
    assert!(tightest > 0.05, "{tightest}");
}

/// A square is the product of a vector with itself. It touches zero and returns if the vector
/// vanishes inside a span.
#[test]
fn quadratic_of_a_normal_that_vanishes() {
    let (a, da) = (vec3([-1.0f32, 0.0, 0.0]), vec3([1.0 / 32.0, 0.0, 0.0]));
    let square = values(Quadratic::square(a, da), 65);
    assert_eq!((square[0], square[32], square[64]), (1.0, 0.0, 1.0));
    assert_eq!(square, values(Quadratic::product(a, da, a, da), 65));
}

#[test]
fn sines_follow_the_circle() {
    for degrees in [1.0f32, 10.0, 45.0, 90.0, 178.0] {
        let (phi, t0, dt) = (degrees.to_radians(), 0.4 / 2048.0, 1.0 / 2048.0);
        let mut walk = Sines::new(phi, t0, dt);
        for k in 0..2048 {
            let t = f64::from(t0) + k as f64 * f64::from(dt);
            let truth = [1.0 - t, t].map(|t| (t * f64::from(phi)).sin());
            // A step takes two products and a sum, three roundings of a vector of length 1, and the
            // two rounded entries of the rotation: under five half units. The angle, phi - t0 phi
            // and k dt phi, adds three.
            let bound = (5.0 * k as f64 + 8.0) * HALF_ULP * 1.5;
            let (rest, done) = walk.next();
            for (found, truth) in [rest, done].into_iter().zip(truth) {
                assert!(
                    (f64::from(found) - truth).abs() <= bound,
                    "{degrees} at {k}"
                );
            }
        }
    }
}

/// Returns a normal that turns by `degrees` over `pixels`, and its lengths in `f64`.
fn turning(degrees: f32, pixels: usize) -> (Line, Vec<f64>) {
    let (sin, cos) = (degrees / 2.0).to_radians().sin_cos();
    let n = (
        vec3([-sin, 0.0, cos]),
        vec3([2.0 * sin / pixels as f32, 0.0, 0.0]),
    );
    (n, (0..pixels).map(|k| dot([at(n, k); 2]).sqrt()).collect())
}

/// Returns lengths by Newton's method, pixel by pixel. 0 steps stand for `auto`.
fn lengths((n, dn): Line, steps: u32, largest_error: f32, pixels: usize) -> Vec<f32> {
    let mut walk = Newton::new(n, dn, &NewtonSteps::new(steps, largest_error));
    (0..pixels).map(|_| walk.next().0).collect()
}

#[test]
fn newton_follows_the_root() {
    // 30 degrees over 64 pixels: after two steps only rounding is left.
    let (n, _) = turning(30.0, 64);
    let mut walk = Newton::new(n.0, n.1, &NewtonSteps::new(2, 1e-3));
    let mut normal = Linear { at: n.0, step: n.1 };
    for k in 0..64 {
        let n: Vec3<f32> = normal.next();
        let truth = f64::from(n.dot(n)).sqrt();
        let (length, square) = walk.next();
        assert_eq!(square, n.dot(n));
        // One step rounds four operations on values near 1. The correction is small, so this is 2
        // half units.
        assert!(
            (f64::from(length) - truth).abs() <= 4.0 * HALF_ULP,
            "at {k}: {length}, {truth}"
        );
    }
}

/// One step reduces a relative error e to e²/(2(1+e)). The length jumps here, so that e is visible.
#[test]
fn newton_reduces_errors_as_derived() {
    for steps in 1..=2 {
        let jumping = (vec3([1.0, 0.0, 0.0]), vec3([-0.3, 0.0, 0.0]));
        let found = lengths(jumping, steps, 1e-3, 2);
        assert_eq!(found[0], 1.0, "a true root at the start of a span");
        let mut error = 1.0 / 0.7 - 1.0;
        for _ in 0..steps {
            error = error * error / (2.0 * (1.0 + error));
        }
        let truth = 0.7 * (1.0 + error);
        assert!(
            (f64::from(found[1]) - truth).abs() < 8.0 * HALF_ULP,
            "{steps} steps: {found:?}"
        );
    }
}

/// Starting from an error at a threshold, `steps` steps leave the allowed error and one step less
/// leaves more.
#[test]
fn thresholds_separate_numbers_of_steps() {
    for largest_error in [1e-3f32, 1e-4, 1e-5] {
        let within = NewtonSteps::new(0, largest_error).within;
        let allowed = f64::from(largest_error);
        for steps in 1..=NewtonSteps::MOST_OF_AUTO {
            let change = f64::from(within[steps as usize]).sqrt();
            let after = |steps| {
                let first = change + allowed * (1.0 + change);
                (0..steps).fold(first, |e, _| e * e / (2.0 * (1.0 - e)))
            };
            assert!(
                after(steps - 1) > 2.0 * allowed,
                "{} of {allowed:.0e}",
                steps - 1
            );
            // The root is a difference of values up to 200 times as large, rounded to 2⁻²⁴. A step
            // back doubles it.
            let share = after(steps) / allowed;
            assert!(
                (share - 1.0).abs() < 1e-3,
                "{steps} steps leave {share} of {allowed:.0e}"
            );
        }
    }
}

/// The fewest steps leave at most the allowed error at every angle. From fine spans to coarse ones
/// they are one, two, three, and finally a root.
#[test]
fn the_fewest_steps_suffice() {
    for allowed in [1e-3f32, 1e-3 / 32.0] {
        let mut seen = [0; 4];
        for degrees in [
            1.0f32, 10.0, 30.0, 60.0, 90.0, 120.0, 150.0, 170.0, 179.0, 179.9,
        ] {
            for pixels in [1, 2, 3, 4, 6, 9, 16, 40, 200, 1000] {
                let (n, truth) = turning(degrees, pixels);
                let found = lengths(n, 0, allowed, pixels);
                // N is off by one rounding per pixel. D, its root and a step add four more.
                let shortest = truth.iter().copied().fold(1.0, f64::min);
                let rounding = HALF_ULP * (8.0 + 2.0 * pixels as f64 / shortest);
                let error = worst(&found, &truth);
                assert!(
                    error <= f64::from(allowed) + rounding,
                    "{degrees} over {pixels}: {error:.1e}"
                );
                // Two counts of steps may round to the same result.
                let same = |steps: &u32| found == lengths(n, *steps, allowed, pixels);
                let steps = (1..=3).find(same).unwrap_or(4);
                seen[steps as usize - 1] += 1;
            }
        }
        assert!(seen.iter().all(|&count| count > 0), "{allowed}: {seen:?}");
    }
}

/// Returns the largest relative error of a length.
fn worst(lengths: &[f32], truth: &[f64]) -> f64 {
    let errors = lengths
        .iter()
        .zip(truth)
        .map(|(d, truth)| (f64::from(*d) / truth - 1.0).abs());
    errors.fold(0.0, f64::max)
}

/// Fine spans and constant normals take one step. Vanishing normals take roots.
#[test]
fn fine_spans_take_one_step_and_cancelling_ones_roots() {
    let of = |line, steps, pixels| lengths(line, steps, NewtonSteps::LARGEST_ERROR, pixels);
    let (fine, _) = turning(30.0, 64);
    assert_eq!(of(fine, 0, 64), of(fine, 1, 64));
    assert_ne!(of(fine, 0, 64), of(fine, 2, 64));
    let still = (vec3([0.0, 0.6, 0.8]), vec3([0.0; 3]));
    assert_eq!(of(still, 0, 8), of(still, 1, 8));
    // The length grows by as much as one step may follow, which leaves nearly all of the allowed
    // error. More growth takes two steps.
    let along = |at: f32, step: f32| (vec3([at, 0.0, 0.0]), vec3([step, 0.0, 0.0]));
    let error =
        |growth: f32| f64::from(of(along(1.0, growth), 0, 2)[1]) / (1.0 + f64::from(growth)) - 1.0;
    assert!((8e-4..1e-3).contains(&error(0.0426)), "{}", error(0.0426));
    assert!(error(0.0428) < 1e-6, "{}", error(0.0428));
    assert_eq!(
        of(along(-1.0, 0.25), 0, 6),
        [1.0, 0.75, 0.5, 0.25, 0.0, 0.25]
    );
}

/// Returns the normals along an edge from `a` to `b`.
fn edge(a: [f32; 3], b: [f32; 3], rows: usize) -> Vec<[f32; 3]> {
    let (t0, dt) = (0.5 / rows as f32, 1.0 / rows as f32);
    let mut circle = GreatCircle::new(vec3([0.0, 0.0, 1.0]), [vec3(a), vec3(b)], t0, dt);
    (0..rows).map(|_| circle.next().array()).collect()
}

#[test]
fn normals_walk_great_circles_at_uniform_speed() {
    let mut random = Random::new(7);
    for _ in 0..200 {
        let (a, b) = (random.unit(), random.unit());
        let [from, to] = [a, b].map(|v| v.map(f64::from));
        let phi = dot([from, to]).clamp(-1.0, 1.0).acos();
        if !(0.02..3.1).contains(&phi) {
            continue;
        }
        for (k, n) in edge(a, b, 64).into_iter().enumerate() {
            let t = (k as f64 + 0.5) / 64.0;
            let [wa, wb] = [1.0 - t, t].map(|t| (t * phi).sin() / phi.sin());
            // The weights are off by the drift of 64 steps, 5 half units each, and by the error of
            // phi from rounded unit vectors, 8 half units. Both are divided by sin phi. Near 180
            // degrees acos in this test adds as much.
            let bound = (5.0 * 64.0 + 32.0) * HALF_ULP / phi.sin().powi(2);
            for i in 0..3 {
                let truth = wa * from[i] + wb * to[i];
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
        for (k, n) in edge([0.0, 0.0, 1.0], [angle, 0.0, 1.0], 16)
            .into_iter()
            .enumerate()
        {
            let truth = (k as f32 + 0.5) / 16.0 * angle;
            // Weights differ from linear ones by 6e-8 of the angle, plus 16 steps of rounding.
            let is_near = (n[0] - truth).abs() <= 1e-5 * angle && (n[2] - 1.0).abs() < 1e-5;
            assert!(is_near, "{angle} at {k}: {n:?}");
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

/// Walks in blocks, by the walk kernels of methods on every instruction set of this machine.
#[cfg(feature = "simd")]
mod blocks {
    use super::*;
    use crate::mesh::Material;
    use crate::number::SimdLevel;
    use crate::number::simd::BLOCK;
    use crate::scene::{Light, Lighting, Power};
    use crate::shading::light::Uniforms;
    use crate::shading::{
        Extras, MethodRow, Pixels, PolygonConstants, Run, RunList, SpanPlace, UniformsIndex, Value,
    };
    use glam::DVec3;
    use std::vec;

    /// Returns the planes of the pixels that a method with one light walks along, by instruction
    /// set. The run starts from two values of each varying, at `t0` with steps of `dt`. The runs
    /// before and after it must not affect it.
    fn walked(
        method: &str,
        parameters: &[Value],
        ([first, second], [t0, dt]): ([&[f32]; 2], [f32; 2]),
        pixels: usize,
    ) -> Vec<(SimdLevel, Vec<Vec<f32>>)> {
        let light = Light::directional(DVec3::Z, [1.0; 3]);
        let lighting = Lighting::new(&Material::default(), [1.0; 3], &[light], DVec3::Z);
        let uniforms = [Uniforms::new(&lighting, Power::default(), 1.0)];
        let run = |pixels: usize| Run {
            uniforms: UniformsIndex(0),
            polygon: 0,
            x: 0,
            pixels: pixels as u32,
            to: 0,
        };
        let mut list = RunList::new(first.len());
        for pixels in [3, pixels, 9] {
            list.runs.push(run(pixels));
            list.starts.add(|i| [first[i], second[i]]);
            list.places.push(SpanPlace {
                y: 0,
                t0,
                dt,
                start: 0,
                pixels: 32,
            });
        }
        let job = Pixels {
            parameters,
            uniforms: &uniforms,
            extras: Extras::default(),
            constants: &PolygonConstants {
                kinds: Vec::new(),
                values: vec![0.0, 0.0, 1.0],
            },
            list: &list,
        };
        let kernels = MethodRow::named(method)
            .expect("a method")
            .kernels(1, false);
        let [_, planes, _] = (kernels.counts)(1);
        let (before, length) = (planes * BLOCK, pixels.next_multiple_of(BLOCK));
        SimdLevel::available()
            .skip(1)
            .map(|level| {
                let walk = (kernels.simd)(level)
                    .and_then(|simd| simd.walk)
                    .expect("a walk");
                let mut out = vec![f32::NAN; before + planes * length + planes * 2 * BLOCK];
                walk(&job, &mut out);
                let own = out[before..].chunks_exact(length).take(planes);
                (level, own.map(|plane| plane[..pixels].to_vec()).collect())
            })
            .collect()
    }

    /// Returns the start of fast Phong: J, K and N, and their steps.
    fn start([j, dj]: [f32; 2], [k, dk]: [f32; 2], (n, dn): Line) -> [[f32; 5]; 2] {
        [[j, k, n.x, n.y, n.z], [dj, dk, dn.x, dn.y, dn.z]]
    }

    #[test]
    fn linear_steps_by_blocks() {
        let mut random = Random::new(37);
        for _ in 0..50 {
            let mut value = || [random.signed(), random.signed() / 512.0];
            let (j, k, still) = (value(), value(), (vec3([0.0, 0.0, 1.0]), vec3([0.0; 3])));
            for (level, planes) in walked(
                "fast-phong",
                &[Value::Whole(1)],
                (
                    start(j, k, still).each_ref().map(|list| &list[..]),
                    [f32::NAN; 2],
                ),
                509,
            ) {
                for ([at, step], plane) in [j, k].into_iter().zip(&planes) {
                    let most = f64::from(at.abs()).max(f64::from(at + 512.0 * step).abs());
                    for (i, value) in plane.iter().enumerate() {
                        let truth = f64::from(at) + i as f64 * f64::from(step);
                        // One addition every eight pixels, and two roundings of the start.
                        let bound = ((i / BLOCK) as f64 + 2.0) * HALF_ULP * most.max(1e-30);
                        let error = (f64::from(*value) - truth).abs();
                        assert!(error <= bound, "{level}: {at} {step} at {i}: {error:.1e}");
                    }
                }
            }
        }
    }

    #[test]
    #[allow(clippy::needless_range_loop)] // planes of pixels
    fn great_circles_step_by_blocks() {
        for degrees in [1.0f32, 30.0, 120.0, 178.0] {
            let (sin, cos) = (degrees / 2.0).to_radians().sin_cos();
            let (t0, dt) = (0.4 / 512.0, 1.0 / 512.0);
            let ends = [&[-sin, 0.0, cos][..], &[sin, 0.0, cos]];
            for (level, planes) in walked("slerp-phong-vector", &[], (ends, [t0, dt]), 512) {
                let half = f64::from(sin).atan2(f64::from(cos));
                for i in 0..512 {
                    let angle = (2.0 * (f64::from(t0) + i as f64 * f64::from(dt)) - 1.0) * half;
                    // 7.5 half units per step: up to seven steps to the lane, then one per block.
                    // Both ends are divided by sin φ.
                    let bound =
                        (7.5 * (i / 8 + i % 8) as f64 + 12.0) * HALF_ULP / (2.0 * half).sin();
                    for (plane, truth) in [(0, angle.sin()), (2, angle.cos())] {
                        let error = (f64::from(planes[plane][i]) - truth).abs();
                        assert!(error <= bound, "{level}: {degrees} at {i}: {error:.1e}");
                    }
                }
            }
        }
    }

    /// Returns the value of `steps`; 0 is `auto`.
    fn steps_of(steps: u32) -> Value {
        match steps {
            0 => Value::Auto,
            steps => Value::Whole(steps),
        }
    }

    /// Returns the lengths that fast Phong computes.
    fn lengths(n: Line, steps: u32, pixels: usize) -> impl Iterator<Item = (SimdLevel, Vec<f32>)> {
        let start = start([0.0; 2], [0.0; 2], n);
        let start = (start.each_ref().map(|list| &list[..]), [f32::NAN; 2]);
        let all = walked("fast-phong", &[steps_of(steps)], start, pixels).into_iter();
        all.map(|(level, mut planes)| (level, planes.swap_remove(2)))
    }

    /// Blocks stay within the allowed error at every angle and count of pixels. A true root is one
    /// rounding from N·N, whose roundings it halves, and N's own are added.
    #[test]
    fn lengths_are_never_far_off() {
        let allowed = f64::from(NewtonSteps::LARGEST_ERROR);
        let mut most = 0.0f64;
        for steps in 0..=3 {
            for degrees in [1.0f32, 10.0, 30.0, 60.0, 90.0, 120.0, 150.0, 170.0, 179.0] {
                for pixels in [8, 9, 16, 24, 40, 64, 200, 1000] {
                    let (n, truth) = turning(degrees, pixels);
                    for (level, found) in lengths(n, steps, pixels) {
                        // N is off by one rounding per block and two for the start. It is as short
                        // as cos(φ/2).
                        let shortest = truth.iter().copied().fold(1.0, f64::min);
                        let rounding =
                            HALF_ULP * (6.0 + 2.0 * (pixels as f64 / 8.0 + 2.0) / shortest);
                        let error = worst(&found, &truth);
                        assert!(
                            error <= allowed + rounding,
                            "{level}: {steps} steps, {degrees} over {pixels}: {error:.1e}"
                        );
                        most = most.max(error);
                    }
                }
            }
        }
        let none = SimdLevel::available().count() == 1;
        assert!(
            none || most > allowed / 100.0,
            "some span comes near what is allowed: {most:.1e}"
        );
    }

    /// Blocks take true roots over 120° and 16 pixels. Pixel by pixel one step is off by far more
    /// than blocks allow. Over 15° and 64 pixels Newton's method is safe, and blocks follow it from
    /// above.
    #[test]
    fn blocks_take_true_roots_where_newton_fails() {
        let (n, truth) = turning(120.0, 16);
        let one = worst(&super::lengths(n, 1, 1e-3, 16), &truth);
        assert!(
            one > 1e-3,
            "one pixel at a time nothing is guarded: {one:.1e}"
        );
        for (level, found) in lengths(n, 1, 16) {
            let error = worst(&found, &truth);
            assert!(error < 12.0 * HALF_ULP, "{level}: {error:.1e}");
        }
        let (n, truth) = turning(15.0, 64);
        for (level, found) in lengths(n, 1, 64) {
            // At the ends the length changes by sin 7.5° |ΔN| per pixel, |ΔN| = 2 sin 7.5° / 64,
            // and the previous block is eight pixels away: e = 4.3e-3. A step leaves e²/2 = 9.1e-6
            // of it, far above rounding. Half a block inside the end it is less.
            let error = worst(&found, &truth);
            assert!((4e-6..9.3e-6).contains(&error), "{level}: {error:.1e}");
        }
    }

    /// A normal that vanishes inside a span has length 0 there, computed by roots.
    #[test]
    fn normals_vanish_by_roots() {
        let vanishing = (vec3([-1.0f32, 0.0, 0.0]), vec3([1.0 / 8.0, 0.0, 0.0]));
        for (level, found) in lengths(vanishing, 2, 17) {
            let expected: Vec<f32> = (0..17).map(|k| (k as f32 / 8.0 - 1.0).abs()).collect();
            assert_eq!(found, expected, "{level}");
        }
        let still = (vec3([0.0, 0.6, 0.8]), vec3([0.0; 3]));
        for (level, found) in lengths(still, 2, 24) {
            let is_one = |d: &f32| (d - 1.0).abs() <= 2.0 * f32::EPSILON;
            assert!(found.iter().all(is_one), "{level}: a normal that stays");
        }
    }
}
