//! Compares the lists of bands with their definition: covered pixels, and bounding boxes that hold
//! a pixel centre.

use super::*;
use crate::frame::{FrameBuilder, SubPixel, Vertex};
use crate::mesh::Material;
use crate::number::test_random::Random;
use crate::raster::coverage;
use crate::scene::Lighting;
use core::ops::Range;
use glam::DVec3;
use std::collections::BTreeSet;

/// Builds a frame of polygons with three to six corners, in and out of the picture. Many cover no
/// pixel.
fn frame(random: &mut Random, polygons: usize, width: usize, height: usize) -> Frame {
    let mut builder = FrameBuilder::new(width as u32, height as u32);
    let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
    for index in 0..polygons {
        let reach = [128, 2000, 40_000][index % 3];
        let middle =
            [width, height].map(|side| random.below(side as u64 * 512) as i32 - side as i32 * 128);
        let corners: Vec<u32> = (0..3 + index % 4)
            .map(|_| {
                let [x, y] = middle.map(|at| SubPixel::from_bits(at + random.below(reach) as i32));
                builder.vertex(Vertex {
                    x,
                    y,
                    depth: 0.5,
                    inv_w: 1.0,
                    normal: [0.0, 0.0, 1.0],
                    material,
                })
            })
            .collect();
        builder.polygon(&corners, [0.0, 0.0, 1.0], index as u32);
    }
    builder.finish().expect("corners inside the guard band")
}

#[test]
fn a_band_has_every_polygon_that_covers_any_of_its_pixels_in_order() {
    let mut random = Random::new(31);
    for round in 0..200 {
        let (width, height) = (1 + random.below(60) as usize, 1 + random.below(70) as usize);
        let (frame, rows) = (
            frame(&mut random, 80, width, height),
            [1, 4, 8, 16, 32, 128][round % 6],
        );
        let bins = Bins::new(&frame, rows);
        let mut covering = BTreeSet::new();
        coverage(&frame, |index, row, _| {
            covering.extend([(row / rows, index)])
        });
        for band in 0..height.div_ceil(rows) {
            let polygons: Vec<u32> = bins.band(band).flatten().map(|entry| entry.index).collect();
            assert!(
                polygons.is_sorted_by(|a, b| a < b),
                "ascending, each once: {polygons:?}"
            );
            let missing = covering
                .iter()
                .find(|(at, index)| *at == band && !polygons.contains(index));
            assert_eq!(missing, None, "round {round}, bands of {rows}");
            for index in polygons {
                assert!(
                    has_centre(&frame, index, band * rows..((band + 1) * rows).min(height)),
                    "{index}"
                );
            }
        }
    }
}

/// Triangles are told apart from other polygons, also in groups behind one with other shapes, and
/// in a list with all chunks.
#[test]
fn triangles_are_distinguished_from_other_polygons() {
    for count in [1, 64, CHUNK + 65] {
        for other in [None, Some(0), Some(count / 2), Some(count - 1)] {
            for corners in [4, 5] {
                let mut builder = FrameBuilder::new(8, 8);
                let material =
                    builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
                for index in 0..count {
                    let corners: Vec<u32> = (0..if Some(index) == other { corners } else { 3 })
                        .map(|corner| {
                            let [x, y] = [[0, 0], [900, 0], [900, 900], [500, 950], [0, 900]]
                                [corner]
                                .map(SubPixel::from_bits);
                            builder.vertex(Vertex {
                                x,
                                y,
                                depth: 0.5,
                                inv_w: 1.0,
                                normal: [0.0, 0.0, 1.0],
                                material,
                            })
                        })
                        .collect();
                    builder.polygon(&corners, [0.0, 0.0, 1.0], index as u32);
                }
                let whole = builder.finish().expect("corners inside the guard band");
                let pieces = whole.with_pieces(|polygon, put| put(whole.corners(polygon)));
                for frame in [&whole, &pieces] {
                    let bins = Bins::new(frame, 8);
                    let others = bins
                        .band(0)
                        .flatten()
                        .filter(|entry| !entry.is_triangle())
                        .map(|entry| entry.index as usize);
                    assert!(others.eq(other), "{other:?} of {count}");
                }
            }
        }
    }
}

#[test]
fn triangles_are_listed_with_their_corners_and_quadrangles_as_such() {
    let whole = frame(&mut Random::new(33), 400, 50, 40);
    let pieces = whole.with_pieces(|polygon, put| put(whole.corners(polygon)));
    let (mut triangles, mut quadrangles) = (0, 0);
    for frame in [&whole, &pieces] {
        let bins = Bins::new(frame, 8);
        for band in 0..5 {
            for entry in bins.band(band).flatten() {
                let corners = frame.corners(&frame.polygons()[entry.index as usize]);
                triangles += usize::from(corners.len() == 3);
                quadrangles += usize::from(corners.len() == 4);
                let expected = match *corners {
                    [a, b, c] => [a, b, c],
                    [_, _, _, _] => Listed::QUADRANGLE,
                    _ => Listed::OTHER,
                };
                assert_eq!(entry.corners, expected);
                assert_eq!(entry.is_triangle(), corners.len() == 3);
                assert_eq!(entry.is_quadrangle(), corners.len() == 4);
            }
        }
    }
    assert!(
        triangles > 50 && quadrangles > 50,
        "{triangles}, {quadrangles}"
    );
}

/// A polygon is listed in the bands of its bounding box, also over several chunks, and in frames of
/// pieces, which have their own corner lists.
#[test]
fn polygons_are_listed_in_the_bands_of_their_bounds() {
    let mut random = Random::new(32);
    for (count, rows) in [
        (1, 16),
        (64, 1),
        (65, 32),
        (CHUNK, 16),
        (2 * CHUNK + 100, 8),
    ] {
        let (width, height) = (1 + random.below(60) as usize, 1 + random.below(70) as usize);
        let whole = frame(&mut random, count, width, height);
        let pieces = whole.with_pieces(|polygon, put| put(whole.corners(polygon)));
        assert_eq!(pieces.cut_corners.len(), whole.geometry.corners.len());
        let [of_whole, of_pieces] = [&whole, &pieces].map(|frame| Bins::new(frame, rows));
        for band in 0..height.div_ceil(rows) {
            let of_band = band * rows..((band + 1) * rows).min(height);
            let expected: Vec<u32> = (0..count as u32)
                .filter(|&index| has_centre(&whole, index, of_band.clone()))
                .collect();
            for bins in [&of_whole, &of_pieces] {
                let found: Vec<u32> = bins.band(band).flatten().map(|entry| entry.index).collect();
                assert!(
                    found == expected,
                    "{count} polygons, band {band} of {rows} rows"
                );
            }
        }
    }
}

/// True if the bounding box of a polygon holds a pixel centre in the scanlines `rows`. The box
/// includes its left and top sides and excludes its right and bottom sides.
fn has_centre(frame: &Frame, index: u32, rows: Range<usize>) -> bool {
    let corners = frame.corners(&frame.polygons()[index as usize]);
    let all = |of: fn(&ScreenVertex) -> SubPixel| {
        let all = corners
            .iter()
            .map(|&v| of(&frame.vertices()[v as usize]).to_bits());
        (all.clone().min().unwrap(), all.max().unwrap())
    };
    let holds = |(low, high): (i32, i32), mut pixels: Range<usize>| {
        pixels.any(|p| (low..high).contains(&(256 * p as i32 + 128)))
    };
    holds(all(|v| v.y), rows) && holds(all(|v| v.x), 0..frame.width())
}
