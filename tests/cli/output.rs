//! Output of pictures: files that cannot be written, pipes, and readers that close early.

use super::{Ended, Folder, SPHERE, picture};
use fastphong::picture::image_file::{Format, decode_picture};
use std::fs::File;
use std::io::Read;
use std::process::Stdio;

#[test]
fn unwritable_paths_leave_nothing_behind() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("folder.png")).unwrap();
    folder.write("file", "old");
    let before = folder.names();
    for (path, message) in [
        ("folder.png", "folder.png: cannot be written: "),
        ("missing/out.png", "missing/out.png: cannot be written: "),
        ("file/out.png", "file/out.png: cannot be written: "),
        (
            "out.gif",
            "out.gif: no picture format has this ending: expected .png, .ppm or .pfm",
        ),
        ("out", "out: no picture format has this ending"),
    ] {
        folder
            .run(&format!("render {SPHERE} -o {path}"))
            .refused(&[message]);
        assert_eq!(folder.names(), before, "{path}");
    }
    folder
        .run(&format!("render {SPHERE} -o out --format bmp"))
        .refused(&["expected png, ppm or pfm"]);
    folder
        .run(&format!("render {SPHERE} --format png --stats"))
        .refused(&["--output <FILE>"]);
}

#[test]
fn an_old_picture_survives_errors_and_is_replaced_on_success() {
    let folder = Folder::new();
    folder.write("out.png", "old");
    folder.run("render taepot -o out.png").refused(&["teapot"]);
    folder
        .run(&format!(
            "render {SPHERE} -m fast-phong --engine barycentric -o out.png"
        ))
        .refused(&["barycentric"]);
    assert_eq!(folder.read("out.png"), b"old");
    folder.run(&format!("render {SPHERE} -o out.png")).done();
    assert_eq!(picture(&folder.path("out.png")).width(), 64);
    assert_eq!(folder.names(), ["out.png"], "no draft is left");
}

#[test]
fn a_picture_can_be_piped() {
    let folder = Folder::new();
    for (format, flag) in [
        ("png", ""),
        ("ppm", "--format ppm"),
        ("pfm", "--format pfm"),
    ] {
        let piped = folder
            .run(&format!(
                "render {SPHERE} -o - {flag} --stats --print-scene"
            ))
            .done();
        folder
            .run(&format!("render {SPHERE} -o out.{format}"))
            .done();
        assert_eq!(
            piped.bytes,
            folder.read(&format!("out.{format}")),
            "{format}"
        );
        // Messages go to standard error.
        piped.says("no-area").says("mesh = \"builtin:sphere");
    }
    folder
        .run(&format!("render {SPHERE} -o picture --format ppm"))
        .done();
    assert!(folder.read("picture").starts_with(b"P6"));
    assert!(decode_picture(&folder.read("picture")).is_ok());
    assert!(Format::ALL.len() == 3, "every format is piped above");
}

/// A reader that reads nothing, or only the beginning, causes neither an error nor a panic.
#[test]
fn a_closed_pipe_ends_the_tool_quietly() {
    let folder = Folder::new();
    for (arguments, code) in [
        ("list methods", 0),
        ("explain fast-phong --json", 0),
        ("info teapot", 0),
        ("--help", 0),
        ("render builtin:sphere --size 640x480 -o -", 0),
        ("render builtin:sphere --size 640x480 -o - --format ppm", 0),
        ("diff a.ppm b.ppm --fail-above 0", 1),
    ] {
        folder
            .write("a.ppm", "P6 1 1 255\nabc")
            .write("b.ppm", "P6 1 1 255\nxyz");
        let mut command = folder.command(arguments);
        let mut child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the tool runs");
        drop(child.stdout.take());
        let mut err = String::new();
        child
            .stderr
            .take()
            .expect("standard error")
            .read_to_string(&mut err)
            .expect("text");
        let status = child.wait().expect("an end");
        assert_eq!(status.code(), Some(code), "`{arguments}`: {err}");
        assert!(
            !err.contains("panicked") && !err.contains("error"),
            "`{arguments}`: {err}"
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let folder = Folder::new();
    for arguments in ["list methods", "render builtin:cube --size 64x48 -o -"] {
        let full = File::options()
            .write(true)
            .open("/dev/full")
            .expect("the device that is always full");
        let output = folder
            .command(arguments)
            .stdout(full)
            .output()
            .expect("the tool runs");
        Ended::new(arguments, output)
            .refused(&["error: standard output: cannot be written: No space left"]);
    }
    folder
        .run(&format!("render {SPHERE} -o /dev/full --format png"))
        .refused(&["/dev/full: cannot be written"]);
    folder
        .run(&format!("render {SPHERE} -o /proc/self/out.png"))
        .refused(&["/proc/self/out.png: cannot be written"]);
}
