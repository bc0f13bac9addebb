//! Which polygons meet which band of scanlines: what lets bands be drawn apart, one thread each.

use super::edge::first_centre;
use crate::frame::{Frame, Polygon, SubPixel};
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
    /// The polygons of `frame` in bands of `height` scanlines, a power of two.
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
        let ranges: Vec<Range<u32>> =
            all[..CHUNK.min(all.len())].iter().map(|p| bands_of(frame, p, height.trailing_zeros())).collect();
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

/// The bands of 2^`log_height` scanlines whose pixel centres a polygon's bounding box holds.
#[inline(always)]
fn bands_of(frame: &Frame, polygon: &Polygon, log_height: u32) -> Range<u32> {
    let vertices = frame.vertices();
    let corners = frame.corners(polygon);
    let place = |corner: u32| {
        let vertex = &vertices[corner as usize];
        (vertex.x.to_bits(), vertex.y.to_bits())
    };
    // Triangles without a loop: most polygons are some.
    let (mut left, mut right, mut top, mut bottom);
    if let &[a, b, c] = corners {
        let ((xa, ya), (xb, yb), (xc, yc)) = (place(a), place(b), place(c));
        (left, right) = (xa.min(xb).min(xc), xa.max(xb).max(xc));
        (top, bottom) = (ya.min(yb).min(yc), ya.max(yb).max(yc));
    } else {
        (left, right, top, bottom) = (i32::MAX, i32::MIN, i32::MAX, i32::MIN);
        for &corner in corners {
            let (x, y) = place(corner);
            (left, right) = (left.min(x), right.max(x));
            (top, bottom) = (top.min(y), bottom.max(y));
        }
    }
    let within = |from, to, limit: usize| {
        let centre = |bits| first_centre(SubPixel::from_bits(bits));
        let (from, to) = (centre(from).max(0), centre(to).min(limit as i32));
        from as u32..to.max(from) as u32
    };
    let rows = within(top, bottom, frame.height());
    if rows.is_empty() || within(left, right, frame.width()).is_empty() {
        return 0..0;
    }
    rows.start >> log_height..((rows.end - 1) >> log_height) + 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{FrameBuilder, ScreenVertex, Vertex};
    use crate::lighting::{Lighting, Material};
    use crate::raster::coverage;
    use crate::test_random::Random;
    use glam::DVec3;
    use std::collections::BTreeSet;

    /// Polygons of three to six corners, in and out of the picture, of which many cover no pixel.
    fn frame(random: &mut Random, width: usize, height: usize) -> Frame {
        let mut builder = FrameBuilder::new(width as u32, height as u32);
        let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
        for number in 0..80 {
            let reach = [128, 2000, 40_000][number % 3];
            let middle = [width, height].map(|side| random.below(side as u64 * 512) as i32 - side as i32 * 128);
            let corners: Vec<u32> = (0..3 + number % 4)
                .map(|_| {
                    let [x, y] = middle.map(|at| SubPixel::from_bits(at + random.below(reach) as i32));
                    builder.vertex(Vertex { x, y, depth: 0.5, inv_w: 1.0, normal: [0.0, 0.0, 1.0], material })
                })
                .collect();
            builder.polygon(&corners, [0.0, 0.0, 1.0], number as u32);
        }
        builder.finish().expect("corners inside the guard band")
    }

    #[test]
    fn a_band_has_every_polygon_that_covers_any_of_its_pixels_in_order() {
        let mut random = Random::new(31);
        for round in 0..200 {
            let (width, height) = (1 + random.below(60) as usize, 1 + random.below(70) as usize);
            let (frame, rows) = (frame(&mut random, width, height), [1, 4, 8, 16, 32, 128][round % 6]);
            let bins = Bins::new(&frame, rows);
            let mut covering = BTreeSet::new();
            coverage(&frame, |number, row, _| covering.extend([(row / rows, number)]));
            for band in 0..height.div_ceil(rows) {
                let polygons: Vec<u32> = bins.band(band).flatten().copied().collect();
                assert!(polygons.is_sorted_by(|a, b| a < b), "ascending, each once: {polygons:?}");
                let missing = covering.iter().find(|(at, number)| *at == band && !polygons.contains(number));
                assert_eq!(missing, None, "round {round}, bands of {rows}");
                for number in polygons {
                    assert!(has_centre(&frame, number, band * rows..((band + 1) * rows).min(height)), "{number}");
                }
            }
        }
    }

    /// Whether the bounding box of a polygon holds the centre of a pixel of the scanlines `rows`, from left and top on, up to
    /// but not including right and bottom.
    fn has_centre(frame: &Frame, number: u32, rows: Range<usize>) -> bool {
        let corners = frame.corners(&frame.polygons()[number as usize]);
        let all = |of: fn(&ScreenVertex) -> SubPixel| {
            let all = corners.iter().map(|&v| of(&frame.vertices()[v as usize]).to_bits());
            (all.clone().min().unwrap(), all.max().unwrap())
        };
        let holds = |(low, high): (i32, i32), mut pixels: Range<usize>| {
            pixels.any(|p| (low..high).contains(&(256 * p as i32 + 128)))
        };
        holds(all(|v| v.y), rows) && holds(all(|v| v.x), 0..frame.width())
    }
}
