//! Flags and steps shared by the commands that compare and time methods.

use super::engines::ThreadFlags;
use super::output::{self, Output};
use super::progress::Progress;
use super::scene_flags::{SceneFlags, frame_of, note_scene};
use super::values::number;
use super::{CliError, Log, memory};
use crate::compare::comparison::{Comparison, Input, compare};
use crate::compare::timing::{Machine, TimeLimits};
use fastphong::number::NameError;
use fastphong::raster::Renderer;
use fastphong::scene::input::SCENES;
use fastphong::scene::open::{Look, Opened};
use fastphong::shading::{Family, METHODS, MethodRow, Tier, Variant};
use std::collections::HashSet;
use std::time::Duration;

/// The methods to compare.
pub type Methods = Vec<Variant>;

/// Reads methods separated by commas, and removes duplicates. A group stands for several methods:
/// `default`, `all`, `floats`, `integers`, `exhibits`, or a [`Family`].
pub fn methods(text: &str) -> Result<Methods, NameError> {
    let those = |is_meant: &dyn Fn(&MethodRow) -> bool| -> Methods {
        let entries = METHODS.iter().filter(|entry| is_meant(entry));
        entries.map(MethodRow::variant).collect()
    };
    let mut methods = Methods::new();
    for name in text.split(',') {
        let name = name.trim();
        let family = Family::ALL.into_iter().find(|family| family.name() == name);
        methods.extend(match (name, family) {
            (_, Some(family)) => those(&|entry| entry.info.family == family && !entry.is_integer),
            ("default", _) => those(&|entry| entry.info.tier == Tier::Default),
            ("all", _) => those(&|_| true),
            ("floats", _) => those(&|entry| !entry.is_integer),
            ("integers", _) => those(&|entry| entry.is_integer),
            ("exhibits", _) => those(&|entry| entry.info.tier == Tier::Exhibit),
            _ => vec![Variant::parse(name)?],
        });
    }
    let mut names = HashSet::new();
    methods.retain(|method| names.insert(method.to_string()));
    Ok(methods)
}

/// Reads a duration in seconds.
pub fn seconds(text: &str) -> Result<Duration, String> {
    // A million seconds are 11 days.
    let is_duration = |seconds: &f64| (0.0..=1e6).contains(seconds);
    let seconds = number(text, "seconds: a number from 0 to 1000000", is_duration);
    seconds.map(Duration::from_secs_f64)
}

/// Scenes to measure, with one renderer after the other.
pub struct Measurement<'a> {
    pub inputs: &'a [&'a str],
    pub scene: &'a SceneFlags,
    pub renderers: &'a [Renderer],
    pub threads: ThreadFlags,
    pub log: Log,
    /// The files that the command will write.
    pub outputs: &'a [&'a Output],
}

impl Measurement<'_> {
    /// Calls `measure` with the name and the scene of each input. Loads every input
    /// first, so that a bad one fails at once.
    ///
    /// # Errors
    /// If an input cannot be loaded or is also an output, or `measure` fails.
    pub fn each_scene(
        &self,
        mut measure: impl FnMut(&str, Opened, &Progress) -> Result<(), CliError>,
    ) -> Result<(), CliError> {
        warn_of_debug_build(self.log);
        let files = self.inputs.iter().map(|name| self.scene.read(name));
        let files = files.collect::<Result<Vec<_>, _>>()?;
        output::check_places(self.outputs)?;
        let progress = Progress::silent_between_moves(self.log);
        for (name, file) in self.inputs.iter().zip(files) {
            let opened = self.scene.open_file(file, Look::Compared)?;
            output::check(self.outputs)?;
            progress.aside(|| note_scene(&opened, self.log));
            measure(name, opened, &progress)?;
        }
        Ok(())
    }
}

/// The flags for the methods and for the time to spend.
#[derive(clap::Args, Debug)]
pub struct TimingFlags {
    /// Methods separated by commas, with parameters as in `fast-phong:steps=1`, or groups of
    /// methods: `default`, `colours`, `roots`, `series`, `quadratics`, `angles`, `highlights`,
    /// `hybrids`, `exhibits`, `floats`, `integers` (for processors without a floating-point unit),
    /// `all`; naive-phong is always included
    #[arg(short, long, visible_alias = "method", value_name = "METHODS", default_value = "default", value_parser = methods)]
    pub methods: Methods,
    /// Seconds of timing per scene, at most: it ends when every ratio is known to 2.5 %. There are
    /// at least three rounds
    #[arg(long, value_name = "SECONDS", default_value = "2", value_parser = seconds, allow_hyphen_values = true)]
    pub time_budget: Duration,
}

impl TimingFlags {
    /// Draws, compares and times every scene with every renderer, and shows progress if it takes
    /// long. `perceives` asks for mean ꟻLIP too. Pictures are not kept.
    pub fn compare(
        &self,
        of: &Measurement<'_>,
        perceives: bool,
    ) -> Result<Vec<Comparison>, CliError> {
        let turns = (of.inputs.len() * of.renderers.len()) as f32;
        let mut comparisons = Vec::new();
        of.each_scene(|name, opened, progress| {
            let frame = progress.aside(|| frame_of(&opened, of.log))?;
            progress.aside(|| memory::check(&frame, &self.methods, 1, of.log))?;
            drop(opened);
            let input = Input {
                name: name.to_owned(),
                frame: &frame,
            };
            for renderer in of.renderers {
                let turn = comparisons.len() as f32;
                let limits = Some(TimeLimits {
                    time_budget: self.time_budget,
                    ..TimeLimits::default()
                });
                let progress = &mut |part: f32, next: &str| {
                    progress.at((turn + part) / turns, &format!("{name}: {next}"));
                };
                let compare = || compare(&input, &self.methods, *renderer, limits, progress);
                let mut comparison = of.threads.install_for(*renderer, compare)?;
                if perceives {
                    comparison.perceive();
                }
                comparison.drop_pictures();
                comparisons.push(comparison);
            }
            Ok(())
        })?;
        Ok(comparisons)
    }
}

/// Warns if this is a debug build, whose times say nothing.
pub fn warn_of_debug_build(log: Log) {
    if Machine::this().profile != "release" {
        log.warning("built without optimisation: the times say nothing (cargo build --release)");
    }
}

/// Returns the named inputs, or all shipped scenes if there are none.
pub fn named_or_shipped(inputs: &[String]) -> Vec<&str> {
    match inputs {
        [] => SCENES.iter().map(|scene| scene.name).collect(),
        inputs => inputs.iter().map(String::as_str).collect(),
    }
}

/// Returns the command line as typed, with the program's name instead of its path.
pub fn command_line() -> Vec<String> {
    let words = std::iter::once("fastphong".into()).chain(std::env::args_os().skip(1));
    words
        .map(|word| word.to_string_lossy().into_owned())
        .collect()
}
