//! CS171's literal way into the picture: corners divided by w as they are, and no clipping (CS171 3, Algorithms 4, 5).

use super::{Place, Projection};
use crate::frame::{Frame, SubPixel};
use crate::scene::Scene;
use glam::DVec4;

impl Projection<'_> {
    /// The place of a corner after the division by w, on whichever side of the eye it is. Corners without a place that
    /// the frame can hold, in the plane of the eye or near it, are beyond a plane.
    pub(super) fn place_unclipped(&self, clip: DVec4) -> Place {
        let [x, y, z] = [clip.x, clip.y, clip.z].map(|c| c / clip.w);
        // Comparisons with NaN are false: 0/0 has no place either.
        let reach = |side: u32| 1.0 + 2.0 * f64::from(Scene::MAX_SIDE) / f64::from(side);
        let has_place =
            x.abs() <= reach(self.width) && y.abs() <= reach(self.height) && z.abs() <= f64::from(Frame::GUARD);
        if !has_place {
            return Place { clip, snapped: [SubPixel::ZERO; 2], beyond_view: 0, beyond_planes: 1 };
        }
        let sides = [x < -1.0, x > 1.0, y < -1.0, y > 1.0, z < 0.0, z > 1.0];
        let beyond_view = sides.iter().rev().fold(0, |bits, &beyond| bits << 1 | u8::from(beyond));
        Place { clip, snapped: self.snap(clip), beyond_view, beyond_planes: 0 }
    }
}
