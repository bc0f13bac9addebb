//! Engines and instruction sets against one another: the same picture to rounding.

use super::frames::kinds;
use crate::support;
use crate::support::renderers::{bound, decided, largest_difference, name, renderers};
use fastphong::frame::Frame;
use fastphong::picture::{Picture, Picture8};
use fastphong::raster::Renderer;
use fastphong::reference;
use fastphong::scene::Encoding;
use fastphong::shader::{METHODS, Variant};

/// The largest difference of two levels where `decided` holds.
fn levels_apart(a: &Picture8, b: &Picture8, decided: &Picture<bool>) -> u8 {
    let texels = a
        .texels()
        .iter()
        .zip(b.texels())
        .zip(decided.texels())
        .filter(|(_, decided)| **decided);
    texels
        .flat_map(|((a, b), _)| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)))
        .max()
        .unwrap_or(0)
}

/// What is wrong with a method's pictures of a frame, if anything.
fn check(
    frame: &Frame,
    decided: &Picture<bool>,
    variant: &Variant,
    failures: &mut Vec<String>,
) -> u8 {
    let (linear, stored) = (variant.render_linear(frame), variant.render(frame));
    let own = bound(variant.info(), frame, Renderer::LECTURE);
    // Below its bend the curve of sRGB rises by 12.92.
    let slope = if frame.encoding() == Encoding::Srgb {
        12.92
    } else {
        1.0
    };
    let mut most = 0;
    for renderer in renderers() {
        // Both are within their bounds of one closed form.
        let bound = own + bound(variant.info(), frame, renderer);
        let ours = variant.render_linear_with(frame, renderer);
        let (max, uncovered) = largest_difference(&linear, &ours, |x, y| decided.get(x, y));
        let mut picture = Picture::new(1, 1, [0; 4]);
        variant.render_with(frame, renderer, &mut picture);
        let levels = levels_apart(&stored, &picture, decided);
        // Values that are less than a level apart are stored as the same level or as neighbours. What the guard of Newton's
        // method lets through is less than that where N·H is not raised to a power; there it is measured here, not derived.
        let allowed = f64::max((255.0 * slope * 2.0 * own).ceil(), 1.0);
        if max > bound || uncovered > 0 || f64::from(levels) > allowed {
            let who = format!("{} by {}", variant.info().name, name(renderer));
            failures.push(format!(
                "{who}: {max:.2e} apart, bound {bound:.2e}; {uncovered} pixels drawn in one only; {levels} levels apart"
            ));
        }
        most = most.max(levels);
    }
    most
}

/// What every kind of frame shows does not depend on who draws it: pixels left out are those where rounding decides which
/// of two surfaces is nearer.
#[test]
fn engines_agree_on_every_kind_of_frame() {
    let mut failures = Vec::new();
    for (kind, frame) in kinds(117, 83) {
        let decided = decided(&frame, &reference::visibility(&frame));
        for entry in METHODS {
            let before = failures.len();
            let levels = check(&frame, &decided, &entry.variant(), &mut failures);
            failures[before..]
                .iter_mut()
                .for_each(|failure| *failure = format!("{kind}, {failure}"));
            println!("{kind}, {}: {levels} levels", entry.info.name);
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Every shipped scene, a third of its size: no method's picture is more than one level from the lecture's.
#[test]
fn engines_agree_on_every_scene() {
    let mut failures = Vec::new();
    for (scene, path) in support::shipped() {
        let frame = support::scene(&path, Some((213, 160)))
            .frame()
            .expect("a frame");
        let decided = decided(&frame, &reference::visibility(&frame));
        for entry in METHODS {
            let before = failures.len();
            let levels = check(&frame, &decided, &entry.variant(), &mut failures);
            failures[before..]
                .iter_mut()
                .for_each(|failure| *failure = format!("{scene}, {failure}"));
            if levels > 1 {
                failures.push(format!(
                    "{scene}, {}: {levels} levels apart",
                    entry.info.name
                ));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
