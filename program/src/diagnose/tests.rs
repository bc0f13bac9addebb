//! The recipe without mistakes draws the reference's pictures.

use super::drawer::Drawer;
use super::recipe::{Rate, Recipe};
use super::stage::Stage;
use super::surface::Surface;
use super::*;
use fastphong::reference;
use fastphong::scene::input::{SCENES, load, resolve};
use std::vec::Vec;

/// Returns a shipped scene at a small size, with one sample per pixel.
pub fn scene(name: &str, [width, height]: [u32; 2]) -> Scene {
    let mut scene = resolve(&load(name).unwrap()).unwrap().scene;
    (scene.width, scene.height, scene.samples) = (width, height, 1);
    scene
}

/// Draws a scene.
pub fn drawn(scene: &Scene) -> Picture8 {
    let picture = FilePicture::stored(Picture8::new(
        scene.width as usize,
        scene.height as usize,
        [0, 0, 0, 255],
    ));
    let question = Question {
        scene,
        method: None,
        picture: &picture,
        at: None,
        light_lengths: &[],
    };
    let found = diagnose(&question, &mut |_| {}).unwrap();
    found.draw(&question, Shown::Reference, 1).unwrap()
}

/// Returns the names of the shipped scenes, except the one that takes seconds to prepare.
fn names() -> impl Iterator<Item = &'static str> {
    SCENES
        .iter()
        .map(|scene| scene.name)
        .filter(|name| *name != "million")
}

fn all_pixels(scene: &Scene) -> Vec<[usize; 2]> {
    let [width, height] = [scene.width, scene.height].map(|side| side as usize);
    (0..height)
        .flat_map(|y| (0..width).map(move |x| [x, y]))
        .collect()
}

/// The recipe of each closed form draws the reference's picture of that form.
#[test]
fn recipes_without_mistakes_are_the_reference() {
    let rates = [
        (Rate::Pixel, Model::Phong),
        (Rate::Vertex, Model::Gouraud),
        (Rate::VertexUnclamped, Model::GouraudSeparate),
        (Rate::Face, Model::Flat),
        (Rate::FaceMean, Model::FlatAverage),
        (Rate::ConstantVectors, Model::PhongConstant),
    ];
    for name in names() {
        let scene = scene(name, [64, 48]);
        let prepared = prepared(&scene).unwrap();
        let frame = prepared.frame().unwrap();
        let surface = Surface::new(&scene, &prepared, frame.origin());
        let stage = Stage::new(&scene, &prepared, &surface, &[]);
        let mut drawer = Drawer::new(&stage, all_pixels(&scene), false);
        for (rate, model) in rates {
            let picture = reference::render(&frame, model).picture;
            let mut recipe = Recipe::default();
            recipe.shading.rate = rate;
            let light = drawer.light(&recipe).unwrap();
            let hits = drawer.hits(recipe.geometry, recipe.place).unwrap();
            for (i, pixel) in picture.pixels().iter().enumerate() {
                assert_eq!(hits.is_covered(i), pixel[3] == 1.0, "{name}: pixel {i}");
                let colour = light[i].clamp(glam::DVec3::ZERO, glam::DVec3::ONE);
                if hits.is_covered(i) {
                    for (own, other) in colour.to_array().iter().zip(pixel) {
                        // Frames round positions, directions and products to `f32`. An exponent of
                        // 400 multiplies a rounding by 400: 400 · 2⁻²⁴ = 2.4e-5 of a highlight
                        // of 1. Positions in `f32` relative to lights close by add as much again.
                        assert!(
                            (own - other).abs() < 5e-5,
                            "{name} {rate:?} {i}: {own} {other}"
                        );
                    }
                }
            }
        }
    }
}
