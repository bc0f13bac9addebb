//! From a method, an engine and an instruction set to loops over bands.

use super::dispatch::{Job, dispatch_wide};
use super::{Method, Shader};
use crate::frame::Frame;
use crate::number::{Lanes, LanesJob, Level, Scalar, on_level, on_wide_level};
use crate::raster::{Bands, Engine, rows, spans};
use core::marker::PhantomData;

/// Whether an engine can draw a frame with a method, in bands.
pub(super) fn can_draw<D: Method>(engine: Engine, frame: &Frame) -> bool {
    struct Can<'a>(Engine, &'a Frame);
    impl Job for Can<'_> {
        type Out = bool;
        fn run<S: Shader>(self) -> bool {
            match self.0 {
                Engine::Span => true,
                Engine::Row => rows::can_draw::<S, Scalar>(self.1),
            }
        }
    }
    dispatch_wide::<D, _>(frame, Can(engine, frame)).unwrap_or(false)
}

/// Draws a frame that the engine can draw; whether it did. The span engine has no scalar level here: that is the lecture's
/// own form, which draws on its own.
pub(super) fn draw<D: Method>(
    engine: Engine,
    frame: &Frame,
    parameters: &[u32],
    level: Level,
    bands: &mut dyn Bands,
) -> bool {
    struct Draw<'a>(Engine, Level, &'a Frame, &'a [u32], &'a mut dyn Bands);
    impl Job for Draw<'_> {
        type Out = bool;
        fn run<S: Shader>(self) -> bool {
            let Draw(engine, level, frame, parameters, bands) = self;
            match engine {
                Engine::Span => {
                    on_wide_level(level, Spans::<S>(frame, parameters, bands, PhantomData)).is_ok()
                }
                Engine::Row => {
                    on_level(level, Rows::<S>(frame, parameters, bands, PhantomData));
                    true
                }
            }
        }
    }
    dispatch_wide::<D, _>(frame, Draw(engine, level, frame, parameters, bands)).unwrap_or(false)
}

struct Spans<'a, S>(&'a Frame, &'a [u32], &'a mut dyn Bands, PhantomData<S>);

impl<S: Shader> LanesJob for Spans<'_, S> {
    type Out = ();

    fn run<M: Lanes>(self, m: M) {
        spans::draw::<S, M>(m, self.0, self.1, self.2);
    }
}

struct Rows<'a, S>(&'a Frame, &'a [u32], &'a mut dyn Bands, PhantomData<S>);

impl<S: Shader> LanesJob for Rows<'_, S> {
    type Out = ();

    fn run<M: Lanes>(self, m: M) {
        rows::draw::<S, M>(m, self.0, self.1, self.2);
    }
}
