//! The list of methods.

use fastphong::shading::{METHODS, Tier};
use pyo3::prelude::*;

/// Returns the name and a sentence of each method, for all methods or only for those that
/// comparisons show by default.
#[pyfunction]
pub fn methods(all: bool) -> Vec<(&'static str, &'static str)> {
    let infos = METHODS.iter().map(|method| method.info);
    let shown = infos.filter(|info| all || info.tier == Tier::Default);
    shown.map(|info| (info.name, info.title)).collect()
}
