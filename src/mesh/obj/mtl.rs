//! Materials: the statements of MTL files that Phong illumination uses, turned into [`Material`].

use super::error::quote;
use super::lines::{Statements, decode, keyword, name_candidates, without_comment};
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
    /// These materials by their names up to a comment, for `newmtl red # the lid`.
    uncommented: HashMap<String, Material>,
}

impl Library {
    /// Adds the materials of the MTL file `bytes`; warnings begin with its `name`.
    pub(super) fn add(&mut self, name: &str, bytes: &[u8], warnings: &mut Vec<String>) {
        let mut found = self.read(name, &decode(bytes));
        let more = found.len().saturating_sub(WARNINGS_SHOWN);
        found.truncate(WARNINGS_SHOWN);
        warnings.append(&mut found);
        if more > 0 {
            warnings.push(format!("{name}: {more} more lines are ignored"));
        }
    }

    /// Reads the statements that Phong illumination uses. Returns a warning for each line that is ignored.
    fn read(&mut self, file: &str, text: &str) -> Vec<String> {
        let mut warnings = Vec::new();
        let mut current: Option<Draft> = None;
        for (line, statement) in Statements::new(text) {
            let (word, rest) = keyword(&statement);
            let values = without_comment(rest).trim();
            let mut nameless = Draft::new("");
            let draft = current.as_mut().unwrap_or(&mut nameless);
            let material = &mut draft.material;
            let read = match word {
                "newmtl" => {
                    self.insert(current.take());
                    current = (!rest.is_empty()).then(|| Draft::new(rest));
                    match current {
                        Some(_) => continue,
                        None => Err("expected a name"),
                    }
                }
                "Ka" => colour(values).map(|colour| material.ambient = colour),
                "Kd" => colour(values).map(|colour| material.diffuse = colour),
                "Ks" => colour(values).map(|colour| material.specular = colour),
                "Ns" => number(values)
                    .map(|exponent| material.shininess = exponent)
                    .ok_or("expected one finite number, 0 or more"),
                // Models 0 (constant) and 1 (diffuse) have no highlight.
                "illum" => (values.parse().map(|model: u8| draft.is_matte = model < 2))
                    .map_err(|_| "expected the number of an illumination model, 0 to 10"),
                _ => continue,
            };
            match read {
                Ok(()) if current.is_none() => warnings.push(format!(
                    "{file}:{line}: `{word}` before any `newmtl` is ignored"
                )),
                Ok(()) => {}
                Err(expected) => {
                    let what = quote(&format!("{word} {values}"));
                    warnings.push(format!("{file}:{line}: `{what}` is ignored: {expected}"));
                }
            }
        }
        self.insert(current);
        warnings
    }

    /// Adds a material. Of two with one name the first wins: the format asks for it where they are in two libraries.
    fn insert(&mut self, draft: Option<Draft>) {
        let Some(Draft {
            name,
            mut material,
            is_matte,
        }) = draft
        else {
            return;
        };
        if is_matte {
            material.specular = SPECULAR;
        }
        if let Some(short) = name_candidates(&name).nth(1) {
            let short = short.to_string();
            self.uncommented.entry(short).or_insert(material);
        }
        self.materials.entry(name).or_insert(material);
    }

    /// Returns the material that `usemtl` names with `rest`.
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

/// A material that is being read.
struct Draft {
    name: String,
    material: Material,
    is_matte: bool,
}

impl Draft {
    /// Begins a material.
    fn new(name: &str) -> Draft {
        Draft {
            name: name.to_string(),
            material: Material {
                ambient: AMBIENT,
                diffuse: DIFFUSE,
                specular: SPECULAR,
                ..Material::default()
            },
            is_matte: false,
        }
    }
}

/// Reads three numbers, or one for all three channels.
fn colour(values: &str) -> Result<Rgb, &'static str> {
    if values.starts_with("spectral") || values.starts_with("xyz") {
        return Err("expected red, green and blue, other colour models are not read");
    }
    let channels: Option<Vec<f32>> = values.split_ascii_whitespace().map(number).collect();
    match channels.as_deref() {
        Some(&[grey]) => Ok([grey; 3]),
        Some(&[red, green, blue]) => Ok([red, green, blue]),
        _ => Err("expected one or three finite numbers, 0 or more"),
    }
}

fn number(word: &str) -> Option<f32> {
    word.parse::<f32>()
        .ok()
        .filter(|n| n.is_finite() && *n >= 0.0)
}
