//! The tolerance of a comparison: flags that `diff` and `render --reference` share.

use super::text::grouped;
use super::{CliError, files, memory, values};
use fastphong::compare::metrics::judgement::{
    Allowance, Area, Bin, Judgement, LargestRegion, MAX_RADIUS, Mask, Rule, Selection, judge,
    share_text,
};
use fastphong::picture::LevelRows;
use fastphong::picture::image_file::Pair;
use serde_json::{Value, json};
use std::fmt;
use std::path::PathBuf;

/// The flags of a tolerance, apart from the threshold.
#[derive(clap::Args, Debug)]
pub struct ToleranceFlags {
    /// Allow this many pixels over the threshold: a number, or a percentage of the compared pixels,
    /// such as `0.1%`
    #[arg(long, value_name = "N|P%", value_parser = allowance, allow_hyphen_values = true)]
    allow: Option<Allowance>,
    /// Let a pixel match any other at most this many columns and rows away, 0 to 8, if another
    /// rasterizer draws edges differently. This goes both ways, so that nothing may be missing from
    /// either picture
    #[arg(long, value_name = "PIXELS", value_parser = radius, allow_hyphen_values = true)]
    radius: Option<usize>,
    /// Leave out the pixels that are black or transparent in this picture, which must have the same
    /// size
    #[arg(long, value_name = "FILE")]
    mask: Option<PathBuf>,
    /// Compare only this rectangle of the pictures: column and row of its upper left pixel, width
    /// and height
    #[arg(long, value_name = "X,Y,W,H", value_parser = area, allow_hyphen_values = true)]
    region: Option<Area>,
}

/// Reads a number of pixels or a percentage.
fn allowance(text: &str) -> Result<Allowance, String> {
    let expected = "a number of pixels, or a percentage from 0% to 100%";
    Allowance::parse(text).ok_or_else(|| format!("expected {expected} (of at most 9 decimals)"))
}

fn radius(text: &str) -> Result<usize, String> {
    let expected = format!("whole pixels, 0 to {MAX_RADIUS}");
    values::number(text, expected, |radius| *radius <= MAX_RADIUS)
}

/// Reads a rectangle.
fn area(text: &str) -> Result<Area, String> {
    let numbers: Option<Vec<usize>> = text.split(',').map(|part| part.parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, width, height]) if width > 0 && height > 0 => Ok(Area {
            corner: [x, y],
            size: [width, height],
        }),
        _ => Err("expected column, row, width and height, such as 0,0,64,48".to_owned()),
    }
}

impl ToleranceFlags {
    /// Returns the name of the first flag that is set, if any.
    pub fn first_given(&self) -> Option<&'static str> {
        let flags = [
            ("--allow", self.allow.is_some()),
            ("--radius", self.radius.is_some()),
            ("--mask", self.mask.is_some()),
            ("--region", self.region.is_some()),
        ];
        let given = flags.into_iter().find(|(_, is_given)| *is_given);
        given.map(|(name, _)| name)
    }

    /// Returns the radius, 0 without `--radius`.
    pub fn radius(&self) -> usize {
        self.radius.unwrap_or(0)
    }

    /// Reads the mask, and returns the tolerance with a threshold in grey levels. `named` is the
    /// flag of the threshold, for messages.
    ///
    /// # Errors
    /// If `--allow` is set without a threshold, or the mask cannot be read.
    pub fn with(&self, threshold: Option<f64>, named: &str) -> Result<Tolerance<'_>, CliError> {
        if self.allow.is_some() && threshold.is_none() {
            let problem = "`--allow` counts pixels over a threshold, but there is none";
            return Err(format!("{problem}: expected `{named} GREY_LEVELS` too").into());
        }
        let mask = self.mask.as_deref();
        let mask = mask.map(|path| {
            let picture = files::picture(path, "the mask")?;
            let [levels, _] = Pair::new(&picture, &picture, None).compared();
            Ok::<_, CliError>(Mask::of(&levels))
        });
        Ok(Tolerance {
            flags: self,
            threshold,
            mask: mask.transpose()?,
        })
    }
}

/// How much two pictures may differ.
pub struct Tolerance<'a> {
    flags: &'a ToleranceFlags,
    /// The threshold in grey levels.
    threshold: Option<f64>,
    mask: Option<Mask>,
}

impl Tolerance<'_> {
    /// Returns the threshold in grey levels.
    pub fn threshold(&self) -> Option<f64> {
        self.threshold
    }

    /// Returns the radius in pixels.
    pub fn radius(&self) -> usize {
        self.flags.radius()
    }

    /// Returns the selection of pixels to compare in pictures of this size.
    ///
    /// # Errors
    /// If the mask has another size, the region reaches beyond the picture, or no pixel is left.
    pub fn selection(&self, size: [usize; 2]) -> Result<Selection<'_>, CliError> {
        let [width, height] = size;
        let of_mask = self.mask.as_ref().map(Mask::size);
        if let Some([w, h]) = of_mask.filter(|mask| *mask != size) {
            let path = self.flags.mask.as_deref().unwrap_or("".as_ref()).display();
            let problem =
                format!("the mask {path} has {w}x{h} pixels, the pictures {width}x{height}");
            return Err(format!("{problem}: expected the same size").into());
        }
        let area = self.flags.region;
        let Some(selection) = Selection::new(size, area, self.mask.as_ref()) else {
            let problem =
                format!("`--region` reaches beyond the picture of {width}x{height} pixels");
            return Err(format!("{problem}: expected a part of it").into());
        };
        if self.flags.first_given().is_some() && selection.left_out() == width * height {
            let of_region = if area.is_some() { " of the region" } else { "" };
            let problem =
                format!("the mask leaves out every pixel{of_region}, so that nothing is compared");
            return Err(format!(
                "{problem}: expected a mask with pixels that are not black{of_region}"
            )
            .into());
        }
        Ok(selection)
    }

    /// Judges a pair of pictures of the same size.
    ///
    /// # Errors
    /// If there is too little memory for the rows that a radius needs.
    pub fn judge(
        &self,
        reference: &dyn LevelRows,
        actual: &dyn LevelRows,
        selection: &Selection<'_>,
    ) -> Result<Judged, CliError> {
        memory::check_rows(reference.size(), self.radius())?;
        let rule = Rule {
            threshold: self.threshold.unwrap_or(0.0),
            radius: self.radius(),
        };
        let judgement = judge(reference, actual, rule, selection)?;
        let allow = self.flags.allow.as_ref();
        let is_allowed = match allow {
            Some(allow) => allow.allows(judgement.over, judgement.compared),
            None => judgement.over == 0,
        };
        Ok(Judged {
            fails: self.threshold.is_some() && !is_allowed,
            threshold: self.threshold,
            allowed: allow.map(Allowance::to_string),
            radius: self.radius(),
            judgement,
        })
    }

    /// Describes the tolerance in a sentence.
    pub fn text(&self) -> String {
        let flags = self.flags;
        let mut text = match self.threshold {
            Some(most) => format!("No pixel may differ by more than {most} grey levels"),
            None => "There is no threshold".to_owned(),
        };
        if let Some(allow) = &flags.allow {
            text += &format!(", except {allow} of them");
            text += if allow.to_string().ends_with('%') {
                ""
            } else {
                " in each picture"
            };
        }
        match self.radius() {
            0 => {}
            radius => text += &format!(", within a radius of {radius}"),
        }
        if flags.mask.is_some() || flags.region.is_some() {
            text += "; some pixels are left out";
        }
        text + "."
    }

    /// Returns the flags as JSON.
    pub fn json(&self) -> Value {
        let region = self.flags.region;
        json!({
            "fail_above": self.threshold,
            "allow": self.flags.allow.as_ref().map(Allowance::to_string),
            "radius": self.radius(),
            "mask": self.flags.mask.as_ref().map(|path| path.display().to_string()),
            "region": region.map(|Area { corner: [x, y], size: [w, h] }| [x, y, w, h]),
        })
    }
}

/// A judgement of a picture by a tolerance.
pub struct Judged {
    pub judgement: Judgement,
    /// True if more pixels are over the threshold than are allowed.
    pub fails: bool,
    threshold: Option<f64>,
    allowed: Option<String>,
    radius: usize,
}

impl Judged {
    /// Writes how many pixels are over the threshold: `3 of 192 compared pixels (1.56 %)`.
    pub fn count_text(&self) -> String {
        let Judgement { over, compared, .. } = self.judgement;
        let pixels = match compared {
            1 => "pixel",
            _ => "pixels",
        };
        let (shown, all) = (grouped(over), grouped(compared));
        format!(
            "{shown} of {all} compared {pixels} ({})",
            share_text(over, compared)
        )
    }

    /// Returns the end of a sentence with the allowance and the radius. It is empty without both.
    pub fn allowed_text(&self) -> String {
        let allowed = self.allowed.as_ref();
        let mut text = allowed.map_or(String::new(), |text| format!(", {text} allowed"));
        text += &self.radius_text();
        text
    }

    fn radius_text(&self) -> String {
        match self.radius {
            0 => String::new(),
            1 => ", within a radius of 1 pixel".to_owned(),
            radius => format!(", within a radius of {radius} pixels"),
        }
    }

    /// Returns a line on the largest region of pixels over the threshold; an empty text if there is
    /// none.
    pub fn region_text(&self) -> String {
        let Some(region) = self.judgement.region else {
            return String::new();
        };
        let LargestRegion {
            pixels,
            corner: [x, y],
            size: [width, height],
            ..
        } = region;
        let [worst_x, worst_y] = region.worst;
        let count = super::text::counted(pixels, "pixel", "pixels");
        let worst = Levels(region.levels);
        let place = format!("{width}x{height} at column {x}, row {y}");
        format!(
            "largest region: {count} within {place}, most at column {worst_x}, row {worst_y}: {worst}\n"
        )
    }

    /// Returns the histogram of differences as lines.
    pub fn spread_text(&self) -> String {
        let Judgement {
            compared,
            left_out,
            ref histogram,
            ..
        } = self.judgement;
        let left_out = match left_out {
            0 => String::new(),
            pixels => format!(", {} left out", grouped(pixels)),
        };
        let pixels = super::text::counted(compared, "compared pixel", "compared pixels");
        let text = format!("{pixels}{left_out}{}:\n", self.radius_text());
        let mut rows: Vec<[String; 3]> = Vec::new();
        let mut row = |range: String, pixels: usize| {
            if pixels > 0 {
                rows.push([range, grouped(pixels), share_text(pixels, compared)]);
            }
        };
        for bin in histogram.bins() {
            row(bin_text(&bin), bin.pixels);
        }
        row("infinite or not a number".to_owned(), histogram.not_finite);
        text + &crate::compare::table::aligned(&rows, &[0])
    }

    /// Returns the histogram, the count and the largest region as lines.
    pub fn text(&self) -> String {
        let mut text = self.spread_text();
        if let Some(threshold) = self.threshold {
            let (count, allowed) = (self.count_text(), self.allowed.as_ref());
            let allowed = allowed.map_or(String::new(), |text| format!(", {text} allowed"));
            text += &format!("over {threshold} grey levels: {count}{allowed}\n");
        }
        text + &self.region_text()
    }

    /// Adds the judgement to a JSON object.
    pub fn add_to(&self, object: &mut Value) {
        let found = &self.judgement;
        let finite = |levels: f64| levels.is_finite().then_some(levels);
        let bin = |bin: Bin| json!({ "over": bin.over, "up_to": bin.up_to, "pixels": bin.pixels });
        object["compared"] = found.compared.into();
        object["left_out"] = found.left_out.into();
        object["over"] = json!(self.threshold.map(|_| found.over));
        object["largest"] = json!({ "levels": finite(found.largest), "at": found.worst });
        object["histogram"] = found.histogram.bins().map(bin).collect();
        object["not_finite_differing"] = found.histogram.not_finite.into();
        object["largest_region"] = json!(found.region.map(|region| json!({
            "pixels": region.pixels,
            "corner": region.corner,
            "size": region.size,
            "worst": region.worst,
            "levels": finite(region.levels),
        })));
    }
}

/// A difference in a sentence: `40 grey levels`, `2.5000 grey levels`, or
/// `infinite or not a number in one picture`.
pub struct Levels(pub f64);

impl fmt::Display for Levels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            levels if !levels.is_finite() => f.write_str("infinite or not a number in one picture"),
            1.0 => f.write_str("1 grey level"),
            levels if levels == levels.round() && levels < 1e15 => {
                write!(f, "{levels:.0} grey levels")
            }
            levels => write!(f, "{} grey levels", super::text::measured(levels)),
        }
    }
}

/// Writes the range of a bin of the histogram.
fn bin_text(bin: &Bin) -> String {
    match (bin.over, bin.up_to) {
        (None, _) => "equal".to_owned(),
        (Some(over), Some(up_to)) => format!("over {over} to {up_to} levels"),
        (Some(over), None) => format!("over {over} levels"),
    }
}
