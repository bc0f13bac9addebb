//! Flags that change the scene. Each sets a key of the scene file; the key's row in the schema has
//! the name and the help of the flag. The values replace those of the file and are checked together
//! with them.

use super::mesh_hints::{Z_IS_UP, hints};
use super::normal_text::describe;
use super::{CliError, Log, files};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser};
use clap::{Arg, ArgAction, ArgMatches, Command};
use fastphong::scene::file::Resolved;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::schema::{self, AXES, Flag, KEYS, Key, ValueKind};
use fastphong::scene::file::value::{Data, SceneTable};
use fastphong::scene::file::{STANDARD_INPUT, SceneFile, shown};
use fastphong::scene::input::InputFormat;
use std::collections::HashSet;
use std::sync::Arc;

/// A key of a scene file, such as `camera.eye`, and its value.
type Setting = (&'static str, Data);

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
    let arg = match is_switch {
        true => arg.num_args(0).default_missing_value(""),
        false => arg.value_name(flag.value_name),
    };
    match flag.name {
        "resolution" => arg.visible_alias("size"),
        "light" | "light-at" => arg.action(ArgAction::Append),
        "attenuation" | "falloff" => arg.requires("light-at"),
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
        let key = match more.contains(',') {
            true => "light.colour",
            false => "light.intensity",
        };
        settings.push((key, data(key, more).ok()?));
    }
    Some(settings)
}

/// The changes that flags make to a scene, in the form of a scene file.
#[derive(Clone, Debug, Default)]
pub struct SceneFlags {
    over: SceneTable,
    /// The keys that every object gets, whatever the scene file says about it.
    every_object: SceneTable,
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
        let mut flags = SceneFlags {
            input_format: matches.get_one(INPUT_FORMAT).copied(),
            ..SceneFlags::default()
        };
        let mut lights: Vec<SceneTable> = Vec::new();
        // The keys that every light of `--light-at` gets.
        let mut near = SceneTable::default();
        for (_, flag) in keys_with_flags() {
            let origin = Origin::Flag(format!("--{}", flag.name));
            let given = matches.get_many::<Vec<Setting>>(flag.name);
            for settings in given.into_iter().flatten() {
                if matches!(flag.name, "light" | "light-at") {
                    lights.push(SceneTable::default());
                }
                for (path, data) in settings.clone() {
                    let (table, key) = path.split_once('.').unwrap_or(("", path));
                    let table = match (table, flag.name) {
                        ("", _) => &mut flags.over,
                        ("light", "light" | "light-at") => lights.last_mut().expect("a light"),
                        ("light", _) => &mut near,
                        ("object", _) => &mut flags.every_object,
                        (table, _) => flags.over.table_mut(table),
                    };
                    table.set(key, data, origin.clone());
                }
            }
        }
        let has_position = |light: &&mut SceneTable| light.get("position").is_some();
        for light in lights.iter_mut().filter(has_position) {
            light.overlay(near.clone());
        }
        if let Some(material) = flags.over.get("material") {
            let entries = &mut flags.every_object.entries;
            entries.insert("material", material.clone());
        }
        if !lights.is_empty() {
            let lights = Data::Tables(lights);
            flags.over.set("light", lights, Origin::Program);
        }
        Ok(flags)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl SceneFlags {
    /// Loads the scene that `input` names, with the changes by flags.
    ///
    /// # Errors
    /// If there is no such input.
    pub fn load(&self, input: &str) -> Result<SceneFile, CliError> {
        Ok(self.over(self.read(input)?))
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

    /// Returns `file` with the changes by flags.
    pub fn over(&self, mut file: SceneFile) -> SceneFile {
        file.overlay(self.over.clone());
        let is_of_normals = |key: &&str| matches!(*key, "normals" | "crease");
        let gives_normals = self.every_object.entries.keys().any(is_of_normals);
        for object in file.objects_mut() {
            if gives_normals {
                object.entries.retain(|key, _| !is_of_normals(key));
            }
            object.overlay(self.every_object.clone());
        }
        file
    }

    /// True if a flag sets `key`, of the scene or of its table `table`.
    pub fn gives(&self, table: Option<&str>, key: &str) -> bool {
        let table = table.map_or(Some(&self.over), |table| self.over.table(table));
        table.is_some_and(|table| table.get(key).is_some())
    }

    /// Notes which mesh files have vertex colours that only `--aov colours` would show.
    pub fn note_colours(&self, file: &SceneFile, resolved: &Resolved, log: Log) {
        let objects = resolved.scene.objects.iter().zip(file.meshes());
        let objects = objects.filter(|_| !resolved.scene.colours);
        let mut told = Vec::new();
        for (_, mesh) in objects.filter(|(object, _)| !object.mesh.colours().is_empty()) {
            if !mesh.starts_with("builtin:") && !told.contains(&mesh) {
                let has = "has vertex colours, which are not used";
                log.note(&format!("{}: {has}: --colours on uses them", shown(mesh)));
                told.push(mesh);
            }
        }
    }

    /// Notes which meshes have no vertex colours for `--aov colours`.
    pub fn note_no_colours(&self, file: &SceneFile, resolved: &Resolved, log: Log) {
        let objects = resolved.scene.objects.iter().zip(file.meshes());
        let mut told = Vec::new();
        for (_, mesh) in objects.filter(|(object, _)| object.mesh.colours().is_empty()) {
            if !told.contains(&mesh) {
                let shown = shown(mesh);
                log.note(&format!(
                    "{shown}: has no vertex colours: --aov colours shows it in white"
                ));
                told.push(mesh);
            }
        }
    }

    /// Prints warnings about a scene, where its vertex normals come from, and hints on its mesh
    /// files.
    pub fn warn(&self, file: &SceneFile, resolved: &Resolved, log: Log) {
        self.warn_without_hints(file, resolved, log);
        if log == Log::Quiet {
            return;
        }
        let mut looked_at = HashSet::new();
        let is_alone = file.path().is_none() && !self.gives(Some("camera"), "up");
        for (object, mesh) in resolved.scene.objects.iter().zip(file.meshes()) {
            if is_alone && object.mesh.up_by_custom() == Some('z') {
                log.note(&format!("{}: {Z_IS_UP}", shown(mesh)));
            }
            if !mesh.starts_with("builtin:") && looked_at.insert(Arc::as_ptr(&object.mesh)) {
                hints(shown(mesh), object)
                    .iter()
                    .for_each(|hint| log.note(hint));
            }
        }
    }

    /// Prints warnings about a scene, and where its vertex normals come from.
    pub fn warn_without_hints(&self, file: &SceneFile, resolved: &Resolved, log: Log) {
        for warning in &resolved.warnings {
            log.warning(warning);
        }
        for note in &resolved.notes {
            log.note(note);
        }
        for (object, mesh) in resolved.scene.objects.iter().zip(file.meshes()) {
            log.detail(&format!("vertex normals of {mesh}: {}", describe(object)));
        }
        let mut objects = resolved.scene.objects.iter();
        if self.over.get("material").is_some()
            && objects.any(|object| !object.mesh.materials().is_empty())
        {
            log.note("the material set by flags replaces those of the mesh file");
        }
    }
}
