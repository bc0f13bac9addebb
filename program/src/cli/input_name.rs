//! Names of inputs. A path may hold any bytes, but names in scenes are text. So a path that is not
//! UTF-8 gets a stand-in: a name in which each invalid byte is written as `\xE9`. Messages show the
//! stand-in; files are opened by the path behind it.

use clap::builder::{OsStringValueParser, TypedValueParser};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The stand-ins of this command line, and the paths behind them.
static STAND_INS: Mutex<Vec<(PathBuf, PathBuf)>> = Mutex::new(Vec::new());

fn stand_ins() -> MutexGuard<'static, Vec<(PathBuf, PathBuf)>> {
    STAND_INS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns the clap parser for an input.
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
    // The files that a scene names are in its folder, whose name is not UTF-8 either.
    if let (Some(folder), Some(behind)) = (path.parent(), behind.parent()) {
        stand_ins().push((folder.into(), behind.into()));
    }
    stand_in
}

/// Writes each byte that is not UTF-8 as `\xE9`.
pub fn escaped(path: &OsStr) -> String {
    let chunks = path.as_encoded_bytes().utf8_chunks();
    let escape = |byte: &u8| format!("\\x{byte:02X}");
    let text = chunks.map(|chunk| {
        let rest: String = chunk.invalid().iter().map(escape).collect();
        chunk.valid().to_owned() + &rest
    });
    text.collect()
}

/// Writes each control character as `\x1B`, so that a file name cannot control the terminal.
pub fn printable(text: &str) -> String {
    let letter = |letter: char| {
        if letter.is_control() {
            format!("\\x{:02X}", letter as u32)
        } else {
            letter.to_string()
        }
    };
    text.chars().map(letter).collect()
}

/// True if a name is a stand-in, or lies in the folder of one.
pub fn is_stand_in(name: &str) -> bool {
    path_behind(Path::new(name)) != Path::new(name)
}

/// Returns the path behind a name that is a stand-in or lies in the folder of one, and any other
/// name unchanged.
pub fn path_behind(name: &Path) -> PathBuf {
    let known = stand_ins();
    let found = known.iter().find_map(|(stand_in, behind)| {
        // The parent of a bare file name is the empty path. Every path begins with it, so it must
        // not match here.
        let is_some = !stand_in.as_os_str().is_empty();
        let rest = name.strip_prefix(stand_in).ok().filter(|_| is_some)?;
        Some(if rest.as_os_str().is_empty() {
            behind.clone()
        } else {
            behind.join(rest)
        })
    });
    found.unwrap_or_else(|| name.to_owned())
}
