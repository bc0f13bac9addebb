//! The page's live view is compiled from the sources as they are.

use std::process::Command;

/// A module of other sources draws other pictures than the program. Who has no target for WebAssembly can work all the same: the test
/// fails only where `CI` is set, and says elsewhere what to do.
#[test]
fn the_module_is_of_these_sources() {
    let check = Command::new("bash")
        .args(["live/build", "--check"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output();
    let said = match check {
        Ok(output) if output.status.success() => return,
        Ok(output) => String::from_utf8_lossy(&output.stderr).into_owned(),
        Err(error) => format!("live/build cannot be run: {error}"),
    };
    assert!(std::env::var_os("CI").is_none(), "{said}");
    eprintln!("{said}");
}
