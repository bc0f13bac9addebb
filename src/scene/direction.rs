//! Directions and lengths of vectors of any size.

use glam::DVec3;

/// By how much the square of a unit vector's length may differ from 1.
///
/// A vector that was divided by its length in `f32` stays as it is, to the bit. Its square came of a product and two sums, 3 roundings
/// of 2⁻²⁴, of which the root leaves half; root, reciprocal and product are 3 more. So the length is off by 4.5 of these, and its
/// square by 9, which are less than 16.
const ROUNDING: f64 = 1.0 / (1 << 20) as f64;

/// Returns the length of a vector, whose squares neither overflow nor vanish.
pub(crate) fn length(vector: DVec3) -> f64 {
    match vector.abs().max_element() {
        size if size > 0.0 && size.is_finite() => size * (vector / size).length(),
        _ => vector.length(),
    }
}

/// Returns the unit vector along `vector`, which is scaled first: squares neither overflow nor vanish.
pub(crate) fn unit(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize()
}

/// True if a vector is a unit vector but for rounding.
pub(crate) fn is_unit(vector: DVec3) -> bool {
    (vector.length_squared() - 1.0).abs() <= ROUNDING
}

/// Returns the unit vector along `vector`: itself where it is one but for rounding, or has no direction.
pub(crate) fn as_unit(vector: DVec3) -> DVec3 {
    let has_direction = vector.is_finite() && vector != DVec3::ZERO;
    match is_unit(vector) || !has_direction {
        true => vector,
        false => unit(vector),
    }
}
