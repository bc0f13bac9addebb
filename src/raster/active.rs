//! The active edges: those that cross the current scanline, with what is walked along them.

use super::depth::SampleDepth;
use super::edge::{Crossing, first_centre};
use super::edge_table::{EdgeTable, TableEdge};
use crate::frame::{Frame, ScreenVertex, SubPixel};
use crate::number::Machine;
use crate::walk::{Attribute, Ramp};
use alloc::vec::Vec;
use core::cmp::Ordering;

/// An edge on its way down the picture: its crossing, depth and attribute, each stepped from scanline to scanline.
#[derive(Clone, Copy, Debug)]
pub struct ActiveEdge<E> {
    /// The polygon.
    pub polygon: u32,
    corner: u32,
    /// The first scanline that it does not cross.
    pub end: i32,
    /// Where it crosses this scanline.
    pub crossing: Crossing,
    depth: Ramp<f32>,
    /// The attribute's walk.
    pub attribute: E,
}

/// A span: the pixels of one polygon between two of its edges on one scanline, clipped to the picture.
#[derive(Clone, Copy, Debug)]
pub struct Span {
    /// The polygon.
    pub polygon: u32,
    /// The left edge: an index into the active edges.
    pub left: u32,
    /// The right edge.
    pub right: u32,
    /// The first pixel.
    pub start: u32,
    /// The pixel after the last one.
    pub end: u32,
    /// The parameter between the edges at the centre of the first pixel.
    pub t0: f32,
    /// Its step from pixel to pixel: `Δt = 1 / (x_2 − x_1)` (L21 3).
    pub dt: f32,
    /// What depth is made of ([`SampleDepth`]) at the centre of the first pixel.
    pub depth: f32,
    /// Its step from pixel to pixel.
    pub depth_step: f32,
}

/// The edges that cross the current scanline, ordered by polygon and within a polygon from left to right.
#[derive(Debug)]
pub struct ActiveEdges<E> {
    depth: SampleDepth,
    edges: Vec<ActiveEdge<E>>,
    merged: Vec<ActiveEdge<E>>,
}

impl<E: Copy> ActiveEdges<E> {
    pub fn new(depth: SampleDepth) -> Self {
        ActiveEdges {
            depth,
            edges: Vec::new(),
            merged: Vec::new(),
        }
    }

    /// The edges, in order.
    pub fn edges(&self) -> &[ActiveEdge<E>] {
        &self.edges
    }

    /// Takes in the edges that begin on scanline `row`.
    pub fn enter<M, A>(
        &mut self,
        m: M,
        frame: &Frame,
        table: &EdgeTable,
        attributes: &[A],
        row: usize,
    ) where
        M: Machine,
        A: Attribute<M::One, Edge = E>,
    {
        let new = table.bucket(row);
        if new.is_empty() {
            return;
        }
        self.merged.clear();
        self.merged.reserve(self.edges.len() + new.len());
        let mut old = self.edges.iter().peekable();
        for edge in new {
            while let Some(active) = old.next_if(|active| active.polygon <= edge.polygon) {
                self.merged.push(*active);
            }
            self.merged
                .push(start(m, frame, &self.depth, attributes, edge, row as i32));
        }
        self.merged.extend(old);
        core::mem::swap(&mut self.edges, &mut self.merged);
    }

    /// Puts the edges of each polygon in order and gives their spans, polygon by polygon.
    pub fn spans(&mut self, width: u32, mut visit: impl FnMut(Span)) {
        let mut first = 0;
        while first < self.edges.len() {
            let polygon = self.edges[first].polygon;
            let mut end = first + 1;
            while end < self.edges.len() && self.edges[end].polygon == polygon {
                end += 1;
            }
            order(&mut self.edges[first..end]);
            // A closed polygon crosses a scanline an even number of times.
            for left in (first..end - 1).step_by(2) {
                if let Some(span) =
                    span(&self.edges[left], &self.edges[left + 1], left as u32, width)
                {
                    visit(span);
                }
            }
            first = end;
        }
    }

    /// Steps every edge to scanline `row` and drops those that end before its centre.
    pub fn advance<M: Machine, A: Attribute<M::One, Edge = E>>(&mut self, row: usize) {
        self.edges.retain_mut(|edge| {
            if edge.end <= row as i32 {
                return false;
            }
            edge.advance::<M, A>();
            true
        });
    }
}

impl<E: Copy> ActiveEdge<E> {
    /// To the next scanline.
    #[inline(always)]
    pub fn advance<M: Machine, A: Attribute<M::One, Edge = E>>(&mut self) {
        self.crossing.advance();
        self.depth.at += self.depth.step; // 3.3
        A::advance(&mut self.attribute);
    }
}

/// Insertion sort: crossings change places only where edges of one polygon cross each other. Ties keep the order of
/// corners, so that the result does not depend on the past.
pub(super) fn order<E: Copy>(edges: &mut [ActiveEdge<E>]) {
    for i in 1..edges.len() {
        let mut at = i;
        while at > 0 && before(&edges[at], &edges[at - 1]) {
            edges.swap(at, at - 1);
            at -= 1;
        }
    }
}

fn before<E>(a: &ActiveEdge<E>, b: &ActiveEdge<E>) -> bool {
    match a.crossing.compare(&b.crossing) {
        Ordering::Less => true,
        Ordering::Equal => a.corner < b.corner,
        Ordering::Greater => false,
    }
}

/// An edge at scanline `row`, with the sub-pixel start: the parameter there is that of the scanline's centre.
#[inline(always)]
pub(super) fn start<M, A>(
    m: M,
    frame: &Frame,
    depth: &SampleDepth,
    attributes: &[A],
    edge: &TableEdge,
    row: i32,
) -> ActiveEdge<A::Edge>
where
    M: Machine,
    A: Attribute<M::One>,
{
    let vertices = frame.vertices();
    let (top, bottom) = (
        &vertices[edge.top as usize],
        &vertices[edge.bottom as usize],
    );
    let place = |v: &ScreenVertex| [v.x, v.y];
    // Exact: both differences have at most 24 bits.
    let height = (bottom.y - top.y).to_bits() as f32;
    let centre = SubPixel::from_num(row) + SubPixel::from_bits(1 << (SubPixel::FRAC_NBITS - 1));
    let t0 = (centre - top.y).to_bits() as f32 / height;
    let dt = (1 << SubPixel::FRAC_NBITS) as f32 / height; // Δt = 1 / (y_2 − y_1)
    let from = depth.of_corner(frame, top);
    let rise = depth.of_corner(frame, bottom) - from;
    let face = m.three(frame.polygon_normal(&frame.polygons()[edge.polygon as usize]));
    let (a, b) = (
        attributes[edge.top as usize],
        attributes[edge.bottom as usize],
    );
    ActiveEdge {
        polygon: edge.polygon,
        corner: edge.corner,
        end: first_centre(bottom.y),
        crossing: Crossing::new(place(top), place(bottom), row),
        depth: Ramp {
            at: from + rise * t0,
            step: rise * dt,
        }, // 3.4
        attribute: A::edge(m, face, a, b, m.one(t0), m.one(dt)),
    }
}

#[inline(always)]
pub(super) fn span<E>(
    left: &ActiveEdge<E>,
    right: &ActiveEdge<E>,
    number: u32,
    width: u32,
) -> Option<Span> {
    let (from, to) = (left.crossing.pixel(), right.crossing.pixel());
    let (start, end) = (from.max(0), to.min(width as i32));
    if start >= end {
        return None;
    }
    let offset = left.crossing.offset();
    // x_2 − x_1 between the crossings themselves, over 0 because a pixel centre lies between them.
    let dt = 1.0 / ((to - from) as f32 + (offset - right.crossing.offset())); // Δt = 1 / (x_2 − x_1)
    let t0 = ((start - from) as f32 + offset) * dt;
    let rise = right.depth.at - left.depth.at;
    Some(Span {
        polygon: left.polygon,
        left: number,
        right: number + 1,
        start: start as u32,
        end: end as u32,
        t0,
        dt,
        depth: left.depth.at + rise * t0,
        depth_step: rise * dt,
    })
}
