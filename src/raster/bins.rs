//! Which polygons meet which band of scanlines: what lets bands be drawn apart, one thread each.

use crate::frame::{Frame, Polygon, ScreenVertex};
use crate::number::parallel::collect;
use crate::number::vectorized;
use alloc::vec;
use alloc::vec::Vec;

/// Polygons that are sorted into bands together; chunks are sorted apart from one another.
const CHUNK: usize = 1 << 13;
/// Polygons that are read, and then bounded, together.
const GROUP: usize = 64;

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

    /// True if it is a triangle.
    #[inline(always)]
    pub fn is_triangle(&self) -> bool {
        self.corners[0] != Listed::OTHER[0]
    }
}

/// Polygons by band of scanlines, each band's in drawing order. Those that cover no pixel centre by their bounding box are
/// left out.
#[derive(Debug)]
pub(crate) struct Bins {
    chunks: Vec<Chunk>,
}

/// Polygons that follow one another, by band; after the last band, those that are in none.
#[derive(Clone, Debug, Default)]
struct Chunk {
    starts: Vec<u32>,
    polygons: Vec<Listed>,
}

/// The first band of each polygon and the one after its last. There are at most
/// [`MAX_SIDE`](crate::scene::Scene::MAX_SIDE) bands.
type Ranges = [[u16; CHUNK]; 2];

impl Bins {
    /// The polygons of `frame` in bands of `height` scanlines, a power of two.
    pub fn new(frame: &Frame, height: usize) -> Self {
        let chunks = frame.polygons().len().div_ceil(CHUNK);
        Bins {
            chunks: collect(chunks, 1, |number| {
                Chunk::new(frame, height, number * CHUNK)
            }),
        }
    }

    /// The polygons that may cover pixels of band `band`, by ascending numbers from list to list and within each.
    pub fn band(&self, band: usize) -> impl Iterator<Item = &[Listed]> {
        self.chunks.iter().map(move |chunk| {
            &chunk.polygons[chunk.starts[band] as usize..chunk.starts[band + 1] as usize]
        })
    }
}

impl Chunk {
    /// The polygons from number `first` on: a counting sort. Every polygon is in some list, if only in that of those which
    /// are in no band: that most have one place cannot be guessed wrong then.
    fn new(frame: &Frame, height: usize, first: usize) -> Self {
        let all = &frame.polygons()[first..];
        let all = &all[..CHUNK.min(all.len())];
        let bands = frame.height().div_ceil(height);
        let mut ranges = [[0; CHUNK]; 2];
        let mut starts = vec![0u32; bands + 2];
        let mut entries = Vec::with_capacity(all.len());
        vectorized(
            #[inline(always)]
            || {
                find_ranges(frame, first, all, height, &mut ranges, &mut entries);
                count(&ranges, all.len(), &mut starts);
            },
        );
        let mut polygons = vec![Listed::default(); starts[bands + 1] as usize];
        let mut next = starts.clone();
        let mut put = |band: u16, entry: Listed| {
            let place = &mut next[usize::from(band)];
            polygons[*place as usize] = entry;
            *place += 1;
        };
        let [from, end] = &ranges;
        for ((&entry, &from), &end) in entries.iter().zip(from).zip(end) {
            put(from, entry);
            for band in from + 1..end {
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

/// The bands of `height` scanlines whose pixel centres the bounding box of each polygon holds, and what stands for it in their
/// lists; the first polygon has number `number`.
#[inline(always)]
fn find_ranges(
    frame: &Frame,
    number: usize,
    polygons: &[Polygon],
    height: usize,
    ranges: &mut Ranges,
    entries: &mut Vec<Listed>,
) {
    let mut corners = [[[0; 2]; GROUP]; 4];
    let mut read_entries = [Listed::default(); GROUP];
    let (limit, log_height) = (
        [[frame.width() as i32, frame.height() as i32]; GROUP],
        height.trailing_zeros(),
    );
    let nowhere = frame.height().div_ceil(height) as i32;
    let mut first = 0;
    while first < polygons.len() {
        let polygons = &polygons[first..];
        let polygons = &polygons[..polygons.len().min(GROUP)];
        let these_are = read(
            frame,
            (number + first) as u32,
            polygons,
            &mut corners,
            &mut read_entries,
        );
        entries.extend_from_slice(&read_entries[..polygons.len()]);
        // The fourth corner of a triangle is its third one.
        let (begin, end) = if these_are {
            pixels::<3>(&corners, &limit)
        } else {
            pixels::<4>(&corners, &limit)
        };
        let [from, to] = ranges;
        let (from, to) = (
            &mut from[first..first + GROUP],
            &mut to[first..first + GROUP],
        );
        for k in 0..GROUP {
            let ([left, top], [right, bottom]) = (begin[k], end[k]);
            let is_there = (left < right) & (top < bottom);
            from[k] = (if is_there { top >> log_height } else { nowhere }) as u16;
            to[k] = (if is_there {
                (bottom - 1) >> log_height
            } else {
                nowhere
            }) as u16
                + 1;
        }
        first += GROUP;
    }
}

/// Columns and rows, by polygon.
type Places = [[i32; 2]; GROUP];

/// The pixels, of those from 0 to `limit`, whose centres the bounding box of each polygon of at most `MOST` corners holds: the
/// first ones and those after the last.
#[inline(always)]
fn pixels<const MOST: usize>(corners: &[Places; 4], limit: &Places) -> (Places, Places) {
    let (mut begin, mut end) = ([[0; 2]; GROUP], [[0; 2]; GROUP]);
    // Columns and rows alike, one after the other as they stand in memory.
    let (a, b, c, d) = (
        flat(&corners[0]),
        flat(&corners[1]),
        flat(&corners[2]),
        flat(&corners[3]),
    );
    let (limit, to_begin, to_end) = (
        flat(limit),
        begin.as_flattened_mut(),
        end.as_flattened_mut(),
    );
    for i in 0..2 * GROUP {
        let (mut least, mut most) = (a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        if MOST > 3 {
            (least, most) = (least.min(d[i]), most.max(d[i]));
        }
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

/// Reads the places of the corners of polygons, of which there are at most [`GROUP`]. Triangles have their last one twice; those of
/// polygons of more than four corners are two corners of their bounding boxes. What stands for the
/// polygons, from number `number` on, is made of what is read anyway. Gives whether all are triangles.
#[inline(always)]
fn read(
    frame: &Frame,
    number: u32,
    polygons: &[Polygon],
    corners: &mut [Places; 4],
    entries: &mut [Listed; GROUP],
) -> bool {
    let (vertices, shared) = (frame.vertices(), &frame.geometry.corners[..]);
    let mut are_triangles = true;
    for k in 0..polygons.len().min(GROUP) {
        let polygon = &polygons[k];
        let first = polygon.first as usize;
        let mut listed = Listed::OTHER;
        // Without asking first whose corners they are, as `Frame::corners` does: those of pieces stand elsewhere.
        if polygon.count == 3
            && let Some(&[a, b, c]) = shared.get(first..first + 3)
        {
            corners[0][k] = place(&vertices[a as usize]);
            corners[1][k] = place(&vertices[b as usize]);
            corners[2][k] = place(&vertices[c as usize]);
            corners[3][k] = corners[2][k];
            listed = [a, b, c];
        } else if polygon.count == 4
            && let Some(&[a, b, c, d]) = shared.get(first..first + 4)
        {
            corners[0][k] = place(&vertices[a as usize]);
            corners[1][k] = place(&vertices[b as usize]);
            corners[2][k] = place(&vertices[c as usize]);
            corners[3][k] = place(&vertices[d as usize]);
            are_triangles = false;
        } else {
            let [least, most] = bounds(frame, polygon);
            (corners[0][k], corners[1][k], corners[2][k], corners[3][k]) =
                (least, most, most, most);
            listed = *frame.corners(polygon).as_array().unwrap_or(&Listed::OTHER);
            are_triangles &= polygon.count == 3;
        }
        entries[k] = Listed {
            number: number + k as u32,
            corners: listed,
        };
    }
    are_triangles
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
        (least, most) = (
            [least[0].min(x), least[1].min(y)],
            [most[0].max(x), most[1].max(y)],
        );
    }
    [least, most]
}

#[cfg(test)]
mod tests;
