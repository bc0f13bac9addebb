//! The eight SIMD lanes of the row engine: floats, integers and masks for eight pixels or eight
//! triangles.

use super::simd::BLOCK;
use fearless_simd::{
    Bytes, Simd, SimdBase, SimdCvtTruncate, SimdFloat, SimdFrom, SimdMask, f32x8, i8x32, i32x8,
};

/// The instruction set of the row engine. Its functions make and combine vectors of eight lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes<S>(pub S);

/// Operations on eight integers. The caller makes sure that every result fits into 32 bits.
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
    /// Returns 0, 1, 2, … 7, the index of each lane.
    #[inline(always)]
    pub fn counted(self) -> i32x8<S> {
        i32x8::simd_from(self.0, [0, 1, 2, 3, 4, 5, 6, 7])
    }
    /// Returns `at + (first + k) · step` in lane k, rounded once: the fused multiply-add does not
    /// round the product. `first + k` must be exact in an `f32`, so below 2²⁴.
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
    /// Converts integers to floats, rounding once.
    #[inline(always)]
    pub fn float(self, x: i32x8<S>) -> f32x8<S> {
        self.0.cvt_f32_i32x8(x)
    }
    /// Converts floats to integers, rounding toward 0. Magnitudes must be below 2³¹.
    #[inline(always)]
    pub fn truncated(self, x: f32x8<S>) -> i32x8<S> {
        SimdCvtTruncate::truncate_from(x)
    }
    /// True if any lane is 0 or more.
    #[inline(always)]
    pub fn any_not_negative(self, x: i32x8<S>) -> bool {
        self.bits_not_negative(x) != 0
    }
    /// Returns a bit per lane: 1 where the lane is 0 or more.
    #[inline(always)]
    pub fn bits_not_negative(self, x: i32x8<S>) -> u32 {
        x.simd_gt(self.int(-1)).to_bitmask() as u32
    }
    /// Returns `new` where `a < b`, else 0.
    #[inline(always)]
    pub fn where_less(self, a: f32x8<S>, b: f32x8<S>, new: f32x8<S>) -> f32x8<S> {
        // The comparison has all bits or none in a lane, so that an AND either keeps `new` or
        // leaves 0.0.
        let bits: i32x8<S> = Bytes::bitcast(new);
        Bytes::bitcast(bits & a.simd_lt(b).to_vector())
    }

    /// Returns all bits in lanes that fail the depth test, and no bits in the others. A lane fails
    /// if `outside` is negative (the sample lies outside an edge) or if `new` is not below `old`.
    /// Neither depth may be NaN.
    #[inline(always)]
    pub fn depth_mask(self, outside: i32x8<S>, new: f32x8<S>, old: f32x8<S>) -> i32x8<S> {
        // The sign of `outside` already says "outside", and a comparison has all bits set. The
        // arithmetic shift spreads the sign over the lane.
        (outside | new.simd_ge(old).to_vector()) >> 31
    }

    /// Returns `old` where `mask` has all bits, and `new` where it has none.
    ///
    /// The selection works on bytes. The compiler turns a selection of 32-bit lanes that goes from
    /// memory to memory into a masked store, which takes four times as long (Zen 3). With `old` as
    /// the first operand, the value in memory also needs no separate load.
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
