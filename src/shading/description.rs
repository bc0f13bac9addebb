//! Descriptions of methods: the texts and error bounds that the command-line tool, the tests and
//! the report share.

use crate::frame::{Frame, Polygon};
use crate::number::NameError;
use crate::number::suggest::one_of;
use crate::reference::Model;
use crate::scene::Lighting;
use crate::shading::bounds::{Roundings, Stepped};
use alloc::format;
use alloc::string::{String, ToString};

/// A parameter of a method, which a user sets after the name, as in `fast-phong:steps=1`.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct MethodParameter {
    /// The name.
    pub name: &'static str,
    /// The meaning, in a few words.
    pub meaning: &'static str,
    /// The value if the user sets none.
    pub default: Value,
    /// The values that are allowed.
    pub range: Range,
    /// If set, the method can choose by itself: the user writes `auto`
    /// ([`MethodParameter::or_auto`]).
    pub auto: Option<Auto>,
}

/// The value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value {
    /// The method chooses.
    Auto,
    /// A whole number.
    Whole(u32),
    /// A number with decimals.
    Decimal(f64),
    /// A word: its index in [`Range::Words`].
    Word(usize),
}

impl Value {
    /// Returns the whole number; `None` if the method chooses.
    ///
    /// # Panics
    /// If the parameter is not one of whole numbers.
    pub fn whole(self) -> Option<u32> {
        match self {
            Value::Whole(number) => Some(number),
            Value::Auto => None,
            other => unreachable!("a parameter has values of its range, and not {other:?}"),
        }
    }

    /// Returns the number with decimals; `None` if the method chooses.
    ///
    /// # Panics
    /// If the parameter is not one of numbers with decimals.
    pub fn decimal(self) -> Option<f64> {
        match self {
            Value::Decimal(number) => Some(number),
            Value::Auto => None,
            other => unreachable!("a parameter has values of its range, and not {other:?}"),
        }
    }
}

/// The values that a parameter may have.
#[derive(Clone, Copy, Debug)]
pub enum Range {
    /// Whole numbers from the first to the second, both included.
    Whole(u32, u32),
    /// Numbers from the first to the second, both included.
    Decimal(f64, f64),
    /// One of these words.
    Words(&'static [&'static str]),
}

/// A choice that a method makes by itself for each span.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Auto {
    /// The values that the method chooses from, and when.
    pub meaning: &'static str,
    /// Returns the largest relative error of |N| that the choice allows on a material;
    /// [`super::Variant::bound`] includes it.
    pub length_error: fn(&Lighting) -> f32,
}

impl Auto {
    /// Makes a choice from its meaning and the error that it allows itself.
    pub const fn new(meaning: &'static str, length_error: fn(&Lighting) -> f32) -> Auto {
        Auto {
            meaning,
            length_error,
        }
    }
}

impl MethodParameter {
    /// Makes a parameter for the whole numbers from `least` to `most`.
    pub const fn whole(
        name: &'static str,
        meaning: &'static str,
        default: u32,
        [least, most]: [u32; 2],
    ) -> MethodParameter {
        MethodParameter {
            name,
            meaning,
            default: Value::Whole(default),
            range: Range::Whole(least, most),
            auto: None,
        }
    }

    /// Makes a parameter for the numbers from `least` to `most`.
    pub const fn decimal(
        name: &'static str,
        meaning: &'static str,
        default: f64,
        [least, most]: [f64; 2],
    ) -> MethodParameter {
        MethodParameter {
            name,
            meaning,
            default: Value::Decimal(default),
            range: Range::Decimal(least, most),
            auto: None,
        }
    }

    /// Makes a parameter for one of some words, the first of which is the default.
    pub const fn word(
        name: &'static str,
        meaning: &'static str,
        words: &'static [&'static str],
    ) -> MethodParameter {
        MethodParameter {
            name,
            meaning,
            default: Value::Word(0),
            range: Range::Words(words),
            auto: None,
        }
    }

    /// Lets the method choose the value where the user writes `auto`, which becomes the default.
    pub const fn or_auto(self, auto: Auto) -> MethodParameter {
        MethodParameter {
            default: Value::Auto,
            auto: Some(auto),
            ..self
        }
    }

    /// Reads a value as users write it.
    ///
    /// # Errors
    /// [`NameError`] if the value is not in the range; `auto` is accepted only where
    /// [`MethodParameter::auto`] is set.
    pub fn parse(&self, text: &str) -> Result<Value, NameError> {
        if text == "auto" && self.auto.is_some() {
            return Ok(Value::Auto);
        }
        let value = match self.range {
            Range::Whole(least, most) => (text.parse().ok())
                .filter(|value| (least..=most).contains(value))
                .map(Value::Whole),
            Range::Decimal(least, most) => (text.parse().ok())
                .filter(|value| (least..=most).contains(value))
                .map(Value::Decimal),
            Range::Words(words) => words.iter().position(|word| *word == text).map(Value::Word),
        };
        value.ok_or_else(|| {
            let auto = self.auto.map_or("", |_| "`auto` or ");
            let expected = match self.range {
                Range::Whole(least, most) => {
                    format!("expected {auto}a whole number from {least} to {most}")
                }
                Range::Decimal(least, most) => {
                    format!("expected {auto}a number from {least} to {most}")
                }
                Range::Words(words) => one_of(words.iter().copied()),
            };
            NameError::Value {
                parameter: self.name,
                value: text.into(),
                expected,
            }
        })
    }

    /// Writes a value as [`MethodParameter::parse`] reads it.
    pub fn text(&self, value: Value) -> String {
        match (value, self.range) {
            (Value::Auto, _) => "auto".into(),
            (Value::Whole(number), _) => number.to_string(),
            (Value::Decimal(number), _) => number.to_string(),
            (Value::Word(place), Range::Words(words)) => words[place].into(),
            (Value::Word(_), _) => unreachable!("a word of a parameter that has none"),
        }
    }

    /// Returns the allowed values for people to read: `auto or 1..8`.
    pub fn values(&self) -> String {
        let auto = self.auto.map_or("", |_| "auto or ");
        match self.range {
            Range::Whole(least, most) => format!("{auto}{least}..{most}"),
            Range::Decimal(least, most) => format!("{auto}{least}..{most}"),
            Range::Words(words) => format!("{auto}{}", words.join(" or ")),
        }
    }
}

/// The errors that a method makes by design on a polygon, beyond its roundings, against its closed
/// form. They add up. Begin from [`Approximation::NONE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approximation {
    /// The error of L·N and V·N of unit normals. The light model passes it on as it does roundings,
    /// and a highlight may end elsewhere.
    pub cosine: f64,
    /// The relative error of the length that normals are divided by. It changes cosines, but not
    /// their signs.
    pub length: f64,
    /// The error of a linear colour channel of 0..=1.
    pub colour: f64,
    /// True if a highlight may end elsewhere, because `colour` includes an error of L·N.
    pub moves_gate: bool,
}

impl Approximation {
    /// No error.
    pub const NONE: Approximation = Approximation {
        cosine: 0.0,
        length: 0.0,
        colour: 0.0,
        moves_gate: false,
    };
}

/// What perspective interpolation does to a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Perspective {
    /// Nothing, as the method interpolates nothing.
    Unaffected,
    /// The corners' attributes are multiplied by a weight that cancels at the pixel, so a pixel
    /// costs no more.
    Free,
    /// Each pixel takes one more division.
    Divides,
    /// The method stays linear on the screen.
    ScreenOnly,
}

impl Perspective {
    /// True if varyings are multiplied by the weight of perspective at the corners.
    pub(crate) const fn is_weighted(self) -> bool {
        matches!(self, Perspective::Free | Perspective::Divides)
    }

    /// Returns a clause for people to read.
    pub fn sentence(self) -> &'static str {
        match self {
            Perspective::Unaffected => "interpolates nothing, so perspective changes nothing",
            Perspective::Free => "perspective-correct at no cost per pixel: the weight cancels",
            Perspective::Divides => {
                "perspective-correct for one more division per pixel, and one more multiplication of each value"
            }
            Perspective::ScreenOnly => {
                "not perspective-correct: its increments are constant on the screen only"
            }
        }
    }
}

/// The points from which a method sees lights and an eye that are at positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Local {
    /// The mean of a polygon's corners: vectors to light and eye are constant along a polygon, as
    /// the lecture assumes (L21 1).
    PerPolygon,
    /// Each vertex.
    PerVertex,
    /// Each pixel.
    PerPixel,
}

impl Local {
    /// Returns a clause for people to read.
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

/// How often a method evaluates the light model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShadingRate {
    /// Once per polygon, with its own normal.
    Polygon,
    /// Once per polygon, with the mean of its vertex normals.
    PolygonMean,
    /// Once per vertex.
    Vertex,
    /// Once per pixel.
    Pixel,
}

/// A family of methods, by what they make cheap; `--methods` accepts its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Family {
    /// Colours, constant or interpolated, and no normal at a pixel.
    Colours,
    /// Normals or products of normals, with a root or a quotient at each pixel.
    Roots,
    /// Polynomials in place of the root.
    Series,
    /// Quadratics over a polygon or a span in place of unit vectors.
    Quadratics,
    /// Interpolation of angles, or of the coordinates of another chart of the sphere.
    Angles,
    /// Another formula for highlights.
    Highlights,
    /// A choice among several methods for each polygon.
    Hybrids,
}

impl Family {
    /// All families.
    pub const ALL: [Family; 7] = [
        Family::Colours,
        Family::Roots,
        Family::Series,
        Family::Quadratics,
        Family::Angles,
        Family::Highlights,
        Family::Hybrids,
    ];

    /// Returns the name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Family::Colours => "colours",
            Family::Roots => "roots",
            Family::Series => "series",
            Family::Quadratics => "quadratics",
            Family::Angles => "angles",
            Family::Highlights => "highlights",
            Family::Hybrids => "hybrids",
        }
    }
}

/// Where comparisons and lists show a method that the user did not name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tier {
    /// Everywhere, because the method is in the lecture, or because it is the fastest with its
    /// picture on some machine or scene.
    Default,
    /// Only where the user names the method or its family.
    Asked,
    /// Like `Asked`. The method shows what goes wrong and is not for use.
    Exhibit,
}

impl Tier {
    /// Returns the tier in words.
    pub fn name(self) -> &'static str {
        match self {
            Tier::Default => "default",
            Tier::Asked => "where asked for",
            Tier::Exhibit => "an exhibit",
        }
    }
}

/// The description of a method. Begin from [`Info::OF_PIXELS`] (`..Info::OF_PIXELS`), because later
/// versions may add fields.
#[derive(Clone, Copy, Debug)]
pub struct Info {
    /// The name on the command line.
    pub name: &'static str,
    /// Its entries in the catalogue of published methods (`docs/methods.md`), M01 to M30; empty if
    /// it corresponds to none.
    pub ids: &'static [&'static str],
    /// Its family.
    pub family: Family,
    /// Where it is shown without being named.
    pub tier: Tier,
    /// The method in one sentence.
    pub title: &'static str,
    /// The formulas, as lines of text.
    pub formula: &'static str,
    /// The source of the formulas.
    pub source: &'static str,
    /// The operations that the source states, in its own words; empty if it states none.
    pub claimed: &'static str,
    /// The closed form that its picture is measured against.
    pub model: Model,
    /// The roundings that its values gather; [`super::Variant::bound`] derives the largest
    /// difference from the closed form.
    pub roundings: Roundings,
    /// The derivation of `roundings`, as a sentence.
    pub derivation: &'static str,
    /// Returns the error that the method makes by design on a polygon of a frame, with these
    /// parameter values; 0 for most methods.
    pub approximation: fn(&Frame, &Polygon, &[Value]) -> Approximation,
    /// The cases in which its picture is bad or its arithmetic fails.
    pub fails: &'static str,
    /// True if the user can choose the power function of highlights; false if the method's own
    /// tables hold powers.
    pub has_power: bool,
    /// The parameters that may follow the name.
    pub parameters: &'static [MethodParameter],
}

impl Info {
    /// A method that interpolates normals and is lit at each pixel, with all texts empty and no
    /// error bound. Begin from it.
    pub const OF_PIXELS: Info = Info {
        name: "",
        ids: &[],
        family: Family::Roots,
        tier: Tier::Asked,
        title: "",
        formula: "",
        source: "",
        claimed: "",
        model: Model::Phong,
        roundings: Roundings::new(f64::INFINITY, 0.0, Stepped::Cosines),
        derivation: "no bound was derived",
        approximation: |_, _, _| Approximation::NONE,
        has_power: true,
        fails: "",
        parameters: &[],
    };

    /// Describes one of the kinds of polygons of a method: only its name is used.
    pub const fn of_kind(name: &'static str) -> Info {
        Info {
            name,
            ..Info::OF_PIXELS
        }
    }
}
