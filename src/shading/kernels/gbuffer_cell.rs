//! The cell of a pixel in the G-buffer: which of its values is depth, a varying, an extra, or the index of its uniforms. The row
//! engine writes cells and kernels read them, both by [`CellLayout`].

#![cfg_attr(not(feature = "simd"), allow(dead_code))] // without it there is no row engine

use crate::number::BLOCK;
use crate::shading::UniformsIndex;

/// The layout of a pixel's values:
///
/// ```text
/// depth | varyings | extras | uniforms
/// ```
///
/// A block of pixels holds [`BLOCK`] depths, then as many of each other value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct CellLayout {
    /// The method's varyings, or the values of the pixels that its walk returns.
    pub varyings: usize,
    /// The varyings that the engine adds: [`Extras`](super::Extras).
    pub extras: usize,
    /// True if pixels have uniforms of their own, whose index stands last.
    pub has_uniforms: bool,
}

impl CellLayout {
    /// The place of depth.
    pub const DEPTH: usize = 0;

    /// Returns how many values a pixel has.
    #[inline(always)]
    pub const fn count(self) -> usize {
        self.uniforms() + self.has_uniforms as usize
    }

    /// Returns how many values a block of pixels has: the distance from one block to the next.
    #[inline(always)]
    pub const fn stride(self) -> usize {
        self.count() * BLOCK
    }

    /// Returns the place of varying `i`. Extras follow the varyings as if they were such.
    #[inline(always)]
    pub const fn varying(i: usize) -> usize {
        CellLayout::DEPTH + 1 + i
    }

    /// Returns the place of extra `i`.
    #[inline(always)]
    pub const fn extra(self, i: usize) -> usize {
        CellLayout::varying(self.varyings + i)
    }

    /// Returns the place of the index of the uniforms; without [`CellLayout::has_uniforms`] the end of the cell.
    #[inline(always)]
    pub const fn uniforms(self) -> usize {
        self.extra(self.extras)
    }

    /// Writes the values of a pixel, or of a triangle's corner, one after the other: depth, `varyings` with extras, and the index
    /// of the uniforms, which is only asked for if it is kept.
    #[inline(always)]
    pub fn write(
        self,
        to: &mut [f32],
        depth: f32,
        varyings: &[f32],
        uniforms: impl FnOnce() -> UniformsIndex,
    ) {
        to[CellLayout::DEPTH] = depth;
        for (to, varying) in to[CellLayout::varying(0)..].iter_mut().zip(varyings) {
            *to = *varying;
        }
        if self.has_uniforms {
            to[self.uniforms()] = CellLayout::of_uniforms(uniforms());
        }
    }

    /// Returns the index of some uniforms as cells hold it. Exact: `Variant::plan` gives the row engine fewer than 2²⁴ polygons.
    #[inline(always)]
    pub fn of_uniforms(uniforms: UniformsIndex) -> f32 {
        uniforms.0 as f32
    }

    /// Returns the index of some uniforms from the value that a cell holds.
    #[inline(always)]
    pub fn uniforms_of(value: f32) -> UniformsIndex {
        UniformsIndex(value as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// All places of a cell are different, and together are the whole cell; a pixel is written to them.
    #[test]
    fn each_number_has_a_place() {
        for (varyings, extras, has_uniforms) in [
            (3, 0, false),
            (3, 0, true),
            (5, 4, true),
            (0, 0, true),
            (3, 1, false),
        ] {
            let cell = CellLayout {
                varyings,
                extras,
                has_uniforms,
            };
            let mut places = Vec::from([CellLayout::DEPTH]);
            places.extend((0..varyings).map(CellLayout::varying));
            places.extend((0..extras).map(|i| cell.extra(i)));
            places.extend(has_uniforms.then(|| cell.uniforms()));
            let all: Vec<usize> = (0..cell.count()).collect();
            assert_eq!(places, all, "{cell:?}");
            assert_eq!(cell.stride(), BLOCK * places.len());
            let carried: Vec<f32> = (0..varyings + extras).map(|i| i as f32).collect();
            let mut values = alloc::vec![-1.0; cell.count()];
            cell.write(&mut values, 0.5, &carried, || UniformsIndex(1 << 23));
            assert_eq!(values[CellLayout::DEPTH], 0.5);
            assert_eq!(values[1..][..carried.len()], carried);
            if has_uniforms {
                let value = values[cell.uniforms()];
                assert_eq!(CellLayout::uniforms_of(value), UniformsIndex(1 << 23));
            }
        }
    }
}
