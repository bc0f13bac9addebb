//! The edges of a mesh and the polygons along each.

use super::PolygonMesh;
use super::newell::{polygon_normals, unit_normal};
use super::weld::weld;
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

/// One polygon's use of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct EdgeUse {
    /// The two vertices of the edge, the lower index first.
    pub ends: [u32; 2],
    /// True if the polygon runs from the lower index to the higher one.
    pub ascends: bool,
    /// The polygon.
    pub polygon: u32,
}

/// All edges of a mesh, between the vertices that [`weld`](super::weld::weld) finds.
pub struct Edges {
    /// Sorted, so that the uses of each edge stand side by side.
    uses: Vec<EdgeUse>,
}

impl Edges {
    /// Collects the edges of `mesh`. `vertex` holds the index of each position's vertex, of which
    /// there are `count`. This takes two passes over the corners, and sorts the few edges at each
    /// vertex.
    pub fn new(mesh: &PolygonMesh, vertex: &[u32], count: usize) -> Edges {
        let of_polygon = |polygon: usize, corners: &[u32], each: &mut dyn FnMut(EdgeUse)| {
            for (i, &from) in corners.iter().enumerate() {
                let to = corners[(i + 1) % corners.len()];
                let (from, to) = (vertex[from as usize], vertex[to as usize]);
                if from != to {
                    each(EdgeUse {
                        ends: [from.min(to), from.max(to)],
                        ascends: from < to,
                        polygon: polygon as u32,
                    });
                }
            }
        };
        let all = |each: &mut dyn FnMut(EdgeUse)| {
            for (polygon, corners) in mesh.polygons().enumerate() {
                of_polygon(polygon, corners, each);
            }
        };
        // A counting sort by the lower end, then a comparison sort within each vertex. `starts`
        // first counts, then becomes prefix sums.
        let mut starts = vec![0u32; count + 1];
        all(&mut |edge| starts[edge.ends[0] as usize + 1] += 1);
        for i in 0..count {
            starts[i + 1] += starts[i];
        }
        let nothing = EdgeUse {
            ends: [0; 2],
            ascends: false,
            polygon: 0,
        };
        let mut uses = vec![nothing; starts[count] as usize];
        let mut next = starts.clone();
        all(&mut |edge| {
            let place = &mut next[edge.ends[0] as usize];
            uses[*place as usize] = edge;
            *place += 1;
        });
        for range in starts.windows(2) {
            uses[range[0] as usize..range[1] as usize].sort_unstable();
        }
        Edges { uses }
    }

    /// Returns the edges one by one. Each item holds all uses of one edge.
    pub fn iter(&self) -> impl Iterator<Item = &[EdgeUse]> {
        self.uses.chunk_by(|a, b| a.ends == b.ends)
    }
}

/// Counts of edges where a mesh may not look as its author meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EdgeCounts {
    /// Edges within one part whose two polygons meet at more than the requested angle.
    pub sharp: usize,
    /// Edges between two parts whose polygons meet at no more than that angle. Edges that smoothing
    /// groups separate as well do not count.
    pub seams: usize,
    /// Edges of only one polygon that would have two if nearby positions were one.
    pub closing: usize,
}

impl EdgeCounts {
    /// Counts the edges of `mesh`. `degrees` is the angle that tells sharp edges, and positions
    /// closer than `part` of the mesh's size count as one for closing edges.
    pub fn of(mesh: &PolygonMesh, degrees: f64, part: f64) -> EdgeCounts {
        let (vertex, count) = weld(mesh.positions());
        let edges = Edges::new(mesh, &vertex, count);
        let normals = polygon_normals(mesh);
        let cosine = libm::cos(degrees.to_radians());
        let mut counts = EdgeCounts::default();
        let mut open = Vec::new();
        for uses in edges.iter() {
            match uses {
                [one] => open.push(*one),
                [a, b] if a.ascends != b.ascends => {
                    let [p, q] = [a, b].map(|of| of.polygon as usize);
                    let units = [p, q].map(|p| unit_normal(normals[p]));
                    let [Some(n), Some(m)] = units else {
                        continue;
                    };
                    let is_sharp = n.dot(m) < cosine;
                    let groups = [p, q].map(|p| mesh.smoothing_group(p));
                    let is_smooth =
                        groups[0] == groups[1] && groups[0] != Some(PolygonMesh::FACETED);
                    if mesh.part(p) == mesh.part(q) {
                        counts.sharp += usize::from(is_sharp);
                    } else {
                        counts.seams += usize::from(!is_sharp && is_smooth);
                    }
                }
                _ => {}
            }
        }
        counts.closing = closing(mesh, &vertex, &open, part);
        counts
    }
}

/// Counts the `open` edges that close if positions closer than `part` of the mesh's size count as
/// one.
fn closing(mesh: &PolygonMesh, vertex: &[u32], open: &[EdgeUse], part: f64) -> usize {
    if open.len() < 2 {
        return 0;
    }
    // The vertices with an open edge, in ascending order, and a position of each.
    let mut ends: Vec<u32> = open.iter().flat_map(|edge| edge.ends).collect();
    ends.sort_unstable();
    ends.dedup();
    let mut positions = vec![DVec3::ZERO; ends.len()];
    for (position, vertex) in mesh.positions().iter().zip(vertex) {
        if let Ok(place) = ends.binary_search(vertex) {
            positions[place] = position.as_dvec3();
        }
    }
    let near = super::weld::weld_near(&positions, part * super::weld::size(mesh));
    let place = |vertex: u32| ends.binary_search(&vertex).map_or(0, |place| near[place]);
    let mut moved: Vec<([u32; 2], bool)> = open
        .iter()
        .map(|edge| {
            let [a, b] = edge.ends.map(place);
            ([a.min(b), a.max(b)], edge.ascends == (a < b))
        })
        .filter(|([a, b], _)| a != b)
        .collect();
    moved.sort_unstable();
    let groups = moved.chunk_by(|a, b| a.0 == b.0);
    groups
        .filter(|group| matches!(group, [(_, false), (_, true)]))
        .count()
        * 2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuilder;
    use crate::mesh::builtin::builtin;
    use glam::Vec3;

    /// Returns the faces of a cube, each with its own corners. Every second face is moved by `by`
    /// along x.
    fn loose_cube(by: f32) -> PolygonMesh {
        let cube = builtin("cube").expect("a shape");
        let mut positions = Vec::new();
        let mut builder_polygons = Vec::new();
        for (p, polygon) in cube.polygons().enumerate() {
            let first = positions.len() as u32;
            let moved = Vec3::X * by * (p % 2) as f32;
            positions.extend(
                polygon
                    .iter()
                    .map(|&c| cube.positions()[c as usize] + moved),
            );
            builder_polygons.push([first, first + 1, first + 2, first + 3]);
        }
        let mut builder = MeshBuilder::new(positions);
        builder_polygons.iter().for_each(|polygon| {
            builder.polygon(polygon);
        });
        builder.parts(alloc::vec![0; 6]);
        builder.finish().expect("a mesh")
    }

    #[test]
    fn each_edge_of_a_cube_has_two_polygons_that_run_along_it_both_ways() {
        let mesh = loose_cube(0.0);
        let (vertex, count) = weld(mesh.positions());
        let edges = Edges::new(&mesh, &vertex, count);
        assert_eq!(edges.iter().count(), 12);
        assert!(
            edges
                .iter()
                .all(|uses| uses.len() == 2 && uses[0].ascends != uses[1].ascends)
        );
    }

    #[test]
    fn edges_that_rounding_keeps_open_would_close() {
        let counts = |by| EdgeCounts::of(&loose_cube(by), 40.0, 1e-6);
        assert_eq!(
            counts(0.0),
            EdgeCounts {
                sharp: 12,
                seams: 0,
                closing: 0
            }
        );
        // The sides of the cube are 2 long, so positions up to 2e-6 apart count as one; 5e-7 is a
        // fourth of that.
        let apart = counts(5e-7);
        assert!(apart.closing > 0 && apart.sharp < 12, "{apart:?}");
        assert_eq!(apart.closing + 2 * apart.sharp, 24, "{apart:?}");
        assert_eq!(counts(1e-3).closing, 0);
    }

    #[test]
    fn a_part_that_ends_on_a_smooth_surface_makes_a_seam() {
        let sphere = builtin("sphere?rings=16&segments=32").expect("a shape");
        let parted = |groups: Vec<u32>| {
            let mut builder = MeshBuilder::new(sphere.positions().to_vec());
            sphere.polygons().for_each(|polygon| {
                builder.polygon(polygon);
            });
            let count = sphere.polygon_count();
            builder.parts((0..count).map(|p| u32::from(2 * p < count)).collect());
            builder.smoothing_groups(groups);
            EdgeCounts::of(&builder.finish().expect("a mesh"), 40.0, 1e-6)
        };
        assert_eq!(
            parted(Vec::new()),
            EdgeCounts {
                sharp: 0,
                seams: 32,
                closing: 0
            }
        );
        let faceted = alloc::vec![PolygonMesh::FACETED; sphere.polygon_count()];
        assert_eq!(parted(faceted).seams, 0);
    }
}
