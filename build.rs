//! Passes the compiler's version and options to `fastphong::build`. Only a build script knows the
//! optimisation level.

use std::env;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(rustc)
        .arg("--version")
        .output()
        .ok()
        .and_then(|out| String::from_utf8(out.stdout).ok());
    let version = version.as_deref().map_or("", str::trim);
    println!(
        "cargo::rustc-env=FASTPHONG_RUSTC={}",
        if version.is_empty() {
            "unknown"
        } else {
            version
        }
    );
    println!(
        "cargo::rustc-env=FASTPHONG_PROFILE={}",
        env::var("PROFILE").unwrap_or_default()
    );
    println!(
        "cargo::rustc-env=FASTPHONG_OPT_LEVEL={}",
        env::var("OPT_LEVEL").unwrap_or_default()
    );
}
