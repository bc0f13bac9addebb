//! The bins of the row engine: the polygons that meet each band of scanlines, so that threads can draw bands independently.

use crate::frame::{Frame, Polygon, ScreenVertex};
use crate::number::parallel::collect;
use crate::number::vectorized;
use alloc::vec;
use alloc::vec::Vec;

/// Polygons that are sorted into bands together; chunks are sorted apart from one another.
const CHUNK: usize = 1 << 13;

/// A polygon with its corners, if it is a triangle: bands are read in a row, where polygons and their corner lists are spread
/// over memory, two reads of which the second waits for the first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Listed {
    /// The number of the polygon.
    pub number: u32,
    /// The corners of a triangle; [`Listed::OTHER`] for any other polygon.
    pub corners: [u32; 3],
}

impl Listed {
    /// Stands for the corners of a polygon that is no triangle.
    pub const OTHER: [u32; 3] = [u32::MAX; 3];

    /// True if it is a triangle.
    #[inline(always)]
    pub fn is_triangle(&self) -> bool {
        self.corners[0] != Listed::OTHER[0]
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
        vectorized(
            #[inline(always)]
            || {
                for (number, polygon) in (first as u32..).zip(all) {
                    let (corners, bands) = bands_of(frame, polygon, height);
                    entries.push((Listed { number, corners }, bands));
                    // First by how many polygons each band has more than the one before.
                    let [from, end] = bands.map(usize::from);
                    starts[from] = starts[from].wrapping_add(1);
                    starts[end] = starts[end].wrapping_sub(1);
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
        for (entry, [from, end]) in entries {
            put(from, entry);
            for band in from + 1..end {
                put(band, entry);
            }
        }
        BinChunk { starts, polygons }
    }
}

/// Returns the corners for [`Listed`], and the bands of `height` scanlines whose pixel centres the bounding box of a polygon
/// holds: the first one and the one after the last, or the one after all bands where it holds none. There are at most
/// [`MAX_SIDE`](crate::scene::Scene::MAX_SIDE) bands.
#[inline(always)]
fn bands_of(frame: &Frame, polygon: &Polygon, height: usize) -> ([u32; 3], [u16; 2]) {
    let (vertices, shared) = (frame.vertices(), &frame.geometry.corners[..]);
    let (first, mut corners) = (polygon.first as usize, Listed::OTHER);
    // Without looking for the owner of the corners first, as `Frame::corners` does: those of pieces stand elsewhere.
    let [least, most] = if polygon.count == 3
        && let Some(&[a, b, c]) = shared.get(first..first + 3)
    {
        corners = [a, b, c];
        let (a, b) = (&vertices[a as usize], &vertices[b as usize]);
        let box_of_two = joined([position(a); 2], position(b));
        joined(box_of_two, position(&vertices[c as usize]))
    } else {
        corners = *frame.corners(polygon).as_array().unwrap_or(&corners);
        bounds(frame, polygon)
    };
    // `first_centre` in 32 bits: coordinates are within ±2²³.
    let begin = least.map(|at| ((at + 127) >> 8).max(0));
    let right = ((most[0] + 127) >> 8).min(frame.width() as i32);
    let bottom = ((most[1] + 127) >> 8).min(frame.height() as i32);
    let is_there = (begin[0] < right) & (begin[1] < bottom);
    let (log_height, nowhere) = (
        height.trailing_zeros(),
        frame.height().div_ceil(height) as i32,
    );
    let band = |row: i32| if is_there { row >> log_height } else { nowhere } as u16;
    (corners, [band(begin[1]), band(bottom - 1) + 1])
}

/// Returns the column and the row of a vertex in sub-pixels.
#[inline(always)]
fn position(vertex: &ScreenVertex) -> [i32; 2] {
    [vertex.x.to_bits(), vertex.y.to_bits()]
}

/// Returns a bounding box, its left upper and right lower corner, extended by a point.
#[inline(always)]
fn joined([least, most]: [[i32; 2]; 2], [x, y]: [i32; 2]) -> [[i32; 2]; 2] {
    [
        [least[0].min(x), least[1].min(y)],
        [most[0].max(x), most[1].max(y)],
    ]
}

/// Returns the bounding box of a polygon of any shape.
#[inline(never)]
fn bounds(frame: &Frame, polygon: &Polygon) -> [[i32; 2]; 2] {
    let corners = frame.corners(polygon).iter();
    let points = corners.map(|&corner| position(&frame.vertices()[corner as usize]));
    points.fold([[i32::MAX; 2], [i32::MIN; 2]], joined)
}

#[cfg(test)]
mod tests;
