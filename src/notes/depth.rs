//! Notes about depth: polygons whose depths rounding cannot tell apart, and polygons that
//! interpolation on the screen distorts.

use crate::frame::{DepthRange, Frame};
use crate::note::{Note, Notes, Setting};
use crate::number::counted::{counted, grouped};
use crate::raster::depth_ties::{DepthTies, depth_ties};
use crate::scene::{HiddenSurfaces, Interpolation};
use alloc::format;

/// The share of covered samples decided by rounding from which on the user is warned.
const SHARE: f64 = 0.001;

/// Warns of polygons whose depths rounding cannot tell apart, and notes polygons that are drawn
/// twice.
pub(super) fn ties(frame: &Frame, notes: &mut Notes) {
    let ties = depth_ties(frame);
    if ties.samples as f64 > SHARE * ties.covered as f64 {
        notes.push(ties_note(frame, ties));
    }
    if ties.doubled > 0 {
        let one = "polygon has the corners of an earlier one, which hides it";
        let more = "polygons have the corners of earlier ones, which hide them";
        notes.push(Note::remark(
            "depth/doubled",
            counted(ties.doubled, one, more),
        ));
    }
}

fn ties_note(frame: &Frame, ties: DepthTies) -> Note {
    let polygons = counted(ties.polygons, "polygon meets", "polygons meet");
    let share = 100.0 * ties.samples as f64 / ties.covered as f64;
    let samples = grouped(ties.samples);
    let bits = match frame.hidden_surfaces() {
        HiddenSurfaces::ZBuffer(buffer) => buffer.bits.most().map(|most| most.ilog2() + 1),
        HiddenSurfaces::Painter(_) | HiddenSurfaces::DrawOrder => None,
    };
    let at = format!("{samples} samples ({share:.2} % of those covered)");
    match bits {
        Some(bits) => Note::warning(
            "depth/ties",
            format!(
                "{polygons} others at equal depth in {bits} bits, at {at}: the one drawn first is \
                 visible there; "
            ),
        )
        .set(Setting::number("depth_bits", "32"))
        .say(" tells more of them apart"),
        None => Note::warning(
            "depth/ties",
            format!(
                "{polygons} others at the same depth up to rounding, at {at}: which one is visible \
                 there differs between engines; move one of them, or leave it out"
            ),
        ),
    }
}

/// The ratio of a polygon's farthest to its nearest depth from which on the user is told of
/// interpolation on the screen. At 2, half-way on the screen is 1/3 of the way in space.
const RATIO: f64 = 2.0;

/// Returns the normal of a vertex. A vertex made by clipping has none: this returns the normal at
/// one end of its edge.
fn normal_at(frame: &Frame, vertex: u32) -> [f32; 3] {
    match frame.clip_corner(vertex) {
        Some(cut) => normal_at(frame, cut.a),
        None => frame.normal(vertex),
    }
}

/// Notes if perspective makes much of a difference to attributes interpolated on the screen.
/// Whoever chose the interpolation knows what it does.
pub(super) fn screen_interpolation(frame: &Frame, notes: &mut Notes) {
    let is_perspective = matches!(frame.depth_range(), DepthRange::Perspective { .. });
    if !is_perspective || frame.interpolation() == Interpolation::Perspective {
        return;
    }
    let is_bent = |corners: &[u32]| {
        let inv_w = |v: &u32| -frame.vertices()[*v as usize].depth;
        let least = corners.iter().map(inv_w).fold(f64::INFINITY, f64::min);
        let largest = corners.iter().map(inv_w).fold(0.0, f64::max);
        let normal = normal_at(frame, corners[0]);
        let varies = || corners.iter().any(|&v| normal_at(frame, v) != normal);
        largest > RATIO * least && (frame.is_local() || varies())
    };
    let polygons = frame.polygons().iter();
    let bent = polygons
        .filter(|polygon| is_bent(frame.corners(polygon)))
        .count();
    if bent > 0 {
        let one = "polygon is more than twice as far away at one corner as at another";
        let more = "polygons are more than twice as far away at one corner as at another";
        let polygons = counted(bent, one, more);
        let text = format!(
            "{polygons}: values interpolated over them are linear on the screen, as in the lecture, and so not in space; "
        );
        let note = Note::remark("interpolation", text)
            .set(Setting::word("interpolation", "perspective"))
            .say(" makes them right");
        notes.push(note.unless("interpolation"));
    }
}
