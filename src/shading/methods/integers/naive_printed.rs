//! Naive Phong shading in integers as the lecture prints it: an exhibit.

use crate::integer::{Highlight, Light, Rgb888, Span};
use crate::number::Counts;
use crate::shading::methods::integers::{self, Form, Line, Normals, sum};
use crate::shading::{Family, Info, Tier, Value};

/// Naive Phong shading by `Span::naive_as_printed` of [`crate::integer`].
pub(crate) struct NaivePrinted;

impl Line for NaivePrinted {
    const INFO: Info = Info {
        name: "integer-naive-printed",
        family: Family::Roots,
        tier: Tier::Exhibit,
        title: "naive Phong shading in integers, as the lecture prints it",
        formula: "N_next = N + dN;  N_unit = N / |N|;  R = 2 (L.N_unit) N_unit - L;  I = table(L.N_unit) + table(R.V)",
        source: "L21 4.1, eq 4.1, 4.2",
        approximation: |frame, polygon, _| integers::approximation(frame, polygon, Form::Refined),
        fails: "where normals turn by more than 90 degrees over a polygon; it supports one light, at infinity, and highlights by R.V only",
        ..integers::INFO
    };
    type Shell = Normals<1>;
    const LIGHTS: usize = 1;

    fn counts(_: u32, _: &[Value]) -> [Counts; 3] {
        [
            sum([
                (1, integers::RECIPROCAL),
                (3, integers::ADDITION),
                (3, integers::UNIT_COSINE),
            ]),
            sum([(3, integers::ADDITION)]),
            sum([
                (1, integers::ROOT),
                (1, integers::NEWTON),
                (3, integers::DOT),
                (3, integers::UNIT_COSINE), // N / |N|
                (3, integers::REFLECTION),  // R
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
        span.naive_as_printed(line, &lights[0]);
    }
}
