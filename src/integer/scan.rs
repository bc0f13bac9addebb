//! The pixels that a triangle covers, exactly, in 32-bit integers.

use core::num::NonZeroU32;

/// A corner in sub-pixels, 256 to a pixel, within ±2¹⁸.
pub(super) type Point = [i32; 2];

/// Returns the first row (or column) whose centre is not before `at`: ceil(at − ½).
#[inline(always)]
pub(super) const fn first_centre(at: i32) -> i32 {
    (at + 127) >> 8
}

/// An edge on its way down. On each row it knows the first pixel whose centre is not left of it.
///
/// The edge starts at (X0, Y0) and goes down by (dX, dY). The centre of row y is t = 256 y + 128 −
/// Y0 below the start, so the edge crosses it at x = X0 + t dX / dY, and the pixel is ceil((x
/// − 128) / 256). With dX = `whole` dY + `rest` and 0 ≤ `rest` < dY, the pixel moves by `whole` +
/// `rest`/dY per row. The fraction is carried exactly: the pixel is floor(`pixel` + `carry` / (256
/// dY)), where `carry` is below 256 dY ≤ 2²⁷.
#[derive(Clone, Copy, Default)]
struct Edge {
    pixel: i32,
    carry: u32,
    whole: i32,
    /// `rest`, times 256.
    rest: u32,
    /// 256 dY: a carry that reaches it is one pixel.
    full: u32,
}

impl Edge {
    /// Starts an edge at the first row whose centre is not above `from`. The edge must go down by
    /// at least one sub-pixel.
    fn new(from: Point, to: Point) -> Self {
        let (dx, dy) = (to[0] - from[0], (to[1] - from[1]) as u32);
        let divisor = NonZeroU32::new(dy).unwrap_or(NonZeroU32::MIN);
        let quotient = dx.unsigned_abs() / divisor;
        let remainder = dx.unsigned_abs() - quotient * dy;
        // dX = whole dY + rest with the floor as the quotient: a negative quotient is rounded away
        // from 0.
        let (whole, rest) = match (dx < 0, remainder) {
            (false, _) => (quotient as i32, remainder),
            (true, 0) => (-(quotient as i32), 0),
            (true, _) => (-(quotient as i32) - 1, dy - remainder),
        };
        let t = (first_centre(from[1]) << 8) + 128 - from[1];
        // With X0 − 128 = 256 u + v and t whole = 256 u' + v' the pixel begins at u + u'. The rest
        // is ((v + v') dY + t rest) / (256 dY). For the ceiling add 256 dY − 1 to the numerator,
        // which stays below 2¹⁰ dY ≤ 2²⁹.
        let (start, moved) = (from[0] - 128, t * whole);
        let full = dy << 8;
        let mut carry = ((start & 255) + (moved & 255)) as u32 * dy + t as u32 * rest + full - 1;
        let mut pixel = (start >> 8) + (moved >> 8);
        // Three rounds at most, which cost less than a division.
        while carry >= full {
            carry -= full;
            pixel += 1;
        }
        Self {
            pixel,
            carry,
            whole,
            rest: rest << 8,
            full,
        }
    }

    /// Goes to the next row.
    #[inline(always)]
    fn next(&mut self) {
        self.pixel += self.whole;
        // Both are below `full`, so one subtraction is enough.
        self.carry += self.rest;
        if self.carry >= self.full {
            self.carry -= self.full;
            self.pixel += 1;
        }
    }
}

/// Calls `run(row, first, end)` for each row where a triangle has pixels within `width` and
/// `height`. Its pixels are the columns from `first` to before `end`.
///
/// Corners go clockwise, with y downward. Other triangles cover nothing, because their left edges
/// lie on the right.
#[inline(always)]
pub(super) fn scan(
    corners: [Point; 3],
    (width, height): (i32, i32),
    mut run: impl FnMut(i32, i32, i32),
) {
    // The topmost corner first. Rotating keeps the corners clockwise.
    let [mut a, mut b, mut c] = corners;
    while b[1] < a[1] || c[1] < a[1] {
        (a, b, c) = (b, c, a);
    }
    // Clockwise, the chain of edges a–b–c lies on the right and a–c–b on the left. Each chain goes
    // down along one edge or two.
    let [top, row_b, row_c] = [a, b, c].map(|corner| first_centre(corner[1]));
    let bottom = row_b.max(row_c).min(height);
    let (mut left, mut right) = (Edge::default(), Edge::default());
    let (mut left_end, mut right_end) = (top, top);
    let mut y = top;
    while y < bottom {
        if y == left_end {
            if y < row_c {
                (left, left_end) = (Edge::new(a, c), row_c);
            } else {
                (left, left_end) = (Edge::new(c, b), row_b);
            }
        }
        if y == right_end {
            if y < row_b {
                (right, right_end) = (Edge::new(a, b), row_b);
            } else {
                (right, right_end) = (Edge::new(b, c), row_c);
            }
        }
        // Until this row neither chain changes its edge.
        let end = bottom.min(left_end).min(right_end);
        while y < end {
            let (first, end) = (left.pixel.max(0), right.pixel.min(width));
            // Rows above the picture are stepped, not drawn.
            if y >= 0 && first < end {
                run(y, first, end);
            }
            left.next();
            right.next();
            y += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::Random;
    use super::*;

    /// True if a pixel is covered by the rule, computed in 64 bits: an odd count of edges lie left
    /// of its centre, or on it.
    fn covers(corners: [Point; 3], x: i64, y: i64) -> bool {
        let (x, y) = (256 * x + 128, 256 * y + 128);
        let mut crossings = 0;
        for i in 0..3 {
            let [p, q] = [corners[i], corners[(i + 1) % 3]].map(|p| p.map(i64::from));
            let [p, q] = if p[1] < q[1] { [p, q] } else { [q, p] };
            if p[1] <= y && y < q[1] {
                let left = (p[0] - x) * (q[1] - p[1]) + (y - p[1]) * (q[0] - p[0]);
                crossings += usize::from(left <= 0);
            }
        }
        crossings % 2 == 1
    }

    fn area(c: [Point; 3]) -> i64 {
        let [a, b, c] = c.map(|p| p.map(i64::from));
        (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    }

    #[test]
    fn coverage_is_exact_and_clipped() {
        let random = Random::new(11);
        let mut covered = 0;
        for round in 0..3000 {
            // Some corners lie on a coarse grid, so that corners, edges and centres coincide.
            let (span, grid) = [(9000.0, 1), (9000.0, 128), (2000.0, 64), (500.0, 1)][round % 4];
            let pick = || ((random.next() - 0.3) * span) as i32 / grid * grid;
            let corners = [(); 3].map(|()| [pick(), pick()]);
            let mut drawn = [[0u8; 20]; 24];
            scan(corners, (20, 24), |y, first, end| {
                assert!(first < end && (0..24).contains(&y));
                for x in first..end {
                    drawn[y as usize][x as usize] += 1;
                }
            });
            for (y, row) in drawn.iter().enumerate() {
                for (x, &count) in row.iter().enumerate() {
                    let is_in = area(corners) > 0 && covers(corners, x as i64, y as i64);
                    assert_eq!(count, u8::from(is_in), "{corners:?} at {x}, {y}");
                    covered += u32::from(is_in);
                }
            }
        }
        assert!(covered > 40_000, "{covered}");
    }

    #[test]
    fn the_largest_triangles_do_not_overflow() {
        let random = Random::new(12);
        for _ in 0..300 {
            let pick = || ((random.next() - 0.5) * 524_288.0) as i32;
            let far = || {
                if random.next() < 0.5 {
                    -262_144
                } else {
                    262_144
                }
            };
            let corner = || {
                if random.next() < 0.5 {
                    [far(), far()]
                } else {
                    [pick(), pick()]
                }
            };
            let corners = [corner(), corner(), corner()];
            scan(corners, (1024, 1024), |y, first, end| {
                let is_in = |x: i32| covers(corners, i64::from(x), i64::from(y));
                assert!(is_in(first) && is_in(end - 1), "{corners:?}, row {y}");
                assert!((first == 0 || !is_in(first - 1)) && (end == 1024 || !is_in(end)));
            });
        }
    }
}
