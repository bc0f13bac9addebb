//! Vectors of 15 fractional bits.

use super::reciprocal_root::root_of;
use fixed::types::I17F15;

/// A vector of length at most 1, but for rounding: so no product of two of them exceeds 2³⁰.
pub type Vector = [I17F15; 3];

/// A vector's bits: what loops compute with.
pub(super) type Bits = [i32; 3];

/// Returns the bits of a vector.
#[inline(always)]
pub(super) const fn bits(v: Vector) -> Bits {
    [v[0].to_bits(), v[1].to_bits(), v[2].to_bits()]
}

/// Returns the dot product of two vectors, with 30 fractional bits.
///
/// No partial sum exceeds the product of both lengths, by Cauchy's inequality for the components
/// that it holds.
#[inline(always)]
pub(super) const fn dot(a: Bits, b: Bits) -> i32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the unit vector of a direction; 0 for the vector 0. Components lie within ±2¹⁴.
///
/// It is right to 2⁻¹⁴ in each component.
pub const fn unit(direction: [i16; 3]) -> Vector {
    let mut v = [
        direction[0] as i32,
        direction[1] as i32,
        direction[2] as i32,
    ];
    // First every component below 1/√3, so that the length is below 1 …
    while largest(v) > 18918 {
        v = [v[0] >> 1, v[1] >> 1, v[2] >> 1];
    }
    // … then the length at least ½, where the root is exact.
    let mut shifts = 0;
    while shifts < 15 && dot(v, v) < 1 << 28 {
        v = [v[0] << 1, v[1] << 1, v[2] << 1];
        shifts += 1;
    }
    normalized(v)
}

/// Returns the largest magnitude of a component.
pub(super) const fn largest(v: Bits) -> i32 {
    let mut most = 0;
    let mut i = 0;
    while i < 3 {
        let magnitude = if v[i] < 0 { -v[i] } else { v[i] };
        most = if magnitude > most { magnitude } else { most };
        i += 1;
    }
    most
}

/// Returns a vector of length ¼ to 1 divided by its length; shorter ones become longer, not unit.
pub(super) const fn normalized(v: Bits) -> Vector {
    let d = dot(v, v) as i64;
    // Two steps of Newton's in 64 bits: near D = ¼ the root reaches 2.
    let mut r = root_of(d as i32) as i64;
    r += (r * ((1 << 30) - ((d * ((r * r) >> 15)) >> 15))) >> 31;
    r += (r * ((1 << 30) - ((d * ((r * r) >> 15)) >> 15))) >> 31;
    let mut unit = [I17F15::ZERO; 3];
    let mut i = 0;
    while i < 3 {
        unit[i] = I17F15::from_bits(((v[i] as i64 * r + (1 << 14)) >> 15) as i32);
        i += 1;
    }
    unit
}
