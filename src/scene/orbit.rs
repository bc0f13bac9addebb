//! The camera of a scene that is turned by hand: the scene's own camera, turned around its target
//! and moved nearer.

use super::{Camera, Light, Projection, Scene};
use alloc::vec::Vec;
use glam::{DMat3, DQuat, DVec3};

/// The highest elevation above the horizon, in radians. At 90 degrees the scene's up would be along
/// the line of sight.
const HIGHEST: f64 = 89.0 * core::f64::consts::PI / 180.0;

/// The smallest and the largest zoom.
const ZOOMS: [f64; 2] = [1.0 / 16.0, 64.0];

/// The camera at which an orbit starts, and what it must keep in view.
#[derive(Clone, Debug)]
pub struct Start {
    camera: Camera,
    /// The width over the height of the picture for which the camera was made.
    aspect: f64,
    /// The corners of the objects' bounding boxes, in world space. Everything that is drawn lies
    /// between them.
    corners: Vec<DVec3>,
    /// The distances of the near and the far plane that the scene states. They never change.
    planes: [Option<f64>; 2],
}

impl Start {
    /// Returns the start of `scene`. `given` says whether the scene states the near and the far
    /// plane, which then stay where they are.
    pub fn new(scene: &Scene, given: [bool; 2]) -> Start {
        let mut corners = Vec::new();
        for object in &scene.objects {
            let Some((low, high)) = object.mesh.bounds() else {
                continue;
            };
            for corner in 0..8 {
                let pick = |axis: usize| match corner >> axis & 1 {
                    0 => low[axis],
                    _ => high[axis],
                };
                let corner = DVec3::new(pick(0), pick(1), pick(2));
                corners.push(object.transform.transform_point3(corner));
            }
        }
        let camera = scene.camera;
        Start {
            camera,
            aspect: f64::from(scene.width) / f64::from(scene.height),
            corners,
            planes: [
                given[0].then_some(camera.near),
                given[1].then_some(camera.far),
            ],
        }
    }

    /// Returns the direction to the first of `lights` in coordinates of the camera: to the right,
    /// upward, and toward the eye. For a light at a position it is the direction from the target.
    /// Returns `None` if there is no light, or it stands at the target.
    pub fn toward_light(&self, lights: &[Light]) -> Option<[f64; 3]> {
        let toward = toward_first(lights, self.camera.target)?;
        let [right, up, forward] = self.camera.axes();
        Some([right, up, -forward].map(|axis| axis.dot(toward)))
    }

    /// Returns the upward direction, the horizontal direction toward the eye, the horizontal
    /// direction to its right, and the elevation of the eye.
    fn horizon(&self) -> ([DVec3; 3], f64) {
        let pole = self.camera.up.normalize();
        let toward = self.camera.view();
        let height = toward.dot(pole);
        let front = (toward - height * pole).normalize();
        let elevation = libm::asin(height.clamp(-1.0, 1.0));
        ([pole, front, pole.cross(front)], elevation)
    }
}

/// How far the camera was turned and zoomed from its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    azimuth: f64,
    elevation: f64,
    zoom: f64,
}

impl Default for Orbit {
    fn default() -> Self {
        Orbit {
            azimuth: 0.0,
            elevation: 0.0,
            zoom: 1.0,
        }
    }
}

impl Orbit {
    /// Turns the eye to its right by `azimuth` and upward by `elevation`, both in radians. It stops
    /// before the poles.
    pub fn turn(&mut self, start: &Start, azimuth: f64, elevation: f64) {
        let (_, at_start) = start.horizon();
        // A scene may start beyond the limit. It stays there until it is lowered.
        let highest = HIGHEST.max(at_start.abs());
        let raised = at_start + self.elevation + elevation;
        self.elevation = raised.clamp(-highest, highest) - at_start;
        self.azimuth = libm::remainder(self.azimuth + azimuth, core::f64::consts::TAU);
    }

    /// Returns azimuth and elevation relative to the start, in radians.
    pub fn angles(&self) -> [f64; 2] {
        [self.azimuth, self.elevation]
    }

    /// Magnifies the picture by `factor`, within limits.
    pub fn zoom(&mut self, factor: f64) {
        self.zoom = (self.zoom * factor).clamp(ZOOMS[0], ZOOMS[1]);
    }

    /// Returns the camera for a picture with this width over height. A narrower picture shows
    /// everything that the start's picture shows.
    pub fn camera(&self, start: &Start, aspect: f64) -> Camera {
        let mut camera = start.camera;
        let wider = start.aspect / aspect;
        if wider > 1.0 {
            camera.projection = widened(camera.projection, wider);
        }
        // At the start the camera is the scene's own, to the bit, so that the picture equals the
        // one that `render` writes.
        if *self == Orbit::default() {
            return camera;
        }
        let ([pole, front, right], at_start) = start.horizon();
        let (sin, cos) = libm::sincos(self.azimuth);
        let level = cos * front + sin * right;
        let (sin, cos) = libm::sincos(at_start + self.elevation);
        let toward = cos * level + sin * pole;
        let mut distance = (camera.eye - camera.target).length();
        match &mut camera.projection {
            Projection::Orthographic { half_height } => *half_height /= self.zoom,
            Projection::Perspective { .. } => distance /= self.zoom,
        }
        camera.eye = camera.target + distance * toward;
        let fitted = camera.depth_range(start.corners.iter().copied());
        if let Some((near, far)) = fitted {
            let [given_near, given_far] = start.planes;
            let (near, far) = (given_near.unwrap_or(near), given_far.unwrap_or(far));
            if near < far {
                (camera.near, camera.far) = (near, far);
            }
        }
        camera
    }

    /// Returns `lights` turned together with the eye around its target. Seen from the eye they stay
    /// where they were.
    pub fn carry(&self, start: &Start, lights: &[Light]) -> Vec<Light> {
        let axes = |camera: &Camera| {
            let [right, up, forward] = camera.axes();
            DMat3::from_cols(right, up, forward)
        };
        // The inverse of a rotation is its transpose.
        let turned = axes(&self.camera(start, start.aspect)) * axes(&start.camera).transpose();
        turned_about(start.camera.target, turned, lights)
    }

    /// Returns `lights` as [`Orbit::carry`] does, and then turns all of them together so that the
    /// first one stands `toward`, in the coordinates of [`Start::toward_light`].
    pub fn carry_toward(&self, start: &Start, lights: &[Light], toward: [f64; 3]) -> Vec<Light> {
        let carried = self.carry(start, lights);
        let target = start.camera.target;
        let Some(from) = toward_first(&carried, target) else {
            return carried;
        };
        let [right, up, forward] = self.camera(start, start.aspect).axes();
        let to = toward[0] * right + toward[1] * up - toward[2] * forward;
        let Some(to) = to.try_normalize() else {
            return carried;
        };
        turned_about(
            target,
            DMat3::from_quat(DQuat::from_rotation_arc(from, to)),
            &carried,
        )
    }
}

/// Returns the direction from `target` to the first light.
fn toward_first(lights: &[Light], target: DVec3) -> Option<DVec3> {
    let place = lights.first()?.place;
    let mut toward = DVec3::ZERO;
    place.map(|at| {
        toward = if place.is_local() { at - target } else { at };
        at
    });
    toward.try_normalize()
}

/// Turns lights around `target`.
fn turned_about(target: DVec3, turn: DMat3, lights: &[Light]) -> Vec<Light> {
    let turned = |light: &Light| {
        let place = if light.place.is_local() {
            light.place.map(|at| target + turn * (at - target))
        } else {
            light.place.map(|toward| (turn * toward).normalize())
        };
        Light { place, ..*light }
    };
    lights.iter().map(turned).collect()
}

/// Returns the projection that shows `times` as much in width and height.
fn widened(projection: Projection, times: f64) -> Projection {
    match projection {
        Projection::Orthographic { half_height } => Projection::Orthographic {
            half_height: half_height * times,
        },
        Projection::Perspective { fovy } => {
            let half = libm::atan(times * libm::tan(fovy.to_radians() / 2.0));
            Projection::Perspective {
                fovy: (2.0 * half).to_degrees(),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::builtin::builtin;
    use core::f64::consts::{FRAC_PI_2, PI};

    fn scene(fovy: Option<f64>) -> Scene {
        let mut scene = Scene::of_mesh(builtin("torus").expect("a shape"));
        scene.camera.eye = DVec3::new(0.0, 3.0, 4.0);
        scene.camera.target = DVec3::ZERO;
        scene.camera.up = DVec3::Y;
        if let Some(fovy) = fovy {
            scene.camera.projection = Projection::Perspective { fovy };
        }
        scene
    }

    /// Some dozens of roundings of values below 10, each at most 10 · 2^-53.
    const ROUNDING: f64 = 1e-13;

    #[test]
    fn nothing_done_is_the_camera_of_the_scene_to_the_bit() {
        let scene = scene(None);
        let start = Start::new(&scene, [false; 2]);
        let mut orbit = Orbit::default();
        assert_eq!(orbit.camera(&start, 4.0 / 3.0), scene.camera);
        orbit.turn(&start, 1.0, 0.1);
        assert_ne!(orbit.camera(&start, 4.0 / 3.0), scene.camera);
    }

    #[test]
    fn a_quarter_turn_stands_to_the_right_at_the_same_height_and_distance() {
        let start = Start::new(&scene(None), [false; 2]);
        let mut orbit = Orbit::default();
        orbit.turn(&start, FRAC_PI_2, 0.0);
        let eye = orbit.camera(&start, 1.0).eye;
        assert!(
            (eye - DVec3::new(4.0, 3.0, 0.0)).length() < ROUNDING,
            "{eye}"
        );
        // Three more quarter turns close the circle.
        for _ in 0..3 {
            orbit.turn(&start, FRAC_PI_2, 0.0);
        }
        let eye = orbit.camera(&start, 1.0).eye;
        assert!(
            (eye - DVec3::new(0.0, 3.0, 4.0)).length() < ROUNDING,
            "{eye}"
        );
    }

    #[test]
    fn elevation_ends_before_the_pole_and_comes_back_at_once() {
        let start = Start::new(&scene(None), [false; 2]);
        let mut orbit = Orbit::default();
        orbit.turn(&start, 0.0, PI);
        let high = orbit.camera(&start, 1.0).view().dot(DVec3::Y);
        assert!((high - libm::sin(HIGHEST)).abs() < ROUNDING, "{high}");
        orbit.turn(&start, 0.0, -0.5);
        let lower = orbit.camera(&start, 1.0).view().dot(DVec3::Y);
        assert!((lower - libm::sin(HIGHEST - 0.5)).abs() < ROUNDING);
    }

    /// A scene that looks nearly along its up keeps that view, although it is beyond the limit.
    #[test]
    fn a_start_beyond_the_limit_stays_until_it_is_lowered() {
        let mut scene = scene(None);
        scene.camera.eye = DVec3::new(0.0, 5.0, 1e-3);
        let start = Start::new(&scene, [false; 2]);
        let mut orbit = Orbit::default();
        orbit.turn(&start, 1.0, 1.0);
        let camera = orbit.camera(&start, 1.0);
        assert!((camera.eye.y - 5.0).abs() < 1e-6, "{camera:?}");
        assert!(camera.axes().iter().all(|axis| axis.is_finite()));
    }

    #[test]
    fn zoom_narrows_a_parallel_view_and_brings_a_perspective_eye_nearer() {
        let parallel = scene(None);
        let start = Start::new(&parallel, [false; 2]);
        let mut orbit = Orbit::default();
        orbit.zoom(2.0);
        let half = |camera: &Camera| match camera.projection {
            Projection::Orthographic { half_height } => half_height,
            Projection::Perspective { .. } => f64::NAN,
        };
        let camera = orbit.camera(&start, 4.0 / 3.0);
        assert_eq!(half(&camera), half(&parallel.camera) / 2.0);
        let start = Start::new(&scene(Some(40.0)), [false; 2]);
        let camera = orbit.camera(&start, 4.0 / 3.0);
        assert!((camera.eye.length() - 2.5).abs() < ROUNDING);
        orbit.zoom(1e9);
        let camera = orbit.camera(&start, 1.0);
        assert!((camera.eye.length() - 5.0 / ZOOMS[1]).abs() < ROUNDING);
        assert!(0.0 < camera.near && camera.near < camera.far);
    }

    #[test]
    fn planes_hold_the_objects_from_everywhere_unless_they_are_given() {
        let scene = scene(Some(40.0));
        let start = Start::new(&scene, [false; 2]);
        let mut orbit = Orbit::default();
        for _ in 0..12 {
            orbit.turn(&start, 0.7, 0.4);
            let camera = orbit.camera(&start, 1.0);
            let [_, _, forward] = camera.axes();
            for corner in &start.corners {
                let depth = forward.dot(*corner - camera.eye);
                assert!(camera.near <= depth && depth <= camera.far);
            }
        }
        let start = Start::new(&scene, [true, false]);
        let camera = orbit.camera(&start, 1.0);
        assert_eq!(camera.near, scene.camera.near);
    }

    #[test]
    fn a_narrow_window_shows_what_the_scene_shows_in_width() {
        for fovy in [None, Some(50.0)] {
            let scene = scene(fovy);
            let start = Start::new(&scene, [false; 2]);
            let width = |camera: &Camera, aspect: f64| 1.0 / camera.clip_matrix(aspect).row(0).x;
            let before = width(&scene.camera, 4.0 / 3.0);
            let narrow = width(&Orbit::default().camera(&start, 0.5), 0.5);
            // A tangent and its arc, some ten roundings.
            assert!(
                (narrow / before - 1.0).abs() < 1e-14,
                "{fovy:?}: {narrow} {before}"
            );
            assert_eq!(Orbit::default().camera(&start, 2.0), scene.camera);
        }
    }

    #[test]
    fn lights_turn_together_to_where_the_first_one_is_put() {
        let scene = scene(None);
        let start = Start::new(&scene, [false; 2]);
        let directions = [DVec3::new(0.6, 0.8, 0.0), DVec3::Z];
        let lights = directions.map(|toward| Light::directional(toward, [1.0; 3]));
        let at_start = start.toward_light(&lights).expect("a light");
        let mut orbit = Orbit::default();
        orbit.turn(&start, 1.0, -0.4);
        let near = |a: [f64; 3], b: [f64; 3]| {
            (DVec3::from_array(a) - DVec3::from_array(b)).length() < ROUNDING
        };
        let seen = |lights: &[Light]| {
            let turned = Start {
                camera: orbit.camera(&start, start.aspect),
                ..start.clone()
            };
            turned.toward_light(lights).expect("a light")
        };
        let same = orbit.carry_toward(&start, &lights, at_start);
        assert!(near(seen(&same), at_start), "{same:?}");
        let put = [0.48, -0.6, 0.64];
        let moved = orbit.carry_toward(&start, &lights, put);
        assert!(near(seen(&moved), put), "{moved:?}");
        // The angle between both lights stays.
        let angle = |lights: &[Light]| {
            let toward = |i: usize| toward_first(&lights[i..], DVec3::ZERO).expect("a direction");
            toward(0).dot(toward(1))
        };
        assert!((angle(&moved) - angle(&lights)).abs() < ROUNDING);
    }

    #[test]
    fn carried_lights_stay_where_they_are_for_the_eye() {
        let scene = scene(None);
        let start = Start::new(&scene, [false; 2]);
        let lights = [
            Light::directional(DVec3::new(0.6, 0.8, 0.0), [1.0; 3]),
            Light {
                place: super::super::Place::Local(DVec3::new(1.0, 2.0, 3.0)),
                ..Light::directional(DVec3::X, [1.0; 3])
            },
        ];
        let mut orbit = Orbit::default();
        orbit.turn(&start, 2.0, -0.9);
        let carried = orbit.carry(&start, &lights);
        let seen = |camera: &Camera, light: &Light| {
            let mut v = DVec3::ZERO;
            light.place.map(|at| v = at);
            DVec3::from_array(camera.axes().map(|axis| axis.dot(v)))
        };
        let now = orbit.camera(&start, 1.0);
        for (light, carried) in lights.iter().zip(&carried) {
            let difference = seen(&scene.camera, light) - seen(&now, carried);
            assert!(difference.length() < ROUNDING, "{difference}");
        }
    }
}
