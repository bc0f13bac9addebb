//! Solids with flat faces: cube, star prism and gear.

use super::flat::star_outline;
use super::turn;
use crate::mesh::weld::weld;
use crate::mesh::{GivenNormals, MeshBuilder, MeshError, PolygonMesh};
use alloc::vec;
use alloc::vec::Vec;
use glam::{DVec2, DVec3, Vec3};

/// Makes the cube from −1 to 1, with `res` × `res` quads (or twice as many triangles) per face. Its
/// normals are perpendicular to the faces.
///
/// # Errors
/// [`MeshError::TooLarge`].
pub fn cube(res: usize, triangles: bool) -> Result<PolygonMesh, MeshError> {
    let n = res.max(1);
    let polygons = (n as u64)
        .saturating_mul(n as u64)
        .saturating_mul(if triangles { 12 } else { 6 });
    if polygons > PolygonMesh::MAX_POLYGONS as u64 {
        return Err(MeshError::TooLarge);
    }
    // All faces use this one function, so that positions on common edges have equal bits and weld.
    let coordinate = |k: usize| ((2.0 * k as f64 - n as f64) / n as f64) as f32;
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let mut values = Vec::with_capacity(6);
    let mut repeated = Vec::with_capacity(6 * (n + 1) * (n + 1));
    for (axis, side) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
        // Right and up as seen from outside, so that right × up is the outward normal.
        let (a, b) = (axes[(axis + 1) % 3], axes[(axis + 2) % 3]);
        let (right, up) = if side > 0.0 { (a, b) } else { (b, a) };
        values.push(side * axes[axis]);
        for row in 0..=n {
            repeated.extend((0..=n).map(|column| {
                side * axes[axis] + coordinate(column) * right + coordinate(row) * up
            }));
        }
    }
    let (index, count) = weld(&repeated);
    let mut positions = vec![Vec3::ZERO; count];
    index
        .iter()
        .zip(&repeated)
        .for_each(|(&i, &p)| positions[i as usize] = p);
    drop(repeated);
    let mut builder = MeshBuilder::new(positions);
    let corners = polygons as usize * if triangles { 3 } else { 4 };
    builder.reserve(polygons as usize, corners);
    for face in index.chunks_exact((n + 1) * (n + 1)) {
        for (row, column) in (0..n).flat_map(|row| (0..n).map(move |column| (row, column))) {
            let [a, b, c, d] = [(0, 0), (0, 1), (1, 1), (1, 0)]
                .map(|(i, j)| face[(row + i) * (n + 1) + column + j]);
            if triangles {
                builder.polygon(&[a, b, c]).polygon(&[a, c, d]);
            } else {
                builder.polygon(&[a, b, c, d]);
            }
        }
    }
    let of_corners = (0..corners).map(|k| (k / (corners / 6)) as u32).collect();
    builder.normals(GivenNormals {
        values,
        corners: Some(of_corners),
    });
    builder.finish()
}

/// Makes a prism over a star, with two concave caps of 2 `points` sides at z = ±`depth` / 2 and a
/// quad on each side.
///
/// # Errors
/// [`MeshError::TooLarge`]; [`MeshError::NotFinite`] if a size is not finite.
pub fn prism(points: usize, inner: f64, depth: f64) -> Result<PolygonMesh, MeshError> {
    extrude(&star_outline(points, inner), depth)
}

/// Makes a gear in the unit circle, with two concave caps of 4 `teeth` sides at z = ±`depth` / 2
/// and a quad on each side.
///
/// Teeth, gaps and flanks are equally wide. The gaps lie at radius `inner`.
///
/// # Errors
/// [`MeshError::TooLarge`]; [`MeshError::NotFinite`] if a size is not finite.
pub fn gear(teeth: usize, inner: f64, depth: f64) -> Result<PolygonMesh, MeshError> {
    let n = 4 * teeth.max(3);
    let corner = |k: usize| {
        let (sin, cos) = turn(k, n);
        let radius = if matches!(k % 4, 1 | 2) { 1.0 } else { inner };
        radius * DVec2::new(cos, sin)
    };
    extrude(&(0..n).map(corner).collect::<Vec<_>>(), depth)
}

/// Makes the solid between two copies of a counter-clockwise outline at z = ±`depth` / 2. Its
/// normals are perpendicular to the faces.
fn extrude(outline: &[DVec2], depth: f64) -> Result<PolygonMesh, MeshError> {
    let n = outline.len();
    let (polygons, corners) = (n + 2, 6 * n);
    if polygons > PolygonMesh::MAX_POLYGONS || corners > PolygonMesh::MAX_CORNERS {
        return Err(MeshError::TooLarge);
    }
    let at = |z: f64| outline.iter().map(move |p| p.extend(z).as_vec3());
    let mut builder = MeshBuilder::new(at(depth / 2.0).chain(at(-depth / 2.0)).collect());
    builder.reserve(polygons, corners);
    let front: Vec<u32> = (0..n as u32).collect();
    let back: Vec<u32> = (n as u32..2 * n as u32).rev().collect();
    builder.polygon(&front).polygon(&back);
    let mut values = vec![Vec3::Z, -Vec3::Z];
    let mut of_corners = vec![0; n];
    of_corners.resize(2 * n, 1);
    for k in 0..n {
        let next = (k + 1) % n;
        builder.polygon(&[(n + k) as u32, (n + next) as u32, next as u32, k as u32]);
        let along = outline[next] - outline[k];
        // Outside is to the right of an edge of a counter-clockwise outline.
        values.push(
            DVec3::new(along.y, -along.x, 0.0)
                .normalize_or_zero()
                .as_vec3(),
        );
        of_corners.extend([k as u32 + 2; 4]);
    }
    builder.normals(GivenNormals {
        values,
        corners: Some(of_corners),
    });
    builder.finish()
}
