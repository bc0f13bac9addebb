//! Files are what their bytes say, whatever they are called: scenes, meshes, packed ones, and those of other formats.

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

/// Draws `input` with the file `name` as standard input, if one is given.
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
fn packed_libraries_are_read_and_damaged_ones_told() {
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

#[test]
fn files_of_other_formats_are_called_by_their_names() {
    let mut stl = vec![0; 80];
    stl.extend(1u32.to_le_bytes());
    stl.extend([0; 50]);
    let mut coff = vec![0x64, 0x86, 1, 0];
    coff.extend([0; 40]);
    let utf_32 = TRIANGLE.chars().flat_map(|c| u32::from(c).to_be_bytes());
    let utf_32: Vec<u8> = [0, 0, 0xfe, 0xff].into_iter().chain(utf_32).collect();
    let folder = Folder::new();
    for (bytes, what) in [
        (&b"solid part\nfacet normal 0 0 1\n"[..], "a text STL file"),
        (&stl, "a binary STL file"),
        (
            b"ply\nformat binary_little_endian 1.0\n\xff\0",
            "a PLY file",
        ),
        (b"OFF\n3 1 3\n", "an OFF file"),
        (
            b"{ \"asset\": { \"version\": \"2.0\" } }",
            "a glTF file (JSON)",
        ),
        (b"glTF\x02\0\0\0", "a binary glTF file"),
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
            let told = format!("{name}: is {what}: expected OBJ text");
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
fn a_link_that_leads_nowhere_is_told_as_one() {
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
fn what_a_mesh_lacks_or_loses_is_told_with_its_cause() {
    let folder = Folder::new();
    folder.write("white.obj", TRIANGLE);
    let command = "render white.obj --aov colours --size 8x6 -o out.png";
    let told = "white.obj: has no vertex colours: it is white in --aov colours";
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
