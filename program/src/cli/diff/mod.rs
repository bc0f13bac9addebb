//! `fastphong diff`: compares two picture files, or the pictures of two folders, by metrics and as
//! a map.

mod compared;
pub(super) mod comparison;
mod folders;
mod junit;
mod page;
mod pairing;

use super::output::{self, Output, print_beside};
use super::text::measured;
use super::tolerance::{Tolerance, ToleranceFlags};
use super::{CliError, Log, Outcome, files, memory, values};
use crate::compare::table::aligned;
use comparison::{
    Comparison, Perceived, SCALE, encoding_text, failed_text, not_finite_text, selection,
    sizes_text,
};
use fastphong::compare::metrics::judgement::{draw_frame, draw_left_out};
use fastphong::compare::metrics::{
    Difference, MAX_PERCEIVED, METRICS, flip_colours, signed_difference_map,
};
use fastphong::picture::image_file::{FilePicture, Pair, read_picture_from};
use fastphong::picture::{Encoding, Picture8};
use serde_json::{Value, json};
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

/// Compare two picture files, or all pictures of two folders
#[derive(clap::Args, Debug)]
pub struct DiffArgs {
    /// Reference picture: PNG, PBM, PGM, PPM, PAM, PFM, BMP or Targa; `-` is standard input. Or a
    /// folder of references
    reference: PathBuf,
    /// Picture to compare with it; `-` is standard input. Or a folder of pictures: each is compared
    /// with the reference of the same name, also in sub-folders
    actual: PathBuf,
    /// Encoding of pictures that state none [default: linear for PFM, srgb for others]. If the two
    /// encodings differ, the linear picture is encoded before they are compared
    #[arg(long, value_name = "linear|srgb", value_parser = encoding)]
    assume: Option<Encoding>,
    /// Exit with code 1 if a channel differs by more than this many grey levels (of 255). Alpha is
    /// a channel: a pixel that only one picture covers differs by its alpha. Without this flag,
    /// folders must be equal
    #[arg(long, value_name = "GREY_LEVELS", value_parser = values::grey_levels, allow_hyphen_values = true)]
    fail_above: Option<f64>,
    #[command(flatten)]
    tolerance: ToleranceFlags,
    /// Write a map of the difference; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Grey levels at the light end of the map; larger differences are magenta
    #[arg(long, value_name = "GREY_LEVELS", default_value_t = SCALE, value_parser = values::scale, allow_hyphen_values = true, requires = "output")]
    scale: f32,
    /// Draw brighter pixels in orange on the map, and darker ones in blue
    #[arg(long, requires = "output")]
    signed: bool,
    /// Draw a map of FLIP: the difference that a viewer sees when the pictures alternate, from
    /// black to light yellow
    #[arg(long, requires = "output", conflicts_with_all = ["signed", "scale"])]
    flip: bool,
    /// Draw a frame on the map, around the largest connected region of pixels over the threshold,
    /// or of differing pixels if there is no threshold
    #[arg(long, requires = "output")]
    frame: bool,
    /// Print the metrics as JSON
    #[arg(long)]
    json: bool,
    /// Write a page that shows all pairs of two folders, with a slider, flipping and maps; `-` is
    /// standard output
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Write the result for two folders as JUnit XML, with a test case for each pair; `-` is
    /// standard output
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Copy pictures that differ or are new over the references, as they were compared: all of
    /// them, or none if one fails. Nothing is removed
    #[arg(long)]
    approve: bool,
}

impl DiffArgs {
    /// Compares the files or folders, prints the result and writes the files asked for.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        match self
            .paths()
            .map(|path| path.as_os_str() != "-" && path.is_dir())
        {
            [true, true] => folders::run(self, log),
            [false, false] => self.run_on_files(log),
            of_reference => {
                let [folder, other] = match of_reference {
                    [true, _] => self.paths(),
                    [false, _] => [&*self.actual, &*self.reference],
                };
                let is_missing = other.as_os_str() != "-" && !other.exists();
                let (folder, other) = (folder.display(), other.display());
                let (problem, expected) = match of_reference {
                    [false, _] if is_missing => (
                        format!("there is no {other}"),
                        "expected a folder of references, which may be empty: `--approve` fills it",
                    ),
                    _ if is_missing => (
                        format!("there is no {other}"),
                        "expected a folder of pictures",
                    ),
                    _ => (
                        format!("{folder} is a folder, but {other} is not"),
                        "expected two files or two folders",
                    ),
                };
                Err(format!("{problem}: {expected}").into())
            }
        }
    }

    /// Refuses flags that only make sense for two files.
    fn check_for_folders(&self) -> Result<(), CliError> {
        match &self.output {
            None => Ok(()),
            Some(_) => {
                let problem = "`--output` is for the map of two files";
                Err(format!("{problem}: expected `--html FILE` for two folders").into())
            }
        }
    }

    /// Refuses flags that only make sense for two folders.
    fn check_for_files(&self) -> Result<(), CliError> {
        let flags = [
            ("--html", self.html.is_some()),
            ("--junit", self.junit.is_some()),
            ("--approve", self.approve),
        ];
        match flags.into_iter().find(|(_, is_given)| *is_given) {
            None => Ok(()),
            Some((flag, _)) => {
                let problem = format!("`{flag}` is for two folders");
                Err(format!("{problem}: expected folders, not files").into())
            }
        }
    }

    /// Compares two files, prints the result and writes the map.
    fn run_on_files(&self, log: Log) -> Result<Outcome, CliError> {
        self.check_for_files()?;
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
            if path.as_os_str() == "-" {
                files::will_read_stdin(part)
            } else {
                files::will_read(path, part)
            }
        }
        self.check_flags()?;
        let tolerance = self.tolerance.with(self.fail_above, "--fail-above")?;
        output::check(&outputs)?;
        let [reference, actual] = parts.map(|(path, part)| read(path, part));
        let (reference, actual) = (reference?, actual?);
        for (path, picture) in paths.iter().zip([&reference, &actual]) {
            for note in &picture.notes {
                log.warning(&format!("{}: {note}", path.display()));
            }
        }
        let pair = Pair::new(&reference, &actual, self.assume);
        if let Some(text) = pair.alpha_text(paths.map(Path::display)) {
            log.warning(&text);
        }
        memory::check_pair(&pair)?;
        let perceived = if self.flip {
            Perceived::Map
        } else {
            Perceived::Metrics
        };
        let found = Comparison::of(&pair, &tolerance, perceived)?;
        if let Some(output) = &output {
            let map = self.map(&pair, &found, &tolerance)?;
            output.write_encoded(&FilePicture::stored(map).encoded(Encoding::Srgb))?;
        }
        let sizes = [reference.size(), actual.size()];
        let text = if self.json {
            format!("{:#}\n", self.json(&found, &pair, sizes, &tolerance))
        } else {
            self.text(&found, &pair, sizes)
        };
        print_beside(&outputs, &text)?;
        let found = Some(&found);
        if let Some(text) = encoding_text(found, &pair, &tolerance) {
            log.note(&text);
        }
        Ok(match found.and_then(|found| found.result.as_ref()) {
            None => {
                log.note("the pictures differ in size");
                Outcome::Differs
            }
            Some((_, judged)) if judged.fails => {
                let found = failed_text(judged, &tolerance);
                log.note(&format!("the pictures differ {found}"));
                Outcome::Differs
            }
            Some(_) => Outcome::Done,
        })
    }

    /// Returns the result as lines of text.
    fn text(&self, found: &Comparison, pair: &Pair<'_>, sizes: [[usize; 2]; 2]) -> String {
        let Some((difference, judged)) = &found.result else {
            let sizes = sizes_text(pair, sizes, self.output.is_some());
            return pair.encodings_text(self.paths().map(Path::display)) + &sizes;
        };
        let mut text = table(difference);
        if difference.flip.is_none() {
            text += &format!("ssim and flip are left out: over {MAX_PERCEIVED} pixels\n");
        }
        if !difference.equal || self.fail_above.is_some() {
            text += &judged.text();
        }
        text + &pair.encodings_text(self.paths().map(Path::display))
    }

    /// Refuses `--radius` with a map that ignores it.
    fn check_flags(&self) -> Result<(), CliError> {
        let other = match (self.signed, self.flip) {
            (true, _) => "--signed",
            (_, true) => "--flip",
            _ => return Ok(()),
        };
        match self.tolerance.radius() {
            0 => Ok(()),
            _ => {
                let problem = format!("`{other}` maps pixels against those at the same place");
                Err(format!("{problem}: expected no `--radius`").into())
            }
        }
    }

    /// Draws the map. If the sizes differ, it shows the upper left part that both pictures have.
    fn map(
        &self,
        pair: &Pair<'_>,
        found: &Comparison,
        tolerance: &Tolerance<'_>,
    ) -> Result<Picture8, CliError> {
        let [r, a] = pair.compared();
        let mut map = match (&found.flip, self.signed) {
            (Some(flip), _) if self.flip => flip_colours(flip),
            (_, true) => signed_difference_map(&r, &a, self.scale)?,
            (_, false) => comparison::map(pair, tolerance, self.scale)?,
        };
        draw_left_out(&mut map, &selection(pair, tolerance)?);
        let judged = found.result.as_ref().map(|(_, judged)| judged);
        let region = judged.and_then(|judged| judged.judgement.region);
        if let (true, Some(region)) = (self.frame, region) {
            draw_frame(&mut map, &region);
        }
        Ok(map)
    }

    fn paths(&self) -> [&Path; 2] {
        [&self.reference, &self.actual]
    }

    /// Returns the result as JSON. Pictures of different sizes have no metrics.
    fn json(
        &self,
        found: &Comparison,
        pair: &Pair<'_>,
        sizes: [[usize; 2]; 2],
        tolerance: &Tolerance<'_>,
    ) -> Value {
        let [reference, actual] = self.paths().map(|path| path.display().to_string());
        let mut object = json!({
            "schema": "fastphong.diff/1",
            "reference": reference,
            "actual": actual,
        });
        found.add_to(&mut object, pair, sizes);
        add(&mut object, tolerance.json());
        object["failed"] = match &found.result {
            Some((_, judged)) => json!(self.fail_above.map(|_| judged.fails)),
            None => true.into(),
        };
        object
    }
}

/// Adds the fields of one object to another.
fn add(object: &mut Value, fields: Value) {
    if let (Value::Object(object), Value::Object(fields)) = (object, fields) {
        object.extend(fields);
    }
}

/// Reads a picture from a file, or from standard input if the path is `-`. `part` names it in
/// messages: "the reference".
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

/// Returns the metrics as a table.
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
        text += &format!(
            "the pictures differ {}\n",
            not_finite_text(difference.not_finite_differing)
        );
    }
    text
}
