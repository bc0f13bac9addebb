//! Keys that are laid over a scene file.

use super::SceneFile;
use super::value::SceneTable;

/// Keys that replace those of a scene file: flags of the program, or arguments of Python.
#[derive(Clone, Debug, Default)]
pub struct Overlay {
    /// The keys of the scene.
    pub scene: SceneTable,
    /// The keys that every object gets, whatever the scene file says about it.
    pub every_object: SceneTable,
}

impl Overlay {
    /// Makes an overlay. A material of the scene counts for every object, whatever materials its
    /// mesh has.
    pub fn new(scene: SceneTable, mut every_object: SceneTable) -> Overlay {
        if let Some(material) = scene.get("material") {
            let material = material.clone();
            every_object.entries.entry("material").or_insert(material);
        }
        Overlay {
            scene,
            every_object,
        }
    }

    /// True if it sets `key`, such as `image.samples`.
    pub fn sets(&self, key: &str) -> bool {
        match key.split_once('.') {
            Some((table, key)) => {
                let table = self.scene.table(table);
                table.is_some_and(|table| table.get(key).is_some())
            }
            None => self.scene.get(key).is_some(),
        }
    }

    /// True if it sets no key.
    pub fn is_empty(&self) -> bool {
        self.scene.entries.is_empty() && self.every_object.entries.is_empty()
    }
}

impl SceneFile {
    /// Replaces the values that `over` sets, as [`SceneFile::overlay`] does, in the scene and in
    /// every object. A source of normals replaces a crease, and the other way around.
    pub fn lay_over(&mut self, over: &Overlay) {
        self.overlay(over.scene.clone());
        let is_source = |key: &&str| matches!(*key, "normals" | "crease");
        let gives_source = over.every_object.entries.keys().any(is_source);
        for object in self.objects_mut() {
            if gives_source {
                object.entries.retain(|key, _| !is_source(key));
            }
            object.overlay(over.every_object.clone());
        }
    }
}
