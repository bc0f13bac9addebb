//! Plane equations over a triangle: how values at its corners grow from pixel to pixel.

use super::scan::{Point, first_centre};
use core::num::NonZeroU32;

/// The steepest growth of a value per pixel, ⅛ in Q30. Steeper triangles are drawn as slivers.
pub(super) const STEEP: i32 = 1 << 27;

/// A value over a triangle: f(x, y) = f_0 + x ∂f/∂x + y ∂f/∂y at pixel centres. Columns and rows
/// are counted from the pixel `origin` of the triangle's [`Gradients`].
///
/// Values are in Q30. Sums may wrap, but are right modulo 2³², and within the triangle a value lies
/// between those of its corners.
#[derive(Clone, Copy, Default)]
pub(super) struct Plane {
    /// The value at the origin.
    value: i32,
    /// The growth per column.
    pub(super) step: i32,
    /// The growth per row.
    row: i32,
}

impl Plane {
    /// Returns the value at the centre of a pixel, whose column and row are counted from the
    /// origin.
    #[inline(always)]
    pub(super) fn at(&self, [x, y]: Point) -> i32 {
        let along = self.step.wrapping_mul(x);
        let down = self.row.wrapping_mul(y);
        self.value.wrapping_add(along).wrapping_add(down)
    }
}

/// The set-up that all planes over a triangle share: its sides and the inverse of its area.
#[derive(Clone, Copy)]
pub(super) struct Gradients {
    /// Corners 1 and 2 from corner 0, in units of 2^−(8 − `coarse`) pixels. Each coordinate is
    /// below 2¹³.
    sides: [Point; 2],
    /// How many low bits the sides lost.
    coarse: u32,
    /// How many bits twice the area has, in those units squared.
    bits: u32,
    /// 2³¹ divided by twice the area, which is shifted to 16 bits for this.
    inverse: u32,
    /// Corner 0, in sub-pixels.
    first: Point,
    /// The first pixel whose centre is not left of corner 0 nor above it.
    origin: Point,
}

impl Gradients {
    /// Sets up a triangle, or returns `None` if it is seen from behind.
    pub(super) fn new([a, b, c]: [Point; 3]) -> Option<Self> {
        let sides = [[b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]];
        let spread = sides.map(|s| s[0].unsigned_abs() | s[1].unsigned_abs());
        // Sides of 32 pixels and more lose their low bits, an error of 2⁻¹³ of the side, so that
        // products of two sides fit 32 bits.
        let coarse = (32 - (spread[0] | spread[1]).leading_zeros()).saturating_sub(13);
        let half = (1 << coarse) >> 1;
        let sides = sides.map(|s| s.map(|x| ((x + half) >> coarse).min(8191)));
        let area = sides[0][0] * sides[1][1] - sides[1][0] * sides[0][1];
        // If bits were lost, the sign of a small area is uncertain: keep the triangle, and the
        // scan, which is exact, decides.
        if area <= -16384 || area <= 0 && coarse == 0 {
            return None;
        }
        let area = area.max(1);
        let bits = 32 - (area as u32).leading_zeros();
        let normal = (area as u32) << (32 - bits) >> 16;
        let inverse = 0x8000_0000 / NonZeroU32::new(normal).unwrap_or(NonZeroU32::MIN);
        let origin = [first_centre(a[0]), first_centre(a[1])];
        Some(Self {
            sides,
            coarse,
            bits,
            inverse,
            first: a,
            origin,
        })
    }

    /// Returns the plane of Q15 values from −1 to 1, or `None` if it is too steep.
    #[inline(always)]
    pub(super) fn plane(&self, values: [i32; 3]) -> Option<Plane> {
        let [first, ..] = values;
        let (step, row) = self.growth(values)?;
        Some(self.at_origin(first << 15, step, row))
    }

    /// Returns the plane of 16-bit values, divided by 2¹⁶, or `None` if it is too steep.
    #[inline(always)]
    pub(super) fn plane16(&self, values: [u16; 3]) -> Option<Plane> {
        let [first, ..] = values;
        let (step, row) = self.growth(values.map(i32::from))?;
        Some(self.at_origin(i32::from(first) << 14, step >> 1, row >> 1))
    }

    /// Moves a plane from corner 0 to the centre of the origin's pixel.
    #[inline(always)]
    fn at_origin(&self, value: i32, step: i32, row: i32) -> Plane {
        let [x, y] = self.offset(self.origin[0], self.origin[1]);
        // Steps are below 2²⁷ and offsets at most 256 sub-pixels: without 5 low bits the product is
        // below 2³⁰.
        let part = |step: i32, by: i32| ((step >> 5) * by) >> 3;
        let value = value.wrapping_add(part(step, x)).wrapping_add(part(row, y));
        Plane { value, step, row }
    }

    /// Returns the distance of a pixel's centre from corner 0 in sub-pixels.
    #[inline(always)]
    fn offset(&self, x: i32, y: i32) -> Point {
        [
            (x << 8) + 128 - self.first[0],
            (y << 8) + 128 - self.first[1],
        ]
    }

    /// Returns the growth of Q15 values per column and per row, in Q30, or `None` if either is too
    /// steep. Differences are at most 2¹⁶, so products are at most 2²⁹.
    ///
    /// A side that lost bits is off by up to 2^(`coarse` − 9) pixels, and a value by its growth
    /// over that distance. So the more bits are lost, the less growth is allowed: values stay right
    /// to 2⁻¹⁰.
    #[inline(always)]
    fn growth(&self, [a, b, c]: [i32; 3]) -> Option<(i32, i32)> {
        let (b, c) = (b - a, c - a);
        let [[x1, y1], [x2, y2]] = self.sides;
        let step = self.over_area(b * y2 - c * y1, STEEP >> self.coarse)?;
        let row = self.over_area(c * x1 - b * x2, STEEP >> self.coarse)?;
        Some((step, row))
    }

    /// Returns x/area per pixel in Q30, from a Q15 x in the sides' units, at most 2³⁰. Returns
    /// `None` if the quotient reaches `limit`, or if the triangle is too thin to tell.
    ///
    /// 1/area is `inverse` 2^−(15 + bits). Its product with x is computed in two halves of 32 bits,
    /// because a 64-bit product takes 63 instructions on a Cortex-M0.
    #[inline(always)]
    fn over_area(&self, x: i32, limit: i32) -> Option<i32> {
        // The upper half keeps the sign of x, the lower half is unsigned.
        let high = (x >> 16) * self.inverse as i32;
        let low = ((x as u32 & 0xFFFF) * self.inverse) >> 16;
        let product = high + low as i32;
        let shift = (self.bits + self.coarse) as i32 - 24;
        if shift >= 0 {
            let quotient = product >> shift;
            (quotient.unsigned_abs() < limit as u32).then_some(quotient)
        } else {
            let up = shift.unsigned_abs();
            // The shift multiplies the bit that the product cut by 2^`up`. Over a side of 2^(5 +
            // `coarse`) pixels that may grow to 2⁻¹⁵, and no further.
            if up + self.coarse > 10 {
                return None;
            }
            (product.unsigned_abs() < limit as u32 >> up).then_some(product << up)
        }
    }

    /// Returns the growth of the weights of corners 1 and 2 per column and row, in Q30. Returns
    /// `None` if one is ¼ or more; the limit is lower if the sides lost bits.
    pub(super) fn weights(&self) -> Option<[[i32; 2]; 2]> {
        let [[x1, y1], [x2, y2]] = self.sides;
        let one = |x: i32| self.over_area(x << 15, (1 << 28) >> self.coarse);
        Some([[one(y2)?, one(-x2)?], [one(-y1)?, one(x1)?]])
    }

    /// Returns a pixel as columns and rows from the origin.
    #[inline(always)]
    pub(super) fn place(&self, x: i32, y: i32) -> Point {
        [x - self.origin[0], y - self.origin[1]]
    }

    /// Returns the distance of the origin's centre from corner 0 in sub-pixels.
    #[inline(always)]
    pub(super) fn origin_offset(&self) -> Point {
        self.offset(self.origin[0], self.origin[1])
    }
}

#[cfg(test)]
mod tests {
    use super::super::scan::scan;
    use super::super::tests::Random;
    use super::*;

    /// The products of thin triangles have few bits. Hairs that cover a pixel's centre have planes
    /// that are right there, or none.
    #[test]
    fn planes_over_hairs_are_right_or_none() {
        let random = Random::new(51);
        let mut found = 0;
        for round in 0..400_000 {
            let reach = [2000.0, 8000.0, 60_000.0][round % 3];
            let side = [0; 2].map(|_| ((random.next() - 0.5) * reach) as i32);
            let along = 1.4 * random.next() - 0.2;
            let aside = || (random.next() * 5.0) as i32 - 2;
            let third = side.map(|x| (f64::from(x) * along) as i32 + aside());
            // A corner, or a point of the long side, lies at a pixel's centre.
            let part = [0.0, 1.0, random.next()][round % 2 + usize::from(round % 5 == 0)];
            let centre = side.map(|x| 128 - (f64::from(x) * part) as i32 + 256 * 300);
            let corner = |p: Point| [centre[0] + p[0], centre[1] + p[1]];
            let mut corners = [corner([0; 2]), corner(side), corner(third)];
            let most = 2f64.powf(16.0 * random.next());
            let mut values = [(); 3].map(|()| ((random.next() - 0.5) * most) as i32);
            let area = |[a, b, c]: [Point; 3]| {
                let [x, y] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1]].map(f64::from));
                x[0] * y[1] - x[1] * y[0]
            };
            if area(corners) < 0.0 {
                corners.swap(1, 2);
                values.swap(1, 2);
            }
            let Some(g) = Gradients::new(corners) else {
                continue;
            };
            let Some(plane) = g.plane(values) else {
                continue;
            };
            scan(corners, (600, 600), |y, first, end| {
                for x in first..end {
                    let at = [x, y].map(|x| 256 * x + 128);
                    let [a, b, c] = corners;
                    let weights = [[at, b, c], [a, at, c], [a, b, at]].map(area);
                    let sum: f64 = (0..3).map(|i| weights[i] * f64::from(values[i])).sum();
                    let exact = sum / area(corners);
                    let error = f64::from(plane.at(g.place(x, y))) / 32768.0 - exact;
                    // Moved corners add up to 16 units, 1/area and the cut of a product 3.
                    assert!(error.abs() < 20.0, "{corners:?} {values:?}: {error}");
                    found += 1;
                }
            });
        }
        assert!(found > 1000, "{found}");
    }
}
