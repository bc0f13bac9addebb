//! The light rig that the tool adds to a mesh without a scene.

use super::{Folder, covered, picture};
use fastphong::picture::Picture8;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// A mesh without a scene stands before opaque grey with smooth edges, lit from the camera's upper
/// left in every view.
#[test]
fn a_mesh_without_a_scene_is_shown_by_the_light_rig() {
    let folder = Folder::new();
    let draw = |flags: &str| {
        folder
            .run(&format!(
                "render builtin:sphere --size 64x48 {flags} -o out.png"
            ))
            .done();
        picture(&folder.path("out.png"))
    };
    let grey = |picture: &Picture8, x: usize, y: usize| u32::from(picture.get(x, y)[1]);
    for view in [
        "",
        "--view 0,0",
        "--view 180,0",
        "--view 90,60",
        "--eye 3,-2,0",
    ] {
        let sphere = draw(view);
        assert_eq!(covered(&sphere), 64 * 48, "opaque");
        let [r, g, b, _] = sphere.get(0, 0);
        assert!(
            (40..90).contains(&g) && r.abs_diff(b) < 8,
            "quiet: {r} {g} {b}"
        );
        let (lit, dark) = (grey(&sphere, 26, 17), grey(&sphere, 39, 33));
        assert!(lit > 2 * dark && lit < 250, "{view}: {lit} and {dark}");
    }
    let smooth = draw("");
    assert!(smooth == draw("--samples 2") && smooth != draw("--samples 1"));
    // Each flag overrides one part of the rig.
    assert_eq!(draw("--background 0").get(0, 0), [0, 0, 0, 255]);
    assert_eq!(draw("--alpha coverage").get(0, 0)[3], 0);
    assert!(draw("--light 0,0,1") != smooth && draw("--kd 0.1") != smooth);
    let plain = "--ambient 1 --light 0.4,0.7,0.9 --ka 0.08,0.07,0.06 --kd 0.6,0.45,0.3 --ks 0.4 --shininess 32 \
                 --background 0 --encoding linear --alpha coverage --samples 1";
    folder.write("scene.toml", "[[object]]\nmesh = \"builtin:sphere\"\n");
    folder
        .run("render scene.toml --size 64x48 -o plain.png")
        .done();
    assert!(draw(plain) == picture(&folder.path("plain.png")));
}

/// A mesh without a scene has four samples per pixel where they are cheap and fit into memory, and
/// one elsewhere.
#[test]
fn meshes_of_many_polygons_and_large_pictures_have_one_sample() {
    let folder = Folder::new();
    let has = |input: &str, samples: bool| {
        let printed = folder
            .run(&format!("render {input} --print-scene"))
            .done()
            .out;
        assert_eq!(
            printed.contains("samples = 2"),
            samples,
            "{input}: {printed}"
        );
    };
    has("builtin:cube", true);
    has("builtin:cube --size 16384x2", false);
    has("builtin:sphere?polygons=100000", true);
    has("builtin:sphere?polygons=100000 --size 3000x3000", false);
    has("builtin:cube --samples 1", false);
    // Scenes and comparisons keep their own settings.
    has("teapot", false);
    folder.run("info builtin:cube").done().prints("lights   1");
    folder
        .run("compare builtin:cube --size 32x24 --time-budget 0")
        .done()
        .prints("1 light");
}

/// Materials of the mesh override the clay, and the report shows a mesh as `render` does.
#[test]
fn materials_of_the_mesh_override_the_rig_in_pictures_and_reports() {
    let folder = Folder::new();
    folder
        .write("red.mtl", "newmtl red\nKa 0 0 0\nKd 1 0 0\nKs 0 0 0\n")
        .write(
            "mesh.obj",
            format!("mtllib red.mtl\n{TRIANGLE}usemtl red\nf 1 2 3\n"),
        );
    folder.run("render mesh.obj --size 64x48 -o out.png").done();
    let [r, g, b, _] = picture(&folder.path("out.png")).get(30, 26);
    assert!(r > 100 && g == 0 && b == 0, "{r} {g} {b}");
    let quick = "--size 48x36 --time-budget 0 --methods flat --json all.json";
    folder.run(&format!("report mesh.obj {quick}")).done();
    let json: serde_json::Value = serde_json::from_slice(&folder.read("all.json")).unwrap();
    assert_eq!(
        json["comparisons"][0]["lights"], 2,
        "a key and a fill light"
    );
}

/// Faces may name normals that the file does not have, as in other loaders. The tool warns once.
#[test]
fn faces_may_name_missing_normals() {
    let folder = Folder::new();
    folder.write("mesh.obj", format!("{TRIANGLE}f 1/1/1 2/2/1 3/3/1\n"));
    let ended = folder.run("render mesh.obj --size 64x48 -o out.png").done();
    assert_eq!(ended.err.matches("warning").count(), 1, "{}", ended.err);
    ended
        .says("warning: mesh.obj: a face names normals or texture coordinates")
        .says("line 4)");
    folder.write(
        "mesh.obj",
        format!("{TRIANGLE}vn 0 0 1\nf 1//1 2//2 3//1\n"),
    );
    folder
        .run("render mesh.obj --size 64x48 -o out.png")
        .done()
        .says(
            "a corner names a normal that does not exist and counts as without a normal (line 5)",
        );
}
