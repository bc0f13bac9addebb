//! The engine and the instruction set that `auto` chooses for a scene.

use fastphong::frame::Frame;
use fastphong::raster::Renderer;
use fastphong::shading::METHODS;

/// One choice, and the methods that it is made for.
#[derive(serde::Serialize)]
pub struct AutoChoice {
    engine: &'static str,
    level: &'static str,
    reason: Option<&'static str>,
    methods: Vec<&'static str>,
}

/// Returns the choices of `--engine auto --simd auto` on this machine: each once, in the order of the methods.
pub fn auto_choices(frame: &Frame) -> Vec<AutoChoice> {
    let mut choices: Vec<AutoChoice> = Vec::new();
    for entry in METHODS {
        let plan = entry.variant().plan(frame, Renderer::fastest());
        let choice = AutoChoice {
            engine: plan.renderer.engine().name(),
            level: plan.renderer.level().name(),
            reason: plan.reason,
            methods: vec![entry.info.name],
        };
        match choices
            .iter_mut()
            .find(|other| other.head() == choice.head())
        {
            Some(other) => other.methods.extend(choice.methods),
            None => choices.push(choice),
        }
    }
    choices
}

impl AutoChoice {
    fn head(&self) -> (&str, &str, Option<&str>) {
        (self.engine, self.level, self.reason)
    }
}

impl std::fmt::Display for AutoChoice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let reason = self
            .reason
            .map_or(String::new(), |reason| format!(" ({reason})"));
        write!(
            f,
            "{}, {}: {}{reason}",
            self.engine,
            self.level,
            self.methods.join(", ")
        )
    }
}
