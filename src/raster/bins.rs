//! Which polygons meet which band of scanlines: what lets bands be drawn apart, one thread each.

use crate::frame::{Frame, Polygon, ScreenVertex};
use crate::parallel::collect;
use crate::vectorized::vectorized;
use alloc::vec;
use alloc::vec::Vec;

/// Polygons that are sorted into bands together; chunks are sorted apart from one another.
const CHUNK: usize = 1 << 13;
/// Polygons that are read, and then bounded, together.
const GROUP: usize = 64;

/// What stands for a polygon in the list of a band.
pub(crate) trait Entry: Copy + Default + Send + Sync {
    /// That of polygon `number`.
    fn new(frame: &Frame, number: u32, polygon: &Polygon) -> Self;
}

/// Its number alone.
impl Entry for u32 {
    #[inline(always)]
    fn new(_: &Frame, number: u32, _: &Polygon) -> u32 {
        number
    }
}

/// A polygon with its corners, if it is a triangle. Who reads a band finds them in a row, where polygons and their corner
/// lists are spread over memory: two reads of which the second waits for the first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Listed {
    /// Its number.
    pub number: u32,
    /// Its corners; [`Listed::OTHER`] where there are more of them.
    pub corners: [u32; 3],
}

impl Listed {
    /// Of what is no triangle.
    pub const OTHER: [u32; 3] = [u32::MAX; 3];
}

impl Entry for Listed {
    #[inline(always)]
    fn new(frame: &Frame, number: u32, polygon: &Polygon) -> Listed {
        let corners = if polygon.count == 3 { frame.corners(polygon) } else { &[] };
        Listed { number, corners: corners.try_into().unwrap_or(Listed::OTHER) }
    }
}

/// Polygons by band of scanlines, each band's in drawing order. Those that cover no pixel centre by their bounding box are
/// left out.
#[derive(Debug)]
pub(crate) struct Bins<E> {
    chunks: Vec<Chunk<E>>,
}

/// Polygons that follow one another, by band; after the last band, those that are in none.
#[derive(Clone, Debug, Default)]
struct Chunk<E> {
    starts: Vec<u32>,
    polygons: Vec<E>,
}

/// The first band of each polygon and the one after its last. There are at most
/// [`MAX_SIDE`](crate::scene::Scene::MAX_SIDE) bands.
type Ranges = [[u16; CHUNK]; 2];

impl<E: Entry> Bins<E> {
    /// The polygons of `frame` in bands of `height` scanlines, a power of two.
    pub fn new(frame: &Frame, height: usize) -> Self {
        let chunks = frame.polygons().len().div_ceil(CHUNK);
        Bins { chunks: collect(chunks, 1, |number| Chunk::new(frame, height, number * CHUNK)) }
    }

    /// The polygons that may cover pixels of band `band`, by ascending numbers from list to list and within each.
    pub fn band(&self, band: usize) -> impl Iterator<Item = &[E]> {
        self.chunks
            .iter()
            .map(move |chunk| &chunk.polygons[chunk.starts[band] as usize..chunk.starts[band + 1] as usize])
    }
}

impl<E: Entry> Chunk<E> {
    /// The polygons from number `first` on: a counting sort. Every polygon is in some list, if only in that of those which
    /// are in no band: that most have one place cannot be guessed wrong then.
    fn new(frame: &Frame, height: usize, first: usize) -> Self {
        let all = &frame.polygons()[first..];
        let all = &all[..CHUNK.min(all.len())];
        let bands = frame.height().div_ceil(height);
        let mut ranges = [[0; CHUNK]; 2];
        let mut starts = vec![0u32; bands + 2];
        vectorized(
            #[inline(always)]
            || {
                find_ranges(frame, all, height, &mut ranges);
                count(&ranges, all.len(), &mut starts);
            },
        );
        let mut polygons = vec![E::default(); starts[bands + 1] as usize];
        let mut next = starts.clone();
        let mut put = |band: u16, entry: E| {
            let place = &mut next[usize::from(band)];
            polygons[*place as usize] = entry;
            *place += 1;
        };
        let [from, end] = &ranges;
        for (k, polygon) in all.iter().enumerate() {
            let entry = E::new(frame, (first + k) as u32, polygon);
            put(from[k], entry);
            for band in from[k] + 1..end[k] {
                put(band, entry);
            }
        }
        Chunk { starts, polygons }
    }
}

/// Where the list of each band begins, from which bands each polygon has.
#[inline(always)]
fn count(ranges: &Ranges, polygons: usize, starts: &mut [u32]) {
    // First by how many polygons each band has more than the one before.
    let [from, end] = ranges;
    for (&from, &end) in from[..polygons].iter().zip(&end[..polygons]) {
        starts[usize::from(from)] = starts[usize::from(from)].wrapping_add(1);
        starts[usize::from(end)] = starts[usize::from(end)].wrapping_sub(1);
    }
    let (mut here, mut before) = (0u32, 0);
    for start in starts {
        here = here.wrapping_add(*start);
        (*start, before) = (before, before + here);
    }
}

/// The bands of `height` scanlines whose pixel centres the bounding box of each polygon holds.
#[inline(always)]
fn find_ranges(frame: &Frame, polygons: &[Polygon], height: usize, ranges: &mut Ranges) {
    let mut corners = [[[0; 2]; GROUP]; 4];
    let (limit, log_height) = ([[frame.width() as i32, frame.height() as i32]; GROUP], height.trailing_zeros());
    let nowhere = frame.height().div_ceil(height) as i32;
    let mut first = 0;
    while first < polygons.len() {
        read(frame, &polygons[first..], &mut corners);
        let (begin, end) = pixels(&corners, &limit);
        let [from, to] = ranges;
        let (from, to) = (&mut from[first..first + GROUP], &mut to[first..first + GROUP]);
        for k in 0..GROUP {
            let ([left, top], [right, bottom]) = (begin[k], end[k]);
            let is_there = (left < right) & (top < bottom);
            from[k] = (if is_there { top >> log_height } else { nowhere }) as u16;
            to[k] = (if is_there { (bottom - 1) >> log_height } else { nowhere }) as u16 + 1;
        }
        first += GROUP;
    }
}

/// Columns and rows, by polygon.
type Places = [[i32; 2]; GROUP];

/// The pixels, of those from 0 to `limit`, whose centres the bounding box of each polygon holds: the first ones and those
/// after the last.
#[inline(always)]
fn pixels(corners: &[Places; 4], limit: &Places) -> (Places, Places) {
    let (mut begin, mut end) = ([[0; 2]; GROUP], [[0; 2]; GROUP]);
    // Columns and rows alike, one after the other as they stand in memory.
    let (a, b, c, d) = (flat(&corners[0]), flat(&corners[1]), flat(&corners[2]), flat(&corners[3]));
    let (limit, to_begin, to_end) = (flat(limit), begin.as_flattened_mut(), end.as_flattened_mut());
    for i in 0..2 * GROUP {
        let least = a[i].min(b[i]).min(c[i]).min(d[i]);
        let most = a[i].max(b[i]).max(c[i]).max(d[i]);
        // As `first_centre` has it, in 32 bits: coordinates are within ±2²³.
        to_begin[i] = ((least + 127) >> 8).max(0);
        to_end[i] = ((most + 127) >> 8).min(limit[i]);
    }
    (begin, end)
}

#[inline(always)]
fn flat(places: &Places) -> &[i32] {
    &places.as_flattened()[..2 * GROUP]
}

/// Reads the places of the corners of as many polygons as `corners` has room for, if there are so many. Triangles have their
/// last one twice; those of polygons of more than four corners are two corners of their bounding boxes.
#[inline(always)]
fn read(frame: &Frame, polygons: &[Polygon], corners: &mut [Places; 4]) {
    let (vertices, shared) = (frame.vertices(), &frame.geometry.corners[..]);
    for k in 0..GROUP.min(polygons.len()) {
        let polygon = &polygons[k];
        let first = polygon.first as usize;
        // Without asking first whose corners they are, as `Frame::corners` does: those of pieces stand elsewhere.
        if polygon.count == 3
            && let Some(&[a, b, c]) = shared.get(first..first + 3)
        {
            corners[0][k] = place(&vertices[a as usize]);
            corners[1][k] = place(&vertices[b as usize]);
            corners[2][k] = place(&vertices[c as usize]);
            corners[3][k] = corners[2][k];
        } else if polygon.count == 4
            && let Some(&[a, b, c, d]) = shared.get(first..first + 4)
        {
            corners[0][k] = place(&vertices[a as usize]);
            corners[1][k] = place(&vertices[b as usize]);
            corners[2][k] = place(&vertices[c as usize]);
            corners[3][k] = place(&vertices[d as usize]);
        } else {
            let [least, most] = bounds(frame, polygon);
            (corners[0][k], corners[1][k], corners[2][k], corners[3][k]) = (least, most, most, most);
        }
    }
}

#[inline(always)]
fn place(vertex: &ScreenVertex) -> [i32; 2] {
    [vertex.x.to_bits(), vertex.y.to_bits()]
}

/// The left upper and the right lower corner of the bounding box of a polygon of any shape.
#[inline(never)]
fn bounds(frame: &Frame, polygon: &Polygon) -> [[i32; 2]; 2] {
    let (mut least, mut most) = ([i32::MAX; 2], [i32::MIN; 2]);
    for &corner in frame.corners(polygon) {
        let [x, y] = place(&frame.vertices()[corner as usize]);
        (least, most) = ([least[0].min(x), least[1].min(y)], [most[0].max(x), most[1].max(y)]);
    }
    [least, most]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{FrameBuilder, SubPixel, Vertex};
    use crate::lighting::{Lighting, Material};
    use crate::raster::coverage;
    use crate::test_random::Random;
    use core::ops::Range;
    use glam::DVec3;
    use std::collections::BTreeSet;

    /// `polygons` polygons of three to six corners, in and out of the picture, of which many cover no pixel.
    fn frame(random: &mut Random, polygons: usize, width: usize, height: usize) -> Frame {
        let mut builder = FrameBuilder::new(width as u32, height as u32);
        let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
        for number in 0..polygons {
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
            let (frame, rows) = (frame(&mut random, 80, width, height), [1, 4, 8, 16, 32, 128][round % 6]);
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

    #[test]
    fn triangles_are_listed_with_their_corners() {
        let whole = frame(&mut Random::new(33), 400, 50, 40);
        let pieces = whole.with_pieces(|polygon, put| put(whole.corners(polygon)));
        let mut triangles = 0;
        for frame in [&whole, &pieces] {
            let (numbers, listed): (Bins<u32>, Bins<Listed>) = (Bins::new(frame, 8), Bins::new(frame, 8));
            for band in 0..5 {
                assert!(listed.band(band).flatten().map(|entry| &entry.number).eq(numbers.band(band).flatten()));
                for entry in listed.band(band).flatten() {
                    let corners = frame.corners(&frame.polygons()[entry.number as usize]);
                    triangles += usize::from(corners.len() == 3);
                    assert_eq!(entry.corners, *corners.as_array().unwrap_or(&Listed::OTHER));
                }
            }
        }
        assert!(triangles > 50, "{triangles}");
    }

    /// Also over several chunks, and where corner lists are not those of the scene: as those of pieces.
    #[test]
    fn the_bands_of_a_polygon_are_those_of_its_bounding_box() {
        let mut random = Random::new(32);
        for (count, rows) in [(1, 16), (64, 1), (65, 32), (CHUNK, 16), (2 * CHUNK + 100, 8)] {
            let (width, height) = (1 + random.below(60) as usize, 1 + random.below(70) as usize);
            let whole = frame(&mut random, count, width, height);
            let pieces = whole.with_pieces(|polygon, put| put(whole.corners(polygon)));
            assert_eq!(pieces.cut_corners.len(), whole.geometry.corners.len());
            let [of_whole, of_pieces] = [&whole, &pieces].map(|frame| Bins::new(frame, rows));
            for band in 0..height.div_ceil(rows) {
                let of_band = band * rows..((band + 1) * rows).min(height);
                let expected: Vec<u32> =
                    (0..count as u32).filter(|&number| has_centre(&whole, number, of_band.clone())).collect();
                for bins in [&of_whole, &of_pieces] {
                    let found: Vec<u32> = bins.band(band).flatten().copied().collect();
                    assert!(found == expected, "{count} polygons, band {band} of {rows} rows");
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
