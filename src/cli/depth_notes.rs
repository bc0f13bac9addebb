//! What the depth test cannot decide on a frame, and where attributes that are linear on the screen mislead.

use super::Log;
use super::text::{counted, grouped};
use fastphong::frame::{DepthRange, Frame};
use fastphong::raster::depth_ties::{DepthTies, depth_ties};
use fastphong::scene::{HiddenSurfaces, Interpolation};

/// The share of covered samples at which rounding decides from which on it is worth a word.
const SHARE: f64 = 0.001;

/// Warns of polygons whose depths rounding cannot tell apart, and notes doubled ones.
pub fn note_depth_ties(frame: &Frame, log: Log) {
    let ties = depth_ties(frame);
    if ties.samples as f64 > SHARE * ties.covered as f64 {
        log.warning(&ties_text(frame, ties));
    }
    if ties.doubled > 0 {
        let one = "polygon has the corners of an earlier one, which is seen in its place";
        let more = "polygons have the corners of earlier ones, which are seen in their place";
        log.note(&counted(ties.doubled, one, more));
    }
}

fn ties_text(frame: &Frame, ties: DepthTies) -> String {
    let polygons = counted(ties.polygons, "polygon meets", "polygons meet");
    let share = 100.0 * ties.samples as f64 / ties.covered as f64;
    let samples = grouped(ties.samples);
    let bits = match frame.hidden_surfaces() {
        HiddenSurfaces::ZBuffer(buffer) => buffer.bits.most().map(|most| most.ilog2() + 1),
        HiddenSurfaces::Painter(_) | HiddenSurfaces::DrawOrder => None,
    };
    match bits {
        Some(bits) => format!(
            "{polygons} others at equal depth in {bits} bits, at {samples} samples ({share:.2} % of those covered): the first \
             drawn is seen there; --depth-bits 32 tells more of them apart"
        ),
        None => format!(
            "{polygons} others at one depth but for rounding, at {samples} samples ({share:.2} % of those covered): which is \
             seen there differs between engines; move one of them, or leave it out"
        ),
    }
}

/// How many times as far away as its nearest corner a polygon's farthest may be until interpolation on the screen is
/// worth a word: half-way on the screen is then 1/3 of the way in space, not 1/2.
const RATIO: f64 = 2.0;

/// Returns the normal of a vertex, of one that clipping made that of an end of its edge.
fn normal_at(frame: &Frame, vertex: u32) -> [f32; 3] {
    match frame.clip_corner(vertex) {
        Some(cut) => normal_at(frame, cut.a),
        None => frame.normal(vertex),
    }
}

/// Notes that attributes are linear on the screen where perspective makes much of a difference, and its cure.
pub fn note_screen_interpolation(frame: &Frame, log: Log) {
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
        let one = "polygon reaches from near to more than twice as far away";
        let more = "polygons reach from near to more than twice as far away";
        log.note(&format!(
            "{}: what is interpolated over them is linear on the screen, as in the lecture, and bends in space; \
             --interpolation perspective is right there",
            counted(bent, one, more)
        ));
    }
}
