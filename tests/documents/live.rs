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

/// The page holds the module packed, so that everybody loads it: its size stands in `docs/performance.md`, to two digits.
#[test]
fn the_size_of_the_module_is_the_one_that_is_documented() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let module = std::fs::read(root.join("report/live.wasm")).expect("the module");
    let text = std::fs::read_to_string(root.join("docs/performance.md")).expect("the page");
    let (_, after) = text.split_once("- The module has ").expect("its size");
    let stated: f64 = after
        .split(' ')
        .next()
        .and_then(|n| n.parse().ok())
        .expect("a number");
    let found = module.len() as f64 / 1e6;
    // Rounded to a digit after the point, and as much again for what another compiler makes of the same sources.
    assert!(
        (stated - found).abs() <= 0.1,
        "{stated} MB are stated, {found} MB found"
    );
}
