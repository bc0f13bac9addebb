//! Polygons of any shape, and attributes of any kind: the edge table's way, within one band.

use crate::frame::Frame;
use crate::number::Scalar;
use crate::raster::active::{ActiveEdge, order, span, start};
use crate::raster::depth::SampleDepth;
use crate::raster::edge::first_centre;
use crate::raster::edge_table::TableEdge;
use crate::walk::Attribute;
use alloc::vec::Vec;
use core::ops::Range;

/// A run of pixels: scanline, pixels, depth at the first one and its growth, attribute.
pub(super) type Found<'a, S> = dyn FnMut(usize, Range<usize>, [f32; 2], S) + 'a;

/// The edges of one polygon that are still to come, and those that cross the current scanline.
pub(super) struct Edges<E> {
    waiting: Vec<(i32, ActiveEdge<E>)>,
    active: Vec<ActiveEdge<E>>,
}

impl<E> Default for Edges<E> {
    fn default() -> Self {
        Edges {
            waiting: Vec::new(),
            active: Vec::new(),
        }
    }
}

impl<E: Copy> Edges<E> {
    /// Gives the runs of polygon `number` on the scanlines `band`, from the top down. Compiled once for each kind of
    /// attribute, not for each shader.
    #[inline(never)]
    pub fn runs<A: Attribute<f32, Edge = E>>(
        &mut self,
        frame: &Frame,
        attributes: &[A],
        band: &Range<usize>,
        number: u32,
        found: &mut Found<'_, A::Span>,
    ) {
        self.enter(frame, attributes, band, number);
        let face = frame.polygon_normal(&frame.polygons()[number as usize]);
        let Some(mut row) = self.waiting.last().map(|(first, _)| *first) else {
            return;
        };
        loop {
            while let Some((_, edge)) = self.waiting.pop_if(|(first, _)| *first <= row) {
                self.active.push(edge);
            }
            order(&mut self.active);
            for pair in self.active.chunks_exact(2) {
                let [left, right] = pair else { continue };
                let Some(span) = span(left, right, 0, frame.width() as u32) else {
                    continue;
                };
                let (from, to) = (A::at(&left.attribute), A::at(&right.attribute));
                let attribute = A::span(Scalar, face, from, to, span.t0, span.dt);
                let pixels = span.start as usize..span.end as usize;
                found(
                    row as usize,
                    pixels,
                    [span.depth, span.depth_step],
                    attribute,
                );
            }
            row += 1;
            self.active.retain_mut(|edge| {
                edge.advance::<Scalar, A>();
                edge.end > row
            });
            if row >= band.end as i32 || (self.active.is_empty() && self.waiting.is_empty()) {
                return;
            }
        }
    }

    /// Starts the edges of polygon `number` that cross scanlines of `band`; those that begin first stand last.
    fn enter<A: Attribute<f32, Edge = E>>(
        &mut self,
        frame: &Frame,
        attributes: &[A],
        band: &Range<usize>,
        number: u32,
    ) {
        self.active.clear();
        self.waiting.clear();
        let depth = SampleDepth::new(frame);
        let corners = frame.corners(&frame.polygons()[number as usize]);
        let y = |v: u32| frame.vertices()[v as usize].y;
        let mut previous = corners[corners.len() - 1];
        for (i, &next) in corners.iter().enumerate() {
            let corner = if i == 0 { corners.len() - 1 } else { i - 1 } as u32;
            let (mut top, mut bottom) = (previous, next);
            previous = next;
            if y(top) > y(bottom) {
                core::mem::swap(&mut top, &mut bottom);
            }
            let first = first_centre(y(top)).max(band.start as i32);
            if first < first_centre(y(bottom)).min(band.end as i32) {
                let edge = TableEdge {
                    polygon: number,
                    corner,
                    top,
                    bottom,
                };
                self.waiting.push((
                    first,
                    start(Scalar, frame, &depth, attributes, &edge, first),
                ));
            }
        }
        self.waiting
            .sort_by_key(|(first, _)| core::cmp::Reverse(*first));
    }
}
