//! What the commands that compare and time methods have in common.

use super::Failure;
use super::engines::ThreadFlags;
use super::progress::Progress;
use super::scene_flags::SceneFlags;
use super::talk::Talk;
use fastphong::compare::comparison::{Comparison, Input, Options, compare};
use fastphong::compare::timing::{Limits, Machine};
use fastphong::raster::Renderer;
use fastphong::scene::input::{self, SCENES};
use fastphong::shading::{METHODS, Variant};
use std::time::Duration;

/// The methods to compare.
#[derive(Clone, Debug)]
pub struct Methods(pub Vec<Variant>);

/// Methods between commas, each once, or `all`.
pub fn methods(text: &str) -> Result<Methods, String> {
    if text == "all" {
        return Ok(Methods(
            METHODS.iter().map(|entry| entry.variant()).collect(),
        ));
    }
    let mut variants: Vec<Variant> = Vec::new();
    for name in text.split(',') {
        let variant = Variant::parse(name.trim()).map_err(|error| error.to_string())?;
        if variants
            .iter()
            .all(|other| other.to_string() != variant.to_string())
        {
            variants.push(variant);
        }
    }
    Ok(Methods(variants))
}

/// A length of time in seconds.
pub fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text
        .parse()
        .ok()
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds.ok_or_else(|| "expected seconds: a number, 0 or more".to_owned())
}

/// By what, one after the other, and on how many threads methods are drawn.
#[derive(Clone, Copy)]
pub struct How<'a> {
    pub renderers: &'a [Renderer],
    pub threads: &'a ThreadFlags,
}

/// The flags that say what is timed, and for how long.
#[derive(clap::Args, Debug)]
pub struct TimingFlags {
    /// Methods between commas, with parameters as in `fast-phong:steps=1`, or `all`; naive-phong is always among them
    #[arg(short, long, value_name = "METHODS", default_value = "all", value_parser = methods)]
    pub methods: Methods,
    /// Seconds of timing a scene, at least five rounds of all methods
    #[arg(long, value_name = "SECONDS", default_value = "2", value_parser = seconds, allow_hyphen_values = true)]
    pub time_budget: Duration,
}

impl TimingFlags {
    /// How to draw, and how long to take times.
    pub fn options(&self, renderer: Renderer) -> Options {
        Options {
            timing: Some(Limits {
                time_budget: self.time_budget,
                ..Limits::default()
            }),
            renderer,
        }
    }

    /// Draws, compares and times every input by every renderer, with a progress bar where it takes long.
    pub fn compare(
        &self,
        inputs: &[&str],
        scene: &SceneFlags,
        how: How<'_>,
        talk: Talk,
    ) -> Result<Vec<Comparison>, Failure> {
        warn_of_debug_build(talk);
        let renderers = how.renderers;
        // What can fail at once does so before the first minute is spent.
        let files = inputs
            .iter()
            .map(|name| scene.load(name))
            .collect::<Result<Vec<_>, _>>()?;
        let progress = Progress::silent_between_moves(talk);
        let mut comparisons = Vec::with_capacity(files.len() * renderers.len());
        for (number, (name, file)) in inputs.iter().zip(&files).enumerate() {
            let told = |part: f32, what: &str| {
                progress.at(
                    (number as f32 + part) / files.len() as f32,
                    &format!("{name}: {what}"),
                );
            };
            told(0.0, "loading");
            let resolved = input::resolve(file)?;
            progress.aside(|| scene.warn(&resolved, talk));
            let frame = resolved.scene.frame()?;
            drop(resolved);
            let input = Input {
                name: (*name).to_owned(),
                frame: &frame,
            };
            for (turn, renderer) in renderers.iter().enumerate() {
                let told = |part: f32, what: &str| {
                    told((turn as f32 + part) / renderers.len() as f32, what)
                };
                let (methods, options) = (&self.methods.0, self.options(*renderer));
                let compare = || {
                    compare(&input, methods, &options, &mut |part, what| {
                        told(part, what)
                    })
                };
                comparisons.push(how.threads.install_for(*renderer, compare)?);
            }
        }
        Ok(comparisons)
    }
}

/// Says that times of a build for finding mistakes are none.
pub fn warn_of_debug_build(talk: Talk) {
    if Machine::this().profile != "release" {
        talk.warning("built without optimisation: the times say nothing (cargo build --release)");
    }
}

/// The inputs that were named, or all shipped scenes.
pub fn named_or_shipped(inputs: &[String]) -> Vec<&str> {
    match inputs {
        [] => SCENES.iter().map(|scene| scene.name).collect(),
        inputs => inputs.iter().map(String::as_str).collect(),
    }
}

/// What was typed, with the program by its name and not by its place.
pub fn command_line() -> Vec<String> {
    let typed = std::env::args_os()
        .skip(1)
        .map(|word| word.to_string_lossy().into_owned());
    std::iter::once("fastphong".to_owned())
        .chain(typed)
        .collect()
}
