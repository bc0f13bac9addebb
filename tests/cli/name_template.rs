//! `render -o "{scene}_{method}.png"`: placeholders in names of pictures.

use super::Folder;

#[test]
fn placeholders_stand_for_facts_about_the_picture() {
    let folder = Folder::new();
    folder.write("my mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (render, name) in [
        (
            "teapot --size 64x48 -m gouraud -o {scene}_{method}.png",
            "teapot_gouraud.png",
        ),
        (
            "builtin:sphere?rings=6&segments=8 --size 64x48 -m fast-phong:steps=1 --simd scalar \
             -o {scene}_{method}_{engine}_{width}x{height}.ppm",
            "builtin-sphere-rings-6-segments-8_fast-phong-steps-1_span_64x48.ppm",
        ),
        (
            "two-lights --simd scalar -o {method}.png",
            "naive-phong.png",
        ),
        (
            "shipped:vase.obj -m reference --size 64x48 -o {scene}-{engine}.png",
            "shipped-vase-reference.png",
        ),
        (
            "football --size 64x48 --aov depth -o {scene}-{method}{scene}.png",
            "football-depthfootball.png",
        ),
        (
            "football --size 64x48 -m gouraud --engine cs171 -o {engine}.png",
            "cs171.png",
        ),
        ("football --size 64x48 -o a{b.png", "a{b.png"),
    ] {
        folder
            .run(&format!("render {render}"))
            .done()
            .says(&format!("{name}: "));
        assert!(
            folder.names().iter().any(|found| found == name),
            "{:?}",
            folder.names()
        );
    }
    let mut command = folder.command("render --size 8x6 -o {scene}.png");
    assert!(
        command
            .arg("my mesh.obj")
            .output()
            .unwrap()
            .status
            .success()
    );
    assert!(folder.names().contains(&"my-mesh.png".to_owned()));
}

#[test]
fn unknown_placeholders_are_one_error() {
    let folder = Folder::new();
    let known = "expected one of {scene}, {method}, {engine}, {width}, {height}";
    for name in ["{scnee}.png", "{}.png", "{scene}_{Method}.png"] {
        folder
            .run(&format!("render teapot -o {name}"))
            .refused(&["which is no placeholder", known]);
    }
    // The name is expanded before it is compared with the name of the reference.
    folder
        .run("render football --size 64x48 -o football.png")
        .done();
    folder
        .run("render football --size 64x48 -o {scene}.png --reference football.png")
        .refused(&["is the reference itself"]);
    assert_eq!(folder.names(), ["football.png"]);
}
