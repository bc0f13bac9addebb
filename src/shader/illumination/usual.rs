//! What most scenes ask of the illumination model, written out for loops that are compiled apart for it.

use super::Illumination;
use crate::lighting::{Lighting, SpecularGate, SpecularModel};
use crate::number::{Num, each};
use crate::shader::power::squared_up_to_7;

impl<N: Num, const L: usize> Illumination<N, L> {
    /// The same for `scale` times the colours, to be summed without faint highlights, where it is what most scenes ask for: R·V, no
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

    /// The sum from the clamped cosines, of constants that are usual, and without highlights that are faint at all pixels of a group: most
    /// of a surface has none, and highlights are half of the work.
    #[inline(always)]
    pub(super) fn usual_sum(&self, diffuse_cosine: [N; L], highlight: [N; L]) -> [N; 3] {
        let (d, h) = (&diffuse_cosine, &highlight);
        let mut sum = self.ambient;
        // Written out: a loop with decisions in it is not unrolled, and what it goes through stays in memory.
        if L > 0 {
            sum = self.with_light(0, sum, d[0], h[0]);
        }
        if L > 1 {
            sum = self.with_light(1, sum, d[1], h[1]);
        }
        if L > 2 {
            sum = self.with_light(2, sum, d[2], h[2]);
        }
        if L > 3 {
            sum = self.with_light(3, sum, d[3], h[3]);
        }
        let mut i = 4;
        while i < L {
            sum = self.with_light(i, sum, d[i], h[i]);
            i += 1;
        }
        sum
    }

    /// `sum` and what light `i` adds, from L·N and R·V, each 0 or more.
    #[inline(always)]
    fn with_light(&self, i: usize, sum: [N; 3], d: N, highlight: N) -> [N; 3] {
        let sum = self.with_diffuse(i, sum, d);
        let highlight = highlight.gate(d);
        if !highlight.is_over(self.faint) {
            return sum;
        }
        // Faint ones are none here too, so that no pixel depends on what lies beside it.
        let [s] = squared_up_to_7([highlight], self.power.squarings().unwrap_or(0));
        let s = s.gate(highlight - self.faint);
        self.with_specular(i, sum, s) // 2.1
    }
}

/// The R·V up to which `k_s (R·V)^n` is below 2⁻²⁴ for every light: what rounding a colour of ½ or more changes.
pub(super) fn faint(lighting: &Lighting) -> f32 {
    let strongest = lighting.lights.iter().flat_map(|l| l.specular).fold(0.0, |most, c| f32::max(most, c.abs()));
    libm::powf(5.960_464_5e-8 / strongest.max(5.960_464_5e-8), 1.0 / lighting.shininess)
}

/// A colour times `scale`.
#[inline(always)]
fn scaled<N: Num>([r, g, b]: [N; 3], scale: N) -> [N; 3] {
    [r * scale, g * scale, b * scale]
}

#[cfg(test)]
mod tests;
