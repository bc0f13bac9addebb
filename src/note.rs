//! Notes: what a user should know about a mesh file, a scene or a frame before trusting a picture.
//!
//! Readers, the resolver and the engines push [`Note`]s to one list, [`Notes`]. The program, the
//! Python package and the page show the same list. A note names settings by their keys in a scene
//! file. Each of them has a [`Door`], which writes a setting the way its users set it: as a flag,
//! an argument or a key.

use alloc::borrow::Cow;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;

/// How much a note matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Know this before you trust the picture.
    Warning,
    /// A choice that was made for you, something that is not used, or something to try.
    Remark,
}

/// A setting of a scene that a note suggests.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Setting {
    /// The key in a scene file: `cull`, `object.weld`.
    pub key: &'static str,
    /// The value as text: `none`, `1e-6`. Several numbers are separated by commas.
    pub value: Cow<'static, str>,
    /// True if the value is a word, which scene files put between quotes.
    pub is_word: bool,
}

impl Setting {
    /// Makes a setting whose value is a word: `cull = "none"`.
    pub fn word(key: &'static str, value: &'static str) -> Setting {
        Setting {
            key,
            value: value.into(),
            is_word: true,
        }
    }

    /// Makes a setting whose value is a number, several numbers, or `true`: `object.weld = 1e-6`.
    pub fn number(key: &'static str, value: impl Into<Cow<'static, str>>) -> Setting {
        Setting {
            key,
            value: value.into(),
            is_word: false,
        }
    }
}

/// Writes settings the way the users of one interface set them.
pub trait Door {
    /// Returns the setting in the words of this interface: `--cull none`.
    fn setting(&self, setting: &Setting) -> String;
}

/// The door of scene files: `cull = "none"`. [`Note`]'s `Display` uses it.
#[derive(Clone, Copy, Debug)]
pub struct SceneKeys;

impl Door for SceneKeys {
    fn setting(&self, setting: &Setting) -> String {
        let Setting { key, value, .. } = setting;
        match value.split_once(',') {
            _ if setting.is_word => format!("`{key} = \"{value}\"`"),
            // The only setting that has two numbers, and two keys.
            Some((azimuth, elevation)) => {
                format!("`camera = {{ azimuth = {azimuth}, elevation = {elevation} }}`")
            }
            None => format!("`{key} = {value}`"),
        }
    }
}

/// A part of a note's sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Text(Cow<'static, str>),
    Setting(Setting),
}

/// One sentence about a mesh file, a scene or a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Note {
    /// The kind: words joined by `-`. Kinds of one group begin alike: `material/texture`.
    pub kind: &'static str,
    /// How much it matters.
    pub level: Level,
    /// The file or the mesh that it is about; empty if it is about the whole scene.
    pub about: String,
    /// The line of the first case in a text file, counted from 1; 0 if there is none.
    pub line: usize,
    /// How many cases there are.
    pub times: usize,
    /// The key of a scene file that makes the note pointless once somebody sets it.
    pub unless: Option<&'static str>,
    parts: Vec<Part>,
}

impl Note {
    fn new(kind: &'static str, level: Level, text: Cow<'static, str>) -> Note {
        Note {
            kind,
            level,
            about: String::new(),
            line: 0,
            times: 1,
            unless: None,
            parts: Vec::from([Part::Text(text)]),
        }
    }

    /// Makes a warning.
    pub fn warning(kind: &'static str, text: impl Into<Cow<'static, str>>) -> Note {
        Note::new(kind, Level::Warning, text.into())
    }

    /// Makes a remark.
    pub fn remark(kind: &'static str, text: impl Into<Cow<'static, str>>) -> Note {
        Note::new(kind, Level::Remark, text.into())
    }

    /// Continues the sentence by a setting.
    #[must_use]
    pub fn set(mut self, setting: Setting) -> Note {
        self.parts.push(Part::Setting(setting));
        self
    }

    /// Continues the sentence by text.
    #[must_use]
    pub fn say(mut self, text: impl Into<Cow<'static, str>>) -> Note {
        self.parts.push(Part::Text(text.into()));
        self
    }

    /// Sets the file or the mesh that the note is about. If it is about a part of it already, both
    /// are named.
    #[must_use]
    pub fn about(mut self, name: &str) -> Note {
        self.about = if self.about.is_empty() {
            name.to_string()
        } else {
            format!("{name}: {}", self.about)
        };
        self
    }

    /// Makes the note pointless once somebody sets `key`: see [`Notes::without_stated`].
    #[must_use]
    pub fn unless(mut self, key: &'static str) -> Note {
        self.unless = Some(key);
        self
    }

    /// Returns the sentence in the words of `door`.
    pub fn text(&self, door: &dyn Door) -> String {
        let mut text = String::new();
        if !self.about.is_empty() {
            text = format!("{}: ", self.about);
        }
        for part in &self.parts {
            match part {
                Part::Text(part) => text += part,
                Part::Setting(setting) => text += &door.setting(setting),
            }
        }
        match (self.times, self.line) {
            (1, 0) => {}
            (1, line) => text += &format!(" (line {line})"),
            (n, 0) => text += &format!(" ({n} times)"),
            (n, line) => text += &format!(" ({n} times, first in line {line})"),
        }
        text
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(&SceneKeys))
    }
}

/// Notes in the order in which they came up.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notes(Vec<Note>);

impl Notes {
    /// Adds a note, unless an equal one is there.
    pub fn push(&mut self, note: Note) {
        if !self.0.contains(&note) {
            self.0.push(note);
        }
    }

    /// Adds a case of a kind that makes one note, however often it occurs. `line` is 0 if the case
    /// has no line. `note` makes the note of the first case.
    pub fn count(&mut self, kind: &'static str, line: usize, note: impl FnOnce() -> Note) {
        if let Some(known) = self.0.iter_mut().find(|known| known.kind == kind) {
            known.times += 1;
        } else {
            let note = note();
            debug_assert_eq!(note.kind, kind);
            self.0.push(Note { line, ..note });
        }
    }

    /// Adds all notes of another list.
    pub fn append(&mut self, others: Notes) {
        others.0.into_iter().for_each(|note| self.push(note));
    }

    /// True if there is a note of this kind.
    pub fn has(&self, kind: &str) -> bool {
        self.0.iter().any(|note| note.kind == kind)
    }

    /// Removes the notes whose kinds begin with `group`.
    pub fn remove(&mut self, group: &str) {
        self.0.retain(|note| !note.kind.starts_with(group));
    }

    /// Names the file or the mesh that all notes are about.
    #[must_use]
    pub fn about(self, name: &str) -> Notes {
        self.0.into_iter().map(|note| note.about(name)).collect()
    }

    /// Leaves out the notes that are pointless because a key is set: [`Note::unless`].
    #[must_use]
    pub fn without_stated(mut self, is_stated: impl Fn(&str) -> bool) -> Notes {
        self.0
            .retain(|note| note.unless.is_none_or(|key| !is_stated(key)));
        self
    }

    /// Returns the notes.
    pub fn iter(&self) -> core::slice::Iter<'_, Note> {
        self.0.iter()
    }

    /// Returns the notes of one level, as sentences in the words of `door`.
    pub fn texts(&self, level: Level, door: &dyn Door) -> Vec<String> {
        let notes = self.iter().filter(|note| note.level == level);
        notes.map(|note| note.text(door)).collect()
    }

    /// True if there is no note.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl FromIterator<Note> for Notes {
    fn from_iter<I: IntoIterator<Item = Note>>(notes: I) -> Notes {
        let mut all = Notes::default();
        notes.into_iter().for_each(|note| all.push(note));
        all
    }
}

impl<'a> IntoIterator for &'a Notes {
    type Item = &'a Note;
    type IntoIter = core::slice::Iter<'a, Note>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for Notes {
    /// Writes one note per line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, note) in self.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            note.fmt(f)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Flags;

    impl Door for Flags {
        fn setting(&self, setting: &Setting) -> String {
            format!("--{} {}", setting.key, setting.value)
        }
    }

    #[test]
    fn a_door_writes_the_settings_of_a_note() {
        let none = Setting::word("cull", "none");
        let note = Note::warning("winding", "try ").set(none).say(" once");
        let note = note.about("b.mtl:3").about("a.obj");
        assert_eq!(note.text(&Flags), "a.obj: b.mtl:3: try --cull none once");
        let shown = "a.obj: b.mtl:3: try `cull = \"none\"` once";
        assert_eq!(note.to_string(), shown);
        let view = Note::remark("camera", "").set(Setting::number("camera.azimuth", "27,15"));
        let shown = "`camera = { azimuth = 27, elevation = 15 }`";
        assert_eq!(view.to_string(), shown);
    }

    #[test]
    fn cases_of_one_kind_make_one_note() {
        let mut notes = Notes::default();
        for line in [4, 7, 9] {
            notes.count("line", line, || {
                Note::warning("line", "lines are not drawn")
            });
        }
        notes.count("point", 5, || {
            Note::warning("point", "points are not drawn")
        });
        notes.push(Note::remark("colours", "no colours").unless("colours"));
        notes.push(Note::remark("colours", "no colours").unless("colours"));
        let all = "lines are not drawn (3 times, first in line 4)\npoints are not drawn (line 5)\nno colours";
        assert_eq!(notes.to_string(), all);
        let left = notes.clone().without_stated(|key| key == "colours");
        assert_eq!(left.iter().count(), 2);
        notes.remove("li");
        assert!(!notes.has("line") && notes.has("point"));
        assert_eq!(notes.texts(Level::Remark, &SceneKeys), ["no colours"]);
    }
}
