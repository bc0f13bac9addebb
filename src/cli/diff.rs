//! `fastphong diff`: two picture files, in numbers and as a map.

use super::output::{Output, print_beside};
use super::reference_check::{SCALE, largest_difference};
use super::{CliError, Log, Outcome, files, values};
use fastphong::compare::metrics::{
    Difference, METRICS, Perceived, compare, difference_map, flip_colours, mean_flip,
    signed_difference_map,
};
use fastphong::compare::table::aligned;
use fastphong::picture::image_file::{FilePicture, comparable};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Compare two picture files
#[derive(clap::Args, Debug)]
pub struct DiffArgs {
    /// Reference picture: PNG, PPM or PFM
    reference: PathBuf,
    /// Picture to compare with it
    actual: PathBuf,
    /// Exit with code 1 when a channel differs by more grey levels, of 255; a pixel that only one of the pictures
    /// covers differs by 255
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
        let output = self.output.as_deref().map(|path| Output::new(path, None));
        let output = output.transpose()?;
        let parts = [
            (&self.reference, "the reference"),
            (&self.actual, "the picture"),
        ];
        for (path, part) in parts {
            files::will_read(path, part);
        }
        let to = output.as_ref().map(Output::place);
        files::check(to.map(Output::destination).as_slice())?;
        let [reference, actual] = parts.map(|(path, part)| files::picture(path, part));
        let (reference, actual) = (reference?, actual?);
        let [r, a] = comparable(&reference, &actual);
        let mut difference = compare(&r, &a)?;
        let [seen, other] =
            [&reference, &actual].map(|picture| Perceived::new(&picture.to_stored()));
        let flip = seen.flip(&other)?;
        difference.flip = Some(mean_flip(&flip));
        if let Some(output) = &output {
            let map = match (self.flip, self.signed) {
                (true, _) => flip_colours(&flip),
                (_, true) => signed_difference_map(&r, &a, self.scale)?,
                (_, false) => difference_map(&r, &a, self.scale)?,
            };
            output.write(&FilePicture::stored(map))?;
        }
        let text = match self.json {
            true => format!("{:#}\n", self.json(&difference, reference.size())),
            false => table(&difference),
        };
        print_beside(output.as_ref(), &text)?;
        let found = largest_difference(&difference);
        let Some(most) = self.fail_above.filter(|most| found > *most) else {
            return Ok(Outcome::Done);
        };
        let by = format!("{found:.4} grey levels, more than {most}");
        log.note(&format!("the pictures differ by {by}"));
        Ok(Outcome::Differs)
    }

    /// Returns the numbers as data.
    fn json(&self, difference: &Difference, [width, height]: [usize; 2]) -> Value {
        // JSON has neither infinity nor NaN: they become null.
        let metrics = METRICS
            .iter()
            .map(|m| (m.name, json!((m.value)(difference))));
        json!({
            "schema": "fastphong.diff/1",
            "reference": self.reference.display().to_string(),
            "actual": self.actual.display().to_string(),
            "width": width,
            "height": height,
            "equal": difference.equal,
            "worst": difference.worst,
            "metrics": metrics.collect::<Value>(),
            "fail_above": self.fail_above,
            "failed": self.fail_above.map(|most| largest_difference(difference) > most),
        })
    }
}

/// Returns the numbers as a table.
fn table(difference: &Difference) -> String {
    let value = |value: Option<f64>| match value {
        None => "-".to_owned(),
        Some(value) if value.is_infinite() => "inf".to_owned(),
        Some(value) if value == value.round() => format!("{value:.0}"),
        Some(value) => format!("{value:.4}"),
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
    text
}
