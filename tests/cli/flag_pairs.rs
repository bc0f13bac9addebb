//! No flag is swallowed: of any two flags of a command, each changes what the command does, or the
//! command refuses the two, or says that one has no effect.
//!
//! clap waives `requires` where the required flag conflicts with one that is given, so a flag may
//! pass without effect though its definition forbids that.

use super::{Ended, Folder};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Values of flags that change what a command does with the scene below. A flag that has several
/// modes has several values; `--aov kind` is left out, because all its polygons are of one kind.
const VALUES: &[&str] = &[
    "--all",
    "--all-columns",
    "--allow 3",
    "--alpha opaque",
    "--ambient 2",
    "--aov checkerboard",
    "--aov colours",
    "--aov depth",
    "--aov normal",
    "--aov polygon",
    "--approve",
    "--as gouraud",
    "--assume linear",
    "--attenuation 0.5",
    "--background 0.4,0.3,0.2",
    "--clipping ndc-cube",
    "--colours off",
    "--csv o.csv",
    "--cull none",
    "--degrees 7",
    "--depth per-sample",
    "--depth-bits 16",
    "--encoding srgb",
    "--engine barycentric",
    "--engine cs171",
    "--engine span",
    "--eye 3,1,4",
    "--fail-above 3",
    "--falloff inverse",
    "--far 5",
    "--figures newell",
    "--fit 0.4",
    "--flip",
    "--format ppm",
    "--fovy 50",
    "--frame",
    "--frame-times",
    "--frames 3",
    "--from part.json",
    "--full",
    "--half-height 2",
    "--html o.html",
    "--input-format toml",
    "--interpolation perspective",
    "--json",
    "--json o.json",
    "--junit o.xml",
    "--ka 0.3",
    "--kd 0.9,0.1,0.2",
    "--ks 0.9",
    "--light 1,1,1",
    "--light-at 1,1,3",
    "--lights 2",
    "--line 9",
    "--markdown",
    "--mask mask.png",
    "--method gouraud",
    "--methods gouraud",
    "--near 4.6",
    "--no-lights",
    "--normals given",
    "--normals-weight area",
    "--output o.png",
    "--painter-key farthest",
    "--pictures p",
    "--polygons",
    "--print-scene",
    "--radius 2",
    "--reference other.png",
    "--reference-threshold 3",
    "--region 0,0,9,9",
    "--resolution 20x16",
    "--restarts 2",
    "--samples 2",
    "--scale 3",
    "--shard 1/2",
    "--shininess 3",
    "--shininess-for blinn",
    "--signed",
    "--simd auto",
    "--spans",
    "--specular blinn",
    "--specular-gate weighted",
    "--square 3",
    "--stats",
    "--studies none",
    "--target 0.5,0.2,0",
    "--time-budget 0",
    "--two-sided",
    "--up 1,0,0.2",
    "--view 30,40",
    "--viewer local",
    "--visibility draw-order",
    "--warmup 1",
    "--weights",
    "--weld 0.1",
];

/// Flags whose effect no file and no output shows, and why.
const UNSEEN: &[(&str, &str)] = &[
    (
        "--force",
        "allows to replace files, of which there are none",
    ),
    ("--help", "stops before anything is done"),
    ("--quiet", "leaves out messages"),
    ("--threads", "changes no byte"),
    ("--verbose", "adds messages"),
    ("--version", "stops before anything is done"),
    ("--watch", "does not end"),
];

/// Pairs whose first flag has nothing to change.
const IDLE: &[(&str, &str)] = &[
    // JSON always has everything.
    ("--all", "--json"),
    // The fitted camera stands farther away.
    ("--near", "--fit"),
    // Without lights, every method draws the ambient light.
    ("--method", "--no-lights"),
    ("--engine", "--no-lights"),
    // The engines draw nearly the same picture.
    ("--engine", "--normals"),
    // Merged corners stay on their squares.
    ("--weld", "--aov"),
    // This states what is so without it.
    ("--shininess-for", "--specular"),
    // `auto` leaves the choice to the engine.
    ("--simd", "--engine"),
];

/// The commands, as they are run with each pair of flags, and the flags of scenes that they are
/// tried with: all, or some that stand for all, because every command opens a scene in one way.
/// Commands that differ by one flag try it with all others.
const COMMANDS: &[(&str, &[&str])] = &[
    ("render s.toml -o o.png", &[]),
    ("compare s.toml -m gouraud --time-budget 0 --json", SOME),
    ("compare s.toml --weights", SOME),
    ("bench s.toml -m gouraud --time-budget 0 --json -", SOME),
    (
        "bench s.toml -m gouraud --frame-times --frames 1 --warmup 0 --json -",
        SOME,
    ),
    ("bench -m gouraud --spans --json -", SOME),
    ("report --from part.json -o o.html", SOME),
    (
        "search -m gouraud --restarts 1 --degrees 30 --lights 1 --json -",
        SOME,
    ),
    ("search --from found.json --json -", SOME),
    ("diff a.png other.png", SOME),
    ("diff old new", SOME),
    ("trace s.toml --line 9", SOME),
    ("info s.toml", SOME),
    ("diagnose cube.png builtin:cube", &["--kd"]),
    ("list methods", SOME),
    ("explain gouraud", SOME),
    ("figure newell -o o.html", SOME),
    ("export s.toml -o out", SOME),
];

/// Commands without flags, or that this build lacks.
const WITHOUT_FLAGS: &[&str] = &["completions", "help", "man", "view"];

const SOME: &[&str] = &["--kd", "--view"];

/// Flags of `render` that compare its picture, and see nothing of the scene.
const COMPARING: &[&str] = &[
    "--allow",
    "--mask",
    "--radius",
    "--reference",
    "--reference-threshold",
    "--region",
];

/// A mesh with vertex colours, materials, normals, a polygon of four sides that is not plane and
/// two positions that nearly meet, and a triangle seen from behind.
const MESH: &str = "mtllib m.mtl\nv -1 -1 0 1 0.2 0.1\nv 1 -1 0.3 0.3 1 0.2\nv 1 1 0 0.2 0.4 1\n\
    v -1 1 0.5 1 1 0.3\nv 0 0 1.5 0.5 0.9 0.7\nv 1.0001 -1 0.3 0.3 1 0.2\n\
    v 1.2 0 0.5 1 0 0\nv 1.8 0 0.5 0 1 0\nv 1.4 0.7 0.5 0 0 1\n\
    vn 0.1 0.2 1\nvn -0.3 0.1 1\nvn 0.2 -0.3 1\n\
    usemtl a\nf 1//1 2//2 5//3\nf 6//2 3//1 5//3\n\
    usemtl b\nf 3//3 4//1 5//2\nf 4//1 1//3 5//2\nf 1//1 4//2 3//1 2//3\nf 7//1 9//2 8//3\n";
const MATERIALS: &str = "newmtl a\nKa 0.1 0.1 0.1\nKd 0.7 0.5 0.4\nKs 0.3 0.3 0.3\nNs 20\n\
    newmtl b\nKa 0.1 0.1 0.1\nKd 0.3 0.5 0.6\nKs 0.5 0.3 0.3\nNs 8\n";
const SCENE: &str = "image = { width = 24, height = 18 }\ncolours = 'on'\n\
    [camera]\neye = [1, 2, 5]\ntarget = [0, 0, 0]\nfovy = 40\n\
    [[light]]\ndirection = [2, 3, 4]\ncolour = [0.9, 0.8, 0.7]\n\
    [[light]]\ndirection = [-1, 0.3, 0.4]\ncolour = [0.3, 0.2, 0.3]\n\
    [[object]]\nmesh = 'm.obj'\n\
    [[object]]\nmesh = 'builtin:gear'\ntranslate = [0.3, 0.1, 0.2]\nscale = 0.9\n\
    material = { kd = [0.2, 0.6, 0.3], ks = 0.4, shininess = 6, ka = 0.1 }\n";

/// The outcome of a command.
#[derive(PartialEq)]
struct Done {
    code: Option<i32>,
    /// The output, and the names and bytes of all files.
    made: Vec<(String, Vec<u8>)>,
    /// The lines of its messages.
    told: BTreeSet<String>,
}

impl Done {
    fn is_refused(&self) -> bool {
        self.code == Some(2)
    }

    /// True if the command does the same, whatever it says.
    fn does_as(&self, other: &Done) -> bool {
        (self.code, &self.made) == (other.code, &other.made)
    }

    /// True if a message that `other` lacks names a flag.
    fn tells(&self, flag: &str, other: &Done) -> bool {
        let is_end = |c: char| !c.is_ascii_lowercase() && c != '-';
        let mut new = self.told.difference(&other.told);
        new.any(|line| line.split(is_end).any(|word| word == flag))
    }
}

/// Returns text without what differs from run to run: times, and the command line itself.
fn lasting(bytes: Vec<u8>) -> Vec<u8> {
    fn prune(value: &mut Value) {
        const VARYING: [&str; 11] = [
            "speed",
            "timing",
            "machine",
            "command_line",
            "ns",
            "seconds",
            "ms_typical",
            "ms_median",
            "ms_min",
            "interrupted",
            "noise",
        ];
        match value {
            Value::Object(fields) => {
                fields.retain(|name, _| !VARYING.contains(&&**name));
                fields.values_mut().for_each(prune);
            }
            Value::Array(values) => values.iter_mut().for_each(prune),
            _ => {}
        }
    }
    match serde_json::from_slice(&bytes) {
        Ok(mut value) => {
            prune(&mut value);
            value.to_string().into_bytes()
        }
        Err(_) => bytes,
    }
}

/// The files that commands read.
struct Inputs(Vec<(&'static str, Vec<u8>)>);

impl Inputs {
    fn new() -> Inputs {
        let folder = Folder::new();
        folder
            .write("s.toml", SCENE)
            .write("m.obj", MESH)
            .write("m.mtl", MATERIALS);
        folder.run("render s.toml -q -o a.png").done();
        folder.run("render s.toml -q -o other.png --kd 0.3").done();
        folder
            .run("render s.toml -q -o mask.png --cull front --ambient 9")
            .done();
        let part = folder
            .run("compare s.toml -q -m gouraud --time-budget 0 --json")
            .done();
        folder.write("part.json", part.bytes);
        let cube = "render builtin:cube --resolution 16x12 --samples 1 --encoding linear";
        folder.run(&format!("{cube} -q -o cube.png")).done();
        let search = "search -m gouraud --restarts 1 --degrees 30 --lights 1 --json found.json";
        folder.run(search).done();
        let names = [
            "s.toml",
            "m.obj",
            "m.mtl",
            "a.png",
            "other.png",
            "mask.png",
            "part.json",
            "cube.png",
            "found.json",
        ];
        Inputs(names.map(|name| (name, folder.read(name))).to_vec())
    }

    /// Runs a command in a folder of its own.
    fn run(&self, arguments: &str) -> Done {
        let folder = Folder::new();
        for (name, bytes) in &self.0 {
            folder.write(name, bytes);
        }
        if arguments.contains("old new") {
            for (to, from) in [("old", "a.png"), ("new", "other.png")] {
                std::fs::create_dir(folder.path(to)).expect("a folder");
                folder.write(&format!("{to}/p.png"), folder.read(from));
            }
        }
        let mut command = folder.command(arguments);
        let output = command.env("RAYON_NUM_THREADS", "1").output();
        let ended = Ended::new(arguments, output.expect("the tool runs"));
        let mut made = vec![("output".to_owned(), lasting(ended.bytes))];
        for name in folder.names() {
            let path = folder.path(&name);
            let bytes = if path.is_dir() {
                let inside = std::fs::read_dir(path).expect("a folder");
                let files = inside.map(|entry| std::fs::read(entry.expect("a file").path()));
                files.flat_map(|file| file.expect("a file")).collect()
            } else {
                lasting(folder.read(&name))
            };
            made.push((name, bytes));
        }
        let told = ended.err.lines().map(str::to_owned).collect();
        Done {
            code: ended.code,
            made,
            told,
        }
    }
}

/// Returns the flag of a value.
fn flag(value: &str) -> &str {
    value.split(' ').next().expect("a flag")
}

/// A flag of a command.
struct FlagOf {
    name: String,
    has_value: bool,
    /// True if it changes the scene.
    is_of_scene: bool,
}

/// Returns the flags in the help of a command.
fn flags_of(command: &str) -> Vec<FlagOf> {
    let help = Folder::new().run(&format!("{command} --help")).done().out;
    let mut is_of_scene = false;
    let mut flags = Vec::new();
    for line in help.lines() {
        if !line.starts_with(' ') {
            is_of_scene = line == "Scene:";
        }
        let text = line.trim_start();
        // A flag follows its one letter, or stands below where that would be.
        let long = if line.starts_with("      --") {
            Some(text)
        } else if line.starts_with("  -") {
            text.split_once(", ").map(|(_, long)| long)
        } else {
            None
        };
        let is_end = |c: char| !c.is_ascii_lowercase() && c != '-';
        flags.extend(long.map(|long| {
            let name = long.split(is_end).next().unwrap_or_default();
            FlagOf {
                name: name.to_owned(),
                has_value: long.contains('<'),
                is_of_scene,
            }
        }));
    }
    flags
}

/// Returns the values of the flags that a command is tried with.
fn values(command: &str, scene_flags: &[&str]) -> Vec<&'static str> {
    let name = flag(command);
    let is_seen = |flag: &str| UNSEEN.iter().all(|(unseen, _)| *unseen != flag);
    let is_tried = |flag: &str| scene_flags.is_empty() || scene_flags.contains(&flag);
    let mut values = Vec::new();
    for of in flags_of(name) {
        if is_seen(&of.name) && (!of.is_of_scene || is_tried(&of.name)) {
            let all = VALUES.iter().filter(|value| flag(value) == of.name);
            let before = values.len();
            values.extend(all.filter(|value| value.contains(' ') == of.has_value));
            assert!(values.len() > before, "{name}: VALUES lacks {}", of.name);
        }
    }
    values
}

/// True if the pair can be decided without a run: the first flag compares pictures, and the second
/// one changes the scene.
fn is_apart(a: &str, b: &str) -> bool {
    let of_scene = |name: &str| !SOME.contains(&name) && schema_has(name);
    COMPARING.contains(&flag(a)) && of_scene(flag(b))
}

/// True if a key of scene files has this flag.
fn schema_has(name: &str) -> bool {
    let flags = fastphong::scene::file::schema::KEYS.iter();
    let mut flags = flags.filter_map(|key| key.flag);
    flags.any(|flag| name.strip_prefix("--") == Some(flag.name))
}

/// Runs all command lines, on all processors.
fn run_all<'a>(inputs: &Inputs, lines: &'a BTreeSet<String>) -> BTreeMap<&'a str, Done> {
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    let (next, done) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(line) = lines.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let ended = inputs.run(line);
                    done.lock().expect("no panic").insert(*line, ended);
                }
            });
        }
    });
    done.into_inner().expect("no panic")
}

#[test]
fn no_flag_is_swallowed_by_another() {
    let inputs = Inputs::new();
    let mut failures = String::new();
    for (command, scene_flags) in COMMANDS {
        let values = values(command, scene_flags);
        let with = |flags: &[&str]| [&[*command], flags].concat().join(" ");
        let all = values.iter().enumerate();
        let pairs = all.flat_map(|(i, a)| values[..i].iter().map(move |b| (*a, *b)));
        let pairs = pairs.filter(|(a, b)| flag(a) != flag(b) && !is_apart(a, b) && !is_apart(b, a));
        let pairs: Vec<(&str, &str)> = pairs.collect();
        let mut lines = BTreeSet::from([with(&[])]);
        lines.extend(values.iter().map(|a| with(&[a])));
        lines.extend(pairs.iter().map(|(a, b)| with(&[b, a])));
        let done = run_all(&inputs, &lines);
        let of = |flags: &[&str]| &done[&*with(flags)];
        let plain = of(&[]);
        assert!(!plain.is_refused(), "`{command}` is refused");
        for (a, b) in pairs {
            let both = of(&[b, a]);
            for (a, b) in [(a, b), (b, a)] {
                let (alone, other) = (of(&[a]), of(&[b]));
                let acts = both.is_refused() || !both.does_as(other);
                // Flags that do nothing alone, or the same, have nothing to lose.
                let is_idle = alone.does_as(plain) || alone.does_as(other);
                let is_known = IDLE.contains(&(flag(a), flag(b)));
                if !(acts || is_idle || is_known || both.tells(flag(a), other)) {
                    failures += &format!("`{command}`: `{a}` has no effect beside `{b}`\n");
                }
            }
        }
    }
    assert!(failures.is_empty(), "\n{failures}");
}

/// A new command is tried, too.
#[test]
fn every_command_is_tried_with_pairs_of_flags() {
    let help = Folder::new().run("--help").done().out;
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let commands = commands.take_while(|line| !line.is_empty());
    let names = commands.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    for name in names.map(|line| flag(line.trim_start())) {
        let is_tried = COMMANDS.iter().any(|(command, _)| flag(command) == name);
        assert!(is_tried || WITHOUT_FLAGS.contains(&name), "{name}");
    }
}
