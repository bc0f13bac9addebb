//! All warnings about a frame: what it does not show of its scene, and what may look unexpected.
//!
//! Commands that draw call [`warn_of_frame`] once they have the frame. It calls a function for each
//! kind of warning, here or in another file.

use super::Log;
use super::clamped::too_bright_text;
use super::depth_notes::{note_depth_ties, note_screen_interpolation};
use super::polygon_counts::warn_of_polygons_left_out;
use super::shown_frame::ShownFrame;
use super::unlit::unlit_texts;
use fastphong::scene::Projection;
use glam::DVec3;

/// Prints all warnings and notes about a frame.
pub fn warn_of_frame(shown: &ShownFrame, log: Log) {
    warn_of_polygons_left_out(shown.frame, log);
    if log == Log::Quiet {
        return;
    }
    let texts = too_bright_text(shown).into_iter();
    let texts = texts.chain(unlit_texts(shown)).chain(eye_beyond(shown));
    texts.for_each(|text| log.warning(&text));
    note_depth_ties(shown.frame, log);
    // A user who chose the interpolation knows what it does.
    if !shown.states("interpolation") {
        note_screen_interpolation(shown.frame, log);
    }
}

/// Returns a warning if the eye of a parallel view with a local viewer stands behind visible
/// polygons.
fn eye_beyond(shown: &ShownFrame) -> Option<String> {
    let (scene, frame) = (shown.scene, shown.frame);
    let is_parallel = matches!(scene.camera.projection, Projection::Orthographic { .. });
    if !scene.local_viewer || !is_parallel {
        return None;
    }
    let [_, _, forward] = scene.camera.axes();
    let from_eye = DVec3::from_array(frame.origin()) - scene.camera.eye;
    let is_beyond = |corner: &u32| {
        let position = DVec3::from_array(frame.position(*corner).map(f64::from));
        frame.clip_corner(*corner).is_none() && forward.dot(position + from_eye) < 0.0
    };
    let polygons = frame.polygons().iter();
    let beyond = polygons.filter(|polygon| frame.corners(polygon).iter().any(is_beyond));
    let all = frame.polygons().len();
    let which = match beyond.count() {
        0 => return None,
        n if n == all => "everything that is visible".to_owned(),
        n => super::text::part_of(n, all, "polygon"),
    };
    Some(format!(
        "the eye stands beyond {which}: a parallel view also shows what is behind its eye, but --viewer local computes highlights as \
         seen from the eye; move --eye back, or leave out --viewer local"
    ))
}
