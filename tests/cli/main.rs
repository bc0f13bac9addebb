//! The command line as a user calls it: exit codes and messages for good and bad input.

mod aov;
mod bench;
mod bench_json;
mod defaults;
mod diagnose;
mod diff;
mod doors;
mod engines;
mod export;
mod exported;
mod figure;
mod files;
mod flag_pairs;
mod flags;
mod folders;
mod formats;
mod geometry;
#[cfg(unix)]
mod grading;
mod hints;
mod input;
mod light_rig;
mod memory;
mod name_template;
mod output;
mod outputs;
mod redrawn;
mod reference;
mod render;
mod report;
mod search;
mod shell;
mod signals;
mod tables;
mod tolerance;
mod trace;
mod view;
mod watch;
mod winding;

use fastphong::picture::Picture8;
use fastphong::raster::Renderer;
use fastphong::shading::{METHODS, MethodRow};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// An empty folder in which commands run. It is removed on drop.
struct Folder(TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().expect("an empty folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> &Folder {
        std::fs::write(self.path(name), bytes).expect("a written file");
        self
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Returns the names of all files, sorted.
    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).expect("the folder");
        let mut names: Vec<String> = entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        names
    }

    /// Runs `fastphong` with space-separated `arguments`.
    fn run(&self, arguments: &str) -> Ended {
        let output = self.command(arguments).output().expect("the tool runs");
        Ended::new(arguments, output)
    }

    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_fastphong"));
        command
            .args(arguments.split_whitespace())
            .current_dir(&self.0)
            .stdin(Stdio::null())
            .env_remove("NO_COLOR");
        command
    }
}

/// The outcome of a command.
struct Ended {
    arguments: String,
    code: Option<i32>,
    bytes: Vec<u8>,
    out: String,
    err: String,
}

impl Ended {
    fn new(arguments: &str, output: Output) -> Ended {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let (out, err) = (text(&output.stdout), text(&output.stderr));
        assert!(!err.contains("panicked"), "`{arguments}` panicked: {err}");
        Ended {
            arguments: arguments.to_owned(),
            code: output.status.code(),
            bytes: output.stdout,
            out,
            err,
        }
    }

    /// Asserts exit code 0.
    #[track_caller]
    fn done(self) -> Ended {
        self.exits(0)
    }

    /// Asserts exit code 1: the run worked, and pictures differ.
    #[track_caller]
    fn differs(self) -> Ended {
        self.exits(1)
    }

    #[track_caller]
    fn exits(self, code: i32) -> Ended {
        let (arguments, out, err) = (&self.arguments, &self.out, &self.err);
        assert_eq!(self.code, Some(code), "`{arguments}`: {out}{err}");
        self
    }

    /// Asserts exit code 2, an empty standard output, and one error that contains each of `parts`.
    #[track_caller]
    fn refused(self, parts: &[&str]) -> Ended {
        let (arguments, out, err) = (&self.arguments, &self.out, &self.err);
        assert_eq!(self.code, Some(2), "`{arguments}`: {out}{err}");
        assert_eq!(out, "", "`{arguments}`");
        assert_eq!(err.matches("error: ").count(), 1, "`{arguments}`: {err}");
        for part in parts {
            assert!(
                err.contains(part),
                "`{arguments}` does not say `{part}`: {err}"
            );
        }
        self
    }

    /// Asserts that standard error contains `part`.
    #[track_caller]
    fn says(self, part: &str) -> Ended {
        let (arguments, err) = (&self.arguments, &self.err);
        assert!(
            err.contains(part),
            "`{arguments}` does not say `{part}`: {err}"
        );
        self
    }

    /// Asserts that standard output contains `part`.
    #[track_caller]
    fn prints(self, part: &str) -> Ended {
        let (arguments, out) = (&self.arguments, &self.out);
        assert!(
            out.contains(part),
            "`{arguments}` does not print `{part}`: {out}"
        );
        self
    }

    fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out)
            .unwrap_or_else(|error| panic!("`{}`: {error}: {}", self.arguments, self.out))
    }
}

fn picture(path: &Path) -> Picture8 {
    fastphong::picture::image_file::read_picture(path)
        .unwrap_or_else(|error| panic!("{error}"))
        .to_stored()
}

/// Renders with `flags`, which include the input, and returns the picture.
fn rendered(flags: &str) -> Picture8 {
    let folder = Folder::new();
    folder.run(&format!("render {flags} -o out.png")).done();
    picture(&folder.path("out.png"))
}

/// Renders [`SPHERE`] with `flags`.
fn sphere(flags: &str) -> Picture8 {
    rendered(&format!("{SPHERE} {flags}"))
}

/// Returns the methods that can draw the sphere.
fn methods_on_sphere() -> impl Iterator<Item = &'static MethodRow> {
    let file = fastphong::scene::input::load(SPHERE).expect("a scene file");
    let scene = fastphong::scene::input::resolve(&file)
        .expect("a scene")
        .scene;
    let frame = scene.frame().expect("a frame");
    METHODS.iter().filter(move |method| {
        let plan = method.variant().plan(&frame, Renderer::LECTURE);
        plan.renderer().is_some()
    })
}

fn covered(picture: &Picture8) -> usize {
    picture
        .pixels()
        .iter()
        .filter(|pixel| pixel[3] == 255)
        .count()
}

/// A scene of a small sphere, 64 × 48 pixels, which renders quickly.
const SPHERE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/cli/sphere.toml");
