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
        let (engine, level) = (plan.renderer.engine().name(), plan.renderer.level().name());
        let key = (engine, level, plan.reason);
        let mut same = choices
            .iter_mut()
            .filter(|c| (c.engine, c.level, c.reason) == key);
        match same.next() {
            Some(choice) => choice.methods.push(entry.info.name),
            None => choices.push(AutoChoice {
                engine,
                level,
                reason: plan.reason,
                methods: vec![entry.info.name],
            }),
        }
    }
    choices
}

impl std::fmt::Display for AutoChoice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{}, {}: {}",
            self.engine,
            self.level,
            self.methods.join(", ")
        )?;
        self.reason
            .map_or(Ok(()), |reason| write!(f, " ({reason})"))
    }
}
