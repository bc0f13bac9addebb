//! A scene's picture inside a larger one, such as a screenshot, or a part of it.

use super::outline::Mask;
use super::recipe::{Geometry, Place, Turn};
use super::stage::Stage;
use super::subject::{Subject, background, by_frequency, is_drawn};
use super::surface::Surface;
use crate::split_mix::SplitMix;
use alloc::vec::Vec;
use fastphong::picture::image_file::FilePicture;
use fastphong::scene::Scene;

/// The largest share of the outline that may be wrong at the place that is found.
const MOST_WRONG: f64 = 0.04;

/// How many pixels of each kind, covered and not, are compared at each place.
const FEW: usize = 400;

/// How many pixels at the outline are compared at the best places.
const MANY: usize = 1500;

/// The largest share of covered pixels, or of others, that may be wrong at a place that is looked
/// at closely.
const MOST_AT_FIRST: f64 = 0.35;

/// The same for pixels beside the outline.
const MOST_AT_OUTLINE: f64 = 0.5;

/// The largest distance in pixels between two places that are tried.
const MOST_STEP: usize = 8;

/// The fewest pixels of each kind at the outline that tell where it is.
const FEWEST: usize = 40;

/// How many places are looked at closely.
const CLOSELY: usize = 12;

/// A pixel that is this close to the outline tells where it is.
const BESIDE_OUTLINE: usize = 3;

/// At other places, more than twice as much and this share of the pixels must be wrong.
const CLEARLY: f64 = 0.05;

/// The turns of a picture that are tried.
const TURNS: [Turn; 4] = [Turn::Stated, Turn::MirroredY, Turn::MirroredX, Turn::Half];

/// Finds a scene's picture, at the scene's own size, inside a picture of another size, or the part
/// of it that a smaller one shows. Returns the column and row of the picture that show the scene's
/// first pixel. They are negative if that pixel was cut off.
///
/// Returns `None` if the scene's outline is not there, or if it is not certain where.
pub fn find_window(scene: &Scene, picture: &FilePicture) -> Option<[isize; 2]> {
    let prepared = super::prepared(scene).ok()?;
    let frame = prepared.frame().ok()?;
    let surface = Surface::new(scene, &prepared, frame.origin());
    let stage = Stage::new(scene, &prepared, &surface, &[]);
    let covered = Mask::of_geometry(&stage, Geometry::default())?;
    let file = Subject::new(picture, scene, Some([0, 0]));
    let [width, height] = picture.size();
    let places = super::grid([width, height], 4000);
    let frequent = by_frequency(places.into_iter().map(|pixel| file.stored(pixel)));
    let mut backgrounds = alloc::vec![background(scene).map(|c| c as f32)];
    backgrounds.extend(frequent.iter().take(2).map(|(colour, _)| *colour));
    backgrounds.dedup();
    let drawn = backgrounds.into_iter().map(|background| {
        let is_drawn = |pixel| is_drawn(file.stored(pixel), background);
        (background, Mask::new([width, height], is_drawn))
    });
    let drawn: Vec<([f32; 3], Mask)> = drawn.collect();
    for turn in TURNS {
        let place = Place {
            turn,
            moved: [0, 0],
        };
        let turned = covered.placed(place, false);
        for (background, drawn) in &drawn {
            let Some(at) = place_of(&turned, drawn) else {
                continue;
            };
            let subject = Subject::new(picture, scene, Some(at));
            // The border of the window says which colour its background has.
            let own = subject.border().unwrap_or(*background);
            let outline = subject.outline(own);
            if outline.error_at(&turned, Place::default()) <= MOST_WRONG {
                return Some(at);
            }
        }
    }
    None
}

/// Returns the place of a set of pixels in a picture, if there is one place that is clearly better
/// than all others.
fn place_of(covered: &Mask, drawn: &Mask) -> Option<[isize; 2]> {
    let coarse = Points::anywhere(covered);
    let fine = Points::at_outline(covered);
    if coarse.counts[0] == 0 || coarse.counts[1] == 0 {
        return None;
    }
    let step = coarse.step(covered);
    let [columns, rows] = [0, 1].map(|k| {
        let first = 1 - covered.size()[k] as isize;
        (first..drawn.size()[k] as isize).step_by(step)
    });
    let mut found: Vec<(f64, [isize; 2])> = Vec::new();
    for y in rows {
        for x in columns.clone() {
            let error = coarse.error(drawn, [x, y], MOST_AT_FIRST);
            found.extend(error.map(|error| (error, [x, y])));
        }
    }
    let found = separate(found, 2 * step as isize, CLOSELY);
    let reach = step as isize;
    let mut closely: Vec<(f64, [isize; 2])> = Vec::new();
    for (_, [x, y]) in found {
        for y in y - reach..=y + reach {
            for x in x - reach..=x + reach {
                let error = fine.error(drawn, [x, y], MOST_AT_OUTLINE);
                closely.extend(error.map(|error| (error, [x, y])));
            }
        }
    }
    let best = separate(closely, BESIDE_OUTLINE as isize, 2);
    let (error, at) = *best.first()?;
    let most = 2.0 * error + CLEARLY;
    let aside = BESIDE_OUTLINE as isize;
    let moved = [[aside, 0], [-aside, 0], [0, aside], [0, -aside]];
    let others = moved.map(|[dx, dy]| fine.error(drawn, [at[0] + dx, at[1] + dy], MOST_AT_OUTLINE));
    let others = others.into_iter().flatten();
    let mut others = others.chain(best.get(1).map(|(error, _)| *error));
    others.all(|error| error > most).then_some(at)
}

/// Returns up to `most` places with the least errors, which are at least `apart` pixels apart.
fn separate(
    mut found: Vec<(f64, [isize; 2])>,
    apart: isize,
    most: usize,
) -> Vec<(f64, [isize; 2])> {
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut separate: Vec<(f64, [isize; 2])> = Vec::new();
    for (error, at) in found {
        let is_near = |other: [isize; 2]| (0..2).all(|k| (at[k] - other[k]).abs() < apart);
        if !separate.iter().any(|(_, other)| is_near(*other)) {
            separate.push((error, at));
            if separate.len() == most {
                break;
            }
        }
    }
    separate
}

/// Some pixels of a scene, in random order.
struct Points {
    /// Column and row, and true if the scene covers the pixel.
    points: Vec<([isize; 2], bool)>,
    /// How many are not covered, and how many are.
    counts: [usize; 2],
    /// How many of the covered ones must be inside the picture, at least.
    fewest: usize,
}

impl Points {
    /// Chooses as many covered pixels as others. Half of the covered ones must be inside.
    fn anywhere(covered: &Mask) -> Points {
        let mut points = Points::chosen(covered, FEW, |_| true);
        points.fewest = points.counts[1].div_ceil(2);
        points
    }

    /// Chooses pixels beside the outline.
    fn at_outline(covered: &Mask) -> Points {
        let [width, height] = covered.size();
        let by = BESIDE_OUTLINE;
        Points::chosen(covered, MANY / 2, |[x, y]| {
            let own = covered.contains([x, y]);
            let others = [
                [x.saturating_sub(by), y],
                [(x + by).min(width - 1), y],
                [x, y.saturating_sub(by)],
                [x, (y + by).min(height - 1)],
            ];
            others.iter().any(|other| covered.contains(*other) != own)
        })
    }

    /// Chooses up to `most` covered pixels, and as many others, for which `suits` is true.
    fn chosen(covered: &Mask, most: usize, suits: impl Fn([usize; 2]) -> bool) -> Points {
        let [width, height] = covered.size();
        let mut kinds = [Vec::new(), Vec::new()];
        for y in 0..height {
            for x in 0..width {
                if suits([x, y]) {
                    kinds[usize::from(covered.contains([x, y]))].push([x as u32, y as u32]);
                }
            }
        }
        let mut random = SplitMix(3);
        let mut points = Vec::new();
        let mut counts = [0; 2];
        for (kind, mut all) in kinds.into_iter().enumerate() {
            random.shuffle(&mut all);
            all.truncate(most);
            counts[kind] = all.len();
            points.extend(all.iter().map(|p| (p.map(|c| c as isize), kind == 1)));
        }
        random.shuffle(&mut points);
        let fewest = FEWEST.min(counts[1]);
        Points {
            points,
            counts,
            fewest,
        }
    }

    /// Returns the number of pixels by which places may differ without leaving the outline: half as
    /// far, at most a tenth of the covered pixels are uncovered.
    fn step(&self, covered: &Mask) -> usize {
        let is_near = |step: &usize| {
            let by = (step / 2) as isize;
            let error = self.error(covered, [by, by], 0.1);
            error.is_some_and(|error| error <= 0.2)
        };
        (2..=MOST_STEP).rev().find(is_near).unwrap_or(1)
    }

    /// Returns the share of covered pixels that are not drawn at a place, plus the share of others
    /// that are drawn. Returns `None` if one of them is larger than `most`, or if too many covered
    /// pixels are outside.
    fn error(&self, drawn: &Mask, at: [isize; 2], most: f64) -> Option<f64> {
        let [width, height] = drawn.size();
        let most_wrong = self.counts.map(|count| most * count as f64);
        let (mut outside, mut known, mut wrong) = (0, [0usize; 2], [0usize; 2]);
        for ([x, y], is_covered) in &self.points {
            let kind = usize::from(*is_covered);
            let (x, y) = ((x + at[0]) as usize, (y + at[1]) as usize);
            // Negative ones wrap around, and are outside, too.
            if x >= width || y >= height {
                outside += kind;
                if outside > self.counts[1] - self.fewest {
                    return None;
                }
                continue;
            }
            known[kind] += 1;
            if drawn.contains([x, y]) != *is_covered {
                wrong[kind] += 1;
                if wrong[kind] as f64 > most_wrong[kind] {
                    return None;
                }
            }
        }
        let share = |kind: usize| wrong[kind] as f64 / known[kind].max(1) as f64;
        let is_known = known[0] > 0 && known[1] > 0;
        (is_known && share(0).max(share(1)) <= most).then(|| share(0) + share(1))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{drawn, scene};
    use super::*;
    use fastphong::picture::Picture8;

    /// Returns a picture of `size` that shows another one at `at`, and elsewhere `around`.
    fn placed(
        picture: &Picture8,
        size: [usize; 2],
        at: [isize; 2],
        around: [u8; 4],
    ) -> FilePicture {
        let mut all = Picture8::new(size[0], size[1], around);
        for y in 0..picture.height() {
            for x in 0..picture.width() {
                let to = [x.checked_add_signed(at[0]), y.checked_add_signed(at[1])];
                if let [Some(column), Some(row)] = to
                    && column < size[0]
                    && row < size[1]
                {
                    all.row_mut(row)[column] = picture.get(x, y);
                }
            }
        }
        FilePicture::stored(all)
    }

    const GREY: [u8; 4] = [90, 120, 150, 255];

    #[test]
    fn a_scene_is_found_inside_a_larger_picture_and_its_part_in_a_smaller_one() {
        let scene = scene("teapot", [160, 120]);
        let own = drawn(&scene);
        for (size, at) in [
            ([250, 200], [31, 40]),
            ([161, 149], [1, 28]),
            ([250, 200], [120, 90]), // partly beyond the lower right corner
            ([120, 100], [-20, -11]),
            ([150, 140], [-5, 7]),
        ] {
            let picture = placed(&own, size, at, GREY);
            let found = find_window(&scene, &picture);
            assert_eq!(found, Some(at), "{size:?} {at:?}");
        }
    }

    #[test]
    fn a_scene_is_found_only_if_its_place_is_certain() {
        let scene = scene("teapot", [160, 120]);
        let own = drawn(&scene);
        let mut twice = placed(&own, [330, 120], [0, 0], GREY);
        assert_eq!(find_window(&scene, &twice), Some([0, 0]));
        if let fastphong::picture::image_file::FilePixels::Stored(picture) = &mut twice.pixels {
            for y in 0..120 {
                let (first, second) = picture.row_mut(y).split_at_mut(170);
                second.copy_from_slice(&first[..160]);
            }
        }
        assert_eq!(find_window(&scene, &twice), None);
        for colour in [GREY, [0, 0, 0, 255]] {
            for size in [[1, 1], [15, 9], [300, 200]] {
                let nothing = placed(&own, size, [-500, -500], colour);
                assert_eq!(find_window(&scene, &nothing), None, "{size:?} {colour:?}");
            }
        }
        let other = placed(
            &drawn(&self::scene("vase", [160, 120])),
            [250, 200],
            [31, 40],
            GREY,
        );
        assert_eq!(find_window(&scene, &other), None);
    }
}
