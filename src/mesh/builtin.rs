//! Built-in shapes by name: `sphere`, `torus?segments=200&sides=80`, `teapot?polygons=100000`.
//!
//! [`builtin`] makes the mesh that a line of text describes: the name of a shape, then `?` and
//! parameters as `key=value`, joined by `&`. All parameters have defaults. The polygon count of
//! most shapes can be chosen through their own parameters, or through `polygons`, which picks the
//! resolution nearest to a count.
//!
//! ```
//! use fastphong::mesh::builtin::builtin;
//!
//! let torus = builtin("torus?minor=0.25&polygons=20_000")?;
//! assert!(torus.polygon_count().abs_diff(20_000) < 100);
//! # Ok::<(), fastphong::mesh::builtin::BuiltinError>(())
//! ```
//!
//! | shape | parameters |
//! |---|---|
//! | `sphere` | `segments`, `rings` |
//! | `bumpy`: a sphere with smooth bumps | `amplitude`, `frequency`, `segments`, `rings` |
//! | `superellipsoid`: from a rounded box to a double pyramid | `e1`, `e2`, `segments`, `rings` |
//! | `torus` | `major`, `minor`, `segments`, `sides` |
//! | `knot`: a tube along a torus knot | `p`, `q`, `radius`, `segments`, `sides` |
//! | `teapot`: the Utah teapot | `res`, `bottom` |
//! | `corrugated`: a wavy sheet | `waves`, `amplitude`, `segments`, `rows` |
//! | `terrain`: hills | `amplitude`, `frequency`, `octaves`, `seed`, `segments`, `rows`, `colours` |
//! | `cube` | `res` |
//! | `prism`: a star-shaped solid | `points`, `inner`, `depth` |
//! | `gear` | `teeth`, `inner`, `depth` |
//! | `triangle` | |
//! | `polygon`: a regular one | `sides` |
//! | `star`: a concave polygon | `points`, `inner` |
//! | `comb`: a concave polygon that a scan line crosses many times | `teeth` |
//! | `letters`: the word SHINE | |
//! | `figure5`: the lecture's square | `angle` |
//!
//! Shapes with a resolution also accept `triangles=true`, which splits quads, and `polygons`.
//! `fastphong list meshes` prints all parameters with their ranges and defaults.
//!
//! All shapes are computed in `f64` and rounded once, so that every platform makes the same mesh
//! bit for bit. Polygons are counter-clockwise seen from outside, and vertex normals come from the
//! formula.

mod error;
mod table;
#[cfg(test)]
mod tests;

pub use error::BuiltinError;
pub use table::BUILTINS;

use super::{MeshError, PolygonMesh};
use alloc::vec::Vec;
use core::fmt;

/// A shape that is made by formula.
#[derive(Debug)]
pub struct Builtin {
    /// The name.
    pub name: &'static str,
    /// A description in one line.
    pub doc: &'static str,
    /// The parameters. Shapes with a resolution also accept [`POLYGONS`].
    pub parameters: &'static [ShapeParameter],
    /// The parameters that [`POLYGONS`] chooses; `None` if the shape does not accept it.
    resolution: Option<Resolution>,
    polygon_count: fn(&Values) -> u64,
    build: fn(&Values) -> Result<PolygonMesh, MeshError>,
}

/// The name of the parameter that asks for a polygon count. The resolution whose count is nearest
/// to it is chosen.
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
    /// The smallest value.
    pub min: f64,
    /// The largest value.
    pub max: f64,
    /// A description in a few words.
    pub doc: &'static str,
}

/// The kind of a parameter's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterKind {
    /// A whole number; underscores may stand between digits.
    Integer,
    /// A number.
    Real,
    /// `true` or `false`.
    Bool,
}

impl ParameterKind {
    /// Returns the kind in words.
    fn name(self) -> &'static str {
        match self {
            ParameterKind::Integer => "a whole number",
            ParameterKind::Real => "a number",
            ParameterKind::Bool => "true or false",
        }
    }
}

impl fmt::Display for ParameterKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The parameters that decide how many polygons a shape has.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Resolution {
    /// The parameter for the rows, or for both directions.
    rows: &'static str,
    /// The parameter for the columns, and how many columns the shape has for each row by default.
    /// The polygon count is proportional to the columns.
    columns: Option<(&'static str, f64)>,
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
    /// In the order of the shape's parameters.
    values: Vec<f64>,
}

impl Values {
    fn new(shape: &'static Builtin) -> Self {
        Values {
            shape,
            values: shape.parameters.iter().map(|p| p.default).collect(),
        }
    }

    /// Returns the index of parameter `name`. The name must be one of the shape's own.
    fn index(&self, name: &str) -> usize {
        let index = self.shape.parameters.iter().position(|p| p.name == name);
        index.expect("a shape reads its own parameters")
    }

    fn real(&self, name: &str) -> f64 {
        self.values[self.index(name)]
    }

    fn integer(&self, name: &str) -> usize {
        self.real(name) as usize
    }

    fn switch(&self, name: &str) -> bool {
        self.real(name) != 0.0
    }

    /// Sets a whole number, clamped to the parameter's range.
    fn set_clamped(&mut self, name: &str, value: u64) {
        let index = self.index(name);
        let ShapeParameter { min, max, .. } = self.shape.parameters[index];
        self.values[index] = (value as f64).clamp(min, max);
    }

    fn polygon_count(&self) -> u64 {
        (self.shape.polygon_count)(self)
    }
}

/// Makes the built-in mesh that `spec` describes: `NAME` or `NAME?key=value&key=value`.
///
/// The [module's page](self) lists the shapes. Every parameter is checked, and the polygons are
/// counted, before any memory is allocated.
///
/// # Errors
/// [`BuiltinError`] if the shape or a parameter is unknown, a value is not of its parameter's kind
/// or out of its range, or the mesh would be over the limits of [`PolygonMesh`].
pub fn builtin(spec: &str) -> Result<PolygonMesh, BuiltinError> {
    let values = within_limit(spec)?;
    Ok((values.shape.build)(&values)?)
}

/// Returns how many polygons [`builtin`] makes for `spec`.
///
/// # Errors
/// As [`builtin`].
pub fn polygon_count(spec: &str) -> Result<u64, BuiltinError> {
    Ok(within_limit(spec)?.polygon_count())
}

/// Reads a shape and its parameters, and checks that its mesh is within the polygon limit.
fn within_limit(spec: &str) -> Result<Values, BuiltinError> {
    let values = parse(spec)?;
    match values.polygon_count() {
        count if count > PolygonMesh::MAX_POLYGONS as u64 => {
            Err(BuiltinError::TooManyPolygons { count })
        }
        _ => Ok(values),
    }
}

/// Reads a shape and its parameters, and checks all of them.
fn parse(spec: &str) -> Result<Values, BuiltinError> {
    let (name, settings) = spec.split_once('?').unwrap_or((spec, ""));
    let shape = BUILTINS
        .iter()
        .find(|shape| shape.name == name)
        .ok_or_else(|| BuiltinError::UnknownShape { name: name.into() })?;
    let mut values = Values::new(shape);
    let mut set: Vec<&'static str> = Vec::new();
    let mut polygons = None;
    for setting in settings.split('&').filter(|s| !s.is_empty()) {
        let split = setting.split_once('=');
        let (key, value) = split.ok_or_else(|| BuiltinError::NotKeyValue {
            found: setting.into(),
        })?;
        let parameter = find_parameter(shape, key)?;
        if set.contains(&parameter.name) {
            let parameter = parameter.name;
            return Err(BuiltinError::SetTwice { parameter });
        }
        set.push(parameter.name);
        let value = parameter.parse(value)?;
        if parameter.name == POLYGONS {
            polygons = Some(value as u64);
        } else {
            let index = values.index(parameter.name);
            values.values[index] = value;
        }
    }
    if let (Some(target), Some(resolution)) = (polygons, shape.resolution) {
        if let Some(parameter) = resolution.parameters().find(|key| set.contains(key)) {
            return Err(BuiltinError::PolygonsAndResolution { parameter });
        }
        choose_resolution(&mut values, resolution, target);
    }
    if shape.name == "knot" {
        let factor = common_factor(values.integer("p"), values.integer("q"));
        if factor != 1 {
            return Err(BuiltinError::CommonFactor { factor });
        }
    }
    Ok(values)
}

/// The parameter that asks for a polygon count.
const POLYGONS_PARAMETER: ShapeParameter = ShapeParameter {
    name: POLYGONS,
    kind: ParameterKind::Integer,
    default: 0.0,
    min: 1.0,
    max: PolygonMesh::MAX_POLYGONS as f64,
    doc: "choose the resolution whose polygon count is nearest to this",
};

impl Builtin {
    /// Returns all parameters that can be set. [`POLYGONS`] is the last one, if the shape accepts
    /// it.
    pub fn all_parameters(&self) -> impl Iterator<Item = &'static ShapeParameter> {
        let polygons = self.resolution.map(|_| &POLYGONS_PARAMETER);
        self.parameters.iter().chain(polygons)
    }
}

fn find_parameter(
    shape: &'static Builtin,
    key: &str,
) -> Result<&'static ShapeParameter, BuiltinError> {
    let found = shape.all_parameters().find(|p| p.name == key);
    found.ok_or_else(|| BuiltinError::UnknownParameter {
        shape: shape.name,
        parameter: key.into(),
    })
}

impl ShapeParameter {
    /// Reads a value and checks that it is of the parameter's kind and in its range.
    fn parse(&self, text: &str) -> Result<f64, BuiltinError> {
        let ShapeParameter {
            name: parameter,
            kind,
            min,
            max,
            ..
        } = *self;
        let parsed = match kind {
            // An i128 has room for far more digits than any range allows, so that
            // 99999999999999999999 is reported as out of range and not as no whole number.
            ParameterKind::Integer => text.replace('_', "").parse::<i128>().ok().map(|n| n as f64),
            ParameterKind::Real => text.parse().ok().filter(|n: &f64| !n.is_nan()),
            ParameterKind::Bool => text.parse().ok().map(|b: bool| b as u8 as f64),
        };
        let value = parsed.ok_or_else(|| BuiltinError::WrongKind {
            parameter,
            expected: kind.name(),
            found: text.into(),
        })?;
        if (min..=max).contains(&value) {
            Ok(value)
        } else {
            Err(BuiltinError::OutOfRange {
                parameter,
                found: text.into(),
                min,
                max,
            })
        }
    }
}

/// Returns the greatest common factor, by Euclid's algorithm.
fn common_factor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { common_factor(b, a % b) }
}

/// Sets the resolution whose polygon count is nearest to `target`.
///
/// A shape with rows and columns has its own ratio between them. Row counts up to a tenth away from
/// that ratio are tried, each with the column count that fits it best.
fn choose_resolution(values: &mut Values, resolution: Resolution, target: u64) {
    let Resolution { rows, columns } = resolution;
    let range = values.shape.parameters[values.index(rows)];
    let at = |n: u64| {
        let mut values = values.clone();
        values.set_clamped(rows, n);
        if let Some((columns, ratio)) = columns {
            values.set_clamped(columns, libm::round(ratio * n as f64) as u64);
        }
        values
    };
    // A binary search for the smallest row count, in the shape's own ratio, that makes at least
    // `target` polygons.
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
            let per_column = candidate.polygon_count() as f64 / candidate.real(columns);
            candidate.set_clamped(columns, libm::round(target as f64 / per_column) as u64);
        }
        (
            candidate.polygon_count().abs_diff(target),
            n.abs_diff(low),
            candidate,
        )
    });
    // Of equal misses the one nearest to the shape's own ratio wins.
    let fits = candidates.filter(|(_, _, c)| c.polygon_count() <= PolygonMesh::MAX_POLYGONS as u64);
    if let Some((_, _, best)) = fits.min_by_key(|&(miss, away, _)| (miss, away)) {
        *values = best;
    }
}
