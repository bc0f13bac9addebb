//! PLY files, text and binary.

use super::*;
use crate::mesh::PolygonMesh;
use crate::mesh::read::polygons::coloured;
use glam::Vec3;
use std::format;
use std::string::{String, ToString};

/// Returns a header for four vertices, with more properties, and one face.
pub(super) fn header(coding: &str, more: &str) -> String {
    format!(
        "ply\nformat {coding} 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty double y\nproperty short z\n\
         {more}element edge 1\nproperty list uchar int ends\nelement face 1\n\
         property list uchar uint vertex_indices\nproperty uchar flags\nend_header\n"
    )
}

/// Returns a square with normals and colours as a file in each coding.
pub(super) fn square(coding: &str) -> Vec<u8> {
    let more = "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n\
                property uchar blue\n";
    let mut bytes = header(coding, more).into_bytes();
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    if coding == "ascii" {
        for (x, y) in corners {
            bytes.extend(format!("{x} {y} 7 0 0 2 255 51 {}\n", 0).into_bytes());
        }
        bytes.extend(b"2 0 1\n4 0 1 2 3 9\n");
        return bytes;
    }
    let is_big = coding == "binary_big_endian";
    let mut add = |value: &[u8]| {
        if is_big {
            bytes.extend(value.iter().rev())
        } else {
            bytes.extend(value)
        }
    };
    for (x, y) in corners {
        add(&(x as f32).to_le_bytes());
        add(&f64::from(y as f32).to_le_bytes());
        add(&7i16.to_le_bytes());
        for normal in [0f32, 0.0, 2.0] {
            add(&normal.to_le_bytes());
        }
        [255, 51, 0].iter().for_each(|channel| add(&[*channel]));
    }
    add(&[2]);
    [0i32, 1].iter().for_each(|end| add(&end.to_le_bytes()));
    add(&[4]);
    (0u32..4).for_each(|corner| add(&corner.to_le_bytes()));
    add(&[9]);
    bytes
}

#[test]
fn all_codings_make_equal_meshes() {
    let read = |coding: &str| parse(square(coding)).expect("a mesh");
    let text = read("ascii");
    let mesh = &text.mesh;
    assert_eq!(mesh.polygon(0), [0, 1, 2, 3]);
    assert_eq!(mesh.positions()[2], Vec3::new(1.0, 1.0, 7.0));
    assert_eq!(mesh.colours()[3], Vec3::new(1.0, 0.2, 0.0));
    let normals = mesh.given_normals().expect("normals");
    assert_eq!(normals.values, [Vec3::Z; 4]);
    assert!(text.notes.is_empty());
    for coding in ["binary_little_endian", "binary_big_endian"] {
        assert_eq!(read(coding).mesh, *mesh, "{coding}");
    }
    let crlf = String::from_utf8(square("ascii"))
        .expect("text")
        .replace('\n', "\r\n");
    assert_eq!(parse(crlf).expect("a mesh").mesh, *mesh);
}

#[test]
fn strips_alternate_and_end_at_negative_indices() {
    let text = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
                element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
                0 0 0 1 0 0 0 1 0 1 1 0 0 2 0  9 0 1 2 3 4 -1 0 1 3";
    assert_eq!(polygons(text), [[0, 1, 2], [2, 1, 3], [2, 3, 4], [0, 1, 3]]);
}

#[test]
fn faces_have_colours_as_materials() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                element face 2\nproperty list uchar int vertex_index\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
                end_header\n0 0 0 1 0 0 0 1 0 3 0 1 2 255 0 0 3 2 1 0 0 0 51";
    let mesh: PolygonMesh = parse(text).expect("a mesh").mesh;
    let material = |p| mesh.materials()[mesh.polygon_material(p).expect("a material")];
    let colours = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.2]].map(coloured);
    assert_eq!([material(0), material(1)], colours);
}

#[test]
fn files_are_refused_with_their_line_or_byte() {
    let text = String::from_utf8(square("ascii")).expect("text");
    let change = |from: &str, to: &str, message: &str| {
        assert!(text.contains(from), "{from}");
        assert_refused(text.replace(from, to), message);
    };
    change(
        "ascii",
        "utf8",
        "t:2: `format utf8 1.0`: expected ascii, binary_little_endian or binary_big_endian",
    );
    change(
        "short",
        "shirt",
        "t:7: `property shirt z`: expected a type and a name, or `list`, two types and a name",
    );
    change(
        "end_header",
        "end_heder",
        "t:19: `end_heder`: expected format, comment, element, property or end_header",
    );
    change(
        "vertex 4",
        "vertex x",
        "t:4: `element vertex x`: expected `element`, a name and a count, a whole number",
    );
    change(
        "float x",
        "float u",
        "t: its vertices have no x, y and z: expected properties of these names",
    );
    change(
        "uint vertex_indices",
        "uint corners",
        "t: its faces have no list `vertex_indices`: expected a property of this name",
    );
    change(
        "4 0 1 2 3 9",
        "4 0 1 2 4 9",
        "t:25: vertex index 4 is out of range: expected 0 to 3",
    );
    change(
        "4 0 1 2 3 9",
        "4 0 1",
        "t:26: the file ends here, before its last element",
    );
    change(
        "1 1 7",
        "1 inf 7",
        "t:22: vertex 2 is 1, inf, 7: expected finite numbers, at most 3.4e38",
    );
    change("1 1 7", "1 x 7", "t:22: `x`: expected a finite number");
    change(
        "element face 1",
        "element face 0",
        "t: has 4 points and no polygon: expected faces (MeshLab and Open3D make a surface from points)",
    );
    let binary = square("binary_little_endian");
    let end = binary.len();
    assert_refused(
        &binary[..end - 3],
        &format!(
            "t: byte {}: the file ends here, before its last element",
            end - 3
        ),
    );
    assert_refused(
        b"ply\nformat ascii 1.0\n",
        "t:2: the file ends in its header: expected `end_header`",
    );
}

#[test]
fn counts_past_a_limit_are_reported_with_the_limit() {
    let file = |vertices: &str, sides: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
             property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n{sides} 0 1 2\n"
        )
    };
    assert_refused(
        file("3", "4000000000"),
        "t:13: a list of 4000000000 entries: expected less than 4000000000",
    );
    assert_refused(
        file("3", "-3"),
        "t:13: a list of -3 entries: expected a whole number",
    );
    let error = parse(file("99999999999999999999999", "3")).expect_err("no mesh");
    let problem = error.problem;
    assert!(
        problem.ends_with("expected `element`, a name and a count below 2^64"),
        "{problem}"
    );
}

#[test]
fn headers_may_have_blank_lines_and_remarks() {
    let text = String::from_utf8(square("ascii")).expect("text");
    let read = |text: String| parse(text).expect("a mesh");
    for text in [
        format!("\n \r\n{text}"),
        format!("\r{text}"),
        text.replace('\n', "\0\n"),
        text.replace("end_header", "\n\nend_header \0"),
    ] {
        assert!(read(text.clone()).notes.is_empty(), "{text:?}");
    }
    for coding in ["ascii", "binary_little_endian"] {
        let mut bytes = square(coding);
        let at = "ply\n".len();
        bytes.splice(at..at, *b"Created by hand\n");
        let loaded = parse(bytes).expect("a mesh");
        let said = "a line of the header is no statement and is ignored (line 2)";
        assert_eq!(sentences(&loaded.notes), [said]);
    }
    let error = parse(text.replace("end_header", "and")).expect_err("no mesh");
    assert_eq!(
        error.problem,
        "the file ends in its header: expected `end_header`"
    );
    let said = "a line of the header is no statement and is ignored (7 times, first in line 19)";
    assert_eq!(sentences(&error.notes), [said]);
    // A statement with a slip decides how values are read.
    for line in [
        "propery float w",
        "elment edge 0",
        "double w",
        "Property int w",
    ] {
        let error = parse(text.replace("comment by hand", line)).expect_err("no mesh");
        let said =
            format!("t:3: `{line}`: expected format, comment, element, property or end_header");
        assert_eq!(error.to_string(), said);
    }
}

#[test]
fn what_the_counts_leave_out_is_reported() {
    let said = "the file goes on after the last face that it counts: the rest is ignored";
    for coding in ["ascii", "binary_little_endian"] {
        let mut bytes = square(coding);
        bytes.extend(b"\n\0");
        assert!(parse(&bytes).expect("a mesh").notes.is_empty());
        bytes.extend(b"4 0 1 2 3 9\n");
        assert_eq!(sentences(&parse(&bytes).expect("a mesh").notes), [said]);
    }
}

/// The product of both would be black here.
#[test]
fn colours_of_faces_and_vertices_are_not_multiplied() {
    let text = String::from_utf8(square("ascii")).expect("text");
    let text = text.replace(
        "uchar flags",
        "uchar red\nproperty uchar green\nproperty uchar blue",
    );
    let text = text.replace("4 0 1 2 3 9", "4 0 1 2 3 0 0 255");
    let loaded = parse(&text).expect("a mesh");
    assert!(loaded.mesh.colours().is_empty());
    assert_eq!(loaded.mesh.materials(), [coloured([0.0, 0.0, 1.0])]);
    let said =
        "vertices and faces have colours: those of the faces are used, as all vertices have one";
    assert_eq!(sentences(&loaded.notes), [said]);
    let loaded = parse(text.replacen("255 51 0", "0 51 0", 1)).expect("a mesh");
    assert_eq!(loaded.mesh.colours().len(), 4);
    assert_eq!(loaded.mesh.polygon_material(0), None);
    let said = "vertices and faces have colours: those of the faces are not used";
    assert_eq!(sentences(&loaded.notes), [said]);
}
