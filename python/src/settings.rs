//! The keys of a scene under the names of Python's arguments: read from Python, and written in
//! notes.

use crate::errors::value_error;
use fastphong::note::{Door, Level, Notes, Setting};
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::value::{Data, SceneTable};
use fastphong::scene::open::{Look, Overlay};
use pyo3::PyResult;

/// Keys and the arguments that set them. Messages name a key by its argument.
const ARGUMENTS: &[(&str, &str)] = &[
    ("camera.azimuth", "view"),
    ("camera.direction", "view"),
    ("camera.elevation", "view"),
    ("camera.fovy", "fovy"),
    ("camera.up", "up"),
    ("colours", "colours"),
    ("image.background", "background"),
    ("image.height", "size"),
    ("image.samples", "samples"),
    ("image.width", "size"),
    ("light.direction", "light"),
    ("object.crease", "normals"),
    ("object.normals", "normals"),
    ("object.normals_weight", "weight"),
    ("object.weld", "weld"),
];

/// Returns the argument that sets the key at `path`, if there is one.
fn argument(path: &str) -> Option<&'static str> {
    let mut arguments = ARGUMENTS.iter();
    arguments.find_map(|(key, name)| (*key == path).then_some(*name))
}

/// Reads keys as they stand in a scene file, to lay them over a scene. An object among them stands
/// for all objects.
pub fn overlay(text: &str) -> PyResult<Overlay> {
    let mut scene = SceneTable::parse(text).map_err(|error| {
        // Each line of the text is one key.
        let mut lines = text.lines();
        let wrong = lines.find(|line| SceneTable::parse(line).is_err());
        let key = wrong.and_then(|line| line.split(" = ").next());
        let key = key.unwrap_or_default();
        value_error(format!("`{key}`: {error}"))
    })?;
    name_arguments(&mut scene, "");
    let mut every_object = SceneTable::default();
    if let Some(objects) = scene.entries.remove("object")
        && let Data::Tables(objects) = objects.data
    {
        every_object = objects.into_iter().next().unwrap_or_default();
        every_object.entries.remove("mesh");
    }
    Ok(Overlay::new(scene, every_object))
}

/// Sets the origin of each value in `table` to the argument that sets it, or else to its path.
fn name_arguments(table: &mut SceneTable, path: &str) {
    for (key, value) in &mut table.entries {
        let path = match path {
            "" => (*key).to_owned(),
            path => format!("{path}.{key}"),
        };
        match &mut value.data {
            Data::Table(table) => name_arguments(table, &path),
            Data::Tables(tables) => {
                tables
                    .iter_mut()
                    .for_each(|table| name_arguments(table, &path));
            }
            _ => {}
        }
        value.origin = Origin::Flag(argument(&path).map_or(path, str::to_owned));
    }
}

/// Returns the look called `name`.
pub fn look_named(name: &str) -> PyResult<Look> {
    match name {
        "shown" => Ok(Look::Shown),
        "compared" => Ok(Look::Compared),
        _ => {
            let problem = format!("`look` is `{name}`: expected shown or compared");
            Err(value_error(problem))
        }
    }
}

/// The door of Python: `normals=40`, and `scene={"cull": "none"}` for keys without an argument.
#[derive(Clone, Copy, Debug)]
struct Arguments;

impl Door for Arguments {
    fn setting(&self, setting: &Setting) -> String {
        let Setting { key, value, .. } = setting;
        let value = match &**value {
            "on" | "true" => "True".to_owned(),
            "off" | "false" => "False".to_owned(),
            word if setting.is_word => format!("{word:?}"),
            numbers if numbers.contains(',') => format!("({})", numbers.replace(',', ", ")),
            number => number.to_owned(),
        };
        match (argument(key), key.split_once('.')) {
            (Some(name), _) => format!("`{name}={value}`"),
            (None, Some((table, key))) => format!("`scene={{{table:?}: {{{key:?}: {value}}}}}`"),
            (None, None) => format!("`scene={{{key:?}: {value}}}`"),
        }
    }
}

/// Returns the notes of one level as sentences that name Python's arguments.
pub fn texts(notes: &Notes, level: Level) -> Vec<String> {
    let texts = notes.texts(level, &Arguments).into_iter();
    // Two keys of one argument that follow each other are passed as one mapping.
    texts
        .map(|text| text.replace("}` `scene={", ", "))
        .collect()
}
