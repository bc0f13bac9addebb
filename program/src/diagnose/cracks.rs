//! Cracks between polygons: pixels inside them that have the background's colour.

use super::outline::{Mask, widened};
use super::subject::{Subject, is_drawn};

/// The smallest share of the covered pixels that are called cracks.
pub const MANY: f64 = 0.01;

/// The smallest share of the pixels that are missing inside the outline that lie in cracks. Other
/// missing pixels are parts that were left out, or black light.
const MOST: f64 = 0.8;

/// How many pixels wide a crack may be at least, on either side of a pixel.
const WIDE: usize = 4;

/// Cracks are in at least a quarter of the covered parts of a picture that is divided into this
/// many parts along each side.
const PARTS: usize = 8;

/// True if `cracks` are most of the pixels that only `covered` covers, and the other way round.
pub fn are_holes(cracks: &Mask, covered: &Mask, own: &Mask) -> bool {
    let holes = |pixel| covered.contains(pixel) && !own.contains(pixel);
    let holes = Mask::new(covered.size(), holes);
    let both = Mask::new(covered.size(), |pixel| {
        holes.contains(pixel) && cracks.contains(pixel)
    });
    let most = cracks.count().max(holes.count()) as f64;
    both.count() as f64 >= MOST * most
}

/// Finds the pixels inside `covered` that have the background's colour and drawn pixels close by on
/// both sides. Returns them and their share, or `None` if they are few.
pub fn find(subject: &Subject<'_>, background: [f32; 3], covered: &Mask) -> Option<(Mask, f64)> {
    let size @ [width, height] = subject.size();
    let reach = (width / 64).max(WIDE);
    let drawn = Mask::new(size, |pixel| {
        let levels = subject.levels(pixel);
        levels.is_some_and(|levels| is_drawn(levels, background))
    });
    let is_inside = |[x, y]: [usize; 2]| {
        let is_inner = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
        is_inner
            && [[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1], [x, y]]
                .iter()
                .all(|pixel| covered.contains(*pixel))
            && subject.levels([x, y]).is_some()
    };
    let is_crack = |[x, y]: [usize; 2]| {
        let left = (x.saturating_sub(reach)..x).any(|x| drawn.contains([x, y]));
        let right = (x + 1..(x + reach + 1).min(width)).any(|x| drawn.contains([x, y]));
        let above = (y.saturating_sub(reach)..y).any(|y| drawn.contains([x, y]));
        let below = (y + 1..(y + reach + 1).min(height)).any(|y| drawn.contains([x, y]));
        left && right || above && below
    };
    let (mut inside, mut missing) = (0usize, 0usize);
    let mut parts = [[false; 2]; PARTS * PARTS];
    let cracks = Mask::new(size, |pixel @ [x, y]| {
        if !is_inside(pixel) {
            return false;
        }
        inside += 1;
        let part = &mut parts[y * PARTS / height * PARTS + x * PARTS / width];
        part[0] = true;
        if drawn.contains(pixel) {
            return false;
        }
        missing += 1;
        let is_crack = is_crack(pixel);
        part[1] |= is_crack;
        is_crack
    });
    let count = cracks.count();
    let [all, cracked] = [0, 1].map(|k| parts.iter().filter(|part| part[k]).count());
    let is_spread = 4 * cracked >= all;
    let is_mostly_cracks = count as f64 >= MOST * missing as f64;
    if !is_spread || !is_mostly_cracks || count as f64 <= MANY * inside as f64 {
        return None;
    }
    // Cracks go on to the outline.
    let close = (0..width * height).map(|k| cracks.contains([k % width, k / width]));
    let close = widened(close.collect(), size, reach);
    let cracks = Mask::new(size, |pixel @ [x, y]| {
        let is_known = subject.levels(pixel).is_some();
        close[y * width + x] && covered.contains(pixel) && !drawn.contains(pixel) && is_known
    });
    let share = cracks.count() as f64 / covered.count().max(1) as f64;
    Some((cracks, share))
}
