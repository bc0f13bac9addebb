//! Worlds in which another axis than y points up. The default view and the default light are turned
//! with it.

use super::diagnostics::Origin;
use super::value::{Data, SceneTable};
use glam::{DMat3, DVec3};

/// Returns the rotation from a world where y points up into one where the axis that `camera` names
/// points up. Without a name it is the identity. The side of the world that faces the viewer of the
/// default view stays there, except for z and −z: it becomes −y where z points up, and y where −z
/// does.
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

/// Turns the direction in a table, unless a flag set it.
pub(super) fn turn_default(table: &mut SceneTable, turn: DMat3) {
    let Some(value) = table.entries.get_mut("direction") else {
        return;
    };
    if let (Data::Triple(direction), false) =
        (&mut value.data, matches!(value.origin, Origin::Flag(_)))
    {
        // Adding 0 turns −0 into 0.
        *direction = (turn * DVec3::from_array(*direction) + DVec3::ZERO).to_array();
    }
}
