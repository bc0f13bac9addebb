//! Compares frames with polygons projected one by one. Also tests reused frames and threads.

use super::side::eye_side;
use super::view::{BEYOND_PLANES, View};
use super::winding::doubled_area;
use crate::frame::{
    DepthRange, Frame, FrameBuilder, FrameError, FrameItem, FrameStats, Polygon, SubPixel, Vertex,
};
use crate::mesh::builtin::builtin;
use crate::mesh::newell::{polygon_normal, unit_normal};
use crate::mesh::vertex_normals::{NormalSource, vertex_normals};
use crate::mesh::{GivenNormals, MeshBuilder, PolygonMesh};
use crate::scene::input::{SCENES, resolve};
use crate::scene::{
    Camera, Clipping, Culling, HiddenSurfaces, Interpolation, Object, Projection, Scene,
};
use alloc::collections::BTreeSet;
use alloc::string::ToString;
use alloc::vec;
use alloc::vec::Vec;
use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4};

/// A corner with all its frame data: vertex, position relative to the eye, and colour.
type PlainCorner = (Vertex, [f32; 3], [f32; 3]);

/// A polygon that needs no clipping, and its corners.
#[derive(Debug, PartialEq)]
struct PlainPolygon {
    source: u32,
    material: u32,
    normal: [f32; 3],
    corners: Vec<PlainCorner>,
}

/// A plain projection of a scene, polygon by polygon and corner by corner, without batches.
struct Plainly<'a> {
    view: View<'a>,
    scene: &'a Scene,
    polygons: Vec<PlainPolygon>,
    /// The indices of polygons that must be clipped.
    cut: BTreeSet<u32>,
    stats: FrameStats,
}

impl<'a> Plainly<'a> {
    fn of(scene: &'a Scene) -> Self {
        let view = View::new(scene).expect("a valid camera");
        let mut all = Plainly {
            view,
            scene,
            polygons: Vec::new(),
            cut: BTreeSet::new(),
            stats: FrameStats::default(),
        };
        let mut materials = 0;
        for object in &scene.objects {
            all.object(object, materials);
            materials += object.mesh.materials().len() as u32 + 1;
        }
        all
    }

    fn object(&mut self, object: &Object, first_material: u32) {
        let mesh = &*object.mesh;
        let normals = vertex_normals(mesh, object.normals);
        let linear = object.transform.matrix3;
        let mirrored = linear.determinant() < 0.0;
        let (x, y, z) = (linear.x_axis, linear.y_axis, linear.z_axis);
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y))
            * if mirrored { -1.0 } else { 1.0 };
        let matrix = self.view.clip_matrix * DMat4::from(object.transform);
        for p in 0..mesh.polygon_count() {
            let source = self.stats.polygons as u32;
            self.stats.polygons += 1;
            let mut places: Vec<usize> = mesh.corner_range(p).collect();
            if mirrored {
                places.reverse();
            }
            let position = |k: usize| mesh.positions()[mesh.corners()[k] as usize].as_dvec3();
            let clips: Vec<_> = places
                .iter()
                .map(|&k| matrix * position(k).extend(1.0))
                .collect();
            let face = unit_normal(cofactors * polygon_normal(mesh, p));
            let (Some(area), Some(face)) = (self.area_of_drawn(source, &clips, face), face) else {
                continue;
            };
            let sign = if self.scene.two_sided && area > 0 {
                -1.0
            } else {
                1.0
            };
            let material =
                first_material + mesh.polygon_material(p).unwrap_or(mesh.materials().len()) as u32;
            let corner = |(&k, &clip): (&usize, &DVec4)| {
                let normal = normals.values[normals.corners[k] as usize].as_dvec3();
                let normal = sign * (cofactors * normal).normalize_or(DVec3::Z);
                let [x, y] = self.view.snap(clip);
                let from_eye =
                    object.transform.transform_point3(position(k)) - self.scene.camera.eye;
                let colour = mesh
                    .colours()
                    .get(mesh.corners()[k] as usize)
                    .map_or([1.0; 3], |c| c.to_array());
                let screen = self.view.vertex(clip);
                assert_eq!(
                    (screen.x, screen.y, screen.depth),
                    (x, y, self.view.depth(clip))
                );
                let (depth, inv_w, normal) =
                    (screen.depth, screen.inv_w, normal.as_vec3().to_array());
                (
                    Vertex {
                        x,
                        y,
                        depth,
                        inv_w,
                        normal,
                        material,
                    },
                    from_eye.as_vec3().to_array(),
                    colour,
                )
            };
            let corners = places.iter().zip(&clips).map(corner).collect();
            let normal = (sign * face).as_vec3().to_array();
            self.polygons.push(PlainPolygon {
                source,
                material,
                normal,
                corners,
            });
        }
    }

    /// Returns twice the screen area of a polygon that is drawn whole. Counts all others in the
    /// statistics.
    fn area_of_drawn(&mut self, source: u32, clips: &[DVec4], face: Option<DVec3>) -> Option<i128> {
        let codes: Vec<_> = clips.iter().map(|&clip| self.view.codes(clip)).collect();
        if codes.iter().fold(u16::MAX, |all, c| all & c) & !BEYOND_PLANES != 0 {
            self.stats.outside += 1;
            return None;
        }
        if face.is_none() {
            self.stats.no_area += 1;
            return None;
        }
        if codes.iter().any(|c| c & BEYOND_PLANES != 0) {
            self.stats.clipped += 1;
            self.cut.insert(source);
            return None;
        }
        let area = self.doubled_area(clips);
        let culled = match self.scene.culling {
            Culling::Back => area > 0,
            Culling::Front => area < 0,
            Culling::None => false,
        };
        self.stats.culled += usize::from(culled);
        self.stats.edge_on += usize::from(area == 0);
        (!culled && area != 0).then_some(area)
    }

    fn doubled_area(&self, clips: &[DVec4]) -> i128 {
        let places: Vec<[i128; 2]> = clips
            .iter()
            .map(|&clip| self.view.snap(clip).map(|c| i128::from(c.to_bits())))
            .collect();
        let next = |k: usize| places[(k + 1) % places.len()];
        (0..places.len())
            .map(|k| places[k][0] * next(k)[1] - next(k)[0] * places[k][1])
            .sum()
    }
}

/// Returns variants of a scene with other cameras, culling and interpolation.
fn variants(scene: &Scene) -> Vec<Scene> {
    let camera = scene.camera;
    let away = camera.target - camera.eye;
    let nearer = |part: f64, near: f64, fovy: f64| Camera {
        eye: camera.eye + away * part,
        near: away.length() * near,
        projection: Projection::Perspective { fovy },
        ..camera
    };
    let planes = Scene {
        clipping: Clipping::Planes,
        ..scene.clone()
    };
    vec![
        Scene {
            culling: Culling::None,
            ..planes.clone()
        },
        Scene {
            culling: Culling::None,
            two_sided: !scene.two_sided,
            ..planes.clone()
        },
        Scene {
            camera: nearer(0.0, 0.97, 30.0),
            culling: Culling::Front,
            ..planes.clone()
        },
        Scene {
            camera: nearer(0.9, 0.001, 70.0),
            interpolation: Interpolation::Perspective,
            two_sided: true,
            ..planes.clone()
        },
        planes,
    ]
}

fn shipped(name: &str) -> Scene {
    let scene = SCENES
        .iter()
        .find(|scene| scene.name == name)
        .expect("a shipped scene");
    let mut scene = resolve(&scene.load().expect("a scene file"))
        .expect("a scene")
        .scene;
    // Keep the drawing order of the scene.
    scene.hidden_surfaces = HiddenSurfaces::default();
    scene
}

fn corners(frame: &Frame, polygon: usize) -> Vec<PlainCorner> {
    let corners = frame.corners(&frame.polygons()[polygon]).iter();
    corners
        .map(|&v| (frame.vertex(v), frame.position(v), frame.colour(v)))
        .collect()
}

/// Frames equal a polygon-by-polygon projection bit by bit: coordinates, weights, normals and
/// indices. Pieces of clipped polygons take the place of the whole.
#[test]
fn frames_equal_plain_projection() {
    let mut cut = 0;
    // The scene `million` has the sphere of the others.
    for scene in SCENES.iter().filter(|scene| scene.name != "million") {
        for (index, variant) in variants(&shipped(scene.name)).iter().enumerate() {
            let name = alloc::format!("{}, variant {index}", scene.name);
            let plainly = Plainly::of(variant);
            let frame = variant.frame().expect("a frame");
            assert!(frame.polygons().is_sorted_by_key(|p| p.source), "{name}");
            let mut expected = plainly.polygons.iter();
            for (place, polygon) in frame.polygons().iter().enumerate() {
                if plainly.cut.contains(&polygon.source) {
                    continue;
                }
                let found = PlainPolygon {
                    source: polygon.source,
                    material: polygon.material,
                    normal: frame.polygon_normal(polygon),
                    corners: corners(&frame, place),
                };
                assert_eq!(Some(&found), expected.next(), "{name}");
            }
            assert_eq!(expected.next(), None, "{name}");
            let (found, expected) = (frame.stats(), plainly.stats);
            assert_eq!(
                (found.polygons, found.outside, found.clipped),
                (expected.polygons, expected.outside, expected.clipped)
            );
            assert!(
                found.culled >= expected.culled && found.edge_on >= expected.edge_on,
                "{name}"
            );
            if plainly.cut.is_empty() {
                assert_eq!(found, expected, "{name}");
            }
            cut += plainly.cut.len();
        }
    }
    assert!(cut > 1000, "the test asks little: {cut} polygons cut");
}

/// Asserts that two frames agree in everything that can be read from them.
fn assert_same(a: &Frame, b: &Frame, name: &str) {
    assert_eq!(
        (a.width(), a.height(), a.stats(), a.origin()),
        (b.width(), b.height(), b.stats(), b.origin()),
        "{name}"
    );
    assert_eq!(a.lightings(), b.lightings(), "{name}");
    assert!(a.vertices() == b.vertices(), "{name}");
    assert!(a.polygons() == b.polygons(), "{name}");
    assert!(a.clip_corners() == b.clip_corners(), "{name}");
    assert!(
        (0..a.vertices().len() as u32).all(|v| a.vertex(v) == b.vertex(v)),
        "{name}"
    );
    for (p, q) in a.polygons().iter().zip(b.polygons()) {
        assert_eq!(a.corners(p), b.corners(q), "{name}");
        assert_eq!(
            (a.polygon_normal(p), a.mean(p)),
            (b.polygon_normal(q), b.mean(q)),
            "{name}"
        );
    }
}

/// A frame reused for other cameras and scenes equals a new one, and soon allocates no more memory.
#[test]
fn a_reused_frame_equals_a_new_one() {
    let mut frame = Frame::empty(1, 1);
    for name in [
        "teapot",
        "football",
        "mirrored",
        "cyclic-triangles",
        "terrain",
    ] {
        for scene in variants(&shipped(name)) {
            let mut prepared = scene.prepare().expect("a scene");
            let cameras: Vec<Camera> = variants(&scene)
                .iter()
                .map(|variant| variant.camera)
                .collect();
            for (index, &camera) in cameras.iter().chain(&cameras).enumerate() {
                prepared.set_camera(camera);
                prepared.frame_into(&mut frame).expect("a frame");
                let new = Scene {
                    camera,
                    ..scene.clone()
                }
                .frame()
                .expect("a frame");
                assert_same(&frame, &new, &alloc::format!("{name}, camera {index}"));
            }
            let memory = |frame: &Frame| {
                (
                    frame.vertices.as_ptr(),
                    frame.polygons.as_ptr(),
                    frame.cut_corners.as_ptr(),
                )
            };
            let before = memory(&frame);
            for camera in cameras {
                prepared.set_camera(camera);
                prepared.frame_into(&mut frame).expect("a frame");
                assert_eq!(memory(&frame), before, "{name}");
            }
        }
    }
}

/// The painter sorts a reused frame again.
#[test]
fn a_frame_used_again_is_sorted_again() {
    let mut scene = shipped("mirrored");
    scene.hidden_surfaces = HiddenSurfaces::Painter(crate::scene::PainterKey::Mean);
    let mut prepared = scene.prepare().expect("a scene");
    let mut frame = prepared.frame().expect("a frame");
    let depth = |frame: &Frame, polygon: &Polygon| {
        let depths = frame
            .corners(polygon)
            .iter()
            .map(|&v| f64::from(frame.vertices()[v as usize].depth as f32));
        depths.sum::<f64>() / f64::from(polygon.count)
    };
    let first = frame.polygons().to_vec();
    for camera in [
        Camera {
            eye: scene.camera.eye + scene.camera.up,
            ..scene.camera
        },
        scene.camera,
    ] {
        prepared.set_camera(camera);
        prepared.frame_into(&mut frame).expect("a frame");
        assert!(
            frame
                .polygons()
                .is_sorted_by(|a, b| depth(&frame, a) >= depth(&frame, b))
        );
        assert!(
            !frame.polygons().is_sorted_by_key(|p| p.source),
            "the scene has no such order of its own"
        );
    }
    assert_eq!(frame.polygons(), first);
}

#[test]
fn a_camera_that_sees_nothing_leaves_an_empty_frame() {
    let scene = shipped("teapot");
    let mut prepared = scene.prepare().expect("a scene");
    let mut frame = prepared.frame().expect("a frame");
    assert!(!frame.polygons().is_empty());
    prepared.set_camera(Camera {
        eye: scene.camera.target,
        ..scene.camera
    });
    let refused = prepared.frame_into(&mut frame);
    let item = FrameItem::Camera;
    assert!(matches!(refused, Err(FrameError::Value { item: of, .. }) if of == item));
    assert!(frame.polygons().is_empty() && frame.vertices().is_empty());
    prepared.set_camera(scene.camera);
    prepared.set_size(0, 10);
    assert_eq!(
        prepared.frame_into(&mut frame),
        Err(FrameError::Size {
            width: 0,
            height: 10
        })
    );
    prepared.set_size(10, 8);
    prepared.set_lights(vec![scene.lights[0]; Scene::MAX_LIGHTS + 1]);
    assert!(matches!(
        prepared.frame_into(&mut frame),
        Err(FrameError::Lights { .. })
    ));
    prepared.set_lights(Vec::new());
    assert_eq!(prepared.frame_into(&mut frame), Ok(()));
    assert_eq!((frame.width(), frame.light_count()), (10, 0));
}

/// Both tests of the visible side agree: the sign of the screen area for whole polygons, the sign
/// of a volume for clipped ones.
#[test]
fn both_tests_of_the_side_agree() {
    let scene = shipped("teapot");
    let view = View::new(&scene).expect("a camera");
    let mesh = &scene.objects[0].mesh;
    let matrix = view.clip_matrix * DMat4::from(scene.objects[0].transform);
    let frame = Scene {
        culling: Culling::Back,
        ..scene.clone()
    }
    .frame()
    .expect("a frame");
    assert!(frame.polygons().len() > 100);
    for polygon in frame.polygons() {
        let corners = mesh.polygon(polygon.source as usize).iter();
        let clips = corners.map(|&c| matrix * mesh.positions()[c as usize].as_dvec3().extend(1.0));
        assert!(eye_side(clips) > 0.0);
    }
}

#[cfg(feature = "threads")]
#[test]
fn threads_change_nothing() {
    for name in ["knot-100k", "football", "terrain", "mirrored", "corrugated"] {
        for scene in variants(&shipped(name)) {
            let on = |threads| {
                let pool = rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()
                    .expect("threads");
                pool.install(|| scene.frame().expect("a frame"))
            };
            let one = on(1);
            for threads in [2, 3] {
                let several = on(threads);
                assert_same(&one, &several, name);
                assert!(one.geometry.corners == several.geometry.corners, "{name}");
                assert!(one.geometry.faces == several.geometry.faces, "{name}");
            }
        }
    }
}

/// A frame knows if it is local without looking at each material, whichever of them is local.
#[test]
fn a_frame_is_local_if_a_light_or_the_eye_is() {
    let mut scene = resolve(&SCENES[0].load().unwrap()).unwrap().scene;
    scene.lights.truncate(1);
    let is_local = |scene: &Scene| {
        let frame = scene.frame().unwrap();
        let looked_at = frame.lightings().iter().any(|lighting| lighting.is_local());
        assert_eq!(frame.is_local(), looked_at);
        frame.is_local()
    };
    assert!(!is_local(&scene));
    scene.local_viewer = true;
    assert!(is_local(&scene));
    scene.local_viewer = false;
    scene
        .lights
        .push(crate::scene::Light::positional(DVec3::splat(9.0), [1.0; 3]));
    assert!(is_local(&scene));
}

/// Transforms to move an object by, some of which mirror it.
fn moves(object: &Object) -> [DAffine3; 5] {
    let turned = DAffine3::from_rotation_x(0.3) * object.transform;
    let mirrored = object.transform * DAffine3::from_scale(DVec3::new(-1.0, 1.25, 1.0));
    let up = DAffine3::from_translation(DVec3::new(0.01, 0.2, -0.1));
    [
        turned,
        mirrored,
        up * mirrored,
        up * turned,
        object.transform,
    ]
}

/// Returns a sphere with its own normals. Every second polygon runs clockwise seen from outside.
fn half_against_its_normals() -> PolygonMesh {
    let sphere = builtin("sphere?rings=8&segments=9").expect("a shape");
    let mut builder = MeshBuilder::new(sphere.positions().to_vec());
    for (index, polygon) in sphere.polygons().enumerate() {
        let mut polygon = polygon.to_vec();
        if index % 2 == 1 {
            polygon.reverse();
        }
        builder.polygon(&polygon);
    }
    let values = sphere.positions().iter().map(|p| p.normalize());
    builder.normals(GivenNormals {
        values: values.collect(),
        corners: None,
    });
    builder.finish().expect("a mesh")
}

/// A prepared scene whose objects move equals the scene prepared anew, whichever object moved last
/// and whether or not frames share its geometry. Earlier frames do not change.
#[test]
fn a_scene_whose_objects_move_equals_a_new_one() {
    let mut count = 0;
    let scenes = SCENES.iter().map(|scene| shipped(scene.name));
    for scene in scenes.filter(|scene| scene.objects.len() > 1) {
        for (index, mut scene) in variants(&scene).into_iter().enumerate() {
            if index == 1 {
                scene.objects[1].normals = NormalSource::Crease(25.0).into();
            }
            if scene.two_sided {
                scene.objects[0].mesh = half_against_its_normals().into();
                scene.objects[0].normals = NormalSource::Given.into();
            }
            let mut prepared = scene.prepare().expect("a scene");
            let first = prepared.frame().expect("a frame");
            let mut frame = first.clone();
            let unmoved = scene.frame().expect("a frame");
            for (step, object) in [1, 0, 1, 1, 0].into_iter().enumerate() {
                let transform = moves(&scene.objects[object])[step];
                scene.objects[object].transform = transform;
                prepared.set_transform(object, transform).expect("a place");
                if step == 2 {
                    // Twice before a frame is made, and in a scene that shares all with another.
                    let again = prepared.clone();
                    prepared.set_transform(object, transform).expect("a place");
                    drop(again);
                }
                prepared.frame_into(&mut frame).expect("a frame");
                let new = scene.frame().expect("a frame");
                let name = alloc::format!("variant {index}, step {step}");
                assert_same(&frame, &new, &name);
                let positions = |frame: &Frame| -> Vec<[f32; 3]> {
                    let vertices = 0..frame.vertices().len() as u32;
                    vertices.map(|v| frame.position(v)).collect()
                };
                assert!(positions(&frame) == positions(&new), "{name}");
                count += frame.polygons().len();
            }
            assert_same(&first, &unmoved, "before");
        }
    }
    assert!(count > 10_000, "the test asks little: {count} polygons");
}

/// From the third move on nothing is copied: a scene whose frames are made again alternates between
/// two geometries.
#[test]
fn moving_an_object_again_and_again_copies_nothing() {
    let scene = shipped("polygons");
    let mut prepared = scene.prepare().expect("a scene");
    let mut frame = prepared.frame().expect("a frame");
    let mut places = Vec::new();
    for step in 0..8 {
        let turn = DAffine3::from_rotation_y(0.1 * f64::from(step));
        prepared
            .set_transform(2, turn * scene.objects[2].transform)
            .expect("a place");
        prepared.frame_into(&mut frame).expect("a frame");
        places.push(frame.geometry.normals.as_ptr());
    }
    assert_ne!(places[0], places[1]);
    assert!(places.iter().skip(2).zip(&places).all(|(a, b)| a == b));
}

/// A move that a scene would refuse is refused by the same error, and nothing has moved.
#[test]
fn an_object_goes_nowhere_that_a_scene_refuses() {
    let mut scene = shipped("local-lights");
    let mut prepared = scene.prepare().expect("a scene");
    let before = prepared.frame().expect("a frame");
    let object = scene.objects[1].clone();
    let point = object.world_points().next().expect("a vertex");
    let light = scene.lights.iter().find_map(|light| match light.place {
        crate::scene::Place::Local(at) => Some(at),
        crate::scene::Place::Infinite(_) => None,
    });
    let to_light = light.expect("a light at a position") - point;
    for transform in [
        DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0)),
        DAffine3::from_scale(DVec3::splat(f64::NAN)),
        DAffine3::from_translation(DVec3::splat(1e300)),
        DAffine3::from_translation(to_light) * object.transform,
    ] {
        scene.objects[1].transform = transform;
        let expected = scene.frame().expect_err("a wrong transform");
        let found = prepared.set_transform(1, transform).expect_err("the same");
        // Compared by their texts, because NaN is not equal to itself.
        assert_eq!(alloc::format!("{found}"), alloc::format!("{expected}"));
    }
    let error = prepared
        .set_transform(2, DAffine3::IDENTITY)
        .expect_err("no such object");
    assert_eq!(
        alloc::format!("{error}"),
        "the scene: the index of the object to move is 2: expected the index of an object, from 0"
    );
    assert_same(&prepared.frame().expect("a frame"), &before, "unmoved");
}

/// Builds the frame of a scene from the clip coordinates of its vertices, like a program that has a
/// matrix and polygons.
fn from_clip_space(scene: &Scene) -> Frame {
    let prepared = scene.prepare().expect("a scene");
    let seen = prepared.frame().expect("a frame");
    let geometry = &prepared.geometry;
    let (width, height) = (scene.width * scene.samples, scene.height * scene.samples);
    let mut builder = FrameBuilder::new(width, height);
    builder
        .samples(scene.samples)
        .interpolation(scene.interpolation)
        .hidden_surfaces(scene.hidden_surfaces)
        .clipping(scene.clipping)
        .depth_range(DepthRange::from(&scene.camera))
        .origin(seen.origin());
    for lighting in seen.lightings() {
        builder.lighting(lighting.clone());
    }
    let to_clip = scene
        .camera
        .clip_matrix(f64::from(scene.width) / f64::from(scene.height));
    for vertex in 0..geometry.models.count() {
        let object = geometry.models.object_of(vertex);
        let to_clip = to_clip * DMat4::from(geometry.models.objects[object].transform);
        let position = to_clip * geometry.models.position(vertex).extend(1.0);
        let v = vertex as u32;
        let material = geometry.material(v).expect("a vertex of the scene");
        builder.vertex_from_clip(position.to_array(), geometry.normal(v), material);
        builder.position(v, geometry.position(v, seen.origin()));
    }
    for polygon in 0..prepared.table.count {
        let face = geometry.faces[polygon];
        if face != [0.0; 3] {
            let (first, count) = prepared.table.corners(polygon);
            let corners = &geometry.corners[first as usize..][..count as usize];
            builder.polygon(corners, face, polygon as u32);
        }
    }
    builder.finish().expect("a frame")
}

/// Polygons that a builder receives in clip space are placed and cut like the scene's polygons, to
/// the bit.
#[test]
fn polygons_in_clip_space_are_those_of_a_scene() {
    let (mut cut, mut whole) = (0, 0);
    for name in [
        "teapot",
        "football",
        "polygons",
        "perspective",
        "terrain",
        "local-lights",
    ] {
        for (index, mut scene) in variants(&shipped(name)).into_iter().enumerate() {
            let name = alloc::format!("{name}, variant {index}");
            (scene.culling, scene.two_sided) = (Culling::None, false);
            let (expected, found) = (scene.frame().expect("a frame"), from_clip_space(&scene));
            let [a, b] = [expected.stats(), found.stats()];
            assert_eq!(
                (a.outside, a.clipped, a.unprojected),
                (b.outside, b.clipped, b.unprojected),
                "{name}"
            );
            assert!(expected.vertices() == found.vertices(), "{name}");
            assert!(expected.clip_corners() == found.clip_corners(), "{name}");
            // Scenes leave out whole polygons without an area, of which nothing is drawn.
            let has_area = |p: &&Polygon| {
                let corners = found
                    .corners(p)
                    .iter()
                    .map(|&v| &found.vertices[v as usize]);
                doubled_area(corners.map(|v| [v.x, v.y])) != 0
            };
            let mut polygons = found.polygons().iter().filter(has_area);
            for p in expected.polygons() {
                let q = polygons.next().expect("as many polygons");
                assert_eq!((p.source, p.material), (q.source, q.material), "{name}");
                assert_eq!(expected.corners(p), found.corners(q), "{name}");
                assert_eq!(expected.mean(p), found.mean(q), "{name}");
                assert_eq!(
                    expected.polygon_normal(p),
                    found.polygon_normal(q),
                    "{name}"
                );
                let is_piece = expected.stated_mean(p).is_some();
                *[&mut whole, &mut cut][usize::from(is_piece)] += 1;
            }
            assert!(polygons.next().is_none(), "{name}");
            if scene.interpolation == Interpolation::Perspective {
                assert_eq!(expected.weight_scale, found.weight_scale, "{name}");
            }
        }
    }
    assert!(
        cut > 500 && whole > 5000,
        "the test asks little: {cut}, {whole}"
    );
}

/// A vertex without a valid place in clip space is an error that names the vertex and the value. A
/// vertex behind the eye is cut away.
#[test]
fn places_in_clip_space_are_checked() {
    let made = |range: DepthRange, places: [[f64; 4]; 3], on_screen: bool| {
        let mut builder = FrameBuilder::new(8, 8);
        builder.depth_range(range);
        let to_eye = crate::scene::Lighting::new(&Default::default(), [1.0; 3], &[], DVec3::Z);
        let material = builder.lighting(to_eye);
        let mut corners: Vec<u32> = places
            .iter()
            .map(|&place| builder.vertex_from_clip(place, [0.0, 0.0, 1.0], material))
            .collect();
        if on_screen {
            let v = builder.frame().expect("a frame").vertex(corners[0]);
            corners.push(builder.vertex(v));
        }
        builder.polygon(&corners, [0.0, 0.0, 1.0], 0);
        builder.finish()
    };
    let perspective = DepthRange::Perspective {
        near: 1.0,
        far: 9.0,
    };
    let plain = DepthRange::default();
    let text = |made: Result<Frame, FrameError>| made.map(|_| ()).expect_err("wrong").to_string();
    let with = |place: [f64; 4]| [[0.0, 0.0, 0.5, 1.0], [0.5, 0.0, 0.5, 1.0], place];
    assert_eq!(
        text(made(perspective, with([0.0, f64::NAN, 0.5, 1.0]), false)),
        "vertex 2: y of its position in clip space is NaN: expected a number from -1e140 to 1e140"
    );
    assert_eq!(
        text(made(plain, with([0.0, 0.5, f64::INFINITY, 1.0]), false)),
        "vertex 2: z of its position in clip space is inf: expected a number from -1e140 to 1e140"
    );
    assert_eq!(
        text(made(plain, with([0.0, 0.5, 0.5, 2.0]), false)),
        "vertex 2: w of its position in clip space is 2: expected 1, as the frame's depth range is orthographic"
    );
    for w in [0.0, -0.0, -3.0, -30.0] {
        let places = [
            [0.0, 0.0, 0.0, 2.0],
            [0.5, 0.0, 0.0, 2.0],
            [0.0, 0.5, 0.0, w],
        ];
        let frame = made(perspective, places, false).expect("a frame");
        assert_eq!(
            (frame.stats().clipped, frame.polygons().len()),
            (1, 1),
            "{w}: {:?}",
            frame.stats()
        );
        let polygon = &frame.polygons()[0];
        assert_eq!(polygon.count, 4, "{w}");
        let nearest = frame.corners(polygon).iter();
        let depths = nearest.map(|&v| frame.vertices()[v as usize].depth);
        assert!(
            depths
                .into_iter()
                .all(|depth| (-1.0..=-0.5).contains(&depth)),
            "{w}"
        );
    }
    // A vertex that is only on the screen has no position beyond a plane.
    let mixed = made(perspective, with([0.0, 0.5, 0.5, 1.5]), true);
    assert_eq!(mixed.expect("uncut").polygons().len(), 1);
    let mixed = made(perspective, with([0.0, 0.5, 0.5, -1.0]), true);
    assert_eq!(mixed.map(|_| ()), Err(FrameError::Polygon { index: 0 }));
}

/// A kept builder makes the same frames as new ones, and reuses its memory, whatever errors come
/// between.
#[test]
fn a_builder_that_is_kept_makes_the_same_frames() {
    let fill = |builder: &mut FrameBuilder, turn: f64| {
        let (sin, cos) = (libm::sin(turn), libm::cos(turn));
        for k in 0..40 {
            let x = f64::from(k) * 0.1 - 2.0;
            let corners = [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.5]].map(|[a, b]| {
                let (a, b) = (cos * a - sin * b, sin * a + cos * b);
                builder.vertex_from_clip([x + a, b, 0.5, 1.0 + a], [0.0, 0.0, 1.0], 0)
            });
            builder.polygon(&corners, [0.0, 0.0, 1.0], k);
            let x = SubPixel::from_num(k % 8);
            let corners = [[0, 0], [1, 4], [2, 0]].map(|[a, b]| {
                builder.vertex(Vertex {
                    x: x + SubPixel::from_num(a),
                    y: SubPixel::from_num(b),
                    depth: -0.5,
                    inv_w: 0.5,
                    normal: [0.0, 0.0, 1.0],
                    material: 0,
                })
            });
            builder
                .mean_of(&corners[..2])
                .polygon(&corners, [0.0, 0.0, 1.0], 40 + k);
        }
    };
    let builder = || {
        let mut builder = FrameBuilder::new(32, 16);
        builder.depth_range(DepthRange::Perspective {
            near: 0.5,
            far: 9.0,
        });
        let to_eye = crate::scene::Lighting::new(&Default::default(), [1.0; 3], &[], DVec3::Z);
        builder.lighting(to_eye);
        builder
    };
    let mut kept = builder();
    let mut cut = 0;
    for step in 0..9 {
        let mut new = builder();
        fill(&mut new, 0.2 * f64::from(step));
        kept.clear();
        fill(&mut kept, 0.2 * f64::from(step));
        if step == 4 {
            let lost = kept.vertex_from_clip([f64::NAN; 4], [0.0, 0.0, 1.0], 0);
            assert!(kept.frame().is_err(), "vertex {lost}");
            kept.clear();
            fill(&mut kept, 0.2 * f64::from(step));
        }
        let expected = new.finish().expect("a frame");
        // Twice, because what was passed must still be there.
        for _ in 0..2 {
            let frame = kept.frame().expect("a frame");
            assert_same(frame, &expected, "kept");
            cut += frame.stats().clipped;
        }
    }
    assert!(cut > 100, "the test asks little: {cut}");
    // A frame that someone keeps must not change.
    let before = kept.frame().expect("a frame").clone();
    let again = before.clone();
    kept.clear().size(16, 16);
    fill(&mut kept, 1.0);
    assert_eq!(kept.frame().expect("a frame").width(), 16);
    assert_same(&before, &again, "a clone");
    kept.clear_lightings();
    assert!(kept.frame().is_err(), "no material");
}
