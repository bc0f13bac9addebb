//! The shipped scenes that show a mistake. `FASTPHONG_BLESS=1 cargo test --test documents mistakes`
//! writes the table.

use super::shown_by_table::{SHOWING, SHOWN};
use super::{Cause, told_apart};
use alloc::vec::Vec;
use fastphong::scene::input::{SCENES, resolve};

/// Returns the shipped scenes that show the mistake `id`, the best first, each with the grey levels
/// by which the mistake changes its picture.
pub fn scenes_that_show(id: &str) -> Vec<(&'static str, f32)> {
    let row = SHOWN.iter().find(|(name, _)| *name == id);
    let hundredths = row.map_or(&[][..], |(_, hundredths)| hundredths);
    let levels = hundredths.iter().map(|levels| f32::from(*levels) / 100.0);
    let mut found: Vec<(&str, f32)> = SHOWING.iter().copied().zip(levels).collect();
    found.retain(|(_, levels)| *levels >= VISIBLE);
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    found
}

/// The least mean difference in grey levels over covered pixels that is easy to tell from noise.
const VISIBLE: f32 = 0.05;

/// Returns a shipped scene where two explanations look different, if there is one.
pub fn scene_that_tells(causes: [&Cause; 2]) -> Option<&'static str> {
    let [a, b] = causes.map(|cause| &cause.mistakes[..]);
    let small = SCENES
        .iter()
        .filter(|scene| SHOWING.contains(&scene.name) && !is_large(scene.name));
    small.map(|scene| scene.name).find(|name| {
        let scene = SCENES.iter().find(|scene| scene.name == *name);
        let file = scene.and_then(|scene| scene.load().ok());
        let resolved = file.and_then(|file| resolve(&file).ok());
        let Some(mut scene) = resolved.map(|resolved| resolved.scene) else {
            return false;
        };
        (scene.width, scene.height, scene.samples) = (320, 240, 1);
        told_apart(&scene, [a, b]).is_ok_and(|levels| levels > 0.5)
    })
}

/// True for scenes that take long to prepare.
fn is_large(name: &str) -> bool {
    name == "knot-100k" || name == "fine-sphere"
}
