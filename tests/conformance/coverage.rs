//! Coverage: a polygon covers exactly the pixels of its definition, and each exactly once.

use crate::support::{Corner, Random, frame, random_polygon};
use fastphong::frame::Frame;
use fastphong::mesh::builtin::builtin;
use fastphong::raster::{self, Edges, NO_POLYGON};
use fastphong::reference;
use fastphong::scene::{Culling, Scene};
use fastphong::shading::Variant;

/// Counts how often each pixel is covered.
fn counts(frame: &Frame) -> Vec<u32> {
    let mut counts = vec![0; frame.width() * frame.height()];
    raster::coverage(frame, |_, row, pixels| {
        for x in pixels {
            counts[row * frame.width() + x] += 1;
        }
    });
    counts
}

/// True if a triangle covers the pixel by a GPU's top-left rule: its centre is inside all three
/// half-spaces, or on a left or top edge.
fn half_space(t: &[Corner], column: i32, row: i32) -> bool {
    let (x, y) = (i64::from(column) * 256 + 128, i64::from(row) * 256 + 128);
    let turn = |a: &Corner, b: &Corner, x: i64, y: i64| {
        let (ax, ay, bx, by) = (
            i64::from(a.x),
            i64::from(a.y),
            i64::from(b.x),
            i64::from(b.y),
        );
        (bx - ax) * (y - ay) - (by - ay) * (x - ax)
    };
    let area = turn(&t[0], &t[1], i64::from(t[2].x), i64::from(t[2].y));
    if area == 0 {
        return false;
    }
    let order: [usize; 3] = if area > 0 { [0, 1, 2] } else { [0, 2, 1] };
    (0..3).all(|i| {
        let (a, b) = (&t[order[i]], &t[order[(i + 1) % 3]]);
        // y points downward, so the order is clockwise in the picture: a top edge runs to the
        // right, a left edge upward.
        let owns = (a.y == b.y && b.x > a.x) || b.y < a.y;
        let side = turn(a, b, x, y);
        side > 0 || (side == 0 && owns)
    })
}

#[test]
fn triangles_follow_the_top_left_rule() {
    let mut random = Random::new(11);
    for _ in 0..3000 {
        let triangle = random_polygon(&mut random, 48, 40, 3);
        let counts = counts(&frame(48, 40, true, std::slice::from_ref(&triangle)));
        for (i, count) in counts.iter().enumerate() {
            let inside = half_space(&triangle, (i % 48) as i32, (i / 48) as i32);
            assert_eq!(
                *count,
                u32::from(inside),
                "{triangle:?} at {}, {}",
                i % 48,
                i / 48
            );
        }
    }
}

/// The engine and the reference share no arithmetic, yet they see the same polygon at every pixel.
/// Polygons are concave, cross themselves or repeat corners. Without a depth test the last polygon
/// wins, so only coverage matters.
#[test]
fn the_engine_covers_what_the_reference_covers() {
    let mut random = Random::new(5);
    for round in 0..400 {
        let polygons: Vec<_> = (0..1 + round % 24)
            .map(|_| {
                let corners = 3 + random.below(14) as usize;
                random_polygon(&mut random, 64, 48, corners)
            })
            .collect();
        let frame = frame(64, 48, false, &polygons);
        assert_eq!(
            raster::polygon_indices(&frame),
            reference::visibility(&frame).polygons,
            "round {round}"
        );
    }
}

/// A randomly distorted tiling with cells of three to eight corners covers every pixel exactly
/// once.
#[test]
fn tilings_cover_every_pixel_once() {
    let mut random = Random::new(3);
    for _ in 0..60 {
        let (columns, rows) = (3 + random.below(9) as i32, 3 + random.below(7) as i32);
        let (w, h) = (64 * 256 / columns, 48 * 256 / rows);
        let mut corner = |i: i32, j: i32| {
            // The rim lies outside the picture. Inner corners move by less than a quarter of a
            // cell, so quads stay convex and can be cut along either diagonal.
            let mut push = |cell: i32, at: i32, last: i32| match at {
                0 => -256,
                _ if at == last => cell * at + 512,
                _ => cell * at + random.below(cell as u64 * 9 / 20) as i32 - cell * 9 / 40,
            };
            let (x, y) = (push(w, i, columns), push(h, j, rows));
            Corner {
                x,
                y,
                depth: 0.5,
                intensity: 1.0,
            }
        };
        let grid: Vec<Vec<Corner>> = (0..=rows)
            .map(|j| (0..=columns).map(|i| corner(i, j)).collect())
            .collect();
        let mut polygons = Vec::new();
        for j in 0..rows as usize {
            let mut i = 0;
            while i < columns as usize {
                // Cells are one, two or three quads wide. Some quads are cut along either diagonal.
                let wide = (1 + random.below(3) as usize).min(columns as usize - i);
                let top = (i..=i + wide).map(|k| grid[j][k]);
                let bottom = (i..=i + wide).rev().map(|k| grid[j + 1][k]);
                let cell: Vec<Corner> = top.chain(bottom).collect();
                match (wide, random.below(3)) {
                    (1, 0) => polygons.extend([
                        vec![cell[0], cell[1], cell[2]],
                        vec![cell[0], cell[2], cell[3]],
                    ]),
                    (1, 1) => polygons.extend([
                        vec![cell[1], cell[2], cell[3]],
                        vec![cell[1], cell[3], cell[0]],
                    ]),
                    _ => polygons.push(cell),
                }
                i += wide;
            }
        }
        let counts = counts(&frame(64, 48, true, &polygons));
        assert!(
            counts.iter().all(|&c| c == 1),
            "{} pixels are not covered once",
            counts.iter().filter(|&&c| c != 1).count()
        );
    }
}

fn seen(spec: &str, culling: Culling) -> Frame {
    let mut scene = Scene::of_mesh(builtin(spec).expect("a built-in mesh"));
    (scene.width, scene.height, scene.culling) = (200, 150, culling);
    scene.frame().expect("a frame")
}

/// A closed mesh covers every pixel an even number of times, half of them by front faces.
#[test]
fn closed_meshes_have_no_holes_and_no_overlaps() {
    for spec in [
        "sphere?rings=12&segments=24",
        "sphere?polygons=3000&triangles=true",
        "torus",
        "gear",
        "prism",
        "cube",
    ] {
        let (front, back) = (
            counts(&seen(spec, Culling::Back)),
            counts(&seen(spec, Culling::Front)),
        );
        let both = counts(&seen(spec, Culling::None));
        assert!(front.iter().any(|&c| c > 0));
        for i in 0..front.len() {
            assert_eq!(
                front[i], back[i],
                "{spec}: what goes in must come out, at pixel {i}"
            );
            assert_eq!(front[i] + back[i], both[i], "{spec} at pixel {i}");
        }
        if !["torus", "gear", "prism"].contains(&spec) {
            assert!(
                front.iter().all(|&c| c <= 1),
                "{spec} is convex: one polygon a pixel"
            );
        }
    }
}

/// The barycentric renderer draws the same pixels. With closed edges, as CS171 prints them, it
/// draws more.
#[test]
fn the_barycentric_renderer_covers_the_same_pixels() {
    let flat = Variant::parse("flat").expect("a method");
    let mut random = Random::new(17);
    let mut more = 0;
    for _ in 0..300 {
        let triangle = random_polygon(&mut random, 48, 40, 3);
        let frame = frame(48, 40, true, &[triangle]);
        let ours = flat.render(&frame).expect("a method for the frame");
        let drawn = |edges| {
            flat.render_barycentric(&frame, edges)
                .expect("flat is one of its methods")
        };
        assert_eq!(ours, drawn(Edges::TopLeft));
        let closed = drawn(Edges::Closed);
        for (a, b) in ours.pixels().iter().zip(closed.pixels()) {
            assert!(a[3] <= b[3], "closed edges lose nothing");
            more += usize::from(a[3] < b[3]);
        }
    }
    assert!(
        more > 0,
        "on the grid of pixel centres closed edges draw more"
    );
}

/// With a depth test the first of two equal polygons wins, because a later one must have strictly
/// less depth. Without one the last wins. All engines agree.
#[test]
fn at_equal_depth_the_first_polygon_is_seen() {
    let corner = |x, y, depth| Corner {
        x: x * 256,
        y: y * 256,
        depth,
        intensity: 0.5,
    };
    let triangle = vec![corner(3, 2, 0.2), corner(44, 9, 0.7), corner(17, 38, 0.4)];
    let flat = Variant::parse("flat").expect("a method");
    for (depth_test, seen) in [(true, 0), (false, 1)] {
        let frame = frame(48, 40, depth_test, &[triangle.clone(), triangle.clone()]);
        let numbers = [
            raster::polygon_indices(&frame),
            raster::barycentric_polygon_indices(&frame, Edges::TopLeft),
            reference::visibility(&frame).polygons,
        ];
        assert!(
            flat.render(&frame)
                .expect("a method for the frame")
                .pixels()
                .iter()
                .any(|t| t[3] > 0)
        );
        for number in numbers.iter().flat_map(|picture| picture.pixels()) {
            assert!(
                [seen, NO_POLYGON].contains(number),
                "depth test {depth_test}: polygon {number} is seen"
            );
        }
    }
}

/// With a depth test, engine and reference differ only where two surfaces meet within the rounding
/// of depth.
#[test]
fn visible_polygons_differ_only_where_surfaces_meet() {
    let mut random = Random::new(23);
    let (mut differing, mut drawn) = (0, 0);
    for _ in 0..60 {
        let polygons: Vec<_> = (0..20)
            .map(|i| random_polygon(&mut random, 64, 48, 3 + i % 5))
            .collect();
        let frame = frame(64, 48, true, &polygons);
        let ours = raster::polygon_indices(&frame);
        let truth = reference::visibility(&frame);
        for y in 0..48 {
            for x in 0..64 {
                drawn += usize::from(truth.polygons.get(x, y) != NO_POLYGON);
                if ours.get(x, y) != truth.polygons.get(x, y) {
                    differing += 1;
                    // Depths lie in 0..1. An edge of at most 48 rows and a span of at most 64
                    // pixels round twice per step, by half a unit in the last place (2^-24). That
                    // makes 224 roundings for each of the two surfaces, and the starts of both
                    // walks add fewer than 32.
                    let gap = truth.depth_gap.get(x, y);
                    assert!(
                        gap <= 2.0 * 256.0 / f64::from(1 << 24),
                        "depth differs by {gap} at {x}, {y}"
                    );
                }
            }
        }
    }
    assert!(
        drawn > 20_000 && differing * 1000 < drawn,
        "{differing} of {drawn} pixels"
    );
}
