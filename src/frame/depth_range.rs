//! The depth range: the distances between which depth goes from 0 to 1.

use super::guard::{self, Checked};
use crate::scene::{Camera, Projection, ranges};

/// The distances along the line of sight at which depth is 0 and 1: the near and the far plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DepthRange {
    /// Depth is linear in the distance d: z = (d − n) / (f − n). The depth test compares z.
    Orthographic {
        /// The distance at which depth is 0.
        near: f64,
        /// The distance at which depth is 1; over `near`.
        far: f64,
    },
    /// Depth is linear in the reciprocal of the distance w: z = f/(f − n) · (1 − n/w). The depth
    /// test compares −1/w, which has the same order.
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

    /// Returns z/w on the lecture's scale, 0 at the near plane and 1 at the far plane. `depth` is
    /// in the form of [`Vertex::depth`](super::Vertex::depth).
    ///
    /// ```text
    /// perspective:  z = f/(f − n) · (1 − n/w),  depth = −1/w
    /// ```
    /// This is L5's z ↦ (f+n)/(f−n) + (1/z) · 2fn/(f−n) with z = −w, moved from −1..1 to 0..1.
    pub fn z(self, depth: f64) -> f64 {
        match self {
            DepthRange::Orthographic { .. } => depth,
            DepthRange::Perspective { near, far } => far / (far - near) * (1.0 + near * depth),
        }
    }

    /// Returns the depths at the near and the far plane, in the form of
    /// [`Vertex::depth`](super::Vertex::depth).
    pub fn depths(self) -> [f64; 2] {
        match self {
            DepthRange::Orthographic { .. } => [0.0, 1.0],
            DepthRange::Perspective { near, far } => [-1.0 / near, -1.0 / far],
        }
    }

    /// Returns the range with a far plane at infinity moved to the largest distance.
    pub(super) fn bounded(mut self) -> Self {
        let (DepthRange::Orthographic { far, .. } | DepthRange::Perspective { far, .. }) =
            &mut self;
        *far = ranges::far(*far);
        self
    }

    /// Checks that both distances are in their ranges and in order.
    pub(super) fn check(self) -> Checked {
        let (near, far) = self.ends();
        let is_perspective = matches!(self, DepthRange::Perspective { .. });
        guard::planes([near, far], is_perspective)
    }
}

impl From<&Camera> for DepthRange {
    /// Returns the range between the near and the far plane of `camera`.
    fn from(camera: &Camera) -> Self {
        let [near, far] = camera.planes();
        match camera.projection {
            Projection::Orthographic { .. } => DepthRange::Orthographic { near, far },
            Projection::Perspective { .. } => DepthRange::Perspective { near, far },
        }
    }
}

impl Default for DepthRange {
    /// Returns the orthographic range from 0 to 1, where depth is the distance.
    fn default() -> Self {
        DepthRange::Orthographic {
            near: 0.0,
            far: 1.0,
        }
    }
}
