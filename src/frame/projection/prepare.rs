//! The preparation of a scene: distinct vertices, corner lists and normals, which do not depend on
//! the camera.

use super::polygons::PolygonTable;
use crate::frame::{FrameError, Geometry, Models, PlacedModel, Polygon};
use crate::mesh::newell::{areas_cancel, polygon_normals, unit_normal};
use crate::mesh::vertex_normals::{CornerNormals, NormalSource, VertexNormals, corner_normals};
use crate::mesh::weld::number_distinct;
use crate::mesh::winding::is_against;
use crate::mesh::{Material, PolygonMesh};
use crate::number::parallel::{collect, for_each_chunk};
use crate::scene::{Object, Scene};
use alloc::vec::Vec;
use glam::{DAffine3, DMat3, DVec3, Vec3};

/// How many elements one thread takes at a time.
const CHUNK: usize = 4096;

/// The geometry of a scene, collected object after object.
#[derive(Default)]
pub(super) struct Preparation {
    pub geometry: Geometry,
    pub table: PolygonTable,
    pub materials: Vec<Material>,
    /// True for the materials of meshes with vertex colours that may be lit.
    pub coloured: Vec<bool>,
}

/// An object that is being added.
struct Source<'a> {
    mesh: &'a PolygonMesh,
    normals: NormalMap,
    /// The lighting of the mesh's first material. Behind its last material comes the lighting of
    /// polygons without one.
    first_material: u32,
}

impl Preparation {
    /// Prepares all objects of a scene.
    ///
    /// # Errors
    /// [`FrameError::TooLarge`] if 32-bit indices cannot name all corners.
    pub fn new(scene: &Scene) -> Result<Self, FrameError> {
        let sides = if scene.two_sided { 2 } else { 1 };
        let meshes = || scene.objects.iter().map(|object| &object.mesh);
        let (corners, polygons, positions) = meshes().fold((0, 0, 0), |(c, p, v), mesh| {
            (
                c + mesh.corners().len(),
                p + mesh.polygon_count(),
                v + mesh.positions().len(),
            )
        });
        // Clipping adds vertices and corners, so half of all indices are left for them.
        if sides * (corners.max(positions)) >= 1 << 31 || polygons >= Polygon::FLIPPED as usize {
            return Err(FrameError::TooLarge);
        }
        let mut all = Preparation::default();
        all.geometry.two_sided = scene.two_sided;
        all.table.count = polygons;
        for object in &scene.objects {
            all.add(object);
        }
        if corners != 3 * polygons {
            all.table.starts = starts(meshes().map(|mesh| &**mesh), polygons);
        }
        all.finish();
        Ok(all)
    }

    fn add(&mut self, object: &Object) {
        let mesh = &*object.mesh;
        let source = Source {
            mesh,
            normals: NormalMap::new(&object.transform),
            first_material: self.materials.len() as u32,
        };
        let default = Material::default();
        // The last one is for polygons without a material: see `Source::material`.
        let of_mesh = mesh.materials().iter().chain([&default]);
        self.materials
            .extend(of_mesh.map(|material| *object.material.as_ref().unwrap_or(material)));
        self.coloured
            .resize(self.materials.len(), mesh.has_lit_colours());
        let normals = polygon_normals(mesh);
        let first_polygon = self.geometry.faces.len();
        let cancels = |p: &usize| normals[*p] == DVec3::ZERO && areas_cancel(mesh, *p);
        let cancelling = (0..mesh.polygon_count())
            .filter(cancels)
            .map(|p| (first_polygon + p) as u32);
        self.table.cancelling.extend(cancelling);
        self.geometry
            .faces
            .resize(first_polygon + normals.len(), [0.0; 3]);
        let faces = &mut self.geometry.faces[first_polygon..];
        source.normals.polygons(&normals, faces);
        if self.geometry.two_sided {
            self.turn_against_normals(object, &normals, first_polygon);
        }
        let normals = corner_normals(mesh, object.normals, Some(&normals));
        self.table
            .materials
            .extend((0..mesh.polygon_count()).map(|p| source.material(p)));
        let first = self.geometry.normals.len();
        let first_corner = self.geometry.corners.len();
        match normals {
            CornerNormals::ByPosition { values, positions } if source.has_one_material() => {
                self.vertices_by_position(&source, &values, &positions);
            }
            normals => self.vertices_by_corner(&source, normals),
        }
        if source.normals.mirrored {
            reverse_corners(mesh, &mut self.geometry.corners[first_corner..]);
        }
        let models = &mut self.geometry.models;
        let extent = |all: &[f32]| {
            f64::from(
                all[first..]
                    .iter()
                    .fold(0.0f32, |most, c| most.max(c.abs())),
            )
        };
        let extent = DVec3::new(extent(&models.x), extent(&models.y), extent(&models.z));
        let end = models.x.len();
        models.objects.push(PlacedModel {
            end,
            transform: object.positions_to_world(),
            extent,
        });
    }

    /// Turns polygons whose winding contradicts the mesh's own normals at their corners. These
    /// normals say where the front is.
    fn turn_against_normals(&mut self, object: &Object, normals: &[DVec3], first: usize) {
        let mesh = &*object.mesh;
        let takes_given = matches!(
            object.normals.source,
            NormalSource::Auto | NormalSource::Given
        );
        let Some(given) = mesh.given_normals().filter(|_| takes_given) else {
            return;
        };
        let polygons =
            (0..mesh.polygon_count()).filter(|p| is_against(mesh, given, *p, normals[*p]));
        for polygon in polygons.map(|p| first + p) {
            let face = &mut self.geometry.faces[polygon];
            *face = face.map(|n| -n);
            self.table.turned.push(polygon as u32);
        }
    }

    /// Adds a vertex for each position, because each position has one normal and one material.
    fn vertices_by_position(&mut self, source: &Source<'_>, values: &[Vec3], normal_of: &[u32]) {
        let mesh = source.mesh;
        let geometry = &mut self.geometry;
        let first = geometry.normals.len();
        let in_world = collect(values.len(), CHUNK, |i| source.normals.vertex(values[i]));
        geometry
            .normals
            .extend(normal_of.iter().map(|&n| in_world[n as usize]));
        let material = if mesh.polygon_count() == 0 {
            source.first_material
        } else {
            source.material(0)
        };
        geometry.materials.resize(first + normal_of.len(), material);
        geometry
            .models
            .x
            .extend(mesh.positions().iter().map(|p| p.x));
        geometry
            .models
            .y
            .extend(mesh.positions().iter().map(|p| p.y));
        geometry
            .models
            .z
            .extend(mesh.positions().iter().map(|p| p.z));
        geometry.corners.extend(
            mesh.corners()
                .iter()
                .map(|&position| first as u32 + position),
        );
        if has_attributes(mesh) {
            // Earlier objects may have had no attributes.
            geometry.attributes.resize(first, Geometry::NO_ATTRIBUTES);
            let positions = 0..mesh.positions().len();
            let attributes = positions.filter_map(|position| attributes(mesh, position));
            geometry.attributes.extend(attributes);
        }
    }

    /// Adds a vertex for each combination of position, normal and material at a corner.
    fn vertices_by_corner(&mut self, source: &Source<'_>, normals: CornerNormals) {
        let mesh = source.mesh;
        let normals = normals.by_corner(mesh);
        let geometry = &mut self.geometry;
        let first = geometry.normals.len();
        let keys = source.corner_keys(&normals);
        let (indices, count) = number_distinct(keys.len(), |corner| keys[corner]);
        let in_world = collect(normals.values.len(), CHUNK, |i| {
            source.normals.vertex(normals.values[i])
        });
        if has_attributes(mesh) {
            geometry.attributes.resize(first, Geometry::NO_ATTRIBUTES);
        }
        for (index, &[position, normal, material]) in indices.iter().zip(&keys) {
            // An index that is new is the next one, so its vertex is added now.
            if geometry.normals.len() == first + *index as usize {
                geometry.normals.push(in_world[normal as usize]);
                geometry.materials.push(material);
                geometry.models.push(mesh.positions()[position as usize]);
                let attributes = attributes(mesh, position as usize);
                geometry.attributes.extend(attributes);
            }
        }
        debug_assert_eq!(geometry.normals.len(), first + count);
        let corners = indices.iter().map(|index| first as u32 + index);
        geometry.corners.extend(corners);
    }

    fn finish(&mut self) {
        let geometry = &mut self.geometry;
        let faces = &geometry.faces;
        self.table.has_normal = collect(faces.len().div_ceil(64), CHUNK / 64, |word| {
            bits_of_normals(faces, word)
        });
        if self.table.materials.iter().all(|&material| material == 0) {
            self.table.materials = Vec::new();
        }
        if !geometry.attributes.is_empty() {
            let count = geometry.normals.len();
            geometry.attributes.resize(count, Geometry::NO_ATTRIBUTES);
        }
        if geometry.two_sided {
            let second = geometry.normals.len() as u32;
            geometry.corners.extend_from_within(..);
            let half = geometry.corners.len() / 2;
            geometry.corners[half..]
                .iter_mut()
                .for_each(|vertex| *vertex += second);
        }
    }
}

impl Source<'_> {
    /// Returns the lighting of a polygon.
    fn material(&self, polygon: usize) -> u32 {
        let own = self
            .mesh
            .polygon_material(polygon)
            .unwrap_or(self.mesh.materials().len());
        self.first_material + own as u32
    }

    fn has_one_material(&self) -> bool {
        self.mesh.materials().is_empty()
            || (1..self.mesh.polygon_count()).all(|p| self.material(p) == self.material(0))
    }

    /// Returns position, normal and material of each corner. Corners that agree share a vertex.
    fn corner_keys(&self, normals: &VertexNormals) -> Vec<[u32; 3]> {
        let mesh = self.mesh;
        let mut keys = Vec::with_capacity(mesh.corners().len());
        for polygon in 0..mesh.polygon_count() {
            let material = self.material(polygon);
            keys.extend(mesh.corner_range(polygon).map(|corner| {
                let (position, normal) = (mesh.corners()[corner], normals.corners[corner]);
                [position, normal, material]
            }));
        }
        keys
    }
}

/// The map from normals in model space to normals in the world.
pub(super) struct NormalMap {
    /// The matrix for normals, up to their lengths.
    matrix: DMat3,
    /// True if the transform mirrors, so that corners change their winding.
    pub mirrored: bool,
}

impl NormalMap {
    pub fn new(transform: &DAffine3) -> Self {
        let linear = transform.matrix3;
        let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
        let determinant = x.dot(y.cross(z));
        // The inverse transpose is the cofactor matrix over the determinant. As normals are
        // normalised, the determinant's sign is enough, and a singular matrix still has cofactors.
        let sign = if determinant < 0.0 { -1.0 } else { 1.0 };
        NormalMap {
            matrix: DMat3::from_cols(y.cross(z) * sign, z.cross(x) * sign, x.cross(y) * sign),
            mirrored: determinant < 0.0,
        }
    }

    /// Returns a vertex normal in the world.
    pub fn vertex(&self, normal: Vec3) -> [f32; 3] {
        let direction = self.matrix * normal.as_dvec3();
        direction.normalize_or(DVec3::Z).as_vec3().to_array()
    }

    /// Writes the unit normals of polygons in the world; zero for a polygon without a normal.
    pub fn polygons(&self, normals: &[DVec3], faces: &mut [[f32; 3]]) {
        for_each_chunk((faces, normals), CHUNK, &|_,
                                                  (faces, normals): (
            &mut [[f32; 3]],
            &[DVec3],
        )| {
            for (face, &normal) in faces.iter_mut().zip(normals) {
                // Newell's sum consists of cross products, which the cofactor matrix carries to
                // world space.
                let in_world = unit_normal(self.matrix * normal).unwrap_or(DVec3::ZERO);
                *face = in_world.as_vec3().to_array();
            }
        });
    }
}

/// The normals of an object in model space, from which [`Preparation`] made its polygons and
/// vertices.
#[derive(Debug)]
pub(super) struct ModelNormals {
    /// The sums of Newell's formula, one per polygon.
    pub polygons: Vec<DVec3>,
    /// Distinct vertex normals, as unit vectors.
    values: Vec<Vec3>,
    /// The index into `values` of each vertex of the geometry.
    of_vertices: Vec<u32>,
}

impl ModelNormals {
    /// Computes the normals of an object anew.
    pub fn new(object: &Object) -> Self {
        let mesh = &*object.mesh;
        let source = Source {
            mesh,
            normals: NormalMap::new(&object.transform),
            first_material: 0,
        };
        let polygons = polygon_normals(mesh);
        let (values, of_vertices) = match corner_normals(mesh, object.normals, Some(&polygons)) {
            CornerNormals::ByPosition { values, positions } if source.has_one_material() => {
                (values, positions)
            }
            normals => {
                let normals = normals.by_corner(mesh);
                let keys = source.corner_keys(&normals);
                let (indices, count) = number_distinct(keys.len(), |corner| keys[corner]);
                let mut of_vertices = Vec::with_capacity(count);
                for (index, [_, normal, _]) in indices.iter().zip(&keys) {
                    if of_vertices.len() == *index as usize {
                        of_vertices.push(*normal);
                    }
                }
                (normals.values, of_vertices)
            }
        };
        ModelNormals {
            polygons,
            values,
            of_vertices,
        }
    }

    /// Writes the normals of all vertices of the object in the world.
    pub fn vertices(&self, map: &NormalMap, normals: &mut [[f32; 3]]) {
        debug_assert_eq!(normals.len(), self.of_vertices.len(), "the same vertices");
        let all = (normals, &self.of_vertices[..]);
        for_each_chunk(
            all,
            CHUNK,
            &|_, (normals, of): (&mut [[f32; 3]], &[u32])| {
                for (normal, &value) in normals.iter_mut().zip(of) {
                    *normal = map.vertex(self.values[value as usize]);
                }
            },
        );
    }
}

/// Reverses the corner list of each polygon of `mesh`. `corners` begins with the first polygon's
/// list.
pub(super) fn reverse_corners(mesh: &PolygonMesh, corners: &mut [u32]) {
    for polygon in 0..mesh.polygon_count() {
        corners[mesh.corner_range(polygon)].reverse();
    }
}

/// Returns a bit for each of the 64 polygons of a word: 1 if it has a normal.
pub(super) fn bits_of_normals(faces: &[[f32; 3]], word: usize) -> u64 {
    let faces = &faces[64 * word..faces.len().min(64 * word + 64)];
    let bits = faces.iter().rev();
    bits.fold(0, |bits, face| bits << 1 | u64::from(*face != [0.0; 3]))
}

impl Models {
    fn push(&mut self, position: Vec3) {
        self.x.push(position.x);
        self.y.push(position.y);
        self.z.push(position.z);
    }
}

/// Returns the index of each polygon's first corner and, last, the end of all corners.
fn starts<'a>(meshes: impl Iterator<Item = &'a PolygonMesh>, polygons: usize) -> Vec<u32> {
    let mut starts = Vec::with_capacity(polygons + 1);
    let mut first = 0;
    for mesh in meshes {
        starts.extend((0..mesh.polygon_count()).map(|p| first + mesh.corner_range(p).start as u32));
        first += mesh.corners().len() as u32;
    }
    starts.push(first);
    starts
}

/// True if vertices of the mesh have attributes.
fn has_attributes(mesh: &PolygonMesh) -> bool {
    !(mesh.attributes().is_empty() && mesh.colours().is_empty())
}

/// Returns the attributes at a position: its own, or its colour and 1.
fn attributes(mesh: &PolygonMesh, position: usize) -> Option<[f32; 4]> {
    let own = mesh.attributes().get(position).copied();
    let colour = || mesh.colours().get(position).map(|c| [c.x, c.y, c.z, 1.0]);
    own.or_else(colour)
}
