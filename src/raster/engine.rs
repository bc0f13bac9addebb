//! The choice of an engine: the span engine is scalar, the row engine SIMD.

use crate::number::Level;
use crate::number::parallel;

/// A set of loops that draw a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// One pixel at a time: active edges, a depth buffer of one line, and visible runs that are walked and shaded once, the
    /// lecture's way.
    Span,
    /// SIMD: a deferred renderer, whose varyings are kept in a G-buffer until each row is shaded once.
    Row,
}

impl Engine {
    /// Returns the name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Span => "span",
            Engine::Row => "row",
        }
    }
}

/// An engine with its instruction set. The current pool of `rayon` gives the number of threads (feature `threads`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Renderer {
    /// The span engine, one pixel at a time.
    #[default]
    Span,
    /// The row engine on these SIMD instructions. On [`Level::Scalar`], or where this machine does not have them, the span
    /// engine draws: see [`crate::shading::Variant::plan`].
    Row(Level),
}

impl Renderer {
    /// The lecture's own form: spans, one pixel at a time, on one thread. Its pictures are the same bits on every platform,
    /// and every other renderer is measured against it.
    pub const LECTURE: Renderer = Renderer::Span;

    /// Returns the engine that runs on `level`: the span engine on [`Level::Scalar`], the row engine on any other.
    pub fn on(level: Level) -> Renderer {
        match level {
            Level::Scalar => Renderer::Span,
            level => Renderer::Row(level),
        }
    }

    /// Returns the fastest that this machine has.
    pub fn fastest() -> Renderer {
        Renderer::on(Level::best())
    }

    /// Returns all that this machine has, the lecture's own form first.
    pub fn available() -> impl Iterator<Item = Renderer> {
        Level::available().map(Renderer::on)
    }

    /// Returns the loops.
    pub fn engine(self) -> Engine {
        match self {
            Renderer::Span => Engine::Span,
            Renderer::Row(_) => Engine::Row,
        }
    }

    /// Returns the instruction set of the pixel loops.
    pub fn level(self) -> Level {
        match self {
            Renderer::Span => Level::Scalar,
            Renderer::Row(level) => level,
        }
    }

    /// Returns how many threads walk and shade its pixels: one in the span engine, in the row engine those of the current
    /// pool of `rayon`, which is one without the feature `threads`. Both light vertices on all threads of the pool.
    pub fn threads(self) -> usize {
        match self {
            Renderer::Span => 1,
            Renderer::Row(_) => parallel::threads(),
        }
    }
}

/// The polygons of a frame that a method draws in one way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
pub struct PolygonKind {
    /// The name of the kind.
    pub name: &'static str,
    /// The polygons.
    pub polygons: usize,
}

/// The answer to a method, a frame and a renderer: see [`crate::shading::Variant::plan`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plan {
    /// The renderer that was asked for draws.
    AsAsked(Renderer),
    /// Another renderer draws.
    Instead {
        /// The renderer.
        renderer: Renderer,
        /// The reason, as a sentence without its full stop.
        reason: &'static str,
    },
    /// The method is not for such frames ([`crate::shading::Shader::on`]), with the reason: no renderer draws it.
    Refused(&'static str),
}

impl Plan {
    /// Returns the renderer that draws, if one does.
    pub fn renderer(self) -> Option<Renderer> {
        match self {
            Plan::AsAsked(renderer) | Plan::Instead { renderer, .. } => Some(renderer),
            Plan::Refused(_) => None,
        }
    }

    /// Returns the reason why it is not the renderer that was asked for, if it is not.
    pub fn reason(self) -> Option<&'static str> {
        match self {
            Plan::AsAsked(_) => None,
            Plan::Instead { reason, .. } | Plan::Refused(reason) => Some(reason),
        }
    }
}
