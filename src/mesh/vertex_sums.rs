//! The sums of polygon normals around vertices (L21 3.1), on several threads.

use super::PolygonMesh;
use super::newell::unit_normal;
use crate::number::parallel::{collect, for_each_chunk, threads};
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

/// The sum of the unit normals of the polygons around a vertex.
#[derive(Clone, Copy, Default)]
pub(super) struct Sum {
    pub normal: DVec3,
    /// The number of summands.
    pub count: u32,
    /// The polygon that was added last, counted from 1.
    latest: u32,
}

/// Returns the sums of unit normals at all vertices, or groups of corners there; each in the order of the polygons, on however
/// many threads. `vertex` gives that of each corner, below `count`.
pub(super) fn sums(
    mesh: &PolygonMesh,
    polygons: &[DVec3],
    vertex: impl Fn(usize) -> usize + Sync,
    count: usize,
) -> Vec<Sum> {
    const RUN: usize = 1024;
    let runs = polygons.len().div_ceil(RUN);
    let corners = |run: usize| {
        let (first, last) = (run * RUN, polygons.len().min(run * RUN + RUN) - 1);
        mesh.corner_range(first).start..mesh.corner_range(last).end
    };
    // Each thread has vertices of its own, and passes over runs of polygons that have none of them.
    let reaches = collect(runs, 8, |run| {
        let vertices = corners(run).map(&vertex);
        vertices.fold((usize::MAX, 0), |(low, high), v| (low.min(v), high.max(v)))
    });
    let mut sums = vec![Sum::default(); count];
    for_each_chunk(
        &mut sums[..],
        count.div_ceil(threads()).max(1),
        &|first, own: &mut [Sum]| {
            let end = first + own.len();
            for run in (0..runs).filter(|&run| reaches[run].0 < end && reaches[run].1 >= first) {
                let range = run * RUN..polygons.len().min(run * RUN + RUN);
                for (p, &normal) in range.clone().zip(&polygons[range]) {
                    let Some(unit) = unit_normal(normal) else {
                        continue;
                    };
                    for corner in mesh.corner_range(p) {
                        let place = vertex(corner).wrapping_sub(first);
                        if let Some(sum) =
                            own.get_mut(place).filter(|sum| sum.latest != p as u32 + 1)
                        {
                            sum.latest = p as u32 + 1;
                            sum.normal += unit; // 3.1
                            sum.count += 1;
                        }
                    }
                }
            }
        },
    );
    sums
}
