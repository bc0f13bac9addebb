//! The engine and the instruction set that `auto` chooses for a scene.

use fastphong::frame::Frame;
use fastphong::raster::{Plan, Renderer};
use fastphong::shading::METHODS;
use serde_json::{Value, json};

/// One choice, and the methods that it is made for.
pub struct AutoChoice {
    plan: Plan,
    methods: Vec<&'static str>,
}

/// Returns the choices of `--engine auto --simd auto` on this machine: each once, in the order of the methods.
pub fn auto_choices(frame: &Frame) -> Vec<AutoChoice> {
    let mut choices: Vec<AutoChoice> = Vec::new();
    for entry in METHODS {
        let plan = entry.variant().plan(frame, Renderer::fastest());
        let methods = vec![entry.info.name];
        match choices.iter_mut().find(|choice| choice.plan == plan) {
            Some(choice) => choice.methods.extend(methods),
            None => choices.push(AutoChoice { plan, methods }),
        }
    }
    choices
}

impl AutoChoice {
    /// Writes the choice in words.
    pub fn text(&self) -> String {
        let Plan { renderer, reason } = self.plan;
        let (engine, level) = (renderer.engine(), renderer.level());
        let reason = reason.map_or(String::new(), |reason| format!(" ({reason})"));
        format!("{engine}, {level}: {}{reason}", self.methods.join(", "))
    }

    /// Returns the choice as data.
    pub fn json(&self) -> Value {
        let Plan { renderer, reason } = self.plan;
        let (engine, level) = (renderer.engine().name(), renderer.level().name());
        json!({ "engine": engine, "level": level, "reason": reason, "methods": self.methods })
    }
}
