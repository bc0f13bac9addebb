//! Neither threads nor repetition change a byte, wherever bands end.

use super::frames::kinds;
use crate::support::differences::covered;
use crate::support::floats_on;
use crate::support::renderers::{name, on_threads, renderers};
use fastphong::frame::Frame;
use fastphong::mesh::builtin::builtin;
use fastphong::picture::{Picture, Picture8};
use fastphong::raster::{DrawOptions, Renderer};
use fastphong::scene::Scene;
use fastphong::shading::Variant;

/// Returns the stored picture, drawn over an old one, and the bits of the linear picture.
fn bytes(variant: &Variant, frame: &Frame, renderer: Renderer) -> (Picture8, Picture<[u32; 4]>) {
    let mut stored = Picture::new(frame.picture_width(), frame.picture_height(), [7u8; 4]);
    let drawn = variant.draw(frame, &mut stored, DrawOptions::by(renderer));
    drawn.expect("a picture of the frame's size");
    (
        stored,
        variant
            .render_linear_with(frame, renderer)
            .expect("a method for the frame")
            .map(|pixel| pixel.map(f32::to_bits)),
    )
}

/// Every method, kind of frame and engine draws the same bytes on 1, 2, 3 and 7 threads.
#[test]
fn threads_change_no_byte() {
    let pools: Vec<_> = [2, 3, 7]
        .map(|n| {
            rayon::ThreadPoolBuilder::new()
                .num_threads(n)
                .build()
                .expect("threads")
        })
        .into();
    for (kind, frame) in kinds(45, 70) {
        for variant in floats_on(&frame).map(|entry| entry.variant()) {
            for renderer in renderers() {
                let one = on_threads(1, || bytes(&variant, &frame, renderer));
                for pool in &pools {
                    let again = pool.install(|| bytes(&variant, &frame, renderer));
                    let who = format!("{kind}, {} by {}", variant.info().name, name(renderer));
                    assert!(
                        again == one,
                        "{who}: {} threads draw another picture",
                        pool.current_num_threads()
                    );
                }
            }
        }
    }
}

/// Pictures that end one line before or after a band have the span engine's coverage. Their bytes
/// do not depend on the count of threads.
#[test]
fn bands_leave_no_seams() {
    for height in [1, 15, 16, 17, 31, 32, 33] {
        let mut scene =
            Scene::of_mesh(builtin("sphere?rings=9&segments=14").expect("a built-in mesh"));
        (scene.width, scene.height) = (37, height);
        let frame = scene.frame().expect("a frame");
        for variant in floats_on(&frame).map(|entry| entry.variant()) {
            let drawn = covered(
                &variant
                    .render_linear(&frame)
                    .expect("a method for the frame"),
            );
            assert!(drawn.pixels().contains(&true));
            for renderer in renderers() {
                let who = || {
                    format!(
                        "{height} rows, {} by {}",
                        variant.info().name,
                        name(renderer)
                    )
                };
                let one = on_threads(1, || bytes(&variant, &frame, renderer));
                assert_eq!(one.1.map(|pixel| pixel[3] != 0), drawn, "{}", who());
                for threads in [2, 3] {
                    let again = on_threads(threads, || bytes(&variant, &frame, renderer));
                    assert!(
                        again == one,
                        "{}: {threads} threads draw another picture",
                        who()
                    );
                }
            }
        }
    }
}
