//! Vectors in Q15, and unit vectors.

use super::reciprocal_root::{product, root_of};
use fixed::types::I17F15;

/// The largest square of a vector's length, 1 + 2⁻¹³ in Q30.
///
/// D may exceed 1 by 2⁻¹¹, which is 16 units of 2⁻¹⁵, before its table of roots wraps. The number
/// formats use up to 11 of these: where a span turns by 180°, 1/n moves its last normal by 2 units,
/// and the cuts of the difference and of the pixel's normal by √3 each, and D moves by twice the
/// sum. A rounded unit vector uses at most 1.75.
pub(super) const LONGEST: i32 = (1 << 30) + (1 << 17);

/// A vector of at most unit length, in Q15, on which no loop of this module can overflow.
///
/// Constructors turn a longer vector into the unit vector of its direction, and leave shorter ones
/// unchanged. For lights, vertices and [`colour`](super::colour) only the direction counts. For the
/// two ends of a [`Span`](super::Span) the ratio of their lengths counts as well.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vector(Bits);

/// A vector's bits in Q15, with which loops compute.
pub(super) type Bits = [i32; 3];

impl Vector {
    /// Makes a vector from any components. A vector longer than 1 + 2⁻¹⁴ becomes a unit vector.
    pub const fn new(components: [I17F15; 3]) -> Self {
        let [x, y, z] = components;
        let bits = [x.to_bits(), y.to_bits(), z.to_bits()];
        let wide = widened(bits);
        if square(wide) <= LONGEST as u64 {
            Self(bits)
        } else {
            Self(narrowed(wide_direction(wide)))
        }
    }

    /// Makes a vector from floats, each rounded to the nearest 2⁻¹⁵. Returns `None` if one of them
    /// is not finite.
    #[cfg(feature = "alloc")]
    pub fn from_f32(components: [f32; 3]) -> Option<Self> {
        let [x, y, z] = components.map(f64::from);
        let length = libm::sqrt(x * x + y * y + z * z);
        // Rounding adds up to √3/2 units of 2⁻¹⁵ to a length.
        let scale = if length > 1.0 + 1.0 / 65536.0 {
            32768.0 / length
        } else {
            32768.0
        };
        (length.is_finite()).then(|| Self([x, y, z].map(|c| libm::rint(c * scale) as i32)))
    }

    /// Returns the components.
    pub const fn to_array(self) -> [I17F15; 3] {
        let [x, y, z] = self.0;
        [
            I17F15::from_bits(x),
            I17F15::from_bits(y),
            I17F15::from_bits(z),
        ]
    }

    /// Returns the bits of the components.
    #[inline(always)]
    pub(super) const fn bits(self) -> Bits {
        self.0
    }
}

/// Returns the unit vector of a direction, or 0 for the vector 0. A vector whose length is 1 up to
/// rounding is returned unchanged.
#[inline(always)]
pub(super) const fn unit_bits(v: Bits) -> Bits {
    // Rounding a unit vector leaves 1 − D below 2⁻¹².
    if dot(v, v) >= (1 << 30) - (1 << 18) {
        v
    } else {
        normalized(v)
    }
}

/// Returns the unit vector of a direction, or 0 for the vector 0.
///
/// Components may be any integers: only their ratio counts. Each component of the result is right
/// to 2⁻¹⁴.
pub const fn unit(direction: [i16; 3]) -> Vector {
    let [x, y, z] = direction;
    Vector(narrowed(wide_direction([x as i64, y as i64, z as i64])))
}

/// Returns the dot product of two Q15 vectors, in Q30.
///
/// By Cauchy's inequality no partial sum exceeds the product of the lengths. See [`product`] for
/// why it would wrap.
#[inline(always)]
pub(super) const fn dot(a: Bits, b: Bits) -> i32 {
    let [x, y, z] = [
        product(a[0], b[0]),
        product(a[1], b[1]),
        product(a[2], b[2]),
    ];
    if cfg!(test) {
        x + y + z
    } else {
        x.wrapping_add(y).wrapping_add(z)
    }
}

/// Scales two vectors alike, so that the longer one becomes a unit vector. `square` is the square
/// of its length in Q30, below 1.
#[cold]
#[inline(never)]
pub(super) const fn stretched([a, b]: [Bits; 2], mut square: i32) -> [Bits; 2] {
    // Give the vectors 32 fractional bits, and double them until the longer one is at least ½ long.
    let mut shift = 17;
    while shift < 32 && square < 1 << 28 {
        square <<= 2;
        shift += 1;
    }
    let ([ax, ay, az], [bx, by, bz]) = (widened(a), widened(b));
    [
        narrowed(over_length(
            [ax << shift, ay << shift, az << shift],
            square as i64,
        )),
        narrowed(over_length(
            [bx << shift, by << shift, bz << shift],
            square as i64,
        )),
    ]
}

/// Returns a vector's bits in 64 bits.
pub(super) const fn widened([x, y, z]: Bits) -> [i64; 3] {
    [x as i64, y as i64, z as i64]
}

/// Rounds a vector from Q30 to Q15.
pub(super) const fn narrowed([x, y, z]: [i64; 3]) -> Bits {
    let half = 1 << 14;
    [
        ((x + half) >> 15) as i32,
        ((y + half) >> 15) as i32,
        ((z + half) >> 15) as i32,
    ]
}

/// Returns the square of a vector's length. Components are at most 2³¹ in magnitude, so three
/// squares fit 64 bits.
const fn square([x, y, z]: [i64; 3]) -> u64 {
    let [x, y, z] = [x.unsigned_abs(), y.unsigned_abs(), z.unsigned_abs()];
    x * x + y * y + z * z
}

/// Returns the unit vector of a direction in Q30, or 0 for the vector 0. Components are at most 2³¹
/// in magnitude. The result's length is right to 2⁻¹⁵.
#[inline(never)]
pub(super) const fn wide_direction([x, y, z]: [i64; 3]) -> [i64; 3] {
    // Shift the highest bit of the largest component to bit 30, so that three squares fit 64 bits.
    let most = x.unsigned_abs() | y.unsigned_abs() | z.unsigned_abs();
    if most == 0 {
        return [0; 3];
    }
    let zeros = most.leading_zeros();
    // At most one of both is not 0.
    let (up, down) = (zeros.saturating_sub(33), 33u32.saturating_sub(zeros));
    let mut v = [x << up >> down, y << up >> down, z << up >> down];
    let mut d = square(v);
    // With 32 fractional bits the length shall be ½ to 1: double it if it is less.
    if d < 1 << 62 {
        v = [v[0] << 1, v[1] << 1, v[2] << 1];
        d <<= 2;
    }
    over_length(v, (d >> 34) as i64)
}

/// Returns a vector divided by its length, or 0 for the vector 0.
#[inline(never)]
pub(super) const fn normalized(v: Bits) -> Bits {
    let (wide, d) = (widened(v), dot(v, v));
    // `wide_direction` halves a length of 1 or more before its root. Here D may be slightly above
    // 1, for which the table of roots has room.
    if d >= 1 << 30 {
        let [x, y, z] = wide;
        narrowed(over_length([x << 17, y << 17, z << 17], d as i64))
    } else {
        narrowed(wide_direction(wide))
    }
}

/// Returns a vector divided by √D, in Q30. The vector has 32 fractional bits, and D is ¼ to 1 in
/// Q30.
const fn over_length(v: [i64; 3], d: i64) -> [i64; 3] {
    // Two steps of Newton's method, in 64 bits because near D = ¼ the root reaches 2.
    let mut r = root_of(d as i32) as i64;
    r += (r * ((1 << 30) - ((d * ((r * r) >> 15)) >> 15))) >> 31;
    r += (r * ((1 << 30) - ((d * ((r * r) >> 15)) >> 15))) >> 31;
    [(v[0] * r) >> 17, (v[1] * r) >> 17, (v[2] * r) >> 17]
}
