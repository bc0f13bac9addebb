//! Fast Phong shading in integers.

use crate::integer::{Highlight, Light, Rgb888, Span};
use crate::number::Counts;
use crate::shading::methods::integers::{self, Line, Normals, sum};
use crate::shading::{Family, Info, Value};

/// Fast Phong shading with an addition each for J and K, two for D, and 1/√D from a table:
/// [`crate::integer::Span::fast`].
pub(crate) struct Fast;

impl Line for Fast {
    const INFO: Info = Info {
        name: "integer-fast",
        family: Family::Roots,
        title: "fast Phong shading in integers, 1/|N| from a table",
        formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = table(D)\n\
              I = table(J r) + table(2 (J r) (K r) - L.V)",
        source: "L21 4.2, 4.3, eq 4.3, 4.6; Duff 1979",
        parameters: integers::PARAMETERS,
        ..integers::INFO
    };
    type Shell = Normals<{ integers::LIGHTS }>;

    fn counts(lights: u32, parameters: &[Value]) -> [Counts; 3] {
        let newton = integers::steps(parameters);
        [
            // J of each light and K, three products of the ends, and the polynomial of D.
            sum([
                (1, integers::RECIPROCAL),
                (2 * (lights + 1), integers::DOT),
                (lights + 1, integers::RAMP),
                (3, integers::DOT),
                (5, integers::ADDITION),
                (1, integers::POLYNOMIAL),
            ]),
            sum([(lights + 1 + 2, integers::ADDITION)]),
            sum([
                (1, integers::ROOT),
                (newton, integers::NEWTON),
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
            0 => span.fast::<_, H, false, L>(line, lights),
            _ => span.fast::<_, H, true, L>(line, lights),
        }
    }
}
