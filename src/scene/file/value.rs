//! Values of a scene file and where each was set. Read from TOML by the list of keys, and written
//! back.

use super::diagnostics::{Origin, SceneError};
use super::schema::{AXES, Key, SCENE, ValueKind};
use crate::number::suggest;
use glam::DVec3;
use std::borrow::ToOwned;
use std::collections::BTreeMap;
use std::format;
use std::ops::Range;
use std::string::String;
use std::vec::Vec;
use toml::Spanned;
use toml::de::{DeTable, DeValue};
use toml_writer::ToTomlValue;

/// A value and where it was set. Two values are equal if their data are.
#[derive(Clone, Debug)]
pub struct Value {
    /// The value. It has the kind of its key, but its range is not checked yet.
    pub data: Data,
    /// Where it was set.
    pub origin: Origin,
}

/// The contents of a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Data {
    /// Text, or a word.
    Text(String),
    /// True or false.
    Switch(bool),
    /// A whole number.
    Whole(i64),
    /// A number.
    Number(f64),
    /// Three numbers, or one number that stands for all three.
    Triple([f64; 3]),
    /// Three rows of four numbers.
    Matrix([[f64; 4]; 3]),
    /// A table.
    Table(SceneTable),
    /// A list of tables.
    Tables(Vec<SceneTable>),
}

/// A table of values by their keys.
#[derive(Clone, Debug, Default)]
pub struct SceneTable {
    /// The values.
    #[doc(hidden)]
    pub entries: BTreeMap<&'static str, Value>,
    /// Where its header is.
    #[doc(hidden)]
    pub origin: Origin,
}

impl PartialEq for Value {
    fn eq(&self, other: &Self) -> bool {
        self.data == other.data
    }
}

impl PartialEq for SceneTable {
    fn eq(&self, other: &Self) -> bool {
        self.entries == other.entries
    }
}

impl SceneTable {
    /// Reads a scene from TOML text.
    ///
    /// # Errors
    /// If the text is not TOML, a key or word is unknown, or a value is of the wrong kind.
    pub fn parse(text: &str) -> Result<SceneTable, SceneError> {
        let table = DeTable::parse(text).map_err(|error| SceneError::from_toml(&error))?;
        let mut scene = read_table(table.get_ref(), Origin::File(table.span()), SCENE)?;
        // An empty table means the same as no table.
        scene.entries.retain(|_, value| match &value.data {
            Data::Table(table) => !table.entries.is_empty(),
            _ => true,
        });
        Ok(scene)
    }

    /// Sets `key` to a value.
    #[doc(hidden)]
    pub fn set(&mut self, key: &'static str, data: Data, origin: Origin) {
        self.entries.insert(key, Value { data, origin });
    }

    /// Returns the value of `key`, if it is set.
    #[doc(hidden)]
    pub fn get(&self, key: &str) -> Option<&Value> {
        self.entries.get(key)
    }

    /// Returns the text or word of `key`, if it is set.
    pub fn text(&self, key: &str) -> Option<&str> {
        match &self.get(key)?.data {
            Data::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Returns the three numbers of `key`, if it is set.
    pub fn triple(&self, key: &str) -> Option<DVec3> {
        match self.get(key)?.data {
            Data::Triple(values) => Some(DVec3::from_array(values)),
            _ => None,
        }
    }

    /// Returns the table called `key`, if it is set.
    pub fn table(&self, key: &str) -> Option<&SceneTable> {
        match &self.get(key)?.data {
            Data::Table(table) => Some(table),
            _ => None,
        }
    }

    /// Returns the table called `key`, and creates it if it is absent.
    pub fn table_mut(&mut self, key: &'static str) -> &mut SceneTable {
        let value = self.entries.entry(key).or_insert_with(|| Value {
            data: Data::Table(SceneTable::default()),
            origin: Origin::Program,
        });
        match &mut value.data {
            Data::Table(table) => table,
            other => panic!("`{key}` is no table: {other:?}"),
        }
    }

    /// Returns the tables called `key`, or none if it is absent.
    pub fn tables(&self, key: &str) -> &[SceneTable] {
        match self.get(key).map(|value| &value.data) {
            Some(Data::Tables(tables)) => tables,
            _ => &[],
        }
    }

    /// Replaces the values that `over` sets, key by key within tables. Lists are replaced as a
    /// whole.
    pub fn overlay(&mut self, over: SceneTable) {
        for (key, value) in over.entries {
            match value.data {
                Data::Table(over) if self.table(key).is_some() => self.table_mut(key).overlay(over),
                _ => {
                    self.entries.insert(key, value);
                }
            }
        }
    }

    /// Appends the table as TOML: its values first, then its tables, under headers that begin with
    /// `path`.
    #[doc(hidden)]
    pub fn write(&self, kind: ValueKind, path: &str, out: &mut String) {
        let given = |key: &'static Key| Some((key, &self.get(key.name())?.data));
        for (key, data) in kind.keys().filter_map(given) {
            if let Some(text) = inline(data, key.kind) {
                *out += &format!("{} = {text}\n", key.name());
            }
        }
        for (key, data) in kind.keys().filter_map(given) {
            let path = format!("{path}{}", key.name());
            let mut write = |header: String, table: &SceneTable| {
                let gap = if out.is_empty() { "" } else { "\n" };
                *out += &format!("{gap}{header}\n");
                table.write(key.kind, &format!("{path}."), out);
            };
            match (data, key.kind) {
                (Data::Table(table), _) => write(format!("[{path}]"), table),
                (Data::Tables(tables), ValueKind::Tables(_)) => tables
                    .iter()
                    .for_each(|table| write(format!("[[{path}]]"), table)),
                _ => {}
            }
        }
    }
}

/// Returns a value as it is written on the right of an equals sign, or `None` for tables under
/// headers.
fn inline(data: &Data, kind: ValueKind) -> Option<String> {
    Some(match (data, kind) {
        (Data::Text(text), _) => text.to_toml_value(),
        (Data::Switch(value), _) => value.to_toml_value(),
        (Data::Whole(value), _) => value.to_toml_value(),
        (Data::Number(value), _) => value.to_toml_value(),
        // Compared by their bits, so that 0 and −0 stay apart.
        (Data::Triple([r, g, b]), ValueKind::OneOrThree)
            if [g, b].map(|v| v.to_bits()) == [r.to_bits(); 2] =>
        {
            r.to_toml_value()
        }
        (Data::Triple(values), _) => values.to_toml_value(),
        (Data::Matrix(rows), _) => rows.to_toml_value(),
        (Data::Tables(turns), ValueKind::Turns) => {
            let turn = |turn: &SceneTable| {
                let keys = kind.keys().filter_map(|key| {
                    let text = inline(&turn.get(key.name())?.data, key.kind)?;
                    Some(format!("{} = {text}", key.name()))
                });
                format!("{{ {} }}", keys.collect::<Vec<_>>().join(", "))
            };
            match &turns[..] {
                [one] => turn(one),
                more => format!("[{}]", more.iter().map(turn).collect::<Vec<_>>().join(", ")),
            }
        }
        (Data::Tables(tables), _) if tables.is_empty() => "[]".to_owned(),
        (Data::Table(_) | Data::Tables(_), _) => return None,
    })
}

/// Reads a table of this kind.
fn read_table(table: &DeTable, origin: Origin, kind: ValueKind) -> Result<SceneTable, SceneError> {
    let mut entries = BTreeMap::new();
    for (name, value) in table {
        let known = kind.keys().find(|key| key.name() == name.get_ref());
        let key = known.ok_or_else(|| {
            let names: Vec<_> = kind.keys().map(Key::name).collect();
            unknown("key", name.get_ref(), name.span(), &names)
        })?;
        let (data, origin) = (read(value, key.kind)?, Origin::File(value.span()));
        entries.insert(key.name(), Value { data, origin });
    }
    let missing = |key: &&Key| key.needed && !entries.contains_key(key.name());
    if let Some(key) = kind.keys().find(missing) {
        let title = format!("the key `{}` is missing", key.name());
        return Err(SceneError::new(origin, title, "in this table"));
    }
    Ok(SceneTable { entries, origin })
}

/// Reads a value of the kind that its key requires.
fn read(value: &Spanned<DeValue>, kind: ValueKind) -> Result<Data, SceneError> {
    let table = |value: &Spanned<DeValue>| match value.get_ref() {
        DeValue::Table(table) => read_table(table, Origin::File(value.span()), kind),
        _ => Err(wrong(value, &ValueKind::Table("").expected())),
    };
    match (kind, value.get_ref()) {
        (ValueKind::Text, DeValue::String(text)) => Ok(Data::Text(text.clone().into_owned())),
        (ValueKind::Word(words), DeValue::String(word)) => {
            if words.contains(&&**word) {
                Ok(Data::Text(word.clone().into_owned()))
            } else {
                Err(unknown("word", word, value.span(), words))
            }
        }
        (ValueKind::Switch, DeValue::Boolean(switch)) => Ok(Data::Switch(*switch)),
        (ValueKind::Whole, _) => {
            let whole = whole(value.get_ref()).map(Data::Whole);
            let expected = match value.get_ref() {
                DeValue::Integer(_) => "a whole number of up to 18 digits".to_owned(),
                _ => kind.expected(),
            };
            whole.ok_or_else(|| wrong(value, &expected))
        }
        (ValueKind::Number, _) => number(value).map(Data::Number),
        (ValueKind::OneOrThree, DeValue::Integer(_) | DeValue::Float(_)) => {
            Ok(Data::Triple([number(value)?; 3]))
        }
        (ValueKind::Axis, DeValue::String(word)) if AXES.contains(&&**word) => {
            Ok(Data::Text(word.clone().into_owned()))
        }
        (ValueKind::OneOrThree | ValueKind::Triple | ValueKind::Axis, DeValue::Array(items)) => {
            list(value, items, &kind.expected(), number).map(Data::Triple)
        }
        (ValueKind::Matrix, DeValue::Array(rows)) => {
            const ROW: &str = "four numbers [x, y, z, offset]";
            let row = |row: &Spanned<DeValue>| match row.get_ref() {
                DeValue::Array(items) => list(row, items, ROW, number),
                _ => Err(wrong(row, ROW)),
            };
            list(value, rows, &kind.expected(), row).map(Data::Matrix)
        }
        (ValueKind::Table(_), _) => table(value).map(Data::Table),
        (ValueKind::Tables(_) | ValueKind::Turns, DeValue::Array(items)) => {
            let tables = items.iter().map(table);
            tables.collect::<Result<_, _>>().map(Data::Tables)
        }
        (ValueKind::Tables(_) | ValueKind::Turns, DeValue::Table(_)) => {
            Ok(Data::Tables([table(value)?].into()))
        }
        _ => Err(wrong(value, &kind.expected())),
    }
}

/// Returns a whole number, written in any radix.
fn whole(value: &DeValue) -> Option<i64> {
    let integer = value.as_integer()?;
    i64::from_str_radix(integer.as_str(), integer.radix()).ok()
}

fn number(value: &Spanned<DeValue>) -> Result<f64, SceneError> {
    let number = match value.get_ref() {
        DeValue::Float(float) => float.as_str().parse().ok(),
        // An integer in place of a float may have more digits than a whole number.
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
        other => whole(other).map(|whole| whole as f64),
    };
    number.ok_or_else(|| wrong(value, &ValueKind::Number.expected()))
}

/// Reads the `N` items of the list `value`, each by `item`.
fn list<T, const N: usize>(
    value: &Spanned<DeValue>,
    items: &[Spanned<DeValue>],
    expected: &str,
    item: impl Fn(&Spanned<DeValue>) -> Result<T, SceneError>,
) -> Result<[T; N], SceneError> {
    let items: Vec<T> = items.iter().map(item).collect::<Result<_, _>>()?;
    items.try_into().map_err(|items: Vec<T>| {
        let found = match items.len() {
            0 => "found an empty list".to_owned(),
            1 => "found a list of one".to_owned(),
            n => format!("found a list of {n}"),
        };
        let origin = Origin::File(value.span());
        SceneError::new(origin, format!("expected {expected}"), found)
    })
}

/// Makes the error for a value of the wrong kind.
fn wrong(value: &Spanned<DeValue>, expected: &str) -> SceneError {
    let found = match value.get_ref() {
        DeValue::String(text) => format!("string {text:?}"),
        DeValue::Integer(number) => format!("integer `{number}`"),
        DeValue::Float(number) => format!("floating point `{number}`"),
        DeValue::Boolean(value) => format!("boolean `{value}`"),
        DeValue::Datetime(_) => "a date or a time".to_owned(),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    };
    let (origin, found) = (Origin::File(value.span()), format!("found {found}"));
    SceneError::new(origin, format!("expected {expected}"), found)
}

/// Makes the error for an unknown key or word, with a suggestion if one is near.
fn unknown(what: &str, found: &str, at: Range<usize>, known: &[&'static str]) -> SceneError {
    let (title, known) = (format!("unknown {what} `{found}`"), known.iter().copied());
    let error = SceneError::new(Origin::File(at), title, suggest::one_of(known.clone()));
    match suggest::nearest(found, known) {
        Some(nearest) => error.help(format!("did you mean `{nearest}`?")),
        None => error,
    }
}
