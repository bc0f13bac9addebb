//! The surface of a scene: positions, normals and materials of all its vertices and polygons,
//! whatever a camera sees of them, with normals as people average and transform them by mistake.

use super::recipe::Normals;
use crate::frame::PreparedScene;
use crate::mesh::PolygonMesh;
use crate::mesh::weld::number_distinct;
use crate::scene::{Object, Scene};
use alloc::vec;
use alloc::vec::Vec;
use glam::{DMat3, DVec3};

/// The vertices and polygons of a scene. Positions count from the frame's origin, in `f64`.
pub struct Surface<'a> {
    prepared: &'a PreparedScene,
    objects: &'a [Object],
    pub origin: DVec3,
    pub positions: Vec<DVec3>,
    /// The vertex normals that the scene states.
    stated: Vec<DVec3>,
    /// The side of the box around all positions that is longest.
    pub extent: f64,
}

impl<'a> Surface<'a> {
    /// Looks at a scene; `origin` is that of its frames.
    pub fn new(scene: &'a Scene, prepared: &'a PreparedScene, origin: [f64; 3]) -> Surface<'a> {
        let geometry = prepared.geometry();
        let origin = DVec3::from_array(origin);
        let mut positions = Vec::with_capacity(geometry.models.len());
        let mut first = 0;
        for object in &geometry.models.objects {
            let vertices = first..object.end;
            let place = |v| {
                object
                    .transform
                    .transform_point3(geometry.models.position(v))
            };
            positions.extend(vertices.map(|v| place(v) - origin));
            first = object.end;
        }
        let normals = geometry.normals.iter();
        let stated = normals
            .map(|n| DVec3::from_array(n.map(f64::from)))
            .collect();
        let low = positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = positions
            .iter()
            .copied()
            .fold(DVec3::NEG_INFINITY, DVec3::max);
        Surface {
            prepared,
            objects: &scene.objects,
            origin,
            positions,
            stated,
            extent: (high - low).max_element(),
        }
    }

    /// Returns the number of vertices on one side.
    pub fn len(&self) -> usize {
        self.stated.len()
    }

    /// True if a material is multiplied by vertex colours.
    pub fn is_coloured(&self, material: u32) -> bool {
        self.prepared.is_coloured(material)
    }

    /// Returns the colour of a vertex, by which some materials are multiplied.
    pub fn colour(&self, vertex: u32) -> DVec3 {
        let [r, g, b, _] = self.prepared.geometry().attributes(vertex);
        DVec3::new(r.into(), g.into(), b.into())
    }

    /// Returns the vertex normals that the scene states.
    pub fn stated(&self) -> &[DVec3] {
        &self.stated
    }

    /// Returns the vertices at the corners of a polygon of the scene.
    pub fn corners(&self, polygon: u32) -> &[u32] {
        self.prepared.corners(polygon as usize)
    }

    /// Returns the unit normal of a polygon by Newell's formula (L21 1.1).
    pub fn face(&self, polygon: u32) -> DVec3 {
        let face = self.prepared.geometry().faces[polygon as usize];
        DVec3::from_array(face.map(f64::from))
    }

    /// Returns the number of the object that a vertex is of.
    pub fn object_of(&self, vertex: u32) -> usize {
        let front = vertex as usize % self.len();
        self.prepared.geometry().models.object_of(front)
    }

    /// True if a vertex is of an object that its transform mirrors.
    pub fn is_mirrored(&self, vertex: u32) -> bool {
        let models = &self.prepared.geometry().models;
        let object = &models.objects[self.object_of(vertex)];
        object.transform.matrix3.determinant() < 0.0
    }

    /// Returns vertex normals.
    pub fn normals(&self, normals: Normals) -> Vec<DVec3> {
        match normals {
            // Those of faces are not at vertices: `Shader` asks polygons.
            Normals::Stated | Normals::OfFaces | Normals::OfFacesRaw => self.stated.clone(),
            Normals::ByArea => self.averaged(Group::Stated, &|_, at| newell(at)),
            Normals::ByAngle => {
                self.averaged(Group::Stated, &|i, at| newell_unit(at) * angle(i, at))
            }
            Normals::ByIndex => self.averaged(Group::Index, &|_, at| newell_unit(at)),
            Normals::OverPosition => self.averaged(Group::Position, &|_, at| newell_unit(at)),
            Normals::Sums => {
                let sums = self.sums(Group::Stated, false, &|_, at| newell_unit(at));
                let unit = self.to_world(&sums);
                unit.iter()
                    .zip(sums)
                    .map(|(unit, sum)| *unit * sum.length())
                    .collect()
            }
            Normals::ByMatrix => self.by_object(|matrix, _, model| matrix * model),
            Normals::OfModel => self.by_object(|_, _, model| model),
            Normals::ByInverse => self.by_object(|matrix, _, model| matrix.inverse() * model),
            Normals::AsPoints => self.by_object(|matrix, at, model| matrix * model + at),
            Normals::OfFile => self.of_file(),
            Normals::OfLastPolygon => {
                self.to_world(&self.sums(Group::Stated, true, &|_, at| newell_unit(at)))
            }
            Normals::OfFirstEdges => self.averaged(Group::Stated, &|_, at| {
                (at[1] - at[0])
                    .cross(at[2 % at.len()] - at[1])
                    .normalize_or_zero()
            }),
            Normals::OfTriangles => self.averaged(Group::Stated, &|i, at| {
                // Triangles of the fan around the first corner that have corner i.
                let unit = |k: usize| (at[k] - at[0]).cross(at[k + 1] - at[0]).normalize_or_zero();
                let all = 1..at.len() - 1;
                all.filter(|k| i == 0 || i == *k || i == k + 1)
                    .map(unit)
                    .sum()
            }),
            Normals::InsideOut => self.by_object(|matrix, _, model| {
                let sign = matrix.determinant().signum();
                sign * (matrix.inverse().transpose() * model)
            }),
        }
    }

    /// Returns `normal` of the matrix and translation of each object and a normal in model space, as unit
    /// vectors.
    fn by_object(&self, normal: impl Fn(DMat3, DVec3, DVec3) -> DVec3) -> Vec<DVec3> {
        let mut all = Vec::with_capacity(self.len());
        let mut first = 0;
        for object in &self.prepared.geometry().models.objects {
            let (matrix, at) = (object.transform.matrix3, object.transform.translation);
            for stated in &self.stated[first..object.end] {
                // N = |det| M⁻ᵀ n up to its length, so that Mᵀ N goes back to n.
                let model = (matrix.transpose() * *stated).normalize_or_zero();
                all.push(normal(matrix, at, model).normalize_or(*stated));
            }
            first = object.end;
        }
        all
    }

    /// Returns the normals of [`Surface::sums`] in the world.
    fn averaged(&self, by: Group, share: Share<'_>) -> Vec<DVec3> {
        self.to_world(&self.sums(by, false, share))
    }

    /// Returns the sum of what each polygon adds to its vertices, in model space, or only what the last
    /// one adds.
    fn sums(&self, by: Group, keeps_last: bool, share: Share<'_>) -> Vec<DVec3> {
        let models = &self.prepared.geometry().models;
        let (groups, count) = self.groups(by);
        let mut sums = vec![DVec3::ZERO; count];
        let mut at = Vec::new();
        for polygon in 0..self.prepared.polygon_count() {
            let corners = self.prepared.corners(polygon);
            let face = self.face(polygon as u32);
            if face == DVec3::ZERO {
                continue;
            }
            at.clear();
            at.extend(
                corners
                    .iter()
                    .map(|&corner| models.position(corner as usize)),
            );
            // Corners of mirrored objects and of turned polygons run the other way.
            let object = &models.objects[models.object_of(corners[0] as usize)];
            let outward = cofactors(object.transform.matrix3) * newell(&at);
            let sign = outward.dot(face).signum();
            for (i, &corner) in corners.iter().enumerate() {
                let sum = &mut sums[groups[corner as usize] as usize];
                let share = share(i, &at) * sign;
                *sum = if keeps_last { share } else { *sum + share };
            }
        }
        groups.iter().map(|group| sums[*group as usize]).collect()
    }

    /// Returns normals in model space as unit vectors in the world.
    fn to_world(&self, normals: &[DVec3]) -> Vec<DVec3> {
        let mut all = Vec::with_capacity(self.len());
        let mut first = 0;
        for object in &self.prepared.geometry().models.objects {
            let matrix = cofactors(object.transform.matrix3);
            let own = normals[first..object.end].iter().zip(&self.stated[first..]);
            all.extend(own.map(|(normal, stated)| (matrix * *normal).normalize_or(*stated)));
            first = object.end;
        }
        all
    }

    /// Returns the normals that came with meshes, where there are some.
    fn of_file(&self) -> Vec<DVec3> {
        let models = &self.prepared.geometry().models;
        let mut all = self.stated.clone();
        self.for_each_corner(|mesh, corner, vertex| {
            let Some(given) = mesh.given_normals() else {
                return;
            };
            let number = match &given.corners {
                Some(corners) => corners[corner],
                None => mesh.corners()[corner],
            };
            let object = &models.objects[models.object_of(vertex)];
            let n = cofactors(object.transform.matrix3) * given.values[number as usize].as_dvec3();
            all[vertex] = n.normalize_or(all[vertex]);
        });
        all
    }

    /// Returns the group of each vertex, and their number.
    fn groups(&self, by: Group) -> (Vec<u32>, usize) {
        let models = &self.prepared.geometry().models;
        let object = |v: usize| models.object_of(v) as u32;
        let bits = |v: usize| [models.x[v], models.y[v], models.z[v]].map(|c| (c + 0.0).to_bits());
        match by {
            Group::Index => {
                let indices = self.indices();
                number_distinct(self.len(), |v| [indices[v], object(v), 0])
            }
            Group::Position => {
                let (places, _) = number_distinct(self.len(), bits);
                number_distinct(self.len(), |v| [places[v], object(v), 0])
            }
            Group::Stated => {
                let (places, _) = number_distinct(self.len(), bits);
                let normal = |v: usize| self.prepared.geometry().normals[v].map(f32::to_bits);
                let (normals, _) = number_distinct(self.len(), normal);
                number_distinct(self.len(), |v| [places[v], object(v), normals[v]])
            }
        }
    }

    /// Returns the position of its mesh that each vertex has, by index.
    fn indices(&self) -> Vec<u32> {
        let mut indices = vec![0; self.len()];
        self.for_each_corner(|mesh, corner, vertex| indices[vertex] = mesh.corners()[corner]);
        indices
    }

    /// Calls `visit` with each corner of each mesh, and the vertex that it became.
    fn for_each_corner(&self, mut visit: impl FnMut(&PolygonMesh, usize, usize)) {
        let mut first = 0;
        for object in self.objects {
            let mesh = &*object.mesh;
            let is_mirrored = object.transform.matrix3.determinant() < 0.0;
            for p in 0..mesh.polygon_count() {
                let corners = mesh.corner_range(p);
                let count = corners.len();
                for (i, corner) in corners.enumerate() {
                    let i = if is_mirrored { count - 1 - i } else { i };
                    visit(mesh, corner, self.prepared.corners(first + p)[i] as usize);
                }
            }
            first += mesh.polygon_count();
        }
    }
}

/// The vertices of an object that share an average.
#[derive(Clone, Copy)]
enum Group {
    /// Those at one position that have one normal.
    Stated,
    /// All at one position.
    Position,
    /// Those that are one vertex in the file.
    Index,
}

/// What a polygon adds to the normal of its corner `i`; `at` are the places of its corners.
type Share<'a> = &'a dyn Fn(usize, &[DVec3]) -> DVec3;

/// Returns Newell's sum, twice the area of a polygon along its normal (L21 1.1).
fn newell(at: &[DVec3]) -> DVec3 {
    let next = at.iter().cycle().skip(1);
    at.iter().zip(next).map(|(a, b)| a.cross(*b)).sum()
}

fn newell_unit(at: &[DVec3]) -> DVec3 {
    newell(at).normalize_or_zero()
}

/// Returns the angle of a polygon at its corner `i`.
fn angle(i: usize, at: &[DVec3]) -> f64 {
    let back = at[(i + at.len() - 1) % at.len()] - at[i];
    let angle = back.angle_between(at[(i + 1) % at.len()] - at[i]);
    if angle.is_finite() { angle } else { 0.0 }
}

/// Returns the matrix that carries normals: the inverse transpose up to a positive factor.
fn cofactors(m: DMat3) -> DMat3 {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z) * sign, z.cross(x) * sign, x.cross(y) * sign)
}
