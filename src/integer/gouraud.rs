//! Gouraud shading: two additions per pixel step a colour.

use super::pixel::{Pixel, halves};
use super::reciprocal::{Reciprocal, part};
use super::span::Span;

/// Shades `line` by Gouraud's method between two colours.
///
/// `first` is the colour of the first pixel and `end` the colour of the pixel after the last, as
/// [`colour`](super::colour) returns them. Bits outside of their fields are ignored.
///
/// Red and blue share a sum, so I_next = I + ΔI (L21 3.6) takes two additions for three channels.
/// Steps are cut toward 0, so no channel leaves the range between its ends and none carries into
/// another. A line of n pixels is off by at most n 2⁻¹⁶ of the range, which is 1 level for
/// [`Span::MAX`] pixels. A longer line is cut into pieces of [`Span::MAX`] pixels.
#[inline(always)]
pub fn gouraud<P: Pixel>(line: &mut [P], first: u32, end: u32) {
    let (from, to) = (halves(first), halves(end));
    if line.len() <= Span::MAX {
        piece(line, from, to);
    } else {
        cut(line, from, to);
    }
}

/// Shades a long line in pieces, between colours in halves.
#[cold]
#[inline(never)]
fn cut<P: Pixel>(line: &mut [P], first: (u32, u32), end: (u32, u32)) {
    let (pixels, mut from, mut done) = (line.len(), first, 0);
    for line in line.chunks_mut(Span::MAX) {
        done += line.len();
        let part = part(done, pixels);
        let between = |a: u32, b: u32| {
            let (a, b) = (i64::from(a), i64::from(b));
            (a + (((b - a) * part) >> 16)) as u32
        };
        let to = if done < pixels {
            let red = between(first.0 >> 16, end.0 >> 16);
            let blue = between(first.0 & 0xFFFF, end.0 & 0xFFFF);
            (red << 16 | blue, between(first.1, end.1))
        } else {
            end
        };
        piece(line, from, to);
        from = to;
    }
}

/// Shades a line of at most [`Span::MAX`] pixels between colours in halves.
#[inline(always)]
fn piece<P: Pixel>(line: &mut [P], from: (u32, u32), to: (u32, u32)) {
    let n = Reciprocal::of(line.len());
    let red = step(from.0 >> 16, to.0 >> 16, n);
    let blue = step(from.0 & 0xFFFF, to.0 & 0xFFFF, n);
    let green = step(from.1, to.1, n);
    run(
        line,
        from,
        ((red << 16).wrapping_add(blue) as u32, green as u32),
    );
}

/// Returns the growth per pixel from one 16-bit value to another over n pixels, cut toward 0.
///
/// The product is below 2¹⁶ · 2¹⁵.
#[inline(always)]
fn step(first: u32, end: u32, n: Reciprocal) -> i32 {
    let product = (end as i32 - first as i32) * n.mantissa;
    // The shift cuts downward. If the product is negative, its sign adds 1, which is one unit too
    // much where the quotient is whole: still toward 0.
    (product >> (14 + n.shift)) - (product >> 31)
}

/// Shades `line` from a colour and its growth per pixel, both in halves: red and blue of 16 bits
/// each in one sum, and green in the other.
#[inline(always)]
pub(super) fn run<P: Pixel>(line: &mut [P], from: (u32, u32), step: (u32, u32)) {
    let (mut red_blue, mut green) = from;
    for pixel in line {
        // A negative step of blue borrows from red's half of the step. But sums are right modulo
        // 2³² and blue itself stays within its 16 bits, so both halves of the sum are exact.
        *pixel = P::from_halves(red_blue, green);
        red_blue = red_blue.wrapping_add(step.0); // 3.6
        green = green.wrapping_add(step.1);
    }
}

#[cfg(test)]
mod tests {
    use super::super::pixel::Rgb888;
    use super::*;

    /// Steps are cut toward 0, so no channel passes its ends or carries into another.
    #[test]
    fn every_channel_stays_between_its_ends() {
        let level = |[r, g, b]: [u32; 3]| r << 12 | g << 23 | b << 1 | 1 | 2 << 21 | 1 << 11;
        for (first, end) in [
            ([255, 0, 255], [0, 255, 0]),
            ([0, 255, 0], [255, 0, 255]),
            ([0, 0, 0], [1, 2, 255]),
            ([7, 8, 255], [6, 9, 254]),
            ([200, 200, 200], [200, 200, 200]),
        ] {
            for n in (1..=256).chain([257, 320, 777, 1024, 65_535]) {
                let mut line = std::vec![Rgb888([0; 3]); n];
                gouraud(&mut line, level(first), level(end));
                assert_eq!(line[0].0.map(u32::from), first);
                for (i, pixel) in line.iter().enumerate() {
                    for c in 0..3 {
                        let (from, to) = (f64::from(first[c]), f64::from(end[c]));
                        let exact = from + (to - from) * i as f64 / n as f64;
                        let found = f64::from(pixel.0[c]);
                        assert!(found >= from.min(to) && found <= from.max(to));
                        // Rounding, and one unit of 16 bits for each pixel that is stepped at once.
                        let limit = 0.52 + n.min(256) as f64 / 256.0;
                        assert!(
                            (found - exact).abs() <= limit,
                            "{n}, {i}: {found}, not {exact}"
                        );
                    }
                }
            }
        }
    }
}
