//! The light model: equation 2.1 with the clamps that the lecture leaves out.
//!
//! ```text
//! I = I_a k_a + Σ I_p k_d max(0, L·N) + Σ I_p k_s max(0, R·V)^n  where L·N > 0       (L21 2.1, with clamps)
//! R = 2 (L·N) N − L
//! ```
//!
//! `Uniforms` hold everything about one material and its lights that is computed once. A method
//! sees them through [`LightAt`], the light at one point (or at a block of points), which iterates
//! over the lights as [`SeenLight`]s. `shade` of most methods is one loop:
//!
//! ```text
//! let mut colour = lit.ambient();
//! for light in lit.lights() {
//!     let l_n = …;                                  // L·N, as the method computes it
//!     let cosine = lit.highlight(&light, l_n, v_n); // R·V, or N·H where the scene asks for it
//!     colour = lit.add(colour, &light, l_n, cosine);
//! }
//! ```
//!
//! # A new highlight
//!
//! *In one method:* compute the term in its `shade` and pass it to [`LightAt::plus`], as
//! `examples/own_shader.rs` does. Nothing here changes.
//!
//! *In all methods:*
//! 1. [`LightAt::highlight`] computes the cosine from the scalars L·N and V·N,
//!    [`LightAt::reflection`] from the unit normal; [`LightAt::is_halfway`] chooses between the two
//!    models that exist;
//! 2. `LightAt::power` gates the cosine and raises it to n; `powers.rs` has the power functions;
//! 3. `faint` and `highlight_error` hold the threshold below which a highlight is left out, and the
//!    error bound;
//! 4. *Another highlight* in `docs/architecture.md` lists the files beyond this one.
//!
//! # What the lecture leaves open
//!
//! - `L·N` and `R·V` are clamped at 0 *before* the power: an even power of a negative value would
//!   light the far side.
//! - There is no specular light where `L·N ≤ 0`, unless the scene asks for one of the other two
//!   forms of [`SpecularGate`].
//! - Highlights of at most 2⁻²⁴ are left out (`LightModel::faint`). They would change no colour,
//!   and their powers would be subnormal, which costs some processors 150 cycles each.
//! - All lights are summed, then the sum is clamped to 0..=1 once.
//! - With [`SpecularModel::Blinn`] the cosine is `N·H`, `H = (L + V) / |L + V|` (CS171 2). Where
//!   light and eye are opposite, H has no direction, and there is no highlight.
//! - The falloff of a light applies to its diffuse and specular terms, not to ambient light (CS171
//!   2, Attenuation).
//! - Vertex colours multiply `k_a` and `k_d` but not `k_s`, where the material asks for them, as
//!   OpenGL's `GL_AMBIENT_AND_DIFFUSE` does.
//!
//! A normal of length 0 has no direction: its cosines are 0/0, the clamps turn them into 0, and
//! ambient light remains.

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

/// The least squared distance to a light, in squared world units. A light in the surface itself
/// would have no direction and no finite `1/r²`.
const LEAST_SQUARE: f32 = 1e-30;

/// The largest rounding error of a colour of ½ or more: half a unit in the last place, 2⁻²⁴.
const FAINT: f32 = 1.0 / (1 << 24) as f32;

/// The light on one material, as kernels read it: plain values that are computed once per material.
#[derive(Clone, Debug)]
pub(crate) struct Uniforms {
    /// The uniforms that all lights share.
    pub model: LightModel,
    /// The lights.
    pub lights: Vec<LightUniforms>,
    /// The table of [`Power::Table`], from the faintest highlight to a cosine of 1 in equal steps
    /// of the cosine; `None` for other power functions. Polygons that see the lights from their own
    /// places share it.
    powers: Option<Arc<Vec<f32>>>,
    /// The tables of an integer method, one per light; empty for other methods.
    pub(crate) materials: Vec<Material<Rgb888>>,
    /// The frame of the eye and the first light, for methods that turn normals into it: see
    /// [`eye_frame`].
    pub(crate) eye_frame: Option<EyeFrame>,
}

/// The uniforms of a material that all its lights share. Pixel loops copy them, because the
/// compiler would load them again after every store if they were behind a reference.
#[derive(Clone, Copy, Debug)]
pub struct LightModel {
    /// The factor in all lights: 255 if colours become bytes and the method
    /// [sums lights](super::Needs::sums_lights), otherwise 1.
    pub scale: f32,
    ambient: Vec3<f32>,
    /// The unit vector toward the eye, or its position.
    pub(crate) eye: Place<Vec3<f32>>,
    /// The cosine that is raised to the exponent.
    pub specular: SpecularModel,
    pub(crate) gate: SpecularGate,
    /// The exponent n.
    pub shininess: f32,
    pub(crate) exponent: Exponent,
    /// Cosines up to this one have no highlight: `k_s cos^n ≤ 2⁻²⁴` for the strongest light.
    pub(crate) faint: f32,
    /// True if `k_a` and `k_d` are multiplied by the vertex colour: [`Lighting::vertex_colours`].
    pub(crate) has_albedo: bool,
    /// True if the light needs the general loops: for anything beyond directional lights, R·V,
    /// highlights that end where L·N = 0, and one colour per material.
    pub is_general: bool,
    /// True if blocks may take the fast path: the light is not general, the exponent takes a few
    /// squarings, and every colour is below 2³⁰.
    pub is_fast: bool,
}

/// The uniforms of a material, borrowed for a pixel loop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UniformsRef<'a> {
    /// The uniforms that all lights share.
    pub model: LightModel,
    /// The lights.
    pub lights: &'a [LightUniforms],
    pub(crate) powers: &'a [f32],
}

/// The uniforms of one light on a material.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightUniforms {
    /// The unit vector toward the light, or its position.
    pub(crate) place: Place<Vec3<f32>>,
    /// [`Falloff::None`] for a light at infinity.
    pub(crate) falloff: Falloff,
    pub(crate) diffuse: Vec3<f32>,
    pub(crate) specular: Vec3<f32>,
    /// L·V and 1/|L + V|, where light and eye are both at infinity.
    pub(crate) l_v: f32,
    pub(crate) half: f32,
}

impl Uniforms {
    /// Prepares the light on a material. Colours are multiplied by `scale`.
    pub fn new(lighting: &Lighting, power: Power, scale: f32) -> Uniforms {
        let lights: Vec<LightUniforms> = lighting
            .lights
            .iter()
            .map(|light| LightUniforms {
                place: light.place.map(vec3),
                falloff: match light.place {
                    Place::Local(_) => light.falloff,
                    Place::Infinite(_) => Falloff::None,
                },
                diffuse: vec3(light.diffuse) * scale,
                specular: vec3(light.specular) * scale,
                l_v: 0.0,
                half: 0.0,
            })
            .collect();
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

    /// Returns the uniforms that all lights share, without lights and tables.
    pub(crate) fn bare(&self) -> Uniforms {
        Uniforms {
            model: self.model,
            lights: Vec::new(),
            powers: None,
            materials: Vec::new(),
            eye_frame: None,
        }
    }

    /// Returns the light that `point` sees, as directional lights. The lecture lights a whole
    /// polygon so (L21 1).
    pub fn seen_from(&self, point: [f32; 3]) -> Uniforms {
        self.seen_from_in(point, Vec::new())
    }

    /// Works as [`Uniforms::seen_from`], and reuses the memory of other lights.
    pub(crate) fn seen_from_in(&self, point: [f32; 3], mut memory: Vec<LightUniforms>) -> Uniforms {
        let lit = LightAt::new(self.stored(), 0.0, true).at(vec3(point));
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

    /// Borrows the uniforms for a pixel loop.
    #[inline(always)]
    pub fn stored(&self) -> UniformsRef<'_> {
        UniformsRef {
            model: self.model,
            lights: &self.lights,
            powers: self.powers.as_ref().map_or(&[], |powers| &powers[..]),
        }
    }

    /// Computes all that follows from the places and colours of the lights: the cosines between
    /// light and eye, and the flags that choose a loop.
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

/// Returns a value clamped to 0..=`most`; NaN becomes 0. [`Num`] has only a maximum, which returns
/// the limit for NaN: negating both sides makes it a minimum.
#[inline(always)]
pub(crate) fn at_most<F: Num>(value: F, most: f32) -> F {
    -(-value.max(0.0)).max(-most)
}

/// Returns the largest magnitude of a vector's components.
pub(crate) fn magnitude(v: Vec3<f32>) -> f32 {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}

/// The limit of colours that the fast path stores without a clamp, 2³⁰: an `i32` holds them.
const MOST_LEVELS: f32 = 1_073_741_824.0;

/// Returns the strength of a light at the squared distance `square`, or `None` for full strength.
/// `unit` is 1, or the factor by which the caller has multiplied all squared distances.
#[inline(always)]
pub(crate) fn strength<F: Num>(falloff: Falloff, square: F, unit: F) -> Option<F> {
    // At the light itself 1/r² would be infinite.
    let square = square.max(LEAST_SQUARE);
    match falloff {
        Falloff::None => None,
        Falloff::Attenuation(k) => Some(unit / (unit + square * k)), // 1 / (1 + k d²)
        Falloff::InverseSquare => Some(unit / square),               // 1 / r²
        Falloff::Inverse => Some((unit / square).sqrt()),            // 1 / r
    }
}

/// Returns the vector of a direction or position.
#[inline(always)]
pub(crate) fn vector(place: Place<Vec3<f32>>) -> Vec3<f32> {
    let (Place::Infinite(v) | Place::Local(v)) = place;
    v
}

/// Returns the vector from `point` toward `place`, not normalised. `point` and the result are
/// multiplied by `weight`, as under perspective.
#[inline(always)]
pub(crate) fn toward<F: Num>(place: Place<Vec3<f32>>, point: Vec3<F>, weight: F) -> Vec3<F> {
    let to = vector(place).broadcast(weight) * weight;
    if place.is_local() { to - point } else { to }
}

/// Returns 1 / |L + V| from L·V of unit vectors, by |L + V|² = 2 + 2 L·V; 0 where light and eye are
/// opposite.
#[inline(always)]
fn over_sum<F: Num>(l_v: F) -> F {
    let square = l_v * 2.0 + 2.0;
    (square.broadcast(1.0) / square.sqrt()).gate(square, SpecularModel::LEAST_SUM)
}

/// Returns the cosine up to which no light has a highlight over 2⁻²⁴: t = (2⁻²⁴ / k)^(1/n), where k
/// is the strongest highlight at its light's greatest strength. Above t no power is subnormal. With
/// n = 0 every cosine has the power 1, so there is no such t.
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
        // Each line solves its function of t for t. Below 1 every function is tⁿ: see
        // `Exponent::new`.
        Power::Squaring | Power::Table { .. } => libm::powf(power, 1.0 / n),
        _ if n < 1.0 => libm::powf(power, 1.0 / n),
        Power::Exp => 1.0 + libm::logf(power) / n,
        Power::Lyon { k } => {
            let m = (1 << k) as f32;
            1.0 - (1.0 - libm::powf(power, 1.0 / m)) * m / n
        }
        Power::Schlick => power * n / (1.0 + power * (n - 1.0)),
    };
    // A function that exceeds the limit at 0 exceeds it everywhere, as all of them increase.
    if cosine < 0.0 {
        f32::NEG_INFINITY
    } else {
        cosine
    }
}

/// Twice the least normal `f32`, because t and its power are rounded. Only lights over 2.5 that
/// fall off by 1/r² get here; the highlights that are then left out exceed 2⁻²⁴ only at distances
/// of about 10⁻¹⁵.
const LEAST_POWER: f32 = 2.0 * f32::MIN_POSITIVE;

/// Returns the largest error of a highlight of `lighting`, as a share of `I_p k_s`, where the
/// cosines of unit vectors have an error of up to `e`. `half` is |L + V|.
///
/// *The cosine.* `R·V = 2 (L·N)(N·V) − L·V` has an error of up to 4 e. In `N·H = (L·N + V·N) / h`
/// the sum has an error of 2 e and h one of e/h, which makes `2 e/h + e/h²` together.
///
/// *The power.* An exponent n of 1 or more multiplies the error by n, and by more where the cosine
/// exceeds 1: an error x of t becomes at most (1 + x)ⁿ − 1 in tⁿ, and eⁿˣ − 1 in the other
/// functions; Schlick's function ends at 1, and a table continues in a line. An exponent below 1 is
/// concave, and infinitely steep at 0, where highlights end:
/// ```text
/// |aⁿ − bⁿ| ≤ |a − b|ⁿ   for a, b ≥ 0 and 0 < n ≤ 1, with equality at b = 0
/// ```
/// because `aⁿ ≤ bⁿ + (a − b)ⁿ` for a ≥ b. That power is computed by a logarithm, with an error of
/// `(0.7 n (|log₂ x| + 1.5) + 2) 2⁻²³` of xⁿ itself (`number/powf.rs`). It is below 8 · 2⁻²⁴, as
/// `y 2⁻ʸ` is at most 0.54. The power 0 is 1, exactly, and counts as the power 1. A highlight that
/// is weighted with L·N has the error of L·N in addition.
///
/// *The roundings of the other functions.* None of them ([`Power`]) is steeper than n. Their
/// roundings are:
/// - of 2^y with y = n log₂ e (t − 1): 2 of y, which y 2^y ln 2 < ½ multiplies, and 6 of 2^y itself
///   (`number/powf.rs`);
/// - of Lyon's function: 3 of its line, which 2ᵏ multiplies, and 2ᵏ of the squarings;
/// - of Schlick's quotient: 6;
/// - of a table: 3 of t, which n multiplies, and 4 of its entries and the line between them.
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
            // An approximate cosine may exceed 1, where powers are steeper than n. The slope from 1
            // on is the largest.
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

/// The light at a point, or at a block of points: what [`Shader`](crate::shading::Shader)'s
/// functions ask for lights, eye and colours.
///
/// A pixel method calls [`LightAt::lights`] for the vectors and [`LightAt::add`] for the terms of
/// equation 2.1; or [`LightAt::shade`], if it has a unit normal, which does both. Vertices call
/// [`LightAt::products`]. A walk and the constants of a polygon know no point: there, lights and an
/// eye at positions can be asked for only after [`LightAt::at`].
#[derive(Clone, Copy, Debug)]
pub struct LightAt<'a, F> {
    /// The uniforms that all lights share.
    pub model: LightModel,
    /// The lights, in the order of the scene.
    pub(crate) stored: &'a [LightUniforms],
    powers: &'a [f32],
    /// The point, and the unit vector from it toward the eye: see [`LightAt::at`].
    point: Vec3<F>,
    view: Vec3<F>,
    has_point: bool,
    /// True if this is the light of a walk, which knows no point; false for a vertex, a polygon or
    /// a pixel.
    is_of_walk: bool,
    attributes: [F; 4],
    /// The vertex colour at the point; white until it is known.
    albedo: Vec3<F>,
    /// True if `k_a` and `k_d` are multiplied by `albedo`.
    has_albedo: bool,
    general: bool,
    zero: F,
}

/// One light as a point sees it.
#[derive(Clone, Copy, Debug)]
pub struct SeenLight<'a, F> {
    /// The index of the light in its scene, from 0.
    pub index: usize,
    /// The unit vector L toward the light.
    pub to: Vec3<F>,
    /// L·V.
    pub l_v: F,
    /// 1 / |L + V|, where highlights are computed from N·H.
    pub half: F,
    pub(crate) strength: Option<F>,
    light: &'a LightUniforms,
}

impl<'a, F: Num> LightAt<'a, F> {
    /// Prepares the light for a walk, where no point is known: only what is at infinity can be
    /// asked for. Any value will do as `zero`. Pass a literal for `general`: `false` compiles the
    /// branch-free loop, which is valid only for models that are not general.
    #[inline(always)]
    pub(crate) fn new(stored: UniformsRef<'a>, zero: F, general: bool) -> Self {
        let UniformsRef {
            model,
            lights,
            powers,
        } = stored;
        let zero = zero.broadcast(0.0);
        LightAt {
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

    /// Returns the light as seen from `point`, a position in the world.
    #[inline(always)]
    pub fn at(self, point: Vec3<F>) -> Self {
        self.at_pixel(point, true)
    }

    /// Returns the light as seen from a pixel. Without `has_point`, `point` means nothing and the
    /// vector toward the eye is not computed.
    #[inline(always)]
    pub(crate) fn at_pixel(mut self, point: Vec3<F>, has_point: bool) -> Self {
        if has_point && self.general && self.model.eye.is_local() {
            self.view = (vector(self.model.eye).broadcast(self.zero) - point).unit();
        }
        (self.point, self.has_point, self.is_of_walk) = (point, has_point, false);
        self
    }

    /// Sets the attributes of the vertex.
    #[inline(always)]
    pub(crate) fn with_attributes(self, attributes: [F; 4]) -> Self {
        LightAt { attributes, ..self }
    }

    /// Returns the attributes of a vertex ([`Frame::attributes`](crate::frame::Frame::attributes)).
    /// Only for methods whose [`Carries::FROM`](crate::shading::Carries::FROM) is `Attributes`.
    #[inline(always)]
    pub fn attributes(&self) -> [F; 4] {
        self.attributes
    }

    /// Sets the vertex colour at the point, which multiplies `k_a` and `k_d` if the material asks
    /// for it.
    #[inline(always)]
    pub(crate) fn with_albedo(self, albedo: Vec3<F>) -> Self {
        LightAt {
            albedo,
            has_albedo: self.model.has_albedo,
            ..self
        }
    }

    /// Returns ambient or diffuse light times the vertex colour, if the material asks for it.
    #[inline(always)]
    pub(crate) fn times_albedo(&self, light: Vec3<F>) -> Vec3<F> {
        if self.general && self.has_albedo {
            vec3([
                light.x * self.albedo.x,
                light.y * self.albedo.y,
                light.z * self.albedo.z,
            ])
        } else {
            light
        }
    }

    /// Returns 0 in this arithmetic.
    #[inline(always)]
    pub fn zero(&self) -> F {
        self.zero
    }

    /// Returns how many lights there are.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.stored.len()
    }

    /// Returns the position of the point in the world. It means something only if a light or the
    /// eye is at a position.
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

    /// Iterates over the lights as the point sees them.
    #[inline(always)]
    pub fn lights(self) -> impl Iterator<Item = SeenLight<'a, F>> {
        (0..self.stored.len()).map(
            #[inline(always)]
            move |index| self.seen(index),
        )
    }

    #[inline(always)]
    pub(crate) fn seen(&self, index: usize) -> SeenLight<'a, F> {
        let (light, one) = (&self.stored[index], self.zero.broadcast(1.0));
        let is_positional = light.place.is_local();
        debug_assert!(
            !self.is_of_walk || !is_positional,
            "a walk has no point that a light at a position could be seen from"
        );
        let mut seen = SeenLight {
            index,
            to: vector(light.place).broadcast(one),
            l_v: one.broadcast(light.l_v),
            half: one.broadcast(light.half),
            strength: None,
            light,
        };
        if self.general && is_positional {
            // Until here `seen.to` is the position of the light. At the light itself the direction
            // is 0/0: the clamps turn its cosines into 0, as for a normal of length 0.
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

    /// Returns light `index` for a method that interpolates positions itself: seen along unit
    /// vectors whose L·V is `l_v`, from the squared distance `square`. Under perspective `square`
    /// may carry a factor; `unit` is then 1 times this factor.
    #[inline(always)]
    pub fn light(&self, index: usize, l_v: F, square: F, unit: F) -> SeenLight<'a, F> {
        let light = &self.stored[index];
        let strength = strength(light.falloff, square, unit);
        self.light_of_strength(index, l_v, strength)
    }

    /// Returns light `index`, seen along unit vectors whose L·V is `l_v`, with its strength; `None`
    /// is full strength.
    #[inline(always)]
    pub(crate) fn light_of_strength(
        &self,
        index: usize,
        l_v: F,
        strength: Option<F>,
    ) -> SeenLight<'a, F> {
        SeenLight {
            index,
            // Any unit vector will do: the caller has its own, and `add` reads none.
            to: self.view,
            l_v,
            // Read only where highlights are computed from N·H.
            half: if self.is_halfway() {
                over_sum(l_v)
            } else {
                l_v
            },
            strength,
            light: &self.stored[index],
        }
    }

    /// Returns the products of `n` with the vectors toward each light and toward the eye.
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

    /// Returns the unit vectors L toward a light and H half-way to the eye. Light and eye must be
    /// at infinity.
    #[inline(always)]
    pub(crate) fn light_and_half(&self, index: usize) -> [Vec3<f32>; 2] {
        let light = &self.stored[index];
        let to = vector(light.place);
        [to, (to + vector(self.model.eye)) * light.half] // h = (e + l) / |e + l|
    }

    /// Returns the products of `n` with L and with H of each light. Lights and eye must be at
    /// infinity.
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

    /// Returns `I_a k_a`, times the vertex colour if the material asks for it. Begin a colour with
    /// it.
    #[inline(always)]
    pub fn ambient(&self) -> Vec3<F> {
        self.times_albedo(self.model.ambient.broadcast(self.zero))
    }

    /// Returns a colour with each channel clamped to 0..=1: for vertices, so that their pixels need
    /// no clamp.
    #[inline(always)]
    pub fn clamped(&self, colour: Vec3<F>) -> Vec3<F> {
        let (Vec3 { x, y, z }, most) = (colour, self.model.scale);
        vec3([at_most(x, most), at_most(y, most), at_most(z, most)])
    }

    /// True if highlights are computed from N·H, false for R·V.
    #[inline(always)]
    pub fn is_halfway(&self) -> bool {
        self.general && self.model.specular == SpecularModel::Blinn
    }

    /// Returns the cosine of a highlight from L·N and V·N of a unit normal: R·V, or N·H if the
    /// scene asks for it.
    #[inline(always)]
    pub fn highlight(&self, light: &SeenLight<'a, F>, l_n: F, v_n: F) -> F {
        if self.is_halfway() {
            (l_n + v_n) * light.half // N·H
        } else {
            (v_n * 2.0).mul_add(l_n, -light.l_v) // 4.5
        }
    }

    /// Returns the cosine of [`LightAt::highlight`] from the unit normal itself, with R computed as
    /// the lecture prints it.
    #[inline(always)]
    pub fn reflection(&self, light: &SeenLight<'a, F>, n: Vec3<F>, l_n: F) -> F {
        if self.is_halfway() {
            let h = (light.to + self.view) * light.half; // h = (e + l) / |e + l|
            n.dot(h)
        } else {
            let r = n * (l_n * 2.0) - light.to; // R = 2 (L·N) N − L
            r.dot(self.view)
        }
    }

    /// Adds one light to `colour`, both terms, from L·N and the cosine of its highlight. Neither
    /// needs to be clamped.
    #[inline(always)]
    pub fn add(&self, colour: Vec3<F>, light: &SeenLight<'a, F>, l_n: F, cosine: F) -> Vec3<F> {
        let diffuse = l_n.max(0.0);
        let colour = self.add_diffuse(colour, light, diffuse);
        self.add_highlight(colour, light, diffuse, cosine)
    }

    /// Adds the diffuse term of a light to `colour`. `diffuse` is L·N, clamped at 0.
    #[inline(always)]
    pub fn add_diffuse(&self, colour: Vec3<F>, light: &SeenLight<'a, F>, diffuse: F) -> Vec3<F> {
        self.plus_diffuse(colour, light.times_strength(diffuse), light) // 2.1
    }

    /// Adds `factor` times `I_p k_d` to `colour`, with `k_d` times the vertex colour if the
    /// material asks for it.
    #[inline(always)]
    fn plus_diffuse(&self, colour: Vec3<F>, factor: F, light: &SeenLight<'a, F>) -> Vec3<F> {
        if self.general && self.has_albedo {
            colour + self.times_albedo(light.light.diffuse.broadcast(factor) * factor)
        } else {
            colour.plus(factor, light.light.diffuse)
        }
    }

    /// Adds the highlight of a light to `colour`, from L·N, clamped at 0, and the cosine of the
    /// highlight.
    #[inline(always)]
    pub fn add_highlight(
        &self,
        colour: Vec3<F>,
        light: &SeenLight<'a, F>,
        diffuse: F,
        cosine: F,
    ) -> Vec3<F> {
        match self.power(light, diffuse, cosine) {
            Some(specular) => colour.plus(specular, light.light.specular), // 2.1
            None => colour,
        }
    }

    /// Adds a light to `colour` with the factors of its two terms: for a method's own kind of
    /// highlight.
    #[inline(always)]
    pub fn plus(
        &self,
        colour: Vec3<F>,
        light: &SeenLight<'a, F>,
        diffuse: F,
        specular: F,
    ) -> Vec3<F> {
        let colour = self.plus_diffuse(colour, light.times_strength(diffuse), light);
        colour.plus(light.times_strength(specular), light.light.specular)
    }

    /// Returns the colour of a surface from the products J and K of its unit normal (L21 4.3).
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

    /// Returns the colour of [`LightAt::shade`] in two parts: ambient plus diffuse light, and
    /// highlights.
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

    /// Returns the highlight's cosine to the power n, gated and times the light's strength; `None`
    /// where no pixel has a highlight. `diffuse` is L·N, clamped at 0.
    ///
    /// Highlights are half of the work and most blocks have none, so leaving early pays. Zeros are
    /// selected instead of branched to: a block has lit and unlit lanes at once.
    #[inline(always)]
    fn power(&self, light: &SeenLight<'a, F>, diffuse: F, mut cosine: F) -> Option<F> {
        let LightModel { gate, exponent, .. } = self.model;
        let gated = !self.general || gate == SpecularGate::Gated;
        if gated {
            // `diffuse` is 0 where L·N was NaN, so a normal of length 0 has no highlight.
            cosine = cosine.gate(diffuse, 0.0);
        }
        if !cosine.any_over(self.model.faint) {
            return None;
        }
        if F::WIDTH > 1 {
            // Lanes up to `faint` become 0, as they do one pixel at a time: a pixel must not depend
            // on its block.
            cosine = cosine.gate(cosine, self.model.faint);
        }
        let mut power = match exponent {
            Exponent::Squarings(times) => squared_up_to_7(cosine, times),
            _ if !self.general && F::WIDTH > 1 => return None, // `is_fast` admits squarings only
            _ if F::WIDTH == 1 => power_by_call(exponent, cosine, self.powers),
            _ => exponent.of_or_read(cosine, self.powers),
        };
        if self.general {
            // Lanes without a highlight hold a cosine of 0 by now, which these functions do not map
            // to 0.
            if exponent.is_lit_at_zero() {
                power = power.gate(cosine, self.model.faint);
                if gated {
                    power = power.gate(diffuse, 0.0); // 0⁰ is 1, also behind the surface
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

impl<F: Num> SeenLight<'_, F> {
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
