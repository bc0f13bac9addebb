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
    let text = "CNOFF\n3 1\n0 0 0 0 0 2 255 0 0 255\n1 0 0 0 0 2 0 51 0 255\n0 1 0 0 0 2 0 0 255 255\n3 0 1 2\n";
    let mesh = parse(text).expect("a mesh").mesh;
    assert_eq!(mesh.colours()[1], Vec3::new(0.0, 0.2, 0.0));
    assert_eq!(mesh.given_normals().expect("normals").values, [Vec3::Z; 3]);
    let text = "OFF\n3 2\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 0.5 0\n3 2 1 0 1.0 1.0 0.25 0.5\n";
    let mesh = parse(text).expect("a mesh").mesh;
    let material = |p| mesh.materials()[mesh.polygon_material(p).expect("a material")];
    let colours = [[1.0, 0.5, 0.0], [1.0, 1.0, 0.25]].map(coloured);
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
        ("1.0 0 0", None, Some([1.0, 0.0, 0.0])),
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
        let LoadedMesh { mesh, notes } = parse(text).expect("a mesh");
        let colours = [0, 1].map(|p| mesh.materials()[mesh.polygon_material(p).expect("one")]);
        (colours, sentences(&notes).join("; "))
    };
    let byte = |byte: f32| byte / 255.0;
    let [black, brown] = [[byte(1.0); 3], [byte(200.0), byte(100.0), 0.0]];
    let clamped = "a colour of a face is out of range and is clamped to it";
    let small = "the colours are integers from 0 to 1: they are not divided by 255";
    let large =
        "the colours look like 0 to 255, though not all are integers: they are divided by 255";
    let mixed = "some colours are integers from 0 to 255, others are not: only the integers are divided by 255";
    for (colours, expected, told) in [
        (["200 100 0", "1 1 1"], [brown, black], ""),
        (["1.0 0 0", "1 1 1"], [[1.0, 0.0, 0.0], [1.0; 3]], ""),
        (["1 0 0", "1 1 1"], [[1.0, 0.0, 0.0], [1.0; 3]], small),
        (
            ["0.5 0.5 0.5", "1.0002 0.5 0"],
            [[0.5; 3], [1.0, 0.5, 0.0]],
            clamped,
        ),
        (
            ["0.5 0.5 0.5", "2 1 0"],
            [[0.5; 3], [1.0, 1.0, 0.0]],
            clamped,
        ),
        (["127.5 0 0", "1 1 1"], [[0.5, 0.0, 0.0], black], large),
        (
            ["200.0 100.0 0.0", "255.0 1.0 0.0"],
            [brown, [1.0, byte(1.0), 0.0]],
            large,
        ),
        (
            ["1 0.5 0", "255 200 51 128"],
            [[1.0, 0.5, 0.0], [1.0, byte(200.0), 0.2]],
            mixed,
        ),
        (["0 0 0", "0 0 0"], [[0.0; 3]; 2], ""),
        // One colour that is much too bright does not darken the others.
        (
            ["10.0 0.5 0.5", "0.5 1 1"],
            [[1.0, 0.5, 0.5], [0.5, 1.0, 1.0]],
            clamped,
        ),
    ] {
        let found = of(colours);
        assert_eq!(found, (expected.map(coloured), told.into()), "{colours:?}");
    }
}

/// The product of both would be black here.
#[test]
fn colours_of_faces_and_vertices_are_not_multiplied() {
    let of = |vertices: [&str; 3]| {
        let [a, b, c] = vertices;
        let text = std::format!("COFF\n3 1\n0 0 0 {a}\n1 0 0 {b}\n0 1 0 {c}\n3 0 1 2 0 0 255\n");
        parse(text).expect("a mesh")
    };
    let loaded = of(["255 0 0", "255 255 0", "255 0 0"]);
    assert_eq!(loaded.mesh.colours()[1], Vec3::new(1.0, 1.0, 0.0));
    assert_eq!(loaded.mesh.polygon_material(0), None);
    let said = "vertices and faces have colours: those of the faces are not used";
    assert_eq!(sentences(&loaded.notes), [said]);
    let loaded = of(["0 0 0"; 3]);
    assert!(loaded.mesh.colours().is_empty());
    assert_eq!(loaded.mesh.materials(), [coloured([0.0, 0.0, 1.0])]);
    let said =
        "vertices and faces have colours: those of the faces are used, as all vertices have one";
    assert_eq!(sentences(&loaded.notes), [said]);
}

#[test]
fn lines_may_break_anywhere() {
    let own = |start: &str| std::format!("{start}{BODY}");
    for text in [
        own("OFF\n").replace('\n', " "),
        own("OFF\n").replace(' ', "\n"),
        own("OFF\n").replace("4 1 0", "4\n1"),
        own("OFF\n").replace("4 1 0", "4\n1\n0"),
        own("OFF\n").replace("0 0 0\n1 0 0\n", "0 0 0 1 0 0\n"),
        own("OFF\n").replace("1 1 0\n", "1\n1 0\n"),
    ] {
        let loaded = parse(&text).expect("a mesh");
        assert_eq!(loaded.mesh.polygon(0), [0, 1, 2, 3], "{text}");
        assert!(loaded.notes.is_empty(), "{text}: {}", loaded.notes);
    }
    for channels in ["255 0 0 255", "255 0 0"] {
        let text = std::format!(
            "COFF 3 2 0 0 0 0 {channels}\n1 0 0 {channels} 0 1 0 {channels} 3 0 1 2 3 2 1 0"
        );
        let mesh = parse(text).expect("a mesh").mesh;
        assert_eq!(mesh.polygon_count(), 2);
        assert_eq!(mesh.colours(), [Vec3::X; 3]);
    }
    // A colour of a face ends with the line in any layout.
    let text = "OFF 3 2 0\n0 0 0 1\n0 0 0 1 0\n3 0 1 2 255 0 0\n3 2 1 0 0 0 255\n";
    let mesh = parse(text).expect("a mesh").mesh;
    let colours = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]].map(coloured);
    assert_eq!(mesh.materials(), colours);
    // The error is that of a file with a line for each vertex.
    assert_refused(
        "OFF\n2 1\n0 0\n0 1 0\n3 0 1 2\n",
        "t:3: 2 numbers: expected 3",
    );
}

#[test]
fn vertices_may_have_colours_that_the_keyword_does_not_name() {
    let of = |behind: [&str; 3]| {
        let [a, b, c] = behind;
        let text = std::format!("OFF\n3 1\n0 0 0 {a}\n1 0 0 {b}\n0 1 0 {c}\n3 0 1 2\n");
        parse(text).expect("a mesh")
    };
    for behind in [["255 0 0"; 3], ["255 0 0 128"; 3], ["1.0 0.0 0.0"; 3]] {
        let loaded = of(behind);
        assert_eq!(loaded.mesh.colours(), [Vec3::X; 3], "{behind:?}");
        assert!(loaded.notes.is_empty());
    }
    let said = "values that the keyword does not name follow a vertex: they are ignored";
    for (behind, line) in [
        (["0 0 1", "0 0 1", "0 0 -1"], 3),
        (["", "255 0 0", "255 0 0"], 4),
        (["0.5 0.5"; 3], 3),
        (["0 0 1 255 0 0"; 3], 3),
    ] {
        let loaded = of(behind);
        assert!(loaded.mesh.colours().is_empty());
        assert_eq!(
            sentences(&loaded.notes),
            [std::format!("{said} (line {line})")]
        );
    }
}

#[test]
fn more_values_than_a_colour_has_are_reported() {
    let text = "COFF\n3 1\n0 0 0 255 0 0 255 7\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n";
    let loaded = parse(text).expect("a mesh");
    assert_eq!(loaded.mesh.colours(), [Vec3::X; 3]);
    let said = "values that the keyword does not name follow a vertex: they are ignored (line 3)";
    assert_eq!(sentences(&loaded.notes), [said]);
}

#[test]
fn what_the_counts_leave_out_is_reported() {
    let text = "OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7 8\n3 2 1 0\n";
    let said = [
        "the values behind a face's corners are no colour of three or four numbers: they are ignored (line 6)",
        "the file goes on after the last face that it counts: the rest is ignored",
    ];
    assert_eq!(sentences(&parse(text).expect("a mesh").notes), said);
}

#[test]
fn positions_that_no_face_uses_may_be_anything() {
    let text = "OFF\n4 1\nnan nan nan\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n";
    let loaded = parse(text).expect("a mesh");
    assert_eq!(loaded.mesh.positions().len(), 3);
    let said = "a vertex that no face uses is not finite, or over 3.4e38: it is left out";
    assert_eq!(sentences(&loaded.notes), [said]);
    assert_refused(
        text.replace("3 1 2 3", "3 0 2 3"),
        "t:3: vertex 0 is NaN, NaN, NaN: expected finite numbers, at most 3.4e38",
    );
}

/// Each of these bytes stands in real files, at the end of a line or where two files were joined.
#[test]
fn odd_bytes_count_as_blanks() {
    let off = "OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for text in [off, ply, stl, obj] {
        for odd in ["\0", "\x0b", "\x0c", "\x1a", " \t", "\r"] {
            for text in [
                text.replace('\n', &std::format!("{odd}\n")),
                text.replace('\n', &std::format!("\n{odd}")),
                std::format!("{odd}\n{text}{odd}"),
            ] {
                let loaded = parse(&text).expect("a mesh");
                assert_eq!(loaded.mesh.polygon(0), [0, 1, 2], "{text:?}");
                assert!(loaded.notes.is_empty(), "{text:?}: {}", loaded.notes);
            }
        }
        let marked = std::format!("\u{feff}{text}\u{feff}");
        let loaded = parse(&marked).expect("a mesh");
        assert!(loaded.notes.is_empty(), "{marked:?}: {}", loaded.notes);
    }
}
