//! Hits: what is seen at sampled pixels, as a polygon and the weights of its vertices. The engine says
//! which polygon; the weights are the reference's closed forms.

use super::recipe::{Corners, Geometry, Interpolated};
use super::surface::Surface;
use crate::frame::{Frame, Polygon};
use crate::raster::{NOTHING, for_each_polygon_row};
use crate::reference::coverage::Scanline;
use crate::scene::Interpolation;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;
use glam::DVec3;

/// What is seen at each of some pixels.
#[derive(Default)]
pub struct Hits {
    /// The polygon of the scene, or [`NOTHING`].
    pub polygons: Vec<u32>,
    /// The corners of the triangle that is drawn there, if it is one, whole, and of a larger polygon.
    pub pieces: Vec<Option<[u32; 3]>>,
    /// Its material.
    pub materials: Vec<u32>,
    /// True where it is lit from behind: its normals are negated.
    pub flipped: Vec<bool>,
    /// True beside an edge of what is covered, a jump of depth, or a crease, where the picture of
    /// another rasterizer may show another polygon.
    pub edges: Vec<bool>,
    ends: Vec<u32>,
    weights: Vec<(u32, f64)>,
}

/// The neighbours that decide whether a pixel is at an edge.
const AROUND: [[i64; 2]; 4] = [[-1, 0], [1, 0], [0, -1], [0, 1]];

/// Points of one surface are nearer to each other than this share of the scene's extent.
const JUMP: f64 = 0.06;

/// Normals of one surface have at least this cosine at neighbouring pixels: 20°.
const CREASE: f64 = 0.94;

impl Hits {
    /// Finds what is seen at the pixels of `frame` that are looked at.
    pub fn new(
        frame: &Frame,
        surface: &Surface<'_>,
        looked_at: &LookedAt,
        geometry: &Geometry,
    ) -> Hits {
        let numbers = looked_at.polygons(frame);
        let mut hits = Hits::default();
        let mut weights = Weights::new(frame, surface, geometry);
        let numbers = numbers.chunks(looked_at.slots());
        for (pixel, numbers) in looked_at.pixels.iter().zip(numbers) {
            let seen = pixel.zip(frame.polygons().get(numbers[0] as usize));
            let is_hit = seen.is_some_and(|([x, y], polygon)| weights.find(polygon, [x, y]));
            if let Some((_, polygon)) = seen.filter(|_| is_hit) {
                hits.add(polygon, weights.piece(polygon), &weights.found);
            } else {
                hits.add_nothing();
            }
            let Some(pixel) = pixel else {
                hits.edges.push(true);
                continue;
            };
            let is_uniform = numbers.iter().all(|number| *number == numbers[0]);
            let seen = seen.filter(|_| is_hit && !is_uniform);
            let here = seen.and_then(|([x, y], polygon)| {
                weights
                    .find_right(polygon, [x, y])
                    .then(|| (numbers[0], weights.place()))
            });
            let mut others = looked_at.around.iter().zip(&numbers[1..]);
            hits.edges.push(
                !is_uniform
                    && others.any(|(step, number)| {
                        let other = looked_at.stepped(*pixel, *step);
                        other.is_some_and(|other| weights.is_apart(here, *number, other))
                    }),
            );
        }
        hits
    }

    fn add(&mut self, polygon: &Polygon, piece: Option<[u32; 3]>, weights: &[(u32, f64)]) {
        self.pieces.push(piece);
        self.polygons.push(polygon.source);
        self.materials.push(polygon.material);
        self.flipped.push(polygon.face & Polygon::FLIPPED != 0);
        self.weights.extend_from_slice(weights);
        self.ends.push(self.weights.len() as u32);
    }

    fn add_nothing(&mut self) {
        self.polygons.push(NOTHING);
        self.pieces.push(None);
        self.materials.push(0);
        self.flipped.push(false);
        self.ends.push(self.weights.len() as u32);
    }

    /// Returns the number of pixels.
    pub fn len(&self) -> usize {
        self.polygons.len()
    }

    /// True if anything is seen at pixel `i`.
    pub fn is_covered(&self, i: usize) -> bool {
        self.polygons[i] != NOTHING
    }

    /// Returns the vertices of pixel `i` with their weights, which sum to 1. Vertices of the second side
    /// are those of the first.
    pub fn weights(&self, i: usize) -> &[(u32, f64)] {
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.weights[Range {
            start: start as usize,
            end: self.ends[i] as usize,
        }]
    }
}

/// The pixels of a frame that are looked at, in the order in which rows are drawn.
pub struct LookedAt {
    /// Column and row; `None` outside the picture.
    pixels: Vec<Option<[usize; 2]>>,
    /// Neighbours of each pixel that are looked at, too: all four, or none.
    around: &'static [[i64; 2]],
    size: [usize; 2],
    /// Row, column, and place among the pixels and their neighbours.
    order: Vec<[u32; 3]>,
}

impl LookedAt {
    /// Looks at `pixels` of a picture of `size`; with `finds_edges` at their neighbours as well.
    pub fn new(pixels: Vec<Option<[usize; 2]>>, size: [usize; 2], finds_edges: bool) -> LookedAt {
        let mut looked_at = LookedAt {
            pixels,
            around: if finds_edges { &AROUND } else { &[] },
            size,
            order: Vec::new(),
        };
        let mut order = Vec::with_capacity(looked_at.slots() * looked_at.pixels.len());
        for (i, pixel) in looked_at.pixels.iter().enumerate() {
            let Some(pixel) = *pixel else { continue };
            let neighbours = looked_at
                .around
                .iter()
                .map(|step| looked_at.stepped(pixel, *step));
            for (k, place) in [Some(pixel)].into_iter().chain(neighbours).enumerate() {
                let slot = looked_at.slots() * i + k;
                order.extend(place.map(|[x, y]| [y, x, slot].map(|n| n as u32)));
            }
        }
        order.sort_unstable();
        looked_at.order = order;
        looked_at
    }

    fn slots(&self) -> usize {
        self.around.len() + 1
    }

    /// Returns the neighbour of a pixel, if it is in the picture.
    fn stepped(&self, [x, y]: [usize; 2], [dx, dy]: [i64; 2]) -> Option<[usize; 2]> {
        let x = usize::try_from(x as i64 + dx)
            .ok()
            .filter(|x| *x < self.size[0])?;
        let y = usize::try_from(y as i64 + dy)
            .ok()
            .filter(|y| *y < self.size[1])?;
        Some([x, y])
    }

    /// Returns the polygon of `frame` that is seen at each pixel, and then at its neighbours.
    fn polygons(&self, frame: &Frame) -> Vec<u32> {
        let mut numbers = vec![NOTHING; self.slots() * self.pixels.len()];
        for_each_polygon_row(frame, &mut |row, polygon| {
            let start = self.order.partition_point(|[y, ..]| (*y as usize) < row);
            let here = self.order[start..].iter();
            for &[_, x, slot] in here.take_while(|[y, ..]| *y as usize == row) {
                numbers[slot as usize] = polygon(x as usize);
            }
        });
        numbers
    }
}

/// The weights of vertices at a pixel.
struct Weights<'a> {
    frame: &'a Frame,
    surface: &'a Surface<'a>,
    scanline: Scanline<'a>,
    /// The polygon and row that `scanline` is at.
    at: Option<(u32, usize)>,
    corners: Corners,
    is_times_w: bool,
    found: Vec<(u32, f64)>,
}

impl<'a> Weights<'a> {
    fn new(frame: &'a Frame, surface: &'a Surface<'a>, geometry: &Geometry) -> Weights<'a> {
        Weights {
            frame,
            surface,
            scanline: Scanline::new(frame),
            at: None,
            corners: geometry.weights,
            is_times_w: geometry.interpolation == Interpolated::TimesW,
            found: Vec::new(),
        }
    }

    /// Finds the weights of a polygon at a pixel; false if it is not there.
    fn find(&mut self, polygon: &'a Polygon, [x, y]: [usize; 2]) -> bool {
        if self.at != Some((polygon.first, y)) {
            self.scanline.cut(self.frame.corners(polygon), y);
            self.at = Some((polygon.first, y));
        }
        self.found.clear();
        let Some(weights) = self.scanline.weights(x) else {
            return false;
        };
        let vertices = self.frame.vertices();
        let is_weighted = self.frame.interpolation() == Interpolation::Perspective;
        let factor = |v: u32| match (self.is_times_w, is_weighted) {
            (true, _) => 1.0 / vertices[v as usize].inv_w,
            (false, true) => vertices[v as usize].inv_w,
            (false, false) => 1.0,
        };
        let all = self.given(self.frame.corners(polygon), weights.all());
        let all = all.map(|(v, weight)| (v, weight * factor(v)));
        let sum: f64 = all.iter().map(|(_, weight)| weight).sum();
        for (vertex, weight) in all.into_iter().filter(|(_, weight)| *weight != 0.0) {
            self.add(vertex, weight / sum);
        }
        true
    }

    /// Finds the weights without mistakes: edges are where polygons are.
    fn find_right(&mut self, polygon: &'a Polygon, pixel: [usize; 2]) -> bool {
        let own = (self.corners, self.is_times_w);
        (self.corners, self.is_times_w) = (Corners::Own, false);
        let is_found = self.find(polygon, pixel);
        (self.corners, self.is_times_w) = own;
        is_found
    }

    /// Gives the weights of a triangle to the corners that they are said to belong to.
    fn given(&self, corners: &[u32], weights: [(u32, f64); 4]) -> [(u32, f64); 4] {
        let &[a, b, c] = corners else { return weights };
        let of = |v: u32| -> f64 {
            let own = weights.iter().filter(|(vertex, _)| *vertex == v);
            own.map(|(_, weight)| weight).sum()
        };
        let [x, y, z] = [a, b, c].map(of);
        match self.corners {
            Corners::Own => weights,
            Corners::Next => [(a, y), (b, z), (c, x), (c, 0.0)],
            Corners::Before => [(a, z), (b, x), (c, y), (c, 0.0)],
        }
    }

    /// Adds a vertex, or for one that clipping made the two between which it lies.
    fn add(&mut self, vertex: u32, weight: f64) {
        if let Some(cut) = self.frame.clip_corner(vertex) {
            let t = f64::from(cut.t);
            self.add(cut.a, weight * (1.0 - t));
            self.add(cut.b, weight * t);
            return;
        }
        let front = vertex as usize % self.surface.len().max(1);
        self.found.push((front as u32, weight));
    }

    /// Returns the corners of a triangle that is part of a larger polygon.
    fn piece(&self, polygon: &Polygon) -> Option<[u32; 3]> {
        let whole = self.surface.corners(polygon.source);
        let corners = <[u32; 3]>::try_from(self.frame.corners(polygon)).ok()?;
        let is_whole = corners
            .iter()
            .all(|&corner| self.frame.clip_corner(corner).is_none());
        let front = |corner: u32| corner % self.surface.len().max(1) as u32;
        (whole.len() > 3 && is_whole).then(|| corners.map(front))
    }

    /// Returns position, unit normal and object of the weights found last.
    fn place(&self) -> (DVec3, DVec3, usize) {
        let sum = |of: &[DVec3]| -> DVec3 {
            let found = self.found.iter();
            found.map(|&(v, weight)| of[v as usize] * weight).sum()
        };
        let normal = sum(self.surface.stated()).normalize_or_zero();
        let object = self
            .found
            .first()
            .map_or(0, |(vertex, _)| self.surface.object_of(*vertex));
        (sum(&self.surface.positions), normal, object)
    }

    /// True if the polygon `number` at a neighbouring pixel is not of the surface that is seen `here`.
    fn is_apart(
        &mut self,
        here: Option<(u32, (DVec3, DVec3, usize))>,
        number: u32,
        neighbour: [usize; 2],
    ) -> bool {
        let frame = self.frame;
        let other = frame.polygons().get(number as usize);
        let (Some((own, (p, n, object))), Some(other)) = (here, other) else {
            return here.is_some() != other.is_some();
        };
        if own == number || !self.find_right(other, neighbour) {
            return false;
        }
        let (q, m, neighbour) = self.place();
        // Surfaces of two objects at one depth fight, in another way in each rasterizer.
        object != neighbour || (p - q).length() > JUMP * self.surface.extent || n.dot(m) < CREASE
    }
}
