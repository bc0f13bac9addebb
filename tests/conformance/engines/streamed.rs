//! Handing out finished rows while other rows are still being drawn gives the same picture.

use super::frames::kinds;
use crate::support::renderers::{name, on_threads, renderers};
use crate::support::{floats, floats_on};
use fastphong::frame::Frame;
use fastphong::picture::{Picture, Picture8};
use fastphong::raster::Renderer;
use fastphong::shading::Variant;
use std::convert::Infallible;

/// A height at which every engine streams in parts, on one thread and on two.
const HEIGHT: u32 = 270;

/// Returns the picture assembled from streamed rows, and the count of parts.
fn streamed(variant: &Variant, frame: &Frame, renderer: Renderer) -> (Picture8, usize) {
    let (mut pixels, mut parts) = (Vec::new(), 0);
    let drawn = variant.render_rows(frame, renderer, |rows| {
        assert!(
            !rows.is_empty() && rows.len().is_multiple_of(frame.picture_width()),
            "whole rows"
        );
        pixels.extend_from_slice(rows);
        parts += 1;
        Ok::<(), Infallible>(())
    });
    assert_eq!(drawn, Ok(Ok(())));
    let picture = Picture::from_pixels(frame.picture_width(), frame.picture_height(), pixels)
        .expect("every pixel once");
    (picture, parts)
}

#[test]
fn streamed_rows_make_the_picture() {
    let mut in_parts = 0;
    for (kind, frame) in kinds(21, HEIGHT) {
        for variant in floats_on(&frame).map(|entry| entry.variant()) {
            for renderer in renderers() {
                let whole = variant
                    .render_with(&frame, renderer)
                    .expect("a method for the frame");
                for threads in [1, 2] {
                    let (picture, parts) =
                        on_threads(threads, || streamed(&variant, &frame, renderer));
                    let who = format!(
                        "{kind}, {} by {}, {threads} threads",
                        variant.info().name,
                        name(renderer)
                    );
                    assert!(picture == whole, "{who}: the rows make another picture");
                    // For any encoding, only the span engine has the whole picture in memory.
                    let plan = variant.plan(&frame, renderer).renderer();
                    let by_rows = matches!(plan, Some(Renderer::Row(_)));
                    assert_eq!(parts > 1, by_rows, "{who}: {parts} parts");
                    in_parts += usize::from(parts > 1);
                }
            }
        }
    }
    assert!(in_parts > 0, "every picture came in one part");
}

#[test]
fn a_failed_receiver_stops_the_drawing() {
    for (kind, frame) in kinds(21, HEIGHT) {
        for renderer in renderers() {
            let mut calls = 0;
            let taken = floats()[0].variant().render_rows(&frame, renderer, |_| {
                calls += 1;
                Err("full")
            });
            assert_eq!(
                (taken, calls),
                (Ok(Err("full")), 1),
                "{kind} by {}",
                name(renderer)
            );
        }
    }
}
