//! `fastphong render`: pictures and messages.

use super::{Folder, SPHERE, covered, methods_on_sphere, picture, sphere};
use fastphong::picture::Picture8;
use fastphong::picture::image_file::{FilePixels, read_picture};

#[test]
fn every_kind_of_input_is_drawn_at_the_requested_size() {
    let folder = Folder::new();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    folder
        .write("mesh.obj", obj)
        .write("scene.toml", "[[object]]\nmesh = \"mesh.obj\"\n");
    for input in [
        "mesh.obj",
        "scene.toml",
        "builtin:cube",
        "teapot",
        "vase",
        "football",
        "shipped:vase.obj",
    ] {
        for size in ["--size 64x48", "--resolution 64,48"] {
            folder
                .run(&format!(
                    "render {input} {size} --alpha coverage --samples 1 -o out.png"
                ))
                .done()
                .says("out.png: 64x48, phong-rsqrt");
            let picture = picture(&folder.path("out.png"));
            assert_eq!((picture.width(), picture.height()), (64, 48));
            assert!(covered(&picture) > 300, "{input} is hardly to be seen");
        }
    }
}

#[test]
fn every_method_draws_and_is_near_the_reference() {
    let phong = sphere("-m reference");
    for method in methods_on_sphere() {
        let drawn = sphere(&format!("-m {}", method.info.name));
        assert_eq!(covered(&drawn), covered(&phong), "{method:?}");
    }
    assert!(sphere("-m reference:model=phong") == phong);
    assert!(sphere("-m reference:phong") == phong);
    assert!(sphere("-m reference:model=flat") != phong);
    // Use the span engine: blocks of eight compute true roots on spans this short, whatever the
    // steps.
    let steps = |steps: &str| {
        sphere(&format!(
            "-m fast-phong:steps={steps} --engine span --simd scalar"
        ))
    };
    assert!(steps("1") != steps("8"));
    for (method, model) in [
        ("flat", "flat"),
        ("gouraud", "gouraud"),
        ("naive-phong", "phong"),
        ("slerp-phong", "slerp"),
    ] {
        let (a, b) = (
            sphere(&format!("-m {method}")),
            sphere(&format!("-m reference:model={model}")),
        );
        let difference = fastphong::compare::metrics::compare(&a, &b).unwrap();
        // At 64 columns and 48 rows no method is off by a tenth of a level (`Variant::bound`), so
        // stored values differ by at most one level.
        assert!(255.0 * difference.max <= 1.0, "{method}: {difference:?}");
    }
}

#[test]
fn a_pfm_holds_linear_floats_and_every_format_holds_the_same_picture() {
    let folder = Folder::new();
    for ending in ["png", "ppm", "pfm"] {
        folder
            .run(&format!("render {SPHERE} --encoding srgb -o out.{ending}"))
            .done();
    }
    folder.run(&format!("render {SPHERE} -o linear.png")).done();
    let FilePixels::Linear(floats) = read_picture(&folder.path("out.pfm")).unwrap().pixels else {
        panic!("no floats");
    };
    // A PFM is linear in every encoding. Rounded, it equals the linear picture.
    let rounded = floats.map(|pixel| pixel.map(fastphong::picture::encoding::quantise));
    let colours = |picture: &Picture8| picture.map(|[r, g, b, _]| [r, g, b]);
    assert_eq!(
        colours(&rounded),
        colours(&picture(&folder.path("linear.png")))
    );
    assert_eq!(
        colours(&picture(&folder.path("out.ppm"))),
        colours(&picture(&folder.path("out.png")))
    );
    assert_ne!(
        colours(&picture(&folder.path("out.ppm"))),
        colours(&rounded)
    );
}

#[test]
fn statistics_count_omitted_polygons() {
    let folder = Folder::new();
    // Two triangles are invisible: one is a line in space, the other is seen edge-on.
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.5 0 0\nf 1 2 3\nf 1 3 2\nf 1 5 2\nf 1 3 4\n";
    folder.write("mesh.obj", obj);
    let ended = folder
        .run("render mesh.obj --view 0,0 --size 64x48 --stats --cull back")
        .done();
    let counts: Vec<(&str, &str)> = ended
        .out
        .lines()
        .filter_map(|line| {
            let mut words = line.split_whitespace();
            Some((words.next()?, words.next()?))
        })
        .collect();
    let expected = [
        ("polygons", "4"),
        ("culled", "1"),
        ("no-area", "1"),
        ("cancelling", "0"),
        ("edge-on", "1"),
        ("outside", "0"),
        ("clipped", "0"),
        ("unprojected", "0"),
        ("drawn", "1"),
    ];
    assert_eq!(counts, expected);
    ended.says("warning: 1 of 4 polygons has no area and is left out");
    assert_eq!(
        folder.names(),
        ["mesh.obj"],
        "statistics alone draw nothing"
    );
    let verbose = folder
        .run("render mesh.obj --view 0,0 --size 64x48 -o out.png --verbose")
        .done();
    verbose
        .says("no-area")
        .says("shaded in")
        .says("warning: 1 of 4");
    folder
        .run("render mesh.obj --view 0,0 --size 64x48 -o out.ppm --verbose")
        .done()
        .says("shaded and written in");
    let quiet = folder
        .run("render mesh.obj --view 0,0 --size 64x48 -o out.png --quiet")
        .done();
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("", ""));
}

#[test]
fn the_printed_scene_gives_the_same_picture() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("sub")).unwrap();
    folder.write("sub/mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write(
        "sub/scene.toml",
        "ambient = 0.5\n[[object]]\nmesh = \"mesh.obj\"\ncrease = 20\n",
    );
    let flags = "--size 64x48 --light 1,0,1,0.5 --light-at 0,9,9,1,0.5,0 --attenuation 0.01 --viewer local \
                 --specular blinn --shininess-for phong --specular-gate weighted --kd 0.1,0.2,0.3 --view -30,20 \
                 --normals averaged";
    for input in [
        "builtin:gear?teeth=5",
        "vase",
        "perspective",
        "sub/scene.toml",
    ] {
        let printed = folder
            .run(&format!("render {input} {flags} --print-scene"))
            .done()
            .out;
        folder.write("printed.toml", &printed);
        assert!(
            !folder.path("a.png").exists(),
            "nothing is drawn without -o"
        );
        folder
            .run(&format!("render {input} {flags} -o a.png"))
            .done();
        folder.run("render printed.toml -o b.png").done();
        assert_eq!(
            folder.read("a.png"),
            folder.read("b.png"),
            "{input}:\n{printed}"
        );
        let both = folder
            .run(&format!("render {input} {flags} --print-scene -o c.png"))
            .done();
        assert_eq!(both.out, printed);
        assert_eq!(folder.read("a.png"), folder.read("c.png"));
        std::fs::remove_file(folder.path("a.png")).unwrap();
    }
}

/// The painter reports wrongly ordered polygons on standard error, but not with `--quiet`.
#[test]
fn the_painter_reports_wrongly_ordered_polygons() {
    let folder = Folder::new();
    let said = |input: &str| {
        folder
            .run(&format!("render {input} --visibility painter -o out.png"))
            .done()
            .err
    };
    let ring = said("cyclic-triangles");
    assert!(
        ring.contains("warning: 3 polygons in 1 cycle: no order draws them right; "),
        "{ring}"
    );
    let cut = said("interpenetration");
    assert!(
        cut.contains("3 polygons in 1 cycle") && cut.contains(", 3 pairs cut each other"),
        "{cut}"
    );
    assert!(
        !said("builtin:cube").contains("warning")
            && !said("interpenetration --quiet").contains("warning")
    );
    let refused = folder.run("render teapot --depth-bits 20 -o out.png");
    assert!(
        refused
            .err
            .contains("`--depth-bits` is 20: expected 16, 24 or 32"),
        "{}",
        refused.err
    );
}

/// Supersampling keeps the picture's size. A depth picture shows one sample per pixel.
#[test]
fn supersampled_pictures_have_the_size_of_the_scene() {
    let plain = sphere("");
    let smooth = sphere("--samples 4");
    assert_eq!(
        (smooth.width(), smooth.height()),
        (plain.width(), plain.height())
    );
    let partly = |picture: &Picture8| {
        picture
            .pixels()
            .iter()
            .filter(|t| t[3] > 0 && t[3] < 255)
            .count()
    };
    assert!(partly(&smooth) > 50 && partly(&plain) == 0);
    assert!(sphere("--samples 4 -m reference") != sphere("-m reference"));
    assert!(sphere("--samples 1") == plain);
    let folder = Folder::new();
    for aov in ["depth", "normal", "polygon"] {
        folder
            .run(&format!(
                "render builtin:torus --size 64x48 --aov {aov} -o plain.png"
            ))
            .done();
        folder
            .run(&format!(
                "render builtin:torus --size 64x48 --aov {aov} --samples 2 -o out.png"
            ))
            .done()
            .says("--aov shows a single sample per pixel");
        assert!(
            picture(&folder.path("plain.png")) == picture(&folder.path("out.png")),
            "{aov}"
        );
    }
    let refused = folder.run("render teapot --size 8000x10 --samples 4 -o out.png");
    assert!(
        refused
            .err
            .contains("`--samples` is 4: expected at most 16384 samples per side"),
        "{}",
        refused.err
    );
}

/// Without clipping, a polygon with a corner in the eye plane cannot be projected. The tool leaves
/// it out, reports it and counts it.
#[test]
fn unprojectable_polygons_are_reported() {
    let folder = Folder::new();
    folder.write(
        "ground.obj",
        "v -1 0 0\nv 1 0 0\nv 0 0 -5\nv -1 0 -2\nv 1 0 -2\nv 0 0 -5\nf 1 2 3\nf 4 5 6\n",
    );
    let flags =
        "--eye 0,1,0 --target 0,1,-1 --fovy 60 --near 0.1 --far 9 --cull none --stats -o out.png";
    let ended = folder
        .run(&format!("render ground.obj {flags} --clipping ndc-cube"))
        .done();
    ended.says("warning: 1 polygon has a corner at the plane of the eye and is left out");
    folder
        .run("render perspective --clipping ndc-cube -o out.png")
        .says("`--clipping` and `interpolation` exclude each other");
}
