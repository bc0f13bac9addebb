//! Directions and lengths of vectors of any size.

use glam::DVec3;

/// How far the square of a unit vector's length may be from 1.
///
/// A vector that was divided by its length in `f32` is left unchanged, to the bit. Its square came
/// from a product and two sums, 3 roundings of 2⁻²⁴, of which the root leaves half. Root,
/// reciprocal and product add 3 more. So the length is off by at most 4.5 such roundings, and its
/// square by 9, which is less than 16.
const ROUNDING: f64 = 1.0 / (1 << 20) as f64;

/// Returns the length of a vector. Scaling it first keeps the squares from overflowing or
/// underflowing.
pub(crate) fn length(vector: DVec3) -> f64 {
    match vector.abs().max_element() {
        size if size > 0.0 && size.is_finite() => size * (vector / size).length(),
        _ => vector.length(),
    }
}

/// Returns the unit vector along `vector`. Scaling it first keeps the squares from overflowing or
/// underflowing.
pub(crate) fn unit(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize()
}

/// True if a vector is a unit vector, apart from rounding.
pub(crate) fn is_unit(vector: DVec3) -> bool {
    (vector.length_squared() - 1.0).abs() <= ROUNDING
}

/// Returns the unit vector along `vector`. A vector that is one already, apart from rounding, or
/// that has no direction is returned unchanged.
pub(crate) fn as_unit(vector: DVec3) -> DVec3 {
    let has_direction = vector.is_finite() && vector != DVec3::ZERO;
    if is_unit(vector) || !has_direction {
        vector
    } else {
        unit(vector)
    }
}
