//! Flat shading by another definition: one colour per polygon, from the mean of its vertex normals
//! (CS171 3, Algorithm 6).

use crate::reference::Model;
use crate::shading::methods::colours::flat::Flat;
use crate::shading::{Info, Roundings, Shader, Stepped, Tier};

/// Flat shading as CS171 defines it: the mean of the vertex normals is lit once, at the mean of the
/// vertex positions. The kernels of [`Flat`] draw it.
///
/// The mean is normalised, which Algorithm 6 leaves out, because the light model needs unit
/// normals.
pub const FLAT_AVERAGE: Info = Info {
    name: "flat-average",
    ids: &[],
    tier: Tier::Asked,
    title: "one colour per polygon, from the mean of its vertex normals",
    formula: "N = (N1 + ... + Nn) / |N1 + ... + Nn|;  P = (P1 + ... + Pn) / n;  I = eq 2.1 of N at P",
    source: "CS171 3, Algorithm 6",
    model: Model::FlatAverage,
    roundings: Roundings::new(8.0, 0.0, Stepped::Colours),
    derivation: "as flat; making the mean normal a unit vector takes 4 more roundings",
    fails: "as flat; where the vertex normals cancel there is no mean normal, and ambient light remains",
    ..Flat::INFO
};
