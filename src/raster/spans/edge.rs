//! The fill rule: where an edge crosses each scanline, and which pixel centres lie right of it, in
//! exact integers.

use crate::frame::{Frame, SubPixel};
use core::cmp::Ordering;

/// Sub-pixels per pixel: the unit of `SubPixel`.
const UNIT: i64 = 1 << SubPixel::FRAC_NBITS;

/// Returns the first row (or column) whose centre does not lie before `at`.
#[inline(always)]
pub(crate) fn first_centre(at: SubPixel) -> i32 {
    // ceil(at − ½) on the bits
    ((i64::from(at.to_bits()) + UNIT / 2 - 1) >> SubPixel::FRAC_NBITS) as i32
}

/// The crossing of an edge with the centre line of a scanline. It is exact, and steps from scanline
/// to scanline.
///
/// For an edge from (X0, Y0) down to (X1, Y1) in sub-pixels, and a scanline whose centre is at Yc,
/// the crossing lies at
///
/// ```text
/// X = X0 + (Yc − Y0) · dX / dY,      dX = X1 − X0,  dY = Y1 − Y0 > 0        (L21 3.4: Δx = Δt (x_2 − x_1))
/// X_next = X_current + dX / dY                                               (L21 3.2, 3.3)
/// ```
///
/// It is stored as `pixel − rest / denominator`, where `pixel` is the first pixel whose centre is
/// not left of the crossing, and 0 ≤ rest < denominator = 256 dY. All are in 64 bits: coordinates
/// within ±2²³ sub-pixels give products under 2⁵⁰. A crossing may start at any scanline, so clipped
/// edges are as exact as whole ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeCrossing {
    pixel: i32,
    step_pixels: i32,
    rest: i64,
    step_rest: i64,
    denominator: i64,
}

impl EdgeCrossing {
    /// Returns the crossing of the edge from `top` down to `bottom` (each x, y) with scanline
    /// `row`.
    #[inline(always)]
    pub fn new(top: [SubPixel; 2], bottom: [SubPixel; 2], row: i32) -> Self {
        let bits = |c: SubPixel| i64::from(c.to_bits());
        let (x0, y0) = (bits(top[0]), bits(top[1]));
        // At most 24 bits, so the step takes a division of 32 bits, which is faster.
        let [dx, dy] = [0, 1].map(|axis| (bottom[axis] - top[axis]).to_bits());
        assert!(dy > 0, "a crossing needs an edge that goes down");
        debug_assert!(
            [top, bottom]
                .as_flattened()
                .iter()
                .all(|c| c.unsigned_abs() <= Frame::GUARD.unsigned_abs()),
            "coordinates within the guard: the products fit in 64 bits"
        );
        let (step_pixels, step_rest) = (dx.div_euclid(dy), dx.rem_euclid(dy)); // 3.2, 3.4
        let [dx, dy] = [dx, dy].map(i64::from);
        let denominator = UNIT * dy;
        let centre = i64::from(row) * UNIT + UNIT / 2;
        // The crossing's distance from the centre of pixel 0, times the denominator.
        let numerator = (x0 - UNIT / 2) * dy + (centre - y0) * dx;
        // Rounds up: `div_euclid` rounds down, so the quotient is negated before and after.
        let pixel = -(-numerator).div_euclid(denominator);
        EdgeCrossing {
            pixel: pixel as i32,
            rest: pixel * denominator - numerator,
            step_pixels,                            // the whole pixels of Δx
            step_rest: UNIT * i64::from(step_rest), // and the rest
            denominator,
        }
    }

    /// Returns the first pixel whose centre is not left of the crossing.
    #[inline(always)]
    pub fn pixel(&self) -> i32 {
        self.pixel
    }

    /// Returns the distance from the crossing to the centre of [`EdgeCrossing::pixel`], in pixels,
    /// 0..1.
    ///
    /// It has 53 bits: two crossings may be so close that few bits are left of their difference.
    #[inline(always)]
    pub fn offset(&self) -> f64 {
        self.rest as f64 / self.denominator as f64
    }

    /// Returns numerator and denominator of [`EdgeCrossing::offset`]. The crossing lies at x =
    /// `pixel` + ½ − numerator/denominator.
    #[cfg(feature = "io")]
    pub fn rest(&self) -> [i64; 2] {
        [self.rest, self.denominator]
    }

    /// Returns how far the crossing moves per scanline: whole pixels, and a numerator over the
    /// denominator of [`EdgeCrossing::rest`].
    #[cfg(feature = "io")]
    pub fn step(&self) -> [i64; 2] {
        [i64::from(self.step_pixels), self.step_rest]
    }

    /// Steps to the next scanline.
    #[inline(always)]
    pub fn advance(&mut self) {
        self.pixel += self.step_pixels; // 3.3
        self.rest -= self.step_rest;
        // One correction is enough, because `step_rest` is less than a pixel.
        if self.rest < 0 {
            self.rest += self.denominator;
            self.pixel += 1;
        }
    }

    /// Compares two crossings of the same scanline, exactly. The one farther left is less.
    #[inline(always)]
    pub fn compare(&self, other: &EdgeCrossing) -> Ordering {
        debug_assert!(
            [self, other]
                .iter()
                .all(|c| (0..c.denominator).contains(&c.rest)),
            "a rest is less than a pixel"
        );
        self.pixel.cmp(&other.pixel).then_with(|| {
            // The larger rest lies farther left, so the sides are swapped. Rests are under 2³² and
            // denominators at most 2³²: the products fit.
            let left = other.rest as u64 * self.denominator as u64;
            let right = self.rest as u64 * other.denominator as u64;
            left.cmp(&right)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;

    fn at(bits: i64) -> SubPixel {
        SubPixel::from_bits(bits as i32)
    }

    #[test]
    fn first_centre_is_half_open() {
        assert_eq!(
            first_centre(at(128)),
            0,
            "a centre belongs to what begins on it"
        );
        assert_eq!(first_centre(at(129)), 1);
        assert_eq!(first_centre(at(0)), 0);
        assert_eq!(first_centre(at(-128)), -1);
        assert_eq!(first_centre(at(-127)), 0);
    }

    /// Compares stepped crossings with the definition, in exact rational numbers, over the whole
    /// range of coordinates.
    #[test]
    fn stepping_is_exact() {
        let mut random = Random::new(1);
        for round in 0..2000 {
            let reach = [1 << 9, 1 << 14, 1 << 23][round % 3];
            let mut bits = || random.below(2 * reach) as i64 - reach as i64;
            let (x0, y0, x1) = (bits(), bits(), bits());
            let y1 = y0 + 1 + bits().abs();
            if y1 > 1 << 23 {
                continue;
            }
            let (top, bottom) = ([at(x0), at(y0)], [at(x1), at(y1)]);
            let first = first_centre(top[1]);
            let mut crossing = EdgeCrossing::new(top, bottom, first);
            for row in first..first + 40 {
                let centre = i128::from(row) * 256 + 128;
                if centre >= i128::from(y1) {
                    break;
                }
                // The centre of pixel p is not left of the crossing: (256p + 128 − x0) dY ≥ (Yc −
                // y0) dX
                let not_left = |p: i32| {
                    (256 * i128::from(p) + 128 - i128::from(x0)) * i128::from(y1 - y0)
                        >= (centre - i128::from(y0)) * i128::from(x1 - x0)
                };
                assert!(not_left(crossing.pixel()) && !not_left(crossing.pixel() - 1));
                let again = EdgeCrossing::new(top, bottom, row);
                assert_eq!(
                    crossing.compare(&again),
                    Ordering::Equal,
                    "any scanline may be the first"
                );
                crossing.advance();
            }
        }
    }

    #[test]
    fn an_offset_is_the_way_from_the_crossing_to_the_next_centre() {
        // The edge goes a quarter of a pixel to the right per scanline, and crosses the first
        // centre line at x = 1/8.
        let mut crossing = EdgeCrossing::new([at(0), at(0)], [at(256), at(1024)], 0);
        for (pixel, offset) in [(0, 0.375), (0, 0.125), (1, 0.875), (1, 0.625)] {
            assert_eq!((crossing.pixel(), crossing.offset()), (pixel, offset));
            crossing.advance();
        }
    }

    #[test]
    fn order_is_exact() {
        // At this distance the two crossings differ by less than an f64 can resolve.
        let steep = EdgeCrossing::new([at(1 << 22), at(0)], [at((1 << 22) + 1), at(1 << 23)], 0);
        let upright = EdgeCrossing::new([at(1 << 22), at(0)], [at(1 << 22), at(1 << 23)], 0);
        assert_eq!(steep.compare(&upright), Ordering::Greater);
        assert_eq!(upright.compare(&steep), Ordering::Less);
    }
}
