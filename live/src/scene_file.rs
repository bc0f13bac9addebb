//! Writes the scene in its current view as a scene file, which the program can draw.

use crate::studio::{Loaded, Studio};
use fastphong::glam::DVec3;
use fastphong::scene::Projection;
use fastphong::scene::file::SceneFile;
use fastphong::scene::file::diagnostics::Origin;
use fastphong::scene::file::value::{Data, SceneTable};

impl Studio {
    pub fn scene(&mut self) -> Result<usize, String> {
        let loaded = self.loaded.as_ref().ok_or("no scene")?;
        let text = looked_at(loaded)?.to_toml();
        Ok(self.say(text))
    }
}

fn looked_at(loaded: &Loaded) -> Result<SceneFile, String> {
    let mut file = loaded.file.clone();
    let mut over = SceneTable::default();
    let triple = |v: DVec3| Data::Triple(v.to_array());
    let set = |table: &mut SceneTable, key, data| table.set(key, data, Origin::Program);
    let image = over.table_mut("image");
    for (key, side) in ["width", "height"].into_iter().zip(loaded.size) {
        set(image, key, Data::Whole(side.into()));
    }
    let camera = loaded.camera();
    let table = over.table_mut("camera");
    for (key, place) in [
        ("eye", camera.eye),
        ("target", camera.target),
        ("up", camera.up),
    ] {
        set(table, key, triple(place));
    }
    let (key, value) = match camera.projection {
        Projection::Orthographic { half_height } => ("half_height", half_height),
        Projection::Perspective { fovy } => ("fovy", fovy),
    };
    for (key, value) in [(key, value), ("near", camera.near), ("far", camera.far)] {
        set(table, key, Data::Number(value));
    }
    // A scene that states no light has a default one, which must be written to be turned.
    let mut lights = file.table().tables("light").to_vec();
    if lights.is_empty() && !loaded.shown_lights.is_empty() {
        lights.push(SceneTable::default());
    }
    for (table, light) in lights.iter_mut().zip(&loaded.shown_lights) {
        let key = if light.place.is_local() {
            "position"
        } else {
            "direction"
        };
        light.place.map(|v| set(table, key, triple(v)));
    }
    set(&mut over, "light", Data::Tables(lights));
    if loaded.exponent > 0.0 {
        if !loaded
            .file
            .meshes()
            .all(|mesh| mesh.starts_with("builtin:"))
        {
            return Err(
                "an exponent for all materials cannot be written where mesh files have their own"
                    .into(),
            );
        }
        let exponent = || Data::Number(loaded.exponent.into());
        set(over.table_mut("material"), "shininess", exponent());
        for object in file
            .objects_mut()
            .iter_mut()
            .filter(|object| object.table("material").is_some())
        {
            set(object.table_mut("material"), "shininess", exponent());
        }
    }
    file.overlay(over);
    Ok(file)
}
