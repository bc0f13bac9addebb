//! Depth at a sample: how the interpolated value becomes the depth that is compared.
//! `SampleDepth::seen` is the depth test of a sample. `Writer` in `rows/tile.rs` tests blocks, and
//! `VisibleLine::draw` in `spans/line.rs` has a shortcut for depths that are compared as they are
//! interpolated.

use crate::frame::{DepthRange, Frame, ScreenVertex};
use crate::scene::{Clipping, DepthSource, HiddenSurfaces};

/// The rule by which depth is computed at a sample, stored and compared. A smaller depth is nearer.
///
/// ```text
/// interpolated, 32 bits:     d = q,                       q = the corners' depth: −1/w, or z if orthographic
/// interpolated, in levels:   z = q,                       q = z/w at the corners
/// per sample, perspective:   z = f/(f−n) · (1 − q),       q = n/w at the corners; or d = −q/n
/// per sample, orthographic:  z = 1/(f−n) · (q − n),       q = the distance of the corners
/// ```
/// Depth in levels is z, as the lecture has it. The third line is L5's z ↦ (f+n)/(f−n) + (1/z) ·
/// 2fn/(f−n) with z = −w, moved from −1..1 to 0..1. Depth in floats is d = −1/w under perspective,
/// because its relative precision is the same at every distance.
#[derive(Clone, Copy, Debug)]
pub struct SampleDepth {
    quantity: Quantity,
    range: DepthRange,
    /// The factor of 1/w at the corners, where 1/w is interpolated.
    weight_scale: f64,
    origin: f32,
    factor: f32,
    /// The largest integer that depth is stored as; `None` if it is stored as a float.
    pub most: Option<u32>,
    /// True if nearer samples hide farther ones.
    pub hides: bool,
    /// The smallest and the largest depth of samples that are drawn: the ends of the NDC cube.
    /// `None` if all samples are drawn.
    pub cube: Option<[f32; 2]>,
}

/// The quantity that is interpolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    /// The depth of the corners.
    Depth,
    /// z/w.
    Z,
    InverseW,
    Distance,
}

impl SampleDepth {
    /// Returns the rule that `frame` asks for.
    pub fn new(frame: &Frame) -> Self {
        let buffer = match frame.hidden_surfaces() {
            HiddenSurfaces::ZBuffer(buffer) => Some(buffer),
            HiddenSurfaces::Painter(_) | HiddenSurfaces::DrawOrder => None,
        };
        let range = frame.depth_range();
        let (near, far) = range.ends();
        let most = buffer.and_then(|buffer| buffer.bits.most());
        let source = buffer.unwrap_or_default().source;
        let scale = frame.weight_scale;
        let (quantity, origin, factor) = match (source, range, most) {
            (DepthSource::Interpolated, DepthRange::Perspective { .. }, Some(_)) => {
                (Quantity::Z, 0.0, 1.0)
            }
            (DepthSource::Interpolated, ..) => (Quantity::Depth, 0.0, 1.0),
            (_, DepthRange::Perspective { .. }, None) => {
                (Quantity::InverseW, 0.0, -1.0 / (near * scale))
            }
            (_, DepthRange::Perspective { .. }, Some(_)) => {
                (Quantity::InverseW, scale, -far / (far - near) / scale)
            }
            (_, DepthRange::Orthographic { .. }, _) => {
                (Quantity::Distance, near, 1.0 / (far - near))
            }
        };
        // Levels store z, which is 0 at the near plane and 1 at the far one.
        let ends = match most {
            Some(_) => [0.0, 1.0],
            None => range.depths(),
        };
        SampleDepth {
            quantity,
            range,
            weight_scale: scale,
            origin: origin as f32,
            factor: factor as f32,
            most,
            hides: buffer.is_some(),
            cube: (frame.clipping() == Clipping::NdcCube).then(|| ends.map(|end| end as f32)),
        }
    }

    /// True if depth is interpolated and not computed at each sample.
    pub fn is_interpolated(&self) -> bool {
        matches!(self.quantity, Quantity::Depth | Quantity::Z)
    }

    /// True if the interpolated value itself is stored and compared, without any other test.
    pub fn is_plain(&self) -> bool {
        self.hides && self.is_interpolated() && self.most.is_none() && self.cube.is_none()
    }

    /// Returns the value of a corner that is interpolated.
    #[inline(always)]
    pub fn of_corner(&self, vertex: &ScreenVertex) -> f32 {
        match self.quantity {
            Quantity::Depth => vertex.depth as f32,
            Quantity::Z => self.range.z(vertex.depth) as f32,
            Quantity::InverseW => (vertex.inv_w * self.weight_scale) as f32,
            Quantity::Distance => {
                let (near, far) = self.range.ends();
                (near + vertex.depth * (far - near)) as f32
            }
        }
    }

    /// Returns the depth to store for a sample whose interpolated value is `q`.
    #[inline(always)]
    pub fn stored(&self, q: f32) -> f32 {
        self.kept((q - self.origin) * self.factor)
    }

    /// Returns the depth to store for a sample whose interpolated value is `q`, if it passes the
    /// test against the stored `depth`.
    #[inline(always)]
    pub fn seen(&self, q: f32, depth: f32) -> Option<f32> {
        let d = (q - self.origin) * self.factor; // q itself where depth is interpolated
        // CS171 3, Algorithm 5 asks if the sample is in the cube. Only depth is tested here, as the
        // picture ends at the cube's other faces.
        let is_inside = self
            .cube
            .is_none_or(|[near, far]| (near..=far).contains(&d));
        let kept = self.kept(d);
        (is_inside && (!self.hides || kept < depth)).then_some(kept)
    }

    /// Returns the depth `d` as the depth buffer stores it: the float itself, or an integer in
    /// 0..=2ᵇ − 1, which an `f32` holds exactly.
    #[inline(always)]
    pub fn kept(&self, d: f32) -> f32 {
        match self.most {
            None => d,
            // The product has at most 48 bits and so is exact in f64. The conversion clamps at 0,
            // and `min` at the other end.
            Some(most) => (((f64::from(d) * f64::from(most) + 0.5) as u32).min(most)) as f32,
        }
    }

    /// Returns the z that a stored depth stands for: 0 at the near plane, 1 at the far one,
    /// infinite for an empty sample.
    pub fn shown(&self, kept: f32) -> f32 {
        match self.most {
            _ if kept.is_infinite() => kept,
            Some(most) => kept / most as f32,
            None => self.range.z(f64::from(kept)) as f32,
        }
    }
}

/// The test that a sample must pass against the caller's depth buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum DepthTest {
    /// Draws a sample if its depth is less: it is nearer.
    #[default]
    Less,
    /// Draws a sample if its depth is less or equal. Use it to draw the same polygons again, as for
    /// a second light: by any method, with the renderer that
    /// [`Variant::draw`](crate::shading::Variant::draw) returned. Engines round depths differently,
    /// so `draw` refuses this test where the buffer holds another engine's depths. The depths of
    /// other polygons in the same plane differ by roundings, too.
    LessOrEqual,
    /// Draws a sample if its value is greater, in a reversed buffer: it is nearer. Values are 1/w
    /// under perspective, else they go from 1 at the near plane down to 0 at the far one. An empty
    /// sample holds −∞ or 0.
    Greater,
    /// Draws a sample if its value is greater or equal, in a reversed buffer. As for `LessOrEqual`,
    /// draw all passes with one renderer.
    GreaterOrEqual,
}

/// The caller's depths for one row of samples.
pub(super) struct CallersDepth<'a> {
    pub stored: &'a mut [f32],
    pub test: CallersTest,
}

/// The test of samples against the caller's depth, which draws them or leaves them out.
#[derive(Clone, Copy, Debug)]
pub(super) struct CallersTest {
    pub test: DepthTest,
    /// The sum of a depth and its reversed value: 0 under perspective, else 1.
    end: f32,
}

impl CallersTest {
    pub fn new(frame: &Frame, test: DepthTest) -> Self {
        let end = match frame.depth_range() {
            DepthRange::Perspective { .. } => 0.0,
            DepthRange::Orthographic { .. } => 1.0,
        };
        CallersTest { test, end }
    }

    /// Returns a depth as the caller's buffer holds it.
    #[inline(always)]
    pub fn value<const REVERSED: bool>(self, depth: f32) -> f32 {
        if REVERSED { self.end - depth } else { depth }
    }

    /// Compares a pixel's depth with the caller's. If the pixel passes, stores its depth in the
    /// caller's buffer. Else makes the pixel's depth infinite, as if nothing had been drawn there.
    /// Returns true if the pixel is hidden.
    ///
    /// Callers choose the test by literals, outside of their loops over pixels.
    #[inline(always)]
    pub fn hide<const REVERSED: bool, const EQUAL: bool>(
        self,
        depth: &mut f32,
        stored: &mut f32,
    ) -> bool {
        let own = self.value::<REVERSED>(*depth);
        let is_seen = match (REVERSED, EQUAL) {
            (false, false) => own < *stored,
            (false, true) => own <= *stored,
            (true, false) => own > *stored,
            (true, true) => own >= *stored,
        };
        (*stored, *depth) = if is_seen {
            (own, *depth)
        } else {
            (*stored, f32::INFINITY)
        };
        !is_seen
    }
}

/// Returns the depths `z` of a block as levels of a depth buffer whose largest level is `most`,
/// which is below 2²⁴. Rounds exactly as [`SampleDepth::kept`] does, halves upward. For instruction
/// sets that fuse a product with a sum.
///
/// ```text
/// c = ⌊fl(z most)⌋,    level = c + [z most − c ≥ ½]
/// ```
/// The rounded product fl(z most) may reach the next integer c. Then z most is nearer than ½ to it,
/// and the level is c. Below 2²³ the sum c + ½ is exact; the difference from it is rounded once and
/// keeps its sign. From 2²³ on z is ½ or more, so z most − c is a multiple of 2⁻²⁴ of at most ½,
/// which is exact.
#[cfg(feature = "simd")]
#[inline(always)]
pub(super) fn level_of<S: fearless_simd::Simd>(
    m: crate::number::lanes::Lanes<S>,
    z: fearless_simd::f32x8<S>,
    most: f32,
) -> fearless_simd::f32x8<S> {
    use fearless_simd::{Select, SimdBase, SimdFloat};
    let (most, half, none) = (m.splat(most), m.splat(0.5), m.splat(0.0));
    let z = z.max(none).min(m.splat(1.0));
    let below = m.float(m.truncated(z * most));
    let over = below
        .simd_lt(m.splat(8_388_608.0))
        .select(z.mul_sub(most, below + half), z.mul_sub(most, below) - half);
    over.simd_lt(none).select(below, below + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::DepthBits;

    fn keeping(bits: DepthBits) -> SampleDepth {
        SampleDepth {
            quantity: Quantity::Depth,
            range: DepthRange::default(),
            weight_scale: 1.0,
            origin: 0.0,
            factor: 1.0,
            most: bits.most(),
            hides: true,
            cube: None,
        }
    }

    #[test]
    fn what_is_kept_is_rounded_to_the_nearest_level() {
        let sixteen = keeping(DepthBits::Sixteen);
        assert_eq!(
            [0.0, 0.5, 1.0].map(|z| sixteen.kept(z)),
            [0.0, 32768.0, 65535.0],
            "0.5 is 32767.5, and goes up"
        );
        assert_eq!(
            [-1e-9, 1.000_001, -3.0, 9.0].map(|z| sixteen.kept(z)),
            [0.0, 65535.0, 0.0, 65535.0]
        );
        // Every level of 24 bits is an f32, and is stored as itself. Neighbouring floats below 1
        // are different levels.
        let fine = keeping(DepthBits::TwentyFour);
        for level in (0..1 << 24)
            .step_by(9973)
            .chain([(1 << 24) - 2, (1 << 24) - 1])
        {
            let z = (f64::from(level) / f64::from((1 << 24) - 1)) as f32;
            assert_eq!(fine.kept(z), level as f32);
        }
        assert_eq!(keeping(DepthBits::ThirtyTwo).kept(1.5), 1.5);
        assert_eq!(
            [0.0, 65535.0, f32::INFINITY].map(|kept| sixteen.shown(kept)),
            [0.0, 1.0, f32::INFINITY]
        );
    }

    /// A block gets the levels that its samples get one by one, around every border between two
    /// levels of 16 bits and many of 24.
    #[cfg(all(feature = "simd", target_arch = "x86_64"))]
    #[test]
    fn blocks_keep_the_same_levels() {
        use crate::number::lanes::Lanes;
        let Some(token) = fearless_simd::Level::new().as_avx2() else {
            return;
        };
        let m = Lanes(token);
        let mut random = crate::number::test_random::Random::new(61);
        for bits in [DepthBits::Sixteen, DepthBits::TwentyFour] {
            let rule = keeping(bits);
            let most = bits.most().expect("levels");
            let step = if most < 1 << 16 { 1 } else { 101 };
            let mut depths = alloc::vec![-1.0, -1e-9, -0.0, 0.0, 1e-30, 1.0, 1.000_001, 7.0];
            for level in (0..most).step_by(step) {
                let border = ((f64::from(level) + 0.5) / f64::from(most)) as f32;
                let (below, above) = (border.next_down(), border.next_up());
                let middle = (f64::from(level) / f64::from(most)) as f32;
                depths.extend([
                    below.next_down(),
                    below,
                    border,
                    above,
                    above.next_up(),
                    middle,
                ]);
            }
            depths.extend((0..1 << 16).map(|_| random.signed().abs()));
            depths.extend((0..1 << 16).map(|_| random.signed().abs() / most as f32));
            depths.resize(depths.len().next_multiple_of(8), 0.5);
            for depths in depths.chunks_exact(8) {
                let mut levels = [0.0; 8];
                m.store(level_of(m, m.load(depths), most as f32), &mut levels);
                for (z, found) in depths.iter().zip(levels) {
                    assert_eq!(found, rule.kept(*z), "{most}: {z:e}");
                }
            }
        }
    }
}
