//! Faults that are known and not mended yet. Each entry goes when its fault is mended.

use fastphong::frame::{Frame, Polygon};
use glam::Vec3;

/// True if the normals of a polygon's corners are so far apart that those between them may be short: they are divided by their
/// length, and their errors with them, of which the bounds know nothing.
pub fn are_normals_apart(frame: &Frame, polygon: &Polygon) -> bool {
    let corners = frame.corners(polygon).iter();
    let mut normals: Vec<Vec3> = Vec::new();
    for &corner in corners {
        match frame.clip_corner(corner) {
            None => normals.push(Vec3::from_array(frame.normal(corner))),
            // A polygon that was cut: its own corners are not looked for.
            Some(_) => return true,
        }
    }
    let mean = normals.iter().sum::<Vec3>().normalize_or_zero();
    normals.iter().any(|normal| normal.dot(mean) < 0.7)
}
