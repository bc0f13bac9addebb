//! Fast Phong shading in integers.

use super::integers::{self, Form, Line, Normals, sum};
use super::{Entry, Family, Info, Kernels, Standing, Value};
use crate::integer::{Highlight, Light, Rgb888, Span};
use crate::reference::Model;

/// J and K by an addition, D by two, 1/√D by table: [`crate::integer::fast`].
struct Fast;

type Shell = Normals<{ integers::LIGHTS }>;

const INFO: Info = Info {
    name: "integer-fast",
    ids: &[],
    family: Family::Roots,
    standing: Standing::Asked,
    title: "fast Phong shading in integers, 1/|N| from a table",
    formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = table(D)\n\
              I = table(J r) + table(2 (J r) (K r) - L.V)",
    source: "L21 4.2, 4.3, eq 4.3, 4.6; Duff 1979",
    claimed: "",
    model: Model::PhongConstant,
    roundings: integers::ROUNDINGS,
    derivation: integers::DERIVATION,
    approximation: |frame, polygon, _| integers::approximation(frame, polygon, Form::Table),
    fails: integers::FAILS,
    has_power: false,
    parameters: integers::PARAMETERS,
};

static KERNELS: Kernels = Kernels::of_functions::<Shell>(integers::pixels::<Fast>, integers::WHY);

/// The row of the method table.
pub(super) const ENTRY: Entry = Entry::integer::<Shell>(&INFO, &KERNELS, |bench, variant| {
    integers::counted::<Shell>(
        bench,
        variant,
        integers::pixels::<Fast>,
        integers::LIGHTS,
        |lights| {
            let newton = integers::steps(variant.parameters());
            [
                // J of each light and K; three products of the ends, and the polynomial of D
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
        },
    )
});

impl Line for Fast {
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
