//! The bins of the row engine: the polygons that meet each band of scanlines, so that threads can draw bands independently.

use crate::frame::{Frame, Polygon, ScreenVertex};
use crate::number::parallel::collect;
use crate::number::vectorized;
use alloc::vec;
use alloc::vec::Vec;

/// Polygons that are sorted into bands together; chunks are sorted apart from one another.
const CHUNK: usize = 1 << 13;
/// Polygons that are read, and then bounded, together.
const GROUP: usize = 64;

/// A column and a row in sub-pixels.
type Point = [i32; 2];

/// A polygon with its corners, if it is a triangle. Bands read these sequentially; polygons and their corner lists are scattered
/// over memory, and would be two dependent reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Listed {
    /// The number of the polygon.
    pub number: u32,
    /// The corners of a triangle; [`Listed::QUADRANGLE`] or [`Listed::OTHER`] for any other polygon.
    pub corners: [u32; 3],
}

impl Listed {
    /// Stands for the corners of a quadrangle.
    pub const QUADRANGLE: [u32; 3] = [u32::MAX, 4, 4];
    /// Stands for the corners of a polygon that is neither.
    pub const OTHER: [u32; 3] = [u32::MAX; 3];

    /// True if it is a triangle.
    #[inline(always)]
    pub fn is_triangle(&self) -> bool {
        self.corners[0] != Listed::OTHER[0]
    }

    /// True if it is a quadrangle.
    #[inline(always)]
    pub fn is_quadrangle(&self) -> bool {
        self.corners == Listed::QUADRANGLE
    }
}

/// Polygons by band of scanlines, each band's in drawing order. Polygons whose bounding box holds no pixel centre are left out.
#[derive(Debug)]
pub(crate) struct Bins {
    chunks: Vec<BinChunk>,
}

/// Consecutive polygons, by band; after the last band, those that are in none.
#[derive(Clone, Debug, Default)]
struct BinChunk {
    starts: Vec<u32>,
    polygons: Vec<Listed>,
}

impl Bins {
    /// Sorts the polygons of `frame` into bands of `height` scanlines, a power of two.
    pub fn new(frame: &Frame, height: usize) -> Self {
        let chunks = frame.polygons().len().div_ceil(CHUNK);
        let chunk = |number| BinChunk::new(frame, height, number * CHUNK);
        Bins {
            chunks: collect(chunks, 1, chunk),
        }
    }

    /// Returns the polygons that may cover pixels of band `band`, by ascending numbers from list to list and within each.
    pub fn band(&self, band: usize) -> impl Iterator<Item = &[Listed]> {
        self.chunks.iter().map(move |chunk| {
            &chunk.polygons[chunk.starts[band] as usize..chunk.starts[band + 1] as usize]
        })
    }
}

impl BinChunk {
    /// Sorts the polygons from number `first` on: a counting sort. Every polygon is in some list, if only in that of the
    /// polygons that are in no band: most have one place, so that the branch predictor is seldom wrong.
    fn new(frame: &Frame, height: usize, first: usize) -> Self {
        let all = &frame.polygons()[first..];
        let all = &all[..CHUNK.min(all.len())];
        let bands = frame.height().div_ceil(height);
        let mut starts = vec![0u32; bands + 2];
        let mut entries = Vec::with_capacity(all.len());
        let mut ranges = [[0; CHUNK]; 2];
        vectorized(
            #[inline(always)]
            || {
                let mut read_entries = [Listed::default(); GROUP];
                let mut points = [[[0; 2]; GROUP]; 3];
                for (group, polygons) in all.chunks(GROUP).enumerate() {
                    for (k, polygon) in polygons.iter().take(GROUP).enumerate() {
                        let number = (first + group * GROUP + k) as u32;
                        let (corners, [a, b, c]) = read(frame, polygon);
                        read_entries[k] = Listed { number, corners };
                        (points[0][k], points[1][k], points[2][k]) = (a, b, c);
                    }
                    entries.extend_from_slice(&read_entries[..polygons.len()]);
                    find_bands(frame, &points, height, &mut ranges, group * GROUP);
                }
                // A difference array of the polygons per band; prefix sums follow below.
                let [from, end] = &ranges;
                for (&from, &end) in from[..all.len()].iter().zip(end) {
                    starts[usize::from(from)] = starts[usize::from(from)].wrapping_add(1);
                    starts[usize::from(end)] = starts[usize::from(end)].wrapping_sub(1);
                }
            },
        );
        let (mut here, mut before) = (0u32, 0);
        for start in &mut starts {
            here = here.wrapping_add(*start);
            (*start, before) = (before, before + here);
        }
        let mut polygons = vec![Listed::default(); starts[bands + 1] as usize];
        let mut next = starts.clone();
        let mut put = |band: u16, entry: Listed| {
            let place = &mut next[usize::from(band)];
            polygons[*place as usize] = entry;
            *place += 1;
        };
        let [from, end] = &ranges;
        for ((entry, &from), &end) in entries.into_iter().zip(from).zip(end) {
            put(from, entry);
            for band in from + 1..end {
                put(band, entry);
            }
        }
        BinChunk { starts, polygons }
    }
}

/// Returns the corners for [`Listed`], and three points with the bounding box of a polygon.
#[inline(always)]
fn read(frame: &Frame, polygon: &Polygon) -> ([u32; 3], [Point; 3]) {
    let (vertices, shared) = (frame.vertices(), &frame.geometry.corners[..]);
    let point = |v: u32| position(&vertices[v as usize]);
    let first = polygon.first as usize;
    // Without looking for the owner of the corners first, as `Frame::corners` does: those of pieces stand elsewhere.
    if polygon.count == 3
        && let Some(&[a, b, c]) = shared.get(first..first + 3)
    {
        return ([a, b, c], [point(a), point(b), point(c)]);
    }
    let corners = frame.corners(polygon);
    match *corners {
        [a, b, c] => ([a, b, c], [point(a), point(b), point(c)]),
        [a, b, c, d] => {
            let [ab, cd] = [box_of(point(a), point(b)), box_of(point(c), point(d))];
            (Listed::QUADRANGLE, [box_of(ab[0], cd[0])[0], ab[1], cd[1]])
        }
        _ => {
            let [least, most] = bounds(frame, corners);
            (Listed::OTHER, [least, most, most])
        }
    }
}

/// Stores the bands of `height` scanlines whose pixel centres the bounding box of each polygon of a group holds, from place
/// `first` on: the first band and the one after the last, or the one after all bands where it holds no centre.
#[inline(always)]
fn find_bands(
    frame: &Frame,
    corners: &[[Point; GROUP]; 3],
    height: usize,
    [from, end]: &mut [[u16; CHUNK]; 2],
    first: usize,
) {
    let limit = [[frame.width() as i32, frame.height() as i32]; GROUP];
    let (mut begin, mut stop) = ([[0; 2]; GROUP], [[0; 2]; GROUP]);
    // Columns and rows one after the other, as they stand in memory.
    let [a, b, c] = corners;
    let (a, b, c) = (a.as_flattened(), b.as_flattened(), c.as_flattened());
    for i in 0..2 * GROUP {
        let (least, most) = (a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        // `first_centre` in 32 bits: coordinates are within ±2²³.
        begin.as_flattened_mut()[i] = ((least + 127) >> 8).max(0);
        stop.as_flattened_mut()[i] = ((most + 127) >> 8).min(limit.as_flattened()[i]);
    }
    let log_height = height.trailing_zeros();
    let nowhere = frame.height().div_ceil(height) as i32;
    let (from, end) = (&mut from[first..][..GROUP], &mut end[first..][..GROUP]);
    for k in 0..GROUP {
        let ([left, top], [right, bottom]) = (begin[k], stop[k]);
        let is_there = (left < right) & (top < bottom);
        let band = |row: i32| if is_there { row >> log_height } else { nowhere } as u16;
        (from[k], end[k]) = (band(top), band(bottom - 1) + 1);
    }
}

/// Returns the column and the row of a vertex in sub-pixels.
#[inline(always)]
fn position(vertex: &ScreenVertex) -> Point {
    [vertex.x.to_bits(), vertex.y.to_bits()]
}

/// Returns the left upper and the right lower corner of the bounding box of two points.
#[inline(always)]
fn box_of(a: Point, b: Point) -> [Point; 2] {
    [
        [a[0].min(b[0]), a[1].min(b[1])],
        [a[0].max(b[0]), a[1].max(b[1])],
    ]
}

/// Returns the left upper and the right lower corner of the bounding box of a polygon of any shape.
#[inline(never)]
fn bounds(frame: &Frame, corners: &[u32]) -> [Point; 2] {
    let (mut least, mut most) = ([i32::MAX; 2], [i32::MIN; 2]);
    for &corner in corners {
        let [x, y] = position(&frame.vertices()[corner as usize]);
        least = [least[0].min(x), least[1].min(y)];
        most = [most[0].max(x), most[1].max(y)];
    }
    [least, most]
}

#[cfg(test)]
mod tests;
