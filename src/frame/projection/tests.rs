//! Compares frames with polygons projected one by one. Also tests reused frames and threads.

use super::side::eye_side;
use super::view::{BEYOND_PLANES, View};
use crate::frame::{Frame, FrameError, FrameItem, FrameStats, Polygon, Vertex};
use crate::mesh::newell::{polygon_normal, unit_normal};
use crate::mesh::vertex_normals::vertex_normals;
use crate::scene::input::{SCENES, resolve};
use crate::scene::{
    Camera, Clipping, Culling, HiddenSurfaces, Interpolation, Object, Projection, Scene,
};
use alloc::collections::BTreeSet;
use alloc::vec;
use alloc::vec::Vec;
use glam::{DMat3, DMat4, DVec3, DVec4};

/// A corner with all its frame data: vertex, position from the eye, colour.
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
    /// The numbers of polygons that must be clipped.
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
/// numbers. Pieces of clipped polygons keep the place of the whole.
#[test]
fn frames_equal_plain_projection() {
    let mut cut = 0;
    // The scene `million` has the sphere of the others.
    for scene in SCENES.iter().filter(|scene| scene.name != "million") {
        for (number, variant) in variants(&shipped(scene.name)).iter().enumerate() {
            let name = alloc::format!("{}, variant {number}", scene.name);
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
            for (number, &camera) in cameras.iter().chain(&cameras).enumerate() {
                prepared.set_camera(camera);
                prepared.frame_into(&mut frame).expect("a frame");
                let new = Scene {
                    camera,
                    ..scene.clone()
                }
                .frame()
                .expect("a frame");
                assert_same(&frame, &new, &alloc::format!("{name}, camera {number}"));
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
    assert!(matches!(refused, Err(FrameError::Number { item: of, .. }) if of == item));
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

/// A frame knows it without looking at each of its materials, whichever of them it is that is local.
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
