//! The question if a method draws a frame, and its answer.

use crate::frame::Frame;
use crate::scene::{Interpolation, Lighting};

/// What a method is asked to draw.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum On<'a> {
    /// A whole frame.
    Frame(&'a Frame),
    /// Spans of one material with its lights.
    Spans(&'a Lighting, Interpolation),
}

/// The answer of a method to [`On`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fit {
    /// The method draws it.
    Draws,
    /// The method does not draw it, with the reason: a sentence without its full stop. No renderer
    /// draws the frame with this method, and comparisons leave it out.
    Refuses(&'static str),
    /// The method would gain nothing on this frame, so another one draws it: the method of this
    /// name, which has no parameters and has the same closed form. Ignored for spans.
    LeavesTo(&'static str),
}

impl<'a> On<'a> {
    /// Asks about each material in turn: `why` returns the reason to refuse it, or `None`. Returns
    /// the first refusal.
    pub fn each(self, why: impl Fn(&'a Lighting, Interpolation) -> Option<&'static str>) -> Fit {
        let refused = match self {
            On::Frame(frame) => {
                let mut all = frame.lightings().iter();
                all.find_map(|lighting| why(lighting, frame.interpolation()))
            }
            On::Spans(lighting, interpolation) => why(lighting, interpolation),
        };
        refused.map_or(Fit::Draws, Fit::Refuses)
    }
}

impl Fit {
    /// Returns the reason for a refusal; `None` if the method draws.
    pub fn refused(self) -> Option<&'static str> {
        match self {
            Fit::Refuses(why) => Some(why),
            _ => None,
        }
    }
}
