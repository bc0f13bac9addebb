//! Positions, faces, groups and normals.

use super::*;
use crate::mesh::PolygonMesh;
use crate::mesh::newell::polygon_normal;
use crate::mesh::read::load_mesh;
use glam::{DVec3, Vec3};
use std::collections::HashSet;
use std::path::Path;
use std::string::ToString;
use std::vec;

#[test]
fn polygons_keep_all_their_sides() {
    // A concave pentagon must not be triangulated.
    let loaded =
        parse("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\nf 1 2 3\nf 1 3 4 5\n")
            .unwrap();
    assert_eq!(
        polygons(&loaded),
        [vec![0, 1, 2, 3, 4], vec![0, 1, 2], vec![0, 2, 3, 4]]
    );
    assert_eq!(loaded.mesh.positions()[3], Vec3::new(1.0, 0.5, 0.0));
    assert_eq!(loaded.notes, Notes::default());
}

#[test]
fn a_file_of_triangles_only_has_its_polygons() {
    // The parser leaves out the corner counts of a file that has only triangles.
    assert_eq!(
        polygons(&after_points("f 1 2 3\nf 1 3 4\n")),
        [[0, 1, 2], [0, 2, 3]]
    );
}

#[test]
fn groups_share_positions_and_unused_positions_go() {
    let loaded = after_points("o a\nf 2 3 4\ng b\nf 4 3 5\no\ng\nf 2 4 5\n");
    assert_eq!(loaded.mesh.positions().len(), 4);
    assert_eq!(polygons(&loaded), [[0, 1, 2], [2, 1, 3], [0, 2, 3]]);
    assert_eq!(loaded.notes, Notes::default());
}

#[test]
fn indices_count_backwards_from_their_line() {
    let loaded = parse("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -4 -3 -1\n").unwrap();
    assert_eq!(polygons(&loaded), [[0, 1, 2], [0, 1, 3]]);
}

#[test]
fn indices_may_be_ahead_of_their_positions() {
    assert_eq!(
        polygons(&parse(format!("f 1 2 3\ng a\n{POINTS}")).unwrap()),
        [[0, 1, 2]]
    );
}

#[test]
fn comments_continued_lines_and_line_ends() {
    let expected = [vec![0, 1, 2, 3]];
    for text in [
        "f 1 2 3 4 # a comment \\\n",
        "f 1 2 3 4# a comment\n",
        "f 1 2 \\\n3 \\\r\n4\n",
        "f\t1 2\\\n 3 4",
        "  f 1/ 2// 3 4\r\n",
        "# ends like a continued line \\\nf 1 2 3 4\n",
    ] {
        assert_eq!(polygons(&after_points(text)), expected, "{text:?}");
    }
    let text = format!("# square \n{POINTS}f 1 2 3 4 \n");
    assert_eq!(
        polygons(&parse(text.replace('\n', "\r")).unwrap()),
        expected
    );
    assert_eq!(
        polygons(&parse(text.replace('\n', "\r\n")).unwrap()),
        expected
    );
}

#[test]
fn carriage_returns_and_line_feeds_end_lines_in_any_mixture() {
    let text =
        "# square\nv 0 0 0\rv 1 0 0\r\nv 1 1 0\nv 0 1 0\rf 1 2 4 # a\rf 1 4 3\n\rf 2 3 4\r\r\nf 1";
    let loaded = parse(text).unwrap();
    assert_eq!(polygons(&loaded), [[0, 1, 2], [0, 2, 3], [1, 3, 2]]);
    // Blank lines count as lines.
    assert!(
        warning(&loaded).ends_with("is left out (line 11)"),
        "{}",
        loaded.notes
    );
    // A line that ends in a single CR may be continued, too.
    let loaded = parse("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 \\\r2 \\\r\n3\rf 3 2 1\r").unwrap();
    assert_eq!(polygons(&loaded), [[0, 1, 2], [2, 1, 0]]);
}

#[test]
fn a_backslash_continues_no_name_and_no_comment() {
    for line in [
        "usemtl C:\\materials\\",
        "USEMTL \u{95}\\",
        "g left\\",
        "o left \\",
        "mtllib C:\\models\\",
        "usemap wood\\",
        "shadow_obj a\\",
        "# C:\\models\\",
        "hello \\",
    ] {
        let loaded = after_points(&format!("{line}\nf 1 2 3\n"));
        assert_eq!(polygons(&loaded), [[0, 1, 2]], "{line}");
    }
    // Numbers of faces, positions and curves continue on the next line.
    let text = "v 0 \\\n0 0\nvn \\\n0 0 1\nV 1 0\\ \n 0\ncurv2 1 \\\n2 \\\n3\nv 0 1 0\nf 1//1 2//1 \\\n3//1\n";
    let loaded = parse(text).unwrap();
    assert_eq!(polygons(&loaded), [[0, 1, 2]]);
    assert!(
        warning(&loaded).starts_with("free-form curves"),
        "{}",
        loaded.notes
    );
}

#[test]
fn a_comment_begins_after_a_number() {
    let loaded = parse("v 0 0 0#a\nv 1 0 0.#b\nv 0 1. # c\\\n\nv 0 1 1.# d\nf 1 2 4# e\n");
    assert_eq!(
        loaded.unwrap().mesh.positions()[2],
        Vec3::new(0.0, 1.0, 1.0)
    );
}

#[test]
fn keywords_may_have_capitals() {
    let loaded = parse("V 0 0 0\nV 1 0 0\nV 0 1 0\nVN 0 0 1\nF 1//1 2//1 3//1\n").unwrap();
    assert_eq!(polygons(&loaded), [[0, 1, 2]]);
    assert!(loaded.mesh.given_normals().is_some() && loaded.notes.is_empty());
}

#[test]
fn geometry_in_other_files_is_missing() {
    let loaded = after_points("call other.obj\nf 1 2 3\n");
    let told =
        "`call` and `csh` are not followed: the geometry that they would add is missing (line 6)";
    assert_eq!(warning(&loaded), told);
}

#[test]
fn byte_order_mark_and_latin_1() {
    // If the mark is in its first line, the parser loses that position and all indices shift by
    // one.
    let loaded = parse(format!("\u{feff}{POINTS}f 2 3 4\n")).unwrap();
    assert_eq!(loaded.mesh.positions()[0], Vec3::X);
    let dos = after_points("f 1 2 3\r\n\u{1a}");
    assert_eq!(
        (polygons(&dos), sentences(&dos.notes)),
        (vec![vec![0, 1, 2]], vec![])
    );
    let latin = [b"o Gr\xfcn \xa9\n", POINTS.as_bytes(), b"f 1 2 3 # \xe9\n"].concat();
    assert_eq!(polygons(&parse(latin).unwrap()), [[0, 1, 2]]);
}

#[test]
fn weights_and_colours_do_not_move_positions() {
    // The parser divides by a fourth number and rejects colours that some positions lack.
    let loaded = parse("v 2 4 6 2 # w\nv 1 0 0 1 0.5 0.5\nv 1 1 0 1\nf 1 2 3\n").unwrap();
    assert_eq!(
        loaded.mesh.positions(),
        [Vec3::new(2.0, 4.0, 6.0), Vec3::X, Vec3::new(1.0, 1.0, 0.0)]
    );
    let no_colours = "a face uses a position that has no colour: the colours of the others are not used (2 times, first in line 4)";
    assert_eq!(
        sentences(&loaded.notes),
        ["the weight w of a position is ignored (line 1)", no_colours]
    );
}

#[test]
fn points_and_lines_are_no_polygons() {
    // The parser reads a line of three points as a triangle.
    let loaded = after_points("l 1 2 3\np 1\nf 1 2 3\n");
    assert_eq!(polygons(&loaded), [[0, 1, 2]]);
    assert_eq!(
        warning(&loaded),
        "points and lines are not drawn (2 times, first in line 6)"
    );
}

#[test]
fn faces_without_area_by_their_indices() {
    let loaded = after_points("f\nf 1\nf 1 2\nf 1 2 2 1\nf 1 2 3\n");
    assert_eq!(polygons(&loaded), [[0, 1, 2]]);
    assert!(
        warning(&loaded).ends_with("is left out (4 times, first in line 6)"),
        "{}",
        loaded.notes
    );

    // A repeated neighbour is removed. A corner met twice on the way round (a bridge to a hole)
    // stays.
    let loaded = after_points("f 1 1 2 3 3 1\nf 1 2 3 1 4 5\n");
    assert_eq!(polygons(&loaded), [vec![0, 1, 2], vec![0, 1, 2, 0, 3, 4]]);
    assert_eq!(
        warning(&loaded),
        "a corner that repeats the one before it is left out (line 6)"
    );
}

#[test]
fn normals_belong_to_corners_and_are_made_unit() {
    let loaded = after_points(
        "vn 0 0 2\nvn 0 3 4\nvn 0 0 0\nvt 0 0\nf 1/1/1 2/1/2 3/1/-1\nf 1//2 3//2 4//1\n",
    );
    let normals = loaded.mesh.given_normals().unwrap();
    assert_eq!(
        normals.values,
        [Vec3::Z, Vec3::new(0.0, 0.6, 0.8), Vec3::ZERO]
    );
    assert_eq!(normals.corners.as_deref(), Some(&[0, 1, 2, 1, 1, 0][..]));
    assert_eq!(
        warning(&loaded),
        "1 normal of the file has length zero: corners that name one count as without a normal"
    );
}

#[test]
fn tiny_and_huge_normals_have_a_direction() {
    let loaded = after_points("vn 0 0 1e-45\nvn 3e38 0 0\nf 1//1 2//2 3//2\n");
    assert_eq!(
        loaded.mesh.given_normals().unwrap().values,
        [Vec3::Z, Vec3::X]
    );
}

#[test]
fn corners_with_and_without_normals_may_be_mixed() {
    // The parser repeats the last normal for corners without one.
    const NONE: Vec3 = Vec3::ZERO;
    for (faces, expected) in [
        (
            "f 1//1 2//2 3//1\nf 1 3 4\n",
            [Vec3::Z, Vec3::Y, Vec3::Z, NONE, NONE, NONE],
        ),
        (
            "f 1 3 4\nf 1//2 2//2 3//1\n",
            [NONE, NONE, NONE, Vec3::Y, Vec3::Y, Vec3::Z],
        ),
        (
            "f 1 2//2 3\nf 4//-1 1 2//1\n",
            [NONE, Vec3::Y, NONE, Vec3::Y, NONE, Vec3::Z],
        ),
    ] {
        for text in [
            ["vn 0 0 1\nvn 0 1 0\n", faces].concat(),
            [&faces.replace("-1", "2"), "vn 0 0 1\nvn 0 1 0\n"].concat(),
        ] {
            let loaded = after_points(&text);
            let normals = loaded.mesh.given_normals().unwrap();
            let corners = normals.corners.as_ref().unwrap();
            let found: Vec<Vec3> = corners
                .iter()
                .map(|&n| normals.values[n as usize])
                .collect();
            assert_eq!(found, expected, "{text:?}");
            assert_eq!(loaded.notes, Notes::default());
        }
    }
    let unused = after_points("vn 0 0 1\nf 1 2 3\n");
    assert!(unused.mesh.given_normals().is_none());
}

/// Faces may name normals and texture coordinates although the file has none at all. Other loaders
/// allow that, too.
#[test]
fn normals_of_a_file_without_any_are_averaged() {
    for (faces, told) in [
        (
            "f 1//1 2//2 3//9\nf 1 3 4\n",
            "a face names normals or texture coordinates, but the file has none",
        ),
        (
            "f 1//-1 2//-2 3//-1\n",
            "a face names normals or texture coordinates, but the file has none",
        ),
        (
            "f 1/1/1 2/2/2 3/3/3\n",
            "a face names normals or texture coordinates, but the file has none",
        ),
        (
            "f 1/1/-1 2/2/1 3/3/3\n",
            "a face names normals or texture coordinates, but the file has none",
        ),
    ] {
        let loaded = after_points(faces);
        assert_eq!(polygons(&loaded)[0], [0, 1, 2], "{faces:?}");
        assert!(loaded.mesh.given_normals().is_none(), "{faces:?}");
        let warning = warning(&loaded);
        assert!(warning.starts_with(told), "{warning}");
        assert!(
            warning.ends_with("the file has none: they are ignored (3 times, first in line 6)"),
            "{warning}"
        );
    }
}

/// Returns the smoothing group of each polygon.
fn smoothing(text: &str) -> Vec<Option<u32>> {
    let loaded = after_points(text);
    assert_eq!(loaded.notes, Notes::default(), "{text:?}");
    let polygons = 0..loaded.mesh.polygon_count();
    polygons.map(|p| loaded.mesh.smoothing_group(p)).collect()
}

#[test]
fn smoothing_groups_belong_to_the_polygons_after_them() {
    const OFF: Option<u32> = Some(PolygonMesh::FACETED);
    // 1 is for polygons before any group, and `off` gets the next index.
    let [before, b, c] = [Some(1), Some(3), Some(4)];
    for (text, expected) in [
        ("f 1 2 3\nf 1 3 4\n", [None, None]),
        ("s 1\nf 1 2 3\nf 1 3 4\ns off\n", [None, None]),
        ("s off\nf 1 2 3\nf 1 3 4\n", [OFF, OFF]),
        ("s 0\nf 1 2 3\ns OFF # flat\nf 1 3 4\n", [OFF, OFF]),
        ("f 1 2 3\ns 1\nf 1 3 4\n", [before, b]),
        ("s 7\nf 1 2 3\ns 4294967296 9\nf 1 3 4\n", [b, c]),
        ("s 7\nf 1 2 3\ns off\ns 1\ns 7\nf 1 3 4\n", [None, None]),
        ("s 1\nf 1 2 3\ns off\nf 1 3 4\n", [b, OFF]),
        ("s on\nf 1 2 3\ns 1\nf 1 3 4\n", [None, None]),
    ] {
        assert_eq!(smoothing(text), expected, "{text:?}");
    }
    let odd = after_points("s smooth\nf 1 2 3\n");
    assert_eq!(odd.mesh.smoothing_group(0), OFF);
    assert_eq!(
        warning(&odd),
        "`s smooth` is not a smoothing group and counts as `off`: expected a whole number from 0 on, `on` or `off` (line 6)"
    );
}

#[test]
fn objects_are_parts_and_groups_are_not() {
    let parts = |text: &str| {
        let loaded = after_points(text);
        assert_eq!(loaded.notes, Notes::default());
        let mesh = loaded.mesh;
        (0..mesh.polygon_count())
            .map(|p| mesh.part(p))
            .collect::<Vec<_>>()
    };
    assert_eq!(parts("f 1 2 3\ng b\nf 1 3 4\n"), [0, 0]);
    assert_eq!(parts("o a\nf 1 2 3\nf 1 3 4\n"), [0, 0]);
    assert_eq!(
        parts("o a\nf 1 2 3\no b c\nf 1 3 4\no a\nf 1 2 5\n"),
        [2, 3, 2]
    );
    assert_eq!(parts("f 1 2 3\no\nf 1 3 4\n"), [1, 2]);
}

#[test]
fn a_mesh_far_from_zero_keeps_its_shape() {
    // 1,600 quads of a map projection, 0.3 units apart.
    let (x, z) = (500_123.0, -5_412_345.0);
    let mut text = String::new();
    for (row, column) in (0..41).flat_map(|row| (0..41).map(move |column| (row, column))) {
        let (x, z) = (x + 0.3 * f64::from(column), z + 0.3 * f64::from(row));
        text += &format!("v {x:.1} 200 {z:.1}\n");
    }
    // A position that no face uses does not count.
    text += "v 0 0 0\n";
    for (row, column) in (0..40).flat_map(|row| (0..40).map(move |column| (row, column))) {
        let at = 41 * row + column + 1;
        text += &format!("f {at} {} {} {}\n", at + 41, at + 42, at + 1);
    }
    let mesh = parse(&text).unwrap().mesh;
    for (p, polygon) in mesh.polygons().enumerate() {
        let first = mesh.positions()[polygon[0] as usize].as_dvec3();
        let (row, column) = ((p / 40) as f64, (p % 40) as f64);
        let written = DVec3::new(x + 0.3 * column, 200.0, z + 0.3 * row);
        // Decimals of the text are rounded to f64, and coordinates below 16 to f32.
        assert!((mesh.origin() + first - written).length() < 1e-6);
        assert!((polygon_normal(&mesh, p) - DVec3::Y * 0.18).length() < 1e-5);
    }
    let (low, high) = mesh.bounds().unwrap();
    assert!((low.x - x).abs() < 1e-6 && (high.z - z - 12.0).abs() < 1e-6);
}

#[test]
fn texture_coordinates_do_not_matter() {
    let loaded = after_points("vt 0 0\nf 1/1 2/-1 3/1\nf 1/-5 2/0 3/7\n");
    assert_eq!(polygons(&loaded), [[0, 1, 2], [0, 1, 2]]);
    assert!(
        warning(&loaded).starts_with("a texture coordinate that does not exist"),
        "{}",
        loaded.notes
    );
    assert!(
        warning(&loaded).ends_with("(3 times, first in line 8)"),
        "{}",
        loaded.notes
    );
}

#[test]
fn unknown_and_free_form_statements_are_reported_once() {
    let loaded = after_points("hello 1\nmoin 2\nf 1 2 3\n");
    assert_eq!(
        warning(&loaded),
        "`hello` is not an OBJ statement and is ignored (2 times, first in line 6)"
    );
    let loaded = after_points("cstype bezier\ncurv 0 1 1 2 3\nf 1 2 3\n");
    assert!(
        warning(&loaded).starts_with("free-form curves and surfaces"),
        "{}",
        loaded.notes
    );
    // `fo` is an older keyword for faces.
    assert_eq!(polygons(&after_points("fo 1 2 3\n")), [[0, 1, 2]]);
}

/// The shipped OBJ files are closed (each edge once in each direction), give no warning, and have
/// the expected size.
#[test]
fn shipped_meshes() {
    for (name, positions, polygon_count, sides, materials) in [
        ("vase", 1152, 1122, &[4, 32][..], 2),
        ("football", 60, 32, &[5, 6][..], 2),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("scenes")
            .join(name)
            .with_extension("obj");
        let loaded = load_mesh(&path).unwrap();
        assert_eq!(loaded.notes, Notes::default(), "{name}");
        let mesh = &loaded.mesh;
        assert_eq!(
            (
                mesh.positions().len(),
                mesh.polygon_count(),
                mesh.materials().len()
            ),
            (positions, polygon_count, materials)
        );
        let mut edges = HashSet::new();
        for (p, polygon) in mesh.polygons().enumerate() {
            assert!(
                sides.contains(&polygon.len()),
                "{name}: {} sides",
                polygon.len()
            );
            assert!(mesh.polygon_material(p).is_some());
            for (k, &from) in polygon.iter().enumerate() {
                assert!(
                    edges.insert((from, polygon[(k + 1) % polygon.len()])),
                    "{name}: an edge twice"
                );
            }
        }
        assert!(
            edges.iter().all(|&(from, to)| edges.contains(&(to, from))),
            "{name} has a hole"
        );
        // Six times the volume, as the sum over fans of triangles. It is positive if polygons face
        // outward.
        let volume = |a: u32, b: u32, c: u32| {
            let at = |i: u32| mesh.positions()[i as usize].as_dvec3();
            at(a).dot(at(b).cross(at(c)))
        };
        let fans = mesh
            .polygons()
            .map(|p| p.windows(2).map(|w| volume(p[0], w[0], w[1])).sum::<f64>());
        assert!(fans.sum::<f64>() > 0.0, "{name} is inside out");
        assert!(
            std::fs::metadata(&path).unwrap().len() <= 60_000,
            "{}",
            path.to_string_lossy().to_string()
        );
    }
}

#[test]
fn colours_follow_their_positions() {
    // Position 1 is unused, and the face names the others in another order than the file.
    let points = "v 9 9 9 0 0 0\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0 # green\nv 0 1 0 0 0.25 1\n";
    let loaded = parse(points.to_string() + "f 4 2 3\n").unwrap();
    assert_eq!(
        loaded.mesh.colours(),
        [Vec3::new(0.0, 0.25, 1.0), Vec3::X, Vec3::Y]
    );
    assert_eq!(loaded.notes, Notes::default());
    // Faces may precede positions.
    let loaded = parse("f 4 2 3\n".to_string() + points).unwrap();
    assert_eq!(
        loaded.mesh.colours(),
        [Vec3::new(0.0, 0.25, 1.0), Vec3::X, Vec3::Y]
    );
}

#[test]
fn colours_are_used_if_all_positions_of_faces_have_one() {
    for (first, last, line) in [
        ("v 0 0 0 1 0 0", "v 0 1 0", 5),
        ("v 0 0 0", "v 0 1 0 1 0 0", 5),
        ("v 0 0 0 1 0 0", "v 0 1 0 nan 0 0", 5),
    ] {
        let loaded = parse(format!("{first}\nv 1 0 0 0 1 0\n{last}\n\nf 1 2 3\n")).unwrap();
        assert!(loaded.mesh.colours().is_empty());
        let expected = format!(
            "a face uses a position that has no colour: the colours of the others are not used (line {line})"
        );
        assert_eq!(sentences(&loaded.notes), [expected]);
    }
    // Unused positions count neither as missing, nor as out of range, nor as having colours.
    let colours = [Vec3::X, Vec3::Y, Vec3::Z];
    let points = "v 9 9 9\nv 0 0 0 1 0 0\nv 8 8 8 255 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 7 7 7\n";
    let loaded = parse(format!("{points}f 2 4 5\n")).unwrap();
    assert_eq!(
        (loaded.mesh.colours(), loaded.notes.iter().count()),
        (&colours[..], 0)
    );
    let loaded = after_points("v 7 7 7 1 0 0\nf 1 2 3\n");
    assert!(loaded.mesh.colours().is_empty() && loaded.notes.is_empty());

    let loaded = parse("v 0 0 0 255 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 -1\nf 1 2 3\n").unwrap();
    assert_eq!(loaded.mesh.colours()[0], Vec3::new(255.0, 0.0, 0.0));
    let told = warning(&loaded);
    assert!(told.contains("not within 0 to 1") && told.contains("2 times"));
    let bytes = "v 0 0 0 255 0 0\nv 1 0 0 0 128 0\nv 0 1 0 0 0 64\nf 1 2 3\n";
    let loaded = parse(bytes).unwrap();
    assert_eq!(loaded.mesh.colours()[1], Vec3::new(0.0, 128.0, 0.0));
    assert_eq!(
        sentences(&loaded.notes)[1..],
        ["the colours look like 0 to 255: divide them by 255"]
    );
    // Numbers after a colour, such as alpha, are ignored; four numbers are a position with a
    // weight, five are no colour.
    let loaded =
        parse("v 0 0 0 1 0 0 1\nv 1 0 0 0 1 0 .5 x\nv 0 1 0 0 0 1 nan\nf 1 2 3\n").unwrap();
    assert_eq!(
        (loaded.mesh.colours(), loaded.notes.iter().count()),
        (&colours[..], 0)
    );
    for more in ["1", "0 1"] {
        let text = format!("v 0 0 0 {more}\nv 1 0 0 {more}\nv 0 1 0 {more}\nf 1 2 3\n");
        let loaded = parse(text).unwrap();
        assert!(loaded.mesh.colours().is_empty() && loaded.notes.is_empty());
    }
}

#[test]
fn an_index_far_ahead_takes_no_memory() {
    // Four bytes for each position up to that index would be more than processors can address.
    let error = parse(format!("f 1 2 {}\n{POINTS}", 1u64 << 50)).unwrap_err();
    assert!(error.to_string().contains("out of range: expected 1 to 5"));
}

#[test]
fn normals_that_no_face_names_are_reported_once() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let told = |text: String| sentences(&parse(&text).unwrap().notes);
    let unused = "a normal that no face uses is ignored";
    let all = told(format!("{triangle}vn 0 0 1\nvn 0 1 0\nf 1 2 3\n"));
    assert_eq!(all, [format!("{unused} (2 times, first in line 4)")]);
    let one = told(format!("{triangle}vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\n"));
    assert_eq!(one, [format!("{unused} (line 5)")]);
    // A face may name a normal before its line, or backwards.
    for corners in [
        "f 1//1 2//1 3//2\nvn 0 0 1\nvn 0 1 0\n",
        "vn 0 0 1\nf 1//-1 2//-1 3//-1\n",
    ] {
        assert_eq!(told(format!("{triangle}{corners}")), [""; 0], "{corners}");
    }
}

#[test]
fn a_nul_that_ends_a_line_or_stands_in_a_comment_or_a_name_refuses_nothing() {
    let plain = after_points("f 1 2 3\n");
    for text in [
        "f 1 2 3\n\0",
        "f 1 2 3\0",
        "f 1 2 3\n\0\0\n\0",
        "f 1 2 3\0\r\n",
        "f 1 2 3\n\x1a\0",
        "# a comment\0 of C\nf 1 2 3\n",
        "g a\0b\nf 1 2 3 # c\0d\n",
        "\0f 1 2 \\\0\n\x003\n",
        "o cube\0\nf 1 2 3\n",
        "\x1af 1 2 3\n",
    ] {
        let loaded = after_points(text);
        assert_eq!(loaded.mesh, plain.mesh, "{text:?}");
        assert_eq!(loaded.notes, Notes::default(), "{text:?}");
    }
}

#[test]
fn a_byte_order_mark_at_the_start_of_any_line_is_skipped() {
    for mark in ["\u{feff}", "\u{feff}\u{feff} "] {
        let loaded = parse(format!(
            "{mark}{POINTS}{mark}f 1 2 3\n{mark}\n{mark}f 1 3 4\n{mark}"
        ));
        let loaded = loaded.unwrap();
        assert_eq!(polygons(&loaded), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(loaded.notes, Notes::default());
    }
    // The mark in a file that is decoded as Latin-1 because of its name.
    let mut bytes = POINTS.as_bytes().to_vec();
    bytes.extend(b"\xef\xbb\xbfg caf\xe9\n\xef\xbb\xbff 1 2 3\n");
    let loaded = parse(bytes).unwrap();
    assert_eq!(polygons(&loaded), [[0, 1, 2]]);
    assert_eq!(loaded.notes, Notes::default());
}

#[test]
fn blank_lines_and_comments_do_not_end_a_continued_statement_and_statements_do() {
    for text in [
        "f 1 2 \\\n\n3 4\n",
        "f 1 2 \\\r\n \r\n\t\r\n3 \\\r\n\r\n4\r\n",
        "f 1 2 \\\n# the rest\n3 4 # all\n",
        "f 1 2 3 4 \\\n\n",
        "f 1 2 3 4 \\",
        "f 1 2 3 4 \\\n\ns 1\n",
        "f 1 2 3 4 \\\ng left\n",
    ] {
        let loaded = after_points(text);
        assert_eq!(polygons(&loaded), [[0, 1, 2, 3]], "{text:?}");
        assert_eq!(loaded.notes, Notes::default(), "{text:?}");
    }
    let loaded = after_points("f 1 2 3 \\\n\nf 1 3 4 \\\nv 0 0 2\nf 1 2 6\n");
    assert_eq!(polygons(&loaded), [[0, 1, 2], [0, 2, 3], [0, 1, 4]]);
    // The words of a parameter line may look like statements.
    let loaded = after_points("parm \\\nv 0 0 1\nparm u 0 \\\n\nv 0 0 3\nf 1 2 6\n");
    assert_eq!(loaded.mesh.bounds().unwrap().1.z, 3.0);
}
