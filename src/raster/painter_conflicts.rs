//! Conflicts of the painter's algorithm: pairs of polygons drawn in the wrong order, and polygons
//! that no order draws right.
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::raster::painter_conflicts::conflicts;
//! use fastphong::scene::{Culling, HiddenSurfaces, PainterKey, Scene};
//!
//! let mut scene = Scene::of_mesh(builtin("teapot").unwrap());
//! scene.hidden_surfaces = HiddenSurfaces::Painter(PainterKey::Mean);
//! scene.culling = Culling::None;
// The teapot's handle and spout go through its side.
//! let found = conflicts(&scene.frame().unwrap());
//! assert!(found.interpenetrating > 0 && !found.cycles.is_empty());
//! ```

use super::setup::Varyings;
use super::spans::active::PolygonSpan;
use super::spans::scan;
use crate::frame::Frame;
use crate::reference::coverage::Scanline;
use crate::scene::Clipping;
use alloc::collections::BTreeSet;
use alloc::vec;
use alloc::vec::Vec;
use core::mem::replace;

/// The conflicts of drawing a frame's polygons in their order, without a depth test.
///
/// A polygon *hides* another if it is nearer at a pixel that both cover. Polygons are named by
/// their index in [`Frame::polygons`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Conflicts {
    /// Pairs (a, b) where a hides b but is drawn before it, in ascending order. If two polygons cut
    /// each other on the picture, each hides the other; the pair is then listed once, in either
    /// drawing order.
    pub wrong: Vec<(u32, u32)>,
    /// How many pairs hide each other: they cut each other on the picture.
    pub interpenetrating: usize,
    /// Groups of polygons that hide each other in a ring, so that no order draws them right. Each
    /// group is as large as possible (a strongly connected component of two polygons or more), with
    /// its members in ascending order.
    pub cycles: Vec<Vec<u32>>,
}

/// Depths that differ by less than this share of the larger one count as equal. Engines round each
/// to `f32`, by at most 2⁻²⁵ of it, and cannot tell them apart.
const SAME_DEPTH: f64 = 1.0 / (1u64 << 24) as f64;

/// Finds the conflicts of drawing the polygons of `frame` in their order, be it the painter's or
/// another.
///
/// It looks at every scanline. Where two spans of a row overlap, both depths are linear, so the two
/// ends of the overlap decide which polygon is nearer. Takes O(s d) for s spans, of which d lie
/// over each other.
pub fn conflicts(frame: &Frame) -> Conflicts {
    // All pairs (a, b) of which a hides b.
    let mut hides = BTreeSet::new();
    scan(frame, &Varyings::none(), &mut |row, line, _| {
        compare(frame, row, line.spans().to_vec(), &mut hides);
    });
    let drawn_wrong = |&&(a, b): &&(u32, u32)| a < b;
    let mutual = |&&(a, b): &&(u32, u32)| a < b && hides.contains(&(b, a));
    Conflicts {
        wrong: hides.iter().filter(drawn_wrong).copied().collect(),
        interpenetrating: hides.iter().filter(mutual).count(),
        cycles: cycles(&hides, frame.polygons().len()),
    }
}

/// Adds to `hides` the pairs that the spans of row `y` show.
fn compare(frame: &Frame, y: usize, mut spans: Vec<PolygonSpan>, hides: &mut BTreeSet<(u32, u32)>) {
    let tests_samples = frame.clipping() == Clipping::NdcCube;
    spans.sort_unstable_by_key(|span| (span.start, span.polygon));
    // The spans that reach the current pixel.
    let mut open: Vec<(usize, u32, Scanline<'_>)> = Vec::new();
    for span in spans {
        let (start, stop, polygon) = (span.start as usize, span.end as usize, span.polygon);
        open.retain(|(end, ..)| *end > start);
        let mut scanline = Scanline::new(frame);
        scanline.cut(frame.corners(&frame.polygons()[polygon as usize]), y);
        for (end, other, others_scanline) in &open {
            // Open spans end beyond `start`, so the overlap has at least one pixel.
            let (first, last) = (start, stop.min(*end) - 1);
            // The depth of each sample is tested against the cube. So the ends of the overlap may
            // be invisible, and every pixel is compared.
            let step = if tests_samples { 1 } else { last - first };
            for x in (first..=last).step_by(step.max(1)) {
                let depths = (depth(frame, &scanline, x), depth(frame, others_scanline, x));
                if let (Some(a), Some(b)) = depths {
                    let same = SAME_DEPTH * f64::max(a.abs(), b.abs());
                    if b - a > same {
                        hides.insert((polygon, *other));
                    } else if a - b > same {
                        hides.insert((*other, polygon));
                    }
                }
            }
        }
        open.push((stop, polygon, scanline));
    }
}

/// Returns a polygon's depth at a pixel; `None` if the polygon is not drawn there even when nothing
/// hides it.
fn depth(frame: &Frame, scanline: &Scanline, x: usize) -> Option<f64> {
    let depth = scanline.weights(x)?.sum(|v| frame.vertices()[v].depth);
    let [near, far] = frame.depth_range().depths();
    (frame.clipping() == Clipping::Planes || (near..=far).contains(&depth)).then_some(depth)
}

/// Returns the strongly connected components of two polygons or more, of `count` polygons.
///
/// This is the algorithm of Kosaraju and Sharir, with two searches. The first lists polygons in the
/// order in which a depth-first search leaves them. The second takes them in reverse: the component
/// of a polygon is every polygon that leads to it and was not met before.
fn cycles(hides: &BTreeSet<(u32, u32)>, count: usize) -> Vec<Vec<u32>> {
    let forward: Vec<(u32, u32)> = hides.iter().copied().collect();
    let mut backward: Vec<(u32, u32)> = hides.iter().map(|&(a, b)| (b, a)).collect();
    backward.sort_unstable();
    let (mut ended, mut is_met) = (Vec::new(), vec![false; count]);
    for &(root, _) in &forward {
        search(&forward, root, &mut is_met, &mut ended);
    }
    is_met.fill(false);
    let mut cycles = Vec::new();
    for &root in ended.iter().rev() {
        let mut component = Vec::new();
        search(&backward, root, &mut is_met, &mut component);
        if component.len() > 1 {
            component.sort_unstable();
            cycles.push(component);
        }
    }
    cycles.sort_unstable();
    cycles
}

/// Appends `root` and the polygons that it leads to, except those met before, in the order in which
/// a depth-first search leaves them. `edges` must be in ascending order. The search has its own
/// stack and does not recurse.
fn search(edges: &[(u32, u32)], root: u32, is_met: &mut [bool], left: &mut Vec<u32>) {
    let first_edge = |polygon: u32| edges.partition_point(|(from, _)| *from < polygon);
    // The polygons on the path, each with the edge to follow next.
    let mut path = Vec::new();
    let mut next = Some(root);
    loop {
        if let Some(polygon) = next
            && !replace(&mut is_met[polygon as usize], true)
        {
            path.push((polygon, first_edge(polygon)));
        }
        let Some((polygon, edge)) = path.last_mut() else {
            return;
        };
        let followed = edges.get(*edge).filter(|(from, _)| from == polygon);
        next = followed.map(|(_, to)| *to);
        *edge += 1;
        if next.is_none() {
            left.push(*polygon);
            path.pop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::test_random::Random;

    /// Finds cycles by their definition: two polygons are in one cycle if each leads to the other.
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
            let mut polygon = || random.below(count as u64) as u32;
            let pairs = (0..count * 3 / 2).map(|_| (polygon(), polygon()));
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
