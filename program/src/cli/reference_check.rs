//! `render --reference`: compares a picture with the one that was accepted before.

use super::contents::{self, Contents};
use super::diff::comparison::{
    self, Comparison, Perceived, SCALE, encoding_text, failed_text, sizes_text,
};
use super::drawing::RenderJob;
use super::output::{ForceFlag, Output};
use super::text::counted;
use super::tolerance::{Judged, Levels, Tolerance};
use super::{CliError, Outcome, files};
use crate::report::shell_word;
use fastphong::compare::metrics::Difference;
use fastphong::picture::image_file::{FilePicture, Format, Pair};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Prints a warning.
type Warn<'a> = &'a dyn Fn(&str);

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
    /// they differ, writes the picture and a map beside the reference, and warns if that fails: it
    /// changes nothing about the outcome. If not, removes the map of an earlier failure.
    ///
    /// # Errors
    /// If the reference exists but cannot be read, or nothing can be compared.
    pub fn run(&self, job: &mut RenderJob, warn: Warn<'_>) -> Result<(Outcome, String), CliError> {
        let (reference, shown) = (self.reference, self.reference.display());
        let format = Format::of_path(reference)?;
        let actual = job.picture(format);
        let unreadable = |error| format!("{shown}: cannot be read: {error}");
        if !reference.try_exists().map_err(unreadable)? {
            let Some(candidate) = self.keep(format, &actual, warn) else {
                return Ok((Outcome::Differs, format!("no reference {shown} yet\n")));
            };
            let (path, accept) = (candidate.display(), self.how_to_accept(&candidate));
            let text = format!("no reference {shown} yet: the picture is in {path}\n{accept}");
            return Ok((Outcome::Differs, text));
        }
        let accepted = files::picture(reference, "the reference")?;
        // A reference that states no encoding is taken to have the encoding of the picture.
        let assumed = actual.encoding;
        let pair = Pair::new(&accepted, &actual, assumed);
        let notes = accepted.notes.iter();
        let mut notes: String = notes.map(|note| format!("{shown}: {note}\n")).collect();
        let names = [&shown.to_string(), "the picture"];
        if let Some(text) = pair.alpha_text(names) {
            notes += &format!("{text}\n");
        }
        if pair.has_two_encodings() {
            notes += &pair.encodings_text(names);
        }
        let found = Comparison::of(&pair, self.tolerance, Perceived::Nothing)?;
        if let Some((_, judged)) = found.result.as_ref().filter(|(_, judged)| !judged.fails) {
            self.remove_map(format, warn);
            let text = self.passed_text(judged);
            return Ok((Outcome::Done, format!("{notes}{shown}: {text}\n")));
        }
        let text = match &found.result {
            Some((difference, judged)) => self.failed_text(difference, judged),
            None => sizes_text(&pair, [accepted.size(), actual.size()], true),
        };
        let mut text = format!("{notes}{shown}: {text}");
        let map = comparison::map(&pair, self.tolerance, SCALE)?;
        let found = Some(&found);
        if let Some(why) = encoding_text(found, &pair, self.tolerance) {
            text += &format!("{why}\n");
        }
        let candidate = self.keep(format, &actual, warn);
        let path = self.map_path(format);
        let is_other = files::is_file(&path) && !contents::is_map(&path);
        let map = if is_other && !self.force.force {
            let problem = format!("{} is another picture, not a map", path.display());
            warn(&format!("{problem}: no map is written without `--force`"));
            None
        } else {
            self.write(path, Format::Png, warn, |out| contents::write_map(map, out))
        };
        if let Some(path) = &candidate {
            text += &format!("actual: {}\n", path.display());
        }
        if let Some(path) = map {
            let path = path.display();
            text += &format!("difference, {SCALE} levels from black to yellow: {path}\n");
        }
        if let Some(path) = &candidate {
            text += &self.how_to_accept(path);
        }
        Ok((Outcome::Differs, text))
    }

    /// Returns the files that may be written: the map, and the picture unless
    /// [`ReferenceCheck::written`] holds it already.
    ///
    /// # Errors
    /// If the ending of the reference names no format.
    pub fn outputs(&self) -> Result<Vec<Output>, CliError> {
        let format = Format::of_path(self.reference)?;
        let is_new = self.written_as(format).is_none();
        let candidate = is_new.then(|| self.beside(self.candidate_path(format), format));
        let map = self.beside(self.map_path(format), Format::Png);
        Ok(candidate.into_iter().chain([map]).collect())
    }

    /// Returns the path of the picture beside the reference.
    fn candidate_path(&self, format: Format) -> PathBuf {
        sibling(self.reference, self.reference, "actual", format)
    }

    /// Returns the path of the map: beside the picture that was written in the reference's
    /// `format`, or else beside the reference.
    fn map_path(&self, format: Format) -> PathBuf {
        let beside = self.written_as(format).unwrap_or(self.reference);
        sibling(beside, self.reference, "diff", Format::Png)
    }

    /// Removes the map of an earlier failure, which would contradict the outcome. Another picture
    /// of this name stays: it may be the reference of another scene.
    fn remove_map(&self, format: Format, warn: Warn<'_>) {
        let path = self.map_path(format);
        if contents::is_map(&path)
            && let Err(error) = files::remove(&path)
        {
            warn(&format!("{error}: it shows an earlier difference"));
        }
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
    /// the reference if there is none, or warns if that fails.
    fn keep(&self, format: Format, actual: &FilePicture, warn: Warn<'_>) -> Option<PathBuf> {
        if let Some(path) = self.written_as(format) {
            return Some(path.to_owned());
        }
        self.write(self.candidate_path(format), format, warn, |out| {
            actual.write_to(format, out)
        })
    }

    /// Writes a picture with `write`, and returns its path, or warns if that fails.
    fn write(
        &self,
        path: PathBuf,
        format: Format,
        warn: Warn<'_>,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Option<PathBuf> {
        let written = self.beside(path.clone(), format).write(write);
        if let Err(error) = &written {
            warn(&error.to_string());
        }
        written.is_ok().then_some(path)
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
