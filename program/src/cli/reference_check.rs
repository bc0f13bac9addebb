//! `render --reference`: compares a picture with the one that was accepted before.

use super::contents::Contents;
use super::drawing::RenderJob;
use super::output::{ForceFlag, Output};
use super::text::{counted, measured};
use super::tolerance::{Judged, Levels, Tolerance};
use super::{CliError, Outcome, files};
use crate::report::shell_word;
use fastphong::compare::metrics::compare_where;
use fastphong::compare::metrics::judgement::{Selection, judged_map};
use fastphong::picture::Encoding;
use fastphong::picture::image_file::{AlphaUse, FilePicture, Format, Pair};
use std::fmt;
use std::path::{Path, PathBuf};

/// How many grey levels the light end of a difference map stands for.
pub const SCALE: f32 = 16.0;

/// Returns the end of the sentence "the pictures differ …", for pixels that are finite in only one
/// of them.
pub fn not_finite_text(pixels: usize) -> String {
    let (one, more) = ("pixel that is", "pixels that are");
    let pixels = counted(pixels, one, more);
    format!("in {pixels} infinite or not a number in one of them, which no threshold allows")
}

/// True if the pictures have different encodings, so that the linear one is encoded before they are
/// compared.
pub fn has_two_encodings(pair: &Pair<'_>) -> bool {
    let [reference, actual] = pair.encodings().map(|used| used.encoding);
    reference != actual
}

/// Returns a note on alpha if only one of the pictures has it. `names` are the names of the
/// reference and the other picture.
pub fn alpha_text(pair: &Pair<'_>, names: [impl fmt::Display; 2]) -> Option<String> {
    let (of_reference, done) = match pair.alpha() {
        AlphaUse::Absent | AlphaUse::Compared => return None,
        AlphaUse::Flattened { of_reference } => {
            (of_reference, "is drawn over the background that it states")
        }
        AlphaUse::Opaque { of_reference } => {
            let done =
                "states no background to draw it over, and is compared with an opaque picture";
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
    /// How much the pictures may differ. It has a threshold.
    pub tolerance: &'a Tolerance<'a>,
    /// The output to which the picture was written already, if it was.
    pub written: Option<&'a Output>,
    /// `--force`, for the pictures that are written beside the reference.
    pub force: ForceFlag,
}

impl ReferenceCheck<'_> {
    /// Compares the picture with its reference, and returns the outcome and the lines to print. If
    /// they differ, writes the picture and a map beside the reference.
    ///
    /// # Errors
    /// If the reference exists but cannot be read, or a picture cannot be written.
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
        // A reference that states no encoding is taken to have the encoding of the picture.
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
        let found = match pair.is_one_size() {
            true => Some(self.judge(&pair)?),
            false => None,
        };
        if let Some(judged) = found.as_ref().filter(|judged| !judged.fails) {
            let text = self.passed_text(judged);
            return Ok((Outcome::Done, format!("{notes}{shown}: {text}\n")));
        }
        let candidate = self.keep(&actual)?;
        let map_path = sibling(&candidate, reference, "diff", Format::Png);
        self.beside(map_path.clone(), Format::Png)
            .write_encoded(&self.map(&pair)?)?;
        let (found, part) = match &found {
            Some(judged) => (self.failed_text(judged, &pair)?, ""),
            None => {
                let ([rw, rh], [aw, ah]) = (accepted.size(), actual.size());
                let sizes = format!("the reference has {rw}x{rh} pixels, the picture {aw}x{ah}");
                let part = " of the upper left part that both have";
                (format!("the sizes differ: {sizes}\n"), part)
            }
        };
        let accept = self.how_to_accept(&candidate);
        let (candidate, map_path) = (candidate.display(), map_path.display());
        let scale = format!("{SCALE} levels from black to yellow");
        let files = format!("actual: {candidate}\ndifference{part}, {scale}: {map_path}\n");
        let text = format!("{notes}{shown}: {found}{files}{accept}");
        Ok((Outcome::Differs, text))
    }

    /// Judges a pair of one size.
    fn judge(&self, pair: &Pair<'_>) -> Result<Judged, CliError> {
        let [r, a] = pair.compared();
        let selection = self.tolerance.selection(pair.common_size())?;
        self.tolerance.judge(&r, &a, &selection)
    }

    /// Draws the map. If the sizes differ, it shows the upper left part that both pictures have.
    fn map(&self, pair: &Pair<'_>) -> Result<FilePicture, CliError> {
        let [r, a] = pair.compared();
        let selection = match pair.is_one_size() {
            true => self.tolerance.selection(pair.common_size())?,
            false => Selection::whole(pair.common_size()),
        };
        let map = judged_map(&r, &a, SCALE, self.tolerance.radius(), &selection)?;
        Ok(FilePicture::stored(map).encoded(Encoding::Srgb))
    }

    /// Returns the files that may be written: the map, and the picture unless
    /// [`ReferenceCheck::written`] holds it already.
    ///
    /// # Errors
    /// If the ending of the reference names no format.
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

    /// Returns the file that was written already, if it has this `format`.
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

    /// Returns the file that holds the picture in the format of the reference. Writes one beside
    /// the reference if there is none.
    fn keep(&self, actual: &FilePicture) -> Result<PathBuf, CliError> {
        let format = Format::of_path(self.reference)?;
        if let Some(path) = self.written_as(format) {
            return Ok(path.to_owned());
        }
        let path = sibling(self.reference, self.reference, "actual", format);
        self.beside(path.clone(), format).write_encoded(actual)?;
        Ok(path)
    }

    fn threshold(&self) -> f64 {
        self.tolerance.threshold().unwrap_or(0.0)
    }

    /// Describes a picture that passes, in one line.
    fn passed_text(&self, judged: &Judged) -> String {
        let (threshold, largest) = (self.threshold(), judged.judgement.largest);
        let (count, allowed) = (judged.count_text(), judged.allowed_text());
        match judged.judgement.over {
            0 => format!(
                "equal within {threshold} grey levels: largest difference {largest}; {count} are over{allowed}"
            ),
            _ => format!(
                "accepted: {count} are over {threshold} grey levels{allowed}: largest difference {}",
                Levels(largest)
            ),
        }
    }

    /// Describes the difference in a line, the spread of differences, and a line on the largest
    /// region.
    fn failed_text(&self, judged: &Judged, pair: &Pair<'_>) -> Result<String, CliError> {
        let (found, most) = (&judged.judgement, self.threshold());
        let (count, allowed) = (judged.count_text(), judged.allowed_text());
        let mut text = match found.largest.is_finite() {
            true => {
                let by = measured(found.largest);
                format!("differs by {by} grey levels, more than {most}, in {count}{allowed}")
            }
            false => {
                let pixels = not_finite_text(found.histogram.not_finite);
                format!("the pictures differ {pixels}; {count} are over {most} levels{allowed}")
            }
        };
        let [r, a] = pair.compared();
        let selection = self.tolerance.selection(pair.common_size())?;
        let difference = compare_where(&r, &a, |x, y| selection.includes(x, y))?;
        if difference.coverage_mismatches > 0 {
            let covered = counted(
                difference.coverage_mismatches,
                "pixel is covered in one picture only",
                "pixels are covered in one picture only",
            );
            text += &format!(" ({covered})");
        }
        if let Some([x, y]) = found.worst {
            let differ = counted(difference.differing, "pixel differs", "pixels differ");
            text += &format!("; {differ}, most at column {x}, row {y}");
        }
        Ok(format!(
            "{text}\n{}{}",
            judged.spread_text(),
            judged.region_text()
        ))
    }
}

/// Returns the path `STEM.word.ending` in the folder of `beside`, with the stem of the reference.
fn sibling(beside: &Path, reference: &Path, word: &str, format: Format) -> PathBuf {
    let mut name = reference.file_stem().unwrap_or_default().to_owned();
    name.push(format!(".{word}.{}", format.ending()));
    beside.with_file_name(name)
}
