//! The data of a finished figure: texts, pictures, curves, tables and findings, without layout.

use super::error::Result;
use super::fixture::stored;
use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::{format, vec::Vec};
use fastphong::compare::metrics::difference_map;
use fastphong::picture::{LinearPicture, Picture8};
use fastphong::raster::trace::Trace;
use serde::{Serialize, Serializer};

/// A finished figure.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FigureContent {
    /// The blocks, from top to bottom.
    pub blocks: Vec<FigureBlock>,
    /// The measured values.
    pub findings: Vec<Finding>,
}

impl FigureContent {
    /// Returns the finding with this key.
    pub fn finding(&self, key: &str) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.key == key)
    }

    /// Adds a paragraph.
    pub fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(FigureBlock::Text(text.into()));
    }

    /// Adds pictures of one subject with their captions, `columns` in a row where there is room.
    pub fn pictures<C: Into<String>>(
        &mut self,
        columns: usize,
        subject: &str,
        panels: impl IntoIterator<Item = (C, Picture8)>,
    ) {
        let panel = |(caption, picture): (C, Picture8)| {
            let caption = caption.into();
            Panel {
                alt: format!("{subject}, {caption}."),
                caption,
                picture,
            }
        };
        let shown = panels.into_iter().map(panel).collect();
        self.blocks.push(FigureBlock::Pictures {
            columns,
            shown,
            outlines: Vec::new(),
        });
    }

    /// Outlines polygons on the pictures that were added last. The polygon that matters comes
    /// first.
    pub(super) fn outline(&mut self, polygons: Vec<Vec<[f32; 2]>>) {
        if let Some(FigureBlock::Pictures { outlines, .. }) = self.blocks.last_mut() {
            *outlines = polygons;
        }
    }

    /// Adds pictures of one subject in a row. In `captions`, ` | ` separates one from the next.
    ///
    /// # Panics
    /// If the counts of captions and pictures differ.
    pub fn row<const N: usize>(&mut self, subject: &str, captions: &str, pictures: [Picture8; N]) {
        let captions: Vec<&str> = captions.split(" | ").collect();
        assert_eq!(captions.len(), N, "a caption for each picture");
        self.pictures(N, subject, captions.into_iter().zip(pictures));
    }

    /// Adds two pictures with their captions, and a map of their difference. The yellow end of its
    /// colours means `levels` grey levels.
    ///
    /// # Errors
    /// If the sizes differ.
    pub(super) fn compared(
        &mut self,
        subject: &str,
        captions: &str,
        [a, b]: &[LinearPicture; 2],
        levels: f32,
    ) -> Result<()> {
        let scale = format!("purple to yellow is up to {levels} grey levels");
        let captions = format!("{captions} | their difference: {scale}, black none, magenta more");
        let map = difference_map(a, b, levels)?;
        self.row(subject, &captions, [stored(a), stored(b), map]);
        Ok(())
    }

    /// Adds curves.
    pub fn plot(&mut self, plot: Plot) {
        self.blocks.push(FigureBlock::Plot(plot));
    }

    /// Adds a table. In the head and in each row ` | ` separates the cells, as in Markdown.
    pub fn table(&mut self, head: &str, rows: impl IntoIterator<Item = String>) {
        let cells = |row: &str| row.split(" | ").map(String::from).collect();
        self.blocks.push(FigureBlock::Table {
            head: cells(head),
            rows: rows.into_iter().map(|row| cells(&row)).collect(),
        });
    }

    /// Adds a trace.
    pub fn trace(&mut self, trace: Trace) {
        self.blocks.push(FigureBlock::Trace {
            method: trace.method.clone(),
            trace: Box::new(trace),
        });
    }

    /// Adds a [finding](Self::found) that confirms the lecture if the flag of `value` is set, and
    /// contradicts it otherwise.
    pub fn confirms(&mut self, head: &str, value: (impl Into<f64>, &str, bool), says: &str) {
        let agreement = Agreement::if_holds(value.2);
        self.found(head, value, agreement, says);
    }

    /// Adds a [finding](Self::found) that contradicts the lecture if the flag of `value` is set,
    /// and confirms it otherwise.
    pub fn contradicts(&mut self, head: &str, value: (impl Into<f64>, &str, bool), says: &str) {
        let agreement = Agreement::if_holds(!value.2);
        self.found(head, value, agreement, says);
    }

    /// Adds a [finding](Self::found) that the lecture does not mention.
    pub fn adds(&mut self, head: &str, value: (impl Into<f64>, &str, bool), says: &str) {
        self.found(head, value, Agreement::Adds, says);
    }

    /// Adds a finding. Its head is `key | label`. Its value comes with the unit and a flag, `so`:
    /// does the sentence `says` hold? If not, the verdict says that it does not.
    ///
    /// # Panics
    /// If the head has no ` | `.
    pub fn found(
        &mut self,
        head: &str,
        (value, unit, so): (impl Into<f64>, &str, bool),
        agreement: Agreement,
        says: &str,
    ) {
        let (key, label) = head.split_once(" | ").expect("a key and a label");
        let marked = if so { "" } else { "This does not hold: " };
        self.findings.push(Finding {
            key: key.into(),
            label: label.into(),
            value: value.into(),
            unit: unit.into(),
            agreement,
            verdict: format!("{marked}{says}"),
        });
    }
}

/// A part of a figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum FigureBlock {
    /// A paragraph of plain text.
    Text(String),
    /// Pictures side by side.
    Pictures {
        /// How many pictures stand in a row where there is room, at least 1.
        columns: usize,
        /// The pictures, row by row.
        shown: Vec<Panel>,
        /// The polygons that the page can outline on each picture, as columns and rows of their
        /// corners in pixels. The polygon that matters comes first.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        outlines: Vec<Vec<[f32; 2]>>,
    },
    /// Curves.
    Plot(Plot),
    /// Rows of cells. The first cell names the row.
    Table {
        /// The titles of the columns.
        head: Vec<String>,
        /// The cells. Each row has as many as the head.
        rows: Vec<Vec<String>>,
    },
    /// The engine's work, step by step.
    Trace {
        /// The method, with its parameters.
        method: String,
        /// The trace. The report stores it beside the data, not in it.
        #[serde(skip)]
        trace: Box<Trace>,
    },
}

/// A picture with its caption.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Panel {
    /// The caption below the picture.
    pub caption: String,
    /// The description for readers who cannot see the picture.
    pub alt: String,
    /// The picture. It is small, and the page shows its pixels as squares. The report stores it
    /// beside the data, not in it.
    #[serde(skip)]
    pub picture: Picture8,
}

/// The scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// Equal differences have equal lengths.
    Linear,
    /// Equal ratios have equal lengths. Values without a logarithm are drawn at the lower end.
    Log,
}

/// Returns a linear axis.
pub(super) fn linear(label: impl Into<String>) -> (String, Scale) {
    (label.into(), Scale::Linear)
}

/// Returns a logarithmic axis.
pub(super) fn log(label: impl Into<String>) -> (String, Scale) {
    (label.into(), Scale::Log)
}

/// A chart of curves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plot {
    /// The title, one line.
    pub title: String,
    /// The quantity along the horizontal axis with its unit, and the scale.
    pub x: (String, Scale),
    /// The quantity along the vertical axis with its unit, and the scale.
    pub y: (String, Scale),
    /// The curves. Readers can tell at most six apart.
    pub series: Vec<Series>,
    /// The values of x at vertical lines, which mark edges of polygons, for example.
    pub marks: Vec<f64>,
    /// The caption, a sentence or two.
    pub caption: String,
}

impl Plot {
    /// Makes a chart without marks.
    pub fn new(
        title: impl Into<String>,
        [x, y]: [(String, Scale); 2],
        series: impl IntoIterator<Item = Series>,
        caption: impl Into<String>,
    ) -> Plot {
        Plot {
            title: title.into(),
            x,
            y,
            series: series.into_iter().collect(),
            marks: Vec::new(),
            caption: caption.into(),
        }
    }

    /// Draws a vertical line at each of these values of x.
    pub fn marked(self, marks: impl Into<Vec<f64>>) -> Plot {
        Plot {
            marks: marks.into(),
            ..self
        }
    }
}

/// A curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Series {
    /// The name of the curve.
    pub label: String,
    /// The points, in the order in which a line joins them. The page leaves out points that are not
    /// finite.
    #[serde(serialize_with = "five_digits")]
    pub points: Vec<(f64, f64)>,
}

/// Writes points with five significant digits, more than a chart shows. A value that is not finite
/// becomes `null`.
fn five_digits<S: Serializer>(points: &[(f64, f64)], to: S) -> Result<S::Ok, S::Error> {
    let short = |value: f64| format!("{value:.4e}").parse::<f64>().unwrap_or(value);
    let points = points.iter().map(|(x, y)| (short(*x), short(*y)));
    points.collect::<Vec<_>>().serialize(to)
}

impl Series {
    /// Makes a curve through `points`.
    pub fn new(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Series {
        Series {
            label: label.into(),
            points: points.into_iter().collect(),
        }
    }

    /// Samples a function at each `x`.
    pub(super) fn sampled(
        label: impl Into<String>,
        x: impl IntoIterator<Item = f64>,
        y: impl Fn(f64) -> f64,
    ) -> Series {
        Series::new(label, x.into_iter().map(|x| (x, y(x))))
    }
}

/// What a measured value says about the lecture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Agreement {
    /// The lecture is right.
    Confirms,
    /// The lecture is wrong.
    Contradicts,
    /// The lecture does not mention it.
    Adds,
}

impl Agreement {
    /// Returns [`Agreement::Confirms`] if the lecture's statement `holds`, else
    /// [`Agreement::Contradicts`].
    pub fn if_holds(holds: bool) -> Agreement {
        if holds {
            Agreement::Confirms
        } else {
            Agreement::Contradicts
        }
    }
}

/// A measured value, and the conclusion from it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The name for programs. It never changes, and it is unique in its figure.
    pub key: String,
    /// The name for people.
    pub label: String,
    /// The value, finite.
    pub value: f64,
    /// The unit of the value; empty for a pure number.
    pub unit: String,
    /// What the value says about the lecture.
    pub agreement: Agreement,
    /// The conclusion. The value chose this sentence.
    pub verdict: String,
}

/// Writes a value for a sentence: three significant digits, and a power of ten below 10⁻³.
pub(super) fn written(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && size < 1e-3 {
        let exponent = libm::floor(libm::log10(size)) as i32;
        let superscript = |digit: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit as usize - '0' as usize);
        let digits = exponent.unsigned_abs().to_string();
        return format!(
            "{:.1}·10⁻{}",
            value / libm::pow(10.0, f64::from(exponent)),
            digits.chars().filter_map(superscript).collect::<String>()
        );
    }
    let is_enough = |digits: &usize| size >= 100.0 / libm::pow(10.0, *digits as f64);
    let text = format!("{value:.*}", (0..5).find(is_enough).unwrap_or(5));
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').into()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::written;

    #[test]
    fn numbers_in_sentences_are_short() {
        let texts = [
            1234.4, 100.0, 12.345, 1.0, 0.1234, 0.5, 0.00012, -0.0000031, 0.0,
        ]
        .map(written);
        assert_eq!(
            texts,
            [
                "1234",
                "100",
                "12.3",
                "1",
                "0.123",
                "0.5",
                "1.2·10⁻⁴",
                "-3.1·10⁻⁶",
                "0"
            ]
        );
    }
}
