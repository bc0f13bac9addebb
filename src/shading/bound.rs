//! Bounds of the difference between a method and its closed form: counted in roundings, not guessed.

use super::lighting::highlight_error;
use super::spread::Spread;
use super::{Perspective, Variant};
use crate::frame::{Frame, Polygon, ScreenVertex, SubPixel};
use crate::scene::{Interpolation, LightTerm, Lighting, SpecularModel};

/// One rounding of a number of 0.5..1: half a unit in the last place of an `f32`, and of the doubled numbers 2⁻²⁴ again.
const ROUNDING: f64 = 1.0 / (1u64 << 24) as f64;

/// The roundings of 2⁻²⁴ that a method's cosines (or colours) gather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roundings {
    /// Before the first step.
    pub start: f64,
    /// At every step along an edge or a span. Steps add the same rounded increment again and again, so their roundings
    /// do not average out: they grow with the number of steps.
    pub step: f64,
    /// The values that are stepped.
    pub of: Stepped,
}

impl Roundings {
    /// Makes `start` roundings, and `step` more at every step.
    pub const fn new(start: f64, step: f64, of: Stepped) -> Roundings {
        Roundings { start, step, of }
    }
}

/// The values that a method steps along edges and spans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stepped {
    /// Colours of at most 1: the picture is off by as much as they are.
    Colours,
    /// Colours that are clamped later: off by as much as all light together is over 1.
    Sums,
    /// Normals or cosines: the light model comes after, and multiplies their errors.
    Cosines,
    /// Products of two vectors that grow linearly: the light model comes after, too.
    Products,
}

impl Variant {
    /// Returns the largest difference that rounding in `f32` can make between this method's picture of `frame` and its closed
    /// form ([`super::Info::model`]), in a linear channel of 0..=1.
    ///
    /// With s steps from a corner to a pixel, a cosine is off by `e = (start + step · s) · 2⁻²⁴`. The diffuse term passes
    /// that on times `I_p k_d`; `R·V = 2 (L·N)(N·V) − L·V` is off by up to 4 e, and the power multiplies that by n. Of
    /// `N·H = (L·N + V·N) / h`, h = |L + V|, the sum is off by 2 e and h by e/h, so that it is off by `2 e/h + e/h²`, which
    /// is below 4 e while h is over 0.81. An exponent below 1 is infinitely steep at 0, and its power is off by up to (4 e)^n,
    /// where a highlight ends.
    ///
    /// A vector toward a place is rounded at its longest and divided by its length where it is shortest: with a spread of σ
    /// between the two its direction is off by σ times as much, and its square by σ². A falloff of at most its strength
    /// where the light is nearest multiplies colours and their errors, and is off by as much as the square itself.
    ///
    /// A faint highlight is left out: `I_p k_s (R·V)^n` of at most 2⁻²⁴ a light. Its threshold `t = (2⁻²⁴ / k)^(1/n)` is rounded,
    /// so that t^n is off by a share of `(43 + n) 2⁻²³`; the roundings of a highlight, n times 4 · 2⁻²⁴, leave room for that.
    /// An exponent below 1 has its threshold below all errors of cosines, and (4 e)^n holds there as elsewhere.
    ///
    /// Where a parameter is left to the method ([`super::Auto`]), lengths may be too large by the relative error E that it
    /// allows itself. The diffuse terms D are divided by them: they lose E D at most, of which after the clamp, as all other
    /// terms are 0 or more, E/(1 − E) is left at most. Of N·H, which is divided by them too, the power n loses n times as much
    /// of the specular terms. R·V is divided by the squared length, which has no such error.
    ///
    /// Other errors of the method itself, those of a given number of Newton's steps on short spans with large angles among
    /// them, are no part of this, nor is a gate: a highlight ends with a jump where L·N = 0, and where a light lies in the plane
    /// of a polygon the last bit decides whether all of it is there. Nor are interpolated normals much shorter than 1, between
    /// corners whose normals are over 60° apart or so, though errors of directions grow as they shrink. Where the difference is over this bound, the report says so.
    pub fn bound(&self, frame: &Frame) -> f64 {
        let info = self.info();
        let walks = frame.polygons().iter().map(|p| longest_walk(frame, p));
        let steps = walks.max().unwrap_or(0) as f64;
        let spread = Spread::of(frame);
        let Roundings { start, step, of } = info.roundings;
        // A rounding where the weight of perspective is largest counts for more where it is smallest.
        let weights = match (info.perspective, frame.interpolation()) {
            (Perspective::Free | Perspective::Divides, Interpolation::Perspective) => {
                spread.weights
            }
            _ => 1.0,
        };
        let rounding = ROUNDING * weights;
        // The first value of a colour is lit from vectors to places, too.
        let (toward, square) = (spread.vectors, spread.vectors * spread.vectors);
        // What the cosines are off by that the light model sees.
        let cosine = match of {
            Stepped::Colours | Stepped::Sums => rounding * start * toward,
            Stepped::Cosines => rounding * (start + step * steps) * toward,
            // Squares of weighted vectors have the squares of the weights.
            Stepped::Products => {
                // With positions three products are stepped, where there was one product and one cosine.
                let step = if frame.is_local() { 3.0 * step } else { step };
                rounding * weights * (start + step * steps) * square
            }
        };
        // What the light model makes of it, its largest sum, and the loss that lengths are allowed.
        let (mut lit, mut most, mut allowed) = (cosine, 1.0, 0.0);
        for (lighting, lights) in frame.lightings().iter().zip(&spread.materials) {
            let highlight = highlight_error(lighting, lights.half, cosine);
            // A falloff is off by twice what its distance is, which is one error of a cosine; the colour by as much.
            let falls = if lighting.is_attenuated() { 2.0 } else { 0.0 };
            let diffuse_error = self.length_error(lighting);
            // (1 − E)ⁿ is 1 − n E at least, and 1 − E for an exponent below 1.
            let specular_error = match lighting.specular {
                SpecularModel::Phong => 0.0,
                SpecularModel::Blinn => f64::from(lighting.shininess).max(1.0) * diffuse_error,
            };
            for c in 0..3 {
                let sum = |colour: fn(&LightTerm) -> [f32; 3]| -> f64 {
                    let all = lighting.lights.iter().zip(&lights.strengths);
                    all.map(|(light, strength)| strength * f64::from(colour(light)[c]))
                        .sum()
                };
                let (diffuse, specular) = (sum(|l| l.diffuse), sum(|l| l.specular));
                let both = diffuse + specular;
                let off = (diffuse + falls * both) * cosine + highlight * specular;
                lit = f64::max(lit, off);
                most = f64::max(most, f64::from(lighting.ambient[c]) + both);
                let lost = lost(diffuse_error, diffuse) + lost(specular_error, specular);
                allowed = f64::max(allowed, lost);
            }
        }
        let lights = frame.lightings().iter().map(|l| l.lights.len()).max();
        let faint = ROUNDING * lights.unwrap_or(0) as f64;
        let rounded = match of {
            Stepped::Colours => lit + rounding * step * steps,
            Stepped::Sums => lit + rounding * step * steps * most,
            Stepped::Cosines | Stepped::Products => lit,
        };
        rounded + faint + allowed
    }

    /// Returns the relative error of lengths that the method allows itself on a material.
    fn length_error(&self, lighting: &Lighting) -> f64 {
        let all = self.info().parameters.iter().zip(self.parameters());
        all.filter(|(parameter, value)| parameter.is_auto(**value))
            .filter_map(|(parameter, _)| parameter.auto)
            .map(|auto| f64::from((auto.length_error)(lighting)))
            .fold(0.0, f64::max)
    }
}

/// Returns the part of a sum of terms, clamped at 1, that is lost by a relative error of the lengths that divide them.
fn lost(error: f64, sum: f64) -> f64 {
    sum.min(1.0) * error / (1.0 - error)
}

/// Returns the most steps from a corner to a pixel: down the rows of the polygon and across its columns, inside the picture.
fn longest_walk(frame: &Frame, polygon: &Polygon) -> usize {
    let extent = |coordinate: fn(&ScreenVertex) -> SubPixel, limit: usize| {
        let corners = frame.corners(polygon).iter();
        let all = corners.map(|&v| coordinate(&frame.vertices()[v as usize]).to_bits());
        let (low, high) = (all.clone().min(), all.max());
        let extent = high.unwrap_or(0) - low.unwrap_or(0);
        (extent as usize / 256 + 1).min(limit)
    };
    extent(|v| v.y, frame.height()) + extent(|v| v.x, frame.width())
}
