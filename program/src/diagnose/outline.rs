//! Outlines: which camera, and which turn and shift of the picture, cover the pixels that it
//! covers.
//!
//! Outlines do not depend on light, so a camera is found though everything else is wrong. Pixels at
//! edges count: half a pixel changes 1.3 % of an ordinary outline.

use super::recipe::{Geometry, Place, Recipe, Turn};
use super::stage::Stage;
use alloc::vec;
use alloc::vec::Vec;
use fastphong::raster::{NO_POLYGON, for_each_polygon_row};

/// The largest error of a right outline. Half a pixel changes about 0.013, another rule for edges
/// 0.004.
pub const RIGHT_OUTLINE: f64 = 0.004;

/// If the outlines differ by this share, the picture may show something else.
pub const OTHER_OUTLINE: f64 = 0.03;

/// A set of pixels: a bit for each, in rows of whole words.
#[derive(Clone, PartialEq)]
pub struct Mask {
    size: [usize; 2],
    words: Vec<u64>,
}

impl Mask {
    /// Makes the set of those pixels for which `holds` is true.
    pub fn new(size: [usize; 2], mut holds: impl FnMut([usize; 2]) -> bool) -> Mask {
        let mut mask = Mask::empty(size);
        for y in 0..size[1] {
            for x in 0..size[0] {
                if holds([x, y]) {
                    mask.insert([x, y]);
                }
            }
        }
        mask
    }

    fn empty(size: [usize; 2]) -> Mask {
        let words = vec![0; size[0].div_ceil(64) * size[1]];
        Mask { size, words }
    }

    fn insert(&mut self, [x, y]: [usize; 2]) {
        let stride = self.stride();
        self.words[y * stride + x / 64] |= 1 << (x % 64);
    }

    fn stride(&self) -> usize {
        self.size[0].div_ceil(64)
    }

    /// Returns the width and height of the picture.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// True if the set contains a pixel.
    pub fn contains(&self, [x, y]: [usize; 2]) -> bool {
        self.words[y * self.stride() + x / 64] >> (x % 64) & 1 == 1
    }

    /// Returns how many pixels it has.
    pub fn count(&self) -> usize {
        self.words
            .iter()
            .map(|word| word.count_ones() as usize)
            .sum()
    }

    /// Returns the set in the order in which a file has the pixels.
    pub fn placed(&self, place: Place, is_turned: bool) -> Mask {
        Mask::new(self.size, |pixel| {
            let own = place.pixel(pixel, self.size, is_turned);
            own.is_some_and(|own| self.contains(own))
        })
    }

    /// Returns the set moved to the right and downward.
    fn moved(&self, [dx, dy]: [i8; 2]) -> Mask {
        let mut moved = Mask::empty(self.size);
        let stride = self.stride();
        let (shift, last) = (u32::from(dx.unsigned_abs()), self.size[0] - 1);
        for y in 0..self.size[1] {
            let Some(from) = y
                .checked_add_signed(-isize::from(dy))
                .filter(|y| *y < self.size[1])
            else {
                continue;
            };
            let (own, to) = (from * stride, y * stride);
            for k in 0..stride {
                let word = self.words[own + k];
                moved.words[to + k] = match dx.signum() {
                    0 => word,
                    1 => {
                        let before = if k == 0 { 0 } else { self.words[own + k - 1] };
                        word << shift | before >> (64 - shift)
                    }
                    _ => {
                        let after = if k + 1 < stride {
                            self.words[own + k + 1]
                        } else {
                            0
                        };
                        word >> shift | after << (64 - shift)
                    }
                };
            }
            // Nothing lies beyond the last column.
            moved.words[to + stride - 1] &= u64::MAX >> (63 - last % 64);
        }
        moved
    }

    /// Returns the pixels of a geometry's frame that polygons cover.
    pub fn of_geometry(stage: &Stage<'_>, geometry: Geometry) -> Option<Mask> {
        let drawn = stage.frame(geometry)?;
        let size = [drawn.frame.width(), drawn.frame.height()];
        let mut mask = Mask::empty(size);
        let stride = mask.stride();
        for_each_polygon_row(&drawn.frame, &mut |row, polygon| {
            let words = &mut mask.words[row * stride..][..stride];
            for x in 0..size[0] {
                words[x / 64] |= u64::from(polygon(x) != NO_POLYGON) << (x % 64);
            }
        });
        Some(if drawn.is_turned {
            mask.placed(Place::default(), true)
        } else {
            mask
        })
    }
}

/// The outline of someone's picture.
pub struct Outline {
    /// The pixels that are drawn, and holes inside them.
    solid: Mask,
    /// The pixels whose colour says whether they are covered.
    voters: Mask,
}

/// A pixel that differs from the background by less than this, in levels, may be a dark surface.
const DARK: f32 = 9.0;

/// Pixels that are this close to a dark one do not vote.
const BESIDE_DARK: usize = 4;

impl Outline {
    /// Makes the outline of a picture. `off` returns by how many levels a pixel differs from the
    /// background, and `None` where the picture is not known.
    pub fn new(size: [usize; 2], mut off: impl FnMut([usize; 2]) -> Option<f32>) -> Outline {
        let [width, height] = size;
        let mut drawn = Mask::empty(size);
        let mut dark = vec![false; width * height];
        let mut known = Mask::empty(size);
        for y in 0..height {
            for x in 0..width {
                let Some(off) = off([x, y]) else { continue };
                known.insert([x, y]);
                dark[y * width + x] = off > 0.0 && off < DARK;
                if off > 1.0 {
                    drawn.insert([x, y]);
                }
            }
        }
        let solid = filled(&drawn);
        let dark = widened(dark, size, BESIDE_DARK);
        let votes = |[x, y]: [usize; 2]| {
            // Holes of the background's colour are holes, or black light.
            let is_hole = solid.contains([x, y]) && !drawn.contains([x, y]);
            // What a shift brings in at the border is not known.
            let is_border = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
            known.contains([x, y]) && !dark[y * width + x] && !is_hole && !is_border
        };
        let mut voters = Mask::new(size, votes);
        if 2 * voters.count() < known.count() {
            voters = known;
        }
        Outline { solid, voters }
    }

    /// Returns the share of pixels that only the picture or only `covered` covers, of those that
    /// either covers.
    fn error(&self, covered: &Mask) -> f64 {
        let (mut one, mut either) = (0, 0);
        let all = covered.words.iter().zip(&self.solid.words);
        for ((own, solid), votes) in all.zip(&self.voters.words) {
            one += ((own ^ solid) & votes).count_ones();
            either += ((own | solid) & votes).count_ones();
        }
        f64::from(one) / f64::from(either.max(1))
    }
}

/// Returns a set with its holes: pixels that cannot be reached from the border.
fn filled(drawn: &Mask) -> Mask {
    let size = drawn.size;
    let [width, height] = size;
    let mut outside = Mask::new(size, |[x, y]| {
        let is_border = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
        is_border && !drawn.contains([x, y])
    });
    // Downward and to the right, then upward and to the left, until nothing is reached any more.
    let mut reached = 1;
    while reached > 0 {
        reached = 0;
        for backward in [false, true] {
            for k in 0..width * height {
                let k = if backward { width * height - 1 - k } else { k };
                let pixel @ [x, y] = [k % width, k / width];
                if outside.contains(pixel) || drawn.contains(pixel) {
                    continue;
                }
                let is_reached = if backward {
                    outside.contains([x + 1, y]) || outside.contains([x, y + 1])
                } else {
                    outside.contains([x - 1, y]) || outside.contains([x, y - 1])
                };
                if is_reached {
                    outside.insert(pixel);
                    reached += 1;
                }
            }
        }
    }
    Mask::new(size, |pixel| !outside.contains(pixel))
}

/// Returns the pixels that are up to `by` columns and rows away from those of `set`.
pub fn widened(set: Vec<bool>, [width, height]: [usize; 2], by: usize) -> Vec<bool> {
    let mut wide = vec![false; set.len()];
    for y in 0..height {
        let row = &set[y * width..][..width];
        for (x, _) in row.iter().enumerate().filter(|(_, is_set)| **is_set) {
            wide[y * width..][x.saturating_sub(by)..(x + by + 1).min(width)].fill(true);
        }
    }
    let mut tall = wide.clone();
    for y in 0..height {
        for other in y.saturating_sub(by)..(y + by + 1).min(height) {
            if other != y {
                for x in 0..width {
                    tall[other * width + x] |= wide[y * width + x];
                }
            }
        }
    }
    tall
}

/// A turn and a shift of a picture, and how far its outline is off.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    pub place: Place,
    pub error: f64,
}

/// The turns of a picture that are tried.
pub const TURNS: [Turn; 6] = [
    Turn::Stated,
    Turn::MirroredX,
    Turn::MirroredY,
    Turn::Half,
    Turn::Columns,
    Turn::Transposed,
];

/// The shifts of a picture by whole pixels that are tried.
const SHIFTS: [[i8; 2]; 9] = [
    [0, 0],
    [-1, 0],
    [1, 0],
    [0, -1],
    [0, 1],
    [-1, -1],
    [1, 1],
    [1, -1],
    [-1, 1],
];

impl Outline {
    /// Returns the share of pixels that only the picture or only a recipe covers, or 1 if the
    /// recipe cannot be drawn.
    pub fn error_of(&self, stage: &Stage<'_>, recipe: &Recipe) -> f64 {
        let covered = Mask::of_geometry(stage, recipe.geometry);
        covered.map_or(1.0, |covered| self.error_at(&covered, recipe.place))
    }

    /// Returns the share of pixels that only the picture or only `covered` covers, if the file
    /// shows it in this place.
    pub fn error_at(&self, covered: &Mask, place: Place) -> f64 {
        self.error(&covered.placed(place, false))
    }

    /// Returns the outline's error for each of `turns` of a geometry's outline, and each shift.
    pub fn places(&self, covered: &Mask, turns: &[Turn]) -> Vec<Placed> {
        let mut found = Vec::new();
        for &turn in turns {
            let place = Place {
                turn,
                moved: [0, 0],
            };
            let turned = covered.placed(place, false);
            found.extend(SHIFTS.map(|moved| Placed {
                place: Place { turn, moved },
                error: self.error(&turned.moved(moved)),
            }));
        }
        found
    }
}
