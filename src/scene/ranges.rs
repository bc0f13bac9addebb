//! The ranges of a scene's values: one list for scene files, for flags, and for scenes that a
//! program makes.
//!
//! `file/` checks what a user wrote and names the key or the flag. `frame/guard.rs` checks what a
//! frame is made of, whoever made it. Both use this list, so that neither accepts what the other
//! refuses.

use glam::DVec3;

/// A closed range of numbers, with the words for it in messages: "expected `expected`".
#[derive(Clone, Copy, Debug)]
pub(crate) struct NumberRange {
    least: f64,
    most: f64,
    /// True if infinity is in the range, too. It stands for `most`.
    has_infinity: bool,
    pub expected: &'static str,
}

impl NumberRange {
    pub(crate) const fn new(least: f64, most: f64, expected: &'static str) -> NumberRange {
        NumberRange {
            least,
            most,
            has_infinity: false,
            expected,
        }
    }

    /// True if `value` is in the range. NaN never is.
    pub(crate) fn holds(&self, value: f64) -> bool {
        (self.least..=self.most).contains(&value) || self.has_infinity && value == f64::INFINITY
    }

    /// True if all three coordinates are in the range.
    pub(crate) fn holds_all(&self, point: DVec3) -> bool {
        point.to_array().into_iter().all(|c| self.holds(c))
    }
}

/// Coordinates in world space. Squares of distances (at most 12 times the square of a coordinate),
/// and their products with coefficients, stay far inside the range of an `f32`.
pub(crate) const COORDINATE: NumberRange =
    NumberRange::new(-1e15, 1e15, "numbers between -1e15 and 1e15");

/// Coordinates relative to the eye or to another point. They are at most the diagonal of the cube
/// of all coordinates, 2√3 · 10¹⁵, so that their squares, too, stay far inside the range of an
/// `f32`.
pub(crate) const DISTANCE: NumberRange =
    NumberRange::new(-1e16, 1e16, "numbers between -1e16 and 1e16");

/// The largest distance of the near and the far plane, beyond everything that they can have between
/// them.
const FARTHEST: f64 = 1e20;

/// Distances of the near plane.
pub(crate) const PLANE: NumberRange =
    NumberRange::new(-FARTHEST, FARTHEST, "numbers between -1e20 and 1e20");

/// Distances of the far plane, which matrices without one have at infinity.
pub(crate) const FAR: NumberRange = NumberRange {
    has_infinity: true,
    expected: "numbers between -1e20 and 1e20, or infinity",
    ..PLANE
};

/// Returns the distance that is computed with in place of a distance of the far plane.
pub(crate) fn far(distance: f64) -> f64 {
    if distance == f64::INFINITY {
        FARTHEST
    } else {
        distance
    }
}

/// The distance of the near plane under perspective.
pub(crate) const NEAR: NumberRange = NumberRange::new(
    f64::from_bits(1),
    FARTHEST,
    "a number over 0 (up to 1e20), as the camera is a perspective one",
);

/// Half of the height that an orthographic camera sees. Its reciprocal times any coordinate stays
/// far inside the range of an `f64`.
pub(crate) const HALF_HEIGHT: NumberRange =
    NumberRange::new(1e-100, 1e100, "a number over 0 (1e-100 to 1e100)");

/// The vertical field of view.
pub(crate) const FOVY: NumberRange = NumberRange::new(
    1e-3,
    179.999,
    "degrees over 0 and under 180 (0.001 to 179.999)",
);

/// The sine of the angle between up and the line of sight. Below the limit, rounding would decide
/// which way is up.
pub(crate) const TILT: NumberRange = NumberRange::new(1e-6, 1.5, "at least 1e-6");

/// The lengths to which a transform may scale a unit vector of the model. The range is a little
/// wider than its message says, because rounding may move a length beyond either end.
pub(crate) const SIZE: NumberRange = NumberRange::new(0.5e-15, 2e15, "1e-15 to 1e15");

/// The volume of a unit cube after a transform, divided by the volume of a box with the same edges
/// at right angles. Below the limit, the directions of normals are mere rounding.
pub(crate) const VOLUME: NumberRange =
    NumberRange::new(1e-12, 1.5, "over 1e-12: a transform that can be inverted");

/// Colours of pixels.
pub(crate) const PIXEL: NumberRange = NumberRange::new(0.0, 1.0, "0 to 1");

/// Intensities of light, coefficients of reflection, attenuations and exponents: any non-negative
/// value of an `f32`.
pub(crate) const STRENGTH: NumberRange =
    NumberRange::new(0.0, f32::MAX as f64, "0 or more, up to 3.4e38");

/// The distance up to which positions are merged, as a fraction of the mesh's size.
#[cfg(feature = "io")]
pub(crate) const WELD: NumberRange =
    NumberRange::new(1e-12, 0.1, "a fraction of the mesh's size, 1e-12 to 0.1");

/// The angle up to which vertex normals are averaged.
pub(crate) const CREASE: NumberRange = NumberRange::new(0.0, 180.0, "degrees between 0 and 180");
