//! Winding: which way polygons run on the picture, 64 of them at a time.
//!
//! There are two loops. The first reads all positions, so that reads need not wait for one another.
//! The second computes all areas, several at once. Areas are exact: coordinates are within ±2²³,
//! their differences within ±2²⁴, and areas of triangles and quadrangles within ±2⁴⁹.

use crate::frame::{ScreenVertex, SubPixel};

/// How many polygons a batch has: one per bit.
const MOST: usize = 64;

/// The positions of up to four corners of each polygon: see [`ScreenVertex::packed`].
pub(super) type Places = [[u64; MOST]; 4];

/// Empty memory for positions.
pub(super) const NO_PLACES: Places = [[0; MOST]; 4];

/// Returns a bit for each triangle, of up to 64, that runs clockwise on the picture, and a bit for
/// each that runs counter-clockwise. The first triangle's bit is the lowest. Bits past the last
/// triangle mean nothing.
#[inline(always)]
pub(super) fn of_triangles(
    triangles: &[[u32; 3]],
    vertices: &[ScreenVertex],
    places: &mut Places,
) -> (u64, u64) {
    #[allow(clippy::needless_range_loop)] // bounded once for all four arrays
    for k in 0..triangles.len().min(MOST) {
        let triangle = triangles[k];
        places[0][k] = vertices[triangle[0] as usize].packed();
        places[1][k] = vertices[triangle[1] as usize].packed();
        places[2][k] = vertices[triangle[2] as usize].packed();
    }
    let [a, b, c, _] = &*places;
    signs([a, b], [a, c])
}

/// Returns these bits for `count` polygons of any shape. `polygon` returns a corner list by index.
#[inline(always)]
pub(super) fn of_polygons<'a>(
    count: usize,
    polygon: impl Fn(usize) -> &'a [u32],
    vertices: &[ScreenVertex],
    places: &mut Places,
) -> (u64, u64) {
    #[allow(clippy::needless_range_loop)] // four arrays and a function
    for k in 0..count.min(MOST) {
        let corners = polygon(k);
        let ((a, b), (c, d)) = match *corners {
            // A triangle is a quadrangle whose last corner comes twice.
            [a, b, c] => ((a, b), (c, c)),
            [a, b, c, d] => ((a, b), (c, d)),
            _ => {
                // Any other polygon is replaced by a quadrangle whose area is 1, 0 or −1.
                let sign = area(corners, vertices).signum() as i32;
                (places[0][k], places[1][k], places[2][k], places[3][k]) =
                    (0, 0, 1, u64::from(sign as u32) << 32);
                continue;
            }
        };
        places[0][k] = vertices[a as usize].packed();
        places[1][k] = vertices[b as usize].packed();
        places[2][k] = vertices[c as usize].packed();
        places[3][k] = vertices[d as usize].packed();
    }
    let [a, b, c, d] = &*places;
    // Twice the area is the cross product of the diagonals.
    signs([a, c], [b, d])
}

/// Returns twice the area of a polygon of any shape.
#[inline(never)]
fn area(corners: &[u32], vertices: &[ScreenVertex]) -> i128 {
    doubled_area(
        corners
            .iter()
            .map(|&v| [vertices[v as usize].x, vertices[v as usize].y]),
    )
}

/// Returns twice the signed area on the picture in sub-pixels². y points downward, so
/// counter-clockwise polygons have a negative area. A product is at most 2⁴⁷, and the sum over 2²⁷
/// corners needs more than 64 bits.
pub(super) fn doubled_area(corners: impl Iterator<Item = [SubPixel; 2]> + Clone) -> i128 {
    let following = corners.clone().skip(1).chain(corners.clone().take(1));
    let bits = |c: SubPixel| i64::from(c.to_bits());
    corners
        .zip(following)
        .map(|([x0, y0], [x1, y1])| i128::from(bits(x0) * bits(y1) - bits(x1) * bits(y0)))
        .sum()
}

/// Returns a bit for each cross product of two vectors that is over 0, and a bit for each that is
/// below 0.
#[inline(always)]
fn signs(u: [&[u64; MOST]; 2], v: [&[u64; MOST]; 2]) -> (u64, u64) {
    let (mut above, mut below) = (0, 0);
    for k in 0..MOST {
        let [u_x, u_y] = difference(u[0][k], u[1][k]);
        let [v_x, v_y] = difference(v[0][k], v[1][k]);
        let product = u_x * v_y - v_x * u_y;
        // Shifts and not comparisons, because the loop runs on vectors of 64-bit integers. 2⁴⁹ is
        // far from the sign bit, so negation cannot overflow.
        above |= ((-product) as u64 >> 63) << k;
        below |= (product as u64 >> 63) << k;
    }
    (above, below)
}

/// Returns the vector from one position to another: to the right and downward.
#[inline(always)]
fn difference(from: u64, to: u64) -> [i64; 2] {
    // The differences are taken in the lower halves of 64-bit integers, which vector instructions
    // multiply without unpacking.
    let (x, y) = (to.wrapping_sub(from), (to >> 32).wrapping_sub(from >> 32));
    [i64::from(x as i32), i64::from(y as i32)]
}

/// Packs 64 flags, 0 or 1, into bits, the first one lowest.
#[inline(always)]
pub(super) fn bits(flags: &[u8; MOST]) -> u64 {
    let mut all = 0;
    for (k, group) in flags.as_chunks::<8>().0.iter().enumerate() {
        // The factor has the summands 2^(56 − 7 i). Summand i carries flag i from bit 8 i to bit
        // 56 + i, and no two products meet in a bit.
        let group = u64::from_le_bytes(*group).wrapping_mul(0x0102_0408_1020_4080) >> 56;
        all |= group << (8 * k);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Frame;
    use crate::number::test_random::Random;
    use crate::number::vectorized;
    use std::vec::Vec;

    /// Computes the result by its definition, in as many bits as it takes.
    fn plainly(polygons: &[Vec<u32>], vertices: &[ScreenVertex]) -> (u64, u64) {
        let all = |of: fn(i128) -> bool| {
            polygons.iter().rev().fold(0, |bits, corners| {
                bits << 1 | u64::from(of(area(corners, vertices)))
            })
        };
        (all(|area| area > 0), all(|area| area < 0))
    }

    /// Returns vertices close together, so that many polygons have no area; or in the whole guard
    /// band; or only at its corners.
    fn vertices(random: &mut Random, round: usize) -> Vec<ScreenVertex> {
        let guard = 256 * Frame::GUARD;
        let (origin, unit, reach) = [
            (100, 1, 3),
            (-200, 1, 400),
            (-guard, 1, 2 * guard as u64 + 1),
            (-guard, 2 * guard, 2),
        ][round % 4];
        let mut at = || SubPixel::from_bits(origin + unit * random.below(reach) as i32);
        (0..40)
            .map(|_| ScreenVertex {
                x: at(),
                y: at(),
                depth: 0.5,
                inv_w: 1.0,
            })
            .collect()
    }

    #[test]
    fn the_sign_of_every_area_is_exact() {
        let mut random = Random::new(5);
        let (mut none, mut some) = (0, 0);
        for round in 0..1200 {
            let vertices = vertices(&mut random, round);
            let count = 1 + random.below(64) as usize;
            let most = if round % 3 == 0 { 1 } else { 4 };
            let mut corners = |_| {
                (0..3 + random.below(most))
                    .map(|_| random.below(40) as u32)
                    .collect()
            };
            let polygons: Vec<Vec<u32>> = (0..count).map(&mut corners).collect();
            // Old contents must not matter.
            let mut places = [[u64::MAX / 3; MOST]; 4];
            let polygon = |k: usize| &polygons[k][..];
            let of_all = [
                of_polygons(count, polygon, &vertices, &mut places),
                vectorized(
                    #[inline(always)]
                    || of_polygons(count, polygon, &vertices, &mut places),
                ),
            ];
            let triangles: Option<Vec<[u32; 3]>> =
                polygons.iter().map(|p| p[..].try_into().ok()).collect();
            let of_triangles = triangles.map(|triangles| {
                [
                    of_triangles(&triangles, &vertices, &mut places),
                    vectorized(
                        #[inline(always)]
                        || of_triangles(&triangles, &vertices, &mut places),
                    ),
                ]
            });
            let expected = plainly(&polygons, &vertices);
            let all = u64::MAX >> (64 - count);
            for found in of_all.into_iter().chain(of_triangles.into_iter().flatten()) {
                assert_eq!((found.0 & all, found.1 & all), expected, "round {round}");
            }
            assert!(round % 3 != 0 || of_triangles.is_some());
            some += (expected.0 | expected.1).count_ones();
            none += (all & !(expected.0 | expected.1)).count_ones();
        }
        assert!(
            none > 1000 && some > 1000,
            "the test asks little: {none} without, {some} with an area"
        );
    }

    #[test]
    fn flags_become_bits_in_their_order() {
        let mut random = Random::new(6);
        for _ in 0..200 {
            let expected = random.below(1 << 32) << 32 | random.below(1 << 32);
            let flags = core::array::from_fn(|k| (expected >> k & 1) as u8);
            assert_eq!(bits(&flags), expected);
        }
    }
}
