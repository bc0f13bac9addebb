//! `render --reference`: a picture against the one that was accepted before.

use super::drawing::Drawing;
use super::output::Output;
use super::{Failure, Outcome};
use fastphong::compare::metrics::{Difference, SizeMismatch, compare, difference_map};
use fastphong::picture::image_file::{
    FilePicture, Format, comparable, read_picture, write_picture,
};
use std::path::{Path, PathBuf};

/// Grey levels at the light end of difference pictures.
pub const SCALE: f32 = 16.0;

/// The largest difference of a channel in grey levels; coverage is a channel too, which is either all there or not.
pub fn largest_difference(difference: &Difference) -> f64 {
    if difference.coverage_mismatches > 0 {
        255.0
    } else {
        255.0 * difference.max
    }
}

/// What is to be compared with what.
pub struct ReferenceCheck<'a> {
    /// The accepted picture.
    pub reference: &'a Path,
    /// Grey levels that a channel may differ.
    pub threshold: f64,
    /// Where the picture was written already, if it was.
    pub written: Option<&'a Output>,
}

/// What came of it, and what to say.
pub struct Verdict {
    /// True if the pictures agree.
    pub outcome: Outcome,
    /// Lines to print.
    pub text: String,
}

impl ReferenceCheck<'_> {
    /// Compares the picture with its reference; on a difference both are left beside each other, with a map.
    ///
    /// # Errors
    /// When the reference is there and cannot be read, or a picture cannot be written.
    pub fn run(&self, drawing: &Drawing) -> Result<Verdict, Failure> {
        let reference = self.reference;
        let format = Format::of_path(reference)?;
        let actual = drawing.picture(format == Format::Pfm);
        let shown = reference.display();
        if !reference
            .try_exists()
            .map_err(|error| format!("{shown}: cannot be read: {error}"))?
        {
            let candidate = self.keep(&actual, format)?;
            let text = format!(
                "no reference {shown} yet: the picture is in {}\nto accept it: cp {} {}\n",
                candidate.display(),
                quoted(&candidate),
                quoted(reference)
            );
            return Ok(Verdict {
                outcome: Outcome::Differs,
                text,
            });
        }
        let accepted = read_picture(reference)?;
        let [r, a] = comparable(&accepted, &actual);
        match compare(&r, &a) {
            Ok(difference) if largest_difference(&difference) <= self.threshold => {
                let text = format!(
                    "{shown}: equal within {} grey levels: largest difference {}\n",
                    self.threshold,
                    largest_difference(&difference)
                );
                Ok(Verdict {
                    outcome: Outcome::Done,
                    text,
                })
            }
            Ok(difference) => {
                let candidate = self.keep(&actual, format)?;
                let map = difference_map(&r, &a, SCALE)?;
                let map_path = sibling(&candidate, reference, "diff", Format::Png);
                write_picture(&map_path, &FilePicture::stored(map))?;
                let text = self.difference_text(&difference, &candidate, &map_path);
                Ok(Verdict {
                    outcome: Outcome::Differs,
                    text,
                })
            }
            Err(sizes) => {
                let candidate = self.keep(&actual, format)?;
                let SizeMismatch {
                    reference: [rw, rh],
                    actual: [aw, ah],
                } = sizes;
                let text = format!(
                    "{shown}: the sizes differ: the reference has {rw}x{rh} pixels, the picture {aw}x{ah}\nactual: {}\n",
                    candidate.display()
                );
                Ok(Verdict {
                    outcome: Outcome::Differs,
                    text,
                })
            }
        }
    }

    /// The file that holds the picture in the format of the reference: the one already written, or one beside the
    /// reference.
    fn keep(&self, actual: &FilePicture, format: Format) -> Result<PathBuf, Failure> {
        if let Some(Output {
            path: Some(path),
            format: written,
        }) = self.written
            && *written == format
        {
            return Ok(path.clone());
        }
        let path = sibling(self.reference, self.reference, "actual", format);
        write_picture(&path, actual)?;
        Ok(path)
    }

    fn difference_text(&self, difference: &Difference, candidate: &Path, map: &Path) -> String {
        let mut text = format!(
            "{}: differs by {:.4} grey levels, more than {}",
            self.reference.display(),
            largest_difference(difference),
            self.threshold
        );
        if difference.coverage_mismatches > 0 {
            text += &format!(
                " ({} pixels are covered in one picture only)",
                difference.coverage_mismatches
            );
        }
        if let Some([x, y]) = difference.worst {
            text += &format!(
                "; {} pixels differ, most at column {x}, row {y}",
                difference.differing
            );
        }
        text + &format!(
            "\nactual: {}\ndifference, {SCALE} levels from black to yellow: {}\nto accept it: cp {} {}\n",
            candidate.display(),
            map.display(),
            quoted(candidate),
            quoted(self.reference)
        )
    }
}

/// `STEM.word.ending` in the folder of `beside`, where `STEM` is that of the reference.
fn sibling(beside: &Path, reference: &Path, word: &str, format: Format) -> PathBuf {
    let mut name = reference.file_stem().unwrap_or_default().to_owned();
    name.push(format!(".{word}.{}", format.ending()));
    beside.with_file_name(name)
}

/// A path as a shell reads it back.
fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    let plain = |c: char| c.is_alphanumeric() || "-_./+=:@%,".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        text
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}
