//! Coverage in exact integers: which pixels a polygon covers, and their coordinates in it.
//!
//! All coordinates here are whole multiples of 1/256 pixel. They are at most 2²³ from 0
//! ([`Frame::GUARD`] pixels), so that a product of two differences stays below 2⁴⁹, which `i64` and
//! `f64` hold exactly. Only the comparison of two fractions needs `i128`.

use crate::frame::{Frame, SubPixel};
use alloc::vec::Vec;
use core::cmp::Ordering;
use core::ops::{Add, Mul, Range};

/// The size of a pixel in sub-pixels.
const PIXEL: i64 = 1 << SubPixel::FRAC_NBITS;

/// Returns the centre of the pixel with index `i` in its row or column, in sub-pixels.
pub(crate) fn centre(i: usize) -> i64 {
    i as i64 * PIXEL + PIXEL / 2
}

/// Returns the column and row of a vertex, in sub-pixels.
fn position(frame: &Frame, vertex: u32) -> (i64, i64) {
    let v = &frame.vertices()[vertex as usize];
    (i64::from(v.x.to_bits()), i64::from(v.y.to_bits()))
}

/// Returns the columns and rows of the picture in the smallest box around `corners`.
pub(crate) fn bounding_box(frame: &Frame, corners: &[u32]) -> (Range<usize>, Range<usize>) {
    let pixels = |coordinates: &dyn Fn(u32) -> i64, side: usize| {
        let lowest = corners.iter().map(|&v| coordinates(v)).min().unwrap_or(0);
        let highest = corners.iter().map(|&v| coordinates(v)).max().unwrap_or(0);
        let clipped = |pixel: i64| pixel.clamp(0, side as i64) as usize;
        clipped(lowest.div_euclid(PIXEL))..clipped(highest.div_euclid(PIXEL) + 1)
    };
    (
        pixels(&|v| position(frame, v).0, frame.width()),
        pixels(&|v| position(frame, v).1, frame.height()),
    )
}

/// True if any polygon of `frame` covers the centre of a sample.
pub fn is_anything_covered(frame: &Frame) -> bool {
    let mut line = Scanline::new(frame);
    frame.polygons().iter().any(|polygon| {
        let corners = frame.corners(polygon);
        let (columns, mut rows) = bounding_box(frame, corners);
        rows.any(|y| {
            line.cut(corners, y);
            line.covers_any(&columns)
        })
    })
}

/// The crossing of a scanline and an edge of a polygon, at the exact column `x_height / height`.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// The vertex at the upper end of the edge.
    pub top: u32,
    /// The vertex at the lower end.
    pub bottom: u32,
    /// The distance from the upper end down to the scanline.
    fall: i64,
    /// The distance from the upper end down to the lower one, above 0.
    height: i64,
    /// The column of the crossing, multiplied by `height`.
    x_height: i64,
}

impl Crossing {
    /// Intersects the edge between two vertices, in any order, with the scanline `yc`. An edge
    /// contains its upper end and not its lower one. So a corner between two edges is crossed once,
    /// and a horizontal edge never.
    fn of_edge(frame: &Frame, from: u32, to: u32, yc: i64) -> Option<Crossing> {
        let (top, bottom) = if position(frame, from).1 <= position(frame, to).1 {
            (from, to)
        } else {
            (to, from)
        };
        let ((x_top, y_top), (x_bottom, y_bottom)) =
            (position(frame, top), position(frame, bottom));
        if !(y_top <= yc && yc < y_bottom) {
            return None;
        }
        let (fall, height) = (yc - y_top, y_bottom - y_top);
        Some(Crossing {
            top,
            bottom,
            fall,
            height,
            x_height: x_top * height + fall * (x_bottom - x_top),
        })
    }

    /// True if the crossing lies at the column `xc` or left of it.
    fn is_not_right_of(&self, xc: i64) -> bool {
        self.x_height <= xc * self.height
    }

    /// Orders crossings from left to right. Crossings at one point are ordered by the upper ends of
    /// their edges, then by the lower ones.
    fn compare(&self, other: &Crossing, frame: &Frame) -> Ordering {
        // The fractions are compared by cross multiplication: exact, where a division would round.
        let cross = |a: i64, b: i64| i128::from(a) * i128::from(b);
        let ends = |a: u32, b: u32| {
            let [a, b] = [a, b].map(|v| &frame.vertices()[v as usize]);
            a.compare(b)
        };
        cross(self.x_height, other.height)
            .cmp(&cross(other.x_height, self.height))
            .then_with(|| ends(self.top, other.top))
            .then_with(|| ends(self.bottom, other.bottom))
    }

    /// Returns the parameter down the edge, 0..1.
    pub fn t(&self) -> f64 {
        self.fall as f64 / self.height as f64
    }
}

/// A pixel between two edges of its polygon.
#[derive(Clone, Copy, Debug)]
pub struct SpanPlace {
    /// The edge to its left, or through its centre.
    pub left: Crossing,
    /// The edge to its right.
    pub right: Crossing,
    /// The parameter from the left edge to the right one, 0..1.
    pub u: f64,
}

impl SpanPlace {
    /// Places the column `xc` between two crossings. They must differ.
    fn new(left: Crossing, right: Crossing, xc: i64) -> SpanPlace {
        // (xc − l) / (r − l) for the fractions l and r, multiplied by both heights. Only the
        // quotient at the end rounds.
        let (l, lh) = (i128::from(left.x_height), i128::from(left.height));
        let (r, rh) = (i128::from(right.x_height), i128::from(right.height));
        let u = ((i128::from(xc) * lh - l) * rh) as f64 / (r * lh - l * rh) as f64;
        SpanPlace { left, right, u }
    }
}

/// The weights of vertices in a pixel's attributes. Their sum is 1.
#[derive(Clone, Copy, Debug)]
pub struct VertexWeights([(u32, f64); 4]);

impl VertexWeights {
    /// Returns the barycentric coordinates of (`xc`, `yc`) in a triangle, as quotients of areas:
    /// ```text
    /// P = β₁ P₁ + β₂ P₂ + β₃ P₃      (L21 3)
    /// ```
    /// The area of the triangle must not be 0. The corners are sorted by
    /// [`ScreenVertex::compare`](crate::frame::ScreenVertex), so that the result does not depend on
    /// their order.
    fn of_triangle(frame: &Frame, mut corners: [u32; 3], xc: i64, yc: i64) -> VertexWeights {
        let vertex = |v: u32| &frame.vertices()[v as usize];
        corners.sort_by(|a, b| vertex(*a).compare(vertex(*b)));
        let [a, b, c] = corners.map(|v| position(frame, v));
        let twice_area = |p: (i64, i64), q: (i64, i64), r: (i64, i64)| {
            ((q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0)) as f64
        };
        // If the corners run the other way round, all areas change their signs, and the quotients
        // do not.
        let (p, all) = ((xc, yc), twice_area(a, b, c));
        VertexWeights([
            (corners[0], twice_area(p, b, c) / all),
            (corners[1], twice_area(a, p, c) / all),
            (corners[2], twice_area(a, b, p) / all),
            (corners[2], 0.0),
        ])
    }

    /// Interpolates linearly along both edges, then along the span between them:
    /// ```text
    /// P = (1−u) ((1−t) P₁ + t P₂) + u ((1−s) P₃ + s P₄)      (L21 3)
    /// ```
    fn of_span(place: &SpanPlace) -> VertexWeights {
        let (u, t, s) = (place.u, place.left.t(), place.right.t());
        VertexWeights([
            (place.left.top, (1.0 - u) * (1.0 - t)),
            (place.left.bottom, (1.0 - u) * t),
            (place.right.top, u * (1.0 - s)),
            (place.right.bottom, u * s),
        ])
    }

    /// Returns the vertices and their weights. The last corner of a triangle appears twice, the
    /// second time with weight 0.
    pub fn all(&self) -> [(u32, f64); 4] {
        self.0
    }

    /// Returns the weighted sum of `value` over the vertices.
    pub fn sum<T: Default + Add<Output = T> + Mul<f64, Output = T>>(
        &self,
        value: impl Fn(usize) -> T,
    ) -> T {
        self.0.iter().fold(T::default(), |sum, &(vertex, weight)| {
            sum + value(vertex as usize) * weight
        })
    }
}

/// A polygon on one row of pixel centres.
#[derive(Clone, Debug)]
pub struct Scanline<'a> {
    frame: &'a Frame,
    corners: &'a [u32],
    yc: i64,
    /// From left to right. Crossings at one point are ordered by the ends of their edges.
    crossings: Vec<Crossing>,
}

impl<'a> Scanline<'a> {
    /// Makes a scanline without crossings.
    pub fn new(frame: &'a Frame) -> Self {
        Scanline {
            frame,
            corners: &[],
            yc: 0,
            crossings: Vec::new(),
        }
    }

    /// Moves to the scanline through the pixel centres of row `y`, and crosses it with the polygon
    /// of these corners.
    pub fn cut(&mut self, corners: &'a [u32], y: usize) {
        self.corners = corners;
        self.yc = centre(y);
        let ends = corners.iter().zip(corners.iter().cycle().skip(1));
        self.crossings.clear();
        self.crossings.extend(
            ends.filter_map(|(&from, &to)| Crossing::of_edge(self.frame, from, to, self.yc)),
        );
        let frame = self.frame;
        self.crossings.sort_by(|a, b| a.compare(b, frame));
    }

    /// Returns the two edges between which the centre of the pixel `x` lies, or `None` if the
    /// polygon does not cover it.
    ///
    /// The centre is inside if the count of crossings at it or left of it is odd.
    pub fn edges(&self, x: usize) -> Option<(Crossing, Crossing)> {
        let passed = self
            .crossings
            .iter()
            .filter(|crossing| crossing.is_not_right_of(centre(x)))
            .count();
        // A closed polygon has an even count of crossings, so behind an odd one there is another.
        (passed % 2 == 1).then(|| (self.crossings[passed - 1], self.crossings[passed]))
    }

    /// True if the polygon covers any pixel of `columns`.
    fn covers_any(&self, columns: &Range<usize>) -> bool {
        // The first pixel centre at or right of each left edge.
        let mut firsts = self.crossings.iter().step_by(2).map(|crossing| {
            let numerator = crossing.x_height - PIXEL / 2 * crossing.height;
            // Rounds up, as `div_euclid` rounds down.
            let first = -(-numerator).div_euclid(PIXEL * crossing.height);
            first.clamp(columns.start as i64, columns.end as i64) as usize
        });
        firsts.any(|x| columns.contains(&x) && self.edges(x).is_some())
    }

    /// Returns the position of the pixel `x` between two edges, or `None` if the polygon does not
    /// cover it.
    pub fn place(&self, x: usize) -> Option<SpanPlace> {
        self.edges(x)
            .map(|(left, right)| SpanPlace::new(left, right, centre(x)))
    }

    /// Returns the weights at the pixel `x`, or `None` if the polygon does not cover it.
    pub fn weights(&self, x: usize) -> Option<VertexWeights> {
        if let &[a, b, c] = self.corners {
            self.edges(x)
                .map(|_| VertexWeights::of_triangle(self.frame, [a, b, c], centre(x), self.yc))
        } else {
            self.place(x).map(|place| VertexWeights::of_span(&place))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Frame;
    use crate::number::test_random::Random;
    use crate::reference::fixtures::{covered, drawing, shape};
    use alloc::vec;

    #[test]
    fn a_pixel_centre_on_an_edge_belongs_to_the_side_right_of_and_below_it() {
        // Every edge of this square runs through pixel centres. Left and top edges contain them,
        // right and bottom edges do not.
        let square = [(0.5, 0.5), (2.5, 0.5), (2.5, 2.5), (0.5, 2.5)];
        assert_eq!(drawing(4, 4, &[&square]), ["11..", "11..", "....", "...."]);
        // The square with its corners on the outer corners of pixels.
        let square = [(1.0, 1.0), (1.0, 3.0), (3.0, 3.0), (3.0, 1.0)];
        assert_eq!(drawing(4, 4, &[&square]), ["....", ".11.", ".11.", "...."]);
    }

    #[test]
    fn a_pixel_centre_on_a_corner_is_held_by_one_polygon_around_it() {
        // Four triangles meet at the centre of the middle pixel. The corners are pixel centres as
        // well.
        let (a, b, c, d, m) = ((0.5, 0.5), (4.5, 0.5), (4.5, 4.5), (0.5, 4.5), (2.5, 2.5));
        let [up, right, down, left] = [[a, b, m], [b, c, m], [c, d, m], [d, a, m]];
        assert_eq!(
            drawing(5, 5, &[&up]),
            ["1111.", ".11..", ".....", ".....", "....."]
        );
        assert_eq!(
            drawing(5, 5, &[&right]),
            [".....", "...1.", "..11.", "...1.", "....."]
        );
        assert_eq!(
            drawing(5, 5, &[&up, &right, &down, &left]),
            ["1111.", "1111.", "1111.", "1111.", "....."]
        );
    }

    #[test]
    fn the_two_triangles_of_a_square_share_its_pixels() {
        let (a, b, c, d) = ((0.5, 0.5), (5.5, 0.5), (5.5, 5.5), (0.5, 5.5));
        let once = ["11111.", "11111.", "11111.", "11111.", "11111.", "......"];
        assert_eq!(drawing(6, 6, &[&[a, b, c], &[a, c, d]]), once);
        assert_eq!(drawing(6, 6, &[&[b, d, a], &[d, b, c]]), once);
    }

    #[test]
    fn anything_is_covered_if_any_pixel_is() {
        let mut random = Random::new(11);
        let (mut some, mut none) = (0, 0);
        for round in 0..2000 {
            // From a part of a pixel to the whole picture, all around it.
            let size = [200, 600, 3000][round % 3];
            let at = [(); 2].map(|()| random.below(1600) as i64 - 300);
            let mut place = |k: usize| (at[k] + random.below(size) as i64) as f64 / 256.0;
            let corners: Vec<(f64, f64)> =
                (0..3 + round % 4).map(|_| (place(0), place(1))).collect();
            let frame = shape(4, 4, &[&corners]);
            let is_covered = covered(&frame).pixels().iter().any(|&count| count > 0);
            assert_eq!(is_anything_covered(&frame), is_covered, "{corners:?}");
            (some, none) = (
                some + usize::from(is_covered),
                none + usize::from(!is_covered),
            );
        }
        assert!(some > 100 && none > 100, "{some} {none}");
        assert!(!is_anything_covered(&Frame::empty(4, 4)));
    }

    #[test]
    fn what_is_enclosed_twice_is_outside() {
        // A square with a smaller one inside it, joined by a cut.
        let ring = [
            (0.0, 0.0),
            (5.0, 0.0),
            (5.0, 5.0),
            (0.0, 5.0),
            (0.0, 0.0),
            (1.0, 1.0),
            (4.0, 1.0),
            (4.0, 4.0),
            (1.0, 4.0),
            (1.0, 1.0),
        ];
        assert_eq!(
            drawing(5, 5, &[&ring]),
            ["11111", "1...1", "1...1", "1...1", "11111"]
        );
        // A comb: two spans on one scanline.
        let comb = [
            (0.0, 0.0),
            (1.0, 0.0),
            (1.0, 2.0),
            (3.0, 2.0),
            (3.0, 0.0),
            (4.0, 0.0),
            (4.0, 3.0),
            (0.0, 3.0),
        ];
        assert_eq!(drawing(5, 3, &[&comb]), ["1..1.", "1..1.", "1111."]);
    }

    /// The top-left rule as half-space tests, its other usual form: a point is inside if it lies on
    /// the inner side of each edge, or on an edge that is a left one (it runs upward when the
    /// corners run clockwise) or a top one (level and to the right).
    fn half_space_rule(corners: [(i64, i64); 3], p: (i64, i64)) -> bool {
        let area = |a: (i64, i64), b: (i64, i64), c: (i64, i64)| {
            (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
        };
        let [a, mut b, mut c] = corners;
        if area(a, b, c) < 0 {
            core::mem::swap(&mut b, &mut c);
        }
        [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| {
            let is_top_or_left = to.1 < from.1 || (to.1 == from.1 && to.0 > from.0);
            let side = area(from, to, p);
            side > 0 || (side == 0 && is_top_or_left)
        })
    }

    #[test]
    fn for_triangles_parity_is_the_top_left_rule() {
        let mut random = Random::new(1);
        let (mut inside, mut outside) = (0, 0);
        for _ in 0..2000 {
            // A grid of half pixels, so that half of all corners, and many edges, lie on pixel
            // centres.
            let mut place = || random.below(16) as i64 * 128;
            let corners = [(); 3].map(|()| (place(), place()));
            let frame = shape(
                7,
                7,
                &[&corners.map(|(x, y)| (x as f64 / 256.0, y as f64 / 256.0))],
            );
            let counts = covered(&frame);
            for (y, x) in (0..7).flat_map(|y| (0..7).map(move |x| (y, x))) {
                let expected = half_space_rule(corners, (centre(x), centre(y)));
                assert_eq!(counts.get(x, y) == 1, expected, "{corners:?} at {x}, {y}");
                *(if expected { &mut inside } else { &mut outside }) += 1;
            }
        }
        assert!(inside > 5_000 && outside > 50_000, "{inside} {outside}");
    }

    #[test]
    fn the_guard_band_is_within_the_integers() {
        let g = f64::from(Frame::GUARD);
        // Overflow checks are on in tests. The diagonal runs through pixel centres and belongs to
        // the right side.
        assert_eq!(
            drawing(3, 3, &[&[(-g, -g), (g, -g), (g, g)]]),
            ["111", ".11", "..1"]
        );
        assert_eq!(
            drawing(3, 3, &[&[(-g, -g), (g, g), (-g, g)]]),
            ["...", "1..", "11."]
        );
        let four = [(-g, -g), (g, -g + 1.0), (g, g), (-g, g - 1.0)];
        assert_eq!(drawing(3, 3, &[&four]), ["111", "111", "111"]);
        let frame = shape(1, 1, &[&four]);
        let mut scanline = Scanline::new(&frame);
        scanline.cut(frame.corners(&frame.polygons()[0]), 0);
        // The centre of the first pixel, seen from both sides: (g + ½) / 2g.
        let place = scanline.place(0).unwrap();
        assert_eq!(place.u, (g + 0.5) / (2.0 * g));
    }

    #[test]
    fn the_centroid_weighs_all_corners_alike() {
        let frame = shape(7, 5, &[&[(0.0, 0.0), (6.0, 0.0), (1.5, 4.5)]]);
        let mut scanline = Scanline::new(&frame);
        scanline.cut(frame.corners(&frame.polygons()[0]), 1);
        let VertexWeights(weights) = scanline.weights(2).unwrap();
        assert_eq!(
            weights,
            [(0, 1.0 / 3.0), (1, 1.0 / 3.0), (2, 1.0 / 3.0), (2, 0.0)]
        );
        assert!(scanline.weights(6).is_none());
    }

    /// Returns the largest difference, over the covered pixels, between the barycentric blend of
    /// the first three corners and the blend along edges and span. No affine function fits the
    /// values of four corners.
    fn forms_differ(corners: &[(f64, f64)]) -> (f64, usize) {
        let frame = shape(32, 32, &[corners]);
        let corners = frame.corners(&frame.polygons()[0]);
        let value = |v: usize| [0.25, 1.0, 0.5, 0.0][v];
        let (mut worst, mut pixels) = (0.0f64, 0);
        let mut scanline = Scanline::new(&frame);
        for y in 0..32 {
            scanline.cut(corners, y);
            for x in 0..32 {
                let Some(place) = scanline.place(x) else {
                    continue;
                };
                let three = [corners[0], corners[1], corners[2]];
                let areas =
                    VertexWeights::of_triangle(&frame, three, centre(x), centre(y)).sum(value);
                worst = worst.max((areas - VertexWeights::of_span(&place).sum(value)).abs());
                pixels += 1;
            }
        }
        (worst, pixels)
    }

    #[test]
    fn edges_then_span_is_barycentric_for_triangles_and_not_for_quadrilaterals() {
        let mut random = Random::new(2);
        let mut pixels = 0;
        for _ in 0..500 {
            let corners: [(f64, f64); 3] = core::array::from_fn(|_| {
                (
                    random.below(8192) as f64 / 256.0,
                    random.below(8192) as f64 / 256.0,
                )
            });
            // Barycentric: areas are exact, each quotient rounds once, then 3 products and sums of
            // values up to 1 round, at most 7 half-ulps of 1. Span: s and t round once, u three
            // times, 1−u and 1−t once each, the product once, then 4 products and sums, at most 20.
            // Together this is below 27 · 2⁻⁵³ < 14 ε.
            let (worst, n) = forms_differ(&corners);
            assert!(worst <= 14.0 * f64::EPSILON, "{worst} for {corners:?}");
            pixels += n;
        }
        assert!(pixels > 10_000);
        let (worst, _) = forms_differ(&[(1.0, 1.0), (30.0, 2.0), (31.0, 30.0), (2.0, 28.0)]);
        assert!(worst > 0.1, "{worst}");
    }

    #[test]
    fn crossings_that_meet_keep_the_order_of_the_edges() {
        // Two edges cross exactly on the scanline of row 1, at column 2.
        let frame = shape(4, 3, &[&[(0.0, 1.0), (4.0, 2.0), (0.0, 2.0), (4.0, 1.0)]]);
        let mut scanline = Scanline::new(&frame);
        scanline.cut(frame.corners(&frame.polygons()[0]), 1);
        let ends: Vec<_> = scanline
            .crossings
            .iter()
            .map(|c| (c.top, c.bottom))
            .collect();
        assert_eq!(ends, vec![(0, 1), (3, 2)]);
    }
}
