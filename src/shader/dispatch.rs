//! From a method and a frame to a shader type: the crossing from run time to compile time, once a picture.

use super::{Method, Shader};
use crate::scene::{Interpolation, Scene};

/// Something to be done with a shader type.
pub(super) trait Job {
    /// What it gives.
    type Out;
    /// Does it.
    fn run<S: Shader>(self) -> Self::Out;
}

/// Does `job` with the method's shader for at least `lights` lights: one to four, then 8, then 64.
///
/// A shader for more lights than there are treats the others as dark, which costs time and changes no picture.
pub(super) fn dispatch<D: Method, J: Job>(lights: usize, interpolation: Interpolation, job: J) -> J::Out {
    macro_rules! by_lights {
        ($shader:ident) => {
            match lights {
                0 | 1 => job.run::<D::$shader<1>>(),
                2 => job.run::<D::$shader<2>>(),
                3 => job.run::<D::$shader<3>>(),
                4 => job.run::<D::$shader<4>>(),
                5..=8 => job.run::<D::$shader<8>>(),
                _ => job.run::<D::$shader<{ Scene::MAX_LIGHTS }>>(),
            }
        };
    }
    match interpolation {
        Interpolation::Screen => by_lights!(Screen),
        Interpolation::Perspective => by_lights!(Perspective),
    }
}

/// Does `job` with the method's shader for one light or for four: for measurements of spans and counts of operations,
/// which need no picture, every further number of lights would only be code.
pub(super) fn dispatch_sample<D: Method, J: Job>(lights: usize, job: J) -> J::Out {
    if lights <= 1 { job.run::<D::Screen<1>>() } else { job.run::<D::Screen<4>>() }
}
