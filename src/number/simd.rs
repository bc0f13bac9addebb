//! The SIMD backend: blocks of 8 or 16 neighbouring pixels. [`Token`] says how wide a block is on
//! each instruction set. Only a machine that has the instruction set can make its token.

use super::powf::{exp2, powf};
use super::{MulAdd, Num, Vec3, vec3};
use fearless_simd::{
    Bytes, Simd, SimdBase, SimdFloat, SimdFrom, SimdMask, f32x8, f32x16, i32x8, i32x16,
};

pub(crate) use super::BLOCK;

/// An instruction set for which kernels are compiled.
pub trait Token: Simd {
    /// The block in which a row is shaded. Its width was measured to be the fastest
    /// (`docs/performance.md`).
    type Block: Block<Self>;
    /// Returns the token.
    ///
    /// # Panics
    /// On a machine without the instruction set. Kernels are called only where their level is
    /// available.
    fn get() -> Self;
}

macro_rules! token {
    ($architecture:literal, $token:ident, $block:ident, $get:ident) => {
        #[cfg(target_arch = $architecture)]
        impl Token for fearless_simd::$token {
            type Block = $block<Self>;
            #[inline(always)]
            fn get() -> Self {
                let token = fearless_simd::Level::new().$get();
                token.expect("kernels are called on machines that have their level")
            }
        }
    };
}
token!("x86_64", Avx2, f32x16, as_avx2);
token!("x86_64", Avx512, f32x16, as_avx512);
token!("aarch64", Neon, f32x8, as_neon);

/// Runs `work` with the instructions of `simd`, on an aligned stack. Only inlined code is compiled
/// for them.
///
/// LLVM does not align the stack frame for vector registers that it spills. On a stack of 16-byte
/// alignment the spills straddle cache lines, and the same loop takes up to twice as long,
/// depending on the caller's frame. A local variable of this alignment forces LLVM to align the
/// frame. It must be borrowed as `&mut`, because a shared reference to a constant would be promoted
/// to a static.
#[inline(always)]
pub(crate) fn vectorize<S: Simd, T>(simd: S, work: impl FnOnce() -> T) -> T {
    #[repr(align(64))]
    struct Aligned(#[allow(dead_code)] u8); // only its address is used
    simd.vectorize(
        #[inline(always)]
        || {
            core::hint::black_box(&mut Aligned(0));
            work()
        },
    )
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use core::arch::x86_64::*;

    fearless_simd::kernel!(
        /// Separates x, y and z of eight vectors that lie in memory as 24 values. Component i of
        /// vector k is value 3k + i, in lane (3k + i) mod 8 of its register. Two blends collect the
        /// eight values of a component into one register, and a permutation puts them in order.
        #[inline(always)]
        pub fn deinterleave(_token: Avx2, a: __m256, b: __m256, c: __m256) -> [__m256; 3] {
            let lanes = _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
            let of = |i, p, q, r| {
                let all = _mm256_blend_ps::<0b0010_0100>(_mm256_blend_ps::<0b1001_0010>(p, q), r);
                // The permutation reads three bits of a lane index, so that 3k + i counts modulo 8.
                _mm256_permutevar8x32_ps(all, _mm256_add_epi32(lanes, _mm256_set1_epi32(i)))
            };
            [of(0, a, b, c), of(1, c, a, b), of(2, b, c, a)]
        }
    );

    fearless_simd::kernel!(
        /// Packs the levels of eight pixels as opaque RGBA8. Levels are rounded to the nearest
        /// integer, halves to the even one.
        ///
        /// Narrowing saturates, and so clamps to 0..=255. The conversion turns NaN and values
        /// outside `i32` into the least `i32`, which becomes 0.
        #[inline(always)]
        pub fn rgba8(_token: Avx2, r: __m256, g: __m256, b: __m256) -> __m256i {
            let (r, g) = (_mm256_cvtps_epi32(r), _mm256_cvtps_epi32(g));
            let b = _mm256_cvtps_epi32(b);
            // Each half of the register now holds four bytes of red, of blue, of green and of
            // alpha. The shuffle sorts them by pixel.
            let opaque = _mm256_set1_epi32(255);
            let (rb, ga) = (_mm256_packs_epi32(r, b), _mm256_packs_epi32(g, opaque));
            #[rustfmt::skip]
            let by_pixel = _mm256_setr_epi8(
                0, 8, 4, 12, 1, 9, 5, 13, 2, 10, 6, 14, 3, 11, 7, 15,
                0, 8, 4, 12, 1, 9, 5, 13, 2, 10, 6, 14, 3, 11, 7, 15,
            );
            _mm256_shuffle_epi8(_mm256_packus_epi16(rb, ga), by_pixel)
        }
    );
}

macro_rules! block {
    ($block:ident, $bits:ident, $width:literal, $powf:ident, $exp2:ident) => {
        impl<S: Simd> MulAdd for $block<S> {
            #[inline(always)]
            fn mul_add(self, factor: Self, summand: Self) -> Self {
                SimdFloat::mul_add(self, factor, summand)
            }
        }

        impl<S: Simd> Num for $block<S> {
            const WIDTH: usize = $width;
            type One = f32;

            #[inline(always)]
            fn one(self, x: f32) -> f32 {
                x
            }
            #[inline(always)]
            fn of_each(self, mut of: impl FnMut(usize) -> f32) -> Self {
                // Not `array::from_fn`: it would not be inlined.
                let mut lanes = [0.0; $width];
                for k in 0..$width {
                    lanes[k] = of(k);
                }
                Self::simd_from(self.simd, lanes)
            }

            #[inline(always)]
            fn broadcast(self, x: f32) -> Self {
                Self::splat(self.simd, x)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
            }
            #[inline(always)]
            fn powf(self, exponent: f32) -> Self {
                $powf(self, exponent)
            }
            #[inline(always)]
            fn exp2(self) -> Self {
                $exp2(self)
            }
            #[inline(always)]
            fn lookup(self, table: &[f32]) -> Self {
                let positions = self.as_slice();
                self.of_each(
                    #[inline(always)]
                    |k| Num::lookup(positions[k], table),
                )
            }
            #[inline(always)]
            fn max(self, least: f32) -> Self {
                // If one operand is NaN, x86 returns the second: `least`, which is not NaN.
                if cfg!(target_arch = "x86_64") {
                    SimdBase::max(self, least)
                } else {
                    SimdBase::max_precise(self, least)
                }
            }
            #[inline(always)]
            fn gate(self, condition: Self, least: f32) -> Self {
                // The comparison has all bits or none in a lane, so that an AND either keeps the
                // value or leaves 0.0.
                let (bits, open): ($bits<S>, _) = (Bytes::bitcast(self), condition.simd_gt(least));
                Bytes::bitcast(bits & open.to_vector())
            }
            #[inline(always)]
            fn any_over(self, least: f32) -> bool {
                self.simd_gt(least).any_true()
            }
        }
    };
}
block!(f32x8, i32x8, 8, powf, exp2);
block!(f32x16, i32x16, 16, powf_16, exp2_16);

#[inline(always)]
fn powf_16<S: Simd>(x: f32x16<S>, n: f32) -> f32x16<S> {
    let (low, high) = x.simd.split_f32x16(x);
    x.simd.combine_f32x8(powf(low, n), powf(high, n))
}

#[inline(always)]
fn exp2_16<S: Simd>(y: f32x16<S>) -> f32x16<S> {
    let (low, high) = y.simd.split_f32x16(y);
    y.simd.combine_f32x8(exp2(low), exp2(high))
}

/// Returns a function that turns the first eight vectors of a list into a block.
#[inline(always)]
pub(crate) fn deinterleaved<S: Simd>(simd: S) -> impl Fn(&[[f32; 3]]) -> Vec3<f32x8<S>> {
    #[inline(always)]
    move |all| {
        #[cfg(target_arch = "x86_64")]
        if let Some(token) = simd.level().as_avx2() {
            let all = &all.as_flattened()[..24];
            let of = |i: usize| f32x8::from_slice(simd, &all[i..i + 8]).into();
            let components = x86::deinterleave(token, of(0), of(8), of(16));
            return vec3(components.map(|x| f32x8::simd_from(simd, x)));
        }
        let of = |i| f32x8::simd_from(simd, core::array::from_fn::<_, BLOCK, _>(|k| all[k][i]));
        vec3([of(0), of(1), of(2)])
    }
}

/// The pixels that are shaded at a time: one or two 8-pixel blocks of the G-buffer.
pub trait Block<S: Simd>: Num + SimdBase<S, Element = f32> {
    /// How many 8-pixel blocks of the G-buffer it holds.
    const CELLS: usize = Self::WIDTH / BLOCK;

    /// Loads one value per pixel, from index `at` on of each 8-pixel block. A block of eight pixels
    /// reads only the first.
    fn load(simd: S, cells: [&[f32]; 2], at: usize) -> Self;
    /// Stores colours in grey levels, where 255 is full. They are clamped and rounded, opaque where
    /// `depth` is finite, and `background` elsewhere. NaN becomes 0. Magnitudes must be below 2³¹.
    fn pack(levels: [Self; 3], depth: Self, background: [u8; 4], to: &mut [[u8; 4]]);
}

impl<S: Simd> Block<S> for f32x8<S> {
    #[inline(always)]
    fn load(simd: S, [cell, _]: [&[f32]; 2], at: usize) -> Self {
        f32x8::from_slice(simd, &cell[at..at + 8])
    }
    #[inline(always)]
    fn pack(levels: [Self; 3], depth: Self, background: [u8; 4], to: &mut [[u8; 4]]) {
        let simd = depth.simd;
        let empty = i32x8::splat(simd, i32::from_le_bytes(background));
        let drawn = depth.simd_lt(f32x8::splat(simd, f32::INFINITY));
        let to = &mut to[..8].as_flattened_mut()[..32];
        #[cfg(target_arch = "x86_64")]
        if let Some(token) = simd.level().as_avx2() {
            let [r, g, b] = levels;
            let word = i32x8::simd_from(simd, x86::rgba8(token, r.into(), g.into(), b.into()));
            return Bytes::to_bytes(simd.select_i32x8(drawn, word, empty)).store_slice(to);
        }
        // Above 2²³ floats are integers: adding 2²³ rounds, and leaves the level in the lowest
        // bits, below the bits of 2²³ itself.
        let (integers, most) = (f32x8::splat(simd, 8_388_608.0), f32x8::splat(simd, 255.0));
        let bits = |level: f32x8<S>| -> i32x8<S> {
            Bytes::bitcast(SimdBase::min_precise(Num::max(level, 0.0), most) + integers)
        };
        let [r, g, b] = [bits(levels[0]), bits(levels[1]), bits(levels[2])];
        // An XOR with the bits of 2²³ removes them from red's word; shifts push them out of green's
        // and blue's. Alpha becomes 255.
        let opaque = i32x8::splat(simd, (0xFF00_0000u32 ^ 8_388_608f32.to_bits()) as i32);
        let word = (r ^ opaque) | (g << 8) | (b << 16);
        Bytes::to_bytes(simd.select_i32x8(drawn, word, empty)).store_slice(to);
    }
}

impl<S: Simd> Block<S> for f32x16<S> {
    #[inline(always)]
    fn load(simd: S, [low, high]: [&[f32]; 2], at: usize) -> Self {
        let low = f32x8::from_slice(simd, &low[at..at + 8]);
        let high = f32x8::from_slice(simd, &high[at..at + 8]);
        simd.combine_f32x8(low, high)
    }
    #[inline(always)]
    fn pack([r, g, b]: [Self; 3], depth: Self, background: [u8; 4], to: &mut [[u8; 4]]) {
        let simd = depth.simd;
        let (r, g) = (simd.split_f32x16(r), simd.split_f32x16(g));
        let (b, depth) = (simd.split_f32x16(b), simd.split_f32x16(depth));
        let (low, high) = to.split_at_mut(8);
        Block::pack([r.0, g.0, b.0], depth.0, background, low);
        Block::pack([r.1, g.1, b.1], depth.1, background, high);
    }
}

#[cfg(test)]
pub(crate) mod tests;
