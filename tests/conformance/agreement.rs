//! Methods compared with each other, and render paths compared with each other.

use crate::support::cases::Case;
use crate::support::differences::largest_difference;
use crate::support::{self, Random, linear};
use crate::support::{floats, floats_on};
use fastphong::compare::metrics::compare;
use fastphong::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::Material;
use fastphong::mesh::builtin::builtin;
use fastphong::picture::Picture;
use fastphong::raster::{DrawOptions, Edges};
use fastphong::scene::{Interpolation, Light, Lighting, Place, Scene};
use fastphong::shading::Variant;
use glam::DVec3;

fn variant(name: &str) -> Variant {
    Variant::parse(name).expect("a method")
}

fn lights(count: usize) -> Vec<Light> {
    let light = |i: usize| {
        let angle = 2.399963 * i as f64; // the golden angle: directions that do not repeat
        let direction = DVec3::new(0.7 * angle.cos(), 0.7 * angle.sin(), 1.0).normalize();
        Light::directional(direction, [0.9, 0.7, 0.5].map(|c| c / count as f32))
    };
    (0..count).map(light).collect()
}

fn sphere(change: impl FnOnce(&mut Scene)) -> Frame {
    let mut scene =
        Scene::of_mesh(builtin("sphere?rings=10&segments=20").expect("a built-in mesh"));
    (scene.width, scene.height) = (96, 72);
    change(&mut scene);
    scene.frame().expect("a frame")
}

/// Equal normals at all corners make all methods agree within their bounds, because nothing varies
/// over a polygon.
#[test]
fn equal_normals_make_all_methods_equal() {
    let mut random = Random::new(41);
    let normal = {
        let v = [0.2f64, -0.3, 0.9];
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        v.map(|c| (c / length) as f32)
    };
    for count in [0, 1, 3, 6] {
        let mut builder = FrameBuilder::new(64, 48);
        let view = DVec3::new(0.1, 0.2, 1.0).normalize();
        let material = builder.lighting(Lighting::new(
            &Material::default(),
            [1.0; 3],
            &lights(count),
            view,
        ));
        for number in 0..6 {
            let corners: Vec<u32> = support::random_polygon(&mut random, 64, 48, 3 + number % 4)
                .iter()
                .map(|c| {
                    let (x, y) = (SubPixel::from_bits(c.x), SubPixel::from_bits(c.y));
                    builder.vertex(Vertex {
                        x,
                        y,
                        depth: c.depth.into(),
                        inv_w: 1.0,
                        normal,
                        material,
                    })
                })
                .collect();
            builder.polygon(&corners, normal, number as u32);
        }
        let frame = builder.finish().expect("a frame");
        let first = linear(&floats()[0], &frame);
        for entry in floats_on(&frame) {
            let difference = compare(&first, &linear(entry, &frame)).expect("equal sizes");
            let bound = floats()[0].variant().bound(&frame) + entry.variant().bound(&frame);
            assert!(
                difference.max <= bound,
                "{} with {count} lights: {}",
                entry.info.name,
                difference.max
            );
            assert_eq!(difference.coverage_mismatches, 0);
        }
    }
}

/// Any count of lights draws the reference's picture. Counts between the compiled sizes are padded
/// with dark lights.
#[test]
fn any_count_of_lights_agrees_with_the_reference() {
    for count in [0, 1, 2, 3, 4, 5, 8, 9, 20, Scene::MAX_LIGHTS] {
        let case = Case::new("", sphere(|scene| scene.lights = lights(count)));
        assert_eq!(case.frame.light_count(), count);
        for entry in floats_on(&case.frame) {
            let ours = linear(entry, &case.frame);
            let (max, _) = largest_difference(case.truth(entry.info.model), &ours, |_, _| true);
            let bound = entry.variant().bound(&case.frame);
            assert!(
                max <= bound,
                "{}, {count} lights: {max} over {bound}",
                entry.info.name
            );
        }
    }
    let mut scene = Scene::of_mesh(builtin("cube").expect("a built-in mesh"));
    scene.lights = lights(Scene::MAX_LIGHTS + 1);
    assert!(scene.frame().is_err(), "one light more than there may be");
}

/// A light behind the sphere makes no highlight. There L·N < 0, although R·V = 1 − 2 (N·V)² is
/// positive toward the rim.
#[test]
fn a_light_behind_makes_no_highlight() {
    let mut scene =
        Scene::of_mesh(builtin("sphere?rings=40&segments=80").expect("a built-in mesh"));
    (scene.width, scene.height) = (96, 72);
    let view = scene.camera.view();
    scene.lights[0].place = Place::Infinite(-view);
    let frame = scene.frame().expect("a frame");
    let normals = fastphong::raster::normals(&frame);
    let mut compared = 0;
    for entry in floats_on(&frame) {
        let picture = linear(entry, &frame);
        for (pixel, normal) in picture.pixels().iter().zip(normals.pixels()) {
            let n =
                DVec3::new(normal[0].into(), normal[1].into(), normal[2].into()) * 2.0 - DVec3::ONE;
            // These pixels are so far from the rim that no corner of their polygon, 4.5 degrees
            // wide, faces the light.
            if pixel[3] > 0.0 && (0.3..0.6).contains(&n.dot(view)) {
                assert_eq!(
                    pixel[..3],
                    Material::default().ambient,
                    "{}",
                    entry.info.name
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 1000, "{compared} pixels");
}

/// Without lights every method draws ambient light only.
#[test]
fn no_lights_means_ambient_only() {
    let frame = sphere(|scene| scene.lights.clear());
    for entry in floats_on(&frame) {
        for pixel in linear(entry, &frame).pixels().iter().filter(|t| t[3] > 0.0) {
            assert_eq!(
                pixel[..3],
                Material::default().ambient,
                "{}",
                entry.info.name
            );
        }
    }
}

/// Every way of rendering a frame stores the same picture on every run.
#[test]
fn stored_and_linear_pictures_agree() {
    let frame = sphere(|_| ());
    for entry in floats_on(&frame) {
        let stored = entry
            .variant()
            .render(&frame)
            .expect("a method for the frame");
        let linear = linear(entry, &frame);
        let rounded = linear.map(|pixel| pixel.map(fastphong::picture::encoding::quantise));
        assert_eq!(stored, rounded, "{}", entry.info.name);
        let mut reused = Picture::new(96, 72, [7u8; 4]);
        let drawn = entry
            .variant()
            .draw(&frame, &mut reused, DrawOptions::default());
        drawn.expect("a picture of the frame's size");
        assert_eq!(stored, reused, "{}", entry.info.name);
        assert_eq!(
            stored,
            entry
                .variant()
                .render(&frame)
                .expect("a method for the frame"),
            "{}",
            entry.info.name
        );
    }
}

/// With perspective interpolation on a near, wide view every method agrees with the reference. The
/// picture differs from the picture that is interpolated on the screen.
#[test]
fn perspective_interpolation_agrees_with_the_reference() {
    let near = |interpolation| {
        sphere(|scene| {
            scene.interpolation = interpolation;
            scene.camera.projection = fastphong::scene::Projection::Perspective { fovy: 100.0 };
            scene.camera.eye = scene.camera.target + scene.camera.view() * 1.4;
            (scene.camera.near, scene.camera.far) = (0.1, 3.0);
        })
    };
    let case = Case::new("", near(Interpolation::Perspective));
    let (space, screen) = (&case.frame, &near(Interpolation::Screen));
    for entry in floats_on(space) {
        let ours = linear(entry, space);
        let (max, _) = largest_difference(case.truth(entry.info.model), &ours, |_, _| true);
        let bound = entry.variant().bound(space);
        assert!(max <= bound, "{}: {max} over {bound}", entry.info.name);
    }
    let differs = |name: &str| {
        let (a, b) = (
            variant(name)
                .render_linear(space)
                .expect("a method for the frame"),
            variant(name)
                .render_linear(screen)
                .expect("a method for the frame"),
        );
        compare(&a, &b).expect("equal sizes").max
    };
    assert!(differs("gouraud") > 1e-3 && differs("naive-phong") > 1e-3);
    assert_eq!(differs("flat"), 0.0);
    assert_eq!(
        differs("slerp-phong"),
        0.0,
        "slerp stays linear on the screen"
    );
}

/// Scanline and barycentric interpolation agree on triangles (L21 3, Figure 6).
#[test]
fn barycentric_pictures_are_scanline_pictures_on_triangles() {
    let mut scene = Scene::of_mesh(
        builtin("sphere?rings=10&segments=20&triangles=true").expect("a built-in mesh"),
    );
    (scene.width, scene.height) = (96, 72);
    let frame = scene.frame().expect("a frame");
    let mut compared = Vec::new();
    for entry in floats_on(&frame) {
        let Some(theirs) = entry
            .variant()
            .render_barycentric_linear(&frame, Edges::TopLeft)
        else {
            continue;
        };
        let difference = compare(&theirs, &linear(entry, &frame)).expect("equal sizes");
        // Both pictures are within the bound of their closed forms, which are equal on triangles.
        assert!(
            difference.max <= 2.0 * entry.variant().bound(&frame),
            "{}: {}",
            entry.info.name,
            difference.max
        );
        assert_eq!(difference.coverage_mismatches, 0);
        compared.push(entry.info.name);
    }
    assert_eq!(
        compared,
        [
            "flat",
            "flat-average",
            "gouraud",
            "gouraud-separate",
            "naive-phong",
            "phong-rsqrt",
            "eye-frame-phong",
            "phong-unnormalised",
            "stereographic-phong",
            "quaternion-phong",
            "phong-map"
        ]
    );
}
