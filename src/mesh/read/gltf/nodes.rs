//! The nodes of a glTF file: where they place meshes. Transforms are multiplied in `f64`.

use super::super::error::Refusal;
use super::accessors::Buffers;
use super::document::{Document, Node, Scene, entry, whole};
use super::primitives::Triangles;
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use std::collections::HashMap;
use std::vec::Vec;
use std::{format, vec};

/// The extension that places a node's mesh once for each element of its accessors.
const INSTANCES: &str = "EXT_mesh_gpu_instancing";

/// A node of the scene.
pub(super) struct Placed<'a> {
    pub index: usize,
    pub node: &'a Node,
    /// Its transform into the scene.
    pub world: DAffine3,
    /// False if the node or one above it is hidden (`KHR_node_visibility`).
    pub is_visible: bool,
}

/// Returns the nodes of the scene, in the order of the file.
///
/// # Errors
/// If a node is reached twice: nodes must form a tree.
pub(super) fn placed(document: &Document) -> Result<Vec<Placed<'_>>, Refusal> {
    let scene = match document.scene {
        Some(index) => Some(entry(&document.scenes, index, "scene")?),
        None => document.scenes.first(),
    };
    // A depth-first walk with a stack of nodes, the transform above each, and if all above are
    // visible. Each list goes onto it in reverse, so that nodes come in the order of the file.
    let roots = roots(document, scene).into_iter().rev();
    let mut open: Vec<(usize, DAffine3, bool)> =
        roots.map(|root| (root, DAffine3::IDENTITY, true)).collect();
    let mut seen = vec![false; document.nodes.len()];
    let mut found = Vec::new();
    while let Some((index, above, is_above_visible)) = open.pop() {
        let node = entry(&document.nodes, index, "node")?;
        if seen[index] {
            let problem = format!(
                "node {index} is its own ancestor, or has two parents: expected a tree of nodes"
            );
            return Err(Refusal::whole(problem));
        }
        seen[index] = true;
        let world = above * local(node);
        let is_visible =
            is_above_visible && node.extensions["KHR_node_visibility"]["visible"] != false;
        let children = node.children.iter().rev();
        open.extend(children.map(|child| (*child, world, is_visible)));
        found.push(Placed {
            index,
            node,
            world,
            is_visible,
        });
    }
    Ok(found)
}

/// Returns the nodes at the top of a scene. Without a scene these are the nodes that are no
/// children.
fn roots(document: &Document, scene: Option<&Scene>) -> Vec<usize> {
    if let Some(scene) = scene {
        return scene.nodes.clone();
    }
    let mut is_child = vec![false; document.nodes.len()];
    for child in document.nodes.iter().flat_map(|node| &node.children) {
        if let Some(is_child) = is_child.get_mut(*child) {
            *is_child = true;
        }
    }
    let nodes = 0..document.nodes.len();
    nodes.filter(|&node| !is_child[node]).collect()
}

/// Returns the transform of a node into its parent.
fn local(node: &Node) -> DAffine3 {
    if let Some(matrix) = node.matrix {
        return affine(matrix);
    }
    placing(
        node.translation.map_or(DVec3::ZERO, DVec3::from_array),
        node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array),
        node.scale.map_or(DVec3::ONE, DVec3::from_array),
    )
}

/// Returns a matrix, column by column, without its last row, which is 0 0 0 1 in glTF.
fn affine(matrix: [f64; 16]) -> DAffine3 {
    DAffine3::from_mat4(DMat4::from_cols_array(&matrix))
}

/// Returns the transform that scales, then turns, then moves. A rotation of length zero is none.
fn placing(translation: DVec3, turn: DQuat, scale: DVec3) -> DAffine3 {
    let is_turn = turn.length_squared() > 0.0 && turn.is_finite();
    let turn = if is_turn {
        turn.normalize()
    } else {
        DQuat::IDENTITY
    };
    DAffine3::from_scale_rotation_translation(scale, turn, translation)
}

/// The transforms of a node's mesh into the scene.
pub(super) struct Pose {
    /// The transform of all vertices, if there is no skin.
    transform: DAffine3,
    /// The transform of each joint of the skin.
    joints: Vec<DAffine3>,
}

/// Returns the poses of a visible node with a mesh: one, or one for each instance. `worlds` holds
/// the transforms of all nodes.
///
/// # Errors
/// If an accessor of the skin or of the instances cannot be read.
pub(super) fn poses(
    placed: &Placed,
    worlds: &HashMap<usize, DAffine3>,
    document: &Document,
    buffers: &mut Buffers,
) -> Result<Vec<Pose>, Refusal> {
    let transform = placed.world;
    let mut joints = Vec::new();
    if let Some(skin) = placed.node.skin {
        let skin = entry(&document.skins, skin, "skin")?;
        let world = |joint: &usize| worlds.get(joint).copied().unwrap_or(transform);
        joints.extend(skin.joints.iter().map(world));
        if let Some(accessor) = skin.inverse_bind_matrices {
            let matrices = buffers.read_vectors::<16>(accessor)?;
            for (joint, matrix) in joints.iter_mut().zip(&matrices) {
                *joint *= affine(matrix.map(f64::from));
            }
        }
    }
    // The nodes above a skinned mesh do not move it, and so do no instances.
    if !joints.is_empty() || placed.node.extensions[INSTANCES].is_null() {
        return Ok(vec![Pose { transform, joints }]);
    }
    let instances = instances(placed.node, buffers)?.into_iter();
    let pose = |instance: DAffine3| Pose {
        transform: transform * instance,
        joints: Vec::new(),
    };
    Ok(instances.map(pose).collect())
}

/// Returns the transforms of a node's instances.
fn instances(node: &Node, buffers: &mut Buffers) -> Result<Vec<DAffine3>, Refusal> {
    let accessor = |name: &str| whole(&node.extensions[INSTANCES]["attributes"][name]);
    let mut three = |name: &str| {
        let read = accessor(name).map(|accessor| buffers.read_vectors::<3>(accessor));
        read.transpose().map(Option::unwrap_or_default)
    };
    let (translations, scales) = (three("TRANSLATION")?, three("SCALE")?);
    let rotations = accessor("ROTATION").map(|accessor| buffers.read_vectors::<4>(accessor));
    let rotations = rotations.transpose()?.unwrap_or_default();
    let count = translations.len().max(scales.len()).max(rotations.len());
    let vector = |v: &[f32; 3]| DVec3::from_array(v.map(f64::from));
    let instance = |i: usize| {
        placing(
            translations.get(i).map_or(DVec3::ZERO, vector),
            rotations
                .get(i)
                .map_or(DQuat::IDENTITY, |v| DQuat::from_array(v.map(f64::from))),
            scales.get(i).map_or(DVec3::ONE, vector),
        )
    };
    // Attributes of applications alone place the mesh nowhere else.
    Ok((0..count.max(1)).map(instance).collect())
}

impl Pose {
    /// Returns the transform of vertex `v`. With a skin, it is the weighted mean of its joints'
    /// transforms.
    pub(super) fn of_vertex(&self, own: &Triangles, v: usize) -> DAffine3 {
        if self.joints.is_empty() {
            return self.transform;
        }
        let (mut matrix, mut translation, mut sum) = (DMat3::ZERO, DVec3::ZERO, 0.0);
        for set in &own.joints {
            for (joint, weight) in set.joints[v].iter().zip(&set.weights[v]) {
                let weight = f64::from(*weight);
                if let Some(joint) = self.joints.get(*joint as usize) {
                    matrix += weight * joint.matrix3;
                    translation += weight * joint.translation;
                    sum += weight;
                }
            }
        }
        if sum > 0.0 {
            DAffine3::from_mat3_translation(matrix * (1.0 / sum), translation / sum)
        } else {
            self.transform
        }
    }
}
