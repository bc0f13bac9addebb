//! Compares CS171's algorithms, as printed, with the engines and the reference. They share no
//! arithmetic.

use crate::support::{Random, frame, random_polygon};
use fastphong::frame::Frame;
use fastphong::frame::triangulate::triangulated;
use fastphong::mesh::Material;
use fastphong::mesh::builtin::builtin;
use fastphong::raster::{Edges, NO_POLYGON, barycentric_polygon_indices};
use fastphong::reference::cs171::{
    Inside, Raster, Reading, Shading, Ties, TriangleCorner, flat_shading, full_shading,
    gouraud_shading, lighting, ndc_to_screen, phong_shading, raster_colored_ndc_triangle,
    raster_colored_triangle, raster_triangle, render, world_to_ndc,
};
use fastphong::reference::{self, Model};
use fastphong::scene::{
    Culling, Falloff, Interpolation, Light, LightTerm, Lighting, Place, Scene, SpecularGate,
    SpecularModel,
};
use glam::{DVec2, DVec3};

/// Lights a scene as CS171 does: two coloured positional lights, one of them attenuated, N·H and no
/// gate.
fn lit(mut scene: Scene) -> Scene {
    (scene.width, scene.height) = (120, 90);
    scene.specular = SpecularModel::Blinn;
    scene.shininess_for = SpecularModel::Blinn;
    scene.gate = SpecularGate::Ungated;
    scene.local_viewer = true;
    scene.lights = vec![
        Light::positional(DVec3::new(2.0, 3.0, 4.0), [0.9, 0.8, 0.3]),
        Light::positional(DVec3::new(-4.0, 1.0, 2.0), [0.3, 0.5, 1.0])
            .with_falloff(Falloff::Attenuation(0.05)),
    ];
    scene
}

fn sphere(interpolation: Interpolation, culling: Culling) -> Frame {
    let mesh = builtin("sphere?rings=8&segments=13").expect("a built-in mesh");
    let mut scene = lit(Scene::of_mesh(mesh));
    (scene.interpolation, scene.culling) = (interpolation, culling);
    triangulated(&scene.frame().expect("a frame")).frame
}

/// Counts, for each pixel, the triangles that have its centre inside or on an edge.
fn closed_cover(frame: &Frame) -> Vec<u32> {
    let size = [frame.width(), frame.height()];
    let mut counts = vec![0; size[0] * size[1]];
    for polygon in frame.polygons() {
        let places = [0, 1, 2].map(|i| {
            let v = &frame.vertices()[frame.corners(polygon)[i] as usize];
            DVec2::new(v.x.to_num(), v.y.to_num())
        });
        raster_triangle(places, size, Inside::Closed, |x, y, _| {
            counts[y * size[0] + x] += 1
        });
    }
    counts
}

/// Algorithm 1 fills the same pixels as the barycentric renderer with closed edges, which decides
/// in exact integers.
#[test]
fn algorithm_1_covers_closed_triangles() {
    let mut random = Random::new(31);
    let (mut on_edges, mut filled) = (0, 0);
    for _ in 0..600 {
        let triangle = random_polygon(&mut random, 48, 40, 3);
        let frame = frame(48, 40, true, &[triangle]);
        let covered = closed_cover(&frame);
        let [closed, owned] =
            [Edges::Closed, Edges::TopLeft].map(|edges| barycentric_polygon_indices(&frame, edges));
        for (i, &count) in covered.iter().enumerate() {
            assert_eq!(
                count == 1,
                closed.pixels()[i] != NO_POLYGON,
                "at {}, {}",
                i % 48,
                i / 48
            );
            on_edges += usize::from(closed.pixels()[i] != owned.pixels()[i]);
            filled += count;
        }
    }
    assert!(
        filled > 20_000 && on_edges > 100,
        "{filled} pixels, {on_edges} on edges"
    );
}

/// With open intervals, (0, 1), as in the text, an edge between two triangles is a hole. With
/// closed intervals, [0, 1], as in the algorithms, it is drawn twice and the second triangle's
/// colour stays.
#[test]
fn shared_edges_are_holes_or_drawn_twice() {
    let place = |x: f64, y: f64| DVec2::new(x + 0.5, y + 0.5);
    let square = [
        [place(0.0, 0.0), place(4.0, 0.0), place(4.0, 4.0)],
        [place(0.0, 0.0), place(4.0, 4.0), place(0.0, 4.0)],
    ];
    for (inside, expected) in [(Inside::Closed, (20, 5)), (Inside::Open, (6, 0))] {
        let mut counts = [0; 25];
        for triangle in square {
            raster_triangle(triangle, [5, 5], inside, |x, y, _| counts[5 * y + x] += 1);
        }
        let (once, twice) = (
            counts.iter().filter(|c| **c == 1).count(),
            counts.iter().filter(|c| **c == 2).count(),
        );
        assert_eq!((once, twice), expected, "{inside:?}");
    }
    let mut grid = Raster::new(5, 5, DVec3::ZERO);
    for (triangle, colour) in square.into_iter().zip([DVec3::X, DVec3::Y]) {
        raster_colored_triangle(triangle, [colour; 3], Inside::Closed, &mut grid);
    }
    assert_eq!(
        grid.colours.get(2, 2),
        [0.0, 1.0, 0.0, 1.0],
        "the diagonal is the second triangle's"
    );
}

/// Algorithm 2 blends CS171's right triangle from red along the hypotenuse to blue at the opposite
/// corner.
#[test]
fn algorithm_2_mixes_red_and_blue() {
    let mut grid = Raster::new(9, 9, DVec3::ZERO);
    // The right angle is at pixel (0, 8), the hypotenuse runs from (0, 0) to (8, 8).
    let places = [
        DVec2::new(0.5, 0.5),
        DVec2::new(8.5, 8.5),
        DVec2::new(0.5, 8.5),
    ];
    raster_colored_triangle(
        places,
        [DVec3::X, DVec3::X, DVec3::Z],
        Inside::Closed,
        &mut grid,
    );
    for (x, y) in (0..9).flat_map(|y| (0..9).map(move |x| (x, y))) {
        // Blue is the distance from the hypotenuse divided by the opposite corner's distance.
        // Eighths are exact.
        let blue = (y as f64 - x as f64) / 8.0;
        let expected = if blue >= 0.0 {
            [1.0 - blue, 0.0, blue, 1.0]
        } else {
            [0.0; 4]
        };
        assert_eq!(grid.colours.get(x, y), expected, "at {x}, {y}");
    }
}

fn white(place: Place<[f32; 3]>, diffuse: f32, specular: f32) -> LightTerm {
    LightTerm {
        place,
        diffuse: [diffuse; 3],
        specular: [specular; 3],
        falloff: Falloff::None,
    }
}

/// Algorithm 3 returns the results that are worked out by hand here.
#[test]
fn algorithm_3_returns_the_results_worked_out_by_hand() {
    let mut light = Lighting::new(&Material::default(), [0.0; 3], &[], DVec3::Z);
    light.ambient = [0.125, 0.0, 0.25];
    light.view = Place::Local([0.0, 0.0, 5.0]);
    light.specular = SpecularModel::Blinn;
    light.gate = SpecularGate::Ungated;
    light.shininess = 2.0;
    // The light is straight above: n · l = n · h = 1.
    light.lights = vec![white(Place::Local([0.0, 0.0, 3.0]), 0.25, 0.5)];
    assert_eq!(
        lighting(DVec3::ZERO, DVec3::Z, &light),
        DVec3::new(0.875, 0.75, 1.0)
    );
    // A second light is added. The sum is clamped once, at the end.
    light
        .lights
        .push(white(Place::Local([0.0, 0.0, 9.0]), 0.125, 0.0));
    assert_eq!(
        lighting(DVec3::ZERO, DVec3::Z, &light),
        DVec3::new(1.0, 0.875, 1.0)
    );
    // At distance 3 a light with k = 1/9 has half its strength in both terms. Ambient light is not
    // attenuated.
    light.lights = vec![LightTerm {
        falloff: Falloff::Attenuation(1.0 / 9.0),
        ..white(Place::Local([0.0, 0.0, 3.0]), 0.25, 0.5)
    }];
    // 1/9 is rounded to f32, so the strength is off by ¼ of 2⁻²⁴.
    assert!(
        (lighting(DVec3::ZERO, DVec3::Z, &light) - DVec3::new(0.5, 0.375, 0.625))
            .abs()
            .max_element()
            < 2e-8
    );
    // l points toward −x and e toward +x: e + l = 0, so there is no h and no highlight. n · l = 0.
    light.view = Place::Local([5.0, 0.0, 0.0]);
    light.lights = vec![white(Place::Local([-3.0, 0.0, 0.0]), 1.0, 1.0)];
    assert_eq!(
        lighting(DVec3::ZERO, DVec3::Z, &light),
        DVec3::new(0.125, 0.0, 0.25)
    );
    // The light is behind the surface and the eye is low: n · l < 0 and n · h > 0. As printed there
    // is a highlight.
    light.view = Place::Local([1.0, 0.0, 1.0]);
    light.lights = vec![white(Place::Local([1.0, 0.0, -0.5]), 0.0, 1.0)];
    assert!(lighting(DVec3::ZERO, DVec3::Z, &light).y > 0.01);
    light.gate = SpecularGate::Gated;
    assert_eq!(lighting(DVec3::ZERO, DVec3::Z, &light).y, 0.0);
}

/// A larger exponent gives a smaller highlight. The lecture's "Very shiny … p value close to 1" is
/// the wrong way round.
#[test]
fn large_exponents_are_the_shiny_ones() {
    let bright = |shininess: f32| {
        let mut light = Lighting::new(&Material::default(), [0.0; 3], &[], DVec3::Z);
        light.specular = SpecularModel::Blinn;
        light.lights = vec![white(Place::Infinite([0.0, 0.0, 1.0]), 0.0, 1.0)];
        light.shininess = shininess;
        (0..90)
            .filter(|&k| {
                let angle = (f64::from(k) + 0.5).to_radians();
                lighting(
                    DVec3::ZERO,
                    DVec3::new(angle.sin(), 0.0, angle.cos()),
                    &light,
                )
                .x > 0.5
            })
            .count()
    };
    // cos^p ψ > ½ holds up to ψ = arccos 2^(−1/p): 60°, 21.1°, 6.7°.
    assert_eq!([1.0, 10.0, 100.0].map(bright), [60, 21, 7]);
}

/// Returns the largest difference of colours at pixels covered by exactly one triangle, and the
/// count of these pixels. Asserts that all other pixels are empty in both pictures or lie on an
/// edge.
fn differ(frame: &Frame, shading: Shading, model: Model) -> (f64, usize) {
    let ours = render(frame, shading, Reading::default()).colours;
    let truth = reference::render(frame, model).picture;
    let (mut worst, mut pixels) = (0.0f64, 0);
    for ((&count, a), b) in closed_cover(frame)
        .iter()
        .zip(ours.pixels())
        .zip(truth.pixels())
    {
        match count {
            0 => assert_eq!((a[3], b[3]), (0.0, 0.0)),
            1 => {
                assert_eq!(a[3], 1.0);
                // The reference leaves the background on outline pixels that no triangle owns.
                if b[3] == 1.0 {
                    worst = a
                        .iter()
                        .zip(b)
                        .fold(worst, |worst, (a, b)| worst.max((a - b).abs()));
                    pixels += 1;
                }
            }
            _ => assert_eq!(a[3], 1.0),
        }
    }
    (worst, pixels)
}

/// Algorithm 8 agrees with the reference in all three shadings. The two compute coordinates and
/// illumination differently.
#[test]
fn algorithm_8_agrees_with_the_reference() {
    for interpolation in [Interpolation::Screen, Interpolation::Perspective] {
        let frame = sphere(interpolation, Culling::Back);
        for (shading, model) in [
            (Shading::Flat, Model::FlatAverage),
            (Shading::Gouraud, Model::Gouraud),
            (Shading::Phong, Model::Phong),
        ] {
            let (worst, pixels) = differ(&frame, shading, model);
            // Each of the two rounds about ten times for a weight, ten for a normal, ten for a
            // position and ten for a cosine: forty half-ulps. The power of 32 multiplies the error
            // of a cosine by 32. Two lights of at most 1 add diffuse and specular terms. Bound: 2 ·
            // 2 · 40 · 32 half-ulps.
            assert!(
                worst <= 2.0 * 2.0 * 40.0 * 32.0 * f64::EPSILON,
                "{shading:?}, {interpolation:?}: {worst}"
            );
            assert!(pixels > 3000, "{pixels}");
        }
    }
}

/// Algorithm 7 as printed shades with normals that are not unit vectors. Its pictures are darker,
/// mostly at highlights.
#[test]
fn algorithm_7_as_printed_is_darker() {
    let frame = sphere(Interpolation::Screen, Culling::Back);
    let [unit, raw] = [true, false].map(|normalise| {
        render(
            &frame,
            Shading::Phong,
            Reading {
                normalise,
                ..Reading::default()
            },
        )
        .colours
    });
    let sum = |c: [f64; 4]| c[0] + c[1] + c[2];
    let (mut darker, mut most) = (0, 0.0f64);
    for (a, b) in unit.pixels().iter().zip(raw.pixels()) {
        assert!(
            sum(*b) <= sum(*a) + 1e-12,
            "a shorter normal lights no pixel more"
        );
        darker += usize::from(sum(*b) < sum(*a) - 1e-3);
        most = most.max(sum(*a) - sum(*b));
    }
    assert!(
        darker > 1000 && most > 0.05,
        "{darker} pixels, by up to {most}"
    );
}

/// By its cross product Algorithm 8 culls the same triangles as the frame's culling does.
#[test]
fn algorithm_8_culls_back_faces() {
    let (front, all) = (
        sphere(Interpolation::Screen, Culling::Back),
        sphere(Interpolation::Screen, Culling::None),
    );
    assert!(all.polygons().len() > front.polygons().len() + 50);
    let picture = |frame: &Frame, cull| {
        render(
            frame,
            Shading::Gouraud,
            Reading {
                cull,
                ..Reading::default()
            },
        )
        .colours
    };
    assert_eq!(picture(&all, true), picture(&front, true));
    // The depth test by itself would hide all back faces except those at the rim.
    let other = picture(&all, false)
        .pixels()
        .iter()
        .zip(picture(&front, true).pixels())
        .filter(|(a, b)| a != b)
        .count();
    assert!(other < 400, "{other}");
    // From inside only back faces are visible, so culling leaves nothing.
    let inside = sphere(Interpolation::Screen, Culling::Front);
    assert!(picture(&inside, true).pixels().iter().all(|t| t[3] == 0.0));
    assert!(picture(&inside, false).pixels().iter().any(|t| t[3] == 1.0));
}

fn corner(x: f64, y: f64, z: f64) -> TriangleCorner {
    TriangleCorner {
        world: DVec3::new(x, y, z),
        normal: DVec3::Z,
        ndc: DVec3::new(x, y, z),
        inv_w: 1.0,
    }
}

/// Returns a lighting whose colour is the diffuse coefficient.
fn plain(diffuse: f32) -> Lighting {
    let mut light = Lighting::new(&Material::default(), [0.0; 3], &[], DVec3::Z);
    light.lights = vec![white(Place::Infinite([0.0, 0.0, 1.0]), diffuse, 0.0)];
    light
}

/// At equal depths Algorithm 8 as printed keeps the later triangle. With the text's "less than" it
/// keeps the earlier one.
#[test]
fn ties_go_to_the_later_or_earlier_triangle() {
    let triangle = [
        corner(-0.9, -0.9, 0.0),
        corner(0.9, -0.9, 0.0),
        corner(0.0, 0.9, 0.0),
    ];
    let nearer = triangle.map(|c| corner(c.ndc.x, c.ndc.y, -0.5));
    for (ties, seen) in [(Ties::Later, 0.75), (Ties::Earlier, 0.25)] {
        let mut grid = Raster::new(16, 16, DVec3::ZERO);
        let reading = Reading {
            ties,
            ..Reading::default()
        };
        for diffuse in [0.25, 0.75] {
            full_shading(
                Shading::Flat,
                &triangle,
                &plain(diffuse),
                reading,
                &mut grid,
            );
        }
        assert_eq!(grid.colours.get(8, 8)[0], seen, "{ties:?}");
        // A nearer triangle wins in both readings, and a farther one then loses.
        for (triangle, diffuse) in [(&nearer, 0.5), (&triangle, 0.125)] {
            full_shading(Shading::Flat, triangle, &plain(diffuse), reading, &mut grid);
        }
        assert_eq!(grid.colours.get(8, 8)[0], 0.5, "{ties:?}");
        assert_eq!(grid.buffer.get(8, 8), -0.5);
    }
    // Without a depth buffer the later triangle wins at any depth.
    let mut grid = Raster::new(16, 16, DVec3::ZERO);
    for (triangle, diffuse) in [(&nearer, 0.5), (&triangle, 0.125)] {
        flat_shading(triangle, &plain(diffuse), Reading::default(), &mut grid);
    }
    assert_eq!(grid.colours.get(8, 8)[0], 0.125);
}

/// Algorithm 5 draws exactly the part of a triangle that is inside the cube.
#[test]
fn algorithm_5_draws_inside_the_cube() {
    // Depth grows by 4 from left to right. The middle half, columns 4 to 11, is inside the cube.
    let depth = |x: f64| 2.0 * x;
    let triangle = [(-1.0, -3.0), (1.0, -3.0), (0.0, 3.0)].map(|(x, y)| corner(x, y, depth(x)));
    let mut grid = Raster::new(16, 16, DVec3::ZERO);
    raster_colored_ndc_triangle(&triangle, [DVec3::ONE; 3], Reading::default(), &mut grid);
    for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
        let ndc = DVec2::new((x as f64 + 0.5) / 8.0 - 1.0, 1.0 - (y as f64 + 0.5) / 8.0);
        // The triangle's sides run from x = −1 + (y + 3)/6 to x = 1 − (y + 3)/6.
        let is_in = ndc.x.abs() <= 1.0 - (ndc.y + 3.0) / 6.0 && depth(ndc.x).abs() <= 1.0;
        assert_eq!(grid.colours.get(x, y)[3] == 1.0, is_in, "at {x}, {y}");
    }
}

/// Algorithms 4, 6 and 7 draw a single front-facing triangle as Algorithm 8 does. They draw back
/// faces too.
#[test]
fn algorithms_4_6_and_7_are_algorithm_8_without_hidden_surfaces() {
    let scene = lit(Scene::of_mesh(builtin("cube").expect("a built-in mesh")));
    let matrix = scene.camera.clip_matrix(120.0 / 90.0);
    let light = &scene.frame().expect("a frame").lightings()[0].clone();
    let (right, up) = (scene.camera.axes()[0], scene.camera.axes()[1]);
    let corners = [(-0.4, -0.3), (0.5, -0.4), (0.1, 0.6)].map(|(x, y)| {
        let v = scene.camera.target + right * x + up * y;
        let normal = (scene.camera.view() + right * x).normalize();
        TriangleCorner {
            world: v - scene.camera.eye,
            normal,
            ndc: world_to_ndc(&matrix, v),
            inv_w: 1.0,
        }
    });
    let reading = Reading::default();
    type Algorithm = fn(&[TriangleCorner; 3], &Lighting, Reading, &mut Raster);
    let all: [(Shading, Algorithm); 3] = [
        (Shading::Gouraud, gouraud_shading),
        (Shading::Flat, flat_shading),
        (Shading::Phong, phong_shading),
    ];
    for (shading, algorithm) in all {
        let [mut bare, mut full, mut back] = [(); 3].map(|()| Raster::new(120, 90, DVec3::ZERO));
        algorithm(&corners, light, reading, &mut bare);
        full_shading(shading, &corners, light, reading, &mut full);
        assert_eq!(bare.colours, full.colours, "{shading:?}");
        assert!(bare.colours.pixels().iter().filter(|t| t[3] == 1.0).count() > 200);
        let turned = [corners[2], corners[1], corners[0]];
        full_shading(shading, &turned, light, reading, &mut back);
        assert!(
            back.colours.pixels().iter().all(|t| t[3] == 0.0),
            "{shading:?}: culled"
        );
        algorithm(&turned, light, reading, &mut back);
        assert!(
            back.colours.pixels().iter().any(|t| t[3] == 1.0),
            "{shading:?}: as printed, drawn"
        );
    }
}

/// Triangles without area pass the test `cross.z < 0`, but they fill no pixel and produce no NaN.
#[test]
fn triangles_without_area_draw_nothing() {
    let line = [
        corner(-0.5, -0.5, 0.0),
        corner(0.0, 0.0, 0.0),
        corner(0.5, 0.5, 0.0),
    ];
    let point = [corner(0.0625, 0.0625, 0.0); 3];
    for triangle in [line, point] {
        let mut grid = Raster::new(16, 16, DVec3::ZERO);
        for shading in [Shading::Flat, Shading::Gouraud, Shading::Phong] {
            full_shading(
                shading,
                &triangle,
                &plain(1.0),
                Reading::default(),
                &mut grid,
            );
        }
        assert!(grid.colours.pixels().iter().all(|t| *t == [0.0; 4]));
        let places = triangle.map(|corner| ndc_to_screen(corner.ndc, [16, 16]));
        raster_triangle(places, [16, 16], Inside::Closed, |x, y, _| {
            panic!("{x}, {y} is filled")
        });
    }
}

/// Transforming from world to NDC to screen gives the frame's vertex coordinates to the sub-pixel.
#[test]
fn screen_coordinates_agree_with_the_frame() {
    let scene = lit(Scene::of_mesh(builtin("cube").expect("a built-in mesh")));
    let frame = scene.frame().expect("a frame");
    let matrix = scene.camera.clip_matrix(120.0 / 90.0);
    for (number, v) in (0..).zip(frame.vertices()) {
        let world = scene.camera.eye + DVec3::from_array(frame.position(number).map(f64::from));
        let place = ndc_to_screen(world_to_ndc(&matrix, world), [120, 90]);
        // Positions are rounded to f32: 2⁻²⁴ of some 5 units, each some 50 pixels, is a
        // ten-thousandth of a sub-pixel. That can still turn the rounding to the next sub-pixel.
        assert!(
            (place - DVec2::new(v.x.to_num(), v.y.to_num()))
                .abs()
                .max_element()
                <= 1.0 / 256.0
        );
    }
    assert!(frame.vertices().len() > 6);
}
