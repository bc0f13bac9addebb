//! Eight pixels at a time, on the instruction set that a token proves to be there.

use super::{Int, Lanes, Level, Machine, Num};
use fearless_simd::{Simd, SimdBase, SimdFloat, SimdFrom, SimdMask, f32x8, i32x8, mask32x8};

/// The machine of groups of eight neighbouring pixels; its set-up runs on plain `f32`.
#[derive(Clone, Copy, Debug)]
pub struct Wide<S>(pub S);

/// Whether this machine has the instructions of `level`.
pub(super) fn is_available(level: Level) -> bool {
    let here = fearless_simd::Level::new();
    match level {
        Level::Scalar => true,
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => here.as_avx2().is_some(),
        #[cfg(target_arch = "aarch64")]
        Level::Neon => here.as_neon().is_some(),
        #[allow(unreachable_patterns)] // which ones are left depends on the platform
        _ => {
            let _ = here;
            false
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use core::arch::x86_64::{
        __m256, __m256i, _mm256_blendv_epi8, _mm256_cvtps_epi32, _mm256_packs_epi32,
        _mm256_packus_epi16, _mm256_rsqrt_ps, _mm256_set1_epi32, _mm256_setr_epi8,
        _mm256_shuffle_epi8,
    };

    fearless_simd::kernel!(
        /// 1/√x to 12 bits.
        #[inline(always)]
        pub fn over_sqrt(avx2: Avx2, x: __m256) -> __m256 {
            let _ = avx2;
            _mm256_rsqrt_ps(x)
        }
    );

    fearless_simd::kernel!(
        /// `new` where `mask` has all bits, `old` where it has none.
        #[inline(always)]
        pub fn choose(avx2: Avx2, mask: __m256i, new: __m256i, old: __m256i) -> __m256i {
            let _ = avx2;
            _mm256_blendv_epi8(old, new, mask)
        }
    );

    fearless_simd::kernel!(
        /// The levels of eight pixels as opaque texels: rounded to the nearest whole one, half-way to the even one, as `quantise` does.
        ///
        /// Narrowing saturates, which is the clamp to 0..=255. What no whole number of 32 bits holds is converted to the least
        /// of them, and NaN too: both become 0.
        #[inline(always)]
        pub fn texels(avx2: Avx2, r: __m256, g: __m256, b: __m256) -> __m256i {
            let _ = avx2;
            let (r, g, b) = (
                _mm256_cvtps_epi32(r),
                _mm256_cvtps_epi32(g),
                _mm256_cvtps_epi32(b),
            );
            // Of each half of the pixels four bytes of red, then of blue, of green, and of alpha: now by pixel.
            let (rb, ga) = (
                _mm256_packs_epi32(r, b),
                _mm256_packs_epi32(g, _mm256_set1_epi32(255)),
            );
            #[rustfmt::skip]
            let by_pixel = _mm256_setr_epi8(
                0, 8, 4, 12, 1, 9, 5, 13, 2, 10, 6, 14, 3, 11, 7, 15,
                0, 8, 4, 12, 1, 9, 5, 13, 2, 10, 6, 14, 3, 11, 7, 15,
            );
            _mm256_shuffle_epi8(_mm256_packus_epi16(rb, ga), by_pixel)
        }
    );
}

impl<S: Simd> Num for f32x8<S> {
    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }

    /// ```text
    /// y = y_0 (3 − x y_0²) / 2        Newton's method for y = 1/√x
    /// ```
    /// The estimate y_0 is off by at most e = 1.5 · 2⁻¹² (Intel's and AMD's manuals), which leaves 1.5 e² = 3.4 · 2⁻²⁴. The
    /// product in the subtrahend, ½, the difference, 1, and the last product add at most 3 · 2⁻²⁴: below 2⁻²¹ in all.
    #[inline(always)]
    fn over_sqrt(self) -> Self {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = self.simd.level().as_avx2() {
            let y = Self::simd_from(self.simd, avx2::over_sqrt(avx2, self.into()));
            let (half, three_halves) = (Self::splat(self.simd, 0.5), Self::splat(self.simd, 1.5));
            return y * Num::mul_add(-(half * self * y), y, three_halves);
        }
        Self::splat(self.simd, 1.0) / SimdFloat::sqrt(self)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, summand: Self) -> Self {
        SimdFloat::mul_add(self, factor, summand)
    }

    #[inline(always)]
    fn mul_sub(self, factor: Self, subtrahend: Self) -> Self {
        SimdFloat::mul_sub(self, factor, subtrahend)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // x86 gives the second operand where one is NaN: what is asked for, wherever `other` is a number.
        match cfg!(target_arch = "x86_64") {
            true => SimdBase::max(self, other),
            false => SimdBase::max_precise(self, other),
        }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        match cfg!(target_arch = "x86_64") {
            true => SimdBase::min(self, other),
            false => SimdBase::min_precise(self, other),
        }
    }

    #[inline(always)]
    fn gate(self, condition: Self) -> Self {
        let simd = self.simd;
        let open = condition.simd_gt(Self::splat(simd, 0.0));
        from_bits(bits(self) & simd.to_vector_mask32x8(open))
    }

    #[inline(always)]
    fn is_over(self, least: Self) -> bool {
        self.simd_gt(least).any_true()
    }

    #[inline(always)]
    fn powf(self, exponent: f32) -> Self {
        super::power::powf(self, exponent)
    }
}

impl<S: Simd> Int for i32x8<S> {
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        SimdBase::min(self, other)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        SimdBase::max(self, other)
    }

    #[inline(always)]
    fn whole_pixels(self) -> Self {
        self >> 8
    }

    #[inline(always)]
    fn less(self, other: Self) -> Self {
        self.simd_lt(other).to_vector()
    }
}

/// The bits of eight numbers.
#[inline(always)]
fn bits<S: Simd>(x: f32x8<S>) -> i32x8<S> {
    fearless_simd::Bytes::bitcast(x)
}

#[inline(always)]
fn from_bits<S: Simd>(x: i32x8<S>) -> f32x8<S> {
    fearless_simd::Bytes::bitcast(x)
}

const COUNTED: [f32; 8] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];
const COUNTED_INTEGERS: [i32; 8] = [0, 1, 2, 3, 4, 5, 6, 7];

impl<S: Simd> Machine for Wide<S> {
    type One = f32;
    type F = f32x8<S>;
    const WIDTH: usize = 8;

    #[inline(always)]
    fn one(self, x: f32) -> f32 {
        x
    }

    #[inline(always)]
    fn splat(self, x: f32) -> f32x8<S> {
        f32x8::splat(self.0, x)
    }

    #[inline(always)]
    fn ramp(self, at: f32, step: f32) -> f32x8<S> {
        let k = f32x8::simd_from(self.0, COUNTED);
        SimdFloat::mul_add(k, self.splat(step), self.splat(at))
    }

    #[inline(always)]
    fn stride(self, step: f32) -> f32x8<S> {
        self.splat(8.0 * step)
    }

    #[inline(always)]
    fn take(self, mut next: impl FnMut() -> f32) -> f32x8<S> {
        let mut lanes = [0.0; 8];
        for lane in &mut lanes {
            *lane = next();
        }
        f32x8::simd_from(self.0, lanes)
    }

    #[inline(always)]
    fn first(self, x: f32x8<S>) -> f32 {
        x.as_slice()[0]
    }
}

impl<S: Simd> Lanes for Wide<S> {
    type Mask = mask32x8<S>;
    type I = i32x8<S>;
    const IS_ONE_REGISTER: bool = size_of::<S::f32s>() >= 32;

    #[inline(always)]
    fn vectorize<T>(self, work: impl FnOnce() -> T) -> T {
        self.0.vectorize(work)
    }

    #[inline(always)]
    fn load(self, from: &[f32]) -> f32x8<S> {
        f32x8::from_slice(self.0, &from[..8])
    }

    #[inline(always)]
    fn store(self, x: f32x8<S>, to: &mut [f32]) {
        x.store_slice(&mut to[..8]);
    }

    #[inline(always)]
    fn lanes(self, from: usize, to: usize) -> mask32x8<S> {
        let k = i32x8::simd_from(self.0, COUNTED_INTEGERS);
        k.simd_ge(i32x8::splat(self.0, from.min(8) as i32))
            & k.simd_lt(i32x8::splat(self.0, to.min(8) as i32))
    }

    #[inline(always)]
    fn less(self, a: f32x8<S>, b: f32x8<S>) -> mask32x8<S> {
        a.simd_lt(b)
    }

    #[inline(always)]
    fn any(self, mask: mask32x8<S>) -> bool {
        mask.any_true()
    }

    /// By exclusive or: a select between what was loaded and what is stored becomes a masked store, which takes four times
    /// as long (Zen 3).
    #[inline(always)]
    fn blend(self, mask: mask32x8<S>, new: f32x8<S>, old: f32x8<S>) -> f32x8<S> {
        let (new, old) = (bits(new), bits(old));
        from_bits(old ^ ((old ^ new) & mask.to_vector()))
    }

    #[inline(always)]
    fn kept(self, outside: i32x8<S>, new: f32x8<S>, old: f32x8<S>) -> i32x8<S> {
        (outside | new.simd_ge(old).to_vector()) >> 31
    }

    /// Byte by byte: a choice of whole numbers, from memory and back to it, becomes a masked store, which takes four times as
    /// long (Zen 3). In this order what was in memory need not be loaded first.
    #[inline(always)]
    fn keep(self, kept: i32x8<S>, old: f32x8<S>, new: f32x8<S>) -> f32x8<S> {
        let (old, new) = (bits(old), bits(new));
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = self.0.level().as_avx2() {
            return from_bits(i32x8::simd_from(
                self.0,
                avx2::choose(avx2, kept.into(), old.into(), new.into()),
            ));
        }
        from_bits(new ^ ((new ^ old) & kept))
    }

    #[inline(always)]
    fn bits(self, mask: mask32x8<S>) -> u32 {
        mask.to_bitmask() as u32
    }

    #[inline(always)]
    fn int(self, x: i32) -> i32x8<S> {
        i32x8::splat(self.0, x)
    }

    #[inline(always)]
    fn counted(self) -> i32x8<S> {
        i32x8::simd_from(self.0, COUNTED_INTEGERS)
    }

    #[inline(always)]
    fn load_int(self, from: &[i32]) -> i32x8<S> {
        i32x8::from_slice(self.0, &from[..8])
    }

    #[inline(always)]
    fn store_int(self, x: i32x8<S>, to: &mut [i32]) {
        x.store_slice(&mut to[..8]);
    }

    #[inline(always)]
    fn number(self, x: i32x8<S>) -> f32x8<S> {
        self.0.cvt_f32_i32x8(x)
    }

    #[inline(always)]
    fn truncated(self, x: f32x8<S>) -> i32x8<S> {
        fearless_simd::SimdCvtTruncate::truncate_from(x)
    }

    #[inline(always)]
    fn not_negative(self, x: i32x8<S>) -> mask32x8<S> {
        x.simd_gt(i32x8::splat(self.0, -1))
    }

    #[inline(always)]
    fn pack(
        self,
        rgb: [f32x8<S>; 3],
        covered: mask32x8<S>,
        background: [u8; 4],
        to: &mut [[u8; 4]],
    ) {
        let most = self.splat(255.0);
        let levels = super::each(
            #[inline(always)]
            |i| {
                let level = rgb[i] * most;
                // x86 gives the second operand where one is NaN, which becomes 0.
                match cfg!(target_arch = "x86_64") {
                    true => SimdBase::min(most, level),
                    false => Num::min(Num::max(level, self.splat(0.0)), most),
                }
            },
        );
        self.pack_levels(levels, covered, background, to);
    }

    #[inline(always)]
    fn pack_levels(
        self,
        levels: [f32x8<S>; 3],
        covered: mask32x8<S>,
        background: [u8; 4],
        to: &mut [[u8; 4]],
    ) {
        let empty = i32x8::splat(self.0, i32::from_le_bytes(background));
        let to = &mut to[..8].as_flattened_mut()[..32];
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = self.0.level().as_avx2() {
            let [r, g, b] = levels;
            let word = avx2::texels(avx2, r.into(), g.into(), b.into());
            let word = avx2::choose(avx2, covered.to_vector().into(), word, empty.into());
            fearless_simd::Bytes::to_bytes(i32x8::simd_from(self.0, word)).store_slice(to);
            return;
        }
        let (zero, most) = (self.splat(0.0), self.splat(255.0));
        // As `quantise`: adding 2²³ rounds, and the level stands in the lowest bits, below the bits of 2²³ itself.
        let integers = self.splat(8_388_608.0);
        let [r, g, b] = super::each(
            #[inline(always)]
            |i| bits(Num::min(Num::max(levels[i], zero), most) + integers),
        );
        let opaque = i32x8::splat(self.0, (0xFF00_0000u32 ^ 8_388_608f32.to_bits()) as i32);
        let word = (r ^ opaque) | (g << 8) | (b << 16);
        let word = empty ^ ((empty ^ word) & covered.to_vector());
        fearless_simd::Bytes::to_bytes(word).store_slice(to);
    }
}

#[cfg(test)]
mod tests;
#[cfg(test)]
mod texel_tests;
