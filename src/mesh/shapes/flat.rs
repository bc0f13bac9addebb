//! Flat meshes that face +z: single polygons of many sides, convex and concave, and the square of
//! Figure 5.

use super::turn;
use crate::mesh::{GivenNormals, MeshBuilder, MeshError, PolygonMesh};
use alloc::vec;
use alloc::vec::Vec;
use glam::{DVec2, DVec3, Vec3};

/// Returns the point at `k / n` of a turn on the circle of radius `radius`, counter-clockwise from
/// the top.
fn around(radius: f64, k: usize, n: usize) -> DVec2 {
    let (sin, cos) = turn(k, n);
    radius * DVec2::new(-sin, cos)
}

/// Returns the corners of a star: `points` points on the unit circle, and between them inner
/// corners at radius `inner`.
pub(super) fn star_outline(points: usize, inner: f64) -> Vec<DVec2> {
    let n = 2 * points.max(2);
    (0..n)
        .map(|k| around(if k % 2 == 0 { 1.0 } else { inner }, k, n))
        .collect()
}

/// Makes one polygon for each outline. Outlines share no corners.
fn flat(outlines: &[Vec<DVec2>]) -> Result<PolygonMesh, MeshError> {
    let corners: usize = outlines.iter().map(Vec::len).sum();
    if corners > PolygonMesh::MAX_CORNERS {
        return Err(MeshError::TooLarge);
    }
    let mut builder = MeshBuilder::new(
        outlines
            .iter()
            .flatten()
            .map(|p| p.extend(0.0).as_vec3())
            .collect(),
    );
    builder.reserve(outlines.len(), corners);
    let mut start = 0;
    for outline in outlines {
        let end = start + outline.len() as u32;
        builder.polygon(&(start..end).collect::<Vec<_>>());
        start = end;
    }
    builder.finish()
}

/// Makes one equilateral triangle in the unit circle, with a corner at the top.
///
/// # Errors
/// None in practice: three corners always make a mesh.
pub fn triangle() -> Result<PolygonMesh, MeshError> {
    polygon(3)
}

/// Makes one regular polygon of `sides` sides in the unit circle, with a corner at the top.
///
/// # Errors
/// [`MeshError::TooLarge`].
pub fn polygon(sides: usize) -> Result<PolygonMesh, MeshError> {
    let n = sides.max(3);
    flat(&[(0..n).map(|k| around(1.0, k, n)).collect()])
}

/// Makes one star-shaped polygon: `points` points on the unit circle, and between them inner
/// corners at radius `inner`.
///
/// # Errors
/// [`MeshError::TooLarge`]; [`MeshError::NotFinite`] if `inner` is not finite.
pub fn star(points: usize, inner: f64) -> Result<PolygonMesh, MeshError> {
    flat(&[star_outline(points, inner)])
}

/// Makes one comb-shaped polygon of 4 `teeth` sides, 2 wide and 1 high. A scan line crosses it up
/// to 2 `teeth` times.
///
/// # Errors
/// [`MeshError::TooLarge`].
pub fn comb(teeth: usize) -> Result<PolygonMesh, MeshError> {
    let teeth = teeth.max(1);
    let width = (2 * teeth - 1) as f64;
    // `x` counts widths of a tooth, `y` quarters of the height.
    let at = |x: usize, y: f64| DVec2::new((2.0 * x as f64 - width) / width, (y - 2.0) / 4.0);
    let mut outline = vec![at(0, 0.0), at(2 * teeth - 1, 0.0)];
    for tooth in (0..teeth).rev() {
        outline.extend([at(2 * tooth + 1, 4.0), at(2 * tooth, 4.0)]);
        if tooth > 0 {
            outline.extend([at(2 * tooth, 1.0), at(2 * tooth - 1, 1.0)]);
        }
    }
    flat(&[outline])
}

/// The outlines of block letters without holes, counter-clockwise, on the lines of a grid. Each
/// letter is 5 squares high.
const SHINE: [&[[i8; 2]]; 5] = [
    &[
        [0, 0],
        [3, 0],
        [3, 3],
        [1, 3],
        [1, 4],
        [3, 4],
        [3, 5],
        [0, 5],
        [0, 2],
        [2, 2],
        [2, 1],
        [0, 1],
    ],
    &[
        [0, 0],
        [1, 0],
        [1, 2],
        [2, 2],
        [2, 0],
        [3, 0],
        [3, 5],
        [2, 5],
        [2, 3],
        [1, 3],
        [1, 5],
        [0, 5],
    ],
    &[
        [0, 0],
        [3, 0],
        [3, 1],
        [2, 1],
        [2, 4],
        [3, 4],
        [3, 5],
        [0, 5],
        [0, 4],
        [1, 4],
        [1, 1],
        [0, 1],
    ],
    &[
        [0, 0],
        [1, 0],
        [1, 3],
        [3, 0],
        [4, 0],
        [4, 5],
        [3, 5],
        [3, 2],
        [1, 5],
        [0, 5],
    ],
    &[
        [0, 0],
        [3, 0],
        [3, 1],
        [1, 1],
        [1, 2],
        [3, 2],
        [3, 3],
        [1, 3],
        [1, 4],
        [3, 4],
        [3, 5],
        [0, 5],
    ],
];

/// Makes the word SHINE in block letters: five concave polygons of 10 or 12 sides, 2 wide and 0.5
/// high.
///
/// # Errors
/// None in practice: the letters always make a mesh.
pub fn letters() -> Result<PolygonMesh, MeshError> {
    let mut left = 0.0;
    let mut outlines = Vec::new();
    for letter in SHINE {
        // The whole word is 20 squares wide, with one square between letters.
        let place = |&[x, y]: &[i8; 2]| {
            DVec2::new((left + x as f64 - 10.0) / 10.0, (y as f64 - 2.5) / 10.0)
        };
        outlines.push(letter.iter().map(place).collect());
        left += letter.iter().map(|c| c[0] as f64).fold(0.0, f64::max) + 1.0;
    }
    flat(&outlines)
}

/// Makes the square of Figure 5 (L21 3), turned counter-clockwise by `angle` degrees. It is a quad
/// with its own normals, and its shading by scan lines depends on the angle.
///
/// The square stands on a corner, and its corners are at distance 1 from the centre. Three corners
/// have the normal (0, 0, 1). The fourth, which is the lowest at angle 0, has a normal that points
/// down along the diagonal. Under one light from +z three corners are white and one is black. At 0°
/// every scan line of the upper half runs between white edges, so that half of the square is white.
/// At 90° the black corner is at the side: these scan lines run from a white edge to an edge that
/// darkens toward that corner, so this half is grey up to the diagonal. If the square is split into
/// two triangles along that diagonal, its shading does not depend on the angle.
///
/// # Errors
/// [`MeshError::NotFinite`] if the angle is not finite.
pub fn figure5(angle: f64) -> Result<PolygonMesh, MeshError> {
    // For whole degrees `turn` is exact at quarter turns.
    let (sin, cos) = if angle == libm::trunc(angle) {
        turn((angle % 360.0 + 360.0) as usize, 360)
    } else {
        libm::sincos(angle.to_radians())
    };
    let turned = |p: DVec3| DVec3::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z).as_vec3();
    let positions = [DVec3::Y, -DVec3::X, -DVec3::Y, DVec3::X]
        .map(turned)
        .to_vec();
    let mut builder = MeshBuilder::new(positions);
    builder.polygon(&[0, 1, 2, 3]);
    builder.normals(GivenNormals {
        values: vec![Vec3::Z, Vec3::Z, turned(-DVec3::Y), Vec3::Z],
        corners: None,
    });
    builder.finish()
}
