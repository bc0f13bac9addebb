//! The two ways of covering a triangle against each other, and against crossings of whole polygons.

use super::*;
use crate::frame::{FrameBuilder, Vertex};
use crate::lighting::{Lighting, Material};
use crate::number::{LanesJob, Level, on_level};
use crate::raster::coverage;
use crate::test_random::Random;
use glam::DVec3;
use std::vec;

/// A frame of triangles given by the bits of their corners.
fn frame(width: u32, height: u32, triangles: &[[[i32; 2]; 3]]) -> Frame {
    let mut builder = FrameBuilder::new(width, height);
    let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
    for (number, triangle) in (0..).zip(triangles) {
        let corners = triangle.map(|place| {
            let [x, y] = place.map(SubPixel::from_bits);
            builder.vertex(Vertex { x, y, depth: 0.5, inv_w: 1.0, normal: [0.0, 0.0, 1.0], material })
        });
        builder.polygon(&corners, [0.0, 0.0, 1.0], number);
    }
    builder.finish().expect("corners inside the guard band")
}

/// A triangle that both ways can take: its corners clockwise on the picture, one over twice its area, and where it may cover
/// pixels. `None` where it has no area or no pixel centre.
type Place = ([i32; 3], [i32; 3], f32, Range<i32>, Range<i32>);

fn small_triangle(random: &mut Random) -> Option<Place> {
    // On a grid of half-pixels in one case of two, where centres lie on edges.
    let grid = [1, 128][random.below(2) as usize];
    let mut at = |reach: i32| random.below((reach * 256 / grid) as u64 + 1) as i32 * grid;
    let (left, top) = (at(40) - 5120, at(60) - 3840);
    let mut x = [(); 3].map(|()| left + at(SMALL_WIDTH));
    let mut y = [(); 3].map(|()| top + at(SMALL_HEIGHT - 1));
    let wide = i64::from;
    let area = wide(x[1] - x[0]) * wide(y[2] - y[0]) - wide(x[2] - x[0]) * wide(y[1] - y[0]);
    if area < 0 {
        x.swap(1, 2);
        y.swap(1, 2);
    }
    let ends = |c: [i32; 3]| (c[0].min(c[1]).min(c[2]), c[0].max(c[1]).max(c[2]));
    let ((left, right), (top, bottom)) = (ends(x), ends(y));
    let (columns, rows) = (within(left, right, 0..33), within(top, bottom, 3..50));
    let is_there = area != 0 && !columns.is_empty() && !rows.is_empty();
    is_there.then(|| (x, y, 1.0 / area.abs() as f32, columns, rows))
}

/// The same pixels from both, and the same coordinates to the last bit: they are made of the same integers.
struct BothWays(Place);

impl LanesJob for BothWays {
    type Out = usize;

    fn run<M: Lanes>(self, m: M) -> usize {
        let (x, y, over_area, columns, rows) = self.0;
        let (mut small, mut large) = (Cover::default(), Cover::default());
        small.clear(rows.end as usize);
        large.clear(rows.end as usize);
        let covers = small.small(m, [x, y], over_area, columns.clone(), rows.clone(), 0);
        large.large([x, y], over_area, columns, rows, 0);
        let bits = |cover: &Cover| -> Vec<_> {
            let rows = cover.runs.iter().enumerate();
            rows.flat_map(|(row, runs)| runs.iter().map(move |r| (row, r.start, r.end, r.weights.map(f32::to_bits))))
                .collect()
        };
        let found = bits(&small);
        assert_eq!(found, bits(&large), "{x:?} {y:?}");
        assert_eq!(covers, !found.is_empty());
        found.len()
    }
}

#[test]
fn edge_functions_and_crossings_cover_the_same_pixels() {
    let mut random = Random::new(19);
    for level in Level::available() {
        let places = (0..6000).filter_map(|_| small_triangle(&mut random));
        let covered: Vec<usize> = places.map(|place| on_level(level, BothWays(place))).collect();
        assert!(covered.len() > 1500, "{} triangles", covered.len());
        assert!(covered.iter().sum::<usize>() > 15_000 && covered.contains(&0), "{level}: of all kinds");
    }
}

/// Adds triangles until none is left.
struct Filled<'a>(&'a Frame, Range<usize>);

impl LanesJob for Filled<'_> {
    type Out = Vec<(u32, Range<usize>, usize)>;

    fn run<M: Lanes>(self, m: M) -> Self::Out {
        let Filled(frame, band) = self;
        let numbers: Vec<u32> = (0..frame.polygons().len() as u32).collect();
        let (mut rest, mut found) = (&numbers[..], vec![]);
        let mut cover = Cover::default();
        cover.clear(band.len());
        while !rest.is_empty() {
            let taken = cover.add(m, frame, rest, &band);
            assert!(taken > 0 && taken <= BATCH);
            rest = &rest[taken..];
        }
        for (row, runs) in cover.runs.iter().enumerate() {
            assert!(runs.is_sorted_by_key(|run| run.source), "in drawing order");
            for run in runs {
                let [b, c] = run.weights.map(f64::from);
                // Inside they are in 0..=1, up to four roundings each.
                let out = 8.0 / f64::from(1 << 24);
                assert!(b >= -out && c >= -out && b + c <= 1.0 + out, "{run:?}");
                let number = cover.triangles[run.source as usize].number;
                found.push((number, usize::from(run.start)..usize::from(run.end), band.start + row));
            }
        }
        found
    }
}

/// Triangles of all sizes, in and out of the picture, in bands: together the pixels of the lecture's spans.
#[test]
fn bands_cover_what_spans_do() {
    let mut random = Random::new(23);
    for round in 0..60 {
        let (width, height) = (1 + random.below(90) as usize, 1 + random.below(70) as usize);
        let triangles: Vec<[[i32; 2]; 3]> = (0..150)
            .map(|_| {
                let reach = [3, 20, 200, 20_000][random.below(4) as usize];
                let middle = [width, height].map(|side| random.below(side as u64 * 256) as i32);
                [(); 3].map(|()| middle.map(|at| at + random.below(reach * 256) as i32 - reach as i32 * 128))
            })
            .collect();
        let frame = frame(width as u32, height as u32, &triangles);
        let mut expected = vec![];
        coverage(&frame, |number, row, pixels| expected.push((number, pixels, row)));
        expected.sort_by_key(|(number, pixels, row)| (*row, *number, pixels.start));
        for level in Level::available() {
            let mut found = vec![];
            for first in (0..height).step_by(16) {
                found.extend(on_level(level, Filled(&frame, first..(first + 16).min(height))));
            }
            found.sort_by_key(|(number, pixels, row)| (*row, *number, pixels.start));
            assert_eq!(found, expected, "round {round} on {level}");
        }
    }
}
