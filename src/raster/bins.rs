//! Which polygons meet which band of scanlines: what lets bands be drawn apart, one thread each.

use super::edge::first_centre;
use crate::frame::{Frame, Polygon};
use crate::parallel::collect;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

/// Polygons that are sorted into bands together; chunks are sorted apart from one another.
const CHUNK: usize = 1 << 13;

/// Polygons by band of scanlines, each band's in drawing order. Those that cover no pixel centre by their bounding box are
/// left out.
#[derive(Debug)]
pub(crate) struct Bins {
    chunks: Vec<Chunk>,
}

/// Polygons that follow one another, by band.
#[derive(Clone, Debug, Default)]
struct Chunk {
    starts: Vec<u32>,
    polygons: Vec<u32>,
}

impl Bins {
    /// The polygons of `frame` in bands of `height` scanlines.
    pub fn new(frame: &Frame, height: usize) -> Self {
        let chunks = frame.polygons().len().div_ceil(CHUNK);
        Bins { chunks: collect(chunks, 1, |number| Chunk::new(frame, height, number * CHUNK)) }
    }

    /// The numbers of the polygons that may cover pixels of band `band`, ascending from list to list and within each.
    pub fn band(&self, band: usize) -> impl Iterator<Item = &[u32]> {
        self.chunks
            .iter()
            .map(move |chunk| &chunk.polygons[chunk.starts[band] as usize..chunk.starts[band + 1] as usize])
    }
}

impl Chunk {
    /// The polygons from number `first` on: a counting sort.
    fn new(frame: &Frame, height: usize, first: usize) -> Self {
        let all = &frame.polygons()[first..];
        let bands = frame.height().div_ceil(height);
        let mut starts = vec![0u32; bands + 1];
        let ranges: Vec<Range<u32>> = all[..CHUNK.min(all.len())].iter().map(|p| bands_of(frame, p, height)).collect();
        for range in &ranges {
            for band in range.clone() {
                starts[band as usize + 1] += 1;
            }
        }
        for band in 0..bands {
            starts[band + 1] += starts[band];
        }
        let mut polygons = vec![0u32; starts[bands] as usize];
        let mut next = starts.clone();
        for (number, range) in (first as u32..).zip(ranges) {
            for band in range {
                let place = &mut next[band as usize];
                polygons[*place as usize] = number;
                *place += 1;
            }
        }
        Chunk { starts, polygons }
    }
}

/// The bands whose pixel centres a polygon's bounding box holds.
#[inline(always)]
fn bands_of(frame: &Frame, polygon: &Polygon, height: usize) -> Range<u32> {
    let vertices = frame.vertices();
    let corners = frame.corners(polygon);
    let first = &vertices[corners[0] as usize];
    let (mut left, mut right, mut top, mut bottom) = (first.x, first.x, first.y, first.y);
    for &corner in &corners[1..] {
        let v = &vertices[corner as usize];
        (left, right) = (left.min(v.x), right.max(v.x));
        (top, bottom) = (top.min(v.y), bottom.max(v.y));
    }
    let within = |from, to, limit: usize| {
        let (from, to) = (first_centre(from).max(0), first_centre(to).min(limit as i32));
        from as u32..to.max(from) as u32
    };
    let rows = within(top, bottom, frame.height());
    if rows.is_empty() || within(left, right, frame.width()).is_empty() {
        return 0..0;
    }
    rows.start / height as u32..(rows.end - 1) / height as u32 + 1
}
