//! Naive Phong shading: additions step N, products compute J, K and D, and a table 1/√D.

use super::light::{Highlight, Light, shade};
use super::pixel::Pixel;
use super::ramp::Ramp;
use super::reciprocal_root::{below_one, root_below, unit_j, unit_k};
use super::vector::{Bits, Vector, dot, unit_bits};

/// Shades `line` from the normal at its first pixel and the normal's growth per pixel.
#[inline(always)]
pub(super) fn naive<P: Pixel, H: Highlight, const REFINED: bool, const L: usize>(
    line: &mut [P],
    normal: [Ramp; 3],
    lights: &[Light<'_, P>; L],
) {
    // Three additions step N (L21 4.2). Then J = L·N, K = V·N and D = N·N, and from them L·N = J/√D
    // and R·V = 2 (J/√D)(K/√D) − L·V. N is cut to Q15 so that products fit 32 bits, which moves J,
    // K and D by up to 2⁻¹⁴.
    let [mut x, mut y, mut z] = normal;
    for pixel in line {
        let n = [x.next() >> 15, y.next() >> 15, z.next() >> 15]; // 4.2
        *pixel = P::from_fields(light_normal::<P, H, REFINED, L>(lights, n));
    }
}

/// Returns the colour of a surface with this normal, in the fields that [`gouraud`](super::gouraud)
/// reads.
///
/// It computes the same light as [`Span::naive`](super::Span::naive) with `REFINED`. Only the
/// normal's direction counts.
#[inline(never)]
pub fn colour<P: Pixel, H: Highlight, const L: usize>(
    lights: &[Light<'_, P>; L],
    normal: Vector,
) -> u32 {
    light_normal::<P, H, true, L>(lights, unit_bits(normal.bits()))
}

/// Returns the colour of a normal in fields.
#[inline(always)]
pub(super) fn light_normal<P: Pixel, H: Highlight, const REFINED: bool, const L: usize>(
    lights: &[Light<'_, P>; L],
    n: Bits,
) -> u32 {
    // D is computed at each pixel, not stepped; `below_one` turns it into an index of the table.
    let r = root_below::<REFINED>(below_one(dot(n, n)));
    // All lights share the eye, so V·N is the same for all of them.
    let along = |light: &Light<'_, P>| unit_k(dot(H::k_of(light), n), r);
    let shared = if H::SHARES_K { along(&lights[0]) } else { 0 };
    shade::<P, H, L>(lights, |i| {
        let j = unit_j(dot(lights[i].toward, n), r);
        let k = if H::SHARES_K {
            shared
        } else {
            along(&lights[i])
        };
        (j, H::below(&lights[i], j >> 16, k))
    })
}
