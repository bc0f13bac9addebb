//! The default material of a mesh file with vertex colours.

use super::check::Section;
use super::diagnostics::Origin;
use super::value::{Data, SceneTable};
use crate::mesh::Material;
use crate::scene::Object;

/// Gives `object` the neutral material, except for what flags say about it. Adds the changed keys
/// to `chosen`. The usual default material is brown, and the file's colours times brown would not
/// look like the file's colours.
pub(super) fn take_neutral_material(scene: &Section, object: &mut Object, chosen: &mut SceneTable) {
    let given = scene.section("material", "material");
    let is_open = |key: &str| {
        let value = given.table.get(key);
        // No scene file names the mesh, so every value that no flag set is a default.
        !value.is_some_and(|value| matches!(value.origin, Origin::Flag(_)))
    };
    let (neutral, material) = (Material::NEUTRAL, object.material.get_or_insert_default());
    let table = chosen.table_mut("material");
    let mut set = |key, data| table.set(key, data, Origin::Program);
    let wide = |colour: [f32; 3]| Data::Triple(colour.map(f64::from));
    if is_open("ka") {
        material.ambient = neutral.ambient;
        set("ka", wide(neutral.ambient));
    }
    if is_open("kd") {
        material.diffuse = neutral.diffuse;
        set("kd", wide(neutral.diffuse));
    }
    if is_open("ks") {
        material.specular = neutral.specular;
        set("ks", wide(neutral.specular));
    }
}
