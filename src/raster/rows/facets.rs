//! What is interpolated over the triangles of a batch.

use super::band::MOST_PLANES;
use super::batch::MOST;
use crate::number::{Lanes, Num};

/// Numbers that a corner has room for: depth and those of its attribute, in whole groups.
pub(super) const LINE: usize = (1 + MOST_PLANES).next_multiple_of(8);

/// Numbers over each triangle: at its first corner, and how far the other two are from it.
///
/// ```text
/// A = A_a + β (A_b − A_a) + γ (A_c − A_a)
/// ```
/// β and γ come from exact integers and are in 0..=1 inside, so that nothing cancels, however thin the triangle is.
///
/// Depth first, then the numbers of the attribute where it is what pixels are given. Those of a corner lie together, as they are
/// read and as a pixel needs them; in whole groups, whose last numbers mean nothing.
#[derive(Debug)]
#[repr(align(32))]
pub(super) struct Facets(pub [[[f32; LINE]; 3]; MOST]);

impl Default for Facets {
    fn default() -> Self {
        Facets([[[0.0; LINE]; 3]; MOST])
    }
}

impl Facets {
    /// Number `number` over triangle `k`: at its first corner, and how far the other two are from it.
    #[inline(always)]
    pub fn number(&self, number: usize, k: usize) -> [f32; 3] {
        let [at, b, c] = &self.0[k];
        [at[number], b[number], c[number]]
    }

    /// The first `count` numbers of triangle `k` where its second and third corner have the coordinates `weights`.
    #[inline(always)]
    pub fn at<M: Lanes>(&self, m: M, k: usize, count: usize, weights: [f32; 2]) -> [f32; LINE] {
        let ([at, to_b, to_c], [b, c]) = (&self.0[k], [m.splat(weights[0]), m.splat(weights[1])]);
        let mut numbers = [0.0; LINE];
        let mut i = 0;
        while i < count {
            let value = m.load(&to_b[i..]).mul_add(b, m.load(&at[i..]));
            m.store(m.load(&to_c[i..]).mul_add(c, value), &mut numbers[i..]);
            i += M::WIDTH;
        }
        numbers
    }

    /// How much the first `count` numbers of triangle `k` grow where the coordinates of its second and third corner grow by `weights`.
    #[inline(always)]
    pub fn growth<M: Lanes>(&self, m: M, k: usize, count: usize, weights: [f32; 2]) -> [f32; LINE] {
        let ([_, to_b, to_c], [b, c]) = (&self.0[k], [m.splat(weights[0]), m.splat(weights[1])]);
        let mut growth = [0.0; LINE];
        let mut i = 0;
        while i < count {
            m.store(
                m.load(&to_c[i..]).mul_add(c, m.load(&to_b[i..]) * b),
                &mut growth[i..],
            );
            i += M::WIDTH;
        }
        growth
    }
}

/// A number over one triangle: see [`Facets`].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Facet {
    at: f32,
    /// How far the second and the third corner are from it.
    pub to: [f32; 2],
}

impl Facet {
    /// That of number `number` over triangle `k`.
    #[inline(always)]
    pub fn of(facets: &Facets, number: usize, k: usize) -> Facet {
        let [at, to @ ..] = facets.number(number, k);
        Facet { at, to }
    }

    /// At a group of pixels with these coordinates.
    #[inline(always)]
    pub fn lanes<M: Lanes>(&self, m: M, [b, c]: [M::F; 2]) -> M::F {
        m.splat(self.to[1])
            .mul_add(c, m.splat(self.to[0]).mul_add(b, m.splat(self.at)))
    }

    /// At one pixel.
    #[inline(always)]
    pub fn one(&self, [b, c]: [f32; 2]) -> f32 {
        self.at + b * self.to[0] + c * self.to[1]
    }
}
