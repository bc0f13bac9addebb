//! Vertex normals.
//!
//! [`vertex_normals`] computes a unit normal for every corner of a mesh. A [`NormalSource`] says
//! where normals come from: averages over the polygons around a vertex (L21 3.1), the normals that
//! came with the mesh, or averages that stop at creases. A [`NormalWeight`] says how much each
//! polygon counts in an average.
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::mesh::vertex_normals::{NormalSource, vertex_normals};
//!
//! let cube = builtin("cube")?;
//! // One normal per vertex, along its diagonal.
//! assert_eq!(vertex_normals(&cube, NormalSource::Averaged).values.len(), 8);
//! // One per corner: the edges turn by 90 degrees, more than a crease of 40.
//! assert_eq!(vertex_normals(&cube, NormalSource::Crease(40.0)).values.len(), 24);
//! # Ok::<(), fastphong::mesh::builtin::BuiltinError>(())
//! ```

mod arc;
pub(super) mod weight;

pub use weight::NormalWeight;

use super::cap_sums::CapSums;
use super::fans::{FanCorner, Fans, Smoothing, SurfaceFinder};
use super::newell::{polygon_normals, unit_normal};
use super::weld::weld;
use super::{GivenNormals, PolygonMesh};
use crate::number::parallel::{collect, join};
use alloc::borrow::Cow;
use alloc::vec;
use alloc::vec::Vec;
use glam::{DVec3, Vec3};
use weight::{Sum, Term, Weights};

/// The source of vertex normals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum NormalSource {
    /// The normalised sum of the unit normals of all polygons around a position (L21 3.1) that are
    /// on one surface and, if the mesh has smoothing groups, in one group. Polygons of a glTF file
    /// that are flat only because it has no normals for them are averaged too.
    #[default]
    Averaged,
    /// The mesh's own normal for each corner that has one; averages as [`NormalSource::Averaged`]
    /// makes them for the others.
    Auto,
    /// The mesh's own normal for each corner that has one; averages that ignore smoothing groups
    /// for the others.
    Given,
    /// Averages that ignore smoothing groups and count only polygons whose normals differ from the
    /// corner's own polygon by at most this angle in degrees.
    Crease(f64),
}

/// A source of vertex normals, and the weight of polygons where normals are averaged.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NormalRule {
    /// The source.
    pub source: NormalSource,
    /// The weight of each polygon where `source` averages.
    pub weight: NormalWeight,
}

impl From<NormalSource> for NormalRule {
    /// Returns the source with uniform weights, as in the lecture.
    fn from(source: NormalSource) -> Self {
        let weight = NormalWeight::Uniform;
        NormalRule { source, weight }
    }
}

/// A unit normal for every corner of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexNormals {
    /// Unit vectors.
    pub values: Vec<Vec3>,
    /// The index into `values` for each corner, in the order of [`PolygonMesh::corners`].
    pub corners: Vec<u32>,
}

/// The normal of a corner if no polygon around it has one. It points toward the viewer of a mesh
/// that was not turned.
const NO_NORMAL: DVec3 = DVec3::Z;

/// Returns the unit normals at all corners of `mesh`, computed in `f64` and rounded once.
///
/// Positions that coincide exactly are one vertex, whatever their indices. Corners at a vertex
/// share an average if they are on one surface. That means that they belong to one part of the
/// mesh, and that a chain of polygons around the vertex links them, each sharing an edge with the
/// next one and running along it in the opposite direction. If more than two polygons meet at an
/// edge, the flattest pairs are linked first, and each polygon is linked to one other. Polygons
/// that fold back onto each other, as the two sides of a sheet do at its rim, are not linked. So
/// two sheets back to back, shapes that touch at a corner, and neighbours that are wound
/// differently (as somewhere on a Möbius strip) do not smooth each other.
///
/// A polygon counts once at a vertex, even if it passes the vertex twice. Under weights of corners
/// ([`NormalWeight::Angle`], [`NormalWeight::Max`]) it counts with each of its corners there. A
/// polygon without a normal does not count, but it still links its neighbours. Normals do not
/// depend on the scale of the mesh. If all weights vanish, all corners count equally. If the sum
/// vanishes, each corner has the normal of its own polygon, or (0, 0, 1) if that polygon has none.
///
/// The time is proportional to the size of the mesh. Under [`NormalSource::Crease`] a vertex with n
/// polygons takes up to n √n.
pub fn vertex_normals(mesh: &PolygonMesh, rule: impl Into<NormalRule>) -> VertexNormals {
    corner_normals(mesh, rule.into(), None).by_corner(mesh)
}

/// The unit normals at all corners of a mesh, in the shorter of two forms.
pub(crate) enum CornerNormals {
    /// All corners at a position have one normal.
    ByPosition {
        /// Unit vectors.
        values: Vec<Vec3>,
        /// The index into `values` for each position.
        positions: Vec<u32>,
    },
    /// Some corners at one position differ.
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

/// Returns, for each corner of `mesh`, the entry of `positions` for its position.
fn corners_of(mesh: &PolygonMesh, positions: &[u32]) -> Vec<u32> {
    mesh.corners()
        .iter()
        .map(|&c| positions[c as usize])
        .collect()
}

/// Computes [`vertex_normals`]. `polygons` are Newell's normals of all polygons, if the caller has
/// them already.
pub(crate) fn corner_normals(
    mesh: &PolygonMesh,
    rule: NormalRule,
    polygons: Option<&[DVec3]>,
) -> CornerNormals {
    let NormalRule { source, weight } = rule;
    let averaged = |smoothing| averaged(mesh, polygons, weight, smoothing);
    match (source, mesh.given_normals()) {
        (NormalSource::Auto, Some(given)) => {
            from_given(mesh, given, || averaged(Smoothing::Groups))
        }
        (NormalSource::Given, Some(given)) => {
            from_given(mesh, given, || averaged(Smoothing::Surfaces))
        }
        (NormalSource::Crease(degrees), _) => {
            CornerNormals::ByCorner(creased(mesh, degrees, polygons, weight))
        }
        (NormalSource::Given, None) => averaged(Smoothing::Surfaces),
        (NormalSource::Averaged, _) if mesh.is_flat_for_lack() => averaged(Smoothing::Surfaces),
        (NormalSource::Averaged, _) | (NormalSource::Auto, None) => averaged(Smoothing::Groups),
    }
}

/// The normals and smoothing groups of a mesh that a [`NormalSource`] uses, and those that it
/// leaves unused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub struct NormalUse {
    /// How many corners use a normal that came with the mesh.
    pub given: usize,
    /// How many corners use an average.
    pub averaged: usize,
    /// True if averages obey smoothing groups.
    pub obeys_groups: bool,
    /// True if the mesh has normals that `source` ignores.
    pub leaves_normals: bool,
    /// True if the mesh has smoothing groups that `source` ignores.
    pub leaves_groups: bool,
}

impl NormalUse {
    /// Finds out what `source` uses of `mesh`.
    pub fn of(mesh: &PolygonMesh, source: NormalSource) -> NormalUse {
        let has_normal = |given: &GivenNormals, n: u32| given.values[n as usize] != Vec3::ZERO;
        let own = mesh.given_normals().map_or(0, |given| {
            let corners = given.corners.as_deref().unwrap_or(mesh.corners());
            corners.iter().filter(|&&n| has_normal(given, n)).count()
        });
        let takes_normals = matches!(source, NormalSource::Auto | NormalSource::Given);
        let given = if takes_normals { own } else { 0 };
        // A corner's own normal wins over its smoothing group. If all corners have one, no group
        // could have mattered.
        let matters = mesh.has_smoothing_groups() && own < mesh.corners().len();
        let obeys = match source {
            NormalSource::Auto => true,
            NormalSource::Averaged => !mesh.is_flat_for_lack(),
            _ => false,
        };
        NormalUse {
            given,
            averaged: mesh.corners().len() - given,
            obeys_groups: mesh.has_smoothing_groups() && obeys && given < mesh.corners().len(),
            leaves_normals: own > given,
            leaves_groups: matters && !obeys && !mesh.is_flat_for_lack(),
        }
    }
}

/// Returns the unit normals of all polygons; zero for a polygon without a normal.
fn unit_normals(polygons: &[DVec3]) -> Vec<DVec3> {
    let unit = |p: usize| unit_normal(polygons[p]).unwrap_or(DVec3::ZERO);
    collect(polygons.len(), 4096, unit)
}

/// The data that averages over the polygons of a mesh need.
struct Around<'a> {
    mesh: &'a PolygonMesh,
    /// The vertex at each position.
    vertex: Vec<u32>,
    /// How many vertices there are.
    count: usize,
    fans: Fans,
    polygons: Cow<'a, [DVec3]>,
    normals: Vec<DVec3>,
    triangles: Vec<[f64; 3]>,
    weight: NormalWeight,
}

impl<'a> Around<'a> {
    /// Collects the corners around each vertex, and in parallel computes the normals of polygons if
    /// they are not known already.
    fn new(mesh: &'a PolygonMesh, polygons: Option<&'a [DVec3]>, weight: NormalWeight) -> Self {
        let corners = || {
            let (vertex, count) = weld(mesh.positions());
            let fans = Fans::new(mesh, &vertex, count);
            (vertex, count, fans)
        };
        let weighed = || {
            let polygons = match polygons {
                Some(known) => Cow::Borrowed(known),
                None => Cow::Owned(polygon_normals(mesh)),
            };
            let normals = unit_normals(&polygons);
            let triangles = weight::of_triangles(mesh, &polygons, weight);
            (polygons, normals, triangles)
        };
        let ((vertex, count, fans), (polygons, normals, triangles)) = join(corners, weighed);
        Around {
            mesh,
            vertex,
            count,
            fans,
            polygons,
            normals,
            triangles,
            weight,
        }
    }

    fn weights(&self) -> Weights<'_> {
        Weights {
            mesh: self.mesh,
            polygons: &self.polygons,
            normals: &self.normals,
            triangles: &self.triangles,
            weight: self.weight,
        }
    }
}

/// The averages at a run of consecutive vertices.
#[derive(Clone, Default)]
struct AveragedRun {
    values: Vec<Vec3>,
    /// The index into `values` for each corner at these vertices, in the order of [`Fans`]. It is
    /// empty if each vertex has one value.
    indices: Vec<u32>,
}

/// How many vertices make a run. One thread works on a run.
const RUN: usize = 1024;

fn averaged(
    mesh: &PolygonMesh,
    polygons: Option<&[DVec3]>,
    weight: NormalWeight,
    smoothing: Smoothing,
) -> CornerNormals {
    let around = Around::new(mesh, polygons, weight);
    let (count, fans, weights) = (around.count, &around.fans, around.weights());
    let runs = collect(count.div_ceil(RUN), 1, |run| {
        let vertices = run * RUN..count.min(run * RUN + RUN);
        let mut finder = SurfaceFinder::new(mesh, &around.vertex, &around.normals);
        let simple = vertices.clone().map(|v| {
            let fan = fans.of(v);
            // The quick test refuses fans of many corners, as at the pole of a sphere; the slow one
            // then finds one group.
            let has_one_value =
                finder.is_simple(v, fan, smoothing) || finder.find_groups(v, fan, smoothing) == 1;
            has_one_value.then(|| weights.sum(fan).average()).flatten()
        });
        // Collecting options stops at the first `None`: a vertex of several values, or of a sum
        // that vanishes. The whole run then starts again, with an index per corner.
        if let Some(values) = simple.collect() {
            let indices = Vec::new();
            return AveragedRun { values, indices };
        }
        let mut of_run = AveragedRun::default();
        for v in vertices {
            let fan = fans.of(v);
            let groups = finder.find_groups(v, fan, smoothing);
            of_run.add_vertex(fan, &finder.surfaces, groups, &weights);
        }
        of_run
    });
    if runs.iter().all(|run| run.indices.is_empty()) {
        CornerNormals::ByPosition {
            values: runs.into_iter().flat_map(|run| run.values).collect(),
            positions: around.vertex,
        }
    } else {
        CornerNormals::ByCorner(join_runs(mesh, fans, count, runs))
    }
}

/// Joins the values of all runs, and finds the index of each corner around the `count` vertices.
fn join_runs(
    mesh: &PolygonMesh,
    fans: &Fans,
    count: usize,
    runs: Vec<AveragedRun>,
) -> VertexNormals {
    let mut corners = vec![0; mesh.corners().len()];
    let mut values = Vec::with_capacity(count);
    for (run, of_run) in runs.into_iter().enumerate() {
        let first = values.len() as u32;
        values.extend(of_run.values);
        let vertices = run * RUN..count.min(run * RUN + RUN);
        let mut indices = of_run.indices.iter();
        for v in vertices.clone() {
            for item in fans.of(v) {
                // Without indices, each vertex of the run has one value, in the order of vertices.
                let index = indices
                    .next()
                    .copied()
                    .unwrap_or((v - vertices.start) as u32);
                corners[item.corner as usize] = first + index;
            }
        }
    }
    VertexNormals { values, corners }
}

impl AveragedRun {
    /// Adds the averages of `count` groups of the corners in `fan`. If an average vanishes, it adds
    /// the normals of the group's polygons.
    fn add_vertex(&mut self, fan: &[FanCorner], groups: &[u32], count: usize, weights: &Weights) {
        let mut add = |value: Vec3| {
            self.values.push(value);
            self.values.len() as u32 - 1
        };
        let averages: Vec<Option<u32>> = group_sums(fan, groups, count, weights)
            .iter()
            .map(|sum| sum.average().map(&mut add))
            .collect();
        let mut own = (u32::MAX, 0);
        for (item, &group) in fan.iter().zip(groups) {
            let index = averages[group as usize].unwrap_or_else(|| {
                // The corners of one polygon stand next to each other.
                if own.0 != item.polygon {
                    let normal = weights.normals[item.polygon as usize];
                    let normal = if normal == DVec3::ZERO {
                        NO_NORMAL
                    } else {
                        normal
                    };
                    own = (item.polygon, add(normal.as_vec3()));
                }
                own.1
            });
            self.indices.push(index);
        }
    }
}

/// Returns the sum of each of `count` groups of the corners in `fan`. If all corners of a group
/// have weight 0, they count equally.
fn group_sums(fan: &[FanCorner], groups: &[u32], count: usize, weights: &Weights) -> Vec<Sum> {
    let mut sums = vec![Sum::new(weights.weight); count];
    let each = || fan.iter().zip(groups);
    each().for_each(|(item, &group)| sums[group as usize].add(item, weights));
    if sums.iter().any(Sum::is_without_weight) {
        let uniform = weights.uniform();
        let mut alike = vec![Sum::default(); count];
        each().for_each(|(item, &group)| alike[group as usize].add(item, &uniform));
        for (sum, alike) in sums.iter_mut().zip(alike) {
            if sum.is_without_weight() {
                *sum = alike;
            }
        }
    }
    sums
}

/// Returns the given normals. Corners without one get their normal from `averaged`.
fn from_given(
    mesh: &PolygonMesh,
    given: &GivenNormals,
    averaged: impl FnOnce() -> CornerNormals,
) -> CornerNormals {
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
        let fallback = averaged().by_corner(mesh);
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

fn creased(
    mesh: &PolygonMesh,
    degrees: f64,
    polygons: Option<&[DVec3]>,
    weight: NormalWeight,
) -> VertexNormals {
    // A dot product of two unit normals, each off by 4ε, is off by less than 16ε. With that slack,
    // a crease of exactly an edge's angle keeps the edge smooth.
    let least_cosine = libm::cos(degrees.clamp(0.0, 180.0).to_radians()) - 16.0 * f64::EPSILON;
    let around = Around::new(mesh, polygons, weight);
    let (count, fans, weights) = (around.count, &around.fans, around.weights());
    let runs = collect(count.div_ceil(RUN), 1, |run| {
        let mut finder = SurfaceFinder::new(mesh, &around.vertex, &around.normals);
        let mut of_run = AveragedRun::default();
        for v in run * RUN..count.min(run * RUN + RUN) {
            let fan = fans.of(v);
            let count = finder.find(v, fan);
            of_run.add_creased(fan, &finder.surfaces, count, &weights, least_cosine);
        }
        of_run
    });
    join_runs(mesh, fans, count, runs)
}

impl AveragedRun {
    /// Adds the normals of the corners in `fan`, which lie on `count` surfaces. `surfaces` holds
    /// the surface of each corner.
    fn add_creased(
        &mut self,
        fan: &[FanCorner],
        surfaces: &[u32],
        count: usize,
        weights: &Weights,
        least_cosine: f64,
    ) {
        let mut fan: Vec<(usize, FanCorner)> = fan.iter().copied().enumerate().collect();
        if count > 1 {
            fan.sort_by_key(|&(item, _)| surfaces[item]);
        }
        let mut found = Vec::with_capacity(fan.len());
        for surface in fan.chunk_by(|a, b| surfaces[a.0] == surfaces[b.0]) {
            creased_surface(surface, weights, least_cosine, &mut found);
        }
        // Store equal normals once. Indices follow first occurrence, so a new index is always the
        // next one.
        let (indices, _) = weld(&found);
        let (first, first_index) = (self.values.len(), self.indices.len());
        self.indices.resize(first_index + fan.len(), 0);
        for ((&(item, _), &value), &index) in fan.iter().zip(&found).zip(&indices) {
            self.indices[first_index + item] = first as u32 + index;
            if self.values.len() == first + index as usize {
                self.values.push(value);
            }
        }
    }
}

/// If more polygons than this lie around a vertex, a tree finds their sums.
const MANY: usize = 128;

/// Adds the normals of the corners of one surface at a vertex to `found`. Each is the sum over the
/// polygons within the crease angle.
fn creased_surface(
    surface: &[(usize, FanCorner)],
    weights: &Weights,
    least_cosine: f64,
    found: &mut Vec<Vec3>,
) {
    let around = terms(surface, weights);
    // If all corners have weight 0, they count equally.
    let weighs = around.iter().any(|term| term.weight > 0.0);
    let (around, weights) = if weighs || around.is_empty() {
        (around, *weights)
    } else {
        (terms(surface, &weights.uniform()), weights.uniform())
    };
    let add = |mut sum: Sum, term: &Term| {
        sum.add_term(term);
        sum
    };
    let none = Sum::new(weights.weight);
    let all = around.iter().fold(none, add);
    let tree = (around.len() > MANY).then(|| CapSums::new(around.clone(), none));
    for (_, item) in surface {
        let own = weights.normals[item.polygon as usize];
        let has_normal = own != DVec3::ZERO;
        let sum = match &tree {
            _ if !has_normal => all,
            Some(tree) => tree.within(own, least_cosine),
            None => {
                let near = around
                    .iter()
                    .filter(|term| own.dot(term.polygon) >= least_cosine);
                near.fold(none, add)
            }
        };
        let value = sum.direction().or(has_normal.then_some(own));
        found.push(value.unwrap_or(NO_NORMAL).as_vec3());
    }
}

/// Returns the terms of a surface's corners. If a polygon counts once, only its first corner has a
/// term.
fn terms(surface: &[(usize, FanCorner)], weights: &Weights) -> Vec<Term> {
    let mut latest = u32::MAX;
    let mut terms = Vec::with_capacity(surface.len());
    for (_, corner) in surface {
        // The corners of one polygon stand next to each other.
        let is_again = latest == corner.polygon && weights.is_by_polygon();
        if let (Some(term), false) = (weights.term(corner), is_again) {
            latest = corner.polygon;
            terms.push(term);
        }
    }
    terms
}

#[cfg(test)]
mod weight_tests;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuilder;
    use crate::mesh::newell::polygon_normal;

    /// Returns the cube from −1 to 1: six quads, wound outward.
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
        // Two walls at a right angle. They repeat the positions of their common edge, and one
        // writes −0 there.
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
            Vec3::Y,
            Vec3::Z,
            Vec3::new(0.0, 2.0, 0.0),
            Vec3::new(0.0, 0.0, 9.0),
        ];
        let mut builder = MeshBuilder::new(positions);
        builder
            .polygon(&[0, 1, 2])
            .polygon(&[1, 0, 3])
            .polygon(&[4, 4, 4]);
        let mesh = builder.finish().expect("triangles");
        for source in [
            NormalSource::Averaged,
            NormalSource::Given,
            NormalSource::Crease(10.0),
        ] {
            let normals = vertex_normals(&mesh, source);
            for k in 0..9 {
                // No polygon around the last four corners has a normal.
                let expected = if k < 5 { Vec3::X } else { Vec3::Z };
                assert_eq!(at(&normals, k), expected, "{source:?} {k}");
            }
        }
    }

    #[test]
    fn a_polygon_that_passes_a_position_twice_counts_once() {
        // A triangle upward, and a bow tie of two equal lobes to the side, whose waist and next
        // corner are the triangle's.
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
        builder.polygon(&[0, 1, 2]).polygon(&[0, 2, 3, 4, 0, 5, 6]);
        let mesh = builder.finish().expect("triangle and bow tie");
        assert_eq!(face_normal(&mesh, 1), Vec3::X);
        let half = DVec3::new(1.0, 0.0, 1.0).normalize().as_vec3();
        for source in [NormalSource::Averaged, NormalSource::Crease(120.0)] {
            let normals = vertex_normals(&mesh, source);
            for k in [0, 3, 7] {
                assert_eq!(at(&normals, k), half);
            }
        }
    }

    /// Returns a piece of a cylinder around y as rows and columns of quads. They face outward, or
    /// inward if `reversed`.
    fn arch(reversed: bool) -> (Vec<Vec3>, Vec<[u32; 4]>) {
        let angle = |column: u32| f64::from(column) * 0.2;
        let position = |k: u32| {
            let (sin, cos) = libm::sincos(angle(k % 6));
            DVec3::new(sin, f64::from(k / 6), cos).as_vec3()
        };
        let quads = (0..4u32)
            .flat_map(|row| (0..5).map(move |column| 6 * row + column))
            .map(|k| {
                if reversed {
                    [k, k + 6, k + 7, k + 1]
                } else {
                    [k, k + 1, k + 7, k + 6]
                }
            });
        ((0..30).map(position).collect(), quads.collect())
    }

    fn mesh_of(positions: Vec<Vec3>, polygons: &[[u32; 4]], parts: Vec<u32>) -> PolygonMesh {
        let mut builder = MeshBuilder::new(positions);
        polygons.iter().for_each(|polygon| {
            builder.polygon(polygon);
        });
        builder.parts(parts);
        builder.finish().expect("a mesh")
    }

    const AVERAGES: [NormalSource; 4] = [
        NormalSource::Averaged,
        NormalSource::Auto,
        NormalSource::Given,
        NormalSource::Crease(180.0),
    ];

    #[test]
    fn two_curved_sheets_back_to_back_each_stay_smooth() {
        let (positions, front) = arch(false);
        let back = arch(true).1;
        let alone = |quads: &[[u32; 4]]| mesh_of(positions.clone(), quads, Vec::new());
        let (front_alone, back_alone) = (alone(&front), alone(&back));
        // Both sheets on common positions, or each on its own copies; one sheet after the other, or
        // quads in turns.
        let repeated: Vec<[u32; 4]> = back.iter().map(|quad| quad.map(|k| k + 30)).collect();
        let twice = [&positions[..], &positions[..]].concat();
        let in_turns: Vec<[u32; 4]> = (0..40).map(|k| [&back, &front][k % 2][k / 2]).collect();
        for (mesh, front_first) in [
            (alone(&[&front[..], &back[..]].concat()), true),
            (
                mesh_of(
                    twice.clone(),
                    &[&front[..], &repeated[..]].concat(),
                    Vec::new(),
                ),
                true,
            ),
            (alone(&in_turns), false),
        ] {
            for source in AVERAGES {
                let both = vertex_normals(&mesh, source);
                let expected = [&front_alone, &back_alone].map(|mesh| vertex_normals(mesh, source));
                for quad in 0..40 {
                    let (side, own) = if front_first {
                        (quad / 20, quad % 20)
                    } else {
                        (1 - quad % 2, quad / 2)
                    };
                    for k in 0..4 {
                        let (found, expected) =
                            (at(&both, 4 * quad + k), at(&expected[side], 4 * own + k));
                        assert_eq!(found, expected, "{source:?} {quad}");
                    }
                }
            }
        }
        // On the outside, normals point outward and differ along the arch.
        let normals = vertex_normals(&front_alone, NormalSource::Averaged);
        assert_eq!(normals.values.len(), 30);
    }

    #[test]
    fn a_mesh_that_is_there_twice_is_as_smooth_as_once() {
        let (positions, quads) = arch(false);
        let once = mesh_of(positions.clone(), &quads, Vec::new());
        let mut copies = quads.clone();
        // Forty copies are past the limit of pairs that are compared at an edge.
        for count in [2, 3, 40] {
            copies = quads.repeat(count);
            let mesh = mesh_of(positions.clone(), &copies, Vec::new());
            for source in AVERAGES {
                let (one, all) = (vertex_normals(&once, source), vertex_normals(&mesh, source));
                for k in 0..all.corners.len() {
                    assert_eq!(
                        at(&all, k),
                        at(&one, k % one.corners.len()),
                        "{source:?} {count}"
                    );
                }
            }
        }
        assert_eq!(copies.len(), 800);
    }

    #[test]
    fn parts_of_a_mesh_do_not_smooth_one_another() {
        let (positions, quads) = arch(false);
        let parts = (0..20).map(|quad| u32::from(quad % 5 >= 2)).collect();
        let mesh = mesh_of(positions.clone(), &quads, parts);
        let alone = |of: fn(usize) -> bool| {
            let own = (0..20).filter(|quad| of(quad % 5)).map(|quad| quads[quad]);
            mesh_of(positions.clone(), &own.collect::<Vec<_>>(), Vec::new())
        };
        for source in AVERAGES {
            let both = vertex_normals(&mesh, source);
            let left = vertex_normals(&alone(|column| column < 2), source);
            let right = vertex_normals(&alone(|column| column >= 2), source);
            let mut corners = [left, right].map(|normals| {
                let all: Vec<Vec3> = (0..normals.corners.len())
                    .map(|k| at(&normals, k))
                    .collect();
                all.into_iter()
            });
            for k in 0..80 {
                let side = usize::from(k / 4 % 5 >= 2);
                assert_eq!(Some(at(&both, k)), corners[side].next(), "{source:?}");
            }
        }
    }

    #[test]
    fn polygons_that_touch_at_a_corner_or_are_wound_differently_are_not_smoothed() {
        let p = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
        // Two squares that share one corner, and two that share an edge and are wound differently.
        let corner = [
            p(0.0, 0.0, 0.0),
            p(1.0, 0.0, 0.0),
            p(1.0, 1.0, 0.0),
            p(0.0, 1.0, 0.0),
        ];
        let touching = [p(0.0, 0.0, -1.0), p(0.0, -1.0, -1.0), p(0.0, -1.0, 0.0)];
        let folded = [p(0.0, 1.0, -1.0), p(0.0, 0.0, -1.0)];
        let touching = [&corner[..], &touching[..]].concat();
        let folded = [&corner[..], &folded[..]].concat();
        for mesh in [
            mesh_of(touching, &[[0, 1, 2, 3], [0, 4, 5, 6]], Vec::new()),
            mesh_of(folded, &[[0, 1, 2, 3], [3, 0, 5, 4]], Vec::new()),
        ] {
            for source in AVERAGES {
                let normals = vertex_normals(&mesh, source);
                for k in 0..8 {
                    assert_eq!(at(&normals, k), face_normal(&mesh, k / 4), "{source:?}");
                }
            }
        }
    }

    #[test]
    fn of_three_walls_at_an_edge_the_flattest_two_are_smoothed() {
        let p = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
        let edge = [p(0.0, 0.0, 0.0), p(0.0, 1.0, 0.0)];
        // A wall to the left, one to the right and a bit back, and one that stands out.
        let left = [p(-1.0, 1.0, 0.0), p(-1.0, 0.0, 0.0)];
        let right = [p(1.0, 0.0, -0.2), p(1.0, 1.0, -0.2)];
        let out = [p(0.2, 0.0, 1.0), p(0.2, 1.0, 1.0)];
        let positions = [edge, left, right, out].concat();
        let [left, right, out] = [[0, 1, 2, 3], [0, 4, 5, 1], [0, 6, 7, 1]];
        let both = (Vec3::Z.as_dvec3() + DVec3::new(0.2, 0.0, 1.0).normalize()).normalize();
        for walls in [[left, right, out], [out, right, left], [right, out, left]] {
            let mesh = mesh_of(positions.clone(), &walls, Vec::new());
            for source in AVERAGES {
                let normals = vertex_normals(&mesh, source);
                for (wall, polygon) in walls.iter().enumerate() {
                    let k = 4 * wall;
                    let expected = if *polygon == out {
                        face_normal(&mesh, wall)
                    } else {
                        both.as_vec3()
                    };
                    // Two unit normals, added in either order, and rounded to f32.
                    let off = (at(&normals, k) - expected).length();
                    assert!(off <= 2.0 * f32::EPSILON, "{source:?} {wall}: {off}");
                }
            }
        }
    }

    #[test]
    fn shapes_that_touch_along_an_edge_keep_their_own_normals() {
        let one = cube();
        let mut positions = one.positions().to_vec();
        // A second cube from 1 to 3 in x and y.
        positions.extend(
            one.positions()
                .iter()
                .map(|p| *p + Vec3::new(2.0, 2.0, 0.0)),
        );
        let mut builder = MeshBuilder::new(positions);
        for offset in [0, 8] {
            for polygon in one.polygons() {
                let moved: Vec<u32> = polygon.iter().map(|c| c + offset).collect();
                builder.polygon(&moved);
            }
        }
        let two = builder.finish().expect("two cubes");
        for source in AVERAGES {
            let (of_one, of_two) = (vertex_normals(&one, source), vertex_normals(&two, source));
            for k in 0..48 {
                assert_eq!(at(&of_two, k), at(&of_one, k % 24), "{source:?}");
            }
        }
    }

    #[test]
    fn a_moebius_strip_is_smooth_but_where_it_turns_over() {
        // Its two borders, once around; the last quad joins the first one upside down.
        let count = 24u32;
        let border = |k: u32| {
            let (turn, side) = (k / 2, if k.is_multiple_of(2) { 0.3 } else { -0.3 });
            let angle = f64::from(turn) * core::f64::consts::TAU / f64::from(count);
            let (sin, cos) = libm::sincos(angle);
            let (sin_half, cos_half) = libm::sincos(angle / 2.0);
            let out = 1.0 + side * cos_half;
            DVec3::new(out * cos, out * sin, side * sin_half).as_vec3()
        };
        let positions: Vec<Vec3> = (0..2 * count).map(border).collect();
        let quads: Vec<[u32; 4]> = (0..count)
            .map(|k| {
                if k + 1 == count {
                    [2 * k, 2 * k + 1, 0, 1]
                } else {
                    [2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2]
                }
            })
            .collect();
        let mesh = mesh_of(positions, &quads, Vec::new());
        for source in AVERAGES {
            let normals = vertex_normals(&mesh, source);
            // One normal at each vertex, and two at each of the two vertices of the joint.
            assert_eq!(normals.values.len(), 2 * count as usize + 2, "{source:?}");
            assert_eq!(at(&normals, 0), face_normal(&mesh, 0));
        }
    }

    #[test]
    fn averages_stop_at_the_borders_of_smoothing_groups() {
        let (positions, quads) = arch(false);
        let with = |groups: Vec<u32>| {
            let mut builder = MeshBuilder::new(positions.clone());
            quads.iter().for_each(|quad| {
                builder.polygon(quad);
            });
            builder.smoothing_groups(groups);
            builder.finish().expect("an arch")
        };
        let smooth = vertex_normals(&with(Vec::new()), NormalSource::Averaged);
        let in_two: Vec<u32> = (0..20).map(|quad| 1 + u32::from(quad % 5 >= 2)).collect();
        let off = vec![PolygonMesh::FACETED; 20];
        for source in [NormalSource::Averaged, NormalSource::Auto] {
            assert_eq!(vertex_normals(&with(vec![7; 20]), source), smooth);
            let faceted = vertex_normals(&with(off.clone()), source);
            let two = vertex_normals(&with(in_two.clone()), source);
            let mesh = with(Vec::new());
            for (k, &position) in mesh.corners().iter().enumerate() {
                assert_eq!(at(&faceted, k), face_normal(&mesh, k / 4));
                // Along the border each group has its own normal: the normal of its column of
                // quads.
                if position % 6 == 2 {
                    let off = (at(&two, k) - face_normal(&mesh, k / 4)).length();
                    assert!(off <= 2.0 * f32::EPSILON);
                } else {
                    assert_eq!(at(&two, k), at(&smooth, k));
                }
            }
        }
        for source in [NormalSource::Given, NormalSource::Crease(180.0)] {
            let regardless = vertex_normals(&with(off.clone()), source);
            (0..80).for_each(|k| assert_eq!(at(&regardless, k), at(&smooth, k), "{source:?}"));
        }
    }

    #[test]
    fn a_corners_own_normal_wins_over_the_smoothing_group() {
        let (positions, quads) = arch(false);
        let mut builder = MeshBuilder::new(positions);
        quads.iter().for_each(|quad| {
            builder.polygon(quad);
        });
        builder.smoothing_groups(vec![PolygonMesh::FACETED; 20]);
        // Every third corner has one.
        builder.normals(GivenNormals {
            values: vec![Vec3::ZERO, Vec3::Y],
            corners: Some((0..80).map(|k| u32::from(k % 3 == 0)).collect()),
        });
        let mesh = builder.finish().expect("an arch");
        let normals = vertex_normals(&mesh, NormalSource::Auto);
        for k in 0..80 {
            let expected = if k % 3 == 0 {
                Vec3::Y
            } else {
                face_normal(&mesh, k / 4)
            };
            assert_eq!(at(&normals, k), expected);
        }
        let used = |source| NormalUse::of(&mesh, source);
        let auto = used(NormalSource::Auto);
        assert_eq!(
            (auto.given, auto.averaged, auto.obeys_groups),
            (27, 53, true)
        );
        assert!(!auto.leaves_normals && !auto.leaves_groups);
        let given = used(NormalSource::Given);
        assert!(!given.leaves_normals && given.leaves_groups && !given.obeys_groups);
        let averaged = used(NormalSource::Averaged);
        assert!(averaged.leaves_normals && !averaged.leaves_groups && averaged.obeys_groups);
        let crease = used(NormalSource::Crease(30.0));
        assert!(crease.leaves_normals && crease.leaves_groups);
    }

    /// Returns a cone of `count` triangles around its tip.
    fn cone(count: u32) -> PolygonMesh {
        let rim = |k: u32| {
            let (sin, cos) = libm::sincos(f64::from(k) * core::f64::consts::TAU / f64::from(count));
            DVec3::new(cos, sin, 0.0).as_vec3()
        };
        let mut builder = MeshBuilder::new((0..count).map(rim).chain([Vec3::Z]).collect());
        (0..count).for_each(|k| {
            builder.polygon(&[k, (k + 1) % count, count]);
        });
        builder.finish().expect("a cone")
    }

    #[test]
    fn the_crease_of_a_large_fan_is_found_as_that_of_a_small_one() {
        let count = 4 * MANY as u32;
        let mesh = cone(count);
        let normals = vertex_normals(&mesh, NormalSource::Crease(30.0));
        let own: Vec<DVec3> = (0..count as usize)
            .map(|p| unit_normal(polygon_normal(&mesh, p)).expect("a triangle"))
            .collect();
        let least = libm::cos(30f64.to_radians());
        for p in 0..count as usize {
            let near = own.iter().filter(|n| n.dot(own[p]) >= least);
            let expected = near.sum::<DVec3>().normalize().as_vec3();
            // The two sums add in different orders, and each is rounded to f32.
            assert!((at(&normals, 3 * p + 2) - expected).length() <= 2.0 * f32::EPSILON);
        }
    }

    /// Comparing every pair of polygons would take minutes here.
    #[test]
    fn a_fan_of_60000_triangles_does_not_take_quadratic_time() {
        let mesh = cone(60_000);
        for source in [NormalSource::Crease(30.0), NormalSource::Averaged] {
            let normals = vertex_normals(&mesh, source);
            assert!(normals.values.len() >= 60_001);
        }
        // Triangles that share nothing but one corner, and triangles at one edge like the pages of
        // a book.
        let positions = cone(60_000).positions().to_vec();
        let mut apart = MeshBuilder::new(positions.clone());
        let mut book = MeshBuilder::new(positions);
        for k in 0..30_000 {
            apart.polygon(&[2 * k, 2 * k + 1, 60_000]);
            book.polygon(&[0, 60_000, 2 * k + 1])
                .polygon(&[60_000, 0, 2 * k + 1]);
        }
        for mesh in [apart, book].map(|builder| builder.finish().expect("triangles")) {
            for source in [NormalSource::Crease(30.0), NormalSource::Averaged] {
                let normals = vertex_normals(&mesh, source);
                assert_eq!(normals.corners.len(), mesh.corners().len());
            }
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
