//! Built-in meshes by name: `sphere`, `torus?segments=200&sides=80`, `teapot?polygons=100000`.

mod table;
#[cfg(test)]
mod tests;

pub use table::BUILTINS;

use super::{MeshError, PolygonMesh};
use crate::number::suggest::nearest;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;

/// A shape that is made by formula.
#[derive(Debug)]
pub struct Builtin {
    /// The name.
    pub name: &'static str,
    /// A description in one line.
    pub doc: &'static str,
    /// The parameters. Shapes with a [`Builtin::resolution`] also take [`POLYGONS`].
    pub parameters: &'static [ShapeParameter],
    /// The parameters that [`POLYGONS`] sets, if the shape takes it.
    pub resolution: Option<Resolution>,
    polygon_count: fn(&Values) -> u64,
    build: fn(&Values) -> Result<PolygonMesh, MeshError>,
}

/// The name of the parameter that asks for a number of polygons: the resolution nearest to it is chosen.
pub const POLYGONS: &str = "polygons";

/// A parameter of a shape.
#[derive(Clone, Copy, Debug)]
pub struct ShapeParameter {
    /// The name.
    pub name: &'static str,
    /// The kind of its value.
    pub kind: ParameterKind,
    /// The value when it is not set; 0 and 1 stand for false and true.
    pub default: f64,
    /// The least value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
    /// A description in a few words.
    pub doc: &'static str,
}

/// A kind of value that a parameter has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterKind {
    /// A whole number; underscores may stand between digits.
    Integer,
    /// A number.
    Real,
    /// `true` or `false`.
    Bool,
}

impl fmt::Display for ParameterKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ParameterKind::Integer => "a whole number",
            ParameterKind::Real => "a number",
            ParameterKind::Bool => "true or false",
        })
    }
}

/// The parameters that decide how many polygons a shape has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// The parameter for the rows, or for both directions.
    pub rows: &'static str,
    /// The parameter for the columns, to which the number of polygons is in proportion, and their number for each row.
    pub columns: Option<(&'static str, f64)>,
}

impl Resolution {
    fn parameters(&self) -> impl Iterator<Item = &'static str> + use<> {
        let columns = self.columns.map(|(columns, _)| columns);
        core::iter::once(self.rows).chain(columns)
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

    /// Returns the index of parameter `name`. Names come from the shape's own table entry, or were found in it before.
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
        let ShapeParameter { min, max, .. } = self.shape.parameters[index];
        self.numbers[index] = (value as f64).clamp(min, max);
    }

    fn polygon_count(&self) -> u64 {
        (self.shape.polygon_count)(self)
    }
}

/// A built-in mesh that cannot be made; `Display` says why in one sentence.
#[derive(Clone, Debug, PartialEq)]
pub struct BuiltinError(String);

impl fmt::Display for BuiltinError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for BuiltinError {}

/// Makes the built-in mesh for `NAME` or `NAME?key=value&key=value`, as [`BUILTINS`] lists them.
///
/// Everything is checked before memory is taken.
///
/// # Errors
/// [`BuiltinError`] when the shape or a parameter is not known, a value is not of its kind or out of its range, or the
/// mesh would be over the limits of [`PolygonMesh`].
pub fn builtin(spec: &str) -> Result<PolygonMesh, BuiltinError> {
    let values = within_limit(spec)?;
    (values.shape.build)(&values).map_err(|error| BuiltinError(error.to_string()))
}

/// Returns how many polygons the mesh has that [`builtin`] makes for `spec`.
///
/// # Errors
/// As [`builtin`].
#[doc(hidden)]
pub fn polygon_count(spec: &str) -> Result<u64, BuiltinError> {
    Ok(within_limit(spec)?.polygon_count())
}

/// Reads a shape and its parameters, whose mesh is within the limit.
fn within_limit(spec: &str) -> Result<Values, BuiltinError> {
    let values = parse(spec).map_err(BuiltinError)?;
    let (count, most) = (values.polygon_count(), PolygonMesh::MAX_POLYGONS);
    match count > most as u64 {
        false => Ok(values),
        true => Err(BuiltinError(format!(
            "the mesh would have {count} polygons, over the limit of {most}"
        ))),
    }
}

/// Reads a shape and its parameters, and checks all of them.
fn parse(spec: &str) -> Result<Values, String> {
    let (name, settings) = spec.split_once('?').unwrap_or((spec, ""));
    let shape = BUILTINS.iter().find(|shape| shape.name == name);
    let shape = shape.ok_or_else(|| {
        let names: Vec<_> = BUILTINS.iter().map(|shape| shape.name).collect();
        let (hint, names) = (did_you_mean(name, &names), names.join(", "));
        format!("no built-in mesh is named `{name}`{hint} (there are {names})")
    })?;
    let mut values = Values::new(shape);
    let mut set: Vec<&'static str> = Vec::new();
    let mut polygons = None;
    for setting in settings.split('&').filter(|s| !s.is_empty()) {
        let setting = setting.split_once('=').ok_or(setting);
        let (key, value) =
            setting.map_err(|found| format!("`{found}` should be written as key=value"))?;
        let parameter = find_parameter(shape, key)?;
        if set.contains(&parameter.name) {
            return Err(format!("`{key}` is set twice"));
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
            return Err(format!(
                "`{POLYGONS}` chooses `{key}` itself; give one or the other"
            ));
        }
        choose_resolution(&mut values, resolution, target);
    }
    if shape.name == "knot" {
        let factor = common_factor(values.integer("p"), values.integer("q"));
        if factor != 1 {
            return Err(format!(
                "`p` and `q` of a knot have no common factor, but these have {factor}"
            ));
        }
    }
    Ok(values)
}

/// Returns the question for the one of `names` that `name` may stand for, if there is one.
fn did_you_mean(name: &str, names: &[&'static str]) -> String {
    let meant = nearest(name, names.iter().copied());
    meant.map_or(String::new(), |meant| format!("; did you mean `{meant}`?"))
}

/// The parameter that asks for a number of polygons.
const POLYGONS_PARAMETER: ShapeParameter = ShapeParameter {
    name: POLYGONS,
    kind: ParameterKind::Integer,
    default: 0.0,
    min: 1.0,
    max: PolygonMesh::MAX_POLYGONS as f64,
    doc: "choose the resolution whose number of polygons is nearest to this",
};

impl Builtin {
    /// Returns all parameters that can be set, [`POLYGONS`] last if the shape takes it.
    pub fn all_parameters(&self) -> impl Iterator<Item = &'static ShapeParameter> {
        let polygons = self.resolution.map(|_| &POLYGONS_PARAMETER);
        self.parameters.iter().chain(polygons)
    }
}

fn find_parameter(shape: &'static Builtin, key: &str) -> Result<&'static ShapeParameter, String> {
    let found = shape.all_parameters().find(|p| p.name == key);
    found.ok_or_else(|| {
        let names: Vec<_> = shape.all_parameters().map(|p| p.name).collect();
        let hint = did_you_mean(key, &names);
        let names = match names.len() {
            0 => "none".to_string(),
            _ => names.join(", "),
        };
        let shape = shape.name;
        format!("`{shape}` has no parameter `{key}`{hint} (it has {names})")
    })
}

impl ShapeParameter {
    /// Reads a value of the parameter's kind and range.
    fn parse(&self, text: &str) -> Result<f64, String> {
        let number = match self.kind {
            // Through i128, so that a number with too many digits for its range is told so.
            ParameterKind::Integer => text.replace('_', "").parse::<i128>().ok().map(|n| n as f64),
            ParameterKind::Real => text.parse().ok().filter(|n: &f64| !n.is_nan()),
            ParameterKind::Bool => text.parse().ok().map(|b: bool| b as u8 as f64),
        };
        let ShapeParameter {
            name,
            kind,
            min,
            max,
            ..
        } = self;
        let number = number.ok_or_else(|| format!("`{name}` is {kind}, not `{text}`"))?;
        match (min..=max).contains(&&number) {
            true => Ok(number),
            false => Err(format!("`{name}` is {text}: expected {min} to {max}")),
        }
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
    let Resolution { rows, columns } = resolution;
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
    let reach = columns.map_or(1, |_| (low / 10).clamp(1, 1000));
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
