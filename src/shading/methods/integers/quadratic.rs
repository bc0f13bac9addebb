//! Phong shading by parabolas, in integers.

use crate::integer::{Highlight, Light, Rgb888, Span};
use crate::number::Counts;
use crate::shading::methods::integers::{self, Form, Line, Normals, sum};
use crate::shading::{Family, Info, Value};

/// L·N and R·V as parabolas through both ends and the middle of a span, by two additions each:
/// [`crate::integer::Span::quadratic`].
pub(crate) struct Parabolas;

impl Line for Parabolas {
    const INFO: Info = Info {
        name: "integer-quadratic",
        family: Family::Quadratics,
        title: "L.N and R.V as parabolas along spans, in integers",
        formula: "F_next = F + dF;  dF_next = dF + ddF, for F = L.N and F = R.V through both ends and the middle of a span\n\
              I = table(L.N) + table(R.V)",
        source: "Bishop, Weimer 1986, fitted through three points",
        approximation: |frame, polygon, _| integers::approximation(frame, polygon, Form::Parabola),
        ..integers::INFO
    };
    type Shell = Normals<{ integers::LIGHTS }>;

    fn counts(lights: u32, _: &[Value]) -> [Counts; 3] {
        // The cosine of a vector at both ends and the middle.
        let three = sum([
            (2, integers::DOT),
            (1, integers::ADDITION),
            (3, integers::UNIT_COSINE),
        ]);
        [
            sum([
                (1, integers::RECIPROCAL),
                (3, integers::DOT),
                (2, integers::ADDITION),
                (3, integers::ROOT),
                (3, integers::NEWTON),
                (lights + 1, three),
                (3 * lights, integers::REFLECTION),
                (2 * lights, integers::THROUGH),
            ]),
            sum([(4 * lights, integers::ADDITION)]),
            integers::colour(lights, true),
        ]
    }
    fn shade<H: Highlight, const L: usize>(
        _: &[Value],
        span: Span,
        line: &mut [Rgb888],
        lights: &[Light<'_, Rgb888>; L],
    ) {
        span.quadratic::<_, H, L>(line, lights);
    }
}
