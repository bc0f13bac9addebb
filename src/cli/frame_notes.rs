//! Warnings about a frame, all in one list: what it does not show of its scene, and what looks otherwise than one might expect.
//!
//! Commands that draw ask for them once the frame is there. Each kind of warning is a function here or in a file of its own, and
//! an entry of [`warn_of_frame`].

use super::Log;
use super::clamped::too_bright_text;
use super::depth_notes::{note_depth_ties, note_screen_interpolation};
use super::polygon_counts::warn_of_polygons_left_out;
use super::shown_frame::ShownFrame;
use super::unlit::unlit_texts;
use fastphong::scene::Projection;
use glam::DVec3;

/// Warns of all that is odd about a frame.
pub fn warn_of_frame(shown: &ShownFrame, log: Log) {
    warn_of_polygons_left_out(shown.frame, log);
    if log == Log::Quiet {
        return;
    }
    let texts = too_bright_text(shown).into_iter();
    let texts = texts.chain(unlit_texts(shown)).chain(eye_beyond(shown));
    texts.for_each(|text| log.warning(&text));
    note_depth_ties(shown.frame, log);
    // Who chose one knows.
    if !shown.states("interpolation") {
        note_screen_interpolation(shown.frame, log);
    }
}

/// Says that a local viewer of a parallel view stands on the far side of what is seen.
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
        n if n == all => "all that is seen".to_owned(),
        n => super::text::part_of(n, all, "polygon"),
    };
    Some(format!(
        "the eye stands beyond {which}: a parallel view shows what lies behind its eye too, but --viewer local lights highlights as \
         seen from there; move --eye back, or leave out --viewer local"
    ))
}
