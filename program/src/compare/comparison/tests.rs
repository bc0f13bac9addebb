use super::*;
use crate::compare::timing::Ratio;
use alloc::borrow::ToOwned;
use alloc::{format, vec};
use core::time::Duration;
use fastphong::compare::metrics;
use fastphong::frame::{FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::Material;
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::reference::{self, Model};
use fastphong::scene::{Camera, Fit, Light, Lighting, Object, Scene};
use fastphong::shading::walks::NewtonSteps;
use glam::DVec3;

/// Returns a frame of a built-in mesh under one light, filling 48 × 36 pixels.
fn frame_of(mesh: &str) -> Frame {
    let mesh = builtin(mesh).unwrap();
    let direction = DVec3::new(0.3, 0.5, 1.0);
    let mut fit = Fit::new(direction, 4.0 / 3.0);
    fit.fraction = 0.9;
    let camera = Camera::fit(mesh.positions().iter().map(|p| p.as_dvec3()), &fit).unwrap();
    let to_light = DVec3::new(1.0, 1.0, 2.0).normalize();
    let mut object = Object::new(mesh);
    object.normals = NormalSource::Averaged.into();
    let mut scene = Scene::new(camera);
    (scene.width, scene.height) = (48, 36);
    scene.background = [0.1, 0.2, 0.3];
    scene.lights = vec![Light::directional(to_light, [1.0; 3])];
    scene.objects = vec![object];
    scene.frame().unwrap()
}

/// Returns the methods that compute in floats: those in integers err by design, and are not for
/// every frame.
fn all() -> Vec<Variant> {
    let floats = METHODS.iter().filter(|entry| !entry.is_integer);
    floats.map(|entry| entry.variant()).collect()
}

fn errors_only(frame: &Frame, variants: &[Variant]) -> Comparison {
    compare(
        &Input {
            name: "test".into(),
            frame,
        },
        variants,
        Renderer::LECTURE,
        None,
        &mut |_, _| {},
    )
}

/// Returns limits of five rounds, for a quick comparison with times.
fn quick() -> Option<TimeLimits> {
    Some(TimeLimits {
        time_budget: Duration::ZERO,
        rounds: 5,
        warm_up_rounds: 1,
    })
}

fn named<'a>(rows: &'a [MethodRow], name: &str) -> &'a MethodRow {
    rows.iter().find(|row| row.name() == name).unwrap()
}

#[test]
fn every_method_has_its_row_and_the_barycentric_renderer_its_own() {
    let frame = frame_of("sphere?rings=6&segments=12");
    let variants: Vec<_> = METHODS.iter().map(|entry| entry.variant()).collect();
    let comparison = errors_only(&frame, &variants);
    let names = |rows: &[MethodRow]| rows.iter().map(MethodRow::name).collect::<Vec<_>>();
    let all = METHODS.iter().map(|e| String::from(e.info.name));
    let left_out: Vec<_> = comparison
        .left_out
        .iter()
        .map(|left| left.variant.clone())
        .collect();
    // Some are for frames of other highlights only.
    assert!((1..=6).contains(&left_out.len()), "{left_out:?}");
    let drawn = all.filter(|name| !left_out.contains(name));
    assert_eq!(names(&comparison.rows), drawn.collect::<Vec<_>>());
    let in_barycentric = METHODS.iter().filter(|e| e.is_barycentric());
    assert_eq!(
        names(&comparison.barycentric),
        in_barycentric
            .map(|e| String::from(e.info.name))
            .collect::<Vec<_>>()
    );
    assert!(
        comparison
            .rows
            .iter()
            .all(|row| row.drawn_by.engine == "span" && row.speed.is_none())
    );
    assert!(
        comparison
            .barycentric
            .iter()
            .all(|row| row.drawn_by == DrawnBy::BARYCENTRIC)
    );
    assert!(
        counterpart(&Variant::parse(BASELINE).unwrap()) == BASELINE,
        "what ratios fall back on exists"
    );
}

#[test]
fn naive_phong_is_added_only_where_it_is_missing() {
    let frame = frame_of("triangle");
    let names = |variants: &[&str]| {
        let variants: Vec<_> = variants
            .iter()
            .map(|text| Variant::parse(text).unwrap())
            .collect();
        errors_only(&frame, &variants)
            .rows
            .iter()
            .map(MethodRow::name)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        names(&["fast-phong:steps=1", "flat"]),
        ["naive-phong", "fast-phong:steps=1", "flat"]
    );
    assert_eq!(
        names(&["flat", "naive-phong", "flat"]),
        ["flat", "naive-phong", "flat"]
    );
    assert_eq!(names(&[]), ["naive-phong"]);
}

#[test]
fn frame_counts_agree_with_hand_counts() {
    // A square of 6 × 4 pixels has a triangle with legs of 4 pixels in front of one corner. It
    // covers the centres with x + y < 4, counted from its corner in halves: 3 + 2 + 1, and 4 on the
    // hypotenuse, which the top-left rule excludes.
    let mut builder = FrameBuilder::new(10, 8);
    let light = Light::directional(DVec3::Z, [1.0; 3]);
    let material = builder.lighting(Lighting::new(
        &Material::default(),
        [1.0; 3],
        &[light],
        DVec3::Z,
    ));
    let mut polygon = |places: &[(i32, i32)], depth| {
        let corners: Vec<u32> = places
            .iter()
            .map(|&(x, y)| {
                let (x, y) = (SubPixel::from_num(x), SubPixel::from_num(y));
                builder.vertex(Vertex {
                    x,
                    y,
                    depth,
                    inv_w: 1.0,
                    normal: [0.0, 0.0, 1.0],
                    material,
                })
            })
            .collect();
        builder.polygon(&corners, [0.0, 0.0, 1.0], 0);
    };
    polygon(&[(1, 1), (7, 1), (7, 5), (1, 5)], 0.5);
    polygon(&[(1, 1), (5, 1), (1, 5)], 0.25);
    // A bow tie of 2 × 2 pixels in two triangles. It strictly covers no centre but those on its
    // slopes.
    polygon(&[(8, 2), (10, 4), (10, 2), (8, 4)], 0.5);
    let frame = builder.finish().unwrap();
    let comparison = errors_only(&frame, &all());
    assert_eq!(
        (comparison.polygons, comparison.triangles, comparison.lights),
        (3, 5, 1)
    );
    let bow_tie = comparison.covered_pixels - 6 * 4;
    assert!((1..=4).contains(&bow_tie), "{bow_tie} pixels");
    assert_eq!(comparison.fragments - comparison.covered_pixels, 6);
    assert_eq!(comparison.not_simple, 1);
    assert!(comparison.rows.iter().all(|row| row.other_polygon == 0));
    assert!(
        comparison
            .barycentric
            .iter()
            .all(|row| row.other_polygon == bow_tie),
        "the bow tie is not drawn"
    );
    // All normals are equal, so every method computes one colour, except for rounding. Slerped and
    // stepped values add at most as many roundings as there are pixels and scanlines, 16 of 2⁻²⁴.
    // The power 32 multiplies them by 32: 3.1e-5.
    for row in comparison.all_rows() {
        assert!(row.error.max <= 3.1e-5, "{} {}", row.name(), row.error.max);
    }
}

#[test]
fn rows_are_within_the_bound_of_their_closed_form() {
    // Use the most Newton steps, because short spans over large angles need more than the default.
    let with_all_steps =
        |variant: Variant| match variant.info().parameters.iter().find(|p| p.name == "steps") {
            Some(_) => Variant::parse(&alloc::format!(
                "{}:steps={}",
                variant.info().name,
                NewtonSteps::MOST
            ))
            .unwrap(),
            None => variant,
        };
    let variants: Vec<_> = all().into_iter().map(with_all_steps).collect();
    for mesh in ["sphere?rings=6&segments=12", "prism"] {
        let frame = frame_of(mesh);
        let comparison = errors_only(&frame, &variants);
        for row in comparison.all_rows() {
            assert!(
                row.within_bound,
                "{mesh}, {} {:?}: {}",
                row.name(),
                row.drawn_by,
                row.own.max
            );
        }
        let naive = named(&comparison.rows, BASELINE);
        assert_eq!(naive.own, naive.error, "it means to be the reference");
        let gouraud = named(&comparison.rows, "gouraud");
        assert!(
            gouraud.error.max > 10.0 * gouraud.own.max,
            "it is not Phong shading: {:?}",
            gouraud.error
        );
    }
}

#[test]
fn the_bound_of_a_row_is_that_of_the_frame_it_is_drawn_from() {
    let frame = frame_of("prism");
    let comparison = errors_only(&frame, &all());
    let cut = triangulated(&frame).frame;
    let mut differing = 0;
    for row in &comparison.barycentric {
        assert_eq!(row.bound, row.variant.bound(&cut), "{}", row.name());
        differing += usize::from(row.bound != row.variant.bound(&frame));
    }
    assert!(differing > 0, "triangles have bounds of their own");
    for row in &comparison.rows {
        assert_eq!(row.bound, row.variant.bound(&frame), "{}", row.name());
    }
}

#[test]
fn a_comparison_without_times_is_the_same_at_every_run() {
    let frame = frame_of("sphere?rings=6&segments=12");
    let json = || serde_json::to_string(&errors_only(&frame, &all())).unwrap();
    assert_eq!(json(), json());
}

#[test]
fn nothing_drawn_is_no_difference() {
    let frame = FrameBuilder::new(16, 16).finish().unwrap();
    let comparison = compare(
        &Input {
            name: "empty".into(),
            frame: &frame,
        },
        &all(),
        Renderer::LECTURE,
        quick(),
        &mut |_, _| {},
    );
    assert_eq!((comparison.covered_pixels, comparison.fragments), (0, 0));
    for row in comparison.all_rows() {
        assert!(row.error.equal && row.own.equal, "{}", row.name());
        let speed = row.speed.as_ref().unwrap();
        assert_eq!(speed.ns_per_covered_pixel, None);
    }
    assert!(comparison.rows[0].error.equal);
    let json = serde_json::to_string(&comparison).unwrap();
    assert!(json.contains("\"psnr\":null"));
    assert!(table(&comparison, TableKind::Compare).contains("equal"));
}

#[test]
fn speeds_belong_to_their_rows() {
    let frame = frame_of("sphere?rings=6&segments=12");
    let mut told = vec![];
    let input = Input {
        name: "sphere".into(),
        frame: &frame,
    };
    let comparison = compare(
        &input,
        &all(),
        Renderer::LECTURE,
        quick(),
        &mut |part, what| told.push((part, String::from(what))),
    );
    for row in comparison.all_rows() {
        let speed = row.speed.as_ref().unwrap();
        let timing = &speed.timing;
        let samples = timing.samples_ns.len();
        assert!(
            samples.is_multiple_of(timing.samples_per_round),
            "{samples}"
        );
        assert_eq!(
            samples / timing.samples_per_round,
            comparison.noise.as_ref().unwrap().rounds
        );
        let per_pixel = speed.ns_per_covered_pixel.unwrap();
        assert_eq!(
            per_pixel,
            speed.timing.typical_ns / comparison.covered_pixels as f64
        );
        assert!(speed.ratio_to_naive.is_some() && speed.ratio_to_barycentric.is_some());
    }
    let one =
        |ratio: Option<Ratio>| ratio.map(|r| (r.low, r.typical, r.high)) == Some((1.0, 1.0, 1.0));
    let of = |row: &MethodRow| row.speed.clone().unwrap();
    assert!(one(of(named(&comparison.rows, BASELINE)).ratio_to_naive));
    for row in &comparison.barycentric {
        assert!(one(of(row).ratio_to_barycentric), "{}", row.name());
    }
    // A method that takes less time has a ratio over 1.
    let naive = of(named(&comparison.rows, BASELINE)).timing.typical_ns;
    for row in comparison.all_rows() {
        let speed = of(row);
        let ratio = speed.ratio_to_naive.unwrap();
        let quotient = naive / speed.timing.typical_ns;
        // Both divide the same times, rounded in another order.
        assert!(
            (ratio.typical / quotient - 1.0).abs() < 1e-12,
            "{}",
            row.name()
        );
        assert!(ratio.low < ratio.high || one(Some(ratio)), "{ratio:?}");
    }
    assert!(told.is_sorted_by(|a, b| a.0 <= b.0), "{told:?}");
    assert_eq!(
        (told[0].0, told.last().map(|(part, _)| *part)),
        (0.0, Some(1.0))
    );
    assert!(
        told.iter().any(|(_, what)| what == "gouraud, barycentric")
            && told.iter().any(|(_, what)| what == "timing")
    );
}

#[test]
fn tables_have_a_row_a_method() {
    let frame = frame_of("sphere?rings=6&segments=12");
    let input = Input {
        name: "sphere".into(),
        frame: &frame,
    };
    let mut comparison = compare(&input, &all(), Renderer::LECTURE, quick(), &mut |_, _| {});
    // The machine may be too busy, and tables then look different.
    let noise = comparison.noise.as_mut().unwrap();
    (noise.trust, noise.sentence) = (Trust::Quiet, "quiet: by word".into());
    let rounds = noise.rounds;
    for kind in [TableKind::Short, TableKind::Compare, TableKind::Bench] {
        let text = table(&comparison, kind);
        let (head, body) = text.split_once("\n\n").unwrap();
        assert!(
            head.starts_with("sphere: 48×36, ") && head.contains("above 1 is faster"),
            "{head}"
        );
        let mut lines: Vec<&str> = body.lines().collect();
        if kind == TableKind::Compare {
            assert!(
                lines
                    .pop()
                    .is_some_and(|legend| legend.starts_with("other: pixels"))
            );
        }
        let notes = lines.split_off(1 + comparison.rows.len() + comparison.barycentric.len());
        for expected in [
            // Triangles about the poles, quads between them.
            "six-point: polygons by kind: 12 quadratic, 24 duff-phong",
            // Runs of so few pixels are not worth planning.
            "adaptive-phong: polygons by kind: 36 phong-rsqrt, 0 linear, 0 dull, 0 curved, 0 root",
            "difference-vector is left out: its highlights are by N.H, not by R.V",
            &format!("quiet: by word ({rounds} rounds)"),
        ] {
            assert!(notes.contains(&expected), "{notes:?}");
        }
        for (line, row) in lines[1..].iter().zip(comparison.all_rows()) {
            assert!(line.starts_with(&row.name()), "{line}");
            let rms: Vec<f64> = line
                .split(' ')
                .filter_map(|word| word.parse().ok())
                .collect();
            // Three digits down to the sixth place: within half of the last digit, which is 1/200
            // of the number, or of that place.
            let rounded = (255.0 * row.error.rms / 200.0).max(0.5e-6);
            let near = |shown: &f64| (shown - 255.0 * row.error.rms).abs() <= rounded;
            assert!(line.contains(" ± ") && rms.iter().any(near), "{line}");
        }
        // Columns end where their heads end, because all but the first are right-aligned.
        let ends: Vec<usize> = lines.iter().map(|line| line.chars().count()).collect();
        assert!(ends.iter().all(|end| *end == ends[0]), "{text}");
        let widest = text.lines().map(|line| line.chars().count()).max();
        assert!(kind != TableKind::Short || widest <= Some(100), "{text}");
        assert!(!text.contains('!'));
    }
    comparison.noise.as_mut().unwrap().trust = Trust::TooBusy;
    for kind in [TableKind::Short, TableKind::Compare, TableKind::Bench] {
        let text = table(&comparison, kind);
        let shown = |name: &str| text.lines().any(|line| line.contains(name));
        let tells_speed = [" ± ", "× naive-phong", "95 %", "above 1 is faster"].map(shown);
        assert_eq!(tells_speed, [false; 4], "{text}");
        assert!(
            shown("  RMS") && shown("quiet: by word"),
            "errors are told: {text}"
        );
    }
    for row in &mut comparison.rows {
        row.speed.as_mut().unwrap().work_to_naive = Some(Ratio::new(1.2, 1.21, 1.22));
    }
    let text = table(&comparison, TableKind::Short);
    assert!(
        text.contains("× naive by work\n") && text.contains("  1.21\n"),
        "{text}"
    );
    comparison.rows[0].own.max = 1.0;
    comparison.rows[0].within_bound = false;
    comparison.barycentric[0].other_polygon = 123;
    for (kind, mark) in [
        (
            TableKind::Short,
            format!("\n{} ! ", comparison.rows[0].name()),
        ),
        (TableKind::Compare, " !255".to_owned()),
        (
            TableKind::Bench,
            format!("\n{} ! ", comparison.rows[0].name()),
        ),
    ] {
        let text = table(&comparison, kind);
        assert!(
            text.contains(&mark) && text.contains("\n! farther"),
            "{text}"
        );
        assert!(
            text.contains(" 123") && text.contains("\nother: pixels"),
            "{text}"
        );
    }
    for row in comparison
        .rows
        .iter_mut()
        .chain(&mut comparison.barycentric)
    {
        row.speed = None;
    }
    comparison.noise = None;
    let text = table(&comparison, TableKind::Compare);
    assert!(
        !text.contains("speed over 1")
            && text
                .lines()
                .any(|line| line.starts_with("flat") && line.ends_with('-'))
    );
}

fn cut(mesh: &str) -> Option<Triangulation> {
    errors_only(&frame_of(mesh), &[]).triangulation
}

#[test]
fn triangles_are_not_cut_and_quadrangles_change() {
    assert!(cut("triangle").is_none());
    let quadrangles = cut("sphere?rings=4&segments=8").unwrap();
    assert!(quadrangles.triangles > 0 && quadrangles.not_simple == 0);
    let difference = quadrangles.difference;
    assert!(difference.max > 1.0 / 255.0, "{difference:?}");
    assert_eq!(difference.coverage_mismatches, 0, "the same pixels");
}

#[test]
fn the_difference_is_that_of_the_phong_references() {
    let frame = frame_of("sphere?rings=4&segments=8");
    let cut = errors_only(&frame, &[]).triangulation.unwrap();
    let [polygons, triangles] = [&frame, &triangulated(&frame).frame]
        .map(|frame| reference::render(frame, Model::Phong).to_linear());
    let whole = metrics::compare(&polygons, &triangles).unwrap();
    assert_eq!(cut.difference.max, whole.max);
    assert_eq!(cut.difference.excluded, 0);
}

#[test]
fn a_flat_face_with_equal_normals_stays_as_it_is() {
    let mut scene = Scene::of_mesh(builtin("prism").unwrap());
    (scene.width, scene.height) = (64, 48);
    for object in &mut scene.objects {
        object.normals = NormalSource::Crease(10.0).into();
    }
    let cut = errors_only(&scene.frame().unwrap(), &[])
        .triangulation
        .unwrap();
    // Results in f64 that agree within its rounding may become neighbours in f32, 2⁻²⁴ apart below
    // 1.
    assert!(cut.difference.max <= f64::from(f32::EPSILON) / 2.0);
}

/// Sizes and counts are of pixels, however many samples each of them has.
#[test]
fn samples_do_not_count_as_pixels() {
    let counts = [1, 2].map(|samples| {
        let mut scene = Scene::of_mesh(builtin("sphere").unwrap());
        (scene.width, scene.height, scene.samples) = (48, 36, samples);
        let (name, frame) = ("sphere".into(), &scene.frame().unwrap());
        let comparison = compare(
            &Input { name, frame },
            &[],
            Renderer::LECTURE,
            None,
            &mut |_, _| {},
        );
        assert_eq!((comparison.width, comparison.height), (48, 36));
        let share = comparison.fragments as f64 / comparison.covered_pixels as f64;
        assert!((0.8..1.2).contains(&share), "{share}");
        comparison.covered_pixels
    });
    assert!(counts[1] > counts[0], "{counts:?}");
}
