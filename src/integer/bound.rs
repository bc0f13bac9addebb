//! Bounds on the errors of pictures in integers, derived from the number formats.

use super::pixel::Pixel;
use super::span::Span;

/// 2⁻¹⁵, the unit of vectors.
const UNIT: f64 = 1.0 / 32768.0;

/// The quantities that a bound on errors depends on: a material under one light, and the longest
/// and widest span between unit normals.
///
/// The bound holds for [`Span::naive`], [`Span::fast`] and, with `is_parabola`,
/// [`Span::quadratic`], on spans and triangles whose normals lie within 90° of one another. With
/// `is_slerp` it holds for [`Span::slerp`] up to 60°. Under several lights the bounds of the lights
/// add up. A triangle with sides of 32 pixels and more is drawn with corners that are off by up to
/// 2⁻¹³ of its longest side. Gouraud shading is off by its corners' bounds, a field's last bit and
/// n 2⁻¹⁶.
#[derive(Clone, Copy, Debug)]
pub struct ErrorBound {
    /// I_p k_d of the channel where it is largest.
    pub diffuse: f64,
    /// I_p k_s of the channel where it is largest.
    pub highlight: f64,
    /// The exponent of the highlight.
    pub shininess: u32,
    /// The largest angle between two normals of a span or triangle, in radians.
    pub angle: f64,
    /// The largest count of pixels in a span, before it is cut into pieces.
    pub pixels: usize,
    /// True if a step of Newton's method refines 1/√D.
    pub is_refined: bool,
    /// True if cosines are parabolas.
    pub is_parabola: bool,
    /// True if the highlight is computed from N·H.
    pub is_halfway: bool,
    /// True if normals turn at a uniform rate.
    pub is_slerp: bool,
}

impl ErrorBound {
    /// Returns how far a channel may be off at most, in grey levels. This includes rounding to the
    /// pixel's format.
    ///
    /// The bound does not hold where L·N is so close to 0 that its error decides the sign: there a
    /// highlight may be lost or gained.
    pub fn levels<P: Pixel>(&self) -> f64 {
        let (tables, rounding) = self.parts::<P>();
        tables + rounding
    }

    /// Returns the bound of [`ErrorBound::levels`] in two parts: the error before the fraction is
    /// cut, and the cut.
    pub(super) fn parts<P: Pixel>(&self) -> (f64, f64) {
        let bits = f64::from(P::BITS[0].min(P::BITS[2]));
        let top = libm::exp2(bits) - 1.0;
        // Both tables round to the last bit of a field, which has 9 bits.
        let entries = 2.0 * 0.5 * 255.0 / (top * libm::exp2(9.0 - bits));
        let diffuse = 255.0 * self.diffuse * (1.0 / 510.0 + self.diffuse_cosine());
        let slope = f64::from(self.shininess);
        // Beyond the end of its table the power is below 2⁻⁹.
        let power = (slope * (self.half_step() + self.highlight_cosine())).min(1.0) + 1.0 / 512.0;
        let steep = 255.0 * self.highlight * power;
        (entries + diffuse + steep, 0.5 * 255.0 / top)
    }

    /// Returns the relative error of 1/√D, or the drift of a sine wave.
    fn root(&self) -> f64 {
        if self.is_slerp {
            return self.wave();
        }
        let least = 0.5 + 0.5 * libm::cos(self.angle);
        let n = self.steps();
        // D by second differences: two Q14 coefficients, at most 2 sin²(θ/2) and four times that,
        // times a mantissa with an error of 2⁻¹⁵; a cut at 2⁻¹⁴; and cuts at 2⁻³⁰, which grow with
        // n².
        let turn = 4.0 * (1.0 - least);
        let drift = 2.0 * UNIT + 3.0 * turn * UNIT + 2.0 * UNIT + n * n * libm::exp2(-30.0);
        // Half a step of the table, or the cuts of a step of Newton's method.
        let root = if self.is_refined || self.is_parabola {
            2.0 * UNIT
        } else {
            libm::exp2(-13.0) / least
        };
        root + drift / (2.0 * least)
    }

    /// Returns the drift of a sine wave. Its parts are half the cut of α (2⁻¹²), the cut of n sin φ
    /// / sin θ (2⁻¹⁴), half the cut of θ² (2⁻¹⁴), a cut of 2⁻³⁰ at each step, and half the terms
    /// that the series of θ² leaves out. With x = 1 − cos θ these are 2x · (8x⁴/1575 + …), each
    /// below x/2 times the previous one.
    fn wave(&self) -> f64 {
        let (n, x) = (self.steps(), 1.0 - libm::cos(self.angle));
        let series = x * x * x * x * x * 8.0 / 1575.0 / (1.0 - x / 2.0);
        (4.0 + 2.0 + 1.0) * UNIT + n * n * libm::exp2(-31.0) + series
    }

    /// Returns how many pixels are stepped at once, at most.
    fn steps(&self) -> f64 {
        self.pixels.min(Span::MAX) as f64
    }

    /// Returns the error of J and K before the division: both vectors are rounded (√3/2 units
    /// each), and there are a Q14 difference, a mantissa and a cut.
    fn product(&self) -> f64 {
        // Where a line is cut, its normal is rounded again. On 65,536 pixels and more it also moves
        // by up to √2 units. Both count divided by its length, which is √½ at 90°.
        let cut = if self.pixels > Span::MAX { 3.25 } else { 0.0 };
        (1.75 + 0.5 + 1.0 + 1.0 + cut) * UNIT
    }

    /// Returns the error of L·N at a pixel.
    fn diffuse_cosine(&self) -> f64 {
        let cubed = self.angle * self.angle * self.angle;
        // Interpolating at 0, ½ and 1 leaves an error of f‴/6 · √3/36. |f‴| is at most 3 θ³: θ³
        // from cos φ, and 2 θ³ because points of a chord do not turn uniformly.
        let left_out = if self.is_parabola {
            0.0241 * cubed
        } else {
            0.0
        };
        self.root() + self.product() + left_out
    }

    /// Returns the error of the highlight's cosine at a pixel. R·V is 2 (L·N)(V·N) − L·V, where
    /// both cosines have their errors and there are six cuts. N·H is one cosine.
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

    /// Returns half a step of the table of highlights that [`Material::new`](super::Material::new)
    /// chooses.
    fn half_step(&self) -> f64 {
        libm::exp2(f64::from(super::material::shift_for(self.shininess)) - 16.0)
    }
}
