//! The command line: one file per sub-command, each a variant of [`Command`] with its flags and a `run`.
//!
//! Results go to standard output, messages to standard error (`log.rs`). Flags that several commands share are in
//! `scene_flags.rs`, `engines.rs` and `measured.rs`. Start reading in `compare.rs`.

mod aov;
mod bench;
mod clamped;
mod compare;
mod contents;
mod depth_notes;
mod diagnose;
mod diff;
mod drawing;
mod engines;
mod error;
mod experiments;
mod explain;
mod figure;
mod files;
mod frame_notes;
mod frame_times;
mod info;
mod input_name;
mod light_rig;
mod list;
pub mod log;
mod measured;
mod memory;
mod mesh_facts;
mod mesh_hints;
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
mod shown_frame;
mod signals;
mod span_times;
mod text;
mod tolerance;
mod trace;
mod unlit;
mod values;
#[cfg(feature = "view")]
mod view;
mod watch;
mod weights;

pub use error::{CliError, Outcome};
use log::{Log, done};

/// Phong shading on a scanline rasterizer: 38 methods to run, time, look at and check against an f64 reference.
#[derive(clap::Parser, Debug)]
#[command(name = "fastphong", version, arg_required_else_help = true, after_help = EXIT_CODES)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Log more to standard error: steps, times, polygons left out
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    verbose: bool,
    /// Log only errors to standard error
    #[arg(short, long, global = true)]
    quiet: bool,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 a comparison failed, 2 wrong usage or input.\n\
    INPUT is a scene file (.toml), a mesh file (.obj .stl .ply .off .gltf .glb), a shape\n\
    builtin:NAME?key=value&key=value, the name of a shipped scene, or `-`: a scene or a mesh on standard input.";

/// Five commands to try, and where help is: what the program says when it is given nothing to do.
pub const FIRST_STEPS: &str = "\
Draw, time and check 38 ways to shade polygons, from flat to Phong. Five things to try:

  fastphong render builtin:teapot -o teapot.png          a picture; or use your own bunny.ply
  fastphong render two-lights -m fast-phong -o fast.png  lights nearby: fast Phong shows facets
  fastphong compare teapot                               one row per method: error and time
  fastphong explain fast-phong                           formula, cost, where it fails
  fastphong report                                       all of it on one page, in half a minute

fastphong --help lists all commands, fastphong list scenes the scenes.
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
    pub fn run(&self) -> Result<Outcome, CliError> {
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
