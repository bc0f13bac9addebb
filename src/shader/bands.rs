//! From a method and a frame to the row engine's loops over bands.

use super::dispatch::{Job, MOST_LIGHTS, dispatch_wide};
use super::{Method, Shader};
use crate::frame::Frame;
use crate::number::{Lanes, LanesJob, Level, Scalar, on_wide_level};
use crate::raster::{Bands, rows};
use core::marker::PhantomData;

/// Returns why the row engine cannot draw a frame with a method; `None` where it can.
pub(super) fn refusal<D: Method>(frame: &Frame) -> Option<&'static str> {
    struct Refusal<'a>(&'a Frame);
    impl Job for Refusal<'_> {
        type Out = Option<&'static str>;
        fn run<S: Shader>(self) -> Option<&'static str> {
            rows::refusal::<S, Scalar>(self.0)
        }
    }
    const { assert!(MOST_LIGHTS == 4) };
    dispatch_wide::<D, _>(frame, Refusal(frame))
        .unwrap_or(Some("the row engine has no more than four lights"))
}

/// Draws a frame that the row engine can draw; returns whether it did.
pub(super) fn draw<D: Method>(
    frame: &Frame,
    parameters: &[u32],
    level: Level,
    bands: &mut dyn Bands,
) -> bool {
    struct Draw<'a>(Level, &'a Frame, &'a [u32], &'a mut dyn Bands);
    impl Job for Draw<'_> {
        type Out = bool;
        fn run<S: Shader>(self) -> bool {
            let Draw(level, frame, parameters, bands) = self;
            on_wide_level(level, Rows::<S>(frame, parameters, bands, PhantomData)).is_ok()
        }
    }
    dispatch_wide::<D, _>(frame, Draw(level, frame, parameters, bands)).unwrap_or(false)
}

struct Rows<'a, S>(&'a Frame, &'a [u32], &'a mut dyn Bands, PhantomData<S>);

impl<S: Shader> LanesJob for Rows<'_, S> {
    type Out = ();

    fn run<M: Lanes>(self, m: M) {
        rows::draw::<S, M>(m, self.0, self.1, self.2);
    }
}
