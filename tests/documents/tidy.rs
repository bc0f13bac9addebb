//! Keeps the documentation consistent with the source.

use crate::markdown::{defines, files, is_word, places, quoted, read, root, rows};
use fastphong::shading::METHODS;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Files under `src` that may be longer than [`MOST_LINES`], each with the reason.
const LONG_FILES: &[(&str, &str)] = &[];

/// The one file that talks to a bare machine. The rules for the crate's own code do not apply to
/// it.
const MACHINE: &str = "examples/small/src/machine.rs";

/// The most lines of code in a file, without comments and tests. A longer file should be split by
/// concept.
const MOST_LINES: usize = 700;

/// Names of modules that do not describe the module's content.
const ATTICS: [&str; 3] = ["utils", "common", "helpers"];

/// The count of numbered equations in each section of the lecture: section, count.
const NUMBERED: [(u32, u32); 4] = [(1, 1), (2, 1), (3, 6), (4, 12)];

/// Returns the documents for readers.
fn documents() -> Vec<PathBuf> {
    let mut all = files("docs", "md");
    all.extend(files("report/course", "md"));
    all.extend(
        [
            "README.md",
            "CONTRIBUTING.md",
            "CHANGELOG.md",
            "program/README.md",
            "scenes/README.md",
        ]
        .map(PathBuf::from),
    );
    all
}

/// Returns the numbers in an equation comment such as "3.5, 4.1", or the range "4.9–4.12".
fn numbers(comment: &str) -> Vec<(u32, u32)> {
    let number = |text: &str| {
        let (section, equation) = text
            .trim_matches(|c: char| !c.is_ascii_digit())
            .split_once('.')?;
        Some((section.parse().ok()?, equation.parse().ok()?))
    };
    let mut found = Vec::new();
    for word in comment.split([' ', ',']) {
        match word
            .split_once('–')
            .and_then(|(from, to)| Some((number(from)?, number(to)?)))
        {
            Some((from, to)) => found.extend((from.1..=to.1).map(|equation| (from.0, equation))),
            None => found.extend(number(word)),
        }
    }
    found
}

/// Returns the comments at the ends of code lines, before the tests.
fn line_comments(source: &str) -> Vec<&str> {
    let code = source
        .split("#[cfg(test)]\nmod tests {")
        .next()
        .unwrap_or(source);
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    lines
        .filter_map(|line| Some(line.split_once("// ")?.1))
        .collect()
}

/// Returns the rows of `docs/lectures.md` whose key is the number or the formula of an equation.
fn equations() -> Vec<Vec<String>> {
    let rows = rows(&read("docs/lectures.md")).into_iter();
    let is_equation = |key: &str| key.starts_with(|c: char| c == '`' || c.is_ascii_digit());
    rows.filter(|row| is_equation(&row[0])).collect()
}

#[test]
fn every_equation_leads_to_its_line() {
    let mut seen = BTreeSet::new();
    for row in equations() {
        let [key, _, _, code, _] = &row[..] else {
            panic!("five cells: {row:?}")
        };
        let number = numbers(key).first().copied().filter(|_| !key.contains('`'));
        seen.extend(number);
        for (file, items) in places(code) {
            let source = read(&file);
            assert!(!items.is_empty(), "{key}: no item of {file} is named");
            for item in items {
                assert!(defines(&source, &item), "{key}: {file} has no `{item}`");
            }
            let has_line = line_comments(&source).iter().any(|comment| match number {
                Some(number) => numbers(comment).contains(&number),
                None => comment.contains(key.trim_matches('`')),
            });
            assert!(has_line, "{key}: no line of {file} ends in it");
        }
    }
    let all: BTreeSet<_> = NUMBERED
        .iter()
        .flat_map(|&(section, n)| (1..=n).map(move |e| (section, e)))
        .collect();
    assert_eq!(
        seen, all,
        "the numbered equations of docs/lectures.md are not those of the lecture"
    );
}

/// The figure that readers can stop, and the exercises that they program, print equation numbers in
/// brackets. Each of them stands in the table.
#[test]
fn equations_of_the_page_stand_in_the_table() {
    let keys: BTreeSet<String> = equations().into_iter().map(|row| row[0].clone()).collect();
    let mut shown = 0;
    for file in ["report/script/stop-words.js", "report/script/hands.js"] {
        for text in read(file).split('(').skip(1) {
            let Some((inside, _)) = text.split_once(')') else {
                continue;
            };
            let ends: Vec<&str> = inside.split('\u{2013}').collect();
            let is_number = |end: &&str| {
                let (section, equation) = end.split_once('.').unwrap_or(("", ""));
                let digits = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
                section.len() == 1 && digits(section) && digits(equation)
            };
            if ends.iter().all(is_number) {
                for number in ends {
                    assert!(keys.contains(number), "{file}: ({inside})");
                    shown += 1;
                }
            }
        }
    }
    assert!(shown > 20, "{shown} equations");
}

#[test]
fn every_numbered_line_stands_in_the_table() {
    let table = equations();
    let folders = ["src", "program/src"].into_iter();
    for file in folders.flat_map(|folder| files(folder, "rs")) {
        let source = read(&file);
        for comment in line_comments(&source) {
            if !comment.starts_with(|c: char| c.is_ascii_digit()) {
                continue;
            }
            for (section, equation) in numbers(comment) {
                let key = format!("{section}.{equation}");
                let named = table
                    .iter()
                    .any(|row| row[0] == key && row[3].contains(&*file.to_string_lossy()));
                assert!(
                    named,
                    "{}: `// {comment}` is not in docs/lectures.md under {key}",
                    file.display()
                );
            }
        }
    }
}

/// Comments end at column 100. Tables, code, formulas and addresses may be wider.
#[test]
fn comments_end_at_column_100() {
    let folders = [
        "src",
        "program/src",
        "tests",
        "benches",
        "examples",
        "live/src",
        "python/src",
    ];
    let mut wide = Vec::new();
    for file in folders.iter().flat_map(|folder| files(folder, "rs")) {
        let mut is_code = false;
        for (i, line) in read(&file).lines().enumerate() {
            let Some(text) = line.trim_start().strip_prefix("//") else {
                is_code = false;
                continue;
            };
            let text = text.trim_start_matches(['/', '!']);
            is_code ^= text.trim_start().starts_with("```");
            let may_be_wide = is_code
                || text.starts_with(" |")
                || text.starts_with("     ")
                || text.contains("://");
            if line.chars().count() > 100 && !may_be_wide {
                wide.push(format!("{}:{}", file.display(), i + 1));
            }
        }
    }
    assert!(wide.is_empty(), "wrap these comments: {wide:#?}");
}

/// Every text that introduces the program states the right number of methods.
#[test]
fn the_number_of_methods_is_right_everywhere() {
    let number = METHODS.len().to_string();
    let to_run = " methods to run, time, look at";
    for (name, after) in [
        ("Cargo.toml", to_run),
        ("README.md", to_run),
        ("src/lib.rs", to_run),
        ("program/src/cli/mod.rs", to_run),
    ] {
        let text = read(name);
        for (place, _) in text.match_indices(after) {
            let word = text[..place].rsplit(' ').next();
            assert_eq!(word, Some(&*number), "{name}");
        }
        assert!(
            text.contains(after) || name == "README.md",
            "{name} does not say it"
        );
    }
}

/// Documents that count the lectures' figures state the right number.
#[test]
fn the_number_of_figures_is_right_everywhere() {
    let number = fastphong_cli::lectures::FIGURES.len().to_string();
    for (name, after) in [
        ("README.md", " figures of the lectures each say"),
        ("CHANGELOG.md", " figures with what each"),
    ] {
        let text = read(name);
        let (before, _) = text.split_once(after).expect(name);
        assert_eq!(before.rsplit(' ').next(), Some(&*number), "{name}");
    }
}

/// True if a quoted text is a path of the repository.
fn is_path(text: &str) -> bool {
    let plain = !text.contains([' ', '*', '<', '$', '…', ':', '(', '{']) && !text.contains("NAME");
    let folder = [
        "src", "program", "tests", "docs", "report", "examples", "benches", "scenes", ".ci",
    ];
    let ending = [".md", ".rs", ".toml", ".obj"]
        .iter()
        .any(|e| text.ends_with(e));
    plain
        && text
            .split_once('/')
            .is_some_and(|(first, rest)| folder.contains(&first) && (ending || !rest.contains('=')))
}

#[test]
fn named_files_exist() {
    let mut count = 0;
    for document in documents() {
        let text = read(&document);
        for name in quoted(&text).into_iter().filter(|name| is_path(name)) {
            assert!(
                root().join(name).exists(),
                "{}: `{name}` does not exist",
                document.display()
            );
            count += 1;
        }
        for target in text
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split(')').next())
        {
            let file = target.split('#').next().unwrap_or_default();
            if file.is_empty() || file.contains("://") {
                continue;
            }
            let folder = document.parent().unwrap_or(Path::new(""));
            assert!(
                root().join(folder).join(file).exists(),
                "{}: link to {file}",
                document.display()
            );
            count += 1;
        }
    }
    assert!(
        count > 50,
        "only {count} files are named: are they looked for in the right way?"
    );
}

/// Every room also stands in the code map.
#[test]
fn every_module_stands_in_the_code_map() {
    let map = read("docs/architecture.md");
    let named = quoted(&map);
    let folders = ["src", "program/src"];
    let entries = folders.map(|folder| {
        let entries = fs::read_dir(root().join(folder)).expect("the folder can be read");
        entries.map(move |entry| (folder, entry.expect("the folder can be read")))
    });
    for (folder, entry) in entries.into_iter().flatten() {
        let mut name = format!("{folder}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            name.push('/');
        }
        assert!(
            named.contains(&&*name),
            "docs/architecture.md does not name `{name}`"
        );
    }
}

/// Counts the lines of a source file that are neither blank, comment nor test.
fn lines_of_code(name: &str, source: &str) -> usize {
    if name.contains("/tests") || name.ends_with("_tests.rs") {
        return 0;
    }
    let code = source
        .split("#[cfg(test)]\nmod tests {")
        .next()
        .unwrap_or(source);
    let lines = code.lines().map(str::trim);
    lines
        .filter(|line| !line.is_empty() && !line.starts_with("//"))
        .count()
}

#[test]
fn source_files_are_short_and_keep_the_rules() {
    let mut too_long = Vec::new();
    for folder in ["src", "program/src", "tests", "examples", "benches"] {
        for file in files(folder, "rs") {
            let source = read(&file);
            let name = file.to_string_lossy();
            let lines = lines_of_code(&name, &source);
            let allowed = LONG_FILES
                .iter()
                .any(|(long, why)| *long == name && !why.is_empty());
            if folder.ends_with("src") && lines > MOST_LINES && !allowed {
                too_long.push(format!("{name} has {lines} lines of code"));
            }
            // These words are written in two parts, so that this file passes its own check.
            for (head, tail) in [
                ("todo", "!("),
                ("unimplemented", "!("),
                ("unsafe", " {"),
                ("unsafe", " fn"),
                ("dbg", "!("),
            ] {
                let word = format!("{head}{tail}");
                let is_free = name == MACHINE && head == "unsafe";
                assert!(is_free || !source.contains(&word), "{name} has {word}");
            }
            for attic in ATTICS {
                let named = file.file_stem().is_some_and(|s| s == attic)
                    || file.iter().any(|part| part == attic);
                assert!(!named, "{name}: `{attic}` does not say what is in it");
            }
        }
    }
    assert!(
        too_long.is_empty(),
        "over {MOST_LINES} lines of code, to be split by concept: {too_long:?}"
    );
    for (file, _) in LONG_FILES {
        assert!(
            lines_of_code(file, &read(file)) > MOST_LINES,
            "{file} is short now: take it off the list"
        );
    }
    let manifest = read("Cargo.toml");
    assert!(
        manifest.contains("unsafe_code = \"forbid\""),
        "the compiler no longer forbids unsafe code"
    );
}

/// Returns the lines of a document's fenced shell blocks, without comments.
fn commands(text: &str) -> Vec<String> {
    let mut in_shell = false;
    let mut found = Vec::new();
    for line in text.lines() {
        match line.trim().strip_prefix("```") {
            Some(language) => in_shell = !in_shell && language == "sh",
            None if in_shell => {
                let command = line.split(" #").next().unwrap_or_default().trim();
                found.extend((!command.is_empty()).then(|| command.to_string()));
            }
            None => (),
        }
    }
    found
}

#[test]
fn commands_in_the_documents_exist() {
    let mut checked = 0;
    for document in ["README.md", "CONTRIBUTING.md"] {
        for command in commands(&read(document)) {
            checked += 1;
            // Variables of the environment come before the program.
            let is_variable = |word: &&str| word.contains('=') && !word.starts_with('-');
            let words: Vec<&str> = command.split(' ').skip_while(is_variable).collect();
            let after = |word: &str| {
                words
                    .iter()
                    .position(|w| *w == word)
                    .and_then(|i| words.get(i + 1))
            };
            if let Some(example) = after("--example") {
                assert!(
                    root().join(format!("examples/{example}.rs")).exists(),
                    "{document}: {command}"
                );
            } else if let Some(test) = after("--test") {
                assert!(
                    root().join(format!("tests/{test}/main.rs")).exists(),
                    "{document}: {command}"
                );
            } else if let Some(bench) = after("--bench") {
                assert!(
                    root().join(format!("benches/{bench}.rs")).exists(),
                    "{document}: {command}"
                );
            } else if let Some(start) = words.iter().position(|w| *w == "--" || *w == "fastphong") {
                // Other commands of cargo name the package.
                let is_ours = words[0] != "cargo" || words[1] == "run";
                if is_ours {
                    check_usage(document, &command, &words[start + 1..]);
                }
            } else if words[0].starts_with("./") || words[0].starts_with(".ci") {
                assert!(root().join(words[0]).exists(), "{document}: {command}");
            }
        }
    }
    assert!(checked > 8, "only {checked} commands were found");
}

/// Checks that the program knows a sub-command and its flags.
#[track_caller]
fn check_usage(document: &str, command: &str, words: &[&str]) {
    let Some(program) = option_env!("CARGO_BIN_EXE_fastphong") else {
        return;
    };
    let Some(sub_command) = words.first() else {
        panic!("{document}: {command}: no sub-command")
    };
    let help = Command::new(program)
        .args([sub_command, "--help"])
        .output()
        .expect("the program runs");
    assert!(
        help.status.success(),
        "{document}: {command}: no sub-command {sub_command}"
    );
    let help = String::from_utf8_lossy(&help.stdout).into_owned();
    for flag in words
        .iter()
        .filter(|word| word.starts_with('-') && word.len() > 1)
    {
        let flag = flag.split('=').next().unwrap_or_default();
        let known = help
            .match_indices(flag)
            .any(|(at, _)| !help[at + flag.len()..].starts_with(|c| is_word(c) || c == '-'));
        assert!(known, "{document}: {command}: {sub_command} has no {flag}");
    }
    let after = |flag: &str| {
        words
            .windows(2)
            .find(|pair| pair[0] == flag)
            .map(|pair| pair[1])
    };
    let methods = [after("--method"), after("--methods")];
    for method in methods
        .into_iter()
        .flatten()
        .flat_map(|list| list.split(','))
    {
        let known = method == "reference" || fastphong::shading::Variant::parse(method).is_ok();
        assert!(known, "{document}: {command}: no method {method}");
    }
    let input = words.get(1).filter(|word| !word.starts_with('-'));
    match (*sub_command, input) {
        ("render" | "compare" | "bench" | "report" | "info", Some(input))
            if !input.contains([':', '.']) =>
        {
            assert!(
                root().join(format!("scenes/{input}.toml")).exists(),
                "{document}: {command}: no scene {input}"
            );
        }
        ("list" | "explain", _) => {
            let done = Command::new(program)
                .args(words)
                .output()
                .expect("the program runs");
            assert!(done.status.success(), "{document}: {command} fails");
        }
        _ => (),
    }
}

/// Every source file belongs to a program, because its parent declares it. A file without a
/// declaration is never compiled, and its tests never run.
#[test]
fn every_file_is_compiled() {
    let mut lost = Vec::new();
    for file in ["src", "program/src", "tests"]
        .into_iter()
        .flat_map(|folder| files(folder, "rs"))
    {
        let (Some(name), Some(folder)) = (file.file_stem(), file.parent()) else {
            continue;
        };
        let name = name.to_string_lossy();
        let (name, folder) = match (&*name, folder.file_name()) {
            ("lib" | "main", _) => continue,
            ("mod", Some(own)) => (own.to_string_lossy(), folder.parent().unwrap_or(folder)),
            _ => (name, folder),
        };
        let parents = ["mod.rs", "main.rs", "lib.rs"]
            .map(|parent| folder.join(parent))
            .into_iter()
            .chain([folder.with_extension("rs")]);
        let declaration = format!("mod {name};");
        let declares = |source: String| source.lines().any(|line| line.ends_with(&declaration));
        if !parents
            .filter(|parent| root().join(parent).is_file())
            .any(|parent| declares(read(parent)))
        {
            lost.push(file.display().to_string());
        }
    }
    assert!(lost.is_empty(), "no parent declares {lost:?}");
}

/// Commands open files only in `program/src/cli/files.rs`, which makes sure that no file is both
/// read and written.
#[test]
fn commands_open_files_in_one_module() {
    let opens = [
        "fs::read(",
        "fs::read_to_string(",
        "fs::write(",
        "fs::copy(",
        "fs::rename(",
        "File::open",
        "File::create",
        "File::options",
        "OpenOptions",
        "read_picture(",
        "write_picture(",
        "write_file",
        "input::load(",
        "input::resolve(",
        "SceneFile::load",
        "load_mesh",
    ];
    let mut found = 0;
    for path in files("program/src/cli", "rs") {
        let source = read(&path);
        let is_files = path.ends_with("files.rs");
        // Files in which the system describes the program do not belong to the user.
        let code = source.lines().filter(|line| !line.contains("/proc/"));
        for line in code.filter(|line| !line.trim_start().starts_with("//")) {
            for open in opens.iter().filter(|open| line.contains(*open)) {
                assert!(
                    is_files,
                    "{}: `{open}`: use program/src/cli/files.rs",
                    path.display()
                );
                found += 1;
            }
        }
    }
    assert!(found > 3, "program/src/cli/files.rs opens them");
}
