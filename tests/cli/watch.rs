//! `render --watch` draws again whenever a file changes. The test stops the program.

use super::Folder;
use std::io::{BufRead, BufReader};
use std::process::{Child, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// A watching program and the lines that it prints.
struct Watcher(Child, Receiver<String>);

impl Watcher {
    fn new(folder: &Folder, arguments: &str) -> Watcher {
        let mut command = folder.command(arguments);
        let mut child = command
            .stderr(Stdio::piped())
            .spawn()
            .expect("the tool runs");
        let lines = BufReader::new(child.stderr.take().expect("standard error")).lines();
        let (send, receive) = channel();
        std::thread::spawn(move || {
            lines
                .map_while(Result::ok)
                .try_for_each(|line| send.send(line))
        });
        Watcher(child, receive)
    }

    /// Waits for the next line.
    fn line(&self) -> String {
        let limit = Duration::from_secs(60);
        self.1.recv_timeout(limit).expect("a line within a minute")
    }

    /// Waits for a line that contains `part`.
    #[track_caller]
    fn says(&self, part: &str) {
        let limit = Duration::from_secs(60);
        let mut before = Vec::new();
        loop {
            match self.1.recv_timeout(limit) {
                Ok(line) if line.contains(part) => return,
                Ok(line) => before.push(line),
                Err(_) => panic!("no `{part}` in a minute, but {before:?}"),
            }
        }
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn any_file_change_draws_again_and_errors_do_not_stop_it() {
    let folder = Folder::new();
    let scene = "image = { width = 16, height = 12 }\n[[object]]\nmesh = \"mesh.obj\"\n";
    let mesh = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    folder
        .write("scene.toml", scene)
        .write("mesh.obj", mesh)
        .write("m.mtl", "newmtl m\nKd 1 0 0\n");
    let watcher = Watcher::new(&folder, "render scene.toml --watch -o out.png");
    watcher.says("out.png: 16x12");
    watcher.says("watching 3 files: Ctrl-C ends");
    folder.write("scene.toml", scene.replace("16", "24"));
    watcher.says("out.png: 24x12");
    watcher.says("watching");
    folder.write("scene.toml", scene.replace("mesh =", "mehs ="));
    watcher.says("unknown key `mehs`");
    watcher.says("watching 1 file:");
    folder.write("scene.toml", scene);
    watcher.says("out.png: 16x12");
    watcher.says("watching 3 files");
    let red = folder.read("out.png");
    folder.write("m.mtl", "newmtl m\nKd 0 0 1 # blue\n");
    watcher.says("out.png: 16x12");
    watcher.says("watching 3 files");
    assert_ne!(folder.read("out.png"), red);
    folder.write("mesh.obj", mesh.replace("1 0 0", "2 0 0.5"));
    watcher.says("out.png: 16x12");
}

#[test]
fn only_files_can_be_watched() {
    let folder = Folder::new();
    for input in ["teapot", "builtin:cube", "gone.png", "."] {
        folder
            .run(&format!("render {input} --watch -o out.png"))
            .refused(&["is not a file, so it never changes: expected a scene file or a mesh file with `--watch`"]);
    }
}

#[test]
fn a_missing_scene_is_drawn_when_it_appears() {
    let folder = Folder::new();
    folder
        .write("mesh.obj", MESH)
        .write("m.mtl", "newmtl m\nKd 1 0 0\n");
    let watcher = Watcher::new(&folder, "render scene.toml --watch -o out.png");
    watcher.says("`scene.toml` is neither a file nor");
    watcher.says("watching 1 file:");
    folder.write("scene.toml", SCENE);
    watcher.says("out.png: 16x12");
}

const SCENE: &str = "image = { width = 16, height = 12 }\n[[object]]\nmesh = \"mesh.obj\"\n";
const MESH: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";

impl Folder {
    fn remove(&self, name: &str) {
        std::fs::remove_file(self.path(name)).expect("a file");
    }
}

/// Each of the three files disappears and returns: it is written anew, or renamed into place as
/// editors do.
#[test]
fn files_that_disappear_and_return_are_drawn_again() {
    let folder = Folder::new();
    folder
        .write("scene.toml", SCENE)
        .write("mesh.obj", MESH)
        .write("m.mtl", "newmtl m\nKd 1 0 0\n");
    let watcher = Watcher::new(&folder, "render scene.toml --watch -o out.png");
    watcher.says("watching 3 files");
    folder.remove("scene.toml");
    watcher.says("`scene.toml` is neither a file nor");
    watcher.says("watching 1 file:");
    folder.write("scene.toml", SCENE.replace("16", "20"));
    watcher.says("out.png: 20x12");
    watcher.says("watching 3 files");
    folder.remove("mesh.obj");
    watcher.says("mesh.obj");
    watcher.says("watching 2 files");
    folder.write("new", MESH);
    std::fs::rename(folder.path("new"), folder.path("mesh.obj")).expect("another name");
    watcher.says("out.png: 20x12");
    watcher.says("watching 3 files");
    folder.remove("m.mtl");
    watcher.says("m.mtl");
    watcher.says("watching 3 files");
    let grey = folder.read("out.png");
    folder.write("m.mtl", "newmtl m\nKd 0 0 1\n");
    watcher.says("out.png: 20x12");
    watcher.says("watching 3 files");
    assert_ne!(folder.read("out.png"), grey, "the library is back");
    // The new file has the same size and the same name.
    folder.write("new", MESH.replace("1 0 0", "9 0 0"));
    std::fs::rename(folder.path("new"), folder.path("mesh.obj")).expect("another name");
    watcher.says("out.png: 20x12");
}

/// The tool waits for a library that does not exist yet, as long as the mesh names it.
#[test]
fn a_library_that_appears_later_is_drawn() {
    let folder = Folder::new();
    folder.write("mesh.obj", MESH);
    let watcher = Watcher::new(&folder, "render mesh.obj --size 16x12 --watch -o out.png");
    watcher.says("watching 2 files");
    let without = folder.read("out.png");
    folder.write("m.mtl", "newmtl m\nKd 1 0 0\n");
    watcher.says("out.png: 16x12");
    watcher.says("watching 2 files");
    assert_ne!(folder.read("out.png"), without);
}

/// An unreadable mesh is reported once, and drawn as soon as it is readable.
#[test]
fn an_error_is_reported_once() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    let watcher = Watcher::new(&folder, "render scene.toml --watch -o out.png");
    watcher.says("mesh.obj");
    watcher.says("watching 2 files");
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
    watcher.says("watching 2 files");
    folder.write("mesh.obj", MESH);
    let mut lines = 0;
    while !watcher.line().contains("out.png: 16x12") {
        lines += 1;
    }
    // At most one line comes in between: a warning that no library is there.
    assert!(lines <= 1, "{lines} lines");
}
