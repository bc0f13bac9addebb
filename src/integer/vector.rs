//! Vectors of 15 fractional bits.

use super::reciprocal_root::{product, root_of};
use fixed::types::I17F15;

/// The largest square of a vector's length, with 30 fractional bits: 1 + 2⁻¹³.
///
/// D may exceed 1 by 2⁻¹¹, which is 16 units of 2⁻¹⁵, before its table of roots wraps. The formats need up to 11 of
/// them: where a span turns by 180°, 1/n moves its last normal by 2 units, the cut of the difference and that of the
/// pixel's normal by √3 each, and D has twice that. Vectors that are rounded from unit ones have at most 1.75.
pub(super) const LONGEST: i32 = (1 << 30) + (1 << 17);

/// A vector that no loop overflows on: its components have 15 fractional bits, and its length is at most 1, but for
/// rounding.
///
/// Whatever it is made from, a longer one than that becomes a unit vector of the same direction. Shorter ones stay as they
/// are: only the direction counts for lights, for [`colour`](super::colour) and for vertices, and the ratio of lengths for the
/// two ends of a [`Span`](super::Span).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vector(Bits);

/// A vector's bits: what loops compute with.
pub(super) type Bits = [i32; 3];

impl Vector {
    /// Makes a vector of any components.
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

    /// Makes a vector of floats, each rounded to the nearest 2⁻¹⁵. `None` if one of them is no finite number.
    #[cfg(feature = "alloc")]
    pub fn from_f32(components: [f32; 3]) -> Option<Self> {
        let [x, y, z] = components.map(f64::from);
        let length = libm::sqrt(x * x + y * y + z * z);
        // Rounding adds up to √3/2 units of 2⁻¹⁵ to a length.
        let scale = match length > 1.0 + 1.0 / 65536.0 {
            true => 32768.0 / length,
            false => 32768.0,
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

/// Returns the bits of a vector of length 1, unless it is 0: those that it has if its length is 1 but for rounding.
#[inline(always)]
pub(super) const fn unit_bits(v: Bits) -> Bits {
    // Where unit vectors were rounded, 1 − D is below 2⁻¹².
    if dot(v, v) >= (1 << 30) - (1 << 18) {
        v
    } else {
        normalized(v)
    }
}

/// Returns the unit vector of a direction; 0 for the vector 0.
///
/// It is right to 2⁻¹⁴ in each component.
pub const fn unit(direction: [i16; 3]) -> Vector {
    let [x, y, z] = direction;
    Vector(narrowed(wide_direction([x as i64, y as i64, z as i64])))
}

/// Returns the dot product of two vectors, with 30 fractional bits.
///
/// No partial sum exceeds the product of both lengths, by Cauchy's inequality for the components
/// that it holds. Others wrap, as in [`product`].
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

/// Returns two vectors times the number that makes the longer one a unit vector; `square` is the square of its length, below 1.
#[cold]
#[inline(never)]
pub(super) const fn stretched([a, b]: [Bits; 2], mut square: i32) -> [Bits; 2] {
    // 32 fractional bits for the vectors, and as many doublings as make the longer one at least ½ long.
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

/// Returns a vector's bits as numbers of 64 bits.
pub(super) const fn widened([x, y, z]: Bits) -> [i64; 3] {
    [x as i64, y as i64, z as i64]
}

/// Returns the bits of a vector of 30 fractional bits, rounded.
pub(super) const fn narrowed([x, y, z]: [i64; 3]) -> Bits {
    let half = 1 << 14;
    [
        ((x + half) >> 15) as i32,
        ((y + half) >> 15) as i32,
        ((z + half) >> 15) as i32,
    ]
}

/// Returns the square of a vector's length. Components are at most 2³¹ in magnitude, so that three squares fit 64 bits.
const fn square([x, y, z]: [i64; 3]) -> u64 {
    let [x, y, z] = [x.unsigned_abs(), y.unsigned_abs(), z.unsigned_abs()];
    x * x + y * y + z * z
}

/// Returns the unit vector of a direction with 30 fractional bits, from components of at most 2³¹ in magnitude; 0 for the
/// vector 0. Its length is right to 2⁻¹⁵.
#[inline(never)]
pub(super) const fn wide_direction([x, y, z]: [i64; 3]) -> [i64; 3] {
    // The highest bit of the largest component becomes bit 30, so that three squares fit 64 bits.
    let most = x.unsigned_abs() | y.unsigned_abs() | z.unsigned_abs();
    if most == 0 {
        return [0; 3];
    }
    let zeros = most.leading_zeros();
    let (up, down) = (zeros.saturating_sub(33), 33u32.saturating_sub(zeros));
    let mut v = [x << up >> down, y << up >> down, z << up >> down];
    let mut d = square(v);
    // As many bits as make the length ½ to 1 with 32 fractional ones.
    if d < 1 << 62 {
        v = [v[0] << 1, v[1] << 1, v[2] << 1];
        d <<= 2;
    }
    over_length(v, (d >> 34) as i64)
}

/// Returns a vector divided by its length; 0 for the vector 0.
#[inline(never)]
pub(super) const fn normalized(v: Bits) -> Bits {
    let (wide, d) = (widened(v), dot(v, v));
    // Those that are not below 1 need no halving for their root.
    if d >= 1 << 30 {
        let [x, y, z] = wide;
        narrowed(over_length([x << 17, y << 17, z << 17], d as i64))
    } else {
        narrowed(wide_direction(wide))
    }
}

/// Returns a vector of 32 fractional bits divided by √D with 30 of them, from D of 30, which is ¼ to 1.
const fn over_length(v: [i64; 3], d: i64) -> [i64; 3] {
    // Two steps of Newton's in 64 bits: near D = ¼ the root reaches 2.
    let mut r = root_of(d as i32) as i64;
    r += (r * ((1 << 30) - ((d * ((r * r) >> 15)) >> 15))) >> 31;
    r += (r * ((1 << 30) - ((d * ((r * r) >> 15)) >> 15))) >> 31;
    [(v[0] * r) >> 17, (v[1] * r) >> 17, (v[2] * r) >> 17]
}
