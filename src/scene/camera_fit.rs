//! Places a camera so that given points fill the picture.

use super::{Camera, Projection, Scene};
use glam::DVec3;

/// How to place a camera around points, for [`Camera::fit`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fit {
    /// The direction from the points toward the eye, of any length but 0.
    pub direction: DVec3,
    /// The direction that is upward in the picture, not parallel to `direction`.
    pub up: DVec3,
    /// The fraction of the picture that the points fill, above 0. At 1 they touch its edge.
    pub fraction: f64,
    /// The vertical field of view in degrees, above 0 and below 180, of a perspective camera;
    /// `None` for an orthographic one.
    pub fovy: Option<f64>,
    /// The picture's width over its height.
    pub aspect: f64,
}

impl Fit {
    /// Makes a fit for an orthographic camera in this `direction`, with y upward. The points fill
    /// 0.8 of a picture whose width over height is `aspect`.
    pub fn new(direction: DVec3, aspect: f64) -> Fit {
        Fit {
            direction,
            up: DVec3::Y,
            fraction: Scene::DEFAULT_FIT,
            fovy: None,
            aspect,
        }
    }
}

/// The free space in front of the nearest and behind the farthest point, as a fraction of the depth
/// of the points.
const DEPTH_SLACK: f64 = 0.05;

/// The smallest near distance of a perspective camera, as a fraction of the far distance. It keeps
/// a depth buffer of 24 bits usable.
const LEAST_NEAR: f64 = 1e-3;

/// The smallest distance from a fitted perspective eye to the nearest point, as a fraction of the
/// radius. It matters only for points on the line of sight and for fields of view near 180 degrees.
const LEAST_CLEARANCE: f64 = 1e-2;

impl Camera {
    /// Makes a camera that looks at the middle of the bounding box of `points`, which fill a
    /// fraction of the picture. Returns `None` if there are no points.
    ///
    /// An orthographic eye stands four radii of the box away, and the half height is the smallest
    /// that keeps every point inside the fraction. A perspective eye stands as near as the same
    /// rule allows. The near plane is 5 % of the points' depth in front of them, and the far plane
    /// 5 % behind. If all points are equal, the radius counts as 1.
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

    /// Returns the half height with which `points` fill the fraction of an orthographic picture
    /// around the target. It is 1 if the points have no extent across the line of sight.
    pub fn half_height_around(&self, points: impl Iterator<Item = DVec3>, fit: &Fit) -> f64 {
        let [right, up, _] = self.axes();
        let half_height = points.fold(0.0, |most: f64, point| {
            let q = point - self.target;
            most.max(up.dot(q).abs())
                .max(right.dot(q).abs() / fit.aspect)
        }) / fit.fraction;
        if half_height > 0.0 { half_height } else { 1.0 }
    }

    /// Returns the smallest distance from eye to target at which every point lies inside the
    /// fraction of a perspective picture and at least `clearance` in front of the eye.
    fn distance_around(
        &self,
        points: impl Iterator<Item = DVec3>,
        fit: &Fit,
        fovy: f64,
        clearance: f64,
    ) -> f64 {
        let [right, up, forward] = self.axes();
        // A point q, relative to the target, is seen at the height (u·q) / (tan(fovy/2) (distance +
        // f·q)). It must be at most the fraction. Solve for the distance.
        let t = fit.fraction * libm::tan(fovy.to_radians() / 2.0);
        points.fold(clearance, |most: f64, point| {
            let q = point - self.target;
            let depth = forward.dot(q);
            most.max(clearance - depth)
                .max(up.dot(q).abs() / t - depth)
                .max(right.dot(q).abs() / (t * fit.aspect) - depth)
        })
    }

    /// Returns the distances of a near and a far plane with all `points` and 5 % of their depth
    /// between them. Returns `None` if there are no points, or if a perspective camera has none of
    /// them in front of it.
    pub fn depth_range(&self, points: impl Iterator<Item = DVec3>) -> Option<(f64, f64)> {
        let [_, _, forward] = self.axes();
        // Measured from the target and not from the eye, so that the slack loses no digits when the
        // eye is far away.
        let distance = (self.target - self.eye).dot(forward);
        let depths = points.map(|point| forward.dot(point - self.target));
        let (least, most) = depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| {
            (a.min(d), b.max(d))
        });
        if least > most {
            return None;
        }
        let slack = match DEPTH_SLACK * (most - least) {
            // A flat object seen from the front has no depth. Any slack will do that survives the
            // rounding of the sum.
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

/// Returns the smallest axis-aligned box around `points`, or `None` if there are none.
pub(super) fn bounds(mut points: impl Iterator<Item = DVec3>) -> Option<(DVec3, DVec3)> {
    let first = points.next()?;
    Some(points.fold((first, first), |(low, high), p| (low.min(p), high.max(p))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    /// Returns the corners of a box that is not centred on the origin.
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

    /// Returns the largest |x|/w and |y|/w, and the range of z/w, over the picture of `points`.
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
                        // Without the box's symmetry, which could hide a wrong sign of the depth.
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
                    // Some 30 roundings of 2^-53, magnified by distance over depth (below 100
                    // here), are under 1e-12.
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
        // These are sums of three products of at most 10: ten roundings of 10 · 2^-53 stay below
        // 1e-13.
        assert!(((camera.eye - camera.target).length() - 4.0 * radius).abs() < 1e-13);
        let [_, _, forward] = camera.axes();
        let half = 0.5 * DVec3::new(3.0, 1.0, 2.0).dot(forward.abs());
        assert!((camera.near - (4.0 * radius - half - 0.05 * 2.0 * half)).abs() < 1e-13);
        assert!((camera.far - (4.0 * radius + half + 0.05 * 2.0 * half)).abs() < 1e-13);
    }

    /// Points without extent across or along the line of sight still get a camera with a valid
    /// frustum.
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
        // The eye is inside the box: the near plane stays in front of it.
        camera.eye = camera.target + camera.view();
        let (near, far) = camera
            .depth_range(box_corners().into_iter())
            .expect("points before the eye");
        assert_eq!(near, LEAST_NEAR * far);
        // The camera looks away from the box.
        camera.eye = camera.target - 100.0 * camera.view();
        camera.target = camera.eye - (camera.target - camera.eye);
        assert_eq!(camera.depth_range(box_corners().into_iter()), None);
    }
}
