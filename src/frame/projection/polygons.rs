//! The part of a scene's polygons that does not change with the camera, and which polygons a camera
//! sees.

use super::view::{BEYOND_PLANES, Codes};
use super::winding::{self, NO_PLACES, Places};
use crate::frame::{FrameStats, Polygon, ScreenVertex};
use crate::number::parallel::for_each_chunk;
use crate::number::vectorized;
use crate::scene::{Clipping, Culling, Scene};
use alloc::vec::Vec;

/// How many words of bits a chunk of polygons has.
const WORDS: usize = 32;
/// How many polygons one thread takes at a time: one per bit.
pub(super) const CHUNK: usize = 64 * WORDS;

/// All polygons of a scene: their corners, materials and normals, known before there is a camera.
#[derive(Clone, Debug, Default)]
pub(super) struct PolygonTable {
    pub count: usize,
    /// The index of each polygon's first corner and, last, the end of all corners. Empty if all
    /// polygons are triangles.
    pub starts: Vec<u32>,
    /// The lighting of each polygon. Empty if all have the first.
    pub materials: Vec<u32>,
    /// One bit per polygon: 1 if it has a normal. A polygon without one is never drawn.
    pub has_normal: Vec<u64>,
    /// The polygons, in ascending order, that have an area but no normal: see
    /// [`crate::mesh::newell::areas_cancel`].
    pub cancelling: Vec<u32>,
    /// The polygons, in ascending order, whose front is where their corners run clockwise.
    /// Two-sided lighting follows the normals that the mesh has for these corners.
    pub turned: Vec<u32>,
}

impl PolygonTable {
    /// Returns the index of a polygon's first corner, and how many corners it has.
    #[inline(always)]
    pub fn corners(&self, polygon: usize) -> (u32, u32) {
        match self.starts.get(polygon..polygon + 2) {
            Some(&[first, end]) => (first, end - first),
            _ => (3 * polygon as u32, 3),
        }
    }

    /// True if the front of a polygon is where its corners run clockwise.
    pub fn is_turned(&self, polygon: usize) -> bool {
        self.turned.binary_search(&(polygon as u32)).is_ok()
    }

    #[inline(always)]
    pub fn material(&self, polygon: usize) -> u32 {
        self.materials.get(polygon).copied().unwrap_or(0)
    }
}

/// Returns a bit for each of the 64 polygons from `first` on: 1 if it is in the ascending list
/// `polygons`.
#[inline(never)]
fn bits_of(polygons: &[u32], first: usize) -> u64 {
    let after = &polygons[polygons.partition_point(|&p| (p as usize) < first)..];
    let here = after.iter().map(|&p| p as usize - first);
    here.take_while(|&k| k < 64)
        .fold(0, |bits, k| bits | 1 << k)
}

/// The visibility of 64 consecutive polygons, a bit each.
#[derive(Clone, Copy, Debug, Default)]
struct VisibilityWord {
    /// Drawn whole.
    drawn: u64,
    /// Lit from behind.
    back: u64,
    /// To be cut.
    cut: u64,
}

/// The visibility of [`CHUNK`] consecutive polygons.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Chunk {
    words: [VisibilityWord; WORDS],
    stats: FrameStats,
    /// How many polygons of the frame come before this chunk, pieces included.
    before: usize,
    /// The first piece that belongs to this chunk or a later one.
    first_piece: usize,
}

/// A piece of a polygon that was cut.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub source: u32,
    pub first: u32,
    pub count: u32,
    pub is_back: bool,
}

/// A scene as culling reads it: corner lists, vertices on the screen, and the planes that vertices
/// are beyond.
pub(super) struct Sight<'a> {
    pub scene: &'a Scene,
    pub table: &'a PolygonTable,
    /// The corner lists of the polygons, with vertices of the first side.
    pub corners: &'a [u32],
    pub vertices: &'a [ScreenVertex],
    /// The planes that each vertex is beyond; `None` if no vertex is beyond any.
    pub codes: Option<&'a [Codes]>,
}

impl Sight<'_> {
    /// Culls all polygons, on several threads.
    pub fn find(&self, chunks: &mut Vec<Chunk>) {
        chunks.resize(self.table.count.div_ceil(CHUNK), Chunk::default());
        for_each_chunk(&mut chunks[..], 1, &|index, chunk: &mut [Chunk]| {
            chunk[0] = Chunk::default();
            vectorized(
                #[inline(always)]
                || self.chunk(index, &mut chunk[0]),
            );
        });
    }

    /// Culls the polygons of chunk `index`.
    #[inline(always)]
    fn chunk(&self, index: usize, chunk: &mut Chunk) {
        let end = self.table.count.min((index + 1) * CHUNK);
        let mut places = NO_PLACES;
        let (mut first, mut k) = (index * CHUNK, 0);
        while first < end {
            chunk.words[k] = self.word(first, (end - first).min(64), &mut places, &mut chunk.stats);
            (first, k) = (first + 64, k + 1);
        }
    }

    /// Culls up to 64 polygons from `first` on, with a bit for each.
    #[inline(always)]
    fn word(
        &self,
        first: usize,
        count: usize,
        places: &mut Places,
        stats: &mut FrameStats,
    ) -> VisibilityWord {
        // `count` is 1 or more: a shift by 64 would overflow.
        let all = u64::MAX >> (64 - count);
        let (clockwise, counter_clockwise) = if self.table.starts.is_empty() {
            winding::of_triangles(self.triangles(first, count), self.vertices, places)
        } else {
            winding::of_polygons(
                count,
                #[inline(always)]
                |k| self.polygon(first + k),
                self.vertices,
                places,
            )
        };
        let (outside, beyond) = self
            .codes
            .map_or((0, 0), |codes| self.beyond(codes, first, count));
        let has_normal = self.table.has_normal[first / 64];
        let count_of = |bits: u64| bits.count_ones() as usize;
        stats.polygons += count;
        stats.outside += count_of(outside);
        let inside = all & !outside;
        let no_normal = inside & !has_normal;
        let cancelling = match no_normal {
            0 => 0,
            _ => no_normal & bits_of(&self.table.cancelling, first),
        };
        stats.no_area += count_of(no_normal & !cancelling);
        stats.cancelling += count_of(cancelling);
        let mut cut = inside & has_normal & beyond;
        let whole = inside & has_normal & !beyond;
        if self.scene.clipping == Clipping::NdcCube {
            stats.unprojected += count_of(cut);
            cut = 0;
        }
        let culled = match self.scene.culling {
            Culling::Back => clockwise,
            Culling::Front => counter_clockwise,
            Culling::None => 0,
        };
        stats.culled += count_of(whole & culled);
        stats.edge_on += count_of(whole & !(clockwise | counter_clockwise));
        // y points downward on the picture. A polygon that runs clockwise there has an area over 0,
        // and is seen from behind.
        let back = if !self.scene.two_sided {
            0
        } else if self.table.turned.is_empty() {
            clockwise
        } else {
            clockwise ^ bits_of(&self.table.turned, first)
        };
        VisibilityWord {
            drawn: whole & (clockwise | counter_clockwise) & !culled,
            back,
            cut,
        }
    }

    /// Returns a bit for each polygon that is outside the view, and a bit for each that has a
    /// corner beyond a plane.
    #[inline(always)]
    fn beyond(&self, codes: &[Codes], first: usize, count: usize) -> (u64, u64) {
        // The planes that all corners of a polygon are beyond, and the planes that any corner is
        // beyond.
        let (mut all, mut any) = ([0; 64], [0; 64]);
        if self.table.starts.is_empty() {
            for (k, triangle) in self.triangles(first, count.min(64)).iter().enumerate() {
                let [a, b, c] = *triangle;
                let (a, b, c) = (codes[a as usize], codes[b as usize], codes[c as usize]);
                (all[k], any[k]) = (a & b & c, a | b | c);
            }
        } else {
            // The minimum shows the compiler that `k` is in bounds.
            for k in 0..count.min(64) {
                all[k] = Codes::MAX;
                for &v in self.polygon(first + k) {
                    all[k] &= codes[v as usize];
                    any[k] |= codes[v as usize];
                }
            }
        }
        let (mut outside, mut beyond) = ([0; 64], [0; 64]);
        // Flags as bytes in a separate loop, which the compiler turns into vectors. `winding::bits`
        // packs them.
        for k in 0..64 {
            outside[k] = u8::from(all[k] & !BEYOND_PLANES != 0);
            beyond[k] = u8::from(any[k] & BEYOND_PLANES != 0);
        }
        (winding::bits(&outside), winding::bits(&beyond))
    }

    /// Returns the corners of some polygons, if all are triangles.
    #[inline(always)]
    fn triangles(&self, first: usize, count: usize) -> &[[u32; 3]] {
        self.corners[3 * first..3 * (first + count)].as_chunks().0
    }

    #[inline(always)]
    fn polygon(&self, polygon: usize) -> &[u32] {
        let (first, count) = self.table.corners(polygon);
        &self.corners[first as usize..][..count as usize]
    }
}

/// Calls `visit` for each polygon that must be cut, in order.
pub(super) fn for_each_cut(chunks: &[Chunk], mut visit: impl FnMut(usize)) {
    for (index, word) in chunks.iter().flat_map(|chunk| &chunk.words).enumerate() {
        let mut cut = word.cut;
        while cut != 0 {
            visit(64 * index + cut.trailing_zeros() as usize);
            cut &= cut - 1;
        }
    }
}

/// Adds up the counts, and finds where each chunk's polygons belong in the frame. Returns how many
/// polygons the frame has.
pub(super) fn add_up(chunks: &mut [Chunk], pieces: &[Piece], stats: &mut FrameStats) -> usize {
    let (mut total, mut piece) = (0, 0);
    for (index, chunk) in chunks.iter_mut().enumerate() {
        (chunk.before, chunk.first_piece) = (total, piece);
        total += chunk
            .words
            .iter()
            .map(|word| word.drawn.count_ones() as usize)
            .sum::<usize>();
        let own = pieces[piece..]
            .iter()
            .take_while(|p| (p.source as usize) < (index + 1) * CHUNK)
            .count();
        (total, piece) = (total + own, piece + own);
        for (sum, count) in [
            (&mut stats.polygons, chunk.stats.polygons),
            (&mut stats.culled, chunk.stats.culled),
            (&mut stats.no_area, chunk.stats.no_area),
            (&mut stats.cancelling, chunk.stats.cancelling),
            (&mut stats.edge_on, chunk.stats.edge_on),
            (&mut stats.outside, chunk.stats.outside),
            (&mut stats.unprojected, chunk.stats.unprojected),
        ] {
            *sum += count;
        }
    }
    total
}

/// A writer of a frame's polygons from the chunks that have their bits.
pub(super) struct Filling<'a> {
    pub table: &'a PolygonTable,
    /// How many corners there are before the corners of the second side.
    pub corner_count: u32,
    pub pieces: &'a [Piece],
}

impl Filling<'_> {
    /// Writes all visible polygons in the order of the scene. `first` is the index of the first
    /// chunk.
    pub fn fill(&self, first: usize, chunks: &[Chunk], out: &mut [Polygon]) {
        match chunks {
            [] => (),
            [chunk] => vectorized(
                #[inline(always)]
                || self.fill_chunk(first, chunk, out),
            ),
            _ => {
                let (left, right) = chunks.split_at(chunks.len() / 2);
                let (left_out, right_out) = out.split_at_mut(right[0].before - left[0].before);
                let middle = first + left.len();
                crate::number::parallel::join(
                    || self.fill(first, left, left_out),
                    || self.fill(middle, right, right_out),
                );
            }
        }
    }

    #[inline(always)]
    fn fill_chunk(&self, index: usize, chunk: &Chunk, mut out: &mut [Polygon]) {
        let mut pieces = self.pieces[chunk.first_piece..].iter();
        let is_plain = self.table.starts.is_empty() && self.table.materials.is_empty();
        for (k, word) in chunk.words.iter().enumerate() {
            let first = index * CHUNK + 64 * k;
            if word.cut != 0 {
                out = self.fill_cut(first, word, &mut pieces, out);
                continue;
            }
            let (here, rest) = out.split_at_mut(word.drawn.count_ones() as usize);
            if is_plain && word.drawn & word.back == 0 {
                fill_plain(first, word.drawn, here);
            } else {
                self.fill_whole(first, word, here);
            }
            out = rest;
        }
        debug_assert!(out.is_empty(), "every polygon that was counted is written");
    }

    /// Writes the polygons of a word of which none is cut.
    #[inline(always)]
    fn fill_whole(&self, first: usize, word: &VisibilityWord, out: &mut [Polygon]) {
        let mut left = word.drawn;
        for place in out {
            // `out` has a place for each bit, so this is below 64. The mask below spares a check.
            let bit = left.trailing_zeros();
            left &= left.wrapping_sub(1);
            *place = self.whole(first + bit as usize, word.back >> (bit & 63) & 1 != 0);
        }
    }

    /// Writes the polygons of any word, and pieces in place of polygons that were cut. Returns the
    /// rest of `out`.
    #[inline(never)]
    fn fill_cut<'o>(
        &self,
        first: usize,
        word: &VisibilityWord,
        pieces: &mut core::slice::Iter<'_, Piece>,
        out: &'o mut [Polygon],
    ) -> &'o mut [Polygon] {
        let mut out = out.iter_mut();
        let mut put = |polygon| {
            let place = out.next();
            debug_assert!(place.is_some(), "the pieces were counted before");
            _ = place.map(|place| *place = polygon);
        };
        let mut left = word.drawn | word.cut;
        while left != 0 {
            let bit = left.trailing_zeros();
            left &= left - 1;
            let polygon = first + bit as usize;
            if word.cut >> bit & 1 == 0 {
                put(self.whole(polygon, word.back >> bit & 1 != 0));
                continue;
            }
            while let Some(piece) = pieces
                .as_slice()
                .first()
                .filter(|piece| piece.source as usize == polygon)
            {
                put(self.piece(piece));
                pieces.next();
            }
        }
        out.into_slice()
    }

    #[inline(always)]
    fn whole(&self, polygon: usize, is_back: bool) -> Polygon {
        let (first, count) = self.table.corners(polygon);
        let source = polygon as u32;
        Polygon {
            first: first + if is_back { self.corner_count } else { 0 },
            count,
            material: self.table.material(polygon),
            source,
            face: face(source, is_back),
        }
    }

    fn piece(&self, piece: &Piece) -> Polygon {
        let &Piece {
            source,
            first,
            count,
            is_back,
        } = piece;
        Polygon {
            first,
            count,
            material: self.table.material(source as usize),
            source,
            face: face(source, is_back),
        }
    }
}

/// Writes triangles of the first lighting that are seen from the front. A scene of nothing else
/// needs no table.
#[inline(always)]
fn fill_plain(first: usize, drawn: u64, out: &mut [Polygon]) {
    let mut left = drawn;
    // Bits are taken from the lowest on: `left & (left − 1)` clears the lowest one.
    for place in out {
        let source = first as u32 + left.trailing_zeros();
        left &= left.wrapping_sub(1);
        *place = Polygon {
            first: 3 * source,
            count: 3,
            material: 0,
            source,
            face: source,
        };
    }
}

/// Returns the index of a polygon's normal in the frame, with the mark of a normal that is negated.
#[inline(always)]
fn face(source: u32, is_back: bool) -> u32 {
    source | if is_back { Polygon::FLIPPED } else { 0 }
}
