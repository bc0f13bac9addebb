//! `fastphong view` of a program that was built without windows: says how to get them.

use super::{CliError, Outcome};
use std::ffi::OsString;

/// Show a scene or a mesh in a window (not in this build: it needs the feature `view`)
#[derive(clap::Args, Debug)]
pub struct ViewArgs {
    #[arg(hide = true, trailing_var_arg = true, allow_hyphen_values = true)]
    _arguments: Vec<OsString>,
}

impl ViewArgs {
    /// Refuses.
    pub fn run(&self) -> Result<Outcome, CliError> {
        let expected = "expected one that `cargo install --path . --features view` built";
        Err(format!("this fastphong was built without windows: {expected}").into())
    }
}
