//! The command line: one file per sub-command, each a variant of `Command` with its flags and a
//! `run`.
//!
//! A command prints its results to standard output and its messages to standard error (`log.rs`).
//! Flags shared by several commands are in `scene_flags.rs`, `engines.rs` and `measured.rs`. Start
//! reading in `compare.rs`.

mod aov;
mod bench;
mod compare;
mod contents;
mod diagnose;
mod diff;
mod drawing;
mod engines;
mod error;
mod experiments;
mod explain;
mod export;
mod figure;
mod files;
mod frame_times;
mod info;
mod input_name;
mod list;
mod log;
mod measured;
mod memory;
mod mesh_facts;
mod name_template;
#[cfg(not(feature = "view"))]
mod no_view;
mod normal_text;
mod output;
mod polygon_counts;
mod progress;
mod reference_check;
mod render;
mod report;
mod scene_flags;
mod search;
mod shell;
mod signals;
mod span_times;
mod text;
mod tolerance;
mod trace;
mod values;
#[cfg(feature = "view")]
mod view;
mod watch;
mod weights;

use clap::Parser;
use clap::error::ErrorKind;
pub(crate) use error::{CliError, Outcome};
use log::{Log, done};
use std::process::ExitCode;

/// Phong shading on a scanline rasterizer: 38 methods to run, time, look at and check against an
/// f64 reference.
#[derive(clap::Parser, Debug)]
#[command(name = "fastphong", version, arg_required_else_help = true, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Print more to standard error: steps, times, polygons left out
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    verbose: bool,
    /// Print only errors to standard error
    #[arg(short, long, global = true)]
    quiet: bool,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 a comparison failed, 2 wrong usage or input.\n\
    INPUT is a scene file (.toml), a mesh file (.obj .stl .ply .off .gltf .glb), a shape\n\
    builtin:NAME?key=value&key=value, the name of a shipped scene, or `-`: a scene or a mesh on standard input.";

/// The text printed when no command is typed: five commands to try, and where to find help.
const FIRST_STEPS: &str = "\
Draw, time and check 38 ways to shade polygons, from flat to Phong. Five things to try:

  fastphong render builtin:teapot -o teapot.png          a picture; or use your own bunny.ply
  fastphong figure spheres                               Gouraud loses a highlight: drag the sun
  fastphong compare teapot                               one row per method: error and time
  fastphong explain fast-phong                           formula, cost, where it fails
  fastphong report                                       all of it on one page, in half a minute

fastphong --help lists all commands; fastphong list scenes, figures or methods what there is.
";

#[derive(clap::Subcommand, Debug)]
enum Command {
    Render(render::RenderArgs),
    #[cfg(feature = "view")]
    View(view::ViewArgs),
    #[cfg(not(feature = "view"))]
    #[command(hide = true)]
    View(no_view::ViewArgs),
    Report(report::ReportArgs),
    Figure(figure::FigureArgs),
    Export(export::ExportArgs),
    Diff(diff::DiffArgs),
    Diagnose(diagnose::DiagnoseArgs),
    Trace(trace::TraceArgs),
    List(list::ListArgs),
    Explain(explain::ExplainArgs),
    Info(info::InfoArgs),
    Compare(compare::CompareArgs),
    Bench(bench::BenchArgs),
    Search(search::SearchArgs),
    Completions(shell::CompletionsArgs),
    Man(shell::ManArgs),
}

impl Cli {
    /// Runs the sub-command.
    ///
    /// # Errors
    /// [`CliError`] for wrong usage or input.
    fn run(&self) -> Result<Outcome, CliError> {
        engines::check_environment()?;
        let log = Log::new(self.quiet, self.verbose);
        match &self.command {
            Command::Render(command) => command.run(log),
            #[cfg(feature = "view")]
            Command::View(command) => command.run(log),
            #[cfg(not(feature = "view"))]
            Command::View(command) => command.run(),
            Command::Report(command) => command.run(log),
            Command::Figure(command) => command.run(log),
            Command::Export(command) => command.run(log),
            Command::Diff(command) => command.run(log),
            Command::Diagnose(command) => command.run(log),
            Command::Trace(command) => command.run(log),
            Command::List(command) => command.run(),
            Command::Explain(command) => command.run(),
            Command::Info(command) => command.run(log),
            Command::Compare(command) => command.run(log),
            Command::Bench(command) => command.run(log),
            Command::Search(command) => command.run(log),
            Command::Completions(command) => command.run(),
            Command::Man(command) => command.run(),
        }
    }
}

/// Runs the program: reads the flags, runs the command, prints the error, and returns the exit
/// code.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        // A missing command is wrong usage, as in other programs built on clap: a script whose
        // `$COMMAND` is empty should stop.
        Err(message) if message.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            log::to_stderr(FIRST_STEPS);
            return ExitCode::from(2);
        }
        Err(message) if message.use_stderr() => {
            log::to_stderr(&text(&message, log::colour()));
            return ExitCode::from(2);
        }
        // clap returns help and version as errors too, but they are results: they go to standard
        // output.
        Err(message) => {
            let is_coloured = log::is_coloured(&std::io::stdout());
            return end(done(&text(&message, is_coloured)));
        }
    };
    end(cli.run())
}

/// Returns the text of a message from clap, with colours if `is_coloured`.
fn text(message: &clap::Error, is_coloured: bool) -> String {
    let text = message.render();
    if is_coloured {
        text.ansi().to_string()
    } else {
        text.to_string()
    }
}

/// Prints the error, if there is one, and returns the exit code.
fn end(outcome: Result<Outcome, CliError>) -> ExitCode {
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Differs) => ExitCode::from(1),
        Err(error) => {
            log::to_stderr(&error.render(log::colour()));
            ExitCode::from(2)
        }
    }
}
