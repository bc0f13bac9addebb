//! Which loops draw a frame, and on which instruction set.

use crate::number::Level;
use crate::suggest::nearest;
use alloc::format;
use alloc::string::String;
use core::fmt;
use core::str::FromStr;

/// The loops that draw a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Active edges, a depth buffer of one line, and visible runs that are walked and shaded once: the lecture's way.
    Span,
    /// Bands of scanlines, whose interpolants are kept in planes until each row is shaded once.
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
                "active edges, a depth buffer of one line, visible runs walked and shaded once: the lecture's way"
            }
            Engine::Row => "bands of scanlines, interpolants kept in planes, each row shaded once",
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

/// How a frame is drawn: by which loops, on which instruction set. On how many threads, the current pool of `rayon` says
/// (feature `threads`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Renderer {
    /// The loops; `None` leaves the choice to [`crate::shader::Variant::plan`].
    pub engine: Option<Engine>,
    /// The instruction set of the pixel loops; one that this machine does not have runs as [`Level::Scalar`].
    pub level: Level,
}

impl Renderer {
    /// The lecture's own form: spans, one pixel at a time, on one thread. Its pictures are the same bits on every platform,
    /// and it is what every other is measured against.
    pub const LECTURE: Renderer = Renderer {
        engine: Some(Engine::Span),
        level: Level::Scalar,
    };

    /// The fastest that this machine has.
    pub fn fastest() -> Renderer {
        Renderer {
            engine: None,
            level: Level::best(),
        }
    }
}

/// How a frame is drawn indeed: see [`crate::shader::Variant::plan`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The loops.
    pub engine: Engine,
    /// The instruction set. [`Engine::Span`] on [`Level::Scalar`] is the lecture's own form, on one thread.
    pub level: Level,
    /// Why it is not what was asked for, if it is not.
    pub reason: Option<&'static str>,
}

impl Plan {
    /// Whether this is the lecture's own form, [`Renderer::LECTURE`].
    pub fn is_lectures_own(self) -> bool {
        (Some(self.engine), self.level) == (Renderer::LECTURE.engine, Renderer::LECTURE.level)
    }

    /// How many threads walk and shade its pixels: one in the lecture's own form, in any other those of the current pool of
    /// `rayon`, which is one without the feature `threads`. Vertices are lit on all of the pool in every form.
    pub fn threads(self) -> usize {
        if self.is_lectures_own() {
            1
        } else {
            crate::parallel::threads()
        }
    }
}
