//! Cutting polygons into triangles by ear clipping, exactly, on the snapped corners.
//!
//! Why exactly? Because crossing parity adds up. A triangle that is cut off and the rest of the
//! polygon share an edge. It counts twice, which is to say not at all. So at every pixel centre the
//! parities of all triangles sum to the parity of the polygon, whatever is cut off. Each pixel is
//! covered once if also no two triangles overlap, and that is checked on the result.

use super::{Frame, Polygon, ScreenVertex, SubPixel};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;

/// A frame of triangles.
#[derive(Clone, Debug)]
pub struct Triangulated {
    /// A frame of the same vertices, in which triangles replace the polygons of more than three
    /// corners, in the same order. They keep the material, the normal and the
    /// [`source`](Polygon::source) of their polygon.
    pub frame: Frame,
    /// The polygon that each triangle comes from, an index into [`Frame::polygons`] of the original
    /// frame.
    pub origins: Vec<u32>,
    /// How many polygons were left out because they cross or overlap themselves on the picture.
    pub not_simple: usize,
}

/// Returns `frame` with all polygons cut into triangles that cover the same pixels.
///
/// A convex polygon becomes the fan about its first corner. So its diagonals turn with it and do
/// not depend on the view. Polygons with equal corners are all cut like the first of them,
/// whichever corner each begins with and whichever way it runs, so none of them shows through
/// another. Corners that add no area (repeated ones, points of spikes) may be left out, and a
/// polygon without any area yields no triangle. The time grows with the square of the count of
/// corners, in bad cases with its cube.
pub fn triangulated(frame: &Frame) -> Triangulated {
    let walks = walks_of_equal_polygons(frame);
    let (mut not_simple, mut origins, mut indices) = (0, Vec::new(), 0..);
    let triangles = frame.with_pieces(|polygon, add| {
        let origin = indices.next().unwrap_or(u32::MAX);
        let mut add = |piece: &[u32]| {
            origins.push(origin);
            add(piece);
        };
        let corners = frame.corners(polygon);
        if corners.len() == 3 {
            return add(corners);
        }
        let walk = walks.get(&origin).copied().unwrap_or_default();
        let corner = |i: usize| corners[walk.at(i, corners.len())];
        let places: Vec<Position> = (0..corners.len())
            .map(|i| place(&frame.vertices()[corner(i) as usize]))
            .collect();
        match ears(&places) {
            Some(ears) => ears.iter().for_each(|&[a, b, c]| {
                // The pieces run the same way round as their polygon.
                let [b, c] = if walk.is_back { [c, b] } else { [b, c] };
                add(&[a, b, c].map(corner));
            }),
            None => not_simple += 1,
        }
    });
    Triangulated {
        frame: triangles,
        origins,
        not_simple,
    }
}

/// A way around a polygon: the corner that it begins with, and its direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Walk {
    start: usize,
    is_back: bool,
}

impl Walk {
    /// Returns the corner after `step` steps around `count` corners.
    fn at(self, step: usize, count: usize) -> usize {
        (self.start + if self.is_back { count - step } else { step }) % count
    }

    /// Returns a way around `polygon` that visits the corners of `first` in their order, if there
    /// is one.
    fn along(polygon: &[ScreenVertex], first: &[ScreenVertex]) -> Option<Walk> {
        let count = polygon.len();
        let is_along = |walk: &Walk| (0..count).all(|i| polygon[walk.at(i, count)] == first[i]);
        let ways =
            (0..count).flat_map(|start| [false, true].map(|is_back| Walk { start, is_back }));
        (count == first.len()).then(|| ways.into_iter().find(is_along))?
    }
}

/// Finds the polygons of more than three corners whose corners equal the corners of an earlier one.
/// Returns them by index, each with the way around it that follows the first of them.
fn walks_of_equal_polygons(frame: &Frame) -> BTreeMap<u32, Walk> {
    let polygons = frame.polygons();
    let vertices = |index: u32| -> Vec<ScreenVertex> {
        let corners = frame.corners(&polygons[index as usize]).iter();
        corners.map(|&v| frame.vertices()[v as usize]).collect()
    };
    // Equal polygons have equal sums, in whatever order their corners are added. Polygons with
    // equal sums by chance are told apart below.
    let sum = |polygon: &Polygon| {
        let corners = frame.corners(polygon).iter();
        corners.fold(0_u64, |sum, &v| {
            sum.wrapping_add(mixed(&frame.vertices()[v as usize]))
        })
    };
    let mut sums: Vec<(u64, u32)> = (0..)
        .zip(polygons)
        .filter(|(_, polygon)| polygon.count > 3)
        .map(|(index, polygon)| (sum(polygon), index))
        .collect();
    sums.sort_unstable();
    let mut walks = BTreeMap::new();
    for alike in sums
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|alike| alike.len() > 1)
    {
        let mut firsts: Vec<Vec<ScreenVertex>> = Vec::new();
        for &(_, index) in alike {
            let polygon = vertices(index);
            match firsts.iter().find_map(|first| Walk::along(&polygon, first)) {
                Some(walk) => _ = walks.insert(index, walk),
                None => firsts.push(polygon),
            }
        }
    }
    walks
}

/// Mixes the bits of a vertex, so that sums of different vertices differ.
fn mixed(vertex: &ScreenVertex) -> u64 {
    // Adding 0 turns −0 into 0.
    let bits = |c: f64| (c + 0.0).to_bits();
    let weights = bits(vertex.depth) ^ bits(vertex.inv_w).rotate_left(32);
    // The odd integer nearest to 2⁶⁴ over the golden ratio spreads close values over all bits.
    let spread = |bits: u64| bits.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let place = spread(vertex.packed());
    spread(place ^ place >> 32 ^ weights)
}

/// A column and a row in 1/256 pixel. Each is at most 2²³ from 0 ([`Frame::GUARD`] pixels), so
/// twice an area is below 2⁵⁰.
type Position = (i64, i64);

fn place(vertex: &ScreenVertex) -> Position {
    let bits = |c: SubPixel| i64::from(c.to_bits());
    (bits(vertex.x), bits(vertex.y))
}

/// Returns twice the signed area of a triangle: positive if it runs clockwise on the picture.
fn area(a: Position, b: Position, c: Position) -> i64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

/// Cuts a polygon into triangles, which are indices into its list of corners. Returns `None` if the
/// polygon is not simple.
fn ears(places: &[Position]) -> Option<Vec<[usize; 3]>> {
    let origin = *places.first()?;
    // A polygon of 2³² corners adds at most 2³² areas of 2⁵⁰, which needs more than 64 bits. The
    // last edge may be left out: with the first corner it spans no area.
    let whole: i128 = places
        .windows(2)
        .map(|edge| i128::from(area(origin, edge[0], edge[1])))
        .sum();
    let sign = whole.signum() as i64;
    if sign == 0 {
        let is_line = places
            .iter()
            .all(|&p| places.iter().all(|&q| area(origin, p, q) == 0));
        return is_line.then(Vec::new);
    }
    let mut ring = Ring {
        places,
        left: (0..places.len()).collect(),
        sign,
    };
    let mut triangles = Vec::new();
    // Starting beside the first corner and staying there yields the fan about it.
    let mut at = 1;
    while ring.left.len() > 3 {
        let next = |test: &dyn Fn(usize) -> bool| {
            let n = ring.left.len();
            (at..at + n).map(|i| i % n).find(|&i| test(i))
        };
        // Cutting off a part where two parts touch leaves a spike. It must go first, as its corners
        // would pass for corners of an ear.
        at = if let Some(spike) = next(&|i| ring.is_spike(i)) {
            spike
        } else if let Some(ear) =
            next(&|i| ring.is_ear(i, true)).or_else(|| next(&|i| ring.is_ear(i, false)))
        {
            triangles.push(ring.corner(ear));
            ear
        } else {
            // No ear: a corner without an area can be dropped. If there is none either, the polygon
            // is not simple.
            next(&|i| ring.area_at(i) == 0)?
        };
        ring.left.remove(at);
    }
    // Three corners are left, and each of them has the area of their triangle.
    match ring.area_at(1).signum() {
        0 => {}
        1 => triangles.push(ring.corner(1)),
        _ => return None,
    }
    are_apart(places, &triangles, sign).then_some(triangles)
}

/// The rest of a polygon, while ears are cut off.
struct Ring<'a> {
    places: &'a [Position],
    /// The corners that are left, in order.
    left: Vec<usize>,
    /// 1 for a polygon that runs clockwise on the picture, −1 for any other.
    sign: i64,
}

impl Ring<'_> {
    /// Returns corner `i` of the corners that are left, between its neighbours.
    fn corner(&self, i: usize) -> [usize; 3] {
        let n = self.left.len();
        [
            self.left[(i + n - 1) % n],
            self.left[i],
            self.left[(i + 1) % n],
        ]
    }

    /// Returns twice the area at corner `i`: positive if the polygon is convex there.
    fn area_at(&self, i: usize) -> i64 {
        let [a, b, c] = self.corner(i).map(|k| self.places[k]);
        self.sign * area(a, b, c)
    }

    /// True if the polygon goes to corner `i` and straight back to where it came from.
    fn is_spike(&self, i: usize) -> bool {
        let [a, _, c] = self.corner(i).map(|k| self.places[k]);
        a == c
    }

    /// True if the triangle at corner `i` can be cut off: the corner is convex, no other corner
    /// lies in the triangle, and no edge crosses the cut. Corners that coincide with the triangle's
    /// own do not count. A corner *on* its two outer edges, where the polygon touches itself,
    /// counts if `strict`.
    fn is_ear(&self, i: usize, strict: bool) -> bool {
        if self.area_at(i) <= 0 {
            return false;
        }
        let [a, b, c] = self.corner(i).map(|k| self.places[k]);
        let blocks = |p: Position| {
            let [ab, bc, ca] =
                [(a, b), (b, c), (c, a)].map(|(from, to)| self.sign * area(from, to, p));
            let is_inside = if strict {
                ab >= 0 && bc >= 0
            } else {
                ab > 0 && bc > 0
            };
            is_inside && ca >= 0 && ![a, b, c].contains(&p)
        };
        let n = self.left.len();
        (0..n).all(|k| {
            let (p, q) = (
                self.places[self.left[k]],
                self.places[self.left[(k + 1) % n]],
            );
            !blocks(p) && !segments_cross(a, c, p, q)
        })
    }
}

/// True if two segments cross in a point that is an end of neither.
fn segments_cross(a: Position, b: Position, p: Position, q: Position) -> bool {
    let opposite = |s: i64, t: i64| s.signum() * t.signum() < 0;
    opposite(area(a, b, p), area(a, b, q)) && opposite(area(p, q, a), area(p, q, b))
}

/// True if no two triangles overlap. All must have an area of this sign.
fn are_apart(places: &[Position], triangles: &[[usize; 3]], sign: i64) -> bool {
    // Two convex shapes are apart if all of one lies on the outer side of an edge of the other.
    let separates = |t: &[Position; 3], other: &[Position; 3]| {
        (0..3).any(|k| {
            other
                .iter()
                .all(|&p| sign * area(t[k], t[(k + 1) % 3], p) <= 0)
        })
    };
    let triangles: Vec<[Position; 3]> = triangles.iter().map(|t| t.map(|i| places[i])).collect();
    triangles.iter().enumerate().all(|(i, t)| {
        triangles[..i]
            .iter()
            .all(|u| separates(t, u) || separates(u, t))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;
    use crate::reference::fixtures::{covered, shape};
    use alloc::vec;
    use alloc::vec::Vec;

    type Points = Vec<(f64, f64)>;

    /// Cuts polygons and checks that each pixel is covered as often as before. Returns how many
    /// polygons were left out.
    fn check(side: u32, polygons: &[&[(f64, f64)]]) -> usize {
        let frame = shape(side, side, polygons);
        let cut = triangulated(&frame);
        assert!(cut.frame.polygons().iter().all(|p| p.count == 3));
        if cut.not_simple == 0 {
            assert_eq!(covered(&cut.frame), covered(&frame), "{polygons:?}");
        }
        cut.not_simple
    }

    fn triangles(polygon: &[(f64, f64)]) -> Option<Vec<[usize; 3]>> {
        ears(
            &polygon
                .iter()
                .map(|&(x, y)| ((x * 256.0) as i64, (y * 256.0) as i64))
                .collect::<Vec<_>>(),
        )
    }

    #[test]
    fn a_convex_polygon_becomes_the_fan_about_its_first_corner() {
        let pentagon = [(4.0, 0.0), (8.0, 3.0), (6.0, 8.0), (2.0, 8.0), (0.0, 3.0)];
        assert_eq!(
            triangles(&pentagon),
            Some(vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]])
        );
        let reversed: Points = pentagon.iter().rev().copied().collect();
        assert_eq!(
            triangles(&reversed),
            Some(vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]])
        );
        assert_eq!(check(9, &[&pentagon]), 0);
    }

    #[test]
    fn equal_polygons_are_cut_as_the_first_of_them() {
        let pentagon = [(4.0, 0.0), (8.0, 3.0), (6.0, 8.0), (2.0, 8.0), (0.0, 3.0)];
        let arrowhead = [(0.0, 0.0), (8.0, 4.0), (0.0, 8.0), (2.0, 4.0)];
        // Two triangles that touch in a corner of each.
        let touching = [
            (4.0, 0.0),
            (6.0, 2.0),
            (5.0, 3.0),
            (4.0, 0.0),
            (3.0, 5.0),
            (1.0, 3.0),
        ];
        let mut random = Random::new(6);
        let stars = [star(&mut random, 7), star(&mut random, 12)];
        for polygon in [&pentagon[..], &arrowhead, &touching, &stars[0], &stars[1]] {
            // The polygon, then one that differs, then all polygons that are equal to the first.
            let mut turned = vec![polygon.to_vec(), vec![(0.0, 0.0); 4]];
            for turn in 0..2 * polygon.len() {
                let mut copy = polygon.to_vec();
                copy.rotate_left(turn / 2);
                if turn % 2 == 1 {
                    copy.reverse();
                }
                turned.push(copy);
            }
            let lists: Vec<&[(f64, f64)]> = turned.iter().map(|list| &list[..]).collect();
            let frame = shape(65, 65, &lists);
            let cut = triangulated(&frame);
            // The corners of each piece in ascending order, so that the corner that it begins with
            // and its direction do not matter.
            let mut pieces = vec![Vec::new(); lists.len()];
            for (piece, &origin) in cut.frame.polygons().iter().zip(&cut.origins) {
                let corners = cut.frame.corners(piece);
                let vertices = corners.iter().map(|&v| cut.frame.vertices()[v as usize]);
                let mut places: Vec<Position> = vertices.map(|vertex| place(&vertex)).collect();
                let area = area(places[0], places[1], places[2]);
                let runs_back = origin > 1 && origin % 2 == 1;
                let first = triangles(polygon).expect("simple")[0]
                    .map(|i| polygon[i])
                    .map(|(x, y)| ((x * 256.0) as i64, (y * 256.0) as i64));
                let is_clockwise = self::area(first[0], first[1], first[2]) > 0;
                assert_eq!(
                    area > 0,
                    is_clockwise != runs_back,
                    "pieces run as their polygon"
                );
                places.sort_unstable();
                pieces[origin as usize].push(places);
            }
            assert!(pieces[0].len() > 1 && pieces[1].is_empty());
            for copy in &mut pieces {
                copy.sort_unstable();
            }
            assert!(
                pieces[2..].iter().all(|copy| *copy == pieces[0]),
                "{polygon:?}: {pieces:?}"
            );
        }
    }

    #[test]
    fn triangles_pass_and_pieces_know_their_polygon() {
        let frame = shape(
            9,
            9,
            &[
                &[(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)],
                &[(4.0, 4.0), (8.0, 4.0), (8.0, 8.0), (4.0, 8.0)],
            ],
        );
        let cut = triangulated(&frame);
        let pieces: Vec<_> = cut
            .frame
            .polygons()
            .iter()
            .map(|p| (cut.frame.corners(p).to_vec(), p.source))
            .collect();
        assert_eq!(
            pieces,
            [(vec![0, 1, 2], 0), (vec![3, 4, 5], 1), (vec![3, 5, 6], 1)]
        );
        assert_eq!(cut.frame.vertices(), frame.vertices());
        assert_eq!(cut.origins, [0, 1, 1]);
    }

    #[test]
    fn a_reflex_corner_turns_the_diagonal() {
        // The fan about the first corner would leave the arrowhead.
        assert_eq!(
            triangles(&[(0.0, 0.0), (8.0, 4.0), (0.0, 8.0), (2.0, 4.0)]),
            Some(vec![[1, 2, 3], [0, 1, 3]])
        );
    }

    #[test]
    fn collinear_corners_keep_their_triangles() {
        // A corner in the middle of an edge: its attributes must not be lost.
        let square = [(0.0, 0.0), (4.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)];
        let cut = triangles(&square).unwrap();
        assert_eq!(cut.len(), 3);
        assert!(cut.iter().flatten().any(|&corner| corner == 1));
        assert_eq!(check(9, &[&square]), 0);
    }

    #[test]
    fn repeated_corners_and_spikes_add_nothing() {
        let doubled: Points = [(0.5, 0.5), (8.5, 0.5), (8.5, 8.5), (0.5, 8.5)]
            .iter()
            .flat_map(|&p| [p, p, p])
            .collect();
        assert_eq!(triangles(&doubled).map(|t| t.len()), Some(2));
        assert_eq!(check(9, &[&doubled]), 0);
        let spike = [
            (1.0, 1.0),
            (5.0, 1.0),
            (8.0, 1.0),
            (5.0, 1.0),
            (5.0, 6.0),
            (1.0, 6.0),
        ];
        assert_eq!(triangles(&spike).map(|t| t.len()), Some(2));
        assert_eq!(check(9, &[&spike]), 0);
        assert_eq!(
            triangles(&[(1.0, 1.0), (2.0, 2.0), (5.0, 5.0), (3.0, 3.0)]),
            Some(vec![])
        );
        assert_eq!(triangles(&[(1.0, 1.0); 5]), Some(vec![]));
    }

    #[test]
    fn a_hole_joined_by_a_cut_stays_open() {
        let outer = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (0.0, 0.0)];
        let hole = [(3.0, 3.0), (3.0, 6.0), (6.0, 6.0), (6.0, 3.0), (3.0, 3.0)];
        let ring = [outer, hole].concat();
        assert_eq!(check(9, &[&ring]), 0);
        let reversed: Points = ring.iter().rev().copied().collect();
        assert_eq!(check(9, &[&reversed]), 0);
    }

    #[test]
    fn what_crosses_or_overlaps_itself_is_counted_and_left_out() {
        let bow_tie = [(0.0, 0.0), (8.0, 8.0), (8.0, 0.0), (0.0, 8.0)];
        let lopsided = [(0.0, 0.0), (8.0, 8.0), (8.0, 2.0), (0.0, 8.0)];
        // Every corner of a pentagram is convex: it has ears, and they overlap.
        let pentagram = [(4.0, 0.0), (6.0, 8.0), (0.0, 3.0), (8.0, 3.0), (2.0, 8.0)];
        let twice_around = [
            (0.0, 0.0),
            (8.0, 0.0),
            (4.0, 8.0),
            (0.0, 0.0),
            (8.0, 0.0),
            (4.0, 8.0),
        ];
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        for polygon in [&bow_tie[..], &lopsided, &pentagram, &twice_around] {
            let cut = triangulated(&shape(9, 9, &[polygon, &square]));
            assert_eq!(
                (cut.not_simple, cut.frame.polygons().len()),
                (1, 2),
                "{polygon:?}"
            );
            assert!(cut.frame.polygons().iter().all(|p| p.source == 1));
        }
    }

    #[test]
    fn the_guard_band_is_within_the_integers() {
        let g = f64::from(Frame::GUARD);
        assert_eq!(
            check(4, &[&[(-g, -g), (g, -g), (g, g), (1.0, 2.0), (-g, g)]]),
            0
        );
    }

    /// Returns a star-shaped polygon: its corners stand at equal angles around the middle, at
    /// random distances.
    fn star(random: &mut Random, corners: usize) -> Points {
        (0..corners)
            .map(|k| {
                let angle = core::f64::consts::TAU * k as f64 / corners as f64;
                // 1/64 pixel is more than enough to keep neighbours apart.
                let radius = 4.0 + random.below(27 * 64) as f64 / 64.0;
                (
                    32.5 + radius * libm::cos(angle),
                    32.5 + radius * libm::sin(angle),
                )
            })
            .collect()
    }

    #[test]
    fn stars_and_combs() {
        let mut random = Random::new(3);
        for corners in 4..60 {
            let mut polygon = star(&mut random, corners);
            assert_eq!(check(65, &[&polygon]), 0);
            polygon.reverse();
            assert_eq!(check(65, &[&polygon]), 0);
        }
        for teeth in 2..16 {
            // Tips at random heights on pixel centres, gaps down to one row.
            let mut comb: Points = vec![(4.0 * teeth as f64, 40.5), (0.5, 40.5)];
            for tooth in 0..teeth {
                let x = 4.0 * tooth as f64;
                comb.push((x + 0.5, random.below(30) as f64 + 0.5));
                comb.push((x + 2.5, random.below(30) as f64 + 0.5));
                comb.push((x + 2.5, 39.5));
                comb.push((x + 3.5, 39.5));
            }
            assert_eq!(check(65, &[&comb]), 0);
            comb.reverse();
            assert_eq!(check(65, &[&comb]), 0);
        }
    }

    #[test]
    fn polygons_that_share_a_ragged_edge_tile_the_picture() {
        let mut random = Random::new(4);
        for _ in 0..50 {
            let ragged: Points = (0..=16)
                .map(|k| (2.0 * k as f64, random.below(32 * 64) as f64 / 64.0))
                .collect();
            let above: Points = [&[(0.0, 0.0)][..], &ragged, &[(32.0, 0.0)]].concat();
            let below: Points = [&[(0.0, 32.0)][..], &ragged, &[(32.0, 32.0)]].concat();
            assert_eq!(check(32, &[&above, &below]), 0);
            let cut = triangulated(&shape(32, 32, &[&above, &below]));
            assert!(
                covered(&cut.frame).pixels().iter().all(|&n| n == 1),
                "{ragged:?}"
            );
        }
    }

    /// True if no two edges of a polygon meet, except neighbours in their common corner.
    fn is_simple(p: &[Position]) -> bool {
        let n = p.len();
        let on = |a: Position, b: Position, q: Position| {
            let within = |lo: i64, hi: i64, v: i64| lo.min(hi) <= v && v <= lo.max(hi);
            area(a, b, q) == 0 && within(a.0, b.0, q.0) && within(a.1, b.1, q.1)
        };
        (0..n).all(|i| {
            (0..i).all(|j| {
                let (a, b, c, d) = (p[i], p[(i + 1) % n], p[j], p[(j + 1) % n]);
                if (j + 1) % n == i {
                    !on(c, d, b) && !on(a, b, c)
                } else if (i + 1) % n == j {
                    !on(c, d, a) && !on(a, b, d)
                } else {
                    !segments_cross(a, b, c, d)
                        && !on(a, b, c)
                        && !on(a, b, d)
                        && !on(c, d, a)
                        && !on(c, d, b)
                }
            })
        })
    }

    #[test]
    fn random_polygons_are_cut_right_or_left_out_and_simple_ones_always_cut() {
        let mut random = Random::new(5);
        let (mut simple, mut left_out, mut touching) = (0, 0, 0);
        for round in 0..20_000 {
            // A coarse grid: most corners repeat, touch or line up with others.
            let mut place = || random.below(6) as i64 * 128 + 128;
            let corners: Vec<Position> = (0..4 + round % 6).map(|_| (place(), place())).collect();
            let points: Points = corners
                .iter()
                .map(|&(x, y)| (x as f64 / 256.0, y as f64 / 256.0))
                .collect();
            match (is_simple(&corners), check(4, &[&points])) {
                (true, not_simple) => {
                    assert_eq!(not_simple, 0, "{points:?}");
                    simple += 1;
                }
                (false, 0) => touching += 1,
                (false, _) => left_out += 1,
            }
        }
        assert!(
            simple > 2000 && left_out > 2000 && touching > 2500,
            "{simple} {left_out} {touching}"
        );
    }
}
