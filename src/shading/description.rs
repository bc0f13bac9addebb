//! Descriptions of methods: the texts and bounds that the tool, the tests and the report share.

use crate::frame::{Frame, Polygon};
use crate::number::NameError;
use crate::number::suggest::one_of;
use crate::reference::Model;
use crate::scene::Lighting;
use crate::shading::bounds::{Roundings, Stepped};
use alloc::format;
use alloc::string::{String, ToString};

/// A parameter that a method can be given after its name, as in `fast-phong:steps=1`.
#[derive(Clone, Copy, Debug)]
pub struct MethodParameter {
    /// The name.
    pub name: &'static str,
    /// The meaning, in a few words.
    pub meaning: &'static str,
    /// The value when none is given.
    pub default: Value,
    /// The values allowed.
    pub range: Range,
    /// The choice left to the method, if it can be: written `auto`.
    pub auto: Option<Auto>,
}

/// The value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// The choice is left to the method.
    Auto,
    /// A whole number.
    Whole(u32),
    /// A number with decimals.
    Decimal(f64),
    /// A word, by its place in [`Range::Words`].
    Word(usize),
}

impl Value {
    /// Returns the whole number that it is; `None` if the choice is left to the method.
    pub fn whole(self) -> Option<u32> {
        match self {
            Value::Whole(number) => Some(number),
            Value::Auto => None,
            other => unreachable!("a parameter has values of its range, and not {other:?}"),
        }
    }

    /// Returns the number that it is; `None` if the choice is left to the method.
    pub fn number(self) -> Option<f64> {
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
    /// Whole numbers from the first to the second.
    Whole(u32, u32),
    /// Numbers from the first to the second.
    Decimal(f64, f64),
    /// Words.
    Words(&'static [&'static str]),
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
    /// Makes a parameter of the whole numbers from `least` to `most`.
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

    /// Makes a parameter of the numbers from `least` to `most`.
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

    /// Makes a parameter of some words, the first of which is the default.
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

    /// Reads a value.
    ///
    /// # Errors
    /// [`NameError`] when it is neither in the range nor `auto` where that is allowed.
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
            NameError(format!("`{}={text}`: {expected}", self.name))
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

    /// Returns the values allowed, as people read them: `auto or 1..8`.
    pub fn values(&self) -> String {
        let auto = self.auto.map_or("", |_| "auto or ");
        match self.range {
            Range::Whole(least, most) => format!("{auto}{least}..{most}"),
            Range::Decimal(least, most) => format!("{auto}{least}..{most}"),
            Range::Words(words) => format!("{auto}{}", words.join(" or ")),
        }
    }
}

/// The errors that a method makes by design, on a polygon: beside its roundings, and against its closed form. They add up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approximation {
    /// Of L·N and V·N of unit normals. The light model passes it on as it does roundings, and a highlight may end elsewhere.
    pub cosine: f64,
    /// Of the length that normals are divided by, relative to it: as of cosines, but these keep their signs.
    pub length: f64,
    /// Of a linear colour channel of 0..=1.
    pub colour: f64,
    /// True if a highlight may end elsewhere, as the colours' errors are those of L·N among others.
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
    /// True if varyings are multiplied by the weight of perspective at the corners.
    pub(crate) const fn is_weighted(self) -> bool {
        matches!(self, Perspective::Free | Perspective::Divides)
    }

    /// Returns a sentence for people.
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

/// What a method makes cheap: the families that `--methods` takes by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Colours, constant or interpolated: no normal at a pixel.
    Colours,
    /// Normals or products of normals, and a root or a quotient at each pixel.
    Roots,
    /// Polynomials in place of the root.
    Series,
    /// Quadratics over a polygon or a span in place of unit vectors.
    Quadratics,
    /// Interpolation of angles, or by another chart of the sphere.
    Angles,
    /// Another formula for highlights.
    Highlights,
    /// For each polygon another of these.
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

    /// Returns its name on the command line.
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

/// Where a method is shown without being asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// In comparisons: it is of the lecture, or none of this picture is faster somewhere.
    Default,
    /// Where it is named, or its family is.
    Asked,
    /// As `Asked`: it shows what goes wrong, and is not for use.
    Exhibit,
}

impl Standing {
    /// Returns it in words.
    pub fn name(self) -> &'static str {
        match self {
            Standing::Default => "default",
            Standing::Asked => "where asked for",
            Standing::Exhibit => "an exhibit",
        }
    }
}

/// The description of a method.
#[derive(Clone, Copy, Debug)]
pub struct Info {
    /// The name on the command line.
    pub name: &'static str,
    /// Its numbers in the catalogue of published methods (`docs/methods.md`), M01 to M30; none if it stands for no other.
    pub ids: &'static [&'static str],
    /// The family.
    pub family: Family,
    /// Where it is shown.
    pub standing: Standing,
    /// The method in one sentence.
    pub title: &'static str,
    /// The formulas, as lines of text.
    pub formula: &'static str,
    /// The source of the formulas.
    pub source: &'static str,
    /// The operations that the source states, in its own words; empty where it states none.
    pub claimed: &'static str,
    /// The closed form that its picture is measured against.
    pub model: Model,
    /// The roundings that its values gather. [`super::Variant::bound`] derives the largest difference to the closed form from them.
    pub roundings: Roundings,
    /// The reason for so many roundings and no more.
    pub derivation: &'static str,
    /// The error that it makes by design on a polygon of a frame, with values for its parameters; 0 for most.
    pub approximation: fn(&Frame, &Polygon, &[Value]) -> Approximation,
    /// The cases in which its picture is bad, or its arithmetic fails.
    pub fails: &'static str,
    /// True if the power function of its highlights can be chosen; false if its own tables hold powers.
    pub has_power: bool,
    /// The parameters after the name.
    pub parameters: &'static [MethodParameter],
}

impl Info {
    /// A method that interpolates normals and lights pixels, with nothing said about it: to begin from.
    pub const OF_PIXELS: Info = Info {
        name: "",
        ids: &[],
        family: Family::Roots,
        standing: Standing::Asked,
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

    /// Names one of the kinds of polygons of a method: nothing else is asked of a kind.
    pub const fn of_kind(name: &'static str) -> Info {
        Info {
            name,
            ..Info::OF_PIXELS
        }
    }
}
