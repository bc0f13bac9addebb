//! Where the painter goes wrong: pairs drawn in the wrong order, and polygons that no order draws right.
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::raster::painter::conflicts;
//! use fastphong::scene::{Culling, HiddenSurfaces, PainterKey, Scene};
//!
//! let mut scene = Scene::of_mesh(builtin("teapot").unwrap());
//! scene.hidden_surfaces = HiddenSurfaces::Painter(PainterKey::Mean);
//! scene.culling = Culling::None;
//! // The handle and the spout of the teapot go through its side.
//! let found = conflicts(&scene.frame().unwrap());
//! assert!(found.interpenetrating > 0 && !found.cycles.is_empty());
//! ```

use super::coverage;
use crate::frame::Frame;
use crate::reference::coverage::Scanline;
use crate::scene::Clipping;
use alloc::collections::BTreeSet;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// What is wrong with drawing the polygons of a frame in their order, without looking at depth.
///
/// A polygon *hides* another if it is nearer at a pixel that both cover. Polygons are named by their places in
/// [`Frame::polygons`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Conflicts {
    /// Pairs (a, b) of which a hides b and is drawn before it all the same, in ascending order. Of two polygons that cut
    /// each other on the picture each hides the other: such a pair is here once, whatever the order.
    pub wrong: Vec<(u32, u32)>,
    /// How many pairs hide each other: they cut each other on the picture.
    pub interpenetrating: usize,
    /// Polygons that hide each other in a ring, so that no order draws them right: each group as large as it gets
    /// (strongly connected components of two polygons or more), its members in ascending order.
    pub cycles: Vec<Vec<u32>>,
}

/// Depths that differ by less are taken for equal: corners are rounded to `f32`, by at most 2⁻²⁵ for depths up to 1, and so
/// are those of the other polygon.
const SAME_DEPTH: f64 = 1.0 / (1u64 << 24) as f64;

/// What is wrong with drawing the polygons of `frame` in their order, whether or not it is the painter's.
///
/// It goes over the scanlines. Where two spans of a row overlap, both depths are linear, so that who is nearer is told by
/// the two ends of the overlap. Takes O(s d) for s spans of which d lie over each other.
pub fn conflicts(frame: &Frame) -> Conflicts {
    let hides = relation(frame);
    let drawn_wrong = |&&(a, b): &&(u32, u32)| a < b;
    let mutual = |&&(a, b): &&(u32, u32)| a < b && hides.contains(&(b, a));
    Conflicts {
        wrong: hides.iter().filter(drawn_wrong).copied().collect(),
        interpenetrating: hides.iter().filter(mutual).count(),
        cycles: cycles(&hides, frame.polygons().len()),
    }
}

/// All pairs (a, b) of which a hides b.
fn relation(frame: &Frame) -> BTreeSet<(u32, u32)> {
    let mut hides = BTreeSet::new();
    let mut row_of_spans = 0;
    let mut spans: Vec<(Range<usize>, u32)> = Vec::new();
    let mut row = Row::new(frame);
    coverage(frame, |polygon, y, pixels| {
        if y != row_of_spans {
            row.compare(row_of_spans, &mut spans, &mut hides);
            spans.clear();
            row_of_spans = y;
        }
        spans.push((pixels, polygon));
    });
    row.compare(row_of_spans, &mut spans, &mut hides);
    hides
}

/// A row of pixels, and the spans that reach the one looked at.
struct Row<'a> {
    frame: &'a Frame,
    open: Vec<(Range<usize>, u32, Scanline<'a>)>,
}

impl<'a> Row<'a> {
    fn new(frame: &'a Frame) -> Self {
        Row {
            frame,
            open: Vec::new(),
        }
    }

    /// Adds what the spans of row `y` say to `hides`.
    fn compare(
        &mut self,
        y: usize,
        spans: &mut [(Range<usize>, u32)],
        hides: &mut BTreeSet<(u32, u32)>,
    ) {
        let frame = self.frame;
        let tests_samples = frame.clipping() == Clipping::NdcCube;
        spans.sort_unstable_by_key(|(pixels, polygon)| (pixels.start, *polygon));
        self.open.clear();
        for (pixels, polygon) in spans {
            self.open.retain(|(open, ..)| open.end > pixels.start);
            let mut scanline = Scanline::new(frame);
            scanline.cut(frame.corners(&frame.polygons()[*polygon as usize]), y);
            for (open, other, others_scanline) in &self.open {
                let (first, last) = (pixels.start, pixels.end.min(open.end) - 1);
                // Under the test of each sample the ends need not be seen.
                let step = if tests_samples {
                    1
                } else {
                    (last - first).max(1)
                };
                for x in (first..=last).step_by(step) {
                    let (Some(a), Some(b)) =
                        (depth(frame, &scanline, x), depth(frame, others_scanline, x))
                    else {
                        continue;
                    };
                    if b - a > SAME_DEPTH {
                        hides.insert((*polygon, *other));
                    } else if a - b > SAME_DEPTH {
                        hides.insert((*other, *polygon));
                    }
                }
            }
            self.open.push((pixels.clone(), *polygon, scanline));
        }
    }
}

/// The depth of a polygon at a pixel that shows it when nothing hides it.
fn depth(frame: &Frame, scanline: &Scanline, x: usize) -> Option<f64> {
    let depth = scanline
        .weights(x)
        .map(|weights| weights.sum(|v| f64::from(frame.vertices()[v].depth)));
    depth.filter(|z| frame.clipping() == Clipping::Planes || (0.0..=1.0).contains(z))
}

/// The strongly connected components of two polygons or more of `count` polygons (Tarjan, *Depth-first search and linear
/// graph algorithms*, 1972), without recursion.
fn cycles(hides: &BTreeSet<(u32, u32)>, count: usize) -> Vec<Vec<u32>> {
    const NEW: u32 = u32::MAX;
    let edges: Vec<(u32, u32)> = hides.iter().copied().collect();
    let first_edge = |polygon: u32| edges.partition_point(|(from, _)| *from < polygon);
    // When each polygon was found, and the earliest one found that it leads back to.
    let (mut found, mut lowest) = (vec![NEW; count], vec![NEW; count]);
    let (mut next, mut waiting, mut is_waiting) = (0, Vec::new(), vec![false; count]);
    let mut cycles = Vec::new();
    for root in edges.iter().map(|(from, _)| *from) {
        if found[root as usize] != NEW {
            continue;
        }
        // Polygons on the path, each with the edge to be followed next.
        let mut path = vec![(root, first_edge(root))];
        while let Some((polygon, edge)) = path.pop() {
            let at = polygon as usize;
            if found[at] == NEW {
                (found[at], lowest[at]) = (next, next);
                next += 1;
                waiting.push(polygon);
                is_waiting[at] = true;
            }
            match edges.get(edge) {
                Some(&(from, to)) if from == polygon => {
                    path.push((polygon, edge + 1));
                    if found[to as usize] == NEW {
                        path.push((to, first_edge(to)));
                    } else if is_waiting[to as usize] {
                        lowest[at] = lowest[at].min(found[to as usize]);
                    }
                    continue;
                }
                _ => {}
            }
            if lowest[at] == found[at] {
                let start = waiting.iter().rposition(|p| *p == polygon).unwrap_or(0);
                let mut component = waiting.split_off(start);
                component
                    .iter()
                    .for_each(|p| is_waiting[*p as usize] = false);
                if component.len() > 1 {
                    component.sort_unstable();
                    cycles.push(component);
                }
            }
            if let Some((parent, _)) = path.last() {
                lowest[*parent as usize] = lowest[*parent as usize].min(lowest[at]);
            }
        }
    }
    cycles.sort_unstable();
    cycles
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;

    /// The same by definition: two polygons are in one cycle if each leads to the other.
    fn by_reachability(hides: &BTreeSet<(u32, u32)>, count: usize) -> Vec<Vec<u32>> {
        let mut leads = vec![vec![false; count]; count];
        hides
            .iter()
            .for_each(|&(a, b)| leads[a as usize][b as usize] = true);
        for via in 0..count {
            for from in 0..count {
                for to in 0..count {
                    leads[from][to] |= leads[from][via] && leads[via][to];
                }
            }
        }
        let together = |a: usize, b: usize| a == b || leads[a][b] && leads[b][a];
        let group = |a: usize| {
            (0..count)
                .filter(|&b| together(a, b))
                .map(|b| b as u32)
                .collect::<Vec<_>>()
        };
        let groups: BTreeSet<Vec<u32>> = (0..count)
            .map(group)
            .filter(|group| group.len() > 1)
            .collect();
        groups.into_iter().collect()
    }

    #[test]
    fn cycles_are_what_leads_back() {
        let mut random = Random::new(3);
        let mut found = 0;
        for round in 0..500 {
            let count = 2 + round % 15;
            let mut number = || random.below(count as u64) as u32;
            let pairs = (0..count * 3 / 2).map(|_| (number(), number()));
            let hides: BTreeSet<(u32, u32)> = pairs.filter(|(a, b)| a != b).collect();
            assert_eq!(
                cycles(&hides, count),
                by_reachability(&hides, count),
                "{hides:?}"
            );
            found += cycles(&hides, count).len();
        }
        assert!(found > 200, "{found}");
    }

    #[test]
    fn a_long_chain_needs_no_deep_stack() {
        let count = 300_000;
        let mut hides: BTreeSet<(u32, u32)> = (0..count - 1).map(|i| (i, i + 1)).collect();
        assert!(cycles(&hides, count as usize).is_empty());
        hides.insert((count - 1, 0));
        assert_eq!(
            cycles(&hides, count as usize),
            [(0..count).collect::<Vec<u32>>()]
        );
    }
}
