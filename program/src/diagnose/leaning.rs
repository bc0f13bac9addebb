//! Finds out that a picture leans, because its rows were written with another length than they were
//! read with.

use super::mistakes::{MISTAKES, Mistake};
use super::outline::{Mask, TURNS};
use super::recipe::{Geometry, Place, Recipe, Turn};
use super::rows::Rows;
use super::stage::Stage;
use super::subject::{Subject, is_drawn};
use alloc::vec::Vec;

/// The least error of an outline that suggests another layout, and the largest with it.
const OTHER_OUTLINE: f64 = 0.05;

/// Another layout must leave at most this share of the outline's error.
const MOST_LEFT: f64 = 0.3;

/// About how many pixels choose the layouts that are looked at closely, and how many are.
const POINTS: usize = 3000;
const CLOSELY: usize = 2;

/// Finds the layout of rows that puts an outline right, if no camera does. `subject` is left as it
/// was.
pub fn find(stage: &Stage<'_>, subject: &mut Subject<'_>, background: [f32; 3]) -> Option<Rows> {
    if !subject.has_bytes() {
        return None;
    }
    let covered = Mask::of_geometry(stage, Geometry::default())?;
    let read = least_error(subject, background, &covered);
    if read <= OTHER_OUTLINE {
        return None;
    }
    let points = super::grid(subject.size(), POINTS);
    let mut ranked: Vec<(usize, Rows)> = Vec::new();
    for rows in Rows::all(subject.bytes()) {
        subject.rows = Some(rows);
        let drawn = points.iter().filter_map(|&pixel| {
            let levels = subject.levels(pixel)?;
            Some((pixel, is_drawn(levels, background)))
        });
        let drawn: Vec<_> = drawn.collect();
        let wrong = TURNS.map(|turn| {
            let place = Place {
                turn,
                moved: [0, 0],
            };
            let is_covered = |pixel| {
                let own = place.pixel(pixel, subject.size(), false);
                own.is_some_and(|own| covered.contains(own))
            };
            let wrong = drawn.iter().filter(|(p, drawn)| is_covered(*p) != *drawn);
            wrong.count()
        });
        // Bytes that were dropped leave the picture's end unknown, half of it at most.
        if 2 * drawn.len() >= points.len() {
            let least = wrong.into_iter().min().unwrap_or(0);
            ranked.push((1000 * least / drawn.len(), rows));
        }
    }
    ranked.sort_by_key(|(wrong, _)| *wrong);
    let mut best: Option<(f64, Rows)> = None;
    for (_, rows) in ranked.into_iter().take(CLOSELY) {
        subject.rows = Some(rows);
        let error = least_error(subject, background, &covered);
        if best.is_none_or(|(least, _)| error < least) {
            best = Some((error, rows));
        }
    }
    subject.rows = None;
    let (error, rows) = best?;
    let most = OTHER_OUTLINE.min(MOST_LEFT * read);
    let is_right = error <= most && error <= MOST_LEFT * by_camera(stage, subject, background);
    is_right.then_some(rows)
}

/// Returns the least error of an outline with any turn and shift.
fn least_error(subject: &Subject<'_>, background: [f32; 3], covered: &Mask) -> f64 {
    let outline = subject.outline(background);
    let places = outline.places(covered, &TURNS);
    places
        .iter()
        .fold(1.0, |least, placed| placed.error.min(least))
}

/// Returns the least error of an outline with one mistake in the camera.
fn by_camera(stage: &Stage<'_>, subject: &Subject<'_>, background: [f32; 3]) -> f64 {
    let outline = subject.outline(background);
    let plain = Recipe::default();
    let recipes = MISTAKES
        .iter()
        .filter_map(|mistake| Mistake::all(&[mistake], plain, stage.scene))
        .filter(|recipe| recipe.geometry != plain.geometry);
    let masks = recipes.filter_map(|recipe| Mask::of_geometry(stage, recipe.geometry));
    let errors = masks.map(|covered| {
        let places = outline.places(&covered, &[Turn::Stated]);
        places
            .iter()
            .fold(1.0, |least, placed| placed.error.min(least))
    });
    errors.fold(1.0, f64::min)
}
