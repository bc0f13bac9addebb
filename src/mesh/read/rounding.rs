//! Notes about polygons that lose their shape when their positions are rounded.

use crate::mesh::PolygonMesh;
use crate::note::{Note, Notes};
use glam::DVec3;
use std::format;
use std::vec::Vec;

/// Rounding may move a corner by this part of its polygon's extent. A sixteenth at both ends can
/// turn the normal by over 2/16, seven degrees.
const MOVED: f64 = 1.0 / 16.0;

/// A mesh narrower than this many steps of 64-bit numbers may have lost its shape already when the
/// file was written.
const STEPS: f64 = 1024.0;

/// The reason why rounding bends a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cause {
    /// Its coordinates are below the range of 32-bit numbers.
    Small,
    /// It is far from the origin of the mesh.
    FarFromMiddle,
}

/// Returns a note for each reason why rounding bends polygons. `positions` are the file's, before
/// `mesh` rounded them.
pub(super) fn notes(mesh: &PolygonMesh, positions: &[DVec3]) -> Notes {
    let mut notes = Notes::default();
    let low = positions.iter().fold(DVec3::INFINITY, |low, p| low.min(*p));
    let high = positions
        .iter()
        .fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
    let extent = (high - low).max_element();
    let distance = low.abs().max(high.abs()).max_element();
    let step = f64::EPSILON * distance;
    if extent < STEPS * step {
        notes.push(Note::warning(
            "rounding-in-file",
            format!(
                "the mesh is {extent:.1e} wide and {distance:.1e} from 0, where 64-bit numbers are up to {step:.1e} apart: \
                 expected a file that was written with the mesh nearer to 0"
            ),
        ));
    }
    // Most files hold 32-bit numbers, so that nothing was rounded.
    let origin = mesh.origin();
    let own = mesh.positions().iter().map(|p| origin + p.as_dvec3());
    if own.eq(positions.iter().copied()) {
        return notes;
    }
    let causes: Vec<Cause> = mesh
        .polygons()
        .filter_map(|polygon| cause(mesh, positions, polygon))
        .collect();
    let mut tell = |kind: &'static str, cause: Cause, why: &str| {
        let count = causes.iter().filter(|other| **other == cause).count();
        let polygons = match count {
            0 => return,
            1 => "polygon is",
            _ => "polygons are",
        };
        notes.push(Note::warning(
            kind,
            format!("{count} {polygons} so small{why}"),
        ));
    };
    tell(
        "rounding-small",
        Cause::Small,
        " that 32-bit coordinates bend their shape: expected a larger unit of length",
    );
    tell(
        "rounding-far",
        Cause::FarFromMiddle,
        ", so far from the middle of the mesh, that 32-bit coordinates bend their shape: \
         expected a separate file for each object if objects lie far apart",
    );
    notes
}

/// Returns the reason why rounding bends a polygon; `None` if it does not.
fn cause(mesh: &PolygonMesh, positions: &[DVec3], polygon: &[u32]) -> Option<Cause> {
    let corners = || polygon.iter().map(|&c| c as usize);
    let low = corners().fold(DVec3::INFINITY, |low, c| low.min(positions[c]));
    let high = corners().fold(DVec3::NEG_INFINITY, |high, c| high.max(positions[c]));
    let extent = (high - low).max_element();
    let moved = |c: usize| mesh.origin() + mesh.positions()[c].as_dvec3() - positions[c];
    let moved = corners()
        .map(|c| moved(c).abs().max_element())
        .fold(0.0, f64::max);
    let relative = (low - mesh.origin())
        .abs()
        .max((high - mesh.origin()).abs());
    match extent > 0.0 {
        true if moved <= MOVED * extent => None,
        true if relative.max_element() < f64::from(f32::MIN_POSITIVE) => Some(Cause::Small),
        true => Some(Cause::FarFromMiddle),
        false => None,
    }
}
