//! From a method and a frame to a shader type: the crossing from run time to compile time, once a picture.

use super::{Method, Shader};
use crate::frame::Frame;
use crate::scene::{Interpolation, Scene};

/// Something to be done with a shader type.
pub(super) trait Job {
    /// What it gives.
    type Out;
    /// Does it.
    fn run<S: Shader>(self) -> Self::Out;
}

/// Does `job` with the method's shader for at least as many lights as `frame` has: 1, 2, 4, 8 or 64.
///
/// A shader for more lights than there are treats the others as dark, which costs time and changes no picture. So do the
/// crate's own unit tests, where fewer sizes are compiled: all of them are tested through what is public.
///
/// Where something is at a position there are 1, 4 and 64 only: every size more is compiled for all methods and engines,
/// and takes as long again.
pub(super) fn dispatch<D: Method, J: Job>(frame: &Frame, job: J) -> J::Out {
    let lights = frame.light_count();
    macro_rules! by_lights {
        ($shader:ident) => {
            match lights {
                #[cfg(not(test))]
                0 | 1 => job.run::<D::$shader<1>>(),
                #[cfg(not(test))]
                2 => job.run::<D::$shader<2>>(),
                0..=4 => job.run::<D::$shader<4>>(),
                #[cfg(not(test))]
                5..=8 => job.run::<D::$shader<8>>(),
                _ => job.run::<D::$shader<{ Scene::MAX_LIGHTS }>>(),
            }
        };
    }
    macro_rules! local {
        ($shader:ident) => {
            match lights {
                #[cfg(not(test))]
                0 | 1 => job.run::<D::$shader<1>>(),
                0..=4 => job.run::<D::$shader<4>>(),
                _ => job.run::<D::$shader<{ Scene::MAX_LIGHTS }>>(),
            }
        };
    }
    match (frame.interpolation(), frame.is_local()) {
        (Interpolation::Screen, false) => by_lights!(Screen),
        (Interpolation::Perspective, false) => by_lights!(Perspective),
        (Interpolation::Screen, true) => local!(Local),
        (Interpolation::Perspective, true) => local!(LocalPerspective),
    }
}

/// The most lights that [`dispatch_wide`] has a shader for.
pub(super) const MOST_LIGHTS: usize = 4;

/// Does `job` with the method's shader for one light or for four, at positions or not; `None` if there are more. For engines
/// that are compiled for several instruction sets, where every size more is compiled for each of them: with 64 lights the
/// crate took five times as long to compile.
pub(super) fn dispatch_wide<D: Method, J: Job>(frame: &Frame, job: J) -> Option<J::Out> {
    macro_rules! by_lights {
        ($shader:ident) => {
            match frame.light_count() {
                #[cfg(not(test))]
                0 | 1 => Some(job.run::<D::$shader<1>>()),
                0..=MOST_LIGHTS => Some(job.run::<D::$shader<MOST_LIGHTS>>()),
                _ => None,
            }
        };
    }
    match (frame.interpolation(), frame.is_local()) {
        (Interpolation::Screen, false) => by_lights!(Screen),
        (Interpolation::Perspective, false) => by_lights!(Perspective),
        (Interpolation::Screen, true) => by_lights!(Local),
        (Interpolation::Perspective, true) => by_lights!(LocalPerspective),
    }
}

/// Does `job` with the method's shader for one light or for four, where something is at a position for one or for two, in
/// space for one: for counts of operations, which need no picture; every further number of lights would only be code.
pub(super) fn dispatch_counts<D: Method, J: Job>(frame: &Frame, job: J) -> J::Out {
    match (frame.is_local(), frame.interpolation(), frame.light_count()) {
        (false, _, 0 | 1) => job.run::<D::Screen<1>>(),
        (false, _, _) => job.run::<D::Screen<4>>(),
        (true, Interpolation::Screen, 0 | 1) => job.run::<D::Local<1>>(),
        (true, Interpolation::Screen, _) => job.run::<D::Local<2>>(),
        (true, Interpolation::Perspective, _) => job.run::<D::LocalPerspective<1>>(),
    }
}

/// The same for measurements of spans: for one light or for four at infinity, for four at positions.
pub(super) fn dispatch_span<D: Method, J: Job>(frame: &Frame, job: J) -> J::Out {
    match (frame.is_local(), frame.light_count()) {
        (false, 0 | 1) => job.run::<D::Screen<1>>(),
        (false, _) => job.run::<D::Screen<4>>(),
        (true, _) => job.run::<D::LocalPerspective<4>>(),
    }
}
