//! What is seen besides colours: depth, normals, polygon numbers, and which pixels each polygon covers.
//!
//! A mean of depths or of polygon numbers means nothing: all these are of single samples, [`Frame::width`] ×
//! [`Frame::height`] of them, and where a frame has several a pixel nothing here is filtered.

use super::scanline::scan_all;
use super::visibility::NOTHING;
use crate::frame::Frame;
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real, Scalar, dot, each};
use crate::picture::{LinearPicture, Picture};
use crate::shader::{Corner, Corners, Shader, SpanOf};
use crate::walk::{Lerp, Linear};
use alloc::vec;
use core::ops::Range;

/// The number of the polygon seen at each pixel, an index into [`Frame::polygons`], or [`NOTHING`].
///
/// It does not depend on the shading method.
pub fn polygon_numbers(frame: &Frame) -> Picture<u32> {
    let mut picture = Picture::new(frame.width(), frame.height(), NOTHING);
    let attributes = vec![Lerp(()); frame.vertices().len()];
    scan_all(Scalar, frame, &attributes, &mut |row, line, _| {
        for (x, texel) in picture.row_mut(row).iter_mut().enumerate() {
            *texel = line.polygon(x);
        }
    });
    picture
}

/// Depth at each pixel as it is compared, 0 at the near plane, 1 at the far plane; infinite where nothing is seen.
pub fn depth(frame: &Frame) -> Picture<f32> {
    let mut picture = Picture::new(frame.width(), frame.height(), f32::INFINITY);
    let attributes = vec![Lerp(()); frame.vertices().len()];
    scan_all(Scalar, frame, &attributes, &mut |row, line, _| {
        for (texel, depth) in picture.row_mut(row).iter_mut().zip(line.depth()) {
            *texel = depth;
        }
    });
    picture
}

/// Every span of every polygon, hidden ones too: polygon number, row, and the pixels whose centres it covers.
///
/// Rows come in order, and within a row polygons in drawing order. A pixel is covered when its centre has an odd number
/// of the polygon's edges to its left.
pub fn coverage(frame: &Frame, mut visit: impl FnMut(u32, usize, Range<usize>)) {
    let attributes = vec![Lerp(()); frame.vertices().len()];
    scan_all(Scalar, frame, &attributes, &mut |row, line, _| {
        for span in line.spans() {
            visit(span.polygon, row, span.start as usize..span.end as usize);
        }
    });
}

/// The unit normal at each pixel, in world space, as (N + 1)/2; alpha 0 where nothing is seen.
pub fn normals(frame: &Frame) -> LinearPicture {
    let mut picture = super::target::linear_samples(frame);
    super::scanline::draw::<Normals, Scalar>(Scalar, frame, &[], &mut picture);
    picture
}

/// Shows normals as colours. Not a shading method, so it is not in the table.
struct Normals;

impl Shader for Normals {
    type Consts<N: Num> = [N; 2];
    type Attribute<R: Real> = Lerp<[R; 3]>;
    type Polygon<R: Real> = ();
    type Walk<M: Machine> = [Linear<M::F>; 3];
    type Pixel<F: Num> = [F; 3];

    fn consts<N: Num>(_: &Lighting, _: &[u32], of: &dyn Fn(f32) -> N) -> [N; 2] {
        [of(1.0), of(0.5)]
    }
    #[inline(always)]
    fn vertex<M: Machine>(_: &[M::One; 2], corner: &Corner<'_, M>) -> Lerp<[M::One; 3]> {
        Lerp(corner.normal())
    }
    #[inline(always)]
    fn polygon<M: Machine>(_: &[M::One; 2], _: &Corners<'_, M, Lerp<[M::One; 3]>>) {}
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &[M::One; 2],
        _: &(),
        span: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        each(
            #[inline(always)]
            |i| Linear::new(m, span.attribute.at[i], span.attribute.step[i]),
        )
    }
    #[inline(always)]
    fn shade<F: Num>([one, half]: &[F; 2], n: [F; 3]) -> [F; 3] {
        let r = *one / dot(n, n).sqrt();
        each(
            #[inline(always)]
            |i| *half * (n[i] * r) + *half,
        )
    }
}
