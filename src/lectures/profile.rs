//! Intensities along a scan line, and how they bend where two polygons meet.

use crate::picture::LinearPicture;
use alloc::vec::Vec;

/// Pixels between the three of each side that a slope is taken from.
const APART: usize = 2;

/// The grey levels of a row, from left to right.
pub(super) fn profile(picture: &LinearPicture, row: usize) -> Vec<f64> {
    picture
        .row(row)
        .iter()
        .map(|texel| 255.0 * f64::from(texel[0]))
        .collect()
}

/// How much more there is on the right side of an edge than on its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jump {
    /// Of the value, in grey levels.
    pub value: f64,
    /// Of the slope, in grey levels a pixel.
    pub slope: f64,
}

/// The jump of `profile` at the column `edge`, in pixels from the left side of the first one. Each side is the parabola
/// through three pixels, so that it needs five pixels without another edge.
pub(super) fn jump(profile: &[f64], edge: f64) -> Jump {
    // The first pixel whose centre is not to the left of the edge.
    let first = libm::ceil(edge - 0.5) as usize;
    let side = |pixels: [usize; 3]| at(pixels.map(|i| (i as f64 + 0.5 - edge, profile[i])));
    let (value, slope) = side([first, first + APART, first + 2 * APART]);
    let (value_left, slope_left) = side([first - 1, first - 1 - APART, first - 1 - 2 * APART]);
    Jump {
        value: value - value_left,
        slope: slope - slope_left,
    }
}

/// Value and slope at 0 of the parabola through three points (Lagrange's form).
fn at(points: [(f64, f64); 3]) -> (f64, f64) {
    let (mut value, mut slope) = (0.0, 0.0);
    for (i, (x, y)) in points.into_iter().enumerate() {
        let [(a, _), (b, _)] = [points[(i + 1) % 3], points[(i + 2) % 3]];
        let scale = y / ((x - a) * (x - b));
        value += scale * a * b;
        slope -= scale * (a + b);
    }
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jumps_of_parabolas_are_exact() {
        let edge = 10.25;
        let curve = |i: usize| {
            let x = i as f64 + 0.5 - edge;
            if x < 0.0 {
                3.0 + 2.0 * x - 0.5 * x * x
            } else {
                7.0 - 1.0 * x + 0.25 * x * x
            }
        };
        let found = jump(&(0..20).map(curve).collect::<Vec<_>>(), edge);
        assert!(
            (found.value - 4.0).abs() < 1e-12 && (found.slope + 3.0).abs() < 1e-12,
            "{found:?}"
        );
    }
}
