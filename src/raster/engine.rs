//! The choice of an engine. The span engine is scalar, the row engine uses SIMD.

use crate::number::SimdLevel;
use crate::number::parallel;

/// A set of loops that draws a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Engine {
    /// One pixel at a time, the lecture's way: active edges, a depth buffer of one line, and
    /// visible runs that are walked and shaded once.
    Span,
    /// SIMD: a deferred renderer, which stores varyings in a G-buffer and shades each row once.
    Row,
}

impl Engine {
    /// Returns the engine's name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Span => "span",
            Engine::Row => "row",
        }
    }
}

/// An engine with its instruction set. The current pool of `rayon` decides how many threads it uses
/// (feature `threads`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Renderer {
    /// The span engine, one pixel at a time.
    #[default]
    Span,
    /// The row engine on these SIMD instructions. On [`SimdLevel::Scalar`], or on a machine without
    /// them, the span engine draws instead: see [`crate::shading::Variant::plan`].
    Row(SimdLevel),
}

impl Renderer {
    /// The span engine, which draws as the lecture does: one pixel at a time, on one thread. Its
    /// pictures are the same bits on every platform, and every other renderer is compared with it.
    pub const LECTURE: Renderer = Renderer::Span;

    /// Returns the renderer for `level`: the span engine on [`SimdLevel::Scalar`], the row engine
    /// on any other.
    pub fn on(level: SimdLevel) -> Renderer {
        match level {
            SimdLevel::Scalar => Renderer::Span,
            level => Renderer::Row(level),
        }
    }

    /// Returns the fastest renderer of this machine.
    pub fn fastest() -> Renderer {
        Renderer::on(SimdLevel::best())
    }

    /// Returns all renderers of this machine, [`Renderer::LECTURE`] first.
    pub fn available() -> impl Iterator<Item = Renderer> {
        SimdLevel::available().map(Renderer::on)
    }

    /// Returns the engine.
    pub fn engine(self) -> Engine {
        match self {
            Renderer::Span => Engine::Span,
            Renderer::Row(_) => Engine::Row,
        }
    }

    /// Returns the instruction set of the pixel loops.
    pub fn level(self) -> SimdLevel {
        match self {
            Renderer::Span => SimdLevel::Scalar,
            Renderer::Row(level) => level,
        }
    }

    /// Returns how many threads walk and shade pixels. The span engine uses one. The row engine
    /// uses all threads of the current pool of `rayon`, or one without the feature `threads`. Both
    /// light vertices on all threads of the pool.
    pub fn threads(self) -> usize {
        match self {
            Renderer::Span => 1,
            Renderer::Row(_) => parallel::threads(),
        }
    }
}

/// A kind of polygon of a method, and how many polygons of a frame the method draws in that way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
#[non_exhaustive]
pub struct PolygonKind {
    /// The kind's name.
    pub name: &'static str,
    /// How many polygons are of this kind.
    pub polygons: usize,
}

/// The answer to which renderer draws a frame: see [`crate::shading::Variant::plan`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Plan {
    /// The requested renderer draws.
    AsAsked(Renderer),
    /// Another renderer draws.
    Instead {
        /// The renderer.
        renderer: Renderer,
        /// Why the requested renderer does not draw: a sentence without its full stop.
        reason: &'static str,
    },
    /// No renderer draws, because the method refuses this frame ([`crate::shading::Shader::on`]).
    /// Holds the reason.
    Refused(&'static str),
}

impl Plan {
    /// Returns the renderer that draws; `None` if the method refuses the frame.
    pub fn renderer(self) -> Option<Renderer> {
        match self {
            Plan::AsAsked(renderer) | Plan::Instead { renderer, .. } => Some(renderer),
            Plan::Refused(_) => None,
        }
    }

    /// Returns why the requested renderer does not draw; `None` if it does.
    pub fn reason(self) -> Option<&'static str> {
        match self {
            Plan::AsAsked(_) => None,
            Plan::Instead { reason, .. } | Plan::Refused(reason) => Some(reason),
        }
    }
}
