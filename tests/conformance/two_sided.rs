//! Two-sided lighting: polygons seen from behind are lit with negated normals.

use crate::support::cases::Case;
use crate::support::differences::largest_difference;
use crate::support::{floats_on, linear};
use fastphong::compare::metrics::compare;
use fastphong::frame::Frame;
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::vertex_normals::{NormalSource, vertex_normals};
use fastphong::mesh::{GivenNormals, MeshBuilder, PolygonMesh};
use fastphong::scene::{Camera, Culling, Light, Projection, Scene};
use fastphong::shading::Variant;
use glam::DVec3;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Returns the surface with inside and outside exchanged.
fn turned(mesh: &PolygonMesh) -> PolygonMesh {
    let mut builder = MeshBuilder::new(mesh.positions().to_vec());
    for polygon in mesh.polygons() {
        let corners: Vec<u32> = polygon.iter().rev().copied().collect();
        builder.polygon(&corners);
    }
    builder.finish().expect("a mesh")
}

fn scene(mesh: PolygonMesh) -> Scene {
    let mut scene = Scene::of_mesh(mesh);
    (scene.width, scene.height) = (96, 72);
    (scene.culling, scene.two_sided) = (Culling::None, true);
    scene
}

/// Returns two views: the inside of a torus whose front faces are culled, and a ground seen from
/// below and cut by the near plane.
fn views(change: impl Fn(&mut Scene)) -> [Frame; 2] {
    let mesh = |spec: &str| builtin(spec).expect("a built-in mesh");
    let mut inside = scene(mesh("torus?segments=24&sides=12"));
    inside.culling = Culling::Front;
    let mut below = scene(mesh("polygon?sides=6"));
    let (eye, target) = (DVec3::new(0.1, -0.2, -0.15), DVec3::new(0.3, 0.8, 0.05));
    below.camera = Camera::looking_at(eye, target, Projection::Perspective { fovy: 70.0 });
    below.camera.up = DVec3::NEG_Z;
    (below.camera.near, below.camera.far) = (0.05, 10.0);
    below.lights[0] = Light::directional(
        DVec3::new(0.2, -0.5, -1.0).normalize(),
        below.lights[0].colour,
    );
    [inside, below].map(|mut scene| {
        change(&mut scene);
        scene.frame().expect("a frame")
    })
}

fn exchange(scene: &mut Scene) {
    scene.objects[0].mesh = Arc::new(turned(&scene.objects[0].mesh));
    scene.culling = match scene.culling {
        Culling::Front => Culling::Back,
        other => other,
    };
}

/// With two-sided lighting it does not matter which side is the outside. With one-sided lighting it
/// does.
#[test]
fn inside_and_outside_are_lit_alike() {
    let pairs = views(|_| ()).into_iter().zip(views(exchange));
    for (number, (ours, exchanged)) in pairs.enumerate() {
        assert_eq!(
            number == 1,
            ours.stats().clipped > 0,
            "the second view is cut by the near plane"
        );
        for entry in floats_on(&ours) {
            let draw = |frame: &Frame| linear(entry, frame);
            let difference = compare(&draw(&ours), &draw(&exchanged)).expect("equal sizes");
            // Newell's sum and the averages add up in another order, so normals differ by a
            // rounding. Both pictures are within the bound of the closed form.
            let bound = 2.0 * entry.variant().bound(&ours);
            assert!(
                difference.max <= bound,
                "{}, view {number}: {}",
                entry.info.name,
                difference.max
            );
            assert_eq!(difference.coverage_mismatches, 0);
        }
    }
    let one_sided = views(|scene| scene.two_sided = false);
    for (two, one) in views(|_| ()).iter().zip(&one_sided) {
        let [two, one] = [two, one].map(|frame| {
            Variant::parse("naive-phong")
                .expect("a method")
                .render_linear(frame)
                .expect("a method for the frame")
        });
        assert!(
            compare(&two, &one).expect("equal sizes").max > 0.2,
            "seen from behind, and lit from there or not"
        );
    }
}

/// All polygon normals point to the eye. A vertex on the silhouette, between a front and a back
/// face, occurs twice, with opposite normals.
#[test]
fn the_silhouette_has_two_normals() {
    let mut sphere = scene(builtin("sphere?rings=12&segments=24").expect("a built-in mesh"));
    let view = sphere.camera.view();
    let frame = sphere.frame().expect("a frame");
    sphere.two_sided = false;
    let plain = sphere.frame().expect("a frame");
    let wide = |n: [f32; 3]| DVec3::from_array(n.map(f64::from));
    assert!(
        frame
            .polygons()
            .iter()
            .all(|p| wide(frame.polygon_normal(p)).dot(view) > 0.0)
    );
    let behind = plain
        .polygons()
        .iter()
        .filter(|p| wide(plain.polygon_normal(p)).dot(view) < 0.0)
        .count();
    assert!(behind > 100 && behind < plain.polygons().len() - 100);
    let used = |frame: &Frame| {
        let corners = frame
            .polygons()
            .iter()
            .flat_map(|polygon| frame.corners(polygon));
        corners.copied().collect::<BTreeSet<u32>>().len()
    };
    let twice = used(&frame) - used(&plain);
    // Every polygon edge on the silhouette has two vertices. The silhouette goes once around the
    // sphere, over about 24 segments.
    assert!((20..60).contains(&twice), "{twice}");
    for polygon in frame.polygons() {
        for &corner in frame.corners(polygon) {
            // A polygon is 15 degrees wide, so its corner normals lean from its own normal by less
            // than twice that.
            assert!(wide(frame.normal(corner)).dot(wide(frame.polygon_normal(polygon))) > 0.8);
        }
    }
}

/// Engines and reference agree, although neither knows about two-sided lighting.
#[test]
fn methods_are_within_their_bounds() {
    for case in views(|_| ()).map(|frame| Case::new("", frame)) {
        for entry in floats_on(&case.frame) {
            let ours = linear(entry, &case.frame);
            let (max, _) = largest_difference(case.truth(entry.info.model), &ours, |_, _| true);
            let bound = entry.variant().bound(&case.frame);
            assert!(max <= bound, "{}: {max} over {bound}", entry.info.name);
        }
    }
}

/// Returns the surface with its averaged normals as given normals. If asked for, every other
/// polygon is wound the other way.
fn with_own_normals(mesh: &PolygonMesh, is_half_turned: bool) -> PolygonMesh {
    let normals = vertex_normals(mesh, NormalSource::Averaged);
    let mut builder = MeshBuilder::new(mesh.positions().to_vec());
    let mut own = Vec::new();
    for number in 0..mesh.polygon_count() {
        let mut corners: Vec<usize> = mesh.corner_range(number).collect();
        if is_half_turned && number % 2 == 0 {
            corners.reverse();
        }
        let positions: Vec<u32> = corners.iter().map(|&k| mesh.corners()[k]).collect();
        builder.polygon(&positions);
        own.extend(corners.iter().map(|&k| normals.corners[k]));
    }
    builder.normals(GivenNormals {
        values: normals.values,
        corners: Some(own),
    });
    builder.finish().expect("a mesh")
}

/// Where the winding contradicts the mesh's own normals, the normals decide which side is the
/// front, for whole and for clipped polygons.
#[test]
fn polygons_wound_against_their_own_normals_are_lit_by_the_normals() {
    let seen = |is_half_turned: bool| {
        views(|scene: &mut Scene| {
            scene.culling = Culling::None;
            let object = &mut scene.objects[0];
            object.normals = NormalSource::Given.into();
            object.mesh = Arc::new(with_own_normals(&object.mesh, is_half_turned));
        })
    };
    for (ours, turned) in seen(false).into_iter().zip(seen(true)) {
        for entry in floats_on(&ours) {
            let draw = |frame: &Frame| {
                let drawn = entry.variant().render_linear(frame);
                drawn.expect("a method for the frame")
            };
            let difference = compare(&draw(&ours), &draw(&turned)).expect("equal sizes");
            // As above, only roundings differ.
            let bound = 2.0 * entry.variant().bound(&ours);
            let (name, max) = (entry.info.name, difference.max);
            assert!(max <= bound, "{name}: {max} over {bound}");
            assert_eq!(difference.coverage_mismatches, 0);
        }
    }
}
