//! The words of scene files that stand for choices.

use super::value::Choice;
use crate::picture::Encoding;
use crate::scene::{Clipping, Culling, DepthSource, Interpolation, PainterKey};

/// Where vertex normals come from, but for `crease`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalChoice {
    /// The normals of the mesh, averaged ones where it has none.
    Given,
    /// The normalised sum of the unit normals of the polygons around (L21 3.1).
    Averaged,
}

/// How hidden surfaces are found, but for the settings of each way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VisibilityChoice {
    /// By depth at each sample.
    ZBuffer,
    /// By drawing from back to front.
    Painter,
    /// Not at all: later polygons hide earlier ones.
    DrawOrder,
}

/// Declares the words of a choice, in the order in which messages list them.
macro_rules! words {
    ($($type:ty { $($word:literal => $meaning:ident),* })*) => {
        $(impl Choice for $type {
            const WORDS: &'static [&'static str] = &[$($word),*];
            const MEANINGS: &'static [Self] = &[$(Self::$meaning),*];
        })*
    };
}

words! {
    NormalChoice { "averaged" => Averaged, "given" => Given }
    VisibilityChoice { "z-buffer" => ZBuffer, "painter" => Painter, "draw-order" => DrawOrder }
    PainterKey { "mean" => Mean, "farthest" => Farthest }
    Clipping { "planes" => Planes, "ndc-cube" => NdcCube }
    DepthSource { "interpolated" => Interpolated, "per-sample" => PerSample }
    Interpolation { "screen" => Screen, "perspective" => Perspective }
    Culling { "back" => Back, "front" => Front, "none" => None }
    Encoding { "linear" => Linear, "srgb" => Srgb }
}
