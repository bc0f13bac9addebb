//! MTL files. They become [`Material`]s and notes about features that are not drawn.

use super::super::content::foreign;
use super::super::gzip::unpacked;
use super::error::quote;
use super::lines::{Statements, decode, keyword, name_candidates, without_comment};
use crate::mesh::Material;
use crate::note::{Note, Notes};
use crate::picture::Rgb;
use std::collections::HashMap;
use std::string::{String, ToString};
use std::vec::Vec;
use std::{format, io, mem, vec};

/// The most ignored lines of one file that are shown one by one.
const IGNORED_SHOWN: usize = 8;

/// A statement in one of the libraries.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    /// The index of the library, in the order in which libraries were read.
    file: usize,
    line: usize,
    /// The statement without its comment.
    statement: String,
}

/// A statement that is ignored, or drawn in another way than its author may have meant. It becomes
/// a note if its material is used.
#[derive(Clone, Debug)]
struct Remark {
    place: Place,
    /// The kind of the note.
    kind: &'static str,
    /// Follows the statement in the note.
    why: &'static str,
}

/// The kind of the notes about ignored statements. Each has its own note; of the other kinds all
/// statements share one.
const IGNORED: &str = "material/ignored";

/// A value and the statement that sets it.
#[derive(Clone, Debug)]
struct Stated {
    value: f32,
    place: Place,
}

/// The statements of one `newmtl`.
#[derive(Clone, Debug, Default)]
struct Definition {
    ambient: Option<Rgb>,
    diffuse: Option<Rgb>,
    specular: Option<Rgb>,
    shininess: Option<f32>,
    illumination: Option<u8>,
    /// `d`: 1 is opaque.
    dissolve: Option<Stated>,
    /// `Tr`: 0 is opaque, as most programs write it.
    transparency: Option<Stated>,
    /// The least channel of `Tf`: 1 is opaque, as Maya writes it.
    filter: Option<Stated>,
    diffuse_map: Option<Place>,
    remarks: Vec<Remark>,
    is_used: bool,
}

/// The materials of all libraries of one OBJ file, by name.
#[derive(Default)]
pub(super) struct Library {
    definitions: Vec<Definition>,
    /// The index of each definition, by its name.
    names: HashMap<String, usize>,
    /// The index of each definition, by its name up to a comment, as in `newmtl red # the lid`.
    uncommented: HashMap<String, usize>,
    /// Repeated definitions in the current file: the first definition of the name, the repeated
    /// one, and its place.
    second: Vec<(usize, usize, Place)>,
    /// The names of the files that were read.
    files: Vec<String>,
    /// Statements outside of any definition.
    remarks: Vec<Remark>,
    /// The result for each file that was tried. An error is taken out when it is reported.
    tried: HashMap<String, Result<(), Option<io::Error>>>,
    /// True if every file could be read and defines materials.
    pub is_complete: bool,
}

impl Library {
    /// Reads the files of all `mtllib` lines. Each line comes with its line number and without its
    /// keyword.
    pub(super) fn load(
        lines: &[(usize, String)],
        load_mtl: &mut impl FnMut(&str) -> io::Result<Vec<u8>>,
        notes: &mut Notes,
    ) -> Library {
        let mut library = Library {
            is_complete: true,
            ..Library::default()
        };
        for (line, rest) in lines {
            let uncommented = name_candidates(rest).last().unwrap_or_default();
            let names = file_names(uncommented);
            // Several paths must not be tried as one name: only the bare name of the last path
            // would then be looked for.
            let may_be_one = names.len() < 2 || !uncommented.contains(['/', '\\']);
            let mut one_file = name_candidates(rest).filter(|_| may_be_one);
            if one_file.any(|name| library.try_file(name, *line, load_mtl, notes)) {
                continue;
            }
            for name in names {
                if !library.try_file(&name, *line, load_mtl, notes) {
                    library.note_missing(&name, *line, notes);
                }
            }
        }
        library
    }

    /// Adds the materials of the file `name`, which line `line` names, unless it was tried before.
    /// Returns true if it could be read.
    fn try_file(
        &mut self,
        name: &str,
        line: usize,
        load_mtl: &mut impl FnMut(&str) -> io::Result<Vec<u8>>,
        notes: &mut Notes,
    ) -> bool {
        let file = file_of(name);
        if let Some(known) = self.tried.get(&file) {
            return known.is_ok();
        }
        let read = load_mtl(name);
        if let Ok(bytes) = &read
            && let Err(problem) = self.add(name, bytes)
        {
            self.is_complete = false;
            let (name, expected) = (quote(name), "expected MTL text with `newmtl` lines");
            let text = format!("material library `{name}` (line {line}) {problem}: {expected}");
            notes.push(Note::warning("material/library", text));
        }
        let is_there = read.is_ok();
        let tried = read.map(|_| ()).map_err(Some);
        self.tried.insert(file, tried);
        is_there
    }

    /// Reports, once per file, that the file `name`, which line `line` names, could not be read.
    fn note_missing(&mut self, name: &str, line: usize, notes: &mut Notes) {
        self.is_complete = false;
        if let Some(Err(unreported)) = self.tried.get_mut(&file_of(name))
            && let Some(error) = unreported.take()
        {
            let name = quote(name);
            let text = format!("material library `{name}` (line {line}) cannot be read: {error}");
            notes.push(Note::warning("material/library", text));
        }
    }

    /// Adds the materials of the MTL file `bytes`.
    ///
    /// # Errors
    /// The reason, in words, if it has no materials.
    fn add(&mut self, name: &str, bytes: &[u8]) -> Result<(), String> {
        let bytes = unpacked(bytes).map_err(|error| format!("cannot be read ({error})"))?;
        let bytes = &*bytes;
        if let Some(what) = foreign(bytes) {
            return Err(format!("is {what}"));
        }
        let text = decode(bytes);
        let has_nul = bytes.contains(&b'\0');
        if text.trim().is_empty() && !has_nul {
            return Err("is empty".to_string());
        }
        let (file, before) = (self.files.len(), self.definitions.len());
        let mut ignored = Vec::new();
        self.files.push(name.to_string());
        // True inside a definition.
        let mut is_open = false;
        for (line, statement) in Statements::new(&text) {
            let (word, rest) = keyword(&statement);
            if word.is_empty() || word.starts_with('#') {
                continue;
            }
            let values = without_comment(rest).trim_ascii();
            let place = Place {
                file,
                line,
                statement: quote(format!("{word} {values}").trim_ascii_end()),
            };
            match &*word.to_ascii_lowercase() {
                // The name may be empty, as in `usemtl`.
                "newmtl" => {
                    is_open = true;
                    self.define(rest, place);
                }
                word if is_open => {
                    let definition = self.definitions.last_mut().expect("a definition is open");
                    definition.read(word, values, place);
                }
                _ => ignored.push(Remark {
                    place,
                    kind: IGNORED,
                    why: "before any `newmtl` is ignored",
                }),
            }
        }
        if self.definitions.len() == before {
            let why = if has_nul {
                "holds binary data"
            } else {
                "has no `newmtl` line"
            };
            return Err(why.to_string());
        }
        self.definitions[before..]
            .iter_mut()
            .for_each(Definition::finish);
        for (first, second, place) in self.second.drain(..) {
            let [one, other] = [first, second].map(|index| self.definitions[index].material());
            if one != other {
                let why = "a name that is defined already: the first definition is used";
                self.definitions[first].remark("material/second-definition", why, &place);
            }
        }
        self.remarks.append(&mut ignored);
        Ok(())
    }

    /// Begins a definition. If a name is defined twice, the first definition counts, as the format
    /// says.
    fn define(&mut self, name: &str, place: Place) {
        let index = self.definitions.len();
        self.definitions.push(Definition::default());
        if let Some(&first) = self.names.get(name) {
            self.second.push((first, index, place));
            return;
        }
        self.names.insert(name.to_string(), index);
        if let Some(short) = name_candidates(name).nth(1) {
            self.uncommented.entry(short.to_string()).or_insert(index);
        }
    }

    /// Returns the material for a `usemtl` statement with the arguments `rest`, and marks it as
    /// used for [`Library::notes`].
    pub(super) fn use_material(&mut self, rest: &str) -> Option<Material> {
        let find = |name| self.names.get(name).or(self.uncommented.get(name));
        let index = *name_candidates(rest).find_map(find)?;
        self.definitions[index].is_used = true;
        Some(self.definitions[index].material())
    }

    /// Returns a note for each kind of feature of used materials that is not drawn, with the first
    /// statement of the kind, and one for each statement that is ignored.
    pub(super) fn notes(&mut self) -> Notes {
        let mut remarks = mem::take(&mut self.remarks);
        for used in self.definitions.iter_mut().filter(|found| found.is_used) {
            remarks.append(&mut used.remarks);
        }
        remarks.sort_by(|one, other| one.place.cmp(&other.place));
        let mut notes = Notes::default();
        let mut ignored = vec![0; self.files.len()];
        for Remark { place, kind, why } in remarks {
            let note = |separator| {
                let at = format!("{}:{}", self.files[place.file], place.line);
                let text = format!("`{}`{separator} {why}", place.statement);
                Note::warning(kind, text).about(&at)
            };
            if kind != IGNORED {
                notes.count(kind, 0, || note(":"));
                continue;
            }
            ignored[place.file] += 1;
            if ignored[place.file] <= IGNORED_SHOWN {
                notes.push(note(""));
            }
        }
        for (file, count) in self.files.iter().zip(ignored) {
            if count > IGNORED_SHOWN {
                let text = format!("{} more lines are ignored", count - IGNORED_SHOWN);
                notes.push(Note::warning(IGNORED, text).about(file));
            }
        }
        notes
    }
}

/// Returns the path `name` without detours, so that `./lib.mtl` and `lib.mtl` count as one file.
fn file_of(name: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for (i, part) in name.split(['/', '\\']).enumerate() {
        match part {
            "." => {}
            // An empty part at the start is the root and stays.
            "" if i > 0 => {}
            ".." if parts.last().is_some_and(|last| !matches!(*last, "" | "..")) => {
                parts.pop();
            }
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// Splits an `mtllib` line into several file names. Each ends with `.mtl`, because names may
/// contain spaces.
fn file_names(rest: &str) -> Vec<String> {
    let words: Vec<&str> = rest.split_ascii_whitespace().collect();
    let is_last = |word: &&str| {
        let word = word.trim_end_matches('"').to_ascii_lowercase();
        word.ends_with(".mtl")
    };
    let name = |words: &[&str]| words.join(" ").trim_matches('"').to_string();
    words.split_inclusive(is_last).map(name).collect()
}

impl Definition {
    /// Reads a statement. `word` is its keyword in lower case, and `values` are its arguments
    /// without a comment.
    fn read(&mut self, word: &str, values: &str, place: Place) {
        const NUMBER: &str = "is ignored: expected one finite number, 0 or more";
        let read = match word {
            "ka" | "kd" | "ks" => self.read_colour(word, values, &place),
            "ns" => number(values)
                .map(|n| self.shininess = Some(n))
                .ok_or(NUMBER),
            "illum" => self.read_illumination(values, &place),
            "d" => last_number(values)
                .map(|value| self.dissolve = Some(stated(value, &place)))
                .ok_or(NUMBER),
            "tr" => last_number(values)
                .map(|value| self.transparency = Some(stated(value, &place)))
                .ok_or(NUMBER),
            "tf" => colour(values).map(|colour| {
                let least = colour.into_iter().fold(f32::INFINITY, f32::min);
                self.filter = Some(stated(least, &place));
            }),
            "ke" => {
                if colour(values) != Ok([0.0; 3]) {
                    self.remark("material/emission", "emission is not drawn", &place);
                }
                Ok(())
            }
            "pr" | "pm" | "ps" | "pc" | "pcr" | "aniso" | "anisor" => {
                let why = "physically based keys are not read";
                self.remark("material/physically-based", why, &place);
                Ok(())
            }
            // The index of refraction, the sharpness of reflections and the anti-aliasing of
            // textures show nothing by themselves.
            "ni" | "sharpness" | "map_aat" => Ok(()),
            _ if is_texture(word) => {
                self.read_texture(word, values, &place);
                Ok(())
            }
            _ => {
                let why = "not an MTL statement, ignored";
                self.remark("material/unknown", why, &place);
                Ok(())
            }
        };
        if let Err(why) = read {
            self.remark(IGNORED, why, &place);
        }
    }

    fn read_colour(&mut self, word: &str, values: &str, place: &Place) -> Result<(), &'static str> {
        let colour = colour(values)?;
        if colour.iter().any(|channel| *channel > 1.0) {
            let why = "a colour is not within 0 to 1: what is shown is clamped at each pixel";
            self.remark("material/over-range", why, place);
        }
        match word {
            "ka" => self.ambient = Some(colour),
            "kd" => self.diffuse = Some(colour),
            _ => self.specular = Some(colour),
        }
        Ok(())
    }

    fn read_illumination(&mut self, values: &str, place: &Place) -> Result<(), &'static str> {
        let expected = "is ignored: expected an illumination model, a whole number from 0 to 10";
        let model: u8 = values.parse().map_err(|_| expected)?;
        if model > 2 {
            let why = "reflection, refraction and cast shadows are not drawn";
            self.remark("material/reflection", why, place);
        }
        self.illumination = Some(model);
        Ok(())
    }

    /// Reads a texture. Some exporters write the keyword without a file, which means none.
    fn read_texture(&mut self, word: &str, values: &str, place: &Place) {
        if !values.is_empty() {
            self.remark("material/texture", "textures are not drawn", place);
            if word == "map_kd" {
                self.diffuse_map = Some(place.clone());
            }
        }
    }

    fn remark(&mut self, kind: &'static str, why: &'static str, place: &Place) {
        let place = place.clone();
        self.remarks.push(Remark { place, kind, why });
    }

    /// Evaluates the statements that depend on others, after all were read.
    fn finish(&mut self) {
        let is_black = self
            .diffuse
            .is_none_or(|colour| colour.iter().all(|c| *c == 0.0));
        if let Some(map) = self.diffuse_map.take().filter(|_| is_black) {
            self.diffuse = None;
            let why = "a texture over a black or missing `Kd`: the default grey is drawn instead";
            self.remark("material/default-grey", why, &map);
        }
        let dissolve = self.dissolve.take();
        let transparency = self.transparency.take();
        let filter = self.filter.take();
        let reported = match (dissolve, transparency, filter) {
            (Some(dissolve), _, _) if dissolve.value != 1.0 => Some(dissolve),
            // Some programs write `Tr` with the meaning of `d`, so both 0 and 1 are opaque if `d`
            // is 1.
            (Some(_), transparency, _) => {
                transparency.filter(|stated| stated.value != 0.0 && stated.value != 1.0)
            }
            (None, Some(transparency), _) => {
                Some(transparency).filter(|stated| stated.value != 0.0)
            }
            (None, None, filter) => filter.filter(|stated| stated.value != 1.0),
        };
        if let Some(Stated { place, .. }) = reported {
            let why = "transparency is not drawn, all surfaces are opaque";
            self.remark("material/transparency", why, &place);
        }
    }

    /// Returns the material. Channels and exponents that the file does not set have their defaults.
    fn material(&self) -> Material {
        // Illumination models 0 (constant) and 1 (diffuse) have no highlight.
        let matte = matches!(self.illumination, Some(0 | 1));
        let specular = self.specular.filter(|_| !matte);
        Material {
            ambient: self.ambient.unwrap_or(Material::MTL.ambient),
            diffuse: self.diffuse.unwrap_or(Material::MTL.diffuse),
            specular: specular.unwrap_or(Material::MTL.specular),
            shininess: self.shininess.unwrap_or(Material::MTL.shininess),
        }
    }
}

/// True if `word`, in lower case, is a keyword for a texture.
fn is_texture(word: &str) -> bool {
    word.starts_with("map_") || matches!(word, "bump" | "disp" | "decal" | "refl" | "norm")
}

fn stated(value: f32, place: &Place) -> Stated {
    let place = place.clone();
    Stated { value, place }
}

/// Reads a colour from three numbers, or from one number for all channels.
fn colour(values: &str) -> Result<Rgb, &'static str> {
    let first = values.split_ascii_whitespace().next().unwrap_or_default();
    if first.eq_ignore_ascii_case("spectral") || first.eq_ignore_ascii_case("xyz") {
        return Err("is ignored: expected red, green and blue (other colour models are not read)");
    }
    let channels: Option<Vec<f32>> = values.split_ascii_whitespace().map(number).collect();
    match channels.as_deref() {
        Some([grey]) => Ok([*grey; 3]),
        Some([red, green, blue]) => Ok([*red, *green, *blue]),
        _ if values.contains(',') => {
            Err("is ignored: expected one or three finite numbers, 0 or more, with decimal points")
        }
        _ => Err("is ignored: expected one or three finite numbers, 0 or more"),
    }
}

/// Reads the last of `values`. The word `-halo` may come before it.
fn last_number(values: &str) -> Option<f32> {
    number(values.split_ascii_whitespace().next_back()?)
}

/// Reads a finite number that is 0 or more.
fn number(word: &str) -> Option<f32> {
    let value = word.parse().ok();
    value.filter(|n: &f32| n.is_finite() && *n >= 0.0)
}
