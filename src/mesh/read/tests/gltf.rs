//! glTF and GLB files.

use super::*;
use crate::mesh::read::FileLens;
use crate::mesh::{PolygonMesh, vertex_normals};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::Vec3;
use std::format;
use std::string::{String, ToString};
use vertex_normals::NormalSource;

/// Returns the bytes of three positions, three indices, three normals, and three colours of one
/// byte per channel.
fn buffer() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut vectors = |vectors: [[f32; 3]; 3]| {
        bytes.extend(vectors.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    };
    vectors([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    vectors([[0.0, 0.0, 1.0]; 3]);
    bytes.extend([0u16, 1, 2, 0].iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend([255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255]);
    bytes
}

/// Returns the JSON of a triangle. The arguments are added to its buffer, its primitive, the node
/// of its mesh, and the file.
fn json(buffer: &str, primitive: &str, node: &str, more: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
"nodes": [{{"children": [1], "translation": [0, 0, 5]}}, {{"mesh": 0{node}}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0{primitive}}}]}}],
"materials": [{{"name": "red", "pbrMetallicRoughness": {{"baseColorFactor": [1, 0, 0, 1]}}}}],
"accessors": [
{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
{{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"}},
{{"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"}},
{{"bufferView": 3, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC4"}}],
"bufferViews": [{{"buffer": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": 36}},
{{"buffer": 0, "byteOffset": 72, "byteLength": 6}}, {{"buffer": 0, "byteOffset": 80, "byteLength": 12}}],
"buffers": [{{"byteLength": 92{buffer}}}]{more}}}"#
    )
}

/// Returns the buffer as a `data:` address.
fn data() -> String {
    let text = STANDARD.encode(buffer());
    format!(r#", "uri": "data:application/octet-stream;base64,{text}""#)
}

fn glb(json: &str, bin: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF".to_vec();
    let length = 12 + 8 + json.len() + 8 + bin.len();
    for number in [2, length as u32, json.len() as u32] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend((bin.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(bin);
    bytes
}

const ALL: &str = r#", "NORMAL": 1, "COLOR_0": 3}, "indices": 2, "material": 0"#;

/// Returns a glTF and a GLB file that use every feature of the reader.
pub(super) fn files() -> (String, Vec<u8>) {
    let node = r#", "scale": [-2, 2, 2]"#;
    let whole = json(&data(), ALL, node, "");
    (whole, glb(&json("", ALL, node, ""), &buffer()))
}

#[test]
fn nodes_place_triangles_with_normals_colours_and_materials() {
    let (text, binary) = files();
    let mesh = parse(&text).expect("a mesh").mesh;
    let corner = |c: usize| mesh.positions()[mesh.polygon(0)[c] as usize];
    // The negative scale turns the triangle inside out, and the reader turns its corners back.
    assert_eq!(corner(0), Vec3::new(0.0, 0.0, 5.0));
    assert_eq!(corner(1), Vec3::new(0.0, 2.0, 5.0));
    assert_eq!(corner(2), Vec3::new(-2.0, 0.0, 5.0));
    assert_eq!(mesh.given_normals().expect("normals").values, [Vec3::Z; 3]);
    assert_eq!(mesh.colours(), [Vec3::X, Vec3::Y, Vec3::Z]);
    let material = mesh.polygon_material(0).expect("a material");
    let red = crate::mesh::read::polygons::coloured([1.0, 0.0, 0.0]);
    assert_eq!(mesh.materials()[material], red);
    assert_eq!(mesh.material_name(material), Some("red"));
    assert_eq!(mesh.up_by_custom(), Some('y'));
    assert_eq!(parse(binary).expect("a mesh").mesh, mesh);
    // The buffer in a file beside this one, with a blank in its name.
    let beside = json(
        r#", "uri": "a%20b.bin""#,
        ALL,
        r#", "scale": [-2, 2, 2]"#,
        "",
    );
    let loaded = parse_mesh("t.gltf", beside.as_bytes(), |name| match name {
        "a b.bin" => Ok(buffer()),
        _ => Err(ErrorKind::NotFound.into()),
    });
    assert_eq!(loaded.expect("a mesh").mesh, mesh);
    let error = parse(&beside).expect_err("no buffer").to_string();
    assert!(
        error.starts_with("t: buffer `a b.bin` cannot be read (entity not found)"),
        "{error}"
    );
}

#[test]
fn triangles_without_normals_are_flat() {
    let bare = json(&data(), r#"}, "indices": 2"#, "", "");
    let loaded = parse(&bare).expect("a mesh");
    assert!(loaded.mesh.is_flat_for_lack());
    assert_eq!(loaded.mesh.smoothing_group(0), Some(PolygonMesh::FACETED));
    let two = bare.replace(
        r#""primitives": ["#,
        r#""primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}, "#,
    );
    let loaded = parse(&two).expect("a mesh");
    let mesh = &loaded.mesh;
    let groups = [0, 1].map(|p| mesh.smoothing_group(p));
    assert_eq!(
        groups,
        [Some(2), Some(PolygonMesh::FACETED)].map(|g| g.map(|g| g.min(1)))
    );
    let normals = vertex_normals::vertex_normals(mesh, NormalSource::Auto);
    assert_eq!(normals.values[normals.corners[5] as usize], Vec3::Z);
}

#[test]
fn strips_and_fans_are_triangles() {
    let of = |mode: u32| {
        let primitive = format!(r#"}}, "mode": {mode}"#);
        let text = json(&data(), &primitive, "", "");
        // Six positions: the last three are the normals' bytes.
        let text = text.replacen(r#""byteLength": 36}"#, r#""byteLength": 72}"#, 1);
        polygons(text.replacen(r#""count": 3"#, r#""count": 5"#, 1))
    };
    assert_eq!(of(5), [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
    assert_eq!(of(6), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    assert_eq!(of(4), [[0, 1, 2]]);
    let points = json(&data(), r#"}, "mode": 0"#, "", "");
    let said = "t: has points or lines but no triangle: expected a scene with meshes of triangles";
    assert_refused(points, said);
}

#[test]
fn sparse_accessors_replace_elements() {
    // The first position becomes the first normal, (0, 0, 1).
    let sparse = r#""sparse": {"count": 1, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 1}}, "#;
    let text = json(&data(), r#"}, "indices": 2"#, "", "");
    let with = text.replacen(
        r#""componentType": 5126"#,
        &format!("{sparse}{}", r#""componentType": 5126"#),
        1,
    );
    let mesh = parse(&with).expect("a mesh").mesh;
    assert_eq!(mesh.positions()[0], Vec3::new(0.0, 0.0, 6.0));
    let many = with.replace(r#""sparse": {"count": 1"#, r#""sparse": {"count": 9"#);
    assert!(parse(&many).is_err());
}

#[test]
fn files_are_refused_with_what_is_wrong() {
    let own = |node: &str, more: &str| json(&data(), r#"}, "indices": 2"#, node, more);
    let text = own("", "");
    let beyond = "reaches beyond its buffer view: expected all of them in it";
    assert_refused(
        text.replacen(r#""count": 3"#, r#""count": 4000000000"#, 1),
        &format!("t: accessor 0 of 4000000000 elements {beyond}"),
    );
    let no_bytes = text.replacen(
        r#"{"bufferView": 0, "componentType""#,
        r#"{"sparse": {"count": 1, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 1}}, "componentType""#,
        1,
    );
    assert_refused(
        no_bytes.replacen(r#""count": 3"#, r#""count": 4000000000"#, 1),
        "t: accessor 0 says 4000000000 elements and has no bytes: expected a buffer view",
    );
    assert_refused(
        text.replacen(r#""byteLength": 36}"#, r#""byteLength": 24}"#, 1)
            .replace(
                r#""count": 3, "type": "VEC3", "min""#,
                r#""count": 2, "type": "VEC3", "min""#,
            ),
        "t: vertex index 2 in accessor 2 is out of range: expected 0 to 1",
    );
    assert_refused(
        text.replace(r#""POSITION": 0"#, r#""POSITION": 9"#),
        "t: uses accessor 9: expected 0 to 3",
    );
    assert_refused(
        r#"{"asset": {"version": "1.0"}, "meshes": {}}"#,
        "t: is glTF 1.0: expected glTF 2.0 (`gltf-pipeline` converts it)",
    );
    assert_refused(
        own(r#", "children": [0]"#, ""),
        "t: node 0 is its own ancestor, or has two parents: expected a tree of nodes",
    );
    let draco = own(
        "",
        r#", "extensionsRequired": ["KHR_draco_mesh_compression"]"#,
    );
    let error = parse(draco).expect_err("compressed").to_string();
    assert!(
        error
            .starts_with("t: requires the extension KHR_draco_mesh_compression, which is not read"),
        "{error}"
    );
    let harmless = own(
        "",
        r#", "extensionsRequired": ["KHR_texture_transform", "KHR_mesh_quantization"]"#,
    );
    assert!(parse(harmless).is_ok());
    let error = parse(text.replace(r#""scene": 0"#, r#""scene": 7"#))
        .expect_err("no scene")
        .to_string();
    assert!(
        error.starts_with("t: uses scene 7: expected 0 to 0"),
        "{error}"
    );
    let error = parse(text.replace(r#""meshes": ["#, r#""meshes": [,"#)).expect_err("no JSON");
    assert_eq!(error.place, Some(crate::mesh::read::Place::Line(3)));
}

#[test]
fn cameras_and_lights_are_where_their_nodes_are() {
    let lights = r#", "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 3, "color": [1, 0.5, 0]},
        {"type": "point", "intensity": 4}]}}, "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]"#;
    let text = json(&data(), r#"}, "indices": 2"#, "", lights);
    let nodes = r#""nodes": [{"camera": 0, "translation": [0, 0, 9]}, {"rotation": [0.70710678, 0, 0, -0.70710678],
        "extensions": {"KHR_lights_punctual": {"light": 0}}}, {"translation": [0.5, 2.5, 0],
        "extensions": {"KHR_lights_punctual": {"light": 1}}}, "#;
    let text = text.replacen(
        r#""nodes": [{"children""#,
        &format!("{nodes}{}", r#"{"children""#),
        1,
    );
    let text = text.replacen(r#"[{"nodes": [0]}]"#, r#"[{"nodes": [0, 1, 2, 4]}]"#, 1);
    let text = text.replacen(r#"{"children": [1], "translation": [0, 0, 5]}, "#, "", 1);
    let text = text.replacen(r#""nodes": [0, 1, 2, 4]"#, r#""nodes": [0, 1, 2, 3]"#, 1);
    let view = crate::mesh::read::view(text.as_bytes()).expect("a view");
    let camera = view.camera.expect("a camera");
    // The middle of the triangle's box is (0.5, 0.5, 0).
    let distance = 81.5f64.sqrt();
    assert!((camera.target - glam::DVec3::new(0.0, 0.0, 9.0 - distance)).length() < 1e-12);
    assert_eq!(camera.lens, FileLens::Fovy(0.5f64.to_degrees()));
    assert_eq!((camera.eye.z, camera.up), (9.0, glam::DVec3::Y));
    let [sun, lamp] = view.lights[..] else {
        panic!("{:?}", view.lights)
    };
    // The node is turned by −90 degrees about x, so that its z points up.
    let toward = sun.toward.expect("a direction");
    assert!((toward - glam::DVec3::Y).length() < 1e-6, "{toward}");
    // 3/π and 4/4π sum to 1.27, which is over 1, so both are divided by it.
    let sum = 3.0 / core::f64::consts::PI + 1.0 / core::f64::consts::PI;
    let expected = 3.0 / core::f64::consts::PI / sum;
    assert!(
        (f64::from(sun.colour[0]) - expected).abs() < 1e-6 && sun.colour[1] == 0.5 * sun.colour[0]
    );
    assert_eq!(
        (lamp.toward, lamp.place),
        (None, glam::DVec3::new(0.5, 2.5, 0.0))
    );
    assert!((f64::from(lamp.colour[0]) - 4.0 / core::f64::consts::PI / sum).abs() < 1e-6);
}

#[test]
fn a_skin_moves_vertices_by_their_joints() {
    // The bytes of the colours serve as weights of 1 for joint 0, 1 and 2. The joints are zeros.
    let text = json(
        &data(),
        r#", "JOINTS_0": 4, "WEIGHTS_0": 3}, "indices": 2"#,
        r#", "skin": 0"#,
        r#", "skins": [{"joints": [0]}]"#,
    );
    let joints = r#""accessors": [{"componentType": 5121, "count": 3, "type": "VEC4", "sparse": {"count": 1,
        "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 0}}},"#;
    let text = text.replacen(r#""accessors": ["#, joints, 1);
    // The new accessor is the first one.
    let text = text
        .replace(r#""JOINTS_0": 4"#, r#""JOINTS_0": 0"#)
        .replace(r#""POSITION": 0"#, r#""POSITION": 1"#);
    let text = text
        .replace(r#""WEIGHTS_0": 3"#, r#""WEIGHTS_0": 4"#)
        .replace(r#""indices": 2"#, r#""indices": 3"#);
    let mesh = parse(&text).expect("a mesh").mesh;
    // Joint 0 is the root, at z = 5. The transform of the mesh's own node, with its scale, does not
    // count.
    assert_eq!(
        mesh.positions(),
        [
            Vec3::new(0.0, 0.0, 5.0),
            Vec3::new(1.0, 0.0, 5.0),
            Vec3::new(0.0, 1.0, 5.0)
        ]
    );
    let scaled = text.replace(r#""skin": 0"#, r#""skin": 0, "scale": [7, 7, 7]"#);
    assert_eq!(
        parse(&scaled).expect("a mesh").mesh.positions(),
        mesh.positions()
    );
}

#[test]
fn glb_files_with_wrong_lengths_are_refused_with_both_lengths() {
    let (_, whole) = files();
    let have = whole.len();
    let cut = &whole[..have - 30];
    let less = have - 30;
    assert_refused(
        cut,
        &format!("t: byte 8: the file says {have} bytes and has {less}: expected all of them"),
    );
    assert_refused(
        &whole[..10],
        "t: byte 10: the file ends after 10 bytes: expected 12 of a GLB header",
    );
    let with = |at: usize, number: u32| {
        let mut bytes = whole.clone();
        bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
        bytes
    };
    assert_refused(
        with(8, 7),
        "t: byte 8: the file says 7 bytes: expected at least 20",
    );
    let left = have - 20;
    assert_refused(
        with(12, 99_999),
        &format!(
            "t: byte 12: its JSON chunk says 99999 bytes and has {left}: expected all of them"
        ),
    );
    let bin = have - 8 - buffer().len();
    assert_refused(
        with(bin, 93),
        &format!("t: byte {bin}: its binary chunk says 93 bytes and has 92: expected all of them"),
    );
}

#[test]
fn other_versions_and_files_without_nodes_are_named() {
    for first in [
        r#"{"asset": {"profile": {"version": "1.0.3"}}, "meshes": []}"#,
        r#"{"asset": {}, "meshes": {"a": {}}}"#,
    ] {
        assert_refused(
            first,
            "t: is glTF 1.0: expected glTF 2.0 (`gltf-pipeline` converts it)",
        );
    }
    let text = json(&data(), ALL, "", "").replace(r#"[{"nodes": [0]}]"#, "[{}]");
    let problem = parse(text).expect_err("nothing").problem;
    assert!(
        problem.starts_with("its scene has no `nodes`, so nothing is drawn"),
        "{problem}"
    );
    for name in ["t.glb", "t.gltf"] {
        let none = |_: &str| Err(ErrorKind::NotFound.into());
        let error = crate::mesh::read::parse_mesh(name, b"", none).expect_err("nothing");
        assert_eq!(error.problem, "is empty: expected a glTF file");
    }
}

/// For a path that leaves the folder of the file, only the bare name is looked for.
#[test]
fn no_buffer_outside_the_folder_is_read() {
    let text = json(r#", "uri": "../../etc/secret""#, ALL, "", "");
    let mut asked = Vec::new();
    let loaded = parse_mesh("t", text.as_bytes(), |name| {
        asked.push(String::from(name));
        Err(ErrorKind::NotFound.into())
    });
    let problem = loaded.expect_err("no buffer").problem;
    assert!(
        problem.starts_with("buffer `../../etc/secret` is outside the folder"),
        "{problem}"
    );
    assert_eq!(asked, ["secret"]);
}

/// What is not drawn may be of any form.
#[test]
fn parts_that_are_not_drawn_never_refuse_a_file() {
    let whole = json(&data(), ALL, "", "");
    let mesh = parse(&whole).expect("a mesh").mesh;
    let without_box = whole.replace(r#", "min": [0, 0, 0], "max": [1, 1, 0]"#, "");
    assert_ne!(without_box, whole);
    let of_file = |more: &str| json(&data(), ALL, "", more);
    let of_primitive = |more: &str| json(&data(), &format!("{more}{ALL}"), "", "");
    for text in [
        of_primitive(r#", "_HEAT": 1, "TANGENT": 99"#),
        of_file(r#", "extras": "a", "animations": [{"channels": [{"target": {}}]}, 7]"#),
        of_file(r#", "textures": [{}], "samplers": [{"wrapS": 10242}], "images": 3"#),
        of_file(r#", "extensionsRequired": ["EXT_texture_webp", "KHR_animation_pointer"]"#),
        whole.replace(r#""count": 3"#, r#""count": 3.0"#),
        whole
            .replace(
                r#""buffers": ["#,
                r#""buffers": [{"byteLength": 9}, {"uri": "a.bin"}, "#,
            )
            .replace(r#""buffer": 0"#, r#""buffer": 2"#),
        whole
            .replace(
                r#""accessors": ["#,
                r#""accessors": [{"count": 1, "componentType": 1, "type": ""}, "#,
            )
            .replace(
                ALL,
                r#", "NORMAL": 2, "COLOR_0": 4}, "indices": 3, "material": 0"#,
            )
            .replace(r#""POSITION": 0"#, r#""POSITION": 1"#),
        whole.replace(
            r#"{"name": "red", "#,
            r#"{"name": "red", "normalTexture": {"index": "b"}, "#,
        ),
        without_box,
    ] {
        let found = parse(&text);
        assert_eq!(
            found.map(|loaded| loaded.mesh).as_ref(),
            Ok(&mesh),
            "{text}"
        );
    }
}

#[test]
fn glb_files_may_have_no_binary_chunk_other_chunks_and_any_padding() {
    let mesh = parse(json(&data(), ALL, "", "")).expect("a mesh").mesh;
    let in_text = glb(&json(&data(), ALL, "", ""), b"");
    let mut without_bin = in_text[..in_text.len() - 8].to_vec();
    let length = without_bin.len() as u32;
    without_bin[8..12].copy_from_slice(&length.to_le_bytes());
    let mut behind = without_bin.clone();
    behind.push(0);
    let mut other = without_bin.clone();
    other.extend(b"\x04\0\0\0abcdefgh");
    let padded = glb(&format!("{}\0\0\0", json("", ALL, "", "")), &buffer());
    for bytes in [in_text, without_bin, behind, other, padded] {
        assert_eq!(parse(&bytes).expect("a mesh").mesh, mesh);
    }
    let said = "t: has no JSON chunk: expected one of glTF 2.0";
    assert_refused(b"glTF\x02\0\0\0\x14\0\0\0\0\0\0\0abcd", said);
}

#[test]
fn compressed_parts_are_named_though_no_extension_is_required() {
    let text = json(&data(), r#"}, "indices": 2"#, "", "");
    let draco = text.replacen(r#"{"bufferView": 0, "#, "{", 1).replace(
        r#""primitives": [{"#,
        r#""primitives": [{"extensions": {"KHR_draco_mesh_compression": {}}, "#,
    );
    let problem = parse(draco).expect_err("compressed").problem;
    assert!(
        problem.starts_with("requires the extension KHR_draco_mesh_compression"),
        "{problem}"
    );
    let meshopt = text
        .replace(
            &data(),
            r#", "extensions": {"EXT_meshopt_compression": {"fallback": true}}"#,
        )
        .replacen(
            r#"{"buffer": 0"#,
            r#"{"extensions": {"EXT_meshopt_compression": {}}, "buffer": 0"#,
            1,
        );
    let problem = parse(meshopt).expect_err("compressed").problem;
    assert!(
        problem.starts_with("requires the extension EXT_meshopt_compression"),
        "{problem}"
    );
}

#[test]
fn instances_place_a_mesh_and_hidden_nodes_do_not() {
    let of = |node: &str| json(&data(), r#"}, "indices": 2"#, node, "");
    // The three positions serve as translations.
    let many = parse(of(
        r#", "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}"#,
    ));
    let mesh = many.expect("a mesh").mesh;
    let firsts: Vec<Vec3> = (0..3)
        .map(|p| mesh.positions()[mesh.polygon(p)[0] as usize])
        .collect();
    let z = Vec3::new(0.0, 0.0, 5.0);
    assert_eq!(firsts, [z, z + Vec3::X, z + Vec3::Y]);
    let hidden = of(r#", "extensions": {"KHR_node_visibility": {"visible": false}}"#);
    assert_refused(hidden, "t: has no triangle: expected a scene with meshes");
}

#[test]
fn a_part_without_material_beside_others_is_white() {
    let text = json(&data(), ALL, "", "").replace(
        r#""primitives": ["#,
        r#""primitives": [{"attributes": {"POSITION": 0}}, "#,
    );
    let mesh = parse(&text).expect("a mesh").mesh;
    let diffuse = [0, 1].map(|p| {
        mesh.polygon_material(p)
            .map(|m| mesh.materials()[m].diffuse)
    });
    assert_eq!(diffuse, [Some([0.8; 3]), Some([0.8, 0.0, 0.0])]);
    let bare = parse(json(&data(), "}", "", "")).expect("a mesh").mesh;
    assert_eq!(bare.polygon_material(0), None);
}

#[test]
fn normals_of_length_zero_are_told() {
    // The second positions are (1, 0, 0), the first ones zero.
    let text = json(&data(), r#", "NORMAL": 0}, "indices": 2"#, "", "");
    let said =
        "1 of 3 normals of the file have length zero: their corners count as without a normal";
    assert_eq!(sentences(&parse(text).expect("a mesh").notes), [said]);
}

#[test]
fn averages_smooth_what_is_flat_only_for_lack_of_normals() {
    // Two triangles around the edge from (1, 0, 0) to (0, 1, 0), the second one raised.
    let text = json(&data(), r#"}, "mode": 5"#, "", "");
    let text = text.replacen(r#""byteLength": 36}"#, r#""byteLength": 48}"#, 1);
    let mesh = parse(text.replacen(r#""count": 3"#, r#""count": 4"#, 1))
        .expect("a mesh")
        .mesh;
    let values = |source| {
        let normals = vertex_normals::vertex_normals(&mesh, source);
        normals.corners[1..4]
            .iter()
            .map(|n| normals.values[*n as usize])
            .collect::<Vec<Vec3>>()
    };
    assert_eq!(values(NormalSource::Auto)[0], Vec3::Z);
    assert_ne!(values(NormalSource::Averaged)[0], Vec3::Z);
}

/// Returns the mesh and the notes of a triangle with this material.
fn with_material(material: &str) -> LoadedMesh {
    let more = format!(r#", "materials": [{material}]"#);
    let text = json(
        &data(),
        r#", "NORMAL": 1}, "indices": 2, "material": 0"#,
        "",
        &more,
    );
    parse(text).expect("a mesh")
}

#[test]
fn what_is_wrong_in_a_material_is_told_and_ignored() {
    let ignored = |expected: &str| {
        format!("material 0 has something else where glTF has {expected}: it is ignored")
    };
    for (material, said) in [
        ("7", "an object"),
        (
            r#"{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0]}}"#,
            "a colour of four numbers",
        ),
        (
            r#"{"emissiveFactor": "red"}"#,
            "an emission of three numbers",
        ),
        (r#"{"alphaMode": 3}"#, "an `alphaMode` in quotes"),
        (
            r#"{"doubleSided": "no"}"#,
            "a `doubleSided` of true or false",
        ),
    ] {
        let loaded = with_material(material);
        assert_eq!(sentences(&loaded.notes), [ignored(said)], "{material}");
        assert_eq!(loaded.mesh.materials()[0].diffuse, [0.8; 3]);
    }
    let bright = r#"{"pbrMetallicRoughness": {"baseColorFactor": [2, 0, 0, 1]}}"#;
    let said = "a colour of a material is out of 0 to 1 and is clamped to it";
    assert_eq!(sentences(&with_material(bright).notes), [said]);
}

#[test]
fn only_what_may_be_transparent_is_told() {
    let of = |mode: &str, alpha: &str, texture: &str| {
        let loaded = with_material(&format!(
            r#"{{"alphaMode": "{mode}", "pbrMetallicRoughness": {{"baseColorFactor": [1, 1, 1, {alpha}]{texture}}}}}"#
        ));
        loaded.notes.has("material/transparency")
    };
    let texture = r#", "baseColorTexture": {"index": 0}"#;
    for (mode, alpha, texture, is_told) in [
        ("BLEND", "1", "", false),
        ("BLEND", "0.9", "", true),
        ("BLEND", "1", texture, true),
        ("MASK", "0.6", "", false),
        ("MASK", "0.4", "", true),
        ("MASK", "1", texture, true),
        ("OPAQUE", "0.1", texture, false),
    ] {
        assert_eq!(
            of(mode, alpha, texture),
            is_told,
            "{mode} {alpha} {texture}"
        );
    }
}
