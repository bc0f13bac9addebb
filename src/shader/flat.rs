//! Flat shading: one colour a polygon (L21 2).

use super::local::{Far, Near};
use super::one_colour::{Of, PolygonNormal};
use super::{Corners, Info, Local, Method, Perspective, Roundings, Stepped};
use crate::number::Machine;
use crate::reference::Model;
use crate::walk::Lerp;

/// Flat (uniform) shading: the polygon's own normal, lit once (L21 2.1).
///
/// Light and eye at positions are seen from the mean of the polygon's corners.
#[derive(Debug)]
pub struct Flat;

impl Method for Flat {
    const INFO: Info = Info {
        name: "flat",
        title: "one colour a polygon, from its own normal",
        formula: "I = Ia ka + Ip kd (L.N) + Ip ks (R.V)^n, N the polygon's normal by Newell's formula",
        source: "L21 2, eq 2.1 (Bouknight 1970)",
        model: Model::Flat,
        roundings: Roundings {
            start: 4.0,
            step: 0.0,
            of: Stepped::Colours,
        },
        derivation: "nothing is stepped; L.N and R.V take 8 roundings each of at most half of 2^-24",
        fails: "every polygon edge is visible, and exaggerated by the eye (Mach bands)",
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

impl PolygonNormal for Flat {
    #[inline(always)]
    fn unit<M: Machine>(_: M::One, corners: &Corners<'_, M, Lerp<()>>) -> [M::One; 3] {
        corners.normal()
    }
}
