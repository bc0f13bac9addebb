//! Walks: values that are stepped from pixel to pixel, or from scanline to scanline.
//!
//! *An edge is a walk between two corners, a span is a walk between two edges.* What is walked along edges is an
//! [`Attribute`]; along a span it is a [`Walk`], built of a few recurrences that compose: arrays and tuples of walks
//! are walks.

mod attribute;
mod linear;
mod newton;
mod quadratic;
mod sines;

pub use attribute::{Affine, Arc, Attribute, Facet, Lerp, Ramp, UnitNormal};
pub use linear::{Constant, Linear};
pub use newton::{MOST_STEPS, Newton, Steps};
pub use quadratic::Quadratic;
pub use sines::Sines;

use crate::number::each;

/// Running state along a span: gives the value here and steps on to the next pixel (or group of pixels).
pub trait Walk: Copy {
    /// What it gives.
    type Out: Copy;
    /// The value here; then steps.
    fn next(&mut self) -> Self::Out;
}

impl<W: Walk, const L: usize> Walk for [W; L] {
    type Out = [W::Out; L];

    #[inline(always)]
    fn next(&mut self) -> Self::Out {
        each(
            #[inline(always)]
            |i| self[i].next(),
        )
    }
}

impl<A: Walk, B: Walk> Walk for (A, B) {
    type Out = (A::Out, B::Out);

    #[inline(always)]
    fn next(&mut self) -> Self::Out {
        (self.0.next(), self.1.next())
    }
}

impl<A: Walk, B: Walk, C: Walk> Walk for (A, B, C) {
    type Out = (A::Out, B::Out, C::Out);

    #[inline(always)]
    fn next(&mut self) -> Self::Out {
        (self.0.next(), self.1.next(), self.2.next())
    }
}

impl<A: Walk, B: Walk, C: Walk, D: Walk> Walk for (A, B, C, D) {
    type Out = (A::Out, B::Out, C::Out, D::Out);

    #[inline(always)]
    fn next(&mut self) -> Self::Out {
        (self.0.next(), self.1.next(), self.2.next(), self.3.next())
    }
}

/// A walk that is needed or not, which is known before the first pixel.
impl<W: Walk> Walk for Option<W> {
    type Out = Option<W::Out>;

    #[inline(always)]
    fn next(&mut self) -> Self::Out {
        self.as_mut().map(
            #[inline(always)]
            |walk| walk.next(),
        )
    }
}

#[cfg(all(test, feature = "simd"))]
mod group_tests;
#[cfg(test)]
mod tests;
