//! Polygon normals by Newell's formula (L21 1.1), and how to tell that a polygon has none.

use super::PolygonMesh;
use crate::number::parallel::collect;
use alloc::vec::Vec;
use glam::{DVec3, Vec3};

/// Returns the normal of a polygon by Newell's formula in `f64`, with the first corner as origin.
///
/// ```text
/// N = Σ (P_k − P_0) × (P_{k+1} − P_0)      (L21 1.1),   |N| = 2 · area
/// ```
///
/// In exact arithmetic the sum does not depend on the origin. With a corner as origin it does not
/// cancel for polygons far from 0. Collinear corners add nothing. The result is zero if the polygon
/// has no normal: it has fewer than three corners, all corners are collinear, or the areas of its
/// lobes cancel. Rounded corners may leave a small remainder instead of zero; [`polygon_normal`]
/// bounds it.
#[inline]
pub fn newell(corners: impl IntoIterator<Item = DVec3>) -> DVec3 {
    let mut corners = corners.into_iter();
    let Some(origin) = corners.next() else {
        return DVec3::ZERO;
    };
    let mut previous = DVec3::ZERO;
    let mut normal = DVec3::ZERO;
    for corner in corners {
        let current = corner - origin;
        normal += previous.cross(current); // 1.1
        previous = current;
    }
    normal
}

/// Returns the normal of polygon `p` by Newell's formula. Its length is twice the area; it is zero
/// if the polygon has no normal.
///
/// A polygon has a normal only if the sum is too large to be the result of rounding the corners to
/// `f32`. Moving each corner by at most `δ` along each axis (half an `f32` step of the largest
/// coordinate) changes (L21 1.1) by `Σ δ_k × (P_{k+1} − P_{k−1})` to first order. Along x that is
/// at most
///
/// ```text
/// δ_y Σ |z_{k+1} − z_{k−1}| + δ_z Σ |y_{k+1} − y_{k−1}|
/// ```
///
/// and y and z have bounds of the same form. Collinear points may leave a sum up to that bound, so
/// it counts as zero. The rounding of the sum itself in `f64` is smaller, 2⁻⁵³ against 2⁻²⁵, for
/// any polygon below 2²⁶ corners.
pub fn polygon_normal(mesh: &PolygonMesh, p: usize) -> DVec3 {
    let corners = mesh.polygon(p);
    match <&[u32; 3]>::try_from(corners) {
        // With a constant corner count the compiler unrolls the loop.
        Ok(triangle) => normal_of(mesh.positions(), triangle),
        Err(_) => normal_of(mesh.positions(), corners),
    }
}

#[inline(always)]
fn normal_of(positions: &[Vec3], corners: &[u32]) -> DVec3 {
    let normal = newell(corners.iter().map(|&c| positions[c as usize].as_dvec3()));
    let bound = input_rounding(positions, corners);
    // The comparison is false for a NaN, so that a NaN in the sum or the bound means no normal.
    if normal.length_squared() > bound.length_squared() {
        normal
    } else {
        DVec3::ZERO
    }
}

/// True if polygon `p`, which has no normal, crosses itself and has lobes whose areas cancel; false
/// if it has no area at all.
///
/// A path that goes back along itself encloses nothing, so those corners are removed first. The
/// rest has an area unless all of it lies on one line. To find out, the function measures the
/// triangles between the first corner, the corner farthest from it, and each other corner. Rounding
/// moves each of the two differences by at most 2δ along each axis, with δ as in
/// [`polygon_normal`]. The cross product of two differences up to D long is then off by at most 2 ·
/// 2 √3 δ D, which is below 8 δ D.
pub fn areas_cancel(mesh: &PolygonMesh, p: usize) -> bool {
    // A stack: a corner that equals the one before last undoes the last step.
    let mut path: Vec<DVec3> = Vec::new();
    for &corner in mesh.polygon(p) {
        let here = mesh.positions()[corner as usize].as_dvec3();
        match path[..] {
            [.., last] if last == here => (),
            [.., before, _] if before == here => _ = path.pop(),
            _ => path.push(here),
        }
    }
    // The path is closed, so its end may also go back along its beginning. Those steps are undone
    // here.
    let mut path = &path[..];
    while let [first, inner @ .., last] = path
        && (first == last || inner.last() == Some(first) || inner.first() == Some(last))
    {
        path = if first == last || inner.last() == Some(first) {
            &path[..path.len() - 1]
        } else {
            &path[1..]
        };
    }
    let Some(&first) = path.first() else {
        return false;
    };
    let largest = path.iter().fold(DVec3::ZERO, |most, p| most.max(p.abs()));
    let far = path.iter().map(|p| *p - first).fold(DVec3::ZERO, |far, d| {
        if d.length_squared() > far.length_squared() {
            d
        } else {
            far
        }
    });
    let area = path
        .iter()
        .map(|p| (*p - first).cross(far).length_squared());
    let bound = 8.0 * half_step(largest.max_element() as f32) * libm::sqrt(far.length_squared());
    area.fold(0.0, f64::max) > bound * bound
}

/// Returns the normals of all polygons of a mesh: see [`polygon_normal`].
pub fn polygon_normals(mesh: &PolygonMesh) -> Vec<DVec3> {
    collect(mesh.polygon_count(), 4096, |p| polygon_normal(mesh, p))
}

/// Returns the unit vector along `normal`; `None` if it is zero or not finite.
///
/// Cross products of `f32` vectors, and of their differences, are between 1e-90 and 1e77 long.
/// Their squares neither underflow nor overflow.
pub fn unit_normal(normal: DVec3) -> Option<DVec3> {
    let square = normal.length_squared();
    (square > 0.0 && square < f64::INFINITY).then(|| normal / libm::sqrt(square))
}

/// Returns a bound, along each axis, on the error of Newell's sum that comes from rounding every
/// corner to `f32`.
#[inline(always)]
fn input_rounding(positions: &[Vec3], corners: &[u32]) -> DVec3 {
    let corner = |k: usize| positions[corners[k] as usize];
    let (Some(last), true) = (corners.len().checked_sub(1), corners.len() >= 3) else {
        return DVec3::ZERO;
    };
    let mut largest = Vec3::ZERO;
    let mut spread = DVec3::ZERO;
    let (mut before, mut here) = (corner(last), corner(0));
    for k in 0..corners.len() {
        let after = corner(if k == last { 0 } else { k + 1 });
        largest = largest.max(here.abs());
        spread += (after.as_dvec3() - before.as_dvec3()).abs();
        (before, here) = (here, after);
    }
    let delta = DVec3::new(
        half_step(largest.x),
        half_step(largest.y),
        half_step(largest.z),
    );
    DVec3::new(
        delta.y * spread.z + delta.z * spread.y,
        delta.z * spread.x + delta.x * spread.z,
        delta.x * spread.y + delta.y * spread.x,
    )
}

/// Returns half the distance between neighbouring `f32` values around `x`: rounding to nearest
/// moves it by no more.
fn half_step(x: f32) -> f64 {
    const EXPONENT: u32 = 0x7f80_0000;
    const HALF_STEP_OF_ONE: f64 = 1.0 / (1u32 << 24) as f64;
    // Clearing the sign and the fraction leaves the power of two at or below |x|. Zero and
    // subnormals become zero; their step is far below everything else.
    f32::from_bits(x.to_bits() & EXPONENT) as f64 * HALF_STEP_OF_ONE
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuilder;

    fn mesh_of(points: &[Vec3]) -> PolygonMesh {
        let mut builder = MeshBuilder::new(points.to_vec());
        builder.polygon(&(0..points.len() as u32).collect::<Vec<_>>());
        builder.finish().expect("a polygon")
    }

    fn normal_of(points: &[[f32; 3]]) -> DVec3 {
        let points: Vec<Vec3> = points.iter().map(|&p| Vec3::from(p)).collect();
        polygon_normal(&mesh_of(&points), 0)
    }

    const SQUARE: [[f32; 3]; 4] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];

    #[test]
    fn length_is_twice_the_area_from_any_first_corner_and_either_side() {
        for first in 0..4 {
            let mut square = SQUARE;
            square.rotate_left(first);
            assert_eq!(normal_of(&square), DVec3::new(0.0, 0.0, 2.0));
            square.reverse();
            assert_eq!(normal_of(&square), DVec3::new(0.0, 0.0, -2.0));
        }
        let upright = SQUARE.map(|[x, y, z]| [z, x, y]);
        assert_eq!(normal_of(&upright), DVec3::new(2.0, 0.0, 0.0));
    }

    #[test]
    fn nothing_is_lost_far_from_the_origin() {
        // Integers below 2^24 are exact in f32, so their differences and this sum are exact too.
        let far = SQUARE.map(|[x, y, z]| [x + 1e6, y - 1e6, z + 1e6]);
        assert_eq!(normal_of(&far), DVec3::new(0.0, 0.0, 2.0));
    }

    #[test]
    fn concave_polygons_have_their_area() {
        // An L of three unit squares: its first three corners turn the wrong way at the notch.
        let l = [
            [1.0, 1.0, 0.0],
            [1.0, 2.0, 0.0],
            [0.0, 2.0, 0.0],
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [2.0, 1.0, 0.0],
        ];
        assert_eq!(normal_of(&l), DVec3::new(0.0, 0.0, 6.0));
        // The lecture warns of taking two adjacent edges: at the notch their cross product points
        // to the other side.
        let notch: Vec<DVec3> = [5, 0, 1]
            .iter()
            .map(|&k: &usize| Vec3::from(l[k]).as_dvec3())
            .collect();
        assert!((notch[1] - notch[0]).cross(notch[2] - notch[1]).z < 0.0);
    }

    #[test]
    fn collinear_neighbours_do_not_matter() {
        // The first two edges are parallel. Their cross product is zero, while Newell's formula
        // still sees the square.
        let mut points = SQUARE.to_vec();
        points.insert(1, [0.5, 0.0, 0.0]);
        assert_eq!(normal_of(&points), DVec3::new(0.0, 0.0, 2.0));
        let [a, b, c] = [0, 1, 2].map(|k| Vec3::from(points[k]).as_dvec3());
        assert_eq!((b - a).cross(c - b), DVec3::ZERO);
    }

    #[test]
    fn polygons_without_a_normal_give_zero() {
        assert_eq!(newell([]), DVec3::ZERO);
        assert_eq!(newell([DVec3::ONE, DVec3::X]), DVec3::ZERO);
        let zero: [&[[f32; 3]]; 5] = [
            &[[1.0, 2.0, 3.0]; 3],
            &[[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]],
            &[
                [0.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
            ],
            &[
                [0.0, 0.0, 0.0],
                [1.0, 1.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
            ],
            &[
                [1.0, 0.0, 0.0],
                [1.0, 5.0, 0.0],
                [1.0, 7.0, 0.0],
                [1.0, 5.0, 0.0],
            ],
        ];
        for points in zero {
            assert_eq!(normal_of(points), DVec3::ZERO, "{points:?}");
        }
    }

    #[test]
    fn collinear_points_with_rounded_coordinates_have_no_normal() {
        // In exact arithmetic these points lie on one line. Their f32 coordinates do not, so
        // Newell's sum is not zero.
        let mut with_remainder = 0;
        for step in 1..200 {
            let along = DVec3::new(1.0 / 3.0, 2.0 / 7.0, -1.0 / 11.0) * step as f64;
            let start = DVec3::new(1e4 + 1.0 / 3.0, -2e3 / 7.0, 5e4 / 9.0);
            let points: Vec<Vec3> = [0.0, 1.0, 1.7, 0.4]
                .iter()
                .map(|&t| (start + along * t).as_vec3())
                .collect();
            with_remainder +=
                usize::from(newell(points.iter().map(|p| p.as_dvec3())) != DVec3::ZERO);
            assert_eq!(
                polygon_normal(&mesh_of(&points), 0),
                DVec3::ZERO,
                "step {step}"
            );
        }
        assert!(
            with_remainder > 100,
            "the test asks nothing: only {with_remainder} sums are not zero"
        );
    }

    #[test]
    fn cancelling_lobes_differ_from_polygons_without_area() {
        let cancels = |points: &[[f32; 3]]| {
            let points: Vec<Vec3> = points.iter().map(|&p| Vec3::from(p)).collect();
            let mesh = mesh_of(&points);
            assert_eq!(polygon_normal(&mesh, 0), DVec3::ZERO, "{points:?}");
            areas_cancel(&mesh, 0)
        };
        let [a, b, c, d] = SQUARE;
        let third = [1.0 / 3.0, 0.0, 0.0];
        for first in 0..4 {
            let mut bow_tie = [a, c, b, d];
            bow_tie.rotate_left(first);
            assert!(cancels(&bow_tie));
            assert!(cancels(&bow_tie.map(|[x, y, z]| [x + 1e3, y - 1e3, z])));
            // Out and back along itself, starting from every corner.
            for path in [[a, b, c, b], [a, b, a, c], [a, b, a, b]] {
                let mut path = path;
                path.rotate_left(first);
                assert!(!cancels(&path), "{path:?}");
            }
        }
        assert!(!cancels(&[a, b, c, d, c, b]));
        // A tree of branches; the path starts in the middle of each.
        let e = [2.0, 2.0, 0.0];
        for first in 0..8 {
            let mut tree = [a, b, c, b, a, d, e, d];
            tree.rotate_left(first);
            assert!(!cancels(&tree), "{first}");
        }
        assert!(!cancels(&[a, a, a, a]));
        assert!(!cancels(&[a, third, b]));
    }

    #[test]
    fn unit_normals() {
        assert_eq!(unit_normal(DVec3::ZERO), None);
        assert_eq!(unit_normal(DVec3::NAN), None);
        assert_eq!(unit_normal(DVec3::new(0.0, -3.0, 0.0)), Some(-DVec3::Y));
        assert_eq!(unit_normal(DVec3::new(0.0, 0.0, 1e-90)), Some(DVec3::Z));
        assert_eq!(unit_normal(DVec3::new(1e77, 0.0, 0.0)), Some(DVec3::X));
    }
}
