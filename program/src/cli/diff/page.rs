//! The page that `--html` writes: all pairs of two folders, with pictures and maps.

use super::super::text::counted;
use super::super::tolerance::Tolerance;
use super::super::{CliError, memory};
use super::DiffArgs;
use super::compared::{Compared, Status, summary};
use super::comparison::SCALE;
use crate::report::pairs_page::{PairsPage, ShownPair};
use fastphong::compare::metrics::judgement::{Selection, judged_map};
use fastphong::picture::image_file::{FilePicture, Format, Pair};
use fastphong::picture::{LevelRows, Levels, Picture8};

/// How many bytes of pairs the page has at most. The rest of it has less than 1 MB. Browsers open a
/// page of this size at once.
const MOST_BYTES: usize = 95_000_000;

/// The longest side of a full-size picture, in pixels.
const OPENED: usize = 4096;
/// The longest side of a small picture, which cannot be opened, in pixels.
const SMALL: usize = 320;

/// The pictures of the pairs, in their order.
pub struct Page {
    pairs: Vec<ShownPair>,
    /// How many bytes of pairs the page has at most.
    most: usize,
    /// How many bytes the page has of pairs that pass, and of those that fail.
    bytes: [usize; 2],
    /// How many pairs have small pictures because the page would be too large.
    left_small: usize,
    /// How many pairs that pass, and that fail, have no pictures for that reason.
    left_out: [usize; 2],
}

impl Default for Page {
    fn default() -> Page {
        Page {
            pairs: Vec::new(),
            most: MOST_BYTES,
            bytes: [0; 2],
            left_small: 0,
            left_out: [0; 2],
        }
    }
}

impl Page {
    /// Adds a pair: with full-size pictures if it differs and the page has room, else with small
    /// ones, else without.
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
        let mut shown = ShownPair {
            name: one.pair.name.clone(),
            status: one.status.name(),
            text: one.text.clone(),
            notes: one.notes.clone(),
            ..ShownPair::default()
        };
        if let Some(judged) = &one.judged {
            shown.largest = Some(judged.judgement.largest);
            shown.worst = judged.judgement.worst;
            shown.region = judged.judgement.region;
            shown.region_text = judged.region_text();
        }
        let kind = usize::from(one.fails());
        let sides: &[usize] = match one.status {
            // Packing pictures that find no room would take long.
            _ if self.left_out[kind] > 0 => &[],
            Status::Equal => &[SMALL],
            _ => &[OPENED, SMALL],
        };
        let mut packed = Ok(());
        let found = sides.iter().find_map(|side| {
            let mut with_pictures = shown.clone();
            packed = fill(&mut with_pictures, args, one, pictures, tolerance, *side);
            let has_room = self.has_room(kind, with_pictures.bytes());
            has_room.then_some((side, with_pictures))
        });
        if let Some((side, with_pictures)) = found {
            self.left_small += usize::from(*side != sides[0]);
            shown = with_pictures;
        } else {
            self.left_out[kind] += 1;
        }
        self.bytes[kind] += shown.bytes();
        self.pairs.push(shown);
        packed
    }

    /// True if the page has room for so many bytes more of a pair that passes (0) or fails (1).
    /// Those that pass take a third at most, so that they leave room for those that fail.
    fn has_room(&self, kind: usize, bytes: usize) -> bool {
        let [passed, failed] = self.bytes;
        passed + failed + bytes <= self.most && (kind == 1 || passed + bytes <= self.most / 3)
    }

    /// Writes the page.
    pub fn html(self, args: &DiffArgs, compared: &[Compared], tolerance: &Tolerance<'_>) -> String {
        let mut pairs: Vec<(Status, ShownPair)> = Vec::new();
        for (mut shown, one) in self.pairs.into_iter().zip(compared) {
            // It may have been approved, or not been packed, since it was added.
            shown.fails = one.fails();
            shown.notes.clone_from(&one.notes);
            pairs.push((one.status, shown));
        }
        pairs.sort_by_key(|(status, _)| *status);
        let (reference, actual) = (args.reference.display(), args.actual.display());
        let mut remarks = tolerance.text();
        let left_out = self.left_out.iter().sum();
        for (pairs, how) in [(self.left_small, "shown small"), (left_out, "left out")] {
            if pairs > 0 {
                let pairs = counted(pairs, "pair", "pairs");
                remarks += &format!(
                    " The pictures of {pairs} are {how}, because the page would be too large."
                );
            }
        }
        let bytes: usize = self.bytes.iter().sum();
        if let Err(error) = memory::check_page(bytes as u64) {
            remarks += &format!(" All pictures are left out: {error}.");
            for (_, shown) in &mut pairs {
                (shown.reference, shown.actual, shown.map) = Default::default();
            }
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
    memory::check_packing(size, shown.size)?;
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
        (true, Status::Differs | Status::Encoding | Status::Within) => {
            tolerance.selection(pair.common_size())?
        }
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

#[cfg(test)]
mod tests {
    use super::super::super::contents::Contents;
    use super::super::super::output::Output;
    use super::super::compared::compare;
    use super::super::pairing::Pairing;
    use super::*;
    use clap::Parser;
    use std::path::Path;

    #[derive(clap::Parser)]
    struct Line {
        #[command(flatten)]
        diff: DiffArgs,
    }

    /// Some pairs are equal and come first, the others fail. Noise cannot be compressed, so all
    /// pictures together are larger than the page may be.
    #[test]
    fn a_page_of_many_small_pairs_stays_within_its_limit_and_shows_failures_first() {
        let folder = tempfile::tempdir().unwrap();
        let mut state = 1u32;
        for name in ["a", "b", "c", "d", "e", "f", "g", "h"] {
            let noise = [(); 2].map(|()| {
                let mut picture = Picture8::new(64, 48, [0, 0, 0, 255]);
                for pixel in picture.pixels_mut() {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    pixel[..3].copy_from_slice(&state.to_be_bytes()[..3]);
                }
                FilePicture::stored(picture)
            });
            for (place, i) in [("ref", 0), ("now", usize::from(name > "d"))] {
                let path = folder.path().join(place).join(name).with_extension("png");
                std::fs::create_dir_all(path.parent().unwrap()).unwrap();
                let output = Output::new("", &path, Contents::Picture(Format::Png));
                output.write_encoded(&noise[i]).ok().unwrap();
            }
        }
        let paths = ["ref", "now"].map(|name| folder.path().join(name));
        let line = Line::parse_from([Path::new("diff"), &paths[0], &paths[1]]);
        let tolerance: Tolerance<'_> = line.diff.tolerance.with(Some(0.0), "").ok().unwrap();
        let page_of = |most| {
            let mut page = Page {
                most,
                ..Page::default()
            };
            let pairs = Pairing::of(&paths[0], &paths[1]).ok().unwrap().pairs;
            let all: Vec<Compared> = pairs
                .into_iter()
                .map(|pair| {
                    let (one, pictures) = compare(&line.diff, pair, &tolerance);
                    page.add(&line.diff, &one, &pictures, &tolerance)
                        .ok()
                        .unwrap();
                    one
                })
                .collect();
            page.html(&line.diff, &all, &tolerance)
        };
        let rest = page_of(usize::MAX);
        let shown = |page: &str| page.matches("<img ").count();
        assert_eq!(shown(&rest), 4 + 4 * 3);
        let pictures: usize = rest
            .split("data:image/png;base64,")
            .skip(1)
            .map(|uri| uri.find('"').unwrap())
            .sum();
        let frame = rest.len() - pictures;
        for part in [1, 3, 6] {
            // Markup counts, too.
            let most = pictures * part / 8 + 8 * 2 * 1500;
            let page = page_of(most);
            assert!(page.len() <= frame + most, "{part}: {}", page.len());
            assert!(part < 3 || shown(&page) > 3, "{part}: {}", shown(&page));
            assert!(page.contains("are left out, because the page would be too large."));
        }
        // Equal pairs take at most a third, although they come first.
        let page = page_of(pictures / 2);
        assert!(page.matches("alt=\"difference\"").count() > 0);
    }
}
