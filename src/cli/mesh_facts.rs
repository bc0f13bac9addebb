//! Facts about a mesh: counts, closedness, flatness.

use fastphong::mesh::PolygonMesh;
use fastphong::mesh::edges::Edges;
use fastphong::mesh::newell::{areas_cancel, polygon_normal, unit_normal};
use fastphong::mesh::orientation::inside_out;
use fastphong::mesh::weld::weld;
use glam::DVec3;
use std::collections::{BTreeMap, HashSet};

/// The distance from its plane up to which a polygon counts as planar, in parts of its extent.
pub const PLANAR: f64 = 1e-3;
/// The sine of the angle by which a polygon turns the wrong way at a corner before it counts as concave: larger than
/// what rounding the corners of a straight edge to `f32` makes of it.
const REFLEX: f64 = 1e-3;

/// The facts about a mesh.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct MeshFacts {
    /// Polygons of the mesh.
    pub polygons: usize,
    /// The number of polygons of each number of sides.
    pub polygons_by_sides: BTreeMap<usize, usize>,
    /// Polygons without area.
    pub degenerate: usize,
    /// Polygons that cross themselves and the areas of whose lobes cancel, so that they have no normal.
    pub cancelling: usize,
    /// Polygons with the corners of an earlier one, in any order.
    pub doubled: usize,
    /// Polygons with a corner that turns the wrong way.
    pub concave: usize,
    /// Polygons that are out of their plane by more than [`PLANAR`].
    pub not_planar: usize,
    /// Positions that polygons use; coinciding ones count once.
    pub vertices: usize,
    /// Positions of the mesh.
    pub positions: usize,
    /// Smallest and largest coordinates.
    pub bounds: Option<[[f64; 3]; 2]>,
    /// Edges, coinciding ones once.
    pub edges: usize,
    /// True if every edge has two polygons that go along it in opposite directions.
    pub closed: bool,
    /// Edges of one polygon only: none on a closed mesh.
    pub open_edges: usize,
    /// Edges of three polygons or more.
    pub non_manifold_edges: usize,
    /// Edges whose two polygons go along them in the same direction: they are not wound alike.
    pub reversed_edges: usize,
    /// Surfaces of the mesh, each linked by edges, that are closed and wound inside out.
    pub inside_out: usize,
    /// Their polygons.
    pub inside_out_polygons: usize,
    /// Materials that come with the mesh.
    pub materials: usize,
    /// Polygons without a material of the mesh.
    pub polygons_without_material: usize,
    /// True if each position has a colour.
    pub colours: bool,
    /// True if normals come with the mesh.
    pub given_normals: bool,
    /// Bytes that the mesh takes in memory.
    pub bytes: usize,
}

impl MeshFacts {
    /// Finds out the facts about `mesh`.
    pub fn of(mesh: &PolygonMesh) -> MeshFacts {
        let (vertex, count) = weld(mesh.positions());
        let used = mesh.corners().iter().map(|&corner| vertex[corner as usize]);
        let inside_out = inside_out(mesh);
        let bounds = mesh.bounds().map(|(low, high)| [low, high]);
        let mut facts = MeshFacts {
            polygons: mesh.polygon_count(),
            vertices: used.collect::<HashSet<_>>().len(),
            positions: mesh.positions().len(),
            bounds: bounds.map(|ends| ends.map(|p| p.to_array())),
            materials: mesh.materials().len(),
            inside_out: inside_out.surfaces,
            inside_out_polygons: inside_out.polygons,
            colours: !mesh.colours().is_empty(),
            given_normals: mesh.given_normals().is_some(),
            bytes: bytes(mesh),
            ..MeshFacts::default()
        };
        for (p, corners) in mesh.polygons().enumerate() {
            *facts.polygons_by_sides.entry(corners.len()).or_default() += 1;
            facts.polygons_without_material += usize::from(mesh.polygon_material(p).is_none());
            let Some(normal) = unit_normal(polygon_normal(mesh, p)) else {
                match areas_cancel(mesh, p) {
                    true => facts.cancelling += 1,
                    false => facts.degenerate += 1,
                }
                continue;
            };
            let points = corners
                .iter()
                .map(|&c| mesh.positions()[c as usize].as_dvec3());
            let points: Vec<DVec3> = points.collect();
            facts.concave += usize::from(is_concave(&points, normal));
            facts.not_planar += usize::from(!is_planar(&points, normal));
        }
        facts.count_edges(mesh, &vertex, count);
        facts.count_doubled(mesh, &vertex);
        let odd = facts.open_edges + facts.non_manifold_edges + facts.reversed_edges;
        facts.closed = facts.edges > 0 && odd == 0;
        facts
    }

    /// Counts the polygons that lie upon others.
    fn count_doubled(&mut self, mesh: &PolygonMesh, vertex: &[u32]) {
        let corners = |corners: &[u32]| {
            let mut corners: Vec<u32> = corners.iter().map(|&c| vertex[c as usize]).collect();
            corners.sort_unstable();
            corners
        };
        let different: HashSet<Vec<u32>> = mesh.polygons().map(corners).collect();
        self.doubled = mesh.polygon_count() - different.len();
    }

    /// Counts the edges by the polygons at them.
    fn count_edges(&mut self, mesh: &PolygonMesh, vertex: &[u32], count: usize) {
        for edge in Edges::new(mesh, vertex, count).iter() {
            self.edges += 1;
            match edge {
                [_] => self.open_edges += 1,
                [one, other] => self.reversed_edges += usize::from(one.ascends == other.ascends),
                _ => self.non_manifold_edges += 1,
            }
        }
    }
}

fn is_concave(points: &[DVec3], normal: DVec3) -> bool {
    let n = points.len();
    n > 3
        && (0..n).any(|i| {
            let (before, here, after) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
            let (into, out) = (here - before, after - here);
            into.cross(out).dot(normal) < -REFLEX * into.length() * out.length()
        })
}

fn is_planar(points: &[DVec3], normal: DVec3) -> bool {
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let lengths = points.iter().map(|p| (*p - middle).length());
    let height = PLANAR * lengths.fold(0.0, f64::max);
    let mut heights = points.iter().map(|p| (*p - middle).dot(normal).abs());
    heights.all(|h| h <= height)
}

/// Returns the bytes that a mesh takes in memory.
fn bytes(mesh: &PolygonMesh) -> usize {
    let normals = mesh.given_normals().map_or(0, |normals| {
        let corners = normals.corners.as_deref().map_or(0, size_of_val);
        size_of_val(&normals.values[..]) + corners
    });
    // Of each polygon the end of its corners, and its material, part and smoothing group if the mesh has some.
    let has = [
        !mesh.materials().is_empty(),
        mesh.has_parts(),
        mesh.has_smoothing_groups(),
    ];
    let numbers = 1 + has.into_iter().filter(|has| *has).count();
    let polygons = numbers * mesh.polygon_count() * size_of::<u32>();
    let places = size_of_val(mesh.positions()) + size_of_val(mesh.corners());
    let looks = size_of_val(mesh.colours()) + size_of_val(mesh.materials());
    size_of::<PolygonMesh>() + places + polygons + normals + looks
}
