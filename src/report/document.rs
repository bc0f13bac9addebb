//! The measured data, as they stand in the page.

use super::Report;
use super::lecture::{FigureData, data};
use super::section::TriangulationData;
use crate::compare::comparison::{ComparisonData, SCHEMA, WHAT_IS_COMPARED, WHAT_IS_TIMED};
use crate::compare::experiments::{Scaling, Speedups};
use crate::compare::timing::Machine;
use alloc::string::String;
use alloc::vec::Vec;
use serde::Serialize;

/// [`crate::compare::comparison::Document`] with more fields, which its readers pass over.
#[derive(Serialize)]
struct Data<'a> {
    schema: &'a str,
    command_line: &'a [String],
    machine: &'a Machine,
    timed: &'a str,
    compared: &'a str,
    date: Option<&'a str>,
    comparisons: Vec<SceneData<'a>>,
    figures: Vec<FigureData<'a>>,
    speedups: Option<&'a Speedups>,
    scaling: Option<&'a Scaling>,
}

#[derive(Serialize)]
struct SceneData<'a> {
    title: &'a str,
    description: &'a str,
    #[serde(flatten)]
    comparison: &'a ComparisonData,
    triangulation: Option<TriangulationData>,
}

/// All of `report` but its pictures.
pub(super) fn json(report: &Report) -> String {
    let comparisons = report.sections.iter().map(|section| SceneData {
        title: &section.caption.title,
        description: &section.caption.description,
        comparison: &section.data,
        triangulation: section.triangulation,
    });
    let all = Data {
        schema: SCHEMA,
        command_line: &report.command_line,
        machine: &report.machine,
        timed: WHAT_IS_TIMED,
        compared: WHAT_IS_COMPARED,
        date: report.date.as_deref(),
        comparisons: comparisons.collect(),
        figures: data(&report.lecture),
        speedups: report.studies.speedups.as_ref(),
        scaling: report.studies.scaling.as_ref(),
    };
    serde_json::to_string(&all).expect("numbers, texts and lists of them")
}
