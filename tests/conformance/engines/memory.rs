//! Drawing into the caller's memory: formats, strides, kept backgrounds, and depth buffers.

use super::frames::{kinds, parts};
use crate::support::renderers::{depth_rounding, distinct, name, on_threads};
use fastphong::frame::{DepthRange, Frame};
use fastphong::picture::{Alpha, LinearPicture, Picture, Picture8, PictureMut};
use fastphong::raster::{Background, DepthTest, DrawError, DrawOptions, Renderer, depth};
use fastphong::reference::visibility;
use fastphong::scene::{DepthBits, DepthBuffer, HiddenSurfaces};
use fastphong::shading::Variant;

const SIZE: [usize; 2] = [48, 36];

/// Calls `check` with a name, a frame of each kind, a method, and each renderer that draws it in a
/// different way.
fn each_way(mut check: impl FnMut(&str, &Frame, &Variant, Renderer)) {
    for (kind, frame) in kinds(SIZE[0] as u32, SIZE[1] as u32) {
        for method in ["gouraud", "phong-rsqrt", "fast-phong", "slerp-phong"] {
            let variant = Variant::parse(method).expect("a method");
            for renderer in distinct(&variant, &frame) {
                let who = format!("{kind}, {method} by {}", name(renderer));
                check(&who, &frame, &variant, renderer);
            }
        }
    }
}

fn draw<'p>(
    variant: &Variant,
    frame: &Frame,
    picture: impl Into<PictureMut<'p>>,
    options: DrawOptions<'_>,
) {
    let drawn = variant.draw(frame, picture, options);
    drawn.expect("picture and depth buffer of the frame's size");
}

fn kept(renderer: Renderer) -> DrawOptions<'static> {
    DrawOptions::by(renderer).background(Background::Kept)
}

#[test]
fn all_formats_hold_the_same_picture_and_keep_the_memory_between_rows() {
    const STRIDE: usize = 61;
    each_way(|who, frame, variant, renderer| {
        let [width, height] = [frame.picture_width(), frame.picture_height()];
        let expected = variant
            .render_with(frame, renderer)
            .expect("a method for the frame");
        // The last row ends with its last pixel.
        let len = STRIDE * (height - 1) + width;
        let (mut rgba, mut bgra) = (vec![[9; 4]; len], vec![[9; 4]; len]);
        let (mut argb, mut floats) = (vec![9; len], vec![[9.0; 4]; len]);
        let all = [
            PictureMut::rgba8(&mut rgba, width, height),
            PictureMut::bgra8(&mut bgra, width, height),
            PictureMut::argb(&mut argb, width, height),
            PictureMut::linear(&mut floats, width, height),
        ];
        for picture in all {
            let options = DrawOptions::by(renderer);
            draw(variant, frame, picture.stride(STRIDE), options);
        }
        let linear = variant
            .render_linear_with(frame, renderer)
            .expect("a method for the frame");
        for place in 0..len {
            let (x, y) = (place % STRIDE, place / STRIDE);
            let found = (rgba[place], bgra[place], argb[place], floats[place]);
            let pixels = if x < width {
                let [r, g, b, alpha] = expected.get(x, y);
                let number = u32::from_be_bytes([alpha, r, g, b]);
                ([r, g, b, alpha], [b, g, r, alpha], number, linear.get(x, y))
            } else {
                ([9; 4], [9; 4], 9, [9.0; 4])
            };
            assert_eq!(found, pixels, "{who}: {x}, {y}");
        }
    });
}

/// Drawing into a part of a picture draws the picture of its size and writes nothing else. A part
/// that reaches beyond is refused.
#[test]
fn drawing_into_a_part_writes_only_the_part() {
    const SIZE: [usize; 2] = [70, 50];
    each_way(|who, frame, variant, renderer| {
        let [width, height] = [frame.picture_width(), frame.picture_height()];
        let expected = variant
            .render_with(frame, renderer)
            .expect("a method for the frame");
        for [left, top] in [[0, 0], [5, 3], [SIZE[0] - width, SIZE[1] - height]] {
            let (mut picture, mut argb) = (
                Picture8::new(SIZE[0], SIZE[1], [9; 4]),
                vec![9; 80 * SIZE[1]],
            );
            let part = PictureMut::from(&mut picture).part([left, top], [width, height]);
            draw(variant, frame, part, DrawOptions::by(renderer));
            // Draw into a part of a part, in rows that are 80 pixels apart.
            let part = PictureMut::argb(&mut argb, SIZE[0], SIZE[1])
                .stride(80)
                .part([left, 0], [width, SIZE[1]])
                .part([0, top], [width, height]);
            draw(variant, frame, part, DrawOptions::by(renderer));
            for (x, y) in (0..SIZE[1]).flat_map(|y| (0..80).map(move |x| (x, y))) {
                let is_inside =
                    (left..left + width).contains(&x) && (top..top + height).contains(&y);
                let [r, g, b, alpha] = if is_inside {
                    expected.get(x - left, y - top)
                } else {
                    [9; 4]
                };
                let number = if is_inside {
                    u32::from_be_bytes([alpha, r, g, b])
                } else {
                    9
                };
                assert_eq!(argb[80 * y + x], number, "{who}: {x}, {y}");
                if x < SIZE[0] {
                    assert_eq!(picture.get(x, y), [r, g, b, alpha], "{who}: {x}, {y}");
                }
            }
        }
        for (at, found) in [
            ([SIZE[0] - width + 1, 0], [width - 1, height]),
            ([0, SIZE[1] - height + 2], [width, height - 2]),
            ([usize::MAX, usize::MAX], [0, 0]),
        ] {
            let mut picture = Picture8::new(SIZE[0], SIZE[1], [9; 4]);
            let part = PictureMut::from(&mut picture).part(at, [width, height]);
            let expected = [width, height];
            assert_eq!(
                variant.draw(frame, part, DrawOptions::by(renderer)),
                Err(DrawError::Size { found, expected })
            );
        }
    });
}

#[test]
fn a_kept_background_shows_where_no_polygon_is() {
    each_way(|who, frame, variant, renderer| {
        if frame.samples() > 1 {
            return;
        }
        let before = [10, 20, 30, 40];
        let mut picture = Picture8::new(frame.picture_width(), frame.picture_height(), before);
        draw(variant, frame, &mut picture, kept(renderer));
        let expected = variant
            .render_with(frame, renderer)
            .expect("a method for the frame")
            .map(|pixel| match pixel {
                [_, _, _, 0] => before,
                pixel => pixel,
            });
        assert!(expected.pixels().contains(&before), "{who}: no background");
        assert!(picture == expected, "{who}");
    });
}

/// Over a picture that has the frame's background everywhere, a frame draws the same picture as
/// over its own background.
#[test]
fn a_partly_covered_pixel_is_blended_over_the_kept_picture() {
    let (_, mut frame) = kinds(48, 36)
        .find(|(kind, _)| *kind == "four samples per pixel")
        .expect("a kind");
    let variant = Variant::parse("phong-rsqrt").expect("a method");
    for renderer in distinct(&variant, &frame) {
        for alpha in [Alpha::Straight, Alpha::Flattened] {
            let [r, g, b] = frame.background();
            let mut picture = Picture::new(48, 36, [r, g, b, 1.0]);
            frame.set_alpha(alpha);
            draw(&variant, &frame, &mut picture, kept(renderer));
            frame.set_alpha(Alpha::Flattened);
            let expected = variant
                .render_linear_with(&frame, renderer)
                .expect("a method for the frame");
            let shares = expected.pixels().iter().map(|pixel| pixel[3]);
            assert!(shares.clone().any(|alpha| 0.0 < alpha && alpha < 1.0));
            assert_eq!(
                picture,
                expected.map(|[r, g, b, _]| [r, g, b, 1.0]),
                "{alpha:?}"
            );
        }
        // Over nothing, straight alpha does not change.
        frame.set_alpha(Alpha::Straight);
        let mut picture = LinearPicture::new(48, 36, [0.25, 0.5, 0.75, 0.0]);
        draw(&variant, &frame, &mut picture, kept(renderer));
        let alone = variant
            .render_linear_with(&frame, renderer)
            .expect("a method for the frame");
        for (found, alone) in picture.pixels().iter().zip(alone.pixels()) {
            match alone[3] {
                0.0 => assert_eq!(*found, [0.25, 0.5, 0.75, 0.0]),
                _ => assert_eq!(found, alone),
            }
        }
    }
}

/// Two balls that are drawn one after the other with one depth buffer, in either order, make the
/// picture of both.
#[test]
fn two_frames_compose_as_one() {
    let mut compared = 0;
    for (kind, both, [first, second]) in parts(48, 36) {
        let HiddenSurfaces::ZBuffer(DepthBuffer {
            bits: DepthBits::ThirtyTwo,
            ..
        }) = both.hidden_surfaces()
        else {
            continue;
        };
        if both.samples() > 1 {
            continue; // a pixel that shows both balls is filtered twice
        }
        for method in ["gouraud", "phong-rsqrt", "fast-phong", "slerp-phong"] {
            let variant = Variant::parse(method).expect("a method");
            for renderer in distinct(&variant, &both) {
                let expected = variant
                    .render_with(&both, renderer)
                    .expect("a method for the frame");
                for (frames, threads) in [([&first, &second], 1), ([&second, &first], 2)] {
                    let mut depths = vec![f32::INFINITY; both.width() * both.height()];
                    let mut picture = Picture8::new(both.width(), both.height(), [7; 4]);
                    for (number, frame) in frames.into_iter().enumerate() {
                        let options = DrawOptions::by(renderer)
                            .background([Background::Drawn, Background::Kept][number])
                            .depth(&mut depths);
                        on_threads(threads, || draw(&variant, frame, &mut picture, options));
                    }
                    let who = format!("{kind}, {method} by {}", name(renderer));
                    assert!(picture == expected, "{who}: another picture");
                    if renderer == Renderer::LECTURE {
                        let z = |d: &f32| both.depth_range().z(f64::from(*d)) as f32;
                        let depths: Vec<f32> = depths.iter().map(z).collect();
                        assert_eq!(depths, depth(&both).pixels(), "{who}");
                    }
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 100, "{compared} pictures");
}

const DEPTH_TESTS: [DepthTest; 4] = [
    DepthTest::Less,
    DepthTest::LessOrEqual,
    DepthTest::Greater,
    DepthTest::GreaterOrEqual,
];

fn is_reversed(test: DepthTest) -> bool {
    matches!(test, DepthTest::Greater | DepthTest::GreaterOrEqual)
}

/// Returns an empty depth buffer.
fn no_depths(test: DepthTest, frame: &Frame) -> Vec<f32> {
    let nothing = if is_reversed(test) {
        f32::NEG_INFINITY
    } else {
        f32::INFINITY
    };
    vec![nothing; frame.width() * frame.height()]
}

/// Calls `check` with a name, a frame for each of two balls with depth buffers of floats, a method
/// and a renderer.
fn each_pair(mut check: impl FnMut(&str, [&Frame; 2], &Variant, Renderer)) {
    let pairs = parts(48, 36).filter(|(_, both, _)| {
        let floats = HiddenSurfaces::ZBuffer(DepthBuffer::default());
        both.hidden_surfaces() == floats && both.samples() == 1
    });
    for (kind, _, [first, second]) in pairs {
        for method in ["gouraud", "phong-rsqrt"] {
            let variant = Variant::parse(method).expect("a method");
            for renderer in distinct(&variant, &first) {
                let who = format!("{kind}, {method} by {}", name(renderer));
                check(&who, [&first, &second], &variant, renderer);
            }
        }
    }
}

/// At each sample each depth test shows the ball that is nearer by the reference's depths in `f64`,
/// and stores its depth. Reversed buffers hold 1/w or 1 − z.
#[test]
fn each_depth_test_shows_the_ball_that_the_reference_finds_nearer() {
    let mut decided = [0; 2];
    each_pair(|who, [first, second], variant, renderer| {
        let seen = [first, second].map(visibility);
        for test in DEPTH_TESTS {
            let mut depths = no_depths(test, first);
            let [first_picture, second_picture] = [first, second].map(|frame| {
                let mut picture = Picture8::new(48, 36, [7; 4]);
                let options = kept(renderer).depth(&mut depths).depth_test(test);
                draw(variant, frame, &mut picture, options);
                picture
            });
            let range = first.depth_range();
            let is_perspective = matches!(range, DepthRange::Perspective { .. });
            for (x, y) in (0..36).flat_map(|y| (0..48).map(move |x| (x, y))) {
                let z = [&seen[0], &seen[1]].map(|seen| seen.depth.get(x, y));
                let is_drawn = [&first_picture, &second_picture].map(|p| p.get(x, y) != [7; 4]);
                assert_eq!(is_drawn[0], z[0].is_finite(), "{who}, {test:?}: {x}, {y}");
                // Depths of both are rounded: see `is_decided`.
                let gain = match range {
                    DepthRange::Perspective { near, far } => far / (far - near),
                    DepthRange::Orthographic { .. } => 1.0,
                };
                let most = gain * depth_rounding(first);
                if z[0].is_finite() && z[1].is_finite() && (z[0] - z[1]).abs() > most {
                    decided[usize::from(z[1] < z[0])] += 1;
                    assert_eq!(is_drawn[1], z[1] < z[0], "{who}, {test:?}: {x}, {y}");
                }
                let nearest = z[0].min(z[1]);
                let stored = f64::from(depths[48 * y + x]);
                if nearest.is_finite() {
                    let found = if !is_reversed(test) {
                        range.z(stored)
                    } else if is_perspective {
                        range.z(-stored)
                    } else {
                        1.0 - stored
                    };
                    assert!((found - nearest).abs() <= most, "{who}, {test:?}: {x}, {y}");
                } else {
                    assert!(stored.is_infinite(), "{who}, {test:?}: {x}, {y}");
                }
            }
        }
    });
    assert!(decided.iter().all(|count| *count > 100), "{decided:?}");
}

/// A frame that is drawn again has equal depths everywhere: strict depth tests show nothing of it,
/// and the others everything.
#[test]
fn equal_depths_pass_only_tests_that_include_equality() {
    each_pair(|who, [frame, _], variant, renderer| {
        for test in DEPTH_TESTS {
            let mut depths = no_depths(test, frame);
            let mut drawn = || {
                let mut picture = Picture8::new(48, 36, [7; 4]);
                let options = kept(renderer).depth(&mut depths).depth_test(test);
                draw(variant, frame, &mut picture, options);
                (picture, depths.clone())
            };
            let ((first, before), (second, after)) = (drawn(), drawn());
            let expected = match test {
                DepthTest::Less | DepthTest::Greater => Picture8::new(48, 36, [7; 4]),
                _ => first,
            };
            assert!(second == expected, "{who}, {test:?}");
            assert_eq!(before, after, "{who}, {test:?}");
        }
    });
}

/// The caller's own drawing hides everything behind it, sample by sample, and nothing is written
/// there.
#[test]
fn pixels_behind_the_callers_depths_are_not_written() {
    each_way(|who, frame, variant, renderer| {
        let HiddenSurfaces::ZBuffer(DepthBuffer {
            bits: DepthBits::ThirtyTwo,
            ..
        }) = frame.hidden_surfaces()
        else {
            return;
        };
        // The caller drew in front of everything, left of the middle.
        let middle = frame.width() / 2;
        let is_hidden = |place: usize| place % frame.width() < middle;
        let samples = 0..frame.width() * frame.height();
        let mut depths: Vec<f32> = samples
            .map(|place| {
                if is_hidden(place) {
                    -9.0
                } else {
                    f32::INFINITY
                }
            })
            .collect();
        let mut picture = Picture8::new(frame.picture_width(), frame.picture_height(), [7; 4]);
        let options = kept(renderer).depth(&mut depths);
        draw(variant, frame, &mut picture, options);
        let whole = variant
            .render_with(frame, renderer)
            .expect("a method for the frame");
        let left = frame.picture_width() / 2;
        for (y, x) in (0..picture.height()).flat_map(|y| (0..picture.width()).map(move |x| (y, x)))
        {
            match whole.get(x, y)[3] {
                // A run that begins at another pixel rounds differently.
                255 if x >= left => {
                    let [found, whole] = [picture.get(x, y), whole.get(x, y)];
                    let is_near = |c: usize| found[c].abs_diff(whole[c]) <= 1;
                    assert!((0..4).all(is_near), "{who}: {found:?}, {whole:?}");
                }
                1..255 if x >= left => (),
                _ => assert_eq!(picture.get(x, y), [7; 4], "{who}: {x}, {y}"),
            }
        }
        assert!((0..depths.len()).all(|place| is_hidden(place) == (depths[place] == -9.0)));
        assert!(
            depths
                .iter()
                .any(|depth| (0.0..1.0).contains(&frame.depth_range().z(f64::from(*depth)))),
            "{who}"
        );
    });
}

#[test]
fn arguments_that_do_not_match_are_errors_and_nothing_is_drawn() {
    let variant = Variant::parse("gouraud").expect("a method");
    let frame = |kind: &str| {
        kinds(48, 36)
            .find(|(name, _)| *name == kind)
            .expect("a kind")
            .1
    };
    let plain = frame("one material");
    let mut pixels = vec![[7; 4]; 48 * 36];
    let mut found =
        |width: usize, height: usize, stride: usize, frame: &Frame, depth: Option<usize>| {
            let mut depths = vec![0.5; depth.unwrap_or(0)];
            let mut options = DrawOptions::by(Renderer::fastest());
            options.depth = depth.map(|_| &mut depths[..]);
            let picture = PictureMut::rgba8(&mut pixels, width, height).stride(stride);
            let result = variant.draw(frame, picture, options);
            if result.is_err() {
                assert!(
                    pixels.iter().all(|pixel| *pixel == [7; 4]) && depths.iter().all(|z| *z == 0.5)
                );
            }
            result.map(|_| ())
        };
    let cases = [
        (
            found(36, 48, 36, &plain, None),
            DrawError::Size {
                found: [36, 48],
                expected: [48, 36],
            },
            "the picture is 36x48: the frame draws 48x36 pixels",
        ),
        (
            found(48, 36, 47, &plain, None),
            DrawError::Stride {
                stride: 47,
                width: 48,
            },
            "a stride of 47 pixels is shorter than a row of 48",
        ),
        (
            found(48, 36, 49, &plain, None),
            DrawError::Pixels {
                found: 48 * 36,
                expected: 49 * 35 + 48,
            },
            "the picture has memory for 1728 pixels: its rows take 1763",
        ),
        (
            found(48, 36, usize::MAX, &plain, None),
            DrawError::Pixels {
                found: 48 * 36,
                expected: usize::MAX,
            },
            "the picture has memory for 1728 pixels: its rows take 18446744073709551615",
        ),
        (
            found(48, 36, 48, &plain, Some(48 * 35)),
            DrawError::Depth {
                found: 48 * 35,
                expected: 48 * 36,
            },
            "the depth buffer has 1680 values: the frame has 1728 samples",
        ),
        // It has one entry per sample, not per pixel.
        (
            found(48, 36, 48, &frame("four samples per pixel"), Some(48 * 36)),
            DrawError::Depth {
                found: 48 * 36,
                expected: 96 * 72,
            },
            "the depth buffer has 1728 values: the frame has 6912 samples",
        ),
        (
            found(48, 36, 48, &frame("painter"), Some(48 * 36)),
            DrawError::DepthNotTested,
            "the frame is drawn in order, without a depth test: leave the depth buffer out, or give the frame one",
        ),
        (
            found(48, 36, 48, &frame("in the order of drawing"), Some(48 * 36)),
            DrawError::DepthNotTested,
            "the frame is drawn in order, without a depth test: leave the depth buffer out, or give the frame one",
        ),
        (
            found(
                48,
                36,
                48,
                &frame("a depth buffer of 16 bits"),
                Some(48 * 36),
            ),
            DrawError::DepthRounded(DepthBits::Sixteen),
            "the frame rounds depth to 16 bits: give it a depth buffer of 32",
        ),
    ];
    for (found, error, text) in cases {
        assert_eq!(found, Err(error));
        assert_eq!(error.to_string(), text);
    }
    // Without a depth buffer, samples need no memory of the caller.
    assert_eq!(
        found(48, 36, 48, &frame("four samples per pixel"), None),
        Ok(())
    );
}
