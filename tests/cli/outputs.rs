//! Every command with every kind of output: standard output, wrong endings, files of other
//! programs, full devices, and paths that are not text.

use super::{Ended, Folder, SPHERE};
use std::process::Stdio;

/// Returns each output of each command: the command without the output, the output's flag, and the
/// ending that fits its contents. Every command is quick.
fn cases(folder: &Folder) -> [(String, &'static str, &'static str); 8] {
    folder.run(&format!("render {SPHERE} -o a.png")).done();
    folder
        .run(&format!("render {SPHERE} --kd 0.5 -o b.png"))
        .done();
    let compared = folder.run(&format!("compare {SPHERE} -m flat --time-budget 0 --json"));
    folder.write("d.json", compared.done().out);
    let search = "search -m gouraud --degrees 5 --lights 1 --restarts 1";
    let bench = format!("bench {SPHERE} -m flat --frame-times --frames 1 --warmup 0");
    let from = "report --from d.json";
    let page = format!("{from} -o page.html");
    [
        (format!("render {SPHERE}"), "-o", "png"),
        ("diff a.png b.png".to_owned(), "-o", "png"),
        (from.to_owned(), "-o", "html"),
        (page.clone(), "--json", "json"),
        (page, "--csv", "csv"),
        ("figure exercises".to_owned(), "-o", "html"),
        (bench, "--json", "json"),
        (search.to_owned(), "--json", "json"),
    ]
}

/// Returns the first bytes of a file. They end before the parts that vary: the name that a document
/// stores of itself, and times.
fn beginning(bytes: &[u8]) -> &[u8] {
    &bytes[..bytes.len().min(15)]
}

#[test]
fn a_hyphen_is_standard_output_for_every_output() {
    let folder = Folder::new();
    for (command, flag, ending) in cases(&folder) {
        let file = format!("out.{ending}");
        folder.run(&format!("{command} {flag} {file}")).done();
        let piped = folder.run(&format!("{command} {flag} -")).done();
        assert_eq!(
            beginning(&piped.bytes),
            beginning(&folder.read(&file)),
            "`{command} {flag} -`"
        );
        assert!(!folder.path("-").exists(), "`{command} {flag} -`");
        // Standard output holds nothing else.
        if ending == "json" {
            piped.json();
        }
        std::fs::remove_file(folder.path(&file)).expect("the file was made");
    }
}

#[test]
fn an_ending_that_contradicts_the_contents_is_refused_for_every_output() {
    let folder = Folder::new();
    let cases = cases(&folder);
    let before = folder.names();
    for (command, flag, ending) in cases {
        for other in [
            "html", "json", "csv", "md", "obj", "toml", "txt", "gif", "png",
        ] {
            if other == ending {
                continue;
            }
            let command = format!("{command} {flag} out.{other}");
            folder
                .run(&command)
                .refused(&[&format!("out.{other}: "), "expected ."]);
            assert_eq!(folder.names(), before, "`{command}`");
        }
        // An ending in capitals is accepted, and a name without an ending fits everything.
        let name = format!("out.{}", ending.to_uppercase());
        folder.run(&format!("{command} {flag} {name}")).done();
        std::fs::remove_file(folder.path(&name)).expect("the file was made");
        if ending != "png" {
            folder.run(&format!("{command} {flag} out")).done();
            std::fs::remove_file(folder.path("out")).expect("the file was made");
        }
        let _ = std::fs::remove_file(folder.path("page.html"));
    }
}

#[test]
fn standard_output_can_hold_one_output_and_no_folder() {
    let folder = Folder::new();
    cases(&folder);
    folder
        .run("report --from d.json -o - --json -")
        .refused(&["`--output` and `--json` name standard output: expected a file"]);
    folder
        .run("report --from d.json -o p.html --json - --csv -")
        .refused(&["`--json` and `--csv` name standard output"]);
    folder
        .run("report --from d.json -o - --markdown")
        .refused(&["`--markdown` writes beside the page", "expected `-o FILE`"]);
    folder
        .run("figure exercises --pictures -")
        .refused(&["--pictures: `-` is standard output, not a folder"]);
    folder
        .run("man -")
        .refused(&["FOLDER: `-` is standard output, not a folder"]);
    folder
        .run("render teapot --reference -")
        .refused(&["-: no picture format has this ending"]);
    assert!(!folder.names().contains(&"-".to_owned()));
}

/// A document can come from standard input, as scenes and pictures can.
#[cfg(unix)]
#[test]
fn a_document_is_read_from_standard_input_once() {
    let folder = Folder::new();
    cases(&folder);
    for (arguments, code) in [
        ("report --from - -o p.html", 0),
        ("report --from - - -o p.html", 2),
        ("report --from d.json - -o -", 0),
    ] {
        let file = std::fs::File::open(folder.path("d.json")).expect("the document");
        let output = folder.command(arguments).stdin(file).output();
        let ended = Ended::new(arguments, output.expect("the tool runs"));
        assert_eq!(ended.code, Some(code), "`{arguments}`: {}", ended.err);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_an_error_for_every_output_and_for_help() {
    let folder = Folder::new();
    let outputs = cases(&folder)
        .into_iter()
        .map(|(command, flag, _)| format!("{command} {flag} -"));
    let results = [
        "--help",
        "--version",
        "help render",
        "render --help",
        "man",
        "completions bash",
        "list scenes",
        "explain flat",
    ]
    .iter()
    .map(|text| (*text).to_owned());
    for arguments in outputs.chain(results) {
        let full = std::fs::File::options().write(true).open("/dev/full");
        let mut command = folder.command(&arguments);
        let output = command.stdout(full.expect("the device that is always full"));
        let ended = Ended::new(&arguments, output.output().expect("the tool runs"));
        ended.refused(&["error: standard output: cannot be written: No space left"]);
    }
}

/// Where the command chooses the file's name, it does not replace a file that fastphong did not
/// write. Then it writes none of its other files either.
#[test]
fn files_of_other_programs_stay_where_the_command_chooses_the_name() {
    let folder = Folder::new();
    cases(&folder);
    let dark = format!("render {SPHERE} --kd 0.1 --reference a.png");
    for (command, others, own) in [
        (
            "report --from d.json -o p.html --markdown",
            "README.md",
            "p.html",
        ),
        (
            "report teapot -m flat --time-budget 0 --size 16x12 -o p.html --markdown",
            "images/01-teapot-reference.png",
            "p.html",
        ),
        ("report --from d.json", "report/index.html", ""),
        ("figure exercises", "report/figures/exercises.html", ""),
        (
            "figure exercises -o p.html --pictures f",
            "f/exercises-1.png",
            "p.html",
        ),
        (&dark, "a.actual.png", "a.diff.png"),
        (&dark, "a.diff.png", "a.actual.png"),
        ("man m", "m/fastphong-render.1", "m/fastphong.1"),
    ] {
        let path = folder.path(others);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        // A picture by another program, and a text.
        let precious = if others.ends_with(".png") {
            png_of_others()
        } else {
            b"# My own notes\n".to_vec()
        };
        folder.write(others, &precious);
        folder
            .run(command)
            .refused(&[others, "which fastphong did not make", "--force"]);
        assert!(folder.read(others) == precious, "`{command}`");
        let is_there = own.is_empty() || !folder.path(own).exists();
        assert!(is_there, "`{command}` writes {own} all the same");
        // With `--force` the command replaces the file. After that it recognises its own file.
        for flag in ["--force", ""] {
            let ended = folder.run(&format!("{command} {flag}"));
            assert_ne!(ended.code, Some(2), "`{command} {flag}`: {}", ended.err);
            assert!(folder.read(others) != precious, "`{command} {flag}`");
        }
        for made in [others, own].iter().filter(|name| !name.is_empty()) {
            let _ = std::fs::remove_file(folder.path(made));
        }
        let _ = std::fs::remove_file(folder.path("README.md"));
    }
}

/// Returns a PNG file that does not name the software that wrote it.
fn png_of_others() -> Vec<u8> {
    let picture = fastphong::picture::Picture8::new(2, 2, [9; 4]);
    fastphong::picture::image_file::encode_png(&picture).expect("a file")
}

/// If a flag names a file, the command replaces it, whoever wrote it.
#[test]
fn a_file_that_a_flag_names_is_replaced() {
    let folder = Folder::new();
    for (command, flag, ending) in cases(&folder) {
        let file = format!("old.{ending}");
        folder.write(&file, "old");
        folder.run(&format!("{command} {flag} {file}")).done();
        assert_ne!(folder.read(&file), b"old", "`{command} {flag} {file}`");
    }
}

/// Thread counts from the environment have the same limit as `--threads`, in every command.
#[test]
fn too_many_threads_of_the_environment_are_refused() {
    let folder = Folder::new();
    for (value, is_taken) in [
        ("2", true),
        ("1024", true),
        ("", true),
        ("0", true),
        ("many", true),
        ("-3", true),
        ("1025", false),
        ("+5000", false),
        ("100000", false),
        ("99999999999999999999999", false),
    ] {
        for name in ["RAYON_NUM_THREADS", "RAYON_RS_NUM_CPUS"] {
            // The error comes before a thousand threads are started.
            let arguments = "list engines";
            let output = folder.command(arguments).env(name, value).output();
            let ended = Ended::new(arguments, output.expect("the tool runs"));
            if is_taken {
                drop(ended.done());
            } else {
                drop(ended.refused(&[&format!(
                    "{name}={value}: expected a number of threads from 1 to 1024"
                )]));
            }
        }
    }
}

/// `CLICOLOR_FORCE` colours messages without a terminal, and `NO_COLOR` overrides it. Without
/// either, a pipe gets no colours.
#[test]
fn environment_variables_decide_about_colours() {
    let folder = Folder::new();
    for (variables, is_coloured) in [
        (&[][..], false),
        (&[("CLICOLOR_FORCE", "1")][..], true),
        (&[("CLICOLOR_FORCE", "0")][..], false),
        (&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")][..], false),
        (&[("CLICOLOR", "1")][..], false),
    ] {
        for arguments in ["render no-such -o a.png", "render --no-such", "--help"] {
            let mut command = folder.command(arguments);
            command.env_remove("CLICOLOR_FORCE").env_remove("CLICOLOR");
            command.envs(variables.iter().copied());
            let ended = Ended::new(arguments, command.output().expect("the tool runs"));
            let text = ended.out + &ended.err;
            assert_eq!(
                text.contains('\x1b'),
                is_coloured,
                "`{arguments}` with {variables:?}: {text}"
            );
        }
    }
}

/// `script` runs the program in a terminal, if the system has `script`.
#[cfg(target_os = "linux")]
#[test]
fn a_dumb_terminal_and_clicolor_0_have_no_colours() {
    let folder = Folder::new();
    let tool = env!("CARGO_BIN_EXE_fastphong");
    let on_terminal = |variables: &[(&str, &str)]| {
        let mut command = std::process::Command::new("script");
        command
            .args([
                "-qec",
                &format!("{tool} render no-such -o a.png"),
                "/dev/null",
            ])
            .current_dir(&folder.0)
            .stdin(Stdio::null())
            .env("TERM", "xterm");
        for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
            command.env_remove(name);
        }
        let output = command.envs(variables.iter().copied()).output().ok()?;
        Some(String::from_utf8_lossy(&output.stdout).into_owned())
    };
    // Skip systems without `script`.
    let Some(plain) = on_terminal(&[]).filter(|text| text.contains('\x1b')) else {
        return;
    };
    assert!(plain.contains("error"), "{plain}");
    for variables in [("TERM", "dumb"), ("CLICOLOR", "0"), ("NO_COLOR", "1")] {
        let text = on_terminal(&[variables]).expect("it ran before");
        assert!(
            text.contains("error: ") && !text.contains('\x1b'),
            "{variables:?}: {text:?}"
        );
    }
}

/// A Unix file system allows any bytes in a name but 0 and `/`.
#[cfg(target_os = "linux")]
#[test]
fn paths_that_are_not_text_work() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new();
    let name = |bytes: &'static [u8]| OsStr::from_bytes(bytes);
    let run = |arguments: &[&OsStr]| {
        let output = folder.command("").args(arguments).output();
        Ended::new(&format!("{arguments:?}"), output.expect("the tool runs"))
    };
    let at = |bytes: &'static [u8]| folder.0.path().join(name(bytes));
    std::fs::create_dir(at(b"f\xe9")).expect("a folder");
    let mesh = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    std::fs::write(at(b"c\xe9.obj"), mesh).expect("a mesh");
    std::fs::write(at(b"f\xe9/c.obj"), mesh).expect("a mesh");
    std::fs::write(at(b"f\xe9/m.mtl"), "newmtl m\nKd 1 0 0\n").expect("a library");
    let scene = "image = { width = 16, height = 12 }\n[[object]]\nmesh = \"c.obj\"\n";
    std::fs::write(at(b"f\xe9/s\xff.toml"), scene).expect("a scene");
    let (render, out) = (name(b"render"), name(b"-o"));
    let picture = name(b"\xfe.png");
    let ended = run(&[render, name(b"c\xe9.obj"), out, picture]);
    ended.done().says("c\\xE9.obj: ");
    assert!(at(b"\xfe.png").is_file());
    // Meshes and libraries are found in the scene's folder, whatever bytes its name has.
    let ended = run(&[render, name(b"f\xe9/s\xff.toml"), out, picture]);
    assert!(!ended.done().err.contains("warning"), "the library is read");
    run(&[name(b"diff"), picture, picture])
        .done()
        .prints("equal");
    run(&[name(b"info"), name(b"f\xe9/c.obj")])
        .done()
        .prints("f\\xE9/c.obj");
    let quick = ["--time-budget", "0", "-m", "flat"].map(OsStr::new);
    for command in ["compare", "bench"] {
        let all = [&[OsStr::new(command), name(b"c\xe9.obj")], &quick[..]].concat();
        run(&all).done().prints("c\\xE9.obj");
    }
    let page = [
        name(b"report"),
        name(b"f\xe9/s\xff.toml"),
        out,
        name(b"\xfe.html"),
    ];
    run(&[&page, &quick[..]].concat()).done();
    assert!(at(b"\xfe.html").is_file());
    // Inputs are not overwritten, and missing files are reported.
    let ended = run(&[render, name(b"f\xe9/s\xff.toml"), out, name(b"f\xe9/m.mtl")]);
    assert_eq!(ended.code, Some(2));
    let format = [name(b"--format"), name(b"png")];
    let all = [
        &[render, name(b"c\xe9.obj"), out, name(b"c\xe9.obj")],
        &format[..],
    ]
    .concat();
    run(&all).refused(&["`--output` is the mesh itself"]);
    for lost in [&b"n\xe9.obj"[..], b"n\xe9.toml"] {
        let lost = OsStr::from_bytes(lost);
        run(&[render, lost, out, picture]).refused(&["n\\xE9", "No such file"]);
    }
    run(&[render, name(b"c\xe9.obj"), name(b"--print-scene")])
        .done()
        .says("is not the name of a file");
}
