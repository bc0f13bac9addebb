//! How far a method may be from its closed form: counted in roundings, not guessed.

use super::Info;
use crate::frame::{Frame, Polygon};

/// One rounding of a number of 0.5..1: half a unit in the last place of an `f32`, and of the doubled numbers 2⁻²⁴ again.
const ROUNDING: f64 = 1.0 / (1u64 << 24) as f64;

/// How many roundings of 2⁻²⁴ a method's cosines (or colours) gather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roundings {
    /// Before the first step.
    pub start: f64,
    /// At every step along an edge or a span. Steps add the same rounded increment again and again, so their roundings
    /// do not average out: they grow with the number of steps.
    pub step: f64,
    /// What is stepped.
    pub of: Stepped,
}

/// What a method steps along edges and spans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stepped {
    /// Colours: what they are off by is what the picture is off by.
    Colours,
    /// Normals or cosines: the illumination model comes after, and multiplies what they are off by.
    Cosines,
}

impl Info {
    /// The largest difference that rounding in `f32` can make between this method's picture of `frame` and its closed
    /// form ([`Info::model`]), in a linear channel of 0..=1.
    ///
    /// With s steps from a corner to a pixel, a cosine is off by `e = (start + step · s) · 2⁻²⁴`. The diffuse term passes
    /// that on times `I_p k_d`; `R·V = 2 (L·N)(N·V) − L·V` is off by up to 4 e, and the power multiplies that by n.
    ///
    /// Errors of the method itself, Newton's on short spans with large angles among them, are not rounding: where the
    /// difference is over this bound, the report says so.
    pub fn bound(&self, frame: &Frame) -> f64 {
        let steps = frame.polygons().iter().map(|p| longest_walk(frame, p)).max().unwrap_or(0) as f64;
        let gain = frame.lightings().iter().map(|lighting| {
            let channel = |c: usize| {
                let term = |l: &crate::lighting::LightTerm| {
                    f64::from(l.diffuse[c]) + 4.0 * f64::from(lighting.shininess.max(1.0)) * f64::from(l.specular[c])
                };
                lighting.lights.iter().map(term).sum::<f64>()
            };
            channel(0).max(channel(1)).max(channel(2)).max(1.0)
        });
        let gain = gain.fold(1.0, f64::max);
        let Roundings { start, step, of } = self.roundings;
        match of {
            Stepped::Colours => ROUNDING * (start * gain + step * steps),
            Stepped::Cosines => ROUNDING * (start + step * steps) * gain,
        }
    }
}

/// The most steps from a corner to a pixel: down the rows of the polygon and across its columns, inside the picture.
fn longest_walk(frame: &Frame, polygon: &Polygon) -> usize {
    let extent = |coordinate: fn(&crate::frame::Vertex) -> crate::frame::SubPixel, limit: usize| {
        let all = frame.corners(polygon).iter().map(|&v| coordinate(&frame.vertices()[v as usize]).to_bits());
        let (low, high) = all.fold((i32::MAX, i32::MIN), |(low, high), c| (low.min(c), high.max(c)));
        ((high - low) as usize / 256 + 1).min(limit)
    };
    extent(|v| v.y, frame.height()) + extent(|v| v.x, frame.width())
}
