//! Warns of polygons that are not drawn.

use super::Cost;
use crate::frame::Frame;
use crate::note::{Note, Notes, Setting};
use crate::number::counted::{counted, part_of};
use crate::reference::is_anything_covered;
use crate::scene::Clipping;
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;

/// Returns warnings about polygons that cannot be drawn, and about a picture that shows none. With
/// [`Cost::Samples`], it also looks for polygons between the centres of pixels.
pub fn of_polygons(frame: &Frame, cost: Cost) -> Notes {
    let mut notes = Notes::default();
    let s = frame.stats();
    let of_all = |count| part_of(count, s.polygons, "polygon");
    if s.no_area > 0 {
        let are = match s.no_area {
            1 => "has no area and is",
            _ => "have no area and are",
        };
        let text = format!("{} {are} left out", of_all(s.no_area));
        notes.push(Note::warning("left-out/no-area", text));
    }
    if s.cancelling > 0 {
        let cross = match s.cancelling {
            1 => "crosses itself and its areas cancel: it has no normal and is",
            _ => "cross themselves and their areas cancel: they have no normal and are",
        };
        let text = format!("{} {cross} left out", of_all(s.cancelling));
        notes.push(Note::warning("left-out/cancelling", text));
    }
    if s.unprojected > 0 {
        notes.push(match frame.clipping() {
            Clipping::NdcCube => {
                let one = "polygon has a corner at the plane of the eye and is left out: ";
                let more = "polygons have a corner at the plane of the eye and are left out: ";
                Note::warning("left-out/unprojected", counted(s.unprojected, one, more))
                    .set(Setting::word("clipping", "planes"))
                    .say(" draws the visible part")
            }
            Clipping::Planes => {
                let one = "polygon reaches so far that its visible part cannot be cut out, and is left out";
                let more = "polygons reach so far that their visible parts cannot be cut out, and are left out";
                Note::warning("left-out/unprojected", counted(s.unprojected, one, more))
            }
        });
    }
    if let Some(note) = nothing_drawn(frame, cost) {
        notes.push(note);
    }
    notes
}

/// Returns a warning with the reasons if no polygon of `frame` is visible.
fn nothing_drawn(frame: &Frame, cost: Cost) -> Option<Note> {
    const KIND: &str = "left-out/all";
    let s = frame.stats();
    let left = frame.polygons().len();
    if left > 0 {
        let reach = counted(left, "polygon reaches", "polygons reach");
        let text = format!(
            "nothing is drawn: {reach} into the view, but none covers the centre of a pixel"
        );
        let is_empty = cost == Cost::Samples && !is_anything_covered(frame);
        return is_empty.then(|| Note::warning(KIND, text));
    }
    if s.polygons == 0 {
        return Some(Note::warning(KIND, "nothing is drawn: there is no polygon"));
    }
    // Polygons without area, or that cannot be projected, were reported already.
    let reasons = [
        (
            s.culled,
            "is seen from the culled side",
            "are seen from the culled side",
        ),
        (s.outside, "lies outside the view", "lie outside the view"),
        (
            s.edge_on,
            "is seen edge-on or is far smaller than a pixel",
            "are seen edge-on or are far smaller than a pixel",
        ),
        // A cut polygon is also counted as culled or edge-on if its pieces are, so it is reported
        // only if none was.
        (
            if s.culled + s.edge_on == 0 {
                s.clipped
            } else {
                0
            },
            "passes beside the view",
            "pass beside the view",
        ),
    ];
    let mut reasons = reasons.into_iter().filter(|(count, ..)| *count > 0);
    let (count, one, more) = reasons.next()?;
    let [one, more] =
        [one, more].map(|verb| ["polygon ", "polygons "].map(|noun| noun.to_owned() + verb));
    let mut text = String::from("nothing is drawn: ") + &counted(count, &one[0], &more[1]);
    for (count, one, more) in reasons {
        text += &format!(", {}", counted(count, one, more));
    }
    Some(match (s.culled, s.outside + s.clipped) {
        (1.., _) => Note::warning(KIND, text + "; try ").set(Setting::word("cull", "none")),
        (_, 1..) => Note::warning(KIND, text + "; ")
            .set(Setting::number("camera.fit", "0.8"))
            .say(" brings all of them into view"),
        _ => Note::warning(KIND, text),
    })
}
