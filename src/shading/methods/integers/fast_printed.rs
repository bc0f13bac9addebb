//! Fast Phong shading in integers as the lecture prints it, with three divisions per pixel: an
//! exhibit.

use crate::integer::{Highlight, Light, Rgb888, Span};
use crate::number::Counts;
use crate::shading::methods::integers::{self, Line, Normals, sum};
use crate::shading::{Approximation, Family, Info, Roundings, Stepped, Tier, Value};

/// Fast Phong shading by `Span::fast_as_printed` of [`crate::integer`].
pub(crate) struct FastPrinted;

impl Line for FastPrinted {
    const INFO: Info = Info {
        name: "integer-fast-printed",
        family: Family::Roots,
        tier: Tier::Exhibit,
        title: "fast Phong shading in integers, as the lecture prints it: three divisions a pixel",
        formula: "J_next = J + dJ;  K_next = K + dK;  N_next = N + dN;  d_next = (d + N.N / d) / 2\n\
              I = table(J / d) + table(2 J K / (N.N) - L.V)",
        source: "L21 4.2, 4.3, eq 4.3, 4.4, 4.6",
        roundings: Roundings::new(f64::INFINITY, 0.0, Stepped::Cosines),
        derivation: "no bound: one of Newton's steps from the previous pixel follows |N| where normals turn little from pixel to pixel",
        approximation: |_, _, _| Approximation::NONE,
        fails: "where normals turn by more than some 2 degrees per pixel; it supports one light, at infinity, and highlights by R.V only",
        ..integers::INFO
    };
    type Shell = Normals<1>;
    const LIGHTS: usize = 1;

    fn counts(_: u32, _: &[Value]) -> [Counts; 3] {
        [
            sum([
                (1, integers::RECIPROCAL),
                (4, integers::DOT),
                (2, integers::RAMP),
                (3, integers::ADDITION),
                (3, integers::UNIT_COSINE),
                (1, integers::DOT),
                (1, integers::ROOT),
                (1, integers::NEWTON),
                (1, integers::UNIT_COSINE),
            ]),
            sum([(5, integers::ADDITION)]),
            sum([
                (1, integers::DOT),
                (3, integers::DIVISION),
                (2, integers::ADDITION), // Newton's step
                (1, integers::REFLECTION),
                (2, integers::CLAMP),
                (1, integers::colour(1, true)),
            ]),
        ]
    }
    fn shade<H: Highlight, const L: usize>(
        _: &[Value],
        span: Span,
        line: &mut [Rgb888],
        lights: &[Light<'_, Rgb888>; L],
    ) {
        span.fast_as_printed(line, &lights[0]);
    }
}
