//! Clipping in homogeneous space, before the division by w, where a polygon behind the eye is still
//! a polygon.

use alloc::vec::Vec;
use core::cmp::Ordering;
use glam::DVec4;

/// A half-space of clip space. A position is inside if `normal · position ≥ 0`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    pub normal: DVec4,
    /// True if w is positive on both sides of the plane, so that a cut has a parameter that is
    /// linear on the screen.
    pub in_front: bool,
    /// The w of all points on the plane; `None` if it varies.
    pub w: Option<f64>,
}

/// A corner on its way through the planes: its position, and the vertex whose attributes it has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HomogeneousCorner {
    pub position: DVec4,
    pub vertex: u32,
}

/// A new corner, where a plane cuts the edge from `a` to `b`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    pub a: HomogeneousCorner,
    pub b: HomogeneousCorner,
    /// The parameter from `a` to `b` in clip space, which is linear in space.
    pub t: f64,
    pub position: DVec4,
}

impl Cut {
    /// Cuts the edge between two corners at a plane that separates them.
    ///
    /// The ends are put in a canonical order first. So the two polygons at an edge, which run along
    /// it in opposite directions, get the same corner to the last bit.
    fn new(plane: &Plane, p: HomogeneousCorner, q: HomogeneousCorner) -> Self {
        let (a, b) = if canonical(p.position, q.position) == Ordering::Greater {
            (q, p)
        } else {
            (p, q)
        };
        let (da, db) = (plane.normal.dot(a.position), plane.normal.dot(b.position));
        debug_assert!((da < 0.0) != (db < 0.0), "the plane is between the ends");
        // One distance is below 0 and the other is not, so their difference is not 0.
        let t = (da / (da - db)).clamp(0.0, 1.0);
        // a + (b − a) is not always b in floats. Returning b itself leaves a corner on the plane
        // where it is.
        let mut position = if t < 1.0 {
            a.position + (b.position - a.position) * t
        } else {
            b.position
        };
        // Where the near plane is very near, rounding could put the corner behind the eye.
        if let Some(w) = plane.w {
            position.w = w;
        }
        Cut { a, b, t, position }
    }

    /// Returns the parameter of the cut on the screen, if both ends are in front of the eye.
    ///
    /// The near plane cuts first, so they normally are. But if the ends of an edge are some 10¹⁶
    /// times as far away as the near plane, rounding may put its cut behind the eye. The cut then
    /// has no place on the screen, and keeps its parameter in space.
    pub fn t_on_screen(&self) -> f64 {
        let (wa, wb) = (self.a.position.w, self.b.position.w);
        if wa > 0.0 && wb > 0.0 {
            (self.t * wb / ((1.0 - self.t) * wa + self.t * wb)).clamp(0.0, 1.0)
        } else {
            self.t
        }
    }
}

/// Orders positions by their coordinates.
fn canonical(p: DVec4, q: DVec4) -> Ordering {
    let pairs = p.to_array().into_iter().zip(q.to_array());
    pairs
        .map(|(a, b)| a.total_cmp(&b))
        .find(|o| *o != Ordering::Equal)
        .unwrap_or(Ordering::Equal)
}

/// Clips `polygon` to the inside of `plane`, and calls `piece` for each piece that is left: none,
/// one, or several if a concave polygon is cut apart. Each has three corners or more. A polygon
/// that only touches the plane from outside leaves no piece; one that lies in the plane stays
/// whole.
///
/// `vertex` makes the vertex of each new corner and returns its index. All new corners lie on one
/// line. From one end of the line to the other, consecutive pairs of them are the ends of the new
/// edges. Joining them in this order, and not in the order of the polygon, leaves no edges that run
/// back along the plane and no bridges between pieces.
pub(crate) fn clip(
    polygon: &[HomogeneousCorner],
    plane: &Plane,
    mut vertex: impl FnMut(&Cut) -> u32,
    mut piece: impl FnMut(&[HomogeneousCorner]),
) {
    debug_assert!(polygon.len() >= 3, "a polygon has an inside");
    let distances: Vec<f64> = polygon
        .iter()
        .map(|c| plane.normal.dot(c.position))
        .collect();
    let is_inside = |i: usize| distances[i] >= 0.0;
    let count = polygon.len();
    let Some(outside) = (0..count).find(|&i| !is_inside(i)) else {
        return piece(polygon);
    };
    // Finds the runs of inside corners, each with a cut at both ends. Starting from an outside
    // corner splits no run.
    let mut runs: Vec<Vec<HomogeneousCorner>> = Vec::new();
    let at = |step: usize| (outside + step) % count;
    let mut first = 0;
    // From the last outside corner before a run to the first one behind it.
    while let Some(before) = (first..count).find(|&step| is_inside(at(step + 1))) {
        let behind = (before + 1..count)
            .find(|&step| !is_inside(at(step)))
            // Step `count` is the outside corner again.
            .unwrap_or(count);
        first = behind;
        // A run that only touches the plane has no area inside.
        if (before + 1..behind).all(|step| distances[at(step)] == 0.0) {
            continue;
        }
        let mut cut = |from: usize, to: usize| {
            let cut = Cut::new(plane, polygon[from], polygon[to]);
            HomogeneousCorner {
                position: cut.position,
                vertex: vertex(&cut),
            }
        };
        let mut run = alloc::vec![cut(at(before), at(before + 1))];
        run.extend((before + 1..behind).map(|step| polygon[at(step)]));
        run.push(cut(at(behind - 1), at(behind)));
        runs.push(run);
    }
    match &runs[..] {
        [] => (),
        [run] => piece(run),
        _ => join(&runs, &mut piece),
    }
}

/// Joins several runs of corners into closed pieces along the cutting line.
fn join(runs: &[Vec<HomogeneousCorner>], piece: &mut impl FnMut(&[HomogeneousCorner])) {
    debug_assert!(runs.len() >= 2, "one run is a piece by itself");
    // The ends in order along the line, each with its position, its run, and true if it is the
    // run's beginning.
    let along = line_direction(runs);
    let mut ends: Vec<(DVec4, usize, bool)> = Vec::new();
    for (index, run) in runs.iter().enumerate() {
        ends.push((run[0].position, index, true));
        ends.push((run[run.len() - 1].position, index, false));
    }
    let place = |position| along.dot(flat(position));
    ends.sort_by(|a, b| {
        let places = place(a.0).total_cmp(&place(b.0));
        places.then(canonical(a.0, b.0))
    });
    // Each run's ending is followed by the beginning next to it on the line.
    let mut follower = alloc::vec![usize::MAX; runs.len()];
    for pair in ends.chunks_exact(2) {
        match *pair {
            [(_, beginning, true), (_, ending, false)]
            | [(_, ending, false), (_, beginning, true)] => {
                follower[ending] = beginning;
            }
            // The polygon crosses itself and no pairing is right. It stays one piece, bridges
            // included.
            _ => return piece(&runs.concat()),
        }
    }
    debug_assert!(
        follower.iter().all(|&run| run < runs.len()),
        "each run has an ending, and each ending a pair"
    );
    let mut used = alloc::vec![false; runs.len()];
    for first in 0..runs.len() {
        let mut corners = Vec::new();
        let mut run = first;
        while !used[run] {
            used[run] = true;
            corners.extend_from_slice(&runs[run]);
            run = follower[run];
        }
        if !corners.is_empty() {
            piece(&corners);
        }
    }
}

/// Divides a position by w. Returns its direction if w is 0 or too small to divide by.
fn flat(p: DVec4) -> glam::DVec3 {
    if p.w.is_normal() {
        p.truncate() / p.w
    } else {
        p.truncate()
    }
}

/// Returns the direction of the cutting line: from the least end, in canonical order, to the end
/// farthest from it. A polygon that is not flat has ends on no line; then starting at the least one
/// makes pieces independent of where the polygon begins and how it runs.
fn line_direction(runs: &[Vec<HomogeneousCorner>]) -> glam::DVec3 {
    let mut ends: Vec<DVec4> = runs
        .iter()
        .flat_map(|run| [run[0], run[run.len() - 1]])
        .map(|end| end.position)
        .collect();
    ends.sort_by(|&a, &b| canonical(a, b));
    let origin = flat(ends[0]);
    let differences = ends.iter().map(|&end| flat(end) - origin);
    differences
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
        .unwrap_or(glam::DVec3::X)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;

    /// Two polygons run along their common edge in opposite directions, and must be cut at the same
    /// place to the last bit.
    #[test]
    fn a_cut_does_not_depend_on_the_direction() {
        let mut random = Random::new(13);
        let plane = Plane {
            normal: DVec4::new(0.3, -0.2, 1.0, 0.1),
            in_front: false,
            w: None,
        };
        let mut cuts = 0;
        while cuts < 1000 {
            let mut corner = |vertex| {
                let mut value = || f64::from(random.signed()) * 7.3;
                HomogeneousCorner {
                    position: DVec4::new(value(), value(), value(), value()),
                    vertex,
                }
            };
            let (p, q) = (corner(0), corner(1));
            if plane.normal.dot(p.position) * plane.normal.dot(q.position) >= 0.0 {
                continue;
            }
            let (there, back) = (Cut::new(&plane, p, q), Cut::new(&plane, q, p));
            assert_eq!(
                (there.position, there.t, there.a.vertex),
                (back.position, back.t, back.a.vertex)
            );
            cuts += 1;
        }
    }

    fn cut(wa: f64, wb: f64, t: f64) -> Cut {
        let corner = |w: f64| HomogeneousCorner {
            position: DVec4::W * w,
            vertex: 0,
        };
        Cut {
            a: corner(wa),
            b: corner(wb),
            t,
            position: DVec4::ZERO,
        }
    }

    #[test]
    fn the_middle_of_an_edge_on_the_screen_is_nearer_to_its_near_end_in_space() {
        // From x = −2 at w = 2 to x = 6 at w = 6. Half-way from −1 to 1 x/w is 0, and there x is 0.
        assert_eq!(cut(2.0, 6.0, 0.25).t_on_screen(), 0.5);
        assert_eq!(cut(6.0, 2.0, 0.75).t_on_screen(), 0.5);
    }

    #[test]
    fn a_cut_keeps_its_parameter_in_space_if_an_end_has_no_place_on_the_screen() {
        for w in [0.0, -0.5] {
            assert_eq!(cut(w, 2.0, 0.25).t_on_screen(), 0.25, "{w}");
            assert_eq!(cut(2.0, w, 0.25).t_on_screen(), 0.25, "{w}");
        }
    }

    /// Returns an integer coordinate in −`most`..=`most`, so that corners often coincide or lie on
    /// planes.
    fn whole(random: &mut Random, most: u64) -> f64 {
        random.below(2 * most + 1) as f64 - most as f64
    }

    fn polygon(positions: &[[f64; 4]]) -> Vec<HomogeneousCorner> {
        let corners = (0..).zip(positions);
        corners
            .map(|(vertex, &position)| HomogeneousCorner {
                position: DVec4::from_array(position),
                vertex,
            })
            .collect()
    }

    fn plane(normal: [f64; 4]) -> Plane {
        Plane {
            normal: DVec4::from_array(normal),
            in_front: false,
            w: None,
        }
    }

    fn pieces(polygon: &[HomogeneousCorner], plane: &Plane) -> Vec<Vec<HomogeneousCorner>> {
        let mut pieces = Vec::new();
        clip(polygon, plane, |_| 99, |piece| pieces.push(piece.to_vec()));
        pieces
    }

    /// Returns the signed area of a polygon in the plane z = 0, w = 1.
    fn area(polygon: &[HomogeneousCorner]) -> f64 {
        let next = polygon.iter().cycle().skip(1);
        let cross = |(a, b): (&HomogeneousCorner, &HomogeneousCorner)| {
            a.position.x * b.position.y - a.position.y * b.position.x
        };
        0.5 * polygon.iter().zip(next).map(cross).sum::<f64>()
    }

    const SQUARE: [[f64; 4]; 4] = [
        [0.0, 0.0, 0.0, 1.0],
        [2.0, 0.0, 0.0, 1.0],
        [2.0, 2.0, 0.0, 1.0],
        [0.0, 2.0, 0.0, 1.0],
    ];

    /// Returns the areas of the pieces of the square where x·a + y·b + c ≥ 0.
    fn areas_of_the_square(a: f64, b: f64, c: f64) -> Vec<f64> {
        let pieces = pieces(&polygon(&SQUARE), &plane([a, b, 0.0, c]));
        pieces.iter().map(|piece| area(piece)).collect()
    }

    #[test]
    fn a_polygon_outside_a_plane_has_no_piece() {
        assert!(areas_of_the_square(1.0, 0.0, -3.0).is_empty());
    }

    #[test]
    fn a_polygon_that_touches_a_plane_from_outside_has_no_piece() {
        assert!(areas_of_the_square(1.0, 0.0, -2.0).is_empty(), "an edge");
        assert!(areas_of_the_square(1.0, 1.0, -4.0).is_empty(), "a corner");
    }

    #[test]
    fn a_polygon_that_touches_a_plane_from_inside_stays_whole() {
        assert_eq!(areas_of_the_square(1.0, 0.0, 0.0), [4.0], "by an edge");
        assert_eq!(areas_of_the_square(1.0, 1.0, 0.0), [4.0], "by a corner");
    }

    #[test]
    fn a_polygon_in_a_plane_stays_whole() {
        let pieces = pieces(&polygon(&SQUARE), &plane([0.0, 0.0, 1.0, 0.0]));
        assert_eq!(pieces.len(), 1);
        assert_eq!(area(&pieces[0]), 4.0);
    }

    #[test]
    fn a_plane_through_two_corners_halves_a_square() {
        assert_eq!(areas_of_the_square(1.0, -1.0, 0.0), [2.0]);
    }

    #[test]
    fn teeth_that_end_at_a_plane_leave_no_piece_beside_the_one_that_passes_it() {
        // Three teeth point upward: one to y = 2, one to y = 1 with a corner, one to y = 1 with an
        // edge.
        let outline = [
            [0.0, 0.0],
            [9.0, 0.0],
            [9.0, 1.0],
            [8.0, 1.0],
            [7.0, 0.5],
            [6.0, 1.0],
            [5.0, 0.5],
            [3.0, 2.0],
            [1.0, 2.0],
        ];
        let corners = polygon(&outline.map(|[x, y]| [x, y, 0.0, 1.0]));
        let pieces = pieces(&corners, &plane([0.0, 1.0, 0.0, -1.0]));
        assert_eq!(pieces.len(), 1);
        assert_eq!(pieces[0].len(), 4);
    }

    /// The lower part of a U is one piece. Its cuts must be joined in the order of x/w, which
    /// differs from the order of x. The second U is so far away that only differences of positions
    /// show the direction of the line.
    #[test]
    fn a_u_cut_through_its_arms_is_one_piece() {
        for y_cut in [0.0, 2e9] {
            let outline = [
                [-2.0, 2.0],
                [-2.0, -2.0],
                [2.0, -2.0],
                [2.0, 2.0],
                [1.0, 1.0],
                [1.0, -1.0],
                [-1.0, -1.0],
                [-1.0, 1.0],
            ];
            let positions = outline.map(|[x, y]| {
                let w = if x == -2.0 { 8.0 } else { 1.0 };
                [(x + 3.0) * w, (y + y_cut) * w, 0.0, w]
            });
            let pieces = pieces(&polygon(&positions), &plane([0.0, -1.0, 0.0, y_cut]));
            let on_screen = pieces.iter().map(|piece| {
                let places = piece.iter().map(|c| c.position / c.position.w);
                places.map(|p| [p.x - 3.0, p.y - y_cut]).collect::<Vec<_>>()
            });
            let mut expected = outline;
            expected.iter_mut().for_each(|[_, y]| *y = y.min(0.0));
            assert_eq!(on_screen.collect::<Vec<_>>(), [expected], "{y_cut}");
        }
    }

    /// A cut at an end equals that end to the last bit, in either order of the ends.
    #[test]
    fn a_corner_on_a_plane_stays_where_it_is() {
        let on = [0.1 + 0.2, 0.7, 0.0, 1.0];
        for other in [[-1e16, -1.0, 0.0, 1.0], [1e16, -1.0, 0.0, 1.0]] {
            let ends = polygon(&[other, on]);
            let normal = DVec4::new(0.0, 1.0, 0.0, -0.7);
            let plane = Plane {
                w: None,
                normal,
                in_front: true,
            };
            let cut = Cut::new(&plane, ends[0], ends[1]);
            assert_eq!(cut.position.to_array(), on);
        }
    }

    /// Tries any polygon in a plane of the picture: convex, concave, crossing itself, with repeated
    /// corners, on a line or a point.
    #[test]
    fn the_pieces_on_both_sides_of_a_plane_add_up_to_the_polygon() {
        let mut random = Random::new(29);
        let mut cut_apart = 0;
        for _ in 0..20_000 {
            let count = 3 + random.below(8);
            let corners: Vec<[f64; 4]> = (0..count)
                .map(|_| [whole(&mut random, 4), whole(&mut random, 4), 0.0, 1.0])
                .collect();
            let corners = polygon(&corners);
            let normal = [0, 1, 2].map(|_| whole(&mut random, 3));
            let one = plane([normal[0], normal[1], 0.0, normal[2]]);
            let other = Plane {
                normal: -one.normal,
                ..one
            };
            let on_plane = corners.iter().all(|c| one.normal.dot(c.position) == 0.0);
            let sides = [one, other].map(|plane| {
                let pieces = pieces(&corners, &plane);
                cut_apart += usize::from(pieces.len() > 1);
                for corner in pieces.iter().flatten() {
                    // t, the product and the sum are each rounded: 3 · 2⁻⁵³ of 8 in a coordinate,
                    // and 7 times that in the product.
                    let least = -1.9e-14;
                    assert!(
                        plane.normal.dot(corner.position) >= least,
                        "{corners:?} {normal:?}"
                    );
                }
                assert!(pieces.iter().all(|piece| piece.len() >= 3));
                pieces.iter().map(|piece| area(piece)).sum::<f64>()
            });
            let whole = area(&corners);
            if on_plane {
                assert_eq!(sides, [whole; 2]);
                continue;
            }
            // At most 40 cut corners, each with an error of 2.7e-15, next to edges of at most 12.
            let error = (sides[0] + sides[1] - whole).abs();
            assert!(error < 2e-12, "{corners:?} {normal:?} {sides:?} {whole}");
        }
        assert!(cut_apart > 1000, "{cut_apart}");
    }

    /// A triangle is convex, so neither part turns over, and neither is larger than the whole.
    #[test]
    fn both_parts_of_a_triangle_turn_as_the_whole_does() {
        let mut random = Random::new(31);
        for _ in 0..20_000 {
            let corners = [0; 3].map(|_| [whole(&mut random, 3), whole(&mut random, 3), 0.0, 1.0]);
            let normal = [0, 1, 2].map(|_| whole(&mut random, 2));
            let corners = polygon(&corners);
            let part = pieces(&corners, &plane([normal[0], normal[1], 0.0, normal[2]]));
            assert!(part.len() <= 1, "a triangle is not cut apart");
            let (part, whole) = (part.iter().map(|p| area(p)).sum::<f64>(), area(&corners));
            let share = if whole < 0.0 { -part } else { part };
            assert!(
                -1e-13 <= share && share <= whole.abs() + 1e-13,
                "{corners:?} {normal:?}"
            );
        }
    }

    /// Cuts polygons that need not be flat, with w of any sign and 0, at several planes one after
    /// the other.
    #[test]
    fn what_is_left_of_any_polygon_is_inside_all_planes() {
        let mut random = Random::new(37);
        let mut left = 0;
        for _ in 0..20_000 {
            let count = 3 + random.below(6);
            let corners: Vec<[f64; 4]> = (0..count)
                .map(|_| [0; 4].map(|_| whole(&mut random, 3)))
                .collect();
            let planes = [0; 4].map(|_| plane([0; 4].map(|_| whole(&mut random, 2))));
            let mut parts = alloc::vec![polygon(&corners)];
            for plane in &planes {
                parts = parts.iter().flat_map(|part| pieces(part, plane)).collect();
            }
            for part in &parts {
                assert!(part.len() >= 3, "{corners:?} {planes:?}");
                for corner in part {
                    // As above, with 6 in each of four coordinates and normals of length 4, for
                    // each of four cuts.
                    let inside = |plane: &Plane| plane.normal.dot(corner.position) >= -1e-13;
                    assert!(planes.iter().all(inside), "{corners:?} {planes:?}");
                }
            }
            left += parts.len();
        }
        assert!(left > 1000, "{left}");
    }

    /// The pieces have the same edges, whatever corner a polygon begins with and whichever way it
    /// runs, even if it is not flat and crosses itself.
    #[test]
    fn pieces_do_not_depend_on_where_a_polygon_begins() {
        let mut random = Random::new(17);
        let plane = plane([0.0, 0.0, 1.0, 0.0]);
        let mut several = 0;
        for round in 0..2000 {
            let corners: Vec<HomogeneousCorner> = (0..4 + round % 5)
                .map(|vertex| {
                    let mut value = || f64::from(random.signed());
                    HomogeneousCorner {
                        position: DVec4::new(value(), value(), value(), 1.0),
                        vertex,
                    }
                })
                .collect();
            let edges = |corners: &[HomogeneousCorner]| {
                let bits =
                    |corner: &HomogeneousCorner| corner.position.to_array().map(f64::to_bits);
                let mut edges = Vec::new();
                for piece in pieces(corners, &plane) {
                    for (a, b) in piece.iter().zip(piece.iter().cycle().skip(1)) {
                        let (a, b) = (bits(a), bits(b));
                        edges.push((a.min(b), a.max(b)));
                    }
                }
                edges.sort_unstable();
                edges
            };
            let first = edges(&corners);
            several += usize::from(pieces(&corners, &plane).len() > 1);
            for turn in 0..2 * corners.len() {
                let mut turned = corners.clone();
                turned.rotate_left(turn / 2);
                if turn % 2 == 1 {
                    turned.reverse();
                }
                assert_eq!(edges(&turned), first, "{corners:?}");
            }
        }
        assert!(several > 100, "{several}");
    }
}
