//! The active edges: the edges that cross the current scanline, with the varyings that are
//! interpolated along them.

use super::edge::{EdgeCrossing, first_centre};
use super::edge_table::TableEdge;
use crate::frame::{Frame, ScreenVertex, SubPixel};
use crate::number::{Vec3, vec3};
use crate::raster::depth::SampleDepth;
use crate::raster::setup::{Per, Varyings, unit};
use crate::shading::walks::{GreatCircle, Walk};
use crate::shading::{GROUP, Run, RunList, SpanPlace, Starts, UniformsIndex, ramp};
use alloc::vec::Vec;
use core::cmp::Ordering;
use core::ops::Range;

/// An edge on its way down the picture. Its crossing, depth and varyings step from scanline to
/// scanline.
#[derive(Clone, Copy, Debug)]
struct ActiveEdge {
    polygon: u32,
    corner: u32,
    /// The first scanline that it does not cross.
    end: i32,
    /// The crossing with the current scanline.
    crossing: EdgeCrossing,
    /// Depth here, and its growth per scanline.
    depth: [f32; 2],
    /// The first varyings. On a great circle they are the extras, which follow the normal.
    varyings: Group,
    /// The index in [`EdgeVaryings`] of the other varyings, or of the great circle.
    slot: u32,
}

impl ActiveEdge {
    /// Steps to the next scanline. Varyings in a slot are stepped separately.
    #[inline(always)]
    fn advance(&mut self) {
        self.crossing.advance();
        self.depth[0] += self.depth[1]; // 3.3
        self.varyings.advance();
    }
}

/// An active edge as a trace reads it, between two scanlines.
#[cfg(feature = "io")]
pub(crate) struct EdgeState {
    pub polygon: u32,
    pub corner: u32,
    pub crossing: EdgeCrossing,
    /// Depth here, and its growth per scanline.
    pub depth: [f32; 2],
    /// The varyings here. On a great circle they begin with the normal.
    pub at: Vec<f32>,
    /// The growth of the varyings per scanline. A great circle's normal has none, so only its
    /// extras are listed.
    pub by: Vec<f32>,
    pub circle: Option<GreatCircle<f32>>,
}

/// Varyings here, and their growth per scanline. One group is stored in the edge itself.
#[derive(Clone, Copy, Debug, Default)]
struct Group {
    at: [f32; GROUP],
    step: [f32; GROUP],
}

impl Group {
    /// Returns varyings between two ends at the parameter `t0`, which grow by steps of `dt`.
    #[inline(always)]
    fn new([a, b]: [[f32; GROUP]; 2], [t0, dt]: [f32; 2]) -> Group {
        let mut group = Group::default();
        for i in 0..GROUP {
            [group.at[i], group.step[i]] = ramp(a[i], b[i], t0, dt); // 3.5, 4.1
        }
        group
    }

    #[inline(always)]
    fn advance(&mut self) {
        for i in 0..GROUP {
            self.at[i] += self.step[i]; // 3.6, 4.2
        }
    }
}

/// Returns the first values, and zeros for values that are missing.
#[inline(always)]
fn first_of(values: &[f32]) -> [f32; GROUP] {
    match *values {
        [x, y, z] => [x, y, z, 0.0],
        [x, y, z, w, ..] => [x, y, z, w],
        [x] => [x, 0.0, 0.0, 0.0],
        [x, y] => [x, y, 0.0, 0.0],
        [] => [0.0; GROUP],
    }
}

/// A span: the pixels of one polygon between two of its edges on one scanline, clipped to the
/// picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PolygonSpan {
    /// The polygon.
    pub polygon: u32,
    /// The left edge, an index into the active edges. The right edge follows it.
    pub left: u32,
    /// The first pixel.
    pub start: u32,
    /// The pixel after the last one.
    pub end: u32,
    /// The parameter from the left to the right edge, at the centre of the first pixel.
    pub t0: f32,
    /// The step of the parameter from pixel to pixel: `Δt = 1 / (x_2 − x_1)` (L21 3).
    pub dt: f32,
    /// The value that depth is computed from ([`SampleDepth`]), at the centre of the first pixel.
    pub depth: f32,
    /// The step of this value from pixel to pixel.
    pub depth_step: f32,
}

impl PolygonSpan {
    /// Returns the columns of its pixels.
    #[inline(always)]
    pub fn pixels(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// The varyings beyond the first group of edges on their way down, or their great circles.
#[derive(Debug)]
struct EdgeVaryings {
    /// How many groups an edge has here.
    groups: usize,
    /// The groups of all slots, slot after slot.
    values: Vec<Group>,
    circles: Vec<GreatCircle<f32>>,
    free: Vec<u32>,
}

impl EdgeVaryings {
    /// Starts an edge between two varyings, and returns its slot.
    #[inline(always)]
    fn enter(&mut self, [a, b]: [&[f32]; 2], parameter: [f32; 2]) -> u32 {
        let slot = self.free.pop().unwrap_or_else(|| {
            self.values
                .resize(self.values.len() + self.groups, Group::default());
            (self.values.len() / self.groups) as u32 - 1
        });
        let groups = &mut self.values[slot as usize * self.groups..][..self.groups];
        for (group, (a, b)) in groups.iter_mut().zip(a.chunks(GROUP).zip(b.chunks(GROUP))) {
            *group = Group::new([first_of(a), first_of(b)], parameter);
        }
        slot
    }

    /// Starts an edge on a great circle between two normals, and returns its slot.
    #[inline(never)]
    fn enter_circle(&mut self, face: Vec3<f32>, ends: [&[f32]; 2], [t0, dt]: [f32; 2]) -> u32 {
        let circle = GreatCircle::new(face, ends.map(unit), t0, dt);
        let slot = self.free.pop().unwrap_or(self.circles.len() as u32);
        match self.circles.get_mut(slot as usize) {
            Some(place) => *place = circle,
            None => self.circles.push(circle),
        }
        slot
    }

    /// Steps the varyings in a slot to the next scanline.
    #[inline(always)]
    fn advance(&mut self, slot: u32) {
        // `circles` is empty unless edges follow great circles.
        if let Some(circle) = self.circles.get_mut(slot as usize) {
            circle.sines.next(); // 4.9–4.12
            return;
        }
        let groups = &mut self.values[slot as usize * self.groups..][..self.groups];
        groups.iter_mut().for_each(Group::advance);
    }

    /// Returns the groups of varyings in a slot.
    #[inline(always)]
    fn groups(&self, slot: u32) -> &[Group] {
        &self.values[slot as usize * self.groups..][..self.groups]
    }
}

/// The edges that cross the current scanline, ordered by polygon and within a polygon from left to
/// right.
#[derive(Debug)]
pub(crate) struct ActiveEdges<'a> {
    frame: &'a Frame,
    varyings: &'a Varyings<'a>,
    depth: SampleDepth,
    edges: Vec<ActiveEdge>,
    merged: Vec<ActiveEdge>,
    more: EdgeVaryings,
    /// True if edges carry varyings.
    is_walked: bool,
    /// True if edges carry some of them in slots.
    has_slots: bool,
}

impl<'a> ActiveEdges<'a> {
    pub fn new(frame: &'a Frame, varyings: &'a Varyings<'a>) -> Self {
        let is_walked = varyings.count > 0 && !matches!(varyings.per, Per::Polygon);
        let is_many = is_walked && varyings.count > GROUP && !varyings.great_circles;
        ActiveEdges {
            frame,
            varyings,
            depth: SampleDepth::new(frame),
            edges: Vec::new(),
            merged: Vec::new(),
            more: EdgeVaryings {
                // ⌈count / GROUP⌉ − 1: the edge itself holds the first group.
                groups: usize::from(is_many) * (varyings.count.saturating_sub(1) / GROUP),
                values: Vec::new(),
                circles: Vec::new(),
                free: Vec::new(),
            },
            is_walked,
            has_slots: is_many || varyings.great_circles,
        }
    }

    /// True if no edge crosses this scanline.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// Moves on to scanline `row`: steps the edges that cross it, drops the edges that end before
    /// its centre, and inserts the `new` edges that begin there. `new` must be in the order of
    /// polygons.
    ///
    /// It merges one list into another in a single pass, so each stepped edge is written once and
    /// not read again before it is used.
    pub fn next<'e>(&mut self, new: impl Iterator<Item = &'e TableEdge>, row: i32) {
        self.merged.clear();
        let mut stepped = 0;
        for begins in new {
            // Behind the stepped edges of the same polygon, among which `order` sorts it later.
            if (self.edges.get(stepped)).is_some_and(|edge| edge.polygon <= begins.polygon) {
                stepped = self.step_to(begins.polygon, stepped, row);
            }
            self.start_edge(begins, row);
        }
        self.step_to(u32::MAX, stepped, row);
        core::mem::swap(&mut self.edges, &mut self.merged);
    }

    /// Steps the edges from index `first` on to scanline `row`, as far as polygon `last`. Returns
    /// the index of the first edge that it leaves.
    // A function of its own keeps what the loop needs in registers.
    #[inline(never)]
    fn step_to(&mut self, last: u32, first: usize, row: i32) -> usize {
        for (count, edge) in self.edges[first..].iter().enumerate() {
            if edge.polygon > last {
                return first + count;
            }
            if edge.end <= row {
                if self.has_slots {
                    self.more.free.push(edge.slot);
                }
                continue;
            }
            // Room first: then the edge goes straight to its place, and not over the stack.
            self.merged.reserve(1);
            let mut stepped = *edge;
            stepped.advance();
            self.merged.push(stepped);
            if self.has_slots {
                self.more.advance(edge.slot);
            }
        }
        self.edges.len()
    }

    /// Appends an edge that begins at scanline `row`, with the sub-pixel start: its parameter is
    /// taken at the scanline's centre.
    #[inline(never)]
    fn start_edge(&mut self, edge: &TableEdge, row: i32) {
        self.merged.reserve(1); // as in `step_to`
        let vertices = self.frame.vertices();
        let [top, bottom] = [edge.top, edge.bottom].map(|v| &vertices[v as usize]);
        let place = |v: &ScreenVertex| [v.x, v.y];
        let [t0, dt] = parameter([top, bottom], row);
        let (varyings, slot) = if self.is_walked {
            self.start_varyings(edge, [t0, dt])
        } else {
            (Group::default(), 0)
        };
        let from = self.depth.of_corner(top);
        let to = self.depth.of_corner(bottom);
        self.merged.push(ActiveEdge {
            polygon: edge.polygon,
            corner: edge.corner,
            end: first_centre(bottom.y),
            crossing: EdgeCrossing::new(place(top), place(bottom), row),
            depth: ramp(from, to, t0, dt), // 3.4
            varyings,
            slot,
        });
    }

    /// Starts the varyings of an edge. Returns the first group, and the slot of the rest.
    #[inline(always)]
    fn start_varyings(&mut self, edge: &TableEdge, parameter: [f32; 2]) -> (Group, u32) {
        if self.varyings.count == 3 && !self.has_slots {
            // The fast path: three values, whose count is a literal. The fourth means nothing; 0
            // would have to be shuffled in.
            let [a, b] = self.ends(3, edge);
            let ends = [[a[0], a[1], a[2], a[2]], [b[0], b[1], b[2], b[2]]];
            return (Group::new(ends, parameter), 0);
        }
        let ([a, b], mut slot) = (self.ends(self.varyings.count, edge), 0);
        if self.varyings.great_circles {
            let polygon = &self.frame.polygons()[edge.polygon as usize];
            let face = vec3(self.frame.polygon_normal(polygon));
            slot = self.more.enter_circle(face, [a, b], parameter);
            // At most a vertex colour follows the normal, which fits in one group.
            let ends = [first_of(&a[3..]), first_of(&b[3..])];
            return (Group::new(ends, parameter), slot);
        }
        if self.has_slots {
            // Slots exist only if there are more than GROUP values, so the slices are not empty.
            slot = self.more.enter([&a[GROUP..], &b[GROUP..]], parameter);
        }
        (Group::new([first_of(a), first_of(b)], parameter), slot)
    }

    /// Returns the varyings of the upper and the lower end of an edge. `count` must equal
    /// [`Varyings::count`], as in [`Varyings::of_corner_with`].
    #[inline(always)]
    pub fn ends(&self, count: usize, edge: &TableEdge) -> [&'a [f32]; 2] {
        let (mut corners, polygon) = ([0; 2], edge.polygon);
        if let Per::Corner(_) = self.varyings.per {
            let polygon = &self.frame.polygons()[polygon as usize];
            corners = [edge.corner, (edge.corner + 1) % polygon.count];
            if self.frame.corners(polygon)[edge.corner as usize] != edge.top {
                corners.reverse();
            }
            let all = self.frame.corners(polygon);
            debug_assert_eq!(
                corners.map(|corner| all[corner as usize]),
                [edge.top, edge.bottom],
                "corners are numbered within the polygon"
            );
        }
        let of = |end| self.varyings.of_corner_with(count, polygon, end);
        [of([corners[0], edge.top]), of([corners[1], edge.bottom])]
    }

    /// Steps all edges to scanline `row` in place, if none of them ends before its centre. Returns
    /// false, and steps none, if one does.
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

    /// Removes all edges and frees their slots.
    #[cfg(feature = "simd")]
    pub fn clear(&mut self) {
        let slots = self.edges.drain(..).map(|edge| edge.slot);
        if self.has_slots {
            self.more.free.extend(slots);
        }
    }

    /// Returns the edges as they are on this scanline, in order, for a trace to read.
    #[cfg(feature = "io")]
    pub fn states(&self) -> impl Iterator<Item = EdgeState> {
        self.edges.iter().map(|edge| {
            let mut state = EdgeState {
                polygon: edge.polygon,
                corner: edge.corner,
                crossing: edge.crossing,
                depth: edge.depth,
                at: Vec::new(),
                by: Vec::new(),
                circle: None,
            };
            if !self.is_walked {
                return state;
            }
            if self.varyings.great_circles {
                let circle = self.more.circles[edge.slot as usize];
                state.at.extend(circle.normal().array());
                state.circle = Some(circle);
                let extras = self.varyings.count - 3;
                state.at.extend(&edge.varyings.at[..extras]);
                state.by.extend(&edge.varyings.step[..extras]);
                return state;
            }
            let more = if self.has_slots {
                self.more.groups(edge.slot)
            } else {
                &[]
            };
            for group in core::iter::once(&edge.varyings).chain(more) {
                state.at.extend(group.at);
                state.by.extend(group.step);
            }
            // The last group is padded.
            state.at.truncate(self.varyings.count);
            state.by.truncate(self.varyings.count);
            state
        })
    }

    /// Sorts the edges of each polygon from left to right and calls `visit` with their spans,
    /// polygon by polygon.
    #[inline(always)]
    pub fn spans(&mut self, width: u32, mut visit: impl FnMut(&Self, PolygonSpan)) {
        order(self.frame, &mut self.edges);
        // Parity: a pixel is inside between the first and the second edge of a polygon, the third
        // and the fourth, and so on. A closed polygon crosses a scanline an even number of times.
        let (pairs, rest) = self.edges.as_chunks();
        debug_assert!(rest.is_empty(), "polygons are closed");
        for (index, pair) in pairs.iter().enumerate() {
            let [left, right]: &[ActiveEdge; 2] = pair;
            debug_assert_eq!(left.polygon, right.polygon, "polygons are closed");
            if let Some(span) = span([left, right], 2 * index as u32, width) {
                visit(self, span);
            }
        }
    }

    /// Adds the run of `pixels` of a span on scanline `row` to a list.
    #[inline(always)]
    pub fn add_run(
        &self,
        span: &PolygonSpan,
        row: usize,
        pixels: Range<usize>,
        uniforms: UniformsIndex,
        to: &mut RunList,
    ) {
        let x = pixels.start as u32;
        // A run may begin inside its span, where a nearer polygon hid the start. Its parameter is
        // the one of its own first pixel.
        let (y, t0, dt) = (
            row as u32,
            span.t0 + (x - span.start) as f32 * span.dt,
            span.dt,
        );
        to.runs.push(Run {
            uniforms,
            polygon: span.polygon,
            x,
            pixels: pixels.len() as u32,
            to: x,
        });
        if self.varyings.keeps_ends {
            to.places.push(SpanPlace {
                y,
                t0,
                dt,
                start: span.start,
                pixels: span.end - span.start,
            });
        }
        self.start(span, [t0, dt], &mut to.starts);
    }

    /// Adds a span's varyings at the parameter `t0` and their growth per step of `dt`, or, if the
    /// method asks for them, the varyings at both ends.
    #[inline(always)]
    fn start(&self, span: &PolygonSpan, parameter: [f32; 2], to: &mut Starts) {
        let [left, right] = &self.edges[span.left as usize..][..2] else {
            unreachable!("a span has two edges")
        };
        if !self.is_walked {
            let constant = self.varyings.of_polygon(span.polygon).unwrap_or_default();
            for values in constant.chunks(GROUP).map(first_of) {
                let keeps_ends = self.varyings.keeps_ends;
                to.push(values, if keeps_ends { values } else { [0.0; GROUP] });
            }
            return;
        }
        if self.varyings.great_circles {
            debug_assert!(self.varyings.keeps_ends, "circles are no straight lines");
            let ends = [left, right];
            let normals = ends.map(|edge| self.more.circles[edge.slot as usize].normal().array()); // 4.8
            to.add(|i| match i.checked_sub(3) {
                None => normals.map(|normal| normal[i]),
                Some(extra) => ends.map(|edge| edge.varyings.at[extra]),
            });
            return;
        }
        let Group { at, step } = self.between([left.varyings, right.varyings], parameter);
        to.push(at, step);
        if self.has_slots {
            let [left, right] = [left, right].map(|edge| self.more.groups(edge.slot));
            for (left, right) in left.iter().zip(right) {
                let Group { at, step } = self.between([*left, *right], parameter);
                to.push(at, step);
            }
        }
    }

    /// Returns the varyings between two edges at the parameter `t0`, with their growth per step of
    /// `dt`; or both ends.
    #[inline(always)]
    fn between(&self, [left, right]: [Group; 2], parameter: [f32; 2]) -> Group {
        if self.varyings.keeps_ends {
            Group {
                at: left.at,
                step: right.at,
            }
        } else {
            Group::new([left.at, right.at], parameter)
        }
    }
}

/// Returns an edge's parameter at the centre of scanline `row`, 0 at its upper end and 1 at its
/// lower one, and its growth per scanline.
#[inline(always)]
pub(crate) fn parameter([top, bottom]: [&ScreenVertex; 2], row: i32) -> [f32; 2] {
    // Exact: both differences have at most 24 bits.
    let height = (bottom.y - top.y).to_bits() as f32;
    let centre = SubPixel::from_num(row) + SubPixel::from_bits(1 << (SubPixel::FRAC_NBITS - 1));
    let t0 = (centre - top.y).to_bits() as f32 / height;
    debug_assert!(
        (0.0..=1.0).contains(&t0),
        "the scanline crosses the edge between its ends"
    );
    [t0, (1 << SubPixel::FRAC_NBITS) as f32 / height] // Δt = 1 / (y_2 − y_1)
}

/// Sorts the edges of each polygon from left to right. Insertion sort suits them: two edges change
/// places only where they cross each other. Ties are decided by the ends of the edges, so the
/// result depends neither on earlier scanlines nor on the corner that the polygon begins with.
fn order(frame: &Frame, edges: &mut [ActiveEdge]) {
    for i in 1..edges.len() {
        let mut at = i;
        while let Some([a, b]) = edges[..=at].last_chunk()
            && a.polygon == b.polygon
            && is_before(frame, b, a)
        {
            edges.swap(at, at - 1);
            at -= 1;
        }
    }
}

/// True if `a` lies left of `b`.
fn is_before(frame: &Frame, a: &ActiveEdge, b: &ActiveEdge) -> bool {
    // The common case: they lie in different pixels.
    if a.crossing.pixel() != b.crossing.pixel() {
        return a.crossing.pixel() < b.crossing.pixel();
    }
    let order = a.crossing.compare(&b.crossing);
    order.then_with(|| compare_ends(frame, a, b)) == Ordering::Less
}

/// Compares two edges of a polygon by their upper and then their lower ends, and equal edges by the
/// corners that they start from.
#[cold]
fn compare_ends(frame: &Frame, a: &ActiveEdge, b: &ActiveEdge) -> Ordering {
    let corners = frame.corners(&frame.polygons()[a.polygon as usize]);
    let ends = |edge: &ActiveEdge| {
        let from = edge.corner as usize;
        let mut ends = [from, (from + 1) % corners.len()]
            .map(|corner| &frame.vertices()[corners[corner] as usize]);
        ends.sort_by(|p, q| p.compare(q));
        ends
    };
    let ([a_top, a_bottom], [b_top, b_bottom]) = (ends(a), ends(b));
    (a_top.compare(b_top))
        .then(a_bottom.compare(b_bottom))
        .then(a.corner.cmp(&b.corner))
}

/// Returns the span between two edges, if it covers a pixel. `left_index` is the index of the left
/// edge.
#[inline(always)]
fn span([left, right]: [&ActiveEdge; 2], left_index: u32, width: u32) -> Option<PolygonSpan> {
    let (from, to) = (left.crossing.pixel(), right.crossing.pixel());
    // Half-open, by the fill rule: a pixel whose centre lies on the left crossing is inside, on the
    // right crossing it is outside.
    let (start, end) = (from.max(0), to.min(width as i32));
    if start >= end {
        return None;
    }
    let offset = left.crossing.offset();
    // x_2 − x_1 between the exact crossings, in f64. It is over 0, because a pixel centre lies
    // between them.
    let dt = 1.0 / (f64::from(to - from) + (offset - right.crossing.offset())); // Δt = 1 / (x_2 − x_1)
    let t0 = ((f64::from(start - from) + offset) * dt) as f32;
    let dt = dt as f32;
    let [depth, depth_step] = ramp(left.depth[0], right.depth[0], t0, dt);
    Some(PolygonSpan {
        polygon: left.polygon,
        left: left_index,
        start: start as u32,
        end: end as u32,
        t0,
        dt,
        depth,
        depth_step,
    })
}
