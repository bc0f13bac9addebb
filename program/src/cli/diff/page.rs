//! The page that `--html` writes: all pairs of two folders, with pictures and maps.

use super::super::CliError;
use super::super::tolerance::Tolerance;
use super::DiffArgs;
use super::compared::{Compared, Status, summary};
use super::comparison::SCALE;
use crate::report::pairs_page::{PairsPage, ShownPair};
use fastphong::compare::metrics::judgement::{Selection, judged_map};
use fastphong::picture::image_file::{FilePicture, Format, Pair};
use fastphong::picture::{LevelRows, Levels, Picture8};

/// How many bytes of full-size pictures the page holds at most. Browsers open a page of this size
/// at once.
const MOST_BYTES: usize = 96 << 20;

/// The longest side of a full-size picture, in pixels.
const OPENED: usize = 4096;
/// The longest side of a small picture, which cannot be opened, in pixels.
const SMALL: usize = 320;

/// The pictures of the pairs, in their order.
#[derive(Default)]
pub struct Page {
    pairs: Vec<ShownPair>,
    bytes: usize,
    /// How many pairs have small pictures because the page would be too large.
    left_small: usize,
}

impl Page {
    /// Adds the pictures of a pair: full-size ones if the pair differs and the page has room, else
    /// small ones.
    ///
    /// # Errors
    /// If a picture cannot be packed. The page then shows the pair without it.
    pub fn add(
        &mut self,
        args: &DiffArgs,
        one: &Compared,
        pictures: &[Option<FilePicture>; 2],
        tolerance: &Tolerance<'_>,
    ) -> Result<(), CliError> {
        self.pairs.push(ShownPair {
            name: one.pair.name.clone(),
            status: one.status.name(),
            fails: one.status.fails(),
            ..ShownPair::default()
        });
        let is_whole = one.status != Status::Equal && self.bytes < MOST_BYTES;
        self.left_small += usize::from(one.status != Status::Equal && !is_whole);
        let side = if is_whole { OPENED } else { SMALL };
        let shown = self.pairs.last_mut().expect("added just now");
        fill(shown, args, one, pictures, tolerance, side)?;
        self.bytes += shown.bytes();
        Ok(())
    }

    /// Writes the page.
    pub fn html(self, args: &DiffArgs, compared: &[Compared], tolerance: &Tolerance<'_>) -> String {
        let mut pairs: Vec<(Status, ShownPair)> = Vec::new();
        for (mut shown, one) in self.pairs.into_iter().zip(compared) {
            shown.text.clone_from(&one.text);
            shown.notes.clone_from(&one.notes);
            if let Some(judged) = &one.judged {
                shown.largest = Some(judged.judgement.largest);
                shown.worst = judged.judgement.worst;
                shown.region = judged.judgement.region;
                shown.region_text = judged.region_text();
            }
            pairs.push((one.status, shown));
        }
        pairs.sort_by_key(|(status, _)| *status);
        let (reference, actual) = (args.reference.display(), args.actual.display());
        let mut remarks = tolerance.text();
        if self.left_small > 0 {
            let pairs = self.left_small;
            remarks += &format!(
                " The pictures of {pairs} pairs are shown small, because the page would be too large."
            );
        }
        PairsPage {
            title: summary(compared),
            about: format!("{actual} against the references in {reference}. {remarks}"),
            levels: SCALE,
            pairs: pairs.into_iter().map(|(_, shown)| shown).collect(),
        }
        .html()
    }
}

/// Packs the pictures of a pair, with no side longer than `most`.
fn fill(
    shown: &mut ShownPair,
    args: &DiffArgs,
    one: &Compared,
    pictures: &[Option<FilePicture>; 2],
    tolerance: &Tolerance<'_>,
    most: usize,
) -> Result<(), CliError> {
    let sizes = pictures.iter().flatten().map(FilePicture::size);
    let size = sizes.reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])]);
    let size = size.unwrap_or_default();
    let step = size[0].max(size[1]).div_ceil(most).max(1);
    shown.step = step;
    shown.size = size.map(|side| side.div_ceil(step));
    let [Some(reference), Some(actual)] = pictures else {
        let pack = |picture: &Option<FilePicture>| match picture {
            Some(picture) => {
                let [shown, _] = alone(picture, args).displayed();
                packed(&shown, step)
            }
            None => Ok(Vec::new()),
        };
        let [reference, actual] = pictures;
        (shown.reference, shown.actual) = (pack(reference)?, pack(actual)?);
        return Ok(());
    };
    let pair = Pair::new(reference, actual, args.assume);
    // Pictures of different sizes are shown whole, each in its own encoding.
    let [r, a] = if pair.is_one_size() {
        pair.displayed()
    } else {
        [reference, actual].map(|picture| {
            let [shown, _] = alone(picture, args).displayed();
            shown
        })
    };
    shown.reference = packed(&r, step)?;
    if one.status == Status::Equal {
        return Ok(());
    }
    shown.actual = packed(&a, step)?;
    let selection = match (pair.is_one_size(), one.status) {
        (true, Status::Differs | Status::Within) => tolerance.selection(pair.common_size())?,
        _ => Selection::whole(pair.common_size()),
    };
    let [r, a] = pair.compared();
    let map = judged_map(&r, &a, SCALE, tolerance.radius(), &selection)?;
    shown.map = packed(&map, step)?;
    Ok(())
}

/// Pairs a single picture with itself.
fn alone<'a>(picture: &'a FilePicture, args: &DiffArgs) -> Pair<'a> {
    Pair::new(picture, picture, args.assume)
}

/// Packs a picture as a PNG file. Each pixel of the file is the mean of `step` × `step` pixels.
fn packed(picture: &dyn LevelRows, step: usize) -> Result<Vec<u8>, CliError> {
    let [width, height] = picture.size();
    let [w, h] = [width.div_ceil(step), height.div_ceil(step)];
    let mut small = Picture8::new(w, h, [0, 0, 0, 255]);
    let mut row = vec![Levels([0.0; 4]); width];
    for y in 0..h {
        let mut sums = vec![[0.0; 4]; w];
        for of_step in (y * step)..((y + 1) * step).min(height) {
            picture.level_row(of_step, &mut row);
            for (x, pixel) in row.iter().enumerate() {
                let sum = &mut sums[x / step];
                (0..3).for_each(|c| sum[c] += pixel.0[c]);
                sum[3] += 1.0;
            }
        }
        for (pixel, sum) in small.row_mut(y).iter_mut().zip(sums) {
            let [r, g, b] = [0, 1, 2].map(|c| (sum[c] / sum[3] + 0.5) as u8);
            *pixel = [r, g, b, 255];
        }
    }
    Ok(FilePicture::stored(small).encode(Format::Png)?)
}
