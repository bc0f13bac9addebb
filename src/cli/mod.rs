//! The command line. A sub-command is one file beside this one: a variant of [`Command`], and a line of
//! [`Command::run`].
//!
//! Results go to standard output, talk to standard error.

mod aov;
mod auto;
mod bench;
mod chosen;
mod compare;
mod diff;
mod drawing;
mod engines;
mod explain;
mod failure;
mod figure;
mod first_steps;
mod frame_times;
mod info;
mod list;
mod measured;
mod mesh_facts;
mod name_template;
mod output;
mod progress;
mod reference_check;
mod render;
mod report;
mod scene_flags;
mod shell;
mod studies;
mod studio;
mod table;
pub mod talk;
mod values;
mod watch;

pub use failure::{Failure, Outcome};
pub use first_steps::FIRST_STEPS;
use talk::Talk;

/// Every way of making Phong shading fast: run it, time it, look at it, trust it.
#[derive(clap::Parser, Debug)]
#[command(name = "fastphong", version, arg_required_else_help = true, after_help = EXIT_CODES)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Say more on standard error: steps, times, what became of the polygons
    #[arg(short, long, global = true, conflicts_with = "quiet")]
    verbose: bool,
    /// Say nothing on standard error but errors
    #[arg(short, long, global = true)]
    quiet: bool,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 a comparison failed, 2 wrong usage or input.\n\
    INPUT is a scene file (.toml), a mesh file (.obj), builtin:NAME?key=value&key=value, or the name of a shipped scene.";

#[derive(clap::Subcommand, Debug)]
enum Command {
    Render(render::Render),
    Report(report::Report),
    Figure(figure::DrawFigures),
    Diff(diff::Diff),
    List(list::List),
    Explain(explain::Explain),
    Info(info::Info),
    Compare(compare::Compare),
    Bench(bench::Bench),
    Completions(shell::Completions),
    #[command(name = "man")]
    Manual(shell::Manual),
}

impl Cli {
    /// Does what was asked for.
    ///
    /// # Errors
    /// [`Failure`] for wrong usage or input.
    pub fn run(&self) -> Result<Outcome, Failure> {
        self.command.run(&Talk::new(self.quiet, self.verbose))
    }
}

impl Command {
    /// Runs the sub-command.
    fn run(&self, talk: &Talk) -> Result<Outcome, Failure> {
        match self {
            Command::Render(command) => command.run(talk),
            Command::Report(command) => command.run(talk),
            Command::Figure(command) => command.run(talk),
            Command::Diff(command) => command.run(talk),
            Command::List(command) => command.run(),
            Command::Explain(command) => command.run(),
            Command::Info(command) => command.run(talk),
            Command::Compare(command) => command.run(talk),
            Command::Bench(command) => command.run(talk),
            Command::Completions(command) => command.run(),
            Command::Manual(command) => command.run(),
        }
    }
}
