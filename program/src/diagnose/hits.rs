//! Hits: the visible polygon at each sampled pixel, and the weights of its vertices. The engine
//! finds the polygon. The weights are the reference's closed forms.

use super::recipe::{Corners, Geometry, Interpolated};
use super::surface::Surface;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;
use fastphong::frame::{Frame, Polygon};
use fastphong::raster::{NO_POLYGON, for_each_polygon_row};
use fastphong::reference::coverage::Scanline;
use fastphong::scene::Interpolation;
use glam::DVec3;

/// The visible polygons at some pixels.
#[derive(Default)]
pub struct Hits {
    /// The polygon of the scene, or [`NO_POLYGON`].
    pub polygons: Vec<u32>,
    /// The corners of the triangle at the pixel, if the polygon was cut into triangles and clipping
    /// did not cut this one.
    pub pieces: Vec<Option<[u32; 3]>>,
    /// The polygon's material.
    pub materials: Vec<u32>,
    /// True if the back of the polygon is visible: its normals are negated.
    pub flipped: Vec<bool>,
    /// True beside an outline, a jump of depth or a crease, where another rasterizer may show
    /// another polygon.
    pub edges: Vec<bool>,
    ends: Vec<u32>,
    weights: Vec<(u32, f64)>,
}

/// The steps to a pixel's neighbours, among which edges are looked for.
const AROUND: [[i64; 2]; 4] = [[-1, 0], [1, 0], [0, -1], [0, 1]];

/// The largest distance between neighbouring points of one surface, as a share of the scene's
/// extent.
const JUMP: f64 = 0.06;

/// The least cosine between normals of one surface at neighbouring pixels: 20°.
const CREASE: f64 = 0.94;

impl Hits {
    /// Finds the visible polygons at the pixels of `looked_at`.
    pub fn new(
        frame: &Frame,
        surface: &Surface<'_>,
        looked_at: &LookedAt,
        geometry: &Geometry,
    ) -> Hits {
        let indices = looked_at.polygons(frame);
        let mut hits = Hits::default();
        let mut weights = Weights::new(frame, surface, geometry);
        let places = indices.chunks(looked_at.slots());
        for (pixel, indices) in looked_at.pixels.iter().zip(places) {
            let seen = pixel.zip(frame.polygons().get(indices[0] as usize));
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
            let is_uniform = indices.iter().all(|index| *index == indices[0]);
            let seen = seen.filter(|_| is_hit && !is_uniform);
            let here = seen.and_then(|([x, y], polygon)| {
                weights
                    .find_right(polygon, [x, y])
                    .then(|| (indices[0], weights.place()))
            });
            let mut others = looked_at.around.iter().zip(&indices[1..]);
            hits.edges.push(
                !is_uniform
                    && others.any(|(step, index)| {
                        let other = looked_at.stepped(*pixel, *step);
                        other.is_some_and(|other| weights.is_apart(here, *index, other))
                    }),
            );
        }
        hits
    }

    fn add(&mut self, polygon: &Polygon, piece: Option<[u32; 3]>, weights: &[(u32, f64)]) {
        self.pieces.push(piece);
        self.polygons.push(polygon.source);
        self.materials.push(polygon.material);
        self.flipped.push(polygon.is_flipped());
        self.weights.extend_from_slice(weights);
        self.ends.push(self.weights.len() as u32);
    }

    fn add_nothing(&mut self) {
        self.polygons.push(NO_POLYGON);
        self.pieces.push(None);
        self.materials.push(0);
        self.flipped.push(false);
        self.ends.push(self.weights.len() as u32);
    }

    /// Returns how many pixels there are.
    pub fn len(&self) -> usize {
        self.polygons.len()
    }

    /// True if a polygon is visible at pixel `i`.
    pub fn is_covered(&self, i: usize) -> bool {
        self.polygons[i] != NO_POLYGON
    }

    /// Returns the vertices at pixel `i` with their weights, which add up to 1. For the back of a
    /// polygon they are the vertices of its front.
    pub fn weights(&self, i: usize) -> &[(u32, f64)] {
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.weights[Range {
            start: start as usize,
            end: self.ends[i] as usize,
        }]
    }
}

/// The sampled pixels of a frame, sorted in the order in which rows are drawn.
pub struct LookedAt {
    /// Column and row, or `None` outside the picture.
    pixels: Vec<Option<[usize; 2]>>,
    /// The neighbours of each pixel that are sampled, too: all four, or none.
    around: &'static [[i64; 2]],
    size: [usize; 2],
    /// Row, column, and index among the pixels and their neighbours.
    order: Vec<[u32; 3]>,
}

impl LookedAt {
    /// Samples `pixels` of a picture of `size`. With `finds_edges` it samples their neighbours as
    /// well.
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

    /// Returns the neighbour of a pixel, or `None` if it is outside the picture.
    fn stepped(&self, [x, y]: [usize; 2], [dx, dy]: [i64; 2]) -> Option<[usize; 2]> {
        let x = usize::try_from(x as i64 + dx)
            .ok()
            .filter(|x| *x < self.size[0])?;
        let y = usize::try_from(y as i64 + dy)
            .ok()
            .filter(|y| *y < self.size[1])?;
        Some([x, y])
    }

    /// Returns the index of the visible polygon of `frame` at each pixel, followed by those at its
    /// neighbours.
    fn polygons(&self, frame: &Frame) -> Vec<u32> {
        let mut indices = vec![NO_POLYGON; self.slots() * self.pixels.len()];
        for_each_polygon_row(frame, &mut |row, polygon| {
            let start = self.order.partition_point(|[y, ..]| (*y as usize) < row);
            let here = self.order[start..].iter();
            for &[_, x, slot] in here.take_while(|[y, ..]| *y as usize == row) {
                indices[slot as usize] = polygon(x as usize);
            }
        });
        indices
    }
}

/// The weights of vertices at a pixel.
struct Weights<'a> {
    frame: &'a Frame,
    surface: &'a Surface<'a>,
    scanline: Scanline<'a>,
    /// The polygon, by its first corner, and the row that `scanline` cut last.
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

    /// Finds the weights of a polygon's vertices at a pixel. Returns false if the polygon does not
    /// cover it.
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
        let factor = |v: u32| {
            if self.is_times_w {
                1.0 / vertices[v as usize].inv_w
            } else if is_weighted {
                vertices[v as usize].inv_w
            } else {
                1.0
            }
        };
        let all = self
            .assigned(self.frame.corners(polygon), weights.all())
            .map(|(v, weight)| (v, weight * factor(v)));
        let sum: f64 = all.iter().map(|(_, weight)| weight).sum();
        for (vertex, weight) in all.into_iter().filter(|(_, weight)| *weight != 0.0) {
            self.add(vertex, weight / sum);
        }
        true
    }

    /// Finds the weights without mistakes, because edges do not depend on them.
    fn find_right(&mut self, polygon: &'a Polygon, pixel: [usize; 2]) -> bool {
        let own = (self.corners, self.is_times_w);
        (self.corners, self.is_times_w) = (Corners::Own, false);
        let is_found = self.find(polygon, pixel);
        (self.corners, self.is_times_w) = own;
        is_found
    }

    /// Assigns the weights of a triangle to its corners, which a mistake may exchange.
    fn assigned(&self, corners: &[u32], weights: [(u32, f64); 4]) -> [(u32, f64); 4] {
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

    /// Adds a vertex. If clipping made it, adds the two vertices between which it lies.
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

    /// Returns the corners of a triangle that is a piece of a larger polygon and that clipping did
    /// not cut.
    fn piece(&self, polygon: &Polygon) -> Option<[u32; 3]> {
        let whole = self.surface.corners(polygon.source);
        let corners = <[u32; 3]>::try_from(self.frame.corners(polygon)).ok()?;
        let is_whole = corners
            .iter()
            .all(|&corner| self.frame.clip_corner(corner).is_none());
        let front = |corner: u32| corner % self.surface.len().max(1) as u32;
        (whole.len() > 3 && is_whole).then(|| corners.map(front))
    }

    /// Returns position, unit normal and object of the point whose weights were found last.
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

    /// True if the polygon at `index`, which is visible at a neighbouring pixel, belongs to another
    /// surface than the one visible `here`.
    fn is_apart(
        &mut self,
        here: Option<(u32, (DVec3, DVec3, usize))>,
        index: u32,
        neighbour: [usize; 2],
    ) -> bool {
        let frame = self.frame;
        let other = frame.polygons().get(index as usize);
        let (Some((own, (p, n, object))), Some(other)) = (here, other) else {
            return here.is_some() != other.is_some();
        };
        if own == index || !self.find_right(other, neighbour) {
            return false;
        }
        let (q, m, neighbour) = self.place();
        // Two objects at the same depth fight for a pixel, and each rasterizer decides differently.
        object != neighbour || (p - q).length() > JUMP * self.surface.extent || n.dot(m) < CREASE
    }
}
