//! `render --reference`: compares a picture with the one that was accepted before.

use super::contents::Contents;
use super::diff::comparison::{self, Comparison, Perceived, SCALE, failed_text, sizes_text};
use super::drawing::RenderJob;
use super::output::{ForceFlag, Output};
use super::text::counted;
use super::tolerance::{Judged, Levels, Tolerance};
use super::{CliError, Outcome, files};
use crate::report::shell_word;
use fastphong::compare::metrics::Difference;
use fastphong::picture::Encoding;
use fastphong::picture::image_file::{FilePicture, Format, Pair};
use std::path::{Path, PathBuf};

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
        let names = [&shown.to_string(), "the picture"];
        if let Some(text) = pair.alpha_text(names) {
            notes += &format!("{text}\n");
        }
        if pair.has_two_encodings() {
            notes += &pair.encodings_text(names);
        }
        let found = Comparison::of(&pair, self.tolerance, Perceived::Nothing)?.result;
        if let Some((_, judged)) = found.as_ref().filter(|(_, judged)| !judged.fails) {
            let text = self.passed_text(judged);
            return Ok((Outcome::Done, format!("{notes}{shown}: {text}\n")));
        }
        let candidate = self.keep(&actual)?;
        let map = comparison::map(&pair, self.tolerance, SCALE)?;
        let map_path = sibling(&candidate, reference, "diff", Format::Png);
        self.beside(map_path.clone(), Format::Png)
            .write_encoded(&FilePicture::stored(map).encoded(Encoding::Srgb))?;
        let found = match &found {
            Some((difference, judged)) => self.failed_text(difference, judged),
            None => sizes_text(&pair, [accepted.size(), actual.size()], true),
        };
        let accept = self.how_to_accept(&candidate);
        let (candidate, map_path) = (candidate.display(), map_path.display());
        let scale = format!("{SCALE} levels from black to yellow");
        let files = format!("actual: {candidate}\ndifference, {scale}: {map_path}\n");
        let text = format!("{notes}{shown}: {found}{files}{accept}");
        Ok((Outcome::Differs, text))
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
    fn failed_text(&self, difference: &Difference, judged: &Judged) -> String {
        let mut text = format!("differs {}", failed_text(judged, self.tolerance));
        if difference.coverage_mismatches > 0 {
            let covered = counted(
                difference.coverage_mismatches,
                "pixel is covered in one picture only",
                "pixels are covered in one picture only",
            );
            text += &format!(" ({covered})");
        }
        if let Some([x, y]) = judged.judgement.worst {
            let differ = counted(difference.differing, "pixel differs", "pixels differ");
            text += &format!("; {differ}, most at column {x}, row {y}");
        }
        let (spread, region) = (judged.spread_text(), judged.region_text());
        format!("{text}\n{spread}{region}")
    }
}

/// Returns the path `STEM.word.ending` in the folder of `beside`, with the stem of the reference.
fn sibling(beside: &Path, reference: &Path, word: &str, format: Format) -> PathBuf {
    let mut name = reference.file_stem().unwrap_or_default().to_owned();
    name.push(format!(".{word}.{}", format.ending()));
    beside.with_file_name(name)
}
