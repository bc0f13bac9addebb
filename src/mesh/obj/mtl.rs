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
use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

/// So many warnings of one file are shown one by one.
const WARNINGS_SHOWN: usize = 8;

// What the MTL format gives a material that does not say: Ka and Kd as in J. Burkardt's description of the format
// (people.sc.fsu.edu/~jburkardt/data/mtl/mtl.html).
const AMBIENT: Rgb = [0.2; 3];
const DIFFUSE: Rgb = [0.8; 3];
// Not its Ks = 1 and Ns = 0, which light half the surface white: no highlight unless the file asks for one.
const SPECULAR: Rgb = [0.0; 3];

/// The materials of all libraries of one OBJ file, by name.
#[derive(Default)]
pub(super) struct Library {
    materials: HashMap<String, Material>,
    /// The same by their names up to a comment, for `newmtl red # the lid`.
    uncommented: HashMap<String, Material>,
}

impl Library {
    /// Adds the materials of the MTL file `bytes`; warnings begin with its `name`.
    pub(super) fn add(&mut self, name: &str, bytes: &[u8], warnings: &mut Vec<String>) {
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

    /// Of two materials with one name the first wins: the format asks for it where they are in two libraries.
    fn insert(&mut self, name: &str, material: Material) {
        self.materials.entry(name.to_string()).or_insert(material);
        if let Some(short) = name_candidates(name).nth(1) {
            self.uncommented
                .entry(short.to_string())
                .or_insert(material);
        }
    }

    /// The material that `usemtl` names with `rest`.
    pub(super) fn find(&self, rest: &str) -> Option<Material> {
        name_candidates(rest)
            .find_map(|name| {
                self.materials
                    .get(name)
                    .or_else(|| self.uncommented.get(name))
            })
            .copied()
    }
}

fn material(parsed: &tobj::Material) -> Material {
    // Illumination models 0 (constant) and 1 (diffuse) have no highlight.
    let matte = matches!(parsed.illumination_model, Some(0 | 1));
    Material {
        ambient: parsed.ambient.unwrap_or(AMBIENT),
        diffuse: parsed.diffuse.unwrap_or(DIFFUSE),
        specular: if matte {
            SPECULAR
        } else {
            parsed.specular.unwrap_or(SPECULAR)
        },
        shininess: parsed.shininess.unwrap_or(Material::default().shininess),
    }
}

/// The lines of `text` that the parser needs, as it can take them.
fn sanitise(file: &str, text: &str, warnings: &mut Vec<String>) -> String {
    let mut clean = String::new();
    let mut named = false;
    for (line, statement) in Statements::new(text) {
        let (word, rest) = keyword(&statement);
        let values = without_comment(rest).trim();
        let accepted = match word {
            "newmtl" => {
                named = !rest.is_empty();
                if named {
                    Ok(rest.to_string())
                } else {
                    Err("expected a name")
                }
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
            Ok(value) => {
                clean.push_str(word);
                clean.push(' ');
                clean.push_str(&value);
                clean.push('\n');
            }
            Err(expected) => {
                let what = quote(&format!("{word} {values}"));
                warnings.push(format!("{file}:{line}: `{what}` is ignored: {expected}"));
            }
        }
    }
    clean
}

/// Three numbers, or one for all three channels.
fn colour(values: &str) -> Result<String, &'static str> {
    let expected = "expected one or three finite numbers, 0 or more";
    let mut channels = Vec::new();
    for word in values.split_ascii_whitespace() {
        match word {
            "spectral" | "xyz" if channels.is_empty() => {
                return Err("expected red, green and blue, other colour models are not read");
            }
            _ => channels.push(number(word).ok_or(expected)?),
        }
    }
    match channels[..] {
        [grey] => Ok(format!("{grey} {grey} {grey}")),
        [red, green, blue] => Ok(format!("{red} {green} {blue}")),
        _ => Err(expected),
    }
}

fn number(word: &str) -> Option<f32> {
    word.parse::<f32>()
        .ok()
        .filter(|n| n.is_finite() && *n >= 0.0)
}
