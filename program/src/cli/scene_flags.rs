//! Flags that change the scene. Each sets a key of the scene file; the key's row in the schema has
//! the name and the help of the flag. The values replace those of the file and are checked together
//! with them.

use super::normal_text::describe;
use super::{CliError, Log, files, memory};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser};
use clap::{Arg, ArgAction, ArgMatches, Command};
use fastphong::frame::Frame;
use fastphong::mesh::vertex_normals::NormalUse;
use fastphong::note::{Door, Note, Notes, SceneKeys, Setting as Suggestion};
use fastphong::notes::{self, Cost};
use fastphong::scene::Projection;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::schema::{self, AXES, Flag, KEYS, Key, ValueKind};
use fastphong::scene::file::value::{Data, SceneTable};
use fastphong::scene::file::{STANDARD_INPUT, SceneFile};
use fastphong::scene::input::InputFormat;
use fastphong::scene::open::{Look, Opened, Overlay};

/// A key of a scene file, such as `camera.eye`, and its value.
type Setting = (&'static str, Data);

/// The door of the command line: `--cull none`.
#[derive(Clone, Copy, Debug)]
pub struct Flags;

impl Door for Flags {
    fn setting(&self, setting: &Suggestion) -> String {
        let Suggestion { key, value, .. } = setting;
        let flag = keys_with_flags().find(|(known, _)| known.path == *key);
        match flag.map(|(_, flag)| flag) {
            _ if *key == "object.crease" => format!("--normals crease={value}"),
            Some(flag) if flag.value_name.is_empty() => format!("--{}", flag.name),
            Some(flag) => format!("--{} {value}", flag.name),
            None => SceneKeys.setting(setting),
        }
    }
}

/// Returns the keys that have flags, with these flags.
fn keys_with_flags() -> impl Iterator<Item = (&'static Key, Flag)> {
    KEYS.iter().filter_map(|key| Some((key, key.flag?)))
}

/// Makes the clap argument for the flag of `key`.
fn arg(key: &'static Key, flag: Flag) -> Arg {
    let is_switch = flag.value_name.is_empty();
    let parser: ValueParser = match key.kind {
        ValueKind::Word(words) if flag.name != "normals" => {
            let setting = |word| vec![(key.path, Data::Text(word))];
            PossibleValuesParser::new(words).map(setting).into()
        }
        _ => ValueParser::new(move |text: &str| parse(flag.name, key.path, text)),
    };
    let arg = Arg::new(flag.name)
        .long(flag.name)
        .help(flag.meaning)
        .help_heading("Scene")
        .action(ArgAction::Set)
        .value_parser(parser)
        .allow_hyphen_values(!is_switch);
    let arg = if is_switch {
        arg.num_args(0).default_missing_value("")
    } else {
        arg.value_name(flag.value_name)
    };
    match flag.name {
        "resolution" => arg.visible_alias("size"),
        "light" | "light-at" => arg.action(ArgAction::Append),
        // clap waives `requires` beside a flag that excludes the required one.
        "attenuation" | "falloff" => arg.requires("light-at").conflicts_with("no-lights"),
        "no-lights" => arg.conflicts_with_all(["light", "light-at"]),
        _ => arg,
    }
}

/// Reads the value of the flag `name`, which sets `key`. Its range is checked later, with the scene
/// file.
fn parse(name: &str, key: &'static str, text: &str) -> Result<Vec<Setting>, String> {
    let one = |key, text| Some(vec![(key, data(key, text).ok()?)]);
    let pair = |other| {
        let (a, b) = text.split_once(['x', 'X', ','])?;
        Some([one(key, a)?, one(other, b)?].concat())
    };
    let (settings, expected) = match name {
        "resolution" => (
            pair("image.height"),
            "WIDTHxHEIGHT, 1 to 16384 each, for example 640x480",
        ),
        "view" => (pair("camera.elevation"), "two numbers azimuth,elevation"),
        "light" => (
            light(key, text),
            "a direction x,y,z, or with an intensity or a colour r,g,b after it",
        ),
        "light-at" => (
            light(key, text),
            "a position x,y,z, or with an intensity or a colour r,g,b after it",
        ),
        "normals" => {
            let settings = match text.strip_prefix("crease=") {
                Some(degrees) => one("object.crease", degrees),
                None => one(key, text),
            };
            (settings, "`auto`, `averaged`, `given` or `crease=DEGREES`")
        }
        _ => return Ok(vec![(key, data(key, text)?)]),
    };
    settings.ok_or_else(|| format!("expected {expected}"))
}

/// Reads a value of the kind that `key` has. Several numbers are separated by commas.
fn data(key: &str, text: &str) -> Result<Data, &'static str> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    match (schema::kind(key), &numbers.unwrap_or_default()[..]) {
        (Some(ValueKind::Switch), _) => Ok(Data::Switch(true)),
        (Some(ValueKind::Tables(_)), _) => Ok(Data::Tables(Vec::new())),
        (Some(ValueKind::Word(words)), _) if words.contains(&text) => {
            Ok(Data::Text(text.to_owned()))
        }
        (Some(ValueKind::Axis), _) if AXES.contains(&text) => Ok(Data::Text(text.to_owned())),
        (Some(ValueKind::Triple | ValueKind::OneOrThree | ValueKind::Axis), &[x, y, z]) => {
            Ok(Data::Triple([x, y, z]))
        }
        (Some(ValueKind::Axis), _) => {
            Err("expected an axis (x, y, z, -x, -y or -z) or three numbers x,y,z")
        }
        (Some(ValueKind::Triple), _) => Err("expected three numbers x,y,z"),
        (Some(ValueKind::OneOrThree), &[all]) => Ok(Data::Triple([all; 3])),
        (Some(ValueKind::OneOrThree), _) => Err("expected one number, or three r,g,b"),
        (Some(ValueKind::Whole), _) => {
            let text = text.trim();
            let is_whole = || {
                text.trim_start_matches(['-', '+'])
                    .bytes()
                    .all(|b| b.is_ascii_digit())
            };
            match text.parse() {
                Ok(whole) => Ok(Data::Whole(whole)),
                Err(_) if !text.is_empty() && is_whole() => {
                    Err("expected a whole number of up to 18 digits")
                }
                Err(_) => Err("expected a whole number"),
            }
        }
        (Some(ValueKind::Number), &[number]) => Ok(Data::Number(number)),
        _ => Err("expected a number"),
    }
}

/// Reads `x,y,z`, with an intensity or a colour after it if there is one.
fn light(key: &'static str, text: &str) -> Option<Vec<Setting>> {
    let third = text.match_indices(',').nth(2);
    let (place, more) = third.map_or((text, ""), |(at, _)| text.split_at(at));
    let mut settings = vec![(key, data(key, place).ok()?)];
    if let Some(more) = more.strip_prefix(',') {
        let key = if more.contains(',') {
            "light.colour"
        } else {
            "light.intensity"
        };
        settings.push((key, data(key, more).ok()?));
    }
    Some(settings)
}

/// The changes that flags make to a scene, in the form of a scene file.
#[derive(Clone, Debug, Default)]
pub struct SceneFlags {
    over: Overlay,
    /// The names of the flags that are given.
    given: Vec<&'static str>,
    /// The format of standard input; `None` if its bytes decide.
    input_format: Option<InputFormat>,
}

/// The flag of [`SceneFlags::input_format`].
const INPUT_FORMAT: &str = "input-format";

fn input_format_arg() -> Arg {
    let mesh = PossibleValue::new("mesh").alias("obj");
    let names = PossibleValuesParser::new([mesh, PossibleValue::new("toml")]);
    let format = |name: String| match &*name {
        "toml" => InputFormat::Toml,
        _ => InputFormat::Mesh,
    };
    Arg::new(INPUT_FORMAT)
        .long(INPUT_FORMAT)
        .value_name("FORMAT")
        .help("Format of standard input (`-`): a mesh, or a scene in TOML [default: by its bytes]")
        .value_parser(names.map(format))
}

impl clap::Args for SceneFlags {
    fn augment_args(command: Command) -> Command {
        let command = command.arg(input_format_arg());
        command.args(keys_with_flags().map(|(key, flag)| arg(key, flag)))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl clap::FromArgMatches for SceneFlags {
    /// Collects the values of all flags on the command line.
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let (mut scene, mut every_object) = (SceneTable::default(), SceneTable::default());
        let mut lights: Vec<SceneTable> = Vec::new();
        // The keys that every light of `--light-at` gets.
        let mut near = SceneTable::default();
        let mut names = Vec::new();
        for (_, flag) in keys_with_flags() {
            let origin = Origin::Flag(format!("--{}", flag.name));
            let given = matches.get_many::<Vec<Setting>>(flag.name);
            names.extend(given.is_some().then_some(flag.name));
            for settings in given.into_iter().flatten() {
                if matches!(flag.name, "light" | "light-at") {
                    lights.push(SceneTable::default());
                }
                for (path, data) in settings.clone() {
                    let (table, key) = path.split_once('.').unwrap_or(("", path));
                    let table = match (table, flag.name) {
                        ("", _) => &mut scene,
                        ("light", "light" | "light-at") => lights.last_mut().expect("a light"),
                        ("light", _) => &mut near,
                        ("object", _) => &mut every_object,
                        (table, _) => scene.table_mut(table),
                    };
                    table.set(key, data, origin.clone());
                }
            }
        }
        let has_position = |light: &&mut SceneTable| light.get("position").is_some();
        for light in lights.iter_mut().filter(has_position) {
            light.overlay(near.clone());
        }
        if !lights.is_empty() {
            let lights = Data::Tables(lights);
            scene.set("light", lights, Origin::Program);
        }
        Ok(SceneFlags {
            over: Overlay::new(scene, every_object),
            given: names,
            input_format: matches.get_one(INPUT_FORMAT).copied(),
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl SceneFlags {
    /// Returns the names of all flags with `others`, for a flag that leaves none of them an effect.
    pub fn and(others: &[&'static str]) -> Vec<&'static str> {
        let of_keys = keys_with_flags().map(|(_, flag)| flag.name);
        let own = [INPUT_FORMAT].into_iter().chain(of_keys);
        own.chain(others.iter().copied()).collect()
    }

    /// Opens the scene that `input` names, with the changes by flags, and prints the notes about
    /// it.
    ///
    /// # Errors
    /// If there is no such input, or it cannot be used.
    pub fn open(&self, input: &str, look: Look, log: Log) -> Result<Opened, CliError> {
        let opened = self.open_file(self.read(input)?, look)?;
        note_scene(&opened, log);
        Ok(opened)
    }

    /// Opens a scene file that was read, with the changes by flags. The caller prints its notes
    /// ([`note_scene`]).
    ///
    /// # Errors
    /// If it cannot be used.
    pub fn open_file(&self, file: SceneFile, look: Look) -> Result<Opened, CliError> {
        let mut opened = files::open(file, &self.over, look)?;
        opened.notes.append(self.all_unused(&opened));
        Ok(opened)
    }

    /// Loads the scene that `input` names, without the changes by flags.
    ///
    /// # Errors
    /// If there is no such input.
    pub fn read(&self, input: &str) -> Result<SceneFile, CliError> {
        if self.input_format.is_some() && input != STANDARD_INPUT {
            let problem = format!("`--{INPUT_FORMAT}` is for standard input, not for `{input}`");
            let expected = format!("expected the input `{STANDARD_INPUT}`");
            return Err(format!("{problem}: {expected}").into());
        }
        Ok(files::load(input, self.input_format)?)
    }

    /// Returns a note that names the flags among `names` that are given, but have no effect `on`
    /// something; no note if none is given.
    pub fn unused(&self, on: &str, names: &[&str]) -> Notes {
        let unused = self.given.iter().filter(|name| names.contains(name));
        let unused: Vec<String> = unused.map(|name| format!("--{name}")).collect();
        let text = format!("no effect on {on}: {}", unused.join(", "));
        let note = (!unused.is_empty()).then(|| Note::remark("no-effect", text));
        note.into_iter().collect()
    }

    /// Returns notes about flags from which other settings of the scene take their effect.
    fn all_unused(&self, opened: &Opened) -> Notes {
        let scene = &opened.scene;
        let mut notes = Notes::default();
        if scene.lights.is_empty() {
            let mut names = vec!["viewer", "specular", "shininess-for", "specular-gate"];
            names.extend(["normals", "normals-weight"]);
            // A material that replaces the file's changes the ambient light.
            if !opened.notes.has("material-replaced") {
                names.extend(["kd", "ks", "shininess"]);
            }
            notes.append(self.unused("colours without lights", &names));
        }
        if matches!(scene.camera.projection, Projection::Orthographic { .. }) {
            notes.append(self.unused("parallel views", &["interpolation"]));
        }
        let averaged = scene.objects.iter().map(|object| {
            let used = NormalUse::of(&object.mesh, object.normals.source);
            used.averaged
        });
        if averaged.sum::<usize>() == 0 {
            notes.append(self.unused("normals of files", &["normals-weight"]));
        }
        notes
    }

    /// Returns the changes by flags.
    pub fn over(&self) -> &Overlay {
        &self.over
    }
}

/// Prints the notes about a scene and its meshes, and with `--verbose` where its vertex normals
/// come from.
pub fn note_scene(opened: &Opened, log: Log) {
    if log == Log::Quiet {
        return;
    }
    log.notes(&opened.notes);
    for object in &opened.scene.objects {
        log.detail(&format!(
            "vertex normals of {}: {}",
            object.name,
            describe(object)
        ));
    }
    log.notes(&notes::of_meshes(&opened.scene));
}

/// Returns the frame of an opened scene, and prints the notes about it.
///
/// # Errors
/// If the scene cannot be projected, or there is too little memory for its frame.
pub fn frame_of(opened: &Opened, log: Log) -> Result<Frame, CliError> {
    memory::check_frame(&opened.scene)?;
    let frame = opened.scene.frame()?;
    note_frame(opened, &frame, log);
    Ok(frame)
}

/// Prints the notes about a frame of an opened scene.
pub fn note_frame(opened: &Opened, frame: &Frame, log: Log) {
    if log != Log::Quiet {
        let notes = notes::of_frame(&opened.scene, frame, Cost::Samples);
        log.notes(&notes.without_stated(|key| opened.file.states(key)));
    }
}
