//! CS171's literal per-sample test against the NDC cube, instead of clipping: where it is right,
//! and how wrong it can be.

use crate::support::floats_on;
use crate::support::{Random, linear};
use fastphong::frame::{Frame, FrameError};
use fastphong::mesh::{MeshBuilder, PolygonMesh};
use fastphong::raster::{self, Edges, NO_POLYGON};
use fastphong::reference;
use fastphong::scene::{
    Camera, Clipping, Culling, DepthBits, DepthBuffer, DepthSource, HiddenSurfaces, Interpolation,
    Projection, Scene,
};
use glam::{DVec3, Vec3};

/// Builds a scene of polygons. Its eye is one unit above the origin and looks along −z and slightly
/// downward.
fn scene(polygons: &[Vec<Vec3>], near: f64, far: f64) -> Scene {
    let mut builder = MeshBuilder::new(polygons.concat());
    let mut first = 0;
    for polygon in polygons {
        let corners: Vec<u32> = (first..first + polygon.len() as u32).collect();
        builder.polygon(&corners);
        first += polygon.len() as u32;
    }
    scene_of(builder.finish().expect("a mesh"), near, far)
}

fn scene_of(mesh: PolygonMesh, near: f64, far: f64) -> Scene {
    let mut scene = Scene::of_mesh(mesh);
    (scene.width, scene.height) = (80, 60);
    (scene.culling, scene.clipping) = (Culling::None, Clipping::NdcCube);
    let (eye, target) = (DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.0, 0.7, -1.0));
    scene.camera = Camera::looking_at(eye, target, Projection::Perspective { fovy: 60.0 });
    (scene.camera.near, scene.camera.far) = (near, far);
    scene
}

/// Returns the ground from z = `from` to z = `to`, wider than the picture.
fn ground(from: f32, to: f32) -> Vec<Vec3> {
    [(-60.0, from), (60.0, from), (60.0, to), (-60.0, to)]
        .map(|(x, z)| Vec3::new(x, 0.0, z))
        .to_vec()
}

/// Returns the depth of a polygon's plane at a sample's centre, and its change per sample.
fn depth_at(frame: &Frame, polygon: u32, x: usize, y: usize) -> (f64, f64) {
    let corners = frame.corners(&frame.polygons()[polygon as usize]);
    let at = |i: usize| {
        let v = &frame.vertices()[corners[i] as usize];
        DVec3::new(v.x.to_num(), v.y.to_num(), frame.depth_range().z(v.depth))
    };
    let normal = (at(1) - at(0)).cross(at(2) - at(0));
    let (dx, dy) = (-normal.x / normal.z, -normal.y / normal.z);
    let depth = at(0).z + dx * (x as f64 + 0.5 - at(0).x) + dy * (y as f64 + 0.5 - at(0).y);
    (depth, dx.abs() + dy.abs())
}

/// Returns the error bound of a sample's depth in `f32`. Each step along edge and span rounds
/// twice, and fewer than 32 roundings precede the steps. Each is half a unit in the last place of
/// the largest corner depth.
fn rounding(frame: &Frame) -> f64 {
    let largest = frame.vertices().iter().fold(1.0f64, |most, v| {
        most.max(frame.depth_range().z(v.depth).abs())
    });
    (2.0 * (frame.width() + frame.height()) as f64 + 32.0) * largest / f64::from(1 << 24)
}

/// Counts the pixels that are missing and extra compared with clipping, and the wrong pixels that
/// the margins do not explain.
fn wrong_pixels(scene: &Scene) -> (usize, usize, usize) {
    let mut clipped = scene.clone();
    clipped.clipping = Clipping::Planes;
    let [clipped, tested] = [&clipped, scene].map(|scene| scene.frame().expect("a frame"));
    let [truth, ours] = [&clipped, &tested].map(raster::polygon_indices);
    let (mut missing, mut extra, mut unexplained) = (0, 0, 0);
    for (x, y) in (0..80).flat_map(|x| (0..60).map(move |y| (x, y))) {
        match (truth.get(x, y) == NO_POLYGON, ours.get(x, y) == NO_POLYGON) {
            (false, true) => missing += 1,
            (true, false) => extra += 1,
            _ => continue,
        }
        // Clipping snaps its new corners to 1/256 pixel, so they are off by up to half of that, and
        // the cut may move past a pixel centre.
        let (depth, change) = depth_at(&tested, 0, x, y);
        let margin = change / 512.0 + rounding(&tested);
        unexplained += usize::from(depth.abs() > margin && (depth - 1.0).abs() > margin);
    }
    (missing, extra, unexplained)
}

/// In front of the eye the test equals clipping: a polygon through the near and the far plane has
/// no unexplained wrong pixel.
#[test]
fn in_front_of_the_eye_the_test_equals_clipping() {
    for (from, to, near, far) in [
        (-0.5, -40.0, 1.5, 20.0),
        (-1.0, -9.0, 2.0, 30.0),
        (-3.0, -70.0, 0.1, 25.0),
    ] {
        let scene = scene(&[ground(from, to)], near, far);
        let frame = scene.frame().expect("a frame");
        assert_eq!(
            (
                frame.stats().clipped,
                frame.stats().unprojected,
                frame.polygons().len()
            ),
            (0, 0, 1)
        );
        let drawn = raster::polygon_indices(&frame)
            .pixels()
            .iter()
            .filter(|n| **n == 0)
            .count();
        assert!(drawn > 800 && drawn < 4800, "{drawn}");
        let (missing, extra, unexplained) = wrong_pixels(&scene);
        assert_eq!(unexplained, 0, "{missing} missing, {extra} extra");
        // Rows are 80 pixels wide, and a margin of 1/512 pixel covers less than one row in total.
        assert!(missing + extra < 80, "{missing} missing, {extra} extra");
    }
}

/// A polygon through the eye plane projects wrongly. All visible ground is missing, and pixels are
/// drawn where nothing should be.
#[test]
fn through_the_plane_of_the_eye_the_test_is_wrong() {
    let mut scene = scene(&[ground(3.0, -10.0)], 0.1, 100.0);
    // 3,200 pixels of the ground are missing and 400 of the sky above are drawn. None lies within a
    // margin.
    assert_eq!(wrong_pixels(&scene), (3200, 400, 3600));
    scene.clipping = Clipping::Planes;
    let truth = raster::polygon_indices(&scene.frame().expect("a frame"));
    assert_eq!(
        truth.pixels().iter().filter(|n| **n == 0).count(),
        3200,
        "not one pixel of the ground is drawn"
    );
}

/// A corner in the eye plane cannot be projected. Its polygon is left out and counted.
#[test]
fn unprojectable_corners_are_counted() {
    // Each of three polygons has such a corner: in the eye plane, at the eye, and just in front of
    // it on the line of sight. The last projects to the middle of the picture, but its z/w is -1e5.
    let [at_the_eye, before_it] = [0.0, -1e-6].map(|z| {
        [(0.0, 1.0, z), (1.0, 0.5, -3.0), (-1.0, 0.5, -3.0)]
            .map(Vec3::from)
            .to_vec()
    });
    let polygons = [
        ground(0.0, -10.0),
        at_the_eye,
        before_it,
        ground(-2.0, -10.0),
    ];
    let mut scene = scene(&polygons, 0.1, 100.0);
    scene.camera.target = DVec3::new(0.0, 1.0, -1.0);
    let frame = scene.frame().expect("a frame");
    assert_eq!((frame.stats().unprojected, frame.polygons().len()), (3, 1));
    scene.interpolation = Interpolation::Perspective;
    assert_eq!(scene.frame().expect_err("no frame"), FrameError::Unclipped);
}

/// Every method draws triangles anywhere around the eye, with every depth buffer and source.
/// Engines and reference differ only where depths are within rounding of each other or of the
/// cube's faces.
#[test]
fn anything_around_the_eye_gives_a_picture() {
    let mut random = Random::new(47);
    let mut place = || (random.share() - 0.5) * 8.0;
    let (mut differing, mut drawn) = (0, 0);
    for round in 0..40 {
        let triangles: Vec<Vec<Vec3>> = (0..12)
            .map(|_| {
                (0..3)
                    .map(|_| Vec3::new(place(), place() + 1.0, place()))
                    .collect()
            })
            .collect();
        let mut scene = scene(&triangles, 0.3, 9.0);
        let bits = [DepthBits::ThirtyTwo, DepthBits::Sixteen][round % 2];
        let source = [DepthSource::Interpolated, DepthSource::PerSample][round / 2 % 2];
        scene.hidden_surfaces = HiddenSurfaces::ZBuffer(DepthBuffer { bits, source });
        let frame = scene.frame().expect("a frame");
        let truth = reference::visibility(&frame);
        // n/w is at most depth/(f/(f−n)) + 1, and f/(f−n) is 1.03 here.
        let margin = 2.1 * rounding(&frame);
        let level = bits.most().map_or(0.0, |most| 1.0 / f64::from(most));
        for seen in [
            raster::polygon_indices(&frame),
            raster::barycentric_polygon_indices(&frame, Edges::TopLeft),
        ] {
            for (x, y) in (0..80).flat_map(|x| (0..60).map(move |y| (x, y))) {
                let pair = [seen.get(x, y), truth.polygons.get(x, y)];
                drawn += usize::from(pair[1] != NO_POLYGON);
                if pair[0] == pair[1] {
                    continue;
                }
                differing += 1;
                let at_an_end = pair.iter().filter(|n| **n != NO_POLYGON).any(|&number| {
                    let depth = depth_at(&frame, number, x, y).0;
                    depth.abs() <= margin || (depth - 1.0).abs() <= margin
                });
                let gap = truth.depth_gap.get(x, y);
                assert!(
                    at_an_end || gap <= 2.0 * (margin + level),
                    "{gap} at {x}, {y} of round {round}: {pair:?}"
                );
            }
        }
        for entry in floats_on(&frame) {
            let picture = linear(entry, &frame);
            assert!(
                picture
                    .pixels()
                    .iter()
                    .all(|t| t.iter().all(|c| (0.0..=1.0).contains(c))),
                "{}",
                entry.info.name
            );
        }
    }
    assert!(
        drawn > 20_000 && differing * 500 < drawn,
        "{differing} of {drawn} pixels"
    );
}
