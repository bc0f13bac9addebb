//! Reasons to doubt the winding of a mesh. A doubtful winding does not tell which side of a polygon
//! is the outside.

use super::edges::Edges;
use super::newell::{polygon_normal, unit_normal};
use super::orientation::inside_out;
use super::weld::weld;
use super::{GivenNormals, PolygonMesh};
use crate::number::split_mix::SplitMix;
use alloc::vec::Vec;
use glam::DVec3;

/// If the mean cosine between a polygon's normal and the normals of its corners is below this, they
/// contradict each other. Files write normals with four decimals or more, so a normal that is
/// perpendicular to the polygon's is off by at most 10⁻⁴.
const AGAINST: f64 = -1e-3;

/// Counts of the faults that make the winding of a mesh doubtful. All are 0 if it is sound.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct WindingDoubts {
    /// Edges of only one polygon, or only of copies of it.
    pub open_edges: usize,
    /// Edges of several polygons that more of them pass in one direction than in the other.
    pub uneven_edges: usize,
    /// Polygons whose winding contradicts the normals that came with the mesh.
    pub against_normals: usize,
    /// Closed surfaces that are wound inside out, if other surfaces are not.
    pub inside_out: usize,
    /// The polygons of these surfaces.
    pub inside_out_polygons: usize,
}

impl WindingDoubts {
    /// Looks for doubts about `mesh`. Positions that coincide exactly count as one, and all parts
    /// of the mesh together may close it.
    pub fn of(mesh: &PolygonMesh) -> WindingDoubts {
        let mut doubts = WindingDoubts::default();
        doubts.count_edges(mesh);
        if let Some(given) = mesh.given_normals() {
            let is_against = |p: &usize| is_against(mesh, given, *p, polygon_normal(mesh, *p));
            doubts.against_normals = (0..mesh.polygon_count()).filter(is_against).count();
        }
        // If the whole mesh is inside out, its winding is at least consistent.
        let inside_out = inside_out(mesh);
        if inside_out.polygons < mesh.polygon_count() {
            doubts.inside_out = inside_out.surfaces;
            doubts.inside_out_polygons = inside_out.polygons;
        }
        doubts
    }

    /// True if there is any doubt.
    pub fn any(&self) -> bool {
        *self != WindingDoubts::default()
    }

    fn count_edges(&mut self, mesh: &PolygonMesh) {
        let (vertex, count) = weld(mesh.positions());
        // Computed for all polygons at once, the first time that an edge needs them. One per edge
        // would take quadratic time, as one polygon may have all the edges.
        let mut prints = None;
        for uses in Edges::new(mesh, &vertex, count).iter() {
            let ascending = uses.iter().filter(|of| of.ascends).count();
            if 2 * ascending == uses.len() {
                continue;
            }
            // Copies of a polygon run along the edge in one direction, but so do neighbours that
            // are wound differently. The fingerprints tell them apart.
            let is_one_way = ascending == 0 || ascending == uses.len();
            let is_of_one = uses.len() == 1
                || is_one_way && {
                    let all = prints.get_or_insert_with(|| fingerprints(mesh, &vertex));
                    let print = |polygon: u32| all[polygon as usize];
                    uses.iter()
                        .all(|of| print(of.polygon) == print(uses[0].polygon))
                };
            if is_of_one {
                self.open_edges += 1;
            } else {
                self.uneven_edges += 1;
            }
        }
    }
}

/// Returns a fingerprint for each polygon. Polygons with equal corners, in any order, have equal
/// fingerprints; others agree with a probability of 2⁻⁶⁴. `vertex` holds the vertex of each
/// position.
fn fingerprints(mesh: &PolygonMesh, vertex: &[u32]) -> Vec<u64> {
    let print = |corner: &u32| SplitMix(vertex[*corner as usize].into()).next();
    let sum = |corners: &[u32]| corners.iter().map(print).fold(0, u64::wrapping_add);
    mesh.polygons().map(sum).collect()
}

/// True if the normals `given` for the corners of polygon `p` point away from `normal`, the
/// polygon's own.
pub(crate) fn is_against(
    mesh: &PolygonMesh,
    given: &GivenNormals,
    p: usize,
    normal: DVec3,
) -> bool {
    let Some(normal) = unit_normal(normal) else {
        return false;
    };
    let corners = given.corners.as_deref().unwrap_or(mesh.corners());
    let own = corners[mesh.corner_range(p)].iter();
    // A corner without a normal has a zero vector and adds nothing.
    let cosines = own.map(|&n| normal.dot(given.values[n as usize].as_dvec3()));
    cosines.sum::<f64>() < AGAINST * mesh.polygon(p).len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuilder;
    use crate::mesh::builtin::builtin;
    use alloc::vec;
    use glam::Vec3;

    /// Returns a cube without its first `without` polygons. Polygon `p` is reversed if
    /// `reversed(p)`.
    fn cube(reversed: impl Fn(usize) -> bool, without: usize) -> MeshBuilder {
        let mesh = builtin("cube").expect("a shape");
        let mut builder = MeshBuilder::new(mesh.positions().to_vec());
        for (p, polygon) in mesh.polygons().enumerate().skip(without) {
            let mut polygon = polygon.to_vec();
            if reversed(p) {
                polygon.reverse();
            }
            builder.polygon(&polygon);
        }
        builder
    }

    fn doubts(builder: MeshBuilder) -> WindingDoubts {
        WindingDoubts::of(&builder.finish().expect("a mesh"))
    }

    #[test]
    fn consistent_closed_surfaces_are_not_doubted_even_inside_out() {
        for spec in ["cube", "torus", "gear", "sphere?rings=6&segments=8"] {
            let mesh = builtin(spec).expect("a shape");
            assert!(!WindingDoubts::of(&mesh).any(), "{spec}");
        }
        assert!(!doubts(cube(|_| true, 0)).any());
        let nothing = MeshBuilder::new(Vec::new());
        assert!(!doubts(nothing).any());
    }

    #[test]
    fn open_edges_and_edges_passed_twice_in_one_direction_are_counted() {
        assert_eq!(doubts(cube(|_| false, 1)).open_edges, 4);
        let one = doubts(cube(|p| p == 2, 0));
        assert_eq!((one.open_edges, one.uneven_edges), (0, 4));
    }

    /// Comparing the polygons again at each of their edges would take minutes here.
    #[test]
    fn copies_of_a_polygon_of_many_corners_do_not_take_quadratic_time() {
        let count = 100_000;
        let corner = |k: u32| {
            let (sin, cos) = libm::sincos(f64::from(k) * core::f64::consts::TAU / f64::from(count));
            DVec3::new(cos, sin, 0.0).as_vec3()
        };
        let mut builder = MeshBuilder::new((0..count).map(corner).collect());
        let polygon: Vec<u32> = (0..count).collect();
        builder.polygon(&polygon).polygon(&polygon);
        let of = doubts(builder);
        assert_eq!((of.open_edges, of.uneven_edges), (count as usize, 0));
    }

    #[test]
    fn edges_of_a_polygon_and_its_copies_are_open() {
        let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::NEG_Y, Vec3::ZERO];
        let polygons = [[0, 1, 2], [1, 2, 4], [2, 0, 1]];
        for copies in 1..=3 {
            let mut builder = MeshBuilder::new(corners.clone());
            polygons[..copies].iter().for_each(|polygon| {
                builder.polygon(polygon);
            });
            let of = doubts(builder);
            assert_eq!((of.open_edges, of.uneven_edges), (3, 0), "{copies}");
        }
        // A neighbour that is wound differently runs along the common edge in the same direction.
        let mut builder = MeshBuilder::new(corners);
        builder.polygon(&[0, 1, 2]);
        builder.polygon(&[0, 1, 3]);
        let of = doubts(builder);
        assert_eq!((of.open_edges, of.uneven_edges), (4, 1));
    }

    #[test]
    fn a_sheet_with_a_polygon_for_each_side_is_closed() {
        let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
        let mut builder = MeshBuilder::new(corners);
        for polygon in [[0, 1, 2], [1, 3, 2]] {
            builder.polygon(&polygon);
            builder.polygon(&[polygon[0], polygon[2], polygon[1]]);
        }
        assert!(!doubts(builder).any());
    }

    #[test]
    fn polygons_against_their_own_normals_are_counted_and_normals_across_them_are_not() {
        for (sign, against) in [(1.0, 0), (-1.0, 6)] {
            let mut builder = cube(|_| false, 0);
            let positions = builtin("cube").expect("a shape").positions().to_vec();
            let outward = |p: &Vec3| sign * p.normalize();
            builder.normals(GivenNormals {
                values: positions.iter().map(outward).collect(),
                corners: None,
            });
            assert_eq!(doubts(builder).against_normals, against);
        }
        let mut builder = MeshBuilder::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y]);
        builder.polygon(&[0, 1, 2]);
        builder.normals(GivenNormals {
            values: vec![Vec3::new(1.0, 0.0, -1e-4).normalize(); 3],
            corners: None,
        });
        assert_eq!(doubts(builder).against_normals, 0);
    }

    #[test]
    fn one_surface_of_two_that_is_inside_out_is_a_doubt() {
        let mesh = builtin("cube").expect("a shape");
        let apart = mesh.positions().iter().map(|p| *p + 5.0 * Vec3::X);
        let positions = mesh.positions().iter().copied().chain(apart);
        let mut builder = MeshBuilder::new(positions.collect());
        for polygon in mesh.polygons() {
            builder.polygon(polygon);
            let there: Vec<u32> = polygon.iter().rev().map(|c| c + 8).collect();
            builder.polygon(&there);
        }
        let doubts = doubts(builder);
        assert_eq!((doubts.inside_out, doubts.inside_out_polygons), (1, 6));
    }
}
