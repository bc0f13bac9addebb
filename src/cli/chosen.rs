//! The engine and the instruction set that `auto` would choose for a scene, for which methods.

use fastphong::frame::Frame;
use fastphong::raster::{Plan, Renderer};
use fastphong::shading::METHODS;
use serde_json::{Value, json};

/// One choice, and the methods that it is made for.
pub struct Choice {
    plan: Plan,
    methods: Vec<&'static str>,
}

/// Returns the choices of `--engine auto --simd auto` on this machine: each once, in the order of the methods.
pub fn choices(frame: &Frame) -> Vec<Choice> {
    let mut choices: Vec<Choice> = Vec::new();
    for entry in METHODS {
        let variant = entry.variant();
        let plan = variant.plan(frame, Renderer::fastest());
        match choices.iter_mut().find(|choice| choice.plan == plan) {
            Some(choice) => choice.methods.push(entry.info.name),
            None => choices.push(Choice {
                plan,
                methods: vec![entry.info.name],
            }),
        }
    }
    choices
}

impl Choice {
    /// Says the choice in words.
    pub fn text(&self) -> String {
        let Plan { renderer, reason } = self.plan;
        let (engine, level) = (renderer.engine(), renderer.level());
        let reason = reason.map_or(String::new(), |reason| format!(" ({reason})"));
        format!("{engine}, {level}: {}{reason}", self.methods.join(", "))
    }

    /// Returns the choice as data.
    pub fn json(&self) -> Value {
        let Plan { renderer, reason } = self.plan;
        let (engine, level) = (renderer.engine(), renderer.level());
        json!({ "engine": engine.name(), "level": level.name(), "reason": reason, "methods": self.methods })
    }
}
