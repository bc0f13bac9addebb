//! Fast Phong shading: J and K by an addition, D by two, 1/√D by table (L21 4.2, 4.3).

use super::light::{Highlight, Light, shade};
use super::pixel::Pixel;
use super::ramp::{Quadratic, Ramp};
use super::reciprocal_root::{below_one, root_below, unit_j, unit_k};
use fixed::types::I2F30;

/// Shades `line` from J = L·N and K of each light, and D = N·N, along the span.
///
/// J and K are linear (L21 4.3), D is quadratic: two additions, by second differences. With r = 1/√D
/// by table, and with `REFINED` a step of Newton's, I_specular = (2 J K / D − L·V)ⁿ (L21 4.6) takes
/// three products a pixel.
///
/// K is V·N for [`Reflection`](super::Reflection), of which the first entry alone is read, and H·N for
/// [`Halfway`](super::Halfway). L and H are scaled by 255/256: [`Span::fast`](super::Span::fast) makes
/// all of them from two normals.
///
/// # Error
///
/// In grey levels, for diffuse reflectance k_d and highlight k_s of shininess n, and d the least D, that
/// is cos² of half the angle between the normals:
///
/// - diffuse: k_d (½ + 255 · (2⁻¹³/d + 2⁻¹³)): half a step of its table, the root, and cuts of J and D;
/// - highlight: 255 k_s n (half a step of its table, 2⁻¹¹/d of the root, and 2⁻¹⁰). The half step is at
///   most 1/(80 n), which is 3.2 levels of k_s;
/// - rounding to fields: ½ a level, and that of the pixel's format.
///
/// A step of Newton's takes the root's shares to 2⁻¹⁴ and 2⁻¹². `ErrorBound` adds all of this up.
#[inline(always)]
pub fn fast<P: Pixel, H: Highlight, const REFINED: bool, const L: usize>(
    line: &mut [P],
    mut j: [Ramp; L],
    mut k: [Ramp; L],
    d: Quadratic,
    lights: &[Light<'_, P>; L],
) {
    // 1 − D, with 32 fractional bits, is stepped in place of D: its upper bits are the table's index.
    let bits = |x: I2F30| (x.to_bits() as u32) << 2;
    let (mut x, mut step, bend) = (below_one(d.at.to_bits()), bits(d.step), bits(d.bend));
    for pixel in line {
        let r = root_below::<REFINED>(x);
        x = x.wrapping_sub(step);
        step = step.wrapping_add(bend);
        let mut cosines = [(0, 0); L];
        let mut shared = 0;
        let mut i = 0;
        while i < L {
            let j = unit_j(j[i].next(), r); // 4.3
            if H::IS_SEEN && (i == 0 || !H::SHARES_K) {
                shared = unit_k(k[i].next(), r);
            }
            cosines[i] = (j, H::below(&lights[i], j >> 16, shared)); // 4.6
            i += 1;
        }
        *pixel = P::from_fields(shade::<P, H, L>(lights, |i| cosines[i]));
    }
}
