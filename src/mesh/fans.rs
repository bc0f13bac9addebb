//! The corners around each vertex, and the surfaces that they belong to.

use super::PolygonMesh;
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

/// One of the polygon corners that meet at a vertex.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FanCorner {
    /// The index in [`PolygonMesh::corners`].
    pub corner: u32,
    pub polygon: u32,
}

/// The corners around each vertex, in the order of polygons. Vertex `v` has
/// `items[starts[v]..starts[v + 1]]`.
pub(super) struct Fans {
    starts: Vec<u32>,
    items: Vec<FanCorner>,
}

impl Fans {
    /// Collects the corners at each of `count` vertices. `vertex` holds the vertex of each
    /// position.
    pub fn new(mesh: &PolygonMesh, vertex: &[u32], count: usize) -> Self {
        // A counting sort: count the corners of each vertex, turn counts into starts, then place
        // each corner.
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

/// One corner's view of an edge at the vertex.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct EdgeEnd {
    /// The vertex at the other end.
    other: u32,
    /// The part of the mesh that the corner belongs to.
    part: u32,
    /// True if the polygon runs along the edge away from the vertex.
    leaves: bool,
    /// The index of the corner in the fan.
    item: u32,
}

/// The property, besides the vertex, that corners must have in common to share an average.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Smoothing {
    /// The surface: see [`SurfaceFinder`].
    Surfaces,
    /// The surface and the smoothing group, if the mesh has groups. A polygon that is
    /// [`PolygonMesh::FACETED`] shares its average with no other.
    Groups,
}

/// The cosine of 179 degrees. Two polygons whose normals are farther apart are the two sides of a
/// sheet, and their common edge is its rim. An average over both would cancel and mean nothing.
const FOLDED: f64 = -0.999_847_695_156_391_3;

/// Finds the surfaces that meet at a vertex. Corners on one surface may share an average.
///
/// Two corners are on one surface if a chain of polygons of one part links them. Each polygon of
/// the chain shares an edge at this vertex with the next one, the two run along the edge in
/// opposite directions, and they do not fold back onto each other (see [`FOLDED`]). Two sheets back
/// to back, cones that touch at their tips, and neighbours that are wound differently are therefore
/// separate surfaces. The corners of one polygon are always on one surface.
///
/// If more than two polygons meet along an edge, each is linked to one other. Pairs are made in
/// order of flatness: the pair with the smallest angle between its normals first, and among equals
/// the first in the order of polygons. So each of two curved sheets with common edges stays with
/// itself, and of three walls at an edge the two that continue each other are linked. If more than
/// [`SurfaceFinder::MOST_PAIRS`] pairs are possible, the first polygons of the two directions make
/// a pair, then the second ones, and so on.
pub(super) struct SurfaceFinder<'a> {
    mesh: &'a PolygonMesh,
    /// The vertex at each position.
    vertex: &'a [u32],
    /// Unit normals of the polygons; zero for a polygon without a normal.
    normals: &'a [DVec3],
    ends: Vec<EdgeEnd>,
    /// A union-find forest over the corners of the fan.
    parents: Vec<u32>,
    /// The surface, or the group, of each corner of the last fan.
    pub surfaces: Vec<u32>,
}

impl<'a> SurfaceFinder<'a> {
    /// The most pairs that are compared at one edge. The limit keeps the time proportional to the
    /// mesh.
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

    /// Finds the groups of corners at `v` that share an average: the corners of one surface, and
    /// under [`Smoothing::Groups`] also of one smoothing group. Returns how many groups there are,
    /// and stores the group of each corner in [`SurfaceFinder::surfaces`].
    pub fn find_groups(&mut self, v: usize, fan: &[FanCorner], smoothing: Smoothing) -> usize {
        let count = self.find(v, fan);
        if self.is_in_one_group(fan, smoothing) {
            return count;
        }
        let mut keys: Vec<_> = fan
            .iter()
            .zip(&self.surfaces)
            .enumerate()
            .map(|(item, (corner, &surface))| (surface, self.smoothing_group(corner.polygon), item))
            .collect();
        keys.sort_unstable();
        let groups = keys.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
        groups.zip(0..).fold(0, |_, (group, index)| {
            group.iter().for_each(|key| self.surfaces[key.2] = index);
            index as usize + 1
        })
    }

    /// True if smoothing groups do not separate the corners of `fan`.
    fn is_in_one_group(&self, fan: &[FanCorner], smoothing: Smoothing) -> bool {
        let group = |item: &FanCorner| self.smoothing_group(item.polygon);
        smoothing == Smoothing::Surfaces
            || !self.mesh.has_smoothing_groups()
            || fan.iter().all(|item| group(item) == group(&fan[0]))
    }

    /// Returns a key for the smoothing group of a polygon. A faceted polygon's key contains the
    /// polygon, so that it equals no other key.
    fn smoothing_group(&self, polygon: u32) -> (u32, u32) {
        match self.mesh.smoothing_group(polygon as usize) {
            Some(PolygonMesh::FACETED) => (PolygonMesh::FACETED, polygon),
            group => (group.unwrap_or(PolygonMesh::FACETED + 1), 0),
        }
    }

    /// True if a quick test shows that all corners of `fan`, which lie around `v`, make one group.
    /// The test walks around the vertex from polygon to polygon, and gives up if an edge has more
    /// than two. It succeeds for nearly all vertices of nearly all meshes.
    pub fn is_simple(&self, v: usize, fan: &[FanCorner], smoothing: Smoothing) -> bool {
        const MOST: usize = 16;
        let count = fan.len();
        if count == 0 || count > MOST || !self.is_in_one_group(fan, smoothing) {
            return count == 0;
        }
        // The vertices before and after each corner in its polygon.
        let (mut before, mut after) = ([u32::MAX; MOST], [u32::MAX; MOST]);
        for (item, &FanCorner { corner, polygon }) in fan.iter().enumerate() {
            [before[item], after[item]] = self.neighbours(corner, polygon);
            let is_other_part =
                self.mesh.part(polygon as usize) != self.mesh.part(fan[0].polygon as usize);
            if before[item] == v as u32 || after[item] == v as u32 || is_other_part {
                return false;
            }
        }
        // Walk from the first corner until there is no next one or the first one comes again. In
        // the first case walk the other way, too.
        let mut met = 1;
        for (to, from) in [(&after, &before), (&before, &after)] {
            let mut item = 0;
            loop {
                // Bit k is set if entry k equals `other`. Comparing all 16 entries has no branches,
                // and unused entries equal nothing.
                let places = |all: &[u32; MOST]| {
                    let other = to[item];
                    (0..MOST).fold(0u32, |bits, k| bits | u32::from(all[k] == other) << k)
                };
                let (alike, next) = (places(to), places(from));
                // Two polygons leave along this edge, or two arrive: the slow way must pair them.
                if alike.count_ones() > 1 || next.count_ones() > 1 {
                    return false;
                }
                // Without a bit this is 32, past every corner: the edge is open.
                let next = next.trailing_zeros() as usize;
                if next >= count {
                    break;
                }
                if self.is_folded(fan[item].polygon, fan[next].polygon) {
                    return false;
                }
                if next == 0 {
                    // The fan is closed, so there is no other way to walk.
                    return met == count;
                }
                (item, met) = (next, met + 1);
            }
        }
        met == count
    }

    /// Returns the vertices before and after a corner of a polygon.
    fn neighbours(&self, corner: u32, polygon: u32) -> [u32; 2] {
        let range = self.mesh.corner_range(polygon as usize);
        let (corner, first, last) = (corner as usize, range.start, range.end - 1);
        let before = if corner == first { last } else { corner - 1 };
        let after = if corner == last { first } else { corner + 1 };
        [before, after].map(|corner| self.vertex[self.mesh.corners()[corner] as usize])
    }

    /// Finds the surfaces at `v`, which has the corners `fan`. Returns how many there are.
    pub fn find(&mut self, v: usize, fan: &[FanCorner]) -> usize {
        if self.is_simple(v, fan, Smoothing::Surfaces) {
            self.surfaces.clear();
            self.surfaces.resize(fan.len(), 0);
            return usize::from(!fan.is_empty());
        }
        self.parents.clear();
        self.parents.extend(0..fan.len() as u32);
        self.collect_ends(v as u32, fan);
        self.ends.sort_unstable();
        // Taken out so that `link` may borrow the rest; put back below to keep its memory.
        let ends = core::mem::take(&mut self.ends);
        for edge in ends.chunk_by(|a, b| (a.other, a.part) == (b.other, b.part)) {
            // Sorting has put arriving ends before leaving ones.
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
        self.index_surfaces()
    }

    /// Collects the edges at `v` and links the corners of each polygon to each other.
    fn collect_ends(&mut self, v: u32, fan: &[FanCorner]) {
        self.ends.clear();
        for (item, &FanCorner { corner, polygon }) in fan.iter().enumerate() {
            if item > 0 && fan[item - 1].polygon == polygon {
                self.link(item as u32 - 1, item as u32);
            }
            let neighbours = self.neighbours(corner, polygon).into_iter();
            for (other, leaves) in neighbours.zip([false, true]) {
                // An edge without length joins two corners of one polygon, which are linked
                // already.
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

    /// True if two polygons along an edge are the two sides of a sheet.
    fn is_folded(&self, p: u32, q: u32) -> bool {
        self.normals[p as usize].dot(self.normals[q as usize]) < FOLDED
    }

    /// Links the polygons along an edge that has more than one in a direction.
    fn link_pairs(&mut self, fan: &[FanCorner], arriving: &[EdgeEnd], leaving: &[EdgeEnd]) {
        if arriving.len() * leaving.len() > Self::MOST_PAIRS {
            for (a, b) in arriving.iter().zip(leaving) {
                self.link(a.item, b.item);
            }
            return;
        }
        let normal = |end: &EdgeEnd| self.normals[fan[end.item as usize].polygon as usize];
        let mut pairs = Vec::new();
        for (i, a) in arriving.iter().enumerate() {
            for (j, b) in leaving.iter().enumerate() {
                let (p, q) = (normal(a), normal(b));
                // −2 is below every cosine, so that pairs with a polygon without a normal come
                // last.
                let has_both = p != DVec3::ZERO && q != DVec3::ZERO;
                let cosine = if has_both { p.dot(q) } else { -2.0 };
                // Arriving and leaving change places at the other end of the edge. This order is
                // the same at both ends.
                let order = (a.item.min(b.item), a.item.max(b.item));
                pairs.push((cosine, order, (i, j)));
            }
        }
        pairs.sort_unstable_by(|p, q| q.0.total_cmp(&p.0).then((p.1, p.2).cmp(&(q.1, q.2))));
        let (mut has_arrived, mut has_left) =
            (vec![false; arriving.len()], vec![false; leaving.len()]);
        for (cosine, _, (i, j)) in pairs {
            // From −1.5, so that a missing normal (−2) is no rim.
            let is_rim = (-1.5..FOLDED).contains(&cosine);
            if !has_arrived[i] && !has_left[j] && !is_rim {
                (has_arrived[i], has_left[j]) = (true, true);
                self.link(arriving[i].item, leaving[j].item);
            }
        }
    }

    /// Puts two corners on one surface. The first corner of a surface is its root.
    fn link(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }

    /// Returns the first corner on the surface of `item`.
    fn root(&mut self, mut item: u32) -> u32 {
        while self.parents[item as usize] != item {
            // Path halving keeps later walks short.
            let above = self.parents[self.parents[item as usize] as usize];
            self.parents[item as usize] = above;
            item = above;
        }
        item
    }

    /// Stores the index of each corner's surface, by first occurrence. Returns how many surfaces
    /// there are.
    fn index_surfaces(&mut self) -> usize {
        self.surfaces.clear();
        let mut count = 0;
        for item in 0..self.parents.len() as u32 {
            let root = self.root(item);
            // A root comes before every other corner of its surface, so that its index is stored
            // already.
            let index = if root == item {
                count += 1;
                count - 1
            } else {
                self.surfaces[root as usize]
            };
            self.surfaces.push(index);
        }
        count as usize
    }
}
