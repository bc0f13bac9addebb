//! The triangles of a glTF file's meshes.

use super::super::error::Refusal;
use super::super::polygons::{indices_of_used, keep};
use super::accessors::Buffers;
use super::document::{Primitive, compression, unread};
use std::format;
use std::vec::Vec;

/// The numbers of the modes that make triangles.
const TRIANGLES: usize = 4;
const STRIP: usize = 5;
const FAN: usize = 6;

/// Triangles and the attributes of their vertices. Every vertex is used.
#[derive(Default)]
pub(super) struct Triangles {
    pub positions: Vec<[f32; 3]>,
    /// One per vertex; empty if the primitive has none.
    pub normals: Vec<[f32; 3]>,
    /// One linear colour per vertex; empty if the primitive has none.
    pub colours: Vec<[f32; 3]>,
    /// The joints of a skin. Most skins have one set.
    pub joints: Vec<JointSet>,
    pub triangles: Vec<[u32; 3]>,
}

/// Four joints of a skin per vertex.
pub(super) struct JointSet {
    pub joints: Vec<[f32; 4]>,
    /// The weight of each of these joints.
    pub weights: Vec<[f32; 4]>,
}

/// Returns the triangles of a primitive; `None` for points and lines.
///
/// # Errors
/// If its accessors do not fit together, or an index names no vertex.
pub(super) fn read(
    primitive: &Primitive,
    buffers: &mut Buffers,
) -> Result<Option<Triangles>, Refusal> {
    let mode = primitive.mode.unwrap_or(TRIANGLES);
    if !matches!(mode, TRIANGLES | STRIP | FAN) {
        return Ok(None);
    }
    let attribute = |name: &str| primitive.attributes.get(name).copied();
    let Some(positions) = attribute("POSITION") else {
        return Ok(Some(Triangles::default()));
    };
    let compression = compression(&primitive.extensions);
    if let Some(name) = compression.filter(|_| buffers.is_all_zeros(positions)) {
        return Err(unread(name));
    }
    let positions = buffers.read_vectors::<3>(positions)?;
    let vertices = positions.len();
    let normals = one_each(attribute("NORMAL"), vertices, buffers)?;
    let colours = one_each(attribute("COLOR_0"), vertices, buffers)?;
    let mut joints = Vec::new();
    for set in 0..primitive.attributes.len() {
        let own = [format!("JOINTS_{set}"), format!("WEIGHTS_{set}")];
        let [own @ Some(_), weights @ Some(_)] = own.map(|name| attribute(&name)) else {
            break;
        };
        joints.push(JointSet {
            joints: one_each(own, vertices, buffers)?,
            weights: one_each(weights, vertices, buffers)?,
        });
    }
    let corners = match primitive.indices {
        Some(accessor) => {
            let indices = buffers.read_indices(accessor)?;
            if let Some(index) = indices.iter().find(|&&index| index as usize >= vertices) {
                let last = vertices.saturating_sub(1);
                let problem = format!(
                    "vertex index {index} in accessor {accessor} is out of range: expected 0 to {last}"
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
    };
    Ok(Some(all.without_unused()))
}

/// Returns the elements of an accessor, one for each vertex; none without an accessor.
///
/// # Errors
/// If they cannot be read, or there are more or fewer.
fn one_each<const N: usize>(
    accessor: Option<usize>,
    vertices: usize,
    buffers: &mut Buffers,
) -> Result<Vec<[f32; N]>, Refusal> {
    let Some(accessor) = accessor else {
        return Ok(Vec::new());
    };
    let values = buffers.read_vectors::<N>(accessor)?;
    let found = values.len();
    if found == vertices {
        Ok(values)
    } else {
        let expected = format!("expected one for each of {vertices} vertices");
        Err(Refusal::whole(format!(
            "accessor {accessor} has {found} elements: {expected}"
        )))
    }
}

/// Returns the triangles of `corners`, whose order `mode` says.
fn triangles(mode: usize, corners: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        STRIP => {
            let three = corners.windows(3).enumerate();
            // Every second triangle of a strip is turned around, so that all face one way.
            let turned = |(i, three): (usize, &[u32])| match i % 2 {
                0 => [three[0], three[1], three[2]],
                _ => [three[1], three[0], three[2]],
            };
            three.map(turned).collect()
        }
        FAN => {
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
        for set in &mut self.joints {
            keep(&mut set.joints, &new);
            keep(&mut set.weights, &new);
        }
        let corners = self.triangles.as_flattened_mut().iter_mut();
        corners.for_each(|corner| *corner = new[*corner as usize]);
        self
    }
}
