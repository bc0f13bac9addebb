//! Placeholders in the name of a picture, as in `-o "{scene}_{method}.png"`.

use super::CliError;
use fastphong::scene::file::STANDARD_INPUT;
use fastphong::scene::input::has_ending;
use std::path::{Path, PathBuf};

/// The placeholders that a name may contain.
pub const PLACEHOLDERS: [&str; 5] = ["scene", "method", "engine", "width", "height"];

/// Returns `path` with each `{placeholder}` replaced by its value. `values` are in the order of
/// [`PLACEHOLDERS`]. Characters that are awkward in a file name become `-`.
///
/// # Errors
/// If a placeholder is unknown.
pub fn named(path: &Path, values: [&str; PLACEHOLDERS.len()]) -> Result<PathBuf, CliError> {
    // A path that is not UTF-8 contains no placeholders.
    let Some(text) = path.to_str() else {
        return Ok(path.to_owned());
    };
    let mut parts = text.split('{');
    let mut name = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let Some((placeholder, rest)) = part.split_once('}') else {
            name = name + "{" + part;
            continue;
        };
        let place = PLACEHOLDERS.iter().position(|known| *known == placeholder);
        let Some(place) = place else {
            let known = PLACEHOLDERS.map(|known| format!("{{{known}}}")).join(", ");
            let problem = format!("`--output` names `{{{placeholder}}}`, which is no placeholder");
            return Err(format!("{problem}: expected one of {known}").into());
        };
        name += &values[place].replace(|c: char| !c.is_alphanumeric() && !"-_.".contains(c), "-");
        name += rest;
    }
    Ok(name.into())
}

/// Returns the name of the scene for `input`: a file name without its ending (nor `.gz` before
/// that), `stdin` for standard input, any other input unchanged.
pub fn scene_name(input: &str) -> &str {
    if input == STANDARD_INPUT {
        return "stdin";
    }
    if input.starts_with("builtin:") {
        return input;
    }
    let stem = |name| Path::new(name).file_stem().and_then(|stem| stem.to_str());
    match (stem(input), has_ending(Path::new(input), "gz")) {
        (Some(packed), true) => stem(packed).unwrap_or(packed),
        (name, _) => name.unwrap_or(input),
    }
}
