//! `fastphong render`: flags that change the picture, and invalid flags.

use super::{Folder, covered, picture, rendered, sphere};

/// Each flag changes the picture, unless its value is the scene's own.
#[test]
fn flags_change_the_picture() {
    let plain = sphere("");
    for same in [
        "--light 0.4,0.7,0.9",
        "--ambient 1",
        "--ks 0.4",
        "--shininess 32",
        "--cull back",
        "--fit 0.8",
    ] {
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
    // Flags about positional lights change a picture whose light also shines on the back of the
    // sphere.
    let near = "--fovy 40 --light-at 2,1,-0.5 --light-at 1,2,3,0.5";
    let lit = sphere(near);
    assert!(lit != sphere("--fovy 40 --light 2,1,-0.5 --light 1,2,3,0.5"));
    for same in [
        "--attenuation 0",
        "--viewer infinite",
        "--specular phong",
        "--specular-gate gated",
    ] {
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
    assert!(
        sphere("--cull front --two-sided") != sphere("--cull front")
            && sphere("--clipping planes") == plain
    );
    assert!(rendered("z-fighting --near 21 --clipping ndc-cube") != rendered("z-fighting"));
    assert!(rendered("z-fighting --depth-bits 24") != rendered("z-fighting"));
    assert!(rendered("z-fighting --depth per-sample") != rendered("z-fighting"));
    assert!(
        rendered("perspective --size 64x48")
            != rendered("perspective --size 64x48 --interpolation screen")
    );
    assert!(sphere("--normals averaged") == plain);
}

#[test]
fn view_zero_looks_along_z_and_azimuth_turns_toward_x() {
    for (view, eye) in [
        ("0,0", "0,0,4"),
        ("90,0", "4,0,0"),
        ("0,90", "0,4,0"),
        ("-45,0", "-3,0,3"),
    ] {
        let up = if view == "0,90" { " --up 0,0,-1" } else { "" };
        let turned = rendered(&format!(
            "builtin:gear --alpha coverage --samples 1 --size 64x48 --fit 0.7 --view {view}"
        ));
        let placed = rendered(&format!(
            "builtin:gear --alpha coverage --samples 1 --size 64x48 --fit 0.7 --eye {eye}{up}"
        ));
        // The two directions differ by the rounding of a sine. Screen positions move by less than
        // 1/256 pixel, which can change a pixel of the rim.
        let differing = turned
            .pixels()
            .iter()
            .zip(placed.pixels())
            .filter(|(a, b)| a[3] != b[3])
            .count();
        assert!(differing <= 2, "{view}: {differing} pixels");
    }
}

#[test]
fn material_flags_override_every_material() {
    let folder = Folder::new();
    let black = "--ka 0 --kd 0 --ks 0 --size 64x48 -o out.png";
    for (input, replaces) in [
        ("four-lights", false),
        ("perspective", false),
        ("vase", true),
    ] {
        let ended = folder
            .run(&format!("render {input} --background 1 {black}"))
            .done();
        assert_eq!(
            ended.err.contains("replaces those of the mesh file"),
            replaces,
            "{input}: {}",
            ended.err
        );
        let drawn = picture(&folder.path("out.png"));
        assert!(
            drawn
                .pixels()
                .iter()
                .all(|pixel| pixel[3] == 0 || pixel[..3] == [0; 3]),
            "{input}"
        );
    }
}

#[test]
fn without_lights_only_ambient_light_remains() {
    let drawn = sphere("--no-lights --ambient 1 --ka 0.2,0.4,0.6");
    // The stored level is round(255 k_a).
    assert!(
        drawn
            .pixels()
            .iter()
            .all(|pixel| pixel[3] == 0 || *pixel == [51, 102, 153, 255])
    );
    assert!(covered(&drawn) > 300);
}

#[test]
fn invalid_flags_are_rejected_by_name() {
    let folder = Folder::new();
    for (flags, parts) in [
        (
            "-m fast-fong",
            &["unknown method `fast-fong`: did you mean `fast-phong`?"][..],
        ),
        ("-m refrence", &["did you mean `reference`?"]),
        (
            "-m reference:model=fong",
            &["unknown closed form `fong`: expected one of `flat`"],
        ),
        (
            "-m reference:model=phung",
            &["unknown closed form `phung`: did you mean `phong`?"],
        ),
        (
            "-m fast-phong:steps=9",
            &["`steps=9`: expected `auto` or a whole number from 1 to 8"],
        ),
        (
            "-m fast-phong:steps=0",
            &["`steps=0`: expected `auto` or a whole number from 1 to 8"],
        ),
        ("-m flat:steps=1", &["method `flat` has no parameters"]),
        ("--engine barycentrik", &["did you mean `barycentric`?"]),
        (
            "--engine barycentric:edges=open",
            &["expected edges=top-left or edges=closed"],
        ),
        ("--engine cs172", &["did you mean `cs171`?"]),
        (
            "--engine cs171:normals=raw",
            &["expected normals=unit or normals=as-printed"],
        ),
        ("--size 0x0", &["`--resolution` is 0: expected 1 to 16384"]),
        (
            "--size 20000x10",
            &["`--resolution` is 20000: expected 1 to 16384"],
        ),
        ("--size 64", &["expected WIDTHxHEIGHT"]),
        (
            "--fovy 200",
            &["`--fovy` is 200: expected degrees over 0 and under 180"],
        ),
        (
            "--fovy 40 --half-height 1",
            &["`--fovy` and `--half-height` exclude each other"],
        ),
        (
            "--view 0,91",
            &["`--view` is 91: expected degrees between -90 and 90"],
        ),
        ("--view 0", &["expected two numbers azimuth,elevation"]),
        (
            "--view 0,0 --eye 1,2,3",
            &["`--view` and `--eye` exclude each other"],
        ),
        (
            "--eye 0,0,0",
            &["`--eye` is the point that the camera looks at"],
        ),
        ("--eye 0,0,NaN", &["`--eye`", "NaN"]),
        ("--eye 1,2", &["expected three numbers x,y,z"]),
        (
            "--target 1,0,0",
            &["`--target` exclude each other: expected a place (`eye`, `target`) or a direction"],
        ),
        (
            "--near 5 --far 1",
            &["`--far` is 1: expected more than near = 5"],
        ),
        ("--light 0,0,0", &["`--light` has no length"]),
        (
            "--light 1,0,0,-1",
            &["`--light` is -1: expected 0 or more, up to 3.4e38"],
        ),
        ("--light 1,0", &["expected a direction x,y,z"]),
        ("--light 1,0,0 --no-lights", &["cannot be used with"]),
        ("--light-at 0,0", &["expected a position x,y,z"]),
        (
            "--light-at 0,0,NaN",
            &["`--light-at` has z = NaN: expected numbers between"],
        ),
        (
            "--light-at 0,0,5,-1",
            &["`--light-at` is -1: expected 0 or more, up to 3.4e38"],
        ),
        ("--light-at 0,0,5 --no-lights", &["cannot be used with"]),
        (
            "--light-at 1,1,1",
            &["`--light-at` is at a vertex, (1, 1, 1): expected a place off the vertices"],
        ),
        (
            "--light-at 0,0,5 --attenuation -2",
            &["`--attenuation` is -2: expected 0 or more, up to 3.4e38"],
        ),
        (
            "--light-at 0,0,5 --attenuation NaN",
            &["`--attenuation` is NaN: expected 0 or more, up to 3.4e38"],
        ),
        (
            "--attenuation 1",
            &["required arguments were not provided", "--light-at"],
        ),
        (
            "--falloff inverse",
            &["required arguments were not provided", "--light-at"],
        ),
        (
            "--no-lights --attenuation 1",
            &["'--no-lights' cannot be used with '--attenuation"],
        ),
        (
            "--square 2 --engine span",
            &["'--square <UNITS>' cannot be used with '--engine"],
        ),
        (
            "--square 2 --aov depth",
            &["`--square` is for squares, not for `--aov depth`"],
        ),
        ("--light-at 0,0,5 --falloff inverses", &["inverse-square"]),
        (
            "--light-at 0,0,5 --falloff inverse --attenuation 1",
            &["exclude each other"],
        ),
        (
            "--light 1,0,0 --attenuation 1",
            &["required arguments were not provided", "--light-at"],
        ),
        (
            "--viewer lokal",
            &["invalid value 'lokal'", "infinite, local", "'local'"],
        ),
        ("--specular blin", &["phong, blinn", "'blinn'"]),
        ("--shininess-for fong", &["phong, blinn", "'phong'"]),
        ("--specular-gate open", &["gated, ungated, weighted"]),
        ("--up 0,0,0", &["`--up` has no length"]),
        (
            "--eye 0,0,5 --up 0,0,1",
            &["`--up` is parallel to the line of sight"],
        ),
        (
            "--fovy 0",
            &["`--fovy` is 0: expected degrees over 0 and under 180"],
        ),
        (
            "--near 3 --far 3",
            &["`--far` is 3: expected more than near = 3"],
        ),
        (
            "--ks -1",
            &["`--ks` is -1: expected 0 or more, up to 3.4e38"],
        ),
        ("--kd 1,2", &["expected one number, or three r,g,b"]),
        (
            "--shininess -2",
            &["`--shininess` is -2: expected 0 or more, up to 3.4e38"],
        ),
        ("--background 2", &["`--background` is 2: expected 0 to 1"]),
        (
            "--normals crease=200",
            &["`--normals` is 200: expected degrees between 0 and 180"],
        ),
        (
            "--normals smooth",
            &["expected `auto`, `averaged`, `given` or `crease=DEGREES`"],
        ),
        (
            "--cull left",
            &["invalid value 'left'", "back, front, none"],
        ),
        ("--encoding gamma", &["linear, srgb"]),
        ("--fit 0", &["`--fit` is 0"]),
        (
            "--veiw 1,2",
            &[
                "unexpected argument '--veiw'",
                "similar argument exists: '--view'",
            ],
        ),
    ] {
        folder
            .run(&format!("render builtin:cube {flags} -o out.png"))
            .refused(parts);
        assert!(
            folder.names().is_empty(),
            "{flags} left {:?}",
            folder.names()
        );
    }
    folder
        .run("render builtin:cube")
        .refused(&["--output <FILE>"]);
    folder.run("render").refused(&["<INPUT>"]);
    folder
        .run("rendr builtin:cube")
        .refused(&["unrecognized subcommand 'rendr'", "render"]);
    folder
        .run("render builtin:cube -v -q -o out.png")
        .refused(&["cannot be used with"]);
}

/// Messages state true ranges: a number within the range is accepted. They show the number as it
/// was typed.
#[test]
fn ranges_in_messages_are_true_and_large_numbers_have_exponents() {
    let folder = Folder::new();
    for (command, expected) in [
        (
            "render builtin:cube --shininess inf -o out.png",
            "`--shininess` is inf: expected 0 or more, up to 3.4e38",
        ),
        (
            "render builtin:cube --ambient 1e39 -o out.png",
            "`--ambient` is 1e39: expected 0 or more, up to 3.4e38",
        ),
        (
            "render builtin:cube --light 1,0,0,1e39 -o out.png",
            "`--light` is 1e39: expected 0 or more, up to 3.4e38",
        ),
        (
            "render builtin:cube --far 1e300 -o out.png",
            "`--far` is 1e300: expected numbers between -1e20 and 1e20",
        ),
        (
            "render builtin:cube --fovy 30 --near 1e30 -o out.png",
            "`--near` is 1e30: expected a number over 0 (up to 1e20)",
        ),
        (
            "render builtin:cube --half-height 1e300 -o out.png",
            "`--half-height` is 1e300: expected a number over 0 (1e-100 to 1e100)",
        ),
        (
            "render builtin:cube --samples 99999999999999999999 -o out.png",
            "expected a whole number of up to 18 digits",
        ),
        (
            "render builtin:cube --resolution 99999999999999999999x1 -o out.png",
            "expected WIDTHxHEIGHT, 1 to 16384 each",
        ),
        (
            "render builtin:cube --aov checkerboard --square 1e300 -o out.png",
            "expected a length in world units: a number over 0 (1e-15 to 1e15)",
        ),
        (
            "compare builtin:cube --time-budget 1e300",
            "expected seconds: a number from 0 to 1000000",
        ),
        (
            "diff a.png b.png -o map.png --scale 1e300",
            "expected grey levels: a number over 0 (1e-6 to 1e6)",
        ),
    ] {
        folder.run(command).refused(&[expected]);
    }
    for flags in ["--shininess 3.3e38", "--half-height 1e-90 --cull none"] {
        folder
            .run(&format!(
                "render builtin:cube --size 4x4 {flags} -o out.png"
            ))
            .done();
    }
}
