//! glTF 2.0 files: JSON with buffers, or one GLB file.
//!
//! The crate `gltf` reads and checks the JSON. All nodes of the scene become one mesh in the
//! coordinates of the scene; transforms are multiplied in `f64`. The format has no polygons other
//! than triangles. Triangles without normals are flat, as the specification says.

mod accessors;
mod primitives;
mod view;

pub(crate) use view::{FileLight, FileView, view};

use super::error::{Place, Refusal, quote};
use super::polygons::{POINTS_OR_LINES, Polygons, coloured, is_position, points_or_lines};
use super::words::text_end;
use super::{Beside, MeshFormat, Parts};
use crate::mesh::{Material, PolygonMesh};
use crate::note::{Note, Setting};
use accessors::Buffers;
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3, Vec3};
use gltf::json::validation::Checked;
use gltf::material::AlphaMode;
use gltf::scene::Transform;
use gltf::{Document, Node, Semantic};
use primitives::Triangles;
use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap};
use std::string::{String, ToString};
use std::vec::Vec;
use std::{format, vec};

/// The format.
pub(super) struct Gltf;

/// The first bytes of a GLB file.
const GLB: &[u8] = b"glTF";

/// Extensions that a file may require although the reader ignores them. Those of textures and
/// materials do not matter, because materials are drawn by their colours. Quantized numbers are
/// read like all others.
const HARMLESS: [&str; 5] = [
    "KHR_mesh_quantization",
    "KHR_texture_",
    "KHR_materials_",
    "EXT_texture_",
    "MSFT_texture_",
];

impl MeshFormat for Gltf {
    fn name(&self) -> &'static str {
        "a glTF file"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["gltf", "glb"]
    }

    fn recognises(&self, bytes: &[u8]) -> bool {
        let is_json = super::content::foreign(bytes) == Some("a glTF file (JSON)");
        bytes.starts_with(GLB) || is_json
    }

    fn read(&self, bytes: &[u8], beside: Beside) -> Result<Parts, Refusal> {
        let (document, bin) = parse(bytes)?;
        let buffers = Buffers::read(&document, bin, beside)?;
        let mut reader = Reader::default();
        let nodes = placed(&document)?;
        let worlds = nodes.iter().map(|(node, world)| (node.index(), *world));
        let worlds: HashMap<usize, DAffine3> = worlds.collect();
        for (node, transform) in nodes {
            let pose = pose(&node, transform, &worlds, &buffers)?;
            reader.node(&node, &pose, &buffers)?;
        }
        if reader.polygons.count() == 0 {
            let problem = if reader.polygons.notes.has(POINTS_OR_LINES) {
                "has points or lines but no triangle: expected a scene with meshes of triangles"
            } else {
                "has no triangle: expected a scene with meshes"
            };
            return Err(Refusal::whole(problem));
        }
        Ok(reader.finish())
    }
}

/// Reads and checks the JSON.
fn parse(bytes: &[u8]) -> Result<(Document, Option<Vec<u8>>), Refusal> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let bytes = if bytes.starts_with(GLB) {
        bytes
    } else {
        text_end(bytes)
    };
    if bytes.is_empty() {
        return Err(Refusal::whole("is empty: expected a glTF file"));
    }
    check_lengths(bytes)?;
    let read = gltf::Gltf::from_slice_without_validation(bytes);
    let read = read.map_err(|error| {
        if is_version_1(bytes) {
            Refusal::whole("is glTF 1.0: expected glTF 2.0 (`gltf-pipeline` converts it)")
        } else {
            refusal(error, bytes)
        }
    })?;
    let bin = read.blob;
    let mut json = read.document.into_json();
    let is_harmless = |name: &String| HARMLESS.iter().any(|start| name.starts_with(start));
    json.extensions_required.retain(|name| !is_harmless(name));
    let lacking = json.extensions_required.iter();
    let mut lacking = lacking.filter(|name| *name != "KHR_lights_punctual");
    if let Some(name) = lacking.next() {
        let advice = if name.contains("draco") || name.contains("meshopt") {
            ": expected a file that is not compressed (`gltf-transform copy`, or an export from Blender, writes one)"
        } else {
            ": expected a file that does without it"
        };
        let name = quote(name);
        let problem = format!("requires the extension {name}, which is not read{advice}");
        return Err(Refusal::whole(problem));
    }
    // The crate assumes that these indices exist when it checks the accessors behind them, and
    // would panic.
    let primitives = json.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let mut positions = primitives.filter_map(|primitive| {
        let positions = Checked::Valid(Semantic::Positions);
        primitive.attributes.get(&positions)
    });
    if let Some(index) = positions.find(|index| index.value() >= json.accessors.len()) {
        let (index, count) = (index.value(), json.accessors.len());
        let problem = match count {
            0 => {
                format!("uses accessor {index}: expected accessors in the file, but there are none")
            }
            _ => format!("uses accessor {index}: expected 0 to {}", count - 1),
        };
        return Err(Refusal::whole(problem));
    }
    let document = Document::from_json(json).map_err(|error| refusal(error, bytes))?;
    Ok((document, bin))
}

/// Checks that a GLB file and its chunks are as long as their headers say.
///
/// # Errors
/// For the first length that is past the end of the file, and for a length too short for the
/// headers.
fn check_lengths(bytes: &[u8]) -> Result<(), Refusal> {
    const HEADER: usize = 12;
    const OF_CHUNK: usize = 8;
    // Version 1 has another header.
    if !bytes.starts_with(GLB) || is_version_1(bytes) {
        return Ok(());
    }
    let have = bytes.len();
    let u32_at = |at: usize| {
        let four = bytes.get(at..).and_then(|rest| rest.first_chunk());
        four.map(|four| u32::from_le_bytes(*four) as usize)
    };
    let Some(length) = u32_at(8) else {
        let problem =
            format!("the file ends after {have} bytes: expected {HEADER} of a GLB header");
        return Err(Refusal::at(Place::Byte(have), problem));
    };
    if length > have {
        let problem = format!("the file says {length} bytes and has {have}: expected all of them");
        return Err(Refusal::at(Place::Byte(8), problem));
    }
    let least = HEADER + OF_CHUNK;
    if length < least {
        let problem = format!("the file says {length} bytes: expected at least {least}");
        return Err(Refusal::at(Place::Byte(8), problem));
    }
    let mut at = HEADER;
    for name in ["JSON", "binary"] {
        let Some(length) = u32_at(at).filter(|_| have - at >= OF_CHUNK) else {
            break;
        };
        let left = have - at - OF_CHUNK;
        if length > left {
            let problem = format!(
                "its {name} chunk says {length} bytes and has {left}: expected all of them"
            );
            return Err(Refusal::at(Place::Byte(at), problem));
        }
        at += OF_CHUNK + length;
    }
    Ok(())
}

/// True if a file says that it is glTF 1, whose JSON is different.
fn is_version_1(bytes: &[u8]) -> bool {
    if bytes.starts_with(GLB) {
        return bytes.get(4..8) == Some(&[1, 0, 0, 0]);
    }
    let json = gltf::json::deserialize::from_slice::<gltf::json::Value>(bytes);
    json.is_ok_and(|json| {
        let asset = &json["asset"];
        // The first drafts state the version with the profile. All of version 1 refers to objects
        // by name where 2.0 has lists and indices.
        let mut versions = [&asset["version"], &asset["profile"]["version"]].into_iter();
        json["meshes"].is_object()
            || versions.any(|version| {
                let text = version.as_str();
                text.is_some_and(|version| version.starts_with("1."))
            })
    })
}

/// Makes the error for a file that the crate refuses.
fn refusal(error: gltf::Error, bytes: &[u8]) -> Refusal {
    match error {
        gltf::Error::Deserialize(error) => {
            let text = error.to_string();
            let what = text.split(" at line ").next().unwrap_or_default();
            // Only a scene requires this key.
            let problem = match what {
                "missing field `nodes`" => {
                    "its scene has no `nodes`, so nothing is drawn: expected a list of nodes".into()
                }
                _ => format!("{}: expected the JSON of glTF 2.0", long_quote(what)),
            };
            if bytes.starts_with(GLB) || error.line() == 0 {
                Refusal::whole(problem)
            } else {
                Refusal::at(Place::Line(error.line()), problem)
            }
        }
        gltf::Error::Validation(errors) => {
            let more = match errors.len() {
                0 | 1 => String::new(),
                n => format!(" (and {} more)", n - 1),
            };
            let first = errors.first();
            let first = first.map(|(path, error)| format!("{path}: {error}"));
            let first = long_quote(&first.unwrap_or_default());
            Refusal::whole(format!("is no valid glTF 2.0: {first}{more}"))
        }
        error => Refusal::whole(format!(
            "{}: expected glTF 2.0",
            long_quote(&error.to_string())
        )),
    }
}

/// Returns a message of the crate in one line. The message may quote names of the file.
fn long_quote(text: &str) -> String {
    let text: String = text.chars().take(160).collect();
    text.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

/// Returns the nodes of the scene with their transforms into the scene.
///
/// # Errors
/// If a node is reached twice: nodes must form a tree.
fn placed(document: &Document) -> Result<Vec<(Node<'_>, DAffine3)>, Refusal> {
    let scene = document
        .default_scene()
        .or_else(|| document.scenes().next());
    let mut open: Vec<(Node, DAffine3)> = match &scene {
        Some(scene) => scene
            .nodes()
            .map(|node| (node, DAffine3::IDENTITY))
            .collect(),
        None => {
            let children = document.nodes().flat_map(|node| node.children());
            let children: BTreeSet<usize> = children.map(|node| node.index()).collect();
            let roots = document
                .nodes()
                .filter(|node| !children.contains(&node.index()));
            roots.map(|node| (node, DAffine3::IDENTITY)).collect()
        }
    };
    // A depth-first walk with a stack. Each list goes onto it in reverse, so that nodes come in the
    // order of the file.
    open.reverse();
    let mut seen = vec![false; document.nodes().len()];
    let mut found = Vec::new();
    while let Some((node, above)) = open.pop() {
        let index = node.index();
        if seen[index] {
            let problem = format!(
                "node {index} is its own ancestor, or has two parents: expected a tree of nodes"
            );
            return Err(Refusal::whole(problem));
        }
        seen[index] = true;
        let transform = above * local(&node);
        let before = open.len();
        open.extend(node.children().map(|child| (child, transform)));
        open[before..].reverse();
        found.push((node, transform));
    }
    Ok(found)
}

/// Returns the transform of a node into its parent.
fn local(node: &Node) -> DAffine3 {
    let three = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    match node.transform() {
        Transform::Matrix { matrix } => {
            let [x, y, z, w] = matrix.map(|[x, y, z, _]| three([x, y, z]));
            DAffine3::from_mat3_translation(DMat3::from_cols(x, y, z), w)
        }
        Transform::Decomposed {
            translation,
            rotation,
            scale,
        } => {
            let turn = DQuat::from_array(rotation.map(f64::from));
            let is_turn = turn.length_squared() > 0.0 && turn.is_finite();
            let turn = if is_turn {
                turn.normalize()
            } else {
                DQuat::IDENTITY
            };
            DAffine3::from_scale_rotation_translation(three(scale), turn, three(translation))
        }
    }
}

/// The transforms of a node's mesh into the scene.
struct Pose {
    /// The transform of all vertices, if there is no skin.
    transform: DAffine3,
    /// The transform of each joint of the skin.
    joints: Vec<DAffine3>,
}

/// Returns the pose of a node. `transform` is its own transform into the scene, and `worlds` holds
/// the transforms of all nodes.
fn pose(
    node: &Node,
    transform: DAffine3,
    worlds: &HashMap<usize, DAffine3>,
    buffers: &Buffers,
) -> Result<Pose, Refusal> {
    let mut joints = Vec::new();
    if let Some(skin) = node.skin().filter(|_| node.mesh().is_some()) {
        let world = |joint: Node| worlds.get(&joint.index()).copied();
        joints.extend(skin.joints().map(|joint| world(joint).unwrap_or(transform)));
        if let Some(accessor) = skin.inverse_bind_matrices() {
            let matrices = buffers.read_vectors::<16>(&accessor)?;
            for (joint, matrix) in joints.iter_mut().zip(&matrices) {
                let matrix = DMat4::from_cols_array(&matrix.map(f64::from));
                *joint *= DAffine3::from_mat4(matrix);
            }
        }
    }
    Ok(Pose { transform, joints })
}

impl Pose {
    /// Returns the transform of vertex `v`. With a skin, it is the weighted mean of its joints'
    /// transforms.
    fn of_vertex(&self, own: &Triangles, v: usize) -> DAffine3 {
        let (Some(joints), Some(weights)) = (own.joints.get(v), own.weights.get(v)) else {
            return self.transform;
        };
        let (mut matrix, mut translation, mut sum) = (DMat3::ZERO, DVec3::ZERO, 0.0);
        for (joint, weight) in joints.iter().zip(weights) {
            let weight = f64::from(*weight);
            if let Some(joint) = self.joints.get(*joint as usize) {
                matrix += weight * joint.matrix3;
                translation += weight * joint.translation;
                sum += weight;
            }
        }
        if sum > 0.0 {
            DAffine3::from_mat3_translation(matrix * (1.0 / sum), translation / sum)
        } else {
            self.transform
        }
    }
}

/// The polygons of the nodes that were read so far.
#[derive(Default)]
struct Reader {
    polygons: Polygons,
    /// The triangles of primitives that were read before, by the indices of mesh and primitive.
    /// Many nodes may share a mesh.
    known: HashMap<(usize, usize), Option<Triangles>>,
    /// The material of the mesh for each material of the file.
    materials: HashMap<usize, u32>,
    has_normals: bool,
    has_colours: bool,
    /// How many primitives were placed.
    primitives: usize,
    /// How many of them have no normals.
    flat: usize,
}

impl Reader {
    fn node(&mut self, node: &Node, pose: &Pose, buffers: &Buffers) -> Result<(), Refusal> {
        let Some(mesh) = node.mesh() else {
            return Ok(());
        };
        let weights = node.weights().or_else(|| mesh.weights());
        if weights.is_some_and(|weights| weights.iter().any(|weight| *weight != 0.0)) {
            self.warn("morph-targets", "morph targets are not applied");
        }
        for primitive in mesh.primitives() {
            let key = (mesh.index(), primitive.index());
            if let Entry::Vacant(unread) = self.known.entry(key) {
                unread.insert(primitives::read(&primitive, buffers)?);
            }
            let material = primitive.material();
            let material = material.index().map(|index| {
                let known = self.materials.get(&index).copied();
                known.unwrap_or_else(|| self.material(index, &material))
            });
            // Taken out while `place` borrows the reader, and put back.
            match self.known.remove(&key).flatten() {
                Some(triangles) => {
                    self.place(&triangles, pose, material)?;
                    self.known.insert(key, Some(triangles));
                }
                None => {
                    self.known.insert(key, None);
                    self.polygons.notes.push(points_or_lines());
                }
            }
        }
        Ok(())
    }

    /// Adds a material of the file.
    fn material(&mut self, index: usize, material: &gltf::Material) -> u32 {
        let metallic = material.pbr_metallic_roughness();
        let specular = material.pbr_specular_glossiness();
        let [r, g, b, _] = match &specular {
            Some(specular) => specular.diffuse_factor(),
            None => metallic.base_color_factor(),
        };
        let has_texture = match &specular {
            Some(specular) => specular.diffuse_texture().is_some(),
            None => metallic.base_color_texture().is_some(),
        };
        if has_texture || material.normal_texture().is_some() {
            self.warn("material/texture", "textures are not drawn");
        }
        if material.alpha_mode() != AlphaMode::Opaque {
            let text = "transparency is not drawn, all surfaces are opaque";
            self.warn("material/transparency", text);
        }
        if material.emissive_factor() != [0.0; 3] {
            self.warn("material/emission", "emission is not drawn");
        }
        let channel = |channel: f32| {
            if channel.is_finite() {
                channel.clamp(0.0, 1.0)
            } else {
                1.0
            }
        };
        let own: Material = coloured([r, g, b].map(channel));
        let name = material.name().map(quote).unwrap_or_default();
        let added = self.polygons.add_material(own, name);
        self.materials.insert(index, added);
        added
    }

    /// Adds a warning, unless it is there.
    fn warn(&mut self, kind: &'static str, text: &'static str) {
        self.polygons.notes.push(Note::warning(kind, text));
    }

    /// Adds triangles where a node places them.
    fn place(
        &mut self,
        own: &Triangles,
        pose: &Pose,
        material: Option<u32>,
    ) -> Result<(), Refusal> {
        let before = self.polygons.positions.len();
        let most = PolygonMesh::MAX_CORNERS;
        if own.positions.len() > most - before {
            let problem = format!("too many corners: expected at most {most}");
            return Err(Refusal::whole(problem));
        }
        self.place_vertices(own, pose)?;
        let is_flat = own.normals.is_empty();
        self.primitives += 1;
        self.flat += usize::from(is_flat);
        // A mirroring transform turns the winding around, so its triangles are turned back.
        let is_mirrored = pose.of_vertex(own, 0).matrix3.determinant() < 0.0;
        let polygons = &mut self.polygons;
        for triangle in &own.triangles {
            let mut corners = triangle.map(|corner| before as u32 + corner);
            if is_mirrored {
                corners.swap(1, 2);
            }
            polygons.corners.extend(corners);
            if polygons.end_polygon(Place::Byte(0))? {
                polygons.set_flat(is_flat);
                if let Some(material) = material {
                    polygons.set_material(material);
                }
            }
        }
        Ok(())
    }

    /// Adds the vertices of triangles.
    fn place_vertices(&mut self, own: &Triangles, pose: &Pose) -> Result<(), Refusal> {
        let polygons = &mut self.polygons;
        let before = polygons.positions.len();
        let three = |v: &[f32; 3]| DVec3::from_array(v.map(f64::from));
        for (v, position) in own.positions.iter().enumerate() {
            let position = pose.of_vertex(own, v).transform_point3(three(position));
            if !is_position(position) {
                let problem = "a position is not finite, or its node moves it past 3.4e38: expected finite numbers";
                return Err(Refusal::whole(problem));
            }
            polygons.positions.push(position);
        }
        self.has_normals |= !own.normals.is_empty();
        if self.has_normals {
            // Earlier vertices without normals get zeros.
            polygons.normals.resize(before, DVec3::ZERO);
            // The cofactor matrix: the inverse transpose times the determinant, whose sign is taken
            // off. It needs no inverse, so a flattening transform does no harm.
            let turned = |(v, n): (usize, &[f32; 3])| {
                let matrix = pose.of_vertex(own, v).matrix3;
                let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
                let (n, sign) = (three(n), matrix.determinant().signum());
                sign * (y.cross(z) * n.x + z.cross(x) * n.y + x.cross(y) * n.z)
            };
            let turned = own.normals.iter().enumerate().map(turned);
            polygons.normals.extend(turned);
            polygons
                .normals
                .resize(polygons.positions.len(), DVec3::ZERO);
        }
        self.has_colours |= !own.colours.is_empty();
        if self.has_colours {
            // Vertices without a colour get white, which changes nothing.
            polygons.colours.resize(before, Vec3::ONE);
            let colours = own.colours.iter().map(|c| Vec3::from_array(*c));
            polygons.colours.extend(colours);
            polygons.colours.resize(polygons.positions.len(), Vec3::ONE);
        }
        Ok(())
    }

    fn finish(mut self) -> Parts {
        if self.flat > 0 {
            let (flat, all) = (self.flat, self.primitives);
            let which = if flat == all {
                "the file has no normals".into()
            } else {
                format!("{flat} of {all} parts have no normals")
            };
            let text = format!("{which}: drawn flat, as glTF says; ");
            let note = Note::warning("normals-missing", text)
                .set(Setting::word("object.normals", "averaged"))
                .say(" or ")
                .set(Setting::number("object.crease", "40"))
                .say(" smooths");
            self.polygons.notes.push(note);
        }
        let mut parts = self.polygons.finish();
        parts.builder.up_by_custom('y');
        parts
    }
}
