//! Checks that the page's live view was compiled from the current sources.

use std::process::Command;

/// A module made from other sources would draw other pictures than the program. Contributors
/// without a WebAssembly target can still work: the test fails only if `CI` is set, and otherwise
/// prints what to do.
#[test]
fn the_module_was_made_from_the_current_sources() {
    let check = Command::new("bash")
        .args(["live/build", "--check"])
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
        .output();
    let said = match check {
        Ok(output) if output.status.success() => return,
        Ok(output) => String::from_utf8_lossy(&output.stderr).into_owned(),
        Err(error) => format!("live/build cannot be run: {error}"),
    };
    assert!(std::env::var_os("CI").is_none(), "{said}");
    eprintln!("{said}");
}

/// The page contains the packed module, so every reader loads it. `docs/performance.md` states its
/// size, to two digits.
#[test]
fn the_size_of_the_module_is_documented() {
    let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let module = std::fs::read(root.join("report/live.wasm")).expect("the module");
    let text = std::fs::read_to_string(root.join("docs/performance.md")).expect("the page");
    let (_, after) = text.split_once("- The module has ").expect("its size");
    let stated: f64 = after
        .split(' ')
        .next()
        .and_then(|n| n.parse().ok())
        .expect("a number");
    let found = module.len() as f64 / 1e6;
    // The stated size is rounded to one decimal. Another compiler may change the module by as much
    // again.
    assert!(
        (stated - found).abs() <= 0.1,
        "{stated} MB are stated, {found} MB found"
    );
}
