//! Bounds of the difference between a method and its closed form: counted in roundings, not guessed.

pub(crate) mod light_ranges;
pub(crate) mod polygon_ranges;

use crate::frame::{Frame, Polygon};
use crate::scene::{LightTerm, Lighting, Power, SpecularGate, SpecularModel};
use crate::shading::bounds::light_ranges::{PolygonSpread, SeenLights, Spread};
use crate::shading::bounds::polygon_ranges::{Extent, wide};
use crate::shading::light::highlight_error;
use crate::shading::{Approximation, LitAt, Local, MethodRow, Perspective, Value, Variant};
use alloc::vec::Vec;

/// One rounding of a number of 0.5..1: half a unit in the last place of an `f32`, and of the doubled numbers 2⁻²⁴ again.
const ROUNDING: f64 = 1.0 / (1u64 << 24) as f64;

/// The roundings of a value of at most 1 that is interpolated by barycentric coordinates, without steps: an integer, the inverse area
/// (two), their product, another product and two sums.
const BARYCENTRIC: f64 = 7.0;

/// The roundings of 2⁻²⁴ that a method's cosines (or colours) gather.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roundings {
    /// Before the first step.
    pub start: f64,
    /// At every step along an edge or a span. Steps add the same rounded increment again and again, so their roundings
    /// do not average out: they grow with the count of steps.
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
    /// Normals or cosines along great circles: as [`Stepped::Cosines`], but spans walk between points of edges.
    GreatCircles,
    /// Products of two vectors that grow linearly: the light model comes after, too.
    Products,
}

impl Variant {
    /// Returns the largest difference that rounding in `f32` can make between this method's picture of `frame` and its closed
    /// form ([`super::Info::model`]), in a linear channel of 0..=1. A bound of 1 says nothing.
    ///
    /// It is the largest of the bounds of all polygons ([`Variant::polygon_bounds`]), which are derived as follows.
    ///
    /// **Steps.** With s steps from a corner to a pixel, a value of at most 1 is off by `(start + step · s) · 2⁻²⁴`.
    ///
    /// **Set-up.** Steps begin from parameters, which are rounded too, and multiply the differences of corners, δ at most. Between
    /// edges a parameter is rounded 4 times with its difference and product, along edges as often: 8 δ. The
    /// barycentric renderer steps nothing: coordinates, products and sums take 7 roundings of values.
    ///
    /// **Triangles in the row engine** have barycentric coordinates, which take 5 roundings at the start of a run, with differences. Their
    /// growth takes 5, over a run on which both grow by 1 at most: 15 δ. A small triangle begins up to 15 rows and 7 columns away, where
    /// coordinates are up to g larger (`Extent::growth`): both starts take 10 g, and both growths 12 g, 22 g δ more. From there to a
    /// pixel are 17 sums at most, of values as large as `1 + 2 g δ`. Only lines are stepped: of a cosine two vectors, which
    /// are rounded by 0.87 each.
    ///
    /// **Short normals.** Normals between corners whose normals are apart are shorter than 1. Let m be the unit mean of the
    /// corners' normals N_i and `c = min N_i·m`. Every convex combination N has |N| ≥ N·m ≥ c, so that
    /// dividing by its length makes errors of cosines larger by 1/c, and those of products, which are divided by N·N, by 1/c². Weights
    /// of perspective are positive and change neither m nor c; vertices that clipping made lie between others, so that c holds for
    /// pieces. The N_i are within θ of m, cos θ = c, so that δ ≤ 2 sin θ. A great circle divides by sin φ. Where φ is at most
    /// 90°, both weights are at most 1 all the same; else `sin φ = 2 sin φ/2 cos φ/2 ≥ √2 c`, as cos φ/2 is the length of the chord's
    /// middle. Points of edges lie in the same cone, and the span between them divides once more: 1/c². Where c is 0 or less the
    /// bound is 1.
    ///
    /// **Light.** If a cosine is off by e, the diffuse term passes
    /// that on times `I_p k_d`; `R·V = 2 (L·N)(N·V) − L·V` is off by up to 4 e, and the power multiplies that by n. Of
    /// `N·H = (L·N + V·N) / h`, h = |L + V|, the sum is off by 2 e and h by e/h, so that it is off by `2 e/h + e/h²`, which
    /// is below 4 e while h is over 0.81. An exponent below 1 is infinitely steep at 0, and its power is off by up to (4 e)^n,
    /// where a highlight ends.
    ///
    /// A vector toward a place is rounded at its longest and divided by its length where it is shortest: with a spread of σ
    /// between the two its direction is off by σ times as much, and its square by σ². Where such vectors are stepped, δ is larger by
    /// the size of the polygon over the longest. A falloff of at most its strength
    /// where the light is nearest multiplies colours and their errors, and is off by as much as the square itself.
    ///
    /// **Vertex colours** of at most A multiply ambient and diffuse light M, so that errors of the latter grow by A. Interpolated, they
    /// are off by as much as any stepped colour, and by 4 roundings before: A M times that is added. The mean of a polygon's colours
    /// takes a rounding, a product another.
    ///
    /// A faint highlight is left out: `I_p k_s (R·V)^n` of at most 2⁻²⁴ a light. Its threshold `t = (2⁻²⁴ / k)^(1/n)` is rounded,
    /// so that t^n is off by a share of `(43 + n) 2⁻²³`; the roundings of a highlight, n times 4 · 2⁻²⁴, leave room for that.
    /// An exponent below 1 has its threshold below all errors of cosines, and (4 e)^n holds there as elsewhere.
    ///
    /// What a method leaves out by design ([`super::Info::approximation`]) is added to the error of cosines or colours. Another power
    /// function ([`Power`]) has its own slope and roundings in place of n and none.
    ///
    /// Where a parameter is left to the method ([`super::Auto`]), lengths may be too large by the relative error E that it
    /// allows itself. The diffuse terms D are divided by them: they lose E D at most, of which after the clamp, as all other
    /// terms are 0 or more, E/(1 − E) is left at most. Of N·H, which is divided by them too, the power n loses n times as much
    /// of the specular terms. R·V is divided by the squared length, which has no such error. A highlight that is weighted with L·N
    /// loses as much as that.
    ///
    /// Other errors of the method itself, those of a given count of Newton's steps on short spans with large angles among
    /// them, are no part of this, nor is a gate: a highlight ends with a jump where L·N = 0, and where a light lies in the plane
    /// of a polygon the last bit decides whether all of it is there. Where the difference is over this bound, the report says so.
    pub fn bound(&self, frame: &Frame) -> f64 {
        self.polygon_bounds(frame).fold(0.0, f64::max)
    }

    /// Returns the largest difference, in a linear channel of 0..=1, that the variant may make by design from its method's model with
    /// tⁿ: what the method leaves out ([`super::Info::approximation`]), and what its power function does ([`Power::error`]).
    pub fn approximation(&self, frame: &Frame) -> f64 {
        let spread = Spread::of(frame);
        let materials = frame.lightings().iter().zip(&spread.materials);
        let albedo = largest_colour(frame);
        let materials: Vec<MaterialBound<'_>> = materials
            .map(|(lighting, seen)| self.material_bound(lighting, seen, albedo))
            .collect();
        let info = self.row().on(frame).info;
        // Once per material: an error takes thousands of powers.
        let highlights: Vec<f64> = materials
            .iter()
            .map(|material| {
                let power = self.power().error(f64::from(material.lighting.shininess));
                material.specular.into_iter().fold(0.0, f64::max) * power
            })
            .collect();
        let of_polygon = |polygon: &Polygon| {
            let material = &materials[polygon.material as usize];
            let highlights = highlights[polygon.material as usize];
            let error = (info.approximation)(frame, polygon, self.parameters());
            let colour = error.colour * material.albedo.max(1.0);
            let by_method = match error.cosine + error.length {
                0.0 => colour + material.jump(error),
                cosines => material.of(cosines, [0.0; 2]) + material.jump(error) + colour,
            };
            f64::min(1.0, by_method + highlights)
        };
        frame.polygons().iter().map(of_polygon).fold(0.0, f64::max)
    }

    /// Returns [`Variant::bound`] for the pixels of each polygon of `frame`, in order.
    pub fn polygon_bounds<'a>(&'a self, frame: &'a Frame) -> impl Iterator<Item = f64> + 'a {
        let spread = Spread::of(frame);
        let materials = frame.lightings().iter().zip(&spread.materials);
        let albedo = largest_colour(frame);
        let materials: Vec<MaterialBound<'a>> = materials
            .map(|(lighting, seen)| self.material_bound(lighting, seen, albedo))
            .collect();
        let polygons = frame.polygons().iter().enumerate();
        let entry = self.row().on(frame);
        polygons.map(move |(index, polygon)| {
            let (cosine, colours) = errors(entry, frame, polygon, spread.on(index));
            let material = &materials[polygon.material as usize];
            let error = (entry.info.approximation)(frame, polygon, self.parameters());
            let cosine = cosine + error.cosine + error.length;
            let colour = error.colour * material.albedo.max(1.0);
            let bound = material.of(cosine, colours) + material.jump(error) + colour;
            // No channel differs by more.
            if bound <= 1.0 { bound } else { 1.0 }
        })
    }

    /// Returns what the light model makes of errors on a material, where vertex colours are at most `albedo`.
    fn material_bound<'a>(
        &self,
        lighting: &'a Lighting,
        seen: &SeenLights,
        albedo: f64,
    ) -> MaterialBound<'a> {
        let albedo = match lighting.vertex_colours {
            true => albedo,
            false => 1.0,
        };
        let diffuse_error = self.length_error(lighting);
        // (1 − E)ⁿ is 1 − n E at least, and 1 − E for an exponent below 1.
        let power = match lighting.specular {
            SpecularModel::Phong => 0.0,
            SpecularModel::Blinn => f64::from(lighting.shininess).max(1.0),
        };
        let factor = match lighting.gate {
            SpecularGate::Weighted => 1.0,
            _ => 0.0,
        };
        let specular_error = (power + factor) * diffuse_error;
        let sum = |colour: fn(&LightTerm) -> [f32; 3], c: usize| -> f64 {
            let all = lighting.lights.iter().zip(&seen.strengths);
            all.map(|(light, strength)| strength * f64::from(colour(light)[c]))
                .sum()
        };
        let diffuse = [0, 1, 2].map(|c| albedo * sum(|l| l.diffuse, c));
        let specular = [0, 1, 2].map(|c| sum(|l| l.specular, c));
        let of_channels =
            |of: &dyn Fn(usize) -> f64| [0, 1, 2].map(of).into_iter().fold(0.0, f64::max);
        let lost = |c: usize| lost(diffuse_error, diffuse[c]) + lost(specular_error, specular[c]);
        let dull = |c: usize| albedo * f64::from(lighting.ambient[c]) + diffuse[c];
        let most = |c: usize| dull(c) + specular[c];
        MaterialBound {
            lighting,
            power: self.power(),
            half: seen.half,
            most: match self.info().roundings.of {
                Stepped::Sums => f64::max(1.0, of_channels(&most)),
                _ => 1.0,
            },
            other: of_channels(&lost) + ROUNDING * lighting.lights.len() as f64,
            albedo,
            dull: match lighting.vertex_colours {
                true => of_channels(&dull),
                false => 0.0,
            },
            diffuse,
            specular,
        }
    }

    /// Returns the relative error of lengths that the method allows itself on a material.
    fn length_error(&self, lighting: &Lighting) -> f64 {
        let all = self.info().parameters.iter().zip(self.parameters());
        all.filter(|(_, value)| **value == Value::Auto)
            .filter_map(|(parameter, _)| parameter.auto)
            .map(|auto| f64::from((auto.length_error)(lighting)))
            .fold(0.0, f64::max)
    }
}

/// Returns the largest channel of a vertex colour; 1 where no material is multiplied by them.
fn largest_colour(frame: &Frame) -> f64 {
    match frame.is_coloured() {
        true => {
            let all = (0..frame.vertices().len() as u32).map(|v| frame.colour(v));
            f64::from(all.flatten().fold(0.0, f32::max))
        }
        false => 1.0,
    }
}

/// Returns the error of the cosines that the light model sees on a polygon, that of lit colours of at most 1 which are stepped over
/// it, and that of vertex colours of at most 1.
fn errors(
    entry: &MethodRow,
    frame: &Frame,
    polygon: &Polygon,
    spread: PolygonSpread,
) -> (f64, [f64; 2]) {
    let info = entry.info;
    let Roundings { start, step, of } = info.roundings;
    let (extent, vectors) = (Extent::of(frame, polygon), spread.vectors);
    // A rounding where the weight of perspective is largest counts for more where it is smallest.
    let weights = match entry.needs.perspective {
        Perspective::Free | Perspective::Divides => extent.weights,
        Perspective::Unaffected | Perspective::ScreenOnly => 1.0,
    };
    // True if vectors to places are stepped beside normals.
    let is_followed = frame.is_local() && entry.needs.local == Local::PerPixel;
    // Colours may differ by all that they are, weights by 1 − 1/σ of the largest.
    let apart = match of {
        Stepped::Colours | Stepped::Sums => 1.0,
        _ => {
            let vectors = if is_followed { spread.apart } else { 0.0 };
            f64::min(2.0, extent.apart() + vectors + 1.0 - 1.0 / weights)
        }
    };
    let stepped = |step: f64| match step > 0.0 {
        true => {
            let spans = step * extent.steps + 8.0 * apart;
            let triangles = extent.triangle_roundings(step, apart);
            spans.max(triangles).max(BARYCENTRIC)
        }
        false => 0.0,
    };
    let rounding = ROUNDING * weights;
    // The least length that a normal has before it is normalised.
    let length = match entry.needs.lit_at {
        LitAt::Polygon | LitAt::Vertex => 1.0,
        LitAt::PolygonMean => wide(frame.mean(polygon).normal).length().min(1.0),
        LitAt::Pixel => extent.cosine,
    };
    let over_length = match length > 0.0 {
        true => 1.0 / length,
        false => f64::INFINITY,
    };
    let cosine = match of {
        Stepped::Colours | Stepped::Sums => rounding * start * vectors * over_length,
        Stepped::Cosines => rounding * (start + stepped(step)) * vectors * over_length,
        Stepped::GreatCircles => {
            rounding * (start + stepped(step)) * vectors * over_length * over_length
        }
        // Squares of weighted vectors have the squares of the weights.
        Stepped::Products => {
            // With positions three products are stepped: L·N is off by 3 a step, as D, and the roots of N·N and L·L by half of it each.
            let (step, vectors) = match is_followed {
                true => (step.max(6.0), vectors * vectors),
                false => (step, vectors),
            };
            let rounding = rounding * weights * over_length * over_length;
            rounding * (start + stepped(step)) * vectors
        }
    };
    let colours = match of {
        Stepped::Colours | Stepped::Sums => rounding * stepped(step),
        _ => 0.0,
    };
    let albedo = match entry.needs.lit_at {
        LitAt::Pixel => {
            let spans = extent.steps + 8.0;
            let triangles = extent.triangle_roundings(1.0, 1.0);
            rounding * (4.0 + spans.max(triangles).max(BARYCENTRIC))
        }
        _ => 2.0 * ROUNDING,
    };
    (cosine, [colours, albedo])
}

/// The light model on a material, as it passes errors on.
struct MaterialBound<'a> {
    lighting: &'a Lighting,
    power: Power,
    /// The least |L + V|.
    half: f64,
    /// All light together, where colours are clamped after they are stepped; else 1.
    most: f64,
    /// The errors that no polygon changes: faint highlights, and the loss that lengths are allowed.
    other: f64,
    /// The largest channel of a vertex colour; 1 without.
    albedo: f64,
    /// All ambient and diffuse light, which vertex colours multiply; 0 without.
    dull: f64,
    /// The greatest sums of all lights, by channel.
    diffuse: [f64; 3],
    specular: [f64; 3],
}

impl MaterialBound<'_> {
    /// Returns the bound where cosines are off by `cosine`, lit colours of at most 1 that are stepped by `stepped`, and vertex colours of
    /// at most 1 by `albedo`.
    fn of(&self, cosine: f64, [stepped, albedo]: [f64; 2]) -> f64 {
        let highlight = highlight_error(self.lighting, self.power, self.half, cosine);
        // A falloff is off by twice what its distance is, which is one error of a cosine; the colour by as much.
        let falls = if self.lighting.is_attenuated() {
            2.0
        } else {
            0.0
        };
        let off = |c: usize| {
            let (diffuse, specular) = (self.diffuse[c], self.specular[c]);
            (diffuse + falls * (diffuse + specular)) * cosine + highlight * specular
        };
        let lit = [0, 1, 2].map(off).into_iter().fold(cosine, f64::max);
        lit + stepped * self.most + albedo * self.dull + self.other
    }

    /// Returns the most that a highlight may be where an error moves L·N from 0: there it ends with a jump, if it is gated.
    ///
    /// With L·N = 0 the cosine R·V is −L·V, and N·H at most √(1 − (L·V)²)/h = √((1 − L·V)/2), as h² = 2 + 2 L·V.
    fn jump(&self, error: Approximation) -> f64 {
        let lighting = self.lighting;
        let is_moved = error.cosine > 0.0 || error.moves_gate;
        if !is_moved || lighting.gate != SpecularGate::Gated {
            return 0.0;
        }
        let l_v = self.half * self.half / 2.0 - 1.0;
        let cosine = match lighting.specular {
            SpecularModel::Phong => (-l_v).max(0.0),
            SpecularModel::Blinn => libm::sqrt((1.0 - l_v) / 2.0),
        };
        let highlight = libm::pow(cosine, f64::from(lighting.shininess));
        self.specular.into_iter().fold(0.0, f64::max) * highlight
    }
}

/// Returns the part of a sum of terms, clamped at 1, that is lost by a relative error of the lengths that divide them.
fn lost(error: f64, sum: f64) -> f64 {
    sum.min(1.0) * error / (1.0 - error)
}
