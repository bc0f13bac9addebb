//! One colour a polygon (L21 2): what the definitions of flat shading have in common; they differ by the normal.

use super::local::Lights;
use super::{Corner, Corners, Given, Shader, SpanOf};
use crate::lighting::Lighting;
use crate::number::{Machine, Num, Real};
use crate::walk::{Constant, Lerp};

/// Which normal a polygon is lit with.
pub trait PolygonNormal: 'static {
    /// A unit normal; `one` is 1.
    fn unit<M: Machine>(one: M::One, corners: &Corners<'_, M, Lerp<()>>) -> [M::One; 3];
}

/// One colour a polygon, of its normal `N` at the mean of its corners, with `L` lights seen as `P` says.
#[derive(Debug)]
pub struct Of<N, P, const L: usize>(N, P);

impl<N: PolygonNormal, P: Lights, const L: usize> Shader for Of<N, P, L> {
    type Consts<T: Num> = P::Of<T, L>;
    type Attribute<R: Real> = Lerp<()>;
    type Polygon<R: Real> = [R; 3];
    type Walk<M: Machine> = Constant<[M::F; 3]>;
    type Pixel<F: Num> = [F; 3];
    const GIVEN: Given = Given::Polygon;

    fn consts<T: Num>(lighting: &Lighting, _: &[u32], of: &dyn Fn(f32) -> T) -> P::Of<T, L> {
        P::new(lighting, of)
    }
    #[inline(always)]
    fn vertex<M: Machine>(_: &P::Of<M::One, L>, _: &Corner<'_, M>) -> Lerp<()> {
        Lerp(())
    }
    #[inline(always)]
    fn polygon<M: Machine>(
        c: &P::Of<M::One, L>,
        corners: &Corners<'_, M, Lerp<()>>,
    ) -> [M::One; 3] {
        let (model, there) = (P::model(c), P::there(c, || corners.mean_position()));
        let normal = N::unit::<M>(model.one(), corners);
        model.clamped(model.lit(normal, P::seen(c, &there))) // 2.1
    }
    #[inline(always)]
    fn walk<M: Machine>(
        m: M,
        _: &P::Of<M::One, L>,
        colour: &[M::One; 3],
        _: &SpanOf<Self, M::One>,
    ) -> Self::Walk<M> {
        Constant(m.splat3(*colour))
    }
    #[inline(always)]
    fn shade<F: Num>(_: &P::Of<F, L>, colour: [F; 3]) -> [F; 3] {
        colour
    }
}
