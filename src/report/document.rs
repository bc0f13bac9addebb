//! The report as data: one JSON document, described in `docs/bench-json.md`. The page, Markdown and CSV are views of it.

use crate::compare::comparison::{
    BASELINE, Comparison, ComparisonData, RowData, SCHEMA, Triangulation, WHAT_IS_COMPARED,
    WHAT_IS_TIMED,
};
use crate::compare::experiments::{Scaling, Speedups};
use crate::compare::metrics::Difference;
use crate::compare::timing::Machine;
use crate::lectures::{Figure, FigureContent};
use crate::number::Counts;
use crate::shading::{METHODS, OperationCounts, Variant};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// All that a report says: a document of schema [`SCHEMA`] with more fields, which readers of benchmarks pass over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Document {
    /// [`SCHEMA`].
    pub schema: String,
    /// The command line as typed, program first.
    pub command_line: Vec<String>,
    /// The machine that was timed.
    pub machine: Machine,
    /// [`WHAT_IS_TIMED`].
    pub timed: String,
    /// [`WHAT_IS_COMPARED`].
    pub compared: String,
    /// The day, as [`super::utc_date`] writes it.
    #[serde(default)]
    pub date: Option<String>,
    /// Seconds from the start to the end of measuring and drawing.
    #[serde(default)]
    pub seconds: Option<f64>,
    /// The method that speeds are stated against.
    #[serde(default)]
    pub baseline: String,
    /// All methods that were compared.
    #[serde(default)]
    pub methods: Vec<MethodData>,
    /// The scenes, in the order of the page.
    pub comparisons: Vec<SceneData>,
    /// The figures of the lectures; not read back, as what they show is pictures.
    #[serde(skip_deserializing)]
    pub figures: Vec<FigureData>,
    /// Speeds of all methods over naive Phong's: kernels and frames, scalar and SIMD.
    #[serde(default)]
    pub speedups: Option<Speedups>,
    /// Times over the number of triangles and of pixels, and fitted costs.
    #[serde(default)]
    pub scaling: Option<Scaling>,
}

/// One scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneData {
    /// A few words; the name if empty.
    #[serde(default)]
    pub title: String,
    /// The purpose of the scene; may be empty.
    #[serde(default)]
    pub description: String,
    /// Errors and times.
    #[serde(flatten)]
    pub comparison: ComparisonData,
    /// The effect of cutting its polygons into triangles; `None` if they are triangles.
    #[serde(default)]
    pub triangulation: Option<TriangulationData>,
}

/// A [`Triangulation`] without its picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TriangulationData {
    /// See [`Triangulation::triangles`].
    pub triangles: usize,
    /// See [`Triangulation::not_simple`].
    pub not_simple: usize,
    /// See [`Triangulation::difference`].
    pub difference: Difference,
}

/// The description of a method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodData {
    /// The variant, as a user names it.
    pub name: String,
    /// The name in a sentence.
    pub label: String,
    /// Methods of one family share a hue: the first word of their names.
    pub family: String,
    /// The idea in one line.
    pub title: String,
    /// The formulas, as `fastphong explain` prints them.
    pub formula: String,
    /// The lecture or paper that it comes from.
    pub source: String,
    /// The cases in which it fails.
    pub fails: String,
    /// The treatment of perspective.
    pub perspective: String,
    /// The treatment of lights and eyes at positions.
    pub local: String,
    /// The operations counted, for one light and for four.
    pub operations: Vec<OperationsData>,
}

/// Operations of a method at each rate: additions, multiplications, comparisons, divisions, roots, sines, powers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs)] // as in `OperationCounts`
pub struct OperationsData {
    pub lights: usize,
    pub vertex: [u32; 7],
    pub polygon: [u32; 7],
    pub edge: [u32; 7],
    pub edge_step: [u32; 7],
    pub span: [u32; 7],
    pub walk: [u32; 7],
    pub shade: [u32; 7],
}

/// A figure of the lectures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureData {
    /// The name on the command line.
    pub name: String,
    /// The heading.
    pub title: String,
    /// The place in the lecture that shows or says it.
    pub lecture: String,
    /// Text, pictures and curves, and the findings.
    #[serde(flatten)]
    pub content: FigureContent,
}

impl Document {
    /// Makes a document without scenes.
    pub fn new(machine: Machine, command_line: Vec<String>) -> Document {
        Document {
            schema: SCHEMA.to_string(),
            command_line,
            machine,
            timed: WHAT_IS_TIMED.to_string(),
            compared: WHAT_IS_COMPARED.to_string(),
            date: None,
            seconds: None,
            baseline: BASELINE.to_string(),
            methods: Vec::new(),
            comparisons: Vec::new(),
            figures: Vec::new(),
            speedups: None,
            scaling: None,
        }
    }

    /// Describes every variant that was compared or timed, each once, in the order of the method table.
    pub fn describe_methods(&mut self) {
        let rows = self.comparisons.iter().flat_map(SceneData::all_rows);
        let mut names: Vec<&str> = rows.map(|row| &*row.variant).collect();
        let studied = self.speedups.iter().flat_map(|study| &study.methods);
        names.extend(studied.map(|method| &*method.method));
        let is_first = |i: &usize| !names[..*i].contains(&names[*i]);
        let described = (0..names.len()).filter(is_first).filter_map(|i| {
            let variant = Variant::parse(names[i]).ok()?;
            Some(MethodData::of(&variant))
        });
        let mut methods: Vec<MethodData> = described.collect();
        let place = |method: &MethodData| {
            let is_it = |entry: &&crate::shading::Entry| {
                method.name.split(':').next() == Some(entry.info.name)
            };
            METHODS.iter().position(|entry| is_it(&entry))
        };
        methods.sort_by_key(place);
        self.methods = methods;
    }

    /// Writes it as indented JSON.
    pub fn to_text(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("numbers, texts and lists");
        text.push('\n');
        text
    }
}

impl SceneData {
    /// Makes the data of a comparison.
    pub fn new(
        title: String,
        description: String,
        comparison: &Comparison,
        triangulation: Option<&Triangulation>,
    ) -> SceneData {
        SceneData {
            title,
            description,
            comparison: ComparisonData::from(comparison),
            triangulation: triangulation.map(|t| TriangulationData {
                triangles: t.triangles,
                not_simple: t.not_simple,
                difference: t.difference,
            }),
        }
    }

    /// Returns all rows: those drawn by scanlines, then those of the barycentric renderer.
    pub fn all_rows(&self) -> impl Iterator<Item = &RowData> {
        let c = &self.comparison;
        c.rows.iter().chain(&c.barycentric)
    }

    /// Returns the row of a variant drawn by scanlines.
    pub fn row(&self, variant: &str) -> Option<&RowData> {
        let rows = &self.comparison.rows;
        rows.iter().find(|row| row.variant == variant)
    }

    /// Returns the title, or the name if there is none.
    pub fn title(&self) -> &str {
        match &*self.title {
            "" => &self.comparison.name,
            title => title,
        }
    }
}

impl MethodData {
    /// Describes a variant.
    pub fn of(variant: &Variant) -> MethodData {
        let info = variant.info();
        MethodData {
            name: variant.to_string(),
            label: label(&variant.to_string()),
            family: info.name.split('-').next().unwrap_or_default().to_string(),
            title: info.title.to_string(),
            formula: info.formula.to_string(),
            source: info.source.to_string(),
            fails: info.fails.to_string(),
            perspective: info.perspective.sentence().to_string(),
            local: info.local.sentence().to_string(),
            operations: Vec::from([1, 4].map(|n| OperationsData::of(n, &variant.operations(n)))),
        }
    }
}

impl OperationsData {
    fn of(lights: usize, counts: &OperationCounts) -> OperationsData {
        let list = |c: &Counts| {
            [
                c.additions,
                c.multiplications,
                c.comparisons,
                c.divisions,
                c.roots,
                c.trigonometric,
                c.powers,
            ]
        };
        OperationsData {
            lights,
            vertex: list(&counts.vertex),
            polygon: list(&counts.polygon),
            edge: list(&counts.edge),
            edge_step: list(&counts.edge_step),
            span: list(&counts.span),
            walk: list(&counts.walk),
            shade: list(&counts.shade),
        }
    }
}

impl FigureData {
    /// Describes a figure that was made.
    pub fn new(figure: &Figure, content: FigureContent) -> FigureData {
        FigureData {
            name: figure.name.to_string(),
            title: figure.title.to_string(),
            lecture: figure.lecture.to_string(),
            content,
        }
    }
}

/// Returns a variant's name as it stands in a sentence: `fast Phong rsqrt`, `slerp Phong (steps=2)`.
pub fn label(variant: &str) -> String {
    let (name, parameters) = variant.split_once(':').unwrap_or((variant, ""));
    let capital = |word: &str| match word {
        "phong" | "gouraud" | "duff" | "blinn" | "bishop" | "weimer" => {
            format!("{}{}", word[..1].to_uppercase(), &word[1..])
        }
        word => word.to_string(),
    };
    let words: Vec<String> = name.split('-').map(capital).collect();
    let words = words.join(" ");
    if parameters.is_empty() {
        words
    } else {
        format!("{words} ({parameters})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_names_of_people_and_words() {
        assert_eq!(label("fast-phong-rsqrt"), "fast Phong rsqrt");
        assert_eq!(label("gouraud"), "Gouraud");
        assert_eq!(label("fast-phong:steps=2"), "fast Phong (steps=2)");
    }
}
