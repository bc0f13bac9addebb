//! The header of a PLY file: its elements, their properties, and how values are written.

use super::super::error::{Place, Refusal, quote};
use super::super::words::text;
use crate::note::{Note, Notes};
use crate::number::suggest::nearest;
use std::format;
use std::string::String;
use std::vec::Vec;

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Type {
    fn named(name: &str) -> Option<Type> {
        Some(match name {
            "char" | "int8" => Type::I8,
            "uchar" | "uint8" => Type::U8,
            "short" | "int16" => Type::I16,
            "ushort" | "uint16" => Type::U16,
            "int" | "int32" => Type::I32,
            "uint" | "uint32" => Type::U32,
            "float" | "float32" => Type::F32,
            "double" | "float64" => Type::F64,
            _ => return None,
        })
    }

    /// Returns the size in bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Type::I8 | Type::U8 => 1,
            Type::I16 | Type::U16 => 2,
            Type::I32 | Type::U32 | Type::F32 => 4,
            Type::F64 => 8,
        }
    }

    /// Returns the value of a full colour channel of this type.
    pub(super) fn full(self) -> f64 {
        match self {
            Type::F32 | Type::F64 => 1.0,
            Type::U16 => 65_535.0,
            _ => 255.0,
        }
    }
}

/// A property of an element: a value or a list of values.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub name: String,
    /// The type of the value, or of each entry of the list.
    pub kind: Type,
    /// The type of the list's count; `None` for a single value.
    pub count: Option<Type>,
}

/// An element and how many of it the file has.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
}

/// The way in which values are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The header of a file.
pub(super) struct Header {
    pub coding: Coding,
    pub elements: Vec<Element>,
    /// True if a comment names a texture.
    pub has_texture: bool,
    /// Notes about lines that are ignored.
    pub notes: Notes,
    /// The first byte after the header and its line.
    pub end: (usize, usize),
}

/// Returns the first line without its end, and its length with the end. All lines of the header end
/// in the byte `end`, which its first line decides: if every line could choose, the first binary
/// value behind the header might look like the LF of a CR LF.
fn split_line(bytes: &[u8], end: u8) -> (&[u8], usize) {
    let length = bytes.iter().position(|byte| *byte == end);
    let length = length.unwrap_or(bytes.len());
    (&bytes[..length], bytes.len().min(length + 1))
}

/// The part of a header that was read so far.
#[derive(Default)]
struct Reading {
    coding: Option<Coding>,
    elements: Vec<Element>,
    has_texture: bool,
    notes: Notes,
}

impl Reading {
    /// Reads the words of line `line`. Returns true for the last line of the header.
    ///
    /// # Errors
    /// The text that was expected instead.
    fn line(&mut self, words: &[&str], line: usize) -> Result<bool, &'static str> {
        match *words {
            ["comment" | "obj_info", ref rest @ ..] => {
                self.has_texture |= rest.first().is_some_and(|word| *word == "TextureFile");
            }
            [] => {}
            ["format", name, ..] => {
                self.coding = Some(match name {
                    "ascii" => Coding::Text,
                    "binary_little_endian" => Coding::LittleEndian,
                    "binary_big_endian" => Coding::BigEndian,
                    _ => return Err("ascii, binary_little_endian or binary_big_endian"),
                });
            }
            ["element", name, count] => {
                let is_whole = count.bytes().all(|byte| byte.is_ascii_digit());
                let expected = if is_whole {
                    "`element`, a name and a count below 2^64"
                } else {
                    "`element`, a name and a count, a whole number"
                };
                let count = count.parse();
                self.elements.push(Element {
                    name: name.into(),
                    count: count.map_err(|_| expected)?,
                    properties: Vec::new(),
                });
            }
            ["property", ref rest @ ..] => {
                let element = self.elements.last_mut();
                let element = element.ok_or("`element` before its properties")?;
                let property = property(rest);
                let expected = "a type and a name, or `list`, two types and a name";
                element.properties.push(property.ok_or(expected)?);
            }
            ["end_header"] => return Ok(true),
            _ if is_remark(words) => {
                let text = "a line of the header is no statement and is ignored";
                let kind = "header-line";
                self.notes.count(kind, line, || Note::warning(kind, text));
            }
            _ => return Err("format, comment, element, property or end_header"),
        }
        Ok(false)
    }
}

/// Reads a header.
///
/// # Errors
/// For the first line that is wrong, and for a file that ends before `end_header`.
pub(super) fn read(bytes: &[u8]) -> Result<Header, Refusal> {
    let blank = bytes.len() - bytes.trim_ascii_start().len();
    let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
    let first = bytes[blank..].iter().position(is_end);
    let first = first.map(|at| blank + at);
    let is_lone = |at: usize| bytes[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n');
    let end = match first {
        Some(at) if is_lone(at) => b'\r',
        _ => b'\n',
    };
    let (mut at, mut line) = (0, 0);
    let mut reading = Reading::default();
    let mut has_begun = false;
    while at < bytes.len() {
        let (statement, length) = split_line(&bytes[at..], end);
        at += length;
        line += 1;
        // The first line that is not blank is `ply`, which was checked before.
        if !has_begun {
            has_begun = words(&text(statement)).next().is_some();
            continue;
        }
        let statement = text(statement);
        let wrong = |expected: &str| {
            let problem = format!("`{}`: expected {expected}", quote(statement.trim()));
            Refusal::at(Place::Line(line), problem)
        };
        let words: Vec<&str> = words(&statement).collect();
        if reading.line(&words, line).map_err(wrong)? {
            let expected = "`format` before the end of the header";
            return Ok(Header {
                coding: reading.coding.ok_or_else(|| wrong(expected))?,
                elements: reading.elements,
                has_texture: reading.has_texture,
                notes: reading.notes,
                end: (at, line + 1),
            });
        }
    }
    let problem = "the file ends in its header: expected `end_header`";
    Err(Refusal {
        notes: reading.notes,
        ..Refusal::at(Place::Line(line.max(1)), problem)
    })
}

/// Returns the words of a line. The bytes that other readers take for blanks are blanks here, too.
pub(super) fn words(line: &str) -> impl Iterator<Item = &str> {
    let is_blank =
        |c: char| c.is_ascii_whitespace() || matches!(c, '\x0b' | '\0' | '\x1a' | '\u{feff}');
    line.split(is_blank).filter(|word| !word.is_empty())
}

/// True if a line is a comment without the word `comment`. A statement with a slip, which decides
/// how values are read, is none.
fn is_remark(words: &[&str]) -> bool {
    let statements = ["ply", "format", "element", "property", "end_header"];
    nearest(words[0], statements).is_none() && words.iter().all(|word| Type::named(word).is_none())
}

/// Reads the words of a property.
fn property(words: &[&str]) -> Option<Property> {
    let (count, kind, name) = match *words {
        ["list", count, kind, name] => (Some(Type::named(count)?), kind, name),
        [kind, name] => (None, kind, name),
        _ => return None,
    };
    Some(Property {
        name: name.into(),
        kind: Type::named(kind)?,
        count,
    })
}
