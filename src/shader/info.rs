//! What is said about a method: the texts and bounds that the tool, the tests and the report share.

use super::bound::Roundings;
use crate::reference::Model;

/// A number that a method can be given after its name, as in `fast-phong:steps=1`.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// Its value when none is given.
    pub default: u32,
    /// The smallest value allowed.
    pub least: u32,
    /// The largest value allowed.
    pub most: u32,
}

/// What a method does when the scene asks for perspective interpolation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Perspective {
    /// Nothing is interpolated.
    Unaffected,
    /// Attributes are weighted at the corners; the unknown factor cancels, so a pixel costs no more.
    Free,
    /// One division a pixel more.
    Divides,
    /// Stays linear on the screen.
    ScreenOnly,
}

impl Perspective {
    /// One sentence for people.
    pub fn sentence(self) -> &'static str {
        match self {
            Perspective::Unaffected => "interpolates nothing, so perspective changes nothing",
            Perspective::Free => "perspective-correct at no cost a pixel: the weight cancels",
            Perspective::Divides => {
                "perspective-correct for one division and three multiplications a pixel more"
            }
            Perspective::ScreenOnly => {
                "stays linear on the screen: its increments are constant only there"
            }
        }
    }
}

/// What a method does where a light or the eye is at a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Local {
    /// The vectors to them are constant along a polygon, as the lecture assumes (L21 1): those of its mean corner.
    PerPolygon,
    /// Each vertex has its own.
    PerVertex,
    /// Each pixel has its own.
    PerPixel,
}

impl Local {
    /// One sentence for people.
    pub fn sentence(self) -> &'static str {
        match self {
            Local::PerPolygon => {
                "lights and eye at positions are seen from the mean of each polygon's corners"
            }
            Local::PerVertex => "lights and eye at positions are seen from each vertex",
            Local::PerPixel => "lights and eye at positions are seen from each pixel",
        }
    }
}

/// What is said about a method.
#[derive(Clone, Copy, Debug)]
pub struct Info {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it is, in one sentence.
    pub title: &'static str,
    /// Its formulas, as lines of text.
    pub formula: &'static str,
    /// Where they are from.
    pub source: &'static str,
    /// The closed form that its picture is measured against.
    pub model: Model,
    /// How many roundings its numbers gather: [`Info::bound`] makes the largest difference to that closed form of it.
    pub roundings: Roundings,
    /// Why so many roundings and no more.
    pub derivation: &'static str,
    /// Where its picture is bad, or its arithmetic fails.
    pub fails: &'static str,
    /// What it can be given.
    pub parameters: &'static [Parameter],
    /// What perspective interpolation does to it.
    pub perspective: Perspective,
    /// What it does where a light or the eye is at a position.
    pub local: Local,
    /// Whether the barycentric renderer has it.
    pub barycentric: bool,
}
