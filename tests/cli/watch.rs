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

    /// Waits for a line that contains `part`.
    fn says(&self, part: &str) {
        let limit = Duration::from_secs(60);
        while !self
            .1
            .recv_timeout(limit)
            .unwrap_or_else(|_| panic!("no `{part}`"))
            .contains(part)
        {}
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
    for input in ["teapot", "builtin:cube", "gone.obj"] {
        folder
            .run(&format!("render {input} --watch -o out.png"))
            .refused(&["is no file, and never changes: expected a scene file or a mesh file with `--watch`"]);
    }
}
