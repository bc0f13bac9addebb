//! How far every method's picture is from its closed form in `f64`, over all shipped scenes, on linear frames.

mod support;

use fastphong::frame::Frame;
use fastphong::metrics::compare_where;
use fastphong::raster::{self, NOTHING};
use fastphong::reference::{self, Model, ReferencePicture, Visibility};
use fastphong::shader::{METHODS, Variant};
use std::collections::BTreeMap;

struct Shipped {
    name: String,
    frame: Frame,
    visibility: Visibility,
    seen: fastphong::picture::Picture<u32>,
}

fn shipped() -> Vec<Shipped> {
    let load = |(name, path): (String, std::path::PathBuf)| {
        let frame = support::scene(&path, None).frame().expect("a frame");
        let (visibility, seen) = (reference::visibility(&frame), raster::polygon_numbers(&frame));
        Shipped { name, frame, visibility, seen }
    };
    support::shipped().into_iter().map(load).collect()
}

/// The largest and the root mean square difference where the engine and the reference see the same polygon.
fn errors(scene: &Shipped, variant: &Variant, truth: &ReferencePicture) -> (f64, f64) {
    let ours = variant.render_linear(&scene.frame);
    let same = |x, y| scene.seen.get(x, y) == scene.visibility.polygons.get(x, y);
    let difference = compare_where(&truth.to_linear(), &ours, same).expect("equal sizes");
    assert_eq!((difference.coverage_mismatches, difference.not_finite), (0, 0), "{}", scene.name);
    (difference.max, difference.rms)
}

/// Every method is within the rounding that its steps can make, on every scene; and over all scenes that bound is not
/// ten times too wide.
#[test]
fn every_method_is_within_its_bound_and_the_bound_bites() {
    let mut nearest: BTreeMap<&str, (f64, String)> = BTreeMap::new();
    let mut failures = Vec::new();
    for scene in shipped() {
        let truths = Model::ALL.map(|model| reference::shade(&scene.frame, &scene.visibility, model));
        for entry in METHODS {
            let info = entry.info;
            let place = Model::ALL.iter().position(|m| *m == info.model).expect("a model of the reference");
            let (max, rms) = errors(&scene, &entry.variant(), &truths[place]);
            let bound = info.bound(&scene.frame);
            println!("{:20} {:20} max {max:.2e} rms {rms:.2e} bound {bound:.2e}", scene.name, info.name);
            if max > bound {
                failures.push(format!("{} on {}: {max:.2e} is over {bound:.2e}", info.name, scene.name));
            }
            let nearest = nearest.entry(info.name).or_insert((0.0, String::new()));
            if max / bound > nearest.0 {
                *nearest = (max / bound, scene.name.clone());
            }
        }
    }
    for (method, (share, scene)) in nearest {
        println!("{method:20} reaches {share:.2} of its bound on {scene}");
        if share < 0.1 {
            failures.push(format!("{method}: its bound is over ten times the error of every scene"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// With one step of Newton's method, the coarse scenes show the error that the lecture does not mention; with three it
/// is gone in rounding. The exact figures are the report's; here only their order is held fast.
#[test]
fn more_steps_are_more_exact() {
    let coarse = |s: &Shipped| s.name == "coarse-sphere";
    let scene = shipped().into_iter().find(coarse).expect("the coarse sphere is shipped");
    let truth = reference::shade(&scene.frame, &scene.visibility, Model::Phong);
    let max = |text: &str| errors(&scene, &Variant::parse(text).expect("a method"), &truth).0;
    let (one, two, three) = (max("fast-phong:steps=1"), max("fast-phong"), max("fast-phong:steps=3"));
    assert!(one > 4.0 * two, "one step: {one:.2e}, two: {two:.2e}");
    assert!(three <= two, "three steps: {three:.2e}, two: {two:.2e}");
}

/// Pixels whose visible polygon differs are few, and lie where two surfaces meet within the rounding of depth.
#[test]
fn visible_polygons_differ_only_where_surfaces_meet() {
    for scene in shipped() {
        let (width, height) = (scene.frame.width(), scene.frame.height());
        let mut differing = 0;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            if scene.seen.get(x, y) != scene.visibility.polygons.get(x, y) {
                differing += 1;
                // As derived in tests/coverage.rs, with as many steps as this picture has rows and columns.
                let bound = 2.0 * (2 * (width + height) + 32) as f64 / f64::from(1 << 24);
                let gap = scene.visibility.depth_gap.get(x, y);
                assert!(gap <= bound, "{}: depths differ by {gap} at {x}, {y}", scene.name);
            }
        }
        let drawn = scene.seen.texels().iter().filter(|&&p| p != NOTHING).count();
        println!("{}: {differing} of {drawn} pixels", scene.name);
        assert!(differing * 10_000 <= drawn, "{}: {differing} of {drawn} pixels", scene.name);
    }
}

/// A flipped winding once hid behind an ambient-only picture: every scene must show lit pixels, and highlights where its
/// material has any.
#[test]
fn every_scene_is_lit() {
    for scene in shipped() {
        let picture = reference::shade(&scene.frame, &scene.visibility, Model::Phong).picture;
        let (mut drawn, mut lit, mut highlit) = (0usize, 0usize, 0usize);
        for (texel, &polygon) in picture.texels().iter().zip(scene.visibility.polygons.texels()) {
            if polygon == NOTHING {
                continue;
            }
            let lighting = &scene.frame.lightings()[scene.frame.polygons()[polygon as usize].material as usize];
            let most = |channel: usize| -> f64 {
                let diffuse: f32 = lighting.lights.iter().map(|l| l.diffuse[channel]).sum();
                f64::from(lighting.ambient[channel] + diffuse)
            };
            drawn += 1;
            lit += usize::from((0..3).any(|c| texel[c] > f64::from(lighting.ambient[c]) + 0.1 * most(c)));
            // Brighter than ambient and diffuse light can make it in at least one channel.
            highlit += usize::from((0..3).any(|c| texel[c] > most(c) + 1e-6));
        }
        println!("{}: {drawn} drawn, {lit} lit, {highlit} highlit", scene.name);
        assert!(drawn * 20 > picture.texels().len(), "{}: {drawn} pixels drawn", scene.name);
        assert!(lit * 2 > drawn, "{}: only {lit} of {drawn} pixels are lit", scene.name);
        let shiny =
            scene.frame.lightings().iter().any(|l| l.lights.iter().any(|l| l.specular.iter().any(|&s| s > 0.0)));
        assert!(!shiny || highlit * 2000 > drawn, "{}: {highlit} of {drawn} pixels have a highlight", scene.name);
    }
}
