//! Pairs the pictures of two folders by name, including sub-folders.

use super::super::{CliError, files};
use std::cmp::Ordering;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The reference and the picture with the same name.
#[derive(Debug)]
pub struct Named {
    /// The path within the folders, with `/` between its parts on every system: see [`written`].
    pub name: String,
    pub reference: Option<PathBuf>,
    pub actual: Option<PathBuf>,
    /// The path of the reference, whether or not it exists.
    pub place: PathBuf,
}

/// The pictures of two folders.
#[derive(Debug)]
pub struct Pairing {
    /// All pairs, sorted by name.
    pub pairs: Vec<Named>,
    /// How many files are left out because their endings are not those of pictures.
    pub others: usize,
}

impl Pairing {
    /// Lists the pictures of two folders and their sub-folders.
    ///
    /// # Errors
    /// If the folders are the same, one lies in the other, one cannot be read, or neither has a
    /// picture.
    pub fn of(reference: &Path, actual: &Path) -> Result<Pairing, CliError> {
        check_apart(reference, actual)?;
        let [of_reference, of_actual] = [reference, actual].map(files::pictures_in);
        let (of_reference, of_actual) = (of_reference?, of_actual?);
        let others = of_reference.others + of_actual.others;
        let pairs = merged(reference, actual, of_reference.names, of_actual.names);
        if pairs.is_empty() {
            let (one, two) = (reference.display(), actual.display());
            let expected =
                "expected files that end in .png, .ppm, .pfm or another ending of docs/pictures.md";
            return Err(format!("no pictures in {one} and {two}: {expected}").into());
        }
        Ok(Pairing { pairs, others })
    }
}

/// Refuses the same folder twice, and a folder within the other.
fn check_apart(reference: &Path, actual: &Path) -> Result<(), CliError> {
    let place = |path: &Path| {
        let refused = |error| format!("{}: cannot be read: {error}", path.display());
        path.canonicalize().map_err(refused)
    };
    let (one, two) = (place(reference)?, place(actual)?);
    let (reference, actual) = (reference.display(), actual.display());
    if one == two {
        return Err(format!("{reference} and {actual} are one folder: expected two").into());
    }
    let within = match (one.starts_with(&two), two.starts_with(&one)) {
        (true, _) => format!("{reference} lies in {actual}"),
        (_, true) => format!("{actual} lies in {reference}"),
        _ => return Ok(()),
    };
    Err(format!("{within}: expected two folders, none within the other").into())
}

/// Writes a name in text that a terminal and XML can hold. Bytes of control characters, of `\`, and
/// those that are not UTF-8 become `\xE9`, so that different names stay different.
fn written(name: &OsStr) -> String {
    let is_plain = |c: &char| !c.is_control() && !['\\', '\u{fffe}', '\u{ffff}'].contains(c);
    let escape = |byte: &u8| format!("\\x{byte:02X}");
    let mut text = String::new();
    for chunk in name.as_encoded_bytes().utf8_chunks() {
        for letter in chunk.valid().chars() {
            if is_plain(&letter) {
                text.push(letter);
            } else {
                let bytes = letter.encode_utf8(&mut [0; 4]).as_bytes().to_vec();
                text.extend(bytes.iter().map(escape));
            }
        }
        text.extend(chunk.invalid().iter().map(escape));
    }
    text
}

/// Merges two sorted lists of names into pairs.
fn merged(
    reference: &Path,
    actual: &Path,
    of_reference: Vec<PathBuf>,
    of_actual: Vec<PathBuf>,
) -> Vec<Named> {
    let mut pairs = Vec::new();
    let mut add = |name: &Path, is_reference: bool, is_actual: bool| {
        let place = reference.join(name);
        let parts = name.iter().map(written);
        pairs.push(Named {
            name: parts.collect::<Vec<_>>().join("/"),
            reference: is_reference.then(|| place.clone()),
            actual: is_actual.then(|| actual.join(name)),
            place,
        });
    };
    let (mut ones, mut twos) = (of_reference.iter().peekable(), of_actual.iter().peekable());
    loop {
        let order = match (ones.peek(), twos.peek()) {
            (None, None) => return pairs,
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (Some(one), Some(two)) => one.cmp(two),
        };
        let one = if order.is_le() { ones.next() } else { None };
        let two = if order.is_ge() { twos.next() } else { None };
        if let Some(name) = one.or(two) {
            add(name, one.is_some(), two.is_some());
        }
    }
}
