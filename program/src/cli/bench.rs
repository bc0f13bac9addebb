//! `fastphong bench`: times methods against each other in interleaved rounds, or whole frames, one
//! method after the other.

use super::contents::Contents;
use super::engines::{self, ScanlineEngine, Simd, SimdList, ThreadFlags, renderer};
use super::frame_times::{FrameCount, frame_times};
use super::input_name;
use super::measured::{Measurement, TimingFlags, command_line, named_or_shipped};
use super::output::{self, Output};
use super::scene_flags::SceneFlags;
use super::span_times::span_times;
use super::{CliError, Log, Outcome, done};
use crate::compare::comparison::{TableKind, table};
use crate::compare::timing::Machine;
use crate::report::Document;
use fastphong::number::SimdLevel;
use fastphong::raster::Renderer;
use std::path::PathBuf;

/// Time methods on scenes: in interleaved rounds, with medians, spread and speed-ups; or whole
/// frames
#[derive(clap::Args, Debug)]
pub struct BenchArgs {
    /// Scene files, mesh files, builtin:NAME?key=value, names of shipped scenes, or `-` for
    /// standard input [default: all shipped scenes]
    #[arg(value_name = "INPUT", value_parser = input_name::parser())]
    inputs: Vec<String>,
    #[command(flatten)]
    timing: TimingFlags,
    /// Time whole frames, from the prepared scene to the stored picture, one method after the
    /// other; print a line for each, with `ms_typical`, `ms_median` and `ms_min`
    #[arg(long, conflicts_with = "time_budget")]
    frame_times: bool,
    /// Time single spans of 1 to 1024 pixels with one light and with four, shaded by the methods'
    /// scalar loops without an engine
    #[arg(long, conflicts_with_all = SceneFlags::and(&["inputs", "frame_times", "time_budget", "frames", "warmup", "engine", "simd", "threads"]))]
    spans: bool,
    #[command(flatten)]
    count: FrameCount,
    /// Engine that finds the pixels: `span`, as in the lecture, one pixel at a time on one thread;
    /// `row`, with SIMD; or `auto`, which is `row` if it can draw the frame, else `span` [default:
    /// span; auto with --frame-times]
    #[arg(long, value_parser = engines::scanline_engine)]
    engine: Option<ScanlineEngine>,
    /// Instruction sets of the pixel loops, separated by commas, or `all` of this machine; each is
    /// timed separately. `scalar` selects the span engine, any other the row engine [default:
    /// scalar; auto with --frame-times]
    #[arg(long, value_name = "ISA,…", value_parser = engines::simd_list)]
    simd: Option<SimdList>,
    #[command(flatten)]
    threads: ThreadFlags,
    /// Also write all times to this file, as described in docs/bench-json.md; `-` prints them
    /// instead of the tables
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    scene: SceneFlags,
}

impl BenchArgs {
    /// Times the methods and prints the tables.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let json_to = self.json.as_deref();
        let json_to = json_to.map(|path| Output::new("--json", path, Contents::Json));
        let outputs: Vec<&Output> = json_to.iter().collect();
        let measurement = Measurement {
            inputs: &named_or_shipped(&self.inputs),
            scene: &self.scene,
            renderers: &self.renderers()?,
            threads: self.threads,
            log,
            outputs: &outputs,
        };
        let (text, json) = if self.spans {
            output::check(&outputs)?;
            span_times(&self.timing.methods, log)?
        } else if self.frame_times {
            frame_times(&measurement, &self.timing.methods, self.count)?
        } else {
            let comparisons = self.timing.compare(&measurement, false)?;
            let tables = comparisons.iter().map(|c| table(c, TableKind::Bench));
            let tables = tables.collect::<Vec<_>>().join("\n");
            let text = format!("{}\n\n{tables}", Machine::this().line());
            (text, Document::new(command_line(), comparisons).to_text())
        };
        if let Some(json_to) = json_to {
            json_to.write_text(&json)?;
            if json_to.is_stdout() {
                return Ok(Outcome::Done);
            }
        }
        done(&text)
    }

    /// Returns a renderer for each instruction set that was asked for, without duplicates. If none
    /// was, methods are compared in the lecture's span engine, and whole frames are drawn the
    /// fastest way.
    ///
    /// # Errors
    /// If the engine and the instruction sets contradict each other.
    fn renderers(&self) -> Result<Vec<Renderer>, CliError> {
        let default = if self.frame_times {
            Renderer::fastest()
        } else {
            Renderer::LECTURE
        };
        let Some(list) = &self.simd else {
            return Ok(vec![renderer(self.engine, None, default)?]);
        };
        let on = |simd: &Simd| renderer(self.engine, Some(*simd), default);
        let levels = SimdLevel::available().map(Some);
        let possible: SimdList = levels.filter(|simd| on(simd).is_ok()).collect();
        let asked = match (&list[..], &possible[..]) {
            // `all` with an engine that no instruction set fits: asking for `auto` returns the
            // error to print.
            ([], []) => &[None],
            ([], all) => all,
            (named, _) => named,
        };
        let mut renderers = Vec::new();
        for simd in asked {
            let renderer = on(simd)?;
            if !renderers.contains(&renderer) {
                renderers.push(renderer);
            }
        }
        Ok(renderers)
    }
}
