//! Descriptions of methods: the texts and bounds that the tool, the tests and the report share.

use super::bound::{Roundings, Stepped};
use crate::number::NameError;
use crate::reference::Model;
use crate::scene::Lighting;
use alloc::format;
use alloc::string::{String, ToString};

/// A number that a method can be given after its name, as in `fast-phong:steps=1`.
#[derive(Clone, Copy, Debug)]
pub struct MethodParameter {
    /// The name.
    pub name: &'static str,
    /// The meaning, in a few words.
    pub meaning: &'static str,
    /// The value when none is given.
    pub default: u32,
    /// The smallest value allowed.
    pub least: u32,
    /// The largest value allowed.
    pub most: u32,
    /// The choice left to the method, if it can be: written `auto`, the value [`MethodParameter::AUTO`].
    pub auto: Option<Auto>,
}

/// A choice that a method makes by itself, from span to span.
#[derive(Clone, Copy, Debug)]
pub struct Auto {
    /// The values that it takes, and when.
    pub meaning: &'static str,
    /// The largest relative error of |N| that it leaves on a material: [`super::Variant::bound`] has room for it.
    pub length_error: fn(&Lighting) -> f32,
}

impl MethodParameter {
    /// The value that stands for `auto`.
    pub const AUTO: u32 = 0;

    /// Makes a parameter of `least` to `most`, without `auto`.
    pub const fn new(
        name: &'static str,
        meaning: &'static str,
        default: u32,
        least: u32,
        most: u32,
    ) -> MethodParameter {
        MethodParameter {
            name,
            meaning,
            default,
            least,
            most,
            auto: None,
        }
    }

    /// Reads a value.
    ///
    /// # Errors
    /// [`NameError`] when it is neither in the range nor `auto` where that is allowed.
    pub fn parse(&self, text: &str) -> Result<u32, NameError> {
        let (name, least, most) = (self.name, self.least, self.most);
        match text.parse() {
            _ if text == "auto" && self.auto.is_some() => Ok(MethodParameter::AUTO),
            Ok(value) if (least..=most).contains(&value) => Ok(value),
            _ => {
                let auto = self.auto.map_or("", |_| "`auto` or ");
                let expected = format!("{auto}a whole number from {least} to {most}");
                Err(NameError(format!("`{name}={text}`: expected {expected}")))
            }
        }
    }

    /// Writes a value as [`MethodParameter::parse`] reads it.
    pub fn text(&self, value: u32) -> String {
        match self.is_auto(value) {
            true => "auto".into(),
            false => value.to_string(),
        }
    }

    /// Returns the values allowed, as people read them: `auto or 1..8`.
    pub fn range(&self) -> String {
        let auto = self.auto.map_or("", |_| "auto or ");
        format!("{auto}{}..{}", self.least, self.most)
    }

    /// True if the choice is left to the method.
    pub fn is_auto(&self, value: u32) -> bool {
        self.auto.is_some() && value == MethodParameter::AUTO
    }
}

/// The answer of a method to perspective interpolation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Perspective {
    /// Nothing is interpolated.
    Unaffected,
    /// Attributes are weighted at the corners; the unknown factor cancels, so a pixel costs no more.
    Free,
    /// One division per pixel more.
    Divides,
    /// Stays linear on the screen.
    ScreenOnly,
}

impl Perspective {
    /// Returns a sentence for people.
    pub fn sentence(self) -> &'static str {
        match self {
            Perspective::Unaffected => "interpolates nothing, so perspective changes nothing",
            Perspective::Free => "perspective-correct at no cost per pixel: the weight cancels",
            Perspective::Divides => {
                "perspective-correct for one more division and three more multiplications per pixel"
            }
            Perspective::ScreenOnly => {
                "not perspective-correct: its increments are constant on the screen only"
            }
        }
    }
}

/// The points from which a method sees lights and eye that are at positions.
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
    /// Returns a sentence for people.
    pub fn sentence(self) -> &'static str {
        match self {
            Local::PerPolygon => {
                "directions to positional lights and eye are taken at the mean of each polygon's corners"
            }
            Local::PerVertex => "directions to positional lights and eye are taken at each vertex",
            Local::PerPixel => "directions to positional lights and eye are taken at each pixel",
        }
    }
}

/// The rate at which a method evaluates the light model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LitAt {
    /// Once a polygon, from its own normal.
    Polygon,
    /// Once a polygon, from the mean of its vertex normals.
    PolygonMean,
    /// Once a vertex.
    Vertex,
    /// Once a pixel.
    Pixel,
}

/// The description of a method.
#[derive(Clone, Copy, Debug)]
pub struct Info {
    /// The name on the command line.
    pub name: &'static str,
    /// The method in one sentence.
    pub title: &'static str,
    /// The formulas, as lines of text.
    pub formula: &'static str,
    /// The source of the formulas.
    pub source: &'static str,
    /// The closed form that its picture is measured against.
    pub model: Model,
    /// The roundings that its numbers gather. [`super::Variant::bound`] derives the largest difference to the closed form from them.
    pub roundings: Roundings,
    /// The reason for so many roundings and no more.
    pub derivation: &'static str,
    /// The cases in which its picture is bad, or its arithmetic fails.
    pub fails: &'static str,
    /// The parameters after the name.
    pub parameters: &'static [MethodParameter],
    /// The answer to perspective interpolation.
    pub perspective: Perspective,
    /// The points from which it sees lights and eye at positions.
    pub local: Local,
    /// The rate at which it evaluates the light model.
    pub lit_at: LitAt,
}

impl Info {
    /// A method that interpolates normals and lights pixels, with nothing said about it: to begin from.
    pub const OF_PIXELS: Info = Info {
        name: "",
        title: "",
        formula: "",
        source: "",
        model: Model::Phong,
        roundings: Roundings::new(f64::INFINITY, 0.0, Stepped::Cosines),
        derivation: "no bound was derived",
        fails: "",
        parameters: &[],
        perspective: Perspective::Free,
        local: Local::PerPixel,
        lit_at: LitAt::Pixel,
    };

    /// True if one of these parameters leaves a choice to the method.
    #[inline(always)]
    pub fn is_auto(&self, parameters: &[u32]) -> bool {
        let mut all = self.parameters.iter().zip(parameters);
        all.any(|(parameter, value)| parameter.is_auto(*value))
    }
}
