//! Superellipsoids: from a rounded box through the sphere to a rounded double pyramid.

use super::grid::{ParameterGrid, Topology};
use super::{turn, turns};
use crate::mesh::{MeshError, PolygonMesh};
use glam::DVec3;

/// A point of the superellipse |x|^(2/e) + |y|^(2/e) = 1, and the gradient of the left side there,
/// without its factor 2/e.
#[derive(Clone, Copy)]
struct EllipsePoint {
    x: f64,
    y: f64,
    gradient_x: f64,
    gradient_y: f64,
}

impl EllipsePoint {
    /// Returns the point in direction (x, y). Directions at equal angles sample flat sides and
    /// round edges evenly, while Barr's cosⁿ crowds its points at the edges.
    fn new(exponent: f64, (x, y): (f64, f64)) -> Self {
        let power = 2.0 / exponent;
        let gauge = libm::pow(
            libm::pow(x.abs(), power) + libm::pow(y.abs(), power),
            -exponent / 2.0,
        );
        let (x, y) = (gauge * x, gauge * y);
        let slope = |t: f64| libm::copysign(libm::pow(t.abs(), power - 1.0), t);
        EllipsePoint {
            x,
            y,
            gradient_x: slope(x),
            gradient_y: slope(y),
        }
    }
}

/// Makes the superellipsoid (|x|^(2/e2) + |z|^(2/e2))^(e2/e1) + |y|^(2/e1) = 1. It reaches from −1
/// to 1 along each axis.
///
/// `e1` shapes it along y and `e2` around y. At 1 it is round, toward 0 it becomes a box, and
/// toward 2 it becomes pointed. Both are clamped to 0.05..=1.95. Source: Barr, *Superquadrics and
/// angle-preserving transformations*, IEEE CG&A 1 (1981).
///
/// # Errors
/// [`MeshError::TooLarge`].
pub fn superellipsoid(
    e1: f64,
    e2: f64,
    segments: usize,
    rings: usize,
    triangles: bool,
) -> Result<PolygonMesh, MeshError> {
    let grid = ParameterGrid::new(Topology::Ball, segments, rings, triangles);
    if grid.polygon_count() > PolygonMesh::MAX_POLYGONS as u64 {
        return Err(MeshError::TooLarge);
    }
    let (e1, e2) = (e1.clamp(0.05, 1.95), e2.clamp(0.05, 1.95));
    let around: alloc::vec::Vec<_> = turns(grid.columns)
        .into_iter()
        .map(|d| EllipsePoint::new(e2, d))
        .collect();
    // The product of a profile along y and a ring around it. The profile changes once per row.
    let mut along = EllipsePoint::new(e1, (0.0, -1.0));
    grid.mesh(|column, row| {
        if column == 0 {
            let (sin, cos) = turn(row, 2 * grid.rows);
            along = EllipsePoint::new(e1, (sin, -cos));
        }
        let ring = around[column];
        let position = DVec3::new(along.x * ring.x, along.y, along.x * ring.y);
        let gradient = DVec3::new(
            along.gradient_x * ring.gradient_x,
            along.gradient_y,
            along.gradient_x * ring.gradient_y,
        );
        (position, gradient.normalize())
    })
}
