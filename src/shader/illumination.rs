//! The illumination model, once for all methods (L21 2.1), with the clamps that the lecture omits.

use crate::lighting::Lighting;
use crate::number::{Num, dot, each};

/// The exponent `n` of the specular term, as it is best computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Power {
    /// A whole number: by repeated squaring, at most 2 log₂ n multiplications.
    Integer(u32),
    /// Any other: by the library's power function.
    Fractional(f32),
}

impl Power {
    /// The power for a shininess of 0 or more.
    pub fn new(shininess: f32) -> Self {
        let whole = shininess as u32;
        if whole as f32 == shininess { Power::Integer(whole) } else { Power::Fractional(shininess) }
    }

    /// `base` to this power; `base` is 0 or more, and anything to the power 0 is 1. The one power function of all
    /// methods, so that none is faster by a cheaper one.
    #[inline(always)]
    pub fn of<F: Num>(self, base: F, one: F) -> F {
        let mut n = match self {
            Power::Integer(0) => return one,
            Power::Integer(n) => n,
            Power::Fractional(n) => return base.powf(n),
        };
        let mut square = base;
        while n & 1 == 0 {
            square = square * square;
            n >>= 1;
        }
        let mut power = square;
        n >>= 1;
        while n != 0 {
            square = square * square;
            if n & 1 == 1 {
                power = power * square;
            }
            n >>= 1;
        }
        power
    }
}

/// The constants of the illumination model for `L` lights on one material.
///
/// ```text
/// I = I_a k_a + Σ I_p k_d max(0, L·N) + Σ I_p k_s max(0, R·V)^n  where L·N > 0       (L21 2.1, with clamps)
/// R = 2 (L·N) N − L
/// ```
///
/// Three things that the lecture leaves open are settled here, for every method and for the reference:
/// - `L·N` and `R·V` are clamped at 0 *before* the power (an even power of a negative number would light the far side);
/// - there is no specular light where `L·N ≤ 0` (a light behind the surface has no highlight on it);
/// - all lights are summed, then the sum is clamped to 0..=1 once.
///
/// A normal that vanishes has no direction: its cosines are 0/0, the clamps turn them into 0, and ambient light remains.
#[derive(Clone, Copy, Debug)]
pub struct Illumination<N, const L: usize> {
    ambient: [N; 3],
    diffuse: [[N; 3]; L],
    specular: [[N; 3]; L],
    light: [[N; 3]; L],
    view: [N; 3],
    light_view: [N; L],
    power: Power,
    zero: N,
    one: N,
    two: N,
}

impl<N: Num, const L: usize> Illumination<N, L> {
    /// The constants for `lighting`, made by `of`. With fewer than `L` lights the others are dark.
    pub fn new(lighting: &Lighting, of: impl Fn(f32) -> N) -> Self {
        let three = |v: [f32; 3]| [of(v[0]), of(v[1]), of(v[2])];
        let light = |i: usize| lighting.lights.get(i);
        let direction = |i: usize| light(i).map_or(lighting.view, |l| l.direction);
        Illumination {
            ambient: three(lighting.ambient),
            diffuse: each(|i| three(light(i).map_or([0.0; 3], |l| l.diffuse))),
            specular: each(|i| three(light(i).map_or([0.0; 3], |l| l.specular))),
            light: each(|i| three(direction(i))),
            view: three(lighting.view),
            light_view: each(|i| of(dot(direction(i), lighting.view))),
            power: Power::new(lighting.shininess),
            zero: of(0.0),
            one: of(1.0),
            two: of(2.0),
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

    /// `L·V` of light `i`, constant over the scene.
    #[inline(always)]
    pub fn light_view(&self, i: usize) -> N {
        self.light_view[i]
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

    /// The sum over all lights, not yet clamped, from (L·N, R·V) of each.
    #[inline(always)]
    pub fn colour(&self, cosines: impl Fn(usize) -> (N, N)) -> [N; 3] {
        let mut sum = self.ambient;
        let mut i = 0;
        while i < L {
            let (l_n, r_v) = cosines(i);
            let d = l_n.max(self.zero);
            let s = self.power.of(r_v.max(self.zero), self.one).gate(l_n);
            let mut channel = 0;
            while channel < 3 {
                sum[channel] = sum[channel] + self.diffuse[i][channel] * d + self.specular[i][channel] * s; // 2.1
                channel += 1;
            }
            i += 1;
        }
        sum
    }

    /// The colour of a surface with unit normal `n`, with R built as the lecture prints it; not yet clamped.
    #[inline(always)]
    pub fn lit(&self, n: [N; 3]) -> [N; 3] {
        self.colour(
            #[inline(always)]
            |i| {
                let l = self.light[i];
                let l_n = dot(l, n);
                let twice = self.two * l_n;
                let r = [twice * n[0] - l[0], twice * n[1] - l[1], twice * n[2] - l[2]]; // R = 2 (L·N) N − L
                (l_n, dot(r, self.view))
            },
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
