//! Facts about a mesh: its counts, and if it is closed, planar and wound consistently.

use fastphong::mesh::PolygonMesh;
use fastphong::mesh::edges::Edges;
use fastphong::mesh::newell::{areas_cancel, polygon_normal, unit_normal};
use fastphong::mesh::orientation::inside_out;
use fastphong::mesh::weld::weld;
use glam::DVec3;
use std::collections::{BTreeMap, HashSet};

/// The largest distance of a corner from the plane of a planar polygon, as a fraction of the
/// polygon's extent.
pub const PLANAR: f64 = 1e-3;
/// The sine of the smallest wrong turn at a corner that makes a polygon concave. It is larger than
/// the turn that rounding to `f32` can cause in the middle of a straight edge.
const REFLEX: f64 = 1e-3;

/// The facts about a mesh.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct MeshFacts {
    /// Polygons of the mesh.
    pub polygons: usize,
    /// How many polygons have how many sides.
    pub polygons_by_sides: BTreeMap<usize, usize>,
    /// Polygons without area.
    pub degenerate: usize,
    /// Polygons that cross themselves, and whose lobes have areas that cancel, so that they have no
    /// normal.
    pub cancelling: usize,
    /// Polygons with the corners of an earlier one, in any order.
    pub doubled: usize,
    /// Polygons with a corner that turns the wrong way.
    pub concave: usize,
    /// Polygons with a corner farther from their plane than [`PLANAR`].
    pub not_planar: usize,
    /// Positions that polygons use. Coinciding ones count once.
    pub vertices: usize,
    /// Positions of the mesh.
    pub positions: usize,
    /// Smallest and largest coordinates.
    pub bounds: Option<[[f64; 3]; 2]>,
    /// Edges. Coinciding ones count once.
    pub edges: usize,
    /// True if every edge has two polygons that run along it in opposite directions.
    pub closed: bool,
    /// Edges of only one polygon. A closed mesh has none.
    pub open_edges: usize,
    /// Edges of three polygons or more.
    pub non_manifold_edges: usize,
    /// Edges whose two polygons run along them in the same direction, and so are wound differently.
    pub reversed_edges: usize,
    /// Connected surfaces of the mesh that are closed and wound inside out.
    pub inside_out: usize,
    /// Polygons of the surfaces that are inside out.
    pub inside_out_polygons: usize,
    /// Materials of the mesh.
    pub materials: usize,
    /// Polygons without a material of the mesh.
    pub polygons_without_material: usize,
    /// True if each position has a colour.
    pub colours: bool,
    /// True if the mesh has normals.
    pub given_normals: bool,
    /// Bytes that the mesh takes in memory.
    pub bytes: usize,
}

impl MeshFacts {
    /// Collects the facts about `mesh`.
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
                if areas_cancel(mesh, p) {
                    facts.cancelling += 1
                } else {
                    facts.degenerate += 1
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

    /// Counts the polygons that have the corners of an earlier one.
    fn count_doubled(&mut self, mesh: &PolygonMesh, vertex: &[u32]) {
        let corners = |corners: &[u32]| {
            let mut corners: Vec<u32> = corners.iter().map(|&c| vertex[c as usize]).collect();
            corners.sort_unstable();
            corners
        };
        let different: HashSet<Vec<u32>> = mesh.polygons().map(corners).collect();
        self.doubled = mesh.polygon_count() - different.len();
    }

    /// Counts the edges by how many polygons share them.
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

/// Returns how many bytes of memory a mesh takes.
fn bytes(mesh: &PolygonMesh) -> usize {
    let normals = mesh.given_normals().map_or(0, |normals| {
        let corners = normals.corners.as_deref().map_or(0, size_of_val);
        size_of_val(&normals.values[..]) + corners
    });
    // A polygon takes one index for the end of its corners, and one each for material, part and
    // smoothing group if the mesh has these.
    let has = [
        !mesh.materials().is_empty(),
        mesh.has_parts(),
        mesh.has_smoothing_groups(),
    ];
    let indices = 1 + has.into_iter().filter(|has| *has).count();
    let polygons = indices * mesh.polygon_count() * size_of::<u32>();
    let places = size_of_val(mesh.positions()) + size_of_val(mesh.corners());
    let looks = size_of_val(mesh.colours()) + size_of_val(mesh.materials());
    size_of::<PolygonMesh>() + places + polygons + normals + looks
}
