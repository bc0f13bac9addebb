//! `fastphong completions` and `fastphong man`: what a shell and a reader of manuals need, made from the flags themselves.

use super::log::to_stdout_by;
use super::{Cli, CliError, Outcome};
use clap::CommandFactory;
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
}

impl ManArgs {
    /// Prints or writes the pages.
    pub fn run(&self) -> Result<Outcome, CliError> {
        let command = Cli::command();
        match &self.folder {
            None => to_stdout_by(|out| Man::new(command).render(out))?,
            Some(folder) => std::fs::create_dir_all(folder)
                .and_then(|()| clap_mangen::generate_to(command, folder))
                .map_err(|error| format!("{}: cannot be written: {error}", folder.display()))?,
        }
        Ok(Outcome::Done)
    }
}
