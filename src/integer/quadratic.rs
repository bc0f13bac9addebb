//! L·N and the highlight's cosine as parabolas: additions alone at a pixel.

use super::light::{Highlight, Light, shade};
use super::material::TOP;
use super::pixel::Pixel;
use super::ramp::Quadratic;

/// Shades `line` from the unit L·N and the highlight's cosine of each light along the span.
///
/// Both are parabolas by second differences, two additions each, without a product: Bishop and
/// Weimer's shape (1986), fitted through three points of a span or six of a triangle.
///
/// # Error
///
/// That of [`fast`](super::fast) with a step of Newton's, and what parabolas leave out: over an angle θ
/// between the ends at most 0.0241 θ³ of L·N and N·H and 0.0963 θ³ of R·V, which the highlight
/// multiplies by 255 k_s n. In grey levels, with k_d ½, k_s 0.4 and n = 32: 2.3 in all up to 15°, 7 at
/// 30°, 56 at 60°.
#[inline(always)]
pub fn quadratic<P: Pixel, H: Highlight, const L: usize>(
    line: &mut [P],
    l_n: [Quadratic; L],
    cosine: [Quadratic; L],
    lights: &[Light<'_, P>; L],
) {
    run::<P, H, true, L>(line, l_n, cosine, lights);
}

/// The least product of two normals, with 30 fractional bits, between which parabolas need no clamp:
/// cos 15.4°.
///
/// There they pass true cosines by at most 0.0019 (see [`quadratic`]). Those of L are at most 255/256,
/// and the table of highlights has room for 0.0049.
pub(super) const NARROW: i32 = 1_035_000_000;

/// Shades `line` as [`quadratic`] does; without `IS_CLAMPED` parabolas have to stay within their tables.
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
            cosines[i] = (j << 1, below);
            i += 1;
        }
        *pixel = P::from_fields(shade::<P, H, L>(lights, |i| cosines[i]));
    }
}
