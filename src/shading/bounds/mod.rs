//! Error bounds: the largest difference between a method's picture and its closed form, derived by
//! counting roundings.

pub(crate) mod light_ranges;
pub(crate) mod polygon_ranges;

use crate::frame::{Frame, Polygon};
use crate::scene::{LightTerm, Lighting, Power, SpecularGate, SpecularModel};
use crate::shading::bounds::light_ranges::{PolygonSpread, SeenLights, Spread};
use crate::shading::bounds::polygon_ranges::{Extent, wide};
use crate::shading::light::highlight_error;
use crate::shading::{Approximation, Local, MethodRow, Perspective, ShadingRate, Value, Variant};
use alloc::vec::Vec;

/// The rounding error of a value of 0.5..1: half a unit in the last place of an `f32`.
const ROUNDING: f64 = 1.0 / (1u64 << 24) as f64;

/// The roundings of a value of at most 1 that is interpolated by barycentric coordinates and not
/// stepped: an integer, the inverse area (two), their product, another product and two sums.
const BARYCENTRIC: f64 = 7.0;

/// How many roundings of 2⁻²⁴ a method's cosines (or colours) gather.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Roundings {
    /// Those before the first step.
    pub start: f64,
    /// Those at every step along an edge or a span. Steps add the same rounded increment again and
    /// again, so their roundings do not average out: they grow with the count of steps.
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
    /// Colours of at most 1: the picture has the same error.
    Colours,
    /// Colours that are clamped after they are stepped: their error grows with the total light, if
    /// it is over 1.
    Sums,
    /// Normals or cosines: the light model comes after and multiplies their errors.
    Cosines,
    /// Normals or cosines along great circles. Like [`Stepped::Cosines`], but spans go between
    /// points of edges.
    GreatCircles,
    /// Products of two vectors that grow linearly: the light model comes after and multiplies their
    /// errors.
    Products,
}

impl Variant {
    /// Returns the largest difference that rounding in `f32` can make between this method's picture
    /// of `frame` and its closed form ([`super::Info::model`]), in a linear channel of 0..=1. A
    /// bound of 1 says nothing.
    ///
    /// It is the largest bound of all polygons ([`Variant::polygon_bounds`]), which are derived as
    /// follows.
    ///
    /// **Steps.** After s steps from a corner to a pixel, a value of at most 1 has an error of
    /// `(start + step · s) · 2⁻²⁴`.
    ///
    /// **Set-up.** Steps begin from parameters, which are rounded too, and which multiply the
    /// differences of corners, at most δ. Between edges a parameter is rounded 4 times with its
    /// difference and product, and along edges as often: 8 δ. The barycentric renderer steps
    /// nothing: coordinates, products and sums take 7 roundings of values.
    ///
    /// **Triangles in the row engine** have barycentric coordinates, which with their differences
    /// take 5 roundings at the start of a run. Their growth takes 5, over a run on which both grow
    /// by 1 at most: 15 δ. A small triangle begins up to 15 rows and 7 columns away, where
    /// coordinates are up to g larger (`Extent::growth`): both starts take 10 g and both growths 12
    /// g, which adds 22 g δ. From there to a pixel are at most 17 sums, of values as large as
    /// `1 + 2 g δ`. Only linear values are stepped: for a cosine these are two vectors, each
    /// rounded by 0.87.
    ///
    /// **Short normals.** A normal between corners whose normals differ is shorter than 1. Let m be
    /// the unit mean of the corners' normals N_i and `c = min N_i·m`. Every convex combination N
    /// has |N| ≥ N·m ≥ c. Dividing by its length therefore multiplies errors of cosines by up to
    /// 1/c, and errors of products, which are divided by N·N, by up to 1/c². Weights of perspective
    /// are positive and change neither m nor c. Vertices that clipping made lie between others, so
    /// c holds for pieces too. The N_i are within θ of m, cos θ = c, so that δ ≤ 2 sin θ. A great
    /// circle divides by sin φ. Where φ is at most 90°, both weights are still at most 1; otherwise
    /// `sin φ = 2 sin φ/2 cos φ/2 ≥ √2 c`, as cos φ/2 is the length of the chord's middle. Points
    /// of edges lie in the same cone, and the span between them divides once more: 1/c². Where c is
    /// 0 or less the bound is 1.
    ///
    /// **Light.** An error e of a cosine becomes `e I_p k_d` in the diffuse term.
    /// `R·V = 2 (L·N)(N·V) − L·V` has an error of up to 4 e, which the power multiplies by n. In
    /// `N·H = (L·N + V·N) / h`, h = |L + V|, the sum has an error of 2 e and h one of e/h, which
    /// makes `2 e/h + e/h²`: less than 4 e while h is over 0.81. An exponent below 1 is infinitely
    /// steep at 0: where a highlight ends, its power has an error of up to (4 e)^n.
    ///
    /// A vector toward a place is rounded where it is longest and divided by its length where it is
    /// shortest. With a spread of σ between the two, errors of its direction are multiplied by σ
    /// and those of its square by σ². Where these vectors are stepped, δ is larger by the size of
    /// the polygon over the longest vector. A falloff multiplies colours and their errors by at
    /// most the light's strength where it is nearest, and has the error of the square itself.
    ///
    /// **Vertex colours** of at most A multiply ambient and diffuse light M, so they multiply its
    /// errors by A. Interpolated, they have the error of any stepped colour, and of 4 roundings
    /// before: this adds A M times as much. The mean of a polygon's colours takes one rounding, a
    /// product another.
    ///
    /// A faint highlight is left out: `I_p k_s (R·V)^n` of at most 2⁻²⁴ per light. Its threshold
    /// `t = (2⁻²⁴ / k)^(1/n)` is rounded, so that t^n has a relative error of `(43 + n) 2⁻²³`; the
    /// roundings of a highlight, n times 4 · 2⁻²⁴, leave room for that. For an exponent below 1,
    /// the threshold is below all errors of cosines, and (4 e)^n holds there as elsewhere.
    ///
    /// What a method leaves out by design ([`super::Info::approximation`]) is added to the error of
    /// cosines or colours. Another power function ([`Power`]) has its own slope in place of n, and
    /// its own roundings in place of none.
    ///
    /// Where a method chooses a parameter by itself ([`super::Auto`]), lengths may be too large by
    /// the relative error E that it tolerates. The diffuse terms D are divided by them and lose at
    /// most E D. After the clamp at most E/(1 − E) of this is left, as all other terms are 0 or
    /// more. N·H is divided by them too, and its power n loses n times as much of the specular
    /// terms. R·V is divided by the squared length, which has no such error. A highlight that is
    /// weighted with L·N loses as much as L·N.
    ///
    /// The bound does not include other errors of the method itself, as those of a fixed count of
    /// Newton's steps on short spans with large angles. Nor does it include the gate: a highlight
    /// ends with a jump where L·N = 0, and where a light lies in the plane of a polygon the last
    /// bit decides if all of it is there. Where the difference exceeds this bound, the report says
    /// so.
    pub fn bound(&self, frame: &Frame) -> f64 {
        self.polygon_bounds(frame).fold(0.0, f64::max)
    }

    /// Returns the largest difference from its method's model with tⁿ, in a linear channel of
    /// 0..=1, that the variant may make by design: by what the method leaves out
    /// ([`super::Info::approximation`]) and by its power function ([`Power::error`]).
    pub fn approximation(&self, frame: &Frame) -> f64 {
        let spread = Spread::of(frame);
        let albedo = largest_colour(frame);
        let materials: Vec<MaterialBound<'_>> = frame
            .lightings()
            .iter()
            .zip(&spread.materials)
            .map(|(lighting, seen)| self.material_bound(lighting, seen, albedo))
            .collect();
        let info = self.row().on(frame).info;
        // Computed once per material, as each takes thousands of powers.
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

    /// Returns [`Variant::bound`] of each polygon of `frame`, in order.
    pub fn polygon_bounds<'a>(&'a self, frame: &'a Frame) -> impl Iterator<Item = f64> + 'a {
        let spread = Spread::of(frame);
        let albedo = largest_colour(frame);
        let materials: Vec<MaterialBound<'a>> = frame
            .lightings()
            .iter()
            .zip(&spread.materials)
            .map(|(lighting, seen)| self.material_bound(lighting, seen, albedo))
            .collect();
        let polygons = frame.polygons().iter().enumerate();
        let row = self.row().on(frame);
        polygons.map(move |(index, polygon)| {
            let (cosine, colours) = errors(row, frame, polygon, spread.on(index));
            let material = &materials[polygon.material as usize];
            let error = (row.info.approximation)(frame, polygon, self.parameters());
            let cosine = cosine + error.cosine + error.length;
            let colour = error.colour * material.albedo.max(1.0);
            let bound = material.of(cosine, colours) + material.jump(error) + colour;
            // No channel can differ by more than 1; NaN becomes 1 too.
            if bound <= 1.0 { bound } else { 1.0 }
        })
    }

    /// Returns how a material's light passes errors on, where vertex colours are at most `albedo`.
    fn material_bound<'a>(
        &self,
        lighting: &'a Lighting,
        seen: &SeenLights,
        albedo: f64,
    ) -> MaterialBound<'a> {
        let albedo = if lighting.vertex_colours { albedo } else { 1.0 };
        let diffuse_error = self.length_error(lighting);
        // (1 − E)ⁿ ≥ 1 − n E for n ≥ 1, and ≥ 1 − E for an exponent below 1.
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
            dull: if lighting.vertex_colours {
                of_channels(&dull)
            } else {
                0.0
            },
            diffuse,
            specular,
        }
    }

    /// Returns the largest relative error of lengths that the method tolerates on a material.
    fn length_error(&self, lighting: &Lighting) -> f64 {
        let all = self.info().parameters.iter().zip(self.parameters());
        all.filter(|(_, value)| **value == Value::Auto)
            .filter_map(|(parameter, _)| parameter.auto)
            .map(|auto| f64::from((auto.length_error)(lighting)))
            .fold(0.0, f64::max)
    }
}

/// Returns the largest channel of a vertex colour; 1 if no material uses them.
fn largest_colour(frame: &Frame) -> f64 {
    if frame.is_coloured() {
        let all = (0..frame.vertices().len() as u32).map(|v| frame.colour(v));
        f64::from(all.flatten().fold(0.0, f32::max))
    } else {
        1.0
    }
}

/// Returns three errors on a polygon: of the cosines that the light model reads; of lit colours of
/// at most 1 that are stepped; and of vertex colours of at most 1.
fn errors(
    row: &MethodRow,
    frame: &Frame,
    polygon: &Polygon,
    spread: PolygonSpread,
) -> (f64, [f64; 2]) {
    let info = row.info;
    let Roundings { start, step, of } = info.roundings;
    let (extent, vectors) = (Extent::of(frame, polygon), spread.vectors);
    // A rounding where the weight of perspective is largest counts for more where the weight is
    // smallest.
    let weights = match row.needs.perspective {
        Perspective::Free | Perspective::Divides => extent.weights,
        Perspective::Unaffected | Perspective::ScreenOnly => 1.0,
    };
    // True if vectors to lights and eye are stepped beside normals.
    let is_followed = frame.is_local() && row.needs.local == Local::PerPixel;
    // Colours may differ by all they are; weights by 1 − 1/σ of the largest.
    let apart = match of {
        Stepped::Colours | Stepped::Sums => 1.0,
        _ => {
            let vectors = if is_followed { spread.apart } else { 0.0 };
            f64::min(2.0, extent.apart() + vectors + 1.0 - 1.0 / weights)
        }
    };
    let stepped = |step: f64| {
        if step > 0.0 {
            // 8 δ are the set-up: see `Variant::bound`.
            let spans = step * extent.steps + 8.0 * apart;
            let triangles = extent.triangle_roundings(step, apart);
            spans.max(triangles).max(BARYCENTRIC)
        } else {
            0.0
        }
    };
    let rounding = ROUNDING * weights;
    // The least length of a normal before it is normalised.
    let length = match row.needs.shading_rate {
        ShadingRate::Polygon | ShadingRate::Vertex => 1.0,
        ShadingRate::PolygonMean => wide(frame.mean(polygon).normal).length().min(1.0),
        ShadingRate::Pixel => extent.cosine,
    };
    let over_length = if length > 0.0 {
        1.0 / length
    } else {
        f64::INFINITY
    };
    let cosine = match of {
        Stepped::Colours | Stepped::Sums => rounding * start * vectors * over_length,
        Stepped::Cosines => rounding * (start + stepped(step)) * vectors * over_length,
        Stepped::GreatCircles => {
            rounding * (start + stepped(step)) * vectors * over_length * over_length
        }
        // Squares of weighted vectors carry the squares of the weights.
        Stepped::Products => {
            // With positions three products are stepped: L·N has an error of 3 per step, as D, and
            // the roots of N·N and L·L half of it each.
            let (step, vectors) = if is_followed {
                (step.max(6.0), vectors * vectors)
            } else {
                (step, vectors)
            };
            let rounding = rounding * weights * over_length * over_length;
            rounding * (start + stepped(step)) * vectors
        }
    };
    let colours = match of {
        Stepped::Colours | Stepped::Sums => rounding * stepped(step),
        _ => 0.0,
    };
    let albedo = match row.needs.shading_rate {
        ShadingRate::Pixel => {
            let spans = extent.steps + 8.0;
            let triangles = extent.triangle_roundings(1.0, 1.0);
            rounding * (4.0 + spans.max(triangles).max(BARYCENTRIC))
        }
        _ => 2.0 * ROUNDING,
    };
    (cosine, [colours, albedo])
}

/// The light on a material, in the form in which it passes errors on.
struct MaterialBound<'a> {
    lighting: &'a Lighting,
    power: Power,
    /// The least |L + V|.
    half: f64,
    /// All light together where colours are clamped after they are stepped; otherwise 1.
    most: f64,
    /// The errors that are equal on all polygons: faint highlights, and the loss by lengths that
    /// are too large.
    other: f64,
    /// The largest channel of a vertex colour; 1 without vertex colours.
    albedo: f64,
    /// All ambient and diffuse light, which vertex colours multiply; 0 without vertex colours.
    dull: f64,
    /// The largest sums over all lights, per channel.
    diffuse: [f64; 3],
    specular: [f64; 3],
}

impl MaterialBound<'_> {
    /// Returns the bound for errors of `cosine` in cosines, of `stepped` in lit colours of at most
    /// 1, and of `albedo` in vertex colours of at most 1.
    fn of(&self, cosine: f64, [stepped, albedo]: [f64; 2]) -> f64 {
        let highlight = highlight_error(self.lighting, self.power, self.half, cosine);
        // A falloff has twice the error of its distance, which is one error of a cosine; the colour
        // has the error of the falloff.
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

    /// Returns the largest highlight where an error moves L·N away from 0. A gated highlight ends
    /// there with a jump.
    ///
    /// At L·N = 0 the cosine R·V is −L·V, and N·H is at most √(1 − (L·V)²)/h = √((1 − L·V)/2), as
    /// h² = 2 + 2 L·V.
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

/// Returns how much of a sum of terms, clamped at 1, a relative error of the lengths that divide
/// them takes away.
fn lost(error: f64, sum: f64) -> f64 {
    sum.min(1.0) * error / (1.0 - error)
}
