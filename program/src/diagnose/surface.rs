//! The surface of a scene: positions, normals and colours of all its vertices and polygons, visible
//! or not, and the normals that people compute by mistake.

use super::recipe::Normals;
use alloc::vec;
use alloc::vec::Vec;
use fastphong::frame::PreparedScene;
use fastphong::mesh::PolygonMesh;
use fastphong::mesh::weld::number_distinct;
use fastphong::scene::{Object, Scene};
use glam::{DMat3, DVec3};

/// The vertices and polygons of a scene. Positions are relative to the frame's origin, in `f64`.
pub struct Surface<'a> {
    prepared: &'a PreparedScene,
    objects: &'a [Object],
    pub origin: DVec3,
    pub positions: Vec<DVec3>,
    /// The vertex normals that the scene states.
    stated: Vec<DVec3>,
    /// The longest side of the box around all positions.
    pub extent: f64,
}

impl<'a> Surface<'a> {
    /// Makes the surface of a scene, whose frames have this `origin`.
    pub fn new(scene: &'a Scene, prepared: &'a PreparedScene, origin: [f64; 3]) -> Surface<'a> {
        let geometry = prepared.geometry();
        let origin = DVec3::from_array(origin);
        let mut positions = Vec::with_capacity(geometry.models.count());
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

    /// Returns how many vertices one side has.
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

    /// Returns the index of a vertex's object.
    pub fn object_of(&self, vertex: u32) -> usize {
        let front = vertex as usize % self.len();
        self.prepared.geometry().models.object_of(front)
    }

    /// True if a vertex belongs to an object that its transform mirrors.
    pub fn is_mirrored(&self, vertex: u32) -> bool {
        let models = &self.prepared.geometry().models;
        let object = &models.objects[self.object_of(vertex)];
        object.transform.matrix3.determinant() < 0.0
    }

    /// Computes vertex normals by one of the ways, right or wrong.
    pub fn normals(&self, normals: Normals) -> Vec<DVec3> {
        match normals {
            // `Shader` computes the normals of faces itself, because they do not belong to
            // vertices.
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
                // All triangles of the fan around the first corner that contain corner i.
                let unit = |k: usize| (at[k] - at[0]).cross(at[k + 1] - at[0]).normalize_or_zero();
                let all = 1..at.len() - 1;
                all.filter(|k| i == 0 || i == *k || i == k + 1)
                    .map(unit)
                    .sum()
            }),
            Normals::OfVertexBefore => {
                self.of_neighbour(|index, count| (index + count - 1) % count)
            }
            Normals::OfVertexAfter => self.of_neighbour(|index, count| (index + 1) % count),
            Normals::Positions => self.of_positions(),
            Normals::Halved => self.stated.iter().map(|n| 0.5 * *n + 0.5).collect(),
            Normals::InsideOut => self.by_object(|matrix, _, model| {
                let sign = matrix.determinant().signum();
                sign * (matrix.inverse().transpose() * model)
            }),
        }
    }

    /// Calls `normal` with each object's matrix and translation and each normal in model space.
    /// Returns the results as unit vectors.
    fn by_object(&self, normal: impl Fn(DMat3, DVec3, DVec3) -> DVec3) -> Vec<DVec3> {
        let mut all = Vec::with_capacity(self.len());
        let mut first = 0;
        for object in &self.prepared.geometry().models.objects {
            let (matrix, at) = (object.transform.matrix3, object.transform.translation);
            for stated in &self.stated[first..object.end] {
                // Apart from its length, N = |det| M⁻ᵀ n, so Mᵀ N has the direction of n.
                let model = (matrix.transpose() * *stated).normalize_or_zero();
                all.push(normal(matrix, at, model).normalize_or(*stated));
            }
            first = object.end;
        }
        all
    }

    /// Returns the normals of [`Surface::sums`] as unit vectors in the world.
    fn averaged(&self, by: Group, share: Share<'_>) -> Vec<DVec3> {
        self.to_world(&self.sums(by, false, share))
    }

    /// Adds up the polygons' shares at each group of vertices, in model space. With `keeps_last`
    /// only the share of the last polygon counts.
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
            // In mirrored objects and turned polygons corners run the other way.
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

    /// Returns the meshes' own normals, and the stated ones where a mesh has none.
    fn of_file(&self) -> Vec<DVec3> {
        let models = &self.prepared.geometry().models;
        let mut all = self.stated.clone();
        self.for_each_corner(|mesh, corner, vertex| {
            let Some(given) = mesh.given_normals() else {
                return;
            };
            let index = match &given.corners {
                Some(corners) => corners[corner],
                None => mesh.corners()[corner],
            };
            let object = &models.objects[models.object_of(vertex)];
            let n = cofactors(object.transform.matrix3) * given.values[index as usize].as_dvec3();
            all[vertex] = n.normalize_or(all[vertex]);
        });
        all
    }

    /// Returns the normals of other vertices of the same object. `other` is called with a vertex's
    /// index in its mesh, and how many positions the mesh has.
    fn of_neighbour(&self, other: impl Fn(usize, usize) -> usize) -> Vec<DVec3> {
        let models = &self.prepared.geometry().models;
        let indices = self.indices();
        let mut by_index: Vec<Vec<DVec3>> = (self.objects.iter())
            .map(|object| vec![DVec3::ZERO; object.mesh.positions().len()])
            .collect();
        for (v, normal) in self.stated.iter().enumerate() {
            by_index[models.object_of(v)][indices[v] as usize] = *normal;
        }
        let of = |v: usize| {
            let own = &by_index[models.object_of(v)];
            own[other(indices[v] as usize, own.len())]
        };
        (0..self.len()).map(of).collect()
    }

    /// Returns the direction of each vertex from the middle of its object's vertices.
    fn of_positions(&self) -> Vec<DVec3> {
        let models = &self.prepared.geometry().models;
        let mut all = Vec::with_capacity(self.len());
        let mut first = 0;
        for object in &models.objects {
            let own = first..object.end;
            let count = own.len().max(1) as f64;
            let middle = own.clone().map(|v| models.position(v)).sum::<DVec3>() / count;
            let matrix = cofactors(object.transform.matrix3);
            let normal = |v| (matrix * (models.position(v) - middle)).normalize_or_zero();
            all.extend(own.map(normal));
            first = object.end;
        }
        all
    }

    /// Returns the group of each vertex, and how many groups there are.
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

    /// Returns the index of each vertex's position in its mesh.
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
    /// Vertices with the same position and the same stated normal.
    Stated,
    /// Vertices with the same position.
    Position,
    /// Vertices that are one vertex in the file.
    Index,
}

/// A function that returns the share of a polygon in the normal at its corner `i`. Its second
/// parameter is the positions of its corners.
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

/// Returns the matrix that transforms normals: the inverse transpose, up to a positive factor.
fn cofactors(m: DMat3) -> DMat3 {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z) * sign, z.cross(x) * sign, x.cross(y) * sign)
}
