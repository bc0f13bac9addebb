//! Powers in SIMD lanes: xⁿ = 2^(n log₂ x), for exponents that are not whole numbers. Whole
//! exponents are in `Exponent` in `shading/light/powers.rs`.

use fearless_simd::{Simd, SimdBase, SimdFloat, f32x8, i32x8};

/// Returns `x` to the power `n`, for `x` of 0 or more. 0 to a positive power is 0, and anything to
/// the power 0 is 1.
///
/// ```text
/// x = 2^e m,  m in [√½, √2):   log₂ x = e + (2/ln 2) artanh s,   s = (m − 1)/(m + 1)
/// 2^y = 2^⌊y⌉ 2^f,  f in −½..½
/// ```
/// artanh s = s + s³/3 + s⁵/5 + s⁷/7 + s⁹/9. With |s| ≤ 0.1716 the next term is below 4·10⁻¹⁰.
/// Count errors in units of 2⁻²⁴: s is off by 2 |s|, the series by 2, the products and their
/// constant by one each. Together this is six times log₂ m, which is at most ½. The sum with e and
/// the product with n round |log₂ x| once more each, and 2^y multiplies the total by ln 2. f and
/// the polynomial add 4. So the power is off by the factor
/// ```text
/// 1 ± (0.7 n (|log₂ x| + 3 min(|log₂ x|, ½)) + 2) 2⁻²³
/// ```
/// Where it matters, which is xⁿ above 2⁻⁹, n |log₂ x| is below 9, and the factor is 1 ± 3.3·10⁻⁶.
/// A positive `x` below the normal numbers counts as the smallest of them. 2^f is its Taylor
/// polynomial of degree 7, whose next term is below 6·10⁻⁹.
#[inline(always)]
pub(super) fn powf<S: Simd>(x: f32x8<S>, n: f32) -> f32x8<S> {
    let simd = x.simd;
    let of = |c: f32| f32x8::splat(simd, c);
    let whole = |c: i32| i32x8::splat(simd, c);
    let bits = |x: f32x8<S>| -> i32x8<S> { fearless_simd::Bytes::bitcast(x) };
    let float = |x: i32x8<S>| -> f32x8<S> { fearless_simd::Bytes::bitcast(x) };
    // Subtracting the bits of √½ before the shift makes e the exponent that leaves m in [√½, √2).
    // The shift is arithmetic, so that e is negative below √½.
    let least = core::f32::consts::FRAC_1_SQRT_2.to_bits() as i32;
    let above = bits(x) - whole(least);
    let e = above >> 23;
    // The 23 bits that are left, counted from √½, are m itself.
    let m = float((above & whole(0x007F_FFFF)) + whole(least));
    let s = (m - 1.0) / (m + 1.0);
    let z = s * s;
    let mut series = of(1.0 / 9.0);
    for odd in [7.0, 5.0, 3.0, 1.0] {
        series = SimdFloat::mul_add(series, z, of(1.0 / odd));
    }
    let exponent: f32x8<S> = fearless_simd::SimdCvtFloat::float_from(e);
    let log = SimdFloat::mul_add(s * series, of(2.0 * core::f32::consts::LOG2_E), exponent);
    let scaled = exp2(log * n);
    // The bits of 0 do not yield log₂ 0 = −∞: select the result for 0 instead.
    let positive = x.simd_gt(of(0.0));
    let at_zero = if n == 0.0 { 1.0 } else { 0.0 };
    simd.select_f32x8(positive, scaled, of(at_zero))
}

/// Returns 2^y by the second line of [`powf`], with y clamped to −126..=127.
#[inline(always)]
pub(super) fn exp2<S: Simd>(y: f32x8<S>) -> f32x8<S> {
    let of = |c: f32| f32x8::splat(y.simd, c);
    // Below 2⁻¹²⁶ there are no normal floats. A smaller power is far below a grey level, so −126
    // will do.
    let y = y.max(of(-126.0)).min(of(127.0));
    let nearest = y.round_ties_even();
    let f = (y - nearest) * core::f32::consts::LN_2;
    let mut power = of(1.0 / 5040.0);
    for factorial in [720.0, 120.0, 24.0, 6.0, 2.0, 1.0, 1.0] {
        power = SimdFloat::mul_add(power, f, of(1.0 / factorial));
    }
    let shift: i32x8<S> = fearless_simd::SimdCvtTruncate::truncate_from(nearest);
    // ⌊y⌉ + 127 in the exponent's bits is the float 2^⌊y⌉.
    let scale: f32x8<S> = fearless_simd::Bytes::bitcast((shift + i32x8::splat(y.simd, 127)) << 23);
    power * scale
}
