//! Counts what happens to the polygons of a scene, and warns of those that are not drawn.

use super::Log;
use super::text::{counted, grouped, part_of};
use crate::compare::table::aligned;
use fastphong::frame::Frame;
use fastphong::reference::is_anything_covered;
use fastphong::scene::Clipping;

/// Returns the counts of `--stats` as a table.
pub fn stats_text(frame: &Frame) -> String {
    let (s, drawn) = (frame.stats(), frame.polygons().len());
    let no_place = "left out: a corner cannot be projected";
    let cut = "cut by the near plane, the far plane or the guard band";
    let rows = [
        ("polygons", s.polygons, "of the scene"),
        (
            "culled",
            s.culled,
            "left out: its culled side faces the eye",
        ),
        ("no-area", s.no_area, "left out: no area in space"),
        (
            "cancelling",
            s.cancelling,
            "left out: crosses itself, and its areas cancel",
        ),
        (
            "edge-on",
            s.edge_on,
            "left out: seen edge-on, or smaller than 1/256 pixel",
        ),
        ("outside", s.outside, "left out: outside the view"),
        ("clipped", s.clipped, cut),
        ("unprojected", s.unprojected, no_place),
        ("drawn", drawn, "after clipping, each piece counted"),
    ];
    let rows = rows.map(|(name, count, about)| [name.into(), grouped(count), about.into()]);
    aligned(&rows, &[0, 2])
}

/// Warns of polygons that cannot be drawn, and of a picture that shows none.
pub fn warn_of_polygons_left_out(frame: &Frame, log: Log) {
    let s = frame.stats();
    let of_all = |count| part_of(count, s.polygons, "polygon");
    if s.no_area > 0 {
        let are = match s.no_area {
            1 => "has no area and is",
            _ => "have no area and are",
        };
        log.warning(&format!("{} {are} left out", of_all(s.no_area)));
    }
    if s.cancelling > 0 {
        let cross = match s.cancelling {
            1 => "crosses itself and its areas cancel: it has no normal and is",
            _ => "cross themselves and their areas cancel: they have no normal and are",
        };
        log.warning(&format!("{} {cross} left out", of_all(s.cancelling)));
    }
    if s.unprojected > 0 {
        let (one, more, hint) = match frame.clipping() {
            Clipping::NdcCube => (
                "polygon has a corner at the plane of the eye and is left out",
                "polygons have a corner at the plane of the eye and are left out",
                ": --clipping planes draws the visible part",
            ),
            Clipping::Planes => (
                "polygon reaches so far that its visible part cannot be cut out, and is left out",
                "polygons reach so far that their visible parts cannot be cut out, and are left out",
                "",
            ),
        };
        log.warning(&(counted(s.unprojected, one, more) + hint));
    }
    if log != Log::Quiet
        && let Some(why) = nothing_drawn(frame)
    {
        log.warning(&format!("nothing is drawn: {why}"));
    }
}

/// Returns the reasons if no polygon of `frame` is visible.
fn nothing_drawn(frame: &Frame) -> Option<String> {
    let s = frame.stats();
    let left = frame.polygons().len();
    if left > 0 {
        let reach = counted(left, "polygon reaches", "polygons reach");
        let why = format!("{reach} into the view, but none covers the centre of a pixel");
        return (!is_anything_covered(frame)).then_some(why);
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
    let mut text = counted(count, &one[0], &more[1]);
    for (count, one, more) in reasons {
        text += &format!(", {}", counted(count, one, more));
    }
    text += match (s.culled, s.outside + s.clipped) {
        (1.., _) => "; try --cull none",
        (_, 1..) => "; --fit 0.8 brings all of them into view",
        _ => "",
    };
    Some(text)
}
