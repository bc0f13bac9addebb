//! The report: every method on every scene, in pictures and numbers, as one page that needs nothing else.
//!
//! Data becomes HTML here, and nothing is computed from polygons: a [`Section`] takes a [`crate::compare::comparison::Comparison`],
//! a [`Report`] takes sections. Sentences choose their words by what was measured; the page holds no verdict of its own.
//!
//! ```
//! use fastphong::compare::comparison::{Input, Options, compare, triangulation};
//! use fastphong::compare::timing::Machine;
//! use fastphong::mesh::builtin::builtin;
//! use fastphong::report::{Caption, Detail, Report, Section, Studies};
//! use fastphong::scene::Scene;
//! use fastphong::shading::METHODS;
//!
//! let mut scene = Scene::of_mesh(builtin("sphere?rings=8&segments=16")?);
//! (scene.width, scene.height) = (48, 36);
//! let frame = scene.frame()?;
//! let variants: Vec<_> = METHODS.iter().map(|entry| entry.variant()).collect();
//! let input = Input { name: "sphere".into(), frame: &frame };
//! let comparison = compare(&input, &variants, &Options { timing: None, ..Options::default() }, &mut |_, _| {});
//! let triangles = triangulation(&frame, &comparison.reference);
//!
//! let caption = Caption { title: "Sphere".into(), description: "Eight rings.".into() };
//! let section = Section::new(caption, &comparison, triangles.as_ref(), Detail::Full)?;
//! let report = Report {
//!     sections: vec![section],
//!     lecture: vec![],
//!     studies: Studies::default(),
//!     machine: Machine::this(),
//!     command_line: vec!["fastphong".into(), "report".into()],
//!     date: None,
//! };
//! assert!(report.html().starts_with("<!DOCTYPE html>"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod charts;
mod date;
mod document;
mod encode;
mod html;
mod lecture;
mod markdown;
mod operations;
mod page;
mod plot;
mod ratio_chart;
mod scaling;
mod scene;
mod section;
mod sentences;
mod speedups;
#[cfg(test)]
mod study_tests;
mod summary;
mod tables;
#[cfg(test)]
mod tests;

pub use date::utc_date;
pub use lecture::{FIGURES_SCHEMA, LectureFigure, figures_page};
pub use markdown::{Image, Markdown};
pub use section::{Caption, Detail, MAP_SCALE, Section, TriangulationData};

use crate::compare::experiments::{Scaling, Speedups};
use crate::compare::timing::Machine;
use alloc::string::String;
use alloc::vec::Vec;

/// Scenes, and what they were measured on.
#[derive(Clone, Debug)]
pub struct Report {
    /// The scenes, in the order of the page.
    pub sections: Vec<Section>,
    /// The lecture's figures, made anew; may be empty.
    pub lecture: Vec<LectureFigure>,
    /// What was measured beside the scenes.
    pub studies: Studies,
    /// What the times are of.
    pub machine: Machine,
    /// What was typed, program first.
    pub command_line: Vec<String>,
    /// The day, as [`utc_date`] writes it.
    pub date: Option<String>,
}

/// What a report says beside its scenes.
#[derive(Clone, Debug, Default)]
pub struct Studies {
    /// What fast Phong gained when it was invented, and what is left of it.
    pub speedups: Option<Speedups>,
    /// How cost grows with triangles and pixels.
    pub scaling: Option<Scaling>,
}

impl Report {
    /// The page: one file that loads nothing, from the network or elsewhere.
    pub fn html(&self) -> String {
        page::page(self)
    }

    /// The same in short for the front page of a repository: text, and picture files that stand in the folder `images`
    /// beside it.
    pub fn markdown(&self, images: &str) -> Markdown {
        markdown::markdown(self, images)
    }

    /// The measured data as JSON of schema [`crate::compare::comparison::SCHEMA`], with what the report adds to it.
    pub fn json(&self) -> String {
        document::json(self)
    }
}
