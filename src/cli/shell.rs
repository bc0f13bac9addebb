//! `fastphong completions` and `fastphong man`: what a shell and a reader of manuals need, made from the flags themselves.

use super::contents::Contents;
use super::log::to_stdout_by;
use super::output::{self, ForceFlag, Output};
use super::{Cli, CliError, Outcome};
use clap::{Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;
use std::path::PathBuf;

/// Print shell completions (install them where your shell expects them)
#[derive(clap::Args, Debug)]
pub struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

impl CompletionsArgs {
    /// Prints the script.
    pub fn run(&self) -> Result<Outcome, CliError> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "fastphong", &mut script);
        to_stdout_by(|out| out.write_all(&script))?;
        Ok(Outcome::Done)
    }
}

/// Print the manual page, or write those of all commands into a folder
#[derive(clap::Args, Debug)]
pub struct ManArgs {
    /// Folder of the pages, which is made if there is none: fastphong.1, fastphong-render.1, …
    folder: Option<PathBuf>,
    #[command(flatten)]
    force: ForceFlag,
}

impl ManArgs {
    /// Prints or writes the pages.
    pub fn run(&self) -> Result<Outcome, CliError> {
        let Some(folder) = &self.folder else {
            to_stdout_by(|out| Man::new(Cli::command()).render(out))?;
            return Ok(Outcome::Done);
        };
        let folder = output::folder("FOLDER", folder)?;
        std::fs::create_dir_all(folder)
            .map_err(|error| format!("{}: cannot be written: {error}", folder.display()))?;
        let mut command = Cli::command().disable_help_subcommand(true);
        command.build();
        let mut pages = Vec::new();
        collect(&command, &mut pages);
        let pages = pages.into_iter().map(|page| {
            let path = folder.join(page.get_filename());
            let output = Output::chosen("FOLDER", path, Contents::Manual, self.force);
            (page, output)
        });
        let pages: Vec<(Man, Output)> = pages.collect();
        output::check(&pages.iter().map(|(_, output)| output).collect::<Vec<_>>())?;
        for (page, output) in &pages {
            output.write(|out| page.render(out))?;
        }
        Ok(Outcome::Done)
    }
}

/// Adds the page of `command` and those of its sub-commands.
fn collect(command: &Command, pages: &mut Vec<Man>) {
    pages.push(Man::new(command.clone()));
    let shown = command.get_subcommands().filter(|sub| !sub.is_hide_set());
    shown.for_each(|sub| collect(sub, pages));
}
