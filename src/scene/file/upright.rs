//! Worlds whose up is another axis than y: default view and light are turned with it.

use super::diagnostics::Origin;
use super::value::{Data, SceneTable};
use glam::{DMat3, DVec3};

/// Returns the rotation of a world whose up is y into one whose up is the axis that `camera` names: none where it names none. The
/// side toward the viewer of the default view stays toward the viewer, or becomes −y where z is up and y where −z is.
pub(super) fn turn(camera: Option<&SceneTable>) -> DMat3 {
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let [right, up, toward] = match camera.and_then(|camera| camera.text("up")) {
        Some("x") => [-y, x, z],
        Some("-x") => [y, -x, z],
        Some("-y") => [-x, -y, z],
        Some("z") => [x, z, -y],
        Some("-z") => [x, -z, y],
        _ => [x, y, z],
    };
    DMat3::from_cols(right, up, toward)
}

/// Turns a direction that a table has, unless a flag gave it.
pub(super) fn turn_default(table: &mut SceneTable, turn: DMat3) {
    let Some(value) = table.entries.get_mut("direction") else {
        return;
    };
    if let (Data::Triple(direction), false) =
        (&mut value.data, matches!(value.origin, Origin::Flag(_)))
    {
        // Adding 0 makes 0 of −0.
        *direction = (turn * DVec3::from_array(*direction) + DVec3::ZERO).to_array();
    }
}
