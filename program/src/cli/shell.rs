//! `fastphong completions` and `fastphong man`: shell completions and manual pages, made from the
//! definitions of the flags.

use super::contents::Contents;
use super::log::to_stdout_by;
use super::output::{self, ForceFlag, Output};
use super::{Cli, CliError, Outcome};
use clap::{Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;
use std::path::PathBuf;

/// Print a completion script for a shell, to be installed where the shell expects it
#[derive(clap::Args, Debug)]
pub struct CompletionsArgs {
    /// Shell to complete in
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

/// Print the manual page, or write the pages of all commands into a folder
#[derive(clap::Args, Debug)]
pub struct ManArgs {
    /// Folder for the pages fastphong.1, fastphong-render.1, …; it is made if needed
    folder: Option<PathBuf>,
    #[command(flatten)]
    force: ForceFlag,
}

impl ManArgs {
    /// Prints the page, or writes all pages.
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

/// Adds the pages of `command` and its sub-commands.
fn collect(command: &Command, pages: &mut Vec<Man>) {
    pages.push(Man::new(command.clone()));
    let shown = command.get_subcommands().filter(|sub| !sub.is_hide_set());
    shown.for_each(|sub| collect(sub, pages));
}
