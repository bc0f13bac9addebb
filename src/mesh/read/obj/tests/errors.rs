//! Invalid files: each error with its line and what was expected.

use super::super::prescan::MeshLimits;
use super::super::read_limited;
use super::*;
use crate::mesh::read::error::Place;
use crate::mesh::read::load_mesh;
use glam::Vec3;
use std::error::Error;
use std::path::Path;
use std::string::ToString;

/// Checks that `text` gives an error at `line` (0: none) with `message` after its place.
#[track_caller]
fn assert_error(text: impl AsRef<[u8]>, line: usize, message: &str) {
    let error = parse(text).unwrap_err();
    let expected = (line > 0).then_some(Place::Line(line));
    assert_eq!(error.place, expected, "{error}");
    assert_eq!(error.path, Path::new("t.obj"));
    let place = if line > 0 {
        format!("t.obj:{line}: ")
    } else {
        "t.obj: ".to_string()
    };
    assert_eq!(error.to_string(), format!("{place}{message}"));
}

/// Checks the error of `text` after five points, so that the first line of `text` is line 6.
#[track_caller]
fn assert_error_after_points(text: &str, line: usize, message: &str) {
    assert_error(format!("{POINTS}{text}"), line, message);
}

#[test]
fn missing_files_and_directories() {
    let missing = load_mesh(Path::new("no/such/file.obj")).unwrap_err();
    assert!(
        missing
            .to_string()
            .starts_with("no/such/file.obj: cannot be read ("),
        "{missing}"
    );
    assert!(missing.source().is_none());
    let directory = Path::new(env!("CARGO_MANIFEST_DIR"));
    let error = load_mesh(directory).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!(
            "{}: is a directory: expected a mesh file (OBJ, STL, PLY, OFF or glTF)",
            directory.display()
        )
    );
}

#[test]
fn files_without_polygons() {
    assert_error("", 0, "is empty: expected OBJ text with `v` and `f` lines");
    assert_error(
        " \r\n\t\n\u{feff}".trim_end_matches('\u{feff}'),
        0,
        "is empty: expected OBJ text with `v` and `f` lines",
    );
    assert_error(
        b"\xef\xbb\xbf",
        0,
        "is empty: expected OBJ text with `v` and `f` lines",
    );
    let no_polygon = "has no polygon: expected OBJ text with an `f` line of at least three corners";
    assert_error(POINTS, 0, no_polygon);
    let library = "is a material library, not the mesh that names it: expected OBJ text with `v` and `f` lines";
    assert_error("# red\nnewmtl red\nKd 1 0 0\n", 0, library);
    assert_error("# nothing\n", 0, no_polygon);
    assert_error("hello cube\nfacet normal 0 0 1\n", 0, no_polygon);
    assert_error_after_points("f 1 2\n", 0, no_polygon);
    let points =
        "has points or lines but no polygon: expected an `f` line of at least three corners";
    assert_error_after_points("l 1 2 3\n", 0, points);
}

#[test]
fn binary_data() {
    let message = "holds binary data: expected OBJ text with `v` and `f` lines";
    assert_error([0, 255, 3, 10, 200, 7], 1, message);
    assert_error(format!("{POINTS}hello\0 1\n"), 6, message);
    assert_error([0, 0, 0, 0], 0, message);
    // No NUL byte, but no polygon either.
    assert!(parse([0x89, b'P', b'N', b'G', 13, 10, 26, 10, 200]).is_err());
}

/// Checks the error of a triangle whose second position is the statement `v`. Without the face
/// there must be no error.
#[track_caller]
fn assert_bad_position(v: &str, message: &str) {
    let text = format!("v 0 0 0\n{v}\nv 0 1 0\n\nf 1 2 3\n");
    let used = ", and the face in line 5 uses this position";
    assert_error(text, 2, &format!("{message}{used}"));
    let loaded = after_points(&format!("{v}\nf 1 2 3\n"));
    let told = "a position is not three finite numbers and is left out (line 6)";
    assert_eq!(warning(&loaded), told, "{v}");
}

#[test]
fn a_position_that_is_no_number_refuses_the_file_only_if_a_face_uses_it() {
    for number in [
        "nan",
        "inf",
        "-inf",
        "1e400",
        "0x10",
        "1.2.3",
        "é",
        "1.#QNAN",
        "-1.#IND",
        "1.#INF00",
        "-nan(ind)",
        "NaN",
        "1.#J",
    ] {
        let message = format!("`{number}` in `v`: expected a finite number");
        assert_bad_position(&format!("v 0 {number} 0"), &message);
    }
    let message = "`-1e39` in `v`: expected a finite number, at most 3.4e38, and in a scene 1e15";
    assert_bad_position("v 0 -1e39 0", message);
    let message = "`1,5` in `v`: expected a finite number with a decimal point";
    assert_bad_position("v 0 1,5 0", message);
    let few = |found| format!("`v` has too few numbers: expected three, found {found}");
    assert_bad_position("v 1 2", &few(2));
    assert_bad_position("v 0 0 # 0", &few(2));
    assert_bad_position("v", &few(0));
    // Two lines run together.
    let message = "`0v` in `v`: expected a finite number";
    assert_bad_position("v 0 0 0v 1 0 0", message);
    let message = "`v` in `v`: expected a finite number";
    assert_bad_position("v 0 0 0 v 1 0 0", message);
}

#[test]
fn the_first_face_that_uses_a_position_is_named() {
    // The face comes before the position. An earlier face is left out and does not count.
    let text = "f 1 2\nf 2 3 4\nf 1 2 3\nv 0 0 0\nv nan 0 0\nv 1 0 0\nv 0 1 0\n";
    let message =
        "`nan` in `v`: expected a finite number, and the face in line 2 uses this position";
    assert_error(text, 5, message);
    // The error replaces the warning.
    let told = ["a face of fewer than three different corners is left out (line 1)"];
    assert_eq!(sentences(&parse(text).unwrap_err().notes), told);
    // A face that is left out uses nothing.
    let loaded = after_points("v nan 0 0\nf 1 6\nf 6 6 6\nf 1 2 3\n");
    assert_eq!(polygons(&loaded), [[0, 1, 2]]);
}

#[test]
fn normals_and_texture_coordinates_that_are_no_numbers_refuse_nothing() {
    for vn in [
        "nan nan nan",
        "1 2",
        "",
        "1.#QNAN 0 -1.#IND00",
        "0 1,5 0",
        "1e999 0 0",
        "x",
    ] {
        let loaded = after_points(&format!("vn {vn}\nvn 0 0 2\nf 1//1 2//2 3//2\n"));
        let normals = loaded.mesh.given_normals().unwrap();
        let values = normals.corners.as_deref().unwrap().iter();
        let values: Vec<Vec3> = values.map(|&n| normals.values[n as usize]).collect();
        assert_eq!(values, [Vec3::ZERO, Vec3::Z, Vec3::Z], "{vn}");
        let told = "a normal is not three finite numbers: corners that name it count as without a normal (line 6)";
        assert_eq!(warning(&loaded), told, "{vn}");
    }
    let loaded = after_points("vt nan\nvt\nvt 1,5 x\nf 1/1 2/2 3/3\n");
    assert_eq!(loaded.notes, Notes::default());
}

#[test]
fn a_face_that_is_left_out_refuses_nothing() {
    for face in ["f 99", "f 1 -99", "f 1 x", "f 1//7 2/", "f 1.5 2"] {
        let loaded = after_points(&format!("f 1 2 3\n{face}\n"));
        let told = "a face of fewer than three different corners is left out (line 7)";
        assert_eq!(warning(&loaded), told, "{face}");
    }
}

#[test]
fn warnings_from_before_an_error_come_with_it() {
    let error = parse(format!("{POINTS}hello\nl 1 2\nf 1 2 9\n")).unwrap_err();
    assert_eq!(
        sentences(&error.notes),
        [
            "points and lines are not drawn (line 7)",
            "`hello` is not an OBJ statement and is ignored (line 6)"
        ]
    );
    let error = parse("Not Found\n").unwrap_err();
    let told = "`Not` is not an OBJ statement and is ignored (line 1)";
    assert_eq!(
        error.problem,
        "has no polygon: expected OBJ text with an `f` line of at least three corners"
    );
    assert_eq!(sentences(&error.notes), [told]);
    assert_eq!(parse("Not Found\n").unwrap_err().place, None);
}

#[test]
fn files_of_other_formats_are_named() {
    let utf16 = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let files: [(Vec<u8>, &str); 7] = [
        (utf16("\u{feff}v 0 0 0\n"), "UTF-16 text (not UTF-8)"),
        (utf16("v 0 0 0\n"), "UTF-16 text (not UTF-8)"),
        (b"\x89PNG\r\n\x1a\n".to_vec(), "a PNG picture"),
        (b"7z\xbc\xaf\x27\x1c".to_vec(), "a 7z archive"),
        (b"\n <!DOCTYPE HTML>\n".to_vec(), "a page of HTML"),
        (b"\xef\xbb\xbf<html>".to_vec(), "a page of HTML"),
        (
            b"version https://git-lfs.github.com/spec/v1\n".to_vec(),
            "a pointer of Git LFS, not the file (`git lfs pull` fetches it)",
        ),
    ];
    for (bytes, what) in files {
        let message = format!("is {what}: expected a mesh file (OBJ, STL, PLY, OFF or glTF)");
        assert_error(bytes, 0, &message);
    }
}

#[test]
fn corners() {
    for corner in [
        "a",
        "1.0",
        "1/2/3/4",
        "/1",
        "//",
        "1/x",
        "1//x",
        "99999999999999999999",
        "--1",
    ] {
        let message = format!(
            "`{corner}` is not a corner: expected `v`, `v/vt`, `v//vn` or `v/vt/vn`, whole numbers"
        );
        assert_error_after_points(&format!("f 1 2 {corner}\n"), 6, &message);
    }
}

#[test]
fn indices() {
    let zero = "position index 0: expected 1 or more (or -1 and below, counted backwards)";
    assert_error_after_points("f 1 2 3\nf 0 1 2\n", 7, zero);
    assert_error_after_points(
        "f 1 2 6\n",
        6,
        "position index 6 is out of range: expected 1 to 5",
    );
    assert_error_after_points(
        "f 1 2 -6\n",
        6,
        "position index -6 is out of range: expected -5 to -1 at this line",
    );
    assert_error(
        "f -1 -2 -3\n",
        1,
        "position index -1 is out of range: expected a position before this line, but there is none",
    );
    // Negative indices are checked at their line, positive ones at the end. The first line that
    // stays wrong is reported.
    let later = "f 1 2 6\nf 1 2 9\nf 1 2 8\nv 9 9 9\n";
    assert_error_after_points(
        later,
        7,
        "position index 9 is out of range: expected 1 to 6",
    );
    for huge in [i64::MAX, i64::MIN] {
        assert!(
            parse(format!("{POINTS}f 1 2 {huge}\n"))
                .unwrap_err()
                .to_string()
                .contains("is out of range"),
            "{huge}"
        );
    }
}

#[test]
fn a_normal_that_does_not_exist_is_none() {
    let told = "a corner names a normal that does not exist and counts as without a normal";
    let own = |loaded: &LoadedMesh| {
        let given = loaded.mesh.given_normals().expect("normals");
        let corners = given.corners.as_ref().expect("of corners");
        let normals = corners.iter().map(|&n| given.values[n as usize] == Vec3::Z);
        normals.collect::<Vec<bool>>()
    };
    // The parser panics at the second of these in a debug build.
    for (text, line) in [
        ("vn 0 0 1\nf 1//1 2//2 3//1\n", 7),
        ("vn 0 0 1\nf 1//1 2//-5 3//1\n", 7),
        ("vn 0 0 1\nf 1//1 2//0 3//1\n", 7),
        ("f 1//1 2//-1 3//1\nvn 0 0 1\n", 6),
        ("f 1//1 2//2 3//1\nvn 0 0 1\n", 6),
        ("f 1//1 2//9223372036854775807 3//1\nvn 0 0 1\n", 6),
        ("vn 0 0 1\nf 1//1 2//-9223372036854775808 3//1\n", 7),
    ] {
        let loaded = after_points(text);
        assert_eq!(*warning(&loaded), format!("{told} (line {line})"), "{text}");
        assert_eq!(own(&loaded), [true, false, true], "{text}");
    }
    let loaded = after_points("vn 0 0 1\nf 1//1 2//2 3//3\nf 1//0 2//1 3//4\nvn 0 0 1\n");
    assert_eq!(
        *warning(&loaded),
        format!("{told} (3 times, first in line 7)")
    );
    assert_eq!(own(&loaded), [true, true, false, false, true, false]);
    // A file without normals may name any.
    let loaded = after_points("f 1//0 2//1 3//-1\n");
    assert!(loaded.mesh.given_normals().is_none());
    assert!(warning(&loaded).starts_with("a face names normals or texture coordinates"));
}

#[test]
fn a_continued_statement_is_reported_with_its_first_line() {
    assert_error_after_points(
        "f 1 2 \\\n3 \\\nx\n",
        6,
        "`x` is not a corner: expected `v`, `v/vt`, `v//vn` or `v/vt/vn`, whole numbers",
    );
    assert_error_after_points(
        "f 1 \\\n2 3\nf 1 2 x\n",
        8,
        "`x` is not a corner: expected `v`, `v/vt`, `v//vn` or `v/vt/vn`, whole numbers",
    );
}

#[test]
fn quotes_fit_one_short_line() {
    let error = parse(format!("f 1 2 \u{1b}[31m{}\n", "x".repeat(1000)))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("\\u{1b}[31mxxx") && error.contains('…') && error.len() < 140,
        "{error}"
    );
}

#[test]
fn names_are_quoted_unchanged() {
    let loaded = after_points("usemtl C:\\a\"b'\\\nf 1 2 3\n");
    let told = "no material library defines `C:\\a\"b'\\`: the default material is used";
    assert_eq!(warning(&loaded), told);
}

#[test]
fn limits() {
    let load = |polygons, corners| {
        let text = format!("{POINTS}f 1 2 3\nf 1 2 3 4\nf 3 4 5\n");
        let none = |_: &str| Err(io::ErrorKind::NotFound.into());
        let limits = MeshLimits { polygons, corners };
        read_limited(text.as_bytes(), &mut { none }, limits).map(|_| ())
    };
    assert!(load(3, 10).is_ok());
    let error = load(2, 10).unwrap_err();
    assert_eq!(
        (error.place, &*error.problem),
        (
            Some(Place::Line(8)),
            "too many polygons: expected at most 16777216"
        )
    );
    let error = load(3, 6).unwrap_err();
    assert_eq!(
        (error.place, &*error.problem),
        (
            Some(Place::Line(7)),
            "too many corners: expected at most 134217728"
        )
    );
}

#[test]
fn backslashes_between_numbers_are_named_in_one_word_as_in_three() {
    let expected = |word| {
        format!(
            "`{word}` is not a corner: expected `v`, `v/vt`, `v//vn` or `v/vt/vn`, whole numbers with `/` between them, not `\\`"
        )
    };
    for (face, word) in [("1\\2\\3", "1\\2\\3"), ("1\\1 2\\1 3\\1", "1\\1")] {
        assert_error_after_points(&format!("f {face}\n"), 6, &expected(word));
    }
}
