//! Fast Phong shading: one addition each for J and K, two for D, and a table for 1/√D (L21 4.2,
//! 4.3).

use super::light::{Highlight, Light, shade};
use super::pixel::Pixel;
use super::ramp::{Quadratic, Ramp};
use super::reciprocal_root::{below_one, root_below, unit_j, unit_k};
use fixed::types::I2F30;

/// Shades `line` from J = L·N and K of each light and D = N·N, along the span.
///
/// K is V·N for [`Reflection`](super::Reflection), which reads only the first entry because all
/// lights share the eye. It is H·N for [`Halfway`](super::Halfway). L and H are scaled by 255/256.
#[inline(always)]
pub(super) fn fast<P: Pixel, H: Highlight, const REFINED: bool, const L: usize>(
    line: &mut [P],
    mut j: [Ramp; L],
    mut k: [Ramp; L],
    d: Quadratic,
    lights: &[Light<'_, P>; L],
) {
    // J and K are linear (L21 4.3) and take one addition. D is quadratic and takes two, by second
    // differences. With r = 1/√D, I_specular = (2 J K / D − L·V)ⁿ (L21 4.6) is (2 (J r)(K r) −
    // L·V)ⁿ: three products per pixel.
    //
    // The loop steps x = 1 + 2⁻¹¹ − D in place of D, as an unsigned number with 32 fractional bits.
    // Its upper 11 bits are then the index into the table of roots, without a clamp or a sign to
    // remove.
    let bits = |x: I2F30| (x.to_bits() as u32) << 2;
    let (mut x, mut step, bend) = (below_one(d.at.to_bits()), bits(d.step), bits(d.bend));
    for pixel in line {
        let r = root_below::<REFINED>(x);
        // D grows by `step`, so x shrinks by it.
        x = x.wrapping_sub(step);
        step = step.wrapping_add(bend);
        let mut cosines = [(0, 0); L];
        let mut shared = 0;
        let mut i = 0;
        while i < L {
            let j = unit_j(j[i].next(), r); // 4.3
            // For R·V all lights share K = V·N: the first light computes it for all.
            if H::IS_SEEN && (i == 0 || !H::SHARES_K) {
                shared = unit_k(k[i].next(), r);
            }
            cosines[i] = (j, H::below(&lights[i], j >> 16, shared)); // 4.6
            i += 1;
        }
        *pixel = P::from_fields(shade::<P, H, L>(lights, |i| cosines[i]));
    }
}
