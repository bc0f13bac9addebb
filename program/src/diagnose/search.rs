//! The search for the mistakes that explain how a picture differs.
//!
//! Single mistakes are tried first. If none explains the picture, several are looked for in the
//! order in which they can be told apart: the camera by outlines ([`Outline`]), the shape of light
//! with free amounts ([`Fit`]), and then amounts, colours and rounding by exact levels.

use super::combinations::{Combinations, Fit, Set, is_of_the_camera, shape_of};
use super::drawer::Drawer;
use super::mistakes::{MISTAKES, Mistake, methods};
use super::numbers::{Explained, Numbers};
use super::outline::{OTHER_OUTLINE, Outline, RIGHT_OUTLINE};
use super::partly::Near;
use super::recipe::{CUTS, Cut, Recipe, Rounding};
use super::residual::{Drawn, MOST, Residual, Target, Votes, apart};
use super::stage::Stage;
use super::tone::Tone;
use alloc::vec;
use alloc::vec::Vec;
use std::collections::HashSet;

/// The largest residual of an exact explanation, in levels: only rounding is left.
const EXACT: f64 = 0.02;

/// The largest residual of an explanation, in levels: noise of a level or another rounding may be
/// left.
const NEAR: f64 = 0.7;

/// The largest [`Residual::beyond`] of an explanation. A picture that no mistake explains is right
/// if it is this close.
const NOISE: f64 = 0.1;

/// Levels that are cut off leave ½ on average, and noise of −1, 0 or 1 leaves ⅔.
const HALF_OF_NOISE: f64 = 0.4;
const MOST_OF_NOISE: f64 = 0.75;

/// The largest [`Residual::beyond`] of an explanation, if it leaves no part that a person would
/// see.
const NOISE_LEFT: f64 = 0.3;

/// A picture that is farther from the reference than this, in levels, is not another method's
/// picture.
const FAR_FROM_METHODS: f64 = 12.0;

/// The cut of polygons that comes closest to a picture is only taken for the picture's own if it
/// leaves no more than this, in levels.
const TELLS_CUT: f64 = 2.0;

/// What numbers leave, in levels, where no shape of light is right and they are.
const NUMBERS: f64 = 0.06;

/// How many of the best single mistakes are combined with mistakes in amounts.
const FIRST_SINGLES: usize = 3;

/// A mistake that changes a picture by less than this, in levels, is invisible in it.
pub const INVISIBLE: f64 = 0.004;

/// Some mistakes, and the residual that they leave.
#[derive(Clone)]
pub struct Candidate {
    /// The mistakes, as indices into [`Search::mistakes`].
    pub mistakes: Vec<usize>,
    pub recipe: Recipe,
    pub residual: Residual,
}

/// A search in one picture.
pub struct Search<'a, 'd> {
    pub stage: &'a Stage<'a>,
    /// Draws at all compared pixels.
    pub drawer: Drawer<'a>,
    pub target: &'d Target,
    pub mistakes: Vec<Mistake>,
    /// How far each mistake of the table changes the scene's picture, in levels, or `None` if it is
    /// not a mistake here.
    pub shown: Vec<Option<f64>>,
    /// The right recipe, with the cut of polygons that comes closest.
    pub base: Recipe,
    pub reference: Residual,
    /// The right picture that comes closest, if the recipe `base` does not draw it.
    pub right: Option<Drawn>,
}

/// What a search for several mistakes looks at besides the compared pixels.
pub struct Whole<'a, 't> {
    /// The outline of the whole picture.
    pub outline: &'t Outline,
    /// Draws at the few pixels that most recipes are drawn at.
    pub drawer: Drawer<'a>,
    /// The picture at these pixels.
    pub target: Target,
}

/// The result of a search.
pub struct Findings {
    pub verdict: Verdict,
    /// The mistakes to name: the best ones, then others that explain the picture as well.
    pub causes: Vec<Candidate>,
    /// Single mistakes, the best first.
    pub singles: Vec<Candidate>,
    pub votes: Option<Votes>,
    pub numbers: Option<Numbers>,
    pub tone: Option<Tone>,
}

/// The kind of answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// The picture is right.
    Correct,
    /// One mistake explains the picture.
    One,
    /// Several mistakes together explain it.
    Several,
    /// Wrong amounts of light explain it.
    Amounts,
    /// A tone curve explains it: its levels are a function of the right ones.
    Tone,
    /// A mistake explains most of it.
    Partly,
    /// No known mistake explains it.
    None,
    /// The picture shows nothing.
    Empty,
}

impl Verdict {
    /// Returns its name in data.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Correct => "correct",
            Verdict::One => "one",
            Verdict::Several => "several",
            Verdict::Amounts => "amounts",
            Verdict::Tone => "tone",
            Verdict::Partly => "partly",
            Verdict::None => "none",
            Verdict::Empty => "empty",
        }
    }
}

impl Residual {
    /// True if nothing is left but rounding.
    pub fn is_nothing(&self) -> bool {
        self.levels <= EXACT
    }

    /// True if another mistake may be left: more than rounding and noise of a level.
    fn is_worth_explaining(&self) -> bool {
        let is_noise =
            self.beyond <= EXACT && (HALF_OF_NOISE..MOST_OF_NOISE).contains(&self.levels);
        self.levels > 3.0 * EXACT && !is_noise
    }

    /// True if only noise, another rounding or other edges are left. Many mistakes can come near
    /// any picture, so they must leave less.
    fn is_small(&self, mistakes: usize) -> bool {
        let most = match mistakes {
            0..=2 => NOISE_LEFT,
            3 => NOISE_LEFT / 3.0,
            4 | 5 => NOISE_LEFT / 5.0,
            _ => EXACT,
        };
        self.beyond <= most
    }
}

/// True if a mistake explains the residual `before` and leaves `after`: nearly nothing, or nearly
/// nothing beyond noise of a level.
fn explains(after: Residual, before: Residual) -> bool {
    let nearly = |after: f64, before: f64, near: f64| {
        after <= near.max(0.08 * before) && after <= 0.3 * before
    };
    let is_noise_apart = before.beyond > EXACT && nearly(after.beyond, before.beyond, NOISE);
    nearly(after.levels, before.levels, NEAR) || is_noise_apart
}

/// Returns the largest residual that is as good as `best`.
fn as_good_as(best: f64) -> f64 {
    best + (0.3 * best).max(EXACT)
}

/// The roundings of a picture whose amounts are fitted.
const ROUNDINGS: [Rounding; 4] = [
    Rounding::Nearest,
    Rounding::Down,
    Rounding::Up,
    Rounding::Of256,
];

fn with_cut(mut recipe: Recipe, cut: Cut) -> Recipe {
    recipe.geometry.cut = cut;
    recipe
}

impl<'a, 'd> Search<'a, 'd> {
    /// Begins a search. `right` are the right recipes, which are all equally good. Returns `None`
    /// if too little of the scene is visible.
    pub fn new(
        stage: &'a Stage<'a>,
        mut drawer: Drawer<'a>,
        target: &'d Target,
        right: &[Recipe],
    ) -> Option<Search<'a, 'd>> {
        let mut best: Option<(Recipe, Residual)> = None;
        for recipe in right
            .iter()
            .flat_map(|right| CUTS.map(|cut| with_cut(*right, cut)))
        {
            let drawn = drawer.draw(&recipe);
            let found = drawn.and_then(|drawn| target.residual(&drawn));
            let Some(found) = found else { continue };
            // Prefer the first cut unless another one is clearly closer.
            if best.is_none_or(|(_, best)| found.levels < 0.99 * best.levels) {
                best = Some((recipe, found));
            }
        }
        let (base, reference) = best?;
        Some(Search {
            stage,
            drawer,
            target,
            mistakes: MISTAKES.to_vec(),
            shown: Vec::new(),
            base,
            reference,
            right: None,
        })
    }

    /// Takes another right picture, if it comes closer.
    pub fn offer_right(&mut self, drawn: Drawn) {
        if let Some(left) = self.target.residual(&drawn)
            && left.levels < self.reference.levels
        {
            self.reference = left;
            self.right = Some(drawn);
        }
    }

    /// Looks for an explanation. `progress` is called with the share of the work that is done, 0
    /// to 1.
    pub fn run(&mut self, whole: Whole<'a, '_>, progress: &mut dyn FnMut(f32)) -> Findings {
        self.shown = self.shown();
        if self.reference.is_nothing() {
            let mut findings = self.correct(Vec::new());
            self.moved(&mut findings, whole);
            return findings;
        }
        let mut singles = self.singles(0..MISTAKES.len(), progress);
        let is_open = |singles: &[Candidate]| {
            singles
                .first()
                .is_none_or(|best| best.residual.beyond > EXACT)
        };
        if is_open(&singles) && self.reference.levels <= FAR_FROM_METHODS {
            let from = self.mistakes.len();
            self.mistakes.extend(methods());
            let by_methods = self.singles(from..self.mistakes.len(), &mut |_| {});
            singles.extend(by_methods);
            sort(&mut singles);
        }
        progress(0.3);
        let reference = self.drawer.draw(&self.base);
        if reference.is_some_and(|reference| self.target.is_empty(&reference)) {
            return Findings {
                verdict: Verdict::Empty,
                ..self.correct(singles)
            };
        }
        self.judge(singles, whole, progress)
    }

    fn correct(&self, singles: Vec<Candidate>) -> Findings {
        Findings {
            verdict: Verdict::Correct,
            causes: Vec::new(),
            singles,
            votes: None,
            numbers: None,
            tone: None,
        }
    }

    fn judge(
        &mut self,
        singles: Vec<Candidate>,
        whole: Whole<'a, '_>,
        progress: &mut dyn FnMut(f32),
    ) -> Findings {
        let before = self.reference;
        let Some(best) = singles.first().cloned() else {
            return self.correct(singles);
        };
        let votes = self.votes(&best);
        let mut findings = Findings {
            votes,
            ..self.correct(singles)
        };
        let is_exact = best.residual.is_nothing();
        // If all differences are within a level they are noise, unless a mistake leaves nothing at
        // all.
        let is_noise = before.beyond <= EXACT && !is_exact;
        // Votes decide about highlights and other small parts, which change the mean only a little.
        let is_small = best.residual.levels <= 2.0 * NEAR;
        let is_elected = is_small && votes.is_some_and(|votes| votes.elect());
        let is_one = (explains(best.residual, before) || is_elected) && !is_noise;
        if is_one && self.is_explained(&best) {
            findings.verdict = Verdict::One;
            findings.causes = tied(&findings.singles, before.levels);
            if best.residual.is_worth_explaining() {
                self.several(&mut findings, whole, progress);
                return findings;
            }
            if !is_exact {
                self.with_rounding(&mut findings);
            }
            self.moved(&mut findings, whole);
            return findings;
        }
        if !is_one && before.beyond <= NOISE && !self.is_seen_to_be_wrong() {
            self.moved(&mut findings, whole);
            return findings;
        }
        self.several(&mut findings, whole, progress);
        findings
    }

    /// Adds mistakes of the camera that the outline shows, though nothing else does.
    fn moved(&mut self, findings: &mut Findings, whole: Whole<'a, '_>) {
        let (mistakes, recipe, left) = match findings.causes.first() {
            Some(cause) => (cause.mistakes.clone(), cause.recipe, cause.residual.levels),
            None => (Vec::new(), self.base, self.reference.levels),
        };
        let own = whole.outline.error_of(self.stage, &recipe);
        if own <= RIGHT_OUTLINE {
            return;
        }
        let base = with_cut(self.base, self.cut_of(&recipe));
        let combinations = Combinations::new(
            self.stage,
            whole.drawer,
            whole.target,
            whole.outline,
            base,
            &[],
        );
        let (cameras, error) = combinations.best_cameras();
        if error > 0.5 * own || own - error < RIGHT_OUTLINE {
            return;
        }
        let mut causes: Vec<Candidate> = Vec::new();
        for camera in cameras {
            let both = [&mistakes[..], &camera].concat();
            causes.extend(self.candidate(both, base));
        }
        causes.retain(|cause| {
            let error = whole.outline.error_of(self.stage, &cause.recipe);
            error <= 0.5 * own && cause.residual.levels <= left + EXACT
        });
        if let Some(first) = causes.first() {
            findings.verdict = match first.mistakes.len() {
                1 => Verdict::One,
                _ => Verdict::Several,
            };
            findings.causes = causes;
        }
    }

    /// True if nothing is left of a candidate that a person would see.
    fn is_explained(&mut self, candidate: &Candidate) -> bool {
        let left = candidate.residual;
        let count = self.beside_camera(&candidate.mistakes);
        let is_told = || candidate.mistakes.len() == 1 || !self.target.has_few_colours();
        let is_small = || left.is_small(count) && is_told();
        left.is_nothing() || is_small() && !self.shows(&candidate.recipe)
    }

    /// Returns how many mistakes the outline does not show.
    fn beside_camera(&self, mistakes: &[usize]) -> usize {
        let is_other = |m: &&usize| !is_of_the_camera(&self.mistakes[**m], &self.base, self.stage);
        mistakes.iter().filter(is_other).count()
    }

    /// True if a part of the picture differs so much from a recipe that a person would see it.
    fn shows(&mut self, recipe: &Recipe) -> bool {
        let drawn = self.drawer.draw(recipe);
        drawn.is_none_or(|drawn| self.target.shows(&drawn, &self.drawer.pixels))
    }

    /// True if a part of the picture differs so much from the right one that a person would see it.
    fn is_seen_to_be_wrong(&mut self) -> bool {
        match &self.right {
            Some(right) => self.target.shows(right, &self.drawer.pixels),
            None => self.shows(&self.base.clone()),
        }
    }

    /// Adds another rounding to the best explanation, if that leaves much less.
    fn with_rounding(&mut self, findings: &mut Findings) {
        let Some(best) = findings.causes.first().cloned() else {
            return;
        };
        let roundings = (0..MISTAKES.len()).filter(|&m| {
            let mut recipe = self.base;
            MISTAKES[m].set(&mut recipe);
            recipe.storage.rounding != self.base.storage.rounding && !best.mistakes.contains(&m)
        });
        let mut together: Vec<Candidate> = Vec::new();
        for rounding in roundings.collect::<Vec<_>>() {
            for cause in findings.causes.iter().take(6).cloned() {
                let mistakes = [&cause.mistakes[..], &[rounding]].concat();
                let base = with_cut(self.base, self.cut_of(&cause.recipe));
                together.extend(self.candidate(mistakes, base));
            }
        }
        sort(&mut together);
        if together
            .first()
            .is_some_and(|first| first.residual.levels <= EXACT.max(0.3 * best.residual.levels))
        {
            findings.causes = tied(&together, self.reference.levels);
            findings.verdict = Verdict::Several;
        }
    }

    fn cut_of(&self, recipe: &Recipe) -> Cut {
        match recipe.geometry.cut {
            cut if CUTS.contains(&cut) => cut,
            _ => self.base.geometry.cut,
        }
    }

    /// Looks for several mistakes that together explain the picture.
    fn several(
        &mut self,
        findings: &mut Findings,
        whole: Whole<'a, '_>,
        progress: &mut dyn FnMut(f32),
    ) {
        let before = self.reference;
        let Whole {
            outline,
            drawer,
            target,
        } = whole;
        let nearest = findings.singles.iter().take(FIRST_SINGLES);
        let nearest: Vec<Set> = nearest.map(|single| single.mistakes.clone()).collect();
        // Most programs draw fans, and where much is wrong the reference cannot tell.
        let base = match self.base.geometry.cut {
            cut if cut != Cut::Whole && before.levels <= TELLS_CUT => self.base,
            _ => with_cut(self.base, Cut::Fan),
        };
        let mut combinations =
            Combinations::new(self.stage, drawer, target, outline, base, &nearest);
        let mut progress = |share| progress(0.3 + 0.6 * share);
        let mut fits = None;
        if !combinations.find_shapes(&mut progress) && findings.verdict != Verdict::One {
            // The commonest mistake is a wrong digit.
            let all = fits.insert(combinations.fits());
            findings.numbers = self
                .explaining(all)
                .filter(|found| found.residual <= NUMBERS);
            if findings.numbers.is_some() {
                findings.verdict = Verdict::Amounts;
                return;
            }
        }
        let sets = combinations.find_sets(&mut progress);
        let found = self.ranked(sets, &combinations, &findings.singles);
        let Some(best) = found.first().cloned() else {
            findings.verdict = Verdict::None;
            return;
        };
        let is_explained = self.is_explained(&best);
        if findings.verdict == Verdict::One
            && (!is_explained || best.residual.levels > 0.5 * findings.causes[0].residual.levels)
        {
            self.with_rounding(findings);
            return;
        }
        if is_explained {
            findings.causes = self.all_as_good(&best, found, &mut combinations);
            findings.verdict = match findings.causes[0].mistakes.len() {
                1 => Verdict::One,
                _ => Verdict::Several,
            };
            return;
        }
        findings.causes = Vec::new();
        let fits = fits.unwrap_or_else(|| combinations.fits());
        findings.numbers = self.explaining(&fits);
        findings.verdict = match findings.numbers {
            Some(_) => Verdict::Amounts,
            None => Verdict::None,
        };
        if findings.numbers.is_none() {
            let near = found
                .iter()
                .map(|near| (&near.mistakes, near.residual.levels));
            let near = Near {
                found: near.collect(),
                before: before.levels,
            };
            let certain = near.certain(&mut combinations);
            let part = self.candidate(certain, combinations.base);
            if let Some(part) = part.filter(|part| near.is_part(part.residual.levels)) {
                findings.verdict = Verdict::Partly;
                findings.causes = vec![part];
            } else if outline.error_of(self.stage, &best.recipe) < OTHER_OUTLINE {
                self.tone(findings, before.levels);
            }
        }
        progress(0.95);
    }

    /// Returns sets of mistakes and the best single one with their residuals at all compared
    /// pixels, the best first.
    fn ranked(
        &mut self,
        sets: Vec<Set>,
        combinations: &Combinations<'a, '_>,
        singles: &[Candidate],
    ) -> Vec<Candidate> {
        let mut found: Vec<Candidate> = Vec::new();
        for set in sets.into_iter().filter(|set| !set.is_empty()) {
            let candidate = self.candidate(set, combinations.base);
            found.extend(candidate.map(|candidate| self.with_any_cut(candidate)));
        }
        found.extend(singles.first().cloned());
        let price = |candidate: &Candidate| {
            let left = candidate.residual.levels + 0.01 * candidate.mistakes.len() as f64;
            (100.0 * left).round()
        };
        found.sort_by(|a, b| {
            price(a)
                .total_cmp(&price(b))
                .then(a.mistakes.cmp(&b.mistakes))
        });
        found.dedup_by(|a, b| a.mistakes == b.mistakes);
        found
    }

    /// Returns the best explanation and others that leave as little. If some of them have fewer
    /// mistakes, only these.
    fn all_as_good(
        &mut self,
        best: &Candidate,
        found: Vec<Candidate>,
        combinations: &mut Combinations<'a, '_>,
    ) -> Vec<Candidate> {
        let mut causes = vec![best.clone()];
        for set in combinations.alternatives(&best.mistakes) {
            let other = (!set.is_empty()).then(|| self.candidate(set, combinations.base));
            causes.extend(other.flatten());
        }
        causes.extend(found.into_iter().skip(1));
        let most = 1.05 * best.residual.levels + 0.004;
        let longest = best.mistakes.len();
        causes.retain(|cause| cause.residual.levels <= most && cause.mistakes.len() <= longest);
        let mut known = HashSet::new();
        causes.retain(|cause| known.insert(cause.mistakes.clone()));
        causes.sort_by_key(|cause| cause.mistakes.len());
        let shortest = causes[0].mistakes.len();
        causes.retain(|cause| cause.mistakes.len() == shortest);
        causes
    }

    /// Returns the single mistakes at the indices `which` with their residuals, the best first.
    fn singles(
        &mut self,
        which: core::ops::Range<usize>,
        progress: &mut dyn FnMut(f32),
    ) -> Vec<Candidate> {
        let count = which.len().max(1) as f32;
        let first = which.start;
        let mut found = Vec::new();
        for index in which {
            let candidate = self.candidate(vec![index], self.base);
            found.extend(candidate);
            progress(0.5 * (index - first) as f32 / count);
        }
        sort(&mut found);
        // Where light depends on the cut of polygons, try all cuts.
        for (place, candidate) in found.iter_mut().enumerate() {
            if place < 8 || candidate.recipe.depends_on_cut() {
                *candidate = self.with_any_cut(candidate.clone());
            }
        }
        sort(&mut found);
        found
    }

    /// Returns a candidate's mistakes with the cut of polygons that leaves the least.
    fn with_any_cut(&mut self, candidate: Candidate) -> Candidate {
        let mut best = candidate;
        for cut in CUTS {
            let other = self.candidate(best.mistakes.clone(), with_cut(self.base, cut));
            if let Some(other) = other
                && other.residual.levels < best.residual.levels
            {
                best = other;
            }
        }
        best
    }

    fn candidate(&mut self, mistakes: Vec<usize>, base: Recipe) -> Option<Candidate> {
        let made: Vec<&Mistake> = mistakes.iter().map(|&m| &self.mistakes[m]).collect();
        let recipe = Mistake::all(&made, base, self.stage.scene)?;
        let drawn = self.drawer.draw(&recipe)?;
        let residual = self.target.residual(&drawn)?;
        Some(Candidate {
            mistakes,
            recipe,
            residual,
        })
    }

    fn votes(&mut self, candidate: &Candidate) -> Option<Votes> {
        let reference = self.drawer.draw(&self.base)?;
        let other = self.drawer.draw(&candidate.recipe)?;
        Some(self.target.votes(&reference, &other))
    }

    /// Returns the numbers of the first fit that explains the picture.
    fn explaining(&mut self, fits: &[Fit]) -> Option<Numbers> {
        fits.iter().find_map(|fit| {
            let all = CUTS
                .into_iter()
                .flat_map(|cut| ROUNDINGS.map(|rounding| (cut, rounding)));
            let tried = all.filter_map(|(cut, rounding)| self.explained(fit, cut, rounding));
            let best = tried.min_by(|a, b| a.left.levels.total_cmp(&b.left.levels))?;
            let numbers = Numbers::new(best, self.stage);
            numbers.are_telling().then_some(numbers)
        })
    }

    /// Draws a fit. Returns it if it explains the picture.
    fn explained(&mut self, fit: &Fit, cut: Cut, rounding: Rounding) -> Option<Explained> {
        let made: Vec<&Mistake> = fit.mistakes.iter().map(|&m| &MISTAKES[m]).collect();
        let recipe = Mistake::all(&made, with_cut(self.base, cut), self.stage.scene)?;
        let mut shape = shape_of(&recipe);
        shape.storage.rounding = rounding;
        let found = self.drawer.fit(&shape, Some(&fit.fitted), self.target)?;
        let left = self.target.residual(&found.drawn)?;
        let is_small = left.is_small(self.beside_camera(&fit.mistakes));
        if !is_small
            || self.target.has_few_colours()
            || self.target.shows(&found.drawn, &self.drawer.pixels)
        {
            return None;
        }
        let mut mistakes: Vec<Mistake> = made.into_iter().cloned().collect();
        if rounding != self.base.storage.rounding {
            mistakes.extend(
                MISTAKES
                    .iter()
                    .find(|mistake| {
                        let mut recipe = self.base;
                        mistake.set(&mut recipe);
                        recipe.storage.rounding == rounding
                    })
                    .cloned(),
            );
        }
        Some(Explained {
            mistakes,
            fitted: fit.fitted.clone(),
            factors: found.amounts.factors,
            left,
        })
    }

    /// Looks for a curve of levels that explains the picture.
    fn tone(&mut self, findings: &mut Findings, left: f64) {
        let Some(reference) = self.drawer.draw(&self.base) else {
            return;
        };
        if self.target.has_few_colours() {
            return;
        }
        let inner = |i: &usize| reference.hits.is_covered(*i) && !reference.hits.edges[*i];
        let mut pairs: Vec<(f32, f32)> = (0..reference.levels.len())
            .filter(inner)
            .flat_map(|i| (0..3).map(move |c| (i, c)))
            .map(|(i, c)| (reference.levels[i][c], self.target.levels[i][c]))
            .collect();
        findings.tone = Tone::find(&mut pairs).filter(|tone| (tone.gamma - 1.0).abs() > 0.05);
        if let Some(tone) = findings.tone
            && tone.scatter <= 1.2
            && tone.scatter <= 0.2 * left
            && findings
                .singles
                .first()
                .is_none_or(|best| tone.scatter < best.residual.levels)
        {
            findings.verdict = Verdict::Tone;
        }
    }

    /// Returns how far each mistake of the table changes the picture of this scene, in levels, or
    /// `None` if it is not a mistake here.
    pub fn shown(&mut self) -> Vec<Option<f64>> {
        let Some(reference) = self.drawer.draw(&self.base) else {
            return vec![None; MISTAKES.len()];
        };
        let shown = |mistake: &Mistake| {
            let recipe = Mistake::all(&[mistake], self.base, self.stage.scene)?;
            // A recipe that cannot be drawn is as far from the reference as possible.
            let drawn = self.drawer.draw(&recipe);
            Some(drawn.map_or(MOST, |drawn| apart(&reference, &drawn)))
        };
        MISTAKES.iter().map(shown).collect()
    }
}

fn sort(candidates: &mut [Candidate]) {
    candidates.sort_by(|a, b| a.residual.levels.total_cmp(&b.residual.levels));
}

/// Returns the candidates that explain a picture as well as the first and best of them. `before` is
/// the distance of the picture from the right one.
fn tied(sorted: &[Candidate], before: f64) -> Vec<Candidate> {
    let best = sorted.first().map_or(0.0, |best| best.residual.levels);
    let most = as_good_as(best).min(best + 0.5 * (before - best).max(0.0));
    let is_tied = |candidate: &&Candidate| candidate.residual.levels <= most;
    let mut tied: Vec<Candidate> = sorted.iter().take_while(is_tied).cloned().collect();
    // Among equal candidates the table's order decides: frequent mistakes come first there.
    let equal = tied.partition_point(|candidate| candidate.residual.levels <= best + 0.01);
    tied[..equal].sort_by_key(|candidate| (candidate.mistakes.len(), candidate.mistakes.clone()));
    tied
}
