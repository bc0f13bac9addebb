//! The torus, and tubes along knots on it.

use super::grid::{ParameterGrid, Topology};
use super::{turn, turns};
use crate::mesh::{MeshError, PolygonMesh};
use alloc::vec::Vec;
use glam::DVec3;

/// Makes the torus around the z axis: a tube of radius `minor` around a circle of radius `major`.
///
/// It has `segments` cells along the circle and `sides` around the tube.
///
/// # Errors
/// [`MeshError::TooLarge`]; [`MeshError::NotFinite`] if a radius is not finite.
pub fn torus(
    major: f64,
    minor: f64,
    segments: usize,
    sides: usize,
    triangles: bool,
) -> Result<PolygonMesh, MeshError> {
    let grid = ParameterGrid::new(Topology::Tube, segments, sides, triangles);
    if grid.polygon_count() > PolygonMesh::MAX_POLYGONS as u64 {
        return Err(MeshError::TooLarge);
    }
    let (along, around) = (turns(grid.columns), turns(grid.rows));
    grid.mesh(|column, row| {
        let ((sin_u, cos_u), (sin_v, cos_v)) = (along[column], around[row]);
        let normal = DVec3::new(cos_v * cos_u, cos_v * sin_u, sin_v);
        (
            major * DVec3::new(cos_u, sin_u, 0.0) + minor * normal,
            normal,
        )
    })
}

/// The radii of the torus around the z axis that knots lie on. They are the defaults of
/// `builtin("torus")`.
const KNOT_MAJOR: f64 = 1.0;
const KNOT_MINOR: f64 = 0.4;

/// Makes a tube of radius `radius` along the torus knot that goes `p` times around the axis while
/// it goes `q` times around the tube of a torus of radii 1 and 0.4.
///
/// The normal of that torus orients the tube's cross section. It returns to itself after one round,
/// so the seam has no jump. `p` and `q` must not have a common factor, or the curve runs over
/// itself several times. The tube meets itself if `radius` is too large for the knot.
///
/// # Errors
/// [`MeshError::TooLarge`]; [`MeshError::NotFinite`] if the radius is not finite.
pub fn knot(
    p: usize,
    q: usize,
    segments: usize,
    sides: usize,
    radius: f64,
    triangles: bool,
) -> Result<PolygonMesh, MeshError> {
    let grid = ParameterGrid::new(Topology::Tube, segments, sides, triangles);
    if grid.polygon_count() > PolygonMesh::MAX_POLYGONS as u64 {
        return Err(MeshError::TooLarge);
    }
    let frames: Vec<[DVec3; 3]> = (0..grid.columns)
        .map(|k| knot_frame(p, q, k, grid.columns))
        .collect();
    let around = turns(grid.rows);
    grid.mesh(|column, row| {
        let [centre, outward, sideways] = frames[column];
        let (sin, cos) = around[row];
        let normal = cos * outward + sin * sideways;
        (centre + radius * normal, normal)
    })
}

/// Returns the knot's point at parameter `k / n`, the normal of its torus there, and the cross
/// product of normal and tangent.
fn knot_frame(p: usize, q: usize, k: usize, n: usize) -> [DVec3; 3] {
    // The product is taken in u64, as it may overflow a 32-bit usize.
    let at = |times: usize| turn((k as u64 * times as u64 % n as u64) as usize, n);
    let ((sin_p, cos_p), (sin_q, cos_q)) = (at(p), at(q));
    let (p, q) = (p as f64, q as f64);
    let distance = KNOT_MAJOR + KNOT_MINOR * cos_q;
    let centre = DVec3::new(distance * cos_p, distance * sin_p, KNOT_MINOR * sin_q);
    let outward = DVec3::new(cos_q * cos_p, cos_q * sin_p, sin_q);
    let away = -KNOT_MINOR * q * sin_q;
    let tangent = DVec3::new(
        away * cos_p - distance * p * sin_p,
        away * sin_p + distance * p * cos_p,
        KNOT_MINOR * q * cos_q,
    );
    [centre, outward, outward.cross(tangent).normalize()]
}
