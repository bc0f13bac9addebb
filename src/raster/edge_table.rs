//! The edge table: all edges of a frame, by the scanline on which they begin.

use super::edge::first_centre;
use crate::frame::Frame;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// An edge of a polygon, from its upper to its lower end.
#[derive(Clone, Copy, Debug, Default)]
pub struct TableEdge {
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
/// Within a bucket edges come in the order of their polygons. Edges that begin above the picture stand in the first
/// bucket; those that cross no scanline, horizontal ones among them, are left out.
#[derive(Debug)]
pub struct EdgeTable {
    rows: Range<usize>,
    starts: Vec<u32>,
    edges: Vec<TableEdge>,
}

impl EdgeTable {
    /// The table of a frame.
    pub fn of_all(frame: &Frame) -> Self {
        let all: Vec<u32> = (0..frame.polygons().len() as u32).collect();
        EdgeTable::new(frame, 0..frame.height(), &[&all])
    }

    /// The table of the polygons in the lists `numbers`, which ascend, on the scanlines `rows`, as if these were the whole picture:
    /// a counting sort, linear in edges and scanlines.
    pub fn new(frame: &Frame, rows: Range<usize>, numbers: &[&[u32]]) -> Self {
        let count = rows.len();
        let mut starts = vec![0u32; count + 1];
        for_each_edge(frame, &rows, numbers, |row, _| starts[row + 1] += 1);
        for row in 0..count {
            starts[row + 1] += starts[row];
        }
        let mut edges = vec![TableEdge::default(); starts[count] as usize];
        let mut next = starts.clone();
        for_each_edge(frame, &rows, numbers, |row, edge| {
            edges[next[row] as usize] = edge;
            next[row] += 1;
        });
        EdgeTable {
            rows,
            starts,
            edges,
        }
    }

    /// The scanlines that it is for.
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// The edges that begin on scanline `row`, in the order of their polygons; in the first bucket also those that began
    /// above.
    pub fn bucket(&self, row: usize) -> &[TableEdge] {
        let row = row - self.rows.start;
        &self.edges[self.starts[row] as usize..self.starts[row + 1] as usize]
    }
}

fn for_each_edge(
    frame: &Frame,
    rows: &Range<usize>,
    numbers: &[&[u32]],
    mut visit: impl FnMut(usize, TableEdge),
) {
    let (first_row, end_row) = (rows.start as i32, rows.end as i32);
    let vertices = frame.vertices();
    for &number in numbers.iter().copied().flatten() {
        let corners = frame.corners(&frame.polygons()[number as usize]);
        let mut from = corners[corners.len() - 1];
        for (i, &to) in corners.iter().enumerate() {
            let corner = if i == 0 { corners.len() - 1 } else { i - 1 } as u32;
            let (mut top, mut bottom) = (from, to);
            from = to;
            if vertices[top as usize].y > vertices[bottom as usize].y {
                core::mem::swap(&mut top, &mut bottom);
            }
            let first = first_centre(vertices[top as usize].y).max(first_row);
            let end = first_centre(vertices[bottom as usize].y).min(end_row);
            if first < end {
                visit(
                    (first - first_row) as usize,
                    TableEdge {
                        polygon: number,
                        corner,
                        top,
                        bottom,
                    },
                );
            }
        }
    }
}
