//! The triangles of a glTF file's meshes.

use super::super::error::Refusal;
use super::super::polygons::{indices_of_used, keep};
use super::accessors::Buffers;
use gltf::mesh::Mode;
use gltf::{Primitive, Semantic};
use std::format;
use std::vec::Vec;

/// Triangles and the attributes of their vertices. Every vertex is used.
#[derive(Default)]
pub(super) struct Triangles {
    pub positions: Vec<[f32; 3]>,
    /// One per vertex; empty if the primitive has none.
    pub normals: Vec<[f32; 3]>,
    /// One linear colour per vertex; empty if the primitive has none.
    pub colours: Vec<[f32; 3]>,
    /// Up to four joints of a skin per vertex; empty if the primitive has none.
    pub joints: Vec<[f32; 4]>,
    /// The weight of each of these joints.
    pub weights: Vec<[f32; 4]>,
    pub triangles: Vec<[u32; 3]>,
}

/// Returns the triangles of a primitive; `None` for points and lines.
///
/// # Errors
/// If its accessors do not fit together, or an index names no vertex.
pub(super) fn read(primitive: &Primitive, buffers: &Buffers) -> Result<Option<Triangles>, Refusal> {
    let mode = primitive.mode();
    if !matches!(
        mode,
        Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
    ) {
        return Ok(None);
    }
    let Some(positions) = primitive.get(&Semantic::Positions) else {
        return Ok(Some(Triangles::default()));
    };
    let positions = buffers.read_vectors::<3>(&positions)?;
    let vertices = positions.len();
    let one_each = |semantic: Semantic| {
        let accessor = primitive.get(&semantic);
        let read =
            accessor.map(|accessor| (accessor.index(), buffers.read_vectors::<3>(&accessor)));
        match read {
            None => Ok(Vec::new()),
            Some((_, Err(refusal))) => Err(refusal),
            Some((_, Ok(values))) if values.len() == vertices => Ok(values),
            Some((index, Ok(values))) => {
                let found = values.len();
                let problem = format!(
                    "accessor {index} has {found} elements: expected one for each of {vertices} vertices"
                );
                Err(Refusal::whole(problem))
            }
        }
    };
    let normals = one_each(Semantic::Normals)?;
    let colours = one_each(Semantic::Colors(0))?;
    let four = |semantic: Semantic| {
        let accessor = primitive.get(&semantic);
        let read = accessor.map(|accessor| buffers.read_vectors::<4>(&accessor));
        read.transpose().map(Option::unwrap_or_default)
    };
    let (mut joints, mut weights) = (four(Semantic::Joints(0))?, four(Semantic::Weights(0))?);
    if joints.len() != vertices || weights.len() != vertices {
        (joints, weights) = (Vec::new(), Vec::new());
    }
    let corners = match primitive.indices() {
        Some(accessor) => {
            let indices = buffers.read_indices(&accessor)?;
            if let Some(index) = indices.iter().find(|&&index| index as usize >= vertices) {
                let (of, last) = (accessor.index(), vertices.saturating_sub(1));
                let problem = format!(
                    "vertex index {index} in accessor {of} is out of range: expected 0 to {last}"
                );
                return Err(Refusal::whole(problem));
            }
            indices
        }
        None => (0..u32::try_from(vertices).unwrap_or(u32::MAX)).collect(),
    };
    let all = Triangles {
        triangles: triangles(mode, &corners),
        positions,
        normals,
        colours,
        joints,
        weights,
    };
    Ok(Some(all.without_unused()))
}

/// Returns the triangles of `corners`, whose order `mode` says.
fn triangles(mode: Mode, corners: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => {
            let three = corners.windows(3).enumerate();
            // Every second triangle of a strip is turned around, so that all face one way.
            let turned = |(i, three): (usize, &[u32])| match i % 2 {
                0 => [three[0], three[1], three[2]],
                _ => [three[1], three[0], three[2]],
            };
            three.map(turned).collect()
        }
        Mode::TriangleFan => {
            let two = corners.get(1..).unwrap_or_default().windows(2);
            two.map(|two| [corners[0], two[0], two[1]]).collect()
        }
        _ => {
            let three = corners.chunks_exact(3);
            three.map(|three| [three[0], three[1], three[2]]).collect()
        }
    }
}

impl Triangles {
    /// Drops vertices that no triangle uses. This is worth it because many nodes may place one
    /// mesh.
    fn without_unused(mut self) -> Self {
        let count = self.positions.len();
        let Some(new) = indices_of_used(self.triangles.as_flattened(), count) else {
            return self;
        };
        for values in [&mut self.positions, &mut self.normals, &mut self.colours] {
            keep(values, &new);
        }
        for values in [&mut self.joints, &mut self.weights] {
            keep(values, &new);
        }
        let corners = self.triangles.as_flattened_mut().iter_mut();
        corners.for_each(|corner| *corner = new[*corner as usize]);
        self
    }
}
