//! Slerp Phong shading in integers.

use crate::integer::{Highlight, Light, Rgb888, Span};
use crate::number::Counts;
use crate::reference::Model;
use crate::shading::kernels::PixelKernel;
use crate::shading::methods::integers::{self, Circles, Form, Line, sum};
use crate::shading::{Family, Info, Value};

/// J and K along great circles, by two additions and a product each: `Span::slerp` of
/// [`crate::integer`].
pub(crate) struct Waves;

impl Line for Waves {
    const INFO: Info = Info {
        name: "integer-slerp",
        family: Family::Angles,
        title: "J = L.N and K = V.N along great circles, in integers",
        formula: "J_next = J + dJ;  dJ_next = dJ - a J_next;  a = 2 (1 - cos d), d the angle of a pixel;  K in the same way\n\
              I = table(J) + table(2 J K - L.V)",
        source: "L21 4.4, eq 4.7; Barrera, Hast, Bengtsson 2004",
        model: Model::Slerp,
        roundings: integers::CIRCLE_ROUNDINGS,
        approximation: |frame, polygon, _| integers::approximation(frame, polygon, Form::Waves),
        fails: "where normals turn by more than 90 degrees along a span; it supports one light, at infinity",
        ..integers::INFO
    };
    type Shell = Circles;
    const LIGHTS: usize = 1;
    const PIXELS: PixelKernel = integers::circles::<Self>;

    fn counts(_: u32, _: &[Value]) -> [Counts; 3] {
        [
            // θ, φ and their sines by series, and the first differences of J and K.
            sum([
                (1, integers::RECIPROCAL),
                (1, integers::DOT),
                (9, integers::ADDITION),
                (11, integers::UNIT_COSINE),
                (2, integers::DIVISION),
                (4, integers::DOT),
                (4, integers::ADDITION),
                (8, integers::UNIT_COSINE),
            ]),
            sum([(4, integers::ADDITION), (2, integers::UNIT_COSINE)]),
            sum([(1, integers::REFLECTION), (1, integers::colour(1, true))]),
        ]
    }
    fn shade<H: Highlight, const L: usize>(
        _: &[Value],
        span: Span,
        line: &mut [Rgb888],
        lights: &[Light<'_, Rgb888>; L],
    ) {
        span.slerp::<_, H>(line, &lights[0]);
    }
}
