//! The Utah teapot, made by cutting M. Newell's Bézier patches into cells.

use super::teapot_data::{BOTTOM_PATCHES, PATCHES, POINTS};
use crate::mesh::weld::weld;
use crate::mesh::{GivenNormals, MeshBuilder, MeshError, PolygonMesh};
use alloc::vec;
use alloc::vec::Vec;
use glam::{DVec3, Vec3};

/// Returns how many polygons [`teapot`] makes for these parameters; `u64::MAX` if that overflows.
pub fn teapot_polygons(res: usize, bottom: bool, triangles: bool) -> u64 {
    let (res, patches) = (res.max(1) as u64, patches(bottom).len() as u64);
    let cells = res.saturating_mul(res).saturating_mul(patches);
    if triangles {
        let collapsed = patches_with_pole(bottom) as u64;
        cells
            .saturating_mul(2)
            .saturating_sub(collapsed.saturating_mul(res))
    } else {
        cells
    }
}

/// Makes the Utah teapot. y points up and the spout toward +x; the body is 2 wide around the y
/// axis, and its height is centred on the origin.
///
/// Each of the 32 patches becomes `res` × `res` quads, or twice as many triangles. Without the
/// `bottom`, which the original of 1975 did not have, there are 28 patches. The cells at the knob's
/// top and in the bottom's middle are triangles. Patches share positions along their common edges.
/// Normals come from the patches themselves.
///
/// The shape is Newell's teapot in Blinn's lower version, which is the one usually drawn. It has an
/// open gap around the lid and an open spout, and the handle and the spout end inside the body. So
/// it is not closed, and both sides of some patches are visible.
///
/// # Errors
/// [`MeshError::TooLarge`].
pub fn teapot(res: usize, bottom: bool, triangles: bool) -> Result<PolygonMesh, MeshError> {
    let polygons = teapot_polygons(res, bottom, triangles);
    if polygons > PolygonMesh::MAX_POLYGONS as u64 {
        return Err(MeshError::TooLarge);
    }
    let n = res.max(1);
    let stored = patches(bottom).len() * (n + 1) * (n + 1);
    let mut repeated: Vec<Vec3> = Vec::with_capacity(stored);
    let mut directions: Vec<DVec3> = Vec::with_capacity(stored);
    for patch in patches(bottom) {
        for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
            let (position, normal) = Patch::new(patch).at(i, j, n);
            repeated.push(position.as_vec3());
            directions.push(normal);
        }
    }
    let (index, count) = weld(&repeated);
    let mut positions = vec![Vec3::ZERO; count];
    index
        .iter()
        .zip(&repeated)
        .for_each(|(&i, &p)| positions[i as usize] = p);
    drop(repeated);
    let (values, normal_of) = share_normals(&index, count, &directions);
    drop(directions);

    let mut builder = MeshBuilder::new(positions);
    builder.reserve(
        polygons as usize,
        polygons as usize * if triangles { 3 } else { 4 },
    );
    let mut of_corners = Vec::with_capacity(polygons as usize * if triangles { 3 } else { 4 });
    let mut polygon = |corners: &[usize]| {
        let mut indices = [0; 4];
        indices
            .iter_mut()
            .zip(corners)
            .for_each(|(corner, &c)| *corner = index[c]);
        builder.polygon(&indices[..corners.len()]);
        of_corners.extend(corners.iter().map(|&c| normal_of[c]));
    };
    for (k, patch) in patches(bottom).iter().enumerate() {
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b, c, d] = [(0, 0), (0, 1), (1, 1), (1, 0)]
                .map(|(u, v)| (k * (n + 1) + i + u) * (n + 1) + j + v);
            if i == 0 && has_pole(patch) {
                polygon(&[a, c, d]);
            } else if triangles {
                polygon(&[a, b, c]);
                polygon(&[a, c, d]);
            } else {
                polygon(&[a, b, c, d]);
            }
        }
    }
    builder.normals(GivenNormals {
        values,
        corners: Some(of_corners),
    });
    builder.finish()
}

fn patches(bottom: bool) -> &'static [[u16; 16]] {
    if bottom {
        &PATCHES
    } else {
        &PATCHES[..PATCHES.len() - BOTTOM_PATCHES]
    }
}

/// True if the first row of a patch is a single point, as at the knob's top and in the bottom's
/// middle.
fn has_pole(patch: &[u16; 16]) -> bool {
    patch[..4].iter().all(|&p| p == patch[0])
}

fn patches_with_pole(bottom: bool) -> usize {
    patches(bottom).iter().filter(|p| has_pole(p)).count()
}

/// Merges equal normals at a position. Patches that meet smoothly then share a normal, and at a
/// crease each patch has its own.
///
/// `index` holds the position of each entry of `directions`. Returns the distinct normals, and for
/// each entry an index into them.
fn share_normals(index: &[u32], count: usize, directions: &[DVec3]) -> (Vec<Vec3>, Vec<u32>) {
    // Directions up to 1e-6 apart count as equal: far above the rounding of the patches'
    // derivatives, far below any crease in the data. The cosine of an angle a is 1 − a²/2.
    const SAME: f64 = 1.0 - 0.5e-12;
    const NONE: u32 = u32::MAX;
    let mut first = vec![NONE; count];
    // A linked list per position: each value's direction, and the next value there.
    let mut chain: Vec<(DVec3, u32)> = Vec::with_capacity(count);
    let value_of = index
        .iter()
        .zip(directions)
        .map(|(&position, &direction)| {
            let head = &mut first[position as usize];
            let mut value = *head;
            while value != NONE && chain[value as usize].0.dot(direction) < SAME {
                value = chain[value as usize].1;
            }
            if value == NONE {
                value = chain.len() as u32;
                chain.push((direction, *head));
                *head = value;
            }
            value
        })
        .collect();
    (
        chain
            .iter()
            .map(|(direction, _)| direction.as_vec3())
            .collect(),
        value_of,
    )
}

/// A bicubic Bézier patch.
struct Patch {
    points: [[DVec3; 4]; 4],
    pole: bool,
}

impl Patch {
    fn new(indices: &[u16; 16]) -> Self {
        // A quarter turn around x makes the data's z-up y-up. Half the size makes the body 2 wide.
        // 3.15 is the height with the knob.
        let place = |i: u16| {
            let [x, y, z] = POINTS[i as usize];
            DVec3::new(x, z - 3.15 / 2.0, -y) / 2.0
        };
        let points = core::array::from_fn(|i| core::array::from_fn(|j| place(indices[4 * i + j])));
        Patch {
            points,
            pole: has_pole(indices),
        }
    }

    /// Returns the point and the outward unit normal at `i / n`, `j / n`.
    fn at(&self, i: usize, j: usize, n: usize) -> (DVec3, DVec3) {
        let (u, v) = (Bernstein::at(i, n), Bernstein::at(j, n));
        let points = self.points.map(|row| v.point(row));
        let slopes = self.points.map(|row| v.slope(row));
        if self.pole && i == 0 {
            // ∂P/∂v vanishes in a row that is a single point. Near that row it is u ∂²P/∂u∂v, so
            // the mixed derivative has its direction and gives the limit of the normal.
            return (
                self.points[0][0],
                u.slope(slopes).cross(u.slope(points)).normalize(),
            );
        }
        // In this data ∂P/∂v × ∂P/∂u points outward.
        (
            u.point(points),
            u.point(slopes).cross(u.slope(points)).normalize(),
        )
    }
}

/// The values of the cubic Bernstein polynomials at a parameter, and of the quadratic ones for the
/// derivative.
struct Bernstein {
    cubic: [f64; 4],
    quadratic: [f64; 3],
}

impl Bernstein {
    /// Returns the weights at `k / n`. Those at `n − k` are the reverse, bit for bit, so that an
    /// edge that two patches share in opposite directions has equal points in both.
    fn at(k: usize, n: usize) -> Self {
        let (t, s) = (k as f64 / n as f64, (n - k) as f64 / n as f64);
        Bernstein {
            cubic: [
                s * (s * s),
                3.0 * t * (s * s),
                3.0 * s * (t * t),
                t * (t * t),
            ],
            quadratic: [s * s, 2.0 * (s * t), t * t],
        }
    }

    /// Returns the curve's point. It adds the two ends, and the two middles, before the rest, so
    /// that reversing the points does not change a bit.
    fn point(&self, p: [DVec3; 4]) -> DVec3 {
        let [a, b, c, d] = self.cubic;
        weigh(p[0], a, p[3], d) + weigh(p[1], b, p[2], c)
    }

    /// Returns the curve's derivative without its factor 3, as only its direction matters.
    fn slope(&self, p: [DVec3; 4]) -> DVec3 {
        let [a, b, c] = self.quadratic;
        weigh(p[1] - p[0], a, p[3] - p[2], c) + (p[2] - p[1]) * b
    }
}

fn weigh(p: DVec3, a: f64, q: DVec3, b: f64) -> DVec3 {
    p * a + q * b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_has_the_same_points_from_both_ends() {
        let edge = PATCHES[0].map(|i| DVec3::from(POINTS[i as usize]))[..4].to_vec();
        let (forward, backward) = (
            [edge[0], edge[1], edge[2], edge[3]],
            [edge[3], edge[2], edge[1], edge[0]],
        );
        for n in 1..200 {
            for k in 0..=n {
                assert_eq!(
                    Bernstein::at(k, n).point(forward),
                    Bernstein::at(n - k, n).point(backward),
                    "{k}/{n}"
                );
            }
        }
    }
}
