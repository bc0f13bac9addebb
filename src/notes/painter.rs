//! Warns of polygons that the painter's algorithm draws in the wrong order.

use crate::frame::Frame;
use crate::note::{Note, Notes};
use crate::number::counted::counted;
use crate::raster::painter_conflicts::{Conflicts, conflicts};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// Warns if the painter's algorithm draws pairs of polygons in the wrong order.
pub(super) fn wrong_order(frame: &Frame, notes: &mut Notes) {
    if let Some(text) = painter_text(&conflicts(frame)) {
        notes.push(Note::warning("depth/painter", text));
    }
}

/// Returns a warning if the painter's algorithm draws pairs of polygons in the wrong order.
fn painter_text(conflicts: &Conflicts) -> Option<String> {
    // Every order draws at least one pair of a cycle wrong, so cycles without wrong pairs cannot
    // occur.
    let wrong = match conflicts.wrong.len() {
        0 => return None,
        wrong => counted(wrong, "pair is drawn", "pairs are drawn") + " in the wrong order",
    };
    if conflicts.cycles.is_empty() {
        return Some(wrong + " by the painter's key, though a right order exists");
    }
    let in_cycles = conflicts.cycles.iter().map(Vec::len).sum();
    let in_cycles = counted(in_cycles, "polygon", "polygons");
    let cycles = counted(conflicts.cycles.len(), "cycle", "cycles");
    let cutting = match conflicts.interpenetrating {
        0 => String::new(),
        n => format!(", {} each other", counted(n, "pair cuts", "pairs cut")),
    };
    let problem = format!("{in_cycles} in {cycles}: no order draws them right");
    Some(format!("{problem}; {wrong}{cutting}"))
}
