//! Eight lanes of the row engine: floats, integers and masks of eight pixels, or of eight triangles.

use super::simd::BLOCK;
use fearless_simd::{
    Bytes, Simd, SimdBase, SimdCvtTruncate, SimdFloat, SimdFrom, SimdMask, f32x8, i8x32, i32x8,
};

/// The instruction set of the row engine, as the maker of its lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes<S>(pub S);

/// Operations of the row engine on eight integers, of which no result may need more than 32 bits.
pub(crate) trait Int: Sized {
    /// Returns −1 (all bits) where `self < other`, else 0.
    fn less(self, other: Self) -> Self;
}

impl<S: Simd> Int for i32x8<S> {
    #[inline(always)]
    fn less(self, other: Self) -> Self {
        self.simd_lt(other).to_vector()
    }
}

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub fn splat(self, x: f32) -> f32x8<S> {
        f32x8::splat(self.0, x)
    }
    #[inline(always)]
    pub fn int(self, x: i32) -> i32x8<S> {
        i32x8::splat(self.0, x)
    }
    /// Returns 0, 1, 2, … 7.
    #[inline(always)]
    pub fn counted(self) -> i32x8<S> {
        i32x8::simd_from(self.0, [0, 1, 2, 3, 4, 5, 6, 7])
    }
    /// Returns `at + (first + k) · step` in lane k, rounded once. The factor is exact while it has 24 bits.
    #[inline(always)]
    pub fn ramp(self, at: f32, first: i32, step: f32) -> f32x8<S> {
        let k = self.float(self.counted() + self.int(first));
        SimdFloat::mul_add(k, self.splat(step), self.splat(at))
    }
    #[inline(always)]
    pub fn load(self, from: &[f32]) -> f32x8<S> {
        f32x8::from_slice(self.0, &from[..BLOCK])
    }
    #[inline(always)]
    pub fn store(self, x: f32x8<S>, to: &mut [f32]) {
        x.store_slice(&mut to[..BLOCK]);
    }
    #[inline(always)]
    pub fn load_int(self, from: &[i32]) -> i32x8<S> {
        i32x8::from_slice(self.0, &from[..BLOCK])
    }
    #[inline(always)]
    pub fn store_int(self, x: i32x8<S>, to: &mut [i32]) {
        x.store_slice(&mut to[..BLOCK]);
    }
    /// Converts integers, rounding once.
    #[inline(always)]
    pub fn float(self, x: i32x8<S>) -> f32x8<S> {
        self.0.cvt_f32_i32x8(x)
    }
    /// Converts floats of magnitudes below 2³¹, toward 0.
    #[inline(always)]
    pub fn truncated(self, x: f32x8<S>) -> i32x8<S> {
        SimdCvtTruncate::truncate_from(x)
    }
    /// True if any lane is 0 or more.
    #[inline(always)]
    pub fn any_not_negative(self, x: i32x8<S>) -> bool {
        self.bits_not_negative(x) != 0
    }
    /// Returns a bit for each lane: 1 where it is 0 or more.
    #[inline(always)]
    pub fn bits_not_negative(self, x: i32x8<S>) -> u32 {
        x.simd_gt(self.int(-1)).to_bitmask() as u32
    }
    /// Returns `new` where `a < b`, else 0.
    #[inline(always)]
    pub fn where_less(self, a: f32x8<S>, b: f32x8<S>, new: f32x8<S>) -> f32x8<S> {
        let bits: i32x8<S> = Bytes::bitcast(new);
        Bytes::bitcast(bits & a.simd_lt(b).to_vector())
    }

    /// Returns all bits for the pixels that fail the depth test: where `outside` is below 0 or `new` is not less than `old`, both
    /// of which are numbers; no bits for the others.
    #[inline(always)]
    pub fn depth_mask(self, outside: i32x8<S>, new: f32x8<S>, old: f32x8<S>) -> i32x8<S> {
        (outside | new.simd_ge(old).to_vector()) >> 31
    }

    /// Returns `old` where `mask` has all bits, `new` where it has none.
    ///
    /// Byte by byte: a select of 32-bit values, from memory and back to it, becomes a masked store, which takes four times as
    /// long (Zen 3). In this order what was in memory need not be loaded first.
    #[inline(always)]
    pub fn select(self, mask: i32x8<S>, old: f32x8<S>, new: f32x8<S>) -> f32x8<S> {
        let mask: i8x32<S> = Bytes::bitcast(mask);
        let is_old = mask.simd_lt(i8x32::splat(self.0, 0));
        Bytes::bitcast(
            self.0
                .select_i8x32(is_old, Bytes::bitcast(old), Bytes::bitcast(new)),
        )
    }
}
