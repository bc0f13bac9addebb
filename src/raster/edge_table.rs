//! The edge table: all edges of a frame, by the scanline on which they begin.

use super::edge::first_centre;
use crate::frame::Frame;
use alloc::vec;
use alloc::vec::Vec;

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
    starts: Vec<u32>,
    edges: Vec<TableEdge>,
}

impl EdgeTable {
    /// Returns the table of a frame: a counting sort, linear in edges and scanlines.
    pub fn new(frame: &Frame) -> Self {
        let count = frame.height();
        let mut starts = vec![0u32; count + 1];
        for_each_edge(frame, |row, _| starts[row + 1] += 1);
        for row in 0..count {
            starts[row + 1] += starts[row];
        }
        let mut edges = vec![TableEdge::default(); starts[count] as usize];
        let mut next = starts.clone();
        for_each_edge(frame, |row, edge| {
            edges[next[row] as usize] = edge;
            next[row] += 1;
        });
        EdgeTable { starts, edges }
    }

    /// The edges that begin on scanline `row`, in the order of their polygons; in the first bucket also those that began
    /// above.
    pub fn bucket(&self, row: usize) -> &[TableEdge] {
        &self.edges[self.starts[row] as usize..self.starts[row + 1] as usize]
    }
}

fn for_each_edge(frame: &Frame, mut visit: impl FnMut(usize, TableEdge)) {
    let vertices = frame.vertices();
    for (number, polygon) in (0..).zip(frame.polygons()) {
        let corners = frame.corners(polygon);
        let mut from = corners[corners.len() - 1];
        for (i, &to) in corners.iter().enumerate() {
            let corner = if i == 0 { corners.len() - 1 } else { i - 1 } as u32;
            let (mut top, mut bottom) = (from, to);
            from = to;
            if vertices[top as usize].y > vertices[bottom as usize].y {
                core::mem::swap(&mut top, &mut bottom);
            }
            let first = first_centre(vertices[top as usize].y).max(0);
            let end = first_centre(vertices[bottom as usize].y).min(frame.height() as i32);
            if first < end {
                visit(
                    first as usize,
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
