//! Naive Phong shading: N by additions, J, K and D by products, 1/√D by table.

use super::light::{Highlight, Light, shade};
use super::pixel::Pixel;
use super::ramp::Ramp;
use super::reciprocal_root::{below_one, root_below, unit_j, unit_k};
use super::vector::{Bits, Vector, dot, unit_bits};

/// Shades `line` from the normal at its first pixel and the growth of the normal per pixel.
///
/// N steps by three additions (L21 4.2). Then J = L·N, K = V·N and D = N·N give L·N = J/√D and
/// R·V = 2 (J/√D)(K/√D) − L·V. Reading N at 15 bits costs J, K and D up to 2⁻¹⁴ each.
///
/// Its error is that of [`fast`](super::fast), within 2⁻¹³ of cosine.
#[inline(always)]
pub fn naive<P: Pixel, H: Highlight, const REFINED: bool, const L: usize>(
    line: &mut [P],
    normal: [Ramp; 3],
    lights: &[Light<'_, P>; L],
) {
    let [mut x, mut y, mut z] = normal;
    for pixel in line {
        let n = [x.next() >> 15, y.next() >> 15, z.next() >> 15]; // 4.2
        *pixel = P::from_fields(light_normal::<P, H, REFINED, L>(lights, n));
    }
}

/// Returns the colour of a normal of any length in fields, for [`gouraud`](super::gouraud): lit as [`naive`](super::naive) lights
/// a pixel, with one step of Newton's.
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
    let r = root_below::<REFINED>(below_one(dot(n, n)));
    // The eye is one, so V·N is the same for all lights.
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
