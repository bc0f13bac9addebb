use super::cubes;
use crate::scene::file::SceneFile;
use std::collections::BTreeMap;
use std::path::Path;
use std::string::String;
use std::vec::Vec;

/// Returns every scene in `scenes/` by name.
fn scenes() -> BTreeMap<String, SceneFile> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let paths = std::fs::read_dir(folder)
        .expect("the scenes")
        .map(|entry| entry.expect("an entry").path());
    let files = paths.filter(|path| {
        path.extension()
            .is_some_and(|extension| extension == "toml")
    });
    let load = |path: std::path::PathBuf| {
        let name = path
            .file_name()
            .expect("a file")
            .to_string_lossy()
            .into_owned();
        (
            name,
            SceneFile::load(&path).unwrap_or_else(|error| panic!("{error}")),
        )
    };
    files.map(load).collect()
}

#[test]
fn shipped_scenes_are_valid() {
    let scenes = scenes();
    assert!(scenes.len() >= 10, "only {} scenes", scenes.len());
    for (name, file) in &scenes {
        let resolved = file
            .resolve(cubes)
            .unwrap_or_else(|error| panic!("{error}"));
        assert!(resolved.notes.is_empty(), "{name}: {}", resolved.notes);
        let size = (resolved.scene.width, resolved.scene.height);
        assert!(size == (640, 480) || size == (320, 240), "{name}: {size:?}");
        assert!(
            file.title().is_some() && file.description().is_some(),
            "{name} has no title or description"
        );
        assert_eq!(
            SceneFile::parse(&file.to_toml(), "again.toml").expect("valid"),
            *file,
            "{name}"
        );
    }
}

/// The README has exactly one row per scene, and all scenes differ.
#[test]
fn shipped_scenes_are_listed() {
    let readme = include_str!("../../../../scenes/README.md");
    let rows = readme.lines().filter_map(|line| {
        line.strip_prefix("| `")?
            .split_once("` |")
            .map(|(name, _)| name)
    });
    let mut listed: Vec<&str> = rows.filter(|name| name.ends_with(".toml")).collect();
    listed.sort_unstable();
    let scenes = scenes();
    assert_eq!(
        listed,
        scenes.keys().map(String::as_str).collect::<Vec<_>>()
    );
    for (name, file) in &scenes {
        let alike = |other: &SceneFile| {
            ["camera", "object"].map(|key| other.table.get(key))
                == ["camera", "object"].map(|key| file.table.get(key))
        };
        assert_eq!(
            scenes.values().filter(|other| alike(other)).count(),
            1,
            "{name} has a double"
        );
    }
}
