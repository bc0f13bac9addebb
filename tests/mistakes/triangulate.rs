//! Cuts polygons into triangles, in model space.

use crate::options::Triangles;
use glam::DVec3;

/// Returns a vector perpendicular to a polygon. Its length is twice the polygon's area (L21 1.1).
pub fn newell(points: &[DVec3]) -> DVec3 {
    let first = points[0];
    let next = points.iter().skip(1).chain(points.first());
    points.iter().zip(next).fold(DVec3::ZERO, |sum, (&p, &q)| {
        sum + (p - first).cross(q - first)
    })
}

/// Writes the triangles of a polygon to `out`: each as three indices into `points`.
///
/// A convex polygon becomes a fan about its corner `start`. From a concave one, ears are cut off
/// one after the other.
pub fn triangulate(points: &[DVec3], start: usize, how: Triangles, out: &mut Vec<[usize; 3]>) {
    let count = points.len();
    out.clear();
    match how {
        Triangles::FirstThree => out.push([0, 1, 2]),
        Triangles::Strip => out.extend((2..count).map(|i| [i - 2, i - 1, i])),
        Triangles::FanAlways => fan(count, start, out),
        Triangles::Right if count == 3 => out.push([0, 1, 2]),
        Triangles::Right => {
            let normal = newell(points);
            if (0..count)
                .all(|i| turn(points, normal, [i, (i + 1) % count, (i + 2) % count]) >= 0.0)
            {
                fan(count, start, out);
            } else {
                cut_ears(points, normal, start, out);
            }
        }
    }
}

fn fan(count: usize, start: usize, out: &mut Vec<[usize; 3]>) {
    let corner = |i: usize| (start + i) % count;
    out.extend((2..count).map(|i| [corner(0), corner(i - 1), corner(i)]));
}

/// Returns a value over 0 if the path over three corners turns left, seen from outside.
fn turn(points: &[DVec3], normal: DVec3, [a, b, c]: [usize; 3]) -> f64 {
    let product = (points[b] - points[a])
        .cross(points[c] - points[b])
        .dot(normal);
    // For corners on one line only rounding is left.
    let scale = (points[b] - points[a]).length_squared() + (points[c] - points[b]).length_squared();
    if product.abs() <= 1e-12 * scale * normal.length() {
        0.0
    } else {
        product
    }
}

fn cut_ears(points: &[DVec3], normal: DVec3, start: usize, out: &mut Vec<[usize; 3]>) {
    let count = points.len();
    let mut left: Vec<usize> = (0..count).map(|i| (start + i) % count).collect();
    while left.len() > 3 {
        let size = left.len();
        let around = |i: usize| [left[(i + size - 1) % size], left[i], left[(i + 1) % size]];
        let is_ear = |&i: &usize| {
            let [a, b, c] = around(i);
            let is_inside = |&p: &usize| {
                p != a
                    && p != b
                    && p != c
                    && [[a, b, p], [b, c, p], [c, a, p]]
                        .iter()
                        .all(|&t| turn(points, normal, t) >= 0.0)
            };
            turn(points, normal, [a, b, c]) > 0.0 && !left.iter().any(is_inside)
        };
        // Every simple polygon has an ear. If a polygon crosses itself, any corner is cut off.
        let ear = (0..size).find(is_ear).unwrap_or(0);
        out.push(around(ear));
        left.remove(ear);
    }
    out.push([left[0], left[1], left[2]]);
}
