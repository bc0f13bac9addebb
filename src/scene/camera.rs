//! The camera: the transform from world space to clip space, and the scene's one view vector.

use super::direction::{as_unit, length};
use super::ranges;
use glam::{DMat4, DVec3, DVec4};

/// How the camera projects points onto the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Parallel rays.
    Orthographic {
        /// Half of the visible height, in world units.
        half_height: f64,
    },
    /// Rays through the eye.
    Perspective {
        /// The vertical field of view in degrees, above 0 and below 180.
        fovy: f64,
    },
}

/// Where the eye is, where it looks, and what it sees.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Camera {
    /// Position of the eye in world space.
    pub eye: DVec3,
    /// The point that is seen in the middle of the picture.
    pub target: DVec3,
    /// The direction that is upward in the picture, of any length, but not parallel to the line of
    /// sight.
    pub up: DVec3,
    /// Orthographic or perspective.
    pub projection: Projection,
    /// The distance of the near plane along the line of sight. Above 0 under perspective.
    pub near: f64,
    /// The distance of the far plane along the line of sight, greater than `near`. Infinity
    /// stands for 10²⁰.
    pub far: f64,
}

impl Camera {
    /// Makes a camera at `eye` that looks at `target`, with y upward in the picture. The near and
    /// the far plane stand at a hundredth and at a hundred times the distance of the target. All
    /// fields can be changed afterwards.
    ///
    /// ```
    /// use fastphong::glam::DVec3;
    /// use fastphong::scene::{Camera, Projection};
    ///
    /// let eye = DVec3::new(0.0, 1.0, 5.0);
    /// let mut camera = Camera::looking_at(eye, DVec3::ZERO, Projection::Perspective { fovy: 40.0 });
    /// camera.near = 1.0;
    /// ```
    pub fn looking_at(eye: DVec3, target: DVec3, projection: Projection) -> Camera {
        let distance = length(target - eye);
        Camera {
            eye,
            target,
            up: DVec3::Y,
            projection,
            near: distance / 100.0,
            far: distance * 100.0,
        }
    }

    /// Returns the unit vector `V` toward the eye. It is the same for the whole scene, also under
    /// perspective (L21 1).
    pub fn view(&self) -> DVec3 {
        in_range(self.eye - self.target).normalize()
    }

    /// Returns the distances of the near and the far plane, as they are computed with.
    pub(crate) fn planes(&self) -> [f64; 2] {
        [self.near, ranges::far(self.far)]
    }

    /// Returns unit vectors to the right, upward and forward. The camera is right-handed and looks
    /// along `forward`.
    pub fn axes(&self) -> [DVec3; 3] {
        let forward = -self.view();
        let right = forward.cross(as_unit(self.up)).normalize();
        [right, right.cross(forward), forward]
    }

    /// Returns the matrix from world space to clip space. x and y lie in −w..=w from left to right
    /// and from bottom to top, and z in 0..=w from near to far. `aspect` is the picture's width
    /// over its height.
    pub fn clip_matrix(&self, aspect: f64) -> DMat4 {
        let [near, far] = self.planes();
        let depth = far - near;
        self.matrix(
            aspect,
            match self.projection {
                Projection::Orthographic { .. } => [1.0 / depth, -near / depth],
                Projection::Perspective { .. } => [far / depth, -far * near / depth],
            },
        )
    }

    /// Returns the matrix to the clip space in which polygons are clipped. Under perspective its z
    /// is (f − w)/(f − n), which falls from 1 at the near plane to 0 at the far one. With a very
    /// near near plane, the z of [`Camera::clip_matrix`] is w but for rounding, and clipping could
    /// not find the far plane by it.
    pub(crate) fn precise_clip_matrix(&self, aspect: f64) -> DMat4 {
        let [near, far] = self.planes();
        let depth = far - near;
        match self.projection {
            Projection::Orthographic { .. } => self.clip_matrix(aspect),
            Projection::Perspective { .. } => self.matrix(aspect, [-1.0 / depth, far / depth]),
        }
    }

    /// Returns the matrix whose z is `z[0]` times the distance along the line of sight, plus
    /// `z[1]`.
    fn matrix(&self, aspect: f64, z: [f64; 2]) -> DMat4 {
        let [right, up, forward] = self.axes();
        let row = |axis: DVec3, scale: f64, offset: f64| {
            let axis = axis * scale;
            axis.extend(offset - axis.dot(self.eye))
        };
        let rows = match self.projection {
            Projection::Orthographic { half_height } => {
                let scale = 1.0 / half_height;
                [
                    row(right, scale / aspect, 0.0),
                    row(up, scale, 0.0),
                    row(forward, z[0], z[1]),
                    DVec4::W,
                ]
            }
            Projection::Perspective { fovy } => {
                let scale = 1.0 / libm::tan(fovy.to_radians() / 2.0);
                [
                    row(right, scale / aspect, 0.0),
                    row(up, scale, 0.0),
                    row(forward, z[0], z[1]),
                    row(forward, 1.0, 0.0),
                ]
            }
        };
        DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
    }
}

/// Returns a vector in the same direction whose square neither overflows nor underflows. A vector
/// that is in range is returned unchanged.
fn in_range(vector: DVec3) -> DVec3 {
    let size = vector.abs().max_element();
    if (1e-100..=1e100).contains(&size) {
        vector
    } else {
        vector / size
    }
}
