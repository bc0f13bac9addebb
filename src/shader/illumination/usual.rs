//! What most scenes ask of the illumination model, as functions of its own for loops that are compiled apart for it.

use super::Illumination;
use crate::lighting::{SpecularGate, SpecularModel};
use crate::number::{Num, each};
use crate::shader::power::squared_up_to_7;

impl<N: Num, const L: usize> Illumination<N, L> {
    /// The same for `scale` times the colours, where it is what most scenes ask for: R·V, no
    /// specular light where `L·N ≤ 0`, lights of full strength, a shininess that is a power of two up to 128, and colours below 2²².
    #[inline(always)]
    pub fn usual(&self, scale: N) -> Option<Self> {
        let is_usual = self.power.squarings().is_some()
            && self.model == SpecularModel::Phong
            && self.gate == SpecularGate::Gated
            && self.far.scalars.strength.is_none()
            && self.is_bounded;
        is_usual.then_some(Illumination {
            ambient: scaled(self.ambient, scale),
            diffuse: each(
                #[inline(always)]
                |i| scaled(self.diffuse[i], scale),
            ),
            specular: each(
                #[inline(always)]
                |i| scaled(self.specular[i], scale),
            ),
            ..*self
        })
    }

    /// The sum from L·N and R·V of each light, of constants that are usual, and without highlights that are faint at all pixels of a
    /// group: most of a surface has none, and highlights are half of the work.
    ///
    /// Light by light, each cosine when it is needed: with those of four lights at once registers run out.
    #[inline(always)]
    pub(super) fn usual_sum(&self, l_n: impl Fn(usize) -> N, r_v: impl Fn(usize) -> N) -> [N; 3] {
        let mut sum = self.ambient;
        // Written out: a loop with decisions in it is not unrolled, and what it goes through stays in memory.
        if L > 0 {
            sum = self.with_light(0, sum, l_n(0), r_v(0));
        }
        if L > 1 {
            sum = self.with_light(1, sum, l_n(1), r_v(1));
        }
        if L > 2 {
            sum = self.with_light(2, sum, l_n(2), r_v(2));
        }
        if L > 3 {
            sum = self.with_light(3, sum, l_n(3), r_v(3));
        }
        let mut i = 4;
        while i < L {
            sum = self.with_light(i, sum, l_n(i), r_v(i));
            i += 1;
        }
        sum
    }

    /// `sum` and what light `i` adds, from its L·N and R·V.
    #[inline(always)]
    fn with_light(&self, i: usize, sum: [N; 3], l_n: N, r_v: N) -> [N; 3] {
        let (d, highlight) = (l_n.max(self.zero), r_v.max(self.zero));
        let sum = self.with_diffuse(i, sum, d);
        let highlight = highlight.gate(d);
        if !highlight.is_over(self.faint) {
            return sum;
        }
        let squarings = self.power.squarings().unwrap_or(0);
        let [s] = squared_up_to_7([self.gated(highlight)], squarings);
        self.with_specular(i, sum, s) // 2.1
    }
}

/// The cosine with each light: found once for all of them where steps are made for all lights at once, and with `USUAL` constants when it
/// is needed, which the compiler does once too.
pub(super) struct Cosines<N, C, const L: usize> {
    all: Option<[N; L]>,
    of: C,
}

impl<N: Copy, C: Fn(usize) -> N, const L: usize> Cosines<N, C, L> {
    #[inline(always)]
    pub fn new<const USUAL: bool>(of: C) -> Self {
        if USUAL {
            return Cosines { all: None, of };
        }
        #[allow(clippy::redundant_closure)] // what is called by `&of` is not inlined everywhere
        let all = each(
            #[inline(always)]
            |i| of(i),
        );
        Cosines { all: Some(all), of }
    }

    /// That with light `i`.
    #[inline(always)]
    pub fn of(&self, i: usize) -> N {
        match &self.all {
            Some(all) => all[i],
            None => (self.of)(i),
        }
    }
}

/// A colour times `scale`.
#[inline(always)]
fn scaled<N: Num>([r, g, b]: [N; 3], scale: N) -> [N; 3] {
    [r * scale, g * scale, b * scale]
}

#[cfg(test)]
mod tests;
