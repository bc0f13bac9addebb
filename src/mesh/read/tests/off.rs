//! OFF files.

use super::*;
use crate::mesh::read::polygons::coloured;
use glam::Vec3;

const BODY: &str = "4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

#[test]
fn keywords_comments_and_ends_of_lines_are_read() {
    let own = |start: &str| std::format!("{start}{BODY}");
    for text in [
        own("OFF\n"),
        own("OFF "),
        own("OFF"),
        own("# x\nOFF # y\n\n#\n"),
        own("\u{feff}OFF\n").replace('\n', "\r\n"),
        own("OFF\n").replace('\n', "\r"),
        own("OFF\n").replace("4 1 0", "4 1"),
        own("nOFF\n3\n"),
        own("OFF\n").replace("4 0 1 ", "4 0\n1\n# c\n"),
    ] {
        assert_eq!(polygons(&text), [[0, 1, 2, 3]], "{text}");
    }
    let weighted = "4OFF\n3 1\n0 0 0 1\n2 0 0 2\n0 3 0 3\n3 0 1 2\n";
    let mesh = parse(weighted).expect("a mesh").mesh;
    assert_eq!(mesh.positions(), [Vec3::ZERO, Vec3::X, Vec3::Y]);
}

#[test]
fn vertices_have_colours_and_normals_and_faces_have_colours() {
    let text = "CNOFF\n3 2\n0 0 0 0 0 2 255 0 0 255\n1 0 0 0 0 2 0 51 0 255\n0 1 0 0 0 2 0 0 255 255\n\
                3 0 1 2 1 0.5 0\n3 2 1 0 255 255 51 128\n";
    let mesh = parse(text).expect("a mesh").mesh;
    assert_eq!(mesh.colours()[1], Vec3::new(0.0, 0.2, 0.0));
    assert_eq!(mesh.given_normals().expect("normals").values, [Vec3::Z; 3]);
    let material = |p| mesh.materials()[mesh.polygon_material(p).expect("a material")];
    let colours = [[1.0, 0.5, 0.0], [1.0, 1.0, 0.2]].map(coloured);
    assert_eq!([material(0), material(1)], colours);
}

/// A face's colour that cannot be drawn unchanged makes a warning, as a vertex's colour does.
#[test]
fn odd_colours_of_faces_are_reported() {
    let none = "a colour of a face is not three finite numbers: the face has none";
    let clamped = "a colour of a face is out of range and is clamped to it";
    for (colour, told, material) in [
        ("nan 0 0", Some(none), None),
        ("0 inf 0", Some(none), None),
        ("-1 0 0", Some(clamped), Some([0.0; 3])),
        ("300 0 0", Some(clamped), Some([1.0, 0.0, 0.0])),
        ("255 0 0", None, Some([1.0, 0.0, 0.0])),
        ("1 0 0", None, Some([1.0, 0.0, 0.0])),
    ] {
        let text =
            std::format!("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 {colour}\n3 2 1 0 {colour}\n");
        let loaded = parse(text).expect("a mesh");
        let expected = told.map(|told| std::format!("{told} (2 times)"));
        assert_eq!(
            sentences(&loaded.notes),
            Vec::from_iter(expected),
            "{colour}"
        );
        let mesh = loaded.mesh;
        let found = mesh.polygon_material(1).map(|m| mesh.materials()[m]);
        assert_eq!(found, material.map(coloured), "{colour}");
    }
}

#[test]
fn files_are_refused_with_their_line() {
    let change = |from: &str, to: &str, message: &str| {
        let text = std::format!("OFF\n{BODY}").replace(from, to);
        assert_refused(text, message);
    };
    change(
        "0 1 2 3",
        "0 1 2 4",
        "t:7: vertex index 4 is out of range: expected 0 to 3",
    );
    change(
        "4 0 1",
        "5 0 1",
        "t:8: the file ends here, before the end of its last face",
    );
    change(
        "4 0 1",
        "-4 0 1",
        "t:7: a face of -4 corners: expected a whole number",
    );
    change("1 1 0", "1 1", "t:5: 2 numbers: expected 3");
    change("1 1 0", "1 x 0", "t:5: `x`: expected a finite number");
    change(
        "4 1 0\n",
        "4 2 0\n",
        "t:8: the file ends here, before the end of its last face",
    );
    change(
        "4 1 0\n",
        "-4 1 0\n",
        "t:2: `-4`: expected the number of vertices, a whole number",
    );
    change(
        "4 1 0\n",
        "4000000000 1 0\n",
        "t:2: `4000000000`: expected the number of vertices, less than 4000000000",
    );
    change(
        "4 1 0\n",
        "4 99999999999999999999999 0\n",
        "t:2: `99999999999999999999999`: expected the number of faces, less than 4000000000",
    );
    assert_refused(
        "4OFF\n3 1\n0 0 0 1\n2 0 0 0\n0 3 0 3\n3 0 1 2\n",
        "t:4: a vertex with w = 0: expected another number, as x, y and z are divided by it",
    );
    change(
        "OFF\n",
        "OFF BINARY\n",
        "t: is a binary OFF file: expected OFF text (meshconv and geomview write it)",
    );
    assert_refused(
        "OFF 3 0\n0 0 0\n1 0 0\n0 1 0\n",
        "t: has no polygon: expected faces of at least three corners",
    );
}

#[test]
fn the_whole_file_tells_if_colours_are_bytes() {
    let of = |colours: [&str; 2]| {
        let [a, b] = colours;
        let text = std::format!("OFF\n4 2\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 {a}\n3 2 1 3 {b}\n");
        let mesh = parse(text).expect("a mesh").mesh;
        [0, 1].map(|p| mesh.materials()[mesh.polygon_material(p).expect("a material")])
    };
    let byte = 1.0 / 255.0;
    for (colours, expected) in [
        (["255 0 0", "1 1 1"], [[1.0, 0.0, 0.0], [byte; 3]]),
        (["1 0 0", "1 1 1"], [[1.0, 0.0, 0.0], [1.0; 3]]),
        (["0.5 0.5 0.5", "1.0002 0.5 0"], [[0.5; 3], [1.0, 0.5, 0.0]]),
        (["127.5 0 0", "0 0 0"], [[0.5, 0.0, 0.0], [0.0; 3]]),
    ] {
        assert_eq!(of(colours), expected.map(coloured), "{colours:?}");
    }
}

#[test]
fn positions_that_no_face_uses_may_be_anything() {
    let text = "OFF\n4 1\nnan nan nan\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n";
    let loaded = parse(text).expect("a mesh");
    assert_eq!(loaded.mesh.positions().len(), 3);
    let said = "a vertex that no face uses is not finite: it is left out";
    assert_eq!(sentences(&loaded.notes), [said]);
    assert_refused(
        text.replace("3 1 2 3", "3 0 2 3"),
        "t:3: vertex 0 is NaN, NaN, NaN: expected finite numbers, at most 3.4e38",
    );
}

#[test]
fn nul_counts_as_a_blank() {
    let text = "OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    assert_eq!(polygons(text.replace('\n', "\0\n")), [[0, 1, 2]]);
    let stl = "solid a\0b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\0\nvertex 0 1 0\nendloop\nendfacet\n";
    assert_eq!(polygons(stl), [[0, 1, 2]]);
}
