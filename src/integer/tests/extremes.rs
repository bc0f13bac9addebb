//! Spans that no mesh has: nothing may overflow or panic.

use super::super::*;
use super::closed_form::*;
use std::vec;

/// Calls every method on a span.
fn all(span: Span, pixels: usize, lights: &[Light<'_, Uncut>; 4]) {
    let line = &mut *vec![Uncut::default(); pixels];
    let [first, ..] = lights;
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
    let ends = [span.first, span.end].map(|n| n.map(fixed::types::I17F15::from_bits));
    let [a, b] = ends.map(|n| colour::<Uncut, Reflection, 4>(lights, n));
    gouraud(line, a, b);
}

#[test]
fn random_and_extreme_spans_do_not_overflow() {
    let random = Random::new(3);
    let axes = [
        [1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    let diagonal = normalized([1.0, 1.0, 1.0]);
    for round in 0..6000 {
        let pick = || match (random.next() * 12.0) as usize {
            i @ 0..4 => axes[i],
            4 => diagonal,
            5 => diagonal.map(|x| -x),
            // Shorter than allowed.
            6 => random.unit().map(|x| x * 0.3),
            7 => [0.0; 3],
            _ => random.unit(),
        };
        // All lights of a picture share the eye.
        let eye = pick();
        let mut four = [0; 4].map(|_| pick());
        let ends = (pick(), pick());
        let angle = 180.0 * random.next();
        let ends = if round % 3 == 0 {
            (ends.0, random.aside(random.unit(), angle))
        } else {
            ends
        };
        four[3] = ends.0;
        let lights = four.map(|l| Light::new(vector(l), vector(eye), &NEXT));
        let pixels = if round < 400 {
            round
        } else {
            (random.next() * 400.0) as usize
        };
        all(Span::new(vector(ends.0), vector(ends.1)), pixels, &lights);
    }
}

#[test]
fn long_lines_do_not_overflow() {
    let lights = [Light::new(unit([1, 2, 3]), unit([0, 0, 1]), &NEXT); 4];
    for pixels in [257, 320, 480, 800, 1024] {
        all(Span::new(unit([1, 0, 0]), unit([0, 0, 1])), pixels, &lights);
    }
}

#[test]
fn units_are_unit() {
    let random = Random::new(5);
    for _ in 0..2000 {
        let size = 2f64.powf(14.0 * random.next());
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
}
