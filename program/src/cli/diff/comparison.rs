//! The comparison of two pictures for `diff` and for `render --reference`: metrics, the judgement
//! by a tolerance, the map, and sentences about them.

use super::super::CliError;
use super::super::text::{counted, measured};
use super::super::tolerance::{Judged, Tolerance};
use fastphong::compare::metrics::judgement::{Selection, judged_map};
use fastphong::compare::metrics::{
    Difference, MAX_PERCEIVED, METRICS, compare_where, flip_map, mean_flip, ssim,
};
use fastphong::picture::image_file::Pair;
use fastphong::picture::{Picture, Picture8};
use serde_json::{Value, json};

/// How many grey levels the light end of a difference map stands for.
pub const SCALE: f32 = 16.0;

/// Which metrics of perceived difference to compute. They are slow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Perceived {
    /// None of them.
    Nothing,
    /// SSIM and FLIP, unless there are too many pixels.
    Metrics,
    /// Also the map of FLIP.
    Map,
}

/// The result of a comparison.
pub struct Comparison {
    /// The metrics and the judgement. `None` for pictures of different sizes: metrics of the corner
    /// that both share say nothing about the pictures.
    pub result: Option<(Difference, Judged)>,
    /// The map of FLIP, if it was computed.
    pub flip: Option<Picture<f32>>,
}

impl Comparison {
    /// Compares a pair. For pictures of different sizes, at most the map of FLIP is computed.
    ///
    /// # Errors
    /// If there are too many pixels for a map of FLIP, the mask or region does not fit the size, or
    /// pictures that are not the same have no pixel to compare.
    pub fn of(
        pair: &Pair<'_>,
        tolerance: &Tolerance<'_>,
        perceived: Perceived,
    ) -> Result<Comparison, CliError> {
        let maps_flip = perceived == Perceived::Map;
        let [width, height] = pair.common_size();
        let is_perceived = width * height <= MAX_PERCEIVED;
        if maps_flip && !is_perceived {
            let problem = format!("{width}x{height} pixels are too many");
            return Err(format!("--flip: {problem}: expected at most {MAX_PERCEIVED}").into());
        }
        let [seen, other] = pair.displayed();
        if !pair.is_one_size() {
            let flip = maps_flip.then(|| flip_map(&seen, &other)).transpose()?;
            let result = None;
            return Ok(Comparison { result, flip });
        }
        let selection = tolerance.selection([width, height])?;
        let [r, a] = pair.compared();
        let mut difference = compare_where(&r, &a, |x, y| selection.includes(x, y))?;
        if difference.compared == 0 && !difference.equal {
            let of = match difference.excluded {
                0 => "",
                _ => " of those that are not left out",
            };
            let problem = format!("nothing is compared: neither picture covers a pixel{of}");
            let expected = "expected pixels with alpha over 0, or the same values everywhere";
            return Err(format!("{problem}: {expected}").into());
        }
        let mut flip = None;
        if perceived == Perceived::Nothing {
            // Only the judgement is asked for.
        } else if difference.equal && !pair.has_two_encodings() && !maps_flip {
            // Equal pictures look equal on a screen too: FLIP, the slowest metric, is 0. SSIM is 1,
            // as `compare_where` found.
            difference.flip = is_perceived.then_some(0.0);
        } else {
            let shown = selection.selected(&seen, &other);
            flip = is_perceived.then(|| flip_map(&seen, &shown)).transpose()?;
            difference.ssim = ssim(&seen, &shown)?;
            difference.flip = flip.as_ref().map(mean_flip);
        }
        let judged = tolerance.judge(&r, &a, &selection)?;
        let result = Some((difference, judged));
        Ok(Comparison { result, flip })
    }

    /// True if the pictures agree: within the threshold, or to the bit if there is none.
    fn agrees(&self, tolerance: &Tolerance<'_>) -> bool {
        let result = self.result.as_ref();
        result.is_some_and(|(difference, judged)| match tolerance.threshold() {
            Some(_) => !judged.fails,
            None => difference.equal,
        })
    }

    /// Adds sizes, encodings and metrics to a JSON object. For pictures of different sizes, the
    /// metrics are null.
    pub fn add_to(&self, object: &mut Value, pair: &Pair<'_>, sizes: [[usize; 2]; 2]) {
        let difference = self.result.as_ref().map(|(difference, _)| difference);
        // JSON has neither infinity nor NaN: serde writes null.
        let metrics = METRICS.iter();
        let metrics = metrics.map(|m| (m.name, json!(difference.map(|found| (m.value)(found)))));
        let ([width, height], [reference_size, actual_size]) = (pair.common_size(), sizes);
        let [reference_encoding, actual_encoding] = pair.encodings();
        super::add(
            object,
            json!({
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
            }),
        );
        match &self.result {
            Some((_, judged)) => judged.add_to(object),
            None => add_nothing(object),
        }
    }
}

/// Draws the map of differences, with `scale` grey levels at its light end. If the sizes differ, it
/// shows the upper left part that both pictures have.
///
/// # Errors
/// As [`selection`].
pub fn map(pair: &Pair<'_>, tolerance: &Tolerance<'_>, scale: f32) -> Result<Picture8, CliError> {
    let ([r, a], selection) = (pair.compared(), selection(pair, tolerance)?);
    Ok(judged_map(&r, &a, scale, tolerance.radius(), &selection)?)
}

/// Returns the pixels that a map shows: those that the tolerance selects, or all that both pictures
/// have if their sizes differ.
///
/// # Errors
/// If the mask or region does not fit the size.
pub fn selection<'t>(
    pair: &Pair<'_>,
    tolerance: &'t Tolerance<'_>,
) -> Result<Selection<'t>, CliError> {
    if pair.is_one_size() {
        tolerance.selection(pair.common_size())
    } else {
        Ok(Selection::whole(pair.common_size()))
    }
}

/// Returns the end of the sentence "the pictures differ …", for pictures that fail.
pub fn failed_text(judged: &Judged, tolerance: &Tolerance<'_>) -> String {
    let most = tolerance.threshold().unwrap_or(0.0);
    let (count, allowed) = (judged.count_text(), judged.allowed_text());
    let largest = judged.judgement.largest;
    if largest.is_finite() {
        let by = measured(largest);
        format!("by {by} grey levels, more than {most}, in {count}{allowed}")
    } else {
        let pixels = not_finite_text(judged.judgement.histogram.not_finite);
        format!("{pixels}; {count} are over {most} levels{allowed}")
    }
}

/// Returns the end of the sentence "the pictures differ …", for pixels that are finite in only one
/// of them.
pub fn not_finite_text(pixels: usize) -> String {
    let (one, more) = ("pixel that is", "pixels that are");
    let pixels = counted(pixels, one, more);
    format!("in {pixels} infinite or not a number in one of them, which no threshold allows")
}

/// Returns the line for pictures of different sizes. If `is_mapped`, it says which part the map
/// shows.
pub fn sizes_text(pair: &Pair<'_>, sizes: [[usize; 2]; 2], is_mapped: bool) -> String {
    let sizes = [sizes[0], sizes[1], pair.common_size()];
    let [reference, actual, common] = sizes.map(|[width, height]| format!("{width}x{height}"));
    let found = format!("the reference has {reference} pixels, the picture {actual}");
    let mapped = if is_mapped {
        format!("; the map shows the upper left part that both have, {common}")
    } else {
        String::new()
    };
    format!("the sizes differ: {found}{mapped}\n")
}

/// Returns what to do about pictures that do not agree, as `found` says, if their stored values do:
/// then only the encodings differ.
pub fn encoding_text(
    found: Option<&Comparison>,
    pair: &Pair<'_>,
    tolerance: &Tolerance<'_>,
) -> Option<String> {
    if !pair.has_two_encodings() || found.is_some_and(|found| found.agrees(tolerance)) {
        return None;
    }
    let used = pair.encodings();
    let [one, two] = used.map(|used| {
        let verb = if used.is_stated {
            "states"
        } else {
            "counts as"
        };
        format!("{verb} {}", used.encoding.name())
    });
    let as_stored = Comparison::of(&pair.as_stored(), tolerance, Perceived::Nothing);
    if !as_stored.is_ok_and(|found| found.agrees(tolerance)) {
        return None;
    }
    let expected = match used.map(|used| used.is_stated) {
        [true, true] => "expected files that state one encoding".to_owned(),
        [false, true] => format!("expected `--assume {}`", used[1].encoding.name()),
        [_, false] => format!("expected `--assume {}`", used[0].encoding.name()),
    };
    let problem = "only the encodings differ, and the stored values agree";
    Some(format!(
        "{problem}: the reference {one}, the picture {two}: {expected}"
    ))
}

/// Adds the fields of [`Judged::add_to`] for pictures that were not judged.
fn add_nothing(object: &mut Value) {
    for field in ["compared", "left_out", "over", "largest", "histogram"] {
        object[field] = Value::Null;
    }
    for field in ["not_finite_differing", "largest_region"] {
        object[field] = Value::Null;
    }
}
