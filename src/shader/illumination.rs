//! The illumination model, once for all methods (L21 2.1), with the clamps that the lecture omits.

use super::local::LEAST_SQUARE;
use crate::lighting::{Falloff, LightTerm, Lighting, Place, SpecularGate, SpecularModel};
use crate::number::{Machine, Num, Planes, Real, dot, each};

mod usual;

pub use super::power::Power;
use usual::Cosines;

/// Light and viewer as one point sees them: unit vectors, and what the model needs of them.
#[derive(Clone, Copy, Debug)]
pub struct Seen<N, const L: usize> {
    /// The unit vector `L` toward each light.
    pub light: [[N; 3]; L],
    /// The unit vector `V` toward the eye.
    pub view: [N; 3],
    /// What of them a method needs that has L·N and V·N already.
    pub scalars: SeenScalars<N, L>,
}

/// The part of [`Seen`] that is no vector.
#[derive(Clone, Copy, Debug)]
pub struct SeenScalars<N, const L: usize> {
    /// `L·V` of each light.
    pub light_view: [N; L],
    /// `1 / |L + V|` of each light, where highlights need it: see [`Illumination::needs_half`].
    pub half: [N; L],
    /// How strong each light is; `None` where none grows weaker with its distance.
    pub strength: Option<[N; L]>,
}

impl<N: Num, const L: usize> Seen<N, L> {
    /// From unit vectors, for highlights of `model`.
    #[inline(always)]
    pub(super) fn new(
        light: [[N; 3]; L],
        view: [N; 3],
        strength: Option<[N; L]>,
        model: &Illumination<N, L>,
    ) -> Self {
        let light_view: [N; L] = each(
            #[inline(always)]
            |i| dot(light[i], view),
        );
        let half = match model.needs_half() {
            true => each(
                #[inline(always)]
                |i| model.over_sum(light_view[i]),
            ),
            false => [model.one; L],
        };
        Seen {
            light,
            view,
            scalars: SeenScalars {
                light_view,
                half,
                strength,
            },
        }
    }

    /// `J = L·N` of every light.
    #[inline(always)]
    pub fn light_cosines(&self, n: [N; 3]) -> [N; L] {
        each(
            #[inline(always)]
            |i| dot(self.light[i], n), // J = L · N
        )
    }

    /// `K = V·N`.
    #[inline(always)]
    pub fn view_cosine(&self, n: [N; 3]) -> N {
        dot(self.view, n) // K = V · N
    }
}

impl<N: Num, const L: usize> Seen<N, L> {
    /// The same in the numbers of the pixel loop.
    #[inline(always)]
    pub(super) fn splat<M: Machine<One = N>>(&self, m: M) -> Seen<M::F, L>
    where
        N: Real,
    {
        let all = |v: [N; L]| {
            each(
                #[inline(always)]
                |i| m.splat(v[i]),
            )
        };
        let SeenScalars {
            light_view,
            half,
            strength,
        } = self.scalars;
        Seen {
            light: each(
                #[inline(always)]
                |i| m.splat3(self.light[i]),
            ),
            view: m.splat3(self.view),
            scalars: SeenScalars {
                light_view: all(light_view),
                half: all(half),
                strength: strength.map(all),
            },
        }
    }
}

/// Whether there are strengths is not known before the frame.
impl<N: Num, const L: usize> Planes<N> for SeenScalars<N, L> {
    const COUNT: Option<usize> = None;
}

/// As its scalars.
impl<N: Num, const L: usize> Planes<N> for Seen<N, L> {
    const COUNT: Option<usize> = None;
}

impl<N: Copy, const L: usize> SeenScalars<N, L> {
    /// The strength of light `i`; `None` is full strength.
    #[inline(always)]
    pub fn strength(&self, i: usize) -> Option<N> {
        self.strength.as_ref().map(
            #[inline(always)]
            |all| all[i],
        )
    }
}

/// The constants of the illumination model for `L` lights on one material.
///
/// ```text
/// I = I_a k_a + Σ I_p k_d max(0, L·N) + Σ I_p k_s max(0, R·V)^n  where L·N > 0       (L21 2.1, with clamps)
/// R = 2 (L·N) N − L
/// ```
///
/// Things that the lecture leaves open are settled here, for every method and for the reference:
/// - `L·N` and `R·V` are clamped at 0 *before* the power (an even power of a negative number would light the far side);
/// - there is no specular light where `L·N ≤ 0` (a light behind the surface has no highlight on it), unless the scene
///   asks for one of the other two forms of [`SpecularGate`];
/// - all lights are summed, then the sum is clamped to 0..=1 once;
/// - with [`SpecularModel::Blinn`] the cosine is `N·H`, `H = (L + V) / |L + V|` (CS171 2); where light and eye are
///   opposite, H has no direction, and there is no highlight;
/// - a light that grows weaker does so in both terms, and ambient light does not (CS171 2, Attenuation).
///
/// A normal that vanishes has no direction: its cosines are 0/0, the clamps turn them into 0, and ambient light remains.
#[derive(Clone, Copy, Debug)]
pub struct Illumination<N, const L: usize> {
    ambient: [N; 3],
    diffuse: [[N; 3]; L],
    specular: [[N; 3]; L],
    far: Seen<N, L>,
    /// No colour is 2²² or more.
    is_bounded: bool,
    power: Power,
    model: SpecularModel,
    gate: SpecularGate,
    zero: N,
    one: N,
    two: N,
    /// See [`SpecularModel::LEAST_SUM`].
    least_sum: N,
    /// See [`faint`].
    faint: N,
}

impl<N: Num, const L: usize> Illumination<N, L> {
    /// The constants for `lighting`, made by `of`. With fewer than `L` lights the others are dark. What is at a position
    /// is not seen by this part: [`super::local::Local`] knows where it is.
    #[inline(never)] // compiled once, not once a shader
    pub fn new(lighting: &Lighting, of: &dyn Fn(f32) -> N) -> Self {
        let three = |v: [f32; 3]| [of(v[0]), of(v[1]), of(v[2])];
        let light = |i: usize| lighting.lights.get(i);
        let infinite = |place: Place<[f32; 3]>| match place {
            Place::Infinite(direction) => direction,
            Place::Local(_) => [0.0, 0.0, 1.0],
        };
        let view = infinite(lighting.view);
        let direction = |i: usize| light(i).map_or(view, |l| infinite(l.place));
        // In plain numbers and from these, so that counting and wide machines get the same constants.
        let light_view = |i: usize| dot(direction(i), view);
        let half = |i: usize| match 2.0 + 2.0 * light_view(i) {
            square if square > SpecularModel::LEAST_SUM => 1.0 / libm::sqrtf(square),
            _ => 0.0,
        };
        let is_bounded = |channel: usize| {
            let lights = lighting
                .lights
                .iter()
                .map(|l| l.diffuse[channel].abs() + l.specular[channel].abs());
            lighting.ambient[channel].abs() + lights.sum::<f32>() < 4_194_304.0
        };
        Illumination {
            ambient: three(lighting.ambient),
            diffuse: each(|i| three(light(i).map_or([0.0; 3], |l| l.diffuse))),
            specular: each(|i| three(light(i).map_or([0.0; 3], |l| l.specular))),
            far: Seen {
                light: each(|i| three(direction(i))),
                view: three(view),
                scalars: SeenScalars {
                    light_view: each(|i| of(light_view(i))),
                    half: each(|i| of(half(i))),
                    strength: None,
                },
            },
            is_bounded: (0..3).all(is_bounded),
            power: Power::new(lighting.shininess),
            model: lighting.specular,
            gate: lighting.gate,
            zero: of(0.0),
            one: of(1.0),
            two: of(2.0),
            least_sum: of(SpecularModel::LEAST_SUM),
            faint: of(faint(lighting)),
        }
    }

    /// Light and viewer at infinity, as every point sees them.
    #[inline(always)]
    pub fn far(&self) -> &Seen<N, L> {
        &self.far
    }

    /// Whether highlights need `1 / |L + V|`: those of N·H do. A root and a quotient a light are not computed in vain.
    #[inline(always)]
    pub fn needs_half(&self) -> bool {
        self.model == SpecularModel::Blinn
    }

    /// The number 0.
    #[inline(always)]
    pub fn zero(&self) -> N {
        self.zero
    }

    /// The number 1.
    #[inline(always)]
    pub fn one(&self) -> N {
        self.one
    }

    /// The number 2.
    #[inline(always)]
    pub fn two(&self) -> N {
        self.two
    }

    /// `1 / |L + V|` from L·V of unit vectors; 0 where light and eye are opposite.
    #[inline(always)]
    pub fn over_sum(&self, l_v: N) -> N {
        let square = self.two + self.two * l_v; // |l + v|² = 2 + 2 l·v
        (self.one / square.sqrt()).gate(square - self.least_sum)
    }

    /// The sum over all lights, not yet clamped, from L·N of each, from R·V or N·H of each, whichever the scene asks for,
    /// and from their strengths (`None` is full strength).
    #[inline(always)]
    pub fn colour(
        &self,
        l_n: impl Fn(usize) -> N,
        r_v: impl Fn(usize) -> N,
        n_h: impl Fn(usize) -> N,
        strength: impl Fn(usize) -> Option<N>,
    ) -> [N; 3] {
        self.colour_of::<false>(l_n, r_v, n_h, strength)
    }

    /// The same, if `USUAL` with constants of [`Illumination::usual`].
    #[inline(always)]
    pub(super) fn colour_of<const USUAL: bool>(
        &self,
        l_n: impl Fn(usize) -> N,
        r_v: impl Fn(usize) -> N,
        n_h: impl Fn(usize) -> N,
        strength: impl Fn(usize) -> Option<N>,
    ) -> [N; 3] {
        if USUAL {
            return self.usual_sum(l_n, r_v);
        }
        // Each step for all lights, so that what kind of step it is is decided once a pixel.
        let diffuse_cosine: [N; L] = each(
            #[inline(always)]
            |i| l_n(i).max(self.zero),
        );
        let highlight: [N; L] = match self.model {
            SpecularModel::Phong => each(
                #[inline(always)]
                |i| r_v(i).max(self.zero),
            ),
            SpecularModel::Blinn => each(
                #[inline(always)]
                |i| n_h(i).max(self.zero),
            ),
        };
        self.sum(diffuse_cosine, highlight, strength)
    }

    /// The same from cosines between unit vectors: L·N of each light and V·N.
    #[inline(always)]
    pub fn colour_of_cosines(&self, l_n: [N; L], v_n: N, seen: &SeenScalars<N, L>) -> [N; 3] {
        self.colour_of_unit_cosines::<false>(
            #[inline(always)]
            |i| l_n[i],
            v_n,
            seen,
        )
    }

    /// The same, if `USUAL` with constants of [`Illumination::usual`].
    #[inline(always)]
    pub(super) fn colour_of_unit_cosines<const USUAL: bool>(
        &self,
        l_n: impl Fn(usize) -> N,
        v_n: N,
        seen: &SeenScalars<N, L>,
    ) -> [N; 3] {
        let (l_n, twice) = (Cosines::<N, _, L>::new::<USUAL>(l_n), self.two * v_n);
        self.colour_of::<USUAL>(
            #[inline(always)]
            |i| l_n.of(i),
            #[inline(always)]
            |i| twice.mul_sub(l_n.of(i), seen.light_view[i]), // 4.5
            #[inline(always)]
            |i| (l_n.of(i) + v_n) * seen.half[i], // N·H
            #[inline(always)]
            |i| seen.strength(i),
        )
    }

    /// The sum from the clamped cosines, without faint highlights, whose powers would be subnormal numbers: see [`faint`].
    #[inline(always)]
    fn sum(
        &self,
        diffuse_cosine: [N; L],
        highlight: [N; L],
        strength: impl Fn(usize) -> Option<N>,
    ) -> [N; 3] {
        let mut sum = self.ambient;
        let mut i = 0;
        while i < L {
            let (cosine, strength) = (diffuse_cosine[i], strength(i));
            sum = self.with_diffuse(i, sum, weakened(cosine, strength));
            if let Some(power) = self.highlight(cosine, highlight[i]) {
                sum = self.with_specular(i, sum, weakened(power, strength)); // 2.1
            }
            i += 1;
        }
        sum
    }

    /// The power of a clamped R·V or N·H where L·N, clamped, is `cosine`; `None` if it is faint at every pixel of a group.
    #[inline(always)]
    fn highlight(&self, cosine: N, highlight: N) -> Option<N> {
        let power = if self.power == Power::Integer(0) {
            // Anything to the power 0 is 1, 0 too: no highlight is faint.
            match self.gate {
                SpecularGate::Gated => self.one.gate(cosine),
                SpecularGate::Ungated | SpecularGate::Weighted => self.one,
            }
        } else {
            let highlight = match self.gate {
                SpecularGate::Gated => highlight.gate(cosine),
                SpecularGate::Ungated | SpecularGate::Weighted => highlight,
            };
            if !highlight.is_over(self.faint) {
                return None;
            }
            self.power.of(self.gated(highlight), self.one)
        };
        Some(match self.gate {
            SpecularGate::Weighted => power * cosine,
            SpecularGate::Gated | SpecularGate::Ungated => power,
        })
    }

    /// `highlight` where it is not faint, else 0: a pixel does not depend on what lies beside it in its group.
    #[inline(always)]
    fn gated(&self, highlight: N) -> N {
        highlight.gate(highlight - self.faint)
    }

    /// `sum` and the diffuse light of light `i`, whose cosine is `d`. Numbers one by one, not an array that a loop writes to: that
    /// would stay in memory.
    #[inline(always)]
    fn with_diffuse(&self, i: usize, [red, green, blue]: [N; 3], d: N) -> [N; 3] {
        let [r, g, b] = self.diffuse[i];
        match i {
            // Not `mul_add`: both constants lie in memory, of which one operand at a time is read.
            0 => [red + r * d, green + g * d, blue + b * d],
            _ => [r.mul_add(d, red), g.mul_add(d, green), b.mul_add(d, blue)],
        }
    }

    /// `sum` and the specular light of light `i`, whose cosine to the power is `s`.
    #[inline(always)]
    fn with_specular(&self, i: usize, [red, green, blue]: [N; 3], s: N) -> [N; 3] {
        let [r, g, b] = self.specular[i];
        [r.mul_add(s, red), g.mul_add(s, green), b.mul_add(s, blue)]
    }

    /// The colour of a surface with unit normal `n` that sees light and viewer as `seen`, with R built as the lecture
    /// prints it; not yet clamped.
    #[inline(always)]
    pub fn lit(&self, n: [N; 3], seen: &Seen<N, L>) -> [N; 3] {
        self.lit_of::<false>(n, seen)
    }

    /// The same, if `USUAL` with constants of [`Illumination::usual`].
    #[inline(always)]
    pub(super) fn lit_of<const USUAL: bool>(&self, n: [N; 3], seen: &Seen<N, L>) -> [N; 3] {
        let cosines = Cosines::<N, _, L>::new::<USUAL>(
            #[inline(always)]
            |i| dot(seen.light[i], n),
        );
        self.colour_of::<USUAL>(
            #[inline(always)]
            |i| cosines.of(i),
            #[inline(always)]
            |i| {
                let l = seen.light[i];
                let twice = self.two * cosines.of(i);
                let r = [
                    twice * n[0] - l[0],
                    twice * n[1] - l[1],
                    twice * n[2] - l[2],
                ]; // R = 2 (L·N) N − L
                dot(r, seen.view)
            },
            #[inline(always)]
            |i| {
                let (l, v, half) = (seen.light[i], seen.view, seen.scalars.half[i]);
                let h = [
                    (l[0] + v[0]) * half,
                    (l[1] + v[1]) * half,
                    (l[2] + v[2]) * half,
                ]; // h = (e + l) / |e + l|
                dot(n, h)
            },
            #[inline(always)]
            |i| seen.scalars.strength(i),
        )
    }

    /// A sum clamped to 0..=1: the last step of the model.
    #[inline(always)]
    pub fn clamped(&self, sum: [N; 3]) -> [N; 3] {
        each(
            #[inline(always)]
            |i| sum[i].max(self.zero).min(self.one),
        )
    }
}

/// `term` times the strength of its light; `None` is full strength.
#[inline(always)]
fn weakened<N: Num>(term: N, strength: Option<N>) -> N {
    match strength {
        Some(strength) => term * strength,
        None => term,
    }
}

/// 2⁻²⁴: half a unit in the last place of a colour of ½ or more.
const FAINT: f32 = 5.960_464_5e-8;

/// The R·V or N·H up to which a highlight is faint, and left out: `t = (2⁻²⁴ / k)^(1/n)`.
///
/// Here k is the strongest `I_p k_s` of any light in any channel, times the greatest strength of that light; the highlight
/// `k t^n` is 2⁻²⁴, which no rounding to grey levels shows. Higher powers of smaller cosines are soon subnormal numbers, and
/// each operation on them takes 150 to 200 cycles instead of four.
fn faint(lighting: &Lighting) -> f32 {
    let strongest = lighting
        .lights
        .iter()
        .flat_map(|light| light.specular.map(|c| c.abs() * greatest_strength(light)))
        .fold(0.0, f32::max);
    libm::powf(FAINT / strongest.max(FAINT), 1.0 / lighting.shininess)
}

/// The greatest strength that a light can have at any distance.
fn greatest_strength(light: &LightTerm) -> f32 {
    match light.falloff {
        Falloff::InverseSquare if light.place.is_local() => 1.0 / LEAST_SQUARE,
        Falloff::Inverse if light.place.is_local() => libm::sqrtf(1.0 / LEAST_SQUARE),
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests;
