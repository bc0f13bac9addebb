//! Faults that are known and not mended yet. Each entry goes when its fault is mended.

use fastphong::frame::{Frame, FrameError, Polygon};
use fastphong::scene::Scene;
use fastphong::shading::Variant;
use glam::Vec3;

/// The bound of an exponent below 1 is not derived: t^n has no Lipschitz constant at 0.
pub fn is_exponent_bounded(exponent: f64) -> bool {
    exponent == 0.0 || exponent >= 1.0
}

/// Returns the frame of a scene; `None` if making it panics, as where one plane cuts a polygon and the next one leaves nothing.
pub fn frame(scene: &Scene) -> Option<Result<Frame, FrameError>> {
    std::panic::catch_unwind(|| scene.frame()).ok()
}

/// True if slerp Phong may index the uniforms of materials by polygons: under lights or an eye at positions.
pub fn may_panic(variant: &Variant, frame: &Frame) -> bool {
    variant.info().name.starts_with("slerp") && frame.is_local()
}

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
