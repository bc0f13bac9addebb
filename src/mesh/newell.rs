//! Polygon normals by Newell's formula (L21 1.1).

use glam::DVec3;

/// The normal of a polygon by Newell's formula, taken about its first corner, in `f64`.
///
/// ```text
/// N = Σ (P_k − P_0) × (P_{k+1} − P_0)      (L21 1.1),   |N| = 2 · area
/// ```
///
/// The sum does not depend on the origin in exact arithmetic; about a corner it does not cancel for polygons far from
/// the origin. Collinear corners add nothing. The result is zero when the polygon has no normal: fewer than three
/// corners, all of them collinear, or lobes whose areas cancel.
pub fn newell(corners: impl IntoIterator<Item = DVec3>) -> DVec3 {
    let mut corners = corners.into_iter();
    let Some(origin) = corners.next() else { return DVec3::ZERO };
    let mut previous = DVec3::ZERO;
    let mut normal = DVec3::ZERO;
    for corner in corners {
        let current = corner - origin;
        normal += previous.cross(current); // 1.1
        previous = current;
    }
    normal
}
