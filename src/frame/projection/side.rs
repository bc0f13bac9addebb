//! The side from which a polygon is seen, and lit by two-sided lighting.

use glam::{DVec3, DVec4};

/// A side of a polygon. Two-sided lighting lights the side that the eye sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// The side to which the normals point.
    Front,
    /// The other side, where normals are negated.
    Back,
}

impl Side {
    /// Turns a normal to this side.
    pub fn turn(self, normal: &mut [f32; 3]) {
        if self == Side::Back {
            *normal = normal.map(|n| -n);
        }
    }
}

/// Returns on which side of a polygon the eye is: over 0 if the corners run counter-clockwise for
/// the eye, wherever the polygon is cut, and below 0 if clockwise. Exact up to rounding for flat
/// polygons; a compromise between the corners for others.
pub(super) fn eye_side(corners: impl Iterator<Item = DVec4> + Clone) -> f64 {
    // Without z, clip space is the space seen from the eye, up to scales of its axes. So the dot
    // product of Newell's normal and the sum of the corners has the right sign.
    let flat = |clip: DVec4| DVec3::new(clip.x, clip.y, clip.w);
    let following = corners.clone().skip(1).chain(corners.clone().take(1));
    let normal: DVec3 = corners
        .clone()
        .zip(following)
        .map(|(a, b)| flat(a).cross(flat(b)))
        .sum();
    normal.dot(corners.map(flat).sum())
}
