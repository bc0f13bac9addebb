//! Too little memory: each command states how much it needs before it allocates. The tests limit
//! the address space by the shell.
#![cfg(target_os = "linux")]

use super::{Ended, Folder};
use std::process::{Command, Stdio};

/// Runs a command with at most `kilobytes` of address space.
fn run_within(folder: &Folder, kilobytes: u32, arguments: &str) -> Ended {
    let tool = env!("CARGO_BIN_EXE_fastphong");
    let limited = format!("ulimit -v {kilobytes} && exec {tool} {arguments}");
    let mut command = Command::new("sh");
    command.args(["-c", &limited]).current_dir(&folder.0);
    // Each thread reserves address space for its stack.
    let command = command.stdin(Stdio::null()).env("RAYON_NUM_THREADS", "2");
    Ended::new(arguments, command.output().expect("a shell"))
}

#[test]
fn a_command_that_does_not_fit_into_the_limit_is_one_error() {
    let folder = Folder::new();
    folder
        .run("render builtin:cube --size 64x48 -o a.png")
        .done();
    let mut mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned();
    mesh += &"f 1 2 3\n".repeat(6_000_000);
    folder.write("large.obj", mesh);
    let pixels = "expected fewer pixels or samples";
    for (arguments, said, expected) in [
        (
            "render builtin:cube --size 8000x8000 -o o.png",
            "8000x8000: phong-rsqrt needs about 256.0 MB of memory, but ",
            pixels,
        ),
        (
            "render builtin:cube --size 8000x8000 -o o.pfm",
            " 1.0 GB ",
            pixels,
        ),
        (
            "render builtin:cube --size 8000x8000 --simd scalar -o o.ppm",
            " 256.0 MB ",
            pixels,
        ),
        (
            "render builtin:cube --size 8000x8000 -m reference -o o.png",
            "reference needs about",
            pixels,
        ),
        (
            "render builtin:cube --size 8000x8000 --aov normal -o o.png",
            "normal needs about",
            pixels,
        ),
        (
            "render builtin:cube --size 8000x8000 --engine cs171 -o o.png",
            "needs about",
            pixels,
        ),
        (
            "render builtin:cube --size 8000x8000 --engine barycentric -o o.png",
            "needs about",
            pixels,
        ),
        (
            "render builtin:cube --size 8000x8000 --reference a.png",
            "phong-rsqrt needs about",
            pixels,
        ),
        (
            "compare builtin:cube --size 8000x8000",
            "comparing needs about",
            pixels,
        ),
        (
            "bench builtin:cube --size 8000x8000",
            "comparing needs about",
            pixels,
        ),
        (
            "bench builtin:cube --size 8000x8000 --frame-times",
            "needs about",
            pixels,
        ),
        (
            "export builtin:cube --size 8000x8000 -o o.folder",
            "reference needs about",
            pixels,
        ),
        (
            "export builtin:knot?polygons=300000 -o o.folder",
            "the mesh as text needs about 300.0 MB",
            "expected fewer polygons",
        ),
        (
            "report builtin:cube --size 8000x8000",
            "comparing needs about",
            pixels,
        ),
        (
            "render builtin:sphere?polygons=5000000 -o o.png",
            "its meshes need about 1.0 GB",
            "expected a smaller mesh",
        ),
        (
            "info builtin:sphere?polygons=5000000",
            "its meshes need about",
            "expected a smaller mesh",
        ),
        (
            "info large.obj",
            "its meshes need about 288.0 MB",
            "expected a smaller mesh",
        ),
    ] {
        run_within(&folder, 250_000, arguments).refused(&[said, " are free: ", expected]);
    }
    assert!(!folder.names().iter().any(|name| name.starts_with("o.")));
}

/// The tool writes pictures while it compresses them, and rows while it draws them. It never holds
/// a whole file in memory.
#[test]
fn a_command_that_fits_into_the_limit_succeeds() {
    let folder = Folder::new();
    for arguments in [
        "render builtin:cube --size 640x480 -o o.png",
        "render builtin:cube --size 4000x2000 -o o.ppm",
        "diff o.png o.png -o map.png",
        "info teapot",
        "list scenes",
    ] {
        run_within(&folder, 250_000, arguments).done();
    }
}

/// The decoder reserves the memory for a picture before it reads the pixels.
#[test]
fn pictures_that_do_not_fit_into_memory_are_one_error() {
    let folder = Folder::new();
    folder.write("large.ppm", "P6 9000 9000 255\n");
    run_within(&folder, 250_000, "diff large.ppm large.ppm")
        .refused(&["large.ppm: there is not enough memory for 9000×9000 pixels"]);
}

/// A pair that does not fit stands on the page without its pictures.
#[test]
fn a_page_without_memory_for_its_pictures_says_so() {
    let folder = Folder::new();
    for (name, level) in [("ref", 1), ("now", 9)] {
        std::fs::create_dir(folder.path(name)).expect("a folder");
        let mut file = b"P6 3000 3000 255\n".to_vec();
        file.resize(file.len() + 27_000_000, level);
        folder.write(&format!("{name}/a.ppm"), file);
    }
    let said = "a.ppm: not on the page: 3000x3000: the page needs about 252.0 MB of memory";
    run_within(&folder, 250_000, "diff ref now --html p.html")
        .differs()
        .says(said);
    let page = String::from_utf8(folder.read("p.html")).expect("a page");
    assert!(page.contains(said.split_at(7).1) && !page.contains("<img "));
}
