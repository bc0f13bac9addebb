//! Supersampling: each sample is depth-tested and shaded, then samples are filtered in linear
//! light.

use crate::support;
use crate::support::floats_on;
use crate::support::{Corner, add, linear, plain_lighting};
use fastphong::compare::metrics::compare_where;
use fastphong::frame::triangulate::triangulated;
use fastphong::frame::{Frame, FrameBuilder, FrameError};
use fastphong::picture::encoding::{quantise, srgb_encode};
use fastphong::picture::{Alpha, Encoding, LinearPicture, Picture, over};
use fastphong::raster::{self, DrawOptions, Edges};
use fastphong::reference::{self, Model};
use fastphong::scene::Scene;
use fastphong::shading::Variant;

const BACKGROUND: [f32; 3] = [0.25, 0.5, 0.125];

/// Builds a frame of `side` × `side` pixels with n × n samples and one polygon. Its corners are in
/// samples.
fn frame(side: u32, n: u32, encoding: Encoding, corners: &[(f64, f64)], intensity: f32) -> Frame {
    let mut builder = FrameBuilder::new(side * n, side * n);
    builder.samples(n).background(BACKGROUND).encoding(encoding);
    let material = builder.lighting(plain_lighting());
    let corner = |&(x, y): &(f64, f64)| Corner {
        x: (x * 256.0) as i32,
        y: (y * 256.0) as i32,
        depth: 0.5,
        intensity,
    };
    add(
        &mut builder,
        material,
        0,
        &corners.iter().map(corner).collect::<Vec<_>>(),
    );
    builder.finish().expect("a frame")
}

/// Renders a frame of triangles by both engines and the reference.
fn pictures(frame: &Frame) -> [LinearPicture; 3] {
    let gouraud = Variant::parse("gouraud").expect("a method");
    let triangles = triangulated(frame).frame;
    [
        gouraud
            .render_linear(frame)
            .expect("a method for the frame"),
        gouraud
            .render_barycentric_linear(&triangles, Edges::TopLeft)
            .expect("gouraud is one of its methods"),
        reference::render(frame, Model::Gouraud).to_linear(),
    ]
}

/// Returns the frame with its pictures flattened over its background.
fn flattened(frame: &Frame) -> Frame {
    let mut frame = frame.clone();
    frame.set_alpha(Alpha::Flattened);
    frame
}

/// A builder's kind of alpha draws as the one that is set on the frame, and stays when the builder
/// is emptied.
#[test]
fn a_builder_keeps_the_kind_of_alpha() {
    let corners = [(1.5, 2.0), (20.0, 5.0), (9.0, 21.0)];
    let straight = frame(6, 4, Encoding::Linear, &corners, 0.7);
    let mut builder = FrameBuilder::new(24, 24);
    builder.samples(4).background(BACKGROUND);
    let material = builder.lighting(plain_lighting());
    builder.alpha(Alpha::Flattened).clear();
    let corner = |(x, y): (f64, f64)| Corner {
        x: (x * 256.0) as i32,
        y: (y * 256.0) as i32,
        depth: 0.5,
        intensity: 0.7,
    };
    add(&mut builder, material, 0, &corners.map(corner));
    let lent = builder.frame().expect("a frame");
    assert_eq!(
        (straight.alpha(), lent.alpha()),
        (Alpha::Straight, Alpha::Flattened)
    );
    assert_eq!(pictures(lent), pictures(&flattened(&straight)));
    assert_ne!(pictures(lent), pictures(&straight));
}

/// Filtering keeps a constant picture constant to the last bit, for every count of samples.
#[test]
fn a_constant_picture_stays_constant() {
    for n in [1, 2, 4, 8] {
        let s = f64::from(6 * n);
        for intensity in [0.1, 1.0 / 3.0, 0.7, 1.0] {
            let all = [
                (-1.0, -1.0),
                (s + 1.0, -1.0),
                (s + 1.0, s + 1.0),
                (-1.0, s + 1.0),
            ];
            let frame = frame(6, n, Encoding::Linear, &all, intensity);
            let picture = Variant::parse("flat")
                .expect("a method")
                .render_linear(&frame)
                .expect("a method for the frame");
            assert_eq!((picture.width(), picture.height()), (6, 6));
            let face = picture.get(0, 0);
            // The face normal of `add` points into the light, but the corner normals do not.
            assert_eq!(face, [1.0; 4]);
            assert!(picture.pixels().iter().all(|t| *t == face));
            for picture in pictures(&frame) {
                let first = picture.get(0, 0);
                // z of the normal is `intensity` rounded, and each engine rounds it a few more
                // times.
                assert!((first[0] - intensity).abs() < 1e-6 && first[3] == 1.0);
                assert!(
                    picture
                        .pixels()
                        .iter()
                        .all(|t| (t[0] - first[0]).abs() < 1e-6 && t[3] == 1.0)
                );
            }
        }
        let empty = frame(
            6,
            n,
            Encoding::Linear,
            &[(-9.0, -9.0), (-8.0, -9.0), (-8.0, -8.0)],
            1.0,
        );
        for picture in pictures(&empty) {
            assert!(
                picture
                    .pixels()
                    .iter()
                    .all(|t| *t == [0.25, 0.5, 0.125, 0.0]),
                "{n}"
            );
        }
    }
}

/// A pixel on an edge has exactly the share of its covered samples. One edge is upright, k samples
/// into pixel 2. The other is a diagonal through pixel corners and the centres of n samples per
/// pixel, which belong to the right side.
#[test]
fn a_pixel_on_an_edge_has_the_exact_share() {
    for n in [2u32, 4, 8] {
        let s = f64::from(6 * n);
        let mix = |share: f32, c: usize| share + (1.0 - share) * BACKGROUND[c];
        for k in 0..n {
            let x = f64::from(2 * n + k);
            let frame = frame(
                6,
                n,
                Encoding::Linear,
                &[(x, 0.0), (s, 0.0), (s, s), (x, s)],
                1.0,
            );
            let share = (n - k) as f32 / n as f32;
            for picture in pictures(&flattened(&frame)) {
                // All values here are multiples of 1/64, so nothing is rounded.
                assert_eq!(
                    picture.get(2, 3),
                    [mix(share, 0), mix(share, 1), mix(share, 2), share],
                    "{k} of {n}"
                );
                assert_eq!((picture.get(1, 3)[3], picture.get(3, 3)[3]), (0.0, 1.0));
            }
            for picture in pictures(&frame) {
                assert_eq!(picture.get(2, 3), [1.0, 1.0, 1.0, share], "{k} of {n}");
            }
        }
        let frame = frame(6, n, Encoding::Linear, &[(0.0, 0.0), (s, 0.0), (s, s)], 1.0);
        let share = (n * (n + 1) / 2) as f32 / (n * n) as f32;
        for picture in pictures(&flattened(&frame)) {
            for i in 0..6 {
                assert_eq!(
                    picture.get(i, i),
                    [mix(share, 0), mix(share, 1), mix(share, 2), share],
                    "{n}"
                );
            }
        }
    }
}

/// Samples are averaged in linear light, and the mean is encoded afterwards.
#[test]
fn samples_are_filtered_before_they_are_encoded() {
    let n = 4;
    let s = f64::from(6 * n);
    let half = [
        (f64::from(2 * n + n / 2), 0.0),
        (s, 0.0),
        (s, s),
        (f64::from(2 * n + n / 2), s),
    ];
    let frame = flattened(&frame(6, n, Encoding::Srgb, &half, 1.0));
    let gouraud = Variant::parse("gouraud").expect("a method");
    let expected = [0, 1, 2].map(|c| quantise(srgb_encode(0.5 + 0.5 * BACKGROUND[c])));
    let means_of_encoded = [0, 1, 2].map(|c| quantise(0.5 + 0.5 * srgb_encode(BACKGROUND[c])));
    assert!(
        (0..3).all(|c| expected[c] != means_of_encoded[c]),
        "the two can be told apart"
    );
    let barycentric = gouraud
        .render_barycentric(&triangulated(&frame).frame, Edges::TopLeft)
        .expect("has gouraud");
    for picture in [
        gouraud.render(&frame).expect("a method for the frame"),
        barycentric,
    ] {
        let [r, g, b, alpha] = picture.get(2, 3);
        assert_eq!(
            ([r, g, b], alpha),
            (expected, 128),
            "alpha has no transfer function"
        );
    }
}

fn supersampled(name: &str, size: (i64, i64), n: u32) -> Frame {
    let mut scene = support::scene(name, Some(size));
    scene.samples = n;
    scene.frame().expect("a frame")
}

/// For every method a supersampled picture equals the mean of the picture n times as large, bit by
/// bit. So each sample is depth-tested and shaded.
#[test]
fn every_sample_is_shaded() {
    for n in [2usize, 4] {
        let frame = flattened(&supersampled("coarse-sphere", (48, 36), n as u32));
        let (w, h) = (48 * n as i64, 36 * n as i64);
        let large = supersampled("coarse-sphere", (w, h), 1);
        for entry in floats_on(&frame) {
            let (small, large) = (linear(entry, &frame), linear(entry, &large));
            for (x, y) in (0..36).flat_map(|y| (0..48).map(move |x| (x, y))) {
                let mut mean = [0.0f64; 4];
                for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
                    let sample = large.get(n * x + i, n * y + j);
                    // A sum of 16 values of 24 bits is exact in 53 bits.
                    mean = std::array::from_fn(|c| mean[c] + f64::from(sample[c]));
                }
                let mean = mean.map(|sum| (sum / (n * n) as f64) as f32);
                assert_eq!(small.get(x, y), mean, "{} at {x}, {y}", entry.info.name);
            }
            let stored = entry
                .variant()
                .render(&frame)
                .expect("a method for the frame");
            assert_eq!(
                stored,
                small.map(|pixel| pixel.map(quantise)),
                "{}",
                entry.info.name
            );
            let mut reused = Picture::new(48, 36, [9; 4]);
            let drawn = entry
                .variant()
                .draw(&frame, &mut reused, DrawOptions::default());
            drawn.expect("a picture of the frame's size");
            assert_eq!(stored, reused, "{}", entry.info.name);
        }
    }
}

/// By every engine, the colour of a rim is the mean of its covered samples, without the bright
/// background. Put over that background, it equals the picture that was filtered over it: rims are
/// neither dark nor bright.
#[test]
fn a_supersampled_rim_has_straight_alpha_without_the_background() {
    let n = 4;
    let scene = |size: (i64, i64), samples: u32| {
        let mut scene = support::scene("coarse-sphere", Some(size));
        (scene.background, scene.samples) = ([1.0, 0.75, 0.5], samples);
        scene.frame().expect("a frame")
    };
    let (frame, samples) = (scene((24, 18), n), scene((96, 72), 1));
    let side = n as usize;
    let (pictures, flat) = (pictures(&frame), pictures(&flattened(&frame)));
    let of_samples = self::pictures(&samples);
    let mut rims = 0;
    for ((picture, flat), samples) in pictures.iter().zip(&flat).zip(&of_samples) {
        for (x, y) in (0..18).flat_map(|y| (0..24).map(move |x| (x, y))) {
            let [r, g, b, alpha] = picture.get(x, y).map(f64::from);
            let places = (0..side * side).map(|i| (x * side + i % side, y * side + i / side));
            let covered: Vec<_> = places
                .map(|(x, y)| samples.get(x, y))
                .filter(|sample| sample[3] > 0.0)
                .collect();
            assert_eq!(alpha, covered.len() as f64 / 16.0);
            if covered.is_empty() {
                assert_eq!([r, g, b], [1.0, 0.75, 0.5]);
                continue;
            }
            rims += usize::from(alpha < 1.0);
            for (c, value) in [r, g, b].into_iter().enumerate() {
                let sum: f64 = covered.iter().map(|sample| f64::from(sample[c])).sum();
                // For values up to 1 the engines round the mean once, by 2^-25. The reference's
                // samples are rounded here, and so is its mean.
                let difference = (value - sum / covered.len() as f64).abs();
                assert!(
                    difference <= 2.0 / f64::from(1 << 25),
                    "{difference:e} at {x}, {y}"
                );
            }
            // The straight mean is rounded once and scaled by alpha, which is at most 1. The flat
            // mean is rounded once. Each rounding is 2^-25 for values up to 1.
            let over = over([r, g, b, alpha], [1.0, 0.75, 0.5]);
            for (over, flat) in over.into_iter().zip(flat.get(x, y)) {
                let difference = (over - f64::from(flat)).abs();
                assert!(
                    difference <= 2.0 / f64::from(1 << 25),
                    "{difference:e} at {x}, {y}"
                );
            }
        }
    }
    assert!(rims > 3 * 20, "{rims} pixels of rims are looked at");
}

/// All ways to draw a picture agree on straight alpha: engines, rows, stored and linear.
#[test]
fn all_targets_hold_straight_alpha() {
    let frame = supersampled("coarse-sphere", (48, 36), 2);
    for renderer in support::renderers::renderers() {
        let naive = Variant::parse("naive-phong").expect("a method");
        let linear = naive
            .render_linear_with(&frame, renderer)
            .expect("a method for the frame");
        let stored = naive
            .render_with(&frame, renderer)
            .expect("a method for the frame");
        let mut rows = Vec::new();
        let drawn = naive.render_rows(&frame, renderer, |pixels| {
            rows.extend_from_slice(pixels);
            Ok::<(), std::convert::Infallible>(())
        });
        assert_eq!(drawn, Ok(Ok(())));
        assert_eq!(stored.pixels(), rows);
        let near = |a: u8, b: u8| a.abs_diff(b) <= 1;
        for (stored, linear) in stored.pixels().iter().zip(linear.pixels()) {
            // The row engine may scale to levels first, so a value near a half may fall on either
            // side.
            let linear = linear.map(quantise);
            assert!(
                (0..4).all(|c| near(stored[c], linear[c])),
                "{stored:?} {linear:?}"
            );
        }
    }
}

/// Supersampling keeps every method within its bound. A mean of errors is at most the largest
/// error, and the mean is rounded once, by at most 2^-25.
#[test]
fn supersampled_methods_are_within_their_bounds() {
    for name in ["coarse-sphere", "perspective", "polygons"] {
        let frame = supersampled(name, (64, 48), 2);
        let visible = reference::visibility(&frame);
        let seen = raster::polygon_indices(&frame);
        assert_eq!(
            (seen.width(), seen.height()),
            (128, 96),
            "polygon numbers are those of samples"
        );
        // Skip pixels with a sample that shows another polygon. Depths there are within rounding.
        let same = |x: usize, y: usize| {
            let sample = |k: usize| (2 * x + k % 2, 2 * y + k / 2);
            (0..4)
                .map(sample)
                .all(|(i, j)| seen.get(i, j) == visible.polygons.get(i, j))
        };
        for entry in floats_on(&frame) {
            let truth = reference::shade(&frame, &visible, entry.info.model).to_linear();
            let ours = linear(entry, &frame);
            let difference = compare_where(&truth, &ours, same).expect("equal sizes");
            // The reference's mean is rounded to f32 once more.
            let bound = entry.variant().bound(&frame) + 1.0 / f64::from(1 << 25);
            assert!(
                difference.max <= bound,
                "{name}, {}: {} over {bound}",
                entry.info.name,
                difference.max
            );
            assert!(
                difference.excluded < 10 && difference.coverage_mismatches == 0,
                "{name}, {}",
                entry.info.name
            );
        }
    }
}

#[test]
fn invalid_sample_counts_are_rejected() {
    for (width, height, n) in [
        (12, 12, 3),
        (12, 12, 0),
        (12, 12, 16),
        (13, 12, 2),
        (12, 13, 2),
    ] {
        let mut builder = FrameBuilder::new(width, height);
        builder.samples(n);
        assert_eq!(
            builder.finish().expect_err("no frame"),
            FrameError::Samples { samples: n }
        );
    }
    let mut scene =
        Scene::of_mesh(fastphong::mesh::builtin::builtin("cube").expect("a built-in mesh"));
    (scene.width, scene.samples) = (Scene::MAX_SIDE / 2, 4);
    assert_eq!(
        scene.frame().expect_err("no frame"),
        FrameError::Samples { samples: 4 }
    );
    scene.samples = 3;
    assert_eq!(
        scene.frame().expect_err("no frame"),
        FrameError::Samples { samples: 3 }
    );
}
