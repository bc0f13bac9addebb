//! The painter's algorithm: polygons sorted from back to front, so that later ones hide earlier ones (L5).
//!
//! Sorting takes O(n log n), and the sorted frame is then drawn without looking at depth. The key is one number per polygon:
//! the depth of its corners, their mean or that of the farthest one. One number cannot order all scenes, and for some
//! no order is right at all (L5: *Can have unresolvable depth order*):
//! [`conflicts`](crate::raster::painter_conflicts::conflicts) finds both.

use super::{Frame, Polygon};
use crate::scene::PainterKey;
use alloc::vec::Vec;

/// Returns the numbers of the polygons of `frame` from back to front by `key`; polygons of equal keys keep their order.
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
    // As engines round them: what lies equally far away but for the last bits of an `f64` keeps its order.
    let depths = frame
        .corners(polygon)
        .iter()
        .map(|&v| f64::from(frame.vertices()[v as usize].depth as f32));
    match key {
        PainterKey::Mean => depths.sum::<f64>() / f64::from(polygon.count),
        PainterKey::Farthest => depths.fold(f64::NEG_INFINITY, f64::max),
    }
}
