//! Compares linear frames of every method with its `f64` closed form, over all shipped scenes.

use crate::support::cases::{Case, case, cases};
use crate::support::differences::largest_difference;
use crate::support::drawings::{Drawing, assert_none, for_each_drawing};

use crate::support::renderers::{self, distinct};
use fastphong::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::Material;
use fastphong::mesh::builtin::builtin;
use fastphong::picture::LinearPicture;
use fastphong::raster::{NO_POLYGON, Renderer};
use fastphong::reference::{self, Model};
use fastphong::scene::file::{SceneFile, UnusableMesh};
use fastphong::scene::{
    DepthBuffer, Falloff, HiddenSurfaces, LightTerm, Lighting, Place, Power, SpecularGate,
    SpecularModel,
};
use fastphong::shading::{Info, MethodRow, Range, Variant};
use glam::{DQuat, DVec3, EulerRot};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Checks that a drawing is within the rounding bound of its closed form. Returns the span engine's
/// error as a share of that bound, 0 for other engines, or a message.
///
/// The other engines round in other places than the span engine, but no more often. The row engine
/// steps eight pixels at a time. The barycentric engine interpolates by barycentric coordinates.
fn check(drawing: &Drawing) -> Result<f64, String> {
    let (case, variant) = (drawing.case, &drawing.variant);
    let (info, frame) = (variant.info(), &case.frame);
    let (seen, truly) = (case.seen(), &case.visibility().polygons);
    // The span engine is compared wherever it sees the reference's polygon. Others are compared
    // where rounding cannot change the visible polygon.
    let counts = |x, y| match drawing.is_by_spans() {
        true => seen.get(x, y) == truly.get(x, y),
        false => case.decided().get(x, y),
    };
    let (max, uncovered) = largest_difference(case.truth(info.model), &drawing.linear(), counts);
    let bound = variant.bound(frame);
    println!("{drawing}: max {max:.2e}, bound {bound:.2e}");
    if max > bound || uncovered > 0 {
        return Err(format!(
            "{drawing}: {max:.2e} is over {bound:.2e}, {uncovered} pixels drawn in one only"
        ));
    }
    if !drawing.is_by_spans() {
        return Ok(0.0);
    }
    // These scenes should exercise rounding. The method's own allowance is for coarser scenes, so
    // it is left out, and so is its error by design.
    let numbers = with_numbers(info);
    let rounding = numbers.bound(frame) - numbers.approximation(frame);
    Ok(max / rounding.max(0.0))
}

/// Checks every drawing of these cases. Returns the case, the method and the span engine's error as
/// a share of its bound.
pub fn check_all<'a>(
    cases: impl IntoIterator<Item = &'a Case>,
) -> Vec<(&'a Case, &'static str, f64)> {
    let found = for_each_drawing(cases, |drawing| {
        let name = drawing.variant.info().name;
        let share = check(drawing)?;
        Ok(drawing.is_by_spans().then_some((drawing.case, name, share)))
    });
    let mut shares = Vec::new();
    let mut failures = Vec::new();
    for one in found {
        match one {
            Ok(share) => shares.extend(share),
            Err(message) => failures.push(Some(message)),
        }
    }
    assert_none(failures);
    shares
}

/// Sets every parameter of a method to its least value, so that it chooses nothing itself.
fn with_numbers(info: &Info) -> Variant {
    let mut text = info.name.to_string();
    for parameter in info.parameters {
        if let Range::Whole(least, _) = parameter.range {
            text += &format!(":{}={least}", parameter.name);
        }
    }
    Variant::parse(&text).expect("a method")
}

/// Every method stays within its rounding bound on every scene, with every engine and instruction
/// set of this machine. Over all scenes the bound is at most ten times too wide.
#[test]
fn every_method_is_within_its_bound_and_the_bound_bites() {
    for scene in cases(None) {
        let decided = scene.decided();
        let left_out = decided.pixels().iter().filter(|decided| !**decided).count();
        println!(
            "{}: {left_out} of {} pixels are left out",
            scene.name,
            decided.pixels().len()
        );
        let fights = scene.name == "z-fighting"; // a 16-bit depth buffer has wide levels
        assert!(
            fights || left_out * 1000 <= decided.pixels().len(),
            "{}: {left_out} pixels left out",
            scene.name
        );
    }
    let mut nearest: BTreeMap<&str, (f64, &str)> = BTreeMap::new();
    let mut shares = check_all(cases(None));
    // No shipped scene has small triangles with highlights by N·H, which some methods require.
    let by_half_vectors = ["million", "mirrored"].map(|name| {
        let frame = relit(&case(name, None).frame, |lighting| {
            lighting.specular = SpecularModel::Blinn;
        });
        Case::new(format!("{name} with N.H"), frame)
    });
    let mut failures = Vec::new();
    for case in &by_half_vectors {
        for name in ["duff-half", "slerp-half"] {
            let drawing = Drawing {
                case,
                variant: Variant::parse(name).expect("a method"),
                renderer: Renderer::LECTURE,
            };
            match check(&drawing) {
                Ok(share) => shares.push((case, name, share)),
                Err(message) => failures.push(message),
            }
        }
    }
    for (scene, method, share) in shares {
        let nearest = nearest.entry(method).or_insert((0.0, ""));
        if share > nearest.0 {
            *nearest = (share, &scene.name);
        }
    }
    for (method, (share, scene)) in nearest {
        println!("{method:20} reaches {share:.2} of its bound on {scene}");
        let has_bound = MethodRow::named(method)
            .is_some_and(|entry| entry.info.roundings.start < f64::INFINITY);
        if share < 0.1 && has_bound {
            failures.push(format!(
                "{method}: its bound is over ten times the error of every scene"
            ));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Checks every method with every renderer on a scene with each exponent. Returns each method's
/// error as a share of its bound, by exponent.
fn check_exponents(name: &str, frame: &Frame, exponents: &[f32]) -> Vec<Vec<f64>> {
    let relit = exponents.iter().map(|&shininess| {
        let frame = relit(frame, |lighting| lighting.shininess = shininess);
        Case::new(format!("{name} with {shininess}"), frame)
    });
    let cases: Vec<Case> = relit.collect();
    let shares: Vec<f64> = check_all(&cases).iter().map(|(.., share)| *share).collect();
    shares
        .chunks(shares.len() / exponents.len())
        .map(<[f64]>::to_vec)
        .collect()
}

/// Powers with an exponent below 1 are infinitely steep at 0, and on all these scenes highlights
/// fall to 0.
#[test]
fn exponents_below_1_are_within_their_bound() {
    for name in [
        "fine-sphere",
        "coarse-sphere",
        "blinn",
        "two-lights",
        "local-lights",
        "perspective",
        "vase",
        "teapot",
    ] {
        let frame = &case(name, Some((64, 48))).frame;
        check_exponents(name, frame, &[0.0, 1e-6, 0.1, 0.25, 0.5, 0.999, 1.0]);
    }
}

/// Builds small squares that all lean by 45° from the eye, each in another direction, with the
/// light at the eye. R is at a right angle to the eye, so only rounding decides if R·V is just over
/// 0 or just under.
fn ends_of_highlights(specular: SpecularModel, gate: SpecularGate, colours: &[f32]) -> Frame {
    const SIDE: u32 = 32;
    let mut builder = FrameBuilder::new(SIDE, SIDE);
    let toward = match specular {
        SpecularModel::Phong => [0.0, 0.0, 1.0],
        // For a normal at a right angle to H, N·H is 0, but L·N is not.
        SpecularModel::Blinn => [0.0, 0.6, 0.8],
    };
    let lights = colours.iter().map(|&colour| LightTerm {
        place: Place::Infinite(toward),
        diffuse: [0.0; 3],
        specular: [colour; 3],
        falloff: Falloff::None,
    });
    let mut lighting = Lighting::new(&Material::default(), [0.0; 3], &[], DVec3::Z);
    lighting.lights = lights.collect();
    lighting.shininess = 1.0;
    (lighting.specular, lighting.gate) = (specular, gate);
    let material = builder.lighting(lighting);
    for number in 0..SIDE * SIDE {
        let (x, y) = (f64::from(number % SIDE), f64::from(number / SIDE));
        // The golden angle: directions do not repeat, and each rounds differently.
        let (sin, cos) = (f64::from(number) * 2.399963).sin_cos();
        let half = core::f64::consts::FRAC_1_SQRT_2;
        let normal = match specular {
            SpecularModel::Phong => [cos * half, sin * half, half],
            SpecularModel::Blinn => {
                // H = (0, 0.6, 1.8) / |…|; its normals are spanned by (1, 0, 0) and (0, 1.8, −0.6)
                // / |…|.
                let length = f64::hypot(1.8, 0.6);
                [cos, sin * 1.8 / length, -sin * 0.6 / length]
            }
        };
        let normal = normal.map(|x| x as f32);
        let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)].map(|(right, down)| {
            builder.vertex(Vertex {
                x: SubPixel::from_num(x + right),
                y: SubPixel::from_num(y + down),
                depth: 0.5,
                inv_w: 1.0,
                normal,
                material,
            })
        });
        builder.polygon(&corners, normal, number);
    }
    builder.finish().expect("all corners are on the picture")
}

/// Where highlights end, exponents below 1 turn the last bit of a cosine into grey levels. For each
/// exponent the largest error of all methods is over a tenth of the bound. A method that happens to
/// round like the reference has no error there.
#[test]
fn exponents_below_1_bite_where_highlights_end() {
    let exponents = [0.1, 0.25, 0.5];
    let frame = ends_of_highlights(SpecularModel::Phong, SpecularGate::Gated, &[1.0]);
    let shares = check_exponents("ends of highlights", &frame, &exponents);
    for (shares, exponent) in shares.iter().zip(exponents) {
        let most = shares
            .iter()
            .fold(0.0, |most, share| f64::max(most, *share));
        println!("n = {exponent}: {most:.2} of the bound, by method {shares:.2?}");
        assert!(most > 0.1, "n = {exponent}: at most {most:.2} of the bound");
    }
}

/// A highlight that is weighted by L·N has the error that a length may have, because L·N is divided
/// by the length.
#[test]
fn weighted_highlights_are_within_their_bound() {
    let text = "
        interpolation = 'perspective'
        specular_gate = 'weighted'
        [image]
        width = 5
        height = 20
        [camera]
        fovy = 77.6888562528367
        [[light]]
        position = [0, 0, 1]
        [[object]]
        mesh = 'builtin:polygon?sides=9'
        material = { ka = [0, 0, 0], kd = [0, 0, 0], ks = 0.6, shininess = 1 }
    ";
    let file = SceneFile::parse(text, "weighted").unwrap_or_else(|e| panic!("{e}"));
    let resolved = file.resolve(|name, _| {
        let shape = builtin(name.trim_start_matches("builtin:"));
        let shape = shape.map_err(|error| UnusableMesh::new(error.to_string()))?;
        Ok((Arc::new(shape), Default::default()))
    });
    let scene = resolved.unwrap_or_else(|e| panic!("{e}")).scene;
    check_exponents("weighted", &scene.frame().expect("a frame"), &[1.0, 4.0]);
}

/// The bound holds for both kinds of highlight, for weighted and ungated ones, and for one light or
/// several of different strengths.
#[test]
fn exponents_below_1_are_within_their_bound_under_every_highlight() {
    for specular in [SpecularModel::Phong, SpecularModel::Blinn] {
        for gate in [SpecularGate::Ungated, SpecularGate::Weighted] {
            for colours in [&[1e-3][..], &[0.3; 3], &[40.0, 1e-9]] {
                let frame = ends_of_highlights(specular, gate, colours);
                let name = format!("{specular:?}, {gate:?}, {colours:?}");
                check_exponents(&name, &frame, &[0.0, 1e-6, 0.1, 0.5, 0.9, 1.0]);
            }
        }
    }
}

/// Builds polygons of four corners, or triangles if `is_cut`, in cells 16 pixels wide and high.
/// `corners` are in 1/256 pixel from the corner of a cell. The cosine between each corner's normal
/// and the cell's mean direction is `cosine`. The directions differ from cell to cell.
fn apart(cosine: f64, corners: [[i32; 2]; 4], is_cut: bool) -> Frame {
    const SIDE: u32 = 8;
    let mut builder = FrameBuilder::new(16 * SIDE, 16 * SIDE);
    let toward = DVec3::new(0.3, 0.5, 0.8).normalize().as_vec3().to_array();
    let mut lighting = Lighting::new(&Material::default(), [0.0; 3], &[], DVec3::Z);
    lighting.lights = vec![LightTerm {
        place: Place::Infinite(toward),
        diffuse: [0.5; 3],
        specular: [0.5; 3],
        falloff: Falloff::None,
    }];
    lighting.shininess = 1.0;
    // A continuous highlight: only rounding makes differences.
    lighting.gate = SpecularGate::Ungated;
    let material = builder.lighting(lighting);
    for number in 0..SIDE * SIDE {
        // The golden angle: directions do not repeat, and each rounds differently.
        let turn = DQuat::from_euler(EulerRot::XYZ, 0.3, 0.1, f64::from(number) * 2.399963);
        let cell = [number % SIDE, number / SIDE].map(|cell| 16 * 256 * cell as i32);
        let sine = (1.0 - cosine * cosine).sqrt();
        let around = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let corners: Vec<u32> = corners
            .iter()
            .zip(around)
            .map(|([x, y], [right, up])| {
                let normal = turn * DVec3::new(sine * right, sine * up, cosine);
                builder.vertex(Vertex {
                    x: SubPixel::from_bits(cell[0] + x),
                    y: SubPixel::from_bits(cell[1] + y),
                    depth: 0.5,
                    inv_w: 1.0,
                    normal: normal.as_vec3().to_array(),
                    material,
                })
            })
            .collect();
        let face = (turn * DVec3::Z).as_vec3().to_array();
        let [a, b, c, d] = corners[..] else {
            unreachable!("four corners")
        };
        if is_cut {
            builder.polygon(&[a, b, c], face, number);
            builder.polygon(&[a, c, d], face, number);
        } else {
            builder.polygon(&corners, face, number);
        }
    }
    builder.finish().expect("all corners are on the picture")
}

/// The corners of a whole cell.
const SQUARE: [[i32; 2]; 4] = [[0, 0], [0, 4096], [4096, 4096], [4096, 0]];

/// Checks every method with every renderer on a frame. Returns the span engine's largest error as a
/// share of its bound.
fn most_of_bound(name: &str, frame: Frame) -> f64 {
    let case = Case::new(name, frame);
    let shares = check_all([&case]);
    shares
        .iter()
        .fold(0.0, |most, (.., share)| most.max(*share))
}

/// Between normals that are far apart, interpolated normals are short, and their directions have
/// larger errors. Bounds grow like these errors, and no faster.
#[test]
fn short_normals_are_within_their_bound_and_it_bites() {
    for is_cut in [false, true] {
        for cosine in [0.7, 0.3, 0.1, 0.03, 0.01] {
            let name = format!("normals at {cosine} of their mean, cut: {is_cut}");
            let most = most_of_bound(&name, apart(cosine, SQUARE, is_cut));
            println!("{name}: {most:.2} of the bound");
            assert!(most > 0.02, "{name}: {most:.3} of the bound");
        }
    }
}

/// In a span narrower than a pixel, steps are many times as large as its values: parameters between
/// nearly equal crossings must not lose digits.
#[test]
fn slivers_are_within_their_bound() {
    let mut found = Vec::new();
    for (left, right) in [(1, 1), (1, 2), (3, 20), (100, 27)] {
        // Both crossings lie around the pixel centres of column 8.
        let [left, right] = [2176 - left, 2176 + right];
        let upright = [[left, 0], [left, 4096], [right, 4096], [right, 0]];
        let crossed = [[left, 0], [right, 4096], [left, 4096], [right, 0]];
        // One slants by 45° through the centres of all columns, the other by two columns in three
        // rows, where crossings are rounded.
        let lean = |[top, bottom]: [i32; 2], right: i32, height: i32| {
            [
                [left + top, 0],
                [left + bottom, height],
                [right + bottom, height],
                [right + top, 0],
            ]
        };
        let leaning = [
            lean([-1920, 2176], right, 4096),
            lean([-2133, 469], right - 1, 3903),
        ];
        for corners in [upright, crossed, leaning[0], leaning[1]] {
            for is_cut in [false, true] {
                for cosine in [0.99, 0.6] {
                    let name = format!("slivers {corners:?} at {cosine}, cut: {is_cut}");
                    found.push(most_of_bound(&name, apart(cosine, corners, is_cut)));
                }
            }
        }
    }
    println!("{found:.2?} of the bound");
    assert!(found.iter().all(|share| *share > 0.02), "{found:.2?}");
}

fn linear(variant: &str, frame: &Frame) -> LinearPicture {
    Variant::parse(variant)
        .expect("a method")
        .render_linear(frame)
        .expect("a method for the frame")
}

fn bound(variant: &str, frame: &Frame) -> f64 {
    Variant::parse(variant).expect("a method").bound(frame)
}

/// Each further Newton step squares the error on short spans over large angles, here on a coarse
/// sphere 24 rows high. One step is off by far more than rounding. The report has exact figures;
/// this test checks their order.
#[test]
fn more_steps_are_more_exact() {
    let scene = case("coarse-sphere", Some((32, 24)));
    let (frame, truth) = (&scene.frame, scene.truth(Model::Phong));
    let max = |variant: &str| largest_difference(truth, &linear(variant, frame), |_, _| true).0;
    let steps = [1, 2, 3].map(|steps| max(&format!("fast-phong:steps={steps}")));
    let (auto, rounding) = (max("fast-phong"), bound("fast-phong:steps=3", frame));
    let allowed = bound("fast-phong", frame);
    println!("{steps:?}, auto {auto}, bound {rounding:.2e}, of auto {allowed:.2e}");
    assert!(
        steps[0] > 5.0 * rounding,
        "one step: {steps:?}, bound {rounding:.2e}"
    );
    assert!(
        steps[1] < 0.1 * steps[0] && steps[2] <= rounding,
        "{steps:?}, bound {rounding:.2e}"
    );
    assert!(
        steps[0] > allowed && auto <= allowed,
        "{auto}, {steps:?}, bound {allowed:.2e}"
    );
}

/// By default fast Phong chooses the fewest steps whose error is invisible: one on a fine sphere
/// except at its rim, more on a coarse one. Its bound includes the allowed error, a quarter of a
/// grey level.
#[test]
fn spans_use_the_fewest_steps_with_an_invisible_error() {
    let fine = &case("fine-sphere", None).frame;
    let coarse = &case("coarse-sphere", Some((32, 24))).frame;
    // Returns the share of drawn pixels with the same colour as at a fixed count of steps.
    let same = |frame: &Frame, steps: u32| {
        let pictures = [
            linear("fast-phong", frame),
            linear(&format!("fast-phong:steps={steps}"), frame),
        ];
        let (a, b) = (pictures[0].pixels(), pictures[1].pixels());
        let drawn = a.iter().filter(|pixel| pixel[3] > 0.0).count();
        let others = a.iter().zip(b).filter(|(a, b)| a != b).count();
        1.0 - others as f64 / drawn as f64
    };
    let shares = [fine, coarse].map(|frame| [1, 2].map(|steps| same(frame, steps)));
    println!("of one step and of two, on a fine sphere and on a coarse one: {shares:?}");
    let [[fine_one, fine_two], [coarse_one, coarse_two]] = shares;
    assert!(fine_one > 0.99 && fine_one > fine_two);
    assert!(coarse_one < 0.9 && coarse_two < 1.0);
    for frame in [fine, coarse] {
        let allowed = bound("fast-phong", frame) - bound("fast-phong:steps=2", frame);
        assert!((0.0..=1e-3 / 0.999).contains(&allowed), "{allowed}");
    }
}

/// The visible polygon differs only at a few pixels, where two surfaces meet within the rounding of
/// depth.
#[test]
fn visible_polygons_differ_only_where_surfaces_meet() {
    for scene in cases(None) {
        let (width, height) = (scene.frame.width(), scene.frame.height());
        let mut differing = 0;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            if scene.seen().get(x, y) != scene.visibility().polygons.get(x, y) {
                differing += 1;
                let bound = renderers::depth_rounding(&scene.frame);
                let gap = scene.visibility().depth_gap.get(x, y);
                assert!(
                    gap <= bound,
                    "{}: depths differ by {gap} at {x}, {y}",
                    scene.name
                );
            }
        }
        let drawn = scene
            .seen()
            .pixels()
            .iter()
            .filter(|&&p| p != NO_POLYGON)
            .count();
        println!("{}: {differing} of {drawn} pixels", scene.name);
        // Narrow depth buffers have wide levels, and rounding decides where a level ends.
        // `hidden_surfaces` tests these pixels.
        let fights = matches!(scene.frame.hidden_surfaces(), HiddenSurfaces::ZBuffer(DepthBuffer { bits, .. })
            if bits.most().is_some());
        assert!(
            fights || differing * 10_000 <= drawn,
            "{}: {differing} of {drawn} pixels",
            scene.name
        );
    }
}

/// Copies a frame and removes its specular light.
fn matte(frame: &Frame) -> Frame {
    relit(frame, |lighting| {
        for light in &mut lighting.lights {
            light.specular = [0.0; 3];
        }
    })
}

/// Copies a frame and changes each lighting by `change`.
fn relit(frame: &Frame, change: impl Fn(&mut Lighting)) -> Frame {
    let mut builder = FrameBuilder::new(frame.width() as u32, frame.height() as u32);
    builder
        .interpolation(frame.interpolation())
        .hidden_surfaces(frame.hidden_surfaces())
        .depth_range(frame.depth_range());
    for lighting in frame.lightings() {
        let mut lighting = lighting.clone();
        change(&mut lighting);
        builder.lighting(lighting);
    }
    for number in 0..frame.vertices().len() as u32 {
        builder.vertex(frame.vertex(number));
        builder.position(number, frame.position(number));
    }
    for corner in frame.clip_corners() {
        builder.clip_corner(*corner);
    }
    for polygon in frame.polygons() {
        builder.polygon(
            frame.corners(polygon),
            frame.polygon_normal(polygon),
            polygon.source,
        );
    }
    builder.finish().expect("what was a frame is one")
}

/// Scenes without a highlight by design: flat faces turned away from it, or a matte material.
const WITHOUT_HIGHLIGHT: [&str; 6] = [
    "corrugated",
    "cyclic-triangles",
    "figure5",
    "interpenetration",
    "polygons",
    "z-fighting",
];

/// Every scene shows lit pixels, and highlights unless it has none by design. Without this test, a
/// flipped winding could hide in a picture of ambient light only.
#[test]
fn every_scene_is_lit() {
    let wide = |pixel: [f32; 4]| pixel.map(f64::from);
    for scene in cases(None) {
        let full = scene.truth(Model::Phong);
        let dull = matte(&scene.frame);
        let dull = reference::shade(&dull, scene.visibility(), Model::Phong).to_linear();
        let (mut drawn, mut lit, mut highlit) = (0usize, 0usize, 0usize);
        for (i, &polygon) in scene.visibility().polygons.pixels().iter().enumerate() {
            if polygon == NO_POLYGON {
                continue;
            }
            let lighting = &scene.frame.lightings()
                [scene.frame.polygons()[polygon as usize].material as usize];
            let (full, dull) = (wide(full.pixels()[i]), wide(dull.pixels()[i]));
            let most =
                |c: usize| f64::from(lighting.lights.iter().map(|l| l.diffuse[c]).sum::<f32>());
            let shine =
                |c: usize| f64::from(lighting.lights.iter().map(|l| l.specular[c]).sum::<f32>());
            drawn += 1;
            // A pixel is lit from a tenth of the largest possible diffuse light on, and highlit
            // from a quarter of the largest possible specular light on.
            lit += usize::from(
                (0..3).any(|c| dull[c] > f64::from(lighting.ambient[c]) + 0.1 * most(c)),
            );
            highlit +=
                usize::from((0..3).any(|c| shine(c) > 0.0 && full[c] - dull[c] > 0.25 * shine(c)));
        }
        println!(
            "{}: {drawn} drawn, {lit} lit, {highlit} highlit",
            scene.name
        );
        assert!(
            drawn * 20 > full.pixels().len(),
            "{}: {drawn} pixels drawn",
            scene.name
        );
        assert!(
            lit * 2 > drawn,
            "{}: only {lit} of {drawn} pixels are lit",
            scene.name
        );
        let meant = !WITHOUT_HIGHLIGHT.contains(&scene.name.as_str());
        assert_eq!(
            highlit * 2000 > drawn,
            meant,
            "{}: {highlit} of {drawn} pixels have a highlight",
            scene.name
        );
    }
}

/// Every power function is within its rounding bound of its own closed form, with every engine and
/// instruction set. Its closed form is no farther from tⁿ than it states. Over these scenes both
/// errors come close to their bounds.
#[test]
fn every_power_is_within_its_bounds() {
    let mut failures = Vec::new();
    // The largest shares of both bounds, for each power.
    let mut nearest: Vec<(Power, [f64; 2])> = Power::ALL[1..]
        .iter()
        .map(|&power| (power, [0.0; 2]))
        .collect();
    for name in ["fine-sphere", "four-lights", "blinn", "local-lights"] {
        let frame = case(name, Some((96, 72))).frame.clone();
        for shininess in [0.0, 0.5, 1.0, 1.5, 4.0, 20.0, 32.0, 200.0] {
            let frame = relit(&frame, |lighting| lighting.shininess = shininess);
            let scene = Case::new(format!("{name} with {shininess}"), frame);
            for (power, [to_bound, to_power]) in &mut nearest {
                for method in ["phong-rsqrt", "gouraud", "duff-phong"] {
                    let text = format!("{method}:power={power}");
                    let variant = Variant::parse(&text).expect("a method");
                    let form = variant.closed_form();
                    let truth =
                        reference::shade(&scene.frame, scene.visibility(), form).to_linear();
                    let bound = variant.bound(&scene.frame);
                    for renderer in distinct(&variant, &scene.frame) {
                        let ours = variant
                            .render_linear_with(&scene.frame, renderer)
                            .expect("a method for the frame");
                        let decided = scene.decided();
                        let (max, _) = largest_difference(&truth, &ours, |x, y| decided.get(x, y));
                        *to_bound = to_bound.max(max / bound);
                        if max > bound {
                            let by = renderers::name(renderer);
                            failures.push(format!(
                                "{text} on {} by {by}: {max:.2e} is over {bound:.2e}",
                                scene.name
                            ));
                        }
                    }
                    let stated = variant.approximation(&scene.frame);
                    let (max, _) = largest_difference(scene.truth(form.model), &truth, |_, _| true);
                    // The references are stored in single precision.
                    if max > stated + 2.0 * f64::from(f32::EPSILON) {
                        failures.push(format!(
                            "{text} on {}: {max:.2e} from t^n, over {stated:.2e}",
                            scene.name
                        ));
                    }
                    if stated > 1e-5 {
                        *to_power = to_power.max(max / stated);
                    }
                }
            }
        }
    }
    for (power, [to_bound, to_power]) in nearest {
        println!("{power}: {to_bound:.2} of its bound, {to_power:.2} of what it states");
        assert!(to_bound > 0.1 && to_power > 0.1, "{power}");
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
