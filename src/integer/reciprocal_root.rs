//! 1/√D from a table of 4 KB, and a step of Newton's method that needs no division.

/// How far D may exceed 1, in Q30: 2⁻¹¹. Up to 90° second differences drift by less.
const ABOVE_ONE: i32 = 1 << 19;

/// 1/√D in Q15, in 2,048 steps from D = 1 + 2⁻¹¹ down to 2⁻¹¹. Below D = ¼ it is 2.
///
/// Within a step D is off by at most 2⁻¹², so 1/√D is off by 2⁻¹³ D^(−3/2): 2⁻¹³ at D = 1, and 2⁻¹⁰
/// at D = ¼.
static ROOTS: [u16; 2048] = {
    let mut table = [0; 2048];
    let mut i = 0;
    while i < 2048 {
        // D = 1 + 2⁻¹¹ − (i + ½)/2048 = (4097 − 2i)/4096, in the middle of the step.
        // 1/D in Q30, so its root is in Q15.
        let square = (1 << 42) / (4097 - 2 * i as u64);
        let root = square.isqrt();
        table[i] = if root < 65535 { root as u16 } else { 65535 };
        i += 1;
    }
    table
};

/// Returns 1 + 2⁻¹¹ − D with 32 fractional bits, from D in Q30. Methods step it in place of D,
/// because its upper 11 bits are the index into the table. Near D = 0, where normals have no
/// direction, it wraps.
#[inline(always)]
pub(super) const fn below_one(d: i32) -> u32 {
    ((1u32 << 30) + ABOVE_ONE as u32).wrapping_sub(d as u32) << 2
}

/// Returns 1/√D in Q15, from [`below_one`] of D. Its upper 11 bits cannot exceed the table.
#[inline(always)]
const fn root(below_one: u32) -> i32 {
    ROOTS[(below_one >> 21) as usize] as i32
}

/// Returns 1/√D in Q15 by the table, for D in Q30.
#[inline(always)]
pub(super) const fn root_of(d: i32) -> i32 {
    root(below_one(d))
}

/// Returns r + r (1 − D r²)/2, one step of Newton's method from the table's r toward 1/√D. All are
/// in Q15.
///
/// r is below 2 and D r² at most 1 + 2⁻⁷, so both products are below 2³¹. From D = ¼ on the result
/// is right to 2⁻¹⁴. For shorter normals it lies between the table's root and the true one.
#[inline(always)]
pub(super) const fn newton(r: i32, d: i32) -> i32 {
    // r² is below 2³² only as an unsigned number.
    let square = (r as u32).wrapping_mul(r as u32) >> 15;
    let error = (1 << 30) - d * square as i32;
    r + ((r * (error >> 16) + (1 << 14)) >> 15)
}

/// Returns 1/√D in Q15 by the table and a step of Newton's method, for D in Q30.
#[inline(always)]
pub(super) const fn refined_root(d: i32) -> i32 {
    newton(root_of(d), ((d >> 14) + 1) >> 1)
}

/// Returns 1/√D in Q15 by the table, and with `REFINED` a step of Newton's method, from
/// [`below_one`] of D.
#[inline(always)]
pub(super) fn root_below<const REFINED: bool>(below_one: u32) -> i32 {
    let r = root(below_one);
    if REFINED {
        // D in Q15, rounded: undo `below_one`.
        let d = ((1 << 15) + (ABOVE_ONE >> 15)) - (((below_one >> 16) as i32 + 1) >> 1);
        newton(r, d)
    } else {
        r
    }
}

/// Returns a product that fits 32 bits.
///
/// All products of a [`Span`](super::Span) or a [`Canvas`](super::Canvas) fit, and in this crate's
/// own tests a larger one panics. Elsewhere it would wrap, so that firmware with overflow checks
/// neither pays for one here nor can panic.
#[inline(always)]
pub(super) const fn product(a: i32, b: i32) -> i32 {
    if cfg!(test) { a * b } else { a.wrapping_mul(b) }
}

/// Returns J/√D in Q31, from J in Q30 and r = 1/√D in Q15.
///
/// J is the product of N and a vector of length 255/256, so |J| ≤ √D 255/256. r is off by at most
/// 2⁻⁹ of itself. So the product is below 2³¹.
#[inline(always)]
pub(super) fn unit_j(j: i32, r: i32) -> i32 {
    product(j >> 14, r)
}

/// Returns K/√D in Q15, from K in Q30 and r = 1/√D in Q15. Apart from the error of r it is at most
/// 1, and the product at most 2³⁰.
#[inline(always)]
pub(super) fn unit_k(k: i32, r: i32) -> i32 {
    let cosine = product(k >> 15, r) >> 15;
    debug_assert!(
        !cfg!(test) || cosine.unsigned_abs() < (1 << 15) + 160,
        "no cosine: {cosine}"
    );
    cosine
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table is off by half a step of D, and by the unit that `isqrt` cuts.
    #[test]
    fn roots_are_as_good_as_their_steps() {
        let mut worst = [0.0f64; 2];
        for d in ((1 << 28)..=(1 << 30)).step_by(9973) {
            let exact = 1.0 / (f64::from(d) / f64::from(1 << 30)).sqrt();
            let table = f64::from(root_of(d)) / 32768.0;
            let limit = exact.powi(3) / 8192.0 * 1.001 + 1.0 / 32768.0;
            assert!((table - exact).abs() <= limit, "{d}: {table} {exact}");
            let refined = f64::from(root_below::<true>(below_one(d))) / 32768.0;
            worst[0] = worst[0].max((table - exact).abs());
            if d >= 270_000_000 {
                worst[1] = worst[1].max((refined - exact).abs());
            }
        }
        assert!(worst[0] > 8e-4 && worst[1] < 1.3e-4, "{worst:?}");
    }

    /// The table reads 11 bits and the step of Newton's method 16, so these are all cases.
    #[test]
    fn no_d_overflows() {
        for upper in 0..=0xFFFF {
            for x in [upper << 16, upper << 16 | 0xFFFF] {
                assert!(root_below::<true>(x) <= 98_304);
            }
        }
    }
}
