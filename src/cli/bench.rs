//! `fastphong bench`: times only, method by method, in interleaved rounds.

use super::measured::{TimingFlags, command_line, named_or_shipped};
use super::scene_flags::SceneFlags;
use super::talk::{Talk, to_stdout};
use super::{Failure, Outcome};
use fastphong::bench::Machine;
use fastphong::comparison::{TableKind, table, to_json};
use fastphong::image_file::write_file;
use std::path::PathBuf;

/// Time methods on scenes: interleaved rounds, medians with their spread, ratios
#[derive(clap::Args, Debug)]
pub struct Bench {
    /// Scene files, mesh files, builtin:NAME?key=value, or names of shipped scenes [default: all shipped scenes]
    #[arg(value_name = "INPUT")]
    inputs: Vec<String>,
    #[command(flatten)]
    timing: TimingFlags,
    /// Write all times to this file as well, as described in docs/bench-json.md; `-` writes them instead of the tables
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    scene: SceneFlags,
}

impl Bench {
    /// Times, and prints the tables.
    pub fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        let inputs = named_or_shipped(&self.inputs);
        let comparisons = self.timing.compare(&inputs, &self.scene, *talk)?;
        let machine = Machine::this();
        let json = || format!("{:#}\n", to_json(&comparisons, &machine, &command_line()));
        match &self.json {
            Some(path) if path.as_os_str() == "-" => return to_stdout(json().as_bytes()).map(|()| Outcome::Done),
            Some(path) => write_file(path, json().as_bytes())?,
            None => {}
        }
        let tables = comparisons.iter().map(|comparison| table(comparison, TableKind::Bench));
        let text = format!("{}\n\n{}", machine.line(), tables.collect::<Vec<_>>().join("\n"));
        to_stdout(text.as_bytes())?;
        Ok(Outcome::Done)
    }
}
