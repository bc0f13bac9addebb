//! Lights and a viewer at positions: what a point sees of them.

use super::illumination::{Illumination, Seen};
use crate::lighting::{Falloff, Lighting, Place};
use crate::number::{Machine, Num, Planes, dot, each};
use core::fmt;

/// Squared distances below this count as this: a light in the surface itself has no direction and no finite `1/r²`.
pub const LEAST_SQUARE: f32 = 1e-30;

/// Where the light and the viewer of one material are, for methods that light whole polygons or vertices.
///
/// One text serves light at infinity and light at positions: a method is written over this trait, and [`Far`] makes the
/// question where a point lies vanish.
pub trait Lights: Copy + fmt::Debug + 'static {
    /// The constants for `L` lights.
    type Of<N: Num, const L: usize>: Copy + Send + Sync;
    /// What holds over one polygon, or at one vertex.
    type There<N: Num, const L: usize>: Planes<N> + Send + Sync;

    /// The constants for `lighting`, made by `of`.
    fn new<N: Num, const L: usize>(lighting: &Lighting, of: &dyn Fn(f32) -> N) -> Self::Of<N, L>;
    /// The illumination model.
    fn model<N: Num, const L: usize>(c: &Self::Of<N, L>) -> &Illumination<N, L>;
    /// What holds at `position`.
    fn there<N: Num, const L: usize>(
        c: &Self::Of<N, L>,
        position: impl FnOnce() -> [N; 3],
    ) -> Self::There<N, L>;
    /// Light and viewer as they are seen there.
    fn seen<'a, N: Num, const L: usize>(
        c: &'a Self::Of<N, L>,
        there: &'a Self::There<N, L>,
    ) -> &'a Seen<N, L>;
    /// What holds there, in the numbers of the pixel loop.
    fn splat<M: Machine, const L: usize>(
        m: M,
        there: &Self::There<M::One, L>,
    ) -> Self::There<M::F, L>;
}

/// All at infinity, as the lecture assumes (L21 1).
#[derive(Clone, Copy, Debug)]
pub struct Far;

impl Lights for Far {
    type Of<N: Num, const L: usize> = Illumination<N, L>;
    type There<N: Num, const L: usize> = ();

    fn new<N: Num, const L: usize>(
        lighting: &Lighting,
        of: &dyn Fn(f32) -> N,
    ) -> Illumination<N, L> {
        Illumination::new(lighting, of)
    }
    #[inline(always)]
    fn model<N: Num, const L: usize>(c: &Illumination<N, L>) -> &Illumination<N, L> {
        c
    }
    #[inline(always)]
    fn there<N: Num, const L: usize>(_: &Illumination<N, L>, _: impl FnOnce() -> [N; 3]) {}
    #[inline(always)]
    fn seen<'a, N: Num, const L: usize>(c: &'a Illumination<N, L>, (): &'a ()) -> &'a Seen<N, L> {
        c.far()
    }
    #[inline(always)]
    fn splat<M: Machine, const L: usize>(_: M, (): &()) {}
}

/// Some at positions.
#[derive(Clone, Copy, Debug)]
pub struct Near;

impl Lights for Near {
    type Of<N: Num, const L: usize> = Local<N, L>;
    type There<N: Num, const L: usize> = Seen<N, L>;

    fn new<N: Num, const L: usize>(lighting: &Lighting, of: &dyn Fn(f32) -> N) -> Local<N, L> {
        Local::new(lighting, of)
    }
    #[inline(always)]
    fn model<N: Num, const L: usize>(c: &Local<N, L>) -> &Illumination<N, L> {
        &c.model
    }
    #[inline(always)]
    fn there<N: Num, const L: usize>(
        c: &Local<N, L>,
        position: impl FnOnce() -> [N; 3],
    ) -> Seen<N, L> {
        c.seen_from(position())
    }
    #[inline(always)]
    fn seen<'a, N: Num, const L: usize>(
        _: &'a Local<N, L>,
        there: &'a Seen<N, L>,
    ) -> &'a Seen<N, L> {
        there
    }
    #[inline(always)]
    fn splat<M: Machine, const L: usize>(m: M, there: &Seen<M::One, L>) -> Seen<M::F, L> {
        there.splat(m)
    }
}

/// The illumination model, and where light and viewer are.
#[derive(Clone, Copy, Debug)]
pub struct Local<N, const L: usize> {
    /// The illumination model.
    pub model: Illumination<N, L>,
    lights: [Place<[N; 3]>; L],
    falloffs: [Falloff; L],
    /// The k of each light's attenuation.
    k: [N; L],
    view: Place<[N; 3]>,
    is_attenuated: bool,
    least: N,
}

impl<N: Num, const L: usize> Local<N, L> {
    /// The constants for `lighting`, made by `of`. With fewer than `L` lights the others are dark.
    #[inline(never)] // compiled once, not once a shader
    pub fn new(lighting: &Lighting, of: &dyn Fn(f32) -> N) -> Self {
        let three = |v: [f32; 3]| [of(v[0]), of(v[1]), of(v[2])];
        let light = |i: usize| lighting.lights.get(i);
        let falloff = |i: usize| {
            light(i)
                .filter(|l| l.place.is_local())
                .map_or(Falloff::None, |l| l.falloff)
        };
        Local {
            model: Illumination::new(lighting, of),
            lights: each(|i| {
                light(i)
                    .map_or(Place::Infinite([0.0, 0.0, 1.0]), |l| l.place)
                    .map(three)
            }),
            falloffs: each(falloff),
            k: each(|i| {
                of(if let Falloff::Attenuation(k) = falloff(i) {
                    k
                } else {
                    0.0
                })
            }),
            view: lighting.view.map(three),
            is_attenuated: lighting.is_attenuated(),
            least: of(LEAST_SQUARE),
        }
    }

    /// Whether a light grows weaker with its distance.
    #[inline(always)]
    pub fn is_attenuated(&self) -> bool {
        self.is_attenuated
    }

    /// The vector from `position` toward light `i`, not normalised. Where positions are divided by w, `inv_w` is 1/w and
    /// the vector is divided by w too.
    #[inline(always)]
    pub fn toward_light(&self, i: usize, position: [N; 3], inv_w: Option<N>) -> [N; 3] {
        toward(self.lights[i], position, inv_w)
    }

    /// The vector from `position` toward the eye, likewise.
    #[inline(always)]
    pub fn toward_eye(&self, position: [N; 3], inv_w: Option<N>) -> [N; 3] {
        toward(self.view, position, inv_w)
    }

    /// How the vector toward light `i` grows where the position grows by `step` and 1/w by `inv_w_step`.
    #[inline(always)]
    pub fn light_step(&self, i: usize, step: [N; 3], inv_w_step: Option<N>) -> [N; 3] {
        toward_step(self.lights[i], step, inv_w_step, self.model.zero())
    }

    /// How the vector toward the eye grows, likewise.
    #[inline(always)]
    pub fn eye_step(&self, step: [N; 3], inv_w_step: Option<N>) -> [N; 3] {
        toward_step(self.view, step, inv_w_step, self.model.zero())
    }

    /// How strong light `i` is at the squared distance `square`; `None` is full strength. Where distances are divided by
    /// w, `inv_w_square` is 1/w².
    ///
    /// ```text
    /// 1 / (1 + k d²)      (CS171 2, Attenuation)        = (1/w²) / (1/w² + k (d/w)²)
    /// ```
    #[inline(always)]
    pub fn strength(&self, i: usize, square: N, inv_w_square: Option<N>) -> Option<N> {
        let square = square.max(self.least);
        let unit = inv_w_square.unwrap_or(self.model.one());
        match self.falloffs[i] {
            Falloff::None => None,
            Falloff::Attenuation(_) => Some(unit / (unit + self.k[i] * square)), // 1 / (1 + k d²)
            Falloff::InverseSquare => Some(unit / square),                       // 1 / r²
            Falloff::Inverse => Some((unit / square).sqrt()),                    // 1 / r
        }
    }

    /// Light and viewer as the point at `position` sees them.
    #[inline(always)]
    pub fn seen_from(&self, position: [N; 3]) -> Seen<N, L> {
        let one = self.model.one();
        let mut light = [position; L];
        let mut strength = [one; L];
        let mut i = 0;
        while i < L {
            let l = self.toward_light(i, position, None);
            let square = dot(l, l);
            light[i] = unit(l, one / square.sqrt());
            strength[i] = self.strength(i, square, None).unwrap_or(one);
            i += 1;
        }
        let v = self.toward_eye(position, None);
        let view = unit(v, one / dot(v, v).sqrt());
        Seen::new(
            light,
            view,
            self.is_attenuated.then_some(strength),
            &self.model,
        )
    }
}

#[inline(always)]
fn unit<N: Num>(v: [N; 3], over_length: N) -> [N; 3] {
    [v[0] * over_length, v[1] * over_length, v[2] * over_length]
}

#[inline(always)]
fn toward<N: Num>(place: Place<[N; 3]>, from: [N; 3], inv_w: Option<N>) -> [N; 3] {
    match (place, inv_w) {
        (Place::Local(p), None) => [p[0] - from[0], p[1] - from[1], p[2] - from[2]],
        (Place::Local(p), Some(w)) => [p[0] * w - from[0], p[1] * w - from[1], p[2] * w - from[2]],
        (Place::Infinite(d), None) => d,
        (Place::Infinite(d), Some(w)) => [d[0] * w, d[1] * w, d[2] * w],
    }
}

#[inline(always)]
fn toward_step<N: Num>(
    place: Place<[N; 3]>,
    step: [N; 3],
    inv_w_step: Option<N>,
    zero: N,
) -> [N; 3] {
    match (place, inv_w_step) {
        (Place::Local(_), None) => [-step[0], -step[1], -step[2]],
        (Place::Infinite(_), None) => [zero; 3],
        (_, Some(w)) => toward(place, step, Some(w)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lighting::{Light, Material, SpecularGate, SpecularModel};
    use glam::DVec3;

    /// The light behind a point, on the line from the eye or nearly so: L·V is rounded to −1, and 1 / |L + V| to infinity.
    #[test]
    fn opposite_light_and_eye_have_no_highlight() {
        let material = Material {
            ambient: [0.25; 3],
            diffuse: [0.0; 3],
            specular: [1.0; 3],
            shininess: 8.0,
        };
        let light = Light::positional(DVec3::new(0.0, 0.0, -5.0), [1.0; 3]);
        let lighting = Lighting {
            view: Place::Local([0.0; 3]),
            specular: SpecularModel::Blinn,
            gate: SpecularGate::Ungated,
            ..Lighting::new(&material, [1.0; 3], &[light], DVec3::Z)
        };
        let local = Local::<f32, 1>::new(&lighting, &|x| x);
        for i in 0..1000 {
            // At (x, 0.3 x, −2) the light is seen under x/3 from the axis and the eye under x/2: |L + V| is below
            // 1.05 · 5/6 x, and that below 2⁻¹⁰.
            let x = i as f32 * 1e-6;
            let seen = local.seen_from([x, 0.3 * x, -2.0]);
            let n = [-0.6, 0.0, 0.8]; // on the side of L + V
            assert_eq!(local.model.lit(n, &seen), [0.25; 3], "{x}");
            let cosines = local.model.colour_of_cosines(
                seen.light_cosines(n),
                seen.view_cosine(n),
                &seen.scalars,
            );
            assert_eq!(cosines, [0.25; 3], "{x}");
        }
    }
}
