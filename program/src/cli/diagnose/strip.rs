//! Three pictures side by side: yours, the reference, and the reference with your mistakes. Below
//! them, one row for each of several mistakes: the part of the picture that correcting it changes
//! most, before and after, and how it should be.

use crate::diagnose::{DiagnoseError, Diagnosis, Question, Shown};
use fastphong::picture::{Picture, Picture8};
use font8x8::{BASIC_FONTS, UnicodeFonts};

/// The largest side of a picture in the strip, in pixels. Larger pictures show every second pixel,
/// or every third, and so on.
const WIDEST: usize = 1280;

/// The gap between two pictures, in pixels.
const GAP: usize = 8;

/// The side of a letter in pixels.
const LETTER: usize = 8;

/// The colours of captions and of their ground.
const INK: [u8; 4] = [230, 230, 230, 255];
const GROUND: [u8; 4] = [32, 32, 36, 255];

/// Draws the strip. The third picture is left out if the picture is right or no mistake explains
/// it.
///
/// # Errors
/// If the scene cannot be drawn.
pub fn strip(question: &Question<'_>, found: &Diagnosis) -> Result<Picture8, DiagnoseError> {
    let scene = question.scene;
    let size = [scene.width, scene.height].map(|side| side as usize);
    let step = size[0].max(size[1]).div_ceil(WIDEST);
    let yours = found.yours(question, step);
    let reference = found.draw(question, Shown::Reference, step)?;
    let mut rows = vec![vec![
        ("yours".to_owned(), yours.clone()),
        ("right".to_owned(), reference.clone()),
    ]];
    if let Some(cause) = found.causes.first() {
        let explained = found.draw(question, Shown::Corrected(0), step)?;
        rows[0].push((format!("right, with your {}", cause.word()), explained));
        let (mut before, mut off) = (yours, found.reference.levels);
        let steps = cause.steps.iter().enumerate();
        for (count, correction) in steps.filter(|_| cause.mistakes.len() > 1) {
            let after = found.draw(question, Shown::Corrected(count + 1), step)?;
            if let Some(part) = correction.part {
                let part = part.map(|side| side / step);
                let left = correction.left;
                let caption = format!("fix {}: {off:.2} -> {left:.2}", count + 1);
                rows.push(vec![
                    ("before".to_owned(), enlarged(&before, part)),
                    (caption, enlarged(&after, part)),
                    ("right".to_owned(), enlarged(&reference, part)),
                ]);
            }
            (before, off) = (after, correction.left);
        }
    }
    Ok(joined(&rows))
}

/// Returns a part of a picture, with each pixel as a square, as wide as the picture at most.
fn enlarged(picture: &Picture8, [x, y, width, height]: [usize; 4]) -> Picture8 {
    let [width, height] = [width.max(1), height.max(1)];
    let scale = (picture.width() / width).max(1);
    let mut part = Picture::new(width * scale, height * scale, GROUND);
    for row in 0..height * scale {
        let from = picture.row((y + row / scale).min(picture.height() - 1));
        for (column, pixel) in part.row_mut(row).iter_mut().enumerate() {
            *pixel = from[(x + column / scale).min(from.len() - 1)];
        }
    }
    part
}

/// Puts pictures in rows, each with its caption above.
fn joined(rows: &[Vec<(String, Picture8)>]) -> Picture8 {
    let widest = |row: &Vec<(String, Picture8)>| {
        let all = row.iter().map(|(_, picture)| picture.width());
        all.max().unwrap_or(0)
    };
    let column = rows.iter().map(widest).max().unwrap_or(0);
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let scale = (column / 320).max(1);
    let head = (LETTER + 4) * scale;
    let tall = |row: &Vec<(String, Picture8)>| {
        let all = row.iter().map(|(_, picture)| picture.height());
        head + all.max().unwrap_or(0)
    };
    let height: usize = rows.iter().map(tall).sum();
    let mut strip = Picture::new(columns * column + (columns - 1) * GAP, height, GROUND);
    let mut top = 0;
    for row in rows {
        for (place, (caption, picture)) in row.iter().enumerate() {
            let left = place * (column + GAP);
            write(&mut strip, caption, [left, top + 2 * scale], column, scale);
            for y in 0..picture.height() {
                let to = &mut strip.row_mut(top + head + y)[left..][..picture.width()];
                to.copy_from_slice(picture.row(y));
            }
        }
        top += tall(row);
    }
    strip
}

/// Writes as much of a text as `width` pixels hold.
fn write(picture: &mut Picture8, text: &str, [left, top]: [usize; 2], width: usize, scale: usize) {
    let letters = text.chars().take(width / (LETTER * scale));
    for (place, letter) in letters.enumerate() {
        let lines = BASIC_FONTS.get(letter).unwrap_or_default();
        for y in 0..LETTER * scale {
            let row = picture.row_mut(top + y);
            for x in 0..LETTER * scale {
                if lines[y / scale] >> (x / scale) & 1 == 1 {
                    row[left + place * LETTER * scale + x] = INK;
                }
            }
        }
    }
}
