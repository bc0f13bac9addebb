//! The `fastphong` command-line tool: parse, run, print the error, exit code.

mod cli;

use clap::Parser;
use clap::error::ErrorKind;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = match cli::Cli::try_parse() {
        Ok(cli) => cli,
        // No command is wrong usage, as clap's other programs have it: a script whose `$COMMAND` is empty should stop.
        Err(message) if message.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            cli::log::to_stderr(cli::FIRST_STEPS);
            return ExitCode::from(2);
        }
        // Help and version are no errors: they go to standard output, with exit code 0.
        Err(message) => {
            // Nobody is left to be told when this cannot be written.
            let _ = message.print();
            return u8::try_from(message.exit_code()).map_or(ExitCode::FAILURE, ExitCode::from);
        }
    };
    match cli.run() {
        Ok(cli::Outcome::Done) => ExitCode::SUCCESS,
        Ok(cli::Outcome::Differs) => ExitCode::from(1),
        Err(error) => {
            cli::log::to_stderr(&error.render(cli::log::colour()));
            ExitCode::from(2)
        }
    }
}
