//! The lecture's figures and claims, each made anew by the engines, with the measured number beside it.
//!
//! A figure is one file beside this one and one line of [`FIGURES`]. It computes from what everybody can call: frames,
//! methods, the reference, walks, metrics. What it gives are texts, pictures, curves, tables and [`Finding`]s; how they
//! look on a page is the business of [`crate::report`]. No number is written down in a figure: sentences choose their
//! words by what was measured.
//!
//! ```
//! use fastphong::lectures::Figure;
//!
//! let figure = Figure::named("exercises").expect("it stands in the table");
//! let content = figure.make()?;
//! let sine = content.finding("sine").expect("Exercise 1");
//! // The engine's f32: a rounded normal and a few steps.
//! assert!((sine.value - 0.411504).abs() < 1.0 / f64::from(1 << 22));
//! # Ok::<(), fastphong::lectures::FigureError>(())
//! ```

mod attenuation;
mod barycentric;
mod constant_vectors;
mod content;
mod cs171;
mod depth;
mod duff;
mod error;
mod exercises;
mod exponents;
mod fast_vs_naive;
mod frequency;
mod gates;
mod illumination;
mod inverse_transpose;
mod lit;
mod mach_bands;
mod newell;
mod newton;
mod normals;
mod painter;
mod perspective;
mod profile;
mod slerp;
mod square;
mod stage;
mod supersampling;

pub use content::{Agreement, Block, Content, Finding, Plot, Scale, Series, Shown};
pub use error::FigureError;

use crate::number::suggest::nearest;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// All figures, in the order of the lectures. A figure is one file beside this one, and one line here.
pub static FIGURES: &[&Figure] = &[
    &newell::FIGURE,
    &mach_bands::FIGURE,
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

/// One thing that a lecture shows or says, to be made anew.
#[derive(Debug, serde::Serialize)]
pub struct Figure {
    /// What users call it: lower case, words joined by `-`.
    pub name: &'static str,
    /// What it shows, as a heading.
    pub title: &'static str,
    /// Where the lecture shows or says it: `L21` is *Lecture 21: Shading*, `L5` *Lecture 5: Shading*, `CS171` the notes to
    /// Caltech's second assignment.
    pub lecture: &'static str,
    #[serde(skip)]
    make: fn() -> Result<Content, FigureError>,
}

impl Figure {
    /// The figure called `name`.
    pub fn named(name: &str) -> Option<&'static Figure> {
        FIGURES.iter().copied().find(|figure| figure.name == name)
    }

    /// The figure called `name`, or a sentence that says which there are.
    ///
    /// # Errors
    /// The sentence, if there is no such figure.
    pub fn find(name: &str) -> Result<&'static Figure, String> {
        let names = || FIGURES.iter().map(|figure| figure.name);
        Figure::named(name).ok_or_else(|| match nearest(name, names()) {
            Some(near) => format!("unknown figure `{name}`: did you mean `{near}`?"),
            None => {
                let all: Vec<String> = names().map(|name| format!("`{name}`")).collect();
                format!(
                    "unknown figure `{name}`: expected one of {}",
                    all.join(", ")
                )
            }
        })
    }

    /// Draws and measures it.
    ///
    /// # Errors
    /// [`FigureError`] when what it draws cannot be made.
    pub fn make(&self) -> Result<Content, FigureError> {
        (self.make)()
    }
}
