//! `fastphong render`: engines, instruction sets and threads.

use super::{Folder, SPHERE, methods_on_sphere, rendered, sphere};
use fastphong::compare::metrics::compare;
use fastphong::number::SimdLevel;
use fastphong::scene::input;
use fastphong::shading::Variant;

#[test]
fn engines_agree_and_report_their_work() {
    let folder = Folder::new();
    let run = |engine: &str, name: &str| {
        folder
            .run(&format!(
                "render {SPHERE} -m flat --engine {engine} -o {name}"
            ))
            .done()
    };
    run("auto", "a.png");
    run("span", "b.png");
    run("barycentric", "c.png")
        .says("16 polygons of more than three corners are cut into triangles");
    run("barycentric:edges=top-left", "d.png");
    run("barycentric:edges=closed", "e.png");
    // Flat shading has one colour per polygon, so the engines agree to the last bit.
    for name in ["b.png", "c.png", "d.png"] {
        assert_eq!(folder.read(name), folder.read("a.png"), "{name}");
    }
    let refused = |method: &str| {
        folder.run(&format!(
            "render {SPHERE} -m {method} --engine barycentric -o out.png"
        ))
    };
    let has = "expected one of flat, flat-average, gouraud, gouraud-separate, naive-phong";
    refused("fast-phong").refused(&[
        "the barycentric renderer does not support the method `fast-phong`",
        has,
    ]);
    refused("reference").refused(&[
        "the barycentric renderer does not support the method `reference`",
        has,
    ]);
}

/// CS171's algorithms draw the pictures of the corresponding methods. With normals as printed they
/// draw a different picture.
#[test]
fn cs171_draws_what_the_engines_draw() {
    let folder = Folder::new();
    for method in ["flat-average", "gouraud", "naive-phong"] {
        folder
            .run(&format!(
                "render {SPHERE} -m {method} --engine barycentric -o a.png"
            ))
            .done();
        // Rounding of an f32 may change a channel by one level.
        let flags = "--engine cs171 --reference a.png --reference-threshold 1";
        let done = folder
            .run(&format!("render {SPHERE} -m {method} {flags} -o b.png"))
            .done();
        done.says("16 polygons of more than three corners are cut into triangles for CS171");
    }
    folder
        .run(&format!(
            "render {SPHERE} -m naive-phong --engine cs171:normals=unit -o c.png"
        ))
        .done();
    folder
        .run(&format!(
            "render {SPHERE} -m naive-phong --engine cs171:normals=as-printed -o d.png"
        ))
        .done();
    assert_eq!(folder.read("b.png"), folder.read("c.png"));
    assert_ne!(folder.read("c.png"), folder.read("d.png"));
    let refused = |method: &str| {
        folder.run(&format!(
            "render {SPHERE} -m {method} --engine cs171 -o out.png"
        ))
    };
    let has = "expected one of flat-average, gouraud, naive-phong";
    refused("flat").refused(&["CS171 does not support the method `flat`", has]);
    refused("reference").refused(&["CS171 does not support the method `reference`", has]);
}

#[test]
fn polygons_that_cross_themselves_are_reported() {
    let folder = Folder::new();
    folder.write(
        "bow.obj",
        "v 0 0 0\nv 2 2 0\nv 2 1 0\nv 0 2 0\nv 0 -1 0\nv 1 -1 0\nv 0 -2 0\nf 1 2 3 4\nf 5 7 6\n",
    );
    let flags = "--cull none --size 64x48 -m flat -o out.png";
    folder
        .run(&format!("render bow.obj --engine barycentric {flags}"))
        .done()
        .says("warning: 1 polygon crosses or overlaps itself and is left out");
}

/// `--engine span` draws the library's default picture.
#[test]
fn the_scalar_span_engine_can_be_requested() {
    let file = input::load("builtin:sphere?rings=6&segments=8").unwrap();
    let mut scene = input::resolve(&file).unwrap().scene;
    (scene.width, scene.height) = (64, 48);
    let frame = scene.frame().unwrap();
    for method in methods_on_sphere() {
        let method = method.info.name;
        let expected = Variant::parse(method)
            .unwrap()
            .render(&frame)
            .expect("a method for the frame");
        let flags = format!("-m {method} --engine span --simd scalar");
        assert!(sphere(&flags) == expected, "{flags}");
    }
}

/// The row engine draws the span engine's picture within rounding, on every instruction set.
#[test]
fn instruction_sets_draw_the_span_engines_picture() {
    for method in methods_on_sphere() {
        let method = method.info.name;
        let lecture = sphere(&format!("-m {method} --engine span --simd scalar"));
        assert!(sphere(&format!("-m {method} --engine span")) == lecture);
        assert!(sphere(&format!("-m {method} --simd scalar")) == lecture);
        for level in simd() {
            let other = sphere(&format!("-m {method} --engine row --simd {level}"));
            assert!(sphere(&format!("-m {method} --simd {level}")) == other);
            let difference = compare(&lecture, &other).unwrap();
            // At 64 columns and 48 rows each picture is off its closed form by less than a tenth of
            // a level (`Variant::bound`). A method that follows Newton's root is off by up to a
            // quarter (`Newton::LARGEST_ERROR`). So stored values differ by at most one level.
            assert!(
                255.0 * difference.max <= 1.0,
                "{method}, {level}: {difference:?}"
            );
            assert_eq!(difference.coverage_mismatches, 0, "{method}, {level}");
        }
    }
}

/// Returns the SIMD instruction sets of this machine.
fn simd() -> impl Iterator<Item = SimdLevel> {
    SimdLevel::available().filter(|level| *level != SimdLevel::Scalar)
}

/// The span engine is scalar and the row engine SIMD. Any other combination is one error that names
/// valid flags.
#[test]
fn mismatched_engines_and_instruction_sets_are_rejected() {
    let folder = Folder::new();
    for command in [
        &*format!("render {SPHERE} -o out.png"),
        "compare figure5",
        "bench figure5",
        "report figure5",
    ] {
        let refused = |flags: &str, parts: &[&str]| {
            let ended = folder.run(&format!("{command} {flags}"));
            assert_eq!(ended.err.matches("error").count(), 1, "{}", ended.err);
            ended.refused(parts);
        };
        refused(
            "--engine row --simd scalar",
            &[
                "the row engine runs on SIMD",
                "`--engine span --simd scalar` for one pixel at a time, or `--simd auto`",
            ],
        );
        refused("--simd sse9", &["unknown instruction set `sse9`", "`auto`"]);
        for level in simd() {
            refused(
                &format!("--engine span --simd {level}"),
                &[
                    "the span engine goes one pixel at a time",
                    &format!("use `--engine row --simd {level}`, or `--engine span --simd scalar`"),
                ],
            );
        }
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn threads_change_no_byte() {
    for flags in ["", "--engine span", "--depth-bits 16", "--samples 4"] {
        let one = rendered(&format!("teapot --size 160x120 {flags} --threads 1"));
        for threads in [2, 3, 7] {
            let several = rendered(&format!(
                "teapot --size 160x120 {flags} --threads {threads}"
            ));
            assert!(several == one, "{flags} --threads {threads}");
        }
    }
}

#[test]
fn verbose_names_the_engine() {
    let folder = Folder::new();
    // Name the instruction set that `auto` chooses.
    let best = SimdLevel::best();
    if best == SimdLevel::Scalar {
        return;
    }
    let run = |flags: &str| {
        folder
            .run(&format!("render {SPHERE} {flags} -o out.png"))
            .done()
    };
    for (flags, line) in [
        (
            "--threads 2",
            format!("drawn by the row engine, {best}, 2 threads\n"),
        ),
        (
            "--engine row --threads 3",
            format!("drawn by the row engine, {best}, 3 threads\n"),
        ),
        (
            "--depth-bits 16 --threads 1",
            format!("drawn by the row engine, {best}, 1 thread\n"),
        ),
        (
            "--engine span",
            "drawn by the span engine, scalar, 1 thread\n".into(),
        ),
        (
            "--simd scalar",
            "drawn by the span engine, scalar, 1 thread\n".into(),
        ),
        (
            "--engine barycentric -m flat",
            "drawn by the barycentric engine, scalar, 1 thread\n".into(),
        ),
        (
            "--engine cs171 -m gouraud",
            "drawn by the cs171 engine, f64, 1 thread\n".into(),
        ),
        (
            "-m reference",
            "drawn by the reference, f64, 1 thread\n".into(),
        ),
        (
            "--aov depth",
            "drawn by the span engine, scalar, 1 thread\n".into(),
        ),
    ] {
        run(&format!("{flags} --verbose")).says(&line);
        assert!(
            !run(flags).err.contains("drawn by"),
            "{flags}: only where it is asked for"
        );
    }
}

/// A change of engine is reported with its reason. If the user asked for the engine, it is always
/// reported, otherwise only with `--verbose`.
#[test]
fn a_change_of_engine_is_reported_with_its_reason() {
    let folder = Folder::new();
    let run = |flags: &str| {
        folder
            .run(&format!("render {SPHERE} {flags} -o out.png"))
            .done()
    };
    for (flags, reason) in [
        (
            "--depth per-sample",
            "the row engine interpolates depth and does not compute it per sample",
        ),
        (
            "--clipping ndc-cube",
            "the row engine does not test samples against the NDC cube",
        ),
    ] {
        let reason = format!("drawn by the span engine, scalar, 1 thread: {reason}");
        assert!(!run(flags).err.contains("drawn by"), "{flags}");
        assert!(
            !run(&format!("{flags} --engine span --verbose"))
                .err
                .contains(&reason),
            "{flags}: as asked for"
        );
        for level in simd() {
            run(&format!("{flags} --verbose")).says(&reason);
            run(&format!("{flags} --engine row")).says(&reason);
            run(&format!("{flags} --simd {level}")).says(&reason);
            assert_eq!(run(&format!("{flags} --engine row --quiet")).err, "");
        }
    }
}

/// Single-threaded scalar renderers reject an instruction set and report that threads do not help.
#[test]
fn scalar_renderers_reject_instruction_sets() {
    let folder = Folder::new();
    for (flags, what) in [
        ("--engine barycentric -m flat", "the barycentric renderer"),
        ("--engine cs171 -m gouraud", "CS171"),
        ("-m reference", "the reference"),
    ] {
        for level in simd() {
            let refused = folder.run(&format!(
                "render {SPHERE} {flags} --simd {level} -o out.png"
            ));
            refused.refused(&[
                what,
                &format!("has no `{level}`: expected --simd auto or scalar"),
            ]);
        }
        for simd in ["auto", "scalar"] {
            folder
                .run(&format!("render {SPHERE} {flags} --simd {simd} -o out.png"))
                .done();
        }
        let noted = "--threads 2 does not apply to the pixels: drawn by ";
        folder
            .run(&format!("render {SPHERE} {flags} --threads 2 -o out.png"))
            .done()
            .says(noted);
    }
    for engine in ["span", "row"] {
        let refused = folder.run(&format!(
            "render {SPHERE} -m reference --engine {engine} -o out.png"
        ));
        refused.refused(&["`reference` is not drawn by the"]);
    }
    folder
        .run(&format!(
            "render {SPHERE} --aov depth --simd scalar -o out.png"
        ))
        .refused(&["cannot be used with"]);
}

/// An unknown engine, instruction set or thread count is one error, which lists the valid ones.
#[test]
fn unknown_engines_levels_and_threads_are_rejected_by_name() {
    let folder = Folder::new();
    let expected_level = "`scalar`";
    for command in [
        &*format!("render {SPHERE} -o out.png"),
        "compare figure5",
        "bench figure5",
        "report figure5",
    ] {
        let is_render = command.starts_with("render");
        for (flags, part) in [
            ("--engine rows", "did you mean `row`?"),
            (
                "--engine nonsense",
                "unknown engine `nonsense`: expected one of `auto`, `span`",
            ),
            (
                "--simd axv2",
                "unknown instruction set `axv2`: did you mean `avx2`?",
            ),
            ("--simd altivec", expected_level),
            ("--threads 0", "expected a number of threads from 1 to 1024"),
            (
                "--threads 1025",
                "expected a number of threads from 1 to 1024",
            ),
            (
                "--threads -1",
                "expected a number of threads from 1 to 1024",
            ),
            (
                "--threads many",
                "expected a number of threads from 1 to 1024",
            ),
        ] {
            folder.run(&format!("{command} {flags}")).refused(&[part]);
        }
        for level in SimdLevel::ALL
            .into_iter()
            .filter(|level| !level.is_available())
        {
            let said = format!("this machine does not have `{level}`: expected ");
            folder
                .run(&format!("{command} --simd {level}"))
                .refused(&[&said]);
        }
        if !is_render {
            folder
                .run(&format!("{command} --engine barycentric"))
                .refused(&["every comparison includes it already"]);
        }
    }
    folder
        .run(&format!("render {SPHERE} --engine row:planes=2 -o out.png"))
        .refused(&["`row` has no parameters"]);
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}
