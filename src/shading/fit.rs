//! What a method is asked to draw, and whether it does.

use crate::frame::Frame;
use crate::scene::{Interpolation, Lighting};

/// What a method is asked to draw.
#[derive(Clone, Copy, Debug)]
pub enum On<'a> {
    /// A frame.
    Frame(&'a Frame),
    /// Spans of a material with its lights.
    Spans(&'a Lighting, Interpolation),
}

/// The answer to [`On`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// The method draws it.
    Draws,
    /// It does not, for a reason: a sentence without its full stop. No renderer draws the frame with it, and comparisons leave it out.
    Refuses(&'static str),
    /// It gains nothing on this frame, so the method of this name draws it, which has no parameters and the same closed form. Spans
    /// ignore this.
    LeavesTo(&'static str),
}

impl<'a> On<'a> {
    /// Asks about one material after the other; `why` returns the reason why one is refused.
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
    /// Returns the reason why it is refused, if it is.
    pub fn refused(self) -> Option<&'static str> {
        match self {
            Fit::Refuses(why) => Some(why),
            _ => None,
        }
    }
}
