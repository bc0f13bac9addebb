//! Notes about depth: polygons whose depths rounding cannot tell apart, and polygons that
//! interpolation on the screen distorts.

use crate::frame::{DepthRange, Frame, Polygon};
use crate::note::{Note, Notes, Setting};
use crate::number::counted::{counted, grouped};
use crate::raster::depth_ties::{DepthTies, depth_ties};
use crate::scene::{HiddenSurfaces, Interpolation};
use alloc::format;
use alloc::vec::Vec;

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

/// Returns the normal and the colour of a vertex. A vertex made by clipping has none: this returns
/// those at both ends of its edge.
fn varyings_at(frame: &Frame, vertex: u32) -> Vec<[[f32; 3]; 2]> {
    match frame.clip_corner(vertex) {
        Some(cut) => [cut.a, cut.b].map(|end| varyings_at(frame, end)).concat(),
        None => Vec::from([[frame.normal(vertex), frame.colour(vertex)]]),
    }
}

/// Notes if perspective makes much of a difference to attributes interpolated on the screen.
/// Whoever chose the interpolation knows what it does.
pub(super) fn screen_interpolation(frame: &Frame, notes: &mut Notes) {
    let is_perspective = matches!(frame.depth_range(), DepthRange::Perspective { .. });
    if !is_perspective || frame.interpolation() == Interpolation::Perspective {
        return;
    }
    let is_bent = |polygon: &&Polygon| {
        let corners = frame.corners(polygon);
        let inv_w = |v: &u32| -frame.vertices()[*v as usize].depth;
        let least = corners.iter().map(inv_w).fold(f64::INFINITY, f64::min);
        let largest = corners.iter().map(inv_w).fold(0.0, f64::max);
        let has_colours = frame.lightings()[polygon.material as usize].vertex_colours;
        let varies = || {
            let all: Vec<_> = corners
                .iter()
                .flat_map(|v| varyings_at(frame, *v))
                .collect();
            let [normal, colour] = all[0];
            all.iter()
                .any(|[n, c]| *n != normal || has_colours && *c != colour)
        };
        largest > RATIO * least && (frame.is_local() || varies())
    };
    let bent = frame.polygons().iter().filter(is_bent).count();
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
