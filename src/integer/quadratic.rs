//! L·N and the highlight's cosine as parabolas: a pixel takes only additions.

use super::light::{Highlight, Light, shade};
use super::material::TOP;
use super::pixel::Pixel;
use super::ramp::Quadratic;

/// Shades `line` from L·N of the unit normal and the highlight's cosine of each light along the
/// span.
///
/// Both are parabolas: second differences step each with two additions and no product. Bishop and
/// Weimer (1986) fitted such shapes; here they go through three points of a span or six of a
/// triangle.
#[inline(always)]
pub(super) fn quadratic<P: Pixel, H: Highlight, const L: usize>(
    line: &mut [P],
    l_n: [Quadratic; L],
    cosine: [Quadratic; L],
    lights: &[Light<'_, P>; L],
) {
    run::<P, H, true, L>(line, l_n, cosine, lights);
}

/// The least product of two normals between which parabolas need no clamp, in Q30: cos 15.4°.
///
/// Up to this angle parabolas exceed true cosines by at most 0.0019 (see
/// [`Span::quadratic`](super::Span::quadratic)). L·N is at most 255/256, and the table of
/// highlights has room for 0.0049.
pub(super) const NARROW: i32 = 1_035_000_000;

/// Shades `line` like [`quadratic`]. Without `IS_CLAMPED` the caller promises that parabolas stay
/// within their tables.
#[inline(always)]
pub(super) fn run<P: Pixel, H: Highlight, const IS_CLAMPED: bool, const L: usize>(
    line: &mut [P],
    mut l_n: [Quadratic; L],
    mut cosine: [Quadratic; L],
    lights: &[Light<'_, P>; L],
) {
    for pixel in line {
        let mut cosines = [(0, 0); L];
        let mut i = 0;
        while i < L {
            let mut j = l_n[i].next();
            let mut below = if H::IS_SEEN {
                TOP - (cosine[i].next() >> 15)
            } else {
                0
            };
            // Only wide spans need this, and only their loop pays for it.
            if IS_CLAMPED {
                j = j.clamp(-(1 << 30), (1 << 30) - 1);
                below = below.max(0);
            }
            debug_assert!(
                (-(1 << 30)..1 << 30).contains(&j) && below >= 0,
                "{j}, {below} {:?} {} {:?} {:?}",
                lights[i].toward,
                lights[i].l_v,
                lights[i].eye,
                lights[i].halfway
            );
            // From Q30 to the Q31 of `shade`.
            cosines[i] = (j << 1, below);
            i += 1;
        }
        *pixel = P::from_fields(shade::<P, H, L>(lights, |i| cosines[i]));
    }
}
