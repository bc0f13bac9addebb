//! The active edges: those that cross the current scanline, with the varyings that are interpolated along them.

use super::edge::{EdgeCrossing, first_centre};
use super::edge_table::TableEdge;
use crate::frame::{Frame, ScreenVertex, SubPixel};
use crate::number::vec3;
use crate::raster::depth::SampleDepth;
use crate::raster::setup::{Per, Varyings, unit};
use crate::shading::increments::{GreatCircle, Walk};
use crate::shading::ramp;
use alloc::vec::Vec;
use core::cmp::Ordering;

/// An edge on its way down the picture: its crossing, and depth and varyings, each stepped from scanline to scanline.
#[derive(Clone, Copy, Debug)]
struct ActiveEdge {
    polygon: u32,
    corner: u32,
    /// The first scanline that it does not cross.
    end: i32,
    /// The crossing with this scanline.
    crossing: EdgeCrossing,
    /// Depth here, and its growth.
    depth: [f32; 2],
    /// A few varyings here, and their growth.
    at: [f32; FEW],
    step: [f32; FEW],
    /// The place of more of them in [`EdgeVaryings`].
    slot: u32,
}

impl ActiveEdge {
    /// Steps to the next scanline, but for varyings in a slot.
    #[inline(always)]
    fn advance(&mut self) {
        self.crossing.advance();
        self.depth[0] += self.depth[1]; // 3.3
        for i in 0..FEW {
            self.at[i] += self.step[i]; // 3.6, 4.2
        }
    }
}

/// Varyings that are kept with the edge: a normal or a colour, and a weight.
const FEW: usize = 4;

/// A span: the pixels of one polygon between two of its edges on one scanline, clipped to the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PolygonSpan {
    /// The polygon.
    pub polygon: u32,
    /// The left edge, an index into the active edges; the right one follows it.
    left: u32,
    /// The first pixel.
    pub start: u32,
    /// The pixel after the last one.
    pub end: u32,
    /// The parameter between the edges at the centre of the first pixel.
    t0: f32,
    /// The step of the parameter from pixel to pixel: `Δt = 1 / (x_2 − x_1)` (L21 3).
    dt: f32,
    /// The number that depth is computed from ([`SampleDepth`]), at the centre of the first pixel.
    pub depth: f32,
    /// The step of that number from pixel to pixel.
    pub depth_step: f32,
}

/// The varyings of edges on their way down, where they are great circles or more than [`FEW`] numbers.
#[derive(Debug)]
struct EdgeVaryings {
    /// Numbers of a varying, rounded up to whole groups of four, which are added at once; 0 where they are kept with the edge.
    padded: usize,
    /// A slot per edge: the numbers here, then their steps.
    values: Vec<f32>,
    circles: Vec<GreatCircle<f32>>,
    free: Vec<u32>,
}

impl EdgeVaryings {
    /// Starts an edge between two varyings at the parameter `t0`, with steps of `dt`. Returns its slot.
    fn enter(&mut self, [a, b]: [&[f32]; 2], t0: f32, dt: f32) -> u32 {
        let size = 2 * self.padded;
        let slot = self.free.pop().unwrap_or_else(|| {
            self.values.resize(self.values.len() + size, 0.0);
            (self.values.len() / size) as u32 - 1
        });
        let (at, step) = self.values[slot as usize * size..][..size].split_at_mut(self.padded);
        for (((at, step), a), b) in at.iter_mut().zip(step).zip(a).zip(b) {
            [*at, *step] = ramp(*a, *b, t0, dt);
        }
        slot
    }

    fn enter_circle(&mut self, circle: GreatCircle<f32>) -> u32 {
        let slot = self.free.pop().unwrap_or(self.circles.len() as u32);
        match self.circles.get_mut(slot as usize) {
            Some(place) => *place = circle,
            None => self.circles.push(circle),
        }
        slot
    }

    /// Steps an edge to the next scanline.
    fn advance(&mut self, slot: u32) {
        if let Some(circle) = self.circles.get_mut(slot as usize) {
            circle.sines.next(); // 4.9–4.12
            return;
        }
        let size = 2 * self.padded;
        let (at, step) = self.values[slot as usize * size..][..size].split_at_mut(self.padded);
        let (at, step) = (at.as_chunks_mut::<4>().0, step.as_chunks::<4>().0);
        for (at, step) in at.iter_mut().zip(step) {
            for i in 0..4 {
                at[i] += step[i]; // 3.6, 4.2
            }
        }
    }

    /// Returns the numbers of a slot.
    fn numbers(&self, slot: u32) -> &[f32] {
        &self.values[slot as usize * 2 * self.padded..][..self.padded]
    }
}

/// The edges that cross the current scanline, ordered by polygon and within a polygon from left to right.
#[derive(Debug)]
pub(crate) struct ActiveEdges<'a> {
    frame: &'a Frame,
    varyings: &'a Varyings<'a>,
    depth: SampleDepth,
    edges: Vec<ActiveEdge>,
    merged: Vec<ActiveEdge>,
    more: EdgeVaryings,
    /// True if edges carry anything.
    is_walked: bool,
    /// True if edges carry it in slots.
    has_slots: bool,
}

impl<'a> ActiveEdges<'a> {
    pub fn new(frame: &'a Frame, varyings: &'a Varyings<'a>) -> Self {
        let is_walked = varyings.count > 0 && !matches!(varyings.per, Per::Polygon);
        let is_many = is_walked && varyings.count > FEW && !varyings.great_circle;
        ActiveEdges {
            frame,
            varyings,
            depth: SampleDepth::new(frame),
            edges: Vec::new(),
            merged: Vec::new(),
            more: EdgeVaryings {
                padded: usize::from(is_many) * varyings.count.next_multiple_of(4),
                values: Vec::new(),
                circles: Vec::new(),
                free: Vec::new(),
            },
            is_walked,
            has_slots: is_many || varyings.great_circle,
        }
    }

    /// True if no edge crosses this scanline.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// Goes to scanline `row`: steps the edges that cross it, drops those that end before its centre, and takes in the `new` ones
    /// that begin there, in the order of their polygons.
    ///
    /// From one list to the other: an edge that was just stepped is not read again before it is used.
    // Without `always` it depends on the rest of the crate whether this is inlined: 7 % of the teapot's frame.
    #[inline(always)]
    pub fn next<'e>(&mut self, new: impl Iterator<Item = &'e TableEdge>, row: i32) {
        let mut new = new.peekable();
        self.merged.clear();
        self.merged.reserve(self.edges.len());
        for i in 0..self.edges.len() {
            let mut edge = self.edges[i];
            while let Some(begins) = new.next_if(|begins| begins.polygon < edge.polygon) {
                self.start_edge(begins, row);
            }
            if edge.end <= row {
                if self.has_slots {
                    self.more.free.push(edge.slot);
                }
                continue;
            }
            edge.advance();
            if self.has_slots {
                self.more.advance(edge.slot);
            }
            self.merged.push(edge);
        }
        for begins in new {
            self.start_edge(begins, row);
        }
        core::mem::swap(&mut self.edges, &mut self.merged);
    }

    /// Appends an edge at scanline `row`, with the sub-pixel start: the parameter there is that of the scanline's centre.
    #[inline(always)]
    fn start_edge(&mut self, edge: &TableEdge, row: i32) {
        let vertices = self.frame.vertices();
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
        let (mut at, mut step, mut slot) = ([0.0; FEW], [0.0; FEW], 0);
        if self.is_walked {
            let [a, b] = self.ends(edge);
            if let (&[ax, ay, az], &[bx, by, bz]) = (a, b)
                && !self.has_slots
            {
                // The fast path: three numbers, without a loop.
                [at[0], step[0]] = ramp(ax, bx, t0, dt); // 3.5, 4.1
                [at[1], step[1]] = ramp(ay, by, t0, dt);
                [at[2], step[2]] = ramp(az, bz, t0, dt);
            } else {
                slot = self.start_slowly(edge, [t0, dt], [&mut at, &mut step]);
            }
        }
        let from = self.depth.of_corner(self.frame, top);
        let to = self.depth.of_corner(self.frame, bottom);
        self.merged.push(ActiveEdge {
            polygon: edge.polygon,
            corner: edge.corner,
            end: first_centre(bottom.y),
            crossing: EdgeCrossing::new(place(top), place(bottom), row),
            depth: ramp(from, to, t0, dt), // 3.4
            at,
            step,
            slot,
        });
    }

    /// Starts the varyings of an edge unless they are three numbers. Returns their slot.
    #[inline(never)]
    fn start_slowly(
        &mut self,
        edge: &TableEdge,
        [t0, dt]: [f32; 2],
        [at, step]: [&mut [f32; FEW]; 2],
    ) -> u32 {
        let ends = self.ends(edge);
        if self.varyings.great_circle {
            let polygon = &self.frame.polygons()[edge.polygon as usize];
            let face = self.frame.polygon_normal(polygon);
            let normals = [unit(ends[0]), unit(ends[1])];
            let circle = GreatCircle::new(vec3(face), normals, t0, dt);
            return self.more.enter_circle(circle);
        }
        if self.has_slots {
            return self.more.enter(ends, t0, dt);
        }
        for (((at, step), a), b) in at.iter_mut().zip(step).zip(ends[0]).zip(ends[1]) {
            [*at, *step] = ramp(*a, *b, t0, dt);
        }
        0
    }

    /// Returns the varyings of the upper and the lower end of an edge.
    #[inline(always)]
    fn ends(&self, edge: &TableEdge) -> [&'a [f32]; 2] {
        let (mut corners, polygon) = ([0; 2], edge.polygon);
        if let Per::Corner(_) = self.varyings.per {
            let polygon = &self.frame.polygons()[polygon as usize];
            corners = [edge.corner, (edge.corner + 1) % polygon.count];
            if self.frame.corners(polygon)[edge.corner as usize] != edge.top {
                corners.reverse();
            }
        }
        [
            self.varyings.of_corner(polygon, corners[0], edge.top),
            self.varyings.of_corner(polygon, corners[1], edge.bottom),
        ]
    }

    /// Steps the edges to scanline `row` where they are, if none of them ends before its centre. Returns false if one does.
    #[cfg(feature = "simd")]
    #[inline(always)]
    pub fn step(&mut self, row: i32) -> bool {
        if self.edges.iter().any(|edge| edge.end <= row) {
            return false;
        }
        for edge in &mut self.edges {
            edge.advance();
            if self.has_slots {
                self.more.advance(edge.slot);
            }
        }
        true
    }

    /// Forgets all edges.
    #[cfg(feature = "simd")]
    pub fn clear(&mut self) {
        let slots = self.edges.drain(..).map(|edge| edge.slot);
        if self.has_slots {
            self.more.free.extend(slots);
        }
    }

    /// Puts the edges of each polygon in order and calls `visit` with their spans, polygon by polygon.
    #[inline(always)]
    pub fn spans(&mut self, width: u32, mut visit: impl FnMut(&Self, PolygonSpan)) {
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
                let pair = [&self.edges[left], &self.edges[left + 1]];
                if let Some(span) = span(pair, left as u32, width) {
                    visit(self, span);
                }
            }
            first = end;
        }
    }

    /// Appends the start of a run, `skipped` pixels into a span: see [`start_len`](crate::shading::start_len).
    #[inline(always)]
    pub fn start(&self, span: &PolygonSpan, skipped: u32, to: &mut Vec<f32>) {
        // A run that begins inside its span starts at its own first pixel's parameter.
        let t0 = span.t0 + skipped as f32 * span.dt;
        let left = &self.edges[span.left as usize];
        let right = &self.edges[span.left as usize + 1];
        if self.varyings.count == 3 && self.is_walked && !self.has_slots {
            // The fast path: three numbers, without a loop.
            let [x, dx] = ramp(left.at[0], right.at[0], t0, span.dt); // 3.5, 4.1
            let [y, dy] = ramp(left.at[1], right.at[1], t0, span.dt);
            let [z, dz] = ramp(left.at[2], right.at[2], t0, span.dt);
            to.extend_from_slice(&[x, y, z, dx, dy, dz]);
            return;
        }
        if self.varyings.great_circle {
            let circles = &self.more.circles;
            to.extend(circles[left.slot as usize].normal().array()); // 4.8
            to.extend(circles[right.slot as usize].normal().array());
            to.extend([t0, span.dt]);
            let polygon = &self.frame.polygons()[span.polygon as usize];
            to.extend(self.frame.polygon_normal(polygon));
            return;
        }
        let (count, first) = (self.varyings.count, to.len());
        to.resize(first + 2 * count, 0.0);
        let (at, step) = to[first..].split_at_mut(count);
        if let Some(constant) = self.varyings.of_polygon(span.polygon) {
            at.copy_from_slice(constant);
            return;
        }
        let ends = match self.has_slots {
            true => [self.more.numbers(left.slot), self.more.numbers(right.slot)],
            false => [&left.at[..], &right.at[..]],
        };
        for (((at, step), a), b) in at.iter_mut().zip(step).zip(ends[0]).zip(ends[1]) {
            [*at, *step] = ramp(*a, *b, t0, span.dt);
        }
    }
}

/// Puts the edges of a polygon in order, by insertion: crossings change places only where edges cross each other. Ties keep the
/// order of corners, so that the result does not depend on the past.
fn order(edges: &mut [ActiveEdge]) {
    for i in 1..edges.len() {
        let mut at = i;
        while at > 0 && is_before(&edges[at], &edges[at - 1]) {
            edges.swap(at, at - 1);
            at -= 1;
        }
    }
}

/// True if `a` lies left of `b`.
fn is_before(a: &ActiveEdge, b: &ActiveEdge) -> bool {
    let order = a.crossing.compare(&b.crossing);
    order.then(a.corner.cmp(&b.corner)) == Ordering::Less
}

/// Returns the span between two edges, of which the left one has number `number`, if it covers a pixel.
#[inline(always)]
fn span([left, right]: [&ActiveEdge; 2], number: u32, width: u32) -> Option<PolygonSpan> {
    let (from, to) = (left.crossing.pixel(), right.crossing.pixel());
    let (start, end) = (from.max(0), to.min(width as i32));
    if start >= end {
        return None;
    }
    let offset = left.crossing.offset();
    // x_2 − x_1 between the crossings themselves, over 0 because a pixel centre lies between them.
    let dt = 1.0 / ((to - from) as f32 + (offset - right.crossing.offset())); // Δt = 1 / (x_2 − x_1)
    let t0 = ((start - from) as f32 + offset) * dt;
    let [depth, depth_step] = ramp(left.depth[0], right.depth[0], t0, dt);
    Some(PolygonSpan {
        polygon: left.polygon,
        left: number,
        start: start as u32,
        end: end as u32,
        t0,
        dt,
        depth,
        depth_step,
    })
}
