//! The `fastphong` command-line tool. All of it is in the library, in `cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    fastphong_cli::cli::main()
}
