//! One list of entries as JSON, as a header for C, and as a module for Python.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// A value with its name, and a sentence that says what it is.
pub struct Entry {
    pub key: &'static str,
    pub says: &'static str,
    pub value: Value,
}

impl Entry {
    pub fn new(key: &'static str, says: &'static str, value: Value) -> Entry {
        Entry { key, says, value }
    }
}

/// A value.
pub enum Value {
    Text(String),
    Number(f64),
    Single(f32),
    Whole(u32),
    Flag(bool),
    /// No number: `null`, `None`, or 0 in C.
    Missing,
    /// No vector: `null`, `None`, or zeros in C.
    NoVector,
    /// Values of one kind, at least one.
    List(Vec<Value>),
    /// A table.
    Table(Table),
}

/// Rows of values.
pub struct Table {
    /// What one row is.
    pub one: &'static str,
    /// The name and the kind of each column.
    pub columns: &'static [(&'static str, Kind)],
    pub rows: Vec<Vec<Value>>,
}

/// The kind of a column's values.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Text,
    Flag,
    Number,
    Vector,
}

impl Value {
    /// Makes a list of numbers.
    pub fn vector<const N: usize>(numbers: [f64; N]) -> Value {
        Value::List(numbers.map(Value::Number).into())
    }
}

/// Makes the value of one of a few words.
pub fn word(word: &str) -> Value {
    Value::Text(word.into())
}

/// Returns `text` as one short word of letters, digits, `-`, `_` and `.`; `other` if nothing is
/// left.
pub fn token(text: &str, other: &str) -> String {
    let letter = |c: char| {
        let is_plain = c.is_ascii_alphanumeric() || "-_.".contains(c);
        if is_plain { c } else { '_' }
    };
    let token: String = text.chars().take(60).map(letter).collect();
    if token.is_empty() {
        other.into()
    } else {
        token
    }
}

/// The words for values in a language.
struct Language {
    truth: [&'static str; 2],
    missing: &'static str,
    no_vector: &'static str,
    brackets: [&'static str; 2],
}

const JSON: Language = Language {
    truth: ["false", "true"],
    missing: "null",
    no_vector: "null",
    brackets: ["[", "]"],
};
const PYTHON: Language = Language {
    truth: ["False", "True"],
    missing: "None",
    no_vector: "None",
    brackets: ["[", "]"],
};
const C: Language = Language {
    truth: ["0", "1"],
    missing: "0.0",
    no_vector: "{0.0, 0.0, 0.0}",
    brackets: ["{", "}"],
};

impl Language {
    /// Writes a value. Lists of lists take a line each.
    fn value(&self, value: &Value) -> String {
        match value {
            Value::Text(text) => quoted(text),
            // The shortest digits that read as the same number, always with a point or an exponent.
            Value::Number(number) => format!("{:?}", number + 0.0),
            Value::Single(number) => format!("{:?}", number + 0.0),
            Value::Whole(number) => format!("{number}"),
            Value::Flag(flag) => self.truth[usize::from(*flag)].into(),
            Value::Missing => self.missing.into(),
            Value::NoVector => self.no_vector.into(),
            Value::List(list) => {
                let is_nested = list.iter().any(|value| matches!(value, Value::List(_)));
                let items: Vec<String> = list.iter().map(|value| self.value(value)).collect();
                self.list(&items, is_nested)
            }
            Value::Table(Table { columns, rows, .. }) => {
                let row = |row: &Vec<Value>| {
                    let pairs = columns.iter().zip(row);
                    let pairs = pairs
                        .map(|((key, _), value)| format!("{}: {}", quoted(key), self.value(value)));
                    format!("{{{}}}", pairs.collect::<Vec<_>>().join(", "))
                };
                self.list(&rows.iter().map(row).collect::<Vec<_>>(), true)
            }
        }
    }

    fn list(&self, items: &[String], has_lines: bool) -> String {
        let [open, close] = self.brackets;
        if has_lines && !items.is_empty() {
            format!("{open}\n    {}\n  {close}", items.join(",\n    "))
        } else {
            format!("{open}{}{close}", items.join(", "))
        }
    }
}

/// Writes a text between quotes, with the escapes that JSON, C and Python share.
fn quoted(text: &str) -> String {
    let escaped = |letter: char| match letter {
        '"' | '\\' => format!("\\{letter}"),
        letter if letter.is_control() => "_".into(),
        letter => letter.into(),
    };
    let text: String = text.chars().map(escaped).collect();
    format!("\"{text}\"")
}

/// Returns the entries as a JSON file.
pub fn json(entries: &[Entry], made: &str) -> String {
    let about = quoted(made);
    let schema = "\"schema\": \"fastphong.export/1\"";
    let says = entries.iter().filter(|entry| !entry.says.is_empty());
    let says: Vec<String> = says
        .map(|entry| format!("{}: {}", quoted(entry.key), quoted(entry.says)))
        .collect();
    let values = entries.iter().map(|entry| {
        let value = JSON.value(&entry.value);
        format!(",\n  {}: {value}", quoted(entry.key))
    });
    let values: String = values.collect();
    format!(
        "{{\n  \"about\": {about},\n  {schema},\n  \"meaning\": {{\n    {}\n  }}{values}\n}}\n",
        says.join(",\n    ")
    )
}

/// Returns the entries as a module for Python.
pub fn python(entries: &[Entry], made: &str) -> String {
    let mut text = format!("# {made}\n");
    for entry in entries {
        if !entry.says.is_empty() {
            text += &format!("\n# {}\n", entry.says);
        }
        text += &format!("{} = {}\n", entry.key, PYTHON.value(&entry.value));
    }
    text
}

/// Returns the entries as a header for C and C++.
pub fn c(entries: &[Entry], made: &str) -> String {
    let mut text = format!("/* {made} */\n#ifndef FASTPHONG_SCENE_H\n#define FASTPHONG_SCENE_H\n");
    for entry in entries {
        if !entry.says.is_empty() {
            text += &format!("\n/* {} */\n", entry.says);
        }
        text += &c_entry(entry.key, &entry.value);
    }
    // Two question marks begin a trigraph.
    text.replace("??", "__") + "\n#endif\n"
}

/// Declares a value: a macro for a single one, an array for a list, an array for each column of a
/// table.
fn c_entry(key: &str, value: &Value) -> String {
    let upper = key.to_uppercase();
    let literal = || C.value(value);
    match value {
        Value::List(list) => {
            let sizes = match &list[0] {
                Value::List(row) => format!("[{}][{}]", list.len(), row.len()),
                _ => format!("[{}]", list.len()),
            };
            format!("static const double scene_{key}{sizes} = {};\n", literal())
        }
        Value::NoVector => format!("static const double scene_{key}[3] = {};\n", literal()),
        Value::Table(Table { one, columns, rows }) => {
            let column = |(index, (name, kind)): (usize, &(&str, Kind))| {
                let values = rows.iter().map(|row| C.value(&row[index]));
                c_column(&format!("scene_{one}_{name}"), *kind, values.collect())
            };
            let columns: String = columns.iter().enumerate().map(column).collect();
            format!("#define SCENE_{upper} {}\n{columns}", rows.len())
        }
        _ => format!("#define SCENE_{upper} {}\n", literal()),
    }
}

/// Declares the array of a column. C has no empty arrays, so there is at least one element.
fn c_column(name: &str, kind: Kind, mut values: Vec<String>) -> String {
    let (element, size, zero) = match kind {
        Kind::Text => ("char *const", "", "\"\""),
        Kind::Flag => ("int", "", "0"),
        Kind::Number => ("double", "", "0.0"),
        Kind::Vector => ("double", "[3]", C.no_vector),
    };
    if values.is_empty() {
        values.push(zero.into());
    }
    let (count, values) = (values.len(), values.join(", "));
    format!("static const {element} {name}[{count}]{size} = {{{values}}};\n")
}
