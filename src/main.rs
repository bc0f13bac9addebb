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
        Err(message) if message.use_stderr() => {
            cli::log::to_stderr(&text(&message, cli::log::colour()));
            return ExitCode::from(2);
        }
        // Help and version are no errors but results.
        Err(message) => {
            let is_coloured = cli::log::is_coloured(&std::io::stdout());
            return end(cli::log::done(&text(&message, is_coloured)));
        }
    };
    end(cli.run())
}

/// Returns the text of a message of the parser.
fn text(message: &clap::Error, is_coloured: bool) -> String {
    let text = message.render();
    match is_coloured {
        true => text.ansi().to_string(),
        false => text.to_string(),
    }
}

/// Prints the error, if there is one, and returns the exit code.
fn end(outcome: Result<cli::Outcome, cli::CliError>) -> ExitCode {
    match outcome {
        Ok(cli::Outcome::Done) => ExitCode::SUCCESS,
        Ok(cli::Outcome::Differs) => ExitCode::from(1),
        Err(error) => {
            cli::log::to_stderr(&error.render(cli::log::colour()));
            ExitCode::from(2)
        }
    }
}
