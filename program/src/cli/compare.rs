//! `fastphong compare`: error and speed of methods on one scene, as a table.

use super::engines::LectureFlags;
use super::input_name;
use super::measured::{Measurement, TimingFlags, command_line};
use super::scene_flags::{SceneFlags, frame_of};
use super::text::wrapped;
use super::{CliError, Log, Outcome, done, weights};
use crate::compare::comparison::{TableKind, table};
use crate::report::{Document, text_of};
use fastphong::raster::Renderer;
use fastphong::scene::file::shown;
use fastphong::scene::open::Look;

/// Compare methods on one scene: error against the reference, time, speed-up
#[derive(clap::Args, Debug)]
pub struct CompareArgs {
    /// Scene file, mesh file, builtin:NAME?key=value, name of a shipped scene, or `-` for standard
    /// input
    #[arg(value_parser = input_name::parser())]
    input: String,
    #[command(flatten)]
    timing: TimingFlags,
    #[command(flatten)]
    drawn: LectureFlags,
    /// Also print PSNR, SSIM, FLIP, brightness and other errors
    #[arg(long)]
    all_columns: bool,
    /// Print everything as JSON
    #[arg(long, conflicts_with = "all_columns")]
    json: bool,
    /// Compare the ways to weight vertex normals instead of methods
    #[arg(long, conflicts_with_all = ["all_columns", "json", "methods", "time_budget", "engine", "simd", "threads", "normals-weight"])]
    weights: bool,
    #[command(flatten)]
    scene: SceneFlags,
}

impl CompareArgs {
    /// Compares and times the methods, and prints the table.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        if self.weights {
            return self.compare_weights(log);
        }
        let renderer = self.drawn.renderer()?;
        let perceives = self.json || self.all_columns;
        let measurement = Measurement {
            inputs: &[&self.input],
            scene: &self.scene,
            renderers: &[renderer],
            threads: self.drawn.threads,
            log,
            outputs: &[],
        };
        let comparisons = self.timing.compare(&measurement, perceives)?;
        let kind = if self.all_columns {
            TableKind::Compare
        } else {
            TableKind::Short
        };
        let document = Document::new(command_line(), comparisons);
        let text = if self.json {
            document.to_text()
        } else {
            let tables = document.comparisons.iter().map(|c| table(c, kind));
            tables.collect::<String>() + "\n" + &wrapped(&text_of(&document), 0)
        };
        let outcome = done(&text)?;
        if renderer == Renderer::LECTURE {
            log.note("note: drawn as in the lecture, by scalar code; --simd auto compares in the engine that `render` uses");
        }
        Ok(outcome)
    }

    /// Prints the table that compares the weights of vertex normals.
    fn compare_weights(&self, log: Log) -> Result<Outcome, CliError> {
        let opened = self.scene.open(&self.input, Look::Compared, log)?;
        frame_of(&opened, log)?;
        done(&weights::table(shown(&self.input), &opened.scene)?)
    }
}
