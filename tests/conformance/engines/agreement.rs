//! Compares engines and instruction sets with each other: their pictures agree to rounding.

use super::frames::kinds;
use crate::support::cases::{Case, cases};
use crate::support::differences::{largest_difference, levels_apart};
use crate::support::drawings::{Drawing, assert_none, for_each_drawing};
use crate::support::floats_on;
use crate::support::renderers::renderers;
use fastphong::picture::Encoding;

/// Compares a drawing with the scalar span engine's. Returns the difference in grey levels, and a
/// message if rounding does not explain it.
fn compare(drawing: &Drawing) -> (u8, Option<String>) {
    if drawing.is_by_spans() {
        return (0, None);
    }
    let (case, variant) = (drawing.case, &drawing.variant);
    let (frame, decided) = (&case.frame, case.decided());
    // Below its bend the sRGB curve has slope 12.92.
    let slope = if frame.encoding() == Encoding::Srgb {
        12.92
    } else {
        1.0
    };
    // Both pictures are within the bound of the same closed form.
    let bound = 2.0 * variant.bound(frame);
    let counts = |x, y| decided.get(x, y);
    let (max, uncovered) = largest_difference(
        &variant
            .render_linear(frame)
            .expect("a method for the frame"),
        &drawing.linear(),
        counts,
    );
    let (levels, _) = levels_apart(
        &variant.render(frame).expect("a method for the frame"),
        &drawing.stored(),
        counts,
    );
    // Values less than a level apart are stored as the same level or as neighbours.
    let allowed = f64::max((255.0 * slope * bound).ceil(), 1.0);
    let is_wrong = max > bound || uncovered > 0 || f64::from(levels) > allowed;
    let message = is_wrong.then(|| {
        format!(
            "{drawing}: {max:.2e} apart, bound {bound:.2e}; {uncovered} pixels drawn in one only; {levels} levels apart"
        )
    });
    (levels, message)
}

/// Engines draw the same picture for every kind of frame, even where one stands in for another.
/// Pixels where rounding decides visibility are left out.
#[test]
fn engines_agree_on_every_kind_of_frame() {
    for (kind, frame) in kinds(117, 83) {
        let case = &Case::new(kind, frame);
        for entry in floats_on(&case.frame) {
            let all = renderers().into_iter().map(|renderer| Drawing {
                case,
                variant: entry.variant(),
                renderer,
            });
            assert_none(all.map(|drawing| compare(&drawing).1));
        }
    }
}

/// On every scene at a third of its size, no engine's picture is more than one level from the
/// scalar span engine's.
#[test]
fn engines_agree_on_every_scene() {
    assert_none(for_each_drawing(cases(Some((213, 160))), |drawing| {
        let (levels, message) = compare(drawing);
        message.or_else(|| (levels > 1).then(|| format!("{drawing}: {levels} levels apart")))
    }));
}
