//! Spans that no mesh has, of any length and between any vectors: nothing overflows or panics, and
//! bounds hold.

use super::super::*;
use super::closed_form::*;
use fixed::types::I17F15;
use std::vec;

/// Calls every method on a span.
fn all(ends: [Vector; 2], pixels: usize, lights: &[Light<'_, Uncut>; 4]) {
    let line = &mut *vec![Uncut::default(); pixels];
    let ([first, ..], span) = (lights, Span::new(ends[0], ends[1]));
    span.naive::<_, Reflection, false, 4>(line, lights);
    span.naive::<_, Halfway, true, 4>(line, lights);
    span.fast::<_, Reflection, false, 4>(line, lights);
    span.fast::<_, Halfway, true, 4>(line, lights);
    span.fast::<_, NoHighlight, false, 4>(line, lights);
    span.quadratic::<_, Reflection, 4>(line, lights);
    span.quadratic::<_, Halfway, 4>(line, lights);
    span.quadratic::<_, NoHighlight, 4>(line, lights);
    span.slerp::<_, Reflection>(line, first);
    span.slerp::<_, Halfway>(line, first);
    span.naive_as_printed(line, first);
    span.fast_as_printed(line, first);
    let [a, b] = ends.map(|n| colour::<Uncut, Reflection, 4>(lights, n));
    gouraud(line, a, b);
}

/// Returns a length from 0 to 65,535 pixels, with equally many below 16 and from 4,096 on.
fn any_length(random: &Random) -> usize {
    2f64.powf(16.0 * random.next()) as usize - usize::from(random.next() < 0.1)
}

/// Returns a vector from any constructor, of any length that it allows.
fn any_vector(random: &Random) -> Vector {
    let bits = || (random.next() * 4_294_967_296.0) as u32 as i32;
    let axis = |x: f64| {
        let mut v = [0.0; 3];
        v[(random.next() * 3.0) as usize] = if random.next() < 0.5 { x } else { -x };
        v
    };
    let fixed = |v: V| Vector::new(v.map(|x| I17F15::from_bits((x * 32768.0).round() as i32)));
    match (random.next() * 12.0) as usize {
        0 => Vector::new([(); 3].map(|()| I17F15::from_bits(bits()))),
        1 => Vector::new(
            [(); 3].map(|()| I17F15::from_bits(bits() >> (random.next() * 32.0) as u32)),
        ),
        2 => unit([(); 3].map(|()| bits() as i16)),
        3 => Vector::new([[I17F15::MIN, I17F15::MAX][(random.next() * 2.0) as usize]; 3]),
        // At the largest length of vectors, and a unit beyond.
        4 => fixed(axis(1.0 + (random.next() * 8.0).floor() / 32768.0)),
        5 => fixed(random.unit().map(|x| x * (1.0 + 1e-4 * random.next()))),
        6 => fixed(random.unit().map(|x| x * 1.0003)),
        7 => fixed(random.unit().map(|x| x * random.next())),
        8 => fixed(normalized([1.0, 1.0, 1.0])),
        9 => fixed(axis(1.0)),
        10 => fixed(axis(random.next())),
        _ => fixed(random.unit()),
    }
}

/// Returns a vector opposite to another, but for up to two units in each component.
fn opposite(random: &Random, v: Vector) -> Vector {
    Vector::new(v.to_array().map(|x| {
        let units = (random.next() * 5.0) as i32 - 2;
        I17F15::from_bits(units - x.to_bits())
    }))
}

#[test]
fn spans_of_any_length_between_any_vectors_do_not_overflow() {
    let random = Random::new(3);
    for round in 0..2000 {
        let pick = || any_vector(&random);
        // All lights of a picture share the eye.
        let (eye, mut four) = (pick(), [(); 4].map(|()| pick()));
        let first = pick();
        let end = match round % 4 {
            0 => pick(),
            // A turn by 180°, where all rounding is largest.
            1 => opposite(&random, first),
            _ => {
                let at = float(first);
                let length = dot(at, at).sqrt().max(1e-3);
                let angle = 180.0 * random.next();
                vector(
                    random
                        .aside(at.map(|x| x / length), angle)
                        .map(|x| x * length),
                )
            }
        };
        // A light along a normal has the largest cosines.
        four[3] = [first, end][round % 2];
        let lights = four.map(|l| Light::new(l, eye, &NEXT));
        let pixels = if round < 600 {
            round
        } else {
            any_length(&random)
        };
        all([first, end], pixels, &lights);
    }
}

/// The table of roots wraps where the stepped D exceeds 1 + 2⁻¹¹. The longest spans of the longest
/// vectors that turn by 180° come closest to it.
#[test]
fn the_last_pixel_of_the_longest_piece_stays_in_the_table_of_roots() {
    let random = Random::new(31);
    for _ in 0..200_000 {
        let n = random.unit().map(|x| x * (1.0 + 2f64.powi(-14)));
        // Cut toward 0, so that the vector is not too long.
        let first = Vector::new(n.map(|x| I17F15::from_bits((x * 32768.0) as i32)));
        let end = opposite(&random, first);
        let light = Light::new(end, end, &UNCUT);
        let span = Span::new(first, end);
        let mut line = [Uncut::default(); Span::MAX];
        span.fast::<_, Reflection, false, 1>(&mut line, &[light]);
        let last = line[Span::MAX - 1];
        span.naive::<_, Reflection, false, 1>(&mut line, &[light]);
        // Light and eye face the normal, so the pixel is white unless D wraps.
        for pixel in [last, line[Span::MAX - 1]] {
            assert!(pixel.red() > 250.0, "{first:?} {end:?}: {}", pixel.red());
        }
    }
}

/// A method, the normals of its closed form, and its bound.
#[cfg(feature = "alloc")]
type Bounded = (
    fn(Span, &mut [Uncut], &Light<'_, Uncut>),
    fn(V, V, f64) -> V,
    ErrorBound,
);

/// Returns red of a unit normal in grey levels, by R·V.
#[cfg(feature = "alloc")]
fn shone(n: V, toward: V, eye: V, ambient: f64, bound: &ErrorBound) -> f64 {
    let (j, k) = (dot(toward, n), dot(eye, n));
    let cosine = (2.0 * j * k - dot(toward, eye)).max(0.0);
    let power = cosine.powi(bound.shininess as i32);
    let lit = if j > 0.0 {
        ambient + bound.diffuse * j + bound.highlight * power
    } else {
        ambient
    };
    255.0 * lit.min(1.0)
}

#[cfg(feature = "alloc")]
#[test]
fn lines_of_any_length_and_material_are_within_their_bounds() {
    let bound = ErrorBound {
        diffuse: 0.0,
        highlight: 0.0,
        shininess: 0,
        angle: 0.0,
        pixels: 0,
        is_refined: false,
        is_parabola: false,
        is_halfway: false,
        is_slerp: false,
    };
    let refined = ErrorBound {
        is_refined: true,
        ..bound
    };
    let methods: [Bounded; 6] = [
        (
            |s, p, l| s.naive::<_, Reflection, false, 1>(p, &[*l]),
            between,
            bound,
        ),
        (
            |s, p, l| s.fast::<_, Reflection, false, 1>(p, &[*l]),
            between,
            bound,
        ),
        (
            |s, p, l| s.fast::<_, Reflection, true, 1>(p, &[*l]),
            between,
            refined,
        ),
        (|s, p, l| s.naive_as_printed(p, l), between, refined),
        (
            |s, p, l| s.quadratic::<_, Reflection, 1>(p, &[*l]),
            between,
            ErrorBound {
                is_parabola: true,
                ..bound
            },
        ),
        (
            |s, p, l| s.slerp::<_, Reflection>(p, l),
            slerp,
            ErrorBound {
                is_slerp: true,
                ..bound
            },
        ),
    ];
    let random = Random::new(17);
    let mut tried = 0;
    for round in 0..600 {
        let pixels = any_length(&random).max(1);
        for (shade, normal, bound) in methods {
            let eye = random.unit();
            let toward = random.aside(eye, 60.0 * random.next());
            let middle = normalized([0, 1, 2].map(|i| toward[i] + eye[i]));
            let most = if bound.is_slerp { 60.0 } else { 90.0 };
            let degrees = most * random.next();
            // Half of them through the highlight.
            let first = match round % 2 {
                0 => random.aside(middle, degrees * random.next()),
                _ => random.unit(),
            };
            // Unit normals from `f32`, from 16-bit integers and from Q15.
            let end = random.aside(first, degrees);
            let made = |v: V| match round % 3 {
                0 => Vector::from_f32(v.map(|x| x as f32)).expect("numbers"),
                1 => unit(v.map(|x| (x * 32767.0).round() as i16)),
                _ => vector(v),
            };
            // Sums and factors above 1 are clamped.
            let [ambient, diffuse, highlight] =
                [0.5, 1.2, 1.2].map(|most| fixed::types::U16F16::from_num(most * random.next()));
            let shininess = 2f64.powf(10.0 * random.next()) as u32;
            let material = Material::new([ambient; 3], [diffuse; 3], [highlight; 3], shininess);
            let light = Light::new(vector(toward), vector(eye), &material);
            let mut line = vec![Uncut::default(); pixels];
            shade(Span::new(made(first), made(end)), &mut line, &light);
            let bound = ErrorBound {
                diffuse: f64::from(diffuse),
                highlight: f64::from(highlight),
                shininess,
                angle: degrees.to_radians(),
                pixels,
                ..bound
            };
            let ambient = f64::from(ambient);
            let (limit, _) = bound.parts::<Uncut>();
            // All pixels of short lines; of long lines the pixels beside cuts and some others.
            let all: std::vec::Vec<usize> = match pixels {
                0..=1000 => (0..pixels).collect(),
                _ => (0..pixels)
                    .filter(|i| (i + 1) % 256 < 2 || i % 97 == 0)
                    .collect(),
            };
            for i in all {
                let n = normalized(normal(first, end, i as f64 / pixels as f64));
                // Rounding decides on which side of the horizon this light is.
                if dot(toward, n).abs() < 2e-3 {
                    continue;
                }
                let error = (line[i].red() - shone(n, toward, eye, ambient, &bound)).abs();
                assert!(error <= limit, "{bound:?}, pixel {i}: {error}, not {limit}");
                tried += 1;
            }
        }
    }
    assert!(tried > 300_000, "{tried}");
}

/// Long lines between vectors of more than unit length need both cuts and shorter vectors.
#[test]
fn five_thousand_pixels_between_normals_that_are_too_long_are_right() {
    let random = Random::new(41);
    for _ in 0..50 {
        let eye = random.unit();
        let toward = random.aside(eye, 40.0);
        let first = random.aside(eye, 50.0 * random.next());
        let end = random.aside(first, 45.0);
        let long =
            |v: V| Vector::new(v.map(|x| I17F15::from_bits((x * 1.0003 * 32768.0).round() as i32)));
        let light = Light::new(long(toward), long(eye), &UNCUT);
        let mut lines = [(); 3].map(|()| vec![Uncut::default(); 5000]);
        let span = Span::new(long(first), long(end));
        span.naive::<_, Reflection, false, 1>(&mut lines[0], &[light]);
        span.fast::<_, Reflection, false, 1>(&mut lines[1], &[light]);
        span.slerp::<_, Reflection>(&mut lines[2], &light);
        for (i, line) in lines.iter().enumerate() {
            for (x, pixel) in line.iter().enumerate() {
                let between = if i == 2 { slerp } else { between };
                let n = normalized(between(first, end, x as f64 / 5000.0));
                if dot(toward, n).abs() > 2e-3 {
                    let error = (pixel.red() - lit(n, &[(toward, eye)], Kind::Reflection)).abs();
                    assert!(error < 4.5, "{i}, pixel {x}: {error}");
                }
            }
        }
    }
}

/// Only the ratio of two normals' lengths counts, as long as they have enough bits for a direction.
#[test]
fn short_normals_and_lights_shine_as_long_ones() {
    let random = Random::new(43);
    for _ in 0..400 {
        let eye = random.unit();
        let toward = random.aside(eye, 60.0 * random.next());
        let first = random.aside(eye, 60.0 * random.next());
        let end = random.aside(first, 60.0 * random.next());
        let length = 2f64.powf(-6.0 * random.next());
        let short = |v: V| vector(v.map(|x| x * length));
        let light = Light::new(short(toward), short(eye), &UNCUT);
        let mut lines = [[Uncut::default(); 64]; 4];
        let span = Span::new(short(first), short(end));
        span.naive::<_, Reflection, false, 1>(&mut lines[0], &[light]);
        span.fast::<_, Reflection, true, 1>(&mut lines[1], &[light]);
        span.slerp::<_, Reflection>(&mut lines[2], &light);
        lines[3][0] = Uncut(colour::<_, Reflection, 1>(&[light], short(first)));
        for (i, line) in lines.iter().enumerate() {
            for (x, pixel) in line.iter().enumerate().take(if i == 3 { 1 } else { 64 }) {
                let between = if i == 2 { slerp } else { between };
                let n = normalized(between(first, end, x as f64 / 64.0));
                // Each vector is off by √3/2 units of 2⁻¹⁵ divided by its length. R·V has this
                // error up to five times: twice each from two normals, whose length between the
                // ends is 0.87, and once from the others. The 32nd power has a slope of at most
                // 3.4. Where D is ¼ the table of roots is off by 2⁻¹¹, and R·V by four times that:
                // 6.4 levels, and 1.6 for the highlight's half step.
                if dot(toward, n).abs() > 0.01 {
                    let error = (pixel.red() - lit(n, &[(toward, eye)], Kind::Reflection)).abs();
                    let units = 255.0 * (DIFFUSE * 3.0 + HIGHLIGHT * 3.4 * 5.0) * 0.87;
                    let limit = 8.0 + units / 32768.0 / length;
                    assert!(error < limit, "{length} {i}, pixel {x}: {error}");
                }
            }
        }
    }
}

#[test]
fn units_are_unit() {
    let random = Random::new(5);
    for _ in 0..20_000 {
        let size = 2f64.powf(15.0 * random.next());
        let v = random.unit().map(|x| (x * size).round());
        if v == [0.0; 3] {
            continue;
        }
        let (exact, made) = (normalized(v), float(unit(v.map(|x| x as i16))));
        for i in 0..3 {
            assert!(
                (exact[i] - made[i]).abs() < 1.0 / 16384.0,
                "{v:?}: {made:?}"
            );
        }
    }
    assert_eq!(float(unit([0; 3])), [0.0; 3]);
    let corner = float(unit([i16::MIN; 3]));
    assert!(corner.iter().all(|x| (x + 1.0 / 3f64.sqrt()).abs() < 1e-4));
}

#[test]
fn no_constructor_makes_a_vector_that_is_too_long() {
    let random = Random::new(6);
    let limit = f64::from(super::super::vector::LONGEST) / f64::from(1 << 30);
    for _ in 0..200_000 {
        let v = float(any_vector(&random));
        assert!(dot(v, v) <= limit, "{v:?}");
        let bits = || (random.next() * 4_294_967_296.0) as u32 as i32;
        let any = [(); 3].map(|()| bits() >> (random.next() * 32.0) as u32);
        let made = float(Vector::new(any.map(I17F15::from_bits)));
        let before = any.map(|x| f64::from(x) / 32768.0);
        let expected = if dot(before, before) <= limit {
            before
        } else {
            normalized(before)
        };
        for i in 0..3 {
            assert!((expected[i] - made[i]).abs() < 1.0 / 16384.0, "{any:?}");
        }
    }
}

#[cfg(feature = "alloc")]
#[test]
fn floats_become_vectors_or_nothing() {
    let from = |v: [f32; 3]| Vector::from_f32(v).map(float);
    assert_eq!(from([f32::NAN, 0.0, 1.0]), None);
    assert_eq!(from([f32::INFINITY, 0.0, 0.0]), None);
    assert_eq!(from([0.0; 3]), Some([0.0; 3]));
    assert_eq!(from([0.0, -0.5, 0.25]), Some([0.0, -0.5, 0.25]));
    assert_eq!(from([0.0, -7.0, 0.0]), Some([0.0, -1.0, 0.0]));
    let unit = [0.6, 0.0, -0.8].map(|x| f64::round(x * 32768.0) / 32768.0);
    assert_eq!(from([0.6, 0.0, -0.8]), Some(unit), "it is only rounded");
    let random = Random::new(7);
    for _ in 0..20_000 {
        let any = || f32::from_bits((random.next() * 4_294_967_296.0) as u32);
        let v = [any(), any(), any()];
        match Vector::from_f32(v).map(float) {
            Some(made) => assert!(dot(made, made) < 1.0002, "{v:?}"),
            None => assert!(v.iter().any(|x| !x.is_finite())),
        }
    }
}
