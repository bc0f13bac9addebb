//! `fastphong search`: worst cases, in one run or in parts.

use super::Folder;
use serde_json::Value;

const SMALL: &str =
    "search -m gouraud,six-point,difference-vector --degrees 10,20 --lights 1,2 --restarts 6 -q";

/// Joined in any order, the parts equal the result of one run.
#[test]
fn four_parts_find_what_one_run_finds() {
    let folder = Folder::new();
    let mut whole = folder.run(&format!("{SMALL} --json -")).done().json();
    for part in 1..=4 {
        folder
            .run(&format!("{SMALL} --shard {part}/4 --json {part}.json"))
            .done();
    }
    let joined = "search --from 3.json 1.json 4.json 2.json --json all.json";
    let table = folder.run(joined).done().out;
    let mut all: Value = serde_json::from_slice(&folder.read("all.json")).unwrap();
    for document in [&mut whole, &mut all] {
        document.as_object_mut().unwrap().remove("command_line");
    }
    assert_eq!(whole, all);
    assert_eq!(whole["cases"].as_array().unwrap().len(), 3 * 2 * 2);
    assert_eq!(folder.run(SMALL).done().out, table);
}

#[test]
fn parts_that_do_not_make_a_whole_are_refused() {
    let folder = Folder::new();
    const PART: &str = "expected a part of a whole of 100000 at most, as in 3/16";
    let few = "search -m gouraud --degrees 10 --lights 1 -q";
    for part in 1..=3 {
        folder
            .run(&format!(
                "{few} --restarts 3 --shard {part}/3 --json {part}.json"
            ))
            .done();
    }
    folder
        .run(&format!("{few} --restarts 4 --shard 2/3 --json other.json"))
        .done();
    folder
        .write("text.json", "{}")
        .write("report.json", r#"{"schema": "fastphong.report/1"}"#);
    for (files, said) in [
        (
            "1.json 3.json",
            "1.json: of 3 parts of this run are missing: 2",
        ),
        (
            "1.json 2.json 2.json 3.json",
            "2.json: part 2 of 3 is there twice",
        ),
        (
            "1.json other.json 3.json",
            "other.json: part of another run than 1.json",
        ),
        ("text.json", "text.json: missing field `schema`"),
        ("report.json", "report.json: missing field"),
        ("none.json", "none.json: cannot be read"),
    ] {
        folder
            .run(&format!("search --from {files}"))
            .refused(&[said]);
    }
    for (flags, said) in [
        ("--shard 0/3", PART),
        ("--shard 4/3", PART),
        ("--shard 1/100001", PART),
        ("--degrees 0,5", "degrees from 1 to 90"),
        ("--lights 9", "numbers of lights from 1 to 8"),
        ("--restarts 0", "a number of restarts from 1 to 100000"),
        ("-m phong", "unknown method"),
    ] {
        folder.run(&format!("search {flags}")).refused(&[said]);
    }
    folder
        .run("search --from 1.json 2.json 3.json --json 2.json")
        .refused(&["2.json"]);
}
