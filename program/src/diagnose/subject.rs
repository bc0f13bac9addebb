//! The subject: the picture that is diagnosed, put over the scene's background.

use alloc::vec::Vec;
use fastphong::picture::Encoding;
use fastphong::picture::image_file::{FilePicture, FilePixels};
use fastphong::scene::Scene;

/// Someone's picture of a scene.
pub struct Subject<'a> {
    picture: &'a FilePicture,
    /// True if its columns are the rows of the scene.
    pub is_transposed: bool,
    /// The colour behind transparent pixels, in levels.
    under: [f64; 3],
    encoding: Encoding,
}

impl<'a> Subject<'a> {
    /// Makes the subject of a picture that has the size of `scene`. With `is_transposed` the
    /// picture has columns and rows exchanged.
    pub fn new(picture: &'a FilePicture, scene: &Scene, is_transposed: bool) -> Subject<'a> {
        Subject {
            picture,
            is_transposed,
            under: background(scene),
            encoding: scene.encoding,
        }
    }

    /// Returns the width and height of the scene that it shows.
    pub fn size(&self) -> [usize; 2] {
        let [width, height] = self.picture.size();
        if self.is_transposed {
            [height, width]
        } else {
            [width, height]
        }
    }

    /// Returns the levels of a pixel, 0 to 255. Floats are encoded and rounded like in a file of
    /// eight bits.
    pub fn levels(&self, [x, y]: [usize; 2]) -> [f32; 3] {
        let [x, y] = if self.is_transposed { [y, x] } else { [x, y] };
        let (rgba, is_float) = match &self.picture.pixels {
            FilePixels::Stored(picture) => (picture.get(x, y).map(f64::from), false),
            FilePixels::Deep { picture, maximum } => {
                let level = |sample| 255.0 * f64::from(sample) / f64::from(*maximum);
                (picture.get(x, y).map(level), false)
            }
            FilePixels::Linear(picture) => (picture.get(x, y).map(f64::from), true),
        };
        let [r, g, b, alpha] = rgba;
        let mut levels = [r, g, b];
        if is_float {
            let level = |c: f64| 255.0 * self.encoding.encode(c.clamp(0.0, 1.0));
            let finite = levels.map(|c| if c.is_nan() { 0.0 } else { c });
            levels = finite.map(|c| libm::floor(level(c) + 0.5));
        } else if self.picture.has_alpha && alpha < 255.0 {
            let share = alpha / 255.0;
            for (level, under) in levels.iter_mut().zip(self.under) {
                *level = share * *level + (1.0 - share) * under;
            }
        }
        levels.map(|level| level as f32)
    }

    /// Returns up to `most` partly covered pixels: column and row, stored levels, and alpha from 0
    /// to 1.
    pub fn partly_covered(&self, most: usize) -> Vec<([usize; 2], [f32; 3], f32)> {
        let FilePixels::Stored(picture) = &self.picture.pixels else {
            return Vec::new();
        };
        let all = picture.pixels().iter().enumerate();
        let partly =
            all.filter(|(_, [.., alpha])| self.picture.has_alpha && (16..240).contains(alpha));
        let stored = partly.map(|(i, &[r, g, b, alpha])| {
            let [x, y] = [i % picture.width(), i / picture.width()];
            let pixel = if self.is_transposed { [y, x] } else { [x, y] };
            (pixel, [r, g, b].map(f32::from), f32::from(alpha) / 255.0)
        });
        stored.take(most).collect()
    }

    /// Returns the most frequent colour of the picture's border, if more than half of it has that
    /// colour.
    pub fn border(&self) -> Option<[f32; 3]> {
        let [width, height] = self.size();
        let rows = (0..width).flat_map(|x| [[x, 0], [x, height - 1]]);
        let columns = (0..height).flat_map(|y| [[0, y], [width - 1, y]]);
        let levels = rows.chain(columns).map(|pixel| self.levels(pixel));
        // Round to whole levels, which can be sorted: fractions do not matter here.
        let mut all: Vec<[i32; 3]> = levels.map(|l| l.map(|c| libm::roundf(c) as i32)).collect();
        all.sort_unstable();
        let longest = all.chunk_by(|a, b| a == b).max_by_key(|same| same.len())?;
        (2 * longest.len() > all.len()).then(|| longest[0].map(|c| c as f32))
    }
}

/// Returns the background of a scene in levels.
pub fn background(scene: &Scene) -> [f64; 3] {
    let level = |c: f32| libm::floor(255.0 * scene.encoding.encode(f64::from(c)) + 0.5);
    scene.background.map(level)
}
