//! The edge table: all edges of a frame, by the scanline on which they begin.

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
    /// The corner that it starts from when one goes around the polygon: its number there.
    pub corner: u32,
    /// The vertex of its upper end.
    pub top: u32,
    /// The vertex of its lower end.
    pub bottom: u32,
}

/// All edges that cross the centre of a scanline of the picture, bucketed by the first one that they cross.
///
/// Within a bucket edges come in the order of their polygons. Edges that begin above the picture stand in the first bucket;
/// those that cross no scanline, horizontal ones among them, are left out.
#[derive(Debug)]
pub(crate) struct EdgeTable {
    starts: Vec<u32>,
    edges: Vec<TableEdge>,
}

impl EdgeTable {
    /// Makes the table of a frame: a counting sort, linear in edges and scanlines.
    pub fn new(frame: &Frame) -> Self {
        let rows = frame.height();
        let mut starts = vec![0u32; rows + 1];
        // Edges are looked for once: which ones cross a scanline is hard to predict.
        let mut found = Vec::with_capacity(2 * frame.polygons().len());
        for number in 0..frame.polygons().len() as u32 {
            for_each_edge(frame, 0..rows as i32, number, |row, edge| {
                starts[row as usize + 1] += 1;
                found.push((row, edge));
            });
        }
        for row in 0..rows {
            starts[row + 1] += starts[row];
        }
        let mut edges = vec![TableEdge::default(); found.len()];
        let mut next = starts.clone();
        for (row, edge) in found {
            let place = &mut next[row as usize];
            edges[*place as usize] = edge;
            *place += 1;
        }
        EdgeTable { starts, edges }
    }

    /// Returns the edges that begin on scanline `row`, in the order of their polygons; in the first bucket also those that began
    /// above.
    pub fn bucket(&self, row: usize) -> &[TableEdge] {
        &self.edges[self.starts[row] as usize..self.starts[row + 1] as usize]
    }
}

/// Calls `visit` with the edges of polygon `number` that cross centres of the scanlines `rows`, each with the first one of these.
#[inline(always)]
pub(crate) fn for_each_edge(
    frame: &Frame,
    rows: Range<i32>,
    number: u32,
    mut visit: impl FnMut(i32, TableEdge),
) {
    let vertices = frame.vertices();
    let corners = frame.corners(&frame.polygons()[number as usize]);
    let mut from = corners[corners.len() - 1];
    for (i, &to) in corners.iter().enumerate() {
        let corner = if i == 0 { corners.len() - 1 } else { i - 1 } as u32;
        let ends = [from, to].map(|v| (vertices[v as usize].y, v));
        from = to;
        // Selected, not jumped over: which end is the upper one is hard to predict.
        let [(y, top), (end, bottom)] = match ends[0].0 <= ends[1].0 {
            true => ends,
            false => [ends[1], ends[0]],
        };
        let first = first_centre(y).max(rows.start);
        if first < first_centre(end).min(rows.end) {
            let edge = TableEdge {
                polygon: number,
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

    /// Builds a frame of 8 × 4 pixels from the corners of polygons, in pixels; no two polygons share a vertex.
    fn frame(polygons: &[&[[f64; 2]]]) -> Frame {
        let mut builder = FrameBuilder::new(8, 4);
        let material =
            builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
        for (number, corners) in (0..).zip(polygons) {
            let corners = corners.iter().map(|at| {
                let [x, y] = at.map(SubPixel::from_num);
                builder.vertex(Vertex {
                    x,
                    y,
                    depth: 0.5,
                    inv_w: 1.0,
                    normal: [0.0, 0.0, 1.0],
                    material,
                })
            });
            let corners: Vec<u32> = corners.collect();
            builder.polygon(&corners, [0.0, 0.0, 1.0], number);
        }
        builder.finish().expect("corners inside the guard band")
    }

    /// Returns polygon, corner, top and bottom of the edges in each bucket.
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
