//! What a figure is made of: data, with nothing said of how it looks.

use crate::picture::Picture8;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use serde::{Serialize, Serializer};

/// A figure that was made.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Content {
    /// What is shown, from top to bottom.
    pub blocks: Vec<Block>,
    /// What was measured.
    pub findings: Vec<Finding>,
}

impl Content {
    /// The finding with this key.
    pub fn finding(&self, key: &str) -> Option<&Finding> {
        self.findings.iter().find(|finding| finding.key == key)
    }

    /// Adds a paragraph.
    pub fn text(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Text(text.into()));
    }

    /// Adds pictures, so many in a row where there is room.
    pub fn pictures(&mut self, columns: usize, shown: Vec<Shown>) {
        self.blocks.push(Block::Pictures { columns, shown });
    }

    /// Adds curves.
    pub fn plot(&mut self, plot: Plot) {
        self.blocks.push(Block::Plot(plot));
    }

    /// Adds a table.
    pub fn table(&mut self, head: &[&str], rows: Vec<Vec<String>>) {
        self.blocks.push(Block::Table {
            head: head.iter().map(|&cell| cell.into()).collect(),
            rows,
        });
    }

    /// Adds what confirms the lecture if `holds`, else contradicts it; `says` is the sentence of each case.
    pub fn claim(
        &mut self,
        key: impl Into<String>,
        label: impl Into<String>,
        value: (f64, &'static str),
        holds: bool,
        [so, not]: [impl Into<String>; 2],
    ) {
        let says = if holds { so } else { not };
        self.found(Finding::new(
            key,
            label,
            value,
            Agreement::if_holds(holds),
            says,
        ));
    }

    /// Adds what the lecture says nothing of.
    pub fn adds(
        &mut self,
        key: impl Into<String>,
        label: impl Into<String>,
        value: (f64, &'static str),
        says: impl Into<String>,
    ) {
        self.found(Finding::new(key, label, value, Agreement::Adds, says));
    }

    /// Adds what was measured.
    pub fn found(&mut self, finding: Finding) {
        self.findings.push(finding);
    }
}

/// A part of a figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Block {
    /// A paragraph of plain text.
    Text(String),
    /// Pictures side by side.
    Pictures {
        /// How many stand in a row where there is room, 1 or more.
        columns: usize,
        /// The pictures, row by row.
        shown: Vec<Shown>,
    },
    /// Curves.
    Plot(Plot),
    /// Rows of cells; the first cell of a row names it.
    Table {
        /// What the columns hold.
        head: Vec<String>,
        /// As many cells a row as the head has.
        rows: Vec<Vec<String>>,
    },
}

/// A picture with what stands below it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shown {
    /// What stands below it.
    pub caption: String,
    /// What it shows, for who cannot see it.
    pub alt: String,
    /// The picture itself, small: its pixels are shown as squares. It is stored beside the data.
    #[serde(skip)]
    pub picture: Picture8,
}

impl Shown {
    /// A picture with what stands below it, and what it shows, for who cannot see it.
    pub fn new(caption: impl Into<String>, alt: impl Into<String>, picture: Picture8) -> Shown {
        Shown {
            caption: caption.into(),
            alt: alt.into(),
            picture,
        }
    }
}

/// How values are laid out along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// Equal differences are equally long.
    Linear,
    /// Equal ratios are equally long; values that have no logarithm stand at the lower end.
    Log,
}

/// Curves over one another.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plot {
    /// What is shown, in a line.
    pub title: String,
    /// What the horizontal axis holds, with its unit, and its scale.
    pub x: (String, Scale),
    /// What the vertical axis holds, with its unit, and its scale.
    pub y: (String, Scale),
    /// The curves: six at most can be told from one another.
    pub series: Vec<Series>,
    /// Places along the horizontal axis that a line marks, such as edges of polygons.
    pub marks: Vec<f64>,
    /// What stands below, in a sentence or two.
    pub caption: String,
}

/// One curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Series {
    /// What it is called.
    pub label: String,
    /// Its points, in the order in which they are joined; what is not finite is left out.
    #[serde(serialize_with = "five_digits")]
    pub points: Vec<(f64, f64)>,
}

/// Writes points with five significant digits, which no chart can show; `null` for what is not finite.
fn five_digits<S: Serializer>(points: &[(f64, f64)], to: S) -> Result<S::Ok, S::Error> {
    let short = |value: f64| format!("{value:.4e}").parse::<f64>().unwrap_or(value);
    let points = points.iter().map(|(x, y)| (short(*x), short(*y)));
    points.collect::<Vec<_>>().serialize(to)
}

impl Series {
    /// A curve through `points`.
    pub fn new(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Series {
        Series {
            label: label.into(),
            points: points.into_iter().collect(),
        }
    }
}

/// What a measured value says about the lecture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Agreement {
    /// As the lecture says.
    Confirms,
    /// Not as the lecture says.
    Contradicts,
    /// The lecture says nothing of it.
    Adds,
}

impl Agreement {
    /// [`Agreement::Confirms`] if what the lecture says `holds`, else [`Agreement::Contradicts`].
    pub fn if_holds(holds: bool) -> Agreement {
        if holds {
            Agreement::Confirms
        } else {
            Agreement::Contradicts
        }
    }

    /// The word for it: `confirms`, `contradicts` or `adds`.
    pub fn word(self) -> &'static str {
        match self {
            Agreement::Confirms => "confirms",
            Agreement::Contradicts => "contradicts",
            Agreement::Adds => "adds",
        }
    }
}

/// One measured value, and what follows from it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// What programs call it: the same from run to run, unique in its figure.
    pub key: String,
    /// What people call it.
    pub label: String,
    /// The value, finite.
    pub value: f64,
    /// Its unit; empty for a pure number.
    pub unit: String,
    /// What it says about the lecture.
    pub agreement: Agreement,
    /// That in a sentence, which was chosen by the value.
    pub verdict: String,
}

impl Finding {
    /// A measured value, with what follows from it.
    pub fn new(
        key: impl Into<String>,
        label: impl Into<String>,
        (value, unit): (f64, &'static str),
        agreement: Agreement,
        verdict: impl Into<String>,
    ) -> Finding {
        Finding {
            key: key.into(),
            label: label.into(),
            value,
            unit: unit.into(),
            agreement,
            verdict: verdict.into(),
        }
    }
}
