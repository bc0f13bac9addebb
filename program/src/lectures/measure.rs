//! Measurements on pictures: differences, shares, angles, and jumps along a scan line.

use super::content::written;
use alloc::{format, string::String, vec::Vec};
use fastphong::compare::metrics::Difference;
use fastphong::picture::LinearPicture;
use glam::{DVec2, DVec3};

/// The distance in pixels between the three pixels on each side of an edge that give its slope.
const APART: usize = 2;

/// Returns the largest of `values`, or 0 if none is positive. It ignores NaN.
pub(super) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, f64::max)
}

/// Returns the angle between two unit vectors, in degrees.
pub(super) fn angle(a: DVec3, b: DVec3) -> f64 {
    // The inverse cosine loses small angles: their cosines all round to 1.
    (2.0 * libm::atan2((a - b).length(), (a + b).length())).to_degrees()
}

/// Returns twice the signed area of a polygon in the plane, by the shoelace formula. It is positive
/// for corners from the x axis toward the y axis.
pub(super) fn twice_the_area(corners: &[DVec2]) -> f64 {
    let edge = |k: usize| corners[k].perp_dot(corners[(k + 1) % corners.len()]);
    (0..corners.len()).map(edge).sum()
}

/// Returns the pairs of pixels that both pictures cover.
pub(super) fn covered_by_both<'a>(
    a: &'a LinearPicture,
    b: &'a LinearPicture,
) -> impl Iterator<Item = ([f32; 4], [f32; 4])> + 'a {
    let pairs = a.pixels().iter().copied().zip(b.pixels().iter().copied());
    pairs.filter(|(a, b)| a[3] > 0.0 && b[3] > 0.0)
}

/// Returns the largest difference of two pictures in grey levels, over the pixels that both cover
/// and the three channels.
pub(super) fn levels(a: &LinearPicture, b: &LinearPicture) -> f64 {
    largest(
        covered_by_both(a, b)
            .flat_map(|(a, b)| [0, 1, 2].map(|c| 255.0 * f64::from((a[c] - b[c]).abs()))),
    )
}

/// Writes the largest and the RMS error in grey levels, as one more cell of a table's row.
pub(super) fn max_and_rms(difference: &Difference) -> String {
    let [max, rms] = [difference.max, difference.rms].map(|error| written(255.0 * error));
    format!(" | {max} / {rms}")
}

/// Counts the pixels of two pictures that differ by more than half a grey level in a channel.
pub(super) fn differing(a: &LinearPicture, b: &LinearPicture) -> usize {
    let differ = |(a, b): &(&[f32; 4], &[f32; 4])| {
        a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 0.5 / 255.0)
    };
    a.pixels().iter().zip(b.pixels()).filter(differ).count()
}

/// Returns how many per cent of `all` are `part`, or 0 if `all` is 0.
pub(super) fn percent(part: usize, all: usize) -> f64 {
    100.0 * part as f64 / all.max(1) as f64
}

/// Returns the share of the covered pixels for which `is` holds, from 0 to 1.
pub(super) fn share(picture: &LinearPicture, is: impl Fn([f32; 4]) -> bool) -> f64 {
    let covered = || picture.pixels().iter().filter(|pixel| pixel[3] > 0.0);
    covered().filter(|pixel| is(**pixel)).count() as f64 / covered().count().max(1) as f64
}

/// Returns the grey levels of a row's red channel, from left to right.
pub(super) fn profile(picture: &LinearPicture, row: usize) -> Vec<f64> {
    let pixels = picture.row(row).iter();
    pixels.map(|pixel| 255.0 * f64::from(pixel[0])).collect()
}

/// The jump of a curve at an edge: right side minus left side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jump {
    /// The jump of the value, in grey levels.
    pub value: f64,
    /// The jump of the slope, in grey levels per pixel.
    pub slope: f64,
}

/// Returns the jump of `profile` at the column `edge`, in pixels from the left side of the first
/// pixel. On each side it extends the parabola through three pixels to the edge. Therefore each
/// side needs five pixels without another edge.
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

/// Returns the value and the slope at 0 of the parabola through three points (Lagrange's form).
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
