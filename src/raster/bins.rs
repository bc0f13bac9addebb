//! The bins of the row engine: the polygons that meet each band of scanlines. With them threads
//! draw bands independently.

use crate::frame::{Frame, Polygon, ScreenVertex};
use crate::number::parallel::collect;
use crate::number::vectorized;
use alloc::vec;
use alloc::vec::Vec;

/// How many polygons are sorted into bands together. Chunks are sorted independently of one
/// another.
const CHUNK: usize = 1 << 13;
/// How many polygons are read, and then bounded, together.
const GROUP: usize = 64;

/// A column and a row in sub-pixels.
type Point = [i32; 2];

/// A polygon with its corners, if it is a triangle. A band reads these sequentially. Polygons and
/// their corner lists are scattered over memory, and following them would cost two dependent reads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Listed {
    /// The polygon, an index into [`Frame::polygons`].
    pub index: u32,
    /// The corners of a triangle, or [`Listed::QUADRANGLE`] or [`Listed::OTHER`] for any other
    /// polygon.
    pub corners: [u32; 3],
}

impl Listed {
    /// Marks a quadrangle in place of corners.
    pub const QUADRANGLE: [u32; 3] = [u32::MAX, 4, 4];
    /// Marks a polygon of any other shape in place of corners.
    pub const OTHER: [u32; 3] = [u32::MAX; 3];

    /// Lists polygon `index` of a frame.
    #[cfg(feature = "simd")]
    pub fn new(frame: &Frame, index: u32) -> Self {
        let (corners, _) = read(frame, &frame.polygons()[index as usize]);
        Listed { index, corners }
    }

    /// True if the polygon is a triangle.
    #[inline(always)]
    pub fn is_triangle(&self) -> bool {
        self.corners[0] != Listed::OTHER[0]
    }

    /// True if the polygon is a quadrangle.
    #[inline(always)]
    pub fn is_quadrangle(&self) -> bool {
        self.corners == Listed::QUADRANGLE
    }
}

/// Polygons by band of scanlines, in drawing order within each band. Polygons whose bounding box
/// holds no pixel centre are left out.
#[derive(Debug)]
pub(crate) struct Bins {
    chunks: Vec<BinChunk>,
}

/// Consecutive polygons by band. Behind the last band come those that are in no band.
#[derive(Clone, Debug, Default)]
struct BinChunk {
    starts: Vec<u32>,
    polygons: Vec<Listed>,
}

impl Bins {
    /// Sorts the polygons of `frame` into bands of `height` scanlines, a power of two.
    pub fn new(frame: &Frame, height: usize) -> Self {
        let chunks = frame.polygons().len().div_ceil(CHUNK);
        let chunk = |index| BinChunk::new(frame, height, index * CHUNK);
        Bins {
            chunks: collect(chunks, 1, chunk),
        }
    }

    /// Returns the lists of polygons that may cover pixels of band `band`. Their indices ascend
    /// within each list and from list to list.
    pub fn band(&self, band: usize) -> impl Iterator<Item = &[Listed]> {
        self.chunks.iter().map(move |chunk| {
            &chunk.polygons[chunk.starts[band] as usize..chunk.starts[band + 1] as usize]
        })
    }
}

impl BinChunk {
    /// Sorts one chunk of polygons, which begins at polygon `first`, by counting sort.
    ///
    /// Polygons that are in no band get their own list behind the last band. So nearly every
    /// polygon is written exactly once, and the branch predictor is seldom wrong.
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
                        let index = (first + group * GROUP + k) as u32;
                        let (corners, [a, b, c]) = read(frame, polygon);
                        read_entries[k] = Listed { index, corners };
                        (points[0][k], points[1][k], points[2][k]) = (a, b, c);
                    }
                    entries.extend_from_slice(&read_entries[..polygons.len()]);
                    find_bands(frame, &points, height, &mut ranges, group * GROUP);
                }
                // Counts polygons per band as a difference array: +1 where a polygon begins, −1
                // behind its last band. Prefix sums follow below.
                let [from, end] = &ranges;
                for (&from, &end) in from[..all.len()].iter().zip(end) {
                    starts[usize::from(from)] = starts[usize::from(from)].wrapping_add(1);
                    starts[usize::from(end)] = starts[usize::from(end)].wrapping_sub(1);
                }
            },
        );
        // Two prefix sums in one loop: `here` is how many polygons meet this band, `before` how
        // many entries come before it. Differences may be negative, so sums wrap.
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
            // Most polygons are in one band, and the loop does not run for them.
            put(from, entry);
            for band in from + 1..end {
                put(band, entry);
            }
        }
        BinChunk { starts, polygons }
    }
}

/// Returns the corners for [`Listed`], and three points that have the polygon's bounding box.
#[inline(always)]
fn read(frame: &Frame, polygon: &Polygon) -> ([u32; 3], [Point; 3]) {
    let (vertices, shared) = (frame.vertices(), &frame.geometry.corners[..]);
    let point = |v: u32| position(&vertices[v as usize]);
    let first = polygon.first as usize;
    // The corner list is tried directly. `Frame::corners` would first look for its owner, as pieces
    // of clipped polygons have their lists elsewhere.
    if polygon.count == 3
        && let Some(&[a, b, c]) = shared.get(first..first + 3)
    {
        return ([a, b, c], [point(a), point(b), point(c)]);
    }
    let corners = frame.corners(polygon);
    match *corners {
        [a, b, c] => ([a, b, c], [point(a), point(b), point(c)]),
        [a, b, c, d] => {
            // The least corner of all four, and the greatest corner of each pair: together they
            // have the same box.
            let [ab, cd] = [box_of(point(a), point(b)), box_of(point(c), point(d))];
            (Listed::QUADRANGLE, [box_of(ab[0], cd[0])[0], ab[1], cd[1]])
        }
        _ => {
            let [least, most] = bounds(frame, corners);
            (Listed::OTHER, [least, most, most])
        }
    }
}

/// Stores, for each polygon of a group, the bands of `height` scanlines that hold a pixel centre of
/// its bounding box: the first band, and the one after the last. A polygon whose box holds no
/// centre gets the list behind all bands. Results begin at index `first`.
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
    // Columns and rows are handled alike, one after the other as they stand in memory: one loop
    // that the compiler turns into vectors.
    let [a, b, c] = corners;
    let (a, b, c) = (a.as_flattened(), b.as_flattened(), c.as_flattened());
    for i in 0..2 * GROUP {
        let (least, most) = (a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        // `first_centre` in 32 bits: coordinates are within ±2²³, so the sum does not overflow.
        begin.as_flattened_mut()[i] = ((least + 127) >> 8).max(0);
        stop.as_flattened_mut()[i] = ((most + 127) >> 8).min(limit.as_flattened()[i]);
    }
    let log_height = height.trailing_zeros();
    let nowhere = frame.height().div_ceil(height) as i32;
    let (from, end) = (&mut from[first..][..GROUP], &mut end[first..][..GROUP]);
    for k in 0..GROUP {
        let ([left, top], [right, bottom]) = (begin[k], stop[k]);
        // `&` and not `&&`: a branch here would often be mispredicted.
        let is_there = (left < right) & (top < bottom);
        let band = |row: i32| if is_there { row >> log_height } else { nowhere } as u16;
        (from[k], end[k]) = (band(top), band(bottom - 1) + 1);
    }
}

/// Returns column and row of a vertex in sub-pixels.
#[inline(always)]
fn position(vertex: &ScreenVertex) -> Point {
    [vertex.x.to_bits(), vertex.y.to_bits()]
}

/// Returns the upper left and the lower right corner of the bounding box of two points.
#[inline(always)]
fn box_of(a: Point, b: Point) -> [Point; 2] {
    [
        [a[0].min(b[0]), a[1].min(b[1])],
        [a[0].max(b[0]), a[1].max(b[1])],
    ]
}

/// Returns the upper left and the lower right corner of the bounding box of a polygon of any shape.
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
