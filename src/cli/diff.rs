//! `fastphong diff`: two picture files, in numbers and as a map.

use super::output::{self, Output, print_beside};
use super::reference_check::{
    SCALE, alpha_text, has_two_encodings, largest_difference, not_finite_text,
};
use super::text::measured;
use super::{CliError, Log, Outcome, files, memory, values};
use fastphong::compare::metrics::{
    Difference, MAX_PERCEIVED, METRICS, compare, difference_map, flip_colours, flip_map, mean_flip,
    signed_difference_map, ssim,
};
use fastphong::compare::table::aligned;
use fastphong::picture::image_file::{FilePicture, Pair, read_picture_from};
use fastphong::picture::{Encoding, Picture, Picture8};
use serde_json::{Value, json};
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

/// Compare two picture files
#[derive(clap::Args, Debug)]
pub struct DiffArgs {
    /// Reference picture: PNG, PBM, PGM, PPM, PAM, PFM, BMP or Targa; `-` is standard input
    reference: PathBuf,
    /// Picture to compare with it; `-` is standard input
    actual: PathBuf,
    /// Encoding of pictures that state none [default: linear for PFM, srgb for others]. Of two encodings, the linear picture is
    /// encoded before they are compared
    #[arg(long, value_name = "linear|srgb", value_parser = encoding)]
    assume: Option<Encoding>,
    /// Exit with code 1 when a channel differs by more grey levels, of 255. Alpha is a channel: a pixel that only one of the
    /// pictures covers differs by its alpha
    #[arg(long, value_name = "GREY_LEVELS", value_parser = values::grey_levels, allow_hyphen_values = true)]
    fail_above: Option<f64>,
    /// Write a map of the difference; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Grey levels at the light end of the map; larger differences are magenta
    #[arg(long, value_name = "GREY_LEVELS", default_value_t = SCALE, value_parser = values::scale, allow_hyphen_values = true, requires = "output")]
    scale: f32,
    /// Map brighter and darker in different colours: orange and blue
    #[arg(long, requires = "output")]
    signed: bool,
    /// Map what a viewer sees when the pictures alternate (FLIP), from black to a light yellow
    #[arg(long, requires = "output", conflicts_with_all = ["signed", "scale"])]
    flip: bool,
    /// Print the numbers as JSON
    #[arg(long)]
    json: bool,
}

impl DiffArgs {
    /// Compares, prints, and writes the map.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let output = self.output.as_deref();
        let output = output.map(|path| Output::of_picture(path, None));
        let output = output.transpose()?;
        let outputs: Vec<&Output> = output.iter().collect();
        let paths = self.paths();
        if paths.iter().all(|path| path.as_os_str() == "-") {
            let expected = "expected a file for one of the pictures";
            return Err(format!("standard input holds one picture: {expected}").into());
        }
        let parts = [(paths[0], "the reference"), (paths[1], "the picture")];
        for (path, part) in parts {
            match path.as_os_str() == "-" {
                true => files::will_read_stdin(part),
                false => files::will_read(path, part),
            }
        }
        output::check(&outputs)?;
        let [reference, actual] = parts.map(|(path, part)| read(path, part));
        let (reference, actual) = (reference?, actual?);
        for (path, picture) in paths.iter().zip([&reference, &actual]) {
            for note in &picture.notes {
                log.warning(&format!("{}: {note}", path.display()));
            }
        }
        let pair = Pair::new(&reference, &actual, self.assume);
        if let Some(text) = alpha_text(&pair, paths.map(Path::display)) {
            log.warning(&text);
        }
        memory::check_pair(&pair)?;
        let found = Found::of(&pair, self.flip)?;
        if let Some(output) = &output {
            let map = self.map(&pair, found.flip.as_ref())?;
            output.write_encoded(&FilePicture::stored(map).encoded(Encoding::Srgb))?;
        }
        let sizes = [reference.size(), actual.size()];
        let difference = found.difference.as_ref();
        let text = match (self.json, difference) {
            (true, _) => format!("{:#}\n", self.json(difference, &pair, sizes)),
            (false, None) => self.encodings_text(&pair) + &self.sizes_text(&pair, sizes),
            (false, Some(difference)) => {
                let mut text = table(difference);
                if found.flip.is_none() {
                    text += &format!("ssim and flip are left out: over {MAX_PERCEIVED} pixels\n");
                }
                text + &self.encodings_text(&pair)
            }
        };
        print_beside(&outputs, &text)?;
        let Some(difference) = difference else {
            log.note("the pictures differ in size");
            return Ok(Outcome::Differs);
        };
        let found = largest_difference(difference);
        let Some(most) = self.fail_above.filter(|most| found > *most) else {
            return Ok(Outcome::Done);
        };
        let by = match found.is_finite() {
            true => format!("by {} grey levels, more than {most}", measured(found)),
            false => not_finite_text(difference),
        };
        log.note(&format!("the pictures differ {by}"));
        Ok(Outcome::Differs)
    }

    /// Draws the map, of the part that both pictures have; `flip` is what a viewer sees there.
    fn map(&self, pair: &Pair<'_>, flip: Option<&Picture<f32>>) -> Result<Picture8, CliError> {
        let [r, a] = pair.compared();
        Ok(match (flip, self.signed) {
            (Some(flip), _) if self.flip => flip_colours(flip),
            (_, true) => signed_difference_map(&r, &a, self.scale)?,
            (_, false) => difference_map(&r, &a, self.scale)?,
        })
    }

    fn paths(&self) -> [&Path; 2] {
        [&self.reference, &self.actual]
    }

    /// Says in which encodings the pictures are, and which of them were assumed.
    fn encodings_text(&self, pair: &Pair<'_>) -> String {
        let [reference, actual] = [0, 1].map(|i| {
            let (path, used) = (self.paths()[i].display(), pair.encodings()[i]);
            let name = used.encoding.name();
            match used.is_stated {
                true => format!("{path} states {name}"),
                false => format!("{path} states none, {name} is assumed"),
            }
        });
        let encoded = match has_two_encodings(pair) {
            true => "; the linear picture was encoded as srgb, unrounded",
            false => "",
        };
        format!("encodings: {reference}; {actual}{encoded}\n")
    }

    /// Says that the sizes differ, and which part a map shows.
    fn sizes_text(&self, pair: &Pair<'_>, sizes: [[usize; 2]; 2]) -> String {
        let sizes = [sizes[0], sizes[1], pair.common_size()];
        let [reference, actual, common] = sizes.map(|[width, height]| format!("{width}x{height}"));
        let found = format!("the reference has {reference} pixels, the picture {actual}");
        let mapped = match self.output {
            Some(_) => format!("; the map shows the upper left part that both have, {common}"),
            None => String::new(),
        };
        format!("the sizes differ: {found}{mapped}\n")
    }

    /// Returns the numbers as data; without metrics for pictures of different size.
    fn json(
        &self,
        difference: Option<&Difference>,
        pair: &Pair<'_>,
        sizes: [[usize; 2]; 2],
    ) -> Value {
        // JSON has neither infinity nor NaN: they become null.
        let metrics = METRICS.iter();
        let metrics = metrics.map(|m| (m.name, json!(difference.map(|found| (m.value)(found)))));
        let ([width, height], [reference_size, actual_size]) = (pair.common_size(), sizes);
        let [reference_encoding, actual_encoding] = pair.encodings();
        let failed = match difference {
            Some(found) => self.fail_above.map(|most| largest_difference(found) > most),
            None => Some(true),
        };
        json!({
            "schema": "fastphong.diff/1",
            "reference": self.reference.display().to_string(),
            "actual": self.actual.display().to_string(),
            "width": width,
            "height": height,
            "reference_size": reference_size,
            "actual_size": actual_size,
            "reference_encoding": reference_encoding.encoding,
            "reference_encoding_assumed": !reference_encoding.is_stated,
            "actual_encoding": actual_encoding.encoding,
            "actual_encoding_assumed": !actual_encoding.is_stated,
            "compared_encoding": pair.compared_encoding(),
            "equal": difference.is_some_and(|found| found.equal),
            "worst": difference.and_then(|found| found.worst),
            "metrics": metrics.collect::<Value>(),
            "fail_above": self.fail_above,
            "failed": failed,
        })
    }
}

/// Reads the picture that is `part` of the command from a file, or from standard input if the path is `-`.
fn read(path: &Path, part: &'static str) -> Result<FilePicture, CliError> {
    if path.as_os_str() != "-" {
        return Ok(files::picture(path, part)?);
    }
    let input = io::stdin().lock();
    if input.is_terminal() {
        let expected = "expected a file or a pipe";
        return Err(format!("standard input is a terminal: {expected}").into());
    }
    Ok(read_picture_from(input, Path::new("standard input"))?)
}

/// Reads `linear` or `srgb`.
fn encoding(text: &str) -> Result<Encoding, String> {
    let named = Encoding::ALL.into_iter().find(|e| e.name() == text);
    named.ok_or_else(|| "expected linear or srgb".to_owned())
}

/// What a comparison finds.
struct Found {
    /// `None` for pictures of different size: numbers of a corner that both have say nothing about the pictures.
    difference: Option<Difference>,
    /// What a viewer sees where the pictures alternate, if it is computed.
    flip: Option<Picture<f32>>,
}

impl Found {
    /// Compares a pair; of pictures of different size, finds only what a map needs, which is of FLIP if `maps_flip`.
    ///
    /// # Errors
    /// When there are too many pixels for a map of FLIP.
    fn of(pair: &Pair<'_>, maps_flip: bool) -> Result<Found, CliError> {
        let [width, height] = pair.common_size();
        let is_perceived = width * height <= MAX_PERCEIVED;
        if maps_flip && !is_perceived {
            let problem = format!("{width}x{height} pixels are too many");
            return Err(format!("--flip: {problem}: expected at most {MAX_PERCEIVED}").into());
        }
        let [seen, other] = pair.displayed();
        let flip = is_perceived && (maps_flip || pair.is_one_size());
        let flip = flip.then(|| flip_map(&seen, &other)).transpose()?;
        if !pair.is_one_size() {
            let difference = None;
            return Ok(Found { difference, flip });
        }
        let [r, a] = pair.compared();
        let difference = Difference {
            ssim: ssim(&seen, &other)?,
            flip: flip.as_ref().map(mean_flip),
            ..compare(&r, &a)?
        };
        let difference = Some(difference);
        Ok(Found { difference, flip })
    }
}

/// Returns the numbers as a table.
fn table(difference: &Difference) -> String {
    let value = |value: Option<f64>| match value {
        None => "-".to_owned(),
        Some(value) if value == value.round() && value.abs() < 1e15 => format!("{value:.0}"),
        Some(value) => measured(value),
    };
    let rows = METRICS.iter().map(|metric| {
        let value = value((metric.value)(difference));
        [metric.name, &value, metric.unit, metric.meaning].map(str::to_owned)
    });
    let mut text = aligned(&rows.collect::<Vec<_>>(), &[0, 2, 3]);
    if let Some([x, y]) = difference.worst {
        text += &format!("the largest difference is at column {x}, row {y}\n");
    } else if difference.equal {
        text += "the pictures are equal\n";
    }
    if difference.not_finite_differing > 0 {
        text += &format!("the pictures differ {}\n", not_finite_text(difference));
    }
    text
}
