//! Finds out why a picture is wrong, by synthesis: it draws each mistake that people make, and
//! names the one that comes closest to the picture.
//!
//! A mistake (`mistakes.rs`) sets choices of a recipe (`recipe.rs`). Few mistakes change which
//! polygon is visible at a pixel (`geometry.rs`, `hits.rs`). All others only shade (`lit.rs`,
//! `light.rs`, `surface.rs`), mix (`mixing.rs`) or store (`levels.rs`) the same hits in another
//! way, at a few thousand pixels. So `drawer.rs` stores everything that recipes share.
//! `residual.rs` measures and `search.rs` decides. `combinations.rs` looks for several mistakes, by
//! outlines (`outline.rs`) and with free amounts of light (`amounts.rs`).
//!
//! First, the scene's picture is found in the file (`window.rs`, `rows.rs`, `subject.rs`). Pixels
//! that it does not show, and cracks (`cracks.rs`), are not compared.
//!
//! The pixels are samples of the whole picture, because a smaller picture would have other edges.
//! Levels are rounded like those of a file, so the right mistake leaves no difference at all.

mod amounts;
mod answer;
mod combinations;
mod cracks;
mod drawer;
mod geometry;
mod hits;
mod leaning;
mod levels;
mod light;
mod lit;
mod mistakes;
mod mixing;
mod numbers;
mod outline;
mod partly;
mod recipe;
mod residual;
mod rows;
mod search;
mod shown_by;
mod shown_by_table;
mod stage;
mod subject;
mod surface;
#[cfg(test)]
mod tests;
mod tone;
mod window;

pub use answer::{Asked, Line, answer};
pub use mistakes::{MISTAKES, Mistake, Part};
pub use numbers::{Amount, FittedLight, Fog, Numbers};
pub use rows::{Order, Rows};
pub use search::Verdict;
use shown_by::scene_that_tells;
pub use shown_by::scenes_that_show;
pub use subject::Window;
pub use window::find_window;

use crate::split_mix::SplitMix;
use alloc::vec::Vec;
use drawer::Drawer;
use fastphong::frame::{Frame, FrameError, PreparedScene};
use fastphong::picture::image_file::FilePicture;
use fastphong::picture::{Encoding, Picture, Picture8};
use fastphong::reference::Model;
use fastphong::scene::Scene;
use fastphong::shading::Variant;
use outline::Mask;
use recipe::{CUTS, Cut, Rate, Recipe};
use residual::{Drawn, Residual, Target, Votes, apart, distance, is_off};
use search::{Candidate, Findings, INVISIBLE, Search, Whole};
use stage::Stage;
use subject::{Subject, background};
use surface::Surface;
use tone::Tone;

/// About how many covered pixels are compared.
const SAMPLES: usize = 3000;

/// How many covered pixels are compared while several mistakes are looked for.
const FEW_SAMPLES: usize = 800;

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
    /// The scene. Without `at` it has the size of the picture, or the size of the picture with
    /// columns and rows exchanged.
    pub scene: &'a Scene,
    /// The method that should have drawn it, or `None` for the reference's Phong shading.
    pub method: Option<&'a Variant>,
    /// The picture.
    pub picture: &'a FilePicture,
    /// The pixel of the picture that shows the scene's first pixel, as [`find_window`] returns it,
    /// if the picture has another size.
    pub at: Option<[isize; 2]>,
    /// The lengths of the lights' directions in the scene file, by which people forget to divide.
    /// Lights without an entry have the length 1.
    pub light_lengths: &'a [f64],
}

/// The findings about a picture.
pub struct Diagnosis {
    /// True if columns and rows of the picture are exchanged. All other findings are about the
    /// picture with them put right.
    pub is_transposed: bool,
    /// The part of the scene that a picture of another size shows. The pixels of `look_at` and
    /// `worst` are pixels of the picture.
    pub window: Option<Window>,
    /// How the rows of the file are laid out, if they were read with a wrong length. All other
    /// findings are about the picture with that put right.
    pub rows: Option<Rows>,
    /// The background of the picture and the background of the scene, in levels, if they differ.
    pub background: Option<[[f32; 3]; 2]>,
    /// The encoding that the file states, if the scene states another one.
    pub stated_encoding: Option<Encoding>,
    /// True if partly covered pixels have colours that are multiplied by their alpha.
    pub is_premultiplied: bool,
    /// The share of compared pixels that only the picture or only the scene covers: another
    /// outline.
    pub outline: f64,
    /// The share of covered pixels in cracks between polygons, which have the background's colour.
    /// They are not compared.
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
    /// Numbers that explain the picture where no named mistakes do.
    pub numbers: Option<Numbers>,
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
    /// The corrections, one for each mistake. Empty except for the best explanation.
    pub steps: Vec<Step>,
    recipe: Recipe,
}

impl Cause {
    /// Returns `mistake` or `mistakes`.
    pub fn word(&self) -> &'static str {
        match self.mistakes.len() {
            0 | 1 => "mistake",
            _ => "mistakes",
        }
    }
}

/// The correction of a mistake, after those before it.
#[derive(Clone)]
pub struct Step {
    /// How far the picture is from the right one then, in levels.
    pub left: f64,
    /// The part of the picture that it changes most: column, row, width and height in pixels.
    pub part: Option<[usize; 4]>,
    recipe: Recipe,
}

/// A picture that an answer shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// The right picture.
    Reference,
    /// The best explanation, of which the first few mistakes are corrected.
    Corrected(usize),
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
    let mut subject = Subject::new(question.picture, scene, question.at);
    let prepared = prepared(scene)?;
    let frame = prepared.frame().map_err(DiagnoseError::Frame)?;
    let surface = Surface::new(scene, &prepared, frame.origin());
    let stage = Stage::new(scene, &prepared, &surface, question.light_lengths);
    let right = right(question.method);
    let stated = background(scene).map(|c| c as f32);
    let own = subject.border().unwrap_or(stated);
    subject.rows = leaning::find(&stage, &mut subject, own);
    let cracks = hide_cracks(&stage, &mut subject, own);
    let on = |pixels: Vec<[usize; 2]>| {
        let mut drawer = Drawer::new(&stage, pixels, true);
        let target = target(&subject, &drawer.pixels, own);
        drawer.background = own;
        drawer.target = target.levels.clone();
        (drawer, target)
    };
    let (drawer, target) = on(samples(&stage, |pixel| subject.levels(pixel).is_some()));
    let mut search =
        Search::new(&stage, drawer, &target, &right).ok_or(DiagnoseError::NothingToCompare)?;
    let few = few(&mut search);
    if let Some(method) = question.method
        && let Some(drawn) = by_method(method, &frame, &mut search)
    {
        search.offer_right(drawn);
    }
    if search.reference.levels <= MOST_OF_SAMPLES
        && let Some(drawn) = supersampled(&stage, question, &mut search)
    {
        search.offer_right(drawn);
    }
    let outline = subject.outline(own);
    let (drawer, few) = on(few);
    let whole = Whole {
        outline: &outline,
        drawer,
        target: few,
    };
    let findings = search.run(whole, progress);
    let is_other = own
        .iter()
        .zip(stated)
        .any(|(a, b)| (a - b).abs() >= OTHER_BACKGROUND);
    let mut diagnosis = described(findings, search);
    diagnosis.is_transposed = subject.is_transposed;
    diagnosis.rows = subject.rows;
    diagnosis.cracks = cracks;
    if question.at.is_some() {
        diagnosis.place_in(subject.window());
    }
    diagnosis.background = is_other.then_some([own, stated]);
    diagnosis.is_premultiplied = is_premultiplied(&stage, &subject);
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
            let recipe = Mistake::all(&made, search.base, search.stage.scene)?;
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
    let stage = Stage::new(scene, &prepared, &surface, &[]);
    let mut drawer = Drawer::new(&stage, samples(&stage, |_| true), true);
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
    let mut search = Search::new(&stage, drawer, &target, &[Recipe::default()])
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

/// Returns the method's own picture, which differs a little from its closed form. Returns `None`
/// for large pictures.
fn by_method(method: &Variant, frame: &Frame, search: &mut Search<'_, '_>) -> Option<Drawn> {
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
    Some(Drawn { levels, hits })
}

/// The largest distance in levels between right pictures with several samples per pixel and with
/// one.
const MOST_OF_SAMPLES: f64 = 2.0;

/// Returns the right picture with 2 × 2 samples per pixel: the mean of covered samples in linear
/// light.
fn supersampled(
    stage: &Stage<'_>,
    question: &Question<'_>,
    search: &mut Search<'_, '_>,
) -> Option<Drawn> {
    let base = search.base;
    let hits = search.drawer.hits(base.geometry, base.place)?;
    let [width, height] = [question.scene.width, question.scene.height].map(|side| 2 * side);
    if width.max(height) > Scene::MAX_SIDE {
        return None;
    }
    let mut prepared = stage.prepared.clone();
    prepared.set_size(width, height);
    let samples =
        search.drawer.pixels.iter().flat_map(|&[x, y]| {
            [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| [2 * x + i, 2 * y + j])
        });
    let stage = Stage::new(stage.scene, &prepared, stage.surface, stage.light_lengths);
    let mut drawer = Drawer::new(&stage, samples.collect(), false);
    let seen = drawer.hits(base.geometry, base.place)?;
    let light = drawer.light(&base)?;
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
    Some(Drawn { levels, hits })
}

/// Chooses pixels on a grid, each at a random place in its cell, so that about [`SAMPLES`] are
/// covered. Only pixels for which `is_known` is true are chosen.
fn samples(stage: &Stage<'_>, is_known: impl Fn([usize; 2]) -> bool) -> Vec<[usize; 2]> {
    let size = [stage.scene.width as usize, stage.scene.height as usize];
    let known = |count: usize| {
        let mut pixels = grid(size, count);
        pixels.retain(|pixel| is_known(*pixel));
        pixels
    };
    let coarse = known(SAMPLES);
    let count = grid(size, SAMPLES).len();
    let mut drawer = Drawer::new(stage, coarse, false);
    let recipe = Recipe::default();
    let hits = drawer.hits(recipe.geometry, recipe.place);
    let covered = hits.map_or(0, |hits| {
        (0..hits.len()).filter(|&i| hits.is_covered(i)).count()
    });
    let share = (covered as f64 / count as f64).max(SAMPLES as f64 / MOST_SAMPLES as f64);
    known((SAMPLES as f64 / share) as usize)
}

/// Chooses about [`FEW_SAMPLES`] of the pixels that are compared, among those that the scene covers
/// or that the picture shows.
fn few(search: &mut Search<'_, '_>) -> Vec<[usize; 2]> {
    let base = search.base;
    let hits = search.drawer.hits(base.geometry, base.place);
    let is_seen = |i: &usize| {
        search.target.is_drawn[*i] || hits.as_ref().is_some_and(|hits| hits.is_covered(*i))
    };
    let mut seen: Vec<usize> = (0..search.drawer.pixels.len()).filter(is_seen).collect();
    SplitMix(2).shuffle(&mut seen);
    seen.truncate(FEW_SAMPLES);
    seen.sort_unstable();
    seen.into_iter().map(|i| search.drawer.pixels[i]).collect()
}

/// Returns about `count` pixels of a picture, one at a random place of each cell of a grid.
fn grid([width, height]: [usize; 2], count: usize) -> Vec<[usize; 2]> {
    let side = libm::sqrt((width * height) as f64 / count.max(1) as f64).max(1.0);
    let cells = |length: usize| ((length as f64 / side) as usize).clamp(1, length);
    let (columns, rows) = (cells(width), cells(height));
    let mut random = SplitMix(1);
    let mut within = |k: usize, cells: usize, length: usize| {
        let [first, end] = [k, k + 1].map(|k| k * length / cells);
        first + (random.next() % (end - first) as u64) as usize
    };
    let mut pixels = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            let x = within(column, columns, width);
            pixels.push([x, within(row, rows, height)]);
        }
    }
    pixels
}

/// Returns the levels of a picture at pixels that are all known.
fn target(subject: &Subject<'_>, pixels: &[[usize; 2]], background: [f32; 3]) -> Target {
    let levels = pixels.iter().map(|pixel| subject.levels(*pixel));
    let levels: Vec<[f32; 3]> = levels.map(Option::unwrap_or_default).collect();
    let is_drawn = levels
        .iter()
        .map(|levels| subject::is_drawn(*levels, background));
    let is_drawn = is_drawn.collect();
    Target { levels, is_drawn }
}

/// Turns the findings of a search into a diagnosis: names the mistakes, and the pixels to look at.
fn described(findings: Findings, mut search: Search<'_, '_>) -> Diagnosis {
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
    let scene = search.stage.scene;
    let size = [scene.width as usize, scene.height as usize];
    let worst = nearest
        .as_ref()
        .or(reference.as_ref())
        .and_then(|drawn| worst_part(&target.levels, pixels, drawn, size));
    let cause = |candidate: &Candidate| Cause {
        mistakes: candidate
            .mistakes
            .iter()
            .map(|&m| search.mistakes[m].clone())
            .collect(),
        residual: candidate.residual.levels,
        steps: Vec::new(),
        recipe: candidate.recipe,
    };
    let mut causes: Vec<Cause> = findings.causes.iter().map(cause).collect();
    if let Some(cause) = causes.first_mut() {
        put_in_order(cause, search.base, &mut search.drawer, scene);
    }
    Diagnosis {
        is_transposed: false,
        window: None,
        rows: None,
        background: None,
        stated_encoding: None,
        is_premultiplied: false,
        outline: reference
            .as_ref()
            .map_or(0.0, |reference| outline(target, reference)),
        cracks: 0.0,
        verdict: findings.verdict,
        reference: search.reference,
        cut: search.base.geometry.cut.name(),
        causes,
        singles: findings.singles.iter().map(cause).collect(),
        votes: findings.votes,
        numbers: findings.numbers,
        tone: findings.tone,
        look_at,
        worst,
        invisible: invisible(&search.shown),
    }
}

/// Orders the mistakes of an explanation so that correcting one after the other brings the picture
/// as close to the right one as possible at each step.
fn put_in_order(cause: &mut Cause, mut base: Recipe, drawer: &mut Drawer<'_>, scene: &Scene) {
    base.geometry.cut = match cause.recipe.geometry.cut {
        cut if CUTS.contains(&cut) => cut,
        _ => Cut::Fan,
    };
    // With the cut of the explanation nothing is left in the end.
    let Some(reference) = drawer.draw(&base) else {
        return;
    };
    let size = [scene.width as usize, scene.height as usize];
    let mut rest = core::mem::take(&mut cause.mistakes);
    let mut before = drawer.draw(&cause.recipe);
    while !rest.is_empty() {
        let mut best: Option<(usize, f64, Recipe, Drawn)> = None;
        for k in 0..rest.len() {
            let others = rest.iter().enumerate().filter(|(other, _)| *other != k);
            let others: Vec<&Mistake> = others.map(|(_, mistake)| mistake).collect();
            let Some(recipe) = Mistake::all(&others, base, scene) else {
                continue;
            };
            let Some(drawn) = drawer.draw(&recipe) else {
                continue;
            };
            let left = apart(&reference, &drawn);
            if best.as_ref().is_none_or(|(_, least, ..)| left < *least) {
                best = Some((k, left, recipe, drawn));
            }
        }
        let Some((k, left, recipe, drawn)) = best else {
            cause.mistakes.append(&mut rest);
            return;
        };
        let part = before
            .as_ref()
            .and_then(|before| worst_part(&before.levels, &drawer.pixels, &drawn, size));
        cause.steps.push(Step { left, part, recipe });
        cause.mistakes.push(rest.remove(k));
        before = Some(drawn);
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

/// Returns the part in which levels are farthest from a recipe: column, row, width and height.
fn worst_part(
    levels: &[[f32; 3]],
    pixels: &[[usize; 2]],
    drawn: &Drawn,
    size: [usize; 2],
) -> Option<[usize; 4]> {
    let mut sums = [[0.0; PARTS]; PARTS];
    for (i, [x, y]) in pixels.iter().enumerate() {
        if !drawn.hits.edges[i] {
            let part = [y * PARTS / size[1], x * PARTS / size[0]];
            sums[part[0]][part[1]] += distance(drawn.levels[i], levels[i]);
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
fn is_premultiplied(stage: &Stage<'_>, subject: &Subject<'_>) -> bool {
    let partly = subject.partly_covered(MOST_PARTLY_COVERED);
    let pixels = partly.iter().map(|(pixel, ..)| *pixel).collect();
    let mut drawer = Drawer::new(stage, pixels, false);
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

/// How many of the pixels in cracks are drawn to see if the scene is dark there.
const MOST_IN_CRACKS: usize = 800;

/// Hides the pixels in cracks between polygons, and returns their share of the covered pixels. It
/// is 0 if there are only few, or if the scene has the background's colour there.
fn hide_cracks(stage: &Stage<'_>, subject: &mut Subject<'_>, background: [f32; 3]) -> f64 {
    let plain = Recipe::default();
    let Some(covered) = Mask::of_geometry(stage, plain.geometry) else {
        return 0.0;
    };
    let Some((mask, share)) = cracks::find(subject, background, &covered) else {
        return 0.0;
    };
    // Polygons that a known mistake leaves out are no cracks.
    let is_left_out = |mistake: &Mistake| {
        let mut recipe = plain;
        mistake.set(&mut recipe);
        let geometry = recipe.of_scene(stage.scene).geometry;
        let own = Mask::of_geometry(stage, geometry).filter(|_| geometry != plain.geometry);
        own.is_some_and(|own| cracks::are_holes(&mask, &covered, &own))
    };
    if MISTAKES.iter().any(is_left_out) {
        return 0.0;
    }
    let mut pixels = grid(subject.size(), MOST_SAMPLES);
    pixels.retain(|pixel| mask.contains(*pixel));
    SplitMix(4).shuffle(&mut pixels);
    pixels.truncate(MOST_IN_CRACKS);
    let count = pixels.len();
    let mut drawer = Drawer::new(stage, pixels, false);
    drawer.background = background;
    let drawn = drawer.draw(&plain);
    let is_far = |levels: &&[f32; 3]| is_off(**levels, background);
    let far = drawn.map_or(0, |drawn| drawn.levels.iter().filter(is_far).count());
    if 10 * far <= 9 * count {
        return 0.0;
    }
    subject.hidden = Some(mask);
    share
}

impl Diagnosis {
    /// True if nothing is wrong.
    pub fn is_correct(&self) -> bool {
        let is_file_right =
            self.background.is_none() && !self.is_transposed && !self.is_premultiplied;
        let is_whole = self.rows.is_none() && self.cracks == 0.0;
        self.verdict == Verdict::Correct && is_file_right && is_whole
    }

    /// Moves all pixels from the scene to the file that shows a part of it.
    fn place_in(&mut self, window: Window) {
        let Window {
            in_scene, in_file, ..
        } = window;
        let moved = |k: usize, pixel: usize| (pixel + in_file[k]).saturating_sub(in_scene[k]);
        if let Some(spot) = &mut self.look_at {
            spot.pixel = [moved(0, spot.pixel[0]), moved(1, spot.pixel[1])];
        }
        if let Some([x, y, width, height]) = self.worst {
            // Of a part that was cut off, the rest is in the file.
            let rest = |k: usize, first: usize, side: usize| {
                let start = first.max(in_scene[k]);
                let end = (first + side).min(in_scene[k] + window.size[k]);
                (moved(k, start), end.saturating_sub(start))
            };
            let ((x, width), (y, height)) = (rest(0, x, width), rest(1, y, height));
            self.worst = Some([x, y, width, height]);
        }
        self.window = Some(window);
    }

    /// Returns every `step`-th column and row of the picture that is diagnosed. If its columns and
    /// rows were exchanged, they are put right. Unknown pixels are transparent.
    pub fn yours(&self, question: &Question<'_>, step: usize) -> Picture8 {
        let mut subject = Subject::new(question.picture, question.scene, question.at);
        subject.rows = self.rows;
        let [width, height] = subject.size();
        let [columns, rows] = [width, height].map(|side| side.div_ceil(step));
        let mut picture = Picture::new(columns, rows, [255; 4]);
        for y in 0..rows {
            for (x, pixel) in picture.row_mut(y).iter_mut().enumerate() {
                let levels = subject.levels([x * step, y * step]);
                *pixel = levels.map_or([0; 4], |levels| {
                    let [r, g, b] = levels.map(|c| c as u8);
                    [r, g, b, 255]
                });
            }
        }
        picture
    }

    /// Draws every `step`-th column and row of a picture of the scene.
    ///
    /// # Errors
    /// [`DiagnoseError`] if the scene cannot be drawn.
    pub fn draw(
        &self,
        question: &Question<'_>,
        shown: Shown,
        step: usize,
    ) -> Result<Picture8, DiagnoseError> {
        let scene = question.scene;
        let prepared = prepared(scene)?;
        let frame = prepared.frame().map_err(DiagnoseError::Frame)?;
        let surface = Surface::new(scene, &prepared, frame.origin());
        let [width, height] = [scene.width, scene.height].map(|side| side as usize);
        let rows = (0..height).step_by(step);
        let pixels = rows.flat_map(|y| (0..width).step_by(step).map(move |x| [x, y]));
        let stage = Stage::new(scene, &prepared, &surface, question.light_lengths);
        let mut drawer = Drawer::new(&stage, pixels.collect(), false);
        drawer.background = match self.background {
            Some([own, _]) if shown != Shown::Reference => own,
            _ => background(scene).map(|c| c as f32),
        };
        let recipe = match (shown, self.causes.first()) {
            (Shown::Corrected(0), Some(cause)) => cause.recipe,
            (Shown::Corrected(count), Some(cause)) if count <= cause.steps.len() => {
                cause.steps[count - 1].recipe
            }
            _ => right(question.method)[0],
        };
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
