//! An object in the world and in the camera's space.

use crate::camera::{Camera, Seen, unit};
use crate::clip::{Vertex, clipped, is_inside};
use crate::lighting::Point;
use crate::normals::{Normals, normals};
use crate::options::{
    MirroredWinding, ModelMatrix, NormalAxes, NormalCode, NormalSpace, NormalTransform, Options,
    VertexNormal,
};
use fastphong::mesh::PolygonMesh;
use fastphong::scene::Object;
use glam::{DAffine3, DMat3, DVec3};

/// An object in the world.
pub struct Placed<'a> {
    pub mesh: &'a PolygonMesh,
    camera: &'a Camera,
    normals: Normals,
    /// The positions of the mesh in world space and in the camera's space.
    positions: Vec<(DVec3, Seen)>,
    /// The transform of a normal: a matrix, and a vector that is added.
    normal_matrix: DMat3,
    normal_offset: DVec3,
    normal_axes: NormalAxes,
    normal_code: NormalCode,
    /// True if vertex normals are unit vectors in the world.
    is_unit: bool,
    is_in_eye_space: bool,
    is_reversed: bool,
}

impl<'a> Placed<'a> {
    /// Places `object`.
    pub fn new(object: &'a Object, camera: &'a Camera, options: &Options) -> Placed<'a> {
        let transform = model_matrix(object, options);
        let to_world = transform * DAffine3::from_translation(object.mesh.origin());
        let positions = object.mesh.positions().iter().map(|p| {
            let position = to_world.transform_point3(p.as_dvec3());
            (position, camera.see(position))
        });
        let matrix = transform.matrix3;
        let (normal_matrix, normal_offset) = match options.normal_transform {
            NormalTransform::InverseTranspose => (matrix.inverse().transpose(), DVec3::ZERO),
            NormalTransform::Matrix => (matrix, DVec3::ZERO),
            NormalTransform::Inverse => (matrix.inverse(), DVec3::ZERO),
            NormalTransform::Missing => (DMat3::IDENTITY, DVec3::ZERO),
            NormalTransform::AsPoint => (matrix, transform.translation),
        };
        let is_restored = options.mirrored_winding == MirroredWinding::Restored;
        Placed {
            mesh: &object.mesh,
            camera,
            normals: normals(&object.mesh, object.normals.source, options),
            positions: positions.collect(),
            normal_matrix,
            normal_offset,
            normal_axes: options.normal_axes,
            normal_code: options.normal_code,
            is_unit: options.vertex_normal != VertexNormal::SumKept,
            is_in_eye_space: options.normal_space == NormalSpace::Eye,
            is_reversed: matrix.determinant() < 0.0 && is_restored,
        }
    }

    /// Returns the corners of polygon `p`.
    pub fn vertices(&self, p: usize) -> Vec<Vertex> {
        let corners = self.mesh.corner_range(p).zip(self.mesh.polygon(p));
        corners
            .map(|(corner, &c)| {
                let (position, seen) = self.positions[c as usize];
                let normal = self.to_world(self.normals.corners[corner], self.is_unit);
                Vertex {
                    seen,
                    point: Point::new(position, normal),
                    computed: DVec3::ZERO,
                }
            })
            .collect()
    }

    /// Returns the normal of polygon `p`.
    pub fn polygon_normal(&self, p: usize) -> DVec3 {
        self.to_world(self.normals.polygons[p], true)
    }

    /// Returns a normal of the world as the student reads it from a file.
    fn read(&self, n: DVec3) -> DVec3 {
        let n = match self.normal_axes {
            NormalAxes::AsGiven => n,
            NormalAxes::XNegated => DVec3::new(-n.x, n.y, n.z),
            NormalAxes::YNegated => DVec3::new(n.x, -n.y, n.z),
            NormalAxes::ZNegated => DVec3::new(n.x, n.y, -n.z),
            NormalAxes::XyExchanged => DVec3::new(n.y, n.x, n.z),
            NormalAxes::XzExchanged => DVec3::new(n.z, n.y, n.x),
            NormalAxes::YzExchanged => DVec3::new(n.x, n.z, n.y),
        };
        match self.normal_code {
            // A polygon without area has no normal to read.
            NormalCode::Halved if n != DVec3::ZERO => n / 2.0 + 0.5,
            NormalCode::Plain | NormalCode::Halved => n,
        }
    }

    fn to_world(&self, normal: DVec3, is_unit: bool) -> DVec3 {
        let vector = self.normal_matrix * normal + self.normal_offset;
        let vector = self.read(if is_unit { unit(vector) } else { vector });
        if self.is_in_eye_space {
            self.camera.turned(vector)
        } else {
            vector
        }
    }

    /// Returns a value over 0 for a polygon that is seen from outside, below 0 for one seen from
    /// inside, and 0 for one that is not seen.
    pub fn side(&self, p: usize) -> f64 {
        if self.normals.polygons[p] == DVec3::ZERO {
            return 0.0;
        }
        let corners = self.mesh.polygon(p);
        let seen = |c: &u32| &self.positions[*c as usize].1;
        let is_whole = corners.iter().all(|c| is_inside(self.camera, seen(c)));
        let area = if is_whole {
            area(corners.iter().map(|c| self.camera.device(seen(c))))
        } else {
            let vertices = self.vertices(p);
            let part = clipped(self.camera, &vertices);
            area(part.iter().map(|v| self.camera.device(&v.seen)))
        };
        if self.is_reversed { -area } else { area }
    }
}

/// Returns the transform of an object's points from model space to world space.
fn model_matrix(object: &Object, options: &Options) -> DAffine3 {
    let DAffine3 {
        matrix3,
        translation,
    } = object.transform;
    match options.model_matrix {
        ModelMatrix::Right => object.transform,
        ModelMatrix::Transposed => DAffine3 {
            matrix3: matrix3.transpose(),
            translation,
        },
        ModelMatrix::Missing => DAffine3::IDENTITY,
    }
}

/// Returns twice the signed area of a polygon: over 0 if it runs counter-clockwise, with y upward.
fn area(mut places: impl Iterator<Item = [f64; 2]>) -> f64 {
    let Some([x, y]) = places.next() else {
        return 0.0;
    };
    let mut last = [0.0, 0.0];
    let mut sum = 0.0;
    for place in places {
        let place = [place[0] - x, place[1] - y];
        sum += last[0] * place[1] - last[1] * place[0];
        last = place;
    }
    sum
}
