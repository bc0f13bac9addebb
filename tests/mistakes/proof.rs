//! The renderer is right without mistakes, and each mistake changes a picture.

use crate::draw::{both_show, draw};
use crate::mistakes::{MISTAKES, can_be_combined};
use crate::picture::Picture;
use crate::scenes::scenes;
use crate::variation::{Edges, Filling, Variation};
use fastphong::frame::triangulate::triangulated;
use fastphong::reference::{self, Model, ReferencePicture};
use fastphong::scene::Scene;
use std::collections::HashSet;
use std::thread;

/// The variation that matches the reference: two programs with these choices and no mistakes draw
/// equal pictures.
const AS_LECTURE: Variation = Variation {
    dirty: false,
    filling: Filling::ScanLines,
    edges: Edges::Snapped,
    supersampled: false,
    opaque: false,
};

/// Returns the reference as it is stored in a file.
fn stored(reference: &ReferencePicture, scene: &Scene) -> Vec<[u8; 4]> {
    let level = |value: f64| (255.0 * value).round() as u8;
    let pixels = reference.picture.pixels().iter();
    pixels
        .map(|&[r, g, b, alpha]| {
            let [r, g, b] = [r, g, b].map(|c| level(scene.encoding.encode(c)));
            [r, g, b, level(alpha)]
        })
        .collect()
}

/// Returns the largest difference of a channel.
fn difference(a: [u8; 4], b: [u8; 4]) -> u8 {
    let channels = a.iter().zip(b);
    channels.map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

/// Returns how many pixels differ by more than `levels`.
fn differing(a: &Picture, b: &Picture, levels: u8) -> usize {
    let pixels = a.pixels.iter().zip(&b.pixels);
    pixels
        .filter(|(a, b)| difference(**a, **b) > levels)
        .count()
}

/// The reference fills polygons by scan lines, with corners rounded to 1/256 pixel. So equal pixels
/// are covered, by equal polygons. The reference's frame stores normals and directions in `f32`,
/// which moves a colour by about 2⁻²⁴ of its value times the exponent. That is far less than a
/// level, so levels differ by at most one, where a value is close to the middle between two.
#[test]
fn scan_lines_draw_the_reference() {
    for (name, scene) in scenes(320, 240) {
        let frame = scene.frame().expect("a frame");
        let expected = stored(&reference::render(&frame, Model::Phong), &scene);
        let picture = draw(&scene, &[], &AS_LECTURE);
        for (at, (&ours, &theirs)) in picture.pixels.iter().zip(&expected).enumerate() {
            assert_eq!(ours[3], theirs[3], "{name}: coverage of pixel {at}");
            assert!(
                difference(ours, theirs) <= 1,
                "{name}: pixel {at} is {ours:?}, not {theirs:?}"
            );
        }
    }
}

/// The default draws triangles and does not round corners. Rounding moves an edge by up to √2/512
/// pixel. So a pixel may have another polygon, or none, if its centre is within 0.0028 pixels of an
/// edge. These pixels lie beside another polygon, and 1 in 180 of all pixels there is that near to
/// an edge. All other pixels have the same triangle in both pictures, and its colour moves by less
/// than a level unless it changes by 350 levels from pixel to pixel.
///
/// The reference cuts a mirrored polygon into a fan about its last corner, which uses the other
/// diagonal of a quadrangle. So a colour may come from either diagonal.
#[test]
fn triangles_draw_the_triangulated_reference() {
    for (name, scene) in scenes(320, 240) {
        let frame = triangulated(&scene.frame().expect("a frame")).frame;
        let reference = reference::render(&frame, Model::Phong);
        let expected = stored(&reference, &scene);
        let draw_by = |filling| {
            let variation = Variation {
                filling,
                ..Variation::default()
            };
            draw(&scene, &[], &variation)
        };
        let ours = draw_by(Filling::Triangles);
        let others = draw_by(Filling::OtherTriangles);
        let (mut beside, mut changed) = (0, 0);
        for (at, &theirs) in expected.iter().enumerate() {
            let is_beside = is_beside_another(&reference, at);
            let mut is_same = difference(ours.pixels[at], theirs) <= 1;
            if name == "mirrored" {
                is_same |= difference(others.pixels[at], theirs) <= 1;
            }
            assert!(is_same || is_beside, "{name}: pixel {at}");
            beside += usize::from(is_beside);
            changed += usize::from(!is_same);
        }
        assert!(changed <= 3 + beside / 100, "{name}: {changed} of {beside}");
    }
}

/// True if a pixel and its neighbours do not all show one polygon.
fn is_beside_another(reference: &ReferencePicture, at: usize) -> bool {
    let polygons = &reference.polygons;
    let (x, y) = (at % polygons.width(), at / polygons.width());
    let own = polygons.get(x, y);
    let rows = y.saturating_sub(1)..(y + 2).min(polygons.height());
    let columns = x.saturating_sub(1)..(x + 2).min(polygons.width());
    rows.flat_map(|row| columns.clone().map(move |column| (column, row)))
        .any(|(column, row)| polygons.get(column, row) != own)
}

#[test]
fn mistakes_have_unique_names() {
    let names: HashSet<&str> = MISTAKES.iter().map(|mistake| mistake.id).collect();
    assert_eq!(names.len(), MISTAKES.len());
    let sentences: HashSet<&str> = MISTAKES.iter().map(|mistake| mistake.what).collect();
    assert_eq!(sentences.len(), MISTAKES.len());
    assert!(MISTAKES.len() >= 100);
    for mistake in MISTAKES {
        assert!(!can_be_combined(mistake, mistake), "{}", mistake.id);
        assert!(mistake.what.ends_with('.'), "{}", mistake.id);
    }
}

/// Draws all mistakes in `scenes`, on all processors.
fn pictures_of_mistakes(scenes: &[(&str, Scene)]) -> Vec<Vec<Picture>> {
    let variation = Variation {
        opaque: true,
        ..Variation::default()
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let share = MISTAKES.len().div_ceil(threads);
    thread::scope(|scope| {
        let parts: Vec<_> = MISTAKES
            .chunks(share)
            .map(|part| {
                scope.spawn(move || {
                    let of_mistake = |mistake| {
                        let draw = |(_, scene): &(&str, Scene)| draw(scene, &[mistake], &variation);
                        scenes.iter().map(draw).collect()
                    };
                    part.iter().map(of_mistake).collect::<Vec<Vec<Picture>>>()
                })
            })
            .collect();
        let joined = parts.into_iter().map(|part| part.join().expect("no panic"));
        joined.flatten().collect()
    })
}

/// Each mistake changes at least 20 pixels of a scene, and no two mistakes draw equal pictures of
/// all scenes.
#[test]
fn every_mistake_shows() {
    let mut scenes = scenes(96, 72);
    // Two spheres and a knot with smaller polygons are left out: they show nothing that other
    // scenes do not.
    scenes.retain(|(name, _)| !["knot-100k", "fine-sphere", "ellipsoid"].contains(name));
    let variation = Variation {
        opaque: true,
        ..Variation::default()
    };
    let right: Vec<Picture> = scenes
        .iter()
        .map(|(_, s)| draw(s, &[], &variation))
        .collect();
    let wrong = pictures_of_mistakes(&scenes);
    let mut unseen = Vec::new();
    for (mistake, pictures) in MISTAKES.iter().zip(&wrong) {
        let changed = pictures.iter().zip(&right).map(|(a, b)| differing(a, b, 0));
        if changed.max().unwrap_or(0) < 20 {
            unseen.push(mistake.id);
        }
    }
    assert!(unseen.is_empty(), "no scene shows {unseen:?}");
    let mut alike = Vec::new();
    for (i, a) in wrong.iter().enumerate() {
        for (j, b) in wrong.iter().enumerate().skip(i + 1) {
            if a == b {
                alike.push((MISTAKES[i].id, MISTAKES[j].id));
            }
        }
    }
    assert!(alike.is_empty(), "the same pictures: {alike:?}");
}

#[test]
fn one_mistake_may_hide_another() {
    let named = |id: &str| {
        let found = MISTAKES.iter().find(|mistake| mistake.id == id);
        found.expect("a mistake")
    };
    let scenes = scenes(96, 72);
    let (_, scene) = &scenes[0];
    let (missing, exponent) = (named("specular-missing"), named("exponent-missing"));
    assert!(can_be_combined(missing, exponent));
    assert!(!both_show(scene, missing, exponent));
    assert!(both_show(scene, named("ambient-missing"), exponent));
    assert!(!can_be_combined(exponent, named("exponent-128")));
}

#[test]
fn variations_are_small() {
    for (name, scene) in scenes(160, 120) {
        if name == "knot-100k" {
            continue;
        }
        let vary = |variation| draw(&scene, &[], &variation);
        let right = vary(Variation::default());
        let count = right.pixels.len();
        let dirty = vary(Variation {
            dirty: true,
            ..Variation::default()
        });
        assert_eq!(differing(&right, &dirty, 1), 0, "{name}");
        assert!(differing(&right, &dirty, 0) > count / 2, "{name}");
        let filtered = vary(Variation {
            supersampled: true,
            ..Variation::default()
        });
        let is_partly = |pixel: &&[u8; 4]| pixel[3] != 0 && pixel[3] != 255;
        let partly = filtered.pixels.iter().filter(is_partly).count();
        assert!(partly > 0 || name == "perspective", "{name}: {partly}");
        let opaque = vary(Variation {
            opaque: true,
            ..Variation::default()
        });
        assert!(opaque.pixels.iter().all(|pixel| pixel[3] == 255), "{name}");
        // Depths are rounded to 16 bits, so nearly equal ones may land on other levels if a corner
        // moves at all.
        if name == "z-fighting" {
            continue;
        }
        // Edges move by at most 0.02 pixels, and 3 of 100 pixels at an edge change to the other
        // polygon. No scene has more than a tenth of its pixels at edges where colours differ by 32
        // levels.
        for edges in [Edges::Moved, Edges::Snapped, Edges::BottomRight] {
            let moved = vary(Variation {
                edges,
                ..Variation::default()
            });
            assert!(
                differing(&right, &moved, 32) <= count / 300,
                "{name} {edges:?}"
            );
        }
    }
}
