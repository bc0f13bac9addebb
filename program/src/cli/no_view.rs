//! `fastphong view` in a build without windows: prints how to get one with them.

use super::{CliError, Outcome};
use std::ffi::OsString;

/// Show a scene or a mesh in a window (not in this build: it needs the feature `view`)
#[derive(clap::Args, Debug)]
pub struct ViewArgs {
    #[arg(hide = true, trailing_var_arg = true, allow_hyphen_values = true)]
    _arguments: Vec<OsString>,
}

impl ViewArgs {
    /// Returns the error.
    pub fn run(&self) -> Result<Outcome, CliError> {
        let expected = "expected one that `cargo install --path program --features view` built";
        Err(format!("this fastphong was built without windows: {expected}").into())
    }
}
