//! The table of `--stats`: what happens to the polygons of a scene.

use super::text::grouped;
use crate::compare::table::aligned;
use fastphong::frame::Frame;

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
