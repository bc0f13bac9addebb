//! Mesh files whose winding does not tell the outside: no part of them vanishes, and no lit part is
//! dark.

use super::*;
use std::fmt::Write;

/// Returns the quads of a wavy 8 × 8 terrain, all seen from above.
fn terrain() -> Vec<[usize; 4]> {
    let at = |x: usize, y: usize| 9 * y + x + 1;
    let quads = (0..64).map(|k| (k % 8, k / 8));
    quads
        .map(|(x, y)| [at(x, y), at(x, y + 1), at(x + 1, y + 1), at(x + 1, y)])
        .collect()
}

/// Returns the terrain as OBJ text, with the quad at index k reversed if `reversed(k)`.
fn terrain_obj(reversed: impl Fn(usize) -> bool) -> String {
    let mut text = String::new();
    for k in 0..81 {
        let (x, z) = (f64::from(k % 9), f64::from(k / 9));
        let y = 0.5 * (0.9 * x).sin() * (0.7 * z).cos();
        writeln!(text, "v {x} {y} {z}").expect("memory");
    }
    for (k, mut quad) in terrain().into_iter().enumerate() {
        if reversed(k) {
            quad.reverse();
        }
        let [a, b, c, d] = quad;
        writeln!(text, "f {a} {b} {c} {d}").expect("memory");
    }
    text
}

/// Returns a cube with flat normals as OBJ text. The normals point outward if `sign` is 1. The
/// sides at the indices `reversed` are wound inside out.
fn cube_obj(sign: i32, reversed: &[usize]) -> String {
    let mut text = String::from(
        "v 1 1 -1\nv 1 -1 -1\nv 1 1 1\nv 1 -1 1\nv -1 1 -1\nv -1 -1 -1\nv -1 1 1\nv -1 -1 1\n",
    );
    for [x, y, z] in [
        [0, 1, 0],
        [0, 0, 1],
        [-1, 0, 0],
        [0, -1, 0],
        [1, 0, 0],
        [0, 0, -1],
    ] {
        writeln!(text, "vn {} {} {}", sign * x, sign * y, sign * z).expect("memory");
    }
    let sides = [
        [1, 5, 7, 3],
        [4, 3, 7, 8],
        [8, 7, 5, 6],
        [6, 2, 4, 8],
        [2, 1, 3, 4],
        [6, 5, 1, 2],
    ];
    for (side, mut corners) in sides.into_iter().enumerate() {
        if reversed.contains(&side) {
            corners.reverse();
        }
        let corners = corners.map(|corner| format!(" {corner}//{}", side + 1));
        writeln!(text, "f{}", corners.concat()).expect("memory");
    }
    text
}

/// Draws the OBJ text `text` with `flags`. Returns the picture and the messages.
fn drawn(text: &str, flags: &str) -> (Picture8, String) {
    let folder = Folder::new();
    folder.write("mesh.obj", text);
    let command = format!("render mesh.obj -o out.png --size 96x72 {flags}");
    let ended = folder.run(&command).done();
    (picture(&folder.path("out.png")), ended.err)
}

fn largest_difference(a: &Picture8, b: &Picture8) -> u8 {
    let channels = |picture: &Picture8| picture.pixels().iter().flatten().copied().collect();
    let (a, b): (Vec<u8>, Vec<u8>) = (channels(a), channels(b));
    let apart = a.iter().zip(&b).map(|(p, q)| p.abs_diff(*q));
    apart.max().expect("a picture has pixels")
}

const TOLD: &str = "drawn and lit on both sides (--cull back draws front sides only)";

#[test]
fn a_terrain_with_a_third_of_its_faces_reversed_has_no_holes() {
    let view = "--view 20,50 -m flat --alpha coverage";
    let (right, told) = drawn(&terrain_obj(|_| false), view);
    assert!(told.contains(&format!(
        "mesh.obj: 32 edges are open: its polygons are {TOLD}"
    )));
    assert!(covered(&right) > 1000);
    let third = terrain_obj(|k| k % 3 == 0);
    let (mixed, told) = drawn(&third, view);
    assert!(
        told.contains(
            "mesh.obj: 32 edges are open, 76 edges lie between polygons wound differently:"
        ),
        "{told}"
    );
    assert_eq!(told.lines().count(), 2, "{told}");
    // Each polygon's normal turns toward the eye, whichever way the polygon is wound.
    assert_eq!(largest_difference(&right, &mixed), 0);
    // The same holds from below.
    let below = "--view 20,-50 -m flat --alpha coverage";
    let [right, mixed] = [terrain_obj(|_| false), third.clone()].map(|text| drawn(&text, below).0);
    assert_eq!(largest_difference(&right, &mixed), 0);
    // A flag overrides the automatic choice.
    let (culled, told) = drawn(&third, &format!("{view} --cull back"));
    assert!(!told.contains("mesh.obj"), "{told}");
    assert!(covered(&culled) < covered(&right));
}

#[test]
fn normals_decide_how_a_cube_is_drawn_however_its_sides_are_wound() {
    let (right, told) = drawn(&cube_obj(1, &[]), "");
    assert!(!told.contains("mesh.obj"), "{told}");
    for (sign, reversed, why) in [
        (
            1,
            &[1, 4][..],
            "6 edges lie between polygons wound differently, 2 polygons are wound against their own normals",
        ),
        (
            1,
            &[0, 1, 2, 3, 4, 5],
            "6 polygons are wound against their own normals",
        ),
        (-1, &[], "6 polygons are wound against their own normals"),
        (
            -1,
            &[0, 3],
            "edges lie between polygons wound differently, 4 polygons are wound against their own normals",
        ),
    ] {
        for flags in ["", "--cull none", "--cull none --two-sided"] {
            let (drawn, told) = drawn(&cube_obj(sign, reversed), flags);
            assert_eq!(
                largest_difference(&right, &drawn),
                0,
                "{sign} {reversed:?} {flags}"
            );
            let is_told = told.contains(why) && !told.contains("warning");
            assert_eq!(is_told, !flags.contains("two-sided"), "{told}");
        }
    }
}

#[test]
fn a_plane_that_is_wound_away_from_the_eye_is_drawn_and_lit() {
    let plane =
        |face: &str| format!("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 -1\n{face}\n");
    let views = [
        "--view 10,10",
        // The near plane cuts the plane.
        "--eye 0.5,-0.3,0.1 --target 0.5,0.5,0 --fovy 60 --near 0.25 --far 9",
    ];
    for view in views {
        let (right, _) = drawn(&plane("f 1//1 2//1 3//1 4//1"), view);
        assert!(right.pixels().iter().any(|pixel| pixel[0] > 150), "{view}");
        for face in [
            "f 4//1 3//1 2//1 1//1",
            "f 4 3 2 1",
            "f 1//2 2//2 3//2 4//2",
            "f 4//2 3//2 2//2 1//2",
        ] {
            for flags in ["", "--cull none", "--two-sided", "--cull none --two-sided"] {
                let (drawn, told) = drawn(&plane(face), &format!("{view} {flags}"));
                assert_eq!(
                    largest_difference(&right, &drawn),
                    0,
                    "{view} {face} {flags}"
                );
                assert!(!told.contains("has no effect"), "{told}");
            }
        }
    }
    let (nothing, told) = drawn(
        &plane("f 4//1 3//1 2//1 1//1"),
        "--view 10,10 --cull back --alpha coverage",
    );
    assert_eq!(covered(&nothing), 0);
    assert!(told.contains("nothing is drawn: 1 polygon is seen from the culled side"));
}

/// A program mirrored the wheels: they are closed and inside out, and the body around them is not.
#[test]
fn a_closed_part_that_is_inside_out_among_others_is_drawn() {
    let part = |x: f64, reversed: bool| {
        let all = if reversed {
            &[0, 1, 2, 3, 4, 5][..]
        } else {
            &[]
        };
        let text = cube_obj(1, all);
        let lines = text.lines().filter(|line| !line.starts_with("vn"));
        let mut part = String::new();
        for line in lines {
            let words: Vec<&str> = line.split(' ').collect();
            match words[..] {
                ["v", at, y, z] => {
                    let at: f64 = at.parse().expect("a number");
                    writeln!(part, "v {} {y} {z}", at + x).expect("memory");
                }
                _ => {
                    part.push('f');
                    for word in &words[1..] {
                        let corner: i32 = word
                            .split('/')
                            .next()
                            .expect("a corner")
                            .parse()
                            .expect("a number");
                        write!(part, " {}", corner - 9).expect("memory");
                    }
                    part.push('\n');
                }
            }
        }
        part
    };
    let (right, _) = drawn(&(part(0.0, false) + &part(4.0, false)), "");
    let (mirrored, told) = drawn(&(part(0.0, false) + &part(4.0, true)), "");
    assert!(told.contains("1 surface of the file, of 6 polygons, is closed and wound inside out: its polygons are drawn"));
    assert!(!told.contains("warning"), "{told}");
    assert!(largest_difference(&right, &mirrored) <= 1);
}

#[test]
fn the_printed_scene_of_an_open_mesh_draws_the_same_picture() {
    let folder = Folder::new();
    folder
        .write("open.obj", terrain_obj(|k| k % 3 == 0))
        .write("closed.obj", cube_obj(1, &[]));
    let flags = "--size 64x48";
    let printed = folder
        .run(&format!("render open.obj {flags} --print-scene"))
        .done()
        .prints("cull = \"none\"\n")
        .prints("two_sided = true\n");
    folder.write("printed.toml", &printed.out);
    for (input, name) in [("open.obj", "a.png"), ("printed.toml", "b.png")] {
        folder
            .run(&format!("render {input} {flags} -o {name}"))
            .done();
    }
    assert_eq!(folder.read("a.png"), folder.read("b.png"));
    for (command, is_printed) in [
        ("render closed.obj", false),
        ("render open.obj --cull back", false),
        ("render open.obj --aov normal", true),
        ("render open.obj --cull none", true),
    ] {
        let printed = folder.run(&format!("{command} --print-scene")).done();
        assert_eq!(printed.out.contains("two_sided"), is_printed, "{command}");
    }
}

#[test]
fn meshes_in_scenes_and_built_in_ones_keep_their_culling() {
    let folder = Folder::new();
    folder.write("open.obj", terrain_obj(|k| k % 3 == 0)).write(
        "scene.toml",
        "[camera]\nazimuth = 20\nelevation = 50\n[[object]]\nmesh = 'open.obj'\n",
    );
    for input in ["scene.toml", "builtin:terrain"] {
        let printed = folder.run(&format!("render {input} --print-scene")).done();
        assert_eq!(printed.err, "", "{input}");
        assert!(!printed.out.contains("cull"), "{input}");
    }
    for command in [
        "compare open.obj --time-budget 0 --size 32x24 -m flat",
        "info open.obj",
    ] {
        folder.run(command).done().says(TOLD);
    }
}
