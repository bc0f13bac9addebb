//! The polygons of a scene that do not change with the camera, and which of them a camera sees.

use super::view::{BEYOND_PLANES, Codes};
use crate::frame::{FrameStats, Polygon, ScreenVertex};
use crate::parallel::for_each_chunk;
use crate::scene::{Clipping, Culling, Scene};
use alloc::vec::Vec;

/// Words of a chunk of polygons.
const WORDS: usize = 32;
/// Polygons that one thread takes at a time: one a bit.
pub(super) const CHUNK: usize = 64 * WORDS;

/// All polygons of a scene: where their corners are, and what else is known before any camera.
#[derive(Clone, Debug, Default)]
pub(super) struct PolygonTable {
    pub count: usize,
    /// Where the corners of each polygon begin and, last, where those of the last one end; empty where all are triangles.
    pub starts: Vec<u32>,
    /// The lighting of each polygon; empty where all have the first.
    pub materials: Vec<u32>,
    /// One bit a polygon: whether it has a normal. Without one it is never drawn.
    pub has_normal: Vec<u64>,
}

impl PolygonTable {
    /// Where the corners of a polygon begin, and how many there are.
    #[inline(always)]
    pub fn corners(&self, polygon: usize) -> (u32, u32) {
        match self.starts.get(polygon..polygon + 2) {
            Some(&[first, end]) => (first, end - first),
            _ => (3 * polygon as u32, 3),
        }
    }

    #[inline(always)]
    pub fn material(&self, polygon: usize) -> u32 {
        self.materials.get(polygon).copied().unwrap_or(0)
    }
}

/// What is found out of 64 polygons that follow one another: a bit each.
#[derive(Clone, Copy, Debug, Default)]
struct Word {
    /// It is drawn as it is.
    drawn: u64,
    /// It is lit from behind.
    back: u64,
    /// It must be cut.
    cut: u64,
}

/// What is found out of [`CHUNK`] polygons that follow one another.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Chunk {
    words: [Word; WORDS],
    stats: FrameStats,
    /// How many polygons of the frame stand before those of this chunk, pieces included.
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

/// What decides whether a polygon is seen.
pub(super) struct Sight<'a> {
    pub scene: &'a Scene,
    pub table: &'a PolygonTable,
    /// The corner lists of the polygons, all vertices on their first side.
    pub corners: &'a [u32],
    pub vertices: &'a [ScreenVertex],
    /// The planes that each vertex is beyond; `None` where none is beyond any.
    pub codes: Option<&'a [Codes]>,
}

impl Sight<'_> {
    /// Finds out which polygons are seen.
    pub fn find(&self, chunks: &mut Vec<Chunk>) {
        chunks.resize(self.table.count.div_ceil(CHUNK), Chunk::default());
        for_each_chunk(&mut chunks[..], 1, &|number, chunk: &mut [Chunk]| {
            chunk[0] = Chunk::default();
            let end = self.table.count.min((number + 1) * CHUNK);
            for (k, first) in (number * CHUNK..end).step_by(64).enumerate() {
                chunk[0].words[k] = self.word(first, (end - first).min(64), &mut chunk[0].stats);
            }
        });
    }

    /// Finds out of up to 64 polygons from `first` on.
    fn word(&self, first: usize, count: usize, stats: &mut FrameStats) -> Word {
        let all = u64::MAX >> (64 - count);
        let (clockwise, counter_clockwise) =
            if self.table.starts.is_empty() { self.triangles(first, count) } else { self.shapes(first, count) };
        let (outside, beyond) = self.codes.map_or((0, 0), |codes| self.beyond(codes, first, count));
        let has_normal = self.table.has_normal[first / 64];
        let number = |bits: u64| bits.count_ones() as usize;
        stats.polygons += count;
        stats.outside += number(outside);
        let inside = all & !outside;
        stats.zero_area += number(inside & !has_normal);
        let mut cut = inside & has_normal & beyond;
        let whole = inside & has_normal & !beyond;
        if self.scene.clipping == Clipping::NdcCube {
            stats.unprojected += number(cut);
            cut = 0;
        } else {
            stats.clipped += number(cut);
        }
        let culled = match self.scene.culling {
            Culling::Back => clockwise,
            Culling::Front => counter_clockwise,
            Culling::None => 0,
        };
        stats.culled += number(whole & culled);
        stats.zero_area += number(whole & !(clockwise | counter_clockwise));
        // y points downward on the picture: what runs clockwise there has an area over 0, and is seen from behind.
        let back = if self.scene.two_sided { clockwise } else { 0 };
        Word { drawn: whole & (clockwise | counter_clockwise) & !culled, back, cut }
    }

    /// Which of some triangles run clockwise on the picture, and which counter-clockwise.
    fn triangles(&self, first: usize, count: usize) -> (u64, u64) {
        let (mut clockwise, mut counter_clockwise) = (0, 0);
        let corners = self.corners[3 * first..3 * (first + count)].as_chunks::<3>().0;
        for (bit, triangle) in corners.iter().enumerate() {
            let [a, b, c] = triangle.map(|v| {
                let v = &self.vertices[v as usize];
                [v.x, v.y].map(|c| i64::from(c.to_bits()))
            });
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
            clockwise |= u64::from(area > 0) << bit;
            counter_clockwise |= u64::from(area < 0) << bit;
        }
        (clockwise, counter_clockwise)
    }

    /// Likewise of polygons of any shape.
    fn shapes(&self, first: usize, count: usize) -> (u64, u64) {
        let (mut clockwise, mut counter_clockwise) = (0, 0);
        for bit in 0..count {
            let area = doubled_area(self.polygon(first + bit).iter().map(|&v| {
                let v = &self.vertices[v as usize];
                [v.x, v.y]
            }));
            clockwise |= u64::from(area > 0) << bit;
            counter_clockwise |= u64::from(area < 0) << bit;
        }
        (clockwise, counter_clockwise)
    }

    /// Which of some polygons are outside the view, and which have a corner beyond a plane.
    fn beyond(&self, codes: &[Codes], first: usize, count: usize) -> (u64, u64) {
        let (mut outside, mut beyond) = (0, 0);
        let mut found = |bit: usize, all: Codes, any: Codes| {
            outside |= u64::from(all & !BEYOND_PLANES != 0) << bit;
            beyond |= u64::from(any & BEYOND_PLANES != 0) << bit;
        };
        if self.table.starts.is_empty() {
            let corners = self.corners[3 * first..3 * (first + count)].as_chunks::<3>().0;
            for (bit, triangle) in corners.iter().enumerate() {
                let [a, b, c] = triangle.map(|v| codes[v as usize]);
                found(bit, a & b & c, a | b | c);
            }
            return (outside, beyond);
        }
        for bit in 0..count {
            let of_corners = self.polygon(first + bit).iter().map(|&v| codes[v as usize]);
            let (all, any) = of_corners.fold((Codes::MAX, 0), |(all, any), code| (all & code, any | code));
            found(bit, all, any);
        }
        (outside, beyond)
    }

    #[inline(always)]
    fn polygon(&self, polygon: usize) -> &[u32] {
        let (first, count) = self.table.corners(polygon);
        &self.corners[first as usize..][..count as usize]
    }
}

/// Calls `visit` for each polygon that must be cut, in order.
pub(super) fn for_each_cut(chunks: &[Chunk], mut visit: impl FnMut(usize)) {
    for (number, word) in chunks.iter().flat_map(|chunk| &chunk.words).enumerate() {
        let mut cut = word.cut;
        while cut != 0 {
            visit(64 * number + cut.trailing_zeros() as usize);
            cut &= cut - 1;
        }
    }
}

/// Adds up what was counted, and gives each chunk its place in the frame: how many polygons that is.
pub(super) fn add_up(chunks: &mut [Chunk], pieces: &[Piece], stats: &mut FrameStats) -> usize {
    let (mut total, mut piece) = (0, 0);
    for (number, chunk) in chunks.iter_mut().enumerate() {
        (chunk.before, chunk.first_piece) = (total, piece);
        total += chunk.words.iter().map(|word| word.drawn.count_ones() as usize).sum::<usize>();
        let own = pieces[piece..].iter().take_while(|p| (p.source as usize) < (number + 1) * CHUNK).count();
        (total, piece) = (total + own, piece + own);
        for (sum, count) in [
            (&mut stats.polygons, chunk.stats.polygons),
            (&mut stats.culled, chunk.stats.culled),
            (&mut stats.zero_area, chunk.stats.zero_area),
            (&mut stats.outside, chunk.stats.outside),
            (&mut stats.clipped, chunk.stats.clipped),
            (&mut stats.unprojected, chunk.stats.unprojected),
        ] {
            *sum += count;
        }
    }
    total
}

/// Polygons of a frame that are to be written, and the chunks that they come from.
pub(super) struct Filling<'a> {
    pub table: &'a PolygonTable,
    /// How many corners the lists have before those of the second side begin.
    pub corner_count: u32,
    pub pieces: &'a [Piece],
}

impl Filling<'_> {
    /// Writes all polygons that are drawn, in the order of the scene.
    pub fn fill(&self, first: usize, chunks: &[Chunk], out: &mut [Polygon]) {
        match chunks {
            [] => (),
            [chunk] => self.fill_chunk(first, chunk, out),
            _ => {
                let (left, right) = chunks.split_at(chunks.len() / 2);
                let (left_out, right_out) = out.split_at_mut(right[0].before - left[0].before);
                let middle = first + left.len();
                crate::parallel::join(|| self.fill(first, left, left_out), || self.fill(middle, right, right_out));
            }
        }
    }

    fn fill_chunk(&self, number: usize, chunk: &Chunk, out: &mut [Polygon]) {
        let mut out = out.iter_mut();
        let mut put = |polygon| _ = out.next().map(|place| *place = polygon);
        let mut pieces = self.pieces[chunk.first_piece..].iter();
        for (k, word) in chunk.words.iter().enumerate() {
            let mut left = word.drawn | word.cut;
            while left != 0 {
                let bit = left.trailing_zeros();
                left &= left - 1;
                let polygon = number * CHUNK + 64 * k + bit as usize;
                if word.cut >> bit & 1 == 0 {
                    put(self.whole(polygon, word.back >> bit & 1 != 0));
                    continue;
                }
                while let Some(piece) = pieces.as_slice().first().filter(|piece| piece.source as usize == polygon) {
                    put(self.piece(piece));
                    pieces.next();
                }
            }
        }
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
        let &Piece { source, first, count, is_back } = piece;
        Polygon { first, count, material: self.table.material(source as usize), source, face: face(source, is_back) }
    }
}

/// The normal of a polygon, as the frame numbers it.
#[inline(always)]
fn face(source: u32, is_back: bool) -> u32 {
    source | if is_back { Polygon::FLIPPED } else { 0 }
}

/// Twice the signed area on the picture in sub-pixels: y points downward, so counter-clockwise polygons have a negative
/// one. Products have at most 2⁴⁷; 2²⁷ corners of them need more than 64 bits.
pub(super) fn doubled_area(corners: impl Iterator<Item = [crate::frame::SubPixel; 2]> + Clone) -> i128 {
    let following = corners.clone().skip(1).chain(corners.clone().take(1));
    let bits = |c: crate::frame::SubPixel| i64::from(c.to_bits());
    corners.zip(following).map(|([x0, y0], [x1, y1])| i128::from(bits(x0) * bits(y1) - bits(x1) * bits(y0))).sum()
}
