//! The JSON of a glTF file, as far as it is drawn.
//!
//! Everything else in the file may be of any form: `extras`, animations, textures, attributes of
//! applications, unknown extensions. Indices are checked where they are followed, by [`entry`], so
//! that a part that is not drawn never makes a file unreadable.

use super::super::error::{Place, Refusal, quote};
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

/// The lists of a file. What is small, or differs between files, is kept as JSON: materials,
/// cameras, and everything in `extensions`.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Document {
    asset: Value,
    extensions_required: Vec<String>,
    pub scene: Option<usize>,
    pub scenes: Vec<Scene>,
    pub nodes: Vec<Node>,
    pub meshes: Vec<Mesh>,
    pub materials: Vec<Value>,
    pub skins: Vec<Skin>,
    pub cameras: Value,
    pub accessors: Vec<Accessor>,
    pub buffer_views: Vec<View>,
    pub buffers: Vec<Buffer>,
    pub extensions: Value,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Scene {
    pub nodes: Vec<usize>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Node {
    pub children: Vec<usize>,
    pub mesh: Option<usize>,
    pub skin: Option<usize>,
    pub camera: Option<usize>,
    pub matrix: Option<[f64; 16]>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    /// The weights of morph targets.
    pub weights: Option<Vec<f64>>,
    pub extensions: Value,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Mesh {
    pub primitives: Vec<Primitive>,
    pub weights: Option<Vec<f64>>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Primitive {
    /// The accessor of each attribute.
    pub attributes: BTreeMap<String, usize>,
    pub indices: Option<usize>,
    pub material: Option<usize>,
    pub mode: Option<usize>,
    pub extensions: Value,
}

#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Skin {
    pub joints: Vec<usize>,
    pub inverse_bind_matrices: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: usize,
    pub component_type: usize,
    #[serde(default)]
    pub normalized: bool,
    pub count: usize,
    #[serde(rename = "type")]
    pub kind: String,
    pub sparse: Option<Sparse>,
    /// The ends of a box around positions.
    #[serde(default)]
    pub min: Value,
    #[serde(default)]
    pub max: Value,
}

/// Elements that are replaced one by one.
#[derive(Deserialize)]
pub(super) struct Sparse {
    pub count: usize,
    pub indices: SparsePart,
    pub values: SparsePart,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparsePart {
    pub buffer_view: usize,
    #[serde(default)]
    pub byte_offset: usize,
    /// The type of indices. Values have the type of their accessor.
    #[serde(default)]
    pub component_type: usize,
}

#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct View {
    pub buffer: usize,
    pub byte_offset: usize,
    pub byte_length: usize,
    pub byte_stride: usize,
    pub extensions: Value,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Buffer {
    pub uri: Option<String>,
    pub extensions: Value,
}

/// Returns the whole number `value`, if it is one.
pub(super) fn whole(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

/// Returns the numbers in `value`; `None` if it is no list of `N` numbers.
pub(super) fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let list = value.as_array().filter(|list| list.len() == N)?;
    let mut numbers = [0.0; N];
    for (number, value) in numbers.iter_mut().zip(list) {
        *number = value.as_f64()?;
    }
    Some(numbers)
}

/// Returns the name of the extension that compresses the data of a primitive, view or buffer.
pub(super) fn compression(extensions: &Value) -> Option<&str> {
    let names = extensions.as_object()?.keys();
    let mut names = names.map(|name| name.as_str());
    names.find(|name| is_compression(name))
}

fn is_compression(name: &str) -> bool {
    name.contains("draco") || name.contains("meshopt")
}

/// Extensions that a file may require. Those of textures and materials do not matter, because
/// materials are drawn by their colours; quantized numbers are read like all others, and animations
/// are not played.
const READ: [&str; 9] = [
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_animation_pointer",
    "EXT_mesh_gpu_instancing",
    "KHR_texture_",
    "KHR_materials_",
    "EXT_texture_",
    "MSFT_texture_",
];

/// Reads the JSON of a file.
///
/// # Errors
/// If it is no JSON, something that is drawn has another type than in glTF 2.0, or the file
/// requires an extension that is not read.
pub(super) fn parse(json: &[u8], is_glb: bool) -> Result<Document, Refusal> {
    let read = serde_json::from_slice(json);
    let document: Document =
        read.or_else(|error| second_try(json).ok_or_else(|| refusal(&error, json, is_glb)))?;
    if is_asset_1(&document.asset) {
        return Err(version_1());
    }
    let is_read = |name: &String| READ.iter().any(|start| name.starts_with(start));
    let mut required = document.extensions_required.iter();
    match required.find(|name| !is_read(name)) {
        Some(name) => Err(unread(name)),
        None => Ok(document),
    }
}

/// Reads the JSON of a file that writes whole numbers as `3.0` or `3e0`, which glTF 2.0 allows and
/// `serde_json` does not. `None` if it still is not as glTF 2.0 says.
fn second_try(json: &[u8]) -> Option<Document> {
    fn make_whole(value: &mut Value) {
        /// All whole numbers up to this are exact in an `f64`.
        const MOST: f64 = 9_007_199_254_740_992.0;
        match value {
            Value::Array(values) => values.iter_mut().for_each(make_whole),
            Value::Object(values) => values.values_mut().for_each(make_whole),
            Value::Number(number) => {
                let whole = number
                    .as_f64()
                    .filter(|n| n.fract() == 0.0 && n.abs() < MOST);
                if let Some(whole) = whole {
                    *number = (whole as i64).into();
                }
            }
            _ => {}
        }
    }
    let mut value = serde_json::from_slice(json).ok()?;
    make_whole(&mut value);
    // As text, because reading from a `Value` would double the code of all structs.
    serde_json::from_slice(&serde_json::to_vec(&value).ok()?).ok()
}

/// Makes the error for an extension that the file needs.
pub(super) fn unread(name: &str) -> Refusal {
    let advice = if is_compression(name) {
        ": expected a file that is not compressed (`gltf-transform copy`, or an export from Blender, writes one)"
    } else {
        ": expected a file that does without it"
    };
    let name = quote(name);
    Refusal::whole(format!(
        "requires the extension {name}, which is not read{advice}"
    ))
}

/// Makes the error for a file of version 1.
pub(super) fn version_1() -> Refusal {
    Refusal::whole("is glTF 1.0: expected glTF 2.0 (`gltf-pipeline` converts it)")
}

/// True if a file says that it is glTF 1, whose JSON is different: it refers to objects by name
/// where 2.0 has lists and indices.
fn is_version_1(json: &Value) -> bool {
    json["meshes"].is_object() || is_asset_1(&json["asset"])
}

/// True if the version is 1. The first drafts state it with the profile.
fn is_asset_1(asset: &Value) -> bool {
    let versions = [&asset["version"], &asset["profile"]["version"]];
    let mut texts = versions.into_iter().filter_map(Value::as_str);
    texts.any(|version| version.starts_with("1."))
}

/// Makes the error for JSON that is not as glTF 2.0 says.
fn refusal(error: &serde_json::Error, json: &[u8], is_glb: bool) -> Refusal {
    if serde_json::from_slice(json).is_ok_and(|json| is_version_1(&json)) {
        return version_1();
    }
    /// The most characters of a message. It may quote names of the file.
    const MOST: usize = 160;
    let text = error.to_string();
    let what = text.split(" at line ").next().unwrap_or_default();
    let what = what.chars().take(MOST);
    let what: String = what.map(|c| if c.is_control() { ' ' } else { c }).collect();
    let problem = format!("{what}: expected the JSON of glTF 2.0");
    if is_glb || error.line() == 0 {
        Refusal::whole(problem)
    } else {
        Refusal::at(Place::Line(error.line()), problem)
    }
}

/// Returns entry `index` of a list of the file. `what` names an entry.
///
/// # Errors
/// If the list is not that long.
pub(super) fn entry<'a, T>(list: &'a [T], index: usize, what: &str) -> Result<&'a T, Refusal> {
    list.get(index).ok_or_else(|| {
        let expected = match list.len() {
            0 => "expected it in the file, which has none".into(),
            count => format!("expected 0 to {}", count - 1),
        };
        Refusal::whole(format!("uses {what} {index}: {expected}"))
    })
}
