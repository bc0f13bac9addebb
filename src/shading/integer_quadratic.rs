//! Phong shading by parabolas, in integers.

use super::integers::{self, Form, Line, Normals, sum};
use super::{Entry, Family, Info, Kernels, Standing, Value};
use crate::integer::{Highlight, Light, Rgb888, Span};
use crate::reference::Model;

/// L·N and R·V by two additions each, through both ends and the middle of a span: [`crate::integer::quadratic`].
struct Parabolas;

type Shell = Normals<{ integers::LIGHTS }>;

const INFO: Info = Info {
    name: "integer-quadratic",
    ids: &[],
    family: Family::Quadratics,
    standing: Standing::Asked,
    title: "L.N and R.V as parabolas along spans, in integers",
    formula: "F_next = F + dF;  dF_next = dF + ddF, for F = L.N and F = R.V through both ends and the middle of a span\n\
              I = table(L.N) + table(R.V)",
    source: "Bishop, Weimer 1986, fitted through three points",
    claimed: "",
    model: Model::PhongConstant,
    roundings: integers::ROUNDINGS,
    derivation: integers::DERIVATION,
    approximation: |frame, polygon, _| integers::approximation(frame, polygon, Form::Parabola),
    fails: integers::FAILS,
    has_power: false,
    parameters: &[],
};

static KERNELS: Kernels =
    Kernels::of_functions::<Shell>(integers::pixels::<Parabolas>, integers::WHY);

/// The row of the method table.
pub(super) const ENTRY: Entry = Entry::integer::<Shell>(&INFO, &KERNELS, |bench, variant| {
    integers::counted::<Shell>(
        bench,
        variant,
        integers::pixels::<Parabolas>,
        integers::LIGHTS,
        |lights| {
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
        },
    )
});

impl Line for Parabolas {
    fn shade<H: Highlight, const L: usize>(
        _: &[Value],
        span: Span,
        line: &mut [Rgb888],
        lights: &[Light<'_, Rgb888>; L],
    ) {
        span.quadratic::<_, H, L>(line, lights);
    }
}
