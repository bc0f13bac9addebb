//! CS171's literal way into the picture: corners are divided by w, and nothing is clipped (CS171 3,
//! Algorithms 4, 5).

use super::view::{Codes, View, bits, reach};
use crate::frame::{DepthRange, Frame};
use glam::DVec4;

impl View<'_> {
    /// Returns the sides of the cube that a corner is beyond after the division by w, on whichever
    /// side of the eye it is. A corner whose place the frame cannot hold, because it is in the
    /// plane of the eye or near it, counts as beyond a plane.
    pub(super) fn codes_unclipped(&self, clip: DVec4) -> Codes {
        let [x, y] = [clip.x, clip.y].map(|c| c / clip.w);
        let z = DepthRange::from(&self.scene.camera).z(self.depth(clip));
        // Comparisons with NaN are false, so 0/0 has no place either.
        let has_place = x.abs() <= reach(self.width)
            && y.abs() <= reach(self.height)
            && z.abs() <= f64::from(Frame::GUARD);
        if !has_place {
            return 1 << 8;
        }
        bits(&[x < -1.0, x > 1.0, y < -1.0, y > 1.0, z < 0.0, z > 1.0])
    }
}
