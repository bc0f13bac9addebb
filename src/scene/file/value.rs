//! Values of a scene file: what can be written, and where each one was given.

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Unexpected, Visitor};
use serde::ser::{Serialize, Serializer};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;
use std::string::String;
use std::vec::Vec;

/// Where a value was given: what an error about it points at.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Origin {
    /// By the program.
    #[default]
    Program,
    /// In the scene file, at these bytes.
    File(Range<usize>),
    /// By this command-line flag, for example `--fovy`.
    Flag(String),
}

/// A value and where it was given. Two of them are equal when their values are.
#[derive(Clone, Debug, Default)]
pub struct Located<T> {
    /// The value, not yet checked.
    pub value: T,
    /// Where it was given.
    pub origin: Origin,
}

impl<T> Located<T> {
    /// A value given by a command-line flag, for example `--fovy`.
    pub fn flag(value: T, flag: impl Into<String>) -> Self {
        Located {
            value,
            origin: Origin::Flag(flag.into()),
        }
    }
}

impl<T> From<T> for Located<T> {
    fn from(value: T) -> Self {
        Located {
            value,
            origin: Origin::Program,
        }
    }
}

impl<T: PartialEq> PartialEq for Located<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<'de, T: Value> Deserialize<'de> for Located<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let spanned = toml::Spanned::<Plain<T>>::deserialize(deserializer)?;
        let origin = Origin::File(spanned.span());
        Ok(Located {
            value: spanned.into_inner().0,
            origin,
        })
    }
}

impl<T: Value> Serialize for Located<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.write(serializer)
    }
}

/// What can be written on the right of an equals sign in a scene file.
///
/// Not serde's own traits: their messages speak of `f64` and sequences, these of numbers and `[x, y, z]`.
pub trait Value: Sized {
    /// Reads the value.
    ///
    /// # Errors
    /// When something else stands there: says what was expected.
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error>;

    /// Writes the value.
    ///
    /// # Errors
    /// Those of the serializer.
    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;
}

/// A value without a place, seen by serde.
struct Plain<T>(T);

impl<'de, T: Value> Deserialize<'de> for Plain<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::read(deserializer).map(Plain)
    }
}

struct NumberVisitor;

impl Visitor<'_> for NumberVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a number")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f64, E> {
        Ok(value)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }
}

impl Value for f64 {
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_f64(NumberVisitor)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(*self)
    }
}

struct WholeNumberVisitor;

impl Visitor<'_> for WholeNumberVisitor {
    type Value = i64;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a whole number")
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<i64, E> {
        Ok(value)
    }
}

impl Value for i64 {
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_i64(WholeNumberVisitor)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_i64(*self)
    }
}

struct SwitchVisitor;

impl Visitor<'_> for SwitchVisitor {
    type Value = bool;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("true or false")
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<bool, E> {
        Ok(value)
    }
}

impl Value for bool {
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_bool(SwitchVisitor)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bool(*self)
    }
}

struct TextVisitor;

impl Visitor<'_> for TextVisitor {
    type Value = String;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("text in quotes")
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<String, E> {
        Ok(value.into())
    }
}

impl Value for String {
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_str(TextVisitor)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self)
    }
}

/// Reads `N` values in brackets; `expected` says so in words.
struct ArrayVisitor<T, const N: usize> {
    expected: &'static str,
    item: PhantomData<T>,
}

impl<T, const N: usize> ArrayVisitor<T, N> {
    fn new(expected: &'static str) -> Self {
        ArrayVisitor {
            expected,
            item: PhantomData,
        }
    }
}

impl<'de, T: Value, const N: usize> Visitor<'de> for ArrayVisitor<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<[T; N], A::Error> {
        let mut values = Vec::new();
        while let Some(Plain(value)) = items.next_element()? {
            values.push(value);
        }
        let found = values.len();
        values
            .try_into()
            .map_err(|_| A::Error::invalid_type(Unexpected::Other(&counted(found)), &self))
    }
}

/// How many numbers were found, in words.
fn counted(numbers: usize) -> String {
    match numbers {
        0 => "an empty list".into(),
        1 => "a list of one".into(),
        _ => std::format!("a list of {numbers}"),
    }
}

impl Value for [f64; 3] {
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ArrayVisitor::new("three numbers [x, y, z]"))
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.serialize(serializer)
    }
}

impl Value for [f64; 4] {
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ArrayVisitor::new("four numbers [x, y, z, offset]"))
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.serialize(serializer)
    }
}

impl Value for [[f64; 4]; 3] {
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ArrayVisitor::new("three rows of four numbers"))
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.serialize(serializer)
    }
}

/// Three numbers that may be written as one when they are the same: a colour, a coefficient, a scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneOrThree(pub [f64; 3]);

impl OneOrThree {
    /// Three times the same number.
    pub const fn splat(value: f64) -> Self {
        OneOrThree([value; 3])
    }

    /// From values stored in 32 bits: the shortest decimals that name them, 0.1 and not 0.10000000149.
    pub fn shortest(values: [f32; 3]) -> Self {
        OneOrThree(values.map(shortest))
    }
}

/// The double nearest to the shortest decimal that names `value`.
pub(super) fn shortest(value: f32) -> f64 {
    // What is printed can be read; the fallback is there to have no panic in this path.
    std::format!("{value}").parse().unwrap_or(f64::from(value))
}

impl From<f64> for OneOrThree {
    fn from(value: f64) -> Self {
        OneOrThree::splat(value)
    }
}

impl From<[f64; 3]> for OneOrThree {
    fn from(values: [f64; 3]) -> Self {
        OneOrThree(values)
    }
}

struct OneOrThreeVisitor;

impl<'de> Visitor<'de> for OneOrThreeVisitor {
    type Value = OneOrThree;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("one number or three in brackets")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<OneOrThree, E> {
        Ok(OneOrThree::splat(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<OneOrThree, E> {
        Ok(OneOrThree::splat(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<OneOrThree, A::Error> {
        ArrayVisitor::new("one number or three in brackets")
            .visit_seq(items)
            .map(OneOrThree)
    }
}

impl Value for OneOrThree {
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OneOrThreeVisitor)
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            // By their bits: 0 and −0 are kept apart.
            [r, g, b] if [g, b].map(f64::to_bits) == [r; 2].map(f64::to_bits) => {
                serializer.serialize_f64(r)
            }
            values => values.serialize(serializer),
        }
    }
}

/// A choice that is written as one of a few words.
pub trait Choice: Copy + PartialEq + 'static {
    /// The words, in the order in which messages list them.
    const WORDS: &'static [&'static str];
    /// What each word means, in the same order.
    const MEANINGS: &'static [Self];

    /// What `word` means, if it is one of [`Choice::WORDS`].
    fn from_word(word: &str) -> Option<Self> {
        Self::WORDS
            .iter()
            .position(|w| *w == word)
            .map(|i| Self::MEANINGS[i])
    }

    /// The word for this choice.
    fn word(self) -> &'static str {
        Self::MEANINGS
            .iter()
            .position(|m| *m == self)
            .map_or("", |i| Self::WORDS[i])
    }
}

struct ChoiceVisitor<T>(PhantomData<T>);

impl<T: Choice> Visitor<'_> for ChoiceVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, word) in T::WORDS.iter().enumerate() {
            write!(f, "{}\"{word}\"", if i == 0 { "" } else { " or " })?;
        }
        Ok(())
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<T, E> {
        T::from_word(word).ok_or_else(|| E::unknown_variant(word, T::WORDS))
    }
}

impl<T: Choice> Value for T {
    fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_str(ChoiceVisitor(PhantomData))
    }

    fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}
