//! Three pictures side by side: yours, the reference, and the reference with your mistake.

use crate::diagnose::{DiagnoseError, Diagnosis, Question};
use fastphong::picture::{Picture, Picture8};

/// The largest side of a picture in the strip, in pixels. Larger pictures show every second pixel,
/// or every third, and so on.
const WIDEST: usize = 1280;

/// The gap between two pictures, in pixels.
const GAP: usize = 8;

/// Draws the strip. The third picture is left out if the picture is right or no mistake explains
/// it.
///
/// # Errors
/// If the scene cannot be drawn.
pub fn strip(question: &Question<'_>, found: &Diagnosis) -> Result<Picture8, DiagnoseError> {
    let scene = question.scene;
    let size = [scene.width, scene.height].map(|side| side as usize);
    let step = size[0].max(size[1]).div_ceil(WIDEST);
    let mut pictures = vec![
        found.yours(question, step),
        found.draw(question, false, step)?,
    ];
    if !found.causes.is_empty() {
        pictures.push(found.draw(question, true, step)?);
    }
    let (width, height) = (pictures[0].width(), pictures[0].height());
    let count = pictures.len();
    let mut strip = Picture::new(count * width + (count - 1) * GAP, height, [0; 4]);
    for (place, picture) in pictures.iter().enumerate() {
        for y in 0..height {
            let to = &mut strip.row_mut(y)[place * (width + GAP)..][..width];
            to.copy_from_slice(picture.row(y));
        }
    }
    Ok(strip)
}
