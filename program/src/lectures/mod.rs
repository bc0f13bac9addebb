//! Figures and claims of the lectures: the engines draw each one again and measure it.
//!
//! A figure is one file and one line of [`FIGURES`]. It draws with the same engines as everybody
//! else and returns data: texts, pictures, curves, tables and [`Finding`]s. `crate::report` lays
//! them out. A finding is a key, a label, a value with its unit, its agreement with the lecture and
//! one sentence. The value decides whether the sentence holds.
//!
//! Start with `exercises.rs`. Then read `content.rs` (the data), `fixture.rs` (the scenes that
//! figures draw), `measure.rs` (values measured on pictures) and `prelude.rs` (the names that
//! figures import).
//!
//! ```
//! use fastphong_cli::lectures::Figure;
//!
//! let figure = Figure::named("exercises").expect("it stands in the table");
//! let content = figure.make()?;
//! let sine = content.finding("sine").expect("Exercise 1");
//! // The engine's f32: a rounded normal and a few steps.
//! assert!((sine.value - 0.411504).abs() < 1.0 / f64::from(1 << 22));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod attenuation;
mod barycentric;
mod constant_vectors;
mod content;
mod cs171;
mod depth;
mod diagonal;
mod duff;
mod error;
mod exercises;
mod exponents;
mod fast_vs_naive;
mod fixture;
mod frequency;
mod gates;
mod handle;
mod highlight;
mod illumination;
mod inverse_transpose;
mod mach_bands;
mod measure;
mod newell;
mod newton;
mod normals;
mod painter;
mod perspective;
mod prelude;
mod slerp;
mod spheres;
mod square;
mod stop;
mod supersampling;

pub use content::{Agreement, FigureBlock, FigureContent, Finding, Panel};
#[cfg(test)]
pub(crate) use content::{Plot, Scale, Series};
use error::Result;
pub(crate) use handle::Live;
pub use stop::trace_of_stop;

use alloc::string::String;
use fastphong::number::suggest::unknown;

/// All figures, in the order of the lectures.
pub static FIGURES: &[&Figure] = &[
    &stop::FIGURE,
    &spheres::FIGURE,
    &newell::FIGURE,
    &diagonal::FIGURE,
    &mach_bands::FIGURE,
    &highlight::FIGURE,
    &square::FIGURE,
    &duff::FIGURE,
    &newton::FIGURE,
    &slerp::FIGURE,
    &fast_vs_naive::FIGURE,
    &exercises::FIGURE,
    &frequency::FIGURE,
    &illumination::FIGURE,
    &exponents::FIGURE,
    &attenuation::FIGURE,
    &constant_vectors::FIGURE,
    &inverse_transpose::FIGURE,
    &gates::FIGURE,
    &normals::FIGURE,
    &painter::FIGURE,
    &depth::FIGURE,
    &supersampling::FIGURE,
    &barycentric::FIGURE,
    &cs171::FIGURE,
    &perspective::FIGURE,
];

/// The interactive figures, by their names. They have a table of their own because the report's
/// live view is compiled with these figures only, and the linker can drop the others.
pub static LIVE: &[(&str, &Live)] = &[
    ("stop", &stop::LIVE),
    ("spheres", &spheres::LIVE),
    ("newell", &newell::LIVE),
    ("diagonal", &diagonal::LIVE),
    ("mach-bands", &mach_bands::LIVE),
    ("highlight", &highlight::LIVE),
    ("square", &square::LIVE),
    ("newton", &newton::LIVE),
    ("slerp", &slerp::LIVE),
    ("frequency", &frequency::LIVE),
    ("constant-vectors", &constant_vectors::LIVE),
    ("depth", &depth::LIVE),
    ("supersampling", &supersampling::LIVE),
];

/// A drawing or statement of a lecture, which [`Figure::make`] draws and measures.
#[derive(Debug, serde::Serialize)]
pub struct Figure {
    /// The name for users: lower case, words joined by `-`.
    pub name: &'static str,
    /// The heading.
    pub title: &'static str,
    /// The place in the lectures: `L21` is *Lecture 21: Shading*, `L5` *Lecture 5: Shading*,
    /// `CS171` the notes to Caltech's second assignment.
    pub lecture: &'static str,
    /// The functions that draw and measure it. Each adds its part to the content.
    #[serde(skip)]
    parts: &'static [fn(&mut FigureContent) -> Result],
    /// Its interactive part, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub live: Option<&'static Live>,
}

impl Figure {
    /// Returns the figure called `name`.
    pub fn named(name: &str) -> Option<&'static Figure> {
        FIGURES.iter().copied().find(|figure| figure.name == name)
    }

    /// Finds the figure called `name`.
    ///
    /// # Errors
    /// A sentence with the nearest name, or with all names, if no figure is called `name`.
    pub fn find(name: &str) -> Result<&'static Figure, String> {
        let names = FIGURES.iter().map(|figure| figure.name);
        Figure::named(name).ok_or_else(|| unknown("figure", name, names))
    }

    /// Draws and measures the figure.
    ///
    /// # Errors
    /// An error if one of its meshes, scenes or frames cannot be made.
    pub fn make(&self) -> Result<FigureContent> {
        let mut content = FigureContent::default();
        self.parts.iter().try_for_each(|part| part(&mut content))?;
        Ok(content)
    }
}
