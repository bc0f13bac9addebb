//! Meshes as people find them: far from the origin, tiny, with normals and smoothing groups, inside
//! out, or out of sight.

use super::*;
use fastphong::mesh::PolygonMesh;
use fastphong::mesh::builtin::builtin;
use std::fmt::Write;

/// Returns a built-in shape as OBJ text: scaled, then moved, and with its polygons reversed if
/// `reversed`. Its indices count backwards, so that several shapes can be concatenated.
fn obj(shape: &str, scale: f64, at: [f64; 3], reversed: bool) -> String {
    let mesh: PolygonMesh = builtin(shape).expect("a shape");
    let mut text = String::new();
    for p in mesh.positions() {
        let p = p.as_dvec3().to_array();
        let [x, y, z] = [0, 1, 2].map(|axis| at[axis] + scale * p[axis]);
        writeln!(text, "v {x:e} {y:e} {z:e}").expect("memory");
    }
    let index = |&c: &u32| format!(" {}", i64::from(c) - mesh.positions().len() as i64);
    for polygon in mesh.polygons() {
        let mut words: Vec<String> = polygon.iter().map(index).collect();
        if reversed {
            words.reverse();
        }
        writeln!(text, "f{}", words.concat()).expect("memory");
    }
    text
}

/// Returns how many pixels differ by more than `levels`.
fn different(a: &Picture8, b: &Picture8, levels: u8) -> usize {
    let pixels = a.pixels().iter().zip(b.pixels());
    let off = |(p, q): &(&[u8; 4], &[u8; 4])| (0..4).any(|c| p[c].abs_diff(q[c]) > levels);
    pixels.filter(off).count()
}

const ROUND: &str = "sphere?rings=24&segments=48";

#[test]
fn a_mesh_far_from_the_origin_looks_like_one_at_the_origin() {
    let folder = Folder::new();
    folder.write("near.obj", obj(ROUND, 1.0, [0.0; 3], false));
    folder
        .run("render near.obj -o near.png --size 160x120")
        .done();
    let near = picture(&folder.path("near.png"));
    for (name, scale, at) in [
        ("sphere", 1.0, [4e5, 4e6, 0.0]),
        ("utm", 10.0, [500_000.0, 5_400_000.0, 250.0]),
        ("ecef", 50.0, [4_027_894.0, 307_046.0, 4_919_499.0]),
        ("gigametre", 1.0, [-1e9, 1e9, 1e9]),
        ("tiny", 1e-7, [1.0, 1.0, 1.0]),
        ("tiny at the origin", 1e-7, [0.0; 3]),
        ("one axis", 0.5, [0.0, 0.0, -3e7]),
    ] {
        folder.write("far.obj", obj(ROUND, scale, at, false));
        let ended = folder
            .run("render far.obj -o far.png --size 160x120")
            .done();
        assert_eq!(ended.err, "far.png: 160x120, phong-rsqrt\n", "{name}");
        let far = picture(&folder.path("far.png"));
        assert!(covered(&far) > 5000, "{name}: {}", covered(&far));
        // Coordinates in the text are rounded to 2⁻⁵³ of the distance, so a vertex may snap to the
        // next 1/256 pixel. Where an edge passes that close to one of the 4 samples of a pixel,
        // coverage flips.
        let off = different(&near, &far, 1);
        assert!(off <= 12, "{name}: {off} pixels differ");
    }
}

#[test]
fn a_checkerboard_far_from_the_origin_has_straight_lines() {
    let folder = Folder::new();
    for (name, x) in [("near", 0.0), ("far", 4e5)] {
        folder.write(
            &format!("{name}.obj"),
            obj(ROUND, 1.0, [x, 4e6, 0.0], false),
        );
        let board = format!("render {name}.obj -o {name}.png --size 96x72 --aov checkerboard");
        folder.run(&(board + " --square 0.5")).done();
    }
    let [near, far] = ["near.png", "far.png"].map(|name| picture(&folder.path(name)));
    // Pixels may differ where a line passes their centre within the rounding of either picture.
    assert!(different(&near, &far, 1) <= 12);
}

#[test]
fn a_camera_far_from_the_mesh_sees_it_lit_as_a_near_one_does() {
    let folder = Folder::new();
    folder.write("ball.obj", obj(ROUND, 1.0, [0.0; 3], false));
    let draw = |eye: &str, viewer: &str| {
        let command = format!(
            "render ball.obj --eye 0,0,{eye} --half-height 1.2 --light-at 1.5,1,1 --viewer {viewer}"
        );
        folder.run(&(command + " -o out.png --size 96x72")).done();
        picture(&folder.path("out.png"))
    };
    let near = draw("5", "infinite");
    assert!(covered(&near) > 2000);
    for eye in ["1e4", "1e6", "1e9", "1e12"] {
        for viewer in ["infinite", "local"] {
            // From a distance of 10⁴ on, a viewer at the eye draws the same picture as one at
            // infinity: its direction differs by 10⁻⁴.
            assert_eq!(different(&near, &draw(eye, viewer), 1), 0, "{eye} {viewer}");
        }
    }
}

#[test]
fn an_unused_position_at_the_origin_does_not_change_a_far_mesh() {
    let folder = Folder::new();
    let far = obj(ROUND, 1.0, [4e5, 4e6, 0.0], false);
    folder.write("far.obj", &far);
    folder.write("stray.obj", far + "v 0 0 0\n");
    for name in ["far", "stray"] {
        let command = format!("render {name}.obj -o {name}.png --size 64x48");
        folder.run(&command).done();
    }
    assert_eq!(folder.read("far.png"), folder.read("stray.png"));
}

#[test]
fn a_far_mesh_is_placed_lit_and_described_where_it_is() {
    let folder = Folder::new();
    folder.write("near.obj", obj(ROUND, 1.0, [0.0; 3], false));
    folder.write("far.obj", obj(ROUND, 1.0, [4e5, 4e6, 0.0], false));
    // `far` moves the eye and the light to the mesh; `back` moves the mesh to the origin.
    let near = "[camera]\neye = [2, 1, 5]\nfovy = 30\n[[light]]\nposition = [0.7, 0.7, 0.6]\n[[object]]\nmesh = 'near.obj'\n";
    let far = "[camera]\neye = [400002, 4000001, 5]\ntarget = [400000, 4000000, 0]\nfovy = 30\n\
               [[light]]\nposition = [400000.7, 4000000.7, 0.6]\n[[object]]\nmesh = 'far.obj'\n";
    let back = near.replace("near.obj'", "far.obj'\ntranslate = [-400000, -4000000, 0]");
    for (name, text) in [("near", near), ("far", far), ("back", &back)] {
        folder.write(&format!("{name}.toml"), text);
        folder
            .run(&format!("render {name}.toml -o {name}.png --size 64x48"))
            .done();
    }
    let near = picture(&folder.path("near.png"));
    assert!(covered(&near) > 500);
    for name in ["far.png", "back.png"] {
        assert!(
            different(&near, &picture(&folder.path(name)), 1) <= 4,
            "{name}"
        );
    }
    let info = folder.run("info far.obj --json").done().json();
    let bounds = &info["objects"][0]["bounds"];
    assert_eq!(bounds[0][0].as_f64(), Some(399_999.0));
    assert_eq!(bounds[1][1].as_f64(), Some(4_000_001.0));
}

#[test]
fn objects_too_far_apart_for_32_bits_are_reported() {
    let folder = Folder::new();
    let [near, far] = [0.0, 5e6].map(|x| obj("cube?res=8", 1.0, [x, 0.0, 0.0], false));
    folder.write("both.obj", near + &far);
    folder
        .run("info both.obj")
        .done()
        .says("polygons are so small, so far from the middle of the mesh, that 32-bit coordinates bend their shape");
}

#[test]
fn coordinates_beyond_every_scene_are_refused_in_the_words_of_the_user() {
    let folder = Folder::new();
    folder.write("over.obj", obj("cube", 1.0, [2e15, 0.0, 0.0], false));
    let refused = folder.run("render over.obj -o out.png");
    refused.refused(&[
        "error: `over.obj` reaches too far: expected coordinates between -1e15 and 1e15",
    ]);
    folder.write("over.toml", "[[object]]\nmesh = 'over.obj'\n");
    let refused = folder.run("render over.toml -o out.png");
    refused.refused(&["`object.mesh` `over.obj` reaches too far", "over.toml:2:8"]);
}

/// A cube as Blender writes it: it carries flat normals, and `s off`.
const CUBE: &str = "o Cube\nv 1 1 -1\nv 1 -1 -1\nv 1 1 1\nv 1 -1 1\nv -1 1 -1\nv -1 -1 -1\nv -1 1 1\nv -1 -1 1\n\
    vn 0 1 0\nvn 0 0 1\nvn -1 0 0\nvn 0 -1 0\nvn 1 0 0\nvn 0 0 -1\ns off\n\
    f 1//1 5//1 7//1 3//1\nf 4//2 3//2 7//2 8//2\nf 8//3 7//3 5//3 6//3\n\
    f 6//4 2//4 4//4 8//4\nf 2//5 1//5 3//5 4//5\nf 6//6 5//6 1//6 2//6\n";

/// Returns [`CUBE`] without its normals.
fn without_normals() -> String {
    let lines = CUBE
        .lines()
        .filter(|line| !line.starts_with("vn"))
        .map(|line| {
            let words = line
                .split(' ')
                .map(|word| word.split("//").next().unwrap_or(word));
            words.collect::<Vec<_>>().join(" ") + "\n"
        });
    lines.collect()
}

#[test]
fn a_cube_drawn_with_sharp_edges_has_sharp_edges() {
    let folder = Folder::new();
    let smooth = without_normals().replace("s off\n", "");
    let on = without_normals().replace("s off", "s 1");
    // Put each side into a smoothing group of its own.
    let mut side = 0;
    let groups: String = without_normals()
        .lines()
        .map(|line| {
            if line.starts_with("f ") {
                side += 1;
                format!("s {side}\n{line}\n")
            } else {
                format!("{line}\n")
            }
        })
        .collect();
    // Only the first side lacks normals.
    let mixed = CUBE.replace("f 1//1 5//1 7//1 3//1", "f 1 5 7 3");
    for (name, text, normals) in [
        ("given", CUBE, "given with the mesh (chosen by auto)"),
        (
            "off",
            &without_normals(),
            "per polygon: its smoothing is off (chosen by auto)",
        ),
        (
            "zero",
            &without_normals().replace("s off", "s 0"),
            "per polygon: its smoothing is off (chosen by auto)",
        ),
        (
            "groups",
            &groups,
            "averaged by angle within its smoothing groups (chosen by auto)",
        ),
        (
            "mixed",
            &mixed,
            "given with the mesh at 20 of 24 corners, elsewhere per polygon: its smoothing is off (chosen by auto)",
        ),
        (
            "smooth",
            &smooth,
            "averaged by angle, as the file has none (chosen by auto)",
        ),
        ("on", &on, "averaged by angle (chosen by auto)"),
    ] {
        folder.write(&format!("{name}.obj"), text);
        let described = folder.run(&format!("info {name}.obj")).done();
        let told = match name {
            "mixed" => "warning: mixed.obj: a normal that no face uses is ignored (line 10)\n",
            _ => "",
        };
        assert_eq!(described.err, told, "{name}");
        let described = described.prints(&format!("normals     {normals}\n"));
        let command = format!("render {name}.obj -o {name}.png --size 96x72 --verbose");
        folder
            .run(&command)
            .done()
            .says(&format!("vertex normals of {name}.obj: {normals}\n"));
        assert!(described.out.contains("6 of 4 sides"));
    }
    let read = |name: &str| folder.read(&format!("{name}.png"));
    for name in ["off", "zero", "groups", "mixed"] {
        assert_eq!(read(name), read("given"), "{name}");
    }
    assert!(read("smooth") != read("given"));
    assert_eq!(read("on"), read("smooth"));
    folder
        .run("render smooth.obj -o crease.png --size 96x72 --normals crease=30")
        .done();
    assert_eq!(read("crease"), read("given"));
}

#[test]
fn only_unused_normals_and_smoothing_groups_are_reported() {
    let folder = Folder::new();
    folder
        .write("given.obj", CUBE)
        .write("off.obj", without_normals());
    let scene = |mesh: &str, more: &str| format!("[[object]]\nmesh = '{mesh}'\n{more}\n");
    let unused = |what: &str| format!("the {what} of the file are not used under ");
    let [normals, groups] = [unused("normals"), unused("smoothing groups")];
    for (text, told, not_told) in [
        (scene("given.obj", ""), vec![&normals], vec![&groups]),
        (
            scene("given.obj", "normals = 'averaged'"),
            vec![&normals],
            vec![&groups],
        ),
        (
            scene("given.obj", "crease = 30"),
            vec![&normals],
            vec![&groups],
        ),
        (
            scene("given.obj", "normals = 'auto'"),
            vec![],
            vec![&normals, &groups],
        ),
        (
            scene("given.obj", "normals = 'given'"),
            vec![],
            vec![&normals, &groups],
        ),
        (scene("off.obj", ""), vec![], vec![&normals, &groups]),
        (
            scene("off.obj", "normals = 'auto'"),
            vec![],
            vec![&normals, &groups],
        ),
        (
            scene("off.obj", "normals = 'given'"),
            vec![&groups],
            vec![&normals],
        ),
        (
            scene("off.obj", "crease = 30"),
            vec![&groups],
            vec![&normals],
        ),
        (scene("builtin:sphere", ""), vec![], vec![&normals, &groups]),
    ] {
        folder.write("scene.toml", &text);
        let mut ended = folder.run("info scene.toml").done();
        for part in told {
            ended = ended.says(part);
        }
        for part in not_told {
            assert!(!ended.err.contains(part), "{text}: {}", ended.err);
        }
        assert!(!ended.err.contains("warning"), "{}", ended.err);
    }
    folder
        .run("render given.obj --print-scene")
        .done()
        .prints("normals = \"auto\"\n");
    let printed = folder.run("render builtin:cube --print-scene").done();
    assert!(!printed.out.contains("normals"));
}

#[test]
fn a_triangle_that_clipping_removes_lies_outside_the_view() {
    let folder = Folder::new();
    folder.write(
        "far.obj",
        "v -200 0 0\nv -200 -200 0\nv 0 -200 0\nf 1 2 3\n",
    );
    for more in [
        "",
        " --samples 8",
        " --size 2000x1500",
        " --method slerp-phong",
    ] {
        folder
            .run(&format!(
                "render far.obj --eye 0,0,5 --half-height 1 -o out.png{more}"
            ))
            .done()
            .says("nothing is drawn: 1 polygon lies outside the view");
    }
}

#[test]
fn a_triangle_seen_from_behind_in_local_light_is_compared() {
    let folder = Folder::new();
    let seen = "compare builtin:triangle --light-at 1,2,3 --time-budget 0 --size 64x48 --eye";
    for (eye, told) in [("0,0,-5", "0 of 1 polygon"), ("0,0,5", "1 polygon")] {
        let ended = folder.run(&format!("{seen} {eye}")).done();
        assert!(ended.out.contains(told), "{}", ended.out);
        assert!(ended.out.contains("slerp-phong"), "{}", ended.out);
    }
}

#[test]
fn the_reason_why_nothing_is_visible_is_reported() {
    let folder = Folder::new();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    folder.write("triangle.obj", triangle);
    folder.write("cube.obj", without_normals());
    folder.write("bow.obj", format!("{triangle}v 1 1 0\nf 1 2 3 4\n"));
    folder.write("thin.obj", format!("{triangle}v 2 0 0\nf 1 2 4\n"));
    for (command, told) in [
        (
            "cube.obj --eye 0,0,9 --target 0,0,20 --half-height 1 --near 1 --far 5",
            "nothing is drawn: 6 polygons lie outside the view; --fit 0.8 brings all of them into view",
        ),
        (
            "cube.obj --eye 50,0,9 --target 50,0,0 --half-height 1",
            "nothing is drawn: 6 polygons lie outside the view",
        ),
        (
            "cube.obj --eye 0,0,9 --target 0,0,20 --fovy 30",
            "nothing is drawn: 6 polygons lie outside the view",
        ),
        (
            "cube.obj --eye 0,0,0 --target 0,0,1 --fovy 30 --near 0.1 --far 9",
            "nothing is drawn: 1 polygon is seen from the culled side, 5 lie outside the view; try --cull none",
        ),
        (
            "triangle.obj --view 180,0 --cull back",
            "nothing is drawn: 1 polygon is seen from the culled side; try --cull none",
        ),
        (
            "triangle.obj --view 90,0",
            "nothing is drawn: 1 polygon is seen edge-on or is far smaller than a pixel",
        ),
        (
            "triangle.obj --eye 0,0,9 --half-height 1000000",
            "nothing is drawn: 1 polygon is seen edge-on or is far smaller than a pixel",
        ),
        (
            "triangle.obj --eye 0,0,9 --half-height 70",
            "nothing is drawn: 1 polygon reaches into the view, but none covers the centre of a pixel",
        ),
        (
            "bow.obj --view 0,0",
            "warning: 1 of 2 polygons crosses itself and its areas cancel: it has no normal and is left out",
        ),
        (
            "thin.obj --view 0,0",
            "warning: 1 of 2 polygons has no area and is left out",
        ),
    ] {
        let ended = folder
            .run(&format!("render {command} -o out.png --size 64x48"))
            .done();
        let told_of_area = ended.err.contains("no area");
        assert_eq!(
            told_of_area,
            command.starts_with("thin"),
            "{command}: {}",
            ended.err
        );
        let ended = ended.says(told);
        let nothing = ended.err.contains("nothing is drawn");
        assert_eq!(
            nothing,
            told.contains("nothing"),
            "{command}: {}",
            ended.err
        );
        let picture = picture(&folder.path("out.png"));
        let first = picture.pixels()[0];
        let is_empty = picture.pixels().iter().all(|pixel| *pixel == first);
        assert_eq!(is_empty, nothing, "{command}");
    }
    // One of the two polygons is seen edge-on, which needs no warning.
    folder.write("two.obj", format!("{triangle}v 0 0 1\nf 1 3 4\n"));
    let ended = folder
        .run("render two.obj --view 0,0 -o out.png --size 64x48 --cull back --normals averaged")
        .done();
    assert_eq!(ended.err, "out.png: 64x48, phong-rsqrt\n");
}

#[test]
fn a_closed_mesh_that_is_wound_inside_out_is_reported() {
    let folder = Folder::new();
    folder.write("right.obj", obj("cube", 1.0, [0.0; 3], false));
    folder.write("wrong.obj", obj("cube", 1.0, [0.0; 3], true));
    folder.write("far.obj", obj("torus", 1.0, [3e6, 0.0, -2e5], true));
    let told = "the mesh is closed and wound inside out, so that its outside is not drawn: turn the faces around, or try \
                --cull none --two-sided\n";
    for name in ["wrong", "far"] {
        let described = folder.run(&format!("info {name}.obj")).done();
        described
            .says(&format!("warning: {name}.obj: {told}"))
            .prints("closed, wound inside out\n");
        let command = format!("render {name}.obj -o wrong.png --size 64x48");
        folder.run(&command).done().says(told);
    }
    // With these flags the outside is drawn, and the warning does not call it missing.
    for flag in ["--cull none", "--cull front"] {
        let command = format!("render wrong.obj -o wrong.png --size 64x48 {flag}");
        let ended = folder.run(&command).done();
        ended.says("wound inside out, so that its outside is lit from within: turn");
    }
    let right = folder
        .run("render right.obj -o right.png --size 64x48")
        .done();
    assert!(!right.err.contains("inside out"));
    // The flags that the warning suggests draw the intended picture.
    let command = "render wrong.obj -o wrong.png --size 64x48 --cull none --two-sided";
    let ended = folder.run(command).done();
    assert!(!ended.err.contains("inside out"));
    let [right, wrong] = ["right.png", "wrong.png"].map(|name| picture(&folder.path(name)));
    assert_eq!(different(&right, &wrong, 1), 0);
}

#[test]
fn bounds_and_cameras_are_printed_with_digits_that_fit_their_size() {
    let folder = Folder::new();
    folder.write("tiny.obj", obj("cube", 1e-7, [0.0; 3], false));
    folder.write("far.obj", obj("cube", 1e-7, [1.0, 0.0, 0.0], false));
    folder.write("least.obj", obj("cube", 1e-20, [0.0; 3], false));
    folder
        .run("info least.obj")
        .done()
        .prints("bounds      (-1.0000e-20, -1.0000e-20, -1.0000e-20) to (1.0000e-20,")
        .prints("half height 1.641918e-20");
    let tiny = folder.run("info tiny.obj").done();
    tiny.prints("bounds      (-0.00000010000, -0.00000010000, -0.00000010000) to (0.00000010000, 0.00000010000, 0.00000010000)")
        .prints("camera   at (0.00000029925, 0.00000017955, 0.00000059851), toward (0.00000000000,");
    folder
        .run("info far.obj")
        .done()
        .prints("bounds      (0.99999990000, -0.00000010000,")
        .prints("to (1.00000010000, ");
    folder
        .run("info builtin:cube")
        .done()
        .prints("bounds      (-1.0000, -1.0000, -1.0000) to (1.0000, 1.0000, 1.0000)");
}

#[test]
fn curved_sheets_back_to_back_and_objects_that_touch_keep_their_normals() {
    let folder = Folder::new();
    let shell = obj("sphere?rings=12&segments=24", 1.0, [0.0; 3], false);
    // The inside shares all positions with the shell.
    let inside: String = shell
        .lines()
        .filter_map(|line| line.strip_prefix("f "))
        .map(|face| {
            let mut words: Vec<&str> = face.split(' ').collect();
            words.reverse();
            format!("f {}\n", words.join(" "))
        })
        .collect();
    folder
        .write("shell.obj", &shell)
        .write("both.obj", shell.clone() + &inside);
    for normals in ["auto", "averaged", "crease=180"] {
        for name in ["shell", "both"] {
            let command =
                format!("render {name}.obj -o {name}.png --size 64x48 --normals {normals}");
            folder.run(&command).done();
        }
        assert_eq!(
            folder.read("both.png"),
            folder.read("shell.png"),
            "{normals}"
        );
    }
}

/// If only one closed surface of an object is wound inside out, the warning states its size.
#[test]
fn a_single_surface_that_is_wound_inside_out_is_reported() {
    let folder = Folder::new();
    let right = obj("cube", 1.0, [0.0; 3], false);
    let wrong = obj("cube", 1.0, [5.0, 0.0, 0.0], true);
    folder.write("two.obj", right + &wrong);
    let described = folder.run("info two.obj").done();
    described
        .says("1 surface of the file, of 6 polygons, is closed and wound inside out")
        .prints("closed; 1 surface is closed and wound inside out\n");
}

/// The message does not say "1 of 1 polygons".
#[test]
fn the_only_polygon_is_called_the_only_polygon() {
    let folder = Folder::new();
    folder.write("bow.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n");
    let told = folder.run("render bow.obj -o bow.png").done();
    told.says("the only polygon crosses itself and its areas cancel");
    folder.write("line.obj", "v 0 0 0\nv 1 1 0\nv 2 2 0\nf 1 2 3\n");
    let told = folder.run("render line.obj -o line.png --view 0,0").done();
    told.says("the only polygon has no area and is left out");
    let quad = "render builtin:polygon?sides=5 -o out.png --engine barycentric";
    let told = folder.run(quad).done();
    told.says("1 polygon of more than three corners is cut into triangles for");
}

const SQUARE: &str = "v -1 -1 -0.3\nv 1 -1 0.2\nv 1 1 0.3\nv -1 1 -0.2\n";

#[test]
fn a_face_covered_by_its_own_pieces_is_reported_once() {
    let folder = Folder::new();
    folder.write(
        "pieces.obj",
        format!("{SQUARE}f 1 2 3 4\nf 1 2 3\nf 1 3 4\n"),
    );
    let ended = folder.run("render pieces.obj -o a.png --size 80x60").done();
    let told = "3 polygons meet others at the same depth up to rounding";
    assert_eq!(ended.err.matches(told).count(), 1, "{}", ended.err);
    assert!(!ended.err.contains("earlier"), "{}", ended.err);
    // `compare` counts their pixels, which it leaves out of errors.
    let table = folder.run("compare pieces.obj --methods flat --time-budget 0 --size 80x60");
    let told = "of the covered pixels: the depths there are equal up to ";
    assert_eq!(table.done().out.matches(told).count(), 1);
    // Equal depth levels get their own message, which suggests more bits.
    let levels = folder.run("render z-fighting -o a.png").done();
    assert!(levels.err.contains("in 16 bits"), "{}", levels.err);
    assert!(levels.err.contains("--depth-bits 32"), "{}", levels.err);
}

#[test]
fn a_doubled_face_is_reported_once_and_counted() {
    let folder = Folder::new();
    folder.write(
        "twice.obj",
        format!("{SQUARE}f 1 2 3 4\nf 2 3 4 1\nf 3 4 1 2\n"),
    );
    let ended = folder.run("render twice.obj -o a.png --size 80x60").done();
    let told = "2 polygons have the corners of earlier ones, which hide them\n";
    assert_eq!(ended.err.matches(told).count(), 1, "{}", ended.err);
    assert!(!ended.err.contains("rounding"), "{}", ended.err);
    let info = folder.run("info twice.obj").done().out;
    assert!(
        info.contains("doubled     2 with the corners of an earlier one"),
        "{info}"
    );
}

#[test]
fn a_ground_that_is_linear_on_the_screen_is_reported_unless_requested() {
    let folder = Folder::new();
    folder.write(
        "ground.obj",
        "v -50 0 2\nv 50 0 2\nv 50 0 -100\nv -50 0 -100\nf 1 2 3 4\n",
    );
    let near = "--eye 0,1,0 --target 0,0.8,-10 --fovy 60 --light-at 0,2,-4 --viewer local";
    let told = "--interpolation perspective makes them right";
    for (more, is_told) in [
        ("", true),
        (" --interpolation screen", false),
        (" --interpolation perspective", false),
    ] {
        let ended = folder.run(&format!(
            "render ground.obj {near}{more} -o a.png --size 80x60"
        ));
        assert_eq!(ended.done().err.contains(told), is_told, "{more}");
    }
    // Light from infinity and a distant viewer are constant over a plane, so there is nothing to
    // interpolate.
    let far = near
        .replace("--light-at", "--light")
        .replace("--viewer local", "");
    let ended = folder.run(&format!("render ground.obj {far} -o a.png --size 80x60"));
    assert!(!ended.done().err.contains(told));
}

/// A cube of triangles without normals. The diagonal of its first face ends at other corners than
/// the other diagonals do.
const TRIANGLES: &str = "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n\
    f 2 4 8\nf 2 8 6\nf 4 3 7\nf 4 7 8\nf 7 5 6\nf 7 6 8\nf 1 5 7\nf 1 7 3\nf 1 2 6\nf 1 6 5\nf 1 3 4\nf 1 4 2\n";

#[test]
fn weights_of_normals_are_compared_side_by_side() {
    let folder = Folder::new();
    folder.write("cube.obj", TRIANGLES);
    let compared = folder
        .run("compare cube.obj --weights --size 96x72")
        .done()
        .prints("against averages by angle\n");
    let numbers = |word: &str| {
        let line = compared.out.lines().find(|line| line.starts_with(word));
        let cells = line.expect("a line").split_whitespace().skip(1);
        cells
            .map(|cell| cell.parse().expect("a number"))
            .collect::<Vec<f64>>()
    };
    // The normal (2, 1, 1) is 19.47° from (1, 1, 1). With weights by angle and by Max, diagonals do
    // not matter.
    for word in ["uniform", "area"] {
        assert_eq!(numbers(word)[1], 19.5, "{word}");
        assert!(numbers(word)[3] > 10.0, "{word}");
    }
    for word in ["angle", "max"] {
        assert_eq!(numbers(word), [0.0; 4], "{word}");
    }
    // Shapes by formula have exact normals to compare with.
    folder
        .run("compare builtin:sphere?triangles=true --weights --size 96x72")
        .done()
        .prints("against the normals of the mesh\n");
    folder
        .run("compare cube.obj --weights --json")
        .refused(&["cannot be used with"]);
}

#[test]
fn normals_of_a_mesh_file_are_weighted_by_angle_unless_a_flag_says_otherwise() {
    let folder = Folder::new();
    folder.write("cube.obj", TRIANGLES);
    for (flags, normals) in [
        (
            "",
            "averaged by angle, as the file has none (chosen by auto)",
        ),
        (
            "--normals-weight uniform",
            "averaged, as the file has none (chosen by auto)",
        ),
        ("--normals averaged", "averaged by angle"),
        (
            "--normals crease=40",
            "averaged by angle up to a crease of 40 degrees",
        ),
        (
            "--normals crease=100 --normals-weight area",
            "averaged by area up to a crease of 100 degrees",
        ),
        (
            "--normals averaged --normals-weight max",
            "averaged by Max's weights",
        ),
    ] {
        folder
            .run(&format!("info cube.obj {flags}"))
            .done()
            .prints(&format!("normals     {normals}\n"));
    }
    folder
        .run("info builtin:cube")
        .done()
        .prints("normals     averaged\n");
    let printed = folder.run("render cube.obj --print-scene").done();
    printed.prints("normals = \"auto\"\nnormals_weight = \"angle\"\n");
}

#[test]
fn a_gltf_file_without_normals_is_flat_until_somebody_smooths_it() {
    let folder = Folder::new();
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../fuzz/corpus/gltf/double-sided-room"
    );
    let room = std::fs::read(path).expect("the corpus");
    folder.write("room.gltf", room).write(
        "scene.toml",
        "[[object]]\nmesh = 'room.gltf'\n[camera]\neye = [2, 3, 4]\nfit = 0.8\n",
    );
    let said = "the file has no normals: drawn flat, as glTF says";
    let view = "--view 30,20 --size 64x48";
    let drawn = |command: String, is_told: bool| {
        let ended = folder.run(&format!("render {command} -o a.png")).done();
        assert_eq!(
            ended.err.contains(said),
            is_told,
            "{command}: {}",
            ended.err
        );
        folder.read("a.png")
    };
    let mesh = |how: &str| format!("room.gltf {view} {how}");
    let flat = drawn(mesh(""), true);
    assert!(drawn(mesh("--normals averaged"), false) != flat);
    // The walls of a room meet at 90 degrees.
    assert_eq!(drawn(mesh("--normals crease=40"), false), flat);
    assert!(drawn(mesh("--normals crease=95"), false) != flat);
    let scene = |how: &str| format!("scene.toml --size 64x48 {how}");
    let smooth = drawn(scene(""), false);
    assert!(drawn(scene("--normals auto"), true) != smooth);
}

#[test]
fn all_sets_of_joints_move_a_vertex() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../fuzz/corpus/gltf/joints-of-two-sets"
    );
    let folder = Folder::new();
    folder.write("a.gltf", std::fs::read(path).expect("the corpus"));
    // Half of all weights are those of a joint that moves x by 2.
    let bounds = "bounds      (1.0000, 0.0000, 0.0000) to (2.0000, 1.0000, 0.0000)";
    assert!(folder.run("info a.gltf").done().out.contains(bounds));
}
