//! `render --reference`: a picture against the one that was accepted before.

use super::contents::Contents;
use super::drawing::RenderJob;
use super::output::{ForceFlag, Output};
use super::text::{counted, measured};
use super::{CliError, Outcome, files};
use fastphong::compare::metrics::{Difference, compare, difference_map};
use fastphong::picture::Encoding;
use fastphong::picture::image_file::{AlphaUse, FilePicture, Format, Pair};
use fastphong::report::shell_word;
use std::fmt;
use std::path::{Path, PathBuf};

/// Grey levels at the light end of difference pictures.
pub const SCALE: f32 = 16.0;

/// Returns the largest difference of a channel, alpha among them, in grey levels; infinite where one picture alone has a number.
pub fn largest_difference(difference: &Difference) -> f64 {
    match difference.not_finite_differing {
        0 => 255.0 * difference.max,
        _ => f64::INFINITY,
    }
}

/// Says in how many pixels only one picture has a number: the end of a sentence about pictures that differ.
pub fn not_finite_text(difference: &Difference) -> String {
    let (one, more) = ("pixel that is", "pixels that are");
    let pixels = counted(difference.not_finite_differing, one, more);
    format!("in {pixels} infinite or not a number in one of them, which no threshold allows")
}

/// True if the pictures were stored in two encodings: the linear one is encoded before they are compared.
pub fn has_two_encodings(pair: &Pair<'_>) -> bool {
    let [reference, actual] = pair.encodings().map(|used| used.encoding);
    reference != actual
}

/// Says what becomes of alpha if only one of the pictures has it; `names` are those of the reference and of the other picture.
pub fn alpha_text(pair: &Pair<'_>, names: [impl fmt::Display; 2]) -> Option<String> {
    let (of_reference, done) = match pair.alpha() {
        AlphaUse::Absent | AlphaUse::Compared => return None,
        AlphaUse::Flattened { of_reference } => {
            (of_reference, "is put over the background that it states")
        }
        AlphaUse::Opaque { of_reference } => {
            let done =
                "states no background to be put over, and is compared with an opaque picture";
            (of_reference, done)
        }
    };
    let [reference, actual] = names;
    Some(match of_reference {
        true => format!("{actual} has no alpha: {reference} {done}"),
        false => format!("{reference} has no alpha: {actual} {done}"),
    })
}

/// A picture to compare with the one that was accepted.
pub struct ReferenceCheck<'a> {
    /// The accepted picture.
    pub reference: &'a Path,
    /// Grey levels that a channel may differ.
    pub threshold: f64,
    /// The place where the picture was written already, if it was.
    pub written: Option<&'a Output>,
    /// `--force`: whether pictures beside the reference may replace those of others.
    pub force: ForceFlag,
}

impl ReferenceCheck<'_> {
    /// Compares the picture with its reference; returns the outcome and the lines to print. On a difference both pictures
    /// are left beside each other, with a map.
    ///
    /// # Errors
    /// When the reference is there and cannot be read, or a picture cannot be written.
    pub fn run(&self, job: &mut RenderJob) -> Result<(Outcome, String), CliError> {
        let (reference, shown) = (self.reference, self.reference.display());
        let format = Format::of_path(reference)?;
        let actual = job.picture(format);
        let unreadable = |error| format!("{shown}: cannot be read: {error}");
        if !reference.try_exists().map_err(unreadable)? {
            let candidate = self.keep(&actual)?;
            let (path, accept) = (candidate.display(), self.how_to_accept(&candidate));
            let text = format!("no reference {shown} yet: the picture is in {path}\n{accept}");
            return Ok((Outcome::Differs, text));
        }
        let accepted = files::picture(reference, "the reference")?;
        // A reference that states no encoding was written by whoever chose that of the picture.
        let pair = Pair::new(&accepted, &actual, actual.encoding);
        let notes = accepted.notes.iter();
        let mut notes: String = notes.map(|note| format!("{shown}: {note}\n")).collect();
        if let Some(text) = alpha_text(&pair, [shown.to_string().as_str(), "the picture"]) {
            notes += &format!("{text}\n");
        }
        if has_two_encodings(&pair) {
            let [of_reference, of_actual] = pair.encodings().map(|used| used.encoding.name());
            let found = format!("{shown} is {of_reference}, the picture {of_actual}");
            notes += &format!("{found}: the linear one is encoded before they are compared\n");
        }
        let [r, a] = pair.compared();
        let difference = compare(&r, &a)?;
        let largest = largest_difference(&difference);
        if pair.is_one_size() && largest <= self.threshold {
            let within = format!("equal within {} grey levels", self.threshold);
            let text = format!("{shown}: {within}: largest difference {largest}\n");
            return Ok((Outcome::Done, notes + &text));
        }
        let candidate = self.keep(&actual)?;
        let map = FilePicture::stored(difference_map(&r, &a, SCALE)?).encoded(Encoding::Srgb);
        let map_path = sibling(&candidate, reference, "diff", Format::Png);
        self.beside(map_path.clone(), Format::Png)
            .write_encoded(&map)?;
        let found = match pair.is_one_size() {
            true => self.difference_text(&difference),
            false => {
                let ([rw, rh], [aw, ah]) = (accepted.size(), actual.size());
                let sizes = format!("the reference has {rw}x{rh} pixels, the picture {aw}x{ah}");
                format!("{shown}: the sizes differ: {sizes}")
            }
        };
        let part = match pair.is_one_size() {
            true => "",
            false => " of the upper left part that both have",
        };
        let accept = self.how_to_accept(&candidate);
        let (candidate, map_path) = (candidate.display(), map_path.display());
        let scale = format!("{SCALE} levels from black to yellow");
        let files = format!("actual: {candidate}\ndifference{part}, {scale}: {map_path}\n");
        Ok((Outcome::Differs, format!("{notes}{found}\n{files}{accept}")))
    }

    /// Returns the files that may be written, beside [`ReferenceCheck::written`]: the picture, unless it is there already, and the map.
    ///
    /// # Errors
    /// When the ending of the reference names no format.
    pub fn outputs(&self) -> Result<Vec<Output>, CliError> {
        let format = Format::of_path(self.reference)?;
        let written = self.written_as(format);
        let candidate = sibling(self.reference, self.reference, "actual", format);
        let is_new = written.is_none();
        let map = written.unwrap_or(&candidate);
        let map = sibling(map, self.reference, "diff", Format::Png);
        let candidate = is_new.then(|| self.beside(candidate, format));
        let map = self.beside(map, Format::Png);
        Ok(candidate.into_iter().chain([map]).collect())
    }

    /// Returns the output of a picture beside the reference.
    fn beside(&self, path: PathBuf, format: Format) -> Output {
        Output::chosen("--reference", path, Contents::Picture(format), self.force)
    }

    /// Returns the file that was written already, if it is of `format`.
    fn written_as(&self, format: Format) -> Option<&Path> {
        let written = self.written;
        let written = written.filter(|output| output.format() == Some(format));
        written.and_then(Output::path)
    }

    fn how_to_accept(&self, candidate: &Path) -> String {
        let paths = [candidate, self.reference];
        let [from, to] = paths.map(|path| shell_word(&path.display().to_string()));
        format!("to accept it: cp {from} {to}\n")
    }

    /// Returns the file that holds the picture in the format of the reference: the one already written, or one beside the
    /// reference.
    fn keep(&self, actual: &FilePicture) -> Result<PathBuf, CliError> {
        let format = Format::of_path(self.reference)?;
        if let Some(path) = self.written_as(format) {
            return Ok(path.to_owned());
        }
        let path = sibling(self.reference, self.reference, "actual", format);
        self.beside(path.clone(), format).write_encoded(actual)?;
        Ok(path)
    }

    /// Describes the difference in one line.
    fn difference_text(&self, difference: &Difference) -> String {
        let (found, most) = (largest_difference(difference), self.threshold);
        let shown = self.reference.display();
        let mut text = match found.is_finite() {
            true => {
                let found = measured(found);
                format!("{shown}: differs by {found} grey levels, more than {most}")
            }
            false => format!(
                "{shown}: the pictures differ {}",
                not_finite_text(difference)
            ),
        };
        if difference.coverage_mismatches > 0 {
            let covered = counted(
                difference.coverage_mismatches,
                "pixel is covered in one picture only",
                "pixels are covered in one picture only",
            );
            text += &format!(" ({covered})");
        }
        if let Some([x, y]) = difference.worst {
            let differ = counted(difference.differing, "pixel differs", "pixels differ");
            text += &format!("; {differ}, most at column {x}, row {y}");
        }
        text
    }
}

/// Returns `STEM.word.ending` in the folder of `beside`, where `STEM` is that of the reference.
fn sibling(beside: &Path, reference: &Path, word: &str, format: Format) -> PathBuf {
    let mut name = reference.file_stem().unwrap_or_default().to_owned();
    name.push(format!(".{word}.{}", format.ending()));
    beside.with_file_name(name)
}
