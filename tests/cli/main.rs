//! The command line as a user calls it: exit code and message of good and bad input.
#![cfg(feature = "cli")]

mod aov;
mod bench;
mod defaults;
mod diff;
mod engines;
mod figure;
mod flags;
mod input;
mod name_template;
mod output;
mod reference;
mod render;
mod report;
mod shell;
mod studio;
mod tables;
mod watch;

use fastphong::picture::Picture8;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

/// An empty folder that is removed in the end; commands run in it.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Folder {
        static NUMBER: AtomicUsize = AtomicUsize::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path =
            std::env::temp_dir().join(format!("fastphong-cli-{}-{number}", std::process::id()));
        std::fs::create_dir(&path).expect("an empty folder");
        Folder(path)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> &Folder {
        std::fs::write(self.path(name), bytes).expect("a written file");
        self
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The names of all files, in order.
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

    /// Runs `fastphong` with `arguments`, which spaces part.
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

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// How a command ended.
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

    /// Exit code 0.
    fn done(self) -> Ended {
        assert_eq!(
            self.code,
            Some(0),
            "`{}`: {}{}",
            self.arguments,
            self.out,
            self.err
        );
        self
    }

    /// Exit code 1.
    fn differs(self) -> Ended {
        assert_eq!(
            self.code,
            Some(1),
            "`{}`: {}{}",
            self.arguments,
            self.out,
            self.err
        );
        self
    }

    /// Exit code 2, nothing on standard output, and one error that holds each of `parts`.
    fn refused(self, parts: &[&str]) -> Ended {
        assert_eq!(
            self.code,
            Some(2),
            "`{}`: {}{}",
            self.arguments,
            self.out,
            self.err
        );
        assert_eq!(self.out, "", "`{}`", self.arguments);
        assert_eq!(
            self.err.matches("error: ").count(),
            1,
            "`{}`: {}",
            self.arguments,
            self.err
        );
        for part in parts {
            assert!(
                self.err.contains(part),
                "`{}` does not say `{part}`: {}",
                self.arguments,
                self.err
            );
        }
        self
    }

    /// Standard error holds `part`.
    fn says(self, part: &str) -> Ended {
        assert!(
            self.err.contains(part),
            "`{}` does not say `{part}`: {}",
            self.arguments,
            self.err
        );
        self
    }

    /// Standard output holds `part`.
    fn prints(self, part: &str) -> Ended {
        assert!(
            self.out.contains(part),
            "`{}` does not print `{part}`: {}",
            self.arguments,
            self.out
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

/// The picture of `input` with `flags`.
fn rendered(flags: &str) -> Picture8 {
    let folder = Folder::new();
    folder.run(&format!("render {flags} -o out.png")).done();
    picture(&folder.path("out.png"))
}

/// That of [`SPHERE`].
fn sphere(flags: &str) -> Picture8 {
    rendered(&format!("{SPHERE} {flags}"))
}

fn covered(picture: &Picture8) -> usize {
    picture
        .pixels()
        .iter()
        .filter(|pixel| pixel[3] == 255)
        .count()
}

/// A scene of a small sphere, 64 × 48: pictures that are drawn in no time.
const SPHERE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cli/sphere.toml");
