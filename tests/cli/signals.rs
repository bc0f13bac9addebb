//! Signals end the program without leaving drafts of files behind.
#![cfg(unix)]

use super::{Folder, SPHERE, picture};
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A command whose picture takes seconds. Its draft exists from the beginning.
const SLOW: &str =
    "render builtin:sphere --size 1024x1024 --samples 8 -m slerp-phong --simd scalar -o out.ppm";

/// Waits until `is_so` returns true for the names in the folder.
#[track_caller]
fn wait_until(folder: &Folder, is_so: impl Fn(&[String]) -> bool) {
    let started = Instant::now();
    while !is_so(&folder.names()) {
        let names = folder.names();
        assert!(started.elapsed() < Duration::from_secs(120), "{names:?}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn has_draft(names: &[String]) -> bool {
    names.iter().any(|name| name.starts_with(".tmp"))
}

fn send(signal: &str, to: &Child) {
    let arguments = [format!("-{signal}"), to.id().to_string()];
    let status = Command::new("kill").args(arguments).status();
    assert!(status.expect("kill runs").success());
}

/// True if this process was started with `signal` ignored, as by `nohup`. Then the program that it
/// starts ignores the signal, too.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))
        .and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.map_or(signal != 15, |mask| mask >> (signal - 1) & 1 == 1)
}

fn start(mut command: Command) -> Child {
    command
        .stderr(Stdio::null())
        .spawn()
        .expect("the tool runs")
}

#[test]
fn a_signal_removes_the_draft_keeps_the_old_file_and_sets_the_exit_status() {
    for (name, number) in [("TERM", 15), ("INT", 2), ("HUP", 1), ("QUIT", 3)] {
        if is_ignored(number) {
            continue;
        }
        for old in [None, Some("old")] {
            let folder = Folder::new();
            if let Some(old) = old {
                folder.write("out.ppm", old);
            }
            let before = folder.names();
            let mut child = start(folder.command(SLOW));
            wait_until(&folder, has_draft);
            send(name, &child);
            let status = child.wait().expect("an end");
            assert_eq!(status.signal(), Some(number), "{name}: {status}");
            assert_eq!(folder.names(), before, "{name}");
            assert_eq!(
                std::fs::read_to_string(folder.path("out.ppm"))
                    .ok()
                    .as_deref(),
                old
            );
        }
    }
}

/// Approving changes all references or none, whenever a signal ends it: while it writes drafts, or
/// while it renames them. The pictures are large, so that drafts take time. The references have
/// another size, so that comparing takes none.
#[test]
fn a_signal_while_pictures_are_approved_leaves_all_old_or_all_new() {
    let [references, pictures] = [Folder::new(), Folder::new()];
    let names: Vec<String> = (10..40).map(|i| format!("{i}.ppm")).collect();
    let small = b"P6 1 1 255\nabc".to_vec();
    let large = [b"P6 1000 1000 255\n".as_slice(), &[9; 3_000_000]].concat();
    let command = format!("diff . {} --approve", pictures.path("").display());
    for name in &names {
        pictures.write(name, &large);
    }
    for drafts in [1, 10, 30, 59] {
        for name in &names {
            references.write(name, &small);
        }
        let mut child = start(references.command(&command));
        wait_until(&references, |names| {
            let found = names.iter().filter(|name| name.starts_with(".tmp"));
            found.count() >= drafts || references.read("39.ppm") == large
        });
        send("TERM", &child);
        child.wait().expect("an end");
        assert_eq!(references.names(), names, "no draft is left");
        let new = names
            .iter()
            .filter(|name| references.read(name) == large)
            .count();
        assert!([0, names.len()].contains(&new), "{new} are new");
    }
}

/// HUP does not end a program that `nohup` started.
#[cfg(target_os = "linux")]
#[test]
fn a_signal_that_is_ignored_stays_ignored() {
    let folder = Folder::new();
    let tool = env!("CARGO_BIN_EXE_fastphong");
    let mut shell = Command::new("sh");
    shell
        .args(["-c", &format!("trap '' HUP; exec '{tool}' {SLOW}")])
        .current_dir(folder.path(""));
    let mut child = start(shell);
    wait_until(&folder, has_draft);
    send("HUP", &child);
    // The system delivers pending signals in the order of their numbers.
    send("TERM", &child);
    let status = child.wait().expect("an end");
    assert_eq!(status.signal(), Some(15), "{status}");
    assert!(folder.names().is_empty());
}

#[test]
fn two_programs_that_write_the_same_file_leave_it_whole() {
    let folder = Folder::new();
    folder.run(&format!("render {SPHERE} -o alone.png")).done();
    let start = || start(folder.command(&format!("render {SPHERE} -o out.png")));
    let both = [start(), start(), start()];
    for mut child in both {
        assert!(child.wait().expect("an end").success());
    }
    assert_eq!(folder.read("out.png"), folder.read("alone.png"));
    assert_eq!(folder.names(), ["alone.png", "out.png"]);
}

#[test]
fn a_named_pipe_is_written_to_and_stays_a_pipe() {
    let folder = Folder::new();
    let pipe = folder.path("pipe.png");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.expect("mkfifo runs").success());
    let mut child = start(folder.command(&format!("render {SPHERE} -o pipe.png")));
    folder.write("read.png", std::fs::read(&pipe).expect("what was written"));
    assert!(child.wait().expect("an end").success());
    assert_eq!(picture(&folder.path("read.png")).width(), 64);
    assert_eq!(folder.names(), ["pipe.png", "read.png"]);
}

#[test]
fn a_dangling_link_stays_a_link_and_leads_to_the_picture() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("folder")).expect("a folder");
    std::os::unix::fs::symlink("folder/new.png", folder.path("link.png")).expect("a link");
    for _ in 0..2 {
        folder.run(&format!("render {SPHERE} -o link.png")).done();
        assert_eq!(picture(&folder.path("folder/new.png")).width(), 64);
        assert!(folder.path("link.png").is_symlink());
    }
    assert_eq!(folder.names(), ["folder", "link.png"]);
    std::os::unix::fs::symlink("missing/new.png", folder.path("lost.png")).expect("a link");
    folder
        .run(&format!("render {SPHERE} -o lost.png"))
        .refused(&["lost.png: cannot be written: its folder does not exist"]);
}
