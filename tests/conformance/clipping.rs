//! Clipping of polygons that reach behind the eye, through the near plane, or far outside the
//! picture.

use crate::support::{floats_on, linear};
use fastphong::frame::{Frame, FrameError};
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::mesh::{GivenNormals, Material, MeshBuilder, PolygonMesh};
use fastphong::raster;
use fastphong::scene::{Camera, Culling, Interpolation, Light, Object, Projection, Scene};
use fastphong::shading::Variant;
use glam::{DAffine3, DVec3, Vec3};

fn scene(mesh: PolygonMesh, camera: Camera) -> Scene {
    let material = Material {
        ambient: [0.0; 3],
        diffuse: [1.0; 3],
        specular: [0.0; 3],
        shininess: 1.0,
    };
    let mut object = Object::new(mesh);
    object.material = Some(material);
    object.normals = NormalSource::Given.into();
    let mut scene = Scene::new(camera);
    (scene.width, scene.height) = (80, 60);
    scene.ambient = [0.0; 3];
    scene.lights = vec![Light::directional(DVec3::Z, [1.0; 3])];
    scene.interpolation = Interpolation::Perspective;
    scene.culling = Culling::None;
    scene.objects = vec![object];
    scene
}

/// Returns a camera one unit above the plane y = 0 that looks along −z and slightly downward.
fn above_ground(near: f64) -> Camera {
    let (eye, target) = (DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.0, 0.7, -1.0));
    let mut camera = Camera::looking_at(eye, target, Projection::Perspective { fovy: 60.0 });
    (camera.near, camera.far) = (near, 1e4);
    camera
}

/// Returns a normal with intensity `i` under the light along z.
fn normal(i: f64) -> Vec3 {
    DVec3::new((1.0 - i * i).sqrt(), 0.0, i).as_vec3()
}

/// Builds a ground of `n` × `n` quads over −r..r in x and z. Intensity grows linearly with x and z
/// from 0.1 to 0.9.
fn ground(n: usize, r: f64) -> PolygonMesh {
    let at = |i: usize, j: usize| {
        let (u, v) = (i as f64 / n as f64, j as f64 / n as f64);
        (
            Vec3::new(
                (r * (2.0 * u - 1.0)) as f32,
                0.0,
                (r * (2.0 * v - 1.0)) as f32,
            ),
            normal(0.1 + 0.4 * u + 0.4 * v),
        )
    };
    let all: Vec<(Vec3, Vec3)> = (0..=n)
        .flat_map(|j| (0..=n).map(move |i| at(i, j)))
        .collect();
    let mut builder = MeshBuilder::new(all.iter().map(|a| a.0).collect());
    let index = |i: usize, j: usize| (j * (n + 1) + i) as u32;
    for j in 0..n {
        for i in 0..n {
            builder.polygon(&[
                index(i, j),
                index(i, j + 1),
                index(i + 1, j + 1),
                index(i + 1, j),
            ]);
        }
    }
    builder.normals(GivenNormals {
        values: all.iter().map(|a| a.1).collect(),
        corners: None,
    });
    builder.finish().expect("a mesh")
}

fn covered_once(frame: &Frame) -> Vec<u32> {
    let mut counts = vec![0; frame.width() * frame.height()];
    raster::coverage(frame, |_, row, pixels| {
        pixels.for_each(|x| counts[row * frame.width() + x] += 1)
    });
    counts
}

/// Returns the point (x, z) where a pixel's ray meets the ground, or `None` if it points above the
/// horizon.
fn ground_at(camera: &Camera, x: usize, y: usize) -> Option<(f64, f64)> {
    let [right, up, forward] = camera.axes();
    let Projection::Perspective { fovy } = camera.projection else {
        return None;
    };
    let scale = (fovy.to_radians() / 2.0).tan();
    let ray = forward
        + right * ((x as f64 + 0.5) / 40.0 - 1.0) * scale * 80.0 / 60.0
        + up * (1.0 - (y as f64 + 0.5) / 30.0) * scale;
    let t = -camera.eye.y / ray.y;
    (t > 0.0).then_some((ray.x * t, camera.eye.z + ray.z * t))
}

/// A quad under and behind the eye has the linear colour of the ground where each ray meets it.
/// This covers near-plane clipping, the guard band, attribute clipping and perspective
/// interpolation.
#[test]
fn ground_under_the_eye_has_the_colours_of_the_rays() {
    for (cells, r, near) in [
        (1, 50.0, 0.1),
        (1, 5000.0, 0.5),
        (7, 50.0, 0.01),
        (1, 50.0, 1.3),
    ] {
        let camera = above_ground(near);
        let frame = scene(ground(cells, r), camera).frame().expect("a frame");
        assert!(frame.stats().clipped > 0);
        let picture = Variant::parse("gouraud")
            .expect("a method")
            .render_linear(&frame)
            .expect("a method for the frame");
        let mut compared = 0;
        for (x, y) in (0..60).flat_map(|y| (0..80).map(move |x| (x, y))) {
            let Some((gx, gz)) = ground_at(&camera, x, y) else {
                assert_eq!(picture.get(x, y)[3], 0.0, "sky at {x}, {y}");
                continue;
            };
            let depth = (DVec3::new(gx, 0.0, gz) - camera.eye).dot(camera.axes()[2]);
            let margin = 0.9 * r;
            if gx.abs() > margin || gz.abs() > margin || depth < near * 1.1 {
                continue;
            }
            let truth = 0.1 + 0.4 * (gx / r + 1.0) / 2.0 + 0.4 * (gz / r + 1.0) / 2.0;
            let found = f64::from(picture.get(x, y)[0]);
            // Corners are snapped to 1/256 pixel, so they are off by up to half of that in x and y.
            // Pixels near the horizon are long on the ground: one row below it the distance changes
            // by half of itself. So rays are compared only where the ground moves by at most a
            // twentieth of its distance per pixel, and 1/512 pixel is 1e-4 of it. Intensity varies
            // by 0.8.
            let step = ground_at(&camera, x, y + 1)
                .map_or(f64::INFINITY, |(bx, bz)| (bx - gx).hypot(bz - gz));
            if step > r / 10.0 {
                continue;
            }
            assert_eq!(
                picture.get(x, y)[3],
                1.0,
                "a hole at {x}, {y} ({cells} cells, near {near})"
            );
            assert!(
                (found - truth).abs() <= 4e-4,
                "{found} is not {truth} at {x}, {y} ({cells} cells, near {near})"
            );
            compared += 1;
        }
        assert!(compared > 800, "{compared} rays");
    }
}

/// Neighbouring cells still share their edges after clipping: no pixel is drawn twice and none
/// below the horizon is missed.
#[test]
fn clipped_neighbours_leave_no_hole_and_no_overlap() {
    let camera = above_ground(0.05);
    let whole = covered_once(&scene(ground(1, 60.0), camera).frame().expect("a frame"));
    for cells in [2, 5, 16] {
        let counts = covered_once(&scene(ground(cells, 60.0), camera).frame().expect("a frame"));
        assert!(
            counts.iter().all(|&c| c <= 1),
            "{cells} cells: a pixel is drawn twice"
        );
        // Only rim pixels may differ. There the same edge is cut into pieces whose ends are
        // snapped.
        let differing = counts.iter().zip(&whole).filter(|(a, b)| a != b).count();
        assert!(
            differing <= 80,
            "{cells} cells: {differing} pixels differ from the whole ground"
        );
        assert!(counts.iter().sum::<u32>() > 2000);
    }
}

/// Clipping by the far plane keeps varyings that are linear on screen: the rest of the triangle has
/// the colours of the whole.
#[test]
fn a_cut_triangle_has_the_colours_of_the_whole_on_the_screen() {
    let corners = [
        Vec3::new(-2.0, 0.0, -3.0),
        Vec3::new(2.0, 0.0, -3.0),
        Vec3::new(0.5, 0.0, -60.0),
    ];
    let mut builder = MeshBuilder::new(corners.to_vec());
    builder.polygon(&[0, 1, 2]).normals(GivenNormals {
        values: [0.2, 0.5, 1.0].map(normal).to_vec(),
        corners: None,
    });
    let mesh = builder.finish().expect("a mesh");
    let draw = |far: f64| {
        let mut scene = scene(mesh.clone(), above_ground(0.1));
        scene.camera.far = far;
        scene.interpolation = Interpolation::Screen;
        let frame = scene.frame().expect("a frame");
        (
            frame.stats().clipped,
            Variant::parse("gouraud")
                .expect("a method")
                .render_linear(&frame)
                .expect("a method for the frame"),
        )
    };
    let ((uncut, whole), (cut, part)) = (draw(100.0), draw(20.0));
    assert_eq!((uncut, cut), (0, 1));
    let mut compared = 0;
    for (a, b) in whole
        .pixels()
        .iter()
        .zip(part.pixels())
        .filter(|(_, b)| b[3] > 0.0)
    {
        // New corners are snapped to 1/256 pixel, so they are off by up to half of that.
        // Intensities change by 0.8 over about 20 rows.
        assert!(
            (a[0] - b[0]).abs() < 0.8 / 20.0 / 256.0 + 1e-5,
            "{a:?} became {b:?}"
        );
        compared += 1;
    }
    assert!(
        compared > 300 && whole.pixels().iter().filter(|t| t[3] > 0.0).count() > compared,
        "{compared} pixels"
    );
}

/// Clipping a concave comb's teeth at the near plane leaves separate pieces that do not touch.
#[test]
fn a_comb_is_cut_into_its_teeth() {
    // The teeth point at the viewer. Either the bar is beyond the plane and the tips are in front
    // of it, or the reverse.
    let teeth = 4;
    for bar_in_front in [true, false] {
        let mut outline = vec![Vec3::new(-4.0, 0.0, -6.0), Vec3::new(-4.0, 0.0, -3.0)];
        for tooth in 0..teeth {
            let x = -4.0 + 2.0 * tooth as f32;
            outline.extend([
                Vec3::new(x, 0.0, 2.0),
                Vec3::new(x + 1.0, 0.0, 2.0),
                Vec3::new(x + 1.0, 0.0, -3.0),
            ]);
            if tooth + 1 < teeth {
                outline.push(Vec3::new(x + 2.0, 0.0, -3.0));
            }
        }
        outline.push(Vec3::new(3.0, 0.0, -6.0));
        let corners: Vec<u32> = (0..outline.len() as u32).collect();
        let mut builder = MeshBuilder::new(outline);
        builder.polygon(&corners);
        let mesh = builder.finish().expect("a mesh");
        let mut scene = scene(mesh, above_ground(0.1));
        scene.objects[0].normals = NormalSource::Averaged.into();
        if !bar_in_front {
            // From the other side the tips are in front and the bar is behind the eye.
            scene.camera.eye.z = -2.5;
            scene.camera.target = DVec3::new(0.0, 0.7, -1.5);
        }
        let frame = scene.frame().expect("a frame");
        assert_eq!(
            frame.polygons().len(),
            if bar_in_front { 1 } else { teeth },
            "pieces"
        );
        assert!(
            covered_once(&frame).iter().all(|&c| c <= 1),
            "pieces overlap"
        );
    }
}

/// Extreme positions never panic: the eye inside the mesh, polygons through the eye plane, corners
/// at the eye, and huge coordinates.
#[test]
fn extreme_positions_never_panic() {
    for scale in [1e-6, 1.0, 1e6, 1e14] {
        for eye in [
            DVec3::new(0.1, 0.2, 0.0),
            DVec3::new(1.0, 0.0, 0.0),
            DVec3::ZERO,
        ] {
            let mesh = fastphong::mesh::builtin::builtin("torus?segments=12&sides=8")
                .expect("a built-in mesh");
            let mut camera = above_ground(1e-3 * scale);
            (camera.eye, camera.target) = (
                eye * scale,
                eye * scale + DVec3::new(0.3, 0.1, -1.0) * scale,
            );
            camera.far = 1e3 * scale;
            let mut scene = scene(mesh, camera);
            scene.objects[0].transform = DAffine3::from_scale(DVec3::splat(scale));
            let frame = scene.frame().expect("a frame");
            for entry in floats_on(&frame) {
                let picture = linear(entry, &frame);
                assert!(
                    picture
                        .pixels()
                        .iter()
                        .all(|t| t.iter().all(|c| (0.0..=1.0).contains(c)))
                );
            }
            fastphong::reference::render(&frame, fastphong::reference::Model::Phong);
        }
    }
}

/// From inside a closed mesh every pixel is covered exactly once in any direction. With back-face
/// culling nothing is covered.
#[test]
fn inside_a_closed_mesh_every_pixel_is_covered_once() {
    let mut clipped = 0;
    for spec in [
        "sphere?rings=12&segments=24",
        "cube",
        "sphere?polygons=3000&triangles=true",
    ] {
        for (eye, direction) in [
            (DVec3::ZERO, DVec3::new(0.1, 0.2, -1.0)),
            (DVec3::new(0.3, -0.2, 0.1), DVec3::new(1.0, 0.0, 0.0)),
            (DVec3::new(-0.1, 0.1, 0.3), DVec3::new(-0.5, -1.0, 0.4)),
        ] {
            let mesh = fastphong::mesh::builtin::builtin(spec).expect("a built-in mesh");
            let mut scene = scene(mesh, above_ground(1e-3));
            (scene.camera.eye, scene.camera.target) = (eye, eye + direction);
            let frame = scene.frame().expect("a frame");
            clipped += frame.stats().clipped;
            assert!(
                covered_once(&frame).iter().all(|&c| c == 1),
                "{spec} from {eye} along {direction}"
            );
            scene.culling = Culling::Back;
            assert!(
                covered_once(&scene.frame().expect("a frame"))
                    .iter()
                    .all(|&c| c == 0),
                "{spec}: only insides"
            );
        }
    }
    assert!(clipped > 0, "polygons that are seen reach behind the eye");
}

/// Returns the frame of one polygon with the given corners, seen orthographically from +z at a
/// scale of 1.
fn one_polygon(corners: &[[f32; 3]], change: impl FnOnce(&mut Scene)) -> Frame {
    let mut scene = scene_of_one(corners);
    change(&mut scene);
    scene.frame().expect("a frame")
}

fn scene_of_one(corners: &[[f32; 3]]) -> Scene {
    let positions = corners.iter().map(|&c| Vec3::from_array(c)).collect();
    let mut builder = MeshBuilder::new(positions);
    let all: Vec<u32> = (0..corners.len() as u32).collect();
    builder.polygon(&all);
    let projection = Projection::Orthographic { half_height: 1.0 };
    let mut camera = Camera::looking_at(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, projection);
    (camera.near, camera.far) = (1.0, 9.0);
    let mut scene = scene(builder.finish().expect("a mesh"), camera);
    (scene.width, scene.height) = (640, 480);
    scene
}

/// One plane of the guard band cuts a polygon, and the rest lies beyond the next plane, although
/// the polygon is not outside any single plane of the view.
#[test]
fn a_polygon_that_two_planes_cut_away_together_is_outside() {
    let triangle = [
        [-200.0, 0.0, 0.0],
        [-200.0, -200.0, 0.0],
        [0.0, -200.0, 0.0],
    ];
    for samples in [1, 8] {
        let frame = one_polygon(&triangle, |scene| scene.samples = samples);
        let stats = frame.stats();
        assert_eq!((stats.outside, stats.clipped), (1, 0), "{samples}");
        assert_eq!(frame.polygons().len(), 0);
    }
}

/// A polygon is behind the near plane and touches it with a corner or an edge: nothing is inside.
#[test]
fn a_polygon_that_touches_the_near_plane_from_behind_is_outside() {
    for other in [[0.0, 0.5, 5.5], [0.0, 0.5, 4.0]] {
        // z = 4 is the near plane.
        let frame = one_polygon(&[[-0.5, 0.0, 4.0], [0.5, 0.0, 5.5], other], |_| ());
        let stats = frame.stats();
        assert_eq!((stats.outside, stats.clipped), (1, 0), "{other:?}");
        assert_eq!(frame.polygons().len(), 0);
    }
}

/// Each polygon is counted once, no matter how near or far its corners are, and how wide the guard
/// band of the picture is.
#[test]
fn every_polygon_around_the_eye_is_counted_once() {
    // A linear congruential generator (Knuth).
    let mut state = 29u64;
    let mut below = |n: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) % n
    };
    let mut cut = 0;
    for round in 0..3000 {
        let (reach, count) = ([1.0, 30.0, 1e4][round % 3], 3 + below(4));
        let corners: Vec<[f32; 3]> = (0..count)
            .map(|_| [0; 3].map(|_| reach * (below(9) as f32 - 4.0)))
            .collect();
        let (side, samples) = [(64, 1), (2048, 4), (2048, 8)][round / 3 % 3];
        let frame = one_polygon(&corners, |scene| {
            (scene.width, scene.height, scene.samples) = (side, side, samples);
            if round % 2 == 0 {
                scene.camera.projection = Projection::Perspective { fovy: 90.0 };
                scene.camera.near = 1e-3;
            }
        });
        let s = frame.stats();
        let left_out = s.no_area + s.cancelling + s.outside;
        // Each piece of a cut polygon may be drawn, or be seen edge-on.
        let shown = frame.polygons().len() + s.edge_on;
        assert!(left_out + s.clipped <= 1, "{corners:?}: {s:?}");
        match (left_out, s.clipped) {
            (1, _) => assert_eq!(shown, 0, "{corners:?}: {s:?}"),
            (_, 1) => assert!(shown >= 1, "{corners:?}: {s:?}"),
            _ => assert_eq!(shown, 1, "{corners:?}: {s:?}"),
        }
        assert!(frame.polygons().iter().all(|polygon| polygon.count >= 3));
        cut += s.clipped;
    }
    assert!(cut > 300, "{cut}");
}

/// Perspective weights are relative to the nearest vertex. So a near plane very close to the eye
/// neither rounds them to 0 nor leaves a polygon out.
#[test]
fn cuts_have_positive_weights_however_close_the_near_plane_is() {
    // Two corners are beyond the guard band, so only cuts have a weight. The least near/w is 10⁻⁷⁶,
    // 10⁻⁴⁸ or 10⁻⁴², and the least positive `f32` is 1.4·10⁻⁴⁵.
    let corners = [[0.0, -1.0, 4.0], [9e7, 0.0, -1e6], [-9e7, 0.0, -1e6]];
    for near in [1e-70, 1e-42, 1e-36] {
        let frame = one_polygon(&corners, |scene| {
            scene.camera.projection = Projection::Perspective { fovy: 90.0 };
            (scene.camera.near, scene.camera.far) = (near, 1e8);
            scene.interpolation = Interpolation::Perspective;
        });
        assert_eq!(frame.stats().unprojected, 0, "{near}");
        assert_eq!(frame.polygons().len(), 1, "{near}");
        let drawn = frame.polygons().iter().flat_map(|p| frame.corners(p));
        for &vertex in drawn {
            assert!(frame.vertices()[vertex as usize].inv_w > 0.0, "{near}");
        }
    }
}

/// The near plane only cuts: where it cuts nothing, its distance changes no bit of a picture that
/// is interpolated in perspective, no matter how small near/w is.
#[test]
fn a_near_plane_that_cuts_nothing_changes_nothing() {
    let torus = "torus?segments=24&sides=16";
    let mut scene =
        Scene::of_mesh(fastphong::mesh::builtin::builtin(torus).expect("a built-in mesh"));
    (scene.width, scene.height) = (64, 48);
    scene.camera.projection = Projection::Perspective { fovy: 40.0 };
    scene.interpolation = Interpolation::Perspective;
    let mut frame_with = |exponent: i32| {
        // Powers of two, so that all near/w differ only in their exponents.
        scene.camera.near = f64::powi(2.0, exponent);
        scene.frame().expect("a frame")
    };
    let usual = frame_with(-3);
    let truth = fastphong::reference::render(&usual, fastphong::reference::Model::Phong);
    for exponent in [-70, -200, -1000] {
        let frame = frame_with(exponent);
        for entry in floats_on(&frame) {
            let variant = entry.variant();
            let [expected, found] = [&usual, &frame].map(|frame| variant.render_linear(frame));
            assert!(
                expected == found,
                "{variant} with a near plane at 2^{exponent}"
            );
        }
        let found = fastphong::reference::render(&frame, fastphong::reference::Model::Phong);
        assert!(
            found.picture == truth.picture,
            "the reference at 2^{exponent}"
        );
    }
}

/// Methods square perspective weights in `f32`. A frame whose weights leave the range for this is
/// refused.
#[test]
fn perspective_over_too_many_distances_is_refused() {
    for (nearest, is_drawn) in [(1e-8, true), (1e-10, false)] {
        let corners = [
            [0.0, 0.0, -nearest as f32],
            [1e9, 0.0, -1e10],
            [0.0, 1e9, -1e10],
        ];
        for interpolation in [Interpolation::Perspective, Interpolation::Screen] {
            let mut scene = scene_of_one(&corners);
            let projection = Projection::Perspective { fovy: 90.0 };
            scene.camera = Camera::looking_at(DVec3::ZERO, -DVec3::Z, projection);
            (scene.camera.near, scene.camera.far) = (1e-20, 1e16);
            scene.interpolation = interpolation;
            let expected = is_drawn || interpolation == Interpolation::Screen;
            let found = scene.frame();
            assert_eq!(found.is_ok(), expected, "{nearest} {interpolation:?}");
            if let Err(error) = found {
                assert_eq!(error, FrameError::Weights);
            }
        }
    }
}
