//! The cell of a pixel in the G-buffer: the order of its values. The row engine writes cells and
//! kernels read them, both through [`CellLayout`].

#![cfg_attr(not(feature = "simd"), allow(dead_code))] // without it there is no row engine

use crate::number::BLOCK;
use crate::shading::UniformsIndex;

/// The layout of a pixel's values:
///
/// ```text
/// depth | varyings | extras | uniforms
/// ```
///
/// A block of [`BLOCK`] pixels stores their depths first, then as many of each other value in turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct CellLayout {
    /// How many values the method has per pixel: its varyings, or what its walk returned.
    pub varyings: usize,
    /// How many values the engine adds: those of [`Extras`](super::Extras).
    pub extras: usize,
    /// True if each pixel stores the index of its uniforms, which is its last value.
    pub has_uniforms: bool,
}

impl CellLayout {
    /// The index of depth.
    pub const DEPTH: usize = 0;

    /// Returns how many values a pixel has.
    #[inline(always)]
    pub const fn count(self) -> usize {
        self.uniforms() + self.has_uniforms as usize
    }

    /// Returns how many values a block of pixels has, which is the distance from one block to the
    /// next.
    #[inline(always)]
    pub const fn stride(self) -> usize {
        self.count() * BLOCK
    }

    /// Returns the index of varying `i`. Extras follow as if they were further varyings.
    #[inline(always)]
    pub const fn varying(i: usize) -> usize {
        CellLayout::DEPTH + 1 + i
    }

    /// Returns the index of extra `i`.
    #[inline(always)]
    pub const fn extra(self, i: usize) -> usize {
        CellLayout::varying(self.varyings + i)
    }

    /// Returns the index of the uniforms' index; without [`CellLayout::has_uniforms`] the end of
    /// the cell.
    #[inline(always)]
    pub const fn uniforms(self) -> usize {
        self.extra(self.extras)
    }

    /// Writes the values of a pixel, or of a triangle's corner, in order: depth, `varyings` with
    /// extras, and the index of the uniforms. `uniforms` is called only if the index is stored.
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

    /// Converts an index of uniforms to the value that cells store. Exact, as `Variant::plan` gives
    /// the row engine fewer than 2²⁴ polygons.
    #[inline(always)]
    pub fn of_uniforms(uniforms: UniformsIndex) -> f32 {
        uniforms.0 as f32
    }

    /// Converts the value of a cell back to an index of uniforms.
    #[inline(always)]
    pub fn uniforms_of(value: f32) -> UniformsIndex {
        UniformsIndex(value as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// All indices of a cell are different and fill it, and a pixel is written to them.
    #[test]
    fn each_value_has_an_index() {
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
            let mut indices = Vec::from([CellLayout::DEPTH]);
            indices.extend((0..varyings).map(CellLayout::varying));
            indices.extend((0..extras).map(|i| cell.extra(i)));
            indices.extend(has_uniforms.then(|| cell.uniforms()));
            let all: Vec<usize> = (0..cell.count()).collect();
            assert_eq!(indices, all, "{cell:?}");
            assert_eq!(cell.stride(), BLOCK * indices.len());
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
