//! The unit sphere, smooth or bumpy, by longitude and latitude.

use super::grid::{ParameterGrid, Topology};
use super::{turn, turns};
use crate::mesh::{MeshError, PolygonMesh};
use glam::DVec3;

/// Makes the unit sphere with `segments` meridians and `rings` bands of latitude. Its poles lie on
/// the y axis.
///
/// The bands at the poles consist of triangles; all other cells are quads, or two triangles each.
///
/// # Errors
/// [`MeshError::TooLarge`].
pub fn sphere(segments: usize, rings: usize, triangles: bool) -> Result<PolygonMesh, MeshError> {
    over_directions(segments, rings, triangles, |direction| {
        (direction, direction)
    })
}

/// Makes the unit sphere with bumps. In direction (x, y, z) its radius is
/// `1 + amplitude · sin(f x) sin(f y) sin(f z)`, where `f` is the `frequency`.
///
/// The radius is a smooth function of the direction, also at the poles. The shape is star-convex
/// for any amplitude below 1.
///
/// # Errors
/// [`MeshError::TooLarge`]; [`MeshError::NotFinite`] if a parameter is not finite.
pub fn bumpy(
    segments: usize,
    rings: usize,
    amplitude: f64,
    frequency: f64,
    triangles: bool,
) -> Result<PolygonMesh, MeshError> {
    over_directions(segments, rings, triangles, |d| {
        let sin = DVec3::new(
            libm::sin(frequency * d.x),
            libm::sin(frequency * d.y),
            libm::sin(frequency * d.z),
        );
        let cos = DVec3::new(
            libm::cos(frequency * d.x),
            libm::cos(frequency * d.y),
            libm::cos(frequency * d.z),
        );
        let radius = 1.0 + amplitude * sin.x * sin.y * sin.z;
        let gradient = amplitude
            * frequency
            * DVec3::new(
                cos.x * sin.y * sin.z,
                sin.x * cos.y * sin.z,
                sin.x * sin.y * cos.z,
            );
        // The surface r(d) d has the normal r d − ∇r, where ∇ is the gradient along the unit
        // sphere.
        let along_sphere = gradient - gradient.dot(d) * d;
        (radius * d, (radius * d - along_sphere).normalize())
    })
}

fn over_directions(
    segments: usize,
    rings: usize,
    triangles: bool,
    surface: impl Fn(DVec3) -> (DVec3, DVec3),
) -> Result<PolygonMesh, MeshError> {
    let grid = ParameterGrid::new(Topology::Ball, segments, rings, triangles);
    if grid.polygon_count() > PolygonMesh::MAX_POLYGONS as u64 {
        return Err(MeshError::TooLarge);
    }
    let longitudes = turns(grid.columns);
    let mut latitude = turn(0, 1);
    grid.mesh(|column, row| {
        // Rows cover half a turn, from the south pole to the north pole. The grid asks row after
        // row, so column 0 begins a new one.
        if column == 0 {
            latitude = turn(row, 2 * grid.rows);
        }
        let (sin, cos) = latitude;
        let (east, front) = longitudes[column];
        surface(DVec3::new(sin * east, -cos, sin * front))
    })
}
