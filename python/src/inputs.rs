//! Inputs by their paths, which need not be text.

use crate::errors::memory_error;
use fastphong::memory::check_meshes;
use fastphong::scene::input::read_input;
use pyo3::PyResult;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// An input: its path, and its name. They differ if the path is not UTF-8, because names of meshes
/// are text. The name then shows what the path has in other bytes as `�`.
#[derive(Clone)]
pub struct Input {
    pub path: PathBuf,
    pub name: String,
}

impl Input {
    /// Makes an input.
    pub fn new(path: PathBuf) -> Input {
        let name = path.to_string_lossy().into_owned();
        Input { path, name }
    }

    /// Returns the path of a file that is called `asked` beside the name, or is the name.
    fn real(&self, asked: &Path) -> PathBuf {
        let name = Path::new(&self.name);
        if asked == name {
            return self.path.clone();
        }
        let rest = name.parent().map(|folder| asked.strip_prefix(folder));
        match (rest, self.path.parent()) {
            (Some(Ok(rest)), Some(folder)) => folder.join(rest),
            _ => asked.to_owned(),
        }
    }

    /// Reads the input, or a file that it names.
    pub fn read(&self, asked: &Path) -> io::Result<Vec<u8>> {
        read_input(&self.real(asked))
    }

    /// Checks that there is enough memory for meshes, whose files are relative to `folder`.
    pub fn check_meshes<'a>(
        &self,
        names: impl Iterator<Item = &'a str>,
        folder: &Path,
    ) -> PyResult<()> {
        let file = |name: &str| fs::metadata(self.real(&folder.join(name)));
        let size = |name: &str| file(name).map_or(0, |file| file.len());
        check_meshes(names, size).map_err(memory_error)
    }
}
