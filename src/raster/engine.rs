//! Which engine draws a frame: the span engine is scalar, the row engine SIMD.

use crate::number::Level;
use crate::number::suggest::nearest;
use alloc::format;
use alloc::string::String;
use core::fmt;
use core::str::FromStr;

/// The loops that draw a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// One pixel at a time: active edges, a depth buffer of one line, and visible runs that are walked and shaded once, the
    /// lecture's way.
    Span,
    /// Sixteen pixels at a time: a deferred renderer, whose varyings are kept in a G-buffer until each row is shaded once.
    Row,
}

impl Engine {
    /// All there are.
    pub const ALL: [Engine; 2] = [Engine::Span, Engine::Row];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Span => "span",
            Engine::Row => "row",
        }
    }

    /// What it is, in one sentence.
    pub fn title(self) -> &'static str {
        match self {
            Engine::Span => {
                "one pixel at a time: active edges, a depth buffer of one line, visible runs shaded once: the lecture's way"
            }
            Engine::Row => {
                "SIMD: a deferred renderer, varyings kept in a G-buffer, each row shaded once"
            }
        }
    }
}

impl fmt::Display for Engine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Engine {
    type Err = String;

    fn from_str(name: &str) -> Result<Engine, String> {
        let named = |engine: &Engine| engine.name() == name;
        Engine::ALL.into_iter().find(named).ok_or_else(|| {
            match nearest(name, Engine::ALL.map(Engine::name)) {
                Some(near) => format!("unknown engine `{name}`: did you mean `{near}`?"),
                None => format!("unknown engine `{name}`: expected `span` or `row`"),
            }
        })
    }
}

/// What draws a frame, and on what. On how many threads, the current pool of `rayon` says (feature `threads`).
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
    /// and it is what every other is measured against.
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
    /// pool of `rayon`, which is one without the feature `threads`. Vertices are lit on all of the pool by both.
    pub fn threads(self) -> usize {
        match self {
            Renderer::Span => 1,
            Renderer::Row(_) => crate::number::parallel::threads(),
        }
    }
}

/// What draws a frame indeed: see [`crate::shading::Variant::plan`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// What draws it.
    pub renderer: Renderer,
    /// Why it is not what was asked for, if it is not.
    pub reason: Option<&'static str>,
}
