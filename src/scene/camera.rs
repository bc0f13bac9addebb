//! The camera: from world space to clip space, and the one view vector of the scene.

use super::direction::as_unit;
use glam::{DMat4, DVec3, DVec4};

/// A way to fold depth onto the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Parallel rays; `half_height` is half of the height that is seen, in world units.
    Orthographic {
        /// Half of the height seen.
        half_height: f64,
    },
    /// Rays through the eye; `fovy` is the vertical field of view in degrees, inside (0, 180).
    Perspective {
        /// Vertical field of view in degrees.
        fovy: f64,
    },
}

/// The place from which the scene is seen, and the direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position of the eye in world space.
    pub eye: DVec3,
    /// The point in the middle of the picture.
    pub target: DVec3,
    /// The direction that is upward in the picture, of any length; not parallel to the line of sight.
    pub up: DVec3,
    /// Orthographic or perspective.
    pub projection: Projection,
    /// Distance of the near plane along the line of sight; over 0 under perspective.
    pub near: f64,
    /// Distance of the far plane, over `near`.
    pub far: f64,
}

impl Camera {
    /// Returns the unit vector `V` toward the eye: one for the whole scene, under perspective too (L21 1).
    pub fn view(&self) -> DVec3 {
        in_range(self.eye - self.target).normalize()
    }

    /// Returns right, up and forward unit vectors: a right-handed camera looking along `forward`.
    pub fn axes(&self) -> [DVec3; 3] {
        let forward = -self.view();
        let right = forward.cross(as_unit(self.up)).normalize();
        [right, right.cross(forward), forward]
    }

    /// Returns the matrix from world space to clip space: x and y in −w..=w from left to right and bottom to top, z in 0..=w from near to far.
    pub fn clip_matrix(&self, aspect: f64) -> DMat4 {
        let depth = self.far - self.near;
        self.matrix(
            aspect,
            match self.projection {
                Projection::Orthographic { .. } => [1.0 / depth, -self.near / depth],
                Projection::Perspective { .. } => [self.far / depth, -self.far * self.near / depth],
            },
        )
    }

    /// Returns the matrix to the clip space in which polygons are clipped. Under perspective its z is
    /// (f − w)/(f − n), from 1 at the near plane to 0 at the far one: that of [`Camera::clip_matrix`]
    /// is w but for rounding where the near plane is very near, and then tells nothing of the far one.
    pub(crate) fn precise_clip_matrix(&self, aspect: f64) -> DMat4 {
        let depth = self.far - self.near;
        match self.projection {
            Projection::Orthographic { .. } => self.clip_matrix(aspect),
            Projection::Perspective { .. } => self.matrix(aspect, [-1.0 / depth, self.far / depth]),
        }
    }

    /// Returns the matrix whose z is `z[0]` times the distance along the line of sight, plus `z[1]`.
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

/// Returns a vector of the same direction whose square neither overflows nor vanishes: the vector itself, if it has such a square.
fn in_range(vector: DVec3) -> DVec3 {
    let size = vector.abs().max_element();
    match (1e-100..=1e100).contains(&size) {
        true => vector,
        false => vector / size,
    }
}
