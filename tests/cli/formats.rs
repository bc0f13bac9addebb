//! The tool recognises files by their bytes, whatever they are called: scenes, meshes, packed
//! files, and files of other formats.

use super::*;
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::Write;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn packed(bytes: impl AsRef<[u8]>) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes.as_ref()).expect("memory");
    encoder.finish().expect("memory")
}

/// Draws `input`. If `stdin` names a file, the file is standard input.
fn draw(folder: &Folder, input: &str, stdin: Option<&str>) -> Vec<u8> {
    let arguments = format!("render {input} --size 16x12 -o out.png");
    let mut command = folder.command(&arguments);
    if let Some(name) = stdin {
        command.stdin(std::fs::File::open(folder.path(name)).expect("a file"));
    }
    Ended::new(&arguments, command.output().expect("the tool runs")).done();
    folder.read("out.png")
}

#[test]
fn a_mesh_or_a_scene_is_read_under_any_name() {
    let folder = Folder::new();
    let scene = "[[object]]\nmesh = \"mesh.obj\"\n";
    for (name, bytes) in [
        ("mesh.obj", TRIANGLE.into()),
        ("c.obj.txt", TRIANGLE.into()),
        ("mesh", TRIANGLE.into()),
        ("mesh.obj.gz", packed(TRIANGLE)),
        ("misnamed.obj", packed(TRIANGLE)),
        ("scene.toml", scene.into()),
        ("scene.txt", format!("\u{feff}{scene}\0").into()),
        ("scene.toml.gz", packed(scene)),
        ("packed.toml", packed(scene)),
        ("other.toml", b"[[object]]\nmesh = \"c.obj.txt\"\n".to_vec()),
        (
            "packed-mesh.toml",
            b"[[object]]\nmesh = \"mesh.obj.gz\"\n".to_vec(),
        ),
    ] {
        folder.write(name, bytes);
    }
    let mesh = draw(&folder, "mesh.obj", None);
    for input in ["c.obj.txt", "mesh", "mesh.obj.gz", "misnamed.obj"] {
        assert_eq!(draw(&folder, input, None), mesh, "{input}");
        assert_eq!(draw(&folder, "-", Some(input)), mesh, "{input}");
    }
    let scene = draw(&folder, "scene.toml", None);
    for input in [
        "scene.txt",
        "scene.toml.gz",
        "packed.toml",
        "other.toml",
        "packed-mesh.toml",
    ] {
        assert_eq!(draw(&folder, input, None), scene, "{input}");
    }
    folder
        .run("render mesh.obj.gz --size 8x6 -o {scene}.png")
        .done();
    assert!(folder.path("mesh.png").exists());
    let refused = folder.run("render c.obj.txt --size 8x6 --format png -o c.obj.txt");
    refused.refused(&["`--output` is a file of the scene itself, c.obj.txt"]);
}

#[cfg(unix)]
#[test]
fn a_pipe_and_the_device_of_standard_input_are_read_once() {
    use std::process::Stdio;
    let folder = Folder::new();
    folder.write("mesh.obj", TRIANGLE);
    let mesh = draw(&folder, "mesh.obj", None);
    assert_eq!(draw(&folder, "/dev/stdin", Some("mesh.obj")), mesh);
    let scene = "[[object]]\nmesh = \"mesh.obj\"\n";
    folder.write("scene.toml", scene);
    let of_scene = draw(&folder, "scene.toml", None);
    assert_eq!(draw(&folder, "/dev/stdin", Some("scene.toml")), of_scene);
    for (text, expected) in [(TRIANGLE, mesh), (scene, of_scene)] {
        let arguments = "render /dev/stdin --size 16x12 -o out.png";
        let mut child = folder.command(arguments);
        let mut child = child
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the tool runs");
        let mut pipe = child.stdin.take().expect("a pipe");
        pipe.write_all(text.as_bytes()).expect("a reader");
        drop(pipe);
        let ended = child.wait_with_output().expect("an end");
        Ended::new(arguments, ended).done();
        assert_eq!(folder.read("out.png"), expected, "{text}");
    }
    folder
        .run("info /dev/null")
        .refused(&["/dev/null: is empty: expected OBJ text"]);
}

#[test]
fn packed_libraries_are_read_and_damaged_ones_reported() {
    let folder = Folder::new();
    let mesh = format!("mtllib lib.mtl\nusemtl red\n{TRIANGLE}");
    let library = packed("newmtl red\nKd 1 0 0\n");
    folder.write("mesh.obj", &mesh).write("lib.mtl", &library);
    let told = folder.run("info mesh.obj").done();
    assert!(!told.err.contains("library"), "{}", told.err);
    folder.write("lib.mtl", &library[..library.len() - 3]);
    folder
        .run("info mesh.obj")
        .done()
        .says("material library `lib.mtl` (line 1) cannot be read (packed by gzip, ");
    let whole = packed(&mesh);
    folder.write("cut.obj", &whole[..whole.len() - 9]);
    folder
        .run("info cut.obj")
        .refused(&["cut.obj: cannot be read (packed by gzip, "]);
    folder.write("twice.obj", packed(packed(&mesh)));
    folder
        .run("info twice.obj")
        .refused(&["twice.obj: is a gzip archive in a gzip archive"]);
}

/// Returns [`TRIANGLE`] in every other format, with the name of a file.
fn triangles() -> [(&'static str, Vec<u8>); 4] {
    let stl = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let gltf = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;
    [
        ("stl", stl.into()),
        ("ply", ply.into()),
        ("off", off.into()),
        ("gltf", gltf.into()),
    ]
}

#[test]
fn every_format_is_drawn_from_a_file_a_pipe_and_a_scene() {
    let folder = Folder::new();
    folder.write("mesh.obj", TRIANGLE);
    let picture = draw(&folder, "mesh.obj", None);
    for (ending, bytes) in triangles() {
        let name = format!("mesh.{ending}");
        let packed_name = format!("{name}.gz");
        folder.write(&name, &bytes);
        folder.write(&packed_name, packed(&bytes));
        folder.write("nameless", &bytes);
        folder.write("misnamed.obj", &bytes);
        for input in [&name, &packed_name, "nameless", "misnamed.obj"] {
            assert_eq!(draw(&folder, input, None), picture, "{input}");
        }
        assert_eq!(draw(&folder, "-", Some(&name)), picture, "{name}");
        let told = folder.run("info misnamed.obj").done();
        told.says("misnamed.obj: is a")
            .says("whatever its ending says");
        folder.write("scene.toml", format!("[[object]]\nmesh = \"{name}\"\n"));
        folder.run("info scene.toml").done();
    }
    folder
        .run("info mesh.gltf")
        .done()
        .prints("per polygon: glTF without normals is flat by its specification");
    folder.run("info mesh.stl").done().prints("--up z");
    folder
        .run("render mesh.stl --size 8x6 -o a.png")
        .done()
        .says("--up z");
    let silent = folder
        .run("render mesh.stl --up z --size 8x6 -o a.png")
        .done();
    assert!(!silent.err.contains("z is up"), "{}", silent.err);
}

/// Returns the triangle as a glTF file with `camera` 9 units in front of it and `lights` 2 units in
/// front.
fn seen_gltf(camera: &str, lights: &[&str]) -> String {
    let [.., (_, bytes)] = triangles();
    let text = String::from_utf8(bytes).expect("text");
    let (mut nodes, mut numbers) = (String::new(), String::from("0, 1"));
    for light in 0..lights.len() {
        nodes += &format!(
            r#", {{"translation": [0.3, 0.3, 2], "extensions": {{"KHR_lights_punctual": {{"light": {light}}}}}}}"#
        );
        numbers += &format!(", {}", light + 2);
    }
    let nodes =
        format!(r#""nodes": [{{"mesh": 0}}, {{"camera": 0, "translation": [0, 0, 9]}}{nodes}]"#);
    let lights = lights.join(", ");
    let more = format!(
        r#""extensions": {{"KHR_lights_punctual": {{"lights": [{lights}]}}}},
        "cameras": [{camera}], "accessors""#
    );
    text.replace(
        r#"[{"nodes": [0]}]"#,
        &format!(r#"[{{"nodes": [{numbers}]}}]"#),
    )
    .replace(r#""nodes": [{"mesh": 0}]"#, &nodes)
    .replace(r#""accessors""#, &more)
}

const CAMERA: &str = r#"{"type": "perspective", "perspective": {"yfov": 0.2, "znear": 0.1}}"#;

#[test]
fn a_gltf_file_is_seen_by_its_own_camera_and_lit_by_its_own_lights() {
    let folder = Folder::new();
    for (kind, of_light) in [
        ("point", "falloff = \"inverse-square\""),
        ("directional", "direction = [0.0, 0.0, 1.0]"),
    ] {
        let light = format!(r#"{{"type": "{kind}", "intensity": 20, "color": [1, 0, 0]}}"#);
        folder.write("seen.gltf", seen_gltf(CAMERA, &[&light]));
        let command = "render seen.gltf --size 9x9";
        let seen = folder.run(&format!("{command} -o a.png")).done();
        seen.says("seen by the file's own camera")
            .says("lit by its light");
        // Only the surroundings light green and blue. Under the studio's lights, which are nearly
        // white, all three channels would be bright.
        let [r, g, b, _] = picture(&folder.path("a.png")).get(5, 3);
        assert!(r > 180 && g < 110 && b < 110, "{kind}: {r} {g} {b}");
        let printed = folder.run(&format!("{command} --print-scene")).done();
        assert_eq!(printed.out.matches("[[light]]").count(), 1);
        let printed = printed.prints("eye = [0.0, 0.0, 9.0]").prints(of_light);
        folder.write("again.toml", printed.out.as_bytes());
        folder.run("render again.toml -o b.png").done();
        assert!(folder.read("a.png") == folder.read("b.png"), "{kind}");
    }
}

#[test]
fn flags_override_camera_and_lights_of_a_gltf_file_and_their_notes() {
    let folder = Folder::new();
    let light = r#"{"type": "point", "intensity": 20}"#;
    folder.write("seen.gltf", seen_gltf(CAMERA, &[light]));
    for (flags, camera, lit, lights) in [
        ("", true, true, 1),
        ("--view 27,15", false, true, 1),
        ("--eye 1,2,9", false, true, 1),
        ("--fit 0.5", false, true, 1),
        ("--light 0,0,1", true, false, 1),
        ("--light 0,1,1 --light-at 0,0,3", true, false, 2),
        ("--no-lights", true, false, 0),
        ("--fovy 20", true, true, 1),
    ] {
        let command = format!("render seen.gltf {flags} --size 8x6 --print-scene");
        let ended = folder.run(&command).done();
        let (out, err) = (&ended.out, &ended.err);
        let is_seen = err.contains("seen by the file's own camera");
        assert_eq!(
            (is_seen, err.contains("lit by its light")),
            (camera, lit),
            "{flags}: {err}"
        );
        assert_eq!(out.matches("[[light]]").count(), lights, "{flags}: {out}");
    }
}

#[test]
fn unsupported_parts_of_a_gltf_file_are_reported_once() {
    let folder = Folder::new();
    let flat = r#"{"type": "perspective", "perspective": {"yfov": 0, "znear": 0.1}}"#;
    let lights = [
        r#"{"type": "point", "intensity": -1}"#,
        r#"{"type": "point", "color": [2, -1, 0]}"#,
        r#"{"type": "directional", "intensity": 0}"#,
    ];
    folder.write("seen.gltf", seen_gltf(flat, &lights));
    let ended = folder
        .run("render seen.gltf --size 8x6 --print-scene")
        .done()
        .says("camera 0 is left out: its `yfov` is 0")
        .says("light 0 is left out: its intensity is -1, its colour 1,1,1: expected")
        .says("light 1 is left out: its intensity is 1, its colour 2,-1,0: expected")
        .says("light 2 is left out: its intensity is 0, its colour 1,1,1, so it");
    assert_eq!(ended.err.matches("left out").count(), 4, "{}", ended.err);
    assert!(!ended.err.contains("lit by"), "{}", ended.err);
    assert!(!ended.err.contains("seen by"), "{}", ended.err);
    // No light of the file is usable, so the studio's two are used.
    assert_eq!(ended.out.matches("[[light]]").count(), 2);
}

#[test]
fn files_of_other_formats_are_called_by_their_format() {
    let mut coff = vec![0x64, 0x86, 1, 0];
    coff.extend([0; 40]);
    let utf_32 = TRIANGLE.chars().flat_map(|c| u32::from(c).to_be_bytes());
    let utf_32: Vec<u8> = [0, 0, 0xfe, 0xff].into_iter().chain(utf_32).collect();
    let folder = Folder::new();
    for (bytes, what) in [
        (&b"ISO-10303-21;\n"[..], "a STEP file"),
        (b"<COLLADA>", "a COLLADA file"),
        (b"Kaydara FBX Binary  \0\x1a\0", "a binary FBX file"),
        (&coff, "a compiled object file (COFF)"),
        (&utf_32, "UTF-32 text (not UTF-8)"),
    ] {
        for name in ["mesh.obj", "mesh.stl", "mesh", "mesh.obj.gz"] {
            folder.write(
                name,
                if name.ends_with("gz") {
                    packed(bytes)
                } else {
                    bytes.to_vec()
                },
            );
            let told =
                format!("{name}: is {what}: expected a mesh file (OBJ, STL, PLY, OFF or glTF)");
            folder
                .run(&format!("render {name} -o out.png"))
                .refused(&[&told]);
            folder.write("scene.toml", format!("[[object]]\nmesh = \"{name}\"\n"));
            folder
                .run("info scene.toml")
                .refused(&[&told, "scene.toml:2:8"]);
        }
    }
    folder.write("scene.toml", b"PK\x03\x04");
    folder
        .run("info scene.toml")
        .refused(&["cannot read the scene `scene.toml`: it is a ZIP archive"]);
}

#[cfg(unix)]
#[test]
fn a_broken_link_is_reported_as_a_broken_link() {
    let folder = Folder::new();
    for name in ["mesh.obj", "lib.mtl", "lost"] {
        std::os::unix::fs::symlink("gone", folder.path(name)).expect("a link");
    }
    let lost = "cannot be read: a link to gone, which is not there";
    for name in ["mesh.obj", "lost"] {
        folder
            .run(&format!("info {name}"))
            .refused(&[&format!("`{name}` {lost}")]);
    }
    folder
        .write("scene.toml", "[[object]]\nmesh = \"mesh.obj\"\n")
        .write(
            "other.obj",
            format!("mtllib lib.mtl\nusemtl red\n{TRIANGLE}"),
        );
    let told = "mesh.obj: cannot be read (a link to gone, which is not there)";
    folder.run("info scene.toml").refused(&[told]);
    let told = folder.run("info other.obj").done();
    told.says(&format!("material library `lib.mtl` (line 2) {lost}").replace("line 2", "line 1"));
    folder
        .run("info .")
        .refused(&[".: is a directory: expected a scene file or a mesh file"]);
}

#[test]
fn missing_and_lost_parts_of_a_mesh_are_reported_with_their_cause() {
    let folder = Folder::new();
    folder.write("white.obj", TRIANGLE);
    let command = "render white.obj --aov colours --size 8x6 -o out.png";
    let told = "white.obj: has no vertex colours: --aov colours shows it in white";
    folder.run(command).done().says(told);
    for (text, told) in [
        (
            "#MRGB ffffffff\n",
            "polypaint (`#MRGB`, colours in comments) is not read (line 5)",
        ),
        (
            "mtllib a.mtl\nmtllib ./a.mtl\nusemtl m\nf 1 2 3\n",
            "a.mtl:1: `Kd 9 9 9` before any `newmtl` is ignored\n",
        ),
    ] {
        folder
            .write(
                "a.mtl",
                "Kd 9 9 9\nnewmtl m\nKd 1 0 0\nnewmtl m\nKd 1 0 0\n",
            )
            .write("mesh.obj", format!("{TRIANGLE}{text}"));
        let ended = folder.run("info mesh.obj").done().says(told);
        assert_eq!(ended.err.matches("warning").count(), 1, "{}", ended.err);
    }
    let scaled =
        |size: &str, at: &str| format!("v {at} 0 {size}\nv {at} {size} 0\nv {at} 0 0\nf 1 2 3\n");
    for (text, told) in [
        (
            scaled("1e-150", "0"),
            "1 polygon is so small that 32-bit coordinates bend their shape: expected a larger unit of length",
        ),
        (
            scaled("1e-7", "1e10"),
            "the mesh is 1.0e-7 wide and 1.0e10 from 0, where 64-bit numbers are up to 2.2e-6 apart",
        ),
        (
            "v 7e9 7e9 7e9\n".repeat(3) + "f 1 2 3\n",
            "the mesh is 0.0e0 wide and 7.0e9 from 0",
        ),
    ] {
        folder.write("mesh.obj", &text);
        folder.run("info mesh.obj").says(told);
    }
    folder.write(
        "mesh.obj",
        TRIANGLE.replace("f 1 2 3", "f 1\\2\\3 2\\1\\1 3\\1\\1"),
    );
    folder
        .run("info mesh.obj")
        .refused(&["whole numbers with `/` between them, not `\\`"]);
    folder.write("mesh.obj", TRIANGLE.replace("v 1 0", "v 1e100 0"));
    folder
        .run("info mesh.obj")
        .refused(&["expected a finite number, at most 3.4e38, and in a scene 1e15"]);
}
