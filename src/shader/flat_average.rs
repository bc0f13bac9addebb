//! Flat shading in the other definition: one colour a polygon, from the mean of its vertices (CS171 3, Algorithm 6).

use super::local::{Far, Near};
use super::one_colour::{Of, PolygonNormal};
use super::{Corners, Info, Local, Method, Perspective, Roundings, Stepped};
use crate::number::{Machine, Num, dot};
use crate::reference::Model;
use crate::walk::Lerp;

/// Flat shading as CS171 defines it: the mean of the vertex normals, at the mean of the vertex positions, lit once.
///
/// The mean is normalised, which Algorithm 6 leaves out: the lighting model is for unit normals (trap T20).
#[derive(Debug)]
pub struct FlatAverage;

impl Method for FlatAverage {
    const INFO: Info = Info {
        name: "flat-average",
        title: "one colour a polygon, from the mean of its vertex normals",
        formula: "N = (N1 + ... + Nn) / |N1 + ... + Nn|;  P = (P1 + ... + Pn) / n;  I = eq 2.1 of N at P",
        source: "CS171 3, Algorithm 6",
        model: Model::FlatAverage,
        roundings: Roundings {
            start: 8.0,
            step: 0.0,
            of: Stepped::Colours,
        },
        derivation: "as flat, and the mean normal takes 4 more roundings until it is a unit vector",
        fails: "as flat; where the vertex normals cancel there is no mean normal, and ambient light remains",
        parameters: &[],
        perspective: Perspective::Unaffected,
        local: Local::PerPolygon,
        barycentric: true,
    };
    type Screen<const L: usize> = Of<Self, Far, L>;
    type Perspective<const L: usize> = Of<Self, Far, L>;
    type Local<const L: usize> = Of<Self, Near, L>;
    type LocalPerspective<const L: usize> = Of<Self, Near, L>;
}

impl PolygonNormal for FlatAverage {
    #[inline(always)]
    fn unit<M: Machine>(one: M::One, corners: &Corners<'_, M, Lerp<()>>) -> [M::One; 3] {
        let n = corners.mean_normal();
        let over_length = one / dot(n, n).sqrt();
        [n[0] * over_length, n[1] * over_length, n[2] * over_length]
    }
}
