//! Lists what a reader of the page should know about the scene and its frame.

use crate::studio::Studio;
use fastphong::note::{Level, SceneKeys};
use fastphong::notes::{Cost, of_frame};

impl Studio {
    /// Writes the notes about the scene, its meshes and the frame into the text, one per line,
    /// warnings first, and returns the text's length.
    ///
    /// They name settings by the keys of scene files, because the page has a control for none of
    /// them, and saves the scene as a file.
    pub fn notes(&mut self) -> usize {
        let Some(loaded) = &self.loaded else {
            return self.say(String::new());
        };
        let mut notes = loaded.notes.clone();
        if let Some(frame) = &self.frame {
            let of_frame = of_frame(&loaded.shown(), frame, Cost::Samples);
            notes.append(of_frame.without_stated(|key| loaded.file.states(key)));
        }
        let lines = [Level::Warning, Level::Remark].map(|level| notes.texts(level, &SceneKeys));
        self.say(lines.concat().join("\n"))
    }
}
