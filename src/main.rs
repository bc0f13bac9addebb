//! The `fastphong` command-line tool. All of it is in the library, in `src/cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    fastphong::cli::main()
}
