//! The shipped scenes.

use fastphong::scene::Scene;
use fastphong::scene::input::{SCENES, resolve};

/// Returns the shipped scenes with their names, for pictures of `width` × `height` pixels.
///
/// `million` is left out, because it is only another sphere of small polygons and its normals take
/// a second.
pub fn scenes(width: u32, height: u32) -> Vec<(&'static str, Scene)> {
    let shipped = SCENES.iter().filter(|scene| scene.name != "million");
    shipped
        .map(|shipped| {
            let file = shipped.load().expect("a shipped scene");
            let mut scene = resolve(&file).expect("a shipped scene").scene;
            (scene.width, scene.height) = (width, height);
            (shipped.name, scene)
        })
        .collect()
}
