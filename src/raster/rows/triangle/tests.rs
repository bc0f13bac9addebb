//! The ways of covering a triangle against each other, and against crossings of whole polygons.

use crate::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use crate::lighting::{Lighting, Material};
use crate::number::{Lanes, LanesJob, Level, on_level};
use crate::raster::bins::Listed;
use crate::raster::coverage;
use crate::raster::rows::band::Band;
use crate::raster::rows::batch::{Batch, Kind, MOST, SMALL_HEIGHT, SMALL_WIDTH};
use crate::raster::rows::read::Numbers;
use crate::raster::rows::tiny::Fragments;
use crate::raster::rows::triangle::{Groups, Line, Starts};
use crate::test_random::Random;
use crate::walk::Lerp;
use core::ops::Range;
use glam::DVec3;
use std::vec;
use std::vec::Vec;

/// A frame of triangles given by the bits of their corners.
fn frame(width: u32, height: u32, triangles: &[[[i32; 2]; 3]]) -> Frame {
    let mut builder = FrameBuilder::new(width, height);
    let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
    for (number, triangle) in (0..).zip(triangles) {
        let corners = triangle.map(|place| {
            let [x, y] = place.map(SubPixel::from_bits);
            builder.vertex(Vertex {
                x,
                y,
                depth: 0.5,
                inv_w: 1.0,
                normal: [0.0, 0.0, 1.0],
                material,
            })
        });
        builder.polygon(&corners, [0.0, 0.0, 1.0], number);
    }
    builder.finish().expect("corners inside the guard band")
}

/// A pixel of a triangle, by the number of the triangle, row and column, and the barycentric coordinates of its second and third
/// corner there.
type Pixel = ((u32, usize, usize), [f32; 2]);

/// Every pixel that the triangles of a frame cover in a band: found as runs, and group by group where they are small, and
/// pixel by pixel where they are tiny.
struct Covered<'a>(&'a Frame, Range<usize>);

impl LanesJob for Covered<'_> {
    type Out = [Vec<Pixel>; 3];

    fn run<M: Lanes>(self, m: M) -> [Vec<Pixel>; 3] {
        let Covered(frame, band) = self;
        let listed = |(number, polygon)| Listed {
            number,
            corners: frame.corners(polygon).try_into().unwrap(),
        };
        let polygons: Vec<Listed> = (0..).zip(frame.polygons()).map(listed).collect();
        let (mut rest, mut runs, mut groups, mut tiny) = (&polygons[..], vec![], vec![], vec![]);
        let mut batch = Batch::default();
        while !rest.is_empty() {
            let taken = batch.read(frame, rest);
            assert!(taken > 0 && taken <= rest.len());
            by_pixels(m, (frame, &band), rest, &mut tiny);
            rest = &rest[taken..];
            batch.place(m, frame.width(), &band, false);
            for k in 0..batch.count() {
                let number = batch.polygon(k).0;
                let mut run =
                    |growth: [f32; 2], row: usize, pixels: Range<usize>, weights: [f32; 2]| {
                        for (i, x) in pixels.enumerate() {
                            let at = |c: usize| weights[c] + i as f32 * growth[c];
                            runs.push(((number, band.start + row, x), [at(0), at(1)]));
                        }
                    };
                if batch.kind(k) == Kind::Small as i32 {
                    let small = batch.small(k);
                    small.runs(m, band.start, |row, pixels, weights| {
                        run(small.growth(), row, pixels, weights)
                    });
                    by_groups(m, &batch, k, (frame.width(), &band), &mut groups);
                } else if batch.kind(k) == Kind::Large as i32
                    && let Some(large) = batch.large(k)
                {
                    large.runs(band.start, |row, pixels, weights| {
                        run(large.across(), row, pixels, weights)
                    });
                }
            }
        }
        [runs, groups, tiny]
    }
}

/// The pixels of small triangle `k`, group by group.
fn by_groups<M: Lanes>(
    m: M,
    batch: &Batch,
    k: usize,
    (width, band): (usize, &Range<usize>),
    found: &mut Vec<Pixel>,
) {
    let small = batch.small(k);
    let groups = Groups::new(m, &small);
    let (a_row, a_group) = (1000, 7);
    let coordinates = (2, |i: usize, weights: [M::F; 2]| weights[i]);
    let mut starts = Starts::default();
    for (found, weight) in small
        .weights()
        .into_iter()
        .zip(groups.weights(m, groups.first(m, &small)))
    {
        assert_eq!(
            found,
            m.first(weight),
            "at the first pixel of the first group of the first row"
        );
    }
    groups.rows(
        m,
        (&small, band.start),
        [a_row, a_group],
        &mut starts,
        coordinates,
        |line, starts| {
            let (
                mut here,
                Line {
                    row,
                    groups: range,
                    numbers,
                    of_eight,
                },
            ) = (groups.of_line(m, starts, &line), line);
            let [from, to] = numbers;
            assert!(range.start < range.end || from >= to);
            if range.start < range.end {
                let places =
                    [range.start, range.end].map(|group| (row * a_row + group * a_group) as i32);
                assert_eq!([from, to], places);
            }
            for (value, weight) in starts.values.iter().zip(groups.weights(m, here)) {
                assert_eq!(value[of_eight], m.first(weight), "at the first pixel");
            }
            for group in range {
                let inside = m.bits(m.not_negative(Groups::<M>::outside(here)));
                let mut weights = [[0.0; 8]; 2];
                for (to, from) in weights.iter_mut().zip(groups.weights(m, here)) {
                    m.store(from, to);
                }
                for lane in (0..M::WIDTH).filter(|lane| inside >> lane & 1 == 1) {
                    let x = group * M::WIDTH + lane;
                    // What lies beyond the picture is drawn and never shown.
                    if x < width {
                        found.push((
                            (batch.polygon(k).0, band.start + row, x),
                            [weights[0][lane], weights[1][lane]],
                        ));
                    }
                }
                here = groups.beside(here);
            }
        },
    );
}

/// The pixels of the tiny ones of the first triangles of `polygons`, with a depth and the coordinates for planes.
fn by_pixels<M: Lanes>(
    m: M,
    (frame, band): (&Frame, &Range<usize>),
    polygons: &[Listed],
    found: &mut Vec<Pixel>,
) {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let attributes: Vec<Lerp<[f32; 2]>> = (0..frame.vertices().len())
        .map(|v| Lerp(corners[v % 3]))
        .collect();
    let (mut batch, mut fragments, mut memory) =
        (Batch::default(), Fragments::default(), Band::default());
    batch.read(frame, polygons);
    let drawn = batch.place(m, frame.width(), band, true);
    memory.prepare::<M, [M::F; 2]>(16, frame.width(), false);
    let a_row = frame.width().div_ceil(2 * M::WIDTH) * 2;
    let covering = fragments.find(m, &batch, band.start, memory.layout::<M, [M::F; 2]>());
    assert_eq!(covering & batch.others(), 0);
    batch.read_numbers(
        m,
        frame,
        (Numbers::<_, ()>::Attributes(&attributes), 3),
        covering,
    );
    for k in (0..MOST).filter(|k| covering >> k & 1 != 0) {
        assert_eq!(batch.kind(k), Kind::Tiny as i32);
        fragments.each(m, (&batch, 3), k, |place, values| {
            let (group, lane) = (
                place as usize / (3 * M::WIDTH),
                place as usize % (3 * M::WIDTH),
            );
            let (row, x) = (group / a_row, group % a_row * M::WIDTH + lane);
            assert!(lane < M::WIDTH && drawn.contains(&(x / M::WIDTH)));
            assert_eq!(values[0], 0.5, "the depth");
            found.push((
                (polygons[k].number, band.start + row, x),
                [values[1], values[2]],
            ));
        });
    }
}

/// Triangles of all sizes, in and out of the picture, on a grid of half-pixels in one case of two, where centres lie on edges.
fn soup(random: &mut Random, width: usize, height: usize) -> Vec<[[i32; 2]; 3]> {
    let reaches = [3, 20, SMALL_WIDTH, SMALL_HEIGHT, 200, 20_000];
    (0..150)
        .map(|_| {
            let grid = [1, 128][random.below(2) as usize];
            let reach = reaches[random.below(reaches.len() as u64) as usize] * 256 / grid;
            let middle =
                [width, height].map(|side| random.below(side as u64 * 256) as i32 / grid * grid);
            [(); 3].map(|()| {
                middle.map(|at| at + (random.below(reach as u64 + 1) as i32 - reach / 2) * grid)
            })
        })
        .collect()
}

/// In bands, runs have the pixels of the lecture's spans, groups those of small triangles and fragments those of tiny ones,
/// with the same coordinates.
#[test]
fn bands_cover_what_spans_do() {
    let mut random = Random::new(23);
    let mut counts = [0, 0];
    for round in 0..60 {
        let (width, height) = (
            1 + random.below(120) as usize,
            1 + random.below(90) as usize,
        );
        let frame = frame(
            width as u32,
            height as u32,
            &soup(&mut random, width, height),
        );
        let mut expected = vec![];
        coverage(&frame, |number, row, pixels| {
            expected.extend(pixels.map(|x| (number, row, x)))
        });
        expected.sort_unstable();
        for level in Level::available() {
            let mut found = [vec![], vec![], vec![]];
            for first in (0..height).step_by(16) {
                let more = on_level(level, Covered(&frame, first..(first + 16).min(height)));
                found
                    .iter_mut()
                    .zip(more)
                    .for_each(|(all, more)| all.extend(more));
            }
            found
                .iter_mut()
                .for_each(|all| all.sort_by_key(|(place, _)| *place));
            let [runs, others @ ..] = found;
            assert!(
                runs.iter()
                    .map(|(place, _)| *place)
                    .eq(expected.iter().copied()),
                "round {round} on {level}"
            );
            assert_weights(&runs);
            for (others, count) in others.iter().zip(&mut counts) {
                // A triangle may be tiny in one band, of which it has a row or two, and not in the next.
                let of = |&((number, row, _), _): &Pixel| (number, row / 16);
                let these: std::collections::BTreeSet<_> = others.iter().map(of).collect();
                let same = runs.iter().filter(|pixel| these.contains(&of(pixel)));
                assert!(
                    same.map(|(place, _)| place)
                        .eq(others.iter().map(|(place, _)| place)),
                    "{round} on {level}"
                );
                assert_weights(others);
                *count += others.len();
            }
        }
    }
    assert!(
        counts[0] > 100_000 && counts[1] > 4_000,
        "{counts:?} pixels of small and of tiny triangles"
    );
}

/// Inside, coordinates are in 0..=1: the edge function is rounded once, one over the area twice, their product once, and what was
/// taken off three times, each by half of 2⁻²³ at most; along a run the growth adds as much for its own three and the sum's.
#[track_caller]
fn assert_weights(pixels: &[Pixel]) {
    let out = 12.0 / f64::from(1 << 24);
    for (place, weights) in pixels {
        let [b, c] = weights.map(f64::from);
        assert!(
            b >= -out && c >= -out && b + c <= 1.0 + 2.0 * out,
            "{place:?}: {b} {c}"
        );
    }
}
