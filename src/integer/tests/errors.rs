//! The errors of each method on random spans. They must be below the figures in `docs/small.md`,
//! and below the bounds that follow from the number formats.

use super::super::*;
use super::closed_form::*;
use std::{println, vec, vec::Vec};

type Shade<P> = fn(Span, &mut [P], &Light<'_, P>);
type Normal = fn(V, V, f64) -> V;

const ANGLES: [f64; 4] = [5.0, 15.0, 30.0, 60.0];

/// A span: its light and eye, its normals, and its pixels.
pub(super) struct Case {
    pub(super) toward: V,
    pub(super) eye: V,
    pub(super) first: V,
    pub(super) end: V,
    pub(super) pixels: usize,
}

/// Returns 600 random spans that turn by an angle in degrees. Half of them run through the
/// highlight.
pub(super) fn cases(angle: f64) -> impl Iterator<Item = Case> {
    let random = Random::new(angle.to_bits() ^ 7);
    (0..600).map(move |round| {
        let pixels = [3, 8, 17, 32, 33, 64, 100, 128, 255, 256][round % 10];
        let eye = random.unit();
        let toward = random.aside(eye, 60.0 * random.next());
        let middle = if round % 2 == 0 {
            let sum = [0, 1, 2].map(|i| toward[i] + eye[i]);
            random.aside(normalized(sum), 4.0 * random.next())
        } else {
            random.unit()
        };
        let first = random.aside(middle, angle / 2.0);
        let end = normalized([0, 1, 2].map(|i| 2.0 * dot(first, middle) * middle[i] - first[i]));
        Case {
            toward,
            eye,
            first,
            end,
            pixels,
        }
    })
}

/// Returns the largest and the root mean square error of red, over all spans of an angle.
fn errors<P: Pixel + Default>(
    material: &Material<P>,
    red: fn(P) -> f64,
    (angle, kind, normal): (f64, Kind, Normal),
    shade: Shade<P>,
) -> (f64, f64) {
    let (mut worst, mut sum, mut count) = (0.0f64, 0.0, 0.0);
    for Case {
        toward,
        eye,
        first,
        end,
        pixels,
    } in cases(angle)
    {
        let light = Light::new(vector(toward), vector(eye), material);
        let mut line = vec![P::default(); pixels];
        shade(Span::new(vector(first), vector(end)), &mut line, &light);
        for (i, pixel) in line.iter().enumerate() {
            let n = normalized(normal(first, end, i as f64 / pixels as f64));
            // Rounding decides on which side of the horizon this light is.
            if dot(toward, n).abs() < 1e-3 {
                continue;
            }
            let error = (red(*pixel) - lit(n, &[(toward, eye)], kind)).abs();
            worst = worst.max(error);
            sum += error * error;
            count += 1.0;
        }
    }
    (worst, f64::sqrt(sum / count))
}

/// A method: its name, its highlight, the normals of its closed form, its function, and the errors
/// that `docs/small.md` promises at each angle before RGB565 cuts the fraction.
type Row = (&'static str, Kind, Normal, Shade<Uncut>, [f64; 4]);

const UNLIMITED: f64 = f64::INFINITY;

fn rows() -> Vec<Row> {
    use Kind::{Halfway as Nh, None as Dull, Reflection as Rv};
    let table = [3.8; 4];
    let step = [2.4; 4];
    let dull = [0.6; 4];
    let short = [2.4, 2.4, UNLIMITED, UNLIMITED];
    vec![
        (
            "naive-as-printed",
            Rv,
            between,
            |s, p, l| s.naive_as_printed(p, l),
            step,
        ),
        (
            "naive",
            Rv,
            between,
            |s, p, l| s.naive::<_, Reflection, false, 1>(p, &[*l]),
            table,
        ),
        (
            "naive-1",
            Rv,
            between,
            |s, p, l| s.naive::<_, Reflection, true, 1>(p, &[*l]),
            step,
        ),
        (
            "naive-nh",
            Nh,
            between,
            |s, p, l| s.naive::<_, Halfway, false, 1>(p, &[*l]),
            table,
        ),
        (
            "naive-dull",
            Dull,
            between,
            |s, p, l| s.naive::<_, NoHighlight, false, 1>(p, &[*l]),
            dull,
        ),
        (
            "fast-as-printed",
            Rv,
            between,
            |s, p, l| s.fast_as_printed(p, l),
            step,
        ),
        (
            "fast",
            Rv,
            between,
            |s, p, l| s.fast::<_, Reflection, false, 1>(p, &[*l]),
            table,
        ),
        (
            "fast-1",
            Rv,
            between,
            |s, p, l| s.fast::<_, Reflection, true, 1>(p, &[*l]),
            step,
        ),
        (
            "fast-nh",
            Nh,
            between,
            |s, p, l| s.fast::<_, Halfway, false, 1>(p, &[*l]),
            table,
        ),
        (
            "fast-dull",
            Dull,
            between,
            |s, p, l| s.fast::<_, NoHighlight, false, 1>(p, &[*l]),
            dull,
        ),
        (
            "quadratic",
            Rv,
            between,
            |s, p, l| s.quadratic::<_, Reflection, 1>(p, &[*l]),
            short,
        ),
        (
            "quadratic-nh",
            Nh,
            between,
            |s, p, l| s.quadratic::<_, Halfway, 1>(p, &[*l]),
            short,
        ),
        (
            "quadratic-dull",
            Dull,
            between,
            |s, p, l| s.quadratic::<_, NoHighlight, 1>(p, &[*l]),
            short,
        ),
        (
            "slerp",
            Rv,
            slerp,
            |s, p, l| s.slerp::<_, Reflection>(p, l),
            step,
        ),
        (
            "slerp-dull",
            Dull,
            slerp,
            |s, p, l| s.slerp::<_, NoHighlight>(p, l),
            dull,
        ),
    ]
}

#[test]
fn errors_are_those_that_the_document_tells() {
    let mut wrong = Vec::new();
    for (name, kind, normal, shade, limits) in rows() {
        let found = ANGLES.map(|angle| errors(&UNCUT, Uncut::red, (angle, kind, normal), shade).0);
        // `examples/small/run` reads this line.
        let [a, b, c, d] = found;
        println!("\nspan-error {name} {a:.2} {b:.2} {c:.2} {d:.2}");
        if found
            .iter()
            .zip(limits)
            .any(|(error, limit)| *error > limit)
        {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}

/// Waves of one and two pixels, whose 1/n has the shortest shift, have no larger errors than longer
/// ones.
#[test]
fn the_shortest_waves_are_right() {
    for (index, case) in cases(15.0).enumerate() {
        let light = Light::new(vector(case.toward), vector(case.eye), &UNCUT);
        let mut line = vec![Uncut::default(); 1 + index % 2];
        let span = Span::new(vector(case.first), vector(case.end));
        span.slerp::<_, Reflection>(&mut line, &light);
        let pixels = line.len() as f64;
        for (i, pixel) in line.iter().enumerate() {
            let n = normalized(slerp(case.first, case.end, i as f64 / pixels));
            if dot(case.toward, n).abs() < 1e-3 {
                continue;
            }
            let exact = lit(n, &[(case.toward, case.eye)], Kind::Reflection);
            let error = (pixel.red() - exact).abs();
            assert!(error <= 2.8, "{index}, pixel {i}: {error}");
        }
    }
}

/// The bounds of [`ErrorBound`] hold, and are not much larger than the errors found.
#[cfg(feature = "alloc")]
#[test]
fn errors_are_within_their_bounds_and_these_are_tight() {
    for (name, kind, normal, shade, _) in rows() {
        let is_bounded = ["naive", "fast", "quadr", "slerp"]
            .iter()
            .any(|n| name.starts_with(n));
        if !is_bounded || name == "fast-as-printed" {
            continue;
        }
        for angle in ANGLES {
            let bound = ErrorBound {
                diffuse: DIFFUSE,
                highlight: if matches!(kind, Kind::None) {
                    0.0
                } else {
                    HIGHLIGHT
                },
                shininess: SHININESS,
                angle: angle.to_radians(),
                pixels: 256,
                is_refined: name.contains("-1") || name.contains("printed"),
                is_parabola: name.starts_with("quadratic"),
                is_halfway: matches!(kind, Kind::Halfway),
                is_slerp: name.starts_with("slerp"),
            };
            let (found, _) = errors(&UNCUT, Uncut::red, (angle, kind, normal), shade);
            let (before, cut) = bound.parts::<Uncut>();
            assert!(found <= before, "{name}, {angle}°: {found} > {before}");
            // The error of a parabola or a wave is largest at one place of the span, and a
            // highlight is steepest beside its peak: the bound assumes that both are the same
            // place.
            let times = if bound.is_parabola || bound.is_slerp {
                9.0
            } else {
                4.0
            };
            assert!(
                before < times * found + 0.5,
                "{name}, {angle}°: {found}, bound {before}"
            );
            assert_eq!(bound.levels::<Uncut>(), before + cut);
        }
    }
}

/// The pixel's format adds its own error: half a level for RGB888, half a step of 8.2 levels for
/// RGB565.
#[test]
fn pixels_add_the_error_of_their_format() {
    let fast_888: Shade<Rgb888> = |s, p, l| s.fast::<_, Reflection, false, 1>(p, &[*l]);
    let fast_565: Shade<Rgb565> = |s, p, l| s.fast::<_, Reflection, false, 1>(p, &[*l]);
    for angle in ANGLES {
        let what = (angle, Kind::Reflection, between as Normal);
        let full = errors(&FULL, |p| f64::from(p.0[0]), what, fast_888);
        let short = errors(
            &SHORT,
            |p| f64::from(p.0 >> 11) / 31.0 * 255.0,
            what,
            fast_565,
        );
        println!(
            "{angle:4}° RGB888 {:.2} ({:.2}), RGB565 {:.2} ({:.2})",
            full.0, full.1, short.0, short.1
        );
        assert!(full.0 < 3.8 + 0.5 && full.1 < 1.0);
        assert!(short.0 < 3.8 + 255.0 / 62.0 && short.1 < 2.6);
    }
}

/// Two to four lights add up, and clamp at white.
#[test]
fn lights_add_up() {
    fn worst<const L: usize>(shade: fn(Span, &mut [Uncut], &[Light<'_, Uncut>; L])) -> f64 {
        let random = Random::new(L as u64);
        let mut worst = 0.0f64;
        for _ in 0..200 {
            let eye = random.unit();
            let towards = [(); L].map(|()| random.aside(eye, 90.0 * random.next()));
            let mut materials = [&NEXT; L];
            materials[0] = &UNCUT;
            let lights: [Light<'_, Uncut>; L] =
                core::array::from_fn(|i| Light::new(vector(towards[i]), vector(eye), materials[i]));
            let first = random.aside(eye, 40.0 * random.next());
            let end = random.aside(first, 15.0);
            let mut line = [Uncut::default(); 40];
            shade(Span::new(vector(first), vector(end)), &mut line, &lights);
            for (i, pixel) in line.iter().enumerate() {
                let n = normalized(between(first, end, i as f64 / 40.0));
                if towards.iter().any(|l| dot(*l, n).abs() < 1e-3) {
                    continue;
                }
                let exact = lit(n, &towards.map(|l| (l, eye)), Kind::Reflection);
                worst = worst.max((pixel.red() - exact).abs());
            }
        }
        worst
    }
    let found = [
        worst::<2>(|s, p, l| s.naive::<_, Reflection, true, 2>(p, l)),
        worst::<3>(|s, p, l| s.fast::<_, Reflection, true, 3>(p, l)),
        worst::<4>(|s, p, l| s.fast::<_, Reflection, true, 4>(p, l)),
        worst::<4>(|s, p, l| s.quadratic::<_, Reflection, 4>(p, l)),
    ];
    println!("2 naive, 3 fast, 4 fast, 4 quadratic: {found:.2?}");
    // Each light adds at most the error of one.
    assert!(found[0] < 2.0 * 2.4 && found[1] < 3.0 * 2.4 && found[2].max(found[3]) < 4.0 * 2.4);
}

/// Interpolation on the screen has the error under perspective that the documentation of [`Canvas`]
/// states.
#[test]
fn perspective_moves_normals_along_their_span() {
    for (ratio, share, degrees, levels) in [(1.1, 0.024, 0.36, 1.6), (1.5, 0.101, 1.52, 6.7)] {
        // From near to far, half-way on the screen is t = 1/(1 + ratio) in space: the difference is
        // largest there.
        let (mut most, mut most_levels) = (0.0f64, 0.0f64);
        for step in 0..=1000 {
            let t = f64::from(step) / 1000.0;
            let in_space = t / (t + (1.0 - t) * ratio);
            most = most.max(t - in_space);
            let lit = |t: f64| {
                // 15° from the light's own direction on: where diffuse light changes fastest, 75°
                // to 90°.
                let angle = (75.0 + 15.0 * t).to_radians();
                255.0 * angle.cos()
            };
            most_levels = most_levels.max((lit(t) - lit(in_space)).abs());
        }
        println!(
            "{ratio}: {most:.4}, {:.2}°, {most_levels:.2} levels",
            15.0 * most
        );
        assert!((most - share).abs() < 0.001 && (15.0 * most - degrees).abs() < 0.02);
        assert!((most_levels - levels).abs() < 0.1);
    }
}
