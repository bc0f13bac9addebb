//! Built-in meshes by name: `sphere`, `torus?segments=200&sides=80`, `teapot?polygons=100000`.

mod error;
mod table;
#[cfg(test)]
mod tests;

pub use error::BuiltinError;
pub use table::BUILTINS;

use super::{MeshError, PolygonMesh};
use crate::number::suggest::nearest;
use alloc::string::ToString;
use alloc::vec::Vec;
use core::fmt;

/// A shape that is made by formula.
#[derive(Debug)]
pub struct Builtin {
    /// Its name.
    pub name: &'static str,
    /// What it is, in one line.
    pub doc: &'static str,
    /// What can be set. Shapes with a [`Builtin::resolution`] also take [`POLYGONS`].
    pub parameters: &'static [Parameter],
    /// Which parameters [`POLYGONS`] sets, if the shape takes it.
    pub resolution: Option<Resolution>,
    polygon_count: fn(&Values) -> u64,
    build: fn(&Values) -> Result<PolygonMesh, MeshError>,
}

/// The name of the parameter that asks for a number of polygons: the resolution nearest to it is chosen.
pub const POLYGONS: &str = "polygons";

/// Something that can be set about a shape.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// What kind of value it has.
    pub kind: Kind,
    /// Its value when it is not set; 0 and 1 stand for false and true.
    pub default: f64,
    /// The least value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
    /// What it is, in a few words.
    pub doc: &'static str,
}

/// What kind of value a parameter has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A whole number; underscores may stand between digits.
    Integer,
    /// A number.
    Real,
    /// `true` or `false`.
    Bool,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Kind::Integer => "a whole number",
            Kind::Real => "a number",
            Kind::Bool => "true or false",
        })
    }
}

/// The parameters that decide how many polygons a shape has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution {
    /// One, for both directions.
    Single(&'static str),
    /// One for each direction; the number of polygons is in proportion to the columns.
    Grid {
        /// The parameter for the rows.
        rows: &'static str,
        /// The parameter for the columns.
        columns: &'static str,
        /// How many columns there should be for each row.
        ratio: f64,
    },
}

impl Resolution {
    fn parameters(&self) -> impl Iterator<Item = &'static str> + use<> {
        let (first, second) = match *self {
            Resolution::Single(name) => (name, None),
            Resolution::Grid { rows, columns, .. } => (rows, Some(columns)),
        };
        core::iter::once(first).chain(second)
    }
}

/// The values of all parameters of a shape.
#[derive(Clone, Debug)]
struct Values {
    shape: &'static Builtin,
    numbers: Vec<f64>,
}

impl Values {
    fn new(shape: &'static Builtin) -> Self {
        Values {
            shape,
            numbers: shape.parameters.iter().map(|p| p.default).collect(),
        }
    }

    /// Where parameter `name` stands. Names come from the shape's own table entry, or were found in it before.
    fn index(&self, name: &str) -> usize {
        let index = self.shape.parameters.iter().position(|p| p.name == name);
        index.expect("a shape reads its own parameters")
    }

    fn real(&self, name: &str) -> f64 {
        self.numbers[self.index(name)]
    }

    fn integer(&self, name: &str) -> usize {
        self.real(name) as usize
    }

    fn switch(&self, name: &str) -> bool {
        self.real(name) != 0.0
    }

    /// Sets a whole number, kept within its range.
    fn set_within(&mut self, name: &str, value: u64) {
        let index = self.index(name);
        let Parameter { min, max, .. } = self.shape.parameters[index];
        self.numbers[index] = (value as f64).clamp(min, max);
    }

    fn polygon_count(&self) -> u64 {
        (self.shape.polygon_count)(self)
    }
}

/// The built-in mesh for `NAME` or `NAME?key=value&key=value`, as [`BUILTINS`] lists them.
///
/// Everything is checked before memory is taken.
///
/// # Errors
/// [`BuiltinError`] when the shape or a parameter is not known, a value is not of its kind or out of its range, or the
/// mesh would be over the limits of [`PolygonMesh`].
pub fn builtin(spec: &str) -> Result<PolygonMesh, BuiltinError> {
    let values = parse(spec)?;
    let count = values.polygon_count();
    if count > PolygonMesh::MAX_POLYGONS as u64 {
        return Err(BuiltinError::TooManyPolygons { count });
    }
    (values.shape.build)(&values).map_err(BuiltinError::Mesh)
}

fn parse(spec: &str) -> Result<Values, BuiltinError> {
    let (name, settings) = spec.split_once('?').unwrap_or((spec, ""));
    let Some(shape) = BUILTINS.iter().find(|b| b.name == name) else {
        let suggestion = nearest(name, BUILTINS.iter().map(|b| b.name));
        return Err(BuiltinError::UnknownShape {
            name: name.to_string(),
            suggestion,
        });
    };
    let mut values = Values::new(shape);
    let mut set: Vec<&'static str> = Vec::new();
    let mut polygons = None;
    for setting in settings.split('&').filter(|s| !s.is_empty()) {
        let Some((key, value)) = setting.split_once('=') else {
            return Err(BuiltinError::NoValue {
                found: setting.to_string(),
            });
        };
        let parameter = find_parameter(shape, key)?;
        if set.contains(&parameter.name) {
            return Err(BuiltinError::Repeated {
                key: parameter.name,
            });
        }
        set.push(parameter.name);
        let number = parameter.parse(value)?;
        if parameter.name == POLYGONS {
            polygons = Some(number as u64);
        } else {
            let index = values.index(parameter.name);
            values.numbers[index] = number;
        }
    }
    if let (Some(target), Some(resolution)) = (polygons, shape.resolution) {
        if let Some(key) = resolution.parameters().find(|key| set.contains(key)) {
            return Err(BuiltinError::Conflict { key });
        }
        choose_resolution(&mut values, resolution, target);
    }
    if shape.name == "knot" {
        let factor = common_factor(values.integer("p"), values.integer("q"));
        if factor != 1 {
            return Err(BuiltinError::NoKnot { factor });
        }
    }
    Ok(values)
}

/// The parameter that asks for a number of polygons.
const POLYGONS_PARAMETER: Parameter = Parameter {
    name: POLYGONS,
    kind: Kind::Integer,
    default: 0.0,
    min: 1.0,
    max: PolygonMesh::MAX_POLYGONS as f64,
    doc: "choose the resolution whose number of polygons is nearest to this",
};

impl Builtin {
    /// All parameters that can be set, [`POLYGONS`] last if the shape takes it.
    pub fn all_parameters(&self) -> impl Iterator<Item = &'static Parameter> {
        let polygons = self.resolution.map(|_| &POLYGONS_PARAMETER);
        self.parameters.iter().chain(polygons)
    }
}

fn find_parameter(shape: &'static Builtin, key: &str) -> Result<&'static Parameter, BuiltinError> {
    shape
        .all_parameters()
        .find(|p| p.name == key)
        .ok_or_else(|| {
            let valid: Vec<_> = shape.all_parameters().map(|p| p.name).collect();
            let suggestion = nearest(key, valid.iter().copied());
            BuiltinError::UnknownKey {
                shape: shape.name,
                key: key.to_string(),
                valid,
                suggestion,
            }
        })
}

impl Parameter {
    fn parse(&self, text: &str) -> Result<f64, BuiltinError> {
        let number = match self.kind {
            // Through i128, so that a number with too many digits for its range is told so.
            Kind::Integer => text.replace('_', "").parse::<i128>().ok().map(|n| n as f64),
            Kind::Real => text.parse().ok().filter(|n: &f64| !n.is_nan()),
            Kind::Bool => text.parse().ok().map(|b: bool| b as u8 as f64),
        };
        let value = || text.to_string();
        let number = number.ok_or_else(|| BuiltinError::NotA {
            kind: self.kind,
            key: self.name,
            value: value(),
        })?;
        if number < self.min || number > self.max {
            return Err(BuiltinError::OutOfRange {
                key: self.name,
                value: value(),
                min: self.min,
                max: self.max,
            });
        }
        Ok(number)
    }
}

fn common_factor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { common_factor(b, a % b) }
}

/// Sets the resolution so that the number of polygons is nearest to `target`.
///
/// With rows and columns, rows up to a tenth away from the shape's own ratio are tried, each with the number of columns
/// that fits it best.
fn choose_resolution(values: &mut Values, resolution: Resolution, target: u64) {
    let (rows, columns) = match resolution {
        Resolution::Single(rows) => (rows, None),
        Resolution::Grid {
            rows,
            columns,
            ratio,
        } => (rows, Some((columns, ratio))),
    };
    let range = values.shape.parameters[values.index(rows)];
    let at = |n: u64| {
        let mut values = values.clone();
        values.set_within(rows, n);
        if let Some((columns, ratio)) = columns {
            values.set_within(columns, libm::round(ratio * n as f64) as u64);
        }
        values
    };
    // The first number of rows, in the shape's own ratio, that gives as many polygons as asked for.
    let (mut low, mut high) = (range.min as u64, range.max as u64);
    while low < high {
        let middle = (low + high) / 2;
        if at(middle).polygon_count() < target {
            low = middle + 1
        } else {
            high = middle
        }
    }
    let reach = if columns.is_some() {
        (low / 10).clamp(1, 1000)
    } else {
        1
    };
    let candidates = (low.saturating_sub(reach)..=low + reach).map(|n| {
        let mut candidate = at(n);
        if let Some((columns, _)) = columns {
            let each = candidate.polygon_count() as f64 / candidate.real(columns);
            candidate.set_within(columns, libm::round(target as f64 / each) as u64);
        }
        (
            candidate.polygon_count().abs_diff(target),
            n.abs_diff(low),
            candidate,
        )
    });
    let fits = candidates.filter(|(_, _, c)| c.polygon_count() <= PolygonMesh::MAX_POLYGONS as u64);
    if let Some((_, _, best)) = fits.min_by_key(|&(miss, away, _)| (miss, away)) {
        *values = best;
    }
}
