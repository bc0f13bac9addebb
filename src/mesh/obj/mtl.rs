//! Materials: MTL files made fit for their parser, and turned into [`Material`].
//!
//! The parser (`tobj`) panics on the legal `Kd 0.5`, loses all materials at `Kd spectral …`, `illum 2.0` or a `map_Kd` without a
//! name, takes a comment into a name and lets NaN through. So it is given only what Phong illumination uses, each line checked.

use super::error::quote;
use super::lines::{Statements, decode, keyword, name_candidates, without_comment};
use super::parser::guarded;
use crate::mesh::Material;
use crate::picture::Rgb;
use std::collections::HashMap;
use std::string::{String, ToString};
use std::vec::Vec;
use std::{format, io};

/// So many warnings of one file are shown one by one.
const WARNINGS_SHOWN: usize = 8;

// The MTL format's defaults: Ka and Kd as in J. Burkardt's description of the format
// (people.sc.fsu.edu/~jburkardt/data/mtl/mtl.html).
const AMBIENT: Rgb = [0.2; 3];
const DIFFUSE: Rgb = [0.8; 3];
// Not its Ks = 1 and Ns = 0, which light half the surface white: no highlight unless the file asks for one.
const SPECULAR: Rgb = [0.0; 3];

/// The materials of all libraries of one OBJ file, by name.
#[derive(Default)]
pub(super) struct Library {
    materials: HashMap<String, Material>,
    /// The materials by their names up to a comment, for `newmtl red # the lid`.
    uncommented: HashMap<String, Material>,
    /// The files asked for: added, or not to be had, with the error until it is told.
    tried: HashMap<String, Result<(), Option<io::Error>>>,
    /// True if every file could be had.
    pub is_complete: bool,
}

impl Library {
    /// Reads the files that each of `lines`, the number and the rest of an `mtllib` line, names.
    pub(super) fn load(
        lines: &[(usize, String)],
        load_mtl: &mut impl FnMut(&str) -> io::Result<Vec<u8>>,
        warnings: &mut Vec<String>,
    ) -> Library {
        let mut library = Library {
            is_complete: true,
            ..Library::default()
        };
        for (line, rest) in lines {
            let mut one_file = name_candidates(rest);
            if one_file.any(|name| library.try_file(name, load_mtl, warnings).is_ok()) {
                continue;
            }
            for name in file_names(without_comment(rest)) {
                let Err(untold) = library.try_file(&name, load_mtl, warnings) else {
                    continue;
                };
                if let Some(error) = untold.take() {
                    let name = quote(&name);
                    warnings.push(format!(
                        "material library `{name}` (line {line}) cannot be read: {error}"
                    ));
                }
                library.is_complete = false;
            }
        }
        library
    }

    /// Adds the materials of the file `name`, unless it was asked for before.
    fn try_file(
        &mut self,
        name: &str,
        load_mtl: &mut impl FnMut(&str) -> io::Result<Vec<u8>>,
        warnings: &mut Vec<String>,
    ) -> &mut Result<(), Option<io::Error>> {
        if !self.tried.contains_key(name) {
            let bytes = load_mtl(name).map_err(Some);
            let added = bytes.map(|bytes| self.add(name, &bytes, warnings));
            self.tried.insert(name.to_string(), added);
        }
        self.tried.get_mut(name).expect("it was just tried")
    }

    /// Adds the materials of the MTL file `bytes`; warnings begin with its `name`.
    fn add(&mut self, name: &str, bytes: &[u8], warnings: &mut Vec<String>) {
        let mut found = Vec::new();
        let text = sanitise(name, &decode(bytes), &mut found);
        let more = found.len().saturating_sub(WARNINGS_SHOWN);
        found.truncate(WARNINGS_SHOWN);
        warnings.append(&mut found);
        if more > 0 {
            warnings.push(format!("{name}: {more} more lines are ignored"));
        }
        match guarded(|| tobj::load_mtl_buf(&mut text.as_bytes())) {
            Ok((materials, _)) => materials
                .iter()
                .for_each(|parsed| self.insert(&parsed.name, material(parsed))),
            Err(why) => warnings.push(format!(
                "{name}: the MTL parser gave up ({why}): its materials are not used"
            )),
        }
    }

    /// Adds a material, unless one has its name: the format lets the first win where two libraries define it.
    fn insert(&mut self, name: &str, material: Material) {
        self.materials.entry(name.to_string()).or_insert(material);
        if let Some(short) = name_candidates(name).nth(1) {
            self.uncommented
                .entry(short.to_string())
                .or_insert(material);
        }
    }

    /// Returns the material that `usemtl` names with `rest`.
    pub(super) fn find(&self, rest: &str) -> Option<Material> {
        let find = |name| self.materials.get(name).or(self.uncommented.get(name));
        name_candidates(rest).find_map(find).copied()
    }
}

/// Returns the file names in an `mtllib` line that is not one file name: each ends with `.mtl`, as names may hold spaces.
fn file_names(rest: &str) -> Vec<String> {
    let words: Vec<&str> = rest.split_whitespace().collect();
    let is_last = |word: &&str| {
        let word = word.trim_end_matches('"').to_ascii_lowercase();
        word.ends_with(".mtl")
    };
    let name = |words: &[&str]| words.join(" ").trim_matches('"').to_string();
    words.split_inclusive(is_last).map(name).collect()
}

/// Returns the material that the parser read; channels and exponents that it did not find have their defaults.
fn material(parsed: &tobj::Material) -> Material {
    // Illumination models 0 (constant) and 1 (diffuse) have no highlight.
    let matte = matches!(parsed.illumination_model, Some(0 | 1));
    let specular = parsed.specular.filter(|_| !matte);
    let shininess = parsed.shininess.map(|n| n as f32);
    let colour = |parsed: Option<[f64; 3]>, default| {
        parsed.map_or(default, |channels| channels.map(|channel| channel as f32))
    };
    Material {
        ambient: colour(parsed.ambient, AMBIENT),
        diffuse: colour(parsed.diffuse, DIFFUSE),
        specular: colour(specular, SPECULAR),
        shininess: shininess.unwrap_or(Material::default().shininess),
    }
}

/// Returns the lines of `text` that the parser needs, as it can take them.
fn sanitise(file: &str, text: &str, warnings: &mut Vec<String>) -> String {
    let mut clean = String::new();
    let mut named = false;
    for (line, statement) in Statements::new(text) {
        let (word, rest) = keyword(&statement);
        let values = without_comment(rest).trim();
        let accepted = match word {
            "newmtl" => {
                named = !rest.is_empty();
                let name = named.then(|| rest.to_string());
                name.ok_or("expected a name")
            }
            "Ka" | "Kd" | "Ks" => colour(values),
            "Ns" => number(values)
                .map(|n| n.to_string())
                .ok_or("expected one finite number, 0 or more"),
            "illum" => match values.parse::<u8>() {
                Ok(model) => Ok(model.to_string()),
                Err(_) => Err("expected the number of an illumination model, 0 to 10"),
            },
            _ => continue,
        };
        match accepted {
            Ok(_) if !named => warnings.push(format!(
                "{file}:{line}: `{word}` before any `newmtl` is ignored"
            )),
            Ok(value) => clean += &format!("{word} {value}\n"),
            Err(expected) => {
                let what = quote(&format!("{word} {values}"));
                warnings.push(format!("{file}:{line}: `{what}` is ignored: {expected}"));
            }
        }
    }
    clean
}

/// Returns three channels as text, read from three numbers or from one for all of them.
fn colour(values: &str) -> Result<String, &'static str> {
    if values.starts_with("spectral") || values.starts_with("xyz") {
        return Err("expected red, green and blue, other colour models are not read");
    }
    let numbers: Option<Vec<f32>> = values.split_ascii_whitespace().map(number).collect();
    match numbers.as_deref() {
        Some([grey]) => Ok(format!("{grey} {grey} {grey}")),
        Some([red, green, blue]) => Ok(format!("{red} {green} {blue}")),
        _ => Err("expected one or three finite numbers, 0 or more"),
    }
}

/// Reads a finite number that is 0 or more.
fn number(word: &str) -> Option<f32> {
    let number = word.parse().ok();
    number.filter(|n: &f32| n.is_finite() && *n >= 0.0)
}
