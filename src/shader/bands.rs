//! From a method, an engine and an instruction set to loops over bands.

use super::dispatch::{Job, dispatch_wide};
use super::{Method, Shader};
use crate::frame::Frame;
use crate::number::{Lanes, LanesJob, Level, Scalar, on_level};
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

/// Draws a frame that the engine can draw.
pub(super) fn draw<D: Method>(engine: Engine, frame: &Frame, parameters: &[u32], level: Level, bands: &mut dyn Bands) {
    struct Draw<'a>(Engine, &'a Frame, &'a [u32], Level, &'a mut dyn Bands);
    impl Job for Draw<'_> {
        type Out = ();
        fn run<S: Shader>(self) {
            let Draw(engine, frame, parameters, level, bands) = self;
            on_level(level, OnLevel::<S> { engine, frame, parameters, bands, shader: PhantomData });
        }
    }
    dispatch_wide::<D, _>(frame, Draw(engine, frame, parameters, level, bands));
}

struct OnLevel<'a, S> {
    engine: Engine,
    frame: &'a Frame,
    parameters: &'a [u32],
    bands: &'a mut dyn Bands,
    shader: PhantomData<S>,
}

impl<S: Shader> LanesJob for OnLevel<'_, S> {
    type Out = ();

    fn run<M: Lanes>(self, m: M) {
        match self.engine {
            Engine::Span => spans::draw::<S, M>(m, self.frame, self.parameters, self.bands),
            Engine::Row => rows::draw::<S, M>(m, self.frame, self.parameters, self.bands),
        }
    }
}
