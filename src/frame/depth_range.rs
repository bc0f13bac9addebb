//! The depth range: the distances between which depth goes from 0 to 1.

use super::guard::{self, Checked};
use crate::scene::{Camera, Projection};

/// The distances along the line of sight at which depth is 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DepthRange {
    /// Depth is linear in the distance d: z = (d − n) / (f − n).
    Orthographic {
        /// The distance at which depth is 0.
        near: f64,
        /// The distance at which depth is 1; over `near`.
        far: f64,
    },
    /// Depth is linear in the reciprocal of the distance w: z = f/(f − n) · (1 − n/w).
    Perspective {
        /// The distance at which depth is 0; over 0.
        near: f64,
        /// The distance at which depth is 1; over `near`.
        far: f64,
    },
}

impl DepthRange {
    /// Returns the near and the far distance.
    pub fn ends(self) -> (f64, f64) {
        match self {
            DepthRange::Orthographic { near, far } | DepthRange::Perspective { near, far } => {
                (near, far)
            }
        }
    }

    /// Checks that near and far are in their ranges and in order.
    pub(super) fn check(self) -> Checked {
        let (near, far) = self.ends();
        let is_perspective = matches!(self, DepthRange::Perspective { .. });
        guard::planes([near, far], is_perspective)
    }
}

impl From<&Camera> for DepthRange {
    /// Takes the near and the far plane of `camera`.
    fn from(camera: &Camera) -> Self {
        let Camera { near, far, .. } = *camera;
        match camera.projection {
            Projection::Orthographic { .. } => DepthRange::Orthographic { near, far },
            Projection::Perspective { .. } => DepthRange::Perspective { near, far },
        }
    }
}

impl Default for DepthRange {
    /// Makes the distance the depth.
    fn default() -> Self {
        DepthRange::Orthographic {
            near: 0.0,
            far: 1.0,
        }
    }
}
