//! Slivers: triangles whose values change too fast to be stepped. They are lit pixel by pixel.

use super::canvas::{Canvas, Vertex};
use super::pixel::Pixel;
use super::scan::{Point, scan};
use super::vector::{Bits, unit_bits};
use core::num::NonZeroU32;

impl<P: Pixel> Canvas<'_, P> {
    /// Draws a triangle pixel by pixel. Each pixel interpolates `values` by the weights of the
    /// corners, and `shade` returns the colour of the result in fields.
    pub(super) fn sliver(
        &mut self,
        (points, depths): ([Point; 3], [u16; 3]),
        values: [Bits; 3],
        shade: impl Fn(Bits) -> u32,
    ) {
        let weights = Weights::new(points);
        scan(points, (self.width, self.height), |y, first, end| {
            for x in first..end {
                let at = weights.at(x, y);
                let depth = weighed(depths.map(i32::from), at) as u16;
                if let Some(pixel) = self.pixel(x, y, depth) {
                    let one = |i: usize| weighed([values[0][i], values[1][i], values[2][i]], at);
                    *pixel = P::from_fields(shade([one(0), one(1), one(2)]));
                }
            }
        });
    }
}

/// The weights of a triangle's corners, exact until they are cut to Q15.
///
/// They take four 64-bit products per pixel, of 63 instructions each on a Cortex-M0. Slivers have
/// few pixels.
struct Weights {
    first: Point,
    sides: [Point; 2],
    /// Twice the area in sub-pixels squared, at least 1.
    area: i64,
    /// How many bits `area` has.
    bits: u32,
    /// 2³¹ divided by the area, which is shifted to 16 bits for this.
    inverse: u32,
}

impl Weights {
    fn new([a, b, c]: [Point; 3]) -> Self {
        let sides = [[b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]];
        let area = cross(sides[0], sides[1]).max(1);
        let bits = 64 - area.leading_zeros();
        let normal = sixteen_bits(area, bits);
        let inverse = 0x8000_0000 / NonZeroU32::new(normal).unwrap_or(NonZeroU32::MIN);
        Self {
            first: a,
            sides,
            area,
            bits,
            inverse,
        }
    }

    /// Returns the weights of corners 1 and 2 at a pixel's centre, in Q15. They are 0 or more, and
    /// together below 1, so an interpolated value stays between the corners' values.
    fn at(&self, x: i32, y: i32) -> (i32, i32) {
        let offset = [
            (x << 8) + 128 - self.first[0],
            (y << 8) + 128 - self.first[1],
        ];
        let weight = |doubled: i64| {
            // `part` is at most the area in 16 bits, of which `inverse` is the inverse: the product
            // is at most 2³¹.
            let part = sixteen_bits(doubled.clamp(0, self.area), self.bits);
            (((part * self.inverse) >> 16) as i32).min(32767)
        };
        let second = weight(cross(offset, self.sides[1]));
        let third = weight(cross(self.sides[0], offset));
        // Rounding may push the sum over 1: cut the third weight.
        (second, third.min(32767 - second))
    }
}

/// Returns twice the signed area between two sides, which are below 2²⁰.
pub(super) fn cross(a: Point, b: Point) -> i64 {
    i64::from(a[0]) * i64::from(b[1]) - i64::from(a[1]) * i64::from(b[0])
}

/// Returns the upper 16 bits of x, which has `bits` bits.
fn sixteen_bits(x: i64, bits: u32) -> u32 {
    if bits > 16 {
        (x >> (bits - 16)) as u32
    } else {
        (x as u32) << (16 - bits)
    }
}

/// Returns a + (b − a) β + (c − a) γ with β and γ in Q15. Differences are at most 2¹⁶ and β + γ is
/// below 2¹⁵, so the sum is below 2³¹.
#[inline(always)]
fn weighed([a, b, c]: [i32; 3], (second, third): (i32, i32)) -> i32 {
    a + (((b - a) * second + (c - a) * third) >> 15)
}

/// Returns the unit normals of a triangle's corners.
#[inline(always)]
pub(super) fn normals(t: &[Vertex; 3]) -> [Bits; 3] {
    [
        unit_bits(t[0].normal.bits()),
        unit_bits(t[1].normal.bits()),
        unit_bits(t[2].normal.bits()),
    ]
}
