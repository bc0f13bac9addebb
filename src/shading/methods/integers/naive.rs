//! Naive Phong shading in integers.

use crate::integer::{Highlight, Light, Rgb888, Span};
use crate::number::Counts;
use crate::shading::methods::integers::{self, Line, Normals, sum};
use crate::shading::{Family, Info, Value};

/// Naive Phong shading with three additions for N, products for J, K and D, and 1/√D from a table:
/// [`crate::integer::Span::naive`].
pub(crate) struct Naive;

impl Line for Naive {
    const INFO: Info = Info {
        name: "integer-naive",
        family: Family::Roots,
        title: "naive Phong shading in integers, 1/|N| from a table",
        formula: "N_next = N + dN;  J = L.N;  K = V.N;  D = N.N;  r = table(D)\n\
              I = table(J r) + table(2 (J r) (K r) - L.V)",
        source: "L21 4.1, eq 4.1, 4.2",
        parameters: integers::PARAMETERS,
        ..integers::INFO
    };
    type Shell = Normals<{ integers::LIGHTS }>;

    fn counts(lights: u32, parameters: &[Value]) -> [Counts; 3] {
        let newton = integers::steps(parameters);
        [
            sum([
                (1, integers::RECIPROCAL),
                (3, integers::ADDITION),
                (3, integers::UNIT_COSINE),
            ]),
            sum([(3, integers::ADDITION)]),
            sum([
                (1, integers::ROOT),
                (newton, integers::NEWTON),
                (lights + 2, integers::DOT),
                (lights + 1, integers::UNIT_COSINE),
                (lights, integers::REFLECTION),
                (1, integers::colour(lights, false)),
            ]),
        ]
    }
    fn shade<H: Highlight, const L: usize>(
        parameters: &[Value],
        span: Span,
        line: &mut [Rgb888],
        lights: &[Light<'_, Rgb888>; L],
    ) {
        match integers::steps(parameters) {
            0 => span.naive::<_, H, false, L>(line, lights),
            _ => span.naive::<_, H, true, L>(line, lights),
        }
    }
}
