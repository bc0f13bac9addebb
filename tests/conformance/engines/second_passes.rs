//! Second passes over the same polygons, with a test for equal depths.

use super::frames::kinds;
use crate::support::renderers::{name, renderers};
use fastphong::frame::Frame;
use fastphong::mesh::builtin::builtin;
use fastphong::picture::{Picture8, PictureMut};
use fastphong::raster::{Background, DepthTest, DrawError, DrawOptions, Renderer};
use fastphong::scene::{Light, Scene};
use fastphong::shading::Variant;
use glam::DVec3;

/// Methods of the row engine by plane equations, by packed colours, and by runs, and one that only
/// the span engine draws.
const METHODS: [&str; 4] = [
    "phong-rsqrt",
    "flat",
    "fast-phong:steps=2",
    "adaptive-phong",
];

/// Draws a pass. Returns how many pixels it drew, or its error.
fn pass(
    method: &str,
    frame: &Frame,
    renderer: Renderer,
    (test, depth): (DepthTest, &mut [f32]),
) -> Result<usize, DrawError> {
    let mut picture = Picture8::new(frame.picture_width(), frame.picture_height(), [0; 4]);
    let options = DrawOptions::by(renderer)
        .background(Background::Kept)
        .depth(depth)
        .depth_test(test);
    let variant = Variant::parse(method).expect("a method");
    variant.draw(frame, PictureMut::from(&mut picture), options)?;
    Ok(picture.pixels().iter().filter(|p| p[3] > 0).count())
}

/// Returns an empty depth buffer.
fn empty(frame: &Frame, is_reversed: bool) -> Vec<f32> {
    let far = [f32::INFINITY, f32::NEG_INFINITY][usize::from(is_reversed)];
    vec![far; frame.width() * frame.height()]
}

/// Checks first and second passes by all pairs of methods and renderers. `second` has the polygons
/// of `first`, and may have other lights.
fn check(kind: &str, methods: &[&str], [first, second]: [&Frame; 2]) -> usize {
    let mut refused = 0;
    let ends = [Renderer::Span, Renderer::fastest()];
    for (a, b) in methods
        .iter()
        .flat_map(|a| methods.iter().map(move |b| (a, b)))
    {
        for (is_reversed, [less, or_equal]) in [
            (false, [DepthTest::Less, DepthTest::LessOrEqual]),
            (true, [DepthTest::Greater, DepthTest::GreaterOrEqual]),
        ] {
            for (by_a, by_b) in ends.iter().flat_map(|x| ends.map(|y| (*x, y))) {
                let mut depth = empty(first, is_reversed);
                let Ok(drawn) = pass(a, first, by_a, (less, &mut depth)) else {
                    continue; // the method is not for this frame
                };
                let plan = |method, frame, renderer| {
                    let variant = Variant::parse(method).expect("a method");
                    variant.plan(frame, renderer).renderer()
                };
                let (Some(by_a), Some(by_b)) = (plan(a, first, by_a), plan(b, second, by_b)) else {
                    continue;
                };
                let before = depth.clone();
                let who = format!("{kind}: {a} by {}, then {b} by {}", name(by_a), name(by_b));
                let again = pass(b, second, by_b, (or_equal, &mut depth));
                if by_a.engine() == by_b.engine() {
                    assert_eq!(again, Ok(drawn), "{who}");
                    assert_eq!(
                        depth, before,
                        "{who}: one depth for all methods of an engine"
                    );
                } else if again != Ok(drawn) {
                    assert_eq!(again, Err(DrawError::DepthOfEngine(by_a.engine())), "{who}");
                    assert_eq!(depth, before, "{who}: nothing is written");
                    refused += 1;
                }
                // An emptied buffer holds no depths.
                let mut depth = empty(second, is_reversed);
                let fresh = pass(b, second, by_b, (or_equal, &mut depth));
                assert_eq!(fresh, Ok(drawn), "{who}");
            }
        }
    }
    refused
}

/// A second pass draws every pixel of the first, whichever methods an engine draws them by. Where
/// engines differ it is an error.
#[test]
fn a_second_pass_draws_all_pixels_or_is_refused() {
    let mut refused = 0;
    for (kind, frame) in kinds(48, 36) {
        let mut depth = empty(&frame, false);
        // Frames without a depth buffer of 32 bits have no second passes.
        if pass(
            "gouraud",
            &frame,
            Renderer::Span,
            (DepthTest::Less, &mut depth),
        )
        .is_ok()
        {
            refused += check(kind, &METHODS[..2], [&frame, &frame]);
        }
    }
    // A torus of triangles that the depth test hides in part, lit anew for the second pass.
    let mut scene =
        Scene::of_mesh(builtin("torus?segments=40&sides=30&triangles=true").expect("a mesh"));
    (scene.width, scene.height) = (150, 110);
    let first = scene.frame().expect("a frame");
    scene.lights = (0..5)
        .map(|i| Light::directional(DVec3::new(1.0, f64::from(i), 2.0), [0.1; 3]))
        .collect();
    let second = scene.frame().expect("a frame");
    refused += check("torus", &METHODS, [&first, &second]);
    assert!(refused > 0 || renderers().len() == 1);
}
