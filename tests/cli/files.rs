//! No command overwrites a file that it reads, whatever name or link leads to the file.

use super::{Ended, Folder};
use std::fs;

/// Returns a folder with a mesh, its material library, a scene, two pictures, a document, and links
/// to some of them.
fn folder() -> Folder {
    let folder = Folder::new();
    folder
        .write(
            "c.obj",
            "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n",
        )
        .write("c.mtl", "newmtl m\nKd 1 0 0\n")
        .write(
            "s.toml",
            "image = { width = 16, height = 12 }\n[[object]]\nmesh = \"c.obj\"\n",
        );
    folder.run("render s.toml -o a.png").done();
    folder.run("render s.toml --kd 0.5 -o b.png").done();
    let compared = folder.run("compare s.toml -m flat --time-budget 0 --json");
    folder.write("d.json", compared.done().out);
    #[cfg(unix)]
    for (file, link) in [
        ("c.obj", "mesh"),
        ("a.png", "reference"),
        ("d.json", "document"),
    ] {
        std::os::unix::fs::symlink(file, folder.path(&format!("{link}-soft.png"))).expect("a link");
    }
    fs::create_dir(folder.path("sub")).expect("a folder");
    folder
}

/// Returns the contents of all files in the folder.
fn contents(folder: &Folder) -> Vec<(String, Option<Vec<u8>>)> {
    let content = |name: String| {
        let bytes = fs::read(folder.path(&name)).ok();
        (name, bytes)
    };
    folder.names().into_iter().map(content).collect()
}

#[track_caller]
fn refuses(folder: &Folder, arguments: &str, said: &str) {
    let before = contents(folder);
    let ended = folder.run(&format!("{arguments} --verbose"));
    assert!(
        !ended.err.contains("shaded"),
        "`{arguments}` draws: {}",
        ended.err
    );
    ended.refused(&[said, ": expected a"]);
    assert!(before == contents(folder), "`{arguments}` changes a file");
}

#[test]
fn a_picture_does_not_overwrite_the_files_that_it_is_drawn_from() {
    let folder = folder();
    for (arguments, said) in [
        (
            "c.obj -o c.obj --format png",
            "`--output` is the mesh itself, c.obj",
        ),
        (
            "c.obj -o ./c.obj --format ppm",
            "the mesh itself, c.obj, by the name ./c.obj",
        ),
        (
            "c.obj -o sub/../c.obj --format pfm",
            "the mesh itself, c.obj, by the name sub/../c.obj",
        ),
        (
            "c.obj -o {scene}.obj --format png",
            "the mesh itself, c.obj",
        ),
        (
            "c.obj -o c.mtl --format png",
            "`--output` is the material library itself, c.mtl",
        ),
        #[cfg(unix)]
        (
            "c.obj -o mesh-soft.png",
            "the mesh itself, c.obj, by the name mesh-soft.png",
        ),
        (
            "c.obj -o c.obj --format png --aov depth",
            "the mesh itself, c.obj",
        ),
        (
            "c.obj -o c.obj --format png -m reference",
            "the mesh itself, c.obj",
        ),
        (
            "c.obj -o c.obj --format png --watch",
            "the mesh itself, c.obj",
        ),
        (
            "s.toml -o s.toml --format png",
            "`--output` is the scene itself, s.toml",
        ),
        ("s.toml -o c.obj --format png", "the mesh itself, c.obj"),
        (
            "s.toml -o c.mtl --format png",
            "the material library itself, c.mtl",
        ),
        (
            "s.toml --reference a.png -o a.png",
            "`--output` is the reference itself, a.png",
        ),
        #[cfg(unix)]
        (
            "s.toml --reference a.png -o reference-soft.png",
            "the reference itself, a.png, by the name",
        ),
        #[cfg(unix)]
        (
            "s.toml --reference reference-soft.png -o a.png",
            "the reference itself, reference-soft.png, by",
        ),
        (
            "s.toml --reference n.png -o ./n.png",
            "the reference itself, n.png, by the name ./n.png",
        ),
        (
            "s.toml --reference a.png -o a.diff.png",
            "`--output` and `--reference` name one file, a.diff.png",
        ),
    ] {
        refuses(&folder, &format!("render {arguments}"), said);
    }
}

#[test]
fn a_map_does_not_overwrite_the_pictures_that_it_compares() {
    let folder = folder();
    for (to, said) in [
        ("a.png", "`--output` is the reference itself, a.png"),
        ("b.png", "`--output` is the picture itself, b.png"),
        (
            "sub/../b.png",
            "the picture itself, b.png, by the name sub/../b.png",
        ),
        #[cfg(unix)]
        (
            "reference-soft.png",
            "the reference itself, a.png, by the name reference-soft.png",
        ),
    ] {
        for map in ["", "--signed", "--flip"] {
            refuses(&folder, &format!("diff a.png b.png -o {to} {map}"), said);
        }
    }
}

#[test]
fn results_do_not_overwrite_the_files_that_they_are_made_from() {
    let folder = folder();
    fs::copy(folder.path("d.json"), folder.path("README.md")).expect("a copy");
    let quick = "-m flat --time-budget 0";
    for (arguments, said) in [
        (
            &*format!("bench c.obj {quick} --json c.obj"),
            "`--json` is the mesh itself, c.obj",
        ),
        (
            &format!("bench c.obj {quick} --json c.mtl"),
            "`--json` is the material library itself, c.mtl",
        ),
        #[cfg(unix)]
        (
            &format!("bench s.toml {quick} --json mesh-soft.png"),
            "the mesh itself, c.obj, by the name",
        ),
        (
            "bench s.toml -m flat --frame-times --json s.toml",
            "`--json` is the scene itself, s.toml",
        ),
        (
            &format!("report c.obj {quick} -o c.obj"),
            "`--output` is the mesh itself, c.obj",
        ),
        (
            &format!("report c.obj {quick} -o p.html --json c.mtl"),
            "`--json` is the material library",
        ),
        (
            &format!("report s.toml {quick} -o p.html --csv s.toml"),
            "`--csv` is the scene itself, s.toml",
        ),
        (
            &format!("report s.toml {quick} -o p.html --json ./p.html"),
            "`--output` and `--json` name one file",
        ),
        (
            &format!("report s.toml {quick} -o p.html --json x --csv x"),
            "`--json` and `--csv` name one file, x",
        ),
        (
            "report --from d.json -o d.json",
            "`--output` is the document itself, d.json",
        ),
        (
            "report --from b.json d.json -o p.html --json d.json",
            "`--json` is the document itself, d.json",
        ),
        #[cfg(unix)]
        (
            "report --from d.json -o p.html --csv document-soft.png",
            "the document itself, d.json, by the name",
        ),
        (
            "report --from README.md -o p.html --markdown",
            "`--markdown` is the document itself, README.md",
        ),
    ] {
        if arguments.contains("b.json") {
            fs::copy(folder.path("d.json"), folder.path("b.json")).expect("a copy");
        }
        refuses(&folder, arguments, said);
    }
}

/// A shell that appends to an input file would destroy it just as well.
#[cfg(target_os = "linux")]
#[test]
fn standard_output_is_not_appended_to_an_input_file() {
    let folder = folder();
    for (file, arguments) in [
        ("c.obj", "render c.obj -o - --verbose"),
        ("a.png", "diff a.png b.png"),
        ("a.png", "diff a.png b.png -o -"),
        ("s.toml", "info s.toml"),
        ("c.mtl", "render s.toml --stats"),
        ("d.json", "report --from d.json -o p.html"),
    ] {
        let old = folder.read(file);
        let append = fs::File::options().append(true).open(folder.path(file));
        let mut command = folder.command(arguments);
        let output = command.stdout(append.expect("the file")).output();
        let ended = Ended::new(arguments, output.expect("the tool runs"));
        assert!(
            !ended.err.contains("shaded"),
            "`{arguments}` draws: {}",
            ended.err
        );
        ended.refused(&[
            " itself, ",
            ", by the name /dev/stdout: expected another file",
        ]);
        assert!(old == folder.read(file), "`{arguments}` changes {file}");
    }
}

/// A file that the shell redirects to standard input is an input, too.
#[cfg(target_os = "linux")]
#[test]
fn a_file_on_standard_input_is_not_overwritten() {
    let folder = folder();
    let old = folder.read("a.png");
    for arguments in [
        "diff - b.png -o a.png",
        "diff b.png - -o reference-soft.png",
    ] {
        let input = fs::File::open(folder.path("a.png")).expect("the file");
        let output = folder.command(arguments).stdin(input).output();
        let ended = Ended::new(arguments, output.expect("the tool runs"));
        ended.refused(&[" itself, /dev/stdin, by the name "]);
        assert!(old == folder.read("a.png"), "`{arguments}` changes a.png");
    }
}

/// Devices hold nothing that could be lost, and a file that shares only its name with an input is a
/// different file.
#[test]
fn other_files_and_devices_are_written() {
    let folder = folder();
    folder
        .run("render c.obj --size 16x12 -o sub/c.obj --format png")
        .done();
    folder.run("diff a.png b.png -o sub/a.png").done();
    folder
        .run("report --from d.json -o p.html --json sub/d.json")
        .done();
    #[cfg(unix)]
    folder
        .run("report --from d.json -o /dev/null --json /dev/null --csv /dev/null")
        .done();
}

/// A mesh may name a library and use none of its materials. The library is still an input, which
/// whoever draws the mesh wants to keep.
#[test]
fn a_library_that_no_face_uses_is_not_overwritten() {
    let folder = folder();
    folder.write(
        "bare.obj",
        "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    );
    refuses(
        &folder,
        "render bare.obj -o c.mtl --format png",
        "is the material library itself",
    );
    // The tool does not miss a library that no face needs.
    folder.write(
        "gone.obj",
        "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    );
    let ended = folder
        .run("render gone.obj -o gone.png --size 16x12")
        .done();
    assert!(!ended.err.contains("gone.mtl"), "{}", ended.err);
}
