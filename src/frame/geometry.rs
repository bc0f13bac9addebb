//! The part of a frame that does not depend on the camera. All frames of one scene share it.

use super::Polygon;
use alloc::vec::Vec;
use glam::{DAffine3, DVec3};

/// The attributes of vertices, and the corner lists and normals of polygons.
#[derive(Clone, Debug, Default)]
#[doc(hidden)]
pub struct Geometry {
    /// Unit vertex normals in world space.
    pub normals: Vec<[f32; 3]>,
    /// The lighting of each vertex, an index.
    pub materials: Vec<u32>,
    /// Four values per vertex, or an empty list: a colour and 1 where a mesh set no other
    /// attributes.
    pub attributes: Vec<[f32; 4]>,
    /// Positions relative to the frame's origin, one per vertex. If empty, positions come from
    /// [`Geometry::models`].
    pub positions: Vec<[f32; 3]>,
    /// Positions in model space, one per vertex, or none.
    pub models: Models,
    /// True if every vertex exists a second time, with its normal negated. The second half follows
    /// all others in order.
    pub two_sided: bool,
    /// The corner lists of all polygons. If there are two sides, they follow once more with the
    /// vertices of the second side.
    pub corners: Vec<u32>,
    /// Unit normals of polygons in world space.
    pub faces: Vec<[f32; 3]>,
}

/// Positions in model space, object after object. Each coordinate has its own array.
#[derive(Clone, Debug, Default)]
#[doc(hidden)]
pub struct Models {
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    pub z: Vec<f32>,
    pub objects: Vec<PlacedModel>,
}

/// An object's vertices, which follow the vertices of the object before, and its place in the
/// world.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct PlacedModel {
    /// The vertex after its last one.
    pub end: usize,
    /// The transform from model space to world space.
    pub transform: DAffine3,
    /// The largest magnitude of a coordinate along each axis of model space.
    pub extent: DVec3,
}

impl PlacedModel {
    /// Returns the largest distance of the object's positions from its translation, along each axis
    /// of the world. It is an upper bound.
    pub fn reach(&self) -> DVec3 {
        let linear = self.transform.matrix3;
        linear.x_axis.abs() * self.extent.x
            + linear.y_axis.abs() * self.extent.y
            + linear.z_axis.abs() * self.extent.z
    }
}

impl Models {
    /// Returns how many vertices there are.
    pub fn count(&self) -> usize {
        self.x.len()
    }

    /// Returns the position of a vertex in model space.
    #[inline(always)]
    pub fn position(&self, vertex: usize) -> DVec3 {
        DVec3::new(
            self.x[vertex].into(),
            self.y[vertex].into(),
            self.z[vertex].into(),
        )
    }

    /// Returns the index of the object that a vertex belongs to.
    #[inline]
    pub fn object_of(&self, vertex: usize) -> usize {
        self.objects.partition_point(|object| object.end <= vertex)
    }
}

impl Geometry {
    /// The attributes of a vertex for which none were set.
    pub const NO_ATTRIBUTES: [f32; 4] = [1.0; 4];

    /// Returns how many vertices there are, on both sides together.
    #[inline(always)]
    pub fn vertex_count(&self) -> usize {
        self.normals.len() * if self.two_sided { 2 } else { 1 }
    }

    #[inline(always)]
    pub fn normal(&self, vertex: u32) -> [f32; 3] {
        match self.normals.get(vertex as usize) {
            Some(normal) => *normal,
            None => self
                .front(vertex)
                .map_or([0.0, 0.0, 1.0], |front| self.normals[front].map(|n| -n)),
        }
    }

    /// Returns the material of a vertex; `None` for vertices that clipping made.
    #[inline(always)]
    pub fn material(&self, vertex: u32) -> Option<u32> {
        match self.materials.get(vertex as usize) {
            Some(material) => Some(*material),
            None => self.front(vertex).map(|front| self.materials[front]),
        }
    }

    #[inline(always)]
    pub fn attributes(&self, vertex: u32) -> [f32; 4] {
        if self.attributes.is_empty() {
            return Geometry::NO_ATTRIBUTES;
        }
        let front = if (vertex as usize) < self.normals.len() {
            Some(vertex as usize)
        } else {
            self.front(vertex)
        };
        front
            .and_then(|front| self.attributes.get(front))
            .copied()
            .unwrap_or(Geometry::NO_ATTRIBUTES)
    }

    /// Returns the position of a vertex relative to `origin`.
    #[inline(always)]
    pub fn position(&self, vertex: u32, origin: [f64; 3]) -> [f32; 3] {
        match self.positions.get(vertex as usize) {
            Some(position) => *position,
            None => self.position_of_model(vertex, origin),
        }
    }

    fn position_of_model(&self, vertex: u32, origin: [f64; 3]) -> [f32; 3] {
        let vertex = vertex as usize;
        let front = if vertex < self.models.count() {
            Some(vertex)
        } else {
            self.front(vertex as u32)
        };
        let Some(front) = front.filter(|&front| front < self.models.count()) else {
            return [0.0; 3];
        };
        let transform = &self.models.objects[self.models.object_of(front)].transform;
        (transform.transform_point3(self.models.position(front)) - DVec3::from_array(origin))
            .as_vec3()
            .to_array()
    }

    /// Returns the vertex on the first side that a vertex on the second side copies; `None` for a
    /// vertex on the first side.
    #[inline]
    fn front(&self, vertex: u32) -> Option<usize> {
        let front = (vertex as usize).checked_sub(self.normals.len())?;
        (self.two_sided && front < self.normals.len()).then_some(front)
    }

    #[inline(always)]
    pub fn face(&self, face: u32) -> [f32; 3] {
        let normal = self.faces[(face & !Polygon::FLIPPED) as usize];
        if face & Polygon::FLIPPED == 0 {
            normal
        } else {
            normal.map(|n| -n)
        }
    }
}
