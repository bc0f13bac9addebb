//! STL files, binary and text.

use super::*;
use crate::mesh::vertex_normals::{NormalSource, NormalWeight};
use std::format;
use std::string::String;
use std::vec;

/// The vertices of two triangles of a unit square.
const SQUARE: [[f32; 9]; 2] = [
    [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0],
    [1.0, 1.0, 0.0, -0.0, 1.0, 0.0, -0.0, 0.0, 0.0],
];

/// Returns a binary file whose header says `count` triangles.
pub(super) fn binary(header: &[u8], count: u32, triangles: &[[f32; 9]]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, 0);
    bytes.extend(count.to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

/// Returns the text of a facet.
fn facet(corners: &str) -> String {
    let vertices = corners
        .split(',')
        .map(|corner| format!("vertex {corner}\n"));
    let vertices: String = vertices.collect();
    format!("facet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\n")
}

fn read_stl(bytes: &[u8]) -> Result<LoadedMesh, ReadError> {
    parse_mesh("t.stl", bytes, |_| Err(ErrorKind::NotFound.into()))
}

#[test]
fn equal_positions_are_one_and_edges_are_creased() {
    let loaded = parse(binary(b"solid by hand", 2, &SQUARE)).expect("a mesh");
    let mesh = &loaded.mesh;
    let polygons: Vec<&[u32]> = mesh.polygons().collect();
    assert_eq!(polygons, [[0, 1, 2], [2, 3, 0]]);
    assert_eq!(mesh.positions().len(), 4);
    assert_eq!(mesh.normal_rule().source, NormalSource::Crease(40.0));
    assert_eq!(mesh.normal_rule().weight, NormalWeight::Angle);
    assert!(loaded.notes.is_empty() && mesh.given_normals().is_none());
    // A text file far from 0, where 32 bits are too coarse to tell its corners apart.
    let far = "4000000 0 0.001,4000000.001 0 0.001,4000000 0.001 0.001";
    let loaded = parse(format!("solid far\n{}", facet(far))).expect("a mesh");
    assert_eq!(loaded.mesh.positions().len(), 3);
}

#[test]
fn the_triangle_count_may_be_wrong() {
    for count in [0, u32::MAX] {
        let loaded = read_stl(&binary(b"x", count, &SQUARE)).expect("a mesh");
        assert_eq!(loaded.mesh.polygon_count(), 2);
        let said = format!("the header says {count} triangles: all 2 in the file are read");
        assert_eq!(sentences(&loaded.notes), [said]);
    }
    let trailing = [binary(b"x", 2, &SQUARE), b"abc".to_vec()].concat();
    let loaded = read_stl(&trailing).expect("a mesh");
    assert_eq!(loaded.mesh.polygon_count(), 2);
    let error =
        |bytes: &[u8]| std::string::ToString::to_string(&read_stl(bytes).expect_err("no mesh"));
    let cut = binary(b"x", 3, &SQUARE);
    assert_eq!(
        error(&cut),
        "t.stl: byte 184: the file ends in triangle 3 of 3: expected all of them"
    );
    let short = "t.stl: is 4 bytes long: expected text that begins with `solid`, or a binary file of at least 84 bytes";
    assert_eq!(error(b"ab\0c"), short);
    let said = "t.stl:1: `abc`: expected `facet`, `solid` or `endsolid`";
    assert_eq!(error(b"abc"), said);
    let none = "t.stl: has no triangle: expected triangles, binary or as `facet` statements";
    assert_eq!(error(&binary(b"x", 0, &[])), none);
    let mut nan = SQUARE;
    nan[1][4] = f32::NAN;
    let said =
        "t.stl: byte 134: triangle 2 has a coordinate that is not finite: expected finite numbers";
    assert_eq!(error(&binary(b"x", 2, &nan)), said);
}

#[test]
fn triangles_behind_a_count_that_is_too_small_are_read() {
    let own = |more: &[u8]| [binary(b"x", 1, &SQUARE), more.to_vec()].concat();
    let loaded = read_stl(&own(b"")).expect("a mesh");
    assert_eq!(loaded.mesh.polygon_count(), 2);
    let said = "the header says 1 triangle: all 2 in the file are read";
    assert_eq!(sentences(&loaded.notes), [said]);
    // Other bytes are no triangles.
    let nan = [f32::NAN.to_le_bytes(); 13].concat();
    let text = b"{ \"made by\": \"hand\", \"units\": \"mm\", \"version\": 1 }";
    for (more, left) in [(&b"abc"[..], 53), (&nan[..50], 100), (&text[..50], 100)] {
        let loaded = read_stl(&own(more)).expect("a mesh");
        assert_eq!(loaded.mesh.polygon_count(), 1);
        let said = format!("the header says 1 triangle: {left} bytes behind are ignored");
        assert_eq!(sentences(&loaded.notes), [said]);
    }
    let padded = [binary(b"x", 2, &SQUARE), vec![0; 512]].concat();
    assert!(read_stl(&padded).expect("a mesh").notes.is_empty());
}

#[test]
fn text_is_known_by_its_words() {
    let own = facet("0 0 0,1 0 0,0 1 0");
    for text in [
        format!("solid a\0{}\n{own}", "\0".repeat(70)),
        own.clone(),
        format!("solid a\n{own}endsolid a\n\u{feff}solid b\n"),
    ] {
        assert_eq!(polygons(&text), [[0, 1, 2]], "{text:?}");
    }
    let mut named = binary(b"solid facet and vertex", 1, &SQUARE);
    named.push(0);
    assert_eq!(parse(named).expect("a mesh").mesh.polygon_count(), 1);
    assert_refused(
        format!("solid a\n{}", facet("0 0 0,1e39 0 0,0 1 0")),
        "t:5: a vertex at 1000000000000000000000000000000000000000, 0, 0: expected numbers of at most 3.4e38",
    );
}

#[test]
fn text_is_read_word_by_word() {
    let own = facet("0 0 0,1 0 0,0 1 0");
    let square = facet("0 0 0,1 0 0,1 1 0,0 1 0");
    for (text, corners) in [
        (format!("solid a\n{own}endsolid a\n"), 3),
        (format!("solid a\n{own}").replace('\n', "\r"), 3),
        (format!("solid a {own} endsolid").replace('\n', " "), 3),
        (format!("SOLID\n{}", own.to_uppercase()), 3),
        (
            format!("\u{feff}# by hand\nsolid facet normal things\n{own}"),
            3,
        ),
        (format!("solid a\n{own}endsolid a\nsolid b\n{own}"), 6),
        (
            format!("solid endsolid\n{}", own.replace("normal 0 0 1", "")),
            3,
        ),
        (
            format!("solid a\n{}", own.replace("0 0 1", "nan nan nan")),
            3,
        ),
        (format!("solid a\n{square}"), 4),
    ] {
        let found = polygons(&text).concat();
        assert_eq!(found.len(), corners, "{text}");
    }
    assert_refused(
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 1,5 0\n",
        "t:4: `1,5`: expected a finite number with a decimal point",
    );
    assert_refused(
        format!("solid a\n{}", facet("0 0 0,1 0 0")),
        "t:7: a facet of 2 vertices: expected three",
    );
    assert_refused(
        format!("solid a\n{own}hello\n"),
        "t:9: `hello`: expected `facet`, `solid` or `endsolid`",
    );
    assert_refused(
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0",
        "t:4: the file ends here, before `endfacet`",
    );
}
