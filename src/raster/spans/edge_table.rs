//! The edge table: all edges of a frame, sorted by the scanline on which they begin.

use super::edge::first_centre;
use crate::frame::Frame;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// An edge of a polygon, from its upper to its lower end.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TableEdge {
    /// The polygon, an index into [`Frame::polygons`].
    pub polygon: u32,
    /// The corner of the polygon at which the edge starts, counted around the polygon from 0.
    pub corner: u32,
    /// The vertex of its upper end.
    pub top: u32,
    /// The vertex of its lower end.
    pub bottom: u32,
}

/// All edges that cross the centre of a scanline of the picture, in buckets by the first scanline
/// that they cross.
///
/// Within a bucket edges are in the order of their polygons. Edges that begin above the picture are
/// in the first bucket. Edges that cross no scanline, like horizontal ones, are left out.
#[derive(Debug)]
pub(crate) struct EdgeTable {
    starts: Vec<u32>,
    edges: Vec<TableEdge>,
}

impl EdgeTable {
    /// Makes the table of a frame by counting sort, in time linear in edges and scanlines.
    pub fn new(frame: &Frame) -> Self {
        let rows = frame.height();
        let mut starts = vec![0u32; rows + 1];
        // Edges are found once and stored. A second search would mispredict the same branches
        // again: it is hard to predict which edges cross a scanline.
        let mut found = Vec::with_capacity(2 * frame.polygons().len());
        for index in 0..frame.polygons().len() as u32 {
            for_each_edge(frame, 0..rows as i32, index, |row, edge| {
                // Counted one place later, so that the sums below are the starts of the buckets.
                starts[row as usize + 1] += 1;
                found.push((row, edge));
            });
        }
        for row in 0..rows {
            starts[row + 1] += starts[row];
        }
        let mut edges = vec![TableEdge::default(); found.len()];
        let mut next = starts.clone();
        // `found` is in the order of polygons, and each bucket keeps this order.
        for (row, edge) in found {
            let place = &mut next[row as usize];
            edges[*place as usize] = edge;
            *place += 1;
        }
        EdgeTable { starts, edges }
    }

    /// Returns the edges that begin on scanline `row`, in the order of their polygons. The first
    /// bucket also has the edges that begin above the picture.
    pub fn bucket(&self, row: usize) -> &[TableEdge] {
        &self.edges[self.starts[row] as usize..self.starts[row + 1] as usize]
    }
}

/// Calls `visit` with each edge of `polygon` that crosses the centre of one of the scanlines
/// `rows`, and with the first of `rows` that it crosses.
#[inline(always)]
pub(crate) fn for_each_edge(
    frame: &Frame,
    rows: Range<i32>,
    polygon: u32,
    mut visit: impl FnMut(i32, TableEdge),
) {
    let vertices = frame.vertices();
    let corners = frame.corners(&frame.polygons()[polygon as usize]);
    let mut from = corners[corners.len() - 1];
    for (i, &to) in corners.iter().enumerate() {
        let corner = if i == 0 { corners.len() - 1 } else { i - 1 } as u32;
        let ends = [from, to].map(|v| (vertices[v as usize].y, v));
        from = to;
        let [(y, top), (end, bottom)] = if ends[0].0 <= ends[1].0 {
            ends
        } else {
            [ends[1], ends[0]]
        };
        let first = first_centre(y).max(rows.start);
        if first < first_centre(end).min(rows.end) {
            let edge = TableEdge {
                polygon,
                corner,
                top,
                bottom,
            };
            visit(first, edge);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{FrameBuilder, SubPixel, Vertex};
    use crate::mesh::Material;
    use crate::scene::Lighting;
    use glam::DVec3;

    /// Builds a frame of 8 × 4 pixels from the corners of polygons, in pixels. No two polygons
    /// share a vertex.
    fn frame(polygons: &[&[[f64; 2]]]) -> Frame {
        let mut builder = FrameBuilder::new(8, 4);
        let material =
            builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
        for (index, corners) in (0..).zip(polygons) {
            let corners: Vec<u32> = corners
                .iter()
                .map(|at| {
                    let [x, y] = at.map(SubPixel::from_num);
                    builder.vertex(Vertex {
                        x,
                        y,
                        depth: 0.5,
                        inv_w: 1.0,
                        normal: [0.0, 0.0, 1.0],
                        material,
                    })
                })
                .collect();
            builder.polygon(&corners, [0.0, 0.0, 1.0], index);
        }
        builder.finish().expect("corners inside the guard band")
    }

    /// Returns the polygon, corner, top and bottom of the edges in each bucket.
    fn buckets(frame: &Frame) -> Vec<Vec<[u32; 4]>> {
        let table = EdgeTable::new(frame);
        let fields = |e: &TableEdge| [e.polygon, e.corner, e.top, e.bottom];
        let bucket = |row| table.bucket(row).iter().map(fields).collect();
        (0..frame.height()).map(bucket).collect()
    }

    #[test]
    fn each_edge_stands_where_it_crosses_its_first_scanline() {
        let frame = frame(&[
            // From above the picture down to its last row. Its lower edge is horizontal.
            &[[1.0, -2.0], [5.0, 2.0], [5.0, 4.0], [1.0, 4.0]],
            // From the centre line of row 1, which belongs to it, to that of row 3, which does not.
            &[[6.0, 1.5], [7.0, 3.5], [5.0, 3.5]],
        ]);
        let expected: [&[[u32; 4]]; 4] = [
            &[[0, 3, 0, 3], [0, 0, 0, 1]],
            &[[1, 2, 4, 6], [1, 0, 4, 5]],
            &[[0, 1, 1, 2]],
            &[],
        ];
        assert_eq!(buckets(&frame), expected);
    }

    #[test]
    fn edges_that_cross_no_scanline_of_the_picture_are_left_out() {
        let frame = frame(&[
            &[[1.0, 1.6], [2.0, 2.4], [3.0, 1.8]], // between the centre lines of two rows
            &[[1.0, -3.0], [2.0, 0.5], [3.0, -1.0]], // above, as far as the first centre line
            &[[1.0, 4.0], [2.0, 9.0], [3.0, 5.0]], // below
        ]);
        assert!(buckets(&frame).iter().all(Vec::is_empty));
    }
}
