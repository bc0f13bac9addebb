//! Compares engines and instruction sets with each other: their pictures agree to rounding.

use super::frames::kinds;
use crate::support::cases::{Case, cases};
use crate::support::differences::{largest_difference, levels_apart};
use crate::support::renderers::{distinct, name, renderers};
use fastphong::picture::Encoding;
use fastphong::raster::Renderer;
use fastphong::shading::{METHODS, Variant};

/// Compares a method's pictures of a frame, adds any failures, and returns the largest difference
/// in grey levels.
fn check(case: &Case, variant: &Variant, renderers: &[Renderer], failures: &mut Vec<String>) -> u8 {
    let (frame, decided) = (&case.frame, case.decided());
    let (linear, stored) = (variant.render_linear(frame), variant.render(frame));
    let own = variant.bound(frame);
    // Below its bend the sRGB curve has slope 12.92.
    let slope = if frame.encoding() == Encoding::Srgb {
        12.92
    } else {
        1.0
    };
    let mut most = 0;
    for &renderer in renderers {
        // Both pictures are within their bounds of one closed form.
        let bound = 2.0 * own;
        let ours = variant.render_linear_with(frame, renderer);
        let (max, uncovered) = largest_difference(&linear, &ours, |x, y| decided.get(x, y));
        let picture = variant.render_with(frame, renderer);
        let (levels, _) = levels_apart(&stored, &picture, |x, y| decided.get(x, y));
        // Values less than a level apart are stored as the same level or as neighbours.
        let allowed = f64::max((255.0 * slope * 2.0 * own).ceil(), 1.0);
        if max > bound || uncovered > 0 || f64::from(levels) > allowed {
            let who = format!(
                "{}, {} by {}",
                case.name,
                variant.info().name,
                name(renderer)
            );
            failures.push(format!(
                "{who}: {max:.2e} apart, bound {bound:.2e}; {uncovered} pixels drawn in one only; {levels} levels apart"
            ));
        }
        most = most.max(levels);
    }
    most
}

/// Engines draw the same picture for every kind of frame. Pixels where rounding decides visibility
/// are left out.
#[test]
fn engines_agree_on_every_kind_of_frame() {
    let mut failures = Vec::new();
    for (kind, frame) in kinds(117, 83) {
        let case = Case::new(kind, frame);
        for entry in METHODS {
            let levels = check(&case, &entry.variant(), &renderers(), &mut failures);
            println!("{kind}, {}: {levels} levels", entry.info.name);
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// No engine's picture is more than one level from the scalar span engine's, on every scene at a
/// third of its size.
#[test]
fn engines_agree_on_every_scene() {
    let mut failures = Vec::new();
    for case in cases(Some((213, 160))) {
        let scene = &case.name;
        for variant in METHODS.iter().map(|entry| entry.variant()) {
            let ways = distinct(&variant, &case.frame);
            let levels = check(case, &variant, &ways, &mut failures);
            if levels > 1 {
                failures.push(format!(
                    "{scene}, {}: {levels} levels apart",
                    variant.info().name
                ));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
