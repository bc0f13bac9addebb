//! Vertex normals: averaged (L21 3.1), given, or averaged up to a crease.

use super::newell::{polygon_normals, unit_normal};
use super::vertex_sums::{Sum, sums};
use super::weld::weld;
use super::{GivenNormals, PolygonMesh};
use crate::number::parallel::collect;
use alloc::vec;
use alloc::vec::Vec;
use glam::{DVec3, Vec3};

/// The source of vertex normals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum NormalSource {
    /// The normalised sum of the unit normals of all polygons around a position (L21 3.1).
    #[default]
    Averaged,
    /// The normals that came with the mesh (by formula or from its file); averaged ones where it has none.
    Given,
    /// As averaged, but only over polygons whose normals differ from this one's by at most so many degrees.
    Crease(f64),
}

/// A unit normal for every corner of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexNormals {
    /// Unit vectors.
    pub values: Vec<Vec3>,
    /// The entry of `values` that each corner uses, in the order of [`PolygonMesh::corners`].
    pub corners: Vec<u32>,
}

/// The normal of a corner that no polygon gives one: toward the viewer of a mesh that was not turned.
const NO_NORMAL: DVec3 = DVec3::Z;

/// Returns the unit normals at all corners of `mesh`, in `f64` and rounded once.
///
/// Positions that coincide exactly are one vertex, whatever their indices. A polygon counts once at a vertex, even if it
/// passes it twice; a polygon without a normal does not count. Where the sum vanishes (a sheet with both its sides), each
/// corner has the normal of its own polygon, and (0, 0, 1) if that polygon has none.
///
/// [`NormalSource::Crease`] compares every pair of polygons around a vertex; the others take time in proportion to the
/// mesh.
pub fn vertex_normals(mesh: &PolygonMesh, source: NormalSource) -> VertexNormals {
    corner_normals(mesh, source, None).by_corner(mesh)
}

/// Returns the unit normals at all corners of a mesh, said as shortly as they can be.
pub(crate) enum CornerNormals {
    /// All corners at a position have the same one.
    ByPosition {
        /// Unit vectors.
        values: Vec<Vec3>,
        /// The entry of `values` that each position has.
        positions: Vec<u32>,
    },
    /// Corners at a position differ.
    ByCorner(VertexNormals),
}

impl CornerNormals {
    /// Returns the normals corner by corner.
    pub fn by_corner(self, mesh: &PolygonMesh) -> VertexNormals {
        match self {
            CornerNormals::ByCorner(normals) => normals,
            CornerNormals::ByPosition { values, positions } => VertexNormals {
                values,
                corners: corners_of(mesh, &positions),
            },
        }
    }
}

/// Returns the entry of `positions` that each corner of `mesh` uses.
fn corners_of(mesh: &PolygonMesh, positions: &[u32]) -> Vec<u32> {
    mesh.corners()
        .iter()
        .map(|&c| positions[c as usize])
        .collect()
}

/// Computes [`vertex_normals`], from the normals of all polygons where these are known already.
pub(crate) fn corner_normals(
    mesh: &PolygonMesh,
    source: NormalSource,
    polygons: Option<&[DVec3]>,
) -> CornerNormals {
    let own;
    let polygons = match (source, mesh.given_normals(), polygons) {
        (_, _, Some(normals)) => normals,
        // Needed only where the mesh leaves something out.
        (NormalSource::Given, Some(given), None) if !given.values.contains(&Vec3::ZERO) => &[],
        _ => {
            own = polygon_normals(mesh);
            &own
        }
    };
    match (source, mesh.given_normals()) {
        (NormalSource::Given, Some(given)) => from_given(mesh, given, polygons),
        (NormalSource::Crease(degrees), _) => {
            CornerNormals::ByCorner(creased(mesh, degrees, polygons))
        }
        _ => averaged(mesh, polygons),
    }
}

/// Returns the direction of a sum of `count` unit normals; `None` where the sum vanishes.
///
/// A unit normal is off by at most 4ε (two roundings of its components, the root and the division) and each addition by
/// at most ε times the partial sum, so a sum that vanishes exactly stays below `count · (4 + count) · ε`.
fn direction(sum: DVec3, count: u32) -> Option<DVec3> {
    let count = count as f64;
    let length = libm::sqrt(sum.length_squared());
    (length > count * (4.0 + count) * f64::EPSILON).then(|| sum / length)
}

fn averaged(mesh: &PolygonMesh, polygons: &[DVec3]) -> CornerNormals {
    let (vertex, count) = weld(mesh.positions());
    let sums = sums(mesh, polygons, &vertex, count);
    let mut values = collect(count, 4096, |v| {
        direction(sums[v].normal, sums[v].count)
            .unwrap_or(NO_NORMAL)
            .as_vec3()
    }); // 3.1
    // A vertex without any summand has only corners of polygons without a normal, which have none of their own to take.
    let vanishes = |sum: &Sum| sum.count > 0 && direction(sum.normal, sum.count).is_none();
    let vanishes = collect(count, 4096, |v| vanishes(&sums[v]));
    drop(sums);
    if !vanishes.contains(&true) {
        return CornerNormals::ByPosition {
            values,
            positions: vertex,
        };
    }
    let mut corners = corners_of(mesh, &vertex);
    for p in 0..mesh.polygon_count() {
        let mut own = None;
        for corner in &mut corners[mesh.corner_range(p)] {
            if vanishes[*corner as usize] {
                *corner = *own.get_or_insert_with(|| {
                    values.push(unit_normal(polygons[p]).unwrap_or(NO_NORMAL).as_vec3());
                    values.len() as u32 - 1
                });
            }
        }
    }
    CornerNormals::ByCorner(VertexNormals { values, corners })
}

fn from_given(mesh: &PolygonMesh, given: &GivenNormals, polygons: &[DVec3]) -> CornerNormals {
    let corners = given.corners.as_deref().unwrap_or(mesh.corners());
    let missing = |n: u32| given.values[n as usize] == Vec3::ZERO;
    let mut values: Vec<Vec3> = given
        .values
        .iter()
        .map(|n| unit_normal(n.as_dvec3()).unwrap_or(NO_NORMAL).as_vec3())
        .collect();
    let is_any_missing = corners.iter().any(|&n| missing(n));
    if given.corners.is_none() && !is_any_missing {
        return CornerNormals::ByPosition {
            values,
            positions: (0..mesh.positions().len() as u32).collect(),
        };
    }
    let mut corners = corners.to_vec();
    if is_any_missing {
        let fallback = averaged(mesh, polygons).by_corner(mesh);
        let offset = values.len() as u32;
        values.extend_from_slice(&fallback.values);
        for (corner, &other) in corners.iter_mut().zip(&fallback.corners) {
            if missing(*corner) {
                *corner = offset + other;
            }
        }
    }
    CornerNormals::ByCorner(VertexNormals { values, corners })
}

/// The corners around each vertex: those of vertex `v` are `items[starts[v]..starts[v + 1]]`.
struct Fans {
    starts: Vec<u32>,
    /// A corner, and the polygon that it belongs to.
    items: Vec<(u32, u32)>,
}

impl Fans {
    fn new(mesh: &PolygonMesh, vertex: &[u32], count: usize) -> Self {
        let mut starts = vec![0u32; count + 1];
        for &corner in mesh.corners() {
            starts[vertex[corner as usize] as usize + 1] += 1;
        }
        for v in 0..count {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut items = vec![(0, 0); mesh.corners().len()];
        for p in 0..mesh.polygon_count() {
            for k in mesh.corner_range(p) {
                let slot = &mut next[vertex[mesh.corners()[k] as usize] as usize];
                items[*slot as usize] = (k as u32, p as u32);
                *slot += 1;
            }
        }
        Fans { starts, items }
    }

    fn of(&self, v: usize) -> &[(u32, u32)] {
        &self.items[self.starts[v] as usize..self.starts[v + 1] as usize]
    }
}

fn creased(mesh: &PolygonMesh, degrees: f64, polygons: &[DVec3]) -> VertexNormals {
    // A dot product of unit normals that are off by 4ε each is off by less than 16ε: a crease of exactly the angle of an
    // edge does not break it.
    let least_cosine = libm::cos(degrees.clamp(0.0, 180.0).to_radians()) - 16.0 * f64::EPSILON;
    let (vertex, count) = weld(mesh.positions());
    let normals: Vec<Option<DVec3>> = polygons.iter().map(|&normal| unit_normal(normal)).collect();
    let fans = Fans::new(mesh, &vertex, count);
    let mut values: Vec<Vec3> = Vec::with_capacity(count);
    let mut corners = vec![0u32; mesh.corners().len()];
    let mut around = Vec::new();
    for v in 0..count {
        let fan = fans.of(v);
        // The corners of one polygon stand next to each other, so that one that passes twice is counted once.
        around.clear();
        around.extend(fan.iter().map(|&(_, p)| p));
        around.dedup();
        let first = values.len();
        for &(corner, p) in fan {
            let own = normals[p as usize];
            let (mut sum, mut counted) = (DVec3::ZERO, 0);
            for normal in around.iter().filter_map(|&q| normals[q as usize]) {
                if own.is_none_or(|own| own.dot(normal) >= least_cosine) {
                    sum += normal; // 3.1
                    counted += 1;
                }
            }
            let value = direction(sum, counted)
                .or(own)
                .unwrap_or(NO_NORMAL)
                .as_vec3();
            let shared = values[first..].iter().position(|&other| other == value);
            corners[corner as usize] = (first + shared.unwrap_or(values.len() - first)) as u32;
            if shared.is_none() {
                values.push(value);
            }
        }
    }
    VertexNormals { values, corners }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuilder;
    use crate::mesh::newell::polygon_normal;

    /// The cube from −1 to 1, six quads, outward.
    fn cube() -> PolygonMesh {
        let positions = (0..8)
            .map(|i| Vec3::new(sign(i & 1), sign(i >> 1 & 1), sign(i >> 2 & 1)))
            .collect();
        let mut builder = MeshBuilder::new(positions);
        for face in [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ] {
            builder.polygon(&face);
        }
        builder.finish().expect("a cube")
    }

    fn sign(bit: u32) -> f32 {
        if bit == 1 { 1.0 } else { -1.0 }
    }

    fn at(normals: &VertexNormals, corner: usize) -> Vec3 {
        normals.values[normals.corners[corner] as usize]
    }

    fn face_normal(mesh: &PolygonMesh, p: usize) -> Vec3 {
        unit_normal(polygon_normal(mesh, p))
            .expect("a normal")
            .as_vec3()
    }

    #[test]
    fn a_cube_averages_to_its_diagonals() {
        let mesh = cube();
        let normals = vertex_normals(&mesh, NormalSource::Averaged);
        assert_eq!(normals.values.len(), 8);
        for (k, &corner) in mesh.corners().iter().enumerate() {
            let diagonal = mesh.positions()[corner as usize].as_dvec3() / libm::sqrt(3.0);
            assert_eq!(at(&normals, k), diagonal.as_vec3());
        }
    }

    #[test]
    fn a_crease_separates_the_faces_of_a_cube() {
        let mesh = cube();
        let normals = vertex_normals(&mesh, NormalSource::Crease(30.0));
        assert_eq!(normals.values.len(), 24);
        for p in 0..6 {
            for k in mesh.corner_range(p) {
                assert_eq!(at(&normals, k), face_normal(&mesh, p));
            }
        }
        // At exactly the angle of its edges the cube is smooth, and each vertex has one value.
        let smooth = vertex_normals(&mesh, NormalSource::Crease(90.0));
        assert_eq!(smooth.values.len(), 8);
        let averaged = vertex_normals(&mesh, NormalSource::Averaged);
        (0..24).for_each(|k| assert_eq!(at(&smooth, k), at(&averaged, k)));
        assert_eq!(
            vertex_normals(&mesh, NormalSource::Crease(89.999))
                .values
                .len(),
            24
        );
    }

    #[test]
    fn a_sheet_with_two_sides_keeps_both() {
        let positions = vec![
            Vec3::ZERO,
            Vec3::new(0.9, 0.1, 0.2),
            Vec3::new(0.3, 0.7, -0.4),
        ];
        let mut builder = MeshBuilder::new(positions);
        builder.polygon(&[0, 1, 2]).polygon(&[0, 2, 1]);
        let mesh = builder.finish().expect("a sheet");
        for source in [
            NormalSource::Averaged,
            NormalSource::Crease(180.0),
            NormalSource::Crease(60.0),
        ] {
            let normals = vertex_normals(&mesh, source);
            for k in 0..6 {
                assert_eq!(at(&normals, k), face_normal(&mesh, k / 3), "{source:?}");
            }
        }
    }

    #[test]
    fn a_seam_is_welded() {
        // Two walls of a right angle that repeat the positions of their common edge, one of them with −0.
        let p = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
        let positions = vec![
            p(0.0, 0.0, 0.0),
            p(1.0, 0.0, 0.0),
            p(1.0, 1.0, 0.0),
            p(0.0, 1.0, 0.0),
            p(0.0, 0.0, 1.0),
            p(0.0, 0.0, -0.0),
            p(-0.0, 1.0, 0.0),
            p(0.0, 1.0, 1.0),
        ];
        let mut builder = MeshBuilder::new(positions);
        builder.polygon(&[0, 1, 2, 3]).polygon(&[5, 6, 7, 4]);
        let mesh = builder.finish().expect("two walls");
        let normals = vertex_normals(&mesh, NormalSource::Averaged);
        let edge = DVec3::new(1.0, 0.0, 1.0).normalize().as_vec3();
        for k in [0, 3, 4, 5] {
            assert_eq!(at(&normals, k), edge);
        }
        assert_eq!(normals.corners[0], normals.corners[4]);
        assert_eq!(at(&normals, 1), Vec3::Z);
        assert_eq!(at(&normals, 6), Vec3::X);
    }

    #[test]
    fn a_polygon_without_a_normal_does_not_count_but_takes_the_average() {
        let positions = vec![
            Vec3::ZERO,
            Vec3::X,
            Vec3::Y,
            Vec3::new(2.0, 0.0, 0.0),
            Vec3::new(0.0, 0.0, 9.0),
        ];
        let mut builder = MeshBuilder::new(positions);
        builder
            .polygon(&[0, 1, 2])
            .polygon(&[0, 1, 3])
            .polygon(&[4, 4, 4]);
        let mesh = builder.finish().expect("triangles");
        for source in [
            NormalSource::Averaged,
            NormalSource::Given,
            NormalSource::Crease(10.0),
        ] {
            let normals = vertex_normals(&mesh, source);
            for k in 0..9 {
                assert_eq!(at(&normals, k), Vec3::Z, "{source:?} {k}");
            }
        }
    }

    #[test]
    fn a_polygon_that_passes_a_position_twice_counts_once() {
        // A triangle upward, and a bow tie of two equal lobes to the side whose waist is the triangle's first corner.
        let positions = vec![
            Vec3::ZERO,
            Vec3::X,
            Vec3::Y,
            Vec3::new(0.0, 1.0, 1.0),
            Vec3::new(0.0, -1.0, 1.0),
            Vec3::new(0.0, -1.0, -1.0),
            Vec3::new(0.0, 1.0, -1.0),
        ];
        let mut builder = MeshBuilder::new(positions);
        builder.polygon(&[0, 1, 2]).polygon(&[0, 3, 4, 0, 5, 6]);
        let mesh = builder.finish().expect("triangle and bow tie");
        assert_eq!(face_normal(&mesh, 1), Vec3::X);
        let half = DVec3::new(1.0, 0.0, 1.0).normalize().as_vec3();
        for source in [NormalSource::Averaged, NormalSource::Crease(120.0)] {
            assert_eq!(at(&vertex_normals(&mesh, source), 0), half);
        }
    }

    #[test]
    fn given_normals_are_normalised_and_completed() {
        let mut builder = MeshBuilder::new(vec![Vec3::ZERO, Vec3::Y, Vec3::Z]);
        builder.polygon(&[0, 1, 2]);
        builder.normals(GivenNormals {
            values: vec![Vec3::new(0.0, 3.0, 4.0), Vec3::ZERO, -Vec3::X],
            corners: None,
        });
        let mesh = builder.finish().expect("a triangle");
        let normals = vertex_normals(&mesh, NormalSource::Given);
        // The zero at the second corner is replaced by the average, the triangle's own normal.
        assert_eq!(
            [0, 1, 2].map(|k| at(&normals, k)),
            [Vec3::new(0.0, 0.6, 0.8), Vec3::X, -Vec3::X]
        );

        let mut builder = MeshBuilder::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y]);
        builder.polygon(&[0, 1, 2]);
        builder.normals(GivenNormals {
            values: vec![Vec3::Y, Vec3::X],
            corners: Some(vec![1, 0, 1]),
        });
        let mesh = builder.finish().expect("a triangle");
        let normals = vertex_normals(&mesh, NormalSource::Given);
        assert_eq!(
            [0, 1, 2].map(|k| at(&normals, k)),
            [Vec3::X, Vec3::Y, Vec3::X]
        );
    }
}
