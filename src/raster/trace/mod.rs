//! Traces: what the span engine does with a frame, scanline by scanline, as one document.
//!
//! [`Variant::trace`] records a [`Trace`], which serialises to JSON (`docs/trace.md`). The recorder
//! reads the engine's edges, spans and runs between its steps; the engine's loops know nothing of
//! it.

mod document;
mod record;

pub use document::Trace;

/// The parts of a [`Trace`]: the types of its fields.
#[doc(hidden)]
pub mod parts {
    pub use super::document::{
        TraceActive, TraceCircle, TraceEdge, TraceEntry, TraceKind, TraceLight, TraceLine,
        TraceMaterial, TraceNames, TracePlace, TracePolygon, TraceRun, TraceSpan, TraceVertex,
    };
}

use super::draw::DrawError;
use super::engine::{Plan, Renderer};
use super::setup::SetUp;
use crate::frame::Frame;
use crate::number::SimdLevel;
use crate::shading::Variant;
use alloc::vec::Vec;

impl Variant {
    /// Traces the span engine as it draws `frame`. Records every scanline; with `Some(line)` only
    /// this one, with the polygons that it meets.
    ///
    /// # Errors
    /// [`DrawError::Refused`] if the method refuses the frame.
    ///
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::scene::Scene;
    /// use fastphong::shading::Variant;
    ///
    /// let mut scene = Scene::of_mesh(builtin("sphere")?);
    /// (scene.width, scene.height) = (24, 16);
    /// let frame = scene.frame()?;
    /// let gouraud = Variant::parse("gouraud")?;
    /// let trace = gouraud.trace(&frame, Some(8))?;
    /// let run = &trace.lines[0].runs[0];
    /// let picture = gouraud.render_linear(&frame)?;
    /// assert_eq!(picture.get(run.x as usize, 8)[..3], run.colours[0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn trace(&self, frame: &Frame, line: Option<usize>) -> Result<Trace, DrawError> {
        if let Plan::Refused(reason) = self.plan(frame, Renderer::Span) {
            return Err(DrawError::Refused(reason));
        }
        let row = self.row().on(frame);
        let kernels = row.walked_kernels(frame.is_local());
        let setup = SetUp::by(kernels, self, frame, SimdLevel::Scalar, 1.0, Vec::new());
        let walked = &row.walked[usize::from(frame.is_local())];
        Ok(record::record(self, &setup, walked, line))
    }
}
