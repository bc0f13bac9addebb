//! Two pages of the course tell students and teachers how to check pictures. Here their commands
//! and scripts run as they are printed.

use super::Folder;
use serde_json::Value;
use std::process::{Command, Output};

/// The page for students.
const PAGE: &str = include_str!("../../report/course/check-your-own.md");

/// The page for teachers.
const TEACHING: &str = include_str!("../../report/course/teaching.md");

/// Returns the code block that is called `name`; panics if there is none.
fn script(name: &str) -> &'static str {
    let (_, rest) = PAGE
        .split_once(&format!("<!-- script: {name} -->\n```"))
        .unwrap_or_else(|| panic!("no script {name}"));
    let (_, text) = rest.split_once('\n').expect("a language");
    text.split("\n```").next().expect("an end")
}

/// Draws the vase at a small size into the file `name`.
fn draw(folder: &Folder, name: &str, flags: &str) {
    folder
        .run(&format!(
            "render vase --size 80x60 --alpha opaque {flags} -o {name}"
        ))
        .done();
}

/// Runs a command in `folder`, with the tested program on the path.
fn run(folder: &Folder, command: &[&str]) -> Output {
    let others = std::env::var("PATH").expect("a path");
    Command::new(command[0])
        .args(&command[1..])
        .current_dir(folder.path("submission"))
        .env("AUTOGRADER", folder.path(""))
        .env("BIN", folder.path("bin"))
        .env("PATH", format!("{}:{others}", folder.path("bin").display()))
        .output()
        .expect("a command that runs")
}

/// Builds Gradescope's layout from the scripts of the page, and runs `setup.sh`.
fn autograder() -> Folder {
    let folder = Folder::new();
    for name in ["source", "submission", "results", "bin"] {
        std::fs::create_dir(folder.path(name)).expect("a folder");
    }
    for name in ["setup.sh", "run_autograder", "grade", "validate"] {
        folder.write(&format!("source/{name}"), script(name));
    }
    let program = std::fs::read(env!("CARGO_BIN_EXE_fastphong")).expect("the program");
    folder.write("source/fastphong", program);
    let setup = run(&folder, &["sh", "../source/setup.sh"]);
    assert!(setup.status.success(), "{setup:?}");
    folder
}

/// Runs the autograder. Returns the score and the output of each test.
fn graded(folder: &Folder) -> Vec<(f64, String)> {
    let done = run(folder, &["sh", "../source/run_autograder"]);
    assert!(done.status.success(), "{done:?}");
    let results = folder.read("results/results.json");
    let results: Value = serde_json::from_slice(&results).expect("results.json is JSON");
    let tests = results["tests"].as_array().expect("tests").iter();
    let test = |test: &Value| {
        let answer = test["output"].as_str().expect("an output");
        (
            test["score"].as_f64().expect("a score"),
            answer.replace('\n', " "),
        )
    };
    tests.map(test).collect()
}

#[test]
fn the_script_of_the_page_grades_right_and_wrong_pictures() {
    let folder = autograder();
    draw(&folder, "submission/flat.png", "--method flat");
    draw(
        &folder,
        "submission/gouraud.png",
        "--method gouraud --ambient 0",
    );
    draw(&folder, "submission/phong.png", "--method naive-phong");
    let [flat, gouraud, phong] = &graded(&folder)[..] else {
        panic!("not three tests")
    };
    assert!(flat.0 == 2.0 && flat.1.contains("agrees"), "{flat:?}");
    let is_named = gouraud.1.contains("Ambient light is missing.");
    assert!(gouraud.0 == 2.4 && is_named, "{gouraud:?}");
    assert!(phong.0 == 5.0, "{phong:?}");

    folder.write("submission/flat.png", "no picture");
    draw(&folder, "submission/gouraud.png", "--ambient 0 --no-lights");
    std::fs::remove_file(folder.path("submission/phong.png")).expect("a picture");
    let [flat, gouraud, phong] = &graded(&folder)[..] else {
        panic!("not three tests")
    };
    assert!(
        flat.0 == 0.0 && flat.1.contains("not a picture"),
        "{flat:?}"
    );
    assert!(gouraud.0 == 0.0, "a black picture: {gouraud:?}");
    assert!(
        phong.0 == 0.0 && phong.1.contains("cannot be read"),
        "{phong:?}"
    );
}

#[test]
fn the_validator_of_the_page_prints_a_share() {
    let folder = autograder();
    draw(&folder, "submission/phong.png", "--ambient 0");
    let done = run(&folder, &["sh", "../source/validate", "phong.png", "vase"]);
    let found: Value = serde_json::from_slice(&done.stdout).expect("JSON");
    assert_eq!(found["score"], 0.8, "{found}");
    assert_eq!(found["status"], "failure");
    let message = found["message"].as_str().expect("a message");
    assert!(message.contains("Ambient light is missing."), "{message}");
}

#[test]
fn the_numbers_of_the_page_are_right_and_a_mistake_is_printed() {
    let folder = Folder::new();
    folder
        .run("export vase --size 320x240 -o submission")
        .done();
    let script = script("numbers.py");
    let wrong = script.replace("2 * nl * n - l", "nl * n - l");
    assert_ne!(wrong, script);
    for (script, is_right) in [(script, true), (&*wrong, false)] {
        folder.write("submission/numbers.py", script);
        let done = run(&folder, &["python3", "numbers.py"]);
        assert!(done.status.success(), "{done:?}");
        assert_eq!(done.stdout.is_empty(), is_right, "{done:?}");
    }
}

#[test]
fn the_example_of_the_page_is_the_output_of_the_program() {
    let folder = Folder::new();
    // A picture of a rasterizer in Python that multiplies highlights by k_d, does not normalise
    // normals, samples pixels at their corners and cuts levels off.
    folder.write("mine.png", include_bytes!("four-mistakes.png"));
    let found = folder.run("diagnose mine.png vase").exits(1);
    let (answer, _) = found.out.split_once("\n\nThis scene").expect("an answer");
    assert!(PAGE.contains(answer), "the page lacks: {answer}");
}

#[test]
fn commands_and_scene_of_the_page_are_accepted() {
    let folder = Folder::new();
    let football = include_bytes!("../../scenes/football.obj");
    folder.write("football.obj", football);
    let (_, scene) = PAGE.split_once("```toml\n").expect("a scene");
    folder.write("scene.toml", scene.split("```").next().expect("an end"));
    folder.run("info scene.toml").done().prints("lights   2");

    for name in ["mine", "flat", "gouraud", "phong"] {
        folder
            .run(&format!(
                "render vase --size 320x240 --alpha opaque -o {name}.png"
            ))
            .done();
    }
    let mut count = 0;
    for block in PAGE.split("\n\n```sh\n").skip(1) {
        for line in block.split("```").next().expect("an end").lines() {
            let command = line.split('#').next().expect("a command").trim();
            let arguments = command.strip_prefix("fastphong ").expect("fastphong");
            let ended = folder.run(arguments);
            assert_ne!(ended.code, Some(2), "{command}: {}", ended.err);
            count += 1;
        }
    }
    assert!(count >= 8, "only {count} commands");
}

#[test]
fn the_commands_for_teachers_do_what_the_page_says() {
    let folder = Folder::new();
    let (_, block) = TEACHING
        .split_once("draw a right picture and a wrong one:\n\n```sh\n")
        .expect("commands to try");
    let block = block.split("\n```").next().expect("an end");
    let commands: Vec<_> = block
        .lines()
        .map(|line| &line["fastphong ".len()..])
        .collect();
    let [right, wrong, agrees, named] = commands[..] else {
        panic!("not four commands")
    };
    folder.run(right).done();
    folder.run(wrong).done();
    folder.run(agrees).done();
    let named = folder.run(named).differs();
    named.prints("Vertices are lit");

    assert!(TEACHING.contains("`fastphong figure --all -o course.html`"));
    folder.run("figure --all -o course.html").done();
    let page = String::from_utf8(folder.read("course.html")).expect("a page");
    assert!(page.contains("href=\"#course/teaching\""));
}
