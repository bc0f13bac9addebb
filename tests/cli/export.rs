//! `fastphong export`: the files draw the expected picture again, agree with one another, and
//! replace no others.

use super::exported::Exported;
use super::{Folder, picture};
use fastphong::scene::input::SCENES;
use serde_json::Value;
use std::process::Command;

/// The files, in the order in which they are printed.
const NAMES: [&str; 8] = [
    "README.txt",
    "mesh.obj",
    "mesh.mtl",
    "scene.json",
    "scene.h",
    "scene.py",
    "points.csv",
    "expected.png",
];

#[test]
fn the_files_draw_each_shipped_scene_again() {
    for scene in SCENES {
        let is_large = ["million", "knot-100k"].contains(&scene.name);
        if !is_large {
            let arguments = format!("{} --size 160x120", scene.name);
            Exported::new(Folder::new(), &arguments).check(scene.name);
        }
    }
}

/// Two triangles and a quadrangle with normals. The second triangle is wound against them.
const AGAINST: &str = "\
v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0.5\nv 3 0 1\nv 3 2 1\n\
vn 0 0 1\nvn 0.6 0 0.8\nvn -0.6 0 0.8\n\
f 1//1 2//2 3//3\nf 2//1 3//1 4//2\nf 2//2 5//1 6//1 4//1\n";

#[test]
fn the_files_draw_odd_scenes_again() {
    let lights = "--light-at 2,3,2,4 --attenuation 0.3 --light=-1,2,3,0.2,0.3,0.4";
    let odd = [
        "builtin:teapot?res=3 --fovy 40".to_owned(),
        "football --encoding srgb --background 0.2,0.3,0.4".to_owned(),
        "terrain --light-at 1,1,1 --attenuation 1 --viewer local".to_owned(),
        "terrain --light-at 0,2,1,9 --falloff inverse-square --fovy 50".to_owned(),
        "terrain --light-at 0,2,1,3 --falloff inverse --specular-gate weighted".to_owned(),
        format!("mirrored {lights} --fovy 30 --interpolation perspective"),
        format!(
            "builtin:torus?segments=24&sides=12 {lights} --specular blinn --shininess-for phong"
        ),
        "builtin:terrain?colours=true&segments=16&rows=16 --ambient 2,3,4".to_owned(),
        "corrugated --cull none --two-sided --view 20,-30".to_owned(),
        "corrugated --cull front --two-sided --view 200,30".to_owned(),
        "perspective --viewer local --interpolation screen".to_owned(),
        // The floor reaches behind the eye.
        "terrain --eye 0,0.4,0.3 --target 0,0,-1 --fovy 80 --interpolation perspective".to_owned(),
        "vase --near 5 --cull none".to_owned(),
        "builtin:gear --normals-weight angle --light 0,0,1 --specular-gate ungated".to_owned(),
        "builtin:letters --view 20,10".to_owned(),
        "builtin:polygon?sides=300 --view 20,10".to_owned(),
        "cyclic-triangles --visibility draw-order".to_owned(),
        "vase --no-lights --ambient 5".to_owned(),
        "against.obj --view 30,20".to_owned(),
        "against.obj --view 150,20".to_owned(),
        "against.obj --cull front --two-sided --view 30,20".to_owned(),
        "three.toml".to_owned(),
    ];
    let objects = "
        ambient = 0.5
        [camera]
        eye = [3.0, 4.0, 5.0]
        fovy = 40
        [[light]]
        direction = [3.0, 1.0, 2.0]
        colour = [1.0, 0.5, 0.5]
        [[object]]
        mesh = \"builtin:cube\"
        crease = 30
        scale = [-1.0, 0.5, 1.0]
        rotate = { axis = [1.0, 1.0, 0.0], angle = 25 }
        [[object]]
        mesh = \"builtin:sphere?segments=16&rings=8\"
        translate = [1.0, 0.5, 0.2]
        material = { kd = [0.1, 0.2, 0.9], shininess = 64 }
        [[object]]
        mesh = \"against.obj\"
        translate = [-1.0, 0.0, 1.0]
    ";
    for arguments in odd {
        let folder = Folder::new();
        folder.write("against.obj", AGAINST);
        folder.write("three.toml", objects);
        let arguments = format!("{arguments} --size 120x90");
        Exported::new(folder, &arguments).check(&arguments);
    }
}

/// Returns the picture of the reference over the background.
fn reference(folder: &Folder, scene: &str) -> Vec<[u8; 3]> {
    let command = format!("render {scene} -m reference --alpha opaque -o reference.png");
    folder.run(&command).done();
    let rendered = picture(&folder.path("reference.png"));
    let pixels = rendered.pixels().iter();
    pixels.map(|&[r, g, b, _]| [r, g, b]).collect()
}

#[test]
fn the_picture_shows_the_faces_that_are_written() {
    let knot = "image = { width = 80, height = 60 }\ncamera = { fovy = 30 }\n\
        [[object]]\nmesh = 'builtin:knot?triangles=true&segments=60&sides=8'\n";
    for scene in ["polygons --polygons", "football --polygons", "knot.toml"] {
        let folder = Folder::new();
        folder.write("knot.toml", knot);
        let exported = Exported::new(folder, &format!("{scene} --size 80x60"));
        let scene = scene.trim_end_matches(" --polygons");
        let rendered = reference(&exported.folder, &format!("{scene} --size 80x60"));
        assert!(exported.expected() == rendered, "{scene}");
    }
}

/// Positions and normals are read as the same `f32`, so only rounding of the matrices is left,
/// which moves no corner of these scenes to another 1/256 pixel.
#[test]
fn the_mesh_is_read_as_it_was_written() {
    for scene in [
        "vase --light 1,2,3",
        "builtin:terrain?colours=true&segments=9&rows=9 --light 1,2,3",
    ] {
        let exported = Exported::new(Folder::new(), &format!("{scene} --size 80x60"));
        let numbers = &exported.numbers.0;
        let [eye, target] = ["eye", "target"].map(|key| &numbers[key]);
        let [half, near, far] = ["half_height", "near", "far"].map(|key| &numbers[key]);
        let colours = if exported.numbers.flag("vertex_colours") {
            "on"
        } else {
            "off"
        };
        let text = format!(
            "image = {{ width = 80, height = 60 }}\ncolours = '{colours}'\n\
             [camera]\neye = {eye}\ntarget = {target}\nhalf_height = {half}\nnear = {near}\nfar = {far}\n\
             [[light]]\ndirection = [1, 2, 3]\n[[object]]\nmesh = 'out/mesh.obj'\nnormals = 'given'\n"
        );
        exported.folder.write("again.toml", text);
        exported
            .folder
            .run("render again.toml -o a.png")
            .done()
            .says("80x60");
        assert!(
            reference(&exported.folder, "again.toml") == exported.expected(),
            "{scene}"
        );
    }
}

#[test]
fn a_polygon_that_crosses_itself_is_left_out_and_told() {
    let folder = Folder::new();
    // The quadrangle that crosses itself, beside a triangle.
    folder.write(
        "bow.obj",
        "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 1 -1 0\nv 5 0 0\nf 1 2 3 4\nf 2 5 3\n",
    );
    folder
        .run("export bow.obj --size 40x30 -o out")
        .done()
        .says("1 polygon crosses or overlaps itself and is left out: --polygons writes polygons");
    let faces = |folder: &Folder| {
        let obj = String::from_utf8(folder.read("out/mesh.obj")).expect("text");
        obj.lines().filter(|line| line.starts_with("f ")).count()
    };
    assert_eq!(faces(&folder), 1);
    let whole = folder
        .run("export bow.obj --size 40x30 -o out --polygons")
        .done();
    assert!(!whole.err.contains("left out"), "{}", whole.err);
    assert_eq!(faces(&folder), 2);
}

/// Runs a program on the files in `folder`. Returns `None` if this machine does not have it.
fn outcome(folder: &Folder, program: &str, arguments: &[&str]) -> Option<String> {
    let mut command = Command::new(program);
    let found = command.args(arguments).current_dir(folder.path("out"));
    let Ok(found) = found.env("PYTHONDONTWRITEBYTECODE", "1").output() else {
        eprintln!("{program} is not here: not tested");
        return None;
    };
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    let (out, err) = (text(found.stdout), text(found.stderr));
    assert!(found.status.success(), "{program}: {err}{out}");
    assert_eq!(err, "", "{program}");
    Some(out)
}

/// The keys of `scene.json` that are no values of the scene.
const ABOUT: [&str; 3] = ["about", "schema", "meaning"];

/// Scenes with and without lights, of both kinds, with one and several materials.
const OF_ALL_KINDS: [&str; 4] = [
    "local-lights",
    "vase --light 1,2,3 --light-at 1,2,3 --viewer local",
    "football --no-lights --far 1e20",
    "builtin:star?points=7 --fovy 20 --specular blinn",
];

#[test]
fn the_module_for_python_has_the_numbers_of_the_json_file() {
    let check = "import json, scene\n\
        for key, value in json.load(open('scene.json')).items():\n    \
        assert key in ('about', 'schema', 'meaning') or getattr(scene, key) == value, key\n";
    for scene in OF_ALL_KINDS {
        let exported = Exported::new(Folder::new(), &format!("{scene} --size 40x30"));
        outcome(&exported.folder, "python3", &["-c", check]);
    }
}

/// Adds the lines of C that print a value, and the lines that they print.
fn printed(name: &str, value: &Value, c: &mut String, lines: &mut Vec<String>) {
    let number = |value: &Value| match value {
        Value::Null => "0".to_owned(),
        Value::Bool(flag) => u8::from(*flag).to_string(),
        value => format!("{:?}", value.as_f64().expect("a number")),
    };
    match value {
        Value::String(text) => {
            *c += &format!("    puts({name});\n");
            lines.push(text.clone());
        }
        Value::Array(list) => {
            for (i, value) in list.iter().enumerate() {
                printed(&format!("{name}[{i}]"), value, c, lines);
            }
        }
        value => {
            *c += &format!("    printf(\"%.17g\\n\", (double){name});\n");
            lines.push(number(value));
        }
    }
}

#[test]
fn the_header_for_c_has_the_numbers_of_the_json_file() {
    for scene in OF_ALL_KINDS {
        let exported = Exported::new(Folder::new(), &format!("{scene} --size 40x30"));
        let (mut c, mut lines) = (String::new(), Vec::new());
        for (key, value) in exported.numbers.0.as_object().expect("an object") {
            let upper = key.to_uppercase();
            match value {
                _ if ABOUT.contains(&&**key) => {}
                Value::Array(rows) if ["lights", "materials"].contains(&&**key) => {
                    let count = Value::from(rows.len());
                    printed(&format!("SCENE_{upper}"), &count, &mut c, &mut lines);
                    for (i, row) in rows.iter().enumerate() {
                        for (column, value) in row.as_object().expect("a row") {
                            let one = key.trim_end_matches('s');
                            let name = format!("scene_{one}_{column}[{i}]");
                            let zeros = Value::from([0.0; 3]);
                            // C has a vector where JSON has none.
                            let value = if value.is_null() { &zeros } else { value };
                            printed(&name, value, &mut c, &mut lines);
                        }
                    }
                }
                Value::Array(_) => printed(&format!("scene_{key}"), value, &mut c, &mut lines),
                Value::Null if key == "to_eye" => {}
                value => printed(&format!("SCENE_{upper}"), value, &mut c, &mut lines),
            }
        }
        let program = format!(
            "#include <stdio.h>\n#include \"scene.h\"\n\nint main(void) {{\n{c}    return scene_light_colour[0][0] < 0.0;\n}}\n"
        );
        let folder = &exported.folder;
        folder.write("out/numbers.c", program);
        let strict = ["-Wall", "-Wextra", "-pedantic", "-Werror"];
        let c89 = [&["-std=c89", "numbers.c", "-o", "numbers"], &strict[..]].concat();
        if outcome(folder, "cc", &c89).is_some() {
            let numbers = folder.path("out/numbers");
            let found =
                outcome(folder, numbers.to_str().expect("a path"), &[]).expect("it was made");
            assert!(found.lines().count() > 50);
            for (found, expected) in found.lines().zip(&lines) {
                let number = |text: &str| text.parse::<f64>();
                let is_same = match (number(found), number(expected)) {
                    (Ok(found), Ok(expected)) => found == expected,
                    _ => found == expected,
                };
                assert!(is_same, "{scene}: {found}, not {expected}");
            }
            assert_eq!(found.lines().count(), lines.len());
        }
        let cpp = [&["-x", "c++", "-fsyntax-only", "numbers.c"], &strict[..]].concat();
        outcome(folder, "c++", &cpp);
    }
}

#[test]
fn files_of_others_are_not_replaced() {
    let folder = Folder::new();
    let command = "export builtin:cube --size 40x30 -o out";
    let told = folder.run(command).done().out;
    assert_eq!(told, NAMES.map(|name| format!("out/{name}\n")).concat());
    // Its own files are replaced, also those of another scene.
    folder
        .run("export builtin:torus --size 40x30 -o out")
        .done();
    folder.run(command).done();
    let before: Vec<_> = NAMES
        .iter()
        .map(|name| folder.read(&format!("out/{name}")))
        .collect();
    for name in NAMES {
        let path = format!("out/{name}");
        let own = folder.read(&path);
        folder.write(&path, "precious");
        folder.run("export vase --size 40x30 -o out").refused(&[
            &format!("`--output` writes {path}, which fastphong did not make"),
            "--force",
        ]);
        assert_eq!(folder.read(&path), b"precious");
        folder.run(&format!("{command} --force")).done();
        assert!(folder.read(&path) == own, "{name}");
    }
    let after: Vec<_> = NAMES
        .iter()
        .map(|name| folder.read(&format!("out/{name}")))
        .collect();
    assert!(before == after);
    // Nothing is left beside the files.
    let left = std::fs::read_dir(folder.path("out"))
        .expect("the folder")
        .count();
    assert_eq!(left, NAMES.len());
}

#[test]
fn all_files_are_written_or_none() {
    let folder = Folder::new();
    folder.run("export builtin:cube --size 40x30 -o out").done();
    let old = folder.read("out/mesh.obj");
    // A folder stands where the last file belongs.
    std::fs::remove_file(folder.path("out/expected.png")).expect("a file");
    std::fs::create_dir(folder.path("out/expected.png")).expect("a folder");
    folder
        .run("export vase --size 40x30 -o out")
        .refused(&["out/expected.png: cannot be written"]);
    assert!(folder.read("out/mesh.obj") == old);
    let left = std::fs::read_dir(folder.path("out"))
        .expect("the folder")
        .count();
    assert_eq!(left, NAMES.len());
}

#[test]
fn odd_destinations_and_scenes_are_one_error() {
    let folder = Folder::new();
    folder
        .write("file", "")
        .write("empty.toml", "[camera]\neye = [0, 0, 5]\n")
        .write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")
        .write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (arguments, said) in [
        (
            "vase -o -",
            "--output: `-` is standard output, not a folder: expected a folder",
        ),
        (
            "vase -o file",
            "--output: file is a file: expected a folder",
        ),
        (
            "vase -o file/below",
            "file/below/README.txt: cannot be written",
        ),
        ("empty.toml -o out", "the scene has no objects"),
        ("nan.obj -o out", "expected a finite number"),
        (
            "mesh.obj -o .",
            "`--output` is the mesh itself, mesh.obj, by the name ./mesh.obj",
        ),
        ("vase --size 16385x1 -o out", "expected 1 to 16384"),
        (
            "builtin:star?points=9000 -o out",
            "has 18000 corners: expected at most 16384",
        ),
        (
            "nothing -o out",
            "neither a file nor the name of a shipped scene",
        ),
    ] {
        folder.run(&format!("export {arguments}")).refused(&[said]);
        assert!(!folder.path("out").exists(), "{arguments}");
    }
    folder
        .run("export builtin:polygon?sides=16384 --size 40x30 -o many")
        .done();
    folder.run("export vase --size 1x1 -o small").done();
    folder
        .run("export vase --size 40x30 --samples 2 --alpha opaque -o out")
        .done()
        .says("a single sample per pixel")
        .says("no effect on the picture, which has no alpha: --alpha");
}

#[test]
fn the_texts_name_the_scene_and_its_flags() {
    let folder = Folder::new();
    folder
        .run("export --force vase -o out --view 20,10 -q --size 40x30")
        .done();
    let readme = String::from_utf8(folder.read("out/README.txt")).expect("text");
    let command = "fastphong diagnose mine.png vase --view 20,10 --size 40x30";
    assert!(readme.contains(command), "{readme}");
    for name in NAMES {
        assert!(readme.contains(name) || name == "README.txt", "{name}");
    }
    folder
        .run("diagnose out/expected.png vase --view 20,10 --size 40x30")
        .done();
}
