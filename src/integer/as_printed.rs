//! The lecture's methods exactly as printed, to see how much the others save.

use super::light::{Light, Reflection, shade};
use super::material::TOP;
use super::pixel::Pixel;
use super::reciprocal::Reciprocal;
use super::reciprocal_root::refined_root;
use super::span::Span;
use super::vector::dot;
use core::num::NonZeroU32;

impl Span {
    /// Shades a line by naive Phong shading as printed (L21 4.1).
    ///
    /// Each pixel computes the unit normal, then R = 2 (L·N) N − L, then R·V. A table and one step
    /// of Newton's method compute the root. Its errors are those of [`Span::naive`].
    #[inline(always)]
    pub fn naive_as_printed<P: Pixel>(self, line: &mut [P], light: &Light<'_, P>) {
        self.in_pieces(
            line,
            Self::between,
            #[inline(always)]
            |span, line| {
                let [mut x, mut y, mut z] = span.normals(Reciprocal::of(line.len()));
                let lights = &[*light];
                for pixel in line {
                    let n = [x.next() >> 15, y.next() >> 15, z.next() >> 15]; // 4.2
                    let d = dot(n, n);
                    let r = refined_root(d);
                    let n = [(n[0] * r) >> 15, (n[1] * r) >> 15, (n[2] * r) >> 15]; // N_unit = N / |N|
                    let j = dot(light.toward, n) >> 15;
                    let reflected = |i: usize| ((j * n[i]) >> 14) - light.toward[i]; // R = 2 (L·N) N − L
                    let s = dot([reflected(0), reflected(1), reflected(2)], light.eye) >> 15;
                    *pixel =
                        P::from_fields(shade::<P, Reflection, 1>(lights, |_| (j << 16, TOP - s)));
                }
            },
        );
    }

    /// Shades a line by fast Phong shading as printed (L21 4.2, 4.3).
    ///
    /// Additions step J, K and N. Each pixel computes D = N·N, then d = √D by a step of Newton's
    /// method with a division (L21 4.4), then J/d and J K / D by divisions.
    ///
    /// Those are three divisions per pixel. On a Cortex-M0, which has no divider, this takes seven
    /// times as long as naive Phong shading. While a span turns by at most about 2° per pixel, its
    /// errors are those of [`Span::fast`] with `REFINED`.
    #[inline(always)]
    pub fn fast_as_printed<P: Pixel>(self, line: &mut [P], light: &Light<'_, P>) {
        let lights = &[*light];
        self.in_pieces(
            line,
            Self::between,
            #[inline(always)]
            |span, line| {
                let n = Reciprocal::of(line.len());
                let ([mut j], [mut k]) = span.products::<P, Reflection, 1>(lights, n);
                let [mut x, mut y, mut z] = span.normals(n);
                let first = dot(span.first, span.first);
                // d = D / √D in Q15. The first pixel has no previous d to start from.
                let mut length = ((first >> 15) * refined_root(first)) >> 15;
                for pixel in line {
                    let n = [x.next() >> 15, y.next() >> 15, z.next() >> 15]; // 4.2
                    let d = dot(n, n) as u32;
                    // One step from the previous pixel's d; + 1 rounds the half.
                    length = (length + over(d, length as u32) + 1) >> 1; // 4.4
                    let (j, k) = (j.next() >> 15, k.next() >> 15); // 4.3
                    // From behind there is no highlight, and unsigned divisions need no sign.
                    let front = j.max(0);
                    let unit_j = over((front as u32) << 15, length as u32);
                    let product = over(((front * k.max(0)) as u32) << 1, d >> 14); // 4.6
                    let cosines = (
                        if j < 0 { -1 } else { unit_j << 16 },
                        TOP + light.l_v - (product << 1),
                    );
                    *pixel = P::from_fields(shade::<P, Reflection, 1>(lights, |_| cosines));
                }
            },
        );
    }
}

/// Returns a/b, at most 2 in Q15; a if b is 0. A divisor that its type says is not 0 needs no
/// check.
#[inline(always)]
fn over(a: u32, b: u32) -> i32 {
    (a / NonZeroU32::new(b).unwrap_or(NonZeroU32::MIN)).min(1 << 16) as i32
}
