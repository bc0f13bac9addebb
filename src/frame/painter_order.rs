//! The painter's algorithm: polygons sorted from back to front, so that later ones hide earlier
//! ones (L5).
//!
//! Sorting takes O(n log n). The sorted frame is then drawn without looking at depth. The sort key
//! is one value per polygon: the mean depth of its corners, or the depth of the farthest one. No
//! single value can order every scene, and for some scenes no order is right at all (L5: *Can have
//! unresolvable depth order*). `conflicts` in `raster/painter_conflicts.rs` finds both.

use super::{Frame, Polygon};
use crate::scene::PainterKey;
use alloc::vec::Vec;

/// Returns the indices of the polygons of `frame` from back to front by `key`. Polygons with equal
/// keys keep their order.
pub(crate) fn back_to_front(frame: &Frame, key: PainterKey) -> Vec<u32> {
    let keys: Vec<f64> = frame
        .polygons()
        .iter()
        .map(|polygon| key_of(frame, polygon, key))
        .collect();
    let mut order: Vec<u32> = (0..keys.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| {
        keys[b as usize]
            .total_cmp(&keys[a as usize])
            .then(a.cmp(&b))
    });
    order
}

/// Returns the depth by which a polygon is sorted.
fn key_of(frame: &Frame, polygon: &Polygon, key: PainterKey) -> f64 {
    // Depths are rounded as in the engines, so polygons that differ only in the last bits of an
    // `f64` keep their order.
    let depths = frame
        .corners(polygon)
        .iter()
        .map(|&v| f64::from(frame.vertices()[v as usize].depth as f32));
    match key {
        PainterKey::Mean => depths.sum::<f64>() / f64::from(polygon.count),
        PainterKey::Farthest => depths.fold(f64::NEG_INFINITY, f64::max),
    }
}
