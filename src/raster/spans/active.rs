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
use core::mem::swap;

/// Four varyings, and their growth from scanline to scanline: as many as are stepped at once.
type Four = [[f32; 4]; 2];

/// Sets up four varyings between two ends: see [`ramp`].
#[inline(always)]
fn ramps(a: [f32; 4], b: [f32; 4], t0: f32, dt: f32) -> Four {
    let mut ramps = [[0.0; 4]; 2];
    for i in 0..4 {
        [ramps[0][i], ramps[1][i]] = ramp(a[i], b[i], t0, dt); // 3.5, 4.1
    }
    ramps
}

/// Returns four varyings on the next scanline.
#[inline(always)]
fn stepped([at, step]: Four) -> Four {
    let mut next = at;
    for i in 0..4 {
        next[i] += step[i]; // 3.6, 4.2
    }
    [next, step]
}

/// Returns the first four numbers, and 0 for those that are missing.
#[inline(always)]
fn four(numbers: &[f32]) -> [f32; 4] {
    match *numbers {
        [a, b, c] => [a, b, c, 0.0],
        [a, b, c, d, ..] => [a, b, c, d],
        [a, b] => [a, b, 0.0, 0.0],
        [a] => [a, 0.0, 0.0, 0.0],
        [] => [0.0; 4],
    }
}

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
    /// The first four varyings: a normal or a colour, and a weight.
    varyings: Four,
    /// The place of the others in [`EdgeList::fours`], or of the great circle in [`EdgeList::circles`].
    slot: u32,
}

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

/// The edges that cross a scanline, with the varyings that an [`ActiveEdge`] has no room for.
#[derive(Debug, Default)]
struct EdgeList {
    edges: Vec<ActiveEdge>,
    /// The varyings after the first four, edge by edge.
    fours: Vec<Four>,
    circles: Vec<GreatCircle<f32>>,
}

impl EdgeList {
    /// Empties the list.
    fn clear(&mut self) {
        self.edges.clear();
        self.fours.clear();
        self.circles.clear();
    }

    /// Steps the varyings at a slot of the list `before`, `more` fours, to this scanline. Returns their new place.
    fn advance(&mut self, before: &EdgeList, slot: u32, more: usize) -> u32 {
        if let Some(circle) = before.circles.get(slot as usize) {
            let mut circle = *circle;
            circle.sines.next(); // 4.9–4.12
            self.circles.push(circle);
            return self.circles.len() as u32 - 1;
        }
        let place = self.fours.len() as u32;
        for varyings in &before.fours[slot as usize..][..more] {
            self.fours.push(stepped(*varyings));
        }
        place
    }
}

/// The edges that cross the current scanline, ordered by polygon and within a polygon from left to right.
#[derive(Debug)]
pub(crate) struct ActiveEdges<'a> {
    frame: &'a Frame,
    varyings: &'a Varyings<'a>,
    depth: SampleDepth,
    here: EdgeList,
    /// The list of the scanline before.
    before: EdgeList,
    /// True if edges carry anything.
    is_walked: bool,
    /// Fours of an edge after the first.
    more: usize,
}

impl<'a> ActiveEdges<'a> {
    pub fn new(frame: &'a Frame, varyings: &'a Varyings<'a>) -> Self {
        let is_walked = varyings.count > 0 && !matches!(varyings.per, Per::Polygon);
        let is_linear = is_walked && !varyings.great_circle;
        ActiveEdges {
            frame,
            varyings,
            depth: SampleDepth::new(frame),
            here: EdgeList::default(),
            before: EdgeList::default(),
            is_walked,
            more: usize::from(is_linear) * (varyings.count.div_ceil(4).saturating_sub(1)),
        }
    }

    /// True if no edge crosses this scanline.
    pub fn is_empty(&self) -> bool {
        self.here.edges.is_empty()
    }

    /// Goes to scanline `row`: steps the edges that cross it, drops those that end before its centre, and takes in the `new` ones
    /// that begin there, in the order of their polygons.
    ///
    /// From one list to the other: an edge that was just stepped is not read again before it is used.
    pub fn next<'e>(&mut self, new: impl Iterator<Item = &'e TableEdge>, row: i32) {
        let mut new = new.peekable();
        swap(&mut self.here, &mut self.before);
        self.here.clear();
        self.here.edges.reserve(self.before.edges.len());
        for i in 0..self.before.edges.len() {
            let mut edge = self.before.edges[i];
            while let Some(begins) = new.next_if(|begins| begins.polygon < edge.polygon) {
                self.start_edge(begins, row);
            }
            if edge.end <= row {
                continue;
            }
            edge.crossing.advance();
            edge.depth[0] += edge.depth[1]; // 3.3
            edge.varyings = stepped(edge.varyings);
            if self.more > 0 || self.varyings.great_circle {
                edge.slot = self.here.advance(&self.before, edge.slot, self.more);
            }
            self.here.edges.push(edge);
        }
        for begins in new {
            self.start_edge(begins, row);
        }
    }

    /// Appends an edge at scanline `row`, with the sub-pixel start: the parameter there is that of the scanline's centre.
    #[inline(always)]
    fn start_edge(&mut self, edge: &TableEdge, row: i32) {
        let vertices = self.frame.vertices();
        let [top, bottom] = [edge.top, edge.bottom].map(|v| &vertices[v as usize]);
        let place = |v: &ScreenVertex| [v.x, v.y];
        // Exact: both differences have at most 24 bits.
        let height = (bottom.y - top.y).to_bits() as f32;
        let centre = SubPixel::from_num(row) + SubPixel::from_bits(1 << (SubPixel::FRAC_NBITS - 1));
        let t0 = (centre - top.y).to_bits() as f32 / height;
        let dt = (1 << SubPixel::FRAC_NBITS) as f32 / height; // Δt = 1 / (y_2 − y_1)
        let (mut varyings, mut slot) = ([[0.0; 4]; 2], 0);
        if self.is_walked {
            let [a, b] = self.ends(edge);
            varyings = ramps(four(a), four(b), t0, dt);
            if self.more > 0 || self.varyings.great_circle {
                slot = self.start_slot(edge.polygon, [a, b], t0, dt);
            }
        }
        let from = self.depth.of_corner(self.frame, top);
        let to = self.depth.of_corner(self.frame, bottom);
        self.here.edges.push(ActiveEdge {
            polygon: edge.polygon,
            corner: edge.corner,
            end: first_centre(bottom.y),
            crossing: EdgeCrossing::new(place(top), place(bottom), row),
            depth: ramp(from, to, t0, dt), // 3.4
            varyings,
            slot,
        });
    }

    /// Starts the varyings that an [`ActiveEdge`] has no room for. Returns their place.
    #[inline(never)]
    fn start_slot(&mut self, polygon: u32, [a, b]: [&[f32]; 2], t0: f32, dt: f32) -> u32 {
        if self.varyings.great_circle {
            let normals = [unit(a), unit(b)];
            let circle = GreatCircle::new(vec3(self.face(polygon)), normals, t0, dt);
            self.here.circles.push(circle);
            return self.here.circles.len() as u32 - 1;
        }
        let place = self.here.fours.len() as u32;
        for (a, b) in a[4..].chunks(4).zip(b[4..].chunks(4)) {
            self.here.fours.push(ramps(four(a), four(b), t0, dt));
        }
        place
    }

    /// Returns the unit normal of a polygon.
    fn face(&self, polygon: u32) -> [f32; 3] {
        let polygon = &self.frame.polygons()[polygon as usize];
        self.frame.polygon_normal(polygon)
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

    /// Forgets all edges.
    #[cfg(feature = "simd")]
    pub fn clear(&mut self) {
        self.here.clear();
    }

    /// Puts the edges of each polygon in order and calls `visit` with their spans, polygon by polygon.
    pub fn spans(&mut self, width: u32, mut visit: impl FnMut(&Self, PolygonSpan)) {
        let mut first = 0;
        while first < self.here.edges.len() {
            let edges = &mut self.here.edges;
            let polygon = edges[first].polygon;
            let mut end = first + 1;
            while end < edges.len() && edges[end].polygon == polygon {
                end += 1;
            }
            order(&mut edges[first..end]);
            // A closed polygon crosses a scanline an even number of times.
            for left in (first..end - 1).step_by(2) {
                let pair = [&self.here.edges[left], &self.here.edges[left + 1]];
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
        let left = &self.here.edges[span.left as usize];
        let right = &self.here.edges[span.left as usize + 1];
        if self.varyings.great_circle {
            let circles = &self.here.circles;
            to.extend(circles[left.slot as usize].normal().array()); // 4.8
            to.extend(circles[right.slot as usize].normal().array());
            to.extend([t0, span.dt]);
            to.extend(self.face(span.polygon));
            return;
        }
        let mut end = to.len() + self.varyings.count;
        if let Some(constant) = self.varyings.of_polygon(span.polygon) {
            to.extend_from_slice(constant);
            to.resize(end + self.varyings.count, 0.0);
            return;
        }
        let at = |edge: &ActiveEdge, four: usize| match four {
            0 => edge.varyings[0],
            _ => self.here.fours[edge.slot as usize + four - 1][0],
        };
        // Numbers, then their growth: in fours, of which the last one is cut off.
        for part in 0..2 {
            for four in 0..=self.more {
                let four = ramps(at(left, four), at(right, four), t0, span.dt); // 4.1
                to.extend_from_slice(&four[part]);
            }
            to.truncate(end);
            end += self.varyings.count;
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
