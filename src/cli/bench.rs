//! `fastphong bench`: times only, method by method, in interleaved rounds; or of whole frames, one method after the other.

use super::engines::{self, Levels, ScanlineEngine, ThreadFlags, renderer_of};
use super::frame_times::{FrameCount, FrameTiming};
use super::measured::{How, TimingFlags, command_line, named_or_shipped};
use super::scene_flags::SceneFlags;
use super::talk::{Talk, to_stdout};
use super::{Failure, Outcome};
use fastphong::compare::comparison::{Document, TableKind, table};
use fastphong::compare::timing::Machine;
use fastphong::picture::image_file::write_file;
use fastphong::raster::Renderer;
use std::path::PathBuf;

/// Time methods on scenes: interleaved rounds, medians with their spread, ratios; or whole frames
#[derive(clap::Args, Debug)]
pub struct Bench {
    /// Scene files, mesh files, builtin:NAME?key=value, or names of shipped scenes [default: all shipped scenes]
    #[arg(value_name = "INPUT")]
    inputs: Vec<String>,
    #[command(flatten)]
    timing: TimingFlags,
    /// Time whole frames, from the prepared scene to the stored picture, one method after the other: a line each, with
    /// `ms_median` and `ms_min`
    #[arg(long, conflicts_with = "time_budget")]
    frame_times: bool,
    #[command(flatten)]
    count: FrameCount,
    /// What finds the pixels: `span`, the lecture's way, one pixel at a time on one thread; `row`, SIMD; or `auto`, `row`
    /// where it can draw the frame [default: span; auto with --frame-times]
    #[arg(long, value_parser = engines::scanline_engine)]
    engine: Option<ScanlineEngine>,
    /// Instruction sets of the pixel loops between commas, or `all` of this machine; `scalar` is the span engine, any other
    /// the row engine, and each is timed for itself [default: scalar; auto with --frame-times]
    #[arg(long, value_name = "LEVELS", value_parser = engines::levels)]
    simd: Option<Levels>,
    #[command(flatten)]
    threads: ThreadFlags,
    /// Write all times to this file as well, as described in docs/bench-json.md; `-` writes them instead of the tables
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    scene: SceneFlags,
}

impl Bench {
    /// Times, and prints the tables.
    pub fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        let talk = *talk;
        let inputs = named_or_shipped(&self.inputs);
        let (machine, renderers) = (Machine::this(), self.renderers()?);
        let how = How {
            renderers: &renderers,
            threads: &self.threads,
        };
        let (text, json) = if self.frame_times {
            let (scene, methods, count) = (&self.scene, &self.timing.methods.0, self.count);
            let times = FrameTiming {
                inputs: &inputs,
                scene,
                methods,
                how,
                count,
            }
            .take(talk)?;
            (times.text(), times.json(&machine, &command_line()))
        } else {
            let comparisons = self.timing.compare(&inputs, &self.scene, how, talk)?;
            let tables = comparisons
                .iter()
                .map(|comparison| table(comparison, TableKind::Bench));
            let text = format!(
                "{}\n\n{}",
                machine.line(),
                tables.collect::<Vec<_>>().join("\n")
            );
            (
                text,
                Document::new(&comparisons, &machine, &command_line()).to_text(),
            )
        };
        match &self.json {
            Some(path) if path.as_os_str() == "-" => {
                return to_stdout(json.as_bytes()).map(|()| Outcome::Done);
            }
            Some(path) => write_file(path, json.as_bytes())?,
            None => {}
        }
        to_stdout(text.as_bytes())?;
        Ok(Outcome::Done)
    }

    /// How to draw: by each instruction set that was asked for. The lecture's own form is what methods are compared in;
    /// whole frames are drawn the fastest way.
    ///
    /// # Errors
    /// When engine and instruction sets contradict each other.
    fn renderers(&self) -> Result<Vec<Renderer>, Failure> {
        let usual = if self.frame_times {
            Renderer::fastest()
        } else {
            Renderer::LECTURE
        };
        Ok(match &self.simd {
            None => vec![renderer_of(self.engine, None, usual)?],
            Some(levels) => levels.renderers(self.engine.and_then(|ScanlineEngine(e)| e))?,
        })
    }
}
