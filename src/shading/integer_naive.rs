//! Naive Phong shading in integers.

use super::integers::{self, Form, Line, Normals, sum};
use super::{Entry, Family, Info, Kernels, Standing, Value};
use crate::integer::{Highlight, Light, Rgb888, Span};
use crate::reference::Model;

/// N by three additions, J, K and D by products, 1/√D by table: [`crate::integer::naive`].
struct Naive;

type Shell = Normals<{ integers::LIGHTS }>;

const INFO: Info = Info {
    name: "integer-naive",
    ids: &[],
    family: Family::Roots,
    standing: Standing::Asked,
    title: "naive Phong shading in integers, 1/|N| from a table",
    formula: "N_next = N + dN;  J = L.N;  K = V.N;  D = N.N;  r = table(D)\n\
              I = table(J r) + table(2 (J r) (K r) - L.V)",
    source: "L21 4.1, eq 4.1, 4.2",
    claimed: "",
    model: Model::PhongConstant,
    roundings: integers::ROUNDINGS,
    derivation: integers::DERIVATION,
    approximation: |frame, polygon, _| integers::approximation(frame, polygon, Form::Table),
    fails: integers::FAILS,
    has_power: false,
    parameters: integers::PARAMETERS,
};

static KERNELS: Kernels = Kernels::of_functions::<Shell>(integers::pixels::<Naive>, integers::WHY);

/// The row of the method table.
pub(super) const ENTRY: Entry = Entry::integer::<Shell>(&INFO, &KERNELS, |bench, variant| {
    integers::counted::<Shell>(
        bench,
        variant,
        integers::pixels::<Naive>,
        integers::LIGHTS,
        |lights| {
            let newton = integers::steps(variant.parameters());
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
        },
    )
});

impl Line for Naive {
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
