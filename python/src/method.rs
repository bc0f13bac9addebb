//! Methods by their names in Python.

use crate::errors::value_error;
use fastphong::frame::Frame;
use fastphong::raster::Renderer;
use fastphong::reference::Model;
use fastphong::shading::{METHODS, Tier, Variant};
use pyo3::prelude::*;

/// The name of the method that is chosen automatically: it draws naive Phong's picture fastest.
const AUTO: &str = "auto";
/// The name of the `f64` reference. A model may follow after a colon.
const REFERENCE: &str = "reference";

/// A way to draw a picture of a frame.
pub enum Method {
    Auto,
    Reference(Model),
    Variant(Variant),
}

impl Method {
    /// Returns the method called `name`.
    pub fn parse(name: &str) -> PyResult<Method> {
        match name.split_once(':').unwrap_or((name, "")) {
            (AUTO, "") => Ok(Method::Auto),
            (REFERENCE, "") => Ok(Method::Reference(Model::Phong)),
            (REFERENCE, model) => {
                let model = model.trim_start_matches("model=");
                let found = Model::ALL.into_iter().find(|known| known.name() == model);
                let names = Model::ALL.map(Model::name).join(", ");
                let problem = || format!("no closed form is named `{model}`: expected {names}");
                found
                    .map(Method::Reference)
                    .ok_or_else(|| value_error(problem()))
            }
            _ => Ok(Method::Variant(Variant::parse(name).map_err(value_error)?)),
        }
    }

    /// Returns the method that an engine draws `frame` by, or `None` for the reference.
    pub fn variant(&self, frame: &Frame) -> Option<Variant> {
        match self {
            Method::Auto => Some(Variant::auto(frame, Renderer::fastest()).0),
            Method::Reference(_) => None,
            Method::Variant(variant) => Some(variant.clone()),
        }
    }
}

/// Returns the name and a sentence of each method, for all methods or only for those that
/// comparisons show by default.
#[pyfunction]
pub fn methods(all: bool) -> Vec<(&'static str, &'static str)> {
    let infos = METHODS.iter().map(|method| method.info);
    let shown = infos.filter(|info| all || info.tier == Tier::Default);
    shown.map(|info| (info.name, info.title)).collect()
}
