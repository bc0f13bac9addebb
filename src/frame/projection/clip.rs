//! Clipping in homogeneous space: before the division by w, where every polygon still is one.

use alloc::vec::Vec;
use core::cmp::Ordering;
use glam::DVec4;

/// A half-space of clip space: inside is where `plane · position ≥ 0`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    pub normal: DVec4,
    /// True if w is positive on both sides, so that a parameter linear on the screen exists.
    pub in_front: bool,
}

/// A corner on its way through the planes: its position, and the number of the vertex whose attributes it has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HomogeneousCorner {
    pub position: DVec4,
    pub vertex: u32,
}

/// A corner that a plane makes on the way from `a` to `b`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    pub a: HomogeneousCorner,
    pub b: HomogeneousCorner,
    /// The parameter from `a` to `b` in clip space, which is linear in space.
    pub t: f64,
    pub position: DVec4,
}

impl Cut {
    /// Intersects the edge between two corners with the plane.
    ///
    /// The ends are put in a canonical order first, so that the two polygons at an edge, which go along it in opposite
    /// directions, get the same corner to the last bit.
    fn new(plane: &Plane, p: HomogeneousCorner, q: HomogeneousCorner) -> Self {
        let (a, b) = if canonical(p.position, q.position) == Ordering::Greater {
            (q, p)
        } else {
            (p, q)
        };
        let (da, db) = (plane.normal.dot(a.position), plane.normal.dot(b.position));
        let t = (da / (da - db)).clamp(0.0, 1.0);
        Cut {
            a,
            b,
            t,
            position: a.position + (b.position - a.position) * t,
        }
    }

    /// Returns the parameter of the cut on the screen; both ends must be in front of the eye.
    pub fn t_on_screen(&self) -> f64 {
        let (wa, wb) = (self.a.position.w, self.b.position.w);
        (self.t * wb / ((1.0 - self.t) * wa + self.t * wb)).clamp(0.0, 1.0)
    }
}

fn canonical(p: DVec4, q: DVec4) -> Ordering {
    let pairs = p.to_array().into_iter().zip(q.to_array());
    pairs
        .map(|(a, b)| a.total_cmp(&b))
        .find(|o| *o != Ordering::Equal)
        .unwrap_or(Ordering::Equal)
}

/// Clips `polygon` to the inside of `plane`: gives no piece, one, or several if a concave polygon is cut apart.
///
/// `vertex` gives each new corner a number. The new corners lie on one line; from left to right along it they are pairs
/// of ends of the new edges. Joining them in that order, rather than in the order of the polygon, leaves no edges that
/// run back along the plane and no bridges between pieces.
pub(crate) fn clip(
    polygon: &[HomogeneousCorner],
    plane: &Plane,
    mut vertex: impl FnMut(&Cut) -> u32,
    mut piece: impl FnMut(&[HomogeneousCorner]),
) {
    let inside: Vec<bool> = polygon
        .iter()
        .map(|c| plane.normal.dot(c.position) >= 0.0)
        .collect();
    if inside.iter().all(|&i| i) {
        return piece(polygon);
    }
    let Some(outside) = inside.iter().position(|&i| !i) else {
        return;
    };
    // Runs of inside corners, each with its two cuts; starting from an outside corner none is split in two.
    let count = polygon.len();
    let mut runs: Vec<Vec<HomogeneousCorner>> = Vec::new();
    for step in 0..count {
        let (i, j) = ((outside + step) % count, (outside + step + 1) % count);
        if inside[i] != inside[j] {
            let cut = Cut::new(plane, polygon[i], polygon[j]);
            let corner = HomogeneousCorner {
                position: cut.position,
                vertex: vertex(&cut),
            };
            if inside[j] {
                runs.push(alloc::vec![corner]);
            } else if let Some(run) = runs.last_mut() {
                run.push(corner);
            }
        }
        if inside[j]
            && let Some(run) = runs.last_mut()
        {
            run.push(polygon[j]);
        }
    }
    join(runs, &mut piece);
}

/// Joins runs of corners into closed pieces along the cutting line.
fn join(runs: Vec<Vec<HomogeneousCorner>>, piece: &mut impl FnMut(&[HomogeneousCorner])) {
    if let [run] = &runs[..] {
        return piece(run);
    }
    // The ends in order along the line: (place, run, whether it is the run's beginning).
    let along = line_direction(&runs);
    let mut ends: Vec<(f64, usize, bool)> = Vec::new();
    for (number, run) in runs.iter().enumerate() {
        ends.push((along.dot(flat(run[0].position)), number, true));
        ends.push((along.dot(flat(run[run.len() - 1].position)), number, false));
    }
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Each run's ending is followed by the beginning that is its neighbour on the line.
    let mut follower = alloc::vec![usize::MAX; runs.len()];
    for pair in ends.chunks_exact(2) {
        match *pair {
            [(_, beginning, true), (_, ending, false)]
            | [(_, ending, false), (_, beginning, true)] => {
                follower[ending] = beginning;
            }
            // A polygon that crosses itself: no pairing is right, so it stays one piece, bridges and all.
            _ => return piece(&runs.concat()),
        }
    }
    let mut used = alloc::vec![false; runs.len()];
    for first in 0..runs.len() {
        let mut corners = Vec::new();
        let mut run = first;
        while !used[run] {
            used[run] = true;
            corners.extend_from_slice(&runs[run]);
            run = follower[run];
        }
        if corners.len() >= 3 {
            piece(&corners);
        }
    }
}

/// Divides a position by w, or returns its direction where w is 0.
fn flat(p: DVec4) -> glam::DVec3 {
    if p.w.abs() > f64::MIN_POSITIVE {
        p.truncate() / p.w
    } else {
        p.truncate()
    }
}

/// Returns the direction of the cutting line: from one end to the one farthest from it.
fn line_direction(runs: &[Vec<HomogeneousCorner>]) -> glam::DVec3 {
    let origin = flat(runs[0][0].position);
    let ends = runs.iter().flat_map(|run| [run[0], run[run.len() - 1]]);
    let differences = ends.map(|end| flat(end.position) - origin);
    differences
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
        .unwrap_or(glam::DVec3::X)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;

    /// Two polygons go along their common edge in opposite directions, and must be cut at the same place to the last bit.
    #[test]
    fn a_cut_does_not_depend_on_the_direction() {
        let mut random = Random::new(13);
        let plane = Plane {
            normal: DVec4::new(0.3, -0.2, 1.0, 0.1),
            in_front: false,
        };
        let mut cuts = 0;
        while cuts < 1000 {
            let mut corner = |vertex| {
                let mut number = || f64::from(random.signed()) * 7.3;
                HomogeneousCorner {
                    position: DVec4::new(number(), number(), number(), number()),
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
}
