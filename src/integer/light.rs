//! Lights, kinds of highlights, and a pixel's colour from its cosines.

use super::material::{Material, SCALE, TOP};
use super::pixel::{Pixel, half, saturate};
use super::vector::{Bits, Vector, dot, normalized, unit_bits};

/// A directional light, with the eye at infinity and a material in the light's colour.
#[derive(Debug)]
pub struct Light<'a, P> {
    /// L, scaled by 255/256.
    pub(super) toward: Bits,
    /// V.
    pub(super) eye: Bits,
    /// H, scaled by 255/256; 0 where L = −V.
    pub(super) halfway: Bits,
    /// L·V in Q15, scaled by 255/256.
    pub(super) l_v: i32,
    /// [`TOP`] + L·V.
    top: i32,
    pub(super) material: &'a Material<P>,
}

impl<P> Clone for Light<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<P> Copy for Light<'_, P> {}

impl<'a, P: Pixel> Light<'a, P> {
    /// Makes a light from the directions `toward` the light and toward the `eye`. Only directions
    /// count, not lengths. A light from the direction 0 lights nothing.
    ///
    /// All lights of a picture must have the same eye.
    pub const fn new(toward: Vector, eye: Vector, material: &'a Material<P>) -> Self {
        let (l, v) = (unit_bits(toward.bits()), unit_bits(eye.bits()));
        let sum = [(l[0] + v[0]) >> 1, (l[1] + v[1]) >> 1, (l[2] + v[2]) >> 1];
        let toward = scaled(l);
        let l_v = dot(toward, v) >> 15;
        let halfway = scaled(normalized(sum));
        Self {
            toward,
            eye: v,
            halfway,
            l_v,
            top: TOP + l_v,
            material,
        }
    }
}

/// Returns a vector times 255/256.
pub(super) const fn scaled(v: Bits) -> Bits {
    let half = 1 << 14;
    [
        (v[0] * SCALE + half) >> 15,
        (v[1] * SCALE + half) >> 15,
        (v[2] * SCALE + half) >> 15,
    ]
}

/// A kind of highlight: [`Reflection`], [`Halfway`] or [`NoHighlight`].
pub trait Highlight: Copy + sealed::Sealed {
    /// True if there is one.
    #[doc(hidden)]
    const IS_SEEN: bool;
    /// True if K is the same for all lights.
    #[doc(hidden)]
    const SHARES_K: bool;
    /// Returns the vector whose product with N is K.
    #[doc(hidden)]
    fn k_of<P>(light: &Light<'_, P>) -> Bits;
    /// Returns how far the highlight's cosine lies below the top of its table. The cosine is
    /// computed from L·N and K of the unit normal; all are in Q15.
    #[doc(hidden)]
    fn below<P>(light: &Light<'_, P>, j: i32, k: i32) -> i32;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Reflection {}
    impl Sealed for super::Halfway {}
    impl Sealed for super::NoHighlight {}
}

/// Phong's highlight, (R·V)ⁿ = (2 (L·N)(V·N) − L·V)ⁿ (L21 4.5).
#[derive(Clone, Copy, Debug)]
pub struct Reflection;

/// The highlight (N·H)ⁿ, with H halfway between L and V. It takes one product less than
/// [`Reflection`] and is wider for the same n.
#[derive(Clone, Copy, Debug)]
pub struct Halfway;

/// No highlight: for dull materials, and polygons that no highlight falls on.
#[derive(Clone, Copy, Debug)]
pub struct NoHighlight;

impl Highlight for Reflection {
    const IS_SEEN: bool = true;
    const SHARES_K: bool = true;
    #[inline(always)]
    fn k_of<P>(light: &Light<'_, P>) -> Bits {
        light.eye
    }
    #[inline(always)]
    fn below<P>(light: &Light<'_, P>, j: i32, k: i32) -> i32 {
        // Shifting by 14, not 15, doubles the product. It wraps only for normals beyond the limits
        // of `Span::slerp`.
        light.top - (j.wrapping_mul(k) >> 14) // 4.5
    }
}

impl Highlight for Halfway {
    const IS_SEEN: bool = true;
    const SHARES_K: bool = false;
    #[inline(always)]
    fn k_of<P>(light: &Light<'_, P>) -> Bits {
        light.halfway
    }
    #[inline(always)]
    fn below<P>(_: &Light<'_, P>, _: i32, k: i32) -> i32 {
        TOP - k
    }
}

impl Highlight for NoHighlight {
    const IS_SEEN: bool = false;
    const SHARES_K: bool = true;
    #[inline(always)]
    fn k_of<P>(_: &Light<'_, P>) -> Bits {
        [0; 3]
    }
    #[inline(always)]
    fn below<P>(_: &Light<'_, P>, _: i32, _: i32) -> i32 {
        0
    }
}

/// Returns a pixel's colour in fields. For each light, `cosines` returns L·N of the unit normal in
/// Q31, and how far the cosine of its highlight lies below [`TOP`] in Q15.
///
/// In Q31 every `i32` lies between −1 and 1, so the upper 9 bits of L·N are an index that needs no
/// check. The highlight's cosine may exceed 1 by the room that [`TOP`] leaves. Above that there is
/// no highlight.
#[inline(always)]
pub(super) fn shade<P: Pixel, H: Highlight, const L: usize>(
    lights: &[Light<'_, P>; L],
    cosines: impl Fn(usize) -> (i32, i32),
) -> u32 {
    const { assert!(L > 0, "a pixel has one light or more") };
    let mut sum = 0;
    let mut i = 0;
    while i < L {
        let (light, (j, below)) = (&lights[i], cosines(i));
        // The logical shift maps negative L·N to the upper half of the table, which has no diffuse
        // light.
        let diffuse = light.material.diffuse[(j as u32 >> 23) as usize];
        sum = if i == 0 {
            diffuse
        } else {
            // Each table entry includes the ½ that rounds: count it only once.
            saturate(sum + diffuse - half::<P>())
        };
        if H::IS_SEEN {
            // If the light is behind, `j >> 31` is all ones: an index beyond the table, where `get`
            // finds no highlight. A `below` under 0 ends there, too.
            let step = (below >> light.material.shift | j >> 31) as u32;
            if let Some(highlight) = light.material.highlight.get(step as usize) {
                sum = saturate(sum + highlight);
            }
        }
        i += 1;
    }
    sum
}
