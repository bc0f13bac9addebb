//! The corners around each vertex, and the groups of them that share an average.

use super::PolygonMesh;
use super::newell::unit_normal;
use crate::number::parallel::collect;
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

/// A corner of a polygon, as one of those around a vertex.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FanCorner {
    /// The index in [`PolygonMesh::corners`].
    pub corner: u32,
    pub polygon: u32,
}

/// The corners around each vertex, in the order of polygons: those of vertex `v` are `items[starts[v]..starts[v + 1]]`.
pub(super) struct Fans {
    starts: Vec<u32>,
    items: Vec<FanCorner>,
}

impl Fans {
    /// Collects the corners at each of `count` vertices; `vertex` is the one at each position.
    pub fn new(mesh: &PolygonMesh, vertex: &[u32], count: usize) -> Self {
        let mut starts = vec![0u32; count + 1];
        for &corner in mesh.corners() {
            starts[vertex[corner as usize] as usize + 1] += 1;
        }
        for v in 0..count {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut items = vec![FanCorner::default(); mesh.corners().len()];
        for polygon in 0..mesh.polygon_count() {
            for corner in mesh.corner_range(polygon) {
                let slot = &mut next[vertex[mesh.corners()[corner] as usize] as usize];
                items[*slot as usize] = FanCorner {
                    corner: corner as u32,
                    polygon: polygon as u32,
                };
                *slot += 1;
            }
        }
        Fans { starts, items }
    }

    /// Returns the corners around vertex `v`.
    pub fn of(&self, v: usize) -> &[FanCorner] {
        &self.items[self.starts[v] as usize..self.starts[v + 1] as usize]
    }
}

/// An edge at a vertex, as one of the corners there has it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct EdgeEnd {
    /// The vertex at the other end.
    other: u32,
    /// The part of the mesh that the corner belongs to.
    part: u32,
    /// True if the polygon runs along the edge away from the vertex.
    leaves: bool,
    /// The corner's place in the fan.
    item: u32,
}

/// The cosine of 179 degrees: two polygons whose normals are farther apart than that are the sides of a sheet, and their edge
/// is its rim. An average over both would cancel, and tell nothing.
const FOLDED: f64 = -0.999_847_695_156_391_3;

/// Finds the surfaces that meet at a vertex: corners that may share an average.
///
/// Two corners are on one surface if a chain of polygons of one part links them, each of which shares with the next an edge
/// at this vertex that they run in opposite directions, and does not fold back onto it (see [`FOLDED`]). Two sheets back to
/// back, cones that touch at their tips, or neighbours that are wound differently are surfaces of their own; the corners of
/// one polygon are always on one.
///
/// Along an edge of more than two polygons each is linked to one other: pairs are made from the flattest on, that with the
/// least angle between its normals, and among equals from the first in the order of polygons. So of two curved sheets
/// with the same edges each stays with itself, and of three walls at an edge the two that continue one another. Where more
/// than [`SurfaceFinder::MOST_PAIRS`] pairs are possible, the first of either direction make a pair, then the second ones.
pub(super) struct SurfaceFinder<'a> {
    mesh: &'a PolygonMesh,
    /// The vertex at each position.
    vertex: &'a [u32],
    /// Polygon normals, any length.
    normals: &'a [DVec3],
    ends: Vec<EdgeEnd>,
    parents: Vec<u32>,
    /// The surface of each corner of the fan looked at last, numbered in order of appearance.
    pub surfaces: Vec<u32>,
}

impl<'a> SurfaceFinder<'a> {
    /// The most pairs at an edge that are compared. Keeps the time in proportion to the mesh.
    const MOST_PAIRS: usize = 1024;

    pub fn new(mesh: &'a PolygonMesh, vertex: &'a [u32], normals: &'a [DVec3]) -> Self {
        SurfaceFinder {
            mesh,
            vertex,
            normals,
            ends: Vec::new(),
            parents: Vec::new(),
            surfaces: Vec::new(),
        }
    }

    /// Finds the surfaces at `v`, around which are the corners of `fan`; returns their number.
    pub fn find(&mut self, v: usize, fan: &[FanCorner]) -> usize {
        self.parents.clear();
        self.parents.extend(0..fan.len() as u32);
        self.collect_ends(v as u32, fan);
        self.ends.sort_unstable();
        let ends = core::mem::take(&mut self.ends);
        for edge in ends.chunk_by(|a, b| (a.other, a.part) == (b.other, b.part)) {
            match edge.split_at(edge.partition_point(|end| !end.leaves)) {
                ([a], [b]) => {
                    let [p, q] = [a, b].map(|end| fan[end.item as usize].polygon);
                    if !self.is_folded(p, q) {
                        self.link(a.item, b.item);
                    }
                }
                ([], _) | (_, []) => (),
                (arriving, leaving) => self.link_pairs(fan, arriving, leaving),
            }
        }
        self.ends = ends;
        self.number_surfaces()
    }

    /// Collects the edges at `v`, and links corners of one polygon.
    fn collect_ends(&mut self, v: u32, fan: &[FanCorner]) {
        self.ends.clear();
        for (item, &FanCorner { corner, polygon }) in fan.iter().enumerate() {
            if item > 0 && fan[item - 1].polygon == polygon {
                self.link(item as u32 - 1, item as u32);
            }
            let range = self.mesh.corner_range(polygon as usize);
            let corner = corner as usize;
            let (first, last) = (range.start, range.end - 1);
            let before = if corner == first { last } else { corner - 1 };
            let after = if corner == last { first } else { corner + 1 };
            for (neighbour, leaves) in [(before, false), (after, true)] {
                let other = self.vertex[self.mesh.corners()[neighbour] as usize];
                // An edge without length is one of two corners of a polygon here, which are linked already.
                if other != v {
                    self.ends.push(EdgeEnd {
                        other,
                        part: self.mesh.part(polygon as usize),
                        leaves,
                        item: item as u32,
                    });
                }
            }
        }
    }

    /// True if two polygons along an edge are the sides of a sheet.
    fn is_folded(&self, p: u32, q: u32) -> bool {
        let [p, q] = [p, q].map(|polygon| self.normals[polygon as usize]);
        // Nearly all pairs are decided without a root.
        p.dot(q) < 0.0
            && unit_normal(p)
                .zip(unit_normal(q))
                .is_some_and(|(p, q)| p.dot(q) < FOLDED)
    }

    /// Links the polygons along an edge that are not one in each direction.
    fn link_pairs(&mut self, fan: &[FanCorner], arriving: &[EdgeEnd], leaving: &[EdgeEnd]) {
        if arriving.len() * leaving.len() > Self::MOST_PAIRS {
            for (a, b) in arriving.iter().zip(leaving) {
                self.link(a.item, b.item);
            }
            return;
        }
        let normal = |end: &EdgeEnd| {
            let polygon = fan[end.item as usize].polygon as usize;
            unit_normal(self.normals[polygon])
        };
        let mut pairs = Vec::new();
        for (i, a) in arriving.iter().enumerate() {
            let own = normal(a);
            for (j, b) in leaving.iter().enumerate() {
                // A polygon without a normal comes last.
                let cosine = own.zip(normal(b)).map_or(-2.0, |(a, b)| a.dot(b));
                // The same order at both ends of the edge, where arriving and leaving change places.
                let order = (a.item.min(b.item), a.item.max(b.item));
                pairs.push((cosine, order, (i, j)));
            }
        }
        pairs.sort_unstable_by(|p, q| q.0.total_cmp(&p.0).then((p.1, p.2).cmp(&(q.1, q.2))));
        let (mut has_arrived, mut has_left) =
            (vec![false; arriving.len()], vec![false; leaving.len()]);
        for (cosine, _, (i, j)) in pairs {
            let is_rim = (-1.5..FOLDED).contains(&cosine);
            if !has_arrived[i] && !has_left[j] && !is_rim {
                (has_arrived[i], has_left[j]) = (true, true);
                self.link(arriving[i].item, leaving[j].item);
            }
        }
    }

    /// Puts two corners on one surface. The least corner of each stands for all.
    fn link(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }

    fn root(&mut self, mut item: u32) -> u32 {
        while self.parents[item as usize] != item {
            let above = self.parents[self.parents[item as usize] as usize];
            self.parents[item as usize] = above;
            item = above;
        }
        item
    }

    fn number_surfaces(&mut self) -> usize {
        self.surfaces.clear();
        let mut count = 0;
        for item in 0..self.parents.len() as u32 {
            let root = self.root(item);
            let number = match root == item {
                true => {
                    count += 1;
                    count - 1
                }
                false => self.surfaces[root as usize],
            };
            self.surfaces.push(number);
        }
        count as usize
    }
}

/// The corners that share an average.
pub(super) enum Sharing {
    /// All corners at a vertex do.
    Vertices,
    /// Those of equal numbers do, which are below `count`.
    Groups {
        /// The number of each corner.
        corners: Vec<u32>,
        count: usize,
    },
}

/// What corners must have in common to share an average, beside the vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Smoothing {
    /// The surface: see [`SurfaceFinder`].
    Surfaces,
    /// The surface and the smoothing group, where the mesh has some; a polygon that is [`PolygonMesh::FACETED`] shares with none.
    Groups,
}

impl Sharing {
    /// Finds the corners that share an average at each of `count` vertices; `vertex` is the one at each position, `normals`
    /// are those of polygons, of any length.
    pub fn new(
        mesh: &PolygonMesh,
        vertex: &[u32],
        count: usize,
        normals: &[DVec3],
        smoothing: Smoothing,
    ) -> Sharing {
        const RUN: usize = 1024;
        let fans = Fans::new(mesh, vertex, count);
        // For runs of vertices, the groups of the corners around them, and the number of groups.
        let runs = collect(count.div_ceil(RUN), 1, |run| {
            let mut finder = SurfaceFinder::new(mesh, vertex, normals);
            let (mut groups, mut next) = (Vec::new(), 0);
            for v in run * RUN..count.min(run * RUN + RUN) {
                let fan = fans.of(v);
                let mut found = finder.find(v, fan);
                if smoothing == Smoothing::Groups {
                    found = split(mesh, fan, &mut finder.surfaces, found);
                }
                groups.extend(finder.surfaces.iter().map(|group| next + group));
                // A vertex without corners takes a number too, so that in simple meshes groups are vertices.
                next += found.max(1) as u32;
            }
            (groups, next)
        });
        let total: usize = runs.iter().map(|(_, groups)| *groups as usize).sum();
        if total == count {
            return Sharing::Vertices;
        }
        let mut corners = vec![0; mesh.corners().len()];
        let (mut first, mut items) = (0, fans.items.iter());
        for (groups, of_run) in runs {
            for (group, item) in groups.iter().zip(items.by_ref()) {
                corners[item.corner as usize] = first + group;
            }
            first += of_run;
        }
        Sharing::Groups {
            corners,
            count: total,
        }
    }
}

/// Splits the surfaces around a vertex by smoothing groups; returns the number of parts.
fn split(mesh: &PolygonMesh, fan: &[FanCorner], surfaces: &mut [u32], count: usize) -> usize {
    let group = |item: usize| {
        let polygon = fan[item].polygon;
        match mesh.smoothing_group(polygon as usize) {
            Some(PolygonMesh::FACETED) => (PolygonMesh::FACETED, polygon),
            group => (group.unwrap_or(PolygonMesh::FACETED + 1), 0),
        }
    };
    if (1..fan.len()).all(|item| group(item) == group(0)) {
        return count;
    }
    let mut keys: Vec<_> = (0..fan.len())
        .map(|item| (surfaces[item], group(item), item))
        .collect();
    keys.sort_unstable();
    let parts = keys.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
    parts.zip(0..).fold(0, |_, (part, number)| {
        part.iter().for_each(|key| surfaces[key.2] = number);
        number as usize + 1
    })
}
