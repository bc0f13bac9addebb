//! `fastphong render`: pictures, flags, and flags that make no sense.

use super::{Folder, SPHERE, picture};
use fastphong::image_file::{FileTexels, read_picture};
use fastphong::picture::Picture8;

/// The colours of `input` with `flags`.
fn rendered(flags: &str) -> Picture8 {
    let folder = Folder::new();
    folder.run(&format!("render {flags} -o out.png")).done();
    picture(&folder.path("out.png"))
}

fn sphere(flags: &str) -> Picture8 {
    rendered(&format!("{SPHERE} {flags}"))
}

fn covered(picture: &Picture8) -> usize {
    picture.texels().iter().filter(|texel| texel[3] == 255).count()
}

#[test]
fn every_kind_of_input_gives_a_picture_of_the_size_asked_for() {
    let folder = Folder::new();
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    folder.write("mesh.obj", obj).write("scene.toml", "[[object]]\nmesh = \"mesh.obj\"\n");
    for input in ["mesh.obj", "scene.toml", "builtin:cube", "teapot", "vase", "football", "shipped:vase.obj"] {
        for size in ["--size 64x48", "--resolution 64,48"] {
            folder.run(&format!("render {input} {size} -o out.png")).done().says("out.png: 64x48, fast-phong");
            let picture = picture(&folder.path("out.png"));
            assert_eq!((picture.width(), picture.height()), (64, 48));
            assert!(covered(&picture) > 300, "{input} is hardly to be seen");
        }
    }
}

#[test]
fn every_method_and_the_reference_draw_and_are_near_each_other() {
    let phong = sphere("-m reference");
    for method in fastphong::shader::METHODS {
        let drawn = sphere(&format!("-m {}", method.info.name));
        assert_eq!(covered(&drawn), covered(&phong), "{method:?}");
    }
    assert!(sphere("-m reference:model=phong") == phong);
    assert!(sphere("-m reference:model=flat") != phong);
    assert!(sphere("-m fast-phong:steps=1") != sphere("-m fast-phong:steps=8"));
    for (method, model) in
        [("flat", "flat"), ("gouraud", "gouraud"), ("naive-phong", "phong"), ("slerp-phong", "slerp")]
    {
        let (a, b) = (sphere(&format!("-m {method}")), sphere(&format!("-m reference:model={model}")));
        let difference = fastphong::metrics::compare(&a, &b).unwrap();
        // At 64 columns and 48 rows no method is off by a tenth of a level (`Info::bound`), which moves what is stored by
        // one level at most.
        assert!(255.0 * difference.max <= 1.0, "{method}: {difference:?}");
    }
}

#[test]
fn engines_agree_and_say_what_they_do() {
    let folder = Folder::new();
    let run =
        |engine: &str, name: &str| folder.run(&format!("render {SPHERE} -m flat --engine {engine} -o {name}")).done();
    run("scanline", "a.png");
    run("span", "b.png");
    run("barycentric", "c.png").says("16 polygons of more than three corners are cut into triangles");
    run("barycentric:edges=top-left", "d.png");
    run("barycentric:edges=closed", "e.png");
    // Flat shading has one colour a polygon: the engines agree to the last bit.
    for name in ["b.png", "c.png", "d.png"] {
        assert_eq!(folder.read(name), folder.read("a.png"), "{name}");
    }
    let refused = |method: &str| folder.run(&format!("render {SPHERE} -m {method} --engine barycentric -o out.png"));
    let has = "expected one of flat, flat-average, gouraud, gouraud-separate, naive-phong";
    refused("fast-phong").refused(&["the barycentric renderer does not have `fast-phong`", has]);
    refused("reference").refused(&["the barycentric renderer does not have `reference`", has]);
}

/// CS171's algorithms give the pictures of the methods that they are; with normals as printed another one.
#[test]
fn cs171_draws_what_the_engines_draw() {
    let folder = Folder::new();
    for method in ["flat-average", "gouraud", "naive-phong"] {
        folder.run(&format!("render {SPHERE} -m {method} --engine barycentric -o a.png")).done();
        // A channel may differ by the one level that rounding of an f32 turns.
        let flags = "--engine cs171 --reference a.png --reference-threshold 1";
        let done = folder.run(&format!("render {SPHERE} -m {method} {flags} -o b.png")).done();
        done.says("16 polygons of more than three corners are cut into triangles for CS171");
    }
    folder.run(&format!("render {SPHERE} -m naive-phong --engine cs171:normals=unit -o c.png")).done();
    folder.run(&format!("render {SPHERE} -m naive-phong --engine cs171:normals=as-printed -o d.png")).done();
    assert_eq!(folder.read("b.png"), folder.read("c.png"));
    assert_ne!(folder.read("c.png"), folder.read("d.png"));
    let refused = |method: &str| folder.run(&format!("render {SPHERE} -m {method} --engine cs171 -o out.png"));
    let has = "expected one of flat-average, gouraud, naive-phong";
    refused("flat").refused(&["CS171 does not have `flat`", has]);
    refused("reference").refused(&["CS171 does not have `reference`", has]);
}

#[test]
fn polygons_that_cross_themselves_are_told_of() {
    let folder = Folder::new();
    folder.write("bow.obj", "v 0 0 0\nv 2 2 0\nv 2 1 0\nv 0 2 0\nv 0 -1 0\nv 1 -1 0\nv 0 -2 0\nf 1 2 3 4\nf 5 7 6\n");
    let flags = "--cull none --size 64x48 -m flat -o out.png";
    folder
        .run(&format!("render bow.obj --engine barycentric {flags}"))
        .done()
        .says("warning: 1 polygon crosses or overlaps itself and is left out");
}

/// Each flag changes the picture; its value as the scene's own does not.
#[test]
fn flags_change_the_picture() {
    let plain = sphere("");
    for same in ["--light 0.4,0.7,0.9", "--ambient 1", "--ks 0.4", "--shininess 32", "--cull back", "--fit 0.8"] {
        assert!(sphere(same) == plain, "{same}");
    }
    for flags in [
        "--view 0,0",
        "--eye 3,0,3",
        "--eye 3,0,3 --target 0,0.5,0",
        "--up 1,0,0",
        "--fovy 40",
        "--half-height 2",
        "--near 7",
        "--far 7",
        "--fit 0.5",
        "--light -1,0,0",
        "--light 0.4,0.7,0.9,0.5",
        "--light 0.4,0.7,0.9,1,0,0",
        "--light 1,0,0 --light 0,0,1",
        "--no-lights",
        "--ambient 2",
        "--ka 0.5",
        "--kd 0.1,0.2,0.3",
        "--ks 0",
        "--shininess 5",
        "--background 0.25",
        "--encoding srgb",
        "--cull front",
        "--normals given",
        "--normals crease=1",
    ] {
        assert!(sphere(flags) != plain, "{flags}");
    }
    // What each changes about a light at a place that shines on the back of the sphere, too.
    let near = "--fovy 40 --light-at 2,1,-0.5 --light-at 1,2,3,0.5";
    let lit = sphere(near);
    assert!(lit != sphere("--fovy 40 --light 2,1,-0.5 --light 1,2,3,0.5"));
    for same in ["--attenuation 0", "--viewer infinite", "--specular phong", "--specular-gate gated"] {
        assert!(sphere(&format!("{near} {same}")) == lit, "{same}");
    }
    for flags in [
        "--attenuation 0.2",
        "--falloff inverse",
        "--falloff inverse-square",
        "--viewer local",
        "--specular blinn",
        "--shininess-for blinn",
        "--specular-gate ungated --shininess 2",
        "--specular-gate weighted",
    ] {
        assert!(sphere(&format!("{near} {flags}")) != lit, "{flags}");
    }
    let cut = |flags: &str| rendered(&format!("interpenetration {flags}"));
    for flags in ["--visibility draw-order", "--visibility painter"] {
        assert!(cut(flags) != cut(""), "{flags}");
    }
    assert!(cut("--visibility painter --painter-key farthest") != cut("--visibility painter"));
    assert!(cut("--visibility z-buffer --depth-bits 32 --depth interpolated") == cut(""));
    assert!(sphere("--cull front --two-sided") != sphere("--cull front") && sphere("--clipping planes") == plain);
    assert!(rendered("z-fighting --near 21 --clipping ndc-cube") != rendered("z-fighting"));
    assert!(rendered("z-fighting --depth-bits 24") != rendered("z-fighting"));
    assert!(rendered("z-fighting --depth per-sample") != rendered("z-fighting"));
    assert!(rendered("perspective --size 64x48") != rendered("perspective --size 64x48 --interpolation screen"));
    assert!(sphere("--normals averaged") == plain);
}

#[test]
fn view_zero_is_from_z_and_azimuth_turns_toward_x() {
    for (view, eye) in [("0,0", "0,0,4"), ("90,0", "4,0,0"), ("0,90", "0,4,0"), ("-45,0", "-3,0,3")] {
        let up = if view == "0,90" { " --up 0,0,-1" } else { "" };
        let turned = rendered(&format!("builtin:gear --size 64x48 --fit 0.7 --view {view}"));
        let placed = rendered(&format!("builtin:gear --size 64x48 --fit 0.7 --eye {eye}{up}"));
        // The two directions differ by the rounding of a sine: places on the picture do so by less than 1/256 pixel,
        // which may move a pixel of the rim.
        let differing = turned.texels().iter().zip(placed.texels()).filter(|(a, b)| a[3] != b[3]).count();
        assert!(differing <= 2, "{view}: {differing} pixels");
    }
}

#[test]
fn material_flags_stand_over_every_material() {
    let folder = Folder::new();
    let black = "--ka 0 --kd 0 --ks 0 --size 64x48 -o out.png";
    for (input, replaces) in [("four-lights", false), ("perspective", false), ("vase", true)] {
        let ended = folder.run(&format!("render {input} --background 1 {black}")).done();
        assert_eq!(ended.err.contains("replaces those of the mesh file"), replaces, "{input}: {}", ended.err);
        let drawn = picture(&folder.path("out.png"));
        assert!(drawn.texels().iter().all(|texel| texel[3] == 0 || texel[..3] == [0; 3]), "{input}");
    }
}

#[test]
fn without_lights_only_ambient_light_is_left() {
    let drawn = sphere("--no-lights --ambient 1 --ka 0.2,0.4,0.6");
    // round(255 k_a)
    assert!(drawn.texels().iter().all(|texel| texel[3] == 0 || *texel == [51, 102, 153, 255]));
    assert!(covered(&drawn) > 300);
}

#[test]
fn a_pfm_holds_linear_floats_and_every_format_the_same_picture() {
    let folder = Folder::new();
    for ending in ["png", "ppm", "pfm"] {
        folder.run(&format!("render {SPHERE} --encoding srgb -o out.{ending}")).done();
    }
    folder.run(&format!("render {SPHERE} -o linear.png")).done();
    let FileTexels::Linear(floats) = read_picture(&folder.path("out.pfm")).unwrap().texels else {
        panic!("no floats");
    };
    // Linear whatever the encoding: rounded, it is the linear picture.
    let rounded = floats.map(|texel| texel.map(fastphong::encoding::quantise));
    let colours = |picture: &Picture8| picture.map(|[r, g, b, _]| [r, g, b]);
    assert_eq!(colours(&rounded), colours(&picture(&folder.path("linear.png"))));
    assert_eq!(colours(&picture(&folder.path("out.ppm"))), colours(&picture(&folder.path("out.png"))));
    assert_ne!(colours(&picture(&folder.path("out.ppm"))), colours(&rounded));
}

#[test]
fn aovs_show_depth_normals_and_polygons() {
    let folder = Folder::new();
    for aov in ["depth", "normal", "polygon"] {
        folder
            .run(&format!("render {SPHERE} --view 0,0 --aov {aov} -o {aov}.png"))
            .done()
            .says(&format!("64x48, {aov}"));
        folder.run(&format!("render {SPHERE} --view 0,0 --aov {aov} -o {aov}.pfm")).done();
    }
    let depth = picture(&folder.path("depth.png"));
    let drawn = depth.texels().iter().filter(|texel| texel[3] == 255);
    assert_eq!(drawn.clone().map(|texel| texel[0]).max(), Some(255), "the nearest pixel is white");
    assert_eq!(drawn.map(|texel| texel[0]).min(), Some(0), "the farthest pixel is black");
    assert!(depth.get(32, 24)[0] > 200 && depth.get(0, 0) == [0; 4]);
    // In the middle the normal is about z: (N + 1)/2 = (½, ½, 1), and the facets there lean by less than 30 degrees.
    let [r, g, b, _] = picture(&folder.path("normal.png")).get(32, 24);
    assert!(r.abs_diff(128) < 64 && g.abs_diff(128) < 64 && b > 237, "{r} {g} {b}");

    let floats = |name: &str| match read_picture(&folder.path(name)).unwrap().texels {
        FileTexels::Linear(floats) => floats,
        FileTexels::Stored(_) => panic!("{name} holds no floats"),
    };
    let raw = floats("depth.pfm");
    assert!((0.0..1.0).contains(&raw.get(32, 24)[0]) && raw.get(0, 0)[0] == f32::INFINITY);
    let (numbers, colours) = (floats("polygon.pfm"), picture(&folder.path("polygon.png")));
    assert_eq!(numbers.get(0, 0)[0], -1.0);
    let mut neighbours = 0;
    for y in 0..48 {
        for x in 1..64 {
            let same = numbers.get(x - 1, y)[0] == numbers.get(x, y)[0];
            assert_eq!(colours.get(x - 1, y) == colours.get(x, y), same, "column {x}, row {y}");
            neighbours += usize::from(!same);
        }
    }
    assert!(neighbours > 100, "{neighbours}");
    folder.run(&format!("render {SPHERE} --aov depth -m flat -o out.png")).refused(&["cannot be used with"]);
}

/// A triangle with a red, a green and a blue corner; a square of four world units under the checkerboard.
#[test]
fn aovs_show_vertex_colours_and_a_checkerboard() {
    let folder = Folder::new();
    folder.write("rgb.obj", "v 0 0 0 1 0 0\nv 4 0 0 0 1 0\nv 0 4 0 0 0 1\nf 1 2 3\n");
    let view = "--view 0,0 --size 40x40";
    folder.run(&format!("render rgb.obj {view} --aov colours -o rgb.png")).done().says("40x40, colours");
    let rgb = picture(&folder.path("rgb.png"));
    // Weights sum to 1, and so do the colours: 255, give or take a half for each of three roundings.
    let drawn: Vec<[u8; 4]> = rgb.texels().iter().copied().filter(|t| t[3] == 255).collect();
    assert!(
        drawn.len() > 200 && drawn.iter().all(|t| t[..3].iter().map(|&c| i32::from(c)).sum::<i32>().abs_diff(255) <= 1)
    );
    for channel in 0..3 {
        assert!(drawn.iter().any(|t| t[channel] > 230), "a corner of channel {channel}");
    }
    folder.write("floor.obj", "v 0 0 0\nv 0 0 4\nv 4 0 4\nv 4 0 0\nf 1 2 3 4\n");
    let view = "--view 0,90 --size 40x40";
    for (square, squares) in [("1", 16), ("2", 4), ("8", 1)] {
        folder.run(&format!("render floor.obj {view} --aov checkerboard --square {square} -o board.png")).done();
        let board = picture(&folder.path("board.png"));
        let (mut light, mut dark) = (0, 0);
        for t in board.texels().iter().filter(|t| t[3] == 255) {
            *(if t[0] > 128 { &mut light } else { &mut dark }) += 1;
        }
        // Half of the squares each, but of the one square.
        assert!(light > 300 && (squares == 1) == (dark == 0), "{square}: {light}, {dark}");
        assert!(squares == 1 || light * 10 < dark * 13 && dark * 10 < light * 13, "{square}: {light}, {dark}");
    }
    folder
        .run("render floor.obj --aov checkerboard --square 0 -o out.png")
        .refused(&["expected a length in world units"]);
    folder.run("render floor.obj --square 2 -o out.png").refused(&["--aov"]);
}

#[test]
fn statistics_count_what_is_left_out() {
    let folder = Folder::new();
    // Two triangles without area: one on a line in space, and one that is seen from its edge.
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.5 0 0\nf 1 2 3\nf 1 3 2\nf 1 5 2\nf 1 3 4\n";
    folder.write("mesh.obj", obj);
    let ended = folder.run("render mesh.obj --view 0,0 --size 64x48 --stats").done();
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
        ("zero-area", "2"),
        ("outside", "0"),
        ("clipped", "0"),
        ("unprojected", "0"),
        ("drawn", "1"),
    ];
    assert_eq!(counts, expected);
    ended.says("warning: 2 of 4 polygons have no area and are left out");
    assert_eq!(folder.names(), ["mesh.obj"], "statistics alone draw nothing");
    let verbose = folder.run("render mesh.obj --view 0,0 --size 64x48 -o out.png --verbose").done();
    verbose.says("zero-area").says("shaded in").says("warning: 2 of 4");
    let quiet = folder.run("render mesh.obj --view 0,0 --size 64x48 -o out.png --quiet").done();
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("", ""));
}

#[test]
fn the_printed_scene_gives_the_same_picture() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("sub")).unwrap();
    folder.write("sub/mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("sub/scene.toml", "ambient = 0.5\n[[object]]\nmesh = \"mesh.obj\"\ncrease = 20\n");
    let flags = "--size 64x48 --light 1,0,1,0.5 --light-at 0,9,9,1,0.5,0 --attenuation 0.01 --viewer local \
                 --specular blinn --shininess-for phong --specular-gate weighted --kd 0.1,0.2,0.3 --view -30,20 \
                 --normals averaged";
    for input in ["builtin:gear?teeth=5", "vase", "perspective", "sub/scene.toml"] {
        let printed = folder.run(&format!("render {input} {flags} --print-scene")).done().out;
        folder.write("printed.toml", &printed);
        assert!(!folder.path("a.png").exists(), "nothing is drawn without -o");
        folder.run(&format!("render {input} {flags} -o a.png")).done();
        folder.run("render printed.toml -o b.png").done();
        assert_eq!(folder.read("a.png"), folder.read("b.png"), "{input}:\n{printed}");
        let both = folder.run(&format!("render {input} {flags} --print-scene -o c.png")).done();
        assert_eq!(both.out, printed);
        assert_eq!(folder.read("a.png"), folder.read("c.png"));
        std::fs::remove_file(folder.path("a.png")).unwrap();
    }
}

#[test]
fn flags_that_make_no_sense_are_refused_by_name() {
    let folder = Folder::new();
    for (flags, parts) in [
        ("-m fast-fong", &["unknown method `fast-fong`: did you mean `fast-phong`?"][..]),
        ("-m refrence", &["did you mean `reference`?"]),
        ("-m reference:model=fong", &["`model=fong`: expected one of model=flat"]),
        ("-m reference:phong", &["`phong`: expected one of model=flat"]),
        ("-m fast-phong:steps=9", &["`steps=9`: expected a whole number from 1 to 8"]),
        ("-m flat:steps=1", &["method `flat` has no parameters"]),
        ("--engine barycentrik", &["did you mean `barycentric`?"]),
        ("--engine barycentric:edges=open", &["expected edges=top-left or edges=closed"]),
        ("--engine cs172", &["did you mean `cs171`?"]),
        ("--engine cs171:normals=raw", &["expected normals=unit or normals=as-printed"]),
        ("--size 0x0", &["`--resolution` is 0: expected 1 to 16384"]),
        ("--size 20000x10", &["`--resolution` is 20000: expected 1 to 16384"]),
        ("--size 64", &["expected WIDTHxHEIGHT"]),
        ("--fovy 200", &["`--fovy` is 200: expected degrees over 0 and under 180"]),
        ("--fovy 40 --half-height 1", &["`--fovy` and `--half-height` exclude each other"]),
        ("--view 0,91", &["`--view` is 91: expected degrees between -90 and 90"]),
        ("--view 0", &["expected two numbers azimuth,elevation"]),
        ("--view 0,0 --eye 1,2,3", &["`--view` and `--eye` exclude each other"]),
        ("--eye 0,0,0", &["`--eye` is where `target` is"]),
        ("--eye 0,0,NaN", &["`--eye`", "NaN"]),
        ("--eye 1,2", &["expected three numbers x,y,z"]),
        ("--target 1,0,0", &["`--target` exclude each other: expected a place (`eye`, `target`) or a direction"]),
        ("--near 5 --far 1", &["`--far` is 1: expected more than near = 5"]),
        ("--light 0,0,0", &["`--light` has no length"]),
        ("--light 1,0,0,-1", &["`--light` is -1: expected 0 or more"]),
        ("--light 1,0", &["expected a direction x,y,z"]),
        ("--light 1,0,0 --no-lights", &["cannot be used with"]),
        ("--light-at 0,0", &["expected a position x,y,z"]),
        ("--light-at 0,0,NaN", &["`--light-at` has z = NaN: expected numbers between"]),
        ("--light-at 0,0,5,-1", &["`--light-at` is -1: expected 0 or more"]),
        ("--light-at 0,0,5 --no-lights", &["cannot be used with"]),
        ("--light-at 1,1,1", &["`--light-at` is at a vertex, (1, 1, 1): expected a place off the vertices"]),
        ("--light-at 0,0,5 --attenuation -2", &["`--attenuation` is -2: expected 0 or more"]),
        ("--light-at 0,0,5 --attenuation NaN", &["`--attenuation` is NaN: expected 0 or more"]),
        ("--attenuation 1", &["required arguments were not provided", "--light-at"]),
        ("--falloff inverse", &["required arguments were not provided", "--light-at"]),
        ("--light-at 0,0,5 --falloff inverses", &["inverse-square"]),
        ("--light-at 0,0,5 --falloff inverse --attenuation 1", &["exclude each other"]),
        ("--light 1,0,0 --attenuation 1", &["required arguments were not provided", "--light-at"]),
        ("--viewer lokal", &["invalid value 'lokal'", "infinite, local", "'local'"]),
        ("--specular blin", &["phong, blinn", "'blinn'"]),
        ("--shininess-for fong", &["phong, blinn", "'phong'"]),
        ("--specular-gate open", &["gated, ungated, weighted"]),
        ("--up 0,0,0", &["`--up` has no length"]),
        ("--eye 0,0,5 --up 0,0,1", &["`--up` is parallel to the line of sight"]),
        ("--fovy 0", &["`--fovy` is 0: expected degrees over 0 and under 180"]),
        ("--near 3 --far 3", &["`--far` is 3: expected more than near = 3"]),
        ("--ks -1", &["`--ks` is -1: expected 0 or more"]),
        ("--kd 1,2", &["expected one number, or three r,g,b"]),
        ("--shininess -2", &["`--shininess` is -2: expected 0 or more"]),
        ("--background 2", &["`--background` is 2: expected 0 to 1"]),
        ("--normals crease=200", &["`--normals` is 200: expected degrees between 0 and 180"]),
        ("--normals smooth", &["expected `averaged`, `given` or `crease=DEGREES`"]),
        ("--cull left", &["invalid value 'left'", "back, front, none"]),
        ("--encoding gamma", &["linear, srgb"]),
        ("--fit 0", &["`--fit` is 0"]),
        ("--veiw 1,2", &["unexpected argument '--veiw'", "similar argument exists: '--view'"]),
    ] {
        folder.run(&format!("render builtin:cube {flags} -o out.png")).refused(parts);
        assert!(folder.names().is_empty(), "{flags} left {:?}", folder.names());
    }
    folder.run("render builtin:cube").refused(&["--output <FILE>"]);
    folder.run("render").refused(&["<INPUT>"]);
    folder.run("rendr builtin:cube").refused(&["unrecognized subcommand 'rendr'", "render"]);
    folder.run("render builtin:cube -v -q -o out.png").refused(&["cannot be used with"]);
}

/// The painter says what it draws wrongly, on standard error, unless it is to be quiet.
#[test]
fn the_painter_says_what_it_draws_wrongly() {
    let folder = Folder::new();
    let said = |input: &str| folder.run(&format!("render {input} --visibility painter -o out.png")).done().err;
    let ring = said("cyclic-triangles");
    assert!(ring.contains("warning: 3 polygons in 1 cycle: no order draws them right; "), "{ring}");
    let cut = said("interpenetration");
    assert!(cut.contains("3 polygons in 1 cycle") && cut.contains(", 3 pairs cut each other"), "{cut}");
    assert!(!said("builtin:cube").contains("warning") && !said("interpenetration --quiet").contains("warning"));
    let refused = folder.run("render teapot --depth-bits 20 -o out.png");
    assert!(refused.err.contains("`--depth-bits` is 20: expected 16, 24 or 32"), "{}", refused.err);
}

/// Supersampling keeps the picture's size; a picture of depths is one of single samples.
#[test]
fn supersampled_pictures_have_the_size_of_the_scene() {
    let plain = sphere("");
    let smooth = sphere("--samples 4");
    assert_eq!((smooth.width(), smooth.height()), (plain.width(), plain.height()));
    let partly = |picture: &Picture8| picture.texels().iter().filter(|t| t[3] > 0 && t[3] < 255).count();
    assert!(partly(&smooth) > 50 && partly(&plain) == 0);
    assert!(sphere("--samples 4 -m reference") != sphere("-m reference"));
    assert!(sphere("--samples 1") == plain);
    let folder = Folder::new();
    for aov in ["depth", "normal", "polygon"] {
        folder.run(&format!("render builtin:torus --size 64x48 --aov {aov} -o plain.png")).done();
        folder
            .run(&format!("render builtin:torus --size 64x48 --aov {aov} --samples 2 -o out.png"))
            .done()
            .says("--aov shows single samples");
        assert!(picture(&folder.path("plain.png")) == picture(&folder.path("out.png")), "{aov}");
    }
    let refused = folder.run("render teapot --size 8000x10 --samples 4 -o out.png");
    assert!(refused.err.contains("`--samples` is 4: expected at most 16384 samples a side"), "{}", refused.err);
}

/// Without clipping, a polygon with a corner at the plane of the eye is left out, said and counted.
#[test]
fn polygons_without_a_place_are_told_of() {
    let folder = Folder::new();
    folder.write("ground.obj", "v -1 0 0\nv 1 0 0\nv 0 0 -5\nv -1 0 -2\nv 1 0 -2\nv 0 0 -5\nf 1 2 3\nf 4 5 6\n");
    let flags = "--eye 0,1,0 --target 0,1,-1 --fovy 60 --near 0.1 --far 9 --cull none --stats -o out.png";
    let ended = folder.run(&format!("render ground.obj {flags} --clipping ndc-cube")).done();
    ended.says("warning: 1 polygon has a corner at the plane of the eye and is left out");
    folder
        .run("render perspective --clipping ndc-cube -o out.png")
        .says("`--clipping` and `interpolation` exclude each other");
}
