//! The triangle that spans of benchmarks and of counts belong to.

use crate::number::{Num, Vec3};
use crate::shading::{Corner, Corners};

/// The triangle of a bench.
pub(crate) struct BenchPolygon<F> {
    pub corners: [Corner<F>; 3],
    pub normals: [Vec3<F>; 3],
    pub face: Vec3<F>,
}

impl<F: Num> BenchPolygon<F> {
    /// Returns the polygon as methods read it.
    pub fn corners(&self) -> Corners<'_, F> {
        let [a, b, c] = self.normals;
        Corners {
            all: &self.corners,
            face: self.face,
            is_whole: true,
            whole: &self.normals,
            mean: (a + b + c) * (1.0 / 3.0),
        }
    }
}
