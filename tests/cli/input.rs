//! Missing, broken or oversized inputs: each is one error with its place, and nothing is written.

use super::Folder;
use crate::picture;

fn refused(files: &[(&str, &[u8])], input: &str, parts: &[&str]) {
    let folder = Folder::new();
    for (name, bytes) in files {
        folder.write(name, bytes);
    }
    let before = folder.names();
    for command in [
        format!("render {input} -o out.png"),
        format!("info {input}"),
    ] {
        folder.run(&command).refused(parts);
    }
    assert_eq!(folder.names(), before);
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn missing_inputs_are_refused_with_suggestions() {
    refused(
        &[],
        "taepot",
        &["`taepot` is neither a file nor the name of a shipped scene; did you mean `teapot`?"],
    );
    refused(&[], "torus", &["did you mean `builtin:torus`?"]);
    refused(
        &[],
        "xyzzy",
        &[
            "expected a scene file .toml, a mesh file (.obj .stl .ply .off .gltf .glb), builtin:NAME, or one of coarse-sphere",
        ],
    );
    refused(
        &[],
        "missing.obj",
        &["`missing.obj` is neither a file nor the name of a shipped scene"],
    );
    refused(
        &[],
        "missing.toml",
        &["`missing.toml` is neither a file nor the name of a shipped scene"],
    );
    refused(
        &[("mesh.stl", b"solid")],
        "mesh.stl",
        &["mesh.stl: has no triangle: expected triangles, binary or as `facet` statements"],
    );
    refused(
        &[],
        "shipped:bunny.obj",
        &["no mesh `bunny.obj` is shipped: expected one of vase.obj, football.obj"],
    );
}

#[test]
fn unknown_built_in_meshes_are_refused() {
    refused(
        &[],
        "builtin:spere",
        &["no built-in mesh is named `spere`; did you mean `sphere`?"],
    );
    refused(
        &[],
        "builtin:sphere?ring=5",
        &["`sphere` has no parameter `ring`; did you mean `rings`?"],
    );
    refused(
        &[],
        "builtin:sphere?rings=many",
        &["`rings` is a whole number, not `many`"],
    );
    refused(
        &[],
        "builtin:sphere?rings",
        &["`rings` should be written as key=value"],
    );
    let large = "builtin:sphere?segments=1000000&rings=1000";
    refused(
        &[],
        large,
        &["the mesh would have 1000000000 polygons, over the limit of 16777216"],
    );
}

#[test]
fn broken_mesh_files_are_refused_with_their_line() {
    let with = |line: &str| format!("{TRIANGLE}{line}\n");
    for (text, parts) in [
        (Vec::new(), &["mesh.obj: is empty"][..]),
        (
            b"\x7fELF\0\0\x01\x02\xff".to_vec(),
            &["mesh.obj:1: holds binary data"],
        ),
        (with("f 1 2").into_bytes(), &["mesh.obj: ", "no polygon"]),
        (with("f 1 2 9").into_bytes(), &["mesh.obj:4: ", "9"]),
        (with("f 1 2 -9").into_bytes(), &["mesh.obj:4: ", "-9"]),
        (with("f 1 2 0").into_bytes(), &["mesh.obj:4: "]),
        (
            with("f 1 2 x").into_bytes(),
            &["mesh.obj:4: `x` is not a corner"],
        ),
        (
            with("v NaN 0 0\nf 1 2 4").into_bytes(),
            &["mesh.obj:4: `NaN` in `v`: expected a finite number"],
        ),
        (
            with("v 1e99 0 0\nf 1 2 4").into_bytes(),
            &["mesh.obj:4: ", "expected a finite number"],
        ),
        (
            with("f 1 2 4\nv 1,5 0 0").into_bytes(),
            &[
                "mesh.obj:5: `1,5` in `v`: expected a finite number with a decimal point, and the face in line 4 uses",
            ],
        ),
        // The file is cut off in the middle of a line.
        (
            with("f 1 2 4\nv 1 2").into_bytes(),
            &["mesh.obj:5: `v` has too few numbers: expected three, found 2"],
        ),
        // A server's error page, saved under the name of the mesh.
        (
            b"404: Not Found\n".to_vec(),
            &[
                "mesh.obj: has no polygon",
                "note: `404:` is not an OBJ statement and is ignored (line 1)",
            ],
        ),
        (
            b"<!DOCTYPE html>\n<p>Not Found".to_vec(),
            &["mesh.obj: is a page of HTML: expected a mesh file"],
        ),
    ] {
        refused(&[("mesh.obj", &text)], "mesh.obj", parts);
    }
    let folder = Folder::new();
    std::fs::create_dir(folder.path("mesh.obj")).unwrap();
    folder
        .run("render mesh.obj -o out.png")
        .refused(&["mesh.obj: is a directory"]);
}

#[test]
fn broken_scene_files_are_refused_with_their_place() {
    for (text, parts) in [
        (
            "[[object]]\nmehs = \"builtin:cube\"\n",
            &[
                "scene.toml:2:1",
                "unknown key `mehs`",
                "did you mean `mesh`?",
            ][..],
        ),
        (
            "ambient = \"dark\"\n",
            &["scene.toml:1:11", "expected one number or three"],
        ),
        ("ambient = \n", &["scene.toml:1:", "not valid TOML"]),
        ("", &["the scene has no objects"]),
        (
            "[camera]\nfovy = 200\n[[object]]\nmesh = \"builtin:cube\"\n",
            &["scene.toml:2:8", "`camera.fovy` is 200"],
        ),
        (
            "[[object]]\nmesh = \"builtin:cub\"\n",
            &["scene.toml:2:8", "did you mean `cube`?"],
        ),
        (
            "[[object]]\nmesh = \"missing.obj\"\n",
            &["scene.toml:2:8", "missing.obj: cannot be read"],
        ),
        (
            "[[object]]\nmesh = \"sphere\"\n",
            &["scene.toml:2:8", "did you mean `builtin:sphere`?"],
        ),
        (
            "[image]\nwidth = 0\n[[object]]\nmesh = \"builtin:cube\"\n",
            &["scene.toml:2:9", "`image.width` is 0"],
        ),
        (
            "[[light]]\ndirection = [nan, 0, 0]\n[[object]]\nmesh = \"builtin:cube\"\n",
            &["scene.toml:2:13", "finite"],
        ),
    ] {
        refused(&[("scene.toml", text.as_bytes())], "scene.toml", parts);
    }
    refused(
        &[("scene.toml", b"\xff\xfe\0")],
        "scene.toml",
        &[
            "cannot read the scene `scene.toml`: it is UTF-16 text (not UTF-8): expected TOML in UTF-8",
        ],
    );
    refused(
        &[("scene.toml", b"[image]\n\xff\n")],
        "scene.toml",
        &["cannot read the scene `scene.toml`: line 2 is not text"],
    );
}

#[test]
fn odd_meshes_give_warnings() {
    let folder = Folder::new();
    folder.write(
        "mesh.obj",
        format!("mtllib gone.mtl\n{TRIANGLE}usemtl red\nf 1 2 3\n"),
    );
    let ended = folder.run("render mesh.obj --size 64x48 -o out.png").done();
    ended.says("warning: mesh.obj: material library `gone.mtl` (line 1) cannot be read");
}

#[test]
fn a_bad_position_or_normal_that_no_face_uses_is_only_a_warning() {
    let folder = Folder::new();
    folder.write(
        "mesh.obj",
        format!("{TRIANGLE}v 1.#IND 0 0\nvn nan nan nan\nvt nan\nf 1//1 2 3\nv 1 2"),
    );
    let ended = folder
        .run("render mesh.obj --size 64x48 -o out.png")
        .done()
        .says("a position is not three finite numbers and is left out (2 times, first in line 4)");
    ended.says("a normal is not three finite numbers: corners that name it count as without a normal (line 5)");
}

#[test]
fn notes_about_a_mesh_are_printed_before_its_error() {
    let folder = Folder::new();
    folder
        .write("mesh.obj", format!("{TRIANGLE}call other.obj\nf 1 2 9\n"))
        .write("scene.toml", "[[object]]\nmesh = \"mesh.obj\"\n");
    let ended = folder.run("render scene.toml -o out.png");
    ended.refused(&[
        "scene.toml:2:8",
        "mesh.obj:5: position index 9 is out of range",
        "note: `call` and `csh` are not followed",
    ]);
}

/// Runs the tool with the file `name` as standard input.
fn piped(folder: &Folder, name: &str, arguments: &str) -> super::Ended {
    let mut command = folder.command(arguments);
    command.stdin(std::fs::File::open(folder.path(name)).unwrap());
    super::Ended::new(arguments, command.output().unwrap())
}

#[test]
fn a_mesh_or_a_scene_is_read_from_standard_input() {
    let folder = Folder::new();
    let mesh = format!("mtllib red.mtl\nusemtl red\n{TRIANGLE}f 1 2 3\n");
    folder
        .write("mesh", &mesh)
        .write("named.obj", &mesh)
        .write("red.mtl", "newmtl red\nKd 1 0 0\n")
        .write("scene", "[[object]]\nmesh = \"named.obj\"\n")
        .write("of-mesh", "[[object]]\nmesh = \"-\"\n");
    let flags = "--size 16x12 --simd scalar -m flat";
    for format in ["", " --input-format obj"] {
        let ended = piped(
            &folder,
            "mesh",
            &format!("render - {flags} -o {{scene}}.png{format}"),
        );
        let told = ended.done().err;
        assert!(told.starts_with("standard input: 3 edges are open"));
        assert!(told.ends_with("\nstdin.png: 16x12, flat\n"), "{told}");
        folder
            .run(&format!("render named.obj {flags} -o named.png"))
            .done();
        assert_eq!(
            folder.read("stdin.png"),
            folder.read("named.png"),
            "{format}"
        );
    }
    for format in ["", " --input-format toml"] {
        piped(
            &folder,
            "scene",
            &format!("render - {flags} -o scene.png{format}"),
        )
        .done();
        folder.write("scene.toml", folder.read("scene"));
        folder
            .run(&format!("render scene.toml {flags} -o file.png"))
            .done();
        assert_eq!(
            folder.read("scene.png"),
            folder.read("file.png"),
            "{format}"
        );
    }
    piped(&folder, "mesh", "info -")
        .done()
        .prints("1 of 3 sides");
    folder.write("of-mesh.toml", folder.read("of-mesh"));
    piped(&folder, "mesh", "info of-mesh.toml")
        .done()
        .prints("1 of 3 sides");
}

#[test]
fn bad_standard_input_is_reported_with_its_line() {
    let folder = Folder::new();
    folder
        .write("empty", "")
        .write("mesh", format!("{TRIANGLE}f 1 2 9\n"))
        .write("scene", "[image]\nwidth = 0\n")
        .write("binary", b"[\xff\xfe");
    for (name, flags, parts) in [
        (
            "empty",
            "",
            &["standard input: is empty: expected OBJ text"][..],
        ),
        ("mesh", "", &["standard input:4: position index 9"]),
        (
            "mesh",
            " --input-format toml",
            &["standard input:1:", "not valid TOML"],
        ),
        ("scene", "", &["standard input:2:9", "`image.width` is 0"]),
        (
            "scene",
            " --input-format obj",
            &["standard input: has no polygon"],
        ),
        ("binary", "", &["`standard input`: line 1 is not text"]),
    ] {
        piped(&folder, name, &format!("render - -o a.png{flags}")).refused(parts);
    }
    let refused = folder.run("render teapot --input-format obj -o a.png");
    refused.refused(&["`--input-format` is for standard input, not for `teapot`"]);
    // An input file is not overwritten, even if it comes by standard input.
    let ended = piped(&folder, "mesh", "render - -o mesh --format png");
    ended.refused(&[]);
    assert_eq!(
        folder.read("mesh"),
        format!("{TRIANGLE}f 1 2 9\n").into_bytes()
    );
    folder.write("good", format!("{TRIANGLE}f 1 2 3\n"));
    let ended = piped(&folder, "good", "render - --size 8x6 -o good --format png");
    ended.refused(&["`--output` is the input itself"]);
}

#[test]
fn vertex_colours_are_lit_or_reported() {
    let folder = Folder::new();
    let points = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\n";
    folder.write("mesh.obj", format!("{points}f 1 2 3\n"));
    let told = "mesh.obj: has vertex colours, which are not used: --colours on uses them";
    folder
        .run("render mesh.obj --size 64x48 --colours off -o off.png")
        .done()
        .says(told);
    piped(
        &folder,
        "mesh.obj",
        "render - --size 8x6 --colours off -o piped.png",
    )
    .done()
    .says("standard input: has vertex colours");
    for flags in ["-o on.png", "--aov colours -o a.png"] {
        let shown = folder
            .run(&format!("render mesh.obj --size 64x48 {flags}"))
            .done();
        assert!(!shown.err.contains("vertex colours"), "{}", shown.err);
    }
    let is_red = |name: &str| {
        let picture = picture(&folder.path(name));
        let mut pixels = picture.pixels().iter();
        pixels.any(|p| u32::from(p[0]) > 4 * u32::from(p[2]))
    };
    assert!(is_red("on.png") && !is_red("off.png"));
    let points = "v 0 0 0 9 9 9\nv 1 0 0 9 9 9\nv 0 1 0 9 9 9\n";
    folder.write("bright.obj", format!("{points}f 1 2 3\n"));
    folder
        .run("render bright.obj --size 64x48 -o bright.png")
        .done()
        .says("multiplied by vertex colours of up to 9");
    folder
        .run("info mesh.obj")
        .done()
        .prints("colours     one for each position; --colours off");
    folder
        .run("render mesh.obj --size 8x6 --method integer-naive -o b.png")
        .refused(&["--colours off"]);
    assert_eq!(
        folder.run("info mesh.obj --json").json()["objects"][0]["colours"],
        true
    );
    folder.write("mesh.obj", format!("{TRIANGLE}f 1 2 3\n"));
    let without = folder.run("info mesh.obj").done();
    assert!(!without.out.contains("colours"), "{}", without.out);
}

#[test]
fn messages_are_coloured_only_in_terminals() {
    let folder = Folder::new();
    folder
        .write("scene.toml", "ambient = \"dark\"\n")
        .write("area.obj", format!("{TRIANGLE}f 1 2 3\nf 1 1 1\n"));
    for arguments in [
        "render scene.toml -o a.png",
        "render taepot -o a.png",
        "render area.obj --size 8x6 -o a.png",
    ] {
        let ended = folder.run(arguments);
        assert!(
            !ended.err.contains('\x1b') && !ended.err.is_empty(),
            "{}",
            ended.err
        );
    }
}

/// The printed scene of a mesh on standard input refers to standard input, and draws the mesh from
/// there.
#[test]
fn a_printed_scene_reads_standard_input_again() {
    let folder = Folder::new();
    folder.write("mesh.obj", format!("{TRIANGLE}f 1 2 3\n"));
    let printed = piped(&folder, "mesh.obj", "render - --print-scene")
        .done()
        .says("`mesh = \"-\"` reads the mesh from standard input again: replace `-` by the name of a file");
    folder.write("printed.toml", &printed.out);
    let draw = |scene: &str, name: &str| {
        let command = format!("render {scene} --size 16x12 -o {name}");
        piped(&folder, "mesh.obj", &command).done();
        folder.read(name)
    };
    assert_eq!(draw("printed.toml", "printed.png"), draw("-", "mesh.png"));
    let named = folder.run("render mesh.obj --print-scene").done();
    assert!(!named.err.contains("standard input"));
}

/// If a library's name differs only in case, and only one file fits, the tool reads that file and
/// says so.
#[cfg(target_os = "linux")]
#[test]
fn a_material_library_is_found_in_another_case() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("Parts")).unwrap();
    folder.write("Parts/Cube.MTL", "newmtl red\nKd 1 0 0\n");
    let draw = || folder.run("render mesh.obj --size 16x12 -o red.png").done();
    let named = |library: &str| format!("mtllib {library}\nusemtl red\n{TRIANGLE}f 1 2 3\n");
    folder.write("mesh.obj", named("Parts/cube.mtl"));
    let told = draw()
        .says("material library `Parts/cube.mtl` is not there: Parts/Cube.MTL is read instead");
    assert!(!told.err.contains("no material library defines"));
    // An exact name needs no note.
    folder.write("mesh.obj", named("Parts/Cube.MTL"));
    assert!(!draw().err.contains("library"));
    // If two files fit, the tool reads neither.
    folder.write("Parts/CUBE.mtl", "newmtl red\nKd 0 1 0\n");
    folder.write("mesh.obj", named("Parts/cube.mtl"));
    draw().says("material library `Parts/cube.mtl` (line 1) cannot be read");
}
