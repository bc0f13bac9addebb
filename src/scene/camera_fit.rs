//! Placing a camera so that given points fill the picture.

use super::{Camera, Projection};
use glam::DVec3;

/// Settings for fitting a camera around points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// From the points toward the eye; any length but 0.
    pub direction: DVec3,
    /// The direction that is upward in the picture; not parallel to `direction`.
    pub up: DVec3,
    /// The part of the frame that the points fill, over 0; at 1 they touch its edge.
    pub fraction: f64,
    /// `None`: orthographic. `Some`: perspective, with this vertical field of view in degrees, inside (0, 180).
    pub fovy: Option<f64>,
    /// Width of the picture divided by its height.
    pub aspect: f64,
}

/// The part of the depth of the points that is left free before the nearest and behind the farthest one.
pub const DEPTH_SLACK: f64 = 0.05;

/// The least near distance of a perspective camera, as a part of the far distance: keeps the depth of 24 bits usable.
const LEAST_NEAR: f64 = 1e-3;

/// The least distance of the nearest point before a fitted perspective eye, as a part of the radius: matters only for
/// points on the line of sight and for fields of view near 180 degrees.
const LEAST_CLEARANCE: f64 = 1e-2;

impl Camera {
    /// Makes a camera that looks at the middle of the bounding box of `points`; they fill a part of the frame. `None` without
    /// points.
    ///
    /// Orthographic: the eye is four times the radius of the box away, and the half height is the least one that leaves
    /// every point inside the part. Perspective: the eye is as near as it can be under the same rule. Near and far
    /// planes stand [`DEPTH_SLACK`] before and behind the points. Points without extent count as having radius 1.
    pub fn fit(points: impl Iterator<Item = DVec3> + Clone, fit: &Fit) -> Option<Camera> {
        let (low, high) = bounds(points.clone())?;
        let target = (low + high) / 2.0;
        let radius = match (high - low).length() / 2.0 {
            0.0 => 1.0,
            radius => radius,
        };
        let mut camera = Camera {
            eye: target + fit.direction.normalize(),
            target,
            up: fit.up,
            projection: Projection::Orthographic {
                half_height: radius,
            },
            near: 0.0,
            far: 1.0,
        };
        let distance = match fit.fovy {
            None => {
                let half_height = camera.half_height_around(points.clone(), fit);
                camera.projection = Projection::Orthographic { half_height };
                4.0 * radius
            }
            Some(fovy) => {
                camera.projection = Projection::Perspective { fovy };
                let least = LEAST_CLEARANCE * radius;
                camera.distance_around(points.clone(), fit, fovy, least)
            }
        };
        camera.eye = target + distance * camera.view();
        (camera.near, camera.far) = camera.depth_range(points)?;
        Some(camera)
    }

    /// Returns the half height with which `points` fill the asked fraction of an orthographic picture around the target; 1 where they
    /// have no extent across the line of sight.
    pub fn half_height_around(&self, points: impl Iterator<Item = DVec3>, fit: &Fit) -> f64 {
        let [right, up, _] = self.axes();
        let half_height = points.fold(0.0, |most: f64, point| {
            let q = point - self.target;
            most.max(up.dot(q).abs())
                .max(right.dot(q).abs() / fit.aspect)
        }) / fit.fraction;
        if half_height > 0.0 { half_height } else { 1.0 }
    }

    /// Returns the distance between eye and target from which no point lies outside the asked fraction of a perspective picture or
    /// less than `clearance` before the eye.
    fn distance_around(
        &self,
        points: impl Iterator<Item = DVec3>,
        fit: &Fit,
        fovy: f64,
        clearance: f64,
    ) -> f64 {
        let [right, up, forward] = self.axes();
        // A point q from the target is seen at height (u·q) / (t (distance + f·q)), which must be at most the fraction.
        let t = fit.fraction * libm::tan(fovy.to_radians() / 2.0);
        points.fold(clearance, |most: f64, point| {
            let q = point - self.target;
            let depth = forward.dot(q);
            most.max(clearance - depth)
                .max(up.dot(q).abs() / t - depth)
                .max(right.dot(q).abs() / (t * fit.aspect) - depth)
        })
    }

    /// Returns distances of a near and a far plane that hold all of `points` between them with [`DEPTH_SLACK`]; `None` without
    /// points, or when a perspective camera has none of them before it.
    pub fn depth_range(&self, points: impl Iterator<Item = DVec3>) -> Option<(f64, f64)> {
        let [_, _, forward] = self.axes();
        // From the target, not from the eye: a far eye costs no digits in the slack.
        let distance = (self.target - self.eye).dot(forward);
        let depths = points.map(|point| forward.dot(point - self.target));
        let (least, most) = depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| {
            (a.min(d), b.max(d))
        });
        if least > most {
            return None;
        }
        let slack = match DEPTH_SLACK * (most - least) {
            // A flat thing seen from the front: any slack will do that still shows in the last digits of the sum.
            slack if slack <= 1e-9 * (distance.abs() + most.abs()) => {
                1e-3 * (distance.abs() + most.abs()).max(1e-3)
            }
            slack => slack,
        };
        let (near, far) = (distance + least - slack, distance + most + slack);
        match self.projection {
            Projection::Orthographic { .. } => Some((near, far)),
            Projection::Perspective { .. } if distance + most <= 0.0 => None,
            Projection::Perspective { .. } => Some((near.max(LEAST_NEAR * far), far)),
        }
    }
}

/// Returns the smallest box with sides along the axes around `points`; `None` without points.
fn bounds(mut points: impl Iterator<Item = DVec3>) -> Option<(DVec3, DVec3)> {
    let first = points.next()?;
    Some(points.fold((first, first), |(low, high), p| (low.min(p), high.max(p))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// The corners of a box that is not centred on the origin.
    fn box_corners() -> Vec<DVec3> {
        let mut corners = Vec::new();
        for x in [1.0, 4.0] {
            for y in [-2.0, -1.0] {
                for z in [0.5, 2.5] {
                    corners.push(DVec3::new(x, y, z));
                }
            }
        }
        corners
    }

    fn fit(fovy: Option<f64>) -> Fit {
        Fit {
            direction: DVec3::new(0.5, 0.3, 1.0),
            up: DVec3::Y,
            fraction: 0.8,
            fovy,
            aspect: 4.0 / 3.0,
        }
    }

    /// The largest |x|/w and |y|/w, and the range of z/w, over the picture of `points`.
    fn extent(camera: &Camera, points: &[DVec3], aspect: f64) -> (f64, f64, f64) {
        let matrix = camera.clip_matrix(aspect);
        points.iter().fold(
            (0.0, f64::INFINITY, f64::NEG_INFINITY),
            |(most, low, high): (f64, f64, f64), p| {
                let c = matrix * p.extend(1.0);
                (
                    most.max((c.x / c.w).abs()).max((c.y / c.w).abs()),
                    low.min(c.z / c.w),
                    high.max(c.z / c.w),
                )
            },
        )
    }

    #[test]
    fn points_fill_the_part_of_the_frame_exactly() {
        for fovy in [None, Some(5.0), Some(40.0), Some(120.0)] {
            for fraction in [0.3, 0.8, 1.0] {
                for (aspect, every_corner) in [
                    (0.25, true),
                    (1.0, true),
                    (4.0, true),
                    (4.0, false),
                    (0.25, false),
                ] {
                    let mut points = box_corners();
                    if !every_corner {
                        // Without the box's symmetry, in which a wrong sign of the depth would not show.
                        points = [0, 3, 5, 6].map(|i| points[i]).to_vec();
                    }
                    let fit = Fit {
                        fraction,
                        aspect,
                        ..fit(fovy)
                    };
                    let camera =
                        Camera::fit(points.iter().copied(), &fit).expect("there are points");
                    let (most, low, high) = extent(&camera, &points, aspect);
                    // Some 30 roundings of 2^-53, magnified by distance over depth (below 100 here): under 1e-12.
                    assert!(
                        (most - fraction).abs() < 1e-12,
                        "{fovy:?} {fraction} {aspect}: {most}"
                    );
                    assert!(
                        0.0 < low && high < 1.0,
                        "{fovy:?} {fraction} {aspect}: depth {low} to {high}"
                    );
                    assert_eq!(camera.target, DVec3::new(2.5, -1.5, 1.5));
                    // `view` normalises twice here, each time with a few roundings of 2^-53.
                    assert!((camera.view() - fit.direction.normalize()).length() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn orthographic_eye_and_planes_follow_the_rule() {
        let points = box_corners();
        let camera = Camera::fit(points.iter().copied(), &fit(None)).expect("there are points");
        let radius = DVec3::new(3.0, 1.0, 2.0).length() / 2.0;
        // Sums of three products of size 10 at most: ten roundings of 10 · 2^-53 stay below 1e-13.
        assert!(((camera.eye - camera.target).length() - 4.0 * radius).abs() < 1e-13);
        let [_, _, forward] = camera.axes();
        let half = 0.5 * DVec3::new(3.0, 1.0, 2.0).dot(forward.abs());
        assert!((camera.near - (4.0 * radius - half - 0.05 * 2.0 * half)).abs() < 1e-13);
        assert!((camera.far - (4.0 * radius + half + 0.05 * 2.0 * half)).abs() < 1e-13);
    }

    /// Without extent across or along the line of sight there is still a camera with a valid frustum.
    #[test]
    fn points_without_extent() {
        let flat = [
            DVec3::new(0.0, 0.0, 7.0),
            DVec3::new(1.0, 0.0, 7.0),
            DVec3::new(0.0, 1.0, 7.0),
        ];
        let along = [DVec3::ZERO, DVec3::new(0.0, 0.0, 3.0)];
        let far_away = [DVec3::new(1e12, 0.0, 0.0)];
        for points in [&flat[..1], &flat, &along, &far_away] {
            for fovy in [None, Some(60.0)] {
                let fit = Fit {
                    direction: DVec3::Z,
                    ..fit(fovy)
                };
                let camera = Camera::fit(points.iter().copied(), &fit).expect("there are points");
                assert!(camera.near < camera.far, "{points:?} {fovy:?}: {camera:?}");
                assert!(
                    camera.near > 0.0 && camera.eye != camera.target,
                    "{points:?} {fovy:?}: {camera:?}"
                );
                if let Projection::Orthographic { half_height } = camera.projection {
                    assert!(half_height > 0.0);
                }
                let (_, low, high) = extent(&camera, points, 1.0);
                assert!(
                    0.0 < low && high < 1.0,
                    "{points:?} {fovy:?}: depth {low} to {high}"
                );
            }
        }
        assert_eq!(Camera::fit(core::iter::empty(), &fit(None)), None);
    }

    #[test]
    fn nothing_before_a_perspective_eye_has_no_depth_range() {
        let mut camera =
            Camera::fit(box_corners().into_iter(), &fit(Some(60.0))).expect("there are points");
        // The eye inside the box: the near plane stays before it.
        camera.eye = camera.target + camera.view();
        let (near, far) = camera
            .depth_range(box_corners().into_iter())
            .expect("points before the eye");
        assert_eq!(near, LEAST_NEAR * far);
        // Looking away from the box.
        camera.eye = camera.target - 100.0 * camera.view();
        camera.target = camera.eye - (camera.target - camera.eye);
        assert_eq!(camera.depth_range(box_corners().into_iter()), None);
    }
}
