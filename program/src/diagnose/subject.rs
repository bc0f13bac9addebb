//! The subject: the picture that is diagnosed, put over the scene's background.

use super::outline::{Mask, Outline};
use super::rows::Rows;
use alloc::vec::Vec;
use fastphong::picture::Encoding;
use fastphong::picture::image_file::{FilePicture, FilePixels};
use fastphong::scene::Scene;

/// Someone's picture of a scene.
pub struct Subject<'a> {
    picture: &'a FilePicture,
    /// True if its columns are the rows of the scene.
    pub is_transposed: bool,
    /// How its rows are laid out, if they were read with a wrong length.
    pub rows: Option<Rows>,
    /// Pixels that do not count.
    pub hidden: Option<Mask>,
    /// The size of the scene.
    size: [usize; 2],
    /// The pixel of the file that shows the scene's first pixel, which may be outside.
    at: [isize; 2],
    /// The colour behind transparent pixels, in levels.
    under: [f64; 3],
    encoding: Encoding,
}

impl<'a> Subject<'a> {
    /// Makes the subject of a picture that has the size of `scene`, perhaps with columns and rows
    /// exchanged. With `at` it has any size, and this pixel shows the scene's first pixel.
    pub fn new(picture: &'a FilePicture, scene: &Scene, at: Option<[isize; 2]>) -> Subject<'a> {
        let size = [scene.width as usize, scene.height as usize];
        Subject {
            picture,
            is_transposed: at.is_none() && picture.size() != size,
            rows: None,
            hidden: None,
            size,
            at: at.unwrap_or_default(),
            under: background(scene),
            encoding: scene.encoding,
        }
    }

    /// Returns the width and height of the scene that it shows.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Returns the part of the scene that the file shows.
    pub fn window(&self) -> Window {
        let file = self.picture.size();
        let side = |k: usize| {
            let first = usize::try_from(-self.at[k]).unwrap_or(0);
            let end = (file[k] as isize - self.at[k]).clamp(0, self.size[k] as isize);
            (first, (end as usize).saturating_sub(first))
        };
        let [(x, width), (y, height)] = if self.is_transposed {
            [(0, self.size[0]), (0, self.size[1])]
        } else {
            [side(0), side(1)]
        };
        Window {
            in_scene: [x, y],
            in_file: self.at.map(|at| usize::try_from(at).unwrap_or(0)),
            size: [width, height],
            scene: self.size,
        }
    }

    /// Returns the pixel of the file that shows a pixel of the scene, if there is one.
    fn in_file(&self, [x, y]: [usize; 2]) -> Option<[usize; 2]> {
        let pixel = if self.is_transposed { [y, x] } else { [x, y] };
        let [width, height] = self.picture.size();
        let x = pixel[0].checked_add_signed(self.at[0])?;
        let y = pixel[1].checked_add_signed(self.at[1])?;
        (x < width && y < height).then_some([x, y])
    }

    /// Returns the levels of a pixel of the scene, 0 to 255, or `None` if they are not known.
    /// Floats are encoded and rounded like in a file of eight bits.
    pub fn levels(&self, pixel: [usize; 2]) -> Option<[f32; 3]> {
        if self.hidden.as_ref().is_some_and(|all| all.contains(pixel)) {
            return None;
        }
        let Some(rows) = self.rows else {
            return self.in_file(pixel).map(|pixel| self.stored(pixel));
        };
        let FilePixels::Stored(picture) = &self.picture.pixels else {
            return None;
        };
        let mut rgba = [255.0; 4];
        for (channel, value) in rgba.iter_mut().enumerate().take(rows.bytes) {
            let ([x, y], read) = rows.source(pixel, self.size, channel, self.bytes())?;
            *value = picture.get(x, y)[read].into();
        }
        Some(self.over(rgba, rows.bytes == 4).map(|level| level as f32))
    }

    /// Makes the outline of someone's picture.
    pub fn outline(&self, background: [f32; 3]) -> Outline {
        Outline::new(self.size(), |pixel| {
            let levels = self.levels(pixel)?;
            let off = levels.iter().zip(background).map(|(a, b)| (a - b).abs());
            Some(off.fold(0.0, f32::max))
        })
    }

    /// Returns how many bytes each pixel of the file had.
    pub fn bytes(&self) -> usize {
        if self.picture.has_alpha { 4 } else { 3 }
    }

    /// True if the file has a byte for each channel, and the size of the scene.
    pub fn has_bytes(&self) -> bool {
        let is_stored = matches!(self.picture.pixels, FilePixels::Stored(_));
        is_stored && self.picture.size() == self.size && self.at == [0, 0]
    }

    /// Returns the levels of a pixel of the file.
    pub fn stored(&self, [x, y]: [usize; 2]) -> [f32; 3] {
        let rgba = match &self.picture.pixels {
            FilePixels::Stored(picture) => picture.get(x, y).map(f64::from),
            FilePixels::Deep { picture, maximum } => {
                let level = |sample| 255.0 * f64::from(sample) / f64::from(*maximum);
                picture.get(x, y).map(level)
            }
            FilePixels::Linear(picture) => {
                let [r, g, b, _] = picture.get(x, y).map(f64::from);
                let level = |c: f64| 255.0 * self.encoding.encode(c.clamp(0.0, 1.0));
                let finite = [r, g, b].map(|c| if c.is_nan() { 0.0 } else { c });
                return finite.map(|c| libm::floor(level(c) + 0.5) as f32);
            }
        };
        let levels = self.over(rgba, self.picture.has_alpha);
        levels.map(|level| level as f32)
    }

    /// Puts a colour over the scene's background.
    fn over(&self, [r, g, b, alpha]: [f64; 4], has_alpha: bool) -> [f64; 3] {
        let mut levels = [r, g, b];
        if has_alpha && alpha < 255.0 {
            let share = alpha / 255.0;
            for (level, under) in levels.iter_mut().zip(self.under) {
                *level = share * *level + (1.0 - share) * under;
            }
        }
        levels
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
        let stored = partly.filter_map(|(i, &[r, g, b, alpha])| {
            let x = (i % picture.width()).checked_add_signed(-self.at[0])?;
            let y = (i / picture.width()).checked_add_signed(-self.at[1])?;
            let pixel = if self.is_transposed { [y, x] } else { [x, y] };
            let is_inside = pixel[0] < self.size[0] && pixel[1] < self.size[1];
            let levels = [r, g, b].map(f32::from);
            is_inside.then_some((pixel, levels, f32::from(alpha) / 255.0))
        });
        stored.take(most).collect()
    }

    /// Returns the most frequent colour of the border of what is known, if more than half of it has
    /// that colour.
    pub fn border(&self) -> Option<[f32; 3]> {
        let Window { in_scene, size, .. } = self.window();
        let [left, top] = in_scene;
        let (right, bottom) = (left + size[0], top + size[1]);
        let rows = (left..right).flat_map(|x| [[x, top], [x, bottom - 1]]);
        let columns = (top..bottom).flat_map(|y| [[left, y], [right - 1, y]]);
        let all = rows.chain(columns).filter_map(|pixel| self.levels(pixel));
        let colours = by_frequency(all);
        let count: usize = colours.iter().map(|(_, count)| count).sum();
        let (colour, most) = *colours.first()?;
        (2 * most > count).then_some(colour)
    }
}

/// The part of a scene that a file shows, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Its first column and row in the scene.
    pub in_scene: [usize; 2],
    /// Its first column and row in the file.
    pub in_file: [usize; 2],
    /// Its width and height.
    pub size: [usize; 2],
    /// The width and height of the scene.
    pub scene: [usize; 2],
}

/// Returns colours in whole levels with their counts, the most frequent first.
pub fn by_frequency(levels: impl Iterator<Item = [f32; 3]>) -> Vec<([f32; 3], usize)> {
    // Fractions do not matter here, and whole levels can be sorted.
    let mut all: Vec<[i32; 3]> = levels.map(|l| l.map(|c| libm::roundf(c) as i32)).collect();
    all.sort_unstable();
    let runs = all.chunk_by(|a, b| a == b);
    let mut colours: Vec<_> = runs
        .map(|same| (same[0].map(|c| c as f32), same.len()))
        .collect();
    colours.sort_by_key(|(_, count)| core::cmp::Reverse(*count));
    colours
}

/// Returns the background of a scene in levels.
pub fn background(scene: &Scene) -> [f64; 3] {
    let level = |c: f32| libm::floor(255.0 * scene.encoding.encode(f64::from(c)) + 0.5);
    scene.background.map(level)
}

/// True if a pixel's levels are not the background's.
pub fn is_drawn(levels: [f32; 3], background: [f32; 3]) -> bool {
    levels
        .iter()
        .zip(background)
        .any(|(a, b)| (a - b).abs() > 1.0)
}
