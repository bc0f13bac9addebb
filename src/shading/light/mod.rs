//! The light model: all of equation 2.1, with the clamps that the lecture omits.
//!
//! ```text
//! I = I_a k_a + Σ I_p k_d max(0, L·N) + Σ I_p k_s max(0, R·V)^n  where L·N > 0       (L21 2.1, with clamps)
//! R = 2 (L·N) N − L
//! ```
//!
//! [`Uniforms`] are made once per material; [`Lit`] is one point (or a block of points) that sees them. `Lit::power` gates the cosine
//! of a highlight and raises it to n, for every method. Questions that the lecture leaves open are settled here:
//! - `L·N` and `R·V` are clamped at 0 *before* the power (an even power of a negative number would light the far side);
//! - there is no specular light where `L·N ≤ 0`, unless the scene asks for one of the other two forms of [`SpecularGate`];
//! - highlights of at most 2⁻²⁴ are none (`LightModel::faint`): they would change nothing, and their powers run through subnormal
//!   numbers, which cost some processors 150 cycles each;
//! - all lights are summed, then the sum is clamped to 0..=1 once;
//! - with [`SpecularModel::Blinn`] the cosine is `N·H`, `H = (L + V) / |L + V|` (CS171 2); where light and eye are opposite, H has
//!   no direction, and there is no highlight;
//! - a light that falls off does so in both terms, and ambient light does not (CS171 2, Attenuation);
//! - vertex colours multiply `k_a` and `k_d` and not `k_s`, where the material asks for it, as OpenGL's `GL_AMBIENT_AND_DIFFUSE` does.
//!
//! A normal that vanishes has no direction: its cosines are 0/0, the clamps turn them into 0, and ambient light remains.

pub(crate) mod eye_frame;
pub(crate) mod powers;

use crate::integer::{Material, Rgb888};
use crate::number::{Num, Vec3, vec3};
use crate::scene::{Falloff, Lighting, Place, Power, SpecularGate, SpecularModel};
use crate::shading::light::eye_frame::EyeFrame;
use crate::shading::light::powers::{Exponent, power_by_call, squared_up_to_7};
use crate::shading::walks::values::PerLight;
use crate::sync::Arc;
use alloc::vec::Vec;

/// Squared distances below this count as this: a light in the surface itself has no direction and no finite `1/r²`.
const LEAST_SQUARE: f32 = 1e-30;

/// The largest rounding of a colour of ½ or more: half a unit in the last place, 2⁻²⁴.
const FAINT: f32 = 1.0 / (1 << 24) as f32;

/// The light on one material, as kernels read it: plain values, made once per material.
#[doc(hidden)]
#[derive(Clone, Debug)]
pub struct Uniforms {
    /// The part that all lights share.
    pub model: LightModel,
    /// The lights.
    pub lights: Vec<LightUniforms>,
    /// The table of [`Power::Table`], in steps of the cosine from the faintest highlight to 1, which polygons that see the lights from
    /// their own places share; `None` for other functions.
    powers: Option<Arc<Vec<f32>>>,
    /// The tables of a method in integers, one a light; else empty.
    pub(crate) materials: Vec<Material<Rgb888>>,
    /// The frame of eye and first light, for methods that turn normals into it: see [`eye_frame`].
    pub(crate) eye_frame: Option<EyeFrame>,
}

/// The uniforms of a material that all its lights share. Pixel loops copy them: behind a reference they would be loaded again
/// after every store.
#[derive(Clone, Copy, Debug)]
pub struct LightModel {
    /// The factor in all colours: 255 where they become bytes, else 1.
    pub scale: f32,
    ambient: Vec3<f32>,
    /// The unit vector toward the eye, or its position.
    pub(crate) eye: Place<Vec3<f32>>,
    /// The cosine that is raised to the exponent.
    pub specular: SpecularModel,
    pub(crate) gate: SpecularGate,
    /// The exponent n, as a value and as it is computed.
    pub shininess: f32,
    pub(crate) exponent: Exponent,
    /// Cosines up to this have no highlight: `k_s cos^n ≤ 2⁻²⁴` for the strongest light.
    pub(crate) faint: f32,
    /// True if `k_a` and `k_d` are multiplied by the vertex colour: [`Lighting::vertex_colours`].
    pub(crate) has_albedo: bool,
    /// True if anything is asked for beside directional lights, R·V, highlights that end where L·N = 0, and one colour a material.
    pub is_general: bool,
    /// True if blocks may take the fast path: not general, an exponent of a few squarings, no colour of 2³⁰ or more.
    pub is_fast: bool,
}

/// The uniforms of a material as pixel loops hold them.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Stored<'a> {
    /// The part that all lights share.
    pub model: LightModel,
    /// The lights.
    pub lights: &'a [LightUniforms],
    pub(crate) powers: &'a [f32],
}

/// A light on a material.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct LightUniforms {
    /// The unit vector toward it, or its position.
    pub(crate) place: Place<Vec3<f32>>,
    /// None of a light at infinity.
    pub(crate) falloff: Falloff,
    pub(crate) diffuse: Vec3<f32>,
    pub(crate) specular: Vec3<f32>,
    /// L·V and 1/|L + V| where both are at infinity.
    pub(crate) l_v: f32,
    pub(crate) half: f32,
}

impl Uniforms {
    /// Prepares the light on a material, with colours multiplied by `scale`.
    pub fn new(lighting: &Lighting, power: Power, scale: f32) -> Uniforms {
        let lights = lighting.lights.iter().map(|light| LightUniforms {
            place: light.place.map(vec3),
            falloff: match light.place {
                Place::Local(_) => light.falloff,
                Place::Infinite(_) => Falloff::None,
            },
            diffuse: vec3(light.diffuse) * scale,
            specular: vec3(light.specular) * scale,
            l_v: 0.0,
            half: 0.0,
        });
        let lights: Vec<LightUniforms> = lights.collect();
        let model = LightModel {
            scale,
            ambient: vec3(lighting.ambient) * scale,
            eye: lighting.view.map(vec3),
            specular: lighting.specular,
            gate: lighting.gate,
            shininess: lighting.shininess,
            exponent: Exponent::Whole(0),
            faint: faint(power, lighting.shininess, scale, &lights),
            has_albedo: lighting.vertex_colours,
            is_general: true,
            is_fast: false,
        };
        let exponent = Exponent::new(power, model.shininess, model.faint);
        let powers = exponent.table(model.shininess, model.faint).map(Arc::new);
        Uniforms::derived(LightModel { exponent, ..model }, lights, powers)
    }

    /// Returns the part that all lights share, without lights and tables.
    pub(crate) fn bare(&self) -> Uniforms {
        Uniforms {
            model: self.model,
            lights: Vec::new(),
            powers: None,
            materials: Vec::new(),
            eye_frame: None,
        }
    }

    /// Returns the same light as directional lights: as `point` sees it. The lecture assumes so along a polygon (L21 1).
    pub fn seen_from(&self, point: [f32; 3]) -> Uniforms {
        self.seen_from_in(point, Vec::new())
    }

    /// Does the same in memory that other lights had.
    pub(crate) fn seen_from_in(&self, point: [f32; 3], mut memory: Vec<LightUniforms>) -> Uniforms {
        let lit = Lit::new(self.stored(), 0.0, true).at(vec3(point));
        let lights = lit.lights().map(|seen| {
            let strength = seen.strength.unwrap_or(1.0);
            LightUniforms {
                place: Place::Infinite(seen.to),
                falloff: Falloff::None,
                diffuse: seen.light.diffuse * strength,
                specular: seen.light.specular * strength,
                ..*seen.light
            }
        });
        let eye = Place::Infinite(lit.view);
        let model = LightModel { eye, ..self.model };
        memory.clear();
        memory.extend(lights);
        let seen = Uniforms::derived(model, memory, self.powers.clone());
        match self.eye_frame {
            Some(_) => seen.turned(),
            None => seen,
        }
    }

    /// Returns them as points see them.
    #[inline(always)]
    pub fn stored(&self) -> Stored<'_> {
        Stored {
            model: self.model,
            lights: &self.lights,
            powers: self.powers.as_ref().map_or(&[], |powers| &powers[..]),
        }
    }

    /// Fills in all that follows from the places and colours of the lights: cosines between light and eye, and the path that
    /// loops may take.
    fn derived(
        mut model: LightModel,
        mut lights: Vec<LightUniforms>,
        powers: Option<Arc<Vec<f32>>>,
    ) -> Uniforms {
        let mut most = magnitude(model.ambient);
        for light in &mut lights {
            light.l_v = vector(light.place).dot(vector(model.eye));
            light.half = over_sum(light.l_v);
            most += magnitude(light.diffuse) + magnitude(light.specular);
        }
        model.is_general = model.eye.is_local()
            || lights.iter().any(|light| light.place.is_local())
            || model.specular != SpecularModel::Phong
            || model.gate != SpecularGate::Gated
            || model.has_albedo
            || model.exponent.is_lit_at_zero();
        let is_few_squarings = matches!(model.exponent, Exponent::Squarings(_));
        model.is_fast = !model.is_general && is_few_squarings && most < MOST_LEVELS;
        Uniforms {
            model,
            lights,
            powers,
            materials: Vec::new(),
            eye_frame: None,
        }
    }

    /// True if a light or the eye is at a position.
    pub(crate) fn is_local(&self) -> bool {
        self.model.eye.is_local() || self.lights.iter().any(|light| light.place.is_local())
    }
}

/// Returns a value clamped to 0..=`most`; NaN becomes 0.
#[inline(always)]
pub(crate) fn at_most<F: Num>(value: F, most: f32) -> F {
    -(-value.max(0.0)).max(-most)
}

/// Returns the largest magnitude of a channel.
pub(crate) fn magnitude(v: Vec3<f32>) -> f32 {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}

/// Levels that are stored without a clamp are below this: an `i32` holds them.
const MOST_LEVELS: f32 = 1_073_741_824.0;

/// Returns how strong a light is at the squared distance `square`; `None` is full strength. `unit` is 1, or the factor in
/// all squared distances.
#[inline(always)]
pub(crate) fn strength<F: Num>(falloff: Falloff, square: F, unit: F) -> Option<F> {
    let square = square.max(LEAST_SQUARE);
    match falloff {
        Falloff::None => None,
        Falloff::Attenuation(k) => Some(unit / (unit + square * k)), // 1 / (1 + k d²)
        Falloff::InverseSquare => Some(unit / square),               // 1 / r²
        Falloff::Inverse => Some((unit / square).sqrt()),            // 1 / r
    }
}

/// Returns a direction or a position as the vector that it is.
#[inline(always)]
pub(crate) fn vector(place: Place<Vec3<f32>>) -> Vec3<f32> {
    let (Place::Infinite(v) | Place::Local(v)) = place;
    v
}

/// Returns the vector from `point` toward a place, not normalised; both multiplied by `weight`, as under perspective.
#[inline(always)]
pub(crate) fn toward<F: Num>(place: Place<Vec3<f32>>, point: Vec3<F>, weight: F) -> Vec3<F> {
    let to = vector(place).broadcast(weight) * weight;
    if place.is_local() { to - point } else { to }
}

/// Returns 1 / |L + V| from L·V of unit vectors, as |L + V|² = 2 + 2 L·V; 0 where light and eye are opposite.
#[inline(always)]
fn over_sum<F: Num>(l_v: F) -> F {
    let square = l_v * 2.0 + 2.0;
    (square.broadcast(1.0) / square.sqrt()).gate(square, SpecularModel::LEAST_SUM)
}

/// Returns the cosine up to which no light has a highlight over 2⁻²⁴, t = (2⁻²⁴ / k)^(1/n), with k the strongest highlight at
/// its light's greatest strength. No power over t is subnormal. To the power 0 every cosine is 1.
fn faint(function: Power, shininess: f32, scale: f32, lights: &[LightUniforms]) -> f32 {
    if shininess == 0.0 {
        return f32::NEG_INFINITY;
    }
    let strongest = lights.iter().map(|light| {
        let nearest = strength(light.falloff, 0.0, 1.0);
        magnitude(light.specular) * nearest.unwrap_or(1.0)
    });
    let faint = FAINT * scale;
    let power = (faint / strongest.fold(faint, f32::max)).max(LEAST_POWER);
    let n = shininess;
    let cosine = match function {
        Power::Squaring | Power::Table { .. } => libm::powf(power, 1.0 / n),
        _ if n < 1.0 => libm::powf(power, 1.0 / n),
        Power::Exp => 1.0 + libm::logf(power) / n,
        Power::Lyon { k } => {
            let m = (1 << k) as f32;
            1.0 - (1.0 - libm::powf(power, 1.0 / m)) * m / n
        }
        Power::Schlick => power * n / (1.0 + power * (n - 1.0)),
    };
    // A function that is over it at 0 is so everywhere.
    if cosine < 0.0 {
        f32::NEG_INFINITY
    } else {
        cosine
    }
}

/// Twice the least normal number: t and its power are rounded. Only lights over 2.5 that fall off by 1/r² get here; what is left
/// out is then over 2⁻²⁴ at distances of 10⁻¹⁵ or so.
const LEAST_POWER: f32 = 2.0 * f32::MIN_POSITIVE;

/// Returns how far a highlight of `lighting` is off, as a share of `I_p k_s`, if the cosines of unit vectors are off by `e`;
/// `half` is |L + V|.
///
/// `R·V = 2 (L·N)(N·V) − L·V` is off by up to four times as much; of `N·H = (L·N + V·N) / h` the sum is off by twice that and
/// h by e/h, so that it is off by `2 e/h + e/h²`. An exponent of 1 or more multiplies by n, and by more where the cosine is passed 1: t off by x
/// leaves tⁿ off by (1 + x)ⁿ − 1 at most, and other functions by eⁿˣ − 1; Schlick's ends at 1, and a table goes on in a line. One below 1 is
/// concave, and infinitely steep at 0, where highlights end:
/// ```text
/// |aⁿ − bⁿ| ≤ |a − b|ⁿ   for a, b ≥ 0 and 0 < n ≤ 1, with equality at b = 0
/// ```
/// as `aⁿ ≤ bⁿ + (a − b)ⁿ` for a over b. Its power is a logarithm's, off by `(0.7 n (|log₂ x| + 1.5) + 2) 2⁻²³` of xⁿ itself
/// (`number/powf.rs`), which is below 8 · 2⁻²⁴, as `y 2⁻ʸ` is at most 0.54. The power 0 is 1, exactly;
/// it counts as the power 1. Where the highlight is weighted with L·N, it has the error of that, too.
///
/// Of the other functions ([`Power`]) none is steeper than n, and their roundings are: of 2^y, y = n log₂ e (t − 1), 2 of y, which
/// y 2^y ln 2 < ½ multiplies, and 6 of 2^y itself (`number/powf.rs`); of Lyon's line 3, which 2ᵏ multiplies, and 2ᵏ of the squarings; of
/// Schlick's quotient 6; of the place in a table 3 of t, which n multiplies, and 4 of its entries and the line between them.
pub(crate) fn highlight_error(lighting: &Lighting, power: Power, half: f64, e: f64) -> f64 {
    let gain = match lighting.specular {
        SpecularModel::Phong => 4.0,
        SpecularModel::Blinn => 2.0 / half + 1.0 / (half * half),
    };
    let weight = match lighting.gate {
        SpecularGate::Weighted => e,
        _ => 0.0,
    };
    let power = match f64::from(lighting.shininess) {
        0.0 => gain * e,
        n if n < 1.0 => libm::pow(gain * e, n) + 8.0 * f64::from(FAINT),
        n => {
            let roundings = match power {
                Power::Squaring => 0.0,
                Power::Exp => 8.0,
                Power::Lyon { k } => 4.0 * f64::from(1u32 << k),
                Power::Schlick => 6.0,
                Power::Table { .. } => 3.0 * n + 4.0,
            };
            // An approximate cosine may pass 1, where powers are steeper: at most from 1 on.
            let off = match power {
                Power::Squaring => libm::expm1(n * libm::log1p(gain * e)),
                Power::Exp | Power::Lyon { .. } => libm::expm1(gain * n * e),
                Power::Schlick | Power::Table { .. } => gain * n * e,
            };
            off.min(f64::MAX) + roundings * f64::from(FAINT)
        }
    };
    power + weight
}

/// The lights on a material as a point (or a block of points) sees them.
#[derive(Clone, Copy, Debug)]
pub struct Lit<'a, F> {
    /// The uniforms that all lights share.
    pub model: LightModel,
    /// The lights as they are stored.
    pub(crate) stored: &'a [LightUniforms],
    powers: &'a [f32],
    /// The point, and the unit vector toward the eye from it: see [`Lit::at`].
    point: Vec3<F>,
    view: Vec3<F>,
    has_point: bool,
    /// True if it is the light of a walk, which knows nothing of places; false for a vertex, a polygon or a pixel.
    is_of_walk: bool,
    attributes: [F; 4],
    /// The vertex colour at the point; white until it is known.
    albedo: Vec3<F>,
    /// True if `k_a` and `k_d` are multiplied by it.
    has_albedo: bool,
    general: bool,
    zero: F,
}

/// A light as a point sees it.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a, F> {
    /// The index of the light.
    pub index: usize,
    /// The unit vector L toward it.
    pub to: Vec3<F>,
    /// L·V.
    pub l_v: F,
    /// 1 / |L + V|, where highlights are N·H.
    pub half: F,
    pub(crate) strength: Option<F>,
    light: &'a LightUniforms,
}

impl<'a, F: Num> Lit<'a, F> {
    /// Prepares the light as it is before a point is known: only what is at infinity can be asked for. `zero` may be any value.
    /// Pass a constant for `general`: `false` compiles the branch-free loop, which is valid only for models that are not general.
    #[inline(always)]
    pub fn new(stored: Stored<'a>, zero: F, general: bool) -> Self {
        let Stored {
            model,
            lights,
            powers,
        } = stored;
        let zero = zero.broadcast(0.0);
        Lit {
            model,
            stored: lights,
            powers,
            point: vec3([zero; 3]),
            view: vector(model.eye).broadcast(zero),
            has_point: false,
            is_of_walk: true,
            attributes: [zero; 4],
            albedo: vec3([zero.broadcast(1.0); 3]),
            has_albedo: false,
            general,
            zero,
        }
    }

    /// Returns the light as `point` sees it.
    #[inline(always)]
    pub fn at(self, point: Vec3<F>) -> Self {
        self.at_pixel(point, true)
    }

    /// Returns the light as a pixel sees it; without `has_point` its point means nothing, and no vector toward the eye is made.
    #[inline(always)]
    pub(crate) fn at_pixel(mut self, point: Vec3<F>, has_point: bool) -> Self {
        if has_point && self.general && self.model.eye.is_local() {
            self.view = (vector(self.model.eye).broadcast(self.zero) - point).unit();
        }
        (self.point, self.has_point, self.is_of_walk) = (point, has_point, false);
        self
    }

    /// Returns the light with the attributes of a vertex.
    #[inline(always)]
    pub(crate) fn with_attributes(self, attributes: [F; 4]) -> Self {
        Lit { attributes, ..self }
    }

    /// Returns the attributes of a vertex ([`Frame::attributes`](crate::frame::Frame::attributes)), for methods that read them.
    #[inline(always)]
    pub fn attributes(&self) -> [F; 4] {
        self.attributes
    }

    /// Returns the light on a point of this vertex colour, by which `k_a` and `k_d` are multiplied where the material asks for it.
    #[inline(always)]
    pub(crate) fn with_albedo(self, albedo: Vec3<F>) -> Self {
        Lit {
            albedo,
            has_albedo: self.model.has_albedo,
            ..self
        }
    }

    /// Returns ambient or diffuse light times the vertex colour, where the material asks for it.
    #[inline(always)]
    pub(crate) fn times_albedo(&self, light: Vec3<F>) -> Vec3<F> {
        match self.general && self.has_albedo {
            true => vec3([
                light.x * self.albedo.x,
                light.y * self.albedo.y,
                light.z * self.albedo.z,
            ]),
            false => light,
        }
    }

    /// Returns 0 in this backend.
    #[inline(always)]
    pub fn zero(&self) -> F {
        self.zero
    }

    /// Returns the count of lights.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.stored.len()
    }

    /// Returns the position of the point in the world; it means something only if a light or the eye is at a position.
    #[inline(always)]
    pub fn point(&self) -> Vec3<F> {
        debug_assert!(
            self.has_point,
            "a walk has no point, nor has a pixel without positions"
        );
        self.point
    }

    /// Returns the unit vector V toward the eye.
    #[inline(always)]
    pub fn view(&self) -> Vec3<F> {
        debug_assert!(
            !self.is_of_walk || !self.model.eye.is_local(),
            "a walk has no point that an eye at a position could be seen from"
        );
        self.view
    }

    /// Returns the lights as the point sees them.
    #[inline(always)]
    pub fn lights(self) -> impl Iterator<Item = Seen<'a, F>> {
        (0..self.stored.len()).map(
            #[inline(always)]
            move |index| self.seen(index),
        )
    }

    #[inline(always)]
    pub(crate) fn seen(&self, index: usize) -> Seen<'a, F> {
        let (light, one) = (&self.stored[index], self.zero.broadcast(1.0));
        let is_positional = light.place.is_local();
        debug_assert!(
            !self.is_of_walk || !is_positional,
            "a walk has no point that a light at a position could be seen from"
        );
        let mut seen = Seen {
            index,
            to: vector(light.place).broadcast(one),
            l_v: one.broadcast(light.l_v),
            half: one.broadcast(light.half),
            strength: None,
            light,
        };
        if self.general && is_positional {
            let to = seen.to - self.point;
            let square = to.dot(to);
            seen.to = to * (one / square.sqrt());
            seen.strength = strength(light.falloff, square, one);
        }
        if self.general && (is_positional || self.model.eye.is_local()) {
            seen.l_v = seen.to.dot(self.view);
            if self.is_halfway() {
                seen.half = over_sum(seen.l_v);
            }
        }
        seen
    }

    /// Returns a light seen along unit vectors whose L·V is `l_v`, from the squared distance `square`; both squared distances and
    /// `unit` are multiplied by the same.
    #[inline(always)]
    pub fn light(&self, index: usize, l_v: F, square: F, unit: F) -> Seen<'a, F> {
        let light = &self.stored[index];
        let strength = strength(light.falloff, square, unit);
        self.light_of_strength(index, l_v, strength)
    }

    /// Returns a light seen along unit vectors whose L·V is `l_v`, and its strength; `None` is full strength.
    #[inline(always)]
    pub(crate) fn light_of_strength(
        &self,
        index: usize,
        l_v: F,
        strength: Option<F>,
    ) -> Seen<'a, F> {
        Seen {
            index,
            to: self.view,
            l_v,
            half: if self.is_halfway() {
                over_sum(l_v)
            } else {
                l_v
            },
            strength,
            light: &self.stored[index],
        }
    }

    /// Returns the products of `n` with the vectors toward each light and the eye.
    ///
    /// ```text
    /// J = L·N,   K = V·N        (L21 4.3)
    /// ```
    #[inline(always)]
    pub fn products<const L: usize>(&self, n: Vec3<F>) -> (PerLight<F, L>, F) {
        let mut j = PerLight::new(self.stored.len(), n.x);
        for light in self.lights() {
            j.values[light.index] = n.dot(light.to); // J = L · N
        }
        (j, n.dot(self.view())) // K = V · N
    }

    /// Returns the unit vectors L toward a light and H half-way to the eye, of a light and an eye at infinity.
    #[inline(always)]
    pub(crate) fn light_and_half(&self, index: usize) -> [Vec3<f32>; 2] {
        let light = &self.stored[index];
        let to = vector(light.place);
        [to, (to + vector(self.model.eye)) * light.half] // h = (e + l) / |e + l|
    }

    /// Returns the products of `n` with L and with H of each light, of lights and an eye at infinity.
    ///
    /// ```text
    /// J = L·N,   M = H·N
    /// ```
    #[inline(always)]
    pub(crate) fn half_products<const L: usize>(
        &self,
        n: Vec3<F>,
    ) -> (PerLight<F, L>, PerLight<F, L>) {
        let none = PerLight::new(self.stored.len(), n.x);
        let (mut j, mut m) = (none, none);
        for index in 0..self.stored.len() {
            let [to, half] = self.light_and_half(index);
            j.values[index] = n.dot(to.broadcast(n.x)); // J = L · N
            m.values[index] = n.dot(half.broadcast(n.x)); // M = H · N
        }
        (j, m)
    }

    /// Returns the colour of a surface from the products J and M of its unit normal.
    #[inline(always)]
    pub(crate) fn shade_half_products<const L: usize>(
        &self,
        (j, m): (PerLight<F, L>, PerLight<F, L>),
    ) -> Vec3<F> {
        let mut colour = self.ambient();
        for light in self.lights() {
            let (l_n, n_h) = (j.values[light.index], m.values[light.index]);
            colour = self.add(colour, &light, l_n, n_h);
        }
        colour
    }

    /// Returns `I_a k_a`, `k_a` times the vertex colour where the material asks for it.
    #[inline(always)]
    pub fn ambient(&self) -> Vec3<F> {
        self.times_albedo(self.model.ambient.broadcast(self.zero))
    }

    /// Returns a colour with each channel clamped to 0..=1: for vertices whose pixels need no clamp.
    #[inline(always)]
    pub fn clamped(&self, colour: Vec3<F>) -> Vec3<F> {
        let (Vec3 { x, y, z }, most) = (colour, self.model.scale);
        vec3([at_most(x, most), at_most(y, most), at_most(z, most)])
    }

    /// True if highlights are those of N·H.
    #[inline(always)]
    pub fn is_halfway(&self) -> bool {
        self.general && self.model.specular == SpecularModel::Blinn
    }

    /// Returns R·V, or N·H where the scene asks for it, from L·N and V·N of a unit normal.
    #[inline(always)]
    pub fn highlight(&self, light: &Seen<'a, F>, l_n: F, v_n: F) -> F {
        if self.is_halfway() {
            (l_n + v_n) * light.half // N·H
        } else {
            (v_n * 2.0).mul_add(l_n, -light.l_v) // 4.5
        }
    }

    /// Returns the cosine of [`Lit::highlight`] with R built as the lecture prints it.
    #[inline(always)]
    pub fn reflection(&self, light: &Seen<'a, F>, n: Vec3<F>, l_n: F) -> F {
        if self.is_halfway() {
            let h = (light.to + self.view) * light.half; // h = (e + l) / |e + l|
            n.dot(h)
        } else {
            let r = n * (l_n * 2.0) - light.to; // R = 2 (L·N) N − L
            r.dot(self.view)
        }
    }

    /// Returns `colour` and what a light adds to it, from L·N and from the cosine of its highlight.
    #[inline(always)]
    pub fn add(&self, colour: Vec3<F>, light: &Seen<'a, F>, l_n: F, cosine: F) -> Vec3<F> {
        let diffuse = l_n.max(0.0);
        let colour = self.add_diffuse(colour, light, diffuse);
        self.add_highlight(colour, light, diffuse, cosine)
    }

    /// Returns `colour` and the diffuse term of a light, from L·N, 0 or more.
    #[inline(always)]
    pub fn add_diffuse(&self, colour: Vec3<F>, light: &Seen<'a, F>, diffuse: F) -> Vec3<F> {
        self.plus_diffuse(colour, light.times_strength(diffuse), light) // 2.1
    }

    /// Returns `colour` plus `factor` times `I_p k_d`, `k_d` times the vertex colour where the material asks for it.
    #[inline(always)]
    fn plus_diffuse(&self, colour: Vec3<F>, factor: F, light: &Seen<'a, F>) -> Vec3<F> {
        match self.general && self.has_albedo {
            true => colour + self.times_albedo(light.light.diffuse.broadcast(factor) * factor),
            false => colour.plus(factor, light.light.diffuse),
        }
    }

    /// Returns `colour` and the highlight of a light, from L·N, 0 or more, and from the cosine of the highlight.
    #[inline(always)]
    pub fn add_highlight(
        &self,
        colour: Vec3<F>,
        light: &Seen<'a, F>,
        diffuse: F,
        cosine: F,
    ) -> Vec3<F> {
        match self.power(light, diffuse, cosine) {
            Some(specular) => colour.plus(specular, light.light.specular), // 2.1
            None => colour,
        }
    }

    /// Returns `colour` and what a light of these two terms adds to it: for highlights of a method's own.
    #[inline(always)]
    pub fn plus(&self, colour: Vec3<F>, light: &Seen<'a, F>, diffuse: F, specular: F) -> Vec3<F> {
        let colour = self.plus_diffuse(colour, light.times_strength(diffuse), light);
        colour.plus(light.times_strength(specular), light.light.specular)
    }

    /// Returns the colour of a surface from the products J and K of its unit normal.
    #[inline(always)]
    pub fn shade_products<const L: usize>(&self, (j, k): (PerLight<F, L>, F)) -> Vec3<F> {
        let mut colour = self.ambient();
        for light in self.lights() {
            let l_n = j.values[light.index];
            colour = self.add(colour, &light, l_n, self.highlight(&light, l_n, k)); // 4.5
        }
        colour
    }

    /// Returns the colour of a surface with the unit normal `n`.
    #[inline(always)]
    pub fn shade(&self, n: Vec3<F>) -> Vec3<F> {
        let mut colour = self.ambient();
        for light in self.lights() {
            let l_n = n.dot(light.to);
            colour = self.add(colour, &light, l_n, self.reflection(&light, n, l_n));
        }
        colour
    }

    /// Returns the colour of [`Lit::shade`] in two parts: ambient and diffuse light, and highlights.
    #[inline(always)]
    pub fn shade_apart(&self, n: Vec3<F>) -> (Vec3<F>, Vec3<F>) {
        let (mut dull, mut bright) = (self.ambient(), vec3([self.zero; 3]));
        for light in self.lights() {
            let l_n = n.dot(light.to);
            let diffuse = l_n.max(0.0);
            dull = self.add_diffuse(dull, &light, diffuse);
            let cosine = self.reflection(&light, n, l_n);
            if let Some(specular) = self.power(&light, diffuse, cosine) {
                bright = bright.plus(specular, light.light.specular);
            }
        }
        (dull, bright)
    }

    /// Returns the cosine of a highlight to the power n, gated and times the light's strength; `None` where no pixel has one:
    /// the early exit of most blocks, as highlights are half of the work. `diffuse` is L·N, 0 or more.
    #[inline(always)]
    fn power(&self, light: &Seen<'a, F>, diffuse: F, mut cosine: F) -> Option<F> {
        let LightModel { gate, exponent, .. } = self.model;
        let gated = !self.general || gate == SpecularGate::Gated;
        if gated {
            cosine = cosine.gate(diffuse, 0.0);
        }
        if !cosine.any_over(self.model.faint) {
            return None;
        }
        if F::WIDTH > 1 {
            // Faint lanes become 0 here too, so that a pixel does not depend on its block.
            cosine = cosine.gate(cosine, self.model.faint);
        }
        let mut power = match exponent {
            Exponent::Squarings(times) => squared_up_to_7(cosine, times),
            _ if !self.general && F::WIDTH > 1 => return None, // the fast path has no other
            _ if F::WIDTH == 1 => power_by_call(exponent, cosine, self.powers),
            _ => exponent.of_or_read(cosine, self.powers),
        };
        if self.general {
            if exponent.is_lit_at_zero() {
                power = power.gate(cosine, self.model.faint);
                if gated {
                    power = power.gate(diffuse, 0.0); // 0⁰ is 1, behind the surface too
                }
            }
            if gate == SpecularGate::Weighted {
                power = power * diffuse;
            }
            power = light.times_strength(power);
        }
        Some(power)
    }
}

impl<F: Num> Seen<'_, F> {
    /// Returns `I_p k_d`.
    pub(crate) fn diffuse(&self) -> Vec3<f32> {
        self.light.diffuse
    }

    #[inline(always)]
    fn times_strength(&self, x: F) -> F {
        match self.strength {
            Some(strength) => x * strength,
            None => x,
        }
    }
}

#[cfg(test)]
mod tests;
