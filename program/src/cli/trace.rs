//! `fastphong trace`: records what the span engine does with a scene, line by line.

use super::contents::Contents;
use super::output::{self, Output};
use super::scene_flags::{SceneFlags, frame_of, note_scene};
use super::{CliError, Log, Outcome, input_name};
use fastphong::frame::Frame;
use fastphong::scene::open::Look;
use fastphong::shading::Variant;
use std::path::PathBuf;

/// Print what the span engine does with a scene, step by step, as JSON: edges, crossings, spans,
/// values of each pixel
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub struct TraceArgs {
    /// Scene file, mesh file, builtin:NAME?key=value, name of a shipped scene, or `-` for standard
    /// input; a mesh without a scene as `compare` draws it
    #[arg(value_parser = input_name::parser())]
    input: String,
    /// Method, with parameters as in `fast-phong:steps=1`
    #[arg(short, long, value_name = "METHOD", value_parser = Variant::parse, default_value = "naive-phong")]
    method: Variant,
    /// Trace only this line, counted from 0 at the top, with the polygons that cross it
    #[arg(long, value_name = "Y")]
    line: Option<usize>,
    /// File to write, `-` for standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
    #[command(flatten)]
    scene: SceneFlags,
}

const AFTER: &str = "docs/trace.md describes the document. `fastphong figure stop` makes a page on which you can step through one.";

/// The largest side of a frame that is traced as a whole, in samples. Nobody would read a longer
/// trace.
const MOST_SIDE: usize = 64;
/// The most polygons of a frame that is traced as a whole.
const MOST_POLYGONS: usize = 10_000;

impl TraceArgs {
    /// Traces the scene and writes the document.
    pub fn run(&self, log: Log) -> Result<Outcome, CliError> {
        let output = Output::new("--output", &self.output, Contents::Json);
        let file = self.scene.read(&self.input)?;
        output::check(&[&output])?;
        let opened = self.scene.open_file(file, Look::Compared)?;
        note_scene(&opened, log);
        let frame = frame_of(&opened, log)?;
        self.check(&frame)?;
        let trace = self.method.trace(&frame, self.line);
        let trace = trace.map_err(|error| format!("`{}`: {error}", self.method))?;
        output.write_text(&(serde_json::to_string(&trace)? + "\n"))?;
        if !output.is_stdout() {
            output::print_beside(&[&output], &output::written(&[&output]))?;
        }
        Ok(Outcome::Done)
    }

    /// Checks that the frame has the line, or without `--line`, that it is small enough.
    fn check(&self, frame: &Frame) -> Result<(), CliError> {
        let (width, height) = (frame.width(), frame.height());
        let samples = match frame.samples() {
            1 => String::new(),
            n => format!(", {n} × {n} a pixel"),
        };
        if let Some(line) = self.line {
            if line < height {
                return Ok(());
            }
            let most = height - 1;
            return Err(format!(
                "--line {line}: expected at most {most}: the picture has {height} lines{samples}"
            )
            .into());
        }
        let way = "--line traces a single line";
        if width > MOST_SIDE || height > MOST_SIDE {
            let expected =
                format!("expected at most {MOST_SIDE}x{MOST_SIDE}, as with --resolution 64x48");
            return Err(format!(
                "the picture has {width}x{height} samples{samples}: {expected}; or {way}"
            )
            .into());
        }
        let polygons = frame.polygons().len();
        if polygons > MOST_POLYGONS {
            return Err(format!(
                "{polygons} polygons are in view: expected at most {MOST_POLYGONS}; or {way}"
            )
            .into());
        }
        Ok(())
    }
}
