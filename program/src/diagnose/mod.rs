//! Finds out why a picture is wrong, by synthesis: it draws each mistake that people make, and
//! names the one that comes closest to the picture.
//!
//! A mistake (`mistakes.rs`) sets choices of a recipe (`recipe.rs`). Few mistakes change which
//! polygon is visible at a pixel (`geometry.rs`, `hits.rs`). All others only shade (`light.rs`,
//! `surface.rs`) or store (`levels.rs`) the same hits in another way, at a few thousand pixels. So
//! `drawer.rs` stores everything that recipes share. `residual.rs` measures, `search.rs` decides,
//! and `amounts.rs` looks for light that is wrong by a factor.
//!
//! The pixels are samples of the whole picture, because a smaller picture would have other edges.
//! Levels are rounded like those of a file, so the right mistake leaves no difference at all.

mod amounts;
mod drawer;
mod geometry;
mod hits;
mod levels;
mod light;
mod mistakes;
mod recipe;
mod residual;
mod search;
mod shown_by;
mod shown_by_table;
mod subject;
mod surface;
#[cfg(test)]
mod tests;

pub use mistakes::{MISTAKES, Mistake, Part};
pub use search::Verdict;
pub(crate) use shown_by::scene_that_tells;
pub use shown_by::scenes_that_show;

use crate::split_mix::SplitMix;
use alloc::vec::Vec;
use amounts::{Amounts, Tone};
use drawer::{Drawer, Drawn};
use fastphong::frame::{Frame, FrameError, PreparedScene};
use fastphong::picture::image_file::FilePicture;
use fastphong::picture::{Encoding, Picture, Picture8};
use fastphong::reference::Model;
use fastphong::scene::Scene;
use fastphong::shading::Variant;
use recipe::{Rate, Recipe};
use residual::{Residual, Target, Votes, apart, distance};
use search::{Candidate, Findings, INVISIBLE, Search};
use subject::{Subject, background};
use surface::Surface;

/// About how many covered pixels are compared.
const SAMPLES: usize = 3000;

/// The most pixels that are sampled to find them.
const MOST_SAMPLES: usize = 20_000;

/// The background counts as wrong from this difference on, in levels.
const OTHER_BACKGROUND: f32 = 2.0;

/// The reason why a picture cannot be diagnosed.
#[derive(Debug)]
#[non_exhaustive]
pub enum DiagnoseError {
    /// The scene cannot be drawn.
    Frame(FrameError),
    /// Neither the scene nor the picture shows enough to be compared.
    NothingToCompare,
}

/// A picture to diagnose, and the scene that it should show.
pub struct Question<'a> {
    /// The scene. It has the size of the picture, or the size of the picture with columns and rows
    /// exchanged.
    pub scene: &'a Scene,
    /// The method that should have drawn it, or `None` for the reference's Phong shading.
    pub method: Option<&'a Variant>,
    /// The picture.
    pub picture: &'a FilePicture,
    /// The lengths of the lights' directions in the scene file, by which people forget to divide.
    /// Lights without an entry have the length 1.
    pub light_lengths: &'a [f64],
}

/// The findings about a picture.
pub struct Diagnosis {
    /// True if columns and rows of the picture are exchanged. All other findings are about the
    /// picture with them put right.
    pub is_transposed: bool,
    /// The background of the picture and the background of the scene, in levels, if they differ.
    pub background: Option<[[f32; 3]; 2]>,
    /// The encoding that the file states, if the scene states another one.
    pub stated_encoding: Option<Encoding>,
    /// True if partly covered pixels have colours that are multiplied by their alpha.
    pub is_premultiplied: bool,
    /// The share of compared pixels that only the picture or only the scene covers: another
    /// outline.
    pub outline: f64,
    /// The share of visible pixels that wrongly have the background's colour: cracks.
    pub cracks: f64,
    /// What the picture shows, in one word.
    pub verdict: Verdict,
    /// The distance of the picture from the right one.
    pub reference: Residual,
    /// How polygons of more than three sides are cut so that this distance is least.
    pub cut: &'static str,
    /// The mistakes that explain the picture, the best first, then others that explain it as well.
    pub causes: Vec<Cause>,
    /// All single mistakes, the best first.
    pub singles: Vec<Cause>,
    /// How many pixels each explanation explains better, where two are close.
    pub votes: Option<Votes>,
    /// Factors of the terms of the illumination model that fit the picture.
    pub amounts: Option<Amounts>,
    /// A curve of levels that fits the picture.
    pub tone: Option<Tone>,
    /// The pixel that shows the mistakes best.
    pub look_at: Option<Spot>,
    /// The part of the picture that differs most from the closest explanation: column, row, width
    /// and height in pixels.
    pub worst: Option<[usize; 4]>,
    /// Mistakes that this scene would not show.
    pub invisible: Vec<&'static Mistake>,
}

/// Mistakes that together explain a picture.
#[derive(Clone)]
pub struct Cause {
    /// The mistakes.
    pub mistakes: Vec<Mistake>,
    /// The difference that they leave unexplained, in levels.
    pub residual: f64,
    recipe: Recipe,
}

/// A pixel in three pictures, in levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Column and row.
    pub pixel: [usize; 2],
    /// Its levels in the picture that is diagnosed.
    pub yours: [f32; 3],
    /// Its levels in the reference.
    pub reference: [f32; 3],
    /// Its levels in the reference with the mistakes, if any were named.
    pub explained: Option<[f32; 3]>,
}

/// Finds out why a picture differs from its scene. `progress` is called with the share of the work
/// that is done, 0 to 1.
///
/// # Errors
/// [`DiagnoseError`] if the scene cannot be drawn, or if there is nothing to compare.
pub fn diagnose(
    question: &Question<'_>,
    progress: &mut dyn FnMut(f32),
) -> Result<Diagnosis, DiagnoseError> {
    let scene = question.scene;
    let size = [scene.width as usize, scene.height as usize];
    let is_transposed = question.picture.size() != size;
    let subject = Subject::new(question.picture, scene, is_transposed);
    let prepared = prepared(scene)?;
    let frame = prepared.frame().map_err(DiagnoseError::Frame)?;
    let surface = Surface::new(scene, &prepared, frame.origin());
    let right = right(question.method);
    let pixels = samples(scene, &prepared, &surface);
    let mut drawer = Drawer::new(scene, &prepared, &surface, pixels, true);
    let border = subject.border();
    let stated = background(scene).map(|c| c as f32);
    let own = border.unwrap_or(stated);
    drawer.background = own;
    let target = target(&subject, &drawer.pixels, own);
    drawer.target = target.levels.clone();
    drawer.light_lengths = question.light_lengths.to_vec();
    let mut search =
        Search::new(scene, &mut drawer, &target, &right).ok_or(DiagnoseError::NothingToCompare)?;
    if let Some(method) = question.method {
        search.reference = nearer(search.reference, by_method(method, &frame, &mut search));
    }
    if search.reference.levels <= MOST_OF_SAMPLES {
        let smooth = supersampled(&prepared, &surface, question, &mut search);
        search.reference = nearer(search.reference, smooth);
    }
    let (findings, search) = search.run(progress);
    let is_other = own
        .iter()
        .zip(stated)
        .any(|(a, b)| (a - b).abs() >= OTHER_BACKGROUND);
    let mut diagnosis = described(findings, search);
    diagnosis.is_transposed = is_transposed;
    diagnosis.background = is_other.then_some([own, stated]);
    diagnosis.is_premultiplied = is_premultiplied(scene, &prepared, &surface, &subject);
    let encoding = question.picture.encoding;
    diagnosis.stated_encoding = encoding.filter(|encoding| *encoding != scene.encoding);
    progress(1.0);
    Ok(diagnosis)
}

/// Returns how far each mistake of [`MISTAKES`] changes the picture of a scene, in grey levels, as
/// a mean over all covered pixels. It is `None` for choices that are right in this scene.
///
/// # Errors
/// As [`diagnose`].
pub fn shown(scene: &Scene) -> Result<Vec<Option<f64>>, DiagnoseError> {
    with_search(scene, |search| search.shown())
}

/// Returns how far two pictures of a scene differ in grey levels, one drawn with some mistakes and
/// one with others.
///
/// # Errors
/// As [`diagnose`].
fn told_apart(scene: &Scene, mistakes: [&[Mistake]; 2]) -> Result<f64, DiagnoseError> {
    with_search(scene, |search| {
        let [a, b] = mistakes.map(|mistakes| {
            let made: Vec<&Mistake> = mistakes.iter().collect();
            let recipe = Mistake::all(&made, search.base, search.scene)?;
            search.drawer.draw(&recipe)
        });
        a.zip(b).map_or(0.0, |(a, b)| apart(&a, &b))
    })
}

/// Calls `with` with a search in the right picture of a scene.
fn with_search<T>(
    scene: &Scene,
    with: impl FnOnce(&mut Search<'_, '_>) -> T,
) -> Result<T, DiagnoseError> {
    let prepared = prepared(scene)?;
    let frame = prepared.frame().map_err(DiagnoseError::Frame)?;
    let surface = Surface::new(scene, &prepared, frame.origin());
    let pixels = samples(scene, &prepared, &surface);
    let mut drawer = Drawer::new(scene, &prepared, &surface, pixels, true);
    drawer.background = background(scene).map(|c| c as f32);
    let right = drawer
        .draw(&Recipe::default())
        .ok_or(DiagnoseError::NothingToCompare)?;
    let is_drawn = (0..right.hits.len())
        .map(|i| right.hits.is_covered(i))
        .collect();
    let target = Target {
        levels: right.levels,
        is_drawn,
    };
    let mut search = Search::new(scene, &mut drawer, &target, &[Recipe::default()])
        .ok_or(DiagnoseError::NothingToCompare)?;
    Ok(with(&mut search))
}

/// Prepares a scene, with one sample per pixel.
fn prepared(scene: &Scene) -> Result<PreparedScene, DiagnoseError> {
    let mut prepared = scene.prepare().map_err(DiagnoseError::Frame)?;
    prepared.set_samples(1);
    Ok(prepared)
}

/// Returns the right recipes. Gouraud's method has two, because the lecture does not say if colours
/// are clamped at vertices.
fn right(method: Option<&Variant>) -> Vec<Recipe> {
    let rates: &[Rate] = match method.map(|method| method.closed_form().model) {
        None | Some(Model::Phong | Model::Slerp) => &[Rate::Pixel],
        Some(Model::PhongConstant) => &[Rate::ConstantVectors],
        Some(Model::Flat) => &[Rate::Face],
        Some(Model::FlatAverage) => &[Rate::FaceMean],
        Some(Model::Gouraud | Model::GouraudSeparate) => &[Rate::Vertex, Rate::VertexUnclamped],
    };
    let with = |rate: &Rate| {
        let mut recipe = Recipe::default();
        recipe.shading.rate = *rate;
        recipe
    };
    rates.iter().map(with).collect()
}

/// Returns the distance of a picture from the method's own picture, which differs a little from its
/// closed form. Returns `None` for large pictures.
fn by_method(method: &Variant, frame: &Frame, search: &mut Search<'_, '_>) -> Option<Residual> {
    let plain = Recipe::default();
    let hits = search.drawer.hits(plain.geometry, plain.place)?;
    let light = drawer::drawn_by(frame, method)?;
    let pixels = search.drawer.pixels.iter();
    let colours = pixels.map(|&[x, y]| {
        let [r, g, b, _] = light.get(x, y).map(f64::from);
        glam::DVec3::new(r, g, b)
    });
    let levels = search
        .drawer
        .levels(plain.storage, &hits, &colours.collect::<Vec<_>>());
    search.target.residual(&Drawn { levels, hits })
}

/// The largest distance in levels between right pictures with several samples per pixel and with
/// one.
const MOST_OF_SAMPLES: f64 = 2.0;

/// Returns the distance of a picture from the right one with 2 × 2 samples per pixel, which is the
/// mean of covered samples in linear light.
fn supersampled(
    prepared: &PreparedScene,
    surface: &Surface<'_>,
    question: &Question<'_>,
    search: &mut Search<'_, '_>,
) -> Option<Residual> {
    let base = search.base;
    let hits = search.drawer.hits(base.geometry, base.place)?;
    let [width, height] = [question.scene.width, question.scene.height].map(|side| 2 * side);
    if width.max(height) > Scene::MAX_SIDE {
        return None;
    }
    let mut prepared = prepared.clone();
    prepared.set_size(width, height);
    let samples =
        search.drawer.pixels.iter().flat_map(|&[x, y]| {
            [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| [2 * x + i, 2 * y + j])
        });
    let mut drawer = Drawer::new(question.scene, &prepared, surface, samples.collect(), false);
    let seen = drawer.hits(base.geometry, base.place)?;
    let light = drawer.light(base.geometry, base.place, base.shading)?;
    let mean = |i: usize| {
        let covered = (4 * i..4 * i + 4).filter(|&k| seen.is_covered(k));
        let clamped = |k: usize| light[k].clamp(glam::DVec3::ZERO, glam::DVec3::ONE);
        let (sum, count) = covered.fold((glam::DVec3::ZERO, 0), |(sum, n), k| {
            (sum + clamped(k), n + 1)
        });
        sum / f64::from(count.max(1))
    };
    let colours: Vec<glam::DVec3> = (0..hits.len()).map(mean).collect();
    let levels = search.drawer.levels(base.storage, &hits, &colours);
    search.target.residual(&Drawn { levels, hits })
}

/// Returns the smaller of two residuals.
fn nearer(a: Residual, b: Option<Residual>) -> Residual {
    b.filter(|b| b.levels < a.levels).unwrap_or(a)
}

/// Chooses pixels on a grid, each at a random place in its cell, so that about [`SAMPLES`] are
/// covered.
fn samples(scene: &Scene, prepared: &PreparedScene, surface: &Surface<'_>) -> Vec<[usize; 2]> {
    let size = [scene.width as usize, scene.height as usize];
    let coarse = grid(size, SAMPLES);
    let count = coarse.len();
    let mut drawer = Drawer::new(scene, prepared, surface, coarse, false);
    let recipe = Recipe::default();
    let hits = drawer.hits(recipe.geometry, recipe.place);
    let covered = hits.map_or(0, |hits| {
        (0..hits.len()).filter(|&i| hits.is_covered(i)).count()
    });
    let share = (covered as f64 / count as f64).max(SAMPLES as f64 / MOST_SAMPLES as f64);
    grid(size, (SAMPLES as f64 / share) as usize)
}

/// Returns about `count` pixels of a picture, one at a random place of each cell of a grid.
fn grid([width, height]: [usize; 2], count: usize) -> Vec<[usize; 2]> {
    let side = (libm::sqrt((width * height) as f64 / count as f64) as usize).max(1);
    let mut random = SplitMix(1);
    let mut pixels = Vec::new();
    for y in (0..height).step_by(side) {
        for x in (0..width).step_by(side) {
            let mut within = || (random.next() % side as u64) as usize;
            let (x, y) = (x + within(), y + within());
            pixels.push([x.min(width - 1), y.min(height - 1)]);
        }
    }
    pixels
}

fn target(subject: &Subject<'_>, pixels: &[[usize; 2]], background: [f32; 3]) -> Target {
    let levels: Vec<[f32; 3]> = pixels.iter().map(|pixel| subject.levels(*pixel)).collect();
    let is_drawn = |levels: &[f32; 3]| {
        let off = levels.iter().zip(background);
        off.into_iter().any(|(a, b)| (a - b).abs() > 1.0)
    };
    let is_drawn = levels.iter().map(is_drawn).collect();
    Target { levels, is_drawn }
}

/// Turns the findings of a search into a diagnosis: names the mistakes, and the pixels to look at.
fn described(findings: Findings, search: Search<'_, '_>) -> Diagnosis {
    let reference = search.drawer.draw(&search.base);
    let named = findings.causes.first();
    let nearest_cause = named.or(findings.singles.first().filter(|best| {
        findings.verdict != Verdict::Correct && best.residual.levels < search.reference.levels
    }));
    let explained = named.and_then(|cause| search.drawer.draw(&cause.recipe));
    let nearest = nearest_cause.and_then(|cause| search.drawer.draw(&cause.recipe));
    let target = search.target;
    let pixels = &search.drawer.pixels;
    let look_at = reference
        .as_ref()
        .and_then(|reference| spot(target, pixels, reference, explained.as_ref()));
    let size = [search.scene.width as usize, search.scene.height as usize];
    let worst = nearest
        .as_ref()
        .or(reference.as_ref())
        .and_then(|drawn| worst_part(target, pixels, drawn, size));
    let cracks = worst.map_or(0.0, |_| {
        let best = explained.as_ref().or(reference.as_ref());
        best.map_or(0.0, |best| cracks(target, best, search.drawer.background))
    });
    let cause = |candidate: &Candidate| Cause {
        mistakes: candidate
            .mistakes
            .iter()
            .map(|&m| search.mistakes[m].clone())
            .collect(),
        residual: candidate.residual.levels,
        recipe: candidate.recipe,
    };
    Diagnosis {
        is_transposed: false,
        background: None,
        stated_encoding: None,
        is_premultiplied: false,
        outline: reference
            .as_ref()
            .map_or(0.0, |reference| outline(target, reference)),
        cracks,
        verdict: if is_empty(target, reference.as_ref()) {
            Verdict::Empty
        } else {
            findings.verdict
        },
        reference: search.reference,
        cut: search.base.geometry.cut.name(),
        causes: findings.causes.iter().map(cause).collect(),
        singles: findings.singles.iter().map(cause).collect(),
        votes: findings.votes,
        amounts: findings.amounts,
        tone: findings.tone,
        look_at,
        worst,
        invisible: invisible(&search.shown),
    }
}

/// Returns the mistakes that change nothing visible.
fn invisible(shown: &[Option<f64>]) -> Vec<&'static Mistake> {
    let is_invisible = |shown: &Option<f64>| shown.is_some_and(|levels| levels < INVISIBLE);
    let all = MISTAKES.iter().zip(shown);
    all.filter(|(_, shown)| is_invisible(shown))
        .map(|(mistake, _)| mistake)
        .collect()
}

/// Returns the pixel that is farthest from the reference and closest to the explanation.
fn spot(
    target: &Target,
    pixels: &[[usize; 2]],
    reference: &Drawn,
    explained: Option<&Drawn>,
) -> Option<Spot> {
    let gain = |i: usize| {
        let yours = target.levels[i];
        let left = explained.map_or(0.0, |drawn| distance(drawn.levels[i], yours));
        distance(reference.levels[i], yours) - left
    };
    let is_inner = |i: &usize| {
        let is_edge = |drawn: &Drawn| drawn.hits.edges[*i];
        !is_edge(reference) && !explained.is_some_and(is_edge)
    };
    let inner = (0..pixels.len()).filter(is_inner);
    let best = inner.max_by(|&a, &b| gain(a).total_cmp(&gain(b)))?;
    (gain(best) > 0.0).then(|| Spot {
        pixel: pixels[best],
        yours: target.levels[best],
        reference: reference.levels[best],
        explained: explained.map(|drawn| drawn.levels[best]),
    })
}

/// How many parts a picture is divided into along each side, to say where it is worst.
const PARTS: usize = 8;

/// Returns the part of a picture that is farthest from a recipe: column, row, width and height.
fn worst_part(
    target: &Target,
    pixels: &[[usize; 2]],
    drawn: &Drawn,
    size: [usize; 2],
) -> Option<[usize; 4]> {
    let mut sums = [[0.0; PARTS]; PARTS];
    for (i, [x, y]) in pixels.iter().enumerate() {
        if !drawn.hits.edges[i] {
            let part = [y * PARTS / size[1], x * PARTS / size[0]];
            sums[part[0]][part[1]] += distance(drawn.levels[i], target.levels[i]);
        }
    }
    let parts = (0..PARTS * PARTS).map(|k| [k % PARTS, k / PARTS]);
    let [column, row] = parts.max_by(|a, b| sums[a[1]][a[0]].total_cmp(&sums[b[1]][b[0]]))?;
    let start = |part: usize, side: usize| (part * side).div_ceil(PARTS);
    let (x, y) = (start(column, size[0]), start(row, size[1]));
    let (right, bottom) = (start(column + 1, size[0]), start(row + 1, size[1]));
    (sums[row][column] > 0.0).then_some([x, y, right - x, bottom - y])
}

/// The most partly covered pixels that are tested.
const MOST_PARTLY_COVERED: usize = 2000;

/// True if partly covered pixels are multiplied by alpha: nine in ten are closer to the scene's
/// colour times alpha than to the colour itself.
fn is_premultiplied(
    scene: &Scene,
    prepared: &PreparedScene,
    surface: &Surface<'_>,
    subject: &Subject<'_>,
) -> bool {
    let partly = subject.partly_covered(MOST_PARTLY_COVERED);
    let pixels = partly.iter().map(|(pixel, ..)| *pixel).collect();
    let mut drawer = Drawer::new(scene, prepared, surface, pixels, false);
    let Some(drawn) = drawer.draw(&Recipe::default()) else {
        return false;
    };
    let (mut voters, mut multiplied) = (0usize, 0usize);
    for (i, (_, levels, alpha)) in partly.iter().enumerate() {
        let own = drawn.levels[i];
        let times = own.map(|level| level * alpha);
        if drawn.hits.is_covered(i) && distance(own, times) > 8.0 {
            voters += 1;
            multiplied += usize::from(distance(*levels, times) < distance(*levels, own));
        }
    }
    voters >= 20 && 10 * multiplied >= 9 * voters
}

/// True if the picture shows less than a 50th of the pixels that a recipe covers.
fn is_empty(target: &Target, drawn: Option<&Drawn>) -> bool {
    let covered = |i: &usize| drawn.is_some_and(|drawn| drawn.hits.is_covered(*i));
    let all = (0..target.levels.len()).filter(covered).count();
    let there = (0..target.levels.len())
        .filter(covered)
        .filter(|&i| target.is_drawn[i])
        .count();
    50 * there < all
}

/// Returns the share of pixels that only the picture or only a recipe covers, of all that either
/// covers.
fn outline(target: &Target, drawn: &Drawn) -> f64 {
    let (mut all, mut one) = (0usize, 0usize);
    for i in 0..target.levels.len() {
        let covered = [target.is_drawn[i], drawn.hits.is_covered(i)];
        all += usize::from(covered[0] || covered[1]);
        one += usize::from(covered[0] != covered[1] && !drawn.hits.edges[i]);
    }
    one as f64 / all.max(1) as f64
}

/// Returns the share of pixels inside a recipe's outline that wrongly have the background's colour.
fn cracks(target: &Target, drawn: &Drawn, background: [f32; 3]) -> f64 {
    let (mut inside, mut holes) = (0usize, 0usize);
    for i in 0..target.levels.len() {
        let is_other = distance(drawn.levels[i], background) > 8.0;
        if drawn.hits.is_covered(i) && !drawn.hits.edges[i] && is_other {
            inside += 1;
            holes += usize::from(distance(target.levels[i], background) <= 0.5);
        }
    }
    holes as f64 / inside.max(1) as f64
}

impl Diagnosis {
    /// True if nothing is wrong.
    pub fn is_correct(&self) -> bool {
        let is_file_right =
            self.background.is_none() && !self.is_transposed && !self.is_premultiplied;
        self.verdict == Verdict::Correct && is_file_right
    }

    /// Returns every `step`-th column and row of the picture that is diagnosed. If its columns and
    /// rows were exchanged, they are put right.
    pub fn yours(&self, question: &Question<'_>, step: usize) -> Picture8 {
        let subject = Subject::new(question.picture, question.scene, self.is_transposed);
        let [width, height] = subject.size();
        let [columns, rows] = [width, height].map(|side| side.div_ceil(step));
        let mut picture = Picture::new(columns, rows, [255; 4]);
        for y in 0..rows {
            for (x, pixel) in picture.row_mut(y).iter_mut().enumerate() {
                let [r, g, b] = subject.levels([x * step, y * step]).map(|c| c as u8);
                *pixel = [r, g, b, 255];
            }
        }
        picture
    }

    /// Draws every `step`-th column and row of the scene, with the named mistakes or without them.
    ///
    /// # Errors
    /// [`DiagnoseError`] if the scene cannot be drawn.
    pub fn draw(
        &self,
        question: &Question<'_>,
        with_mistakes: bool,
        step: usize,
    ) -> Result<Picture8, DiagnoseError> {
        let scene = question.scene;
        let prepared = prepared(scene)?;
        let frame = prepared.frame().map_err(DiagnoseError::Frame)?;
        let surface = Surface::new(scene, &prepared, frame.origin());
        let [width, height] = [scene.width, scene.height].map(|side| side as usize);
        let rows = (0..height).step_by(step);
        let pixels = rows.flat_map(|y| (0..width).step_by(step).map(move |x| [x, y]));
        let mut drawer = Drawer::new(scene, &prepared, &surface, pixels.collect(), false);
        drawer.light_lengths = question.light_lengths.to_vec();
        drawer.background = match self.background {
            Some([own, _]) if with_mistakes => own,
            _ => background(scene).map(|c| c as f32),
        };
        let cause = self.causes.first().filter(|_| with_mistakes);
        let recipe = cause.map_or_else(|| right(question.method)[0], |cause| cause.recipe);
        let drawn = drawer
            .draw(&recipe)
            .ok_or(DiagnoseError::NothingToCompare)?;
        let pixels = drawn.levels.iter().map(|levels| {
            let [r, g, b] = levels.map(|c| c as u8);
            [r, g, b, 255]
        });
        let size = [width, height].map(|side| side.div_ceil(step));
        let picture = Picture::from_pixels(size[0], size[1], pixels.collect());
        picture.ok_or(DiagnoseError::NothingToCompare)
    }
}
