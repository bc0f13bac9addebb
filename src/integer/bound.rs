//! How far a picture in integers may be from its closed form, from the formats.

use super::pixel::Pixel;
use super::span::Span;

/// 2⁻¹⁵, the unit of vectors.
const UNIT: f64 = 1.0 / 32768.0;

/// What a bound on errors depends on: a material under one light, and the longest, widest span between unit normals.
///
/// It holds for [`naive`](super::naive), [`fast`](super::fast) and, with `is_parabola`,
/// [`quadratic`](super::quadratic), over spans and triangles whose normals lie within 90° of one
/// another, and with `is_slerp` for [`Span::slerp`](super::Span::slerp) up to 60°. Colours that several
/// lights add up to: the sum of their bounds. Triangles with sides of 32 pixels and more are drawn with corners that may lie 2⁻¹³
/// of the longest side elsewhere. Gouraud shading is off by its corners' bounds, a field's
/// last bit and n 2⁻¹⁶.
#[derive(Clone, Copy, Debug)]
pub struct ErrorBound {
    /// I_p k_d, the largest of the channels.
    pub diffuse: f64,
    /// I_p k_s, the largest of the channels.
    pub highlight: f64,
    /// The exponent of the highlight.
    pub shininess: u32,
    /// The largest angle between two normals of a span or triangle, in radians.
    pub angle: f64,
    /// The most pixels of a span, whether it is cut into pieces or not.
    pub pixels: usize,
    /// True if 1/√D is refined by a step of Newton's.
    pub is_refined: bool,
    /// True if cosines are parabolas.
    pub is_parabola: bool,
    /// True if the highlight is that of N·H.
    pub is_halfway: bool,
    /// True if normals turn at a uniform rate.
    pub is_slerp: bool,
}

impl ErrorBound {
    /// Returns the most that a channel may be off by in grey levels, the rounding to the pixel's format
    /// included.
    ///
    /// It is wrong where L·N is within the error of 0: there a highlight may be lost or gained.
    pub fn levels<P: Pixel>(&self) -> f64 {
        let (tables, rounding) = self.parts::<P>();
        tables + rounding
    }

    /// As [`ErrorBound::levels`], in two parts: before the fraction is cut, and the cut.
    pub(super) fn parts<P: Pixel>(&self) -> (f64, f64) {
        let bits = f64::from(P::BITS[0].min(P::BITS[2]));
        let top = libm::exp2(bits) - 1.0;
        // Both tables round to the last bit of a field of 9 bits.
        let entries = 2.0 * 0.5 * 255.0 / (top * libm::exp2(9.0 - bits));
        let diffuse = 255.0 * self.diffuse * (1.0 / 510.0 + self.diffuse_cosine());
        let slope = f64::from(self.shininess);
        // Above its table the power is below 2⁻⁹.
        let power = (slope * (self.half_step() + self.highlight_cosine())).min(1.0) + 1.0 / 512.0;
        let steep = 255.0 * self.highlight * power;
        (entries + diffuse + steep, 0.5 * 255.0 / top)
    }

    /// The error of 1/√D, relative to it, or what a sine wave drifts by.
    fn root(&self) -> f64 {
        if self.is_slerp {
            return self.wave();
        }
        let least = 0.5 + 0.5 * libm::cos(self.angle);
        let n = self.steps();
        // D by second differences: two coefficients of 14 bits, 2 sin²(θ/2) and four times that at most,
        // times a mantissa of 2⁻¹⁵, a cut at 2⁻¹⁴ and cuts at 2⁻³⁰ that grow with n².
        let turn = 4.0 * (1.0 - least);
        let drift = 2.0 * UNIT + 3.0 * turn * UNIT + 2.0 * UNIT + n * n * libm::exp2(-30.0);
        // Half a step of the table, or the cuts of a step of Newton's.
        let root = if self.is_refined || self.is_parabola {
            2.0 * UNIT
        } else {
            libm::exp2(-13.0) / least
        };
        root + drift / (2.0 * least)
    }

    /// The drift of a sine wave: half of the cut of α (2⁻¹²), the cut of n sin φ / sin θ (2⁻¹⁴), half of
    /// the cut of θ² (2⁻¹⁴), a cut of 2⁻³⁰ at each step, and half of what the series of θ² leaves out,
    /// whose next terms are 2x · (8x⁴/1575 + …), each below x/2 of the one before, x = 1 − cos θ.
    fn wave(&self) -> f64 {
        let (n, x) = (self.steps(), 1.0 - libm::cos(self.angle));
        let series = x * x * x * x * x * 8.0 / 1575.0 / (1.0 - x / 2.0);
        (4.0 + 2.0 + 1.0) * UNIT + n * n * libm::exp2(-31.0) + series
    }

    /// The most pixels that are stepped at once.
    fn steps(&self) -> f64 {
        self.pixels.min(Span::MAX) as f64
    }

    /// J and K before they are divided: both vectors rounded (√3/2 units each), a difference of
    /// 14 bits, a mantissa, and a cut.
    fn product(&self) -> f64 {
        // Where a line is cut, its normal is rounded again, and lies up to √2 units aside on 65,536 pixels and more: both
        // over its length, which is √½ at 90°.
        let cut = if self.pixels > Span::MAX { 3.25 } else { 0.0 };
        (1.75 + 0.5 + 1.0 + 1.0 + cut) * UNIT
    }

    /// L·N at a pixel.
    fn diffuse_cosine(&self) -> f64 {
        let cubed = self.angle * self.angle * self.angle;
        // Interpolation at 0, ½, 1 leaves f‴/6 · √3/36, and |f‴| is at most 3 θ³: cos φ has θ³, and the
        // angle of a chord's points 2 θ³.
        let left_out = if self.is_parabola {
            0.0241 * cubed
        } else {
            0.0
        };
        self.root() + self.product() + left_out
    }

    /// The highlight's cosine at a pixel: R·V is 2 (L·N)(V·N) − L·V, both cosines with their errors, and
    /// six cuts; N·H is one cosine.
    fn highlight_cosine(&self) -> f64 {
        if self.is_halfway {
            return self.diffuse_cosine() + UNIT;
        }
        let cubed = self.angle * self.angle * self.angle;
        // R turns by 2 θ: |f‴| is at most 8 θ³ + 2 · 2 θ³.
        let left_out = if self.is_parabola {
            0.0963 * cubed
        } else {
            0.0
        };
        4.0 * (self.root() + self.product()) + 6.0 * UNIT + left_out
    }

    /// Half a step of the table of highlights, as [`Material::new`](super::Material::new) chooses it.
    fn half_step(&self) -> f64 {
        libm::exp2(f64::from(super::material::shift_for(self.shininess)) - 16.0)
    }
}
