//! The comparison of two pictures: their metrics, and the judgement by a tolerance.

use super::super::CliError;
use super::super::reference_check::has_two_encodings;
use super::super::tolerance::{Judged, Tolerance};
use fastphong::compare::metrics::{
    Difference, MAX_PERCEIVED, METRICS, compare_where, flip_map, mean_flip, ssim,
};
use fastphong::picture::Picture;
use fastphong::picture::image_file::Pair;
use serde_json::{Value, json};

/// The result of a comparison.
pub struct Comparison {
    /// The metrics and the judgement. `None` for pictures of different sizes: metrics of the corner
    /// that both share say nothing about the pictures.
    pub result: Option<(Difference, Judged)>,
    /// The map of FLIP, if it was computed.
    pub flip: Option<Picture<f32>>,
}

impl Comparison {
    /// Compares a pair. `maps_flip` asks for a map of FLIP; for pictures of different sizes, only
    /// this map is computed.
    ///
    /// # Errors
    /// If there are too many pixels for a map of FLIP, or the mask or region does not fit the size.
    pub fn of(
        pair: &Pair<'_>,
        tolerance: &Tolerance<'_>,
        maps_flip: bool,
    ) -> Result<Comparison, CliError> {
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
        let mut flip = None;
        if difference.equal && !has_two_encodings(pair) && !maps_flip {
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

/// Adds the fields of [`Judged::add_to`] for pictures that were not judged.
fn add_nothing(object: &mut Value) {
    for field in ["compared", "left_out", "over", "largest", "histogram"] {
        object[field] = Value::Null;
    }
    for field in ["not_finite_differing", "largest_region"] {
        object[field] = Value::Null;
    }
}
