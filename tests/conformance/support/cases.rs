//! Frames with the reference's answers. Each answer is computed when a test first asks for it, and
//! shared by all tests.

use super::{scene, shipped};
use crate::support::renderers;
use fastphong::frame::Frame;
use fastphong::picture::{LinearPicture, Picture};
use fastphong::raster;
use fastphong::reference::{self, Model, Visibility};
use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock};

/// The width and height of a picture; `None` stands for the scene's size.
pub type Size = Option<(i64, i64)>;

/// A frame and the reference's pictures of it.
pub struct Case {
    pub name: String,
    pub frame: Frame,
    visibility: OnceLock<Visibility>,
    seen: OnceLock<Picture<u32>>,
    decided: OnceLock<Picture<bool>>,
    truths: [OnceLock<LinearPicture>; Model::ALL.len()],
}

impl Case {
    pub fn new(name: impl Into<String>, frame: Frame) -> Case {
        Case {
            name: name.into(),
            frame,
            visibility: OnceLock::new(),
            seen: OnceLock::new(),
            decided: OnceLock::new(),
            truths: Default::default(),
        }
    }

    /// Returns the polygon that the reference sees at each sample.
    pub fn visibility(&self) -> &Visibility {
        self.visibility
            .get_or_init(|| reference::visibility(&self.frame))
    }

    /// Returns the polygon that the span engine sees at each sample.
    pub fn seen(&self) -> &Picture<u32> {
        self.seen
            .get_or_init(|| raster::polygon_indices(&self.frame))
    }

    /// Returns true at the pixels whose visible polygon rounding cannot change.
    pub fn decided(&self) -> &Picture<bool> {
        self.decided
            .get_or_init(|| renderers::decided(&self.frame, self.visibility()))
    }

    /// Returns the reference's picture under `model`.
    pub fn truth(&self, model: Model) -> &LinearPicture {
        let number = Model::ALL.iter().position(|m| *m == model);
        self.truths[number.expect("a model of the reference")]
            .get_or_init(|| reference::shade(&self.frame, self.visibility(), model).to_linear())
    }
}

/// Returns a shipped scene's case at a size.
pub fn case(name: &str, size: Size) -> &'static Case {
    static CASES: Mutex<BTreeMap<(String, Size), &'static OnceLock<Case>>> =
        Mutex::new(BTreeMap::new());
    // The lock is held only for the look-up, so cases of different scenes are made in parallel.
    let cell: &'static OnceLock<Case> = CASES
        .lock()
        .expect("no panic under the lock")
        .entry((name.into(), size))
        .or_insert_with(|| Box::leak(Box::default()));
    cell.get_or_init(|| Case::new(name, scene(name, size).frame().expect("a frame")))
}

/// Returns the cases of all shipped scenes at a size. Each is made when the iterator reaches it.
pub fn cases(size: Size) -> impl Iterator<Item = &'static Case> {
    shipped().into_iter().map(move |name| case(&name, size))
}
