//! Hints: the tool explains why a scene may look different from what its author expects, and which
//! flags to try.

use super::Folder;
use fastphong::mesh::builtin::builtin;

/// Writes a pyramid whose highlight covers everything: its material has the exponent 0, as MeshLab
/// writes it.
fn flat_highlight(folder: &Folder) {
    let obj = "mtllib a.mtl\nusemtl shiny thing\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1 0\n\
               f 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\nf 1 2 3 4\n";
    folder.write("a.obj", obj);
    folder.write("a.mtl", "newmtl shiny thing\nNs 0\nKs 1 1 1\n");
}

#[test]
fn clamped_light_is_reported_with_material_and_reason() {
    let folder = Folder::new();
    flat_highlight(&folder);
    let told = "material `shiny thing` of a.obj reaches";
    let why = "with an exponent (Ns, shininess) of 0 the highlight covers everything that is lit";
    let size = "--size 64x48";
    let render = folder.run(&format!("render a.obj -o a.png {size}")).done();
    let share = "% of the covered picture is clamped: its light is over 1 in all channels";
    for part in [told, why, share] {
        assert!(render.err.contains(part), "{}", render.err);
    }
    assert!(folder.run("info a.obj").done().out.contains(told));
    let compare = format!("compare a.obj --methods gouraud --time-budget 0 {size}");
    let compare = folder.run(&compare).done();
    assert!(compare.err.contains(told), "{}", compare.err);
    let head = compare.out.lines().find(|line| line.starts_with("method "));
    assert!(head.expect("a head").contains("clamped"), "{}", compare.out);
    assert!(
        compare.out.contains("so that errors vanish"),
        "{}",
        compare.out
    );
    let report = "report a.obj --methods gouraud --time-budget 0 -o r.html --json r.json --csv r.csv --markdown";
    let report = folder.run(&format!("{report} {size}")).done();
    assert!(report.err.contains(told), "{}", report.err);
    let text = |name: &str| String::from_utf8(folder.read(name)).expect("text");
    assert!(
        text("r.csv").contains("\"clamped, pixels\""),
        "{}",
        text("r.csv")
    );
    assert!(text("README.md").contains("is clamped, where errors vanish"));
    let json: serde_json::Value = serde_json::from_str(&text("r.json")).expect("JSON");
    let clamping = &json["comparisons"][0]["clamping"];
    let count = |name: &str| clamping[name].as_u64().expect("a count");
    assert!(count("clamped") > count("covered") / 2, "{clamping}");
}

/// A highlight of exactly 1 everywhere clamps nothing. It is still a white disc and gets its hint.
#[test]
fn a_highlight_that_covers_everything_is_reported_where_nothing_is_clamped() {
    let folder = Folder::new();
    flat_highlight(&folder);
    folder.write("a.mtl", "newmtl shiny thing\nNs 0\nKa 0\nKd 0\nKs 1\n");
    let told = "an exponent (Ns, shininess) of 0 makes a highlight of everything that is lit: material `shiny thing` of a.obj";
    assert!(folder.run("info a.obj").done().out.contains(told));
    let err = folder
        .run("render a.obj -o a.png --size 64x48 --light 0,1,1")
        .done()
        .err;
    assert!(err.contains(told) && !err.contains("clamped"), "{err}");
    let err = folder
        .run("render a.obj -o a.png --size 64x48 --shininess 20")
        .done()
        .err;
    assert!(!err.contains("exponent"), "{err}");
}

#[test]
fn light_that_is_not_clamped_gets_no_hint() {
    let folder = Folder::new();
    flat_highlight(&folder);
    for arguments in [
        "render a.obj -o a.png --size 64x48 --ks 0.2 --shininess 20 --kd 0.5",
        "render teapot -o a.png --size 64x48",
        // A white plane that faces a light of 1 is exactly 1, and nothing is cut off.
        "render builtin:polygon -o a.png --size 64x48 --light 0,0,1 --view 0,0 --ka 0 --ks 0 --kd 1",
    ] {
        let ended = folder.run(arguments).done();
        assert!(!ended.err.contains("clamped"), "{arguments}: {}", ended.err);
    }
    let compare = "compare teapot --methods gouraud --time-budget 0 --size 64x48";
    assert!(!folder.run(compare).done().out.contains("clamped"));
}

#[test]
fn colours_over_one_are_reported_only_if_they_are_drawn() {
    let folder = Folder::new();
    flat_highlight(&folder);
    folder.write("a.mtl", "newmtl shiny thing\nKd 255 0 0\nmap_Kd wood.png\n");
    let render = |flags: &str| {
        let arguments = format!("render a.obj -o a.png --size 32x24 {flags}");
        folder.run(&arguments).done().err
    };
    let err = render("");
    assert!(
        err.contains("a.mtl:2: `Kd 255 0 0`: a colour is not within 0 to 1"),
        "{err}"
    );
    let err = render("--kd 0.5");
    assert!(!err.contains("255") && !err.contains("textures"), "{err}");
    let err = render("--kd 255,0,0");
    let told = "`--kd` is 255: a surface that reflects more light than it gets";
    assert!(err.contains(told) && !err.contains("a.mtl"), "{err}");
    // One object overrides the material, the other does not.
    let objects = "[[object]]\nmesh = 'a.obj'\nmaterial = { kd = 0.5 }\n";
    folder.write("one.toml", objects);
    folder.write("two.toml", format!("{objects}[[object]]\nmesh = 'a.obj'\n"));
    let of = |scene: &str| {
        folder
            .run(&format!("render {scene} -o a.png --size 32x24"))
            .done()
            .err
    };
    assert!(!of("one.toml").contains("a.mtl:"), "{}", of("one.toml"));
    assert!(of("two.toml").contains("a.mtl:2:"), "{}", of("two.toml"));
}

#[test]
fn lights_that_reach_nothing_are_reported_with_the_reason() {
    let folder = Folder::new();
    let render = |arguments: &str| {
        let arguments = format!("render {arguments} -o a.png --size 32x24");
        folder.run(&arguments).done().err
    };
    let inside = "at (0.1, 0, 0), stands inside the closed surface of builtin:sphere and cannot light its outside";
    let err = render("builtin:sphere --light-at 0.1,0,0");
    assert!(
        err.contains(inside) && err.contains("only ambient light is drawn"),
        "{err}"
    );
    let err = render("builtin:sphere --light-at 0.1,0,0 --light 0,0,1");
    assert!(err.contains(inside) && !err.contains("ambient"), "{err}");
    // With front faces culled, the lit inside is visible.
    let err = render("builtin:sphere --light-at 0.1,0,0 --cull front --two-sided");
    assert!(!err.contains("light"), "{err}");
    let err = render("builtin:sphere --view 0,0 --light 0,0,-1");
    assert!(
        err.contains("the light does not reach anything visible: surfaces face away"),
        "{err}"
    );
    assert!(!err.contains("inside"), "{err}");
    let err = render("builtin:sphere --no-lights --ambient 0");
    assert!(
        err.contains("there is no light, and no ambient light: everything visible is black"),
        "{err}"
    );
    let err = render("builtin:sphere --no-lights --ka 0");
    assert!(err.contains("everything visible is black"), "{err}");
    let err = render("builtin:sphere --view 0,0 --light 0,0,-1 --ambient 0");
    assert!(
        err.contains("there is no ambient light, so everything visible is black"),
        "{err}"
    );
    for fine in [
        "builtin:sphere --no-lights --ambient 1",
        "builtin:sphere --light-at 3,3,3",
        "local-lights",
    ] {
        let err = render(fine);
        assert!(!err.contains("light"), "{fine}: {err}");
    }
    // The light stands inside one of the two objects.
    let two = "[[object]]\nmesh = 'builtin:cube'\n[[object]]\nmesh = 'builtin:sphere'\ntranslate = [4, 0, 0]\n\
               [[light]]\nposition = [4, 0, 0.1]\n";
    folder.write("two.toml", two);
    let err = render("two.toml");
    assert!(
        err.contains("at (4, 0, 0.1), stands inside the closed surface of builtin:sphere"),
        "{err}"
    );
    assert!(!err.contains("cube") && !err.contains("ambient"), "{err}");
}

#[test]
fn a_local_viewer_beyond_a_parallel_view_is_reported() {
    let folder = Folder::new();
    let render = |flags: &str| {
        let arguments = format!("render builtin:sphere {flags} -o a.png --size 32x24");
        folder.run(&arguments).done().err
    };
    let beyond = "--eye 0,0,-5 --target 0,0,-6 --half-height 2";
    let err = render(&format!("{beyond} --viewer local"));
    assert!(
        err.contains("the eye stands beyond everything that is visible"),
        "{err}"
    );
    let err = render("--eye 0,0,0.5 --target 0,0,-1 --half-height 2 --viewer local");
    assert!(err.contains("polygons: a parallel view"), "{err}");
    for fine in [
        beyond,
        "--viewer local",
        "--eye 0,0,5 --viewer local",
        "--eye 0,0,0 --target 0,0,-1 --fovy 60 --cull none --viewer local",
    ] {
        let err = render(fine);
        assert!(!err.contains("beyond"), "{fine}: {err}");
    }
}

/// Writes a built-in mesh as an OBJ file. Each corner has its own position, moved by `by` times the
/// index of its polygon.
fn corners_apart(spec: &str, by: f64) -> String {
    let mesh = builtin(spec).expect("a shape");
    let (mut obj, mut count) = (String::new(), 0);
    for (p, polygon) in mesh.polygons().enumerate() {
        for &corner in polygon {
            let [x, y, z] = mesh.positions()[corner as usize].as_dvec3().to_array();
            let x = x + by * (p % 2) as f64;
            obj += &format!("v {x} {y} {z}\n");
        }
        let corners = (count + 1..=count + polygon.len()).map(|i| i.to_string());
        obj += &format!("f {}\n", corners.collect::<Vec<_>>().join(" "));
        count += polygon.len();
    }
    obj
}

#[test]
fn a_mesh_with_sharp_edges_and_no_smoothing_groups_gets_a_hint() {
    let folder = Folder::new();
    let cube = corners_apart("cube", 0.0);
    folder.write("cube.obj", &cube);
    folder.write("smooth.obj", format!("s 1\n{cube}"));
    folder.write(
        "sphere.obj",
        corners_apart("sphere?rings=24&segments=48", 0.0),
    );
    let render = |arguments: &str| {
        let arguments = format!("render {arguments} -o a.png --size 32x24");
        folder.run(&arguments).done().err
    };
    let hint = "cube.obj: has neither normals (vn) nor smoothing groups (s): normals are averaged by angle, even over 12 edges that turn by more than \
                40 degrees; --normals crease=40 keeps these sharp\n";
    assert!(render("cube.obj").contains(hint), "{}", render("cube.obj"));
    assert_eq!(render("cube.obj").matches("crease=40").count(), 1);
    // The hint names OBJ statements only for OBJ files.
    let off = "OFF 8 6\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n\
               4 2 3 7 6\n4 3 0 4 7\n";
    folder.write("cube.off", off);
    let hint = "cube.off: has no normals: normals are averaged by angle, even over 12 edges that turn by more than 40 degrees";
    assert!(render("cube.off").contains(hint), "{}", render("cube.off"));
    for silent in [
        "cube.obj --normals crease=40",
        "cube.obj --normals averaged",
        "cube.obj --quiet",
        "smooth.obj",
        "sphere.obj",
        "builtin:cube",
    ] {
        assert!(
            !render(silent).contains("crease=40"),
            "{silent}: {}",
            render(silent)
        );
    }
    let info = folder.run("info cube.obj").done();
    assert!(info.out.contains("--normals crease=40"), "{}", info.out);
    assert!(!info.err.contains("crease=40"), "{}", info.err);
}

#[test]
fn positions_that_differ_by_rounding_get_a_hint_and_its_flag_closes_the_mesh() {
    let folder = Folder::new();
    folder.write("ball.obj", corners_apart("sphere?rings=6&segments=8", 1e-6));
    let err = folder
        .run("render ball.obj -o apart.png --size 64x48")
        .done()
        .err;
    assert!(
        err.contains("open edges would close") && err.contains("--weld 1e-6"),
        "{err}"
    );
    let err = folder
        .run("render ball.obj -o one.png --size 64x48 --weld 1e-6")
        .done()
        .err;
    assert!(!err.contains("weld"), "{err}");
    folder.write("exact.obj", corners_apart("sphere?rings=6&segments=8", 0.0));
    let err = folder
        .run("render exact.obj -o exact.png --size 64x48")
        .done()
        .err;
    assert!(!err.contains("weld"), "{err}");
    // The welded mesh is smooth like the exact one; the unwelded one shows facets.
    let against = |name: &str| folder.run(&format!("diff exact.png {name} --fail-above 3"));
    against("one.png").done();
    against("apart.png").differs();
    assert!(
        folder
            .run("info ball.obj --weld 1e-6")
            .done()
            .out
            .contains("closed")
    );
    let printed = folder
        .run("render ball.obj --weld 1e-6 --print-scene")
        .done()
        .out;
    assert!(
        printed.contains("weld = 1e-6") || printed.contains("weld = 0.000001"),
        "{printed}"
    );
    let refused = |value: &str| folder.run(&format!("render ball.obj -o a.png --weld={value}"));
    for value in ["0", "-1", "0.5", "nan", "1e300"] {
        refused(value).refused(&["`--weld`", "1e-12 to 0.1"]);
    }
}

#[test]
fn objects_that_cut_a_smooth_surface_get_a_hint() {
    let folder = Folder::new();
    let mesh = builtin("sphere?rings=16&segments=32").expect("a shape");
    let mut obj: String = mesh
        .positions()
        .iter()
        .map(|p| format!("v {} {} {}\n", p.x, p.y, p.z))
        .collect();
    let half = mesh.polygon_count() / 2;
    for (p, polygon) in mesh.polygons().enumerate() {
        obj += match p {
            0 => "o upper\n",
            p if p == half => "o lower\n",
            _ => "",
        };
        let corners: Vec<String> = polygon.iter().map(|c| (c + 1).to_string()).collect();
        obj += &format!("f {}\n", corners.join(" "));
    }
    folder.write("cut.obj", &obj);
    let err = folder
        .run("render cut.obj -o a.png --size 32x24")
        .done()
        .err;
    assert!(
        err.contains("objects (o) of the file meet in 32 edges of a smooth surface"),
        "{err}"
    );
    folder.write("one.obj", obj.replace("o lower\n", ""));
    let err = folder
        .run("render one.obj -o a.png --size 32x24")
        .done()
        .err;
    assert!(!err.contains("seams"), "{err}");
}

#[test]
fn up_turns_view_and_light_of_a_mesh_and_is_printed() {
    let folder = Folder::new();
    // The same mesh with y and z exchanged for z up: (x, y, z) becomes (x, −z, y).
    let mesh = builtin("teapot?res=4").expect("a shape");
    let written = |turned: bool| {
        let positions = mesh.positions().iter();
        let mut obj: String = positions
            .map(|p| {
                if turned {
                    format!("v {} {} {}\n", p.x, -p.z, p.y)
                } else {
                    format!("v {} {} {}\n", p.x, p.y, p.z)
                }
            })
            .collect();
        for polygon in mesh.polygons() {
            let corners: Vec<String> = polygon.iter().map(|c| (c + 1).to_string()).collect();
            obj += &format!("f {}\n", corners.join(" "));
        }
        obj
    };
    folder
        .write("y.obj", written(false))
        .write("z.obj", written(true));
    let draw = |arguments: &str| {
        let arguments =
            format!("render {arguments} --size 80x60 --simd scalar --method naive-phong");
        folder.run(&arguments).done();
    };
    draw("y.obj -o y.png");
    draw("z.obj -o z.png --up z");
    draw("z.obj -o numbers.png --up 0,0,1");
    let differ = |a: &str, b: &str| folder.run(&format!("diff {a} {b} --fail-above 2"));
    differ("y.png", "z.png").done();
    differ("y.png", "numbers.png").differs();
    draw("y.obj -o y.png --view 30,20");
    draw("z.obj -o z.png --view 30,20 --up z");
    differ("y.png", "z.png").done();
    // `compare` uses the plain light, which turns as well. The printed scene draws the same
    // picture.
    let printed = folder.run("render z.obj --up z --print-scene").done().out;
    assert!(printed.contains("up = \"z\""), "{printed}");
    folder.write("printed.toml", &printed);
    draw("printed.toml -o printed.png");
    draw("z.obj -o z.png --up z");
    differ("printed.png", "z.png").done();
    let errors = |arguments: &str| {
        let arguments =
            format!("compare {arguments} --methods gouraud --time-budget 0 --size 80x60 --json");
        let json = folder.run(&arguments).done().out;
        let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
        json["comparisons"][0]["rows"][1]["error"]["rms"]
            .as_f64()
            .expect("a number")
    };
    let [y, z] = ["y.obj", "z.obj --up z"].map(errors);
    assert!((y - z).abs() < 0.02 * y, "{y} {z}");
    let refused = folder.run("render y.obj -o a.png --up w");
    refused.refused(&[
        "--up",
        "expected an axis (x, y, z, -x, -y or -z) or three numbers x,y,z",
    ]);
    draw("y.obj -o a.png --up -z");
}

#[test]
fn info_begins_with_the_mesh_and_says_if_it_lies_on_its_side() {
    let folder = Folder::new();
    flat_highlight(&folder);
    let out = folder.run("info a.obj").done().out;
    assert!(out.starts_with("a.obj\n  polygons    5: "), "{out}");
    assert!(!out.contains("--up"), "{out}");
    let text = String::from_utf8(folder.read("a.obj")).expect("text");
    let lying = text
        .replace("v -1 0 -1", "v -1 -1 0")
        .replace("v 1 0 -1", "v 1 -1 0")
        .replace("v 1 0 1", "v 1 1 0")
        .replace("v -1 0 1", "v -1 1 0");
    folder.write("z.obj", lying.replace("v 0 1 0", "v 0 0 1"));
    let out = folder.run("info z.obj").done().out;
    assert!(out.contains("if z is up, --up z"), "{out}");
    let out = folder.run("info builtin:cube").done().out;
    assert!(out.starts_with("builtin:cube\n  polygons    6: "), "{out}");
    let out = folder.run("info football").done().out;
    assert!(out.starts_with("football: "), "{out}");
    assert!(out.find("  picture ") < out.find("  polygons "), "{out}");
}
