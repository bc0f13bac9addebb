//! Names of inputs. A path may be of any bytes, the names in scenes are text: a path that is no text has a stand-in, in which the
//! bytes that are none are written as `\xE9`. Messages show it, and files are opened by the path behind it.

use clap::builder::{OsStringValueParser, TypedValueParser};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The stand-ins of this command line, and the paths behind them.
static STAND_INS: Mutex<Vec<(PathBuf, PathBuf)>> = Mutex::new(Vec::new());

fn stand_ins() -> MutexGuard<'static, Vec<(PathBuf, PathBuf)>> {
    STAND_INS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns what reads an input from the command line.
pub fn parser() -> impl TypedValueParser<Value = String> {
    OsStringValueParser::new().map(|input: OsString| name(&input))
}

/// Returns the name of an input: itself, or its stand-in.
fn name(input: &OsStr) -> String {
    if let Some(text) = input.to_str() {
        return text.to_owned();
    }
    let stand_in = escaped(input);
    let (path, behind) = (Path::new(&stand_in), Path::new(input));
    stand_ins().push((path.into(), behind.into()));
    // Files that a scene names stand in its folder.
    if let (Some(folder), Some(behind)) = (path.parent(), behind.parent()) {
        stand_ins().push((folder.into(), behind.into()));
    }
    stand_in
}

/// Writes bytes that are no text as `\xE9`.
pub fn escaped(path: &OsStr) -> String {
    let chunks = path.as_encoded_bytes().utf8_chunks();
    let escape = |byte: &u8| format!("\\x{byte:02X}");
    let text = chunks.map(|chunk| {
        let rest: String = chunk.invalid().iter().map(escape).collect();
        chunk.valid().to_owned() + &rest
    });
    text.collect()
}

/// Writes control characters as `\x1B`, so that no name of a file commands the terminal.
pub fn printable(text: &str) -> String {
    let letter = |letter: char| match letter.is_control() {
        true => format!("\\x{:02X}", letter as u32),
        false => letter.to_string(),
    };
    text.chars().map(letter).collect()
}

/// True if a name is a stand-in, or is in the folder of one.
pub fn is_stand_in(name: &str) -> bool {
    path_behind(Path::new(name)) != Path::new(name)
}

/// Returns the path behind a name: that of a stand-in, or of what is in the folder of one; else the name itself.
pub fn path_behind(name: &Path) -> PathBuf {
    let known = stand_ins();
    let found = known.iter().find_map(|(stand_in, behind)| {
        // The folder of a plain name is empty, and holds everything: its files have the names that they have.
        let is_some = !stand_in.as_os_str().is_empty();
        let rest = name.strip_prefix(stand_in).ok().filter(|_| is_some)?;
        Some(match rest.as_os_str().is_empty() {
            true => behind.clone(),
            false => behind.join(rest),
        })
    });
    found.unwrap_or_else(|| name.to_owned())
}
