//! The document: all values and texts of a run, as JSON of schema [`SCHEMA`].
//!
//! [`Document`] holds the measured data, which serde writes. `docs/bench-json.md` describes it.
//! Views read the JSON, not the structs, so they show a document of another machine or commit
//! ([`parse`]) like a new one.

use super::shard::Shard;
use crate::compare::comparison::{BASELINE, Comparison, WHAT_IS_COMPARED, WHAT_IS_TIMED};
use crate::compare::experiments::{Scaling, Speedups};
use crate::compare::timing::Machine;
use crate::lectures::{Figure, FigureContent};
use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use fastphong::number::Counts;
use fastphong::shading::{METHODS, OperationCounts, Variant};
use serde::Serialize;
use serde_json::{Value, json};

/// The schema of the documents written here. Its number grows when a field changes its meaning or
/// disappears. New fields do not change it, so readers must ignore fields that they do not know.
pub const SCHEMA: &str = "fastphong.bench/3";

/// The older schemas, which [`parse`] reads as well, the newest first. Each says which of its
/// values mean something else today: see `docs/bench-json.md`.
pub(super) const OLDER: [(&str, &str); 2] = [
    (
        "fastphong.bench/2",
        "speeds are medians of time passed, which a busy machine spoils; errors can be compared",
    ),
    (
        "fastphong.bench/1",
        "errors of the row engine, bounds, SSIM and FLIP cannot be compared with those of newer schemas, errors of other engines \
         can; speeds are medians of time passed, which a busy machine spoils",
    ),
];

/// The results of a run, and the machine that made them.
#[derive(Clone, Debug, Serialize)]
pub struct Document {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// The command line as typed, with the program first.
    pub command_line: Vec<String>,
    /// The machine that was timed.
    pub machine: Machine,
    /// [`WHAT_IS_TIMED`].
    pub timed: &'static str,
    /// [`WHAT_IS_COMPARED`].
    pub compared: &'static str,
    /// The day, as [`super::utc_date`] writes it.
    pub date: Option<String>,
    /// The seconds that measuring and drawing took.
    pub seconds: Option<f64>,
    /// The method whose speed counts as 1.
    pub baseline: &'static str,
    /// All methods that were compared or timed, in the order of the method table.
    pub methods: Vec<MethodData>,
    /// The scenes, in the order of the page.
    pub comparisons: Vec<Comparison>,
    /// The figures of the lectures.
    pub figures: Vec<FigureData>,
    /// Speeds of all methods relative to naive Phong's, in kernels and frames, scalar and SIMD.
    pub speedups: Option<Speedups>,
    /// Times by the counts of triangles and pixels.
    pub scaling: Option<Scaling>,
    /// Costs of pixels on processors without a floating-point unit, from [`small`]. Only reports
    /// have them.
    pub small: Option<Value>,
    /// The run that this document is a part of, the same text in all parts; `None` if it holds a
    /// whole run.
    pub run: Option<String>,
    /// The part of that run.
    pub shard: Option<Shard>,
}

/// The description of a method.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodData {
    /// The variant as users write it.
    pub name: String,
    /// The name in a sentence.
    pub label: String,
    /// The first word of the name. Methods with the same family share a hue.
    pub family: &'static str,
    /// The idea in one line.
    pub title: &'static str,
    /// The formulas that `fastphong explain` prints.
    pub formula: &'static str,
    /// The lecture or paper that it comes from.
    pub source: &'static str,
    /// The cases in which it fails.
    pub fails: &'static str,
    /// How it handles perspective.
    pub perspective: &'static str,
    /// How it handles lights and eyes at positions.
    pub local: &'static str,
    /// The operations for one light and for four: `lights`, and at each of [`RATES`] the counts of
    /// [`OPERATIONS`].
    pub operations: Vec<BTreeMap<&'static str, Value>>,
}

/// A rate at which a method computes: its name in data, its heading, and a function that selects
/// its counts.
pub type Rate = (&'static str, &'static str, fn(&OperationCounts) -> Counts);

/// All rates.
pub const RATES: [Rate; 7] = [
    ("vertex", "vertex", |c| c.vertex),
    ("polygon", "polygon", |c| c.polygon),
    ("edge", "edge", |c| c.edge),
    ("edge_step", "edge step", |c| c.edge_step),
    ("span", "span", |c| c.span),
    ("walk", "pixel: walk", |c| c.walk),
    ("shade", "pixel: shade", |c| c.shade),
];

/// A kind of operation: its name, its sign, and a function that selects its count.
pub type Operation = (&'static str, char, fn(&Counts) -> u32);

/// All kinds of operations.
pub const OPERATIONS: [Operation; 8] = [
    ("add", '+', |c| c.additions),
    ("mul", '×', |c| c.multiplications),
    ("compare", '<', |c| c.comparisons),
    ("div", '÷', |c| c.divisions),
    ("root", '√', |c| c.roots),
    ("trig", '∿', |c| c.trigonometric),
    ("power", '^', |c| c.powers),
    ("read", '▤', |c| c.lookups),
];

/// A figure of the lectures, finished.
#[derive(Clone, Debug, Serialize)]
pub struct FigureData {
    /// The name, the title, and the place in the lecture.
    #[serde(flatten)]
    pub figure: &'static Figure,
    /// Text, pictures and curves, and the findings.
    #[serde(flatten)]
    pub content: FigureContent,
}

impl Document {
    /// Makes a document of comparisons that were made on this machine.
    pub fn new(command_line: Vec<String>, comparisons: Vec<Comparison>) -> Document {
        let mut document = Document {
            schema: SCHEMA,
            command_line,
            machine: Machine::this(),
            timed: WHAT_IS_TIMED,
            compared: WHAT_IS_COMPARED,
            date: None,
            seconds: None,
            baseline: BASELINE,
            methods: Vec::new(),
            comparisons,
            figures: Vec::new(),
            speedups: None,
            scaling: None,
            small: None,
            run: None,
            shard: None,
        };
        document.describe_methods();
        document
    }

    /// Describes every variant that was compared or timed.
    pub fn describe_methods(&mut self) {
        let rows = self.comparisons.iter().flat_map(Comparison::all_rows);
        let timed = self.speedups.iter().flat_map(|s| &s.methods);
        let names = rows.map(|row| row.name());
        self.methods = described(&mut names.chain(timed.map(|m| m.method.clone())));
    }

    /// Writes the document as indented JSON, with fields in the order of this struct.
    pub fn to_text(&self) -> String {
        indented(self)
    }
}

/// Writes a document as text.
pub(super) fn indented(document: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(document).expect("numbers, texts and lists");
    text.push('\n');
    text
}

/// Returns the measurements of `examples/small/run`, on emulated processors without a
/// floating-point unit. This machine plays no part in them.
pub fn small() -> Value {
    serde_json::from_str(fastphong_report::SMALL).expect("a test reads it")
}

/// Describes each variant once, in the order of the method table. It leaves out unknown variants.
pub(super) fn described(names: &mut dyn Iterator<Item = String>) -> Vec<MethodData> {
    let mut variants: Vec<Variant> = Vec::new();
    for variant in names.filter_map(|name| Variant::parse(&name).ok()) {
        if variants
            .iter()
            .all(|other| other.to_string() != variant.to_string())
        {
            variants.push(variant);
        }
    }
    variants.sort_by_cached_key(|v| METHODS.iter().position(|e| e.info.name == v.info().name));
    variants.iter().map(MethodData::of).collect()
}

impl MethodData {
    /// Describes a variant.
    pub fn of(variant: &Variant) -> MethodData {
        let info = variant.info();
        let operations = |lights: usize| {
            let counts = variant.operations(lights);
            let list = |rate: &Counts| json!(OPERATIONS.map(|(.., of)| of(rate)));
            let rates = RATES.map(|(name, _, rate)| (name, list(&rate(&counts))));
            rates
                .into_iter()
                .chain([("lights", json!(lights))])
                .collect()
        };
        MethodData {
            name: variant.to_string(),
            label: label(&variant.to_string()),
            family: info.name.split('-').next().unwrap_or_default(),
            title: info.title,
            formula: info.formula,
            source: info.source,
            fails: info.fails,
            perspective: variant.row().needs.perspective.sentence(),
            local: variant.row().needs.local.sentence(),
            operations: [1, 4].map(operations).into(),
        }
    }
}

/// Returns a variant's name in a sentence: `fast Phong rsqrt`, `slerp Phong (steps=2)`.
pub fn label(variant: &str) -> String {
    let (name, parameters) = variant.split_once(':').unwrap_or((variant, ""));
    let word = |word: &str| match word {
        "phong" | "gouraud" | "duff" | "blinn" | "bishop" | "weimer" => {
            format!("{}{}", word[..1].to_uppercase(), &word[1..])
        }
        word => word.to_string(),
    };
    let words = name.split('-').map(word).collect::<Vec<_>>().join(" ");
    match parameters {
        "" => words,
        parameters => format!("{words} ({parameters})"),
    }
}

/// The reason why a text is not a document.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DocumentError {
    /// It is not JSON. The message has line and column.
    #[error("{0}: expected a document of schema `{SCHEMA}`")]
    Json(#[from] serde_json::Error),
    /// A field is missing, or has a value of another kind.
    #[error("{0}: expected a document of schema `{SCHEMA}`")]
    Field(String),
    /// It names another schema.
    #[error("schema `{0}`: expected `{SCHEMA}`, or the older `{two}` or `{one}`", two = OLDER[0].0, one = OLDER[1].0)]
    Schema(String),
    /// It names no schema.
    #[error("no `schema`: expected `{SCHEMA}`")]
    NoSchema,
}

/// The fields that views read, with an example of each value. Fields with `?` may be missing or
/// null. 0 stands for a whole number from 0, 0.5 for any number from 0, and -0.5 for any number. A
/// list with null and another example may contain both.
const FIELDS: &str = include_str!("fields.json");

/// Reads a document of this schema or of an older one. Values of the oldest schema that mean
/// something else today become null, except errors of the row engine. Medians and quartiles of
/// older schemas stand for today's typical times and their intervals.
///
/// # Errors
/// An error that says where, if the text is not JSON, has another schema, or lacks a field.
pub fn parse(text: &str) -> Result<Value, DocumentError> {
    // Some editors and shells begin a text with a byte-order mark.
    let text = text.strip_prefix('\u{FEFF}').unwrap_or(text);
    let mut document: Value = serde_json::from_str(text)?;
    let age = match document["schema"].as_str() {
        Some(SCHEMA) => None,
        Some(schema) => match OLDER.iter().position(|(older, _)| *older == schema) {
            None => return Err(DocumentError::Schema(schema.to_string())),
            age => age,
        },
        None => return Err(DocumentError::NoSchema),
    };
    let mut fields: Value = serde_json::from_str(FIELDS)?;
    if age.is_some() {
        without_typical(&mut fields);
    }
    check(&document, &fields, "the document").map_err(DocumentError::Field)?;
    if age.is_some() {
        for timed in ["comparisons", "speedups", "scaling"] {
            add_typical(&mut document[timed]);
        }
    }
    if age == Some(1) {
        drop_changed(&mut document);
    }
    Ok(document)
}

/// Returns the schema of a document and how its values differ from today's, if it is an older one.
pub(super) fn older(document: &Value) -> Option<(&'static str, &'static str)> {
    let mut all = OLDER.into_iter();
    all.find(|(schema, _)| document["schema"] == *schema)
}

/// Replaces the fields of typical times in an example by those of older schemas.
pub(super) fn without_typical(example: &mut Value) {
    match example {
        Value::Object(fields) => {
            for field in ["typical_ns", "low_ns", "high_ns"] {
                fields.remove(field);
            }
            if let Some(typical) = fields.remove("typical") {
                fields.insert("median".into(), typical);
            }
            fields.values_mut().for_each(without_typical);
        }
        Value::Array(examples) => examples.iter_mut().for_each(without_typical),
        _ => {}
    }
}

/// Adds the fields of typical times to timings and ratios of older schemas.
fn add_typical(value: &mut Value) {
    match value {
        Value::Object(fields) => {
            for (older, newer) in [
                ("median", "typical"),
                ("median_ns", "typical_ns"),
                ("p25_ns", "low_ns"),
                ("p75_ns", "high_ns"),
            ] {
                if let Some(value) = fields.get(older).cloned() {
                    fields.insert(newer.into(), value);
                }
            }
            fields.values_mut().for_each(add_typical);
        }
        Value::Array(values) => values.iter_mut().for_each(add_typical),
        _ => {}
    }
}

/// Checks that a value is of the same kind as an example. The error says where it is not.
fn check(value: &Value, example: &Value, place: &str) -> Result<(), String> {
    match (value, example) {
        (Value::Object(fields), Value::Object(examples)) => {
            for (key, example) in examples {
                let name = key.trim_end_matches('?');
                match fields.get(name) {
                    None | Some(Value::Null) if name != key => {}
                    None => return Err(format!("{place}: missing field `{name}`")),
                    Some(value) => check(value, example, &format!("{place}, {name}"))?,
                }
            }
            Ok(())
        }
        (Value::Array(values), Value::Array(examples)) => {
            let all = values.iter().enumerate();
            let mut rest = all.filter(|(_, value)| !(examples[0].is_null() && value.is_null()));
            let example = examples.last().unwrap_or(&Value::Null);
            rest.try_for_each(|(i, value)| check(value, example, &format!("{place} {i}")))
        }
        (Value::Number(value), Value::Number(example)) => {
            let is_from_0 = value.as_f64() >= Some(0.0);
            match example.as_f64() {
                Some(0.0) if !value.is_u64() => {
                    Err(format!("{place}: expected a whole number from 0"))
                }
                Some(0.5) if !is_from_0 => Err(format!("{place}: expected a number from 0")),
                _ => Ok(()),
            }
        }
        _ if core::mem::discriminant(value) == core::mem::discriminant(example) => Ok(()),
        (_, example) => {
            let expected = match example {
                Value::Null => return Ok(()),
                Value::Bool(_) => "true or false",
                Value::Number(_) => "a number",
                Value::String(_) => "a text",
                Value::Array(_) => "a list",
                Value::Object(_) => "an object",
            };
            Err(format!("{place}: expected {expected}"))
        }
    }
}

/// Removes the values of a document of the oldest schema that mean something else today.
fn drop_changed(document: &mut Value) {
    for comparison in document["comparisons"].as_array_mut().into_iter().flatten() {
        for rows in ["rows", "barycentric"] {
            for row in comparison[rows].as_array_mut().into_iter().flatten() {
                (row["bound"], row["within_bound"]) = (Value::Null, Value::Null);
                (row["error"]["ssim"], row["error"]["flip"]) = (Value::Null, Value::Null);
            }
        }
    }
}

/// Returns the text at a JSON pointer, or an empty one.
pub(super) fn text<'a>(value: &'a Value, pointer: &str) -> &'a str {
    let found = value.pointer(pointer).and_then(Value::as_str);
    found.unwrap_or_default()
}

/// Returns the number at a JSON pointer, if there is one.
pub(super) fn number(value: &Value, pointer: &str) -> Option<f64> {
    value.pointer(pointer)?.as_f64()
}

/// Returns the list at a JSON pointer, or an empty one.
pub(super) fn list<'a>(value: &'a Value, pointer: &str) -> &'a [Value] {
    let found = value.pointer(pointer).and_then(Value::as_array);
    found.map_or(&[], |list| list)
}

/// Returns the title of a scene, or its name if it has no title.
pub(super) fn title(scene: &Value) -> &str {
    match text(scene, "/title") {
        "" => text(scene, "/name"),
        title => title,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_names_of_people_and_words() {
        assert_eq!(label("fast-phong-rsqrt"), "fast Phong rsqrt");
        assert_eq!(label("gouraud"), "Gouraud");
        assert_eq!(label("fast-phong:steps=2"), "fast Phong (steps=2)");
    }
}
